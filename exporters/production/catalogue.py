"""A catalogue: a scene built for every choice of some keys' values, a folder each, and one table of them all.

A folder that is finished already is not built again: its report must tell of this very scene, and its files must have
the hashes that stand there. A refusal is a row, with why.
"""

from __future__ import annotations

import csv
import io
import json
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context, parent_process
from pathlib import Path
from typing import Any

from exporters import __version__
from exporters.formats.whole import write_whole
from exporters.production.build import build
from exporters.production.check_lines import has_bad_verdict
from exporters.production.moving import clear, hash_of
from exporters.production.plan import plan_build
from exporters.production.report import whole_report
from parts.base.refusal import SceneError, explained
from parts.base.texts import words
from parts.scene.load import resolved, scene_from_resolved
from parts.scene.scene_file import SceneFile
from parts.scene.variants import Axis, Variant, variants

OK, FAILED, REFUSED = "ok", "failed", "refused"
MOST_JOBS = 1024
# what a row of the table tells of a file, by the names of its columns
_COLUMNS = {"file": "path", "format": "format", "purpose": "purpose", "part": "part", "bytes": "bytes",
            "sha256": "sha256", "max_error_mm": "max_error", "measured_mm": "deviation", "volume_mm3": "volume",
            "mass_g": "mass"}  # fmt: skip
# seconds in which a cluster has to answer
_PATIENCE = 20


def catalogue(
    scene: SceneFile,
    source: str,
    axes: Sequence[Axis],
    folder: Path,
    executor: Executor | None,
    progress: Callable[[str], None] = lambda name: None,
) -> list[dict[str, Any]]:
    """Build every variant in a folder of its own and write ``catalogue.csv`` and ``catalogue.json``; its entries."""
    made = partial(entry_of, source=source, catalogue_folder=folder.resolve())
    entries = []
    for entry in (executor.map if executor else map)(made, variants(scene, axes)):
        entries.append(entry)
        progress(entry["folder"])
    folder.mkdir(parents=True, exist_ok=True)
    write_whole(folder / "catalogue.csv", _table(entries, [axis.key for axis in axes]))
    write_whole(folder / "catalogue.json", json.dumps(entries, indent=1, ensure_ascii=False) + "\n")
    return entries


def entry_of(variant: Variant, source: str, catalogue_folder: Path) -> dict[str, Any]:
    """What the catalogue says of a variant of a scene, which is built where it is not finished."""
    told = {"folder": variant.name, "keys": variant.values}
    folder = catalogue_folder / variant.name
    try:
        scene = scene_from_resolved(variant.scene, source)
        clear(folder)
        report = whole_report(folder)
        if not _is_finished(report, resolved(scene), folder):
            build(plan_build(scene, source, [], []), folder)
            report = whole_report(folder)
    except SceneError as error:
        why = words(variant.scene["scene"]["language"]).say(explained(error))
        return {**told, "verdict": REFUSED, "key": error.key, "why": why, "files": []}
    made = report or {}
    good = not made["failed"] and not has_bad_verdict(made["checks"])
    why = "; ".join(f"{one['path']}: {failure}" for one in made["failed"] for failure in one["failures"])
    files = [_file(one, made["parts"]) for one in made["files"]]
    return {**told, "verdict": OK if good else FAILED, "key": None, "why": why, "files": files}


def _is_finished(report: dict[str, Any] | None, scene: dict[str, Any], folder: Path) -> bool:
    """Whether a report tells of a whole verified build of a scene by this program, and its files are there as made."""
    if report is None or report.get("scene") != scene or report.get("versions", {}).get("higherpair") != __version__:
        return False
    if report["failed"] or not all(one["verified"] for one in report["files"]):
        return False
    told = ((folder / one["path"], one["sha256"]) for one in (*report["files"], *report["previews"]))
    return all(file.is_file() and hash_of(file) == sha256 for file, sha256 in told)


def _file(entry: dict[str, Any], parts: dict[str, Any]) -> dict[str, Any]:
    """A file as the catalogue tells of it, with what its part weighs."""
    weighed = {key: parts.get(entry["part"], {}).get(key) for key in ("volume", "mass")}
    told = {**entry, "deviation": entry["measured"].get("max_deviation"), **weighed}
    return {key: told.get(key) for key in _COLUMNS.values()}


def _table(entries: Sequence[dict[str, Any]], keys: Sequence[str]) -> str:
    """A row of each file, and of each variant without one."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([*keys, "verdict", "folder", *_COLUMNS, "why"])
    for entry in entries:
        head = [*entry["keys"].values(), entry["verdict"], entry["folder"]]
        why = f"{entry['key']}: {entry['why']}" if entry["key"] else entry["why"]
        for file in entry["files"] or [{}]:
            writer.writerow([*head, *(file.get(name) for name in _COLUMNS.values()), why])
    return text.getvalue()


@contextmanager
def workers(jobs: int, cluster: str | None) -> Iterator[Executor | None]:
    """Who builds: this process, so many of their own, or those of a Dask cluster, which share its disk.

    Raises
    ------
    SceneError
        A number of processes out of range, no Dask, no cluster, or a process that was lost.
    """
    if cluster is not None:
        with _cluster(cluster) as executor:
            yield executor
        return
    if not 1 <= jobs <= MOST_JOBS:
        raise SceneError("catalogue", "--jobs", jobs, "out_of_range", least=1, most=MOST_JOBS)
    if jobs == 1:
        yield None
        return
    pool = ProcessPoolExecutor(jobs, get_context("spawn"), _follow)
    try:
        yield pool
    except BrokenProcessPool as error:
        raise SceneError("catalogue", "--jobs", jobs, "worker_lost") from error
    finally:
        pool.shutdown(cancel_futures=True)


@contextmanager
def _cluster(address: str) -> Iterator[Executor]:
    try:
        from distributed import Client
    except ImportError:
        raise SceneError("catalogue", "--dask", address, "needs_cluster") from None
    try:
        client = Client(address, timeout=_PATIENCE)
    except (OSError, ValueError) as error:
        raise SceneError("catalogue", "--dask", address, "no_cluster", None, why=str(error)) from error
    with client:
        yield client.get_executor()


def _follow() -> None:
    """In a worker: a stop is the command's to tell, and when the command is killed the worker ends too."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    if (parent := parent_process()) is not None:
        parent.join()
        os._exit(1)

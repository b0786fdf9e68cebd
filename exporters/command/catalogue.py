"""``higherpair catalogue``: build a scene for every combination of the values of some keys."""

from __future__ import annotations

from argparse import Namespace
from collections import Counter
from math import prod

from exporters.command.asked import DONE, FAILED, progress_of, scene_of
from exporters.production.catalogue import FAILED as BAD
from exporters.production.catalogue import OK, REFUSED, catalogue, workers
from parts.base.refusal import SceneError
from parts.base.texts import N_, words
from parts.scene.variants import axes_of


def run(options: Namespace) -> int:
    """The exit code."""

    scene = scene_of(options.scene, options)
    axes = axes_of(options.vary, scene)
    folder, total = options.out / scene.name, prod(len(axis.values) for axis in axes)
    with workers(options.jobs, options.dask) as executor, progress_of(options, scene.name, total) as advance:
        entries = catalogue(scene, options.scene, axes, folder, executor, advance)
    verdicts = Counter(entry["verdict"] for entry in entries)
    if verdicts[BAD] or not options.quiet:
        counts = {"ok": verdicts[OK], "refused": verdicts[REFUSED], "failed": verdicts[BAD]}
        text = N_("{file}: {ok} ok, {refused} refused, {failed} failed")
        print(words(scene.scene.language).text(text, file=folder / "catalogue.csv", **counts))
    if verdicts[REFUSED] == total:
        first = {"key": entries[0]["key"], "why": entries[0]["why"], "file": "catalogue.csv"}
        raise SceneError(options.scene, "--vary", ", ".join(options.vary), "every_row_refused", None, **first)
    return FAILED if verdicts[BAD] else DONE

"""``report.json``: what was made, what was measured on it, and the scene that made it."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

import numpy as np

from exporters import __version__
from exporters.production.jobs import Written
from exporters.production.moving import hash_of
from exporters.production.plan import Plan
from exporters.verification.verdict import judges
from parts.base.content import content
from parts.base.part import Part
from parts.base.texts import ENGLISH, languages, words
from parts.scene.load import resolved
from parts.scene.standing import UPWARDS, Instance
from parts.texts.findings import findings_told

NAME = "report.json"
# of a longer one the end is missing
_MOST_BYTES = 64_000_000


def write_report(
    file: Path,
    plan: Plan,
    written: list[Written],
    previews: list[Path],
    checks: dict[str, Any],
    seconds: float,
    folder: Path,
    before: dict[str, Any] | None,
    *,
    partial: bool,
) -> list[str]:
    """Write the report of a build in ``folder``; returns the files of earlier builds there of which it knows no more.

    ``before``: the report that lies there; ``partial``: this one is merged into it by path.
    """
    language = plan.scene.scene.language
    report: dict[str, Any] = {
        "scene": resolved(plan.scene),
        "parts": {
            part.id: {
                "kind": part.kind,
                **part.circles,
                **part.quantities,
                **_mass(part, written),
                "findings": findings_told(language, part.findings),
            }
            for part in plan.parts.values()
        },
        "instances": {instance.id: _placement(instance) for instance in plan.placing.instances},
        "files": [_entry(item, language) for item in written if not item.failures],
        "failed": [_failed(item, folder, resolved(plan.scene), before) for item in written if item.failures],
        "previews": [{"path": p.name, "bytes": p.stat().st_size, "sha256": hash_of(p)} for p in previews],
        "checks": checks,
        "left_out": [{"what": one.what, "why": words(ENGLISH).say(one.why)} for one in plan.left_out],
        "versions": _versions(written),
        "run": {
            "seconds": round(seconds, 4),
            "stages": {item.job.path: {k: round(v, 5) for k, v in item.seconds.items()} for item in written},
            "peak_memory_mb": _peak_memory(),
            "system": sys.platform,
        },
    }
    if partial:
        _merge(report, before)
    report["left_behind"] = _left_behind(report, before, folder)
    file.write_text(json.dumps(report, indent=1, ensure_ascii=False) + "\n", encoding="utf-8", newline="\n")
    return report["left_behind"]


def _left_behind(report: dict[str, Any], before: dict[str, Any] | None, folder: Path) -> list[str]:
    """Files that an earlier build has made, as far as they still lie there, and that are not of this report."""
    known = {entry["path"] for key in ("files", "failed", "previews") for entry in report[key]}
    told = before or {}
    earlier = [entry.get("path") for key in ("files", "previews") for entry in told.get(key, [])]
    earlier += told.get("left_behind", [])
    return sorted({path for path in earlier if path and path not in known and (folder / path).is_file()})


def read_report(folder: Path) -> dict[str, Any] | None:
    """The report that lies in a folder; None where there is none, or what lies there is none.

    Raises
    ------
    OSError
        It cannot be read: what it says of other files must not be lost.
    """
    try:
        report = json.loads(content(folder / NAME, _MOST_BYTES).decode("utf-8"))
    except (FileNotFoundError, NotADirectoryError, ValueError, RecursionError):
        return None
    return report if isinstance(report, dict) else None


def whole_report(folder: Path) -> dict[str, Any] | None:
    """The report that lies in a folder; None where it does not tell of its scene and files as ours do.

    That far another build takes something over. Raises as ``read_report``.
    """
    report = read_report(folder)
    return report if report is not None and _is_whole(report) else None


def _is_whole(report: dict[str, Any]) -> bool:
    if not isinstance(scene := report.get("scene"), dict):
        return False
    lists = [report.get(key) for key in ("files", "previews", "failed")]
    lists.append([{"path": name} for name in left] if isinstance(left := report.get("left_behind", []), list) else None)
    if not all(isinstance(each, list) and all(isinstance(entry, dict) for entry in each) for each in lists):
        return False
    kept = [entry["kept"] for entry in report["failed"] if entry.get("kept") is not None]
    names = [entry.get("path") for each in lists for entry in each or ()]
    return (
        isinstance(scene.get("scene", {}), dict)
        and all(isinstance(name, str) and Path(name).name == name for name in names)
        and all(isinstance(entry.get("sha256"), str) for entry in (*report["files"], *report["previews"]))
        and all(isinstance(one, dict) and isinstance(one.get("sha256"), str) and "fits_scene" in one for one in kept)
    )


def report_language(file: Path) -> str:
    """The language of the scene that made a file, as far as its report can tell; English where it cannot."""
    try:
        told: object = read_report(file.parent)
    except OSError:
        return ENGLISH
    for key in ("scene", "scene", "language"):
        told = told.get(key) if isinstance(told, dict) else None
    return told if isinstance(told, str) and told in languages() else ENGLISH


def _merge(report: dict[str, Any], before: dict[str, Any] | None) -> None:
    """Keep what an earlier build of the same scene made and this one did not touch."""
    if before is None or before.get("scene") != report["scene"]:
        return
    touched = {entry["path"] for entry in (*report["files"], *report["failed"])}
    for key in ("files", "previews", "failed"):
        fresh = touched if key != "previews" else {entry["path"] for entry in report[key]}
        kept = [entry for entry in before.get(key, []) if entry.get("path") not in fresh]
        report[key] = sorted([*kept, *report[key]], key=lambda entry: entry["path"])


def _mass(part: Part, written: list[Written]) -> dict[str, Any]:
    """Mass properties of a part that is built as a solid or whose density is known."""
    solid = {m.part.id for item in written for m in item.job.members if m.kind.is_solid}
    if part.density is None and part.id not in solid:
        return {}
    from parts.base.materials import mass_properties

    return mass_properties(part.made_by.moments(part.body(0.0)), part.density)


def _entry(item: Written, language: str) -> dict[str, Any]:
    job, export = item.job, item.job.export
    return {
        "path": job.path,
        "format": export.format,
        "purpose": export.purpose,
        **job.told,
        # only those of a STEP header that are told
        **{key: text for key in ("author", "organisation") if (text := getattr(export, key))},
        "unit": "mm",
        "tolerance": export.tolerance,
        "offset": job.offset,
        "max_error": item.max_error,
        "bound": item.bound,
        "verified": bool(item.measured),
        "measured": item.measured,
        "judges": judges(item.measured),
        "entities": item.entities,
        "bytes": item.file.stat().st_size,
        "sha256": hash_of(item.file),
        "findings": findings_told(language, item.findings),
    }


def _failed(item: Written, folder: Path, scene: dict[str, Any], before: dict[str, Any] | None) -> dict[str, Any]:
    """A file that failed its read-back, and the one of an earlier build that keeps its place."""
    from exporters.production.kept import kept_file

    kept = kept_file(folder / item.job.path, scene, before)
    return {"path": item.job.path, "failures": list(item.failures), "kept": kept}


def _placement(instance: Instance) -> dict[str, Any]:
    return {
        "part": instance.part,
        "at": list(instance.at),
        "rotation_deg": math.degrees(instance.rotation),
        "placed_by": instance.placed_by,
        **({} if instance.axis == UPWARDS else {"axis": list(instance.axis)}),
    }


def _versions(written: list[Written]) -> dict[str, str]:
    """Versions of what this build used; asking for more would load it."""
    python = ".".join(map(str, sys.version_info[:3]))
    versions = {"higherpair": __version__, "python": python, "numpy": np.__version__}
    exports = [item.job.export for item in written]
    formats = {"drawing" if e.purpose == "drawing" and e.format == "dxf" else e.format for e in exports}
    for name, users in (("ezdxf", {"drawing", "sheet"}), ("lib3mf", {"3mf"}), ("fpdf", {"pdf"})):
        if formats & users and name in sys.modules:
            versions[name] = str(getattr(sys.modules[name], "__version__", "installed"))
    return versions


def _peak_memory() -> float | None:
    """Peak memory of this process, MB; None where the system does not tell."""
    try:
        import resource
    except ImportError:
        return None
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return round(peak / (1 << 20 if sys.platform == "darwin" else 1 << 10), 1)

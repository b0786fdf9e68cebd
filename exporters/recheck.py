"""``higherpair verify``: files on disk against the part that the report beside them names."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from exporters.report import NAME, read_report
from exporters.verify import Verdict, verify_file
from parts.scene import make_parts, scene_from_resolved
from parts.schema import SceneError


@dataclass(frozen=True, slots=True)
class Recheck:
    """The verdict on one file; ``same_bytes``: it is the very file that was reported."""

    file: Path
    verdict: Verdict
    declared: float
    tolerance: float
    same_bytes: bool


def recheck(file: Path) -> Recheck:
    """Hold one file against its report.

    Raises
    ------
    SceneError
        There is no such file, or no report that knows it.
    """
    if not file.is_file():
        raise SceneError(str(file), "", None, "no such file")
    report = read_report(file.parent)
    if report is None:
        raise SceneError(str(file), "", None, f"no {NAME} beside it; build the scene again to get one")
    entries = {e.get("path"): e for e in report.get("files", []) if isinstance(e, dict)}
    entry = entries.get(file.name)
    if entry is None:
        raise SceneError(
            str(file), "", None, f"not named in {NAME}; it knows: {', '.join(map(str, entries)) or 'no file'}"
        )
    return _against(file, report, entry)


def _against(file: Path, report: dict[str, Any], entry: dict[str, Any]) -> Recheck:
    source = str(file.parent / NAME)
    try:
        scene = scene_from_resolved(report["scene"], source)
        part = make_parts(scene, source)[entry["part"]]
        region = part.section(float(entry["offset"])).region
        declared, tolerance, kind = float(entry["max_error"]), float(entry["tolerance"]), entry["format"]
        verdict = verify_file(file, kind, region, part.face_width, declared, tolerance)
        same = hashlib.sha256(file.read_bytes()).hexdigest() == entry["sha256"]
    except (KeyError, TypeError, AttributeError) as error:
        raise SceneError(source, "", None, f"is damaged ({error}); build the scene again") from error
    return Recheck(file, verdict, declared, tolerance, same)

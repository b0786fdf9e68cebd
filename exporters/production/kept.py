"""Files of an earlier build that keep their place because the new ones of their name failed their read-back."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from exporters.production.moving import hash_of
from parts.base.texts import N_, words

_FITS = N_("{path} in the folder is of an earlier build of this same scene; it was not replaced")
_OUTDATED = N_("{path} in the folder is of an EARLIER build and does not fit this scene: do not make a part from it")


def kept_file(file: Path, scene: dict[str, Any], before: dict[str, Any] | None) -> dict[str, Any] | None:
    """What a report says of a file that stays where a failed one should have come; None where there is none.

    ``before``: the report of the earlier build. ``fits_scene``: it vouches for these very bytes, for the same
    ``scene`` as resolved.
    """
    if not file.is_file():
        return None
    digest = hash_of(file)
    vouched: list[tuple[str, str]] = []
    if before is not None and before.get("scene") == scene:
        vouched = [(entry["path"], entry["sha256"]) for entry in before["files"]]
        kept = [(failed["path"], failed.get("kept")) for failed in before["failed"]]
        vouched += [(path, entry["sha256"]) for path, entry in kept if entry and entry["fits_scene"]]
    fits = (file.name, digest) in vouched
    return {"bytes": file.stat().st_size, "sha256": digest, "fits_scene": fits}


def kept_lines(report: dict[str, Any] | None, language: str) -> list[str]:
    """A line for each kept file of a report."""
    lines = []
    for failed in (report or {}).get("failed", []):
        if (kept := failed.get("kept")) is not None:
            text = _FITS if kept["fits_scene"] else _OUTDATED
            lines.append(words(language).text(text, path=failed["path"]))
    return lines


def failure_of(report: dict[str, Any], name: str) -> tuple[str, bool] | None:
    """Why the last build of a file failed, and whether what lies in its place is of the same scene.

    None for any other file: ``verify`` cannot vouch for this one.
    """
    for failed in report.get("failed", []):
        if failed.get("path") == name:
            kept = failed.get("kept") or {}
            return "; ".join(failed.get("failures", [])), bool(kept.get("fits_scene"))
    return None

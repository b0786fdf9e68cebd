"""STEP files: the text of parts/solids/step_text.py, and what is in it."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from parts.solids.step_text import Occurrence, StepForm, StepPart, assembly_text, part_text

_COUNTED = ("CYLINDRICAL_SURFACE", "SURFACE_OF_LINEAR_EXTRUSION", "PLANE", "MANIFOLD_SOLID_BREP")


def write_step(file: Path, part: StepPart, form: StepForm) -> dict[str, int]:
    """Write one named solid; counts entities of the file by kind."""
    return _written(file, part_text(part, form))


def write_step_assembly(
    file: Path, name: str, parts: Sequence[StepPart], occurrences: Sequence[Occurrence], form: StepForm
) -> dict[str, int]:
    """Write one product per part and its occurrences; counts entities of the file by kind."""
    return _written(file, assembly_text(name, parts, occurrences, form))


def _written(file: Path, text: str) -> dict[str, int]:
    file.write_bytes(text.encode("ascii"))
    return {kind: text.count(f"={kind}(") for kind in _COUNTED}

"""STEP files: the text of parts/solids/step_text.py, and what is in it."""

from __future__ import annotations

from pathlib import Path

from parts.solids.step_text import StepForm, StepGroup, StepPart, step_text

_COUNTED = ("CYLINDRICAL_SURFACE", "SURFACE_OF_LINEAR_EXTRUSION", "PLANE", "MANIFOLD_SOLID_BREP")


def write_step(file: Path, product: StepPart | StepGroup, form: StepForm) -> dict[str, int]:
    """Write a solid or an assembly; counts entities of the file by kind."""
    text = step_text(product, form)
    file.write_bytes(text.encode("ascii"))
    return {kind: text.count(f"={kind}(") for kind in _COUNTED}

"""What a sheet must hold, for its read-back to be measured against."""

from __future__ import annotations

from typing import Protocol

from geometry.base.findings import Finding
from geometry.base.record import Record, field
from geometry.curves.curve import Curve
from parts.drawing.canvas import Canvas, Paper
from parts.drawing.readback import ReadSheet, Taken


class Measures(Protocol):
    """What else is measured off a sheet of one family of parts."""

    def check(self, sheet: ReadSheet, taken: Taken) -> None:
        """Add what is measured, and what is wrong."""
        ...


class Circle(Record):
    """A circle that must be there; without a centre a horizontal line at the height ``radius``; mm on paper."""

    layer: str
    centre: complex | None
    radius: float


class Meshing(Record):
    """What must be measured off a picture of meshing, mm on paper.

    ``tangents``: centres and radii of the circles that the line of action touches; ``base_pitch`` is measured off the
    base circle of ``teeth`` teeth.
    """

    tangents: tuple[tuple[complex, float], ...]
    teeth: int
    active_length: float
    arc_length: float
    pitch_length: float
    contact_ratio: float


class Expected(Record):
    """All that a sheet must hold; ``curves`` are the exact ones of each layer in model mm, which ``paper`` places.

    ``has_view``: something is drawn to the scale of ``paper``, which the title block then tells; ``findings``: what a
    reader of the sheet should know.
    """

    canvas: Canvas
    paper: Paper
    circles: tuple[Circle, ...]
    curves: dict[str, list[Curve]] = field(default_factory=dict)
    meshing: Meshing | None = None
    measures: Measures | None = None
    has_view: bool = True
    findings: tuple[Finding, ...] = ()

"""One side of a tooth, or of a ring's space: what its segments have in common."""

from __future__ import annotations

from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.curves.curve import Curve, end_point, start_point
from geometry.plane.profile import Label, Segment


class Side(Record):
    """Segments of half a pitch, from the root to the tip, and what was noticed; ``pitch_angle`` in rad."""

    segments: tuple[Segment, ...]
    pitch_angle: float
    findings: tuple[Finding, ...] = ()

    def flanks(self, *, relief: bool = False) -> list[Curve]:
        """The main flank, and with ``relief`` that part too."""
        labels = (Label.FLANK, Label.RELIEF) if relief else (Label.FLANK,)
        return [s.curve for s in self.segments if s.label in labels]

    def flank_radii(self, *, relief: bool = False) -> tuple[float, float]:
        """Radii at which the involute gives way to the fillet and to the tip or what breaks it, mm."""
        curves = self.flanks(relief=relief)
        return abs(start_point(curves[0])), abs(end_point(curves[-1]))

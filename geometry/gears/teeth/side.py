"""One side of a tooth, or of a ring's space: what its segments have in common."""

from __future__ import annotations

import math
from typing import ClassVar

from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.line_arc import Arc
from geometry.plane.profile import Label, Profile, Segment


class Side(Record):
    """Segments of half a pitch, from the root to the tip, and what was noticed; ``pitch_angle`` in rad."""

    segments: tuple[Segment, ...]
    pitch_angle: float
    findings: tuple[Finding, ...] = ()

    # of a ring's space, whose hole runs clockwise
    clockwise: ClassVar[bool] = False

    def profile(self) -> Profile:
        """The closed outline: this side and its mirror image, both lands made whole, placed round the axis."""
        side, way = list(self.segments), -1 if self.clockwise else 1
        root = side.pop(0) if side[0].label is Label.ROOT_LAND else None
        tip = side.pop() if side[-1].label is Label.TIP_LAND else None
        mirrored = [Segment(s.curve.mirrored(), s.label) for s in reversed(side)]
        tips = [] if tip is None else [whole_land(tip, -self.pitch_angle / 2 if self.clockwise else 0.0, way)]
        roots = [] if root is None else [whole_land(root, 0.0 if self.clockwise else self.pitch_angle / 2, way)]
        period = [*mirrored, *roots, *side, *tips] if self.clockwise else [*side, *tips, *mirrored, *roots]
        return Profile(tuple(period), round(2 * math.pi / self.pitch_angle), self.clockwise)

    def flanks(self, *, relief: bool = False) -> list[Curve]:
        """The main flank, and with ``relief`` that part too."""
        labels = (Label.FLANK, Label.RELIEF) if relief else (Label.FLANK,)
        return [s.curve for s in self.segments if s.label in labels]

    def flank_radii(self, *, relief: bool = False) -> tuple[float, float]:
        """Radii at which the involute gives way to the fillet and to the tip or what breaks it, mm."""
        curves = self.flanks(relief=relief)
        return abs(start_point(curves[0])), abs(end_point(curves[-1]))


def whole_land(land: Segment, middle: float, way: int) -> Segment:
    """A half land about the axis made whole: as long on either side of the polar angle ``middle``."""
    low, high = land.curve.domain
    half = way * (high - low)
    return Segment(Arc(0j, abs(start_point(land.curve)), middle - half, 2 * half), land.label)

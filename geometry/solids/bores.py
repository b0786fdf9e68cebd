"""Bores as exact clockwise profiles of arcs and lines, with exact parallel curves of either sign.

An offset d > 0 mm narrows the bore. Every corner has one fixed point: a rounding of radius r keeps its centre and
becomes r - d, a sharp inner corner is cut off at the crossing (d > 0) or rounded about itself (d < 0); at a mouth,
where the material is convex, it is the other way round. So each bore is written down with d in its formulas.
"""

from __future__ import annotations

import cmath
import math
from typing import Protocol

from geometry.base.errors import Nearest, OffsetError, ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Profile, Segment, circle

# nearest offset that is named, as a share of the limit itself, at which a curve vanishes
_INSIDE = 1 - 1e-6


class Bore(Protocol):
    """A hole about the axis of a part."""

    @property
    def angle(self) -> float:
        """Direction in which it stands, rad; 0 of a round one, which has none."""

    @property
    def reach(self) -> float:
        """Greatest distance of the bore from the axis, mm; an offset d < 0 adds -d to it."""

    @property
    def size(self) -> tuple[str, object]:
        """The name and the value, mm or a designation, of what makes the bore larger."""

    def check(self) -> None:
        """Refuse a bore that cannot exist: ParameterError with the key's name below ``bore``."""

    def profile(self, offset: float = 0.0) -> Profile:
        """The clockwise boundary, moved ``offset`` mm out of the material; OffsetError where none is left."""

    def widened(self, depth: float) -> Bore:
        """The bore ``depth`` mm larger on all sides, sharp corners kept."""


def widened_corner(radius: float, depth: float) -> float:
    """Radius of a hole's inner corner that is cut ``depth`` mm deeper; a sharp one stays sharp."""
    return radius + depth if radius > 0 else 0.0


def within(offset: float, lowest: float, highest: float, reasons: tuple[str, str]) -> None:
    """Refuse an offset beyond the limits at which a curve vanishes, mm; ``reasons`` for the lower and the upper one."""
    if not math.isfinite(offset):
        raise OffsetError(offset, "not_finite")
    if offset >= highest:
        raise OffsetError(offset, reasons[1], highest * _INSIDE)
    if offset <= lowest:
        raise OffsetError(offset, reasons[0], lowest * _INSIDE)


def refuse_no_size(name: str, value: float) -> None:
    """Refuse a size that is no finite number above 0."""
    if not 0 < value < math.inf:
        raise ParameterError(name, value, "not_finite_above_zero")


class _Drilled(Record):
    """What round bores and those that begin as one have in common; mm."""

    diameter: float

    @property
    def reach(self) -> float:
        """See Bore."""
        return self.diameter / 2

    @property
    def size(self) -> tuple[str, float]:
        """See Bore."""
        return "bore.diameter", self.diameter

    def check(self) -> None:
        """See Bore."""
        refuse_no_size("bore.diameter", self.diameter)

    def _cut(self, way: list[Segment], offset: float, count: int, angle: float) -> Profile:
        """The circle with ``count`` cuts, each by a way as about +x, the first towards ``angle``, clockwise."""
        start, end = cmath.phase(end_point(way[-1].curve)), cmath.phase(start_point(way[0].curve))
        # from the end of one cut to the beginning of the next
        arc = Segment(Arc(0j, self.diameter / 2 - offset, start, end - start - 2 * math.pi / count), Label.BORE)
        turns = [Placement2(angle - 2 * math.pi * k / count) for k in range(count)]
        return Profile(tuple(Segment(s.curve.placed(turn), s.label) for turn in turns for s in (*way, arc)))


class RoundBore(_Drilled):
    """A circle; mm."""

    @property
    def angle(self) -> float:
        """See Bore."""
        return 0.0

    def profile(self, offset: float = 0.0) -> Profile:
        """See Bore."""
        within(offset, -math.inf, self.reach, ("", "closes_bore"))
        return circle(self.reach - offset, Label.BORE, hole=True)

    def widened(self, depth: float) -> RoundBore:
        """A larger circle."""
        return RoundBore(self.diameter + 2 * depth)


class KeywayBore(_Drilled):
    """A round bore with one keyway or two opposite ones; mm, rad.

    ``depth`` is t2: the bottom stands diameter + t2 from the opposite side of the bore. ``angle``: direction of the
    first keyway. ``corner_radius`` rounds the bottom's corners; 0 leaves them sharp.
    """

    width: float
    depth: float
    corner_radius: float = 0.0
    keys: int = 1
    angle: float = 0.0

    @property
    def _bottom(self) -> float:
        """Distance of the keyway's bottom from the axis."""
        return self.diameter / 2 + self.depth

    @property
    def _mouth(self) -> complex:
        """The mouth's corner on the left side of a keyway along +x: the one convex corner of the material."""
        half, radius = self.width / 2, self.diameter / 2
        return complex(math.sqrt((radius - half) * (radius + half)), half)

    @property
    def _corner_centre(self) -> complex:
        return complex(self._bottom - self.corner_radius, self.width / 2 - self.corner_radius)

    @property
    def reach(self) -> float:
        """See Bore."""
        return abs(self._corner_centre) + self.corner_radius

    def check(self) -> None:
        """See Bore."""
        super().check()
        for name in ("width", "depth"):
            refuse_no_size(f"bore.{name}", getattr(self, name))
        if self.keys not in (1, 2):
            raise ParameterError("bore.keys", self.keys, "one_or_two_keyways", Nearest(1))
        if not self.width < self.diameter:
            raise ParameterError("bore.width", self.width, "keyway_as_wide_as_bore")
        wall = self._bottom - self._mouth.real
        if not 0 <= self.corner_radius <= self.width / 2 or not self.corner_radius < wall:
            raise ParameterError("bore.corner_radius", self.corner_radius, "no_room_in_keyway")

    def widened(self, depth: float) -> KeywayBore:
        """A larger bore with a wider keyway, as deep in the material as before."""
        corner = widened_corner(self.corner_radius, depth)
        return replace(self, diameter=self.diameter + 2 * depth, width=self.width + 2 * depth, corner_radius=corner)

    def profile(self, offset: float = 0.0) -> Profile:
        """See Bore."""
        closes = min(self.width / 2, self._bottom - self._mouth.real)
        # the grown circle reaches the bottom's rounding: (R + e)^2 - (b/2 + e)^2 = (R + t2 - r)^2
        slack = (self._corner_centre.real - self._mouth.real) * (self._corner_centre.real + self._mouth.real)
        swallowed = -slack / (self.diameter - self.width)
        within(offset, swallowed, closes, ("swallows_keyway", "closes_keyway"))
        return self._cut(self._way(offset), offset, self.keys, self.angle)

    def _way(self, offset: float) -> list[Segment]:
        """Into the keyway along +x and out again: mouth, wall, corner, bottom, and the same mirrored."""
        bore, half, bottom = self.diameter / 2 - offset, self.width / 2 - offset, self._bottom - offset
        radius = max(self.corner_radius - offset, 0.0)
        side: list[Segment] = []
        mouth = self._mouth
        if offset > 0:
            angle = cmath.phase(mouth)
            side.append(Segment(Arc(mouth, offset, angle + math.pi, math.pi / 2 - angle), Label.CORNER))
            begin = complex(mouth.real, half)
        else:
            begin = complex(math.sqrt((bore - half) * (bore + half)), half)
        side.append(Segment(Line(begin, complex(bottom - radius, half)), Label.KEYWAY))
        if radius > 0:
            side.append(
                Segment(Arc(complex(bottom - radius, half - radius), radius, math.pi / 2, -math.pi / 2), Label.CORNER)
            )
        across: list[Segment] = []
        if half - radius > TOLERANCES.relative_length * bottom:
            corner = complex(bottom, half - radius)
            across.append(Segment(Line(corner, corner.conjugate()), Label.KEYWAY))
        return [*side, *across, *(Segment(s.curve.mirrored(), s.label) for s in reversed(side))]


class FlatBore(_Drilled):
    """A round bore with one flat (D) or two opposite ones (double D); mm, rad.

    ``flat_distance``: from the axis to a flat. ``angle``: direction from the axis to the first flat.
    """

    flat_distance: float
    flats: int = 1
    angle: float = 0.0

    def check(self) -> None:
        """See Bore."""
        super().check()
        name = "bore.flat" if self.flats == 1 else "bore.across_flats"
        given = self.flat_distance + self.diameter / 2 if self.flats == 1 else 2 * self.flat_distance
        if not self.flat_distance > 0:
            raise ParameterError(name, given, "flat_beyond_axis")
        if not self.flat_distance < self.diameter / 2:
            raise ParameterError(name, given, "flat_outside_bore")

    def widened(self, depth: float) -> FlatBore:
        """A larger bore, its flats farther out."""
        return replace(self, diameter=self.diameter + 2 * depth, flat_distance=self.flat_distance + depth)

    def profile(self, offset: float = 0.0) -> Profile:
        """See Bore."""
        opposite = self.diameter / 2 if self.flats == 1 else self.flat_distance
        within(offset, -math.inf, (self.flat_distance + opposite) / 2, ("", "closes_bore"))
        return self._cut(self._way(offset), offset, self.flats, self.angle)

    def _way(self, offset: float) -> list[Segment]:
        """Along the flat at +x, with the arcs about its corners where the bore has grown."""
        radius, flat = self.diameter / 2, self.flat_distance
        if offset >= 0:
            radius, flat = radius - offset, flat - offset
            corner = complex(flat, math.sqrt((radius - flat) * (radius + flat)))
            return [Segment(Line(corner, corner.conjugate()), Label.FLAT)]
        corner = complex(flat, math.sqrt((radius - flat) * (radius + flat)))
        angle = cmath.phase(corner)
        begin = corner - offset
        return [
            Segment(Arc(corner, -offset, angle, -angle), Label.CORNER),
            Segment(Line(begin, begin.conjugate()), Label.FLAT),
            Segment(Arc(corner.conjugate(), -offset, 0.0, -angle), Label.CORNER),
        ]


class PolygonBore(Record):
    """A regular polygon, as a hexagon (6 sides) or square (4); mm, rad.

    ``angle``: direction from the axis to the middle of the first side.
    """

    sides: int
    across_flats: float
    corner_radius: float = 0.0
    angle: float = 0.0

    @property
    def reach(self) -> float:
        """See Bore."""
        return self._corner_distance(0.0)[0] + self.corner_radius

    def _corner_distance(self, offset: float) -> tuple[float, float]:
        """Distance of a corner's rounding centre from the axis, and its radius (0: the sharp corner itself)."""
        radius = max(self.corner_radius - offset, 0.0)
        return (self.across_flats / 2 - offset - radius) / math.cos(math.pi / self.sides), radius

    @property
    def size(self) -> tuple[str, float]:
        """See Bore."""
        return "bore.across_flats", self.across_flats

    def check(self) -> None:
        """See Bore."""
        refuse_no_size("bore.across_flats", self.across_flats)
        if not 0 <= self.corner_radius < self.across_flats / 2:
            raise ParameterError("bore.corner_radius", self.corner_radius, "roundings_leave_no_side")

    def widened(self, depth: float) -> PolygonBore:
        """A larger polygon."""
        corner = widened_corner(self.corner_radius, depth)
        return replace(self, across_flats=self.across_flats + 2 * depth, corner_radius=corner)

    def profile(self, offset: float = 0.0) -> Profile:
        """See Bore."""
        within(offset, -math.inf, self.across_flats / 2, ("", "closes_bore"))
        apothem, half = self.across_flats / 2 - offset, math.pi / self.sides
        distance, radius = self._corner_distance(offset)
        length = distance * math.sin(half)
        side = [Segment(Line(complex(apothem, length), complex(apothem, -length)), Label.FLAT)]
        if radius > 0:
            side.append(Segment(Arc(cmath.rect(distance, -half), radius, 0.0, -2 * half), Label.CORNER))
        turns = [Placement2(self.angle - 2 * half * k) for k in range(self.sides)]
        return Profile(tuple(Segment(s.curve.placed(turn), s.label) for turn in turns for s in side))

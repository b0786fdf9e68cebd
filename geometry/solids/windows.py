"""Holes beside the axis as exact clockwise profiles: round holes on a pitch circle, windows between spokes."""

from __future__ import annotations

import cmath
import math

from geometry.base.errors import Nearest, ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Profile, Segment, circle
from geometry.solids.bores import refuse_no_size, widened_corner, within


class RoundHoles(Record):
    """``count`` equal round holes on a pitch circle, the first at ``start`` rad; mm. A bolt circle is the same."""

    count: int
    diameter: float
    pitch_circle_diameter: float
    start: float = 0.0

    @property
    def reach(self) -> float:
        """Greatest distance of a hole from the axis, mm."""
        return (self.pitch_circle_diameter + self.diameter) / 2

    def centres(self) -> list[complex]:
        """Centre of each hole."""
        step = 2 * math.pi / self.count
        return [cmath.rect(self.pitch_circle_diameter / 2, self.start + k * step) for k in range(self.count)]

    def wall_between(self) -> float:
        """Material between neighbours, mm: the chord of the pitch circle less a diameter."""
        if self.count == 1:
            return math.inf
        return self.pitch_circle_diameter * math.sin(math.pi / self.count) - self.diameter

    def check(self, key: str) -> None:
        """Refuse holes that cannot exist; ``key``: the name of the table."""
        if self.count < 1:
            raise ParameterError(f"{key}.count", self.count, "too_few", Nearest(1, "at_least"))
        for name in ("diameter", "pitch_circle_diameter"):
            refuse_no_size(f"{key}.{name}", getattr(self, name))

    def profiles(self, offset: float = 0.0) -> tuple[Profile, ...]:
        """One profile a hole, moved ``offset`` mm out of the material."""
        within(offset, -math.inf, self.diameter / 2, ("", "closes_holes"))
        radius = self.diameter / 2 - offset
        return tuple(circle(radius, Label.HOLE, hole=True, centre=centre) for centre in self.centres())


class HoleCircle(Record):
    """Equal holes on a circle about the origin: both diameters, mm, and the direction of each hole, rad."""

    diameter: float
    circle: float
    angles: tuple[float, ...]

    def centres(self) -> list[complex]:
        """Where they stand, mm."""
        return [cmath.rect(self.circle / 2, angle) for angle in self.angles]


class Spokes(Record):
    """``count`` straight spokes of ``width`` between a hub ring and a rim, the first along ``start`` rad; mm.

    A window is bounded by both circles and the sides of two spokes, its four corners rounded.
    """

    count: int
    inner_diameter: float
    outer_diameter: float
    width: float
    corner_radius: float = 0.0
    start: float = 0.0

    @property
    def reach(self) -> float:
        """Greatest distance of a window from the axis, mm."""
        return self.outer_diameter / 2

    def folded(self, point: complex) -> complex:
        """A point turned by whole spokes into the sector of the first window."""
        step = 2 * math.pi / self.count
        return point * cmath.rect(1.0, -step * math.floor((cmath.phase(point) - self.start) / step))

    def check(self, key: str) -> None:
        """Refuse spokes that leave no window of four sides; ``key``: the name of the table."""
        if self.count < 2:
            raise ParameterError(f"{key}.count", self.count, "too_few", Nearest(2, "at_least"))
        for name in ("inner_diameter", "outer_diameter", "width"):
            refuse_no_size(f"{key}.{name}", getattr(self, name))
        if not self.inner_diameter < self.outer_diameter:
            raise ParameterError(f"{key}.inner_diameter", self.inner_diameter, "reaches_outer_diameter")
        radius, room = self.corner_radius, (self.outer_diameter - self.inner_diameter) / 4
        sine = math.sin(math.pi / self.count)
        if not self.width / 2 < self.inner_diameter / 2 * sine:
            raise ParameterError(f"{key}.width", self.width, "spokes_fill_hub_ring")
        if not 0 <= radius < room or not self.width / 2 + radius < (self.inner_diameter / 2 + radius) * sine:
            raise ParameterError(f"{key}.corner_radius", radius, "no_room_in_window")

    def widened(self, depth: float) -> Spokes:
        """Windows ``depth`` mm larger on all sides, sharp corners kept."""
        return replace(
            self,
            inner_diameter=self.inner_diameter - 2 * depth,
            outer_diameter=self.outer_diameter + 2 * depth,
            width=self.width - 2 * depth,
            corner_radius=widened_corner(self.corner_radius, depth),
        )

    def profiles(self, offset: float = 0.0) -> tuple[Profile, ...]:
        """One profile a window, moved ``offset`` mm out of the material."""
        half = math.pi / self.count
        closes = (self.outer_diameter - self.inner_diameter) / 4
        if (slope := 1 - math.sin(half)) > 0:
            # the sides meet on the hub ring: w/2 + d = (R_i + d) sin(pi/n)
            closes = min(closes, (self.inner_diameter / 2 * math.sin(half) - self.width / 2) / slope)
        swallowed = -min(self.width, self.inner_diameter) / 2
        within(offset, max(swallowed, -self.inner_diameter / 2), closes, ("leaves_no_spoke", "closes_windows"))
        window = self._window(offset)
        turns = [Placement2(self.start + half + 2 * half * k) for k in range(self.count)]
        return tuple(Profile(tuple(Segment(s.curve.placed(turn), s.label) for s in window)) for turn in turns)

    def _window(self, offset: float) -> list[Segment]:
        """The window about +x: along the spoke above it outwards, down the rim, inwards, and up the hub ring."""
        radius = max(self.corner_radius - offset, 0.0)
        outer, inner = self.outer_diameter / 2 - offset, self.inner_diameter / 2 + offset
        side = self.width / 2 + offset + radius
        turn = cmath.rect(1.0, math.pi / self.count)
        centres = [turn * complex(math.sqrt((r - side) * (r + side)), -side) for r in (inner + radius, outer - radius)]
        # points where the side touches both roundings
        feet = [c + 1j * turn * radius for c in centres]
        upper = [Segment(Line(feet[0], feet[1]), Label.WINDOW)]
        low, high = (cmath.phase(c) for c in centres)
        normal = cmath.phase(1j * turn)
        if radius > 0:
            upper.insert(0, Segment(Arc(centres[0], radius, low + math.pi, normal - low - math.pi), Label.CORNER))
            upper.append(Segment(Arc(centres[1], radius, normal, high - normal), Label.CORNER))
        lower = [Segment(s.curve.mirrored(), s.label) for s in reversed(upper)]
        rim = Segment(Arc(0j, outer, high, -2 * high), Label.WINDOW)
        hub = Segment(Arc(0j, inner, -low, 2 * low), Label.WINDOW)
        return [*upper, rim, *lower, hub]

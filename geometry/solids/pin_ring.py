"""The inner boundary of a ring that holds round pins: half-round seats for loose pins, or pins of one piece with it."""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

import numpy as np

from geometry.base.errors import CuspError, OffsetError
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.curve import Curve, end_point
from geometry.curves.line_arc import Arc
from geometry.plane.profile import Label, Profile, Region, Segment, circle, joint_turn
from geometry.solids.hub_holes import HubHoles
from geometry.solids.windows import RoundHoles


class SeatCircle(Record):
    """A round hole of ``inner_radius`` mm with ``count`` round pins or seats of ``seat_radius``, mm, on a circle.

    ``fixed``: the pins belong to the material and stand into the hole; else they are seats cut into it. The first
    is centred on +x.
    """

    count: int
    circle_radius: float
    seat_radius: float
    inner_radius: float
    fixed: bool

    @property
    def _crossing(self) -> complex:
        """Where the first seat crosses the hole, seen from the seat's centre, mm; NaN where it does not.

        Heron's product has no cancellation where the seat is small.
        """
        r, s, i = self.circle_radius, self.seat_radius, self.inner_radius
        square = (s + i - r) * (s + r - i) * (i + r - s) * (i + r + s)
        if not square > 0:
            return complex(math.nan, math.nan)
        return complex((i - r) * (i + r) - s * s, math.sqrt(square)) / (2 * r)

    @property
    def half_angle(self) -> float:
        """Half of the angle that a seat takes of the hole, rad; NaN where the two circles do not cross."""
        return cmath.phase(self.circle_radius + self._crossing)

    @property
    def is_whole(self) -> bool:
        """Whether seats and hole cross, and something of the hole is left between neighbours."""
        return self.inner_radius > 0 and self.seat_radius > 0 and self.half_angle < math.pi / self.count

    def least_inner_radius(self) -> float:
        """The hole is larger than this: seats cross it, and neighbours leave something of it between them, mm."""
        # where neighbours meet, the crossing stands on the middle between two centres
        half = math.pi / self.count
        chord = self.circle_radius * math.sin(half)
        if chord >= self.seat_radius:
            return self.circle_radius - self.seat_radius
        return self.circle_radius * math.cos(half) + math.sqrt(self.seat_radius**2 - chord**2)

    def greatest_inner_radius(self) -> float:
        """The hole is smaller than this, mm."""
        return self.circle_radius + self.seat_radius

    def _arcs(self) -> tuple[Arc, Arc]:
        """The first seat, and the hole from it to the next one, clockwise."""
        angle = self.half_angle
        spoke = cmath.phase(self._crossing)
        sweep = 2 * math.pi - 2 * spoke if self.fixed else -2 * spoke
        seat = Arc(complex(self.circle_radius), self.seat_radius, spoke, sweep)
        return seat, Arc(0j, self.inner_radius, -angle, 2 * angle - 2 * math.pi / self.count)

    def moved(self, offset: float) -> SeatCircle:
        """Both circles moved ``offset`` mm out of the material, met anew where they cross."""
        seat = self.seat_radius + (offset if self.fixed else -offset)
        return replace(self, seat_radius=seat, inner_radius=self.inner_radius - offset)

    def profile(self, offset: float = 0.0) -> Profile:
        """The clockwise boundary, moved ``offset`` mm out of the material; corners that open get their arc.

        Raises
        ------
        OffsetError
            Seats or pins do not survive; the nearest offset is for the caller to find.
        """
        label = Label.PIN if self.fixed else Label.HOLE
        # seats meet the hole in convex corners, pins in hollow ones
        if offset == 0 or (offset > 0) == self.fixed:
            here = self.moved(offset)
            if not here.is_whole:
                raise OffsetError(offset, "closes_ring_between_pins")
            seat, land = here._arcs()
            return Profile((*_quarters(seat, label), Segment(land, Label.RIM)), self.count, clockwise=True)
        seat, land = self._arcs()
        following = seat.placed(Placement2(-2 * math.pi / self.count))
        try:
            chain = [
                *_quarters(seat.offset(-offset), label),
                Segment(_corner(seat, land, offset), Label.CORNER),
                Segment(land.offset(-offset), Label.RIM),
                Segment(_corner(land, following, offset), Label.CORNER),
            ]
        except CuspError:
            raise OffsetError(offset, "closes_seats") from None
        return Profile(tuple(chain), self.count, clockwise=True)


def _quarters(arc: Arc, label: Label) -> list[Segment]:
    """An arc in pieces of a quarter turn at most: the ends of a half turn do not tell a file where its middle is."""
    parts = math.ceil(abs(arc.sweep) / (math.pi / 2) - 1e-9)
    places = np.linspace(0.0, abs(arc.sweep), parts + 1).tolist()
    return [Segment(arc.trimmed(a, b), label) for a, b in pairwise(places)]


def _corner(before: Curve, after: Curve, offset: float) -> Arc:
    """The arc about a corner between two moved curves."""
    arriving = cmath.phase(complex(before.tangent(before.domain[1])))
    start = arriving - math.copysign(math.pi / 2, offset)
    return Arc(end_point(before), abs(offset), start, joint_turn(before, after))


# share of the room for the inside of a ring that it keeps from either end of it
_HOLD = 0.02


class PinRing(Record):
    """A ring with its pins, lengths in mm; ``inner_radius`` 0: a plate without a bore. ``holes``: those in its rim."""

    number_of_pins: int
    pin_circle_radius: float
    pin_radius: float
    seat_radius: float
    inner_radius: float
    outer_radius: float
    pins: str
    holes: HubHoles
    face_width: float = 0.0

    @property
    def seats(self) -> SeatCircle:
        """The inner boundary of a ring, not of a plate with holes."""
        seat = self.pin_radius if self.pins == "fixed" else self.seat_radius
        return SeatCircle(self.number_of_pins, self.pin_circle_radius, seat, self.inner_radius, self.pins == "fixed")

    @property
    def tip_radius(self) -> float:
        """Where the ring ends inwards, mm, as the teeth of one do."""
        return self.inner_radius

    @property
    def inner_limits(self) -> tuple[float, float]:
        """Radii of the inside between which the pins have their hold, mm."""
        low, high = self.seats.least_inner_radius(), self.seats.greatest_inner_radius()
        return low + _HOLD * (high - low), high - _HOLD * (high - low)

    @property
    def pin_holes(self) -> RoundHoles:
        """The holes of a plate."""
        return RoundHoles(self.number_of_pins, 2 * self.seat_radius, 2 * self.pin_circle_radius)

    @property
    def takes_loose_pins(self) -> bool:
        """Whether the pins are parts of their own."""
        return self.pins != "fixed"

    def pin_centres(self) -> list[complex]:
        """Where the pins stand, the first on +x, mm."""
        return self.pin_holes.centres()

    @property
    def rim_radius(self) -> float:
        """The material between pins and outside begins here, mm."""
        if self.pins == "fixed":
            return self.inner_radius
        return max(self.inner_radius, self.pin_circle_radius + self.seat_radius)

    def region(self, offset: float) -> Region:
        """The section, moved ``offset`` mm out of the material.

        Raises
        ------
        OffsetError
            A seat, a hole or a wall does not survive.
        """
        if -2 * offset >= self.least_wall():
            raise OffsetError(offset, "leaves_no_rim")
        if self.pins == "holes":
            inner: tuple[Profile, ...] = self.pin_holes.profiles(offset)
            if self.inner_radius > 0:
                if offset >= self.inner_radius:
                    raise OffsetError(offset, "closes_ring")
                inner = (circle(self.inner_radius - offset, Label.RIM, hole=True), *inner)
        else:
            inner = (self.seats.profile(offset),)
        return Region(circle(self.outer_radius + offset, Label.BODY), (*inner, *self.holes.profiles(offset)))

    def least_wall(self) -> float:
        """Thinnest wall outside the pins, and between the pins' holes, mm."""
        walls = [self.outer_radius - self.rim_radius]
        for group in self.holes.round_holes:
            inner = (group.pitch_circle_diameter - group.diameter) / 2
            walls += [self.outer_radius - group.reach, inner - self.rim_radius, group.wall_between()]
        if self.pins == "holes":
            walls.append(self.pin_holes.wall_between())
            if self.inner_radius > 0:
                walls.append(self.pin_circle_radius - self.seat_radius - self.inner_radius)
        return min(walls)

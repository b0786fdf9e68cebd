"""Round holes across a hub, as for set screws: where they open in hub and bore, and whether they fit there."""

from __future__ import annotations

import cmath
import itertools
import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geometry.base.errors import Nearest, OffsetError, ParameterError, limit
from geometry.base.nearest import nearest
from geometry.base.record import Record, replace
from geometry.curves.curve import Curve, Real
from geometry.curves.line_arc import Arc, Line

if TYPE_CHECKING:
    from geometry.curves.bspline import BSpline
    from geometry.solids.bores import Bore

# what is one place, part of the size; of a bore's radius, that of a hole in it at most; of a hole, one that is none
_SAME, _MOST_SHARE, _LEAST_SHARE = 1e-9, 0.95, 1e-3


class CrossHole(Record):
    """A hole whose axis stands across that of the wheel: its height and radius, mm, and its direction, rad."""

    height: float
    radius: float
    angle: float

    def moved(self, offset: float) -> CrossHole:
        """With its wall moved ``offset`` mm out of the material; OffsetError where none is left."""
        if not offset < self.radius:
            raise OffsetError(offset, "closes_set_screws", self.radius * (1 - _LEAST_SHARE))
        return replace(self, radius=self.radius - offset)


class Mouth(NamedTuple):
    """Where a hole opens in an upright wall: the curve of its period and the place that hold it.

    ``away``: the wall's distance from the axis, mm; ``is_round``: it is a cylinder about that, else a plane.
    """

    curve: int
    place: int
    away: float
    is_round: bool

    def half_angle(self, radius: float) -> float:
        """Half of the angle that a hole of a radius, mm, takes of the wall, as seen from the axis, rad."""
        return math.asin(radius / self.away) if self.is_round else math.atan(radius / self.away)

    def rise(self, across: Real) -> Real:
        """How far the wall is from the plane through both axes' normal, at places beside the axis of the hole, mm."""
        return np.sqrt(self.away**2 - across**2) if self.is_round else np.full(across.shape, self.away)


def mouth_in(curves: Sequence[Curve | BSpline], turns: Sequence[float], hole: CrossHole) -> Mouth | None:
    """Where a hole opens in a boundary: all of it in one cylinder about the axis, or in one plane across it; else None.

    ``turns``: the places of a period's curves, rad.
    """
    for i, curve in enumerate(curves):
        for j, turn in enumerate(turns):
            to_hole = cmath.exp(1j * (turn - hole.angle))
            if not isinstance(curve, Arc | Line):
                continue
            ends = [to_hole * complex(curve.point(t)) for t in curve.domain]
            if isinstance(curve, Arc) and abs(curve.centre) <= _SAME * curve.radius > _SAME * hole.radius:
                if hole.radius >= curve.radius:
                    continue
                half, way = math.asin(hole.radius / curve.radius), math.copysign(1.0, curve.sweep)
                passed = -way * cmath.phase(ends[0]) % math.tau
                if half < passed < abs(curve.sweep) - half:
                    return Mouth(i, j, curve.radius, True)
            elif isinstance(curve, Line) and abs(ends[0].real - ends[1].real) <= _SAME * abs(ends[0]):
                low, high = sorted(end.imag for end in ends)
                if ends[0].real > 0 and low < -hole.radius and hole.radius < high:
                    return Mouth(i, j, ends[0].real, False)
    return None


def open_circle(radius: float, angle: float) -> Arc:
    """A circle about the axis, counter-clockwise and cut open opposite an angle, rad."""
    return Arc(0j, radius, angle - math.pi, math.tau)


def mouth_in_bore(bore: Bore, hole: CrossHole) -> Mouth | None:
    """Where a hole opens in a bore, if in one face of it."""
    segments = [segment.curve for segment in bore.profile().segments()]
    if all(isinstance(curve, Arc) and not curve.centre for curve in segments):
        segments = [open_circle(bore.reach, hole.angle)]
    return mouth_in(segments, (0.0,), hole)


def _seat(bore: Bore, hole: CrossHole) -> Mouth | None:
    """Where a hole opens in a bore that is wider than it."""
    found = mouth_in_bore(bore, hole)
    return None if found is None or (found.is_round and hole.radius > _MOST_SHARE * found.away) else found


def _has_seat(bore: Bore, hole: CrossHole, size: float) -> bool:
    return _seat(bore, replace(hole, radius=size / 2)) is not None


def check_cross_holes(
    holes: Sequence[CrossHole], bore: Bore | None, ends: tuple[float, float], chamfer: float, wall: float
) -> None:
    """Refuse holes that a hub, which stands free between two heights, the last its face, has no room for.

    ``chamfer``: of its face, ``wall``: the least beside a hole; mm.

    Raises
    ------
    ParameterError
        Names the key and the nearest value that works.
    """
    if bore is None:
        raise ParameterError("hub.set_screws", None, "set_screws_without_bore")
    foot, end = ends
    length, way = abs(end - foot), math.copysign(1.0, end - foot)
    room = length - chamfer - 2 * wall
    narrow = []
    for hole in holes:
        size = 2 * hole.radius
        if not size <= room:
            raise ParameterError("hub.set_screws.diameter", size, "set_screws_wider_than_hub", limit(room, size))
        inset = way * (end - hole.height)
        least, most = chamfer + hole.radius + wall, length - hole.radius - wall
        if not least * (1 - _SAME) <= inset <= most * (1 + _SAME):
            near = limit(least if inset < least else most, inset)
            raise ParameterError("hub.set_screws.from_end", inset, "set_screws_out_of_hub", near)
        mouth = _seat(bore, hole)
        if mouth is None:
            refusal = ParameterError("hub.set_screws.angle_deg", math.degrees(hole.angle), "set_screw_beside_flat")
            narrower = partial(_has_seat, bore, hole)
            if narrower(_LEAST_SHARE * size):
                cure = partial(nearest, narrower, size, 0.0)
                refusal = ParameterError("hub.set_screws.diameter", size, "set_screws_wider_than_bore", cure)
            raise refusal
        narrow.append(mouth.half_angle(hole.radius) + wall / mouth.away / 2)
    _check_apart([hole.angle for hole in holes], narrow)


def _check_apart(angles: Sequence[float], half: Sequence[float]) -> None:
    """Refuse holes whose mouths meet: the spacing of two, else their count; ``half`` of each with a wall, rad."""
    for j, i in itertools.product(range(len(angles)), repeat=2):
        given = angles[j] - angles[i]
        turned, least = math.remainder(given, math.tau), half[i] + half[j]
        if i >= j or abs(turned) >= least * (1 - _SAME):
            continue
        if j > 1:
            raise ParameterError("hub.set_screws.count", len(angles), "set_screws_meet", Nearest(j, "at_most"))
        typed, near = (round(math.degrees(a), 9) for a in (given, given - turned + math.copysign(least, turned)))
        raise ParameterError("hub.set_screws.spacing_deg", typed, "set_screws_meet", limit(near, typed))

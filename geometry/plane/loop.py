"""A taut line round any number of circles, each inside of its loop or outside of it: a belt about pulleys and idlers.

It runs clockwise round what is inside, the other way round what is outside. Lengths in mm, angles in rad.
"""

from __future__ import annotations

import cmath
import math
from functools import cached_property
from itertools import combinations

import numpy as np

from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import lines_cross

_TURN = 2 * math.pi
# part of a radius by which a strand may run into a circle
_SAME = 1e-9
# how often a way is doubled until it is far enough
_DOUBLED = 60


class Wheel(Record):
    """A circle that a loop goes about; ``rim``: the radius of the body within it, 0 where none is told."""

    centre: complex
    radius: float
    outside: bool = False
    rim: float = 0.0

    @property
    def side(self) -> float:
        """Of its circle to the left of the line that leaves it: the radius, below 0 of one outside."""
        return -self.radius if self.outside else self.radius


class Loop(Record, dict=True):
    """A line about ``wheels`` in the order in which it comes to them; ways along it begin where it leaves the first."""

    wheels: tuple[Wheel, ...]

    @cached_property
    def ways(self) -> tuple[complex, ...]:
        """Directions of the strands, the one behind each wheel."""
        found = []
        for one, two in zip(self.wheels, (*self.wheels[1:], self.wheels[0]), strict=True):
            apart, step = two.side - one.side, two.centre - one.centre
            # the strand and what the sides differ by make up the step between the centres
            along = math.sqrt(max(abs(step) ** 2 - apart**2, 0.0))
            way = step / complex(along, -apart)
            found.append(way / abs(way))
        return tuple(found)

    @cached_property
    def strands(self) -> tuple[tuple[complex, complex], ...]:
        """Ends of the strands, the one behind each wheel."""
        pairs = zip(self.wheels, (*self.wheels[1:], self.wheels[0]), self.ways, strict=True)
        return tuple((a.centre + a.side * 1j * way, b.centre + b.side * 1j * way) for a, b, way in pairs)

    @cached_property
    def wraps(self) -> tuple[float, ...]:
        """Angles of wrap."""
        turns = (
            cmath.phase(before / after) for before, after in zip((self.ways[-1], *self.ways), self.ways, strict=False)
        )
        return tuple((-turn if w.outside else turn) % _TURN for w, turn in zip(self.wheels, turns, strict=True))

    @cached_property
    def ends(self) -> Real:
        """Ways at which its pieces end: the strand behind each wheel, then the arc on the next one."""
        arcs = [w.radius * wrap for w, wrap in zip(self.wheels, self.wraps, strict=True)]
        pieces = [length for k, (a, b) in enumerate(self.strands) for length in (abs(b - a), arcs[(k + 1) % len(arcs)])]
        return np.cumsum(pieces)

    @property
    def length(self) -> float:
        """All round."""
        return float(self.ends[-1])

    def way(self, wheel: int, angle: float) -> float:
        """The way to a polar angle on a wheel's arc, counted from where it arrives there, and on beyond its ends."""
        w, arrival = self.wheels[wheel], self.strands[wheel - 1][1]
        turn = math.remainder(cmath.phase(arrival - w.centre) - angle, _TURN)
        return float(self.ends[2 * wheel - 2 if wheel else -2]) + w.side * turn

    def places(self, ways: Real) -> Complex:
        """Points at ways along it."""
        ways = np.mod(ways, self.length)
        piece = np.minimum(np.searchsorted(self.ends, ways, side="right"), len(self.ends) - 1)
        left = ways - np.concatenate(([0.0], self.ends))[piece]
        found = np.empty(len(ways), dtype=complex)
        for k, (start, end) in enumerate(self.strands):
            wheel = self.wheels[(k + 1) % len(self.wheels)]
            straight, arc = piece == 2 * k, piece == 2 * k + 1
            found[straight] = start + self.ways[k] * left[straight]
            found[arc] = wheel.centre + (end - wheel.centre) * np.exp(-1j * left[arc] / wheel.side)
        return found

    def tightened(self, wheel: int, length: float) -> Loop | None:
        """The loop with a wheel moved straight on, or back, until it is so long; None: something stands in its way."""
        pressed = self.ways[wheel - 1] - self.ways[wheel]

        def moved(share: float) -> Loop:
            own = self.wheels[wheel]
            at = replace(own, centre=own.centre + share * pressed)
            return Loop((*self.wheels[:wheel], at, *self.wheels[wheel + 1 :]))

        most = (length - self.length) / abs(pressed) ** 2
        for _ in range(_DOUBLED):
            if (moved(most).length - length) * most >= 0:
                break
            most *= 2
        else:
            return None
        found = moved(bracketed_root(lambda share: moved(share).length - length, *sorted((0.0, most))).value)
        # where the line leaves another wheel its length jumps, and no place has the length
        reached = abs(found.length - length) < _SAME * length
        return found if reached and not found.missed() else None

    @property
    def meeting(self) -> tuple[int, ...]:
        """Two wheels that meet, the later one first; () if none do."""
        for i, j in combinations(range(len(self.wheels)), 2):
            one, two = self.wheels[i], self.wheels[j]
            if abs(two.centre - one.centre) < one.radius + two.radius:
                return j, i
        return ()

    @property
    def passes_by(self) -> bool:
        """Whether it would turn the wrong way round a wheel, which it does not touch."""
        turning = sum(-wrap if w.outside else wrap for w, wrap in zip(self.wheels, self.wraps, strict=True))
        return abs(turning - _TURN) > 1.0

    def missed(self) -> tuple[int, ...]:
        """Wheels of which one is not where the line can come to it, those first that are it sooner; () if all are.

        It would turn the wrong way round it, two circles meet, or a strand runs into a circle or another strand.
        """
        count = len(self.wheels)
        if self.meeting:
            return self.meeting
        if self.passes_by:
            return tuple(sorted(range(count), key=lambda k: -self.wraps[k]))
        for k, (start, end) in enumerate(self.strands):
            for j, wheel in enumerate(self.wheels):
                if j not in (k, (k + 1) % count) and _distance(wheel.centre, start, end) < wheel.radius * (1 - _SAME):
                    return j, (k + 1) % count, k
            for j, (other, last) in enumerate(self.strands[:k]):
                if lines_cross(start, end, other, last):
                    return (k + 1) % count, k, (j + 1) % count, j
        return ()


class DriveLoop(Loop):
    """That of a drive: the ``second`` of both that carry is so many wheels behind the first; ``idlers`` as told."""

    second: int
    idlers: tuple[Wheel, ...]

    @property
    def both_wraps(self) -> tuple[float, float]:
        """Angles of wrap on both that carry."""
        return self.wraps[0], self.wraps[self.second]

    @property
    def idler_wraps(self) -> tuple[float, ...]:
        """Those on the idlers, as they are told."""
        return tuple(self.wraps[self.wheels.index(idler)] for idler in self.idlers)


def about_two(radii: tuple[float, float], distance: float, idlers: tuple[Wheel, ...]) -> DriveLoop:
    """The loop about a wheel at the origin, one on +x and idlers.

    What of the idlers stands on the left of the line of centres is in the strand on the left.
    """
    along = sorted(idlers, key=lambda idler: idler.centre.real)
    left, right = ([w for w in along if (w.centre.imag > 0) == is_left] for is_left in (True, False))
    first, second = (Wheel(complex(x), r) for x, r in zip((0.0, distance), radii, strict=True))
    return DriveLoop((first, *left, second, *reversed(right)), 1 + len(left), idlers)


def _distance(point: complex, start: complex, end: complex) -> float:
    """From a point to a straight line between two."""
    way = end - start
    share = ((point - start) * way.conjugate()).real / abs(way) ** 2
    return abs(point - start - min(max(share, 0.0), 1.0) * way)

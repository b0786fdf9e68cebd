"""Closed polygons with rounded corners, moved exactly out of or into the material: plates, frames, windows."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

from geometry.errors import OffsetError
from geometry.line_arc import Arc, Line
from geometry.profile import Label, Profile, Segment

_BISECTIONS = 30
# corners that turn by less are straight, rad
_STRAIGHT = 1e-9


def rounded_polygon(corners: Sequence[complex], radii: Sequence[float], label: Label, offset: float = 0.0) -> Profile:
    """The polygon with rounded corners (mm; 0: sharp), material on its left, moved ``offset`` mm out of the material.

    A rounding keeps its centre: that of a convex corner of the material grows with the offset, that of a hollow one
    shrinks, and a sharp corner that is moved apart is rounded about itself. What crosses there is cut off.

    Raises
    ------
    OffsetError
        An edge vanishes; names the nearest offset that works.
    """
    made = _attempt(corners, radii, label, offset)
    if made is not None:
        return made
    works, fails = 0.0, offset
    if offset == 0 or _attempt(corners, radii, label, 0.0) is None:
        raise OffsetError(offset, "leaves no edge between two corners", 0.0)
    for _ in range(_BISECTIONS):
        middle = (works + fails) / 2
        works, fails = (middle, fails) if _attempt(corners, radii, label, middle) is not None else (works, middle)
    raise OffsetError(offset, "leaves no edge between two corners", works)


def rectangle(width: float, height: float, centre: complex = 0j) -> list[complex]:
    """Corners of an upright rectangle, counter-clockwise."""
    x, y = width / 2, height / 2
    return [centre + complex(a, b) for a, b in ((x, -y), (x, y), (-x, y), (-x, -y))]


def stadium(width: float, length: float, centre: complex, offset: float, *, hole: bool = True) -> Profile:
    """A slot with round ends along y, ``length`` mm between the ends' centres; a hole runs clockwise.

    Raises
    ------
    OffsetError
        It closes.
    """
    sign = -1.0 if hole else 1.0
    radius = width / 2 + sign * offset
    if not radius > 0:
        raise OffsetError(offset, "closes the slot", -sign * width / 2 * (1 - 1e-6))
    top, bottom = centre + 0.5j * length, centre - 0.5j * length
    right = Line(bottom + radius, top + radius)
    left = Line(top - radius, bottom - radius)
    ends = Arc(top, radius, 0.0, math.pi), Arc(bottom, radius, math.pi, math.pi)
    chain: list[Line | Arc] = [right, ends[0], left, ends[1]]
    if hole:
        chain = [c.reversed() for c in reversed(chain)]
    return Profile(tuple(Segment(c, Label.BODY) for c in chain))


def _attempt(corners: Sequence[complex], radii: Sequence[float], label: Label, offset: float) -> Profile | None:
    """The moved polygon, or None where an edge vanishes or turns back."""
    count = len(corners)
    ways = [(corners[(k + 1) % count] - corners[k]) for k in range(count)]
    ways = [w / abs(w) for w in ways]
    starts: list[complex] = []
    ends: list[complex] = []
    arcs: list[Arc | None] = []
    for k, corner in enumerate(corners):
        before, after = ways[k - 1], ways[k]
        turn = cmath.phase(after / before)
        radius = radii[k] + offset if turn > 0 else radii[k] - offset
        # of a corner that nothing rounds both edges are moved to their crossing
        tip = corner + _shift(before, after, turn) * offset
        if abs(turn) < _STRAIGHT or not radius > 0:
            ends.append(tip)
            starts.append(tip)
            arcs.append(None)
            continue
        cut = radius * math.tan(abs(turn) / 2)
        first, last = tip - cut * before, tip + cut * after
        side = 1j if turn > 0 else -1j
        centre = first + side * before * radius
        ends.append(first)
        starts.append(last)
        arcs.append(Arc(centre, radius, cmath.phase(first - centre), turn))
    segments: list[Segment] = []
    for k in range(count):
        if (arc := arcs[k]) is not None:
            segments.append(Segment(arc, label))
        start, end = starts[k], ends[(k + 1) % count]
        length = ((end - start) * ways[k].conjugate()).real
        if length < -1e-12 * abs(end):
            return None
        if length > 1e-12 * abs(end):
            segments.append(Segment(Line(start, end), label))
    return Profile(tuple(segments))


def _shift(before: complex, after: complex, turn: float) -> complex:
    """How far the crossing of two edges goes for each mm that both move to their right."""
    return (-1j * before - 1j * after) / (2 * math.cos(turn / 2) ** 2)

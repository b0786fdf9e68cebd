"""Holes across the hub of a wheel in its axial section: cut along their axes, or seen in the bore behind it.

The curve in which such a hole meets hub or bore is a hyperbola, as seen across both axes.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Sequence

from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.curve import Curve
from geometry.curves.hyperbola import Hyperbola
from geometry.curves.line_arc import Arc, Line
from geometry.solids.bores import Bore
from geometry.solids.cross_holes import CrossHole, Mouth, mouth_in_bore
from geometry.solids.wheel import Hub
from parts.drawing.revolved import Loop, block
from parts.drawing.working import AXIS, HIDDEN, VISIBLE, Angle, Side, Size, Stroke, Subject
from parts.texts.sheets import counted_words

# mm and rad, what is none
_NONE = 1e-9


class CutHole(Record):
    """A hole that the plane of a section cuts along its axis: to which side of the wheel's axis, and its mouths."""

    hole: CrossHole
    way: int
    inner: Mouth
    outer: Mouth

    def walls(self) -> tuple[Line, Line]:
        """Both, from the bore outwards."""
        ends = 1j * self.way * self.inner.away, 1j * self.way * self.outer.away
        low, high = (Line(*(self.hole.height + side * self.hole.radius + end for end in ends)) for side in (-1, 1))
        return low, high

    def rims(self) -> Iterator[Curve]:
        """Where it meets bore and hub, as far as they are seen behind the section."""
        for mouth in (self.inner, self.outer):
            if mouth.is_round:
                size = math.sqrt(mouth.away**2 - self.hole.radius**2)
                half = math.asinh(self.hole.radius / size)
                upright = Placement2(self.way * math.pi / 2, self.hole.height)
                yield Hyperbola(0j, size, size, -half, half).placed(upright)
            else:
                yield self.across(mouth.away)

    def across(self, away: float) -> Line:
        """From wall to wall at a distance from the wheel's axis, mm."""
        low, high = (self.hole.height + side * self.hole.radius + 1j * self.way * away for side in (-1, 1))
        return Line(low, high)

    def loop(self) -> Loop:
        """What is not hatched."""
        ends = (self.hole.height - self.hole.radius, self.hole.height + self.hole.radius)
        return block(*ends, *(self.way * mouth.away for mouth in (self.inner, self.outer)))

    def axis(self) -> Line:
        """Its own."""
        return Line(*(self.hole.height + 1j * self.way * mouth.away for mouth in (self.inner, self.outer)))


def cut_across(hub: Hub | None, bore: Bore | None, turn: float) -> tuple[CutHole, ...]:
    """The holes in the plane of a section of a wheel that is turned, rad; the first, turned into it, where none is."""
    if hub is None or bore is None or not hub.set_screws:
        return ()
    outer = Mouth(0, 0, hub.diameter / 2, is_round=True)
    found: list[CutHole] = []
    for hole in hub.set_screws:
        way = cmath.rect(1.0, hole.angle + turn)
        inner = mouth_in_bore(bore, hole)
        if abs(way.real) < _NONE and inner is not None:
            found.append(CutHole(hole, 1 if way.imag > 0 else -1, inner, outer))
    return tuple(found) or (_turned_into(bore, hub.set_screws[0], turn, outer),)


def _turned_into(bore: Bore, hole: CrossHole, turn: float, outer: Mouth) -> CutHole:
    """A hole in the plane of a section where it is drawn (GOST 2.305), on the side where the bore has its own wall."""
    own = mouth_in_bore(bore, hole)
    walls = {way: mouth_in_bore(bore, replace(hole, angle=way * math.pi / 2 - turn)) for way in (1, -1)}
    assert own is not None
    way = min(walls, key=lambda way: math.inf if (wall := walls[way]) is None else abs(wall.away - own.away))
    return CutHole(hole, way, walls[way] or own, outer)


def seen_in_bore(hub: Hub | None, turn: float, shown: Sequence[CutHole]) -> Iterator[Arc]:
    """Those that open in the bore straight behind the section, without those shown in it."""
    for hole in () if hub is None else hub.set_screws:
        if abs(cmath.rect(1.0, hole.angle + turn) - 1) < _NONE and all(cut.hole != hole for cut in shown):
            yield Arc(complex(hole.height), hole.radius, 0.0, math.tau)


def opened(strokes: Iterable[Stroke], holes: Sequence[CutHole]) -> list[Stroke]:
    """Strokes without what holes take of lines along hub and bore, and with the holes themselves."""
    found = list(strokes)
    for hole in holes:
        gaps = [hole.across(mouth.away) for mouth in (hole.inner, hole.outer)]
        found = [(style, piece) for style, curve in found for piece in _without(curve, gaps)]
        found += [(VISIBLE, curve) for curve in (*hole.walls(), *hole.rims())]
    return found


def _without(curve: Curve, gaps: Iterable[Line]) -> Iterator[Curve]:
    """The parts of a curve beside gaps in it."""
    for gap in gaps:
        height = gap.start.imag
        if isinstance(curve, Line) and max(abs(curve.start.imag - height), abs(curve.end.imag - height)) < _NONE:
            low, high = sorted((curve.start, curve.end), key=lambda at: at.real)
            if low.real < gap.start.real + _NONE and gap.end.real < high.real + _NONE:
                ends = (low, gap.start), (gap.end, high)
                yield from (Line(*pair) for pair in ends if abs(pair[1] - pair[0]) > _NONE)
                return
    yield curve


def hole_sizes(hub: Hub | None, holes: Sequence[CutHole], end: float, subject: Subject) -> Iterator[Size]:
    """How wide the holes are, and how far from the end of the hub, mm, at that height of the section."""
    if hub is None or not holes:
        return
    hole = min(holes, key=lambda one: -one.way)
    mouth = hole.across(hole.outer.away)
    side: Side = "above" if hole.way > 0 else "below"
    words = counted_words(subject.language, "holes_of", len(hub.set_screws))
    yield Size("hub.set_screws.diameter", mouth.start, mouth.end, side, f"{words}Ø")
    yield Size("hub.set_screws.from_end", (mouth.start + mouth.end) / 2, complex(end, mouth.start.imag), side)


def seen_within(hub: Hub | None, bore: Bore | None, turn: float) -> Iterator[Stroke]:
    """The walls and axes of all holes, hidden in a hub that is seen along its axis, from above."""
    if hub is None or bore is None:
        return
    for hole in hub.set_screws:
        inner, way = mouth_in_bore(bore, hole), cmath.rect(1.0, hole.angle + turn)
        assert inner is not None
        near, far = (math.sqrt(radius**2 - (hole.radius if round_ else 0.0) ** 2)
                     for radius, round_ in ((inner.away, inner.is_round), (hub.diameter / 2, True)))  # fmt: skip
        for side in (-1j, 1j):
            yield HIDDEN, Line(way * (near + side * hole.radius), way * (far + side * hole.radius))
        yield AXIS, Line(way * near, way * far)


def hole_angles(hub: Hub | None, turn: float, subject: Subject) -> Iterator[Angle]:
    """Where holes stand that lie on no axis of the view: from the one before, the first from the upper half of it."""
    last = 1j
    if hub is None:
        return
    for hole in hub.set_screws:
        way = cmath.rect(1.0, hole.angle + turn)
        between = abs(math.degrees(cmath.phase(way / last)))
        if abs(way.real * way.imag) > _NONE:
            yield Angle(0j, last, way, f"{subject.say(between)}°", (hub.diameter / 2, hub.diameter / 2))
        last = way

"""Details of long shafts: what they show, by windows worked out by hand; their lines are those of the view, no more."""

from __future__ import annotations

import math
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

from geometry.base.record import Record
from geometry.curves.line_arc import Arc, Line
from parts.drawing.working import HIDDEN, THIN, VISIBLE, PartDrawing, View
from tests.parts.drawing.test_sections import drawing_of
from tests.parts.drawing.test_views import off

NEAR = 1e-9


def step(diameter: float, length: float, **more: Any) -> dict[str, Any]:
    return {"diameter": diameter, "length": length, **more}


def shaft(*steps: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"kind": "shaft", "steps": list(steps), **more}


class Told(Record):
    """What a detail has to show, in the frame of the view: its window, what breaks it off, its sizes and radii.

    ``waves``: ends of lines at which it is broken off; ``sizes``: name, both places along the axis, both heights, side.
    """

    letter: str
    left: float
    right: float
    low: float
    high: float
    least: float
    circle: float
    waves: tuple[tuple[complex, complex], ...]
    sizes: tuple[tuple[str, complex, complex, str], ...]
    radii: tuple[tuple[complex, float], ...] = ()

    @property
    def whole(self) -> bool:
        return self.low == -self.high


# a detail reaches 0.6 of the length between its first and last place beside them; across it shows all where that is at
# most twice as long as the detail, else the surface and below it as much again, or 0.6 of the places' length;
# its least length is 5 mm on paper, the whole at most 60; the circle about it is through its corners, or 1/60 of the
# view in radius
CASES: dict[str, tuple[dict[str, Any], list[Told]]] = {
    # places 200 and 201.3: 0.78 beside, 0.78 below the groove's ground at 14.3; 500 / 60 = 8.33
    "a groove": (
        shaft(step(30.0, 500.0, grooves=[{"at": 200.0, "width": 1.3, "diameter": 28.6}])),
        [Told("A", 199.22, 202.08, 13.52, 15.0, 5 * 2.86 / 1.3, 500 / 60,
              ((199.22 + 13.52j, 199.22 + 15j), (202.08 + 13.52j, 202.08 + 15j), (199.22 + 13.52j, 202.08 + 13.52j)),
              (("width.3", 200 + 15j, 201.3 + 15j, "above"),))],
    ),
    # places 900, 902, 902.5: 1.5 beside; 2 * 2.5 is no more than twice 5.5: all across; lengths from the last place,
    # to which the view tells the way from the left end; 5 mm for 0.5 make 55 of 5.5
    "steps": (
        shaft(step(3.0, 900.0), step(5.0, 2.0), step(4.9, 0.5, fillet=0.05), step(3.0, 30.0)),
        [Told("A", 898.5, 904.0, -2.5, 2.5, 55.0, 932.5 / 60,
              ((898.5 - 1.5j, 898.5 + 1.5j), (904 - 1.5j, 904 + 1.5j)),
              (("outer_diameter.2", 902 - 2.5j, 902 + 2.5j, "right"),
               ("outer_diameter.3", 902.5 - 2.45j, 902.5 + 2.45j, "right"),
               ("length.2", 902.5 - 2.45j, 900 - 2.5j, "below"), ("length.3", 902.5 - 2.45j, 902 - 2.5j, "below")),
              ((902.05 + 2.5j, 0.05),))],
    ),
    # the same from the other end
    "steps at the left": (
        shaft(step(3.0, 30.0), step(4.9, 0.5), step(5.0, 2.0), step(3.0, 900.0)),
        [Told("A", 28.5, 34.0, -2.5, 2.5, 55.0, 932.5 / 60,
              ((28.5 - 1.5j, 28.5 + 1.5j), (34 - 1.5j, 34 + 1.5j)),
              (("outer_diameter.2", 30 - 2.45j, 30 + 2.45j, "left"),
               ("outer_diameter.3", 30.5 - 2.5j, 30.5 + 2.5j, "left"),
               ("length.2", 32.5 - 2.5j, 30 - 2.45j, "below"), ("length.3", 32.5 - 2.5j, 30.5 - 2.5j, "below")))],
    ),
    # at the end, of which nothing breaks it off: 399.4 to 401, from 10 down to 4.75 and 5.25 more; hidden lines too
    "an end": (
        shaft(step(20.0, 400.0), step(10.0, 1.0, chamfer=0.25), centre_holes={"diameter": 1.6}),
        [Told("A", 399.4, 401.0, -0.5, 10.0, 52.5, 401 / 60,
              ((399.4 - 0.5j, 399.4 + 10j), (399.4 - 0.5j, 401 - 0.5j)),
              (("length.2", 401 + 5j, 400 + 10j, "above"), ("chamfer.1", 400.75 + 5j, 401 + 5j, "above")))],
    ),
    # the other end, and a groove whose ground is round; A is the section of the keyway, marks go on from there;
    # 6 - 14 lies beyond the axis; through the corners of 3.2 x 28: half of 28.18; 0.5 mm of fillet is no length
    "two and a keyway": (
        shaft(step(12.0, 2.0), step(40.0, 300.0, keyways=[{"at": 20.0, "length": 60.0}],
              grooves=[{"at": 150.0, "width": 1.5, "diameter": 38.0, "fillet": 0.5}]), step(12.0, 100.0)),
        [Told("B", 0.0, 3.2, -8.0, 20.0, 60.0, math.hypot(3.2, 28.0) / 2,
              ((3.2 - 8j, 3.2 + 20j), (0 - 8j, 3.2 - 8j)), (("length.2", 0 + 6j, 2 + 20j, "above"),)),
         Told("C", 151.1, 154.4, 18.0, 20.0, 5 * 3.3 / 1.5, 402 / 60,
              ((151.1 + 18j, 151.1 + 20j), (154.4 + 18j, 154.4 + 20j), (151.1 + 18j, 154.4 + 18j)),
              (("width.5", 152 + 20j, 153.5 + 20j, "above"),), ((152.5 + 19.5j, 0.5),))],
    ),
    # thin from end to end: two runs of places, each with all across
    "a needle": (
        shaft(step(1.0, 1.0), step(1.5, 300.0), step(1.0, 1.0), step(0.8, 1.2)),
        [Told("A", 0.0, 1.6, -0.75, 0.75, 8.0, 303.2 / 60, ((1.6 - 0.75j, 1.6 + 0.75j),),
              (("outer_diameter.1", -0.5j, 0.5j, "left"), ("outer_diameter.2", 1 - 0.75j, 1 + 0.75j, "right"),
               ("length.2", -0.5j, 1 - 0.75j, "below"))),
         Told("B", 299.68, 303.2, -0.75, 0.75, 17.6, 303.2 / 60, ((299.68 - 0.75j, 299.68 + 0.75j),),
              (("outer_diameter.3", 303.2 - 0.4j, 303.2 + 0.4j, "right"),
               ("length.3", 303.2 - 0.4j, 301 - 0.75j, "below"), ("length.4", 303.2 - 0.4j, 302 - 0.5j, "below")))],
    ),
}  # fmt: skip


@cache
def drawn(name: str) -> PartDrawing:
    return drawing_of(CASES[name][0])


def details(name: str) -> list[tuple[Told, View, float]]:
    """Of each what is told of it, its view, and by how much that is moved down: an upper half to beside the axis."""
    told, views = CASES[name][1], drawn(name).views[1:]
    assert [v.title for v in views[: len(told)]] == [t.letter for t in told]
    return [(t, v, 0.0 if t.whole else (t.low + t.high) / 2) for t, v in zip(told, views, strict=False)]


def lines(view: View, layer: str, pieces: int) -> np.ndarray:
    """Both ends of short pieces of all lines, arcs by their chords, at most so long that they are told apart."""
    found = [c.point(np.linspace(*c.domain, pieces + 1 if isinstance(c, Line) else 33))
             for name, c in view.strokes if name == layer]  # fmt: skip
    return np.concatenate([np.stack([p[:-1], p[1:]], axis=1) for p in found])


@pytest.mark.parametrize("name", CASES)
def test_a_detail_shows_all_lines_of_its_window_and_no_other(name: str) -> None:
    for told, view, down in details(name):
        for layer in (VISIBLE, HIDDEN):
            if not any(s[0] == layer for s in view.strokes):
                assert layer == HIDDEN
                continue
            main = drawn(name).views[0]
            mine, points = (lines(view, layer, pieces) + 1j * down for pieces in (1, 20))
            assert off(lines(main, layer, 1), points.ravel()).max() < NEAR
            assert points.real.min() > told.left - NEAR
            assert points.real.max() < told.right + NEAR
            assert points.imag.min() > told.low - NEAR
            assert points.imag.max() < told.high + NEAR
            every = lines(main, layer, 600).ravel()
            within = (told.left < every.real) & (every.real < told.right) & (told.low < every.imag)
            assert off(mine, every[within]).max() < NEAR
    assert any(s[0] == HIDDEN for s in drawn("an end").views[1].strokes)


@pytest.mark.parametrize("name", CASES)
def test_a_detail_is_broken_off_by_waves_where_the_shaft_goes_on(name: str) -> None:
    """Four arcs of equal chords, which stand out 0.15 of them by turns: R = (c^2 / 4 + h^2) / (2 h)."""
    for told, view, down in details(name):
        arcs = [c for layer, c in view.strokes if layer == THIN]
        assert len(arcs) == 4 * len(told.waves)
        for k, (first, last) in enumerate(told.waves):
            chord, sides = (last - first) / 4, []
            for n, arc in enumerate(arcs[4 * k : 4 * k + 4]):
                assert isinstance(arc, Arc)
                start, middle, end = (complex(p) + 1j * down for p in arc.point(np.linspace(*arc.domain, 3)))
                assert abs(start - first - n * chord) < NEAR
                assert abs(end - first - (n + 1) * chord) < NEAR
                out = (middle - (start + end) / 2) / (chord / abs(chord))
                assert abs(out.real) < NEAR
                assert abs(out.imag) == pytest.approx(0.15 * abs(chord), rel=1e-9)
                assert arc.radius == pytest.approx(abs(chord) * (1 / 4 + 0.15**2) / 0.3, rel=1e-9)
                sides.append(math.copysign(1, out.imag))
            assert all(a == -b for a, b in pairwise(sides))


@pytest.mark.parametrize("name", CASES)
def test_sizes_that_are_told_in_a_detail_are_those_that_the_view_lacks(name: str) -> None:
    main, others = drawn(name).views[0], set[str]()
    for told, view, down in details(name):
        found = [(s.name, s.start + 1j * down, s.end + 1j * down, s.side) for s in view.sizes]
        assert [row[::3] for row in found] == [row[::3] for row in told.sizes]
        for mine, row in zip(found, told.sizes, strict=True):
            assert abs(mine[1] - row[1]) + abs(mine[2] - row[2]) < NEAR, row[0]
        rounds = [(r.centre + 1j * down, r.radius) for r in view.rounds]
        assert len(rounds) == len(told.radii)
        assert all(abs(a - c) + abs(b - d) < NEAR for (a, b), (c, d) in zip(rounds, told.radii, strict=True))
        others |= {s.name for s in view.sizes} | {r.name for r in view.rounds}
        assert view.least == pytest.approx(told.least, rel=1e-9)
        axes = [(a.start, a.end) for a in view.axes]
        assert axes == ([(told.left, told.right)] if told.whole else [])
    assert not others & {s.name for s in (*main.sizes, *main.rounds)}
    names = [int(n.rpartition(".")[2]) for n in others | {s.name for s in main.sizes} if n.startswith("length.")]
    assert len(names) == len(set(names))
    # a ring of the whole, its letter beside it on the upper right
    circles = [c for layer, c in main.strokes if layer == THIN]
    letters = [n for n in main.notes if n.is_letter]
    assert len(circles) == len(letters) == len(CASES[name][1])
    for told, arc, note in zip(CASES[name][1], circles, letters, strict=True):
        assert isinstance(arc, Arc)
        assert abs(arc.centre - complex(told.left + told.right, told.low + told.high) / 2) < NEAR
        assert arc.radius == pytest.approx(told.circle, rel=1e-9)
        assert abs(arc.sweep) == pytest.approx(2 * math.pi)
        assert note.text == told.letter
        assert abs(note.at - arc.centre - arc.radius * (1 + 1j) / math.sqrt(2)) < 1e-6


@pytest.mark.parametrize(("width", "found"), [(2.99, 1), (3.01, 0)])
def test_what_is_less_than_a_150th_of_the_view_is_enlarged(width: float, found: int) -> None:
    long = shaft(step(30.0, 450.0, grooves=[{"at": 200.0, "width": width, "diameter": 28.0}]))
    assert len(drawing_of(long).views) == 1 + found
    # of a disk its diameter is the size of the view
    disk = shaft(step(450.0, 30.0, grooves=[{"at": 10.0, "width": width, "diameter": 448.0}]))
    assert len(drawing_of(disk).views) == 1 + found


@pytest.mark.parametrize(("diameter", "whole"), [(2.19, True), (2.21, False)])
def test_what_is_at_most_twice_as_thick_as_its_detail_is_long_is_shown_across(diameter: float, whole: bool) -> None:
    """A groove of 0.5 and 0.6 of it on both sides are 1.1 mm."""
    thin = shaft(step(diameter, 300.0, grooves=[{"at": 100.0, "width": 0.5, "diameter": diameter - 0.2}]))
    detail = drawing_of(thin).views[1]
    assert bool(detail.axes) is whole
    assert any(s.side in ("left", "right") for s in detail.sizes) is whole

"""A lever mechanism as a picture: its scheme, both plans, and the diagrams of its output over a turn."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np

from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from parts.base.texts import N_, Text, Words
from parts.pages.beside import Name, beside_line, beside_point, settled
from parts.pages.page import Table, table_of, unit_text
from parts.pages.svg import INK, chain, circle, document, written

# a panel and what stays free about it, px
_SIDE, _EDGE, _HEAD = 420.0, 34.0, 26.0
_LINK, _PATH, _AXIS = "#1f4e8c", "#9fb0c0", "#c8ccd0"
_COLOURS = ("#c03020", "#2060c0", "#209050", "#a06000", "#8030a0", "#008090", "#606060", "#d06090")
# which points are joined by links
_RODS = (("O1", "A"), ("A", "B"), ("O3", "B"), ("O3", "C"), ("C", "D"), ("O5", "D"))
# scales of plans: a plan's longest vector stays within this on paper, on large sheets within the second, mm
ROOM, LARGE_ROOM, _STEPS = 120.0, 170.0, (1.0, 2.0, 2.5, 4.0, 5.0, 10.0)
# names of a panel may stand in the room about it, below its title
_FIELD = (complex(-_EDGE, -8.0), complex(_SIDE + _EDGE, _SIDE + _EDGE / 2))
# of more positions than these the links would be one grey field
SHOWN = 24
# of a path and a diagram every such point is drawn
_EVERY = 10


class Vector(Record):
    """A vector of a plan from ``start`` to ``end``, m/s or m/s^2."""

    name: str
    start: complex
    end: complex


class Plan(Record):
    """Vectors about a pole, and how much 1 mm of paper stands for."""

    vectors: tuple[Vector, ...]
    scale: float

    def table(self, name: str, title: Text, unit: str) -> Table:
        """Size, direction and length on paper of every vector."""
        heads = ((N_("vector"), ""), (N_("value"), unit), (N_("direction"), "deg"), (N_("on the plan"), "mm"))
        sides = ((v.name, v.end - v.start) for v in self.vectors)
        rows = ((name, abs(s), math.degrees(cmath.phase(s)), abs(s) / self.scale) for name, s in sides)
        return table_of(name, title, heads, rows)


def plan_of(vectors: Iterable[Vector], scale: float | None, room: float = ROOM) -> Plan:
    """A plan; without a scale at the finest of the usual ones at which its longest vector has ``room``, mm."""
    found = tuple(vectors)
    if scale is None:
        most = max(abs(v.end - v.start) for v in found) / room
        decade = 10.0 ** math.floor(math.log10(most)) if most > 0 else 1.0
        scale = next(step * decade for step in _STEPS if step * decade >= most * (1 - 1e-12))
    return Plan(found, scale)


class Run(Record, eq=False):
    """Over a turn: angle (deg), moment of the resistance, the even driving one (N m); energies gained (J) by the whole,
    by the links, by the flywheel.
    """

    angle: Real
    resisting: Real
    driving: float
    gained: Real
    of_links: Real
    of_flywheel: Real


class LeverPicture(Record, eq=False):
    """``points`` in the first position, their ``paths`` over a turn, or to and fro, mm, ``fixed`` pivots; ``blocks``:
    points of links that slide, and the directions of their guides; ``series``: symbol, unit and values over the
    ``angle`` (deg) of travel, velocity and acceleration of the output; ``forces``: plans of forces under their titles;
    ``positions``: how many equidistant ones of the crank are shown together, the first of them bold.
    """

    points: Mapping[str, complex]
    paths: Mapping[str, Complex]
    fixed: Mapping[str, complex]
    blocks: Mapping[str, complex]
    velocities: Plan
    accelerations: Plan
    angle: Real
    series: tuple[tuple[str, str, Real], ...]
    run: Run | None = None
    forces: tuple[tuple[Text, Plan], ...] = ()
    positions: int = 1

    def svg(self, words: Words) -> str:
        """The picture in a language."""
        panels: list[tuple[Text, list[str]]] = [
            (N_("Scheme"), list(self._scheme())),
            (N_("Plan of velocities"), list(_plan(self.velocities))),
            (N_("Plan of accelerations"), list(_plan(self.accelerations))),
        ]
        if self.series:
            panels.append((N_("Output over a turn"), list(self._diagrams(words))))
        if self.run is not None:
            run = self.run
            moments = (("M_c", run.resisting), ("M_d", np.full(len(run.angle), run.driving)))
            energies = (("ΔT", run.gained), ("ΔT_l", run.of_links), ("ΔT_m", run.of_flywheel))
            panels += [
                (N_("Reduced moments, N·m"), list(together(run.angle, moments, words))),
                (N_("Gained energy, J; KK_1 is the height of ΔT_m"), list(together(run.angle, energies, words))),
            ]
        panels += [(title, list(_plan(plan))) for title, plan in self.forces]
        if 1 < self.positions <= SHOWN:
            panels.append((N_("Positions of the crank over one turn"), list(self._positions())))
        return paneled(panels, words)

    def _scheme(self) -> Iterator[str]:
        known = {**self.fixed, **self.points}
        view = _View(np.concatenate([np.array([*known.values()]), *self.paths.values()]))
        lines: list[tuple[complex, complex]] = []
        for path in self.paths.values():
            spots = np.append(path[::_EVERY], path[0])
            lines += _seen(view, spots)
            yield view.line(spots, _PATH, 1.0)
        for one, two in self.rods(known):
            ends = np.array([known[one], known[two]])
            lines += _seen(view, ends)
            yield view.line(ends, _LINK, 3.0)
        names = []
        for name, at in known.items():
            x, y = view.at(at)
            fill = INK if name in self.fixed else "#ffffff"
            yield circle(x, y, 4, f"fill:{fill};stroke:{_LINK};stroke-width:2", "g")
            radius = 10.0 if name in self.blocks else 5.0
            # no other name stands on a joint
            half = 9.0 if name in self.blocks else 5.0
            lines += [(complex(x, y) - way, complex(x, y) + way) for way in (half, half * 1j)]
            if name in self.blocks:
                corners = [complex(x, y) + half * (1 + 1j) * 1j**k for k in range(5)]
                lines += pairwise(corners)
            names.append(beside_point(name, complex(x, y), radius))
        yield from _named(names, lines, (INK,))
        for name, way in self.blocks.items():
            x, y = view.at(known[name])
            turn = -math.degrees(cmath.phase(way))
            style = f"fill:none;stroke:{_LINK};stroke-width:2"
            place = f"translate({x:.2f} {y:.2f}) rotate({turn:.3f})"
            yield f'<rect x="-9" y="-6" width="18" height="12" transform="{place}" style="{style}"/>'

    def rods(self, known: Mapping[str, complex]) -> list[tuple[str, str]]:
        """Which of the points that are known are joined by links."""
        rods = (rod for rod in _RODS if {*rod} <= {*known})
        found = [rod for rod in rods if not ("A" in self.blocks and rod == ("A", "B"))]
        # without a lever a second rod hangs on the crank
        return [*found, ("A", "D")] if "D" in known and "C" not in known else found

    def at(self, number: int) -> dict[str, complex]:
        """Where all points are in a position, mm."""
        moved = {name: complex(path[number * len(path) // self.positions]) for name, path in self.paths.items()}
        return {**self.fixed, **moved}

    def _positions(self) -> Iterator[str]:
        """Every position with its number beyond A, the first one last, over the others."""
        view = _View(np.concatenate([np.array([*self.fixed.values()]), *self.paths.values()]))
        for path in self.paths.values():
            yield view.line(np.append(path[::_EVERY], path[0]), _PATH, 1.0)
        for number in reversed(range(self.positions)):
            places = self.at(number)
            for one, two in self.rods(places):
                yield view.line(np.array([places[one], places[two]]), _LINK, 0.5 if number else 2.5)
            (x0, y0), (x, y) = view.at(places["O1"]), view.at(places["A"])
            share = 11 / math.hypot(x - x0, y - y0)
            yield written(x + share * (x - x0), y + share * (y - y0) + 4, str(number), INK, 13, "middle")

    def _diagrams(self, words: Words) -> Iterator[str]:
        angle, third = self.angle, _SIDE / 3
        for number, (name, unit, values) in enumerate(self.series):
            low, high = min(float(values.min()), 0.0), max(float(values.max()), 0.0)
            high = high if high > low else low + 1
            top = number * third + 14
            tall = third - 26
            yield _zero(top + high / (high - low) * tall)
            x = (angle - angle[0]) / 360 * _SIDE
            yield _curve(x, top + (high - values) / (high - low) * tall, number)
            ends = " … ".join(words.decimal(f"{value:.4g}") for value in (low, high))
            shown = f"{name}, {unit_text(unit, words)}  {ends}"
            yield written(0, top - 5, shown, _COLOURS[number], 13, "start")


def paneled(panels: Sequence[tuple[Text, Sequence[str]]], words: Words) -> str:
    """Panels under their titles, two beside each other, as a document."""
    lines: list[str] = []
    step = _SIDE + 2 * _EDGE
    for number, (title, drawn) in enumerate(panels):
        x, y = number % 2 * step + _EDGE, number // 2 * (step + _HEAD) + _EDGE + _HEAD
        lines.append(f'<g transform="translate({x:.1f} {y:.1f})">')
        lines += [written(0, -14, words.say(title), INK, 13, "start"), *drawn, "</g>"]
    return document(2 * step, (len(panels) + 1) // 2 * (step + _HEAD), lines)


def together(angle: Real, curves: Sequence[tuple[str, Real]], words: Words) -> Iterator[str]:
    """Curves over the angle in one field, with the least and the greatest of each."""
    low, high = min(0.0, *(float(v.min()) for _, v in curves)), max(0.0, *(float(v.max()) for _, v in curves))
    high = high if high > low else low + 1
    tall, top = _SIDE - 18 * len(curves), 18.0 * len(curves)
    x = (angle - angle[0]) / (angle[-1] - angle[0]) * _SIDE
    yield _zero(top + high / (high - low) * tall)
    for number, (name, values) in enumerate(curves):
        yield _curve(x, top + (high - values) / (high - low) * tall, number)
        # what rounding leaves of 0 is 0
        told = (
            value if abs(value) > 1e-12 * (high - low) else 0.0 for value in map(float, (values.min(), values.max()))
        )
        ends = " … ".join(words.decimal(f"{value:.4g}") for value in told)
        yield written(0, 12 + 18 * number, f"{name}  {ends}", _COLOURS[number], 13, "start")


def _zero(y: float) -> str:
    """The axis of a diagram."""
    axis = f"stroke:{_AXIS};stroke-width:1"
    return f'<line x1="0" y1="{y:.2f}" x2="{_SIDE:.0f}" y2="{y:.2f}" style="{axis}"/>'


def _curve(x: Real, y: Real, number: int) -> str:
    """A diagram's curve in a colour of its own, by its points, px."""
    points = zip(x[::_EVERY], y[::_EVERY], strict=True)
    return chain(points, f"fill:none;stroke:{_COLOURS[number]};stroke-width:1.6")


class _View:
    """Points of a drawing within a panel, as large as it takes, y up."""

    def __init__(self, points: Complex) -> None:
        low, high = complex(points.real.min(), points.imag.min()), complex(points.real.max(), points.imag.max())
        size = max(high.real - low.real, high.imag - low.imag) or 1.0
        self.scale, self.middle = _SIDE / size, (low + high) / 2

    def at(self, point: complex) -> tuple[float, float]:
        """Where a point lies in the panel, px."""
        seen = (point - self.middle) * self.scale
        return _SIDE / 2 + seen.real, _SIDE / 2 - seen.imag

    def line(self, points: Complex, colour: str, width: float) -> str:
        """A chain of points."""
        style = f"fill:none;stroke:{colour};stroke-width:{width:g}"
        return chain((self.at(complex(p)) for p in points), style)


def _plan(plan: Plan) -> Iterator[str]:
    ends = [v.end for v in plan.vectors] + [v.start for v in plan.vectors] + [0j]
    view = _View(np.array(ends))
    names, colours = [], []
    for number, vector in enumerate(plan.vectors):
        colour = _COLOURS[number % len(_COLOURS)]
        yield view.line(np.array([vector.start, vector.end]), colour, 1.8)
        (x0, y0), (x1, y1) = view.at(vector.start), view.at(vector.end)
        long = math.hypot(x1 - x0, y1 - y0)
        if long > 6:
            # an arrow of 9 px at its end
            dx, dy = (x1 - x0) / long, (y1 - y0) / long
            tip = [(x1, y1), (x1 - 9 * dx + 3 * dy, y1 - 9 * dy - 3 * dx), (x1 - 9 * dx - 3 * dy, y1 - 9 * dy + 3 * dx)]
            yield chain(tip, f"fill:{colour}", closed=True)
            names.append(beside_line(vector.name, complex(x0, y0), complex(x1, y1)))
            colours.append(colour)
    lines = [line for v in plan.vectors for line in _seen(view, np.array([v.start, v.end]))]
    yield from _named(names, lines, colours)
    x, y = view.at(0j)
    yield circle(x, y, 3.5, f"fill:{INK}", "g")


def _seen(view: _View, points: Complex) -> list[tuple[complex, complex]]:
    """The lines of a chain as they are drawn, px."""
    spots = [complex(*view.at(complex(p))) for p in points]
    return list(pairwise(spots))


def _named(names: Sequence[Name], lines: Sequence[tuple[complex, complex]], colours: Sequence[str]) -> Iterator[str]:
    """Names where they have room; the colours begin anew after the last."""
    for number, (name, at) in enumerate(zip(names, settled(names, lines, _FIELD), strict=True)):
        # the foot of its letters lies 4 px below the middle
        yield written(at.real, at.imag + 4, name.text, colours[number % len(colours)], 13, "middle")

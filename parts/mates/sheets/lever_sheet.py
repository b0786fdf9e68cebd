"""The sheets of a lever mechanism, as coursework asks for them: its scheme in all positions, plans, diagrams, forces.

Guidelines on coursework, 2.2.2 and 2.2.5: each drawing stands to its own scale, which is told above it.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterable, Mapping, Sequence

import numpy as np
from msgspec.structs import replace as changed

from geometry.base.record import Record, replace
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc
from parts.base.texts import N_, Text, Words, message, words
from parts.drawing.canvas import SMALL_TEXT, Canvas, Paper, scale_text, standard_scale, text_width
from parts.drawing.expected import Expected
from parts.drawing.labels import Labeller
from parts.drawing.pieces import Piece, laid, reach, titled
from parts.drawing.revolved import closed
from parts.drawing.table import Row, Table
from parts.drawing.title_block import FORM_1, check_held, draw_title_block, title_block_of
from parts.keys.title import TitleBlockTable
from parts.mates.pages.lever_forces import LeverForce
from parts.mates.pages.lever_picture import SHOWN, LeverPicture, Plan, Run
from parts.pages.page import shortest, unit_text

# on paper, mm: radius of a turning pair, half sides of stones and sliders, foot of a support, hatching
_JOINT, _STONE, _FOOT, _HATCH = 1.2, 4.5 + 2.5j, 4.0, 2.0
# room in which names of a drawing stand about it; points nearer to each other share a name, mm
_ABOUT, _SAME = 14.0, 0.5
# vectors shorter than this have no arrow, those shorter than the second are points, mm
_ARROWED, _POINT = 5.0, 1e-3
# diagrams: length of a turn, greatest height of one, gap, mm; marks on an ordinate
_TURN, _TALL, _BETWEEN, _TICKS = 180.0, 50.0, 14.0, 5
# longest force on Zhukovsky's lever, mm
_FORCE = 45.0
# spans of a path's spline; of the fine positions of a turn every such one is a corner of a curve that may bend
_SPANS, _EVERY = 120, 10
# names of the points of a plan in those of its vectors: π, n3, a3
_POINTS = re.compile(r"[pπ]|[a-z]\d?")
# paper of works and energies: guidelines, 2.2.5, 4
_RUN_PAPER = "A3"


class LeverDrawing(Record, eq=False):
    """What the sheets show. ``drawn_crank``: mm of the crank on paper, which gives the ``scale``, mm for one there;
    ``output``: the point of the output; ``second``: another position, its plans; ``speed`` of the crank, rad/s;
    ``given``: scales by keys.
    """

    title: Text
    picture: LeverPicture
    drawn_crank: float
    scale: float
    output: str
    second: tuple[int, Plan, Plan] | None
    lever: tuple[LeverForce, ...]
    speed: float
    given: dict[str, float]
    paper: str | None
    block: TitleBlockTable | None

    def pages(self, language: str) -> list[Expected]:
        """The sheets in a language.

        Raises
        ------
        ParameterError
            The paper, a scale or words of the title block do not fit.
        """
        told, shown = words(language), self.picture
        pieces = [self._scheme(told), *self._plans(told)]
        over = told.say(N_("Output over a turn"))
        pieces.append(_diagrams(over, shown.angle, [[one] for one in shown.series], shown.positions, told))
        for title, plan in shown.forces:
            heads = (told.say(title), _scaled("F", plan.scale, "N", told))
            pieces.append(self._sized(_chain(plan, heads), "force_scale"))
        if self.lever:
            pieces.append(self._zhukovsky(told))
        canvases = laid(pieces, self.paper)
        if shown.run is not None:
            canvases += laid(_run(shown.run, shown.positions, told), _RUN_PAPER)
        return [self._finished(canvas, k + 1, len(canvases), told) for k, canvas in enumerate(canvases)]

    def _finished(self, canvas: Canvas, number: int, count: int, told: Words) -> Expected:
        """The frame, and the title block where one is asked for, with the scale of the scheme."""
        canvas.box("FRAME", canvas.frame)
        if self.block is not None:
            given = changed(self.block, name=self.block.name or told.say(self.title))
            scale = "" if number > 1 else scale_text(1 / self.scale, told.language)
            block = title_block_of(given, scale, number, count)
            check_held(block, FORM_1, turned=False)
            draw_title_block(canvas, block, told.language)
        return Expected(canvas, Paper(1.0, 0j), ())

    def _sized(self, piece: Piece, key: str) -> Piece:
        """A piece whose scale a key may give."""
        return replace(piece, key=key, value=self.given[key], inverse=True) if key in self.given else piece

    def _scheme(self, told: Words) -> Piece:
        """All positions, the first with its supports, sliders and names; the paths of points."""
        canvas, shown = Canvas(0.0, 0.0, ""), self.picture
        fixed = {name: at / self.scale for name, at in shown.fixed.items()}
        paths = {name: path / self.scale for name, path in shown.paths.items()}
        sliding = [name for name in shown.blocks if name != "A"]
        for name, path in paths.items():
            if name not in sliding:
                _path(canvas, path, fixed.values())
        count = shown.positions if shown.positions <= SHOWN else 1
        places = [{name: at / self.scale for name, at in shown.at(k).items()} for k in range(count)]
        bold = {0: "SCHEME"} | ({} if self.second is None else {self.second[0]: "OUTLINE"})
        for number in sorted(range(count), key=lambda k: (k in bold, -k)):
            for one, two in shown.rods(places[number]):
                canvas.line(bold.get(number, "POSITION"), places[number][one], places[number][two])
        for name, at in places[0].items():
            canvas.add("OUTLINE", Arc(at, _JOINT, 0.0, 2 * math.pi))
            if name in fixed:
                _support(canvas, at)
        for name, way in shown.blocks.items():
            corners = (_STONE, -_STONE.conjugate(), -_STONE, _STONE.conjugate())
            for side in closed([places[0][name] + way / abs(way) * corner for corner in corners]):
                canvas.add("OUTLINE", side)
            if name in sliding:
                _rail(canvas, paths[name], way / abs(way))
        self._named(canvas, places, fixed)
        heads = told.say(N_("Scheme")), _scaled("l", self.scale / 1000, "m", told)
        return replace(titled(canvas, ", ".join(heads)), key="drawn_crank", value=self.drawn_crank)

    def _named(self, canvas: Canvas, places: Sequence[Mapping[str, complex]], fixed: Mapping[str, complex]) -> None:
        """Names of the joints in the first position, numbers of the crank's, and the output's where they lie apart."""
        labels = Labeller(canvas, reach(canvas).grown(_ABOUT))
        for name, at in places[0].items():
            labels.name(_lowered(name), at, prefer=-1 - 1j if name in fixed else 1 + 1j)
        for number, place in enumerate(places if len(places) > 1 else ()):
            labels.name(str(number), place["A"], SMALL_TEXT, prefer=place["A"] - fixed["O1"])
        named = [places[0][self.output]]
        for number, place in enumerate(places):
            at = place[self.output]
            if all(abs(at - other) > 2 * SMALL_TEXT for other in named):
                labels.name(f"{self.output}_{{{number}}}", at, SMALL_TEXT, prefer=1j)
                named.append(at)

    def _plans(self, told: Words) -> Iterable[Piece]:
        """Plans of velocities and accelerations, of one position or two."""
        shown = self.picture
        every = [(0, shown.velocities, shown.accelerations)] + ([] if self.second is None else [self.second])
        for number, *plans in every:
            for plan, title, symbol, unit, layer, key in zip(
                plans,
                (N_("Plan of velocities"), N_("Plan of accelerations")),
                ("v", "a"), ("m/s", "m/s2"), ("VELOCITY", "ACCELERATION"), ("velocity_scale", "acceleration_scale"),
                strict=True,
            ):  # fmt: skip
                head = told.say(title)
                if self.second is not None:
                    head = told.say(message(N_("{title}, position {number}"), title=message(title), number=number))
                yield self._sized(_plan(plan, layer, (head, _scaled(symbol, plan.scale, unit, told))), key)

    def _zhukovsky(self, told: Words) -> Piece:
        """The plan of velocities turned by 90 degrees clockwise with all forces at the ends of their velocities."""
        canvas, speeds = Canvas(0.0, 0.0, ""), self.picture.velocities.scale
        most = max(abs(one.force) for one in self.lever)
        scale = self.given.get("force_scale") or standard_scale((most or 1.0) / _FORCE)
        ends = [(one, -1j * one.velocity / speeds, one.force / scale) for one in self.lever]
        tips: dict[complex, str] = {}
        known = {-1j * v.end / speeds: v.name[1:] for v in self.picture.velocities.vectors if not v.start}
        for one, tip, _ in ends:
            if abs(tip) > _SAME and all(abs(tip - other) > _SAME for other in tips):
                canvas.line("VELOCITY", 0j, tip)
                tips[tip] = next((name for at, name in known.items() if abs(at - tip) < _SAME), f"s{one.name[-1]}")
        canvas.add("OUTLINE", Arc(0j, _JOINT / 2, 0.0, 2 * math.pi))
        rows, named = [], []
        for one, tip, force in ends:
            symbol = _lowered(one.name)
            if abs(force) > _POINT:
                foot = tip - force * (force.conjugate() * tip).real / abs(force) ** 2
                arm = (foot.conjugate() * force).imag / abs(force)
                # of a force across its velocity the arm is drawn already
                if abs(foot) > _SAME and abs(foot - tip) > _SAME:
                    canvas.line("CONSTRUCTION", 0j, foot)
                    canvas.line("CONSTRUCTION", tip, foot)
                _vector(canvas, "FORCE", tip, tip + force)
                if abs(force) > _SAME:
                    named.append((symbol, tip + force * 0.7))
                size = f"{told.decimal(f'{abs(one.force):.5g}')} {unit_text('N', told)}"
                rows.append(Row(symbol, size, f"h = {told.decimal(shortest(arm, 2))} {unit_text('mm', told)}"))
            if one.couple:
                size = f"{told.decimal(f'{one.couple:.5g}')} {unit_text('N*m', told)}"
                rate = f"ω = {told.decimal(f'{one.turning:.5g}')} {unit_text('rad/s', told)}"
                rows.append(Row(symbol.replace("F_", "M_"), size, rate))
        labels = Labeller(canvas, reach(canvas).grown(_ABOUT))
        for at, name in ({0j: "p"} | tips).items():
            labels.name(_lowered(name), at, prefer=at or -1 - 1j)
        for symbol, at in named:
            labels.name(symbol, at)
        moment = -sum(
            ((-1j * one.velocity).conjugate() * one.force).imag + one.couple * one.turning for one in self.lever
        ) / self.speed  # fmt: skip
        size = f"{told.decimal(f'{moment:.6g}')} {unit_text('N*m', told)}"
        rows.append(Row(f"M_{{b}} = -(μ_{{v}}·ΣF·h + ΣM·ω)/ω_{{1}} = {size}"))
        table, drawn = Table(tuple(rows), SMALL_TEXT), reach(canvas)
        table.draw(canvas, complex(drawn.left, drawn.low - 6.0 - table.size[1]))
        heads = ", ".join((_scaled("v", speeds, "m/s", told), _scaled("F", scale, "N", told)))
        return self._sized(titled(canvas, told.say(N_("Zhukovsky's lever")), heads), "velocity_scale")


def _scaled(symbol: str, scale: float, unit: str, told: Words) -> str:
    """A scale as it is told: what 1 mm of paper stands for."""
    text = unit_text(unit, told)
    text = f"({text})" if "/" in text else text
    return f"μ_{{{symbol}}} = {told.decimal(f'{scale:.6g}')} {text}/{unit_text('mm', told)}"


def _lowered(name: str) -> str:
    """R_34n and a3 with what stands low in them."""
    head, _, index = name.partition("_")
    return f"{head}_{{{index}}}" if index else re.sub(r"^(.)(\d+)$", r"\1_{\2}", name)


def _support(canvas: Canvas, at: complex) -> None:
    """A pivot on the frame, GOST 2.770: a triangle on a hatched line."""
    foot = at - 1.5j * _FOOT
    for side in (-1, 1):
        canvas.line("AXIS", at + _JOINT * cmath.exp(1j * (-math.pi / 2 + side * 0.6)), foot + side * _FOOT * 0.8)
    _hatched(canvas, foot - 1.3 * _FOOT, foot + 1.3 * _FOOT, -1j)


def _hatched(canvas: Canvas, start: complex, end: complex, side: complex) -> None:
    """A line of the frame with its hatching on a side."""
    canvas.line("AXIS", start, end)
    way = (end - start) / abs(end - start)
    count = int(abs(end - start) / _HATCH)
    for k in range(1, count + 1):
        foot = start + way * k * abs(end - start) / count
        canvas.line("HATCH", foot, foot + _HATCH * 0.8 * (side - way))


def _rail(canvas: Canvas, path: Complex, way: complex) -> None:
    """The guide of a slider over all of its way."""
    along = np.real(path * way.conjugate())
    low, high = (complex(path[k]) for k in (np.argmin(along), np.argmax(along)))
    down = -1j * way if (-1j * way).imag < 0 else 1j * way
    beyond = (_STONE.real + 3.0) * way
    _hatched(canvas, low - beyond + _STONE.imag * down, high + beyond + _STONE.imag * down, down)
    canvas.line("CENTRE", low - beyond, high + beyond)


def _path(canvas: Canvas, path: Complex, pivots: Iterable[complex]) -> None:
    """The closed way of a point: an arc about a pivot, to and fro, else a spline through exact points."""
    size = float(np.ptp(path.real) + np.ptp(path.imag)) or 1.0
    for pivot in pivots:
        spokes = path - pivot
        if np.ptp(np.abs(spokes)) < 1e-9 * size:
            turned = np.unwrap(np.angle(np.append(spokes, spokes[0])))
            start, sweep = float(turned.min()), float(np.ptp(turned))
            around = abs(turned[-1] - turned[0]) > math.pi
            canvas.add("PATH", Arc(pivot, float(np.abs(spokes[0])), start, 2 * math.pi if around else sweep))
            return
    step = next(k for k in range(max(len(path) // _SPANS, 1), 0, -1) if len(path) % k == 0)
    # by the neighbours on both sides: their errors are far below a rounding of the file
    slopes = (8 * (np.roll(path, -1) - np.roll(path, 1)) - (np.roll(path, -2) - np.roll(path, 2))) / 12 * step
    spots, ways = (np.append(x[::step], x[0]) for x in (path, slopes))
    canvas.add("PATH", _spline(spots, ways[:-1], ways[1:]))


def _spline(spots: Complex, out: Complex, into: Complex) -> BSpline:
    """A cubic through points, with its derivatives at both ends of each span of length 1."""
    count = len(spots) - 1
    poles = np.empty(3 * count + 1, complex)
    poles[::3], poles[1::3], poles[2::3] = spots, spots[:-1] + out / 3, spots[1:] - into / 3
    return BSpline(3, np.repeat(np.arange(count + 1.0), [4, *[3] * (count - 1), 4]), poles)


def _vector(canvas: Canvas, layer: str, start: complex, end: complex) -> None:
    """A vector with its arrow, where there is room for one; none of a point."""
    if abs(end - start) > _POINT:
        canvas.line(layer, start, end)
    if abs(end - start) > _ARROWED:
        canvas.arrow(layer, end, (end - start) / abs(end - start))


def _plan(plan: Plan, layer: str, heads: tuple[str, str]) -> Piece:
    """Vectors from the pole, those between their ends thinner, and the names of all points."""
    canvas, pole = Canvas(0.0, 0.0, ""), plan.vectors[0].name[0]
    canvas.add("OUTLINE", Arc(0j, _JOINT / 2, 0.0, 2 * math.pi))
    spots: list[tuple[complex, list[str]]] = [(0j, [pole])]
    for vector in plan.vectors:
        start, end = vector.start / plan.scale, vector.end / plan.scale
        _vector(canvas, "RELATIVE" if vector.start else layer, start, end)
        name = _lowered(_POINTS.findall(vector.name)[-1])
        near = next((names for at, names in spots if abs(at - end) < _SAME), None)
        known = any(abs(at - end) < _SAME and at for at, _ in spots)
        if near is None:
            spots.append((end, [name]))
        elif name not in near and not (known and vector.start and name[0] == near[0][0]):
            near.append(name)
    labels = Labeller(canvas, reach(canvas).grown(_ABOUT))
    for at, names in spots:
        labels.name(", ".join(names), at, prefer=at or -1 - 1j)
    return titled(canvas, *heads)


def _chain(plan: Plan, heads: tuple[str, str]) -> Piece:
    """Vectors with their names beside their middles."""
    canvas = Canvas(0.0, 0.0, "")
    ends = [(v.name, v.start / plan.scale, v.end / plan.scale) for v in plan.vectors]
    for _, start, end in ends:
        _vector(canvas, "FORCE", start, end)
    if not canvas.strokes:
        canvas.add("OUTLINE", Arc(0j, _JOINT / 2, 0.0, 2 * math.pi))
    labels = Labeller(canvas, reach(canvas).grown(_ABOUT))
    for name, start, end in ends:
        if abs(end - start) > _SAME:
            labels.name(_lowered(name), (start + end) / 2, prefer=1j * (end - start))
    return titled(canvas, *heads)


# symbol, unit, values over the turn
_Series = tuple[str, str, Real]
_LAYERS = ("DIAGRAM_LIFT", "DIAGRAM_RATE", "DIAGRAM_BEND")


def _diagrams(title: str, angle: Real, graphs: Sequence[Sequence[_Series]], positions: int, told: Words) -> Piece:
    """Graphs over the turn, one below the other, each with the scale of all of its curves (GOST 2.319)."""
    canvas, top = Canvas(0.0, 0.0, ""), 0.0
    steps = np.linspace(0.0, _TURN, len(angle) + 1 if angle[-1] - angle[0] < 360 - 1e-6 else len(angle))
    heads = [_scaled("φ", 360 / _TURN, "deg", told)]
    named: list[tuple[str, complex, complex]] = []
    for number, curves in enumerate(graphs):
        closed = [np.append(v, v[0]) if len(v) < len(steps) else v for _, _, v in curves]
        low, high = min(0.0, *map(np.min, closed)), max(0.0, *map(np.max, closed))
        scale = standard_scale((high - low) / _TALL) if high - low > 1e-12 else 1.0
        zero = top - high / scale
        axis, foot = complex(0, zero), zero + low / scale
        for x in (np.arange(1, positions + 1) * _TURN / positions).tolist() if positions <= SHOWN else ():
            canvas.line("ORDINATE", complex(x, foot), complex(x, top))
        canvas.line("AXIS", axis, axis + _TURN + 8)
        canvas.arrow("AXIS", axis + _TURN + 8, 1.0)
        canvas.line("AXIS", complex(0, foot - 1), complex(0, top + 7))
        canvas.arrow("AXIS", complex(0, top + 7), 1j)
        symbol, unit = "".join(curves[0][0].split("_")[0]), curves[0][1]
        canvas.write(f"{symbol}, {unit_text(unit, told)}", complex(2.5, top + 4.5), SMALL_TEXT)
        named.append(("φ_{1}", axis + _TURN + 5, 1j))
        heads.append(_scaled(symbol, scale, unit, told))
        step = standard_scale(max(high - low, 1e-12) / _TICKS)
        for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1):
            at, text = axis + 1j * k * step / scale, told.decimal(f"{k * step:.6g}")
            canvas.line("AXIS", at - 0.8, at + 0.8)
            canvas.write(text, at - complex(2.0 + text_width(text, SMALL_TEXT), SMALL_TEXT / 2), SMALL_TEXT)
        for layer, (name, _, _), values in zip(_LAYERS, curves, closed, strict=False):
            spots = (steps + 1j * (zero + values / scale))[::_EVERY]
            canvas.add(layer, _spline(spots, np.diff(spots), np.diff(spots)))
            if len(curves) > 1:
                # where it lies farthest from the others
                others = np.min([np.abs(values - other) for other in closed if other is not values], axis=0)
                most = int(np.argmax(others[: len(steps) * 9 // 10]))
                named.append(
                    (_lowered(name), complex(steps[most], zero + values[most] / scale), 1j * np.sign(values[most]))
                )
            if name == "ΔT_m":
                heads.append(_segment(canvas, zero + values.min() / scale, zero + values.max() / scale, told))
        if positions <= SHOWN and number == len(graphs) - 1:
            for k in range(positions + 1):
                text = str(k % positions)
                x = k * _TURN / positions - text_width(text, SMALL_TEXT) / 2
                canvas.write(text, complex(x, foot - 5.0), SMALL_TEXT)
        top = foot - _BETWEEN
    labels = Labeller(canvas, reach(canvas).grown(_ABOUT))
    for name, at, side in named:
        labels.name(name, at, prefer=side)
    return titled(canvas, title, ", ".join(heads))


def _segment(canvas: Canvas, low: float, high: float, told: Words) -> str:
    """The segment KK_1 beside a diagram of the flywheel's energy: guidelines, 2.2.5, 5; its length as it is told."""
    right = complex(_TURN + 14.0, 0.0)
    for y in (low, high):
        canvas.line("CONSTRUCTION", 1j * y, right + 1j * y + 2.0)
    canvas.line("DIMENSION", right + 1j * low, right + 1j * high)
    for y, way in ((low, -1j), (high, 1j)):
        canvas.arrow("DIMENSION", right + 1j * y, way, 2.5)
    canvas.write("KK_{1}", right + complex(2.0, (low + high) / 2), SMALL_TEXT)
    return f"KK_{{1}} = {told.decimal(f'{high - low:.2f}')} {unit_text('mm', told)}"


def _run(run: Run, positions: int, told: Words) -> list[Piece]:
    """Reduced moments, works and energies over a turn."""
    driven = run.driving * np.radians(run.angle - run.angle[0])
    driving = np.full(len(run.angle), run.driving)
    graphs = (
        (("M_c", "N*m", run.resisting), ("M_d", "N*m", driving)),
        (("A_c", "J", driven - run.gained), ("A_d", "J", driven)),
        (("ΔT", "J", run.gained), ("ΔT_l", "J", run.of_links), ("ΔT_m", "J", run.of_flywheel)),
    )
    title = told.say(N_("Moments, works and energies over the turn"))
    return [_diagrams(title, run.angle, graphs, positions, told)]

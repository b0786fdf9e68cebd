"""What sheets are laid out with: how far curves reach, what of them is seen, where words and sizes have room."""

from __future__ import annotations

import cmath
import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest

from geometry.base.placement import Placement2
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Curve
from geometry.curves.ellipse import EllipticArc
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Profile, Segment, circle
from geometry.solids.hub_holes import HubHoles
from geometry.solids.windows import RoundHoles
from parts.bodies import plate_drawing
from parts.drawing.canvas import Box, Canvas, text_of, text_width
from parts.drawing.extent import crossings, farthest, reach, sampled
from parts.drawing.ink import Ink
from parts.drawing.labels import Labeller, nearest, spread
from parts.drawing.names import caption_name
from parts.drawing.parts_list import mass_text
from parts.drawing.places import apart, circled, place_sizes, spans
from parts.drawing.shown import shown_pieces
from parts.drawing.table import Row, Table
from parts.scene.load import make_parts, scene_from_dict

WAYS = [cmath.rect(1.0, math.radians(a)) for a in (0.0, 37.0, 90.0, 200.0, -75.0)]


@pytest.mark.parametrize("way", WAYS)
def test_the_farthest_place_of_an_ellipse_is_its_support(way: complex) -> None:
    """h = sqrt(a^2 cos^2 + b^2 sin^2), met at (a^2 cos, b^2 sin) / h; of an arc that ends before it the end."""
    a, b = 30.0, 12.0
    whole = EllipticArc(Arc(0j, a, 0.3, 2 * math.pi), b / a, Placement2())
    h = math.hypot(a * way.real, b * way.imag)
    assert farthest([whole], way) == pytest.approx(complex(a**2 * way.real, b**2 * way.imag) / h, abs=1e-9)
    # of several the farthest, of those that are equally far the first
    circles = [
        Arc(0j, 2.0, 0.0, 2 * math.pi),
        Arc(100 * way, 1.0, 0.0, 2 * math.pi),
        Arc(99 * way, 2.0, 0.0, 2 * math.pi),
    ]
    assert farthest(circles, way) == pytest.approx(101 * way, abs=1e-9)
    twins = [Arc(at, 1.0, 0.1, 2 * math.pi) for at in (7j * way, 3j * way)]
    assert farthest(twins, way) == pytest.approx(way + 7j * way, abs=1e-9)


@pytest.mark.parametrize("beside", [-0.04, 0.0, 0.04])
@pytest.mark.parametrize("sense", [1, -1])
def test_what_is_farthest_beside_the_seam_of_a_circle_is_found(beside: float, sense: int) -> None:
    """Before it the seam itself was taken: a circle of 50 mm ended 0.04 mm short."""
    for at in (0.0, 1.0):
        way = cmath.rect(1.0, at + beside)
        assert farthest([Arc(0j, 50.0, at, sense * 2 * math.pi)], way) == pytest.approx(50 * way, abs=1e-6)


def test_the_end_of_a_curve_may_be_its_farthest_place() -> None:
    arc = Arc(0j, 10.0, 0.2, 1.0)
    assert farthest([arc], 1 + 0j) == pytest.approx(cmath.rect(10.0, 0.2))
    assert farthest([arc], -1 + 0j) == pytest.approx(cmath.rect(10.0, 1.2))
    assert farthest([arc], cmath.rect(1.0, 0.7)) == pytest.approx(cmath.rect(10.0, 0.7), abs=1e-9)


def test_crossings_of_a_circle_and_a_line_are_those_of_the_quadratic() -> None:
    profile = circle(5.0, Label.BORE)
    start, way = -7 + 2j, cmath.rect(1.0, 0.1)
    foot = -(start / way).real
    half = math.sqrt(25 - (start / way).imag ** 2)
    assert sorted(crossings(sampled(profile), start, way)) == pytest.approx([foot - half, foot + half], abs=1e-9)
    assert crossings(sampled(profile), 6j, 1 + 0j) == []
    # the seam at angle 0 too, which was lost
    for angle in (0.0, 1.0, -2.0):
        assert reach(profile, angle) == pytest.approx(5.0, abs=1e-9)
        assert sorted(crossings(sampled(profile), 0j, cmath.rect(1.0, angle))) == pytest.approx([-5.0, 5.0], abs=1e-9)


@pytest.mark.parametrize("turn", np.arange(24) * math.pi / 12)
def test_an_outline_whose_corners_lie_on_the_line_is_crossed_there(turn: float) -> None:
    """A square: whatever rounding makes of its corners, an even number of crossings, the farthest a corner."""
    corners = [complex(10 * cmath.exp(1j * (turn + k * math.pi / 2))) for k in range(4)]
    sides = [Segment(Line(a, b), Label.BORE) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    square = Profile(tuple(sides), 1)
    assert reach(square, turn) == pytest.approx(10.0, abs=1e-9)
    assert len(crossings(sampled(square), 0j, cmath.rect(1.0, turn))) == 2


def hides(*ranges: tuple[float, float]) -> Callable[[np.ndarray], np.ndarray]:
    return lambda t: np.logical_or.reduce([(low < t) & (t < high) for low, high in ranges] or [np.zeros(len(t), bool)])


@pytest.mark.parametrize(
    ("ranges", "seen"),
    [
        ((), [(0, 10)]),
        (((2.03, 6.12),), [(0, 2.03), (6.12, 10)]),
        (((-1, 4.01),), [(4.01, 10)]),
        (((3.02, 11),), [(0, 3.02)]),
        (((-1, 11),), []),
        (((-1, 2.02), (4.03, 5.11), (7.2, 11)), [(2.02, 4.03), (5.11, 7.2)]),
    ],
)
def test_of_an_edge_the_pieces_are_drawn_that_nothing_hides(
    ranges: tuple[tuple[float, float], ...], seen: list[tuple[float, float]]
) -> None:
    curve: Curve = Line(0j, 10 + 0j)
    low, high = curve.domain
    found = list(shown_pieces(curve, lambda t: hides(*ranges)(10 * (t - low) / (high - low))))
    ends = [(complex(p.point(p.domain[0])).real, complex(p.point(p.domain[1])).real) for p in found]
    assert ends == [pytest.approx(x, abs=1e-6) for x in seen]
    assert (found == [curve]) is (not ranges)


def holes(*groups: tuple[int, float, float, float]) -> HubHoles:
    return HubHoles(
        None, round_holes=tuple(RoundHoles(count, d, circle_, math.radians(a)) for count, d, circle_, a in groups)
    )


def test_holes_alone_are_told_by_their_places_where_several_are_alike() -> None:
    own = holes(
        (1, 5.0, 20.0, 0.0), (1, 5.0, 30.0, 40.0), (1, 6.0, 25.0, 0.0), (4, 5.0, 40.0, 0.0), (2, 7.0, 50.0, 0.0)
    )
    one, two, other, four, pair = own.round_holes
    assert apart(own) == (one, two)
    assert circled(own) == (other, four, pair)


@pytest.mark.parametrize("right", [64.61153060046303, 64.61153060056303])
def test_corners_of_a_plate_that_grew_to_any_place_have_no_size_beside_its_width(right: float) -> None:
    """As it was: the width was told twice where its ninth decimal was rounded down."""
    low, high = -30 - 20j, complex(right, 20)
    places = [low, complex(right, -20), high, 0j, 58.6 + 0j]
    told = [size.name for size in plate_drawing.place_sizes(low, (low, low), places, (low, high))]
    assert told == ["x.2", "x.3", "y.2"]


def test_sizes_of_places_run_from_the_axes_or_from_side_to_side() -> None:
    assert list(spans([3.0, -3.0, 5.0, 0.0, -2.0, 5.0 + 1e-12])) == [(-2.0, 0.0), (-3.0, 3.0), (0.0, 5.0)]
    assert list(spans([])) == []
    places = [3 + 1j, -3 + 1j, 5 - 2j, 5 + 4j]
    told = {s.name: (s.start, s.end, s.side) for s in place_sizes(places, -9 - 8j)}
    assert told == {
        # from the lowest, and the leftmost, place of each coordinate; from an axis at the corner of the view
        "x.1": (-3 + 1j, 3 + 1j, "below"), "x.2": (-8j, 5 - 2j, "below"),
        "y.1": (5 - 2j, -9 + 0j, "left"), "y.2": (-9 + 0j, -3 + 1j, "left"), "y.3": (-9 + 0j, 5 + 4j, "left"),
    }  # fmt: skip


def test_the_nearest_place_of_a_box() -> None:
    box = Box(0.0, 0.0, 4.0, 2.0)
    for point, found in (
        (1 + 1j, 1 + 1j),
        (-1 - 1j, 0j),
        (5 + 1j, 4 + 1j),
        (2 + 9j, 2 + 2j),
        (9 - 3j, 4 + 0j),
        (-2 + 5j, 2j),
    ):
        assert nearest(box, point) == found


@pytest.mark.parametrize("wanted", [[1.0, 1.1, 1.2, 8.0], [0.0, 5.0, 9.9, 10.0], [4.0, 4.0, 4.0], [-5.0, 20.0], [3.0]])
def test_places_are_spread_by_least_squares(wanted: list[float]) -> None:
    """Against a solver of quadratic programs: at least a step apart, within their limits."""
    from scipy.optimize import minimize

    step, low, high = 2.0, 0.0, 10.0
    found = spread(wanted, step, low, high)
    cons = [{"type": "ineq", "fun": lambda x, k=k: x[k + 1] - x[k] - step} for k in range(len(wanted) - 1)]
    best = minimize(
        lambda x: float(np.sum((x - np.array(wanted)) ** 2)), np.linspace(low, high, len(wanted)),
        bounds=[(low, high)] * len(wanted), constraints=cons, tol=1e-12,
    )  # fmt: skip
    assert found == pytest.approx(best.x, abs=1e-4)


def test_places_that_have_no_room_are_even() -> None:
    assert spread([5.0] * 6, 3.0, 0.0, 10.0) == pytest.approx([0, 2, 4, 6, 8, 10])
    assert spread([], 3.0, 0.0, 10.0) == []
    assert spread([50.0], 3.0, 0.0, 10.0) == [10.0]


def crossing(box: Box, line: Line) -> bool:
    """Whether a piece of a line lies in the inner part of a box: by many of its points."""
    t = np.linspace(0, 1, 4001)
    p = line.start + (line.end - line.start) * t
    return bool(((p.real > box.left) & (p.real < box.right) & (p.imag > box.low) & (p.imag < box.high)).any())


def test_words_have_room_where_neither_lines_nor_words_are() -> None:
    """0.4 mm off; every answer by brute force over points of the lines."""
    draw = np.random.default_rng(11)
    ink = Ink()
    lines = [Line(complex(*draw.uniform(0, 40, 2)), complex(*draw.uniform(0, 40, 2))) for _ in range(6)]
    lines += [Line(5 + 30j, 15 + 30j), Line(30 + 5j, 30 + 12j)]
    for line in lines:
        ink.add(line)
    ink.add(Arc(20 + 20j, 6.0, 0.0, 2.0))
    ink.boxes += [Box(2.0, 2.0, 8.0, 4.0), Box(25.0, 33.0, 31.0, 36.0)]
    arc = Arc(20 + 20j, 6.0, 0.0, 2.0).point(np.linspace(*Arc(20 + 20j, 6.0, 0.0, 2.0).domain, 33))
    drawn = [*lines, *(Line(a, b) for a, b in itertools.pairwise(arc.tolist()))]
    answers = []
    for _ in range(80):
        x, y = draw.uniform(0, 38, 2)
        words, own = Box(x, y, x + 2.0, y + 1.5), [Line(complex(*draw.uniform(0, 40, 2)), complex(x, y) - 1 - 1j)]
        wide = words.grown(0.4)
        free = not any(b.overlaps(wide) for b in ink.boxes) and not any(crossing(wide, line) for line in drawn)
        free = free and not any(crossing(b, line) for line in own for b in (*(o.grown(0.4) for o in ink.boxes), wide))
        assert ink.holds(own, words) is free
        answers.append(free)
    assert 10 < sum(answers) < 70


def test_upright_and_level_lines_are_met_too() -> None:
    ink = Ink()
    ink.add(Line(5 + 0j, 5 + 10j))
    ink.add(Line(0j, 10 + 0j))
    for at, free in ((4.5 + 3j, False), (2.59 + 3j, True), (2.61 + 3j, False), (5.39 + 3j, False), (5.41 + 3j, True)):
        assert ink.holds([], Box(at.real, at.imag, at.real + 2.0, at.imag + 1.0)) is free
    for low, free in ((0.39, False), (0.41, True), (-1.39, False), (-1.41, True), (-0.5, False)):
        assert ink.holds([], Box(7.0, low, 9.0, low + 1.0)) is free
    # an arc is no chord
    bow = Ink()
    bow.add(Arc(0j, 10.0, 0.0, math.pi))
    assert not bow.holds([], Box(-1.0, 9.5, 1.0, 10.5))
    assert bow.holds([], Box(-1.0, -0.3, 1.0, 0.3))
    # beyond the end of a line there is room
    assert ink.holds([], Box(4.0, 10.41, 6.0, 11.0))
    assert not ink.holds([], Box(4.0, 10.39, 6.0, 11.0))


@pytest.mark.parametrize("way", [1, 1j, -1, -1j])
def test_words_and_their_lines_keep_off_other_words(way: complex) -> None:
    """0.4 mm to each side; words alone, and a leader that passes beside."""
    ink = Ink()
    ink.add(Line(100 + 0j, 100 + 1j))
    ink.boxes.append(Box(-3.0, -1.0, 3.0, 1.0))
    reach = 3.0 if way.real else 1.0
    for away, free in ((0.35, False), (0.45, True)):
        middle = way * (reach + 0.5 + away)
        words = Box(middle.real - 0.5, middle.imag - 0.5, middle.real + 0.5, middle.imag + 0.5)
        assert ink.holds([], words) is free
        foot = way * (reach + away)
        leader = Line(foot + 9j * way, foot - 9j * way)
        assert ink.holds([leader], Box(50.0, 50.0, 51.0, 51.0)) is free
        # a leader over its own words is none
        assert not ink.holds([Line(49 + 50.5j, 52 + 50.5j)], Box(50.0, 50.0, 51.0, 51.0))


@pytest.mark.parametrize(
    ("line", "under"),
    [
        (Line(0j, 10 + 0j), True), (Line(10 + 0j, 0j), True), (Line(0.99j, 10 + 0.99j), True),
        (Line(1.01j, 10 + 1.01j), False),
        (Line(-0.99j, 10 - 0.99j), True), (Line(-5 + 0j, 0.6 + 0j), True), (Line(-5 + 0j, 0.4 + 0j), False),
        (Line(9.6 + 0j, 12 + 0j), False), (Line(9.4 + 0j, 12 + 0j), True), (Line(20 + 0j, 30 + 0j), False),
    ],
)  # fmt: skip
def test_a_level_line_seems_one_with_another_that_is_near(line: Line, under: bool) -> None:
    for up in (0j, 7j):
        ink = Ink()
        ink.add(Line(up, 10 + up))
        # one that rises is another
        ink.add(Line(20 + up, 30 + 0.31j + up))
        assert ink.under(Line(line.start + up, line.end + up)) is under
        rising = Ink()
        rising.add(Line(20 + up, 30 + 0.29j + up))
        assert rising.under(Line(20 + up, 30 + up))


# what a new line costs by what it crosses: GOST 2.307 allows extension lines to cross each other, not dimension lines
COSTS = {
    ("edge", "edge"): 0.0, ("edge", "extension"): 0.0, ("edge", "dimension"): 0.3, ("edge", "leader"): 1.5,
    ("extension", "extension"): 0.0, ("extension", "dimension"): 1.5, ("extension", "leader"): 1.5,
    ("dimension", "dimension"): 6.0, ("dimension", "leader"): 18.0, ("leader", "leader"): 20.0,
}  # fmt: skip
ROLES = ("edge", "extension", "dimension", "leader")


@pytest.mark.parametrize("new", ROLES)
@pytest.mark.parametrize("old", ROLES)
def test_crossings_cost_what_the_standard_minds(new: str, old: str) -> None:
    """Both ways alike; two crossings cost twice as much, none nothing; so do lines by their place, not by their way."""
    # edges are there before all that costs
    each = 0.0 if new == "edge" else COSTS.get((new, old), COSTS.get((old, new)))
    ink = Ink()
    ink.add(Line(0j, 10 + 0j), old)  # type: ignore[arg-type]
    places = [
        {new: [Line(5 - 5j, 5 + 5j)]}, {new: [Line(5 - 5j, 5 + 5j), Line(3 + 5j, 2 - 5j)]},
        {new: [Line(15 - 5j, 15 + 5j)]}, {}, {new: [Line(5 + 1j, 5 + 5j)]},
    ]  # fmt: skip
    assert ink.costs(places) == [each, 2 * each, 0.0, 0.0, 0.0]  # type: ignore[arg-type, operator]
    assert ink.costs([]) == []
    assert ink.costs([{}, {}]) == [0.0, 0.0]


@pytest.mark.parametrize("new", ROLES[1:])
@pytest.mark.parametrize("old", ROLES)
@pytest.mark.parametrize("sense", [1, -1])
def test_a_line_that_ends_in_another_does_not_cross_it(new: str, old: str, sense: int) -> None:
    """Within 0.3 mm; but leaders keep as far off the ends of dimension lines and of leaders."""
    each = COSTS.get((new, old), COSTS.get((old, new)))
    keeps = "leader" in (new, old) and {new, old} <= {"leader", "dimension"}
    ink = Ink()
    ink.add(Line(0j, 10 + 0j), old)  # type: ignore[arg-type]

    def cost(line: Line) -> float:
        return ink.costs([{new: [line]}])[0]  # type: ignore[dict-item]

    for past, touches in ((0.35, False), (0.25, True), (-0.25, True), (-0.35, False)):
        crosses = past > 0.3 or (keeps and past > -0.3)
        assert cost(Line(5 - 5j * sense, 5 + past * 1j * sense)) == (each if crosses else 0.0)
        assert cost(Line(5 + past * 1j * sense, 5 - 5j * sense)) == (each if crosses else 0.0)
        # the same at the ends of the old one
        assert cost(Line(10 - past - 5j, 10 - past + 5j)) == (each if crosses else 0.0)
        assert cost(Line(past - 5j, past + 5j)) == (each if crosses else 0.0)
        assert touches is (abs(past) < 0.3)


@pytest.mark.parametrize(
    ("line", "lies"),
    [
        (Line(2 + 0j, 8 + 0j), True), (Line(8 + 0.9j, 2 + 0.9j), True), (Line(2 + 1.1j, 8 + 1.1j), False),
        (Line(-4 + 0j, 0.6 + 0j), True), (Line(-4 + 0j, 0.4 + 0j), False), (Line(9.4 + 0j, 20 + 0j), True),
        (Line(9.6 + 0j, 20 + 0j), False), (Line(-4 - 0.9j, 20 - 0.9j), True),
    ],
)  # fmt: skip
def test_dimension_lines_and_leaders_do_not_lie_on_lines(line: Line, lies: bool) -> None:
    ink = Ink()
    ink.add(Line(0j, 10 + 0j), "edge")
    for role, cost in (("edge", 0.0), ("extension", 0.0), ("dimension", 10.0), ("leader", 10.0)):
        assert ink.costs([{role: [line]}]) == [cost if lies else 0.0]  # type: ignore[dict-item]
        for way, at in ((1j, 3 - 8j), (cmath.rect(1.0, 0.4), 20 + 5j)):
            leaning = Ink()
            leaning.add(Line(at + 10 * way, at), "edge")
            turned = [Line(at + line.start * way, at + line.end * way)]
            assert leaning.costs([{role: turned}]) == [cost if lies else 0.0]  # type: ignore[dict-item]
            # one that leans by more than a ten-thousandth crosses it
            steep = [Line(at + way * (2 - 0.05j), at + way * (8 + 0.05j))]
            own = COSTS["edge", role]
            assert leaning.costs([{role: steep}]) == [own]  # type: ignore[dict-item]


def test_leaders_that_run_over_dimension_lines_or_leaders_are_counted() -> None:
    ink = Ink()
    for y in (0, 5):
        ink.add(Line(complex(0, y), complex(10, y)), "dimension")
    ink.add(Line(5 - 5j, 5 + 2j), "leader")
    assert ink.run_over() == (0, 1)
    ink.add(Line(3 - 5j, 3 + 8j), "leader")
    assert ink.run_over() == (0, 2)
    ink.add(Line(1 - 5j, 1 + 8j), "extension")
    assert ink.run_over() == (0, 2)
    # a spline is no straight line
    ink.add(BSpline(1, np.array([0.0, 0, 1, 1]), np.array([2 - 5j, 2 + 8j])), "leader")
    assert (ink.run_over(), ink.straight.shape) == ((0, 2), (3, 5))
    # a shelf that ends on its leader does not cross it, another leader does
    ink.add(Line(5 + 2j, 9 + 2j), "leader")
    assert ink.run_over()[0] == 0
    ink.add(Line(4 + 1j, 6 + 1j), "leader")
    assert ink.run_over()[0] == 1


ROWS = (
    Row("Gear"), Row("teeth", "z", "21"), Row("a longer name", "d_{a}", "115.25", answers=2), Row("line", sample="CAM"),
)  # fmt: skip


def columns(size: float) -> list[float]:
    """Each as wide as the widest of its words and 0.45 heights on both sides; a sample takes six heights."""
    wide = [
        max(text_width(t, size) for t in own) + 0.9 * size
        for own in (("teeth", "a longer name", "line"), ("z", "d_{a}"), ("21", "115.25"))
    ]
    wide[2] += max(sum(wide), wide[0] + 6 * size, text_width("Gear", size) + 0.9 * size) - sum(wide)
    return wide


@pytest.mark.parametrize("size", [2.5, 5.0])
def test_a_table_is_as_wide_as_its_words(size: float) -> None:
    table = Table(ROWS, size)
    assert table.columns == pytest.approx(columns(size))
    assert table.size == pytest.approx((sum(columns(size)), 4 * 1.85 * size))
    # a heading that is longer widens the last column
    long = "a heading that is longer than all columns are together, by far"
    wide = Table((Row(long), *ROWS), size).columns
    assert sum(wide) == pytest.approx(text_width(long, size) + 0.9 * size)
    assert wide[:2] == pytest.approx(columns(size)[:2])
    sample = Table((Row("x", sample="CAM"), Row("x", "y", "1")), size).columns
    assert sum(sample) == pytest.approx(text_width("x", size) + 6.9 * size)
    assert Table((Row("x", value="1"),), size).columns[1] == 0.0


def test_a_table_without_room_narrows_its_widest_columns() -> None:
    """Narrow ones keep theirs; the others share what is left."""
    own = Table(ROWS, 3.5).columns
    least, middle, most = sorted(own)
    for room in (sum(own), least + 2 * middle, least + middle, 3 * least, least):
        found = Table(ROWS, 3.5, room).columns
        assert sum(found) == pytest.approx(min(room, sum(own)))
        limit = max(found)
        assert found == pytest.approx([min(wide, limit) for wide in own])
    assert most > middle > least


def test_a_table_is_drawn_row_by_row_from_its_upper_side() -> None:
    size, corner = 2.5, 10 + 20j
    canvas = Canvas(200.0, 200.0, "")
    Table(ROWS, size).draw(canvas, corner)
    a, b, c = columns(size)
    step, left, right, top = 1.85 * size, 10.0, 10 + a + b + c, 20 + 4 * 1.85 * size

    def row(k: int) -> float:
        return top - step * (k + 1)

    ends = [[complex(s.curve.point(t)) for t in s.curve.domain] for s in canvas.strokes if s.layer == "TABLE"]
    lines = {tuple(sorted((round(p.real, 6), round(p.imag, 6)) for p in both)) for both in ends}
    level = [(left, y, right, y) for y in (20.0, top, *(row(k) + step for k in (1, 2, 3)))]
    upright = [(x, 20.0, x, top) for x in (left, right)]
    upright += [(x, row(k), x, row(k) + step) for k in (1, 2) for x in (left + a, left + a + b)]
    # the row of a sample has its line in place of the last two cells
    upright += [(left + a, row(3), left + a, row(3) + step)]
    assert lines == {((round(x, 6), round(y, 6)), (round(v, 6), round(w, 6))) for x, y, v, w in level + upright}
    (sample,) = (s.curve for s in canvas.strokes if s.layer == "CAM")
    y = row(3) + step / 2
    assert [complex(sample.point(t)) for t in sample.domain] == pytest.approx(
        [complex(left + a + 0.45 * size, y), complex(right - 0.45 * size, y)]
    )
    indent = 0.45 * size
    places = {
        "Gear": (left, 0, False), "teeth": (left, 1, False), "z": (left + a, 1, False), "21": (left + a + b, 1, True),
        "a longer name": (left, 2, False), "da": (left + a, 2, True), "115.25": (left + a + b, 2, True),
        "line": (left, 3, False),
    }  # fmt: skip
    assert [t.text for t in canvas.texts] == list(places)
    for told in canvas.texts:
        x, k, answer = places[told.text]
        assert told.runs[0].at == pytest.approx(complex(x + indent, row(k) + (step - size) / 2))
        assert told.answer is answer


def placed(canvas: Canvas, told: str) -> Box:
    return next(t.box for t in canvas.texts if t.text == told)


def test_a_name_stands_beside_its_point_where_nothing_is() -> None:
    """On the side that is asked for, 1.5 mm off; over no line and no word; else farther, with a line from 3 mm on."""
    for prefer in (1, 1j, -1, -1j):
        canvas = Canvas(100.0, 100.0, "")
        Labeller(canvas, canvas.frame).name("A1", 50 + 50j, 3.5, prefer)
        box = placed(canvas, "A1")
        middle = complex(box.left + box.right, box.low + 0.3 * 3.5 + box.low + 1.3 * 3.5) / 2
        half = text_width("A1", 3.5) / 2 if prefer in (1, -1) else 3.5 / 2
        assert middle - 50 - 50j == pytest.approx(prefer * (1.5 + half), abs=1e-6)
        assert canvas.strokes == []


def test_names_keep_off_words_and_lines_and_stay_in_their_room() -> None:
    canvas = Canvas(100.0, 100.0, "")
    room = Box(40.0, 40.0, 60.0, 60.0)
    canvas.line("FRAME", 50 + 40j, 50 + 60j)
    label = Labeller(canvas, room)
    for k in range(4):
        label.name(f"B{k}", 50 + 50j, 2.5, 1)
    boxes = [t.box for t in canvas.texts]
    assert len(boxes) == 4
    for one, two in itertools.combinations(boxes, 2):
        assert not one.grown(0.6).overlaps(two)
    assert all(box.grown(0.6).within(room) for box in boxes)
    assert not any(box.holds(50 + 1j * np.linspace(40, 60, 200)) for box in boxes)
    leads = [s.curve for s in canvas.strokes if s.layer == "DIMENSION"]
    far = [box for box in boxes if abs(nearest(box, 50 + 50j) - 50 - 50j) > 3.0 + 1]
    assert len(leads) >= len(far) > 0
    for line in leads:
        start, end = (complex(line.point(t)) for t in line.domain)
        assert start == 50 + 50j
        assert min(abs(nearest(box, 50 + 50j) - end) for box in boxes) < 1e-9
    # where there is no room at all nothing is written
    crowded = Canvas(100.0, 100.0, "")
    Labeller(crowded, Box(49.0, 49.0, 51.0, 51.0)).name("C", 50 + 50j, 2.5)
    assert crowded.texts == []


@pytest.mark.parametrize("left", [True, False])
def test_a_column_of_names_has_the_order_of_its_points(left: bool) -> None:
    canvas = Canvas(300.0, 300.0, "")
    label = Labeller(canvas, canvas.frame)
    label.column([], 50.0, 0.0, 100.0, left=left)
    assert canvas.texts == []
    names = [("up", 100 + 60j), ("low", 100 + 58j), ("far", 100 + 90j)]
    label.column(names, 50.0, 20.0, 100.0, left=left)
    size, step = 2.5, 1.7 * 2.5
    heights = dict(zip(("low", "up", "far"), (59 - step / 2, 59 + step / 2, 90.0), strict=True))
    assert [t.text for t in canvas.texts] == ["low", "up", "far"]
    for told, line in zip(canvas.texts, canvas.strokes, strict=True):
        y = heights[told.text]
        start = 50 - text_width(told.text, size) if left else 50.0
        assert told.runs[0].at == pytest.approx(complex(start, y - size / 2))
        ends = [complex(line.curve.point(t)) for t in line.curve.domain]
        assert ends == pytest.approx([dict(names)[told.text], complex(51.0 if left else 49.0, y)])
        assert line.layer == "DIMENSION"
    assert text_of("low", 0j, size).runs[0].height == size


@pytest.mark.parametrize(
    ("mass", "text"),
    [(0.5, "0.500"), (2.3, "2.30"), (12.0, "12.0"), (150.0, "150"), (1234.0, "1230"), (0.00012, "0.000120")],
)
def test_three_digits_of_a_mass_count_whatever_they_are(mass: float, text: str) -> None:
    """GOST 2.104 leaves the digits to the drawing: as many of each."""
    assert mass_text(mass) == text


@pytest.mark.parametrize(
    ("name", "caption"),
    [
        ("wheel", "Geneva wheel"),
        ("geneva_wheel", "Geneva wheel"),
        ("eel", "Geneva wheel eel"),
        ("geneva", "Geneva wheel geneva"),
        ("wheel_2", "Geneva wheel wheel_2"),
    ],
)
def test_a_caption_says_a_word_once(name: str, caption: str) -> None:
    keys = {"kind": "geneva_wheel", "number_of_slots": 6, "centre_distance": 60.0}
    parts, _ = make_parts(scene_from_dict({"parts": {name: keys}}, "t", "t"), "t")
    assert caption_name(parts[name]) == caption

"""What the STEP reader measures on curves and surfaces, against scipy's splines and sums over the surfaces."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np
import pytest

from exporters.formats.read_curves import Curves, Frames, Knots, Patches, lobatto, spans_of
from exporters.formats.read_solid import EXTRUSION, PLANE, ROUND, SPHERE, TORUS
from exporters.formats.read_surfaces import forms, poles_of

SHARES = np.array([0.0, 0.2, 0.5, 0.8, 1.0])
# a double and a triple knot within
KNOTS = (0.0, 0.0, 0.0, 0.0, 1.0, 2.5, 2.5, 4.0, 4.0, 4.0, 5.0, 5.0, 5.0, 5.0)
OTHERS = (-1.0, -1.0, -1.0, 0.5, 2.0, 2.0, 2.0)
EMPTY = np.zeros(0, np.int64)


def test_the_rule_of_gauss_and_lobatto_is_exact_up_to_degree_21() -> None:
    """Of every power of t over 0 .. 1, both ends among its nodes; the next power but one is beyond any such rule."""
    nodes, weights = lobatto()
    assert len(nodes) == len(weights)
    assert (nodes[0], nodes[-1]) == (0.0, 1.0)
    assert (np.diff(nodes) > 0).all()
    assert nodes + nodes[::-1] == pytest.approx(np.ones(len(nodes)), abs=0)
    for power in range(2 * len(nodes) - 2):
        assert weights @ nodes**power == pytest.approx(1 / (power + 1), rel=1e-14)
    # in the middle of the span, where a power of 22 is not lost in the ends: the missed one is of Legendre's kind
    even = 2 * nodes - 1
    power = 2 * len(nodes) - 2
    assert abs(weights @ even**power * (power + 1) - 1) > 1e-7


@pytest.mark.parametrize(("degree", "knots"), [(3, KNOTS), (2, OTHERS), (1, (0.0, 0.0, 0.5, 2.0, 2.0))])
def test_splines_are_those_of_scipy(degree: int, knots: tuple[float, ...]) -> None:
    """Points and derivatives by the share of every span, from its own side at a knot."""
    from scipy.interpolate import BSpline

    rng = np.random.default_rng(1)
    poles = rng.normal(size=(len(knots) - degree - 1, 3))
    own, breaks = Knots(degree, knots), np.unique(knots)
    assert len(own.spans) == len(breaks) - 1
    points, slopes = (m @ poles for m in own.matrices(SHARES))
    foreign = BSpline(np.array(knots), poles, degree)
    for number, (low, high) in enumerate(pairwise(breaks)):
        # what is smooth within a span goes on as it ends
        inner = np.clip(low + (high - low) * SHARES, low + 1e-9 * (high - low), high - 1e-9 * (high - low))
        rows = slice(number * len(SHARES), (number + 1) * len(SHARES))
        assert points[rows] == pytest.approx(foreign(inner), abs=1e-7)
        assert slopes[rows] == pytest.approx(foreign(inner, 1) * (high - low), abs=1e-6)
    values, steep, first = own.basis(SHARES)
    assert values.sum(axis=2) == pytest.approx(np.ones(values.shape[:2]), rel=1e-14)
    assert steep.sum(axis=2) == pytest.approx(np.zeros(values.shape[:2]), abs=1e-12)
    assert list(first) == [k - degree for k in range(len(knots) - 1) if knots[k] < knots[k + 1]]


def test_nets_are_products_of_splines() -> None:
    """Points and both derivatives of two surfaces, of all and of one alone."""
    rng = np.random.default_rng(2)
    along, across = Knots(3, KNOTS), Knots(2, OTHERS)
    poles = rng.normal(size=(2, len(KNOTS) - 4, len(OTHERS) - 3, 3))
    patches = Patches(np.array([7, 9]), poles, along, across)
    (u, du), (v, dv) = along.matrices(SHARES), across.matrices(SHARES[1:4])
    whole = patches.grid(SHARES, SHARES[1:4], slice(None))
    for made, one, two in zip(whole, (u, du, u), (v, v, dv), strict=True):
        exact = np.einsum("ik,nklc,jl->nijc", one, poles, two)
        assert made == pytest.approx(exact, abs=1e-12)
    alone = patches.grid(SHARES, SHARES[1:4], slice(1, 2))
    assert all(np.array_equal(a[0], b[1]) for a, b in zip(alone, whole, strict=True))


def rotation(seed: int) -> np.ndarray:
    """Right-handed axes in rows."""
    found, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return found * np.sign(np.linalg.det(found))


def test_lines_arcs_and_splines_are_cut_into_their_spans() -> None:
    """One of each kind, a spline run against its knots too; slopes by differences of the points."""
    from scipy.interpolate import BSpline

    axes, origin = rotation(3), np.array([4.0, -2.0, 7.0])
    frames = Frames(origin[None], axes[None])
    sweep, first, radius = -2.2, 0.7, 3.5
    poles = np.random.default_rng(4).normal(size=(2, 6, 3))
    knots = Knots(3, (0.0, 0.0, 0.0, 0.0, 1.0, 3.0, 4.0, 4.0, 4.0, 4.0))
    begin, end = np.array([[1.0, 2, 3]]), np.array([[4.0, 0, 5]])
    curves = Curves(
        np.array([3, 1, 4, 3]),
        (np.array([1]), begin, end),
        (np.array([2]), frames, np.array([radius]), np.array([first]), np.array([sweep])),
        [(knots, np.array([0, 3]), np.array([False, True]), poles)],
    )
    assert list(curves.starts) == [0, 3, 4, 8]
    # shares that lie alike from both ends
    points, slopes = curves.at(SHARES)
    assert points.shape == (11, 5, 3)
    assert points[3] == pytest.approx(begin + (end - begin) * SHARES[:, None])
    angles = first + sweep * (np.arange(4)[:, None] + SHARES) / 4
    flat = radius * np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=-1)
    assert points[4:8] == pytest.approx(origin + flat @ axes, abs=1e-12)
    foreign = [BSpline(np.array(knots.knots), p, 3) for p in poles]
    breaks = np.array([0.0, 1.0, 3.0, 4.0])
    for number in range(3):
        t = breaks[number] + np.diff(breaks)[number] * SHARES
        assert points[number] == pytest.approx(foreign[0](t), abs=1e-12)
        # run against, the last span comes first and each of them backwards
        assert points[10 - number] == pytest.approx(foreign[1](t)[::-1], abs=1e-12)
    more, less = (curves.at(np.array([0.5 - way, 0.5, 0.5 + way]))[0] for way in (1e-5, 1e-5))
    assert slopes[:, 2] == pytest.approx((more[:, 2] - less[:, 0]) / 2e-5, abs=1e-6)
    ends = curves.at(np.array([0.0, 1e-6, 1 - 1e-6, 1.0]))[0]
    assert slopes[:, 0] == pytest.approx((ends[:, 1] - ends[:, 0]) / 1e-6, abs=1e-4)
    assert slopes[:, -1] == pytest.approx((ends[:, 3] - ends[:, 2]) / 1e-6, abs=1e-4)


def test_spans_of_some_curves_go_the_way_they_are_run() -> None:
    nothing = (EMPTY, *np.zeros((2, 0, 3))), (EMPTY, Frames(*np.zeros((2, 0, 3))), *[EMPTY] * 3)
    curves = Curves(np.array([2, 1, 3]), *nothing, [])
    span, row = spans_of(curves, np.array([2, 0]))
    assert (list(span), list(row)) == ([3, 4, 5, 0, 1], [0, 0, 0, 1, 1])
    span, row = spans_of(curves, np.array([2, 0, 1]), np.array([False, True, False]))
    assert (list(span), list(row)) == ([5, 4, 3, 0, 1, 2], [0, 0, 0, 1, 1, 2])


def test_frames_tell_points_and_vectors_in_their_own_axes() -> None:
    axes, origins = np.stack([rotation(5), rotation(6)]), np.array([[1.0, 2, 3], [-4, 5, 6]])
    frames = Frames(origins, axes)
    points = np.random.default_rng(7).normal(size=(3, 4, 3))
    which = np.array([1, 0, 1])
    for row, frame in enumerate(which):
        for k in range(4):
            away = points[row, k] - origins[frame]
            assert frames.local(which, points)[row, k] == pytest.approx([away @ a for a in axes[frame]])
            assert frames.local(which, points, moved=False)[row, k] == pytest.approx(
                [points[row, k] @ a for a in axes[frame]]
            )
    assert frames.centres[1] == pytest.approx([origins[1] @ a for a in axes[1]])


Surface = Callable[[np.ndarray, np.ndarray], np.ndarray]


def of_revolution(size: Callable[[np.ndarray], np.ndarray], high: Callable[[np.ndarray], np.ndarray]) -> Surface:
    return lambda u, v: np.stack([size(v) * np.cos(u), size(v) * np.sin(u), high(v) + 0 * u], axis=-1)


# radius and slope, or second radius: the surface by u round the axis and v along it, and the reach of v
SURFACES: dict[str, tuple[int, tuple[float, float], Surface, tuple[float, float]]] = {
    "plane": (PLANE, (0.0, 0.0), lambda u, v: np.stack([v * np.cos(u), v * np.sin(u), 0 * u * v], axis=-1), (3.0, 1.0)),
    "cylinder": (ROUND, (5.0, 0.0), of_revolution(lambda v: 5 + 0 * v, lambda v: v), (-1.0, 2.5)),
    "cone": (ROUND, (5.0, 0.4), of_revolution(lambda v: 5 + 0.4 * v, lambda v: v), (-1.0, 2.5)),
    "flat cone": (ROUND, (5.0, 3.0), of_revolution(lambda v: 5 + 3 * v, lambda v: v), (-1.0, 2.5)),
    "sphere": (SPHERE, (4.0, 0.0), of_revolution(lambda v: 4 * np.cos(v), lambda v: 4 * np.sin(v)), (-0.4, 1.1)),
    "torus": (TORUS, (6.0, 2.0), of_revolution(lambda v: 6 + 2 * np.cos(v), lambda v: 2 * np.sin(v)), (1.9, 2.8)),
    "wide torus": (TORUS, (6.0, 2.0), of_revolution(lambda v: 6 + 2 * np.cos(v), lambda v: 2 * np.sin(v)), (-2.0, 3.2)),
}
CENTRE = np.array([1.5, -2.0, 3.0])
TURN = (0.3, 1.9)


def summed(surface: Surface, reach: tuple[float, float], centre: np.ndarray) -> tuple[float, float]:
    """Flux of X/3 and area of a patch between TURN and a reach of v, by sums over all of it, X_u x X_v its normal."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    (a, b), (c, d) = TURN, reach
    u, v = np.meshgrid((a + b) / 2 + (b - a) / 2 * nodes, (c + d) / 2 + (d - c) / 2 * nodes, indexing="ij")
    tiny = 1e-5
    along = (surface(u + tiny, v) - surface(u - tiny, v)) / (2 * tiny)
    across = (surface(u, v + tiny) - surface(u, v - tiny)) / (2 * tiny)
    normal = np.cross(along, across)
    share = weights[:, None] * weights * (b - a) * (d - c) / 4
    flux = ((surface(u, v) + centre) * normal).sum(axis=-1) / 3
    return float((share * flux).sum()), float((share * np.linalg.norm(normal, axis=-1)).sum())


def round_the_patch(surface: Surface, reach: tuple[float, float]) -> tuple[np.ndarray, np.ndarray]:
    """Nodes of the four bounds of a patch and their derivatives by the share, run with it on their left."""
    nodes, (a, b), (c, d) = lobatto()[0], TURN, reach
    ways = [((a, c), (b, c)), ((b, c), (b, d)), ((b, d), (a, d)), ((a, d), (a, c))]
    points, steps, tiny = [], [], 1e-6
    for (u, v), (p, q) in ways:

        def at(t: np.ndarray, u: float = u, v: float = v, p: float = p, q: float = q) -> np.ndarray:
            return surface(u + (p - u) * t, v + (q - v) * t)

        points.append(at(nodes))
        steps.append((at(nodes + tiny) - at(nodes - tiny)) / (2 * tiny))
    return np.stack(points), np.stack(steps)


@pytest.mark.parametrize("name", SURFACES)
def test_bounds_tell_flux_and_area_of_what_they_bound(name: str) -> None:
    """Stokes: 1-forms round the bounds of a patch, against sums over the patch."""
    kind, sizes, surface, reach = SURFACES[name]
    at, step = round_the_patch(surface, reach)
    rows = np.ones((4, 1))
    # round the tube from an angle near theirs, and from one of the face
    about = np.column_stack([[reach[0], reach[1], reach[1], reach[0]], 4 * [sum(reach) / 2]])
    made = forms(kind, at, step, rows * CENTRE, rows * sizes, about)
    flux, area = summed(surface, reach, CENTRE)
    told, size, twice = (float((form @ lobatto()[1]).sum()) for form in (made.flux, made.size, made.area))
    assert told == pytest.approx(flux, rel=1e-8)
    assert size == pytest.approx(abs(area), rel=1e-8)
    if kind != PLANE:
        # of (u, v): a rectangle, on a sphere by the sine of v
        wide = TURN[1] - TURN[0]
        high = math.sin(reach[1]) - math.sin(reach[0]) if kind == SPHERE else reach[1] - reach[0]
        assert twice == pytest.approx(wide * high, rel=1e-8)
        assert (made.turn @ lobatto()[1])[[0, 1, 2]] == pytest.approx([wide, 0, -wide], abs=1e-8)
    assert made.gap.max() < 1e-12


@pytest.mark.parametrize("off", [0.25, -0.125])
@pytest.mark.parametrize("name", SURFACES)
def test_the_gap_is_how_far_points_stand_off_their_surface(name: str, off: float) -> None:
    kind, sizes, surface, reach = SURFACES[name]
    u, v, tiny = np.linspace(*TURN, 7), np.linspace(*reach, 7), 1e-6
    normal = np.cross(surface(u + tiny, v) - surface(u, v), surface(u, v + tiny) - surface(u, v))
    at = surface(u, v) + off * normal / np.linalg.norm(normal, axis=1)[:, None]
    rows = np.ones((1, 1))
    made = forms(kind, at[None], 0 * at[None], rows * CENTRE, rows * sizes, np.full((1, 2), sum(reach) / 2))
    assert made.gap[0] == pytest.approx(np.full(7, abs(off)), abs=1e-5)


def test_an_extrusion_holds_what_its_curve_sweeps() -> None:
    """A bow swept along z from -1 to 2.5: a third of height times twice the sector between it and the axis."""

    def surface(u: np.ndarray, v: np.ndarray) -> np.ndarray:
        return np.stack([3 * np.cos(u) + 1, 2 * np.sin(u), v + 0 * u], axis=-1)

    reach = (-1.0, 2.5)
    at, step = round_the_patch(surface, reach)
    rows = np.ones((4, 1))
    made = forms(EXTRUSION, at, step, rows * CENTRE, np.zeros((4, 2)), np.zeros((4, 2)))
    flux, _ = summed(surface, reach, np.zeros(3))
    assert float((made.flux @ lobatto()[1]).sum()) == pytest.approx(flux, rel=1e-8)
    assert not made.gap.any()
    # twice the sector, by the shoelace formula over many chords
    u = np.linspace(*TURN, 20_001)
    x, y = 3 * np.cos(u) + 1, 2 * np.sin(u)
    assert float(made.turn[0] @ lobatto()[1]) == pytest.approx((x[:-1] * y[1:] - x[1:] * y[:-1]).sum(), rel=1e-8)


@pytest.mark.parametrize("sense", [1.0, -1.0])
@pytest.mark.parametrize(("pole", "level"), [(1, 0.5), (1, -0.9), (-1, 0.5), (-1, -0.9)])
def test_a_cap_of_a_ball_is_its_bound_and_its_pole(pole: int, level: float, sense: float) -> None:
    """Area 2 pi r h (Archimedes); flux of its normal along the axis: the circle of its bound."""
    radius, nodes = 4.0, lobatto()[0]
    ring, high = radius * math.cos(level), radius * math.sin(level)
    # six spans round, the cap on their left seen from where the face looks: outside, or inside
    angles = pole * sense * 2 * math.pi * (np.arange(6)[:, None] + nodes) / 6
    at = np.stack([ring * np.cos(angles), ring * np.sin(angles), 0 * angles + high], axis=-1)
    step = pole * sense * math.pi / 3 * np.stack([-at[..., 1], at[..., 0], 0 * angles], axis=-1)
    made = forms(SPHERE, at, step, np.tile(CENTRE, (6, 1)), np.tile([radius, 0.0], (6, 1)), np.zeros((6, 2)))
    flux, size, turns = (float((f @ lobatto()[1]).sum()) for f in (made.flux, made.size, made.turn))
    row = np.array([[radius, 0.0]]), CENTRE[[2]], np.array([turns]), np.array([False]), np.array([sense])
    more = poles_of(*row)
    area = 2 * math.pi * radius * (radius - pole * high)
    assert size + more[1][0] == pytest.approx(sense * area, rel=1e-12)
    whole = radius * area / 3 + pole * CENTRE[2] * math.pi * ring**2 / 3
    assert flux + more[0][0] == pytest.approx(sense * whole, rel=1e-12)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_whole_ball_and_a_belt_have_no_pole_to_add_but_all_of_it(sense: float) -> None:
    sizes, along = np.array([[3.0, 0.0], [3.0, 0.0]]), np.array([2.0, 2.0])
    flux, size = poles_of(sizes, along, np.zeros(2), np.array([True, False]), np.full(2, sense))
    assert flux == pytest.approx([sense * 4 / 3 * math.pi * 27, 0.0])
    assert size == pytest.approx([sense * 4 * math.pi * 9, 0.0])


@pytest.mark.parametrize(("begin", "way", "turns"), [(3.0, 0.7, 1), (-3.0, -0.7, -1), (0.5, 0.7, 0), (-2.9, 0.7, 0)])
def test_angles_round_a_tube_are_those_within_half_a_turn_of_what_is_near(begin: float, way: float, turns: int) -> None:
    """An edge whose middle lies more than half a turn from there is taken a turn nearer; they count from the base."""
    near, base, large, small, turn = 1.0, 0.4, 20.0, 5.0, 0.2
    tube, about = near + begin + way * SHARES, 0.3 + turn * SHARES
    spoke = np.stack([np.cos(about), np.sin(about), 0 * about], axis=-1)
    beside = np.stack([-np.sin(about), np.cos(about), 0 * about], axis=-1)
    up, size = np.array([0.0, 0.0, 1.0]), (large + small * np.cos(tube))[:, None]
    at = size * spoke + small * np.sin(tube)[:, None] * up
    step = size * turn * beside + small * way * (np.cos(tube)[:, None] * up - np.sin(tube)[:, None] * spoke)
    found = forms(TORUS, at[None], step[None], np.zeros((1, 3)), np.array([[large, small]]), np.array([[near, base]]))
    angle = tube - 2 * math.pi * turns - base
    assert found.turn[0] == pytest.approx(np.full(5, turn))
    assert found.area[0] == pytest.approx(-angle * turn)
    # the tube's own area from the base: s (R v + s sin v) between
    swept = small * (large * angle + small * (np.sin(angle + base) - math.sin(base)))
    assert found.size[0] == pytest.approx(-swept * turn)
    assert found.gap[0] == pytest.approx(np.zeros(5), abs=1e-13)

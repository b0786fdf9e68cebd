"""Spline surfaces, and what curves leave behind: against scipy's splines, closed forms and dense nets."""

from __future__ import annotations

import math
from itertools import product

import numpy as np
import pytest

from geometry.curves.curve import Real
from geometry.solids.area import surface_area
from geometry.solids.charts import Patch, span_shares, spline_rows
from geometry.solids.extent import extent
from geometry.solids.face_moments import face_moments
from geometry.solids.faces import (
    Extrusion,
    Faces,
    Frame,
    Plane,
    Solid,
    SolidBuilder,
    Spline,
    SplineSurface,
    Straight,
)  # fmt: skip
from geometry.solids.patch_distance import patch_distance
from geometry.solids.rings import AHEAD, UP

# of a cubic and of a quadratic, the second with a double knot; neither begins at 0 nor is one long
CUBIC = 3, np.array([2.0, 2, 2, 2, 3, 3.5, 5, 5, 5, 5])
QUADRATIC = 2, np.array([-1.0, -1, -1, 0, 0, 0.5, 2, 2, 2])
LINEAR = 1, np.array([0.0, 0, 4, 4])
Way = tuple[int, Real]


def count(way: Way) -> int:
    return len(way[1]) - way[0] - 1


def patch(u: Way, v: Way, poles: Real) -> Patch:
    """One surface, or several on one net: poles (n, u, v, 3) or (u, v, 3)."""
    poles = poles.reshape(-1, count(u), count(v), 3)
    index = np.arange(poles[..., 0].size).reshape(poles.shape[:3])
    return Patch(SplineSurface((u[0], v[0]), u[1], v[1], index), poles)


def bent(u: Way, v: Way, pull: float = 0.5, rows: int = 1) -> Patch:
    """A sheet of about 6 x 3 mm that is bent and pulled about by up to half a mm or less."""
    rng = np.random.default_rng(3)
    x, y = np.meshgrid(np.linspace(0, 6, count(u)), np.linspace(0, 3, count(v)), indexing="ij")
    sheet = np.stack([x, y, 0.1 * x * y], axis=-1)
    return patch(u, v, sheet + pull * rng.uniform(-1, 1, (rows, *sheet.shape)))


def scipy_point(made: Patch, row: int, shares: Real, orders: tuple[int, int] = (0, 0)) -> Real:
    """Places or derivatives by shares (k, 2), by scipy: first along u, then along v."""
    from scipy.interpolate import BSpline as Scipy

    s = made.surface
    (a, b), (c, d) = ((x[0], x[-1]) for x in (s.u_knots, s.v_knots))
    found = []
    for u, v in shares:
        line = Scipy(s.u_knots, made.poles[row], s.degrees[0])(a + (b - a) * u, orders[0]) * (b - a) ** orders[0]
        found.append(Scipy(s.v_knots, line, s.degrees[1])(c + (d - c) * v, orders[1]) * (d - c) ** orders[1])
    return np.array(found)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("u", "v"), [(CUBIC, QUADRATIC), (QUADRATIC, CUBIC), (LINEAR, CUBIC), (QUADRATIC, LINEAR)])
def test_points_and_derivatives_are_scipy_s(u: Way, v: Way) -> None:
    made, rng = bent(u, v, rows=2), np.random.default_rng(5)
    shares = rng.uniform(0, 1, (25, 2))
    # at ends and at a knot, where both sides of these surfaces agree in what is asked
    shares[:4] = [[0, 0], [0, 0.3], [1, 1], [0.6, 0]]
    point, du, dv = made.scattered(shares)
    for row in (0, 1):
        assert point[row] == pytest.approx(scipy_point(made, row, shares), abs=1e-12)
        assert du[row] == pytest.approx(scipy_point(made, row, shares, (1, 0)), abs=1e-11)
        assert dv[row] == pytest.approx(scipy_point(made, row, shares, (0, 1)), abs=1e-11)
        for orders in ((0, 0), (1, 0), (0, 1), (1, 1), (2, 1), (1, 2)):
            if orders[0] > u[0] or orders[1] > v[0]:
                continue
            net = made.at(shares[4:9, 0], shares[4:9, 1], orders)[row]
            wanted = [scipy_point(made, row, np.array([[x, y]]), orders)[0] for x, y in product(*shares[4:9].T)]
            assert net.reshape(-1, 3) == pytest.approx(np.array(wanted), abs=1e-9)
    # beyond its ends a surface is as at them
    assert made.scattered(np.array([[-0.1, 1.2]]))[0] == pytest.approx(made.scattered(np.array([[0.0, 1.0]]))[0])
    assert made.rows(slice(1, 2)).at(shares[:2, 0], shares[:2, 1])[0] == pytest.approx(
        made.at(shares[:2, 0], shares[:2, 1])[1])  # fmt: skip


def test_derivatives_beyond_the_degree_are_none() -> None:
    rows = spline_rows(1, LINEAR[1], np.array([0.2, 0.7]), 3)
    # of (0, 8) over four: 8 by the share
    assert [float(r[0] @ [0.0, 8.0]) for r in rows] == pytest.approx([1.6, 8.0, 0.0, 0.0])


def test_spans_as_shares_of_the_domain() -> None:
    assert span_shares(CUBIC[1]) == pytest.approx([0, 1 / 3, 1 / 2, 1])
    assert span_shares(QUADRATIC[1]) == pytest.approx([0, 1 / 3, 1 / 2, 1])


def linear_precision(way: Way) -> Real:
    """Places of poles for which a spline goes evenly: means of the knots beside each, as shares."""
    p, knots = way
    greville = np.array([knots[k + 1 : k + p + 1].mean() for k in range(count(way))])
    return (greville - knots[0]) / (knots[-1] - knots[0])


@pytest.mark.parametrize(("u", "v"), [(CUBIC, QUADRATIC), (LINEAR, CUBIC), (QUADRATIC, LINEAR)])
def test_distances_from_a_rectangle_are_those_of_pythagoras(u: Way, v: Way) -> None:
    """4 x 2 mm: exact near it, farther off too large, by less than half."""
    x, y = np.meshgrid(4 * linear_precision(u), 2 * linear_precision(v), indexing="ij")
    distance = patch_distance(patch(u, v, np.stack([x, y, np.zeros_like(x)], axis=-1)))
    rng = np.random.default_rng(1)
    points = np.concatenate([rng.uniform([-0.6, -0.6, -0.5], [4.6, 2.6, 0.5], (150, 3)),
                             rng.uniform(-25, 25, (150, 3))])  # fmt: skip
    beyond = np.maximum(np.maximum(-points, points - [4, 2, 0]), 0)
    exact = np.linalg.norm(beyond, axis=1)
    found = distance(points)
    assert found[:150] == pytest.approx(exact[:150], abs=1e-9)
    assert np.all(found >= exact - 1e-9)
    assert np.all(found <= 1.5 * exact + 1e-9)
    # many at a time are as one by one
    many = np.tile(points[:150], (15, 1))
    assert distance(many) == pytest.approx(np.tile(found[:150], 15))


@pytest.mark.parametrize(("u", "v"), [(CUBIC, QUADRATIC), (QUADRATIC, CUBIC)])
def test_distances_from_a_bent_sheet_are_the_least_that_are_found(u: Way, v: Way) -> None:
    """Over its middle, its edges and corners: by the best of a net, brought on within the sheet by scipy."""
    from scipy.optimize import minimize

    made, rng = bent(u, v, 0.1), np.random.default_rng(2)
    shares = np.linspace(0, 1, 41)
    net = made.at(shares, shares)[0]
    points = net[rng.integers(0, 41, 16), rng.integers(0, 41, 16)] + rng.uniform(-0.2, 0.2, (16, 3))
    points[:4] = [net[0, 0] + [-0.4, -0.3, 0.1], net[-1, 0] + [0.4, -0.2, 0], net[0, -1] + [-0.3, 0.3, 0],
                  net[-1, -1] + [0.2, 0.3, -0.3]]  # fmt: skip
    points[4:8] = [net[20, 0] + [0, -0.4, 0.1], net[20, -1] + [0, 0.4, 0], net[0, 20] + [-0.4, 0, 0],
                   net[-1, 20] + [0.4, 0, 0.2]]  # fmt: skip
    found = patch_distance(made)(points)
    for point, got in zip(points, found.tolist(), strict=True):
        away = np.linalg.norm(net - point, axis=2)
        row, column = np.unravel_index(int(np.argmin(away)), away.shape)

        def square(x: Real, point: Real = point) -> float:
            return float(np.sum((made.at(x[:1], x[1:])[0, 0, 0] - point) ** 2))

        least = minimize(square, [shares[row], shares[column]], bounds=[(0, 1), (0, 1)], tol=1e-14)
        assert got == pytest.approx(math.sqrt(least.fun), abs=1e-7)


# --- a prism over what lies between a parabola and its chord: y = x (2 - x) on (0, 2)


def prism(low: float, high: float, *, net: bool = False, inwards: bool = False) -> Solid:
    """Its bent wall an extrusion, or a spline surface; whose normals look inwards or outwards."""
    made = SolidBuilder()
    knots = np.array([0.0, 0, 0, 1, 1, 1])
    poles = [made.add_points(np.array([2 + 0j, 1 + 2j, 0j]), z) for z in (low, high)]
    vertices = [made.add_vertices(p[[0, 2]]) for p in poles]
    bows = [made.add_edges(v[:1], v[1:], Spline(2, knots, p[None])) for v, p in zip(vertices, poles, strict=True)]
    chords = [made.add_edges(v[1:], v[:1], Straight(AHEAD)) for v in vertices]
    ups = [made.add_edges(vertices[0][k : k + 1], vertices[1][k : k + 1], Straight(UP)) for k in (0, 1)]
    around = [bows[0], ups[1], bows[1], ups[0]], np.array([True, True, False, False])
    loop = np.stack(around[0], axis=1), around[1]
    if net:
        line = np.array([0.0, 0, 1, 1])
        columns = np.stack(poles, axis=1)
        surface = SplineSurface((2, 1), knots, line, columns[None])
        if inwards:
            surface = SplineSurface((1, 2), line, knots, columns.T[None])
        made.faces.append(Faces(surface, (loop,), along=not inwards))
    else:
        made.faces.append(Faces(Extrusion(bows[0], UP), (loop,)))
    flat = [chords[0], ups[0], chords[1], ups[1]], np.array([True, True, False, False])
    origin = made.on_axis(low)
    made.faces.append(Faces(Plane(Frame(origin, np.array([[0.0, -1, 0]]), AHEAD)), ((np.stack(flat[0], 1), flat[1]),)))
    for k, z in enumerate((low, high)):
        edges = np.stack([bows[k], chords[k]], axis=1)
        if k == 0:
            edges = edges[:, ::-1]
        frame = Frame(made.on_axis(z), UP, AHEAD)
        made.faces.append(Faces(Plane(frame), ((edges, np.full(2, k == 1)),), along=k == 1))
    return made.solid()


PRISMS = {"extrusion": (False, False), "net": (True, False), "net inwards": (True, True)}


@pytest.mark.parametrize("name", PRISMS)
def test_a_prism_under_a_parabola(name: str) -> None:
    """Integrals of x^a y^b over it are those of x^a (x (2 - x))^(b + 1) / (b + 1)."""
    solid = prism(1.0, 4.0, net=PRISMS[name][0], inwards=PRISMS[name][1])
    a, x, y, xx, yy, xy = 4 / 3, 4 / 3, 8 / 15, 8 / 5, 32 / 105, 8 / 15
    height, first, second = 3.0, 7.5, 21.0
    found = face_moments(solid)
    assert found.volume == pytest.approx(a * height, rel=1e-12)
    assert found.centre == pytest.approx([1.0, 0.4, 2.5], abs=1e-12)
    wanted = np.array([[yy * height + a * second, -xy * height, -x * first],
                       [-xy * height, xx * height + a * second, -y * first],
                       [-x * first, -y * first, (xx + yy) * height]])  # fmt: skip
    assert found.inertia == pytest.approx(wanted, rel=1e-12)
    # of y = x (2 - x) the arc is (2 sqrt 5 + asinh 2) / 2
    arc = math.sqrt(5) + math.asinh(2) / 2
    assert surface_area(solid) == pytest.approx(2 * a + height * (arc + 2), rel=1e-7)
    box = extent(solid)
    assert [*box.low, *box.high] == pytest.approx([0, 0, 1, 2, 1, 4], abs=1e-9)
    # the farthest of x^2 + x^2 (2 - x)^2 is the corner, 2
    assert box.radius == pytest.approx(2.0, abs=1e-9)

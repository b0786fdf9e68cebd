"""B-splines of exact curves: the stated error is never below the measured deviation and at most twice it."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import ezdxf.math
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import ArrayLike

from geometry.approximation.splines import SplineFit, fit_spline, spline_of_spans
from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import Record
from geometry.base.series import Series
from geometry.curves.bspline import BSpline, basis, distance_bound, feet
from geometry.curves.curve import Curve, Reversed, SeriesSpan, end_point, start_point
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.curves.trochoid import TrochoidFillet
from geometry.gears.teeth.basic_rack import TipRelief, iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from tests import brute, laws
from tests.oracles.trochoid import Trochoid
from tests.sampling import examples
from tests.strategies import numbers, placements

CUBIC, QUINTIC, SEPTIC = (3, 2), (5, 4), (7, 6)
KINDS = pytest.mark.parametrize("kind", [CUBIC, QUINTIC, SEPTIC, (7, 2)], ids=lambda k: f"degree {k[0]} C{k[1]}")
LADDER = [1e-2, 1e-4, 1e-6, 1e-8, 1e-9]
# two floors of 4e-15 of the distance from the origin: one in the bound, one in the search for its greatest place
ROUNDING = 8e-15


def sides(gear: SpurGear) -> dict[str, Curve]:
    """The curved segments of a tooth side by their label."""
    return {s.label.value: s.curve for s in tooth_side(gear).segments if not isinstance(s.curve, Line | Arc)}


GEARS = {
    "z 23": SpurGear(2.0, 23, iso_53()),
    "z 8, undercut": SpurGear(2.0, 8, iso_53()),
    "z 17": SpurGear(2.0, 17, iso_53()),
    "x = h_f - rho": SpurGear(2.0, 23, iso_53(), 0.87),
    "x 1": SpurGear(2.0, 23, iso_53(), 1.0),
    "z 1000": SpurGear(2.0, 1000, iso_53()),
    "relief": SpurGear(2.0, 23, iso_53(relief=TipRelief(0.02))),
    "m 0.1": SpurGear(0.1, 12, iso_53()),
    "m 50": SpurGear(50.0, 23, iso_53()),
    "m 50, z 1000": SpurGear(50.0, 1000, iso_53("D")),
}
CURVES = {f"{name}, {label}": curve for name, gear in GEARS.items() for label, curve in sides(gear).items()}
FLANK, FILLET = CURVES["z 23, flank"], CURVES["z 23, root_fillet"]
CURVES |= {
    "flank from its base circle": Involute(21.6, -0.083, 0.0, 0.58, 1j),
    "flank to its base circle": Involute(21.6, -0.083, -0.58, 0.0),
    "long involute": Involute(100.0, 0.0, 0.1, 6.0),
    "upper fillet": FILLET.mirrored(),
    "whole root": TrochoidFillet(23.0, 1.74, 0.76, -0.131, -1.2, 1.2217),
    "fillet of a small gear": TrochoidFillet(3.0, 1.4, 0.76, 0.1, 0.0, 1.2217),
    "arc": Arc(2 - 1j, 3.0, 0.4, -1.9),
    "trochoid": Trochoid(23.0, -1.74, 0.5, -3.0, 4.8, 2 + 1j),
    "backwards": Reversed(FILLET),
}
EVERY = pytest.mark.parametrize("name", CURVES)


def graded(low: float, high: float, count: int) -> np.ndarray:
    """Parameters that are dense throughout and crowd at both ends, where a cusp would hide."""
    crowd = np.geomspace(1e-12, 0.1, 90)
    return low + (high - low) * np.unique(np.concatenate([np.linspace(0, 1, count), crowd, 1 - crowd]))


def deviation(spline: BSpline, curve: Curve, count: int = 601) -> float:
    """Greatest distance both ways, by dense points, nearest samples and ternary search."""
    there = brute.distance_to_curve(spline.point(graded(*spline.domain, count)), curve, 500)
    back = brute.distance_to_curve(curve.point(graded(*curve.domain, 151)), spline, 500)
    return float(max(there.max(), back.max()))


def size(curve: Curve) -> float:
    """Greatest distance of the curve from the origin, mm."""
    return float(np.abs(brute.dense(curve, 33)).max())


@cache
def fitted(name: str, tolerance: float, kind: tuple[int, int]) -> SplineFit:
    """A fit, made once for all tests."""
    return fit_spline(CURVES[name], tolerance, degree=kind[0], continuity=kind[1])


def naive_basis(i: int, degree: int, knots: np.ndarray, t: float) -> float:
    """The definition of de Boor, on the closed last span."""
    if degree == 0:
        return float(knots[i] <= t < knots[i + 1] or (t == knots[-1] and knots[i] < knots[i + 1] == t))
    left, right = knots[i + degree] - knots[i], knots[i + degree + 1] - knots[i + 1]
    value = 0.0
    if left > 0:
        value += (t - knots[i]) / left * naive_basis(i, degree - 1, knots, t)
    if right > 0:
        value += (knots[i + degree + 1] - t) / right * naive_basis(i + 1, degree - 1, knots, t)
    return value


@st.composite
def splines(draw: Any) -> BSpline:
    """Splines of any degree with knots of any allowed multiplicity, at least one span."""
    degree = draw(st.integers(1, 7))
    steps = draw(st.lists(numbers(0.05, 2), min_size=1, max_size=5))
    breaks = draw(numbers(-3, 3)) + np.concatenate([[0.0], np.cumsum(steps)])
    inner = [np.full(draw(st.integers(1, degree)), b) for b in breaks[1:-1]]
    ends = np.full(degree + 1, breaks[0]), np.full(degree + 1, breaks[-1])
    knots = np.concatenate([ends[0], *inner, ends[1]])
    rng = np.random.default_rng(draw(st.integers(0, 1000)))
    count = len(knots) - degree - 1
    return BSpline(degree, knots, rng.normal(size=count) + 1j * rng.normal(size=count))


@examples(40)
@given(splines())
def test_basis_is_a_partition_of_unity_and_de_boors(spline: BSpline) -> None:
    t = np.unique(np.concatenate([np.linspace(*spline.domain, 17), spline.breaks]))
    first, values = basis(spline.degree, spline.knots, t)
    assert np.max(np.abs(values.sum(axis=-1) - 1)) <= 1e-14
    assert values.min() >= 0
    n = len(spline.poles)
    table = np.zeros((len(t), n))
    table[np.arange(len(t))[:, None], first[:, None] + np.arange(spline.degree + 1)] = values
    slow = np.array([[naive_basis(i, spline.degree, spline.knots, x) for i in range(n)] for x in t])
    assert np.max(np.abs(table - slow)) <= 1e-13
    assert np.max(np.abs(spline.point(t) - slow @ spline.poles)) <= 1e-12
    assert spline.point(spline.domain[0]) == spline.poles[0]
    assert spline.point(spline.domain[1]) == spline.poles[-1]


@examples(40)
@given(splines())
def test_derivatives_are_those_of_each_spans_polynomial(spline: BSpline) -> None:
    """Each span is a polynomial through degree + 1 of its points; its derivatives and their proven bounds."""
    p = spline.degree
    for low, high in zip(spline.breaks[:-1], spline.breaks[1:], strict=True):
        nodes = low + (high - low) * (1 - np.cos(np.pi * (np.arange(p + 1) + 0.5) / (p + 1))) / 2
        local = np.polynomial.Polynomial.fit(nodes, spline.point(nodes), p, domain=[low, high])
        inside = np.linspace(low, high, 9)[1:-1]
        span = np.searchsorted(spline.knots, inside[:1], side="right") - 1
        for order in range(1, p + 2):
            found = spline.derivative(inside, order)
            expected = local.deriv(order)(inside)
            scale = 4.0**order * math.factorial(p) / (high - low) ** order
            assert np.max(np.abs(found - expected)) <= 1e-11 * scale
            assert np.max(np.abs(found)) <= spline.derivative_bound(order, span)[0] * (1 + 1e-12)


@examples(40)
@given(splines(), placements)
def test_reversed_mirrored_and_placed(spline: BSpline, placement: Placement2) -> None:
    low, high = spline.domain
    t = np.linspace(low, high, 23)
    back, mirror = spline.reversed(), spline.mirrored()
    assert back.domain == mirror.domain == (low, high)
    assert np.max(np.abs(back.point(low + high - t) - spline.point(t))) <= 1e-10
    assert np.max(np.abs(mirror.point(low + high - t) - np.conj(spline.point(t)))) <= 1e-10
    assert mirror.poles[0] == spline.poles[-1].conjugate()
    assert np.array_equal(back.reversed().poles, spline.poles)
    assert np.array_equal(mirror.mirrored().poles, spline.poles)
    assert np.max(np.abs(mirror.mirrored().knots - spline.knots)) <= 1e-14
    placed = spline.placed(placement)
    moved = placement.apply(spline.point(t))
    assert np.max(np.abs(placed.point(t) - moved)) <= 1e-13 * (10 + abs(placement.translation))
    assert placed.knots is spline.knots


def test_methods_keep_the_shape_of_the_parameter() -> None:
    spline = fitted("z 23, root_fillet", 1e-6, CUBIC).spline
    t = np.linspace(0, 1, 6).reshape(2, 3)
    assert spline.point(t).shape == spline.derivative(t, 2).shape == spline.derivative(t, 9).shape == (2, 3)
    assert spline.point(0.3).shape == spline.derivative(0.3).shape == ()


@pytest.mark.parametrize(
    ("degree", "knots", "poles"),
    [
        (0, [0, 1], [0]),
        (2, [0, 0, 0, 1, 1, 1], [0, 1]),
        (2, [0, 0, 0.1, 1, 1, 1], [0, 1, 2]),
        (1, [0, 0, 0.7, 0.4, 1, 1], [0, 1, 2, 3]),
        (1, [0, 0, 0.5, 0.5, 0.5, 1, 1], [0, 1, 2, 3, 4]),
        (1, [1, 1, 1, 1], [0, 1]),
        (1, [0, 0, math.nan, 1, 1], [0, 1, 2]),
    ],
)
def test_knots_that_make_no_spline_are_refused(degree: int, knots: list[float], poles: list[complex]) -> None:
    with pytest.raises(ParameterError, match="knots"):
        BSpline(degree, np.array(knots, dtype=float), np.array(poles, dtype=complex))


@pytest.mark.sampled(3)
@EVERY
@KINDS
@pytest.mark.parametrize("tolerance", [1e-2, 1e-4, 1e-6])
def test_the_bound_holds_and_is_at_most_twice_the_deviation(name: str, kind: tuple[int, int], tolerance: float) -> None:
    curve, fit = CURVES[name], fitted(name, tolerance, kind)
    found, rounding = deviation(fit.spline, curve), ROUNDING * size(curve)
    assert fit.bound == "certified"
    assert found <= fit.max_error <= tolerance
    assert fit.max_error <= 2 * found + rounding
    assert fit.pieces == len(fit.spline.breaks) - 1


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["z 23, flank", "z 23, root_fillet", "z 8, undercut, root_fillet", "m 50, flank"])
@KINDS
@pytest.mark.parametrize("tolerance", LADDER)
def test_the_ladder_of_tolerances(name: str, kind: tuple[int, int], tolerance: float) -> None:
    curve, fit = CURVES[name], fitted(name, tolerance, kind)
    found = deviation(fit.spline, curve)
    assert found <= fit.max_error <= min(tolerance, 2 * found + ROUNDING * size(curve))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["z 23, flank", "z 23, root_fillet", "z 8, undercut, root_fillet", "trochoid"])
@pytest.mark.parametrize("kind", [CUBIC, SEPTIC])
def test_the_worst_place_against_fifty_digits(name: str, kind: tuple[int, int]) -> None:
    """Distance of the farthest spline point from the curve rebuilt from its definition in mpmath."""
    curve, fit = CURVES[name], fitted(name, 1e-6, kind)
    x = np.linspace(*fit.spline.domain, 4001)
    points = fit.spline.point(x)
    near = feet(curve, points, np.interp(x, fit.spline.domain, curve.domain), steps=20)
    worst = int(np.argmax(np.abs(points - curve.point(near))))
    exact, point, mp = laws.exact_point(curve), laws.MP.mpc(complex(points[worst])), laws.MP

    def slope(t: Any) -> Any:
        return (mp.conj(mp.diff(exact, t)) * (exact(t) - point)).real

    t = mp.findroot(slope, mp.mpf(float(near[worst])))
    distance = float(abs(exact(t) - point))
    assert fit.max_error / 1.1 <= distance <= fit.max_error


@pytest.mark.sampled(2)
@EVERY
@KINDS
def test_ends_are_the_curves(name: str, kind: tuple[int, int]) -> None:
    """End points to the bit, end tangents within 1e-9 rad, at any tolerance."""
    curve = CURVES[name]
    for tolerance in (1e-2, 1e-6):
        spline = fitted(name, tolerance, kind).spline
        assert spline.point(spline.domain[0]) == spline.poles[0] == start_point(curve)
        assert spline.point(spline.domain[1]) == spline.poles[-1] == end_point(curve)
        for x, t in zip(spline.domain, curve.domain, strict=True):
            turn = np.angle(complex(spline.derivative(x)) / complex(curve.tangent(t)))
            assert abs(turn) <= 1e-9


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["z 23, root_fillet", "z 8, undercut, flank", "m 50, z 1000, root_fillet"])
@pytest.mark.parametrize("kind", [(3, 1), CUBIC, (5, 2), QUINTIC, (7, 2), SEPTIC])
def test_continuity_at_every_interior_knot(name: str, kind: tuple[int, int]) -> None:
    """Both sides' polynomials agree up to the order that was asked for, and no further."""
    degree, continuity = kind
    fit = spline_of_spans(CURVES[name], 6, degree=degree, continuity=continuity)
    spline, jumps = fit.spline, []
    assert len(spline.breaks) == 7
    assert len(spline.poles) == degree + 1 + 5 * (degree - continuity)
    # the span before a knot ends there when it is run from the other side
    back = spline.reversed()
    whole = sum(spline.domain)
    for order in range(continuity + 2):
        right = spline.derivative(spline.breaks[1:-1], order) if order else spline.point(spline.breaks[1:-1])
        mirrored = np.array(
            [np.max(back.breaks[np.abs(back.breaks - (whole - b)) < 1e-9]) for b in spline.breaks[1:-1]]
        )
        left = (-1) ** order * back.derivative(mirrored, order) if order else back.point(mirrored)
        scale = np.abs(spline.poles).max() if order == 0 else np.abs(spline.derivative_poles(order)).max()
        rounding = 1e-13 * np.abs(spline.poles).max() * (2.0 * degree * 6) ** order
        jumps.append(np.abs(left - right).max() / (scale + rounding))
        if order <= continuity:
            assert np.abs(left - right).max() <= 1e-12 * scale + rounding
    assert jumps[-1] > 1e-9


@pytest.mark.parametrize("kind", [CUBIC, QUINTIC, SEPTIC])
def test_a_smooth_joint_stays_smooth(kind: tuple[int, int]) -> None:
    """Fillet and flank touch: so do their splines, within 1e-9 rad, whatever the tolerance."""
    for tolerance in (1e-2, 1e-6):
        before, after = (fitted(f"z 23, {label}", tolerance, kind).spline for label in ("root_fillet", "flank"))
        assert abs(before.poles[-1] - after.poles[0]) <= 1e-13 * abs(after.poles[0])
        turn = np.angle(complex(after.derivative(after.domain[0])) / complex(before.derivative(before.domain[1])))
        assert abs(turn) <= 2e-9


@pytest.mark.parametrize(
    ("kind", "flank", "fillet"), [(CUBIC, 9, 16), (QUINTIC, 6, 9), (SEPTIC, 8, 11)], ids=["cubic", "quintic", "septic"]
)
def test_poles_at_one_nanometre(kind: tuple[int, int], flank: int, fillet: int) -> None:
    """What the STEP file's size allows (B2 of the theory notes, table of the engineering notes), 10 kB a pole."""
    assert len(fitted("z 23, flank", 1e-6, kind).spline.poles) <= flank
    assert len(fitted("z 23, root_fillet", 1e-6, kind).spline.poles) <= fillet


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", ["z 23, flank", "z 23, root_fillet", "z 8, undercut, root_fillet", "z 17, flank"])
@pytest.mark.parametrize("kind", [CUBIC, QUINTIC, SEPTIC])
def test_near_the_least_number_of_poles(name: str, kind: tuple[int, int]) -> None:
    """At most a quarter more than the fewest that any smaller number of pieces gives."""
    degree, continuity = kind
    fit = fitted(name, 1e-6, kind)
    errors = [
        spline_of_spans(CURVES[name], spans, degree=degree, continuity=continuity).max_error
        for spans in range(1, fit.pieces)
    ]
    least = next((spans for spans, error in enumerate(errors, 1) if error <= 1e-6), fit.pieces)
    assert degree + fit.pieces == len(fit.spline.poles) <= 1.25 * (degree + least)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("z 23, flank", CUBIC),
        ("z 23, root_fillet", CUBIC),
        ("z 8, undercut, root_fillet", CUBIC),
        ("x = h_f - rho, root_fillet", CUBIC),
        ("m 50, flank", CUBIC),
        ("z 23, root_fillet", QUINTIC),
        ("m 50, root_fillet", QUINTIC),
        ("long involute", SEPTIC),
    ],
)
def test_order_of_convergence(name: str, kind: tuple[int, int]) -> None:
    """degree + 1 within 5 %, over pieces doubled from 16 down to 100 roundings (theory note B4).

    Below 16 pieces the sliding parameter gains up to a hundredfold: there the errors lie below the line.
    """
    curve, (degree, continuity) = CURVES[name], kind
    floor = 100 * 4e-15 * size(curve)
    counts, errors = [], []
    for spans in (16, 32, 64, 128):
        error = spline_of_spans(curve, spans, degree=degree, continuity=continuity).max_error
        if error < floor:
            break
        counts.append(spans)
        errors.append(error)
    assert len(counts) >= 2
    order = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert order == pytest.approx(degree + 1, rel=0.05)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["z 23, flank", "z 23, root_fillet", "z 8, undercut, root_fillet"])
@pytest.mark.parametrize("kind", [CUBIC, QUINTIC, SEPTIC])
def test_a_moved_pole_is_seen(name: str, kind: tuple[int, int]) -> None:
    """Negative control at the start, the middle and the end: by the tests' measuring and by the product's bound."""
    curve, tolerance = CURVES[name], 1e-6
    spline = fitted(name, tolerance, kind).spline
    n = len(spline.poles)
    for index in (1, n // 2, n - 2):
        # the basis function of the moved pole at its greatest, and the curve's normal there
        x = np.linspace(*spline.domain, 2001)
        unit = BSpline(spline.degree, spline.knots, np.eye(n)[index].astype(complex))
        top = x[np.argmax(unit.point(x).real)]
        share = unit.point(top).real
        shift = 3 * tolerance * 1j * spline.derivative(top) / abs(spline.derivative(top))
        poles = spline.poles.copy()
        poles[index] += shift
        spoilt = BSpline(spline.degree, spline.knots, poles)
        found = deviation(spoilt, curve)
        assert found >= 0.8 * (3 * share - 1) * tolerance
        assert found > tolerance if share > 2 / 3 else found > fitted(name, tolerance, kind).max_error / 3
        bound, kind_of_bound = bound_of(curve, spoilt)
        assert kind_of_bound == "certified"
        assert found <= bound <= 2 * found


def bound_of(curve: Curve, spline: BSpline) -> tuple[float, str]:
    """The product's bound for any spline, from feet that are searched from scratch."""
    x = np.linspace(*spline.domain, 101)
    t = np.linspace(*curve.domain, 2001)
    near = t[np.argmin(np.abs(spline.point(x)[:, None] - curve.point(t)), axis=1)]
    near[0], near[-1] = curve.domain
    return distance_bound(curve, spline, x, near)


def test_a_part_of_a_spline_is_the_spline() -> None:
    """Against ezdxf's own evaluation, with knots of all multiplicities and ends on and beside knots."""
    knots = np.array([0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 5, 5, 5, 5.0])
    poles = np.array([complex(k, (7 * k) % 5 - 0.3 * k) for k in range(10)])
    whole = ezdxf.math.BSpline([(p.real, p.imag) for p in poles], 4, knots)
    for low, high in ((0.0, 5.0), (0.3, 0.7), (0.3, 2.0), (2.0, 3.0), (1.9, 4.99), (3.0, 5.0)):
        part = BSpline(3, knots, poles).trimmed(low, high)
        t = np.linspace(low, high, 41)
        assert part.domain == (low, high)
        assert np.abs(part.point(t) - [complex(p.x, p.y) for p in whole.points(t)]).max() < 1e-13


def test_rounding_chooses_nothing() -> None:
    """A short fillet, which every parameter fits to rounding, has the same poles wherever it is turned to."""
    fillet, poles = TrochoidFillet(40.0, 2.0, 1.0, 0.0, 0.3, 0.4), []
    for turn in np.arange(12) * 1e-3:
        made = fit_spline(fillet.placed(Placement2(turn, 0j)), 1e-6, degree=7, continuity=6)
        poles.append(made.spline.poles * np.exp(-1j * turn))
    assert np.ptp(np.array(poles).real, axis=0).max() < 1e-7
    assert np.ptp(np.array(poles).imag, axis=0).max() < 1e-7


class _Swan(SeriesSpan, Record):
    """A curve that leaves nearly a cusp and has an inflection: 7 t - 7/3 sin 3t + 30 i cos t."""

    start: float = 0.01
    end: float = 1.578

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients at ``t``."""
        at = np.asarray(t, dtype=float)
        found = [7 * at, 7 + 0 * at, *(0 * at for _ in range(order))]
        return [
            (x - 7 / 3 * 3.0**k * np.sin(3 * at + k * math.pi / 2) / math.factorial(k))
            + 30j * np.cos(at + k * math.pi / 2) / math.factorial(k)
            for k, x in enumerate(found[: order + 1])
        ]


def test_a_curve_with_an_inflection_needs_few_spans() -> None:
    """The root of its curvature is no parameter: not smooth there, 512 spans were not enough."""
    made, curve = fit_spline(_Swan(), 1e-6, degree=3, continuity=2), _Swan()
    assert made.pieces < 50
    x, t = made.spline.point(np.linspace(*made.spline.domain, 401)), np.linspace(*curve.domain, 4001)
    near = feet(curve, x, t[np.argmin(np.abs(x[:, None] - curve.point(t)), axis=1)])
    assert np.abs(curve.point(near) - x).max() <= made.max_error <= 1e-6

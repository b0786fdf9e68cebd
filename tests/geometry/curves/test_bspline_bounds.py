"""B-splines of exact curves: bounds of any spline, special curves, refusals, hypothesis over gears."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.approximation.splines import fit_spline, spline_of_spans
from geometry.base.errors import ConvergenceError, CuspError, ParameterError
from geometry.base.placement import Placement2
from geometry.curves.bspline import BSpline, feet
from geometry.curves.curve import OffsetCurve, start_point
from geometry.curves.line_arc import Line
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.spur import SpurGear
from tests import brute
from tests.geometry.curves.test_bspline import (
    CUBIC,
    CURVES,
    EVERY,
    FILLET,
    FLANK,
    KINDS,
    QUINTIC,
    ROUNDING,
    SEPTIC,
    bound_of,
    deviation,
    fitted,
    sides,
    size,
)
from tests.oracles.trochoid import Trochoid
from tests.sampling import examples
from tests.strategies import numbers


@examples(40)
@given(
    st.sampled_from(
        ["z 23, flank", "z 23, root_fillet", "z 8, undercut, root_fillet", "arc", "trochoid", "z 17, flank"]
    ),
    st.sampled_from([CUBIC, QUINTIC, SEPTIC]),
    numbers(-9, -3),
    st.integers(0, 10_000),
)
def test_the_bound_of_any_spline_near_the_curve(name: str, kind: tuple[int, int], exponent: float, seed: int) -> None:
    """Random splines with the curve's ends: the bound is proven for each of them, not only for fits."""
    curve, spline = CURVES[name], fitted(name, 1e-4, kind).spline
    rng = np.random.default_rng(seed)
    poles = spline.poles + 10**exponent * (rng.normal(size=len(spline.poles)) + 1j * rng.normal(size=len(spline.poles)))
    poles[0], poles[-1] = spline.poles[0], spline.poles[-1]
    spoilt = BSpline(spline.degree, spline.knots, poles)
    bound, _ = bound_of(curve, spoilt)
    found = deviation(spoilt, curve)
    assert found <= bound <= 2 * found + ROUNDING * size(curve)


def test_the_bound_sees_what_lies_between_its_first_samples() -> None:
    """A bump a hundredth of the spline wide, and no narrower than its knots allow, is bounded wherever it is."""
    fit = spline_of_spans(FILLET, 64, degree=3, continuity=2)
    for index in range(2, len(fit.spline.poles) - 2, 13):
        poles = fit.spline.poles.copy()
        poles[index] += 1e-5j
        spoilt = BSpline(3, fit.spline.knots, poles)
        found = deviation(spoilt, FILLET)
        assert found <= bound_of(FILLET, spoilt)[0] <= 2 * found


def test_a_parallel_curve_is_bounded_by_samples() -> None:
    """No derivative bounds are known for it: the bound says so, and is as near."""
    curve = OffsetCurve(Trochoid(23.0, 1.74, -0.13, 0.0, 4.8), 0.3)
    for degree, continuity in (CUBIC, SEPTIC):
        for tolerance in (1e-3, 1e-6):
            fit = fit_spline(curve, tolerance, degree=degree, continuity=continuity)
            found = deviation(fit.spline, curve)
            assert fit.bound == "sampled"
            assert found <= fit.max_error <= min(tolerance, 1.2 * found)


def test_a_line_is_one_piece() -> None:
    fit = fit_spline(Line(1 + 2j, 4 - 3j), 1e-9, degree=3, continuity=2)
    assert (fit.pieces, len(fit.spline.poles)) == (1, 4)
    assert fit.max_error <= ROUNDING * 5
    assert np.max(np.abs(brute.distance_to_edge(fit.spline.point(np.linspace(0, 1, 50)), 1 + 2j, 4 - 3j, 0.0))) <= 1e-14


@pytest.mark.sampled(1)
@KINDS
def test_the_mirrored_fit_is_a_fit_of_the_mirrored_curve(kind: tuple[int, int]) -> None:
    """Both sides of a tooth are one fit: its mirror image and its turned copies keep the error."""
    for name in ("z 23, flank", "z 23, root_fillet"):
        curve, fit = CURVES[name], fitted(name, 1e-6, kind)
        placement = Placement2(2 * math.pi / 23 * 7, 3 - 2j)
        mirror, turned = curve.mirrored(), curve.placed(placement)
        rounding = ROUNDING * (size(curve) + 4)
        assert deviation(fit.spline.mirrored(), mirror) <= fit.max_error + rounding
        assert deviation(fit.spline.reversed(), curve.reversed()) <= fit.max_error + rounding
        assert deviation(fit.spline.placed(placement), turned) <= fit.max_error + rounding
        assert abs(fit.spline.mirrored().poles[0] - start_point(mirror)) <= rounding


@pytest.mark.sampled(2)
@EVERY
@KINDS
def test_the_spline_never_runs_backwards(name: str, kind: tuple[int, int]) -> None:
    """Its speed keeps the curve's direction and does not fall away inside."""
    curve, spline = CURVES[name], fitted(name, 1e-6, kind).spline
    x = np.linspace(*spline.domain, 1001)
    near = feet(curve, spline.point(x), np.interp(x, spline.domain, curve.domain), steps=30)
    assert np.all((np.conj(curve.tangent(near)) * spline.derivative(x)).real > 0)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("degree", {"tolerance": 1e-3, "degree": 2, "continuity": 1}),
        ("degree", {"tolerance": 1e-3, "degree": 10, "continuity": 1}),
        ("continuity", {"tolerance": 1e-3, "degree": 3, "continuity": 3}),
        ("continuity", {"tolerance": 1e-3, "degree": 3, "continuity": 0}),
        ("tolerance", {"tolerance": 0.0, "degree": 3, "continuity": 2}),
        ("tolerance", {"tolerance": -1.0, "degree": 3, "continuity": 2}),
        ("tolerance", {"tolerance": math.nan, "degree": 3, "continuity": 2}),
    ],
)
def test_what_makes_no_spline_is_refused(name: str, arguments: dict[str, Any]) -> None:
    with pytest.raises(ParameterError) as caught:
        fit_spline(FLANK, **arguments)
    assert caught.value.name == name


def test_an_impossible_tolerance_is_refused() -> None:
    for kind in (CUBIC, SEPTIC):
        with pytest.raises(ConvergenceError):
            fit_spline(FLANK, 1e-15, degree=kind[0], continuity=kind[1])


def test_a_curve_that_turns_back_is_refused() -> None:
    """A parallel of a trochoid beyond its radius of curvature has a cusp: no regular spline follows it."""
    with pytest.raises(CuspError) as caught:
        fit_spline(OffsetCurve(Trochoid(23.0, 1.74, -0.13, 0.0, 4.8), -0.3), 1e-3, degree=3, continuity=2)
    assert 0 < caught.value.t < 4.8


@examples(30)
@given(
    st.integers(6, 400),
    numbers(-0.4, 1.0),
    numbers(-1, 1.7),
    numbers(-7, -2),
    st.sampled_from([CUBIC, QUINTIC, SEPTIC]),
)
def test_any_gear(teeth: int, shift: float, scale: float, exponent: float, kind: tuple[int, int]) -> None:
    try:
        curves = sides(SpurGear(10**scale, teeth, iso_53(), shift))
    except ParameterError:
        return
    for curve in curves.values():
        tolerance = 10 ** (scale + exponent)
        fit = fit_spline(curve, tolerance, degree=kind[0], continuity=kind[1])
        found = deviation(fit.spline, curve, 401)
        assert found <= fit.max_error <= min(tolerance, 2 * found + ROUNDING * size(curve))
        assert fit.bound == "certified"

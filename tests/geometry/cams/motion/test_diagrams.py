"""Diagram curves against their definitions, their derivatives and bounds, and the certified splines of them."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest

from geometry.base.errors import ConvergenceError
from geometry.base.placement import Placement2
from geometry.cams.motion.diagrams import ArmCurve, MotionCurve, diagram, hermite_spline, joint_diagram
from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.cams.motion.guides import Oscillating
from geometry.cams.plane.disk import DiskCam, FollowerKind
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Line
from geometry.laws.named import NAMED_LAWS

LAWS = ("sine", "polynomial_345", "polynomial_4567", "cosine", "modified_trapezoid")


def pieces(law: str, lift: float = 30.0) -> tuple:
    made = NAMED_LAWS[law]()
    return follower_motion([rise(2.0, lift, made), return_(2.2, lift, made), dwell(2 * math.pi - 4.2)]).pieces


def curves(law: str) -> list[Curve]:
    first, last = pieces(law)[0], pieces(law)[-2]
    found: list[Curve] = [MotionCurve(first, *first.domain, 3 + 4j, 20.0, 0.0, 1.5, (0, k)) for k in range(3)]
    found += [MotionCurve(last, *last.domain, 1j, 0.0, 0.7, 0.7, (k, 0)) for k in (1, 2)]
    swing = pieces(law, 0.4)[0]
    return [*found, *(ArmCurve(swing, *swing.domain, 2 + 1j, 0.5, 80.0, sense, 2.5) for sense in (1, -1))]


@pytest.mark.parametrize("law", LAWS)
def test_points_are_those_of_the_motion(law: str) -> None:
    piece = pieces(law)[0]
    t = np.linspace(*piece.domain, 9)
    over_angle, joint = curves(law)[2], MotionCurve(piece, *piece.domain, 0j, 0.0, 2.0, 2.0, (1, 0))
    assert np.abs(over_angle.point(t) - (3 + 4j + 20 * t + 1.5j * piece.value(t, 2))).max() < 1e-12
    assert np.abs(joint.point(t) - 2 * (piece.value(t, 1) + 1j * piece.value(t))).max() < 1e-12


@pytest.mark.sampled(2)
@pytest.mark.parametrize("law", LAWS)
def test_derivatives_bounds_and_tangents(law: str) -> None:
    for curve in curves(law):
        a, b = curve.domain
        t = np.linspace(a + 0.05 * (b - a), b - 0.05 * (b - a), 23)
        h = 1e-4 * (b - a)
        for order in range(1, 4):
            below = curve.point if order == 1 else lambda x, k=order - 1, c=curve: c.derivative(x, k)
            numeric = (below(t - 2 * h) - 8 * below(t - h) + 8 * below(t + h) - below(t + 2 * h)) / (12 * h)
            most = np.abs(curve.derivative(t, order)).max()
            assert np.abs(curve.derivative(t, order) - numeric).max() <= 1e-7 * most + 1e-9
        for order in range(1, 5):
            fine = np.abs(curve.derivative(np.linspace(a, b, 2001), order)).max()
            bound = curve.derivative_bound(order, a, b)
            assert bound is not None
            assert fine <= bound * (1 + 1e-9) <= 4 * fine + 1e-9
        for end, inside in ((a, a + 1e-5 * (b - a)), (b, b - 1e-5 * (b - a))):
            chord = complex(curve.point(inside) - curve.point(end)) * (1 if end == a else -1)
            assert abs(cmath.phase(complex(curve.tangent(end)) / chord)) < 2e-2


@pytest.mark.sampled(3)
@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6])
def test_splines_keep_their_tolerance(law: str, tolerance: float) -> None:
    for curve in curves(law):
        spline, bound = hermite_spline(curve, tolerance)
        t = np.linspace(*curve.domain, 3001)
        off = float(np.abs(spline.point(t) - curve.point(t)).max())
        assert off <= bound + 1e-13 <= tolerance + 2e-13
        assert off > 1e-3 * bound


def test_a_spline_without_end_is_refused() -> None:
    with pytest.raises(ConvergenceError):
        hermite_spline(curves("sine")[2], 1e-16)


def test_straight_diagrams_are_lines() -> None:
    up = pieces("linearly_decreasing")[0]
    assert isinstance(diagram(up, 2, 0j, 1.0, 1.0), Line)
    assert not isinstance(diagram(up, 1, 0j, 1.0, 1.0), Line)
    assert isinstance(joint_diagram(pieces("constant_acceleration")[0], 2, 0j, 1.0), Line)
    assert joint_diagram(pieces("sine")[-1], 1, 0j, 1.0) is None


def test_curves_move_turn_and_trim() -> None:
    curve = curves("sine")[0]
    a, b = curve.domain
    part = curve.trimmed(a + 0.1, b - 0.1)
    assert part.domain == (a + 0.1, b - 0.1)
    assert complex(curve.reversed().point(-b)) == complex(curve.point(b))
    moved = curve.placed(Placement2(0.3, 1 + 2j))
    assert complex(moved.point(b)) == pytest.approx(cmath.exp(0.3j) * complex(curve.point(b)) + 1 + 2j)
    assert complex(curve.mirrored().point(-b)) == pytest.approx(complex(curve.point(b)).conjugate())
    flat = curve.offset(0.01)
    assert abs(complex(flat.point(a + 1)) - complex(curve.point(a + 1))) == pytest.approx(0.01)


@pytest.mark.parametrize("sense", [1, -1])
def test_an_axis_on_the_inclined_line_has_that_pressure_angle(sense: int) -> None:
    """The theorem behind the oscillating follower's diagram, with the pressure angle of the cam's own formula."""
    swing = pieces("polynomial_345", 0.4)
    arm, nu = 80.0, math.radians(35)
    motion = follower_motion(
        [rise(2.0, 0.4, NAMED_LAWS["polynomial_345"]()), return_(2.2, 0.4, NAMED_LAWS["polynomial_345"]()),
         dwell(2 * math.pi - 4.2)]
    )  # fmt: skip
    for t in (0.3, 0.9, 1.4):
        # pivot at 0, lowest arm along +x; the axis above it of sense 1, below it of -1
        curve = ArmCurve(swing[0], *swing[0].domain, 0j, 1.0, arm, sense, 0.0)
        foot = complex(curve.point(t))
        along = foot / abs(foot)
        for side in (1, -1):
            way = along * cmath.exp(1j * side * sense * (math.pi / 2 - nu)) * (1 if side > 0 else -1)
            axis = next(p for k in (60.0, -60.0) if (p := foot + k * way).imag * sense > 0)
            start = abs(cmath.phase(axis))
            cam = DiskCam(motion, Oscillating(abs(axis), arm, start, sense), FollowerKind.POINTED)
            assert abs(float(cam.pressure_angle(t))) == pytest.approx(nu, abs=1e-9)

"""Motions of cams of arcs and lines: against followers that lie on the drawn outline, 40 digits, and textbooks."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.laws.contour import Contour, contour, flat_law, roller_law
from geometry.laws.law import Law

MP = mpmath.mp.clone()
MP.dps = 40
# curvature of the flanks, angle of the rise, degrees
SHAPES = [(0.0, 75.0), (0.0, 100.0), (0.01, 75.0), (0.012, 95.0), (-0.005, 50.0), (-0.005, 100.0), (1e-9, 75.0)]


def made(curvature: float, angle: float) -> Contour:
    return contour(30.0, 17.5, None, math.radians(angle), curvature)


def outline(shape: Contour) -> np.ndarray:
    """Points of base circle, flanks and nose by elementary geometry: tangent points by lines through the centres."""
    alpha, k = shape.rise_angle, shape.curvature
    nose = shape.centre_distance * np.exp(1j * alpha)
    share = np.linspace(0.0, 1.0, 40001)
    if k == 0:
        # the flank stands at right angles to the radius at angle 0
        turn = 0.0
        flank = 30.0 + 1j * nose.imag * share
    else:
        centre = 30.0 - 1 / k
        turn = float(np.angle((nose - centre) * math.copysign(1.0, k)))
        flank = centre + np.exp(1j * turn * share) / k
    tip = nose + shape.nose_radius * np.exp(1j * (turn + (2 * alpha - 2 * turn) * share))
    base = 30.0 * np.exp(1j * np.linspace(2 * alpha, 2 * math.pi, 40001))
    back = np.conj(flank) * np.exp(2j * alpha)
    return np.concatenate([flank, tip, back[::-1], base])


def lifted(points: np.ndarray, theta: float, radius: float | None) -> float:
    """Where a face (None) or a roller over the axis comes to lie on points of the cam, mm above the base circle."""
    turned = points * np.exp(-1j * theta)
    up, beside = turned.real, turned.imag
    if radius is None:
        return float(up.max()) - 30.0
    met = np.abs(beside) < radius
    return float((up[met] + np.sqrt(radius**2 - beside[met] ** 2)).max()) - 30.0 - radius


def motion(law: Law, shape: Contour, theta: float, order: int = 0) -> float:
    return float(law.value(theta / shape.rise_angle, order)) * shape.lift / shape.rise_angle**order


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("curvature", "angle"), SHAPES)
@pytest.mark.parametrize("radius", [12.0, 40.0])
def test_a_roller_lies_on_the_outline(curvature: float, angle: float, radius: float) -> None:
    shape = made(curvature, angle)
    law, points = roller_law(shape, radius), outline(shape)
    for theta in np.linspace(0.0, shape.rise_angle, 23).tolist():
        # samples of the outline lie at most a sagitta below it
        assert lifted(points, theta, radius) == pytest.approx(motion(law, shape, theta), abs=1e-5)


@pytest.mark.parametrize(("curvature", "angle"), [s for s in SHAPES if s[0] > 1e-3])
def test_a_face_lies_on_the_outline(curvature: float, angle: float) -> None:
    shape = made(curvature, angle)
    law, points = flat_law(shape), outline(shape)
    for theta in np.linspace(0.0, shape.rise_angle, 23).tolist():
        assert lifted(points, theta, None) == pytest.approx(motion(law, shape, theta), abs=1e-5)


def test_the_oracle_sees_another_outline() -> None:
    shape = made(0.0, 75.0)
    law, points = roller_law(shape, 12.0), outline(made(0.002, 75.0))
    theta = shape.rise_angle / 2
    assert abs(lifted(points, theta, 12.0) - motion(law, shape, theta)) > 1e-3


@pytest.mark.parametrize("radius", [0.0, 12.0, 17.5])
def test_the_tangent_cam_has_the_textbooks_formulas(radius: float) -> None:
    """(r_1 + r)(1 / cos t - 1), then d cos(a - t) + sqrt((r_2 + r)^2 - d^2 sin^2(a - t)) - r_1 - r, and derivatives."""
    shape = made(0.0, 75.0)
    law, change = roller_law(shape, radius), shape.change(radius)
    d, reach, alpha = MP.mpf(shape.centre_distance), MP.mpf(shape.nose_radius) + radius, MP.mpf(shape.rise_angle)

    def flank(t):
        return (30 + radius) * (1 / MP.cos(t) - 1)

    def nose(t):
        return d * MP.cos(alpha - t) + MP.sqrt(reach**2 - (d * MP.sin(alpha - t)) ** 2) - 30 - radius

    for theta in np.linspace(1e-3, shape.rise_angle - 1e-3, 31).tolist():
        for order, near in enumerate((1e-12, 1e-12, 1e-10)):
            exact = float(MP.diff(flank if theta < change else nose, theta, order))
            assert motion(law, shape, theta, order) == pytest.approx(exact, abs=near * 30)


def test_an_eccentric_circle_is_a_harmonic_under_a_face() -> None:
    shape = contour(20.0, 20.0, 30.0)
    assert shape.rise_angle == math.pi
    law = flat_law(shape)
    for theta in np.linspace(0, math.pi, 9).tolist():
        assert motion(law, shape, theta) == pytest.approx(10 * (1 - math.cos(theta)), abs=1e-13)
        reach = 30 + 12.5
        held = -10 * math.cos(theta) + math.sqrt(reach**2 - (10 * math.sin(theta)) ** 2) - 32.5
        assert motion(roller_law(shape, 12.5), shape, theta) == pytest.approx(held, abs=1e-12)


def test_khurmis_tangent_cam() -> None:
    """Theory of Machines, chapter 20: r_1 = 30, r = 17.5, lift 17.5, ascent 75 degrees, 600 rpm: 187.6 m/s^2."""
    shape, omega = contour(30.0, 17.5, None, math.radians(75)), 20 * math.pi
    law = roller_law(shape, 17.5)
    at = [0.0, shape.change(17.5) * (1 - 1e-12), shape.change(17.5) * (1 + 1e-12), shape.rise_angle]
    found = [motion(law, shape, theta, 2) * omega**2 / 1000 for theta in at]
    # the book rounds omega to 62.84 rad/s
    assert found[0] == pytest.approx(187.6, rel=5e-4)
    # w^2 (r_1 + r)(2 - cos^2)/cos^3 at the end of the flank, tan t = d sin a / (r_1 + r)
    t = math.atan(shape.centre_distance * math.sin(math.radians(75)) / 47.5)
    assert found[1] == pytest.approx(omega**2 * 0.0475 * (2 - math.cos(t) ** 2) / math.cos(t) ** 3, rel=1e-9)
    # w^2 d (1 + d / (r_2 + r)) at the apex
    d = shape.centre_distance
    assert found[3] == pytest.approx(-(omega**2) * d / 1000 * (1 + d / (shape.nose_radius + 17.5)), rel=1e-9)
    assert found[2] < 0


def test_the_circular_arc_cam_of_textbooks() -> None:
    """r_1 = 30, lift 20, nose 5, angle of lift 75 degrees under a flat face: the triangle of centres gives R."""
    shape, omega = contour(30.0, 20.0, 5.0, math.radians(75)), 20 * math.pi
    radius = 1 / shape.curvature
    assert (radius - 5) ** 2 == pytest.approx(
        (radius - 30) ** 2 + 45**2 - 2 * (radius - 30) * 45 * math.cos(math.radians(105)), rel=1e-12
    )
    law = flat_law(shape)
    # w^2 (R - r_1) where the lift begins, w^2 d at the apex
    assert motion(law, shape, 0.0, 2) * omega**2 == pytest.approx((radius - 30) * omega**2, rel=1e-12)
    assert motion(law, shape, shape.rise_angle, 2) * omega**2 == pytest.approx(-45 * omega**2, rel=1e-12)


@pytest.mark.parametrize(("curvature", "angle"), SHAPES)
def test_any_three_sizes_give_the_fourth(curvature: float, angle: float) -> None:
    shape = made(curvature, angle)
    nose, alpha = shape.nose_radius, shape.rise_angle
    assert contour(30.0, 17.5, nose, None, curvature).rise_angle == pytest.approx(alpha, rel=1e-12)
    found = contour(30.0, None, nose, alpha, curvature).lift
    # two outlines may have these: either keeps its angle
    assert contour(30.0, found, nose, None, curvature).rise_angle == pytest.approx(alpha, rel=1e-9)
    assert contour(30.0, 17.5, nose, alpha).curvature == pytest.approx(curvature, abs=1e-12)


@pytest.mark.parametrize(
    ("sizes", "code"),
    [((17.5,), "contour_too_few"), ((17.5, None, math.radians(50)), "no_such_contour"),
     ((17.5, 60.0, math.radians(75)), "no_such_contour"), ((20.0, 40.0, 1.0), "eccentric_has_no_flank"),
     ((17.5, 10.0, 1.3, 0.01), "contour_overdetermined")],
)  # fmt: skip
def test_sizes_of_no_outline_are_refused(sizes: tuple[float | None, ...], code: str) -> None:
    with pytest.raises(ParameterError) as caught:
        contour(30.0, *sizes)
    assert caught.value.code == code


def test_followers_that_do_not_fit_are_refused() -> None:
    hollow = made(-0.02, 60.0)
    with pytest.raises(ParameterError, match="roller_above_hollow"):
        roller_law(hollow, 51.0)
    with pytest.raises(ParameterError, match="face_needs_convex_flank"):
        flat_law(hollow)
    with pytest.raises(ParameterError, match="contour_too_steep"):
        roller_law(contour(30.0, 60.0, 3.0, math.radians(30)), 12.5)

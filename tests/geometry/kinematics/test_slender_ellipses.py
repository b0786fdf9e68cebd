"""Slender ellipses up to the eccentricity 0.9999: the pitch line against elliptic integrals, and gears."""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest

from geometry.gears.noncircular.pitch_line import DriverShape, PitchLine
from geometry.kinematics.centrodes import LobedEllipse
from geometry.plane.measure import profile_area
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from tests.oracles.exact_gear import MP

LONG = 100.0
ECCENTRICITIES = pytest.mark.parametrize("e", [0.99, 0.999, 0.9999])
# eccentric anomalies from the far end to the near one, whose radius of curvature is a (1 - e^2)
PLACES = (0.0, 0.4, 1.5, 2.6, 3.0, 3.1, 3.13, 3.14, 3.1415, math.pi)


def pitch_line(e: float) -> PitchLine:
    return PitchLine(DriverShape(LobedEllipse(LONG * (1 - e) * (1 + e), e)), mirrored=True)


def exact(e: float, anomaly: float) -> tuple[Any, complex, Any, Any]:
    """Arc length, point, direction of the tangent and curvature at an eccentric anomaly by 40 digits.

    The axis is a focus, the far end on +x: x = a (cos E + e), y = b sin E, s = a (E(e) - E(pi/2 - E | e)).
    """
    one, at = MP.mpf(e), MP.mpf(anomaly)
    short = MP.mpf(LONG) * MP.sqrt(1 - one**2)
    arc = LONG * (MP.ellipe(one**2) - MP.ellipe(MP.pi / 2 - at, one**2))
    x, y = -LONG * MP.sin(at), short * MP.cos(at)
    speed = MP.hypot(x, y)
    point = complex(LONG * (MP.cos(at) + one), short * MP.sin(at))
    return arc, point, MP.atan2(y, x), LONG * short / speed**3


@pytest.mark.sampled(1)
@ECCENTRICITIES
def test_arc_length_place_direction_and_curvature(e: float) -> None:
    line = pitch_line(e)
    perimeter = 4 * LONG * MP.ellipe(MP.mpf(e) ** 2)
    assert abs(line.length / perimeter - 1) < 1e-13
    sharpest = 1 / (LONG * (1 - e) * (1 + e))
    for anomaly in PLACES:
        arc, point, direction, curvature = exact(e, anomaly)
        found, tangent, kappa = line.frame(float(arc))
        assert abs(complex(found) - point) < 1e-12 * LONG
        # what the arc length rounds turns the tangent at the sharp end
        loose = 1e-12 + 1e-15 * line.length * float(curvature)
        assert abs(cmath.phase(complex(tangent) * cmath.exp(-1j * float(direction)))) < 10 * loose
        assert abs(float(kappa) - float(curvature)) < 1e-10 * sharpest
        # an ellipse that differs a little is seen
        assert abs(complex(found) - exact(e - 1e-7, anomaly)[1]) > 1e-9 * LONG


@pytest.mark.sampled(1)
@ECCENTRICITIES
def test_it_closes_and_is_its_own_mirror_image(e: float) -> None:
    line = pitch_line(e)
    s = np.linspace(0, line.length / 2, 40)
    ahead, behind = line.frame(s)[0], line.frame(line.length - s)[0]
    assert np.abs(ahead - np.conj(behind)).max() < 1e-12 * LONG
    assert abs(complex(line.frame(line.length)[0] - line.frame(0.0)[0])) < 1e-13 * LONG
    near = LONG * (1 - e)
    assert complex(line.frame(line.length / 2)[0]) == pytest.approx(-near, abs=1e-12 * LONG)
    for angle in (0.5, 2.0, math.pi, 4.0):
        s = line.arc_at_angle(angle)
        assert float(line.angle(s)) == pytest.approx(angle, abs=1e-11)


@pytest.mark.sampled(1)
@ECCENTRICITIES
def test_bounds_of_the_derivatives_hold_at_the_sharp_end(e: float) -> None:
    """Held against Taylor coefficients at many places; those at the vertex are known: |c''| / 2 = kappa / 2."""
    line = pitch_line(e)
    size = LONG * (1 - e**2)
    for low, high in ((-2 * size, size), (-0.1 * size, 0.1 * size), (30 * size, 31 * size)):
        a, b = line.length / 2 + low, line.length / 2 + high
        inside = line.series(np.linspace(a, b, 301), 4)
        bounds = line.series_bound(4, np.array([a]), np.array([b]))
        for order in range(5):
            most = float(np.abs(inside[order]).max())
            assert most <= float(bounds[order][0]) * (1 + 1e-12) < math.inf
    assert line.series_bound(2, np.array([line.length / 2]), np.array([line.length / 2]))[2][0] >= 1 / size / 2


def made(**keys: object) -> Any:
    gear = {"kind": "noncircular_gear", "centrode": "focal_ellipse", "module": 2.0} | keys
    return make_parts(scene_from_dict({"parts": {"gear": gear}}, "s", "s"), "s")[0]["gear"]


@pytest.mark.heavy
@pytest.mark.parametrize(("e", "teeth"), [(0.995, 400), pytest.param(0.9992, 2000, marks=pytest.mark.heavy)])
def test_gears_on_slender_ellipses_are_cut(e: float, teeth: int) -> None:
    """Their area is near that of the centrode, pi a b, and of as much above it as below."""
    outer = made(eccentricity=e, number_of_teeth=teeth).section(0.0).region.outer
    long = teeth * 2.0 * math.pi / (4 * float(MP.ellipe(MP.mpf(e) ** 2)))
    area = profile_area(outer)
    # between the centrode's parallels at the roots and at the tips
    perimeter, ellipse = teeth * 2 * math.pi, math.pi * long**2 * math.sqrt(1 - e**2)
    assert ellipse - 2.5 * perimeter < area < ellipse + 2 * perimeter + 4 * math.pi


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("keys", "key"), [
    ({"eccentricity": 0.9999, "number_of_teeth": 120}, "eccentricity"),
    ({"eccentricity": 0.9995, "number_of_teeth": 2000}, "eccentricity"),
    ({"axis_ratio": 20.0, "number_of_teeth": 60}, "axis_ratio"),
    pytest.param({"eccentricity": 0.9999, "number_of_teeth": 2000, "profile_shift_coefficient": 1.0, "basic_rack":
                  {"addendum_coefficient": 0.3, "tip_clearance_coefficient": 0.75, "tip_radius_coefficient": 0.0}},
                 "eccentricity", marks=pytest.mark.heavy),
])  # fmt: skip
def test_what_is_too_slender_names_the_nearest_that_works(keys: dict[str, Any], key: str) -> None:
    with pytest.raises(SceneError) as refusal:
        made(**keys)
    text = str(refusal.value)
    assert f"parts.gear.{key} = {keys[key]}" in text
    works = float(text.split("at most ")[1].split(maxsplit=1)[0])
    made(**(keys | {key: works}))

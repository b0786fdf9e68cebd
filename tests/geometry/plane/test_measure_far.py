"""Distances of points that lie far from an outline of many curves: right, and measured on the curves near them only."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import ArrayLike

from geometry.curves.curve import Complex, Curve, end_point, start_point
from geometry.curves.line_arc import Line
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Label, Profile, Segment


def star(teeth: int) -> Profile:
    """A closed zigzag of 2 ``teeth`` lines between two circles."""
    radii = np.tile([20.0, 23.0], teeth)
    corners = (radii * np.exp(1j * np.pi * np.arange(2 * teeth) / teeth)).tolist()
    lines = [Line(a, b) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)]
    return Profile(tuple(Segment(line, Label.CAM) for line in lines))


def brute(points: np.ndarray, profile: Profile) -> np.ndarray:
    """By GEOS."""
    import shapely

    corners = [complex(s.curve.point(0.0)) for s in profile.period]
    ring = shapely.linearrings([(z.real, z.imag) for z in corners])
    return np.asarray(shapely.distance(shapely.points(points.real, points.imag), ring))


@pytest.mark.parametrize("scale", [0.0, 0.5, 1.01, 3.0])
def test_far_points_against_geos(scale: float) -> None:
    profile = star(30)
    points = scale * np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 9)) for s in profile.period]) + 0.05
    assert np.abs(distance_to_profile(points, profile) - brute(points, profile)).max() < 1e-12


class Counted(Curve):
    """A straight curve that counts the points it is asked for."""

    asked = 0

    def __init__(self, start: complex, end: complex) -> None:
        self.ends = start, end

    @property
    def domain(self) -> tuple[float, float]:
        return 0.0, 1.0

    def point(self, t: ArrayLike) -> Complex:
        Counted.asked += np.size(t)
        return self.ends[0] + (self.ends[1] - self.ends[0]) * np.asarray(t)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        return np.full(np.shape(t), self.ends[1] - self.ends[0] if order == 1 else 0j)


def test_far_points_ask_the_curves_beside_them() -> None:
    """Every point was projected on every curve: a wrong file's check took 60 times that of a right one."""
    lines = [s.curve for s in star(60).period]
    profile = Profile(tuple(Segment(Counted(start_point(c), end_point(c)), Label.CAM) for c in lines))
    points = 1.01 * np.concatenate([c.point(np.linspace(*c.domain, 9)) for c in lines])
    Counted.asked = 0
    found = distance_to_profile(points, profile)
    assert np.abs(found - brute(points, profile)).max() < 1e-12
    assert Counted.asked < 120 * len(points)

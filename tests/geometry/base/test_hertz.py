"""Contact of two bodies at a point, against mpmath and the closed forms of a ball on a plane."""

from __future__ import annotations

import math

import mpmath
import pytest

from geometry.base.hertz import elliptic, pressure, stiffness


@pytest.mark.parametrize("k", [1e-6, 1e-3, 0.3, 0.9, 1.0])
def test_elliptic_integrals(k: float) -> None:
    with mpmath.workdps(40):
        parameter = 1 - mpmath.mpf(k) ** 2
        wanted = float(mpmath.ellipk(parameter)), float(mpmath.ellipe(parameter))
    assert elliptic(k) == pytest.approx(wanted, rel=1e-11)


def test_a_ball_on_a_plane() -> None:
    """F = 4/3 E* sqrt(R) delta^(3/2); p_0 = (6 F E*^2 / (pi^3 R^2))^(1/3): Johnson (4.22), (4.24)."""
    radius, modulus, load = 5.0, 115_000.0, 80.0
    # sums along and across an ellipse, here a circle
    curved = (1 / radius, 1 / radius)
    assert stiffness(curved, modulus) == pytest.approx(4 / 3 * modulus * math.sqrt(radius), rel=1e-9)
    told = (6 * load * modulus**2 / (math.pi**3 * radius**2)) ** (1 / 3)
    assert pressure(load, curved, modulus) == pytest.approx(told, rel=1e-9)

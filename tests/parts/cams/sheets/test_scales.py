"""Scales of the diagrams of a cam: the pole distances against the slope that a diagram has on paper."""

from __future__ import annotations

import math

import pytest

from parts.cams.sheets.picture import Scales


@pytest.mark.parametrize("order", [0, 1])
def test_a_ray_from_the_pole_runs_along_the_diagram(order: int) -> None:
    """S = 12 (1 - cos 2 phi): each ray from H left of the axis to the ordinate of the next derivative is a tangent."""
    scales = Scales(phi_deg=1.5, lift=0.2, rate=0.4, bend=1.25)
    curves = (lambda a: 12 * (1 - math.cos(2 * a)), lambda a: 24 * math.sin(2 * a), lambda a: 48 * math.cos(2 * a))
    step = 1e-4
    for angle in (0.3, 0.7, 1.9):
        low, high = (curves[order](angle + s * step) / scales.of(order) for s in (-1, 1))
        # a turn of 360 degrees is 240 mm wide
        tangent = (high - low) / (2 * step * 240 / math.tau)
        ray = curves[order + 1](angle) / scales.of(order + 1) / scales.poles[order]
        assert ray == pytest.approx(tangent, rel=1e-6)

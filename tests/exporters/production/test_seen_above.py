"""Silhouettes of what lies: like on both sides of their axes, and rounded as files round them they cross nowhere."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from exporters.production.seen_above import seen_lying
from parts.scene.load import make_parts, scene_from_toml
from parts.scene.standing import Instance
from tests.sampling import some_of

# the wheel of a grinder's head, and the pinion of an axle: their hulls and cones meet in slivers
WHEEL = (
    '[parts.one]\nkind = "bevel_gear"\nmodule = 1.5\nnumber_of_teeth = 37\nmate_number_of_teeth = 14\n'
    "profile_shift_coefficient = -0.35\nhub_diameter = 20.0\nhub_length = 6.0\nbore_diameter = 8.0\n"
)
PINION = (
    '[parts.one]\nkind = "bevel_gear"\nmodule = 2.5\nnumber_of_teeth = 11\nmate_number_of_teeth = 41\n'
    "profile_shift_coefficient = 0.4\nbore_diameter = 8.0\n"
)
STEPS = (
    '[parts.one]\nkind = "shaft"\nsteps = [{ diameter = 8.0, length = 9.0 }, { diameter = 20.0, length = 0.5 }, '
    "{ diameter = 12.0, length = 30.0 }]\n"
)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("text", [WHEEL, PINION, STEPS])
def test_silhouettes_are_alike_on_both_sides_and_cross_nowhere_once_they_are_rounded(text: str) -> None:
    """Any way of lying, with the six digits of an animated SVG; hulls of circles seen edge on lost a half of them."""
    part = make_parts(scene_from_toml((text + '[[exports]]\nformat = "stl"\n').encode(), "s.toml", "s"), "")[0]["one"]
    ways = [(turn, lean) for turn in (0.0, 25.0, 40.0, 65.0, 130.0, -77.0) for lean in (0.0, 0.2, -0.6)]
    for turn, lean in [(25.0, 0.0), (180.0, 6e-17), *some_of(ways, 5)]:
        along = np.exp(1j * np.radians(turn))
        way = np.array([along.real, along.imag, lean])
        x, y, z = (way / np.linalg.norm(way)).tolist()
        seen, off = seen_lying(part, Instance("one", "one", axis=(x, y, z)), 1e-3, spins=True)
        assert 0 < off <= 1.1e-3 + 1e-4
        segments = seen.segments()
        corners = np.concatenate([segment.curve.point(np.zeros(1)) for segment in segments])
        ring = np.round(np.column_stack([corners.real, corners.imag]), 6)
        assert shapely.is_simple(shapely.linearrings(ring)), (turn, lean)
        # nor does it repeat a corner
        assert np.all(np.abs(np.diff(corners, append=corners[:1])) > 0)
        level = corners / along
        one, other = (shapely.Polygon(np.column_stack([v.real, v.imag])) for v in (level, level.conj()))
        assert one.symmetric_difference(other).area < 1e-5 * one.area, (turn, lean)
        if text == STEPS and abs(lean) < 1e-9:
            # rectangles
            assert one.area == pytest.approx(8 * 9 + 20 * 0.5 + 12 * 30, rel=1e-4)

"""The measuring itself: the outside outline against a brute-force sweep, and files of slightly wrong gears noticed."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.exporters.making import build_gear, check_deviation
from tests.exporters.outside import Gear, distances, half_tooth, points_at
from tests.oracles.rack_sweep import RackTool, outline_error
from tests.sampling import some_of

GEARS = [
    Gear(2, 23),
    Gear(1, 5, 0.1),
    Gear(3, 8),
    Gear(10, 13, 0.694, tip_diameter=160.68),
    Gear(3, 30, relief_depth=0.02),
    Gear(2, 40, thinning=0.2),
]


@pytest.mark.parametrize("gear", GEARS, ids=lambda g: f"m {g.module} z {g.teeth}")
def test_the_outline_is_what_the_rack_leaves(gear: Gear) -> None:
    numbers = (gear.addendum, gear.clearance, gear.tip_rounding, gear.shift, gear.thinning)
    tool = RackTool(gear.module, np.radians(gear.angle_deg), *numbers, gear.relief_depth, gear.relief_height)
    pieces = half_tooth(gear)
    for name, chain in pieces.items():
        at = np.unique(np.linspace(0, len(chain) - 1, 24).astype(int))
        assert outline_error(chain[at], tool, gear.teeth, gear.tip_radius).max() < 1e-7 * gear.module, name
    chains = list(pieces.values())
    for one, other in pairwise(chains):
        assert abs(one[-1] - other[0]) < 2e-6


def test_distances_have_their_sign_and_size() -> None:
    gear = GEARS[0]
    for distance in (-0.2, -0.01, 0.01, 0.2):
        moved = points_at(gear, distance)
        assert len(moved) > 100
        off, _, _ = distances(moved * np.exp(2j * np.pi / gear.teeth * 7), gear)
        assert np.abs(off - distance).max() < 1e-6
    middle_of_space = np.exp(1j * np.pi / gear.teeth)
    off, _, _ = distances(np.array([gear.tip_radius + 3, (gear.root_radius - 3) * middle_of_space]), gear)
    assert off == pytest.approx([3, -3])


@pytest.mark.sampled(1)
@pytest.mark.parametrize("export", [{"format": "dxf"}, {"format": "svg"}, {"format": "stl"}], ids=lambda e: e["format"])
def test_a_slightly_wrong_gear_is_noticed(tmp_path: Path, export: dict[str, Any]) -> None:
    """Negative control: the file is that of one gear, the measurement asks for another."""
    gear = Gear(2, 23, bore=8)
    entry = build_gear(tmp_path, gear, export)["files"][0]
    file = tmp_path / "out" / "s" / entry["path"]
    check_deviation(file, gear, entry)
    step = 2.5 * entry["tolerance"]
    others = (
        replace(gear, shift=step / 2),
        replace(gear, thinning=2 * step),
        replace(gear, tip_rounding=0.33),
        replace(gear, angle_deg=20.8),
        replace(gear, tip_diameter=50 + 2 * step),
        replace(gear, bore=8 + 2 * step),
        replace(gear, clearance=0.25 + step / 2),
    )
    for wrong in some_of(others, 3):
        with pytest.raises(AssertionError):
            check_deviation(file, wrong, entry)
    for change in ({"offset": step}, {"offset": -step}, {"max_error": 0.4 * entry["max_error"]}, {"max_error": 0.02}):
        with pytest.raises(AssertionError):
            check_deviation(file, gear, entry | change)

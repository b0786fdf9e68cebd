"""What calculations and tables of drawings tell of sectors: spans and pins only where there are teeth for them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from shapely.geometry import Polygon

from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.sector import Sector
from parts.base.refusal import SceneError
from parts.gears.ring_gear.page import sheet as ring_sheet
from parts.gears.spur_gear.page import sheet
from parts.gears.spur_gear.part import SpurGearSpec, checked_spur_gear
from tests.geometry.gears.teeth.test_sector import polygon

GEAR: dict[str, Any] = {"module": 2.0, "number_of_teeth": 40}
RING: dict[str, Any] = {"module": 2.0, "number_of_teeth": 60, "rounded_root": {}}


def values(page: Any) -> dict[str, Any]:
    return {step.name: step.value for step in page.steps()}


def caliper(outline: Polygon, low: float, high: float) -> float:
    """The least distance of parallel jaws, which do not reach the roots, about teeth between directions, rad."""
    points = np.array([complex(x, y) for x, y in outline.exterior.coords])
    near = points[(np.angle(points) > low) & (np.angle(points) < high) & (np.abs(points) > 38.5)]
    middle = (low + high) / 2
    turns = middle + np.linspace(-0.02, 0.02, 401)
    across = (near[:, None] * np.exp(-1j * turns)[None, :]).imag
    return float((across.max(axis=0) - across.min(axis=0)).min())


@pytest.mark.parametrize(("teeth", "span"), [(9, 5), (5, 5), (4, 4)])
def test_the_span_is_over_teeth_that_a_sector_has(teeth: int, span: int) -> None:
    """W of five teeth is the best of z 40; of four kept ones that over four, as jaws find it on the outline."""
    found = values(sheet(GEAR | {"sector": {"teeth": teeth, "first_tooth": 0}}))
    assert found["teeth_spanned"] == span
    made = checked_spur_gear(SpurGearSpec(**GEAR, sector=None))
    whole = polygon(gear_region(made).region.outer)
    pitch = math.tau / 40
    assert found["span"] == pytest.approx(caliper(whole, -pitch / 2, (span - 0.5) * pitch), abs=2e-3)


def test_numbers_of_a_sector() -> None:
    found = values(sheet(GEAR | {"sector": {"teeth": 9}}))
    assert (found["number_of_teeth"], found["sector_teeth"]) == (40, 9)
    assert (found["sector_angle_deg"], found["sector_arc"]) == pytest.approx((81.0, 18 * math.pi))
    assert "sector_runs" not in found
    assert values(sheet(GEAR | {"sector": {"teeth": 5, "runs": 4}}))["sector_runs"] == 4
    assert values(ring_sheet(RING | {"sector": {"teeth": 9}}))["sector_teeth"] == 9


@pytest.mark.parametrize(
    ("z", "sector", "pins"),
    [
        (40, {"teeth": 9}, False), (40, {"teeth": 21}, False), (40, {"teeth": 22}, True),
        (40, {"teeth": 5, "runs": 2}, True), (39, {"teeth": 5, "runs": 3}, False), (39, {"teeth": 21}, True),
        (40, {"teeth": 1, "runs": 2}, False),
    ],
)  # fmt: skip
def test_pins_need_two_opposite_spaces(z: int, sector: dict[str, Any], pins: bool) -> None:
    """Counted here space by space: of an odd number of teeth both are half a pitch off being opposite."""
    n, runs = sector["teeth"], sector.get("runs", 1)
    spaces = [(k + 0.5 + run * z / runs) * 360 / z for run in range(runs) for k in range(n - 1)]
    apart = 180 - (z % 2) * 180 / z
    there = any(abs((a - b) % 360 - apart) < 1e-6 for a in spaces for b in spaces)
    assert there is pins
    assert ("over_pins" in values(sheet(GEAR | {"number_of_teeth": z, "sector": sector}))) is pins


@pytest.mark.parametrize(
    ("table", "key"),
    [
        (GEAR | {"sector": {"teeth": 4}, "teeth_spanned": 5}, "teeth_spanned"),
        (GEAR | {"sector": {"teeth": 2}, "teeth_spanned": 3}, "teeth_spanned"),
        (GEAR | {"sector": {"teeth": 4}, "pin_diameter": 3.5}, "pin_diameter"),
        # four teeth of a ring have three whole spaces between them
        (RING | {"sector": {"teeth": 4}, "spaces_spanned": 4}, "spaces_spanned"),
    ],
)
def test_what_a_sector_has_no_teeth_for_is_refused(table: dict[str, Any], key: str) -> None:
    told = ring_sheet if "rounded_root" in table else sheet
    with pytest.raises(SceneError, match=rf"\.{key} =") as refused:
        told(table)
    cure = refused.value.nearest
    assert cure is not None
    changed = {k: v for k, v in table.items() if k != key} | ({} if cure.value is None else {key: cure.value})
    assert values(told(changed))["sector_teeth"] == table["sector"]["teeth"]


def test_a_run_of_a_ring_spans_its_spaces() -> None:
    """Five teeth have four whole spaces between them."""
    assert values(ring_sheet(RING | {"sector": {"teeth": 5}})).get("spaces_spanned", 0) <= 4
    assert Sector(5, 0).has_opposite_spaces(60) is False

"""Calculations of pairs with a sector: over which angle it is in mesh, and what it moves by that."""

from __future__ import annotations

import math
from typing import Any

import pytest

from parts.mates.pages.external import sheet

GEAR: dict[str, Any] = {"module": 2.0, "number_of_teeth": 20}
SECTOR: dict[str, Any] = {"module": 2.0, "number_of_teeth": 40, "sector": {"teeth": 9}}


@pytest.mark.parametrize(
    ("kind", "first", "second", "own", "other"),
    [
        ("external_gear_pair", SECTOR, GEAR, 40, 20),
        ("external_gear_pair", GEAR, SECTOR, 40, 20),
        # undercut takes a third of the contact
        ("external_gear_pair", GEAR | {"number_of_teeth": 9}, SECTOR, 40, 9),
        ("external_gear_pair", SECTOR | {"helix_angle_deg": 20.0, "face_width": 20.0},
         GEAR | {"helix_angle_deg": 20.0, "hand": "left", "face_width": 20.0}, 40, 20),
        ("internal_gear_pair", GEAR, {"module": 2.0, "number_of_teeth": 60, "sector": {"teeth": 9}}, 60, 20),
        ("internal_gear_pair", GEAR | {"sector": {"teeth": 9}}, {"module": 2.0, "number_of_teeth": 60}, 20, 60),
        ("rack_pair", SECTOR, {"module": 2.0, "number_of_teeth": 30}, 40, 0),
    ],
)  # fmt: skip
def test_a_sector_is_in_mesh_over_its_teeth_and_the_contact_ratio(
    kind: str, first: dict[str, Any], second: dict[str, Any], own: int, other: int
) -> None:
    """(n - 1 + eps) pitches, of helical teeth with their overlap; the mate by the ratio of the teeth."""
    page = sheet({"kind": kind, "first": first, "second": second})
    found = {step.name: float(step.value) for step in page.steps() if isinstance(step.value, int | float)}
    ratio = found.get("effective_contact_ratio", found["contact_ratio"]) + found.get("overlap_ratio", 0.0)
    assert found["sector_mesh_angle_deg"] == pytest.approx((8 + ratio) * 360 / own, rel=1e-9)
    # the formula has the one of both contact ratios that counts
    (step,) = [step for step in page.steps() if step.name == "sector_mesh_angle_deg"]
    whole = abs(found.get("effective_contact_ratio", found["contact_ratio"]) - found["contact_ratio"]) < 1e-6
    assert ("{eps_eff}" in step.formula, "{eps}" in step.formula) == (not whole, whole)
    if other:
        assert found["sector_moves_deg"] == pytest.approx((8 + ratio) * 360 / other, rel=1e-9)
    else:
        assert found["sector_travel"] == pytest.approx((8 + ratio) * 2 * math.pi, rel=1e-9)

"""Tolerance classes of splines: tables of DIN 5480-1 and GOST 6033-80, limits as they are measured on teeth made so."""

from __future__ import annotations

import math

import pytest

from geometry.base.record import replace
from geometry.solids.spline_fits import CLASSES, side_limits
from geometry.solids.spline_standards import din_5480, gost_6033, iso_4156
from geometry.solids.splines import InvoluteJoint

# d_B, m, z of each of the nine columns, from the least to the greatest
COLUMNS = ((12, 1, 10), (25, 1, 24), (50, 1, 48), (100, 1.5, 65), (100, 2, 48), (200, 2, 98), (400, 4, 98),
           (400, 10, 38), (500, 10, 48))  # fmt: skip


def classed(joint: InvoluteJoint, hub: str, shaft: str) -> InvoluteJoint:
    """A joint with classes."""
    return replace(joint, hub_class=hub, shaft_class=shaft)


def din(column: int, hub: str = "", shaft: str = "") -> InvoluteJoint:
    """A joint of a column of table 7."""
    diameter, module, teeth = COLUMNS[column]
    return classed(din_5480(diameter, module, teeth), hub, shaft)


@pytest.mark.parametrize("column", range(9))
def test_deviations_of_din_5480_are_steps_of_one_series(column: int) -> None:
    """Of each column: a to v are multiples of that of n, as 10/4 is of k, within the rounding to whole micrometres."""
    found = {}
    for letter in CLASSES["DIN 5480"][2]:
        limits = side_limits(din(column, shaft=f"8{letter}"), is_shaft=True)
        assert limits is not None
        found[letter] = 1000 * limits.deviation
    unit = found["v"] / 10
    shares = {"a": -10, "b": -8, "c": -6, "d": -4, "e": -3, "f": -2, "g": -1, "h": 0, "j": 1, "k": 2, "m": 3, "n": 4,
              "p": 5, "r": 6, "s": 7, "t": 8, "u": 9}  # fmt: skip
    for letter, share in shares.items():
        assert abs(found[letter] - share * unit) < 1.01, letter


def test_tolerances_of_din_5480_grow_by_the_series_r20_and_r20_by_three_a_grade() -> None:
    totals = []
    for row in range(30):
        column, grade = (row % 3, 5 + row // 3) if row < 24 else (row - 21, 12)
        limits = side_limits(din(column, hub=f"{grade}H"), is_shaft=False)
        assert limits is not None
        totals.append(1000 * limits.total)
        if column >= 3 or grade == 12:
            continue
        # three columns on is a grade on
        same = side_limits(din(column + 3, hub=f"{grade}H"), is_shaft=False)
        above = side_limits(din(column, hub=f"{grade + 1}H"), is_shaft=False)
        assert same is not None
        assert above is not None
        assert (same.total, same.variation) == (above.total, above.variation)
    for row, total in enumerate(totals):
        assert total == pytest.approx(12.5 * 10 ** (row / 20), rel=0.05), row


@pytest.mark.parametrize("joint", [classed(iso_4156(25, 1.0, 30.0, "flat"), "5H", "6e"), din(3, "9H", "8f")])
def test_what_is_measured_at_a_limit_is_measured_on_teeth_made_so(joint: InvoluteJoint) -> None:
    """Another way: the joint itself made as thick, and the involute's own function for the pins."""
    for is_shaft, way in ((True, 1), (False, -1)):
        limits = side_limits(joint, is_shaft=is_shaft)
        assert limits is not None
        for width in limits.actual:
            found = joint.of_width(width, is_shaft=is_shaft, pin_diameter=2.0)
            thick = replace(joint, thickness=width).measured(0.0, is_shaft=is_shaft, pin_diameter=2.0)
            assert found.over_pins == pytest.approx(thick.over_pins, abs=1e-11)
            assert found.thickness == pytest.approx(width, abs=1e-12)
        # dM / ds = +-cos alpha / sin alpha_M (ISO 4156-3) holds of small steps, not of large ones
        least, most = (joint.of_width(w, is_shaft=is_shaft, pin_diameter=2.0) for w in limits.actual)
        base = 2 * joint.reference_radius * math.cos(joint.pressure_angle)
        aslant = math.cos(math.pi / 2 / joint.teeth) if joint.teeth % 2 else 1.0
        middle = (least.over_pins + most.over_pins) / 2 - way * 2.0
        angle = math.acos(base * aslant / middle)
        slope = aslant * math.cos(joint.pressure_angle) / math.sin(angle)
        assert most.over_pins - least.over_pins == pytest.approx(slope * (most.thickness - least.thickness), rel=1e-3)


def test_effective_limits_of_all_grades_begin_at_the_nominal_width() -> None:
    for grade in (4, 5, 6, 7):
        joint = classed(iso_4156(40, 2.5, 37.5, "fillet"), f"{grade}H", f"{grade}h")
        hub, shaft = (side_limits(joint, is_shaft=one) for one in (False, True))
        assert hub is not None
        assert shaft is not None
        assert hub.effective[0] == shaft.effective[1] == joint.thickness
        # T + lambda of k stands on the nominal width, in whole micrometres
        tight = side_limits(replace(joint, shaft_class=f"{grade}k"), is_shaft=True)
        assert tight is not None
        assert 0 <= tight.actual[0] - joint.thickness < 0.001
    assert side_limits(iso_4156(40, 2.5, 37.5, "fillet"), is_shaft=True) is None


# GOST 6033-80, 11c as a handbook prints it: D, m, z of its columns (m z up to 12, 25, 50, 100), then es, es_e, ei, um;
# 26x1 has m z = 24
PRINTED_11C = (
    ((12, 1, 10), (-48, -85, -148)), ((26, 1, 24), (-54, -95, -166)), ((50, 1, 48), (-60, -105, -185)),
    ((100, 1.5, 65), (-66, -116, -206)), ((25, 2, 11), (-60, -105, -185)), ((50, 2, 24), (-66, -116, -206)),
    ((100, 2, 48), (-75, -135, -235)), ((50, 5, 8), (-75, -135, -235)), ((100, 5, 18), (-84, -152, -264)),
)  # fmt: skip
# cells of the standard's own tables that a scan has left whole, of any column of m up to 1.5, up to 4, above
SCANNED = {
    "8f": ((1.5, (-20, -37, -65)), (1.5, (-25, -45, -81)), (4, (-25, -45, -81)), (4, (-32, -58, -103))),
    "9d": ((1.5, (-40, -63, -103)), (1.5, (-50, -80, -130)), (4, (-40, -63, -103)), (4, (-44, -70, -115)),
           (4, (-56, -90, -146))),
    "10d": ((10, (-56, -101, -181)),), "11c": ((1.5, (-66, -116, -206)),),
}  # fmt: skip


def gost(size: tuple[float, float, int], shaft: str) -> tuple[int, int, int]:
    """es, es_e and ei of a shaft's class, um."""
    made = gost_6033(*size, outer=False, root="flat")
    limits = side_limits(classed(made, "", shaft), is_shaft=True)
    assert limits is not None
    near = limits.effective[1]
    least, most = (round(1000 * (near - x) - 1000 * limits.deviation) for x in (limits.actual[1], limits.actual[0]))
    return round(1000 * limits.deviation), -least, -most


@pytest.mark.parametrize(("size", "printed"), PRINTED_11C)
def test_limits_of_gost_6033_are_those_that_a_handbook_prints(
    size: tuple[float, float, int], printed: tuple[int, int, int]
) -> None:
    assert gost(size, "11c") == printed


@pytest.mark.parametrize("shaft", SCANNED)
def test_limits_of_gost_6033_are_those_of_its_own_tables(shaft: str) -> None:
    for module, printed in SCANNED[shaft]:
        teeth = [math.floor(reference / module) for reference in (12, 25, 50, 100, 200, 400, 500)]
        assert printed in [gost((module * (z + 1.5), module, z), shaft) for z in teeth if z >= 6]

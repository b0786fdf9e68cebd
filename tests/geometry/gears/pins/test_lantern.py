"""Gears for lanterns: swept pins, contact with its negative controls, limits, offsets."""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import OffsetError, ParameterError, PointedTipError
from geometry.base.record import replace
from geometry.gears.pins.contact import DiscMotion, LanternMotion, pin_contact
from geometry.gears.pins.cycloidal import CycloidalDisc
from geometry.gears.pins.lantern import (
    LanternGear,
    checked_lantern_gear,
    lantern_findings,
    lantern_side,
    limits_of,
)
from geometry.gears.teeth.offset import toothed_region
from geometry.plane.distance import Boundary, Verdict
from geometry.plane.measure import profile_area
from geometry.plane.profile import Label
from tests.brute import polygon
from tests.oracles.pin_sweep import lantern_pins, least_distance
from tests.sampling import examples
from tests.strategies import numbers

GEAR = LanternGear(30, 10, 60.0, 8.0)
GEARS = {
    "10 pins, 30 teeth": GEAR,
    "8 pins, 20 teeth": LanternGear(20, 8, 40.0, 6.0),
    "more pins than teeth": LanternGear(6, 20, 80.0, 5.0),
    "100 teeth": LanternGear(100, 12, 60.0, 7.0),
    "deep roots": LanternGear(30, 10, 60.0, 8.0, 0.0, 0.5),
}
EVERY = pytest.mark.parametrize("gear", GEARS.values(), ids=GEARS.keys())


def contact(gear: LanternGear, turn: float = 0.0, shift: float = 0.0, cut: LanternGear | None = None):
    """The contact of a lantern's pins with its gear, or with another one."""
    return pin_contact(lantern_side(cut or gear), LanternMotion(gear, turn, shift))


@pytest.mark.parametrize("phase", [0.0, 0.4, -1.1])
def test_a_body_that_is_turned_on_turns_counter_clockwise_and_its_pins_stand(phase: float) -> None:
    for still, on in (
        (LanternMotion(GEAR), LanternMotion(GEAR, 0.03)),
        (DiscMotion(CycloidalDisc(11, 80.0, 8.0, 2.5)), DiscMotion(CycloidalDisc(11, 80.0, 8.0, 2.5), 0.03)),
    ):
        pins = [m.placement(phase).apply(m.centre(np.array([phase]))[0][0]) for m in (still, on)]
        assert pins[1] == pytest.approx(pins[0], abs=1e-12)
        at, way = ([m.placement(phase).apply(point) for m in (still, on)] for point in (0j, 1 + 0j))
        assert at[1] == pytest.approx(at[0])
        assert (way[1] - at[1]) / (way[0] - at[0]) == pytest.approx(cmath.rect(1.0, 0.03), abs=1e-12)


@pytest.mark.sampled(1)
@EVERY
def test_flanks_are_what_the_swept_pins_leave(gear: LanternGear) -> None:
    """Flanks a pin's radius from the pins' ways to 1e-10 of it, the rest of the tooth no nearer."""
    pin, radius = gear.pin_diameter / 2, gear.pin_circle_diameter / 2
    reach = 1.2 * math.pi
    drive = np.linspace(-reach, reach, 8001)
    centres = lantern_pins(gear.number_of_pins, gear.number_of_teeth, radius)
    # a pin stands in the middle of a space on +x while the drive is 0
    turn = cmath.exp(1j * math.pi / gear.number_of_teeth)
    for segment in lantern_side(gear).segments:
        low, high = segment.curve.domain
        for share in (0.0, 0.3, 0.7, 1.0):
            away = least_distance(complex(segment.curve.point(low + share * (high - low))) * turn, centres, drive) - pin
            assert away >= -1e-10 * pin, (segment.label, share)
            if segment.label is Label.FLANK:
                assert away <= 1e-10 * pin
            elif segment.label is Label.ROOT_FILLET and gear.root_clearance == 0 and share < 1:
                # the pin itself stands in the root
                assert away <= 1e-10 * pin


@pytest.mark.sampled(2)
@EVERY
def test_contact_ratio_by_the_way_of_the_swept_contact(gear: LanternGear) -> None:
    """The lantern's angle between first and last touch of one flank, over its pitch, from dense stands."""
    found = limits_of(gear)
    phases = np.linspace(1e-6, math.pi * 0.9, 40_001)
    points, _ = LanternMotion(gear).centre(phases)
    # the lower flank of the first tooth: pins of positive phase come from its space
    flank = gear.flank(found.start, found.tip)
    moved = points * cmath.exp(-2j * math.pi / gear.number_of_teeth)
    feet = Boundary((flank,)).feet(moved)
    inside = (feet.parameter > found.start) & (feet.parameter < found.tip)
    touching = inside & (np.abs(np.abs(feet.distance) - gear.pin_diameter / 2) < 1e-9)
    swept = np.ptp(phases[touching]) / (2 * math.pi / gear.number_of_pins)
    assert swept == pytest.approx(gear.contact_ratio, abs=2e-3)


@pytest.mark.parametrize("name", ["10 pins, 30 teeth", "8 pins, 20 teeth", "100 teeth"])
def test_pins_touch_without_a_break(name: str) -> None:
    gear = GEARS[name]
    found = contact(gear)
    assert gear.contact_ratio > 1
    assert found.verdict is Verdict.CONTACT
    assert abs(found.worst.gap) <= 1e-12 * gear.pitch_radius
    assert lantern_findings(gear) == ()


def test_an_interrupted_drive_is_told() -> None:
    gear = GEARS["more pins than teeth"]
    assert contact(gear).verdict is Verdict.CLEAR
    assert [f.code for f in lantern_findings(gear)] == ["contact_ratio"]
    # a low root alone is told as the cause: the same gear without it drives on
    cut = LanternGear(30, 12, 80.0, 8.0, root_clearance=3.0)
    assert replace(cut, root_clearance=0.0).contact_ratio > 1
    assert [f.code for f in lantern_findings(cut)] == ["contact_ratio_by_root"]
    assert [f.code for f in lantern_findings(replace(gear, root_clearance=1e-3))] == ["contact_ratio"]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("gear", "greatest"),
    [
        (LanternGear(20, 5, 60.0, 14.117, root_clearance=2.618), 0.08),
        (LanternGear(20, 8, 60.0, 7.232, root_clearance=1.04), 0.003),
    ],
    ids=["deep roots", "between two pins"],
)
def test_the_greatest_gap_is_that_of_pins_about_the_gear(gear: LanternGear, greatest: float) -> None:
    """It was the greatest of 24 drive angles: 8e-6 mm of 0.083, and 0 of 0.0038."""
    teeth = shapely.Polygon(np.column_stack([(p := polygon(lantern_side(gear).profile(), 250)).real, p.imag]))
    shapely.prepare(outline := teeth.exterior)
    pitch = 2 * math.pi / gear.number_of_pins
    drive = pitch * np.arange(600) / 600
    # a pin stands in the middle of a space on +x while the drive is 0
    turn = cmath.exp(-1j * math.pi / gear.number_of_teeth)
    centres = lantern_pins(gear.number_of_pins, gear.number_of_teeth, gear.lantern_radius)
    away = [shapely.distance(outline, shapely.points((p := turn * c(drive)).real, p.imag)) for c in centres]
    seen = float((np.min(away, axis=0) - gear.pin_diameter / 2).max())
    found = contact(gear)
    assert seen > greatest
    assert found.greatest_gap == pytest.approx(seen, rel=0.01)
    assert found.verdict is Verdict.CLEAR
    assert found.greatest_gap == max(found.gaps)


def test_the_contact_check_notices_what_is_wrong() -> None:
    for turn, shift in ((1e-6, 0.0), (-1e-6, 0.0), (0.0, -1e-6)):
        assert contact(GEAR, turn, shift).verdict is Verdict.OVERLAP, (turn, shift)
    assert contact(GEAR, 0.0, 1e-3).verdict is Verdict.CLEAR
    assert contact(GEAR, cut=replace(GEAR, pin_diameter=7.999)).verdict is Verdict.OVERLAP
    assert contact(GEAR, cut=replace(GEAR, pin_diameter=8.001)).verdict is Verdict.CLEAR
    assert contact(GEAR, cut=replace(GEAR, number_of_teeth=31)).verdict is Verdict.OVERLAP
    assert contact(replace(GEAR, pin_clearance=0.1)).worst.gap == pytest.approx(0.1, abs=1e-12)


def test_tips() -> None:
    found = limits_of(GEAR)
    assert GEAR.tip_thickness == pytest.approx(0.1 * GEAR.pitch, rel=1e-12)
    for diameter, kind in (
        (2 * found.pointed_radius + 0.01, PointedTipError),
        (2 * found.start_radius, ParameterError),
    ):
        with pytest.raises(kind) as caught:
            limits_of(replace(GEAR, given_tip_diameter=diameter))
        assert caught.value.name == "tip_diameter"
        cure = caught.value.nearest
        assert cure is not None
        assert isinstance(cure.value, float)
        made = checked_lantern_gear(replace(GEAR, given_tip_diameter=cure.value))
        assert made.tip_radius == cure.value / 2
    with pytest.raises(PointedTipError) as told:
        limits_of(replace(GEAR, given_tip_diameter=2 * found.pointed_radius + 0.01))
    # the very diameter, beside the one that works
    assert told.value.numbers["diameter"] == pytest.approx(2 * found.pointed_radius, rel=1e-12)


gears = st.builds(
    LanternGear,
    st.integers(3, 150),
    st.integers(3, 60),
    numbers(5, 300),
    numbers(0.05, 80),
    st.one_of(st.just(0.0), numbers(0, 2)),
    st.one_of(st.just(0.0), numbers(0, 4)),
    st.one_of(st.none(), numbers(1, 900)),
)


@examples(60)
@given(gears)
def test_any_gear_is_built_or_refused_with_what_works(gear: LanternGear) -> None:
    names = {"tip_diameter": "given_tip_diameter"}
    for _ in range(5):
        try:
            made = checked_lantern_gear(gear)
            break
        except ParameterError as error:
            if error.code == "leaves_no_tooth_with_clearances":
                # no value of one key leaves a tooth, as it says
                gear = replace(gear, pin_clearance=0.0, root_clearance=0.0)
                continue
            if error.nearest is None:
                pytest.fail(f"no remedy: {error}")
            changed: dict[str, Any] = {names.get(error.name, error.name): error.nearest.value}
            gear = replace(gear, **changed)
    else:
        pytest.fail(f"{gear}: every remedy was refused")
    area = profile_area(toothed_region(lantern_side, made).region.outer)
    assert math.pi * made.root_radius**2 < area < math.pi * made.tip_radius**2
    found = contact(made)
    assert found.verdict in (Verdict.CONTACT, Verdict.CLEAR)
    assert found.worst.gap == pytest.approx(made.pin_clearance, abs=1e-9 * made.pin_diameter)


@EVERY
def test_offsets_are_parallel_and_end_where_they_are_told(gear: LanternGear) -> None:
    boundary = Boundary(tuple(s.curve for s in toothed_region(lantern_side, gear).region.outer.segments()), closed=True)
    for offset in (0.2, -0.2):
        moved = toothed_region(lantern_side, gear, offset).region.outer
        points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 7)) for s in moved.period])
        assert np.allclose(boundary.feet(points).distance, offset, rtol=0, atol=1e-10 * gear.pitch_radius)
    for offset in (50.0, -50.0):
        with pytest.raises(OffsetError) as caught:
            toothed_region(lantern_side, gear, offset)
        assert toothed_region(lantern_side, gear, caught.value.nearest_offset)

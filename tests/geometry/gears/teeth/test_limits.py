"""Limits against the oracle's shape and the practicum's numbers; every refusal's remedy is fed back and built."""

from __future__ import annotations

import json
import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.angles import involute_function
from geometry.base.errors import GeometryError, ParameterError, PointedTipError
from geometry.base.record import replace
from geometry.gears.teeth import limits, ring_limits
from geometry.gears.teeth.basic_rack import (
    ISO_53,
    BasicRack,
    TipRelief,
    checked_rack,
    default_tip_radius,
    full_round_radius,
    iso_53,
)
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.limits import checked_gear
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.gears.teeth.transverse import transverse_gear
from tests import brute
from tests.oracles import exact_gear, rack_sweep
from tests.sampling import examples
from tests.strategies import gears, hostile_gears, hostile_racks, numbers

PRACTICUM = json.loads((Path(__file__).parents[3] / "published" / "practicum_gear_geometry.json").read_text("utf-8"))
WHEELS = PRACTICUM["lesson_3"]["wheels"]
FIELD = {"tip_diameter": "given_tip_diameter"}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("degrees", [14.5, 20.0, 25.0])
@pytest.mark.parametrize("name", sorted(ISO_53))
@pytest.mark.parametrize("teeth", [5, 19])
def test_undercut_limit_against_the_shape(name: str, degrees: float, teeth: int) -> None:
    """x_min is where the envelope of the straight flank stops running back: bisection on its first step."""
    rack = iso_53(name, math.radians(degrees))
    alpha = exact_gear.MP.mpf(rack.pressure_angle)
    shape = exact_gear.undercut_limit_shift(teeth, alpha, rack.dedendum, rack.tip_radius)
    assert abs(limits.least_shift_without_undercut(SpurGear(1.0, teeth, rack)) - float(shape)) <= 1e-13


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", sorted(ISO_53))
def test_undercut_is_seen_on_both_sides_of_the_limit(name: str) -> None:
    rack = iso_53(name)
    least = limits.least_shift_without_undercut(SpurGear(1.0, 12, rack))
    for step, cut in ((1e-6, False), (-1e-6, True)):
        gear = SpurGear(1.0, 12, rack, least + step)
        assert (limits.undercut(gear).margin < 0) == cut
        assert exact_gear.junction(brute.exact_parameters(gear)).undercut == cut
        assert ("undercut" in {f.code for f in limits.findings(gear)}) == cut


def test_a_deeper_cut_undercuts_sooner() -> None:
    """Thinning by feeding the rack in lowers the generating shift, and only that counts."""
    least = limits.least_shift_without_undercut(SpurGear(2.0, 12, iso_53()))
    wide = SpurGear(2.0, 12, iso_53(), least + 0.01, circumferential_thinning=0.1)
    deep = replace(wide, thinning_by_deeper_cut=True)
    assert limits.undercut(wide).margin == pytest.approx(0.01, rel=1e-9)
    assert limits.undercut(deep).margin == pytest.approx(0.01 - 0.1 / (4 * math.tan(math.radians(20))), rel=1e-9)
    assert exact_gear.junction(brute.exact_parameters(deep)).undercut


@pytest.mark.parametrize("case", PRACTICUM["least_shift"]["cases"], ids=lambda c: f"z{c['z']}")
def test_least_shift_of_the_practicum(case: dict[str, float]) -> None:
    gear = SpurGear(10.0, int(case["z"]), iso_53())
    assert limits.practicum_undercut(gear).limit == pytest.approx(case["xi_formula_1_2"], rel=1e-14)
    # the practicum's exact figure takes h_a*; a rounded tip ends its straight flank at h_Ff (theory note A6)
    sharp = replace(gear, rack=BasicRack(math.radians(20), 1.0, 0.0, 0.0))
    assert limits.least_shift_without_undercut(sharp) == pytest.approx(case["xi_exact"], rel=1e-13)
    printed = PRACTICUM["rack_fillet"]["printed"] - PRACTICUM["rack_fillet"]["recomputed"]
    assert abs(limits.least_shift_without_undercut(gear) - case["xi_exact"]) <= printed


@pytest.mark.parametrize(("degrees", "height", "teeth"), [(20, 1, 17), (20, 0.8, 14), (14.5, 1, 32), (25, 1, 11)])
def test_least_teeth_of_textbooks(degrees: float, height: float, teeth: int) -> None:
    """Numbers that every textbook gives of sharp racks; from them on the rule asks for no shift."""
    gear = SpurGear(1.0, teeth, BasicRack(math.radians(degrees), height, 0.25, 0.25))
    assert limits.rule_teeth(gear) == teeth
    assert limits.practicum_undercut(gear).limit == 0
    assert limits.practicum_undercut(replace(gear, number_of_teeth=teeth - 1)).limit == pytest.approx(height / teeth)


def test_undercut_of_helical_teeth_is_told_in_normal_modules() -> None:
    """As their key is: at the limit that is told the remark ends."""
    normal, helix = SpurGear(2.0, 9, iso_53(), 0.1), math.radians(25)
    (found,) = limits.findings(transverse_gear(normal, helix), helix)
    assert found.value == pytest.approx(0.1)
    for step, codes in ((-1e-9, ["undercut"]), (1e-9, [])):
        section = transverse_gear(replace(normal, profile_shift_coefficient=found.limit + step), helix)
        assert [f.code for f in limits.findings(section, helix) if f.code == "undercut"] == codes


def test_least_number_of_teeth_and_fillet_of_the_practicum() -> None:
    least = PRACTICUM["least_number_of_teeth"]
    sharp = BasicRack(math.radians(20), 1.0, 0.0, 0.0)
    assert limits.undercut(SpurGear(1.0, least["printed"], sharp)).margin < 0
    assert limits.undercut(SpurGear(1.0, least["printed"] + 1, sharp)).margin > 0
    zero = limits.least_shift_without_undercut(SpurGear(1.0, 1, sharp)) - limits.least_shift_without_undercut(
        SpurGear(1.0, 2, sharp)
    )
    assert 1 / zero == pytest.approx(least["recomputed"], rel=1e-12)
    fillet = PRACTICUM["rack_fillet"]
    assert default_tip_radius(math.radians(20), 1.0, 0.25, 1.0) == pytest.approx(fillet["recomputed"], rel=1e-14)
    assert round(fillet["recomputed"], 2) == fillet["printed"] == ISO_53["A"][2]


@pytest.mark.parametrize("case", PRACTICUM["sample_wheels"]["cases"], ids=lambda c: f"z{c['z']}")
def test_sample_wheels_of_the_practicum(case: dict[str, float]) -> None:
    gear = SpurGear(case["m"], int(case["z"]), iso_53())
    assert 2 * gear.reference_radius == case["d"]
    assert 2 * gear.base_radius == pytest.approx(case["d_b"], rel=1e-14)
    assert gear.pitch_angle * gear.reference_radius == pytest.approx(case["P_t"], rel=1e-14)
    assert gear.reference_thickness == pytest.approx(case["S_t_zero"], rel=1e-14)
    shifted = replace(gear, profile_shift_coefficient=case["xi"])
    assert shifted.reference_thickness == pytest.approx(case["S_t_shifted"], rel=1e-14)


@pytest.mark.parametrize("wheel", WHEELS, ids=lambda w: f"z{w['z']}")
def test_lesson_three_of_the_practicum(wheel: dict) -> None:
    """Recomputed numbers to rounding; printed ones to half a unit of their last digit unless a misprint is named."""
    m = PRACTICUM["lesson_3"]["module"]
    x = wheel["xi"]
    tip = (wheel["z"] / 2 + 1 + x - PRACTICUM["lesson_3"]["dy"]) * m
    gear = SpurGear(m, wheel["z"], iso_53(), x, given_tip_diameter=2 * tip)
    found = {
        "r": gear.reference_radius,
        "r_b": gear.base_radius,
        "r_a": gear.tip_radius,
        "r_f": gear.root_radius,
        "S": gear.reference_thickness,
        "alpha_a_deg": math.degrees(math.acos(gear.base_radius / gear.tip_radius)),
    }
    for key, value in found.items():
        assert value == pytest.approx(wheel[key], rel=1e-13), key
        agrees = abs(value - wheel["printed"][key]) <= 0.005 + 1e-12
        assert agrees == (key not in wheel["misprinted"] and key not in wheel["cut_off"]), key
        assert abs(value - wheel["printed"][key]) <= 0.021
    # the practicum's reading names no shortening for S_a: full tip circle less Dy m is what was printed as r_a
    exact = float(exact_gear.tip_thickness(brute.exact_parameters(gear)))
    assert limits.tip_thickness(gear) == pytest.approx(exact, rel=1e-13)
    assert limits.tip_thickness(gear) / m == pytest.approx(wheel["S_a_over_m"], rel=1e-12)
    assert limits.thin_tip(gear).margin > 0


def test_involute_and_thin_tip_of_the_practicum() -> None:
    data = PRACTICUM["involute"]
    assert involute_function(math.radians(20)) == pytest.approx(data["recomputed"], rel=1e-14)
    assert abs(data["recomputed"] - data["printed"]) <= 0.5e-6
    assert PRACTICUM["least_tip_thickness"]["printed"] == limits.LEAST_TIP_THICKNESS


@examples(20)
@given(gears())
def test_diameters_of_any_gear(gear: SpurGear) -> None:
    """Form diameter and tip thickness as the oracle's shape has them; just below the pointed diameter it builds."""
    parameters = brute.exact_parameters(gear)
    near_limit = abs(limits.undercut(gear).margin) < 1e-4
    form = 2 * abs(complex(exact_gear.junction(parameters).point))
    assert limits.root_form_diameter(gear) == pytest.approx(form, rel=1e-7 if near_limit else 1e-12)
    thickness = float(exact_gear.tip_thickness(parameters))
    assert abs(limits.tip_thickness(gear) - thickness) <= 1e-12 * gear.tip_radius
    pointed = limits.pointed_diameter(gear)
    assert pointed > 2 * gear.tip_radius
    tooth_side(replace(gear, given_tip_diameter=pointed * (1 - 1e-9)))
    with pytest.raises(PointedTipError):
        tooth_side(replace(gear, given_tip_diameter=pointed * (1 + 1e-9)))


@pytest.mark.parametrize("degrees", [14.5, 20.0, 25.0, 30.0])
def test_full_round_is_where_both_roundings_meet(degrees: float) -> None:
    """The swept tool refuses a larger one, and the largest leaves no root land."""
    alpha = math.radians(degrees)
    largest = full_round_radius(alpha, 1.25)
    rack_sweep.RackTool(1.0, alpha, 1.0, 0.25, largest, 0.0)
    with pytest.raises(ValueError, match="does not fit"):
        rack_sweep.RackTool(1.0, alpha, 1.0, 0.25, largest + 1e-9, 0.0)
    gear = SpurGear(1.0, 40, checked_rack(BasicRack(alpha, 1.0, 0.25, largest)))
    assert gear.root_land_half_angle <= 1e-15
    assert gear.rounding_radius == largest


REFUSED = {
    "pointed by shift": SpurGear(2.0, 12, iso_53(), 1.2),
    "pointed by tip": SpurGear(2.0, 23, iso_53(), given_tip_diameter=60.0),
    "tip below form": SpurGear(2.0, 23, iso_53(), given_tip_diameter=42.0),
    "undercut away": SpurGear(2.0, 5, iso_53(), -0.6),
    "thinned away": SpurGear(2.0, 23, iso_53(), circumferential_thinning=3.2),
    "thinned away deeply": SpurGear(2.0, 23, iso_53(), circumferential_thinning=3.2, thinning_by_deeper_cut=True),
    "chamfer": SpurGear(2.0, 23, iso_53(), tip_chamfer=2.5),
    "rounding": SpurGear(2.0, 23, iso_53(), tip_rounding=1.5),
    "rounding, small module": SpurGear(0.1, 23, iso_53(), tip_rounding=0.5),
    "bore": SpurGear(2.0, 23, iso_53(), bore_diameter=41.5),
    "bore beyond the tip": SpurGear(2.0, 23, iso_53(), bore_diameter=500.0),
    "root beyond the axis": SpurGear(1.0, 3, iso_53(), -0.5),
    "three teeth pointed": SpurGear(1.0, 3, iso_53(), 0.5),
    "small module": SpurGear(0.1, 10, iso_53(), 1.2),
    "large module": SpurGear(50.0, 8, iso_53(), 1.0),
    "narrow angle": SpurGear(1.0, 10, iso_53("B", math.radians(14.5)), -0.9),
}


@pytest.mark.parametrize("gear", REFUSED.values(), ids=REFUSED.keys())
def test_a_refusal_names_a_value_that_works(gear: SpurGear) -> None:
    with pytest.raises(ParameterError) as caught:
        checked_gear(gear)
    error = caught.value
    field = FIELD.get(error.name, error.name)
    assert getattr(gear, field) == error.value
    assert str(error).startswith(f"{error.name} = ")
    value = brute.works(error)
    if field == "number_of_teeth":
        assert checked_gear(replace(gear, number_of_teeth=value))
        assert isinstance(brute.refusal(lambda: checked_gear(replace(gear, number_of_teeth=value - 1))), ParameterError)
        return
    assert checked_gear(replace(gear, **{field: value}))
    assert (value - error.value) != 0
    # nearest: two units of the last printed place back towards what was asked are refused again
    nearer = value + math.copysign(2e-4, error.value - value)
    with pytest.raises(ParameterError):
        checked_gear(replace(gear, **{field: nearer}))


def test_a_chamfer_flatter_than_the_flank_is_offered_none() -> None:
    """Where the flank leans more than 45 degrees at the tip no such chamfer reaches it; 5.8e-12 mm was offered."""
    gear = SpurGear(1.0, 9, iso_53("B"), 0.6, tip_chamfer=0.08)
    # of the flank against the radius through the chamfer's foot
    assert math.acos(gear.base_radius / (gear.tip_radius - 0.08)) > math.radians(45)
    with pytest.raises(ParameterError) as refused:
        checked_gear(gear)
    assert refused.value.name == "tip_chamfer"
    assert refused.value.nearest is not None
    assert refused.value.nearest.value == 0.0


@pytest.mark.sampled(2)
@pytest.mark.parametrize("x", [-1.862, -1.9, -2.2])
def test_a_helical_gear_whose_fillet_takes_all_of_the_flank_is_refused(x: float) -> None:
    """Fillet and flank have no point in common: that the search for one found none was a traceback."""
    gear = SpurGear(8.0, 7, BasicRack(math.radians(10), 1.0, 0.25, 0.38), x)
    with pytest.raises(ParameterError) as refused:
        checked_gear(gear, math.radians(12))
    assert refused.value.name == "profile_shift_coefficient"
    assert refused.value.nearest is not None
    checked_gear(replace(gear, profile_shift_coefficient=refused.value.nearest.value), math.radians(12))


def test_a_refusal_finds_the_key_that_can_help() -> None:
    """Pointed at every shift within reach, but sound with a smaller tip diameter: some value that works is named."""
    gear = SpurGear(1.0, 3, iso_53("A", math.radians(30)), 1.2885, circumferential_thinning=0.254)
    assert checked_gear(replace(gear, given_tip_diameter=5.9))
    error = brute.refusal(lambda: checked_gear(gear))
    assert isinstance(error, ParameterError)
    changed = {FIELD.get(error.name, error.name): brute.works(error)}
    assert brute.refusal(lambda: checked_gear(replace(gear, **changed))) is None


RACKS = {
    "rounding": BasicRack(math.radians(20), 1.0, 0.25, 0.6),
    "rounding at 30 degrees": BasicRack(math.radians(30), 1.0, 0.25, 0.38),
    "clearance": BasicRack(math.radians(30), 1.0, 0.5, 0.0),
    "addendum": BasicRack(math.radians(30), 1.5, 0.0, 0.0),
    "addendum at 45 degrees": BasicRack(math.radians(45), 1.0, 0.25, 0.38),
    "relief too high": BasicRack(math.radians(20), 1.0, 0.25, 0.38, TipRelief(0.02, 1.2)),
    "relief too deep": BasicRack(math.radians(20), 1.0, 0.25, 0.38, TipRelief(0.5, 0.45)),
}


@pytest.mark.parametrize("rack", RACKS.values(), ids=RACKS.keys())
def test_a_refused_rack_names_a_value_that_works(rack: BasicRack) -> None:
    with pytest.raises(ParameterError) as caught:
        checked_rack(rack)
    name, value = caught.value.name, brute.works(caught.value)
    section, field = name.split(".")
    if section == "relief":
        assert rack.relief is not None
        changed = replace(rack, relief=replace(rack.relief, **{field: value}))
    else:
        changed = replace(rack, **{field: value})
    again = brute.refusal(lambda: checked_rack(changed))
    # a rack tooth that now reaches its tip line may still be too narrow for the rounding: another key
    assert again is None or (isinstance(again, ParameterError) and again.name != name)


@examples(150)
@given(hostile_gears())
def test_hostile_gears_are_refused_or_built_whole(gear: SpurGear) -> None:
    """Nothing but a GeometryError leaves; what is built has finite points and the oracle's shape."""
    try:
        checked_gear(gear)
        profile = tooth_side(gear).profile()
    except GeometryError:
        return
    points = brute.period_points(profile, 9)
    assert profile.count == gear.number_of_teeth >= 1
    assert gear.module > 0
    assert all(math.isfinite(abs(p)) for p in points)
    lengths = (gear.tip_chamfer, gear.tip_rounding, gear.bore_diameter, gear.circumferential_thinning)
    numbers_given = (gear.module, gear.profile_shift_coefficient, *lengths)
    assert all(math.isfinite(v) for v in numbers_given), "survived, not refused"
    assert min(lengths[:3]) >= 0, "a negative length survived"


@examples(100)
@given(hostile_racks())
def test_hostile_racks_are_refused_or_sound(rack: BasicRack) -> None:
    try:
        checked_rack(rack)
    except GeometryError:
        return
    values = (rack.pressure_angle, rack.addendum, rack.tip_clearance, rack.tip_radius)
    assert all(math.isfinite(v) for v in values)
    assert 0 < rack.pressure_angle < math.pi / 2
    assert rack.tip_radius >= 0
    assert rack.dedendum > 0


@examples(40)
@given(numbers(-0.6, 1.6), st.integers(3, 60), numbers(14.5, 30), st.sampled_from(sorted(ISO_53)))
def test_any_refusal_by_shift_is_cured_by_its_remedy(x: float, teeth: int, degrees: float, name: str) -> None:
    if brute.refusal(lambda: iso_53(name, math.radians(degrees))):
        return
    gear = SpurGear(1.0, teeth, iso_53(name, math.radians(degrees)), x)
    error = brute.refusal(lambda: checked_gear(gear))
    if error is None:
        assert limits.pointed_tip(gear).margin > 0
        return
    assert isinstance(error, ParameterError)
    assert error.name in ("profile_shift_coefficient", "number_of_teeth")
    assert checked_gear(replace(gear, **{error.name: brute.works(error)}))


def test_where_neither_shift_nor_tip_cures_more_teeth_do() -> None:
    """One tooth: refused with the least number above it that can be built."""
    gear = SpurGear(5.0, 1, BasicRack(math.radians(20), 0.7929, 0.3158, 0.0103), -1.5625)
    with pytest.raises(ParameterError) as caught:
        checked_gear(gear)
    assert (caught.value.name, caught.value.value, caught.value.code) == ("number_of_teeth", 1, "leaves_no_flank")
    cure = caught.value.nearest
    assert cure is not None
    assert cure.side == "at_least"
    checked_gear(replace(gear, number_of_teeth=int(cure.value)))
    with pytest.raises(ParameterError):
        tooth_side(replace(gear, number_of_teeth=int(cure.value) - 1))


def test_a_rim_thinner_than_a_module_is_told() -> None:
    """m 2, z 20 of profile A: the root circle is 20 - 1.25 * 2 = 17.5 mm, so a bore of 31 mm leaves one module."""
    for bore, told in ((30.998, False), (31.002, True), (0.0, False)):
        found = [f for f in limits.findings(SpurGear(2.0, 20, iso_53("A"), bore_diameter=bore)) if f.code == "thin_rim"]
        assert [(f.value, f.limit) for f in found] == ([(pytest.approx(17.5 - bore / 2), 2.0)] if told else [])


def test_a_rim_of_one_module_is_not_thin_by_rounding() -> None:
    """7 mm and 26 mm less 6.2 and 26.8 mm: 0.7999999999999998 mm were told to be less than 0.800 mm."""
    assert not limits.findings(SpurGear(0.8, 20, iso_53("A"), bore_diameter=12.4))
    assert not ring_limits.findings(RingGear(0.8, 63, math.radians(20), 54.0, PinionCutter(0.8, 20, math.radians(20))))

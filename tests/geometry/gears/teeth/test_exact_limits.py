"""Refusals of cutters, of shaped gears and of measured sizes: from which value on, by closed forms."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import replace
from geometry.gears.teeth import measurement as m
from geometry.gears.teeth.basic_rack import BasicRack, TipRelief, checked_rack, default_tip_radius, iso_53
from geometry.gears.teeth.cutter import PinionCutter, checked_cutter, cutting_angle, full_round
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.shaping import check_shaping
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear
from tests.brute import works

ALPHA = math.radians(20.0)
COS, TAN, SIN = math.cos(ALPHA), math.tan(ALPHA), math.sin(ALPHA)
INV = TAN - ALPHA
CUTTER = PinionCutter(2.0, 25, ALPHA)


def flank_angle(cutter: PinionCutter, radius: float) -> float:
    """Half of a cutter tooth's angle on a circle: that on the reference circle, less the involutes between."""
    reference = cutter.module * cutter.number_of_teeth / 2
    x = cutter.profile_shift_coefficient
    half = (math.pi / 4 + x * TAN) * cutter.module / reference + cutter.widening / reference
    angle = math.acos(reference * COS / radius)
    return half + INV - (math.tan(angle) - angle)


def bisected(function: Callable[[float], float], low: float, high: float) -> float:
    """Where a falling function is 0."""
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) > 0 else (low, middle)
    return (low + high) / 2


# addendum at which a tooth is pointed, z 25, m 2, x 0
POINTED = bisected(lambda h: flank_angle(CUTTER, 25 + 2 * h), 0.5, 4.0)


@pytest.mark.parametrize(
    ("key", "limit", "side", "code", "given"),
    [
        # the base circle: r_b - r = m z / 2 (cos 20 - 1)
        ("addendum", 25 * (COS - 1) / 2 + 1.0, 1, "cutter_tip_below_base", {"profile_shift_coefficient": -1.0}),
        ("addendum", POINTED, -1, "cutter_tooth_pointed", {"tip_rounding": 0.0}),
    ],
)
def test_cutters_are_refused_from_a_limit_on(
    key: str, limit: float, side: int, code: str, given: dict[str, float]
) -> None:
    made = replace(CUTTER, tip_rounding=0.0, **{k: v for k, v in given.items() if k != "tip_rounding"})
    with pytest.raises(ParameterError) as refused:
        checked_cutter(replace(made, **{key: limit - side * 1e-3}))
    assert (refused.value.name, refused.value.code) == (f"cutter.{key}", code)
    assert 0 <= (works(refused.value) - limit) * side < 2.1e-4
    checked_cutter(replace(made, **{key: works(refused.value)}))


def test_the_largest_rounding_touches_both_flanks_and_the_tip() -> None:
    """Its centre on the tooth's middle, a radius below the tip, stands that far from the flank along its normal."""
    for x, h, wide in ((0.0, 1.25, 0.0), (0.3, 1.25, 0.1), (-0.2, 1.4, 0.0)):
        cutter = PinionCutter(2.0, 25, ALPHA, x, h, 0.2, wide)
        rho = full_round(cutter).tip_rounding
        assert rho == cutter.largest_rounding()
        base, tip = 25 * COS, 25 + 2 * (h + x)
        centre = tip - 2 * rho
        # the involute moved into the tooth by rho is turned by rho / r_b on the base circle
        angle = math.acos(base / centre)
        half = (math.pi / 4 + x * TAN) * 2 / 25 + wide / 25 + INV
        assert half - 2 * rho / base - (math.tan(angle) - angle) == pytest.approx(0.0, abs=1e-12)
        with pytest.raises(ParameterError) as refused:
            checked_cutter(replace(cutter, tip_rounding=rho + 1e-3))
        assert (refused.value.name, refused.value.code) == ("cutter.tip_rounding", "cutter_rounding_does_not_fit")
        assert 0 <= rho - works(refused.value) < 1.01e-4
        checked_cutter(replace(cutter, tip_rounding=rho))
    # a tooth that is pointed below its tip has none
    assert PinionCutter(2.0, 25, ALPHA, 0.0, POINTED + 0.01).largest_rounding() == 0.0
    # one as low as its base circle begins there: all of its height
    low = PinionCutter(2.0, 100, ALPHA, 0.0, 0.3)
    assert low.largest_rounding() <= (low.tip_radius - low.base_radius) / 2


@pytest.mark.parametrize(
    ("changed", "name", "code", "nearest"),
    [
        ({"number_of_teeth": 2}, "cutter.number_of_teeth", "no_such_cutter_teeth", Nearest(3, "at_least")),
        ({"number_of_teeth": 10_001}, "cutter.number_of_teeth", "no_such_cutter_teeth", Nearest(10_000, "at_most")),
        ({"pressure_angle": 0.0}, "pressure_angle", "not_below_right_angle", None),
        ({"pressure_angle": math.pi / 2}, "pressure_angle", "not_below_right_angle", None),
        ({"module": 0.0}, "module", "not_finite_above_zero", None),
        ({"module": math.inf}, "module", "not_finite_above_zero", None),
        ({"profile_shift_coefficient": math.nan}, "cutter.profile_shift_coefficient", "not_finite", Nearest(0.0)),
        ({"addendum": -0.1}, "cutter.addendum", "not_finite_or_negative", None),
        ({"tip_rounding": math.inf}, "cutter.tip_rounding", "not_finite_or_negative", None),
    ],
)
def test_what_is_no_cutter(changed: dict[str, float], name: str, code: str, nearest: Nearest | None) -> None:
    with pytest.raises(ParameterError) as refused:
        checked_cutter(replace(CUTTER, **changed))  # type: ignore[arg-type]
    assert (refused.value.name, refused.value.code, refused.value.nearest) == (name, code, nearest)
    for teeth in (3, 10_000):
        few = PinionCutter(2.0, teeth, math.radians(30), addendum=0.4, tip_rounding=0.0)
        assert checked_cutter(few).number_of_teeth == teeth


def test_a_cut_has_its_angle_down_to_nothing() -> None:
    """inv(alpha_w0) = inv(alpha) + 2 x tan(alpha) / z; below 0 the larger of both shifts is told where it is 0."""
    teeth = 48
    angle = cutting_angle(ALPHA, 0.4, teeth, 0.4, 0.0)
    assert math.tan(angle) - angle == pytest.approx(INV + 0.8 * TAN / teeth, rel=1e-12)
    least = -INV * teeth / (2 * TAN)
    assert cutting_angle(ALPHA, least * (1 - 1e-9), teeth, 0.0, 0.0) == pytest.approx(0.0, abs=2e-3)
    for own, other, name in ((least - 0.1, 0.0, "profile_shift_coefficient"),
                             (0.0, least - 0.1, "cutter.profile_shift_coefficient")):  # fmt: skip
        with pytest.raises(ParameterError) as refused:
            cutting_angle(ALPHA, own + other, teeth, own, other)
        assert (refused.value.name, refused.value.code) == (name, "no_working_angle_with_cutter")
        assert works(refused.value) == pytest.approx(least, abs=1.01e-4)
        assert works(refused.value) >= least
    # of a ring the cutter's shift counts the other way
    with pytest.raises(ParameterError) as refused:
        cutting_angle(ALPHA, 0.0 - 1.0, 35, 0.0, 1.0)
    most = INV * 35 / (2 * TAN)
    assert works(refused.value) == pytest.approx(most, abs=1.01e-4)


def test_a_cutter_reaches_as_far_as_its_line_of_action() -> None:
    """Its involute ends at r_b0: the gear's at hypot(r_b, a sin(alpha_w0))."""
    gear = SpurGear(2.0, 60, BasicRack(ALPHA, 1.0, 0.25, 0.2), cutter=PinionCutter(2.0, 12, ALPHA, tip_rounding=0.0))
    # no shifts: both roll on their reference circles
    most = math.hypot(60 * COS, 72 * SIN)
    check_shaping(replace(gear, given_tip_diameter=2 * most - 1e-6))
    with pytest.raises(ParameterError) as refused:
        check_shaping(replace(gear, given_tip_diameter=2 * most + 1e-3))
    assert (refused.value.name, refused.value.code) == ("tip_diameter", "cutter_involute_ends_below_tip")
    assert refused.value.value == pytest.approx(2 * most + 1e-3)
    assert 0 <= 2 * most - works(refused.value) < 1.01e-4
    gear = replace(gear, given_tip_diameter=2 * most - 1.0)
    for changed, name, nearest in (
        (replace(gear, cutter=PinionCutter(2.5, 12, ALPHA, tip_rounding=0.0)), "cutter.module", Nearest(2.0)),
        (replace(gear, cutter=PinionCutter(2.0, 12, 0.3, tip_rounding=0.0)), "cutter.pressure_angle", Nearest(ALPHA)),
        (replace(gear, rack=replace(gear.rack, relief=TipRelief(0.01))), "relief.depth", Nearest(0.0)),
    ):
        with pytest.raises(ParameterError) as refused:
            check_shaping(changed)
        assert (refused.value.name, refused.value.nearest) == (name, nearest)
    check_shaping(replace(gear, rack=replace(gear.rack, relief=TipRelief(0.0))))


# --- the basic rack


@pytest.mark.parametrize("degrees", [15.0, 20.0, 25.0])
def test_a_rack_is_refused_from_a_limit_on(degrees: float) -> None:
    """Pointed where (h_a + c) tan reaches pi / 4; roundings meet on the middle; relieved flanks at the tip line."""
    alpha = math.radians(degrees)
    tan, cos, sin = math.tan(alpha), math.cos(alpha), math.sin(alpha)
    height = math.pi / 4 / tan
    for addendum, clearance, key, limit in ((1.0, height - 1.0 + 1e-3, "tip_clearance", height - 1.0),
                                            (height + 1e-3, 0.0, "addendum", height),
                                            (height + 1.0, 0.25, "addendum", height - 0.25)):  # fmt: skip
        with pytest.raises(ParameterError) as refused:
            checked_rack(BasicRack(alpha, addendum, clearance, 0.0))
        assert (refused.value.name, refused.value.code) == (f"rack.{key}", "rack_pointed")
        assert 0 <= limit - works(refused.value) < 1.01e-4
        assert refused.value.numbers == {"angle": pytest.approx(degrees)}
    largest = (math.pi / 4 - 1.25 * tan) * cos / (1 - sin)
    checked_rack(BasicRack(alpha, 1.0, 0.25, largest))
    with pytest.raises(ParameterError) as refused:
        checked_rack(BasicRack(alpha, 1.0, 0.25, largest + 1e-6))
    assert (refused.value.name, refused.value.code) == ("rack.tip_radius", "rack_rounding_does_not_fit")
    assert 0 <= largest - works(refused.value) < 1.01e-4
    depth = (math.pi / 4 - tan) * cos
    rack = BasicRack(alpha, 1.0, 0.25, 0.1)
    checked_rack(replace(rack, relief=TipRelief(depth * (1 - 1e-9), 1.0)))
    for relief, key, code, offered in (
        (TipRelief(depth, 0.4), "relief.depth", "relieved_flanks_meet", depth),
        (TipRelief(-0.01, 0.4), "relief.depth", "relieved_flanks_meet", depth),
        (TipRelief(0.02, 1.001), "relief.height", "relief_beyond_addendum", 1.0),
    ):
        with pytest.raises(ParameterError) as refused:
            checked_rack(replace(rack, relief=relief))
        assert (refused.value.name, refused.value.code) == (key, code)
        assert 0 <= offered - works(refused.value) < 1.01e-4
    with pytest.raises(ParameterError) as refused:
        checked_rack(replace(rack, relief=TipRelief(0.02, 0.0)))
    assert (refused.value.code, refused.value.nearest) == ("relief_beyond_addendum", None)
    # the usual rounding: the table's, what the clearance takes, the full round
    assert default_tip_radius(alpha, 1.0, 0.25, 0.05) == 0.05
    assert default_tip_radius(alpha, 1.0, 0.1, 9.0) == pytest.approx(min(0.1 / (1 - sin), (math.pi / 4 - 1.1 * tan)
                                                                         * cos / (1 - sin)))  # fmt: skip
    assert default_tip_radius(alpha, height, 0.5, 0.3) == 0.0


@pytest.mark.parametrize(("name", "values"), [("A", (1.0, 0.25, 0.38)), ("B", (1.0, 0.25, 0.30)),
                                              ("C", (1.0, 0.25, 0.25)), ("D", (1.0, 0.40, 0.39))])  # fmt: skip
def test_the_racks_of_iso_53(name: str, values: tuple[float, float, float]) -> None:
    """ISO 53:1998, table 1: addendum, clearance and root radius of the basic rack, in modules."""
    rack = iso_53(name)
    assert (rack.addendum, rack.tip_clearance, rack.tip_radius) == values
    assert rack.pressure_angle == ALPHA
    assert rack.dedendum == values[0] + values[1]
    assert rack.form_dedendum == pytest.approx(rack.dedendum - values[2] * (1 - SIN))
    assert rack.rounding_half_distance == pytest.approx(
        max(math.pi / 4 - (rack.dedendum - values[2]) * TAN - values[2] / COS, 0.0))  # fmt: skip


# --- measured sizes


GEAR = SpurGear(2.0, 23, iso_53(), 0.2)
RING = RingGear(2.0, 60, ALPHA, 200.0, RoundedRoot(), 0.3)


def test_circles_inside_the_base_circle_have_no_flank() -> None:
    for gear in (GEAR, RING):
        for ask in (m.thickness_at, m.pin_touching_at):
            if ask is m.pin_touching_at and gear is RING:
                # between the tangents at the base circle its space is wider than any pin in front of the axis
                with pytest.raises(ParameterError) as refused:
                    ask(gear, gear.base_radius * (1 + 1e-9))
                assert (refused.value.name, refused.value.code) == ("pin_diameter", "no_pin_touches_there")
                assert refused.value.value == pytest.approx(2 * gear.base_radius)
            else:
                ask(gear, gear.base_radius * (1 + 1e-9))
            with pytest.raises(ParameterError) as refused:
                ask(gear, gear.base_radius - 1e-3)
            assert (refused.value.name, refused.value.code) == ("diameter", "inside_base_circle")
            assert refused.value.value == pytest.approx(2 * gear.base_radius - 2e-3)
            assert 0 <= works(refused.value) - 2 * gear.base_radius < 1.01e-4


def test_spans_go_over_one_tooth_to_all() -> None:
    for gear, key in ((GEAR, "teeth_spanned"), (RING, "spaces_spanned")):
        z = gear.number_of_teeth
        for teeth, nearest in ((0, Nearest(1, "at_least")), (z + 1, Nearest(z, "at_most"))):
            with pytest.raises(ParameterError) as refused:
                m.span(gear, teeth)
            assert (refused.value.name, refused.value.nearest) == (key, nearest)
            assert refused.value.numbers == {"teeth": z}
        step = m.span(gear, 3).length - m.span(gear, 2).length
        # a base pitch on
        assert step == pytest.approx(math.pi * 2.0 * COS)
        assert m.span(gear, z).teeth == z
        assert m.span(gear, 1).length == pytest.approx(m.base_thickness(gear))
        full = m.span(gear, 4).length
        sense = gear.sign
        with pytest.raises(ParameterError) as refused:
            m.gear_with_span(gear, 4, full + sense * 0.01)
        assert refused.value.code == ("above_nominal" if sense > 0 else "below_nominal")
        assert works(refused.value) == pytest.approx(full, abs=1.01e-4)
        thinned = m.gear_with_span(gear, 4, full - sense * 0.05)
        assert thinned.circumferential_thinning == pytest.approx(0.05 / COS)


def test_faces_of_a_calliper_want_a_width() -> None:
    """W sin(beta_b), and b_M = 1.2 + 0.018 W (DIN 3960) in contact on either side of it."""
    helix = math.radians(18)
    gear = transverse_gear(GEAR, helix)
    beta_b = math.asin(math.sin(helix) * COS)
    found = m.span(gear, 3, helix)
    assert found.least_face_width == pytest.approx(found.length * math.sin(beta_b), rel=1e-12)
    secure = found.length * math.sin(beta_b) + (1.2 + 0.018 * found.length) * math.cos(beta_b)
    assert found.secure_face_width == pytest.approx(secure, rel=1e-12)
    assert m.span(gear, 3, -helix).secure_face_width == pytest.approx(secure, rel=1e-12)


@pytest.mark.parametrize("z", [22, 23])
def test_a_pin_falls_through_or_its_centre_comes_to_the_base_circle(z: int) -> None:
    """D = 2 r_b eta: half of the space's angle on the base circle."""
    for gear in (replace(GEAR, number_of_teeth=z), replace(RING, number_of_teeth=z + 40)):
        space = gear.base_half_angle if gear is not GEAR and isinstance(gear, RingGear) else (
            math.pi / z - gear.base_half_angle)  # fmt: skip
        limit, sense = 2 * gear.base_radius * space, gear.sign
        m.over_pins(gear, limit * (1 + sense * 1e-9))
        with pytest.raises(ParameterError) as refused:
            m.over_pins(gear, limit * (1 - sense * 1e-3))
        assert refused.value.code == ("pin_falls_through" if sense > 0 else "pin_beyond_base_circle")
        assert 0 <= sense * (works(refused.value) - limit) < 1.01e-4
        pin = m.best_pin_diameter(gear)
        key = "measured_over_pins" if sense > 0 else "measured_between_pins"
        if sense > 0:
            odd = math.cos(math.pi / 2 / z) if z % 2 else 1.0
            least = 2 * odd * gear.base_radius + pin
            with pytest.raises(ParameterError) as refused:
                m.gear_with_size(gear, pin, least - 1e-3)
            assert (refused.value.name, refused.value.code) == (key, "pin_falls_through")
            assert 0 <= works(refused.value) - least < 1.01e-4
        whole = m.over_pins(gear, pin).length
        with pytest.raises(ParameterError) as refused:
            m.gear_with_size(gear, pin, whole + sense * 1e-2)
        assert (refused.value.name, refused.value.code) == (key, "above_nominal" if sense > 0 else "below_nominal")
        assert works(refused.value) == pytest.approx(whole, abs=1.01e-4)

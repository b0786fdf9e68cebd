"""Grooves of timing pulleys: sizes of their standards, makers' diameters, smooth curves, offsets against shapely."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from shapely.geometry import Polygon

from geometry.base.errors import OffsetError, ParameterError
from geometry.base.record import replace
from geometry.curves.curve import Complex
from geometry.gears.belts.belt import ArcGroove, Belt, StraightGroove, belt_of, belts, like_belt
from geometry.gears.belts.pulley import Pulley, checked_pulley, pulley_findings, pulley_side
from geometry.gears.teeth.offset import toothed_region
from geometry.plane.profile import Label, Profile
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles
from tests import brute

# outer diameters of makers: T5 (10T5 to 20T5 of an aluminium series by DIN 7721), AT5 (a Japanese catalogue)
MAKERS = {
    "T5": {10: 15.05, 12: 18.25, 14: 21.45, 15: 23.05, 16: 24.60, 18: 27.80, 19: 29.40, 20: 31.00},
    "AT5": {15: 22.65, 16: 24.2, 18: 27.4, 20: 30.6, 22: 33.85, 24: 37.0, 25: 38.6, 26: 40.2, 28: 43.35},
}
# inches of RMA IP-24: pitch, pitch line over the outer circle, width and depth of grooves, radii of root and tip
INCHES = {
    "MXL": (0.080, 0.010, 0.033, 0.027, 0.010, 0.005),
    "XL": (0.200, 0.010, 0.052, 0.065, 0.016, 0.025),
    "L": (0.375, 0.015, 0.120, 0.105, 0.047, 0.046),
    "H": (0.500, 0.027, 0.165, 0.120, 0.063, 0.063),
    "XH": (0.875, 0.055, 0.311, 0.281, 0.078, 0.094),
    "XXH": (1.250, 0.060, 0.479, 0.406, 0.156, 0.125),
}
# width and depth of grooves of DIN 7721-2, up to 20 teeth and of more
DIN = {
    "T2.5": ((1.75, 0.75), (1.83, 1.00)),
    "T5": ((2.96, 1.25), (3.32, 1.95)),
    "T10": ((6.02, 2.60), (6.57, 3.40)),
    "T20": ((11.65, 5.20), (12.60, 6.00)),
}
# by how much the pitch diameter is more than the outer one, 2a of a maker's table of the grooves of DIN 7721-2
LESS = {"T2.5": 0.53, "T5": 0.85, "T10": 1.85, "T20": 2.85}
# inches of makers' handbooks, pitch line over the outer circle
LINES = {"3M": 0.015, "5M": 0.0225, "8M": 0.027, "14M": 0.055, "2GT": 0.010, "3GT": 0.015, "5GT": 0.0225}


def named(designation: str) -> Belt:
    """A belt of the table."""
    found = belt_of(designation)
    assert found is not None
    return found


def points(profile: Profile, count: int = 60) -> Complex:
    """Along a closed outline."""
    curves = [s.curve for s in profile.segments()]
    return np.concatenate([c.point(np.linspace(*c.domain, count)[:-1]) for c in curves])


def polygon(profile: Profile, count: int = 60) -> Polygon:
    """The same."""
    found = points(profile, count)
    return Polygon(np.column_stack((found.real, found.imag)))


@pytest.mark.parametrize("name", MAKERS)
def test_outer_diameters_are_those_of_makers(name: str) -> None:
    """They round to five hundredths, and stay that near to one pitch line."""
    for teeth, diameter in MAKERS[name].items():
        assert 2 * Pulley(teeth, named(name)).outer_radius == pytest.approx(diameter, abs=0.075)


def test_circles_of_pulleys_by_hand() -> None:
    """GT2 of printers: 20 teeth, 12.73 mm, 12.22 mm outside; XL of 10 teeth: 0.637 in and 0.617 in."""
    pulley = Pulley(20, named("GT2"))
    assert (2 * pulley.pitch_radius, 2 * pulley.outer_radius) == pytest.approx((12.732, 12.224), abs=5e-4)
    pulley = Pulley(10, named("XL"))
    assert (2 * pulley.pitch_radius, 2 * pulley.outer_radius) == pytest.approx((0.637 * 25.4, 0.617 * 25.4), abs=0.01)


@pytest.mark.parametrize("name", INCHES)
def test_grooves_of_inch_pitches_are_those_of_the_inch_standard(name: str) -> None:
    """Which ISO 5294 rounds to hundredths of a millimetre."""
    belt = named(name)
    groove = belt.groove
    assert isinstance(groove, StraightGroove)
    found = belt.pitch, belt.line_offset, groove.width, groove.depth, groove.root_radius, groove.tip_radius
    assert found == pytest.approx([25.4 * x for x in INCHES[name]], abs=0.0052)


@pytest.mark.parametrize("name", DIN)
def test_grooves_of_few_teeth_are_narrower_and_flatter(name: str) -> None:
    belt = named(name)
    for teeth, wanted in zip((20, 21), DIN[name], strict=True):
        groove = belt.groove_of(teeth)
        assert isinstance(groove, StraightGroove)
        assert (groove.width, groove.depth) == wanted


@pytest.mark.parametrize("name", LESS)
def test_outer_diameters_of_t_pulleys_are_less_by_what_makers_have(name: str) -> None:
    """Of few teeth and of many."""
    for teeth in (16, 40):
        pulley = Pulley(teeth, named(name))
        assert 2 * pulley.outer_radius == pytest.approx(teeth * pulley.belt.pitch / math.pi - LESS[name], abs=1e-9)


@pytest.mark.parametrize("name", LINES)
def test_pitch_lines_of_metric_pitches_are_whole_inches_over_the_outer_circle(name: str) -> None:
    assert named(name).line_offset == pytest.approx(25.4 * LINES[name], abs=6e-4)


def test_an_outline_that_has_no_flanks_left_is_refused() -> None:
    """Wide lands are left: a fillet takes all of a flank, the outer circle meets the floor's arc."""
    shallow = Belt(10.0, 0.5, StraightGroove(4.0, 0.5, math.radians(25), 1.0, 0.0))
    for pulley, offset in ((Pulley(20, shallow), -0.2), (Pulley(20, named("GT2"), given_outer_diameter=100.0), -0.9)):
        assert pulley_side(checked_pulley(pulley), offset / 10)
        with pytest.raises(OffsetError):
            pulley_side(pulley, offset)


def test_an_offset_that_leaves_no_land_is_refused() -> None:
    """Walls and the outer circle of GT2 move: two roundings meet between 0.35 and 0.4 mm of 20 teeth."""
    pulley = Pulley(20, named("GT2"))
    with pytest.raises(OffsetError):
        pulley_side(pulley, -0.4)
    assert pulley_side(pulley, -0.15)


def test_an_offset_that_leaves_no_rim_is_refused() -> None:
    """Grooves go in by it and the bore out: 0.06 mm between them are less than twice 0.04 mm."""
    pulley = Pulley(20, named("GT2"))
    thin = replace(pulley, holes=HubHoles(RoundBore(2 * pulley.root_radius - 0.12)))
    with pytest.raises(OffsetError) as refused:
        pulley_side(thin, -0.04)
    assert refused.value.reason == "leaves_no_rim"
    assert pulley_side(thin, -0.02)


def test_sharp_corners_have_no_curve_and_lands_are_what_widths_leave() -> None:
    """Of each pitch angle twice the arcsine of b / d is a groove's."""
    pulley = checked_pulley(Pulley(17, Belt(5.0, 0.5, StraightGroove(3.0, 1.5, math.radians(25), 0.3, 0.0))))
    outer = 17 * 5.0 / (2 * math.pi) - 0.5
    assert pulley.land == pytest.approx(outer * (2 * math.pi / 17 - 2 * math.asin(1.5 / outer)), rel=1e-12)
    curves = [s.curve for s in pulley_side(pulley).segments]
    assert min(abs(complex(c.point(c.domain[1]) - c.point(c.domain[0]))) for c in curves) > 0.1


@pytest.mark.parametrize("teeth", [20, 300])
def test_a_groove_whose_flanks_meet_above_its_floor_is_refused(teeth: int) -> None:
    """As wide works as flanks that meet there leave: b / 2 = (sqrt(r^2 - b^2 / 4) - r + h) tan(phi)."""
    narrow = Belt(5.0, 0.5, StraightGroove(1.0, 2.0, math.radians(25), 0.3, 0.0))
    with pytest.raises(ParameterError) as refused:
        checked_pulley(Pulley(teeth, narrow))
    assert refused.value.name == "belt.groove_width"
    nearest, half, outer = refused.value.nearest, 0.0, 5.0 * teeth / (2 * math.pi) - 0.5
    for _ in range(60):
        half = (math.sqrt(outer**2 - half**2) - outer + 2.0) * math.tan(math.radians(25))
    assert nearest is not None
    # told with five digits
    assert 0 < nearest.value - 2 * half < 1.01e-4


@pytest.mark.sampled(8)
@pytest.mark.parametrize("name", belts())
@pytest.mark.parametrize("more", [0, 13])
def test_grooves_are_smooth_as_deep_and_as_wide_as_their_standard(name: str, more: int) -> None:
    belt = named(name)
    pulley = checked_pulley(Pulley(belt.least_teeth + more, belt))
    groove, side = belt.groove_of(pulley.number_of_teeth), pulley_side(pulley)
    for before, after in zip(side.segments[:-1], side.segments[1:], strict=True):
        ways = before.curve.tangent(before.curve.domain[1]), after.curve.tangent(after.curve.domain[0])
        assert abs(complex(ways[0] - ways[1])) < 1e-9
    outline = points(side.profile())
    assert np.abs(outline).min() == pytest.approx(pulley.outer_radius - groove.depth, rel=1e-9)
    assert np.abs(outline).max() == pytest.approx(pulley.outer_radius, rel=1e-12)
    if isinstance(groove, ArcGroove):
        return
    flank = next(s.curve for s in side.segments if s.label is Label.FLANK)
    low, high = (complex(flank.point(t)) * np.exp(0.5j * pulley.pitch_angle) for t in flank.domain)
    slope = (high.imag - low.imag) / (high.real - low.real)
    assert math.degrees(math.atan(slope)) == pytest.approx(math.degrees(groove.half_angle))
    if groove.at_floor:
        half = low.imag - slope * (low.real - pulley.root_radius)
    else:
        # the corner on the outer circle, by fixed points of its height
        height = pulley.outer_radius
        for _ in range(60):
            half = low.imag + slope * (height - low.real)
            height = math.sqrt(pulley.outer_radius**2 - half**2)
    assert 2 * half == pytest.approx(groove.width, rel=1e-9)
    fillets = [s.curve.radius for s in side.segments if s.label is Label.ROOT_FILLET and hasattr(s.curve, "radius")]
    assert fillets
    assert max(fillets) <= groove.root_radius * (1 + 1e-12)


def test_arcs_of_gt_grooves_touch_each_other() -> None:
    """Centres are as far apart as the radii differ, across the middle; roundings stand on both."""
    groove = named("GT2").groove
    assert isinstance(groove, ArcGroove)
    floor, flank, tip, land = (s.curve for s in pulley_side(Pulley(20, named("GT2"))).segments)
    turn = np.exp(1j * math.pi / 20)
    assert abs(floor.centre - flank.centre) == pytest.approx(1.0 - 0.555)
    assert (flank.centre * turn).imag == pytest.approx(-0.40)
    assert abs(tip.centre - flank.centre) == pytest.approx(1.0 + 0.15)
    assert abs(tip.centre) == pytest.approx(land.radius - 0.15)


@pytest.mark.parametrize("name", ["T5", "XL", "AT10", "8M"])
def test_a_clearance_widens_a_groove_on_its_own_circle(name: str) -> None:
    """The flanks stand off by it: at the floor by what is left of that there, between corners by fixed points."""
    belt, clear = named(name), 0.05
    groove = belt.groove_of(30)
    assert isinstance(groove, StraightGroove)
    outer = Pulley(30, belt).outer_radius
    assert groove.width_of(outer, 0.0) == pytest.approx(groove.width, rel=1e-12)
    slope, half = math.tan(groove.half_angle), groove.width / 2
    height = outer - groove.depth if groove.at_floor else math.sqrt(outer**2 - half**2)
    wide = half + clear / math.cos(groove.half_angle)
    if groove.at_floor:
        found = wide - clear * slope
    else:
        found = wide
        for _ in range(60):
            found = wide + slope * (math.sqrt(outer**2 - found**2) - height)
    assert groove.width_of(outer, clear) == pytest.approx(2 * found, rel=1e-12)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", belts())
@pytest.mark.parametrize("share", [-0.02, -0.1, 0.03])
def test_offset_grooves_are_parallel(name: str, share: float) -> None:
    """Every point stands off the exact outline by the offset, but for corners where a tip rounding is used up."""
    belt = named(name)
    pulley, offset = checked_pulley(Pulley(belt.least_teeth + 11, belt)), share * belt.pitch
    moved = points(toothed_region(pulley_side, pulley, offset).region.outer, 24)
    exact = polygon(pulley_side(pulley).profile(), 160)
    near = moved[np.abs(np.angle(moved)) < 1.5 * pulley.pitch_angle]
    found = brute.distance_to_polygon(exact, shapely.points(near.real, near.imag))
    assert found.min() == pytest.approx(abs(offset), abs=2e-4 * belt.pitch)
    corner = -offset > belt.groove_of(pulley.number_of_teeth).tip_radius
    assert corner or found.max() == pytest.approx(abs(offset), abs=2e-4 * belt.pitch)
    assert np.median(found) == pytest.approx(abs(offset), abs=2e-4 * belt.pitch)
    inside = shapely.contains_xy(exact, near.real, near.imag)
    assert inside.all() if offset < 0 else not inside.any()


def test_few_teeth_and_wide_walls_are_refused_with_what_works() -> None:
    belt = named("T2.5")
    for pulley, key in (
        (Pulley(6, belt), "number_of_teeth"),
        (Pulley(9, belt), "number_of_teeth"),
        (Pulley(20, named("GT2"), clearance=0.3), "clearance"),
        (Pulley(20, named("GT2"), given_outer_diameter=7.0), "outer_diameter"),
        # the clearance is none too much of the diameter that works
        (Pulley(20, named("GT2"), clearance=0.01, given_outer_diameter=5.0), "outer_diameter"),
    ):
        with pytest.raises(ParameterError) as refused:
            checked_pulley(pulley)
        assert refused.value.name == key
        nearest = refused.value.nearest
        assert nearest is not None
        assert key != "number_of_teeth" or nearest.value == 10
        field = {"outer_diameter": "given_outer_diameter"}.get(key, key)
        checked_pulley(replace(pulley, **{field: nearest.value}))
    # both too much, of as many teeth as there may be: one is told, and what works without the other
    with pytest.raises(ParameterError) as refused:
        checked_pulley(Pulley(500, named("GT2"), clearance=0.3, given_outer_diameter=5.0))
    assert refused.value.name == "outer_diameter"
    nearest = refused.value.nearest
    assert nearest is not None
    checked_pulley(Pulley(500, named("GT2"), given_outer_diameter=nearest.value))
    wide = Belt(5.0, 0.5, StraightGroove(7.0, 2.0, math.radians(25), 0.0, 0.0))
    with pytest.raises(ParameterError) as refused:
        checked_pulley(Pulley(20, wide))
    assert refused.value.name == "belt.groove_width"
    nearest = refused.value.nearest
    assert nearest is not None
    checked_pulley(Pulley(20, replace(wide, groove=replace(wide.groove, width=nearest.value))))
    assert [f.code for f in pulley_findings(Pulley(21, named("8M")))] == ["few_pulley_teeth"]
    assert pulley_findings(Pulley(22, named("8M"))) == ()


@pytest.mark.parametrize(
    ("diameter", "found"), [(12.4, []), (12.45, ["off_pitch_diameter"]), (40.0, ["off_pitch_diameter"])]
)
def test_an_outer_diameter_far_from_that_of_the_pitch_is_told(diameter: float, found: list[str]) -> None:
    """GT2 of 20 teeth has 12.2244 mm; a tenth of the pitch may be given for the printer."""
    pulley = checked_pulley(Pulley(20, named("GT2"), given_outer_diameter=diameter))
    assert [f.code for f in pulley_findings(pulley)] == found


@pytest.mark.parametrize(
    ("typed", "name"),
    [
        ("HTD 5M", "5M"), ("htd-8m", "8M"), ("HTD3", "3M"), ("5mm HTD", "5M"), ("2MGT", "2GT"), ("gt2", "2GT"),
        ("GT2-2M", "2GT"), ("GT2 3mm", "3GT"), ("PowerGrip GT3-5MR", "5GT"), ("2mm GT2", "2GT"), ("T2,5", "T2.5"),
        ("AT-10", "AT10"),
    ],
)  # fmt: skip
def test_belts_are_named_as_people_write_them(typed: str, name: str) -> None:
    assert named(typed) is belts()[name]


@pytest.mark.parametrize(
    ("typed", "like"),
    [
        ("T50", "T5"),
        ("GT2 6mm", "2GT"),
        ("T5 10", "T5"),
        ("HTD 3M 9mm", "3M"),
        ("V", None),
        ("MLX", "MXL"),
        ("S8M", "8M"),
        ("R8M", "8M"),
        ("AT20", "T20"),
        ("XXL", None),
        ("AT3", None),
        ("S4.5M", None),
    ],
)
def test_of_a_belt_with_its_width_the_belt_is_offered(typed: str, like: str | None) -> None:
    assert belt_of(typed) is None
    assert like_belt(typed) == like

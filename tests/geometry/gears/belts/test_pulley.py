"""Grooves of timing pulleys: sizes of their standards, makers' diameters, smooth curves, offsets against shapely."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from shapely.geometry import Polygon

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.curves.curve import Complex
from geometry.gears.belts.belt import ArcGroove, Belt, StraightGroove, belt_of, belts, like_belt
from geometry.gears.belts.pulley import Pulley, checked_pulley, pulley_findings, pulley_region, pulley_side
from geometry.plane.profile import Label, Profile

# outer diameters of makers: T5 (10T5 to 20T5 of an aluminium series by DIN 7721), AT5 (a Japanese catalogue)
MAKERS = {
    "T5": {10: 15.05, 12: 18.25, 14: 21.45, 15: 23.05, 16: 24.60, 18: 27.80, 19: 29.40, 20: 31.00},
    "AT5": {15: 22.65, 16: 24.2, 18: 27.4, 20: 30.6, 22: 33.85, 24: 37.0, 25: 38.6, 26: 40.2, 28: 43.35},
}


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


@pytest.mark.parametrize("name", belts())
@pytest.mark.parametrize("share", [-0.02, -0.1, 0.03])
def test_offset_grooves_are_parallel(name: str, share: float) -> None:
    """Every point stands off the exact outline by the offset, but for corners where a tip rounding is used up."""
    belt = named(name)
    pulley, offset = checked_pulley(Pulley(belt.least_teeth + 11, belt)), share * belt.pitch
    moved = points(pulley_region(pulley, offset).region.outer, 24)
    exact = polygon(pulley_side(pulley).profile(), 160)
    near = moved[np.abs(np.angle(moved)) < 1.5 * pulley.pitch_angle]
    found = shapely.distance(shapely.points(near.real, near.imag), exact.exterior)
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
        (Pulley(20, named("GT2"), clearance=0.3), "clearance"),
        (Pulley(20, named("GT2"), given_outer_diameter=7.0), "outer_diameter"),
    ):
        with pytest.raises(ParameterError) as refused:
            checked_pulley(pulley)
        assert refused.value.name == key
        nearest = refused.value.nearest
        assert nearest is not None
        field = {"outer_diameter": "given_outer_diameter"}.get(key, key)
        checked_pulley(replace(pulley, **{field: nearest.value}))
    wide = Belt(5.0, 0.5, StraightGroove(7.0, 2.0, math.radians(25), 0.0, 0.0))
    with pytest.raises(ParameterError) as refused:
        checked_pulley(Pulley(20, wide))
    assert refused.value.name == "belt.groove_width"
    nearest = refused.value.nearest
    assert nearest is not None
    checked_pulley(Pulley(20, replace(wide, groove=replace(wide.groove, width=nearest.value))))
    assert [f.code for f in pulley_findings(Pulley(12, named("8M")))] == ["few_pulley_teeth"]


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


@pytest.mark.parametrize(("typed", "like"), [("T50", "T5"), ("GT2 6mm", "2GT"), ("T5 10", "T5"), ("HTD 3M 9mm", "3M")])
def test_of_a_belt_with_its_width_the_belt_is_offered(typed: str, like: str) -> None:
    assert belt_of(typed) is None
    assert like_belt(typed) == like

"""Sectors of gears and rings against shapely: all teeth within a wedge, a disc for the rest, Minkowski's offset."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely.geometry import Point, Polygon
from shapely.geometry.base import BaseGeometry

from geometry.base.errors import OffsetError, ParameterError
from geometry.base.record import replace
from geometry.curves.line_arc import Arc
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.limits import checked_gear
from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_limits import checked_ring
from geometry.gears.teeth.ring_offset import ring_region
from geometry.gears.teeth.sector import Sector, centred
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.measure import profile_area
from geometry.plane.profile import Profile
from geometry.solids.hub_holes import HubHoles
from geometry.solids.windows import RoundHoles
from tests.sampling import examples

_STEPS = 60


def polygon(profile: Profile) -> Polygon:
    """Points all along the exact curves; arcs so fine that their sagitta is lost."""
    points = []
    for segment in profile.segments():
        curve = segment.curve
        count = max(_STEPS, math.ceil(400 * abs(curve.sweep))) if isinstance(curve, Arc) else _STEPS
        points.append(curve.point(np.linspace(*curve.domain, count))[:-1])
    whole = np.concatenate(points)
    return Polygon(np.column_stack([whole.real, whole.imag]))


def disc(radius: float) -> BaseGeometry:
    """All within a circle about the axis."""
    return Point(0, 0).buffer(radius, quad_segs=800)


def wedge(low: float, high: float) -> BaseGeometry:
    """All in directions between two, rad."""
    angles = np.linspace(low, high, 400)
    return Polygon([(0, 0), *zip(1e3 * np.cos(angles), 1e3 * np.sin(angles), strict=True)])


def ends(gear: SpurGear | RingGear, run: int) -> tuple[float, float]:
    """Directions of the centre lines of the outer teeth of a run, counted here tooth by tooth."""
    sector = gear.sector
    assert sector is not None
    pitch = 2 * math.pi / gear.number_of_teeth
    on_space = 0.5 if isinstance(gear, RingGear) else 0.0
    first = run * (gear.number_of_teeth // sector.runs) + sector.first + on_space
    return first * pitch, (first + sector.teeth - 1) * pitch


def expected(gear: SpurGear) -> BaseGeometry:
    """The whole gear within the wedges of its teeth, on what is left of its disc."""
    sector = gear.sector
    assert sector is not None
    whole, half = polygon(gear_region(replace(gear, sector=None)).region.outer), math.pi / gear.number_of_teeth
    runs = [ends(gear, run) for run in range(sector.runs)]
    teeth = shapely.union_all([whole & wedge(low - half, high + half) for low, high in runs])
    rims = [disc(gear.root_radius) & wedge(low - 2 * half, high + 2 * half) for low, high in runs]
    if sector.hub_diameter is not None:
        core = (rims[0] | disc(sector.hub_diameter / 2)).convex_hull
    elif sector.blank_diameter is not None:
        core = shapely.union_all([*rims, disc(sector.blank_diameter / 2)])
    else:
        core = disc(gear.root_radius)
    if sector.corner_radius:
        q = sector.corner_radius
        core = core.buffer(-q, quad_segs=200).buffer(2 * q, quad_segs=200).buffer(-q, quad_segs=200)
    return teeth | core


def same(found: BaseGeometry, asked: BaseGeometry, size: float) -> None:
    """Within what chords of circles differ from them."""
    assert found.is_valid
    assert found.symmetric_difference(asked).area < 2e-5 * size**2


def gear(teeth: int, sector: Sector, **more: Any) -> SpurGear:
    """A gear of module 2."""
    return SpurGear(2.0, teeth, iso_53("A"), sector=sector, **more)


@st.composite
def sectors(draw: st.DrawFn) -> SpurGear:
    """Gears with a sector that they have room for."""
    runs = draw(st.integers(1, 3))
    each = draw(st.integers(8, 24))
    z = runs * each
    rest = draw(st.sampled_from(["roots", "blank", "cut"] if runs == 1 else ["roots", "blank"]))
    most = {"roots": each - 1, "blank": each - 2, "cut": max(1, each // 3)}[rest]
    n = draw(st.integers(1, most))
    first = draw(st.integers(-z, z))
    # where inv of the tip's angle is half their angle at the base teeth are pointed: 8, 9, 10 from 0.566, 0.635, 0.6996
    shift = draw(st.floats(0.2, min(0.7, 0.069 * z)))
    bare = gear(z, Sector(n, first, runs), profile_shift_coefficient=shift)
    root = bare.root_radius
    blank = 2 * root * draw(st.floats(0.55, 0.9)) if rest == "blank" else None
    hub = 2 * root * draw(st.floats(0.15, 0.5)) if rest == "cut" else None
    round_ = draw(st.sampled_from([0.0, 0.3])) if rest != "roots" else 0.0
    return replace(bare, sector=Sector(n, first, runs, blank, hub, round_))


@given(sectors())
@examples(40)
def test_a_sector_is_the_gear_within_its_wedge(made: SpurGear) -> None:
    checked_gear(made)
    same(polygon(gear_region(made).region.outer), expected(made), made.tip_radius)


@given(sectors(), st.sampled_from([-0.15, -0.05, 0.05, 0.1]))
@examples(30)
def test_its_offset_is_that_of_the_plane(made: SpurGear, offset: float) -> None:
    """Minkowski's sum, or difference, with a disc, as shapely takes it of the whole outline."""
    found = polygon(gear_region(made, offset).region.outer)
    asked = expected(made).buffer(offset, quad_segs=100)
    same(found, asked, made.tip_radius)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("blank", [None, 130.0])
@pytest.mark.parametrize(("runs", "teeth"), [(1, 7), (1, 8), (3, 5)])
@pytest.mark.parametrize("offset", [0.0, -0.1, 0.08])
def test_a_sector_of_a_ring(blank: float | None, runs: int, teeth: int, offset: float) -> None:
    """The ring's own teeth within the wedges; beyond them all is hole as far as the blank."""
    sector = Sector(teeth, centred(teeth, -1), runs, blank, None, 0.4 if blank else 0.0)
    root = RoundedRoot(1.25, 0.3)
    ring = checked_ring(RingGear(2.0, 60, math.radians(20), 150.0, root, given_tip_diameter=117.0, sector=sector))
    hole = polygon(ring_region(replace(ring, sector=None)).region.holes[0])
    half = math.pi / 60
    runs_ = [ends(ring, run) for run in range(runs)]
    teeth_ = shapely.union_all([(disc(ring.root_radius) - hole) & wedge(a - half, b + half) for a, b in runs_])
    rims = shapely.union_all([wedge(a - 2 * half, b + 2 * half) for a, b in runs_])
    core = disc(75.0) - disc(ring.root_radius)
    if blank is not None:
        core = (core & rims) | (disc(75.0) - disc(blank / 2))
        core = core.buffer(-0.4, quad_segs=200).buffer(0.8, quad_segs=200).buffer(-0.4, quad_segs=200)
    asked = (core | teeth_).buffer(offset, quad_segs=100)
    found = polygon(ring_region(ring, offset).region.outer) - polygon(ring_region(ring, offset).region.holes[0])
    same(found, asked, 75.0)


def test_area_of_a_blank_is_that_of_disc_and_teeth() -> None:
    """Whole gear = disc of its roots + z teeth; a sector keeps n of them: linear in n."""
    areas = [profile_area(gear_region(gear(24, Sector(n, 0))).region.outer) for n in (1, 2, 7, 23)]
    tooth = areas[1] - areas[0]
    assert areas[2] - areas[0] == pytest.approx(6 * tooth, rel=1e-12)
    assert areas[3] - areas[0] == pytest.approx(22 * tooth, rel=1e-12)
    whole = profile_area(gear_region(SpurGear(2.0, 24, iso_53("A"))).region.outer)
    assert areas[3] + tooth == pytest.approx(whole, rel=1e-12)


def offered(refusal: ParameterError | OffsetError) -> Any:
    """What a refusal says would work."""
    assert refusal.nearest is not None
    assert refusal.nearest.value is not None
    return refusal.nearest.value


@pytest.mark.parametrize(
    ("sector", "name", "code"),
    [
        (Sector(24, 0), "sector.teeth", "sector_of_all_teeth"),
        (Sector(12, 0, 2), "sector.teeth", "sector_of_all_teeth"),
        (Sector(2, 0, 12), "sector.teeth", "sector_of_all_teeth"),
        (Sector(23, 0, 1, 30.0), "sector.teeth", "sector_of_all_teeth"),
        (Sector(3, 0, 5), "sector.runs", "runs_do_not_divide"),
        (Sector(5, 0, 1, 44.0), "sector.blank_diameter", "blank_above_roots"),
        (Sector(5, 0, 1, 43.0), "sector.blank_diameter", "blank_above_roots"),
        (Sector(5, 0, 1, 9.0), "sector.blank_diameter", "rest_within_holes"),
        (Sector(5, 0, 1, None, 9.0), "sector.hub_diameter", "rest_within_holes"),
        (Sector(5, 0, 1, None, 10.0), "sector.hub_diameter", "rest_within_holes"),
        (Sector(5, 0, 1, None, 50.0), "sector.hub_diameter", "reaches_root_circle"),
        (Sector(5, 0, 1, None, 43.0), "sector.hub_diameter", "reaches_root_circle"),
        (Sector(18, 0, 1, None, 14.0), "sector.teeth", "sides_of_sector_meet"),
        (Sector(5, 0, 1, None, 14.0, 9.0), "sector.corner_radius", "corner_has_no_room"),
        (Sector(5, 0, 1, 30.0, None, 5.0), "sector.corner_radius", "corner_has_no_room"),
        # deeper than the step to the blank, wider than the teeth leave of the rim, than the blank is, than all is
        (Sector(5, 0, 1, 40.0, None, 1.0), "sector.corner_radius", "corner_has_no_room"),
        (Sector(5, 0, 1, 14.0, None, 4.0), "sector.corner_radius", "corner_has_no_room"),
        (Sector(22, 0, 1, 16.0, None, 2.0), "sector.corner_radius", "corner_has_no_room"),
        (Sector(5, 0, 1, 30.0, None, 15.0), "sector.corner_radius", "corner_has_no_room"),
        (Sector(5, 0, 1, None, 14.0, 22.0), "sector.corner_radius", "corner_has_no_room"),
        # so wide that both corners of the rim cross: it was taken for one that goes nearly all round
        (Sector(1, 0, 1, 14.0, None, 5.0), "sector.corner_radius", "corner_has_no_room"),
        (Sector(1, 0, 1, None, 14.0, 6.0), "sector.corner_radius", "corner_has_no_room"),
        (Sector(5, 0, 1, None, 14.0, 21.0), "sector.corner_radius", "corner_has_no_room"),
        (Sector(5, 0, 1, None, None, 0.3), "sector.corner_radius", "blank_without_corners"),
    ],
)
def test_what_has_no_room_is_refused_with_what_has(sector: Sector, name: str, code: str) -> None:
    with pytest.raises(ParameterError) as refused:
        checked_gear(gear(24, sector, bore_diameter=10.0))
    assert (refused.value.name, refused.value.code) == (name, code)
    cured = gear(24, replace(sector, **{name.partition(".")[2]: offered(refused.value)}), bore_diameter=10.0)
    checked_gear(cured)
    assert polygon(gear_region(cured).region.outer).is_valid


def test_holes_stand_within_a_cut_sector() -> None:
    """One hole on +x between hub and rim fits; two opposite ones do not, nor one that reaches the sides."""
    cut = Sector(1, 0, 1, None, 14.0)
    for count, size, good in ((1, 6.0, True), (2, 6.0, False), (1, 14.0, False)):
        hub = HubHoles(None, (RoundHoles(count, size, 28.0, 0.0),))
        made = replace(gear(24, cut), hub=hub)
        if good:
            checked_gear(made)
            assert len(gear_region(made, -0.1).region.holes) == 1
        else:
            with pytest.raises(ParameterError, match="holes"):
                checked_gear(made)


def test_an_offset_of_just_the_rounding_leaves_sharp_corners() -> None:
    """Before: what rounding errors left of a rounding's radius was divided by."""
    made = gear(24, Sector(3, -8, 3, 40.50117757212437, None, 0.3), profile_shift_coefficient=-0.024642006616631046,
                circumferential_thinning=0.1)  # fmt: skip
    same(polygon(gear_region(made, 0.3).region.outer), expected(made).buffer(0.3, quad_segs=100), made.tip_radius)


def test_an_offset_that_leaves_no_wall_is_refused() -> None:
    with pytest.raises(OffsetError):
        gear_region(gear(24, Sector(5, 0, 1, None, 14.0), bore_diameter=12.0), -0.6)


def test_a_hole_that_grows_into_the_side_of_a_cut_sector_is_refused() -> None:
    """A hole in the spoke, whose walls are thinner than those of the teeth."""
    made = replace(gear(24, Sector(1, 0, 1, None, 14.0)), hub=HubHoles(None, (RoundHoles(1, 8.0, 28.0, 0.0),)))
    with pytest.raises(OffsetError) as refused:
        gear_region(made, -1.2)
    section = gear_region(checked_gear(made), offered(refused.value)).region
    assert polygon(section.outer).contains(polygon(section.holes[0]))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("sector", [Sector(5, 0), Sector(3, 0, 1, None, 14.0)])
@pytest.mark.parametrize("offset", [1.0, 3.0])
def test_spaces_within_a_run_close_before_those_beside_it(sector: Sector, offset: float) -> None:
    """Moved so far, flanks of neighbours meet above the roots; those of outer teeth go on down beside nothing."""
    made = gear(24, sector, profile_shift_coefficient=0.5)
    found = polygon(gear_region(made, offset).region.outer)
    same(found, expected(made).buffer(offset, quad_segs=200), made.tip_radius)


@pytest.mark.parametrize("sector", [Sector(5, 0), Sector(5, 0, 1, 30.0), Sector(3, 0, 1, None, 14.0)])
def test_an_offset_that_closes_the_space_beside_a_run_is_refused(sector: Sector) -> None:
    made = gear(24, sector, profile_shift_coefficient=0.5)
    with pytest.raises(OffsetError) as refused:
        gear_region(made, 4.0)
    assert refused.value.code == "closes_tooth_spaces"
    near = offered(refused.value)
    assert 3.0 < near < 4.0
    assert polygon(gear_region(made, near).region.outer).is_valid


@pytest.mark.parametrize("corner", [5.0, 12.0, 55.0])
def test_corners_of_a_ring_that_have_no_room_are_refused(corner: float) -> None:
    """Wider than the rim beside the teeth, than the whole rim, than the blank is."""

    def ring(radius: float) -> RingGear:
        return RingGear(2.0, 60, math.radians(20), 260.0, RoundedRoot(1.25, 0.3), given_tip_diameter=117.0,
                        sector=Sector(1, 0, 1, 200.0, None, radius))  # fmt: skip

    with pytest.raises(ParameterError) as refused:
        checked_ring(ring(corner))
    assert (refused.value.name, refused.value.code) == ("sector.corner_radius", "corner_has_no_room")
    assert polygon(ring_region(checked_ring(ring(offered(refused.value)))).region.holes[0]).is_valid


@pytest.mark.parametrize("sign", [1, -1])
def test_by_default_a_run_lies_about_the_x_axis(sign: int) -> None:
    """Or half a pitch beyond it; a gear has a tooth there, a ring a space."""
    for teeth in range(1, 12):
        middle = centred(teeth, sign) + (teeth - 1) / 2 + (0.0 if sign > 0 else 0.5)
        assert middle == (0.5 if (teeth % 2 == 0) is (sign > 0) else 0.0)

"""Kerf and print offsets: the path lies at its distance from the exact outline, everywhere and on the right side."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given

from geometry.base.errors import GeometryError, OffsetError, ParameterError
from geometry.base.record import replace
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.curves.trochoid import TrochoidFillet
from geometry.gears.teeth.basic_rack import BasicRack, TipRelief, full_round_radius, iso_53
from geometry.gears.teeth.offset import chamfered_outline, gear_region
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.plane.measure import profile_area
from geometry.plane.profile import Label, Profile
from tests import brute
from tests.oracles import exact_gear, rack_sweep
from tests.sampling import examples, some_of
from tests.strategies import gears, numbers

RIGHT = 1e-12
_FULL = BasicRack(math.radians(20), 1.0, 0.25, full_round_radius(math.radians(20), 1.25))
GEARS = {
    "z23": SpurGear(2.0, 23, iso_53()),
    "undercut": SpurGear(2.0, 8, iso_53("C"), 0.1),
    "limit of undercut": SpurGear(2.0, 17, iso_53()),
    "relief": SpurGear(2.0, 23, iso_53(relief=TipRelief(0.02))),
    "chamfer": SpurGear(2.0, 23, iso_53(), tip_chamfer=0.2),
    "rounding": SpurGear(2.0, 23, iso_53(), tip_rounding=0.2),
    "full round": SpurGear(2.0, 30, _FULL),
    "narrow land": SpurGear(2.0, 23, iso_53("D")),
    "centre on the pitch line": SpurGear(2.0, 23, iso_53(), 0.87),
    "shifted out": SpurGear(2.0, 23, iso_53(), 1.0),
    "z200": SpurGear(2.0, 200, iso_53()),
    "thinned": SpurGear(2.0, 23, iso_53(), circumferential_thinning=0.2, thinning_by_deeper_cut=True),
    "near pointed": SpurGear(2.0, 12, iso_53(), 0.8),
}
# of the module: laser kerf, printing, a router's half diameter, and the other way
SHARES = [1e-6, 0.0375, 0.45, -1e-6, -0.0375, -0.2]


def check_path(gear: SpurGear, offset: float) -> None:
    """Every point of the path at |offset| from the nominal outline, on the right side, and nothing missing."""
    nominal = tooth_side(gear).profile()
    moved = gear_region(gear, offset).region.outer
    points = brute.period_points(moved, 40)
    distance = brute.distance_to_outline(points, nominal)
    assert np.abs(distance - abs(offset)).max() <= RIGHT * gear.tip_radius
    # no point of the path at the offset's distance may be left out: the nominal outline sees the path everywhere,
    # closer than |offset| nowhere
    back = brute.distance_to_outline(brute.period_points(nominal, 40), moved)
    assert back.min() >= abs(offset) - RIGHT * gear.tip_radius
    check_side(nominal, points, offset)


def check_side(nominal: Profile, points: np.ndarray, offset: float) -> None:
    """Points farther out than the sampling of a polygon can doubt lie in the space (offset > 0) or the metal."""
    outline = brute.polygon(nominal, 200)
    metal = shapely.Polygon(np.column_stack([outline.real, outline.imag]))
    shapely.prepare(metal)
    if abs(offset) > 1e-4:
        inside = shapely.contains_xy(metal, points.real, points.imag)
        assert inside.all() if offset < 0 else not inside.any()


@pytest.mark.sampled(2)
@pytest.mark.parametrize("share", SHARES)
@pytest.mark.parametrize("name", GEARS)
def test_path_at_its_distance(name: str, share: float) -> None:
    gear = GEARS[name]
    offset = share * gear.module
    check_path(gear, offset)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("share", [0.0375, 0.2, -0.0375, -0.2])
@pytest.mark.parametrize("name", ["z23", "undercut", "relief", "full round", "shifted out"])
def test_nothing_is_missing_from_the_path(name: str, share: float) -> None:
    """The enclosed area against shapely's buffer of a dense polygon; a missing corner or space would show."""
    gear = GEARS[name]
    offset = share * gear.module
    outline = brute.polygon(tooth_side(gear).profile(), 500)
    buffered = shapely.Polygon(np.column_stack([outline.real, outline.imag])).buffer(offset, quad_segs=90)
    largest = max(getattr(buffered, "geoms", [buffered]), key=lambda g: g.area)
    filled = shapely.Polygon(largest.exterior)
    area = profile_area(gear_region(gear, offset).region.outer)
    assert abs(area / filled.area - 1) <= 2e-6


@pytest.mark.sampled(1)
@pytest.mark.parametrize("distance", [0.05, -0.05])
def test_path_against_fifty_digits(distance: float) -> None:
    """The oracle knows neither involute nor trochoid; its signed distance is the offset itself, corners included."""
    for name in some_of(("z23", "undercut", "relief"), 2):
        gear = GEARS[name]
        parameters = brute.exact_parameters(gear)
        moved = gear_region(gear, distance).region.outer
        for point in brute.period_points(moved, 3):
            found = float(exact_gear.normal_distance(complex(point), parameters))
            assert abs(found - distance) <= RIGHT * gear.tip_radius


@pytest.mark.sampled(7)
@pytest.mark.parametrize("name", GEARS)
def test_print_offset_against_the_swept_rack(name: str) -> None:
    """Into the metal the penetration is minus the distance, exactly, below the tip."""
    gear = GEARS[name]
    moved = gear_region(gear, -0.05).region.outer
    flanks = [s.curve for s in moved.period if s.label in (Label.FLANK, Label.ROOT_FILLET, Label.ROOT_LAND)]
    points = np.concatenate([brute.dense(c, 20) for c in flanks])
    error = rack_sweep.clearance_error(points, -0.05, brute.rack_tool(gear), gear.number_of_teeth)
    assert error.max() <= RIGHT * gear.tip_radius


@examples(12)
@given(gears(), numbers(-0.25, 0.35).filter(lambda s: abs(s) > 1e-3))
def test_path_of_any_gear(gear: SpurGear, share: float) -> None:
    offset = share * gear.module
    try:
        gear_region(gear, offset)
    except OffsetError as error:
        assert_remedy_works(gear, error)
    else:
        check_path(gear, offset)


@pytest.mark.parametrize("offset", [0.05, -0.05])
def test_families_are_kept(offset: float) -> None:
    """Involutes stay involutes of their base circle, fillets fillets of their rack position."""
    gear = GEARS["z23"]
    kinds = {Label.FLANK: Involute, Label.ROOT_FILLET: TrochoidFillet, Label.ROOT_LAND: Arc, Label.TIP_LAND: Arc}
    period = gear_region(gear, offset).region.outer.period
    for segment in period:
        assert isinstance(segment.curve, kinds.get(segment.label, Arc))
    assert {s.label for s in period} == set(kinds) | ({Label.CORNER} if offset > 0 else set())
    flank = next(s.curve for s in period if s.label is Label.FLANK)
    fillet = next(s.curve for s in period if s.label is Label.ROOT_FILLET)
    assert flank.base_radius == gear.base_radius
    assert fillet.tip_radius == pytest.approx(gear.rounding_radius - offset, rel=1e-14)
    assert (fillet.depth, fillet.pitch_radius) == (gear.rounding_depth, gear.reference_radius)


def test_corner_arcs_stand_about_the_corners() -> None:
    """An outward offset rounds each convex corner by an arc of the offset's radius about it."""
    for name, corners in (("z23", 2), ("undercut", 4), ("relief", 4), ("chamfer", 4)):
        period = gear_region(GEARS[name], 0.05).region.outer.period
        arcs = [s.curve for s in period if s.label is Label.CORNER]
        assert len(arcs) == corners, name
        nominal = tooth_side(GEARS[name]).profile()
        joints = np.array([complex(s.curve.point(s.curve.domain[0])) for s in nominal.period])
        for arc in arcs:
            assert arc.radius == pytest.approx(0.05, rel=1e-12)
            assert np.abs(joints - arc.centre).min() <= 1e-12 * GEARS[name].tip_radius


def test_a_chamfer_stays_a_line() -> None:
    period = gear_region(GEARS["chamfer"], -0.05).region.outer.period
    assert {type(s.curve) for s in period if s.label is Label.TIP_BREAK} == {Line}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", GEARS)
@pytest.mark.parametrize("share", [0.40, 0.6, 1.2])
def test_trimmed_cusps(name: str, share: float) -> None:
    """Past the fillet's least radius of curvature the path is trimmed and reported, not refused (theory note A10 i)."""
    gear = GEARS[name]
    offset = share * gear.module
    fillet = next(s.curve for s in tooth_side(gear).segments if s.label is Label.ROOT_FILLET)
    t = np.linspace(*fillet.domain, 4001)
    bend = np.abs((np.conj(fillet.derivative(t)) * fillet.derivative(t, 2)).imag / np.abs(fillet.derivative(t)) ** 3)
    try:
        made = gear_region(gear, offset)
    except OffsetError as error:
        assert_remedy_works(gear, error)
        return
    codes = {f.code for f in made.findings}
    cusped = offset > 1 / bend.max()
    assert ("fillet_cusp_trimmed" in codes) == cusped
    check_path(gear, offset)


def assert_remedy_works(gear: SpurGear, error: OffsetError) -> None:
    """The number that the refusal offers is built, and a thousandth further is refused."""
    value = brute.works(error)
    asked = float(error.value)  # type: ignore[arg-type]
    assert 0 <= value / asked < 1
    check_path(gear, value) if value else None
    with pytest.raises(GeometryError):
        gear_region(gear, value + 1e-3 * (asked - value))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", GEARS)
@pytest.mark.parametrize("share", [8.0, 30.0, -3.0, -30.0])
def test_a_refused_kerf_names_the_largest_that_works(name: str, share: float) -> None:
    gear = GEARS[name]
    size = gear.tip_radius if abs(share) == 30.0 else 1.0  # far beyond everything, and not so far
    with pytest.raises(OffsetError) as caught:
        gear_region(gear, share * gear.module * size)
    assert caught.value.name == "offset"
    assert_remedy_works(gear, caught.value)


@pytest.mark.parametrize("place", [0, 3, -1])
def test_the_check_sees_a_moved_piece(place: int) -> None:
    """Negative control: one piece of the path moved by a millionth of its offset is caught, wherever it is."""
    gear, offset = GEARS["z23"], 0.05
    nominal, moved = tooth_side(gear).profile(), gear_region(gear, offset).region.outer
    curve = moved.period[place].curve
    spoiled = brute.dense(curve, 60) + 1e-6 * offset * 1j * curve.tangent(np.linspace(*curve.domain, 60))
    found = np.abs(brute.distance_to_outline(spoiled, nominal) - offset)
    assert found.max() > 1e-8 * offset * 50
    assert found.max() > RIGHT * gear.tip_radius


def test_bores_grow_the_other_way() -> None:
    """An outward offset narrows a bore; a bore that closes is refused with the offset that works."""
    gear = replace(GEARS["z23"], bore_diameter=10.0)
    for offset in (0.075, -0.075):
        hole = gear_region(gear, offset).region.holes[0]
        assert {s.curve.radius for s in hole.period} == {5.0 - offset}
        assert profile_area(hole) == pytest.approx(-math.pi * (5.0 - offset) ** 2, rel=1e-13)
    small = replace(gear, bore_diameter=0.1)
    with pytest.raises(OffsetError) as caught:
        gear_region(small, 0.06)
    value = brute.works(caught.value)
    assert gear_region(small, value)


def test_a_rim_that_vanishes_is_refused() -> None:
    gear = replace(GEARS["z23"], bore_diameter=40.8)
    with pytest.raises(OffsetError) as caught:
        gear_region(gear, -0.06)
    value = brute.works(caught.value)
    assert -0.05 <= value < -0.0499
    assert gear_region(gear, value)


@pytest.mark.parametrize("offset", [math.nan, math.inf, -math.inf, 1e300, -1e300])
def test_hostile_offsets_are_refused(offset: float) -> None:
    with pytest.raises(ParameterError):
        gear_region(GEARS["z23"], offset)


@pytest.mark.parametrize("deepest", [0.3, 1.0])
def test_a_tip_rounding_shrinks_with_a_chamfer_to_no_less_than_a_quarter(deepest: float) -> None:
    """0.5 of a rounding lose 0.3 of it where the chamfer is 0.3 deep; of one of 1 mm 0.375, evenly with its depth.

    Where it does not shrink as it is chamfered its face is no cone, and the arc is told as any curve.
    """
    gear = SpurGear(3.0, 20, iso_53(), tip_rounding=0.5)
    shrinking = 1.0 if deepest < 0.375 else 0.375 / deepest
    for share in (0.0, 0.4, 1.0):
        depth = share * deepest
        outline = chamfered_outline(gear, 0.0, depth, deepest)
        breaks = [s.curve for s in outline.period if s.label is Label.TIP_BREAK]
        assert len(breaks) == 2
        for curve in breaks:
            points = curve.point(np.linspace(*curve.domain, 9))
            middle = points[4]
            # a circle through three of its points
            a, b = points[0] - middle, points[8] - middle
            centre = middle - 1j * (abs(a) ** 2 * b - abs(b) ** 2 * a) / (2 * (a.conjugate() * b).imag)
            assert np.abs(points - centre) == pytest.approx(0.5 - shrinking * depth, rel=1e-9)
            assert isinstance(curve, Arc) == (deepest < 0.375)
        assert all(isinstance(s.curve, Arc) for s in outline.period if s.label in (Label.TIP_LAND, Label.ROOT_LAND))
        # segment for segment the outline itself, its tips lower by the depth
        assert [s.label for s in outline.period] == [s.label for s in tooth_side(gear).profile().period]
        land = next(s.curve for s in outline.period if s.label is Label.TIP_LAND)
        assert np.abs(land.point(land.domain[0])) == pytest.approx(gear.tip_radius - depth, rel=1e-12)


def test_a_sharp_tip_stays_sharp_in_a_chamfer() -> None:
    outline = chamfered_outline(SpurGear(3.0, 20, iso_53()), 0.1, 0.5, 1.0)
    assert Label.TIP_BREAK not in {s.label for s in outline.period}
    assert all(isinstance(s.curve, Arc) for s in outline.period if s.label in (Label.TIP_LAND, Label.ROOT_LAND))

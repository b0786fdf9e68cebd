"""Cycloidal gears: what the mate's radii sweep, parallels against a buffer, contact with negative controls, limits."""

from __future__ import annotations

import cmath
import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import OffsetError, ParameterError, PointedTipError
from geometry.base.record import replace
from geometry.curves.line_arc import Line
from geometry.gears.cycloidal.gear import (
    CycloidalGear,
    checked_cycloidal_gear,
    cycloidal_findings,
    cycloidal_side,
)
from geometry.gears.cycloidal.pair import CycloidalMesh, CycloidalPair
from geometry.gears.mesh.search import least_gaps
from geometry.gears.teeth.offset import toothed_region
from geometry.plane.distance import Boundary, Verdict
from geometry.plane.profile import Label
from tests.sampling import examples
from tests.strategies import numbers

MODULE = 2.0


def clockwork(teeth: int, mate: int, **more: float) -> CycloidalGear:
    """A gear with straight roots for a mate with straight roots."""
    gear = CycloidalGear(teeth, MODULE, MODULE * mate / 4, MODULE * teeth / 4)
    return checked_cycloidal_gear(replace(gear, **more))


def drawn(teeth: int, tip: float, root: float, **more: float) -> CycloidalGear:
    """A gear drawn by two circles of given radii."""
    return checked_cycloidal_gear(replace(CycloidalGear(teeth, MODULE, tip, root), **more))


GEARS = {
    "wheel": clockwork(60, 8),
    "pinion": clockwork(8, 60),
    "curved roots": drawn(30, 5.0, 6.0),
    "deep pinion": clockwork(7, 90, addendum_coefficient=0.8, dedendum_coefficient=1.6),
    "full round": clockwork(12, 40, given_root_rounding=CycloidalGear(12, MODULE, 20.0, 6.0).greatest_rounding),
    "sharp roots": clockwork(20, 20, given_root_rounding=0.0),
    "thin": clockwork(15, 30, circumferential_thinning=0.4),
}
EVERY = pytest.mark.parametrize("gear", GEARS.values(), ids=GEARS.keys())
# of one pair each: straight roots, and a set of interchangeable gears of one circle
PAIRS = {
    "60 / 8": (clockwork(60, 8), clockwork(8, 60)),
    "8 / 60": (clockwork(8, 60), clockwork(60, 8)),
    "equal": (clockwork(30, 30), clockwork(30, 30)),
    "one circle": (drawn(20, 5.0, 5.0), drawn(35, 5.0, 5.0)),
    "two circles": (drawn(20, 7.0, 4.0), drawn(35, 4.0, 7.0)),
}
EVERY_PAIR = pytest.mark.parametrize("gears", PAIRS.values(), ids=PAIRS.keys())


def polygon(gear: CycloidalGear, offset: float, samples: int = 60) -> shapely.Polygon:
    """The outline by dense points."""
    curves = [s.curve for s in toothed_region(cycloidal_side, gear, offset).region.outer.segments()]
    points = np.concatenate([c.point(np.linspace(*c.domain, samples))[:-1] for c in curves])
    return shapely.Polygon(np.column_stack([points.real, points.imag]))


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("teeth", "mate"), [(60, 8), (8, 60), (25, 30)])
def test_tips_are_what_the_mates_radii_leave(teeth: int, mate: int) -> None:
    """The mate's straight root flank, carried through all positions, touches every point of the tip and cuts none."""
    gear, other = clockwork(teeth, mate), MODULE * mate / 2
    flank = gear.tip_flank()
    points = flank.point(np.linspace(0.02, 0.98, 25) * gear.tip_roll) * cmath.rect(1.0, -gear.begins)
    # the gear turns by -u while the mate turns by u r / r_2; at u = 0 its radius lies on the line of centres
    u = np.linspace(0.0, 1.3 * gear.tip_roll, 200_001)
    axis, radius = gear.pitch_radius + other, -np.exp(1j * u * gear.pitch_radius / other)
    for point in points:
        height = (np.conj(radius) * (point * np.exp(-1j * u) - axis)).imag
        least = np.abs(height).argmin()
        assert 0 < least < len(u) - 1
        assert abs(height[least]) < 1e-9 * gear.pitch_radius
        assert (height > -1e-9 * gear.pitch_radius).all() or (height < 1e-9 * gear.pitch_radius).all()


@EVERY
def test_roots_are_straight_where_their_circle_is_half_the_pitch_circle(gear: CycloidalGear) -> None:
    root = next(s.curve for s in cycloidal_side(gear).segments if s.label is Label.FLANK)
    assert isinstance(root, Line) == (gear.root_rolling_radius == gear.pitch_radius / 2)
    if isinstance(root, Line):
        assert abs(cmath.phase(root.start / root.end)) < 1e-12


@pytest.mark.sampled(2)
@pytest.mark.parametrize("offset", [-0.25, -0.05, 0.03, 0.2, 0.45])
@EVERY
def test_a_parallel_is_that_of_a_buffer(gear: CycloidalGear, offset: float) -> None:
    """Between a kerf of 0.9 mm outwards, beyond the fillets, and a print offset that the cusps would run back in."""
    if gear is GEARS["full round"] and offset > 0.4:
        offset = 0.3
    exact, thick = polygon(gear, offset), polygon(gear, 0.0).buffer(offset, quad_segs=48)
    assert exact.is_valid
    # chords of both leave out less than this
    assert exact.symmetric_difference(thick).area < 2e-5 * exact.length


@pytest.mark.sampled(1)
@EVERY_PAIR
def test_mates_touch_all_round_and_pushed_ones_overlap(gears: tuple[CycloidalGear, CycloidalGear]) -> None:
    pair, push = CycloidalPair(*gears), 1e-4
    assert not pair.findings()
    found = CycloidalMesh(pair).contact()
    assert found.verdict is Verdict.CONTACT
    assert np.abs(found.side_gaps).max(axis=1).min() < 1e-10 * MODULE
    pushed = CycloidalMesh(pair, second_turn=push / gears[1].pitch_radius).contact()
    assert pushed.verdict is Verdict.OVERLAP
    assert pushed.worst.gap == pytest.approx(-push, rel=1e-3)
    apart = CycloidalMesh(pair, distance_shift=0.01).contact()
    assert (apart.verdict, apart.worst.gap > 0) == (Verdict.CLEAR, True)
    assert CycloidalMesh(pair, distance_shift=-0.01).contact().verdict is Verdict.OVERLAP


@pytest.mark.sampled(3)
@EVERY_PAIR
def test_contact_is_found_beside_the_cusps_too(gears: tuple[CycloidalGear, CycloidalGear]) -> None:
    """Near the pitch point both flanks bend without bound, and distances look alike at every scale."""
    # half a tooth from the line of centres its flank passes the pitch point
    beside = 2.0 ** -np.arange(2, 24)
    drive = gears[0].pitch_angle * np.concatenate([0.25 + beside, 0.25 - beside])
    gaps = least_gaps(CycloidalMesh(CycloidalPair(*gears)), drive).gap.reshape(-1, 2)
    assert np.abs(gaps).max() < 1e-9 * MODULE


@pytest.mark.heavy
@EVERY_PAIR
def test_gaps_of_a_pair_are_those_of_its_polygons(gears: tuple[CycloidalGear, CycloidalGear]) -> None:
    """An oracle without our search: outlines of many corners, set in place by shapely, at some drive angles."""
    thin = [replace(g, circumferential_thinning=0.2) for g in gears]
    pair = CycloidalPair(checked_cycloidal_gear(thin[0]), checked_cycloidal_gear(thin[1]))
    found = CycloidalMesh(pair).contact()
    assert found.verdict is Verdict.CLEAR
    first, second = (polygon(g, 0.0, 120) for g in thin)
    for k in range(0, len(found.drive_angles), 9):
        drive = found.drive_angles[k]
        one = shapely.affinity.rotate(first, drive, origin=(0, 0), use_radians=True)
        two = shapely.affinity.rotate(second, pair.second_rotation(drive), origin=(0, 0), use_radians=True)
        two = shapely.affinity.translate(two, pair.centre_distance)
        assert one.distance(two) == pytest.approx(found.gaps[k], abs=2e-4)
    # flanks at 0.2 mm of play on the pitch circles, each side half of it, less where their normal leans
    steepest = max(pair.greatest_pressure_angles)
    assert 0.2 * math.cos(steepest) * 0.97 < found.worst.gap < 0.2


@examples(6)
@given(
    teeth=st.tuples(st.integers(6, 120), st.integers(6, 120)),
    circles=st.tuples(numbers(0.3, 1.0), numbers(0.3, 1.0)),
    heights=st.tuples(numbers(0.3, 0.9), numbers(0.3, 0.9)),
)
def test_any_two_gears_of_the_same_circles_touch(
    teeth: tuple[int, int], circles: tuple[float, float], heights: tuple[float, float]
) -> None:
    """Interchangeable or straight: what draws the tips of one draws the roots of the other."""
    one, two = (share * MODULE * z / 4 for share, z in zip(circles, teeth, strict=True))
    try:
        first = drawn(teeth[0], two, one, addendum_coefficient=heights[0])
        second = drawn(teeth[1], one, two, addendum_coefficient=heights[1])
    except ParameterError:
        return
    pair = CycloidalPair(first, second)
    found = CycloidalMesh(pair).contact()
    assert found.worst.gap > -1e-8 * MODULE
    if pair.contact_ratio > 1.001 and not pair.findings():
        assert found.verdict is Verdict.CONTACT


@EVERY_PAIR
def test_contact_ends_where_the_tips_leave_the_rolling_circle(gears: tuple[CycloidalGear, CycloidalGear]) -> None:
    pair = CycloidalPair(*gears)
    for gear in gears:
        corner = complex(gear.tip_flank().point(gear.tip_roll)) * cmath.rect(1.0, -gear.begins)
        assert abs(corner) == pytest.approx(gear.tip_radius, rel=1e-12)
        circle = gear.pitch_radius + gear.tip_rolling_radius
        turned = corner * np.exp(-1j * np.linspace(0.0, 3 * gear.tip_roll, 300_001))
        off = np.abs(np.abs(turned - circle) - gear.tip_rolling_radius)
        assert np.linspace(0.0, 3 * gear.tip_roll, 300_001)[off.argmin()] == pytest.approx(gear.tip_roll, rel=1e-4)
        # chord through the pitch point: the pressure angle there
        there = corner * cmath.rect(1.0, -gear.tip_roll) - gear.pitch_radius
        lean = pair.greatest_pressure_angles[0 if gear is gears[0] else 1]
        assert math.pi / 2 - abs(cmath.phase(there)) == pytest.approx(lean, abs=1e-9)
    total = sum(g.tip_roll / g.pitch_angle for g in gears)
    assert pair.contact_ratio == pytest.approx(total, rel=1e-14)
    assert pair.recess_ratio == pytest.approx(gears[0].tip_roll * gears[0].number_of_teeth / (2 * math.pi))


def test_what_goes_wrong_between_two_gears_is_told() -> None:
    short = clockwork(60, 8, addendum_coefficient=0.3), clockwork(8, 60, addendum_coefficient=0.2)
    assert [f.code for f in CycloidalPair(*short).findings()] == ["contact_ratio"]
    high = clockwork(60, 8, addendum_coefficient=1.3), clockwork(8, 60)
    (finding,) = CycloidalPair(*high).findings()
    assert (finding.code, finding.value) == ("tip_clearance_second", pytest.approx(-0.05 * MODULE))
    assert CycloidalMesh(CycloidalPair(*high)).contact().verdict is Verdict.OVERLAP
    # fillets as high as the mate's tips come down
    rounded = clockwork(8, 60, given_root_rounding=1.3)
    assert [f.code for f in CycloidalPair(clockwork(60, 8, addendum_coefficient=1.2), rounded).findings()] == []
    deep = clockwork(30, 30, given_root_rounding=1.5, dedendum_coefficient=1.05)
    (finding,) = CycloidalPair(clockwork(30, 30), deep).findings()
    assert finding.code == "contact_below_flank_second"
    assert finding.value < finding.limit


def test_a_pointed_tip_has_its_limit() -> None:
    gear = clockwork(60, 8)
    most = (gear.pointed_radius - gear.pitch_radius) / MODULE
    whole = checked_cycloidal_gear(replace(gear, addendum_coefficient=most * (1 - 5e-5)))
    assert 0 < whole.tip_thickness < 1e-3 * MODULE
    assert [f.code for f in cycloidal_findings(whole)] == ["thin_tip"]
    with pytest.raises(PointedTipError) as caught:
        checked_cycloidal_gear(replace(gear, addendum_coefficient=most * 1.001))
    assert caught.value.nearest is not None
    assert caught.value.nearest.value == pytest.approx(most, abs=2e-4)
    # a small circle comes down again before the middle of the tooth
    small = CycloidalGear(60, MODULE, 0.5, 30.0, addendum_coefficient=0.4)
    assert small.pointed_radius == pytest.approx(61.0)
    # and a pinion's tip is pointed though the mate's circle is far larger than the pinion
    pinion = clockwork(8, 60)
    half = -pinion.begins
    angle = np.linspace(0, 1.5, 300_001)
    path = pinion.tip_flank().point(angle)
    first = angle[np.flatnonzero(np.unwrap(np.angle(path)) >= 0)[0]]
    assert half > 0
    assert abs(complex(pinion.tip_flank().point(first))) == pytest.approx(pinion.pointed_radius, rel=1e-5)


@EVERY
def test_a_full_round_touches_both_teeth(gear: CycloidalGear) -> None:
    """A circle in the middle of the space that touches the root circle is as far from either flank."""
    radius = gear.greatest_rounding
    centre = cmath.rect(gear.root_radius + radius, -gear.pitch_angle / 2)
    side = cycloidal_side(replace(gear, given_root_rounding=radius))
    assert Label.ROOT_LAND not in [s.label for s in side.segments]
    feet = Boundary(tuple(s.curve for s in side.segments)).feet(np.array([centre]))
    assert feet.distance[0] == pytest.approx(radius, rel=1e-9)
    with pytest.raises(ParameterError) as caught:
        checked_cycloidal_gear(replace(gear, given_root_rounding=radius * 1.001))
    assert caught.value.name == "root_rounding"


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("circle", "depth"), [(2.0, 0.3), (1.0, 0.3), (6.0, 0.15)])
def test_the_greatest_fillet_of_a_shallow_root_passes_through_the_pitch_point(circle: float, depth: float) -> None:
    """A circle that touches root circle and flank and cuts nothing of it: before, it cut by 0.2 % of its radius."""
    gear = CycloidalGear(30, MODULE, 5.0, circle, dedendum_coefficient=depth)
    radius, flank = gear.greatest_rounding, gear.root_flank()
    points = flank.point(np.linspace(flank.start, 0.0, 200_001))
    # the circle of that radius on the root circle that is nearest to the flank and still free of it
    far = gear.root_radius + radius
    high = cmath.phase(complex(points[-1]))
    low = high - gear.pitch_angle / 2
    for _ in range(60):
        middle = (low + high) / 2
        free = np.abs(points - cmath.rect(far, middle)).min() >= radius
        low, high = (middle, high) if free else (low, middle)
    centre = cmath.rect(far, low)
    assert abs(centre - points[-1]) == pytest.approx(radius, rel=1e-7)
    # it touches the flank within too: a larger one does so beyond the pitch circle
    assert np.abs(points[:-1000] - centre).min() == pytest.approx(radius, rel=1e-7)


def test_a_flank_that_a_parallel_has_eaten_is_told() -> None:
    """Tips of 2 um on curved roots: the parallels of both flanks cross beyond them."""
    gear = drawn(20, 14.0, 2.0, addendum_coefficient=0.001, dedendum_coefficient=0.56)
    with pytest.raises(OffsetError) as caught:
        toothed_region(cycloidal_side, gear, 0.6)
    assert caught.value.reason == "leaves_no_flank"
    most = caught.value.nearest_offset
    exact, thick = polygon(gear, most), polygon(gear, 0.0).buffer(most, quad_segs=48)
    assert exact.is_valid
    assert exact.symmetric_difference(thick).area < 2e-5 * exact.length


def test_offsets_end_where_spaces_close_and_teeth_vanish() -> None:
    gear = clockwork(60, 8)
    for offset, code in ((1.6, "closes_tooth_spaces"), (-1.9, "leaves_no_tooth")):
        with pytest.raises(OffsetError) as caught:
            toothed_region(cycloidal_side, gear, offset)
        assert caught.value.reason == code
        limit = caught.value.nearest
        assert limit is not None
        assert isinstance(limit.value, float)
        toothed_region(cycloidal_side, gear, limit.value)
        assert 0 < limit.value / offset < 1
        if offset > 0:
            # straight flanks, half of a space of 6 degrees apart: a circle between them about the root's middle
            sine = math.sin(gear.pitch_angle / 4)
            most = gear.root_radius * sine / (1 - sine)
            assert limit.value == pytest.approx(most, abs=1e-5)
            with pytest.raises(OffsetError, match=code):
                cycloidal_side(gear, most * (1 + 1e-6))
    # pointed before it vanishes
    high = clockwork(60, 8, addendum_coefficient=1.3)
    assert [[f.code for f in toothed_region(cycloidal_side, high, by).findings] for by in (-0.5, -0.8)] == [
        [],
        ["tip_lost"],
    ]


def test_a_mill_that_is_too_thick_for_the_fillet_is_told_of() -> None:
    """A mill of 0.5 mm in roots rounded by a fifth of a module of 0.6 mm; it was told of spur gears alone."""
    gear = checked_cycloidal_gear(CycloidalGear(64, 0.6, 1.2, 9.6))
    assert gear.root_rounding == pytest.approx(0.12)
    assert cycloidal_side(gear, 0.12).findings == ()
    (told,) = cycloidal_side(gear, 0.25).findings
    assert (told.code, told.value, told.limit) == ("fillet_cusp_trimmed", 0.25, pytest.approx(0.12))
    assert cycloidal_side(replace(gear, given_root_rounding=0.25), 0.25).findings == ()

"""Contours, areas and distances against shapely, dense polygons and brute force, each with a negative control."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from geometry.approximation.chords import approximate_profile
from geometry.base.errors import DisconnectedProfileError
from geometry.base.placement import Placement2
from geometry.curves.curve import end_point, start_point
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.gears.teeth.basic_rack import TipRelief, iso_53
from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.plane.contour import Contour, edge_points, signed_area
from geometry.plane.measure import distance_to_chain, distance_to_curve, distance_to_profile, profile_area
from geometry.plane.profile import Label, Profile, Segment, circle, joint_turn
from tests import brute
from tests.sampling import examples
from tests.strategies import angles, gears, numbers, points

GEARS = {
    "z23": SpurGear(2.0, 23, iso_53()),
    "z8 undercut": SpurGear(2.0, 8, iso_53("C"), 0.1),
    "z3": SpurGear(1.0, 3, iso_53("A", math.radians(25)), 0.5, given_tip_diameter=5.0),
    "z200": SpurGear(0.3, 200, iso_53("D")),
    "relief": SpurGear(2.0, 23, iso_53(relief=TipRelief(0.02))),
    "chamfer": SpurGear(2.0, 23, iso_53(), tip_chamfer=0.2),
    "rounding": SpurGear(2.0, 23, iso_53(), tip_rounding=0.15),
}
EVERY = pytest.mark.parametrize("gear", GEARS.values(), ids=GEARS.keys())
bulges = st.one_of(st.just(0.0), numbers(-1, -1e-3), numbers(1e-3, 1))


@examples(150)
@given(points, numbers(0.01, 20), angles, bulges)
def test_edge_points_lie_on_the_arc(start: complex, length: float, angle: float, bulge: float) -> None:
    end = start + length * np.exp(1j * angle)
    found = edge_points(np.array([start]), np.array([end]), np.array([bulge]), np.linspace(0, 1, 9))[0]
    allowed = 1e-11 * (abs(start) + length / max(abs(bulge), 1e-3))
    assert np.max(np.abs(found - brute.arc_points(start, end, bulge, 9))) <= allowed
    if bulge != 0:
        # a bulge is the height of the arc over half its chord, positive where it turns left (bulging right)
        height = ((found[4] - start) * np.conj((end - start) / length)).imag
        assert abs(height + bulge * length / 2) <= 1e-12 * (abs(start) + length)


@examples(80)
@given(st.lists(st.tuples(numbers(5, 20), bulges), min_size=3, max_size=9))
def test_signed_area_against_polygons_and_shapely(corners: list[tuple[float, float]]) -> None:
    n = len(corners)
    vertices = np.array([r * np.exp(2j * math.pi * k / n) for k, (r, _) in enumerate(corners)])
    sizes = np.array([0.3 * b for _, b in corners])
    ends = np.roll(vertices, -1)
    areas = []
    for count in (2001, 4001):  # polygons of two densities, then Richardson: error of order count^-4
        outline = np.concatenate(
            [brute.arc_points(s, e, b, count)[:-1] for s, e, b in zip(vertices, ends, sizes, strict=True)]
        )
        areas.append(0.5 * float(np.sum((np.conj(outline) * np.roll(outline, -1)).imag)))
    ring = shapely.LinearRing(np.column_stack([outline.real, outline.imag]))
    if ring.is_simple:
        assert abs(areas[1]) == pytest.approx(shapely.Polygon(ring).area, rel=1e-12)
        assert (areas[1] > 0) == ring.is_ccw
    assert signed_area(vertices, sizes) == pytest.approx((4 * areas[1] - areas[0]) / 3, rel=1e-9)
    backwards = signed_area(vertices[::-1], -np.roll(sizes[::-1], -1))
    assert backwards == pytest.approx(-signed_area(vertices, sizes), rel=1e-12)


@pytest.mark.parametrize("index", [0, 3, 6])
def test_signed_area_sees_a_moved_vertex(index: int) -> None:
    vertices, bulge = 10 * np.exp(2j * math.pi * np.arange(7) / 7), np.zeros(7)
    moved = vertices.copy()
    moved[index] *= 1.01
    gained = 0.5 * 0.1 * 2 * 10 * math.sin(2 * math.pi / 7)
    assert signed_area(moved, bulge) - signed_area(vertices, bulge) == pytest.approx(gained, rel=1e-9)


def test_expansion_of_a_contour() -> None:
    contour = Contour(np.array([1 + 0j, 2 + 0.5j]), np.array([0.1, 0.2]), 5)
    vertices, bulge = contour.expanded()
    assert len(contour) == len(vertices) == len(bulge) == 10
    assert np.allclose(vertices[2:], vertices[:-2] * np.exp(2j * math.pi / 5), rtol=0, atol=1e-15)
    assert np.allclose(contour.period_ends(), vertices[1:3], rtol=0, atol=1e-15)


@EVERY
def test_profile_area_against_polygons(gear: SpurGear) -> None:
    profile = tooth_side(gear).profile()
    areas = []
    for count in (400, 800):
        p = brute.polygon(profile, count)
        areas.append(0.5 * float(np.sum((np.conj(p) * np.roll(p, -1)).imag)))
    assert profile_area(profile) == pytest.approx((4 * areas[1] - areas[0]) / 3, rel=1e-11)


def test_area_of_regions_and_circles() -> None:
    assert profile_area(circle(3.0, Label.BORE)) == pytest.approx(9 * math.pi, rel=1e-14)
    assert profile_area(circle(3.0, Label.BORE, hole=True)) == pytest.approx(-9 * math.pi, rel=1e-14)
    gear = SpurGear(2.0, 23, iso_53(), bore_diameter=10.0)
    region = gear_region(gear).region
    assert [profile_area(p) for p in region.holes] == pytest.approx([-25 * math.pi], rel=1e-14)
    square = [Line(a, b) for a, b in ((0j, 2 + 0j), (2 + 0j, 2 + 2j), (2 + 2j, 2j), (2j, 0j))]
    assert profile_area(Profile(tuple(Segment(c, Label.BORE) for c in square))) == pytest.approx(4, rel=1e-15)


def _probes(profile: Profile, rng: np.random.Generator) -> np.ndarray:
    """Points on, beside and far from the outline, about every joint, in several periods."""
    joints = np.array([start_point(s.curve) for s in profile.period])
    reach = profile.reach()
    around = [h * reach * np.exp(2j * math.pi * rng.random(joints.shape)) for h in (1e-9, 1e-4, 0.01)]
    near = np.concatenate([joints + step for step in around])
    on = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 7)) for s in profile.period])
    beside = on * (1 + 0.003 * (rng.random(on.shape) - 0.5))
    far = reach * (0.3 + 1.2 * rng.random(12)) * np.exp(2j * math.pi * rng.random(12))
    probes = np.concatenate([joints, near, on, beside, far])
    return probes * np.exp(2j * math.pi / profile.count * rng.integers(0, profile.count, len(probes)))


@pytest.mark.sampled(2)
@EVERY
def test_distance_to_profile_against_brute_force(gear: SpurGear) -> None:
    profile = tooth_side(gear).profile()
    probes = _probes(profile, np.random.default_rng(gear.number_of_teeth))
    exact = brute.distance_to_outline(probes, profile)
    assert np.max(np.abs(distance_to_profile(probes, profile) - exact)) <= 1e-12 * profile.reach()
    # the quick pass may only be trusted below its threshold, and is never too small
    quick = distance_to_profile(probes, profile, trusted=1e-3)
    assert np.all(quick >= exact - 1e-12 * profile.reach())
    assert np.all(np.abs(quick - exact)[exact > 1e-3] <= 1e-12 * profile.reach())


@settings(max_examples=5)
@given(gears(), st.integers(0, 10**6))
def test_distance_to_any_outline(gear: SpurGear, seed: int) -> None:
    profile = tooth_side(gear).profile()
    probes = _probes(profile, np.random.default_rng(seed))
    exact = brute.distance_to_outline(probes, profile)
    assert np.max(np.abs(distance_to_profile(probes, profile) - exact)) <= 1e-12 * profile.reach()


@pytest.mark.sampled(1)
@pytest.mark.parametrize("arcs", [True, False])
@pytest.mark.parametrize("place", ["start", "middle", "end"])
@EVERY
def test_distance_to_profile_sees_a_moved_vertex(gear: SpurGear, place: str, arcs: bool) -> None:
    """A vertex moved by twice the tolerance, across the outline, in the first, a middle and the last period."""
    profile, tolerance = tooth_side(gear).profile(), 0.005
    vertices = approximate_profile(profile, tolerance, arcs=arcs).geometry.expanded()[0]
    assert distance_to_profile(vertices, profile).max() <= 1e-12 * profile.reach()
    index = {"start": 1, "middle": len(vertices) // 2 + 1, "end": len(vertices) - 1}[place]
    turn = np.exp(2j * math.pi / profile.count * (index // (len(vertices) // profile.count)))
    local = vertices[index] / turn
    segment = min(profile.period, key=lambda s: float(np.abs(brute.dense(s.curve) - local).min()))
    at = np.argmin(np.abs(brute.dense(segment.curve) - local))
    tangent = complex(segment.curve.tangent(np.linspace(*segment.curve.domain, 400)[at]))
    vertices[index] += 2 * tolerance * 1j * tangent * turn
    found = distance_to_profile(vertices, profile)
    assert int(np.argmax(found)) == index
    assert tolerance < found[index] <= 2 * tolerance * (1 + 1e-9)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("way", [1, 1j])
def test_distances_from_a_long_chain_are_those_from_its_nearest_piece(way: complex) -> None:
    rng = np.random.default_rng(5)
    x = np.arange(121.0)
    # what is nearest to a point in the valley lies far beside it
    corners = way * (x + 1j * (2 * np.abs(x - 60) + rng.uniform(0, 3, 121)))
    corners[40:50] = corners[40]  # many samples on one spot
    chain = [Line(a, b) for a, b in pairwise(corners) if a != b]
    points = way * (rng.uniform(-30, 150, 4000) + 1j * rng.uniform(-40, 100, 4000))
    brute = shapely.LineString([(c.real, c.imag) for c in corners]).distance(shapely.points(points.real, points.imag))
    assert distance_to_chain(points, chain) == pytest.approx(brute, abs=1e-12)
    # the quick pass alone never tells less, and finds the nearest of dense pieces
    quick = distance_to_chain(points, chain, trusted=math.inf)
    assert (quick >= brute - 1e-12).all()
    assert np.mean(quick < brute + 1e-9) > 0.99


@pytest.mark.parametrize("place", [0, 2, 5])
def test_a_gap_in_a_chain_is_refused(place: int) -> None:
    profile = tooth_side(GEARS["z23"]).profile()
    segments = list(profile.period)
    curve = segments[place].curve
    low, high = curve.domain
    segments[place] = Segment(curve.trimmed(low, high - 1e-7 * (high - low)), segments[place].label)
    with pytest.raises(DisconnectedProfileError) as caught:
        Profile(tuple(segments), profile.count)
    assert caught.value.index == place + 1
    lost = abs(end_point(curve) - end_point(segments[place].curve))
    assert caught.value.gap == pytest.approx(lost, rel=1e-6)


def test_segments_run_through_every_period() -> None:
    profile = tooth_side(GEARS["z8 undercut"]).profile()
    chain = list(profile.segments())
    assert len(chain) == 8 * len(profile.period)
    for before, after in zip(chain, [*chain[1:], chain[0]], strict=True):
        assert abs(end_point(before.curve) - start_point(after.curve)) <= 1e-12 * profile.reach()


def test_points_beside_the_cusp_of_an_involute_lie_on_it() -> None:
    involute = Involute(2.0, 0.3, 0.0, 2.3)
    beside = involute.point(np.linspace(0.0, 0.03, 200))
    assert float(distance_to_chain(beside, [involute]).max()) < 1e-12
    off = beside + 1e-3 * 1j * involute.tangent(np.linspace(0.001, 0.03, 200))
    assert float(distance_to_chain(off, [involute]).min()) > 5e-5


def test_joint_turn_signs() -> None:
    """Positive where the material (on the left) has a convex corner."""
    assert joint_turn(Line(0j, 1 + 0j), Line(1 + 0j, 1 + 1j)) == pytest.approx(math.pi / 2)
    assert joint_turn(Line(0j, 1 + 0j), Line(1 + 0j, 1 - 1j)) == pytest.approx(-math.pi / 2)
    assert joint_turn(Arc(0j, 1.0, 0.0, 1.0), Arc(0j, 1.0, 1.0, 1.0)) == pytest.approx(0, abs=1e-15)


class Oval:
    """A shut curve that is one: its last point is the first, to the last digit."""

    domain = 0.0, 2 * math.pi

    def point(self, t: Any) -> np.ndarray:
        return self.derivatives(t, 0)[0]

    def derivatives(self, t: Any, order: int) -> list[np.ndarray]:
        turns = [np.mod(t, 2 * math.pi) + k * math.pi / 2 for k in range(order + 1)]
        return [50 * np.cos(x) + 30j * np.sin(x) for x in turns]


@pytest.mark.parametrize("off", [0.0, 0.3])
def test_points_on_both_sides_of_where_a_curve_is_shut(off: float) -> None:
    """Before: those beyond the seam were measured to it, where its first sample was the nearest one."""
    curve = Oval()
    t = np.concatenate([np.linspace(-0.09, 0.09, 30) % (2 * math.pi), np.linspace(1.0, 5.0, 9)])
    along = curve.derivatives(t, 1)[1]
    points = curve.point(t) - 1j * off * along / np.abs(along)
    assert distance_to_curve(points, curve) == pytest.approx(np.full(len(t), off), abs=1e-9)


def test_a_line_of_no_length_is_a_point() -> None:
    points = np.array([3.0 + 4.0j, 0j])
    assert distance_to_curve(points, Line(0j, 0j)).tolist() == [5.0, 0.0]


def test_arcs_and_involutes_are_asked_together(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each of 480 curves of a sector's teeth was asked alone: a crowned one took 27 s, now 12."""
    profile = tooth_side(SpurGear(2.0, 23, iso_53())).profile()
    curves = [s.curve.placed(Placement2(profile.pitch_angle * k)) for k in range(23) for s in profile.period]
    arcs = [c for c in curves if isinstance(c, Arc)]
    calls = []
    spoke = Arc._spoke
    monkeypatch.setattr(Arc, "_spoke", lambda arc, t: (calls.append(1), spoke(arc, t))[1])
    assert arcs
    points = np.concatenate([c.point(np.linspace(*c.domain, 5)) * 1.001 for c in curves])
    alone = distance_to_profile(points, profile)
    calls.clear()
    together = distance_to_chain(points, curves)
    assert len(calls) < 20
    assert np.abs(together - alone).max() < 1e-12

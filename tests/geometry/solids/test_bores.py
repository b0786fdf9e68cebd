"""Holes of wheels: areas in closed form, parallel curves by brute force, joints, refusals, and the published keys."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import shapely
from hypothesis import assume, given
from hypothesis import strategies as st

from geometry.base.errors import OffsetError, ParameterError
from geometry.base.record import replace
from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.plane.measure import distance_to_profile, profile_area
from geometry.plane.profile import Label, Profile, circle, joint_turn
from geometry.solids.bores import Bore, FlatBore, KeywayBore, PolygonBore, RoundBore
from geometry.solids.spline_standards import gost_6033, iso_4156
from geometry.solids.splines import SplineBore, StraightJoint
from geometry.solids.windows import RoundHoles, Spokes
from tests import brute
from tests.sampling import examples

Maker = Callable[[float], tuple[Profile, ...]]


def corners(profile: Profile) -> list[Curve]:
    return [s.curve for s in profile.period if s.label is Label.CORNER]


BORES: dict[str, Bore] = {
    "round": RoundBore(10.0),
    "keyway": KeywayBore(12.0, 4.0, 1.8, 0.16, 1, math.pi / 2),
    "two keyways": KeywayBore(12.0, 4.0, 1.8, 0.0, 2, 0.3),
    "round-bottomed keyway": KeywayBore(12.0, 3.0, 3.0, 1.5),
    "wide shallow keyway": KeywayBore(10.0, 9.5, 0.2, 0.1, 1, 2.0),
    "large keyway": KeywayBore(500.0, 100.0, 19.5, 2.5, 2),
    "D": FlatBore(5.0, 2.0, 1, 1.0),
    "D of almost half": FlatBore(5.0, 0.01),
    "D with a hint of a flat": FlatBore(5.0, 2.4999),
    "double D": FlatBore(5.0, 1.6, 2, -0.4),
    "hexagon": PolygonBore(6, 6.35),
    "rounded hexagon": PolygonBore(6, 6.35, 0.5, 0.2),
    "square": PolygonBore(4, 8.0, 0.0, 1.0),
    "rounded square": PolygonBore(4, 8.0, 3.99),
    "spline": SplineBore(StraightJoint(6, 23.0, 26.0, 6.0, 22.1), ("bore.size", ""), 0.0, 0.3),
    "loose heavy spline": SplineBore(StraightJoint(20, 112.0, 125.0, 9.0, 104.0, 0.5), ("bore.size", ""), 0.2),
    "involute spline": SplineBore(gost_6033(20.0, 1.0, 18, outer=False, root="flat"), ("bore.size", "")),
    "round-bottomed spline": SplineBore(iso_4156(10, 1.0, 37.5, "fillet"), ("bore.size", ""), 0.0, 1.0),
}
OTHERS: dict[str, Maker] = {
    "five holes": RoundHoles(5, 8.0, 30.0, 0.1).profiles,
    "a pin hole far out": RoundHoles(1, 0.01, 5000.0, 1.0).profiles,
    "five spokes": Spokes(5, 20.0, 40.0, 3.0, 1.0, 0.2).profiles,
    "two sharp spokes": Spokes(2, 20.0, 40.0, 3.0).profiles,
    "three spokes": Spokes(3, 20.0, 40.0, 3.0, 0.3).profiles,
    "windows nearly of three sides": Spokes(6, 20.0, 60.0, 9.9).profiles,
}
MAKERS: dict[str, Maker] = {
    **{name: (lambda d, b=bore: (b.profile(d),)) for name, bore in BORES.items()},  # type: ignore[misc]
    **OTHERS,
}


def limits(maker: Maker) -> tuple[float, float]:
    """The offsets nearest to the limits, as the refusals of absurd ones name them; -2 where growing has no end."""
    with pytest.raises(OffsetError) as caught:
        maker(1e6)
    highest = caught.value.nearest_offset
    try:
        maker(-1e6)
    except OffsetError as refusal:
        return refusal.nearest_offset, highest
    return -2.0, highest


def outline(profile: Profile, count: int = 300) -> np.ndarray:
    """Points along a profile, joints included."""
    return np.concatenate([brute.dense(s.curve, count) for s in profile.segments()])


def few_points(profile: Profile) -> np.ndarray:
    """Corners of lines and 60 chords a curve."""
    counts = [2 if isinstance(s.curve, Line) else 61 for s in profile.segments()]
    return np.concatenate([brute.dense(s.curve, n)[:-1] for s, n in zip(profile.segments(), counts, strict=True)])


def area_of_keyway(bore: KeywayBore, d: float = 0.0) -> float:
    """Circle, plus each keyway from the circle to its bottom, less the bottom's corners; not moved outwards."""
    radius, half, bottom = bore.diameter / 2 - d, bore.width / 2 - d, bore.diameter / 2 + bore.depth - d
    mouth, gamma = math.sqrt(radius**2 - half**2), math.asin(half / radius)
    cap = radius**2 * gamma - half * mouth
    corners = (2 - math.pi / 2) * (bore.corner_radius - d) ** 2
    return math.pi * radius**2 + bore.keys * (2 * half * (bottom - mouth) - cap - corners)


def area_of_flat(bore: FlatBore) -> float:
    radius, flat = bore.diameter / 2, bore.flat_distance
    beta = math.acos(flat / radius)
    return math.pi * radius**2 - bore.flats * (radius**2 * beta - flat * math.sqrt(radius**2 - flat**2))


def area_of_polygon(bore: PolygonBore) -> float:
    tangent = math.tan(math.pi / bore.sides)
    return (
        bore.sides * tangent * (bore.across_flats / 2) ** 2 - (bore.sides * tangent - math.pi) * bore.corner_radius**2
    )


@pytest.mark.parametrize("name", [name for name, bore in BORES.items() if not isinstance(bore, SplineBore)])
def test_areas_in_closed_form(name: str) -> None:
    bore = BORES[name]
    exact = {
        RoundBore: lambda: math.pi * bore.reach**2,
        KeywayBore: lambda: area_of_keyway(bore),  # type: ignore[arg-type]
        FlatBore: lambda: area_of_flat(bore),  # type: ignore[arg-type]
        PolygonBore: lambda: area_of_polygon(bore),  # type: ignore[arg-type]
    }[type(bore)]()
    bore.check()
    assert profile_area(bore.profile()) == pytest.approx(-exact, rel=1e-12)


@pytest.mark.parametrize("name", ["keyway", "two keyways", "large keyway"])
def test_a_grown_keyway_in_closed_form(name: str) -> None:
    bore = BORES[name]
    assert isinstance(bore, KeywayBore)
    assert profile_area(bore.profile(-0.3)) == pytest.approx(-area_of_keyway(bore, -0.3), rel=1e-12)
    # sharp corners of the bottom stay sharp where the hole is made wider
    wide = replace(bore, corner_radius=bore.corner_radius or -0.3)
    assert profile_area(bore.widened(0.3).profile()) == pytest.approx(-area_of_keyway(wide, -0.3), rel=1e-12)


@pytest.mark.parametrize("hole", [RoundBore(10.0), BORES["rounded hexagon"], Spokes(5, 20.0, 40.0, 3.0, 1.0, 0.2)])
def test_a_smooth_hole_made_wider_is_its_parallel(hole: Bore | Spokes) -> None:
    """Steiner: a closed curve without corners moved d outwards encloses A + L d + pi d^2."""
    one, wide = (h.profiles()[0] if isinstance(h, Spokes) else h.profile() for h in (hole, hole.widened(0.3)))
    length = float(np.abs(np.diff(outline(one), append=outline(one)[:1])).sum())
    exact = -profile_area(one) + length * 0.3 + math.pi * 0.3**2
    assert profile_area(wide) == pytest.approx(-exact, rel=1e-5)


def test_areas_of_windows_and_of_holes_far_from_the_axis() -> None:
    holes = RoundHoles(3, 0.01, 50_000.0, 0.4).profiles()
    assert [profile_area(p) for p in holes] == pytest.approx([-math.pi * 0.005**2] * 3, rel=1e-9)
    spokes = Spokes(5, 20.0, 40.0, 3.0)
    # ring less spokes: a strip of half width w between two circles
    strip = sum(
        sign * (1.5 * math.sqrt(r**2 - 1.5**2) + r**2 * math.asin(1.5 / r)) for sign, r in ((1, 20.0), (-1, 10.0))
    )
    ring = math.pi * (20.0**2 - 10.0**2) - 5 * strip
    assert sum(profile_area(p) for p in spokes.profiles()) == pytest.approx(-ring, rel=1e-12)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("share", [0.0, 0.02, 0.3, 0.97, -0.02, -0.3, -0.97])
@pytest.mark.parametrize("name", MAKERS)
def test_parallel_curves(name: str, share: float) -> None:
    """Every point at its distance from the nominal hole, the hole simple and clockwise, its joints closed."""
    maker = MAKERS[name]
    lowest, highest = limits(maker)
    d = share * (highest if share > 0 else -lowest)
    for nominal, moved in zip(maker(0.0), maker(d), strict=True):
        points = outline(moved)
        scale = float(np.abs(points).max())
        assert np.abs(brute.distance_to_outline(points, nominal) - abs(d)).max() <= 1e-10 * scale
        assert np.abs(distance_to_profile(points, nominal) - abs(d)).max() <= 1e-13 * scale
        assert profile_area(moved) < 0
        assert (abs(profile_area(moved)) < abs(profile_area(nominal))) == (d > 0) or d == 0
        chain = list(moved.segments())
        for before, after in zip(chain, [*chain[1:], chain[0]], strict=True):
            assert abs(end_point(before.curve) - start_point(after.curve)) <= 1e-13 * scale


@pytest.mark.sampled(10)
@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("name", MAKERS)
def test_offsets_against_shapely(name: str, sign: int) -> None:
    """The other way round too: nothing of the true parallel curve is missing."""
    maker = MAKERS[name]
    lowest, highest = limits(maker)
    d = 0.4 * highest if sign > 0 else 0.4 * lowest
    nominal, moved = maker(0.0)[0], maker(d)[0]
    # few points: shapely simplifies dense ones
    middle = complex(np.mean(outline(nominal)))
    rings = [shapely.Polygon([(z.real, z.imag) for z in few_points(p) - middle]) for p in (nominal, moved)]
    assert all(ring.is_valid for ring in rings)
    expected = rings[0].buffer(-d, quad_segs=64)
    assert brute.hausdorff(expected, rings[1]) <= 0.01 * abs(d)
    # negative control: 3 % more of an offset is seen at the same measure
    assert brute.hausdorff(rings[0].buffer(-1.03 * d, quad_segs=64), rings[1]) > 0.01 * abs(d)


@pytest.mark.parametrize("name", MAKERS)
def test_the_offset_that_is_named_works(name: str) -> None:
    maker = MAKERS[name]
    lowest, highest = limits(maker)
    for nearest in {lowest, highest}:
        maker(nearest)
        if nearest != -2.0:
            with pytest.raises(OffsetError):
                maker(nearest * (1 + 3e-6))
    for hostile in (math.nan, math.inf):
        with pytest.raises(OffsetError):
            maker(hostile)


def test_corners_are_rounded_or_cut_off_as_the_material_wants() -> None:
    """Out of the material a keyway's mouth gets arcs and its bottom stays sharp; into it, the other way round."""
    bore = KeywayBore(12.0, 4.0, 1.8)
    out, into = bore.profile(0.3), bore.profile(-0.3)
    for profile, centre in ((out, math.sqrt(32)), (into, 7.8)):
        arcs = [c for c in corners(profile) if isinstance(c, Arc)]
        assert [(a.centre.real, abs(a.centre.imag), a.radius) for a in arcs] == [pytest.approx((centre, 2.0, 0.3))] * 2
    turns = [joint_turn(a.curve, b.curve) for a, b in zip(out.period, out.period[1:], strict=False)]
    assert sorted(turns)[:2] == pytest.approx([-math.pi / 2] * 2)
    assert sorted(turns)[2:] == pytest.approx([0] * (len(turns) - 2), abs=1e-7)
    turns = [joint_turn(a.curve, b.curve) for a, b in zip(into.period, [*into.period[1:], into.period[0]], strict=True)]
    assert sorted(turns)[-2:] == pytest.approx([math.acos(2.3 / 6.3)] * 2)
    assert sorted(turns)[:-2] == pytest.approx([0] * (len(turns) - 2), abs=1e-7)
    hexagon = PolygonBore(6, 6.0)
    assert not corners(hexagon.profile(0.5))
    assert len(corners(hexagon.profile(-0.5))) == 6


def test_a_rounding_vanishes_where_the_offset_passes_it() -> None:
    bore = PolygonBore(6, 6.0, 0.3)
    assert len(corners(bore.profile(0.29))) == 6
    assert not corners(bore.profile(0.31))
    assert abs(profile_area(bore.profile(0.3 - 1e-9)) - profile_area(bore.profile(0.3 + 1e-9))) < 1e-6


@pytest.mark.parametrize("name", BORES)
def test_the_reach_of_a_bore(name: str) -> None:
    bore = BORES[name]
    reach = float(np.abs(outline(bore.profile(), 2000)).max())
    assert reach <= bore.reach * (1 + 1e-14)
    assert reach == pytest.approx(bore.reach, rel=1e-5)
    assert np.abs(outline(bore.profile(-0.01))).max() <= bore.reach + 0.01 * (1 + 1e-12)


WRONG: dict[str, tuple[Bore, str]] = {
    "no diameter": (RoundBore(0.0), "bore.diameter"),
    "nan": (RoundBore(math.nan), "bore.diameter"),
    "keyway as wide as its bore": (KeywayBore(10.0, 10.0, 2.0), "bore.width"),
    "no depth": (KeywayBore(10.0, 3.0, 0.0), "bore.depth"),
    "three keys": (KeywayBore(10.0, 3.0, 1.0, 0.0, 3), "bore.keys"),
    "corners wider than the keyway": (KeywayBore(10.0, 3.0, 2.0, 1.51), "bore.corner_radius"),
    "corners deeper than the keyway": (KeywayBore(10.0, 3.0, 0.5, 0.8), "bore.corner_radius"),
    "flat outside": (FlatBore(5.0, 2.5), "bore.flat"),
    "flat beyond the axis": (FlatBore(5.0, 0.0), "bore.flat"),
    "double flat outside": (FlatBore(5.0, 2.5, 2), "bore.across_flats"),
    "no hexagon": (PolygonBore(6, 0.0), "bore.across_flats"),
    "a hexagon that is a circle": (PolygonBore(6, 5.0, 2.5), "bore.corner_radius"),
    "negative corners": (PolygonBore(4, 5.0, -0.1), "bore.corner_radius"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_bore_is_refused_by_its_key(name: str) -> None:
    bore, key = WRONG[name]
    with pytest.raises(ParameterError) as caught:
        bore.check()
    assert caught.value.name == key


@examples(150)
@given(
    st.floats(1e-3, 1e4), st.floats(1e-3, 0.9999), st.floats(1e-3, 2), st.floats(0, 1.2), st.integers(1, 2),
    st.floats(-7, 7), st.floats(-1.5, 1.5),
)  # fmt: skip
def test_any_keyway_is_exact_or_refused(
    diameter: float, width: float, depth: float, corner: float, keys: int, angle: float, share: float
) -> None:
    width, depth = width * diameter, depth * diameter
    bore = KeywayBore(diameter, width, depth, corner * min(width / 2, depth), keys, angle)
    if refused := brute.refusal(bore.check):
        assert corner > 0.9
        assert isinstance(refused, ParameterError)
        assert refused.name == "bore.corner_radius"
        return
    d = share * min(width / 2, depth)
    if refused := brute.refusal(lambda: bore.profile(d)):
        assert isinstance(refused, OffsetError)
        assert 0 < refused.nearest_offset / d < 1
        bore.profile(refused.nearest_offset)
        return
    gaps = distance_to_profile(outline(bore.profile(d), 40), bore.profile()) - abs(d)
    assert np.abs(gaps).max() <= 1e-12 * (diameter + depth)


@examples(150)
@given(
    st.integers(2, 60), st.floats(0.01, 1e4), st.floats(1.001, 10), st.floats(1e-3, 1), st.floats(0, 1),
    st.floats(-1, 1),
)  # fmt: skip
def test_any_spokes_are_exact_or_refused(
    count: int, inner: float, ratio: float, width: float, corner: float, share: float
) -> None:
    spokes = Spokes(count, inner, ratio * inner, width * inner * math.sin(math.pi / count),
                    corner * inner * (ratio - 1) / 4, 0.5)  # fmt: skip
    if refused := brute.refusal(lambda: spokes.check("spokes")):
        assert isinstance(refused, ParameterError)
        assert refused.name in ("spokes.width", "spokes.corner_radius")
        return
    d = share * (inner * (ratio - 1) / 4 if share > 0 else spokes.width / 2)
    assume(abs(d) > 0)
    if refused := brute.refusal(lambda: spokes.profiles(d)):
        assert isinstance(refused, OffsetError)
        assert 0 <= refused.nearest_offset / d < 1
        spokes.profiles(refused.nearest_offset)
        return
    gaps = distance_to_profile(outline(spokes.profiles(d)[0], 40), spokes.profiles()[0]) - abs(d)
    assert np.abs(gaps).max() <= 1e-11 * inner * ratio


@pytest.mark.parametrize("place", [0, 2, -1])
def test_the_check_of_distance_sees_a_moved_piece(place: int) -> None:
    """Negative control: one piece moved by a millionth of its offset is caught, wherever it is."""
    bore, d = BORES["keyway"], 0.1
    curve = bore.profile(d).period[place].curve
    spoiled = brute.dense(curve, 60) + 1e-6 * d * 1j * curve.tangent(np.linspace(*curve.domain, 60))
    assert np.abs(distance_to_profile(spoiled, bore.profile()) - d).max() > 0.9e-6 * d


def test_a_circle_beside_the_axis_is_measured() -> None:
    hole = circle(2.0, Label.HOLE, hole=True, centre=30 - 40j)
    points = np.array([30 - 40j, 30 - 37j, 0j, 33 - 40j, 28 - 40j])
    assert distance_to_profile(points, hole) == pytest.approx([2.0, 1.0, 48.0, 1.0, 0.0], abs=1e-13)
    assert profile_area(hole) == pytest.approx(-4 * math.pi, rel=1e-14)

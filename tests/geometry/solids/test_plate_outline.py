"""Outlines of lines and arcs, moved: against GEOS' buffers of fine polygons."""

import cmath
import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import GeometryError, OffsetError, ParameterError
from geometry.base.record import replace
from geometry.cams.contact.outlines import (
    flat_arm,
    mushroom_arm,
    plate_stem,
    pointed_arm,
    pointed_stem,
    roller_stem,
    round_arm,
)
from geometry.curves.curve import end_point, start_point
from geometry.curves.line_arc import Arc, Line
from geometry.plane.measure import profile_area
from geometry.plane.profile import Label, Profile, Region, Segment
from geometry.solids.plate import Edge, PlateHole, PlateOutline, PlateSlot, belt, moved_edges, rounded
from tests.sampling import examples

SHAPES = {
    "pointed stem": pointed_stem(10, 80, 1.0),
    "roller stem": roller_stem(10, 80),
    "plate": plate_stem(10, 80, (40, 5), None, 2),
    "mushroom": plate_stem(10, 80, (40, 5), 30, 2),
    "arm": round_arm(60, 16, 10),
    "mushroom arm": mushroom_arm(60, 8, 16, (15, 9), 1),
    "mushroom arm, right": mushroom_arm(60, 8, 16, (15, 9), -1),
    "flat arm": flat_arm(60, 12, 6, 10, 1),
    "pointed arm": pointed_arm(60, 8, 16, (0.8, 10), 1),
    "pointed arm, right": pointed_arm(60, 8, 16, (0.8, 10), -1),
}


def region_area(region: Region) -> float:
    return sum(profile_area(p) for p in region.profiles())


def polygon(edges: tuple[Edge, ...], samples: int = 1500) -> shapely.Polygon:
    points = np.concatenate(
        [e.point(np.linspace(*e.domain, 2 if isinstance(e, Line) else samples)[:-1]) for e in edges]
    )
    return shapely.Polygon(np.stack([points.real, points.imag], axis=1))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("offset", [-2.3, -1.0, -0.1, 0.1, 1.0, 3.0])
def test_moved_outlines_are_those_of_geos(name: str, offset: float) -> None:
    edges = SHAPES[name]
    assert PlateOutline(edges).region().region.outer.count == 1
    # a rounding of 2 mm is consumed by 2.3 and its neighbours meet
    found, wanted = polygon(moved_edges(edges, offset)), polygon(edges).buffer(offset, quad_segs=500)
    assert found.is_valid
    assert found.symmetric_difference(wanted).area < 1e-4 * wanted.length


@pytest.mark.parametrize("name", [name for name in SHAPES if "arm" in name and name != "arm"])
def test_arms_are_closed_and_hooks_square(name: str) -> None:
    """What stands beyond the boss is level or upright, but for a tip and the tangents of the boss."""
    edges = SHAPES[name]
    for one, two in itertools.pairwise((*edges, edges[0])):
        assert abs(end_point(one) - start_point(two)) < 1e-12
    lines = [end_point(e) - start_point(e) for e in edges if isinstance(e, Line)]
    square = [way for way in lines if min(abs(way.real), abs(way.imag)) < 1e-12]
    assert len(square) >= 2
    # 8 mm wide where the hook stands, 12 mm the flat one
    assert min(map(abs, square)) == pytest.approx(12.0 if name == "flat arm" else 8.0)


@given(st.floats(0.5, 60), st.floats(0.5, 60), st.floats(0, 1), st.floats(-1, 1))
@examples(40)
def test_rectangles(width: float, height: float, share: float, move: float) -> None:
    short = min(width, height)
    radius, offset = share * short / 2 * 0.999, move * short * 0.49
    half = complex(width, height) / 2
    outline = PlateOutline(rounded([(c, radius) for c in (-half, half.conjugate(), half, -half.conjugate())]))
    area = region_area(outline.region(offset).region)
    # Steiner outwards; inwards the sides shrink and what is left of the rounding stays
    if offset >= 0:
        rest, grown = radius + offset, offset
    else:
        rest, grown = max(radius + offset, 0.0), offset
    exact = (width + 2 * grown) * (height + 2 * grown) - (4 - math.pi) * rest**2
    assert area == pytest.approx(exact, rel=1e-12)


def test_holes_and_slots_shrink_and_close() -> None:
    outline = PlateOutline(round_arm(60, 20, 20), (PlateHole(0j, 6), PlateSlot(20 + 0j, 40 + 0j, 4)))
    exact = math.pi * 100 + 60 * 20 - math.pi * 9 - (math.pi * 4 + 20 * 4)
    assert region_area(outline.region().region) == pytest.approx(exact, rel=1e-13)
    with pytest.raises(OffsetError) as refusal:
        outline.region(2.5)
    assert outline.region(refusal.value.nearest_offset)
    with pytest.raises(OffsetError) as refusal:
        outline.region(-4.0)
    assert outline.region(refusal.value.nearest_offset)


@pytest.mark.parametrize(
    "hole",
    # across another, about the end, outside, across by a slot; in another and about it
    [PlateHole(5 + 0j, 6.0), PlateHole(0j, 30.0), PlateHole(200 + 0j, 3.0), PlateSlot(0j, 5 + 0j, 1.0),
     PlateHole(1 + 0j, 2.0), PlateHole(0.5 + 0j, 9.0)],
)  # fmt: skip
def test_holes_that_meet_something_are_refused(hole: PlateHole | PlateSlot) -> None:
    outline = PlateOutline(round_arm(60, 20, 20), (PlateHole(0j, 6), hole))
    with pytest.raises(GeometryError):
        outline.region()
    with pytest.raises(ParameterError, match=r"holes\[2]"):
        outline.check_holes(["holes[1].diameter", "holes[2].diameter"])


@examples(60)
@given(
    st.sampled_from(sorted(SHAPES)),
    st.lists(st.tuples(st.floats(-0.2, 1.2), st.floats(-0.2, 1.2)), min_size=2, max_size=2),
    st.booleans(),
)
def test_a_hole_may_be_as_large_as_geos_says_and_no_larger(
    name: str, places: list[tuple[float, float]], slotted: bool
) -> None:
    """Of 0.01 %: chords of arcs had let holes overlap by a fiftieth of a millimetre."""
    edges = SHAPES[name]
    whole = polygon(edges)
    low, high = complex(*whole.bounds[:2]), complex(*whole.bounds[2:])
    found = [complex(low.real + x * (high - low).real, low.imag + y * (high - low).imag) for x, y in places]
    # one stands, another is asked for
    point = whole.representative_point()
    first, slotted = PlateHole(complex(point.x, point.y), 0.2), abs(found[1] - found[0]) > 0.1 and slotted
    ends = found[0], found[slotted]
    core = (
        shapely.LineString([(z.real, z.imag) for z in ends]) if slotted else shapely.Point(found[0].real, found[0].imag)
    )
    off = shapely.distance(core, point) - 0.1
    room = 2 * float(min(shapely.distance(core, whole.exterior), off)) if whole.contains(core) else -1.0

    def check(size: float) -> None:
        last = PlateSlot(*ends, size) if slotted else PlateHole(ends[0], size)
        PlateOutline(edges, (first, last)).check_holes(["first", "last"])

    if room > 0.02:
        check(room * (1 - 1e-4) - 1e-4)
    with pytest.raises(ParameterError) as caught:
        check(max(room, 0.02) * (1 + 1e-4) + 1e-4)
    assert caught.value.name == "last"
    if room > 0.02:
        assert caught.value.nearest is not None
        assert caught.value.nearest.value == pytest.approx(room, rel=1e-4, abs=2e-4)


def test_a_hole_that_reaches_a_hair_over_another_or_the_edge_is_refused() -> None:
    square = rounded([(complex(x, y), 0.0) for x, y in ((-30, -30), (30, -30), (30, 30), (-30, 30))])
    apart = cmath.rect(9.99, 0.58)
    slanted = tuple(
        Line(e.start * cmath.rect(1, 0.3), e.end * cmath.rect(1, 0.3)) for e in square if isinstance(e, Line)
    )
    for edges, holes in (
        (square, (PlateHole(0j, 10.0), PlateHole(apart, 10.0))),
        (slanted, (PlateHole(cmath.rect(25.001, 0.3), 10.0),)),
    ):
        outline = PlateOutline(edges, holes)
        assert not outline.exists()
        with pytest.raises(ParameterError) as caught:
            outline.check_holes([f"holes[{k}].diameter" for k in range(1, len(holes) + 1)])
        assert caught.value.nearest is not None
        assert 9.97 < float(str(caught.value.nearest.value)) < 10.0


def test_roundings_without_room_are_refused() -> None:
    with pytest.raises(GeometryError, match="roundings"):
        rounded([(0j, 3.0), (4 + 0j, 3.0), (4 + 4j, 3.0), (4j, 3.0)])


def common(r: float, s: float, distance: float) -> float:
    """What two circles have in common."""
    a, b = (math.acos((distance**2 + p * p - q * q) / (2 * distance * p)) for p, q in ((r, s), (s, r)))
    return r * r * (a - math.sin(2 * a) / 2) + s * s * (b - math.sin(2 * b) / 2)


def two_circles(r: float, s: float, distance: float, turn: complex, *, both: bool) -> tuple[Edge, ...]:
    """What two circles cover together, or what ``both`` do; the first about the origin, the second along ``turn``."""
    a, b = (math.acos((distance**2 + p * p - q * q) / (2 * distance * p)) for p, q in ((r, s), (s, r)))
    angle = cmath.phase(turn)
    if both:
        return Arc(0j, r, angle - a, 2 * a), Arc(distance * turn, s, angle + math.pi - b, 2 * b)
    whole = 2 * math.pi
    return Arc(0j, r, angle + a, whole - 2 * a), Arc(distance * turn, s, angle - math.pi + b, whole - 2 * b)


@pytest.mark.parametrize("turn", [1 + 0j, cmath.exp(2.3j)])
def test_arcs_that_are_cut_where_they_cross(turn: complex) -> None:
    """A lens is drawn in by 1 to the lens of circles smaller by 1, two disks grow to disks that are larger by it."""
    r, s, distance = 10.0, 7.0, 12.0
    lens = two_circles(r, s, distance, turn, both=True)
    assert sum_of(moved_edges(lens, 0.0)) == pytest.approx(common(r, s, distance), rel=1e-12)
    assert sum_of(moved_edges(lens, -1.0)) == pytest.approx(common(r - 1, s - 1, distance), rel=1e-12)
    # Steiner outwards
    length = sum(abs(e.sweep) * e.radius for e in lens if isinstance(e, Arc))
    assert sum_of(moved_edges(lens, 1.5)) == pytest.approx(
        common(r, s, distance) + 1.5 * length + math.pi * 2.25, rel=1e-12
    )
    pair = two_circles(r, s, distance, turn, both=False)
    for offset in (1.0, 0.25):
        grown = math.pi * ((r + offset) ** 2 + (s + offset) ** 2) - common(r + offset, s + offset, distance)
        assert sum_of(moved_edges(pair, offset)) == pytest.approx(grown, rel=1e-12)
    # circles that are apart when smaller leave no lens
    with pytest.raises(GeometryError):
        moved_edges(lens, -2.6)
    assert sum_of(moved_edges(lens, -2.4)) == pytest.approx(common(r - 2.4, s - 2.4, distance), rel=1e-9)


def sum_of(edges: tuple[Edge, ...]) -> float:
    return profile_area(Profile(tuple(Segment(e, Label.BODY) for e in edges)))


def way(edge: Edge) -> float:
    return abs(edge.end - edge.start) if isinstance(edge, Line) else abs(edge.sweep) * edge.radius


def test_belts_are_hulls_of_two_circles() -> None:
    """Area and length: two tangents, arcs of pi plus and less twice the lean; a belt that is moved is a larger one."""
    for one, small, two, large in ((1 + 2j, 3.0, 9 - 4j, 5.0), (0j, 5.0, 8 + 0j, 2.0), (2j, 4.0, -7 + 1j, 4.0)):
        apart = abs(two - one)
        lean = math.asin((small - large) / apart)
        side = math.sqrt(apart**2 - (large - small) ** 2)
        edges = belt((one, small), (two, large))
        length = 2 * side + small * (math.pi + 2 * lean) + large * (math.pi - 2 * lean)
        assert sum(map(way, edges)) == pytest.approx(length)
        area = side * (small + large) + (small**2 * (math.pi + 2 * lean) + large**2 * (math.pi - 2 * lean)) / 2
        assert sum_of(edges) == pytest.approx(area, rel=1e-12)
        for offset in (1.0, -0.5):
            assert sum_of(moved_edges(edges, offset)) == pytest.approx(area + offset * length + math.pi * offset**2)
        for a, b in itertools.pairwise((*edges, edges[0])):
            assert end_point(a) == pytest.approx(start_point(b))
    with pytest.raises(GeometryError, match="end_within_the_other"):
        belt((0j, 5.0), (3 + 0j, 2.0))
    belt((0j, 5.0), (3.001 + 0j, 2.0))


def test_corners_are_rounded_where_they_turn_either_way() -> None:
    """An L: five convex corners and a hollow one; each rounding takes or leaves (1 - pi / 4) r^2."""
    corners = [(0j, 1.0), (6 + 0j, 0.5), (6 + 2j, 0.0), (2 + 2j, 1.5), (2 + 5j, 1.0), (5j, 1e-12)]
    edges = rounded(corners)
    quarter = 1 - math.pi / 4
    area = 6 * 2 + 2 * 3 - quarter * (1 + 0.25 + 1) + quarter * 2.25
    assert sum_of(edges) == pytest.approx(area, rel=1e-12)
    # two corners are left sharp, and edges that roundings use up are none
    assert sum(isinstance(e, Arc) for e in edges) == 4
    assert all(e.radius in (0.5, 1.0, 1.5) for e in edges if isinstance(e, Arc))
    whole = rounded([(0j, 2.0), (4 + 0j, 2.0), (4 + 4j, 2.0), (4j, 2.0)])
    assert len(whole) == 4
    assert sum_of(whole) == pytest.approx(4 * math.pi, rel=1e-12)
    obtuse = rounded([(0j, 0.0), (10 + 0j, 0.0), (13 + 4j, 1.0), (3 + 4j, 0.0)])
    # a corner of the angle t is cut off by r^2 (cot(t / 2) - (pi - t) / 2)
    turn = math.pi - math.atan2(4, 3)
    for edges_, angle in (
        (obtuse, math.atan2(4, 3)),
        (rounded([(0j, 0.0), (10 + 0j, 1.0), (13 + 4j, 0.0), (3 + 4j, 0.0)]), turn),
    ):
        assert sum_of(edges_) == pytest.approx(40 - (1 / math.tan(angle / 2) - (math.pi - angle) / 2), rel=1e-12)


def test_a_hole_is_offered_as_large_as_its_place_takes() -> None:
    """In a plate of 40 x 20: up to the edge, to another hole; a slot by its width; where nothing fits, nothing."""
    plate = rounded([(c, 0.0) for c in (0j, 40 + 0j, 40 + 20j, 20j)])
    first = PlateHole(10 + 10j, 6.0)
    for hole, key, most in ((PlateHole(34 + 10j, 13.0), "diameter", 12.0), (PlateHole(17 + 10j, 9.0), "diameter", 8.0),
                            (PlateSlot(24 + 6j, 30 + 6j, 13.0), "width", 12.0)):  # fmt: skip
        with pytest.raises(ParameterError) as refused:
            PlateOutline(plate, (first, hole)).check_holes(["a.diameter", f"b.{key}"])
        assert (refused.value.name, refused.value.code) == (f"b.{key}", "hole_reaches_edge")
        assert refused.value.value == 13.0 or refused.value.value == 9.0
        offered = refused.value.nearest
        assert offered is not None
        assert float(offered.value) == pytest.approx(most, rel=1e-2)
        assert float(offered.value) <= most
        PlateOutline(plate, (first, replace(hole, **{key: float(offered.value)}))).check_holes(["a", "b"])
    with pytest.raises(ParameterError) as refused:
        PlateOutline(plate, (first, PlateHole(50 + 10j, 3.0))).check_holes(["a.diameter", "b.diameter"])
    assert (refused.value.code, refused.value.nearest) == ("hole_lies_outside", None)
    # holes within their limits move with the material
    for hole, code in ((first, "hole_closed"), (PlateSlot(24 + 6j, 30 + 6j, 6.0), "slot_closed")):
        with pytest.raises(OffsetError) as closed:
            hole.profile(3.0)
        assert (closed.value.code, closed.value.nearest_offset) == (code, pytest.approx(3.0, rel=2e-6))
        assert profile_area(hole.profile(1.0)) == pytest.approx(-(4 * math.pi + (24 if code == "slot_closed" else 0)))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("seed", range(4))
def test_many_holes_lie_clear_or_meet_as_geos_has_them(seed: int) -> None:
    """Holes in random places of a plate with a notch, laid one after the other where the last is clear of all."""
    corners = [0j, 100 + 0j, 100 + 60j, 60 + 60j, 50 + 20j, 40 + 60j, 60j]
    outline = shapely.Polygon([(c.real, c.imag) for c in corners])
    edges, found = rounded([(c, 0.0) for c in corners]), list[PlateHole]()
    seen = {True: 0, False: 0}
    for x, y, diameter in np.random.default_rng(seed).uniform((-5.0, -5.0, 1.0), (105.0, 65.0, 9.0), (60, 3)):
        hole, at = PlateHole(complex(x, y), diameter), shapely.Point(x, y)
        gaps = [outline.exterior.distance(at) - diameter / 2]
        gaps += [abs(hole.centre - h.centre) - (diameter + h.diameter) / 2 for h in found]
        # holes are told apart by polygons of 24 corners, 0.04 mm off a circle of 9
        if min(map(abs, gaps)) < 0.1:
            continue
        clear = bool(outline.contains(at)) and min(gaps) > 0
        assert PlateOutline(edges, (*found, hole)).exists() == clear
        seen[clear] += 1
        found += [hole] if clear else []
    assert min(seen.values()) > 5


@pytest.mark.parametrize("beyond", [-1.0, -0.3, -0.01, -1e-6, 1e-6, 0.01, 0.3])
def test_an_outline_crosses_itself_where_its_lines_and_arcs_do(beyond: float) -> None:
    """A disk with a notch whose point ends so near to its rim, or ``beyond``: chords of it were 0.4 mm within."""
    radius, mouth = 50.0, math.radians(3)
    # the point stands amid two of the places that were looked at
    tip = cmath.rect(radius + beyond, math.pi + math.radians(354 / 48))
    begin, end = (cmath.rect(radius, a) for a in (mouth, -mouth))
    rim = Arc(0j, radius, mouth, math.tau - 2 * mouth)
    outline = PlateOutline((rim, Line(end, tip), Line(tip, begin)))
    if beyond < 0:
        area = abs(profile_area(outline.region().region.outer))
        # less the notch, and the segment at its mouth that the rim leaves out
        notch = abs(((begin - tip).conjugate() * (end - tip)).imag) / 2
        segment = radius**2 * (mouth - math.sin(mouth) * math.cos(mouth))
        assert area == pytest.approx(math.pi * radius**2 - notch - segment, rel=1e-9)
    else:
        with pytest.raises(GeometryError, match="boundary_crosses_itself"):
            outline.region()

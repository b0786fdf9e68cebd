"""Outlines of lines and arcs, moved: against GEOS' buffers of fine polygons."""

import itertools
import math

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import GeometryError, OffsetError, ParameterError
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
from geometry.curves.line_arc import Line
from geometry.plane.measure import profile_area
from geometry.plane.profile import Region
from geometry.solids.plate import Edge, PlateHole, PlateOutline, PlateSlot, moved_edges, rounded
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


@pytest.mark.sampled(12)
@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("offset", [-2.3, -1.0, -0.1, 0.1, 1.0, 3.0])
def test_moved_outlines_are_those_of_geos(name: str, offset: float) -> None:
    edges = SHAPES[name]
    assert PlateOutline(edges).region().region.outer.count == 1
    # a rounding of 2 mm is consumed by 2.3 and its neighbours meet
    found, wanted = polygon(moved_edges(edges, offset)), polygon(edges).buffer(offset, quad_segs=1500)
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


def test_roundings_without_room_are_refused() -> None:
    with pytest.raises(GeometryError, match="roundings"):
        rounded([(0j, 3.0), (4 + 0j, 3.0), (4 + 4j, 3.0), (4j, 3.0)])

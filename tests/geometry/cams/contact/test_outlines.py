"""Outlines of followers: what stems, plates, arms and hooks cover, and every size at both sides of its limit."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import shapely

from geometry.base.errors import ParameterError
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
from geometry.plane.profile import Label, Profile, Segment
from geometry.solids.plate import Edge
from tests.brute import works

D = math.radians


def area(edges: tuple[Edge, ...]) -> float:
    """Of an outline, which is closed."""
    return profile_area(Profile(tuple(Segment(e, Label.BODY) for e in edges)))


def polygon(edges: tuple[Edge, ...]) -> shapely.Polygon:
    points = np.concatenate([e.point(np.linspace(*e.domain, 2 if isinstance(e, Line) else 1000)[:-1]) for e in edges])
    return shapely.Polygon(np.column_stack([points.real, points.imag]))


def disk(radius: float, x: float = 0.0) -> shapely.Polygon:
    return shapely.Point(x, 0.0).buffer(radius, quad_segs=1000)


def same(edges: tuple[Edge, ...], wanted: shapely.Polygon) -> None:
    assert area(edges) == pytest.approx(wanted.area, rel=2e-5)
    assert polygon(edges).symmetric_difference(wanted).area < 2e-5 * wanted.area


def test_stems_cover_what_plane_geometry_says() -> None:
    half = math.tan(D(20))
    # a wedge of 40 degrees on a stem of 10: 5 / tan 20 high
    assert area(pointed_stem(10.0, 80.0, D(40))) == pytest.approx(10 * 80 - 5 * 5 / half, rel=1e-12)
    tip = polygon(pointed_stem(10.0, 80.0, D(40)))
    assert tip.bounds == pytest.approx((-5, 0, 5, 80))
    assert shapely.Polygon([(0, 0), (5, 5 / half), (-5, 5 / half)]).within(tip.buffer(1e-9))
    assert area(roller_stem(10.0, 80.0)) == pytest.approx(10 * 80 + math.pi * 25 / 2, rel=1e-12)
    assert polygon(roller_stem(10.0, 80.0)).bounds == pytest.approx((-5, -5, 5, 80), abs=1e-4)


@pytest.mark.parametrize("corner", [0.0, 2.0])
@pytest.mark.parametrize("radius", [None, 30.0])
def test_a_plate_on_its_stem(radius: float | None, corner: float) -> None:
    """A plate of 40 x 5, a stem of 10 up to 80, fillets of (1 - pi / 4) c^2; of a mushroom the segment of its arc."""
    edges = plate_stem(10.0, 80.0, (40.0, 5.0), radius, corner)
    fillets = 2 * (1 - math.pi / 4) * corner**2
    edge = 0.0 if radius is None else -math.sqrt(radius**2 - 400)
    cap = 0.0 if radius is None else radius**2 * math.asin(20 / radius) + 20 * edge
    wanted = 40 * 5 + 10 * (80 - edge - 5) + fillets + cap
    assert area(edges) == pytest.approx(wanted, rel=1e-12)
    low = 0.0 if radius is None else -radius
    assert polygon(edges).bounds == pytest.approx((-20, low, 20, 80), abs=1e-4)


def test_a_plate_as_wide_as_its_stem_is_one_with_it() -> None:
    edges = plate_stem(10.0, 80.0, (10.0, 5.0), None, 0.0)
    assert len(edges) == 4
    assert area(edges) == pytest.approx(800.0, rel=1e-12)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("width", "offset", "boss"), [
    (6.0, 3.0, 10.0), (20.0, 10.0, 10.0), (20.0, 2.0, 10.0), (12.0, 9.0, 10.0), (6.0, -4.0, 10.0), (6.0, 10.0, 10.0),
])  # fmt: skip
@pytest.mark.parametrize("sense", [1, -1])
def test_a_bar_with_a_boss_where_it_is_too_narrow(width: float, offset: float, boss: float, sense: int) -> None:
    """A rectangle from the pivot to 60, and the disk about it; back to the disk's far side where it covers that."""
    radius, far = boss / 2, offset - width
    bar, round_ = shapely.box(0, far, 60, offset), disk(radius)
    parts = [bar]
    above, below = offset < radius, far > -radius
    if above or below:
        parts.append(round_)
    if not above:
        parts.append(shapely.box(-radius, 0.0 if below else far, 0, offset))
    if not below:
        parts.append(shapely.box(-radius, far, 0, 0.0 if above else offset))
    wanted = shapely.union_all(parts)
    if sense < 0:
        wanted = shapely.affinity.scale(wanted, yfact=-1, origin=(0, 0))
    same(flat_arm(60.0, width, offset, boss, sense), wanted)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("height", [10.0, 0.0])
def test_hooked_arms(sense: int, height: float) -> None:
    """The hull of the boss and the bar's end at the hook, the bar under the hook, and the hook itself."""
    wedge, cap = 12.0 * math.tan(D(25)), math.sqrt(15.0**2 - height**2)
    hook = shapely.Polygon([(60 + wedge, -12), (60, 0), (60 - wedge, -12)])
    segment = disk(15.0, 60.0).intersection(shapely.box(0, -height, 100, 30))
    for half, low, top, edges in (
        (wedge, -12.0, hook, pointed_arm(60.0, 8.0, 16.0, (D(50), 12.0), sense)),
        (cap, -height, segment, mushroom_arm(60.0, 8.0, 16.0, (15.0, height), sense)),
    ):
        arm = shapely.union_all([disk(8.0), shapely.MultiPoint([(60 - half, low), (60 - half, low - 8)])]).convex_hull
        wanted = shapely.union_all([arm, shapely.box(60 - half, low - 8, 60 + half, low), top])
        if sense < 0:
            wanted = shapely.affinity.scale(wanted, yfact=-1, origin=(0, 0))
        same(edges, wanted)
        for one, two in zip(edges, (*edges[1:], edges[0]), strict=True):
            assert end_point(one) == pytest.approx(start_point(two), abs=1e-12)


Made = Callable[[float], object]
# key, code, what is made of a value, its limit, the side on which it works
REFUSED: dict[str, tuple[str, str, Made, float, int]] = {
    "wedge longer than its stem": ("stem_length", "tip_longer_than_stem", lambda v: pointed_stem(10.0, v, D(40)),
                                   5 / math.tan(D(20)), 1),
    "mushroom narrower than its stem": ("follower_radius", "narrower_than_stem",
                                        lambda v: plate_stem(10.0, 80.0, (10.0, 5.0), v, 0.0), 5.0, 1),
    "plate narrower than its stem": ("plate_diameter", "below_stem_width",
                                     lambda v: plate_stem(10.0, 80.0, (v, 5.0), None, 0.0), 10.0, 1),
    "plate wider than its arc": ("plate_diameter", "arc_ends_at_its_diameter",
                                 lambda v: plate_stem(10.0, 80.0, (v, 5.0), 30.0, 0.0), 60.0, -1),
    "stem within its plate": ("stem_length", "plate_takes_stem",
                              lambda v: plate_stem(10.0, v, (40.0, 5.0), None, 2.0), 7.0, 1),
    "stem within its mushroom": ("stem_length", "plate_takes_stem",
                                 lambda v: plate_stem(10.0, v, (40.0, 25.0), 30.0, 2.0), 27 - math.sqrt(500), 1),
    "fillets wider than the plate": ("corner_radius", "plate_has_no_room",
                                     lambda v: plate_stem(10.0, 80.0, (20.0, 5.0), None, v), 5.0, -1),
    "an end within the boss": ("arm_length", "end_within_the_other", lambda v: round_arm(v, 30.0, 10.0), 10.0, 1),
    "a boss within the end": ("arm_length", "end_within_the_other", lambda v: round_arm(v, 10.0, 30.0), 10.0, 1),
    "a face too far out": ("face_offset", "pivot_outside_bar", lambda v: flat_arm(60.0, 6.0, v, 10.0, 1), 10.5, -1),
    "a face too far in": ("face_offset", "pivot_outside_bar", lambda v: flat_arm(60.0, 6.0, v, 10.0, 1), -4.5, 1),
    "a bar within its boss": ("arm_length", "ends_within_boss", lambda v: flat_arm(v, 6.0, 3.0, 10.0, 1), 5.0, 1),
    "a hook up to the boss": ("tip_height", "hook_reaches_pivot",
                              lambda v: pointed_arm(60.0, 8.0, 16.0, (D(100), v), 1), 52 / math.tan(D(50)), -1),
    "a hooked arm within its boss": ("arm_length", "ends_within_boss",
                                     lambda v: mushroom_arm(v, 8.0, 16.0, (15.0, 9.0), 1), 8.0, 1),
    "a cap of no height": ("tip_height", "no_cap", lambda v: mushroom_arm(60.0, 8.0, 16.0, (15.0, v), 1), 15.0, -1),
    "a cap up to the boss": ("follower_radius", "cap_reaches_pivot",
                             lambda v: mushroom_arm(60.0, 8.0, 16.0, (v, 9.0), 1), 52.0, -1),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_a_size_is_refused_from_its_limit_on(name: str) -> None:
    key, code, make, limit, side = REFUSED[name]
    with pytest.raises(ParameterError) as refused:
        make(limit - side * 1e-3)
    assert (refused.value.name, refused.value.code) == (key, code)
    assert refused.value.value == limit - side * 1e-3
    offered = works(refused.value)
    assert 0 <= (offered - limit) * side < 2e-4
    if name != "a hooked arm within its boss":
        make(limit + side * 1e-3)
        make(offered)
    if code == "tip_longer_than_stem":
        assert refused.value.numbers == {"height": pytest.approx(limit)}

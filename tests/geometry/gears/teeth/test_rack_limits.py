"""Racks: every size and every offset at both sides of its limit, holes in the body, tips that offsets use up."""

from __future__ import annotations

import math

import pytest

from geometry.base.errors import Nearest, OffsetError, ParameterError, PointedTipError
from geometry.base.record import replace
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.rack import Rack, checked_part_rack, rack_region, rack_side
from geometry.gears.teeth.rack_holes import RackHoles
from geometry.plane.measure import profile_area
from geometry.plane.profile import Label
from tests.brute import distance_to_outline, period_points, works

ALPHA = math.radians(20.0)
TAN = math.tan(ALPHA)
SHARP = BasicRack(ALPHA, 1.0, 0.25, 0.0)


def rack(holes: RackHoles | None = None, teeth: int = 5, body: float = 6.0, basic: BasicRack | None = None,
         **keys: float) -> Rack:  # fmt: skip
    """Of module 2, five teeth long: 10 pi mm."""
    return Rack(2.0, teeth, basic or iso_53(), body, holes=holes, **keys)


HOLES = RackHoles(3, 2.0, 8.0, 3.0)
LENGTH = 10 * math.pi


@pytest.mark.parametrize(
    ("changed", "limit", "side", "code"),
    [
        # key, the limit in the body of 6 mm, the side on which it works
        ("diameter", 6.0, -1, "hole_as_high_as_body"),
        ("depth", 1.0, 1, "holes_reach_root_line"),
        ("depth", 5.0, -1, "holes_reach_bottom"),
        ("spacing", 2.0, 1, "holes_touch_each_other"),
    ],
)
def test_holes_lie_within_the_body(changed: str, limit: float, side: int, code: str) -> None:
    for value in (limit, limit - side * 0.01):
        wrong = replace(HOLES, **{changed: value} | ({"depth": value / 2 + 0.5} if changed == "diameter" else {}))
        with pytest.raises(ParameterError) as refused:
            checked_part_rack(rack(wrong))
        assert (refused.value.name, refused.value.code, refused.value.value) == (f"holes.{changed}", code, value)
        # a tenth of a micrometre from the limit, and the digit that is told
        assert (works(refused.value) - limit) * side > 0
        assert works(refused.value) == pytest.approx(limit + side * 1e-4, abs=1.01e-4)
    if changed != "diameter":
        checked_part_rack(rack(replace(HOLES, **{changed: limit + side * 1.1e-4})))


def test_a_row_of_holes_ends_within_the_rack() -> None:
    """(n - 1) 8 + 2 below the length of 31.4 mm: four; one hole may be as far from none as it likes."""
    checked_part_rack(rack(replace(HOLES, count=4)))
    for count in (5, 9):
        with pytest.raises(ParameterError) as refused:
            checked_part_rack(rack(replace(HOLES, count=count)))
        assert (refused.value.name, refused.value.code) == ("holes.count", "holes_reach_ends")
        assert refused.value.nearest == Nearest(4, "at_most")
    checked_part_rack(rack(replace(HOLES, count=1, spacing=0.5)))
    for key in ("diameter", "spacing", "depth"):
        for value in (0.0, -1.0, math.inf, math.nan):
            with pytest.raises(ParameterError) as refused:
                checked_part_rack(rack(replace(HOLES, **{key: value})))
            assert (refused.value.name, refused.value.code) == (f"holes.{key}", "not_finite_above_zero")
            assert refused.value.nearest == Nearest(1.0)


@pytest.mark.parametrize(
    ("holes", "wall"),
    [(replace(HOLES, depth=1.5), 0.5), (replace(HOLES, depth=4.3), 0.7), (replace(HOLES, spacing=2.4), 0.4),
     (replace(HOLES, count=4, spacing=9.5), (LENGTH - 3 * 9.5 - 2) / 2), (replace(HOLES, count=1, spacing=0.1), 2.0)],
)  # fmt: skip
def test_walls_beside_holes_are_used_up_from_both_sides(holes: RackHoles, wall: float) -> None:
    """To the root line, to the bottom, to the next hole, to the end; half from either side."""
    made = rack(holes)
    assert holes.thinnest(LENGTH, 6.0) == pytest.approx(wall)
    rack_region(made, -wall / 2 * (1 - 1e-3))
    with pytest.raises(OffsetError) as refused:
        rack_region(made, -wall / 2 * (1 + 1e-3))
    assert refused.value.reason == "no_wall_beside_holes"
    assert refused.value.nearest_offset == pytest.approx(-wall / 2, rel=1e-5)


def test_holes_close_at_their_radius_and_stand_below_the_root_line() -> None:
    region = rack_region(rack(HOLES), 0.25).region
    assert len(region.holes) == 3
    for hole, x in zip(region.holes, (-8.0, 0.0, 8.0), strict=True):
        assert profile_area(hole) == pytest.approx(-math.pi * 0.75**2)
        points = period_points(hole, 50)
        # 3 mm below the root line, 2.5 mm below the datum line
        assert abs(points - complex(x, -5.5)) == pytest.approx(0.75)
    with pytest.raises(OffsetError) as refused:
        rack_region(rack(replace(HOLES, diameter=1.0)), 0.501)
    assert refused.value.reason == "closes_holes"
    assert refused.value.nearest_offset == pytest.approx(0.5, rel=1e-5)


# --- the tooth


def test_a_tooth_ends_where_its_flanks_meet() -> None:
    """pi / 4 of a module over tan 20 above the datum line: a rack tooth is told that height."""
    height = math.pi / 4 / TAN
    with pytest.raises(PointedTipError) as pointed:
        rack_side(rack(basic=BasicRack(ALPHA, height * 1.001, 0.25, 0.0)))
    assert (pointed.value.name, pointed.value.code) == ("addendum", "rack_tooth_pointed")
    assert works(pointed.value) == pytest.approx(2 * height, abs=1e-4)
    assert works(pointed.value) <= 2 * height
    # its counterpart's teeth are sharp before
    with pytest.raises(OffsetError, match="closes_tooth_spaces"):
        rack_side(rack(basic=BasicRack(ALPHA, height * 0.999, 0.25, 0.0)))
    with pytest.raises(ParameterError, match="rack_pointed"):
        checked_part_rack(rack(basic=BasicRack(ALPHA, height * 1.001, 0.0, 0.0)))


TIP = math.pi - 4 * TAN
# m 2: pi mm of tooth on the datum line, the tip 2 mm above it, TIP wide
LIMITS = {
    "circumferential_thinning": (TIP, "thinning_leaves_no_tip"),
    "tip_chamfer": (TIP / 2 / (1 - TAN), "chamfers_overlap"),
    "tip_rounding": (TIP / 2 * math.cos(ALPHA) / (1 - math.sin(ALPHA)), "rounding_does_not_fit"),
}


@pytest.mark.parametrize("key", LIMITS)
def test_what_leaves_no_tip_is_refused(key: str) -> None:
    limit, code = LIMITS[key]
    checked_part_rack(rack(**{key: limit * (1 - 1e-4)}))
    with pytest.raises(ParameterError) as refused:
        checked_part_rack(rack(**{key: limit * (1 + 1e-4)}))
    assert (refused.value.name, refused.value.code) == (key, code)
    assert 0 <= limit - works(refused.value) < 1.01e-4
    checked_part_rack(rack(**{key: works(refused.value)}))
    if key != "circumferential_thinning":
        with pytest.raises(ParameterError) as refused:
            rack_side(rack(**{key: limit * (1 + 1e-4)}))
        assert refused.value.name == key


def test_sizes_of_no_rack() -> None:
    for made, key, nearest in ((rack(teeth=0), "number_of_teeth", Nearest(1, "at_least")),
                               (rack(body=-1.0), "body_height", Nearest(2.0)),
                               (rack(body=math.inf), "body_height", Nearest(2.0))):  # fmt: skip
        with pytest.raises(ParameterError) as refused:
            checked_part_rack(made)
        assert (refused.value.name, refused.value.nearest) == (key, nearest)
    made = rack(circumferential_thinning=0.3)
    assert (made.pitch, made.length) == pytest.approx((2 * math.pi, LENGTH))
    assert (made.addendum, made.dedendum) == (2.0, 2.5)
    assert made.form_dedendum == pytest.approx(2.5 - 0.76 * (1 - math.sin(ALPHA)))
    assert made.tooth_thickness == pytest.approx(math.pi - 0.3)
    assert made.tip_thickness == pytest.approx(TIP - 0.3)


def test_a_helical_rack_is_its_transverse_section() -> None:
    beta = math.radians(30)
    section = checked_part_rack(rack(), beta)
    assert section.module == pytest.approx(2 / math.cos(beta))
    assert math.tan(section.rack.pressure_angle) == pytest.approx(TAN / math.cos(beta))
    # heights stay
    assert (section.addendum, section.dedendum) == pytest.approx((2.0, 2.5))


@pytest.mark.parametrize(
    ("made", "offset", "code"),
    [
        # the body of 0.8 mm from below and from its root line; a tooth of one pitch from both ends
        (rack(body=0.8), -0.4, "leaves_no_body"),
        (rack(teeth=1, body=100.0, basic=BasicRack(math.radians(40), 0.5, 0.2, 0.0)), -math.pi, "leaves_no_tooth"),
        # a space of pi - 2 (2.5 tan) at its foot is closed by its two flanks: d / cos + d tan
        (rack(basic=SHARP), (math.pi / 2 - 2.5 * TAN) / (1 / math.cos(ALPHA) - TAN), "closes_tooth_spaces"),
    ],
)
def test_an_offset_is_refused_from_a_limit_on(made: Rack, offset: float, code: str) -> None:
    rack_region(made, offset * (1 - 1e-4))
    with pytest.raises(OffsetError) as refused:
        rack_region(made, offset * (1 + 1e-4))
    assert refused.value.reason == code
    assert refused.value.nearest_offset == pytest.approx(offset, rel=1e-5)
    assert abs(refused.value.nearest_offset) <= abs(offset) * (1 + 1e-9)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("keys", [{}, {"tip_chamfer": 0.3}, {"tip_chamfer": 0.9}, {"tip_rounding": 0.4}])
def test_a_tip_that_is_used_up_ends_in_an_edge(keys: dict[str, float]) -> None:
    """Drawn in by more than its half width lets: the flanks, or what is left of chamfers, meet on the centre line."""
    whole = rack_region(rack(teeth=1, **keys)).region.outer
    lost = set()
    for offset in (-0.3, -0.7, -0.9, -1.1, -1.4):
        found = rack_region(rack(teeth=1, **keys), offset)
        points = period_points(found.region.outer, 12)
        assert abs(distance_to_outline(points, whole) + offset).max() <= 1e-9
        top = float(points.imag.max())
        codes = {f.code for f in found.findings}
        # the tip line, the chamfers' crossing, the flanks' crossing: the lowest of those that are there
        flanks = (math.pi / 2) / TAN + offset / math.sin(ALPHA)
        ends = [2.0 + offset, flanks]
        if chamfer := keys.get("tip_chamfer"):
            # at 45 degrees from its foot on the flank
            ends.append(2.0 - chamfer + (math.pi / 2 - (2.0 - chamfer) * TAN) + offset * math.sqrt(2))
        assert top == pytest.approx(min(ends), abs=1e-9)
        assert ("tip_lost" in codes) == (min(ends) < 2.0 + offset - 1e-12)
        if "tip_lost" in codes:
            (finding,) = (f for f in found.findings if f.code == "tip_lost")
            assert finding.limit == 0.0
            assert finding.value == pytest.approx(2.0 + offset - top, abs=1e-9)
            lost.add(any(s.label is Label.TIP_BREAK for s in found.region.outer.period))
    assert lost

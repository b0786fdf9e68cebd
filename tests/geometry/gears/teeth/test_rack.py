"""Racks: the basic rack's tooth by hand, exact offsets, the pair with a gear and its contact."""

from __future__ import annotations

import math
import random
from itertools import pairwise

import numpy as np
import pytest
import shapely

from geometry.base.errors import OffsetError, ParameterError
from geometry.base.record import replace
from geometry.gears.mesh.rack import RackMesh
from geometry.gears.pairs.rack import RackPair, rack_pair
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.limits import undercut
from geometry.gears.teeth.rack import Rack, checked_part_rack, rack_region
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.distance import Verdict
from geometry.plane.measure import profile_area
from geometry.plane.profile import Label, Profile, joint_turn
from tests import brute

ALPHA = math.radians(20.0)


def rack(teeth: int = 5, basic: BasicRack | None = None, **keys: float) -> Rack:
    return Rack(2.0, teeth, basic or iso_53(), 6.0, **keys)


def polygon(profile: Profile, points: int = 60) -> shapely.Polygon:
    one = np.concatenate([brute.dense(s.curve, points)[:-1] for s in profile.period])
    return shapely.Polygon(np.column_stack([one.real, one.imag]))


def test_the_tooth_by_hand() -> None:
    """m 2, ISO 53 A: tips 2 mm above the datum line, root 2.5 below, flanks at 20 degrees, half a pitch thick."""
    gear = checked_part_rack(rack())
    profile = rack_region(gear).region.outer
    points = brute.period_points(profile, 50)
    assert points.imag.max() == pytest.approx(2.0, abs=1e-13)
    assert points.imag.min() == pytest.approx(-8.5, abs=1e-13)
    assert np.abs(points.real).max() == pytest.approx(5 * math.pi, abs=1e-12)
    flanks = [s.curve for s in profile.period if s.label is Label.FLANK]
    assert len(flanks) == 10
    for curve in flanks:
        low, high = (complex(curve.point(t)) for t in (0.0, 1.0))
        lean = math.atan2(abs((high - low).real), abs((high - low).imag))
        assert lean == pytest.approx(ALPHA, abs=1e-12)
        # on the datum line a flank stands a quarter of a pitch from its tooth's centre line
        at_datum = (low + (high - low) * low.imag / (low.imag - high.imag)).real
        assert abs(math.remainder(at_datum, 2 * math.pi)) == pytest.approx(math.pi / 2, abs=1e-12)
    fillets = [s.curve for s in profile.period if s.label is Label.ROOT_FILLET]
    assert {round(c.radius, 12) for c in fillets} == {0.76}  # type: ignore[attr-defined]


def test_area_of_a_sharp_rack_by_hand() -> None:
    """Sharp corners: every tooth is a trapezium on a rectangle."""
    gear = rack(3, BasicRack(ALPHA, 1.0, 0.25, 0.0))
    trapezium = 4.5 * (math.pi + 2 * (2.5 - 2.0) / 2 * math.tan(ALPHA))
    assert profile_area(rack_region(gear).region.outer) == pytest.approx(3 * (trapezium + 2 * math.pi * 6), rel=1e-13)


@pytest.mark.parametrize("keys", [{}, {"tip_chamfer": 0.3}, {"tip_rounding": 0.3}, {"circumferential_thinning": 0.2}])
def test_joins_are_smooth_where_they_should_be(keys: dict[str, float]) -> None:
    profile = rack_region(checked_part_rack(rack(2, **keys))).region.outer
    assert profile_area(profile) > 0
    segments = [*profile.period, profile.period[0]]
    smooth = {Label.ROOT_FILLET, Label.TIP_BREAK} if "tip_rounding" in keys else {Label.ROOT_FILLET}
    for before, after in pairwise(segments):
        if smooth & {before.label, after.label}:
            assert abs(joint_turn(before.curve, after.curve)) <= 1e-12


@pytest.mark.sampled(4)
@pytest.mark.parametrize("offset", [-1.0, -0.5, -0.1, 0.1, 0.5, 0.9])
@pytest.mark.parametrize("keys", [{}, {"tip_chamfer": 0.3}, {"tip_rounding": 0.3}, {"circumferential_thinning": 0.1}])
def test_offsets_lie_at_their_distance(keys: dict[str, float], offset: float) -> None:
    gear = rack(3, **keys)
    outline, moved = (rack_region(gear, d).region.outer for d in (0.0, offset))
    points = brute.period_points(moved, 40)
    assert np.abs(brute.distance_to_outline(points, outline) - abs(offset)).max() <= 1e-9
    exact = polygon(moved)
    assert exact.is_valid
    assert exact.exterior.is_ccw
    buffered = polygon(outline).buffer(offset, quad_segs=60)
    assert exact.symmetric_difference(buffered).area <= 3e-4 * exact.area


@pytest.mark.parametrize("offset", [1.2, -5.0, math.inf])
def test_offsets_that_no_rack_survives_name_one_that_works(offset: float) -> None:
    refused = brute.refusal(lambda: rack_region(rack(), offset))
    assert isinstance(refused, OffsetError)
    assert polygon(rack_region(rack(), refused.nearest_offset * (1 - 1e-9)).region.outer).is_valid


def test_a_pointed_rack_is_drawn_in_with_a_finding() -> None:
    found = rack_region(rack(), -1.4)
    assert "tip_lost" in {f.code for f in found.findings}
    points = brute.period_points(found.region.outer, 40)
    assert np.abs(brute.distance_to_outline(points, rack_region(rack()).region.outer) - 1.4).max() <= 1e-9


@pytest.mark.parametrize(("name", "value"), [
    ("circumferential_thinning", 2.0), ("tip_chamfer", 3.0), ("tip_rounding", 3.0), ("body_height", 0.0),
    ("tip_chamfer", -1.0), ("circumferential_thinning", math.nan), ("tip_rounding", math.inf),
])  # fmt: skip
def test_refusals_name_a_value_that_works(name: str, value: float) -> None:
    wrong = replace(rack(), **{name: value})
    refused = brute.refusal(lambda: checked_part_rack(wrong))
    assert isinstance(refused, ParameterError)
    assert refused.name == name
    works = brute.works(refused)
    checked_part_rack(replace(wrong, **{name: works}))
    if refused.nearest.side == "at_most":  # type: ignore[union-attr]
        with pytest.raises(ParameterError):
            checked_part_rack(replace(wrong, **{name: works + 2e-4}))


def pair_of(teeth: int, x: float = 0.0, *, thin: float = 0.0, name: str = "C", module: float = 2.0) -> RackPair:
    basic = iso_53(name)
    gear = SpurGear(module, teeth, basic, x, circumferential_thinning=thin)
    return rack_pair(gear, Rack(module, 10, basic, 6.0, thin))


def test_quantities_by_hand() -> None:
    """z 20, m 2, x 0: contact ratio of the rack by the textbook's sum of approach and recess."""
    pair = pair_of(20)
    assert pair.distance == 20
    assert pair.travel_per_turn == pytest.approx(40 * math.pi)
    recess = math.sqrt(22**2 - (20 * math.cos(ALPHA)) ** 2) - 20 * math.sin(ALPHA)
    approach = 2 / math.sin(ALPHA)
    assert pair.contact_ratio == pytest.approx((recess + approach) / (2 * math.pi * math.cos(ALPHA)), rel=1e-13)
    assert pair.tip_clearances == (pytest.approx(0.5), pytest.approx(0.5))
    assert pair_of(20, 0.3).distance == pytest.approx(20.6)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("teeth", "x", "name"), [(23, 0.0, "A"), (18, 0.3, "C"), (100, -0.2, "A"), (12, 0.5, "C"),
                                                  (40, 0.1, "B"), (1000, 0.0, "C")])  # fmt: skip
def test_contact_without_backlash(teeth: int, x: float, name: str) -> None:
    pair = pair_of(teeth, x, name=name)
    assert {f.code for f in pair.findings()} <= {"fillet_interference_gear", "fillet_interference_rack"}
    found = RackMesh(pair).contact()
    assert found.verdict is Verdict.CONTACT
    assert np.abs(np.array(found.side_gaps)).max() <= 1e-8 * pair.module
    for side in (1, -1):
        shift = side * 1.1e-6 * pair.module
        moved = RackMesh(pair, rack_shift=shift).contact()
        assert moved.verdict is Verdict.OVERLAP
        assert moved.worst.gap == pytest.approx(-1.1e-6 * pair.module * math.cos(ALPHA), rel=1e-2)
    step = 0.02 * pair.module
    nearer = RackMesh(pair, distance_shift=-step).contact().worst.gap
    assert nearer <= -step * math.sin(ALPHA) * (1 - 1e-6)
    if name != "A":  # the rounding of rack A takes all of its clearance: tips strike the fillets first
        assert nearer == pytest.approx(-step * math.sin(ALPHA), rel=1e-6)
    assert RackMesh(pair, distance_shift=step).contact().verdict is Verdict.CLEAR


def test_contact_with_backlash() -> None:
    pair = pair_of(25, 0.1, thin=0.05)
    backlash = pair.normal_backlash
    assert backlash == pytest.approx(0.1 * math.cos(ALPHA), rel=1e-13)
    found = RackMesh(pair).contact()
    assert np.abs(np.array(found.side_gaps) - backlash / 2).max() <= 1e-8
    slack = backlash / (2 * math.cos(ALPHA))
    assert RackMesh(pair, rack_shift=slack).contact().verdict is Verdict.CONTACT
    assert RackMesh(pair, rack_shift=-slack).contact().verdict is Verdict.CONTACT
    assert RackMesh(pair, rack_shift=slack + 2e-6).contact().verdict is Verdict.OVERLAP
    wider = rack_pair(pair.gear, pair.rack, pair.distance + 0.1)
    assert wider.normal_backlash == pytest.approx(backlash + 0.2 * math.sin(ALPHA), rel=1e-12)
    with pytest.raises(ParameterError, match="teeth_overlap") as caught:
        rack_pair(pair.gear, pair.rack, pair.distance - 0.2)
    rack_pair(pair.gear, pair.rack, brute.works(caught.value))


def test_interference_is_found_as_overlap() -> None:
    """Negative control: the tips of an ordinary rack in the undercut root of a small gear, cut by a shorter tool."""
    gear = SpurGear(2.0, 9, BasicRack(ALPHA, 0.7, 0.1, 0.0), 0.25)
    pair = rack_pair(gear, rack(10, BasicRack(ALPHA, 1.0, 0.25, 0.2)))
    assert "fillet_interference_gear" in {f.code for f in pair.findings()}
    assert RackMesh(pair).contact().verdict is Verdict.OVERLAP


@pytest.mark.sampled(3)
@pytest.mark.parametrize("longer", [0.0, 2e-5, 1e-4, 1e-3])
@pytest.mark.parametrize("x", [0.0, 0.4])
def test_a_tip_in_a_fillet_is_remarked_where_the_teeth_overlap(longer: float, x: float) -> None:
    """A rack A as it stands was remarked: its rounding takes 3e-5 modules more than its clearance, 1.6e-9 deep."""
    basic = iso_53("A")
    mate = replace(basic, addendum=basic.addendum + longer, tip_clearance=basic.tip_clearance - longer)
    gear = SpurGear(2.0, 23, basic, x)
    pair = rack_pair(gear, Rack(2.0, 10, mate, 6.0, 0.0))
    assert pair.margins()[0].margin < 0
    overlaps = RackMesh(pair).contact().verdict is Verdict.OVERLAP
    assert ("fillet_interference_gear" in {f.code for f in pair.findings()}) == overlaps == (longer > 5e-5)


@pytest.mark.parametrize("count", [6, pytest.param(2000, marks=pytest.mark.heavy)])
def test_random_legal_pairs(count: int) -> None:
    numbers, done = random.Random(3), 0
    while done < count:
        pair = pair_of(numbers.randint(8, 200), numbers.uniform(-0.5, 1.0), name=numbers.choice("BCD"))
        if brute.refusal(lambda p=pair: p.sides) is not None or undercut(pair.gear).margin < 0 or pair.findings():  # type: ignore[misc]
            continue
        done += 1
        found = RackMesh(pair).contact()
        assert found.verdict is Verdict.CONTACT, pair
        assert np.abs(np.array(found.side_gaps)).max() <= 1e-8 * pair.module, pair
        shift = numbers.choice((1, -1)) * 1.1e-6 * pair.module
        assert RackMesh(pair, rack_shift=shift).contact().verdict is Verdict.OVERLAP, pair

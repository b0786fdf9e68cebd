"""Proposals for internal pairs inside their blocking contour: against random legal shifts, seen in exact contact."""

from __future__ import annotations

import random

import pytest

from geometry.base.record import replace
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.shifts.finder import for_sum, greatest_contact_ratio, least_sliding, least_wear, legal_shifts
from geometry.gears.shifts.internal import InternalRequirements, least_margin, window
from geometry.gears.shifts.internal_shifts import InternalShiftPair, internal_state
from geometry.gears.teeth import ring_limits
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.cutter import PinionCutter, checked_cutter
from geometry.plane.distance import Verdict
from tests import brute
from tests.geometry.gears.shifts.test_internal_contour import ALPHA, CLOSE, NEAR, PAIR, ROUND, WISH, built, checks
from tests.sampling import some_of


@pytest.mark.parametrize(("pair", "wish"), [
    (PAIR, WISH), pytest.param(ROUND, replace(WISH, tip_clearance=0.0), marks=pytest.mark.heavy),
    pytest.param(CLOSE, replace(WISH, radial_assembly=True), marks=pytest.mark.heavy),
], ids=["20/60", "16/24", "40/50"])  # fmt: skip
def test_proposals_beat_random_legal_shifts(pair: InternalShiftPair, wish: InternalRequirements) -> None:
    wear, ratio, sliding = (f(pair, wish) for f in (least_wear, greatest_contact_ratio, least_sliding))
    assert ratio is not None
    assert sliding is not None
    found = window(pair)
    assert found is not None
    for proposal in filter(None, (wear, ratio, sliding)):
        assert proposal.margin >= -1e-9
        assert least_margin(pair, wish, proposal.first, proposal.second) == proposal.margin
    if wear is not None:
        assert wear.root_sliding[0] == pytest.approx(wear.root_sliding[1], rel=1e-6)
    rng, legal = random.Random(5), 0
    for _ in some_of(range(300), 150):
        x1 = rng.uniform(found.box.left, found.box.right)
        x2 = x1 + rng.uniform(found.lowest, found.highest)
        if least_margin(pair, wish, x1, x2) < 0:
            continue
        legal += 1
        state = internal_state(pair, x1, x2)
        assert state.contact_ratio <= ratio.contact_ratio + 1e-6
        assert min(state.root_sliding(pair.gear_ratio)) <= min(sliding.root_sliding) + 1e-6
    assert legal > 20


@pytest.mark.heavy
def test_proposals_have_contact_of_exact_outlines() -> None:
    for pair, find in ((CLOSE, greatest_contact_ratio), (NEAR, least_sliding)):
        found = find(pair, WISH)
        assert found is not None
        made = built(pair, found.first, found.second)
        assert {f.code for f in made.findings()} <= {"radial_assembly"}
        assert GearMesh(made).contact().verdict is Verdict.CONTACT


def test_a_centre_distance_gets_equal_sliding() -> None:
    for difference in (0.2, 0.8):
        found = for_sum(PAIR, WISH, difference)
        assert found is not None
        assert found.second - found.first == pytest.approx(difference, rel=1e-12)
        assert found.margin >= 0
    wanted = for_sum(PAIR, WISH, 0.05)
    assert wanted is not None
    made = checks(PAIR, wanted.first, wanted.second)
    assert made["equal_sliding"] == pytest.approx(0, abs=1e-9)
    assert for_sum(PAIR, WISH, -0.8) is None
    assert for_sum(PAIR, WISH, 6.0) is None


def test_legal_intervals_end_where_a_requirement_does() -> None:
    (low, high), *_ = legal_shifts(PAIR, WISH, 0.3)
    for end, step in ((low, -1e-9), (high, 1e-9)):
        inside, outside = (least_margin(PAIR, WISH, x, x + 0.3) for x in (end, end + step))
        assert inside >= 0 > outside


@pytest.mark.heavy
@pytest.mark.parametrize("seed", range(6))
def test_random_proposals_have_contact_of_exact_outlines(seed: int) -> None:
    """Whatever the finder proposes can be made, keeps the pair's own limits and touches without overlap."""
    rng, done = random.Random(seed), 0
    while done < 8:
        z1, addendum = rng.randint(10, 90), rng.choice((0.8, 1.0))
        z2 = z1 + rng.choice((rng.randint(3, 15), rng.randint(10, 90)))
        teeth = rng.randint(10, max(11, z2 - 12))
        cutter = PinionCutter(1.0, teeth, ALPHA, addendum=addendum + 0.25, tip_rounding=0.15)
        if brute.refusal(lambda: checked_cutter(cutter)) is not None:  # noqa: B023
            continue
        rack = BasicRack(ALPHA, addendum, 0.25, 0.3)
        pair = InternalShiftPair(z1, z2, rack, cutter, addendum, rng.random() < 0.3)
        wish = replace(WISH, tip_thickness=rng.choice((0.25, 0.4)), contact_ratio=rng.choice((1.05, 1.2)))
        found = rng.choice((least_sliding, greatest_contact_ratio, least_wear))(pair, wish)
        if found is None:
            continue
        done += 1
        made = built(pair, found.first, found.second)
        assert found.margin > -1e-9
        assert {f.code for f in made.findings()} <= {"radial_assembly"}
        assert ring_limits.makes(made.ring)
        assert GearMesh(made).contact().verdict is Verdict.CONTACT, pair

"""The blocking contour against whole pairs built from exact tooth sides, and proposals against random shifts."""

from __future__ import annotations

import math
import random
from itertools import pairwise

import pytest

from geometry.base.errors import GeometryError
from geometry.base.record import replace
from geometry.curves.implicit import Box, level_lines
from geometry.gears.pairs.external import ExternalPair, external_pair
from geometry.gears.pairs.sliding import active_line
from geometry.gears.shifts.choice import shifts_for_distance
from geometry.gears.shifts.external import (
    Requirements,
    ShiftPair,
    active_flank,
    blocking_contour,
    conditions,
    form_tangent,
    least_margin,
    margins,
    state_of,
    usual_box,
)
from geometry.gears.shifts.finder import for_sum, greatest_contact_ratio, least_wear, legal_shifts, nearest_sum
from geometry.gears.teeth import limits
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear, transverse_rack
from tests.sampling import some_of

RACK = iso_53()
PAIR = ShiftPair(13, 21, RACK)
WISH = Requirements()


def built(pair: ShiftPair, x1: float, x2: float) -> ExternalPair:
    """The pair from exact tooth sides, module 1."""
    made = external_pair(
        SpurGear(1.0, pair.first_teeth, pair.rack, x1), SpurGear(1.0, pair.second_teeth, pair.rack, x2)
    )
    assert made.sides
    return made


def random_states(seed: int, count: int) -> list[tuple[ShiftPair, float, float, ExternalPair]]:
    """Pairs that can be built, legal or not: z 8 to 80, racks A to D."""
    rng, found = random.Random(seed), []
    while len(found) < count:
        pair = ShiftPair(rng.randint(8, 80), rng.randint(8, 80), iso_53(rng.choice("ABCD")))
        x1, x2 = rng.uniform(-0.6, 1.2), rng.uniform(-0.6, 1.2)
        try:
            found.append((pair, x1, x2, built(pair, x1, x2)))
        except GeometryError:
            continue
    return found


def test_closed_forms_agree_with_built_pairs() -> None:
    kinds = set()
    for pair, x1, x2, made in random_states(1, 60):
        state = state_of(pair, x1, x2)
        assert state.working_centre_distance == pytest.approx(made.working_centre_distance, rel=1e-12)
        assert state.contact_ratio == pytest.approx(made.contact_ratio, rel=1e-9, abs=1e-9)
        for i, gear in enumerate(made.gears):
            thin = limits.thin_tip(gear)
            assert state.tip_thicknesses[i] == pytest.approx(thin.value, abs=1e-9)
            kinds.add(("thin", state.tip_thicknesses[i] < 0.3))
            kinds.add(("undercut", limits.undercut(gear).margin < 0))
            flank = active_flank(pair, x1, x2, i)
            twin = made.flank_starts()[i]
            assert (flank.value, flank.limit) == pytest.approx((twin.value, twin.limit), abs=1e-7)
            kinds.add((twin.name.rsplit("_", 1)[0], twin.margin < 0))
        # sliding counts from the ends of the flanks that are there
        if all(m.margin > 0 for m in made.flank_starts()):
            assert state.root_sliding(pair.gear_ratio) == pytest.approx(active_line(made).root_sliding, rel=1e-7)
    assert {
        ("fillet_interference", True),
        ("active_flank_cut_away", True),
        ("undercut", False),
        ("thin", True),
    } <= kinds


def told(made: ExternalPair, pair: ShiftPair, x1: float, x2: float) -> dict[str, float]:
    """What each condition compares, less its limit where it has one, by the built pair's own sizes, in modules."""
    alpha = made.working_pressure_angle
    reaches = [math.sqrt(g.tip_radius**2 - g.base_radius**2) - g.base_radius * math.tan(alpha) for g in made.gears]
    found = {"working_angle": math.tan(alpha) - alpha, "approach": reaches[1], "recess": reaches[0]}
    found["contact_ratio"] = made.contact_ratio
    for i, (who, gear) in enumerate(zip(("first", "second"), made.gears, strict=True)):
        found[f"tip_thickness_{who}"] = limits.tip_thickness(gear)
        # h_Ff sin^2 less z / 2 sin^2: the rack's straight flank ends where the line of action begins
        sine = math.sin(pair.rack.pressure_angle) ** 2
        found[f"undercut_{who}"] = (x1, x2)[i] - (pair.rack.form_dedendum - gear.number_of_teeth / 2 * sine)
        found[f"active_flank_{who}"] = made.flank_starts()[i].margin
    return found


def test_each_condition_is_what_its_name_says() -> None:
    wish = Requirements(0.25, 1.15, pole_inside=True)
    limits_of = {"tip_thickness_first": 0.25, "tip_thickness_second": 0.25, "contact_ratio": 1.15}
    for pair, x1, x2, made in random_states(7, 12):
        value = told(made, pair, x1, x2)
        for name, condition in conditions(pair).items():
            if condition.name == "equal_sliding":
                continue
            assert name == (condition.name if condition.level is None else f"{condition.name} {condition.level:g}")
            wanted = value[condition.name] - (condition.level or 0.0)
            assert condition.margin(x1, x2) == pytest.approx(wanted, rel=1e-7, abs=1e-7)
        asked = {m.name: m for m in margins(pair, wish, x1, x2)}
        assert asked.keys() == value.keys()
        for name, margin in asked.items():
            assert margin.margin == pytest.approx(value[name] - limits_of.get(name, 0.0), rel=1e-7, abs=1e-7)
            assert margin.margin == margin.value - margin.limit
        assert least_margin(pair, wish, x1, x2) <= min(m.margin for n, m in asked.items() if "active" not in n)
        loose = {m.name for m in margins(pair, replace(wish, allow_undercut=True, pole_inside=False), x1, x2)}
        assert asked.keys() - loose == {"undercut_first", "undercut_second", "approach", "recess"}


@pytest.mark.parametrize(("helix", "overlap"), [(15.0, 0.3), (40.0, 1.4)])
def test_helical_teeth_are_judged_by_their_section_in_normal_modules(helix: float, overlap: float) -> None:
    """Gears given by normal data, cut by the normal rack; the total contact ratio, of which overlap alone is none."""
    beta, rng = math.radians(helix), random.Random(5)
    wish, kinds = Requirements(0.25, 1.15), set()
    for _ in range(12):
        pair = ShiftPair(rng.randint(8, 40), rng.randint(8, 60), transverse_rack(RACK, beta), True, beta, overlap)
        x1, x2 = rng.uniform(-0.6, 1.2), rng.uniform(-0.6, 1.2)
        one, two = (transverse_gear(SpurGear(2.0, z, RACK, x), beta) for z, x in zip(pair.teeth, (x1, x2), strict=True))
        try:
            made = external_pair(one, two)
        except GeometryError:
            continue
        state = state_of(pair, x1, x2)
        assert 2 * state.working_centre_distance == pytest.approx(made.working_centre_distance, rel=1e-12)
        assert state.contact_ratio == pytest.approx(made.contact_ratio + overlap, rel=1e-9)
        assert 2 * state.tip_shortening == pytest.approx(made.tip_shortening_coefficient * made.module, abs=1e-9)
        found = {m.name: m for m in margins(pair, wish, x1, x2)}
        assert found["total_contact_ratio"].limit == max(1.15, overlap)
        for i, (who, gear) in enumerate(zip(("first", "second"), made.gears, strict=True)):
            assert 2 * found[f"tip_thickness_{who}"].value == pytest.approx(limits.tip_thickness(gear), abs=1e-9)
            least = limits.undercut(gear)
            assert 2 * found[f"undercut_{who}"].margin == pytest.approx(least.margin * made.module, abs=1e-9)
            flank, twin = found[f"active_flank_{who}"], made.flank_starts()[i]
            assert (2 * flank.value, 2 * flank.limit) == pytest.approx((twin.value, twin.limit), abs=1e-7)
            kinds.add(twin.name.rsplit("_", 1)[0])
        named = {c.name: c.level for c in conditions(pair).values()}
        # the last of its levels; those below the overlap are no contact
        assert named["total_contact_ratio"] == max(1.2, overlap)
    assert kinds == {"fillet_interference", "active_flank_cut_away"}


def test_form_tangent_is_the_built_one_undercut_or_not() -> None:
    for z, x in ((8, 0.0), (8, 0.56), (17, 0.0), (30, -0.9), (30, 0.2)):
        gear = SpurGear(1.0, z, RACK, x, z + 1.0)
        form = limits.root_form_diameter(gear) / 2
        tangent = math.sqrt(max(form**2 - gear.base_radius**2, 0.0))
        assert form_tangent(z, RACK, x) == pytest.approx(tangent, abs=1e-7)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("teeth", [(13, 21), (20, 20)], ids=str)
def test_every_point_of_every_line_is_on_it_and_the_sides_differ(teeth: tuple[int, int]) -> None:
    pair = ShiftPair(*teeth, RACK)
    box = usual_box(pair, 24)
    assert box is not None
    contour = blocking_contour(pair, WISH, box, 1e-3)
    known = conditions(pair)
    names = {line.name for line in contour.lines}
    assert {"undercut_first", "undercut_second", "contact_ratio", "equal_sliding", "tip_thickness_first",
            "fillet_interference_first", "undercut_to_active_flank_first"} <= names  # fmt: skip
    for line in contour.lines:
        name = line.name.replace("fillet_interference", "active_flank").replace("undercut_to_", "")
        condition = known[name if line.level is None else f"{name} {line.level:g}"]
        for point in line.points[1:-1:5]:
            # an undercut that has only begun leaves the form circle half of the digits
            assert abs(condition.margin(point.real, point.imag)) < 1e-8
            around = [condition.margin(point.real + dx, point.imag + dy)
                      for dx, dy in ((1e-3, 0), (-1e-3, 0), (0, 1e-3), (0, -1e-3))]  # fmt: skip
            assert min(around) < 0 < max(around)


def test_a_line_is_as_close_between_its_points_as_asked() -> None:
    box = Box(0.0, 1.2, -0.4, 1.2, 12)
    rough, fine = (
        blocking_contour(PAIR, WISH, box, tolerance, ["contact_ratio 1.2"]).lines[0].points
        for tolerance in (1e-2, 1e-5)
    )
    assert len(fine) > len(rough)
    margin = conditions(PAIR)["contact_ratio 1.2"].margin
    for one, two in pairwise(fine):
        middle = (one + two) / 2
        # the slope of the contact ratio is about 0.3 a module
        assert abs(margin(middle.real, middle.imag)) < 2e-5


def test_the_region_is_where_all_requirements_hold() -> None:
    """Ray casting on the region's borders against the built pair's own limits, outside a band of 1e-3."""
    box = usual_box(PAIR, 24)
    assert box is not None
    region = blocking_contour(PAIR, WISH, box, 1e-3, []).region
    rng, seen = random.Random(3), set()
    for _ in range(150):
        point = complex(rng.uniform(box.left, box.right), rng.uniform(box.bottom, box.top))
        if min(abs(p - point) for ring in region for p in ring) < 0.03:
            continue
        inside = sum(_winds(ring, point) for ring in region) % 2 == 1
        seen.add(inside)
        try:
            made = built(PAIR, point.real, point.imag)
        except GeometryError:
            assert not inside
            continue
        legal = all(m.margin >= 0 for m in made.flank_starts()) and made.contact_ratio >= WISH.contact_ratio
        legal = legal and all(limits.thin_tip(g).margin >= 0 <= limits.undercut(g).margin for g in made.gears)
        assert legal == inside
    assert seen == {True, False}


def _winds(ring: tuple[complex, ...], point: complex) -> int:
    count = 0
    for one, two in zip(ring, (*ring[1:], ring[0]), strict=True):
        if (one.imag > point.imag) != (two.imag > point.imag):
            share = (point.imag - one.imag) / (two.imag - one.imag)
            count += one.real + share * (two.real - one.real) > point.real
    return count


def test_other_racks_and_full_tips_have_other_contours() -> None:
    full = replace(PAIR, shortened_tips=False)
    stub = replace(PAIR, rack=BasicRack(math.radians(20), 0.8, 0.25, 0.38))
    x = (0.5, 0.4)
    assert state_of(full, *x).contact_ratio > state_of(PAIR, *x).contact_ratio > state_of(stub, *x).contact_ratio


def test_no_pair_below_inv_zero() -> None:
    assert least_margin(PAIR, WISH, -1.0, -1.0) == -1.0
    assert math.isnan(state_of(PAIR, -1.0, -1.0).contact_ratio)
    total = -(34 * (math.tan(math.radians(20)) - math.radians(20))) / (2 * math.tan(math.radians(20)))
    assert state_of(PAIR, total + 1e-9, 0.0).involute > 0 > state_of(PAIR, total - 1e-9, 0.0).involute


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("teeth", "wish"), [
    ((13, 21), WISH),
    pytest.param((25, 18), Requirements(0.25, 1.3), marks=pytest.mark.heavy),
    pytest.param((20, 60), Requirements(0.4, 1.2), marks=pytest.mark.heavy),
    ((10, 30), Requirements(0.25, 1.05, allow_undercut=True)),
], ids=str)  # fmt: skip
def test_proposals_beat_random_legal_shifts(teeth: tuple[int, int], wish: Requirements) -> None:
    pair = ShiftPair(*teeth, RACK)
    wear, ratio = least_wear(pair, wish), greatest_contact_ratio(pair, wish)
    assert wear is not None
    assert ratio is not None
    for found in (wear, ratio):
        assert found.margin >= -1e-9
    assert wear.root_sliding[0] == pytest.approx(wear.root_sliding[1], rel=1e-6)
    rng, legal = random.Random(5), 0
    for _ in some_of(range(400), 200):
        x1, x2 = rng.uniform(-0.6, 1.6), rng.uniform(-0.6, 2.2)
        if least_margin(pair, wish, x1, x2) < 0:
            continue
        legal += 1
        state = state_of(pair, x1, x2)
        assert state.contact_ratio <= ratio.contact_ratio + 1e-6
        one, two = state.root_sliding(pair.gear_ratio)
        if abs(one - two) < 0.01:
            assert min(one, two) <= wear.root_sliding[0] + 0.02
    assert legal > 20


@pytest.mark.parametrize(("pair", "wish"), [
    (ShiftPair(12, 30, RACK), WISH),
    pytest.param(ShiftPair(31, 81, RACK), WISH, marks=pytest.mark.heavy),
    # a corner that reaches beyond the coarse grid of the box
    pytest.param(ShiftPair(8, 24, iso_53("D")), Requirements(0.0, 1.05, True), marks=pytest.mark.heavy),
], ids=["12/30", "31/81", "8/24"])  # fmt: skip
def test_no_legal_shifts_beside_a_proposal_give_more(pair: ShiftPair, wish: Requirements) -> None:
    """In the corners of the contour, where legal intervals are narrower than what is looked at."""
    found = greatest_contact_ratio(pair, wish)
    assert found is not None
    about = [(found.first + i * 0.003, found.second + k * 0.006) for i in range(-10, 11) for k in range(-10, 11)]
    legal = [state_of(pair, *shifts).contact_ratio for shifts in about if least_margin(pair, wish, *shifts) >= 0]
    assert legal
    assert max(legal) <= found.contact_ratio + 1e-7


def test_legal_shifts_between_the_lines_that_are_looked_at_are_found() -> None:
    pair, most = ShiftPair(12, 30, RACK), 1.55709
    found = greatest_contact_ratio(pair, replace(WISH, contact_ratio=most - 1e-4))
    assert found is not None
    assert found.margin >= 0
    assert found.contact_ratio == pytest.approx(most, abs=1e-6)
    # all of them lie within 0.001 of x1 + x2 = -0.3272, what is nearest to another sum too
    near = nearest_sum(pair, replace(WISH, contact_ratio=most - 1e-4), 0.0)
    assert near == pytest.approx(found.first + found.second, abs=1e-3)
    assert greatest_contact_ratio(pair, replace(WISH, contact_ratio=most + 1e-5)) is None


def test_a_centre_distance_gets_equal_sliding() -> None:
    found = for_sum(PAIR, WISH, 0.9)
    assert found is not None
    assert found.first + found.second == pytest.approx(0.9, rel=1e-12)
    sliding = active_line(built(PAIR, found.first, found.second)).root_sliding
    assert sliding[0] == pytest.approx(sliding[1], rel=1e-7)
    assert for_sum(PAIR, WISH, 1.6) is None
    one, two = SpurGear(2.0, 13, RACK), SpurGear(2.0, 21, RACK)
    shifts = shifts_for_distance(one, two, 35.5)
    again = external_pair(*(replace(g, profile_shift_coefficient=x) for g, x in zip((one, two), shifts, strict=True)))
    assert again.working_centre_distance == pytest.approx(35.5, rel=1e-12)
    assert shifts_for_distance(one, two, 35.5, None, 0.3) == pytest.approx((sum(shifts) - 0.3, 0.3), rel=1e-12)


def test_legal_intervals_end_where_a_requirement_does() -> None:
    (low, high), *more = legal_shifts(PAIR, WISH, 0.9)
    assert more == []
    for end, step in ((low, -1e-9), (high, 1e-9)):
        assert least_margin(PAIR, WISH, end, 0.9 - end) >= 0 > least_margin(PAIR, WISH, end + step, 0.9 - end - step)


def test_margins_name_what_is_broken() -> None:
    broken = {m.name for m in margins(PAIR, replace(WISH, pole_inside=True), 1.3, -0.6) if not m.margin >= 0}
    assert (
        broken == {"undercut_second", "tip_thickness_first", "contact_ratio", "active_flank_first", "approach"} & broken
    )
    assert {"undercut_second", "tip_thickness_first"} <= broken
    assert all(m.margin > 0 for m in margins(PAIR, WISH, 0.694, 0.384))


def test_level_lines_of_known_curves() -> None:
    circle = level_lines(lambda x, y: x * x + y * y - 1, Box(-2, 2, -2, 2, 9), 1e-5)
    assert len(circle) == 1
    assert circle[0][0] == circle[0][-1]
    assert all(abs(abs(p) - 1) < 1e-12 for p in circle[0])
    length = sum(abs(b - a) for a, b in pairwise(circle[0]))
    assert length == pytest.approx(2 * math.pi, abs=1e-3)
    hyperbola = level_lines(lambda x, y: x * y - 0.01, Box(-1, 1, -1, 1, 10), 1e-4)
    assert len(hyperbola) == 2
    half = level_lines(lambda x, y: y - 0.3 if x > 0.05 else math.nan, Box(-1, 1, -1, 1, 10), 1e-4)
    assert len(half) == 1
    assert min(p.real for p in half[0]) > 0.05
    assert level_lines(lambda x, y: 1.0, Box(-1, 1, -1, 1, 4), 1e-4) == []

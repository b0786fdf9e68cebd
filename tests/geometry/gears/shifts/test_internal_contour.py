"""The blocking contour of internal pairs against whole pairs built from exact tooth sides, and random shifts."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import pytest
from hypothesis import HealthCheck, assume, given
from hypothesis import strategies as st

from geometry.base.angles import involute_function
from geometry.base.errors import GeometryError
from geometry.base.record import replace
from geometry.curves.implicit import Box
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.pairs.internal import InternalPair, internal_pair
from geometry.gears.pairs.sliding import specific_sliding
from geometry.gears.shifts.external import BlockingContour, ContourLine
from geometry.gears.shifts.finder import greatest_contact_ratio, least_wear
from geometry.gears.shifts.internal import (
    InternalRequirements,
    conditions,
    internal_contour,
    least_margin,
    margins,
    window,
)
from geometry.gears.shifts.internal_shifts import InternalShiftPair, interferences, internal_state, pinion_form
from geometry.gears.teeth import limits, ring_limits
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.cutter import PinionCutter, checked_cutter
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_tooth import rounded_root_plug
from geometry.gears.teeth.shaping import check_shaping
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_cutter, transverse_gear, transverse_rack
from geometry.gears.teeth.transverse_ring import transverse_ring, transverse_root
from geometry.plane.distance import Verdict
from tests import brute
from tests.sampling import examples

ALPHA = math.radians(20)
WISH = InternalRequirements()
BAND = 1e-3


def teeth_pair(z1: int, z2: int, z0: int = 25, **keys: object) -> InternalShiftPair:
    root = PinionCutter(1.0, z0, ALPHA) if z0 else RoundedRoot(1.25, 0.2)
    return InternalShiftPair(z1, z2, iso_53(), root, **keys)  # type: ignore[arg-type]


PAIR = teeth_pair(20, 60)
CLOSE = teeth_pair(40, 50)
NEAR = teeth_pair(45, 48)
ROUND = teeth_pair(16, 24, 0)
SHAPED = teeth_pair(14, 60, 20, pinion_cutter=PinionCutter(1.0, 20, ALPHA))
KHK = teeth_pair(20, 70, 40, plain_tip=True)


def built(pair: InternalShiftPair, x1: float, x2: float) -> InternalPair:
    """The pair from exact tooth sides, module 1; raises where one cannot be built. The ring's cutting is not asked."""
    return whole(pair, pair.pinion(x1), pair.ring(x2))


def whole(pair: InternalShiftPair, pinion: SpurGear, ring: RingGear) -> InternalPair:
    made = internal_pair(pinion, ring)
    if isinstance(pair.root, RoundedRoot):
        checked_cutter(rounded_root_plug(made.ring))
    assert made.sides
    return made


def checks(pair: InternalShiftPair, x1: float, x2: float) -> dict[str, float]:
    """Margins of the built pair by the names of the contour; nan where there is no such pair."""
    return measured(lambda: built(pair, x1, x2))


def measured(make: Callable[[], InternalPair]) -> dict[str, float]:
    try:
        made = make()
    except GeometryError:
        return {}
    # corners that run into a fillet below are no line of contours: tips that would are made shorter
    every = *made.margins(), *ring_limits.margins(made.ring), *made.flank_starts()
    found = {m.name: m.margin for m in every}
    found |= {
        "undercut_first": limits.undercut(made.pinion).margin,
        "tip_thickness_first": limits.tip_thickness(made.pinion),
        "tip_thickness_second": ring_limits.tip_thickness(made.ring),
        "contact_ratio": made.contact_ratio,
        "active_flank_first": found.pop("fillet_interference_pinion"),
        "fillet_interference_second": found.pop("fillet_interference_ring"),
        "tip_clearance_first": found.pop("tip_clearance_pinion"),
        "tip_clearance_second": found.pop("tip_clearance_ring"),
        "tip_above_base": found["tip_above_base"] / 2,
    }
    if made.pinion.cutter is not None:
        refused = brute.refusal(lambda: check_shaping(made.pinion))
        found["cutter_reach_first"] = 1.0 if refused is None else -1.0
    base = made.pinion.base_radius
    pole = base * math.tan(made.working_pressure_angle)
    (low, high), line = made.mesh.base_radii, made.working_centre_distance * math.sin(made.working_pressure_angle)
    tip, ring_tip = made.tip_form_radii
    start, end = math.sqrt(max(ring_tip**2 - high**2, 0)) - line, math.sqrt(tip**2 - low**2)
    feet = (specific_sliding(start, line, made.gear_ratio, -1)[0],
            specific_sliding(end, line, made.gear_ratio, -1)[1])  # fmt: skip
    found |= {"approach": pole - start, "recess": end - pole, "equal_sliding": feet[1] - feet[0]}
    return found | {"sliding_first": feet[0], "sliding_second": feet[1]}


def values(pair: InternalShiftPair, x1: float, x2: float) -> dict[str, float]:
    """The contour's own margins at level 0 of what has levels."""
    known = conditions(pair)
    levelled = {"tip_thickness_first 0", "tip_thickness_second 0", "tip_clearance_first 0", "tip_clearance_second 0"}
    found = {n.removesuffix(" 0"): c.margin(x1, x2) for n, c in known.items() if c.level is None or n in levelled}
    state = internal_state(pair, x1, x2)
    sliding = state.root_sliding(pair.gear_ratio)
    return found | {
        "contact_ratio": state.contact_ratio, "sliding_first": sliding[0], "sliding_second": sliding[1]
    }  # fmt: skip


def random_states(seed: int, count: int) -> list[tuple[InternalShiftPair, float, float, dict[str, float]]]:
    """Pairs that can be built, legal or not."""
    rng, found = random.Random(seed), []
    while len(found) < count:
        z1 = rng.randint(8, 80)
        z2 = z1 + rng.choice((rng.randint(2, 12), rng.randint(12, 80)))
        root: PinionCutter | RoundedRoot = PinionCutter(1.0, rng.randint(8, max(9, z2 - 6)), ALPHA)
        root = root if rng.random() < 0.7 else RoundedRoot(1.25, 0.2)
        shaper = PinionCutter(1.0, 25, ALPHA) if rng.random() < 0.3 else None
        rack = iso_53(rng.choice("ABCD"))
        pair = InternalShiftPair(z1, z2, rack, root, rng.choice((0.8, 1.0)), rng.random() < 0.3, shaper)
        x1 = rng.uniform(-0.6, 1.2)
        x2 = x1 + rng.uniform(-0.3, 0.9)
        if made := checks(pair, x1, x2):
            found.append((pair, x1, x2, made))
    return found


def test_closed_forms_agree_with_built_pairs() -> None:
    kinds = set()
    for pair, x1, x2, made in random_states(1, 140):
        mine = values(pair, x1, x2)
        for name, value in made.items():
            if name in mine and name not in ("equal_sliding", "cutter_reach_first"):
                tolerance = 1e-7 if name == "active_flank_first" else 1e-9
                assert mine[name] == pytest.approx(value, abs=tolerance, rel=1e-9), (name, pair, x1, x2)
                kinds.add((name, value < 0))
        assert math.isnan(mine["equal_sliding"]) or (mine["equal_sliding"] > 0) == (made["equal_sliding"] > 0)
        assert mine.get("rounded_root", 1) >= 0
        if "cutter_reach_first" in made:
            assert (mine["cutter_reach_first"] > 0) == (made["cutter_reach_first"] > 0)
    both = {"undercut_first", "active_flank_first", "fillet_interference_second", "involute_interference",
            "trochoid_interference", "radial_assembly", "cutter_involute_interference", "cutter_radial_assembly",
            "tip_clearance_second", "approach"}  # fmt: skip
    assert {(name, sign) for name in both for sign in (True, False)} <= kinds


@pytest.mark.parametrize(("helix", "overlap"), [(15.0, 0.3), (35.0, 1.4)])
def test_helical_teeth_are_judged_by_their_section_in_normal_modules(helix: float, overlap: float) -> None:
    """Pinion and ring by normal data, cut by normal tools; the total contact ratio, of which overlap alone is none."""
    beta, rng, kinds = math.radians(helix), random.Random(8), set()
    while len(kinds) < 18:
        z1 = rng.randint(8, 60)
        z2 = z1 + rng.choice((rng.randint(2, 12), rng.randint(12, 80)))
        tool: PinionCutter | RoundedRoot = PinionCutter(1.0, rng.randint(8, max(9, z2 - 6)), ALPHA)
        tool = tool if rng.random() < 0.7 else RoundedRoot(1.25, 0.2)
        shaper = PinionCutter(1.0, 25, ALPHA) if rng.random() < 0.3 else None
        addendum, plain = rng.choice((0.8, 1.0)), rng.random() < 0.3
        x1 = rng.uniform(-0.6, 1.2)
        x2 = x1 + rng.uniform(-0.3, 0.9)
        cut = None if shaper is None else transverse_cutter(shaper, beta)
        pair = InternalShiftPair(z1, z2, transverse_rack(iso_53(), beta), transverse_root(tool, beta), addendum, plain,
                                 cut, helix_angle=beta, overlap_ratio=overlap)  # fmt: skip
        pinion = transverse_gear(SpurGear(1.0, z1, iso_53(), x1, cutter=shaper), beta)
        ring = transverse_ring(RingGear(1.0, z2, ALPHA, 900.0, tool, x2, addendum, plain), beta)
        if not (made := measured(lambda: whole(pair, pinion, ring))):  # noqa: B023
            continue
        share = math.cos(beta)
        made["undercut_first"] /= share
        told = values(pair, x1, x2)
        told["contact_ratio"] -= overlap
        for name in made.keys() & told.keys() - {"equal_sliding", "cutter_reach_first"}:
            tolerance = 1e-7 if name == "active_flank_first" else 1e-9
            assert told[name] == pytest.approx(made[name], abs=tolerance, rel=1e-9), (name, pair, x1, x2)
            kinds.add(name)
        state = internal_state(pair, x1, x2)
        distance = (z2 - z1) / share / 2 * math.cos(pair.rack.pressure_angle) / math.cos(state.working_pressure_angle)
        assert state.working_centre_distance == pytest.approx(distance, rel=1e-12)
        asked = {m.name: m for m in margins(pair, replace(WISH, contact_ratio=1.2), x1, x2)}
        assert asked["total_contact_ratio"].limit == max(1.2, overlap)
        levels = {c.level for c in conditions(pair).values() if c.name == "total_contact_ratio"}
        assert max(levels) == max(1.2, overlap)
        assert min(levels) >= overlap or overlap < 1


def test_internal_pair_of_khk() -> None:
    """m 3, 16/24, x2 = 0.516: inv alpha_w 0.0618565, alpha_w 31.3209 deg, a 13.2000, d_a2 69.096."""
    pair = InternalShiftPair(16, 24, iso_53(), RoundedRoot(), plain_tip=True)
    state = internal_state(pair, 0.0, 0.516)
    assert state.involute == pytest.approx(0.0618565, abs=5e-8)
    assert math.degrees(state.working_pressure_angle) == pytest.approx(31.3209, abs=5e-5)
    assert 3 * state.working_centre_distance == pytest.approx(13.2, abs=5e-5)
    assert 6 * state.ring.tip_radius == pytest.approx(69.096, abs=5e-4)


@pytest.mark.parametrize(("teeth", "tips", "radial", "least"), [(40, 9, 17, 24), (60, 9, 17, 21), (80, 8, 16, 20)])
def test_published_least_differences_of_teeth(teeth: int, tips: int, radial: int, least: int) -> None:
    """x = 0, full addenda, 20 degrees: by brute force of others."""
    found = {d: interferences(InternalShiftPair(teeth - d, teeth, iso_53(), RoundedRoot(), plain_tip=True), 0.0, 0.0)
             for d in range(1, teeth - 5)}  # fmt: skip
    assert next(d for d, m in found.items() if m[1] >= 0) == tips
    assert next(d for d, m in found.items() if m[2] >= 0) == radial
    assert min(teeth - d for d, m in found.items() if m[0] >= 0) == least


def contour_of(
    pair: InternalShiftPair, wish: InternalRequirements = WISH, names: list[str] | None = None
) -> BlockingContour:
    found = window(pair)
    assert found is not None
    return internal_contour(pair, wish, replace(found.box, cells=12), 1e-2, names)


def failed(pair: InternalShiftPair, point: complex, wanted: dict[str, float]) -> set[str] | None:
    """The checks of the built pair that are broken; None where it cannot be built."""
    made = checks(pair, point.real, point.imag)
    return {n for n, v in made.items() if v < wanted.get(n, 0.0)} if made else None


# checks whose line is an end of existence: beyond it there is no pair to build
EXISTENCE = {"rounded_root", "working_angle", "tip_above_base", "cutter_working_angle", "cutter_working_angle_first"}


def line_check(line: ContourLine) -> str:
    return line.name.replace("fillet_interference_first", "active_flank_first").replace("undercut_to_", "")


# where contact reaches a base circle sliding has no bound
ENDLESS = {"approach": "sliding_first", "recess": "sliding_second"}


def sides_told_apart(pair: InternalShiftPair, most: int) -> dict[str, int]:
    """Points of each line where exactly its check flips within ``BAND`` in x, with how many were looked at."""
    seen: dict[str, int] = {}
    known = conditions(pair)
    for line in contour_of(pair).lines:
        name, wanted = line_check(line), {line_check(line): line.level or 0.0}
        condition = known[name if line.level is None else f"{name} {line.level:g}"]
        usable = range(1, len(line.points) - 1)
        for k in usable[:: max(1, len(usable) // most)]:
            point, along = line.points[k], line.points[k + 1] - line.points[k - 1]
            assert abs(condition.margin(point.real, point.imag)) < 1e-7
            step = 1j * BAND * along / abs(along)
            sides = [failed(pair, p, wanted) for p in (point + step, point - step)]
            if name in EXISTENCE:
                seen[name] = seen.get(name, 0) + (None in sides)
                continue
            if None in sides:
                continue
            one, two = sides
            assert one is not None
            assert two is not None
            # where another line passes within the band two checks may change
            if one ^ two == {name, ENDLESS.get(name, name)}:
                seen[name] = seen.get(name, 0) + 1
            else:
                assert name in one ^ two or crosses(pair, point), (name, point, one, two)
    return seen


def crosses(pair: InternalShiftPair, point: complex) -> bool:
    """Whether the point is an end of existence."""
    near = (point + BAND * 2 * d for d in (1, -1, 1j, -1j))
    return any(not checks(pair, p.real, p.imag) for p in near)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("pair", "expected"), [
    (PAIR, {"undercut_first", "fillet_interference_second", "approach", "recess", "involute_interference",
            "active_flank_first", "tip_thickness_first", "contact_ratio", "tip_clearance_second", "equal_sliding",
            "working_angle", "cutter_working_angle"}),
    (CLOSE, {"radial_assembly", "cutter_radial_assembly", "trochoid_interference", "fillet_interference_second"}),
    pytest.param(NEAR, {"trochoid_interference", "radial_assembly", "contact_ratio", "tip_clearance_second"},
                 marks=pytest.mark.heavy),
    (ROUND, {"rounded_root", "tip_above_base", "trochoid_interference", "radial_assembly", "involute_interference"}),
], ids=["20/60", "40/50", "45/48", "16/24"])  # fmt: skip
def test_beside_a_line_exactly_its_check_fails_or_passes(pair: InternalShiftPair, expected: set[str]) -> None:
    seen = sides_told_apart(pair, 4)
    assert {name for name, count in seen.items() if count} >= expected


def test_a_shift_that_no_cutter_makes_has_no_involute() -> None:
    """Contours are sought beyond the shifts that leave a tooth."""
    assert math.isnan(pinion_form(SHAPED, -0.9))
    assert pinion_form(SHAPED, 0.0) > 0


@pytest.mark.heavy
@pytest.mark.parametrize("pair", [SHAPED, KHK], ids=["shaped pinion", "KHK tips"])
def test_lines_of_other_rules(pair: InternalShiftPair) -> None:
    seen = sides_told_apart(pair, 3)
    assert seen["active_flank_first"] > 0
    assert seen["fillet_interference_second"] > 0


def interference_by_formulas(pair: InternalShiftPair, x1: float, x2: float) -> tuple[float, float, float]:
    """The three conditions of KHK as printed, each >= 0 where kept: ratio, angle, arcsine form."""
    z1, z2 = pair.teeth
    ra = z1 / 2 + 1 + x1, z2 / 2 - 1 + x2 + (0 if pair.plain_tip else max(0.25 - 0.125 * x2, 0))
    inv_w = involute_function(ALPHA) + 2 * math.tan(ALPHA) * (x2 - x1) / (z2 - z1)
    low, high = 0.0, 1.5
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if math.tan(middle) - middle < inv_w else (low, middle)
    a_w = (z2 - z1) / 2 * math.cos(ALPHA) / math.cos(low)
    tip = [math.acos(z / 2 * math.cos(ALPHA) / r) for z, r in zip((z1, z2), ra, strict=True)]
    first = z1 / z2 - (1 - math.tan(tip[1]) / math.tan(low))
    theta1 = math.acos((ra[1] ** 2 - ra[0] ** 2 - a_w**2) / (2 * ra[0] * a_w)) + math.tan(tip[0]) - tip[0] - inv_w
    theta2 = math.acos((a_w**2 + ra[1] ** 2 - ra[0] ** 2) / (2 * ra[1] * a_w))
    second = theta1 * z1 / z2 + inv_w - (math.tan(tip[1]) - tip[1]) - theta2
    squares = [(1 - (math.cos(tip[0]) / math.cos(tip[1])) ** (2 * s)) / (1 - (z1 / z2) ** (2 * s)) for s in (1, -1)]
    if not 0 < squares[0] < 1 or not 0 < squares[1] < 1:
        return first, second, math.nan
    one, two = (math.asin(math.sqrt(s)) for s in squares)
    invs = math.tan(tip[0]) - tip[0] - inv_w, math.tan(tip[1]) - tip[1] - inv_w
    return first, second, one + invs[0] - z2 / z1 * (two + invs[1])


@pytest.mark.sampled(1)
@pytest.mark.parametrize("pair", [CLOSE, NEAR, teeth_pair(30, 44)], ids=["40/50", "45/48", "30/44"])
def test_the_lines_of_interference_by_printed_formulas(pair: InternalShiftPair) -> None:
    names = ["involute_interference", "trochoid_interference", "radial_assembly"]
    lines, seen = contour_of(pair, names=names).lines, set()
    for line in lines:
        for point in line.points[1:-1:3]:
            found = interference_by_formulas(pair, point.real, point.imag)[names.index(line.name)]
            if not math.isnan(found):
                assert abs(found) < 1e-9, (line.name, point)
                seen.add(line.name)
    assert {"trochoid_interference", "radial_assembly"} <= seen


def contact_beside(pair: InternalShiftPair, name: str, most: int) -> int:
    """How many points of an interference line told its sides apart in the contact of the exact outlines."""
    told, margin = 0, conditions(pair)[name].margin
    rest = replace(WISH, tip_thickness=0.05, contact_ratio=1.05, allow_undercut=True)
    for line in contour_of(pair, names=[name]).lines:
        if line.name.startswith("undercut"):
            continue
        free = [k for k in range(1, len(line.points) - 1)
                if all(m.margin > 0.01 for m in margins(pair, rest, line.points[k].real, line.points[k].imag)
                       if m.name not in (name, "contact_ratio", "working_angle"))]  # fmt: skip
        for k in free[:: max(1, len(free) // most)][:most]:
            along = line.points[k + 1] - line.points[k - 1]
            step = 1j * BAND * along / abs(along)
            inside, outside = line.points[k] + step, line.points[k] - step
            if margin(inside.real, inside.imag) < 0:
                inside, outside = outside, inside
            assert margin(inside.real, inside.imag) > 0 > margin(outside.real, outside.imag)
            gaps = [GearMesh(built(pair, p.real, p.imag)).contact() for p in (inside, outside)]
            assert gaps[0].verdict is Verdict.CONTACT, (name, inside)
            # flanks part by the square of the distance, tips by the distance itself
            assert gaps[1].worst.gap < (-1e-5 if name == "trochoid_interference" else -2e-12), (name, outside)
            told += 1
    return told


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("pair", "name"), [
    (KHK, "active_flank_first"), (teeth_pair(60, 80, 20), "fillet_interference_second"),
    (teeth_pair(33, 42), "trochoid_interference"),
], ids=lambda v: v if isinstance(v, str) else "")  # fmt: skip
def test_contact_on_both_sides_of_the_interference_lines(pair: InternalShiftPair, name: str) -> None:
    assert contact_beside(pair, name, 2) >= 2


def test_the_region_is_where_all_requirements_hold() -> None:
    """Ray casting on the region's borders against the built pair's own limits, outside a band."""
    wish = replace(WISH, radial_assembly=True)
    contour = contour_of(CLOSE, wish, [])
    box, rng, seen = contour.box, random.Random(3), set()
    for _ in range(150):
        point = complex(rng.uniform(box.left, box.right), rng.uniform(box.bottom, box.top))
        if rng.random() < 0.6:
            point = complex(point.real, point.real + rng.uniform(0, 0.6))
        if min(abs(p - point) for ring in contour.region for p in ring) < 0.05:
            continue
        inside = sum(winds(ring, point) for ring in contour.region) % 2 == 1
        seen.add(inside)
        wanted = {"contact_ratio": wish.contact_ratio, "tip_thickness_first": wish.tip_thickness,
                  "tip_thickness_second": wish.tip_thickness, "tip_clearance_first": wish.tip_clearance,
                  "tip_clearance_second": wish.tip_clearance}  # fmt: skip
        broken = failed(CLOSE, point, wanted)
        asked = {m.name for m in margins(CLOSE, wish, 0.0, 0.0)}
        assert (broken is not None and not broken & asked) == inside, (point, broken)
    assert seen == {True, False}


def winds(ring: tuple[complex, ...], point: complex) -> int:
    count = 0
    for one, two in zip(ring, (*ring[1:], ring[0]), strict=True):
        if (one.imag > point.imag) != (two.imag > point.imag):
            share = (point.imag - one.imag) / (two.imag - one.imag)
            count += one.real + share * (two.real - one.real) > point.real
    return count


def test_a_region_that_leaves_the_box_is_closed_along_it() -> None:
    pair = teeth_pair(96, 144, 34)
    contour = internal_contour(pair, WISH, Box(-0.5, 0.5, -0.5, 0.5, 10), 1e-2, [])
    assert len(contour.region) == 1
    (ring,) = contour.region
    assert ring[0] == ring[-1]
    assert max(p.real for p in ring) == pytest.approx(0.5, abs=1e-9)
    assert winds(ring, 0.49 + 0.49j) % 2 == 1


def test_no_pair_below_inv_zero_nor_with_too_large_a_cutter() -> None:
    low = -involute_function(ALPHA) * 40 / (2 * math.tan(ALPHA))
    assert internal_state(PAIR, 0.0, low + 1e-9).involute > 0 > internal_state(PAIR, 0.0, low - 1e-9).involute
    assert least_margin(PAIR, WISH, 0.0, low - 0.01) == -1.0
    assert all(math.isnan(m) for m in interferences(PAIR, 0.0, low - 0.01))
    assert window(teeth_pair(20, 60, 60)) is None
    assert least_wear(teeth_pair(20, 60, 60), WISH) is None
    assert greatest_contact_ratio(teeth_pair(20, 60, 60), WISH) is None


@examples(60, suppress_health_check=[HealthCheck.filter_too_much])
@given(st.integers(8, 150), st.integers(3, 150), st.floats(0.1, 0.9), st.floats(-1.0, 1.5), st.floats(-0.5, 2.0),
       st.sampled_from((0.8, 1.0)), st.booleans(), st.floats(14.5, 28))  # fmt: skip
def test_what_the_contour_calls_legal_can_be_built_without_findings(
    z1: int, more: int, share: float, x1: float, difference: float, addendum: float, plain: bool, degrees: float
) -> None:
    alpha, z2 = math.radians(degrees), z1 + more
    cutter = PinionCutter(1.0, max(8, round(share * z2)), alpha, addendum=addendum + 0.25, tip_rounding=0.1)
    assume(brute.refusal(lambda: checked_cutter(cutter)) is None)
    pair = InternalShiftPair(z1, z2, BasicRack(alpha, addendum, 0.25, 0.3), cutter, addendum, plain)
    wish = InternalRequirements(0.0, 1.0, allow_undercut=True, tip_clearance=0.0)
    x2 = x1 + difference
    margin = least_margin(pair, wish, x1, x2)
    made = checks(pair, x1, x2)
    ours = {m.name for m in margins(pair, wish, x1, x2)}
    if margin > 1e-9:
        assert made
        assert {f.code for f in built(pair, x1, x2).findings()} <= {"radial_assembly"}
        assert ring_limits.makes(pair.ring(x2))
    elif margin < -1e-9:
        # what it refuses breaks one of the pair's own limits, or does not exist
        assert not made or any(v < (1.0 if n == "contact_ratio" else 0.0) for n, v in made.items() if n in ours)

"""The external pair: the practicum's numbers, 40-digit formulas, random and spoilt pairs.

Dense polygons are the other witness of the gaps: tests/geometry/plane/test_contact.py.

Practicum: seed document 000, practical work 3, section 3.1, recomputed without intermediate rounding; the printed
numbers that are misprints stand in PRACTICUM_MISPRINTS with what they should be.
"""

from __future__ import annotations

import cmath
import math
import random
from functools import cache

import mpmath
import numpy as np
import pytest

from geometry.base.angles import involute_function
from geometry.base.errors import GeometryError, ParameterError
from geometry.base.record import replace
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.mesh.search import PairContact
from geometry.gears.pairs.external import ExternalPair, external_pair
from geometry.gears.teeth import limits
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.plane import distance as contact
from geometry.plane.distance import Verdict
from geometry.plane.profile import Label
from tests.brute import works

RACK = iso_53()
# seed 000, 3.1: z 13/21, m 10, x 0.694/0.384 (table В), alpha 20; ids 000.p3.*
PRACTICUM = {
    "u": 1.6153846153846154, "inv_alpha_w": 0.037984378722569746, "alpha_w_deg": 26.933119503603645,
    "a_w": 179.18263740574994, "r_w1": 68.51100841984557, "r_w2": 110.67162898590438,
    "r_1": 65.0, "r_2": 105.0, "r_b1": 61.080020351084045, "r_b2": 98.66772518252039,
    "r_f1": 59.44, "r_f2": 96.34, "dy": 0.1597362594250047, "r_a1": 80.34263740574995, "r_a2": 117.24263740574995,
    "p_w": 33.11287396027928, "S1": 20.759870119563853, "S2": 18.5032546671134, "y": 0.918263740575,
}  # fmt: skip
# with the table's rounded Dy = 0.160: r_a 80.34 and 117.24
PRACTICUM_ROUNDED = {"eps": 1.1636500824204326, "alpha_a1_deg": 40.512072163424726, "alpha_a2_deg": 32.691856636093334,
                     "S_a1": 4.373644250267514, "S_a2": 7.458282513431816}  # fmt: skip
# printed, and half a unit of its last digit
PRACTICUM_PRINTED = {"u": (1.615, 5e-4), "r_1": (65, 0.5), "r_2": (105, 0.5), "r_b2": (98.67, 5e-3),
                     "r_f1": (59.44, 5e-3), "r_f2": (96.34, 5e-3), "dy": (0.160, 5e-4), "r_a1": (80.34, 5e-3),
                     "r_a2": (117.24, 5e-3)}  # fmt: skip
PRACTICUM_MISPRINTS = {"inv_alpha_w": (0.037985, 5e-7), "alpha_w_deg": (26.92, 5e-3), "a_w": (180.79, 5e-3),
                       "r_w1": (69.14, 5e-3), "r_w2": (111.65, 5e-3), "r_b1": (61.06, 5e-3),
                       "S2": (18.49, 5e-3)}  # fmt: skip


def practicum_pair(**changed: float) -> ExternalPair:
    """The pair of lesson 3."""
    pinion = replace(SpurGear(10.0, 13, RACK, 0.694), **changed)
    return external_pair(pinion, replace(SpurGear(10.0, 21, RACK, 0.384), **changed))


def gap_in_modules(found: PairContact, pair: ExternalPair) -> float:
    """The gap that is farthest from 0 over the drive angles, both sides of the teeth, in modules."""
    return max(abs(g) for side in found.side_gaps for g in side) / pair.module


def numbers_of(pair: ExternalPair) -> dict[str, float]:
    """The pair's numbers under the practicum's names."""
    one, two = pair.gears
    angle = pair.working_pressure_angle
    return {
        "u": pair.gear_ratio, "inv_alpha_w": math.tan(angle) - angle, "alpha_w_deg": math.degrees(angle),
        "a_w": pair.working_centre_distance, "r_w1": pair.working_radii[0], "r_w2": pair.working_radii[1],
        "r_1": one.reference_radius, "r_2": two.reference_radius, "r_b1": one.base_radius, "r_b2": two.base_radius,
        "r_f1": one.root_radius, "r_f2": two.root_radius, "dy": pair.tip_shortening_coefficient,
        "r_a1": one.tip_radius, "r_a2": two.tip_radius, "p_w": pair.working_pitch,
        "S1": one.reference_thickness, "S2": two.reference_thickness, "y": pair.centre_distance_coefficient,
    }  # fmt: skip


def test_the_practicum_pair() -> None:
    found = numbers_of(practicum_pair())
    assert found == pytest.approx(PRACTICUM, rel=1e-12)
    for name, (printed, half) in PRACTICUM_PRINTED.items():
        assert abs(found[name] - printed) <= half + 1e-12, name
    for name, (printed, half) in PRACTICUM_MISPRINTS.items():
        assert abs(found[name] - printed) > half, name


def test_the_practicum_contact_ratio() -> None:
    """(3.18) to (3.21) with the rounded Dy; both ways to the contact ratio agree."""
    one, two = SpurGear(10.0, 13, RACK, 0.694, 160.68), SpurGear(10.0, 21, RACK, 0.384, 234.48)
    pair = external_pair(one, two)
    assert pair.gears == (one, two)
    angles = [math.degrees(a) for a in pair.tip_pressure_angles]
    assert angles == pytest.approx([PRACTICUM_ROUNDED["alpha_a1_deg"], PRACTICUM_ROUNDED["alpha_a2_deg"]], rel=1e-13)
    for ratio in (pair.contact_ratio, pair.contact_ratio_by_arc, pair.effective_contact_ratio):
        assert ratio == pytest.approx(PRACTICUM_ROUNDED["eps"], rel=1e-12)
    # printed 1.14 and, from the drawing, 1.137: misprints of 1.164
    assert abs(pair.contact_ratio - 1.14) > 0.005
    assert limits.tip_thickness(one) == pytest.approx(PRACTICUM_ROUNDED["S_a1"], rel=1e-12)
    assert limits.tip_thickness(two) == pytest.approx(PRACTICUM_ROUNDED["S_a2"], rel=1e-12)


def random_gears(rng: random.Random) -> tuple[SpurGear, SpurGear]:
    """Any two mates: z 8 to 100, x -0.5 to 1, a rack of ISO 53, some with backlash cut either way."""
    module, rack = rng.choice((0.2, 1.0, 2.0, 10.0)), iso_53(rng.choice("ABCD"))
    thin = rng.choice((0.0, 0.0, 0.05)) * module
    one, two = (
        SpurGear(module, rng.randint(8, 100), rack, rng.uniform(-0.5, 1),
                 circumferential_thinning=thin, thinning_by_deeper_cut=rng.random() < 0.5)
        for _ in range(2)
    )  # fmt: skip
    return one, two


@cache
def random_pairs(seed: int, count: int) -> list[ExternalPair]:
    """Pairs that can be built."""
    rng, found = random.Random(seed), []
    while len(found) < count:
        try:
            pair = external_pair(*random_gears(rng))
            assert pair.sides
        except GeometryError:
            continue
        found.append(pair)
    return found


@pytest.mark.parametrize("index", range(20))
def test_formulas_at_forty_digits(index: int) -> None:
    """alpha_w by mpmath's own root finder; the tooth thicknesses fill the working pitch but for the backlash."""
    pair = random_pairs(7, 20)[index]
    one, two = pair.gears
    with mpmath.workdps(40):
        alpha = mpmath.mpf(one.rack.pressure_angle)
        teeth = one.number_of_teeth + two.number_of_teeth
        x = mpmath.mpf(one.profile_shift_coefficient) + mpmath.mpf(two.profile_shift_coefficient)
        wanted = mpmath.tan(alpha) - alpha + 2 * x * mpmath.tan(alpha) / teeth
        angle = mpmath.findroot(lambda a: mpmath.tan(a) - a - wanted, 0.35)
        distance = pair.module * teeth / 2 * mpmath.cos(alpha) / mpmath.cos(angle)
        assert pair.working_pressure_angle == pytest.approx(float(angle), rel=1e-13)
        assert pair.working_centre_distance == pytest.approx(float(distance), rel=1e-14)
        widths = []
        for gear, radius in zip(pair.gears, pair.working_radii, strict=True):
            at = mpmath.acos(gear.base_radius / mpmath.mpf(radius))
            s = gear.reference_thickness / gear.reference_radius + 2 * (mpmath.tan(alpha) - alpha)
            widths.append(radius * (s - 2 * (mpmath.tan(at) - at)))
        backlash = float(2 * mpmath.pi * pair.working_radii[0] / one.number_of_teeth - sum(widths))
    assert pair.circumferential_backlash == pytest.approx(backlash, abs=1e-12 * pair.working_centre_distance)
    assert pair.normal_backlash == pytest.approx(backlash * math.cos(angle), abs=1e-12 * pair.working_centre_distance)


def test_tips_are_shortened_and_never_lengthened() -> None:
    plain = SpurGear(2.0, 20, RACK, 0.5), SpurGear(2.0, 30, RACK, 0.4)
    pair = external_pair(*plain)
    shortened = [g.tip_radius - s.tip_radius for g, s in zip(plain, pair.gears, strict=True)]
    assert shortened == pytest.approx([2 * pair.tip_shortening_coefficient] * 2, rel=1e-12)
    assert pair.tip_clearances == pytest.approx([0.5, 0.5], rel=1e-12)
    given = replace(plain[0], given_tip_diameter=45.0)
    assert external_pair(given, plain[1]).gears == (given, pair.second)
    wide = external_pair(*plain, pair.working_centre_distance + 1.0)
    assert wide.tip_shortening_coefficient < 0
    assert wide.gears == plain


def test_refusals_name_what_works() -> None:
    one, two = SpurGear(1.0, 30, RACK, -0.45), SpurGear(1.0, 12, RACK, -0.9)
    with pytest.raises(ParameterError, match="no_working_angle_with_first") as caught:
        external_pair(one, two)
    assert (caught.value.name, caught.value.value) == ("profile_shift_coefficient", -0.9)
    assert external_pair(one, replace(two, profile_shift_coefficient=works(caught.value)))
    with pytest.raises(ParameterError, match="no_working_angle_with_first"):
        external_pair(one, replace(two, profile_shift_coefficient=works(caught.value) - 2e-6))
    with pytest.raises(ParameterError, match=r"module = 2.0: not_that_of_first") as caught:
        external_pair(SpurGear(1.0, 30, RACK), SpurGear(2.0, 12, RACK))
    assert works(caught.value) == 1
    with pytest.raises(ParameterError, match=r"pressure_angle_deg = 25.0: not_that_of_first") as caught:
        external_pair(SpurGear(1.0, 30, RACK), SpurGear(1.0, 12, iso_53("B", math.radians(25))))
    assert works(caught.value) == 20
    with pytest.raises(ParameterError, match=r"working_centre_distance = 20\.9: teeth_overlap") as caught:
        external_pair(SpurGear(1.0, 30, RACK), SpurGear(1.0, 12, RACK), 20.9)
    assert works(caught.value) == 21.0
    thin = SpurGear(1.0, 30, RACK, circumferential_thinning=0.1)
    with pytest.raises(ParameterError, match="teeth_overlap") as caught:
        external_pair(thin, SpurGear(1.0, 12, RACK), 20.7)
    assert 0 <= external_pair(thin, SpurGear(1.0, 12, RACK), works(caught.value)).normal_backlash < 1e-5


@pytest.mark.parametrize("turn", [0.0, 0.3, -2.0])
def test_the_practicum_pair_touches_all_through_a_pitch(turn: float) -> None:
    pair = practicum_pair()
    found = GearMesh(pair).contact()
    assert found.verdict is Verdict.CONTACT
    assert gap_in_modules(found, pair) <= 1e-8
    assert found.tolerance == 1e-7
    assert len(found.drive_angles) >= 24
    assert found.worst.labels == (Label.FLANK, Label.FLANK)
    # a place of contact lies on the first gear's involute, by its closed form
    first, place = pair.first, found.worst.point
    alpha, there = first.rack.pressure_angle, math.acos(first.base_radius / abs(place))
    thickness = (math.pi / 2 + 2 * first.profile_shift_coefficient * math.tan(alpha)) / first.number_of_teeth
    half = thickness + involute_function(alpha) - involute_function(there)
    off = math.remainder(cmath.phase(place) - found.worst.drive_angle, first.pitch_angle)
    assert abs(place) * min(abs(off - half), abs(off + half)) < 1e-9
    # and on a line of action, through the pitch point, alpha_w from the common tangent; along the flank, whose radius
    # is some 20 mm, a place is known to what the roundings of its gap leave: sqrt(20 * 1e-15) mm
    arm = place - pair.working_radii[0]
    assert abs(arm.real) == pytest.approx(abs(arm) * math.sin(pair.working_pressure_angle), abs=2e-7)
    on = pair.second_rotation(turn)
    assert on + pair.second.pitch_angle / 2 - math.pi == pytest.approx(-turn / pair.gear_ratio)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("pair", [practicum_pair(), practicum_pair(circumferential_thinning=0.3)])
def test_a_spoilt_pair_is_caught(pair: ExternalPair) -> None:
    """Turned from contact by the backlash and a millionth of a module; moved in; pulled apart."""
    small, play = 1e-6 * pair.module, pair.normal_backlash / pair.second.base_radius
    for sense in (1, -1):
        contact_turn = -sense * play / 2
        driven = GearMesh(pair, second_turn=contact_turn).contact()
        assert driven.verdict is Verdict.CONTACT
        assert max(map(abs, driven.gaps)) <= 1e-8 * pair.module
        for beyond, verdict in ((small, Verdict.OVERLAP), (-small, Verdict.OVERLAP if play == 0 else Verdict.CLEAR)):
            turn = contact_turn + sense * (play + beyond / pair.working_radii[1])
            assert GearMesh(pair, second_turn=turn).contact().verdict is verdict
    pushed = GearMesh(pair, distance_shift=-small - pair.normal_backlash).contact()
    assert pushed.verdict is Verdict.CLEAR if play else Verdict.OVERLAP
    if not play:
        assert -small < pushed.worst.gap < -0.4 * small
    apart = GearMesh(pair, distance_shift=1e-4 * pair.module).contact()
    assert apart.verdict is Verdict.CLEAR
    assert not apart.touches
    assert apart.worst.gap >= 1e-4 * pair.module * 0.4


def test_backlash_leaves_half_of_it_on_either_side() -> None:
    pair = practicum_pair(circumferential_thinning=0.3)
    assert pair.normal_backlash == pytest.approx(0.6 * math.cos(math.radians(20)), rel=1e-14)
    found = GearMesh(pair).contact()
    assert found.verdict is Verdict.CLEAR
    for side in found.side_gaps:
        assert side == pytest.approx([pair.normal_backlash / 2] * len(side), abs=1e-9)
    closed = pair.flank_gaps(np.array(found.drive_angles), np.array([pair.second_rotation(a) for a in
                        found.drive_angles]), pair.working_centre_distance)  # fmt: skip
    assert np.min(closed, axis=0) == pytest.approx([pair.normal_backlash / 2] * 2, abs=1e-12)
    wide = external_pair(*practicum_pair().gears, 180.0)
    assert GearMesh(wide).contact().worst.gap == pytest.approx(wide.normal_backlash / 2, abs=1e-9)


def check_sound(pair: ExternalPair) -> None:
    """The formulas' limits and the exact gap say the same."""
    found = GearMesh(pair).contact()
    broken = {f.code for f in pair.findings()}
    half = pair.normal_backlash / 2 / pair.module
    gaps = np.array(found.side_gaps) / pair.module - half
    if any(code.startswith("fillet_interference") for code in broken):
        return
    if "contact_ratio" in broken or any(code.startswith("active_flank_cut_away") for code in broken):
        assert found.verdict is not Verdict.CONTACT or "contact_ratio" not in broken
        # no tip reaches a fillet, nor the edge above an undercut one
        assert found.verdict is not Verdict.OVERLAP
        return
    assert np.abs(gaps).max() <= 1e-8, (pair, found.worst)
    assert found.verdict is (Verdict.CLEAR if half else Verdict.CONTACT)
    if half:
        driven = GearMesh(pair, second_turn=pair.normal_backlash / 2 / pair.second.base_radius).contact()
        assert driven.verdict is Verdict.CONTACT


@pytest.mark.sampled(2)
@pytest.mark.parametrize("index", range(60))
def test_random_pairs(index: int) -> None:
    check_sound(random_pairs(11, 60)[index])


@pytest.mark.heavy
@pytest.mark.parametrize("seed", range(20))
def test_many_random_pairs(seed: int) -> None:
    for pair in random_pairs(1000 + seed, 20):
        check_sound(pair)


@cache
def interfering_pairs(seed: int, count: int) -> list[ExternalPair]:
    """Pairs of many teeth and negative shift whose tips strike a fillet, by the formula, beyond the band."""
    rng, found = random.Random(seed), []
    while len(found) < count:
        rack = iso_53(rng.choice("ABC"))
        pair = external_pair(*(SpurGear(1.0, rng.randint(30, 100), rack, rng.uniform(-0.6, 0.1)) for _ in range(2)))
        if beyond_the_band(pair):
            found.append(pair)
    return found


def beyond_the_band(pair: ExternalPair) -> bool:
    """Whether the interference stays with 1e-3 more profile shift on the gear whose fillet is struck."""
    for index, name in enumerate(("fillet_interference_first", "fillet_interference_second")):
        if any(f.code == name for f in pair.findings()):
            gears = [replace(g, given_tip_diameter=None) for g in pair.gears]
            shift = gears[index].profile_shift_coefficient + 1e-3
            gears[index] = replace(gears[index], profile_shift_coefficient=shift)
            if any(f.code == name for f in external_pair(*gears).findings()):
                return True
    return False


@pytest.mark.sampled(1)
@pytest.mark.parametrize("index", range(12))
def test_fillet_interference_is_overlap_beyond_a_band(index: int) -> None:
    found = GearMesh(interfering_pairs(5, 12)[index]).contact()
    assert found.verdict is Verdict.OVERLAP
    assert {Label.ROOT_FILLET, Label.ROOT_LAND} & set(found.worst.labels)


def test_a_contact_ratio_just_below_one_interrupts_the_drive() -> None:
    """The tips are shortened until the ratio crosses 1: contact above, an interruption below."""
    low, high = 28.0, 30.4

    def at(tip: float) -> ExternalPair:
        return external_pair(SpurGear(2.0, 13, RACK, 0.3, tip), SpurGear(2.0, 17, RACK, 0.3, tip + 8))

    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if at(middle).contact_ratio < 1 else (low, middle)
    for step, verdict in ((0.01, Verdict.CONTACT), (-0.01, Verdict.CLEAR)):
        pair = at(high + step)
        assert (pair.contact_ratio >= 1) == (verdict is Verdict.CONTACT)
        found = GearMesh(pair).contact()
        assert found.verdict is verdict
        assert found.touches
        assert bool(pair.findings()) == (verdict is Verdict.CLEAR)


def points_measured(pair: ExternalPair, monkeypatch: pytest.MonkeyPatch) -> int:
    """How many distances a check takes."""
    total, feet = [0], contact.Boundary.feet

    def counted(self: contact.Boundary, points: contact.Complex) -> contact.Feet:
        total[0] += np.size(points)
        return feet(self, points)

    with monkeypatch.context() as patch:
        patch.setattr(contact.Boundary, "feet", counted)
        assert GearMesh(pair).contact().verdict is Verdict.CONTACT
    return total[0]


def test_the_work_does_not_grow_with_the_teeth(monkeypatch: pytest.MonkeyPatch) -> None:
    few, many, most = (
        points_measured(external_pair(SpurGear(10.0, z, RACK, 0.2), SpurGear(10.0, z + 9, RACK)), monkeypatch)
        for z in (30, 3000, 100_000)
    )
    # the tip circles enclose more teeth at first, then the path of contact sets their number
    assert many < 4 * few
    # coordinates of 1e6 modules leave less than the accuracy asked for: a few more steps
    assert most < 2 * many


@pytest.mark.parametrize("angle_deg", [10.0, 14.5, 30.0])
def test_other_pressure_angles_and_a_wheel_of_ten_thousand_teeth(angle_deg: float) -> None:
    rack = BasicRack(math.radians(angle_deg), 0.8, 0.3, 0.1)
    pair = external_pair(SpurGear(1.0, 60, rack, 0.1), SpurGear(1.0, 10_000, rack, 0.3))
    found = GearMesh(pair).contact()
    assert not pair.findings()
    assert found.verdict is Verdict.CONTACT
    assert gap_in_modules(found, pair) <= 1e-9


def test_a_search_that_misses_the_flanks_is_undecided(monkeypatch: pytest.MonkeyPatch) -> None:
    pair = practicum_pair(circumferential_thinning=0.3)
    monkeypatch.setattr(ExternalPair, "flank_gaps", lambda _p, angles, *_: np.full((len(angles), 2), 0.1))
    assert GearMesh(pair).contact().verdict is Verdict.UNDECIDED


def test_a_number_that_is_not_finite_is_undecided() -> None:
    assert GearMesh(practicum_pair(), second_turn=math.nan).contact().verdict is Verdict.UNDECIDED


@pytest.mark.parametrize("shift", [40.0, -3.0, -60.0])
def test_far_away_and_far_inside(shift: float) -> None:
    found = GearMesh(practicum_pair(), distance_shift=shift).contact()
    assert found.verdict is (Verdict.CLEAR if shift > 0 else Verdict.OVERLAP)
    assert (found.worst.gap > 0) == (shift > 0)

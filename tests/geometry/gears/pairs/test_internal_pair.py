"""Internal pairs: published numbers, brute force of the three conditions, exact contact with negative controls."""

from __future__ import annotations

import json
import math
import random
from pathlib import Path

import mpmath
import numpy as np
import pytest
import shapely

from geometry.base.angles import involute_function
from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.pairs.internal import InternalPair, internal_pair, shift_difference
from geometry.gears.pairs.involute import Sums, signed
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.internal_mesh import InternalMesh
from geometry.gears.teeth.limits import undercut
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_limits import checked_ring
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.distance import Verdict
from geometry.plane.profile import Label
from tests import brute
from tests.strategies import with_default_cutter

ALPHA = math.radians(20.0)
THESIS = json.loads((Path(__file__).parents[3] / "published" / "power_module_internal_pair.json").read_text("utf-8"))


def ring(teeth: int, x: float = 0.0, module: float = 1.0, **keys: object) -> RingGear:
    """A ring that some usual cutter makes."""
    cutter = PinionCutter(module, 25, ALPHA)
    return with_default_cutter(RingGear(module, teeth, ALPHA, (teeth + 20) * module, cutter, x, **keys))  # type: ignore[arg-type]


def pair_of(z1: int, z2: int, x1: float = 0.0, x2: float = 0.0, module: float = 1.0) -> InternalPair:
    return internal_pair(SpurGear(module, z1, iso_53(), x1), ring(z2, x2, module))


def test_internal_pair_of_khk() -> None:
    """m 3, 16/24, x2 = 0.516: inv alpha_w 0.0618565, alpha_w 31.3209 deg, a 13.2000."""
    gear = RingGear(3.0, 24, ALPHA, 100.0, RoundedRoot(), 0.516, plain_tip=True)
    pair = internal_pair(SpurGear(3.0, 16, iso_53()), gear)
    assert involute_function(pair.working_pressure_angle) == pytest.approx(0.0618565, abs=5e-8)
    assert math.degrees(pair.working_pressure_angle) == pytest.approx(31.3209, abs=5e-5)
    assert pair.working_centre_distance == pytest.approx(13.2000, abs=5e-5)
    assert 2 * gear.tip_radius == pytest.approx(69.096, abs=5e-4)
    assert shift_difference(pair.pinion, gear, pair.working_centre_distance) == pytest.approx(0.516, abs=1e-12)


def test_internal_pair_of_the_thesis() -> None:
    given = THESIS["inputs"]
    m, rack = given["module"], BasicRack(ALPHA, given["addendum"], given["clearance"], 0.3)
    cutter = PinionCutter(m, 34, ALPHA, addendum=given["addendum"] + given["clearance"])
    gear = checked_ring(RingGear(m, given["z2"], ALPHA, 480.0, cutter, given_tip_diameter=427.2))
    pair = internal_pair(SpurGear(m, given["z1"], rack), gear)
    found = {
        "a_w": pair.working_centre_distance, "u": pair.gear_ratio, "p": math.pi * m,
        "d_1": 2 * pair.pinion.reference_radius, "d_2": 2 * gear.reference_radius,
        "d_a1": 2 * pair.pinion.tip_radius, "d_a2": 2 * gear.tip_radius,
        "d_f1": 2 * pair.pinion.root_radius, "d_f2": 2 * gear.root_radius,
    }  # fmt: skip
    for name, value in found.items():
        printed = THESIS["printed"][name]
        digits = len(printed.partition(".")[2])
        assert abs(value - float(printed)) <= 0.5 * 10**-digits * (1 + 1e-9), name
    exact = THESIS["contact_ratio_from_tip_circles"]
    assert pair.contact_ratio == pytest.approx(exact, rel=1e-13)
    assert pair.contact_ratio_by_arc == pytest.approx(exact, rel=1e-13)
    assert pair.tip_clearances == (pytest.approx(1.2), pytest.approx(0.6))


# least tooth difference without overlapping tips, least with radial assembly, least pinion without involute
# interference; brute force and closed form of others, x = 0 and no backlash
TABLE = [
    (20.0, 1.0, 40, 9, 17, 24), (20.0, 1.0, 60, 9, 17, 21), (20.0, 1.0, 80, 8, 16, 20), (20.0, 1.0, 100, 8, 16, 19),
    (20.0, 0.8, 40, 7, 13, None), (20.0, 0.8, 60, 7, 13, None), (20.0, 0.8, 100, 7, 13, None),
    (25.0, 1.0, 40, 6, 11, None), (25.0, 1.0, 80, 6, 11, None), (30.0, 0.8, 40, 4, None, None),
    (30.0, 0.8, 100, 4, None, None),
]  # fmt: skip


def mesh_of(z1: int, z2: int, degrees: float, addendum: float) -> InternalMesh:
    angle = math.radians(degrees)
    bases = z1 / 2 * math.cos(angle), z2 / 2 * math.cos(angle)
    return InternalMesh((z1, z2), bases, (z1 / 2 + addendum, z2 / 2 - addendum), (z2 - z1) / 2, angle)


@pytest.mark.parametrize(("degrees", "addendum", "teeth", "tips", "radial", "pinion"), TABLE)
def test_least_differences(
    degrees: float, addendum: float, teeth: int, tips: int, radial: int | None, pinion: int | None
) -> None:
    meshes = {d: mesh_of(teeth - d, teeth, degrees, addendum) for d in range(1, teeth - 5)}
    assert next(d for d, m in meshes.items() if m.trochoid_interference().margin >= 0) == tips
    if radial is not None:
        assert next(d for d, m in meshes.items() if m.radial_assembly().margin >= 0) == radial
    if pinion is not None:
        kept = [teeth - d for d, m in meshes.items() if m.involute_interference().margin >= 0]
        assert min(kept) == pinion


def test_overlap_of_tips_at_a_difference_of_eight() -> None:
    """0.00009 m at ring 76, 3.06e-6 m at 77, free from 78; brute force and 40 digits of others."""
    values = [mesh_of(z - 8, z, 20.0, 1.0).trochoid_interference().margin for z in (76, 77, 78)]
    assert values[0] == pytest.approx(-9.55e-5, abs=5e-8)
    assert values[1] == pytest.approx(-3.06e-6, abs=5e-9)
    assert values[2] > 0


@pytest.mark.parametrize(("z1", "z2"), [(1, 60), (9, 10), (59, 60), (5, 200), (199, 200)])
def test_tip_circles_that_do_not_cross(z1: int, z2: int) -> None:
    """The arccosine's argument beyond +-1: told as free or as never free, not as an error."""
    for addendum in (0.01, 1.0, 3.0):
        mesh = mesh_of(z1, z2, 20.0, addendum)
        for margin in mesh.margins():
            assert not math.isnan(margin.margin)
    # long tips of a pinion as large as its ring: every tooth overlaps, which a bare arccosine takes for free
    inside = InternalMesh((59, 60), (27.7, 28.2), (33.0, 29.0), 0.5, 0.35)
    assert inside.trochoid_interference().margin == -math.inf
    assert inside.radial_assembly().margin == -math.inf


def deep_pair(z1: int, z2: int) -> InternalPair:
    """Full addenda, deep sharp roots: nothing but flanks and tips can touch."""
    rack = BasicRack(ALPHA, 1.0, 0.5, 0.0)
    gear = RingGear(1.0, z2, ALPHA, z2 + 20.0, RoundedRoot(1.5, 0.0), plain_tip=True)
    return internal_pair(SpurGear(1.0, z1, rack), gear)


def polygons(pair: InternalPair, points: int = 40) -> tuple[shapely.Polygon, shapely.Polygon]:
    """Pinion and the hole of the ring, both slightly inside the exact outlines where these bulge."""
    made = []
    for profile in (pair.sides[0].profile(), pair.sides[1].profile()):
        one = np.concatenate([brute.dense(s.curve, points)[:-1] for s in profile.period])
        turns = np.exp(1j * profile.pitch_angle * np.arange(profile.count))
        flat = (turns[:, None] * one).ravel()
        made.append(shapely.Polygon(np.column_stack([flat.real, flat.imag])))
    return made[0], made[1]


def placed(shape: shapely.Polygon, angle: float, shift: float) -> shapely.Polygon:
    turned = shapely.affinity.rotate(shape, angle, origin=(0, 0), use_radians=True)
    return shapely.affinity.translate(turned, shift, 0)


def outside(pair: InternalPair, phases: int, distances: np.ndarray) -> float:
    """Greatest area of the pinion outside the ring's hole over phases and distances, m^2."""
    pinion, hole = polygons(pair)
    worst = 0.0
    for k in range(phases):
        turn = pair.ring.pitch_angle * k / phases
        around = placed(hole, turn, 0.0)
        for distance in distances:
            inside = placed(pinion, pair.pinion_rotation(turn), float(distance))
            worst = max(worst, inside.difference(around).area)
    return worst


@pytest.mark.parametrize(("z1", "z2", "free"), [(32, 40, False), (30, 40, True), (51, 60, True), (53, 60, False)])
def test_trochoid_interference_by_polygons(z1: int, z2: int, free: bool) -> None:
    pair = deep_pair(z1, z2)
    assert (pair.mesh.trochoid_interference().margin >= 0) is free
    area = outside(pair, 6, np.array([pair.working_centre_distance]))
    assert (area < 2e-5) if free else (area > 1e-4)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("z1", "z2", "free"), [(21, 40, True), (28, 40, False), (40, 60, True), (48, 60, False)])
def test_radial_assembly_by_polygons(z1: int, z2: int, free: bool) -> None:
    """The pinion is moved along the line of centres, without turning, from the ring's middle into mesh."""
    pair = deep_pair(z1, z2)
    assert (pair.mesh.radial_assembly().margin >= 0) is free
    a_w = pair.working_centre_distance
    area = outside(pair, 4, a_w - np.linspace(0, 2.4, 13))
    assert (area < 2e-5) if free else (area > 1e-4)


@pytest.mark.heavy
@pytest.mark.parametrize("z2", [34, 40, 50, 60, 80, 100])
def test_conditions_by_polygons_over_all_pinions(z2: int) -> None:
    """Both conditions against polygons, but for a band of 0.02 m about their limits."""
    for z1 in range(z2 - 20, z2 - 5):
        pair = deep_pair(z1, z2)
        if pair.mesh.involute_interference().margin < 0:
            continue
        a_w = pair.working_centre_distance
        for margin, path in (
            (pair.mesh.trochoid_interference().margin, np.array([a_w])),
            (pair.mesh.radial_assembly().margin, a_w - np.linspace(0, 2.4, 25)),
        ):
            if abs(margin) > 0.02:
                area = outside(pair, 8, path)
                assert (area > 5e-5) == (margin < 0), (z1, z2, margin, area)


CONTACT_CASES = [(30, 60, 0.0, 0.0, 2.0), (25, 80, 0.2, 0.3, 1.0), (96, 144, 0.0, 0.0, 3.0), (20, 100, 0.3, 0.1, 10.0),
                 (40, 62, 0.1, 0.4, 0.5)]  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("z1", "z2", "x1", "x2", "module"), CONTACT_CASES)
def test_contact_without_backlash(z1: int, z2: int, x1: float, x2: float, module: float) -> None:
    pair = pair_of(z1, z2, x1, x2, module)
    assert pair.findings() == ()
    found = GearMesh(pair).contact()
    assert found.verdict is Verdict.CONTACT
    assert np.abs(np.array(found.side_gaps)).max() <= 1e-8 * module
    turned = GearMesh(pair, second_turn=1e-6 * module / pair.ring.base_radius).contact()
    assert turned.verdict is Verdict.OVERLAP
    assert turned.worst.gap == pytest.approx(-1e-6 * module, rel=1e-3)
    # a longer distance digs in, a shorter one opens: the other way round than outside
    step = 0.01 * module
    assert GearMesh(pair, distance_shift=step).contact().verdict is Verdict.OVERLAP
    assert GearMesh(pair, distance_shift=-step).contact().verdict is Verdict.CLEAR


@pytest.mark.sampled(1)
@pytest.mark.parametrize("deeper", [False, True])
def test_contact_with_backlash(deeper: bool) -> None:
    """The asked backlash is there, on each side half, and used up by turning either way; turned on, an overlap."""
    pinion = SpurGear(2.0, 30, iso_53(), 0.1, circumferential_thinning=0.06)
    gear = ring(70, 0.2, 2.0, circumferential_thinning=0.04, thinning_by_deeper_cut=deeper)
    pair = internal_pair(pinion, gear)
    backlash = pair.normal_backlash
    assert backlash == pytest.approx(0.1 * math.cos(ALPHA), rel=1e-13)
    assert pair.circumferential_backlash == pytest.approx(backlash / math.cos(pair.working_pressure_angle), rel=1e-15)
    middle = GearMesh(pair).contact()
    assert middle.verdict is Verdict.CLEAR
    assert np.abs(np.array(middle.side_gaps) - backlash / 2).max() <= 2e-8
    for side in (1, -1):
        turn = side * backlash / (2 * gear.base_radius)
        assert GearMesh(pair, second_turn=turn).contact().verdict is Verdict.CONTACT
        more = side * (backlash / 2 + 2e-6) / gear.base_radius
        assert GearMesh(pair, second_turn=more).contact().verdict is Verdict.OVERLAP


def test_backlash_from_a_distance_has_the_sign_of_rings() -> None:
    pair = pair_of(30, 60)
    nearer = internal_pair(pair.pinion, pair.ring, pair.working_centre_distance - 0.05)
    assert nearer.normal_backlash > 0
    found = GearMesh(nearer).contact()
    assert np.abs(np.array(found.side_gaps) - nearer.normal_backlash / 2).max() <= 1e-8
    with pytest.raises(ParameterError, match="teeth_overlap") as refusal:
        internal_pair(pair.pinion, pair.ring, pair.working_centre_distance + 0.05)
    internal_pair(pair.pinion, pair.ring, brute.works(refusal.value))


def test_gap_against_polygons() -> None:
    """Distance of dense polygons of both gears at some drive angles, with backlash."""
    thin = SpurGear(2.0, 24, iso_53(), 0.1, circumferential_thinning=0.2)
    pair = internal_pair(thin, ring(60, 0.2, 2.0, circumferential_thinning=0.2))
    turn = 0.3 * pair.normal_backlash / (2 * pair.ring.base_radius)
    found = GearMesh(pair, second_turn=turn).contact()
    pinion, hole = polygons(pair, 30)
    for k in range(0, len(found.drive_angles), 25):
        drive = found.drive_angles[k]
        around = placed(hole, pair.second_rotation(drive) + turn, -pair.working_centre_distance)
        gap = placed(pinion, drive, 0.0).distance(around.exterior)
        assert gap == pytest.approx(found.gaps[k], abs=5e-4)


def test_interference_is_found_as_overlap() -> None:
    """Negative controls: plain ring tips in a pinion's fillets; too near a pinion; its tips in the ring's fillets."""
    plain = internal_pair(SpurGear(1.0, 25, iso_53()), ring(80, plain_tip=True))
    assert {f.code for f in plain.findings()} == {"fillet_interference_pinion"}
    assert GearMesh(plain).contact().verdict is Verdict.OVERLAP
    near = deep_pair(33, 40)
    assert "trochoid_interference" in {f.code for f in near.findings()}
    assert GearMesh(near).contact().verdict is Verdict.OVERLAP
    shallow = RingGear(1.0, 80, ALPHA, 100.0, PinionCutter(1.0, 20, ALPHA, tip_rounding=0.3), 0.0)
    high = internal_pair(SpurGear(1.0, 60, BasicRack(ALPHA, 1.2, 0.25, 0.2)), shallow)
    assert "fillet_interference_ring" in {f.code for f in high.findings()}
    assert GearMesh(high).contact().verdict is Verdict.OVERLAP


def test_a_tip_that_strikes_a_fillet_beside_the_flanks_is_found() -> None:
    """The flanks' own conditions are kept, with 0.014 m of clearance: the corner's limit and the outlines tell."""
    pinion, gear = SpurGear(1.0, 35, iso_53(), 0.79), ring(106, 0.765)
    pair = internal_pair(pinion, gear)
    assert [f.code for f in pair.findings()] == ["fillet_interference_ring"]
    found = GearMesh(pair).contact()
    assert found.verdict is Verdict.OVERLAP
    assert Label.ROOT_FILLET in found.worst.labels
    tip = 2 * (gear.root_radius - pair.working_centre_distance - 0.2)
    assert tip < 2 * pinion.tip_radius
    free = internal_pair(replace(pinion, given_tip_diameter=tip), gear)
    assert free.tip_clearances[1] == pytest.approx(0.2, rel=1e-12)
    assert GearMesh(free).contact().verdict is Verdict.CONTACT


def test_rotations_are_inverse_and_roll() -> None:
    pair = pair_of(30, 60)
    for direction in (0.0, 0.7):
        for turn in (0.0, 0.3, -2.0):
            back = pair.second_rotation(pair.pinion_rotation(turn, direction), direction)
            assert back == pytest.approx(turn, abs=1e-14)
    step = pair.pinion_rotation(0.2) - pair.pinion_rotation(0.1)
    assert step == pytest.approx(0.1 * pair.gear_ratio, rel=1e-12)


def test_refused_pairs() -> None:
    pinion = SpurGear(1.0, 30, iso_53())
    for gear, name in (
        (ring(60, module=2.0), "module"),
        (replace(ring(60), pressure_angle=0.3), "pressure_angle_deg"),
        (RingGear(1.0, 30, ALPHA, 60.0, RoundedRoot()), "number_of_teeth"),
        (ring(60, -0.7), "profile_shift_coefficient"),
    ):
        refused = brute.refusal(lambda g=gear: internal_pair(pinion, g))  # type: ignore[misc]
        assert isinstance(refused, ParameterError)
        assert refused.name == name
        assert refused.nearest is not None


def random_pair(numbers: random.Random) -> InternalPair | None:
    """A pair of ordinary proportions; None where it breaks a limit or cannot be made."""
    z1 = numbers.randint(17, 120)
    z2 = z1 + numbers.randint(12, 120)
    x1, x2 = numbers.uniform(-0.3, 0.8), numbers.uniform(-0.3, 1.2)
    pinion = SpurGear(1.0, z1, iso_53(numbers.choice("ABC")), x1)
    gear = ring(max(z2, 36), x2)
    refused = brute.refusal(lambda: (checked_ring(gear), internal_pair(pinion, gear).sides))
    if refused is not None:
        return None
    pair = internal_pair(pinion, gear)
    ends = [m for m in pair.margins() if m.name != "radial_assembly"]
    if min(m.margin for m in ends) < -1e-12 or undercut(pinion).margin < 0:
        return None
    # with less bottom clearance than a basic rack's own a sharp tip may strike a fillet beside the flanks
    return pair if min(pair.tip_clearances) >= 0.2 else None


def check_random_pairs(count: int, seed: int) -> None:
    numbers, done = random.Random(seed), 0
    while done < count:
        pair = random_pair(numbers)
        if pair is None:
            continue
        done += 1
        found = GearMesh(pair).contact()
        assert found.verdict is Verdict.CONTACT, pair
        assert np.abs(np.array(found.side_gaps)).max() <= 1e-8, pair
        side = numbers.choice((1, -1))
        assert GearMesh(pair, second_turn=side * 1e-6 / pair.ring.base_radius).contact().verdict is Verdict.OVERLAP, (
            pair
        )


def test_random_legal_pairs() -> None:
    check_random_pairs(5, 5)


@pytest.mark.heavy
@pytest.mark.parametrize("seed", range(20))
def test_two_thousand_random_legal_pairs(seed: int) -> None:
    check_random_pairs(100, 1000 + seed)


@pytest.mark.parametrize(
    ("z1", "more", "x1", "x2", "farther"),
    [(17, 33, 0.0, 0.0, 0.0), (20, 40, 0.3, 0.5, 0.2), (8, 15, 0.6, -0.2, 0.05), (96, 48, -0.25, 0.4, 0.3)],
)
def test_signed_numbers_give_what_is_written_out_for_a_ring(
    z1: int, more: int, x1: float, x2: float, farther: float
) -> None:
    """ISO 21771's signs, both ways, and the sums against GOST 19274's differences in 30 digits."""
    pinion = SpurGear(2.0, z1, iso_53(), x1)
    ring = RingGear(2.0, z1 + more, pinion.rack.pressure_angle, 1e3, RoundedRoot(), x2, circumferential_thinning=0.1)
    plain, there = signed(pinion), signed(ring)
    assert plain == (z1, x1, pinion.reference_radius, pinion.base_radius)
    assert [-v for v in there] == [z1 + more, x2, ring.reference_radius, ring.base_radius]
    sums = Sums.of(pinion, ring)
    with mpmath.workdps(30):
        alpha = mpmath.mpf(ring.pressure_angle)
        inv = mpmath.tan(alpha) - alpha + 2 * (mpmath.mpf(x2) - mpmath.mpf(x1)) * mpmath.tan(alpha) / more
        assert abs(sums.involute - inv) < 1e-14
        base = more * mpmath.cos(alpha)
        distance = float(base / mpmath.cos(alpha)) + farther
        angle = mpmath.acos(base / mpmath.mpf(distance))
        play = mpmath.mpf("0.1") * mpmath.cos(alpha) - 2 * base * (mpmath.tan(angle) - angle - inv)
        assert abs(sums.normal_backlash(sums.angle(distance)) - play) < 1e-11
        wanted = (mpmath.tan(angle) - angle - mpmath.tan(alpha) + alpha) * more / (2 * mpmath.tan(alpha))
        assert abs(shift_difference(pinion, ring, distance) - wanted) < 1e-10

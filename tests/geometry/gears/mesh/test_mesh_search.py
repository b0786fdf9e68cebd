"""The gap search against dense polylines: helical sections, many teeth in reach, side by side; work and verdicts.

The sections of helical pairs have high pressure angles and short teeth: a flank leaves the mate's flank within one step
of the samples, and the nearest point jumps to the next flank.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable

import numpy as np
import pytest
import shapely

from geometry.base.errors import GeometryError
from geometry.base.record import replace
from geometry.curves.curve import Complex
from geometry.gears.mesh import search as mesh_search
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.mesh.rack import RackMesh
from geometry.gears.mesh.search import PairContact
from geometry.gears.pairs.external import ExternalPair, external_pair
from geometry.gears.pairs.internal import InternalPair, internal_pair
from geometry.gears.pairs.rack import rack_pair
from geometry.gears.teeth.basic_rack import BasicRack, TipRelief, iso_53
from geometry.gears.teeth.rack import Rack
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear, transverse_rack
from geometry.gears.teeth.transverse_ring import transverse_ring
from geometry.plane import distance as contact
from geometry.plane.distance import Verdict
from tests import brute
from tests.oracles.contact_ratio import main_flank_contact_ratio
from tests.sampling import some_of

ALPHA = math.radians(20.0)
PIECES = "geometry.gears.mesh.least_gap._Pieces"


def helical(z1: int, z2: int, degrees: float, x1: float, x2: float, rack: BasicRack | None = None) -> ExternalPair:
    """The transverse section of a helical pair, normal module 1."""
    one, two = (transverse_gear(SpurGear(1.0, z, rack or iso_53(), x), math.radians(degrees))
                for z, x in ((z1, x1), (z2, x2)))  # fmt: skip
    return external_pair(one, two)


# (z1, z2, degrees, x1, x2) where a minimum lies beside a jump of the nearest point
BESIDE_A_JUMP = [(8, 20, 30.0, 0.3, 0.0), (8, 12, 60.0, 0.0, 0.0), (8, 40, 60.0, 0.3, 0.0), (17, 80, 45.0, 0.5, 0.0),
                 (25, 80, 60.0, 0.5, 0.0), (25, 80, 45.0, 0.0, 0.0), (12, 40, 45.0, 0.5, 0.5)]  # fmt: skip


def brute_side_gaps(pair: ExternalPair, whole: list[Complex], drive: float, second: float) -> list[float]:
    """Distance of one half of each tooth of the second from the first, dense polylines; and of the first's tips.

    ``whole``: vertices of both outlines.
    """
    sides = pair.sides
    first, other = (shapely.Polygon(np.column_stack([p.real, p.imag]))
                    for p in (whole[0] * np.exp(1j * drive),
                              pair.working_centre_distance + whole[1] * np.exp(1j * second)))  # fmt: skip
    half = np.concatenate([brute.dense(s.curve, 300) for s in sides[1].segments])
    corner = complex(sides[0].segments[-1].curve.point(sides[0].segments[-1].curve.domain[0]))
    found = []
    for mirrored in (False, True):
        lines = np.conj(half) if mirrored else half
        turns = np.exp(1j * (second + 2 * math.pi / sides[1].profile().count * np.arange(sides[1].profile().count)))
        placed = pair.working_centre_distance + turns[:, None] * lines
        near = placed[np.abs(placed).min(axis=1) < pair.first.tip_radius + 2 * pair.module]
        distance = min(first.distance(shapely.LineString(np.column_stack([p.real, p.imag]))) for p in near)
        tips = (np.conj(corner) if mirrored else corner) * np.exp(
            1j * (drive + 2 * math.pi / sides[0].profile().count * np.arange(sides[0].profile().count))
        )
        struck = shapely.distance(other, shapely.points(np.column_stack([tips.real, tips.imag])))
        found.append(min(distance, float(struck.min())))
    return found


@pytest.mark.sampled(1)
@pytest.mark.parametrize("values", BESIDE_A_JUMP)
def test_both_sides_against_dense_polylines(values: tuple[int, int, float, float, float]) -> None:
    pair = helical(*values)
    found = GearMesh(pair).contact()
    assert found.verdict is (Verdict.CONTACT if pair.effective_contact_ratio >= 1 else Verdict.CLEAR)
    whole = [brute.polygon(s.profile(), 250) for s in pair.sides]
    for k in some_of(range(0, len(found.drive_angles), 5), 5):
        drive = found.drive_angles[k]
        wanted = brute_side_gaps(pair, whole, drive, pair.second_rotation(drive))
        assert [side[k] for side in found.side_gaps] == pytest.approx(wanted, abs=1e-4 * pair.module)


def a_section(rng: random.Random) -> ExternalPair | None:
    """A helical pair with long, short or standard teeth and tips, some relieved, broken or thinned."""
    height = rng.choice((0.6, 0.8, 1.0, 1.0, 1.1))
    relief = TipRelief(0.02, 0.3) if rng.random() < 0.2 else None
    rack = BasicRack(math.radians(rng.choice((14.5, 20.0, 20.0, 25.0))), height, 0.25, 0.2, relief)
    helix = math.radians(rng.choice((10.0, 30.0, 45.0, 60.0)))
    keys = rng.choice(({}, {}, {"tip_chamfer": 0.05}, {"tip_rounding": 0.08}, {"circumferential_thinning": 0.05}))
    one, two = (transverse_gear(SpurGear(1.0, rng.randint(6, 120), rack, rng.uniform(-0.4, 0.9), **keys), helix)  # type: ignore[arg-type]
                for _ in range(2))  # fmt: skip
    try:
        pair = external_pair(one, two)
        assert pair.sides
    except GeometryError:
        return None
    return pair


def check_section(pair: ExternalPair) -> None:
    found = GearMesh(pair, second_turn=pair.normal_backlash / 2 / pair.second.base_radius).contact()
    assert found.verdict is not Verdict.UNDECIDED, pair
    struck = any(m.margin < 1e-3 for m in pair.margins() if m.name.startswith(("fillet", "active", "tip")))
    # flanks that only meet on their relief part from the ideal
    ratio = min(main_flank_contact_ratio(pair), pair.effective_contact_ratio)
    if not struck and abs(ratio - 1) > 1e-6:
        assert found.verdict is (Verdict.CONTACT if ratio > 1 else Verdict.CLEAR), pair
        assert found.touches == (ratio > 0)


# interrupted by less than a step of the drive, and no corner passes there
ROUND = [(105, 47, 45.0), (33, 74, 42.0), (60, 45, 45.0)]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("z1", "z2", "degrees"), ROUND)
def test_a_short_interruption_between_round_tips_is_seen(z1: int, z2: int, degrees: float) -> None:
    def at(rounding: float) -> ExternalPair:
        gears = (SpurGear(1.0, z, iso_53(), 0.1, tip_rounding=rounding) for z in (z1, z2))
        return external_pair(*(transverse_gear(g, math.radians(degrees)) for g in gears))

    low, high = 0.0, 0.3
    for _ in range(20):
        middle = (low + high) / 2
        low, high = (low, middle) if at(middle).contact_ratio < 1.0 else (middle, high)
    for rounding, verdict in ((low - 2e-3, Verdict.CONTACT), (high + 2e-3, Verdict.CLEAR)):
        pair = at(rounding)
        assert 0 < (pair.contact_ratio - 1) * (1 if verdict is Verdict.CONTACT else -1) < 0.02
        assert GearMesh(pair).contact().verdict is verdict


def test_no_section_is_undecided() -> None:
    rng = random.Random(41)
    pairs = [p for p in (a_section(rng) for _ in range(18)) if p is not None]
    assert len(pairs) > 8
    for pair in some_of(pairs, 5):
        check_section(pair)


@pytest.mark.heavy
@pytest.mark.parametrize("seed", range(12))
def test_no_section_of_many_is_undecided(seed: int) -> None:
    rng = random.Random(500 + seed)
    for pair in (a_section(rng) for _ in range(120)):
        if pair is not None:
            check_section(pair)


def ring_of(teeth: int, x: float = 0.0, helix: float = 0.0) -> RingGear:
    """A ring with rounded roots, normal module 1."""
    return transverse_ring(RingGear(1.0, teeth, ALPHA, 3.0 * teeth, RoundedRoot(), x), helix)


def inside(z1: int, z2: int, x1: float = 0.0, x2: float = 0.0, degrees: float = 0.0) -> InternalPair:
    """A pair with a ring; a helical one's section."""
    helix = math.radians(degrees)
    return internal_pair(transverse_gear(SpurGear(1.0, z1, iso_53(), x1), helix), ring_of(z2, x2, helix))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("values", [(20, 60, 0.0, 0.0, 30.0), (17, 80, 0.3, 0.3, 45.0), (25, 90, 0.0, 0.0, 60.0)])
def test_helical_rings_and_racks_are_decided(values: tuple[int, int, float, float, float]) -> None:
    found = GearMesh(inside(*values)).contact()
    assert found.verdict in (Verdict.CONTACT, Verdict.CLEAR, Verdict.OVERLAP)
    helix = math.radians(values[4])
    gear = transverse_gear(SpurGear(1.0, values[0], iso_53(), values[2]), helix)
    pair = rack_pair(gear, Rack(1.0 / math.cos(helix), 12, transverse_rack(iso_53(), helix), 2.0))
    wanted = Verdict.CONTACT if pair.effective_contact_ratio >= 1 else Verdict.CLEAR
    assert RackMesh(pair).contact().verdict is wanted


def differ(one: PairContact, two: PairContact) -> float:
    """The greatest difference of two gap curves at one set of drive angles, mm."""
    assert one.drive_angles == two.drive_angles
    return float(np.abs(np.array(one.side_gaps) - np.array(two.side_gaps)).max())


MANY = {"20 in 28": inside(20, 28), "60 in 69": inside(60, 69), "100 in 108": inside(100, 108),
        "tips strike": inside(60, 66),
        "shifted": inside(60, 68, 0.2, 0.9)}  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", MANY)
@pytest.mark.parametrize("turn", [0.0, 2e-4])
def test_excluded_teeth_hold_nothing(name: str, turn: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """Every tooth measured gives the same gaps."""
    found = GearMesh(MANY[name], second_turn=turn).contact()
    monkeypatch.setattr(mesh_search, "_MOST_NEAR", 1000)
    assert differ(GearMesh(MANY[name], second_turn=turn).contact(), found) < 1e-11


def test_a_bound_that_promises_too_much_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: teeth that are said to stand still hide those that strike."""
    found = GearMesh(MANY["tips strike"]).contact()
    assert found.worst.gap < -0.04
    monkeypatch.setattr("geometry.gears.mesh.far_teeth._ROOM", 0.0)
    assert GearMesh(MANY["tips strike"]).contact().worst.gap > -1e-3


def measured(check: Callable[[], PairContact], monkeypatch: pytest.MonkeyPatch) -> int:
    """How many distances a check takes."""
    total, feet = [0], contact.Boundary.feet

    def counted(self: contact.Boundary, points: contact.Complex) -> contact.Feet:
        total[0] += np.size(points)
        return feet(self, points)

    with monkeypatch.context() as patch:
        patch.setattr(contact.Boundary, "feet", counted)
        check()
    return total[0]


def test_the_work_in_a_ring_does_not_grow_with_the_teeth_in_reach(monkeypatch: pytest.MonkeyPatch) -> None:
    pair = external_pair(SpurGear(1.0, 20, iso_53()), SpurGear(1.0, 40, iso_53()))
    usual = measured(lambda: GearMesh(pair).contact(), monkeypatch)
    # about a seventh of the pinion's teeth are within the ring's tip circle
    for teeth in (40, 100, 400, 1000):
        assert measured(lambda z=teeth: GearMesh(inside(z, z + 9)).contact(), monkeypatch) < 5 * usual  # type: ignore[misc]


def test_a_search_without_jumps_misses_the_flanks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Negative control: the closed form sees what a search misses that takes one minimum for each pair of samples."""
    pair = helical(*BESIDE_A_JUMP[0])
    monkeypatch.setattr(f"{PIECES}.has_peak", property(lambda p: np.zeros(len(p.row), bool)))
    monkeypatch.setattr(f"{PIECES}.hides_minimum", property(lambda p: np.zeros(len(p.row), bool)))
    assert GearMesh(pair).contact().verdict is Verdict.UNDECIDED


def test_a_thinned_section_leaves_half_of_its_backlash_on_either_side() -> None:
    pair = helical(12, 40, 45.0, 0.2, 0.0)
    thin = external_pair(*(replace(g, circumferential_thinning=0.1) for g in pair.gears))
    found = GearMesh(thin).contact()
    assert found.verdict is Verdict.CLEAR
    for side in found.side_gaps:
        assert min(side) == pytest.approx(thin.normal_backlash / 2, abs=1e-11)

"""Sectors in mesh: where their teeth touch, and how they move a mate that stands, against polygons that are turned."""

from __future__ import annotations

import math
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest
import shapely
from shapely.affinity import rotate, translate
from shapely.geometry import Polygon
from shapely.geometry.base import BaseGeometry

from geometry.gears.pairs.external import ExternalPair, external_pair
from geometry.gears.pairs.internal import internal_pair
from geometry.gears.pairs.rack import rack_pair
from geometry.gears.pairs.sector_mesh import SectorMesh, Steps, sector_meshes
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.rack import Rack
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_offset import ring_region
from geometry.gears.teeth.sector import Sector, centred
from geometry.gears.teeth.spur import SpurGear
from tests.geometry.gears.teeth.test_sector import polygon
from tests.sampling import some_of

# mm: chords of polygons lie nearer to their curves; rad beyond the ends of contact, where a gap is many times that
_TOUCH, _PAST = 4e-4, 0.04


def put(shape: BaseGeometry, turn: float, x: float = 0.0) -> BaseGeometry:
    """Turned about its axis, which is moved to x."""
    return translate(rotate(shape, math.degrees(turn), origin=(0, 0)), x, 0)


class Case(NamedTuple):
    """A sector of z1 teeth that keeps n in so many runs, and its mate."""

    z1: int
    n: int
    z2: int
    runs: int = 1
    first: int | None = None
    x1: float = 0.0
    x2: float = 0.0


_CASES = (
    Case(24, 6, 17), Case(30, 7, 30), Case(20, 4, 60), Case(36, 8, 12, x2=0.3), Case(24, 3, 30, runs=2),
    Case(24, 1, 18, first=3), Case(18, 2, 40, x1=0.3, x2=-0.2),
)  # fmt: skip


@cache
def made(case: Case) -> tuple[ExternalPair, Polygon, Polygon]:
    """The pair with a little backlash, and the polygons of both."""
    first = centred(case.n) if case.first is None else case.first
    sector = Sector(case.n, first, case.runs)
    one = SpurGear(2.0, case.z1, iso_53("A"), case.x1, sector=sector, circumferential_thinning=0.05)
    two = SpurGear(2.0, case.z2, iso_53("A"), case.x2, circumferential_thinning=0.05)
    pair = external_pair(one, two)
    return pair, *(polygon(gear_region(g).region.outer) for g in pair.gears)


def gap(case: Case, rho: float, contact: int) -> float:
    """Between both as the mate's flanks touch those of a gear with all teeth on one side."""
    pair, one, two = made(case)
    return float(
        put(one, rho).distance(put(two, pair.second_rotation(rho, contact=contact), pair.working_centre_distance))
    )


@pytest.mark.sampled(1)
@pytest.mark.parametrize("case", _CASES)
def test_teeth_touch_from_the_first_to_the_last_of_the_line_of_contact(case: Case) -> None:
    mesh = sector_meshes(made(case)[0])[0]
    for way in (1, -1):
        low, high = mesh.ends(way)
        assert max(gap(case, rho, way) for rho in (low + 1e-4, (low + high) / 2, high - 1e-4)) < _TOUCH
        assert min(gap(case, rho, way) for rho in (low - _PAST, high + _PAST)) > 5 * _TOUCH
    assert mesh.mesh_angle == pytest.approx(
        (case.n - 1 + made(case)[0].effective_contact_ratio) * 2 * math.pi / case.z1, rel=1e-12
    )


def test_a_driven_sector_touches_over_as_much() -> None:
    """The second of a pair: its flanks that look clockwise, in its own frame counter-clockwise, are driven."""
    one = SpurGear(2.0, 17, iso_53("A"), circumferential_thinning=0.05)
    two = SpurGear(2.0, 24, iso_53("A"), sector=Sector(6, -2), circumferential_thinning=0.05)
    pair = external_pair(one, two)
    mesh = sector_meshes(pair)[1]
    shapes = [polygon(gear_region(g).region.outer) for g in pair.gears]

    def off(rho: float, way: int) -> float:
        # turned back, the first drives the second to rho off the way back along the line of centres
        first = -(rho + math.pi - pair.second_rotation(0.0)) * 24 / 17
        second = pair.second_rotation(first, contact=way)
        assert second == pytest.approx(rho + math.pi, abs=0.1)
        return float(put(shapes[0], first).distance(put(shapes[1], second, pair.working_centre_distance)))

    low, high = mesh.ends(1)
    # where the driver turns clockwise, the second counter-clockwise: the other flanks of both
    found = {way: [off(rho, way) for rho in (low + 0.003, (low + high) / 2, high - 0.003)] for way in (1, -1)}
    assert min(max(gaps) for gaps in found.values()) < _TOUCH
    way = min(found, key=lambda w: max(found[w]))
    assert min(off(low - _PAST, way), off(high + _PAST, way)) > 5 * _TOUCH


@pytest.mark.sampled(1)
@pytest.mark.parametrize("of_ring", [True, False])
def test_sectors_inside_a_ring(of_ring: bool) -> None:
    kept = Sector(8, centred(8, -1 if of_ring else 1))
    ring = RingGear(2.0, 60, math.radians(20), 150.0, RoundedRoot(1.25, 0.3), given_tip_diameter=117.0,
                    circumferential_thinning=0.05, sector=kept if of_ring else None)  # fmt: skip
    pinion = SpurGear(2.0, 20, iso_53("A"), circumferential_thinning=0.05, sector=None if of_ring else kept)
    pair = internal_pair(pinion, ring)
    (mesh,) = sector_meshes(pair).values()
    inner = polygon(gear_region(pair.pinion).region.outer)
    region = ring_region(pair.ring).region
    outer = polygon(region.outer) - polygon(region.holes[0])

    def off(rho: float, way: int) -> float:
        # the mesh lies on +x; the pair's line of centres runs from the pinion to the ring, to -x
        turn = rho * 60 / 20 if of_ring else rho
        second = pair.second_rotation(turn, math.pi, contact=0)
        base = pair.second_rotation(0.0, math.pi)
        play = pair.normal_backlash / (2 * pair.ring.base_radius)
        placed = (second - base) + way * play
        return float(put(inner, turn).distance(put(outer, placed, -pair.working_centre_distance)))

    low, high = mesh.ends(1)
    best = {way: [off(rho, way) for rho in (low + 2e-3, (low + high) / 2, high - 2e-3)] for way in (1, -1)}
    way = min(best, key=lambda w: max(best[w]))
    assert max(best[way]) < _TOUCH
    assert max(best[-way]) > 10 * _TOUCH
    assert min(off(low - _PAST, way), off(high + _PAST, way)) > 5 * _TOUCH


def test_a_sector_on_a_rack_moves_it_by_its_arc() -> None:
    """(n - 1 + eps) pitches of the rack."""
    gear = SpurGear(2.0, 40, iso_53("A"), sector=Sector(9, -4))
    pair = rack_pair(gear, Rack(2.0, 16, iso_53("A"), 5.0))
    mesh = sector_meshes(pair)[0]
    assert mesh.mesh_angle * mesh.rate == pytest.approx((8 + pair.effective_contact_ratio) * 2 * math.pi, rel=1e-12)


# mates whose flanks are cut away, or that a tip turns as far as it will before it slips off
_ODD = (Case(60, 9, 12, runs=3, x1=0.323, x2=-0.068), Case(32, 3, 9, runs=2, x1=0.377, x2=-0.071))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("case", [*_CASES, *_ODD])
@pytest.mark.parametrize("way", [1, -1])
def test_a_mate_that_is_moved_step_by_step_is_always_clear_and_always_pushed(case: Case, way: int) -> None:
    """Through a turn in small steps: no overlap of polygons, and while the mate moves some tooth touches it."""
    pair, one, two = made(case)
    mesh = sector_meshes(pair)[0]
    steps = Steps(mesh, pair, way)
    assert mesh.entry_margin > 0
    lead = mesh.last if way > 0 else -mesh.first
    moving = steps.left - steps.first_touch + mesh.last - mesh.first
    turns = [way * (steps.first_touch - lead + at) for at in np.linspace(-0.3, 2 * math.pi - 0.3, 400)]
    for rho in some_of(turns, 40):
        second = pair.second_rotation(steps.advanced(rho), contact=way)
        placed = put(one, rho), put(two, second, pair.working_centre_distance)
        assert placed[0].intersection(placed[1]).area < 1e-4
        passed = (way * rho + lead - steps.first_touch) % mesh.turn
        if passed < moving and case in _CASES:
            assert placed[0].distance(placed[1]) < 2 * _TOUCH
    stands = [way * steps.advanced(rho) for rho in turns]
    # never back, whichever way the sector turns
    assert min(np.diff(stands)) >= -1e-12
    # a turn moves the mate by whole teeth
    moved = (steps.advanced(2 * math.pi) - steps.advanced(0.0)) * case.z1 / (2 * math.pi)
    assert moved == pytest.approx(case.runs * steps.moved, abs=1e-9)
    assert steps.moved == case.n - 1 + steps.ahead


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("case", "jams"), [(Case(24, 5, 20), True), (Case(40, 9, 15), True), (Case(30, 7, 30), False)])
def test_a_first_tooth_that_jams_meets_a_tip_from_outside(case: Case, jams: bool) -> None:
    """A negative margin: as the tips of the first tooth arrive, they stand on a tip land of the standing mate."""
    pair, one, two = made(case)
    mesh = sector_meshes(pair)[0]
    assert (mesh.entry_margin < 0) is jams
    steps = Steps(mesh, pair, 1)
    standing = put(two, pair.second_rotation(steps.stands - mesh.last, contact=1), pair.working_centre_distance)
    # the first place at which the sector, turned on, runs into the mate
    places = np.arange(-mesh.last - 1.0, 1.0, 2e-4)
    shapely.prepare(standing)
    meeting = (rho for rho in places if standing.intersects(put(one, rho)))
    touch = next(rho for rho in meeting if put(one, rho).intersection(standing).area > 1e-9)
    common = put(one, touch + 2e-4).intersection(standing)
    assert isinstance(common, Polygon)
    corner = max(math.hypot(x, y) for x, y in common.exterior.coords)
    # a tooth that jams does so with its tip corner
    assert (pair.first.tip_radius - corner < 1e-6) is jams


_JAMS = (
    Case(24, 5, 20), Case(40, 9, 15), Case(12, 4, 11, x2=-0.1), Case(16, 2, 9, x1=0.4, x2=-0.1),
    Case(13, 4, 10, x1=0.4, x2=-0.1), Case(12, 4, 11, x1=0.3, x2=0.2), Case(12, 4, 10, x2=0.3),
)  # fmt: skip


@pytest.mark.sampled(2)
@pytest.mark.parametrize("case", [*_JAMS, Case(30, 7, 30), Case(24, 6, 17)])
def test_a_standing_mate_gives_way_to_the_first_tooth_or_that_jams_where_it_is_told(case: Case) -> None:
    """Just beyond the first touch of polygons a mate that jams is free nowhere near where it is to be turned to."""
    pair, one, two = made(case)
    mesh = sector_meshes(pair)[0]
    steps = Steps(mesh, pair, 1)
    assert (mesh.entry_margin < 0) is (case in _JAMS)
    stands, a = pair.second_rotation(steps.stands - mesh.last, contact=1), pair.working_centre_distance

    def overlap(rho: float, turn: float = 0.0) -> float:
        return float(put(one, rho).intersection(put(two, stands - turn, a)).area)

    expected = steps.jams_at if case in _JAMS else steps.first_touch - mesh.last
    low, high = expected - 0.01, expected + 2e-3
    assert max(overlap(rho) for rho in np.arange(low - 0.6, low, 0.01)) == 0.0
    assert overlap(high) > 1e-6
    while high - low > 1e-6:
        middle = (low + high) / 2
        low, high = (low, middle) if overlap(middle) > 1e-9 else (middle, high)
    assert high == pytest.approx(expected, abs=1e-3)
    free = any(overlap(high + 1e-4, turn) < 1e-8 for turn in np.linspace(0.0, 0.012, 25))
    assert free is (case not in _JAMS)
    assert Steps(mesh, pair, -1).jams_at == pytest.approx(-steps.jams_at - mesh.last - mesh.first, abs=1e-12)


def crossing(own: float, other: float, apart: float) -> complex:
    """Where circles about 0 and about a place on the x axis cross above it, by bisection along the first."""
    low, high = 0.0, math.pi
    inside = abs(own - apart) < other
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (abs(own * np.exp(1j * middle) - apart) < other) == inside else (low, middle)
    return complex(own * np.exp(1j * low))


def land(outline: Polygon, radius: float) -> float:
    """Half of the angle of the tip land about +x of an outline, or of the tooth next to it, by its vertices."""
    whole = np.array(outline.exterior.coords) @ np.array([1, 1j])
    tips = np.sort(np.angle(whole[np.abs(np.abs(whole) - radius) < 1e-6]))
    ends = np.flatnonzero(np.diff(tips) > 0.03)
    return float(tips[ends[1]] - tips[ends[0] + 1]) / 2


@pytest.mark.parametrize("teeth", [17, 20, 23, 24])
@pytest.mark.parametrize("of_ring", [True, False])
def test_the_margin_of_a_first_tooth_in_a_ring_is_that_to_the_next_land(teeth: int, of_ring: bool) -> None:
    """The mate stands with a corner where the tip circles cross; the first tooth passes where they cross again."""
    ring = RingGear(2.0, 60, math.radians(20), 150.0, RoundedRoot(1.25, 0.3), given_tip_diameter=117.0,
                    sector=Sector(8, 0) if of_ring else None)  # fmt: skip
    pinion = SpurGear(2.0, teeth, iso_53("A"), sector=None if of_ring else Sector(5, 0))
    pair = internal_pair(pinion, ring)
    (mesh,) = sector_meshes(pair).values()
    mate: SpurGear | RingGear = pair.pinion if of_ring else pair.ring
    shape = polygon(gear_region(pair.pinion).region.outer if of_ring else ring_region(pair.ring).region.holes[0])
    half, a = land(shape, mate.tip_radius), pair.working_centre_distance
    # seen from the mate's axis the mesh lies along +x, the other axis on the pinion's side of it or behind
    other = pair.ring if of_ring else pair.pinion
    met = float(np.angle(crossing(mate.tip_radius, other.tip_radius, -a if of_ring else a)))
    middles = met + half + np.arange(-60, 60) * 2 * math.pi / mate.number_of_teeth
    asked = mate.tip_radius * min(np.abs(middles + met) - half)
    assert mesh.entry_margin == pytest.approx(asked, abs=1e-3)


@pytest.mark.parametrize("teeth", [18, 25, 40, 61])
def test_the_margin_of_a_first_tooth_on_a_rack_is_that_to_the_next_land(teeth: int) -> None:
    """By Pythagoras on the rack's tip line, with lands of pi m / 2 - 2 m tan(20)."""
    gear = SpurGear(2.0, teeth, iso_53("A"), sector=Sector(4, 0))
    mesh = sector_meshes(rack_pair(gear, Rack(2.0, 16, iso_53("A"), 5.0)))[0]
    met, wide = math.sqrt((teeth + 2) ** 2 - (teeth - 2) ** 2), math.pi - 4 * math.tan(math.radians(20))
    lands = [(met + 2 * math.pi * k, met + wide + 2 * math.pi * k) for k in range(-20, 1)]
    assert mesh.entry_margin == pytest.approx(min(max(low + met, -met - high) for low, high in lands), abs=1e-9)


def test_what_stays_in_mesh_goes_not_beyond() -> None:
    mesh = SectorMesh(5, 2, 0.2, -0.1, 0.2, -0.4, 0.4, 1.0, 0.0)
    low, high = mesh.ends(0)
    assert (low, high) == pytest.approx((-0.6, 0.6))
    assert mesh.beyond(low, high, 0.0) == 0.0
    assert mesh.beyond(low - 0.1, high, 0.0) == pytest.approx(0.1)
    assert mesh.beyond(math.pi - 0.1, math.pi + 0.75, math.pi) == pytest.approx(0.15)
    # out of mesh at the start already, the first run nearer than the second
    assert mesh.beyond(1.4, 1.4, 1.4) == pytest.approx(0.8)

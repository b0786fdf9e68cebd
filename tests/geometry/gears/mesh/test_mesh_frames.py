"""Frames of a mesh: rates against differences, there and back, windows against tip circles, gaps."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.gears.mesh.gears import GearMesh
from geometry.gears.mesh.rack import RackMesh
from geometry.gears.mesh.search import MeshSearch, least_gaps
from geometry.gears.pairs.external import external_pair
from geometry.gears.pairs.internal import internal_pair
from geometry.gears.pairs.rack import rack_pair
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.rack import Rack
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.distance import Verdict

RACK = iso_53()
PAIRS = {
    "external": external_pair(SpurGear(2.0, 13, RACK, 0.3), SpurGear(2.0, 24, RACK, 0.1)),
    "internal": internal_pair(
        SpurGear(2.0, 18, RACK, 0.2), RingGear(2.0, 61, RACK.pressure_angle, 140.0, RoundedRoot(), 0.4)
    ),
}
MESHES: dict[str, MeshSearch] = {name: GearMesh(pair, 0.001, 0.05 * pair.sign) for name, pair in PAIRS.items()} | {
    "rack": RackMesh(rack_pair(SpurGear(2.0, 15, RACK, 0.2), Rack(2.0, 9, RACK, 8.0)), 0.02, 0.05)
}
DRIVE = np.linspace(-0.4, 0.5, 7)
POINTS = np.array([11 + 2j, 12.5 - 1j, 14 + 0.5j, 13j])
STEP = 1e-6
ALL = pytest.mark.parametrize("name", MESHES)


@ALL
def test_rates_are_those_of_the_places(name: str) -> None:
    mesh = MESHES[name]
    for way in (mesh.to_fixed, mesh.to_second, lambda p, at: mesh.to_second(p, at, 0.07)):
        for point in POINTS:
            points = np.full(DRIVE.shape, point)
            _, rates = way(points, DRIVE)
            ends = [way(points, DRIVE + k * STEP)[0] for k in (-1, 1)]
            assert rates == pytest.approx((ends[1] - ends[0]) / (2 * STEP), abs=1e-6)


@ALL
def test_points_come_back_to_where_they_were(name: str) -> None:
    """In the fixed frame the first gear is turned by the drive angle, the second by its place, as its copies are."""
    mesh = MESHES[name]
    for point in POINTS:
        points = np.full(DRIVE.shape, point)
        fixed = np.exp(1j * DRIVE) * points
        own, _ = mesh.to_second(points, DRIVE)
        assert mesh.to_fixed(own, DRIVE)[0] == pytest.approx(fixed, abs=1e-12)
        # a copy k pitches on stands there at the drive angle that has moved it so far
        turn, shift = mesh.placing(mesh.second_position(DRIVE), np.full(DRIVE.shape, 2.0))
        later, _ = mesh.to_fixed(points, DRIVE + 2 * mesh.pitches[1] / mesh.rate)
        assert turn * point + shift == pytest.approx(later, abs=1e-9)
        # what the second body stands beyond its place is as if it had been driven there
        beyond, _ = mesh.to_second(points * np.exp(1j * (DRIVE - DRIVE - 0.03)), DRIVE + 0.03, -0.03 * mesh.rate)
        assert beyond == pytest.approx(mesh.to_second(points, DRIVE)[0], abs=1e-9)


@ALL
def test_points_of_the_second_body_are_carried_into_its_half_pitch(name: str) -> None:
    mesh, rng = MESHES[name], np.random.default_rng(4)
    size = 40.0
    points = rng.uniform(0.3, 1, 40) * size * np.exp(1j * rng.uniform(-3, 3, 40))
    vectors = np.exp(1j * rng.uniform(-3, 3, 40))
    there, ways = mesh.second_folded(points, vectors)
    place = there.imag if name == "rack" else np.angle(there)
    assert (place <= 1e-12).all()
    assert (place >= -mesh.pitches[1] / 2 - 1e-12).all()
    assert np.abs(ways) == pytest.approx(np.ones(40))
    # the same way along the outline, by a step there
    again, _ = mesh.second_folded(points + STEP * vectors, vectors)
    near = np.abs(again - there) < 2 * STEP
    assert near.sum() > 35
    assert (again - there)[near] / STEP == pytest.approx(ways[near], abs=1e-4)


def tips(name: str) -> tuple[float, float]:
    """Radii of the first gear's tip circle and of the second's; of a rack the height of its tips."""
    pair = MESHES[name].pair  # type: ignore[attr-defined]
    if name == "rack":
        return pair.gear.tip_radius, pair.rack.addendum
    return pair.first.tip_radius, pair.second.tip_radius


@ALL
@pytest.mark.parametrize("which", [0, 1])
def test_corners_are_looked_for_as_long_as_they_lie_within_the_mate(name: str, which: int) -> None:
    """At the window's middle a corner stands on the line of centres; beyond its ends it is out of the mate's tips."""
    mesh = MESHES[name]
    first, second = tips(name)
    corner = np.array([complex(max(mesh.outlines[which].convex_corners, key=abs))])
    middle, spread = mesh.corner_window(which, corner)
    assert spread > 0
    at = np.linspace(-1.5, 1.5, 301)
    drive = middle[0] + at * spread
    if which:
        place = mesh.to_fixed(np.full(drive.shape, corner[0]), drive)[0]
        within = np.abs(place) < first
        # seen from the first gear's axis
        aside = place.imag
    else:
        place = np.exp(1j * drive) * corner[0]
        aside = place.imag
        if name == "rack":
            within = place.real > mesh.distance - second  # type: ignore[attr-defined]
        else:
            away = np.abs(place - mesh.centre)  # type: ignore[attr-defined]
            within = away < second if name == "external" else away > second
    assert aside[150] == pytest.approx(0.0, abs=1e-9)
    assert not within[np.abs(at) > 1.01].any() or name == "internal"
    # and not a window much larger than needed, unless all of the mate's teeth are in reach
    if name != "internal" and within.any():
        assert np.abs(at[within]).max() > 0.8


@ALL
@pytest.mark.sampled(2)
@pytest.mark.parametrize("side", [0, 1])
def test_flanks_are_as_far_apart_as_the_closed_form_says(name: str, side: int) -> None:
    """Turned on by its share of the play a side touches; by more it overlaps by the arm of the line of action."""
    mesh = MESHES[name]
    pitch = mesh.pitches[0]
    drive = np.linspace(0, pitch, 9)
    found = least_gaps(mesh, drive).gap.reshape(-1, 2)
    closed = mesh.closed_form(drive)
    meets = np.isfinite(closed)
    assert meets.any()
    assert found[meets] == pytest.approx(closed[meets], abs=2e-9)
    # the second body a little on: one side opens, the other one closes, by its arm
    turn = 1e-3 / mesh.arm
    moved = least_gaps(mesh, drive, turn).gap.reshape(-1, 2)
    sense = -mesh.closing if side else mesh.closing
    both = meets & np.isfinite(mesh.closed_form(drive, turn))
    assert (moved - found)[both[:, side], side] == pytest.approx(sense * 1e-3, abs=1e-8)


@ALL
def test_no_point_of_the_second_body_moves_farther_than_it_says(name: str) -> None:
    mesh = MESHES[name]
    samples = np.concatenate([s.points for s in mesh.half.samples])
    turn = 1e-4
    moved = [mesh.placing(np.array([mesh.start + k * turn]), np.zeros(1)) for k in (0, 1)]
    ways = np.abs((moved[1][0] - moved[0][0]) * samples + moved[1][1] - moved[0][1]) / turn
    assert ways.max() <= mesh.reach * (1 + 1e-6)
    assert ways.max() > 0.95 * mesh.reach
    # a body's turn against the other one
    at = np.array([0.3])
    two = [mesh.to_second(np.array([p]), at)[1] for p in (12.0 + 0j, 13.0 + 0j)]
    assert abs(complex((two[1] - two[0])[0])) == pytest.approx(mesh.relative_turning, rel=1e-9)


@ALL
def test_a_pair_in_the_middle_of_its_play_is_clear_and_touches_when_it_is_driven(name: str) -> None:
    pair = MESHES[name].pair  # type: ignore[attr-defined]
    make = RackMesh if name == "rack" else GearMesh
    # a ring's pinion has the more play, the nearer both axes are
    wider = -0.02 if name == "internal" else 0.02
    clear = make(pair, 0.0, wider).contact()
    assert clear.verdict is Verdict.CLEAR
    play = min(min(side) for side in clear.side_gaps)
    assert clear.worst.gap == pytest.approx(play)
    assert clear.greatest_gap == pytest.approx(max(clear.gaps))
    assert np.minimum(*clear.side_gaps) == pytest.approx(np.array(clear.gaps))
    assert not clear.touches
    arm = make(pair).arm
    for sign in (-1, 1):
        driven = make(pair, sign * play / arm, wider).contact()
        # the flanks of one side are parallel all the way, so that they touch at every angle
        assert driven.verdict is Verdict.CONTACT
        assert driven.touches
        over = make(pair, sign * (play / arm) * (1 + 1e-3) + sign * 1e-6, wider).contact()
        assert over.verdict is Verdict.OVERLAP
        assert not over.touches
    assert math.isfinite(arm)

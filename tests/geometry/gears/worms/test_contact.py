"""Gaps between worms and wheels at another distance, against distances from the thread sought point by point.

The worm lies along z with the wheel's axis at x = a: the wheel's plane turns in x and z, heights run along -y.
"""

from __future__ import annotations

import cmath
import math
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from geometry.base.record import replace
from geometry.gears.mesh.search import PairContact
from geometry.gears.worms.contact import AxisErrors, _Flanks, contact_under, worm_contact
from geometry.gears.worms.drive import WormDrive
from geometry.gears.worms.hob import oversized_hob
from geometry.gears.worms.thread import thread_of
from geometry.gears.worms.wheel import WormTeeth
from geometry.gears.worms.worm import Worm
from geometry.plane.distance import Verdict
from geometry.plane.profile import Label

Real = NDArray[np.float64]
DRIVES = {hand: WormDrive(Worm(4.0, 2, 10.0, hand=hand), 30) for hand in ("right", "left")}
PITCH = 4 * math.pi


@cache
def teeth(hand: str) -> WormTeeth:
    drive = DRIVES[hand]
    hob = oversized_hob(drive, 0.2, 10.0).checked()
    return WormTeeth(hob, drive.centre_distance, drive.throat_radius, drive.most_outer_diameter / 2, 24.0)


def distances(worm: Worm, points: Real, shift: float, upper: bool) -> Real:
    """Of points (n, 3) outside a flank of the thread that has slid by ``shift`` from its surface, by Newton's steps."""
    x, y, z = points.T
    radius, turn = np.hypot(x, y), np.arctan2(y, x)
    way, lead = (1.0 if upper else -1.0), worm.sign * worm.parameter

    def surface(r: Real, at: Real) -> Real:
        return np.stack([r * np.cos(at), r * np.sin(at), lead * at + shift + way * worm.half_thickness(r)], axis=1)

    r, at = radius.copy(), turn.copy()
    for _ in range(6):
        here = surface(r, at)
        by_r = (surface(r + 1e-6, at) - surface(r - 1e-6, at)) / 2e-6
        by_at = np.stack([-r * np.sin(at), r * np.cos(at), np.full(r.shape, lead)], axis=1)
        miss = points - here
        a, b, c = ((u * v).sum(axis=1) for u, v in ((by_r, by_r), (by_r, by_at), (by_at, by_at)))
        p, q = (by_r * miss).sum(axis=1), (by_at * miss).sum(axis=1)
        whole = a * c - b * b
        r, at = r + (p * c - q * b) / whole, at + (q * a - p * b) / whole
    away = np.linalg.norm(points - surface(r, at), axis=1)
    inside = way * (z - (lead * turn + shift + way * worm.half_thickness(radius))) < 0
    return np.where(radius <= worm.tip_radius, np.where(inside, -away, away), np.inf)


def least(hand: str, slid: float, off: float, upper: bool, out: float, planes: int, shares: int) -> float:
    """The least distance of all flanks of one side from the thread."""
    drive, wheel = DRIVES[hand], teeth(hand)
    worm, heights = drive.worm, np.linspace(-12.0, 12.0, planes)
    plane = wheel.flank(wheel.side(-heights if upper else heights), np.linspace(0.0, 1.0, shares)[:, None]).plane
    plane = plane.conj() if upper else plane
    found = []
    for tooth in range(-3, 4):
        shift = slid + tooth * PITCH
        # a space faces the worm where it has not slid, and the wheel turns by starts over teeth of the worm's turn
        turn = (-1 if upper else 1) * math.pi / 30 - 2 / 30 * shift / worm.parameter
        turned = plane * cmath.exp(1j * turn)
        x = drive.centre_distance + out - turned.real
        points = np.stack([x, np.broadcast_to(-heights, x.shape), -turned.imag], axis=-1).reshape(-1, 3)
        near = np.hypot(points[:, 0], points[:, 1]) <= worm.tip_radius
        if near.any():
            found.append(distances(worm, points[near], shift + off, upper).min())
    return float(min(found))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("hand", DRIVES)
def test_a_worm_that_is_pulled_off_leaves_the_gaps_of_its_thread(hand: str) -> None:
    """And turned a little about its axis beside; both sides of the teeth in planes of their own."""
    worm, wheel = DRIVES[hand].worm, teeth(hand)
    found = worm_contact(worm, wheel, 5e-4, 0.04, None)
    assert found.verdict is Verdict.CLEAR
    assert found.drive_angles == pytest.approx([2 * math.pi / 30 * k / 24 for k in range(24)])
    off = -worm.sign * worm.parameter * 5e-4
    for k in (0, 7, 16):
        gaps = [least(hand, k * PITCH / 24, off, upper, 0.04, 15, 161) for upper in (False, True)]
        assert [side[k] for side in found.side_gaps] == pytest.approx(gaps, rel=0.01)
        assert found.gaps[k] == min(side[k] for side in found.side_gaps)
    # turned the other way round it leans to the other side
    other = worm_contact(worm, wheel, -5e-4, 0.04, None)
    assert other.gaps == pytest.approx([other.side_gaps[found_at(found)][k] for k in range(24)])
    assert found.greatest_gap == max(found.gaps)
    assert found.worst.gap == min(found.gaps)


def found_at(found: PairContact) -> int:
    """The side that is not the nearer one."""
    return 1 if min(found.side_gaps[0]) < min(found.side_gaps[1]) else 0


def test_tips_that_reach_the_ground_are_told_before_flanks() -> None:
    """A worm of less clearance pushed in: 0.2 m between its tip and the wheel's root."""
    drive = DRIVES["right"]
    thin = replace(drive.worm, thinning=2.0)
    for off, touches in ((-0.81, True),):
        found = worm_contact(thin, teeth("right"), 0.0, off, None)
        room = drive.centre_distance + off - float(teeth("right").root_radius(0.0)) - thin.tip_radius
        assert (found.verdict is Verdict.OVERLAP) is touches
        if touches:
            assert found.worst.gap == pytest.approx(room, rel=1e-12)
            assert found.worst.labels == (Label.ROOT_LAND, Label.TIP_LAND)
            assert found.worst.point == pytest.approx(drive.centre_distance + off - thin.tip_radius)


def test_each_place_is_asked_once_and_what_no_turn_moves_ends_the_rounds(monkeypatch: pytest.MonkeyPatch) -> None:
    """The golden section keeps one of its two places; a wheel within the worm's core stands no nearer to its middle.

    Before: both places were asked at every step, and all eight rounds were run: 15 872 times in place of 2 592.
    """
    asked: list[None] = []
    gap = _Flanks.gap

    def counted(flanks: _Flanks, share: Real, slid: Real, off: float) -> Real:
        asked.append(None)
        return gap(flanks, share, slid, off)

    monkeypatch.setattr(_Flanks, "gap", counted)
    thread, wheel = thread_of(DRIVES["right"].worm, 0.0), teeth("right")
    contact_under.cache_clear()
    found = contact_under(thread, wheel, AxisErrors(axial=7.5), None)
    assert found.verdict is Verdict.OVERLAP
    assert len(asked) == 2 * 2 * 2 * 4 * (33 + 2 + 45 + 1)

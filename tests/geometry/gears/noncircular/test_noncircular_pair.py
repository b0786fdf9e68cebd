"""Noncircular pairs: phase, ratio and contact of the outlines themselves, with negative controls."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.record import replace
from geometry.gears.noncircular.contact import noncircular_contact
from geometry.gears.noncircular.gear import NoncircularGear
from geometry.gears.noncircular.pair import NoncircularPair
from geometry.gears.noncircular.pairing import Centrode, Pairing, paired
from geometry.gears.noncircular.table import CurveTable
from geometry.gears.teeth.basic_rack import iso_53
from geometry.kinematics.centrodes import FourierRatio, LobedEllipse, RatioCentrode
from geometry.plane.distance import Verdict
from geometry.plane.profile import Label
from tests.oracles.ellipses import FocalEllipse, Oval
from tests.sampling import some_of

ALPHA = math.radians(20)


def gears(centrode: Centrode, teeth: tuple[int, int], x: float = 0.0) -> NoncircularPair:
    pairing = paired(centrode, teeth, 2.0, None)
    return NoncircularPair(one_of(pairing, 0, x), one_of(pairing, 1, -x))


def one_of(pairing: Pairing, which: int, x: float) -> NoncircularGear:
    return NoncircularGear(pairing.lines[which], pairing.teeth[which], iso_53("A"), which / 2, x, pairing=pairing)


def twins(pair: NoncircularPair) -> NoncircularPair:
    return NoncircularPair(pair.first, pair.first)


OVALS = gears(LobedEllipse(1.0, 0.2, 2), (22, 22))
ELLIPSES = gears(LobedEllipse(1.0, 0.4), (21, 21))


@pytest.mark.parametrize(("pair", "known"), [
    (ELLIPSES, FocalEllipse(40.0, 0.4)), (OVALS, Oval(1.5, 1.0)),
])  # fmt: skip
def test_phases_are_those_of_the_closed_forms(pair: NoncircularPair, known: FocalEllipse | Oval) -> None:
    """tan(phi_2 / 2) = K tan(phi_1 / 2) of ellipses, tan(phi_2) = (a / b) tan(phi_1) of ovals."""
    for phi in np.linspace(0.0, 6.0, 13):
        turned = math.pi - pair.second_rotation(float(phi))
        assert math.remainder(turned - float(known.mate_angle(phi)), 2 * math.pi) == pytest.approx(0, abs=1e-12)
    # any direction of the line of centres turns all with it
    assert pair.second_rotation(1.3, 0.4) == pytest.approx(pair.second_rotation(0.9) + 0.4, abs=1e-12)


def test_the_other_gear_first_is_the_same_mesh() -> None:
    back = NoncircularPair(ELLIPSES.second, ELLIPSES.first)
    for phi in (0.3, 2.0, 5.5):
        # seen from the second gear, the line of centres points the other way
        second = ELLIPSES.second_rotation(phi)
        assert math.remainder(back.second_rotation(second, math.pi) - phi, 2 * math.pi) == pytest.approx(0, abs=1e-11)


@pytest.mark.parametrize("pair", [
    pytest.param(twins(OVALS), marks=pytest.mark.heavy),
    pytest.param(twins(ELLIPSES), marks=pytest.mark.heavy),
    pytest.param(ELLIPSES, marks=pytest.mark.heavy),
    pytest.param(gears(LobedEllipse(1.0, 0.4), (21, 42)), marks=pytest.mark.heavy),
    gears(RatioCentrode(FourierRatio(1.0, (0.15,), (0.1,)), 1.0), (13, 13), 0.2),
])  # fmt: skip
def test_outlines_touch_all_round(pair: NoncircularPair) -> None:
    found = noncircular_contact(pair)
    assert found.verdict is Verdict.CONTACT
    # both flanks at once: no backlash, and no more than rounding of a gap or of an overlap
    assert max(map(abs, (*found.side_gaps[0], *found.side_gaps[1]))) < 1e-10
    assert pair.least_contact_ratio > 1.1
    assert not pair.findings()


@pytest.mark.heavy
def test_the_ratio_of_the_outlines_is_that_of_the_centrodes() -> None:
    """A second gear that is turned on by a little closes one side by its turn times the arm of the line of action.

    That line stands at the pressure angle to the centrodes' common tangent, everywhere else than this arm is wrong.
    """
    turn = 1e-7
    found = noncircular_contact(ELLIPSES, turn)
    assert found.verdict is Verdict.OVERLAP
    arcs = np.array([ELLIPSES.first.line.arc_at_angle(-drive) for drive in found.drive_angles])
    place, tangent, _ = ELLIPSES.second.line.frame(-arcs)
    arms = [(np.conj(place) * tangent * np.exp(1j * side * ALPHA)).imag for side in (1, -1)]
    for gaps, arm, sense in zip(found.side_gaps, arms, (1, -1), strict=True):
        assert np.allclose(np.array(gaps), sense * turn * arm, atol=2e-5 * turn * arm.max())
    assert np.ptp(arms[0]) > 5.0


@pytest.mark.heavy
@pytest.mark.parametrize(("turn", "shift", "verdict"), [
    (1e-7, 0.0, Verdict.OVERLAP),
    pytest.param(0.0, -1e-4, Verdict.OVERLAP, marks=pytest.mark.heavy),
    pytest.param(0.0, 0.01, Verdict.OVERLAP, marks=pytest.mark.heavy),
])  # fmt: skip
def test_a_pair_that_stands_wrong_is_told(turn: float, shift: float, verdict: Verdict) -> None:
    """Even farther apart teeth of changing ratio run into each other somewhere."""
    assert noncircular_contact(twins(OVALS), turn, shift).verdict is verdict


@pytest.mark.heavy
def test_thinning_gives_the_backlash() -> None:
    thin = replace(OVALS.first, circumferential_thinning=0.05)
    pair = twins(NoncircularPair(thin, thin))
    assert pair.normal_backlash == pytest.approx(0.1 * math.cos(ALPHA))
    found = noncircular_contact(pair)
    assert found.verdict is Verdict.CLEAR
    assert found.gaps == pytest.approx([pair.normal_backlash / 2] * len(found.gaps), abs=1e-9)


@pytest.mark.heavy
def test_another_gear_does_not_mesh() -> None:
    """Negative control: an oval of another shape at the same distance and phase."""
    other = gears(LobedEllipse(1.0, 0.21, 2), (22, 22))
    assert noncircular_contact(NoncircularPair(OVALS.first, other.second)).verdict is Verdict.OVERLAP


@pytest.mark.heavy
def test_equal_gears_mesh_by_their_numbers_of_teeth() -> None:
    for lobes, works, fails in some_of(((1, 21, 22), (2, 22, 24), (3, 33, 36))):
        shape = LobedEllipse(1.0, 0.1, lobes)
        assert paired(shape, (works, works), 2.0, None).twins_mesh
        assert not paired(shape, (fails, fails), 2.0, None).twins_mesh
    # where they do not, two of them stand tooth on tooth, and the mate of the driver meshes
    pair = gears(LobedEllipse(1.0, 0.1, 2), (12, 12))
    for stands, verdict in some_of(((twins(pair), Verdict.OVERLAP), (pair, Verdict.CONTACT))):
        assert noncircular_contact(stands).verdict is verdict


def test_sizes_by_centre_distance() -> None:
    pairing = paired(LobedEllipse(7.0, 0.4), (21, 21), None, 50.0)
    assert pairing.centre_distance == 50.0
    assert pairing.centrode.series(np.array([0.0, math.pi]), 0)[0].sum() == pytest.approx(50.0)


# --- a pair of few teeth, quick to hold against each other

SMALL = gears(LobedEllipse(1.0, 0.1, 2), (14, 14))


def thinned(pair: NoncircularPair, by: float) -> NoncircularPair:
    return NoncircularPair(*(replace(g, circumferential_thinning=by) for g in (pair.first, pair.second)))


def test_gaps_of_thinned_teeth_that_stand_turned() -> None:
    """Half of the backlash on either side, and the turn times the arm of the line of action, there and back."""
    pair, turn = thinned(SMALL, 0.05), 1e-5
    found = noncircular_contact(pair, turn)
    assert found.verdict is Verdict.CLEAR
    assert list(found.drive_angles) == sorted(found.drive_angles)
    # all comes again after half a turn
    span = found.drive_angles[-1] - found.drive_angles[0]
    assert math.pi * (1 - 1 / 7 / 6) < span < math.pi
    arcs = np.array([pair.first.line.arc_at_angle(-drive) for drive in found.drive_angles])
    place, tangent, _ = pair.second.line.frame(-arcs)
    half = pair.normal_backlash / 2
    assert half == pytest.approx(0.05 * math.cos(ALPHA))
    wanted = [half + sense * turn * (np.conj(place) * tangent * np.exp(1j * sense * ALPHA)).imag for sense in (1, -1)]
    for gaps, own, other in zip(found.side_gaps, wanted, wanted[::-1], strict=True):
        off = np.abs(np.array(gaps) - own) > 1e-9
        # a tip counts with both its corners, of which one is beside the other flank
        assert off.mean() < 0.02
        assert np.all((np.array(gaps) > other - 1e-9)[off])
    assert list(found.gaps) == [min(both) for both in zip(*found.side_gaps, strict=True)]
    assert found.greatest_gap == max(found.gaps)
    worst = found.worst
    assert worst.gap == min(found.gaps)
    assert found.gaps[found.drive_angles.index(worst.drive_angle)] == worst.gap
    # where it is least a point of the second outline stands so far from the first one as they lie then
    points = outline_points(pair.first) * np.exp(1j * worst.drive_angle)
    assert float(np.abs(points - worst.point).min()) == pytest.approx(worst.gap, abs=2e-4)
    turned = pair.second_rotation(worst.drive_angle) + turn
    others = outline_points(pair.second) * np.exp(1j * turned) + pair.centre_distance
    assert float(np.abs(others - worst.point).min()) < 1e-2
    assert worst.labels == (Label.FLANK, Label.FLANK)


def outline_points(gear: NoncircularGear) -> np.ndarray:
    one = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 400)) for s in gear.outline.segments])
    return np.concatenate([one * np.exp(2j * math.pi * k / gear.count) for k in range(gear.count)])


def test_a_tolerance_decides_what_touches() -> None:
    pair = thinned(SMALL, 0.001)
    half = pair.normal_backlash / 2
    found = noncircular_contact(pair, tolerance=1.01 * half)
    assert found.verdict is Verdict.CONTACT
    assert found.tolerance == 1.01 * half
    assert found.gaps == pytest.approx([half] * len(found.gaps), abs=1e-9)


@pytest.mark.parametrize("pair", [SMALL, gears(RatioCentrode(FourierRatio(1.0, (0.25,), (0.1,)), 1.0), (18, 18), 0.2)])
def test_either_gear_tells_how_the_other_stands(pair: NoncircularPair) -> None:
    for rotation, direction in ((0.3, 0.0), (2.0, 0.7), (-5.5, -1.2)):
        second = pair.second_rotation(rotation, direction)
        assert pair.first_rotation(second, direction) == pytest.approx(rotation, abs=1e-11)
    arcs = np.array([0.0, 3.0, -11.0])
    first, second = pair.rotations(arcs)
    for one, two in zip(first.tolist(), second.tolist(), strict=True):
        assert math.remainder(pair.second_rotation(one) - two, 2 * math.pi) == pytest.approx(0, abs=1e-11)
    # the ratio of both radii that touch, at its least and greatest
    angles = np.linspace(0, 2 * math.pi, 2001)
    radius = pair.first.pairing.centrode.series(angles, 0)[0]  # type: ignore[union-attr]
    ratio = radius / (pair.centre_distance - radius)
    assert pair.ratio_range == pytest.approx((ratio.min(), ratio.max()), rel=1e-5)


@pytest.mark.parametrize("gear", [SMALL.first, thinned(SMALL, 0.05).second])
def test_all_curves_at_once_are_the_curves_one_by_one(gear: NoncircularGear) -> None:
    """Places, directions, speeds and turning of a table against the outline's own curves and their derivatives."""
    table, shares = CurveTable(gear), np.array([0.1, 0.5, 0.8])
    curves = [s.curve for s in gear.outline.segments]
    for number, curve in enumerate(curves):
        low, high = curve.domain
        t = low + (high - low) * shares
        point, direction, speed, turning = table.at(np.full(3, number), t)
        first, second = curve.derivative(t), curve.derivative(t, 2)
        assert point == pytest.approx(curve.point(t), abs=1e-12)
        assert direction * speed == pytest.approx(first, abs=1e-10)
        assert np.abs(direction) == pytest.approx(1.0)
        # of a unit tangent the turning is Im(conj(T) c'') over the speed
        assert turning == pytest.approx((np.conj(direction) * second).imag / speed, abs=1e-8)
        fine = curve.point(np.linspace(low, high, 13))
        assert table.samples[number] == pytest.approx(fine, abs=1e-12)
        lengths = np.abs(np.diff(fine))
        assert table.lengths[number] == pytest.approx(1.2 * lengths)
        assert table.steps[number] == pytest.approx(1.2 * lengths.max())
        assert table.few[number] == pytest.approx(fine[::3])
        assert table.strides[number] == pytest.approx(1.2 * lengths.reshape(4, 3).sum(axis=1).max())


def test_distances_from_curves_are_those_of_their_nearest_points() -> None:
    """Beside its middle the height over it, out of the material above 0; beyond an end the way to that end."""
    gear = SMALL.first
    table = CurveTable(gear)
    for number, segment in enumerate(gear.outline.segments[:10]):
        curve = segment.curve
        low, high = curve.domain
        t = low + (high - low) * np.array([0.2, 0.5, 0.7])
        outward = -1j * curve.tangent(t)
        for height in (0.02, -0.02, 0.0):
            gap, way = table.distance(np.full(3, number), curve.point(t) + height * outward)
            assert gap == pytest.approx(height, abs=1e-9)
            assert way == pytest.approx(outward, abs=1e-7)
        for end, sense in ((low, -1), (high, 1)):
            place, tangent = complex(curve.point(end)), complex(curve.tangent(end))
            beyond = place + sense * 0.05 * tangent + 0.01 * -1j * tangent
            gap, way = table.distance(np.array([number]), np.array([beyond]))
            assert gap[0] == pytest.approx(math.hypot(0.05, 0.01), rel=1e-9)
            assert way[0] == pytest.approx((beyond - place) / abs(beyond - place), abs=1e-9)
            inside = place + sense * 0.05 * tangent - 0.01 * -1j * tangent
            assert table.distance(np.array([number]), np.array([inside]))[0][0] == pytest.approx(
                -math.hypot(0.05, 0.01), rel=1e-9)  # fmt: skip


def test_curves_about_an_arc_are_those_of_the_teeth_beside_it() -> None:
    """Of the teeth at most so many pitches off, each with all its curves, turned to where they stand."""
    gear = SMALL.first
    table = CurveTable(gear)
    step = gear.pitch
    for arc in (0.0, 4.2 * step, -9.6 * step):
        curves, turns = table.about(arc, 2)
        middle = gear.line.frame(np.array([arc]))[0][0]
        centres = [np.mean(table.samples[k]) * turn for k, turn in zip(curves, turns, strict=True)]
        assert len(curves) == 5 * len(gear.outline.segments) // 7
        # 14 teeth in 7 of a period: none farther than three pitches along the chord
        assert max(abs(c - middle) for c in centres) < 3.2 * step
        assert min(abs(c - middle) for c in centres) < 0.7 * step

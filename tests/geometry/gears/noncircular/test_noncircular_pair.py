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
from geometry.gears.teeth.basic_rack import iso_53
from geometry.kinematics.centrodes import FourierRatio, LobedEllipse, RatioCentrode
from geometry.plane.distance import Verdict
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
    gears(RatioCentrode(FourierRatio(1.0, (0.25,), (0.1,)), 1.0), (18, 18), 0.2),
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


def test_equal_gears_mesh_by_their_numbers_of_teeth() -> None:
    for lobes, works, fails in some_of(((1, 21, 22), (2, 22, 24), (3, 33, 36))):
        shape = LobedEllipse(1.0, 0.1, lobes)
        assert paired(shape, (works, works), 2.0, None).twins_mesh
        assert not paired(shape, (fails, fails), 2.0, None).twins_mesh
    # where they do not, two of them stand tooth on tooth, and the mate of the driver meshes
    pair = gears(LobedEllipse(1.0, 0.2, 2), (16, 16))
    for stands, verdict in some_of(((twins(pair), Verdict.OVERLAP), (pair, Verdict.CONTACT))):
        assert noncircular_contact(stands).verdict is verdict


def test_sizes_by_centre_distance() -> None:
    pairing = paired(LobedEllipse(7.0, 0.4), (21, 21), None, 50.0)
    assert pairing.centre_distance == 50.0
    assert pairing.centrode.series(np.array([0.0, math.pi]), 0)[0].sum() == pytest.approx(50.0)

"""Statics of trains: energy, textbook efficiencies of planetary sets, self-locking, two states at once."""

from __future__ import annotations

import itertools
import random
from fractions import Fraction

import pytest

from geometry.base.errors import ParameterError
from geometry.kinematics.mechanism import Mechanism, Revolute, Rolling, turns
from geometry.kinematics.statics import statics

LOAD = Fraction(-1)


def planetary(teeth: tuple[int, int, int, int], kinds: tuple[str, str], held: tuple[str, ...]) -> Mechanism:
    z1, z2, z2p, z3 = teeth
    return Mechanism(
        (Revolute("1"), Revolute("H"), Revolute("2", on="H"), Revolute("3"),
         Rolling(kinds[0], "1", "2", (z1, z2), on="H"), Rolling(kinds[1], "2", "3", (z2p, z3), on="H")),  # type: ignore[arg-type]
        held,
    )  # fmt: skip


def textbook(p: Fraction, eta: Fraction, driver: str, driven: str) -> set[Fraction]:
    """Efficiencies of a set of carried ratio p whose two meshes together have ``eta``: T1 p eta^w + T3 = 0.

    w is +1 where wheel 1 drives as the carrier sees it, so that T1 (w1 - wH) > 0, else -1; T1 + T3 + TH = 0.
    """
    held = next(x for x in "13H" if x not in (driver, driven))
    found = set()
    for w in (1, -1):
        torque = {"1": Fraction(1), "3": -p * eta**w}
        torque["H"] = -torque["1"] - torque["3"]
        # w1 - wH = p (w3 - wH): with the held one at 0 and the driver at 1
        c = {"1": Fraction(1), "3": -p, "H": p - 1}
        speed = {held: Fraction(0), driver: Fraction(1), driven: -c[driver] / c[driven]}
        # the load works against the motion
        if not torque[driven]:
            continue
        scale = (-1 if speed[driven] > 0 else 1) / torque[driven]
        torque = {k: t * scale for k, t in torque.items()}
        if torque["1"] * (speed["1"] - speed["H"]) * w > 0:
            found.add(-torque[driven] * speed[driven] / (torque[driver] * speed[driver]))
    return found


def test_efficiencies_are_those_of_the_textbook() -> None:
    random.seed(4)
    eta, seen = Fraction("0.93"), set()
    for _ in range(25):
        teeth = tuple(random.randint(11, 70) for _ in range(4))
        kinds = random.choice([("external", "internal"), ("external", "external"), ("internal", "internal")])
        p = Fraction(teeth[1] * teeth[3], teeth[0] * teeth[2]) * (1 if kinds[0] == kinds[1] else -1)
        for driver, driven in itertools.permutations("13H", 2):
            held = next(x for x in "13H" if x not in (driver, driven))
            if p == 1:
                continue
            train = planetary(teeth, kinds, (held,))  # type: ignore[arg-type]
            way = turns(train, [driver]).ratio(driver, driven)
            states = statics(train, {driver: Fraction(1)}, {driven: LOAD if way > 0 else -LOAD}, eta)
            found = {state.efficiency for state in states if state.efficiency is not None}
            assert found == textbook(p, eta**2, driver, driven), (teeth, kinds, driver, driven)
            seen.add(len(found))
    assert seen == {0, 1}


def test_james_published() -> None:
    """(1 + 3 eta^2) / 4 of 40/40/120 (Kudryavtsev, planetary drives)."""
    train = planetary((40, 40, 40, 120), ("external", "internal"), ("3",))
    (state,) = statics(train, {"1": Fraction(120)}, {"H": Fraction(-4)}, Fraction("0.98"))
    assert state.efficiency == (1 + 3 * Fraction("0.98") ** 2) / 4
    assert state.circulation == Fraction(3, 4)


def test_ferguson_gives_a_quarter_of_a_percent_and_holds_back() -> None:
    train = planetary((100, 101, 100, 99), ("external", "external"), ("3",))
    (state,) = statics(train, {"H": Fraction(10_000)}, {"1": LOAD}, Fraction("0.98"))
    assert float(state.efficiency or 0) == pytest.approx(0.002519, abs=5e-7)
    assert state.circulation > 20
    assert statics(train, {"1": Fraction(1)}, {"H": LOAD}, Fraction("0.98")) == ()
    (free,) = statics(train, {"1": Fraction(1)}, {"H": LOAD})
    assert free.efficiency == 1


def closed(z: tuple[int, ...], w: tuple[int, ...], kinds: tuple[str, ...]) -> Mechanism:
    """A differential whose wheels 1 and 3 a shaft 5 joins."""
    return Mechanism((
        Revolute("1"), Revolute("H"), Revolute("2", on="H"), Revolute("3"), Revolute("5"),
        Rolling(kinds[0], "1", "2", (z[0], z[1]), on="H"), Rolling(kinds[1], "2", "3", (z[2], z[3]), on="H"),  # type: ignore[arg-type]
        Rolling(kinds[2], "5", "1", (w[0], w[1])), Rolling(kinds[3], "5", "3", (w[2], w[3])),  # type: ignore[arg-type]
    ))  # fmt: skip


def test_energy_is_kept_in_closed_trains_and_every_loss_has_its_sign() -> None:
    random.seed(1)
    numbers, eta = set(), Fraction("0.9")
    for _ in range(16):
        z, w = (tuple(random.randint(12, 60) for _ in range(4)) for _ in range(2))
        train = closed(z, w, tuple(random.choices(("external", "internal"), k=4)))
        moved = turns(train, ["5"])
        if moved.free or not (out := moved.of("H")):
            continue
        load = {"H": LOAD if out["5"] > 0 else -LOAD}
        states = statics(train, {"5": Fraction(1)}, load, eta)
        numbers.add(len(states))
        for state in states:
            assert sum(state.powers.values()) == sum(flow.loss for flow in state.flows)
            for flow in state.flows:
                # what goes in comes out times eta, on whichever side
                assert flow.loss == (1 - eta) * max(flow.power, -flow.power / eta)
        (ideal,) = statics(train, {"5": Fraction(1)}, load)
        assert sum(ideal.powers.values()) == 0
    assert {0, 1} <= numbers


def test_both_states_are_told_where_two_agree_with_their_losses() -> None:
    """A closed train of two internal meshes, found by trying: two assignments out of sixteen are consistent."""
    train = closed((48, 53, 35, 31), (30, 36, 38, 45), ("internal",) * 4)
    way = turns(train, ["5"]).of("H")["5"]
    states = statics(train, {"5": Fraction(1)}, {"H": LOAD if way > 0 else -LOAD}, Fraction("0.9"))
    assert len(states) == 2
    assert states[0].efficiency != states[1].efficiency


def test_equal_satellites_are_told_to_share() -> None:
    one = planetary((40, 40, 40, 120), ("external", "internal"), ("3",))
    more = (
        Revolute("2b", on="H"),
        Rolling("external", "1", "2b", (40, 40), on="H"),
        Rolling("internal", "2b", "3", (40, 120), on="H"),
    )
    two = Mechanism((*one.joints, *more), ("3",))
    (state,) = statics(two, {"1": Fraction(1)}, {"H": Fraction(-4)}, Fraction("0.98"))
    (alone,) = statics(one, {"1": Fraction(1)}, {"H": Fraction(-4)}, Fraction("0.98"))
    assert len(state.idle) == 1
    assert state.efficiency == alone.efficiency
    assert state.torques == alone.torques


def test_long_trains_are_followed() -> None:
    """Fourteen pairs one after the other: eta^14."""
    joints = [Revolute(f"{k}") for k in range(15)]
    pairs = [Rolling("external", f"{k}", f"{k + 1}", (20, 30)) for k in range(14)]
    (state,) = statics(Mechanism((*joints, *pairs)), {"0": Fraction(1)}, {"14": LOAD}, Fraction("0.99"))
    assert state.efficiency == Fraction("0.99") ** 14


def test_refusals() -> None:
    train = planetary((40, 40, 40, 120), ("external", "internal"), ("3",))
    with pytest.raises(ParameterError) as caught:
        statics(train, {"1": Fraction(1)}, {"3": Fraction(1)})
    assert caught.value.code == "load_on_given_link"
    with pytest.raises(ParameterError) as caught:
        statics(train, {"1": Fraction(1)}, {"H": Fraction(1)}, Fraction(2))
    assert caught.value.code == "not_an_efficiency"

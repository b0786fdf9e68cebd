"""Mechanisms in motion: against 50-digit differentiation, exact turns, instant centres and closed loops of levers."""

from __future__ import annotations

import cmath
import math
import subprocess
import sys
from fractions import Fraction
from functools import partial
from typing import Any

import mpmath as mp
import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.series import Series
from geometry.curves.curve import Real
from geometry.kinematics.groups import parallel_cranks
from geometry.kinematics.mechanism import FRAME, Fixed, Group, Joint, Mechanism, Prismatic, Revolute, Rolling, Uneven
from geometry.kinematics.moving import Drive, moving
from tests.oracles.envelope import GivenMotion, instant_centre
from tests.sampling import some_of

# z1 = 40, z2 = 40, z3 = 120 of seed 001, example 7 with the satellite that fits, in m 2
JAMES = Mechanism(
    (
        Revolute("1"),
        Revolute("H"),
        Revolute("2", on="H", at=80),
        Revolute("3"),
        Rolling("external", "1", "2", (40, 40), on="H"),
        Rolling("internal", "2", "3", (40, 120), on="H"),
    ),
    held=("3",),
)


def series(function: Any, t: float, order: int) -> list[complex]:
    """Taylor coefficients at 50 digits."""
    with mp.workdps(50):
        return [complex(x) for x in mp.taylor(function, mp.mpf(t), order)]


def close(found: Series, wanted: list[complex], relative: float = 1e-12) -> bool:
    size = max(abs(x) for x in wanted)
    return all(abs(complex(x) - y) <= relative * max(abs(y), 1e-3 * size) for x, y in zip(found, wanted, strict=True))


def test_a_chain_of_200_links() -> None:
    """Each link on the end of the one before it, every third driven by gears from its neighbour, all bent at first."""
    joints: list[Joint] = []
    drives: list[Drive] = []
    rates: list[Fraction] = []
    ends = [complex(k, (k % 5) * 0.3) for k in range(201)]
    for k in range(200):
        joints.append(Revolute(f"{k}", on=f"{k - 1}" if k else FRAME, at=ends[k]))
        if k % 3 == 2:
            # a wheel on the axis of link k, fixed to link k - 2, would turn it: here against the link below
            joints += [Revolute(f"w{k}", on=f"{k - 1}", at=ends[k] + 1)]
            joints += [Rolling("external", f"w{k}", f"{k}", (17, 20 + k), on=f"{k - 1}")]
            drives.append(Drive(f"w{k}", Fraction(k, 7)))
            below = rates[-1]
            rates.append(below - (Fraction(k, 7) - below) * Fraction(17, 20 + k))
        else:
            rates.append(Fraction((-1) ** k * (k + 1), 13))
            drives.append(Drive(f"{k}", rates[-1]))
    chain = moving(Mechanism(tuple(joints)), drives)

    def end(t: Any) -> Any:
        turned = [mp.expjpi(2 * mp.mpf(rate.numerator) / rate.denominator * t) for rate in rates]
        return sum(
            u * mp.mpmathify(b - a) for u, a, b in zip(turned, ends[:-1], ends[1:], strict=False) if u is not turned[-1]
        )

    for t in some_of((0.0, 0.37, 11.25)):
        place, angle = chain.pose("199", np.array(t), 2)
        assert close(place, series(end, t, 2))
        exact = rates[-1] * Fraction(t) % 1
        assert math.remainder(float(angle[0]) - 2 * math.pi * float(exact), 2 * math.pi) == pytest.approx(0, abs=1e-15)
        assert float(angle[1]) == pytest.approx(2 * math.pi * float(rates[-1]), rel=1e-15)


def test_a_train_of_1e12_stands_within_1e_12_of_a_pitch() -> None:
    joints: list[Joint] = [Revolute("0")]
    for k in range(1, 13):
        joints += [Revolute(f"{k}"), Rolling("internal", f"{k - 1}", f"{k}", (200, 20))]
    train = moving(Mechanism(tuple(joints)), (Drive("0"),))
    for t in (0.1, 1 / 3, math.pi, 123456.789):
        exact = Fraction(t) * 10**12 % 1
        exact -= exact > Fraction(1, 2)
        found = float(train.pose("12", np.array(t), 1)[1][0])
        assert abs(found / (2 * math.pi) - exact) < 1e-12 / 20


def test_satellites_go_round_with_their_carrier() -> None:
    """Its centre turns with the carrier, it rolls on the ring: the instant centre is the pitch point (seed 001, 4)."""
    reducer = moving(JAMES, (Drive("1"),))
    t = np.linspace(-3, 3, 25)
    place, angle = reducer.pose("2", t, 2)
    carrier = 2 * math.pi * t / 4
    assert np.allclose(place[0], 80 * np.exp(1j * carrier), atol=1e-12)
    assert np.allclose(place[1], 80 * np.exp(1j * carrier) * 1j * math.pi / 2, atol=1e-11)
    assert np.allclose(np.exp(1j * angle[0]), np.exp(-2j * carrier), atol=1e-14)
    ring, satellite, sun_gear = (GivenMotion(partial(reducer.pose, link)) for link in "321")
    fixed, moves = instant_centre(ring, satellite, t)
    assert np.allclose(fixed, 120 * np.exp(1j * carrier), atol=1e-11)
    assert np.allclose(abs(moves), 40, atol=1e-11)
    sun, _ = instant_centre(sun_gear, satellite, t)
    assert np.allclose(abs(sun), 40, atol=1e-11)


def test_two_drives_and_a_law() -> None:
    """A differential: what two drives give adds up, the second by a law that no line tells."""

    def law(t: Real, order: int) -> Series:
        return [np.sin(t), np.cos(t), -np.sin(t) / 2][: order + 1]

    both = moving(Mechanism(JAMES.joints), (Drive("1", Fraction(2), Fraction(1, 4)), Drive("3", law=law)))
    place, angle = both.pose("H", np.array(0.3), 2)
    # w_H = (z1 w1 + z3 w3) / (z1 + z3)
    wanted = [(2 * math.pi * (0.25 + 2 * 0.3) + 3 * math.sin(0.3)) / 4, (4 * math.pi + 3 * math.cos(0.3)) / 4]
    assert [float(x) for x in angle] == pytest.approx([*wanted, -3 * math.sin(0.3) / 8])
    assert [complex(x) for x in place] == [0, 0, 0]


def test_a_rack_travels_and_carries() -> None:
    wheel = Rolling("rack", "1", "rack", (20, 1), module=Fraction(5, 2))
    rack = Prismatic("rack", direction=cmath.rect(1, 0.3))
    moved = moving(
        Mechanism((Revolute("1"), rack, wheel, Fixed("pen", on="rack")), starts={"pen": (3j, 0.1)}), (Drive("1"),)
    )
    place, angle = moved.pose("pen", np.array(2.5), 1)
    assert complex(place[0]) == pytest.approx(3j + cmath.rect(2.5 * math.pi * 2.5 * 20, 0.3), rel=1e-14)
    assert (float(angle[0]), float(angle[1])) == (0.1, 0.0)
    assert complex(place[1]) == pytest.approx(cmath.rect(50 * math.pi, 0.3), rel=1e-14)


def waving(turn: Series) -> Series:
    """0.2 sin x and its coefficients over t, to the second."""
    x = [*turn, 0.0, 0.0]
    found = [0.2 * np.sin(x[0]), 0.2 * np.cos(x[0]) * x[1], 0.1 * (2 * np.cos(x[0]) * x[2] - np.sin(x[0]) * x[1] ** 2)]
    return found[: len(turn)]


@pytest.mark.parametrize("driver", ["1", "2"])
def test_an_uneven_wheel_is_ahead_of_its_ratio_by_what_its_driver_says(driver: str) -> None:
    """Teeth 20 and 40 the other way round: psi = -phi / 2, and 0.2 sin of the driver's turn beyond."""
    mesh = Rolling("external", "1", "2", (20, 40), uneven=Uneven(driver, waving))
    moved = moving(Mechanism((Revolute("1"), Revolute("2", at=60), mesh)), (Drive(driver, Fraction(1, 10)),))
    other, ratio = ("2", -0.5) if driver == "1" else ("1", -2.0)
    for t in (0.0, 0.3, 1.7, 4.4):
        turn = 2 * math.pi * t / 10
        place, angle = moved.pose(other, np.array(t), 1)
        wanted = ratio * turn + 0.2 * math.sin(turn)
        assert math.remainder(float(angle[0]) - wanted, 2 * math.pi) == pytest.approx(0.0, abs=1e-14)
        assert float(angle[1]) == pytest.approx(math.pi / 5 * (ratio + 0.2 * math.cos(turn)), rel=1e-14)
        assert complex(place[0]) == (60 if other == "2" else 0)


def test_a_link_on_parallel_cranks_turns_as_the_link_below() -> None:
    """A base that turns, an arm on it, and three cranks as long as that arm: each crank turns as the arm does.

    A wheel that gears with the first crank is driven by what the group leaves it.
    """
    pivots = (30.0 + 0j, -10.0 + 20j, 5.0 - 25j)
    cranks = parallel_cranks("link", ("a", "b", "c"), ("base", pivots), ("arm", 12.0 + 5j))
    joints = (
        Revolute("base", at=3 + 4j), Revolute("arm", on="base", at=8 + 4j), cranks,
        Revolute("wheel", on="base", at=60.0), Rolling("external", "a", "wheel", (20, 30), on="base"),
    )  # fmt: skip
    starts = {"base": (3 + 4j, 0.3), "arm": (8 + 4j, -0.2)}
    moved = moving(Mechanism(joints, starts=starts), (Drive("base", Fraction(1, 8)), Drive("arm", Fraction(-1, 5))))
    for t in (0.0, 0.4, 0.9):
        base, arm = 2 * math.pi * t / 8, -2 * math.pi * t / 5
        axis = 3 + 4j + 5 * cmath.exp(1j * base)
        # the frame of the arm was at -0.2 rad, that of the base at 0.3
        end = axis + (12 + 5j) * cmath.exp(1j * (arm - 0.2))
        wanted = {"link": (end, 0.3 + base)}
        for name, pivot in zip("abc", pivots, strict=True):
            wanted[name] = axis + pivot * cmath.exp(1j * (base + 0.3)), arm - 0.2
        for name, (place, angle) in wanted.items():
            found = moved.pose(name, np.array(t), 2)
            assert complex(found[0][0]) == pytest.approx(place, rel=1e-13)
            assert float(found[1][0]) == pytest.approx(angle, rel=1e-13, abs=1e-14)
            before, after = (moved.pose(name, np.array(t + k * 1e-4), 0) for k in (-1, 1))
            for value, low, high in zip(found, before, after, strict=True):
                assert complex(value[1]) == pytest.approx(complex((high[0] - low[0]) / 2e-4), abs=1e-5)
                bend = complex((high[0] - 2 * value[0] + low[0]) / 1e-8)
                assert 2 * complex(value[2]) == pytest.approx(bend, abs=1e-4)
        # against the base the wheel turns 2/3 of the crank's turn, the other way
        wheel = moved.pose("wheel", np.array(t), 1)[1]
        assert float(wheel[0]) == pytest.approx(base - (arm - base) * 2 / 3, rel=1e-13, abs=1e-14)
        assert float(wheel[1]) == pytest.approx(2 * math.pi * (1 / 8 + 2 / 3 * (1 / 5 + 1 / 8)), rel=1e-13)


def test_what_moves_itself_is_refused() -> None:
    law = Group(("follower",), (FRAME, "wheel"), lambda given: [given[1]], (1, 1))
    train = (Revolute("wheel"), Rolling("external", "follower", "wheel", (20, 20)), law)
    with pytest.raises(ParameterError, match="moves_itself"):
        moving(Mechanism(train), ())


def test_nothing_heavy_is_imported() -> None:
    code = (
        "import sys, geometry.kinematics.groups, geometry.kinematics.moving;"
        "print([m for m in ('scipy', 'OCP', 'matplotlib', 'ezdxf') if m in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"

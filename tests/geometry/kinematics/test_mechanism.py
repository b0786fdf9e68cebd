"""Gear equations solved exactly: against products of ratios, Willis' formula, a rank modulo a prime, and the seeds."""

from __future__ import annotations

import random
from collections.abc import Sequence
from fractions import Fraction

import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.kinematics.mechanism import (
    FRAME,
    Fixed,
    Group,
    Joint,
    Mechanism,
    Prismatic,
    Revolute,
    Rolling,
    equations,
    mobility,
    turns,
)

PRIME = (1 << 61) - 1


def mesh(first: str, second: str, one: int, two: int, on: str = FRAME) -> Rolling:
    """An internal mesh where the teeth of the second are negative, as seed 001 has its signs."""
    return Rolling("internal" if two < 0 else "external", first, second, (one, abs(two)), on=on)


def planetary(teeth: Sequence[int], satellites: int = 1, held: tuple[str, ...] = ("3",)) -> Mechanism:
    """1 - 2, 2' - 3 with carrier H, the mates' teeth signed as by ``mesh``: z1, z2, z2', z3."""
    z1, z2, z2_, z3 = teeth
    joints: list[Joint] = [Revolute("1"), Revolute("H"), Revolute("3")]
    for k in range(satellites):
        satellite = "2" + "abcdefgh"[k] if satellites > 1 else "2"
        joints += [Revolute(satellite, on="H"), mesh("1", satellite, z1, z2, "H"), mesh(satellite, "3", z2_, z3, "H")]
    return Mechanism(tuple(joints), held)


def rank_modulo(rows: Sequence[dict[str, int]]) -> int:
    """Rank of whole rows modulo a prime: below the true one for few in 10^18."""
    columns = sorted({key for row in rows for key in row})
    table = [[row.get(key, 0) % PRIME for key in columns] for row in rows]
    rank = 0
    for column in range(len(columns)):
        pivot = next((k for k in range(rank, len(table)) if table[k][column]), None)
        if pivot is None:
            continue
        table[rank], table[pivot] = table[pivot], table[rank]
        inverse = pow(table[rank][column], -1, PRIME)
        for k in range(rank + 1, len(table)):
            factor = table[k][column] * inverse % PRIME
            if factor:
                table[k] = [(a - factor * b) % PRIME for a, b in zip(table[k], table[rank], strict=True)]
        rank += 1
    return rank


def willis(joint: Rolling) -> dict[str, int]:
    """z1 (w1 - wH) = -+ z2 (w2 - wH), written down anew."""
    (one, two), sign = joint.teeth, -1 if joint.kind == "internal" else 1
    row: dict[str, int] = {}
    for link, value in ((joint.first, one), (joint.second, sign * two), (joint.on, -one - sign * two)):
        if link != FRAME:
            row[link] = row.get(link, 0) + value
    return row


class Train:
    """A random train of stages in a row, with what it must answer: ratio of input to output, mobility."""

    def __init__(self, dice: random.Random) -> None:
        self.dice = dice
        self.joints: list[Joint] = [Revolute("s0")]
        self.held: list[str] = []
        self.ratio, self.mobility, self.last = Fraction(1), 1, "s0"
        self.stages = dice.randint(1, 6)
        for number in range(1, self.stages + 1):
            dice.choice((self.pair, self.idler, self.loop, self.planet))(f"s{number}", f"{number}")
            self.last = f"s{number}"

    def teeth(self) -> int:
        return self.dice.randint(9, 150) * self.dice.choice((1, 1, -1))

    def pair(self, out: str, number: str) -> None:
        one, two = abs(self.teeth()), self.teeth()
        self.joints += [Revolute(out), mesh(self.last, out, one, two)]
        self.ratio *= Fraction(-two, one)

    def idler(self, out: str, number: str) -> None:
        a, b, c, d = abs(self.teeth()), self.teeth(), abs(self.teeth()), self.teeth()
        middle, beside = f"i{number}", f"j{number}"
        self.joints += [Revolute(middle), Fixed(beside, on=middle), Revolute(out)]
        self.joints += [mesh(self.last, middle, a, b), mesh(beside, out, c, d)]
        self.ratio *= Fraction(b * d, a * c)

    def loop(self, out: str, number: str) -> None:
        """Two ways from shaft to shaft: of one ratio (a constraint too many) or of two (nothing moves)."""
        self.idler(out, number)
        a, b, c, d = *self.signed(-2), *self.signed(-1)
        again = f"k{number}"
        if self.dice.random() < 0.9:
            self.joints += [Revolute(again), mesh(self.last, again, 2 * a, 2 * b), mesh(again, out, 3 * c, 3 * d)]
        else:
            self.joints += [
                Revolute(again),
                mesh(self.last, again, a, b),
                mesh(again, out, c, d + (1 if d > 0 else -1)),
            ]
            self.mobility -= 1

    def signed(self, index: int) -> tuple[int, int]:
        joint = self.joints[index]
        assert isinstance(joint, Rolling)
        return joint.teeth[0], joint.teeth[1] * (-1 if joint.kind == "internal" else 1)

    def planet(self, out: str, number: str) -> None:
        """Sun, carrier and wheel 3: one is driven, one drives on, the third is held or free."""
        z1, z2, z2_, z3 = abs(self.teeth()), self.teeth(), abs(self.teeth()), self.teeth()
        inner = Fraction(z2 * z3, z1 * z2_)
        if inner == 1:
            return self.pair(out, number)
        roles = ["1", "H", "3"]
        self.dice.shuffle(roles)
        names = dict(zip(roles, (self.last, out, f"h{number}"), strict=True))
        self.joints += [Revolute(out), Revolute(f"h{number}")]
        for k in range(self.dice.randint(1, 4)):
            satellite = f"p{number}{k}"
            self.joints.append(Revolute(satellite, on=names["H"]))
            self.joints.append(mesh(names["1"], satellite, z1, z2, names["H"]))
            self.joints.append(mesh(satellite, names["3"], z2_, z3, names["H"]))
        self.held.append(f"h{number}")
        # w1 - wH = inner (w3 - wH)
        speeds = {"13H": 1 / inner, "31H": inner, "1H3": 1 / (1 - inner), "H13": 1 - inner}
        speeds |= {"3H1": 1 / (1 - 1 / inner), "H31": 1 - 1 / inner}
        self.ratio /= speeds[roles[0] + roles[1] + roles[2]]
        return None

    @property
    def mechanism(self) -> Mechanism:
        return Mechanism(tuple(self.joints), tuple(self.held))


def check_trains(seeds: range) -> None:
    stuck = freed = 0
    for seed in seeds:
        dice = random.Random(seed)
        train = Train(dice)
        mechanism = train.mechanism
        found = mobility(mechanism)
        rows = [willis(joint) for joint in mechanism.joints if isinstance(joint, Rolling)]
        held = [{link: 1} for link in mechanism.held]
        bodies: dict[str, str] = {j.link: j.on for j in mechanism.joints if isinstance(j, Fixed)}
        merged = [{bodies.get(key, key): value for key, value in row.items()} for row in rows]
        unknowns = sum(isinstance(joint, Revolute) for joint in mechanism.joints)
        assert found.degrees == unknowns - rank_modulo([*merged, *held])
        assert found.chebyshev + len(found.redundant) >= found.degrees
        if train.mobility < 1:
            stuck += 1
            with pytest.raises(ParameterError, match="contradicts"):
                turns(mechanism, ("s0",))
            continue
        assert found.degrees == 1, seed
        assert turns(mechanism, ("s0",)).ratio("s0", train.last) == train.ratio, seed
        if mechanism.held:
            freed += 1
            # released, that wheel is a second drive: the output is what both give together
            loose = replace(mechanism, held=mechanism.held[1:])
            both = turns(loose, ("s0", mechanism.held[0]))
            assert mobility(loose).degrees == 2
            assert both.of(train.last)["s0"] == 1 / train.ratio
            assert both.free == ()
            assert mechanism.held[0] in turns(loose, ("s0",)).free
    assert stuck
    assert freed


def test_random_trains() -> None:
    check_trains(range(60))


@pytest.mark.heavy
def test_ten_thousand_random_trains() -> None:
    check_trains(range(10_000))


@pytest.mark.parametrize(("wheels", "degrees", "redundant"), [(3, 0, 0), (4, 1, 1), (5, 0, 0), (6, 1, 1)])
def test_rings_of_external_wheels(wheels: int, degrees: int, redundant: int) -> None:
    """An odd ring stands still; an even one turns though Chebyshev gives 0, by one constraint too many."""
    meshes = [mesh(str(k), str((k + 1) % wheels), 20, 20) for k in range(wheels)]
    found = mobility(Mechanism((*(Revolute(str(k)) for k in range(wheels)), *meshes)))
    assert (found.links, found.lower_pairs, found.higher_pairs, found.chebyshev) == (wheels, wheels, wheels, 0)
    assert found.degrees == degrees
    assert [(r.source, r.follows_from) for r in found.redundant] == [(meshes[-1], tuple(meshes[:-1]))] * redundant


# z1, z2, z2', z3 as ``planetary`` has them; u_1H with wheel 3 held
SEEDS = {
    "001.ex7.coaxial": ((40, 40, 40, -120), 4),
    "001.ex8 as printed": ((40, 30, 20, 60), Fraction(-5, 4)),
    "001.ex8.z1_50": ((50, 30, 20, 60), Fraction(-4, 5)),
    "001.ex9 stage": ((72, 48, 45, 75), Fraction(-1, 9)),
    "000.p2.ex1 stage": ((88, -48, 4, -44), -5),
    "ferguson": ((100, 101, 100, 99), Fraction(1, 10_000)),
}


@pytest.mark.parametrize("name", SEEDS)
def test_planetary_stages_of_the_seeds(name: str) -> None:
    teeth, ratio = SEEDS[name]
    for satellites in (1, 3):
        mechanism = planetary(teeth, satellites)
        assert turns(mechanism, ("1",)).ratio("1", "H") == ratio
        found = mobility(mechanism)
        # W of the seeds: satellites in parallel count once
        assert (found.links, found.lower_pairs, found.higher_pairs) == (3, 3, 2)
        assert found.chebyshev == found.degrees == 1
        assert len(found.redundant) == satellites - 1


def test_compound_trains_of_the_practicum() -> None:
    """Counts and ratios of examples 1 to 3 of lesson 2; example 2 is 32 where 20 is printed."""
    row = (Revolute("6"), Revolute("7"), mesh("5", "6", 25, 17), mesh("6", "7", 17, -100))
    first = Mechanism((*planetary(SEEDS["000.p2.ex1 stage"][0]).joints, Fixed("5", on="H"), *row), ("3",))
    second = (Revolute("0"), mesh("0", "1", 13, 52))
    third = (Revolute("0"), mesh("0", "1", 25, -100))
    cases = (
        (first, "1", "7", 20, (5, 5, 4)),
        (Mechanism((*planetary((15, 33, 11, 45)).joints, *second), ("3",)), "0", "H", 32, (4, 4, 3)),
        (Mechanism((*planetary((20, 30, 30, -80)).joints, *third), ("3",)), "0", "H", 20, (4, 4, 3)),
    )
    for mechanism, one, two, ratio, counts in cases:
        found = mobility(mechanism)
        assert turns(mechanism, (one,)).ratio(one, two) == ratio
        assert (found.links, found.lower_pairs, found.higher_pairs, found.chebyshev, found.degrees) == (*counts, 1, 1)


def test_a_train_of_1e12_and_many_teeth() -> None:
    joints: list[Joint] = [Revolute("0")]
    for k in range(1, 13):
        joints += [Revolute(f"{k}"), mesh(f"{k - 1}", f"{k}", 1000, 10_000)]
    assert turns(Mechanism(tuple(joints)), ("12",)).ratio("0", "12") == 10**12
    chain = [mesh(f"{k}", f"{k + 1}", 17 + k, 18 + k) for k in range(1999)]
    assert mobility(Mechanism((*(Revolute(f"{k}") for k in range(2000)), *chain))).degrees == 1


def test_racks_worms_bevels() -> None:
    """Travel per turn is pi m z; a bevel differential halves what its two wheels add; a worm has starts."""
    rack = Mechanism(
        (
            Revolute("gear"),
            Prismatic("rack", direction=1j),
            Rolling("rack", "gear", "rack", (20, 1), module=Fraction(5, 2)),
        )
    )
    assert turns(rack, ("gear",)).of("rack") == {"gear": 50}
    assert turns(rack, ("rack",)).of("gear") == {"rack": Fraction(1, 50)}
    # a wheel on a slide rolls on a rack that stands
    rolls = Mechanism(
        (
            Prismatic("slide"),
            Revolute("wheel", on="slide"),
            Rolling("rack", "wheel", FRAME, (20, 1), on="slide", sense=-1),
        )
    )
    assert turns(rolls, ("wheel",)).of("slide") == {"wheel": 20}
    x = (1.0, 0.0, 0.0)
    bevels = (
        Rolling("bevel", "left", "spider", (30, 12), on="case"),
        Rolling("bevel", "right", "spider", (30, 12), "case", -1),
    )
    turning = tuple(Revolute(name, axis=x) for name in ("left", "right", "case"))
    axle = Mechanism((*turning, Revolute("spider", on="case", axis=(0.0, 1.0, 0.0)), *bevels))
    assert turns(axle, ("left", "right")).of("case") == {"left": Fraction(1, 2), "right": Fraction(1, 2)}
    assert mobility(axle).degrees == mobility(axle).chebyshev == 2
    worm = Mechanism((Revolute("worm", axis=x), Revolute("wheel"), Rolling("worm", "worm", "wheel", (2, 120))))
    assert turns(worm, ("worm",)).ratio("worm", "wheel") == 60


def test_parallel_satellites_count_once_in_chains_too() -> None:
    """Ravigneaux: pairs of satellites that mesh with each other; a satellite that meshes otherwise counts."""
    joints: list[Joint] = [Revolute("1"), Revolute("H"), Revolute("3")]
    for k in "abc":
        joints += [Revolute(f"p{k}", on="H"), Revolute(f"q{k}", on="H"), mesh(f"p{k}", f"q{k}", 20, 20, "H")]
        joints += [mesh("1", f"p{k}", 30, 20, "H"), mesh(f"q{k}", "3", 20, -90, "H")]
    found = mobility(Mechanism(tuple(joints), ("3",)))
    assert (found.links, found.higher_pairs, found.chebyshev, found.degrees) == (4, 3, 1, 1)
    other = mobility(Mechanism((*joints, Revolute("r", on="H"), mesh("1", "r", 30, 21, "H")), ("3",)))
    assert (other.links, other.higher_pairs, other.chebyshev, other.degrees) == (5, 4, 1, 1)


JAMES = planetary((40, 40, 40, -120), held=())


@pytest.mark.parametrize(
    ("held", "drives", "named", "by"),
    [
        (("3",), ("1", "H"), "H", ["3", "1"]),
        (("3", "1"), ("H",), "H", ["3", "1"]),
        ((), ("1", "H", "2"), "2", ["1", "H"]),
    ],
)
def test_what_contradicts_is_named(held: tuple[str, ...], drives: tuple[str, ...], named: str, by: list[str]) -> None:
    with pytest.raises(ParameterError) as refusal:
        turns(replace(JAMES, held=held), drives)
    assert (refusal.value.value, refusal.value.code, refusal.value.numbers["by"]) == (named, "contradicts", by)


def test_what_is_held_too_many_and_what_is_free() -> None:
    assert turns(JAMES, ("1",)).free == ("H", "3", "2")
    with pytest.raises(ParameterError, match="left_free"):
        turns(JAMES, ("1",)).of("H")
    still = mobility(replace(JAMES, held=("3", "1", "H")))
    assert (still.degrees, [(r.source, len(r.follows_from)) for r in still.redundant]) == (0, [("H", 4)])


def refused(*joints: Joint, held: tuple[str, ...] = (), drives: tuple[str, ...] = ()) -> tuple[str, str]:
    with pytest.raises(ParameterError) as refusal:
        turns(Mechanism(joints, held), drives)
    return refusal.value.name, refusal.value.code


def test_what_cannot_be_a_mechanism() -> None:
    a, b, carrier = Revolute("a"), Revolute("b"), Revolute("H")
    law = Group(("f",), ("a",), lambda given: given, (1, 1))
    for joints, told in (
        ((a, mesh("a", "a", 20, 20)), ("joints[2].second", "rolls_on_itself")),
        ((a, Fixed("b", on="a"), mesh("a", "b", 20, 20)), ("joints[3].second", "rolls_on_itself")),
        (
            (a, carrier, Revolute("G"), Revolute("b", on="H"), Revolute("b", on="G")),
            ("joints[5].link", "stands_on_two"),
        ),
        ((a, b, carrier, mesh("a", "b", 20, 20, "H")), ("joints[4].on", "carries_nothing")),
        ((a, carrier, Revolute("b", on="H"), mesh("a", "b", 20, 20)), ("joints[4].second", "axis_not_on_carrier")),
        (
            (a, Revolute("H", at=3j), Revolute("b", on="H"), mesh("a", "b", 20, 20, "H")),
            ("joints[4].first", "axis_not_on_carrier"),
        ),
        ((Revolute("a", on="b"), Revolute("b", on="a")), ("joints[2].on", "stands_on_itself")),
        ((Revolute("a", on="x"),), ("joints[1].on", "stands_on_nothing")),
        ((a, mesh("a", "x", 20, 20)), ("joints[2].second", "no_such_link")),
        ((a, b, mesh("a", "b", 0, 20)), ("joints[3].teeth", "not_of_teeth")),
    ):
        assert refused(*joints) == told
    assert refused(a, held=("x",)) == ("held", "no_such_link")
    assert refused(a, drives=("x",)) == ("drives", "no_such_link")
    assert refused(a, law, drives=("f",)) == ("drives", "moves_by_law")
    with pytest.raises(ParameterError, match="stands_still"):
        turns(Mechanism((a, b), ("b",)), ("a",)).ratio("a", "b")


def test_equations_are_those_of_willis() -> None:
    """What statics builds on: whole coefficients that sum to 0 with the carrier's, held links after the meshes."""
    found = equations(replace(JAMES, held=("3",)))
    assert [row.terms for row in found] == [{"1": -1, "H": 2, "2": -1}, {"2": 1, "H": 2, "3": -3}, {"3": 1}]

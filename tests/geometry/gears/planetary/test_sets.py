"""Planetary sets against brute force: every tooth number tried, every place of a satellite turned to by its phases."""

from __future__ import annotations

import itertools
import math
import random
import re
from fractions import Fraction

import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.planetary.assembly import Satellites, given_set
from geometry.gears.planetary.sets import (
    LINKS,
    SCHEMES,
    PlanetarySet,
    Search,
    carried_of,
    found_sets,
    nearest_ratio,
    ratio_of,
)
from tests.sampling import some_of


def phases(one: PlanetarySet, place: Fraction) -> tuple[Fraction, Fraction]:
    """Where teeth of rims 2 and 2' stand (parts of a turn, any of them) that fit the central wheels at a place.

    Wheels 1 and 3 have tooth 1, or space 1 of a ring, at 0. A rim's tooth meets a space: counted in teeth, external
    wheels run against each other and are half a tooth apart; a ring's spaces and the rim's teeth run together.
    """
    found = []
    for internal, central, rim in zip(one.scheme.internal, one.teeth[::3], one.teeth[1:3], strict=True):
        if internal:
            found.append(place - Fraction(central) * place / rim)
        else:
            found.append(place + Fraction(1, 2) + (central * place - Fraction(1, 2)) / rim)
    return found[0], found[1]


def fits_like_the_first(one: PlanetarySet, place: Fraction) -> bool:
    """Whether the satellite of place 0 fits at another one, in any of its turns."""
    rims = one.teeth[1:3]
    first, here = phases(one, Fraction(0)), phases(one, place)
    turn = here[0] - first[0]
    turns = (turn + Fraction(k, rims[0]) for k in range(rims[0]))
    return any((here[1] - first[1] - t) * rims[1] % 1 == 0 for t in turns)


def some_sets(count: int) -> list[PlanetarySet]:
    random.seed(13)
    found = []
    while len(found) < count:
        scheme = SCHEMES[random.choice(list(SCHEMES))]
        z1, z2, z2p, z3 = (random.randint(5, 24) for _ in range(4))
        one = PlanetarySet(scheme, (z1, z2, z2p if scheme.double else z2, z3))
        if min(one.spans) > 0 and one.places:
            found.append(one)
    return found


def test_places_are_those_a_satellite_is_turned_to() -> None:
    for one in some_of(some_sets(20), 4):
        z1, z2, z2p, z3 = one.teeth
        # all places are whole parts of the rims' common multiple
        every = abs(z1 * z2p + (-1 if one.scheme.alike else 1) * z2 * z3)
        fitting = [k for k in range(every) if fits_like_the_first(one, Fraction(k, every))]
        assert fitting == list(range(0, every, every // one.places)), one


def test_clocking_is_the_difference_of_the_phases() -> None:
    for one, n in zip(some_sets(100), itertools.cycle((2, 3, 4, 5)), strict=False):
        unit = Fraction(1, math.lcm(*one.teeth[1:3]))
        start = phases(one, Fraction(0))
        for k, clocking in enumerate(one.clocking(n)):
            here = phases(one, Fraction(k, n))
            assert (here[1] - start[1] - (here[0] - start[0]) - clocking) % unit == 0
            assert abs(clocking) <= unit / 2
        assert any(one.clocking(n)) == bool(one.places % n)


@pytest.mark.parametrize(("teeth", "satellites"), [((5, 3, 11), 3), ((5, 4, 13), 4), ((6, 4, 14), 3)])
def test_sets_of_few_teeth_are_offered_teeth_that_exist(teeth: tuple[int, int, int], satellites: int) -> None:
    """Coaxial, assembled, of 3 teeth and more; none of another ratio that is nearer."""
    one = given_set(SCHEMES["james"], teeth, (Fraction(2), Fraction(2)))
    with pytest.raises(ParameterError) as refusal:
        Satellites(satellites).places(one)
    near = [range(max(3, z - 4), z + 5) for z in teeth[:2]]
    fits = {(a, b, a + 2 * b): abs(1 + Fraction(a + 2 * b, a) - 1 - Fraction(teeth[2], teeth[0]))
            for a in near[0] for b in near[1] if 2 * (a + b) % satellites == 0
            and 2 * math.sin(math.pi / satellites) * (a + b) > 2 * b + 4}  # fmt: skip
    offered = tuple(map(int, str(refusal.value.numbers["teeth"]).split("/")))
    assert fits[offered] == min(fits.values())


def test_double_satellites_are_offered_teeth_on_one_distance() -> None:
    """Both meshes as far from the axis; seven satellites, the second mesh a whole number of teeth on at each."""
    one = given_set(SCHEMES["david"], (50, 30, 20, 60), (Fraction(2), Fraction(2)))
    with pytest.raises(ParameterError) as refusal:
        Satellites(7).places(one)
    z1, z2, z2p, z3 = map(int, re.findall(r"\d+", str(refusal.value.numbers["teeth"])))
    assert z1 + z2 == z2p + z3
    assert abs(z1 * z2p - z2 * z3) // math.gcd(z2, z2p) % 7 == 0


def test_published_places() -> None:
    """Probes of the research: david 80, figure 4 a of seed 001 120, ferguson 1."""
    for teeth, places in (((50, 30, 20, 60), 80), ((72, 48, 45, 75), 120), ((100, 101, 100, 99), 1)):
        assert PlanetarySet(SCHEMES["david"], teeth).places == places
    assert len(set(PlanetarySet(SCHEMES["david"], (100, 101, 100, 99)).clocking(3))) == 3


def test_unequal_spacing_is_the_least_unequal() -> None:
    for places, n in ((160, 3), (53, 3), (53, 5), (17, 6), (12, 4)):
        one = PlanetarySet(SCHEMES["james"], (places // 4, 5, 5, places - places // 4))
        spacing = one.spacing(n)
        assert spacing is not None
        gaps = [(b - a) % 1 * places for a, b in itertools.pairwise((*spacing, Fraction(1)))]
        assert sum(gaps) == places
        assert {int(g) for g in gaps} <= {places // n, -(-places // n)}
    assert PlanetarySet(SCHEMES["david"], (100, 101, 100, 99)).spacing(2) is None


@pytest.mark.parametrize("driver", LINKS)
@pytest.mark.parametrize("driven", LINKS)
def test_ratio_is_willis(driver: str, driven: str) -> None:
    if driver == driven:
        return
    for p in (Fraction(-3), Fraction(9, 5), Fraction(-7, 11)):
        held = next(link for link in LINKS if link not in (driver, driven))
        # w1 - wH = p (w3 - wH): any two speeds give the third; here the held one is 0, the driven one 1
        speeds = {held: Fraction(0), driven: Fraction(1)}
        w1, w3, wh = (speeds.get(link) for link in ("first", "second", "carrier"))
        if w1 is None:
            expected = wh + p * (w3 - wh)
        elif w3 is None:
            expected = wh + (w1 - wh) / p
        else:
            expected = (w1 - p * w3) / (1 - p)
        assert ratio_of(p, driver, driven) == expected  # type: ignore[arg-type]
        assert carried_of(expected, driver, driven) == p  # type: ignore[arg-type]


def brute(wish: Search) -> set[tuple[int, ...]]:
    """Every set of teeth within the limits, one by one."""
    least, most = wish.teeth
    n, scheme, numbers = wish.satellites, wish.scheme, range(least, most + 1)
    found = set()
    for z1, z2, z3 in itertools.product(numbers, repeat=3):
        for z2p in numbers if scheme.double else [z2]:
            one_span = z1 - z2 if scheme.internal[0] else z1 + z2
            two_span = z3 - z2p if scheme.internal[1] else z3 + z2p
            m1, m2 = wish.modules
            if min(one_span, two_span) <= 0 or abs(m1 * one_span - m2 * two_span) > wish.teeth_off * max(m1, m2):
                continue
            one = PlanetarySet(scheme, (z1, z2, z2p, z3), wish.modules)
            ratio = ratio_of(one.carried_ratio, wish.driver, wish.driven)
            if ratio is None or not wish.ratios[0] <= ratio <= wish.ratios[1]:
                continue
            reach = max(m * (z + 2) for m, z in zip(wish.modules, (z2, z2p), strict=True))
            near = n > 1 and reach > 2 * one.distances[0] * math.sin(math.pi / n) + Fraction(1, 10**9)
            if not near and (one.places % n == 0 or (scheme.double and not wish.identical)):
                found.add(one.teeth)
    return found


@pytest.mark.heavy
@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("scheme", "ratio", "driver", "driven"),
    [("james", "3.5", "first", "carrier"), ("james", "-2", "first", "second"), ("james", "1.4", "second", "carrier"),
     ("david", "-0.8", "first", "carrier"), ("david", "12", "carrier", "first"), ("david", "-4", "carrier", "second"),
     ("two_internal", "-0.4", "first", "carrier"), ("one_external_one_internal", "4", "first", "carrier")],
)  # fmt: skip
def test_synthesis_finds_what_brute_force_finds(scheme: str, ratio: str, driver: str, driven: str) -> None:
    middle = Fraction(ratio)
    room = abs(middle) / 12
    modules = (Fraction(2), Fraction("1.5")) if scheme == "david" else (Fraction(1), Fraction(1))
    double, counted = SCHEMES[scheme].double, 0
    limits = (8, 34) if not double else (8, 17) if scheme == "david" else (5, 17)
    for n, identical in ((3, True), (1, not double), (2, not double)):
        wish = Search(SCHEMES[scheme], (middle - room, middle + room), driver, driven, n,  # type: ignore[arg-type]
                      limits, 1, modules, identical=identical)  # fmt: skip
        found = found_sets(wish)
        assert {one.teeth for one in found} == brute(wish)
        assert len(found) == len({one.teeth for one in found})
        sizes = [one.diameter for one in found]
        assert sizes == sorted(sizes)
        # the bound included
        for size in sizes[:: max(len(sizes) // 3, 1)]:
            small = found_sets(replace(wish, diameter=size))
            assert [one.teeth for one in small] == [one.teeth for one in found if one.diameter <= size]
        counted += len(found)
    assert counted


def test_sets_that_are_too_large_by_far_are_not_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    """Their number of all ratios made a refusal take 4 s."""
    wish = Search(SCHEMES["two_internal"], (Fraction(1, 40), Fraction(5)), diameter=Fraction(20))
    monkeypatch.setattr("geometry.gears.planetary.sets.PlanetarySet", None)
    assert nearest_ratio(wish) is None


@pytest.mark.parametrize(("least", "count"), [(8, 59), (10, 57), (11, 55), (12, 52), (17, 37)])
def test_james_near_two_and_a_half(least: int, count: int) -> None:
    """Counts of the research, by another hand; two sets lie exactly on the bound 2.5125."""
    bounds = Fraction("2.5") * Fraction(199, 200), Fraction("2.5") * Fraction(201, 200)
    found = found_sets(Search(SCHEMES["james"], bounds, teeth=(least, 150)))
    assert len(found) == count
    on_bound = {one.teeth[::3] + one.teeth[1:2] for one in found if 1 - one.carried_ratio == bounds[1]}
    assert {(80, 121, 20), (80, 121, 21)} & on_bound == on_bound
    assert len(on_bound) == 2


def test_james_near_twelve() -> None:
    bounds = Fraction(12) * Fraction(199, 200), Fraction(12) * Fraction(201, 200)
    found = found_sets(Search(SCHEMES["james"], bounds))
    assert [one.teeth for one in found] == [(11, 55, 55, 121), (12, 60, 60, 132), (13, 65, 65, 143)]


def test_touching_neighbours_are_within_the_bound() -> None:
    """Six satellites: z2 + 2 = (z1 + z2) / 2 exactly, sin(pi/6) being 1/2."""
    one = PlanetarySet(SCHEMES["james"], (24, 20, 20, 64))
    assert one.fits(Fraction(1, 6))
    assert not one.fits(Fraction(1, 6), Fraction(1, 10**12))
    assert one.most_satellites() == 6
    assert PlanetarySet(SCHEMES["james"], (40, 40, 40, 120)).most_satellites() == 5


def test_whole_numbers_stay_exact_where_the_ratio_has_many_digits() -> None:
    ratio = Fraction("2.500000000000000001")
    found = found_sets(Search(SCHEMES["james"], (Fraction("2.5"), ratio)))
    assert found
    assert all(1 - one.carried_ratio == Fraction("2.5") for one in found)
    assert found_sets(Search(SCHEMES["james"], (ratio, ratio))) == []


@pytest.mark.parametrize("name", SCHEMES)
def test_the_nearest_ratio_is_that_of_the_nearest_of_all_sets(name: str) -> None:
    """In many orders of the links; before, every set of a range was made for it: 17 s of CPU for u = 5 of David's."""
    told = 0
    for driver, driven in itertools.permutations(LINKS, 2):
        for ratio in (Fraction(5), Fraction(-7, 3), Fraction(9, 10)):
            room = abs(ratio) / 2
            wish = Search(SCHEMES[name], (ratio - room, ratio + room), driver, driven, 2, (6, 20))
            ratios = [ratio_of(one.carried_ratio, driver, driven) for one in found_sets(wish)]
            off = min((abs(r - ratio) for r in ratios if r is not None), default=None)
            found = nearest_ratio(wish)
            assert (None if found is None else abs(found - ratio)) == off
            told += found is not None
    assert told >= 3


def test_the_nearest_ratio_is_found_by_few_sets(monkeypatch: pytest.MonkeyPatch) -> None:
    """The nearest candidates first, until one keeps the wish: 440 511 were made."""
    made = []
    fits = PlanetarySet.fits
    monkeypatch.setattr(PlanetarySet, "fits", lambda one, *given: made.append(one) or fits(one, *given))
    assert nearest_ratio(Search(SCHEMES["david"], (Fraction(1, 20), Fraction(199, 20)))) is not None
    assert len(made) < 100

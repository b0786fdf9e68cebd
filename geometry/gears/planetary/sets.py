"""Planetary sets by their numbers of teeth, exactly: ratio, coaxiality, assembly, neighbours, clocking, and synthesis.

Wheels 1 and 3 are central, 2 and 2' the rims of a satellite (one and the same where it has only one), H is the carrier:
the four schemes of figure 2.1 of the practicum. Fractions and integers throughout, but for sin(pi / n), which is
irrational unless n is 1, 2 or 6: no bound is met exactly there.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from fractions import Fraction
from functools import cached_property
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from geometry.base.both import both
from geometry.base.record import Record
from geometry.gears.teeth.module_rows import MODULES

Link = Literal["first", "second", "carrier"]
LINKS: tuple[Link, ...] = ("first", "second", "carrier")
# the coefficients of w1, w3, wH in Willis's w1 - wH = p (w3 - wH), each a + b p
_WILLIS: dict[Link, tuple[int, int]] = {"first": (1, 0), "second": (0, -1), "carrier": (-1, 1)}
_SINES = {2: Fraction(1), 6: Fraction(1, 2)}
_MODULES = tuple(m for m in map(Fraction, MODULES) if 1 <= m <= 10)
# heights of tips and of a ring's root over the reference circle, modules, where sizes and neighbours are told by teeth
TIP, ROOT = 1, Fraction(5, 4)


class Scheme(NamedTuple):
    """Whether each mesh is internal, and whether a satellite has two rims."""

    internal: tuple[bool, bool]
    double: bool

    @property
    def alike(self) -> bool:
        """Both meshes external or both internal: wheel 1 and wheel 3 turn the same way where the carrier is held."""
        return self.internal[0] == self.internal[1]


SCHEMES = {
    "james": Scheme((False, True), double=False),
    "one_external_one_internal": Scheme((False, True), double=True),
    "two_internal": Scheme((True, True), double=True),
    "david": Scheme((False, False), double=True),
}


def ratio_of(carried: Fraction, driver: Link, driven: Link) -> Fraction | None:
    """w_driver / w_driven with the third link held; ``carried``: w1 / w3 with the carrier held. None: infinite.

    Willis, practicum (2.5): u_1H = 1 - u_13.
    """
    above, below = (a + b * carried for a, b in (_WILLIS[driven], _WILLIS[driver]))
    return -above / below if below else None


def carried_of(ratio: Fraction, driver: Link, driven: Link) -> Fraction | None:
    """The ratio w1 / w3 with the carrier held that gives a wanted ratio: ``ratio_of`` read backwards."""
    (a, b), (c, d) = _WILLIS[driven], _WILLIS[driver]
    below = b + ratio * d
    return -(a + ratio * c) / below if below else None


def coaxial_modules(first: int, second: int) -> list[tuple[Fraction, Fraction]]:
    """Pairs of standard modules in which meshes of these sums (or differences) of teeth have one distance."""
    return [(a, b) for a in _MODULES for b in _MODULES if a * first == b * second]


def sine_of(turn: Fraction) -> Fraction:
    """sin(pi t) of a part t of a turn, at most 1/2: half the chord; exactly where it is rational."""
    exact = _SINES.get(turn.denominator) if turn.numerator == 1 else None
    return exact if exact is not None else Fraction(math.sin(math.pi * turn))


class PlanetarySet(Record, dict=True):
    """Teeth z1, z2, z2', z3 of a scheme and the modules, mm, of the meshes 1-2 and 2'-3.

    ``cosine``: of the helix angle of all wheels; modules are then those of the normal section, as heights have them.
    """

    scheme: Scheme
    teeth: tuple[int, int, int, int]
    modules: tuple[Fraction, Fraction] = (Fraction(1), Fraction(1))
    cosine: Fraction = Fraction(1)

    @property
    def name(self) -> str:
        """Its teeth, as they are told: z1/z2/z3, or z1/z2-z2'/z3."""
        z1, z2, z2p, z3 = self.teeth
        return f"{z1}/{z2}-{z2p}/{z3}" if self.scheme.double else f"{z1}/{z2}/{z3}"

    @property
    def carried_ratio(self) -> Fraction:
        """w1 / w3 where the carrier is held: z2 z3 / (z1 z2'), negative where one mesh is external."""
        z1, z2, z2p, z3 = self.teeth
        return Fraction(z2 * z3, z1 * z2p) * (1 if self.scheme.alike else -1)

    @property
    def spans(self) -> tuple[int, int]:
        """Sums of the teeth of both meshes, or differences of internal ones: twice the distance in modules."""
        z1, z2, z2p, z3 = self.teeth
        one, two = self.scheme.internal
        return (z1 - z2 if one else z1 + z2), (z3 - z2p if two else z3 + z2p)

    @property
    def distances(self) -> tuple[Fraction, Fraction]:
        """Reference centre distances of both meshes, mm; a set without shifts is coaxial where they are equal."""
        return both(m * s / (2 * self.cosine) for m, s in zip(self.modules, self.spans, strict=True))

    @cached_property
    def places(self) -> int:
        """Places on the circle where one and the same satellite fits: (z1 z2' +- z2 z3) / gcd(z2, z2').

        + with one external and one internal mesh, - with two alike; z1 + z3 where the satellite has one rim; 0: any
        place does. While the carrier turns by t a satellite on wheel 1 turns by (1 +- z1 / z2) t and one on wheel 3 by
        (1 +- z3 / z2') t; both rims are where they were when the difference is a multiple of 2 pi / lcm(z2, z2').
        """
        z1, z2, z2p, z3 = self.teeth
        found = z1 * z2p + (-1 if self.scheme.alike else 1) * z2 * z3
        return abs(found) // math.gcd(z2, z2p)

    def spacing(self, satellites: int) -> tuple[Fraction, ...] | None:
        """Where equal satellites stand, parts of a turn: equally where that fits, else least unequally; None: nowhere.

        None too where fewer places than satellites exist.
        """
        places = self.places or satellites
        if places < satellites:
            return None
        # half up, not to even: equal gaps stay side by side
        return tuple(Fraction((2 * k * places + satellites) // (2 * satellites), places) for k in range(satellites))

    def clocking(self, satellites: int) -> tuple[Fraction, ...]:
        """By how much rim 2' of equally spaced satellites is turned against that of the first, rims 2 in line.

        Parts of a turn, counter-clockwise, reduced to the least that fits: all 0 where the satellites are alike.
        """
        z1, z2, z2p, z3 = self.teeth
        one, two = (-1 if internal else 1 for internal in self.scheme.internal)
        unit = Fraction(1, math.lcm(z2, z2p))
        found = []
        for k in range(satellites):
            turned = Fraction(k, satellites) * (two * Fraction(z3, z2p) - one * Fraction(z1, z2)) % unit
            found.append(turned - unit if turned > unit / 2 else turned)
        return tuple(found)

    @property
    def rim_reach(self) -> Fraction:
        """Tip diameter of the larger rim, mm, by its teeth."""
        return max(m * (z / self.cosine + 2 * TIP) for m, z in zip(self.modules, self.teeth[1:3], strict=True))

    def fits(self, apart: Fraction, gap: Fraction = Fraction(0)) -> bool:
        """Whether tips of satellites a part of a turn apart keep ``gap``, mm, the bound included."""
        return self.rim_reach + gap <= 2 * self.distances[0] * sine_of(apart)

    def most_satellites(self, gap: Fraction = Fraction(0)) -> int:
        """The most equally spaced satellites whose tips keep ``gap``, mm."""
        sine = (self.rim_reach + gap) / (2 * self.distances[0])
        if sine > 1:
            return 1
        most = round(math.pi / math.asin(float(sine)))
        return most if self.fits(Fraction(1, most), gap) else most - 1

    @property
    def diameter(self) -> Fraction:
        """What the set takes, mm, by its teeth: the rings' root circles, and the circle that satellites' tips reach."""
        reach = 2 * self.distances[0] + self.rim_reach
        wheels = zip(self.scheme.internal, self.modules, (self.teeth[0], self.teeth[3]), strict=True)
        return max(reach, *(m * (z / self.cosine + 2 * (ROOT if internal else TIP)) for internal, m, z in wheels))


class Search(Record):
    """What sets are sought: the ratio's range (bounds included), who drives whom, and the limits.

    ``teeth_off``: how many teeth coaxiality may be off, to be made up by shifts; ``gap`` between satellites' tips and
    ``diameter`` in mm; ``identical``: the rims of all satellites are clocked alike; ``cosine``: of the helix angle.
    """

    scheme: Scheme
    ratios: tuple[Fraction, Fraction]
    driver: Link = "first"
    driven: Link = "carrier"
    satellites: int = 3
    teeth: tuple[int, int] = (11, 150)
    teeth_off: int = 1
    modules: tuple[Fraction, Fraction] = (Fraction(1), Fraction(1))
    gap: Fraction = Fraction(0)
    diameter: Fraction | None = None
    identical: bool = True
    cosine: Fraction = Fraction(1)


def found_sets(wish: Search) -> list[PlanetarySet]:
    """Every set that keeps the wish, the smallest first, then the one nearest to the middle of the ratios."""
    middle = (wish.ratios[0] + wish.ratios[1]) / 2
    found = [(one.diameter, abs(ratio - middle), one) for ratio, one in _kept(wish, _candidates(wish))]
    return [one for _, _, one in sorted(found, key=lambda item: (item[0], item[1], item[2].teeth))]


def nearest_ratio(wish: Search) -> Fraction | None:
    """The ratio of the set that keeps the wish nearest to the middle of the ratios; None: no set does."""
    teeth = _candidates(wish)
    z1, z2, z2p, z3 = teeth.astype(float)
    carried = z2 * z3 / (z1 * z2p) * (1 if wish.scheme.alike else -1)
    above, below = (a + b * carried for a, b in (_WILLIS[wish.driven], _WILLIS[wish.driver]))
    with np.errstate(divide="ignore"):
        away = np.abs(-above / below - float(wish.ratios[0] + wish.ratios[1]) / 2)
    return next((ratio for ratio, _ in _kept(wish, teeth[:, np.argsort(away, kind="stable")])), None)


def _candidates(wish: Search) -> Numbers:
    """Teeth z1, z2, z2', z3 (4, n) of all sets that may keep the wish."""
    bounds = _carried_bounds(wish)
    if bounds is None:
        return np.zeros((4, 0), dtype=np.int64)
    return _assembled(wish, (_double if wish.scheme.double else _single)(wish, *bounds))


def _kept(wish: Search, teeth: Numbers) -> Iterator[tuple[Fraction, PlanetarySet]]:
    """Those that keep it, in their order, with their ratios."""
    for row in teeth.T:
        one = PlanetarySet(wish.scheme, tuple(row.tolist()), wish.modules, wish.cosine)
        ratio = ratio_of(one.carried_ratio, wish.driver, wish.driven)
        if ratio is None or not wish.ratios[0] <= ratio <= wish.ratios[1]:
            continue
        if wish.satellites > 1 and not one.fits(Fraction(1, wish.satellites), wish.gap):
            continue
        if wish.diameter is None or one.diameter <= wish.diameter:
            yield ratio, one


def _carried_bounds(wish: Search) -> tuple[Fraction, Fraction] | None:
    """Bounds of z2 z3 / (z1 z2') within which all sets lie; None: no set of the scheme turns that way."""
    least, most = wish.teeth
    widest = Fraction(most * most, least * least)
    ends = [carried_of(ratio, wish.driver, wish.driven) for ratio in wish.ratios]
    below = [_WILLIS[wish.driven][1] + ratio * _WILLIS[wish.driver][1] for ratio in wish.ratios]
    if ends[0] is None or ends[1] is None or below[0] * below[1] < 0:
        # the range holds a ratio that only an infinite one of the wheels gives
        return 1 / widest, widest
    sign = 1 if wish.scheme.alike else -1
    low, high = sorted((sign * ends[0], sign * ends[1]))
    low, high = max(low, 1 / widest), min(high, widest)
    return (low, high) if low <= high else None


# whole numbers of 64 bits, or of Python where products would pass them
Numbers = NDArray[Any]


def _spread(first: Numbers, last: Numbers) -> tuple[Numbers, Numbers]:
    """Every whole number from ``first`` to ``last`` of each row, with the number of its row."""
    counts = np.maximum(last - first + 1, 0)
    rows = np.repeat(np.arange(len(counts)), counts)
    starts = np.repeat(np.cumsum(counts) - counts, counts)
    return rows, first[rows] + np.arange(len(rows)) - starts


def _whole(low: Fraction, high: Fraction, most: int) -> type:
    """Whole numbers in which the products of the search stay exact."""
    largest = max(abs(n) for bound in (low, high) for n in bound.as_integer_ratio())
    return np.int64 if largest * (4 * most) ** 3 < 2**62 else object


def _single(wish: Search, low: Fraction, high: Fraction) -> Numbers:
    """z1, z2, z2, z3: z3 from the ratio, z2 from coaxiality."""
    least, most = wish.teeth
    z1: Numbers = np.arange(least, most + 1).astype(_whole(low, high, most))
    first = -(-z1 * low.numerator // low.denominator)
    last = np.minimum(z1 * high.numerator // high.denominator, most)
    rows, z3 = _spread(first.astype(np.int64), last.astype(np.int64))
    found = []
    for off in range(-wish.teeth_off, wish.teeth_off + 1):
        twice = z3 - rows - least - off
        kept = (twice % 2 == 0) & (twice >= 2 * least)
        z2 = twice[kept] // 2
        found.append(np.array([rows[kept] + least, z2, z2, z3[kept]]))
    return np.concatenate(found, axis=1)


def _double(wish: Search, low: Fraction, high: Fraction) -> Numbers:
    """z1, z2, z2', z3: for every z1, z2 and span of the other mesh, z2' from the ratio and z3 from the span.

    (z2 / z1) (B / z2' -+ 1) = the ratio with the carrier held, B the span of the mesh 2'-3.
    """
    least, most = wish.teeth
    (inside1, inside2), (m1, m2) = wish.scheme.internal, wish.modules
    kind = _whole(low, high, most)
    z1, z2 = (grid.ravel() for grid in np.meshgrid(*[np.arange(least, most + 1)] * 2, indexing="ij"))
    span = z1 - z2 if inside1 else z1 + z2
    z1, z2, span = (column[span > 0] for column in (z1, z2, span))
    # |m1 span - m2 B| <= off times the larger module
    scale = math.lcm(m1.denominator, m2.denominator)
    n1, n2 = int(m1 * scale), int(m2 * scale)
    off = wish.teeth_off * max(n1, n2)
    rows, other = _spread(-((off - n1 * span) // n2), (n1 * span + off) // n2)
    z1, z2 = z1[rows].astype(kind), z2[rows].astype(kind)
    sign = -1 if inside2 else 1

    def rim(bound: Fraction) -> tuple[Numbers, Numbers]:
        """Above and below of the z2' at which the ratio is ``bound``; more teeth make it less."""
        return other * z2 * bound.denominator, bound.numerator * z1 + sign * bound.denominator * z2

    above, below = rim(high)
    first = np.where(below > 0, -(-above // np.where(below > 0, below, 1)), most + 1)
    above, below = rim(low)
    last = np.where(below > 0, above // np.where(below > 0, below, 1), most)
    first, last = np.maximum(first, least).astype(np.int64), np.minimum(last, most).astype(np.int64)
    chosen, z2p = _spread(first, last)
    z3 = other[chosen] - sign * z2p
    kept = (z3 >= least) & (z3 <= most)
    return np.array([z1[chosen][kept], z2[chosen][kept], z2p[kept], z3[kept]], dtype=np.int64)


def _assembled(wish: Search, teeth: Numbers) -> Numbers:
    """The sets whose satellites fit equally spaced, by the assembly condition, roughly by neighbours and diameter."""
    z1, z2, z2p, z3 = teeth
    if wish.identical or not wish.scheme.double:
        places = np.abs(z1 * z2p + (-1 if wish.scheme.alike else 1) * z2 * z3) // np.gcd(z2, z2p)
        teeth = teeth[:, places % wish.satellites == 0]
        z1, z2, z2p, z3 = teeth
    m1, m2 = map(float, wish.modules)
    tip, root = (2 * height * float(wish.cosine) for height in (TIP, ROOT))
    rim = np.maximum(m1 * (z2 + tip), m2 * (z2p + tip))
    arm = m1 * (z1 - z2 if wish.scheme.internal[0] else z1 + z2)
    sine = math.sin(math.pi / wish.satellites) if wish.satellites > 1 else math.inf
    kept = rim + float(wish.gap * wish.cosine) <= arm * sine * (1 + 1e-9)
    if wish.diameter is not None:
        wheels = zip((m1, m2), (z1, z3), wish.scheme.internal, strict=True)
        ends = (m * (z + (root if inside else tip)) for m, z, inside in wheels)
        kept &= np.maximum.reduce([arm + rim, *ends]) <= float(wish.diameter * wish.cosine) * (1 + 1e-9)
    return teeth[:, kept]

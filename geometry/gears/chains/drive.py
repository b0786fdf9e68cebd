"""Two sprockets and a closed chain of rigid links: links, centre distance, phases, rollers, slack.

The pins of wrapped links stand on the pitch circles, those of a taut strand on a line: a closed chain that is taut is
the convex hull of two regular polygons, whose strands are whole numbers of links long. Textbooks put belts about
circles of circumference z p in its place. Frame: axis of the first sprocket at the origin, the second's on +x. A phase
is the polar angle of a seat (the middle of a gap). Unless said otherwise lengths are in pitches.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from functools import cached_property, lru_cache, partial
from typing import NamedTuple

import numpy as np

from geometry.base.findings import Finding
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex, Real
from geometry.gears.chains.sprocket import Sprocket, sprocket_side
from geometry.gears.mesh.search import PairContact, flanks_contact, gear_outline
from geometry.plane.distance import folded
from geometry.plane.loop import DriveLoop, Wheel, about_two

# rounds until a strand stands on both polygons
_MOST_ROUNDS = 64
# links by which a chain may be longer than the taut one, and a little more
_MOST_SLACK = 6
# least angle of wrap, deg, by all textbooks
LEAST_WRAP_DEG = 120.0
# first sprockets' phases over a pitch, at which rollers are held against teeth
_PHASES = 24
# mm of slack of a chain that an idler makes taut, and how often it is pressed on until then
_TAUT, _MOST_PRESSED = 1e-3, 16
# |gap| up to this part of the roller's radius is contact
_CONTACT = 1e-8
_MARGIN = 1e-9


class Strand(NamedTuple):
    """A strand where it is taut: seats at its ends, counted counter-clockwise, and its length."""

    first: int
    second: int
    length: float


class Play(NamedTuple):
    """Phase of the second sprocket in the middle of its play, half of that, rad; links from seat 0 to seat 0 above."""

    middle: float
    half: float
    whole: int


class ChainDrive(Record, dict=True):
    """Two sprockets of ``teeth`` a ``distance`` apart, and ``idlers`` in their frame, by their pitch circles.

    A smooth roller is as a sprocket, whose seats are where the links come to lie.
    """

    teeth: tuple[int, int]
    distance: float
    idlers: tuple[Wheel, ...] = ()

    @property
    def radii(self) -> tuple[float, float]:
        """Of both pitch circles."""
        one, two = (pitch_radius(z) for z in self.teeth)
        return one, two

    @property
    def steps(self) -> tuple[float, float]:
        """Angles from seat to seat, rad."""
        return 2 * math.pi / self.teeth[0], 2 * math.pi / self.teeth[1]

    @cached_property
    def loop(self) -> DriveLoop:
        """About the pitch circles."""
        return about_two(self.radii, self.distance, self.idlers)

    @cached_property
    def _turns(self) -> tuple[tuple[float, float], ...]:
        """Polar angles at which circles leave each wheel and come to it, rad, the wrap between both."""
        found = []
        for k, (wheel, wrap) in enumerate(zip(self.loop.wheels, self.loop.wraps, strict=True)):
            turned = -wrap if wheel.outside else wrap
            if k:
                arrives = cmath.phase(self.loop.strands[k - 1][1] - wheel.centre)
                found.append((arrives - turned, arrives))
            else:
                leaves = cmath.phase(self.loop.strands[0][0] - wheel.centre)
                found.append((leaves, leaves + turned))
        return tuple(found)

    @cached_property
    def _steps(self) -> tuple[float, ...]:
        """From seat to seat of each wheel of the loop, rad."""
        return tuple(2 * math.asin(0.5 / wheel.radius) for wheel in self.loop.wheels)

    def strand(self, wheel: int, first: float, second: float) -> Strand:
        """The strand behind a wheel, at phases of it and of the next one: the line that no seat lies beyond."""
        after = (wheel + 1) % len(self.loop.wheels)
        one, two, (s1, s2) = self.loop.wheels[wheel], self.loop.wheels[after], (self._steps[wheel], self._steps[after])
        leaves, arrives = self._turns[wheel][0], self._turns[after][1]
        sides, turn, ends = (one.side / one.radius, two.side / two.radius), 0.0, None
        own = self.loop.ways[wheel]
        for _ in range(_MOST_ROUNDS):
            found = round((leaves + turn - first) / s1), round((arrives + turn - second) / s2)
            if found == ends:
                break
            ends = found
            seats = cmath.rect(one.radius, first + ends[0] * s1), cmath.rect(two.radius, second + ends[1] * s2)
            way = two.centre + seats[1] - one.centre - seats[0]
            turn = cmath.phase(way / own)
        assert ends is not None
        return Strand(round(sides[0] * ends[0]), round(sides[1] * ends[1]), abs(way))

    def links(self, wheel: int, first: float, second: float) -> float:
        """Links from seat 0 of a wheel over the strand behind it to seat 0 of the next one, where that is taut."""
        strand = self.strand(wheel, first, second)
        return strand.second - strand.first + strand.length

    def side(self, strands: range, first: float, last: float) -> tuple[list[float], dict[int, int]]:
        """Of one side, between phases of both sprockets, the phases of its wheels but the last, and links of strands.

        All but the longest by the pitch circles are whole and taut; links are those from seat 0 to seat 0.
        """
        start, end = strands[0], strands[-1] + 1
        lengths = [abs(two - one) for one, two in (self.loop.strands[k] for k in strands)]
        slack = strands[lengths.index(max(lengths))]
        phases, counts = {start: first, end: last}, dict[int, int]()
        for k in range(start, slack):
            counts[k] = round(self.links(k, phases[k], 0.0))
            phases[k + 1] = _where(partial(self.links, k, phases[k]), counts[k], self._steps[k + 1])
        for k in range(end - 1, slack, -1):
            counts[k] = round(self.links(k, 0.0, phases[k + 1]))
            phases[k] = _where(partial(self.links, k, second=phases[k + 1]), counts[k], self._steps[k])
        return [phases[k] for k in strands], counts

    def _along(self, strands: range, first: float, last: float) -> float:
        """Links from seat 0 to seat 0 over one side, where that is taut."""
        phases, counts = self.side(strands, first, last)
        (slack,) = {*strands} - {*counts}
        ends = [*phases, last]
        k = slack - strands[0]
        return sum(counts.values()) + self.links(slack, ends[k], ends[k + 1])

    def above(self, first: float, second: float) -> float:
        """Links from seat 0 of the first over the upper side to seat 0 of the second, where that is taut."""
        return self._along(range(self.loop.second), first, second)

    def below(self, first: float, second: float) -> float:
        """Links from seat 0 of the second over the lower side to seat 0 of the first."""
        return self._along(range(self.loop.second, len(self.loop.wheels)), second, first)

    def play(self, first: float, links: int) -> Play:
        """The second's play at a phase of the first near pi."""
        # from where the upper side is taut to where the lower one is
        upper, whole = self.taut(first)
        lower = _where(partial(self.below, first), links - whole, _MOST_SLACK * self.steps[1])
        return Play((upper + lower) / 2, abs(lower - upper) / 2, whole)

    def taut(self, first: float) -> tuple[float, int]:
        """Phase of the second where the upper side is taut, rad, and the links of that."""
        whole = round(self.above(first, 0.0))
        return _where(partial(self.above, first), whole, self.steps[1]), whole

    def longest(self) -> float:
        """The taut chain about idlers where it is longest, of so many phases over a pitch of the first."""
        found = []
        for share in range(_PHASES):
            first = math.pi + (share / _PHASES - 0.5) * self.steps[0]
            second, whole = self.taut(first)
            found.append(whole + self.below(first, second))
        return max(found)

    def pins(self, first: float, second: float, whole: int, links: int) -> Complex:
        """Pins (links,), clockwise; ``whole`` links from seat 0 to seat 0 over the upper side.

        Strands that are slack hang in arcs outwards.
        """
        sides = range(self.loop.second), range(self.loop.second, len(self.loop.wheels))
        phases, counts = list[float](), dict[int, int]()
        for side, ends, many in zip(sides, ((first, second), (second, first)), (whole, links - whole), strict=True):
            found, taut = self.side(side, *ends)
            phases += found
            (slack,) = {*side} - {*taut}
            counts |= taut | {slack: many - sum(taut.values())}
        size = len(phases)
        strands = [self.strand(k, phase, phases[(k + 1) % size]) for k, phase in enumerate(phases)]
        seated, leaves = [], list[int]()
        for wheel, step, phase, before, after in zip(
            self.loop.wheels, self._steps, phases, [strands[-1], *strands], strands, strict=False
        ):
            # seats are counted counter-clockwise round what is inside, the other way round what is outside; an idler
            # that is hardly touched has one
            leaves.append(min(after.first, before.second))
            turns = np.arange(before.second, leaves[-1] - 1, -1) * (-step if wheel.outside else step)
            seated.append(wheel.centre + wheel.radius * np.exp(1j * (phase + turns)))
        rows = []
        for k, strand in enumerate(strands):
            hung = counts[k] + leaves[k] - strand.second
            rows += [seated[k], _hanging(seated[k][-1], seated[(k + 1) % size][0], hung)]
        return np.concatenate(rows)


def _where(links: Callable[[float], float], whole: int, most: float) -> float:
    """The turn, within so much, rad, at which a taut chain has so many links."""
    return bracketed_root(lambda turn: links(turn) - whole, -most, most).value


def pitch_radius(teeth: float) -> float:
    """Of a sprocket's pitch circle, in pitches."""
    return 0.5 / math.sin(math.pi / teeth)


def _hanging(start: complex, end: complex, count: int) -> Complex:
    """Pins between the ends of a strand of ``count`` links, on an arc to the left as long as they are."""
    chord = abs(end - start)
    if count <= chord * (1 + _MARGIN):
        return np.asarray(start + (end - start) * np.arange(1, count) / count)

    def longer(half: float) -> float:
        return math.sin(count * half) - chord * math.sin(half)

    # of a flat arc by the series of both sines
    flat = math.sqrt(6 * (count - chord) / count**3)
    half = bracketed_root(longer, flat / 2, math.pi / count).value
    ways = np.exp(1j * half * (count - 1 - 2 * np.arange(count)))
    places: Complex = start + (end - start) / chord * np.cumsum(ways)
    return places[:-1]


@lru_cache(maxsize=64)
def exact_distance(teeth: tuple[int, int], links: int, least: float) -> float | None:
    """The greatest distance at which a chain of ``links`` goes round at every phase; None: below ``least``, in pitches.

    A chain is tightest at one of the two stands in which it is alike on both sides of the line of centres: with a pin
    or a link on it at the first sprocket. There both its strands are taut.
    """
    found = [_symmetric(teeth, links, least, half) for half in (False, True)]
    return None if None in found else min(distance for distance in found if distance is not None)


def _symmetric(teeth: tuple[int, int], links: int, least: float, half: bool) -> float | None:
    """The distance of one such stand: ``half``: the first sprocket has a link on the line of centres."""
    first, second = symmetric_phases(teeth, links, half)
    # both sides are as long; a seat beside the line of centres belongs to one of them
    beside = half - (links % 2 != half)

    def longer(distance: float) -> float:
        return ChainDrive(teeth, distance).above(first, second) - (links + beside) / 2

    if longer(least) > 0:
        return None
    return bracketed_root(longer, least, least + links).value


def symmetric_phases(teeth: tuple[int, int], links: int, half: bool) -> tuple[float, float]:
    """Phases of both where the chain is symmetric, ``half``: the first with a link on the line of centres."""
    link = (links % 2 == 1) != half
    return math.pi + half * math.pi / teeth[0], link * math.pi / teeth[1]


def links_for(teeth: tuple[int, int], distance: float, least: float) -> int:
    """The least even number of links that go round at a distance."""
    links = 2 * math.floor(distance)
    while (found := exact_distance(teeth, links, least)) is None or found < distance * (1 - _MARGIN):
        links += 2
    return links


def textbook_links(teeth: tuple[int, int], distance: float) -> float:
    """L = 2 a / p + (z1 + z2) / 2 + ((z2 - z1) / 2 pi)^2 p / a."""
    square = ((teeth[1] - teeth[0]) / (2 * math.pi)) ** 2
    return 2 * distance + sum(teeth) / 2 + square / distance


def textbook_distance(teeth: tuple[int, int], links: float) -> float:
    """a = p / 4 (L - (z1 + z2) / 2 + sqrt((L - (z1 + z2) / 2)^2 - 8 ((z2 - z1) / 2 pi)^2))."""
    free = links - sum(teeth) / 2
    return (free + math.sqrt(free**2 - 8 * ((teeth[1] - teeth[0]) / (2 * math.pi)) ** 2)) / 4


class ChainMesh(Record):
    """Two sprockets and their chain, about ``idlers`` too, whose circles are in pitches.

    ``turn`` (rad) and ``shift`` (mm): how far the second is off its place.
    """

    sprockets: tuple[Sprocket, Sprocket]
    centre_distance: float
    links: int
    turn: float = 0.0
    shift: float = 0.0
    idlers: tuple[Wheel, ...] = ()

    @property
    def pitch(self) -> float:
        """Of the chain, mm."""
        return self.sprockets[0].chain.pitch

    @property
    def teeth(self) -> tuple[int, int]:
        """Of both."""
        return self.sprockets[0].number_of_teeth, self.sprockets[1].number_of_teeth

    @property
    def drive(self) -> ChainDrive:
        """The drive, in pitches."""
        return ChainDrive(self.teeth, (self.centre_distance + self.shift) / self.pitch, self.idlers)

    @property
    def least_distance(self) -> float:
        """Where the tips of both would touch, in pitches."""
        return sum(s.tip_radius for s in self.sprockets) / self.pitch

    @property
    def tip_gap(self) -> float:
        """Between the tips of both, mm."""
        return self.centre_distance + self.shift - self.least_distance * self.pitch

    @property
    def slack(self) -> float:
        """By how much the chain is longer than the taut one, at the phase where that is longest, mm."""
        if self.idlers:
            return (self.links - self.drive.longest()) * self.pitch
        lengths = []
        for half in (False, True):
            first, second = symmetric_phases(self.teeth, self.links, half)
            lengths.append(self.drive.above(first, second) + self.drive.below(first, second))
        return (self.links - max(lengths)) * self.pitch

    @property
    def taut_idler(self) -> complex | None:
        """Where the last idler makes the chain taut, straight on from where it stands, mm; None: nowhere."""
        mesh, last = self, self.idlers[-1]
        for _ in range(_MOST_PRESSED):
            loop, slack = mesh.drive.loop, mesh.slack
            if abs(slack) < _TAUT:
                break
            # what circles and polygons differ by changes little on the way
            wheel = loop.wheels.index(last)
            taut = loop.tightened(wheel, loop.length + slack / self.pitch)
            if taut is None:
                return None
            last = taut.wheels[wheel]
            mesh = replace(self, idlers=(*self.idlers[:-1], last))
        return last.centre * self.pitch

    def rollers(self, first: float) -> tuple[float, Complex]:
        """Phase of the second, rad, and centres of the rollers, mm, at a phase of the first near pi."""
        play = self.drive.play(first, self.links)
        second = play.middle + self.turn
        return second, self.drive.pins(first, second, play.whole, self.links) * self.pitch

    def contact(self, tolerance: float | None = None) -> PairContact:
        """The gaps of all rollers to the teeth of the first and of the second at phases of one pitch."""
        radius = self.sprockets[0].chain.roller_diameter / 2
        outlines = [gear_outline(sprocket_side(sprocket)) for sprocket in self.sprockets]
        step, gaps = self.drive.steps[0], np.empty((2, _PHASES))
        phases: Real = math.pi + (np.arange(_PHASES) / _PHASES - 0.5) * step
        for k, first in enumerate(phases):
            second, rollers = self.rollers(first)
            for side, (seat, axis) in enumerate(((first, 0.0), (second, self.centre_distance + self.shift))):
                sprocket = self.sprockets[side]
                near = rollers[np.abs(rollers - axis) < sprocket.tip_radius + 2 * radius] - axis
                # seats stand half a pitch before tooth 1
                near = near * cmath.rect(1.0, -seat - sprocket.pitch_angle / 2)
                feet = outlines[side].feet(folded(near, near, sprocket.pitch_angle)[0])
                gaps[side, k] = feet.distance.min() - radius
        return flanks_contact(gaps, phases - math.pi, 0j, _CONTACT * radius if tolerance is None else tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """An odd number of links, little wrap, a chain that hangs loose."""
        found, wrap = [], math.degrees(min(self.drive.loop.both_wraps))
        if self.links % 2:
            found.append(Finding("odd_number_of_links", self.links, 0.0))
        if wrap < LEAST_WRAP_DEG:
            found.append(Finding("small_wrap", wrap, LEAST_WRAP_DEG))
        if self.slack > self.pitch:
            found.append(Finding("chain_hangs_loose", self.slack, self.pitch))
        return tuple(found)

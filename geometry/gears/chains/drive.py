"""Two sprockets and a closed chain of rigid links: links, centre distance, phases, rollers, slack.

The pins of wrapped links stand on the pitch circles, those of a taut strand on a line: a closed chain that is taut is
the convex hull of two regular polygons, whose strands are whole numbers of links long. Textbooks put belts about
circles of circumference z p in its place. Frame: axis of the first sprocket at the origin, the second's on +x. A phase
is the polar angle of a seat (the middle of a gap). Unless said otherwise lengths are in pitches.
"""

from __future__ import annotations

import cmath
import math
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex, Real
from geometry.gears.chains.sprocket import Sprocket, sprocket_side
from geometry.gears.mesh.search import PairContact, flanks_contact, gear_outline

# rounds until a strand stands on both polygons
_MOST_ROUNDS = 64
# links by which a chain may be longer than the taut one, and a little more
_MOST_SLACK = 6
# least angle of wrap, deg, by all textbooks
LEAST_WRAP_DEG = 120.0
# first sprockets' phases over a pitch, at which rollers are held against teeth
_PHASES = 24
# |gap| up to this part of the roller's radius is contact
_CONTACT = 1e-8
_MARGIN = 1e-9


class Strand(NamedTuple):
    """The upper strand where it is taut: seats at its ends, counted counter-clockwise, and its length."""

    first: int
    second: int
    length: float


class Play(NamedTuple):
    """Phase of the second sprocket in the middle of its play, half of that, rad; links from seat 0 to seat 0 above."""

    middle: float
    half: float
    whole: int


class ChainDrive(Record):
    """Two sprockets of ``teeth`` a ``distance`` apart."""

    teeth: tuple[int, int]
    distance: float

    @property
    def radii(self) -> tuple[float, float]:
        """Of both pitch circles."""
        one, two = (0.5 / math.sin(math.pi / z) for z in self.teeth)
        return one, two

    @property
    def steps(self) -> tuple[float, float]:
        """Angles from seat to seat, rad."""
        return 2 * math.pi / self.teeth[0], 2 * math.pi / self.teeth[1]

    @property
    def wrap(self) -> float:
        """Angle of wrap on the smaller sprocket, by the pitch circles, rad."""
        return math.pi - 2 * math.asin(abs(self.radii[1] - self.radii[0]) / self.distance)

    def upper(self, first: float, second: float) -> Strand:
        """The strand above both, at the phases of both: the line that no seat lies beyond."""
        (r1, r2), (s1, s2) = self.radii, self.steps
        normal = math.acos((r1 - r2) / self.distance)
        ends: tuple[int, int] | None = None
        for _ in range(_MOST_ROUNDS):
            found = round((normal - first) / s1), round((normal - second) / s2)
            if found == ends:
                break
            ends = found
            way = self.distance + cmath.rect(r2, second + ends[1] * s2) - cmath.rect(r1, first + ends[0] * s1)
            normal = cmath.phase(way) + math.pi / 2
        assert ends is not None
        return Strand(*ends, abs(way))

    def above(self, first: float, second: float) -> float:
        """Links from seat 0 of the first over the upper strand to seat 0 of the second, where that is taut."""
        strand = self.upper(first, second)
        return strand.second - strand.first + strand.length

    def below(self, first: float, second: float) -> float:
        """Links from seat 0 of the second over the lower strand to seat 0 of the first."""
        return self.above(2 * math.pi - first, -second)

    def play(self, first: float, links: int) -> Play:
        """The second's play at a phase of the first near pi."""
        step = self.steps[1]
        whole = round(self.above(first, 0.0))
        # from where the upper strand is taut to where the lower one is
        upper = bracketed_root(lambda turn: self.above(first, turn) - whole, -step, step).value
        lower = bracketed_root(
            lambda turn: self.below(first, turn) - links + whole, -_MOST_SLACK * step, _MOST_SLACK * step
        ).value
        return Play((upper + lower) / 2, abs(lower - upper) / 2, whole)

    def pins(self, first: float, second: float, whole: int, links: int) -> Complex:
        """Pins (links,), clockwise; ``whole`` links from seat 0 to seat 0 over the upper strand.

        Strands that are slack hang in arcs outwards.
        """
        strands = [self.upper(first, second), self.upper(2 * math.pi - first, -second)]
        counts = [whole + strands[0].first - strands[0].second, links - whole + strands[1].first - strands[1].second]
        (r1, r2), (s1, s2) = self.radii, self.steps
        upper, lower = strands
        # seats by their numbers, which the lower strand counts the other way round
        on_second = np.arange(upper.second, -lower.second - 1, -1)
        on_first = np.arange(-lower.first, upper.first - 1, -1)
        wrapped_2 = self.distance + r2 * np.exp(1j * (second + s2 * on_second))
        wrapped_1 = r1 * np.exp(1j * (first + s1 * on_first))
        there = _hanging(wrapped_1[-1], wrapped_2[0], counts[0])
        back = _hanging(wrapped_2[-1], wrapped_1[0], counts[1])
        return np.concatenate((wrapped_1, there, wrapped_2, back))


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
    """Two sprockets and their chain; ``turn`` (rad) and ``shift`` (mm): how far the second is off its place."""

    sprockets: tuple[Sprocket, Sprocket]
    centre_distance: float
    links: int
    turn: float = 0.0
    shift: float = 0.0

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
        return ChainDrive(self.teeth, (self.centre_distance + self.shift) / self.pitch)

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
        lengths = []
        for half in (False, True):
            first, second = symmetric_phases(self.teeth, self.links, half)
            lengths.append(self.drive.above(first, second) + self.drive.below(first, second))
        return (self.links - max(lengths)) * self.pitch

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
                near = near * np.exp(-1j * sprocket.pitch_angle * np.round(np.angle(near) / sprocket.pitch_angle))
                feet = outlines[side].feet(np.where(near.imag > 0, np.conj(near), near))
                gaps[side, k] = feet.distance.min() - radius
        return flanks_contact(gaps, phases - math.pi, 0j, _CONTACT * radius if tolerance is None else tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """An odd number of links, little wrap, a chain that hangs loose."""
        found, wrap = [], math.degrees(self.drive.wrap)
        if self.links % 2:
            found.append(Finding("odd_number_of_links", self.links, 0.0))
        if wrap < LEAST_WRAP_DEG:
            found.append(Finding("small_wrap", wrap, LEAST_WRAP_DEG))
        if self.slack > self.pitch:
            found.append(Finding("chain_hangs_loose", self.slack, self.pitch))
        return tuple(found)

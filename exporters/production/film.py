"""What drives move, as a film: its loop, and how every instance goes; its files stand in motion and motion_solids."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any, ClassVar, TypeVar

import numpy as np

from exporters.production.jobs import FileJob, Made
from exporters.production.request import Request
from geometry.base.errors import Nearest
from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.curves.curve import Real
from parts.base.part import Part
from parts.base.texts import N_, unless
from parts.scene.placing import PlacedMate
from parts.scene.relative_path import Course, common_period, course_of
from parts.scene.scene_file import ExportSpec
from parts.scene.shapes import shape_of
from parts.scene.standing import Instance

T = TypeVar("T")
# seconds for a turn of the first drive, and for a loop at least and at most
_SECONDS, _LEAST, _MOST = 4.0, 4.0, 60.0
# turns of the fastest in a loop at most, and in the only run of what slides or turns unevenly: no eye follows more
_MOST_TURNS, _MOST_ONCE = 20, 100
# values of a way at first, and for a turn of the fastest: of an even way with fewer, each next turn could be taken for
# one backwards; values at most; of the tolerance what outlines and ways may take; of that what ways are brought to,
# as numbers of a file are rounded; of a loop what is halved no more; of the values as many as let all be halved
_VALUES, _A_TURN, MOST_VALUES, SHARE, _NEAR, _MOMENT, _MANY = 60, 4, 16_000, 0.5, 0.9, 1e-7, 0.2
# times at which a file is held against exact poses
TIMES = np.concatenate([[0.0, 1.0], np.arange(1, 48) * (math.sqrt(5) - 1) / 2 % 1.0])


class Film(Record, FileJob):
    """What drives move, in one file; ``loop``: how much of their run it shows (1: all), and whether it closes."""

    export: ExportSpec
    title: str
    parts: dict[str, Part]
    instances: tuple[Instance, ...]
    course: Course
    loop: Fraction
    closes: bool
    turns: float
    path: str
    place: str
    mates: tuple[PlacedMate, ...] = ()
    # of the file: what stands for a name that is not given, and the rest
    ending: ClassVar[tuple[str, str]]

    @classmethod
    def shows(cls, instance: Instance, course: Course, times: Real) -> bool:
        """Whether such a film can show how an instance goes."""
        return True

    @property
    def seconds(self) -> float:
        """How long a loop takes."""
        return min(max(_SECONDS * abs(self.turns), _LEAST), _MOST)

    @property
    def told(self) -> dict[str, Any]:
        """What is in it: the turns (or the mm) of the first drive in one loop, and whether it ends as it begins."""
        names = [instance.id for instance in self.instances]
        return {"part": None, "instances": names, "drive": self.turns, "closes": self.closes, "seconds": self.seconds}

    def findings(self, made: Made) -> tuple[Finding, ...]:
        """Whether it shows less than the drives do."""
        if self.loop >= 1 or self.closes:
            return ()
        return (Finding("film_cut_short", 100 * float(self.loop), 100.0),)

    def ways(self, instance: Instance, reach: float) -> tuple[Real, Any, Any, float]:
        """Shares of the loop, places and angles there, and how far what is straight between them is off, mm."""

        def at(shares: Real) -> tuple[tuple[Any, Any], Real]:
            places, angles = self.poses(instance, shares)
            ways = [x[1::2] - (x[:-1:2] + x[2::2]) / 2 for x in (places, angles)]
            return (places[::2], angles[::2]), np.abs(ways[0]) + reach * np.abs(ways[1])

        shares, (places, angles), off = self.near_enough(at, MOST_VALUES)
        return shares, places, angles, off

    @property
    def _least(self) -> int:
        """Values of a way at first."""
        fastest = max((abs(rate) for i in self.instances for rate in self.course.rates.get(i.id, ())), default=0)
        return max(_VALUES, math.ceil(_A_TURN * fastest * self.loop))

    def near_enough(self, at: Callable[[Real], tuple[T, Real]], most: int) -> tuple[Real, T, float]:
        """Shares of the loop at which what is found is as near as asked, that, and how far it is off, mm.

        ``at``: what is found at every other one of some shares, and how far it is off at those between, where an even
        way is off the most; ``most``: values, where they are even. What is too far off is halved.
        """
        shares = np.linspace(0, 1, 2 * self._least + 1)
        while True:
            found, off = at(shares)
            coarse = (off > _NEAR * SHARE * self.tolerance / 2) & (np.diff(shares[::2]) > _MOMENT)
            if not coarse.any() or len(shares) > 2 * most:
                return shares[::2], found, 2 * float(off.max())
            # where many are, all are: even values need no times
            halved = np.repeat(coarse | (coarse.mean() > _MANY), 2)
            shares = np.sort(np.concatenate([shares, (shares[:-1][halved] + shares[1:][halved]) / 2]))

    def poses(self, instance: Instance, shares: Real) -> tuple[Any, Any]:
        """Exact places and angles of an instance at shares of the loop."""
        times = shares * float(self.loop)
        if instance.id not in self.course.rates:
            return np.full(len(times), instance.centre), np.full(len(times), instance.rotation)
        # angles are told within a turn
        order = np.argsort(times)
        places, angles = self.course.pose(instance.id, times)
        unwrapped = np.empty_like(angles)
        unwrapped[order] = np.unwrap(angles[order])
        return places, unwrapped

    def late(self, seconds: float) -> list[str]:
        """What is wrong with a file that takes so many seconds for a loop."""
        told = N_("a loop takes {seconds:g} s instead of {wanted:g} s")
        right = not seconds or math.isclose(seconds, self.seconds, rel_tol=1e-6)
        return unless(right, told, seconds=seconds, wanted=self.seconds)

    def off_place(self, worst: float, shape: float, declared: float) -> list[str]:
        """What is wrong with a file whose instances are so far off their places, and its shapes off theirs, mm."""
        text = N_("an instance is {worst:.3g} mm off its place; {declared:.3g} mm is declared")
        return unless(worst + shape <= declared, text, worst=worst, declared=declared)

    def frames(self, instance: Instance, shares: Real) -> tuple[Real, Real]:
        """Exact turns (n, 3, 3) and places (n, 3), mm, of an instance's frame at shares of the loop."""
        return self.course.placed(instance.id, shares * float(self.loop), own=True)


def film(made: type[Film], asked: Request) -> Film:
    """The film of one export.

    Raises
    ------
    SceneError
        Nothing is driven.
    """
    export, train = asked.export, asked.placing.train
    if train is None:
        raise asked.refused("format", export.format, "shows_what_moves")
    instances = tuple(i for i in asked.placing.instances if export.parts is None or i.part in export.parts)
    used = {name: asked.parts[name] for name in dict.fromkeys(i.part for i in instances)}
    course = course_of(train, [i.id for i in instances])
    loop, closes = _loop(course, instances, used)
    for instance in instances:
        if not made.shows(instance, course, TIMES * float(loop)):
            raise asked.refused("format", export.format, "shows_from_above", Nearest("glb"), lying=instance.id)
    drive = asked.scene.drives[0]
    turns = float(loop) * (drive.turns if drive.travel is None else drive.travel)
    unnamed, ending = made.ending
    path = asked.scene.name + (f".{export.name}" if export.name else unnamed) + ending
    mates = tuple(mate for mate in asked.placing.mates if {mate.first.part, mate.second.part} <= used.keys())
    return made(export, asked.title, used, instances, course, loop, closes, turns, path, asked.where, mates)


def _loop(course: Course, instances: Sequence[Instance], parts: dict[str, Part]) -> tuple[Fraction, bool]:
    """The share of the drives' run after which the picture is as it was; no more than a viewer will watch."""
    rates, fastest = set(), Fraction(0)
    for instance in instances:
        chain = course.rates.get(instance.id, ())
        shape = shape_of(parts[instance.part])
        fastest = max([fastest, *map(abs, chain)])
        # what is round, or looks alike in parts of a turn, about the axis on which it turns, comes again the sooner
        alike = shape.count(0.0, shape.reach) if instance.id in course.spins else 1
        rates |= {*chain[1:], *(rate * alike for rate in chain[:1])}
    if course.once & {i.id for i in instances}:
        return min(Fraction(1), _MOST_ONCE / fastest), False
    period = common_period(rates)
    most = _MOST_TURNS / fastest if fastest else period
    return (period, True) if period <= most else (most, False)

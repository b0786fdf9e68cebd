"""Who runs into whom on the way: solids held against each other over the whole period of their relative motion.

A pair is seen from its first one. Its path is a curve whose length bounds how far any point of the second moves; from
a pose with a gap the pair is clear as long as the path is shorter than the gap, so that most of it is passed over.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence, Set
from functools import cache
from heapq import heapify, heappop, heappush
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.base.errors import GeometryError
from geometry.base.record import Draft, Record, field, replace
from geometry.curves.curve import Real
from parts.scene.half_sections import Sections
from parts.scene.interference import SLIVER, by_contact, common_volume, inset_of, placed_solid
from parts.scene.placing import Placing
from parts.scene.relative_path import Course, Path, path_of, stays_free
from parts.scene.shapes import Shape, SweptShape, free_between
from parts.scene.space_path import SpacePath, coaxial, lift_between, space_path
from parts.scene.standing import UPWARDS, Instance

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# poses of one pair at most; of one whose teeth the plane contact has decided; more in the search about the worst
MOST_POSES, _MATED_POSES, _SEARCH = 720, 48, 12
# the first way along a path in larger steps; how far gaps are sought, as a part of the smaller solid's size: each costs
# what lies within it, and too short a one steps through poses; the first of the lengths for which they are
_FIRST, _SOUGHT, _SHORTER = 3, 0.2, 8**2
# of a height in what two pairs have in common; mm: what is none
_DIGITS, _NO_HEIGHT = 7, 1e-9


class Struck(Record):
    """Two instances that run into each other: the greatest volume found (mm^3), when, as a share; None: undecided."""

    first: str
    second: str
    volume: float | None
    time: float


class Uncovered(Record):
    """A pair that was not held everywhere: between poses it may be so deep (mm) in each other; ``share`` of its period.

    ``poses`` of it were held.
    """

    first: str
    second: str
    depth: float
    share: float
    poses: int


class MotionFound(Draft):
    """What the motion of a scene shows; ``pairs`` move on each other, ``tested`` in ``poses`` are those that differ and
    that circles do not keep apart.
    """

    struck: list[Struck] = field(default_factory=list)
    uncovered: list[Uncovered] = field(default_factory=list)
    pairs: int = 0
    tested: int = 0
    poses: int = 0


# by parts and height the pairs that were clear
Clear = dict[tuple[str, str, float], list[tuple[Path, Uncovered | None]]]


def motion_found(
    placing: Placing,
    shapes: Mapping[str, Shape],
    course: Course,
    known: set[frozenset[str]],
    apart: Set[frozenset[str]] = frozenset(),
) -> MotionFound:
    """Every two instances that move on each other, each pair that repeats once.

    ``known``: pairs that overlap as they stand; ``apart``: pairs that never meet, whatever moves.
    """
    plates = {i.id for i in placing.instances if shapes[i.part].part.is_plate}
    mated = {frozenset((m.first.id, m.second.id)) for m in placing.mates if m.mating.has_contact}
    # loose pins are the teeth of what they are seated in
    seats = {m.second.id: m.first.id for m in placing.mates if m.mating.kind == "pin_seat"}
    parts = {name: shape.part for name, shape in shapes.items()}
    exact, space = by_contact(placing, parts), _Space(course, shapes, Sections(parts))
    found, clear = MotionFound(), Clear()
    for index, one in enumerate(placing.instances):
        for two in placing.instances[index + 1 :]:
            ends = frozenset((one.id, two.id))
            if not ends & course.rates.keys() or ends in known:
                continue
            # teeth of plates are left to their contact
            if ends <= plates and frozenset(seats.get(end, end) for end in ends) in mated:
                continue
            found.pairs += 1
            if ends in apart:
                continue
            try:
                if {one.axis, two.axis} != {UPWARDS} or ends & course.in_space:
                    # what its mate decides for solids is decided all round
                    if ends not in exact:
                        space.hold(found, (one, two), is_mated=ends in mated)
                    continue
                hold(found, clear, (one, two), (shapes[one.part], shapes[two.part]), course, is_mated=ends in mated)
            except GeometryError:
                found.tested += 1
                found.struck.append(Struck(one.id, two.id, None, 0.0))
    return found


class _Space:
    """What holds pairs whose axes lie, or go round with what lies; ``sections`` tell of what is about one axis."""

    def __init__(self, course: Course, shapes: Mapping[str, Shape], sections: Sections) -> None:
        self.course, self.shapes, self.sections = course, shapes, sections
        self.swept = cache(lambda name: SweptShape(shapes[name]))

    def hold(self, found: MotionFound, pair: tuple[Instance, Instance], *, is_mated: bool) -> None:
        """One pair: at first what both sweep about their own axes, which needs few poses, then the solids."""
        lift = lift_between(pair, self.course)
        own = (self.shapes[pair[0].part], self.shapes[pair[1].part])
        if lift is not None and pass_by(own, lift):
            return
        spins = [self._spins(i) for i in pair]
        if any(spins) and not is_mated and self._sweeps_past(found, pair, (spins[0], spins[1])):
            return
        self._search(found, pair, own, _MATED_POSES if is_mated else MOST_POSES, reports=not is_mated)

    def _spins(self, one: Instance) -> bool:
        """Whether it is not round about the axis of its own on which it turns; what stands still sweeps nothing."""
        turns = one.id in self.course.spins and self.course.chains[one.id][0].rate != 0
        return turns and self.shapes[one.part].count(0.0, math.inf) > 0

    def _sweeps_past(self, found: MotionFound, pair: tuple[Instance, Instance], spins: tuple[bool, bool]) -> bool:
        """Whether what both sweep stays apart."""
        one, two = pair
        near = [self.shapes[i.part] for i in pair]
        round_ = self._round(pair, near, spins)
        if space_path(pair, (near[0], near[1]), self.course, round_) is None:
            # about one line, or cylinders across each other: as it stands it stays
            decided = one.axis != two.axis or coaxial(pair)
            if decided and self.sections.between(one, two) is not None:
                return True
        swept = [self.swept(i.part) if turns else self.shapes[i.part] for i, turns in zip(pair, spins, strict=True)]
        trial = MotionFound()
        self._search(trial, pair, (swept[0], swept[1]), MOST_POSES, reports=True, is_trial=True)
        if trial.struck:
            return False
        found.tested += trial.tested
        found.poses += trial.poses
        found.uncovered += trial.uncovered
        return True

    def _round(
        self, pair: tuple[Instance, Instance], shapes: Sequence[Shape], spins: tuple[bool, bool]
    ) -> tuple[bool, bool]:
        """Whose own turns do not matter: what is round, or swept, about the axis on which it turns."""
        one, two = (
            turns or (i.id in self.course.spins and not shape.count(0.0, math.inf))
            for i, shape, turns in zip(pair, shapes, spins, strict=True)
        )
        return one, two

    def _search(
        self,
        found: MotionFound,
        pair: tuple[Instance, Instance],
        shapes: tuple[Shape, Shape],
        most: int,
        *,
        reports: bool,
        is_trial: bool = False,
    ) -> None:
        """Hold one pair as these shapes; a trial asks only whether they strike at all."""
        path = space_path(pair, shapes, self.course, self._round(pair, shapes, (False, False)))
        one, two = (i.id for i in pair)
        if path is None:
            # it stands still, as it was held; what is swept was not
            if any(isinstance(shape, SweptShape) for shape in shapes):
                found.tested, found.poses = found.tested + 1, found.poses + 1
                volume = common_volume([placed_solid(i, s.solid) for i, s in zip(pair, shapes, strict=True)])
                if volume:
                    found.struck.append(Struck(one, two, volume, 0.0))
            return
        if stays_free(path.free):
            if path.share < 1:
                found.uncovered.append(Uncovered(one, two, 0.0, path.share, 0))
            return
        search = _Search(shapes, path, path.free, 0.0, most, is_trial=is_trial)
        struck, uncovered = search.run(one, two)
        found.tested += 1
        found.poses += search.poses
        if struck is not None:
            found.struck.append(struck)
        elif uncovered is not None and reports:
            found.uncovered.append(uncovered)


def hold(
    found: MotionFound,
    clear: Clear,
    pair: tuple[Instance, Instance],
    shapes: tuple[Shape, Shape],
    course: Course,
    *,
    is_mated: bool,
    most: int = MOST_POSES,
) -> None:
    """Hold one pair, unless one alike was clear."""
    one, two = pair
    lift = two.at[2] - one.at[2]
    if pass_by(shapes, lift):
        return
    path = path_of(pair, shapes, course)
    if path is None:
        return
    free = free_between(path.distances, shapes)
    if stays_free(free):
        if path.share < 1:
            found.uncovered.append(Uncovered(one.id, two.id, 0.0, path.share, 0))
        return
    held = clear.setdefault((one.part, two.part, round(lift, _DIGITS)), [])
    alike = next((item for item in held if path.is_like(item[0])), None)
    if alike is None and path.share == 1 and _drawn_past(shapes, path, lift):
        found.tested += 1
        alike = path, None
        held.append(alike)
    if alike is None:
        search = _Search(shapes, path, free, lift, _MATED_POSES if is_mated else most)
        struck, uncovered = search.run(one.id, two.id)
        found.tested += 1
        found.poses += search.poses
        if struck is not None:
            # where another one strikes is found for itself
            found.struck.append(struck)
            return
        alike = path, uncovered
        held.append(alike)
    uncovered = alike[1]
    # of a mate the plane contact covers what lies between poses
    if uncovered is not None and not is_mated:
        found.uncovered.append(replace(uncovered, first=one.id, second=two.id))


def _drawn_past(shapes: tuple[Shape, Shape], path: Path, lift: float) -> bool:
    """Whether one of upright slabs that is round, like a pin in a slot, is clear of the other all along its way there.

    Between samples it leaves their chords by an eighth of the second differences; twice that is taken.
    """
    import shapely

    places, turns = path.seen(path.times)
    for index, way in ((1, places), (0, -places * np.exp(-1j * turns))):
        other, own = shapes[1 - index], shapes[index]
        if own.count(0.0, math.inf) or not (own.slabs and other.slabs):
            continue
        line = shapely.LineString(np.column_stack([way.real, way.imag]))
        off, up = float(np.abs(np.diff(way, 2)).max()) / 4, lift if index else -lift
        if not any(
            min(one.high, two.high + up) > max(one.low, two.low + up)
            and shapely.dwithin(one.section, line, shapely.hausdorff_distance(two.section, shapely.Point(0, 0)) + off)
            for one in other.slabs
            for two in own.slabs
        ):
            return True
    return False


def pass_by(shapes: tuple[Shape, Shape], lift: float) -> bool:
    """Whether the second, so far above the first, has no height in common with it, mm; rounding is none."""
    return min(shapes[0].high, shapes[1].high + lift) - max(shapes[0].low, shapes[1].low + lift) <= _NO_HEIGHT


class Meeting:
    """Two solids against each other, the second at a height over the first; ``most`` (mm): as far as gaps are sought.

    ``sought``: the same of solids that are no slabs; ``fine``: less is none.
    """

    def __init__(self, shapes: tuple[Shape, Shape], lift: float, most: float, sought: float) -> None:
        self.shapes, self.lift, self.most, self.sought = shapes, lift, most, sought
        one, two = shapes
        self.first, self.second = one.slabs or (), two.slabs or ()
        self.fine = max(inset_of(shape.reach, upright=bool(shape.slabs)) for shape in shapes)
        self.meet = self._slabs if self.first and self.second else self._meshes
        self.last = self.fine
        self.sliver = SLIVER * min(one.solid.volume(), two.solid.volume())

    def _slabs(self, place: complex, turn: float) -> tuple[float, float]:
        """What upright slabs keep apart at least, mm, and their common volume, mm^3, the second in its place."""
        import shapely

        way = cmath.rect(1.0, turn)
        axes = np.array([[way.real, way.imag], [-way.imag, way.real]])
        moved = [shapely.transform(s.section, lambda xy: xy @ axes + (place.real, place.imag)) for s in self.second]
        gap, volume = math.inf, 0.0
        for one in self.first:
            for two, section in zip(self.second, moved, strict=True):
                height = min(one.high, two.high + self.lift) - max(one.low, two.low + self.lift)
                if height <= 0:
                    continue
                gap = min(gap, self._clearance(one.section, section))
                if gap == 0 and shapely.intersects(one.section, section):
                    volume += height * float(shapely.area(shapely.intersection(one.section, section)))
        return gap, volume if volume > self.sliver else 0.0

    def _clearance(self, one: BaseGeometry, two: BaseGeometry) -> float:
        """What two sections keep apart at least, mm: by powers of two about the last one, quicker than the distance."""
        import shapely

        def near(gap: float) -> bool:
            return bool(shapely.dwithin(one, two, gap))

        if near(self.last):
            while self.last > self.fine and near(self.last):
                self.last /= 2
            return 0.0 if near(self.last) else self.last
        while self.last < self.most and not near(2 * self.last):
            self.last *= 2
        return self.last

    def _meshes(self, place: complex, turn: float) -> tuple[float, float]:
        """The same of any solids; their distance as far as it is sought."""
        two = self.shapes[1]
        return self._apart(
            two.solid.rotate([0.0, 0.0, math.degrees(turn)]).translate([place.real, place.imag, self.lift])
        )

    def meet_in_space(self, turned: Real, place: Real) -> tuple[float, float]:
        """The same with the second's frame turned (3, 3) and moved (3,) so."""
        return self._apart(self.shapes[1].solid.transform(np.column_stack([turned, place])))

    def _apart(self, moved: Any) -> tuple[float, float]:
        one = self.shapes[0].solid
        # what lies within the length costs: short ones first, each eight times the last
        length = self.sought / _SHORTER
        while (gap := float(one.min_gap(moved, length))) >= length > 0 and length < self.sought:
            length *= 8
        return gap, common_volume((one, moved)) if gap <= 0 else 0.0


class _Search:
    """Poses of one pair, chosen as it is searched; places on its path go by the path's length, mm.

    A trial ends where the pair first strikes: how deep it goes is of no matter.
    """

    def __init__(
        self,
        shapes: tuple[Shape, Shape],
        path: Path | SpacePath,
        free: Real,
        lift: float,
        most: int,
        *,
        is_trial: bool = False,
    ) -> None:
        self.path, self.free, self.most, self.is_trial = path, free, most, is_trial
        self.whole = float(path.length[-1])
        self.step = _FIRST * self.whole / most
        sought = min(2 * self.step, _SOUGHT * min(shape.reach for shape in shapes))
        self.meeting = Meeting(shapes, lift, self.whole, sought)
        self.poses = 0
        # greatest common volume, mm^3, and where
        self.worst = (0.0, 0.0)

    def run(self, first: str, second: str) -> tuple[Struck | None, Uncovered | None]:
        """Along the path, then where most of it was passed over, at last about its worst place."""
        held = [(0.0, self._gap(0.0))]
        while held[-1][0] < self.whole and not (self.is_trial and self.worst[0]):
            at = min(held[-1][0] + max(held[-1][1], self.step), self.whole)
            held.append((at, self._gap(at)))
        open_ones = [(-_hidden(a, b), a, b) for a, b in pairwise(held)]
        heapify(open_ones)
        while self.worst[0] == 0 and self.poses < self.most and -open_ones[0][0] > self.meeting.fine:
            _, one, two = heappop(open_ones)
            at = (one[0] + two[0]) / 2
            middle = (at, self._gap(at))
            heappush(open_ones, (-_hidden(one, middle), one, middle))
            heappush(open_ones, (-_hidden(middle, two), middle, two))
        if self.worst[0]:
            if not self.is_trial:
                self._about()
            time = float(np.interp(self.worst[1], self.path.length, self.path.times))
            return Struck(first, second, self.worst[0], time), None
        depth = max(-open_ones[0][0], 0.0)
        if depth <= self.meeting.fine and self.path.share == 1:
            return None, None
        return None, Uncovered(first, second, depth, self.path.share, self.poses)

    def _about(self) -> None:
        """The greatest common volume: steps about the worst pose are halved towards it."""
        reach = self.step / 2
        for _ in range(_SEARCH // 2):
            for at in (self.worst[1] - reach, self.worst[1] + reach):
                self.poses += 1
                self.worst = max(self.worst, (self._meet(at % self.whole)[1], at % self.whole))
            reach /= 2

    def _meet(self, at: float) -> tuple[float, float]:
        """Gap and common volume at a place on the path."""
        time = np.array([np.interp(at, self.path.length, self.path.times)])
        if isinstance(self.path, SpacePath):
            turned, there = self.path.seen(time)
            return self.meeting.meet_in_space(turned[0], there[0])
        place, turn = self.path.seen(time)
        return self.meeting.meet(complex(place[0]), math.remainder(float(turn[0]), 2 * math.pi))

    def _gap(self, at: float) -> float:
        """Distance of the solids, mm, as far as it is worth knowing; what they have in common is noted."""
        far = float(np.interp(at, self.path.length, self.free))
        if far > self.step:
            return far
        self.poses += 1
        gap, volume = self._meet(at)
        self.worst = max(self.worst, (volume, at))
        return gap


def _hidden(one: tuple[float, float], two: tuple[float, float]) -> float:
    """How deep (mm) a pair may be in each other between two places on its path with their gaps."""
    return (two[0] - one[0] - one[1] - two[1]) / 2

"""Who runs into whom on the way: solids held against each other over the whole period of their relative motion.

A pair is seen from its first one. Its path is a curve whose length bounds how far any point of the second moves; from
a pose with a gap the pair is clear as long as the path is shorter than the gap, so that most of it is passed over.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import numpy as np

from geometry.base.errors import GeometryError
from geometry.base.record import Draft, Record, field, replace
from parts.base.part import Part
from parts.scene.interference import common_volume
from parts.scene.placing import Instance, Placing
from parts.scene.relative_path import Course, Path, path_of
from parts.scene.shapes import Shape

# poses of one pair at most; of one whose teeth the plane contact has decided; more in the search about the worst
MOST_POSES, _MATED_POSES, _SEARCH = 720, 48, 12
# how far solids are sought of each other, as a part of their size
_SOUGHT = 0.02
# what may go unsaid, mm; digits of a height in what two pairs have in common
_SAME, _DIGITS = 1e-7, 7


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
    """What the motion of a scene shows; ``pairs`` move on each other, ``tested`` of them differ, in so many ``poses``.

    ``one_pose``: pairs that were held as they stand alone.
    """

    struck: list[Struck] = field(default_factory=list)
    uncovered: list[Uncovered] = field(default_factory=list)
    one_pose: list[tuple[str, str]] = field(default_factory=list)
    pairs: int = 0
    tested: int = 0
    poses: int = 0


def motion_found(placing: Placing, parts: dict[str, Part], course: Course, known: set[frozenset[str]]) -> MotionFound:
    """Every two instances that move on each other, each pair that repeats once.

    ``known``: pairs that overlap as they stand.
    """
    shapes = {name: Shape(parts[name]) for name in dict.fromkeys(i.part for i in placing.instances)}
    plates = {i.id for i in placing.instances if parts[i.part].is_plate}
    mated = {frozenset((m.first.id, m.second.id)) for m in placing.mates if m.mating.has_contact}
    found, clear = MotionFound(), dict[tuple[object, ...], Uncovered | None]()
    for index, one in enumerate(placing.instances):
        for two in placing.instances[index + 1 :]:
            ends = frozenset((one.id, two.id))
            if not ends & (course.rates.keys() | course.unknown) or ends in known or (ends in mated and ends <= plates):
                continue
            if ends & course.unknown:
                found.one_pose.append((one.id, two.id))
                continue
            found.pairs += 1
            try:
                _hold(found, clear, (one, two), (shapes[one.part], shapes[two.part]), course, is_mated=ends in mated)
            except GeometryError:
                found.struck.append(Struck(one.id, two.id, None, 0.0))
    return found


def _hold(
    found: MotionFound,
    clear: dict[tuple[object, ...], Uncovered | None],
    pair: tuple[Instance, Instance],
    shapes: tuple[Shape, Shape],
    course: Course,
    *,
    is_mated: bool,
) -> None:
    """Hold one pair, unless one alike was clear."""
    one, two = pair
    lift = two.at[2] - one.at[2]
    if shapes[0].high <= shapes[1].low + lift or shapes[1].high + lift <= shapes[0].low:
        return
    path = path_of(pair, shapes, course)
    if path is None or _apart(path, shapes):
        return
    key = None if path.key is None else (one.part, two.part, round(lift, _DIGITS), *path.key)
    if key is not None and key in clear:
        uncovered = clear[key]
    else:
        search = _Search(shapes, path, lift, _MATED_POSES if is_mated else MOST_POSES)
        struck, uncovered = search.run(one.id, two.id)
        found.tested += 1
        found.poses += len(search.held)
        if struck is not None:
            found.struck.append(struck)
        elif key is not None:
            clear[key] = uncovered
    # of a mate the plane contact covers what lies between poses
    if uncovered is not None and not is_mated:
        found.uncovered.append(replace(uncovered, first=one.id, second=two.id))


def _apart(path: Path, shapes: tuple[Shape, Shape]) -> bool:
    """Whether circles about the axes tell already that the pair never meets; the outer ones ask for no solid."""
    one, two = shapes
    distance = np.abs(path.places)
    return bool(
        distance.min() > one.reach + two.reach
        or distance.max() < one.bore - two.reach
        or distance.max() < two.bore - one.reach
    )


class _Search:
    """Poses of one pair, chosen as it is searched."""

    def __init__(self, shapes: tuple[Shape, Shape], path: Path, lift: float, most: int) -> None:
        self.shapes, self.path, self.lift = shapes, path, lift
        self.whole = float(path.length[-1])
        self.step = self.whole / most
        self.sought = min(2 * self.step, _SOUGHT * min(s.reach for s in shapes))
        one, two = shapes
        distance = np.abs(path.places)
        inside = np.maximum(one.bore - two.reach, two.bore - one.reach) - distance
        self.far = np.maximum(distance - one.reach - two.reach, inside)
        self.held: set[int] = set()

    def run(self, first: str, second: str) -> tuple[Struck | None, Uncovered | None]:
        """Along the path; then about its worst place."""
        held: list[tuple[int, float]] = []
        length = self.path.length
        at, depth, last = 0, 0.0, len(self.path.times) - 1
        worst = (0.0, 0)
        while True:
            gap = float(self.far[at])
            if gap <= self.step:
                gap = max(gap, self._gap(at))
            if gap <= 0:
                worst = max(worst, (self._volume(at), at))
            held.append((at, gap))
            if at == last:
                break
            reached = int(np.searchsorted(length, length[at] + max(gap, self.step), side="right")) - 1
            at = min(max(reached, at + 1), last)
        for (a, before), (b, after) in pairwise(held):
            depth = max(depth, (float(length[b] - length[a]) - max(before, 0.0) - max(after, 0.0)) / 2)
        near = worst[1] if worst[0] else min(held, key=lambda item: item[1])[0]
        if worst[0] or depth > 0:
            worst = max(worst, self._about(near))
        struck = Struck(first, second, worst[0], float(self.path.times[worst[1]])) if worst[0] else None
        told = struck is None and (depth > _SAME or self.path.share < 1)
        return struck, Uncovered(first, second, depth, self.path.share, len(self.held)) if told else None

    def _about(self, near: int) -> tuple[float, int]:
        """The greatest common volume about a pose: the interval of neighbours is halved towards it."""
        reach = max(1, int(np.searchsorted(self.path.length, self.path.length[near] + self.step)) - near)
        best = (self._volume(near), near)
        for _ in range(_SEARCH // 2):
            for at in (best[1] - reach, best[1] + reach):
                if 0 <= at < len(self.path.times):
                    best = max(best, (self._volume(at), at))
            reach = max(1, reach // 2)
        return best

    def _second(self, at: int) -> Any:
        self.held.add(at)
        place, turn = complex(self.path.places[at]), math.remainder(float(self.path.turns[at]), 2 * math.pi)
        turned = self.shapes[1].solid.rotate([0.0, 0.0, math.degrees(turn)])
        return turned.translate([place.real, place.imag, self.lift])

    def _gap(self, at: int) -> float:
        """Distance of the solids, mm, as far as it is worth knowing."""
        return float(self.shapes[0].solid.min_gap(self._second(at), self.sought))

    def _volume(self, at: int) -> float:
        return common_volume((self.shapes[0].solid, self._second(at)))

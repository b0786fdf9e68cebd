"""Who runs into whom wherever the drives of a scene may stand, each for itself, by relative coordinates.

Two bodies stand to each other as the turns say by which they, and what carries them, differ. Where these hang on one
number the pair is followed over its whole period, one drive alone moving it (moving_solids); where on more, cells of
the drives' turns are parted as long as what stands in their middles is nearer than anything moves within them. Most
pairs cannot meet: one body, never at one height, circles about their axes apart, round about a common axis, past what
the other sweeps; gears in mesh are left to their exact contact.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from fractions import Fraction
from functools import cached_property
from heapq import heapify, heappop, heappush
from itertools import combinations

import numpy as np

from geometry.base.errors import GeometryError
from geometry.base.record import Draft, Record, field, replace
from geometry.curves.curve import Complex, Real
from geometry.kinematics.mechanism import FRAME, Fixed, Group, Prismatic, Revolute
from geometry.kinematics.moving import Drive
from parts.scene.half_sections import Sections
from parts.scene.interference import common_volume
from parts.scene.moving_solids import Clear, Meeting, MotionFound, Uncovered, hold, pass_by
from parts.scene.placing import Placing
from parts.scene.relative_path import Course, common_period, course_of
from parts.scene.shapes import LyingShape, Shape, free_between
from parts.scene.standing import UPWARDS, Instance
from parts.scene.train import Train

# amplitudes below this are none, mm
_NONE = 1e-7
# how far solids that are no slabs are sought of each other, as a part of their size
_SOUGHT = 0.1
# of what two pairs have in common
_DIGITS = 7
# places at which circles are asked, for each pose in which solids are
_LOOKS = 100
_TURN = 2 * math.pi
# reasons why a pair is not held, in the order in which they are asked
REASONS = ("fixed", "height", "circles", "round", "swept", "mesh")
# turns of each drive
Rates = tuple[Fraction, ...]


class Wave(Record):
    """Where a body stands when each drive has turned so often: a sum of vectors that turn, and its own turn.

    ``arms``: vectors (mm) by the turns for one of each drive; ``own``: turns of the body; ``angle``: at the start, rad.
    """

    arms: Mapping[Rates, complex]
    own: Rates
    angle: float


class Struck(Record):
    """Two instances that run into each other: common volume, mm^3 (None: undecided), and turns of each drive there."""

    first: str
    second: str
    volume: float | None
    turns: tuple[float, ...]


class WorkspaceFound(Draft):
    """What holding a scene all over shows: ``rest``: by reason the pairs that cannot meet; ``tested``: those held, each
    with the drives that it hangs on; ``motion``: what was held, in how many poses, and what lies between them.
    """

    rest: dict[str, list[tuple[str, str]]]
    tested: list[tuple[str, str, tuple[str, ...]]] = field(default_factory=list)
    struck: list[Struck] = field(default_factory=list)
    motion: MotionFound = field(default_factory=MotionFound)


def workspace_found(
    placing: Placing, shapes: Mapping[str, Shape], contact: set[frozenset[str]], known: set[frozenset[str]], poses: int
) -> WorkspaceFound:
    """Every two instances, all over; each pair in so many ``poses`` at most.

    ``contact``: pairs that are left to their exact contact; ``known``: pairs that overlap as they stand.
    """
    train = placing.train
    assert train is not None
    lying = {i.id: any(turn.rate for turn in train.chain(i.id)) for i in placing.instances if i.axis != UPWARDS}
    stand = [replace(i, axis=UPWARDS, rotation=0.0) if i.id in lying else i for i in placing.instances]
    made = {i.id: LyingShape(shapes[i.part], i, turns=lying[i.id]) if i.id in lying else shapes[i.part]
            for i in placing.instances}  # fmt: skip
    waves = {i.id: _still(train, i) if i.id in lying else _waves_of(train, i.id) for i in stand}
    held = _Held(train, {i.id: i for i in stand if i.id in lying}, poses)
    bodies, placed = {i.id: train.moving.stands.body(i.id) for i in stand}, {i.id: i for i in placing.instances}
    sections = Sections({name: shape.part for name, shape in shapes.items()})
    found, done = WorkspaceFound({why: [] for why in REASONS}), dict[object, bool]()
    for pair in combinations(stand, 2):
        one, two = (i.id for i in pair)
        if bodies[one] == bodies[two]:
            found.rest["fixed"].append((one, two))
            continue
        if {one, two} <= lying.keys() and sections.between(placed[one], placed[two]) is not None:
            found.rest["round"].append((one, two))
            continue
        if pass_by((made[one], made[two]), pair[1].at[2] - pair[0].at[2]):
            found.rest["height"].append((one, two))
            continue
        seen = _Seen(pair, (waves[one], waves[two]), (made[one], made[two]))
        if (why := _why_not(seen, done, sections, is_mated=frozenset((one, two)) in contact)) is not None:
            found.rest[why].append((one, two))
        elif frozenset((one, two)) not in known:
            try:
                held.hold(found, seen)
            except GeometryError:
                found.struck.append(Struck(one, two, None, (0.0,) * len(train.drives)))
    return found


def never_meeting(placing: Placing, shapes: Mapping[str, Shape], contact: set[frozenset[str]]) -> set[frozenset[str]]:
    """Pairs that cannot meet wherever the drives may stand, of upright solids that are not both of slabs: meshes held
    in many poses take far longer.
    """
    train = placing.train
    assert train is not None
    flat = [i for i in placing.instances if i.axis == UPWARDS and i.id not in train.in_space]
    even = [i for i in flat if not uneven(train, i.id)]
    waves, bodies = {i.id: _waves_of(train, i.id) for i in even}, train.moving.stands.body
    sections, done = Sections({name: shape.part for name, shape in shapes.items()}), dict[object, bool]()
    slabs, found = {name: shape.is_slabs for name, shape in shapes.items()}, set[frozenset[str]]()
    for pair in combinations(even, 2):
        ends, made = [i.id for i in pair], (shapes[pair[0].part], shapes[pair[1].part])
        if bodies(ends[0]) == bodies(ends[1]) or all(slabs[i.part] for i in pair) or frozenset(ends) in contact:
            continue
        if not pass_by(made, pair[1].at[2] - pair[0].at[2]):
            seen = _Seen(pair, (waves[ends[0]], waves[ends[1]]), made)
            if seen.moves and _why_not(seen, done, sections, is_mated=False) is not None:
                found.add(frozenset(ends))
    return found


def uneven(train: Train, key: str) -> bool:
    """Whether an instance, or what carries it, slides, or does not turn evenly: a cam moves it."""
    supports = train.moving.stands.supports
    while (joint := supports.get(key)) is not None:
        if key in train.uneven or isinstance(joint, Group | Prismatic):
            return True
        key = joint.on
    return False


def _still(train: Train, instance: Instance) -> Wave:
    """Of what stands where it stands."""
    none = (Fraction(0),) * len(train.drives)
    return Wave({none: instance.centre}, none, instance.rotation)


def _waves_of(train: Train, key: str) -> Wave:
    """How an instance moves, with all that carries it."""
    moved = train.moving
    joint = moved.stands.supports.get(key)
    assert joint is None or isinstance(joint, Fixed | Revolute)
    shares = moved.turns.shares.get(moved.stands.body(key), {})
    own = tuple(shares.get(drive, Fraction(0)) for drive in train.drives)
    if joint is None:
        return Wave({}, own, 0.0)
    below, (start, angle) = _waves_of(train, joint.on), moved.starts[key]
    arms = dict(below.arms)
    at = joint.at if isinstance(joint, Revolute) else start
    for rates, arm in ((below.own, at - moved.starts[joint.on][0]), (own, start - at)):
        arms[rates] = arms.get(rates, 0j) + arm
    return Wave(arms, own if isinstance(joint, Revolute) else below.own, angle)


class _Held:
    """What holds pairs: the train with each drive alone, and by each the pairs that were clear."""

    def __init__(self, train: Train, lying: Mapping[str, Instance], poses: int) -> None:
        self.train, self.poses = train, poses
        self.alone = [self._alone(drive, lying) for drive in train.drives]
        self.clear = [Clear() for _ in train.drives]

    def _alone(self, driven: str, lying: Mapping[str, Instance]) -> Course:
        """The course of one drive, whose t is a turn of it; what lies stands still."""
        lines = [Drive(key, Fraction(int(key == driven))) for key in self.train.drives]
        train = replace(self.train, moving=self.train.moving.driven(lines))
        course = course_of(train, [key for key in train.moving.starts if key not in lying and key != FRAME])

        def pose(key: str, t: Real) -> tuple[Complex, Real]:
            if key in lying:
                return np.full(np.shape(t), lying[key].centre), np.zeros(np.shape(t))
            return course.pose(key, t)

        return replace(course, pose=pose)

    def hold(self, found: WorkspaceFound, seen: _Seen) -> None:
        """One pair by one drive alone, or by as many as it hangs on."""
        one, two = seen.pair
        names = tuple(self.train.drives[k] for k in seen.drives)
        found.tested.append((one.id, two.id, names))
        if len(names) == 1:
            (k,) = seen.drives
            before = len(found.motion.struck)
            hold(found.motion, self.clear[k], seen.pair, seen.shapes, self.alone[k], is_mated=False, most=self.poses)
            for struck in found.motion.struck[before:]:
                turns = tuple(struck.time if n == k else 0.0 for n in range(len(self.train.drives)))
                found.struck.append(Struck(one.id, two.id, struck.volume, turns))
            return
        search = _Cells(seen, self.poses)
        search.run()
        found.motion.tested += 1
        found.motion.poses += search.poses
        if search.worst[0]:
            found.struck.append(Struck(one.id, two.id, search.worst[0], seen.by_all(search.worst[1])))
        elif search.depth > search.meeting.fine:
            found.motion.uncovered.append(Uncovered(one.id, two.id, search.depth, 1.0, search.poses))


def _why_not(seen: _Seen, done: dict[object, bool], sections: Sections, *, is_mated: bool) -> str | None:
    """Why a pair at one height that moves needs not be held, if it does not."""
    if not seen.moves and not seen.swept:
        return "fixed"
    if is_mated:
        return "mesh"
    far = sum(map(abs, seen.arms.values()))
    near = max((2 * abs(arm) - far for arm in seen.arms.values()), default=0.0)
    if float(free_between(np.array([max(near, 0.0), far]), seen.shapes).min()) > 0:
        return "circles"
    if not seen.vectors and not seen.swept:
        return "round"
    return "swept" if seen.sweeps_past(done, sections) or seen.stands_clear() else None


class _Seen:
    """A pair as its relative coordinates have it: ``arms`` from the first's axis to the second's, by their turns."""

    def __init__(self, pair: tuple[Instance, Instance], waves: tuple[Wave, Wave], shapes: tuple[Shape, Shape]) -> None:
        self.pair, self.waves, self.shapes = pair, waves, shapes
        self.lift = pair[1].at[2] - pair[0].at[2]
        arms: dict[Rates, complex] = {}
        for wave, sign in zip(waves, (-1, 1), strict=True):
            for rates, arm in wave.arms.items():
                arms[rates] = arms.get(rates, 0j) + sign * arm
        self.arms = {rates: arm for rates, arm in arms.items() if abs(arm) > _NONE}
        # of what is round its own turn does not matter
        self.reaches = tuple(shape.reach if shape.count(0.0, math.inf) else 0.0 for shape in shapes)
        self.swept = any(isinstance(shape, LyingShape) and shape.turns for shape in shapes)
        self.moves = any(rates != waves[0].own for rates in (waves[1].own, *self.arms))

    @cached_property
    def vectors(self) -> tuple[Rates, ...]:
        """The turns by which both, and what carries them, differ: what the pair hangs on."""
        own = [wave.own for wave, reach in zip(self.waves, self.reaches, strict=True) if reach]
        return _differences([*self.arms, *own])

    @cached_property
    def drives(self) -> tuple[int, ...]:
        """Drives that put the pair wherever it may stand, the fewest."""
        matrix = np.array([[float(x) for x in v] for v in self.vectors]).reshape(-1, len(self.waves[0].own))
        rank = int(np.linalg.matrix_rank(matrix)) if matrix.size else 0
        every = combinations(range(matrix.shape[1]), rank)
        return next(chosen for chosen in every if not rank or np.linalg.matrix_rank(matrix[:, chosen]) == rank)

    def speed(self, drive: int) -> float:
        """How far any point of either goes against the other for a turn of a drive, mm, at most: in the best frame."""
        every = [(wave.own[drive], reach) for wave, reach in zip(self.waves, self.reaches, strict=True)]
        every += [(rates[drive], abs(arm)) for rates, arm in self.arms.items()]
        return _TURN * min(sum(float(abs(rate - base)) * long for rate, long in every) for base, _ in every)

    def sweeps_past(self, done: dict[object, bool], sections: Sections) -> bool:
        """Whether one sweeps nothing that the other takes as it goes about an axis that stands in it; ``done``: asked
        before, of what is alike.
        """
        sizes = [(isinstance(shape, LyingShape), shape.reach) for shape in self.shapes]
        rings = [self._ring(k) for k in range(2)]
        asked = []
        for k, (near, far, at) in enumerate(rings):
            lift = self.lift if k else -self.lift
            key = (id(self.shapes[k]), id(self.shapes[1 - k]), *(round(x, _DIGITS) for x in (near, far, lift)),
                   round(at.real, _DIGITS), round(at.imag, _DIGITS))  # fmt: skip
            asked.append((key, lift))
            if key not in done and not (sizes[0][0] or sizes[1][0]):
                other, own = self.pair[1 - k].part, self.pair[k].part
                if sections.pass_each_other(other, at, own, near, far, lift):
                    done[key] = True
            if done.get(key):
                return True
        for k, ((near, far, at), (key, lift)) in enumerate(zip(rings, asked, strict=True)):
            # where both go about each other the smaller one sweeps less
            if far and sizes[k] > sizes[1 - k]:
                continue
            if key not in done:
                solid = self.shapes[k].swept(near, far).translate([at.real, at.imag, lift])
                done[key] = not common_volume((solid, self.shapes[1 - k].solid))
            if done[key]:
                return True
        return False

    def stands_clear(self) -> bool:
        """Whether what no drive moves against the other, but one sweeps about its own axis, is clear as it stands."""
        if self.vectors:
            return False
        return not Meeting(self.shapes, self.lift, 0.0, 0.0).meet(*self.at(()))[1]

    def _ring(self, k: int) -> tuple[float, float, complex]:
        """How near and how far one of them goes about an axis, mm, and where that stands in the frame of the other."""
        seen_by = self.waves[1 - k]
        about = [abs(arm) for rates, arm in self.arms.items() if rates != seen_by.own]
        far = math.fsum(about)
        at = (1 if k else -1) * self.arms.get(seen_by.own, 0j) * cmath.rect(1.0, -seen_by.angle)
        return max(2 * max(about, default=0.0) - far, 0.0), far, at

    def by_all(self, turns: Sequence[float]) -> tuple[float, ...]:
        """Turns of those drives among all, of which the others stand."""
        found = dict(zip(self.drives, turns, strict=True))
        return tuple(found.get(k, 0.0) for k in range(len(self.waves[0].own)))

    def at(self, given: Sequence[float]) -> tuple[complex, float]:
        """Axis and angle of the second in the frame of the first, by turns of the drives that the pair hangs on."""
        (one, two), turns = self.waves, self.by_all(given)
        place = sum((arm * cmath.rect(1.0, _angle(rates, turns)) for rates, arm in self.arms.items()), 0j)
        angle = one.angle + _angle(one.own, turns)
        return place * cmath.rect(1.0, -angle), math.remainder(two.angle + _angle(two.own, turns) - angle, _TURN)


class _Cells:
    """The search for a pair over cells of the drives' turns, the worst ones first."""

    def __init__(self, seen: _Seen, most: int) -> None:
        self.seen, self.most = seen, most
        self.speeds = [seen.speed(k) for k in seen.drives]
        self.periods = [float(common_period({v[k] for v in seen.vectors})) for k in seen.drives]
        reach = min(shape.reach for shape in seen.shapes)
        self.meeting = Meeting(seen.shapes, seen.lift, reach, _SOUGHT * reach)
        self.poses, self.looks, self.depth = 0, 0, 0.0
        # greatest common volume, mm^3, and the turns there
        self.worst: tuple[float, tuple[float, ...]] = (0.0, ())

    def run(self) -> None:
        """Cells in whose middle the gap is less than what moves within them are parted, along what moves the most."""
        halves = tuple(period / 2 for period in self.periods)
        cells = [self._cell(halves, halves)]
        heapify(cells)
        while (
            self.worst[0] == 0
            and self.poses < self.most
            and self.looks < _LOOKS * self.most
            and -cells[0][0] > self.meeting.fine
        ):
            _, middle, halves, gap = heappop(cells)
            ways = [half * speed for half, speed in zip(halves, self.speeds, strict=True)]
            k = ways.index(max(ways))
            third = tuple(half / 3 if n == k else half for n, half in enumerate(halves))
            for side in (-1, 0, 1):
                at = tuple(x + 2 * side * third[n] if n == k else x for n, x in enumerate(middle))
                heappush(cells, self._cell(at, third, None if side else gap))
        self.depth = max(-cells[0][0], 0.0)

    def _cell(
        self, middle: tuple[float, ...], halves: tuple[float, ...], gap: float | None = None
    ) -> tuple[float, tuple[float, ...], tuple[float, ...], float]:
        """A cell: less how deep both may be in each other in it, its middle, half its sides, the gap in its middle."""
        gap = self._gap(middle) if gap is None else gap
        return gap - sum(h * v for h, v in zip(halves, self.speeds, strict=True)), middle, halves, gap

    def _gap(self, turns: tuple[float, ...]) -> float:
        place, angle = self.seen.at(turns)
        self.looks += 1
        free = float(free_between(np.array([abs(place)]), self.seen.shapes)[0])
        if free > 0:
            return free
        self.poses += 1
        gap, volume = self.meeting.meet(place, angle)
        self.worst = max(self.worst, (volume, turns))
        return gap


def _differences(turns: Sequence[Rates]) -> tuple[Rates, ...]:
    """By how much turns differ from the first, each once."""
    found = [tuple(a - b for a, b in zip(rates, turns[0], strict=True)) for rates in turns[1:]]
    return tuple(dict.fromkeys(v for v in found if any(v)))


def _angle(rates: Rates, turns: Sequence[float]) -> float:
    """How far something has turned, rad."""
    return _TURN * math.fsum(float(rate) * turn for rate, turn in zip(rates, turns, strict=True))

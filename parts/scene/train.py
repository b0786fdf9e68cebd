"""What moves in a scene: its mates as joints of the kinematic layer, and where its drives then put every instance."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import lru_cache

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement3
from geometry.base.record import Record, replace
from geometry.base.series import Series
from geometry.curves.curve import Complex, Real
from geometry.kinematics.mechanism import (
    FRAME,
    Fixed,
    Group,
    Joint,
    Mechanism,
    Prismatic,
    Revolute,
    Rolling,
    Tree,
    Uneven,
    Z,
    one_line,
    parallel,
    tree,
    turns,
)
from geometry.kinematics.moving import Drive, Moving, in_plane, moving
from parts.base.mate import Mating, Pose, Toothed
from parts.base.refusal import SceneError
from parts.scene.instances import DriveSpec
from parts.scene.standing import Instance

Stand = Mapping[str, Instance]
# of so many turns of a cam what follows is remembered
_TURNS_KEPT = 4096


class Turning(Record):
    """A body that turns about its joint's axis: turns for one t against what carries it.

    ``by_law``: one that a cam moves, and how often this or what carries it turns.
    """

    body: Revolute
    rate: Fraction
    by_law: bool = False


class Train(Record):
    """What drives move; at t = 1 they have run as far as the scene asks.

    ``turned``: of each drive the turns it gives to each instance, ``slid``: the travel, mm. ``uneven``: what turns so
    often, but not evenly; ``in_space``: what does not go upright in the plane, nor turns about its own axis alone.
    """

    stand: Stand
    moving: Moving
    drives: tuple[str, ...]
    turned: tuple[dict[str, float], ...]
    slid: tuple[dict[str, float], ...]
    uneven: frozenset[str]
    in_space: frozenset[str]

    def set(self, values: Sequence[float | Fraction]) -> Train:
        """The same train, at t = 0 where each drive has run that far, turns, or mm of a slide, and at rest there."""
        lines = [
            Drive(key, Fraction(0), exact(value, slides(self.moving.stands, key)))
            for key, value in zip(self.drives, values, strict=True)
        ]
        return replace(self, moving=self.moving.driven(lines))

    def poses(self, values: Sequence[float | Fraction]) -> dict[str, Pose]:
        """Where all that does not move ``in_space`` stands when each drive has run that far."""
        train, now = self.set(values), np.zeros(())
        found = {key: train.along(key, now) for key in self.stand if key not in self.in_space}
        return {key: (complex(at), float(angle)) for key, (at, angle) in found.items()}

    def along(self, key: str, t: Real) -> tuple[Complex, Real]:
        """Centres (mm) and rotations (rad) about its axis of an instance that does not move ``in_space``, at many t."""
        here = self.stand[key]
        if here.axis != Z or key not in self.moving.starts:
            return np.full(np.shape(t), here.centre), here.rotation + self.moving.turned(key, t)
        at, angle = self.moving.pose(key, t, 0)
        return np.asarray(at[0]), np.asarray(angle[0])

    def placed(self, key: str, t: Real, *, own: bool = True) -> tuple[Real, Real]:
        """Of any instance the turns (..., 3, 3) and places (..., 3), mm, of its frame in the scene, at many t.

        Without the turn of its ``own``: with its body at rest on what carries that.
        """
        here, joint = self.stand[key].scene_from_part, self.moving.stands.supports.get(self.moving.stands.body(key))
        moves = key if own or not isinstance(joint, Revolute) else joint.on
        turned, moved = self.moving.displacement(moves, t)
        return np.asarray(turned @ np.array(here.rotation)), turned @ np.array(here.translation) + moved

    def chain(self, key: str) -> tuple[Turning, ...]:
        """What turns an instance, from its own body down."""
        stands, found, here = self.moving.stands, list[Turning](), key
        while (joint := stands.supports.get(here)) is not None:
            if isinstance(joint, Group):
                return (*found, *(replace(one, body=replace(one.body, link=here), by_law=True)
                                  for one in self.chain(joint.on[0])))  # fmt: skip
            if isinstance(joint, Revolute):
                row = stands.turn(here, joint.on)
                rates = (share * self.moving.courses[name].rate for name, share in row.items())
                found.append(Turning(joint, sum(rates, Fraction())))
            here = joint.on
        return tuple(found)

    def spins(self, key: str) -> bool:
        """Whether what turns an instance turns it about its own axis."""
        joint = self.moving.stands.supports.get(self.moving.stands.body(key))
        return isinstance(joint, Revolute) and one_line(joint, _about(key, self.stand[key]))

    def rolled(self, mating: Mating) -> list[float]:
        """By each drive the turns of a mate's first, against the carrier where both are gears."""
        ends = {(mating.first, mating.second)} if isinstance(mating, Toothed) or mating.lies else set()
        stands = self.moving.stands
        meshes = (j for j in stands.mechanism.joints if isinstance(j, Rolling))
        carrier = next((j.on for j in meshes if (j.first, j.second) in ends), FRAME)
        row = stands.turn(mating.first, carrier)
        return [sum(float(share) * train.get(key, 0.0) for key, share in row.items()) for train in self.turned]

    def rates(self, key: str) -> tuple[Fraction, ...] | None:
        """Turns of an instance, then of what carries it, from the nearest on, for one t.

        What a cam moves does not turn, and its cam carries it; None of what slides on and on, turns unevenly,
        or stands elsewhere after a whole turn.
        """
        if key in self.uneven:
            return None
        found: list[Fraction] = []
        while key != FRAME:
            joint = self.moving.stands.supports[key]
            if isinstance(joint, Group):
                if joint.counts:
                    return None
                found.append(Fraction())
                key = joint.on[0]
                continue
            rate = self.moving.courses[key].rate
            if isinstance(joint, Prismatic) and rate:
                return None
            if isinstance(joint, Revolute):
                found.append(rate)
            key = joint.on
        return tuple(found)


def exact(value: float | Fraction, travels: bool) -> Fraction:
    """Turns exactly as they were written; travel (mm) in units of pi mm, as the layer has it."""
    return Fraction(value) / Fraction(math.pi) if travels else Fraction(str(value))


def slides(stands: Tree, key: str) -> bool:
    """Whether an instance travels instead of turning."""
    return isinstance(stands.supports.get(stands.body(key)), Prismatic)


def _run(drive: DriveSpec, travels: bool, place: str, source: str) -> Fraction:
    if travels and drive.travel is None:
        raise SceneError(source, f"{place}.turns", drive.turns, "drive_slides")
    if not travels and drive.travel is not None:
        raise SceneError(source, f"{place}.travel", drive.travel, "drive_turns")
    return exact(drive.turns if drive.travel is None else drive.travel, travels)


class Bodies:
    """Which instances are one body, by what mates fix together; one of them leads it."""

    def __init__(self, keys: Iterable[str], matings: Sequence[Mating]) -> None:
        self._leader = {key: key for key in keys}
        follows = {mating.second for mating in matings if mating.follows}
        for mating in matings:
            for joint in mating.joints:
                if isinstance(joint, Fixed):
                    one, two = self.of(joint.on), self.of(joint.link)
                    # what stands where a cam puts it leads those that are fixed to it
                    one, two = (two, one) if two in follows else (one, two)
                    self._leader[two] = one

    def of(self, key: str) -> str:
        """The leader of its body."""
        while self._leader[key] != key:
            key = self._leader[key]
        return key


def scene_mechanism(
    stand: Stand, matings: Sequence[Mating], held: Iterable[str] = (), drives: Iterable[str] = ()
) -> Mechanism:
    """The mechanism of instances as they stand.

    An instance that no mate carries turns about its own axis on the frame; of several that are one body that is the
    axis of the first that meshes. A mesh is carried by the instance on which both of its axes stand.

    Raises
    ------
    ParameterError
        An instance stands on two others, or the axes of a mesh part: named ``mates[k].KEY``.
    """
    bodies = Bodies(stand, matings)
    joints = _joints(stand, matings, bodies)
    holds = {key: None for mating in matings for key in mating.holds}
    base = Mechanism(tuple(joints.values()), tuple(holds | dict.fromkeys(held)),
                     {key: (one.centre, one.rotation) for key, one in stand.items()})  # fmt: skip
    stands = tree(base)
    laid = {
        bodies.of(mating.second): _following(mating, stand, bodies.of(mating.second), laid=True)
        for mating in matings
        if mating.follows and (stand[mating.first].axis != Z or not in_plane(mating.first, stands))
    }
    if laid:
        base = replace(base, joints=tuple((joints | laid).values()))
        stands = tree(base)
    return replace(base, joints=(*base.joints, *_meshes(stand, matings, bodies, stands, set(drives))))


def _joints(stand: Stand, matings: Sequence[Mating], bodies: Bodies) -> dict[str, Joint]:
    """What each instance stands on, or is one body with."""
    axes: dict[str, Instance] = {}
    carriers: dict[str, list[tuple[str, int]]] = {}
    joints: dict[str, Joint] = {}
    for index, mating in enumerate(matings):
        body = bodies.of(mating.second)
        for joint in mating.joints:
            if isinstance(joint, Rolling):
                for key in (joint.first, joint.second):
                    axes.setdefault(bodies.of(key), stand[key])
            elif isinstance(joint, Prismatic):
                slide = bodies.of(joint.link)
                joints.setdefault(slide, _slide(slide, stand[joint.link]))
            elif isinstance(joint, Revolute) and bodies.of(joint.on) != body:
                carriers.setdefault(body, []).append((bodies.of(joint.on), index))
        if mating.follows and bodies.of(mating.first) != body:
            joints.setdefault(body, _following(mating, stand, body))
    # an axis that a mate puts somewhere is there
    axes |= {key: stand[matings[found[0][1]].second] for key, found in carriers.items()}
    lines = {key: _about(key, one) for key, one in {**stand, **axes}.items()}
    led = set(joints)

    def carrier(on: str, line: Revolute) -> str:
        """What carries an axis: what stands on one's own axis does not go round with one."""
        while on not in led and on != FRAME and one_line(lines[on], line):
            on = carriers[on][0][0] if on in carriers else FRAME
        return on

    def asked(key: str, index: int) -> Revolute:
        """The axis that a mate puts it on: of ``coaxial`` the first one's, also where it does not stand there."""
        mating = matings[index]
        return lines[key] if mating.placed_turn is None else _about(key, stand[mating.first])

    for key in stand:
        body = bodies.of(key)
        if body != key:
            joints[key] = Fixed(key, on=body, sense=parallel(stand[key].axis, lines[body].axis) or 1)
        elif key not in joints:
            found = [(carrier(on, asked(key, index)), index) for on, index in carriers.get(key, ())]
            joints[key] = replace(lines[key], on=found[0][0] if found else FRAME)
            for on, index in found[1:]:
                if on != found[0][0]:
                    told = f"mates[{index + 1}].first"
                    raise ParameterError(told, matings[index].first, "stands_on_two", None, on=[found[0][0]])
    return joints


def _meshes(
    stand: Stand, matings: Sequence[Mating], bodies: Bodies, stands: Tree, drives: set[str]
) -> Iterator[Rolling]:
    """What rolls on one another, each on what carries both axes."""
    for index, mating in enumerate(matings):
        for joint in mating.joints:
            if not isinstance(joint, Rolling):
                continue
            told = f"mates[{index + 1}].second"
            shared = stands.common_carrier(joint.first, joint.second)
            if bodies.of(joint.first) == bodies.of(joint.second):
                raise ParameterError(told, joint.second, "rolls_on_itself")
            if shared is None:
                raise ParameterError(told, joint.second, mating.without_carrier, None, first=joint.first)
            # a ring that its mate holds turns nothing but what an eccentric carries
            if not (mating.holds and shared == FRAME):
                uneven = _ahead(mating, joint, stand, matings, drives) if mating.uneven else None
                yield replace(joint, on=shared, uneven=uneven)


def _ahead(mating: Mating, joint: Rolling, stand: Stand, matings: Sequence[Mating], drives: set[str]) -> Uneven:
    """What a noncircular pair adds to its ratio of whole turns; the driver is the one nearer to the drives."""
    beyond = hanging_together(mating.second, [other for other in matings if other is not mating])
    driver, mean = mating.first, float(joint.ratio)
    if behind := drives.intersection(beyond):
        if mating.only_first_drives:
            raise ParameterError("drives", min(behind), "moves_by_law")
        driver, mean = mating.second, 1 / mean
    first, second = stand[mating.first], stand[mating.second]
    towards, begins = second.centre - first.centre, stand[driver].rotation
    if first.axis != Z:
        # about that axis, from its x as it is laid
        laid = Placement3.towards(first.axis, 0.0, first.at).inverse()
        x, y, _ = laid.apply(np.array(second.at)).tolist()
        towards = complex(x, y)
    direction = cmath.phase(towards)
    start = mating.partner(driver, begins, direction)

    def ahead(turn: Series) -> Series:
        turned = np.vectorize(lambda t: mating.partner(driver, begins + float(t), direction), [float])(turn[0])
        # how fast it goes is the centrodes' matter
        return [turned - start - mean * turn[0], *(np.full(np.shape(turned), np.nan) for _ in turn[1:])]

    return Uneven(driver, ahead)


def _about(key: str, one: Instance) -> Revolute:
    """The joint of what turns about the axis of an instance."""
    return Revolute(key, at=one.centre, z=one.at[2], axis=one.axis)


def _slide(key: str, one: Instance) -> Prismatic:
    """The joint of what slides along the x axis of an instance."""
    if one.axis == Z:
        return Prismatic(key, direction=cmath.rect(1.0, one.rotation))
    x, y, z = (row[0] for row in one.scene_from_part.rotation)
    return Prismatic(key, direction=complex(x, y), rise=z)


def _following(mating: Mating, stand: Stand, body: str, *, laid: bool = False) -> Group:
    """The body of a mate's second, which stands wherever the first puts it; ``laid``: in the plane of the first."""
    first, own, leads = stand[mating.first], stand[mating.second], stand[body]
    plane = Placement3.towards(first.axis, 0.0, first.at) if laid else None
    start, before = (first.centre, first.rotation), 0.0
    (place, turn), (end, last) = (own.centre, own.rotation), (leads.centre, leads.rotation)
    if plane is not None:
        # there all frames begin at its origin
        start, before, end, last = (0j, first.rotation), first.rotation, 0j, 0.0
        place, turn = _pose_in(plane, own.scene_from_part)
    arm, lean = (end - place) * cmath.rect(1.0, -turn), last - turn

    # pairs that are held one after the other ask for the same turns of a cam
    followed = np.vectorize(
        lru_cache(_TURNS_KEPT)(lambda z, a: mating.followed(start, (complex(z), before + float(a)))), [complex, float]
    )

    def poses(given: list[tuple[Series, Series]]) -> list[tuple[Series, Series]]:
        ((origin, angle),) = given
        at, turned = followed(origin[0], angle[0])
        # how fast it goes is the cam's matter
        unknown = [np.full(np.shape(at), np.nan)] * (len(angle) - 1)
        return [([at + arm * np.exp(1j * turned), *unknown], [turned + lean, *unknown])]

    return Group((body,), (mating.first,), poses, (1, 1), plane, mating.counts_turns)


def _pose_in(plane: Placement3, frame: Placement3) -> Pose:
    """Origin and angle of a frame in the x, y plane of another one."""
    seen = plane.inverse() @ frame
    x, y, _ = seen.translation
    return complex(x, y), seen.turn


def driven_train(
    stand: Stand, matings: Sequence[Mating], drives: Sequence[DriveSpec], held: Sequence[str], source: str
) -> Train:
    """What the drives of a scene move.

    Raises
    ------
    SceneError
        A drive contradicts another one or what is held, or leaves free what it drives.
    """
    keys = tuple(drive.instance for drive in drives)
    for number, key in enumerate(keys):
        if key in keys[:number]:
            raise SceneError(source, f"drives[{number + 1}].instance", key, "driven_already", other=key)
    try:
        mechanism = scene_mechanism(stand, matings, held, keys)
        joined = _joined(mechanism, matings)
        _check_rings(matings, joined, source)
        stands = tree(mechanism)
        for key in keys:
            # before it is asked to turn or to slide, which it does neither
            if isinstance(stands.supports.get(stands.body(key)), Group):
                raise ParameterError("drives", key, "moves_by_law")
        runs = [
            _run(drive, slides(stands, drive.instance), f"drives[{n}]", source) for n, drive in enumerate(drives, 1)
        ]
        moved = moving(mechanism, [Drive(key, run) for key, run in zip(keys, runs, strict=True)])
    except ParameterError as refusal:
        raise _refused(refusal, keys, matings, source) from refusal
    meshing = {
        moved.stands.body(key) for j in mechanism.joints if isinstance(j, Rolling) for key in (j.first, j.second)
    }
    turned, slid = [], []
    for number, drive in enumerate(drives, 1):
        reached = _reached(drive.instance, joined)
        if free := [key for key in reached if key in moved.turns.free and moved.stands.body(key) in meshing]:
            raise SceneError(source, f"drives[{number}].instance", drive.instance, "leaves_free", free=free)
        shares = {key: moved.turns.shares.get(key, {}).get(drive.instance) for key in reached}
        run = {key: share * runs[number - 1] for key, share in shares.items() if share}
        turned.append({key: float(value) for key, value in run.items() if not slides(stands, key)})
        slid.append({key: float(value) * math.pi for key, value in run.items() if slides(stands, key)})
    in_space = frozenset(key for key, one in stand.items() if _in_space(key, one, moved))
    return Train(stand, moved, keys, tuple(turned), tuple(slid), _uneven(keys, joined, matings), in_space)


def _in_space(key: str, one: Instance, moved: Moving) -> bool:
    """Whether an instance moves otherwise than upright in the plane, or about its own axis, which stands still."""
    stands = moved.stands
    joint = stands.supports[stands.body(key)]
    if one.axis == Z and key in moved.starts:
        return False
    alone = isinstance(joint, Revolute) and stands.still(joint.on) and one_line(joint, _about(key, one))
    return not (alone or stands.still(key))


def _uneven(drives: Sequence[str], joined: Sequence[tuple[str, str]], matings: Sequence[Mating]) -> frozenset[str]:
    """What lies beyond noncircular gears, seen from the drives."""
    found: set[str] = set()
    for mating in matings:
        if mating.uneven:
            ends = (mating.first, mating.second)
            sides = [_reached(end, [pair for pair in joined if pair != ends]) for end in ends]
            found |= set(sides[0] if set(drives) & set(sides[1]) else sides[1])
    return frozenset(found)


def ratio_before(stand: Stand, matings: Sequence[Mating], mating: Mating) -> tuple[float, float] | None:
    """Turns of a mate's second for one of its first by the mates before it, and by itself; None where they are free."""
    joint = next((j for j in mating.joints if isinstance(j, Fixed | Rolling)), None)
    if joint is None or mating.holds:
        return None
    try:
        found = turns(scene_mechanism(stand, matings), (mating.first,)).shares.get(mating.second)
        closed = scene_mechanism(stand, [*matings, mating]).joints[-1]
    except ParameterError:
        # what cannot move is the drives' matter
        return None
    own = joint.ratio if isinstance(joint, Rolling) else Fraction(1)
    # seen from a carrier that turns too, only what turns alike has the ratio of its teeth
    turns_too = isinstance(closed, Rolling) and (closed.on != FRAME and own != 1)
    if not found or turns_too or (isinstance(joint, Rolling) and joint.kind == "rack"):
        return None
    return float(found[mating.first]), float(own)


def hanging_together(start: str, matings: Sequence[Mating]) -> list[str]:
    """What turns with an instance, before any of them is placed."""
    return _reached(start, [(m.first, m.second) for m in matings if not m.holds and any(map(_turns, m.joints))])


def _turns(joint: Joint) -> bool:
    return isinstance(joint, Fixed) or (isinstance(joint, Rolling) and joint.kind != "rack")


def _joined(mechanism: Mechanism, matings: Sequence[Mating]) -> list[tuple[str, str]]:
    """Which two instances each mate makes to move together; an axis alone does not."""
    stands = tree(mechanism)
    found = []
    for mating in matings:
        one, two = stands.supports[stands.body(mating.second)], stands.body(mating.first)
        carried = isinstance(one, Revolute) and one.on == two and any(isinstance(j, Revolute) for j in mating.joints)
        if carried or (not mating.holds and any(isinstance(j, Fixed | Rolling) for j in mating.joints)):
            found.append((mating.first, mating.second))
    return found


def _reached(start: str, joined: Sequence[tuple[str, str]]) -> list[str]:
    """What hangs together with an instance, nearest first."""
    found = [start]
    for here in found:
        for pair in joined:
            if here in pair:
                found += [key for key in pair if key not in found]
    return found


def _check_rings(matings: Sequence[Mating], joined: Sequence[tuple[str, str]], source: str) -> None:
    """A ring that its mate holds must not be joined to what turns in it."""
    for index, mating in enumerate(matings, 1):
        for ring in mating.holds:
            if mating.second in _reached(ring, joined):
                raise SceneError(source, f"mates[{index}].first", ring, "held_ring_is_joined", disc=mating.second)


def _refused(refusal: ParameterError, keys: Sequence[str], matings: Sequence[Mating], source: str) -> SceneError:
    """A refusal of the mechanism in the keys of the scene."""
    if refusal.code == "leaves_its_plane":
        place = next(f"mates[{n}].first" for n, m in enumerate(matings, 1) if m.follows and m.first == refusal.value)
        return SceneError(source, place, refusal.value, refusal.code)
    if refusal.code not in ("contradicts", "moves_by_law"):
        place = refusal.name if refusal.name.startswith("mates[") else "mates"
        return SceneError(source, place, refusal.value, refusal.code, None, "", **refusal.numbers)
    key = str(refusal.value)
    place = f"drives[{keys.index(key) + 1}].instance"
    if refusal.code == "moves_by_law":
        return SceneError(source, place, key, refusal.code)
    by = refusal.numbers["by"]
    assert isinstance(by, list)
    for ring, disc in [(ring, mating.second) for mating in matings for ring in mating.holds]:
        if ring in by:
            return SceneError(source, place, key, "drives_held_ring", ring=ring, disc=disc)
    if others := [other for other in by if other in keys and other != key]:
        return SceneError(source, place, key, "driven_already", other=others[0])
    return SceneError(source, place, key, "cannot_turn", by=by)

"""Instances of parts and where they stand: places given by the scene, mates in the order of the file, else a row.

Mates that join two placed instances only check. The frame of a scene is that of its first mate's first gear.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement3, Vector
from geometry.base.record import Record, replace
from geometry.base.tolerance import PLACED_MM, TOLERANCES
from parts.base.part import Part
from parts.base.refusal import REMOVED, SceneError, placed
from parts.scene.instances import DriveSpec, InstanceSpec
from parts.scene.standing import UPWARDS, Instance

if TYPE_CHECKING:
    from fractions import Fraction

    from geometry.curves.curve import Complex
    from parts.base.mate import Mating
    from parts.scene.train import Train

# mates whose second has no axle of its own on the frame, or moves with another instance
_CARRYING = (
    "fixed", "carried", "pin_seat", "eccentric_bearing", "cam_follower", "linkage_member", "lever_member",
    "wedge_follower",
)  # fmt: skip
# between things that no mate and no ``at`` places, mm; parts of an axis that are none
_GAP, _STRAIGHT = 5.0, 1e-12
# between axes that are to be one direction, rad
_SAME_AXIS = 1e-7


class Condition(Record):
    """What two placed instances must satisfy: ``value`` within ``tolerance`` of ``required``.

    ``code`` with unit: "centre_distance" mm, "apex_distance" mm, "shaft_angle" degrees, "phase" (rotation of the
    second) degrees, "fixed_phase" (the same in the first's frame), "placed_phase" (the same by the key of the mate
    that has placed it), "held_phase" (of one that other mates hold), "common_face_width" mm (at least),
    "train" (turns of the second for one of the first).
    """

    code: str
    value: float
    required: float
    tolerance: float
    met: bool


class PlacedMate(Record):
    """A mate between two instances that stand; one that ``only_checks`` found both placed, and has conditions.

    ``second_turn`` (rad) and ``centre_shift`` (mm) tell how far such a mate is off the exact pair.
    """

    mating: Mating
    first: Instance
    second: Instance
    only_checks: bool = False
    conditions: tuple[Condition, ...] = ()
    second_turn: float = 0.0
    centre_shift: float = 0.0

    @property
    def direction(self) -> float:
        """Direction of the line of centres as placed, about the first's axis from its x as it is laid, rad."""
        first, second = seen_from(self.first, self.second)
        return self.mating.centres_direction(second.centre - first.centre, second.scene_from_part)

    def rollers(self, turned: float = 0.0) -> tuple[Complex, float] | None:
        """The rollers of a chain that runs upright, its first ``turned`` on, rad, and their radius, mm; else None."""
        if self.first.axis != UPWARDS:
            return None
        one, two = self.mating.teeth
        poses = [(i.centre, i.rotation + turn) for i, turn in ((self.first, turned), (self.second, turned * one / two))]
        return self.mating.rollers(poses[0], poses[1])

    def idlers(self) -> list[tuple[complex, float]]:
        """Axes and radii, mm, of what guides such a chain and is no instance."""
        if self.first.axis != UPWARDS:
            return []
        return self.mating.idlers((self.first.centre, self.first.rotation), (self.second.centre, self.second.rotation))


class Closeness(Record):
    """Two instances that no mate joins, nearer than their tip circles allow: they may touch as they turn."""

    first: str
    second: str
    distance: float
    tip_sum: float


class OffCentre(Record):
    """An axle that passes a hole of a flat part off its centre by more than the clearance; mm."""

    frame: str
    axle: str
    distance: float
    clearance: float


class Placing(Record):
    """Where everything stands, and the train that the drives move."""

    instances: tuple[Instance, ...]
    mates: tuple[PlacedMate, ...] = ()
    close: tuple[Closeness, ...] = ()
    train: Train | None = None
    off_centre: tuple[OffCentre, ...] = ()

    @property
    def turns(self) -> tuple[dict[str, float], ...]:
        """For each drive, how often it turns each instance of its train."""
        return self.train.turned if self.train else ()

    def at(self, values: Sequence[float | Fraction]) -> tuple[Instance, ...]:
        """The instances when each drive has run that far: turns, or mm of a slide."""
        if self.train is None or not any(values):
            return self.instances
        train = self.train.set(values)
        return tuple(_moved(instance, train) for instance in self.instances)

    @property
    def needs_check(self) -> bool:
        """Whether there is anything to check or to tell: mates, neighbours that are too close, axles, drives."""
        return bool(self.mates or self.close or self.off_centre or self.turns)


def place(
    specs: dict[str, InstanceSpec],
    drives: Sequence[DriveSpec],
    parts: dict[str, Part],
    matings: list[Mating],
    source: str,
) -> Placing:
    """Put every instance of a scene in its place.

    Raises
    ------
    SceneError
        A mate asks for an instance that nothing has placed before; a drive meets another one.
    """
    placed = _Placed(specs, parts, matings, source)
    mates = tuple(placed.join(index, mating) for index, mating in enumerate(matings))
    placed.lay_out()
    stand = placed.stand
    placers = {m.mating.second: m.mating for m in mates if not m.only_checks}
    mates = tuple(
        _closed(replace(m, first=stand[m.mating.first], second=stand[m.mating.second]), placers) for m in mates
    )
    mates = _with_faces_and_speeds(mates, parts)
    instances = tuple(replace(stand[i], subassembly=spec.subassembly) for i, spec in specs.items())
    train = None
    if drives:
        from parts.scene.train import driven_train

        held = [key for key, spec in specs.items() if spec.held is True]
        train = driven_train({i.id: i for i in instances}, matings, drives, held, source)
    close = _close_ones(instances, mates, parts)
    return Placing(instances, mates, close, train, tuple(_off_centre(instances, matings, parts)))


def _moved(instance: Instance, train: Train) -> Instance:
    """An instance where its train has put it."""
    import numpy as np

    if instance.id in train.in_space:
        turned, place = train.placed(instance.id, np.zeros(()))
        rows = tuple((a, b, c) for a, b, c in turned.tolist())
        x, y, z = place.tolist()
        return _placed_so(instance, Placement3((rows[0], rows[1], rows[2]), (x, y, z)))
    at, rotation = train.along(instance.id, np.zeros(()))
    centre = complex(at)
    return replace(instance, at=(centre.real, centre.imag, instance.at[2]), rotation=float(rotation))


class _Placed:
    """Instances that stand so far, in groups: the members of a free group move together when the row is laid out."""

    def __init__(
        self, specs: dict[str, InstanceSpec], parts: dict[str, Part], matings: list[Mating], source: str
    ) -> None:
        self.specs, self.parts, self.matings, self.source = specs, parts, matings, source
        self.stand: dict[str, Instance] = {}
        self.free: list[list[str]] = []
        for key, spec in specs.items():
            if spec.at is not None:
                x, y, z = spec.at
                self.stand[key] = Instance(key, str(spec.part), (x, y, z), _turned(spec), "at", _axis(spec))

    def join(self, index: int, mating: Mating) -> PlacedMate:
        """Run one mate: place its second, or only note that both stand."""
        first, second = mating.first, mating.second
        if first not in self.stand:
            self._begin(index, mating)
        here = self.stand[first]
        if second in self.stand:
            there = self.stand[second]
            return _laid(mating, here, there) if mating.lies else PlacedMate(mating, here, there, only_checks=True)
        if self.specs[second].rotation_deg is not None:
            place, given = f"instances.{second}.rotation_deg", self.specs[second].rotation_deg
            raise SceneError(self.source, place, given, "turned_into_mesh", REMOVED, mate=f"mates[{index + 1}]")
        direction = math.radians(mating.direction_deg)
        lying = here.axis != UPWARDS
        try:
            centre, turned = mating.second_pose(0j if lying else here.centre, here.rotation, direction)
        except ParameterError as refusal:
            raise placed(self.source, f"mates[{index + 1}]", refusal) from refusal
        at = (centre.real, centre.imag, mating.height + (0.0 if lying else here.at[2]))
        axis = _axis_of_second(mating, here)
        there = Instance(second, str(self.specs[second].part), at, turned, "mate", axis)
        self.stand[second] = _placed_so(there, _frame(here) @ there.scene_from_part) if lying else there
        for group in self.free:
            if first in group:
                group.append(second)
        return PlacedMate(mating, here, self.stand[second])

    def _begin(self, index: int, mating: Mating) -> None:
        """Place the first of a mate that nothing has placed: the very first at the origin, a new train in the row."""
        first, place = mating.first, f"mates[{index + 1}].first"
        if index:
            from parts.scene.train import hanging_together

            train = hanging_together(first, self.matings)
            later = next((i for i, m in enumerate(self.matings) if i > index and m.second == first), None)
            if later is not None:
                raise SceneError(self.source, place, first, "placed_later", None, mate=f"mates[{later + 1}]")
            standing = [i for i in self.stand if i in train]
            if mating.second in standing:
                if not self._either_way(mating):
                    early = {"second": mating.second, "first": first}
                    raise SceneError(self.source, place, first, "placed_too_early", None, "", **early)
                angle = math.degrees(math.remainder(math.radians(mating.direction_deg + 180), 2 * math.pi))
                told = {"second": mating.second, "angle": angle, "first": first}
                raise SceneError(self.source, place, first, "placed_is_the_second", None, "", **told)
            if standing:
                raise SceneError(self.source, place, first, "not_placed", None, standing=standing[0], first=first)
            self.free.append([first])
        self.stand[first] = Instance(first, str(self.specs[first].part), rotation=_turned(self.specs[first]))

    def _either_way(self, mating: Mating) -> bool:
        """Whether a mate also joins both the other way round: two gears, but no worm and its wheel."""
        from parts.mates.registry import MATES

        one, two = (self.parts[str(self.specs[i].part)].made_by.name for i in (mating.first, mating.second))
        joined = {pair for mate in MATES.values() for pair in mate.joins or ()}
        return mating.rolls is not None and {(one, two), (two, one)} <= joined

    def lay_out(self) -> None:
        """What no mate and no ``at`` places goes into a row to the right of all else, or to the origin."""
        for key, spec in self.specs.items():
            if key not in self.stand and not self._axles(key):
                alone = not self.stand
                self.stand[key] = Instance(key, str(spec.part), rotation=_turned(spec))
                if not alone:
                    self.free.append([key])
        self._lay_in_row()
        for key in [key for key in self.specs if key not in self.stand]:
            # a frame lies under the axles that it has holes for, its frame that of the scene
            here = Instance(key, str(self.specs[key].part), rotation=_turned(self.specs[key]), placed_by="axles")
            low = min((self.stand[axle].at[2] for axle in self._axles(key) if axle in self.stand), default=0.0)
            self.stand[key] = replace(here, at=(0.0, 0.0, low - self.parts[here.part].face_width))

    def _axles(self, key: str) -> list[str]:
        """The instances whose axles go through holes of an instance."""
        part = self.parts[str(self.specs[key].part)]
        return [hole.axle for hole in part.made_by.holes_at(part.keys) if hole.axle is not None]

    def _lay_in_row(self) -> None:
        """Each free group to the right of all else."""
        if not self.free:
            return
        waiting = {key for group in self.free for key in group}
        right = max(self._edge(key, 1) for key in self.stand if key not in waiting)
        for group in self.free:
            shift = right + _GAP - min(self._edge(key, -1) for key in group)
            for key in group:
                here = self.stand[key]
                how = "row" if here.placed_by == "origin" else here.placed_by
                self.stand[key] = replace(here, at=(here.at[0] + shift, here.at[1], here.at[2]), placed_by=how)
            right = max(self._edge(key, 1) for key in group)

    def _edge(self, key: str, side: int) -> float:
        """How far an instance reaches to the right (side 1) or left (-1), mm."""
        here = self.stand[key]
        part = self.parts[here.part]
        return here.at[0] + side * (_reach(part) + (part.face_width if here.axis != UPWARDS else 0.0))


def _frame(here: Instance) -> Placement3:
    """Where an instance is laid, not turned about its axis."""
    return Placement3.towards(here.axis, 0.0, here.at)


def _placed_so(instance: Instance, found: Placement3) -> Instance:
    """An instance whose frame stands so."""
    # rounding of what is straight would turn it another way
    way = [0.0 if abs(share) < _STRAIGHT else share for share in found.z]
    x, y, z = (value / math.hypot(*way) for value in way)
    turn = (Placement3.towards((x, y, z), 0.0).inverse() @ found).turn
    return replace(instance, at=found.translation, rotation=turn, axis=(x, y, z))


def seen_from(first: Instance, second: Instance) -> tuple[Instance, Instance]:
    """Both in the frame in which the first is laid; of an upright one that is the scene's own."""
    if first.axis == UPWARDS:
        return first, second
    local = _placed_so(second, _frame(first).inverse() @ second.scene_from_part)
    return replace(first, at=(0.0, 0.0, 0.0), axis=UPWARDS), local


def _axis(spec: InstanceSpec) -> Vector:
    if spec.axis is None:
        return UPWARDS
    x, y, z = (value / math.hypot(*spec.axis) for value in spec.axis)
    return x, y, z


def _turned(spec: InstanceSpec) -> float:
    return math.radians(spec.rotation_deg or 0.0)


def _reach(part: Part) -> float:
    """Greatest distance of a part from its axis, mm."""
    if part.kind == "spur_gear":
        return part.circles["tip_diameter"] / 2
    return part.section(0.0).region.outer.reach()


def _hangs(one: str, other: str, placers: dict[str, Mating]) -> bool:
    """Whether mates have placed one instance from another on."""
    while (mating := placers.get(one)) is not None and one != other:
        one = mating.first
    return one == other


def _closed(mate: PlacedMate, placers: dict[str, Mating]) -> PlacedMate:
    """A mate between two instances that stood before it: centre distance and phase, with the numbers.

    ``placers``: the mates that have placed instances, by these.
    """
    if not mate.only_checks:
        return mate
    from parts.base.mate import Toothed

    first, second = seen_from(mate.first, mate.second)
    turned = first.rotation
    if isinstance(mate.mating, Toothed):
        # helical teeth are compared at one height: that of the second's lower face
        turned += mate.mating.face.turn(mate.mating.teeth[0], second.at[2] - first.at[2])
    found = mate.mating.standing((first.centre, turned), (second.centre, second.rotation))
    if found is None:
        return mate
    required, shift = mate.mating.distance, found.distance - mate.mating.distance
    # numbers that large cannot be known better
    allowed = PLACED_MM + TOLERANCES.relative_join * (abs(mate.first.centre) + abs(mate.second.centre))
    conditions = [Condition("centre_distance", found.distance, required, allowed, abs(shift) <= allowed)]
    if (lean := _lean(mate.mating, first, second)) is not None:
        conditions.append(lean)
    off, met = found.phase_off, abs(found.phase_off) <= found.play + found.slack(allowed)
    if found.slides:
        conditions.append(Condition("rack_phase", off, 0.0, found.play + allowed, met))
    else:
        # where a key of the mate turns the second, or of the mate that has placed it, that key is what makes it fit
        asked, placer = mate.mating.asked_turn, placers.get(mate.mating.second)
        typed = None if placer is None else placer.placed_turn
        code, turn = ("phase", mate.second.rotation) if asked is None else ("fixed_phase", asked + off)
        if asked is None and typed is not None and mate.second.axis == UPWARDS:
            code, turn = "placed_phase", typed
        elif asked is None and (isinstance(placer, Toothed) or _hangs(mate.mating.first, mate.mating.second, placers)):
            code = "held_phase"
        slack = math.degrees(found.play + found.slack(allowed))
        conditions.append(Condition(code, math.degrees(turn), math.degrees(turn - off), slack, met))
    return replace(mate, conditions=tuple(conditions), second_turn=off, centre_shift=shift)


def _lean(mating: Mating, first: Instance, second: Instance) -> Condition | None:
    """Whether the second's axis points as the first's frame wants it; None of two that are both upright in it."""
    wanted = _axis_of_second(mating, first)
    if second.axis == wanted == UPWARDS:
        return None
    seen = Placement3.towards(wanted, 0.0).inverse() @ second.scene_from_part
    x, y, z = seen.z
    angle, allowed = math.degrees(math.atan2(math.hypot(x, y), z)), math.degrees(_SAME_AXIS)
    return Condition("shaft_angle", angle, 0.0, allowed, angle <= allowed)


def _axis_of_second(mating: Mating, first: Instance) -> Vector:
    """The axis that a mate gives its second where the first stands so, upright."""
    x, y, z = mating.second_axis(math.radians(mating.direction_deg))
    if not mating.turns_axis or x == y == 0:
        return x, y, z
    aside = complex(x, y) * cmath.rect(1.0, first.rotation)
    return aside.real, aside.imag, z


def _laid(mating: Mating, first: Instance, second: Instance) -> PlacedMate:
    """The same of two whose axes make an angle."""
    frames = first.scene_from_part, second.scene_from_part
    found, mating = mating.laid_standing(*frames), mating.laid(*frames)
    size = math.hypot(*first.at) + math.hypot(*second.at)
    allowed = PLACED_MM + TOLERANCES.relative_join * size
    leaning, off = found.angle - found.required, found.phase_off
    slack, lean = found.play + allowed / found.arm, allowed / found.reach
    turned, right = math.degrees(second.rotation), math.degrees(second.rotation - off)
    conditions = (
        Condition(found.code, found.apart, found.distance, allowed, abs(found.apart - found.distance) <= allowed),
        Condition("shaft_angle", math.degrees(found.angle), math.degrees(found.required), math.degrees(lean),
                  abs(leaning) <= lean),
        Condition("phase", turned, right, math.degrees(slack), abs(off) <= slack),
    )  # fmt: skip
    return PlacedMate(mating, first, second, True, conditions, second_turn=off)


def _with_faces_and_speeds(mates: tuple[PlacedMate, ...], parts: dict[str, Part]) -> tuple[PlacedMate, ...]:
    """The same mates with the conditions that concern their height and the motion of the whole train."""
    done = []
    for index, mate in enumerate(mates):
        more: list[Condition] = []
        upright = seen_from(mate.first, mate.second)[1].axis == UPWARDS
        if (mate.conditions and mate.mating.asks_height) or (
            mate.mating.has_contact and mate.mating.height and upright and not mate.mating.lies
        ):
            more.append(_height(mate, parts))
        if mate.only_checks:
            from parts.base.mate import Toothed

            if isinstance(mate.mating, Toothed) and (face := mate.mating.face).helix.angle:
                first, second = seen_from(mate.first, mate.second)
                width = max(_common_width(first, second, parts), 0.0)
                mate = replace(mate, mating=replace(mate.mating, face=replace(face, width=width)))
                if face.helix.double:
                    height = second.at[2] - first.at[2]
                    more.append(Condition("herringbone_height", height, 0.0, PLACED_MM, abs(height) <= PLACED_MM))
            if ratios := _ratios(index, mates):
                other, ratio = ratios
                allowed = 1e3 * TOLERANCES.relative_rounding * max(abs(ratio), abs(other))
                more.append(Condition("train", other, ratio, allowed, abs(other - ratio) <= allowed))
        done.append(replace(mate, conditions=(*mate.conditions, *more)))
    return tuple(done)


def _ratios(index: int, mates: tuple[PlacedMate, ...]) -> tuple[float, float] | None:
    """Turns of a mate's second for one of its first by the mates before it, and by itself."""
    from parts.scene.train import ratio_before

    stand = {one.id: one for mate in mates[: index + 1] for one in (mate.first, mate.second)}
    return ratio_before(stand, [mate.mating for mate in mates[:index]], mates[index].mating)


def _height(mate: PlacedMate, parts: dict[str, Part]) -> Condition:
    """Bodies that touch need a common height; bodies that are fixed stand at a height to each other."""
    first, second = seen_from(mate.first, mate.second)
    if mate.mating.has_contact:
        width = _common_width(first, second, parts)
        return Condition("common_face_width", width, 0.0, 0.0, width > 0)
    height, required = second.at[2] - first.at[2], mate.mating.height
    return Condition("height", height, required, PLACED_MM, abs(height - required) <= PLACED_MM)


def _common_width(one: Instance, two: Instance, parts: dict[str, Part]) -> float:
    """Length of the common range along the axes, mm; negative where there is none."""
    low = max(one.at[2], two.at[2])
    return min(i.at[2] + parts[i.part].face_width for i in (one, two)) - low


def _off_centre(
    instances: Sequence[Instance], matings: Sequence[Mating], parts: dict[str, Part]
) -> Iterator[OffCentre]:
    """Axles that do not go through the holes of plates: those that a hole is for, and others that stand in one."""
    carried = {mating.second for mating in matings if mating.kind in _CARRYING}
    upright = [(i, parts[i.part]) for i in instances if i.axis == UPWARDS]
    for frame, plate in upright:
        for hole in plate.made_by.holes_at(plate.keys):
            if hole.centre is None:
                continue
            centre = frame.centre + hole.centre * cmath.exp(1j * frame.rotation)
            for axle, wheel in upright:
                distance, own = abs(axle.centre - centre), axle.id == hole.axle and not hole.beside
                if axle is frame or not (own or distance < hole.diameter / 2):
                    continue
                bore = _axle_diameter(axle, wheel, frame, plate, upright)
                slack = PLACED_MM + TOLERANCES.relative_join * (abs(axle.centre) + abs(centre))
                clearance = max((hole.diameter - bore) / 2, 0.0) if bore else 0.0
                stands_in = axle.id not in carried and 0 < bore <= hole.diameter
                if (own or stands_in) and distance > clearance + slack:
                    yield OffCentre(frame.id, axle.id, distance, clearance)


def _axle_diameter(
    axle: Instance, wheel: Part, frame: Instance, plate: Part, upright: Sequence[tuple[Instance, Part]]
) -> float:
    """Of the rod that stands on the axis of an instance and in a plate, mm; without one that of the instance's bore."""
    low, high = frame.at[2], frame.at[2] + plate.face_width
    for other, rod in upright:
        stands = other is not axle and other.at[2] < high and other.at[2] + rod.face_width > low
        if stands and (stock := rod.stock) and not stock.bore and abs(other.centre - axle.centre) <= PLACED_MM:
            return stock.diameter
    return wheel.made_by.axle_diameter(wheel.keys)


def _close_ones(
    instances: Sequence[Instance], mates: Sequence[PlacedMate], parts: dict[str, Part]
) -> tuple[Closeness, ...]:
    """Spur gears at one height whose tip circles cut each other though no mate joins them."""
    joined = {frozenset((m.first.id, m.second.id)) for m in mates}
    gears = [i for i in instances if parts[i.part].kind == "spur_gear" and i.axis == UPWARDS]
    if len(gears) < 2:
        return ()
    import numpy as np

    tips = {part: parts[part].circles["tip_diameter"] / 2 for part in {i.part for i in gears}}
    centres, radii = np.array([i.centre for i in gears]), np.array([tips[i.part] for i in gears])
    found = []
    for k, one in enumerate(gears):
        # one within the other's bore is for the solids to tell
        distances, both = np.abs(centres[k + 1 :] - centres[k]), radii[k + 1 :] + radii[k]
        slack = TOLERANCES.relative_join * (np.abs(centres[k + 1 :]) + abs(centres[k]) + both)
        close = (np.abs(radii[k + 1 :] - radii[k]) < distances) & (distances < both - slack)
        for number in np.flatnonzero(close).tolist():
            two = gears[k + 1 + number]
            if frozenset((one.id, two.id)) not in joined and _common_width(one, two, parts) > 0:
                found.append(Closeness(one.id, two.id, float(distances[number]), float(both[number])))
    return tuple(found)

"""A gear train as it is typed: teeth, meshes, shafts, carriers; its mechanism, and the stages it consists of.

Wheels are named as the sources name them: 1, 2, 2', 3; what is named by the same number stands on one shaft.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from fractions import Fraction
from typing import TypeVar

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record
from geometry.kinematics.mechanism import FRAME, Fixed, Kind, Mechanism, Revolute, Rolling, Z
from parts.base.texts import message

KINDS: tuple[Kind, ...] = ("external", "internal", "bevel", "worm", "crossed")
# those whose axes are not parallel: the ratio has no sign but where it is told
ACROSS: tuple[Kind, ...] = ("bevel", "worm", "crossed")
# the word of such a sign
_SENSES = {"+": 1, "-": -1}
_ACROSS = (1.0, 0.0, 0.0)
_MESH = re.compile(r"\s*([^\s-]+)\s*-\s*([^\s-]+)((?:\s+\S+)*)\s*")


class Mesh(Record):
    """Two wheels in mesh, by their names, and the module, mm, where it has one of its own."""

    first: str
    second: str
    kind: Kind
    module: Fraction | None = None
    # of a pair on axes that are not parallel, where it is told: which way the second turns, as the carrier sees it
    sense: int = 0

    @property
    def name(self) -> str:
        """As the sources write it: 1-2."""
        return f"{self.first}-{self.second}"


class Train(Record):
    """Teeth by wheel, meshes, the body (shaft) of every wheel and carrier, the carrier of every satellite's body."""

    teeth: Mapping[str, int]
    meshes: tuple[Mesh, ...]
    bodies: Mapping[str, str]
    carried: Mapping[str, str]
    held: tuple[str, ...]

    def carrier(self, mesh: Mesh) -> str:
        """The body that carries the axes of a mesh: the frame, or the carrier of the satellite in it."""
        one, two = (self.carried.get(self.bodies[wheel], FRAME) for wheel in (mesh.first, mesh.second))
        return one if one != FRAME else two

    def ratio(self, mesh: Mesh) -> Fraction:
        """u_12 of a mesh as its carrier sees it: w1 / w2, below 0 where it is external; others by ``sense``."""
        return Fraction(self.teeth[mesh.second], self.teeth[mesh.first]) * self.sense(mesh)

    def sense(self, mesh: Mesh) -> int:
        """-1 where the second turns the other way, as the carrier sees it.

        Those ``ACROSS`` on the frame have no sign (guidelines). Of a bevel satellite's meshes the first has -1, so that
        central wheels, which are counted about one axis, turn in opposite ways: they face each other.
        """
        if mesh.kind != "bevel":
            return mesh.sense or (-1 if mesh.kind == "external" else 1)
        own = {self.bodies[mesh.first], self.bodies[mesh.second]} & self.carried.keys()
        first = next((m for m in self.meshes if own & {self.bodies[m.first], self.bodies[m.second]}), None)
        return mesh.sense or (-1 if first == mesh else 1)

    @property
    def across(self) -> set[str]:
        """Bodies of bevel satellites, whose axes are across that of their carrier."""
        ends = {
            self.bodies[wheel] for mesh in self.meshes if mesh.kind == "bevel" for wheel in (mesh.first, mesh.second)
        }
        return ends & self.carried.keys()

    def mechanism(self) -> Mechanism:
        """All axes in one, which changes nothing of how a train turns; those of bevel satellites lie across it."""
        joints: list[Revolute | Fixed | Rolling] = []
        across = self.across
        for name, body in self.bodies.items():
            if name != body:
                joints.append(Fixed(name, body))
                continue
            joints.append(Revolute(body, self.carried.get(body, FRAME), axis=_ACROSS if body in across else Z))
        for mesh in self.meshes:
            pair = self.teeth[mesh.first], self.teeth[mesh.second]
            joints.append(Rolling(mesh.kind, mesh.first, mesh.second, pair, self.carrier(mesh), self.sense(mesh)))
        return Mechanism(tuple(joints), tuple(dict.fromkeys(self.bodies[name] for name in self.held)))

    def still(self, body: str) -> bool:
        """Whether a body is held."""
        return body == FRAME or any(self.bodies[name] == body for name in self.held)


class Leg(Record):
    """A way through a mesh: from one wheel to another, with its ratio as the carrier sees it."""

    mesh: Mesh
    start: str
    end: str
    ratio: Fraction


class Stage(Record):
    """A part of the way from driver to driven: meshes about fixed axes, or a planetary set with its third link held.

    ``legs`` lead from wheel to wheel; with a carrier from the central wheel ``start`` to the held one, ``inverse``
    where power goes from the carrier to that wheel. ``ratio``: w_start / w_end of the stage as it runs.
    """

    start: str
    end: str
    legs: tuple[Leg, ...]
    ratio: Fraction
    carrier: str = ""
    held: str = ""


S = TypeVar("S", bound=Leg | Stage)


def parsed(
    teeth: Mapping[str, int], meshes: str, shafts: str = "", carriers: Mapping[str, str] | None = None, held: str = ""
) -> Train:
    """A train from its words: ``"1-2, 2'-3 internal 3.5"``, ``"H-5"``, ``{"H": "2"}``, ``"4"``.

    Raises
    ------
    ParameterError
        A word names no wheel, a wheel meshes itself, satellites stand on two carriers, or a carrier holds nothing.
    """
    carriers = carriers or {}
    read = tuple(_mesh(word, teeth) for word in _words(meshes))
    bodies = _bodies(teeth, carriers, shafts)
    carried: dict[str, str] = {}
    for carrier, satellites in carriers.items():
        for name in _words(satellites):
            body = _body(bodies, name, f"carriers.{carrier}")
            if body == bodies[carrier]:
                raise ParameterError(f"carriers.{carrier}", name, "stands_on_itself")
            if carried.get(body, bodies[carrier]) != bodies[carrier]:
                raise ParameterError(f"carriers.{carrier}", name, "stands_on_two", None, on=carried[body])
            carried[body] = bodies[carrier]
    for mesh in read:
        if bodies[mesh.first] == bodies[mesh.second]:
            raise ParameterError("meshes", mesh.name, "rolls_on_itself")
    for carrier in carriers:
        if not any(carried.get(bodies[w]) == bodies[carrier] for mesh in read for w in (mesh.first, mesh.second)):
            raise ParameterError(f"carriers.{carrier}", carriers[carrier], "carrier_without_satellites")
    fixed = _words(held)
    for name in fixed:
        _body(bodies, name, "held")
    return Train(dict(teeth), read, bodies, carried, tuple(fixed))


def _words(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]


def _mesh(word: str, teeth: Mapping[str, int]) -> Mesh:
    found = _MESH.fullmatch(word)
    if found is None:
        raise ParameterError("meshes", word, "write_mesh")
    first, second, rest = found[1], found[2], found[3].split()
    if first == second:
        raise ParameterError("meshes", word, "rolls_on_itself")
    if not teeth:
        what = message("numbers of teeth of wheels 1, 2, … in a list, as [20, 40]")
        raise ParameterError("teeth", None, "missing_key", None, what=what)
    for name in (first, second):
        if name not in teeth:
            raise ParameterError("meshes", word, "no_such_wheel", None, wheel=name, known=list(teeth))
    kind: Kind = "external"
    module, sense = None, 0
    for more in rest:
        if more in _SENSES and kind in ACROSS:
            sense = _SENSES[more]
        elif named := next((name for name in KINDS if name == more), None):
            kind = named
        elif re.fullmatch(r"\d+(\.\d+)?", more) and float(more) > 0:
            module = Fraction(more)
        else:
            raise ParameterError("meshes", word, "no_such_mesh", _meant(more), known=list(KINDS))
    if kind == "internal" and teeth[first] == teeth[second]:
        raise ParameterError("meshes", word, "ring_as_its_wheel")
    return Mesh(first, second, kind, module, sense)


def _meant(word: str) -> Nearest | None:
    return next((Nearest(kind, "meant") for kind in KINDS if word and kind.startswith(word[0])), None)


def _bodies(teeth: Mapping[str, int], carriers: Mapping[str, str], shafts: str) -> dict[str, str]:
    """The first name on each shaft, by all its names."""
    bodies = {name: name for name in (*teeth, *carriers)}
    groups = [[name, name.rstrip("'")] for name in teeth if name.endswith("'") and name.rstrip("'") in teeth]
    for word in _words(shafts):
        names = [name.strip() for name in word.split("-")]
        if len(names) < 2:
            raise ParameterError("shafts", word, "write_shaft")
        for name in names:
            _body(bodies, name, "shafts")
        groups.append(names)
    order = list(bodies)
    for names in groups:
        joined = {bodies[name] for name in names}
        kept = min(joined, key=order.index)
        bodies = {name: kept if body in joined else body for name, body in bodies.items()}
    return bodies


def _body(bodies: Mapping[str, str], name: str, key: str) -> str:
    if name not in bodies:
        raise ParameterError(key, name, "no_such_link", None, known=list(bodies))
    return bodies[name]


def stages(train: Train, driver: str, driven: str) -> tuple[Stage, ...] | None:
    """The stages one after the other from a driver to the driven link; None: the train is no such row of stages."""
    start, end = train.bodies[driver], train.bodies[driven]
    moving = [stage for stage in (*_fixed(train), *_planetary(train)) if not train.still(train.bodies[stage.end])]
    ways = _ways(train, moving, start)
    return _joined(ways[end]) if end in ways and end != start else None


def _joined(found: Sequence[Stage]) -> tuple[Stage, ...]:
    """Meshes about fixed axes one after the other as one stage."""
    made: list[Stage] = []
    for stage in found:
        if made and not made[-1].carrier and not stage.carrier:
            last = made.pop()
            stage = Stage(last.start, stage.end, (*last.legs, *stage.legs), last.ratio * stage.ratio)
        made.append(stage)
    return tuple(made)


def _legs(train: Train, carrier: str) -> list[Leg]:
    """Both ways through each mesh of a carrier."""
    found = []
    for mesh in train.meshes:
        if train.carrier(mesh) == carrier:
            ratio = train.ratio(mesh)
            found += [Leg(mesh, mesh.first, mesh.second, ratio), Leg(mesh, mesh.second, mesh.first, 1 / ratio)]
    return found


def _fixed(train: Train) -> list[Stage]:
    """Each mesh about fixed axes, both ways; those of a held carrier are such too."""
    carriers = [FRAME, *(c for c in dict.fromkeys(train.carried.values()) if train.still(c))]
    return [Stage(leg.start, leg.end, (leg,), leg.ratio) for c in carriers for leg in _legs(train, c)]


def _planetary(train: Train) -> list[Stage]:
    """Central wheel or satellite to carrier and back, another wheel held."""
    found = []
    for carrier in dict.fromkeys(train.carried.values()):
        if train.still(carrier):
            continue
        legs, name = _legs(train, carrier), _named(train, carrier)
        for start in dict.fromkeys(train.bodies[leg.start] for leg in legs):
            ways = _ways(train, legs, start)
            way = next((ways[body] for body in ways if train.still(body)), ())
            if not way:
                continue
            if (ratio := math.prod((leg.ratio for leg in way), start=Fraction(1))) != 1:
                run = 1 - ratio
                found.append(Stage(way[0].start, name, way, run, name, way[-1].end))
                found.append(Stage(name, way[0].start, way, 1 / run, name, way[-1].end))
    return found


def _named(train: Train, carrier: str) -> str:
    """A carrier's own name: that which is no wheel."""
    return next((n for n, body in train.bodies.items() if body == carrier and n not in train.teeth), carrier)


def _ways(train: Train, steps: Sequence[S], start: str) -> dict[str, tuple[S, ...]]:
    """The shortest way from a body, through meshes of one carrier or by stages, to each body, the nearest first."""
    ways: dict[str, tuple[S, ...]] = {start: ()}
    waiting = [start]
    for body in waiting:
        for step in steps:
            after = train.bodies[step.end]
            if train.bodies[step.start] == body and after not in ways:
                ways[after] = (*ways[body], step)
                waiting.append(after)
    return ways


def central_ways(train: Train, carrier: str) -> list[tuple[Leg, ...]]:
    """The ways from the first central wheel of a carrier through its satellites to each other one."""
    legs = _legs(train, carrier)
    central = next((body for leg in legs if (body := train.bodies[leg.start]) not in train.carried), None)
    if central is None:
        return []
    return [way for body, way in _ways(train, legs, central).items() if way and body not in train.carried]


def satellites(train: Train) -> list[Stage]:
    """Each satellite against its carrier where a wheel of its set is held; about axes along the carrier's."""
    bodies = set(train.carried) - train.across
    return [stage for stage in _planetary(train) if train.bodies[stage.start] in bodies]

"""The sheet of a scene's train: who meshes with whom and is carried by whom, unfolded into one plane."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from exporters.production.request import Request
from geometry.base.placement import Placement3
from geometry.base.tolerance import PLACED_MM
from geometry.kinematics.mechanism import FRAME, Group, Revolute, Rolling, Support, Tree, parallel
from parts.base.mate import Toothed
from parts.drawing.choice import Asked
from parts.drawing.expected import Expected
from parts.drawing.names import caption_name
from parts.mates.sheets.train_picture import Link, Rim, TrainPicture
from parts.mates.sheets.train_sheet import train_sheet
from parts.scene.placing import Placing, seen_from
from parts.scene.standing import UPWARDS, Instance
from parts.scene.train import Train


def train_sheets(wanted: Request, asked: Asked) -> list[tuple[str, Expected]]:
    """The sheet of the gears that the drives of a scene move.

    Raises
    ------
    SceneError
        No drive moves gears on parallel axes.
    """
    placing = wanted.placing
    meshes = _meshes(placing)
    if placing.train is None or not meshes:
        raise wanted.refused("purpose", wanted.export.purpose, "shows_driven_gears")
    picture, rims = train_picture(placing.train, meshes, placing.instances)
    told = [caption_name(wanted.parts[part]) for part in rims]
    return [("", train_sheet(wanted.title, picture, told, asked))]


def _meshes(placing: Placing) -> list[Rolling]:
    """The meshes of gears that move."""
    if placing.train is None:
        return []
    gears = {(m.first.id, m.second.id) for m in placing.mates if isinstance(m.mating, Toothed) and m.mating.in_scheme}
    moved = placing.train.moving
    rolling = [
        j for j in moved.stands.mechanism.joints if isinstance(j, Rolling) and j.kind in ("external", "internal")
    ]
    shares, stand = moved.turns.shares, placing.train.stand
    found = [j for j in rolling if (j.first, j.second) in gears and (shares.get(j.first) or shares.get(j.second))]
    # a scheme shows gears on parallel axes: those of the driver, or of the first that it moves
    wheels = [key for j in found for key in (j.first, j.second)]
    driver = placing.train.drives[0]
    own = [key for key in wheels if moved.stands.body(key) == moved.stands.body(driver)] or wheels
    return [j for j in found if parallel(stand[j.first].axis, stand[own[0]].axis)]


def train_picture(
    train: Train, meshes: Sequence[Rolling], instances: Sequence[Instance]
) -> tuple[TrainPicture, list[str]]:
    """A train as its sheet has it, numbered from the driver on, and the part of each rim."""
    stands, stand = train.moving.stands, {i.id: i for i in instances}
    toothed = [stands.body(key) for mesh in meshes for key in (mesh.first, mesh.second)]
    driver = stands.body(train.drives[0])
    on = [joint.on for body in toothed if isinstance(joint := stands.supports.get(body), Revolute)]
    if driver not in {*toothed, *map(stands.body, on)}:
        # gears that other ones move
        driver = next(body for body in toothed if train.moving.courses[body].rate)
    # all is told in the frame of the first as it lies
    frame = stand[meshes[0].first]
    stand = {key: seen_from(frame, one)[1] for key, one in stand.items()}
    axes = {body: _axis(joint, frame) for body, joint in stands.supports.items()}
    meshes, rims = _along(stands, _once(stands, meshes, stand, axes), driver)
    toothed = list(dict.fromkeys(map(stands.body, rims)))
    joints = {body: stands.supports.get(body) for body in toothed}
    carriers = {b: stands.body(j.on) for b, j in joints.items() if isinstance(j, Revolute) and j.on != FRAME}
    bare = [c for c in dict.fromkeys(carriers.values()) if c not in toothed]
    bodies = list(dict.fromkeys([*toothed, *bare, driver]))
    names = {body: str(number) for number, body in enumerate((b for b in bodies if b not in bare), 1)}
    names |= {body: f"H{number}" if len(bare) > 1 else "H" for number, body in enumerate(bare, 1)}
    heights = _unfolded(stands, meshes, bodies, axes)
    # told against an axis that points the other way
    rates = {body: train.moving.courses[body].rate * (parallel(stands.axis(body), frame.axis) or 1) for body in bodies}
    on_which = {body: bodies.index(carrier) for body, carrier in carriers.items()}
    links = tuple(Link(names[b], heights[b], rates[b] / rates[driver], on_which.get(b)) for b in bodies)
    levels, rings = _levels(rims, meshes, stand), {_ring(mesh) for mesh in meshes}
    teeth = {key: z for mesh in meshes for key, z in zip((mesh.first, mesh.second), mesh.teeth, strict=True)}
    made = []
    for index, key in enumerate(rims):
        body = stands.body(key)
        primes = "'" * sum(stands.body(other) == body for other in rims[:index])
        made.append(Rim(names[body] + primes, bodies.index(body), teeth[key], levels[key], key in rings))
    pairs = tuple((rims.index(mesh.first), rims.index(mesh.second)) for mesh in meshes)
    return TrainPicture(links, tuple(made), pairs, bodies.index(driver)), [stand[key].part for key in rims]


def _ring(mesh: Rolling) -> str | None:
    """Which of two has its teeth inside."""
    return max(zip(mesh.teeth, (mesh.first, mesh.second), strict=True))[1] if mesh.kind == "internal" else None


def _once(
    stands: Tree, meshes: Sequence[Rolling], stand: Mapping[str, Instance], axes: Mapping[str, complex]
) -> list[Rolling]:
    """The meshes without satellites that go round beside an equal one: on one carrier, of one part, as far out."""
    twins: dict[tuple[object, ...], str] = {}
    doubled = set()
    for key in dict.fromkeys(key for mesh in meshes for key in (mesh.first, mesh.second)):
        joint = stands.supports.get(stands.body(key))
        if isinstance(joint, Revolute) and joint.on != FRAME:
            arm = abs(axes[stands.body(key)] - axes[stands.body(joint.on)])
            doubled.add(key)
            doubled.discard(
                twins.setdefault((joint.on, stand[key].part, *(round(x, 6) for x in (arm, stand[key].at[2]))), key)
            )
    return [mesh for mesh in meshes if not doubled & {mesh.first, mesh.second}]


def _along(stands: Tree, meshes: Sequence[Rolling], driver: str) -> tuple[list[Rolling], list[str]]:
    """The meshes and their rims in the order in which the motion comes to them from the driver."""
    left, found, rims, reached = list(meshes), list[Rolling](), list[str](), {driver}
    while left:
        ends = [[key for key in (m.first, m.second) if stands.body(key) in reached] for m in left]
        index = next((k for k, keys in enumerate(ends) if keys), 0)
        mesh = left.pop(index)
        found.append(mesh)
        rims += [*ends[index], mesh.first, mesh.second]
        for body in (stands.body(mesh.first), stands.body(mesh.second)):
            joint = stands.supports.get(body)
            # what stands still hands nothing on
            reached |= set() if stands.still(body) else {body}
            reached |= {stands.body(joint.on)} if isinstance(joint, Revolute) and joint.on != FRAME else set()
    return found, list(dict.fromkeys(rims))


def _unfolded(
    stands: Tree, meshes: Sequence[Rolling], bodies: Sequence[str], axes: Mapping[str, complex]
) -> dict[str, float]:
    """Heights of the axes, mm: each as far above the one before as they are apart, a ring's below its pinion's."""
    found: dict[str, float] = {}

    def put(body: str, height: float) -> None:
        """All that turns about one axis stands at one height."""
        for other in bodies:
            if other not in found and abs(axes[other] - axes[body]) <= PLACED_MM:
                found[other] = height

    put(bodies[0], 0.0)
    for _ in bodies:
        for mesh in meshes:
            one, two = stands.body(mesh.first), stands.body(mesh.second)
            apart = abs(axes[two] - axes[one])
            ring = _ring(mesh)
            if one in found and two not in found:
                put(two, found[one] + (-apart if ring == mesh.second else apart))
            elif two in found and one not in found:
                put(one, found[two] + (-apart if ring == mesh.first else apart))
    return {body: found.get(body, 0.0) for body in bodies}


def _axis(joint: Support | Group, frame: Instance) -> complex:
    """Where the axis of a link stands across that of an instance, mm."""
    if not isinstance(joint, Revolute):
        return 0j
    if frame.axis == UPWARDS:
        return joint.at
    laid = Placement3.towards(frame.axis, 0.0, frame.at)
    x, y, _ = laid.inverse().apply(np.array([joint.at.real, joint.at.imag, joint.z])).tolist()
    return complex(x, y)


def _levels(rims: Sequence[str], meshes: Sequence[Rolling], stand: Mapping[str, Instance]) -> dict[str, int]:
    """Rims that mesh with each other stand in one column, columns in the order of their heights along the axes."""
    column = {key: {key} for key in rims}
    for mesh in meshes:
        joined = column[mesh.first] | column[mesh.second]
        column |= dict.fromkeys(joined, joined)
    heights = {key: min((stand[k].at[2], k) for k in column[key]) for key in rims}
    order = sorted(set(heights.values()))
    return {key: order.index(heights[key]) for key in rims}

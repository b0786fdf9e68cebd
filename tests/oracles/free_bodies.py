"""Every link of the two-disk table as a free body in space: six equations each, all forces unknown, one linear system.

Shares nothing with ``geometry.kinematics``: positions by the thesis's angles, flanks as planes with their normals, of
the worms by the tangent of the helix and the straight line of its axial section. Where a flank would have to pull, the
other one is taken. Bearings are stiff, three cranks in parallel are alike.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
UP = np.array([0.0, 0.0, 1.0])
# how much stiffer bearings are than cranks
_STIFF = 1e5
_MOST_TRIED = 20


class Unknown(NamedTuple):
    """A force or a moment (of size 1) from link ``giver`` on link ``taker`` at a place."""

    name: str
    giver: str
    taker: str
    force: Vector
    moment: Vector
    at: Vector
    weight: float
    pushes: bool = False


class Sizes(NamedTuple):
    """Of the table, mm and rad."""

    arms: tuple[float, float]
    teeth: tuple[int, int]
    worm_teeth: tuple[int, int]
    worm_module: float
    quotient: float
    axial_angle: float
    pressure_angle: float
    load: float
    bearings: dict[str, float]
    mesh: float
    worms: tuple[float, float]
    wheels: tuple[float, float]
    wheel_teeth: tuple[int, int] | None
    pivots: float


def unit(angle: float) -> Vector:
    return np.array([math.cos(angle), math.sin(angle), 0.0])


def lifted(point: Vector, height: float) -> Vector:
    return np.array([point[0], point[1], height])


def revolute(name: str, giver: str, taker: str, at: Vector, axis: int = 2) -> list[Unknown]:
    """Five unknowns: all but the moment about the axis."""
    none = np.zeros(3)
    rows = [Unknown(f"{name}.{k}", giver, taker, np.eye(3)[k], none, at, _STIFF) for k in range(3)]
    return rows + [
        Unknown(f"{name}.m{k}", giver, taker, none, np.eye(3)[k], at, _STIFF * 100) for k in range(3) if k != axis
    ]


def flanks(
    name: str, giver: str, taker: str, along: Vector, angle: float, at: Vector, *, ring: bool = False
) -> tuple[Unknown, Unknown]:
    """Both flanks of spur teeth at the pitch point; ``along``: from the giver's axis to the taker's, of a ring back."""
    across = np.cross(UP, along)
    away = -along if ring else along
    normals = [s * across * math.cos(angle) + away * math.sin(angle) for s in (1, -1)]
    one, two = (Unknown(name, giver, taker, n, np.zeros(3), at, 1.0, True) for n in normals)
    return one, two


def worm_flanks(name: str, worm: str, wheel: str, side: int, height: float, radius: float, s: Sizes) -> Any:
    """Both flanks of a right-hand thread of one start about an axis along x, at the pitch point."""
    own = s.quotient * s.worm_module / 2
    outwards = np.array([0.0, -side, 0.0])
    tangent = np.array([s.worm_module / 2, 0, 0]) + np.cross([1.0, 0, 0], own * outwards)
    found = []
    for face in (1, -1):
        # the thread grows thinner outwards
        line = outwards - face * math.tan(s.axial_angle) * np.array([1.0, 0, 0])
        normal = np.cross(tangent, line)
        normal *= face * np.sign(normal[0]) / np.linalg.norm(normal)
        at = np.array([0.0, side * radius, height])
        found.append(Unknown(name, worm, wheel, normal, np.zeros(3), at, 1.0, True))
    return found


def balanced(s: Sizes, delta: float, beta: float, force: Vector, moment: float) -> dict[str, float]:
    """All unknowns by name under a force and a moment about z on the platform.

    Raises
    ------
    AssertionError
        No choice of flanks balances every link.
    """
    way_2 = unit(math.pi / 2 - delta)
    way_3 = unit(math.pi / 2 - delta + math.pi + beta)
    at_2 = s.arms[0] * way_2
    at_3 = at_2 + s.arms[1] * way_3
    heights, none = s.bearings, np.zeros(3)
    ring_radius = s.arms[0] * s.teeth[1] / (s.teeth[1] - s.teeth[0])
    bodies = ["platform", "disk_3", "ring", "disk_2", "worm_1", "worm_2"]
    known = [
        *revolute("axle", "disk_3", "platform", lifted(at_3, heights["axle"])),
        *revolute("disk_3", "disk_2", "disk_3", lifted(at_2, heights["disk_3"])),
        *revolute("ring", "disk_2", "ring", np.array([0, 0, heights["ring"]])),
        *revolute("disk_2", "body", "disk_2", np.array([0, 0, heights["disk_2"]])),
    ]
    choices = [
        flanks("mesh", "ring", "disk_3", way_2, s.pressure_angle, lifted(ring_radius * way_2, s.mesh), ring=True)
    ]
    for k, side in ((1, 1), (2, -1)):
        radius = s.worm_module * s.worm_teeth[k - 1] / 2
        at = np.array([0.0, side * (radius + s.quotient * s.worm_module / 2), s.worms[k - 1]])
        known += revolute(f"worm_{k}", "body", f"worm_{k}", at, axis=0)
        known.append(Unknown(f"torque_{k}", "body", f"worm_{k}", none, np.array([1.0, 0, 0]), at, 1.0))
        wheel = "disk_2" if k == 1 else "ring"
        choices.append(worm_flanks(f"flank_{k}", f"worm_{k}", wheel, side, s.worms[k - 1], radius, s))
    if s.wheel_teeth is None:
        bodies.append("free_ring")
        known += revolute("free_ring", "disk_3", "free_ring", lifted(at_2, heights["disk_3"]))
        for stage, (way, giver, taker, centre, start) in enumerate(
            ((way_2, "body", "free_ring", at_2, 0.0), (way_3, "free_ring", "platform", at_3, math.pi / 3))
        ):
            for pin in range(3):
                at = centre + s.pivots * unit(start + 2 * math.pi * pin / 3)
                known.append(Unknown(f"crank_{stage}_{pin}", giver, taker, way, none, lifted(at, -90.0), 1.0))
    else:
        bodies.append("wheel_8")
        one, two = s.wheel_teeth
        known += revolute("wheel_8", "disk_3", "wheel_8", lifted(at_2, heights["disk_3"]))
        near, far = (arm * one / (one + two) for arm in s.arms)
        low, high = lifted(near * way_2, s.wheels[0]), lifted(at_3 - far * way_3, s.wheels[1])
        choices.append(flanks("wheels_78", "body", "wheel_8", way_2, s.pressure_angle, low))
        choices.append(flanks("wheels_86", "wheel_8", "platform", way_3, s.pressure_angle, high))
    pushing = [0] * len(choices)
    for _ in range(_MOST_TRIED):
        chosen = [pair[k] for pair, k in zip(choices, pushing, strict=True)]
        unknowns = [*known, *chosen]
        table, right = np.zeros((6 * len(bodies), len(unknowns))), np.zeros(6 * len(bodies))
        for column, u in enumerate(unknowns):
            pull = u.weight * np.array([*u.force, *(u.moment + np.cross(u.at, u.force))])
            for body, sign in ((u.taker, 1), (u.giver, -1)):
                if body in bodies:
                    row = 6 * bodies.index(body)
                    table[row : row + 6, column] += sign * pull
        at = lifted(at_3, s.load)
        right[:6] = -np.array([*force, *(UP * moment + np.cross(at, force))])
        found = np.linalg.lstsq(table, right, rcond=1e-13)[0]
        assert np.abs(table @ found - right).max() < 1e-7 * np.abs(right).max()
        values = {u.name: float(v * u.weight) for u, v in zip(unknowns, found, strict=True)}
        pulls = [k for k, u in enumerate(chosen) if values[u.name] < -1e-6]
        if not pulls:
            return values
        for k in pulls:
            pushing[k] = 1 - pushing[k]
    raise AssertionError("no flanks push")

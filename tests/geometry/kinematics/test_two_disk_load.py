"""A load on the two-disk table: every link as a free body in space, closed forms of what is worst, bounds."""

from __future__ import annotations

import math
import random
from typing import get_args

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.kinematics.two_disk import Orientation, TwoDisk
from geometry.kinematics.two_disk_load import (
    Amount,
    Bearing,
    Force,
    Heights,
    LoadedTable,
    Vectors,
    WormForces,
    along_axis,
    ball_load,
    crank_force,
    lift,
    mesh_force,
    radial,
    tilting,
    worm_torque,
    worst,
)
from tests.oracles.free_bodies import Sizes, balanced

BEARINGS: tuple[Bearing, ...] = get_args(Bearing)
ANGLE, AXIAL = math.radians(20), math.radians(20.1)
HEIGHTS = Heights(73.0, (-35.0, 29.5), 15.0, -22.5, -73.0, 8.0, (-90.0, -60.0))
WORMS = tuple(WormForces(5 * z / 2, h, math.tan(AXIAL), 0.1) for z, h in ((128, -48.0), (106, -137.0)))
TABLES = {
    "thesis": TwoDisk(),
    "unlike": TwoDisk(arms=(60.0, 45.0), teeth=(60, 100)),
}


def loaded(table: TwoDisk, orientation: Orientation = "cranks") -> LoadedTable:
    return LoadedTable(table, (WORMS[0], WORMS[1]), HEIGHTS, orientation, (30, 36))


def sizes(table: TwoDisk, orientation: Orientation) -> Sizes:
    bearings = {"axle": HEIGHTS.bore[0], "disk_3": 15.0, "ring": -73.0, "disk_2": 8.0}
    wheels = (30, 36) if orientation == "thesis" else None
    return Sizes(
        table.arms, table.teeth, table.worm_ratios, 5.0, 10.0, AXIAL, ANGLE, 73.0, bearings, -22.5, (-48.0, -137.0),
        (-90.0, -60.0), wheels, 53.0,
    )  # fmt: skip


def off(table: LoadedTable, seed: int) -> float:
    """The greatest difference to the free bodies in a random state, in parts of the load."""
    draw = random.Random(seed)
    delta, beta, way = (draw.uniform(-math.pi, math.pi) for _ in range(3))
    force = Force(1000.0, draw.uniform(-900, 900), draw.uniform(-200e3, 200e3))
    across = 1000 * np.exp(1j * way)
    state = table.carried(delta, beta, way, force)
    right = balanced(
        sizes(table.table, table.orientation), delta, beta, np.array([across.real, across.imag, force.axial]),
        force.moment,
    )  # fmt: skip
    found = [abs(float(state.mesh) - right["mesh"])]
    for k, teeth in enumerate(table.table.worm_ratios):
        # mm about the worm's axis: a wheel's torque by its ratio
        found.append(abs(abs(float(state.torques[k])) / teeth - abs(right[f"torque_{k + 1}"])) / 10)
    for name in BEARINGS:
        passed = state.passed(name)
        # what the inner link passes on is what holds it, turned about; of the ring and of disk 3 likewise
        pull = complex(passed.turning.force + passed.still.force)
        tilt = 1j * complex(passed.turning.tilt + passed.still.tilt)
        along = float(passed.turning.axial + passed.still.axial)
        wanted = [complex(right[f"{name}.{p}0"], right[f"{name}.{p}1"]) for p in ("", "m")]
        found += [abs(pull + wanted[0]), abs(tilt + wanted[1]) / 100, abs(along + right[f"{name}.2"])]
    if table.orientation == "cranks":
        for stage in (0, 1):
            most = max(abs(right[f"crank_{stage}_{pin}"]) for pin in range(3))
            found.append(abs(float(state.crank(stage)) - most))
    return max(found) / 1000


@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
@pytest.mark.parametrize("orientation", ["cranks", "thesis"])
def test_every_link_is_balanced_as_a_free_body(table: TwoDisk, orientation: Orientation) -> None:
    for seed in range(5):
        assert off(loaded(table, orientation), seed) < 1e-7


def test_a_sign_that_is_turned_is_seen() -> None:
    right = loaded(TwoDisk(), "thesis")
    one, two = right.worms
    for wrong in (
        replace(right, pressure_angle=-ANGLE),
        replace(right, worms=(replace(one, along=-0.1), two)),
        replace(right, worms=(one, replace(two, radial=-two.radial))),
        replace(right, worms=(two, one)),
        replace(right, heights=replace(HEIGHTS, mesh=22.5)),
        replace(right, wheels=(36, 30)),
    ):
        assert min(off(wrong, seed) for seed in range(2)) > 1e-3


def test_by_virtual_work_no_turn_is_left_in_a_bearing() -> None:
    """The torques come from the Jacobian, the forces of the meshes from balances: they agree in every state."""
    draw = np.random.default_rng(5)
    delta, beta, way = draw.uniform(-math.pi, math.pi, (3, 1000))
    for orientation in ("cranks", "thesis"):
        state = loaded(TABLES["unlike"], orientation).carried(delta, beta, way, Force(1000.0, 300.0, 50e3))
        for passed in map(state.passed, BEARINGS):
            assert np.abs(passed.turning.turn + passed.still.turn).max() < 1e-6


def test_the_worst_by_closed_forms() -> None:
    table, load = TwoDisk(), Force(1000.0)
    whole = loaded(table)
    k, lean = 0.5, 1 / math.cos(ANGLE)
    # arms of the drives: L1 + (u - 1) L2 at the centre, u L2
    assert worst(whole, load, worm_torque(0)).value == pytest.approx(108e3, rel=1e-12)
    assert worst(whole, load, worm_torque(1)).value == pytest.approx(108e3, rel=1e-12)
    assert worst(whole, load, mesh_force()).value == pytest.approx(1000 * k * lean, rel=1e-12)
    # force and mesh in one line: where beta is the angle of pressure
    found = worst(whole, load, radial("disk_3"))
    assert found.value == pytest.approx(1000 * (1 + k * lean), rel=1e-12)
    assert abs(found.place.beta) == pytest.approx(ANGLE, abs=1e-6)
    # the mesh's force turned into the line of the worm's
    worm = 108e3 / 265 / math.cos(AXIAL)
    assert worst(whole, load, radial("ring")).value == pytest.approx(1000 * k * lean + worm, rel=1e-12)
    # disk 2: the force, and both worms where each corner of their torques is tried
    ends = [(a * 72 + b * 36, -b * 108) for a in (1, -1) for b in (1, -1)]
    push = math.tan(AXIAL)
    both = max(abs(-p / 320 + q / 265 + 1j * push * (abs(q) / 265 - abs(p) / 320)) for p, q in ends)
    assert worst(whole, load, radial("disk_2")).value == pytest.approx(1000 * (1 + both), rel=1e-9)
    # three cranks alike: F_k = M s_k / (3/2 r²), s_k at most r
    turned = Force(0.0, 0.0, 1e5)
    for stage in (0, 1):
        assert worst(whole, turned, crank_force(stage)).value == pytest.approx(1e5 / (1.5 * 53), rel=1e-12)


AMOUNTS: dict[str, Amount] = {
    "worm": worm_torque(0),
    "disk_3": tilting("disk_3"),
    "ring": lift("ring", 280.0),
    "body": tilting("disk_2"),
    "along": along_axis("disk_2"),
    "ball": ball_load("disk_2", 58, 280.0),
    "axle": radial("axle"),
}


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", AMOUNTS)
@pytest.mark.parametrize("direction", [None, 0.7])
def test_no_place_and_no_direction_pass_the_bound(name: str, direction: float | None) -> None:
    amount, force = AMOUNTS[name], Force(1000.0, -800.0, 1e5, direction)
    whole = loaded(TABLES["unlike"], "thesis")

    def length(vectors: Vectors) -> np.ndarray:
        return np.abs(vectors[0] + vectors[1])

    draw = np.random.default_rng(3)
    delta, beta, way = draw.uniform(-math.pi, math.pi, (3, 20_000))
    ways = way if direction is None else direction
    seen = float(np.max(amount.told(whole.carried(delta, beta, ways, force), length)))
    found = worst(whole, force, amount)
    assert seen <= found.bound <= found.value * 1.0011
    at = found.place
    here = float(amount.told(whole.carried(at.delta, at.beta, at.direction, force), length))
    # of a ball force and moment count as if both were most at once
    assert here == pytest.approx(found.value, rel=1e-6 if name != "ball" else 0.1)
    assert seen > 0.97 * here


def test_at_a_place_over_all_directions_and_in_one() -> None:
    whole, force, at = loaded(TwoDisk()), Force(1000.0, 200.0), (0.4, 1.9)
    for amount in (worm_torque(0), radial("disk_2"), tilting("ring")):
        ways = np.linspace(-math.pi, math.pi, 20_001)
        seen = float(np.max(amount.told(whole.carried(*at, ways, force), lambda v: np.abs(v[0] + v[1]))))
        found = worst(whole, force, amount, at)
        assert seen <= found.bound <= found.value * 1.0011
        assert found.value == pytest.approx(seen, rel=1e-6)
        one = worst(whole, replace(force, direction=found.place.direction), amount, at)
        assert one.value == pytest.approx(found.value, rel=1e-12)


def test_idlers_carry_no_moment_here() -> None:
    with pytest.raises(ParameterError, match="moment"):
        loaded(TwoDisk(), "idlers").carried(0.0, 1.0, 0.0, Force(1.0, 0.0, 1.0))

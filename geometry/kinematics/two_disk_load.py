"""What a load on the platform of the two-disk table asks of its worms, meshes, bearings and cranks, anywhere.

The torques of the drives follow by virtual work from the table's Jacobian; the forces go from link to link as
wrenches: platform, disk 3, disk 2, body, and ring on disk 2. A bearing takes all but the turn about its axis, which
the meshes balance. No friction but that of the worms.

The forces of both worms stand still where the force turns together with both disks: a ``Passed`` keeps them apart.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import cached_property
from typing import Literal

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.greatest import greatest
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.kinematics.two_disk import Orientation, TwoDisk
from geometry.kinematics.wrench import Wrench, force_at

Bearing = Literal["axle", "disk_3", "ring", "disk_2"]
_ALL = (-math.pi, math.pi)


class WormForces(Record):
    """What a worm does to its wheel: ``radius`` of the wheel (mm) and height (mm) of their pitch point.

    ``radial`` and ``along`` (the wheel's axis): shares of the force along its circle; of a right-hand worm.
    """

    radius: float
    height: float
    radial: float
    along: float


class Force(Record):
    """On the platform's axis: ``across`` it (N), whose direction may be free, ``axial`` (N), ``moment`` (N mm)."""

    across: float
    axial: float = 0.0
    moment: float = 0.0
    direction: float | None = None


class Heights(Record):
    """Of what carries forces, mm; ``bore``: both ends of that in which the axle turns; ``wheels``: planes of the
    wheels 7 and 8, and of 8 and 6.
    """

    load: float
    bore: tuple[float, float]
    disk_3: float
    mesh: float
    ring: float
    disk_2: float
    wheels: tuple[float, float] = (0.0, 0.0)


class Passed(Record):
    """What a link passes to the next one, about their bearing; ``turning``: without the worms' forces, ``still``."""

    turning: Wrench
    still: Wrench


class LoadedTable(Record):
    """A table with what carries its forces; ``pivots``: radius of the circle of the cranks', and where the first of
    either stage stands, rad; ``wheels``: teeth of 6 (and 7) and 8.
    """

    table: TwoDisk
    worms: tuple[WormForces, WormForces]
    heights: Heights
    orientation: Orientation = "cranks"
    wheels: tuple[int, int] = (36, 36)
    pivots: tuple[float, tuple[float, float]] = (53.0, (0.0, math.pi / 3))
    pressure_angle: float = math.radians(20)

    def carried(self, delta: Real | float, beta: Real | float, direction: Real | float, force: Force) -> Carried:
        """The state at angles (rad) under a force in a direction (rad from +x).

        Raises
        ------
        ParameterError
            A moment where idlers turn the platform.
        """
        if force.moment and self.orientation == "idlers":
            raise ParameterError("moment", force.moment / 1000, "moment_on_idlers")
        return Carried(self, delta, beta, direction, force)

    @property
    def turned(self) -> float:
        """What the platform turns for the turn of disk 3 against disk 2."""
        return 1 + self.wheels[1] / self.wheels[0] if self.orientation == "thesis" else 0.0

    def slopes(self, force: Force) -> Slopes:
        """How fast all of it may change, columns as in ``Slopes``."""
        (one, two), ratio, load = self.table.arms, self.table.ratio, abs(force.across)
        lean, moment = 1 / math.cos(self.pressure_angle), abs(force.moment)
        pitch = one / (ratio - 1)
        torques = load * np.array([(ratio - 1) * two, one, one]), load * ratio * two * _BY_ARM_2
        mesh = load * two / pitch * lean
        mesh_of = np.array([mesh, 0.0, mesh + self.turned * moment / pitch * lean])
        heights, axial = self.heights, abs(force.axial)
        worms = [
            _Term(torque / w.radius * math.hypot(1, w.radial), w.height, torque / w.radius * w.along, w.radius)
            for torque, w in zip(torques, self.worms, strict=True)
        ]

        def loaded(*moves: float) -> _Term:
            return _Term(load * _BY_ARM_1, heights.load, most=axial, moves=np.array(moves))

        inner = [loaded(two, two, 0)]
        if self.turned:
            on_8 = moment / (one * self.wheels[0] / sum(self.wheels)) * lean
            inner.append(_Term(on_8 * np.array([0, 0, 1]), heights.wheels[0]))
        terms: Mapping[Bearing, tuple[float, list[_Term]]] = {
            # told from O2O3, with which all the rest turns
            "axle": (heights.bore[0], [_Term(load * _BY_ARM_2, heights.load)]),
            "disk_3": (heights.disk_3, [*inner, _Term(mesh_of, heights.mesh)]),
            "ring": (heights.ring, [_Term(mesh_of, heights.mesh), worms[1]]),
            "disk_2": (heights.disk_2, [loaded(two, two, one), *inner[1:], *worms]),
        }
        bearings = {name: _summed(height, found) for name, (height, found) in terms.items()}
        held = moment if self.orientation == "cranks" else 0.0
        cranks = held / (1.5 * self.pivots[0])
        return Slopes(torques, mesh * _BY_ARM_2, (cranks * np.array([0, 0, 1]), cranks * _BY_ARM_2), bearings)


class Carried(Record, dict=True, eq=False):
    """A state of a table at angles (rad) under a force in a direction (rad from +x), found as it is asked."""

    loaded: LoadedTable
    delta: Real | float
    beta: Real | float
    direction: Real | float
    force: Force

    def crank(self, stage: int) -> Real:
        """Greatest force along one of a stage, N: as the arms about the middle, whose squares add up to 3/2 r^2."""
        moment, way = self.force.moment, self._ways[stage]
        if not moment or self.loaded.orientation != "cranks":
            return np.zeros(np.shape(way))
        radius, starts = self.loaded.pivots
        pins = radius * np.exp(1j * (starts[stage] + 2 * math.pi / 3 * np.arange(3)))
        arms = np.imag(np.multiply.outer(np.conj(pins), way))
        return np.asarray(np.abs(arms).max(axis=0) * abs(moment) / (1.5 * radius**2))

    @cached_property
    def torques(self) -> tuple[Real, Real]:
        """Torques on the worms' wheels, N mm, in the sense of delta."""
        table, turned = self.loaded.table, self.loaded.turned * self.force.moment
        one, two = table.torques(self.delta, self.beta, self._across)
        return one - turned * table.ratio, two + turned * table.ratio

    @property
    def mesh(self) -> Real:
        """Force of the ring on the pinion along the line of action, N."""
        return np.abs(self._mesh[0])

    def passed(self, bearing: Bearing) -> Passed:
        """What the inner link of a bearing passes to the outer one."""
        found: Passed = getattr(self, f"_{bearing}")
        return found

    @cached_property
    def _axle(self) -> Passed:
        return _passed(self._platform, _NONE, self._at_3, self.loaded.heights.bore[0])

    @cached_property
    def _disk_3(self) -> Passed:
        inner = self._platform + self._oriented[1] + self._on_pinion
        return _passed(inner, _NONE, self._at_2, self.loaded.heights.disk_3)

    @cached_property
    def _ring(self) -> Passed:
        return _passed(-self._on_pinion, self._worm(1), 0j, self.loaded.heights.ring)

    @cached_property
    def _disk_2(self) -> Passed:
        turning = self._platform + self._oriented[1]
        return _passed(turning, self._worm(0) + self._worm(1), 0j, self.loaded.heights.disk_2)

    @cached_property
    def _ways(self) -> tuple[Complex, Complex]:
        """Directions of O1O2 and of O3O2."""
        first = 1j * np.exp(-1j * np.asarray(self.delta))
        return first, -first * np.exp(1j * np.asarray(self.beta))

    @cached_property
    def _at_2(self) -> Complex:
        return self.loaded.table.arms[0] * self._ways[0]

    @cached_property
    def _at_3(self) -> Complex:
        return self._at_2 + self.loaded.table.arms[1] * self._ways[1]

    @cached_property
    def _across(self) -> Complex:
        return np.asarray(self.force.across * np.exp(1j * np.asarray(self.direction)), dtype=complex)

    @cached_property
    def _mesh(self) -> tuple[Complex, Complex]:
        turned = self.loaded.turned * self.force.moment
        moment_2 = np.imag(np.conj(self._at_3 - self._at_2) * self._across) + turned
        return self.loaded.table.mesh_force(self._ways[0], moment_2, self.loaded.pressure_angle)

    @cached_property
    def _on_pinion(self) -> Wrench:
        mesh, point = self._mesh
        return force_at(point, self.loaded.heights.mesh, mesh)

    @cached_property
    def _platform(self) -> Wrench:
        """What the platform's axle passes on."""
        force, height = self.force, self.loaded.heights.load
        return force_at(self._at_3, height, self._across, force.axial, force.moment) + self._oriented[0]

    @cached_property
    def _oriented(self) -> tuple[Wrench, Wrench]:
        """What keeps the platform from turning: on the platform, and with it on all that stands on disk 3.

        Three cranks alike pass a couple on; wheels pass forces on at their pitch points.
        """
        loaded, moment, at_2 = self.loaded, self.force.moment, self._at_2
        if loaded.orientation != "thesis":
            still = force_at(0 * at_2, 0.0, 0 * at_2)
            return force_at(0 * at_2, 0.0, 0 * at_2, turn=-moment), still
        (one, two), (first, second) = loaded.wheels, self._ways
        near, far = (arm * one / (one + two) for arm in loaded.table.arms)
        push = math.tan(loaded.pressure_angle)
        on_6 = moment / far
        on_8 = -on_6 * loaded.table.arms[1] / loaded.table.arms[0]
        at_6, at_8 = self._at_3 - second * far, near * first
        platform = force_at(at_6, loaded.heights.wheels[1], (1j * on_6 + abs(on_6) * push) * second)
        satellite = force_at(at_8, loaded.heights.wheels[0], (1j * on_8 + abs(on_8) * push) * first)
        return platform, -platform + satellite

    def _worm(self, which: int) -> Wrench:
        """What worm I (at +y) or II (at -y) does to its wheel where it holds its torque."""
        worm = self.loaded.worms[which]
        side = 1 if which == 0 else -1
        along = np.asarray(self.torques[which]) / worm.radius
        force = side * (along - 1j * np.abs(along) * worm.radial)
        return force_at(1j * side * worm.radius, worm.height, force, along * worm.along)


_NONE = force_at(0j, 0.0, 0j)


# of what goes by the direction of the force to O2O3 alone, and of what goes by that to O1O2
_BY_ARM_2, _BY_ARM_1 = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])


class _Term(Record):
    """Slopes of a force across the axis, at a height, and of one along it, at a distance; or one that ``moves``."""

    force: Real
    height: float
    axial: Real = np.zeros(3)
    distance: float = 0.0
    most: float = 0.0
    moves: Real = np.zeros(3)


class Slopes(Record):
    """By the direction of the force to O2O3, by that to O1O2 as seen from O1O2, and by that as the body sees it, the
    force standing: of torques, mesh, cranks, and of force, axial force and tilt of the bearings.
    """

    worms: tuple[Real, Real]
    mesh: Real
    cranks: tuple[Real, Real]
    bearings: Mapping[Bearing, tuple[Real, Real, Real]]


def _summed(height: float, terms: list[_Term]) -> tuple[Real, Real, Real]:
    tilts = [abs(t.height - height) * t.force + t.distance * t.axial + t.most * t.moves for t in terms]
    parts = [t.force for t in terms], [t.axial for t in terms], tilts
    force, axial, tilt = (np.sum(rows, axis=0) for rows in parts)
    return force, axial, tilt


def _passed(turning: Wrench, still: Wrench, point: Complex | complex, height: float) -> Passed:
    return Passed(turning.about(point, height), still.about(point, height))


class Place(Record):
    """Angles (rad) of the table, and the direction of the force, from +x."""

    delta: float
    beta: float
    direction: float


class Worst(Record):
    """The most of an amount, where it is, and what it passes nowhere."""

    value: float
    bound: float
    place: Place


Vectors = tuple[Complex, Complex]


class Amount(Record):
    """What the most is sought of: ``told`` of a state, its ``slopes``, and the ``vectors`` of which one turns.

    ``told`` takes how the length of a sum of such vectors is to be had.
    """

    told: Callable[[Carried, Callable[[Vectors], Real]], Real]
    slopes: Callable[[Slopes], Real]
    vectors: Callable[[Carried], Vectors] | None = None


def worm_torque(which: int) -> Amount:
    """On the wheel of worm I (0) or II (1), N mm."""
    return Amount(lambda state, _: np.abs(state.torques[which]), lambda slopes: slopes.worms[which])


def mesh_force() -> Amount:
    """Between ring and pinion along the line of action, N."""
    return Amount(lambda state, _: state.mesh, lambda slopes: slopes.mesh)


def crank_force(stage: int) -> Amount:
    """Along a crank of the stage on the body (0) or on the platform (1), N."""
    return Amount(lambda state, _: state.crank(stage), lambda slopes: slopes.cranks[stage])


def _length(vectors: Callable[[Carried], Vectors], slopes: Callable[[Slopes], Real]) -> Amount:
    """That of a sum of vectors."""
    return Amount(lambda state, length: length(vectors(state)), slopes, vectors)


def radial(bearing: Bearing) -> Amount:
    """Across the axis, N."""
    return _length(lambda state: _forces(state, bearing), lambda slopes: slopes.bearings[bearing][0])


def along_axis(bearing: Bearing) -> Amount:
    """Along the axis, N."""
    return Amount(lambda state, _: _axial(state, bearing), lambda slopes: slopes.bearings[bearing][1])


def tilting(bearing: Bearing) -> Amount:
    """Moment across the axis, N mm."""
    return _length(lambda state: _tilts(state, bearing), lambda slopes: slopes.bearings[bearing][2])


def at_edge(bore: tuple[float, float], upper: int) -> Amount:
    """On the lower (0) or upper (1) end of the bore in which the axle turns, N, as if these alone held it."""
    span = bore[1] - bore[0]

    def vectors(state: Carried) -> Vectors:
        (tilt, _), (force, _) = _tilts(state, "axle"), _forces(state, "axle")
        on_upper = tilt / span
        return (on_upper if upper else force - on_upper), 0 * tilt

    def slopes(slopes: Slopes) -> Real:
        force, _, tilt = slopes.bearings["axle"]
        return tilt / span if upper else force + tilt / span

    return _length(vectors, slopes)


def ball_load(bearing: Bearing, balls: int, radius: float) -> Amount:
    """On a ball of rows that are preloaded, N, as if one ball stood where force and moment both are most.

    ``balls`` of all rows on a circle of a ``radius`` (mm): 2 F / z across the axis, A / z + 2 M / (z r) along it.
    """

    def told(state: Carried, length: Callable[[Vectors], Real]) -> Real:
        across, tilt = 2 * length(_forces(state, bearing)), 2 * length(_tilts(state, bearing)) / radius
        return np.hypot(across, _axial(state, bearing) + tilt) / balls

    def slopes(slopes: Slopes) -> Real:
        force, axial, tilt = slopes.bearings[bearing]
        return (2 * force + axial + 2 * tilt / radius) / balls

    return Amount(told, slopes, lambda state: _forces(state, bearing))


def lift(bearing: Bearing, radius: float) -> Amount:
    """A + 2 M / r, N: what the preload must hold of the ball that is lifted most, told of the whole row."""
    return Amount(
        lambda state, length: _axial(state, bearing) + 2 * length(_tilts(state, bearing)) / radius,
        lambda slopes: slopes.bearings[bearing][1] + 2 * slopes.bearings[bearing][2] / radius,
        lambda state: _tilts(state, bearing),
    )


def _forces(state: Carried, bearing: Bearing) -> Vectors:
    passed = state.passed(bearing)
    return passed.turning.force, passed.still.force


def _tilts(state: Carried, bearing: Bearing) -> Vectors:
    passed = state.passed(bearing)
    return passed.turning.tilt, passed.still.tilt


def _axial(state: Carried, bearing: Bearing) -> Real:
    passed = state.passed(bearing)
    return np.abs(passed.turning.axial + passed.still.axial)


def _apart(vectors: Vectors) -> Real:
    """One of them turns until both point the same way."""
    return np.abs(vectors[0]) + np.abs(vectors[1])


def _together(vectors: Vectors) -> Real:
    return np.abs(vectors[0] + vectors[1])


def worst(loaded: LoadedTable, force: Force, amount: Amount, at: tuple[float, float] | None = None) -> Worst:
    """The most of an amount over all places, or ``at`` angles delta and beta, and over all directions that are free.

    Where both are free, the force turns together with the disks, against the worms that stand.
    """
    by_2, by_1, in_body = amount.slopes(loaded.slopes(force))
    given = force.direction
    if at is not None:
        here = at
        if given is not None or not by_2 + by_1:
            place = Place(*at, given or 0.0)
            value = float(amount.told(loaded.carried(*at, place.direction, force), _together))
            return Worst(value, value, place)

        def turned(direction: Real) -> Real:
            return amount.told(loaded.carried(*here, direction, force), _together)

        found = greatest(turned, [_ALL], [by_2 + by_1])
        return Worst(found.value, found.bound, Place(*at, found.at[0]))
    free = given is None and amount.vectors is not None
    way = given or 0.0

    def told(to_2: Real, to_1: Real) -> Real:
        angles = _angles(to_2, to_1, None if free else way)
        return amount.told(loaded.carried(*angles, force), _apart if free else _together)

    found = greatest(told, [_ALL, _ALL], [by_2, by_1 if free else in_body])
    to_2, to_1 = found.at
    delta, beta, direction = map(float, _angles(to_2, to_1, None if free else way))
    turn = 0.0
    if free and amount.vectors is not None:
        turning, still = (complex(v) for v in amount.vectors(loaded.carried(delta, beta, direction, force)))
        turn = float(np.angle(still / turning)) if turning and still else 0.0
    angles = (math.remainder(angle, 2 * math.pi) for angle in (delta - turn, beta, direction + turn))
    return Worst(found.value, found.bound, Place(*angles))


def _angles(to_2: Real | float, to_1: Real | float, way: float | None) -> tuple[Real, Real, Real]:
    """delta, beta and the direction of the force by its angles to O2O3 and to O1O2; ``way``: where it is given."""
    delta = 0 * np.asarray(to_1) if way is None else np.asarray(to_1) + (math.pi / 2 - way)
    # O2O3 stands at pi + beta from O1O2
    return delta, to_1 - to_2 - math.pi + 0 * delta, np.asarray(to_1) + (math.pi / 2 - delta)

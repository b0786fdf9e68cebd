"""Forces in the joints of a lever mechanism, by d'Alembert and group by group as Assur's groups are joined.

With its forces of inertia each link is in balance. A group of class II is statically determinate: its three pairs have
six unknown forces, its two links six equations. The groups are taken from the last one back; what the last joint of a
group passes on loads the link that it hangs on, and at the end the crank's balance gives the moment on its shaft.

A link's frame has its origin in the link's first joint (O1, A, O3, C, O5; of a slider its pin; of a stone A) and its x
axis along the link (of a slider along the guide, of a stone along the lever). Lengths in mm, forces in N, couples and
moments in N mm, masses in kg, moments of inertia in kg m^2.

Sources: I. I. Artobolevsky, Theory of Mechanisms and Machines, 12 and 13 (forces of inertia, Zhukovsky's lever, groups
of class II, the driving link); guidelines on coursework (Orenburg), 4.17 to 4.20.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Mapping

import numpy as np

from geometry.base.record import Record
from geometry.base.series import Series
from geometry.curves.curve import Complex, Real
from geometry.kinematics.levers import Levers, Moved, Rods, Slider, Stone, turning
from geometry.kinematics.wrench import Wrench, force_at


class Body(Record):
    """What a link has of mass: ``inertia`` about the centre of mass, which lies at ``centre`` in the link's frame."""

    link: str
    mass: float
    inertia: float = 0.0
    centre: complex = 0j


class Acting(Record, eq=False):
    """A force on a link at a point ``at`` of its frame, and a couple, counter-clockwise; over the crank's positions."""

    link: str
    at: complex
    force: Complex
    couple: Real


class Toothed(Record):
    """A wheel on the crank's shaft that is driven by another one: pitch ``radius``, ``pressure`` angle (rad), and the
    ``direction`` from O1 to the axis of that other wheel, rad.
    """

    radius: float
    pressure: float
    direction: float

    def force(self, moment: Real) -> Complex:
        """The force of teeth that has this moment about O1: along the circle, and from the other wheel's axis."""
        along = moment / self.radius
        # the flank that pushes lies on the other side for the other sense; both press the axes apart
        return np.exp(1j * self.direction) * (1j * along - np.abs(along) * math.tan(self.pressure))


class Frame(Record, eq=False):
    """A link in motion: its origin and the direction of its x axis as Taylor series in time."""

    origin: Series
    way: Series

    def point(self, at: complex) -> Series:
        """Where a point of the link is."""
        return [o + at * w for o, w in zip(self.origin, self.way, strict=True)]

    def turning(self) -> tuple[Real, Real]:
        """Angular velocity (rad/s) and acceleration (rad/s^2)."""
        return turning(self.way)


class Reactions(Record, eq=False):
    """``forces``: by two links, 34 the force of link 3 on link 4, 0 the frame. ``couples``: in sliding pairs, about the
    pin. ``moment``: the balancing one on the crank, and the force of teeth ``driving`` it, 0 where a couple does.
    ``bite``: least sine of the angles at which the rods of the groups meet what holds them; at 0 nothing is held.
    """

    forces: Mapping[str, Complex]
    couples: Mapping[str, Real]
    moment: Real
    driving: Complex
    bite: Real


def frames(levers: Levers, at: Moved) -> dict[str, Frame]:
    """The frames of all moving links."""
    end = at.points["A"]
    still = [0 * x for x in end]

    def fixed(value: complex) -> Series:
        return [value + still[0], *still[1:]]

    def held(group: Stone | Rods | Slider, joint: str, link: str) -> Frame:
        """Of what the frame guides along a line, or holds by a pivot."""
        if isinstance(group, Slider):
            return Frame(at.points[joint], fixed(cmath.exp(1j * group.angle)))
        return Frame(fixed(group.pivot), at.links[link])

    first, second = levers.first, levers.second
    found = {"1": Frame(still, [x / levers.crank for x in end])}
    found["2"] = Frame(end, at.links["3" if isinstance(first, Stone) else "2"])
    found["3"] = held(first, "B", "3")
    if second is not None:
        found["4"] = Frame(at.points.get("C", end), at.links["4"])
        found["5"] = held(second, "D", "5")
    return found


def weight(body: Body, gravity: complex, frame: Frame) -> Acting:
    """m g at the centre of mass; ``gravity``: m/s^2, with its direction."""
    force = body.mass * gravity + 0 * frame.way[0]
    return Acting(body.link, body.centre, force, np.zeros(np.shape(force)))


def inertial(body: Body, frame: Frame) -> Acting:
    """-m a_S at the centre of mass and the couple -J epsilon."""
    change = 2 * frame.point(body.centre)[2] / 1000
    return Acting(body.link, body.centre, -body.mass * change, -1000 * body.inertia * frame.turning()[1])


def power(acting: Acting, frame: Frame) -> Real:
    """What a force puts in, W."""
    velocity = frame.point(acting.at)[1]
    return np.real(np.conj(velocity) * acting.force) / 1000 + acting.couple * frame.turning()[0] / 1000


def most_power(acting: Acting, frame: Frame) -> Real:
    """What a force of its size could put in, W: |F| |v| + |M omega|, the measure of what rounding leaves."""
    velocity = np.abs(frame.point(acting.at)[1])
    return velocity * np.abs(acting.force) / 1000 + np.abs(acting.couple * frame.turning()[0]) / 1000


def reduced_inertia(bodies: Iterable[Body], moving: Mapping[str, Frame], speed: float) -> Real:
    """What a mass on the crank would have for the links' kinetic energy: sum of (m v_S^2 + J omega^2) / omega_1^2."""
    total = np.zeros(np.shape(moving["1"].way[0]))
    for body in bodies:
        frame = moving[body.link]
        velocity = np.abs(frame.point(body.centre)[1]) / 1000
        total = total + body.mass * (velocity / speed) ** 2 + body.inertia * (frame.turning()[0] / speed) ** 2
    return total


def weights_work(bodies: Iterable[Body], gravity: complex, moving: Mapping[str, Frame]) -> Real:
    """What the weights have done since the first position, J; ``gravity``: m/s^2, with its direction."""
    fallen = np.zeros(np.shape(moving["1"].way[0]))
    for body in bodies:
        fallen = fallen + body.mass * np.real(gravity.conjugate() * moving[body.link].point(body.centre)[0]) / 1000
    return fallen - fallen[0]


def by_zhukovsky(acting: Iterable[Acting], moving: Mapping[str, Frame], speed: float) -> Real:
    """The balancing moment of virtual power, no joint being asked: the sum of the moments of all forces about the pole
    of the plan of velocities that is turned by a right angle.
    """
    total = sum((power(one, moving[one.link]) for one in acting), np.zeros(np.shape(moving["1"].way[0])))
    return -1000 * total / speed


def reactions(levers: Levers, at: Moved, acting: Iterable[Acting], teeth: Toothed | None = None) -> Reactions:
    """All forces in joints; the crank is balanced by a couple, or by the force of ``teeth``."""
    moving = frames(levers, at)
    # of each link about the origin of its own frame, so that nothing large cancels
    loads = {link: force_at(0j, 0.0, 0 * frame.way[0]) for link, frame in moving.items()}
    for one in acting:
        arm = one.at * moving[one.link].way[0]
        loads[one.link] = loads[one.link] + force_at(arm, 0.0, one.force, turn=one.couple)
    forces: dict[str, Complex] = {}
    couples: dict[str, Real] = {}
    bites = []
    groups: list[tuple[str, str, str, Stone | Rods | Slider]] = [("1", "2", "3", levers.first)]
    if levers.second is not None:
        groups.append(("3", "4", "5", levers.second))
    for before, rod, last, group in reversed(groups):
        pair = _Pair(loads[rod], loads[last], moving[rod], moving[last])
        with np.errstate(divide="ignore", invalid="ignore"):
            if isinstance(group, Stone):
                outer, bite = _of_stone(pair, levers.crank)
            elif isinstance(group, Rods):
                outer, bite = _of_rods(pair, group)
            else:
                outer, bite = _of_slider(pair, group)
        bites.append(bite)
        forces[before + rod] = outer
        forces[rod + last] = outer + loads[rod].force
        forces["0" + last] = -(forces[rod + last] + loads[last].force)
        if isinstance(group, Slider):
            couples["0" + last] = -loads[last].turn
        elif isinstance(group, Stone):
            couples[rod + last] = loads[rod].turn
        arm = moving[rod].origin[0] - moving[before].origin[0]
        loads[before] = loads[before] + force_at(arm, 0.0, -outer)
    moment = -loads["1"].turn
    driving = np.zeros(np.shape(moment), complex) if teeth is None else teeth.force(moment)
    forces["01"] = -(loads["1"].force + driving)
    return Reactions(forces, couples, moment, driving, np.min(bites, axis=0))


class _Pair(Record, eq=False):
    """Both links of a group with what loads them, each about the origin of its own frame."""

    rod: Wrench
    last: Wrench
    rod_frame: Frame
    last_frame: Frame

    @property
    def apart(self) -> Complex:
        """From the joint that the group hangs on to the origin of its last link."""
        return np.asarray(self.last_frame.origin[0] - self.rod_frame.origin[0])

    def about_last(self) -> Real:
        """The moment of both loads about the last link's origin."""
        return np.asarray(self.rod.about(self.apart, 0.0).turn + self.last.turn)


def _turn(arm: Complex, force: Complex) -> Real:
    """Moment of a force at the end of an arm."""
    return np.imag(np.conj(arm) * force)


def _of_rods(pair: _Pair, group: Rods) -> tuple[Complex, Real]:
    """Kind 1, the outer force: no moment of the rod about the inner joint, none of the whole about the pivot."""
    rod = group.rod * pair.rod_frame.way[0]
    inner, whole = -rod, -pair.apart
    bite = _turn(pair.rod_frame.way[0], pair.last_frame.way[0])
    # the triangle of the rod and the pivot, twice: rod times rocker times the sine between them
    area = group.rod * group.rocker * bite
    force = (pair.rod.about(rod, 0.0).turn * whole - pair.about_last() * inner) / area
    return force, np.abs(bite)


def _of_slider(pair: _Pair, group: Slider) -> tuple[Complex, Real]:
    """Kind 2, the outer force: nothing left along the guide, no moment of the rod about the slider's pin."""
    rod, guide = group.rod * pair.rod_frame.way[0], pair.last_frame.way[0]
    along = -np.real(np.conj(guide) * (pair.rod.force + pair.last.force))
    bite = np.real(np.conj(pair.rod_frame.way[0]) * guide)
    across = (pair.rod.about(rod, 0.0).turn - along * _turn(rod, guide)) / (group.rod * bite)
    return guide * (along + 1j * across), np.abs(bite)


def _of_stone(pair: _Pair, crank: float) -> tuple[Complex, Real]:
    """Kind 3, the outer force: nothing left on the stone along the lever, no moment of both about the pivot."""
    lever = pair.rod_frame.way[0]
    reach = np.abs(pair.apart)
    along = -np.real(np.conj(lever) * pair.rod.force)
    return lever * (along - 1j * pair.about_last() / reach), np.minimum(reach / crank, 1.0)

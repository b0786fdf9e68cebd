"""A mechanism in motion: where every link stands, as Taylor series in the parameter t of its drives.

::

    reducer = moving(james, (Drive("1"),))              # t: turns of link 1
    place, angle = reducer.pose("2", np.array([0.0, 0.3]), 2)

Turns add up as fractions, and whole turns are dropped before they become radians: no ratio is too large.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from fractions import Fraction
from graphlib import CycleError, TopologicalSorter
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.record import Record, replace
from geometry.base.series import Series, exponential, product
from geometry.curves.curve import Complex, Real
from geometry.kinematics.mechanism import (
    FRAME,
    Fixed,
    Group,
    Mechanism,
    Prismatic,
    Revolute,
    Rolling,
    Tree,
    Turns,
    Uneven,
    Z,
    lead,
    tree,
    turns,
)
from geometry.kinematics.motion import Pose

if TYPE_CHECKING:
    from geometry.base.placement import Placement3, Vector

# rad or mm of one turn, or of one unit of travel
_TURN, _TRAVEL = 2 * math.pi, math.pi


class Drive(Record):
    """``start`` + ``rate`` t turns of a link, or travel of a slide in units of pi mm; or the ``law`` that it follows.

    The law gives the Taylor series of the angle (rad) or of the travel (mm) over t, from (t, order).
    """

    link: str
    rate: Fraction = Fraction(1)
    start: Fraction = Fraction(0)
    law: Callable[[Real, int], Series] | None = None


class _Course(Record):
    """A turn or a travel over t: an exact line, and shares (rad or mm) of drives with laws and of groups' links."""

    start: Fraction = Fraction(0)
    rate: Fraction = Fraction(0)
    shares: tuple[tuple[str, float], ...] = ()


class _Body(NamedTuple):
    """Origin of a link's frame, its turn since the start, and exp(i turn)."""

    origin: Series
    turn: Series
    unit: Series


class Moving(Record):
    """A mechanism with its drives, made by ``moving``. ``starts``: origin and angle of each link's frame."""

    stands: Tree
    turns: Turns
    drives: Mapping[str, Drive]
    courses: Mapping[str, _Course]
    starts: Mapping[str, tuple[complex, float]]
    needs: Mapping[str, tuple[str, ...]]
    leads: Mapping[str, Uneven]

    def driven(self, drives: Iterable[Drive]) -> Moving:
        """The same mechanism, its drives' lines or laws exchanged for others of the same links."""
        by_link = {drive.link: drive for drive in drives}
        return replace(self, drives=by_link, courses=_courses(self.turns, self.stands, by_link))

    def pose(self, link: str, t: Real, order: int) -> Pose:
        """Origin (complex, mm) and angle (rad) of a link's frame: coefficients 0 to ``order`` over t, shaped as t.

        The turn since the start is within half a turn either way. A link on a tilted axis has none: KeyError.
        """
        return self.poses(t, order, (link,))[link]

    def poses(self, t: Real, order: int, links: Iterable[str] | None = None) -> dict[str, Pose]:
        """The poses of these links, or of all that move in the plane."""
        wanted = [name for name in self.starts if name != FRAME] if links is None else list(links)
        starts = {name: self.starts[name] for name in wanted}
        bodies = self._bodies(np.asarray(t, dtype=float), order, wanted)
        return {name: _pose(start, bodies[name]) for name, start in starts.items()}

    def turned(self, link: str, t: Real) -> Real:
        """How far a link has turned about its own axis since the start, as its quantity counts, rad, shaped as t."""
        t = np.asarray(t, dtype=float)
        found = self._bodies(t, 0, [link])[link].turn[0] * self.stands.sense(link)
        return np.asarray(np.broadcast_to(found, t.shape))

    def displacement(self, link: str, t: Real) -> tuple[Real, Real]:
        """How a link has moved in space since the start: turns (..., 3, 3), then moves (..., 3) in mm, shaped as t."""
        t = np.asarray(t, dtype=float)
        return self._displaced(link, self._bodies(t, 0, [] if link == FRAME else [link]), t.shape)

    def _displaced(self, link: str, bodies: Mapping[str, _Body], shape: tuple[int, ...]) -> tuple[Real, Real]:
        """The same, by the poses and turns of all on which it stands."""
        if link in self.starts:
            body = bodies[link]
            origin, below = np.broadcast_to(body.origin[0], shape), self.starts[link][0]
            unit = np.exp(1j * np.broadcast_to(body.turn[0], shape))
            off = origin - unit * below
            return _about(Z, unit), np.stack([off.real, off.imag, np.zeros(shape)], axis=-1)
        joint = self.stands.supports[link]
        if isinstance(joint, Group):
            assert joint.plane is not None
            own = _about(joint.axis, np.broadcast_to(bodies[link].unit[0], shape))
            off, home = np.broadcast_to(bodies[link].origin[0], shape), np.array(joint.plane.translation)
            across = np.stack([off.real, off.imag, np.zeros(shape)], axis=-1) @ np.array(joint.plane.rotation).T
            return own, home + across - own @ home
        turned, moved = self._displaced(joint.on, bodies, shape)
        if isinstance(joint, Revolute):
            row = self.stands.turn(link, joint.on)
            angle = sum((float(share) * bodies[name].turn[0] for name, share in row.items()), np.zeros(shape))
            own = _about(joint.axis, np.exp(1j * np.broadcast_to(angle, shape)))
            at = np.array([joint.at.real, joint.at.imag, joint.z])
            return np.asarray(turned @ own), moved + _turned(turned, at - own @ at)
        if isinstance(joint, Prismatic):
            way = np.array([joint.direction.real, joint.direction.imag, joint.rise])
            return turned, moved + _turned(turned, np.broadcast_to(bodies[link].turn[0], shape)[..., None] * way)
        return turned, moved

    def _bodies(self, t: Real, order: int, wanted: list[str]) -> dict[str, _Body]:
        """These links and all that they need; of those on tilted axes their turns (of slides the travel) alone."""
        still = [0.0 * t] * (order + 1)
        bodies = {FRAME: _Body([x + 0j for x in still], still, [1 + 0j + still[0], *(x + 0j for x in still[1:])])}
        inputs = {name: drive.law(t, order) for name, drive in self.drives.items() if drive.law}
        for name in self._all_needed(wanted):
            joint = self.stands.supports[name]
            for other, _ in self.courses[name].shares:
                if other in self.leads and other not in inputs:
                    inputs[other] = self.leads[other].ahead(bodies[self.leads[other].driver].turn)
            if name not in self.starts and not isinstance(joint, Group):
                turn = bodies[joint.on].turn if isinstance(joint, Fixed) else self._series(name, t, order, inputs)
                nowhere = [np.full(t.shape, np.nan)] * (order + 1)
                bodies[name] = _Body(nowhere, turn, nowhere)
            elif isinstance(joint, Group):
                if joint.plane is None:
                    on = [_pose(self.starts[other], bodies[other]) for other in joint.on]
                else:
                    on = [self._seen_in(joint.plane, other, bodies, (t, order)) for other in joint.on]
                if joint.counts:
                    place, turn = on[0]
                    on[0] = place, [turn[0] + _TURN * self._whole_turns(joint.on[0], t), *turn[1:]]
                origin, angle = joint.poses(on)[joint.links.index(name)]
                start = self.starts[name][1] if joint.plane is None else 0.0
                inputs[name] = [angle[0] - start, *angle[1:]]
                bodies[name] = _Body(origin, inputs[name], exponential([1j * x for x in inputs[name]]))
            else:
                bodies[name] = self._moved(name, joint, bodies[joint.on], (t, order), inputs)
        return bodies

    def _whole_turns(self, link: str, t: Real) -> Real:
        """How many turns are left out of a link's since the start, where a drive alone turns it."""
        while isinstance(joint := self.stands.supports[link], Fixed):
            link = joint.on
        turns = float(self.courses[link].start) + float(self.courses[link].rate) * t
        return np.asarray(np.rint(turns - _line(self.courses[link], t, slides=False) / _TURN))

    def _seen_in(self, plane: Placement3, link: str, bodies: Mapping[str, _Body], at: tuple[Real, int]) -> Pose:
        """How the frame of a plane has moved in it with a link; what it does next is not told."""
        t, order = at
        turned, moved = self._displaced(link, bodies, t.shape)
        own, home = np.array(plane.rotation), np.array(plane.translation)
        across, off = own.T @ turned @ own, (turned @ home + moved - home) @ own
        unknown = [np.full(t.shape, np.nan)] * order
        origin, angle = off[..., 0] + 1j * off[..., 1], np.arctan2(across[..., 1, 0], across[..., 0, 0])
        return [origin, *unknown], [angle, *unknown]

    def _moved(
        self, name: str, joint: Fixed | Revolute | Prismatic, on: _Body, at: tuple[Real, int], inputs: dict[str, Series]
    ) -> _Body:
        """A link on another one: the vectors of the start, turned."""
        own, below = self.starts[name][0], self.starts[joint.on][0]
        if isinstance(joint, Revolute):
            turn = self._series(name, *at, inputs)
            unit = exponential([1j * x for x in turn])
            arm, rest = joint.at - below, own - joint.at
            origin = [o + arm * u + rest * v for o, u, v in zip(on.origin, on.unit, unit, strict=True)]
            return _Body(origin, turn, unit)
        arm = own - below
        origin = [o + arm * u for o, u in zip(on.origin, on.unit, strict=True)]
        if isinstance(joint, Prismatic):
            way = product([joint.direction * x for x in self._series(name, *at, inputs)], on.unit)
            origin = [o + w for o, w in zip(origin, way, strict=True)]
        return _Body(origin, on.turn, on.unit)

    def _series(self, name: str, t: Real, order: int, inputs: dict[str, Series]) -> Series:
        """A link's own turn (rad) or travel (mm)."""
        course = self.courses[name]
        slides = isinstance(self.stands.supports[name], Prismatic)
        way = _line(course, t, slides=slides)
        rate = float(course.rate) * (_TRAVEL if slides else _TURN)
        series = [way, *(rate + 0.0 * t if k == 1 else 0.0 * t for k in range(1, order + 1))]
        for other, share in course.shares:
            series = [x + share * y for x, y in zip(series, inputs[other], strict=True)]
        return series

    def _all_needed(self, wanted: list[str]) -> list[str]:
        """What must be known for these links, each after what it needs itself."""
        found = dict.fromkeys(wanted)
        for name in (queue := list(found)):
            more = [other for other in self.needs[name] if other not in found]
            found.update(dict.fromkeys(more))
            queue.extend(more)
        return [name for name in self.needs if name in found]


def moving(mechanism: Mechanism, drives: Iterable[Drive]) -> Moving:
    """A mechanism moved by drives; what they leave free stands still against the frame.

    Raises
    ------
    ParameterError
        A joint does not fit, drives or held links contradict each other, or a law hangs on itself.
    """
    by_link = {drive.link: drive for drive in drives}
    found = turns(mechanism, by_link)
    stands = tree(mechanism)
    courses = _courses(found, stands, by_link)
    leads = {lead(joint): joint.uneven for joint in mechanism.joints if isinstance(joint, Rolling) and joint.uneven}
    for number, joint in enumerate(mechanism.joints, 1):
        if isinstance(joint, Group):
            for other in joint.on:
                if not (in_plane(other, stands) if joint.plane is None else stands.keeps(other, joint.axis)):
                    raise ParameterError(f"joints[{number}].on", other, "leaves_its_plane")
    planar = {name for name in stands.order if in_plane(name, stands)}
    needs = {name: _needs(name, stands, courses, leads) for name in stands.order}
    try:
        order = [name for name in TopologicalSorter(needs).static_order() if name != FRAME]
    except CycleError as error:
        raise ParameterError("joints", error.args[1][0], "moves_itself") from None
    starts = _starts([name for name in stands.order if name in planar], stands)
    return Moving(stands, found, by_link, courses, starts, {name: needs[name] for name in order}, leads)


def _courses(found: Turns, stands: Tree, drives: Mapping[str, Drive]) -> dict[str, _Course]:
    def unit(link: str) -> float:
        return _TRAVEL if isinstance(stands.supports.get(stands.body(link)), Prismatic) else _TURN

    courses = {name: _Course() for name in stands.order}
    for name in stands.quantities():
        start = rate = Fraction()
        shares = []
        for other, share in found.shares.get(name, {}).items():
            drive = drives.get(other)
            if drive is None or drive.law is not None:
                shares.append((other, float(share) * unit(name) / unit(other)))
            else:
                start, rate = start + share * drive.start, rate + share * drive.rate
        courses[name] = _Course(start, rate, tuple(shares))
    return courses


def _needs(name: str, stands: Tree, courses: Mapping[str, _Course], leads: Mapping[str, Uneven]) -> tuple[str, ...]:
    joint = stands.supports[name]
    on = list(joint.on) if isinstance(joint, Group) else [joint.on]
    shares = [other for other, _ in courses[name].shares]
    inputs = [leads[other].driver for other in shares if other in leads]
    inputs += [other for other in shares if isinstance(stands.supports.get(other), Group)]
    return tuple(other for other in (*on, *inputs) if other != FRAME)


def _pose(start: tuple[complex, float], body: _Body) -> Pose:
    return body.origin, [start[1] + body.turn[0], *body.turn[1:]]


def _about(axis: Vector, unit: Complex) -> Real:
    """Turns (..., 3, 3) about a unit vector by the angles of numbers of modulus 1 (Rodrigues)."""
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    sine, cosine = unit.imag[..., None, None], unit.real[..., None, None]
    return np.asarray(cosine * np.eye(3) + sine * cross + (1 - cosine) * np.outer(axis, axis))


def _turned(turns: Real, ways: Real) -> Real:
    return np.asarray(np.einsum("...ij,...j->...i", turns, ways))


def in_plane(link: str, stands: Tree) -> bool:
    """Whether a link moves in the fixed frame's plane, all axes on which it stands pointing up."""
    while link != FRAME:
        joint = stands.supports[link]
        if isinstance(joint, Group):
            return joint.plane is None and all(in_plane(name, stands) for name in joint.on)
        if (isinstance(joint, Revolute) and joint.axis != Z) or (isinstance(joint, Prismatic) and joint.rise):
            return False
        link = joint.on
    return True


def _starts(order: list[str], stands: Tree) -> dict[str, tuple[complex, float]]:
    """Origin and angle of each frame at the start: as given, on the link's axis, or where its group has it."""
    starts: dict[str, tuple[complex, float]] = {FRAME: (0j, 0.0)}
    zero = np.zeros(())
    for name in order:
        joint = stands.supports[name]
        if isinstance(joint, Group):
            on = [([starts[other][0] + zero], [starts[other][1] + zero]) for other in joint.on]
            origin, angle = joint.poses(on)[joint.links.index(name)]
            starts[name] = complex(origin[0]), float(angle[0])
        else:
            starts[name] = stands.mechanism.starts.get(name, (joint.at if isinstance(joint, Revolute) else 0j, 0.0))
    return starts


def _line(course: _Course, t: Real, *, slides: bool) -> Real:
    """start + rate t in rad, reduced to half a turn either way; of a slide in mm, as it is."""
    rate = float(course.rate)
    if slides:
        return np.asarray((float(course.start) + rate * t) * _TRAVEL)
    # whole turns are dropped from the product's two parts (Dekker), and from what the rate is beyond a float
    turns = rate * t
    rest = _beyond(rate, t, turns) + float(course.rate - Fraction(rate)) * t
    found = (turns - np.rint(turns)) + (rest - np.rint(rest)) + float(course.start % 1)
    return np.asarray((found - np.rint(found)) * _TURN)


def _beyond(one: float, two: Real, product: Real) -> Real:
    """What a rounded product leaves out, exactly."""
    (a, b), (c, d) = _halves(np.asarray(one)), _halves(two)
    return np.asarray(((a * c - product) + a * d + b * c) + b * d)


def _halves(value: Real) -> tuple[Real, Real]:
    """A double as the sum of two of 26 bits (Veltkamp)."""
    big = 134217729.0 * value
    high = big - (big - value)
    return high, value - high

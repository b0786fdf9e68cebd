"""Plane lever mechanisms of class II: a crank about the origin and dyads of Assur, joined one after the other.

The place of a dyad follows from what it is joined to in closed form; over Taylor series in time the same forms give
velocities and accelerations, exactly. Frame: O1 is the origin, angles are counter-clockwise from +x. Lengths in mm.

Sources: guidelines on coursework (Orenburg), 3.4; I. I. Artobolevsky, Theory of Mechanisms and Machines, 3 and 4.
"""

from __future__ import annotations

import cmath
import math

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import ParameterError, limit
from geometry.base.record import Record
from geometry.base.roots import crests, tops
from geometry.base.series import Series, affine, conjugate, derived, modulus_square, power, product, unit
from geometry.curves.curve import Complex, Real
from geometry.kinematics.linkage import cosine_range

# what an offered length leaves, parts of it: at the very limit the links stand in one line
_ROOM = 1e-6
# parts of its links by which a group may still be apart where it is at its limit: a root has half of the digits
_AT_LIMIT = 1e-7
# positions of the crank beside which what is greatest over a turn is sought
_SAMPLES = 720


class Stone(Record):
    """Links 2 and 3 as a stone on the crank's end that slides in a lever about ``pivot`` (group of kind 3)."""

    pivot: complex


class Rods(Record):
    """A rod from a joint and a rocker about ``pivot`` (group of kind 1), ``side`` 1: the pivot lies on the left of
    the way from the joint to the rod's other end, seen along it; -1: on the right.
    """

    pivot: complex
    rod: float
    rocker: float
    side: int = 1


class Slider(Record):
    """A rod from a joint to a slider (group of kind 2): its guide runs through ``on`` at ``angle``, rad.

    ``side`` 1: the slider lies ahead of the joint along the guide, -1: behind it.
    """

    rod: float
    on: complex = 0j
    angle: float = 0.0
    side: int = 1


class Moved(Record):
    """Points (mm) and directions of links (unit vectors) as Taylor series in time, s, over the crank's positions.

    ``reach``: O3A where a stone slides, mm.
    """

    points: dict[str, Series]
    links: dict[str, Series]
    reach: Series | None = None

    def place(self, name: str) -> Complex:
        """Where a point is, mm."""
        return np.asarray(self.points[name][0])

    def velocity(self, name: str) -> Complex:
        """mm/s."""
        return np.asarray(self.points[name][1])

    def acceleration(self, name: str) -> Complex:
        """mm/s^2."""
        return np.asarray(2 * self.points[name][2])

    def angle(self, link: str) -> Real:
        """Direction of a link, rad."""
        return np.angle(self.links[link][0])

    def turning(self, link: str) -> tuple[Real, Real]:
        """Angular velocity (rad/s) and acceleration (rad/s^2) of a link, counter-clockwise."""
        return turning(self.links[link])


class Levers(Record):
    """A crank OA of length ``crank`` that turns at ``speed`` (rad/s, counter-clockwise) and its dyads.

    ``first`` joins A: a stone in a lever, a rod with a rocker, or a rod with a slider. ``lever``: O3B on the lever;
    ``arm``: O3C seen from the direction of the lever (O3A or O3B), complex, mm; ``second`` joins C, or beside a first
    slider A too: both on one crank; ``change``: the crank's angular acceleration, rad/s^2, 0 where it turns evenly.
    """

    crank: float
    speed: float
    first: Stone | Rods | Slider
    lever: float = 0.0
    arm: complex = 0j
    second: Rods | Slider | None = None
    change: float = 0.0

    @property
    def links(self) -> int:
        """n, moving links: each dyad adds two."""
        return 3 if self.second is None else 5

    @property
    def lower_pairs(self) -> int:
        """p5: each dyad adds three."""
        return 4 if self.second is None else 7

    def moved(self, angles: ArrayLike) -> Moved:
        """Everything at angles of the crank, rad.

        Raises
        ------
        ParameterError
            What ``closed`` raises, where the links do not close at one of them.
        """
        with np.errstate(invalid="ignore", divide="ignore"):
            found = self._moved(np.asarray(angles, dtype=float))
        if not all(np.isfinite(series[2]).all() for series in found.points.values()):
            closed(self)
        return found

    def _moved(self, phi: Real) -> Moved:
        """The same, not a number where the links do not close."""
        w = 1j * self.speed
        crank = self.crank * np.exp(1j * phi)
        end: Series = [crank, w * crank, (w * w + 1j * self.change) * crank / 2]
        if isinstance(self.first, Slider):
            slider, rod = _slid(end, self.first)
            points, links = {"A": end, "B": slider}, {"2": rod}
            if isinstance(self.second, Slider):
                points["D"], links["4"] = _slid(end, self.second)
            return Moved(points, links)
        reach: Series | None = None
        if isinstance(self.first, Stone):
            spoke = _from(end, self.first.pivot)
            reach, lever = power(modulus_square(spoke), 0.5), unit(spoke)
            links = {"3": lever}
        else:
            joint = _joined(end, self.first)
            links = {"2": unit(_minus(joint, end)), "3": unit(_from(joint, self.first.pivot))}
            lever = links["3"]
        points = {"A": end, "B": affine(self.first.pivot, self.lever, lever)}
        if self.second is not None:
            own = affine(self.first.pivot, self.arm, lever)
            points["C"] = own
            if isinstance(self.second, Slider):
                points["D"], links["4"] = _slid(own, self.second)
            else:
                points["D"] = _joined(own, self.second)
                links["4"] = unit(_minus(points["D"], own))
                links["5"] = unit(_from(points["D"], self.second.pivot))
        return Moved(points, links, reach)


def turning(way: Series) -> tuple[Real, Real]:
    """Angular velocity (rad/s) and acceleration (rad/s^2) of a direction, counter-clockwise."""
    rate = product(conjugate(way), derived(way))
    return np.imag(rate[0]), np.imag(rate[1])


def members(levers: Levers) -> dict[str, str]:
    """The numbers of the moving links by what they are called; the crank's is 1."""
    found = {"stone" if isinstance(levers.first, Stone) else "rod": "2"}
    found["slider" if isinstance(levers.first, Slider) else "lever"] = "3"
    if levers.second is not None:
        found |= {"second_rod": "4", "slider" if isinstance(levers.second, Slider) else "second_rocker": "5"}
    return found


def lengths(levers: Levers) -> dict[str, float]:
    """From joint to joint of the links that have two of them, mm, by what they are called."""
    found = {} if isinstance(levers.first, Stone) else {"rod": levers.first.rod}
    if levers.second is not None:
        found["second_rod"] = levers.second.rod
    if isinstance(levers.second, Rods):
        found["second_rocker"] = levers.second.rocker
    return found


class Travel(Record):
    """The ``least`` and the ``greatest`` place of a link over a turn: mm along its guide from what that runs through,
    or its direction, rad. ``ratio``: of the crank's angles of both ways, the longer one first; None of what goes round
    or turns back more often.
    """

    least: float
    greatest: float
    ratio: float | None = None

    @property
    def run(self) -> float:
        """From one to the other: a stroke, mm, or a swing, rad."""
        return self.greatest - self.least


def travel(levers: Levers, member: str) -> Travel:
    """How far a link moves over a turn of the crank.

    Raises
    ------
    ParameterError
        What ``closed`` raises, where the links do not close all the way.
    """
    link, step = members(levers)[member], 2 * math.pi / _SAMPLES
    angles: Real = step * np.arange(_SAMPLES, dtype=float)
    if member == "slider":
        joint, group = ("B", levers.first) if levers.second is None else ("D", levers.second)
        assert isinstance(group, Slider)
        on, way = group.on, cmath.exp(-1j * group.angle)

        def place(turned: Real) -> Real:
            return np.real((levers.moved(turned).place(joint) - on) * way)
    else:
        # beside a direction between both ends no angle jumps
        key = "3" if member == "stone" else link
        seen = np.unwrap(levers.moved(np.append(angles, 2 * math.pi)).angle(key))
        if abs(seen[-1] - seen[0]) > math.pi:
            return Travel(0.0, 2 * math.pi)
        middle = float(seen.min() + seen.max()) / 2

        def place(turned: Real) -> Real:
            return middle + np.angle(levers.moved(turned).links[key][0] * cmath.exp(-1j * middle))

    values = place(angles)
    peaks, hollows = (crests(of, angles[tops(sign * values)], step)
                      for sign, of in ((1, place), (-1, lambda turned: -place(turned))))  # fmt: skip
    where = np.concatenate([peaks, hollows, angles])
    values = place(where)
    low, high = where[[values.argmin(), values.argmax()]]
    way, rises = abs(high - low) % (2 * math.pi), np.diff(place(angles), append=place(angles[:1])) > 0
    turns = np.count_nonzero(rises != np.roll(rises, 1))
    ratio = float(max(way, 2 * math.pi - way) / min(way, 2 * math.pi - way)) if turns == 2 else None
    return Travel(float(values.min()), float(values.max()), ratio)


def swing(levers: Levers) -> tuple[float, float]:
    """The directions between which the lever swings over a turn of the crank, rad; a whole turn where it goes round."""
    first, a = levers.first, levers.crank
    assert not isinstance(first, Slider)
    far, home = abs(first.pivot), cmath.phase(-first.pivot)
    if isinstance(first, Stone):
        half = math.asin(a / far) if a < far else math.pi
        return home - half, home + half
    # the lever stands still where crank and rod are in line
    b, c = first.rod, first.rocker
    ends = [(far**2 + c**2 - (b + k * a) ** 2) / (2 * far * c) for k in (-1, 1)]
    if not all(-1 < cosine < 1 for cosine in ends):
        return home - math.pi, home + math.pi
    low, high = (math.acos(cosine) for cosine in ends)
    # on the side of O3O1 on which B stands
    return (home + low, home + high) if first.side > 0 else (home - high, home - low)


def ranges(levers: Levers) -> list[tuple[float, float]]:
    """The angles of the crank, rad, between which the links close, without a limit between; a whole turn is (0, 2 pi).

    A group is at a limit where its links stand in one line, or a rod across its guide; at some of them, found in closed
    form, the links close on both sides.
    """
    marks = np.unique(np.mod(_limits(levers), 2 * math.pi))
    marks = marks[np.abs(_spare(levers, marks)) <= _AT_LIMIT]
    if not marks.size:
        return [(0.0, 2 * math.pi)] if _spare(levers, np.zeros(1))[0] > 0 else []
    ends = np.append(marks[1:], marks[0] + 2 * math.pi)
    inside = _spare(levers, (marks + ends) / 2) > _AT_LIMIT
    return [(float(low), float(high)) for low, high in zip(marks[inside], ends[inside], strict=True)]


def _limits(levers: Levers) -> list[float]:
    """Angles of the crank at which a group may be at a limit, rad."""
    first, second, a = levers.first, levers.second, levers.crank
    if isinstance(first, Slider):
        on_crank = [group for group in (first, second) if isinstance(group, Slider)]
        return [x for s in on_crank for k in (-1, 1) for x in _level(a, _height(s) + k * s.rod, s.angle)]
    far, home = abs(first.pivot), cmath.phase(first.pivot)
    found = [home]
    if isinstance(first, Rods):
        found = [x for k in (-1, 1) for x in _spanned(far, a, first.rod + k * first.rocker, home)]
    if second is None:
        return found
    arm, turn = abs(levers.arm), cmath.phase(levers.arm)
    if isinstance(second, Slider):
        height = ((second.on - first.pivot) * cmath.exp(-1j * second.angle)).imag
        swung = [x for k in (-1, 1) for x in _level(arm, height + k * second.rod, second.angle)]
    else:
        apart = second.pivot - first.pivot
        swung = [
            x for k in (-1, 1) for x in _spanned(abs(apart), arm, second.rod + k * second.rocker, cmath.phase(apart))
        ]
    for psi in (x - turn for x in swung):
        if isinstance(first, Stone):
            found += _level(a, (first.pivot * cmath.exp(-1j * psi)).imag, psi)
        else:
            end = first.pivot + cmath.rect(first.rocker, psi)
            found += _spanned(abs(end), a, first.rod, cmath.phase(end))
    return found


def _spare(levers: Levers, angles: Real) -> Real:
    """By what part of its links the group that is nearest to a limit is within it; below 0 where it does not close."""
    with np.errstate(invalid="ignore", divide="ignore"):
        at = levers._moved(angles)
    spare = _room(levers.first, at.place("A"))
    if levers.second is None:
        return spare
    joint = "A" if isinstance(levers.first, Slider) else "C"
    return np.where(spare > 0, np.fmin(spare, _room(levers.second, at.place(joint))), spare)


def _room(group: Stone | Rods | Slider, joint: Complex) -> Real:
    """By what part of its links a group is within its limits, with its joint at these places."""
    if isinstance(group, Slider):
        return 1 - np.abs(((joint - group.on) * cmath.exp(-1j * group.angle)).imag) / group.rod
    apart = np.abs(joint - group.pivot)
    if isinstance(group, Stone):
        return np.asarray(apart / abs(group.pivot))
    links = group.rod, group.rocker
    return np.minimum(sum(links) - apart, apart - abs(links[0] - links[1])) / sum(links)


def _level(arm: float, height: float, along: float) -> list[float]:
    """Directions of an arm about a pivot whose end stands at a height above a line through it."""
    return _about(height / arm, along + math.pi / 2)


def _spanned(far: float, arm: float, apart: float, way: float) -> list[float]:
    """Directions of an arm whose end is so far from a point, which lies ``far`` off that way."""
    return _about((far**2 + arm**2 - apart**2) / (2 * far * arm), way) if far else []


def _about(cosine: float, way: float) -> list[float]:
    """Directions with this cosine about a way; at its end rounding does not count."""
    if abs(cosine) > 1 + 1e-12:
        return []
    half = math.acos(max(-1.0, min(1.0, cosine)))
    return [way - half, way + half]


def closed(levers: Levers) -> None:
    """Refuse links that cannot follow a whole turn of the crank.

    Raises
    ------
    ParameterError
        ``first.rod``, ``first.pivot`` or ``second.rod``, with the nearest that can.
    """
    first, second, a = levers.first, levers.second, levers.crank
    if isinstance(first, Slider):
        for group, name in ((first, "first.rod"), (second, "second.rod")):
            if isinstance(group, Slider):
                _refuse_short(group, (-a - _height(group), a - _height(group)), name)
        return
    far = abs(first.pivot)
    if isinstance(first, Stone):
        if far == a:
            raise ParameterError("first.pivot", far, "stone_through_pivot")
    else:
        least, most = far - a if far > a else a - far, far + a
        _refuse_apart(first, (least, most), "first.rod")
    if second is None:
        return
    low, high = swing(levers)
    length, turn = abs(levers.arm), cmath.phase(levers.arm)
    if isinstance(second, Slider):
        # heights of C above the guide: the sine of its direction against it
        ends = cosine_range(low + turn - second.angle - math.pi / 2, high + turn - second.angle - math.pi / 2)
        from_pivot = ((first.pivot - second.on) * cmath.exp(-1j * second.angle)).imag
        _refuse_short(second, (from_pivot + length * ends[0], from_pivot + length * ends[1]), "second.rod")
        return
    apart = second.pivot - first.pivot
    ends = cosine_range(low + turn - cmath.phase(apart), high + turn - cmath.phase(apart))
    squares = [length**2 + abs(apart) ** 2 - 2 * length * abs(apart) * cosine for cosine in ends]
    _refuse_apart(second, (math.sqrt(max(min(squares), 0.0)), math.sqrt(max(squares))), "second.rod")


def _height(slider: Slider) -> float:
    """How far the guide passes to the left of the origin's own parallel, mm."""
    return (slider.on * cmath.exp(-1j * slider.angle)).imag


def _refuse_short(slider: Slider, heights: tuple[float, float], name: str) -> None:
    least = max(map(abs, heights))
    if slider.rod <= least:
        raise ParameterError.beyond(name, slider.rod, "rod_does_not_reach", least * (1 + _ROOM), least=least)


def _refuse_apart(rods: Rods, between: tuple[float, float], name: str) -> None:
    """A rod and a rocker span distances from |rod - rocker| to rod + rocker."""
    (near, far), rod, rocker = between, rods.rod, rods.rocker
    least, most = max(far - rocker, rocker - near), rocker + near
    if least < rod < most:
        return
    cure = None
    if least * (1 + _ROOM) < most * (1 - _ROOM):
        cure = limit(least * (1 + _ROOM) if rod <= least else most * (1 - _ROOM), rod)
    raise ParameterError(name, rod, "rods_do_not_close", cure, nearest=near, farthest=far)


def _from(point: Series, pivot: complex) -> Series:
    return [point[0] - pivot, *point[1:]]


def _minus(one: Series, two: Series) -> Series:
    return [a - b for a, b in zip(one, two, strict=True)]


def _slid(joint: Series, slider: Slider) -> tuple[Series, Series]:
    """The slider's place, and the direction of its rod."""
    way = cmath.exp(1j * slider.angle)
    seen = [x * way.conjugate() for x in _from(joint, slider.on)]
    across = [np.imag(x) for x in seen]
    square = [-x for x in product(across, across)]
    square[0] = square[0] + slider.rod**2
    ahead = power(square, 0.5)
    travel = [np.real(x) + slider.side * y for x, y in zip(seen, ahead, strict=True)]
    place = [way * x for x in travel]
    place[0] = place[0] + slider.on
    return place, unit(_minus(place, joint))


def _joined(joint: Series, rods: Rods) -> Series:
    """The common end of a rod from a joint and a rocker: the corner of a triangle with three known sides."""
    base = [-x for x in _from(joint, rods.pivot)]
    inverse = power(modulus_square(base), -1.0)
    # along and across the way to the pivot, in parts of it
    along = [(rods.rod**2 - rods.rocker**2) / 2 * x for x in inverse]
    along[0] = along[0] + 0.5
    across = [rods.rod**2 * x - y for x, y in zip(inverse, product(along, along), strict=True)]
    corner = [x - 1j * rods.side * y for x, y in zip(along, power(across, 0.5), strict=True)]
    return [a + b for a, b in zip(joint, product(base, corner), strict=True)]

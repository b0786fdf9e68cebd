"""Ratchet wheels: teeth of a working face and a slanting back, which a pawl rides in one sense and holds in the other.

The outside diameter, of an internal wheel the inside one, is m z. The working face is a straight line, at the front
angle to the radius through its edge, so tangent to a circle of r sin(front angle) about the axis; the back is straight
too, the root is rounded from the face into the back, or by way of an arc of the root circle.

Frame: the edge of tooth 1 on +x, the tooth beyond it; the wheel is free counter-clockwise, or mirrored.
"""

from __future__ import annotations

import cmath
import math
from functools import cached_property

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import Record
from geometry.curves.line_arc import Line, arc_between
from geometry.gears.teeth.round_teeth import RoundTeeth
from geometry.plane.profile import Label, Profile, Segment
from geometry.solids.hub_holes import HubHoles, least_wall
from geometry.solids.plate import Edge, moved_edges

_NO_HOLES = HubHoles()


def dot(a: complex, b: complex) -> float:
    """The scalar product."""
    return (a * b.conjugate()).real


class Notch(Record):
    """What is cut between two teeth, the working face of tooth 1 at its end; mm.

    The back runs from ``back_start`` on the tip circle along ``way`` to ``back_end``, about ``first`` into the root,
    about ``last`` out of it, and from ``face_end`` to the edge.
    """

    back_start: complex
    back_end: complex
    first: complex
    last: complex
    face_end: complex
    way: complex

    @property
    def has_root_land(self) -> bool:
        """Whether there is an arc of the root circle between both roundings."""
        return self.first != self.last


class RatchetWheel(RoundTeeth, dict=True):
    """Sizes in mm, angles in rad; of ``land`` (along the tip circle) and ``notch_angle`` at least one is given.

    ``ccw``: whether counter-clockwise is the free sense. ``outer_radius``: of an internal wheel.
    """

    tip_radius: float
    depth: float
    front_angle: float
    fillet_radius: float
    land: float | None = None
    notch_angle: float | None = None
    internal: bool = False
    ccw: bool = True
    outer_radius: float = 0.0
    holes: HubHoles = _NO_HOLES

    @property
    def side(self) -> int:
        """1 where the teeth stand outwards, -1 of an internal wheel."""
        return -1 if self.internal else 1

    @property
    def root_radius(self) -> float:
        """Of the circle that the roots touch, mm."""
        return self.tip_radius - self.side * self.depth

    @property
    def face_way(self) -> complex:
        """Along the working face of tooth 1, from its edge into the root."""
        return complex(-self.side * math.cos(self.front_angle), math.sin(self.front_angle))

    @property
    def face_normal(self) -> complex:
        """At right angles to that face, out of the tooth: where it pushes a pawl."""
        return complex(-self.side * math.sin(self.front_angle), -math.cos(self.front_angle))

    @property
    def face_circle_radius(self) -> float:
        """Of the circle about the axis that all working faces point to, mm."""
        return self.tip_radius * abs(math.sin(self.front_angle))

    @cached_property
    def notch(self) -> Notch:
        """Below the edge of tooth 1.

        Raises
        ------
        ParameterError
            There is none; names ``tooth_depth``, ``root_fillet_radius``, ``tip_land`` or ``notch_angle_deg``.
        """
        side, tip, radius = self.side, self.tip_radius, self.fillet_radius
        if not self.root_radius >= least_wall(tip):
            raise ParameterError("tooth_depth", self.depth, "leaves_no_root_circle")
        edge, way, normal = complex(tip), self.face_way, self.face_normal
        depth = "tooth_depth", self.depth
        rounded = self.root_radius + side * radius
        start = edge + radius * normal
        along = -dot(start, way) - side * _root(dot(start, way) ** 2 - abs(start) ** 2 + rounded**2, depth)
        if not (along > 0 and rounded > 0):
            raise ParameterError("root_fillet_radius", radius, "rounding_takes_face")
        last = start + along * way
        if self.notch_angle is None:
            assert self.land is not None
            top = cmath.rect(tip, self.land / tip - self.pitch_angle)
            spoke = last - top
            down = spoke / abs(spoke) * cmath.exp(1j * side * math.asin(min(radius / abs(spoke), 1.0)))
        else:
            down = way * cmath.exp(-1j * side * self.notch_angle)
        out, first, cut = self.back_normal(down), last, self.cut_key
        if self.notch_angle is not None and self.land is None:
            low = last - radius * out
            across = dot(low, down)
            top = low - (across + side * _root(across**2 - abs(low) ** 2 + tip**2, cut)) * down
        elif self.notch_angle is not None:
            assert self.land is not None
            top = cmath.rect(tip, self.land / tip - self.pitch_angle)
            begin = top + radius * out
            across = dot(begin, down)
            first = begin + (-across - side * _root(across**2 - abs(begin) ** 2 + rounded**2, cut)) * down
            if not cmath.phase(last / first) > 0:
                raise ParameterError("tip_land", self.land, "notch_too_narrow")
        return Notch(top, first - radius * out, first, last, last - radius * normal, down)

    @property
    def cut_key(self) -> tuple[str, float | None]:
        """The key of the notch's angle, and its value."""
        return "notch_angle_deg", None if self.notch_angle is None else math.degrees(self.notch_angle)

    def back_normal(self, way: complex) -> complex:
        """At right angles to a back, out of the tooth."""
        return -1j * self.side * way

    @property
    def land_angle(self) -> float:
        """Of the land on a tip, seen from the axis, rad; not above 0 where the tip is pointed."""
        if self.land is not None:
            return self.land / self.tip_radius
        return self.pitch_angle + cmath.phase(self.notch.back_start)

    @property
    def tip_land(self) -> float:
        """Along the tip circle, mm."""
        return self.tip_radius * self.land_angle

    @property
    def face_length(self) -> float:
        """Of the straight working face, mm."""
        return abs(self.notch.face_end - self.tip_radius)

    @property
    def cut_angle(self) -> float:
        """Between working face and back, rad."""
        return abs(cmath.phase(self.notch.way / self.face_way))

    @property
    def root_land_angle(self) -> float:
        """Of the arc of the root circle, seen from the axis, rad; 0 where there is none."""
        return cmath.phase(self.notch.last / self.notch.first)

    @property
    def root_thickness(self) -> float:
        """Chord of a tooth on the root circle, from where the notches touch that, mm."""
        return 2 * self.root_radius * math.sin((self.pitch_angle - self.root_land_angle) / 2)

    @property
    def neck(self) -> float:
        """From the lower end of a working face to the back of its own tooth, mm; not above 0 where they cross."""
        turn = cmath.exp(1j * self.pitch_angle)
        notch = self.notch
        return -dot(notch.face_end - notch.back_start * turn, self.back_normal(notch.way) * turn)

    def period(self) -> tuple[Edge, ...]:
        """Land of tooth 1, notch, face of tooth 2, counter-clockwise; of a wheel that is free counter-clockwise."""
        notch, outwards = self.notch, not self.internal
        edge, turn = complex(self.tip_radius), Placement2(self.pitch_angle)
        cut: list[Edge] = [Line(notch.back_start, notch.back_end)]
        if notch.has_root_land:
            low, high = (centre / abs(centre) * self.root_radius for centre in (notch.first, notch.last))
            if self.fillet_radius > 0:
                cut.append(arc_between(notch.first, notch.back_end, low, not outwards))
            cut.append(arc_between(0j, low, high, True))
            if self.fillet_radius > 0:
                cut.append(arc_between(notch.last, high, notch.face_end, not outwards))
        elif self.fillet_radius > 0:
            cut.append(arc_between(notch.last, notch.back_end, notch.face_end, not outwards))
        cut.append(Line(notch.face_end, edge))
        return arc_between(0j, edge, turn.apply(notch.back_start), True), *(one.placed(turn) for one in cut)

    def outline(self) -> tuple[Edge, ...]:
        """All teeth: counter-clockwise the outside of an external wheel, clockwise the inside of a ring."""
        turns = [Placement2(self.pitch_angle * k) for k in range(self.number_of_teeth)]
        edges: tuple[Edge, ...] = tuple(edge.placed(turn) for turn in turns for edge in self.period())
        if not self.ccw:
            edges = tuple(edge.mirrored() for edge in reversed(edges))
        return tuple(edge.reversed() for edge in reversed(edges)) if self.internal else edges

    def profile(self, offset: float) -> Profile:
        """The outline by its periods, moved ``offset`` mm out of the material.

        Raises
        ------
        GeometryError
            A notch closes, or a tip does not survive.
        """
        edges, teeth = moved_edges(self.outline(), offset), self.number_of_teeth
        return Profile(tuple(Segment(edge, Label.BODY) for edge in edges[: len(edges) // teeth]), teeth, self.internal)


def checked_wheel(wheel: RatchetWheel) -> RatchetWheel:
    """The same wheel, if its teeth exist.

    Raises
    ------
    ParameterError
        Names the key and why.
    """
    least, cut, land = least_wall(wheel.tip_radius), wheel.cut_key, wheel.tip_land
    if not land >= least:
        raise ParameterError(*(("tip_land", land) if wheel.land is not None else cut), "leaves_no_land")
    if not land < wheel.tip_radius * wheel.pitch_angle - least:
        raise ParameterError("tip_land", land, "leaves_no_notch")
    if not back_falls(wheel):
        key = ("tooth_depth", wheel.depth) if wheel.notch_angle is None else cut
        raise ParameterError(*key, "back_does_not_fall")
    if not wheel.neck >= least:
        raise ParameterError("front_angle_deg", math.degrees(wheel.front_angle), "leaves_no_neck")
    return wheel


def back_falls(wheel: RatchetWheel) -> bool:
    """Whether the back begins at a corner of the tip and comes nearer to the root circle all its way."""
    notch = wheel.notch
    falls = all(wheel.side * dot(notch.way, place) < 0 for place in (notch.back_start, notch.back_end))
    return falls and dot(notch.back_end - notch.back_start, notch.way) > 0


def _root(square: float, blamed: tuple[str, float | None]) -> float:
    """The square root; of a line that misses its circle the refusal of a key."""
    if square < 0:
        raise ParameterError(*blamed, "line_misses_circle")
    return math.sqrt(square)

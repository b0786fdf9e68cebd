"""A pawl in thrust for a ratchet wheel: its outline from the notch that it sits in, and how it rides over the teeth.

Seated, its face lies on the working face of tooth 1 and its round nose on the back below it, or on the root circle. As
the wheel turns freely the pawl swings about its pivot; of all pairs of a feature of the pawl (nose, underside, face)
and one of the wheel (back, land, edges) each has its angle of touching in closed form, and the greatest of those
that lie on both is where the pawl stands. The face that is farther from the pivot the deeper it reaches passes an edge
only when that is beyond the nose's reach: the wheel overruns by so much, and the pawl drops then (DERIVATIONS.md, 27).

Frames: all here is in the frame of the wheel that is free counter-clockwise, the pawl seated at tooth 1; the outline
is in the pawl's own: the pivot is the origin, the edge that it holds lies on +x.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from functools import cached_property

from geometry.base.errors import GeometryError, ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import Record
from geometry.curves.curve import end_point
from geometry.curves.line_arc import Line, arc_between
from geometry.gears.ratchets.wheel import RatchetWheel, dot
from geometry.solids.plate import Edge, PlateOutline

# rad, and parts of a length, within which what touches lies on both
_NEAR = 1e-9
# of a pitch: a wheel that has not turned so far has not left the tooth
_SEATED = 1e-9
# of a pitch, in which a pawl falls that has been lifted
_FALL = 0.1
# of the way until the wheel has overrun; rad, of rounding
_PLACES, _ROUNDING = 48, 1e-9


class PawlShape(Record, dict=True):
    """A pawl for a wheel; mm and rad.

    ``length``: from the edge that it holds to the pivot; ``line_angle``: by which that line stands off the tangent of
    the tip circle, to the side where it pulls the pawl in. ``nose_height``: of the face beyond the tip circle.
    ``tail``: length, angle off the line behind the pivot, width of the end; None: there is none.
    """

    wheel: RatchetWheel
    length: float
    line_angle: float
    nose_radius: float
    clearance_angle: float
    clearance: float
    nose_height: float
    boss_radius: float
    tail: tuple[float, float, float] | None = None

    @property
    def edge(self) -> complex:
        """The edge of the tooth that it holds."""
        return complex(self.wheel.tip_radius)

    @property
    def towards_pivot(self) -> complex:
        """From that edge."""
        return complex(self.wheel.side * math.sin(self.line_angle), -math.cos(self.line_angle))

    @property
    def pivot(self) -> complex:
        """Its place."""
        return self.edge + self.length * self.towards_pivot

    @property
    def pivot_distance(self) -> float:
        """From the wheel's axis, mm."""
        return abs(self.pivot)

    @cached_property
    def nose(self) -> complex:
        """The middle of the round nose: on the back, or on the root circle where it meets that first.

        Raises
        ------
        ParameterError
            The notch does not hold it.
        """
        wheel, radius, notch = self.wheel, self.nose_radius, self.wheel.notch
        start = self.edge + radius * wheel.face_normal
        out, way = wheel.back_normal(notch.way), wheel.face_way
        # depths along the face at which it meets the back and the root circle
        back = (radius - dot(start - notch.back_start, out)) / dot(way, out)
        low, across = wheel.root_radius + wheel.side * radius, dot(start, way)
        square = across**2 - abs(start) ** 2 + low**2
        root = -across - wheel.side * math.sqrt(square) if square > 0 and low > 0 else -math.inf
        depth = min(back, root)
        if not (radius >= wheel.fillet_radius * (1 - _NEAR) and depth > 0):
            raise ParameterError("nose_radius", radius, "nose_does_not_fit")
        return start + depth * way

    @property
    def contact_depth(self) -> float:
        """Length of the face that lies on the tooth's, mm."""
        return dot(self.nose - self.edge, self.wheel.face_way)

    @property
    def pull_in_angle(self) -> float:
        """Between the push of the tooth at its edge and the line to the pivot, rad: above 0 it pulls the pawl in."""
        return self.wheel.front_angle + self.line_angle

    @cached_property
    def _under(self) -> tuple[complex, complex, complex]:
        """The underside: where it leaves the nose, and where it reaches the clear circle; its outward normal."""
        wheel = self.wheel
        way = -wheel.notch.way * cmath.exp(1j * wheel.side * self.clearance_angle)
        out = wheel.back_normal(way)
        start = self.nose + self.nose_radius * out
        across = dot(start, way)
        square = across**2 - abs(start) ** 2 + self.clear_radius**2
        if square < 0:
            raise ParameterError("clearance_angle_deg", math.degrees(self.clearance_angle), "pawl_stays_in_teeth")
        knee = start + (wheel.side * math.sqrt(square) - across) * way
        return start, knee, out

    @property
    def knee(self) -> complex:
        """Where the underside comes out of the teeth."""
        return self._under[1]

    @property
    def clear_radius(self) -> float:
        """Of the circle that only the nose passes, mm."""
        return self.wheel.tip_radius + self.wheel.side * self.clearance

    def _lines(self) -> tuple[Line, Line, Line]:
        """Top side from the boss to the face's upper end, the underside, and from its knee to the boss."""
        side, (start, knee, _) = self.wheel.side, self._under
        top = self.edge - self.nose_height * self.wheel.face_way
        low = self._on_boss(knee, side)
        if side > 0 and dot(knee, low - knee) < 0:
            # along the clear circle, until the tangent of both leaves it
            apart, reach = self.pivot_distance, self.clear_radius + self.boss_radius
            leaves = cmath.exp(1j * (cmath.phase(self.pivot) + math.acos(min(reach / apart, 1.0))))
            knee, low = self.clear_radius * leaves, self.pivot - self.boss_radius * leaves
        return Line(self._on_boss(top, -side), top), Line(start, self.knee), Line(knee, low)

    def _on_boss(self, place: complex, side: int) -> complex:
        """Where a line from a place touches the boss, that on the left of it, or (-1) on the right."""
        spoke = self.pivot - place
        if not abs(spoke) > self.boss_radius:
            raise GeometryError("end_within_the_other")
        way = spoke / abs(spoke) * cmath.exp(-1j * side * math.asin(self.boss_radius / abs(spoke)))
        return self.pivot - side * self.boss_radius * 1j * way

    def edges(self) -> tuple[Edge, ...]:
        """The outline in the frame of the wheel, counter-clockwise.

        Raises
        ------
        GeometryError
            It has none.
        """
        side, (upper, under, lower) = self.wheel.side, self._lines()
        left = side > 0
        face_end = self.nose - self.nose_radius * self.wheel.face_normal
        behind: list[Edge]
        if self.tail is None:
            behind = [arc_between(self.pivot, lower.end, upper.start, left)]
        else:
            length, angle, width = self.tail
            way = self.towards_pivot * cmath.exp(1j * side * angle)
            end, radius = self.pivot + length * way, width / 2
            if not length > abs(self.boss_radius - radius):
                raise GeometryError("end_within_the_other")
            lean = math.acos((self.boss_radius - radius) / length)
            one, two = (way * cmath.exp(1j * side * turn) for turn in (-lean, lean))
            away = Line(self.pivot + self.boss_radius * one, end + radius * one)
            back = Line(end + radius * two, self.pivot + self.boss_radius * two)
            lower, begins = self._joined(lower, away)
            back, ends = self._joined(back, upper)
            behind = [*begins, arc_between(end, away.end, back.start, left), back, *ends[:-1]]
            upper = Line(end_point(behind[-1]), upper.end)
        edges: list[Edge] = [
            upper,
            Line(upper.end, face_end),
            arc_between(self.nose, face_end, under.start, left),
            under,
            *([arc_between(0j, under.end, lower.start, False)] if lower.start != under.end else []),
            lower,
            *behind,
        ]
        return tuple(edges) if left else tuple(edge.reversed() for edge in reversed(edges))

    def _joined(self, before: Line, after: Line) -> tuple[Line, tuple[Edge, ...]]:
        """Two lines that touch the boss, with what of it is between them; cut at each other where nothing is."""
        turn = cmath.phase((after.start - self.pivot) / (before.end - self.pivot))
        if self.wheel.side * turn >= 0:
            return before, (arc_between(self.pivot, before.end, after.start, self.wheel.side > 0), after)
        # both touch the circle: they meet on the middle spoke
        middle = (before.end + after.start) / 2 - self.pivot
        corner = self.pivot + middle * (self.boss_radius / abs(middle)) ** 2
        return Line(before.start, corner), (Line(corner, after.end),)

    def outline(self) -> PlateOutline:
        """The outline in the pawl's own frame."""
        turn = cmath.phase(-self.towards_pivot)
        own = Placement2(-turn, -self.pivot * cmath.exp(-1j * turn))
        edges = tuple(edge.placed(own) for edge in self.edges())
        if not self.wheel.ccw:
            edges = tuple(edge.mirrored() for edge in reversed(edges))
        return PlateOutline(edges)

    def tail_clears(self, lift: float) -> bool:
        """Whether all of a tail keeps off the teeth where the pawl is swung out so far, rad."""
        assert self.tail is not None
        length, angle, width = self.tail
        side, limit = self.wheel.side, self.clear_radius
        way = self.towards_pivot * cmath.exp(1j * side * (angle - lift))
        end, radius = self.pivot + length * way, width / 2
        if side < 0:
            return abs(end) + radius <= limit
        # of its middle line the place nearest to the axis, with the width there
        share = min(max(-dot(self.pivot, way) / length, 0.0), 1.0)
        places = ((self.pivot, self.boss_radius), (end, radius))
        between = self.pivot + share * length * way, self.boss_radius + share * (radius - self.boss_radius)
        return all(abs(place) - own >= limit for place, own in (*places, between))

    # ---- how it rides

    @cached_property
    def overrun(self) -> float:
        """How far the wheel must turn beyond a tooth for the pawl to drop in front of it, rad; infinite: never."""
        spoke = self.nose - self.pivot
        # the farthest of the face and the nose from the pivot
        if dot(spoke, self.wheel.face_way) <= 0:
            return 0.0
        reach, apart, normal = abs(spoke) + self.nose_radius, self.pivot_distance, self.wheel.face_normal
        cosine = (apart**2 + self.wheel.tip_radius**2 - reach**2) / (2 * apart * self.wheel.tip_radius)
        found = math.acos(max(cosine, -1.0)) - abs(cmath.phase(self.pivot))
        turn = cmath.exp(1j * found)
        if self.wheel.side * cmath.phase((self.edge * turn - self.pivot) / (-normal * turn)) >= 0:
            return found
        # it leaves the face below the edge at last: where that stands as far from the pivot as the nose reaches
        turns = _both(cmath.phase(self.pivot / normal), (reach + dot(self.edge, normal)) / apart)
        return min((turn for turn in turns if turn >= 0), default=math.inf)

    @cached_property
    def room(self) -> float:
        """What is left, rad, between how far the back lifts it out of the notch and how far the face before it lets it.

        The least until the wheel has overrun: below 0 it is caught, and the wheel does not turn freely.
        """
        turns = [self.overrun * k / _PLACES for k in range(1, _PLACES)] if self.overrun > 0 else []
        return min((self._lets(turn) - self.stands(turn) for turn in turns), default=math.inf)

    def _lets(self, turn: float) -> float:
        """How far it may swing out before it touches the tooth that it has held, rad."""
        side, placed = self.wheel.side, cmath.exp(1j * turn)
        nose, radius, edge = self.nose - self.pivot, self.nose_radius, self.edge * placed - self.pivot
        front = self.wheel.face_way * placed
        face = Line(self._lines()[0].end - self.pivot, nose - radius * self.wheel.face_normal)
        found = [*_onto_circle(nose, edge, radius), *_line_onto(face, edge, 0.0, side)]
        found += [
            angle
            for angle in _onto_line(nose, edge, self.wheel.face_normal * placed, radius)
            if 0 <= dot(nose * cmath.exp(1j * angle) - edge, front) <= self.wheel.face_length
        ]
        lifts = (math.remainder(-side * angle, math.tau) for angle in found)
        return min((lift for lift in lifts if lift > 0), default=math.inf)

    @cached_property
    def swing(self) -> float:
        """How far it swings as its nose passes a land, rad."""
        wheel, radius = self.wheel, self.wheel.tip_radius + self.wheel.side * self.nose_radius
        turns = _onto_circle(self.nose - self.pivot, -self.pivot, radius)
        return min((-wheel.side * turn for turn in turns if -wheel.side * turn > 0), default=math.nan)

    def lift(self, turn: float) -> float:
        """How far the pawl stands swung out (rad) where the wheel has turned freely since it was seated, rad.

        From the edge on it stays up until the wheel has overrun. A spring tells how fast it falls then, no geometry:
        here within a part of a pitch, without a jolt.
        """
        pitch = self.wheel.pitch_angle
        edge = pitch + cmath.phase(
            self.pivot + (self.nose - self.pivot) * cmath.exp(-1j * self.wheel.side * self.swing)
        )
        if turn < pitch + self.overrun:
            return self.stands(min(turn, edge)) if turn > 0 else 0.0
        beyond = math.fmod(turn - self.overrun, pitch)
        falls = self.swing * (1 + math.cos(math.pi * min(beyond / (_FALL * pitch), 1.0))) / 2
        return max(self.stands(min(self.overrun + beyond, edge)), falls)

    def phase(self, turn: float) -> float:
        """How far the wheel has left the last tooth that holds, rad, less than a pitch."""
        pitch = self.wheel.pitch_angle
        found = math.fmod(turn, pitch)
        found += pitch if found < 0 else 0.0
        return 0.0 if pitch - found <= _SEATED * pitch else found

    def stands(self, turn: float) -> float:
        """The same before it has dropped once: the greatest of all angles at which something touches, rad.

        On an arc of the root circle it stands as it is seated.
        """
        side = self.wheel.side
        touching = (math.remainder(-side * angle, math.tau) for angle in self._touching(turn))
        return max((angle for angle in touching if 0 <= angle < math.pi / 2), default=0.0)

    def _touching(self, turn: float) -> Iterator[float]:
        """Turns of the pawl about its pivot at which a feature of it touches one of the wheel within both, rad."""
        wheel, pivot, notch = self.wheel, self.pivot, self.wheel.notch
        nose, radius, side, pitch = self.nose - pivot, self.nose_radius, self.wheel.side, self.wheel.pitch_angle
        upper, under, lower = (Line(line.start - pivot, line.end - pivot) for line in self._lines())
        face = Line(upper.end, nose - radius * wheel.face_normal)
        land = wheel.land_angle
        for back in (0, 1):
            placed = cmath.exp(1j * (turn - back * pitch))
            top, low, out = notch.back_start * placed, notch.back_end * placed, wheel.back_normal(notch.way) * placed
            edge = self.edge * placed * cmath.exp(-1j * pitch)
            way, length = notch.way * placed, abs(low - top)
            for angle in _onto_line(nose, top - pivot, out, radius):
                along = dot(pivot + nose * cmath.exp(1j * angle) - top, way)
                if -_NEAR * length <= along <= length * (1 + _NEAR):
                    yield angle
            # the working face below that edge, from which the nose comes off at last
            front = wheel.face_way * placed * cmath.exp(-1j * pitch)
            for angle in _onto_line(nose, edge - pivot, wheel.face_normal * front / wheel.face_way, radius):
                if 0 <= dot(pivot + nose * cmath.exp(1j * angle) - edge, front) <= wheel.face_length:
                    yield angle
            for corner in (top, edge):
                yield from _onto_circle(nose, corner - pivot, radius)
                for line in (under, lower, face):
                    yield from _line_onto(line, corner - pivot, 0.0, side)
            for angle in _onto_circle(nose, -pivot, wheel.tip_radius + side * radius):
                seen = cmath.phase((pivot + nose * cmath.exp(1j * angle)) / edge)
                if -_NEAR <= seen <= land + _NEAR:
                    yield angle
            for line in (under, lower) if side > 0 else ():
                for angle in _line_onto(line, -pivot, wheel.tip_radius, side):
                    normal = -1j * (line.end - line.start) / abs(line.end - line.start) * cmath.exp(1j * angle)
                    if 0 <= cmath.phase(-normal / edge) <= land:
                        yield angle


def _onto_circle(place: complex, centre: complex, radius: float) -> tuple[float, ...]:
    """Turns about the origin that bring a place onto a circle."""
    apart, reach = abs(centre), abs(place)
    cosine = (reach**2 + apart**2 - radius**2) / (2 * reach * apart)
    return _both(cmath.phase(centre / place), cosine)


def _onto_line(place: complex, point: complex, normal: complex, off: float) -> tuple[float, ...]:
    """Turns about the origin that bring a place so far off the line through a point, on its normal's side."""
    return _both(cmath.phase(normal / place), (off + dot(point, normal)) / abs(place))


def _line_onto(line: Line, centre: complex, radius: float, side: int) -> Iterator[float]:
    """Turns about the origin at which a line, outside on its right (or left), touches a circle within its ends."""
    way = line.end - line.start
    length = abs(way)
    way /= length
    normal = -1j * side * way
    for angle in _both(cmath.phase(centre / normal), (dot(line.start, normal) + radius) / abs(centre)):
        along = dot(centre * cmath.exp(-1j * angle) - line.start, way)
        if -_NEAR * length <= along <= length * (1 + _NEAR):
            yield angle


def _both(middle: float, cosine: float) -> tuple[float, ...]:
    if not abs(cosine) <= 1:
        return ()
    half = math.acos(cosine)
    return middle - half, middle + half


def checked_pawl(pawl: PawlShape) -> PawlShape:
    """The same pawl, if it has an outline that keeps off the wheel but for its nose.

    Raises
    ------
    ParameterError
        Names the key and why.
    """
    side, boss = pawl.wheel.side, ("boss_diameter", 2 * pawl.boss_radius)
    try:
        exists = pawl.outline().exists()
    except GeometryError as refusal:
        if isinstance(refusal, ParameterError):
            raise
        exists = False
    if not exists:
        raise ParameterError("nose_height", pawl.nose_height, "no_whole_outline")
    if not side * (pawl.pivot_distance - pawl.clear_radius) >= pawl.boss_radius:
        raise ParameterError(*boss, "boss_reaches_teeth")
    if not pawl.swing < math.pi / 2:
        raise ParameterError("length", pawl.length, "pawl_cannot_pass")
    if pawl.overrun == math.inf:
        raise ParameterError("line_angle_deg", math.degrees(pawl.line_angle), "pawl_never_drops")
    # on its circle about the pivot, from the clear circle on, it keeps off that if it does at last
    knee = pawl.pivot + (pawl.knee - pawl.pivot) * cmath.exp(-1j * side * pawl.swing)
    if not side * (abs(knee) - pawl.clear_radius) >= 0:
        raise ParameterError("length", pawl.length, "pawl_too_short")
    if not pawl.room >= -_ROUNDING:
        raise ParameterError("line_angle_deg", math.degrees(pawl.line_angle), "pawl_is_caught")
    if pawl.tail is not None and not all(pawl.tail_clears(lift) for lift in (0.0, pawl.swing)):
        raise ParameterError("tail_length", pawl.tail[0], "tail_reaches_teeth")
    return pawl

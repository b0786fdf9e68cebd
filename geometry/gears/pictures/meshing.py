"""The picture of meshing: what stands on the drawing of a pair, figures 3.4 to 3.13 of the practicum, lesson 3.

Frame: the first body's axis is the origin and the mesh lies towards +y; the first body drives and turns
counter-clockwise. Contact runs along the line of action from N1; a place on it is its distance s from there, mm. An
internal pair's ring has its axis below the pinion's; a rack lies above and moves towards -x.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import Any

from geometry.base.angles import tangent_length
from geometry.base.errors import ParameterError
from geometry.base.placement import Placement2
from geometry.base.record import Record
from geometry.curves.curve import Curve, Reversed
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.pairs.rack import RackPair
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_tooth import RingSide
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide
from geometry.plane.profile import Label, Segment

Pair = ExternalPair | InternalPair | RackPair
# exact, or the curves that a file holds in place of them
Curves = tuple[Any, ...]
CIRCLES = ("tip", "working", "reference", "base", "root")


class Body(Record):
    """One of both bodies, its curves in its own frame, mm.

    ``radii`` of its circles by name; of a rack the heights of its lines above the first axis. ``tooth`` is the tooth
    in contact, ``gap`` the land that joins it to the next, ``active`` the part of its flank that is in contact.
    """

    centre: complex | None
    radii: dict[str, float]
    step: Placement2
    tooth: Curves
    gap: Curves
    active: Curves
    place: Callable[[float], Placement2]

    def chain(self, s: float, count: int) -> list[Any]:
        """``count`` teeth in a row and the lands at both of their ends, with contact at s."""
        at = self.place(s)
        first = -(count // 2)
        steps = [Placement2(self.step.angle * k, self.step.translation * k) for k in range(first - 1, first + count)]
        curves = [c.placed(at @ k) for k in steps[1:] for c in self.tooth]
        return curves + [c.placed(at @ k) for k in steps for c in self.gap]

    def tooth_at(self, s: float) -> list[Any]:
        """The tooth in contact at s."""
        return [c.placed(self.place(s)) for c in self.tooth]

    def active_at(self, s: float) -> list[Any]:
        """The working part of its flank there."""
        return [c.placed(self.place(s)) for c in self.active]


class MeshingPicture(Record):
    """Bodies, points and arcs of the picture, mm, rad; ``tangent_points`` N1 and N2 (None: a rack has none).

    ``start`` and ``end`` of contact and the ``pole`` are places s on the line of action, whose direction of travel is
    ``direction``; ``pitch`` (p_w) lies on the second working circle.
    """

    kind: str
    bodies: tuple[Body, Body]
    angle: float
    tangent_points: tuple[complex, complex | None]
    direction: complex
    start: float
    end: float
    pole: float
    pitch: Arc | Line
    working_pitch: float
    base_pitch: float
    contact_ratio: float

    def on_line(self, s: float) -> complex:
        """The point of the line of action at a distance s from N1."""
        return self.tangent_points[0] + s * self.direction

    @property
    def shown(self) -> float:
        """The place of contact in the main position: the pole, or the middle of an active line that leaves it out."""
        return _shown(self.start, self.end, self.pole)

    @property
    def arc_of_action(self) -> Arc:
        """d d', on the first working circle."""
        radii = self.bodies[0].radii
        begun, sweep = (s / radii["base"] for s in (self.start - self.pole, self.end - self.start))
        return Arc(0j, radii["working"], math.pi / 2 + begun, sweep)


def meshing_picture(pair: Pair) -> MeshingPicture:
    """The picture of an external, internal or rack pair.

    Raises
    ------
    ParameterError
        The flanks do not reach each other: there is no contact to draw.
    """
    picture = _rack(pair) if isinstance(pair, RackPair) else _gears(pair)
    if not picture.end > picture.start:
        raise ParameterError("mate", None, "flanks_do_not_reach")
    return picture


def _gears(pair: ExternalPair | InternalPair) -> MeshingPicture:
    angle, a_w, sign = pair.working_pressure_angle, pair.working_centre_distance, pair.sign
    one, two = pair.first.base_radius, pair.second.base_radius
    theta, line, axis = math.pi / 2 - angle, a_w * math.sin(angle), sign * 1j * a_w
    ends, beta = pair.active_profile_radii, pair.second.base_half_angle
    if isinstance(pair, InternalPair):
        low, high = (tangent_length(r, two) - line for r in ends[1])
        low, tooth = max(low, 0.0), _ring_tooth(pair.second_side)
    else:
        low, high = (tangent_length(r, one) for r in ends[0])
        tooth = _external_tooth(pair.second_side)
    pole, spoke = one * math.tan(angle), cmath.exp(1j * theta)

    def second(s: float) -> Placement2:
        return Placement2(theta + pair.facing - beta + (line - sign * s) / two, axis)

    radii = _circles(pair.second, pair.working_radii[1])
    bodies = (
        _first_body(pair.first, pair.working_radii[0], pair.first_side, ends[0], theta),
        Body(axis, radii, Placement2(pair.second.pitch_angle), *tooth, _active(pair.second_side, ends[1]), second),
    )
    shown = _shown(low, high, pole)
    # a ring's pitch ends where another's begins
    begun = -sign * math.pi / 2 + sign * (pole - shown) / two
    begun = begun if sign > 0 else begun - pair.second.pitch_angle
    pitch = Arc(axis, pair.working_radii[1], begun, pair.second.pitch_angle)
    return MeshingPicture(
        "external" if sign > 0 else "internal", bodies, angle, (one * spoke, axis - sign * two * spoke), 1j * spoke,
        low, high, pole, pitch, pair.working_pitch, pair.base_pitch, pair.effective_contact_ratio,
    )  # fmt: skip


def _rack(pair: RackPair) -> MeshingPicture:
    gear, rack, angle = pair.gear, pair.rack, pair.rack.rack.pressure_angle
    one, theta = gear.base_radius, math.pi / 2 - angle
    spoke = cmath.exp(1j * theta)
    low, high = pair.active_line
    pole, half = one * math.tan(angle), rack.tooth_thickness / 2
    ends = math.hypot(one, low), math.hypot(one, high)

    def second(s: float) -> Placement2:
        at = spoke * (one + 1j * s)
        middle = at.real - half + (pair.distance - at.imag) * math.tan(angle)
        return Placement2(math.pi / 2, complex(middle, pair.distance))

    heights = {
        "tip": pair.distance - rack.addendum, "working": gear.reference_radius, "reference": pair.distance,
        "root": pair.distance + rack.dedendum,
    }  # fmt: skip
    tooth = [s for s in pair.sides[1].segments if s.label is not Label.ROOT_LAND]
    land = [s for s in pair.sides[1].segments if s.label is Label.ROOT_LAND]
    depths = sorted((spoke * (one + 1j * s)).imag - pair.distance for s in (low, high))
    flank = next(s.curve for s in tooth if s.label is Label.FLANK)
    step = Placement2(0.0, 1j * rack.pitch)
    # the land above a tooth: the upper half of its own space and the lower half of the next tooth's
    gap = tuple(c for s in land for c in (s.curve.mirrored(), s.curve.placed(step)))
    bodies = (
        _first_body(gear, gear.reference_radius, pair.sides[0], ends, theta),
        Body(None, heights, step, _both(tooth), gap, (_between(flank, *depths),), second),
    )
    at = complex((pole - _shown(low, high, pole)) * gear.reference_radius / one, gear.reference_radius)
    return MeshingPicture(
        "rack", bodies, angle, (one * spoke, None), 1j * spoke, low, high, pole, Line(at, at + rack.pitch), rack.pitch,
        pair.base_pitch, pair.effective_contact_ratio,
    )  # fmt: skip


def _shown(start: float, end: float, pole: float) -> float:
    return pole if start <= pole <= end else (start + end) / 2


def _first_body(gear: SpurGear, working: float, side: ToothSide, ends: tuple[float, float], theta: float) -> Body:
    """The gear on the origin; radii of its working circle and between which its flank is active, mm."""

    def place(s: float) -> Placement2:
        return Placement2(theta - gear.base_half_angle + s / gear.base_radius)

    step = Placement2(gear.pitch_angle)
    return Body(0j, _circles(gear, working), step, *_external_tooth(side), _active(side, ends), place)


def _circles(gear: SpurGear | RingGear, working: float) -> dict[str, float]:
    radii = (gear.tip_radius, working, gear.reference_radius, gear.base_radius, gear.root_radius)
    return dict(zip(CIRCLES, radii, strict=True))


def _external_tooth(side: ToothSide) -> tuple[Curves, Curves]:
    """Tooth 1 and the root land behind it."""
    period = side.profile().period
    land = tuple(s.curve for s in period if s.label is Label.ROOT_LAND)
    return tuple(s.curve for s in period if s.label is not Label.ROOT_LAND), land


def _ring_tooth(side: RingSide) -> tuple[Curves, Curves]:
    """The tooth between the spaces 1 and 2, and the root land of space 2."""
    turn = Placement2(side.pitch_angle)
    lower = [s for s in side.segments if s.label not in (Label.ROOT_LAND, Label.TIP_LAND)]
    period = side.profile().period
    tip = tuple(s.curve.placed(turn) for s in period if s.label is Label.TIP_LAND)
    land = tuple(s.curve.placed(turn) for s in period if s.label is Label.ROOT_LAND)
    # from root to root, whichever way each curve is travelled
    return (*(s.curve.mirrored() for s in lower), *tip, *(s.curve.placed(turn) for s in reversed(lower))), land


def _both(lower: list[Segment]) -> Curves:
    return (*(s.curve.mirrored() for s in reversed(lower)), *(s.curve for s in lower))


def _active(side: ToothSide | RingSide, ends: tuple[float, float]) -> Curves:
    """The part of the upper flank between two radii, mm."""
    low, high = ends
    curves = []
    for curve in (s.curve for s in side.segments if s.label in (Label.FLANK, Label.RELIEF)):
        # a ring's flank is travelled inwards
        curve = curve.base if isinstance(curve, Reversed) else curve
        assert isinstance(curve, Involute)
        begin, stop = curve.domain
        a, b = max(begin, curve.roll_at_radius(low)), min(stop, curve.roll_at_radius(high))
        if b > a:
            curves.append(curve.trimmed(a, b).mirrored())
    return tuple(curves)


def _between(line: Curve, low: float, high: float) -> Curve:
    """The part of a straight flank between two depths x, mm."""
    start, end = (complex(line.point(t)) for t in (0.0, 1.0))
    places = sorted((x - start.real) / (end.real - start.real) for x in (low, high))
    return line.trimmed(*places)

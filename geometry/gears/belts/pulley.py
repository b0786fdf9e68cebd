"""Pulleys for timing belts: the exact grooves of ``belt`` in an outer circle, flanges at both faces or one.

Frame: tooth 1, the land between two grooves, is centred on +x.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache, partial

from geometry.base.errors import Nearest, OffsetError, ParameterError, limit
from geometry.base.findings import Finding
from geometry.base.nearest import nearest
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.curves.line_arc import Arc
from geometry.gears.belts.belt import Belt, Half, StraightGroove
from geometry.gears.teeth.offset import grown_side
from geometry.gears.teeth.round_teeth import RoundTeeth
from geometry.gears.teeth.tooth import ToothSide
from geometry.plane.profile import Label, Segment
from geometry.solids.hub_holes import HubHoles

# teeth up to which one is sought that leaves lands
_MOST_TEETH = 500
_MARGIN = 1e-6
# of a pitch, by which an outer diameter may differ: half a turn of belt is off its grooves by pi / 2 of that
_OFF_PITCH = 0.1


class Flanges(Record):
    """Discs that keep the belt on: diameter and thickness, mm, and at which faces they stand."""

    diameter: float
    thickness: float
    below: bool = True
    above: bool = True

    @property
    def low(self) -> float:
        """Thickness of the lower one, mm."""
        return self.thickness * self.below

    @property
    def both(self) -> float:
        """Thickness of all, mm."""
        return self.thickness * (self.below + self.above)


class Pulley(RoundTeeth):
    """A pulley of ``number_of_teeth`` for a belt; lengths in mm.

    ``given_outer_diameter`` None: by the belt's pitch line. ``clearance``: how far the walls of the grooves stand off
    those of the belt's standard. ``toothed_width``: of the teeth between the flanges.
    """

    belt: Belt
    clearance: float = 0.0
    given_outer_diameter: float | None = None
    holes: HubHoles = HubHoles()
    toothed_width: float = 0.0
    flanges: Flanges | None = None

    @property
    def pitch_radius(self) -> float:
        """Of the belt's pitch line, p z / (2 pi), mm."""
        return self.belt.pitch / self.pitch_angle

    @property
    def outer_radius(self) -> float:
        """Of the lands, mm."""
        given = self.given_outer_diameter
        return self.pitch_radius - self.belt.line_offset if given is None else given / 2

    @property
    def root_radius(self) -> float:
        """Of the floors of the grooves, mm."""
        return self.outer_radius - self.depth

    @property
    def depth(self) -> float:
        """Of the grooves, mm."""
        return self.belt.groove_of(self.number_of_teeth).depth + self.clearance

    @property
    def land(self) -> float:
        """Width of the lands between the roundings of two grooves, mm (arc)."""
        half = half_groove(self)
        return 0.0 if half is None else 2 * self.outer_radius * (self.pitch_angle / 2 - half.land)

    @property
    def total_width(self) -> float:
        """Of the teeth and the flanges, mm."""
        return self.toothed_width + (0.0 if self.flanges is None else self.flanges.both)

    @property
    def reach(self) -> float:
        """How far it reaches from its axis, mm."""
        return self.outer_radius if self.flanges is None else self.flanges.diameter / 2

    @property
    def low(self) -> float:
        """Where the teeth begin, mm above the lower face."""
        return 0.0 if self.flanges is None else self.flanges.low

    @property
    def middle(self) -> float:
        """Of the teeth, mm above the lower face."""
        return self.low + self.toothed_width / 2


@lru_cache(maxsize=64)
def half_groove(pulley: Pulley, inset: float = 0.0) -> Half | None:
    """The upper half of a groove, its middle on +x, every boundary moved into the material; None: there is none."""
    groove = pulley.belt.groove_of(pulley.number_of_teeth)
    return groove.half(pulley.outer_radius, pulley.clearance + inset, inset)


@lru_cache(maxsize=32)
def pulley_side(pulley: Pulley, offset: float = 0.0) -> ToothSide:
    """The lower side of tooth 1, moved ``offset`` mm out of the material.

    Raises
    ------
    GeometryError
        The offset leaves no teeth, or closes the grooves.
    """
    if offset > 0:
        return grown_side(pulley_side(pulley), offset)
    if not pulley.root_radius + offset > pulley.holes.reach - offset:
        raise OffsetError(offset, "leaves_no_rim")
    half = half_groove(pulley, -offset)
    if half is None or half.land >= pulley.pitch_angle / 2:
        raise OffsetError(offset, "leaves_no_tooth")
    turn = Placement2(-pulley.pitch_angle / 2)
    segments = [Segment(one.curve.placed(turn), one.label) for one in half.segments]
    angle = half.land - pulley.pitch_angle / 2
    segments.append(Segment(Arc(0j, pulley.outer_radius + offset, angle, -angle), Label.TIP_LAND))
    return ToothSide(tuple(segments), pulley.pitch_angle)


def checked_pulley(pulley: Pulley) -> Pulley:
    """The same pulley, if its grooves exist and leave lands between them.

    Raises
    ------
    ParameterError
        Names the key and what works.
    """
    if _has_lands(pulley):
        return pulley
    tight, given = replace(pulley, clearance=0.0), pulley.given_outer_diameter
    plain, own = (replace(one, given_outer_diameter=None) for one in (tight, pulley))

    def of_clearance(clearance: float) -> Pulley:
        return replace(pulley, clearance=clearance)

    def of_diameter(diameter: float) -> Pulley:
        return replace(pulley if _has_lands(own) else tight, given_outer_diameter=diameter)

    if _has_lands(tight):
        raise _without_lands("clearance", pulley.clearance, of_clearance, 0.0)
    if given is not None and _has_lands(plain):
        raise _without_lands("outer_diameter", given, of_diameter, 2 * plain.outer_radius)
    more = range(pulley.number_of_teeth + 1, _MOST_TEETH)
    teeth = next((z for z in more if _has_lands(replace(plain, number_of_teeth=z))), None)
    if teeth is not None:
        cure = Nearest(teeth, "at_least")
        raise ParameterError("number_of_teeth", pulley.number_of_teeth, "leaves_no_land_between_grooves", cure)
    groove = pulley.belt.groove
    assert isinstance(groove, StraightGroove)

    def of_width(width: float) -> Pulley:
        return replace(plain, belt=replace(plain.belt, groove=replace(groove, width=width)))

    # with flanks that meet at the floor
    least = 2 * groove.depth * math.tan(groove.half_angle) * (1 + _MARGIN)
    raise _without_lands("belt.groove_width", groove.width, of_width, least)


def _without_lands(key: str, value: float, changed: Callable[[float], Pulley], works: float) -> ParameterError:
    """A size that leaves no lands, with the one nearest to it that does, on the way to one that ``works``."""
    cure = partial(nearest, lambda size: _has_lands(changed(size)), value, works)
    return ParameterError(key, value, "leaves_no_land_between_grooves", cure)


def _has_lands(pulley: Pulley) -> bool:
    half = half_groove(pulley) if pulley.outer_radius > 0 else None
    return half is not None and half.land < pulley.pitch_angle / 2


def check_flanges(pulley: Pulley) -> None:
    """Refuse flanges that do not stand out of the teeth."""
    flanges = pulley.flanges
    if flanges is not None and not flanges.diameter > 2 * pulley.outer_radius:
        least = limit(2 * pulley.outer_radius * (1 + _MARGIN), flanges.diameter)
        raise ParameterError("flanges.diameter", flanges.diameter, "within_the_teeth", least)


def pulley_findings(pulley: Pulley) -> tuple[Finding, ...]:
    """Fewer teeth than the belt is bent over at least; an outer diameter far from that of its pitch."""
    found, teeth, least = [], pulley.number_of_teeth, pulley.belt.least_teeth
    if teeth < least:
        found.append(Finding("few_pulley_teeth", teeth, least))
    outer, own = 2 * pulley.outer_radius, 2 * replace(pulley, given_outer_diameter=None).outer_radius
    if abs(outer - own) > _OFF_PITCH * pulley.belt.pitch:
        found.append(Finding("off_pitch_diameter", outer, own))
    return tuple(found)

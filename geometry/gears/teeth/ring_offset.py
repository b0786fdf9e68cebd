"""Kerf and print offset of a ring: rim and toothed hole, taken on the exact curves before any approximation.

Into the material every curve stays of its family and the side is generated again. Out of it the curves are moved, each
convex corner gets its arc, and what would turn back or cross the space's centre line is trimmed.
"""

from __future__ import annotations

import cmath
import math
from functools import lru_cache, partial

import numpy as np

from geometry.base.errors import CuspError, OffsetError
from geometry.base.findings import Finding
from geometry.base.record import replace
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Curve, Reversed, start_point
from geometry.curves.cutter_fillet import CutterFillet
from geometry.curves.intersect import first_above
from geometry.curves.line_arc import Arc
from geometry.gears.teeth.moved_segments import SAMPLES, after_cusp, at_chamfer, kept_from, with_corner_arcs
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_limits import rim_walls
from geometry.gears.teeth.ring_tooth import RingCurves, RingSide, assemble_ring_side, ring_side
from geometry.plane.offset_region import OffsetRegion, moved_teeth
from geometry.plane.profile import Label, Profile, Region, Segment, circle
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import WheelSections, wheel_sections


def ring_region(gear: RingGear, offset: float = 0.0) -> OffsetRegion:
    """The exact section of a ring; ``offset`` > 0 moves every boundary out of the material, mm.

    Raises
    ------
    ParameterError
        The ring cannot exist, or the offset closes the spaces or leaves no tooth or rim; the nearest offset that
        works is named.
    """
    return moved_teeth(partial(_section, gear), offset)


def _section(gear: RingGear, offset: float) -> OffsetRegion:
    side = _moved_side(gear, offset)
    thinnest = min((wall.thickness for wall in rim_walls(gear)), default=math.inf)
    if -2 * offset >= thinnest:
        raise OffsetError(offset, "no_wall_beside_holes")
    outer, toothed = circle(gear.outer_radius + offset, Label.RIM), _toothed(gear, side, offset)
    return OffsetRegion(Region(outer, (toothed, *gear.holes.profiles(offset))), offset, side.findings)


def _toothed(gear: RingGear, side: RingSide, offset: float, depth: float = 0.0) -> Profile:
    """The toothed boundary of sides moved ``offset`` mm out of the material and ``depth`` mm into it for a chamfer."""
    if gear.sector is None:
        return side.profile()
    from geometry.gears.teeth.sector_rim import sector_profile

    return sector_profile(gear, side, side, offset, depth)


def ring_sections(gear: RingGear, deepest: float) -> WheelSections:
    """The boundaries of a ring's solid, whose teeth stand in its bore; ``deepest``: of its face chamfers, mm."""

    def rim(offset: float, depth: float) -> Profile:
        return circle(gear.outer_radius + offset - depth, Label.RIM)

    @lru_cache(maxsize=8)
    def teeth(offset: float, depth: float) -> Profile:
        if depth == 0 and (offset > 0 or deepest == 0):
            return _toothed(gear, _moved_side(gear, offset), offset)
        return chamfered_teeth(gear, -offset, depth, max(deepest, depth))

    core = HubHoles(RoundBore(2 * gear.core_radius), gear.holes.round_holes)
    sections = wheel_sections(rim, gear.outer_radius, gear.holes)
    return replace(sections, core=core, bore=teeth, toothed_bore=True)


def chamfered_teeth(gear: RingGear, inset: float, depth: float, deepest: float) -> Profile:
    """The teeth moved ``inset`` mm into the material, and then ``depth`` mm for a face chamfer, segment for segment."""
    whole = RingCurves.of(gear)
    whole = whole.shrunk(inset) if inset else whole

    def profile(rounding: float) -> Profile:
        curves = replace(whole.cut(depth), tip_rounding=rounding)
        return _toothed(gear, assemble_ring_side(curves, gear.pitch_angle), -inset, depth)

    return at_chamfer(whole.tip_rounding, depth, deepest, profile)


def _moved_side(gear: RingGear, offset: float) -> RingSide:
    """The lower side of space 1 moved out of the material by ``offset`` mm (into it where negative)."""
    if offset == 0:
        return ring_side(gear)
    if offset < 0:
        if gear.core_radius - offset >= gear.outer_radius + offset:
            raise OffsetError(offset, "leaves_no_rim")
        return assemble_ring_side(RingCurves.of(gear).shrunk(-offset), gear.pitch_angle, blunt=True)
    return grown_ring_side(ring_side(gear), offset)


def grown_ring_side(side: RingSide, distance: float) -> RingSide:
    """A side moved ``distance`` mm out of the material."""
    findings = list(side.findings)
    segments = side.segments
    bottom = abs(start_point(segments[0].curve)) - distance
    facing = math.pi - side.pitch_angle / 2
    pieces = with_corner_arcs(segments, distance, lambda segment: _grown(segment, distance), facing)
    land = pieces.pop(0) if pieces[0].label is Label.ROOT_LAND else None
    pieces, trimmed = after_cusp(pieces, distance, findings)
    if pieces[0].label is Label.FLANK and not trimmed:
        findings.append(Finding("fillet_cusp_trimmed", distance, 0.0))
        trimmed = True
    if land is not None and trimmed:
        pieces, land = _joined_to_root(pieces, bottom)
    if land is None:
        pieces = _below_centre_line(pieces, bottom, findings)
    _check_space(pieces)
    return RingSide(tuple(pieces if land is None else [land, *pieces]), side.pitch_angle, tuple(findings))


def _grown(segment: Segment, distance: float) -> list[Segment]:
    """The parallel curve on the space's side; a fillet may turn back, which is trimmed afterwards."""
    curve = segment.curve
    if isinstance(curve, CutterFillet):
        return [Segment(replace(curve, tip_radius=curve.tip_radius - distance), segment.label)]
    if segment.label is Label.ROOT_FILLET and isinstance(curve, Arc) and curve.radius <= distance:
        # the arc is used up: what is left of its sides meets beside it
        return []
    try:
        moved: Curve = curve.offset(-distance)
    except CuspError as cusp:
        raise OffsetError(distance, "passes_base_circle_at_tips") from cusp
    return [Segment(moved, segment.label)]


def _joined_to_root(pieces: list[Segment], radius: float) -> tuple[list[Segment], Segment | None]:
    """Pieces and root land trimmed to their crossing; no land where they meet beyond the centre line."""
    found = first_above([p.curve for p in pieces], lambda point: radius - abs(point))
    if found is None:
        raise OffsetError(radius, "closes_tooth_spaces")
    kept = kept_from(pieces, found)
    angle = cmath.phase(start_point(kept[0].curve))
    if angle >= -TOLERANCES.relative_length:
        return kept, None
    return kept, Segment(Arc(0j, radius, 0.0, angle), Label.ROOT_LAND)


def _below_centre_line(pieces: list[Segment], bottom: float, findings: list[Finding]) -> list[Segment]:
    """The pieces from where they leave the space's centre line for good."""
    heights = [np.imag(p.curve.point(np.linspace(*p.curve.domain, SAMPLES))) for p in pieces]
    if not any((h > 1e-13 * bottom).any() for h in heights):
        return pieces
    found = first_above([p.curve for p in pieces], lambda point: -point.imag)
    if found is None or found[0] == len(pieces) - 1:
        raise OffsetError(bottom, "closes_tooth_spaces")
    kept = kept_from(pieces, found)
    findings.append(Finding("space_shallowed", abs(start_point(kept[0].curve)), bottom))
    return kept


def _check_space(pieces: list[Segment]) -> None:
    """Refused where a flank is gone or crosses the space's centre line: the space is closed."""
    flank = next((p.curve for p in pieces if p.label is Label.FLANK), None)
    if flank is None or not isinstance(flank, Reversed):
        raise OffsetError(0.0, "closes_tooth_spaces")
    for piece in pieces:
        points = piece.curve.point(np.linspace(*piece.curve.domain, SAMPLES))
        if np.imag(points).max() > 1e-12 * float(np.abs(points).max()):
            raise OffsetError(0.0, "closes_tooth_spaces")

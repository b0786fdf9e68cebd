"""Kerf and print offset of a tooth side, taken on the exact curves before any approximation.

Inwards every curve stays of its family, so the side is generated again from moved curves. Outwards the
curves are moved, convex corners get their arc, and what would turn back or cross the space's centre line
is trimmed; an offset that closes the space is refused.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from geometry.base.errors import OffsetError
from geometry.base.findings import Finding
from geometry.base.record import replace
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import end_point, start_point
from geometry.curves.fillet import Fillet
from geometry.curves.intersect import first_above
from geometry.curves.line_arc import Arc
from geometry.gears.teeth.moved_segments import SAMPLES, after_cusp, at_chamfer, kept_from, with_corner_arcs
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import SideCurves, ToothSide, assemble_side
from geometry.plane.offset_region import OffsetRegion, moved_teeth
from geometry.plane.profile import Label, Profile, Region, Segment
from geometry.solids.hub_holes import Holed

# of the root radius: a space whose flanks are shorter has closed, for no file tells their ends apart
_LEAST_SPACE = 1e-4
W = TypeVar("W", bound=Holed)


def gear_region(gear: SpurGear, offset: float = 0.0) -> OffsetRegion:
    """The exact section of a gear; ``offset`` > 0 moves every boundary out of the material, mm.

    Raises
    ------
    ParameterError
        The gear cannot exist, or the offset closes a space or a hole, or leaves no tooth, rim or wall between
        holes; the largest offset that works is named.
    """

    def section(by: float) -> OffsetRegion:
        outline, found = moved_outline(gear, by)
        return OffsetRegion(Region(outline, gear.holes.profiles(by)), by, found)

    return moved_teeth(section, offset)


def moved_outline(gear: SpurGear, by: float) -> tuple[Profile, tuple[Finding, ...]]:
    """The outline moved ``by`` mm out of the material, and what was noticed."""
    side = _moved_side(gear, by, gear.pitch_angle)
    if gear.sector is None:
        return side.profile(), side.findings
    from geometry.gears.teeth.sector_rim import core_plate, sector_profile

    within = gear.holes.bore_reach if gear.sector.is_cut else gear.holes.reach
    if by < 0 and (gear.core_radius + by <= within - by or (gear.sector.is_cut and not core_plate(gear).exists(by))):
        raise OffsetError(by, "leaves_no_rim")
    # nothing stands beyond the outer space of an outer tooth
    end = _moved_side(gear, by, 2 * gear.pitch_angle)
    found = (*side.findings, *(f for f in end.findings if f not in side.findings))
    return sector_profile(gear, side, end, by), found


def toothed_region(side: Callable[[W, float], ToothSide], wheel: W, offset: float = 0.0) -> OffsetRegion:
    """The exact section of a wheel by its moved ``side``; ``offset`` > 0 moves every boundary out of the material, mm.

    Raises
    ------
    OffsetError
        Names the nearest offset that works.
    """

    def section(by: float) -> OffsetRegion:
        holes = wheel.holes
        if holes.number and wheel.root_radius + by <= holes.reach - by:
            raise OffsetError(by, "leaves_no_rim")
        made = side(wheel, by)
        return OffsetRegion(Region(made.profile(), holes.profiles(by)), by, made.findings)

    return moved_teeth(section, offset)


def chamfered_outline(gear: SpurGear, inset: float, depth: float, deepest: float) -> Profile:
    """The outline moved ``inset`` mm into the material, then ``depth`` mm for a face chamfer, segment for segment."""
    whole = SideCurves.of(gear).shrunk(inset)

    def profile(rounding: float) -> Profile:
        curves = replace(whole.shrunk(depth), tip_rounding=rounding)
        side = assemble_side(curves, gear.pitch_angle)
        if gear.sector is None:
            return side.profile()
        from geometry.gears.teeth.sector_rim import sector_profile

        return sector_profile(gear, side, assemble_side(curves, 2 * gear.pitch_angle), -inset, depth)

    return at_chamfer(whole.tip_rounding, depth, deepest, profile)


def _moved_side(gear: SpurGear, offset: float, pitch_angle: float) -> ToothSide:
    """The side of a tooth whose neighbour stands so far off, rad, moved."""
    whole = assemble_side(SideCurves.of(gear), pitch_angle) if offset >= 0 else None
    if whole is not None:
        return whole if offset == 0 else grown_side(whole, offset)
    if gear.root_radius + offset <= gear.holes.reach - offset:
        raise OffsetError(offset, "leaves_no_rim")
    return assemble_side(SideCurves.of(gear).shrunk(-offset), pitch_angle, blunt=True)


def grown_side(side: ToothSide, distance: float) -> ToothSide:
    """A tooth side moved ``distance`` mm out of the material."""
    pieces = with_corner_arcs(side.segments, distance, lambda segment: _grown(segment, distance), 0.0)
    findings = list(side.findings)
    half_pitch = side.pitch_angle / 2
    land = pieces.pop(0) if pieces[0].label is Label.ROOT_LAND else None
    start, trimmed = after_cusp(pieces, distance, findings)
    bottom = abs(start_point(side.segments[0].curve)) + distance
    pieces, land = _joined_to_root(start, land, bottom, half_pitch, trimmed=trimmed)
    if land is None:
        pieces = _above_centre_line(pieces, half_pitch, bottom, findings)
    else:
        _above_centre_line(pieces, half_pitch, bottom, findings)
        pieces = [land, *pieces]
    return ToothSide(tuple(pieces), side.pitch_angle, tuple(findings))


def _grown(segment: Segment, distance: float) -> list[Segment]:
    """The parallel curve on the space's side; a fillet may turn back, which is trimmed afterwards."""
    curve = segment.curve
    if isinstance(curve, Fillet):
        return [Segment(replace(curve, tip_radius=curve.tip_radius - distance), segment.label)]
    return [Segment(curve.offset(-distance), segment.label)]


def _joined_to_root(
    pieces: list[Segment], land: Segment | None, radius: float, half_pitch: float, *, trimmed: bool
) -> tuple[list[Segment], Segment | None]:
    """Pieces and root land trimmed to their crossing; no land where they meet beyond the centre line."""
    if not trimmed or land is None:
        return pieces, land
    found = _from_first_above(pieces, lambda point: abs(point) - radius)
    if found is None:
        return pieces, None
    kept = found
    angle = cmath.phase(start_point(kept[0].curve)) + half_pitch
    if angle <= TOLERANCES.relative_length:
        return kept, None
    return kept, Segment(Arc(0j, radius, -half_pitch, angle), Label.ROOT_LAND)


def _above_centre_line(
    pieces: list[Segment], half_pitch: float, bottom: float, findings: list[Finding]
) -> list[Segment]:
    """The pieces from where they leave the space's centre line for good; refused where that closes the space."""
    turn = cmath.exp(1j * half_pitch)
    heights = [np.imag(p.curve.point(np.linspace(*p.curve.domain, SAMPLES)) * turn) for p in pieces]
    outside = [h < -1e-13 * bottom for h in heights]
    if not any(o.any() for o in outside):
        return pieces
    last = max(i for i, o in enumerate(outside) if o.any())
    flags = np.concatenate(outside[: last + 1])
    entered = int(np.flatnonzero(flags)[-1])
    if not flags[:entered].all() or pieces[last].label in (Label.TIP_LAND, Label.TIP_BREAK) or last == len(pieces) - 1:
        raise OffsetError(bottom, "closes_tooth_spaces")
    if pieces[last].label is Label.CORNER and pieces[last + 1].label in (Label.TIP_LAND, Label.TIP_BREAK):
        raise OffsetError(bottom, "closes_tooth_spaces")
    kept = _from_first_above(pieces[last:], lambda point: (point * turn).imag)
    if kept is None or abs(end_point(kept[0].curve) - start_point(kept[0].curve)) < _LEAST_SPACE * bottom:
        raise OffsetError(bottom, "closes_tooth_spaces")
    findings.append(Finding("space_shallowed", abs(start_point(kept[0].curve)), bottom))
    return kept


def _from_first_above(pieces: list[Segment], height: Callable[[complex], float]) -> list[Segment] | None:
    """The pieces from the first point at which ``height`` becomes positive."""
    found = first_above([p.curve for p in pieces], height)
    return None if found is None else kept_from(pieces, found)

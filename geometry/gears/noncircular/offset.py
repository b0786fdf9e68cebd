"""Kerf and print offset of a noncircular gear on its exact curves: every parallel curve is one of the same family."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from functools import partial

from geometry.base.errors import OffsetError
from geometry.base.findings import Finding, short_of
from geometry.base.nearest import moved
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import start_point
from geometry.curves.line_arc import Arc
from geometry.gears.noncircular.gear import NoncircularGear, cut_outline
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Profile, Region, Segment


def noncircular_region(gear: NoncircularGear, offset: float = 0.0) -> OffsetRegion:
    """The exact section, every boundary moved ``offset`` mm out of the material.

    Raises
    ------
    OffsetError
        The offset closes a space or a hole, or leaves no tooth or wall; the largest one that works is named.
    """
    code = "closes_spaces_or_fillets" if offset > 0 else "leaves_no_tooth"
    outer = moved(partial(moved_outline, gear), offset, code)
    if not gear.root_radius + offset > gear.holes.reach - offset:
        raise OffsetError(offset, "leaves_no_rim", (gear.holes.reach - gear.root_radius) / 2 * (1 - 1e-9))
    return OffsetRegion(Region(outer, gear.holes.profiles(offset)), offset, ())


def moved_outline(gear: NoncircularGear, offset: float) -> Profile:
    """The outline moved ``offset`` mm out of the material.

    Raises
    ------
    GeometryError
        Nothing is left of a tooth, a fillet or a space.
    """
    if offset <= 0:
        made = gear.outline if offset == 0 else cut_outline(gear, -offset)
        return made.profile(gear.count)
    return Profile(_grown(gear.outline.segments, offset, 2 * math.pi / gear.count), gear.count)


def _grown(segments: Sequence[Segment], distance: float, pitch: float) -> tuple[Segment, ...]:
    """Every segment of a period moved outwards, an arc about each convex corner.

    Fillets close first: normals at tips lead away from the space, and the rack's rounding has come in through
    the neck of an undercut one.
    """
    grown: list[Segment] = []
    for index, segment in enumerate(segments):
        before = segments[index - 1].curve
        # the first of a period follows the last of the period before
        back = cmath.exp(-1j * pitch) if index == 0 else 1.0
        arriving = complex(before.tangent(before.domain[1])) * back
        turn = cmath.phase(complex(segment.curve.tangent(segment.curve.domain[0])) / arriving)
        if turn > TOLERANCES.smooth_angle:
            corner = Arc(start_point(segment.curve), distance, cmath.phase(arriving) - math.pi / 2, turn)
            grown.append(Segment(corner, Label.CORNER))
        grown.append(Segment(segment.curve.offset(-distance), segment.label))
    return tuple(grown)


def findings_of(gear: NoncircularGear) -> tuple[Finding, ...]:
    """What is legal but poor: undercut, thin tips, a thin rim."""
    found = []
    outline, m = gear.outline, gear.module
    if outline.undercut:
        least = (gear.rack.form_dedendum - gear.profile_shift_coefficient) * m / math.sin(gear.rack.pressure_angle) ** 2
        found.append(Finding("undercut_on_centrode", 1 / gear.curvatures[1], least))
    found += short_of("thin_tip", outline.tip_thickness, 0.3 * m)
    if gear.holes.bore_reach > 0:
        found += short_of("thin_rim", gear.root_radius - gear.holes.bore_reach, m)
    return tuple(found)

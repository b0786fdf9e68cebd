"""The exact outline of one tooth side: root land, fillet, flank, relief, tip break, tip land.

The lower side of tooth 1 is built from the space's centre line (polar angle -pi/z) to the tooth's
(angle 0), counter-clockwise, material on the left; the upper side is its mirror image.
"""

from __future__ import annotations

import cmath
import math
from functools import lru_cache
from typing import NamedTuple

from geometry.base.errors import ParameterError, PointedTipError, UndercutError
from geometry.base.findings import Finding
from geometry.base.record import Record, replace
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import end_point, start_point
from geometry.curves.intersect import crossing_line, height_over_line
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line, arc_between
from geometry.gears.teeth.joints import (
    GearFillet,
    fillet_flank_joint,
    flank_crossing_radius,
    greatest_lead,
    joint_roll,
    pointed_radius,
)
from geometry.gears.teeth.side import Side
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Label, Segment


class ToothSide(Side):
    """Segments of the lower tooth side, space centre to tooth centre."""


class FlankPiece(NamedTuple):
    """Part of a flank: the involute of one straight side of the rack."""

    curve: Involute
    label: Label


class SideCurves(Record):
    """The generating curves of one tooth side before they are trimmed; a uniformly shrunk tooth has its own."""

    fillet: GearFillet
    flank: Involute
    relief: Involute | None
    root_radius: float
    tip_radius: float
    chamfer: Line | None
    tip_rounding: float

    @classmethod
    def of(cls, gear: SpurGear) -> SideCurves:
        """The curves as the rack cuts them."""
        flank = gear.flank()
        relief = gear.relief_flank() if gear.rack.relief and gear.rack.relief.depth > 0 else None
        least = TOLERANCES.relative_length * gear.tip_radius
        chamfer = _chamfer_line(gear, flank, relief) if gear.tip_chamfer > least else None
        rounding = gear.tip_rounding if gear.tip_rounding > least else 0.0
        return cls(gear.fillet(), flank, relief, gear.root_radius, gear.tip_radius, chamfer, rounding)

    def shrunk(self, distance: float) -> SideCurves:
        """All boundaries moved ``distance`` into the material: each curve stays of its family."""
        return SideCurves(
            replace(self.fillet, tip_radius=self.fillet.tip_radius + distance),
            _turned(self.flank, distance),
            None if self.relief is None else _turned(self.relief, distance),
            self.root_radius - distance,
            self.tip_radius - distance,
            None if self.chamfer is None else self.chamfer.offset(distance),
            max(self.tip_rounding - distance, 0.0),
        )


# mates and trials of them make the same gears over and over
@lru_cache(maxsize=256)
def tooth_side(gear: SpurGear) -> ToothSide:
    """The lower side of tooth 1 as generated.

    Raises
    ------
    UndercutError, PointedTipError, ParameterError
        The tooth cannot exist; each says why.
    """
    return assemble_side(SideCurves.of(gear), gear.pitch_angle)


def assemble_side(curves: SideCurves, pitch_angle: float, *, blunt: bool = False) -> ToothSide:
    """Trim the generating curves to each other; ``blunt`` ends a pointed tooth at its apex, with a finding."""
    findings: list[Finding] = []
    segments: list[Segment] = []
    half_pitch, scale = pitch_angle / 2, curves.tip_radius
    if not curves.root_radius > 0:
        raise UndercutError("root_radius", curves.root_radius, "root_reaches_axis")
    land = curves.fillet.angle + half_pitch
    if land * curves.root_radius > TOLERANCES.relative_length * scale:
        segments.append(Segment(Arc(0j, curves.root_radius, -half_pitch, land), Label.ROOT_LAND))
    fillet, flank = fillet_flank_joint(curves.fillet, curves.flank)
    if joint_roll(curves.fillet, curves.flank.base_radius) < 0 and greatest_lead(fillet) >= 0:
        raise UndercutError("undercut", greatest_lead(fillet), "fillets_meet")
    form_radius = abs(complex(flank.point(flank.start_roll)))
    tip_radius = curves.tip_radius
    if form_radius >= tip_radius:
        raise UndercutError("undercut", form_radius, "no_involute_below_tip")
    if fillet.end - fillet.start > 0:
        segments.append(Segment(fillet, Label.ROOT_FILLET))
    top = flank if curves.relief is None else curves.relief
    apex = min(pointed_radius(flank), pointed_radius(top))
    if apex <= form_radius * (1 + TOLERANCES.relative_length):
        raise PointedTipError("pointed_diameter", 2 * apex, "flanks_meet_below_form")
    if apex <= tip_radius:
        if not blunt:
            raise PointedTipError("pointed_diameter", 2 * apex, "tooth_pointed", diameter=2 * apex)
        findings.append(Finding("tip_lost", tip_radius - apex, 0.0))
        tip_radius = apex
    pieces = _flank_pieces(flank, curves.relief, form_radius, tip_radius, findings)
    segments += _broken_tip(pieces, tip_radius, curves, pointed=apex <= curves.tip_radius)
    return ToothSide(tuple(segments), pitch_angle, tuple(findings))


def _flank_pieces(
    flank: Involute, relief: Involute | None, form_radius: float, tip_radius: float, findings: list[Finding]
) -> list[FlankPiece]:
    """Main flank and, above their crossing, the relieved flank, up to the tip circle."""
    if relief is None:
        return [_up_to(flank, Label.FLANK, tip_radius)]
    crossing = flank_crossing_radius(flank, relief, form_radius, tip_radius)
    if crossing is None:
        findings.append(Finding("relief_not_reached", 2 * tip_radius, 2 * tip_radius))
        return [_up_to(flank, Label.FLANK, tip_radius)]
    if crossing <= form_radius:
        raise ParameterError("relief.height", math.nan, "relief_leaves_no_flank")
    start = relief.roll_at_radius(crossing)
    return [
        _up_to(flank, Label.FLANK, crossing),
        _up_to(replace(relief, start_roll=start), Label.RELIEF, tip_radius),
    ]


def _up_to(flank: Involute, label: Label, radius: float) -> FlankPiece:
    return FlankPiece(replace(flank, end_roll=flank.roll_at_radius(radius)), label)


def _broken_tip(pieces: list[FlankPiece], tip_radius: float, curves: SideCurves, *, pointed: bool) -> list[Segment]:
    """Flank pieces, the chamfer or rounding of the tip corner, and half of the tip land."""
    if curves.chamfer is not None:
        segments, corner = _chamfered(pieces, tip_radius, curves.chamfer)
    elif curves.tip_rounding > 0 and not pointed:
        segments, corner = _rounded(pieces, tip_radius, curves.tip_rounding)
    else:
        segments, corner = _as_segments(pieces), end_point(pieces[-1].curve)
    angle = cmath.phase(corner)
    if angle > -TOLERANCES.relative_length:
        return segments
    return [*segments, Segment(Arc(0j, tip_radius, angle, -angle), Label.TIP_LAND)]


def _as_segments(pieces: list[FlankPiece]) -> list[Segment]:
    return [Segment(piece.curve, piece.label) for piece in pieces]


def _chamfer_line(gear: SpurGear, flank: Involute, relief: Involute | None) -> Line:
    """A chamfer of a radial height, at 45 degrees to the radius through its foot on the flank."""
    height, tip_radius = gear.tip_chamfer, gear.tip_radius
    foot_radius = tip_radius - height
    if foot_radius <= flank.base_radius:
        raise ParameterError.beyond("tip_chamfer", height, "leaves_no_flank", tip_radius - flank.base_radius)
    angles = [f.polar_angle_at_radius(foot_radius) for f in (flank, relief) if f is not None]
    foot = cmath.rect(foot_radius, max(angles))
    direction = cmath.exp(1j * (max(angles) + math.pi / 4))
    along = (foot.conjugate() * direction).real
    corner = foot + direction * (math.sqrt(along**2 + tip_radius**2 - foot_radius**2) - along)
    if corner.imag > 0:
        raise ParameterError("tip_chamfer", height, "chamfers_overlap")
    return Line(foot, corner)


def _chamfered(pieces: list[FlankPiece], tip_radius: float, chamfer: Line) -> tuple[list[Segment], complex]:
    """Flank pieces cut at the chamfer, and the chamfer up to the tip circle or the tooth's centre line."""
    direction = complex(chamfer.tangent(0.0))

    def height(point: complex) -> float:
        return height_over_line(point, chamfer.start, direction)

    kept = list(pieces)
    while kept and height(start_point(kept[-1].curve)) < 0:
        kept.pop()
    if not kept or height(end_point(kept[-1].curve)) > 0:
        raise ParameterError("tip_chamfer", abs(chamfer.end - chamfer.start), "chamfer_misses_flank")
    top = kept[-1].curve
    roll = crossing_line(top, chamfer.start, direction).value
    kept[-1] = FlankPiece(replace(top, end_roll=roll), kept[-1].label)
    foot = complex(top.point(roll))
    along = (foot.conjugate() * direction).real
    corner = foot + direction * (math.sqrt(max(along**2 + tip_radius**2 - abs(foot) ** 2, 0.0)) - along)
    if corner.imag > 0:
        corner = complex(foot.real - foot.imag * direction.real / direction.imag, 0.0)
    return [*_as_segments(kept), Segment(Line(foot, corner), Label.TIP_BREAK)], corner


def _rounded(pieces: list[FlankPiece], tip_radius: float, radius: float) -> tuple[list[Segment], complex]:
    """An arc that touches the flank and the tip circle."""
    for index, piece in reversed(list(enumerate(pieces))):
        flank = piece.curve
        if radius >= tip_radius - flank.base_radius:
            break
        centre_roll = flank.roll_at_radius(tip_radius - radius)
        centre = complex(_turned(flank, radius).point(centre_roll))
        touch_roll = centre_roll + radius / flank.base_radius
        if flank.start_roll < touch_roll < flank.end_roll and centre.imag <= 0:
            touch, corner = complex(flank.point(touch_roll)), centre * tip_radius / abs(centre)
            kept = [*pieces[:index], FlankPiece(replace(flank, end_roll=touch_roll), piece.label)]
            arc = arc_between(centre, touch, corner, turns_left=True)
            return [*_as_segments(kept), Segment(arc, Label.TIP_BREAK)], corner
    raise ParameterError("tip_rounding", radius, "rounding_does_not_fit")


def _turned(flank: Involute, distance: float) -> Involute:
    """The base curve of an involute moved ``distance`` into the tooth; its domain is set by trimming."""
    return replace(flank, base_angle=flank.base_angle + distance / flank.base_radius)

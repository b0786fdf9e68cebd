"""The exact outline of one side of a ring's tooth space: root land, fillet, flank, tip break, tip land.

The lower side of space 1 is built from the space's centre line (polar angle 0) to the tooth's (-pi/z), clockwise,
material on the left; the upper side is its mirror image.
"""

from __future__ import annotations

import cmath
import math

from geometry.base.errors import ParameterError, PointedTipError, limit
from geometry.base.findings import Finding
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Reversed
from geometry.curves.cutter_fillet import CutterFillet
from geometry.curves.intersect import height_over_line
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line, arc_between
from geometry.gears.teeth.cutter import CUTTER_ROUNDING, PinionCutter, full_round
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.side import Side
from geometry.plane.profile import Label, Segment


class RingSide(Side):
    """Segments of the lower side of space 1, space centre to tooth centre, clockwise."""

    clockwise = True


class RingCurves(Record):
    """The curves of one side before they are trimmed; ``land`` is the (negative) angle of the root land."""

    land: float
    fillet: CutterFillet | Arc | None
    flank: Involute
    root_radius: float
    tip_radius: float
    chamfer: Line | None
    tip_rounding: float

    @classmethod
    def of(cls, gear: RingGear) -> RingCurves:
        """The curves as they are cut."""
        fillet: CutterFillet | Arc | None
        if isinstance(gear.root, RoundedRoot):
            plug = rounded_root_plug(gear)
            _, *rest = plug.side()
            arcs = [s.curve for s in rest if s.label is Label.TIP_BREAK and isinstance(s.curve, Arc)]
            land, fillet = -plug.corner_angle, arcs[0].reversed() if arcs else None
            length = plug.form_length
        else:
            cut = gear.fillet()
            land, fillet, length = cut.angle, cut, gear.cut_form_length
        flank = replace(gear.flank(), end_roll=length / gear.base_radius)
        least = TOLERANCES.relative_length * gear.root_radius
        chamfer = _chamfer_line(gear, flank) if gear.tip_chamfer > least else None
        rounding = gear.tip_rounding if gear.tip_rounding > least else 0.0
        return cls(land, fillet, flank, gear.root_radius, gear.tip_radius, chamfer, rounding)

    def shrunk(self, distance: float) -> RingCurves:
        """All boundaries moved ``distance`` into the material: each curve stays of its family."""
        fillet = self.fillet
        if isinstance(fillet, Arc):
            fillet = replace(fillet, radius=fillet.radius + distance)
        elif fillet is not None:
            fillet = replace(fillet, tip_radius=fillet.tip_radius + distance)
        else:
            corner = cmath.rect(self.root_radius, self.land)
            spoke = -1j * complex(self.flank.tangent(self.flank.end_roll))
            fillet = arc_between(corner, corner + corner / abs(corner) * distance, corner + spoke * distance, False)
        turn = distance / self.flank.base_radius
        flank = replace(self.flank, base_angle=self.flank.base_angle - turn, end_roll=self.flank.end_roll + turn)
        return RingCurves(
            self.land,
            fillet,
            flank,
            self.root_radius + distance,
            self.tip_radius + distance,
            None if self.chamfer is None else self.chamfer.offset(distance),
            max(self.tip_rounding - distance, 0.0),
        )

    def cut(self, depth: float) -> RingCurves:
        """The same at the edge of a face chamfer ``depth`` mm deep: a sharp root stays sharp."""
        if depth == 0:
            return self
        moved = self.shrunk(depth)
        if self.fillet is not None:
            return moved
        flank = replace(moved.flank, end_roll=moved.flank.roll_at_radius(moved.root_radius))
        land = flank.polar_angle_at_radius(moved.root_radius)
        return replace(moved, land=land, fillet=None, flank=flank)


def rounded_root_plug(gear: RingGear) -> PinionCutter:
    """The body that fills a space with a rounded root: an external tooth with rounded tips."""
    root = gear.root
    assert isinstance(root, RoundedRoot)
    plug = PinionCutter(
        gear.module, gear.number_of_teeth, gear.pressure_angle, gear.generating_shift_coefficient, root.dedendum,
        CUTTER_ROUNDING if root.radius is None else root.radius,
        0.0 if gear.thinning_by_deeper_cut else gear.circumferential_thinning / 2,
    )  # fmt: skip
    return full_round(plug) if root.radius is None else plug


def ring_side(gear: RingGear) -> RingSide:
    """The lower side of space 1 as generated.

    Raises
    ------
    PointedTipError, ParameterError
        The tooth cannot exist; each names a value that works where one number decides.
    """
    return assemble_ring_side(RingCurves.of(gear), gear.pitch_angle)


def assemble_ring_side(curves: RingCurves, pitch_angle: float, *, blunt: bool = False) -> RingSide:
    """Trim the generating curves to each other; ``blunt`` ends a pointed tooth at its apex, with a finding."""
    findings: list[Finding] = []
    segments: list[Segment] = []
    flank, tip_radius = curves.flank, curves.tip_radius
    if tip_radius < flank.base_radius * (1 - TOLERANCES.relative_rounding):
        least = limit(2 * flank.base_radius, 2 * tip_radius)
        raise ParameterError("tip_diameter", 2 * tip_radius, "involute_ends_at_base_circle", least)
    form_radius = flank.base_radius * math.hypot(1.0, flank.end_roll)
    if tip_radius >= form_radius:
        raise ParameterError.beyond("tip_diameter", 2 * tip_radius, "leaves_no_flank", 2 * form_radius)
    if -curves.land > TOLERANCES.relative_length:
        segments.append(Segment(Arc(0j, curves.root_radius, 0.0, curves.land), Label.ROOT_LAND))
    if curves.fillet is not None:
        segments.append(Segment(curves.fillet, Label.ROOT_FILLET))
    apex = apex_radius(flank, pitch_angle / 2)
    if apex >= form_radius:
        raise PointedTipError("tip_diameter", 2 * tip_radius, "ring_flanks_meet_at_root")
    if apex >= tip_radius:
        if not blunt:
            raise PointedTipError.beyond("tip_diameter", 2 * tip_radius, "ring_tooth_pointed", 2 * apex)
        findings.append(Finding("tip_lost", apex - tip_radius, 0.0))
    pointed = apex >= tip_radius
    end = max(apex, tip_radius)
    start_roll, broken, corner = _broken_tip(curves, end, pitch_angle / 2, pointed=pointed)
    segments.append(Segment(Reversed(replace(flank, start_roll=start_roll)), Label.FLANK))
    segments += broken
    land = -pitch_angle / 2 - cmath.phase(corner)
    if land < -TOLERANCES.relative_length:
        segments.append(Segment(Arc(0j, tip_radius, cmath.phase(corner), land), Label.TIP_LAND))
    return RingSide(tuple(segments), pitch_angle, tuple(findings))


def apex_radius(flank: Involute, half_pitch: float) -> float:
    """Radius at which both flanks of a ring tooth meet, mm; 0 where they do not, down to the base circle."""

    def height(radius: float) -> float:
        return flank.polar_angle_at_radius(radius) + half_pitch

    if height(flank.base_radius) > 0:
        return 0.0
    high = flank.base_radius * math.hypot(1.0, flank.end_roll)
    if height(high) <= 0:
        return high
    return bracketed_root(height, flank.base_radius, high).value


def _broken_tip(
    curves: RingCurves, end: float, half_pitch: float, *, pointed: bool
) -> tuple[float, list[Segment], complex]:
    """Roll at which the flank ends, the chamfer or rounding after it, and the corner at which the tip land begins."""
    flank = curves.flank
    roll = flank.roll_at_radius(end)
    corner = complex(flank.point(roll))
    if curves.chamfer is not None:
        return _chamfered(curves, roll, corner, half_pitch)
    if curves.tip_rounding > 0 and not pointed:
        return _rounded(curves, half_pitch)
    return roll, [], corner


def _rounded(curves: RingCurves, half_pitch: float) -> tuple[float, list[Segment], complex]:
    """An arc that touches flank and tip circle."""
    flank, radius, tip = curves.flank, curves.tip_rounding, curves.tip_radius
    turned = replace(flank, base_angle=flank.base_angle - radius / flank.base_radius)
    centre_roll = turned.roll_at_radius(tip + radius)
    touch_roll = centre_roll - radius / flank.base_radius
    reaches = 0 <= touch_roll < flank.end_roll
    if not reaches or cmath.phase(centre := complex(turned.point(centre_roll))) < -half_pitch:
        raise ParameterError("tip_rounding", radius, "rounding_does_not_fit")
    corner = centre * tip / abs(centre)
    arc = arc_between(centre, complex(flank.point(touch_roll)), corner, turns_left=True)
    return touch_roll, [Segment(arc, Label.TIP_BREAK)], corner


def _chamfer_line(gear: RingGear, flank: Involute) -> Line:
    """A chamfer of a radial height, at 45 degrees to the radius through its foot on the flank."""
    height, tip = gear.tip_chamfer, gear.tip_radius
    form = flank.base_radius * math.hypot(1.0, flank.end_roll)
    if tip + height >= form:
        raise ParameterError.beyond("tip_chamfer", height, "leaves_no_flank", form - tip)
    foot = cmath.rect(tip + height, flank.polar_angle_at_radius(tip + height))
    direction = foot / abs(foot) * cmath.exp(-0.75j * math.pi)
    along = -(foot.conjugate() * direction).real
    square = along**2 - (abs(foot) - tip) * (abs(foot) + tip)
    corner = foot + direction * (along - math.sqrt(max(square, 0.0)))
    if square < 0 or cmath.phase(corner) < -gear.pitch_angle / 2:
        raise ParameterError("tip_chamfer", height, "chamfers_overlap")
    return Line(foot, corner)


def _chamfered(
    curves: RingCurves, roll: float, corner: complex, half_pitch: float
) -> tuple[float, list[Segment], complex]:
    """The flank cut at the chamfer, which runs to the tip circle or the tooth's centre line; or neither."""
    flank, line = curves.flank, curves.chamfer
    assert line is not None
    direction = complex(line.tangent(0.0))

    def height(at: float) -> float:
        return height_over_line(complex(flank.point(at)), line.start, direction)

    # the flank above the line, on its left, is kept
    if height(roll) >= 0:
        return roll, [], corner
    if height(flank.end_roll) <= 0:
        raise ParameterError("tip_chamfer", abs(line.end - line.start), "leaves_no_flank")
    foot_roll = bracketed_root(height, roll, flank.end_roll).value
    foot = complex(flank.point(foot_roll))
    along = -(foot.conjugate() * direction).real
    square = along**2 - (abs(foot) - curves.tip_radius) * (abs(foot) + curves.tip_radius)
    corner = foot + direction * (along - math.sqrt(max(square, 0.0)))
    if square < 0 or cmath.phase(corner) < -half_pitch:
        turn = cmath.exp(1j * half_pitch)
        corner = foot - direction * (foot * turn).imag / (direction * turn).imag
    return foot_roll, [Segment(Line(foot, corner), Label.TIP_BREAK)], corner

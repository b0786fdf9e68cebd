"""A straight rack as a part: the basic rack's own tooth, a body below, and its exact offsets.

Rack frame: the datum line is the x axis, teeth point to +y, the middle of the rack is the origin. The tooth itself is
described in the mesh frame, turned so that it points to -x with its centre line on the x axis: i times the rack frame.
"""

from __future__ import annotations

import cmath
import math
from functools import cached_property, partial
from itertools import pairwise

from geometry.base.errors import Nearest, OffsetError, ParameterError, PointedTipError, limit
from geometry.base.findings import Finding
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import end_point, start_point
from geometry.curves.intersect import first_above
from geometry.curves.line_arc import Arc, Line, arc_between
from geometry.gears.teeth.basic_rack import BasicRack, checked_rack
from geometry.gears.teeth.limits import check_dimensions
from geometry.gears.teeth.moved_segments import kept_from
from geometry.gears.teeth.rack_fillet import root_fillet
from geometry.gears.teeth.rack_holes import RackHoles
from geometry.gears.teeth.transverse import transverse_rack
from geometry.plane.offset_region import OffsetRegion, moved_teeth
from geometry.plane.profile import Label, Profile, Region, Segment

# share of a length at which a tip would vanish
_INSIDE = 1 - 1e-9


class Rack(Record, dict=True):
    """Straight rack that meshes with gears of the same basic rack; lengths in mm.

    The tooth reaches addendum m above the datum line and dedendum m below it; its root fillets are the basic rack's tip
    roundings (ISO 53: the counterpart of what cuts the gear). ``body_height`` is what stands below the root line. The
    rack ends in the middle of a space on either side. ``circumferential_thinning`` thins each tooth on the datum line.
    """

    module: float
    number_of_teeth: int
    rack: BasicRack
    body_height: float
    circumferential_thinning: float = 0.0
    tip_chamfer: float = 0.0
    tip_rounding: float = 0.0
    holes: RackHoles | None = None

    @property
    def pitch(self) -> float:
        """p = pi m, mm."""
        return math.pi * self.module

    @property
    def length(self) -> float:
        """z p, mm."""
        return self.number_of_teeth * self.pitch

    @property
    def addendum(self) -> float:
        """Height of the tips above the datum line, mm."""
        return self.rack.addendum * self.module

    @property
    def dedendum(self) -> float:
        """Depth of the root line below the datum line, mm."""
        return self.rack.dedendum * self.module

    @property
    def form_dedendum(self) -> float:
        """Depth at which the flank gives way to the fillet, mm."""
        return self.rack.form_dedendum * self.module

    @property
    def tooth_thickness(self) -> float:
        """s on the datum line, mm."""
        return self.pitch / 2 - self.circumferential_thinning

    @property
    def tip_thickness(self) -> float:
        """Width of the tip land before its corners are broken, mm."""
        return self.tooth_thickness - 2 * self.addendum * math.tan(self.rack.pressure_angle)

    @cached_property
    def side(self) -> RackSide:
        """The exact lower half of a tooth in the mesh frame."""
        return rack_side(self)


class RackSide(Record):
    """Half a pitch in the mesh frame, from the tooth's centre line (y = 0) down to the space's (y = -p/2).

    Material on the left. The upper half is the mirror image in the x axis.
    """

    segments: tuple[Segment, ...]
    findings: tuple[Finding, ...] = ()


class _Numbers(Record):
    """One half tooth: tip height, root depth, half thickness on the datum line, fillet, tip corner, mm; angle, rad."""

    height: float
    depth: float
    half: float
    fillet: float
    angle: float
    half_pitch: float
    chamfer: float
    rounding: float
    stretch: float = 1.0

    @classmethod
    def of(cls, rack: Rack) -> _Numbers:
        basic = rack.rack
        return cls(
            rack.addendum, rack.dedendum, rack.tooth_thickness / 2, basic.tip_radius * rack.module,
            basic.pressure_angle, rack.pitch / 2, rack.tip_chamfer, rack.tip_rounding, basic.stretch,
        )  # fmt: skip

    def flank_at(self, height: float) -> complex:
        """The flank's point at a height above the datum line."""
        return complex(-height, -(self.half - height * math.tan(self.angle)))


def rack_side(rack: Rack, offset: float = 0.0) -> RackSide:
    """Half a tooth, moved ``offset`` mm out of the material (into it where negative).

    Raises
    ------
    PointedTipError, ParameterError
        The tooth cannot exist, or the offset closes the space.
    """
    numbers = _Numbers.of(rack)
    findings: list[Finding] = []
    tip = _tip_lines(numbers)
    upper, start = _moved_tip(tip, offset, findings)
    along = cmath.exp(-1j * numbers.angle)
    fillet, foot, root = root_fillet(
        numbers.depth, numbers.half, numbers.angle, numbers.fillet, numbers.stretch, offset
    )
    lower = [] if fillet is None else [Segment(fillet, Label.ROOT_FILLET)]
    if fillet is None and offset > 0:
        findings.append(Finding("fillet_cusp_trimmed", offset, numbers.fillet))
    if root.imag < -numbers.half_pitch * (1 + TOLERANCES.relative_length):
        raise OffsetError(offset, "closes_tooth_spaces")
    if not ((foot - start) * along.conjugate()).real > 0:
        raise OffsetError(offset, "leaves_no_flank")
    segments = [*upper, Segment(Line(start, foot), Label.FLANK), *lower]
    end = complex(root.real, -numbers.half_pitch)
    if root.imag - end.imag > TOLERANCES.relative_length * rack.module:
        segments.append(Segment(Line(root, end), Label.ROOT_LAND))
    return RackSide(tuple(segments), tuple(findings))


class _Tip(Record):
    """Corners of the tip from the centre line to the flank, directions of the lines between, rounding radius."""

    corners: tuple[complex, ...]
    directions: tuple[complex, ...]
    rounding: float


def _tip_lines(numbers: _Numbers) -> _Tip:
    """The tip line, a chamfer if any, and the flank, as corners and directions of travel."""
    along = cmath.exp(-1j * numbers.angle)
    corner = numbers.flank_at(numbers.height)
    if corner.imag >= 0:
        most = limit(numbers.half / math.tan(numbers.angle), numbers.height)
        raise PointedTipError("addendum", numbers.height, "rack_tooth_pointed", most)
    if numbers.chamfer > 0:
        foot = numbers.flank_at(numbers.height - numbers.chamfer)
        first = complex(-numbers.height, foot.imag + numbers.chamfer)
        if first.imag > 0:
            raise ParameterError("tip_chamfer", numbers.chamfer, "chamfers_overlap")
        return _Tip((first, foot), (-1j, (foot - first) / abs(foot - first), along), 0.0)
    if numbers.rounding > 0:
        # the arc's centre is the corner of the tip moved into the material
        inner = _crossing(
            complex(-numbers.height + numbers.rounding, 0.0), -1j, corner + 1j * along * numbers.rounding, along
        )
        if inner.imag > 0:
            raise ParameterError("tip_rounding", numbers.rounding, "rounding_does_not_fit")
        return _Tip((inner,), (-1j, along), numbers.rounding)
    return _Tip((corner,), (-1j, along), 0.0)


def _moved_tip(tip: _Tip, offset: float, findings: list[Finding]) -> tuple[list[Segment], complex]:
    """Tip land and broken corner moved out by ``offset``, and where the flank begins.

    Arcs about the corners, or crossings of the moved lines inwards.
    """
    radius = tip.rounding + offset
    if radius > 0:
        label = Label.TIP_BREAK if tip.rounding else Label.CORNER
        segments = _rounded_tip(tip.corners, tip.directions, radius, label)
        return segments, end_point(segments[-1].curve)
    corners, directions = list(tip.corners), list(tip.directions)
    step = -radius
    moved = [c + 1j * d * step for c, d in zip([corners[0], *corners], directions, strict=True)]
    points = [_crossing(moved[k], directions[k], moved[k + 1], directions[k + 1]) for k in range(len(corners))]
    if len(points) == 2 and ((points[1] - points[0]) * directions[1].conjugate()).real <= 0:
        # the chamfer is used up
        points, directions = (
            [_crossing(moved[0], directions[0], moved[2], directions[2])],
            [directions[0], directions[2]],
        )
    if points[0].imag >= 0:
        chamfered = len(points) == 2
        start = _crossing(0j, 1 + 0j, points[-1], directions[1] if chamfered else directions[-1])
        if chamfered and start.real < points[1].real:
            findings.append(Finding("tip_lost", start.real - points[0].real, 0.0))
            return [Segment(Line(start, points[1]), Label.TIP_BREAK)], points[1]
        start = _crossing(0j, 1 + 0j, points[-1], directions[-1])
        findings.append(Finding("tip_lost", start.real - points[0].real, 0.0))
        return [], start
    segments = [Segment(Line(complex(points[0].real, 0.0), points[0]), Label.TIP_LAND)]
    if len(points) == 2:
        segments.append(Segment(Line(points[0], points[1]), Label.TIP_BREAK))
    return segments, points[-1]


def _rounded_tip(
    corners: tuple[complex, ...], directions: tuple[complex, ...], radius: float, label: Label
) -> list[Segment]:
    """The lines beside corners, ``radius`` outside them, with arcs about the corners."""
    segments: list[Segment] = []
    place = complex(corners[0].real - radius, 0.0)
    for number, corner in enumerate(corners):
        before, after = directions[number], directions[number + 1]
        reached, left = corner - 1j * before * radius, corner - 1j * after * radius
        line_label = Label.TIP_LAND if number == 0 else Label.TIP_BREAK
        if abs(reached - place) > TOLERANCES.relative_length * abs(radius + abs(place)):
            segments.append(Segment(Line(place, reached), line_label))
        segments.append(Segment(arc_between(corner, reached, left, turns_left=True), label))
        place = left
    return segments


def _crossing(first: complex, along: complex, second: complex, other: complex) -> complex:
    """Where two lines cross."""
    share = ((second - first) * other.conjugate()).imag / (along * other.conjugate()).imag
    return first + share * along


def rack_region(rack: Rack, offset: float = 0.0) -> OffsetRegion:
    """The exact section of a rack in the rack frame; ``offset`` > 0 moves every boundary out of the material, mm.

    Raises
    ------
    ParameterError
        The rack cannot exist, or the offset closes the spaces or leaves no tooth or body; the nearest that works is
        named.
    """
    return moved_teeth(partial(_region, rack), offset)


def _region(rack: Rack, offset: float) -> OffsetRegion:
    side = rack_side(rack, offset)
    lower = list(side.segments)
    upper = [Segment(s.curve.mirrored(), s.label) for s in reversed(lower)]
    tooth = _joined([*upper, *lower])
    pitch, count = rack.pitch, rack.number_of_teeth
    # tooth k in the mesh frame, from the end at +y to the one at -y
    places = [1j * pitch * ((count - 1) / 2 - k) for k in range(count)]
    chain = [Segment(s.curve.placed(Placement2(0.0, at)), s.label) for at in places for s in tooth]
    outline = _closed(rack, _joined(chain), offset)
    # into the rack frame: a quarter turn back
    turned = tuple(Segment(s.curve.placed(Placement2(-math.pi / 2)), s.label) for s in outline)
    row, body = rack.holes, rack.body_height
    holes = () if row is None else row.profiles(rack.dedendum, offset, row.thinnest(rack.length, body))
    return OffsetRegion(Region(Profile(turned), holes), offset, side.findings)


def _joined(chain: list[Segment]) -> list[Segment]:
    """Neighbouring straight segments of one label made one: lands that were halved by symmetry."""
    result: list[Segment] = []
    for segment in chain:
        last = result[-1] if result else None
        lands = (Label.TIP_LAND, Label.ROOT_LAND)
        if last is not None and last.label is segment.label and segment.label in lands:
            result[-1] = Segment(Line(start_point(last.curve), end_point(segment.curve)), segment.label)
        else:
            result.append(segment)
    return result


def _closed(rack: Rack, chain: list[Segment], offset: float) -> list[Segment]:
    """The toothed line closed by both ends and the bottom."""
    half, root = rack.length / 2, rack.dedendum
    bottom = root + rack.body_height
    if offset < 0:
        if bottom + offset <= root - offset:
            raise OffsetError(offset, "leaves_no_body")
        chain = _cut_at(chain, half + offset)
        first, last = start_point(chain[0].curve), end_point(chain[-1].curve)
        corners = [last, complex(bottom + offset, last.imag), complex(bottom + offset, first.imag), first]
        return chain + [Segment(Line(a, b), Label.BODY) for a, b in pairwise(corners)]
    corners = [complex(root, -half), complex(bottom, -half), complex(bottom, half), complex(root, half)]
    directions = [-1j, 1 + 0j, 1j, -1 + 0j, -1j]
    place = end_point(chain[-1].curve)
    body: list[Segment] = []
    for number, corner in enumerate(corners):
        reached = corner - 1j * directions[number] * offset
        if number:
            body.append(Segment(Line(place, reached), Label.BODY))
        place = reached
        if offset > 0:
            left = corner - 1j * directions[number + 1] * offset
            body.append(Segment(Arc(corner, offset, cmath.phase(reached - corner), math.pi / 2), Label.CORNER))
            place = left
    return [*chain, *body]


def _cut_at(chain: list[Segment], limit: float) -> list[Segment]:
    """The chain between y = limit and y = -limit: the ends move into what was a space's middle."""

    def below(sign: float, point: complex) -> float:
        return limit - sign * point.imag

    for sign in (1.0, -1.0):
        pieces = chain if sign > 0 else [Segment(s.curve.reversed(), s.label) for s in reversed(chain)]
        found = first_above([s.curve for s in pieces], partial(below, sign))
        if found is None:
            raise OffsetError(-limit, "leaves_no_tooth")
        kept = kept_from(pieces, found)
        chain = kept if sign > 0 else [Segment(s.curve.reversed(), s.label) for s in reversed(kept)]
    return chain


def checked_part_rack(rack: Rack, helix_angle: float = 0.0) -> Rack:
    """The rack if it can be made, else a refusal with the nearest value that works.

    ``rack``: in normal data, which the refusals name, where ``helix_angle`` is not 0, rad; returned is its transverse
    section then.

    Raises
    ------
    ParameterError
        The rack cannot be made: the parameter, its value, why, and what would work.
    """
    if not rack.number_of_teeth >= 1:
        raise ParameterError("number_of_teeth", rack.number_of_teeth, "too_few", Nearest(1, "at_least"))
    if not 0 < rack.body_height < math.inf:
        raise ParameterError("body_height", rack.body_height, "not_finite_above_zero", Nearest(rack.module))
    check_dimensions(rack, ("module",), ("circumferential_thinning", "tip_chamfer", "tip_rounding"))
    # the normal rack must have teeth before its transverse section is looked at
    checked_rack(rack.rack)
    cosine = math.cos(helix_angle)
    if helix_angle:
        rack = replace(rack, module=rack.module / cosine, rack=transverse_rack(rack.rack, helix_angle))
    angle = rack.rack.pressure_angle
    most = rack.pitch / 2 - 2 * rack.addendum * math.tan(angle)
    if most <= 0:
        height, given = math.pi / 4 / math.tan(angle) / cosine, rack.rack.addendum / cosine
        raise ParameterError.beyond("rack.addendum", given, "rack_tooth_pointed", height * _INSIDE)
    _at_most(rack, "circumferential_thinning", most * _INSIDE, "thinning_leaves_no_tip")
    if math.tan(angle) < 1:
        _at_most(rack, "tip_chamfer", rack.tip_thickness / 2 / (1 - math.tan(angle)), "chamfers_overlap")
    most = rack.tip_thickness / 2 * math.cos(angle) / (1 - math.sin(angle))
    _at_most(rack, "tip_rounding", most, "rounding_does_not_fit")
    if rack.holes is not None:
        rack.holes.check(rack.length, rack.body_height)
    rack_region(rack)
    return rack


def _at_most(rack: Rack, name: str, most: float, code: str) -> None:
    """Refuse a length above a limit, mm."""
    if (value := getattr(rack, name)) > most:
        raise ParameterError.beyond(name, value, code, most)

"""Sprockets for roller chains: tooth gaps of tangent arcs and lines, by ISO 606, GOST 591-69 and ANSI B29.1.

A gap is told from its bottom to the tip circle as curves that follow one another smoothly: a radius above 0 bends into
the material (a convex flank), one below 0 out of it (a seat), 0 is a line. Moved into the material, each stays of its
kind about its own centre. Frame: tooth 1 is centred on +x, rollers stand on the pitch circle.
"""

from __future__ import annotations

import cmath
import math
from functools import lru_cache, partial
from typing import ClassVar, NamedTuple

from geometry.base.errors import OffsetError, ParameterError, PointedTipError, limit
from geometry.base.findings import Finding
from geometry.base.nearest import nearest
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.base.tolerance import is_told
from geometry.curves.line_arc import Arc, Line
from geometry.gears.chains.chain import Chain
from geometry.gears.teeth.offset import grown_side
from geometry.gears.teeth.round_teeth import RoundTeeth
from geometry.gears.teeth.tooth import ToothSide
from geometry.plane.profile import Label, Segment
from geometry.solids.hub_holes import HubHoles

# K of GOST 591-69 by the pitch over the roller diameter: up to which it holds, beginning above the least
_LEAST_RATIO = 1.4
_HEIGHTS = ((1.5, 0.480), (1.6, 0.532), (1.7, 0.555), (1.8, 0.575), (2.0, 0.565))
_RATIO_DIGITS = 9
# of the pitch: tips by default are so thick where the limits of the tip diameter let them; thinner ones are told
_TIP_LAND, _THIN_LAND = 0.05, 0.02
_MARGIN = 1e-6
# that ISO 606 gives gaps for
_ISO_TEETH = (9, 150)
# of the pitch: rollers that leave teeth in every form
_USUAL_ROLLER = 0.55
# of the height of a flank, that a bevel leaves
_BEVEL_ENDS = 0.05
INCH = 25.4


class Piece(NamedTuple):
    """A curve of a gap: its radius, mm, and how far it turns, rad; of a line (radius 0) its length, mm."""

    radius: float
    extent: float


class Gap(NamedTuple):
    """A gap from the middle of its bottom to where the flank begins, whose radius stands last, mm.

    ``depth``: of the bottom below the pitch circle, mm.
    """

    depth: float
    pieces: tuple[Piece, ...]
    flank_radius: float


class IsoForm(Record):
    """The form of ISO 606: ``share`` 0 is the minimum gap, 1 the maximum, between them all its sizes go on evenly."""

    standard: ClassVar[str] = "ISO 606"

    share: float = 0.0

    def _between(self, least: float, most: float) -> float:
        return least + self.share * (most - least)

    def seating_radius(self, roller: float) -> float:
        """r_i: 0.505 d1, at most 0.069 cbrt(d1) more, mm."""
        return 0.505 * roller + self.share * 0.069 * math.cbrt(roller)

    def seating_angle(self, teeth: int) -> float:
        """alpha: 140 - 90 / z deg in the minimum gap, 120 - 90 / z in the maximum one; in rad."""
        return math.radians(self._between(140.0, 120.0) - 90.0 / teeth)

    def flank_radius(self, roller: float, teeth: int) -> float:
        """r_e: 0.12 d1 (z + 2) in the minimum gap, 0.008 d1 (z^2 + 180) in the maximum one, mm."""
        return self._between(0.12 * roller * (teeth + 2), 0.008 * roller * (teeth**2 + 180))

    def gap(self, chain: Chain, teeth: int) -> Gap:
        """The seat touches the roller at its bottom; the root diameter is d - d1."""
        roller = chain.roller_diameter
        seat = Piece(-self.seating_radius(roller), self.seating_angle(teeth) / 2)
        return Gap(roller / 2, (seat,), self.flank_radius(roller, teeth))

    def tips(self, chain: Chain, teeth: int) -> tuple[float, float]:
        """Limits of the tip diameter: d + p (1 - 1.6 / z) - d1 and d + 1.25 p - d1, mm."""
        least = pitch_diameter(chain.pitch, teeth) - chain.roller_diameter
        return least + chain.pitch * (1 - 1.6 / teeth), least + 1.25 * chain.pitch


class SeatedForm(Record):
    """Seat, a wider arc, a line, the head's arc: what GOST 591-69 and ANSI B29.1 have in common.

    ``play``: by how much a seat is wider than 0.5025 D, mm; ``far``: of the head's centre, in roller diameters.
    """

    standard: ClassVar[str]
    play: ClassVar[float]
    far: ClassVar[float]

    def seating_radius(self, roller: float) -> float:
        """r = 0.5025 D and the play, mm."""
        return 0.5025 * roller + self.play

    def angles(self, teeth: int) -> tuple[float, float, float]:
        """alpha = 55 - 60 / z, beta = 18 - 56 / z, phi = 17 - 64 / z; in rad."""
        return math.radians(55 - 60 / teeth), math.radians(18 - 56 / teeth), math.radians(17 - 64 / teeth)

    def displacement(self, pitch: float) -> float:
        """Between the centres of both seats, mm."""
        return 0.0

    def flank_radius(self, roller: float, teeth: int) -> float:
        """r2 = D (far cos phi + 0.8 cos beta - 1.3025) less the play, mm: of the head."""
        _, beta, phi = self.angles(teeth)
        return roller * (self.far * math.cos(phi) + 0.8 * math.cos(beta) - 1.3025) - self.play

    def straight(self, roller: float, teeth: int) -> float:
        """D (far sin phi - 0.8 sin beta): the line between both arcs, mm."""
        _, beta, phi = self.angles(teeth)
        return roller * (self.far * math.sin(phi) - 0.8 * math.sin(beta))

    def gap(self, chain: Chain, teeth: int) -> Gap:
        """r turns by alpha, r1 = 0.8 D + r by beta, then the line goes straight on."""
        roller, radius = chain.roller_diameter, self.seating_radius(chain.roller_diameter)
        alpha, beta, _ = self.angles(teeth)
        apart = self.displacement(chain.pitch)
        wide = (Piece(0.0, apart / 2),) if apart else ()
        curves = Piece(-radius, alpha), Piece(-0.8 * roller - radius, beta), Piece(0.0, self.straight(roller, teeth))
        return Gap(radius, (*wide, *curves), self.flank_radius(roller, teeth))

    def tips(self, chain: Chain, teeth: int) -> tuple[float, float]:
        """The one diameter t (K + cot(180 deg / z)), mm, twice."""
        one = chain.pitch * (self.height(chain) + 1 / math.tan(math.pi / teeth))
        return one, one

    def height(self, chain: Chain) -> float:
        """K."""
        raise NotImplementedError


class GostForm(SeatedForm):
    """The form of GOST 591-69; ``displaced``: its seats are e = 0.03 t wider."""

    standard: ClassVar[str] = "GOST 591-69"
    play: ClassVar[float] = 0.05
    far: ClassVar[float] = 1.24

    displaced: bool = False

    def displacement(self, pitch: float) -> float:
        """E = 0.03 t, mm."""
        return 0.03 * pitch if self.displaced else 0.0

    def height(self, chain: Chain) -> float:
        """By the pitch over the roller diameter."""
        return height_coefficient(chain)


class AnsiForm(SeatedForm):
    """The form of ANSI B29.1: R = D_s / 2 with D_s = 1.005 D_r + 0.003 in, tips P (0.6 + cot(180 deg / N))."""

    standard: ClassVar[str] = "ANSI B29.1"
    play: ClassVar[float] = 0.0015 * INCH
    far: ClassVar[float] = 1.4

    def height(self, chain: Chain) -> float:
        """0.6, of every chain."""
        return 0.6


def height_coefficient(chain: Chain) -> float:
    """K of GOST 591-69, by the pitch over the roller diameter.

    Raises
    ------
    ParameterError
        The standard has none for such a chain.
    """
    # 9.525 over 6.35 is 1.5, which its last digit is not
    ratio, roller = round(chain.pitch / chain.roller_diameter, _RATIO_DIGITS), chain.roller_diameter
    if ratio > _HEIGHTS[-1][0]:
        least = limit(chain.pitch / _HEIGHTS[-1][0], roller, digits=6)
        raise ParameterError("roller_diameter", roller, "no_height_of_tooth", least)
    if ratio <= _LEAST_RATIO:
        most = limit(chain.pitch / _LEAST_RATIO * (1 - _MARGIN), roller, digits=6)
        raise ParameterError("roller_diameter", roller, "no_height_of_tooth", most)
    return next(k for most, k in _HEIGHTS if ratio <= most)


def pitch_diameter(pitch: float, teeth: int) -> float:
    """d = p / sin(180 deg / z): of the circle through the centres of seated rollers, mm."""
    return pitch / math.sin(math.pi / teeth)


class Sprocket(RoundTeeth):
    """A sprocket of ``number_of_teeth`` for a chain; ``given_tip_diameter`` None: of the form. Lengths in mm.

    ``bevel``: of the teeth on both sides, along the axis at their tips; it ends where their flanks begin.
    """

    chain: Chain
    form: IsoForm | SeatedForm
    given_tip_diameter: float | None = None
    holes: HubHoles = HubHoles()
    face_width: float = 0.0
    bevel: float = 0.0

    @property
    def strands(self) -> int:
        """How many rows of teeth there are."""
        return self.chain.strands

    @property
    def total_width(self) -> float:
        """Of all rows, mm."""
        return (self.strands - 1) * self.chain.transverse_pitch + self.face_width

    @property
    def core_radius(self) -> float:
        """Of the round body within all teeth, mm: of the roots, of several strands that between the rows."""
        return self.root_radius if self.strands == 1 else min(self.plate_room / 2, self.root_radius)

    @property
    def pitch_radius(self) -> float:
        """Of the circle through the rollers' centres, mm."""
        return pitch_diameter(self.chain.pitch, self.number_of_teeth) / 2

    @property
    def gap(self) -> Gap:
        """The gap between two teeth."""
        return self.form.gap(self.chain, self.number_of_teeth)

    @property
    def root_radius(self) -> float:
        """Of the bottoms of the gaps, mm."""
        return self.pitch_radius - self.gap.depth

    @property
    def tip_radius(self) -> float:
        """r_a, mm."""
        return limits_of(self).tip_radius

    @property
    def bevel_radius(self) -> float:
        """Where the bevel ends at the faces: a little above the beginning of the flanks, mm."""
        found = limits_of(self)
        return found.start_radius + _BEVEL_ENDS * (found.tip_radius - found.start_radius)

    @property
    def tip_thickness(self) -> float:
        """Width of the tip land, mm (arc)."""
        return flank_of(self).land_at(self.tip_radius)

    @property
    def over_pins(self) -> float:
        """M_R over two pins as thick as the rollers, in opposite gaps or, of odd teeth, in those nearest to it, mm.

        ISO 606 has them on the pitch circle, d cos(90 deg / z) + d1; in wider seats they lie where the chord is.
        """
        roller = self.chain.roller_diameter
        if isinstance(self.form, SeatedForm):
            return self.root_chord + 2 * roller
        return self.nominal_chord + 2 * roller

    @property
    def root_chord(self) -> float:
        """L_x, the least way from a seat to that opposite or nearest to it: what callipers find, mm.

        (d_f + 2 r) cos(90 deg / z) - e sin(90 deg / z) - 2 r, of arcs r whose centres are e apart; d_f of even teeth.
        """
        off = self.pitch_angle / 4 if self.number_of_teeth % 2 else 0.0
        radius = self.form.seating_radius(self.chain.roller_diameter)
        apart = self.form.displacement(self.chain.pitch) if isinstance(self.form, SeatedForm) else 0.0
        return 2 * ((self.root_radius + radius) * math.cos(off) - radius) - apart * math.sin(off)

    @property
    def nominal_chord(self) -> float:
        """The caliper diameter as ANSI B29.1 has it, on nominal rollers in place of the wider seats, mm."""
        odd = math.cos(self.pitch_angle / 4) if self.number_of_teeth % 2 else 1.0
        return 2 * self.pitch_radius * odd - self.chain.roller_diameter

    @property
    def plate_room(self) -> float:
        """Diameter within which the chain's plates do not come, less what the standard leaves; 0: not known, mm.

        d_g = p cot(180 deg / z) - 1.04 h2 - 0.76 of ISO 606, D_c = t cot(180 deg / z) - 1.3 h of GOST 591-69,
        P (cot(180 deg / N) - 1) - 0.030 in of ANSI B29.1, for which no height of plates is needed.
        """
        pitch, height = self.chain.pitch, self.chain.plate_height
        circle = pitch / math.tan(math.pi / self.number_of_teeth)
        if isinstance(self.form, AnsiForm):
            return circle - pitch - 0.030 * INCH
        if not height:
            return 0.0
        return circle - (1.04 * height + 0.76 if isinstance(self.form, IsoForm) else 1.3 * height)


class Flank(NamedTuple):
    """The last arc of a gap, seen from tooth 1: centre, radius, and where it begins."""

    centre: complex
    radius: float
    start: complex
    heading: complex

    @property
    def pointed_radius(self) -> float:
        """Where it meets its mirror image, mm."""
        return self.centre.real + math.sqrt(max(self.radius**2 - self.centre.imag**2, 0.0))

    def angle_at(self, radius: float) -> float:
        """Polar angle where it crosses a circle about the axis, rad."""
        far = abs(self.centre)
        share = (far**2 + radius**2 - self.radius**2) / (2 * far * radius)
        return cmath.phase(self.centre) - math.acos(min(1.0, max(-1.0, share)))

    def land_at(self, radius: float) -> float:
        """Thickness of the tooth on a circle about the axis, mm (arc)."""
        return -2 * radius * self.angle_at(radius)


def _walked(sprocket: Sprocket, inset: float) -> tuple[list[Segment], Flank]:
    """The curves of the gap below tooth 1, moved into the material, and the arc of the flank after them.

    Raises
    ------
    OffsetError
        Nothing is left of the flank's arc.
    """
    gap, along = sprocket.gap, cmath.rect(1.0, -sprocket.pitch_angle / 2)
    place, heading = (sprocket.root_radius - inset) * along, 1j * along
    made: list[Segment] = []
    for radius, extent in gap.pieces:
        if radius == 0:
            curve: Line | Arc = Line(place, place + heading * extent)
            label = Label.FLANK if made else Label.ROOT_FILLET
        else:
            centre = place + 1j * heading * (radius - inset)
            turn = math.copysign(extent, radius)
            curve = Arc(centre, abs(radius - inset), cmath.phase(place - centre), turn)
            heading *= cmath.rect(1.0, turn)
            label = Label.ROOT_FILLET
        made.append(Segment(curve, label))
        place = complex(curve.point(curve.domain[1]))
    radius = gap.flank_radius - inset
    if not radius > 0:
        raise OffsetError(-inset, "leaves_no_tooth")
    return made, Flank(place + 1j * heading * radius, radius, place, heading)


@lru_cache(maxsize=64)
def flank_of(sprocket: Sprocket) -> Flank:
    """The arc of the lower flank of tooth 1."""
    return _walked(sprocket, 0.0)[1]


class TipLimits(Record):
    """Radii of the tip as it is, where the flank begins, and where the tooth would be pointed, mm."""

    tip_radius: float
    start_radius: float
    pointed_radius: float


@lru_cache(maxsize=64)
def limits_of(sprocket: Sprocket) -> TipLimits:
    """The tip of the sprocket, within the limits of its form and below where its tooth is pointed.

    Raises
    ------
    ParameterError
        There is no tooth between two rollers, or no tip within the limits; names the key and what works.
    """
    chain, teeth = sprocket.chain, sprocket.number_of_teeth
    if not sprocket.gap.flank_radius > 0:
        # the play of a seat is more than the smallest rollers have
        raise _toothless(sprocket)
    flank = flank_of(sprocket)
    start, pointed = abs(flank.start), flank.pointed_radius
    if not (sprocket.root_radius > 0 and flank.start.imag < 0 and start < pointed):
        raise _toothless(sprocket)
    given = sprocket.given_tip_diameter
    if given is not None and isinstance(sprocket.form, SeatedForm):
        return _given_tip(given, (2 * start, 2 * pointed), start, pointed)
    least, most = sprocket.form.tips(chain, teeth)
    if given is not None:
        return _given_tip(given, (max(least, 2 * start), most), start, pointed)
    radius, highest = (least + most) / 4, pointed * (1 - _MARGIN)
    if isinstance(sprocket.form, SeatedForm) and radius >= highest:
        # displaced seats of many teeth leave none of the standard's height
        radius = _tip_of_land(flank, _THIN_LAND * chain.pitch)
    elif least / 2 >= highest:
        raise _toothless(sprocket)
    if radius <= start:
        raise _toothless(sprocket)
    if least < most and (radius >= pointed or flank.land_at(radius) < _TIP_LAND * chain.pitch):
        radius = least / 2
    return TipLimits(radius, start, pointed)


def _tip_of_land(flank: Flank, land: float) -> float:
    """Radius at which teeth are so thick, mm; where they begin, if they are thinner there."""
    start, pointed = abs(flank.start), flank.pointed_radius
    if flank.land_at(start) <= land:
        return start
    return bracketed_root(lambda radius: flank.land_at(radius) - land, start, pointed).value


def _toothless(sprocket: Sprocket) -> ParameterError:
    """No tooth, or a pointed one at every tip of the form."""
    chain = sprocket.chain

    def fits(diameter: float) -> bool:
        limits_of(replace(sprocket, chain=replace(chain, roller_diameter=diameter)))
        return True

    cure = partial(nearest, fits, chain.roller_diameter, _USUAL_ROLLER * chain.pitch, digits=6)
    return ParameterError("roller_diameter", chain.roller_diameter, "leaves_no_tooth_between_rollers", cure)


def _given_tip(given: float, limits: tuple[float, float], start: float, pointed: float) -> TipLimits:
    """A tip diameter by its key."""
    least, most = limits[0], min(limits[1], 2 * pointed * (1 - _MARGIN))
    if given > most and not is_told(given, most):
        near = limit(most, given, digits=6)
        if most < limits[1] or given >= 2 * pointed:
            raise PointedTipError("tip_diameter", given, "tooth_pointed_at", near, diameter=2 * pointed)
        raise ParameterError("tip_diameter", given, "beyond_the_standard", near, least=least, most=most)
    if given <= least * (1 - _MARGIN):
        near = limit(least * (1 + _MARGIN), given, digits=6)
        raise ParameterError("tip_diameter", given, "beyond_the_standard", near, least=least, most=most)
    return TipLimits(given / 2, start, pointed)


@lru_cache(maxsize=32)
def sprocket_side(sprocket: Sprocket, offset: float = 0.0, tip_radius: float | None = None) -> ToothSide:
    """The lower side of tooth 1, moved ``offset`` mm out of the material; ``tip_radius``: cut off there before, mm.

    Raises
    ------
    GeometryError
        The offset leaves no tooth, or closes the gaps.
    """
    if offset > 0:
        return grown_side(sprocket_side(sprocket, 0.0, tip_radius), offset)
    segments, flank = _walked(sprocket, -offset)
    tip = (limits_of(sprocket).tip_radius if tip_radius is None else tip_radius) + offset
    if not sprocket.root_radius + offset > sprocket.holes.reach - offset:
        raise OffsetError(offset, "leaves_no_rim")
    findings: tuple[Finding, ...] = ()
    pointed = flank.pointed_radius
    if flank.start.imag >= 0 or not abs(flank.start) < min(tip, pointed):
        raise OffsetError(offset, "leaves_no_tooth")
    if tip >= pointed:
        tip, findings = pointed, (Finding("tip_lost", tip - pointed, 0.0),)
    angle = min(flank.angle_at(tip), 0.0) if not findings else 0.0
    away = cmath.rect(tip, angle) - flank.centre
    turn = cmath.phase(away / (flank.start - flank.centre))
    arc = Arc(flank.centre, flank.radius, cmath.phase(flank.start - flank.centre), turn)
    segments.append(Segment(arc, Label.FLANK))
    if angle < 0:
        segments.append(Segment(Arc(0j, tip, angle, -angle), Label.TIP_LAND))
    return ToothSide(tuple(segments), sprocket.pitch_angle, findings)


def checked_sprocket(sprocket: Sprocket) -> Sprocket:
    """The same sprocket, if its teeth exist.

    Raises
    ------
    ParameterError
        No tooth between two rollers, a tip that is pointed or beyond the limits; names the key and what works.
    """
    limits_of(sprocket)
    return sprocket


def has_lowered_tip(sprocket: Sprocket) -> bool:
    """Whether its teeth would be pointed at the tip diameter of its standard, and are lower by default."""
    least = sprocket.form.tips(sprocket.chain, sprocket.number_of_teeth)[0]
    return sprocket.given_tip_diameter is None and 2 * sprocket.tip_radius < least * (1 - 1e-12)


def sprocket_findings(sprocket: Sprocket) -> tuple[Finding, ...]:
    """Thin teeth, those that are lower than by their standard, and numbers of them that ISO 606 has no gaps for."""
    land = _THIN_LAND * sprocket.chain.pitch
    thin = sprocket.tip_thickness
    found = [Finding("thin_sprocket_tip", thin, land)] if thin < land * (1 - _MARGIN) else []
    teeth, (least, most) = sprocket.number_of_teeth, _ISO_TEETH
    if has_lowered_tip(sprocket):
        found.append(
            Finding("lowered_sprocket_tip", 2 * sprocket.tip_radius, sprocket.form.tips(sprocket.chain, teeth)[0])
        )
    if isinstance(sprocket.form, IsoForm):
        found += [Finding("few_sprocket_teeth", teeth, least)] if teeth < least else []
        found += [Finding("many_sprocket_teeth", teeth, most)] if teeth > most else []
    return tuple(found)


def face_width(chain: Chain, form: IsoForm | SeatedForm) -> float:
    """Width of the teeth by the inner width of the chain, mm.

    ISO 606: 0.93 b1 (0.91 of several strands) to p = 12.7 mm, 0.95 b1 (0.93) above. GOST 591-69: 0.93 B - 0.15 mm,
    of two and three strands 0.90 B - 0.15 mm. ANSI B29.1: the same less 0.006 in.
    """
    part, less = width_parts(chain, form)
    return part * chain.inner_width - less


def width_parts(chain: Chain, form: IsoForm | SeatedForm) -> tuple[float, float]:
    """Of the inner width of the chain, and how much less, mm: see ``face_width``."""
    single = chain.strands == 1
    if isinstance(form, SeatedForm):
        return 0.93 if single else 0.90, 0.006 * INCH if isinstance(form, AnsiForm) else 0.15
    return (0.93 if chain.pitch <= 12.7 else 0.95) - (0.0 if single else 0.02), 0.0

"""Steps of what a calliper reads on a gear or a ring: span, pins or balls, chords; on the pages of both."""

from __future__ import annotations

import math
from functools import partial

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.nearest import nearest
from geometry.base.record import Record
from geometry.base.tolerance import is_told
from geometry.gears.teeth import measurement
from geometry.gears.teeth.measurement import SPAN_CONTACT, Measured, Span
from geometry.gears.teeth.ring import RingGear
from parts.base.texts import N_, Text, Told
from parts.pages.page import Sheet

ISO = "ISO 21771"


class Asked(Record):
    """What a page is asked to measure: helix angle in rad, lengths in mm; ``spanned`` teeth, of a ring spaces.

    ``double``: the face has two helices, each half as wide.
    """

    helix: float
    face_width: float
    double: bool
    spanned: int | None
    pin_diameter: float | None
    kerf: float | None
    measured_span: float | None
    measured_size: float | None

    def share(self, sign: str) -> str:
        """What brings a transverse length of a formula into the normal section."""
        return f" {sign} cos({{beta_b}})" if self.helix else ""


class _Side(Record):
    """How teeth are told that point outwards, or inwards: names of terms, titles, pieces of formulas.

    ``arc``: key of what fills a span at the base circle, the tooth or a ring's space; ``out`` and ``back``: the signs
    of what counts away from the tooth's root and towards it.
    """

    spanned: str
    to_span: str
    span: str
    size: str
    titles: tuple[str, str]
    arc: str
    out: str
    back: str
    pin_angle: str
    chord_height: str
    constant_height: str
    source: str


_OUTER = _Side(
    "teeth_spanned", "teeth_to_span", "span", "over", (N_("Over pins"), N_("Over balls")), "S_b", "+", "-",
    "{D} / {d_b}% + {S_b} / {d_b} - pi / {z}",
    "({d_a} - {d} * cos({S} / {d})) / 2", "({d_a} - {d} - {S_c} * tan({alpha})) / 2",
    "GOST 16532-70",
)  # fmt: skip
_INNER = _Side(
    "spaces_spanned", "spaces_to_span", "span_over_spaces", "between", (N_("Between pins"), N_("Between balls")),
    "e_b", "-", "+", "{e_b} / {d_b} - {D} / {d_b}%",
    "({d} * cos({S} / {d}) - {d_a}) / 2", "({d} - {d_a} - {S_c} * tan({alpha})) / 2",
    "ISO 21771",
)  # fmt: skip


def measured_steps(page: Sheet, gear: Measured, asked: Asked) -> None:
    """Span, pins or balls, chords; the page knows diameters, thicknesses and the arc of the span already.

    Raises
    ------
    ParameterError
        What is asked cannot be measured; names the key.
    """
    side = _INNER if isinstance(gear, RingGear) else _OUTER
    _spans(page, gear, asked, side)
    _pins(page, gear, asked, side)
    _chords(page, gear, asked, side)


def _chords(page: Sheet, gear: Measured, asked: Asked, side: _Side) -> None:
    """Thickness on chords, where they are on the tooth."""
    chord, constant = measurement.reference_chord(gear, asked.helix), measurement.constant_chord(gear, asked.helix)
    formulas = ("", "", "", "")
    if not asked.helix:
        formulas = "{d} * sin({S} / {d})", side.chord_height, "{S} * cos({alpha})**2", side.constant_height
    if max(chord.height, constant.height) > 0:
        page.section("Chords")
    if chord.height > 0:
        page.add("chordal_thickness", chord.thickness, formulas[0], side.source)
        page.add("chordal_height", chord.height, formulas[1], side.source)
    else:
        page.note("the chord at the reference circle would lie beyond the tip")
    if constant.height > 0:
        # that of a ring is a derivation of ours
        source = side.source if side is _OUTER else ""
        page.add("constant_chord", constant.thickness, formulas[2], source)
        page.add("constant_chord_height", constant.height, formulas[3], source)
    else:
        page.note("the constant chord would lie beyond the tip")


def _spans(page: Sheet, gear: Measured, asked: Asked, side: _Side) -> None:
    """The span that fits best, or that over as many as are asked for, and what it tells of the part."""
    if isinstance(gear, RingGear) and asked.helix:
        for key, value in ((side.spanned, asked.spanned), ("measured_span", asked.measured_span)):
            if value is not None:
                raise ParameterError(key, value, "no_span_of_helical_ring")
        page.note("no faces find the flanks of a helical ring: it has no span, only a size between balls")
        return
    page.section("Span")
    page.add(side.to_span, measurement.teeth_to_span(gear, asked.helix), "", side.source)
    best = measurement.best_span(gear, asked.helix)
    if asked.spanned is not None:
        best = measurement.span(gear, asked.spanned, asked.helix)
    if gear.sector is not None:
        # a ring's span is over the spaces between its teeth
        most = gear.sector.teeth - (side is _INNER)
        if asked.spanned is not None and asked.spanned > most:
            cure = limit(most, asked.spanned) if most > 1 - (side is _INNER) else None
            raise ParameterError(side.spanned, asked.spanned, "span_beyond_sector", cure, most=most)
        if best is not None and best.teeth > most:
            shorter = measurement.span(gear, most, asked.helix) if most > 0 else None
            best = shorter if shorter is not None and shorter.touches_flanks else None
    if best is None:
        page.note("no span touches the flanks of this gear")
        return
    share = asked.share("*")
    page.add(side.spanned, best.teeth)
    formula = f"({{k}} - 1) * {{p_b}} + {{{side.arc}}}"
    page.add(side.span, best.length, f"({formula}){share}" if share else formula, ISO)
    if gear.circumferential_thinning:
        full = measurement.span(measurement.nominal(gear), best.teeth, asked.helix).length
        page.add("span_nominal", full, f"{{W}} {side.out} {{A}} * cos({{alpha}}){share}", ISO)
    formula = f"sqrt({{d_b}}**2 + ({{W}}{share})**2)" if share else "sqrt({d_b}**2 + {W}**2)"
    page.add("span_contact_diameter", best.contact_diameter, formula, side.source)
    _real_part(page, gear, best, asked, side)
    if asked.helix:
        _span_width(page, best, asked)
    if not best.touches_flanks:
        page.note("the span does not touch the involutes")


def _span_width(page: Sheet, best: Span, asked: Asked) -> None:
    """What the face must be wide for the span of helical teeth, and what it is; of two helices that of one."""
    face_width = asked.face_width / (2 if asked.double else 1)
    if asked.double:
        page.add("helix_face_width", face_width)
    else:
        page.add("face_width", face_width)
    page.add("least_face_width", best.least_face_width, "{W} * sin(abs({beta_b}))", ISO)
    formula = f"{{b_min}} + ({SPAN_CONTACT[0]} + {SPAN_CONTACT[1]} * {{W}}) * cos({{beta_b}})"
    page.add("secure_face_width", best.secure_face_width, formula, "DIN 3960")
    if face_width < best.least_face_width:
        page.note(
            "the face width of {width:g} mm is too small for the span: above {least:.4f} mm is needed; measure "
            "over balls",
            width=face_width,
            least=best.least_face_width,
        )
    elif face_width < best.secure_face_width:
        page.note(
            "the span finds little hold on a face width of {width:g} mm: {secure:.4f} mm is secure",
            width=face_width,
            secure=best.secure_face_width,
        )


def _real_part(page: Sheet, gear: Measured, best: Span, asked: Asked, side: _Side) -> None:
    """The span that a cut without correction leaves, and what a measured span tells."""
    if asked.kerf:
        page.add("kerf", asked.kerf)
        # each face touches a flank that lies half a kerf deeper along its normal
        sign = 1 if side.out == "+" else -1
        page.add("span_after_kerf", best.length - sign * asked.kerf, f"{{W}} {side.back} {{kerf}}")
    if asked.measured_span is not None:
        page.add("measured_span", asked.measured_span)
        lack = abs(best.length - asked.measured_span)
        page.add("normal_allowance", lack, "{W} - {W_m}" if side.out == "+" else "{W_m} - {W}")
        thinned = measurement.gear_with_span(gear, best.teeth, asked.measured_span, asked.helix)
        own = " + {A}" if gear.circumferential_thinning else ""
        formula = f"{{E}} / (cos({{alpha}}){asked.share('*')}){own}"
        page.add("thinning_from_span", thinned.circumferential_thinning, formula, ISO)


def _after_kerf(gear: Measured, pin: float, kerf: float, helix: float) -> float:
    """The size over pins that a cut without correction leaves, mm; of a ring between them.

    In a space whose flanks lie half a kerf deeper a pin sits as one that is thinner by the kerf sits in the space.
    """

    def size(cut: float) -> float:
        if not pin > cut:
            raise ParameterError("kerf", cut, "kerf_drops_pin", pin=pin)
        return measurement.over_pins(gear, pin - cut, helix).length + gear.sign * cut

    try:
        return size(kerf)
    except ParameterError as refusal:
        cure = partial(nearest, lambda cut: size(cut) > 0, kerf, 0.0)
        raise ParameterError("kerf", kerf, "kerf_drops_pin", cure, pin=pin) from refusal


def _pins(page: Sheet, gear: Measured, asked: Asked, side: _Side) -> None:
    """Pins, balls where the teeth are helical, and when pins give the same there."""
    tool, helix = "ball" if asked.helix else "pin", asked.helix
    size = f"{side.size}_{tool}s"
    if gear.sector is not None and not gear.sector.has_opposite_spaces(gear.number_of_teeth):
        _without_pins(page, asked, side)
        return
    page.section(side.titles[bool(helix)])
    try:
        best = measurement.best_pin_diameter(gear, helix)
        low, high = measurement.pin_limits(gear, helix)
    except ParameterError:
        low = high = math.nan
    if not low <= high:
        page.note(
            N_("no ball touches both flanks of a space") if helix else N_("no pin touches both flanks of a space")
        )
        return
    page.add(f"best_{tool}_diameter", best, "", ISO)
    page.add(f"least_{tool}_diameter", low)
    page.add(f"greatest_{tool}_diameter", high)
    pin = measurement.fit_pin_diameter(gear, helix) if asked.pin_diameter is None else asked.pin_diameter
    found = measurement.over_pins(gear, pin, helix)
    page.add(f"{tool}_diameter", pin)
    angle = math.degrees(math.acos(2 * gear.base_radius / found.centre_diameter))
    formula = f"arcinv({side.pin_angle.replace('%', asked.share('/'))})"
    page.add(f"{tool}_centre_angle_deg", angle, formula, ISO)
    page.add(f"{tool}_centre_diameter", found.centre_diameter, "{d_b} / cos({alpha_D})", ISO)
    even = gear.number_of_teeth % 2 == 0
    formula = f"{{d_D}} {side.out} {{D}}" if even else f"{{d_D}} * cos(pi / (2 * {{z}})) {side.out} {{D}}"
    page.add(size, found.length, formula, ISO)
    if helix and not even and side.out == "+":
        # half an axial pitch apart along the axis, which two pins are free to be and two balls in one plane are not
        page.add("over_opposite_pins", found.centre_diameter + pin, "{d_D} + {D}", ISO)
    if gear.circumferential_thinning:
        page.add(f"{size}_nominal", measurement.over_pins(measurement.nominal(gear), pin, helix).length)
    if asked.kerf:
        page.add(f"{size}_after_kerf", _after_kerf(gear, pin, asked.kerf, helix))
    page.add(f"{tool}_contact_diameter", found.contact_diameter)
    if asked.measured_size is not None:
        page.add(f"measured_{size}", asked.measured_size)
        thinned = measurement.gear_with_size(gear, pin, asked.measured_size, helix).circumferential_thinning
        odd = "" if even else " * cos(pi / (2 * {z}))"
        polar = f"inv(arccos({{d_b}}{odd} / ({{M_m}} {side.back} {{D}})))"
        formula = f"inv({{alpha_D}}) - {polar}" if side.out == "+" else f"{polar} - inv({{alpha_D}})"
        own = " + {A}" if gear.circumferential_thinning else ""
        formula = f"{{d}} * ({formula}){own}"
        page.add("thinning_from_size", thinned, formula, ISO)
    if not ((found.touches_flanks and found.stands_out) or is_told(pin, low) or is_told(pin, high)):
        told = (
            N_("a ball of {diameter:.4g} mm touches no involute or is sunk; {least:.4g} to {greatest:.4g} mm touch")
            if helix
            else N_("a pin of {diameter:.4g} mm touches no involute or is sunk; {least:.4g} to {greatest:.4g} mm touch")
        )
        low, high = measurement.measuring_limits(gear, helix)
        page.note(told, diameter=pin, least=Told(low, up=True), greatest=Told(high, up=False))
    if helix:
        page.note(_same_with_pins(gear, even=even))


def _without_pins(page: Sheet, asked: Asked, side: _Side) -> None:
    """A sector without two opposite spaces; raises ``ParameterError`` where pins are asked for."""
    for key, value in (("pin_diameter", asked.pin_diameter), (f"measured_{side.size}_pins", asked.measured_size)):
        if value is not None:
            raise ParameterError(key, value, "no_opposite_spaces", Nearest(None))
    page.note("no two spaces of the sector stand opposite each other: nothing is measured over pins or balls")


def _same_with_pins(gear: Measured, *, even: bool) -> Text:
    """Pins lie along the screw line of their middle, at right angles to both normals of contact; in a ring on edge."""
    if isinstance(gear, RingGear):
        return N_("M holds for balls in one transverse plane; pins do not fit the hollow spaces of a helical ring")
    if even:
        return N_("the number of teeth is even: pins of the ball's diameter give the same M")
    return N_("the number of teeth is odd: M holds for balls in one transverse plane, M_p for pins in helical spaces")

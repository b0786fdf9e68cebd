"""``higherpair calc identify``: an unknown gear by two spans or by pins, and by the diameters of its tips and roots."""

from __future__ import annotations

import math
from typing import Annotated

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.gears.teeth.identified import ANGLES, FITS, Match, by_span, matches, pin_centres, shift_of_pins
from geometry.gears.teeth.module_rows import INCH
from geometry.gears.teeth.transverse import base_helix_angle, transverse_angle
from parts.base.texts import N_, message
from parts.keys.base import check_not_in_vain, degrees, mm
from parts.pages.inputs import calculation
from parts.pages.page import Sheet, Table, table_of

TOPIC = "identify"
# so many angles with their modules are shown
_ROWS = 6
# heights of teeth above and below the pitch line that are cut, modules: from stub teeth to high ones of clocks
_ADDENDA, _DEDENDA = (0.6, 1.4), (0.8, 1.55)
_Teeth = Annotated[int, Meta(ge=3, le=10_000, description="number of teeth z, counted", examples=[24])]
_Spanned = Annotated[int, Meta(ge=1, le=10_000, description="teeth in the first span k", examples=[4])]
_SPAN = mm("span measured over k teeth", above=0, most=100_000, example=32.83)
_NEXT = mm("span measured over one tooth more", above=0, most=100_000, example=41.68)
_OVER = mm("in place of spans, with module and pin_diameter: size measured over pins or balls", above=0, most=100_000,
           example=83.9)  # fmt: skip
_BETWEEN = mm("the same of a ring: size measured between pins or balls", above=0, most=100_000, example=115.6)


class IdentifyKeys(Struct, kw_only=True, forbid_unknown_fields=True):
    """Keys of the topic: what was counted and measured, and what is known besides."""

    number_of_teeth: _Teeth
    teeth_spanned: _Spanned | None = None
    span: Annotated[float, _SPAN] | None = None
    next_span: Annotated[float, _NEXT] | None = None
    over_pins: Annotated[float, _OVER] | None = None
    between_pins: Annotated[float, _BETWEEN] | None = None
    pin_diameter: Annotated[float, mm("diameter of those pins or balls", above=0, most=10_000, example=5.0)] | None = (
        None
    )
    tip_diameter: Annotated[float, mm("tip diameter measured", above=0, most=100_000)] | None = None
    root_diameter: Annotated[float, mm("root diameter measured", above=0, most=100_000)] | None = None
    helix_angle_deg: Annotated[float, degrees("helix angle measured", least=-60, most=60)] = 0.0
    pressure_angle_deg: Annotated[float, degrees("pressure angle, where it is known", least=5, most=45)] | None = None
    module: Annotated[float, mm("module, where it is known", least=0.01, most=1000)] | None = None


@calculation(TOPIC, IdentifyKeys)
def sheet(keys: IdentifyKeys) -> Sheet:
    """Module and pressure angle, shift, heights of the tooth, and the keys of a scene."""
    pins = [k for k in ("over_pins", "between_pins") if getattr(keys, k) is not None]
    spans = [k for k in ("teeth_spanned", "span", "next_span") if getattr(keys, k) is not None]
    if len(both := [*pins, *spans]) > 1 and pins:
        raise ParameterError(both[1], getattr(keys, both[1]), "either_key", Nearest(None), one=both[0], other=both[1])
    page = Sheet(TOPIC, N_("Gear by measurement"))
    page.section("Given")
    page.given(number_of_teeth=keys.number_of_teeth)
    return _by_pins(page, keys, pins[0]) if pins else _by_spans(page, keys)


def _needed(keys: IdentifyKeys, key: str, other: str) -> float:
    """What a key gives that this way of measuring needs; ``other``: a key of the other way."""
    if (value := getattr(keys, key)) is None:
        raise ParameterError(key, None, "give_it_or", other=other)
    return float(value)


def _by_spans(page: Sheet, keys: IdentifyKeys) -> Sheet:
    """Base pitch, pressure angle and module by two spans, the shift by the first."""
    teeth, span, more = (_needed(keys, key, "over_pins") for key in ("teeth_spanned", "span", "next_span"))
    spanned = int(teeth)
    helix, pitch = math.radians(keys.helix_angle_deg), more - span
    if pitch <= 0:
        raise ParameterError("next_span", more, "not_above_span", span=span)
    if spanned >= keys.number_of_teeth:
        most = Nearest(keys.number_of_teeth - 1, "at_most")
        raise ParameterError("teeth_spanned", spanned, "span_beyond_teeth", most, teeth=keys.number_of_teeth)
    check_not_in_vain(keys, ("pin_diameter",), "over_pins")
    angles = ANGLES if keys.pressure_angle_deg is None else (keys.pressure_angle_deg,)
    told = matches(pitch, [math.radians(a) for a in angles], keys.module)
    found = by_span(told, span, spanned, keys.number_of_teeth, helix)
    # of those that fit the pitch the first whose teeth are as high as teeth are
    found.sort(key=lambda row: abs(row[0].deviation) > FITS or not _usual(*_coefficients(keys, row[0], helix, row[1])))
    match, shift = found[0]
    page.given(teeth_spanned=spanned, span=span, next_span=more)
    page.given(tip_diameter=keys.tip_diameter, root_diameter=keys.root_diameter)
    if helix:
        page.add("helix_angle_deg", keys.helix_angle_deg, given=True)
    page.section(N_("Module and pressure angle"))
    page.add("base_pitch", pitch, "{W_1} - {W}", "ISO 21771", symbol="p_bn" if helix else "")
    page.add("pressure_angle_deg", math.degrees(match.pressure_angle), symbol="α_n" if helix else "", key="alpha_n")
    page.add("module_by_pitch", pitch / (math.pi * math.cos(match.pressure_angle)), "{p_b} / (pi * cos({alpha_n}))")
    page.add("module", match.module, "", match.row, symbol="m_n" if helix else "")
    page.add("diametral_pitch", INCH / match.module, f"{INCH} / {{m}}")
    page.add("pitch_difference_percent", 100 * match.deviation, "100 * ({m_b} / {m} - 1)")
    _shift(page, keys, more, match, helix, shift)
    _heights(page, keys, match, helix, shift)
    page.tables.append(_table(keys, helix, found))
    _remarks(page, keys, spanned, found)
    return page


def _by_pins(page: Sheet, keys: IdentifyKeys, key: str) -> Sheet:
    """The shift by a size over pins, of a ring between them, where module and pressure angle are known."""
    ring, helix = key == "between_pins", math.radians(keys.helix_angle_deg)
    module, size = _needed(keys, "module", "span"), _needed(keys, key, "span")
    pin = _needed(keys, "pin_diameter", "span")
    match = Match(math.radians(keys.pressure_angle_deg or ANGLES[0]), module, 0.0, "")
    page.add(key, size, given=True)
    page.given(pin_diameter=pin, tip_diameter=keys.tip_diameter, root_diameter=keys.root_diameter)
    page.add("module", module, symbol="m_n" if helix else "", given=True)
    angle = math.degrees(match.pressure_angle)
    page.add("pressure_angle_deg", angle, symbol="α_n" if helix else "", key="alpha_n", given=True)
    if helix:
        page.add("helix_angle_deg", keys.helix_angle_deg, given=True)
    transverse = _reference(page, keys, match, helix)
    base = module * keys.number_of_teeth / math.cos(helix) * math.cos(transverse)
    centres = pin_centres(size, -pin if ring else pin, keys.number_of_teeth)
    if not centres > base:
        raise ParameterError(key, size, "pin_falls_through")
    sign, other = ("+", "-") if ring else ("-", "+")
    across = f"{{M}} {sign} {{D}}"
    formula = f"({across}) / cos(pi / (2 * {{z}}))" if keys.number_of_teeth % 2 else across
    page.add("pin_centre_diameter", centres, formula, "ISO 21771")
    page.add("pin_centre_angle_deg", math.degrees(math.acos(base / centres)), "arccos({d_b} / {d_D})", "ISO 21771")
    shift = shift_of_pins(centres, -pin if ring else pin, keys.number_of_teeth, match, helix)
    polar = "{z} * (inv({alpha_D}) - inv({alpha}))"
    formula = f"({polar} {sign} {{D}} / ({{m}} * cos({{alpha_n}})) {other} pi / 2) / (2 * tan({{alpha_n}}))"
    page.add("profile_shift_coefficient", shift, formula, "ISO 21771", symbol="x_n" if helix else "")
    _heights(page, keys, match, helix, shift, -1 if ring else 1)
    if abs(2 * shift * math.tan(match.pressure_angle)) >= math.pi / 2:
        page.note(
            "no gear has such a shift, its tooth or space would be none: another module, or count the teeth again"
        )
        return page
    _told(page, keys, match, shift, "more" if ring else "less")
    return page


def _reference(page: Sheet, keys: IdentifyKeys, match: Match, helix: float) -> float:
    """The transverse pressure angle with which the section of the shift begins, reference and base diameter."""
    transverse = transverse_angle(match.pressure_angle, helix)
    page.section("Profile shift")
    if helix:
        angle = math.degrees(transverse)
        page.add("transverse_pressure_angle_deg", angle, "arctan(tan({alpha_n}) / cos({beta}))", "ISO 21771")
    else:
        page.name("alpha", "alpha_n")
    reference = match.module * keys.number_of_teeth / math.cos(helix)
    page.add("reference_diameter", reference, "{m} * {z} / cos({beta})" if helix else "{m} * {z}", "ISO 21771")
    page.add("base_diameter", reference * math.cos(transverse), "{d} * cos({alpha})", "ISO 21771")
    return transverse


def _shift(page: Sheet, keys: IdentifyKeys, more: float, match: Match, helix: float, shift: float) -> None:
    """The profile ``shift``, and where the faces of the calliper touch; ``more``: the span over one tooth more."""
    transverse = _reference(page, keys, match, helix)
    arc = "pi * ({k} - 0.5) + {z} * inv({alpha})"
    formula = f"({{W}} / ({{m}} * cos({{alpha_n}})) - ({arc})) / (2 * tan({{alpha_n}}))"
    page.add("profile_shift_coefficient", shift, formula, "ISO 21771", symbol="x_n" if helix else "")
    base = match.module * keys.number_of_teeth / math.cos(helix) * math.cos(transverse)
    across = math.cos(base_helix_angle(transverse, helix))
    touched = math.hypot(base, more * across)
    page.add("span_contact_diameter", touched, "" if helix else "sqrt({d_b}**2 + {W_1}**2)", "ISO 21771")
    if keys.tip_diameter is not None and touched > keys.tip_diameter:
        page.note("the span over k + 1 teeth does not touch the involutes: measure over fewer teeth")


def _heights(page: Sheet, keys: IdentifyKeys, match: Match, helix: float, shift: float, sign: int = 1) -> None:
    """The heights of the tooth in modules, of the diameters that were measured; ``sign``: -1 of a ring."""
    addendum, dedendum = _coefficients(keys, match, helix, shift, sign)
    if addendum is None and dedendum is None:
        return
    page.section(N_("Heights of the tooth"))
    if addendum is not None:
        formula = "({d_a} - {d}) / (2 * {m}) - {x}" if sign > 0 else "({d} - {d_a}) / (2 * {m}) + {x}"
        page.add("addendum_coefficient", addendum, formula)
    if dedendum is not None:
        formula = "({d} - {d_f}) / (2 * {m}) + {x}" if sign > 0 else "({d_f} - {d}) / (2 * {m}) - {x}"
        page.add("dedendum_coefficient", dedendum, formula)


def _coefficients(
    keys: IdentifyKeys, match: Match, helix: float, shift: float, sign: int = 1
) -> tuple[float | None, float | None]:
    """Addendum and dedendum in modules, of the diameters that were measured; ``sign``: -1 of a ring."""
    reference = match.module * keys.number_of_teeth / math.cos(helix)
    tip, root = keys.tip_diameter, keys.root_diameter
    return (
        None if tip is None else sign * ((tip - reference) / (2 * match.module) - shift),
        None if root is None else sign * ((reference - root) / (2 * match.module) + shift),
    )


def _usual(addendum: float | None, dedendum: float | None) -> bool:
    """Whether teeth are cut so high, by what is known of them."""
    pairs = (addendum, _ADDENDA), (dedendum, _DEDENDA)
    return all(height is None or low <= height <= high for height, (low, high) in pairs)


def _table(keys: IdentifyKeys, helix: float, found: list[tuple[Match, float]]) -> Table:
    rows = [
        (math.degrees(m.pressure_angle), m.module, INCH / m.module, 100 * m.deviation, x,
         *(height for height in _coefficients(keys, m, helix, x) if height is not None))
        for m, x in found[:_ROWS]
    ]  # fmt: skip
    measured = (("h_a*", keys.tip_diameter), ("h_f*", keys.root_diameter))
    heads = (("α", "deg"), ("m", "mm"), ("P_d", "1/in"), ("Δ", "%"), ("x", ""),
             *((symbol, "") for symbol, known in measured if known is not None))  # fmt: skip
    return table_of("modules", N_("Pressure angles and modules, what fits first"), heads, rows)


def _remarks(page: Sheet, keys: IdentifyKeys, spanned: int, found: list[tuple[Match, float]]) -> None:
    """What is not certain, and how a scene has the gear."""
    (match, shift), *others = found
    if abs(match.deviation) > FITS:
        page.note("no module of a row is within 1 % of what was measured: module tells one of your own")
    elif any(abs(other.deviation) <= FITS for other, _ in others):
        page.note("more than one fits within 1 %: pressure_angle_deg or module tells which")
    # by so much less is the shift with a tooth more: a tooth or a space as wide as the pitch is none
    step = math.pi / (2 * math.tan(match.pressure_angle))
    if (missed := round(shift / step)) and spanned + missed >= 1:
        other = {"spanned": spanned + missed, "shift": round(shift - missed * step, 4)}
        page.note(
            "no gear has such a shift, its tooth or space would be none: count the teeth of both spans again, "
            "teeth_spanned = {spanned} gives {shift}",
            **other,
        )
        return
    _told(page, keys, match, shift)


def _told(page: Sheet, keys: IdentifyKeys, match: Match, shift: float, off: str = "less") -> None:
    """What thinning hides, and how a scene has the gear."""
    if off == "less":
        page.note("teeth thinned for backlash give less shift than they were cut with")
    else:
        page.note("teeth of a ring thinned for backlash give more shift than they were cut with")
    words = {"module": match.module, "number_of_teeth": keys.number_of_teeth,
             "pressure_angle_deg": math.degrees(match.pressure_angle), "helix_angle_deg": keys.helix_angle_deg,
             "profile_shift_coefficient": round(shift, 4), "tip_diameter": keys.tip_diameter}  # fmt: skip
    told = (f"{key} = {value:.12g}" for key, value in words.items() if value)
    page.notes.append(message("in a scene: {keys}", keys=", ".join(told)))

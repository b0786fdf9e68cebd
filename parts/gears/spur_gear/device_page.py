"""``higherpair calc tmm42``: the sheet of lesson 1, tables 1.1 and 1.2, by formula and measured off the exact profile.

The device TMM-42 draws a gear by a rack's successive positions: its module, its angle and the reference diameter of
the paper disk are given; the zero wheel and the shifted wheel follow.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, Any

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.record import replace
from geometry.gears.pictures.readings import ProfileReadings, profile_readings
from geometry.gears.teeth import limits, measurement
from geometry.gears.teeth.limits import checked_gear, practicum_undercut
from geometry.gears.teeth.spur import SpurGear
from parts.base.refusal import REMOVED, SceneError
from parts.base.texts import N_
from parts.gears.spur_gear.page import greatest_shift, least_tip_step, rule_formula
from parts.gears.spur_gear.part import SpurGearSpec, checked_spur_gear
from parts.keys.base import in_modules, mm
from parts.keys.cutter import PressureAngle
from parts.pages.inputs import PLACE, SceneKeys, checked, part_of_kind, refusal
from parts.pages.page import Sheet

TOPIC = "tmm42"
_MEASURED = (
    "what you measured on your own disk, by the symbols of the page: measured.S_t1=15.5 measured.e_t1=15.8 of the zero "
    "wheel, measured.S_b2=18.8 of the shifted one"
)
_OnPaper = Annotated[float, Meta(ge=0, le=100_000, extra={"unit": "mm"})]
# mm: loss of the involute that its four decimals show
_SEEN = 0.001
# what is read off a profile, by its symbol
_READINGS = ("S_t", "e_t", "P_t", "S_b", "S_a", "d_Ff")
_SOURCES = {1: "practicum, table 1.1", 2: "practicum, table 1.2"}

_PROFILE_SHIFT_COEFFICIENT = in_modules("shift of the second wheel; default (17 - z) / 17", least=-3, most=3)


class Tmm42Keys(Struct, forbid_unknown_fields=True):
    """Keys of the topic: what stands on the device's rack and disk."""

    module: Annotated[float, mm("module of the device's rack", least=0.01, most=1000)]
    reference_diameter: Annotated[float, mm("reference diameter of the disk", above=0, most=100_000)] | None = None
    number_of_teeth: Annotated[int, Meta(ge=3, le=10_000, description="number of teeth, d / m")] | None = None
    pressure_angle_deg: PressureAngle = 20.0
    profile_shift_coefficient: Annotated[float, _PROFILE_SHIFT_COEFFICIENT] | None = None
    measured: Annotated[dict[str, _OnPaper], Meta(description=_MEASURED)] | None = None


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a part of a scene that the device knows, changed by those of the command line."""
    wanted = {"part": _part(scene, table.pop("part", None))}
    part = part_of_kind("spur_gear")(scene, source, wanted)
    known = {
        k: part[k]
        for k in ("module", "number_of_teeth", "pressure_angle_deg", "profile_shift_coefficient")
        if k in part
    }
    if not known.get("profile_shift_coefficient"):
        known.pop("profile_shift_coefficient", None)
    return known | table


def _part(scene: SceneKeys, wanted: str | None) -> str | None:
    """The part asked for; of several wheels of one disk the one with the greatest shift, which has both tables."""
    gears = {key: spec for key, spec in scene.parts.items() if isinstance(spec, SpurGearSpec)}
    if wanted is None and gears and len({(g.module, g.number_of_teeth) for g in gears.values()}) == 1:
        return max(gears, key=lambda key: abs(gears[key].profile_shift_coefficient))
    return wanted


def sheet(table: dict[str, Any], *, zero_only: bool = False) -> Sheet:
    """The calculation of both wheels, or of the zero wheel alone."""
    keys: Tmm42Keys = checked(table, Tmm42Keys, TOPIC)
    teeth = _teeth(keys)
    try:
        zero, shifted, rule = _wheels(keys, teeth)
    except ParameterError as error:
        raise refusal(TOPIC, error, keys=keys) from error
    page = Sheet(TOPIC, N_("Generating a tooth profile, device TMM-42"))
    page.section("1) Data of the device")
    page.told(module=zero.module, pressure_angle_deg=keys.pressure_angle_deg)
    page.add("reference_diameter", 2 * zero.reference_radius)
    shifted = zero if zero_only else shifted
    page.add("disk_diameter", 2 * max(zero.tip_radius, shifted.tip_radius))
    _zero_wheel(page, zero)
    _measured(page, zero, 1)
    if not zero_only:
        _shifted_wheel(page, shifted, keys.profile_shift_coefficient is not None, rule)
        _measured(page, shifted, 2)
        _compared(page)
    try:
        _students(page, keys.measured or {})
    except ParameterError as error:
        raise refusal(TOPIC, error, keys=keys) from error
    _conditions(page, zero, shifted)
    return page


def _wheels(keys: Tmm42Keys, teeth: int) -> tuple[SpurGear, SpurGear, float]:
    """The zero wheel, the shifted one, and the shift of (1.2)."""
    spec = SpurGearSpec(module=keys.module, number_of_teeth=teeth, pressure_angle_deg=keys.pressure_angle_deg)
    zero = checked_spur_gear(spec)
    rule = practicum_undercut(zero).limit
    shift = max(rule, 0.0) if keys.profile_shift_coefficient is None else keys.profile_shift_coefficient
    if not -zero.rack.addendum < shift < zero.rack.dedendum:
        low, high = -zero.rack.addendum, zero.rack.dedendum
        cure = limit(high - 1e-4, shift) if shift > 0 else limit(low + 1e-4, shift)
        raise ParameterError("profile_shift_coefficient", shift, "reference_circle_leaves_teeth", cure)
    return zero, checked_gear(replace(zero, profile_shift_coefficient=shift)), rule


def _teeth(keys: Tmm42Keys) -> int:
    """Z = d / m, which must be a whole number."""
    if keys.reference_diameter is None:
        if keys.number_of_teeth is None:
            raise SceneError(PLACE, f"{TOPIC}.reference_diameter", None, "give_it_or", other="number_of_teeth")
        return keys.number_of_teeth
    teeth = round(keys.reference_diameter / keys.module)
    if abs(teeth * keys.module - keys.reference_diameter) > 1e-9 * keys.reference_diameter or teeth < 3:
        works = Nearest(max(teeth, 3) * keys.module)
        place = f"{TOPIC}.reference_diameter"
        raise SceneError(PLACE, place, keys.reference_diameter, "no_whole_modules", works, unit="mm")
    if keys.number_of_teeth not in (None, teeth):
        place, other = f"{TOPIC}.number_of_teeth", "reference_diameter"
        raise SceneError(PLACE, place, keys.number_of_teeth, "teeth_of_disk", REMOVED, teeth=teeth, other=other)
    return teeth


def _zero_wheel(page: Sheet, gear: SpurGear) -> None:
    page.section("2) Zero wheel, x = 0: table 1.1")
    page.add("number_of_teeth", gear.number_of_teeth, "{d} / {m}", _SOURCES[1])
    page.add("base_diameter", 2 * gear.base_radius, "{d} * cos({alpha})", _SOURCES[1])
    page.add("pitch", math.pi * gear.module, "pi * {m}", _SOURCES[1])
    page.add("reference_thickness", gear.reference_thickness, "0.5 * {p}", _SOURCES[1], 1)
    formula = "{d_b} * ({S1} / {d} + inv({alpha}))"
    page.add("base_thickness", measurement.base_thickness(gear), formula, "ISO 21771", 1)


def _shifted_wheel(page: Sheet, gear: SpurGear, is_given: bool, rule: float) -> None:
    page.section("3) Shifted wheel: table 1.2")
    formula = rule_formula(gear) if not is_given and rule >= 0 else ""
    page.add("profile_shift_coefficient", gear.profile_shift_coefficient, formula, _SOURCES[2], symbol="ξ")
    page.add("profile_shift", gear.profile_shift_coefficient * gear.module, "{x} * {m}", _SOURCES[2])
    formula = "0.5 * {p} + 2 * {X} * tan({alpha})"
    page.add("reference_thickness", gear.reference_thickness, formula, _SOURCES[2], 2)
    formula = "{d_b} * ({S2} / {d} + inv({alpha}))"
    page.add("base_thickness", measurement.base_thickness(gear), formula, "ISO 21771", 2)
    if rule < 0 and not is_given:
        teeth = limits.rule_teeth(gear)
        page.note(N_("{teeth} teeth and more need no shift: both wheels are the same"), teeth=teeth)


def _measured(page: Sheet, gear: SpurGear, index: int) -> None:
    """What a ruler finds on the generated profile, arcs."""
    page.section("Measured off the generated profile, wheel {number}", number=index)
    found: ProfileReadings = profile_readings(gear, gear.reference_radius)
    source = _SOURCES[index]
    page.add("measured_thickness", found.thickness, "", source, index)
    page.add("measured_space_width", found.space_width, "", source, index)
    page.add("measured_pitch", found.thickness + found.space_width, "{S_t#} + {e_t#}", source, index)
    if gear.root_radius < gear.base_radius:
        page.add("measured_base_thickness", profile_readings(gear, gear.base_radius).thickness, "", source, index)
    page.add("measured_tip_thickness", profile_readings(gear, gear.tip_radius).thickness, "", "practicum (1.3)", index)
    page.add("measured_form_diameter", limits.root_form_diameter(gear), "", "practicum, fig. 1.5", index)


def _compared(page: Sheet) -> None:
    """Part 4 of the form: what the shift has changed on the profile."""
    rows = []
    for name in _READINGS:
        if f"{name}1" in page.by_symbol and f"{name}2" in page.by_symbol:
            zero, shifted = (float(page.by_symbol[f"{name}{wheel}"].value) for wheel in (1, 2))
            rows.append((name, zero, shifted, shifted - zero))
    heads = ((N_("quantity"), ""), (N_("zero wheel"), "mm"), (N_("shifted wheel"), "mm"), (N_("difference"), "mm"))
    page.table("comparison", N_("4) Comparison of the zero and the shifted wheel"), heads, rows)


def _students(page: Sheet, measured: Mapping[str, float]) -> None:
    """What a student measured on a disk, and S_t + e_t of it, beside the generated profile."""
    known = [f"{name}{wheel}" for wheel in (1, 2) for name in _READINGS if f"{name}{wheel}" in page.by_symbol]
    for name, length in measured.items():
        if name not in known:
            raise ParameterError(f"measured.{name}", length, "no_such_name", None, known=known)
    found = dict(measured)
    for wheel in (1, 2):
        parts = f"S_t{wheel}", f"e_t{wheel}"
        if measured.keys() >= {*parts}:
            found.setdefault(f"P_t{wheel}", sum(measured[part] for part in parts))
    exact = {name: float(page.by_symbol[name].value) for name in known if name in found}
    rows = ((name, found[name], right, found[name] - right, 100 * (found[name] / right - 1))
            for name, right in exact.items())  # fmt: skip
    heads = ((N_("quantity"), ""), (N_("measured"), "mm"), (N_("on the profile"), "mm"), (N_("difference"), "mm"),
             (N_("relative difference"), "%"))  # fmt: skip
    if found:
        page.table("measured", N_("Measured on your own disk"), heads, rows)


def _conditions(page: Sheet, zero: SpurGear, shifted: SpurGear) -> None:
    page.section("Conditions")
    page.add("least_shift_without_undercut", limits.least_shift_without_undercut(zero), "", "ISO 21771")
    least_tip_step(page, zero.module)
    greatest = greatest_shift(zero)
    if greatest is not None:
        page.add("greatest_shift_for_tip_thickness", greatest, "", "practicum (1.3)")
    page.note("practicum (1.3) prints x_0.3 <= x <= x_min; right is x_min <= x <= x_0.3")
    undercut = (
        N_("zero wheel: the foot is undercut, the involute begins {lost:.4f} mm above the base circle"),
        N_("shifted wheel: the foot is undercut, the involute begins {lost:.4f} mm above the base circle"),
    )
    pointed = (
        N_("zero wheel: the tip is thinner than 0.3 m"),
        N_("shifted wheel: the tip is thinner than 0.3 m"),
    )
    for index, gear in enumerate((zero,) if shifted is zero else (zero, shifted)):
        if limits.undercut(gear).margin < 0:
            lost = limits.root_form_diameter(gear) / 2 - gear.base_radius
            if lost < _SEEN:
                slight = N_(
                    "x = {x:.4f} is less than x_min = {least:.4f}, exactly: the foot is undercut by less than 0.001 mm"
                )
                least = limits.least_shift_without_undercut(gear)
                page.note(slight, x=gear.profile_shift_coefficient, least=least)
            else:
                page.note(undercut[index], lost=lost)
        if limits.thin_tips(gear):
            page.note(pointed[index])

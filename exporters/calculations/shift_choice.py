"""``higherpair calc shift-choice``: shifts by the tables, by GOST 16532, and inside the blocking contour."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any

from msgspec import Meta, Struct

from exporters.calculations import gear_pair, internal_shift_choice
from exporters.calculations.contour_files import checked_picture, contour_data, contour_pictures
from exporters.calculations.inputs import PLACE, checked, refusal
from exporters.calculations.internal_shift_choice import RACKS
from exporters.calculations.sheet import Printed, Sheet
from geometry.errors import ParameterError, at_most
from geometry.gears import shift_tables
from geometry.gears.blocking_contour import (
    Requirements,
    ShiftPair,
    blocking_contour,
    least_shift,
    margins,
    state_of,
    usual_box,
)
from geometry.gears.shift_choice import shift_sum_for_distance
from geometry.gears.shift_finder import Proposal, for_sum, greatest_contact_ratio, least_wear, proposal
from geometry.gears.spur import SpurGear
from parts.cutter_keys import PressureAngle
from parts.keys import in_modules, mm
from parts.schema import SceneError, near
from parts.spur_gear import RackTable, SpurGearSpec, gear_of

TOPIC = "shift-choice"
_KINDS = ("external_gear_pair", internal_shift_choice.KIND)


class Teeth(Struct, forbid_unknown_fields=True):
    """What the topic needs of one gear."""

    number_of_teeth: Annotated[int, Meta(ge=3, le=1000, description="number of teeth z")]


class ShiftChoiceKeys(Struct, forbid_unknown_fields=True):
    """Keys of the topic."""

    first: Teeth
    second: Teeth
    module: Annotated[float, mm("module, for a centre distance", least=0.01, most=1000)] = 1.0
    pressure_angle_deg: PressureAngle = 20.0
    basic_rack: str | RackTable = "ISO 53 A"
    working_centre_distance: Annotated[float, mm("wanted centre distance", above=0, most=100_000)] | None = None
    least_contact_ratio: Annotated[float, Meta(ge=0.5, le=3, description="contact ratio to keep")] = 1.1
    least_tip_thickness: Annotated[float, in_modules("tip thickness to keep", least=0, most=1)] = 0.3
    allow_undercut: Annotated[bool, Meta(description="undercut that stays below the active flank is legal")] = False
    pole_inside: Annotated[bool, Meta(description="the pole must lie inside the active line of action")] = False
    shortened_tips: Annotated[bool, Meta(description="tips shortened by x1 + x2 - y")] = True
    picture: Annotated[str, Meta(description="SVG or DXF file of the contour to write")] | None = None


@dataclass(frozen=True, slots=True)
class Choice:
    """Shifts of one rule: words in both languages, the source, and a misprint that was mended."""

    en: str
    uk: str
    source: str
    found: Proposal
    printed: Printed | None = None


def table_from(scene: Any, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a mate of a scene that matter here, changed by those of the command line."""
    pair = gear_pair.table_from(scene, source, {k: table.pop(k) for k in ("mate",) if k in table})
    first, kind = pair["first"], pair.get("kind", "external_gear_pair")
    if kind == internal_shift_choice.KIND:
        return internal_shift_choice.table_from(pair, table, source)
    if kind not in _KINDS:
        remedy = "shifts are chosen for external and internal pairs only; give mate = the number of one"
        raise SceneError(source, "mate", kind, remedy)
    if any(pair[name].get("helix_angle_deg") for name in gear_pair.GEARS):
        angle = first.get("helix_angle_deg", 0.0)
        raise SceneError(source, "helix_angle_deg", angle, "shifts are chosen for spur gears only; 0 works")
    known = {k: first[k] for k in ("module", "pressure_angle_deg", "basic_rack") if k in first}
    teeth = {name: {"number_of_teeth": pair[name]["number_of_teeth"]} for name in gear_pair.GEARS}
    return {**known, **teeth, **table}


def sheet(table: dict[str, Any]) -> Sheet:
    """The choices and the contour, by the kind of pair."""
    kind = table.pop("kind", "external_gear_pair")
    if kind not in _KINDS:
        remedy = f"unknown kind of pair{near(str(kind), _KINDS)}; known: {', '.join(_KINDS)}"
        raise SceneError(PLACE, f"{TOPIC}.kind", kind, remedy)
    if kind == internal_shift_choice.KIND:
        return internal_shift_choice.internal_sheet(table)
    keys: ShiftChoiceKeys = checked(table, ShiftChoiceKeys, TOPIC)
    checked_picture(TOPIC, keys.picture)
    if isinstance(keys.basic_rack, str) and keys.basic_rack not in RACKS:
        raise SceneError(PLACE, f"{TOPIC}.basic_rack", keys.basic_rack, f"must be one of {', '.join(RACKS)}")
    try:
        gear = gear_of(
            SpurGearSpec(
                keys.module,
                keys.first.number_of_teeth,
                pressure_angle_deg=keys.pressure_angle_deg,
                basic_rack=keys.basic_rack,  # type: ignore[arg-type]
            )
        )
        pair = ShiftPair(gear.number_of_teeth, keys.second.number_of_teeth, gear.rack, keys.shortened_tips)
        wish = Requirements(keys.least_tip_thickness, keys.least_contact_ratio, keys.allow_undercut, keys.pole_inside)
        return _page(keys, pair, wish)
    except ParameterError as error:
        raise refusal(TOPIC, error) from error


def _page(keys: ShiftChoiceKeys, pair: ShiftPair, wish: Requirements) -> Sheet:
    page = Sheet(TOPIC, ("Choice of profile shifts", "Вибір коефіцієнтів зміщення"))
    page.section("Given", "Вихідні дані")
    page.both("number_of_teeth", pair.teeth)
    page.add("gear_ratio", pair.gear_ratio, "{z2} / {z1}", "practicum (3.2)")
    page.add("module", keys.module)
    page.add("pressure_angle_deg", math.degrees(pair.rack.pressure_angle))
    page.add("addendum_coefficient", pair.rack.addendum)
    page.add("tip_clearance_coefficient", pair.rack.tip_clearance)
    page.add("tip_radius_coefficient", pair.rack.tip_radius)
    page.add("required_contact_ratio", wish.contact_ratio, "", "practicum 1")
    page.add("required_tip_thickness", wish.tip_thickness, "", "practicum (1.3)")
    least = (least_shift(pair, 0), least_shift(pair, 1))
    formula = "({h_a} + {c} - {rho_f} * (1 - sin({alpha}))) - {z#} * sin({alpha})**2 / 2"
    page.both("least_shift_without_undercut", least, formula, ("ISO 21771", "ISO 21771"))
    choices = [*_table_choices(page, pair, wish), *_found_choices(page, keys, pair, wish)]
    for number, choice in enumerate(choices, 1):
        _choice(page, pair, wish, choice, number)
    box = usual_box(pair)
    if box is None:
        page.notes.append(("no shifts give a pair that turns", "жодні зміщення не дають працездатної пари"))
        return page
    contour = blocking_contour(pair, wish, box)
    marks = [(c.en, c.uk, (c.found.first, c.found.second)) for c in choices]
    contour_pictures(page, contour, marks, keys.picture)
    page.data["choices"] = [contour_data(c.en, c.source, c.found) for c in choices]
    return page


def _table_choices(page: Sheet, pair: ShiftPair, wish: Requirements) -> list[Choice]:
    """Kudryavtsev, the guidelines and GOST 16532; a table that lacks the pair is a remark."""
    z1, z2 = pair.teeth
    found = []
    for function, en, uk, name in (
        (shift_tables.kudryavtsev, "Kudryavtsev", "за В. Н. Кудрявцевим", "practicum"),
        (shift_tables.guidelines, "least wear by table 2.1", "найменше стирання за табл. 2.1", "guidelines"),
    ):
        try:
            shifts = function(z1, z2)
        except ParameterError as error:
            page.notes.append((f"{en}: {error.allowed}", f"{uk}: немає пари {z1}/{z2} у таблиці"))
            continue
        source = f"{name}, table {shifts.table}"
        found.append(Choice(en, uk, source, proposal(pair, wish, shifts.first, shifts.second), _mending(shifts)))
    for kinematic, en, uk in (
        (False, "GOST 16532, power drive", "ГОСТ 16532, силова передача"),
        (True, "GOST 16532, kinematic drive", "ГОСТ 16532, кінематична передача"),
    ):
        try:
            for shifts in shift_tables.gost_16532(z1, z2, kinematic=kinematic):
                found.append(Choice(en, uk, "GOST 16532-70", proposal(pair, wish, shifts.first, shifts.second)))
        except ParameterError as error:
            page.notes.append((f"{en}: {error.allowed}", f"{uk}: рекомендації немає"))
    return found


def _mending(shifts: shift_tables.TableShift) -> Printed | None:
    if shifts.mended is None:
        return None
    text = " / ".join(f"{v:.3f}" for v in shifts.mended.printed)
    return Printed(text, "the table's own Δy and its neighbours show the misprint", "помилку видно з Δy і сусідів")


def _found_choices(page: Sheet, keys: ShiftChoiceKeys, pair: ShiftPair, wish: Requirements) -> list[Choice]:
    """What the finder proposes inside the contour."""
    proposals = [
        ("least wear: equal sliding", "найменше стирання: однакове ковзання", least_wear(pair, wish)),
        ("greatest contact ratio", "найбільший коефіцієнт перекриття", greatest_contact_ratio(pair, wish)),
    ]
    if keys.working_centre_distance is not None:
        one, two = (SpurGear(keys.module, z, pair.rack) for z in pair.teeth)
        total = shift_sum_for_distance(one, two, keys.working_centre_distance)
        name = f"a_w = {keys.working_centre_distance:g} mm"
        found = for_sum(pair, wish, total)
        proposals.append((name, name.replace("mm", "мм"), found))
        if found is None:
            _explain_sum(page, pair, wish, total)
    result = []
    for en, uk, found in proposals:
        if found is None:
            page.notes.append(
                (
                    f"{en}: no shifts keep all requirements; less least_contact_ratio or least_tip_thickness may work",
                    f"{uk}: усіх умов не виконати; зменшіть least_contact_ratio або least_tip_thickness",
                )
            )
        else:
            result.append(Choice(en, uk, "", found))
    return result


def _explain_sum(page: Sheet, pair: ShiftPair, wish: Requirements, total: float) -> None:
    """Which limit a centre distance breaks when its shifts are split for equal tips."""
    broken = [m for m in margins(pair, wish, total / 2, total / 2) if not m.margin >= 0]
    names = ", ".join(f"{m.name} {at_most(m.margin, 4)}" for m in broken if not math.isnan(m.margin))
    page.notes.append((f"x1 + x2 = {total:.4f}, half each: {names}", f"x1 + x2 = {total:.4f}, порівну: {names}"))


def _choice(page: Sheet, pair: ShiftPair, wish: Requirements, choice: Choice, number: int) -> None:
    """One proposal and what it gives."""
    found = choice.found
    page.section(f"{number}. {choice.en}", f"{number}. {choice.uk}")
    page.add("profile_shift_coefficient", found.first, "", choice.source, 1)
    page.add("profile_shift_coefficient", found.second, "", choice.source, 2)
    if choice.printed is not None:
        page.mark_misprint(choice.printed)
    state = state_of(pair, found.first, found.second)
    if not state.involute >= 0:
        page.notes.append((f"{number}: no working angle", f"{number}: кута зачеплення немає"))
        return
    formula = "2 * ({x1} + {x2}) * tan({alpha}) / ({z1} + {z2}) + inv({alpha})"
    page.add("involute_of_working_pressure_angle", state.involute, formula, "practicum (3.3)")
    angle = math.degrees(state.working_pressure_angle)
    page.add("working_pressure_angle_deg", angle, "arcinv({inv_alpha_w})", "practicum (3.3)")
    formula = "{m} * ({z1} + {z2}) / 2 * cos({alpha}) / cos({alpha_w})"
    module = float(page.known["m"].value)
    page.add("working_centre_distance", state.working_centre_distance * module, formula, "practicum (3.4)")
    page.add("contact_ratio", found.contact_ratio, "", "practicum (3.20)")
    thick = state.tip_thicknesses
    page.both("tip_thickness", (thick[0] * module, thick[1] * module), "", ("practicum (1.3)", "practicum (1.3)"))
    page.both("root_sliding", found.root_sliding, "", ("ISO 21771", "ISO 21771"))
    broken = [m for m in margins(pair, wish, found.first, found.second) if m.margin < -1e-9]
    if broken:
        names = ", ".join(f"{m.name} {m.margin:.4g}" for m in broken)
        page.notes.append((f"{number}: outside the contour: {names}", f"{number}: поза контуром: {names}"))

"""``higherpair calc shift-choice``: shifts by the tables, by GOST 16532, and inside the blocking contour.

Of helical pairs the shifts are normal ones and the contour is that of the transverse section.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, Any

from msgspec import Meta, Struct

from geometry.base.errors import ParameterError, rounded
from geometry.gears.shifts import tables as shift_tables
from geometry.gears.shifts.choice import shift_sum_for_distance
from geometry.gears.shifts.external import (
    Requirements,
    ShiftPair,
    blocking_contour,
    least_shift,
    margins,
    state_of,
    usual_box,
)
from geometry.gears.shifts.finder import for_sum, greatest_contact_ratio, least_wear, proposal
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear, transverse_rack
from parts.base.refusal import SceneError
from parts.base.texts import N_, message
from parts.gears.spur_gear.part import SpurGearSpec, gear_of
from parts.mates.pages import external as gear_pair
from parts.mates.pages import internal_shift_choice
from parts.mates.pages.contour_marks import Choice, checked_picture, margins_told, show_choices, show_given
from parts.mates.pages.internal_shift_choice import refusals
from parts.mates.pages.pair_keys import GEARS, ChoiceKeys, kind_of_pair, section_table
from parts.pages.contact_steps import working_steps
from parts.pages.inputs import SceneKeys, checked, told
from parts.pages.misprints import printed_for_pair
from parts.pages.page import Printed, Sheet

TOPIC = "shift-choice"
OTHER_KINDS = (("second.kind", "ring_gear"),)
_KINDS = ("external_gear_pair", internal_shift_choice.KIND)


class Teeth(Struct, forbid_unknown_fields=True):
    """What the topic needs of one gear."""

    number_of_teeth: Annotated[int, Meta(ge=3, le=1000, description="number of teeth z")]


class ShiftChoiceKeys(ChoiceKeys, forbid_unknown_fields=True, kw_only=True):
    """Keys of the topic."""

    first: Teeth
    second: Teeth
    shortened_tips: Annotated[bool, Meta(description="tips shortened by x1 + x2 - y")] = True


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a mate of a scene that matter here, changed by those of the command line."""
    pair = gear_pair.table_from(scene, source, {k: table.pop(k) for k in ("mate",) if k in table})
    kind = pair.get("kind", "external_gear_pair")
    if kind == internal_shift_choice.KIND:
        return internal_shift_choice.table_from(pair, table)
    if kind not in _KINDS:
        raise SceneError(source, "mate", kind, "shifts_of_gear_pairs")
    known = section_table(pair, table)
    teeth = {name: {"number_of_teeth": pair[name]["number_of_teeth"]} for name in GEARS}
    return {**known, **teeth, **table}


def sheet(table: dict[str, Any]) -> Sheet:
    """The choices and the contour, by the kind of pair."""
    return begun(table)()


def begun(table: dict[str, Any]) -> Callable[[], Sheet]:
    """The same, refused where it is before anything is sought, which takes a hundred times as long."""
    kind, table = kind_of_pair(table, TOPIC, _KINDS)
    if kind == internal_shift_choice.KIND:
        return internal_shift_choice.internal_begun(table)
    keys: ShiftChoiceKeys = checked(table, ShiftChoiceKeys, TOPIC)
    checked_picture(TOPIC, keys.picture)
    wish = Requirements(*keys.kept)
    with refusals(keys):
        z, angle, basic = keys.first.number_of_teeth, keys.pressure_angle_deg, keys.basic_rack
        spec = SpurGearSpec(module=keys.module, number_of_teeth=z, pressure_angle_deg=angle, basic_rack=basic)
        rack = gear_of(spec).rack
        pair = _pair(keys, rack)
        wanted = _wanted_sum(keys, rack, pair)
        page, tables = _started(keys, rack, pair, wish)

    def finished() -> Sheet:
        with refusals(keys):
            choices = [*tables, *_found_choices(page, keys, pair, wish, wanted)]
            for number, choice in enumerate(choices, 1):
                _choice(page, keys.module, pair, wish, choice, number)
            box = usual_box(pair)
            contour = None if box is None else blocking_contour(pair, wish, box)
            show_choices(page, contour, choices, keys.picture)
        return page

    return finished


def _pair(keys: ShiftChoiceKeys, rack: BasicRack) -> ShiftPair:
    """The pair of the transverse section; ``rack`` of the normal one."""
    face, teeth = keys.face, (keys.first.number_of_teeth, keys.second.number_of_teeth)
    angle = face.helix.angle
    section = transverse_rack(rack, angle)
    return ShiftPair(*teeth, section, keys.shortened_tips, angle, face.overlap_ratio if angle else 0.0)


def _wanted_sum(keys: ShiftChoiceKeys, rack: BasicRack, pair: ShiftPair) -> float | None:
    """x1 + x2 that a wanted centre distance asks for."""
    if keys.working_centre_distance is None:
        return None
    one, two = (transverse_gear(SpurGear(keys.module, z, rack), pair.helix_angle) for z in pair.teeth)
    return shift_sum_for_distance(one, two, keys.working_centre_distance) / math.cos(pair.helix_angle)


def _started(keys: ShiftChoiceKeys, rack: BasicRack, pair: ShiftPair, wish: Requirements) -> tuple[Sheet, list[Choice]]:
    """The page as far as nothing is sought, and the choices of tables."""
    page = Sheet(TOPIC, N_("Choice of profile shifts"))
    formula = show_given(page, keys, pair, rack)
    page.add("required_contact_ratio", wish.contact_ratio, "", "practicum 1")
    page.add("required_tip_thickness", wish.tip_thickness, "", "practicum (1.3)")
    symbol = "x_n,min" if pair.helix_angle else ""
    for index in (1, 2):
        least = least_shift(pair, index - 1)
        page.add("least_shift_without_undercut", least, formula, "ISO 21771", index, symbol=symbol)
    if pair.helix_angle:
        page.note("the tables and the recommendations of GOST 16532 are left out: they are of spur gears")
        return page, []
    return page, _table_choices(page, pair, wish)


def _table_choices(page: Sheet, pair: ShiftPair, wish: Requirements) -> list[Choice]:
    """Kudryavtsev, the guidelines and GOST 16532; a table that lacks the pair is a remark."""
    z1, z2 = pair.teeth
    found = []
    for function, rule, name in (
        (shift_tables.kudryavtsev, message("Kudryavtsev"), "practicum"),
        (shift_tables.guidelines, message("least wear by table 2.1"), "guidelines"),
    ):
        try:
            shifts = function(z1, z2)
        except ParameterError as error:
            page.note("{rule}: {why}", rule=rule, why=told(error))
            continue
        source = f"{name}, table {shifts.table}"
        found.append(Choice(rule, proposal(pair, wish, shifts.first, shifts.second), source, _mending(shifts)))
    drives = message("GOST 16532, power drive"), message("GOST 16532, kinematic drive")
    for kinematic, rule in zip((False, True), drives, strict=True):
        try:
            for shifts in shift_tables.gost_16532(z1, z2, kinematic=kinematic):
                found.append(Choice(rule, proposal(pair, wish, shifts.first, shifts.second), "GOST 16532-70"))
        except ParameterError as error:
            page.note("{rule}: {why}", rule=rule, why=told(error))
    return found


def _mending(shifts: shift_tables.TableShift) -> Printed | None:
    if shifts.mended is None:
        return None
    text = " / ".join(f"{v:.3f}" for v in shifts.mended.printed)
    return Printed(text, N_("the table's own Δy and its neighbours show the misprint"))


def _found_choices(
    page: Sheet, keys: ShiftChoiceKeys, pair: ShiftPair, wish: Requirements, total: float | None
) -> list[Choice]:
    """What the finder proposes inside the contour."""
    proposals = [
        (message("least wear: equal sliding"), least_wear(pair, wish)),
        (message("greatest contact ratio"), greatest_contact_ratio(pair, wish)),
    ]
    if total is not None:
        found = for_sum(pair, wish, total)
        proposals.append((message("a_w = {distance:g} mm", distance=keys.working_centre_distance), found))
        if found is None:
            _explain_sum(page, pair, wish, total)
    text = N_("{rule}: no shifts keep all requirements; less least_contact_ratio or least_tip_thickness may work")
    for rule, found in proposals:
        if found is None:
            page.note(text, rule=rule)
    return [Choice(rule, found) for rule, found in proposals if found is not None]


def _explain_sum(page: Sheet, pair: ShiftPair, wish: Requirements, total: float) -> None:
    """Which limit a centre distance breaks when its shifts are split for equal tips."""
    broken = [m for m in margins(pair, wish, total / 2, total / 2) if not m.margin >= 0]
    names = ", ".join(f"{m.name} {rounded(m.margin, up=False):.12g}" for m in broken if not math.isnan(m.margin))
    page.note("x1 + x2 = {total:.4f}, half each: {margins}", total=total, margins=names)


def _choice(page: Sheet, module: float, pair: ShiftPair, wish: Requirements, choice: Choice, number: int) -> None:
    """One proposal and what it gives; ``module``: the normal one, mm."""
    found, helical = choice.found, pair.helix_angle != 0
    page.section("{number}. {rule}", number=number, rule=choice.name)
    shifts = found.first, found.second
    page.printed = {} if helical else printed_for_pair(pair.teeth, shifts, module, pair.rack.pressure_angle)
    sources, symbol = choice.source, "x_n" if helical else ""
    page.both("profile_shift_coefficient", shifts, "", sources, symbol)
    if choice.printed is not None:
        page.mark_misprint(choice.printed)
    state = state_of(pair, found.first, found.second)
    if not state.involute >= 0:
        page.note("{number}: no working angle", number=number)
        return
    angle = math.degrees(state.working_pressure_angle)
    values = state.involute, angle, state.working_centre_distance * module
    working_steps(page, values, internal=False, normal=helical)
    page.add("contact_ratio", found.contact_ratio - pair.overlap_ratio, "", "practicum (3.20)")
    if helical:
        page.add("total_contact_ratio", found.contact_ratio, "{eps} + {eps_beta}", "ISO 21771")
    thick = state.tip_thicknesses
    page.both("tip_thickness", (thick[0] * module, thick[1] * module), "", "practicum (1.3)")
    page.both("root_sliding", found.root_sliding, "", "ISO 21771")
    broken = [m for m in margins(pair, wish, found.first, found.second) if m.margin < -1e-9]
    if broken:
        page.note("{number}: outside the contour: {margins}", number=number, margins=margins_told(broken))

"""``higherpair calc cycloidal-gear``: a gear of clockwork, its limits, and how it runs with its mate."""

from __future__ import annotations

import math
from typing import Annotated, Any

import numpy as np
from msgspec import Meta

from geometry.base.errors import ParameterError
from geometry.gears.cycloidal.gear import CycloidalGear, checked_tips, cycloidal_findings
from geometry.gears.cycloidal.pair import CycloidalPair
from parts.base.texts import N_, message
from parts.gears.cycloidal_gear.part import CYCLOIDAL_GEAR, CycloidalGearSpec
from parts.gears.thinning import shared_thinning
from parts.keys.base import in_modules, mm
from parts.pages.inputs import SceneKeys, calculation, part_of_kind, refusal
from parts.pages.page import Sheet, Table, table_of
from parts.texts.findings import finding_message

TOPIC = "cycloidal-gear"
_own_keys = part_of_kind("cycloidal_gear")
# the key that tells what the mate has
_OF_MATE = {
    "addendum_coefficient": "mate_addendum_coefficient",
    "circumferential_thinning": "mate_circumferential_thinning",
    "tip_rolling_diameter": "root_rolling_diameter",
}
_SOURCE = "Litvin, Fuentes, Gear Geometry, 13"

_MATE_ADDENDUM_COEFFICIENT = in_modules(
    "height of the mate's tips; default: as here", least=0.001, most=10, example=1.0
)
_MATE_CIRCUMFERENTIAL_THINNING = mm("thinning of the mate's teeth, arc of the pitch circle", least=0, most=1000)


class CycloidalGearKeys(CycloidalGearSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the gear, what its mate has of its own, and how long the table is."""

    mate_addendum_coefficient: Annotated[float, _MATE_ADDENDUM_COEFFICIENT] | None = None
    mate_circumferential_thinning: Annotated[float, _MATE_CIRCUMFERENTIAL_THINNING] = 0.0
    rows: Annotated[int, Meta(ge=2, le=2000, description="rows of each table of the flank")] = 9


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a part of a scene as its mate thins it, and the tips of that mate, changed by those of ``table``."""
    part = table.get("part")
    found = _own_keys(scene, source, table)
    for mate in scene.mates:
        if mate.__struct_config__.tag != "cycloidal_gear_pair":
            continue
        first, second, backlash = (getattr(mate, key) for key in ("first", "second", "normal_backlash"))
        ends = [str(scene.instances[key].part) for key in (first, second)]
        # where no part is named there is but one
        if part is None or part in ends:
            own, other = (scene.parts[ends[k]] for k in ((1, 0) if ends[0] != part else (0, 1)))
            assert isinstance(own, CycloidalGearSpec)
            assert isinstance(other, CycloidalGearSpec)
            thinned = [own.circumferential_thinning, other.circumferential_thinning]
            if backlash is not None:
                try:
                    more = shared_thinning(backlash, (own, other), lambda index, thinning: None, 1.0)
                except ParameterError as error:
                    raise refusal(TOPIC, error) from error
                thinned = [mine + added for mine, added in zip(thinned, more, strict=True)]
            if "circumferential_thinning" not in table:
                found["circumferential_thinning"] = thinned[0]
            tips = {
                "mate_number_of_teeth": other.number_of_teeth,
                "mate_addendum_coefficient": other.addendum_coefficient,
                "mate_circumferential_thinning": thinned[1],
            }
            return tips | found
    return found


@calculation(TOPIC, CycloidalGearKeys)
def sheet(keys: CycloidalGearKeys) -> Sheet:
    """The calculation of a gear, and of its contact where the mate's teeth are told."""
    gear = CYCLOIDAL_GEAR.thing(keys, {})
    page = Sheet(TOPIC, N_("Cycloidal gear"))
    gears = [gear] if keys.mate_number_of_teeth is None else [gear, _mate(keys, gear)]
    _given(page, gears)
    _sizes(page, gears)
    _limits(page, gear)
    if len(gears) == 2:
        _contact(page, CycloidalPair(*gears))
    page.tables += [_table(gear, keys.rows, tips=False), _table(gear, keys.rows, tips=True)]
    page.notes += [finding_message(f) for f in cycloidal_findings(gear)]
    return page


def _mate(keys: CycloidalGearKeys, gear: CycloidalGear) -> CycloidalGear:
    """The mate, drawn by the same circles; of it the tips alone count."""
    assert keys.mate_number_of_teeth is not None
    own = keys.mate_addendum_coefficient
    height = gear.addendum_coefficient if own is None else own
    circles = gear.root_rolling_radius, gear.tip_rolling_radius
    try:
        thinning = keys.mate_circumferential_thinning
        mate = CycloidalGear(
            keys.mate_number_of_teeth, gear.module, *circles, height, circumferential_thinning=thinning
        )
        return checked_tips(mate)
    except ParameterError as error:
        if error.code == "root_flanks_undercut":
            key, code = "tip_rolling_diameter", "mates_root_flanks_undercut"
            raise ParameterError(key, error.value, code, error.nearest) from error
        raise error.renamed(_OF_MATE[error.name]) from error


def _given(page: Sheet, gears: list[CycloidalGear]) -> None:
    page.section("Given")
    page.add("module", gears[0].module)
    page.both("number_of_teeth", [gear.number_of_teeth for gear in gears])
    page.both("addendum_coefficient", [gear.addendum_coefficient for gear in gears])
    page.add("dedendum_coefficient", gears[0].dedendum_coefficient, gear=1)
    page.both("circumferential_thinning", [gear.circumferential_thinning for gear in gears])


def _sizes(page: Sheet, gears: list[CycloidalGear]) -> None:
    page.section("Sizes")
    page.add("pitch", gears[0].pitch, "pi * {m}", symbol="p")
    page.both("reference_radius", [gear.pitch_radius for gear in gears], "{m} * {z#} / 2")
    first = gears[0]
    straight = "{r1} / 2" if first.root_rolling_radius == first.pitch_radius / 2 else ""
    mates = "{r2} / 2" if len(gears) == 2 and first.tip_rolling_radius == gears[1].pitch_radius / 2 else ""
    page.add("tip_rolling_radius", first.tip_rolling_radius, mates, _SOURCE if mates else "")
    page.add("root_rolling_radius", first.root_rolling_radius, straight, _SOURCE if straight else "")
    page.both("tip_radius", [gear.tip_radius for gear in gears], "{r#} + {h_a#} * {m}")
    page.add("root_radius", first.root_radius, "{r1} - {h_f1} * {m}", gear=1)
    page.add("reference_thickness", first.tooth_thickness, "{p} / 2 - {A1}", gear=1)
    page.add("root_fillet_radius", first.root_rounding, gear=1)


def _limits(page: Sheet, gear: CycloidalGear) -> None:
    page.section("Limits of the tooth")
    page.add("greatest_root_fillet_radius", gear.greatest_rounding, gear=1)
    page.add("flank_start_radius", gear.form_radius, gear=1)
    page.add("pointed_radius", gear.pointed_radius, gear=1)
    page.add("tip_thickness", gear.tip_thickness, gear=1)


def _contact(page: Sheet, pair: CycloidalPair) -> None:
    gears = pair.first, pair.second
    page.section("Contact, the first gear driving")
    page.add("gear_ratio", gears[1].number_of_teeth / gears[0].number_of_teeth, "{z2} / {z1}")
    page.add("working_centre_distance", pair.centre_distance, "{r1} + {r2}")
    for index, (gear, circle) in enumerate(zip(gears, ("rho_a", "rho_i"), strict=True), 1):
        # the triangle of both centres and the tip
        rho, far = f"{{{circle}}}", f"({{r#}} + {{{circle}}})"
        formula = f"{rho} / {{r#}} * arccos(({far}**2 + {rho}**2 - {{r_a#}}**2) / (2 * {rho} * {far}))"
        page.add("tip_roll_angle_deg", math.degrees(gear.tip_roll), formula, _SOURCE, gear=index)
    page.add("approach_contact_ratio", pair.approach_ratio, "{u_a2} * {z2} / (2 * pi)")
    page.add("recess_contact_ratio", pair.recess_ratio, "{u_a1} * {z1} / (2 * pi)")
    page.add("contact_ratio", pair.contact_ratio, "{eps_1} + {eps_2}", symbol="ε")
    steepest = pair.greatest_pressure_angles
    for index, (angle, circle) in enumerate(zip(steepest, ("rho_a", "rho_i"), strict=True), 1):
        formula = f"{{u_a#}} * {{r#}} / (2 * {{{circle}}})"
        page.add("end_pressure_angle_deg", math.degrees(angle), formula, gear=index)
    page.add("root_contact_radius", pair.contact_radii()[0], gear=1)
    # along the pitch circles, where the flanks are radial
    page.add("normal_backlash", pair.normal_backlash, "{A1} + {A2}")
    page.add("bottom_clearance_at_root", pair.tip_clearances[0], "{a_w} - {r_a2} - {r_f1}", gear=1)
    page.notes += [
        message("the gear and its mate: {what}", what=finding_message(f))
        for f in pair.findings()
        if not f.code.endswith("_second")
    ]


def _table(gear: CycloidalGear, rows: int, *, tips: bool) -> Table:
    """u, radius, and the lower flank of tooth 1 in the gear's frame."""
    if tips:
        flank, u = gear.tip_flank(), np.linspace(0.0, gear.tip_roll, rows)
        name, title = "tip_flank", N_("Flank of the tip, an epicycloid: gear's angle, lower flank of tooth 1")
    else:
        flank = gear.root_flank()
        u = np.linspace(gear.fillet_roll, 0.0, rows)
        name, title = "root_flank", N_("Flank of the root, a hypocycloid: gear's angle, lower flank of tooth 1")
    point = flank.point(u)
    heads = (("u", "deg"), ("r", "mm"), ("x", "mm"), ("y", "mm"))
    columns = np.degrees(u), np.abs(point), point.real, point.imag
    return table_of(name, title, heads, zip(*columns, strict=True))

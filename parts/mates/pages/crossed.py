"""``higherpair calc gear-pair`` of the kind crossed_helical_pair: two helical gears on crossed axes, screw gears."""

from __future__ import annotations

import math
from typing import Annotated, Any

from msgspec import Meta

from geometry.base.errors import ParameterError
from geometry.gears.pairs.crossed import CrossedPair
from parts.base.mate import End
from parts.base.texts import N_
from parts.gears.spur_gear.part import SPUR_GEAR, SpurGearSpec
from parts.keys.base import mm
from parts.mates.crossed import CrossedHelicalPair, CrossedHelicalPairSpec, CrossedMating, ShaftAngle
from parts.mates.pages.pair_keys import GEARS, mate_of, pair_mated, pair_table
from parts.pages.force_steps import DrivenKeys, asked_torque, both_speeds, torque_steps
from parts.pages.inputs import checked, refusal
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "gear-pair"
_SOURCE = "ISO 21771"
# of the path of contact, mm: flanks end where tips do
_WHOLE = 1e-9

_FRICTION_COEFFICIENT = Meta(ge=0, le=1, description="friction of the flanks; without it no losses")


class CrossedKeys(DrivenKeys, forbid_unknown_fields=True, kw_only=True):
    """Keys of two helical gears on crossed axes."""

    first: SpurGearSpec
    second: SpurGearSpec
    working_centre_distance: Annotated[float, mm("wanted centre distance", above=0, most=100_000)] | None = None
    normal_backlash: Annotated[float, mm("wanted normal backlash", least=0, most=1000)] | None = None
    shaft_angle_deg: ShaftAngle | None = None
    friction_coefficient: Annotated[float, _FRICTION_COEFFICIENT] = 0.0


def crossed_sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of a crossed helical pair."""
    keys: CrossedKeys = checked(pair_table(table, CrossedKeys, TOPIC), CrossedKeys, TOPIC)
    try:
        torque = asked_torque(keys)
    except ParameterError as error:
        raise refusal(TOPIC, error, keys=keys) from error
    pair = _pair(keys)
    page = Sheet(TOPIC, N_("Crossed helical pair"))
    _given(page, pair, keys)
    _operating(page, pair, keys)
    meets = keys.shaft_angle_deg is None
    _contact(page, pair, meets=meets)
    if keys.speed_rpm is not None:
        _speeds(page, pair, keys.speed_rpm, meets=meets)
    _losses(page, pair, keys.friction_coefficient, meets=meets)
    if torque is not None:
        _forces(page, pair, keys, torque, meets=meets)
    page.notes += [finding_message(found) for found in pair.findings()]
    return page


def _pair(keys: CrossedKeys) -> CrossedPair:
    """The pair that the keys ask for, thinned for its backlash."""
    ends: dict[str, End[Any]] = {}
    for name in GEARS:
        spec = getattr(keys, name)
        try:
            ends[name] = End(spec, SPUR_GEAR.thing(spec, {}))
        except ParameterError as error:
            raise refusal(TOPIC, error, name, keys) from error
    mate = mate_of(CrossedHelicalPairSpec, keys)
    try:
        CrossedHelicalPair().check(mate, keys.first, keys.second)
        mating = pair_mated(mate, ends["first"], ends["second"])
    except ParameterError as error:
        owner, _, key = error.name.rpartition(".")
        if owner == "mate":
            raise refusal(TOPIC, error.renamed(key), keys=keys) from error
        raise refusal(TOPIC, error.renamed(key), owner or "second", keys) from error
    assert isinstance(mating, CrossedMating)
    return mating.pair


def _given(page: Sheet, pair: CrossedPair, keys: CrossedKeys) -> None:
    page.section("Given")
    page.add("module", pair.normal_module, symbol="m_n")
    page.add("pressure_angle_deg", math.degrees(pair.pressure_angle))
    specs = keys.first, keys.second
    page.both("number_of_teeth", (specs[0].number_of_teeth, specs[1].number_of_teeth))
    one, two = (math.degrees(beta) for beta in pair.helices)
    page.both("helix_angle_deg", (one, two))
    page.both("profile_shift_coefficient", (specs[0].profile_shift_coefficient, specs[1].profile_shift_coefficient))
    page.both("face_width", pair.face_widths)
    if pair.thinning_backlash:
        page.both("circumferential_thinning", _each(pair, "circumferential_thinning"))


def _each(pair: CrossedPair, name: str, factor: float = 1.0) -> tuple[float, float]:
    return factor * getattr(pair.first, name), factor * getattr(pair.second, name)


def _degrees(values: tuple[float, float]) -> tuple[float, float]:
    return math.degrees(values[0]), math.degrees(values[1])


def _operating(page: Sheet, pair: CrossedPair, keys: CrossedKeys) -> None:
    """Cylinders, angles and distance."""
    meets = keys.shaft_angle_deg is None
    page.section("Gears")
    page.add("gear_ratio", pair.ratio, "{z2} / {z1}")
    page.both("transverse_pressure_angle_deg", _degrees(_each(pair, "pressure_angle")),
              "arctan(tan({alpha}) / cos({beta#}))", _SOURCE)  # fmt: skip
    page.both("reference_diameter", _each(pair, "reference_radius", 2), "{m} * {z#} / cos({beta#})", _SOURCE)
    page.both("base_diameter", _each(pair, "base_radius", 2), "{d#} * cos({alpha#})", _SOURCE)
    page.both("base_helix_angle_deg", _degrees(pair.base_helices), "arctan(tan({beta#}) * cos({alpha#}))", _SOURCE)
    page.add("normal_base_pitch", pair.base_pitch, "pi * {m} * cos({alpha})", _SOURCE)
    page.section("Operating pitch cylinders")
    if not meets:
        page.add("shaft_angle_deg", math.degrees(abs(pair.shaft_angle)), given=True)
    page.add("normal_working_pressure_angle_deg", math.degrees(pair.working_pressure_angle))
    page.both("transverse_working_pressure_angle_deg", _degrees(pair.action.angles),
              "arcsin(sin({alpha_wn}) / cos({beta_b#}))")  # fmt: skip
    page.both("working_radius", pair.working_radii, "{d_b#} / (2 * cos({alpha_wt#}))" if meets else "")
    page.both("working_helix_angle_deg", _degrees(pair.working_helices), "arctan(2 * {r_w#} * tan({beta#}) / {d#})")
    if meets:
        page.add("shaft_angle_deg", math.degrees(abs(pair.shaft_angle)), "abs({beta_w1} + {beta_w2})")
    page.add("working_centre_distance", pair.working_centre_distance, "{r_w1} + {r_w2}" if meets else "")
    thinned = "({A1} * cos({beta1}) + {A2} * cos({beta2})) * cos({alpha})"
    by_thinning = keys.working_centre_distance is None and pair.thinning_backlash
    page.add("normal_backlash", pair.normal_backlash, thinned if by_thinning else "")


def _contact(page: Sheet, pair: CrossedPair, *, meets: bool) -> None:
    page.section("Contact")
    page.both("tip_diameter", _each(pair, "tip_radius", 2))
    tangents = " + ".join(f"{{r_w{k}}} * sin({{alpha_wt{k}}}) / cos({{beta_b{k}}})" for k in (1, 2))
    page.add("line_of_action_length", pair.action.length, tangents if meets else "")
    low, high = pair.path
    whole = max(abs(low - pair.tips_path[0]), abs(high - pair.tips_path[1])) < _WHOLE
    whole = whole and all(gear.tip_chamfer == gear.tip_rounding == 0 for gear in pair.gears)
    reach = " + ".join(f"sqrt({{d_a{k}}}**2 - {{d_b{k}}}**2) / (2 * cos({{beta_b{k}}}))" for k in (1, 2))
    page.add("crossed_path", high - low, f"{reach} - {{L}}" if whole else "")
    wide = pair.contact_ratio > pair.path_contact_ratio - _WHOLE
    page.add("contact_ratio", pair.contact_ratio, "{g} / {p_bn}" if wide else "")
    page.both("crossed_face_width", pair.least_face_widths)
    page.both("bottom_clearance_at_root", pair.tip_clearances)


def _speeds(page: Sheet, pair: CrossedPair, speed_rpm: float, *, meets: bool) -> None:
    """Of both gears and of sliding; the first drives."""
    both_speeds(page, (speed_rpm, speed_rpm / pair.ratio))
    speed = math.pi * speed_rpm / 30
    one, two = pair.working_radii
    page.both("working_speed", (speed * one, speed / pair.ratio * two), "pi * {n#} / 30 * {r_w#}")
    formula = "{v_w1} * sin({Sigma}) / cos({beta_w2})" if meets else ""
    page.add("crossed_sliding_speed", speed * pair.sliding(pair.pole), formula)
    page.add("sliding_speed_at_start", speed * pair.sliding(pair.path[0]))
    page.add("sliding_speed_at_end", speed * pair.sliding(pair.path[1]))


def _signs(pair: CrossedPair) -> tuple[str, str]:
    """How friction counts where a gear drives, and where it is driven: by the hands."""
    return ("+", "-") if pair.shaft_angle > 0 else ("-", "+")


def _losses(page: Sheet, pair: CrossedPair, friction: float, *, meets: bool) -> None:
    page.section("Losses")
    page.add("friction_coefficient", friction)
    drives, driven = _signs(pair)
    formula = "(cos({alpha_wn}) %s {f} * tan({beta_w%d})) / (cos({alpha_wn}) %s {f} * tan({beta_w%d}))"
    for name, back, one, two in (("crossed_efficiency", False, 1, 2), ("crossed_back_efficiency", True, 2, 1)):
        worth = pair.efficiency(friction, back=back)
        page.add(name, worth, formula % (driven, two, drives, one) if meets and worth else "")
        if not worth:
            page.note("self-locking: gear {number} cannot drive", number=one)
    for gear, mate in ((1, 2), (2, 1)):
        slope = math.copysign(1.0, pair.shaft_angle) * math.tan(pair.working_helices[mate - 1])
        if meets and slope > 0:
            limit = math.cos(pair.working_pressure_angle) / slope
            formula = f"cos({{alpha_wn}}) / abs(tan({{beta_w{mate}}}))"
            page.add("driving_limit_friction", limit, formula, gear=gear)


def _forces(page: Sheet, pair: CrossedPair, keys: CrossedKeys, torque: float, *, meets: bool) -> None:
    """At the pole; the first gear drives."""
    friction = keys.friction_coefficient
    if not pair.efficiency(friction):
        return
    page.section("Torques and forces")
    torque_steps(page, keys, torque, "gear_torque", 1)
    one, two = pair.forces(friction)
    normal = 1000 * torque / pair.working_radii[0] / one.circumferential
    page.add("gear_torque", torque * pair.ratio * pair.efficiency(friction), "{T1} * {u} * {eta}", gear=2)
    drives, driven = _signs(pair)
    for gear, forces, along, across in ((1, one, drives, driven), (2, two, driven, drives)):
        page.add(
            "circumferential_force", normal * forces.circumferential, f"1000 * {{T{gear}}} / {{r_w{gear}}}", gear=gear
        )
        if gear == 1:
            share = f"(cos({{alpha_wn}}) * cos({{beta_w1}}) {along} {{f}} * sin({{beta_w1}}))"
            page.add("normal_force", normal, f"{{F_t1}} / {share}" if meets else "")
        formula = f"{{F_n}} * abs(cos({{alpha_wn}}) * sin({{beta_w{gear}}}) {across} {{f}} * cos({{beta_w{gear}}}))"
        page.add("axial_force", normal * forces.axial, formula if meets else "", gear=gear)
        if meets and gear == 2:
            page.add("radial_force", normal * forces.radial, "{F_n} * sin({alpha_wn})")
        elif not meets:
            page.add("radial_force", normal * forces.radial, gear=gear)

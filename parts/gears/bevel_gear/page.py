"""``higherpair calc bevel``: a bevel pair by GOST 19624 and 19326, its exact spherical tooth, forces of a torque."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Annotated

from msgspec.structs import replace as changed

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.bevel.gear import BevelGear, Blank
from geometry.gears.bevel.pair import BevelPair
from geometry.solids.hub_holes import HubHoles
from parts.base.texts import N_, message
from parts.gears.bevel_gear.part import BEVEL_GEAR, BevelGearSpec, bevel_findings, bevel_gear
from parts.keys.base import either, mm
from parts.pages.force_steps import Power, Speed, Torque, both_speeds, driving_torque
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "bevel"
table_from = part_of_kind("bevel_gear")
_GOST, _GOST_SPIRAL, _ISO = "GOST 19624-74", "GOST 19326-73", "ISO 23509"
_RIGHT = 1e-9

_NORMAL_BACKLASH = mm("normal backlash at the outer end, half of it by each gear", least=0, most=100)


class BevelKeys(BevelGearSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the first gear, which tell the second one too, and what both have together."""

    normal_backlash: Annotated[float, _NORMAL_BACKLASH] | None = None
    speed_rpm: Speed = None
    torque: Torque = None
    power: Power = None


@calculation(TOPIC, BevelKeys)
def sheet(keys: BevelKeys) -> Sheet:
    """The calculation of a bevel pair."""
    pair = _pair(keys)
    titles = {"straight": N_("Straight bevel pair"), "skew": N_("Skew bevel pair"), "spiral": N_("Spiral bevel pair"),
              "zerol": N_("Zerol bevel pair")}  # fmt: skip
    page = Sheet(TOPIC, titles[pair.first.tooth_type])
    _given(page, pair)
    _cones(page, pair)
    _teeth(page, pair)
    _middle(page, pair)
    _contact(page, pair)
    if keys.speed_rpm is not None:
        _speeds(page, pair, keys.speed_rpm)
    _forces(page, pair, keys)
    for number, gear in enumerate(pair.gears, 1):
        page.notes += [
            message("gear {number}: {what}", number=number, what=finding_message(f)) for f in bevel_findings(gear)
        ]
    for number, reserve in enumerate(pair.form_reserves, 1):
        if reserve < -_RIGHT:
            text = N_("gear {number}: its mate's tip reaches {depth:.4g} mm below where the involute begins")
            page.note(text, number=number, depth=-reserve)
    return page


def _pair(keys: BevelKeys) -> BevelPair:
    """Both gears, checked to exist; the second one without a hub or a bore."""
    thinning = keys.circumferential_thinning
    if keys.normal_backlash is not None:
        if thinning:
            raise either("normal_backlash", keys.normal_backlash, "circumferential_thinning")
        thinning = keys.normal_backlash / (2 * _normal_share(keys))
    try:
        first = BEVEL_GEAR.thing(changed(keys, circumferential_thinning=thinning), {})
    except ParameterError as error:
        raise _by_backlash(error, keys) from error
    own = 0.0 if keys.normal_backlash is None else thinning
    second = replace(
        first, number_of_teeth=first.mate_number_of_teeth, mate_number_of_teeth=first.number_of_teeth,
        profile_shift_coefficient=-first.profile_shift_coefficient,
        thickness_coefficient=-first.thickness_coefficient, circumferential_thinning=own, hand=first.opposite().hand,
        blank=replace(first.blank, hub_diameter=0.0, hub_length=0.0, holes=HubHoles()),
    )  # fmt: skip
    second = replace(second, blank=replace(second.blank, rim_thickness=min(second.blank.rim_thickness,
                                                                           second.rim_room / 2)))  # fmt: skip
    try:
        return BevelPair(first, second.checked())
    except ParameterError as error:
        # what the first one's key makes of its mate
        if error.name in ("profile_shift_coefficient", "thickness_coefficient"):
            nearest = error.nearest
            cure = None if nearest is None else replace(nearest, side="exactly").scaled(-1.0)
            raise ParameterError(error.name, getattr(keys, error.name), error.code, cure, **error.numbers) from error
        swapped = {"number_of_teeth": "mate_number_of_teeth", "mate_number_of_teeth": "number_of_teeth"}
        raise _by_backlash(error.renamed(swapped.get(error.name, error.name)), keys) from error


def _by_backlash(error: ParameterError, keys: BevelKeys) -> ParameterError:
    """A refusal of the thinning under the key that asked for it."""
    if error.name != "circumferential_thinning" or keys.normal_backlash is None:
        return error
    return error.renamed("normal_backlash", 2 * _normal_share(keys))


def _normal_share(keys: BevelKeys) -> float:
    """Of an arc of the outer pitch circle that is left along the flanks' normal."""
    return bevel_gear(keys, Blank(0.0)).normal_share


def _given(page: Sheet, pair: BevelPair) -> None:
    page.section("Given")
    first, both = pair.first, partial(_both, page, pair)
    page.both("number_of_teeth", (first.number_of_teeth, first.mate_number_of_teeth))
    page.told(outer_module=first.module, shaft_angle_deg=math.degrees(first.shaft_angle))
    if first.is_straight:
        page.add("pressure_angle_deg", math.degrees(first.pressure_angle))
    else:
        page.add("pressure_angle_deg", math.degrees(first.normal_pressure_angle), symbol="α_n", key="alpha_n")
        page.add("spiral_angle_deg", math.degrees(first.spiral_angle))
        if math.isfinite(first.cutter_radius):
            page.add("cutter_radius", first.cutter_radius)
    page.add("addendum_coefficient", first.addendum_coefficient)
    page.add("tip_clearance_coefficient", first.tip_clearance_coefficient)
    page.add("tip_radius_coefficient", first.tip_radius_coefficient)
    both("profile_shift_coefficient", lambda g: g.profile_shift_coefficient)
    both("thickness_coefficient", lambda g: g.thickness_coefficient)
    both("circumferential_thinning", lambda g: g.circumferential_thinning)
    page.add("face_width", first.face_width)


def _each(pair: BevelPair, value: Callable[[BevelGear], float]) -> tuple[float, float]:
    first, second = (value(gear) for gear in pair.gears)
    return first, second


def _both(
    page: Sheet, pair: BevelPair, name: str, value: Callable[[BevelGear], float], formula: str = "", source: str = ""
) -> None:
    """A step of either gear."""
    page.both(name, _each(pair, value), formula, source)


def _cones(page: Sheet, pair: BevelPair) -> None:
    first, both = pair.first, partial(_both, page, pair)
    page.section("Cones")
    # of spiral teeth their own standard has the cones; dedendum angles of theirs are by its tables
    gost, dedendum = (_GOST, _GOST) if first.is_straight else (_GOST_SPIRAL, "")
    page.add("gear_ratio", pair.ratio, "{z2} / {z1}")
    # tip cones open less than a right angle, pitch cones so too
    formula = "arctan(sin({Sigma}) / ({z~} / {z#} + cos({Sigma})))"
    both("pitch_cone_angle_deg", lambda g: math.degrees(g.pitch_angle), formula, gost)
    page.add("outer_cone_distance", first.cone_distance, "{m} * {z1} / (2 * sin({delta1}))", gost)
    page.add("mean_cone_distance", first.cone_distance - first.face_width / 2, "{R_e} - {b} / 2")
    mean = first.module * (1 - first.face_width / 2 / first.cone_distance)
    page.add("mean_module", mean, "{m} * {R_m} / {R_e}")
    if not first.is_straight:
        _lines(page, first)
    both("outer_addendum", lambda g: g.addendum, "({h_a} + {x#}) * {m}")
    both("outer_dedendum", lambda g: g.dedendum, "({h_a} + {c} - {x#}) * {m}")
    both("outer_depth", lambda g: g.addendum + g.dedendum, "{h_ae#} + {h_fe#}")
    both("dedendum_angle_deg", lambda g: math.degrees(g.dedendum_angle), "arctan({h_fe#} / {R_e})", dedendum)
    formula, source = ("arctan({h_ae#} / {R_e})", "") if first.tip_to_apex else ("{theta_f~}", dedendum)
    both("addendum_angle_deg", lambda g: math.degrees(g.addendum_angle), formula, source)
    both("tip_cone_angle_deg", lambda g: math.degrees(g.tip_cone_angle), "{delta#} + {theta_a#}")
    both("outer_tip_ray_deg", lambda g: math.degrees(g.tip_angle), "{delta#} + arctan({h_ae#} / {R_e})")
    both("root_cone_angle_deg", lambda g: math.degrees(g.root_angle), "{delta#} - {theta_f#}")
    both("base_cone_angle_deg", lambda g: math.degrees(g.involute.base), "arcsin(sin({delta#}) * cos({alpha}))")
    both("outer_pitch_diameter", lambda g: g.module * g.number_of_teeth, "{m} * {z#}")
    both("mean_pitch_diameter", lambda g: mean * g.number_of_teeth, "{m_m} * {z#}")
    both("outer_tip_circle", lambda g: 2 * g.outer(g.tip_angle).real, "{d_e#} + 2 * {h_ae#} * cos({delta#})", gost)
    formula = "{d_ae#} - 2 * {b} * sin({delta_a#}) / cos({theta_a#})"
    both("inner_tip_circle", lambda g: 2 * g.inner(g.inner_tip_angle).real, formula)
    both("outer_root_circle", lambda g: 2 * g.outer(g.root_angle).real, "{d_e#} - 2 * {h_fe#} * cos({delta#})")
    formula = "{R_e} * cos({delta#}) - {h_ae#} * sin({delta#})"
    both("tip_circle_to_apex", lambda g: g.outer(g.tip_angle).imag, formula, gost)
    formula = "{b} * cos({delta_a#}) / cos({theta_a#})"
    both("axial_face_width", lambda g: (g.outer(g.tip_angle) - g.inner(g.inner_tip_angle)).imag, formula, "KHK")


def _lines(page: Sheet, gear: BevelGear) -> None:
    """The tooth line, and the section across it."""
    page.add("inner_cone_distance", gear.inner_distance, "{R_e} - {b}")
    page.add("mean_normal_module", gear.mean_normal_module, "{m_m} * cos({beta_m})", _GOST_SPIRAL)
    alpha = math.degrees(gear.pressure_angle)
    page.add("transverse_pressure_angle_deg", alpha, "arctan(tan({alpha_n}) / cos({beta_m}))", _ISO)
    for name, at, distance in (("outer", "{R_e}", gear.cone_distance), ("inner", "{R_i}", gear.inner_distance)):
        formula = f"arcsin({{R_m}} * sin({{beta_m}}) / {at})"
        if math.isfinite(gear.cutter_radius):
            high = f"2 * {{R_m}} * {{r_c0}} * sin({{beta_m}}) + {at}**2 - {{R_m}}**2"
            formula = f"arcsin(({high}) / (2 * {at} * {{r_c0}}))"
        page.add(f"{name}_spiral_angle_deg", math.degrees(float(gear.line.spiral(distance))), formula, _ISO)


def _teeth(page: Sheet, pair: BevelPair) -> None:
    page.section("Teeth at the outer end")
    both, source = partial(_both, page, pair), _GOST if pair.first.is_straight else ""
    thickness = "(pi / 2 + 2 * {x#} * tan({alpha}) + {x_tau#}) * {m} - {A#}"
    both("outer_thickness", lambda g: g.thickness, thickness, source)
    both("virtual_teeth", lambda g: g.virtual_teeth, "{z#} / cos({delta#})")
    if pair.first.is_straight:
        _outer_chords(page, pair)
    arc = "arccos(cos({%s#}) / cos({delta_b#})) / sin({delta_b#}) - arccos(tan({delta_b#}) / tan({%s#}))"
    both("pitch_involute_deg", lambda g: _involute(g, g.pitch_angle), arc % ("delta", "delta"))
    both("tip_involute_deg", lambda g: _involute(g, g.tip_angle), arc % ("delta_t", "delta_t"))
    land = "{d_ae#} * ({s_e#} / {d_e#} + {phi_e#} - {phi_a#})"
    both("outer_tip_thickness", lambda g: g.tip_land, land)
    rounding, touching = "arctan({rho_f} * {m} / {R_e})", "arctan(tan({delta#}) * sin({alpha}))"
    deepest = f"{rounding} + arcsin(sin({{alpha}}) * sin({touching} - {rounding}))"
    least = f"{{h_a}} + {{c}} - {{R_e}} / {{m}} * tan({deepest})"
    both("least_shift_without_undercut", lambda g: g.least_shift, least)
    virtual = "{h_a} + {c} - {rho_f} * (1 - sin({alpha})) - {z_v#} * sin({alpha})**2 / 2"
    both("virtual_least_shift", lambda g: g.virtual_least_shift, virtual, source)
    first, ratio = pair.first, max(pair.ratio, 1 / pair.ratio)
    if abs(first.shaft_angle - math.pi / 2) < _RIGHT and ratio > 1:
        small = min(pair.gears, key=lambda g: g.number_of_teeth)
        # Dunaev, Lelikov; of straight teeth the cosine is 1, of others theirs is told in m_mn and ours in m_m
        cosine = math.cos(first.spiral_angle)
        usual = 2 * (1 - 1 / ratio**2) * cosine * math.sqrt(cosine**3 / small.number_of_teeth)
        one, two = (1, 2) if small is first else (2, 1)
        share = f"2 * (1 - ({{z{one}}} / {{z{two}}})**2)"
        lean = "cos({beta_m})"
        root = f"/ sqrt({{z{one}}})" if first.is_straight else f"* {lean} * sqrt({lean}**3 / {{z{one}}})"
        page.add("usual_shift", usual, f"{share} {root}")


def _outer_chords(page: Sheet, pair: BevelPair) -> None:
    """What is measured on straight teeth."""
    both = partial(_both, page, pair)
    both("outer_chord_angle_deg", lambda g: math.degrees(g.virtual_half_angle), "{s_e#} / ({m} * {z_v#})")
    both("outer_chord", lambda g: g.virtual_diameter * math.sin(g.virtual_half_angle), "{m} * {z_v#} * sin({psi#})")
    rise = "{h_ae#} + {m} * {z_v#} / 2 * (1 - cos({psi#}))"
    both(
        "outer_chord_height", lambda g: g.addendum + g.virtual_diameter / 2 * (1 - math.cos(g.virtual_half_angle)), rise
    )
    cosine, double = math.cos(pair.first.pressure_angle), math.sin(2 * pair.first.pressure_angle)
    both("outer_constant_chord", lambda g: g.thickness * cosine**2, "{s_e#} * cos({alpha})**2", _GOST)
    formula = "{h_ae#} - {s_e#} * sin(2 * {alpha}) / 4"
    both("outer_constant_chord_height", lambda g: g.addendum - g.thickness * double / 4, formula, _GOST)


def _involute(gear: BevelGear, angle: float) -> float:
    return math.degrees(float(gear.involute.involute_at(angle)))


def _middle(page: Sheet, pair: BevelPair) -> None:
    """What is measured half way along the face, where the tooth is smaller by R_m / R_e."""
    page.section("Teeth in the middle of the face")
    share, both = 1 - pair.first.face_width / 2 / pair.first.cone_distance, partial(_both, page, pair)
    high = _each(pair, lambda g: float(g.addendum_at(share * g.cone_distance)))
    page.both("mean_addendum", high, "{h_ae#} - {b} / 2 * tan({theta_a#})")
    both("mean_thickness", lambda g: share * g.thickness, "{s_e#} * {R_m} / {R_e}")
    if not pair.first.is_straight:
        _normal_chords(page, pair, high)
        return
    formula = "{m_m} * {z_v#} * sin({psi#})"
    both("mean_chord", lambda g: share * g.virtual_diameter * math.sin(g.virtual_half_angle), formula)
    rises = _each(pair, lambda g: share * g.virtual_diameter / 2 * (1 - math.cos(g.virtual_half_angle)))
    heights = high[0] + rises[0], high[1] + rises[1]
    page.both("mean_chord_height", heights, "{h_am#} + {m_m} * {z_v#} / 2 * (1 - cos({psi#}))")


def _normal_chords(page: Sheet, pair: BevelPair, high: tuple[float, float]) -> None:
    """The same of teeth that are not straight: across them, on the virtual gear of the normal section."""
    beta, module = pair.first.spiral_angle, pair.first.mean_normal_module

    def thickness(gear: BevelGear) -> float:
        return gear.thickness * gear.mean_distance / gear.cone_distance * math.cos(beta)

    def teeth(gear: BevelGear) -> float:
        return gear.virtual_teeth / math.cos(beta) ** 3

    def half(gear: BevelGear) -> float:
        return thickness(gear) / (module * teeth(gear))

    both = partial(_both, page, pair)
    both("mean_normal_thickness", thickness, "{s_m#} * cos({beta_m})", _GOST_SPIRAL)
    both("normal_virtual_teeth", teeth, "{z#} / (cos({delta#}) * cos({beta_m})**3)", _GOST_SPIRAL)
    both("normal_chord_angle_deg", lambda g: math.degrees(half(g)), "{s_mn#} / ({m_mn} * {z_vn#})")
    both("mean_normal_chord", lambda g: module * teeth(g) * math.sin(half(g)), "{m_mn} * {z_vn#} * sin({psi_n#})")
    rises = _each(pair, lambda g: module * teeth(g) / 2 * (1 - math.cos(half(g))))
    heights = high[0] + rises[0], high[1] + rises[1]
    page.both("mean_normal_chord_height", heights, "{h_am#} + {m_mn} * {z_vn#} / 2 * (1 - cos({psi_n#}))")


def _contact(page: Sheet, pair: BevelPair) -> None:
    page.section("Contact")
    both = partial(_both, page, pair)
    page.both("bottom_clearance_at_root", pair.bottom_clearances, "{h_fe#} - {h_ae~}")
    lean = "" if pair.first.is_straight else " / sqrt(1 + (tan({beta_e}) * cos({alpha}))**2)"
    page.add("normal_backlash", pair.normal_backlash, "({A1} + {A2}) * cos({alpha})" + lean)
    one, two = pair.tip_arcs
    reach = "arccos(cos({delta_t#}) / cos({delta_b#})) - arctan(tan({delta#}) * sin({alpha}))"
    page.both("tip_arc_deg", (math.degrees(one), math.degrees(two)), reach)
    whole = min(pair.form_reserves) > -_RIGHT
    formula = "({g_a1} + {g_a2}) * {z1} / (2 * pi * sin({delta_b1}))" if whole else ""
    page.add("contact_ratio", pair.contact_ratio, formula)
    if not pair.first.tip_to_apex:
        _inner_contact(page, pair, whole=whole)
    if not pair.first.is_straight:
        _overlap(page, pair)
    both("virtual_radius", lambda g: g.virtual_diameter / 2, "{m} * {z_v#} / 2")
    roots = " + ".join(f"sqrt(({{r_v{k}}} + {{h_ae{k}}})**2 - ({{r_v{k}}} * cos({{alpha}}))**2)" for k in (1, 2))
    formula = f"({roots} - ({{r_v1}} + {{r_v2}}) * sin({{alpha}})) / (pi * {{m}} * cos({{alpha}}))"
    page.add("virtual_contact_ratio", pair.virtual_contact_ratio, formula)


def _inner_contact(page: Sheet, pair: BevelPair, *, whole: bool) -> None:
    """Where the teeth are lower than rays of the apex would have them."""
    inner, both = pair.first.inner_distance, partial(_both, page, pair)
    if pair.first.is_straight:
        page.add("inner_cone_distance", inner, "{R_e} - {b}")
    both("inner_addendum", lambda g: float(g.addendum_at(inner)), "{h_ae#} - {b} * tan({theta_a#})")
    arcs = " + ".join(
        f"arccos(cos({{delta{k}}} + arctan({{h_ai{k}}} / {{R_i}})) / cos({{delta_b{k}}}))"
        f" - arctan(tan({{delta{k}}}) * sin({{alpha}}))"
        for k in (1, 2)
    )
    formula = f"({arcs}) * {{z1}} / (2 * pi * sin({{delta_b1}}))" if whole else ""
    page.add("inner_contact_ratio", pair.contact_ratio_at(inner), formula)


def _overlap(page: Sheet, pair: BevelPair) -> None:
    """What the tooth line adds, by its turn from end to end; the total is that of the whole face, sphere by sphere."""
    first = pair.first
    seen = "{beta_i} - {beta_e}"
    if math.isfinite(first.cutter_radius):
        # under which the cutter's axis is seen from the apex
        seen = " - ".join(
            f"arctan(cos({{beta_{end}}}) / ({{R_{end}}} / {{r_c0}} - sin({{beta_{end}}})))" for end in "ie"
        )
    # beyond a right angle the arc tangent is that of the supplement
    plain = all(d / first.cutter_radius > math.sin(float(first.line.spiral(d)))
                for d in (first.inner_distance, first.cone_distance)) or math.isinf(first.cutter_radius)  # fmt: skip
    formula = f"abs({seen}) * {{z1}} / (2 * pi * sin({{delta1}}))" if plain else ""
    page.add("overlap_ratio", pair.face_contact_ratio, formula)
    page.add("total_contact_ratio", pair.total_contact_ratio)


def _speeds(page: Sheet, pair: BevelPair, speed_rpm: float) -> None:
    """Of both gears, of their outer pitch circles, of sliding at the outer tips; the first gear drives."""
    both_speeds(page, (speed_rpm, speed_rpm / pair.ratio))
    speed = math.pi * speed_rpm / 30 * pair.first.module * pair.first.number_of_teeth / 2
    page.add("outer_pitch_speed", speed, "pi * {n1} / 30 * {d_e1} / 2")
    start, end = pair.sliding_factors
    for name, value, gear in (("sliding_speed_at_start", start, 2), ("sliding_speed_at_end", end, 1)):
        formula = (
            f"{{v_e}} * sin({{Sigma}}) / (sin({{delta1}}) * sin({{delta2}}))"
            f" * sin({{g_a{gear}}}) / cos({{delta_t{gear}}} - {{delta{gear}}})"
        )
        page.add(name, value * speed, formula)


def _forces(page: Sheet, pair: BevelPair, keys: BevelKeys) -> None:
    """At the middle of the face, where a load is given, the first gear driving.

    A right-hand driver that turns counter-clockwise, as seen from the apex, is pulled towards the apex; the other hand,
    the other sense and the mate turn that round.
    """
    torque = driving_torque(page, keys)
    if torque is None:
        return
    first = pair.first
    mean = first.module * first.number_of_teeth * (1 - first.face_width / 2 / first.cone_distance)
    page.add("gear_torque", torque * pair.ratio, "{T1} * {u}", gear=2)
    along = 2000 * torque / mean
    page.add("circumferential_force", along, "2000 * {T1} / {d_m1}")
    alpha, beta = first.normal_pressure_angle, first.spiral_angle
    lean, pull = along * math.tan(alpha) / math.cos(beta), along * math.tan(beta)
    steep, normal = "tan({alpha})", "cos({alpha})"
    cases = [("", 0, N_("radial force, towards the gear's axis"), N_("axial force, away from the apex"))]
    if not first.is_straight:
        steep, normal = "tan({alpha_n}) / cos({beta_m})", "(cos({alpha_n}) * cos({beta_m}))"
        # what pulls along the pitch line, outwards on left-hand teeth that drive counter-clockwise
        way = -1 if first.hand == "right" else 1
        cases = [
            ("", way,
             N_("radial force, towards the gear's axis, the first gear driving counter-clockwise seen from the apex"),
             N_("axial force, away from the apex, the first gear driving counter-clockwise seen from the apex")),
            ("clockwise_", -way, "", ""),
        ]  # fmt: skip
    for before, outwards, *called in cases:
        for name, words, share, other, turned in (
            ("radial_force", called[0], "cos", "sin", -1), ("axial_force", called[1], "sin", "cos", 1),
        ):  # fmt: skip
            for number, gear in enumerate(pair.gears, 1):
                delta, sign = gear.pitch_angle, turned * outwards * (1 if number == 1 else -1)
                value = lean * getattr(math, share)(delta) + sign * pull * getattr(math, other)(delta)
                formula = f"{steep} * {share}({{delta#}})"
                if outwards:
                    formula = f"({formula} {'+' if sign > 0 else '-'} tan({{beta_m}}) * {other}({{delta#}}))"
                page.add(before + name, value, "{F_t} * " + formula, gear=number, called=words)
    page.add("normal_force", along / (math.cos(alpha) * math.cos(beta)), f"{{F_t}} / {normal}")

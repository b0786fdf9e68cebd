"""``higherpair calc bevel``: a straight bevel pair by GOST 19624, its exact spherical tooth, the forces of a torque."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated

from msgspec import Meta
from msgspec.structs import replace as changed

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.bevel.gear import BevelGear
from geometry.gears.bevel.pair import BevelPair
from parts.base.texts import N_, message
from parts.gears.bevel_gear.part import BEVEL_GEAR, BevelGearSpec, bevel_findings
from parts.keys.base import either, mm
from parts.pages.inputs import calculation, part_of_kind
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "bevel"
table_from = part_of_kind("bevel_gear")
_GOST = "GOST 19624-74"
_RIGHT = 1e-9


class BevelKeys(BevelGearSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the first gear, which tell the second one too, and what both have together."""

    normal_backlash: (
        Annotated[float, mm("normal backlash at the outer end, half of it by each gear", least=0, most=100)] | None
    ) = None
    torque: (
        Annotated[
            float,
            Meta(gt=0, le=1e9, description="torque on the first gear: adds the forces between the teeth",
                 extra={"unit": "N*m"}),
        ]
        | None
    ) = None  # fmt: skip


@calculation(TOPIC, BevelKeys)
def sheet(keys: BevelKeys) -> Sheet:
    """The calculation of a bevel pair."""
    pair = _pair(keys)
    page = Sheet(TOPIC, N_("Straight bevel pair"))
    _given(page, pair)
    _cones(page, pair)
    _teeth(page, pair)
    _contact(page, pair)
    if keys.torque is not None:
        _forces(page, pair, keys.torque)
    for number, gear in enumerate(pair.gears, 1):
        page.notes += [
            message(N_("gear {number}: {what}"), number=number, what=finding_message(f)) for f in bevel_findings(gear)
        ]
    for number, reserve in enumerate(pair.form_reserves, 1):
        if reserve < -_RIGHT:
            page.notes.append(
                message(N_("gear {number}: its mate's tip reaches {depth:.4g} mm below where the involute begins"),
                        number=number, depth=-reserve)
            )  # fmt: skip
    return page


def _pair(keys: BevelKeys) -> BevelPair:
    """Both gears, checked to exist; the second one without a hub or a bore."""
    thinning = keys.circumferential_thinning
    if keys.normal_backlash is not None:
        if thinning:
            raise either("normal_backlash", keys.normal_backlash, "circumferential_thinning")
        thinning = keys.normal_backlash / (2 * math.cos(math.radians(keys.pressure_angle_deg)))
    try:
        first = BEVEL_GEAR.thing(changed(keys, circumferential_thinning=thinning), {})
    except ParameterError as error:
        raise _by_backlash(error, keys) from error
    own = 0.0 if keys.normal_backlash is None else thinning
    second = replace(
        first, number_of_teeth=first.mate_teeth, mate_teeth=first.number_of_teeth,
        profile_shift_coefficient=-first.profile_shift_coefficient,
        thickness_coefficient=-first.thickness_coefficient, circumferential_thinning=own,
        blank=replace(first.blank, hub_diameter=0.0, hub_length=0.0, bore=None),
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
        swapped = {"number_of_teeth": "mate_teeth", "mate_teeth": "number_of_teeth"}
        raise _by_backlash(error.renamed(swapped.get(error.name, error.name)), keys) from error


def _by_backlash(error: ParameterError, keys: BevelKeys) -> ParameterError:
    """A refusal of the thinning under the key that asked for it."""
    if error.name != "circumferential_thinning" or keys.normal_backlash is None:
        return error
    return error.renamed("normal_backlash", 2 * math.cos(math.radians(keys.pressure_angle_deg)))


def _given(page: Sheet, pair: BevelPair) -> None:
    page.section(N_("Given"))
    first = pair.first
    page.both("number_of_teeth", (first.number_of_teeth, first.mate_teeth))
    page.add("outer_module", first.module)
    page.add("shaft_angle_deg", math.degrees(first.shaft_angle))
    page.add("pressure_angle_deg", math.degrees(first.pressure_angle))
    page.add("addendum_coefficient", first.addendum_coefficient)
    page.add("tip_clearance_coefficient", first.tip_clearance_coefficient)
    page.add("tip_radius_coefficient", first.tip_radius_coefficient)
    page.both("profile_shift_coefficient", _each(pair, lambda g: g.profile_shift_coefficient))
    page.both("thickness_coefficient", _each(pair, lambda g: g.thickness_coefficient))
    page.both("circumferential_thinning", _each(pair, lambda g: g.circumferential_thinning))
    page.add("face_width", first.face_width)


def _each(pair: BevelPair, value: Callable[[BevelGear], float]) -> tuple[float, float]:
    first, second = (value(gear) for gear in pair.gears)
    return first, second


def _cones(page: Sheet, pair: BevelPair) -> None:
    first = pair.first
    page.section(N_("Cones"))
    page.add("gear_ratio", pair.ratio, "{z2} / {z1}")
    # where the pitch cone opens wider than a right angle the arc tangent is that of its supplement
    angles = _each(pair, lambda g: math.degrees(g.pitch_angle))
    formula = "arctan(sin({Sigma}) / ({z~} / {z#} + cos({Sigma})))"
    page.both("pitch_cone_angle_deg", angles, formula if max(angles) < 90 else "", (_GOST, _GOST))
    page.add("outer_cone_distance", first.cone_distance, "{m} * {z1} / (2 * sin({delta1}))", _GOST)
    page.add("mean_cone_distance", first.cone_distance - first.face_width / 2, "{R_e} - {b} / 2")
    mean = first.module * (1 - first.face_width / 2 / first.cone_distance)
    page.add("mean_module", mean, "{m} * {R_m} / {R_e}")
    page.both("outer_addendum", _each(pair, lambda g: g.addendum), "({h_a} + {x#}) * {m}")
    page.both("outer_dedendum", _each(pair, lambda g: g.dedendum), "({h_a} + {c} - {x#}) * {m}")
    page.both("outer_depth", _each(pair, lambda g: g.addendum + g.dedendum), "{h_ae#} + {h_fe#}")
    dedendum = _each(pair, lambda g: math.degrees(g.dedendum_angle))
    page.both("dedendum_angle_deg", dedendum, "arctan({h_fe#} / {R_e})", (_GOST, _GOST))
    addendum = _each(pair, lambda g: math.degrees(g.addendum_angle))
    if first.tip_to_apex:
        page.both("addendum_angle_deg", addendum, "arctan({h_ae#} / {R_e})")
    else:
        page.both("addendum_angle_deg", addendum, "{theta_f~}", (_GOST, _GOST))
    page.both("tip_cone_angle_deg", _each(pair, lambda g: math.degrees(g.tip_cone_angle)), "{delta#} + {theta_a#}")
    page.both("root_cone_angle_deg", _each(pair, lambda g: math.degrees(g.root_angle)), "{delta#} - {theta_f#}")
    base = _each(pair, lambda g: math.degrees(g.involute.base))
    page.both("base_cone_angle_deg", base, "arcsin(sin({delta#}) * cos({alpha}))")
    page.both("outer_pitch_diameter", _each(pair, lambda g: g.module * g.number_of_teeth), "{m} * {z#}")
    page.both("mean_pitch_diameter", _each(pair, lambda g: mean * g.number_of_teeth), "{m_m} * {z#}")
    tips = _each(pair, lambda g: 2 * g.outer(g.tip_angle).real)
    page.both("outer_tip_circle", tips, "{d_e#} + 2 * {h_ae#} * cos({delta#})", (_GOST, _GOST))
    roots = _each(pair, lambda g: 2 * g.outer(g.root_angle).real)
    page.both("outer_root_circle", roots, "{d_e#} - 2 * {h_fe#} * cos({delta#})")
    heights = _each(pair, lambda g: g.outer(g.tip_angle).imag)
    page.both("tip_circle_to_apex", heights, "{R_e} * cos({delta#}) - {h_ae#} * sin({delta#})", (_GOST, _GOST))


def _teeth(page: Sheet, pair: BevelPair) -> None:
    page.section(N_("Teeth at the outer end"))
    thickness = "(pi / 2 + 2 * {x#} * tan({alpha}) + {x_tau#}) * {m} - {A#}"
    page.both("outer_thickness", _each(pair, lambda g: g.thickness), thickness, (_GOST, _GOST))
    page.both("virtual_teeth", _each(pair, lambda g: g.virtual_teeth), "{z#} / cos({delta#})")
    halves = _each(pair, lambda g: math.degrees(g.thickness / g.module / g.virtual_teeth))
    page.both("outer_chord_angle_deg", halves, "{s_e#} / ({m} * {z_v#})")
    chords = _each(pair, lambda g: g.module * g.virtual_teeth * math.sin(g.thickness / g.module / g.virtual_teeth))
    page.both("outer_chord", chords, "{m} * {z_v#} * sin({psi#})")
    heights = _each(
        pair,
        lambda g: (
            g.addendum + g.module * g.virtual_teeth / 2 * (1 - math.cos(g.thickness / g.module / g.virtual_teeth))
        ),
    )
    page.both("outer_chord_height", heights, "{h_ae#} + {m} * {z_v#} / 2 * (1 - cos({psi#}))")
    page.both("outer_tip_thickness", _each(pair, lambda g: g.tip_land))
    page.both("least_shift_without_undercut", _each(pair, lambda g: g.least_shift))
    first, ratio = pair.first, max(pair.ratio, 1 / pair.ratio)
    if abs(first.shaft_angle - math.pi / 2) < _RIGHT and ratio > 1:
        small = min(pair.gears, key=lambda g: g.number_of_teeth)
        usual = 2 * (1 - 1 / ratio**2) * math.sqrt(math.cos(small.pitch_angle) ** 3 / small.number_of_teeth)
        one, two = (1, 2) if small is first else (2, 1)
        share = f"2 * (1 - ({{z{one}}} / {{z{two}}})**2)"
        page.add("usual_shift", usual, f"{share} * sqrt(cos({{delta{one}}})**3 / {{z{one}}})")


def _contact(page: Sheet, pair: BevelPair) -> None:
    page.section(N_("Contact"))
    page.both("bottom_clearance_at_root", pair.bottom_clearances, "{h_fe#} - {h_ae~}")
    page.add("normal_backlash", pair.normal_backlash, "({A1} + {A2}) * cos({alpha})")
    page.add("contact_ratio", pair.contact_ratio)
    page.add("virtual_contact_ratio", _virtual_ratio(pair))


def _virtual_ratio(pair: BevelPair) -> float:
    """Of the two spur gears of the back cones (Tredgold), whose flanks are whole."""
    alpha, m = pair.first.pressure_angle, pair.first.module
    found = 0.0
    for gear in pair.gears:
        radius = m * gear.virtual_teeth / 2
        found += math.sqrt((radius + gear.addendum) ** 2 - (radius * math.cos(alpha)) ** 2) - radius * math.sin(alpha)
    return found / (math.pi * m * math.cos(alpha))


def _forces(page: Sheet, pair: BevelPair, torque: float) -> None:
    page.section(N_("Torques and forces, without friction"))
    first = pair.first
    mean = first.module * first.number_of_teeth * (1 - first.face_width / 2 / first.cone_distance)
    page.add("gear_torque", torque, gear=1, given=True)
    page.add("gear_torque", torque * pair.ratio, "{T1} * {u}", gear=2)
    along = 2000 * torque / mean
    page.add("circumferential_force", along, "2000 * {T1} / {d_m1}")
    lean = along * math.tan(first.pressure_angle)
    page.both(
        "radial_force", _each(pair, lambda g: lean * math.cos(g.pitch_angle)), "{F_t} * tan({alpha}) * cos({delta#})"
    )
    page.both(
        "axial_force", _each(pair, lambda g: lean * math.sin(g.pitch_angle)), "{F_t} * tan({alpha}) * sin({delta#})"
    )
    page.notes.append(N_("the axial forces push both gears away from the apex"))
    page.add("normal_force", along / math.cos(first.pressure_angle), "{F_t} / cos({alpha})")

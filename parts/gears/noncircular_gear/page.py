"""``higherpair calc noncircular``: the centrodes of a pair of noncircular gears, their ratio, closure and teeth."""

from __future__ import annotations

import math

import msgspec
import numpy as np

from geometry.base.errors import GeometryError, ParameterError
from geometry.base.record import replace
from geometry.gears.noncircular.gear import NoncircularGear
from geometry.gears.noncircular.pair import NoncircularPair
from geometry.gears.noncircular.pairing import Pairing
from geometry.kinematics.centrodes import CentrodePair, FourierRatio, LobedEllipse
from parts.base.texts import N_
from parts.gears.noncircular_gear.part import NONCIRCULAR_GEAR, NoncircularGearSpec
from parts.pages.cam_steps import Step
from parts.pages.inputs import calculation, part_of_kind, told
from parts.pages.page import Sheet, Table, table_of
from parts.texts.findings import finding_message

TOPIC = "noncircular"
table_from = part_of_kind("noncircular_gear")
_SOURCE = "Litvin, Fuentes, Gear Geometry, 12"
_NAMES = {
    "oval": N_("Oval gears"),
    "focal_ellipse": N_("Ellipses about their foci"),
    "ratio": N_("Noncircular gears of a given ratio"),
}


class NoncircularKeys(NoncircularGearSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a noncircular gear, and the step of its table."""

    step: Step = 10.0


@calculation(TOPIC, NoncircularKeys)
def sheet(keys: NoncircularKeys) -> Sheet:
    """The calculation of a noncircular gear and its mate."""
    gear = NONCIRCULAR_GEAR.thing(keys, {})
    pairing = gear.pairing
    assert pairing is not None
    page = Sheet(TOPIC, _NAMES[keys.centrode])
    pair = CentrodePair(pairing.centrode, pairing.centre_distance)
    _given(page, pairing)
    _closure(page, gear, pairing, pair)
    _teeth(page, keys, gear)
    page.tables.append(_table(pair, keys.step))
    page.note(_convex_note(pair))
    if pairing.is_self_mating:
        page.note(
            N_("two equal parts mesh with each other (rule: teeth over lobes odd)")
            if pairing.twins_mesh
            else N_("two equal parts do not mesh with each other (rule: teeth over lobes odd)")
        )
    _contact(page, keys, gear)
    return page


def _given(page: Sheet, pairing: Pairing) -> None:
    """The driver's centrode."""
    one = pairing.centrode
    page.section("Centrode of the driver")
    page.told(gear_teeth=pairing.teeth[0], mate_teeth=pairing.teeth[1])
    if isinstance(one, LobedEllipse):
        page.told(centrode_eccentricity=one.eccentricity, centrode_lobes=one.lobes, centrode_parameter=one.parameter)
        page.add("greatest_convex_eccentricity", 1.0 if one.lobes == 1 else 1 / (one.lobes**2 - 1),
                 "" if one.lobes == 1 else "1 / ({n_c}**2 - 1)")  # fmt: skip
        equal = pairing.teeth[0] == pairing.teeth[1]
        formula = "2 * {p_c} / (1 - {e_c}**2)" if equal else ""
        page.add("noncircular_distance", pairing.centre_distance, formula, _SOURCE if equal else "")
    else:
        assert isinstance(one.ratio, FourierRatio)
        page.add("mean_ratio", one.ratio.mean, "{z_1} / {z_2}")
        page.told(centrode_lobes=one.ratio.lobes, noncircular_distance=pairing.centre_distance)
        page.data["ratio_cosines"], page.data["ratio_sines"] = list(one.ratio.cosines), list(one.ratio.sines)
        page.note("i = i_m (1 + Σ (a_k cos k n φ + b_k sin k n φ)), r_1 = a i / (1 + i)")


def _closure(page: Sheet, gear: NoncircularGear, pairing: Pairing, pair: CentrodePair) -> None:
    """Radii, ratio, and that both centrodes close."""
    page.section("Ratio and closure")
    line = pairing.lines[0]
    least, greatest = replace(gear, line=line).radii
    page.told(least_centrode_radius=least, greatest_centrode_radius=greatest)
    for name, key in (("least_ratio", "r_min"), ("greatest_ratio", "r_max")):
        radius = least if key == "r_min" else greatest
        formula = f"{{{key}}} / ({{a}} - {{{key}}})"
        page.add(name, radius / (pairing.centre_distance - radius), formula, _SOURCE)
    turn = 360 * pair.mate_turns()
    page.add("mate_turns", turn)
    page.add("closure_error_deg", turn - 360 * pairing.teeth[0] / pairing.teeth[1], "{Phi_2} - 2 * pi * {z_1} / {z_2}")
    page.add("mate_lobes", pairing.lobes[1], "{n_c} * {z_2} / {z_1}")
    page.add("perimeter", line.length, symbol="P_1", key="P_1")
    page.add("centrode_pitch", pairing.pitch, "{P_1} / {z_1}")
    page.add("module", pairing.pitch / math.pi, "{p} / pi")
    page.add("mate_perimeter", pairing.lines[1].length, "{p} * {z_2}")


def _teeth(page: Sheet, keys: NoncircularKeys, gear: NoncircularGear) -> None:
    """What the rack does to the teeth of this gear."""
    rack = gear.rack
    drives = keys.role == "driver"
    page.section(N_("Teeth of this gear (driver)") if drives else N_("Teeth of this gear (mate)"))
    page.told(
        pressure_angle_deg=math.degrees(rack.pressure_angle), addendum_coefficient=rack.addendum,
        tip_clearance_coefficient=rack.tip_clearance, tip_radius_coefficient=rack.tip_radius,
        profile_shift_coefficient=gear.profile_shift_coefficient,
    )  # fmt: skip
    page.told(circumferential_thinning=gear.circumferential_thinning or None)
    page.add("tip_height", gear.tip_height, "({h_a} + {x}) * {m}")
    page.add("root_depth", gear.root_depth, "({h_a} + {c} - {x}) * {m}")
    flat, sharp = gear.curvatures
    page.told(least_centrode_bend=1 / sharp, greatest_centrode_bend=1 / flat if flat > 1e-12 * sharp else math.inf)
    page.add("equivalent_teeth", 2 / sharp / gear.module, "2 * {rho_c} / {m}")
    depth = rack.dedendum - rack.tip_radius * (1 - math.sin(rack.pressure_angle)) - gear.profile_shift_coefficient
    formula = "2 * ({h_a} + {c} - {rho_f} * (1 - sin({alpha})) - {x}) / sin({alpha})**2"
    page.add("least_equivalent_teeth", 2 * depth / math.sin(rack.pressure_angle) ** 2, formula)
    page.told(undercut_sides=gear.outline.undercut, least_tip_land=gear.outline.tip_thickness)


def _contact(page: Sheet, keys: NoncircularKeys, gear: NoncircularGear) -> None:
    """The contact ratio with a mate of opposite shift, where that can be cut."""
    other = msgspec.structs.replace(
        keys,
        role="mate" if keys.role == "driver" else "driver",
        number_of_teeth=keys.mate_number_of_teeth or keys.number_of_teeth,
        mate_number_of_teeth=keys.number_of_teeth,
        profile_shift_coefficient=-keys.profile_shift_coefficient,
        bore=None,
        bore_diameter=0.0,
        holes=None,
        spokes=None,
        web=None,
        hub=None,
        face_chamfer=0.0,
    )
    try:
        pair = NoncircularPair(gear, NONCIRCULAR_GEAR.thing(other, {}))
        ratio = pair.least_contact_ratio
    except ParameterError as error:
        page.note("the mate cannot be cut: {why}", why=told(error))
        return
    except GeometryError:
        page.note("the mate cannot be cut")
        return
    page.section("Pair")
    page.add("noncircular_contact_ratio", ratio)
    page.notes += [finding_message(f) for f in pair.findings()]


def _convex_note(pair: CentrodePair) -> str:
    first, second = pair.is_convex()
    if first and second:
        return N_("both centrodes are convex: a rack rolls on them")
    if not first:
        return N_("the centrode of the driver is hollow: no rack rolls on it")
    return N_("the centrode of the mate is hollow: no rack rolls on it")


def _table(pair: CentrodePair, step: float) -> Table:
    """phi_1, r_1, phi_2, r_2, the ratio and both radii of curvature, over a turn of the driver."""
    degrees = np.append(np.arange(math.ceil(360 / step - 1e-9)) * step, 360.0)
    angle = np.radians(degrees)
    radius = pair.first.series(angle, 0)[0]
    with np.errstate(divide="ignore"):
        bends = [1 / k for k in pair.curvatures(angle)]
    columns = [degrees, radius, np.degrees(pair.mate_angle(angle)), pair.centre_distance - radius, pair.ratio(angle),
               *bends]  # fmt: skip
    heads = (("phi_1", "deg"), ("r_1", "mm"), ("phi_2", "deg"), ("r_2", "mm"), ("i", ""), ("rho_1", "mm"),
             ("rho_2", "mm"))  # fmt: skip
    title = N_("Centrodes: angles, radii and curvature of driver (1) and mate (2), ratio")
    return table_of("centrodes", title, heads, zip(*columns, strict=True))

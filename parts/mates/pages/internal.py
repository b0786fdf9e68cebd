"""``higherpair calc gear-pair`` of the kinds internal_gear_pair and rack_pair: a pinion in a ring, a gear on a rack."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated, Any

import msgspec
from msgspec import Struct

from geometry.base.errors import ParameterError
from geometry.gears.pairs.internal import InternalPair, shift_difference
from geometry.gears.teeth import limits, ring_limits
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse_ring import transverse_ring
from parts.base.mate import End
from parts.base.refusal import SceneError
from parts.base.texts import N_
from parts.gears.rack.part import RackSpec, checked_rack_part
from parts.gears.ring_gear.part import RingGearSpec, checked_ring_gear
from parts.gears.spur_gear.page import given_data, normal_tip_step, sector_data, shift_data
from parts.gears.spur_gear.part import SpurGearSpec, checked_spur_gear, gear_of, rack_findings, rounding_finding
from parts.keys.base import mm
from parts.keys.helix import common_face, same_helix
from parts.mates.involute import InternalGearPairSpec, InternalMating, RackMating, RackPairSpec
from parts.mates.pages.pair_keys import ShortenedTips, mate_of, pair_mated, pair_table
from parts.mates.pages.rack import first_radii, rack_page
from parts.mates.pages.wishes import wish_refused
from parts.pages.contact_steps import (
    ISO,
    Helical,
    backlash_steps,
    contact_steps,
    heading,
    limit_steps,
    meshing_steps,
    sliding_steps,
)
from parts.pages.force_steps import DrivenKeys, force_steps
from parts.pages.inputs import checked, keys_of, of_topic, refusal
from parts.pages.misprints import printed_for_pair
from parts.pages.page import Sheet
from parts.pages.roll_steps import pair_rolls
from parts.texts.findings import finding_of

TOPIC = "gear-pair"
# mm, radii that are printed rightly
_SAME = 1e-9


class InternalKeys(DrivenKeys, forbid_unknown_fields=True, kw_only=True):
    """Keys of an internal pair: pinion, ring, and what is wanted of the pair."""

    first: SpurGearSpec
    second: RingGearSpec
    working_centre_distance: Annotated[float, mm("wanted centre distance", above=0, most=100_000)] | None = None
    normal_backlash: Annotated[float, mm("wanted normal backlash", least=0, most=1000)] | None = None
    shortened_tips: ShortenedTips = False


_WORKING_CENTRE_DISTANCE = mm("wanted distance from axis to datum line", above=0, most=100_000)


class RackKeys(DrivenKeys, forbid_unknown_fields=True, kw_only=True):
    """Keys of a gear and its rack."""

    first: SpurGearSpec
    second: RackSpec
    working_centre_distance: Annotated[float, _WORKING_CENTRE_DISTANCE] | None = None
    normal_backlash: Annotated[float, mm("wanted normal backlash", least=0, most=1000)] | None = None


def internal_sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of a pinion in a ring."""
    return internal_page(table, InternalKeys, TOPIC, _internal_page)


def internal_page(
    table: dict[str, Any],
    kind: type[InternalKeys],
    topic: str,
    page_of: Callable[[InternalPair, InternalKeys, Helical], Sheet],
) -> Sheet:
    """A page about the pinion in a ring that the keys of a topic, of a ``kind``, ask for."""
    table = pair_table(table, kind, topic)
    keys: InternalKeys = checked(table, kind, topic)
    given_shift = "profile_shift_coefficient" in table["second"]

    def made(changed: InternalKeys) -> InternalPair:
        return _internal_pair(changed, given_shift)

    try:
        pair = made(keys)
        page = page_of(pair, keys, _helical(keys))
    except ParameterError as error:
        raise wish_refused(topic, keys, _refused(error, keys, topic), made) from error
    except SceneError as error:
        raise wish_refused(topic, keys, of_topic(error, topic), made) from error
    page.notes += [finding_of(1, f) for f in rack_findings(keys.first, pair.pinion)]
    return page


def _internal_pair(keys: InternalKeys, given_shift: bool) -> InternalPair:
    """The pair that the keys ask for; the ring's shift follows from a wanted distance where it is not given."""
    mate = mate_of(InternalGearPairSpec, keys)
    first, wanted = _pinion(keys), keys.working_centre_distance
    pinion, ring_keys = first.thing, keys.second
    teeth = pinion.number_of_teeth, ring_keys.number_of_teeth
    helix = same_helix(keys.first, keys.second)
    if wanted is not None and not given_shift and teeth[0] < teeth[1]:
        bare = RingGear(ring_keys.module, teeth[1], math.radians(ring_keys.pressure_angle_deg), 1e9, RoundedRoot())
        shift = pinion.profile_shift_coefficient + shift_difference(pinion, transverse_ring(bare, helix), wanted)
        ring_keys = msgspec.structs.replace(ring_keys, profile_shift_coefficient=shift / math.cos(helix))
        # shifts that were found for a distance give it back but for rounding
        mate = msgspec.structs.replace(mate, working_centre_distance=None)
    second = End(ring_keys, checked_ring_gear(ring_keys))
    mating = pair_mated(mate, first, second, shortened=keys.shortened_tips)
    assert isinstance(mating, InternalMating)
    return mating.pair


def _helical(keys: InternalKeys | RackKeys) -> Helical:
    """What the page of a pair says beside its transverse section."""
    same_helix(keys.first, keys.second)
    return Helical(gear_of(keys.first), common_face(keys.first, keys.second))


def rack_sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of a gear on a rack."""
    keys: RackKeys = checked(pair_table(table, RackKeys, TOPIC), RackKeys, TOPIC)
    try:
        same_helix(keys.first, keys.second)
        pinion, mate = _pinion(keys), mate_of(RackPairSpec, keys)
        mating = pair_mated(mate, pinion, End(keys.second, checked_rack_part(keys.second)))
        assert isinstance(mating, RackMating)
        page = rack_page(mating.pair, TOPIC, _helical(keys), keys)
    except ParameterError as error:
        raise _refused(error, keys) from error
    for index, found in ((1, rack_findings(keys.first, mating.pair.gear)), (2, rounding_finding(keys.second))):
        page.notes += [finding_of(index, f) for f in found]
    return page


def _pinion(keys: InternalKeys | RackKeys) -> End[SpurGear]:
    """The first of the pair, refused under its own name if it cannot exist."""
    try:
        return End(keys.first, checked_spur_gear(keys.first))
    except ParameterError as error:
        raise refusal(TOPIC, error, "first", keys) from error


def _refused(error: ParameterError, keys: Struct, topic: str = TOPIC) -> SceneError:
    """A refusal under the key that was typed: those of the pair stand alone, others are the second's."""
    name = error.name.removeprefix("mate.")
    owner = "" if name.partition(".")[0] in keys_of(type(keys)) else "second"
    return refusal(topic, error.renamed(name), owner, keys)


def _internal_page(pair: InternalPair, keys: InternalKeys, helical: Helical) -> Sheet:
    pinion, ring = pair.pinion, pair.ring
    shifts, angle = (pinion.profile_shift_coefficient, ring.profile_shift_coefficient), pinion.rack.pressure_angle
    printed = {} if helical.angle else printed_for_pair(pair.teeth, shifts, pair.module, angle, internal=True)
    # with the clearance and the tips of the thesis its circles are right
    circles = {("root_radius", 1): pinion.root_radius, ("root_radius", 2): ring.root_radius,
               ("tip_radius", 2): ring.tip_radius}  # fmt: skip
    printed = {
        key: told
        for key, told in printed.items()
        if not (isinstance(key, tuple) and key in circles and abs(float(told.text) - circles[key]) < _SAME)
    }
    page = Sheet(TOPIC, N_("Internal gear pair"), printed=printed)
    page.section("Given")
    given_data(page, helical.normal, pinion, helical.angle, 1)
    page.add("number_of_teeth", ring.number_of_teeth, gear=2)
    sector_data(page, ring, 2)
    shift_data(page, ring.profile_shift_coefficient / math.cos(helical.angle), helical.angle, 2)
    page.add("addendum_coefficient", keys.second.addendum_coefficient, gear=2)
    if ring.circumferential_thinning:
        page.add("circumferential_thinning", ring.circumferential_thinning, gear=2)
    heading(page, helical, N_("Meshing"))
    wanted = "" if keys.working_centre_distance is None else "profile_shift_difference"
    meshing_steps(page, pair, helical, wanted)
    page.add("working_radius", pair.working_radii[0], "{a_w} / ({u} - 1)", "ISO 21771", 1)
    page.add("working_radius", pair.working_radii[1], "{a_w} * {u} / ({u} - 1)", "ISO 21771", 2)
    heading(page, helical, N_("Radii"))
    _internal_radii(page, pair, keys, helical)
    heading(page, helical, N_("Pitch and tooth thickness"))
    _internal_sizes(page, pair, helical.angle)
    heading(page, helical, N_("Contact ratio"))
    contact_steps(page, pair, helical)
    pair_rolls(page, pair)
    sliding_steps(page, pair, helical, keys.speed_rpm)
    force_steps(page, pair, helical, keys)
    backlash_steps(page, pair, pair.circumferential_backlash, helical)
    _internal_limits(page, pair, helical)
    return page


def _internal_radii(page: Sheet, pair: InternalPair, keys: InternalKeys, helical: Helical) -> None:
    """Radii; a tip that was given or made shallower and the roots of rings have no formula."""
    pinion, ring = pair.pinion, pair.ring
    page.both("reference_radius", (pinion.reference_radius, ring.reference_radius), "{m} * {z#} / 2", ISO)
    page.both("base_radius", (pinion.base_radius, ring.base_radius), "{r#} * cos({alpha})", ISO)
    first_radii(page, pinion, helical)
    formula = ""
    if ring.tip_radius == ring.default_tip_radius and ring.given_tip_diameter is None:
        spec = keys.second
        plain = spec.tip_rule == "KHK" or ring.profile_shift_coefficient >= 2 * math.cos(helical.angle)
        short = "" if plain else " - (0.25 - 0.125 * {x_n2})"
        formula = f"{{r2}} - ({{h_a2}} - {{x_n2}}{short}) * {{m_n}}"
    page.add("tip_radius", ring.tip_radius, formula, "GOST 19274", 2)
    page.add("root_radius", ring.root_radius, "", "ISO 21771", 2)


def _internal_sizes(page: Sheet, pair: InternalPair, helix: float) -> None:
    """Pitch, thicknesses, angles at the tips."""
    pinion, ring = pair.pinion, pair.ring
    gears: tuple[Any, Any] = (pinion, ring)
    page.add("pitch", math.pi * pair.module, "pi * {m}", "practicum (3.15)")
    for index, gear, sign in ((1, pinion, "+"), (2, ring, "-")):
        less = " - {A#}" if gear.circumferential_thinning else ""
        formula = f"0.5 * {{p}} {sign} 2 * {{x#}} * {{m}} * tan({{alpha}}){less}"
        page.add("reference_thickness", gear.reference_thickness, formula, "ISO 21771", index)
    forms = [abs(f - g.tip_radius) < 1e-12 * f for f, g in zip(pair.tip_form_radii, gears, strict=True)]
    for index, angle in enumerate(pair.tip_pressure_angles, 1):
        formula = "arccos({r_b#} / {r_a#})" if forms[index - 1] else ""
        page.add("tip_pressure_angle_deg", math.degrees(angle), formula, "ISO 21771", index)
    formula = "2 * {r_a1} * ({S1} / (2 * {r1}) + inv({alpha}) - inv({alpha_a1}))"
    usual = pinion.rack.relief is None and forms[0]
    page.add("tip_thickness", limits.tip_thickness(pinion), formula if usual else "", "ISO 21771", 1)
    normal_tip_step(page, pinion, limits.tip_thickness(pinion), helix, 1, "r")
    formula = "2 * {r_a2} * ({S2} / (2 * {r2}) - inv({alpha}) + inv({alpha_a2}))"
    page.add("tip_thickness", ring_limits.tip_thickness(ring), formula if forms[1] else "", "ISO 21771", 2)
    normal_tip_step(page, ring, ring_limits.tip_thickness(ring), helix, 2, "r")


def _internal_limits(page: Sheet, pair: InternalPair, helical: Helical) -> None:
    """The conditions of an internal pair, each with its margin, mm; negative: broken."""
    page.section("Conditions: margins")
    found = {m.name: m for m in pair.margins()}
    for name in ("involute_interference", "trochoid_interference", "radial_assembly"):
        page.add(f"{name}_margin", found[name].margin, "", "KHK")
    fillets = found["fillet_interference_pinion"].margin, found["fillet_interference_ring"].margin
    page.both("fillet_interference_margin", fillets, "", ISO)
    # where a corner meets the fillet itself the limit is its conjugate's
    sources = [ISO if corner is None else "ISO 21771, Willis" for corner in pair.touching_corners]
    page.add("greatest_tip_diameter_pinion", pair.tip_limits[0], "", sources[0])
    page.add("least_tip_diameter_ring", pair.tip_limits[1], "", sources[1])
    limit_steps(page, pair, (pair.pinion,), helical)

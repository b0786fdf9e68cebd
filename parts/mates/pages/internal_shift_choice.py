"""``higherpair calc shift-choice`` of a pinion in a ring: shifts inside the blocking contour of internal pairs."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Annotated, Any, Literal

from msgspec import Meta, Struct
from msgspec.structs import asdict

from geometry.base.errors import Nearest, ParameterError, rounded
from geometry.base.record import replace
from geometry.gears.pairs.internal import shift_difference
from geometry.gears.shifts.finder import (
    for_sum,
    greatest_contact_ratio,
    least_sliding,
    least_wear,
    nearest_sum,
    proposal,
)
from geometry.gears.shifts.internal import InternalRequirements, internal_contour, margins, window
from geometry.gears.shifts.internal_shifts import InternalShiftPair, internal_state, least_pinion_shift
from geometry.gears.teeth.cutter import PinionCutter, checked_cutter
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_cutter, transverse_rack
from parts.base.refusal import SceneError
from parts.base.texts import N_, Message, counted, message
from parts.gears.ring_gear.part import RingGearSpec, RoundedRootTable, settled_section, tip_finding
from parts.gears.spur_gear.part import basic_rack_of
from parts.keys.base import in_modules
from parts.keys.cutter import CutterTable, cutter_of
from parts.keys.helix import in_keys
from parts.mates.pages.contour_marks import Choice, checked_picture, margins_told, show_choices, show_given
from parts.mates.pages.pair_keys import ChoiceKeys, section_table
from parts.pages.contact_steps import working_steps
from parts.pages.inputs import PLACE, checked, refusal
from parts.pages.page import Sheet
from parts.texts.findings import finding_message

TOPIC = "shift-choice"
KIND = "internal_gear_pair"
# modules between a line of the picture and its chords
_TOLERANCE = 5e-4


class PinionKeys(Struct, forbid_unknown_fields=True):
    """What the topic needs of the pinion."""

    number_of_teeth: Annotated[int, Meta(ge=3, le=1000, description="number of teeth z_1")]
    profile_shift_coefficient: Annotated[float, in_modules("shift x_1 to judge", least=-10, most=10)] | None = None
    cutter: CutterTable | None = None


class RingKeys(Struct, forbid_unknown_fields=True):
    """What the topic needs of the ring."""

    number_of_teeth: Annotated[int, Meta(ge=4, le=1000, description="number of teeth z_2")]
    profile_shift_coefficient: Annotated[float, in_modules("shift x_2 to judge", least=-10, most=10)] | None = None
    addendum_coefficient: Annotated[float, in_modules("addendum h_a2", least=0.1, most=3)] = 1.0
    tip_rule: Literal["GOST 19274", "KHK"] = "GOST 19274"
    cutter: CutterTable | None = None
    rounded_root: RoundedRootTable | None = None


class InternalShiftKeys(ChoiceKeys, forbid_unknown_fields=True, kw_only=True):
    """Keys of the topic for a pinion (first) in a ring (second)."""

    first: PinionKeys
    second: RingKeys
    least_tip_clearance: Annotated[float, in_modules("bottom clearance to keep", least=0, most=1)] = 0.2
    radial_assembly: Annotated[bool, Meta(description="the pinion must go into the ring radially")] = False


class BuiltChoice(Choice, kw_only=True):
    """Shifts of a ring; ``pair``: whose numbers are told."""

    pair: InternalShiftPair


def table_from(pair: dict[str, Any], table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a scene's pair (pinion first) that matter here, changed by those of the command line."""
    known = section_table(pair, table)
    for name, kind in (("first", PinionKeys), ("second", RingKeys)):
        own = {k: v for k, v in pair[name].items() if k in kind.__struct_fields__}
        typed = table.pop(name, {})
        if not isinstance(typed, dict):
            raise SceneError(PLACE, f"{TOPIC}.{name}", typed, "write_teeth", None, name=name)
        # one root goes when the other is typed
        for one, other in (("cutter", "rounded_root"), ("rounded_root", "cutter")):
            if one in typed and other not in typed:
                own.pop(other, None)
        known[name] = own | typed
    return {"kind": KIND, **known, **table}


def internal_begun(table: dict[str, Any]) -> Callable[[], Sheet]:
    """The choices and the contour of a pinion in a ring; refused, where they are, before anything is sought."""
    keys: InternalShiftKeys = checked(table, InternalShiftKeys, TOPIC)
    checked_picture(TOPIC, keys.picture)
    teeth = keys.first.number_of_teeth, keys.second.number_of_teeth
    if teeth[0] >= teeth[1]:
        works = Nearest(teeth[0] + 1, "at_least")
        raise SceneError(PLACE, f"{TOPIC}.second.number_of_teeth", teeth[1], "not_above_pinion_teeth", works)
    pair = shift_pair(keys)
    wish = InternalRequirements(*keys.kept, keys.least_tip_clearance, keys.radial_assembly)
    with refusals(keys):
        page = Sheet(TOPIC, N_("Choice of profile shifts, internal pair"))
        wanted = _wanted_difference(keys, pair)
        _given(page, keys, pair, wish)
        own = _own_choices(keys, pair, wish)

    def finished() -> Sheet:
        with refusals(keys):
            choices = [*own, *_found_choices(page, keys, pair, wish, wanted)]
            for number, choice in enumerate(choices, 1):
                _choice(page, keys.module, wish, choice, number)
            found = window(pair)
            contour = None if found is None else internal_contour(pair, wish, found.box, _TOLERANCE)
            show_choices(page, contour, choices, keys.picture)
        return page

    return finished


@contextmanager
def refusals(keys: ChoiceKeys) -> Iterator[None]:
    """What geometry refuses is told by the keys of the topic."""
    try:
        yield
    except ParameterError as error:
        raise refusal(TOPIC, in_keys(error), keys=keys) from error


def shift_pair(keys: InternalShiftKeys) -> InternalShiftPair:
    """The pair of the keys, in its transverse section, normal module 1.

    Raises
    ------
    SceneError
        A rack or cutter cannot exist, or the ring has two roots.
    """
    angle, owner = math.radians(keys.pressure_angle_deg), ""
    try:
        beta = keys.face.helix.angle
        rack = transverse_rack(basic_rack_of(keys.basic_rack, angle), beta)
        owner = "first"
        shaper = None if keys.first.cutter is None else checked_cutter(cutter_of(keys.first.cutter, 1.0, angle))
        owner = "second"
        root = _root_of(keys, angle)
    except ParameterError as error:
        raise refusal(TOPIC, in_keys(error), owner, keys) from error
    ring = keys.second
    return InternalShiftPair(
        keys.first.number_of_teeth,
        ring.number_of_teeth,
        rack,
        root,
        ring.addendum_coefficient,
        ring.tip_rule == "KHK",
        None if shaper is None else transverse_cutter(shaper, beta),
        helix_angle=beta,
        overlap_ratio=keys.face.overlap_ratio if beta else 0.0,
    )


def _root_of(keys: InternalShiftKeys, angle: float) -> PinionCutter | RoundedRoot:
    """The ring's cutter or rounded root; where none is named, the cutter that a ring without shift gets."""
    ring = keys.second
    if ring.cutter is not None and ring.rounded_root is None:
        cutter = checked_cutter(cutter_of(ring.cutter, 1.0, angle))
        if cutter.number_of_teeth >= ring.number_of_teeth:
            works = Nearest(ring.number_of_teeth - 1, "at_most")
            raise ParameterError("cutter.number_of_teeth", cutter.number_of_teeth, "not_below_ring_teeth", works)
    return _ring_of(keys, 0.0).root


def _ring_of(keys: InternalShiftKeys, shift: float) -> RingGear:
    """The section of the ring at a shift with the cutter and the tip of a build, normal module 1."""
    own = asdict(keys.second) | {"profile_shift_coefficient": shift}
    alpha, beta = keys.pressure_angle_deg, keys.helix_angle_deg
    return settled_section(RingGearSpec(module=1.0, pressure_angle_deg=alpha, helix_angle_deg=beta, **own))


def _as_built(keys: InternalShiftKeys, pair: InternalShiftPair, shift: float) -> InternalShiftPair:
    """The pair with the cutter and the tip that a build gives the ring at a shift."""
    ring = _ring_of(keys, shift)
    return replace(pair, root=ring.root, least_tip_diameter=ring.least_tip_diameter)


def _given(page: Sheet, keys: InternalShiftKeys, pair: InternalShiftPair, wish: InternalRequirements) -> None:
    rack = basic_rack_of(keys.basic_rack, math.radians(keys.pressure_angle_deg))
    formula = show_given(page, keys, pair, rack).replace("{h_a}", "{h_a1}").replace("#", "1")
    if isinstance(pair.root, PinionCutter):
        # in normal modules
        page.told(cutter_teeth=pair.root.number_of_teeth, cutter_shift=pair.root.profile_shift_coefficient / pair.share)
        page.add("cutter_addendum", pair.root.addendum / pair.share)
        page.add("cutter_tip_rounding", pair.root.tip_rounding / pair.share)
        if keys.second.cutter is None:
            page.note("no cutter of the ring is given: that of a ring with x2 = 0 is taken")
    page.add("required_contact_ratio", wish.contact_ratio, "", "practicum 1")
    page.add("required_tip_thickness", wish.tip_thickness, "", "practicum (1.3)")
    page.add("required_tip_clearance", wish.tip_clearance)
    formula = formula if pair.pinion_cutter is None else ""
    symbol = "x_n,min" if pair.helix_angle else ""
    page.add("least_shift_without_undercut", least_pinion_shift(pair), formula, "ISO 21771", 1, symbol=symbol)


def _own_choices(keys: InternalShiftKeys, pair: InternalShiftPair, wish: InternalRequirements) -> list[BuiltChoice]:
    """The shifts that were typed, or none at all."""
    shifts = keys.first.profile_shift_coefficient, keys.second.profile_shift_coefficient
    name = message("as given") if any(x is not None for x in shifts) else message("no shift")
    built = _as_built(keys, pair, shifts[1] or 0.0)
    return [BuiltChoice(name, proposal(built, wish, shifts[0] or 0.0, shifts[1] or 0.0), pair=built)]


def _wanted_difference(keys: InternalShiftKeys, pair: InternalShiftPair) -> float | None:
    """x2 - x1 that a wanted centre distance asks for."""
    if keys.working_centre_distance is None:
        return None
    module = keys.module / pair.share
    pinion = SpurGear(module, pair.first_teeth, pair.rack)
    ring = RingGear(module, pair.second_teeth, pair.rack.pressure_angle, 1e9, RoundedRoot())
    return shift_difference(pinion, ring, keys.working_centre_distance) / pair.share


def _found_choices(
    page: Sheet, keys: InternalShiftKeys, pair: InternalShiftPair, wish: InternalRequirements, wanted: float | None
) -> list[BuiltChoice]:
    """What the finder proposes inside the contour."""
    wear, name = least_wear(pair, wish), message("least wear: equal sliding")
    if wear is None:
        wear, name = least_sliding(pair, wish), message("least sliding")
    proposals = [(name, wear), (message("greatest contact ratio"), greatest_contact_ratio(pair, wish))]
    if wanted is not None:
        found = for_sum(pair, wish, wanted)
        if found is None:
            _nearest_distance(page, keys.module, pair, wish, wanted)
        proposals.append((message("a_w = {distance:g} mm", distance=keys.working_centre_distance), found))
        page.note("a_w needs x2 - x1 = {difference:.4f}", difference=wanted)
    text = N_(
        "{rule}: no shifts keep all requirements; less least_contact_ratio, least_tip_thickness or "
        "least_tip_clearance, or a smaller addendum_coefficient may work"
    )
    result = []
    for rule, found in proposals:
        if found is None:
            page.note(text, rule=rule)
        else:
            result.append(BuiltChoice(rule, found, pair=pair))
            _tell_other_cutter(page, keys, pair, found.second, rule)
    return result


def _tell_other_cutter(
    page: Sheet, keys: InternalShiftKeys, pair: InternalShiftPair, shift: float, rule: Message
) -> None:
    """That a build gives the ring of a proposal another cutter than the contour has, where nobody names one."""
    root = _as_built(keys, pair, shift).root
    if isinstance(root, PinionCutter) and root != pair.root:
        page.note(
            counted(
                "{rule}: a build with this x2 and no cutter named takes one of {teeth} tooth",
                "{rule}: a build with this x2 and no cutter named takes one of {teeth} teeth",
                by="teeth",
                rule=rule,
                teeth=root.number_of_teeth,
            )
        )


def _nearest_distance(
    page: Sheet, module: float, pair: InternalShiftPair, wish: InternalRequirements, wanted: float
) -> None:
    """The distance nearest to the wanted one that has legal shifts."""
    nearest = nearest_sum(pair, wish, wanted)
    if nearest is None:
        return
    distance = module * internal_state(pair, 0.0, nearest).working_centre_distance
    text = f"{rounded(distance, up=nearest >= wanted):.12g}"
    works = N_("a_w: at most {distance} mm works") if nearest < wanted else N_("a_w: at least {distance} mm works")
    page.note(works, distance=text)


def _choice(page: Sheet, module: float, wish: InternalRequirements, choice: BuiltChoice, number: int) -> None:
    """One proposal and what it gives; ``module``: the normal one, mm."""
    found, pair = choice.found, choice.pair
    helical = pair.helix_angle != 0
    page.section("{number}. {rule}", number=number, rule=choice.name)
    page.both("profile_shift_coefficient", (found.first, found.second), symbol="x_n" if helical else "")
    state = internal_state(pair, found.first, found.second)
    if not state.involute >= 0:
        page.note("{number}: no working angle", number=number)
        return
    values = state.involute, math.degrees(state.working_pressure_angle), state.working_centre_distance * module
    working_steps(page, values, internal=True, normal=helical)
    if math.isfinite(state.contact_ratio):
        page.add("contact_ratio", state.contact_ratio - pair.overlap_ratio, "", "GOST 19274")
        if helical:
            page.add("total_contact_ratio", state.contact_ratio, "{eps} + {eps_beta}", "ISO 21771")
        page.both("root_sliding", found.root_sliding, "", "ISO 21771")
    for name, pairs in (("tip_thickness", state.tip_thicknesses), ("bottom_clearance_at_root", state.tip_clearances)):
        if all(math.isfinite(v) for v in pairs):
            page.both(name, (pairs[0] * module, pairs[1] * module), "", "ISO 21771")
    # that the default tip was made shallower, in the words of a build
    if (limited := tip_finding(pair.ring(found.second), 1.0)) is not None:
        page.note("{number}: {finding}", number=number, finding=finding_message(limited))
    _broken(page, pair, wish, choice, number)


def _broken(page: Sheet, pair: InternalShiftPair, wish: InternalRequirements, choice: BuiltChoice, number: int) -> None:
    """What a choice breaks, and whether the pinion goes in radially."""
    x1, x2 = choice.found.first, choice.found.second
    found = {m.name: m for m in margins(pair, replace(wish, radial_assembly=True), x1, x2)}
    if not wish.radial_assembly and not found.pop("radial_assembly").margin >= -1e-9:
        page.note("{number}: the pinion goes into the ring along its axis only", number=number)
    broken = [m for m in found.values() if not m.margin >= -1e-9]
    if not broken:
        return
    page.note("{number}: outside the contour: {margins}", number=number, margins=margins_told(broken))

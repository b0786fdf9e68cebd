"""``higherpair calc gear-pair``: pairs of gears; here the external one, practicum (3.2) to (3.22), and more."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from functools import partial
from typing import Annotated, Any, Literal

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import Record, replace
from geometry.gears.pairs.external import ExternalPair, external_pair, tip_beside
from geometry.gears.pairs.side_clearance import guaranteed_normal_backlash, normal_from_circumferential
from geometry.gears.shifts.choice import shifts_for_distance
from geometry.gears.shifts.tables import TableShift, guidelines, kudryavtsev, shortening_table
from geometry.gears.teeth import limits, measurement
from geometry.gears.teeth.limits import checked_gear
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import normal_share, transverse_gear
from parts.base.mate import TIP_ALONE
from parts.base.refusal import REMOVED, SceneError
from parts.base.schema import replaced
from parts.base.texts import N_, in_context
from parts.gears.ring_gear.part import RingGearSpec
from parts.gears.spur_gear.page import (
    addendum_formula,
    given_data,
    height_steps,
    normal_tip_step,
    root_radius_step,
    rule_step,
    thickness_formula,
)
from parts.gears.spur_gear.part import SpurGearSpec, gear_of, rack_findings
from parts.gears.thinning import shared_thinning
from parts.keys.base import in_modules, mm
from parts.keys.helix import common_face, helix_of, in_keys, in_normal_terms, same_helix
from parts.mates.pages.crossed import CrossedKeys, crossed_sheet
from parts.mates.pages.internal import InternalKeys, RackKeys, internal_sheet, rack_sheet
from parts.mates.pages.pair_keys import GEARS, ShortenedTips, kind_of_pair, merged, pair_table
from parts.mates.pages.wishes import wish_refused
from parts.pages.contact_steps import (
    Helical,
    backlash_steps,
    contact_steps,
    limit_steps,
    measured_steps,
    meshing_steps,
    sliding_steps,
)
from parts.pages.force_steps import DrivenKeys, force_steps
from parts.pages.inputs import SceneKeys, checked, given, keys_of, of_topic, refusal
from parts.pages.misprints import printed_for_pair
from parts.pages.page import Sheet
from parts.pages.roll_steps import pair_rolls
from parts.texts.findings import finding_of

TOPIC = "gear-pair"
OTHER_KINDS = (("second.kind", "ring_gear"), ("second.kind", "rack"), ("kind", "crossed_helical_pair"))

_SHIGLEY = "Shigley, 13-7"
_SHIFTS = Meta(description="profile shifts by a table: Kudryavtsev's of the practicum, or least wear of the guidelines")
_CIRCUMFERENTIAL_BACKLASH = mm("wanted backlash, arc on the working circle", least=0, most=1000)


Pairs = dict[str, tuple[type[Struct], Callable[[dict[str, Any]], Sheet]]]


class PairKeys(DrivenKeys, forbid_unknown_fields=True, kw_only=True):
    """Keys of a pair. A key of a gear without first. or second. before it goes to both."""

    first: SpurGearSpec
    second: SpurGearSpec
    shifts: Annotated[Literal["practicum", "guidelines"], _SHIFTS] | None = None
    working_centre_distance: Annotated[float, mm("wanted centre distance", above=0, most=100_000)] | None = None
    normal_backlash: Annotated[float, mm("wanted normal backlash", least=0, most=1000)] | None = None
    circumferential_backlash: Annotated[float, _CIRCUMFERENTIAL_BACKLASH] | None = None
    side_clearance_class: Annotated[Literal["H", "E", "D", "C", "B", "A"], Meta(description="GOST 1643")] | None = None
    tip_shortening_coefficient: Annotated[float, in_modules("given tip shortening", least=0, most=3)] | None = None
    shortened_tips: ShortenedTips = False


class DrawnPairKeys(PairKeys, kw_only=True):
    """Keys of the topic: with what is measured off a drawing."""

    measured_arc_of_action: Annotated[float, mm("arc dd' measured off a drawing", above=0, most=1e6)] | None = None
    measured_working_pitch: Annotated[float, mm("p_w measured off the same drawing", above=0, most=1e6)] | None = None


class Asked(Record):
    """The pair of a calculation in its transverse section, its normal gears, and whether its shifts follow.

    ``off_roots``: tip radii that keep off the mate's fillet or root, mm, where they do so by themselves.
    """

    keys: PairKeys
    pair: ExternalPair
    normal: tuple[SpurGear, SpurGear]
    helical: Helical
    shifts_follow: bool
    off_roots: tuple[float | None, float | None] = (None, None)


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a mate of a scene, changed by those of the command line."""
    return table_of_pair(scene, source, table, PAIRS)


def table_of_pair(scene: SceneKeys, source: str, table: dict[str, Any], known_pairs: Pairs) -> dict[str, Any]:
    """The keys of a mate of a scene that is of a known kind, changed by those of ``table``."""
    index = table.pop("mate", 1)
    pairs = [m for m in scene.mates if m.__struct_config__.tag in known_pairs]
    if not pairs:
        raise SceneError(source, "mates", None, "no_gear_pair")
    if not isinstance(index, int) or not 1 <= index <= len(pairs):
        works = Nearest(len(pairs), "at_most") if isinstance(index, int) and index > 0 else Nearest(1, "at_least")
        raise SceneError(source, "mate", index, "no_such_pair", works)
    mate = pairs[index - 1]
    kind = str(mate.__struct_config__.tag)
    specs = [scene.parts[str(scene.instances[getattr(mate, name)].part)] for name in GEARS]
    if isinstance(specs[0], RingGearSpec):
        # a pinion is the first of its sheet
        specs.reverse()
    built = {"shortened_tips": True} if "shortened_tips" in keys_of(known_pairs[kind][0]) else {}
    known = {"kind": kind, **built, **{name: given(spec) for name, spec in zip(GEARS, specs, strict=True)}}
    wishes = {
        key: getattr(mate, key, None) for key in ("working_centre_distance", "normal_backlash", "shaft_angle_deg")
    }
    return merged(known | {k: v for k, v in wishes.items() if v is not None}, table, known_pairs[kind][0])


def sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of a pair, by its kind."""
    kind, table = kind_of_pair(table, TOPIC, list(PAIRS))
    return PAIRS[kind][1](table)


def external_sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of an external pair."""
    return external_page(table, DrawnPairKeys, TOPIC, _page)


def external_page(table: dict[str, Any], kind: type[PairKeys], topic: str, page_of: Callable[[Asked], Sheet]) -> Sheet:
    """A page about the external pair that the keys of a topic, of a ``kind``, ask for."""
    table = pair_table(table, kind, topic)
    keys: PairKeys = checked(table, kind, topic)
    try:
        found = _tabled(keys, table)
    except ParameterError as error:
        raise refusal(topic, error, keys=keys) from error
    if found is not None:
        for name, shift in zip(GEARS, (found.first, found.second), strict=True):
            table[name] = table[name] | {"profile_shift_coefficient": shift}
        keys = checked(table, kind, topic)
    shifts_given = tuple("profile_shift_coefficient" in table[name] for name in GEARS)

    def made(changed: PairKeys) -> ExternalPair:
        return asked_pair(changed, shifts_given).pair

    try:
        page = page_of(asked_pair(keys, shifts_given))
        if found is not None:
            page.note("shifts by table {table}", table=found.table)
        if found is not None and found.tip_shortening is not None and keys.tip_shortening_coefficient is None:
            text = N_("table {table} rounds Δy to {shortening:g}: tip_shortening_coefficient={shortening:g} takes that")
            table_of = shortening_table(keys.first.number_of_teeth, keys.second.number_of_teeth)
            page.note(text, table=table_of, shortening=found.tip_shortening)
        if found is not None and found.mended is not None:
            printed = " / ".join(f"{v:.3f}" for v in found.mended.printed)
            page.note("the table prints {shifts} for this pair: a misprint", shifts=printed)
        return page
    except ParameterError as error:
        owner = "" if error.name.partition(".")[0] in keys_of(kind) else "second"
        told = in_normal_terms(in_keys(error), keys.second, keys.first)
        raise wish_refused(topic, keys, refusal(topic, told, owner, keys), made) from error
    except SceneError as error:
        raise wish_refused(topic, keys, of_topic(error, topic), made) from error


def _tabled(keys: PairKeys, table: Mapping[str, Any]) -> TableShift | None:
    """The shifts of the table that is asked for."""
    if keys.shifts is None:
        return None
    given = [f"{name}.profile_shift_coefficient" for name in GEARS if "profile_shift_coefficient" in table[name]]
    # the tables are those of spur gears of 20 degrees
    given += [f"{name}.{key}" for key, usual in (("helix_angle_deg", 0.0), ("pressure_angle_deg", 20.0))
              for name in GEARS if getattr(getattr(keys, name), key) != usual]  # fmt: skip
    if keys.working_centre_distance is not None:
        given.append("working_centre_distance")
    if given:
        raise ParameterError("shifts", keys.shifts, "other_is_given", REMOVED, other=given[0])
    find = kudryavtsev if keys.shifts == "practicum" else guidelines
    try:
        return find(keys.first.number_of_teeth, keys.second.number_of_teeth)
    except ParameterError as error:
        raise ParameterError("shifts", keys.shifts, error.code, None, **error.numbers) from error


def asked_pair(keys: PairKeys, shifts_given: tuple[bool, ...]) -> Asked:
    """The pair that the keys ask for: shifts from the distance, thinning from the backlash, tips from Delta y."""
    helix = same_helix(keys.first, keys.second)
    normal = (gear_of(keys.first), gear_of(keys.second))
    if normal[0].module != normal[1].module:
        # before any shift is looked for; the pair itself says it best
        external_pair(*normal)
    follow = keys.working_centre_distance is not None and not all(shifts_given)
    if keys.working_centre_distance is not None and follow:
        one, two = (transverse_gear(g, helix) for g in normal)
        fixed = (
            g.profile_shift_coefficient if known else None for g, known in zip((one, two), shifts_given, strict=True)
        )
        found = zip(normal, shifts_for_distance(one, two, keys.working_centre_distance, *fixed), strict=True)
        first, second = (replace(g, profile_shift_coefficient=x / math.cos(helix)) for g, x in found)
        normal = first, second
    normal = _thinned(keys, normal, helix)
    if keys.tip_shortening_coefficient is not None:
        first, second = (_shortened(g, keys.tip_shortening_coefficient, helix) for g in normal)
        normal = first, second
    # shifts that were found for a distance give it back but for rounding
    distance = None if follow else keys.working_centre_distance
    gears = [_section_of(keys, index, normal, beside=not follow) for index in range(2)]
    pair = external_pair(gears[0], gears[1], distance)
    helical = Helical(normal[0], common_face(keys.first, keys.second))
    if not keys.shortened_tips or keys.tip_shortening_coefficient is not None:
        return Asked(keys, pair, normal, helical, follow)
    off_one, off_two = (
        tip if spec.tip_diameter is None else None
        for tip, spec in zip(pair.tips_off_roots(), (keys.first, keys.second), strict=True)
    )
    first, second = (
        gear if tip is None else replace(gear, given_tip_diameter=2 * tip)
        for gear, tip in zip(pair.gears, (off_one, off_two), strict=True)
    )
    return Asked(keys, replace(pair, first=first, second=second), normal, helical, follow, (off_one, off_two))


def _section_of(keys: PairKeys, index: int, normal: tuple[SpurGear, SpurGear], *, beside: bool) -> SpurGear:
    """The transverse section of one gear of the pair, refused under its own name if it cannot exist.

    ``beside``: one that is pointed alone has the tip that its mate leaves it.
    """
    helix, name = helix_of(keys.first).angle, GEARS[index]
    try:
        return checked_gear(normal[index], helix)
    except ParameterError as error:
        told = error
        if beside and error.code in TIP_ALONE:
            one, two = (transverse_gear(normal[i], helix) for i in (index, 1 - index))
            with suppress(ParameterError):
                tip = tip_beside(one, two, keys.working_centre_distance)
                return checked_gear(replace(normal[index], given_tip_diameter=tip), helix)
        if beside and error.name in ("profile_shift_coefficient", "circumferential_thinning"):
            told = error.told_of(error.name, error.value, partial(_of_pair, keys, f"{name}.{error.name}", error))
        raise refusal(TOPIC, told, name, keys) from error


def _of_pair(keys: PairKeys, path: str, alone: ParameterError) -> Nearest | None:
    """The value of a gear's key nearest to a refused one with which there is a pair; what is refused of it alone."""
    own, given = alone.nearest, alone.value
    ends = [own.value] if own is not None and isinstance(own.value, float) else []
    assert isinstance(given, float)
    return nearest(lambda value: _is_pair(replaced(keys, path, value)), given, [*ends, 0.0])


def _is_pair(keys: PairKeys) -> bool:
    """Whether there is such a pair, both shifts as given."""
    try:
        return asked_pair(keys, (True, True)) is not None
    except (ParameterError, SceneError):
        return False


def _shortened(gear: SpurGear, coefficient: float, helix: float) -> SpurGear:
    if gear.given_tip_diameter is not None:
        return gear
    # a tip circle is that of the transverse section, a coefficient one of normal modules
    tip = transverse_gear(gear, helix).tip_radius
    return replace(gear, given_tip_diameter=2 * (tip - coefficient * gear.module))


def _thinned(keys: PairKeys, normal: tuple[SpurGear, SpurGear], helix: float) -> tuple[SpurGear, SpurGear]:
    """Both gears thinned, half each, for the backlash asked for; gears with a thinning of their own keep it."""
    wishes = ("normal_backlash", "circumferential_backlash", "side_clearance_class")
    asked = [name for name in wishes if getattr(keys, name) is not None]
    if not asked:
        return normal
    if len(asked) > 1:
        raise ParameterError(asked[0], getattr(keys, asked[0]), "other_is_given", REMOVED, other=asked[1])
    for index in range(2):
        # what no backlash is to blame for
        _section_of(keys, index, normal, beside=True)
    gears = [transverse_gear(g, helix) for g in normal]
    bare = external_pair(gears[0], gears[1], keys.working_centre_distance if _has_distance(keys, gears) else None)
    alpha = gears[0].rack.pressure_angle
    share = normal_share(alpha, helix)
    if keys.normal_backlash is not None:
        wanted = keys.normal_backlash
    elif keys.circumferential_backlash is not None:
        wanted = normal_from_circumferential(keys.circumferential_backlash, bare.working_pressure_angle) * share
    else:
        wanted = guaranteed_normal_backlash(str(keys.side_clearance_class), bare.working_centre_distance)

    def build(index: int, thinning: float) -> SpurGear:
        tip = 2 * bare.gears[index].tip_radius
        return checked_gear(replace(normal[index], circumferential_thinning=thinning, given_tip_diameter=tip), helix)

    try:
        asked_of = shared_thinning(wanted, normal, build, math.cos(alpha), bare.normal_backlash, share)
    except ParameterError as error:
        if keys.normal_backlash is not None:
            raise error.renamed(asked[0]) from error
        # of the other wishes the nearest is searched for, where there is one
        cure = REMOVED if error.code == "backlash_is_of_own_thinning" else None
        raise ParameterError(asked[0], getattr(keys, asked[0]), error.code, cure, **error.numbers) from error
    one, two = (replace(g, circumferential_thinning=t) if t else g for g, t in zip(normal, asked_of, strict=True))
    return one, two


def _has_distance(keys: PairKeys, gears: list[SpurGear]) -> bool:
    """Whether the wanted distance is another than that of the shifts, which then were given."""
    if keys.working_centre_distance is None:
        return False
    tight = external_pair(gears[0], gears[1]).working_centre_distance
    return abs(tight - keys.working_centre_distance) > 1e-9 * tight


def _page(asked: Asked) -> Sheet:
    pair, (one, two) = asked.pair, asked.pair.gears
    keys = asked.keys
    shifts = (keys.first.profile_shift_coefficient, keys.second.profile_shift_coefficient)
    plain = not (asked.helical.angle or keys.working_centre_distance or pair.normal_backlash)
    teeth, angle = (one.number_of_teeth, two.number_of_teeth), one.rack.pressure_angle
    printed = printed_for_pair(teeth, shifts, one.module, angle) if plain else {}
    is_practicums = ("working_centre_distance", 0) in printed
    page = Sheet(TOPIC, N_("External gear pair"), printed=printed)
    page.section("Given")
    for index, (normal, gear) in enumerate(zip(asked.normal, pair.gears, strict=True), 1):
        given_data(page, normal, gear, asked.helical.angle, index)
    _mesh(page, asked)
    _radii(page, asked)
    _thicknesses(page, asked)
    page.section("Contact ratio")
    contact_steps(page, pair, asked.helical)
    measured = {name: getattr(keys, name) for name in ("measured_arc_of_action", "measured_working_pitch")}
    for name, other in (tuple(measured), tuple(measured)[::-1]):
        if measured[name] is not None and measured[other] is None:
            raise ParameterError(name, measured[name], "needs_other", REMOVED, other=other)
    if None not in measured.values():
        measured_steps(page, pair, *measured.values())
    pair_rolls(page, pair)
    sliding_steps(page, pair, asked.helical, keys.speed_rpm)
    force_steps(page, pair, asked.helical, keys)
    formulas = "{p_w} - {S_w1} - {S_w2}", "{a_w} - {r_f#} - {r_a~}"
    backlash_steps(page, pair, pair.circumferential_backlash, asked.helical, formulas)
    page.section(in_context("pair", "Limits"))
    if not asked.helical.angle:
        for index, gear in enumerate((one, two), 1):
            if gear.cutter is None:
                rule_step(page, gear, index)
    _interference(page, asked)
    limit_steps(page, pair, pair.gears, asked.helical)
    for index, (spec, gear) in enumerate(zip((keys.first, keys.second), pair.gears, strict=True), 1):
        page.notes += [finding_of(index, f) for f in rack_findings(spec, gear)]
    if is_practicums:
        page.note("practicum (3.4) prints alpha_w on its left side for a_w")
    return page


def _interference(page: Sheet, asked: Asked) -> None:
    """How few teeth go with a mate of this ratio, and with how many the smaller gear goes; of gears without shifts."""
    keys, (one, two) = asked.keys, asked.pair.gears
    specs = (keys.first, keys.second)
    if keys.working_centre_distance is not None or keys.tip_shortening_coefficient is not None:
        return
    if any(spec.profile_shift_coefficient or spec.tip_diameter is not None for spec in specs):
        return
    small, great = (1, 2) if one.number_of_teeth <= two.number_of_teeth else (2, 1)
    teeth, mate = (one, two)[small - 1].number_of_teeth, (one, two)[great - 1]
    ratio, height, angle = mate.number_of_teeth / teeth, mate.rack.addendum, one.rack.pressure_angle
    u = "{u}" if small == 1 else "(1 / {u})"
    k = f"{{h_a{great}}}" + (" * cos({beta})" if asked.helical.angle else "")
    square = f"({k})**2" if asked.helical.angle else f"{k}**2"
    sine = f"(1 + 2 * {u}) * sin({{alpha}})**2"
    formula = f"2 * {k} * ({u} + sqrt({u}**2 + {sine})) / ({sine})"
    page.add("least_teeth_in_pair", limits.least_teeth_in_pair(ratio, height, angle), formula, _SHIGLEY, small)
    most = limits.most_teeth_of_mate(teeth, height, angle)
    if most is not None and most >= teeth:
        formula = f"({{z{small}}}**2 * sin({{alpha}})**2 - 4 * {square})"
        formula += f" / (4 * {k} - 2 * {{z{small}}} * sin({{alpha}})**2)"
        page.add("most_teeth_of_mate", most, formula, _SHIGLEY, great)


def _mesh(page: Sheet, asked: Asked) -> None:
    """(3.2) to (3.6), from the shifts to the distance or the other way round."""
    pair, keys = asked.pair, asked.keys
    page.section("Meshing")
    # with shifts of one's own the distance leaves backlash
    total = "profile_shift_sum" if asked.shifts_follow else "tight_profile_shift_sum"
    meshing_steps(page, pair, asked.helical, "" if keys.working_centre_distance is None else total)
    shortening = pair.tip_shortening_coefficient / math.cos(asked.helical.angle)
    if keys.tip_shortening_coefficient is None:
        page.add("tip_shortening_coefficient", shortening, "{x_n1} + {x_n2} - {y}", "GOST 16532-70")
    else:
        page.add("exact_tip_shortening_coefficient", shortening, "{x_n1} + {x_n2} - {y}", "GOST 16532-70")
        table = shortening_table(*sorted(gear.number_of_teeth for gear in pair.gears))
        page.add("tip_shortening_coefficient", keys.tip_shortening_coefficient, "", f"practicum, table {table}")
    page.add("working_radius", pair.working_radii[0], "{a_w} / ({u} + 1)", "practicum (3.5)", 1)
    page.add("working_radius", pair.working_radii[1], "{a_w} * {u} / ({u} + 1)", "practicum (3.6)", 2)


def _radii(page: Sheet, asked: Asked) -> None:
    """(3.7) to (3.14)."""
    gears = asked.pair.gears
    page.section("Radii")
    radii = [gear.reference_radius for gear in gears]
    page.both("reference_radius", radii, "{m} * {z#} / 2", ("practicum (3.7)", "practicum (3.8)"))
    radii = [gear.base_radius for gear in gears]
    page.both("base_radius", radii, "{r#} * cos({alpha})", ("practicum (3.9)", "practicum (3.10)"))
    for index, gear in enumerate(gears, 1):
        source = f"practicum (3.{10 + index})"
        page.add("tip_radius", gear.tip_radius, _tip_formula(asked, index - 1), source, index)
    for index, gear in enumerate(gears, 1):
        root_radius_step(page, gear, index)
    for index, gear in enumerate(gears, 1):
        heights = gear.tip_radius - gear.reference_radius, gear.reference_radius - gear.root_radius
        height_steps(page, heights, ("{r_a#} - {r#}", "{r#} - {r_f#}"), index)


def _tip_formula(asked: Asked, index: int) -> str:
    """(3.11) where the tip follows it; one that is given or keeps off a root has no formula."""
    if (asked.keys.first, asked.keys.second)[index].tip_diameter is not None or asked.off_roots[index] is not None:
        return ""
    shortened = asked.pair.gears[index].given_tip_diameter is not None
    return "{r#} + " + addendum_formula(" - {dy}" if shortened else "")


def _thicknesses(page: Sheet, asked: Asked) -> None:
    """(3.15) to (3.19) and the thicknesses on the base, working and tip circles."""
    pair, gears = asked.pair, asked.pair.gears
    page.section("Pitch and tooth thickness")
    page.add("pitch", math.pi * pair.module, "pi * {m}", "practicum (3.15)")
    for index, gear in enumerate(gears, 1):
        formula, source = thickness_formula(gear), f"practicum (3.{15 + index})"
        page.add("reference_thickness", gear.reference_thickness, formula, source, index)
    values = [measurement.base_thickness(gear) for gear in gears]
    page.both("base_thickness", values, "2 * {r_b#} * ({S#} / (2 * {r#}) + inv({alpha}))", "ISO 21771")
    values = [measurement.thickness_at(g, r) for g, r in zip(gears, pair.working_radii, strict=True)]
    formula = "2 * {r_w#} * ({S#} / (2 * {r#}) + inv({alpha}) - inv({alpha_w}))"
    page.both("working_thickness", values, formula, "ISO 21771")
    for index, gear in enumerate(gears, 1):
        angle = math.degrees(measurement.angle_at(gear, gear.tip_radius))
        page.add("tip_pressure_angle_deg", angle, "arccos({r_b#} / {r_a#})", f"practicum (3.{17 + index})", index)
    for index, gear in enumerate(gears, 1):
        formula = "2 * {r_a#} * ({S#} / (2 * {r#}) + inv({alpha}) - inv({alpha_a#}))"
        formula = formula if gear.rack.relief is None else ""
        page.add("tip_thickness", limits.tip_thickness(gear), formula, "ISO 21771", index)
        normal_tip_step(page, gear, limits.tip_thickness(gear), asked.helical.angle, index, "r")


# the kinds of pairs that have a sheet: their keys, and what makes it of a table of them
PAIRS: Pairs = {
    "external_gear_pair": (DrawnPairKeys, external_sheet),
    "internal_gear_pair": (InternalKeys, internal_sheet),
    "rack_pair": (RackKeys, rack_sheet),
    "crossed_helical_pair": (CrossedKeys, crossed_sheet),
}

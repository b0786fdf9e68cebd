"""What the checks of a scene found, in lines for terminals and previews."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby, product
from types import MappingProxyType
from typing import Any

from parts.base.part import Part
from parts.base.texts import N_, Message, Words, counted, filled, listed, message, words
from parts.drawing.names import caption_name, drawn_names
from parts.scene.instances import InstanceSpec
from parts.texts.checks import (
    CLOSE,
    GEAR_PAIR,
    MATES,
    OFF_CENTRE,
    VERDICTS,
    called,
    condition_message,
    in_rows,
    overlap_told,
    pairs_counted,
)

# pairs that are told one by one, the rest by its number
_MOST_TOLD = 20
# gaps below this are rounding, mm
_ROUNDING = 1e-9
_ERROR = N_("transmission error (peak to peak, first turns {sense}): {value:.3g} mm on the line of action, {motion}")
_SENSES = {"clockwise": N_("clockwise"), "counter_clockwise": N_("counter-clockwise")}


# why pairs cannot meet
_REST = {
    "fixed": N_("{pairs} fixed to each other"),
    "height": N_("{pairs} never at one height"),
    "mesh": N_("{pairs} checked by their contact"),
    "circles": N_("{pairs} kept apart by circles about their axes"),
    "swept": N_("{pairs} past what one sweeps about its axis"),
    "round": N_("{pairs} round about a common axis"),
}
_WALLS = N_(
    "gaps at the inner wall {inner[0]:.3g} to {inner[1]:.3g} mm, at the outer wall {outer[0]:.3g} to "
    "{outer[1]:.3g} mm, clearance {clearance:.6g} mm"
)
_UNITS = {"mm": N_("mm"), "deg": N_("deg")}
_IN_MESH = N_(
    "sector {sector}: in mesh over {mesh_angle_deg:.6g} deg, turning counter-clockwise from {mesh_from_deg:.6g} to "
    "{mesh_to_deg:.6g} deg off the line of centres; moves {mate} by {way:.6g} {unit}"
)
_STEPPED = N_(
    "sector {sector}: in mesh over {mesh_angle_deg:.6g} deg, then {mate} stands; each run moves it by {way:.6g} {unit}"
)
_ENTERS = N_("its first tooth enters a standing {mate} {entry_margin:.4g} mm beside the nearest tip")


def names_of(instances: Mapping[str, InstanceSpec], parts: Mapping[str, Part]) -> dict[str, str]:
    """What people call each instance; those of one name with their ids."""
    names = {key: spec.title or parts[str(spec.part)].called(key) for key, spec in instances.items()}
    many = Counter(names.values())
    return {key: f"{name} ({key})" if many[name] > 1 else name for key, name in names.items()}


def picture_names(instances: Mapping[str, InstanceSpec], parts: Mapping[str, Part]) -> dict[str, str]:
    """What a picture calls each instance: by titles, else by what its kind is; those of one name are numbered.

    Of several parts without a title that are of one kind each has its id beside that.
    """
    untitled = Counter(drawn_names(part, part.language)[0] for part in parts.values() if part.title is None)
    names: dict[str, str] = {}
    for key, spec in instances.items():
        part = parts[str(spec.part)]
        own = part.called(key)
        # a title with a number of a group is a name, one with an id is none
        titled = part.title is not None and own in (part.title, f"{part.title} {own.rpartition(' ')[2]}")
        plain = own.rpartition(" ")[2].isdigit() or own == part.title
        called = drawn_names(part, part.language)[0]
        kind = caption_name(part) if untitled[called] > 1 else called
        names[key] = spec.title or (own if titled and plain else kind)
    many, taken = Counter(names.values()), Counter[str]()
    for key, name in names.items():
        if many[name] > 1 and instances[key].title is None:
            taken[name] += 1
            names[key] = f"{name} ({taken[name]})" if name[-1].isdigit() else f"{name} {taken[name]}"
    return names


def check_lines(
    checks: dict[str, Any], language: str, names: Mapping[str, str] = MappingProxyType({}), *, brief: bool = False
) -> list[str]:
    """What the checks of a scene found, a line each; ``names`` of instances, where they have one beside their id.

    ``brief``: of mates only pairs with a verdict, what is broken or noted; nothing of how solids were held.
    """
    told = words(language)
    named = [
        mate | {key: names.get(mate[key], mate[key]) for key in ("first", "second")} for mate in checks.get("mates", [])
    ]
    lines = [
        line
        for mate in _without_repeats([mate for mate in named if not brief or _says_more(mate)])
        for line in _mate(mate, told, names)
    ]
    axles = (filled(OFF_CENTRE, **called(axle, names)) for axle in checks.get("axles", []))
    lines += [told.text("BROKEN: {text}", text=text) for text in axles]
    if "in_a_row" in checks:
        apart = ", ".join(names.get(name, name) for name in checks["in_a_row"])
        row = N_("note: neither `at` nor a mate places them, so they stand in a row: {names}")
        lines.append(told.text(row, names=apart))
    lines += _neighbours(checks.get("neighbours", []), told, names)
    drive = next((one["instance"] for one in checks.get("drives", [])), "")
    lines += _solids(checks.get("solids", []), told, names, drive)
    if "motion" in checks and not brief:
        lines += _motion(checks["motion"], told, names)
    if "workspace" in checks and not brief:
        lines += _workspace(checks["workspace"], told, names)
    if "order" in checks:
        from exporters.production.order import hindered_told, order_lines

        lines += order_lines(checks["order"], told)
        for found in checks["order"]["hindered"]:
            lines.append(f"{told.text(VERDICTS[found['verdict']])}: {hindered_told(found, told, names)}")
    return [*lines, *_drives(checks, names, told)]


def _mate(mate: dict[str, Any], told: Words, names: Mapping[str, str]) -> Iterator[str]:
    """A pair with its verdict, then what is noted and broken."""
    text = told.say(_mate_head(mate))
    if "total_contact_ratio" in mate:
        text += told.text(", total {total:.4f}", total=mate["total_contact_ratio"])
    if "verdict" in mate:
        gap = told.text("least gap {gap:.2g} mm", gap=_seen(mate["gap"]))
        text += f": {told.text(VERDICTS[mate['verdict']])}, {gap}"
        if mate["verdict"] == "clear" and mate["gap"] <= mate["tolerance"]:
            text += f"; {told.text('both part on their way')}"
    if "walls" in mate:
        walls = {wall: [_seen(gap) for gap in gaps] for wall, gaps in mate["walls"].items()}
        text += f"; {told.text(_WALLS, **walls, clearance=mate['roller_clearance'])}"
    yield text
    for sector in mate.get("sectors", []):
        yield from _sector(sector, mate, told, names)
    yield from _transmission(mate, told)
    for found in mate.get("findings", []):
        yield told.text("note: {text}", text=found["text"])
    for condition in mate.get("conditions", []):
        if not condition["met"]:
            yield told.text("BROKEN: {text}", text=_condition(mate, condition))


def _neighbours(found: Sequence[Mapping[str, Any]], told: Words, names: Mapping[str, str]) -> Iterator[str]:
    """Pairs that no mate joins and that may touch, the nearest first."""
    near = sorted(found, key=lambda close: close["distance"] - close["sum_of_tip_radii"])
    for close in near[:_MOST_TOLD]:
        numbers = called(close, names) | {"value": close["distance"], "limit": close["sum_of_tip_radii"]}
        yield told.text("note: {text}", text=filled(CLOSE, **numbers))
    if (more := len(near) - _MOST_TOLD) > 0:
        yield told.text("note: {pairs} more may touch", pairs=pairs_counted(more))


def _solids(solids: Sequence[Mapping[str, Any]], told: Words, names: Mapping[str, str], drive: str) -> Iterator[str]:
    """Overlaps of solids, the rest by their verdicts; ``drive``: the instance by whose turn poses are told."""
    for one in solids[:_MOST_TOLD]:
        yield f"{told.text(VERDICTS[one['verdict']])}: {overlap_told(one, told, names, drive)}"
    for verdict, count in Counter(one["verdict"] for one in solids[_MOST_TOLD:]).items():
        yield told.text("{verdict}: {pairs} more", verdict=Message(VERDICTS[verdict]), pairs=pairs_counted(count))


def _sector(found: Mapping[str, Any], mate: Mapping[str, Any], told: Words, names: Mapping[str, str]) -> list[str]:
    """Where the teeth of a sector are in mesh, what they move, and where it enters a mate that stands, how."""
    enters = found["intermittent"] or any(one["code"] == "sector_leaves_mesh" for one in mate.get("findings", ()))
    way, unit = (found["mate_travel"], "mm") if "mate_travel" in found else (found["mate_turn_deg"], "deg")
    numbers = {**called(found, names), "way": way, "unit": Message(_UNITS[unit])}
    lines = [told.text(_STEPPED if found["intermittent"] else _IN_MESH, **numbers)]
    return [*lines, told.text(_ENTERS, **numbers)] if enters and found["entry_margin"] >= 0 else lines


def _condition(mate: Mapping[str, Any], found: Mapping[str, Any]) -> Message:
    numbers = {key: number for key, number in found.items() if key not in ("code", "met", "text")}
    return condition_message(found["code"], mate["first"], mate["second"], **numbers)


def caption_lines(checks: dict[str, Any], language: str, names: Mapping[str, str], most: int) -> list[str]:
    """What the checks found, for a caption of so many letters: where there is more, what is not well, and counts."""
    lines = check_lines(checks, language, names, brief=True)
    if sum(map(len, lines)) <= most:
        return lines
    told, mates = words(language), checks.get("mates", [])
    bad = [mate for mate in mates if has_bad_verdict({"mates": [mate]})]
    held = {key: found for key, found in checks.items() if key in ("axles", "in_a_row", "solids")}
    lines = check_lines({**held, "mates": bad}, language, names, brief=True)
    counts = Counter(mate["verdict"] for mate in mates if "verdict" in mate and mate not in bad)
    for verdict, count in counts.items():
        lines.append(told.text("{verdict}: {pairs}", verdict=Message(VERDICTS[verdict]), pairs=pairs_counted(count)))
    drives = _drives(checks, names, told)
    return [*lines, *(drives if sum(map(len, (*lines, *drives))) <= most else [])]


def _drives(checks: dict[str, Any], names: Mapping[str, str], told: Words) -> list[str]:
    """How often each drive turns what it moves, and how far it slides it; what is fixed to another goes with it."""
    lines, fixed = [], {mate["second"] for mate in checks.get("mates", []) if mate["kind"] == "fixed"}
    ways = (
        ("train", N_("drive {instance}, turns: {train}")),
        ("travel", N_("drive {instance}, travel in mm: {train}")),
    )
    for drive, (kind, text) in product(checks.get("drives", []), ways):
        rows = groupby(
            ((names.get(name, name), way) for name, way in drive.get(kind, {}).items() if name not in fixed),
            key=lambda row: f"{row[1]:.6g}",
        )
        train = ", ".join(f"{name} = {way}" for way, row in rows for name in in_rows(name for name, _ in row))
        driven = names.get(drive["instance"], drive["instance"])
        if train:
            lines.append(told.text(text, instance=driven, train=train))
    return lines


def _motion(motion: dict[str, Any], told: Words, names: Mapping[str, str]) -> list[str]:
    """How far the solids were held against each other on their way, and where they were not."""
    if "one_pose" in motion:
        return [told.text("note: no drive moves this scene: its solids were checked only as they stand")]
    lines = []
    if motion["pairs"]:
        poses = counted("{poses} pose", "{poses} poses", by="poses", poses=motion["poses"])
        held = N_("solids in motion: {pairs} over the period of each; {poses} checked, the rest repeats or lies apart")
        apart = N_("solids in motion: {pairs}; none can meet the other")
        lines.append(told.text(held if motion["tested"] else apart, pairs=pairs_counted(motion["pairs"]), poses=poses))
    partly = N_("note: {first} and {second} were checked over {share:.3g} of their period")
    lines += [told.text(partly, **called(found, names)) for found in motion["uncovered"] if found["share"] < 1]
    return [*lines, *_uncovered(motion, told, names)]


def _workspace(found: dict[str, Any], told: Words, names: Mapping[str, str]) -> list[str]:
    """How solids were held wherever the drives may stand, and why the rest cannot meet."""
    counts = Counter(drives for *_, drives in found["tested"])
    poses = counted("{poses} pose", "{poses} poses", by="poses", poses=found["poses"])
    over, still = N_("{pairs} over {drives}"), N_("{pairs} as they stand")
    rows = ((count, ", ".join(names.get(d, d) for d in drives)) for drives, count in counts.items())
    held = [told.text(over if drives else still, pairs=pairs_counted(n), drives=drives) for n, drives in rows]
    rest = [told.text(_REST[why], pairs=pairs_counted(len(pairs))) for why, pairs in found["rest"].items() if pairs]
    head = N_("solids wherever drives may stand: {held}; {poses}")
    none = N_("solids wherever drives may stand: none can meet another")
    lines = [told.text(head if held else none, held=", ".join(held), poses=poses)]
    lines += [told.text("cannot meet: {rest}", rest=", ".join(rest))] if rest else []
    if found["fits"]:
        touching = sum(fit["touching"] for fit in found["fits"])
        free = sum(fit["pairs"] for fit in found["fits"]) - touching
        fits = (
            message("{pairs} in touch", pairs=pairs_counted(touching)),
            message("{pairs} with a clearance", pairs=pairs_counted(free)),
        )
        lines.append(told.text("seats by half sections: {fits}", fits=listed(fits)))
    return [*lines, *_uncovered(found, told, names)]


def _uncovered(motion: dict[str, Any], told: Words, names: Mapping[str, str]) -> list[str]:
    """What may be hidden between poses."""
    found: list[dict[str, Any]] = motion["uncovered"]
    if not found:
        return []
    text = N_(
        "note: between the poses checked {first} and {second} may overlap by up to {depth:.3g} mm, the most of {pairs}"
    )
    worst = max(found, key=lambda x: x["depth"])
    return [told.text(text, **{**called(worst, names), "pairs": pairs_counted(len(found))})]


def _seen(gap: float) -> float:
    """A gap, mm; 0 where it is nothing but rounding."""
    return gap if abs(gap) > _ROUNDING else 0.0


# mates that only say who belongs to whom
_BARE = ("pin_seat", "fixed", "coaxial", "parallel")


def _says_more(mate: dict[str, Any]) -> bool:
    """Whether a mate says more than who belongs to whom."""
    return "verdict" in mate or bool(mate.get("findings")) or not all(c["met"] for c in mate.get("conditions", []))


def _without_repeats(mates: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """Bare mates of one kind and first of which there is no more to tell, as one with all seconds."""
    shown: dict[object, dict[str, Any]] = {}
    seconds: dict[object, list[str]] = {}
    for mate in mates:
        key = (mate["kind"], mate["first"]) if mate["kind"] in _BARE and not _says_more(mate) else len(shown)
        shown.setdefault(key, mate)
        seconds.setdefault(key, []).append(mate["second"])
    return [{**mate, "second": ", ".join(in_rows(seconds[key]))} for key, mate in shown.items()]


def _transmission(mate: dict[str, Any], told: Words) -> list[str]:
    """The transmission error of a mate, a line for each sense."""
    if mate.get("transmission_error", {}) is None:
        return [told.text("no transmission error: it is computed for pairs of involute gears only")]
    lines = []
    # helical teeth that bridge the gap along their face run on: only their section has no error of its own
    if mate.get("transmission_error") == {} and mate.get("total_contact_ratio", 0.0) < 1:
        lines.append(told.text("no transmission error: the teeth slip past each other"))
    for sense, found in mate.get("transmission_error", {}).items():
        turns = "second_arcsec" in found
        moved = N_('{value:.3g}" of {second}') if turns else N_("{value:.3g} mm of {second}")
        value = found["second_arcsec" if turns else "second_travel"]
        motion = message(moved, value=value, second=mate["second"])
        lines.append(told.text(_ERROR, sense=Message(_SENSES[sense]), value=found["line_of_action"], motion=motion))
    return lines


def _mate_head(mate: dict[str, Any]) -> Message:
    """Who is joined and how: gear pairs with their numbers, other kinds in the words of their own."""
    if own := MATES.get(mate["kind"]):
        unit = {"unit": Message(_UNITS[mate["unit"]])} if "unit" in mate else {}
        return filled(own, **{**mate, **unit})
    return filled(
        GEAR_PAIR,
        first=mate["first"],
        second=mate["second"],
        a_w=mate["working_centre_distance"],
        alpha_w=mate["working_pressure_angle_deg"],
        # what undercut and fillets leave of it
        ratio=min(mate["contact_ratio"], mate["effective_contact_ratio"]),
    )


def has_bad_verdict(checks: dict[str, Any]) -> bool:
    """Whether something overlaps, could not be decided, or breaks a condition."""
    mates = checks.get("mates", [])
    held = (*mates, *checks.get("solids", []), *checks.get("order", {}).get("hindered", []))
    bad = any(found.get("verdict") in ("overlap", "undecided") for found in held)
    broken = any(not condition["met"] for mate in mates for condition in mate.get("conditions", []))
    return bad or broken or bool(checks.get("axles"))

"""What the checks of a scene say: who is joined and how, which conditions hold, what stands in what."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from parts.base.psv import sentences_of
from parts.base.texts import N_, Message, Text, Words, counted, filled

# the number that a name ends in, without zeros in front
_NUMBERED = re.compile(r"(?<!\d)[1-9]\d*$", re.ASCII)
# by the kind of mate, with the numbers that its mating tells
MATES = sentences_of(__file__, "mates")
# a pair of involute gears, of whatever kind
GEAR_PAIR = N_("pair {first} - {second}: a_w = {a_w:.5f} mm, α_w = {alpha_w:.4f} deg, contact ratio {ratio:.4f}")
OFF_CENTRE = N_(
    "the axle of {axle} passes {frame} {distance:.6g} mm off the centre of a hole, its clearance is {clearance:.6g} mm"
)
CLOSE = N_("{first} and {second} may touch: {value:.6g} mm apart, their tips reach {limit:.6g} mm, no mate joins them")
# two solids in each other: as they stand, where a drive or several have moved, or nobody knows
OVERLAP = N_("{first} and {second} run into each other: {value:.4g} mm^3 in common as they stand")
_THIN = N_("{first} and {second}: a wall is too thin to tell whether the solids run into each other; thicken it")
_SLID = N_(
    "{first} and {second} run into each other: {value:.4g} mm^3 in common where {drive} has travelled {way:.6g} mm"
)
_TURNED = N_(
    "{first} and {second} run into each other: {value:.4g} mm^3 in common where {drive} has turned by {way:.6g} deg"
)
_DRIVEN = N_("{first} and {second} run into each other: {value:.4g} mm^3 in common where drives have turned: {where}")
# by the code of a condition, with its value, what is required, and its tolerance
CONDITIONS = sentences_of(__file__, "conditions")
VERDICTS = {
    "clear": N_("CLEAR"),
    "contact": N_("CONTACT"),
    "overlap": N_("OVERLAP"),
    "undecided": N_("UNDECIDED"),
}


def add_mates(table: Mapping[str, Text]) -> None:
    """How mates that are registered from outside are told, with the numbers of their matings."""
    MATES.update(table)


def called(row: Mapping[str, object], names: Mapping[str, str]) -> dict[str, object]:
    """What a sentence tells, instances by their names."""
    return {key: names.get(told, told) if isinstance(told, str) else told for key, told in row.items()}


def in_rows(names: Iterable[str]) -> Iterator[str]:
    """Names as they are, three or more that count on by their last number as the first ... the last."""
    rows: list[list[str]] = []
    open_rows: dict[tuple[str, int], list[str]] = {}
    for name in names:
        found = _NUMBERED.search(name)
        stem, number = (name[: found.start()], int(found[0])) if found else (name, 0)
        row = open_rows.pop((stem, number), None)
        if row is None:
            rows.append(row := [])
        row.append(name)
        if found:
            open_rows[stem, number + 1] = row
    for row in rows:
        yield from row if len(row) < 3 else [f"{row[0]} ... {row[-1]}"]


def pairs_counted(count: int) -> Message:
    """So many pairs."""
    return counted("{pairs} pair", "{pairs} pairs", by="pairs", pairs=count)


def overlap_told(found: Mapping[str, Any], told: Words, names: Mapping[str, str], drive: str = "") -> str:
    """Two solids in each other as a sentence; ``drive``: which has moved, where one alone was held."""
    numbers: dict[str, Any] = {key: names.get(found[key], found[key]) for key in ("first", "second")}
    numbers |= {"value": found["volume"], "drive": names.get(drive, drive)}
    if found["volume"] is None:
        return told.text(_THIN, **numbers)
    if "drive_travel" in found:
        return told.text(_SLID, **numbers, way=found["drive_travel"])
    if "drive_turn_deg" in found:
        return told.text(_TURNED, **numbers, way=found["drive_turn_deg"])
    if "drive_turns_deg" in found:
        turns = ((names.get(name, name), way) for name, way in found["drive_turns_deg"].items())
        where = (told.text("{drive} by {way:.6g} deg", drive=name, way=way) for name, way in turns)
        return told.text(_DRIVEN, **numbers, where=", ".join(where))
    return told.text(OVERLAP, **numbers)


def condition_message(code: str, first: str, second: str, **given: float) -> Message:
    """A condition of a mate as a sentence, with the numbers that it names."""
    numbers: dict[str, object] = {**given}
    if code == "train":
        numbers |= {
            key: counted("{n:.9g} time", "{n:.9g} times", by="n", n=given[key]) for key in ("value", "required")
        }
    return filled(CONDITIONS[code], first=first, second=second, **numbers)

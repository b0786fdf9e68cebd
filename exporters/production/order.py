"""The order of assembly as people read it, and what holding it step by step has shown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from msgspec.structs import asdict

from parts.base.mate import MateKeys
from parts.base.part import Part
from parts.base.texts import N_, Message, Words, counted, filled, listed, message, words
from parts.scene.assembly_order import order_found
from parts.scene.placing import Placing
from parts.scene.steps import StepSpec
from parts.texts.checks import in_rows, pairs_counted

# the ways along the axes of a scene
_WAYS = {
    (0.0, 0.0, -1.0): N_("from above"),
    (0.0, 0.0, 1.0): N_("from below"),
    (1.0, 0.0, 0.0): N_("along x"),
    (-1.0, 0.0, 0.0): N_("against x"),
    (0.0, 1.0, 0.0): N_("along y"),
    (0.0, -1.0, 0.0): N_("against y"),
}
_HOWS = {
    "boxes": N_("{pairs} apart by boxes"),
    "mesh": N_("{pairs} along their teeth"),
    "sections": N_("{pairs} by sections about their axes"),
    "layers": N_("{pairs} layer by layer"),
    "solids": N_("{pairs} by solids"),
}


def order_checks(
    steps: Sequence[StepSpec], placing: Placing, parts: Mapping[str, Part], language: str
) -> dict[str, Any]:
    """What holding the order of a scene has shown: pairs by how they were decided, what is hindered."""
    found = order_found(steps, placing, parts)
    rows = [{**asdict(one), "verdict": "undecided" if one.volume is None else "overlap"} for one in found.hindered]
    told = words(language)
    hindered = [{**row, "text": hindered_told(row, told)} for row in rows]
    return {"steps": found.steps, "pairs": found.pairs, "hindered": hindered}


def hindered_told(found: Mapping[str, Any], told: Words, names: Mapping[str, str] = MappingProxyType({})) -> str:
    """What does not reach its place, in words; ``names`` of instances."""
    text = N_("step {step}: {coming} does not reach its place past {standing}: {value:.4g} mm^3 in its way")
    if found["volume"] is None:
        text = N_("step {step}: a wall is too thin to tell whether {coming} reaches its place past {standing}")
    coming, standing = (names.get(found[key], found[key]) for key in ("coming", "standing"))
    return told.text(text, step=found["step"], coming=coming, standing=standing, value=found["volume"])


def order_lines(found: Mapping[str, Any], told: Words) -> Iterator[str]:
    """What holding an order has shown, a line each."""
    pairs = listed([filled(_HOWS[how], pairs=pairs_counted(count)) for how, count in found["pairs"].items() if count])
    steps = counted("{steps} step", "{steps} steps", by="steps", steps=found["steps"])
    text = N_("order of assembly, {steps}: each part reaches its place straight, past all that stands: {pairs}")
    if found["hindered"]:
        text = N_("order of assembly, {steps}: {pairs}")
    yield told.text(text, steps=steps, pairs=pairs)


def steps_told(
    steps: Sequence[StepSpec], names: Mapping[str, str], language: str, mates: Sequence[MateKeys] = ()
) -> Iterator[str]:
    """The order of assembly, a line for each step; which of them ``mates`` hold where they come to."""
    told = words(language)
    held = {frozenset((mate.first, mate.second)) for mate in mates if mate.__struct_config__.tag == "fixed"}
    for number, step in enumerate(steps, 1):
        things = ", ".join(in_rows(names.get(name, name) for name in step.bring))
        to = names.get(step.to, step.to)
        way = _way(step)
        if all({name, step.to} in held for name in step.bring):
            way = message("{way}, held fast", way=way)
        yield told.text("{number}. {things} to {to}: {way}", number=number, things=things, to=to, way=way)


def _way(step: StepSpec) -> Message:
    if step.along is None:
        return Message(N_("each straight to its axis"))
    size = max(map(abs, step.along))
    x, y, z = (w / size + 0.0 for w in step.along)
    way = message("along ({x:.4g}, {y:.4g}, {z:.4g})", x=x, y=y, z=z)
    if (x, y, z) in _WAYS:
        way = Message(_WAYS[x, y, z])
    if step.outwards is not None:
        outwards = N_("{way}, then {length:.4g} mm outwards from its axis")
        inwards = N_("{way}, then {length:.4g} mm inwards to its axis")
        way = message(outwards if step.outwards > 0 else inwards, way=way, length=abs(step.outwards))
    if step.one_hole:
        way = message("{way}, each through the hole of the first, the row turned on", way=way)
    if step.opened is not None:
        way = message("{way}, opened by {wider:.4g} mm", way=way, wider=step.opened)
    return message("{way}, turned in along its thread or teeth", way=way) if step.screwed else way

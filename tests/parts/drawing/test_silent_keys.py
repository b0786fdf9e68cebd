"""No key is silent: what changes the shape of a part changes a word of its working drawing, the mass left out."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from functools import cache
from importlib import import_module
from typing import Any, Literal, get_args, get_origin

import msgspec
import numpy as np
import pytest

from parts.base.fields import fields_of
from parts.base.refusal import SceneError
from parts.base.registry import KINDS
from parts.base.texts import words
from parts.drawing.working import Subject
from parts.keys.working import WorkingTable
from parts.pages.data_table import position_texts, value_text
from parts.scene.data_tables import part_table
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from tests.exporters.production.test_part_drawings import PARTS
from tests.offered import Place, Raw, put, scenes

# keys that change no shape
OTHER = {"kind", "of", "material", "density", "colour", "title", "position", "designation", "standard",
         "label", "accuracy"}  # fmt: skip
# what is the same part, only turned: nothing about it has a direction of its own
TURNED = {("roller", "bore.angle_deg"), ("shaft", "steps.0.keyways.0.angle_deg"), ("shaft", "steps.0.flats.angle_deg"),
          ("shaft", "steps.1.flats.angle_deg"), ("output_plate", "start_deg"),
          ("pin_ring", "holes.start_deg")}  # fmt: skip
# a drawing of these, or its exact mass, takes up to a second
SLOW = (
    "bevel_gear",
    "face_gear",
    "worm_wheel",
    "noncircular_gear",
    "linkage_cam",
    "cam",
    "groove_cam",
    "conjugate_cam",
    "barrel_cam",
    "wedge_cam",
)
# scenes of tests/offered.py whose parts have tables of keys that those of PARTS lack
MORE = ("swinging roller", "swinging flat", "flat", "mushroom", "cam with holes", "cut gear", "cut ring", "flat arm",
        "plate follower", "conjugate", "wedge", "barrel", "end barrel")  # fmt: skip


@cache
def bases() -> dict[str, tuple[Raw, str]]:
    """Scenes by name, and the part that is drawn in each."""
    drawn = [name for name, kind in KINDS.items() if kind.drawing]
    found: dict[str, tuple[Raw, str]] = {
        f"new {kind}": (raw := scenes()[f"new {kind}"], next(k for k, p in raw["parts"].items() if p["kind"] == kind))
        for kind in drawn
        if f"new {kind}" in scenes()
    }
    found |= {name: ({"parts": {"p": part}, "exports": [{"format": "svg"}]}, "p") for name, part in PARTS.items()}
    for name in MORE:
        raw = scenes()[name]
        found |= {f"{name} {key}": (raw, key) for key, part in raw["parts"].items() if part["kind"] in drawn}
    return found


def _fields(spec: type[msgspec.Struct]) -> dict[str, Any]:
    return {f.encode_name: f for f in fields_of(spec)}


def _inner(kind: Any, wanted: Any) -> Iterator[Any]:
    """What of a sort stands in an annotation: its Meta, its words, its tables."""
    if wanted is msgspec.Struct and isinstance(kind, type) and issubclass(kind, msgspec.Struct):
        yield kind
    if wanted is Literal and get_origin(kind) is Literal:
        yield from get_args(kind)
    if wanted is msgspec.Meta:
        yield from (m for m in getattr(kind, "__metadata__", ()) if isinstance(m, msgspec.Meta))
    for one in get_args(kind):
        if not isinstance(one, str):
            yield from _inner(one, wanted)


def _others(kind: Any, value: Any) -> list[Any]:
    """Values near one, most likely ones first."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, value - 1, value + 2]
    if isinstance(value, float):
        return [value * 1.03, value * 0.97, value + 0.5, value * 1.3] if value else [0.1, 0.3, 5.0, -0.1]
    return [w for w in _inner(kind, Literal) if w != value] if isinstance(value, str) else []


def _examples(kind: Any) -> list[Any]:
    found = [m.examples[-1] for m in _inner(kind, msgspec.Meta) if m.examples]
    tables = [t for t in _inner(kind, msgspec.Struct)]
    for table in tables:
        config = table.__struct_config__
        made = {config.tag_field: config.tag} if config.tag_field else {}
        for name, field in _fields(table).items():
            if field.required:
                made[name] = next((m.examples[-1] for m in _inner(field.type, msgspec.Meta) if m.examples), None)
        found.append(made)
    return found


def _table_of(kind: Any, value: dict[str, Any]) -> type[msgspec.Struct]:
    tables = list(_inner(kind, msgspec.Struct))
    tagged = [t for t in tables if (c := t.__struct_config__).tag_field and value.get(c.tag_field) == c.tag]
    return (tagged or [t for t in tables if set(value) <= set(_fields(t))])[0]


def drawn(raw: Raw, key: str) -> tuple[set[str], list[Any]]:
    """The words of a part's drawing, and what its section and its solid are like."""
    scene = scene_from_dict(msgspec.json.decode(msgspec.json.encode(raw)), "t", "t")
    parts, matings = make_parts(scene, "t")
    placing, part, told = place(scene.instances, scene.drives, parts, matings, "t"), parts[key], words("en")
    drawing = import_module(str(part.made_by.drawing)).part_drawing(Subject(part, WorkingTable(), "en"))
    said = {*drawing.requirements}
    for view in drawing.views:
        said |= {f"{one.before}{one.value:.6f}{one.after}" for one in (*view.sizes, *view.rounds)}
        said |= {note.text for note in view.notes} | {view.title}
        said |= {f"{angle.value:.6f}" for angle in view.angles}
    table = part_table(part, scene, placing, parts)
    if table is not None:
        said |= {f"{told.say(row.name)} {value_text(row, told)}" for rows in table.parts for row in rows}
        said |= {" ".join(position_texts(row)) for row in (table.positions.rows if table.positions else ())}
    shape: list[Any] = []
    if part.made_by.has_outline:
        region = part.section(0.0).region
        for profile in (region.outer, *region.holes, *region.marks):
            places = [s.curve.point(np.linspace(*s.curve.domain, 5)) for s in profile.period]
            shape += [np.full(1, profile.count), np.concatenate(places)]
    moments = part.made_by.moments(part.body(0.0))
    size = moments.volume ** (1 / 3)
    shape.append(np.ravel([size, *moments.centre, *(np.ravel(moments.inertia) / size**4)]))
    return said, shape


def _same(one: list[Any], two: list[Any]) -> bool:
    """Whether two shapes are one within what three decimals show."""
    pairs = zip(one, two, strict=False)
    return len(one) == len(two) and all(a.shape == b.shape and np.abs(a - b).max() < 2e-3 for a, b in pairs)


@cache
def _base(name: str) -> tuple[set[str], list[Any]]:
    raw, key = bases()[name]
    return drawn(raw, key)


def _silent(raw: Raw, key: str, old: tuple[set[str], list[Any]], place: Place, values: list[Any]) -> Iterator[str]:
    """A key whose other value changes the shape and no word; tables that it brings are asked key by key."""
    for value in values:
        changed = put(raw, place, value)
        with suppress(SceneError):
            new = drawn(changed, key)
            if _same(new[1], old[1]):
                continue
            if new[0] == old[0]:
                yield ".".join(map(str, place[2:]))
            if isinstance(value, dict):
                yield from _within(changed, key, new, place)
            elif not isinstance(value, list):
                return


def _within(raw: Raw, key: str, old: tuple[set[str], list[Any]], place: Place) -> Iterator[str]:
    """The silent keys of a table, or of one value."""
    spec: Any = KINDS[raw["parts"][key]["kind"]].keys
    kind, table = spec, raw["parts"][key]
    for step in place[2:]:
        if isinstance(step, str):
            field = _fields(_table_of(kind, table) if isinstance(table, dict) and kind is not spec else kind)[step]
            kind = field.type
        table = table[step] if isinstance(table, list) else table.get(step)
    if isinstance(table, dict):
        own = _fields(_table_of(kind, table))
        for name, field in own.items():
            yield from (
                _within(raw, key, old, (*place, name))
                if name in table
                else _silent(
                    raw, key, old, (*place, name), [*_examples(field.type), *_others(field.type, field.default)]
                )
            )
    elif isinstance(table, list):
        for number in range(min(len(table), 2)):
            yield from _within(raw, key, old, (*place, number))
    else:
        yield from _silent(raw, key, old, place, _others(kind, table))


def _cases() -> Iterator[Any]:
    for name, (raw, part) in bases().items():
        kind = raw["parts"][part]["kind"]
        for key in _fields(KINDS[kind].keys):
            if key not in OTHER:
                yield pytest.param(name, key, marks=pytest.mark.heavy if kind in SLOW else ())


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("name", "key"), [*_cases()])
def test_what_changes_a_part_changes_a_word_of_its_drawing(name: str, key: str) -> None:
    raw, part = bases()[name]
    place, field = ("parts", part, key), _fields(KINDS[raw["parts"][part]["kind"]].keys)[key]
    if key in raw["parts"][part]:
        found = _within(raw, part, _base(name), place)
    else:
        values = [*_examples(field.type), *_others(field.type, field.default), *_inner(field.type, Literal)]
        found = _silent(raw, part, _base(name), place, [v for v in values if v != field.default])
    kind = raw["parts"][part]["kind"]
    assert [one for one in found if (kind, one) not in TURNED] == []


def test_a_key_that_is_silent_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the words on how teeth end, tip_chamfer changes the solid alone."""
    from parts.gears import drawings

    raw, part = bases()["new spur_gear"]
    monkeypatch.setattr(drawings, "_edges", lambda subject: ())
    assert [*_silent(raw, part, drawn(raw, part), ("parts", part, "tip_chamfer"), [0.1])] == ["tip_chamfer"]

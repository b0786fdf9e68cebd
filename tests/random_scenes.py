"""Whole scenes at random: parts, mates and drives of one to three known ones, some keys moved, some exports drawn.

What is known are the built-in scenes and what ``higherpair new KIND`` prints, its commented examples included.
"""

from __future__ import annotations

import contextlib
import copy
import functools
import io
import json
import math
import random
import re
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any

from exporters.command.cli import main
from parts.scene.files import built_in_scenes
from tests.offered import ALONE

Table = dict[str, Any]
_OPTIONAL = re.compile(r"^# (\w+ = .*)$", re.MULTILINE)
# tables of a scene that name instances, and the keys by which they do
_NAMING = ("first", "second", "instance", "part", "of", "about", "with_part")


def random_scene(seed: str) -> str:
    """The text of a scene, the same for the same seed."""
    draw = random.Random(seed)
    scene: Table = {"scene": {"title": f"random {seed}"}, "parts": {}, "instances": {}, "assemblies": [],
                    "mates": [], "drives": [], "boards": {}, "beds": {}}  # fmt: skip
    for number in range(draw.choice((1, 1, 1, 2, 2, 3))):
        _add(scene, _known(draw), f"s{number}_" if number else "")
    for _ in range(draw.choice((0, 1, 1, 2, 3, 4))):
        _move_a_key(scene, draw)
    scene["exports"] = [_export(scene, draw) for _ in range(draw.choice((1, 1, 2, 3)))]
    if draw.random() < 0.7:
        scene["checks"] = {"interference": True}
    return "".join(_lines(scene))


@functools.cache
def _printed(kind: str) -> str:
    """What ``new`` prints for a kind."""
    with contextlib.redirect_stdout(io.StringIO()) as out:
        assert main(["new", kind]) == 0
    return out.getvalue()


@functools.cache
def _optional_keys(kind: str) -> tuple[tuple[str, Any], ...]:
    """Keys that are not set by default, with each of their examples."""
    found = []
    for line in _OPTIONAL.findall(_printed(kind).partition("[[exports]]")[0]):
        with contextlib.suppress(tomllib.TOMLDecodeError):
            found += list(tomllib.loads(line).items())
    return tuple(one for one in found if one[0] not in ("title", "language"))


def _known(draw: random.Random) -> Table:
    """A built-in scene, or a new one of some kind."""
    if draw.random() < 0.5:
        return tomllib.loads(draw.choice(list(built_in_scenes().values())).read_text(encoding="utf-8"))
    return tomllib.loads(_printed(draw.choice(sorted(ALONE))))


def _add(scene: Table, known: Mapping[str, Any], prefix: str) -> None:
    """Parts, instances, mates and drives of another scene, under names of their own."""
    known = copy.deepcopy(dict(known))
    names = {*known.get("parts", {}), *known.get("instances", {})}

    def renamed(table: Table) -> Table:
        own = {k: prefix + v if k in _NAMING and isinstance(v, str) and v in names else v for k, v in table.items()}
        return {k: v for k, v in own.items() if not (prefix and k == "at")}

    for room in ("parts", "instances"):
        scene[room] |= {prefix + name: renamed(table) for name, table in known.get(room, {}).items()}
    for room in ("mates", "drives"):
        scene[room] += [renamed(table) for table in known.get(room, [])]
    # names of what an assembly makes are its own
    if not prefix:
        scene["assemblies"] += known.get("assemblies", [])
    for room in ("boards", "beds"):
        scene[room] |= known.get(room, {})


def _leaves(table: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    items = table.items() if isinstance(table, dict) else enumerate(table)
    for key, value in items:
        if isinstance(value, dict | list):
            yield from _leaves(value, (*path, key))
        elif isinstance(value, int | float) and not isinstance(value, bool):
            yield (*path, key), value


def _move_a_key(scene: Table, draw: random.Random) -> None:
    """Set an optional key of a part to its example, or move a number of a part or a mate."""
    part = draw.choice([*(scene["parts"][name] for name in sorted(scene["parts"])), *scene["assemblies"]])
    if draw.random() < 0.2 and part not in scene["assemblies"]:
        part["label"] = draw.choice(("A1", "Деталь 2", {"en": "z 7", "uk": "Колесо"}))
        return
    if draw.random() < 0.35 and (keys := _optional_keys(part["kind"]) if "kind" in part else ()):
        key, value = draw.choice(keys)
        part[key] = copy.deepcopy(value)
        return
    where: Any = scene if draw.random() < 0.1 else part
    numbers = [(p, v) for p, v in _leaves({"mates": scene["mates"]} if where is scene else where)]
    if not numbers:
        return
    path, value = draw.choice(numbers)
    for step in path[:-1]:
        where = where[step]
    where[path[-1]] = _moved(value, draw)


def _moved(value: float, draw: random.Random) -> float:
    how = draw.random()
    if isinstance(value, int):
        return max(value + draw.choice((-2, -1, 1, 2, 7)), 0) if how < 0.8 else int(value * draw.choice((2, 5, -1)))
    if how < 0.7:
        return round(value * math.exp(draw.gauss(0.0, 0.25)), 4)
    if how < 0.85:
        return round(value + draw.choice((-1.0, 1.0)) * 10.0 ** draw.uniform(-4, 1), 6)
    return draw.choice((0.0, -value, value * 10, value / 10, value * 1e-3, 1e-6))


def _export(scene: Table, draw: random.Random) -> Table:
    made: Table = {"format": draw.choice(("dxf", "dxf", "svg", "stl", "3mf", "step", "step", "sheet", "pdf", "glb"))}
    if made["format"] not in ("sheet", "pdf", "glb") and draw.random() < 0.5:
        made["tolerance"] = round(10.0 ** draw.uniform(-4, -1), 5)
    made["name"] = f"{made['format']}{draw.randrange(10**6)}"
    if made["format"] == "glb":
        return made
    if made["format"] in ("sheet", "pdf"):
        return made | {"purpose": draw.choice(("meshing", "cam", *(("model",) * (made["format"] == "pdf"))))}
    if made["format"] in ("dxf", "svg") and scene["boards"] and draw.random() < 0.5:
        return made | {"purpose": "board"}
    if made["format"] == "3mf" and scene["beds"] and draw.random() < 0.5:
        return made | {"purpose": "plate"}
    if made["format"] == "svg" and draw.random() < 0.2:
        return {"format": "motion", "name": made["name"]}
    if made["format"] == "dxf":
        made["purpose"] = draw.choice(("laser", "drawing"))
    if made["format"] in ("dxf", "svg") and draw.random() < 0.4 and made.get("purpose") != "drawing":
        made["kerf"] = round(draw.uniform(0.0, 0.4), 3)
    if made["format"] in ("3mf", "step") and draw.random() < 0.4:
        made["assembly"] = True
    elif draw.random() < 0.3 and scene["parts"]:
        made["parts"] = [draw.choice(sorted(scene["parts"]))]
    return made


def _lines(scene: Table) -> Iterator[str]:
    """A scene as TOML."""
    for room, held in scene.items():
        if isinstance(held, list):
            tables = [(f"[[{room}]]", table) for table in held]
        elif room in ("parts", "instances", "boards", "beds"):
            tables = [(f"[{room}.{name}]", table) for name, table in held.items()]
        else:
            tables = [(f"[{room}]", held)]
        for head, table in tables:
            yield "\n".join([head, *(f"{key} = {_value(value)}" for key, value in table.items()), "", ""])


def _value(value: Any) -> str:
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{k} = {_value(v)}" for k, v in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return repr(value) if isinstance(value, float) else json.dumps(value, ensure_ascii=False)

"""Variants of a scene: the product of the values that keys of its parts are to take."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterator, Sequence
from copy import deepcopy
from decimal import Decimal
from itertools import product
from math import prod
from typing import Any

from geometry.base.errors import Nearest
from geometry.base.record import Record
from parts.base.refusal import SceneError, meant
from parts.pages.inputs import toml_value
from parts.scene.load import resolved, scene_from_resolved
from parts.scene.scene_file import SceneFile

# where refusals of the command line stand
PLACE = "--vary"
MOST_VARIANTS = 100_000
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_RANGE = re.compile(rf"\s*({_NUMBER}):({_NUMBER})(?::({_NUMBER}))?\s*\Z", re.ASCII)
# letters of a folder's name before it is cut
_MOST_LETTERS = 120


class Axis(Record):
    """A key of a part, ``part.key``, and the values that it takes."""

    key: str
    values: tuple[Any, ...]


class Variant(Record):
    """One choice of values by key, its name as a folder, and its scene as reports keep it, not validated."""

    name: str
    values: dict[str, Any]
    scene: dict[str, Any]


def axes_of(asked: Sequence[str], scene: SceneFile) -> list[Axis]:
    """``part.key=1,2,5`` and ``part.key=8:200`` or ``=0.5:2:0.25``, ends included, as axes.

    Raises
    ------
    SceneError
        With the key and the value: no such part or key, no range, a value or a key twice, too many variants.
    """
    found: list[Axis] = []
    for word in asked:
        key, sign, text = (s.strip() for s in word.partition("="))
        part, _, rest = key.partition(".")
        if not sign or not rest or not text:
            raise SceneError(PLACE, word, None, "no_variation")
        if part not in scene.parts:
            raise SceneError(PLACE, key, text, "no_such_part", meant(part, scene.parts), known=list(scene.parts))
        if any(axis.key == key for axis in found):
            raise SceneError(PLACE, key, text, "given_twice")
        axis = Axis(key, _counted(key, tuple(_values(key, text)), scene))
        for i, value in enumerate(axis.values):
            if value in axis.values[:i]:
                raise SceneError(PLACE, key, value, "listed_twice")
        refusal = _refusal(key, axis.values[0], scene)
        # what a value does is the variant's
        if refusal is not None and refusal.code in ("unknown_key", "not_a_table"):
            raise refusal
        found.append(axis)
    if (count := prod(len(axis.values) for axis in found)) > MOST_VARIANTS:
        raise SceneError(PLACE, " ".join(asked), None, "too_many_variants", count=count, most=MOST_VARIANTS)
    return found


def variants(scene: SceneFile, axes: Sequence[Axis]) -> Iterator[Variant]:
    """Every choice, the last axis the fastest."""
    kept = resolved(scene)
    for choice in product(*(zip(axis.values, _names(axis), strict=True) for axis in axes)):
        values = {axis.key: value for axis, (value, _) in zip(axes, choice, strict=True)}
        yield Variant(",".join(name for _, name in choice), values, _with(kept, values))


def _values(key: str, text: str) -> Iterator[Any]:
    """The values of a list of values and ranges."""
    if isinstance(listed := toml_value(f"[{text}]"), list):
        yield from listed
        return
    for piece in text.split(","):
        if not piece.strip():
            raise SceneError(PLACE, key, text, "no_variation")
        if match := _RANGE.match(piece):
            yield from _range(key, piece, [m for m in match.groups() if m is not None])
        else:
            yield toml_value(piece.strip())


def _range(key: str, text: str, ends: Sequence[str]) -> list[Any]:
    """From, to, and the step or 1, in decimal digits: 0.1 ten times is 1."""
    first, last, step = (Decimal(e) for e in (*ends, "1")[:3])
    try:
        steps = (last - first) / step if step > 0 else Decimal(-1)
    except ArithmeticError:
        # beyond what even decimal numbers hold
        steps = Decimal(-1)
    if not 0 <= steps < MOST_VARIANTS:
        raise SceneError(PLACE, key, text.strip(), "no_range", most=MOST_VARIANTS)
    # a step that was typed may pass over the end; steps of 1 that nobody typed may not
    if len(ends) == 2 and steps != int(steps):
        raise SceneError(
            PLACE, key, text.strip(), "range_misses_end", Nearest(f"{ends[0]}:{first + int(steps)}", "meant")
        )
    number = int if all(re.fullmatch(r"[+-]?\d+", e) for e in ends) else float
    return [number(first + k * step) for k in range(int(steps) + 1)]


def _counted(key: str, values: tuple[Any, ...], scene: SceneFile) -> tuple[Any, ...]:
    """Values of a key; where it takes whole numbers only, those that are whole as such: 8 of 8:9:0.5."""
    whole = [value for value in values if isinstance(value, float) and value.is_integer()]
    refusals = [_refusal(key, value, scene) for value in (*whole[:1], *map(int, whole[:1]))]
    if [error is not None and error.code == "wrong_type_of" for error in refusals] != [True, False]:
        return values
    return tuple(int(value) if value in whole else value for value in values)


def _refusal(key: str, value: object, scene: SceneFile) -> SceneError | None:
    """Why a key may not take a value."""
    try:
        scene_from_resolved(_with(resolved(scene), {key: value}), PLACE)
    except SceneError as error:
        return error
    return None


def _with(scene: dict[str, Any], values: dict[str, Any]) -> dict[str, Any]:
    """A copy of a resolved scene with other values."""
    made = deepcopy(scene)
    for key, value in values.items():
        table = made["parts"]
        *path, name = key.split(".")
        for step in path:
            if table.get(step) is None:
                table[step] = {}
            elif not isinstance(table[step], dict):
                raise SceneError(PLACE, key, value, "unknown_key", known=list(table))
            table = table[step]
        table[name] = value
    return made


def _names(axis: Axis) -> list[str]:
    """Of each value ``key=value`` as a part of a folder's name; with a hash where letters had to go.

    So has one that differs from a value before it in case alone, or ends in a dot: folders of some systems do not.
    """
    names: list[str] = []
    taken = set[str]()
    for value in axis.values:
        told = f"{axis.key}={value}"
        name = re.sub(r"[^A-Za-z0-9.+=_-]", "_", told)[:_MOST_LETTERS]
        if name != told or name.lower() in taken or name.endswith("."):
            name = f"{name}-{hashlib.sha256(told.encode()).hexdigest()[:8]}"
        taken.add(name.lower())
        names.append(name)
    return names

"""What a refusal offers, as changes of a scene's plain tables: read from its text, tried, and told.

A place is a tuple of keys and indices, ``("parts", "cam", "phases", 0, "law")`` for ``parts.cam.phases.item 1.law``.
"""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import msgspec
from msgspec import Struct

from geometry.errors import format_value
from parts.schema import SceneError

Place = tuple[str | int, ...]
# in place of a value: the key is taken away
REMOVED: Any = object()

_NUMBER = r"-?\d[\d.]*(?:e[+-]?\d+)?"
_UNIT = r"(?: (?:mm|degrees|modules))?"
_VALUE = rf'(?:"[^"]*"|\[[^\]]*\]|true|false|{_NUMBER})'
_OWN = re.compile(rf"(?:at most |at least )?({_VALUE}){_UNIT},? (?:teeth work|works|work)\b.*")
_OTHER = re.compile(rf"(\w[\w.]*) = ({_VALUE}){_UNIT} (?:works|joins these two)")
_TOGETHER = re.compile(r"with (.*) it works")
_MEANT = re.compile(r"\(did you mean (.*?)\?\)")
_NAME = re.compile(r"([A-Za-z][\w-]*) works")
# pieces of a refusal that say what to do
_REMEDY = re.compile(
    r"^(?:at most|at least|above|below|less than|more than|with |another |other |a (?:smaller|larger|longer|law)|less |"
    r"longer |remove |make it |change |give only |"
    r"no other value near it )|\b(?:works?|work with \w+|works either way|joins these two)\b|^name "
)


@dataclass(frozen=True, slots=True)
class Change:
    """One key of a scene with another value, or without it."""

    place: Place
    value: Any

    @property
    def label(self) -> str:
        """As it stands among several."""
        name = told_place(self.place).partition(".")[2].partition(".")[2]
        return f"no {name}" if self.value is REMOVED else f"{name} = {shown(self.value)}"


def place_of(key: str) -> Place:
    """The place that a refusal names; empty where it names none."""
    found: list[str | int] = []
    for word in filter(None, key.rpartition(": ")[2].split(".")):
        if item := re.fullmatch(r"item (\d+)", word):
            found.append(int(item[1]) - 1)
        elif listed := re.fullmatch(r"(\w+)\[(\d+)\]", word):
            found += [listed[1], int(listed[2]) - 1]
        else:
            found.append(word)
    return tuple(found)


def told_place(place: Place) -> str:
    """The key as refusals write it."""
    text = ""
    for index, word in enumerate(place):
        listed = index == 1 and isinstance(word, int)
        text += f"[{word + 1}]" if listed else f".item {word + 1}" if isinstance(word, int) else f".{word}"  # type: ignore[operator]
    return text.removeprefix(".")


def shown(value: Any) -> str:
    """A value as it stands in a scene."""
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(shown, value))}]"
    return format_value(value)


def value_at(raw: Any, place: Place) -> Any:
    """What stands at a place; None where there is nothing."""
    for word in place:
        if isinstance(raw, dict):
            raw = raw.get(word)
        elif isinstance(raw, list) and isinstance(word, int) and 0 <= word < len(raw):
            raw = raw[word]
        else:
            return None
    return raw


def changed(raw: Any, changes: Sequence[Change]) -> Any:
    """The tables with changes; the last ones of a list first, so that places stay."""
    made = copy.deepcopy(raw)
    for change in sorted(changes, key=lambda c: tuple(map(str, c.place)), reverse=True):
        owner: Any = made
        last: Any = change.place[-1]
        for word in change.place[:-1]:
            if isinstance(owner, dict):
                owner = owner.setdefault(word, {})
            elif isinstance(owner, list) and isinstance(word, int) and word < len(owner):
                owner = owner[word]
            else:
                return made
        if not isinstance(owner, dict | list) or (isinstance(owner, list) and not isinstance(last, int)):
            return made
        if change.value is REMOVED:
            if isinstance(owner, list) or last in owner:
                del owner[last]
        elif isinstance(owner, dict) or (isinstance(last, int) and last < len(owner)):
            owner[last] = change.value
    return made


def offers_in(refusal: SceneError, raw: Any) -> Iterator[list[Change]]:
    """The changes that a refusal's text offers, each alternative for itself."""
    place = place_of(refusal.key)
    for piece in refusal.remedy.split("; "):
        if meant := _MEANT.search(piece):
            held = value_at(raw, place)
            listed = [meant[1] if v == refusal.value else v for v in held] if isinstance(held, list) else meant[1]
            yield _renamed(raw, place, meant[1]) if piece.startswith("unknown key") else [Change(place, listed)]
        if own := _OWN.fullmatch(piece):
            yield [Change(place, _like(own[1], value_at(raw, place)))]
        elif other := _OTHER.fullmatch(piece):
            yield [Change(_sibling(raw, place, other[1]), _like(other[2], None))]
        elif together := _TOGETHER.fullmatch(piece):
            yield [_labelled(raw, place, item) for item in re.split(r", (?=no |\w[\w. ]* = )", together[1])]
        elif piece == "remove it":
            yield [Change(place, REMOVED)]
        elif named := _NAME.fullmatch(piece):
            yield [Change(place, named[1])]


def _renamed(raw: Any, place: Place, name: str) -> list[Change]:
    return [Change(place, REMOVED), Change((*place[:-1], name), value_at(raw, place))]


def _labelled(raw: Any, place: Place, item: str) -> Change:
    name, sign, value = item.removeprefix("no ").partition(" = ")
    inner = place_of(name)
    return Change((*place[:2], *inner), _like(value, value_at(raw, (*place[:2], *inner))) if sign else REMOVED)


def _sibling(raw: Any, place: Place, name: str) -> Place:
    """Another key: beside the blamed one, or counted from the part."""
    inner = place_of(name)
    beside = (*place[:-1], *inner)
    return beside if value_at(raw, beside) is not None or len(place) <= 3 else (*place[:2], *inner)


def _like(text: str, old: Any) -> Any:
    value = json.loads(text) if text[0] in '"[tf' else float(text)
    if isinstance(value, float) and (isinstance(old, int) or (old is None and text.lstrip("-").isdigit())):
        return round(value)
    return value


def reason_of(remedy: str) -> str:
    """A refusal without what it offers."""
    kept = []
    for piece in remedy.split("; "):
        why, colon, what = piece.rpartition(": ")
        if not _REMEDY.search(piece):
            kept.append(piece)
        elif colon and _REMEDY.search(what):
            # the reason and what to do in one piece
            kept.append(why)
    # what a list of choices says is a reason too
    choices = [piece for piece in remedy.split("; ") if piece.startswith(("one of ", "between ", "each "))]
    return "; ".join([*kept, *(c.removesuffix(" works").removesuffix(" work") for c in choices if c not in kept)])


def typed(value: Any) -> Any:
    """A scene's structs as plain tables of what its file says: keys that stand at their defaults are left out."""
    if isinstance(value, Struct):
        config = value.__struct_config__
        made = {config.tag_field: config.tag} if config.tag_field else {}
        for field in msgspec.structs.fields(value):
            held = getattr(value, field.name)
            if field.required or held != _default(field):
                made[field.encode_name] = typed(held)
        return made
    if isinstance(value, dict):
        return {key: typed(item) for key, item in value.items()}
    return [typed(item) for item in value] if isinstance(value, list | tuple) else value


def _default(field: msgspec.structs.FieldInfo) -> Any:
    return field.default if field.default_factory is msgspec.NODEFAULT else field.default_factory()


def typed_scene(scene: Any) -> dict[str, Any]:
    """The plain tables of a scene that was read."""
    raw: dict[str, Any] = typed(scene)
    raw.pop("name", None)
    placed = raw.get("instances", {})
    raw["instances"] = {k: v for k, v in placed.items() if k not in scene.parts or len(v) > 1}
    return raw

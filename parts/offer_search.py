"""The search for an offer that works: first what the refusal says, then other values of what the scene says."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator
from itertools import chain
from typing import Any

import msgspec

from geometry.errors import GeometryError, at_least, at_most
from geometry.trial import trial
from parts.key_types import KeyType, coarse, is_number, key_type, trials
from parts.kinds import KINDS
from parts.mates import MATES, mated
from parts.offers import (
    REMOVED,
    Change,
    Place,
    changed,
    offers_in,
    place_of,
    reason_of,
    shown,
    told_place,
    typed_scene,
    value_at,
)  # fmt: skip
from parts.schema import SceneError

# scenes that are tried before the search gives up; those that cams refuse late take longest
_BUDGET = 500
# of the processor; nobody waits longer for a refusal
_SECONDS = 3.0
_BISECTIONS = 14
# keys that hold the names of others
_NAMES = ("first", "second", "instance", "part", "of")
# what changes nothing that a refusal could be about
_IDLE = ("kind", "move", "material", "density", "colour", "title", "language", *_NAMES)
# changed only where nothing else helps
_LAST = ("module", "number_of_teeth", "pressure_angle_deg", "face_width")
_FAULTS = (GeometryError, ArithmeticError, ValueError)


def sure_refusal(scene: Any, refusal: SceneError) -> SceneError:
    """The refusal itself if what it offers works, else one that offers what does; it where nothing was found.

    ``scene``: the plain tables that were read, or the scene of which no parts could be made.
    """
    raw = scene if isinstance(scene, dict) else typed_scene(scene)
    place = place_of(refusal.key)
    if len(place) < 3 or not isinstance(value_at(raw, place[:2]), dict):
        return refusal
    tried = _Tried(raw, place)
    told = list(offers_in(refusal, raw))
    if told and all(tried.whole(offer) for offer in told):
        return _noted(refusal, raw, place)
    found = _found(raw, place, tried.whole)
    tried.more()
    if found is None and told and all(tried.here(offer) for offer in told):
        return _noted(refusal, raw, place)
    if found is None and tried.nearly is not None:
        (change,) = tried.nearly
        found = _refined(raw, change, tried.here)
    return _noted(refusal if found is None else _offered(refusal, raw, place, *found), raw, place)


class _Tried:
    """Trials of a scene with changes; parts that were tried already are not checked again."""

    def __init__(self, raw: dict[str, Any], place: Place) -> None:
        self.raw, self.place = raw, place
        self.known: dict[bytes, Any] = {}
        # the first single change that at least cures the refused part
        self.nearly: list[Change] | None = None
        self.more(_BUDGET, _SECONDS)

    def more(self, trials: int = 60, seconds: float = 1.0) -> None:
        """Room for more trials."""
        self.left, self.until = trials, time.process_time() + seconds

    def whole(self, changes: list[Change]) -> bool:
        """Whether the whole scene builds."""
        refused = self._refused(changes)
        cured = refused is not None and self._is_other(changes, refused)
        if cured and self.nearly is None and len(changes) == 1:
            self.nearly = changes
        return refused is None

    def here(self, changes: list[Change]) -> bool:
        """Whether at least the refused part, mate or table is all right: others have faults of their own."""
        refused = self._refused(changes)
        return refused is None or self._is_other(changes, refused)

    def _is_other(self, changes: list[Change], refused: Place) -> bool:
        """Whether another fault is left: elsewhere, or of another key than the one that was blamed and changed."""
        own = (
            bool(changes)
            and changes[0].place[: len(self.place)] == self.place
            and refused != self.place[: len(refused)]
        )
        return own or refused[:2] not in (self.place[:2], *(c.place[:2] for c in changes))

    def _refused(self, changes: list[Change]) -> Place | None:
        if self.left <= 0 or time.process_time() > self.until:
            return self.place
        self.left -= 1
        with trial():
            try:
                self._make(changed(self.raw, changes))
            except SceneError as refusal:
                return place_of(refusal.key)
            except _FAULTS:
                return self.place
        return None

    def _make(self, raw: dict[str, Any]) -> None:
        """What ``make_parts`` checks, with the parts that are the same as before taken from memory."""
        from parts.mate_checks import check_helices, check_kinds, pair_refused
        from parts.scene import scene_from_dict

        scene = scene_from_dict(raw, "", "tried")
        gears: dict[str, Any] = {}
        for key, spec in sorted(scene.parts.items(), key=lambda item: hasattr(item[1], "of")):
            gears[key] = self._checked(key, spec, scene.parts)
        part_of = {key: str(spec.part) for key, spec in scene.instances.items()}
        helices = {key: _helix(spec) for key, spec in scene.parts.items()}
        for index, mate in enumerate(scene.mates):
            check_kinds(scene, mate, part_of, "", f"mates[{index + 1}]")
            check_helices(scene, mate, part_of, "", f"mates[{index + 1}]")
            try:
                mated(gears, [mate], part_of, helices)
            except GeometryError as refusal:
                raise pair_refused(scene, refusal, (gears, mate, part_of), "", f"mates[{index + 1}]") from refusal  # type: ignore[arg-type]
        mated(gears, scene.mates, part_of, helices)

    def _checked(self, key: str, spec: Any, parts: dict[str, Any]) -> Any:
        """A part's check, or its refusal, as the first time."""
        owner = parts.get(getattr(spec, "of", ""))
        known = msgspec.json.encode((spec, owner))
        if known not in self.known:
            check = KINDS[spec.__struct_config__.tag][1]
            try:
                self.known[known] = check(spec, parts) if hasattr(spec, "of") else check(spec)
            except _FAULTS as fault:
                self.known[known] = fault
        made = self.known[known]
        if isinstance(made, Exception):
            raise SceneError("", f"parts.{key}.{getattr(made, 'name', '')}", None, "") from made
        return made


def _helix(spec: Any) -> float:
    return math.radians(abs(getattr(spec, "helix_angle_deg", 0.0)))


Builds = Callable[[list[Change]], bool]
Values = Callable[[Any, KeyType], Iterable[Any]]


def _found(raw: dict[str, Any], place: Place, builds: Builds) -> tuple[list[Change], str] | None:
    """Changes that work, and the words for their number."""
    own, *others = _keys(raw, place)
    held = [k for k in others if k[: len(own)] == own]
    # whether another key matters at all shows soon; what does not is tried at length last
    ways: list[tuple[Values, Place]] = [(trials, k) for k in (own, *held)]
    ways += [(values, k) for values in (coarse, trials) for k in others if k not in held]
    for values, one in ways:
        found = _one(raw, one, values, builds)
        if found is not None:
            return found
    return _same_words(raw, place, builds) or _resets(raw, place, builds)


def _one(raw: dict[str, Any], place: Place, values: Values, builds: Builds) -> tuple[list[Change], str] | None:
    """Another value of one key, or none; the nearest number that works."""
    key, value = _type_of(raw, place), value_at(raw, place)
    if key is None:
        return None
    key.words = tuple(sorted(key.words, key=lambda w: w not in _USUAL_WORDS)) if place[-1] == "law" else key.words
    if place[-1] in _NAMES:
        key.words = tuple(raw["parts"]) + tuple(k for k in raw.get("instances", {}) if place[0] != "parts")
    tried = chain(_closing(raw, place), _namesakes(raw, place, key), values(value, key))
    good = next((v for v in tried if builds([Change(place, v)])), None)
    if good is None:
        loose = key.optional or isinstance(place[-1], int)
        if value is not None and loose and builds([Change(place, REMOVED)]):
            return [Change(place, REMOVED)], ""
        return None
    return _refined(raw, Change(place, good), builds)


def _refined(raw: dict[str, Any], change: Change, builds: Builds) -> tuple[list[Change], str]:
    """A change that works with its number as near to the refused one as works too, and the words for it."""
    place, good = change.place, change.value
    key, value = _type_of(raw, place), value_at(raw, place)
    plain = is_number(value)
    if key is None or not key.number or not plain or isinstance(good, str | bool) or not isinstance(good, int | float):
        return [change], ""
    if place[-1] == "angle_deg":
        return [change], ""
    if key.whole:
        return [change], "at most " if good < value else "at least "
    return _nearest(place, float(value), float(good), key, builds)


def _namesakes(raw: dict[str, Any], place: Place, key: KeyType) -> list[Any]:
    """What keys of the same name hold elsewhere in the scene: parts that belong together share their sizes."""
    if not isinstance(place[-1], str) or len(place) != 3 or not key.number:
        return []
    found = [t.get(place[-1]) for name, t in raw["parts"].items() if name != place[1] and isinstance(t, dict)]
    value = value_at(raw, place)
    return [
        v for v in dict.fromkeys(v for v in found if v is not None and is_number(v)) if v != value and key.allows(v)
    ]


def _closing(raw: dict[str, Any], place: Place) -> Iterator[float]:
    """The angle of a phase that fills the turn."""
    phases = value_at(raw, place[:-2])
    if place[-1] == "angle_deg" and isinstance(phases, list) and isinstance(place[-2], int):
        held = [p.get("angle_deg") for k, p in enumerate(phases) if k != place[-2] and isinstance(p, dict)]
        angles = [float(a) for a in held if isinstance(a, int | float) and is_number(a)]
        if len(angles) == len(held):
            yield round(360.0 - math.fsum(angles), 9)


def _nearest(place: Place, value: float, good: float, key: KeyType, builds: Builds) -> tuple[list[Change], str]:
    """The number nearest to a refused one, in as few digits as work."""
    way = "at most " if good < value else "at least "
    rounded = at_most if good < value else at_least
    near, far = good, value
    if key.allows(value):
        for _ in range(_BISECTIONS):
            if abs(far - near) <= 2e-4 * abs(near):
                break
            middle = (near + far) / 2
            near, far = (middle, far) if builds([Change(place, middle)]) else (near, middle)
    if near == good and key.allows(value):
        # no other one comes nearer: it has to be this
        way = ""
    for digits in (1, 2, 4, 6, 9):
        told = float(rounded(near, digits))
        if abs(told - near) <= 2e-3 * abs(near) and key.allows(told) and builds([Change(place, told)]):
            return [Change(place, told)], way
    return [Change(place, near)], way


# words that come first in their turn
_USUAL_WORDS = ("sine", "polynomial_345", "polynomial_4567", "modified_sine")


def _type_of(raw: dict[str, Any], place: Place) -> KeyType | None:
    """The type of a key of a part, a mate, an export."""
    table = value_at(raw, place[:2])
    kind = table.get("kind") if isinstance(table, dict) else None
    if not isinstance(kind, str):
        kind = ""
    if place[0] == "parts" and kind in KINDS:
        return key_type(KINDS[kind][0], place[2:], table)
    if place[0] == "mates" and kind in MATES:
        return key_type(MATES[kind], place[2:], table)
    if place[0] == "exports":
        from parts.scene import ExportSpec

        return key_type(ExportSpec, place[2:], table)
    return None


def _keys(raw: dict[str, Any], place: Place) -> list[Place]:
    """Keys in the order in which a change is offered: the blamed one, what it holds, its table, what else was said."""
    owners = [place[:2], *_mated_with(raw, place[:2])]
    leaves = [leaf for owner in owners for leaf in _leaves(value_at(raw, owner), owner)]

    def rank(leaf: Place) -> tuple[Any, ...]:
        return (
            leaf[:2] != place[:2],
            leaf[: len(place)] != place,
            not isinstance(value_at(raw, leaf), int | float),
            len(leaf) == 3 and leaf[-1] in _LAST,
            leaf[: len(place) - 1] != place[:-1],
            leaf[:3] != place[:3],
        )

    found = [leaf for leaf in sorted(leaves, key=rank) if leaf != place]
    return [place, *found]


def _leaves(table: Any, place: Place) -> Iterator[Place]:
    """Every key of a table that holds a value, then those that hold tables."""
    if isinstance(table, dict):
        for name, value in table.items():
            if name not in _IDLE:
                yield from _leaves(value, (*place, name))
    elif isinstance(table, list) and len(table) <= 12:
        for index, value in enumerate(table):
            yield from _leaves(value, (*place, index))
    if len(place) > 2:
        yield place


def _mated_with(raw: dict[str, Any], owner: Place) -> list[Place]:
    """What a part is joined with or made from, or what a mate joins."""
    mates = [m for m in raw.get("mates", []) if isinstance(m, dict)]
    if owner[0] == "mates":
        mate = value_at(raw, owner)
        return [_part_of(raw, mate.get(key)) for key in ("second", "first")] if isinstance(mate, dict) else []
    found: list[Place] = []
    table = value_at(raw, owner)
    if isinstance(table, dict) and isinstance(table.get("of"), str):
        found.append(("parts", table["of"]))
    for index, mate in enumerate(mates):
        ends = [_part_of(raw, mate.get(key)) for key in ("second", "first")]
        if owner in ends:
            found += [("mates", index), *(e for e in ends if e != owner)]
    return [p for p in dict.fromkeys(found) if p != owner]


def _part_of(raw: dict[str, Any], instance: Any) -> Place:
    own = value_at(raw, ("instances", str(instance), "part"))
    return ("parts", own if isinstance(own, str) else str(instance))


def _same_words(raw: dict[str, Any], place: Place, builds: Builds) -> tuple[list[Change], str] | None:
    """One word for all keys of a name, as the law of every phase."""
    leaves = list(_leaves(value_at(raw, place[:2]), place[:2]))
    for name in dict.fromkeys(leaf[-1] for leaf in leaves):
        same = [leaf for leaf in leaves if leaf[-1] == name and isinstance(name, str)]
        key = _type_of(raw, same[0]) if len(same) > 1 else None
        for word in key.words if key is not None else ():
            changes = [Change(leaf, word) for leaf in same if value_at(raw, leaf) != word]
            if builds(changes):
                return changes, ""
    return None


def _resets(raw: dict[str, Any], place: Place, builds: Builds) -> tuple[list[Change], str] | None:
    """The fewest keys that work when they are left out together."""
    table = value_at(raw, place[:2])
    tops = [(*place[:2], name) for name in table if name not in _IDLE]
    free = [Change(p, REMOVED) for p in tops if (key := _type_of(raw, p)) is not None and key.optional]
    if not free or not builds(free):
        return None
    for change in tuple(free):
        fewer = [c for c in free if c is not change]
        free = fewer if builds(fewer) else free
    return free, ""


def _offered(refusal: SceneError, raw: dict[str, Any], place: Place, changes: list[Change], way: str) -> SceneError:
    """The refusal with changes that work in place of what it said."""
    reason = reason_of(refusal.remedy) or _first_words(refusal.remedy)
    # a key that does not exist, or stands in a table that works as a whole only, stays the one to blame
    above = changes[0].place == place[: len(changes[0].place)]
    foreign = (refusal.remedy.startswith("unknown key") or above) and changes[0].place != place
    if len(changes) > 1 or foreign:
        return SceneError(
            refusal.source, refusal.key, refusal.value, f"{reason}; with {', '.join(c.label for c in changes)} it works"
        )
    (change,) = changes
    key = _type_of(raw, change.place)
    unit = f" {key.unit}" if key is not None and key.number and key.unit in ("mm", "degrees") else ""
    told = "remove it" if change.value is REMOVED else f"{way}{shown(change.value)}{unit} works"
    if change.place == place:
        return SceneError(refusal.source, refusal.key, refusal.value, f"{reason}; {told}")
    blamed = refusal.key.rpartition(": ")[2]
    own = blamed.removeprefix(told_place(place[:2]) + ".") if change.place[:2] == place[:2] else blamed
    value = value_at(raw, change.place)
    value = None if isinstance(value, dict | list) else value
    return SceneError(refusal.source, told_place(change.place), value, f"{own}: {reason}; {told}")


def _first_words(remedy: str) -> str:
    """The reason of a refusal that says no more than what should stand there."""
    first = remedy.partition("; ")[0]
    if first.startswith(("at most", "at least", "remove", "with", "a ", "another")):
        return "does not fit the other keys"
    return first.removesuffix(" works").removesuffix(" work")


def _noted(refusal: SceneError, raw: dict[str, Any], place: Place) -> SceneError:
    """A refusal of a value that nobody typed says so."""
    now = place_of(refusal.key)
    silent = refusal.value is None or value_at(raw, now) is not None
    if silent or refusal.remedy.startswith(("not given", "is missing")):
        return refusal
    key = _type_of(raw, now)
    is_default = key is not None and key.default is not None and key.default == refusal.value
    note = "is the default, not given" if is_default else "not given, it follows from the other keys"
    return SceneError(refusal.source, refusal.key, refusal.value, f"{note}; {refusal.remedy}")

"""The search for an offer that works: first what the refusal says, then other values of what the scene says."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable
from itertools import chain
from typing import Any

import msgspec

from geometry.errors import GeometryError
from geometry.trial import following, is_followed, trial
from parts.key_types import KeyType, coarse, is_number, trials
from parts.kinds import KINDS
from parts.mates import mated
from parts.offer_several import (
    NAMES,
    USUAL_WORDS,
    Builds,
    closing,
    followed,
    leaves,
    nearest,
    resets,
    rows_added,
    same_words,
    shared_turn,
    together,
    type_of,
)  # fmt: skip
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
# a base circle so many times as large as the typed one makes a cam that nobody wants
_FAR = 10.0
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
        return _noted(_bettered(refusal, raw, place, told, tried), raw, place)
    found = _found(raw, place, tried.whole)
    if found is None and "works with another" not in refusal.remedy:
        found = _several(raw, place, told, tried)
    tried.more()
    if found is None and told and all(tried.here(offer) for offer in told):
        return _noted(refusal, raw, place)
    if found is not None and (smaller := _smaller(refusal, raw, place, found[0], tried)):
        return _noted(smaller, raw, place)
    if found is None and (nearly := tried.nearly()):
        (change,) = nearly[0]
        found = _refined(raw, change, tried.here)
    same = found is None or found[0] in told
    return _noted(refusal if found is None or same else _offered(refusal, raw, place, *found), raw, place)


def _bettered(
    refusal: SceneError, raw: dict[str, Any], place: Place, told: list[list[Change]], tried: _Tried
) -> SceneError:
    """A refusal whose offers work, with nearer numbers of several keys, or another law in place of a giant cam."""
    if len(told) > 1:
        return refusal
    if len(told[0]) > 1:
        near = together(raw, told[0], tried.whole)
        return refusal if near == told[0] else _offered(refusal, raw, place, near, "")
    return _smaller(refusal, raw, place, told[0], tried) or refusal


def _smaller(
    refusal: SceneError, raw: dict[str, Any], place: Place, found: list[Change], tried: _Tried
) -> SceneError | None:
    """In place of a base circle many times as large as the typed one another law, if that works."""
    last, value = found[0], refusal.value
    giant = last.place[-1] == "base_circle_radius" and is_number(last.value) and is_number(value)
    if not giant or len(found) > 1 or last.place != place or not last.value > _FAR * value:  # type: ignore[operator]
        return None
    laws = same_words(raw, place, tried.whole, ("law",))
    return None if laws is None else _offered(refusal, raw, place, *laws)


def _several(
    raw: dict[str, Any], place: Place, told: list[list[Change]], tried: _Tried
) -> tuple[list[Change], str] | None:
    """Changes of several keys that work together."""
    tried.more(80, 1.5)
    # laws once more: of slow kinds the time was up before them
    found = same_words(raw, place, tried.whole, ("law",)) or shared_turn(raw, place, tried.whole)
    if found is None:
        starts = [offer for offer in [*told, *tried.nearly()] if tried.here(offer)]
        made = followed(raw, place, starts, tried.left)
        tried.more(80, 1.5)
        found = (made, "") if made is not None and tried.part_right(made) else resets(raw, place, tried.whole)
    if found is not None and len(found[0]) > 1 and not isinstance(found[0][0].value, str):
        tried.more(80, 1.5)
        found = together(raw, found[0], tried.part_right), ""
    return found


class _Tried:
    """Trials of a scene with changes; parts that were tried already are not checked again."""

    def __init__(self, raw: dict[str, Any], place: Place) -> None:
        self.raw, self.place = raw, place
        self.known: dict[tuple[bool, bytes], Any] = {}
        # single changes that at least cure what was blamed, the first for each key that is blamed then
        self.cured: dict[Place, list[Change]] = {}
        self.more(_BUDGET, _SECONDS)

    def more(self, trials: int = 60, seconds: float = 1.0) -> None:
        """Room for more trials."""
        self.count, self.until = trials, time.process_time() + seconds

    def whole(self, changes: list[Change]) -> bool:
        """Whether the whole scene builds."""
        refused = self._refused(changes)
        cured = refused is not None and self._is_other(changes, refused)
        if cured and refused is not None and len(changes) == 1:
            self.cured.setdefault(refused, changes)
        return refused is None

    def nearly(self) -> list[list[Change]]:
        """Single changes that at least cure what was blamed."""
        return list(self.cured.values())

    def here(self, changes: list[Change]) -> bool:
        """Whether at least the refused part, mate or table is all right: others have faults of their own."""
        refused = self._refused(changes)
        return refused is None or self._is_other(changes, refused)

    def part_right(self, changes: list[Change]) -> bool:
        """Whether nothing of the refused part or mate is wrong any more."""
        refused = self._refused(changes)
        return refused is None or refused[:2] not in (self.place[:2], *(c.place[:2] for c in changes))

    def _is_other(self, changes: list[Change], refused: Place) -> bool:
        """Whether another fault is left: elsewhere, or of another key than the one that was blamed and changed."""
        own = (
            bool(changes)
            and changes[0].place[: len(self.place)] == self.place
            and refused != self.place[: len(refused)]
        )
        return own or refused[:2] not in (self.place[:2], *(c.place[:2] for c in changes))

    def _refused(self, changes: list[Change]) -> Place | None:
        if self.count <= 0 or time.process_time() > self.until:
            return self.place
        self.count -= 1
        with trial():
            try:
                self._make(changed(self.raw, changes))
            except SceneError as refusal:
                return place_of(refusal.key)
            except _FAULTS:
                return self.place
        return None

    def left(self, changes: list[Change]) -> SceneError | None:
        """What is refused after changes, with what it offers by itself; None where nothing is."""
        if self.count <= 0 or time.process_time() > self.until:
            return SceneError("", told_place(self.place), None, "")
        self.count -= 1
        with following():
            try:
                self._make(changed(self.raw, changes))
            except SceneError as refusal:
                return refusal
            except _FAULTS:
                return SceneError("", told_place(self.place), None, "")
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
        # followed refusals say more
        known = is_followed(), msgspec.json.encode((spec, owner))
        if known not in self.known:
            check = KINDS[spec.__struct_config__.tag][1]
            try:
                self.known[known] = check(spec, parts) if hasattr(spec, "of") else check(spec)
            except _FAULTS as fault:
                self.known[known] = fault
        made = self.known[known]
        if isinstance(made, Exception):
            name, value, allowed = (getattr(made, word, "") for word in ("name", "value", "allowed"))
            raise SceneError("", f"parts.{key}.{name}", value, allowed) from made
        return made


def _helix(spec: Any) -> float:
    return math.radians(abs(getattr(spec, "helix_angle_deg", 0.0)))


Values = Callable[[Any, KeyType], Iterable[Any]]


def _found(raw: dict[str, Any], place: Place, builds: Builds) -> tuple[list[Change], str] | None:
    """Changes that work, and the words for their number."""
    own, *others = _keys(raw, place)
    if type_of(raw, own) is None and value_at(raw, own) is not None and builds([Change(own, REMOVED)]):
        # no key at all
        return [Change(own, REMOVED)], ""
    held = [k for k in others if k[: len(own)] == own]
    # whether another key matters at all shows soon; what does not is tried at length last
    ways: list[tuple[Values, Place]] = [(trials, k) for k in (own, *held)]
    ways += [(values, k) for values in (coarse, trials) for k in others if k not in held]
    for values, one in ways:
        found = _one(raw, one, values, builds)
        if found is not None:
            return found
    return same_words(raw, place, builds)


def _one(raw: dict[str, Any], place: Place, values: Values, builds: Builds) -> tuple[list[Change], str] | None:
    """Another value of one key, or none; the nearest number that works."""
    key, value = type_of(raw, place), value_at(raw, place)
    if key is None:
        return None
    key.words = tuple(sorted(key.words, key=lambda w: w not in USUAL_WORDS)) if place[-1] == "law" else key.words
    if place[-1] in NAMES:
        key.words = tuple(raw["parts"]) + tuple(k for k in raw.get("instances", {}) if place[0] != "parts")
    tried = chain(closing(raw, place), rows_added(raw, place), _namesakes(raw, place, key), values(value, key))
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
    key, value = type_of(raw, place), value_at(raw, place)
    plain = is_number(value)
    if key is None or not key.number or not plain or isinstance(good, str | bool) or not isinstance(good, int | float):
        return [change], ""
    if place[-1] == "angle_deg":
        return [change], ""
    if key.whole:
        return [change], "at most " if good < value else "at least "
    return nearest(place, float(value), float(good), key, builds)


def _namesakes(raw: dict[str, Any], place: Place, key: KeyType) -> list[Any]:
    """What keys of the same name hold elsewhere in the scene: parts that belong together share their sizes."""
    if not isinstance(place[-1], str) or len(place) != 3 or not key.number:
        return []
    found = [t.get(place[-1]) for name, t in raw["parts"].items() if name != place[1] and isinstance(t, dict)]
    value = value_at(raw, place)
    return [
        v for v in dict.fromkeys(v for v in found if v is not None and is_number(v)) if v != value and key.allows(v)
    ]


def _keys(raw: dict[str, Any], place: Place) -> list[Place]:
    """Keys in the order in which a change is offered: the blamed one, what it holds, its table, what else was said."""
    owners = [place[:2], *_mated_with(raw, place[:2])]
    held = [leaf for owner in owners for leaf in leaves(value_at(raw, owner), owner)]

    def rank(leaf: Place) -> tuple[Any, ...]:
        return (
            leaf[:2] != place[:2],
            leaf[: len(place)] != place,
            not isinstance(value_at(raw, leaf), int | float),
            len(leaf) == 3 and leaf[-1] in _LAST,
            leaf[: len(place) - 1] != place[:-1],
            leaf[:3] != place[:3],
        )

    found = [leaf for leaf in sorted(held, key=rank) if leaf != place]
    return [place, *found]


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
    key = type_of(raw, change.place)
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
    key = type_of(raw, now)
    is_default = key is not None and key.default is not None and key.default == refusal.value
    note = "is the default, not given" if is_default else "not given, it follows from the other keys"
    return SceneError(refusal.source, refusal.key, refusal.value, f"{note}; {refusal.remedy}")

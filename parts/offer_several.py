"""Offers of several keys of a scene at once, and the places, types and nearest numbers that any offer needs."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from typing import Any

from geometry.errors import at_least, at_most
from parts.key_types import KeyType, is_number, key_type
from parts.kinds import KINDS
from parts.mates import MATES
from parts.offers import REMOVED, Change, Place, changed, offers_in, place_of, value_at
from parts.schema import SceneError

_BISECTIONS = 14
# of a number that works: below this share of it only 0 itself fails
_TINY = 1e-3
# refusals that are followed one after another, and beginnings of such ways that are tried
_STEPS, _STARTS = 4, 6
# keys that hold the names of others
NAMES = ("first", "second", "instance", "part", "of")
# what changes nothing that a refusal could be about
IDLE = ("kind", "move", "material", "density", "colour", "title", "language", *NAMES)
# words that come first in their turn
USUAL_WORDS = ("sine", "polynomial_345", "polynomial_4567", "modified_sine")

Builds = Callable[[list[Change]], bool]


def type_of(raw: dict[str, Any], place: Place) -> KeyType | None:
    """The type of a key of a part, a mate, an export, an instance, a drive."""
    table = value_at(raw, place[:2])
    kind = table.get("kind") if isinstance(table, dict) else None
    if not isinstance(kind, str):
        kind = ""
    if place[0] == "parts" and kind in KINDS:
        return key_type(KINDS[kind][0], place[2:], table)
    if place[0] == "mates" and kind in MATES:
        return key_type(MATES[kind], place[2:], table)
    if place[0] in ("exports", "instances", "drives"):
        from parts import scene

        owner: Any = {"exports": scene.ExportSpec, "instances": scene.InstanceSpec, "drives": scene.DriveSpec}[place[0]]
        return key_type(owner, place[2:], table)
    return None


def leaves(table: Any, place: Place) -> Iterator[Place]:
    """Every key of a table that holds a value, then those that hold tables."""
    if isinstance(table, dict):
        for name, value in table.items():
            if name not in IDLE:
                yield from leaves(value, (*place, name))
    elif isinstance(table, list) and len(table) <= 12:
        for index, value in enumerate(table):
            yield from leaves(value, (*place, index))
    if len(place) > 2:
        yield place


def nearest(place: Place, value: float, good: float, key: KeyType, builds: Builds) -> tuple[list[Change], str]:
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
    if value == 0 and abs(near) <= _TINY * abs(good):
        # as near to nothing as one likes: no limit worth telling
        usual = float(key.default) if is_number(key.default) else 0.0
        good = near = usual if usual and builds([Change(place, usual)]) else good
    if near == good and key.allows(value):
        # no other one comes nearer: it has to be this
        way = ""
    for digits in (1, 2, 4, 6, 9):
        told = float(rounded(near, digits))
        if abs(told - near) <= 2e-3 * abs(near) and key.allows(told) and builds([Change(place, told)]):
            return [Change(place, told)], way
    return [Change(place, near)], way


def same_words(
    raw: dict[str, Any], place: Place, builds: Builds, names: tuple[str, ...] = ()
) -> tuple[list[Change], str] | None:
    """One word for all keys of a name, as the law of every phase."""
    held = list(leaves(value_at(raw, place[:2]), place[:2]))
    for name in dict.fromkeys(leaf[-1] for leaf in held if not names or leaf[-1] in names):
        same = [leaf for leaf in held if leaf[-1] == name and isinstance(name, str)]
        key = type_of(raw, same[0]) if len(same) > 1 else None
        words = () if key is None else key.words
        for word in sorted(words, key=lambda w: w not in USUAL_WORDS) if name == "law" else words:
            changes = [Change(leaf, word) for leaf in same if value_at(raw, leaf) != word]
            if builds(changes):
                return changes, ""
    return None


def resets(raw: dict[str, Any], place: Place, builds: Builds) -> tuple[list[Change], str] | None:
    """The fewest keys that work when they are left out together."""
    table = value_at(raw, place[:2])
    tops = [(*place[:2], name) for name in table if name not in IDLE]
    free = [Change(p, REMOVED) for p in tops if (key := type_of(raw, p)) is not None and key.optional]
    if not free or not builds(free):
        return None
    for change in tuple(free):
        fewer = [c for c in free if c is not change]
        free = fewer if builds(fewer) else free
    return free, ""


def followed(
    raw: dict[str, Any], place: Place, starts: Iterable[list[Change]], left: Callable[[list[Change]], SceneError | None]
) -> list[Change] | None:
    """The fewest changes of a part after which it is all right: from each start, what is then offered is taken too.

    ``left``: the refusal of the scene with changes, with what it offers; None where there is none.
    """
    best: list[Change] | None = None
    for start in list(starts)[:_STARTS]:
        made: list[Change] = list(start)
        for _ in range(_STEPS):
            refusal = left(made)
            if refusal is None or place_of(refusal.key)[:2] != place[:2]:
                best = made if best is None or len(made) < len(best) else best
                break
            offer = next(offers_in(refusal, changed(raw, made)), None)
            if offer is None or any(c.place[:2] != place[:2] for c in offer):
                break
            made = [*(c for c in made if c.place not in [o.place for o in offer]), *offer]
    return best


def together(raw: dict[str, Any], changes: list[Change], builds: Builds) -> list[Change]:
    """Changes that work together, without those that none needs, each number as near to the typed one as works."""
    for change in tuple(changes):
        rest = [c for c in changes if c is not change]
        if rest and builds(rest):
            changes = rest
            continue
        key, value, good = type_of(raw, change.place), value_at(raw, change.place), change.value
        if key is None or not key.number or key.whole or not is_number(value) or change.place[-1] == "angle_deg":
            continue
        good = key.default if good is REMOVED else good
        if is_number(good):

            def kept(one: list[Change], rest: list[Change] = rest) -> bool:
                return builds([*rest, *one])

            (near,), _ = nearest(change.place, float(value), float(good), key, kept)
            near = change if near.value == good else near
            changes = [near if c is change else c for c in changes]
    return changes


def shared_turn(raw: dict[str, Any], place: Place, builds: Builds) -> tuple[list[Change], str] | None:
    """For a refused angle of a phase its even share of the turn, the others in proportion."""
    phases = value_at(raw, place[:-2])
    if place[-1] != "angle_deg" or not isinstance(phases, list) or not isinstance(place[-2], int):
        return None
    angles: list[Any] = [p.get("angle_deg") if isinstance(p, dict) else None for p in phases]
    others = [float(a) for k, a in enumerate(angles) if k != place[-2] and is_number(a) and a > 0]
    if not others or len(others) != len(angles) - 1:
        return None
    own = 360.0 / len(angles)
    scale = (360.0 - own) / math.fsum(others)
    shares = [float(f"{own if k == place[-2] else scale * a:.4g}") for k, a in enumerate(angles)]
    shares[-1] = round(360.0 - math.fsum(shares[:-1]), 9)
    changes = [Change((*place[:-2], k, "angle_deg"), v) for k, v in enumerate(shares) if v != angles[k]]
    return (changes, "") if builds(changes) else None


def rows_added(raw: dict[str, Any], place: Place) -> Iterator[list[list[float]]]:
    """A motion table that is too short with rows between its last one and the end of the turn."""
    table = value_at(raw, place)
    if place[-1] != "motion_table" or not isinstance(table, list) or not 1 <= len(table) <= 2:
        return
    if all(isinstance(row, list) and len(row) == 2 and all(is_number(v) for v in row) for row in table):
        rows = [[float(a), float(s)] for a, s in table]
        while len(rows) < 3:
            (angle, lift), first = rows[-1], rows[0][1]
            rows.append([(angle + 360.0) / 2, (lift + first) / 2 if len(rows) == 2 else lift + 10.0])
        yield rows


def closing(raw: dict[str, Any], place: Place) -> Iterator[float]:
    """The angle of a phase that fills the turn."""
    phases = value_at(raw, place[:-2])
    if place[-1] == "angle_deg" and isinstance(phases, list) and isinstance(place[-2], int):
        held = [p.get("angle_deg") for k, p in enumerate(phases) if k != place[-2] and isinstance(p, dict)]
        angles = [float(a) for a in held if isinstance(a, int | float) and is_number(a)]
        if len(angles) == len(held):
            yield round(360.0 - math.fsum(angles), 9)

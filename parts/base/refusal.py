"""A refusal as data: what is wrong with which key of a scene, and what would work; and its sentence, at the edge."""

from __future__ import annotations

import re
from collections.abc import Collection
from typing import NamedTuple

from msgspec import Struct

from geometry.base.errors import TOLD, Curable, Cure, Nearest, ParameterError, format_value
from parts.base.fields import given_keys
from parts.base.lookalikes import in_latin, look_alike
from parts.base.psv import rows_of
from parts.base.reasons import REMEDIES, reason
from parts.base.texts import ENGLISH, Message, Text, counted, english_of, filled, listed, message, standard_told, words


class Rulers(NamedTuple):
    """Keys of an assembly: of which a place follows in what it makes, and of which only others in the same part do."""

    own: list[str]
    others: list[str]


class SceneError(Curable, ValueError):
    """A scene cannot be read or built.

    ``source``: the file, ``key``: the place in it, ``value``: what stands there (None: nothing), ``code``: what is
    wrong, ``numbers``: what the sentence of that code needs, ``nearest``: the value of the key that works, found when
    it is asked for; ``unit``: its unit; ``rulers``: the keys of which the place follows, where it was not typed.
    """

    rulers: Rulers | None = None

    def __init__(self, source: str, key: str, value: object, code: str, nearest: Cure = None, /,
                 unit: str = "", **numbers: object) -> None:  # fmt: skip
        self.source, self.key, self.value, self.code, self.numbers, self.unit = source, key, value, code, numbers, unit
        self._cure = nearest
        super().__init__(source, key, value, code)

    def offer(self, cure: Cure) -> None:
        """Another value that works, or how to find it."""
        self._cure = cure

    def at(self, key: str) -> SceneError:
        """The same refusal of another key."""
        there = SceneError(self.source, key, self.value, self.code, lambda: self.nearest, self.unit, **self.numbers)
        there.rulers = self.rulers
        return there

    @property
    def remedy(self) -> str:
        """What is wrong and what would work, in English."""
        return words(ENGLISH).say(explained(self))

    def __str__(self) -> str:
        return sentence(self)


class Typed(str):
    """What stands where a refusal has its key for a word of the command line: told as the usage tells it."""


# what works is to leave the key out
REMOVED = Nearest(None)


# so many of a list are told, of one that is longer than that
_FEW, _LONG = 8, 10
# as like as two words seldom are by chance
_SURE = 0.8
# letters of a value, and of a place, that are shown
_SHORT, _PLACE = 60, 160
# words of other books for our keys and values, to which no letter leads
SYNONYMS = {word: ours.split(", ") for word, ours in rows_of(__file__, "synonyms")}


def meant(word: object, known: Collection[str]) -> Nearest | None:
    """The known word that was probably meant, or nothing; of other letters than Latin ones by what translates to it."""
    if word is None:
        return None
    latin = in_latin(str(word))
    told = [] if latin.isascii() else english_of(str(word), _FEW)
    found = next(filter(None, (_sure(_plain(one), known) for one in told)), None)
    return found or _sure(latin, known) or _likest(latin, known)


def _sure(word: str, known: Collection[str]) -> Nearest | None:
    """The known word that is the same, or means the same, but for a slip of the fingers."""
    import difflib

    plain = _plain(word)
    # capitals, blanks and hyphens aside; what no letter leads to; letters in another order, a slip of the fingers
    match = [name for name in known if _plain(name) == plain][:1]
    match = match or [name for name in SYNONYMS.get(plain, ()) if name.partition(".")[0] in known]
    match = match or [name for name in known if sorted(name) == sorted(plain)][:1]
    near = [name for name in known if len(plain) > 2 and (plain not in SYNONYMS or _plain(name).startswith(plain))]
    match = match or difflib.get_close_matches(word, near, 1, _SURE)
    return Nearest(match[0], "meant") if match else None


def _likest(word: str, known: Collection[str]) -> Nearest | None:
    """The known word that has most of its letters, or the only one that has all of it as one of its own."""
    import difflib

    plain = _plain(word)
    # names that have the whole word; else others begin as it does, or have one of its words
    near = [name for name in known if plain and f"_{plain}_" in f"_{_plain(name)}_"]
    alone = near if len(near) == 1 else []
    if not near and plain not in SYNONYMS:
        own = {*plain.split("_")}
        near = [name for name in known if name[:1].lower() == plain[:1] or own & {*_plain(name).split("_")}]
    # among many words some have half of its letters by chance
    match = difflib.get_close_matches(word, near, 1, 0.6 if len(known) > _LONG else 0.5) or alone
    return Nearest(match[0], "meant") if match else None


def _plain(word: str) -> str:
    """A word in small letters, with one _ between its words."""
    return re.sub("[ _-]+", "_", word.lower())


def placed(source: str, place: str, refusal: ParameterError, unit: str = "") -> SceneError:
    """A refusal of what a table describes as one of the scene; ``place``: where the table stands."""
    return SceneError(
        source, f"{place}.{refusal.name}", refusal.value, refusal.code, lambda: refusal.nearest, unit, **refusal.numbers
    )


def sentence(refusal: SceneError, language: str = ENGLISH) -> str:
    """The one line that a user reads: file, key, value, what is wrong, what would work."""
    # a table is told by its key alone
    given = "" if refusal.value is None or isinstance(refusal.value, Struct) else f" = {_shown(refusal.value)}"
    key = words(language).term("command line", refusal.key) if isinstance(refusal.key, Typed) else refusal.key
    place = f"{refusal.source}: {_short(key, _PLACE)}{given}" if key else refusal.source or '""'
    line = f"{place}: {words(language).say(explained(refusal))}"
    return "".join(c if c.isprintable() else "?" for c in line)


# refusals of what `higherpair list` has
_LISTED = ("a_folder", "no_scene", "no_such_scene", "unknown_kind", "unknown_mate", "missing_kind", "unknown_material")


def _nearest_few(refusal: SceneError) -> Message | None:
    """Of a long list of what is known those that are most like what was given, and where the rest stands."""
    import difflib

    known = refusal.numbers.get("known")
    if not isinstance(known, list | tuple) or len(known) <= _LONG:
        return None
    given = refusal.key.rpartition(".")[2] if refusal.code in ("unknown_key", "unknown_table") else refusal.value
    # no word of ours is as long as what stands there may be
    word = str(given or (refusal.source if refusal.code == "no_such_scene" else ""))[:_SHORT].lower()

    def likeness(name: object) -> float:
        return difflib.SequenceMatcher(None, word, str(name).lower()).ratio()

    told = sorted((name for name in known if likeness(name) >= 0.6), key=likeness, reverse=True) or known
    few = {"few": _told(told[:_FEW]), "more": len(known) - len(told[:_FEW])}
    see = "higherpair list" if refusal.code in _LISTED else refusal.numbers.get("see", "")
    if refusal.source == "calc" and refusal.code == "unknown_key":
        see = f"higherpair calc {refusal.key.partition('.')[0]} --keys"
    if not see:
        return message("{few} and {more} more", **few)
    return message("{few} and {more} more, see `{command}`", command=see, **few)


def explained(refusal: SceneError) -> Message:
    """What is wrong and what would work."""
    text = reason(refusal.code)
    # the number that a plural goes by stays a number
    counted = text.by if isinstance(text, Message) else ""
    why = filled(text, **{name: n if name == counted else _told(n) for name, n in refusal.numbers.items()})
    if standard := refusal.numbers.get("standard"):
        why = filled(why, standard=standard_told(str(standard)))
    if few := _nearest_few(refusal):
        why = filled(why, known=few)
    # a value of other letters too is written in Cyrillic on purpose, and that of a key that is unknown is not to blame
    told = isinstance(refusal.value, str) and refusal.code != "unknown_key" and in_latin(refusal.value).isascii()
    word = refusal.value if told else ""
    if letter := look_alike(f"{refusal.key} {word}"):
        why = message("{why}; {remedy}", why=why, remedy=letter)
    if (nearest := refusal.nearest) is not None:
        why = message("{why}; {remedy}", why=why, remedy=_remedy(nearest, refusal))
        if nearest.too:
            why = message("{why}, if {parts} has it too", why=why, parts=", ".join(nearest.too))
    return why if refusal.rulers is None else _following(why, refusal.rulers)


def _following(why: Message, rulers: Rulers) -> Message:
    """A refusal with the keys that its place follows from, and those of the rest of its part where these are few."""
    own, others = ", ".join(rulers.own), ", ".join(rulers.others)
    if own and others and len(rulers.others) <= _FEW:
        return message(
            "{why}; it follows from {keys}, the rest of the part from {others}", why=why, keys=own, others=others
        )
    if own:
        return message("{why}; it follows from {keys}", why=why, keys=own)
    few = others and len(rulers.others) <= _FEW
    return message("{why}; the part follows from {keys}", why=why, keys=others) if few else why


def _remedy(nearest: Nearest, refusal: SceneError) -> Message:
    """What would work: a limit or a value with its unit, a word that was meant, or to leave the key out."""
    if nearest.value is None:
        return message(REMEDIES["without"], key=refusal.key.rpartition(".")[2])
    if isinstance(nearest.value, int | float) and not isinstance(nearest.value, bool):
        return message(REMEDIES[nearest.side], value=in_unit(f"{nearest.value:.12g}", nearest.value, refusal.unit))
    value = str(nearest.value) if nearest.side in TOLD else format_value(nearest.value)
    return message(REMEDIES[nearest.side], value=value)


# units that are words, which follow the number before them
_COUNTED = {
    "modules": counted("{number} module", "{number} modules", by="count"),
    "degrees": counted("{number} degree", "{number} degrees", by="count"),
    "turns": counted("{number} turn", "{number} turns", by="count"),
}


def in_unit(number: Text, count: object, unit: str) -> Message:
    """A number, or a range that ends with it, with its unit in the form that goes with the ``count``."""
    if unit in _COUNTED:
        return filled(_COUNTED[unit], number=number, count=count)
    return message("{number} {unit}", number=number, unit=Message(unit)) if unit else filled(number)


def _told(number: object) -> object:
    """A number as it is told: floats by six digits, lists with commas."""
    if isinstance(number, float):
        return f"{number:.6g}"
    if isinstance(number, list | tuple) and not isinstance(number, Message):
        told = [_told(item) for item in number]
        return listed([t if isinstance(t, Message) else Message("{it}", {"it": t}) for t in told])
    return "" if number is None else number


def _shown(value: object) -> str:
    return _short(" ".join(_typed(value).split()), _SHORT)


def _short(text: str, most: int) -> str:
    return text if len(text) <= most else text[: most - 3] + "..."


def _typed(value: object) -> str:
    """A value as TOML has it on one line."""
    if isinstance(value, Struct):
        value = given_keys(value)
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{key} = {_typed(item)}' for key, item in value.items())} }}"
    return f"[{', '.join(map(_typed, value))}]" if isinstance(value, list) else format_value(value)

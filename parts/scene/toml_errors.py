"""What tomllib says of a text that is no TOML, as messages: its sentences are translated like ours."""

from __future__ import annotations

import re
import tomllib
import unicodedata
from collections.abc import Callable
from itertools import accumulate
from typing import Any, NamedTuple, TypeAlias

from parts.base.lookalikes import look_alike
from parts.base.psv import rows_of
from parts.base.texts import Text, filled, message
from parts.base.units import sexagesimal, written_units

# those of tomllib; one that is not here is told in English
SENTENCES = tuple(sentence for (sentence,) in rows_of(__file__, "toml_errors"))


# a key whose words have no quotes, and one whose quotes are not closed
_TYPOGRAPHIC = "“”„«»‘’`"
_BARE = re.compile(rf"([\w-]+)\s*=\s*((?:[{_TYPOGRAPHIC}]|[^\W\d_])[^#,\]}}\"']*)")
# a list without brackets, a number with its unit, a key that is not in Latin letters
_BARE_WORDS = re.compile(r"\s*([\w.-]+)\s*=\s*\(?\s*(\"[^\"]*\"(?:\s*[,;]\s*\"[^\"]*\")+)\s*\)?\s*(?:#.*)?")
_BARE_LIST = re.compile(r"\s*([\w.-]+)\s*=\s*\(?\s*(-?[\d.]+(?:\s*[,;]\s*-?[\d.]+)+)\s*\)?\s*(?:#.*)?")
_ANGLE = re.compile(r"\s*([\w.-]+)\s*=\s*([-\u2212\u2013]?\d+\s*\u00b0[^#]*?)\s*(?:#.*)?")
_UNIT = re.compile(
    r"\s*([\w.-]+)\s*=\s*(-?\d+(?:[.,]\d+)?)(?:/(\d+))?(\s*)([%\"\u2033]|[^\W\d_]+(?:/[^\W\d_]+)?[²³]?)\.?\s*(?:#.*)?"
)
# a number, text or list that would be one but for a colon, a second sign, a lone point, a first 0, a printed minus or
# degree, or for what other languages end a line with
_ALMOST = re.compile(
    r"\s*\"?([\w.-]+)\"?\s*(?::=?|==?)\s*(?:([-+\u2212\u2013]?)(\d*)(\.?)(\d*)|(\"[^\"]*\"|true|false|\[[^\]]*\]))"
    r"\s*\u00b0?\s*[;,]?\s*(?://.*|#.*)?"
)
# one that is to be worked out, a text in quotes that has some itself, a key of some words
_SHARE = re.compile(r"\s*([\w.-]+)\s*=\s*\(?\s*(-?\d+\.?\d*)\s*([*/])\s*(\d+\.?\d*)\s*\)?\s*(?:#.*)?")
_QUOTES_WITHIN = re.compile(r"\s*([\w.-]+)\s*=\s*([\"'])([^\\]*)\2\s*(?:#.*)?")
_WORDS = re.compile(r"\s*([A-Za-z]\w*(?: +\w+)+)\s*=\s*(.*\S)\s*")
# what files of other formats begin with
_OTHERS, _YAML = {"{": "JSON", "<": "XML"}, re.compile(r"[\w-]+:\s*$")
_NOT_LATIN = re.compile(r"\s*(\w*[^\W\x00-\x7f]\w*)\s*=")
# a header that lacks a bracket or has others, a key with its unit behind it, a number in brackets
_HALF_HEADER = re.compile(r"\s*([\[({]*)\s*([A-Za-z][\w-]*(?:\.[\w-]+)*)\s*([\])}]*)\s*(?:#.*)?")
_UNIT_OF_KEY = re.compile(r"\s*([A-Za-z]\w*)\s*[\[(][^\])=]*[\])]\s*=\s*([^#]*[^#\s])\s*(?:#.*)?")
_BRACKETED = re.compile(r"\s*([\w.-]+)\s*=\s*\(\s*([-+]?\d+(?:\.\d+)?)\s*\)\s*(?:#.*)?")
# tables that a scene has several of
_SEVERAL = ("assemblies", "mates", "drives", "steps", "exports")
# the header of a table, and what a name in it is made of
_TABLE = re.compile(r"\s*\[\[?([^\[\]\"'#]+)\]\]?\s*(?:#.*)?")
_NAME = re.compile(r"\s*[A-Za-z0-9_-]*\s*")
# yes and no as people say them; code points, since the code itself has no Cyrillic
_YES = ("yes", bytes.fromhex("0442 0430 043a").decode("utf-16-be"))
_NO = ("no", bytes.fromhex("043d 0456").decode("utf-16-be"))
_OPEN = re.compile(r"""\s*([\w.-]+)\s*=\s*("[^"]*|'[^']*)""")
_NO_VALUE = re.compile(r"\s*([\w.-]+)\s*=?\s*(?:#.*)?")
_NEXT_KEY = re.compile(r"\s*[;,]?\s*[\w.-]+\s*=")
# what other languages begin a comment with
_COMMENT = re.compile(r"\s*(?://|/\*|--|;)")


def told_toml(text: str, why: str) -> Text:
    """An error of tomllib in a text, keys in it as they are typed; a Cyrillic letter that led to it is named."""
    told, at = _told(why), re.search(r"line (\d+), column (\d+)\)$", why)
    if at is None:
        return told
    line, column = text.split("\n")[int(at[1]) - 1], int(at[2]) - 1
    word = next((w[0] for w in re.finditer(r"\w+", line) if w.start() <= column < w.end()), "")
    letter = look_alike(word)
    return told if letter is None else message("{why}; {remedy}", why=told, remedy=letter)


def _told(why: str) -> Text:
    found = re.fullmatch(r"(.*) \(at (?:line (\d+), column (\d+)|end of document)\)", why, re.DOTALL)
    if found is None:
        return why
    for text in SENTENCES:
        if given := re.fullmatch(re.escape(text).replace(r"\{what\}", "(.+)"), found[1], re.DOTALL):
            said = filled(text, what=_as_typed(given[1])) if given.groups() else filled(text)
            if found[2]:
                return message("{what} (at line {line}, column {column})", what=said, line=found[2], column=found[3])
            return message("{what} (at end of document)", what=said)
    return why


def _as_typed(what: str) -> str:
    """A key that is told as the tuple of its parts, with dots between them."""
    return ".".join(re.findall(r"'([^']*)'", what)) if what.startswith("(") else what


class _Line(NamedTuple):
    """The line at which a text is no TOML: why, as tomllib says it, its number, and the place of the error in it."""

    text: str
    why: str
    number: int
    line: str
    column: int

    @property
    def rest(self) -> str:
        """From the error on."""
        return self.line[self.column :]


_Slip: TypeAlias = tuple[str, dict[str, Any]] | None


def slip(text: str, why: str) -> _Slip:
    """What people type who know no TOML, on the line that is none: its code and what the sentence of that needs."""
    # Python's own words of a whole number that it does not read
    if digits := re.search(r"limit \((\d+) digits\).* has (\d+) digits", why):
        long = re.search(rf"\d[\d_]{{{digits[1]}}}", text)
        place = text.count("\n", 0, long.start()) + 1 if long else 1
        return "too_many_digits", {"line": place, "digits": digits[2], "most": digits[1]}
    if (at := re.search(r"line (\d+), column (\d+)\)$", why)) is None:
        # quotes that nothing closes up to the end
        rows = enumerate(text.split("\n"), 1)
        opened = next(((number, found[1]) for number, row in rows if (found := _OPEN.fullmatch(row.rstrip()))), None)
        return None if opened is None else ("quote_not_closed", {"line": opened[0], "key": opened[1]})
    number = int(at[1])
    here = _Line(text, why, number, text.split("\n")[number - 1], int(at[2]) - 1)
    code, numbers = next(filter(None, (known(here) for known in _SLIPS)), ("", {}))
    return (code, {"line": number} | numbers) if code else None


def _of_other_format(at: _Line) -> _Slip:
    if _YAML.match(at.line):
        return "other_format", {"format": "YAML"}
    form = _OTHERS.get(at.line.strip()[:1]) if at.why.startswith("Invalid statement") else None
    return None if form is None else ("other_format", {"format": form})


def _hidden(at: _Line) -> _Slip:
    hidden = next((c for c in at.line if unicodedata.category(c) == "Cf"), None)
    return None if hidden is None else ("hidden_character", {"letter": f"U+{ord(hidden):04X}"})


def _twice(at: _Line) -> _Slip:
    """A key or a table that stands twice, and one that stands several times but has single brackets once."""
    if at.why.startswith("Cannot declare") and (found := _TABLE.fullmatch(at.line)):
        return "table_twice", {"table": found[1].strip()}
    if not at.why.startswith("Cannot overwrite a value"):
        return None
    if found := re.match(r"\s*([\w.-]+)\s*=", at.line):
        return "key_twice", {"key": found[1]}
    if (found := re.match(r"\s*\[\[([\w-]+)\]\]", at.line)) is None:
        return None
    if found[1] not in _SEVERAL:
        return "table_twice", {"table": found[1]}
    rows = enumerate(at.text.split("\n")[: at.number - 1], 1)
    first = next((n for n, row in rows if re.match(rf"\s*\[{found[1]}\]", row)), at.number)
    return "single_brackets", {"line": first, "table": found[1]}


def _of_other_language(at: _Line) -> _Slip:
    """Comments and ends of lines as other languages have them; several keys on a line."""
    if at.why.startswith("Invalid statement") and _COMMENT.match(at.line):
        return "comment_of_others", {}
    if at.why.startswith("Unclosed array") and at.rest.startswith(";"):
        return "semicolon", {}
    if at.why.startswith("Expected newline") and _NEXT_KEY.match(at.rest):
        return "keys_in_a_row", {}
    return None


def _braces(at: _Line) -> _Slip:
    """A table in braces over several lines, or with a comma behind its last value."""
    if not at.why.startswith(("Invalid initial character for a key part", "Unclosed inline table")):
        return None
    rows = [row.partition("#")[0] for row in at.text.split("\n")]
    before = "\n".join((*rows[: at.number - 1], rows[at.number - 1][: at.column]))
    begin = _open_brace(before)
    whole = "\n".join(rows)[begin:]
    depths = accumulate((c == "{") - (c == "}") for c in whole)
    end = next((place for place, depth in enumerate(depths, 1) if depth == 0), 0)
    table = re.sub(r"[\s,]*\}", " }", re.sub(r"\{\s*", "{ ", re.sub(r"\s*,\s*", ", ", whole[:end])))
    try:
        tomllib.loads(f"x = {table}")
    except ValueError:
        return None
    return "braces", {"line": before.count("\n", 0, begin) + 1, "table": table}


def _open_brace(text: str) -> int:
    """Where the outermost brace begins that nothing closes in a text."""
    opened: list[int] = []
    for place, letter in enumerate(text):
        if letter == "{":
            opened.append(place)
        elif letter == "}" and opened:
            opened.pop()
    return opened[0] if opened else len(text)


def _brackets(at: _Line) -> _Slip:
    """Too few or too many about a header, a unit or a number."""
    if (found := _HALF_HEADER.fullmatch(at.line)) and found[1] + found[3] and not found[2].isdigit():
        header = f"[[{found[2]}]]" if found[2] in _SEVERAL else f"[{found[2]}]"
        if header != at.line.partition("#")[0].strip():
            return "half_header", {"header": header}
    found = _UNIT_OF_KEY.fullmatch(at.line) or _BRACKETED.fullmatch(at.line)
    if found and look_alike(found[1]) is None:
        return "small_letters", {"key": found[1], "value": found[2]}
    return None


def _no_value(at: _Line) -> _Slip:
    found = _NO_VALUE.fullmatch(at.line)
    return ("no_value", {"key": found[1]}) if found and look_alike(found[1]) is None else None


def _backslash(at: _Line) -> _Slip:
    return ("backslash", {}) if at.why.startswith(("Invalid hex value", "Unescaped")) else None


def _calculated(at: _Line) -> _Slip:
    if (found := _SHARE.fullmatch(at.line)) and (by := float(found[4])):
        value = f"{float(found[2]) * by if found[3] == '*' else float(found[2]) / by:.12g}"
        return "not_calculated", {"key": found[1], "value": value}
    return None


def _texts(at: _Line) -> _Slip:
    """A list of texts without brackets, quotes within quotes, a key of several words."""
    if found := _BARE_WORDS.fullmatch(at.line):
        return "no_brackets", {"key": found[1], "value": ", ".join(re.findall(r'"[^"]*"', found[2]))}
    if (found := _QUOTES_WITHIN.fullmatch(at.line)) and found[2] in found[3]:
        bare = found[3].strip(found[2])
        other = "\"'"[found[2] == '"'] if found[2] in bare else found[2]
        if other not in bare:
            return "small_letters", {"key": found[1], "value": f"{other}{bare}{other}"}
    if at.why.startswith("Expected '='") and (found := _WORDS.fullmatch(at.line)):
        return "small_letters", {"key": re.sub(" +", "_", found[1]), "value": found[2]}
    return None


def _bare_values(at: _Line) -> _Slip:
    """Decimal commas, texts without quotes, yes and no, lists without brackets."""
    if found := re.search(r"=\s*(-?\d+),(\d+)\s*(#.*)?$", at.line):
        return "decimal_comma", {"number": f"{found[1]}.{found[2]}"}
    if at.why.startswith("Invalid value") and (found := _BARE.search(at.line)) and found.start(2) == at.column:
        value = found[2].strip().strip(_TYPOGRAPHIC)
        said = value.lower()
        truth = "true" if said in ("true", *_YES) else "false" if said in ("false", *_NO) else None
        return "no_quotes" if truth is None else "small_letters", {"key": found[1], "value": truth or value}
    if found := _BARE_LIST.fullmatch(at.line):
        return "no_brackets", {"key": found[1], "value": ", ".join(re.split(r"\s*[,;]\s*", found[2]))}
    return None


def _units(at: _Line) -> _Slip:
    """A number with its unit; a letter right behind a digit may be meant for one."""
    if (found := _ANGLE.fullmatch(at.line)) and (angle := sexagesimal(found[2])) is not None:
        return "number_in_other_unit", {"key": found[1], "value": f"{angle:.12g}"}
    if (found := _UNIT.fullmatch(at.line)) is None or float(found[3] or 1) == 0:
        return None
    key, number, by, apart, unit = found.groups("1")
    value = number if by == "1" and "," not in number else f"{float(number.replace(',', '.')) / float(by):.12g}"
    if unit == "%":
        return "a_share", {"key": key, "value": f"{float(value) / 100:.12g}"}
    if look_alike(key if apart else at.line) is not None:
        return None
    size, of = written_units().get(unit.lower(), (1.0, ""))
    value = value if size == 1 else f"{float(value) * size:.12g}"
    code = "number_in_other_unit" if size != 1 and of in ("mm", "degrees") else "number_with_unit"
    return code, {"key": key, "value": value}


def _almost(at: _Line) -> _Slip:
    """A value that would be one but for a sign or two."""
    if (found := _ALMOST.fullmatch(at.line)) and look_alike(at.line) is None:
        key, sign, whole, point, rest, other = found.groups("")
        value = other or f"{sign and ('+' if sign == '+' else '-')}{whole.lstrip('0') or 0}{point and f'.{rest or 0}'}"
        if (other or whole or rest) and not re.match(rf"\s*{re.escape(key)} *= *{re.escape(value)}\s*(#|$)", at.line):
            return "small_letters", {"key": key, "value": value}
    return ("colon", {}) if at.why.startswith("Expected '='") and at.rest.lstrip().startswith(":") else None


def _not_latin(at: _Line) -> _Slip:
    """A key, or a name in a header, in other letters."""
    if (found := _NOT_LATIN.match(at.line)) and found.end(1) > at.column and look_alike(found[1]) is None:
        return "key_not_latin", {"key": found[1]}
    if (found := _TABLE.fullmatch(at.line)) and look_alike(found[1]) is None:
        wrong = next((name.strip() for name in found[1].split(".") if not _NAME.fullmatch(name)), None)
        return None if wrong is None else ("name_not_latin", {"name": wrong})
    return None


def _left(at: _Line) -> _Slip:
    """Quotes that nothing closes, and a blank that is none."""
    if found := _OPEN.fullmatch(at.line.rstrip()):
        return "quote_not_closed", {"key": found[1]}
    return ("hidden_character", {"letter": "U+00A0"}) if at.rest.startswith("\u00a0") else None


# what a line may have, that which leads to the plainest remedy first
_SLIPS: tuple[Callable[[_Line], _Slip], ...] = (
    _of_other_format, _hidden, _twice, _of_other_language, _braces, _brackets, _no_value, _backslash, _calculated,
    _texts, _bare_values, _units, _almost, _not_latin, _left,
)  # fmt: skip

"""What tomllib says of a text that is no TOML, as messages: its sentences are translated like ours."""

from __future__ import annotations

import re
import unicodedata
from typing import Any

from parts.base.lookalikes import look_alike
from parts.base.psv import rows_of
from parts.base.texts import Text, filled, message

# those of tomllib; one that is not here is told in English
SENTENCES = tuple(sentence for (sentence,) in rows_of(__file__, "toml_errors"))


# a key whose words have no quotes, and one whose quotes are not closed
_TYPOGRAPHIC = "“”„«»‘’`"
_BARE = re.compile(rf"([\w-]+)\s*=\s*((?:[{_TYPOGRAPHIC}]|[^\W\d_])[^#,\]}}\"']*)")
# a list without brackets, a number with its unit, a key that is not in Latin letters
_BARE_WORDS = re.compile(r"\s*([\w.-]+)\s*=\s*\(?\s*(\"[^\"]*\"(?:\s*[,;]\s*\"[^\"]*\")+)\s*\)?\s*(?:#.*)?")
_BARE_LIST = re.compile(r"\s*([\w.-]+)\s*=\s*\(?\s*(-?[\d.]+(?:\s*[,;]\s*-?[\d.]+)+)\s*\)?\s*(?:#.*)?")
_UNIT = re.compile(
    r"\s*([\w.-]+)\s*=\s*(-?\d+(?:\.\d+)?)(\s*)([%\"\u2033]|[^\W\d_]+(?:/[^\W\d_]+)?[²³]?)\.?\s*(?:#.*)?"
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


def slip(text: str, why: str) -> tuple[str, dict[str, Any]] | None:
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
    number, column = int(at[1]), int(at[2]) - 1
    line = text.split("\n")[number - 1]
    if _YAML.match(line):
        return "other_format", {"line": number, "format": "YAML"}
    if why.startswith("Invalid statement") and (form := _OTHERS.get(line.strip()[:1])):
        return "other_format", {"line": number, "format": form}
    if hidden := next((c for c in line if unicodedata.category(c) == "Cf"), None):
        return "hidden_character", {"line": number, "letter": f"U+{ord(hidden):04X}"}
    if why.startswith("Cannot overwrite a value") and (found := re.match(r"\s*([\w.-]+)\s*=", line)):
        return "key_twice", {"line": number, "key": found[1]}
    if why.startswith("Cannot overwrite a value") and (found := re.match(r"\s*\[\[([\w-]+)\]\]", line)):
        if found[1] not in _SEVERAL:
            return "table_twice", {"line": number, "table": found[1]}
        rows = enumerate(text.split("\n")[: number - 1], 1)
        first = next((n for n, row in rows if re.match(rf"\s*\[{found[1]}\]", row)), number)
        return "single_brackets", {"line": first, "table": found[1]}
    if why.startswith("Cannot declare") and (found := _TABLE.fullmatch(line)):
        return "table_twice", {"line": number, "table": found[1].strip()}
    if why.startswith("Invalid statement") and _COMMENT.match(line):
        return "comment_of_others", {"line": number}
    if why.startswith("Unclosed array") and line[column : column + 1] == ";":
        return "semicolon", {"line": number}
    if why.startswith("Expected newline") and _NEXT_KEY.match(line[column:]):
        return "keys_in_a_row", {"line": number}
    if (found := _HALF_HEADER.fullmatch(line)) and found[1] + found[3] and not found[2].isdigit():
        header = f"[[{found[2]}]]" if found[2] in _SEVERAL else f"[{found[2]}]"
        if header != line.partition("#")[0].strip():
            return "half_header", {"line": number, "header": header}
    if (found := _UNIT_OF_KEY.fullmatch(line) or _BRACKETED.fullmatch(line)) and look_alike(found[1]) is None:
        return "small_letters", {"line": number, "key": found[1], "value": found[2]}
    if (found := _NO_VALUE.fullmatch(line)) and look_alike(found[1]) is None:
        return "no_value", {"line": number, "key": found[1]}
    if why.startswith(("Invalid hex value", "Unescaped")):
        return "backslash", {"line": number}
    if (found := _SHARE.fullmatch(line)) and (by := float(found[4])):
        value = f"{float(found[2]) * by if found[3] == '*' else float(found[2]) / by:.12g}"
        return "not_calculated", {"line": number, "key": found[1], "value": value}
    if found := _BARE_WORDS.fullmatch(line):
        return "no_brackets", {"line": number, "key": found[1], "value": ", ".join(re.findall(r'"[^"]*"', found[2]))}
    if (found := _QUOTES_WITHIN.fullmatch(line)) and found[2] in found[3]:
        bare = found[3].strip(found[2])
        other = "\"'"[found[2] == '"'] if found[2] in bare else found[2]
        if other not in bare:
            return "small_letters", {"line": number, "key": found[1], "value": f"{other}{bare}{other}"}
    if why.startswith("Expected '='") and (found := _WORDS.fullmatch(line)):
        return "small_letters", {"line": number, "key": re.sub(" +", "_", found[1]), "value": found[2]}
    if found := re.search(r"=\s*(-?\d+),(\d+)\s*(#.*)?$", line):
        return "decimal_comma", {"line": number, "number": f"{found[1]}.{found[2]}"}
    if why.startswith("Invalid value") and (found := _BARE.search(line)) and found.start(2) == column:
        value = found[2].strip().strip(_TYPOGRAPHIC)
        said = value.lower()
        truth = "true" if said in ("true", *_YES) else "false" if said in ("false", *_NO) else None
        return ("no_quotes" if truth is None else "small_letters"), {
            "line": number, "key": found[1], "value": truth or value
        }  # fmt: skip
    if found := _BARE_LIST.fullmatch(line):
        row = ", ".join(re.split(r"\s*[,;]\s*", found[2]))
        return "no_brackets", {"line": number, "key": found[1], "value": row}
    # a letter right behind a digit may be meant for one
    if (found := _UNIT.fullmatch(line)) and found[4] == "%":
        return "a_share", {"line": number, "key": found[1], "value": f"{float(found[2]) / 100:.12g}"}
    if (found := _UNIT.fullmatch(line)) and look_alike(found[1] if found[3] else line) is None:
        units = {name: float(size) for name, size in rows_of(__file__, "units")}
        if size := units.get(found[4].lower()):
            value = f"{float(found[2]) * size:.12g}"
            return "number_in_other_unit", {"line": number, "key": found[1], "value": value}
        return "number_with_unit", {"line": number, "key": found[1], "value": found[2]}
    if (found := _ALMOST.fullmatch(line)) and look_alike(line) is None:
        key, sign, whole, point, rest, other = found.groups("")
        value = other or f"{sign and ('+' if sign == '+' else '-')}{whole.lstrip('0') or 0}{point and f'.{rest or 0}'}"
        if (other or whole or rest) and not re.match(rf"\s*{re.escape(key)} *= *{re.escape(value)}\s*(#|$)", line):
            return "small_letters", {"line": number, "key": key, "value": value}
    if why.startswith("Expected '='") and line[column:].lstrip().startswith(":"):
        return "colon", {"line": number}
    if (found := _NOT_LATIN.match(line)) and found.end(1) > column and look_alike(found[1]) is None:
        return "key_not_latin", {"line": number, "key": found[1]}
    if (found := _TABLE.fullmatch(line)) and look_alike(found[1]) is None:
        wrong = next((name.strip() for name in found[1].split(".") if not _NAME.fullmatch(name)), None)
        return None if wrong is None else ("name_not_latin", {"line": number, "name": wrong})
    if found := _OPEN.fullmatch(line.rstrip()):
        return "quote_not_closed", {"line": number, "key": found[1]}
    if line[column : column + 1] == "\u00a0":
        return "hidden_character", {"line": number, "letter": "U+00A0"}
    return None

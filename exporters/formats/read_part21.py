"""The text of a STEP file (ISO 10303-21) as columns: ids, references and numbers of each kind of entity.

A file is cut into pieces between two entities, strings are taken out of a piece, and the entities of one kind in it are
matched by one expression that knows exactly what they look like. What is not known is refused: it might hide something.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from functools import cache, lru_cache
from itertools import chain
from pathlib import Path
from typing import BinaryIO, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record
from geometry.curves.curve import Real
from parts.base.psv import rows_of
from parts.base.readback import ReadError, refuse_if

Index = NDArray[np.int64]
Numbers = TypeVar("Numbers", Index, Real)
# texts of what varies in an entity with lists
Row = tuple[bytes, ...]

# a file is read in pieces of so many bytes; no entity may be longer
_PIECE = 1 << 24
_FLOAT, _REFERENCE = rb"[-+]?\d+\.\d*(?:E[-+]?\d{1,2})?", rb"#(\d{1,15})"
_LIST = rb"\((%b(?:,%b)*)\)"
# what arguments are made of: no words, a string, reference, real, one that is not below 0, integer,
# truth, star, word, a truth that is not claimed; lists
_ATOMS = {
    "s": rb'"', "S": rb'(?:(?:!\d+)?")+', "r": _REFERENCE, "f": rb"(%b)" % _FLOAT, "p": rb"(?!-)(%b)" % _FLOAT,
    "i": rb"(\d{1,4})", "b": rb"([01])", "*": rb"\*", "R": _LIST % (rb"#\d{1,15}", rb"#\d{1,15}"),
    "w": rb"\.[A-Z_]+\.", "n": rb"(?:0|\.U\.)",
    "m": rb"(?:POSITIVE_RATIO|VOLUME|AREA)_MEASURE\(%b\)" % _FLOAT, "I": _LIST % (rb"\d{1,5}", rb"\d{1,5}"),
    "F": _LIST % (_FLOAT, _FLOAT), "M": rb"\((\([#\d,]+\)(?:,\([#\d,]+\))*)\)",
}  # fmt: skip


class _Around(NamedTuple):
    """What is known of a kind that stands around the geometry, as its table has it."""

    arguments: str
    referred: str
    users: str
    words: str


_GEOMETRY = dict(rows_of(__file__, "part21_geometry"))
# those with lists; the others are of fixed length
_LISTED = {kind for kind, arguments in _GEOMETRY.items() if set("RIFM") & {*arguments}}
_AROUND = {kind: _Around(*cells) for kind, *cells in rows_of(__file__, "part21_around")}
# those that are several kinds at once, by the name they have here
_COMPLEX = [kind for kind in _AROUND if kind.islower()]
MILLIMETRE, CENTIMETRE, GRAM, CONTEXT, PLACED = "mm", "cm", "g", "context", "placed"
PART, ASSEMBLY = "ADVANCED_BREP_SHAPE_REPRESENTATION", "SHAPE_REPRESENTATION"
_USERS = {user for around in _AROUND.values() for user in around.users.split()}
# blanks and comments
_GAP = rb"(?:\s|/\*(?:[^*]|\*(?!/))*+\*/)*+"
_BEGIN = re.compile(rb"%bISO-10303-21;%bHEADER;(.*?)ENDSEC;%bDATA;\s*" % (_GAP, _GAP, _GAP), re.DOTALL)
_COMMENT = re.compile(rb"('[^']*')|/\*.*?\*/", re.DOTALL)
_TEXT, _WORDS = rb"\s*'(?:[^']|'')*+'\s*", rb"\s*\((?:\s*'(?:[^']|'')*'\s*,?)*+\)\s*"
# the three entities of a header, of which authors, organisations and schemas are read; a word that is not known is $
_NAME = (_TEXT, _TEXT, b"(%b)" % _WORDS, b"(%b)" % _WORDS, _TEXT, _TEXT, rb"(?:%b|\s*\$\s*)" % _TEXT)
_HEADER = re.compile(
    rb"\s*FILE_DESCRIPTION\s*\(%b,%b\)\s*;\s*FILE_NAME\s*\(%b\)\s*;\s*FILE_SCHEMA\s*\((%b)\)\s*;\s*"
    % (_WORDS, _TEXT, b",".join(_NAME), _WORDS)
)
_SCHEMA = re.compile(rb"\s*\(\s*'AUTOMOTIVE_DESIGN\b")
_QUOTED = re.compile(rb"'((?:[^']|'')*)'")
_END = re.compile(rb"ENDSEC;%bEND-ISO-10303-21;%b$" % (_GAP, _GAP))
_STRINGS, _STRING = re.compile(rb'[!\d"]*"'), re.compile(rb'(?:!(\d+))?"')
_REFERENCES = re.compile(_REFERENCE)
_NUMBER = re.compile(rb"(?<![\w#!])%b" % _FLOAT)
_MEASURE = re.compile(rb"\b([A-Z_]+)_MEASURE\(")
_ESCAPE = re.compile(
    r"\\X2\\((?:[0-9A-F]{4})+)\\X0\\|\\X4\\((?:[0-9A-F]{8})+)\\X0\\|\\X\\([0-9A-F]{2})|\\S\\([ -~])|\\(\\)|(\\)"
)
_CONTROL = re.compile(rb"[\0-\x1f]")
_CODES = ("utf-16-be", "utf-32-be", "latin-1")
_BLANK = b" \t\r\n"
_WORD = b"+-.#_0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"
_IS_BLANK, _IS_WORD = (np.isin(np.arange(256), list(chars)) for chars in (_BLANK, _WORD))
# ids and lengths are no greater
_MOST = 1e15
# the end of a file stands in its last bytes
_TAIL = 200
# so much of a statement is shown
_SHOWN = 60


class Table(Record, eq=False):
    """The entities of a kind: ids (n,), and what varies in each (n, k): references, numbers, truths as 0 and 1."""

    ids: Index
    rows: Real


class Listed(Record, eq=False):
    """The entities of a kind with lists in them: their ids (n,), and the texts of what varies, a row each."""

    ids: Index
    rows: list[Row]


class Item(Record):
    """An entity that is no geometry: its kind, and all references, strings, real numbers and measures in it."""

    kind: str
    references: tuple[int, ...]
    strings: tuple[str, ...]
    numbers: tuple[float, ...]
    measures: tuple[str, ...]


class Entities(Record, eq=False):
    """What a file holds: tables by kind, and what is around the geometry by id."""

    fixed: dict[str, Table]
    listed: dict[str, Listed]
    items: dict[int, Item]

    def table(self, kind: str) -> Table:
        """The entities of a kind of fixed length."""
        if kind in self.fixed:
            return self.fixed[kind]
        return Table(np.zeros(0, np.int64), np.zeros((0, sum(_GEOMETRY[kind].count(c) for c in "rfpib"))))

    def listed_of(self, kind: str) -> list[Row]:
        """What varies in the entities of a kind with lists."""
        return self.listed[kind].rows if kind in self.listed else []


def read_part21(file: Path) -> Entities:
    """The entities of a STEP file.

    Raises
    ------
    ReadError
        It is no STEP file of this schema, or an entity is not known or not what its kind is.
    """
    tables, lists = defaultdict[str, list[Table]](list), defaultdict[str, list[Listed]](list)
    items: dict[int, Item] = {}
    with file.open("rb") as source:
        for piece in _pieces(source):
            text, strings = _without_strings(piece)
            for kind, statements in _by_kind(text).items():
                if kind in _LISTED:
                    rows = _matched(kind, statements)
                    lists[kind].append(Listed(np.array([int(row[0]) for row in rows]), [row[1:] for row in rows]))
                elif kind in _GEOMETRY:
                    tables[kind].append(_table(_matched(kind, statements)))
                elif kind:
                    items.update((int(row[0]), _item(kind, row[1], strings)) for row in _matched(kind, statements))
                else:
                    items.update(_complex(statements, strings))
    fixed = {
        kind: Table(_joined([t.ids for t in found]), _joined([t.rows for t in found])) for kind, found in tables.items()
    }
    listed = {
        kind: Listed(_joined([t.ids for t in found]), [row for t in found for row in t.rows])
        for kind, found in lists.items()
    }
    of_kinds = [*(t.ids for t in fixed.values()), *(t.ids for t in listed.values())]
    ids = np.concatenate([np.array([*items], np.int64), *of_kinds])
    ids.sort()
    if (twice := np.flatnonzero(ids[1:] == ids[:-1])).size:
        raise ReadError(f"#{ids[twice[0]]} is there twice in the STEP file")
    _check_references(items, fixed)
    return Entities(fixed, listed, items)


def _joined(found: list[Numbers]) -> Numbers:
    return found[0] if len(found) == 1 else np.concatenate(found)


def read_signature(file: Path) -> tuple[str, str]:
    """The author and the organisation of a STEP file's header; more than one of either are told with commas."""
    with file.open("rb") as source:
        named, _ = _header(source.read(_PIECE))
    author, organisation = (
        ", ".join(_decoded(word.replace(b"''", b"'")) for word in _QUOTED.findall(words))
        for words in named.groups()[:2]
    )
    return author, organisation


def _check_references(items: dict[int, Item], fixed: dict[str, Table]) -> None:
    """What stands around the geometry has the words that it may, refers to what it may, and as often."""
    kinds = {number: item.kind for number, item in items.items()}
    for kind in ("AXIS2_PLACEMENT_3D", "MANIFOLD_SOLID_BREP"):
        kinds |= dict.fromkeys(fixed[kind].ids.tolist() if kind in fixed else (), kind)
    uses = defaultdict[tuple[int, str], int](int)
    for number, item in items.items():
        kind, references, strings = item.kind, item.references, item.strings
        if not _may_say(kind, strings):
            raise ReadError(f"#{number} of the STEP file says {' and '.join(strings)}, which no {kind} does")
        allowed = _referred(kind)
        first = len(references) - len(allowed)
        for place, reference in enumerate(references):
            if kinds.get(reference) not in (known := allowed[max(place - first, 0)]):
                raise ReadError(f"#{number} of the STEP file refers to #{reference}, which is no {' or '.join(known)}")
        if kind in _USERS:
            for reference in references:
                uses[reference, kind] += 1
    for number, item in items.items():
        for user in _AROUND[item.kind].users.split():
            if (count := uses[number, user]) != 1:
                raise ReadError(f"#{number} of the STEP file is that of {count} {user} instead of 1")


@lru_cache
def _may_say(kind: str, strings: tuple[str, ...]) -> bool:
    words = _AROUND[kind].words
    if words in ("", "*"):
        return bool(words) or not any(strings)
    known = ([word.strip() for word in one.split(",")] for one in words.split(";"))
    return any(all(word in ("*", said) for word, said in zip(one, strings, strict=True)) for one in known)


@cache
def _referred(kind: str) -> tuple[tuple[str, ...], ...]:
    """Which kinds each of the last references of a kind may lead to, and those before them like the first of these."""
    return tuple(tuple(word.split("/")) for word in _AROUND[kind].referred.split())


def _header(held: bytes) -> tuple[re.Match[bytes], int]:
    """What a header says, and where the data begin."""
    begin = _BEGIN.match(held)
    if begin is None:
        raise ReadError("not a readable STEP file")
    found = _HEADER.fullmatch(_COMMENT.sub(rb"\1", begin[1]))
    if found is None:
        raise ReadError("the header of the STEP file is none of description, name and schema")
    refuse_if(not _SCHEMA.match(found[3]), "the STEP file is not of the schema AUTOMOTIVE_DESIGN")
    return found, begin.end()


def _pieces(source: BinaryIO) -> Iterator[bytes]:
    """What lies between DATA and its end, in pieces of whole entities."""
    held = source.read(_PIECE)
    _, end_of_header = _header(held)
    held = held[end_of_header:]
    while more := source.read(_PIECE):
        cut = max(held.rfind(end) for end in (b";\n#", b";\r\n#", b";#")) + 1
        refuse_if(cut == 0, f"the STEP file has no end of an entity in {_PIECE} bytes")
        yield held[:cut]
        held = held[cut:] + more
    end = _END.search(held, max(0, len(held) - _TAIL))
    if end is None:
        raise ReadError("the STEP file does not come to its end")
    yield held[: end.start()]


def _without_strings(piece: bytes) -> tuple[bytes, list[bytes]]:
    """A piece without blanks, a " for each string, before it the number of one that is not empty: !7"; and these."""
    if b"/*" in piece:
        piece = _COMMENT.sub(lambda m: m[1] or b" ", piece)
    parts = piece.split(b"'")
    refuse_if(len(parts) % 2 == 0, "a string in the STEP file has no end")
    refuse_if(_CONTROL.search(b"".join(parts[1::2])), "a string in the STEP file holds a line end")
    strings: list[bytes] = []
    for number, text in enumerate(parts[1::2]):
        if text:
            parts[2 * number] += b"!%d" % len(strings)
            strings.append(text)
    text = b'"'.join(parts[::2])
    if text.count(b'"') != len(parts) // 2 or text.count(b"!") != len(strings):
        raise ReadError("the STEP file holds binary data or entities of its own")
    _check_blanks(text)
    return text.translate(None, _BLANK).replace(b".T.", b"1").replace(b".F.", b"0"), strings


def _check_blanks(text: bytes) -> None:
    """No blank stands within a word or a number."""
    bytes_ = np.frombuffer(text.strip(_BLANK), np.uint8)
    blank, word = _IS_BLANK[bytes_], _IS_WORD[bytes_]
    before, after = np.flatnonzero(blank[1:] & ~blank[:-1]), np.flatnonzero(blank[:-1] & ~blank[1:]) + 1
    refuse_if(np.any(word[before] & word[after]), "a blank stands within a word of the STEP file")


def _by_kind(text: bytes) -> dict[str, list[bytes]]:
    """The statements of a piece: #1=KIND(…)."""
    found = defaultdict[bytes, list[bytes]](list)
    *statements, rest = text.split(b";")
    for statement in statements:
        found[statement[statement.find(b"=") + 1 : statement.find(b"(")]].append(statement)
    if rest:
        raise ReadError(f"the STEP file ends within {_told(rest)}")
    return {kind.decode("latin-1"): mine for kind, mine in found.items()}


def _shape(text: str) -> bytes:
    """The expression of arguments, with what varies in groups."""
    words = re.findall(r"[A-Z_]{2,}|.", text)
    found = (_ATOMS.get(word) or re.escape(word.encode()) for word in words)
    return b"".join(found)


@cache
def _pattern(kind: str) -> re.Pattern[bytes]:
    """What a statement of a kind looks like: its id and what varies in it in groups, or first all its arguments."""
    if kind in _GEOMETRY:
        arguments = _shape(_GEOMETRY[kind])
    elif kind in _AROUND and kind not in _COMPLEX:
        arguments = rb"(%b)" % _shape(_AROUND[kind].arguments)
    else:
        raise ReadError(f"the STEP file holds {kind[:_SHOWN]}, which is not known: it may change what is seen")
    return re.compile(rb";#(\d{1,15})=%b\(%b\)(?=;)" % (kind.encode(), arguments))


@cache
def _complexes() -> dict[str, re.Pattern[bytes]]:
    return {name: re.compile(rb"#(\d{1,15})=(%b)" % _shape(_AROUND[name].arguments)) for name in _COMPLEX}


def _matched(kind: str, statements: list[bytes]) -> list[Row]:
    """Id and arguments of all statements of a kind."""
    pattern = _pattern(kind)
    rows: list[Row] = pattern.findall(b";%b;" % b";".join(statements))
    if len(rows) != len(statements):
        wrong = next(s for s in statements if not pattern.match(b";%b;" % s))
        raise ReadError(f"{_told(wrong)} of the STEP file is not what {kind} has to be")
    return rows


def _told(statement: bytes) -> str:
    """A statement, or its beginning, to be shown."""
    text = statement.decode("ascii", errors="replace")
    return text if len(text) <= _SHOWN else f"{text[:_SHOWN]} …"


def _table(rows: list[Row]) -> Table:
    numbers = np.array(list(map(float, chain.from_iterable(rows)))).reshape(len(rows), -1)
    if not np.abs(numbers).max() <= _MOST:
        wrong = int(np.argmax(np.abs(numbers).max(axis=1)))
        raise ReadError(f"#{rows[wrong][0].decode()} of the STEP file holds a number beyond any length")
    return Table(numbers[:, 0].astype(np.int64), numbers[:, 1:])


def _complex(statements: list[bytes], strings: list[bytes]) -> Iterator[tuple[int, Item]]:
    for statement in statements:
        found = [(name, m) for name, pattern in _complexes().items() if (m := pattern.fullmatch(statement))]
        if not found:
            raise ReadError(f"{_told(statement)} of the STEP file is not known: it may change what is seen")
        (name, match), *_ = found
        yield int(match[1]), _item(name, match[2], strings)


def _item(kind: str, text: bytes, strings: list[bytes]) -> Item:
    # an apostrophe in a string is two, which have cut it in two
    runs = _STRINGS.findall(text) if b'"' in text else []
    words = (
        "" if run == b'"' else _decoded(b"'".join(strings[int(m)] if m else b"" for m in _STRING.findall(run)))
        for run in runs
    )
    measured = b"_MEASURE(" in text
    return Item(
        kind,
        tuple(map(int, _REFERENCES.findall(text))),
        tuple(words),
        tuple(map(float, _NUMBER.findall(text))) if b"." in text else (),
        tuple(m.decode() for m in _MEASURE.findall(text)) if measured else (),
    )


@lru_cache
def _decoded(text: bytes) -> str:
    """A string with its escapes resolved; most are the same in every file."""

    def letters(found: re.Match[str]) -> str:
        *hexadecimal, upper, backslash, lone = found.groups()
        if lone:
            raise ValueError("a backslash alone")
        for digits, code in zip(hexadecimal, _CODES, strict=True):
            if digits:
                return bytes.fromhex(digits).decode(code)
        return chr(ord(upper) + 128) if upper else str(backslash)

    try:
        told = text.decode("utf-8")
        return _ESCAPE.sub(letters, told) if "\\" in told else told
    except ValueError as error:
        raise ReadError(f"a name in the STEP file cannot be read: {text[:_SHOWN]!r}") from error

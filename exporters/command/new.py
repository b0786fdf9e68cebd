"""``higherpair new KIND``: a commented scene to start from, every key with unit, range and default.

All that it shows of a kind stands in the kind's keys: what they mean, their defaults, examples of what has none.
"""

from __future__ import annotations

import os
import re
import tomllib
from argparse import Namespace
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from itertools import takewhile
from pathlib import Path
from textwrap import wrap
from types import MappingProxyType
from typing import Any

from msgspec import Struct
from msgspec.structs import FieldInfo

from exporters.command.asked import DONE, check_language, language_of_command, show_page
from geometry.base.errors import Nearest
from parts.base.fields import fields_of
from parts.base.refusal import SceneError, Typed, meant
from parts.base.registry import KINDS
from parts.base.schema import (
    as_toml,
    described,
    example_of,
    is_open,
    marks_of,
    own_first,
    phrase_of,
    starting_value,
    structs_of,
    table_line,
    tables_of,
)
from parts.base.texts import ENGLISH, N_, Words, words
from parts.keys.sheet import SHEET_KEYS
from parts.mates.registry import MATES
from parts.recipes.registry import RECIPES
from parts.scene.files import built_in_scenes, text_of
from parts.scene.load import PLAIN, load_scene, plain_tables
from parts.scene.scene_file import ExportSpec, SceneInfo

# parts of the scene: a spur gear, the part that another is made from, a second one of a kind; others by their kind
_GEAR, _SOURCE, _OTHER = "gear", "source", "wheel"
_SCHEMA = "higherpair.schema.json"
_NEW = "higherpair new "
_SCHEMA_COMMAND = f"higherpair schema --out {_SCHEMA}"
# the headers of tables that are of no kind, by what they begin with
_HEADERS = {header.strip("[]").partition(".")[0]: header for header in PLAIN}
# tables of a plain scene, as they are printed
_TABLES = ("scene", "parts", "instances", "mates", "drives", "steps", "boards", "beds", "exports", "checks")
# a comment beside a key, colours are none; letters in a line of those that a scene begins with
_COMMENT, _PAGE = re.compile(r"(?m)(?<=\s)# (.+)$"), 118
_COMMENTS = {
    "sheet": N_("picture of meshing of every pair, DXF and SVG"),
    "one_pair": N_("only of this one"),
    "block": N_('GOST 2.104, form 1; or { designation = "...", ... }'),
    "more": N_("a part may stand more than once"),
    "place": N_("mm; or let a mate place it"),
    "contact": N_("contact and overlap through a whole pitch"),
    "names": N_("one file, named parts, true instances"),
}
_SHEET = """
##
## [[exports]]
## format = "sheet"                           # {sheet}
## {only}
## title_block = true                         # {block}"""
_TAIL = """
# {may}
## [[mates]]
## kind = "{mate}"{summary}
## first = "{first}"
## second = "{second}"{direction}
##
## [instances.{other}]
## [instances.second_{other}]{pad}# {more}
## part = "{other}"
## at = [300.0, 0.0, 0.0]                     # {place}
## rotation_deg = 0.0
##
## [[drives]]
## instance = "{first}"
## turns = 1.0
##
## [checks]
## interference = true                        # {contact}{transmission}
##
## [[exports]]
## format = "step"
## assembly = true                            # {names}"""


def run(options: Namespace) -> int:
    """The exit code."""
    check_language(options)
    text = _made(options.kind, language_of_command(options)) or _scene_text(options)
    show_page(plain_scene(text, options.kind) if options.expand else text, options)
    return DONE


def _made(name: str, language: str) -> str | None:
    """The text for a kind or one of its tables; None of a scene: one that has the name of a kind has its ending."""
    makers: tuple[tuple[Collection[str], Callable[[str, str], str]], ...]
    makers = (KINDS, new_scene), (MATES, new_mate), (RECIPES, new_assembly)
    for kinds, make in makers:
        if name in kinds:
            return make(name, language)
    return None if name in _scenes() else new_table(name, language)


def _scene_text(options: Namespace) -> str:
    """The text of a built-in scene, or of a scene file that is to be expanded."""
    scenes = _scenes()
    if options.kind not in scenes:
        if not (options.expand and os.path.isfile(options.kind)):
            raise _unknown(options.kind)
        # whatever is wrong with it is told first
        load_scene(options.kind)
    text = text_of(Path(scenes.get(options.kind, options.kind)).read_bytes())
    if options.language is not None and options.kind in scenes and "\nlanguage = " not in text:
        text = text.replace("[scene]\n", f'[scene]\nlanguage = "{options.language}"\n', 1)
        text = text if options.language == ENGLISH else commented(text, words(options.language))
    return text


def _scenes() -> dict[str, Path]:
    """The built-in scenes by their names, with and without their ending."""
    return {address: file for name, file in built_in_scenes().items() for address in (name, file.name)}


def _unknown(name: str) -> SceneError:
    """The refusal of a name that is of no kind, table or scene."""
    kind, _, key = name.partition(".")
    if tables := tables_of_kind(kind):
        near = meant(key, tables)
        near = near and Nearest(f"{kind}.{near.value}", "meant")
        return SceneError("new", Typed("KIND"), name, "unknown_table", near, known=[f"{kind}.{one}" for one in tables])
    known = list(dict.fromkeys([*KINDS, *MATES, *RECIPES, *built_in_scenes()]))
    return SceneError("new", Typed("KIND"), name, "unknown_kind", meant(name, known), known=known)


def new_scene(kind: str, language: str = ENGLISH) -> str:
    """The text of a scene with one part of a kind."""
    told, made_from = words(language), KINDS[kind].made_from
    formats = ("dxf", "svg", "stl") if KINDS[kind].has_outline else ("stl", "step")
    owner: list[str] = []
    if made_from is not None:
        note = told.text("the part that the one below is made for")
        owner = [f"# {note}", f"[parts.{_SOURCE}]", *(f"{key} = {as_toml(v)}" for key, v in made_from.items()), ""]
    keys = [f for f in fields_of(ExportSpec) if f.encode_name not in SHEET_KEYS]
    lines = [
        *_head(told),
        *owner,
        f"[parts.{_called(kind)}]",
        f'kind = "{kind}"',
        *_keys(own_first(KINDS[kind].keys), told, {"of": _SOURCE}),
        "",
        "[[exports]]",
        *_keys(keys, told, {"format": formats[0]}, {"parts": [_called(kind)]}),
        *(line for one in formats[1:] for line in ("", "[[exports]]", f'format = "{one}"')),
        *_several(kind, told),
    ]
    return "\n".join(lines) + "\n"


def commented(text: str, told: Words) -> str:
    """A built-in scene with its comments in another language, as far as that has them."""
    head, rest = _opening(text)
    lines = wrap(" ".join(told.text(sentence) for sentence in _sentences(head)), _PAGE)
    return "".join(f"# {line}\n" for line in lines) + _COMMENT.sub(lambda found: f"# {told.text(found[1])}", rest)


def comments_of(text: str) -> list[str]:
    """The comments of a built-in scene: the sentences that it begins with, and those beside its keys."""
    head, rest = _opening(text)
    return [*_sentences(head), *_COMMENT.findall(rest)]


def _opening(text: str) -> tuple[str, str]:
    """The comment at the start of a scene, and the rest of it."""
    lines = takewhile(lambda line: line.startswith("# "), text.splitlines(keepends=True))
    size = sum(map(len, lines))
    return text[:size], text[size:]


def _sentences(head: str) -> list[str]:
    return re.findall(r"\S.*?(?:\.|$)(?= |$)", " ".join(line.removeprefix("# ") for line in head.splitlines()))


def _head(told: Words) -> list[str]:
    """What a scene to start from says first, and of itself."""
    table = _NEW + told.term("command line", "KIND.KEY")
    return [
        # the directive by which an editor finds the schema, see Taplo
        f"#:schema {_SCHEMA}",
        f"# {told.text('A scene of higherpair: build it with  higherpair build THIS_FILE.toml')}",
        f"# {told.text('Lines that begin with # show defaults or examples; remove the # to set them.')}",
        f"# {told.text('Lengths in mm, angles in degrees.')}",
        f"# {told.text('What the keys of a table mean:  {command}', command=table)}",
        f"# {told.text('An editor of TOML completes the keys after  {command}', command=_SCHEMA_COMMAND)}",
        "",
        "[scene]",
        *_keys(fields_of(SceneInfo), told, {} if told.language == ENGLISH else {"language": told.language}),
        "",
    ]


def new_mate(kind: str, language: str = ENGLISH) -> str:
    """The table of a kind of mate, to be put into a scene."""
    told, mate = words(language), MATES[kind]
    keys: type[Struct] = mate.keys
    who = told.text("any two instances")
    if mate.joins is not None:
        pairs = (told.text("{first} and {second}", first=a, second=b) for a, b in mate.joins)
        who = told.text(" or ").join(pairs)
    scene = _scene_of(kind)
    whole = [] if scene is None else [f"# {told.text('A whole scene of it: {command}', command=_NEW + scene.name)}"]
    lines = [
        f"# {told.text(MATES.phrases[kind])}.",
        f"# {told.text('A table to be added to a scene that has both parts; it is no scene by itself.')}",
        f"# {told.text('Joins {who}; see higherpair new KIND for their keys.', who=who)}",
        *whole,
        "[[mates]]",
        f'kind = "{kind}"',
        *_keys(fields_of(keys), told, dict(zip(("first", "second"), _called_both(kind), strict=True))),
    ]
    return "\n".join(lines) + "\n"


def new_table(place: str, language: str = ENGLISH) -> str | None:
    """The tables that a key takes, ``KIND.KEY`` or deeper, each key with unit, range and default; None: it takes none.

    A table of a scene that is of no kind, like ``exports``, stands for a kind, and may be asked for itself.
    """
    told, (kind, *names) = words(language), place.split(".")
    tables, header = _tables_at(kind), _HEADERS.get(kind, "")
    if not tables or not (names or header):
        return None
    is_list = header.startswith("[[")
    for name in names:
        fields = [f for table in tables for f in fields_of(table) if f.encode_name == name]
        tables = list(dict.fromkeys(one for f in fields for one in structs_of(f.type)))
        is_list = any(not tables_of(f) for f in fields)
    head = {**{one: f"parts.{_called(one)}" for one in KINDS}, **dict.fromkeys(MATES, "mates")}
    there = ".".join([header.strip("[]") or head.get(kind, "assemblies"), *names])
    lines = [f"# {told.text('Lengths in mm, angles in degrees.')}"]
    for table in tables:
        config = table.__struct_config__
        tag = [f'{config.tag_field} = "{config.tag}"'] if config.tag_field else []
        # of what a header names its keys say enough
        phrase = [] if names == [] else [f"# {told.text(phrase_of(table))}."]
        lines += ["", *phrase, f"[[{there}]]" if is_list else f"[{there}]", *tag, *_keys(fields_of(table), told)]
    # in letters that every terminal has, as all that is new
    return "\n".join(lines).replace("…", "...") + "\n" if tables else None


def _tables_at(kind: str) -> list[type[Struct]]:
    """The keys of a kind, or of a table of a scene that is of none; no table where there is no such kind."""
    known: Mapping[str, Any] = next((found for found in (KINDS, MATES, RECIPES) if kind in found), {})
    return [known[kind].keys] if known else [PLAIN[_HEADERS[kind]]] if kind in _HEADERS else []


def tables_of_kind(kind: str) -> list[str]:
    """The keys of a kind that ``new_table`` can be asked for."""
    return [f.encode_name for table in _tables_at(kind) for f in fields_of(table) if structs_of(f.type)]


def _scene_of(kind: str) -> Path | None:
    """The built-in scene of a kind of mate: that of its name, else the shortest with the fewest other kinds."""
    ranks = {}
    for name, file in built_in_scenes().items():
        text = file.read_text(encoding="utf-8")
        mates = [mate for mate in MATES if f'kind = "{mate}"' in text]
        if kind in mates:
            ranks[file] = name != kind, len(mates), len(text)
    return min(ranks, key=ranks.__getitem__, default=None)


def new_assembly(kind: str, language: str = ENGLISH) -> str:
    """The text of a scene with one assembly of a kind."""
    told, expand = words(language), f"higherpair new {kind} --expand"
    lines = [
        *_head(told),
        f"# {told.text(RECIPES.phrases[kind])}.",
        f"# {told.text('It becomes parts, instances and mates; see {command}', command=expand)}",
        "[[assemblies]]",
        f'kind = "{kind}"',
        *_keys(own_first(RECIPES[kind].keys), told),
        "",
        "[[exports]]",
        'format = "step"',
        f"assembly = true                            # {told.text(_COMMENTS['names'])}",
        "",
        "[checks]",
        f"interference = true                        # {told.text(_COMMENTS['contact'])}",
    ]
    return "\n".join(lines) + "\n"


def topic_keys(topic: str, keys: type[Struct], others: Iterable[tuple[str, str]] = (), language: str = ENGLISH) -> str:
    """What may be typed for a topic of ``calc``: its keys, and of which parts those stand that a name goes before.

    ``others``: keys that choose another kind of part, and that kind.
    """
    told = words(language)
    tables = {f.encode_name: f.type for f in fields_of(keys) if isinstance(f.type, type) and issubclass(f.type, Struct)}
    parts = {name: str(tag) for name, table in tables.items() if (tag := table.__struct_config__.tag) in KINDS}
    inner = {name: _keys(fields_of(table), told) for name, table in tables.items() if name not in parts}
    typed = N_("Each is typed as key=value, without blanks. Lines that begin with # show defaults or examples.")
    lines = [
        f"# {told.text('Keys of {command}.', command=f'higherpair calc {topic}')}",
        f"# {told.text(typed)}",
        f"# {told.text('Lengths in mm, angles in degrees.')}",
        *(f"# {name}.KEY=…: {told.text('see {command}', command=f'{_NEW}{kind}')}" for name, kind in parts.items()),
        *(f"# {key}={kind}: {told.text('see {command}', command=_NEW + kind)}" for key, kind in others),
        *(f"{name}.{line}" for name, own in inner.items() for line in own),
        *_keys([f for f in own_first(keys) if f.encode_name not in tables], told),
    ]
    return "\n".join(lines) + "\n"


def plain_scene(text: str, source: str) -> str:
    """The text of a scene, its defaults filled in, its assemblies told out as parts, instances, mates and drives."""
    raw, *_ = plain_tables(tomllib.loads(text), source)
    lines: list[str] = []
    for name in [name for name in _TABLES if name in raw]:
        table = raw[name]
        if name in ("parts", "instances", "boards", "beds"):
            for key, own in table.items():
                lines += ["", f"[{name}.{key}]", *(f"{k} = {as_toml(v)}" for k, v in own.items())]
        else:
            head = f"[[{name}]]" if isinstance(table, list) else f"[{name}]"
            for own in table if isinstance(table, list) else [table]:
                lines += ["", head, *(f"{k} = {as_toml(v)}" for k, v in own.items())]
    return "\n".join(lines[1:]) + "\n"


def _keys(
    keys: Iterable[FieldInfo],
    told: Words,
    names: Mapping[str, str] | None = None,
    shown: Mapping[str, object] = MappingProxyType({}),
) -> Iterator[str]:
    """One line a key; keys with a default stand commented out, but for ``names``: those that the scene itself gives.

    ``shown``: values to be seen behind the # in place of defaults and examples.
    """
    for field in keys:
        name, meta = field.encode_name, example_of(field.type)
        marks = marks_of(meta)
        given = names is not None and name in names
        set_here = given or field.required or "start" in marks
        told_here = names if names and given else shown
        value = as_toml(told_here[name]) if name in told_here else starting_value(field, meta)
        code, text = f"{'' if set_here else '# '}{name} = {value}", told.say(described(field.type) or "")
        yield f"{code:<44} # {text}" if text else code
        others = [(as_toml(other), told.text(meant)) for other, meant in marks.get("others", ())]
        tables = tables_of(field)
        others += [(table_line(t), told.text(phrase_of(t))) for t in (tables[1:] if is_open(field) else tables)]
        yield from (f"# {name} = {v}  # {told.text('... or this: {what}', what=meant)}" for v, meant in others)


def _several(kind: str, told: Words) -> list[str]:
    """Commented lines for more parts: the first kind of mate that joins this one, a sheet where one applies."""
    mate, places = _mate_of(kind)
    # of two equal kinds the part above is the first
    own = 0 if places is None else places.index(kind)
    other = _OTHER if places is None else _beside(_called(kind), _called(places[1 - own]))
    if KINDS[kind].made_from is not None:
        other = _SOURCE
    part = f"[parts.{other}]"
    if places is not None:
        part = told.text('{part} of kind "{kind}"', part=part, kind=places[1 - own])
    toothed = MATES[mate].meshes
    keys: type[Struct] = MATES[mate].keys
    turned = next((f.default for f in fields_of(keys) if f.encode_name == "direction_deg"), None)
    comments = {name: told.text(text) for name, text in _COMMENTS.items()}
    may = N_("With a second part, {part}, the two can be joined and written as one assembly; remove both #:")
    if toothed:
        may = N_("With a second part, {part}, the two can be put in mesh and written as one assembly; remove both #:")
    uneven = told.text("transmission error of each mate, without load")
    purpose, shown = KINDS[kind].sheet_shown or ("", "")
    text = _TAIL
    only = f"mate = 1                                   # {comments['one_pair']}{told.text(shown)}"
    if toothed or purpose:
        text += _SHEET
    if purpose and not toothed:
        only, comments["sheet"] = f'purpose = "{purpose}"', told.text(shown)
    return text.format(
        **comments,
        may=told.text(may, part=part),
        other=other,
        mate=mate,
        summary=f"{' ' * max(1, 34 - len(mate))}# {told.text('see {command}', command=f'higherpair new {mate}')}",
        first=(_called(kind), other)[own],
        second=(other, _called(kind))[own],
        direction="" if turned is None else f"\n## direction_deg = {turned}",
        pad=" " * max(1, 24 - len(other)),
        transmission=f"\n## transmission_error = true                  # {uneven}" if toothed else "",
        only=only,
    ).splitlines()


def _called(kind: str) -> str:
    """The id of a part of a kind."""
    return _GEAR if kind == "spur_gear" else kind


def _beside(name: str, other: str) -> str:
    """That of another part beside one."""
    return _OTHER if other == name else other


def _called_both(mate: str) -> tuple[str, str]:
    """Those of the parts that a kind of mate joins."""
    first, second = map(_called, (MATES[mate].joins or (("spur_gear", "spur_gear"),))[0])
    return first, _beside(first, second)


def _mate_of(kind: str) -> tuple[str, tuple[str, str] | None]:
    """The first kind of mate that joins a kind of part, that with what it is made from before the others, and both its
    kinds; else the one that joins anything.
    """
    if (shown := KINDS[kind].mate_shown) is not None:
        return shown, None
    found = [(mate.name, places) for mate in MATES.values() for places in mate.joins or () if kind in places]
    source = (KINDS[kind].made_from or {}).get("kind")
    return next((one for one in found if source in one[1]), found[0] if found else ("fixed", None))

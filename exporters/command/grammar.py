"""What a command line may say: the commands, and what each of them takes."""

from __future__ import annotations

from argparse import SUPPRESS, ArgumentTypeError
from collections.abc import Callable
from functools import cache, partial
from pathlib import Path
from typing import Any, TypeAlias

from exporters import __version__, documents
from exporters.command.parser import Parser
from parts.base.psv import rows_of
from parts.base.texts import N_, NC_, Words, languages

# what stands for the words of a command line
_SHOWN = (
    NC_("command line", "COMMAND"), NC_("command line", "SCENE"), NC_("command line", "FILE"),
    NC_("command line", "PART.KEY=VALUES"), NC_("command line", "ADDRESS"), NC_("command line", "TOPIC"),
    NC_("command line", "SCENE | KEY=VALUE"), NC_("command line", "KIND"), NC_("command line", "ID"),
    NC_("command line", "L"),
)  # fmt: skip
_EXAMPLES = """
  higherpair build practicum_pair
  higherpair new spur_gear --out my_gear.toml
  higherpair build my_gear.toml --format dxf --format stl
  higherpair check practicum_pair
  higherpair verify out/practicum_pair/*.dxf
  higherpair calc gear-pair practicum_pair"""


@cache
def grammar(told: Words) -> Parser:
    """The parser of the command, in a language; what one of its commands takes is added when that is asked for."""
    parser = Parser(
        prog="higherpair",
        description=told.text(
            "Exact gears, cams and mechanisms as DXF, SVG, STL, 3MF and STEP, each file read back and measured."
        ),
        epilog=told.text("examples:") + _EXAMPLES,
    )
    version = told.text("show program's version number and exit")
    parser.add_argument("-V", "--version", action="version", version=f"higherpair {__version__}", help=version)
    # before a command it is heard too, and not undone by that
    parser.add_argument("--language", **_language(told))
    commands = parser.add_subparsers(
        prog="higherpair", required=True, metavar=_shown(told, "COMMAND"), parser_class=Parser
    )
    for name, (meaning, takes) in _COMMANDS.items():
        command: Parser = commands.add_parser(name, help=told.text(meaning))
        command.set_defaults(command=name, json=False, quiet=False)
        command.takes = partial(_take, takes=takes, told=told)
    return parser


def _take(command: Parser, takes: tuple[_Taken, ...], told: Words) -> None:
    command.add_argument("--language", default=SUPPRESS, **_language(told))
    for take in takes:
        take(command, told)


def _language(told: Words) -> dict[str, Any]:
    default = told.text("{languages} (default: that of the scene, or en)", languages=", ".join(languages()))
    return {"metavar": _shown(told, "L"), "help": default}


def _shown(told: Words, word: str) -> str:
    return told.term("command line", word)


def _json(command: Parser, told: Words) -> None:
    command.add_argument("--json", action="store_true", help=told.text("print the results as JSON"))


def _quiet(command: Parser, told: Words) -> None:
    command.add_argument("-q", "--quiet", action="store_true", help=told.text("print nothing if all is well"))


def _scene(command: Parser, told: Words) -> None:
    asked = told.text("a built-in scene or a scene file (.toml)")
    command.add_argument("scene", metavar=_shown(told, "SCENE"), help=asked)


def _scenes(command: Parser, told: Words) -> None:
    asked = told.text("built-in scenes or scene files (.toml)")
    command.add_argument("scenes", nargs="+", metavar=_shown(told, "SCENE"), help=asked)
    command.set_defaults(several=("scenes", str))


def _place(told: Words) -> Callable[[str], Path]:
    def place(word: str) -> Path:
        if not word:
            raise ArgumentTypeError(told.text('"" names no place'))
        return Path(word)

    return place


def _page(command: Parser, told: Words) -> None:
    to_file = told.text("write to a file, in UTF-8 (default: to the terminal)")
    command.add_argument("--out", type=_place(told), metavar=_shown(told, "FILE"), help=to_file)
    command.add_argument("--force", action="store_true", help=told.text("write over a file that is there already"))


def _results(command: Parser, told: Words) -> None:
    results = told.text("write the results to OUT/<scene name> (default: out)")
    command.add_argument("--out", default="out", type=_place(told), help=results)


def _build(command: Parser, told: Words) -> None:
    part, one_format = told.text("only this part (may be repeated)"), told.text("only this format (may be repeated)")
    command.add_argument("--part", metavar=_shown(told, "ID"), help=part, action="append", default=[])
    command.add_argument("--format", metavar="F", help=one_format, action="append", default=[])
    command.add_argument("--no-verify", action="store_true", help=told.text("do not read the files back"))
    who = told.text("what reads STEP files back: our reader, or the CAD kernel too")
    command.add_argument("--verify", choices=["reader", "kernel"], default="reader", help=who)


def _vary(command: Parser, told: Words) -> None:
    values = told.text("values 1,2,5 or a range 8:200 or 0.5:2:0.25, ends included (may be repeated)")
    command.add_argument("--vary", action="append", required=True, metavar=_shown(told, "PART.KEY=VALUES"), help=values)
    workers = command.add_mutually_exclusive_group()
    workers.add_argument("--jobs", type=int, default=1, metavar="N", help=told.text("processes (default: 1)"))
    cluster = told.text("a Dask cluster that works on the same disk, like tcp://host:8786")
    workers.add_argument("--dask", metavar=_shown(told, "ADDRESS"), help=cluster)


def _steps(command: Parser, told: Words) -> None:
    steps = told.text("print the order of assembly too, if the scene has one")
    command.add_argument("--steps", action="store_true", help=steps)


def _files(command: Parser, told: Words) -> None:
    command.add_argument("files", nargs="+", type=Path, metavar=_shown(told, "FILE"))
    command.set_defaults(several=("files", Path))


def _converge(command: Parser, told: Words) -> None:
    part, one_format = told.text("only this part"), told.text("only this format")
    command.add_argument("--part", metavar=_shown(told, "ID"), help=part, action="append", default=[])
    command.add_argument("--format", metavar="F", help=one_format, action="append", default=[])


def _stress(command: Parser, told: Words) -> None:
    results = told.text("write the results to OUT/stress (default: out)")
    command.add_argument("--out", help=results, default="out", type=_place(told))


def _calc(command: Parser, told: Words) -> None:
    # to import what makes them would cost more than all else of the command line
    *topics, last = (topic for topic, *_ in rows_of(documents.__file__, "topics"))
    known = told.text("{topics} or {last}", topics=", ".join(topics), last=last)
    command.add_argument("topic", metavar=_shown(told, "TOPIC"), help=known)
    asked = told.text("a scene, or keys as in scenes")
    command.add_argument("words", nargs="*", metavar=_shown(told, "SCENE | KEY=VALUE"), help=asked)
    forms = told.text(
        "text, md, html, json, or the tables alone as csv (default: as the file of --out ends, else text)"
    )
    command.add_argument("--format", metavar="F", help=forms)
    listed = told.text("print every key of the topic with unit, range and default")
    command.add_argument("--keys", action="store_true", help=listed)
    command.set_defaults(several=("words", str))


def _new(command: Parser, told: Words) -> None:
    kinds = told.text(
        "a kind of part or mate or a built-in scene, see `{command}`; {table}: the keys of a table",
        command="higherpair list",
        table="spur_gear.bore",
    )
    command.add_argument("kind", metavar=_shown(told, "KIND"), help=kinds)
    plain = told.text("print the plain scene that an assembly, or a scene with one, becomes")
    command.add_argument("--expand", action="store_true", help=plain)


_Taken: TypeAlias = Callable[[Parser, Words], None]
# what each command does, and takes
_COMMANDS: dict[str, tuple[str, tuple[_Taken, ...]]] = {
    "build": (N_("make the files of a scene"), (_json, _quiet, _scenes, _results, _build)),
    "catalogue": (
        N_("build a scene for every combination of the values of some keys"), (_quiet, _scene, _vary, _results)
    ),
    "check": (N_("check contact and interference of the pairs of a scene"), (_json, _quiet, _scenes, _steps)),
    "verify": (N_("read files back and compare them with the part in their report"), (_json, _quiet, _files)),
    "converge": (N_("measure error against run time, over a ladder of tolerances"), (_scene, _results, _converge)),
    "stress": (N_("measure how many digits stiff and extreme cases leave"), (_json, _quiet, _stress)),
    "list": (N_("list kinds of parts and built-in scenes"), (_json,)),
    "calc": (N_("print a textbook calculation, step by step"), (_page, _calc)),
    "new": (N_("print a scene with comments to start from; for a mate, its table"), (_page, _new)),
    "schema": (N_("print the JSON Schema of scenes, by which an editor completes keys"), (_page,)),
}  # fmt: skip

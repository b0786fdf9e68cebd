"""The command ``higherpair``. Exit codes: 0 done, 1 a check failed, 2 wrong input (one clear line)."""

from __future__ import annotations

import argparse
import errno
import gc
import os
import sys
from collections.abc import Callable, Collection, Iterator, Sequence
from contextlib import contextmanager, suppress
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

from exporters import __version__, documents
from exporters.command.parser import WRONG_INPUT, Misused, Parser, parsed, speaking
from exporters.command.process import nowhere, stoppable, whole_process
from parts.base.psv import rows_of
from parts.base.texts import ENGLISH, N_, NC_, Words, languages, words

if TYPE_CHECKING:
    from exporters.production.plan import Plan
    from parts.scene.scene_file import SceneFile

DONE, FAILED = 0, 1
# so many things are made between two searches for circles of them
_MADE = 100_000
_OURS = {"geometry", "parts", "exporters"}
S = TypeVar("S")
T = TypeVar("T")
# what stands for the words of a command line
_SHOWN = (
    NC_("command line", "COMMAND"), NC_("command line", "SCENE"), NC_("command line", "FILE"),
    NC_("command line", "PART.KEY=VALUES"), NC_("command line", "ADDRESS"), NC_("command line", "TOPIC"),
    NC_("command line", "SCENE | KEY=VALUE"), NC_("command line", "KIND"), NC_("command line", "ID"),
    NC_("command line", "L"),
)  # fmt: skip
# what a system says of a disk most often
_OF_SYSTEM = (
    N_("No such file or directory"), N_("Permission denied"), N_("Is a directory"), N_("Not a directory"),
    N_("No space left on device"), N_("Read-only file system"), N_("File name too long"), N_("File exists"),
    N_("Operation not permitted"),
)  # fmt: skip
_EXAMPLES = """
  higherpair build practicum_pair
  higherpair new spur_gear --out my_gear.toml
  higherpair build my_gear.toml --format dxf --format stl
  higherpair check practicum_pair
  higherpair verify out/practicum_pair/*.dxf
  higherpair calc gear-pair practicum_pair"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    # numpy is not loaded yet: its threads would take longer to start than all that we compute
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # of a million things that a build makes hardly one is part of a circle: to look for those less often saves time
    gc.set_threshold(_MADE)
    asked = list(sys.argv[1:] if arguments is None else arguments)
    # cmd, and zsh where somebody types, hand on what other shells take for a comment
    asked = asked[: asked.index("#")] if "#" in asked else asked
    return stoppable(lambda: _ended(_parsed(asked)))


def run() -> int:
    """``main`` as a process of its own."""
    return whole_process(main)


def _ended(options: argparse.Namespace) -> int:
    """The exit code of a command; a refusal is told here, as the search for what would work may be stopped too."""
    try:
        code = options.run(options)
        sys.stdout.flush()
        return code
    except BrokenPipeError:
        # whoever read the output has left: nothing more can be said to it
        sys.stdout = nowhere()
        return DONE
    except (OSError, MemoryError, ImportError) as error:
        if (text := _outside(error, options)) is None:
            raise
        print(f"higherpair: {text}", file=sys.stderr)
        return WRONG_INPUT
    except ValueError as error:
        from parts.base.refusal import SceneError, sentence

        if not isinstance(error, SceneError):
            raise
        print(f"higherpair: {sentence(error, _language(options))}", file=sys.stderr)
        return WRONG_INPUT


def _outside(error: OSError | MemoryError | ImportError, options: argparse.Namespace) -> str | None:
    """What a disk, a memory or an installation that is not enough is told by; None of an import of our own."""
    told = words(ENGLISH)
    # a memory that is full may hold no other language
    with suppress(OSError, MemoryError, ImportError):
        told = words(_language(options))
    if isinstance(error, ImportError):
        library = _library(error)
        return library and told.text(
            "{library} cannot be loaded: it is not installed whole, or the memory does not suffice", library=library
        )
    if isinstance(error, MemoryError) or error.errno == errno.ENOMEM:
        return told.text("the memory does not suffice; a larger tolerance or fewer parts need less")
    why = told.text(error.strerror or str(error))
    why = f"{error.filename}: {why}" if error.filename else why
    if "out" in options:
        return told.text("{why}; choose another place with --out", why=why)
    return told.text("{why}; choose another place", why=why)


def _library(error: BaseException | None) -> str | None:
    """The library that could not be imported; None where it is one of our packages."""
    while error is not None:
        file, name = Path(getattr(error, "path", None) or ""), getattr(error, "name", None) or ""
        # a shared library tells its own name without that of its package
        beneath = [file.relative_to(place).parts for place in sys.path if place and file.is_relative_to(place)]
        library = min(beneath, key=len)[0] if beneath else name.partition(".")[0]
        if library and library not in _OURS:
            return library
        error = error.__cause__ or error.__context__
    return None


def _parsed(arguments: list[str]) -> argparse.Namespace:
    """The command line; what argparse says is told in ``--language``, else in the scene's, never the terminal's."""
    given = [one for flag, one in pairwise(arguments) if flag == "--language"]
    given += [one.partition("=")[2] for one in arguments if one.startswith("--language=")]
    if not given and not {"-h", "--help"} & {*arguments}:
        try:
            with speaking(words(ENGLISH)):
                return parsed(_parser(words(ENGLISH)), arguments)
        except Misused:
            # to be told again, in the language of the scene
            pass
    # the first is the command
    asked = given[-1] if given else _language_among(arguments[1:])
    told = words(asked if asked in languages() else ENGLISH)
    with speaking(told):
        try:
            return parsed(_parser(told), arguments)
        except Misused as misused:
            print(misused, file=sys.stderr)
            sys.exit(WRONG_INPUT)


def _language_among(addresses: Sequence[str]) -> str:
    """The language of the first of some words that names a scene."""
    named = [one for one in addresses if one and "=" not in one and not one.startswith("-")]
    if not named:
        return ENGLISH
    from parts.scene.language import language_of

    return next((one for one in map(language_of, named) if one != ENGLISH), ENGLISH)


def _language(options: argparse.Namespace) -> str:
    """The language of a command: that of --language or nearest to it, of the scene, or of one among words of calc."""
    from parts.scene.language import language_meant

    if options.language in languages():
        return str(options.language)
    asked = vars(options)
    if options.language and (close := language_meant(options.language)):
        return close
    return _language_among([*asked.get("scenes", []), *filter(None, [asked.get("scene")]), *asked.get("words", [])])


def _check_language(options: argparse.Namespace) -> None:
    """Refuse a language without a catalogue."""
    if options.language not in (None, *languages()):
        from parts.base.refusal import SceneError, meant

        known = languages()
        given = options.language
        raise SceneError(options.command, "--language", given, "not_one_of", meant(given, known), known=known)


def _scene(address: str, options: argparse.Namespace) -> SceneFile:
    """A scene of a command, in its language."""
    from parts.scene.load import load_scene

    _check_language(options)
    return load_scene(address, options.language)


@cache
def _parser(told: Words) -> Parser:
    parser = Parser(
        prog="higherpair",
        description=told.text(
            "Exact gears, cams and mechanisms as DXF, SVG, STL, 3MF and STEP, each file read back and measured."
        ),
        epilog=told.text("examples:") + _EXAMPLES,
    )
    version = told.text("show program's version number and exit")
    parser.add_argument("-V", "--version", action="version", version=f"higherpair {__version__}", help=version)
    default = told.text("{languages} (default: that of the scene, or en)", languages=", ".join(languages()))
    # before a command it is heard too, and not undone by that
    language: dict[str, Any] = {"metavar": told.term("command line", "L"), "help": default}
    parser.add_argument("--language", **language)

    def shown(word: str) -> str:
        return told.term("command line", word)

    commands = parser.add_subparsers(prog="higherpair", required=True, metavar=shown("COMMAND"), parser_class=Parser)

    def argument_of(name: str, **looks: Any) -> Parser:
        """What several commands take."""
        taken = Parser(add_help=False)
        taken.add_argument(*name.split(), **looks)
        return taken

    def command(name: str, meaning: str, run: Callable[[argparse.Namespace], int], *takes: Parser) -> Parser:
        made: Parser = commands.add_parser(name, help=meaning, parents=[spoken, *takes])
        made.set_defaults(command=name, json=False, quiet=False, run=run)
        return made

    spoken = argument_of("--language", default=argparse.SUPPRESS, **language)
    as_json = argument_of("--json", action="store_true", help=told.text("print the results as JSON"))
    quiet = argument_of("-q --quiet", action="store_true", help=told.text("print nothing if all is well"))
    to_file = told.text("write to a file, in UTF-8 (default: to the terminal)")

    def place(word: str) -> Path:
        if not word:
            raise argparse.ArgumentTypeError(told.text('"" names no place'))
        return Path(word)

    page = argument_of("--out", type=place, metavar=shown("FILE"), help=to_file)
    scene = told.text("a built-in scene or a scene file (.toml)")
    of_scenes = told.text("built-in scenes or scene files (.toml)")
    results = told.text("write the results to OUT/<scene name> (default: out)")
    one_scene = argument_of("scene", metavar=shown("SCENE"), help=scene)
    scenes = argument_of("scenes", nargs="+", metavar=shown("SCENE"), help=of_scenes)
    # what arguments of one kind share
    out: dict[str, Any] = {"default": "out", "type": place}
    repeated: dict[str, Any] = {"action": "append", "default": []}

    build = command("build", told.text("make the files of a scene"), _build, as_json, quiet, scenes)
    build.add_argument("--out", help=results, **out)
    build.add_argument("--part", metavar=shown("ID"), help=told.text("only this part (may be repeated)"), **repeated)
    build.add_argument("--format", metavar="F", help=told.text("only this format (may be repeated)"), **repeated)
    build.add_argument("--no-verify", action="store_true", help=told.text("do not read the files back"))
    who = told.text("what reads STEP files back: our reader, or the CAD kernel too")
    build.add_argument("--verify", choices=["reader", "kernel"], default="reader", help=who)
    build.set_defaults(several=("scenes", str))

    meaning = told.text("build a scene for every combination of the values of some keys")
    catalogue = command("catalogue", meaning, _catalogue, quiet, one_scene)
    values = told.text("values 1,2,5 or a range 8:200 or 0.5:2:0.25, ends included (may be repeated)")
    catalogue.add_argument("--vary", action="append", required=True, metavar=shown("PART.KEY=VALUES"), help=values)
    workers = catalogue.add_mutually_exclusive_group()
    workers.add_argument("--jobs", type=int, default=1, metavar="N", help=told.text("processes (default: 1)"))
    cluster = told.text("a Dask cluster that works on the same disk, like tcp://host:8786")
    workers.add_argument("--dask", metavar=shown("ADDRESS"), help=cluster)
    catalogue.add_argument("--out", help=results, **out)

    meaning = told.text("check contact and interference of the pairs of a scene")
    check = command("check", meaning, _check, as_json, quiet, scenes)
    steps = told.text("print the order of assembly too, if the scene has one")
    check.add_argument("--steps", action="store_true", help=steps)
    check.set_defaults(several=("scenes", str))

    meaning = told.text("read files back and compare them with the part in their report")
    verify = command("verify", meaning, _verify, as_json, quiet)
    verify.add_argument("files", nargs="+", type=Path, metavar=shown("FILE"))
    verify.set_defaults(several=("files", Path))

    meaning = told.text("measure error against run time, over a ladder of tolerances")
    converge = command("converge", meaning, _converge, one_scene)
    converge.add_argument("--out", help=results, **out)
    converge.add_argument("--part", metavar=shown("ID"), help=told.text("only this part"), **repeated)
    converge.add_argument("--format", metavar="F", help=told.text("only this format"), **repeated)

    meaning = told.text("measure how many digits stiff and extreme cases leave")
    stress = command("stress", meaning, _stress, as_json, quiet)
    stress.add_argument("--out", help=told.text("write the results to OUT/stress (default: out)"), **out)

    command("list", told.text("list kinds of parts and built-in scenes"), _list, as_json)

    calc = command("calc", told.text("print a textbook calculation, step by step"), _calc, page)
    # to import what makes them would cost more than all else of the command line
    *topics, last = (topic for topic, *_ in rows_of(documents.__file__, "topics"))
    known = told.text("{topics} or {last}", topics=", ".join(topics), last=last)
    calc.add_argument("topic", metavar=shown("TOPIC"), help=known)
    asked = told.text("a scene, or keys as in scenes")
    calc.add_argument("words", nargs="*", metavar=shown("SCENE | KEY=VALUE"), help=asked)
    forms = told.text(
        "text, md, html, json, or the tables alone as csv (default: as the file of --out ends, else text)"
    )
    calc.add_argument("--format", metavar="F", help=forms)
    listed = told.text("print every key of the topic with unit, range and default")
    calc.add_argument("--keys", action="store_true", help=listed)
    calc.set_defaults(several=("words", str))

    meaning = told.text("print a scene with comments to start from; for a mate, its table")
    new = command("new", meaning, _new, page)
    kinds = told.text(
        "a kind of part or mate or a built-in scene, see `{command}`; {table}: the keys of a table",
        command="higherpair list",
        table="spur_gear.bore",
    )
    new.add_argument("kind", metavar=shown("KIND"), help=kinds)
    plain = told.text("print the plain scene that an assembly, or a scene with one, becomes")
    new.add_argument("--expand", action="store_true", help=plain)

    command("schema", told.text("print the JSON Schema of scenes, by which an editor completes keys"), _schema, page)
    return parser


def _build(options: argparse.Namespace) -> int:
    from exporters.production.plan import plan_build

    def planned(address: str) -> Plan:
        scene = _scene(address, options)
        with _waiting(options, scene):
            return plan_build(scene, address, options.part, options.format)

    if options.verify == "kernel":
        from parts.base.refusal import SceneError
        from parts.solids.kernel import has_kernel

        if not has_kernel():
            raise SceneError(options.scenes[0], "--verify", "kernel", "needs_kernel")
    plans, refused = _each(_quoted(options.scenes), planned, lambda: _language(options))
    if refused:
        return WRONG_INPUT
    _refuse_one_folder(plans)
    made = [_built(plan, options) for plan in plans]
    if options.json:
        from exporters.production.report import read_report

        _print_json(options.scenes, [read_report(options.out / p.scene.name) for p in plans])
    return DONE if all(made) else FAILED


def _built(plan: Plan, options: argparse.Namespace) -> bool:
    """Build a scene and show what was made; returns whether all is well."""
    from exporters.command.tables import build_table
    from exporters.production.build import build, steps

    folder = options.out / plan.scene.name
    partial, verify = bool(options.part or options.format), not options.no_verify
    with _progress(options, plan.scene.name, steps(plan)) as advance:
        built = build(plan, folder, verify=verify, kernel=options.verify == "kernel", partial=partial, progress=advance)
    if not options.json and not (options.quiet and built.well):
        build_table(plan, folder, built)
    return built.well


@contextmanager
def _waiting(options: argparse.Namespace, scene: SceneFile) -> Iterator[None]:
    """A line on a terminal while parts are laid out."""
    if not (scene.boards or scene.beds) or not sys.stdout.isatty() or options.quiet or options.json:
        yield
        return
    from rich.console import Console

    with Console().status(words(scene.scene.language).text("laying parts out on boards and beds")):
        yield


@contextmanager
def _progress(options: argparse.Namespace, name: str, total: int) -> Iterator[Callable[[str], None]]:
    """A bar on a terminal that wants one; what moves it on by one step, and says which."""
    if not sys.stdout.isatty() or options.quiet or options.json:
        yield lambda step: None
        return
    from rich.progress import Progress

    with Progress(transient=True) as bar:
        task = bar.add_task(name, total=total)
        yield lambda step: bar.update(task, advance=1, description=step)


def _catalogue(options: argparse.Namespace) -> int:
    from collections import Counter
    from math import prod

    from exporters.production.catalogue import FAILED as BAD
    from exporters.production.catalogue import OK, REFUSED, catalogue, workers
    from parts.scene.variants import axes_of

    scene = _scene(options.scene, options)
    axes = axes_of(options.vary, scene)
    folder, total = options.out / scene.name, prod(len(axis.values) for axis in axes)
    with workers(options.jobs, options.dask) as executor, _progress(options, scene.name, total) as advance:
        entries = catalogue(scene, options.scene, axes, folder, executor, advance)
    verdicts = Counter(entry["verdict"] for entry in entries)
    if verdicts[BAD] or not options.quiet:
        counts = {"ok": verdicts[OK], "refused": verdicts[REFUSED], "failed": verdicts[BAD]}
        text = N_("{file}: {ok} ok, {refused} refused, {failed} failed")
        print(words(scene.scene.language).text(text, file=folder / "catalogue.csv", **counts))
    if verdicts[REFUSED] == total:
        from parts.base.refusal import SceneError

        first = {"key": entries[0]["key"], "why": entries[0]["why"], "file": "catalogue.csv"}
        raise SceneError(options.scene, "--vary", ", ".join(options.vary), "every_row_refused", None, **first)
    return FAILED if verdicts[BAD] else DONE


def _refuse_one_folder(plans: Sequence[Plan]) -> None:
    """Two scenes of one name would be made in one folder."""
    from parts.base.refusal import SceneError, Typed

    first: dict[str, str] = {}
    for plan in plans:
        other = first.setdefault(plan.scene.name.lower(), plan.source)
        if other != plan.source:
            raise SceneError("build", Typed("SCENE"), plan.source, "same_scene_name", None, other=other)


def _each(asked: Sequence[S], run: Callable[[S], T], language: Callable[[], str]) -> tuple[list[T], bool]:
    """Something of everything that is asked for, and whether one was refused, which is told in a language."""
    from parts.base.refusal import SceneError, sentence

    found, refused = [], False
    for one in asked:
        try:
            found.append(run(one))
        except SceneError as error:
            print(f"higherpair: {sentence(error, language())}", file=sys.stderr)
            refused = True
    return found, refused


def _quoted(scenes: Sequence[str]) -> Sequence[str]:
    """The scenes that are asked for.

    Raises
    ------
    SceneError
        None is there, but the one that they name together: a name with blanks, without quotes.
    """
    from geometry.base.errors import Nearest
    from parts.base.refusal import SceneError
    from parts.scene.files import built_in_scenes

    built_in, whole = built_in_scenes(), " ".join(scenes)
    if len(scenes) < 2 or any(one in built_in or os.path.exists(one) for one in scenes):
        return scenes
    if (name := "_".join(scenes)) not in built_in and not os.path.isfile(whole):
        return scenes
    found = name if name in built_in else f'"{whole}"'
    raise SceneError(whole, "", None, "name_without_quotes", Nearest(found, "meant"))


def _print_json(asked: Sequence[object], found: Sequence[object]) -> None:
    """One result as it is, several as a list; nothing where the only one was refused."""
    import json

    if found or len(asked) > 1:
        print(json.dumps(found[0] if len(asked) == 1 else found, indent=1, ensure_ascii=False))


def _check(options: argparse.Namespace) -> int:
    from exporters.command.tables import part_notes
    from exporters.production.check import scene_checks
    from exporters.production.check_lines import check_lines, has_bad_verdict, names_of
    from parts.scene.checks import check_solids, check_workspace
    from parts.scene.load import in_keys_of_file, make_parts
    from parts.scene.placing import place

    def checked(address: str) -> tuple[dict[str, Any], SceneFile, dict[str, str], list[str]]:
        scene = _scene(address, options)
        with in_keys_of_file(scene.origins):
            parts, matings = make_parts(scene, address)
            placing = place(scene.instances, scene.drives, parts, matings, address)
            check_solids(parts, address)
            check_workspace(scene.checks.workspace, placing, address)
        asked, names = scene.checks, names_of(scene.instances, parts)
        checks = scene_checks(
            placing, parts, scene.drives, scene.scene.language, contact=True, transmission=asked.transmission_error,
            workspace=asked.workspace, steps=scene.steps, names=names,
        )  # fmt: skip
        return checks, scene, names, part_notes(parts.values(), words(scene.scene.language))

    found, refused = _each(_quoted(options.scenes), checked, lambda: _language(options))
    if options.json:
        _print_json(options.scenes, [checks for checks, *_ in found])
    for checks, scene, names, notes in found:
        if options.json or (options.quiet and not has_bad_verdict(checks)):
            continue
        language = scene.scene.language
        title = [] if len(options.scenes) == 1 else [f"{scene.name}:"]
        lines = check_lines(checks, language, names)
        if options.steps:
            from exporters.production.order import steps_told

            lines += steps_told(scene.steps, names, language)
        lines = lines or [words(language).text("no mates; no solids run into each other")]
        print("\n".join(title + lines + notes))
    return FAILED if any(has_bad_verdict(checks) for checks, *_ in found) else WRONG_INPUT if refused else DONE


def _verify(options: argparse.Namespace) -> int:
    from exporters.command.tables import verify_table
    from exporters.production.recheck import recheck
    from exporters.production.report import NAME, report_language

    _check_language(options)
    language = options.language or report_language(options.files[0])
    # of all that lies in a folder the report is none that is held against it
    files = [file for file in options.files if file.name != NAME] or options.files
    results, refused = _each(files, recheck, lambda: language)
    failed = any(r.verdict.failures for r in results)
    if options.json:
        _print_json(files, [r.told for r in results])
    elif results and not (options.quiet and not failed):
        verify_table(results, words(language))
    return FAILED if failed else WRONG_INPUT if refused else DONE


def _converge(options: argparse.Namespace) -> int:
    from exporters.command.tables import converge_tables
    from exporters.production.converge import ladder, orders, write_csv, write_pictures
    from exporters.production.moving import alone_in, move_into, staging_folder
    from exporters.production.plan import plan_build
    from parts.base.refusal import SceneError

    scene = _scene(options.scene, options)
    plan = plan_build(scene, options.scene, options.part, options.format)
    if not plan.jobs:
        raise SceneError(options.scene, "exports", None, "nothing_to_measure")
    folder = options.out / scene.name
    told = words(scene.scene.language)
    with staging_folder(folder) as staging:
        rungs, found = ladder(plan, staging), orders(plan)
        names = [*write_csv(staging, rungs, found), *write_pictures(staging, rungs, found, told)]
        with alone_in(folder):
            move_into(folder, staging, names)
    converge_tables(rungs, found, [folder / name for name in names], told)
    return FAILED if any(r.measured > r.max_error for r in rungs) else DONE


def _stress(options: argparse.Namespace) -> int:
    from exporters.command.tables import stress_table
    from exporters.production.moving import alone_in, move_into, staging_folder
    from exporters.production.stress import atlas, write_stress

    _check_language(options)
    told, folder = words(_language(options)), options.out / "stress"
    # a folder that cannot be written is told before all is computed
    with staging_folder(folder) as staging:
        rows = atlas()
        names = write_stress(staging, rows, told)
        with alone_in(folder):
            move_into(folder, staging, names)
    lost = not all(row.is_stable for row in rows)
    if options.json:
        _print_json([""], [{"rows": [row.told for row in rows]}])
    elif lost or not options.quiet:
        stress_table(rows, [folder / name for name in names], told)
    return FAILED if lost else DONE


def _list(options: argparse.Namespace) -> int:
    from parts.base.densities import DENSITIES
    from parts.base.registry import KINDS
    from parts.mates.registry import MATES
    from parts.recipes.registry import RECIPES
    from parts.scene.files import built_in_scenes, title_of

    _check_language(options)
    told = words(_language(options))
    indices = KINDS.phrases, MATES.phrases, RECIPES.phrases
    kinds, mates, assemblies = ({name: told.text(text) for name, text in index.items()} for index in indices)
    scenes = {name: title_of(file, _language(options)) for name, file in built_in_scenes().items()}
    if options.json:
        tables = {"parts": kinds, "mates": mates, "assemblies": assemblies, "scenes": scenes, "materials": DENSITIES}
        _print_json([""], [tables])
        return DONE
    listed = {
        told.text("kinds of parts (higherpair new KIND):"): kinds,
        told.text("kinds of mates between instances (higherpair new KIND prints a table to add to a scene):"): mates,
        told.text("assemblies, which become parts and mates (higherpair new KIND, --expand shows them):"): assemblies,
        told.text("built-in scenes (higherpair build NAME; higherpair new NAME.toml prints one to change):"): scenes,
    }
    for title, rows in listed.items():
        print(title)
        for name, meaning in rows.items():
            print(f"  {name:<22} {meaning}{'' if rows is scenes else '.'}")
    print(told.text("materials whose density is known (g/cm^3; any other needs `density` too):"))
    for density in sorted(set(DENSITIES.values())):
        print(f"  {density:<6} {', '.join(name for name in DENSITIES if DENSITIES[name] == density)}")
    return DONE


def _new(options: argparse.Namespace) -> int:
    from exporters.command.new import (
        commented,
        new_assembly,
        new_mate,
        new_scene,
        new_table,
        plain_scene,
        tables_of_kind,
    )
    from geometry.base.errors import Nearest
    from parts.base.refusal import SceneError, Typed, meant
    from parts.base.registry import KINDS
    from parts.mates.registry import MATES
    from parts.recipes.registry import RECIPES
    from parts.scene.files import built_in_scenes, text_of
    from parts.scene.load import load_scene

    _check_language(options)
    built_in = built_in_scenes()
    scenes = {address: file for name, file in built_in.items() for address in (name, file.name)}
    makers: list[tuple[Collection[str], Callable[[str, str], str]]]
    makers = [(KINDS, new_scene), (MATES, new_mate), (RECIPES, new_assembly)]
    # a scene that has the name of a kind is asked for with its ending
    text = next((make(options.kind, _language(options)) for kinds, make in makers if options.kind in kinds), None)
    if text is None and options.kind not in scenes:
        text = new_table(options.kind, _language(options))
    if text is None:
        if options.kind not in scenes and not (options.expand and os.path.isfile(options.kind)):
            kind, _, key = options.kind.partition(".")
            if tables := tables_of_kind(kind):
                near = meant(key, tables)
                near = near and Nearest(f"{kind}.{near.value}", "meant")
                shown = [f"{kind}.{name}" for name in tables]
                raise SceneError("new", Typed("KIND"), options.kind, "unknown_table", near, known=shown)
            known = list(dict.fromkeys([*(kind for kinds, _ in makers for kind in kinds), *built_in]))
            raise SceneError(
                "new", Typed("KIND"), options.kind, "unknown_kind", meant(options.kind, known), known=known
            )
        if options.kind not in scenes:
            # whatever is wrong with it is told first
            load_scene(options.kind)
        text = text_of(Path(scenes.get(options.kind, options.kind)).read_bytes())
        if options.language is not None and options.kind in scenes and "\nlanguage = " not in text:
            text = text.replace("[scene]\n", f'[scene]\nlanguage = "{options.language}"\n', 1)
            text = text if options.language == ENGLISH else commented(text, words(options.language))
    _page(plain_scene(text, options.kind) if options.expand else text, options)
    return DONE


def _page(text: str, options: argparse.Namespace) -> None:
    """A text to the file that was asked for, or to the terminal."""
    if options.out is None:
        print(text, end="")
    else:
        from exporters.formats.whole import write_whole

        _check_free(options)
        write_whole(options.out, text)
        print(words(_language(options)).text("written: {file}", file=options.out))


def _check_free(options: argparse.Namespace) -> None:
    """Refuse a file that exists already: before a page is made, which may take a while, and before it is written."""
    if options.out is not None:
        from exporters.formats.whole import check_free

        check_free(options.out)


def _schema(options: argparse.Namespace) -> int:
    from parts.scene.schema import scene_schema

    _check_free(options)
    _page(scene_schema(), options)
    return DONE


def _calc(options: argparse.Namespace) -> int:
    from exporters.command.new import topic_keys
    from exporters.documents.render import form_of
    from exporters.documents.topics import calculate, keys_of_topic
    from parts.base.readback import ReadError

    _check_free(options)
    if options.keys:
        _page(topic_keys(options.topic, *keys_of_topic(options.topic), options.language or ENGLISH), options)
        return DONE
    form = options.format or form_of(options.out)
    try:
        text = calculate(options.topic, options.words, form, options.language)
    except ReadError as error:
        print(f"higherpair: {error}", file=sys.stderr)
        return FAILED
    _page(text, options)
    return DONE

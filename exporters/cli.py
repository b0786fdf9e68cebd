"""The command ``higherpair``. Exit codes: 0 done, 1 a check failed, 2 wrong input (one clear line)."""

from __future__ import annotations

import argparse
import os
import signal
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn, TextIO

from exporters import __version__

DONE, FAILED, WRONG_INPUT, INTERRUPTED = 0, 1, 2, 130


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        self.exit(WRONG_INPUT, f"higherpair: {message}; see `{self.prog} --help`\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; returns its exit code."""
    _prepare_streams()
    # numpy is not loaded yet: its threads would take longer to start than all that we compute
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    options = _parser().parse_args(arguments)
    # only a command of its own may split: whoever calls this function keeps the process
    options.splits = arguments is None
    interrupt = _Interrupt()
    previous: dict[signal.Signals, Any] = {}
    try:
        for stop in _stops():
            previous[stop] = signal.signal(stop, interrupt)
        code = options.run(options)
        sys.stdout.flush()
        return code
    except KeyboardInterrupt:
        return _interrupted()
    except ImportError:
        # a library that is stopped while it loads says only that it could not be loaded
        if not interrupt.came:
            raise
        return _interrupted()
    except BrokenPipeError:
        # whoever read the output has left: nothing more can be said to it
        sys.stdout = _nowhere()
        return DONE
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        hint = " with --out" if hasattr(options, "out") else ""
        print(f"higherpair: {place}{error.strerror or error}; choose another place{hint}", file=sys.stderr)
        return WRONG_INPUT
    except ValueError as error:
        from parts.schema import SceneError

        if not isinstance(error, SceneError):
            raise
        from exporters.words_errors import refusal_line

        print(f"higherpair: {refusal_line(error, _language(options))}", file=sys.stderr)
        return WRONG_INPUT
    finally:
        for stop, handler in previous.items():
            signal.signal(stop, handler)


def _language(options: argparse.Namespace) -> str:
    """The language of a refusal: that of --language, of the scene, or of a scene among the words of calc."""
    if getattr(options, "language", None) is not None:
        return str(options.language)
    from exporters.words_errors import language_of

    words = [options.scene] if hasattr(options, "scene") else getattr(options, "words", [])
    return next((language_of(word) for word in words if word and "=" not in word), "en")


def _prepare_streams() -> None:
    """Output that cannot fail: a character that the terminal lacks becomes ?, and a closed stream becomes none."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, _nowhere())
        elif hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="replace")


def _nowhere() -> TextIO:
    return open(os.devnull, "w", encoding="utf-8")


def _stops() -> list[signal.Signals]:
    """The signals that stop a command; a hang-up that somebody has turned off (nohup) stays off."""
    names = ("SIGINT", "SIGTERM", "SIGHUP")
    found = [getattr(signal, name) for name in names if hasattr(signal, name)]
    return [s for s in found if s.name != "SIGHUP" or signal.getsignal(s) != signal.SIG_IGN]


def _split(options: argparse.Namespace, folder: Path | None) -> None:
    """Before the CAD kernel is used: go on in a process apart, so that a signal need not wait for the kernel."""
    if options.splits:
        from exporters.apart import work_apart

        work_apart(_stops(), folder, FAILED)


class _Interrupt:
    """A signal handler that stops the command, and remembers that it did."""

    came = False

    def __call__(self, number: int, frame: object) -> NoReturn:
        self.came = True
        raise KeyboardInterrupt


def _interrupted() -> int:
    # Python remembers a stop that came within exec(), which dataclasses use, and would end itself by SIGINT in place of
    # with our code; the next exec makes it forget
    exec("")
    print("higherpair: interrupted; nothing half-written is left", file=sys.stderr)
    return INTERRUPTED


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="higherpair", description="Exact gears as DXF, SVG, STL, 3MF and STEP, each file read back and measured."
    )
    parser.add_argument("--version", action="version", version=f"higherpair {__version__}")
    commands = parser.add_subparsers(prog="higherpair", required=True, metavar="COMMAND", parser_class=_Parser)
    build = commands.add_parser("build", help="make the files of a scene")
    build.add_argument("scene", help="a built-in scene or a scene file (.toml)")
    build.add_argument("--out", default="out", type=Path, help="results go to OUT/<scene name> (default: out)")
    build.add_argument("--part", action="append", default=[], metavar="ID", help="only this part (may be repeated)")
    build.add_argument("--format", action="append", default=[], metavar="F", help="only this format (may be repeated)")
    build.add_argument("--no-verify", action="store_true", help="do not read the files back")
    build.set_defaults(run=_build)
    check = commands.add_parser("check", help="contact and interference of the pairs of a scene")
    check.add_argument("scene", help="a built-in scene or a scene file (.toml)")
    check.set_defaults(run=_check)
    verify = commands.add_parser("verify", help="read files back and hold them against the part in their report")
    verify.add_argument("files", nargs="+", type=Path, metavar="FILE")
    verify.set_defaults(run=_verify)
    converge = commands.add_parser("converge", help="error against run time, over a ladder of tolerances")
    converge.add_argument("scene", help="a built-in scene or a scene file (.toml)")
    converge.add_argument("--out", default="out", type=Path, help="results go to OUT/<scene name> (default: out)")
    converge.add_argument("--part", action="append", default=[], metavar="ID", help="only this part")
    converge.add_argument("--format", action="append", default=[], metavar="F", help="only this format")
    converge.set_defaults(run=_converge)
    listing = commands.add_parser("list", help="kinds of parts and built-in scenes")
    listing.set_defaults(run=_list)
    calc = commands.add_parser("calc", help="a textbook calculation, step by step")
    calc.add_argument(
        "topic", metavar="TOPIC", help="spur, tmm42, gear-pair, shift-choice, cam, cycloidal, lantern or noncircular"
    )
    calc.add_argument("words", nargs="*", metavar="SCENE | KEY=VALUE", help="a scene, or keys as in scenes")
    calc.add_argument("--format", default="text", metavar="F", help="text, md, html or json (default: text)")
    calc.add_argument("--language", metavar="L", help="en or uk (default: that of the scene, or en)")
    calc.set_defaults(run=_calc)
    new = commands.add_parser("new", help="print a commented scene to start from; of a mate its table, to add to one")
    new.add_argument("kind", metavar="KIND", help="a kind of part or mate, see `higherpair list`")
    new.set_defaults(run=_new)
    return parser


def _build(options: argparse.Namespace) -> int:
    from exporters.build import build
    from exporters.plan import plan_build
    from exporters.tables import build_table, has_bad_verdict
    from parts.scene import load_scene

    scene = load_scene(options.scene)
    plan = plan_build(scene, options.scene, options.part, options.format)
    folder, verify = options.out / scene.name, not options.no_verify
    if "step" in {j.export.format for j in plan.jobs} | {a.export.format for a in plan.assemblies}:
        _split(options, folder)
    partial = bool(options.part or options.format)
    if sys.stdout.isatty():
        from rich.progress import Progress

        with Progress(transient=True) as bar:
            task = bar.add_task(scene.name, total=len(plan.jobs) + len(plan.assemblies) + len(plan.sheets))

            def advance(path: str) -> None:
                bar.update(task, advance=1, description=path)

            written, previews, checks = build(plan, folder, verify=verify, partial=partial, progress=advance)
    else:
        written, previews, checks = build(plan, folder, verify=verify, partial=partial)
    build_table(plan, folder, written, previews, checks)
    return FAILED if any(item.failures for item in written) or has_bad_verdict(checks) else DONE


def _check(options: argparse.Namespace) -> int:
    from exporters.check import scene_checks
    from exporters.tables import check_lines, has_bad_verdict
    from exporters.words import words
    from parts.placing import place
    from parts.scene import load_scene, make_parts
    from parts.schema import SceneError

    scene = load_scene(options.scene)
    parts, matings = make_parts(scene, options.scene)
    placing = place(scene.instances, scene.drives, parts, matings, options.scene)
    if len(placing.instances) < 2:
        raise SceneError(options.scene, "mates", None, 'nothing to check; add [[mates]] kind = "external_gear_pair"')
    asked = scene.checks.transmission_error
    checks = scene_checks(placing, parts, scene.drives, scene.scene.language, contact=True, transmission=asked)
    found = check_lines(checks, scene.scene.language)
    print("\n".join(found or [words(scene.scene.language, "nothing_overlaps")]))
    return FAILED if has_bad_verdict(checks) else DONE


def _verify(options: argparse.Namespace) -> int:
    from exporters.recheck import recheck
    from exporters.tables import verify_table
    from parts.schema import SceneError

    if any(file.suffix.lower() == ".step" for file in options.files):
        _split(options, None)
    results, refused = [], False
    for file in options.files:
        try:
            results.append(recheck(file))
        except SceneError as error:
            print(f"higherpair: {error}", file=sys.stderr)
            refused = True
    if results:
        verify_table(results)
    if any(r.verdict.failures for r in results):
        return FAILED
    return WRONG_INPUT if refused else DONE


def _converge(options: argparse.Namespace) -> int:
    from exporters.build import move_into, staging_folder
    from exporters.converge import ladder, orders, write_csv, write_pictures
    from exporters.plan import plan_build
    from exporters.tables import converge_tables
    from parts.scene import load_scene
    from parts.schema import SceneError

    scene = load_scene(options.scene)
    plan = plan_build(scene, options.scene, options.part, options.format)
    if not plan.jobs:
        raise SceneError(options.scene, "exports", None, "hold no file of a single part to measure; add one")
    folder = options.out / scene.name
    if any(job.export.format == "step" for job in plan.jobs):
        _split(options, folder)
    with staging_folder(folder) as staging:
        rungs, found = ladder(plan, staging), orders(plan)
        write_csv(staging / "converge.csv", rungs, found)
        names = ["converge.csv", *write_pictures(staging, rungs, found)]
        move_into(folder, staging, names)
    converge_tables(rungs, found, [folder / name for name in names])
    return FAILED if any(r.measured > r.max_error for r in rungs) else DONE


def _list(options: argparse.Namespace) -> int:
    from parts.kinds import KINDS
    from parts.mates import MATES
    from parts.scene import built_in_scenes, load_scene

    print("kinds of parts (higherpair new KIND):")
    for kind, (spec, *_) in KINDS.items():
        print(f"  {kind:<22} {(spec.__doc__ or '').splitlines()[0]}")
    print("kinds of mates between instances (higherpair new KIND prints a table to add to a scene):")
    for kind, spec in MATES.items():
        print(f"  {kind:<22} {(spec.__doc__ or '').splitlines()[0]}")
    print("built-in scenes (higherpair build NAME):")
    for name in built_in_scenes():
        print(f"  {name:<22} {load_scene(name).scene.title}")
    return DONE


def _new(options: argparse.Namespace) -> int:
    from exporters.new import new_mate, new_scene
    from parts.kinds import KINDS
    from parts.mates import MATES
    from parts.schema import SceneError, near

    known = [*KINDS, *MATES]
    if options.kind not in known:
        raise SceneError(
            "new", "KIND", options.kind, f"unknown kind{near(options.kind, known)}; kinds: {', '.join(known)}"
        )
    print(new_mate(options.kind) if options.kind in MATES else new_scene(options.kind), end="")
    return DONE


def _calc(options: argparse.Namespace) -> int:
    from exporters.calculations.topics import calculate

    print(calculate(options.topic, options.words, options.format, options.language), end="")
    return DONE

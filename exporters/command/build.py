"""``higherpair build``: make the files of a scene, read them back, tell what was made."""

from __future__ import annotations

import sys
from argparse import Namespace
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from exporters.command.asked import (
    DONE,
    FAILED,
    WRONG_INPUT,
    each,
    language_of_command,
    print_json,
    progress_of,
    quoted,
    scene_of,
)
from exporters.command.tables import Columns, part_notes, show
from exporters.production.check_lines import check_lines, names_of
from exporters.production.jobs import Written
from exporters.production.plan import Plan, plan_build
from exporters.production.report import read_report
from parts.base.part import Part
from parts.base.refusal import SceneError, Typed
from parts.base.texts import N_, Words, words
from parts.texts.findings import finding_message

if TYPE_CHECKING:
    from exporters.production.build import Built
    from parts.scene.scene_file import SceneFile

# as many pictures of parts are named each
_PREVIEWS = 12
# how far the error of a file is known
_BOUNDS = {"exact": N_("exact"), "certified": N_("certified"), "sampled": N_("sampled")}


def run(options: Namespace) -> int:
    """The exit code."""

    def planned(address: str) -> Plan:
        scene = scene_of(address, options)
        with _waiting(options, scene):
            return plan_build(scene, address, options.part, options.format)

    if options.verify == "kernel":
        from parts.solids.kernel import has_kernel

        if not has_kernel():
            raise SceneError(options.scenes[0], "--verify", "kernel", "needs_kernel")
    plans, refused = each(quoted(options.scenes), planned, lambda: language_of_command(options))
    if refused:
        return WRONG_INPUT
    _refuse_one_folder(plans)
    made = [_built(plan, options) for plan in plans]
    if options.json:
        print_json(options.scenes, [read_report(options.out / p.scene.name) for p in plans])
    return DONE if all(made) else FAILED


def _built(plan: Plan, options: Namespace) -> bool:
    """Build a scene and show what was made; returns whether all is well."""
    # a scene that is refused is told without it
    from exporters.production.build import build, steps

    folder = options.out / plan.scene.name
    partial, verify = bool(options.part or options.format), not options.no_verify
    with progress_of(options, plan.scene.name, steps(plan)) as advance:
        built = build(plan, folder, verify=verify, kernel=options.verify == "kernel", partial=partial, progress=advance)
    if not options.json and not (options.quiet and built.well):
        _show_built(plan, folder, built)
    return built.well


@contextmanager
def _waiting(options: Namespace, scene: SceneFile) -> Iterator[None]:
    """A line on a terminal while parts are laid out."""
    if not (scene.boards or scene.beds) or not sys.stdout.isatty() or options.quiet or options.json:
        yield
        return
    from rich.console import Console

    with Console().status(words(scene.scene.language).text("laying parts out on boards and beds")):
        yield


def _refuse_one_folder(plans: Sequence[Plan]) -> None:
    """Two scenes of one name would be made in one folder."""
    first: dict[str, str] = {}
    for plan in plans:
        other = first.setdefault(plan.scene.name.lower(), plan.source)
        if other != plan.source:
            raise SceneError("build", Typed("SCENE"), plan.source, "same_scene_name", None, other=other)


def _show_built(plan: Plan, folder: Path, built: Built) -> None:
    """What a build has made, how far each file is from the exact curve, and what was noticed."""
    written = built.written
    language = plan.scene.scene.language
    told = words(language)
    pictures = {f"{part}.preview.svg" for part in plan.parts}
    of_parts = [preview for preview in built.previews if preview.name in pictures]
    named = built.previews if len(of_parts) <= _PREVIEWS else [p for p in built.previews if p not in of_parts]
    notes = [one for one in named if one.suffix == ".txt"]
    remarks = [told.text("preview: {path}", path=one) for one in named if one not in notes]
    remarks += [told.text("how it is made and used: {path}", path=one) for one in notes]
    if len(named) < len(built.previews):
        count = len(of_parts)
        remarks.append(
            told.plural("previews of {parts} part beside it", "previews of {parts} parts beside it", count, parts=count)
        )
    if any(item.failures for item in written):
        from exporters.production.kept import kept_lines

        kept = kept_lines(read_report(folder), language)
        remarks += [told.text("FAILED: {why}", why=line) for line in kept]
    left = {one.what for one in plan.left_out}
    made = [part for part in plan.parts.values() if f"parts.{part.id}" not in left]
    remarks += dict.fromkeys(_remarks(written, made, told))
    remarks += check_lines(built.checks, language, names_of(plan.scene.instances, plan.parts))
    left_out = [(one.what, one.why) for one in plan.left_out if not one.as_asked]
    remarks += [told.text("left out: {what}: {why}", what=what, why=told.say(why)) for what, why in left_out]
    remarks += [
        told.text("note: {text}", text=told.text("{path} is of an earlier build: this one does not make it", path=path))
        for path in built.left_behind
    ]
    title = told.text("{title}: files in {folder}", title=plan.scene.scene.title or plan.scene.name, folder=folder)
    columns: Columns[Written] = (
        (N_("file"), lambda item: item.job.path),
        (N_("max error, mm"), lambda item: f"{item.max_error:.3g} ({told.text(_BOUNDS[item.bound])})"),
        (N_("tolerance, mm"), lambda item: f"{item.job.export.tolerance:g}"),
        (N_("kB"), lambda item: "-" if item.failures else f"{(folder / item.job.path).stat().st_size / 1000:.1f}"),
        (N_("read back"), lambda item: told.text(_state(item.failures, item.measured))),
    )
    show(title, columns, written, told, remarks)


def _state(failures: Sequence[str], measured: Mapping[str, float]) -> str:
    return N_("FAILED") if failures else N_("ok") if measured else N_("not verified")


def _remarks(written: Sequence[Written], parts: Sequence[Part], told: Words) -> list[str]:
    """What failed, and what was noticed on files and parts: of one on a board or a sheet no file tells its own."""
    lines = []
    for item in written:
        lines += [told.text("FAILED: {why}", why=f"{item.job.path}: {told.say(failure)}") for failure in item.failures]
    # what several files share is said once
    labels: dict[str, list[str]] = {}
    for item in written:
        for finding in item.findings:
            labels.setdefault(told.say(finding_message(finding)), []).extend(item.job.about(finding))
    return lines + part_notes(parts, told, labels)

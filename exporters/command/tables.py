"""The closing tables of the command: drawn by rich on a terminal, plain columns anywhere else."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from exporters.production.check_lines import check_lines, names_of
from exporters.production.jobs import Written
from exporters.production.plan import Plan
from parts.base.part import Part
from parts.base.texts import N_, Words, words
from parts.texts.findings import finding_message

if TYPE_CHECKING:
    from exporters.production.build import Built
    from exporters.production.converge import Order, Rung
    from exporters.production.recheck import Recheck
    from exporters.production.stress import Row


def build_table(plan: Plan, folder: Path, built: Built) -> None:
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
        from exporters.production.report import read_report

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
    columns: _Columns[Written] = (
        (N_("file"), lambda item: item.job.path),
        (N_("max error, mm"), lambda item: f"{item.max_error:.3g} ({told.text(_BOUNDS[item.bound])})"),
        (N_("tolerance, mm"), lambda item: f"{item.job.export.tolerance:g}"),
        (N_("kB"), lambda item: "-" if item.failures else f"{(folder / item.job.path).stat().st_size / 1000:.1f}"),
        (N_("read back"), lambda item: told.text(_state(item.failures, item.measured))),
    )
    _show(title, columns, written, told, remarks)


# letters in a line of a terminal that nobody has widened
_PAGE_WIDTH = 80
# as many pictures of parts are named each
_PREVIEWS = 12
# how far the error of a file is known
_BOUNDS = {"exact": N_("exact"), "certified": N_("certified"), "sampled": N_("sampled")}
T = TypeVar("T")
# of a table what stands above each column, and what in it
_Columns: TypeAlias = tuple[tuple[str, Callable[[T], str]], ...]


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


def part_notes(parts: Iterable[Part], told: Words, labels: dict[str, list[str]] | None = None) -> list[str]:
    """What was noticed on parts, beside what is of others (``labels``: by its words), each once."""
    labels = {} if labels is None else labels
    for part in parts:
        for finding in part.findings:
            labels.setdefault(told.say(finding_message(finding)), []).append(part.id)
    named = ((", ".join(dict.fromkeys(own)), text) for text, own in labels.items())
    return [told.text("note: {text}", text=f"{names}: {text}") for names, text in named]


def verify_table(results: list[Recheck], told: Words) -> None:
    """What was measured on files that lay on disk."""

    def deviation(r: Recheck) -> str:
        found = r.verdict.measured.get("max_deviation")
        return "-" if found is None else f"{found:.3g}"

    columns: _Columns[Recheck] = (
        (N_("file"), lambda r: str(r.file)),
        (N_("measured error, mm"), deviation),
        # a preview has neither: it is compared byte by byte
        (N_("declared, mm"), lambda r: f"{r.declared:.3g}" if r.tolerance else "-"),
        (N_("tolerance, mm"), lambda r: f"{r.tolerance:g}" if r.tolerance else "-"),
        (N_("bytes"), lambda r: told.text("as reported") if r.same_bytes else told.text("changed")),
        (N_("read back"), lambda r: told.text("FAILED") if r.verdict.failures else told.text("ok")),
    )
    failed = [(r.file, failure) for r in results for failure in r.verdict.failures]
    remarks = [told.text("FAILED: {why}", why=f"{file}: {told.say(failure)}") for file, failure in failed]
    _show("", columns, results, told, remarks)


def converge_tables(rungs: list[Rung], found: list[Order], files: list[Path], told: Words) -> None:
    """Error against run time of every file, and the order of every method on every curve."""
    from exporters.production.converge import LEAST_PIECES, curve_name

    columns: _Columns[Rung] = (
        (N_("file"), lambda r: r.file),
        (N_("tolerance, mm"), lambda r: f"{r.tolerance:g}"),
        (N_("declared, mm"), lambda r: f"{r.max_error:.3g}"),
        (N_("measured, mm"), lambda r: f"{r.measured:.3g}"),
        (N_("edges"), lambda r: str(r.entities)),
        (N_("kB"), lambda r: f"{r.bytes / 1000:.1f}"),
        (N_("ms (median)"), lambda r: f"{1000 * r.seconds:.2f}"),
        (N_("spread, ms"), lambda r: f"{1000 * r.spread:.2f}"),
    )
    _show(told.text("error against run time"), columns, rungs, told, [])

    def pieces(o: Order) -> str:
        if not o.counts:
            return told.text("below rounding at {pieces}", pieces=LEAST_PIECES)
        return told.text("{first} to {last}", first=o.counts[0], last=o.counts[-1])

    of_orders: _Columns[Order] = (
        (N_("curve"), lambda o: curve_name(o, told)),
        (N_("method"), lambda o: told.text(o.method)),
        (N_("order of the method"), lambda o: f"{o.theory:g}"),
        (N_("observed order"), lambda o: "-" if o.observed is None else f"{o.observed:.3f}"),
        (N_("pieces"), pieces),
        (N_("error there, mm"), lambda o: f"{o.errors[-1]:.3g}" if o.errors else "-"),
    )
    _show(told.text("orders of convergence"), of_orders, found, told, [str(file) for file in files])


def stress_table(rows: list[Row], files: list[Path], told: Words) -> None:
    """Every case from its easiest to its stiffest: condition numbers, errors, and what rounding allows."""
    columns: _Columns[list[Row]] = (
        (N_("case"), lambda own: f"{told.text(own[0].case)}: {told.text(own[0].varied)}"),
        (N_("from"), lambda own: f"{own[0].value:g}"),
        (N_("to"), lambda own: f"{own[-1].value:g}"),
        (N_("condition"), lambda own: f"{max(r.condition for r in own):.2g}"),
        (N_("relative error"), lambda own: f"{max(r.relative for r in own):.2g}"),
        (N_("of what is allowed"), lambda own: f"{max(r.error / r.bound for r in own):.2g}"),
        (N_("verdict"), lambda own: told.text("stable") if all(r.is_stable for r in own) else told.text("UNSTABLE")),
    )
    cases = [[r for r in rows if r.case == case] for case in dict.fromkeys(r.case for r in rows)]
    title = told.text("stiff and extreme cases against 50 digits")
    _show(title, columns, cases, told, [str(file) for file in files])


def _show(title: str, columns: _Columns[T], items: Sequence[T], told: Words, remarks: list[str]) -> None:
    """A table, where it has rows, and the lines below it. rich is loaded for a terminal only: it costs a build."""
    header = [told.text(head) for head, _ in columns]
    rows = [[cell(item) for _, cell in columns] for item in items]
    if rows and sys.stdout.isatty():
        _show_rich(title, header, rows)
    elif rows:
        sys.stdout.write("".join(f"{line}\n" for line in [*filter(None, [_printable(title)]), *_plain(header, rows)]))
    sys.stdout.write("".join(line + "\n" for line in remarks))


def _plain(header: Sequence[str], rows: list[list[str]]) -> Iterator[str]:
    """Columns; a name for which the width of a page leaves no room stands on a line of its own."""
    widths = [max(map(len, column)) for column in zip(header, *rows, strict=True)]
    room = max(len(header[0]), _PAGE_WIDTH - sum(w + 2 for w in widths[1:]))
    widths[0] = max(len(row[0]) for row in (header, *rows) if len(row[0]) <= room)
    for first, *rest in (header, *rows):
        if len(first) > widths[0]:
            yield first
            first = ""
        yield "  ".join([first.ljust(widths[0]), *(c.rjust(w) for c, w in zip(rest, widths[1:], strict=True))])


def _show_rich(title: str, header: Sequence[str], rows: list[list[str]]) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    table = Table(title=escape(_printable(title)), title_justify="left")
    table.add_column(header[0], overflow="fold")
    for name in header[1:]:
        table.add_column(name, justify="right")
    for row in rows:
        table.add_row(*map(escape, row))
    Console(highlight=False, emoji=False).print(table)


def _printable(text: str) -> str:
    """A text without the characters that steer a terminal."""
    return "".join(c if c.isprintable() else " " for c in text)

"""``SCENE.notes.txt``: how what a scene makes is put together and used, what its files are, what to cut by hand."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

from exporters.production.check_lines import names_of
from exporters.production.jobs import several
from exporters.production.laid import laid_jobs, lying_on
from exporters.production.order import steps_told
from parts.base.texts import N_, Words, words
from parts.drawing.names import caption_name
from parts.scene.stock import StockRow, stock_rows
from parts.texts.findings import finding_message

if TYPE_CHECKING:
    from exporters.production.plan import Plan

# letters in a line, as editors print them on A4
_LINE = 88
# sheets of a PDF as a class uses them
_EMPTY = N_("to hand out: the given data are filled in, the cells of the results are empty")
_FILLED = N_("the same with all numbers")
_FITS = N_(
    "If the fits are too loose or too tight, cut `{coupon}` and write the number it shows into `kerf` of the board."
)
_MODEL = N_("1:1, to be cut out: print at 100 %; its square must measure 100 mm")


def write_notes(plan: Plan, folder: Path) -> Path:
    """The notes of a scene in its language, and the lengths of rods and tubes that no machine makes."""
    scene, told = plan.scene.scene, words(plan.scene.scene.language)
    title = scene.title or plan.scene.name
    lines = [*wrap(title, _LINE), "=" * min(len(title), _LINE), *_files(plan, told)]
    for note in scene.notes:
        lines += ["", *wrap(note, _LINE)]
    if plan.scene.steps:
        names = names_of(plan.scene.instances, plan.parts)
        lines.append("")
        for step in steps_told(plan.scene.steps, names, scene.language, plan.scene.mates):
            lines += wrap(step, _LINE, subsequent_indent="    ")
    if rows := stock_rows(plan.scene, plan.parts):
        lines += ["", told.text("To be cut from rods and tubes, mm (diameter × length):"), *_stock(plan, rows, told)]
    file = folder / f"{plan.scene.name}.notes.txt"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")
    return file


def _files(plan: Plan, told: Words) -> Iterator[str]:
    """What lies on each board and plate, and what the sheets for a class are."""
    laid, rows = laid_jobs(plan), []
    for first, *others in laid.values():
        times = (told.say(finding_message(f)) for f in several(first.export, first.times))
        files = ", ".join((first.path, *(f".{job.export.format}" for job in others)))
        rows.append((files, "; ".join((", ".join(lying_on(first, told).values()), *times))))
    empty = {job.export.purpose for job in plan.sheets if job.export.cells == "empty"}
    for job in (job for job in plan.sheets if job.export.format == "pdf"):
        if job.export.purpose == "model":
            rows.append((job.path, told.text(_MODEL)))
        elif job.export.purpose in empty:
            rows.append((job.path, told.text(_EMPTY if job.export.cells == "empty" else _FILLED)))
    if any(jobs[0].export.purpose == "board" for jobs in laid.values()):
        text = told.text("Cut the boards: blue is engraved first, then green is cut, red last.")
        if any(jobs[0].export.kerf for jobs in laid.values()):
            text += " " + told.text(_FITS, coupon="kerf_coupon")
        yield from ("", *wrap(text, _LINE))
    if rows:
        yield ""
        for file, text in rows:
            yield from wrap(f"{file}: {text}", _LINE, subsequent_indent="    ")


def _stock(plan: Plan, rows: list[StockRow], told: Words) -> Iterator[str]:
    """A line for each length, and how much of each rod or tube that is."""
    for (diameter, bore), group in groupby(rows, key=lambda row: (row.stock.diameter, row.stock.bore)):
        of_rod = list(group)
        for row in of_rod:
            names = ", ".join(caption_name(plan.parts[part]) for part in row.parts)
            yield f"  {row.count} × {row.stock.told(told)}   {names}"
        size = told.decimal("/".join(f"Ø{d:.6g}" for d in (diameter, bore) if d))
        total = told.decimal(f"{sum(row.count * row.stock.length for row in of_rod) / 1000:.3g}")
        yield "  " + told.text("{size} in all: {total} m, and what the cuts take", size=size, total=total)

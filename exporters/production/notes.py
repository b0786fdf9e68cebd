"""``SCENE.notes.txt``: how what a scene makes is put together and used, and what to cut for it by hand."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

from exporters.production.check_lines import in_rows, names_of
from exporters.production.order import steps_told
from parts.base.texts import Words, words
from parts.scene.stock import StockRow, stock_rows

if TYPE_CHECKING:
    from exporters.production.plan import Plan

# letters in a line, as editors print them on A4
_LINE = 88


def write_notes(plan: Plan, folder: Path) -> Path:
    """The notes of a scene in its language, and the lengths of rods and tubes that no machine makes."""
    scene, told = plan.scene.scene, words(plan.scene.scene.language)
    title = scene.title or plan.scene.name
    lines = [*wrap(title, _LINE), "=" * min(len(title), _LINE)]
    for note in scene.notes:
        lines += ["", *wrap(note, _LINE)]
    if plan.scene.steps:
        names = names_of(plan.scene.instances, plan.parts)
        lines.append("")
        for step in steps_told(plan.scene.steps, names, in_rows, scene.language):
            lines += wrap(step, _LINE, subsequent_indent="    ")
    if rows := stock_rows(plan.scene, plan.parts):
        lines += ["", told.text("To be cut from rods and tubes, mm (diameter × length):"), *_stock(plan, rows, told)]
    file = folder / f"{plan.scene.name}.notes.txt"
    file.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")
    return file


def _stock(plan: Plan, rows: list[StockRow], told: Words) -> Iterator[str]:
    """A line for each length, and how much of each rod or tube that is."""
    for (diameter, bore), group in groupby(rows, key=lambda row: (row.stock.diameter, row.stock.bore)):
        of_rod = list(group)
        for row in of_rod:
            names = ", ".join(plan.parts[part].title or part for part in row.parts)
            yield f"  {row.count} × {row.stock.told(told)}   {names}"
        size = told.decimal("/".join(f"Ø{d:.6g}" for d in (diameter, bore) if d))
        total = told.decimal(f"{sum(row.count * row.stock.length for row in of_rod) / 1000:.3g}")
        yield "  " + told.text("{size} in all: {total} m, and what the cuts take", size=size, total=total)

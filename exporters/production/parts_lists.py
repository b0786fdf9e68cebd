"""Parts lists among the files of a build: as sheets, and as CSV (RFC 4180, UTF-8) for programs."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

from exporters.production.jobs import FileJob, Made
from exporters.production.request import Request
from exporters.verification.verdict import Verdict
from geometry.base.record import Record
from parts.base.texts import N_, fault, in_context, unless, words
from parts.drawing.choice import Asked
from parts.drawing.expected import Expected
from parts.drawing.parts_list import SECTIONS, ListRow, list_sheets
from parts.scene.parts_list import list_rows
from parts.scene.scene_file import ExportSpec

# the columns, with what stands in them
_HEADS = (
    in_context("parts list", "Section"), in_context("parts list", "Item"), in_context("parts list", "Designation"),
    in_context("parts list", "Name"), in_context("parts list", "Standard"), in_context("parts list", "Material"),
    in_context("parts list", "Qty"), in_context("parts list", "Mass, kg"), in_context("parts list", "Total mass, kg"),
    in_context("parts list", "Part"),
)  # fmt: skip


class ListJob(Record, FileJob):
    """The list as CSV."""

    export: ExportSpec
    language: str
    rows: tuple[ListRow, ...]
    path: str
    place: str

    @property
    def told(self) -> dict[str, Any]:
        """How many positions and pieces it has."""
        return {"part": None, "positions": len(self.rows), "pieces": sum(row.count for row in self.rows)}

    def lines(self) -> list[list[str]]:
        """Its lines, the head first; masses with a point."""
        told = words(self.language)
        found = [[told.say(head) for head in _HEADS]]
        for row in self.rows:
            masses = ["" if m is None else f"{m:.6g}" for m in (row.mass, row.total)]
            own = [told.say(SECTIONS[row.section]), str(row.position), row.designation, row.name, row.standard]
            found.append([*own, row.material, str(row.count), *masses, " ".join(row.parts)])
        return found

    def write(self, made: Made, file: Path) -> dict[str, int]:
        """Write it; how many lines."""
        with file.open("w", encoding="utf-8", newline="") as stream:
            csv.writer(stream).writerows(self.lines())
        return {"lines": len(self.rows) + 1}

    def verify(self, file: Path, declared: float) -> Verdict:
        """Read it back: every cell is there, and nothing else."""
        try:
            read = list(csv.reader(file.read_text("utf-8").splitlines(keepends=True), strict=True))
        except (csv.Error, UnicodeDecodeError) as error:
            return Verdict({}, (fault("is no CSV: {error}", error=error),))
        wanted = self.lines()
        wrong = [str(n) for n, (a, b) in enumerate(zip(read, wanted, strict=False), 1) if a != b]
        failures = unless(not wrong, "lines {wrong} differ", wrong=", ".join(wrong))
        told = N_("has {count} lines instead of {wanted}")
        failures += unless(len(read) == len(wanted), told, count=len(read), wanted=len(wanted))
        return Verdict({"lines": float(len(read))}, tuple(failures))

    def declared(self, made: Made) -> tuple[float, str]:
        """Words have no error."""
        return 0.0, "exact"


def rows_of(wanted: Request) -> tuple[ListRow, ...]:
    """The list of the parts that an export names."""
    return list_rows(wanted.placing.instances, {key: wanted.parts[key] for key in wanted.wanted}, wanted.language)


def list_job(wanted: Request) -> ListJob:
    """The CSV of one export."""
    return ListJob(wanted.export, wanted.language, rows_of(wanted), f"{wanted.stem}.csv", wanted.where)


def list_pages(wanted: Request, asked: Asked) -> list[tuple[str, Expected]]:
    """The list as sheets, numbered where there are several."""
    pages = list_sheets(rows_of(wanted), asked.language)
    return [(str(n) if len(pages) > 1 else "", page) for n, page in enumerate(pages, 1)]

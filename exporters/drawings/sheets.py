"""Sheets in the format of a file's ending: DXF, SVG, PDF."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from exporters.drawings.write import write_sheet_dxf, write_sheet_svg
from geometry.base.tolerance import DRAWN_ROUNDING, PDF_ROUNDING
from parts.drawing.canvas import Canvas


def write_sheets(file: Path, pages: Sequence[Canvas], title: str) -> dict[str, int]:
    """Write sheets in the format of the file's ending, several of them in a PDF only; counts of what is in it."""
    if file.suffix == ".pdf":
        from exporters.drawings.pdf import write_pdf

        return write_pdf(file, pages, title)
    return (write_sheet_dxf if file.suffix == ".dxf" else write_sheet_svg)(file, *pages)


def sheet_rounding(file: Path) -> float:
    """How far the rounding of a file's numbers may move a point, mm."""
    return PDF_ROUNDING if file.suffix == ".pdf" else 2 * DRAWN_ROUNDING

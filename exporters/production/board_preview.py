"""Pictures of boards for people: every piece filled, in its place, with its name as it is engraved."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TypeAlias

import numpy as np

from exporters.formats.svg import page_head, path_data, save, stroke_data
from exporters.production.boards import BoardJob
from exporters.production.plan import Plan
from exporters.production.preview import FILLS, Outlines, outlines_of
from geometry.curves.curve import Complex
from geometry.plane.contour import Contour

# a line, of the longer side of a board; engraved names
_LINE = 1 / 2500
_NAME = "fill:none;stroke:#0000ff;stroke-width:0.4;stroke-linecap:round;stroke-linejoin:round"

# a part: its outlines, and the strokes of its name
_Drawn: TypeAlias = tuple[Outlines, list[Complex]]


def board_previews(plan: Plan, folder: Path) -> list[Path]:
    """A picture of each board, once, whatever the formats of its files."""
    fills = dict(zip(plan.parts, np.resize(FILLS, len(plan.parts)).tolist(), strict=True))
    fills |= {name: part.colour for name, part in plan.parts.items() if part.colour}
    boards = {job.path.rpartition(".")[0]: job for job in plan.assemblies if isinstance(job, BoardJob)}
    wanted = dict.fromkeys(m.part.id for job in boards.values() for m in job.members)
    regions = {name: plan.parts[name].cut(0.0, named=True).region for name in wanted}
    drawn = {
        name: (outlines_of(region), [np.array(stroke, dtype=np.complex128) for stroke in region.strokes])
        for name, region in regions.items()
    }
    return [_preview(job, drawn, fills, folder / f"{name}.preview.svg") for name, job in boards.items()]


def _preview(job: BoardJob, drawn: Mapping[str, _Drawn], fills: Mapping[str, str], file: Path) -> Path:
    board = job.board
    size = max(board.width, board.height)
    lines = [page_head(board.width, board.height), '<rect width="100%" height="100%" style="fill:#ffffff"/>']
    for piece in job.pieces:
        outlines, strokes = drawn[piece.part]
        moved = [Contour(piece.moved(v), b) for v, b in (o.geometry.expanded() for o in outlines)]
        data = " ".join(path_data(contour, 1j * board.height) for contour in reversed(moved))
        style = f"fill:{fills[piece.part]};fill-rule:evenodd;stroke:#202830;stroke-width:{size * _LINE:.4g}"
        lines.append(f'<path d="{data}" style="{style}"/>')
        if strokes:
            name = " ".join(stroke_data(np.round(piece.moved(stroke), 3), 1j * board.height) for stroke in strokes)
            lines.append(f'<path d="{name}" style="{_NAME}"/>')
    save(file, lines)
    return file

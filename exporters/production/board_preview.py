"""Pictures of boards for people: every piece filled, in its place, with its name as it is engraved; what is on it."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np

from exporters.formats.svg import page_head, path_data, save, stroke_data
from exporters.production.boards import BoardJob
from exporters.production.plan import Plan
from exporters.production.preview import FILLS, Outlines, escaped, outlines_of
from geometry.curves.curve import Complex
from geometry.plane.contour import Contour

# a line, room about the board, and letters, of the longer side of a board; engraved names
_LINE, _ROOM, _LETTERS = 1 / 2500, 1 / 60, 1 / 50
# width of a letter, of its size
_WIDE = 0.62
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
    title = plan.scene.scene.title or plan.scene.name
    return [_preview(job, title, drawn, fills, folder / f"{name}.preview.svg") for name, job in boards.items()]


def _preview(job: BoardJob, title: str, drawn: Mapping[str, _Drawn], fills: Mapping[str, str], file: Path) -> Path:
    board = job.board
    size = max(board.width, board.height)
    room, line = size * _ROOM, size * _LINE
    counts = Counter(piece.part for piece in job.pieces)
    rows = [(f"{counts[m.part.id]} x {m.part.name}", fills[m.part.id]) for m in job.members]
    letters = size * _LETTERS
    title += f": {board.width:g} x {board.height:g} x {board.thickness:g}"
    title += f", {job.times} x" if job.times > 1 else ""
    legend, bottom = _legend(title, rows, letters, complex(room, board.height + 2 * room), board.width)
    high = board.height + room
    corner = complex(room, high)
    lines = [
        page_head(board.width + 2 * room, bottom),
        '<rect width="100%" height="100%" style="fill:#ffffff"/>',
        f'<rect x="{room:.4g}" y="{room:.4g}" width="{board.width:.6g}" height="{board.height:.6g}" '
        f'style="fill:#faf6ee;stroke:#202830;stroke-width:{2 * line:.4g}"/>',
    ]
    for piece in job.pieces:
        outlines, strokes = drawn[piece.part]
        moved = [Contour(piece.moved(v), b) for v, b in (o.geometry.expanded() for o in outlines)]
        data = " ".join(path_data(contour, corner) for contour in reversed(moved))
        style = f"fill:{fills[piece.part]};fill-rule:evenodd;stroke:#202830;stroke-width:{line:.4g}"
        lines.append(f'<path d="{data}" style="{style}"/>')
        if strokes:
            name = " ".join(stroke_data(np.round(piece.moved(stroke), 3), corner) for stroke in strokes)
            lines.append(f'<path d="{name}" style="{_NAME}"/>')
    save(file, [*lines, *legend])
    return file


def _legend(
    title: str, rows: Sequence[tuple[str, str]], size: float, at: complex, width: float
) -> tuple[list[str], float]:
    """What lies on a board, each beside its colour, under its title from a place on; and the height where that ends."""
    style = f"font-family:sans-serif;font-size:{size:.4g}px;fill:#202830"
    lines = [f'<text x="{at.real:.5g}" y="{at.imag + size:.5g}" style="{style}">{escaped(title)}</text>']
    x, y = at.real, at.imag + 2.7 * size
    for text, fill in rows:
        wide = (len(text) * _WIDE + 3) * size
        if x > at.real and x + wide > at.real + width:
            x, y = at.real, y + 1.7 * size
        box = f'x="{x:.5g}" y="{y - 0.8 * size:.5g}" width="{size:.4g}" height="{size:.4g}"'
        lines.append(f'<rect {box} style="fill:{fill};stroke:#202830;stroke-width:{size / 20:.4g}"/>')
        lines.append(f'<text x="{x + 1.4 * size:.5g}" y="{y:.5g}" style="{style}">{escaped(text)}</text>')
        x += wide
    return lines, y + size

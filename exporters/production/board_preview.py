"""Pictures of boards for people: every piece filled, in its place, with its name."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from exporters.formats.svg import number, page_head, path_data, save
from exporters.production.boards import BoardJob
from exporters.production.plan import Plan
from exporters.production.preview import FILLS, Outlines, escaped, samples
from geometry.plane.contour import Contour

# of the longer side of a board: the letters of names, a line
_LETTERS, _LINE = 1 / 60, 1 / 2500
# of the width of a letter, of its height
_LETTER = 0.6


def board_previews(plan: Plan, outlines: Mapping[str, Outlines], folder: Path) -> list[Path]:
    """A picture of each board, once, whatever the formats of its files."""
    fills = dict(zip(plan.parts, np.resize(FILLS, len(plan.parts)).tolist(), strict=True))
    fills |= {name: part.colour for name, part in plan.parts.items() if part.colour}
    boards = {job.path.rpartition(".")[0]: job for job in plan.assemblies if isinstance(job, BoardJob)}
    return [_preview(job, outlines, fills, folder / f"{name}.preview.svg") for name, job in boards.items()]


def _preview(job: BoardJob, outlines: Mapping[str, Outlines], fills: Mapping[str, str], file: Path) -> Path:
    board = job.board
    size = max(board.width, board.height)
    lines = [page_head(board.width, board.height), '<rect width="100%" height="100%" style="fill:#ffffff"/>']
    names = []
    for piece in job.pieces:
        moved = [Contour(piece.moved(v), b) for v, b in (o.geometry.expanded() for o in outlines[piece.part])]
        data = " ".join(path_data(contour, 1j * board.height) for contour in reversed(moved))
        style = f"fill:{fills[piece.part]};fill-rule:evenodd;stroke:#202830;stroke-width:{size * _LINE:.4g}"
        lines.append(f'<path d="{data}" style="{style}"/>')
        outer = samples(moved[-1])
        low, high = complex(outer.real.min(), outer.imag.min()), complex(outer.real.max(), outer.imag.max())
        box, upright = high - low, (high - low).imag > 1.5 * (high - low).real
        room = box.imag if upright else box.real
        letters = min(size * _LETTERS, room / (_LETTER * len(piece.id)))
        middle = complex((low + high).real / 2, board.height - (low + high).imag / 2)
        foot = middle + (letters / 3 if upright else 1j * letters / 3)
        x, y = number(foot.real, 3), number(foot.imag, 3)
        turn = f' transform="rotate(-90 {x} {y})"' if upright else ""
        style = f"font-family:sans-serif;font-size:{letters:.4g}px;text-anchor:middle;fill:#202830"
        names.append(f'<text x="{x}" y="{y}" style="{style}"{turn}>{escaped(piece.id)}</text>')
    save(file, [*lines, *names])
    return file

"""Pictures of boards and plates for people: every piece filled, in its place, with its name; what lies there."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from exporters.formats.svg import GROUND, escaped, fills, page_head, path_data, save, stroke_data
from exporters.production.boards import BoardJob
from exporters.production.laid import laid_jobs, lying_on
from exporters.production.plan import Plan
from exporters.production.preview import PER_EDGE, outlines_of
from geometry.base.record import Record
from geometry.curves.curve import Complex
from geometry.plane.contour import Contour
from parts.base.part import Part
from parts.base.texts import Words, words
from parts.drawing.names import drawn_names

if TYPE_CHECKING:
    from exporters.production.laid import LaidJob

# a line, room about the board, and letters, of its longer side; engraved names
_LINE, _ROOM, _LETTERS = 1 / 2500, 1 / 60, 1 / 50
# width of a letter, of its size; letters of a row, at least
_WIDE, _LEAST_ROW = 0.62, 20
_NAME = "fill:none;stroke:#0000ff;stroke-width:0.4;stroke-linecap:round;stroke-linejoin:round"
# sizes of words on pieces, of letters of the legend
_SIZES = (1.0, 0.75, 0.55)
_TEXT = "font-family:sans-serif;fill:#202830"


class _Drawn(Record):
    """A part as it lies: outlines to be filled, the lowest first, the strokes of its name, or words for it."""

    layers: tuple[tuple[Contour, ...], ...]
    strokes: tuple[Complex, ...]
    words: tuple[str, ...]
    fill: str


def laid_previews(plan: Plan, folder: Path) -> list[Path]:
    """A picture of each board and plate, once, whatever the formats of its files."""
    colours = fills(plan.parts)
    title = plan.scene.scene.title or plan.scene.name
    return [
        _preview(jobs[0], title, colours, folder / f"{name}.preview.svg", words(plan.scene.scene.language))
        for name, jobs in laid_jobs(plan).items()
    ]


def _preview(job: LaidJob, title: str, colours: Mapping[str, str], file: Path, told: Words) -> Path:
    width, across, third = job.sizes
    size = max(width, across)
    room, line, letters = size * _ROOM, size * _LINE, size * _LETTERS
    drawn = {m.part.id: _drawn(m.part, job, str(k), colours[m.part.id]) for k, m in enumerate(job.members, 1)}
    rows = [(": ".join((*drawn[part].words[1:], row)), drawn[part].fill) for part, row in lying_on(job, told).items()]
    title += told.decimal(f": {width:g} × {across:g} × {third:g}")
    title += f", {job.times} ×" if job.times > 1 else ""
    # so wide that a narrow board has room for words under it
    wide = max(width, _LEAST_ROW * _WIDE * letters)
    legend, bottom = _legend(title, rows, letters, complex(room, across + 2 * room), wide)
    corner = complex(room, across + room)
    lines = [
        page_head(wide + 2 * room, bottom, whole=True),
        GROUND,
        f'<rect x="{room:.4g}" y="{room:.4g}" width="{width:.6g}" height="{across:.6g}" '
        f'style="fill:#faf6ee;stroke:#202830;stroke-width:{2 * line:.4g}"/>',
    ]
    for piece in job.pieces:
        one = drawn[piece.part]
        layers = [[Contour(piece.moved(v), b) for v, b in (c.expanded() for c in layer)] for layer in one.layers]
        for layer in layers:
            data = " ".join(path_data(contour, corner) for contour in reversed(layer))
            style = f"fill:{one.fill};fill-rule:evenodd;stroke:#202830;stroke-width:{line:.4g}"
            lines.append(f'<path d="{data}" style="{style}"/>')
        if one.strokes:
            name = " ".join(stroke_data(np.round(piece.moved(stroke), 3), corner) for stroke in one.strokes)
            lines.append(f'<path d="{name}" style="{_NAME}"/>')
        if one.words:
            lines.append(_word(one.words, layers[-1], corner, letters))
    save(file, [*lines, *legend])
    return file


def _drawn(part: Part, job: LaidJob, number: str, fill: str) -> _Drawn:
    """A part as it is cut; on a bed as it is seen from above, its words its name or a number."""
    if isinstance(job, BoardJob):
        region = part.cut(0.0, job.board.gap).region
        strokes = tuple(np.array(stroke, dtype=np.complex128) for stroke in region.strokes)
        return _Drawn((tuple(o.geometry for o in outlines_of(region)),), strokes, (), fill)
    section = tuple(o.geometry for o in outlines_of(part.section(0.0).region))
    hull = np.array(job.feet[part.id].exterior.coords[:-1]) @ (1, 1j)
    around = (Contour(hull, np.zeros(len(hull))),)
    own, seen = _box(section[-1].sampled(PER_EDGE)), _box(hull)
    # a section may be less than what is seen, and a development is no view
    layers = (
        (section,) if np.allclose(own, seen, rtol=0.02) else (around, section) if max(own / seen) < 1 else (around,)
    )
    return _Drawn(layers, (), (f"{number} {drawn_names(part, part.language)[0]}", number), fill)


def _box(points: Complex) -> np.ndarray:
    """Width and height."""
    return np.array([np.ptp(points.real), np.ptp(points.imag)])


def _word(words: Sequence[str], outlines: Sequence[Contour], corner: complex, most: float) -> str:
    """The first of some words that has room on a piece, as large as it has; the last one in any case."""
    import shapely

    # of places with the same room the same one on any processor
    places = [outline.sampled(PER_EDGE) for outline in outlines]
    rings = [shapely.Polygon(np.round(np.column_stack([p.real, p.imag]), 6)) for p in places]
    clear = shapely.difference(rings[-1].buffer(0), shapely.union_all([ring.buffer(0) for ring in rings[:-1]]))
    x, y = shapely.maximum_inscribed_circle(clear, most / 10).coords[0]
    tried = [(word, most * share) for word in words for share in _SIZES]

    def has_room(word: str, size: float) -> bool:
        half = _WIDE * size * len(word) / 2
        return bool(clear.covers(shapely.box(x - half, y - size / 2, x + half, y + size / 2)))

    word, size = next((one for one in tried if has_room(*one)), tried[-1])
    style = f"{_TEXT};font-size:{size:.4g}px;text-anchor:middle"
    place = f'x="{corner.real + x:.5g}" y="{corner.imag - y + 0.35 * size:.5g}"'
    return f'<text {place} style="{style}">{escaped(word)}</text>'


def _legend(
    title: str, rows: Sequence[tuple[str, str]], size: float, at: complex, width: float
) -> tuple[list[str], float]:
    """What lies on a board, each beside its colour, under its title from a place on; and the height where that ends."""
    style = f"{_TEXT};font-size:{size:.4g}px"
    step, letter = 1.7 * size, _WIDE * size
    lines: list[str] = []

    def write(text: str, x: float, y: float, room: float) -> float:
        rows = wrap(text, int(room / letter))
        for k, row in enumerate(rows):
            lines.append(f'<text x="{x:.5g}" y="{y + k * step:.5g}" style="{style}">{escaped(row)}</text>')
        return y + (len(rows) - 1) * step

    x, y = at.real, write(title, at.real, at.imag + size, width) + step
    for text, shade in rows:
        wide = len(text) * letter + 3 * size
        if x > at.real and x + wide > at.real + width:
            x, y = at.real, y + step
        box = f'x="{x:.5g}" y="{y - 0.8 * size:.5g}" width="{size:.4g}" height="{size:.4g}"'
        lines.append(f'<rect {box} style="fill:{shade};stroke:#202830;stroke-width:{size / 20:.4g}"/>')
        y = write(text, x + 1.4 * size, y, width - 3 * size)
        x += wide
    return lines, y + size

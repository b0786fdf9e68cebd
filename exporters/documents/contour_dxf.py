"""The blocking contour as a drawing: R2010, one layer for each line, x1 and x2 at 100 mm a module."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from geometry.gears.shifts.external import BlockingContour
from parts.base.texts import Words
from parts.pages.contour_picture import clipped, grid_step, kinds_shown, line_title, region_text, tool_texts

if TYPE_CHECKING:
    from ezdxf.document import Drawing

# mm of the drawing for one module of shift
SCALE = 100.0
_TEXT, _ROW = 5.0, 9.0
# ACI colours, those of the lines in turn
_FIXED = {"REGION": 3, "AXES": 8, "KEY": 7, "CHOICES": 6}
_COLOURS = (1, 5, 30, 6, 4, 94, 170, 200, 34, 8)


def write_contour_dxf(
    file: Path, contour: BlockingContour, marks: dict[str, tuple[float, float]], words: Words
) -> dict[str, int]:
    """Write the lines, the region, axes, ``marks`` (words: x1, x2) and a key; returns the entities of each kind."""
    from exporters.formats.dxf_file import new_drawing, save

    drawing = new_drawing()
    colours = {name: _COLOURS[k % len(_COLOURS)] for k, name in enumerate(dict.fromkeys(i.name for i in contour.lines))}
    page = _Page(drawing, _FIXED | {_layer(line.name, line.level): colours[line.name] for line in contour.lines})
    for ring in contour.region:
        page.polyline(ring, "REGION")
    for line in contour.lines:
        for piece in clipped(line.points, contour.box):
            page.polyline(piece, _layer(line.name, line.level))
    _axes(page, contour, words)
    bottom = _key(page, contour, marks, words)
    box = contour.box
    low = min(bottom, box.bottom * SCALE - 20)
    page.space.reset_extents((box.left * SCALE - 20, low, 0.0), (box.right * SCALE + 250, box.top * SCALE + 20, 0.0))
    save(drawing, file)
    return page.counts


class _Page:
    """A drawing that counts what is put on it; points in modules, texts in mm."""

    def __init__(self, drawing: Drawing, colours: dict[str, int]) -> None:
        self.drawing, self.space, self.colours = drawing, drawing.modelspace(), colours
        self.counts = Counter[str]()

    def _add(self, kind: str, layer: str, *shape: Any, **looks: Any) -> None:
        if layer not in self.drawing.layers:
            self.drawing.layers.add(layer, color=self.colours[layer])
        self.counts[kind] += 1
        getattr(self.space, f"add_{kind.lower()}")(*shape, dxfattribs={"layer": layer, **looks})

    def polyline(self, points: Iterable[complex], layer: str) -> None:
        self._add("LWPOLYLINE", layer, [(p.real * SCALE, p.imag * SCALE) for p in points])

    def line(self, start: complex, end: complex, layer: str) -> None:
        """mm."""
        self._add("LINE", layer, (start.real, start.imag), (end.real, end.imag))

    def circle(self, centre: complex, layer: str) -> None:
        """mm."""
        self._add("CIRCLE", layer, (centre.real, centre.imag), 2.0)

    def text(self, at: complex, text: str, layer: str) -> None:
        """mm."""
        self._add("TEXT", layer, text, insert=(at.real, at.imag), height=_TEXT)


def _layer(name: str, level: float | None) -> str:
    return name.upper() if level is None else f"{name.upper()}_{level:g}"


def _axes(page: _Page, contour: BlockingContour, words: Words) -> None:
    """The box, the axes x1 = 0 and x2 = 0 where they lie in it, and numbers along two of its sides."""
    box, step = contour.box, grid_step(contour.box)
    corners = complex(box.left, box.bottom), complex(box.right, box.bottom), complex(box.right, box.top)
    page.polyline((*corners, complex(box.left, box.top), corners[0]), "AXES")
    low, high = corners[0] * SCALE, corners[2] * SCALE
    if box.left < 0 < box.right:
        page.line(complex(0, low.imag), complex(0, high.imag), "AXES")
    if box.bottom < 0 < box.top:
        page.line(complex(low.real, 0), complex(high.real, 0), "AXES")
    for k in range(math.ceil(box.left / step), math.floor(box.right / step) + 1):
        page.text(complex(k * step * SCALE - 4, low.imag - 8), words.decimal(f"{k * step:.3g}"), "AXES")
    for k in range(math.ceil(box.bottom / step), math.floor(box.top / step) + 1):
        page.text(complex(low.real - 17, k * step * SCALE - 2), words.decimal(f"{k * step:.3g}"), "AXES")
    page.text(complex(high.real - 8, low.imag - 16), "x1", "AXES")
    page.text(complex(low.real - 17, high.imag + 4), "x2", "AXES")


def _key(page: _Page, contour: BlockingContour, marks: dict[str, tuple[float, float]], words: Words) -> float:
    """What the lines and points mean; returns the height at which it ends, mm."""
    left, row = contour.box.right * SCALE + 15, contour.box.top * SCALE - _TEXT
    teeth = contour.pair.teeth
    for text in (
        f"z1 = {teeth[0]}, z2 = {teeth[1]}",
        region_text(contour, words),
        *tool_texts(contour.pair, words),
    ):
        page.text(complex(left, row), text, "KEY")
        row -= _ROW
    for name, level in ((i.name, i.level) for i in kinds_shown(contour)):
        layer, middle = _layer(name, level), row + _TEXT / 2
        page.line(complex(left, middle), complex(left + 20, middle), layer)
        page.text(complex(left + 25, row), line_title(name, level, words), layer)
        row -= _ROW
    for told, (x1, x2) in marks.items():
        point = complex(x1, x2) * SCALE
        page.circle(point, "CHOICES")
        page.text(point + (3 + 3j), told.split(":")[0], "CHOICES")
        page.text(complex(left, row), words.phrase(f"{told}: {x1:.4f} / {x2:.4f}"), "CHOICES")
        row -= _ROW
    return row

"""Sheets read back from a PDF by its own grammar: objects, the streams of its pages, the letters of its font."""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TypeAlias

import numpy as np

from geometry.base.record import Draft, Record, field, replace
from geometry.curves.curve import Complex
from parts.base.readback import ReadError, refuse_if
from parts.drawing.canvas import STYLES, Style
from parts.drawing.font import Run
from parts.drawing.readback import PER_CURVE, ReadArc, ReadSheet, base_line

_POINT = 72 / 25.4
# height of a capital as a part of the font's size
_CAPITAL = 1493 / 2048
# mm; points of a path that lie so near to one circle are an arc of it
_ROUND = 1e-4
# mm: words are placed by hundredths of a point, and as long as thousandths of their letters make them
_PLACES = 0.02
_OBJECT = re.compile(rb"(\d+) 0 obj\s(.*?)\sendobj", re.DOTALL)
_TOKEN = re.compile(rb"\(((?:\\.|[^\\)])*)\)|\[([^\]]*)\]|([^\s\[\]()]+)", re.DOTALL)
# of letters: after a code the widths that follow on from it, or a last code and the width of all up to that
_WIDTHS = re.compile(rb"\s*(\d+)\s*(?:\[([^\]]*)\]|(\d+)\s+([\d.]+))")
_ESCAPES = {b"n": b"\n", b"r": b"\r", b"t": b"\t", b"b": b"\b", b"f": b"\f"}


class PdfPath(Record):
    """A painted path, mm, y upwards: its pieces in turn, each four control points (a line has two), and its look."""

    strokes: tuple[tuple[Complex, ...], ...]
    colour: str
    width: float
    dashes: tuple[float, ...]


class PdfPage(Draft):
    """A page, mm."""

    width: float
    height: float
    paths: list[PdfPath] = field(default_factory=list)
    texts: list[Run] = field(default_factory=list)

    def sheet(self, layers: Sequence[str]) -> ReadSheet:
        """What is on it: a PDF names no layers, so its paths are held to look as these, in turn.

        Raises
        ------
        ReadError
            A path looks otherwise, or there are more or fewer.
        """
        found = ReadSheet(texts=self.texts, width=self.width, height=self.height, rounding=_PLACES)
        refuse_if(len(self.paths) != len(layers), f"has {len(self.paths)} paths on a page instead of {len(layers)}")
        for path, layer in zip(self.paths, layers, strict=True):
            refuse_if(not _looks(path, STYLES[layer]), f"layer {layer} looks otherwise than it should")
            for pieces in path.strokes:
                _add(found, layer, pieces)
        return found


def _looks(path: PdfPath, style: Style) -> bool:
    if path.colour != style.colour or len(path.dashes) != len(style.dashes):
        return False
    return bool(np.allclose([path.width, *path.dashes], [style.width, *style.dashes], atol=1e-3))


def read_pdf(file: Path) -> list[PdfPage]:
    """Every page.

    Raises
    ------
    ReadError
        The file is damaged or holds what a sheet does not.
    """
    try:
        data = file.read_bytes()
        objects = {int(number): body for number, body in _OBJECT.findall(data)}
        refuse_if(not data.startswith(b"%PDF-") or not data.rstrip().endswith(b"%%EOF"), "is not a whole PDF file")
        kids = next(body for body in objects.values() if b"/Type /Pages" in body)
        order = [int(n) for n in re.findall(rb"(\d+) 0 R", _after(kids, rb"/Kids \[([^\]]*)\]"))]
        font = next((_Font(objects, body) for body in objects.values() if b"/Subtype /Type0" in body), None)
        return [_page(objects, number, kids, font) for number in order]
    except (StopIteration, ValueError, KeyError, IndexError, zlib.error, OSError) as error:
        raise ReadError(f"is not a PDF file of a sheet: {error}") from error


def _after(body: bytes, pattern: bytes) -> bytes:
    match = re.search(pattern, body)
    if match is None:
        raise ValueError(f"no {pattern.decode()}")
    return match[1]


def _stream(body: bytes) -> bytes:
    raw = body[body.index(b"stream\n") + 7 : body.rindex(b"\nendstream")]
    return zlib.decompress(raw) if b"/FlateDecode" in body else raw


class _Font:
    """Letters and widths (parts of the size) by the codes of a page's words."""

    def __init__(self, objects: dict[int, bytes], body: bytes) -> None:
        table = _stream(objects[int(_after(body, rb"/ToUnicode (\d+) 0 R"))])
        pairs = re.findall(rb"<([0-9A-F]{4})> <([0-9A-F]+)>", table.partition(b"beginbfchar")[2])
        self.letters = {int(code, 16): bytes.fromhex(text.decode()).decode("utf-16-be") for code, text in pairs}
        child = objects[int(_after(body, rb"/DescendantFonts \[(\d+) 0 R\]"))]
        self.widths: dict[int, float] = {}
        at = child.index(b"/W [") + 4
        while (row := _WIDTHS.match(child, at)) is not None:
            first, at = int(row[1]), row.end()
            many = row[2].split() if row[2] is not None else [row[4]] * (int(row[3]) - first + 1)
            self.widths |= {first + k: float(one) / 1000 for k, one in enumerate(many)}

    def said(self, raw: bytes) -> tuple[str, float]:
        """The words of a string, and their length in sizes of the font."""
        codes = [int.from_bytes(raw[k : k + 2]) for k in range(0, len(raw), 2)]
        return "".join(self.letters[c] for c in codes), sum(self.widths[c] for c in codes)


def _page(objects: dict[int, bytes], number: int, parent: bytes, font: _Font | None) -> PdfPage:
    body = objects[number]
    for one, known in ((parent, _TREE), (body, _PAGE)):
        if strange := set(re.findall(rb"/(\w+)", one)) - known:
            raise ReadError(f"has a page with {strange.pop().decode()}, which may turn, cut or scale it")
    box = _after(body if b"/MediaBox" in body else parent, rb"/MediaBox \[([^\]]*)\]")
    left, low, width, height = (float(x) / _POINT for x in box.split())
    refuse_if(left or low, f"has a page from {left:g}, {low:g} mm on instead of 0, 0")
    page = PdfPage(width, height)
    _Reader(page, font, _states(objects, body)).run(_stream(objects[int(_after(body, rb"/Contents (\d+) 0 R"))]))
    return page


# names in the object of all pages, in that of one, and in settings of lines
_TREE = {b"Type", b"Pages", b"Count", b"Kids", b"MediaBox"}
_PAGE = {b"Type", b"Page", b"Parent", b"MediaBox", b"Contents", b"Resources", b"Group"} | {
    b"S", b"Transparency", b"CS", b"DeviceRGB"
}  # fmt: skip
_STATE = {b"Type", b"ExtGState", b"LW", b"D"}


def _states(objects: dict[int, bytes], body: bytes) -> dict[bytes, bytes]:
    """Named settings of lines."""
    resources = body if b"/Resources <<" in body else objects[int(_after(body, rb"/Resources (\d+) 0 R"))]
    if b"/ExtGState" not in resources:
        return {}
    return {name: objects[int(n)] for name, n in re.findall(rb"/(GS\d+) (\d+) 0 R", resources)}


class _Look(Record):
    """How lines are drawn: colour, width and dashes in points."""

    colour: str = "#000000"
    width: float = 1.0
    dashes: tuple[float, ...] = ()


# a, b, c, d, e, f of PDF: x' = a x + c y + e, y' = b x + d y + f
_Frame: TypeAlias = tuple[float, float, float, float, float, float]


class _Reader:
    """Follows the operators of a page's stream."""

    def __init__(self, page: PdfPage, font: _Font | None, states: dict[bytes, bytes]) -> None:
        self.page, self.font, self.states = page, font, states
        self.look, self.frame = _Look(), (1.0, 0.0, 0.0, 1.0, 0.0, 0.0)
        self.kept: list[tuple[_Look, _Frame]] = []
        self.strokes: list[list[Complex]] = []
        self.at = self.text = 0j
        self.size, self.stretch = 0.0, 100.0

    def run(self, stream: bytes) -> None:
        """All of a stream."""
        operands: list[bytes] = []
        for string, array, word in _TOKEN.findall(stream):
            if not word or re.fullmatch(rb"[-+.\d]+|/\w+", word):
                operands.append(word or array or string)
                continue
            self._do(word.decode(), operands)
            operands = []

    def _do(self, name: str, operands: list[bytes]) -> None:
        if name in ("q", "Q"):
            if name == "q":
                self.kept.append((self.look, self.frame))
            else:
                self.look, self.frame = self.kept.pop()
        elif name == "gs":
            self._state(self.states[operands[0][1:]])
        elif name == "Tj":
            self._say(operands[0])
        elif name == "d":
            self.look = replace(self.look, dashes=tuple(map(float, operands[0].split())))
        elif name == "S":
            dashes = tuple(d / _POINT for d in self.look.dashes)
            strokes = tuple(tuple(pieces) for pieces in self.strokes)
            self.page.paths.append(PdfPath(strokes, self.look.colour, self.look.width / _POINT, dashes))
            self.strokes = []
        elif name == "Tf":
            self.size = float(operands[1])
        elif name not in ("BT", "ET", "g", "rg", "J", "j"):
            self._numbers(name, list(map(float, operands)))

    def _numbers(self, name: str, numbers: list[float]) -> None:
        if name == "w":
            self.look = replace(self.look, width=numbers[0])
        elif name in ("RG", "G"):
            shades = numbers if name == "RG" else numbers * 3
            self.look = replace(self.look, colour="#" + "".join(f"{round(255 * x):02x}" for x in shades))
        elif name == "cm":
            origin = self._on(complex(*numbers[4:])) * _POINT
            one, two = ((self._on(complex(*numbers[k : k + 2])) - self._on(0j)) * _POINT for k in (0, 2))
            self.frame = (one.real, one.imag, two.real, two.imag, origin.real, origin.imag)
        elif name == "Td":
            self.text = complex(*numbers)
        elif name == "Tz":
            self.stretch = numbers[0]
        elif name in ("m", "l", "c"):
            points = [self._on(complex(x, y)) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]
            if name == "m":
                self.strokes.append([])
            else:
                self.strokes[-1].append(np.array([self.at, *points]))
            self.at = points[-1]
        else:
            raise ValueError(f"the operator {name}, which a sheet does not have")

    def _on(self, point: complex) -> complex:
        """A point of the stream on paper, mm."""
        a, b, c, d, e, f = self.frame
        return complex(a * point.real + c * point.imag + e, b * point.real + d * point.imag + f) / _POINT

    def _state(self, body: bytes) -> None:
        if strange := set(re.findall(rb"/(\w+)", body)) - _STATE:
            raise ReadError(f"draws lines with {strange.pop().decode()}, which may hide them")
        if (width := re.search(rb"/LW ([\d.]+)", body)) is not None:
            self.look = replace(self.look, width=float(width[1]))
        if (dashes := re.search(rb"/D \[\[([^\]]*)\] [\d.]+\]", body)) is not None:
            self.look = replace(self.look, dashes=tuple(map(float, dashes[1].split())))

    def _say(self, raw: bytes) -> None:
        if self.font is None:
            raise ValueError("words without a font")
        plain = re.sub(rb"\\(.)", lambda m: _ESCAPES.get(m[1], m[1]), raw, flags=re.DOTALL)
        words, length = self.font.said(plain)
        size = self.size / _POINT
        at, way = self._on(self.text), self._on(self.text + 1) - self._on(self.text)
        self.page.texts.append(Run(words, at, size * _CAPITAL, length * size * self.stretch / 100, base_line(way)))


def _add(sheet: ReadSheet, layer: str, pieces: tuple[Complex, ...]) -> None:
    """A stroke of a layer: a line, an arc where its points lie on a circle, or a curve."""
    if len(pieces) == 1 and len(pieces[0]) == 2:
        sheet.add_line(layer, *(complex(p) for p in pieces[0]))
        return
    points = np.concatenate(list(_points(pieces)))
    sheet.samples.append((layer, points))
    if (arc := _circle(points)) is not None:
        sheet.arcs.append(ReadArc(layer, *arc))


def _points(pieces: tuple[Complex, ...]) -> Iterator[Complex]:
    t = np.linspace(0, 1, PER_CURVE)
    for piece in pieces:
        if len(piece) == 2:
            yield piece[0] + (piece[1] - piece[0]) * t
        else:
            a, b, c, d = piece
            yield (1 - t) ** 3 * a + 3 * t * (1 - t) ** 2 * b + 3 * t**2 * (1 - t) * c + t**3 * d


def _circle(points: Complex) -> tuple[complex, float, float] | None:
    """Centre, radius and sweep of the circle that all points lie on, by least squares; None for none."""
    middle = points.mean()
    x = points - middle
    rows = np.column_stack([2 * x.real, 2 * x.imag, np.ones(len(x))])
    (a, b, c), _, rank, _ = np.linalg.lstsq(rows, np.abs(x) ** 2, rcond=None)
    if rank < 3:
        return None
    centre, radius = middle + complex(a, b), float(np.sqrt(max(c + a * a + b * b, 0.0)))
    if not np.abs(np.abs(points - centre) - radius).max() < _ROUND:
        return None
    turns = np.unwrap(np.angle(points - centre))
    return complex(centre), radius, abs(float(turns[-1] - turns[0]))

"""Sheets read back: lines, arcs, points of splines and words, from DXF by ezdxf and from SVG by its own grammar."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import numpy as np

from exporters.drawings.dashes import LONGEST
from exporters.drawings.write import BEARING, FLAG
from geometry.base.record import replace
from geometry.curves.curve import Complex
from parts.base.readback import ReadError, refuse_if
from parts.drawing.canvas import FRAME, STYLES
from parts.drawing.font import Run
from parts.drawing.readback import PER_CURVE, ReadSheet, base_line

if TYPE_CHECKING:
    from exporters.formats.read_drawing import DrawnSpline

_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_KNOWN = {
    "svg": {"width", "height", "viewBox", "version"},
    "g": {"id", "style"},
    "path": {"d"},
    "text": {"x", "y", "style", "textLength", "lengthAdjust", "transform"},
}
_GROUND = {"width": "100%", "height": "100%", "style": "fill:#ffffff"}
_SVG = "{http://www.w3.org/2000/svg}"


def read_sheets(file: Path, layers: Sequence[Sequence[str]]) -> list[ReadSheet]:
    """Read sheets by the ending of a file's name: several may be in a PDF, whose pages have paths of these ``layers``.

    Raises
    ------
    ReadError
        The file is damaged or holds what a sheet does not.
    """
    if file.suffix == ".pdf":
        from exporters.drawings.read_pdf import read_pdf

        pages = read_pdf(file)
        refuse_if(len(pages) != len(layers), f"has {len(pages)} pages instead of {len(layers)}")
        return [page.sheet(wanted) for page, wanted in zip(pages, layers, strict=True)]
    return [_read_dxf(file) if file.suffix == ".dxf" else _read_svg(file)]


def _read_dxf(file: Path) -> ReadSheet:
    from exporters.formats.read_drawing import (
        DrawnArc,
        DrawnLine,
        DrawnSpline,
        dimensions,
        drawn,
        look_of,
        opened,
    )

    document = opened(file, audit=False)
    curves, words = drawn(document, "sheet")
    for name in {entity.layer for entity in (*curves, *words)}:
        style = STYLES.get(name)
        if style is None:
            raise ReadError(f"layer {name} does not belong on a sheet")
        colour, line = look_of(document, name)
        lengths = [abs(tag.value) for tag in document.linetypes.get(line).pattern_tags.tags if tag.code == 49]
        weight = document.layers.get(name).dxf.lineweight
        if (colour, lengths, weight) != (style.aci, list(style.dashes), round(100 * style.width)):
            raise ReadError(f"layer {name} looks otherwise than it should")
    sheet, share = ReadSheet(), np.linspace(0, 1, PER_CURVE)
    sheet.dimensions = dimensions(document)
    # a drawing is as large as its frame is
    most = document.header.get("$EXTMAX", (0.0, 0.0))
    sheet.width, sheet.height = most[0] + FRAME, most[1] + FRAME
    last = ""
    for curve in curves:
        match curve:
            case DrawnLine():
                sheet.add_line(curve.layer, curve.start, curve.end)
            case DrawnArc():
                first = math.radians(curve.first)
                sweep = math.radians(curve.last) - first
                sweep += 2 * math.pi if sweep <= 0 else 0.0
                sheet.add_arc(curve.layer, curve.centre, curve.radius, first, sweep)
            case _:
                _add_spline(sheet, curve, curve.spans(share).ravel(), after_another=last == curve.layer)
        last = curve.layer if isinstance(curve, DrawnSpline) else ""
    for one in words:
        way, black = base_line(one.right - one.left), abs(one.right - one.left)
        width = black / FLAG if one.text == "1" else black + 2 * BEARING * one.height
        sheet.texts.append(Run(one.text, one.left - (width - black) / 2 * way, one.height, width, way))
    return sheet


def _add_spline(sheet: ReadSheet, curve: DrawnSpline, points: Complex, *, after_another: bool) -> None:
    """A spline with its samples, or a dash of one that goes on where the last one has ended."""
    dashes = STYLES[curve.layer].dashes
    if curve.dash != bool(dashes) or (dashes and np.abs(np.diff(points)).sum() > LONGEST * dashes[0]):
        raise ReadError(f"a SPLINE on layer {curve.layer} is drawn otherwise than in its dashes")
    if dashes and after_another:
        # a gap on and no more: where a dash is missing, another curve begins
        before = sheet.samples[-1][1]
        gap, way = points[0] - before[-1], before[-1] - before[-2]
        if dashes[1] / 2 < abs(gap) < dashes[1] * 1.01 and (gap / way).real > abs(gap / way) / 2:
            points = np.concatenate([sheet.samples.pop()[1], points])
    sheet.samples.append((curve.layer, points))


def _read_svg(file: Path) -> ReadSheet:
    from exporters.formats.read_svg import root_of

    try:
        root = root_of(file)
    except (ElementTree.ParseError, OSError) as error:
        raise ReadError(f"is not an SVG file: {error}") from error
    _check_known(root)
    sizes = root.get("viewBox", "").split()
    if len(sizes) != 4 or root.get("width") != f"{sizes[2]}mm" or root.get("height") != f"{sizes[3]}mm":
        raise ReadError("has no size in mm that its view box agrees with")
    height = float(sizes[3])
    sheet = ReadSheet(width=float(sizes[2]), height=height)
    for group in root.findall(f"{_SVG}g"):
        layer = group.get("id", "")
        refuse_if(group.get("style", "") != _look(layer), f"layer {layer} looks otherwise than it should")
        for path in group.findall(f"{_SVG}path"):
            _read_path(sheet, layer, path.get("d", ""), height)
        for text in group.findall(f"{_SVG}text"):
            at = complex(float(text.get("x", "nan")), height - float(text.get("y", "nan")))
            size = re.fullmatch(r"font-size:([\d.]+)px", text.get("style", ""))
            if size is None:
                raise ReadError("has words without a size")
            turn = text.get("transform")
            turns = {f"rotate({by} {text.get('x')} {text.get('y')})": way for by, way in ((-90, 1j), (180, -1.0))}
            if turn is not None and turn not in turns:
                raise ReadError(f"has words that are turned by {turn}")
            way = 1.0 if turn is None else turns[turn]
            capital, length = float(size[1]) * 1493 / 2048, float(text.get("textLength", "nan"))
            sheet.texts.append(Run(text.text or "", at, capital, length, way))
    return sheet


def _check_known(root: ElementTree.Element) -> None:
    """A ground of white, then groups of paths and words, none of which says how it looks: its group does."""
    ground, *groups = [*root] or [root]
    refuse_if(ground.tag != f"{_SVG}rect" or dict(ground.attrib) != _GROUND, "has no ground of white")
    refuse_if(any(group.tag != f"{_SVG}g" for group in groups), "holds something beside its layers")
    for element in (root, *(e for group in groups for e in group.iter())):
        tag = element.tag.removeprefix(_SVG)
        if tag not in _KNOWN or (tag == "g") != (element in groups) or (tag in ("path", "text") and len(element)):
            raise ReadError(f"holds <{tag}> where a sheet does not")
        if strange := set(element.keys()) - _KNOWN[tag]:
            raise ReadError(f"has a <{tag}> with {strange.pop()}, which may hide or move it")


def _look(layer: str) -> str:
    """How the group of a layer must look."""
    style = STYLES.get(layer)
    if style is None:
        raise ReadError(f"layer {layer} does not belong on a sheet")
    if layer == "TEXT":
        return f"font-family:DejaVu Sans Condensed,Arial,Liberation Sans,sans-serif;fill:{style.colour}"
    dashes = f";stroke-dasharray:{' '.join(f'{d:g}' for d in style.dashes)}" if style.dashes else ""
    return f"fill:none;stroke:{style.colour};stroke-width:{style.width}{dashes}"


def _read_path(sheet: ReadSheet, layer: str, data: str, height: float) -> None:
    from exporters.formats.read_svg import circular

    at, pieces = 0j, 0
    for command, text in re.findall(r"([A-Za-z])([^A-Za-z]*)", data):
        values = [float(v) for v in _NUMBER.findall(text)]
        places = values[-2:] if command == "A" else values
        refuse_if(len(places) % 2 or not places, f"the path command {command} lacks a coordinate")
        ends = [complex(x, height - y) for x, y in zip(places[::2], places[1::2], strict=True)]
        if command == "L":
            sheet.add_line(layer, at, ends[-1])
        elif command == "A":
            radius, large, right, _ = circular(values)
            _read_arc(sheet, layer, at, ends[-1], radius, large, right, merge=pieces > 0)
        elif command == "C":
            t = np.linspace(0, 1, PER_CURVE)
            a, b, c = ends
            points = (1 - t) ** 3 * at + 3 * t * (1 - t) ** 2 * a + 3 * t**2 * (1 - t) * b + t**3 * c
            if pieces:
                points = np.concatenate([sheet.samples.pop()[1], points])
            sheet.samples.append((layer, points))
        elif command != "M":
            raise ReadError(f"holds the path command {command}, which a sheet does not")
        pieces += command != "M"
        at = ends[-1]


def _read_arc(
    sheet: ReadSheet, layer: str, start: complex, end: complex, radius: float, large: bool, right: bool, *, merge: bool
) -> None:
    """An SVG arc by its ends, whose y runs down: the flag that turns right there turns left here."""
    chord = end - start
    lift = math.sqrt(max(radius**2 - abs(chord) ** 2 / 4, 0.0))
    sense = -1.0 if right else 1.0
    centre = (start + end) / 2 + sense * (-1 if large else 1) * 1j * chord / abs(chord) * lift
    sweep = cmath.phase((end - centre) / (start - centre))
    if sweep * sense < 0:
        sweep += sense * 2 * math.pi
    sheet.add_arc(layer, centre, radius, cmath.phase(start - centre), sweep)
    if merge:
        # one arc, of which each piece is held to what it should be
        last, before = sheet.arcs.pop(), sheet.arcs.pop()
        sheet.arcs.append(replace(last, sweep=before.sweep + last.sweep))
        points = [sheet.samples.pop()[1] for _ in range(2)]
        sheet.samples.append((layer, np.concatenate(points[::-1])))

"""Read-back of laser SVG: closed paths and circles in mm, and engraved lines. Shares no code with the writer."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from exporters.formats.readback import Loop, ReadOutlines
from geometry.curves.curve import Complex
from parts.base.readback import ReadError, refuse_if

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

# the attributes of each element, and what its style may say; all else may hide, move or colour an outline
_KNOWN = {
    "svg": {"width", "height", "viewBox", "version"},
    "path": {"d", "id", "style"},
    "circle": {"cx", "cy", "r", "id", "style"},
}
_STYLE = re.compile(r"fill:none;stroke:(#[0-9a-f]{6});stroke-width:(\d*\.?\d+)")
# lines of a cut are thin, mm
_WIDEST = 0.25
_LAYERS = {"#0000ff": "ENGRAVE", "#00ff00": "CUT_INNER", "#ff0000": "CUT_OUTER"}
_SVG = "{http://www.w3.org/2000/svg}"
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_COMMAND = rf"([MLAZ])((?:[\s,]*{_NUMBER})*)"


def read_svg(file: Path) -> ReadOutlines:
    """The circles and closed paths of an SVG in mm, y turned up again, in an order that every program cuts them in."""
    from xml.etree import ElementTree

    try:
        root = root_of(file)
        width, height = (_millimetres(root.get(key, "")) for key in ("width", "height"))
        box = [float(x) for x in root.get("viewBox", "").split()]
    except (ElementTree.ParseError, ValueError, OSError) as error:
        raise ReadError(f"not a readable SVG in mm: {error}") from error
    if len(box) != 4 or max(abs(box[2] - width), abs(box[3] - height), abs(box[0]), abs(box[1])) > 1e-9 * width:
        raise ReadError("one unit of the SVG's view box is not one mm")
    loops: list[Loop] = []
    strokes: list[Complex] = []
    shapes = [e.tag for e in root.iter() if e.tag.removeprefix(_SVG) in ("circle", "path")]
    refuse_if(shapes != sorted(shapes), "a circle stands behind a path, before which LaserGRBL cuts it")
    for element in root.iter():
        tag = element.tag.removeprefix(_SVG)
        if tag not in _KNOWN or (tag == "svg") != (element is root):
            raise ReadError(f"an element <{tag}> stands among the outlines")
        if strange := set(element.keys()) - _KNOWN[tag]:
            raise ReadError(f"an SVG {tag} has a {strange.pop()}, which may hide or move it")
        try:
            data = element.get("d", "")
            if tag == "path" and (line := _open_line(data)) is not None and _layer(element) == "ENGRAVE":
                strokes.append(line)
            elif tag == "path":
                loops.append(svg_path(data, _layer(element)))
            elif tag == "circle":
                x, y, r = (float(element.get(k, "nan")) for k in ("cx", "cy", "r"))
                ends = np.array([complex(x + r, -y), complex(x - r, -y)])
                loops.append(Loop(ends, np.ones(2), _layer(element)))
        except ValueError as error:
            raise ReadError(f"broken {tag}: {error}") from error
    middle = complex(width / 2, -height / 2)
    moved = tuple(Loop(loop.vertices - middle, loop.bulges, loop.layer) for loop in loops)
    return ReadOutlines(moved, tuple(stroke - middle for stroke in strokes))


def _open_line(data: str) -> Complex | None:
    """The points of a path of M and L alone that is not closed."""
    if not re.fullmatch(rf"M{_NUMBER},{_NUMBER}(?: L{_NUMBER},{_NUMBER})+", data):
        return None
    numbers = [float(x) for x in re.findall(_NUMBER, data)]
    return np.array([complex(x, -y) for x, y in zip(numbers[::2], numbers[1::2], strict=True)])


def root_of(file: Path) -> Element:
    """The root of an SVG that says itself how it looks."""
    from xml.etree import ElementTree

    data = file.read_bytes()
    if found := re.search(rb"<!DOCTYPE|<\?(?!xml )[^?]*", data):
        raise ReadError(f"the SVG holds {found[0].decode(errors='replace')}, which may change how it looks")
    return ElementTree.fromstring(data)


def _layer(element: Element) -> str:
    """What is done along an outline, as its colour tells a laser program; its id must not tell otherwise."""
    style, name = re.sub(r"\s|;\s*$", "", element.get("style", "").lower()), _named(element.get("id", ""))
    shown = _STYLE.fullmatch(style)
    if shown is None or shown[1] not in _LAYERS or not 0 < float(shown[2]) <= _WIDEST:
        raise ReadError(f'an outline of the SVG has the style "{style}"')
    layer = _LAYERS[shown[1]]
    refuse_if(name and name != layer, f"an outline of the SVG is named {name}, but coloured as {layer}")
    return layer


def _named(name: str) -> str:
    """The layer that an id names: those of one layer are numbered from the second on."""
    return name.partition("-")[0].upper()


def _millimetres(text: str) -> float:
    if not text.endswith("mm"):
        raise ValueError(f'a width or height of "{text}" is not in mm')
    return float(text.removesuffix("mm"))


def svg_path(data: str, layer: str) -> Loop:
    """One closed subpath of absolute M, L, A and Z."""
    refuse_if(re.sub(_COMMAND, "", data).strip(), "an SVG path holds more than M, L, A and Z")
    points: list[complex] = []
    bulges: list[float] = []
    closed = False
    for command, text in re.findall(_COMMAND, data):
        numbers = [float(x) for x in re.findall(_NUMBER, text)]
        if command == "Z":
            closed = True
        elif command == "A":
            radius, large, sweep, end = circular(numbers)
            refuse_if(not points, "an SVG path begins with an arc")
            bulges.append(_svg_bulge(end.conjugate() - points[-1], radius, large, sweep))
            points.append(end.conjugate())
        else:
            refuse_if(len(numbers) != 2 or closed, "an SVG path has more than one part")
            if points:
                bulges.append(0.0)
            points.append(complex(numbers[0], -numbers[1]))
    if not closed or not points or abs(points[-1] - points[0]) > 1e-9:
        raise ReadError("an SVG path is not closed on its first point")
    return Loop(np.array(points[:-1]), np.array(bulges), layer)


def circular(numbers: Sequence[float]) -> tuple[float, bool, bool, complex]:
    """Radius, both flags and end of an arc of a path, y downwards.

    Raises
    ------
    ReadError
        It is an ellipse's, or what browsers do not draw (SVG 1.1, 8.3.9: a flag is 0 or 1).
    """
    if len(numbers) != 7 or numbers[0] != numbers[1] or not {numbers[3], numbers[4]} <= {0, 1}:
        raise ReadError("an SVG arc is not a circular arc of seven numbers")
    return numbers[0], bool(numbers[3]), bool(numbers[4]), complex(numbers[5], numbers[6])


def _svg_bulge(chord: complex, radius: float, large: bool, sweep: bool) -> float:
    """Bulge of an SVG arc, a line where its radius is 0 (SVG 1.1, F.6.2); sweep flag 1 turns right once y is up."""
    if radius == 0:
        return 0.0
    half = math.asin(min(1.0, abs(chord) / (2 * radius)))
    quarter = (math.pi - half if large else half) / 2
    return math.tan(quarter) * (-1 if sweep else 1)

"""SVG in mm: laser outlines as plain paths and circles."""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from geometry.base.tolerance import DRAWN_DECIMALS
from geometry.curves.curve import Complex, Real
from geometry.plane.contour import Approximation, Contour, edge_points

if TYPE_CHECKING:
    from parts.base.part import Part

STROKES = {"ENGRAVE": "#0000ff", "CUT_INNER": "#00ff00", "CUT_OUTER": "#ff0000"}
# of parts in pictures that name no colour
_FILLS = (
    *("#b8c4d0", "#d9c39a", "#b5cfae", "#d3b3b3", "#bdb6d6", "#a4d4d4"),
    *("#e6b58f", "#d3d67f", "#e3b3dd", "#8fb0e0", "#b9a48f", "#8fc795"),
)
# of outlines that are pictures alone
_PICTURE_DECIMALS = 6
# of numbers that are rounded already
_MOST_DIGITS = 12
_MARGIN = 2.0
# what pictures stand on
GROUND = '<rect width="100%" height="100%" style="fill:#ffffff"/>'
# of the letters of pictures; below a size some programs round their ways to nothing, so that they are written larger
TEXT_STYLE = "font-family:sans-serif;fill:#202830"
_LEAST_LETTER, _LARGER = 0.5, 100
# what stands lower or higher in a sign, as in d_a and mm^3, how small it is, and how far it is moved
_MOVED, _SMALLER, _LOW, _HIGH = re.compile(r"(?<=(?<!\w)[^\W\d_])_([^\W_]+)(?!\w)|\^(\d+)"), 0.7, 0.2, -0.35
# arcs of more than 100 degrees
_LONG_BULGE = float(np.tan(np.radians(25)))
# LaserGRBL cuts an arc of a path in so many chords (GCodeFromSVG.cs); how far they may leave it, mm: Grbl's own $12
_CHORDS, _FOLLOWED = 12, 0.002


def fills(parts: Mapping[str, Part]) -> dict[str, str]:
    """The colour of each part in every picture; what names none has one by its place in the scene."""
    return {name: part.colour or _FILLS[index % len(_FILLS)] for index, (name, part) in enumerate(parts.items())}


def write_laser_svg(
    file: Path,
    layers: tuple[str, ...],
    boundaries: tuple[Approximation, ...],
    strokes: Sequence[Complex] = (),
    board: complex | None = None,
) -> dict[str, int]:
    """Write outlines at their true size; one user unit is one mm. No transform, no class, no style sheet.

    What stands behind a path is a path: LaserGRBL cuts all circles of a file before its paths.
    ``strokes``: points of open chains, which are engraved before all else. The origin stands in the middle of the page,
    or in the lower left corner of a ``board`` of this size, mm.
    """
    middle = round(max(float(np.abs(b.geometry.vertices).max()) for b in boundaries), _PICTURE_DECIMALS) + _MARGIN
    page, origin = (2 * middle * (1 + 1j), middle * (1 + 1j)) if board is None else (board, 1j * board.imag)
    lines = [page_head(page.real, page.imag)]
    told = Counter[str]()
    lines += [f'<path d="{stroke_data(stroke, origin)}" {_look("ENGRAVE", told)}/>' for stroke in strokes]
    ahead = not strokes
    for layer, boundary in zip(layers, boundaries, strict=True):
        ahead = ahead and _is_circle(boundary.geometry)
        lines.append((_circle if ahead else _path)(boundary.geometry, _look(layer, told), origin))
    save(file, lines)
    counts = {"shapes": len(boundaries), **({"strokes": len(strokes)} if strokes else {})}
    return {**counts, "vertices": sum(len(b.geometry) for b in boundaries)}


def _look(layer: str, told: Counter[str]) -> str:
    """The id and style of an outline of a layer, of which so many have been ``told``."""
    told[layer] += 1
    name = layer.lower() if told[layer] == 1 else f"{layer.lower()}-{told[layer]}"
    return f'id="{name}" style="fill:none;stroke:{STROKES[layer]};stroke-width:0.1"'


def stroke_data(points: Complex, origin: complex) -> str:
    """Absolute M and L commands through points that are rounded already."""
    places = zip((origin.real + points.real).tolist(), (origin.imag - points.imag).tolist(), strict=True)
    return "M" + " L".join(f"{number(x, _MOST_DIGITS)},{number(y, _MOST_DIGITS)}" for x, y in places)


# what keeps a picture within the window of a browser; all else goes by its width and height
_WHOLE = 'style="max-width:100%;max-height:100vh" '


def page_head(wide: float, high: float, left: float = 0.0, top: float = 0.0, *, whole: bool = False) -> str:
    """The opening of a picture so many mm wide and high, whose upper left corner stands at (left, top).

    ``whole``: a browser shows all of it, smaller where its window is.
    """
    width, height = number(wide), number(high)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" version="1.1" '
        f'{_WHOLE if whole else ""}width="{width}mm" height="{height}mm" '
        f'viewBox="{number(left)} {number(top)} {width} {height}">'
    )


def _is_circle(contour: Contour) -> bool:
    return len(contour) == 2 and np.allclose(np.abs(contour.bulges), 1, rtol=1e-12)


def _circle(contour: Contour, attributes: str, origin: complex) -> str:
    """``origin``: its place from the page's upper left corner."""
    ends, decimals = contour.expanded()[0], contour.decimals or _PICTURE_DECIMALS
    centre, radius = ends.mean(), abs(ends[0] - ends[1]) / 2
    x, y, r = (number(v, decimals) for v in (origin.real + centre.real, origin.imag - centre.imag, radius))
    return f'<circle cx="{x}" cy="{y}" r="{r}" {attributes}/>'


def _path(contour: Contour, attributes: str, origin: complex) -> str:
    return f'<path d="{path_data(contour, origin, _FOLLOWED)}" {attributes}/>'


def path_data(contour: Contour, origin: complex, followed: float = math.inf) -> str:
    """Absolute M, L and A commands; y runs down in SVG, so a left turn has sweep flag 0.

    ``followed``: how far the chords of LaserGRBL may leave an arc, mm.
    """
    vertices, bulges = _divided(*contour.expanded(), followed)
    ends, decimals = np.roll(vertices, -1), contour.decimals or _PICTURE_DECIMALS
    xs, ys = (origin.real + ends.real).tolist(), (origin.imag - ends.imag).tolist()
    parts = [f"M{number(xs[-1], decimals)},{number(ys[-1], decimals)}"]
    for x, y, bulge, chord in zip(xs, ys, bulges.tolist(), np.abs(ends - vertices).tolist(), strict=True):
        to = f"{number(x, decimals)},{number(y, decimals)}"
        r = _radius(chord, abs(bulge), decimals) if bulge else "0"
        # a crown below half of the last decimal leaves no digit of its radius
        if r == "0":
            parts.append(f"L{to}")
        else:
            parts.append(f"A{r},{r} 0 {int(abs(bulge) > 1)} {int(bulge < 0)} {to}")
    return " ".join(parts) + " Z"


def _divided(vertices: Complex, bulges: Real, followed: float) -> tuple[Complex, Real]:
    """The same outline, its arcs cut: long ones into four; near half a turn ends and radius hold the centre badly."""
    ends, heights = np.roll(vertices, -1), np.abs(bulges)
    counts = np.where(heights > _LONG_BULGE, 4, 1)
    # n chords leave an arc by r (sweep / n)^2 / 8
    sweeps = 4 * np.arctan(heights)
    grown = sweeps * np.abs(ends - vertices) / np.sinc(sweeps / (2 * math.pi))
    counts = np.maximum(counts, np.ceil(np.sqrt(grown / (8 * followed)) / _CHORDS)).astype(int)
    if counts.max() == 1:
        return vertices, bulges
    edges = np.repeat(np.arange(len(counts)), counts)
    shares = (np.arange(len(edges)) - np.repeat(np.cumsum(counts) - counts, counts)) / counts[edges]
    places = edge_points(vertices[edges], ends[edges], bulges[edges], shares[:, None]).ravel()
    return places, np.where(counts == 1, bulges, np.tan(np.arctan(bulges) / counts))[edges]


def _radius(chord: float, bulge: float, decimals: int) -> str:
    """The radius of an arc of up to 100 degrees as text; the flatter the arc, the fewer digits hold its crown."""
    radius, crown = chord * (1 + bulge**2) / (4 * bulge), chord * bulge / 2
    places = decimals - math.floor(math.log10(radius / crown))
    # a radius on the middle between two numbers goes up on any machine
    return number(round(radius * (1 + 1e-13) + 1e-6 * 10.0**-places, places), decimals)


def number(value: float, decimals: int = DRAWN_DECIMALS) -> str:
    """A coordinate as text."""
    text = f"{value:.{decimals}f}"
    text = text.rstrip("0").rstrip(".") if decimals else text
    return "0" if text == "-0" else text


def text_line(text: str, x: float, y: float, size: float, style: str = "") -> str:
    """A line of text in letters of a size, its signs with lowered letters; ``style`` ends in a semicolon."""
    times, moved = (1, "") if size >= _LEAST_LETTER else (_LARGER, f' transform="scale({1 / _LARGER:g})"')
    x, y, size = times * x, times * y, times * size
    place, told = f'x="{x:.5g}" y="{y:.5g}"', "".join(_signs(text, size))
    return f'<text {place}{moved} style="{style}font-size:{size:.4g}px;{TEXT_STYLE}">{told}</text>'


def _signs(text: str, size: float) -> Iterator[str]:
    """A text with what is lowered or raised in it moved there, the rest back on its line."""
    at, back = 0, 0.0
    for found in _MOVED.finditer(text):
        way = size * (_HIGH if found[1] is None else _LOW)
        before, small = text[at : found.start()], f'style="font-size:{_SMALLER:.0%}"'
        yield from _moved(before, back)
        yield f'<tspan dy="{way + (0.0 if before.strip() else back):.4g}" {small}>{found[1] or found[2]}</tspan>'
        at, back = found.end(), -way
    yield from _moved(text[at:], back)


def _moved(text: str, way: float) -> Iterator[str]:
    """A text with a shift; spaces at its start stand before what is shifted, within which some programs drop them."""
    rest = text.lstrip()
    yield text[: len(text) - len(rest)]
    if rest:
        yield f'<tspan dy="{way:.4g}">{escaped(rest)}</tspan>' if way else escaped(rest)


def escaped(text: str) -> str:
    """A text as it stands in an SVG."""
    return escape(text, quote=False)


def save(file: Path, lines: list[str]) -> None:
    """Write the lines of a picture and close it."""
    with file.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write("\n".join([*lines, "</svg>", ""]))

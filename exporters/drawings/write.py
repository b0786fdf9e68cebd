"""Sheets as files: DXF R2010 with true splines and line types, and SVG with exact Bezier curves."""

from __future__ import annotations

import math
import re
from collections import Counter
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from exporters.drawings.dashes import dashes_of
from exporters.formats.svg import GROUND, number, page_head, save
from geometry.approximation.outline import CadCurve
from geometry.base.tolerance import DRAWN_DECIMALS
from geometry.curves.bspline import BSpline
from geometry.curves.line_arc import Arc, Line
from parts.drawing.canvas import STYLES, TEXT_HEIGHT, Canvas, Dimension
from parts.drawing.dimensioning import ARROW
from parts.drawing.font import CAPITAL, Run

if TYPE_CHECKING:
    from ezdxf.document import Drawing
    from ezdxf.layouts import BaseLayout, BlockLayout

_DIMSTYLE = "ESKD"
_FONT = "arial.ttf"
# LibreCAD takes a style by its name for a font of its own, and knows line types by standard names only, of which the
# short ones (2) fit sheets. Its unicode, which every version has, holds Cyrillic; its font after GOST 2.304 the rest
_STYLE, _SYMBOLS_STYLE = "unicode", "lc_opengost-ar"
_OF_UNICODE = re.compile(r"[\u0020-\u00ff\u0400-\u04ff\u2032\u2033]*")
_LINE_TYPES = {2: "DASHED2", 4: "CENTER2", 6: "DIVIDE2"}
# what letters leave free on either side, parts of their height: programs fit what is black between two points. A 1 has
# its flag fitted, a part of its width: one as wide as other digits is read as a 7
BEARING, FLAG = 0.07, 0.44
# how words are turned whose base line does not run to the right, degrees
_TURNS = {1j: -90, -1: 180}
# the letters of the widths that are stated, and others as wide
_FAMILY = "font-family:DejaVu Sans Condensed,Arial,Liberation Sans,sans-serif"


def _black_of(run: Run) -> tuple[complex, complex]:
    """The ends of what is black in a run, on its base line."""
    free = (1 - FLAG) / 2 * run.width if run.text == "1" else BEARING * run.height
    return run.at + free * run.way, run.at + (run.width - free) * run.way


def write_sheet_dxf(file: Path, canvas: Canvas) -> dict[str, int]:
    """DXF R2010 in mm on paper: lines, arcs, circles and cubic splines on their layers, text fitted to its length."""
    from ezdxf.enums import TextEntityAlignment

    from exporters.formats.drawing_dxf import add_curve, place_of
    from exporters.formats.dxf_file import new_drawing
    from exporters.formats.dxf_file import save as save_dxf

    runs = [run for text in canvas.texts for run in text.runs]
    drawing = new_drawing()
    drawing.header["$LTSCALE"] = 1.0
    for name in dict.fromkeys(map(_style, runs)):
        drawing.styles.add(name, font=_FONT)
    used = {"TEXT", *(s.layer for s in canvas.strokes)}
    for name, style in STYLES.items():
        if name not in used:
            continue
        kind = "CONTINUOUS"
        if style.dashes:
            kind = _LINE_TYPES[len(style.dashes)]
            if kind not in drawing.linetypes:
                signed = [d if i % 2 == 0 else -d for i, d in enumerate(style.dashes)]
                drawing.linetypes.add(kind, [sum(style.dashes), *signed])
        drawing.layers.add(name, color=style.aci, linetype=kind, lineweight=round(style.width * 100))
    space = drawing.modelspace()
    counts = Counter[str]()
    spaces: dict[tuple[str, int], BaseLayout] = {}
    for one in canvas.dimensions:
        block = _add_dimension(drawing, one)
        spaces |= {("strokes", k): block for k in one.strokes} | {("texts", k): block for k in one.texts}
        counts["DIMENSION"] += 1
    for index, stroke in enumerate(canvas.strokes):
        dashes = STYLES[stroke.layer].dashes
        pieces, line_type = [stroke.curve], "BYLAYER"
        if dashes and isinstance(stroke.curve, BSpline):
            pieces, line_type = [*dashes_of(stroke.curve, dashes)], "CONTINUOUS"
        for piece in pieces:
            counts[add_curve(spaces.get(("strokes", index), space), piece, stroke.layer, line_type)] += 1
    for index, run in ((k, run) for k, text in enumerate(canvas.texts) for run in text.runs):
        entity = spaces.get(("texts", index), space).add_text(
            run.text, height=round(run.height, DRAWN_DECIMALS), dxfattribs={"layer": "TEXT", "style": _style(run)}
        )
        left, right = map(place_of, _black_of(run))
        entity.set_placement(left, right, align=TextEntityAlignment.FIT)
        counts["TEXT"] += 1
    # all stands within the frame; ezdxf takes a corner at 0, 0 for none
    frame = canvas.reach
    space.reset_extents((frame.left, frame.low, 0.0), (frame.right, frame.high, 0.0))
    drawing.paperspace().reset_limits((0, 0), (canvas.width, canvas.height))
    save_dxf(drawing, file)
    return counts


def _add_dimension(drawing: Drawing, one: Dimension) -> BlockLayout:
    """A DIMENSION that programs can edit, measured in mm of the model; the block for its lines and words."""
    from exporters.formats.drawing_dxf import place_of

    name = f"{_DIMSTYLE}_{one.scale:.9g}".replace(".", "_")
    if name not in drawing.dimstyles:
        is_first = not any(style.dxf.name.startswith(_DIMSTYLE) for style in drawing.dimstyles)
        told = {"dimtxt": TEXT_HEIGHT, "dimasz": ARROW, "dimexe": 1.5, "dimexo": 0.0, "dimgap": 0.9, "dimdli": 8.0,
                "dimclrt": STYLES["TEXT"].aci, "dimlfac": 1 / one.scale, "dimdec": 3, "dimzin": 8, "dimtad": 1,
                "dimdsep": ord(one.mark)}  # fmt: skip
        more = {"dimtih": 0, "dimtoh": 0, "dimlunit": 2, "dimtofl": 1, "dimtxsty": _STYLE, "dimaunit": 1, "dimadec": 4}
        drawing.dimstyles.new(name, {**told, **more})
        # some programs know one style only: the first, that of the sheet
        for key, value in told.items() if is_first else ():
            drawing.header[f"${key.upper()}"] = value
        # LibreCAD has Cyrillic in that one alone
        drawing.header["$DIMTXSTY"] = _STYLE
    block = drawing.blocks.new_anonymous_block(type_char="D")
    first, second = (place_of(p) for p in one.points)
    attributes: dict[str, object] = {
        "layer": "DIMENSION", "dimstyle": name, "geometry": block.name, "text": one.text,
        "text_midpoint": (*place_of(one.middle), 0.0),
    }  # fmt: skip
    # all programs read linear ones right; the block is this one's own, words within its arrows stay where they were put
    code = 32 if one.beside else 32 | 128
    if one.vertex is None:
        attributes |= {"actual_measurement": one.value, "defpoint": place_of(one.line), "defpoint2": first,
                       "defpoint3": second, "angle": one.angle}  # fmt: skip
    else:
        # between two lines, which LibreCAD reads right, and not by three points
        vertex, code = place_of(one.vertex), code | 2
        attributes |= {"actual_measurement": math.radians(one.value), "defpoint2": vertex, "defpoint3": first,
                       "defpoint4": vertex, "defpoint": second, "defpoint5": place_of(one.line)}  # fmt: skip
    drawing.modelspace().new_entity("DIMENSION", {**attributes, "dimtype": code})
    return block


def _style(run: Run) -> str:
    return _STYLE if _OF_UNICODE.fullmatch(run.text) else _SYMBOLS_STYLE


def write_sheet_svg(file: Path, canvas: Canvas) -> dict[str, int]:
    """SVG in mm: a group for each layer, its curves as paths; text with its length stated."""
    lines = [page_head(canvas.width, canvas.height), GROUND]
    for name in canvas.layers:
        curves, style = [s.curve for s in canvas.strokes if s.layer == name], STYLES[name]
        dashes = f";stroke-dasharray:{' '.join(map(number, style.dashes))}" if style.dashes else ""
        look = f"fill:none;stroke:{style.colour};stroke-width:{style.width}{dashes}"
        lines.append(f'<g id="{name}" style="{look}">')
        lines += [f'<path d="{_path(c, canvas.height)}"/>' for c in curves]
        lines.append("</g>")
    lines.append(f'<g id="TEXT" style="{_FAMILY};fill:{STYLES["TEXT"].colour}">')
    lines += [_text(run, canvas.height) for t in canvas.texts for run in t.runs]
    lines.append("</g>")
    save(file, lines)
    return {"paths": len(canvas.strokes), "texts": sum(len(t.runs) for t in canvas.texts)}


def _text(run: Run, height: float) -> str:
    size, x, y = number(run.height / CAPITAL), number(run.at.real), number(height - run.at.imag)
    words = escape(run.text)
    length = f'textLength="{number(run.width)}" lengthAdjust="spacingAndGlyphs"'
    turn = f' transform="rotate({_TURNS[run.way]} {x} {y})"' if run.way in _TURNS else ""
    return f'<text x="{x}" y="{y}" style="font-size:{size}px" {length}{turn}>{words}</text>'


def _path(curve: CadCurve, height: float) -> str:
    """Absolute M, L, A and C commands; y runs down in SVG."""

    def xy(point: complex) -> str:
        return f"{number(point.real)},{number(height - point.imag)}"

    if isinstance(curve, Line):
        return f"M{xy(curve.start)} L{xy(curve.end)}"
    if isinstance(curve, Arc):
        r, flag = number(curve.radius), int(curve.sweep < 0)
        # a half circle's ends leave its centre open by the root of their rounding
        parts = math.ceil(abs(curve.sweep) / (2 * math.pi / 3) - 1e-9)
        ends = [complex(curve.point(abs(curve.sweep) * k / parts)) for k in range(parts + 1)]
        return f"M{xy(ends[0])} " + " ".join(f"A{r},{r} 0 0 {flag} {xy(e)}" for e in ends[1:])
    return " ".join([f"M{xy(complex(curve.poles[0]))}", *(f"C{xy(a)} {xy(b)} {xy(c)}" for a, b, c in beziers(curve))])


def beziers(spline: BSpline) -> list[tuple[complex, complex, complex]]:
    """The last three control points of each span of a cubic, exact."""
    breaks = spline.breaks
    starts, ends = breaks[:-1], breaks[1:]
    third = (ends - starts) / 3
    points = spline.point(breaks)
    first = points[:-1] + spline.derivative(starts) * third
    # seen from the span itself: a derivative at a knot is that of the next span
    middle = spline.point((starts + ends) / 2)
    second = (8 * middle - points[:-1] - points[1:] - 3 * first) / 3
    return [(complex(a), complex(b), complex(c)) for a, b, c in np.stack([first, second, points[1:]], axis=1)]

"""SVG in mm: laser outlines as plain paths and circles, and the preview picture of a part."""

from __future__ import annotations

from pathlib import Path
from textwrap import wrap

import numpy as np

from exporters.words import words
from geometry.contour import Approximation, Contour
from geometry.curve import Complex, Real
from parts.part import Part

STROKES = {"CUT_INNER": "#00ff00", "CUT_OUTER": "#ff0000"}
# exporters/job.py states what this rounding may do to an outline
_DIGITS = 9
_MARGIN = 2.0
# letters of the caption that fit beside a preview
_CAPTION_LETTERS = 42


def write_laser_svg(file: Path, layers: tuple[str, ...], boundaries: tuple[Approximation, ...]) -> dict[str, int]:
    """Write outlines at their true size; one user unit is one mm. No transform, no class, no style sheet."""
    reach = max(float(np.abs(b.geometry.vertices).max()) for b in boundaries)
    lines = [_head(reach + _MARGIN)]
    for layer, boundary in zip(layers, boundaries, strict=True):
        style = f"fill:none;stroke:{STROKES[layer]};stroke-width:0.1"
        lines.append(_shape(boundary.geometry, f'id="{layer.lower()}" style="{style}"', reach + _MARGIN))
    _save(file, lines)
    return {"shapes": len(boundaries), "vertices": sum(len(b.geometry) for b in boundaries)}


def write_preview(
    file: Path, part: Part, boundaries: tuple[Approximation, ...], remarks: list[str], language: str
) -> dict[str, int]:
    """A picture for people: the filled part, its circles with their diameters, and what was noticed."""
    reach = max(float(np.abs(b.geometry.vertices).max()) for b in boundaries)
    middle = reach * 1.08
    text = reach / 22
    rows = [f"{words(language, name)}  {value:.4f}" for name, value in (part.circles | part.quantities).items()]
    remarks = [line for remark in remarks for line in wrap(remark, _CAPTION_LETTERS)]
    lines = [
        _head(
            middle,
            extra_width=text * 24,
            extra_height=max(0.0, text * 1.7 * (len(rows) + len(remarks) + 2) - 2 * middle),
        )
    ]
    lines.append('<rect width="100%" height="100%" style="fill:#ffffff"/>')
    data = " ".join(_path_data(b.geometry, middle) for b in reversed(boundaries))
    fill = part.colour or "#b8c4d0"
    lines.append(
        f'<path d="{data}" style="fill:{fill};fill-rule:evenodd;stroke:#202830;stroke-width:{reach / 400:.4g}"/>'
    )
    dash = f"{reach / 30:.4g} {reach / 120:.4g} {reach / 200:.4g} {reach / 120:.4g}"
    for name, diameter in part.circles.items():
        colour = _CIRCLE_COLOURS.get(name, "#808080")
        line = f"fill:none;stroke:{colour};stroke-width:{reach / 600:.4g};stroke-dasharray:{dash}"
        lines.append(
            f'<circle cx="{_number(middle)}" cy="{_number(middle)}" r="{_number(diameter / 2)}" style="{line}"/>'
        )
    lines += _cross(middle, reach)
    lines += _caption([part.id, *rows, *remarks], 2 * middle + text, text)
    _save(file, lines)
    return {"shapes": 1}


_CIRCLE_COLOURS = {"reference_diameter": "#c03020", "base_diameter": "#2060c0", "root_form_diameter": "#209050"}


def _cross(middle: float, reach: float) -> list[str]:
    """Centre lines."""
    style = f'style="stroke:#c03020;stroke-width:{reach / 600:.4g}"'
    ends = _number(middle - reach * 1.05), _number(middle + reach * 1.05), _number(middle)
    return [
        f'<line x1="{ends[0]}" y1="{ends[2]}" x2="{ends[1]}" y2="{ends[2]}" {style}/>',
        f'<line x1="{ends[2]}" y1="{ends[0]}" x2="{ends[2]}" y2="{ends[1]}" {style}/>',
    ]


def _caption(rows: list[str], left: float, size: float) -> list[str]:
    style = f"font-family:sans-serif;font-size:{size:.4g}px;fill:#202830"
    return [
        f'<text x="{left:.4g}" y="{(i + 1.5) * size * 1.7:.4g}" style="{style}">{_escaped(row)}</text>'
        for i, row in enumerate(rows)
    ]


def _escaped(text: str) -> str:
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def _head(middle: float, extra_width: float = 0.0, extra_height: float = 0.0) -> str:
    width, height = _number(2 * middle + extra_width), _number(2 * middle + extra_height)
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n<svg xmlns="http://www.w3.org/2000/svg" version="1.1" '
        f'width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">'
    )


def _shape(contour: Contour, attributes: str, middle: float) -> str:
    """A contour as a path, or as a circle where it is one."""
    if len(contour) == 2 and np.allclose(np.abs(contour.bulges), 1, rtol=1e-12):
        centre, radius = contour.vertices.mean(), abs(contour.vertices[0] - contour.vertices[1]) / 2
        x, y = _number(middle + centre.real), _number(middle - centre.imag)
        return f'<circle cx="{x}" cy="{y}" r="{_number(radius)}" {attributes}/>'
    return f'<path d="{_path_data(contour, middle)}" {attributes}/>'


def _path_data(contour: Contour, middle: float) -> str:
    """Absolute M, L and A commands; y runs down in SVG, so a left turn has sweep flag 0."""
    vertices, bulges = contour.expanded()
    ends = np.roll(vertices, -1)
    xs, ys = (middle + ends.real).tolist(), (middle - ends.imag).tolist()
    radii = _radii(vertices, ends, bulges).tolist()
    parts = [f"M{_number(middle + vertices[0].real)},{_number(middle - vertices[0].imag)}"]
    for x, y, bulge, radius in zip(xs, ys, bulges.tolist(), radii, strict=True):
        if bulge == 0:
            parts.append(f"L{_number(x)},{_number(y)}")
        else:
            r = _number(radius)
            parts.append(f"A{r},{r} 0 {int(abs(bulge) > 1)} {int(bulge < 0)} {_number(x)},{_number(y)}")
    return " ".join(parts) + " Z"


def _radii(starts: Complex, ends: Complex, bulges: Real) -> Real:
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.abs(ends - starts) * (1 + bulges**2) / (4 * np.abs(bulges))


def _number(value: float) -> str:
    text = f"{value:.{_DIGITS}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text


def _save(file: Path, lines: list[str]) -> None:
    with file.open("w", encoding="utf-8", newline="\n") as stream:
        stream.write("\n".join([*lines, "</svg>", ""]))

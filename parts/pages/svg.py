"""Pictures of pages as SVG: the document, words, chains of points; lengths in px."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable

INK = "#202830"


def document(width: float, height: float, lines: Iterable[str]) -> str:
    """A white sheet with what is drawn on it."""
    size = f'viewBox="0 0 {width:.0f} {height:.0f}" width="{width:.0f}" height="{height:.0f}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size}>'
    return "\n".join([head, '<rect width="100%" height="100%" style="fill:#ffffff"/>', *lines, "</svg>", ""])


def written(x: float, y: float, text: str, colour: str = INK, size: int = 12, anchor: str = "") -> str:
    """Words, indices behind a low line lowered; ``anchor``: start, middle or end of them at the place."""
    place = f"text-anchor:{anchor};" if anchor else ""
    style = f"font-family:sans-serif;font-size:{size}px;{place}fill:{colour}"
    return f'<text x="{x:.2f}" y="{y:.2f}" style="{style}">{_lowered(html.escape(text), size / 4)}</text>'


def _lowered(text: str, by: float) -> str:
    """A text with its indices ``by`` px lower; spaces behind one stand before what goes back, where they are kept."""
    first, *rest = re.split(r"_([^\W²³]+)(\s*)([^_]*)", text)
    for index, room, after in zip(rest[::4], rest[1::4], rest[2::4], strict=True):
        back = f'<tspan dy="{-by:g}">{after}</tspan>' if after else ""
        first += f'<tspan dy="{by:g}" style="font-size:75%">{index}</tspan>{room}{back}'
    return first


def chain(points: Iterable[tuple[float, float]], style: str, *, closed: bool = False) -> str:
    """Points joined by lines."""
    told = " ".join(f"{x:.2f},{y:.2f}" for x, y in points)
    return f'<{"polygon" if closed else "polyline"} points="{told}" style="{style}"/>'


def circle(x: float, y: float, radius: float, style: str, digits: str = ".2f") -> str:
    """A circle; ``digits`` of its radius."""
    return f'<circle cx="{x:.2f}" cy="{y:.2f}" r="{radius:{digits}}" style="{style}"/>'

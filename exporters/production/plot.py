"""A log-log picture as SVG: a few series of points, decades as grid lines."""

from __future__ import annotations

import math
from pathlib import Path

from exporters.formats.svg import GROUND, escaped, save

Series = tuple[str, list[float], list[float]]

# the field of the curves ends at _RIGHT, the key stands beside it
_HEIGHT, _LEFT, _BOTTOM, _TOP, _RIGHT = 434.0, 70.0, 50.0, 44.0, 530.0
# of text of 12 px: more than the mean width of a letter in common fonts, and from line to line of the key
_LETTER, _LINE = 8.0, 16.0
_COLOURS = ("#c03020", "#2060c0", "#209050", "#a06000", "#8030a0", "#008090", "#606060", "#d06090")
# of the lines when the colours come round again
_DASHES = ("none", "7 3", "2 2")
# of a line in the key, beside the field and before its name
_SAMPLE, _GAP = 22.0, 8.0
# so many decades beside each other have their numbers at every line
_MANY = 12


def write_loglog(file: Path, title: str, axes: tuple[str, str], series: list[Series]) -> None:
    """Draw positive points of each series, joined in their order; others are left out. ``axes``: names of x and y."""
    kept = [(name, _positive(xs, ys)) for name, xs, ys in series]
    kept = [(name, points) for name, points in kept if points]
    points = [p for _, row in kept for p in row]
    x_axis, y_axis = _decades([p[0] for p in points]), _decades([p[1] for p in points])
    names = [name for name, _ in kept]
    key = _RIGHT + 2 * _GAP
    width = max(key + _SAMPLE + 2 * _GAP + _LETTER * max(map(len, names)), _LEFT + _LETTER * len(title))
    height = max(_HEIGHT, _TOP + _LINE * (len(names) + 1))
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}" height="{height:g}">',
        GROUND,
        _text(_LEFT, 18, title),
        _text(_LEFT, _HEIGHT - 10, axes[0]),
        _text(8, _TOP - 12, axes[1]),
    ]
    lines += _grid(x_axis, y_axis)
    for index, (name, row) in enumerate(kept):
        turn, of = divmod(index, len(_COLOURS))
        colour, y_key = _COLOURS[of], _TOP + _LINE * (index + 1)
        line = f"fill:none;stroke:{colour};stroke-width:1.5;stroke-dasharray:{_DASHES[turn % len(_DASHES)]}"
        mark = f"stroke:{colour};fill:{'#ffffff' if turn else colour}"
        places = [(_at(p[0], x_axis, _LEFT, _RIGHT), _at(p[1], y_axis, _HEIGHT - _BOTTOM, _TOP)) for p in row]
        path = " ".join(f"{x:.2f},{y:.2f}" for x, y in places)
        lines.append(f'<polyline points="{path}" style="{line}"/>')
        lines += [f'<circle cx="{x:.2f}" cy="{y:.2f}" r="3" style="{mark}"/>' for x, y in places]
        lines.append(f'<path d="M{key:g},{y_key - 4:g} h{_SAMPLE:g}" style="{line}"/>')
        lines.append(_text(key + _SAMPLE + _GAP, y_key, name, colour))
    save(file, lines)


def _positive(xs: list[float], ys: list[float]) -> list[tuple[float, float]]:
    return [(x, y) for x, y in zip(xs, ys, strict=True) if x > 0 and y > 0 and math.isfinite(x * y)]


def _decades(values: list[float]) -> tuple[int, int]:
    """Whole decades around the values."""
    low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
    return low, max(high, low + 1)


def _at(value: float, axis: tuple[int, int], start: float, end: float) -> float:
    return start + (math.log10(value) - axis[0]) / (axis[1] - axis[0]) * (end - start)


def _grid(x_axis: tuple[int, int], y_axis: tuple[int, int]) -> list[str]:
    style = "stroke:#c8ccd0;stroke-width:0.7"
    lines = []
    for decade in range(x_axis[0], x_axis[1] + 1):
        x = _at(10.0**decade, x_axis, _LEFT, _RIGHT)
        lines.append(f'<line x1="{x:.2f}" y1="{_TOP:g}" x2="{x:.2f}" y2="{_HEIGHT - _BOTTOM:g}" style="{style}"/>')
        if x_axis[1] - x_axis[0] <= _MANY or not (decade - x_axis[0]) % 2:
            lines.append(_text(x - 12, _HEIGHT - _BOTTOM + 16, f"1e{decade}"))
    for decade in range(y_axis[0], y_axis[1] + 1):
        y = _at(10.0**decade, y_axis, _HEIGHT - _BOTTOM, _TOP)
        lines.append(f'<line x1="{_LEFT:g}" y1="{y:.2f}" x2="{_RIGHT:g}" y2="{y:.2f}" style="{style}"/>')
        lines.append(_text(_LEFT - 42, y + 4, f"1e{decade}"))
    return lines


def _text(x: float, y: float, text: str, colour: str = "#202830") -> str:
    style = f"font-family:sans-serif;font-size:12px;fill:{colour}"
    return f'<text x="{x:.2f}" y="{y:.2f}" style="{style}">{escaped(text)}</text>'

"""An animated SVG (SMIL): outlines of instances that turn and move over one loop, again and again, in any browser."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape
from pathlib import Path

import numpy as np

from exporters.formats.svg import number, page_head, path_data, save
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.plane.contour import Approximation, Contour

# decimals of places, mm, of angles, degrees, of corners of what changes, mm, and of shares of the loop
_PLACE, _ANGLE, CORNERS, _TIME = 6, 9, 4, 12
_PINS = "#7f8c99"


class Track(Record):
    """How an instance moves over one loop: shares of it, and places (mm) and angles (rad, counter-clockwise) there, the
    last one that of the first again; a single one where it does not move so.

    ``forms``: in place of outlines the corners (t, n) of one that changes, at even times too. ``seconds``: of a loop of
    its own. ``pins`` stand on it, and what ``lines`` surround.
    """

    name: str
    outlines: tuple[Approximation, ...]
    colour: str
    places: tuple[Real, Complex]
    angles: tuple[Real, Complex]
    forms: Complex | None = None
    seconds: float | None = None
    pins: tuple[Contour, ...] = ()
    lines: tuple[Contour, ...] = ()


def write_motion_svg(file: Path, title: str, tracks: Sequence[Track], box: Sequence[float], seconds: float) -> None:
    """Write tracks, the lowest first; ``box``: left, low, right, high of all of it, mm."""
    left, low, right, high = box
    stroke = number((right - left) / 900)
    lines = [page_head(right - left, high - low, left, -high, whole=True), f"<title>{escape(title)}</title>"]
    for track in tracks:
        places = [f"{number(z.real, _PLACE)},{number(-z.imag, _PLACE)}" for z in track.places[1].tolist()]
        angles = [number(-math.degrees(a), _ANGLE) for a in track.angles[1].real.tolist()]
        data = [" ".join(path_data(outline.geometry, 0j) for outline in track.outlines)]
        if track.forms is not None:
            data = [_corners(corners) for corners in track.forms]
        lines += [
            f'<g id="{track.name}"{_moved("translate", track.places[0], places, seconds)}',
            f"<g{_moved('rotate', track.angles[0], angles, seconds)}",
            f'<path d="{data[0]}" style="fill:{track.colour};fill-opacity:0.85;fill-rule:evenodd;stroke:#202830;'
            f'stroke-width:{stroke}"{_changed(data, track.seconds or seconds)}',
            *(
                f'<path d="{" ".join(path_data(one, 0j) for one in on)}" '
                f'style="fill:{shade};stroke:#202830;stroke-width:{stroke}"/>'
                for on, shade in ((track.lines, "none"), (track.pins, _PINS))
                if on
            ),
            "</g></g>",
        ]
    save(file, lines)


def _moved(kind: str, shares: Real, values: Sequence[str], seconds: float) -> str:
    """The rest of a group's opening: what moves it once, or over and over."""
    # the first pose, for what does not animate; what moves takes its place
    placed = f' transform="{kind}({values[0]})">'
    if len(values) == 1:
        return placed
    # values at even shares need none
    even = float(np.ptp(np.diff(shares))) < 10.0**-_TIME
    times = "" if even else f' keyTimes="{";".join(number(t, _TIME) for t in shares.tolist())}"'
    return (
        f'{placed}<animateTransform attributeName="transform" type="{kind}" dur="{number(seconds)}s" '
        f'repeatCount="indefinite"{times} values="{";".join(values)}"/>'
    )


def _corners(outline: Complex) -> str:
    """A polygon, y downwards."""
    xy = [f"{number(z.real, CORNERS)},{number(-z.imag, CORNERS)}" for z in outline.tolist()]
    return f"M{' L'.join([*xy, xy[0]])} Z"


def _changed(data: Sequence[str], seconds: float) -> str:
    """The rest of a path: by what its outline is taken over and over."""
    if len(data) == 1:
        return "/>"
    return (
        f'><animate attributeName="d" dur="{number(seconds)}s" repeatCount="indefinite" '
        f'values="{";".join(data)}"/></path>'
    )


def even_way(shares: Real, values: Complex) -> tuple[Real, Complex]:
    """As few of the values as hold them: one that stays, the ends of a straight and even way, or all of them."""
    straight = values[0] + (values[-1] - values[0]) * shares
    if np.abs(values - values[0]).max() <= 10.0**-_ANGLE:
        return shares[:1], values[:1]
    if np.abs(values - straight).max() <= 10.0**-_ANGLE:
        return shares[[0, -1]], values[[0, -1]]
    return shares, values

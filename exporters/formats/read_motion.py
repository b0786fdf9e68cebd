"""An animated SVG read back: where every instance stands at any share of the loop. Shares no code with the writer."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from exporters.formats.read_svg import root_of, svg_path
from exporters.formats.readback import Loop
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from parts.base.readback import ReadError, refuse_if

if TYPE_CHECKING:
    from xml.etree.ElementTree import Element

_SVG = "{http://www.w3.org/2000/svg}"
_KNOWN = {
    "svg": {"width", "height", "viewBox", "version", "style"},
    "title": set[str](),
    "g": {"id", "transform"},
    "path": {"d", "style"},
    "animate": {"attributeName", "dur", "repeatCount", "values"},
    "animateTransform": {"attributeName", "type", "dur", "repeatCount", "keyTimes", "values"},
}
# what keeps it within the window of a browser
_WITHIN = "max-width:100%;max-height:100vh"
_ON = r"fill:(none|#7f8c99);stroke:#202830;stroke-width:[\d.]+"
_STYLE = r"fill:#[0-9a-f]{6};fill-opacity:0\.85;fill-rule:evenodd;stroke:#202830;stroke-width:[\d.]+"


class ReadTrack(Record):
    """An instance: shares of its loop with values (k,) of its place (mm, y up), and of its turn (rad); its outlines.

    ``forms``: the corners (k, n) of an only one that changes, at even times; ``loops`` has it as it begins.
    ``seconds``: for its loop (0: it does not move). ``pins`` and ``lines`` stand on it.
    """

    places: tuple[Real, Complex]
    angles: tuple[Real, Complex]
    loops: tuple[Loop, ...]
    forms: Complex | None = None
    seconds: float = 0.0
    pins: tuple[Loop, ...] = ()
    lines: tuple[Loop, ...] = ()

    def pose(self, share: Real) -> tuple[Complex, Real]:
        """Place and turn at shares of the loop: SMIL goes straight from value to value."""
        return _between(*self.places, share), _between(*self.angles, share).real

    def formed(self, share: Real) -> Complex | None:
        """Corners (t, n) of an outline that changes, at shares of the loop."""
        return (
            None
            if self.forms is None
            else np.stack([_between(_even(len(one)), one, share) for one in self.forms.T], axis=1)
        )


def read_motion(file: Path) -> dict[str, ReadTrack]:
    """Read an animated SVG: all that it shows.

    Raises
    ------
    ReadError
        It is damaged, or holds what may move or hide an outline in another way.
    """
    from xml.etree import ElementTree

    try:
        root = root_of(file)
    except (ElementTree.ParseError, OSError) as error:
        raise ReadError(f"is not an SVG file: {error}") from error
    for element in root.iter():
        tag = element.tag.removeprefix(_SVG)
        if tag not in _KNOWN or set(element.keys()) - _KNOWN[tag]:
            raise ReadError(f"holds <{tag}> {sorted(element.keys())}, which a motion does not")
    refuse_if(root.get("style") not in (None, _WITHIN), "is shown otherwise than as large as it is or as its window")
    tracks = {}
    for outer in root.findall(f"{_SVG}g"):
        inner = outer.find(f"{_SVG}g")
        path = None if inner is None else inner.find(f"{_SVG}path")
        name = outer.get("id", "")
        if inner is None or path is None or name in tracks or not re.fullmatch(_STYLE, path.get("style", "")):
            raise ReadError(f"instance {name} is not one outline within two groups")
        durations = set[str]()
        loops = _subpaths(path)
        on = {"none": (), "#7f8c99": ()} | {
            found[1]: _subpaths(one)
            for one in inner.findall(f"{_SVG}path")[1:]
            if (found := re.fullmatch(_ON, one.get("style", ""))) and not len(one)
        }
        refuse_if(len(inner.findall(f"{_SVG}path")) != 1 + sum(map(bool, on.values())), "more stands on an outline")
        forms = _forms(path, durations) if len(path) else None
        (when, places), (then, angles) = _values(outer, "translate", durations), _values(inner, "rotate", durations)
        refuse_if(len(durations) > 1, "an instance takes unlike times for its loop")
        seconds = float(durations.pop().removesuffix("s")) if durations else 0.0
        turns = np.asarray(-np.radians(angles.real) + 0j)
        tracks[name] = ReadTrack((when, places.conj()), (then, turns), loops, forms, seconds, on["#7f8c99"], on["none"])
    return tracks


def _subpaths(path: Element) -> tuple[Loop, ...]:
    return tuple(svg_path(part, "") for part in re.findall(r"M[^M]*", path.get("d", "")))


def _values(group: Element, kind: str, durations: set[str]) -> tuple[Real, Complex]:
    """Shares and values of a transform: x + iy of a translation, degrees of a turn, as the file has them."""
    moves = group.findall(f"{_SVG}animateTransform")
    placed = group.get("transform")
    found = re.fullmatch(rf"{kind}\(([^()]*)\)", placed or "")
    if found is None:
        raise ReadError(f"a group is placed by {placed}")
    texts = [found[1]]
    if moves:
        texts = _animated(moves, {"attributeName": "transform", "type": kind}, found[1], durations)
    try:
        numbers = [[float(x) for x in text.split(",")] for text in texts]
    except ValueError as error:
        raise ReadError(f"a value of a motion is no number: {error}") from error
    refuse_if({len(row) for row in numbers} != {2 if kind == "translate" else 1}, "a value of a motion lacks a number")
    values = np.array([complex(row[0], row[1] if len(row) > 1 else 0.0) for row in numbers])
    return _shares(moves[0] if moves else None, len(values)), values


def _even(count: int) -> Real:
    return np.linspace(0, 1, count)


def _shares(move: Element | None, count: int) -> Real:
    """When an animation has its values: at times that it tells, else evenly."""
    told = None if move is None else move.get("keyTimes")
    if told is None:
        return _even(count)
    try:
        times = np.array([float(x) for x in told.split(";")])
    except ValueError as error:
        raise ReadError(f"a time of a motion is no number: {error}") from error
    whole = len(times) == count > 1 and times[0] == 0 and times[-1] == 1
    refuse_if(not whole or np.diff(times).min() <= 0, "the times of a motion do not go through its loop")
    return times


def _animated(moves: Sequence[Element], looks: dict[str, str], first: str, durations: set[str]) -> list[str]:
    """The values that the only animation goes through over and over, from that on which stands there before."""
    wanted = {**looks, "repeatCount": "indefinite"}
    if len(moves) != 1 or any(moves[0].get(key) != value for key, value in wanted.items()):
        raise ReadError(f"has no {looks.get('type', 'change')} that goes on for ever")
    durations.add(moves[0].get("dur", ""))
    texts = moves[0].get("values", "").split(";")
    if texts[0] != first:
        raise ReadError(f"stands at {first}, but its motion starts at {texts[0]}")
    return texts


def _forms(path: Element, durations: set[str]) -> Complex:
    """The corners (k, n) of an outline that changes, y up."""
    refuse_if(path[0].tag != f"{_SVG}animate", "an outline is moved where it should change")
    texts = _animated([*path], {"attributeName": "d"}, path.get("d", ""), durations)
    loops = [svg_path(text, "") for text in texts]
    if len({len(loop.vertices) for loop in loops}) > 1 or any(loop.bulges.any() for loop in loops):
        raise ReadError("an outline that changes is not of as many lines throughout")
    return np.array([loop.vertices for loop in loops])


def _between(at: Real, values: Complex, share: Real) -> Complex:
    if len(values) == 1:
        return np.full(len(share), values[0])
    return np.interp(share, at, values.real) + 1j * np.interp(share, at, values.imag)

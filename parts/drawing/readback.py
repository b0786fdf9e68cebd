"""A sheet as it is read again from a file: lines, arcs, points of curves and words, mm on paper."""

from __future__ import annotations

from collections.abc import Sized

import numpy as np

from geometry.base.record import Draft, Record, field
from geometry.curves.curve import Complex
from parts.base.texts import fault, unless
from parts.drawing.font import Run

# samples of each curve, or of each smooth span of it
PER_CURVE = 13


class ReadLine(Record):
    """A straight line, mm."""

    layer: str
    start: complex
    end: complex


class ReadArc(Record):
    """An arc or circle: centre, radius, mm; swept angle, rad, positive."""

    layer: str
    centre: complex
    radius: float
    sweep: float


def base_line(way: complex) -> complex:
    """The way of a base line that runs to the right, upwards or to the left, whatever its length."""
    if abs(way.imag) > abs(way.real):
        return 1j
    return 1.0 if way.real > 0 else -1.0


class ReadDimension(Record):
    """A dimension: its number by its own points and the scale of its style, mm, or degrees, and its words."""

    value: float
    text: str


class ReadSheet(Draft):
    """All that a sheet holds; ``samples`` has points of every line, arc and spline, by layer, one array a curve.

    Width and height of the paper and the rounding of places of words, mm; ``dimensions``: where the format has them.
    """

    lines: list[ReadLine] = field(default_factory=list)
    arcs: list[ReadArc] = field(default_factory=list)
    texts: list[Run] = field(default_factory=list)
    samples: list[tuple[str, Complex]] = field(default_factory=list)
    width: float = 0.0
    height: float = 0.0
    rounding: float = 1e-6
    dimensions: list[ReadDimension] | None = None

    def add_line(self, layer: str, start: complex, end: complex) -> None:
        """A straight line with its samples."""
        self.lines.append(ReadLine(layer, start, end))
        self.samples.append((layer, (start + (end - start) * np.linspace(0, 1, PER_CURVE)).astype(np.complex128)))

    def add_arc(self, layer: str, centre: complex, radius: float, first: float, sweep: float) -> None:
        """An arc with its samples; angles in rad."""
        self.arcs.append(ReadArc(layer, centre, radius, abs(sweep)))
        self.samples.append((layer, centre + radius * np.exp(1j * (first + sweep * np.linspace(0, 1, PER_CURVE)))))


class Taken(Draft):
    """What is measured off a sheet, and what is wrong with it; ``room``: mm on paper that all may be off."""

    room: float
    measured: dict[str, float] = field(default_factory=dict)
    failures: list[str] = field(default_factory=list)

    def unless(self, well: object, msgid: str, /, **numbers: object) -> None:
        """What is wrong with the sheet where it is not well in something."""
        self.failures += unless(well, msgid, **numbers)


def lines_missing(layer: str, found: Sized, wanted: Sized) -> str:
    """The fault of a layer that has not the lines that it should have."""
    return fault("{layer}: {count} lines instead of {wanted}", layer=layer, count=len(found), wanted=len(wanted))

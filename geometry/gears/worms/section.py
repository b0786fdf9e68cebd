"""The section of a worm across its axis, in which a line of the axial section is r exp(-i z / p)."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.polynomial import Chebyshev
from numpy.typing import ArrayLike

from geometry.base.both import both
from geometry.base.record import Record
from geometry.curves.curve import Complex, Curve, Span
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc
from geometry.gears.worms.flank import InvoluteFlank
from geometry.gears.worms.thread import FlankLine, Part, SectionLine, Thread, line_step
from geometry.plane.profile import Label, Profile, Segment

# of the series that gives higher derivatives
_TERMS = 48
_LABELS: dict[Part, Label] = {
    "fillet": Label.ROOT_FILLET, "radial": Label.FLANK, "flank": Label.FLANK, "rounding": Label.TIP_BREAK,
}  # fmt: skip


class TransverseLine(Span, Record):
    """A line of the axial section carried into the plane z = 0; ``parameter`` p, mm per rad.

    Points and the first derivative are exact; higher ones are those of a Chebyshev series of the first.
    """

    line: SectionLine
    parameter: float
    start: float
    end: float

    def point(self, t: ArrayLike) -> Complex:
        place = self.line.point(t)
        return np.asarray(place.real * np.exp(-1j * place.imag / self.parameter))

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        if order > 1:
            real, imag = (part.deriv(order - 1)(np.asarray(t, float)) for part in _series(self))
            return np.asarray(real + 1j * imag)
        place, step = self.line.point(t), line_step(self.line, t)
        turned = step.real - 1j * place.real * step.imag / self.parameter
        return np.asarray(turned * np.exp(-1j * place.imag / self.parameter))


@lru_cache(maxsize=32)
def _series(curve: TransverseLine) -> tuple[Chebyshev, Chebyshev]:
    """Of both parts of the first derivative."""
    parts = (lambda t: curve.derivative(t).real, lambda t: curve.derivative(t).imag)
    return both(Chebyshev.interpolate(part, _TERMS, list(curve.domain)) for part in parts)


def _transverse(line: SectionLine, parameter: float) -> Curve:
    """A line of the upper side in the plane z = 0; of ZI the involute that it is."""
    if isinstance(line, FlankLine) and isinstance(line.worm.flank, InvoluteFlank):
        base = line.worm.flank.least_radius
        low, high = (t / base for t in line.domain)
        turned = -float(line.worm.half_thickness(base)) / parameter
        return Involute(base, turned, low, high)
    return TransverseLine(line, parameter, *line.domain)


def transverse_profile(thread: Thread) -> Profile:
    """The boundary of the section across the axis, through the middle of a thread on +x, either hand."""
    worm, p = thread.worm, thread.worm.parameter
    side = [Segment(_transverse(line, p), _LABELS[name]) for name, line in thread.lines]
    tip, root = thread.tip_half / p, thread.root_half / p
    land = Arc(0j, worm.tip_radius, -tip, 2 * tip)
    floor = Arc(0j, worm.root_radius, root, math.tau / worm.number_of_starts - 2 * root)
    other = [Segment(s.curve.mirrored(), s.label) for s in reversed(side)]
    return Profile(
        (*side, Segment(land, Label.TIP_LAND), *other, Segment(floor, Label.ROOT_LAND)), worm.number_of_starts
    )

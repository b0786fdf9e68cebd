"""The thread of a worm with its corners: the lines of its axial section that the screw carries, points and normals.

The axial section is a plane of r + iz, mm. The upper side of the thread about z = 0 is a chain of lines from the root
to the tip: fillet (an arc that touches root and flank), a radial line where the flank begins above the fillet, the
flank, the rounding of the tip (an arc that touches flank and tip). The lower side is its image under half a turn about
x, and thread j of n stands turned by 2 pi j / n.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc, Line
from geometry.gears.worms.flank import InvoluteFlank
from geometry.gears.worms.worm import LEAST_LAND, Worm

Part = Literal["fillet", "radial", "flank", "rounding"]
# how much larger a diameter quotient is tried
_WIDER = (1.25, 1.5, 2.0, 3.0, 5.0, 10.0)


class FlankLine(Record):
    """A flank in the axial section; its parameter t = sqrt(r^2 - least radius^2), mm, is smooth at its very start."""

    worm: Worm
    domain: tuple[float, float]

    def radius(self, t: ArrayLike) -> Real:
        """Radii, mm."""
        return np.hypot(np.asarray(t, float), self.worm.flank.least_radius)

    def point(self, t: ArrayLike) -> Complex:
        """r + iz, mm."""
        radius = self.radius(t)
        return radius + 1j * self.worm.half_thickness(radius)

    def tangent(self, t: ArrayLike) -> Complex:
        """Unit tangent, outwards."""
        way = 1 - 1j * self.worm.flank.slope(self.radius(t))
        return np.asarray(way / np.abs(way))


SectionLine: TypeAlias = Arc | Line | FlankLine


def line_step(line: SectionLine, t: ArrayLike) -> Complex:
    """Derivative of a line of the axial section by its parameter, mm per unit of it."""
    if isinstance(line, Arc | Line):
        return line.derivative(t)
    slope = line.worm.flank.slope(line.radius(t))
    return np.asarray(np.asarray(t, float) / line.radius(t) * (1 - 1j * slope))


def line_offset(line: SectionLine, place: Complex) -> tuple[Real, Complex]:
    """How far places of the axial section lie from a line that goes on beyond its ends, mm, and its unit normals."""
    if isinstance(line, Arc):
        spoke = place - line.centre
        return np.abs(spoke) - line.radius, spoke / np.abs(spoke)
    if isinstance(line, Line):
        return place.imag - line.start.imag, np.full(place.shape, 1j)
    worm = line.worm
    inside = np.maximum(place.real, worm.flank.least_radius * (1 + 1e-12))
    slope = worm.flank.slope(inside)
    normal = (slope + 1j) / np.hypot(1.0, slope)
    return (place.imag - worm.half_thickness(inside)) / np.hypot(1.0, slope), np.asarray(normal)


class Thread(Record):
    """A worm with the corners of its thread; ``tip_rounding``: radius of the arc in the axial section, mm.

    ``lines``: of the upper side from the root on, by what each is; ``root_half`` and ``tip_half``: z at which the side
    leaves the root and reaches the tip, mm.
    """

    worm: Worm
    tip_rounding: float
    lines: tuple[tuple[Part, SectionLine], ...]
    root_half: float
    tip_half: float

    def normals(
        self, plane: Complex, tangent: Complex, theta: ArrayLike, *, upper: bool = True, start: int = 0
    ) -> Real:
        """Unit normals (..., 3) out of the material; ``tangent`` in the axial section, from the root to the tip."""
        worm = self.worm
        side = 1 if upper else -1
        angle = np.asarray(theta, float)
        turned = np.exp(1j * worm.sign * (side * angle + start * math.tau / worm.number_of_starts))
        r, way = plane.real, tangent
        # outwards -r z', around -p r', upwards r r'
        flat = (-r * way.imag - 1j * worm.sign * side * worm.parameter * way.real) * turned
        found = np.stack(np.broadcast_arrays(flat.real, flat.imag, side * r * way.real), axis=-1)
        return np.asarray(found / np.linalg.norm(found, axis=-1, keepdims=True))


def thread_of(worm: Worm, tip_rounding: float = 0.0) -> Thread:
    """The thread of a worm that exists (``Worm.checked``).

    Raises
    ------
    ParameterError
        The spaces close above the root, the flank begins above the fillet without a way down to it, or a corner's arc
        is larger than its room.
    """
    flank, root, tip = worm.flank, worm.root_radius, worm.tip_radius
    fillet, half_pitch = worm.fillet_coefficient * worm.module, math.pi * worm.module / 2
    least = LEAST_LAND * worm.module
    begin = max(root, flank.least_radius)
    if not float(worm.half_thickness(begin)) < half_pitch - least:
        raise _by_quotient(worm, "worm_spaces_closed", lambda w: thread_of(w, tip_rounding))

    def half(radius: float) -> float:
        return float(worm.half_thickness(max(radius, begin)))

    def way(radius: float) -> complex:
        """The tangent, outwards."""
        slope = float(flank.slope(radius)) if radius > begin or begin == root else 0.0
        return complex(1, -slope) / math.hypot(1, slope)

    low, root_half = root, half(root)
    lines: list[tuple[Part, SectionLine]] = []
    if fillet > 0:
        if way(root + fillet).imag > 0:
            # a grinding wheel leaves flanks that lean over their foot
            raise _by_quotient(worm, "worm_flank_above_root", lambda w: thread_of(w, tip_rounding))
        # counted from the root: where the flank leaves radially, the last height is the root to the last digit
        low = root + bracketed_root(lambda h: h - fillet * (1 + way(root + h).imag), 0.0, fillet).value
        tangent = way(low)
        root_half = half(low) + fillet * tangent.real
        if not (low < worm.reference_radius and root_half <= half_pitch - least):
            raise ParameterError(
                "fillet_coefficient", worm.fillet_coefficient, "worm_fillet_too_large",
                lambda: nearest(
                    lambda value: thread_of(replace(worm, fillet_coefficient=value)) is not None,
                    worm.fillet_coefficient, 0.0,
                ),
            )  # fmt: skip
        lines.append(("fillet", _fillet(complex(root + fillet, root_half), complex(low, half(low)))))
    high, tip_half = tip, half(tip)
    rounding: list[tuple[Part, SectionLine]] = []
    if tip_rounding > 0:
        found = _rounding(worm, tip_rounding, low, half, way)
        if found is None:
            raise ParameterError(
                "tip_rounding", tip_rounding, "worm_rounding_too_large",
                lambda: nearest(lambda value: thread_of(worm, value) is not None, tip_rounding, 0.0),
            )  # fmt: skip
        high, arc = found
        tip_half = arc.centre.imag
        rounding.append(("rounding", arc))
    if low < begin:
        # only the involute starts radially, what a huge wheel grinds but nearly so
        if not isinstance(flank, InvoluteFlank):
            raise _by_quotient(worm, "worm_flank_above_root", lambda w: thread_of(w, tip_rounding))
        lines.append(("radial", Line(complex(low, half(begin)), complex(begin, half(begin)))))
    start = math.sqrt(max((max(low, begin) - flank.least_radius) * (max(low, begin) + flank.least_radius), 0.0))
    end = math.sqrt((high - flank.least_radius) * (high + flank.least_radius))
    lines.append(("flank", FlankLine(worm, (start, end))))
    return Thread(worm, tip_rounding, (*lines, *rounding), root_half, tip_half)


def _rounding(
    worm: Worm, radius: float, low: float, half: Callable[[float], float], way: Callable[[float], complex]
) -> tuple[float, Arc] | None:
    """The radius, mm, at which the flank ends at the tip's arc, and that arc; None where there is no room for it.

    ``radius`` of the arc, ``low``: at which the flank begins, mm; ``half`` thickness, mm, ``way`` of it at a radius.
    """
    tip = worm.tip_radius

    def beyond(r: float) -> float:
        return r - tip + radius * (1 + way(r).imag)

    lowest = max(low, tip - radius)
    if not beyond(lowest) < 0:
        return None
    high = bracketed_root(beyond, lowest, tip).value
    centre = complex(tip - radius, half(high) - radius * way(high).real)
    if not (high > worm.reference_radius and centre.imag >= LEAST_LAND * worm.module):
        return None
    spoke = math.atan2(half(high) - centre.imag, high - centre.real)
    return high, Arc(centre, radius, spoke, -spoke)


def _fillet(centre: complex, end: complex) -> Arc:
    """The fillet from the root, where it runs along -z, to its end on the flank; it turns left."""
    return Arc(centre, abs(end - centre), math.pi, (cmath.phase(end - centre) - math.pi) % math.tau)


def _by_quotient(worm: Worm, code: str, made: Callable[[Worm], Thread]) -> ParameterError:
    given = worm.diameter_quotient

    def works(value: float) -> bool:
        return made(replace(worm, diameter_quotient=value).checked()) is not None

    cure = lambda: nearest(works, given, [given * share for share in _WIDER])  # noqa: E731
    return ParameterError("diameter_quotient", given, code, cure)

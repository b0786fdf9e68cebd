"""A closed centrode by its arc length: points, directions and curvature in which a rack's pitch line rolls on it.

With c(s) by arc length, T = c' and T' = i kappa T, everything that a rack cuts is a short formula of s
(noncircular_curves.py). Angle, point, direction and curvature at an arc length come from a table of Chebyshev
polynomials, good to rounding; higher derivatives are exact Taylor arithmetic at that angle.
"""

from __future__ import annotations

import math
from collections.abc import Hashable
from functools import cached_property, lru_cache
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.base.series import (
    Series,
    composed,
    derived,
    exponential,
    majorant_power,
    power,
    product,
    quotient,
    sharpened,
)
from geometry.curves.curve import Complex, Real
from geometry.kinematics.centrodes import BoundedCentrode

_NODES = 16
# panels of a turn, and of a lobe, to begin with, and the most of a lobe
_FIRST_PANELS, _LEAST_PANELS, _MOST_PANELS = 64, 8, 8192
# the last coefficients of the polynomials are below this part of the largest value; of the curvature and its slope
_TAIL, _CURVATURE_TAIL, _SLOPE_TAIL = 4e-15, 1e-13, 1e-11
# where more panels no longer help, rounding is left: up to this
_ROUNDING_TAIL = 1e-11
# columns of the table
_PARAMETER, _ANGLE, _X, _Y, _DIRECTION, _CURVATURE, _SLOPE = range(7)
_NEWTON_STEPS = 6
_ORDERS = np.arange(float(_NODES))
# of fewer places than these cosines are found sooner than a recurrence
_MANY = 200
# places that are looked up together: the coefficients of more leave the processor's caches
_BLOCK = 4096
# pieces of a panel on which derivatives are bounded, and up to which order
_PIECES, _MOST_ORDER = 4, 6


class PolarShape(Hashable, Protocol):
    """A closed curve R(t) exp(i Theta(t)), t from 0 to ``period`` for one turn, counter-clockwise."""

    @property
    def period(self) -> float:
        """Parameter of a whole turn."""

    def polar(self, t: Real, order: int) -> tuple[Series, Series]:
        """Taylor coefficients of R and of Theta', mm and 1."""

    def polar_bound(self, order: int, a: Real, b: Real) -> tuple[Series, Series]:
        """Bounds of the moduli of both on each interval."""


class DriverShape(Record):
    """The first centrode in its own frame: the driver turns counter-clockwise, so it stands at the angle -phi_1."""

    centrode: BoundedCentrode

    @property
    def period(self) -> float:
        """One turn."""
        return 2 * math.pi

    def polar(self, t: Real, order: int) -> tuple[Series, Series]:
        """R = r(-t), Theta = t."""
        radius = self.centrode.series(-np.asarray(t, dtype=float), order)
        one = np.ones(np.shape(t))
        return [(-1) ** k * x for k, x in enumerate(radius)], [one, *([0.0 * one] * order)]

    def polar_bound(self, order: int, a: Real, b: Real) -> tuple[Series, Series]:
        """Bounds."""
        one = np.ones(np.shape(a))
        return self.centrode.series_bound(order, -b, -a), [one, *([0.0 * one] * order)]


class MateShape(Record):
    """The centrode that rolls on the first one at a centre distance: R = A - r, Theta' = r/(A - r), over phi_1.

    Its frame has the contact of phi_1 = 0 on +x. ``period``: phi_1 of one turn of the mate.
    """

    centrode: BoundedCentrode
    centre_distance: float
    period: float

    def polar(self, t: Real, order: int) -> tuple[Series, Series]:
        """R and Theta'."""
        radius = self.centrode.series(np.asarray(t, dtype=float), order)
        rest = [self.centre_distance - radius[0], *(-x for x in radius[1:])]
        return rest, quotient(radius, rest)

    def polar_bound(self, order: int, a: Real, b: Real) -> tuple[Series, Series]:
        """Bounds: Theta' = A/(A - r) - 1."""
        radius = self.centrode.series_bound(order, a, b)
        middle = self.centrode.series((a + b) / 2, 0)[0]
        half = (b - a) / 2
        inner = self.centrode.series_bound(1, a, b)[1] if order == 0 else radius[1]
        with np.errstate(divide="ignore", invalid="ignore"):
            least = self.centre_distance - middle - half * inner
            turned = [self.centre_distance * x for x in majorant_power(least, radius[1:], -1.0)]
            turned = [np.where(least > 0, x, math.inf) for x in turned]
        rest = [self.centre_distance - middle + half * inner, *radius[1:]]
        return rest, turned


class _Table(Record):
    """Panels of one lobe in arc length with Chebyshev coefficients (panels, 7, 16) of the columns named above."""

    edges: Real
    values: Real


class PitchLine(Record, eq=False, dict=True):
    """A closed centrode over its arc length s, mm, counter-clockwise from its angle 0; periodic in s.

    ``lobes``: it is the same after each 1/lobes of a turn. ``mirrored``: it is its own mirror image in the x axis.
    """

    shape: PolarShape
    lobes: int = 1
    mirrored: bool = False

    @property
    def length(self) -> float:
        """The perimeter, mm."""
        return float(self._table.edges[-1]) * self.lobes

    @cached_property
    def _table(self) -> _Table:
        return _table_of(self.shape, self.lobes)

    def _looked_up(self, s: Real, first: int, last: int) -> tuple[Real, Real]:
        """Columns ``first`` up to ``last`` (the last axis) at arc lengths, and the whole lobes before them."""
        if s.size > _BLOCK:
            parts = [self._looked_up(part, first, last) for part in np.array_split(s.ravel(), -(-s.size // _BLOCK))]
            found, before = (np.concatenate(rows) for rows in zip(*parts, strict=True))
            return found.reshape(*s.shape, -1), before.reshape(s.shape)
        table = self._table
        before = np.floor(s / table.edges[-1])
        rest = s - before * table.edges[-1]
        panel = np.minimum(table.edges.searchsorted(rest, side="right") - 1, len(table.edges) - 2)
        low, high = table.edges[panel], table.edges[panel + 1]
        x = np.maximum(np.minimum(2 * (rest - low) / (high - low) - 1, 1.0), -1.0)
        return np.matmul(table.values[panel, first:last], _polynomials(x)[..., None])[..., 0], before

    def _parameters(self, s: Real) -> tuple[Real, Real]:
        """Parameter t and angle Theta at arc lengths."""
        found, before = self._looked_up(s, _PARAMETER, _ANGLE + 1)
        return (
            found[..., 0] + before * (self.shape.period / self.lobes),
            found[..., 1] + before * (2 * math.pi / self.lobes),
        )

    def angle(self, s: ArrayLike) -> Real:
        """Polar angle at arc lengths, rad, continuous."""
        return self._parameters(np.asarray(s, dtype=float))[1]

    def arc_at_angle(self, angle: float) -> float:
        """Arc length at a polar angle, rad."""
        turns = math.floor(angle / (2 * math.pi))
        rest = angle - turns * 2 * math.pi
        low, high = 0.0, self.length
        s = self.length * rest / (2 * math.pi)
        for _ in range(100):
            off = float(self.angle(s)) - rest
            low, high = (low, s) if off > 0 else (s, high)
            at = np.asarray(s)
            radius, rate = self.shape.polar(self._parameters(at)[0], 1)
            step = off * math.hypot(float(radius[1]), float(radius[0] * rate[0])) / float(rate[0])
            following = s - step if low <= s - step <= high else (low + high) / 2
            if abs(following - s) <= 1e-15 * self.length:
                break
            s = following
        return s + turns * self.length

    def series(self, s: ArrayLike, order: int) -> Series:
        """Taylor coefficients of c over the arc length."""
        t, angle = self._parameters(np.asarray(s, dtype=float))
        radius, rate = self.shape.polar(t, max(order, 1))
        return _by_arc_length(radius, rate, np.exp(1j * angle), order)

    def frame(self, s: ArrayLike) -> tuple[Complex, Complex, Real]:
        """c, T and the curvature kappa."""
        return self.frame_and_slope(s)[:3]

    def frame_and_slope(self, s: ArrayLike) -> tuple[Complex, Complex, Real, Real]:
        """c, T, the curvature kappa and d kappa / d s."""
        found, before = self._looked_up(np.asarray(s, dtype=float), _X, _SLOPE + 1)
        point, direction = found[..., 0] + 1j * found[..., 1], found[..., 2]
        if self.lobes > 1:
            turn = before % self.lobes * (2 * math.pi / self.lobes)
            point, direction = point * np.exp(1j * turn), direction + turn
        return point, np.exp(1j * direction), found[..., 3], found[..., 4]

    def curvature(self, s: ArrayLike) -> Real:
        """Curvature, 1/mm: positive where convex."""
        return self._looked_up(np.asarray(s, dtype=float), _CURVATURE, _CURVATURE + 1)[0][..., 0]

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of the moduli of the Taylor coefficients of c on each interval [a, b] of arc length, up to order 6.

        They are those of the pieces of the centrode that the interval touches.
        """
        edges, bounds = self._piece_bounds
        pieces = len(edges) - 1
        # the rounding of an arc length does not hide a piece
        slack = 1e-12 * edges[-1]
        first, last = (_piece_at(edges, np.ravel(s) + k * slack) for s, k in ((a, -1), (b, 1)))
        # neighbours of the first piece, all intervals at once; longer ones see the whole centrode
        last = np.minimum(last, first + pieces - 1)
        found = bounds[: order + 1, first % pieces]
        for step in range(1, int((last - first).max(initial=0)) + 1):
            found = np.maximum(found, bounds[: order + 1, np.minimum(first + step, last) % pieces])
        return [x.reshape(np.shape(a)) for x in found]

    @cached_property
    def _piece_bounds(self) -> tuple[Real, Real]:
        """Edges of even pieces of the table's panels, and the bounds of coefficients 0 to 6 on each, (7, pieces)."""
        panels = self._table.edges
        inner = panels[:-1, None] + np.diff(panels)[:, None] * (np.arange(_PIECES) / _PIECES)
        edges = np.append(inner.ravel(), panels[-1])
        return edges, np.array(self._bounds_on(_MOST_ORDER, edges[:-1], edges[1:]))

    def _bounds_on(self, order: int, a: Real, b: Real) -> Series:
        """Bounds on each interval within one lobe, by Taylor arithmetic on bounds."""
        low, high = self._parameters(a)[0], self._parameters(b)[0]
        # the table's rounding
        slack = 1e-13 * self.shape.period
        low, high = low - slack, high + slack
        half = (high - low) / 2
        radius, rate = self.shape.polar_bound(order + 1, low, high)
        at = self.shape.polar((low + high) / 2, order + 1)
        radius, rate = sharpened(radius, at[0], half), sharpened(rate, at[1], half)
        square = _speed_square(radius, rate)
        exact = _speed_square(*at)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            least = exact[0] - half * square[1]
            slow = majorant_power(least, square[1 : order + 1], -0.5)
            found = _along(radius, rate, slow, np.ones(np.shape(low)), order, 1.0)
        found[0] = np.abs(found[0])
        if order:
            found[1] = np.ones(np.shape(low))
        return [np.where((least > 0) & np.isfinite(x), x, math.inf) for x in found]


def _polynomials(x: Real) -> Real:
    """Chebyshev polynomials T_0 to T_15 at places in [-1, 1], on the last axis: many by T_k+1 = 2 x T_k - T_k-1."""
    if x.size < _MANY:
        return np.asarray(np.cos(np.arccos(x)[..., None] * _ORDERS))
    found = np.empty((_NODES, *x.shape))
    found[0], found[1], twice = 1.0, x, 2 * x
    for k in range(2, _NODES):
        np.multiply(twice, found[k - 1], out=found[k])
        found[k] -= found[k - 2]
    return np.moveaxis(found, 0, -1)


def _piece_at(edges: Real, s: Real) -> NDArray[np.int64]:
    """Number of the piece at arc lengths; it goes on counting from lobe to lobe."""
    before = np.floor(s / edges[-1])
    inside = np.clip(edges.searchsorted(s - before * edges[-1], side="right") - 1, 0, len(edges) - 2)
    return np.asarray(inside + (before * (len(edges) - 1)).astype(np.int64))


def _speed_square(radius: Series, rate: Series) -> Series:
    """R'^2 + (R Theta')^2, one order less than R has."""
    slope, turned = derived(radius), product(radius, rate)
    return [x + y for x, y in zip(product(slope, slope), product(turned, turned), strict=False)]


def _by_arc_length(radius: Series, rate: Series, turn: Complex | Real, order: int) -> Series:
    """Taylor coefficients over the arc length of R exp(i Theta) from those of R and Theta' over t."""
    slow = power(_speed_square(radius, rate), -0.5)
    return _along(radius, rate, slow, turn, order, 1j)


def _along(radius: Series, rate: Series, slow: Series, turn: Complex | Real, order: int, unit: complex) -> Series:
    """R exp(Theta unit) over s, where dt/ds = ``slow``(t); with ``unit`` 1 and bounds for all else, its bounds."""
    zero = 0.0 * radius[0]
    step: Series = [zero]
    for k in range(order):
        step.append(composed(slow[: k + 1], step)[k] / (k + 1))
    angle = composed([zero, *(unit * x / (k + 1) for k, x in enumerate(rate[:order]))], step)
    spread = exponential(angle)
    return product([turn * x for x in spread], composed(radius[: order + 1], step))


@lru_cache(maxsize=16)
def _table_of(shape: PolarShape, lobes: int) -> _Table:
    """The table of a shape: both gears of a pair, and every trial of another key of one, share theirs."""
    edges = np.linspace(0, shape.period / lobes, max(_FIRST_PANELS // lobes, _LEAST_PANELS) + 1)
    # what the last coefficients were before a panel was halved
    before = np.full(len(edges) - 1, math.inf)
    while len(edges) <= _MOST_PANELS + 1:
        table, tails = _tabulated(shape, edges, 2 * math.pi / lobes)
        wide = (tails > _TAIL) & ((tails >= _ROUNDING_TAIL) | (tails <= before / 4))
        if not wide.any():
            table.edges.flags.writeable = table.values.flags.writeable = False
            return table
        halves = np.where(wide, 2, 1)
        before = np.repeat(np.where(wide, tails, before), halves)
        edges = np.sort(np.concatenate([edges, (edges[:-1] + edges[1:])[wide] / 2]))
    raise ConvergenceError("arc length of the centrode", float(tails.max()), len(edges) - 1)


def _tabulated(shape: PolarShape, edges: Real, whole: float) -> tuple[_Table, Real]:
    """The table of panels of the parameter, over all of which the angle grows by ``whole``, and how large the last
    coefficients of each are left."""
    x = np.cos(math.pi * (np.arange(_NODES) + 0.5) / _NODES)
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    half = np.diff(edges) / 2

    def integrals(start: Real, width: Real) -> tuple[Real, Real, Real]:
        """Arc length and angle over [start, start + width], and the speed at its end."""
        t = start[..., None] + width[..., None] * (nodes + 1) / 2
        radius, rate = shape.polar(t, 1)
        speed = np.sqrt(radius[1] ** 2 + (radius[0] * rate[0]) ** 2)
        end_radius, end_rate = shape.polar(start + width, 1)
        end = np.sqrt(end_radius[1] ** 2 + (end_radius[0] * end_rate[0]) ** 2)
        return np.sum(speed * weights, axis=-1) * width / 2, np.sum(rate[0] * weights, axis=-1) * width / 2, end

    lengths, angles, _ = integrals(edges[:-1], 2 * half)
    arc = np.concatenate([[0.0], np.cumsum(lengths)])
    start = np.concatenate([[0.0], np.cumsum(angles)])
    # the parameter at Chebyshev's nodes in arc length
    wanted = lengths[:, None] * (x + 1) / 2
    low = np.broadcast_to(edges[:-1, None], wanted.shape)
    width = 2 * half[:, None] * (x + 1) / 2
    for _ in range(_NEWTON_STEPS):
        length, _, speed = integrals(low, width)
        width = np.clip(width - (length - wanted) / speed, 0.0, 2 * half[:, None])
    turned = integrals(low, width)[1]
    angle = np.broadcast_to(start[:-1, None], turned.shape) * (whole / start[-1]) + turned
    columns = np.stack([low + width, angle, *_columns(shape, low + width, angle)], axis=1)
    cosines = np.cos(np.outer(np.arange(_NODES), math.pi * (np.arange(_NODES) + 0.5) / _NODES)) * 2 / _NODES
    cosines[0] /= 2
    values = columns @ cosines.T
    size = np.abs(columns).max(axis=(0, 2))
    tails = np.abs(values[:, :, -2:]).max(axis=2) / np.where(size > 0, size, 1.0)
    tails[:, _CURVATURE] *= _TAIL / _CURVATURE_TAIL
    tails[:, _SLOPE] *= _TAIL / _SLOPE_TAIL
    # a straight or a round centrode has no slope but for rounding
    if size[_SLOPE] <= 1e-11 * size[_CURVATURE] / arc[-1]:
        tails[:, _SLOPE] = 0.0
    return _Table(arc, values), tails.max(axis=1)


def _columns(shape: PolarShape, t: Real, angle: Real) -> tuple[Real, ...]:
    """x, y, the direction of T, kappa and its slope at parameters."""
    radius, rate = shape.polar(t, 3)
    # about the angle, where T is near i
    found = _by_arc_length(radius, rate, np.ones(np.shape(t)), 3)
    first, second = derived(found), derived(derived(found))
    bend = product([np.conj(x) for x in first], second)
    point = found[0] * np.exp(1j * angle)
    return point.real, point.imag, angle + np.angle(first[0]), bend[0].imag, bend[1].imag

"""What every exact plane curve can do, and what follows from any curve: reversed, carried, mirrored, parallel.

A plane point is a complex number x + iy, mm.
"""

from __future__ import annotations

import cmath
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar, Self, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.base.errors import CuspError
from geometry.base.placement import Placement2
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.base.series import FACTORIALS, Series, unit

if TYPE_CHECKING:
    from dataclasses import Field

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]
Flags = NDArray[np.bool_]
Indices = NDArray[np.intp]

_CUSP_SAMPLES = 257
_NO_KNOTS: Real = np.zeros(0)


class Curve:
    """Regular plane arc c: [t0, t1] -> C. Immutable; ``t`` is the class's own parameter.

    All methods are vectorised over ``t``. Curvature is positive where the curve turns left
    (counter-clockwise); the normal is the tangent turned by +90 degrees, so an offset d > 0 goes left.

    A kind of curve gives ``domain``, ``point``, ``derivative`` and ``trimmed``; it overrides the rest where its own
    formula knows better: a tangent that holds at a cusp, a proven bound, a parallel or an image of its own kind.
    """

    __slots__ = ()
    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]
    # numbers that may be a column each, of many curves that are asked together
    columns: ClassVar[tuple[str, ...]] = ()

    @property
    def domain(self) -> tuple[float, float]:
        """Parameter interval [t0, t1], t0 < t1."""
        raise NotImplementedError

    def point(self, t: ArrayLike) -> Complex:
        """Exact points, mm."""
        raise NotImplementedError

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        """Exact derivative of the given order (1 to 4), mm per parameter unit to that power."""
        raise NotImplementedError

    def tangent(self, t: ArrayLike) -> Complex:
        """Unit tangent in the direction of travel; at a cusp its limit from inside the domain."""
        first = self.derivative(t)
        return first / np.abs(first)

    def derivatives(self, t: ArrayLike, order: int) -> list[Complex]:
        """Points and derivatives up to ``order``, each of the shape of ``t``: one evaluation where one gives all."""
        return [self.point(t), *(self.derivative(t, k) for k in range(1, order + 1))]

    def curvature(self, t: ArrayLike) -> Real:
        """Signed curvature, 1/mm."""
        return curvature_from_derivatives(self.derivative(t), self.derivative(t, 2))

    def derivative_bound(self, order: int, a: float, b: float) -> float | None:
        """Proven upper bound of |c^(order)| on [a, b]; None where none is known."""
        return None

    def derivative_bounds(self, edges: Real, orders: Sequence[int]) -> Real:
        """Proven bounds of |c^(k)|, k in ``orders``, between neighbouring ``edges``: (len(orders), n - 1).

        inf where none is known.
        """
        found = [[self.derivative_bound(k, a, b) for a, b in pairwise(edges.tolist())] for k in orders]
        return np.array([[np.inf if x is None else x for x in row] for row in found])

    @property
    def knots(self) -> Real:
        """Rising parameters within the domain at which one formula gives way to the next: the curve is C2 there."""
        return _NO_KNOTS

    @property
    def alike(self) -> object:
        """What curves that differ in their columns alone have in common; None where each stands alone."""
        return type(self) if self.columns else None

    def together(self, curves: Sequence[Curve]) -> Curve:
        """Curves alike as one of columns, which is asked by ``taken`` only."""
        return replace(self, **{name: np.array([getattr(c, name) for c in curves]) for name in self.columns})

    def taken(self, which: Indices) -> Curve:
        """Of curves together, that one which each parameter is asked of."""
        return replace(self, **{name: getattr(self, name)[which] for name in self.columns})

    def joined(self, after: Curve) -> Curve | None:
        """This curve and one that goes on from it, as one; None where they are not of one formula or spline."""
        return None

    def parts(self) -> tuple[Curve, ...]:
        """The curve cut at its knots, and there so that the curvature of each part keeps its sign and its trend."""
        return (self,)

    def offset(self, distance: float) -> Curve:
        """Parallel curve, ``distance`` mm to the left. Raises CuspError where it would turn back."""
        return OffsetCurve(self, distance).checked()

    def trimmed(self, a: float, b: float) -> Curve:
        """The part between parameters a < b."""
        raise NotImplementedError

    def reversed(self) -> Curve:
        """The same points travelled the other way."""
        return Reversed(self)

    def placed(self, placement: Placement2) -> Curve:
        """The curve carried by a rigid motion."""
        return Carried(self, placement)

    def mirrored(self) -> Curve:
        """Mirror image in the x axis, travelled the other way: material stays on the same side."""
        return Mirrored(self)


class Span(Curve):
    """A record with ``start`` and ``end``: the ends of the stretch of its formula that it shows."""

    __slots__ = ()
    start: float
    end: float

    @property
    def domain(self) -> tuple[float, float]:
        return self.start, self.end

    def trimmed(self, a: float, b: float) -> Self:
        check_interval(self.domain, a, b)
        return replace(self, start=a, end=b)


class SeriesSpan(Span):
    """A curve that gives its Taylor series."""

    __slots__ = ()

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients 0 to ``order`` at ``t``."""
        raise NotImplementedError

    def point(self, t: ArrayLike) -> Complex:
        return self.series(t, 0)[0]

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        return FACTORIALS[order] * self.series(t, order)[order]

    def derivatives(self, t: ArrayLike, order: int) -> list[Complex]:
        return [FACTORIALS[k] * x for k, x in enumerate(self.series(t, order))]


class Image(Curve):
    """What ``base`` becomes as it is carried, mirrored or travelled backwards; t is ``way`` times the base's parameter.

    ``bends``: -1 where left and right of the base change places.
    """

    __slots__ = ()
    base: Curve
    way: ClassVar[int] = -1
    bends: ClassVar[int] = 1

    def _points(self, points: Complex) -> Complex:
        """Where points of the base come to."""
        return points

    def _vectors(self, vectors: Complex) -> Complex:
        """Where directions of the base come to."""
        return self._points(vectors)

    @property
    def alike(self) -> object:
        """What the bases have in common, carried the same way."""
        own = self.base.alike
        return own and (type(self), own)

    def together(self, curves: Sequence[Curve]) -> Self:
        return replace(self, base=self.base.together([cast("Self", c).base for c in curves]))

    def taken(self, which: Indices) -> Self:
        return replace(self, base=self.base.taken(which))

    def _at(self, t: ArrayLike) -> ArrayLike:
        return t if self.way > 0 else -np.asarray(t, dtype=float)

    def _between(self, a: float, b: float) -> tuple[float, float]:
        return (a, b) if self.way > 0 else (-b, -a)

    @property
    def domain(self) -> tuple[float, float]:
        return self._between(*self.base.domain)

    def point(self, t: ArrayLike) -> Complex:
        return self._points(self.base.point(self._at(t)))

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        found = self._vectors(self.base.derivative(self._at(t), order))
        return found if self.way > 0 else (-1) ** order * found

    def derivatives(self, t: ArrayLike, order: int) -> list[Complex]:
        point, *others = self.base.derivatives(self._at(t), order)
        return [self._points(point), *(self.way**k * self._vectors(x) for k, x in enumerate(others, 1))]

    def tangent(self, t: ArrayLike) -> Complex:
        found = self._vectors(self.base.tangent(self._at(t)))
        return found if self.way > 0 else -found

    def curvature(self, t: ArrayLike) -> Real:
        return self.bends * self.base.curvature(self._at(t))

    def derivative_bound(self, order: int, a: float, b: float) -> float | None:
        return self.base.derivative_bound(order, *self._between(a, b))

    def derivative_bounds(self, edges: Real, orders: Sequence[int]) -> Real:
        return self.base.derivative_bounds((self.way * edges)[:: self.way], orders)[:, :: self.way]

    @property
    def knots(self) -> Real:
        return (self.way * self.base.knots)[:: self.way]

    def parts(self) -> tuple[Curve, ...]:
        return tuple(replace(self, base=x) for x in self.base.parts()[:: self.way])

    def offset(self, distance: float) -> Self:
        try:
            return replace(self, base=self.base.offset(self.bends * distance))
        except CuspError as cusp:
            raise CuspError(self.way * cusp.t, distance) from None

    def trimmed(self, a: float, b: float) -> Self:
        return replace(self, base=self.base.trimmed(*self._between(a, b)))


class Reversed(Image, Record):
    """A curve travelled backwards."""

    base: Curve
    bends = -1

    @property
    def family(self) -> object:
        """That of the curve itself, the other way."""
        own = getattr(self.base, "family", None)
        return own and (Reversed, own)

    def joined(self, after: Curve) -> Curve | None:
        whole = after.base.joined(self.base) if isinstance(after, Reversed) else None
        return None if whole is None else Reversed(whole)

    def reversed(self) -> Curve:
        return self.base

    def placed(self, placement: Placement2) -> Curve:
        return Reversed(self.base.placed(placement))

    def mirrored(self) -> Curve:
        return Reversed(self.base.mirrored())


class Carried(Image, Record):
    """``base`` turned and moved by ``placement``; parameter, speed and curvature are its own."""

    base: Curve
    placement: Placement2
    way = 1

    @property
    def alike(self) -> object:
        own = self.base.alike
        return own and (Carried, own, self.placement)

    def _points(self, points: Complex) -> Complex:
        return self.placement.apply(points)

    def _vectors(self, vectors: Complex) -> Complex:
        return cmath.exp(1j * self.placement.angle) * vectors

    def placed(self, placement: Placement2) -> Curve:
        return Carried(self.base, placement @ self.placement)

    def mirrored(self) -> Curve:
        return Carried(self.base.mirrored(), self.placement.mirrored())


class Mirrored(Image, Record):
    """Mirror image of ``base`` in the x axis, travelled the other way: its curvature stays, for both turn the sign."""

    base: Curve

    def _points(self, points: Complex) -> Complex:
        return np.conj(points)

    def mirrored(self) -> Curve:
        return self.base


class OffsetCurve(Curve, Record):
    """c(t) + d n(t), d mm to the left of ``base``, whose derivatives must reach one order further.

    No bound is proven for a general parallel curve.
    """

    base: Curve
    distance: float

    @property
    def domain(self) -> tuple[float, float]:
        return self.base.domain

    def point(self, t: ArrayLike) -> Complex:
        return self.base.point(t) + 1j * self.distance * self.base.tangent(t)

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        """Taylor arithmetic: n = i c' / sqrt(c' conj(c'))."""
        first = [self.base.derivative(t, k + 1) / FACTORIALS[k] for k in range(order + 1)]
        return self.base.derivative(t, order) + 1j * self.distance * FACTORIALS[order] * unit(first)[order]

    def _stretch(self, t: ArrayLike) -> Real:
        return 1 - self.distance * self.base.curvature(t)

    def tangent(self, t: ArrayLike) -> Complex:
        return np.where(self._stretch(t) < 0, -1.0, 1.0) * self.base.tangent(t)

    def checked(self) -> OffsetCurve:
        """This curve, or CuspError where it turns back."""
        cusp = first_turning(self._stretch, np.ones_like, self.domain)
        if cusp is not None:
            raise CuspError(cusp, self.distance)
        return self

    def offset(self, distance: float) -> OffsetCurve:
        try:
            return OffsetCurve(self.base, self.distance + distance).checked()
        except CuspError as cusp:
            raise CuspError(cusp.t, distance) from None

    def trimmed(self, a: float, b: float) -> OffsetCurve:
        return replace(self, base=self.base.trimmed(a, b))

    def placed(self, placement: Placement2) -> OffsetCurve:
        return replace(self, base=self.base.placed(placement))

    def mirrored(self) -> OffsetCurve:
        return replace(self, base=self.base.mirrored())


def vertex_sign(first: Complex, second: Complex, third: Complex) -> Real:
    """Of a curve's derivatives: changes its sign where the curvature is greatest or least."""
    cross = (np.conj(first) * second).imag
    return (np.conj(first) * third).imag * np.abs(first) ** 2 - 3 * cross * (np.conj(first) * second).real


def first_turning(
    after: Callable[[Real], Real], before: Callable[[Real], Real], domain: tuple[float, float]
) -> float | None:
    """First parameter at which an offset curve's speed has another sign than the curve's own; None: nowhere.

    257 samples, and the least ones refined, so that a dip between two samples is seen.
    """
    t = np.linspace(*domain, _CUSP_SAMPLES)

    def ratio(x: Real) -> Real:
        return after(x) * np.sign(before(x))

    values = ratio(t)
    lowest = int(np.argmin(values))
    low, high = t[max(lowest - 1, 0)], t[min(lowest + 1, len(t) - 1)]
    fine = np.linspace(low, high, _CUSP_SAMPLES)
    t = np.sort(np.concatenate([t, fine]))
    turned = np.flatnonzero(ratio(t) <= 0)
    if not turned.size:
        return None
    first = int(turned[0])
    if first == 0:
        return float(t[0])
    low, high = float(t[first - 1]), float(t[first])
    return bracketed_root(lambda x: float(ratio(np.asarray(x))), low, high).value


def start_point(curve: Curve) -> complex:
    """First point of a curve."""
    return complex(curve.point(curve.domain[0]))


def end_point(curve: Curve) -> complex:
    """Last point of a curve."""
    return complex(curve.point(curve.domain[1]))


def at_shares(curve: Curve, shares: Real) -> Real:
    """Parameters at shares of a curve's domain."""
    low, high = curve.domain
    return low + (high - low) * shares


def curvature_from_derivatives(first: Complex, second: Complex) -> Real:
    """Signed curvature from c' and c''."""
    return (np.conj(first) * second).imag / np.abs(first) ** 3


def check_interval(domain: tuple[float, float], a: float, b: float) -> None:
    """Refuse a trim that is empty; trims may extend a curve along its own formula."""
    if not a < b:
        raise ValueError(f"empty parameter interval [{a}, {b}] in domain {domain}")

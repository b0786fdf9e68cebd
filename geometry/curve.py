"""What every exact plane curve can do. A plane point is a complex number x + iy, mm."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from geometry.errors import CuspError
from geometry.placement import Placement2

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]


@runtime_checkable
class Curve(Protocol):
    """Regular plane arc c: [t0, t1] -> C. Immutable; ``t`` is the class's own parameter.

    All methods are vectorised over ``t``. Curvature is positive where the curve turns left
    (counter-clockwise); the normal is the tangent turned by +90 degrees, so an offset d > 0 goes left.
    """

    @property
    def domain(self) -> tuple[float, float]:
        """Parameter interval [t0, t1], t0 < t1."""

    def point(self, t: ArrayLike) -> Complex:
        """Exact points, mm."""

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        """Exact derivative of the given order (1 to 4), mm per parameter unit to that power."""

    def tangent(self, t: ArrayLike) -> Complex:
        """Unit tangent in the direction of travel; at a cusp its limit from inside the domain."""

    def curvature(self, t: ArrayLike) -> Real:
        """Signed curvature, 1/mm."""

    def derivative_bound(self, order: int, a: float, b: float) -> float | None:
        """Proven upper bound of |c^(order)| on [a, b]; None where none is known."""

    def offset(self, distance: float) -> Curve:
        """Parallel curve, ``distance`` mm to the left. Raises CuspError where it would turn back."""

    def trimmed(self, a: float, b: float) -> Curve:
        """The part between parameters a < b."""

    def reversed(self) -> Curve:
        """The same points travelled the other way."""

    def placed(self, placement: Placement2) -> Curve:
        """The curve carried by a rigid motion."""

    def mirrored(self) -> Curve:
        """Mirror image in the x axis, travelled the other way: material stays on the same side."""


@dataclass(frozen=True, slots=True)
class Reversed:
    """A curve travelled backwards: parameter t runs as -t of the original."""

    original: Curve

    @property
    def domain(self) -> tuple[float, float]:
        a, b = self.original.domain
        return -b, -a

    def point(self, t: ArrayLike) -> Complex:
        return self.original.point(-np.asarray(t, dtype=float))

    def derivative(self, t: ArrayLike, order: int = 1) -> Complex:
        return (-1) ** order * self.original.derivative(-np.asarray(t, dtype=float), order)

    def tangent(self, t: ArrayLike) -> Complex:
        return -self.original.tangent(-np.asarray(t, dtype=float))

    def curvature(self, t: ArrayLike) -> Real:
        return -self.original.curvature(-np.asarray(t, dtype=float))

    def derivative_bound(self, order: int, a: float, b: float) -> float | None:
        return self.original.derivative_bound(order, -b, -a)

    def offset(self, distance: float) -> Curve:
        try:
            return Reversed(self.original.offset(-distance))
        except CuspError as cusp:
            raise CuspError(-cusp.t, distance) from None

    def trimmed(self, a: float, b: float) -> Curve:
        return Reversed(self.original.trimmed(-b, -a))

    def reversed(self) -> Curve:
        return self.original

    def placed(self, placement: Placement2) -> Curve:
        return Reversed(self.original.placed(placement))

    def mirrored(self) -> Curve:
        return Reversed(self.original.mirrored())


def start_point(curve: Curve) -> complex:
    """First point of a curve."""
    return complex(curve.point(curve.domain[0]))


def end_point(curve: Curve) -> complex:
    """Last point of a curve."""
    return complex(curve.point(curve.domain[1]))


def curvature_from_derivatives(first: Complex, second: Complex) -> Real:
    """Signed curvature from c' and c''."""
    return (np.conj(first) * second).imag / np.abs(first) ** 3


def check_interval(domain: tuple[float, float], a: float, b: float) -> None:
    """Refuse a trim that is empty; trims may extend a curve along its own formula."""
    if not a < b:
        raise ValueError(f"empty parameter interval [{a}, {b}] in domain {domain}")

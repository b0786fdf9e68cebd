"""What root fillets of all cutters have in common: they turn about a centre, and parallels are of their own kind."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from types import ModuleType
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import CuspError
from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.curve import Complex, Real, Span, first_turning


class TurnedSpan(Span):
    """centre + exp(i angle) f(t) with f(-t) = conj f(t): its images are of its own kind."""

    __slots__ = ()
    angle: float
    centre: complex

    def placed(self, placement: Placement2) -> Self:
        turned = self.angle + placement.angle
        return replace(self, angle=turned, centre=placement.apply(self.centre))

    def mirrored(self) -> Self:
        ends = {"start": -self.end, "end": -self.start}
        return replace(self, angle=-self.angle, centre=self.centre.conjugate(), **ends)


class Fillet(TurnedSpan):
    """Envelope of a cutter's rounded tip; a left offset d only has the ``tip_radius`` rho + d.

    Its parameter u is the angle of the contact normal, rad: 0 at the cutter's tip, negative on the mirror image.
    """

    __slots__ = ()
    tip_radius: float

    def point(self, t: ArrayLike) -> Complex:
        if isinstance(t, float):
            # roots are sought by one number after the other, of which numpy makes ten times as much work
            return np.complex128(self._point(t, math, cmath.exp))
        return np.asarray(self._point(np.asarray(t, dtype=float), np, np.exp))

    def _point(self, u: Any, lib: ModuleType, exp: Callable[[Any], Any]) -> Any:
        """Points at a number by the functions of ``math`` and ``cmath``, at an array by those of numpy."""
        raise NotImplementedError

    def speed(self, t: ArrayLike) -> Real:
        """de/du along the tangent, mm/rad; negative where the curve runs back."""
        raise NotImplementedError

    def turning(self, t: ArrayLike) -> Real:
        """How fast the tangent turns to the right, rad/rad."""
        raise NotImplementedError

    def cusp(self) -> float | None:
        """The first parameter in the domain, by size, at which the speed is not positive; else None."""
        low, high = sorted((abs(self.start), abs(self.end)))
        return first_turning(self.speed, np.ones_like, (0.0 if self.start < 0 < self.end else low, high))

    def curvature(self, t: ArrayLike) -> Real:
        with np.errstate(divide="ignore"):
            return -self.turning(t) / np.abs(self.speed(t))

    def offset(self, distance: float) -> Self:
        moved = replace(self, tip_radius=self.tip_radius + distance)
        cusp = moved.cusp()
        if cusp is not None:
            raise CuspError(cusp, distance)
        return moved

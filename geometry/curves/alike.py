"""Curves that one formula gives, asked together: one call of it in place of one for each curve."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Protocol, cast

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record, replace
from geometry.curves.curve import Complex, Curve, Indices, Real


class Travelled(Protocol):
    """What distances ask of a curve; splines of files give no more."""

    @property
    def domain(self) -> tuple[float, float]:
        """Parameter interval."""

    def point(self, t: ArrayLike) -> Complex:
        """Points, mm."""

    def derivatives(self, t: ArrayLike, order: int) -> list[Complex]:
        """Points and derivatives up to ``order``, mm per parameter unit to that power."""


class Alike(Record, dict=True):
    """Curves that one formula gives, or one alone, with the parameters and places (curves, n) of their samples."""

    curves: Sequence[Travelled]
    # all of them as one, where there are several
    whole: Curve | None
    parameters: Real
    points: Complex

    def of(self, which: Indices) -> Travelled:
        """The curve that each parameter is asked of."""
        return self.curves[0] if self.whole is None else self.whole.taken(which)

    def every(self, ask: Callable[[Travelled, Real], Complex]) -> Complex:
        """What the curves say at their samples (curves, n)."""
        size = self.parameters.shape
        return ask(self.of(np.repeat(np.arange(size[0]), size[1])), self.parameters.ravel()).reshape(size)

    @cached_property
    def ways(self) -> Complex:
        """The first derivatives at the samples (curves, n)."""
        return self.every(lambda curve, t: curve.derivatives(t, 1)[1])


def sampled(curves: Sequence[Travelled], parameters: Real) -> Alike:
    """Curves that are alike at their parameters (curves, n)."""
    whole = None
    if len(curves) > 1:
        first, *_ = alike = cast("Sequence[Curve]", curves)
        whole = first.together(alike)
    group = Alike(curves, whole, parameters, np.empty(0, dtype=complex))
    return replace(group, points=group.every(lambda curve, t: np.asarray(curve.point(t))))


def evenly(curves: Sequence[Travelled], count: int) -> Alike:
    """The same at so many even steps of their domains."""
    low, high = np.array([c.domain for c in curves]).T
    return sampled(curves, np.linspace(low, high, count, axis=1))


def by_formula(curves: Sequence[Curve]) -> list[Indices]:
    """Numbers of the curves, of which those that one formula gives are together."""
    found: dict[object, list[int]] = {}
    for number, curve in enumerate(curves):
        found.setdefault(number if curve.alike is None else curve.alike, []).append(number)
    return [np.array(numbers) for numbers in found.values()]

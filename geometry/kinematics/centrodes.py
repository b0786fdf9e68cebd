"""Noncircular centrodes: two curves that roll on each other about fixed centres, from a radius or a ratio.

Savvin's (4), (5) with zero relative velocity: the common point lies on the line of centres, r_1 + r_2 = A, and
d phi_2 / d phi_1 = r_1 / (A - r_1). Both bodies turn against each other (external pair); phi_1, phi_2 > 0 forwards.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import ParameterError
from geometry.base.gauss import panels
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.base.series import FACTORIALS, Series, majorant_power, power, quotient, sharpened
from geometry.curves.curve import Real
from geometry.kinematics.motion import Pose

_PANELS, _NODES = 64, 16
_SAMPLES = 1025


class PolarCentrode(Protocol):
    """r(phi) of period 2 pi, as a Taylor series."""

    def series(self, angle: Real, order: int) -> Series:
        """Taylor coefficients 0 to ``order`` of the radius, mm."""


class BoundedCentrode(PolarCentrode, Protocol):
    """A centrode whose derivatives are bounded over whole intervals, as curves on it need."""

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of the moduli of the Taylor coefficients on each interval [a, b]."""


class LobedEllipse(Record):
    """r = p/(1 - e cos n phi), n lobes: the focal ellipse (n = 1) and the oval (n = 2) in one; rolls on its equal.

    The centre distance of two equal ones is 2 p/(1 - e^2). Convex where e (n^2 - 1) <= 1.
    """

    parameter: float
    eccentricity: float
    lobes: int = 1

    def series(self, angle: Real, order: int) -> Series:
        """Taylor coefficients of the radius."""
        return [self.parameter * x for x in power(self._under(np.asarray(angle, dtype=float), order), -1.0)]

    def _under(self, angle: Real, order: int) -> Series:
        e, turn = self.eccentricity, self.lobes * angle
        # 1 - e cos n phi without a difference of near numbers: slender ellipses have e near 1
        under = (1 - e) + 2 * e * np.sin(turn / 2) ** 2
        waves = (np.cos(turn + k * math.pi / 2) / FACTORIALS[k] for k in range(1, order + 1))
        return [under, *(-e * self.lobes**k * wave for k, wave in enumerate(waves, 1))]

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of the moduli of the Taylor coefficients on each interval."""
        e, n, half = self.eccentricity, self.lobes, (b - a) / 2
        middle = self._under((a + b) / 2, order + 1)
        crude = [e * n**k / FACTORIALS[k] + 0.0 * half for k in range(order + 2)]
        rest = sharpened(crude, middle, half)[1 : order + 1]
        least = np.maximum(1 - e, middle[0] - half * sharpened(crude, middle, half)[1])
        return [self.parameter * x for x in majorant_power(least, rest, -1.0)]


class FourierRatio(Record):
    """Ratio d phi_2 / d phi_1 = mean (1 + sum a_k cos k n phi + b_k sin k n phi), k from 1, n ``lobes``."""

    mean: float
    cosines: tuple[float, ...] = ()
    sines: tuple[float, ...] = ()
    lobes: int = 1

    def __call__(self, angle: Real, order: int) -> Series:
        """Taylor coefficients of the ratio."""
        angle = np.asarray(angle, dtype=float)
        found: Series = [self.mean + 0.0 * angle, *([0.0 * angle] * order)]
        for shift, values in ((0.0, self.cosines), (math.pi / 2, self.sines)):
            for k, value in enumerate(values, 1):
                n = k * self.lobes
                turn = n * angle - shift
                for j in range(order + 1):
                    wave = n**j / FACTORIALS[j] * np.cos(turn + j * math.pi / 2)
                    found[j] = found[j] + self.mean * value * wave
        return found

    def bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of the moduli of the Taylor coefficients on each interval."""
        zero = 0.0 * np.asarray(a, dtype=float)
        found: Series = [self.mean + zero, *([zero] * order)]
        for values in (self.cosines, self.sines):
            for k, value in enumerate(values, 1):
                for j in range(order + 1):
                    found[j] = found[j] + self.mean * abs(value) * (k * self.lobes) ** j / FACTORIALS[j]
        return found


class RatioCentrode(Record):
    """The centrode of a ratio function d phi_2 / d phi_1 > 0, given as a Taylor series: r = A i/(1 + i)."""

    ratio: Callable[[Real, int], Series]
    centre_distance: float

    def series(self, angle: Real, order: int) -> Series:
        """Taylor coefficients of the radius."""
        ratio = self.ratio(angle, order)
        over = [self.centre_distance * x for x in ratio]
        return quotient(over, [ratio[0] + 1.0, *ratio[1:]])

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of the moduli of the Taylor coefficients on each interval, by r = A - A/(1 + i); of a FourierRatio."""
        if not isinstance(self.ratio, FourierRatio):
            return [np.full(np.shape(a), math.inf)] * (order + 1)
        half = (b - a) / 2
        middle = self.ratio((a + b) / 2, order + 1)
        rest = sharpened(self.ratio.bound(order + 1, a, b), middle, half)
        least = np.maximum(1.0, 1 + middle[0] - half * rest[1])
        found = [self.centre_distance * x for x in majorant_power(least, rest[1 : order + 1], -1.0)]
        found[0] = np.full(np.shape(a), self.centre_distance)
        return found


class CentrodePair(Record):
    """A centrode and its mate at a centre distance; the first turns about 0, the second about +A."""

    first: PolarCentrode
    centre_distance: float

    def ratio(self, angle: ArrayLike) -> Real:
        """d phi_2 / d phi_1 = r_1/(A - r_1).

        Raises
        ------
        ParameterError
            The first centrode reaches the other centre.
        """
        radius = self.first.series(np.asarray(angle, dtype=float), 0)[0]
        if not np.all(radius < self.centre_distance):
            raise ParameterError("centre_distance", self.centre_distance, "centre_within_centrode", radius=radius.max())
        return radius / (self.centre_distance - radius)

    def mate_angle(self, angle: ArrayLike) -> Real:
        """phi_2, rad: the integral of the ratio by Gauss' rule on panels, to rounding for smooth centrodes."""
        at = np.atleast_1d(np.asarray(angle, dtype=float))
        shares, weights = panels(np.linspace(0, 1, _PANELS + 1), _NODES)
        return np.asarray((np.sum(self.ratio(at[:, None] * shares) * weights, axis=1) * at).reshape(np.shape(angle)))

    def mate_turns(self) -> float:
        """Turns of the second body for one of the first: a whole number over a whole number where both close."""
        return float(self.mate_angle(2 * math.pi)) / (2 * math.pi)

    def pose(self, t: Real, order: int) -> Pose:
        """The second body as a motion over phi_1 (the first one is Rotation(1.0)): it turns clockwise about +A."""
        radius = self.first.series(np.asarray(t, dtype=float), max(order - 1, 0))
        rest = [self.centre_distance - radius[0], *(-x for x in radius[1:])]
        rate = quotient(radius, rest)
        angle = [-self.mate_angle(t), *(-rate[k] / (k + 1) for k in range(order))]
        zero = 0.0 * np.asarray(t, dtype=float)
        return [self.centre_distance + zero, *([zero] * order)], angle

    def curvatures(self, angle: ArrayLike) -> tuple[Real, Real]:
        """Curvatures of both centrodes where they touch at phi_1, 1/mm, positive where convex.

        (r^2 + 2 r'^2 - r r'') / (r^2 + r'^2)^(3/2); of the second one over phi_2, d phi_1 = d phi_2 (A - r)/r.
        """
        r = self.first.series(np.asarray(angle, dtype=float), 2)
        q = self.centre_distance - r[0]
        slow = q / r[0]
        second = slow * (-2 * r[2] * slow + r[1] ** 2 * self.centre_distance / r[0] ** 2)
        return _polar_curvature(r[0], r[1], 2 * r[2]), _polar_curvature(q, -r[1] * slow, second)

    def is_convex(self) -> tuple[bool, bool]:
        """Whether each centrode is convex, at 1025 angles."""
        first, second = self.curvatures(np.linspace(0, 2 * math.pi, _SAMPLES))
        return bool(np.all(first > 0)), bool(np.all(second > 0))


def _polar_curvature(r: Real, rate: Real, bend: Real) -> Real:
    return (r**2 + 2 * rate**2 - r * bend) / (r**2 + rate**2) ** 1.5


def closing_distance(first: PolarCentrode, mate_turns: float) -> float:
    """The centre distance at which the mate turns ``mate_turns`` times for one turn of the first, mm.

    Raises
    ------
    ParameterError
        ``mate_turns`` is not positive.
    """
    if not mate_turns > 0:
        raise ParameterError("mate_turns", mate_turns, "not_whole_turns")
    largest = float(np.max(first.series(np.linspace(0, 2 * math.pi, _SAMPLES), 0)[0]))

    def excess(logarithm: float) -> float:
        pair = CentrodePair(first, largest * (1 + math.exp(logarithm)))
        return math.log(pair.mate_turns() / mate_turns)

    low, high = -12.0, 3.0
    while excess(high) > 0 and high < 30:
        high += 3
    if excess(low) < 0:
        raise ParameterError.beyond("mate_turns", mate_turns, "centres_would_meet", math.exp(excess(low)) * mate_turns)
    return largest * (1 + math.exp(bracketed_root(excess, low, high).value))

"""Brute force: a rack rolled along a closed centrode, and how near its teeth come to given points.

Independent of the product: the centrode is given by points and derivatives over any parameter, its arc length by
Gauss' rule on 4096 panels, the rack as half-planes and a rounded corner.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Points = NDArray[np.complex128]
_PANELS = 4096
_REFINEMENTS = 60


@dataclass(frozen=True)
class Centrode:
    """c(t) and c'(t), t from 0 to 2 pi, counter-clockwise."""

    point: Callable[[Array], Points]
    rate: Callable[[Array], Points]

    @cached_property
    def arcs(self) -> Array:
        """Arc length up to each panel's edge."""
        nodes, weights = np.polynomial.legendre.leggauss(8)
        width = 2 * math.pi / _PANELS
        t = (np.arange(_PANELS)[:, None] + (nodes + 1) / 2) * width
        return np.concatenate([[0.0], np.cumsum(np.sum(np.abs(self.rate(t)) * weights, axis=1) * width / 2)])

    def arc(self, t: Array) -> Array:
        """Arc length at any parameter."""
        nodes, weights = np.polynomial.legendre.leggauss(8)
        width = 2 * math.pi / _PANELS
        turns = np.floor(t / (2 * math.pi))
        rest = t - turns * 2 * math.pi
        panel = np.minimum((rest / width).astype(int), _PANELS - 1)
        part = rest - panel * width
        inside = (panel * width)[..., None] + part[..., None] * (nodes + 1) / 2
        partial = np.sum(np.abs(self.rate(inside)) * weights, axis=-1) * part / 2
        return self.arcs[panel] + partial + turns * self.arcs[-1]


def ellipse(semi_axis: float, eccentricity: float) -> Centrode:
    """About its focus, over the eccentric anomaly; its long radius on +x."""
    b = semi_axis * math.sqrt(1 - eccentricity**2)
    return Centrode(
        lambda t: semi_axis * (np.cos(t) + eccentricity) + 1j * b * np.sin(t),
        lambda t: -semi_axis * np.sin(t) + 1j * b * np.cos(t),
    )


def polar(radius: Callable[[Array], Array], slope: Callable[[Array], Array]) -> Centrode:
    """r(t) exp(i t)."""
    return Centrode(lambda t: radius(t) * np.exp(1j * t), lambda t: (slope(t) + 1j * radius(t)) * np.exp(1j * t))


@dataclass(frozen=True)
class RackTooth:
    """A cutting rack in mm: pitch, pressure angle, half of a tooth at the pitch line, depth of its tip, rounding.

    ``first``: where a tooth's middle stands along the pitch line.
    """

    pitch: float
    angle: float
    half: float
    depth: float
    radius: float
    first: float

    def distance(self, x: Array, y: Array) -> Array:
        """Signed distance of points from the nearest tooth, positive outside; y is away from the gear."""
        aside = np.abs(np.mod(x - self.first + self.pitch / 2, self.pitch) - self.pitch / 2)
        sine, cosine = math.sin(self.angle), math.cos(self.angle)
        flank = (aside - self.half) * cosine - y * sine
        tip = -(y + self.depth)
        # the rounding's centre keeps its radius from both
        down = -self.depth + self.radius
        out = self.half + (self.radius * -1 + down * sine) / cosine
        u, v = aside - out, y - down
        # in the cone between the normals (cos a, -sin a) and (0, -1)
        first = u / cosine
        second = -v - first * sine
        corner = np.hypot(u, v) - self.radius
        return np.where((first >= 0) & (second >= 0), corner, np.maximum(flank, tip))


def least_distance(centrode: Centrode, rack: RackTooth, points: Points, reach: float, samples: int = 801) -> Array:
    """How near the rolling rack comes to points of the gear, mm; negative: cut into.

    ``reach``: parameters on either side of the point's own polar place that are looked at, rad.
    """
    places = centrode.point(np.linspace(0, 2 * math.pi, 2001))
    nearest = np.argmin(np.abs(points[:, None] - places), axis=1) / 2000 * 2 * math.pi
    t = nearest[:, None] + np.linspace(-reach, reach, samples)

    def gap(at: Array, rows: Points) -> Array:
        base, rate = centrode.point(at), centrode.rate(at)
        seen = np.conj(rate / np.abs(rate)) * (rows - base)
        return rack.distance(centrode.arc(at) + seen.real, -seen.imag)

    values = gap(t, points[:, None])
    best = np.full(len(points), np.inf)
    step = t[0, 1] - t[0, 0]
    # every dip of the samples, not only the lowest, is refined
    inner = (values[:, 1:-1] <= values[:, :-2]) & (values[:, 1:-1] <= values[:, 2:])
    row, k = np.nonzero(inner & (values[:, 1:-1] < values.min(axis=1)[:, None] + 0.05 * rack.pitch))
    low, high = t[row, k + 1] - step, t[row, k + 1] + step
    for _ in range(_REFINEMENTS):
        one, two = low + (high - low) * 0.382, low + (high - low) * 0.618
        less = gap(one, points[row]) < gap(two, points[row])
        low, high = np.where(less, low, one), np.where(less, two, high)
    np.minimum.at(best, row, gap((low + high) / 2, points[row]))
    return best

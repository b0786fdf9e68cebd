"""Polygons with arcs: what a curve becomes in a file. Vertices are complex, a bulge is tan(sweep / 4)."""

from __future__ import annotations

import math

import numpy as np

from geometry.base.record import Record, replace
from geometry.curves.bounds import Bound
from geometry.curves.curve import Complex, Real

_MOST_DECIMALS = 15


class Contour(Record):
    """One period of a closed chain of lines (bulge 0) and arcs; edge i starts at vertex i.

    The last edge ends at the first vertex of the next period, which is turned by ``pitch_angle``.
    ``decimals``: those of the expanded vertices, mm.
    """

    vertices: Complex
    bulges: Real
    count: int = 1
    clockwise: bool = False
    decimals: int | None = None

    @property
    def pitch_angle(self) -> float:
        """Angle from one period to the next, rad; negative where clockwise."""
        return (-2 if self.clockwise else 2) * math.pi / self.count

    def expanded(self) -> tuple[Complex, Real]:
        """Vertices (n,) and bulges (n,) of the whole contour, period after period."""
        turns = np.exp(1j * self.pitch_angle * np.arange(self.count))
        vertices = (turns[:, None] * self.vertices).ravel()
        if self.decimals is not None:
            # adding zero leaves no -0.0
            vertices = np.round(vertices, self.decimals) + 0.0
        return vertices, np.tile(self.bulges, self.count)

    def box(self) -> tuple[complex, complex]:
        """Lower left and upper right corner of the box about it."""
        vertices, bulges = self.expanded()
        return edge_box(vertices, np.roll(vertices, -1), bulges)

    def sampled(self, count: int) -> Complex:
        """Points all along it, so many of each edge, its first end among them."""
        vertices, bulges = self.expanded()
        return edge_points(vertices, np.roll(vertices, -1), bulges, np.linspace(0, 1, count, endpoint=False)).ravel()

    def written(self, decimals: int) -> Contour:
        """The contour with vertices of so many decimals, and each bulge with as many as keep its crown so well.

        An outline is moved by 1.25 times the last decimal at most: arcs of up to half a turn by that of their ends,
        and their crowns by a quarter.
        """
        sizes = np.ceil(np.log10(np.abs(self.period_ends() - self.vertices)) - 1e-9).astype(int)
        scale = np.array([10.0**k for k in range(_MOST_DECIMALS + 1)])[np.clip(decimals + sizes, 0, _MOST_DECIMALS)]
        return replace(self, bulges=np.round(self.bulges * scale) / scale + 0.0, decimals=decimals)

    def period_ends(self) -> Complex:
        """End vertex of each edge of the first period."""
        return np.append(self.vertices[1:], self.vertices[0] * np.exp(1j * self.pitch_angle))

    def __len__(self) -> int:
        return len(self.vertices) * self.count


class Approximation(Record):
    """An approximated boundary with the bound of its deviation from the exact one, mm.

    ``turn_step``: how far a twisted wall over it may turn from slice to slice, rad; the bound holds on that wall too.
    """

    geometry: Contour
    max_error: float
    bound: Bound
    tolerance: float
    turn_step: float = math.inf


def edge_points(starts: Complex, ends: Complex, bulges: Real, fractions: Real) -> Complex:
    """Points (n, k) of edges (n,) at fractions (k,) of each chord or sweep, or at those (n, k) of its own."""
    starts, ends, bulges = starts[:, None], ends[:, None], bulges[:, None]
    quarter = np.arctan(bulges)
    # an arc through both ends with sweep 4 q: z = s + (e - s) sin(2 q f) / sin(2 q) exp(-2 i q (1 - f))
    with np.errstate(invalid="ignore", divide="ignore"):
        share = np.where(quarter == 0, fractions, np.sin(2 * quarter * fractions) / np.sin(2 * quarter))
    return starts + (ends - starts) * share * np.exp(-2j * quarter * (1 - fractions))


def edge_box(starts: Complex, ends: Complex, bulges: Real) -> tuple[complex, complex]:
    """Lower left and upper right corner of the box about edges (n,), the crowns of arcs included."""
    chord, bent = ends - starts, bulges != 0
    b, c = bulges[bent], chord[bent]
    centre = (starts + ends)[bent] / 2 + 1j * c * (1 - b**2) / (4 * b)
    radius, first = np.abs(c) * (1 + b**2) / (4 * np.abs(b)), np.angle(starts[bent] - centre)
    points = [starts, ends]
    for direction in range(4):
        way = 0.5 * np.pi * direction
        inside = np.mod(np.sign(b) * (way - first), 2 * np.pi) <= 4 * np.arctan(np.abs(b))
        points.append((centre + radius * 1j**direction)[inside])
    whole = np.concatenate(points)
    return complex(whole.real.min(), whole.imag.min()), complex(whole.real.max(), whole.imag.max())


def signed_area(vertices: Complex, bulges: Real) -> float:
    """Area of a closed contour of lines and arcs, mm^2; positive where counter-clockwise."""
    # about its own first vertex: a small hole far from the axis loses no digits
    ends = np.roll(vertices, -1)
    polygon = 0.5 * np.sum((np.conj(vertices - vertices[0]) * (ends - vertices[0])).imag)
    sweep = 4 * np.arctan(bulges)
    with np.errstate(invalid="ignore", divide="ignore"):
        radius = np.abs(ends - vertices) * (1 + bulges**2) / (4 * np.abs(bulges))
        caps = np.where(bulges == 0, 0.0, 0.5 * radius**2 * (sweep - np.sin(sweep)))
    return float(polygon + np.sum(caps))

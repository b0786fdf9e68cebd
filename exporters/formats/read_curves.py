"""Lines, arcs and splines of a STEP file, all at once: cut into smooth spans, evaluated at shares of each.

Splines go by the recursion of Cox and de Boor, written here once more: the one of our own splines wrote the file.
"""

from __future__ import annotations

from functools import cache, lru_cache

import numpy as np

from exporters.formats.read_part21 import Index
from geometry.base.record import Record
from geometry.curves.curve import Flags, Real

# nodes on a span: Gauss and Lobatto's rule is exact up to degree 21, as high as a spline's volume goes
_NODES = 12


class Frames(Record, eq=False):
    """Origins (n, 3), and axes (n, 3, 3) in rows: along, across, and the axis."""

    origins: Real
    axes: Real

    @property
    def centres(self) -> Real:
        """The origins in the frames' own axes, (n, 3)."""
        return np.asarray(np.einsum("nc,nkc->nk", self.origins, self.axes))

    def local(self, which: Index, points: Real, *, moved: bool = True) -> Real:
        """Points (n, k, 3) in the frames ``which`` (n,); not ``moved``: vectors."""
        away = points - self.origins[which][:, None] if moved else points
        return np.asarray(away @ self.axes[which].transpose(0, 2, 1))


class Knots(Record, eq=False):
    """Degree and knots of splines, each as often as it counts."""

    degree: int
    knots: tuple[float, ...]

    @property
    def spans(self) -> Index:
        """The numbers of the knots with which spans begin."""
        return np.flatnonzero(np.diff(self.knots) > 0)

    def basis(self, shares: Real) -> tuple[Real, Real, Index]:
        """The basis functions that are not 0 at shares of every span (spans, k, degree + 1), their derivatives by the
        share, and the number of the first of them in each span; Cox and de Boor.
        """
        knots, first = np.array(self.knots), self.spans
        low, high = knots[first], knots[first + 1]
        t = (low[:, None] + (high - low)[:, None] * shares)[..., None]
        values, slopes = np.ones((*t.shape[:2], 1)), np.zeros((*t.shape[:2], 1))
        for order in range(1, self.degree + 1):
            index = first[:, None] + np.arange(1 - order, 1)
            start, width = knots[index], knots[index + order] - knots[index]
            if order == self.degree:
                steep = np.zeros((*t.shape[:2], order + 1))
                steep[..., 1:] = values * (order / width * (high - low)[:, None])[:, None]
                steep[..., :-1] -= steep[..., 1:]
                slopes = steep
            share = (t - start[:, None]) / width[:, None]
            raised = np.zeros((*t.shape[:2], order + 1))
            raised[..., 1:] = values * share
            raised[..., :-1] += values * (1 - share)
            values = raised
        return values, slopes, first - self.degree

    def matrices(self, shares: Real) -> tuple[Real, Real]:
        """What poles are multiplied by for points, and derivatives, at all spans' shares: (spans k, poles) each."""
        return _matrices(self, shares.tobytes())


@lru_cache(8)
def _matrices(knots: Knots, places: bytes) -> tuple[Real, Real]:
    """Once for all faces of one net: the knots are the file's own object."""
    shares = np.frombuffer(places)
    values, slopes, first = knots.basis(shares)
    whole = np.zeros((2, len(first), len(shares), len(knots.knots) - knots.degree - 1))
    for number, place in enumerate(first[:, None] + np.arange(knots.degree + 1)):
        whole[0, number, :, place], whole[1, number, :, place] = values[number].T, slopes[number].T
    points, derivatives = whole.reshape(2, -1, whole.shape[-1])
    return points, derivatives


class Patches(Record, eq=False):
    """Spline surfaces of one net: their faces (n,), poles (n, k, l, 3), degrees and knots along and across."""

    faces: Index
    poles: Real
    along: Knots
    across: Knots

    def grid(self, along: Real, across: Real, part: slice | Index) -> tuple[Real, Real, Real]:
        """Points (n, i, j, 3) at shares of all spans, and their derivatives by these along and across.

        ``part``: of which surfaces.
        """
        (u, du), (v, dv) = self.along.matrices(along), self.across.matrices(across)
        low, steep = (np.tensordot(self.poles[part], matrix, (1, 1)) for matrix in (u, du))
        found = [np.tensordot(x, y, (1, 1)).transpose(0, 2, 3, 1) for x, y in ((low, v), (steep, v), (low, dv))]
        return found[0], found[1], found[2]


class Curves(Record, eq=False):
    """Lines, circles and splines, each run along a part of it or all of it; ``counts``: of the spans of each (n,).

    Lines: number, start, end; arcs: number, frame's number, radius, start and sweep; splines by their knots: numbers,
    whether against them, and poles (n, k, 3).
    """

    counts: Index
    lines: tuple[Index, Real, Real]
    arcs: tuple[Index, Frames, Real, Real, Real]
    splines: list[tuple[Knots, Index, Flags, Real]]

    @property
    def starts(self) -> Index:
        """The number of the first span of each."""
        return np.cumsum(self.counts) - self.counts

    def at(self, shares: Real) -> tuple[Real, Real]:
        """Points, and derivatives by the share, of all spans at shares that lie alike from both ends: (spans, k, 3)."""
        starts = self.starts
        points = np.empty((int(self.counts.sum()), len(shares), 3))
        slopes = np.empty_like(points)
        which, begin, end = self.lines
        if which.size:
            points[starts[which]] = begin[:, None] + (end - begin)[:, None] * shares[:, None]
            slopes[starts[which]] = (end - begin)[:, None]
        which, frames, radii, first, sweeps = self.arcs
        counts = self.counts[which]
        row = np.repeat(np.arange(len(which)), counts)
        number = np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
        step = (sweeps / counts)[row]
        angles = first[row][:, None] + step[:, None] * (number[:, None] + shares)
        along, across = (frames.axes[row, k][:, None] * radii[row][:, None, None] for k in (0, 1))
        cosine, sine = np.cos(angles)[..., None], np.sin(angles)[..., None]
        spans = starts[which][row] + number
        points[spans] = frames.origins[row][:, None] + cosine * along + sine * across
        slopes[spans] = step[:, None, None] * (cosine * across - sine * along)
        for knots, which, against, poles in self.splines:
            values, steep, low = knots.basis(shares)
            windows = poles[:, low[:, None] + np.arange(knots.degree + 1)]
            spans = starts[which][:, None] + np.arange(len(low))
            for sense, way in ((~against, 1), (against, -1)):
                mine = np.flatnonzero(sense)
                if mine.size:
                    points[spans[mine]] = (values @ windows[mine])[:, ::way, ::way]
                    slopes[spans[mine]] = way * (steep @ windows[mine])[:, ::way, ::way]
        return points, slopes


def spans_of(curves: Curves, which: Index, along: Flags | None = None) -> tuple[Index, Index]:
    """The spans of some curves one behind the other, and the row of ``which`` that each belongs to.

    ``along``: whether each is run along (n,), otherwise its last span comes first.
    """
    counts = curves.counts[which]
    row = np.repeat(np.arange(len(which)), counts)
    place = np.arange(len(row)) - np.repeat(np.cumsum(counts) - counts, counts)
    if along is not None:
        place = np.where(along[row], place, counts[row] - 1 - place)
    return curves.starts[which][row] + place, row


@cache
def lobatto() -> tuple[Real, Real]:
    """Nodes on 0 .. 1, both ends among them, and weights of Gauss and Lobatto's rule (Golub, 1973)."""
    k = np.arange(1, _NODES - 2)
    off = np.sqrt(k * (k + 2) / ((2 * k + 1) * (2 * k + 3)))
    inner = np.linalg.eigvalsh(np.diag(off, 1) + np.diag(off, -1))
    nodes = np.concatenate([[-1.0], (inner - inner[::-1]) / 2, [1.0]])
    before, last = np.ones(_NODES), nodes
    for order in range(2, _NODES):
        before, last = last, ((2 * order - 1) * nodes * last - (order - 1) * before) / order
    return (1 + nodes) / 2, 1 / (_NODES * (_NODES - 1) * last**2)

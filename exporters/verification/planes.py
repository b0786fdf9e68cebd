"""Bounds of plane faces against each other: holes lie within their face and apart, and no bound crosses another.

Neither a volume nor how far each bound lies from its own profile tells that.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from exporters.formats.read_curves import lobatto, spans_of
from exporters.formats.read_solid import LEVEL, PLANE, Model
from geometry.base.record import Record
from geometry.curves.curve import Complex
from parts.base.texts import unless


class Bound(Record, eq=False):
    """A loop by its points (n,) in the plane of its face, and how far it leaves the chords between them, mm."""

    points: Complex
    bow: float

    @property
    def ways(self) -> Complex:
        """From each point to the next, mm."""
        return np.roll(self.points, -1) - self.points

    def goes_round(self, middle: complex) -> bool:
        """Whether the loop encloses a point that lies off its chords."""
        return bool(abs(np.angle(1 + self.ways / (self.points - middle)).sum()) > np.pi)

    def disc(self) -> tuple[complex, float]:
        """Middle and radius of a disc that holds the loop, mm."""
        middle = complex(self.points.mean())
        return middle, float(np.abs(self.points - middle).max()) + self.bow


def plane_failures(model: Model) -> list[str]:
    """What is wrong with the bounds of the plane faces that have several."""
    apart = all(map(_lie_apart, _faces(model)))
    return unless(apart, "a hole of a plane face does not lie within it, or crosses another bound")


def _faces(model: Model) -> Iterator[list[Bound]]:
    """The bounds of each plane face that has holes."""
    uses = model.uses
    first = np.unique(uses.loop, return_index=True)[1]
    holed = (model.kind == PLANE) & (np.bincount(uses.face[first], minlength=len(model.faces)) > 1)
    mine = np.flatnonzero(holed[uses.face])
    if not mine.size:
        return
    span, row = spans_of(model.curves, uses.edge[mine], uses.along[mine])
    face, loop = uses.face[mine][row], uses.loop[mine][row]
    at = model.frames.local(face, model.points[span])
    slopes = model.frames.local(face, model.slopes[span], moved=False)
    # the middle of a cubic through both ends leaves the chord by an eighth of what its slope changes
    bows = (np.linalg.norm(np.diff(slopes, axis=1), axis=2) * np.diff(lobatto()[0]) / 8).max(axis=1)
    points = np.where(
        uses.along[mine][row, None], at[..., 0] + 1j * at[..., 1], (at[..., 0] + 1j * at[..., 1])[:, ::-1]
    )
    begin = np.flatnonzero(np.diff(loop, prepend=-1))
    rows = zip(np.split(points[:, :-1], begin[1:]), np.split(bows, begin[1:]), strict=True)
    bounds = [Bound(piece.ravel(), float(bow.max())) for piece, bow in rows]
    for one in np.unique(face):
        yield [bounds[k] for k in np.flatnonzero(face[begin] == one)]


def _lie_apart(bounds: list[Bound]) -> bool:
    """Whether the loops of a face are one that holds the others, each of them beside the rest."""
    outer, *holes = sorted(bounds, key=lambda bound: -np.ptp(bound.points.real) - np.ptp(bound.points.imag))
    middles, sizes = map(np.array, zip(*(hole.disc() for hole in holes), strict=True))
    longest = float(np.abs(outer.ways).max())
    for hole, middle, size in zip(holes, middles.tolist(), sizes.tolist(), strict=True):
        if np.abs(outer.points - middle).min() > size + longest:
            if not outer.goes_round(middle):
                return False
        elif _reaches(hole, outer, inside=False) or _reaches(outer, hole, inside=True):
            return False
    close = np.triu(np.abs(middles[:, None] - middles) < sizes[:, None] + sizes, 1)
    pairs = [(holes[i], holes[k]) for i, k in np.argwhere(close)]
    return not any(_reaches(*pair, inside=True) or _reaches(*pair[::-1], inside=True) for pair in pairs)


def _reaches(one: Bound, other: Bound, *, inside: bool) -> bool:
    """Whether some point of a loop lies ``inside`` of another one, or outside, farther than that leaves its chords."""
    import shapely

    ring = shapely.linearrings(np.stack([other.points.real, other.points.imag], axis=1))
    polygon = shapely.polygons(ring)
    shapely.prepare(polygon)
    there = one.points[shapely.contains_xy(polygon, one.points.real, one.points.imag) == inside]
    off = shapely.distance(ring, shapely.points(there.real, there.imag))
    return bool(np.any(off > other.bow + LEVEL))

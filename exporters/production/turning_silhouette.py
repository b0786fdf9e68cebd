"""How what is not round looks from above as it turns on an axis that lies: the hull of both its ends, pose by pose.

It is told by its farthest points in directions of the picture, as many in each pose. Between two poses these go
straight, and so does what it reaches in every one of the directions: how far that is off is seen at once, and of convex
outlines no other distance is greater.
"""

from __future__ import annotations

import math

import numpy as np

from exporters.production.seen_above import outer_points
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from parts.base.part import Part

# directions in which it is told, and others in which pictures are held against it
_TOLD, _HELD = 1440, 1001
_WAYS: Complex = np.exp(2j * math.pi * np.arange(_TOLD) / _TOLD)
_OTHERS: Complex = np.exp(2j * math.pi * (np.arange(_HELD) + 0.5) / _HELD)
# poses at a time; mm: what is no length
_ROWS, _NO_LENGTH = 128, 1e-9


class Ends(Record):
    """A convex outline at two levels, mm: its corners, counter-clockwise; ``off``: how far chords are within it, mm."""

    outline: Complex
    levels: tuple[float, float]
    off: float

    def corners(self, turned: Real, ways: Complex) -> Complex:
        """The points (t, n) that are farthest in n directions, seen from above, of its frame turned so (t, 3, 3)."""
        flat = turned[:, 0] + 1j * turned[:, 1]
        # directions of the picture in its frame
        x, y, z = ((flat[:, k, None].conj() * ways).real for k in range(3))
        normals = np.unwrap(np.angle(-1j * (np.roll(self.outline, -1) - self.outline)))
        # a corner lies between the normals of its sides
        angle = normals[0] + (np.arctan2(y, x) - normals[0]) % (2 * math.pi)
        at = self.outline[np.searchsorted(normals, angle) % len(normals)]
        level = np.where(z > 0, self.levels[1], self.levels[0])
        return np.asarray(flat[:, :1] * at.real + flat[:, 1:2] * at.imag + flat[:, 2:] * level)

    def outlines(self, turned: Real) -> Complex:
        """Outlines (t, n), counter-clockwise about its origin."""
        return np.concatenate([self.corners(turned[k : k + _ROWS], _WAYS) for k in range(0, len(turned), _ROWS)])

    def off_between(self, turned: Real, outlines: Complex) -> float:
        """How far it is, turned as in the middles between poses, off outlines that go straight between theirs, mm."""
        worst = 0.0
        for k in range(0, len(turned), _ROWS):
            exact = (self.corners(turned[k : k + _ROWS], _WAYS) * _WAYS.conj()).real
            told = (outlines[k : k + len(exact) + 1] * _WAYS.conj()).real
            worst = max(worst, float(np.abs(exact - (told[:-1] + told[1:]) / 2).max()))
        return worst

    def off_outlines(self, turned: Real, outlines: Complex) -> float:
        """How far convex outlines (t, n) of any corners are off it as it is turned so, mm."""
        worst = 0.0
        for own, corners in zip(turned, outlines, strict=True):
            exact = (self.corners(own[None], _OTHERS)[0] * _OTHERS.conj()).real
            told = (corners[:, None] * _OTHERS.conj()).real.max(axis=0)
            worst = max(worst, float(np.abs(exact - told).max()))
        return worst


def ends_of(part: Part, chord: float) -> Ends:
    """The hull of a part's ends; ``chord``: what chords may leave of its outline, mm."""
    import shapely

    points, off = outer_points(part, chord)
    hull = shapely.MultiPoint(np.column_stack([points.real, points.imag])).convex_hull
    xy = shapely.get_coordinates(shapely.orient_polygons(hull).exterior)[:-1]
    levels = part.blank(0.0).levels()
    return Ends(xy[:, 0] + 1j * xy[:, 1], (levels[0], levels[-1]), off)


def thinned(outlines: Complex, allowed: float) -> Complex:
    """The same outlines without corners that are needed in none of them: by so much, mm, they lie within all chords."""
    count = outlines.shape[1]
    kept, here = [0], 0
    while here < count - 1:
        step = 1
        while here + 2 * step < count and _fits(outlines, here, here + 2 * step, allowed):
            step *= 2
        low, high = here + step, min(here + 2 * step, count)
        while high - low > 1:
            middle = (low + high) // 2
            low, high = (middle, high) if _fits(outlines, here, middle, allowed) else (low, middle)
        here = low
        if here < count:
            kept.append(here)
    return outlines[:, kept]


def _fits(outlines: Complex, one: int, two: int, allowed: float) -> bool:
    """Whether all corners between two lie as near to the line between these."""
    start, way = outlines[:, one, None], (outlines[:, two % outlines.shape[1]] - outlines[:, one])[:, None]
    between = outlines[:, one + 1 : two] - start
    length = np.maximum(np.abs(way), _NO_LENGTH)
    share = np.clip((between * way.conj()).real / length**2, 0.0, 1.0)
    return bool((np.abs(between - share * way) <= allowed).all())

"""The outer cylinder of a cylindrical cam unrolled: the jackets that users wrap around a tube, as plane regions.

x is the arc of the outer cylinder from the middle of the sheet, seen from outside with the cam's axis upwards, y the
height over the cam's middle. Cam angle 0 stands at the right end, one turn at the left one.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from functools import lru_cache, partial
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import CuspError, OffsetError
from geometry.base.nearest import moved
from geometry.base.record import Record, replace
from geometry.base.series import FACTORIALS, Series, derived, unit, unit_majorant
from geometry.cams.barrel.bounds import edge_bounds
from geometry.cams.barrel.cam import LOWER, UPPER, BarrelCam
from geometry.curves.bounds import BoundedSpan
from geometry.curves.curve import (
    Complex,
    Curve,
    Real,
    curvature_from_derivatives,
    end_point,
    start_point,
    vertex_sign,
)
from geometry.curves.intersect import crossing
from geometry.curves.line_arc import Arc, Line
from geometry.laws.piece import LawPiece, split_places
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Profile, Region, Segment

_SPLIT_SAMPLES = 129
# rounds in which the place where a parallel curve is nearest to a cusp is looked for
_REFINEMENTS = 4


class DevelopedEdge(BoundedSpan, Record):
    """A wall's edge on the outer cylinder, unrolled, over the cam angle t: R (polar angle + pi) + i (z - middle).

    With growing cam angle it runs to the left. ``distance``: of a parallel of it, mm to its left.
    """

    cam: BarrelCam
    piece: LawPiece
    side: int
    middle: float
    start: float
    end: float
    distance: float = 0.0

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients at ``t``."""
        if not self.distance:
            return self._edge(t, order)
        edge = self._edge(t, order + 1)
        return [x + 1j * self.distance * u for x, u in zip(edge, unit(derived(edge)), strict=False)]

    def _edge(self, t: ArrayLike, order: int) -> Series:
        at = np.asarray(t, dtype=float)
        polar, height = self.cam.edge_series(self.piece, self.side, self.cam.outer, at, order)
        found = [self.cam.outer * a + 1j * z for a, z in zip(polar, height, strict=True)]
        found[0] = found[0] + math.pi * self.cam.outer - 1j * self.middle
        return found

    def tangent(self, t: ArrayLike) -> Complex:
        first = self._edge(t, 1)[1]
        return np.asarray(first / np.abs(first))

    def curvature(self, t: ArrayLike) -> Real:
        _, first, second = self.series(t, 2)
        return curvature_from_derivatives(first, 2 * second)

    def vertex_function(self, t: ArrayLike) -> Real:
        """Changes its sign where the curvature is greatest or least."""
        _, first, second, third = (FACTORIALS[k] * x for k, x in enumerate(self.series(t, 3)))
        return vertex_sign(first, second, third)

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of their moduli on each interval."""
        low, high = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
        top = order + 1 if self.distance else order
        polar, height = edge_bounds(self.cam, self.piece, self.cam.outer, top, low, high)
        edge = [np.hypot(self.cam.outer * x, z) for x, z in zip(polar, height, strict=True)]
        if not self.distance:
            return edge
        half = (high - low) / 2
        with np.errstate(all="ignore"):
            least = np.abs(self._edge((low + high) / 2, 1)[1]) - half * 2 * edge[2]
            normal = unit_majorant(derived(edge), least)
            moved = [x + abs(self.distance) * u for x, u in zip(edge, normal, strict=False)]
        return [np.where((least > 0) & np.isfinite(x), x, math.inf) for x in moved]

    def offset(self, distance: float) -> DevelopedEdge:
        edge, whole = replace(self, distance=0.0), self.distance + distance
        low, high, count = *self.domain, _SPLIT_SAMPLES
        for _ in range(_REFINEMENTS):
            t, curvature = _sampled_curvature(edge, low, high, count)
            stretch = 1 - whole * curvature
            least = int(np.argmin(stretch))
            if stretch[least] <= 0:
                raise CuspError(float(t[least]), distance)
            low, high, count = float(t[max(least - 1, 0)]), float(t[min(least + 1, len(t) - 1)]), 9
        return replace(self, distance=whole)


@lru_cache(maxsize=1024)
def _sampled_curvature(edge: DevelopedEdge, low: float, high: float, count: int) -> tuple[Real, Real]:
    """Places along an edge and its curvature there: a search for the offset that works asks the same ones each time."""
    t = np.linspace(low, high, count)
    return t, edge.curvature(t)


def development(cam: BarrelCam, length: float, offset: float = 0.0) -> OffsetRegion:
    """The jackets of the outer cylinder as one region: below the groove, and apart from it above the groove.

    ``offset`` moves every boundary out of the material in the plane of the sheet, mm.

    Raises
    ------
    OffsetError
        The offset leaves no jacket.
    """
    code = "no_jacket" if offset < 0 else "groove_closed"
    return OffsetRegion(moved(partial(_region, cam, length), offset, code), offset, ())


def _region(cam: BarrelCam, length: float, offset: float) -> Region:
    half = float(cam.radius_at(cam.outer))
    if cam.is_groove and offset >= half:
        raise OffsetError(offset, "groove_closed", half)
    lower = _jacket(cam, LOWER, -length / 2, length / 2, offset)
    apart = (_jacket(cam, UPPER, length / 2, length / 2, offset),) if cam.is_groove else ()
    return Region(lower, apart=apart)


def _jacket(cam: BarrelCam, side: int, border: float, middle: float, offset: float) -> Profile:
    """The closed outline between a wall's edge and the end of the cylinder at y = ``border``, counter-clockwise."""
    edge = [c for piece in cam.motion.pieces for c in _edge_curves(cam, piece, side, middle)]
    if side == UPPER:
        # material above: the edge runs to the right
        edge = [c.reversed() for c in reversed(edge)]
    first, last = start_point(edge[0]), end_point(edge[-1])
    corners = [last, complex(last.real, border), complex(first.real, border), first]
    sides: list[Curve] = [Line(a, b) for a, b in pairwise(corners)]
    if offset == 0:
        return _profile([*edge, *sides])
    moved = [c.offset(-offset) for c in edge]
    if offset > 0:
        return _profile(_rounded(moved, corners, offset))
    inward = -math.copysign(1.0, (last - first).real) * offset
    left, right = first.real + inward, last.real - inward
    moved = _cut(_cut(moved, lambda p: (p.real - left) * inward, keep_end=True), lambda p: (right - p.real) * inward)
    sense = math.copysign(1.0, border - first.imag)
    level = border + sense * offset
    if min(sense * (level - p.imag) for c in moved for p in (start_point(c), end_point(c))) <= 0:
        raise OffsetError(offset, "no_jacket")
    a, b = end_point(moved[-1]), start_point(moved[0])
    path = [a, complex(a.real, level), complex(b.real, level), b]
    return _profile([*moved, *(Line(p, q) for p, q in pairwise(path))])


def _rounded(moved: list[Curve], corners: list[complex], offset: float) -> list[Curve]:
    """The outline moved out: straight sides beside their own, arcs about the corners."""
    found: list[Curve] = list(moved)
    at = end_point(moved[-1])
    for corner, after in pairwise(corners):
        way = (after - corner) / abs(after - corner)
        leave = corner - 1j * way * offset
        sweep = cmath.phase((leave - corner) / (at - corner))
        found += [Arc(corner, offset, cmath.phase(at - corner), sweep), Line(leave, after - 1j * way * offset)]
        at = after - 1j * way * offset
    corner, target = corners[-1], start_point(moved[0])
    found.append(Arc(corner, offset, cmath.phase(at - corner), cmath.phase((target - corner) / (at - corner))))
    return found


def _cut(curves: list[Curve], height: Callable[[complex], float], *, keep_end: bool = False) -> list[Curve]:
    """The part of a chain where ``height`` is positive: up to the end, or from the start."""
    ordered = curves if keep_end else list(reversed(curves))
    for index, curve in enumerate(ordered):
        far = end_point(curve) if keep_end else start_point(curve)
        near = start_point(curve) if keep_end else end_point(curve)
        if height(far) <= 0:
            continue
        kept = ordered[index:]
        if height(near) < 0:
            at = crossing(curve, height).value
            low, high = curve.domain
            kept[0] = curve.trimmed(at, high) if keep_end else curve.trimmed(low, at)
        return kept if keep_end else list(reversed(kept))
    raise OffsetError(0.0, "no_jacket")


def _profile(curves: list[Curve]) -> Profile:
    return Profile(tuple(Segment(c, Label.CAM if isinstance(c, DevelopedEdge) else Label.BODY) for c in curves))


# both edges of a table of 2000 rows: fewer places would lose each one before it is asked for again
@lru_cache(maxsize=4096)
def _edge_curves(cam: BarrelCam, piece: LawPiece, side: int, middle: float) -> tuple[Curve, ...]:
    """The developed edge over one piece, split where its curvature changes sign or trend; dwells are straight."""
    whole = DevelopedEdge(cam, piece, side, middle, piece.start, piece.end)
    if piece.is_constant:
        return (Line(start_point(whole), end_point(whole)),)
    edges = split_places([whole.vertex_function, whole.curvature], piece.start, piece.end)
    return tuple(whole.trimmed(a, b) for a, b in pairwise(edges))

"""The walls of a cylindrical cam as B-spline surfaces with finished poles, and their edges on both cylinders.

One surface for each piece of the motion, over the cam angle and the share of the way from the inner to the outer
cylinder: the walls are analytic there. Poles interpolate the exact wall at Greville's places.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from geometry.bspline import basis
from geometry.cams.barrel import BarrelCam
from geometry.contour import Bound
from geometry.curve import Real
from geometry.errors import ConvergenceError
from geometry.motion_laws.piece import LawPiece

_DEGREE = 7
# the kernel joins curves and surfaces within 1e-7 mm: edges are kept well below that, mm
_TARGET = 2e-8
_MARGIN = 1.5
_SPANS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128, 192, 256)
_ACROSS = (1, 2, 4, 8)
# samples a span, none at the places of interpolation
_SAMPLES = 13
# rounding of fitting and measuring, part of the size
_ROUNDING = 3e-15


@dataclass(frozen=True, slots=True, eq=False)
class WallSpline:
    """A tensor product over cam angle and share: knots both ways, poles (n, m, 3) mm.

    ``edges``: poles (2, n, 2) of the polar angle (rad) and the height (mm) along the inner and the outer cylinder.
    """

    side: int
    piece: LawPiece
    along: Real
    across: Real
    poles: Real
    edges: Real
    max_error: float

    @property
    def degree(self) -> int:
        """Both ways."""
        return _DEGREE


@dataclass(frozen=True, slots=True, eq=False)
class BarrelSplines:
    """All walls as splines, in the order of the motion's pieces, side by side, and the worst error, mm."""

    walls: dict[int, tuple[WallSpline, ...]]
    max_error: float
    bound: Bound = "sampled"


def barrel_splines(cam: BarrelCam, tolerance: float) -> BarrelSplines:
    """Splines within ``tolerance`` mm of the walls, and within what the kernel calls one point of the cylinders.

    Raises
    ------
    ConvergenceError
        256 spans are not enough.
    """
    target = max(min(tolerance, _TARGET) / _MARGIN, 4 * _ROUNDING * cam.outer)
    walls = {side: tuple(_fitted(cam, side, piece, target) for piece in cam.motion.pieces) for side in cam.sides}
    return BarrelSplines(walls, _MARGIN * max(w.max_error for found in walls.values() for w in found))


def _fitted(cam: BarrelCam, side: int, piece: LawPiece, target: float) -> WallSpline:
    best = None
    for across in _ACROSS:
        previous = np.inf
        for spans in _SPANS:
            best = _interpolated(cam, side, piece, spans, across)
            if best.max_error <= target:
                return best
            # where more spans along the wall do not help, those across it have to
            if best.max_error > 0.5 * previous and spans > 8:
                break
            previous = best.max_error
    assert best is not None
    raise ConvergenceError("spline surfaces of the walls", best.max_error, _SPANS[-1])


def _interpolated(cam: BarrelCam, side: int, piece: LawPiece, spans: int, across: int) -> WallSpline:
    u_knots, v_knots = _knots(piece.start, piece.end, spans), _knots(0.0, 1.0, across)
    u, v = _greville(u_knots), _greville(v_knots)
    radii = cam.inner + v * (cam.outer - cam.inner)
    points = cam.wall(u[:, None], side, radii, piece)
    along, crosswise = _matrix(u_knots, u), _matrix(v_knots, v)
    poles = np.einsum("ij,jkc->ikc", np.linalg.inv(crosswise), np.linalg.solve(along, points.reshape(len(u), -1))
                      .reshape(points.shape).transpose(1, 0, 2)).transpose(1, 0, 2)  # fmt: skip
    edges = np.array([np.linalg.solve(along, _polar(cam, side, piece, radius, u)) for radius in (cam.inner, cam.outer)])
    made = WallSpline(side, piece, u_knots, v_knots, poles, edges, 0.0)
    return WallSpline(side, piece, u_knots, v_knots, poles, edges, _error(cam, made))


def _polar(cam: BarrelCam, side: int, piece: LawPiece, radius: float, angle: Real) -> Real:
    """Polar angle (not folded) and height of an edge, (n, 2)."""
    polar, height = cam.edge_series(piece, side, radius, angle, 0)
    return np.stack([polar[0], height[0]], axis=1)


def _knots(low: float, high: float, spans: int) -> Real:
    inner = np.linspace(low, high, spans + 1)[1:-1]
    return np.concatenate([np.full(_DEGREE + 1, low), inner, np.full(_DEGREE + 1, high)])


def _greville(knots: Real) -> Real:
    """One place for each pole: the mean of its inner knots."""
    found = np.array([knots[i + 1 : i + _DEGREE + 1].mean() for i in range(len(knots) - _DEGREE - 1)])
    found[0], found[-1] = knots[0], knots[-1]
    return found


def _matrix(knots: Real, t: Real) -> Real:
    """Values of all basis functions, (places, poles)."""
    first, values = basis(_DEGREE, knots, t)
    matrix = np.zeros((len(t), len(knots) - _DEGREE - 1))
    np.put_along_axis(matrix, first[:, None] + np.arange(_DEGREE + 1), values, axis=1)
    return matrix


def _error(cam: BarrelCam, spline: WallSpline) -> float:
    """Greatest distance of samples from the wall, of its ends from the cylinders, and of these from their paths."""
    spans = len(spline.along) - 2 * _DEGREE - 1
    u = np.linspace(spline.along[0], spline.along[-1], _SAMPLES * spans + 4)
    v = np.linspace(0, 1, 4 * (len(spline.across) - 2 * _DEGREE - 1) + 5)
    along = _matrix(spline.along, u)
    points = np.einsum("ui,vj,ijc->uvc", along, _matrix(spline.across, v), spline.poles)
    worst = float(np.abs(cam.distance(points.reshape(-1, 3)) - cam.radius).max())
    for row, radius, poles in ((0, cam.inner, spline.edges[0]), (-1, cam.outer, spline.edges[1])):
        polar, height = (along @ poles).T
        path = np.stack([radius * np.cos(polar), radius * np.sin(polar), height], axis=1)
        worst = max(worst, float(np.linalg.norm(points[:, row] - path, axis=1).max()))
    return worst

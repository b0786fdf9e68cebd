"""The walls of a cylindrical cam as B-spline surfaces with finished poles.

One surface for each piece of the motion, cut where the roller rests, over the cam angle and the share of the way from
the inner to the outer cylinder: the walls are analytic there. Poles interpolate the exact wall at Greville's places.
"""

from __future__ import annotations

from functools import partial
from itertools import pairwise

import numpy as np

from geometry.approximation.outline import Outline, spline_outline
from geometry.approximation.tensor import clamped, greville, tensor_poles
from geometry.base.errors import ConvergenceError
from geometry.base.record import Record, replace
from geometry.cams.barrel.cam import BarrelCam
from geometry.curves.bounds import Bound
from geometry.curves.bspline import basis_matrix
from geometry.curves.curve import Real
from geometry.laws.piece import LawPiece, sign_changes
from geometry.plane.profile import Profile

_DEGREE = 7
# the kernel joins curves and surfaces within 1e-7 mm: up to a tolerance of 1e-6 mm edges are kept well below that
_TARGET, _SHARE = 2e-8, 0.02
_MARGIN = 1.5
_ACROSS = (1, 2, 3, 4, 6, 8, 12, 16, 24, 32)
_ROUNDS, _MOST_SPANS = 24, 1000
# samples a span, none at the places of interpolation
_SAMPLES = 13
# the roller rests where S' is below this part of its peak; no stretch is shorter than this part of its piece
_STILL, _LEAST_STRETCH, _REST_SAMPLES = 1e-12, 1e-6, 65
# dwells are cut into parts of at most this, rad
_MOST_DWELL = 2.1
# rounding of fitting and measuring, part of the size
_ROUNDING = 3e-15


class Stretch(Record):
    """Cam angles ``start`` to ``end`` (rad) of one piece of the motion.

    ``rests``: the roller stands still at the start. ``turns``: how often the cam has gone round since the first one.
    """

    piece: LawPiece
    start: float
    end: float
    rests: bool
    turns: int = 0


class WallSpline(Record, eq=False):
    """A tensor product over cam angle and share: knots both ways, poles (n, m, 3) mm."""

    side: int
    stretch: Stretch
    along: Real
    across: Real
    poles: Real
    max_error: float

    @property
    def degree(self) -> int:
        """Both ways."""
        return _DEGREE


class BarrelSplines(Record, eq=False):
    """All walls as splines, in the order of the motion's stretches, side by side, the bore, and the worst error, mm."""

    walls: dict[int, tuple[WallSpline, ...]]
    bore: Outline | None
    max_error: float
    bound: Bound = "sampled"


def barrel_splines(cam: BarrelCam, tolerance: float, bore: Profile | None = None) -> BarrelSplines:
    """Splines within ``tolerance`` mm of the walls, and within what the kernel calls one point of the cylinders.

    Raises
    ------
    ConvergenceError
        1000 spans are not enough.
    """
    target = max(min(tolerance, max(_TARGET, _SHARE * tolerance)) / _MARGIN, 4 * _ROUNDING * cam.outer)
    found = stretches(cam)
    walls = {}
    for side in cam.sides:
        # one knot vector across: neighbours share the edge between them
        across = max((_across(cam, side, stretch, target) for stretch in found), key=len)
        walls[side] = tuple(_fitted(cam, side, stretch, across, target) for stretch in found)
    hole = None if bore is None else spline_outline(bore, tolerance, degree=_DEGREE, continuity=_DEGREE - 1)
    worst = _MARGIN * max(w.max_error for found in walls.values() for w in found)
    return BarrelSplines(walls, hole, worst if hole is None else max(worst, hole.max_error))


def stretches(cam: BarrelCam) -> list[Stretch]:
    """The motion from a rest of the roller on, cut at all its rests; long dwells are cut too."""
    pieces = cam.motion.pieces
    peak = max(float(np.abs(p.value(np.linspace(*p.domain, _REST_SAMPLES), 1)).max()) for p in pieces)
    found: list[Stretch] = []
    for piece in pieces:
        if piece.is_constant:
            parts = int(np.ceil((piece.end - piece.start) / _MOST_DWELL))
            places = np.linspace(piece.start, piece.end, parts + 1).tolist()
        else:
            inner = sign_changes(partial(piece.value, order=1), np.linspace(*piece.domain, _REST_SAMPLES))
            least = _LEAST_STRETCH * (piece.end - piece.start)
            kept = inner[(inner > piece.start + least) & (inner < piece.end - least)]
            places = [piece.start, *kept.tolist(), piece.end]
        for k, (start, end) in enumerate(pairwise(places)):
            rests = k > 0 or abs(float(piece.value(start, 1))) <= _STILL * peak
            found.append(Stretch(piece, start, end, rests))
    first = next(k for k, stretch in enumerate(found) if stretch.rests)
    return [*found[first:], *(replace(stretch, turns=1) for stretch in found[:first])]


def _fitted(cam: BarrelCam, side: int, stretch: Stretch, across: Real, target: float) -> WallSpline:
    """The spline on knots that are halved where its error is above the target."""
    breaks = np.array([stretch.start, stretch.end])
    for _ in range(_ROUNDS):
        made, errors = _interpolated(cam, side, stretch, breaks, across)
        wide = np.flatnonzero(errors > target)
        if not len(wide) or len(breaks) + len(wide) > _MOST_SPANS:
            break
        breaks = np.sort(np.concatenate([breaks, (breaks[wide] + breaks[wide + 1]) / 2]))
    if made.max_error > target:
        raise ConvergenceError("spline surfaces of the walls", made.max_error, len(breaks))
    return made


def _across(cam: BarrelCam, side: int, stretch: Stretch, target: float) -> Real:
    """Knots across the wall, evenly spread: as many as lines across it need."""
    angles = np.linspace(stretch.start, stretch.end, 2 * _REST_SAMPLES)[1:-1:4]
    for spans in _ACROSS:
        knots = clamped(_DEGREE, np.linspace(0.0, 1.0, spans + 1))
        places, between = greville(_DEGREE, knots), np.linspace(0, 1, 11 * spans + 3)
        exact = [cam.wall(angles[:, None], side, cam.inner + v * (cam.outer - cam.inner), stretch.piece)
                 for v in (places, between)]  # fmt: skip
        weights = basis_matrix(_DEGREE, knots, between) @ np.linalg.inv(basis_matrix(_DEGREE, knots, places))
        if np.abs(np.einsum("ij,ajc->aic", weights, exact[0]) - exact[1]).max() <= target / 3:
            break
    return knots


def _interpolated(cam: BarrelCam, side: int, stretch: Stretch, breaks: Real, v_knots: Real) -> tuple[WallSpline, Real]:
    """The spline on given knots, and the errors of its spans along the wall."""
    u_knots = clamped(_DEGREE, breaks)
    u, v = greville(_DEGREE, u_knots), greville(_DEGREE, v_knots)
    radii = cam.inner + v * (cam.outer - cam.inner)
    poles = tensor_poles(_DEGREE, u_knots, v_knots, cam.wall(u[:, None], side, radii, stretch.piece))
    made = WallSpline(side, stretch, u_knots, v_knots, poles, 0.0)
    errors = _errors(cam, made, breaks)
    return replace(made, max_error=float(errors.max())), errors


def _errors(cam: BarrelCam, spline: WallSpline, breaks: Real) -> Real:
    """Greatest errors of each span: of samples from the wall, of its rims from both cylinders."""
    share = np.linspace(0, 1, _SAMPLES)
    u = (breaks[:-1, None] + np.diff(breaks)[:, None] * share).ravel()
    v = np.linspace(0, 1, 4 * (len(spline.across) - 2 * _DEGREE - 1) + 5)
    along = basis_matrix(_DEGREE, spline.along, u)
    points = np.einsum("ui,vj,ijc->uvc", along, basis_matrix(_DEGREE, spline.across, v), spline.poles)
    away = cam.distance(points.reshape(-1, 3), np.repeat(u, len(v)))
    worst = np.abs(away).reshape(len(u), len(v)).max(axis=1)
    for row, radius in ((0, cam.inner), (-1, cam.outer)):
        worst = np.maximum(worst, np.abs(np.hypot(points[:, row, 0], points[:, row, 1]) - radius))
    return np.asarray(worst.reshape(-1, _SAMPLES).max(axis=1))

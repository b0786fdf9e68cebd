"""Flat rockers: where the axis of their cam may stand so that it is convex everywhere with a radius to spare.

The face stands at p = d sin psi - f from the axis, its normal turns against the cam by (1 + sense psi') d phi, so that
the cam's radius of curvature p + p'' (over the normal's angle) is, with w = 1 + sense psi',

    rho = d (A sin psi + B cos psi) - f,   A = (1 + 2 sense psi') / w^2,   B = psi'' / w^3.

Seen from the pivot, with the arm's lowest position along +x, the axis stands at d e^{i psi_0}: rho >= rho_min is a
half-plane for it at each cam angle, and the region of all of them is convex: the joint diagram of a flat rocker.
"""

from __future__ import annotations

import math

import numpy as np

from geometry.cams.follower_motion import FollowerMotion
from geometry.cams.synthesis import OscillatingAxis, greatest_of
from geometry.curve import Complex, Real
from geometry.errors import ConvergenceError, ParameterError, at_least
from geometry.motion_laws.piece import LawPiece

_MOST_CUTS = 80
_ROUNDING = 1e-12
# the line of centres stays this much (rad) less than square to the face: beyond, the push's arm changes its sign
_SQUARE = 1e-6


def curvature_terms(piece: LawPiece, t: Real, sense: int) -> tuple[Real, Real]:
    """A and B of rho = d (A sin psi + B cos psi) - f."""
    w = 1 + sense * piece.value(t, 1)
    return (2 * w - 1) / w**2, piece.value(t, 2) / w**3


def rocker_planes(piece: LawPiece, t: Real, sense: int, level: float) -> tuple[Complex, Real]:
    """Half-planes Re(conj(n) axis) >= b of the axis from the pivot, unit normals; ``level``: rho_min + f, mm."""
    a, b = curvature_terms(piece, t, sense)
    normal = (b + 1j * a) * np.exp(-1j * piece.value(t))
    size = np.abs(normal)
    return normal / size, level / size


def rocker_base(
    motion: FollowerMotion, centre_distance: float, sense: int, face_offset: float = 0.0, least_radius: float = 0.0
) -> OscillatingAxis:
    """The smallest convex cam for a pivot at a given distance; its ``prime_radius`` is the base circle's, mm.

    With M e^{i delta} = B + i A the condition reads |psi_0 + S - delta| <= arccos((rho_min + f) / (d M)).

    Raises
    ------
    ParameterError
        The rocker turns with the cam somewhere, or the pivot stands too near.
    ConvergenceError
        What one cam angle asks for another one forbids.
    """
    _check_turning(motion, sense)
    level, pieces = least_radius + face_offset, list(motion.pieces)

    def short(piece: LawPiece, t: Real) -> Real:
        return level / np.hypot(*curvature_terms(piece, t, sense))

    needed = greatest_of(pieces, short).value
    if not needed <= centre_distance:
        text = f"is too near for a convex cam; at least {at_least(needed, 4)} mm works"
        raise ParameterError("centre_distance", centre_distance, text)

    def end(piece: LawPiece, t: Real, side: int) -> Real:
        a, b = curvature_terms(piece, t, sense)
        room = np.arccos(np.clip(level / (centre_distance * np.hypot(a, b)), -1.0, 1.0))
        return side * (np.arctan2(a, b) - piece.value(t)) - room

    low, highest = motion.extremes()
    least = max(
        greatest_of(pieces, lambda p, t: end(p, t, 1)).value,
        math.asin(min(1.0, max(face_offset, 0.0) / centre_distance)) - min(low, 0.0),
    )
    most = min(-greatest_of(pieces, lambda p, t: end(p, t, -1)).value, math.pi / 2 - _SQUARE - highest)
    if not least <= most:
        raise ConvergenceError("axis of the flat rocker: no cam is convex at this distance", least - most, 1)
    return OscillatingAxis(centre_distance, least, centre_distance * math.sin(least) - face_offset)


def rocker_axis(
    motion: FollowerMotion, sense: int, face_offset: float = 0.0, least_radius: float = 0.0
) -> OscillatingAxis:
    """The smallest convex cam of all distances: the lowest corner of the region, found by cutting planes.

    Raises
    ------
    ParameterError
        The rocker turns with the cam somewhere, or rho_min + f is not above 0: then every size is like another.
    ConvergenceError
        No axis keeps the condition.
    """
    _check_turning(motion, sense)
    level = least_radius + face_offset
    if not level > 0:
        raise ParameterError("least_curvature_radius", least_radius, f"above {max(0.0, -face_offset):.6g} mm works")
    highest = motion.extremes()[1] + _SQUARE
    # over the face, and the line of centres less than square to it
    planes = [(1j, max(face_offset, 0.0)), (complex(np.exp(-1j * highest)), 0.0)]
    axis = complex(max(face_offset, 0.0) * math.tan(highest), max(face_offset, 0.0))
    for _ in range(_MOST_CUTS):
        cuts = [_cut(p, sense, level, axis) for p in motion.pieces]
        worst = max(cut[2] for cut in cuts)
        if worst <= _ROUNDING * (level + abs(axis)):
            return OscillatingAxis(abs(axis), float(np.angle(axis)), axis.imag - face_offset)
        planes += [(n, b) for n, b, depth in cuts if depth > 0]
        axis = _lowest(planes)
    raise ConvergenceError("axis of the flat rocker", worst, _MOST_CUTS)


def _check_turning(motion: FollowerMotion, sense: int) -> None:
    low, high = motion.extremes(1)
    if not 1 + min(sense * low, sense * high) > 0:
        raise ParameterError("sense", sense, "the rocker turns as fast as the cam; longer phases work")


def _cut(piece: LawPiece, sense: int, level: float, axis: complex) -> tuple[complex, float, float]:
    """The half-plane of a piece that the axis breaks most, and by how much, mm."""

    def depth(own: LawPiece, t: Real) -> Real:
        normal, b = rocker_planes(own, t, sense, level)
        return b - (np.conj(normal) * axis).real

    found = greatest_of([piece], depth)
    normal, b = rocker_planes(piece, np.asarray(found.angle), sense, level)
    return complex(normal), float(b), found.value


def _lowest(planes: list[tuple[complex, float]]) -> complex:
    """The corner of an intersection of half-planes that has the least y."""
    normals, levels = np.array([n for n, _ in planes]), np.array([b for _, b in planes])
    i, j = np.triu_indices(len(planes), 1)
    whole = (np.conj(normals[i]) * normals[j]).imag
    with np.errstate(divide="ignore", invalid="ignore"):
        corners = 1j * (levels[j] * normals[i] - levels[i] * normals[j]) / whole
    corners = corners[np.isfinite(corners)]
    slack = (np.conj(normals)[:, None] * corners).real - levels[:, None]
    good = corners[np.all(slack >= -_ROUNDING * (np.abs(corners) + np.abs(levels[:, None])), axis=0)]
    if not good.size:
        raise ConvergenceError("axis of the flat rocker: no axis makes a convex cam", 0.0, len(planes))
    return complex(good[np.argmin(good.imag)])

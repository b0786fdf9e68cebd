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

from geometry.base.errors import ConvergenceError, ParameterError
from geometry.cams.motion.follower_motion import FollowerMotion
from geometry.cams.plane.disk import slowest_turning
from geometry.cams.plane.synthesis import OscillatingAxis, greatest_of
from geometry.curves.curve import Complex, Real
from geometry.laws.piece import LawPiece
from geometry.laws.stack import Indices

# the line of centres stays this much (rad) less than square to the face: beyond, the push's arm changes its sign
_SQUARE = 1e-6


def curvature_terms(rate: Real, bend: Real, sense: int) -> tuple[Real, Real]:
    """A and B of rho = d (A sin psi + B cos psi) - f, from psi' and psi''."""
    w = 1 + sense * rate
    return (2 * w - 1) / w**2, bend / w**3


def rocker_planes(piece: LawPiece, t: Real, sense: int, level: float) -> tuple[Complex, Real]:
    """Half-planes Re(conj(n) axis) >= b of the axis from the pivot, unit normals; ``level``: rho_min + f, mm."""
    a, b = curvature_terms(piece.value(t, 1), piece.value(t, 2), sense)
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
        The rocker turns with the cam somewhere.
    ConvergenceError
        The pivot stands too near, or what one cam angle asks for another one forbids.
    """
    if not slowest_turning(motion, sense) > 0:
        raise ParameterError("sense", sense, "flat_outruns_cam")
    level, stack = least_radius + face_offset, motion.stack

    def terms(k: Indices, t: Real) -> tuple[Real, Real]:
        rate, bend = stack.orders_at(k, t, (1, 2))
        return curvature_terms(rate, bend, sense)

    needed = greatest_of(stack, lambda k, t: level / np.hypot(*terms(k, t))).value
    if not needed <= centre_distance:
        raise ConvergenceError("axis of the flat rocker: its pivot stands too near for a convex cam", needed, 1)

    def end(k: Indices, t: Real, side: int) -> Real:
        a, b = terms(k, t)
        room = np.arccos(np.clip(level / (centre_distance * np.hypot(a, b)), -1.0, 1.0))
        return side * (np.arctan2(a, b) - stack.at(k, t)) - room

    low, highest = motion.extremes()
    least = max(
        greatest_of(stack, lambda k, t: end(k, t, 1)).value,
        math.asin(min(1.0, max(face_offset, 0.0) / centre_distance)) - min(low, 0.0),
    )
    most = min(-greatest_of(stack, lambda k, t: end(k, t, -1)).value, math.pi / 2 - _SQUARE - highest)
    if not least <= most:
        raise ConvergenceError("axis of the flat rocker: no cam is convex at this distance", least - most, 1)
    return OscillatingAxis(centre_distance, least, centre_distance * math.sin(least) - face_offset)

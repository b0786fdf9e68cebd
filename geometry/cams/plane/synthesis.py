"""Dynamic synthesis: the least sizes of a cam from the pressure angle, the transmission angle and the curvature.

Practicum, lessons 4 and 5: gamma_min is 90 degrees less the largest pressure angle; of a flat follower, whose
pressure angle is 0, the "45 degrees" are the slope of a tangent to the joint diagram S(S''), which says
rho = r_0 + S + S'' >= 0. Its r_0 of lesson 5 is the prime circle. R_min = r_0 + rho for rho = 10 to 15 mm.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache

import numpy as np

from geometry.base.errors import ConvergenceError, ParameterError
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.cams.motion.follower_motion import FollowerMotion, PhaseKind
from geometry.cams.motion.guides import oscillating_prime_radius
from geometry.cams.plane.disk import DiskCam, FollowerKind, translating_cam
from geometry.curves.curve import Complex, Real
from geometry.laws.stack import Indices, PieceFunction, PieceStack

# of a base circle, before the search gives up
_DOUBLINGS = 40
_SAMPLES = 257
_LEAST_SAMPLES, _MOST_ARGUMENTS = 9, 32_768
_REFINEMENTS, _MOST_ZOOMED = 8, 16
_MOST_CUTS = 60
# of the arm, by which a half-plane may be broken: more than what `_nearest` lets pass as rounding
_BROKEN = 1e-11


class Extreme(Record):
    """A greatest or least value and the cam angle (rad) at which it stands."""

    value: float
    angle: float


def greatest_of(
    stack: PieceStack, function: PieceFunction, slope: PieceFunction | None = None, pieces: Indices | None = None
) -> Extreme:
    """Greatest value of a function of each piece: at its ends, where its slope changes sign, or by zooming in.

    ``pieces``: the numbers of those that count (None: all). The few in which the greatest samples stand are zoomed in.
    """
    chosen = np.arange(len(stack.starts)) if pieces is None else pieces
    if not chosen.size:
        return Extreme(-math.inf, 0.0)
    samples = max(_LEAST_SAMPLES, min(_SAMPLES, _MOST_ARGUMENTS // len(chosen)))
    if slope is not None:
        found, roots = stack.sign_changes(slope, samples, chosen)
        index = np.concatenate([chosen, found, chosen])
        t = np.concatenate([stack.starts[chosen], roots, stack.ends[chosen]])
        ranks = np.lexsort((t, index))
        index, t = index[ranks], t[ranks]
        values = function(index, t)
        best = int(np.argmax(values))
        return Extreme(float(values[best]), float(t[best]))
    every, places = stack.rows(samples)
    index, t = every[chosen], places[chosen]
    for left in reversed(range(_REFINEMENTS + 1)):
        values = function(index, t)
        if left == _REFINEMENTS:
            zoomed = np.sort(np.argsort(-values.max(axis=1), kind="stable")[:_MOST_ZOOMED])
            index, t, values = index[zoomed], t[zoomed], values[zoomed]
        rows, at = np.arange(len(t)), values.argmax(axis=1)
        if left:
            low, high = t[rows, np.maximum(at - 1, 0)], t[rows, np.minimum(at + 1, t.shape[1] - 1)]
            t = np.linspace(low, high, _SAMPLES, axis=-1)
            index = np.broadcast_to(index[:, :1], t.shape)
    best = int(np.argmax(values[rows, at]))
    return Extreme(float(values[best, at[best]]), float(t[best, at[best]]))


def flat_base_radius(motion: FollowerMotion, least_curvature_radius: float = 0.0) -> Extreme:
    """Least base circle of a translating flat follower: rho_min - min(S + S''), mm; exact, and at which angle.

    With rho_min = 0 it is the practicum's r_0 by the tangent at 45 degrees; never below 0.
    """
    found = greatest_of(
        motion.stack,
        lambda k, t: -np.add(*motion.stack.orders_at(k, t, (0, 2))),
        lambda k, t: np.add(*motion.stack.orders_at(k, t, (1, 3))),
    )
    return Extreme(max(0.0, least_curvature_radius + found.value), found.angle)


class AxisRegion(Record):
    """Where the cam's axis may stand under a translating roller: s_0 >= a - e c for every (a, c) in ``lines``.

    The half-lines touch the diagram S(S') and are inclined by the pressure angles; (e, s_0) is the axis' place
    beside and below the roller's lowest centre.
    """

    lines: tuple[tuple[float, float], ...]

    def least_height(self, offset: float) -> float:
        """Least s_0 for an offset, mm."""
        return max(0.0, *(a - offset * c for a, c in self.lines))

    def least_prime_radius(self, offset: float) -> float:
        """Least R_p for an offset, mm: hypot(e, s_0)."""
        return math.hypot(offset, self.least_height(offset))


def axis_region(motion: FollowerMotion, rise_limit: float, return_limit: float | None = None) -> AxisRegion:
    """Axes for which |nu| <= ``rise_limit`` on rises and, where one is given, ``return_limit`` on returns, rad.

    Force closure needs no limit on returns, where the cam does not drive.

    Raises
    ------
    ParameterError
        A limit not above 0 and below 90 degrees, or a motion that never rises.
    """
    lines, stack = [], motion.stack
    for pieces, limit in _limited(motion, rise_limit, return_limit):
        cot = 1 / math.tan(limit)
        for steepness in (cot, -cot):

            def height(k: Indices, t: Real, steepness: float = steepness) -> Real:
                lift, rise = stack.orders_at(k, t, (0, 1))
                return steepness * rise - lift

            def slope(k: Indices, t: Real, steepness: float = steepness) -> Real:
                rise, bend = stack.orders_at(k, t, (1, 2))
                return steepness * bend - rise

            lines.append((greatest_of(stack, height, slope, pieces).value, steepness))
    return AxisRegion(tuple(lines))


def _limited(motion: FollowerMotion, rise_limit: float, return_limit: float | None) -> list[tuple[Indices, float]]:
    """The pieces of rises and, where they have a limit, of returns, each with the greatest |nu| there, rad."""
    limits = [("rise_limit", rise_limit, PhaseKind.RISE)]
    if return_limit is not None:
        limits.append(("return_limit", return_limit, PhaseKind.RETURN))
    found = []
    for name, limit, kind in limits:
        if not 0 < limit < math.pi / 2:
            raise ParameterError(name, limit, "not_within", low=0.0, high=math.pi / 2)
        if not (pieces := motion.moving(kind)).size:
            raise ParameterError("motion", 0, "no_such_phase", move=str(kind.value))
        found.append((pieces, limit))
    return found


def roller_prime_radius(
    motion: FollowerMotion, offset: float, rise_limit: float, return_limit: float | None = None
) -> float:
    """Least prime circle of a translating roller with an offset, mm: practicum, lesson 5.

    Raises
    ------
    ParameterError
        See ``axis_region``.
    """
    return axis_region(motion, rise_limit, return_limit).least_prime_radius(offset)


@lru_cache(maxsize=16)
def greatest_pressure_angle(cam: DiskCam, kind: PhaseKind | None = None) -> Extreme:
    """The greatest |nu| (rad) on rises, on returns or anywhere, and its cam angle."""
    stack = cam.motion.stack

    def size(k: Indices, t: Real) -> Real:
        return np.abs(cam.pressure_angle(_before_end(stack, k, t)))

    return greatest_of(stack, size, pieces=cam.motion.moving(kind))


def _before_end(stack: PieceStack, k: Indices, t: Real) -> Real:
    """Cam angles within the pieces: one at a piece's end belongs to the next."""
    return np.minimum(t, np.nextafter(stack.ends[k], 0))


@lru_cache(maxsize=16)
def least_convex_radius(cam: DiskCam) -> Extreme:
    """Least radius of curvature of the cam where it is convex (of a flat follower: anywhere), mm.

    At or below 0 it is undercut; for the path of a roller's centre add the roller's radius.
    """

    def bending(k: Indices, t: Real) -> Real:
        radius = cam.curvature_radius(_before_end(cam.motion.stack, k, t)) + cam.radius
        # the curvature is smooth where the radius jumps through infinity; a flat's radius is smooth itself
        return -radius if cam.is_flat else 1 / radius

    found = greatest_of(cam.motion.stack, bending)
    value = -found.value if cam.is_flat else (1 / found.value - cam.radius if found.value > 0 else math.inf)
    return Extreme(value, found.angle)


def least_hollow_radius(cam: DiskCam) -> Extreme:
    """Least radius of curvature of the roller centre's path where it is hollow, mm: inf where it is nowhere.

    The outer wall of a groove is whole where the roller, with its play, is smaller.
    """

    def hollow(k: Indices, t: Real) -> Real:
        return -1 / cam.pitch_curvature_radius(_before_end(cam.motion.stack, k, t))

    found = greatest_of(cam.motion.stack, hollow)
    return Extreme(1 / found.value if found.value > 0 else math.inf, found.angle)


# as long as the scene is asked anew for one cam
@lru_cache(maxsize=16)
def convex_roller_base_radius(
    motion: FollowerMotion, radius: float, least_curvature_radius: float, *, follower_offset: float = 0.0
) -> float:
    """Least base circle on which a roller's cam keeps a least convex radius of curvature, mm.

    Raises
    ------
    ConvergenceError
        None is found up to a million million times the sizes given.
    """

    def excess(base: float) -> float:
        return _convex_excess(motion, radius, least_curvature_radius, base, follower_offset)

    low = max(abs(follower_offset) * (1 + 1e-9) - radius, 1e-3 * radius)
    if excess(low) >= 0:
        return low
    high = 2 * (low + radius + motion.lift)
    for _ in range(_DOUBLINGS):
        if excess(high) > 0:
            return bracketed_root(excess, low, high).value
        low, high = high, 2 * high
    raise ConvergenceError("base radius for the curvature", excess(high), _DOUBLINGS)


def keeps_convex_radius(motion: FollowerMotion, radius: float, least_curvature_radius: float, base: float) -> bool:
    """Whether a roller's cam on a base circle, mm, keeps a least convex radius of curvature."""
    return _convex_excess(motion, radius, least_curvature_radius, base) >= 0


def _convex_excess(
    motion: FollowerMotion, radius: float, least_curvature_radius: float, base: float, follower_offset: float = 0.0
) -> float:
    cam = translating_cam(motion, FollowerKind.ROLLER, base, radius=radius, follower_offset=follower_offset)
    return least_convex_radius(cam).value - least_curvature_radius


def convex_rocker_base_radius(cam_at: Callable[[float], DiskCam], least: float, most: float, rho: float) -> float:
    """Least base circle from ``least`` on, mm, on which ``cam_at`` keeps a convex radius of curvature of ``rho``.

    ``least`` itself where it is kept there, or not even at ``most``.
    """

    def excess(base: float) -> float:
        return least_convex_radius(cam_at(base)).value - rho

    if excess(least) >= 0 or not excess(most) > 0:
        return least
    return bracketed_root(excess, least, most).value


def least_pitch_radius(cam: DiskCam) -> float:
    """Least radius of curvature of the path of a roller's centre where it is convex, mm: a larger roller undercuts."""
    return least_convex_radius(cam).value + cam.radius


class OscillatingAxis(Record):
    """Where the smallest cam of an oscillating roller has its axis: from the pivot, and the circle that follows."""

    centre_distance: float
    start_angle: float
    prime_radius: float


@lru_cache(maxsize=16)
def oscillating_axis(
    motion: FollowerMotion, arm_length: float, sense: int, rise_limit: float, return_limit: float | None = None
) -> OscillatingAxis:
    """The axis with the smallest prime circle for which |nu| stays within the limits, rad.

    tan nu = (L (1 + sense psi') - d cos psi)/(d sin psi) is, for each cam angle, a pair of half-planes for the axis;
    the region of all of them is convex, and its point nearest to the lowest roller centre is found by cutting planes.

    Raises
    ------
    ParameterError
        See ``axis_region``.
    ConvergenceError
        The half-planes have no common point.
    """
    pieces = _limited(motion, rise_limit, return_limit)
    home = complex(arm_length, 0.0)
    planes: list[tuple[complex, float]] = []
    axis = home
    for _ in range(_MOST_CUTS):
        cuts = [
            _deepest(motion.stack, group, arm_length, sense, limit, side, axis)
            for group, limit in pieces
            for side in (1.0, -1.0)
        ]
        worst = max(cuts, key=lambda c: c[2])
        if worst[2] <= _BROKEN * arm_length:
            distance = abs(axis)
            # corners of nearly parallel lines have lost digits: the angle is found anew
            low, high = oscillating_start_angles(motion, arm_length, distance, sense, rise_limit, return_limit)
            start = low if low < high else float(np.angle(axis))
            return OscillatingAxis(distance, start, oscillating_prime_radius(start, distance, arm_length))
        planes += [(n, b) for n, b, depth in cuts if depth > 0]
        axis = _nearest(home, planes)
    raise ConvergenceError("axis of the oscillating follower", worst[2], _MOST_CUTS)


def oscillating_start_angles(
    motion: FollowerMotion,
    arm_length: float,
    centre_distance: float,
    sense: int,
    rise_limit: float,
    return_limit: float | None = None,
) -> tuple[float, float]:
    """Least and greatest psi_0 (rad) for which |nu| stays within the limits (rad) at a centre distance, mm.

    With A = arccos(L (1 + sense psi') cos(limit) / d) the half-planes of ``oscillating_axis`` cut the circle of the
    axis about the pivot to |A - limit| <= psi_0 + S <= pi - |pi - A - limit| at each cam angle. The prime circle grows
    with psi_0. No psi_0 serves where the least one is above the greatest: inf where the pivot is too near at all.

    Raises
    ------
    ParameterError
        See ``axis_region``.
    """
    low, high, stack = 0.0, math.pi, motion.stack
    spots, places = stack.extremes(1)
    for pieces, limit in _limited(motion, rise_limit, return_limit):
        share = arm_length * math.cos(limit) / centre_distance

        mine = np.isin(spots, pieces)
        if not np.abs(share * (1 + sense * stack.at(spots[mine], places[mine], 1))).max() <= 1:
            return math.inf, high

        def greatest(a: int, b: int, pieces: Indices = pieces, share: float = share) -> float:
            """Of a A + b S."""

            def angle(k: Indices, t: Real) -> Real:
                turned, rate = stack.orders_at(k, t, (0, 1))
                return a * np.arccos(np.clip(share * (1 + sense * rate), -1, 1)) + b * turned

            def slope(k: Indices, t: Real) -> Real:
                # times the sine of A, which is never below 0
                rate, bend = stack.orders_at(k, t, (1, 2))
                sine = np.sqrt(np.clip(1 - (share * (1 + sense * rate)) ** 2, 0, 1))
                return b * rate * sine - a * share * sense * bend

            return greatest_of(stack, angle, slope, pieces).value

        low = max(low, greatest(1, -1) - limit, greatest(-1, -1) + limit)
        high = min(high, limit - greatest(-1, 1), 2 * math.pi - limit - greatest(1, 1))
    return low, high


def _deepest(
    stack: PieceStack, pieces: Indices, arm: float, sense: int, limit: float, side: float, axis: complex
) -> tuple[complex, float, float]:
    """The half-plane Re(conj(n) axis) >= b that is broken most, and by how much, mm.

    The axis is seen from the pivot, with the arm's lowest position along +x.
    """

    def normal(turned: Real) -> Complex:
        along = np.exp(-1j * turned)
        return (math.tan(limit) * 1j * along + side * along) * math.cos(limit)

    def plane(k: Indices, t: Real) -> tuple[Complex, Real]:
        turned, rate = stack.orders_at(k, t, (0, 1))
        return normal(turned), side * arm * (1 + sense * rate) * math.cos(limit)

    def depth(k: Indices, t: Real) -> Real:
        across, level = plane(k, t)
        return level - (np.conj(across) * axis).real

    def slope(k: Indices, t: Real) -> Real:
        turned, rate, bend = stack.orders_at(k, t, (0, 1, 2))
        return side * arm * sense * math.cos(limit) * bend + rate * (np.conj(normal(turned)) * axis).imag

    found = greatest_of(stack, depth, slope, pieces)
    at = np.asarray(found.angle)
    k = np.asarray(next(k for k in pieces if stack.starts[k] <= found.angle <= stack.ends[k]))
    across, level = plane(k, at)
    return complex(across), float(level), found.value


def _nearest(home: complex, planes: list[tuple[complex, float]]) -> complex:
    """The point of an intersection of half-planes nearest to ``home``: a foot on one line or a corner of two."""
    normals, levels = np.array([n for n, _ in planes]), np.array([b for _, b in planes])
    feet = home + normals * (levels - (np.conj(normals) * home).real)
    i, j = np.triu_indices(len(planes), 1)
    whole = (np.conj(normals[i]) * normals[j]).imag
    with np.errstate(divide="ignore", invalid="ignore"):
        corners = 1j * (levels[j] * normals[i] - levels[i] * normals[j]) / whole
    found = np.concatenate([[home], feet, corners[np.isfinite(corners)]])
    slack = (np.conj(normals)[:, None] * found).real - levels[:, None]
    good = found[np.all(slack >= -1e-12 * (abs(home) + np.abs(levels[:, None])), axis=0)]
    if not good.size:
        raise ConvergenceError("axis of the oscillating follower: no axis keeps the pressure angles", 0.0, len(planes))
    return complex(good[np.argmin(np.abs(good - home))])

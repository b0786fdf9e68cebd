"""Undercut: where the follower, in another position, takes away the point that it should touch.

Three layers are seen by one test. The point of the envelope that belongs to a cam angle stays if no other position
of the follower reaches into it: a roller's centre nearer than its radius, a face below the point. That covers the
local cusp (radius of curvature below the roller's), loops between distant arcs, and a groove wall cut from afar.
Whether anything is lost at all is decided without sweeping: a regular envelope that runs once around the axis with
a monotone polar angle has no double point, and then the strip between path and envelope is simply covered
(DERIVATIONS.md, section 8).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from itertools import pairwise

import numpy as np

from geometry.base.distinct import distinct
from geometry.base.errors import UndercutError
from geometry.base.record import Record
from geometry.base.roots import bracketed_root
from geometry.base.tolerance import TOLERANCES
from geometry.cams.motion.follower_motion import TURN
from geometry.cams.plane.curves import CentreEnvelope, FaceEnvelope
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.lost_lift import greatest_loss
from geometry.curves.curve import Complex, Real
from geometry.laws.piece import sign_changes
from geometry.plane.nearby import have_near

# samples a piece of the motion: of the quick test, and of the sweep that finds what is lost
_QUICK_SAMPLES = 129
_SWEEP_SAMPLES = 361
# on each row of a table at least, and on all of them together as on so many phases
_LEAST_ON_ROW, _PHASES = 4, 8
_NEWTON_STEPS = 40
# shares of a piece's length from its ends at which small loops are looked for
_CROWD = 10.0 ** -np.linspace(1, 12, 89)
# a follower reaches into a point if it does so by more than this part of the cam's size
_REACH = 1e-9
# of the way from cusp to cusp, or to the end of a piece: the crossing of a loop surely lies farther beyond both
_BEYOND_CUSPS = 0.3
# and of the lost samples the first cusp lies within this share
_CUSP_SHARE = _BEYOND_CUSPS / (1 + 2 * _BEYOND_CUSPS)


class Gap(Record):
    """Cam angles between which the follower rides on a corner instead of its own profile, and what that costs.

    ``end`` may lie beyond one turn; ``corner`` in the cam's frame, mm; ``lost_lift`` in the unit of the lift.
    """

    start: float
    end: float
    corner: complex
    lost_lift: float


class Kept(Record):
    """Arcs of cam angle whose envelope remains, in order, and the gaps between them (none: the cam is whole)."""

    arcs: tuple[tuple[float, float], ...]
    gaps: tuple[Gap, ...]


def is_whole(cam: DiskCam, grow: float = 0.0) -> bool:
    """Whether the quick test proves (to its sampling) that nothing is undercut."""
    for curve, t in _curves(cam, grow, _QUICK_SAMPLES):
        if least_stretch(curve, t) <= 0:
            return False
        point, rate = curve.point(t), curve.derivative(t)
        if not np.all((np.conj(point) * rate).imag < 0):
            return False
    return cam.motion.tabled or not _has_lost_corner(cam, grow)


def _folds(cam: DiskCam, grow: float) -> bool:
    """Whether the envelope stands still or runs back somewhere: its material has no radius of curvature left there."""
    return any(least_stretch(curve, t) <= 0 for curve, t in _curves(cam, grow, _QUICK_SAMPLES))


def _curves(cam: DiskCam, grow: float, samples: int) -> list[tuple[CentreEnvelope | FaceEnvelope, Real]]:
    """The envelope over each piece of the motion with even samples; over a table in one, with some on each row."""
    if not cam.motion.tabled:
        curves = [cam.curve(piece, grow) for piece in cam.motion.pieces]
        return [(curve, np.linspace(*curve.domain, samples)) for curve in curves]
    stack = cam.motion.stack
    each = max(_LEAST_ON_ROW, -(-_PHASES * samples // len(stack.starts)))
    t = np.append(stack.rows(each + 1)[1][:, :-1].ravel(), TURN)
    return [(cam.table_curve(0.0, TURN, grow), t)]


def least_stretch(curve: CentreEnvelope | FaceEnvelope, t: Real) -> float:
    """Least speed of the envelope in the direction in which a whole cam runs, near samples refined once."""
    function = _forward(curve)
    values = function(t)
    lowest = int(np.argmin(values))
    near = np.linspace(t[max(lowest - 1, 0)], t[min(lowest + 1, len(t) - 1)], len(t))
    return float(min(values.min(), function(near).min()))


def _forward(curve: CentreEnvelope | FaceEnvelope) -> Callable[[Real], Real]:
    if isinstance(curve, FaceEnvelope):
        return lambda t: -curve.stretch(t)
    return curve.stretch


def _has_lost_corner(cam: DiskCam, grow: float) -> bool:
    """Whether at a jump of velocity the envelope steps back: then both sides cross beyond the joint."""
    pieces = cam.motion.pieces
    for index, piece in enumerate(pieces):
        before = cam.curve(pieces[index - 1], grow)
        after = cam.curve(piece, grow)
        start, end = complex(before.point(before.end)), complex(after.point(after.start))
        if abs(end - start) <= 1e-12 * abs(start):
            continue
        # the envelope runs clockwise; a step the other way is a loop
        if (start.conjugate() * (end - start)).imag > 0:
            return True
    return False


# the checks of a cam ask for them, and then its shape, walls and drawings
@lru_cache(maxsize=16)
def kept_arcs(cam: DiskCam, grow: float = 0.0) -> Kept:
    """What remains of the envelope of a cam, and what is lost.

    Raises
    ------
    UndercutError
        Nothing remains, or what remains does not hang together.
    """
    if is_whole(cam, grow):
        return Kept(((0.0, TURN),), ())
    angles, index, points = _samples(cam, grow)
    # small loops run back though nothing reaches far into them
    reached = _reached(cam, grow, angles, points)
    stays = ~(reached | _looped(cam, grow, angles, index))
    if np.all(stays):
        return Kept(((0.0, TURN),), ())
    if not np.any(stays):
        raise UndercutError("base_circle_radius", cam.base_radius, "nothing_left_of_profile")
    # runs of samples that stay, cyclic: begin after a lost sample
    first = int(np.flatnonzero(~stays)[-1]) + 1
    order = (np.arange(len(angles)) + first) % len(angles)
    flags = stays[order]
    edges = np.flatnonzero(np.diff(np.concatenate([[0], flags.astype(int), [0]])))
    runs = [(int(order[a]), int(order[b - 1])) for a, b in zip(edges[::2], edges[1::2], strict=True)]
    # a run of one sample is noise of the sweep beside a crossing
    runs = [r for r in runs if r[0] != r[1]] or runs
    crossings = []
    for k, (_, last) in enumerate(runs):
        beginning = runs[(k + 1) % len(runs)][0]
        seen = np.any(np.roll(reached, -last)[: (beginning - last) % len(angles)])
        ends = (angles[last], index[last]), (angles[beginning], index[beginning])
        try:
            found = _crossing(cam, grow, *ends)
        except UndercutError:
            if seen:
                raise
            found = None
        if not seen and (found is None or (found[1] - found[0]) % TURN > math.pi):
            found = _closing(cam, grow, *ends)
        if found is not None:
            crossings.append(found)
    if not crossings:
        return Kept(((0.0, TURN),), ())
    arcs, gaps = [], []
    for k, (leave, enter, corner) in enumerate(crossings):
        begin = crossings[k - 1][1]
        arcs.append((float(begin), float(leave if leave > begin else leave + TURN)))
        end = enter if enter > leave else enter + TURN
        gaps.append(Gap(float(leave), float(end), corner, greatest_loss(cam, leave, end, corner, grow - cam.radius)))
    return Kept(tuple(arcs), tuple(gaps))


def lost_to_undercut(cam: DiskCam, grow: float = 0.0) -> float | None:
    """Greatest lift that undercut takes, mm (rad if oscillating); None of a whole cam.

    0 where it is too small to be seen, inf where nothing is left.
    """
    try:
        lost = max((g.lost_lift for g in kept_arcs(cam, grow).gaps), default=None)
    except UndercutError:
        return math.inf
    if lost is None:
        return 0.0 if _folds(cam, grow) else None
    return lost if lost > _REACH * (1.0 if cam.swings else cam.base_radius) else 0.0


def is_uncut(cam: DiskCam, grow: float = 0.0) -> bool:
    """Whether nothing is lost to undercut, without asking how much: ``lost_to_undercut`` is None."""
    if is_whole(cam, grow):
        return True
    if _folds(cam, grow):
        return False
    angles, _, points = _samples(cam, grow)
    return not bool(_reached(cam, grow, angles, points).any())


def _samples(cam: DiskCam, grow: float) -> tuple[Real, np.ndarray, Complex]:
    """Cam angles, the piece of each, and the envelope's points; both sides of every joint.

    Even steps, and crowds where a small loop may hide: at the ends of the pieces and about every cusp.
    """
    angles, index, points = [], [], []
    if cam.motion.tabled:
        ((curve, even),) = _curves(cam, grow, _SWEEP_SAMPLES // 3)
        t = distinct(np.clip(np.concatenate([even, *_about_cusps(curve, even)]), 0.0, TURN))
        return t, cam.motion.stack.index(t), curve.point(t)
    for k, piece in enumerate(cam.motion.pieces):
        curve = cam.curve(piece, grow)
        length = piece.end - piece.start
        near = length * _CROWD
        even = np.linspace(*piece.domain, 9 if piece.is_constant else _SWEEP_SAMPLES)
        cusps = [] if piece.is_constant else _about_cusps(curve, np.linspace(*curve.domain, _QUICK_SAMPLES))
        t = distinct(np.clip(np.concatenate([even, piece.start + near, piece.end - near, *cusps]), *piece.domain))
        angles.append(t)
        index.append(np.full(len(t), k))
        points.append(curve.point(t))
    return np.concatenate(angles), np.concatenate(index), np.concatenate(points)


def _cusps(curve: CentreEnvelope | FaceEnvelope, t: Real) -> Real:
    """Where the envelope turns back, by samples that are finer where it is slowest."""
    forward = _forward(curve)
    lowest = int(np.argmin(forward(t)))
    near = np.linspace(t[max(lowest - 1, 0)], t[min(lowest + 1, len(t) - 1)], _QUICK_SAMPLES)
    return sign_changes(forward, distinct(np.concatenate([t, near])))


def _about_cusps(curve: CentreEnvelope | FaceEnvelope, t: Real) -> list[Real]:
    """Crowded samples about each pair of cusps: a loop reaches a few times their distance beyond them."""
    pairs = pairwise(_cusps(curve, t).tolist())
    return [np.linspace(a - 3 * (b - a), b + 3 * (b - a), _QUICK_SAMPLES) for a, b in pairs]


def _looped(cam: DiskCam, grow: float, angles: Real, index: np.ndarray) -> np.ndarray:
    """Which samples lie where the envelope runs back, or so near to it that its loop begins before them."""
    result = np.zeros(len(angles), dtype=bool)
    for k, (curve, even) in enumerate(_curves(cam, grow, _QUICK_SAMPLES)):
        edges = [curve.start, *_cusps(curve, even).tolist(), curve.end]
        for a, b in pairwise(edges):
            if _forward(curve)(np.array([(a + b) / 2]))[0] < 0:
                more = _BEYOND_CUSPS * (b - a)
                result |= (cam.motion.tabled or index == k) & (angles > a - more) & (angles < b + more)
    return result


def _reached(cam: DiskCam, grow: float, angles: Real, points: Complex) -> np.ndarray:
    """Which points of the envelope another position of the follower reaches into."""
    size = float(np.abs(points).max())
    if cam.is_flat:
        result = np.zeros(len(points), dtype=bool)
        block = max(1, 4_000_000 // len(points))
        height, normal = FaceEnvelope(cam.motion, cam.mount, 0.0, TURN, grow).support(angles, 0)
        # how far each point lies over each position of the face: x cos + y sin - h
        faces = np.stack([np.cos(normal[0]), np.sin(normal[0]), -height[0]])
        places = np.stack([points.real, points.imag, np.ones(len(points))], axis=1)
        for i in range(0, len(points), block):
            result[i : i + block] = (places[i : i + block] @ faces).max(axis=1) > _REACH * size
        return result
    centres = CentreEnvelope(cam.motion, cam.mount, 0.0, TURN).point(angles)
    return have_near(points, centres, abs(grow - cam.radius) - _REACH * size)


def _crossing(
    cam: DiskCam, grow: float, first: tuple[float, int], second: tuple[float, int]
) -> tuple[float, float, complex]:
    """Where the envelope after ``first`` crosses that before ``second``: both cam angles and the point.

    Newton's method in the two angles, on the pieces that the ends of the lost part stand on.

    Raises
    ------
    UndercutError
        The two ends do not lead to a common point: the cam falls apart.
    """
    (a, i), (b, j) = first, second
    pieces = cam.motion.pieces
    best = math.inf, a, i, b, j
    for _ in range(_NEWTON_STEPS):
        left, right = cam.curve(pieces[i], grow), cam.curve(pieces[j], grow)
        (there, v), (here, u) = (map(complex, curve.derivatives(t, 1)) for curve, t in ((right, b), (left, a)))
        gap = there - here
        best = min(best, (abs(gap), a, i, b, j))
        whole = (u.conjugate() * v).imag
        if whole == 0:
            break
        # u da - v db = gap
        step_a, step_b = (gap.conjugate() * v).imag / whole, (gap.conjugate() * u).imag / whole
        limit = 0.05
        a, i = _moved(cam, a + float(np.clip(step_a, -limit, limit)), i)
        b, j = _moved(cam, b + float(np.clip(step_b, -limit, limit)), j)
        if max(abs(step_a), abs(step_b)) < 1e-15:
            break
    # where both all but touch, steps are noise
    _, a, i, b, j = best
    point = complex(cam.curve(pieces[i], grow).point(a))
    other = complex(cam.curve(pieces[j], grow).point(b))
    if (
        not abs(point - other) <= TOLERANCES.relative_join * max(abs(point), 1e-300)
        or abs(math.remainder(a - b, TURN)) < 1e-9
    ):
        raise UndercutError("base_circle_radius", cam.base_radius, "profile_falls_apart")
    return a, b, (point + other) / 2


def _closing(
    cam: DiskCam, grow: float, first: tuple[float, int], second: tuple[float, int]
) -> tuple[float, float, complex] | None:
    """Where the envelope before a loop is beside its place after it, of a loop that is flat in numbers; both angles.

    None where it is nowhere: then even its length is rounding.
    """
    (a, i), (b, j) = first, second
    curve = cam.curve(cam.motion.pieces[i], grow)
    point, along = complex(cam.curve(cam.motion.pieces[j], grow).point(b)), complex(curve.tangent(a))
    span = (b - a) % TURN

    def beyond(t: float) -> float:
        return ((complex(curve.point(t)) - point) * along.conjugate()).real

    low, high = max(a - span, curve.start), min(a + _CUSP_SHARE * span, curve.end)
    if not beyond(low) < 0 < beyond(high):
        return None
    found = bracketed_root(beyond, low, high).value
    near = abs(complex(curve.point(found)) - point) <= TOLERANCES.relative_join * abs(point)
    return (found, b, point) if near else None


def _moved(cam: DiskCam, angle: float, index: int) -> tuple[float, int]:
    """A cam angle folded into one turn, with the piece it stands on."""
    piece = cam.motion.pieces[index]
    if piece.start <= angle <= piece.end:
        return angle, index
    angle = angle % TURN
    starts = np.array([p.start for p in cam.motion.pieces])
    return angle, int(np.searchsorted(starts, angle, side="right")) - 1

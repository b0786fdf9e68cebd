"""A follower rolled over any closed outline: what a cut or printed cam does, whatever curves it was written with.

A roller of radius r over an outline is a point over its parallel curve p + r n; a face turns with the normal n. Every
edge is such a motion of (p, n), and so is the turn of n about a convex corner. Each says at which cam angles it is
touched and how high the follower stands then; the highest stop holds the follower.
"""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record
from geometry.base.tolerance import TOLERANCES
from geometry.cams.motion.follower_motion import TURN
from geometry.cams.motion.guides import Oscillating
from geometry.cams.plane.disk import DiskCam
from geometry.curves.curve import Complex, Real
from geometry.plane.contour import signed_area

Index = NDArray[np.int64]
# parts that every edge is cut into: within one the cam angle grows or falls steadily
_CELLS = {"Rounds": 16, "Lines": 6, "Smooth": 8}
_STEPS = 40
# flatter bulges are lines: their sagitta is below a part in 2e9 of the chord
_FLAT_BULGE = 1e-9
# errors of an outline within which a guide's reach ends soon
_NEAR_END = 10
# how far the normal turns beyond both edges at the ends of splines, rad
_BEYOND = 0.1
# halvings of an edge towards its outermost point, and numbers looked at at once
_HALVINGS, _AT_ONCE = 40, 1_000_000
# steps to a face's direction, how near they come, and the turn by which their rate is found, rad
_TURNS, _MET, _STIR = 12, 1e-14, 1e-6
# angles this near to an edge's end, in steps of the grid, are its own: ends of edges differ by the digits of a file
_END = 1e-6
# and by so much an angle may be missed where an edge is touched
_TOUCHED = 1e-3
# the slope at a cell's end is that over this share of it, or over this turn where it is longer, rad; turns below the
# least one are digits
_SLOPE_SHARE, _SLOPE_TURN, _LEAST_TURN = 1e-4, 1e-9, 1e-12


class Rounds(Record):
    """Arcs p = centre + radius n, n = exp(i (first + sweep t)); concave: radius < 0; a corner: radius 0."""

    centre: Complex
    radius: Real
    first: Real
    sweep: Real

    def __len__(self) -> int:
        """How many there are."""
        return len(self.centre)

    def at(self, edge: Index, t: Real) -> tuple[Complex, Complex]:
        """Points and outward normals."""
        normal = np.exp(1j * (self.first[edge] + self.sweep[edge] * t))
        return self.centre[edge] + self.radius[edge] * normal, normal


class Lines(Record):
    """Straight edges."""

    start: Complex
    end: Complex

    def __len__(self) -> int:
        """How many there are."""
        return len(self.start)

    def at(self, edge: Index, t: Real) -> tuple[Complex, Complex]:
        """Points and outward normals."""
        way = self.end[edge] - self.start[edge]
        return self.start[edge] + t * way, -1j * way / np.abs(way)


class Smooth(Record):
    """Polynomial edges, ``coefficients`` (n, degree + 1) of rising powers of t from 0 to 1."""

    coefficients: Complex

    def __len__(self) -> int:
        """How many there are."""
        return len(self.coefficients)

    def poles(self) -> Complex:
        """Their Bezier points, (n, degree + 1)."""
        degree = self.coefficients.shape[1] - 1
        turn = [[math.comb(j, k) / math.comb(degree, k) for j in range(degree + 1)] for k in range(degree + 1)]
        return np.asarray(self.coefficients @ np.array(turn))

    def at(self, edge: Index, t: Real) -> tuple[Complex, Complex]:
        """Points and outward normals."""
        point, way = np.zeros(np.shape(t), dtype=complex), np.zeros(np.shape(t), dtype=complex)
        for column in self.coefficients.T[::-1]:
            way = way * t + point
            point = point * t + column[edge]
        return point, -1j * way / np.abs(way)


Edges = Rounds | Lines | Smooth


class Stopped(Protocol):
    """A follower that outlines stop: that of a disk, a plate, or the roller on an unrolled barrel."""

    @property
    def is_flat(self) -> bool:
        """Whether a face touches."""

    @property
    def radius(self) -> float:
        """Radius of what touches, 0 of a point and of a face, mm."""

    def stop(self, point: Complex, normal: Complex, offset: float) -> tuple[Real, Real]:
        """Cam angle at which an outline's (p, n) touches the follower, and how high it stands then; NaN if never."""
        ...


class Outline(Record):
    """A closed outline, material on its left: its edges by family, and the place of each of them along it."""

    edges: tuple[Edges, ...]
    order: Index

    def families(self, *, less: bool) -> list[Edges]:
        """The edges and the turns of the normal about the convex corners between them.

        What is ``less`` than a point passes from edge to edge about the hollow corners too, and by exact turns alone.
        """
        whole: list[Edges] = [e for e in self.edges if len(e)]
        every = [np.arange(len(e)) for e in whole]
        starts = [e.at(i, np.zeros(len(i))) for e, i in zip(whole, every, strict=True)]
        ends = [e.at(i, np.ones(len(i))) for e, i in zip(whole, every, strict=True)]
        along = np.argsort(self.order)
        outward = np.concatenate([normal for _, normal in starts])[along]
        corner, before = (np.concatenate([s[k] for s in ends])[along] for k in (0, 1))
        between = np.angle(np.roll(outward, -1) / before)
        # beside cusps digits turn the ends of splines; a point of the outline stops no follower too high. Both fans are
        # kept: where a guide's reach ends within the wide one, the narrow one still touches
        fans = (0.0, _BEYOND) if any(isinstance(e, Smooth) for e in whole) and not less else (0.0,)
        for beyond in fans:
            turn = between + 2 * beyond
            mine = turn != 0 if less else turn > 0
            first = np.angle(before[mine]) - beyond
            whole.append(Rounds(corner[mine], np.zeros(int(mine.sum())), first, turn[mine]))
        return whole


def outline_of_loop(vertices: Complex, bulges: Real, *, clockwise: bool = False) -> Outline:
    """A closed chain of lines and arcs, in either sense; ``clockwise``: made to run so, about a hole."""
    if (signed_area(vertices, bulges) < 0) is not clockwise:
        vertices, bulges = vertices[::-1], -np.roll(bulges[::-1], -1)
    ends = np.roll(vertices, -1)
    flat = np.abs(bulges) < _FLAT_BULGE
    start, chord, b = vertices[~flat], (ends - vertices)[~flat], bulges[~flat]
    centre = start + chord / 2 + 1j * chord * (1 - b * b) / (4 * b)
    radius = np.abs(chord) * (1 + b * b) / (4 * b)
    rounds = Rounds(centre, radius, np.angle((start - centre) / radius), 4 * np.arctan(b))
    order = np.concatenate([np.flatnonzero(~flat), np.flatnonzero(flat)])
    return Outline((rounds, Lines(vertices[flat], ends[flat])), order)


def outline_of_polynomials(coefficients: Complex, *, clockwise: bool = False) -> Outline:
    """A closed chain of polynomial edges in either sense, rows of rising powers of t from 0 to 1.

    ``clockwise``: made to run so, about a hole.
    """
    starts = coefficients[:, 0]
    middles = coefficients @ 0.5 ** np.arange(coefficients.shape[1])
    polygon = np.stack([starts, middles], axis=1).ravel()
    if (signed_area(polygon, np.zeros(len(polygon))) < 0) is not clockwise:
        # t becomes 1 - t
        degree = coefficients.shape[1] - 1
        turn = [[math.comb(k, j) * (-1.0) ** j for j in range(degree + 1)] for k in range(degree + 1)]
        coefficients = (coefficients @ np.array(turn))[::-1]
    return Outline((Smooth(coefficients),), np.arange(len(coefficients)))


def rolled_lift(cam: Stopped, outline: Outline, count: int, offset: float = 0.0, *, below: bool = True) -> Real:
    """S at ``count`` equal cam angles from 0, mm or rad, of the cam's own follower on an outline in the cam's frame.

    ``offset``: the outline is the cam's moved out of the material by this much, mm, for a cutter's width: the follower
    is that much smaller. ``below``: the outline holds the follower up; else it is the outer wall of a groove, which
    holds it down, and the lowest stop counts. Not a number where no edge is touched.
    """
    lift = _stopped(cam, outline, count, offset, below, _END)
    if np.all(np.isfinite(lift)):
        return lift
    # at pressure angles of nearly 90 degrees the digits between two edges are a way of the cam
    return np.where(np.isfinite(lift), lift, _stopped(cam, outline, count, offset, below, _TOUCHED))


def _stopped(cam: Stopped, outline: Outline, count: int, offset: float, below: bool, end: float) -> Real:
    """The same of edges that reach on by ``end`` steps of the grid at both ends."""
    sign = 1.0 if below else -1.0
    # stops at the angles themselves, and such as are known beside them alone
    lift, near = np.full((2, count), -np.inf)
    step = TURN / count
    for family in outline.families(less=offset > cam.radius and not cam.is_flat):
        # a face that lies on a line touches its ends at the same angle
        if not len(family) or (cam.is_flat and isinstance(family, Lines)):
            continue
        if cam.is_flat and below and isinstance(family, Smooth):
            lift = np.fmax(lift, _supported(cam, family, count, offset))
            continue
        edge, t0, t1, target = _crossings(cam, family, step, offset, end)
        t = _solve(cam, family, edge, t0, t1, step * target.astype(np.float64), offset)
        angle, height = cam.stop(*family.at(edge, t), offset)
        off = _folded(angle - step * target)
        # where the normal turns about at once, a cell has no such angle
        met = np.abs(off) <= _TOUCHED * step
        beside = met & (np.abs(off) > _MET)
        slope = _slope(cam, family, edge[beside], t[beside], (t0 + t1 - t)[beside], offset)
        known = np.isfinite(slope)
        height[beside] -= np.where(known, off[beside] * slope, 0.0)
        np.fmax.at(near, (target % count)[beside], sign * height[beside])
        met[beside] = known
        np.fmax.at(lift, (target % count)[met], sign * height[met])
    lift = np.where(np.isfinite(lift), lift, near)
    return np.where(np.isfinite(lift), sign * lift, np.nan)


def _slope(cam: Stopped, family: Edges, edge: Index, t: Real, inward: Real, offset: float) -> Real:
    """How fast a follower rises at the end t of a cell, whose other end is ``inward``; NaN where digits hide it."""

    def way(share: Real) -> tuple[Real, Real]:
        ahead, raised = cam.stop(*family.at(edge, t + share * (inward - t)), offset)
        return _folded(ahead - angle), raised - height

    angle, height = cam.stop(*family.at(edge, t), offset)
    with np.errstate(divide="ignore", invalid="ignore"):
        whole = np.abs(way(np.ones(len(t)))[0])
        share = np.where(np.isfinite(whole), np.clip(_SLOPE_TURN / whole, _SLOPE_SHARE, 1.0), _SLOPE_SHARE)
        turned, risen = way(share)
        return np.where(np.abs(turned) > _LEAST_TURN, risen / turned, np.nan)


def _supported(cam: Stopped, edges: Smooth, count: int, offset: float) -> Real:
    """S at ``count`` cam angles of a face held by what of polynomial edges reaches farthest; NaN where nothing does.

    Beside a cusp an edge turns within a part in a million of its length, or there and back within its error: no normal
    is sought, only how far points reach, and that moves by no more than they do.
    """
    angle = np.arange(count, dtype=np.float64) * (TURN / count)

    def stops(turned: Real) -> tuple[Complex, Complex, Real, Real]:
        normal = np.exp(1j * turned)
        point = _farthest(edges, normal)
        return point, normal, *cam.stop(point, normal, offset)

    at = stops(-angle)[2]
    met = np.isfinite(at)
    if not np.any(met):
        return np.full(count, np.nan)
    # by how much angle and direction differ, which is constant where the face slides; then Newton's steps
    ahead = at[met] - angle[met]
    ahead = ahead[0] + _folded(ahead - ahead[0])
    turned = np.interp(angle, at[met], ahead, period=TURN) - angle
    for _ in range(_TURNS):
        point, normal, at, lift = stops(turned)
        miss = _folded(at - angle)
        if not np.any(np.abs(miss) > _MET):
            break
        rate = _folded(cam.stop(point, normal * np.exp(1j * _STIR), offset)[0] - at) / _STIR
        turned = turned - miss / rate
    return lift


def _farthest(edges: Smooth, normal: Complex) -> Complex:
    """The points of polynomial edges that reach farthest along unit normals (n,), by their Bezier polygons."""
    poles = edges.poles()
    found = np.empty(len(normal), dtype=complex)
    floor = TOLERANCES.relative_rounding * float(np.abs(poles).max())
    reach = np.abs(poles - poles[:, :1]).max(axis=1)
    rows = max(1, _AT_ONCE // len(poles))
    for first in range(0, len(normal), rows):
        out = np.conj(normal[first : first + rows])
        height = (out[:, None] * poles[:, 0]).real
        top, far = height.max(axis=1), np.empty(height.shape[0], dtype=complex)
        which, edge = np.nonzero(height + reach > top[:, None])
        parts = poles[edge]
        for _ in range(_HALVINGS):
            heights = (parts * out[which, None]).real
            for end in (0, -1):
                np.maximum.at(top, which, heights[:, end])
                best = heights[:, end] >= top[which]
                far[which[best]] = parts[best, end]
            wide = heights.max(axis=1) > top[which] + floor
            if not np.any(wide):
                break
            parts, which = np.concatenate(_halves(parts[wide])), np.tile(which[wide], 2)
        found[first : first + rows] = far
    return found


def _halves(poles: Complex) -> tuple[Complex, Complex]:
    """Bezier polygons (n, degree + 1) of both halves: de Casteljau's scheme."""
    left, right = [poles[:, 0]], [poles[:, -1]]
    while poles.shape[1] > 1:
        poles = (poles[:, :-1] + poles[:, 1:]) / 2
        left.append(poles[:, 0])
        right.append(poles[:, -1])
    return np.stack(left, axis=1), np.stack(right[::-1], axis=1)


def _folded(angle: Real) -> Real:
    """An angle as one from -pi to pi."""
    return angle - TURN * np.round(angle / TURN)


def _crossings(cam: Stopped, family: Edges, step: float, offset: float, end: float) -> tuple[Index, Real, Real, Index]:
    """Which edges are touched at which angles of the grid: edge, its t from and to, number of the angle."""
    cells = _CELLS[type(family).__name__]
    t = np.broadcast_to(np.linspace(0, 1, cells + 1), (len(family), cells + 1))
    edge = np.broadcast_to(np.arange(len(family))[:, None], t.shape)
    angle = cam.stop(*family.at(edge, t), offset)[0]
    low, high = angle[:, :-1], angle[:, :-1] + _folded(np.diff(angle, axis=1))
    with np.errstate(invalid="ignore"):
        first = np.ceil(np.minimum(low, high) / step - end)
        number = np.floor(np.maximum(low, high) / step + end) - first + 1
    number = np.where(np.isfinite(number), np.maximum(number, 0), 0).astype(np.int64).ravel()
    cell = np.repeat(np.arange(number.size), number)
    inside = np.arange(cell.size) - np.repeat(np.cumsum(number) - number, number)
    target = first.ravel()[cell].astype(np.int64) + inside
    return edge[:, :-1].ravel()[cell], t[:, :-1].ravel()[cell], t[:, 1:].ravel()[cell], target


def _solve(cam: Stopped, family: Edges, edge: Index, a: Real, b: Real, target: Real, offset: float) -> Real:
    """t at which each edge is touched at its angle, by the Illinois rule within [a, b]."""

    def miss(t: Real) -> Real:
        return _folded(cam.stop(*family.at(edge, t), offset)[0] - target)

    fa, fb = miss(a), miss(b)
    t = np.where(np.abs(fa) < np.abs(fb), a, b)
    for _ in range(_STEPS):
        with np.errstate(divide="ignore", invalid="ignore"):
            t = np.where(fa * fb < 0, (a * fb - b * fa) / (fb - fa), t)
        f = miss(t)
        if not np.any((np.abs(f) > 1e-14) & (fa * fb < 0)):
            break
        swap = f * fb < 0
        a, fa = np.where(swap, b, a), np.where(swap, fb, fa / 2)
        b, fb = t, f
    return t


def lift_bound(cam: DiskCam, count: int, error: float) -> Real:
    """How far S may be wrong where the outline is within ``error`` mm: infinity where the follower may slip past it.

    dS cos nu = error + kappa (dS sin nu)^2 / 2 on a pitch curve of curvature kappa; of a swinging follower over the
    arm of the contact, whose own path is bent too. Near the end of a guide's reach that has no root: a follower whose
    reach ends within the error is not held. Nor is one on a flank r = a phi^n, cos nu = phi / n,
    kappa = (n + 1) phi / (n^2 r), that a chord within the errors cuts off down to the axis:
    r phi <= 2 error (n + 1) (1 + 1/n)^n, of which the last factor is below e. The worst of three neighbouring angles
    counts.
    """
    angle = np.arange(count, dtype=np.float64) * (TURN / count)
    slope = np.abs(cam.pressure_angle(angle))
    point = cam.contact(angle) if cam.is_flat else cam.reference_point(angle)
    way, radius = np.abs(cam.way(angle, point)), cam.pitch_curvature_radius(angle)
    cosine = np.maximum(np.cos(slope), 1e-9)
    with np.errstate(divide="ignore", invalid="ignore"):
        bend = np.zeros(count) if cam.is_flat else np.abs(1 / radius)
    first = error / cosine
    bound = first + bend * (first * np.sin(slope)) ** 2 / cosine
    if isinstance(cam.mount, Oscillating):
        height = np.abs(cam.reference_point(angle))
        # of a face: its height d sin psi - f changes its slope, and so does the cam's, by its radius less that height
        face = (height + abs(cam.mount.face_offset) + np.abs(radius - height)) / way**2
        bend = bend + (face if cam.is_flat else 1 / way)
    room, spare = cosine**2 - 2 * bend * error, cam.reach_margin(angle)
    bound = np.fmax(bound, 2 * error / (cosine + np.sqrt(np.maximum(room, 0))))
    cut_off = cosine**2 <= 2 * math.e * bend * error * np.sin(slope) ** 2
    loose = (spare <= error) | ((room <= 0) & (spare <= _NEAR_END * error))
    loose |= cut_off & (np.abs(point) * cosine <= _NEAR_END * error)
    bound = np.where(loose, np.inf, cam.slackened(angle, bound / way))
    return np.maximum(np.maximum(np.roll(bound, 1), np.roll(bound, -1)), bound)

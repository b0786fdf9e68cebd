"""The roller of a cylindrical cam put onto walls as they are found, on triangles or on unrolled outlines.

A point x + iy, z of the fixed frame holds the roller above it at z + sqrt(rho^2 - (y - Re p)^2), rho its radius at x;
below it, mirrored. V is what that height has beyond the law's. As V goes with z alone, the most of V over all cam
angles is the height of a point above the exact wall, and at every depth and cam angle the roller stands wrong by no
more than the greatest such height of any of the walls' points. For a fixed cam angle V is concave over a plane.
Derivation: DERIVATIONS.md.
"""

from __future__ import annotations

import math

import numpy as np

from geometry.base.record import Record
from geometry.cams.barrel.cam import BarrelCam
from geometry.cams.motion.follower_motion import TURN
from geometry.curves.curve import Complex, Real

# Newton's steps within a bracket, and the cam angle at which they have settled, rad
_STEPS, _SETTLED = 60, 1e-12
# sines beside a point; points at once
_SIDE, _CHUNK = 0.999, 4096
# a bound of the heights is so near to one that was found, part of it; halvings of a triangle until then
_NEAR, _HALVINGS = 0.02, 40
# steps to the cam angle at which an unrolled edge is touched
_TOUCHES = 40


class WallHeight(Record):
    """How far walls stand off their exact ones along the cam's axis, mm, at most: ``bound``; ``found`` at one point.

    There the roller touches at the cam angle ``angle`` (rad), ``depth`` mm along its axis, and the wall's normal has
    the cosine ``upright`` to the cam's axis.
    """

    bound: float
    found: float
    angle: float
    depth: float
    upright: float


def wall_height(cam: BarrelCam, walls: dict[int, Real], slack: float) -> WallHeight:
    """The greatest height of triangles (n, 3, 3) above or below the exact walls, by side, as a bound.

    Triangles are halved until their bounds are within 2 % of the greatest height that was found, or ``slack`` mm of it.
    """
    bound, found, where = 0.0, -1.0, (0.0, 0.0, 1.0)
    for side, corners in walls.items():
        points, index = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
        plane, z = points[:, 0] + 1j * points[:, 1], points[:, 2]
        at = np.concatenate([np.zeros(0), *(_sought(cam, side, plane[k], z[k]) for k in _rows(len(z)))])
        rows = index.reshape(corners.shape[:2])
        plane, z, at = plane[rows], z[rows], at[rows]
        # beside the start of the turn, angles go on below 0
        at = at - TURN * np.round((at - at[:, :1]) / TURN)
        # the last parts first: few of them wait at any time
        parts = [(0, plane[k], z[k], at[k]) for k in _rows(len(z))]
        while parts:
            halved, plane, z, at = parts.pop()
            height, reach, apart = _bounds(cam, side, plane, z, at)
            worst = np.unravel_index(int(np.argmax(np.abs(height))), height.shape)
            if abs(height[worst]) > found:
                found = abs(float(height[worst]))
                where = _contact(cam, complex(plane[worst]), float(at[worst]))
            open_ = (reach > found + max(_NEAR * found, slack)) & (halved < _HALVINGS)
            bound = max(bound, float(reach[~open_].max(initial=0.0)))
            if open_.any():
                plane, z, at = _halved(cam, side, plane[open_], z[open_], at[open_], apart[open_])
                parts += [(halved + 1, plane[k], z[k], at[k]) for k in _rows(len(z))]
    return WallHeight(max(bound, found), max(found, 0.0), *where)


def held(cam: BarrelCam, side: int, plane: Complex, z: Real, at: Real) -> tuple[Real, Real, Real]:
    """V of points at cam angles, mm, -inf where they miss the roller; what is aside of its axis, and its radius."""
    place, fixed = cam.place(at, 0)[0], plane * np.exp(1j * at)
    aside, size = fixed.imag - place.real, cam.radius_at(fixed.real)
    met = (size >= np.abs(aside)) & (fixed.real > 0)
    root = np.sqrt(np.where(met, size**2 - aside**2, 0.0))
    return np.where(met, root - side * (z - place.imag), -np.inf), aside, size


def _rows(count: int) -> list[slice]:
    """Few at once of so many."""
    return [slice(k, k + _CHUNK) for k in range(0, count, _CHUNK)]


def _contact(cam: BarrelCam, plane: complex, at: float) -> tuple[float, float, float]:
    """The cam angle from 0 to a turn, the depth and the normal's cosine at a point that the roller touches."""
    fixed = plane * np.exp(1j * at)
    lean = (fixed.imag - float(cam.place(at, 0)[0].real)) / float(cam.radius_at(fixed.real))
    return at % TURN, float(fixed.real), cam.upright * math.sqrt(max(0.0, 1 - lean**2))


def _sought(cam: BarrelCam, side: int, plane: Complex, z: Real) -> Real:
    """Cam angles at which V of points (n,) is greatest: by samples, then by Newton's steps."""
    samples = cam.passing(plane, float(cam.radius_at(cam.outer)))
    best, column = np.argmax(held(cam, side, plane, z, samples)[0], axis=0), np.arange(len(plane))
    low, high = (samples[np.clip(best + k, 0, len(samples) - 1), column] for k in (-1, 1))
    return _refined(cam, side, plane, samples[best, column], low, high)


def _refined(cam: BarrelCam, side: int, plane: Complex, at: Real, low: Real, high: Real) -> Real:
    """Newton's steps to the greatest V, bisected where they leave the bracket."""
    for _ in range(_STEPS):
        place, fixed = cam.place(at, 2), plane * np.exp(1j * at)
        rate, second = place[1], 2 * place[2]
        size, aside = cam.radius_at(fixed.real), fixed.imag - place[0].real
        size_rate, aside_rate = -cam.taper * fixed.imag, fixed.real - rate.real
        square = size**2 - aside**2
        half = size * size_rate - aside * aside_rate
        half_rate = size_rate**2 - cam.taper * size * fixed.real - aside_rate**2 + aside * (fixed.imag + second.real)
        root = np.sqrt(np.maximum(square, 1e-300))
        slope = np.where(square > 0, half / root + side * rate.imag, half)
        low, high = np.where(slope > 0, at, low), np.where(slope < 0, at, high)
        with np.errstate(all="ignore"):
            bend = half_rate / root - half**2 / root**3 + side * second.imag
            after = at - slope / bend
        inside = (square > 0) & (bend < 0) & (after >= low) & (after <= high)
        after = np.where(inside, after, (low + high) / 2)
        if np.all(np.abs(after - at) <= _SETTLED):
            return after
        at = after
    return at


def _bounds(cam: BarrelCam, side: int, plane: Complex, z: Real, at: Real) -> tuple[Real, Real, Real]:
    """Heights of triangles' corners (n, 3), touched at ``at``, bounds (n,) of |height|, what each edge adds, (n, 3).

    The greatest V is no less than any V, and that no less than at its worst corner. It is no more than at its best one
    and the sagitta of sqrt(rho^2 - y^2) between them, whose second derivative along a line is -W^2 / q^(3/2),
    q = rho^2 - y^2, W the same all along it. Edge k runs from corner k to the next.
    """
    every, aside, size = held(cam, side, plane[:, :, None], z[:, :, None], at[:, None, :])
    following = [1, 2, 0]
    apart = np.abs(size * aside[:, following] - aside * size[:, following]).max(axis=2)
    with np.errstate(divide="ignore", invalid="ignore"):
        least = np.where(np.isfinite(every), size**2 - aside**2, 0.0).min(axis=(1, 2))
        sagitta = np.where(least > 0, apart.max(axis=1) ** 2 / (8 * least**1.5), np.inf)
    own = np.einsum("nii->ni", every)
    lowest = every.min(axis=1).max(axis=1)
    return own, np.maximum(own.max(axis=1) + sagitta, -lowest), apart


def _halved(cam: BarrelCam, side: int, plane: Complex, z: Real, at: Real, apart: Real) -> tuple[Complex, Real, Real]:
    """Triangles cut in two through the middle of the edge that adds most to their bound."""
    row, edge = np.arange(len(z)), np.argmax(apart, axis=1)
    a, b, c = edge, (edge + 1) % 3, (edge + 2) % 3
    middle, height, near = ((x[row, a] + x[row, b]) / 2 for x in (plane, z, at))
    width = np.ptp(at, axis=1) + 0.1 * cam.radius / (cam.outer + cam.fastest)
    touched = _refined(cam, side, middle, near, near - width, near + width)
    found = []
    for old, new in ((plane, middle), (z, height), (at, touched)):
        found.append(np.concatenate([np.stack([old[row, a], new, old[row, c]], axis=1),
                                     np.stack([new, old[row, b], old[row, c]], axis=1)]))  # fmt: skip
    return found[0], found[1], found[2]


def rolled_places(cam: BarrelCam, walls: dict[int, Real], count: int) -> dict[int, Real]:
    """By side, the heights (count,) of the roller's axis where it rests on triangles (n, 3, 3) with its whole length.

    At equal cam angles from 0. As V is linear along lines to the roller's apex, it is greatest on an edge: exact for
    triangles. Not finite where there is no wall.
    """
    angles = np.arange(count, dtype=np.float64) * (TURN / count)
    place = cam.place(angles, 0)[0]
    return {side: place.imag - side * _most(cam, side, corners, angles, place) for side, corners in walls.items()}


def _most(cam: BarrelCam, side: int, corners: Real, angles: Real, place: Complex) -> Real:
    """The greatest V of triangles at each cam angle, mm."""
    ends = np.concatenate([corners[:, [k, (k + 1) % 3]] for k in range(3)])
    flat = ends.reshape(-1, 6)
    swapped = np.concatenate([flat[:, 3:], flat[:, :3]], axis=1)
    ends = np.unique(np.where((ends[:, 0, 2] > ends[:, 1, 2])[:, None], swapped, flat), axis=0).reshape(-1, 2, 3)
    plane, z = ends[..., 0] + 1j * ends[..., 1], ends[..., 2]
    middle = np.angle(plane.sum(axis=1))
    spread = np.abs(np.angle(plane / np.exp(1j * middle)[:, None])).max(initial=0.0)
    order = np.argsort(middle)
    middle, plane, z = middle[order], plane[order], z[order]
    aside = float(np.abs(place.real).max()) + float(cam.radius_at(cam.outer))
    window = math.asin(min(1.0, aside / cam.inner)) + spread
    doubled = np.concatenate([middle - TURN, middle, middle + TURN])
    polar = np.array([math.remainder(-angle, TURN) for angle in angles.tolist()])
    first, last = (np.searchsorted(doubled, polar + away) for away in (-window, window))
    # edges near the roller, one angle after the other: an angle's begin at ``starts``
    starts = np.concatenate([[0], np.cumsum(last - first)])
    found, turned = np.full(len(angles), -np.inf), np.exp(1j * angles)
    here = 0
    while here < len(angles):
        stop = max(here + 1, int(np.searchsorted(starts, starts[here] + _CHUNK, side="right")) - 1)
        at = np.repeat(np.arange(here, stop), (last - first)[here:stop])
        near = (np.arange(starts[here], starts[stop]) - starts[at] + first[at]) % max(1, len(middle))
        fixed = plane[near] * turned[at, None]
        height = side * (place.imag[at, None] - z[near])
        heights = _on_edges(fixed.imag - place.real[at, None], cam.radius_at(fixed.real), height)
        np.maximum.at(found, at, heights)
        here = stop
    return found


def _on_edges(aside: Real, size: Real, height: Real) -> Real:
    """The greatest sqrt(size^2 - aside^2) + height on edges, ends (n, 2); -inf where the roller is nowhere met."""
    y, r, h = aside[:, 0], size[:, 0], height[:, 0]
    dy, dr, dh = (x[:, 1] - x[:, 0] for x in (aside, size, height))
    low, high = np.zeros(len(y)), np.ones(len(y))
    with np.errstate(all="ignore"):
        # from where to where |y| < r
        for value, rate in ((r - y, dr - dy), (r + y, dr + dy)):
            at = -value / rate
            low = np.where(rate > 0, np.maximum(low, at), low)
            high = np.where(rate < 0, np.minimum(high, at), high)
            high = np.where((rate == 0) & (value < 0), -1.0, high)
        # q = r^2 - y^2 where its root is as steep as the edge
        q0, q1, q2 = r**2 - y**2, 2 * (r * dr - y * dy), dr**2 - dy**2
        root = np.abs(r * dy - y * dr) / np.sqrt(dh**2 - q2)
        share = np.where(q1 * dh < 0, 2 * (root**2 - q0) / (q1 - 2 * dh * root), (-2 * dh * root - q1) / (2 * q2))
    share = np.where(np.isfinite(share), share, np.where(dh > 0, high, low))
    # of a cone q may be curved upwards: its root then rises or falls all along, and no flatter than sqrt(q2)
    rises = q1 + q2 * (low + high) > 0
    share = np.where((dh**2 > q2) & ((q2 <= 0) | (rises != (dh > 0))), share, np.where(rises, high, low))
    share = np.clip(share, low, np.maximum(low, high))
    q = (r + share * dr) ** 2 - (y + share * dy) ** 2
    return np.where(low <= high, np.sqrt(np.maximum(0.0, q)) + h + share * dh, -np.inf)


class UnrolledWall(Record):
    """A wall's edge on the unrolled outer cylinder, x = R (polar angle + pi), y from ``middle`` mm on."""

    cam: BarrelCam
    side: int
    middle: float
    is_flat = False

    @property
    def radius(self) -> float:
        """Radius of the roller at the outer cylinder, mm."""
        return float(self.cam.radius_at(self.cam.outer))

    def stop(self, point: Complex, normal: Complex, offset: float) -> tuple[Real, Real]:
        """Cam angle at which an outline's (p, n) touches the roller, and the height of its axis there; NaN if never.

        ``offset``: the outline stands so far out of the material in the plane of the sheet, mm.
        """
        cam, outer = self.cam, self.cam.outer
        edge = point - offset * normal
        polar, z = edge.real / outer - math.pi, edge.imag + self.middle
        with np.errstate(divide="ignore", invalid="ignore"):
            # the tangent of the angle about the roller's axis, were the cylinder flat
            steep = np.where(normal.imag * self.side < 0, -normal.real / np.abs(normal.imag), np.nan)
        lean = np.arctan(steep)
        at = -polar + np.arcsin(np.clip(self.radius * np.sin(lean) / outer, -_SIDE, _SIDE))
        for _ in range(_TOUCHES):
            place, turn = cam.place(at, 1), polar + at
            size = cam.radius_at(outer * np.cos(turn))
            lean = np.arctan((steep - cam.taper * np.sin(turn) / np.cos(lean)) / np.cos(turn))
            miss = outer * np.sin(turn) - place[0].real - size * np.sin(lean)
            step = miss / (outer * np.cos(turn) - place[1].real)
            at = at - step
            if not np.any(np.abs(step) > _SETTLED):
                break
        return at, z - self.side * size * np.cos(lean)

    def upright(self, at: Real) -> tuple[Real, Real]:
        """Cosine of the exact edge's inclination at cam angles, and how far from the sheet's ends it is touched, mm."""
        polar, slope = self._edge(at)
        away = self.cam.outer * (self._edge(np.zeros(1))[0] - polar)
        return 1 / np.hypot(1.0, slope), np.minimum(away, TURN * self.cam.outer - away)

    def _edge(self, at: Real) -> tuple[Real, Real]:
        """Polar angle, rad, and slope of the exact edge at cam angles."""
        cam, outer = self.cam, self.cam.outer
        place = cam.place(at, 1)
        rho = cam.distance_along(place, self.side, outer)
        y = cam.contact(place, self.side, rho).real
        lean = np.arcsin((y - place[0].real) / cam.radius_at(rho))
        return np.arctan2(y, rho) - at, (np.tan(lean) * rho + cam.taper * y / np.cos(lean)) / outer

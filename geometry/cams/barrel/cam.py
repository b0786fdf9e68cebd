"""Cylindrical cams: the walls that a roller with its axis across the cam's axis leaves in a groove, or on an end.

Fixed frame: cam axis z, the cam turns counter-clockwise, the roller's axis is parallel to x and stands over +x, at the
place p = y + iz of the yz-plane. It moves along the axis (p = i (z_0 + S)) or about a pivot that is parallel to it.
A wall is the envelope of the moving cylinder: at the distance rho along the roller's axis it touches where its normal
n = i w / |w|, w = rho - p', is across the relative velocity, at p + r n above and p - r n below. So the contact line
turns with rho, and an unrolled parallel curve at one radius is not the wall. A conical roller's radius grows with rho,
r' = k; its wall's normal (-k, n) is across that velocity where n w = -k Re p with w = rho + k r - p'. Derivation:
DERIVATIONS.md.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record, replace
from geometry.base.series import Series, affine, argument, derived, exponential, modulus_square, power, product, taylor
from geometry.cams.motion.follower_motion import TURN, FollowerMotion, PhaseKind
from geometry.curves.curve import Complex, Real
from geometry.laws.piece import LawPiece

UPPER, LOWER = 1, -1
# samples of a piece of the motion, and radii across a wall, between which an extreme is looked for
_SAMPLES, _FINER, _RADII = 65, 17, 5
_REFINEMENTS = 5
# steps of a bracketed Newton iteration; it stops when nothing changes any more
_STEPS = 60
# Newton's steps square what is left: below this share the next one is rounding
_SETTLED = 1e-10
# samples of a roller's way past a point, per unit of its slope; at least, at most; sines beside it; points at once
_PER_SLOPE, _LEAST, _MOST, _SIDE, _CHUNK = 12, 12, 400, 0.999, 4096
# an edge that is slower than this share of the cam is as good as a cusp: a ridge that nothing can run on
LEAST_SPEED = 0.05


class AxialGuide(Record):
    """The roller moves along the cam's axis: z = ``start_height`` + S, mm."""

    start_height: float

    def place(self, s: Series) -> Series:
        """Series of p = y + iz from that of S."""
        return [1j * (self.start_height + s[0]), *(1j * x for x in s[1:])]

    def raised(self, height: float) -> AxialGuide:
        """The guide moved up, mm."""
        return AxialGuide(self.start_height + height)


class SwingGuide(Record):
    """The roller sits on an arm of ``arm_length`` L; its pivot is parallel to it at y = d, z = ``pivot_height``, mm.

    psi = ``start_angle`` + S (rad) is the arm's angle above the plane across the cam's axis. d > 0: the cam's surface
    runs from the roller towards the pivot.
    """

    pivot_offset: float
    pivot_height: float
    arm_length: float
    start_angle: float

    def place(self, s: Series) -> Series:
        """p = d + i z_p - L exp(-i psi), the arm pointing to -y; mirrored where d < 0."""
        sense = math.copysign(1.0, self.pivot_offset)
        turn = exponential([-1j * sense * x for x in (self.start_angle + s[0], *s[1:])])
        return affine(complex(self.pivot_offset, self.pivot_height), -sense * self.arm_length, turn)

    def raised(self, height: float) -> SwingGuide:
        """The guide moved up, mm."""
        return replace(self, pivot_height=self.pivot_height + height)


Guide = AxialGuide | SwingGuide


class BarrelCam(Record, dict=True):
    """A follower's motion, its guide, and the cylinder that makes the walls; lengths in mm.

    ``radius``: of the roller with half of its clearance; ``outer`` and ``inner``: the cylinders between which the
    walls stand. ``is_groove``: both walls; else the lower one alone, on the end of a tube. A conical roller has its
    ``radius`` at the distance ``reference`` along its axis, and ``taper`` more for each mm outwards: the tangent of
    half of the cone's angle. taper = radius / reference: its apex lies where its axis meets the cam's middle plane.
    """

    motion: FollowerMotion
    guide: Guide
    radius: float
    outer: float
    inner: float
    is_groove: bool = True
    taper: float = 0.0
    reference: float = 0.0

    @property
    def upright(self) -> float:
        """Cosine of half of the roller's cone angle: 1 of a cylinder."""
        return 1 / math.hypot(1.0, self.taper)

    def radius_at(self, rho: ArrayLike) -> Real:
        """The roller's radius at the distance rho along its axis, mm."""
        return np.asarray(self.radius + self.taper * (np.asarray(rho, dtype=float) - self.reference))

    @property
    def sides(self) -> tuple[int, ...]:
        """The walls that there are: +1 above the roller, -1 below."""
        return (UPPER, LOWER) if self.is_groove else (LOWER,)

    def place(self, angle: ArrayLike, order: int = 1, piece: LawPiece | None = None) -> Series:
        """Series of the roller's place p over the cam angle; from the formula of one piece where it is given."""
        at = np.asarray(angle, dtype=float)
        source = self.motion if piece is None else piece
        return self.guide.place(taylor(source.values(at, order)))

    def distance_along(self, place: Series, side: Real | float, radius: ArrayLike) -> Real:
        """rho at which a wall passes through the cylinder of ``radius`` mm; ``place``: p and p'.

        Root of rho^2 + y(rho)^2 = R^2 between 0 and R by Newton's steps, bisected where they leave the bracket.
        """
        p, rate, radius = place[0], place[1], np.asarray(radius, dtype=float)
        shape = np.broadcast_shapes(np.shape(p), radius.shape)
        low, high = np.zeros(shape), np.broadcast_to(radius, shape).copy()
        # the root itself where a cylinder stays over the cam's axis: rho^2 from a quadratic equation
        square, slant = radius**2, rate.imag**2
        root = np.sqrt(np.maximum(0.0, (square + slant) ** 2 - 4 * slant * self.radius**2))
        rho = np.broadcast_to(np.sqrt(np.maximum(0.0, square - slant + root) / 2), shape).copy()
        for _ in range(_STEPS):
            w, normal, lean = self._normal(place, side, rho)
            size = self.radius_at(rho)
            y = p.real + size * normal.real
            excess = rho**2 + y**2 - radius**2
            slope = 2 * rho + 2 * y * self._slope(w, normal, lean, side, size)
            low, high = np.where(excess < 0, rho, low), np.where(excess > 0, rho, high)
            with np.errstate(divide="ignore", invalid="ignore"):
                after = rho - excess / slope
            after = np.where((after >= low) & (after <= high), after, (low + high) / 2)
            if np.all(np.abs(after - rho) <= _SETTLED * radius):
                return after
            rho = after
        return rho

    def _normal(self, place: Series, side: Real | float, rho: Real) -> tuple[Complex, Complex, Real]:
        """w, the direction n from the roller's axis to the contact, and the sine by which a cone turns it."""
        w = rho + self.taper * self.radius_at(rho) - place[1]
        lean = self.taper * place[0].real / np.abs(w)
        return w, w / np.abs(w) * (1j * side * np.sqrt(1 - lean**2) - lean), lean

    def _turn(self, w: Complex, lean: Real, side: Real | float, rate: ArrayLike, aside: ArrayLike) -> Real:
        """How fast n turns while w has the ``rate`` and the roller's axis goes ``aside``."""
        square = np.abs(w) ** 2
        leaning = self.taper * np.asarray(aside) / np.sqrt(square) - lean * (np.conj(w) * rate).real / square
        return np.asarray((np.conj(w) * rate).imag / square + side * leaning / np.sqrt(1 - lean**2))

    def _slope(self, w: Complex, normal: Complex, lean: Real, side: Real | float, size: Real) -> Real:
        """How fast the contact goes aside along the roller's axis, dy / d rho."""
        turn = self._turn(w, lean, side, 1 + self.taper**2, 0.0)
        return np.asarray(self.taper * normal.real - size * normal.imag * turn)

    def contact(self, place: Series, side: int, rho: ArrayLike) -> Complex:
        """Where the roller touches a wall at the distance rho along its axis, y + iz, mm."""
        at = np.asarray(rho, dtype=float)
        return np.asarray(place[0] + self.radius_at(at) * self._normal(place, side, at)[1])

    def wall(self, angle: ArrayLike, side: int, radius: ArrayLike, piece: LawPiece | None = None) -> Real:
        """Points (..., 3) of a wall in the cam's frame at cam angles (rad) on cylinders of ``radius`` mm."""
        at = np.asarray(angle, dtype=float)
        place = self.place(at, 1, piece)
        rho = self.distance_along(place, side, radius)
        q = self.contact(place, side, rho)
        plane = (rho + 1j * q.real) * np.exp(-1j * at)
        return np.stack(np.broadcast_arrays(plane.real, plane.imag, q.imag), axis=-1)

    def edge_series(self, piece: LawPiece, side: int, radius: float, angle: Real, order: int) -> tuple[Series, Series]:
        """Series of the polar angle (rad) and the height (mm) of a wall on a cylinder, over the cam angle."""
        place = self.place(angle, order + 1, piece)
        first = self.distance_along(place, side, radius)
        if order == 0:
            q0 = self.contact(place, side, first)
            return [np.angle(first + 1j * q0.real) - angle], [q0.imag]
        rate = derived(place)
        rho: Series = [first, *(0.0 * first for _ in range(order))]
        slope = None
        for _ in range(order):
            q = self._touched(place, rate, rho, side)
            y = [x.real for x in q]
            if slope is None:
                # of the equation in rho, as in distance_along; each round makes one more coefficient right
                w, normal, lean = self._normal(place, side, first)
                slope = 2 * first + 2 * y[0] * self._slope(w, normal, lean, side, self.radius_at(first))
            rest = [a + b for a, b in zip(product(rho, rho), product(y, y), strict=True)]
            rho = [first, *(a - b / slope for a, b in zip(rho[1:], rest[1:], strict=True))]
        q = self._touched(place, rate, rho, side)
        plane = [a + 1j * b.real for a, b in zip(rho, q, strict=True)]
        polar = argument(plane)
        polar[0], polar[1] = polar[0] - angle, polar[1] - 1.0
        return polar, [x.imag for x in q]

    def _touched(self, place: Series, rate: Series, rho: Series, side: int) -> Series:
        """Series of the contact p + r n."""
        size: Series = [self.radius_at(rho[0]), *(self.taper * x for x in rho[1:])]
        w = [a + self.taper * s - b for a, s, b in zip(rho, size, rate, strict=True)]
        least = power(modulus_square(w), -0.5)
        normal: Series = [1j * side * x for x in product(w, least)]
        if self.taper:
            lean = [self.taper * x for x in product([x.real for x in place], least)]
            square = product(lean, lean)
            level = power([1 - square[0], *(-x for x in square[1:])], 0.5)
            normal = product(product(w, least), [1j * side * a - b for a, b in zip(level, lean, strict=True)])
        return [a + b for a, b in zip(place, product(size, normal), strict=False)]

    def edge_speed(self, angle: Real, side: int, radius: ArrayLike, piece: LawPiece) -> Real:
        """How far a wall's edge on a cylinder goes round for a step of the cam angle: 1 in a dwell, 0 at a cusp.

        Where it stays positive, the wall's height is one-valued over the polar angle: nothing of it is undercut, for
        on that cylinder it is the one extreme of the heights that the roller reaches.
        """
        return self._speed(self.place(angle, 2, piece), side, radius)

    def _speed(self, place: Series, side: Real | float, radius: ArrayLike) -> Real:
        p, rate, second = place[0], place[1], 2 * place[2]
        rho = self.distance_along(place, side, radius)
        w, normal, lean = self._normal(place, side, rho)
        size = self.radius_at(rho)
        y = p.real + size * normal.real
        y_angle = rate.real - size * normal.imag * self._turn(w, lean, side, -second, rate.real)
        y_rho = self._slope(w, normal, lean, side, size)
        rho_angle = -y * y_angle / (rho + y * y_rho)
        total = y_angle + y_rho * rho_angle
        return np.asarray(1 - (rho * total - y * rho_angle) / (rho**2 + y**2))

    def least_edge_speed(self) -> tuple[float, float]:
        """The least speed of any edge between both cylinders, and the cam angle (rad) where it stands."""
        radii = np.linspace(self.inner, self.outer, _RADII)

        def speed(place: Series, side: Real) -> Real:
            return self._speed([x[..., None] for x in place], side[..., None], radii).min(axis=-1)

        # where the roller rests the edges go round as fast as the cam
        return self._least_over(speed, 2, 1.0)

    def _least_over(
        self, function: Callable[[Series, Real], Real], order: int, still: float, kind: PhaseKind | None = None
    ) -> tuple[float, float]:
        """The least value over all moving pieces and walls, and its cam angle, rad; ``still``: where nothing moves.

        ``function``: of the series of the roller's place and of the wall. Of each piece and wall samples, then ever
        finer ones about the least.
        """
        pieces, stack = self.motion.moving(kind), self.motion.stack
        side = np.tile(np.array(self.sides, dtype=float), len(pieces))[:, None]
        index = np.repeat(pieces, len(self.sides))[:, None]
        rows = np.arange(len(index))
        t = np.linspace(stack.starts[index[:, 0]], stack.ends[index[:, 0]], _SAMPLES, axis=-1)
        best, where = np.full(len(index), still), np.zeros(len(index))
        for _ in range(_REFINEMENTS if len(index) else 0):
            of = np.broadcast_to(index, t.shape)
            values = function(self.guide.place(taylor(stack.orders_at(of, t, range(order + 1)))), side)
            at = np.argmin(values, axis=1)
            best, where = values[rows, at], t[rows, at]
            low, high = t[rows, np.maximum(at - 1, 0)], t[rows, np.minimum(at + 1, t.shape[1] - 1)]
            t = np.linspace(low, high, _FINER, axis=-1)
        return min([(still, 0.0), *zip(best.tolist(), where.tolist(), strict=True)], key=lambda least: least[0])

    def pressure_angle(self, angle: Real, radius: ArrayLike, piece: LawPiece, side: int = LOWER) -> Real:
        """Angle between the normal of the contact on a cylinder and the roller's way, rad."""
        return self._pressure(self.place(angle, 1, piece), side, radius)

    def _pressure(self, place: Series, side: Real | float, radius: ArrayLike) -> Real:
        normal = self.upright * self._normal(place, side, self.distance_along(place, side, radius))[1]
        way = _way(self.guide, place[0])
        return np.asarray(np.arccos(np.clip(np.abs((normal * np.conj(way)).real), 0.0, 1.0)))

    def greatest_pressure_angle(self, kind: PhaseKind) -> tuple[float, float]:
        """The greatest pressure angle of the rises or returns, rad, at the inner ends of the walls; and its angle."""
        value, where = self._least_over(lambda place, side: -self._pressure(place, side, self.inner), 1, 0.0, kind)
        return abs(value), where

    def distance(self, points: Real, near: Real | None = None, width: float = 0.0) -> Real:
        """Distance of points (n, 3) of the cam's frame from the nearest place of the roller, mm: below 0 inside it.

        It is 0 on a wall; as parallel surfaces are envelopes too, of others it is the distance from the wall, above 0
        in the material. The least of samples over the cam angle, and Newton's steps in a bracket; ``near`` (n,): cam
        angles that are known to stand close by, within ``width`` rad, take the place of the samples.
        """
        return self.nearest(points)[0] if near is None else self.foot(points, near, width)[0]

    def foot(self, points: Real, near: Real, width: float) -> tuple[Real, Real]:
        """Distances of points (n, 3) as above, mm, and the cam angles of those places, by ones close by, rad."""
        width += 0.1 * self.radius / (self.outer + self.fastest)
        away, _, at = self._refined(points, near, near - width, near + width)
        return away, at

    def nearest(self, points: Real) -> tuple[Real, Real]:
        """Distances of points (n, 3), mm, and on which side of the roller each stands: above 0 at the upper wall."""
        found = [self._nearest(points[i : i + _CHUNK]) for i in range(0, len(points), _CHUNK)] or [(np.zeros(0),) * 2]
        return np.concatenate([d for d, _ in found]), np.concatenate([s for _, s in found])

    @cached_property
    def fastest(self) -> float:
        """About the greatest speed of the roller, mm/rad."""
        return max(float(np.abs(self.place(np.linspace(*p.domain, 9), 1, p)[1]).max()) for p in self.motion.pieces)

    def passing(self, plane: Complex, room: float) -> Real:
        """Cam angles (count, n) at which the roller's axis passes points x + iy (n,), ``room`` mm beside it, rad."""
        polar, size = np.angle(plane), np.abs(plane)
        ends = [y + sense * room for y, sense in zip(self.side_range(), (-1, 1), strict=True)]
        first, last = (np.arcsin(np.clip(y / size, -_SIDE, _SIDE)) for y in ends)
        count = math.ceil(np.clip(_PER_SLOPE * (1 + self.fastest / self.inner), _LEAST, _MOST))
        return np.asarray(-polar + first + np.linspace(0, 1, count)[:, None] * (last - first))

    def _nearest(self, points: Real) -> tuple[Real, Real]:
        plane, z = points[:, 0] + 1j * points[:, 1], points[:, 2]
        samples = self.passing(plane, 1.2 * self.radius)
        turned = plane * np.exp(1j * samples)
        away = np.abs(turned.imag + 1j * z - self.place(samples, 0)[0]) - self.radius_at(turned.real)
        best = np.argmin(away, axis=0)
        column = np.arange(len(points))
        low, high = (samples[np.clip(best + k, 0, len(samples) - 1), column] for k in (-1, 1))
        return self._refined(points, samples[best, column], low, high)[:2]

    def _refined(self, points: Real, at: Real, low: Real, high: Real) -> tuple[Real, Real, Real]:
        plane, z = points[:, 0] + 1j * points[:, 1], points[:, 2]
        for step in range(_STEPS):
            place = self.place(at, 2)
            fixed = plane * np.exp(1j * at)
            gap = fixed.imag + 1j * z - place[0]
            rate = fixed.real - place[1]
            # of |gap| - r: times |gap|, for the roller's axis may be met
            size, swing = np.abs(gap), (np.conj(gap) * rate).real
            slope = swing + self.taper * fixed.imag * size
            bend = np.abs(rate) ** 2 + (np.conj(gap) * (-fixed.imag - 2 * place[2])).real
            bend = bend + self.taper * (fixed.real * size + fixed.imag * swing / np.maximum(size, 1e-300))
            low, high = np.where(slope < 0, at, low), np.where(slope > 0, at, high)
            with np.errstate(divide="ignore", invalid="ignore"):
                after = at - slope / bend
            inside = (after >= low) & (after <= high) & (bend > 0)
            after = np.where(inside, after, (low + high) / 2)
            if step > 1 and np.all(np.abs(after - at) <= 1e-12):
                break
            at = after
        away = self.upright * (np.abs(gap) - self.radius_at(fixed.real))
        return away, (gap * np.conj(1j * (fixed.real - place[1]))).real, at

    def side_range(self) -> tuple[float, float]:
        """Least and greatest y of the roller's axis, mm: 0 for a follower that moves along the cam's axis."""
        if isinstance(self.guide, AxialGuide):
            return 0.0, 0.0
        y = self.place(np.linspace(0, TURN, 721), 0)[0].real
        return float(y.min()), float(y.max())

    def height_range(self) -> tuple[float, float]:
        """Least and greatest height of the roller's axis, mm."""
        angles = np.concatenate([p.extremes(0) for p in self.motion.pieces])
        heights = self.place(angles, 0)[0].imag
        return float(heights.min()), float(heights.max())


def _way(guide: Guide, place: Complex) -> Complex:
    """Unit direction in which the roller's axis moves while S grows."""
    if isinstance(guide, AxialGuide):
        return np.full(np.shape(place), 1j)
    arm = place - complex(guide.pivot_offset, guide.pivot_height)
    return np.asarray(-1j * math.copysign(1.0, guide.pivot_offset) * arm / np.abs(arm))

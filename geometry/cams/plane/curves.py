"""Exact cam curves over the cam angle: the path of a follower's centre, and the envelope of a flat face.

A roller's cam is a parallel curve of the path; a point's cam is the path itself. Both curves are described in the
cam's frame with growing cam angle, so they run clockwise about the axis; the follower lies on their left.
Derivation: DERIVATIONS.md, section 8.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Protocol, Self

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import CuspError
from geometry.base.record import Record, replace
from geometry.base.series import (
    FACTORIALS,
    About,
    Series,
    derived,
    exponential,
    majorant_power,
    product,
    quotient,
    sharpened,
    taylor,
    unit,
    unit_majorant,
)
from geometry.curves.bounds import BoundedSpan
from geometry.curves.curve import Complex, Curve, Real, first_turning, vertex_sign
from geometry.laws.piece import split_places
from geometry.laws.stack import PieceStack

# pieces that are shorter have no ends of their own, mm: the coarsest files have six decimals
_LEAST_LENGTH = 2e-6
# decimals to which spans of equal phases are as long as each other, and S and S' at their ends
_ALIKE_DIGITS = 9


class Guided(Protocol):
    """How a follower's centre moves in the fixed frame: geometry/cams/motion/guides.py, or a linkage (coupler.py)."""

    def centre(self, s: Series) -> Series:
        """Path of the reference point, from the series of S."""

    def centre_bound(self, s: Series, about: About | None = None) -> Series:
        """Bounds of the moduli of that series from those of S; ``about`` may make them closer."""


class Faced(Guided, Protocol):
    """A guide that can carry a flat face as well."""

    def face(self, s: Series) -> tuple[Series, Series]:
        """Distance of a flat face from the axis, and the angle of its normal, rad."""

    def face_bound(self, s: Series, about: About | None = None) -> tuple[Series, Series]:
        """Bounds of the series of that distance and of the normal's rate of turning."""


class Lift(Protocol):
    """A piece of a follower's motion: S over the cam angle with derivatives of every order."""

    def values(self, t: Real, order: int) -> list[Real]:
        """S, S' ... S^(order), each of the shape of ``t``."""

    def bounds(self, order: int, a: Real, b: Real) -> list[Real]:
        """Proven bounds of |S|, |S'| ... |S^(order)| on each interval [a, b]; inf where none is known."""


def _path_curvature(velocity: Complex, change: Complex) -> Real:
    """Curvature of a path in the cam's frame from w = z' - i z and w', 1/mm."""
    return np.asarray(((np.conj(velocity) * change).imag / np.abs(velocity) ** 2 - 1) / np.abs(velocity))


class CamSpan(BoundedSpan):
    """A cam's curve over the cam angle, over one piece of the motion or over rows of a table."""

    __slots__ = ()
    lift: Lift
    distance: float

    def stretch(self, t: ArrayLike) -> Real:
        """Of the sign of the curve's speed: it changes where the curve turns back."""
        raise NotImplementedError

    def offset(self, distance: float) -> Self:
        moved = replace(self, distance=self.distance + distance)
        cusp = first_turning(moved.stretch, self.stretch, self.domain)
        if cusp is not None:
            raise CuspError(cusp, distance)
        return moved

    def vertex_function(self, t: ArrayLike) -> Real:
        """Changes its sign where the curvature is greatest or least."""
        raise NotImplementedError

    @property
    def knots(self) -> Real:
        if not isinstance(self.lift, PieceStack):
            return super().knots
        return self.lift.knots[(self.lift.knots > self.start) & (self.lift.knots < self.end)]

    @property
    def family(self) -> object:
        """Equal phases make one curve, turned: spans of one length, with the same S and S' at their ends."""
        ends = [*self.domain, *np.concatenate(self.lift.values(np.array(self.domain), 1)).tolist()]
        return (type(self), self.distance, *(round(x, _ALIKE_DIGITS) for x in (ends[1] - ends[0], *ends[2:])))

    def joined(self, after: Curve) -> Curve | None:
        spline = isinstance(self.lift, PieceStack) and isinstance(after, CamSpan)
        whole = replace(self, end=after.domain[1]) if spline else None
        return whole if whole is not None and replace(whole, start=self.end) == after else None

    def parts(self) -> tuple[Curve, ...]:
        if not isinstance(self.lift, PieceStack):
            return (self,)
        rows = [self.trimmed(a, b) for a, b in pairwise([self.start, *self.knots.tolist(), self.end])]
        return tuple(row.trimmed(a, b) for row in rows for a, b in pairwise(row.quiet_edges()))

    def quiet_edges(self) -> list[float]:
        """Ends, inflections and vertices: between them the curvature keeps its sign and its trend.

        Arcs and chords need the first (geometry/approximation/chords.py), and few arcs the second: DERIVATIONS.md,
        section 4. Beside a cusp what is shorter than digits of a file stays with its neighbour.
        """
        inflections = [self.pitch_curvature] if isinstance(self, CentreEnvelope) else []
        edges = split_places([self.vertex_function, *inflections], *self.domain)
        points, kept = self.point(np.array(edges)).tolist(), [0]
        for k in range(1, len(edges) - 1):
            if abs(points[k] - points[kept[-1]]) > _LEAST_LENGTH and abs(points[-1] - points[k]) > _LEAST_LENGTH:
                kept.append(k)
        return [edges[k] for k in (*kept, len(edges) - 1)]


class CentreEnvelope(CamSpan, Record):
    """Path of a follower's centre or point in the cam's frame over the cam angle t, or a parallel of it.

    c(t) = exp(-i t) (z + i d w/|w|), z = e + i (s_0 + S) or d - L exp(-i sense psi), w = z' - i z, d = ``distance``
    to the left of travel, which is away from the axis: 0 is the pitch curve, -r a roller's cam, +r the outer wall of
    its groove. Derivatives of every order by Taylor arithmetic.
    """

    lift: Lift
    mount: Guided
    start: float
    end: float
    distance: float = 0.0

    def _fixed(self, t: Real, order: int) -> tuple[Series, Series]:
        """Taylor coefficients of z and of w = z' - i z, up to ``order``."""
        centre = self.mount.centre(taylor(self.lift.values(t, order + 1)))
        return centre, [x - 1j * y for x, y in zip(derived(centre), centre, strict=False)]

    def _fixed_bound(self, order: int, a: Real, b: Real) -> tuple[Series, Series]:
        """Bounds of the moduli of those coefficients on each interval; w's are one fewer."""
        about = (taylor(self.lift.values((a + b) / 2, order)), (b - a) / 2)
        whole = self.mount.centre_bound(taylor(self.lift.bounds(order, a, b)), about)
        return whole, [x + y for x, y in zip(derived(whole), whole, strict=False)]

    def _in_cam(self, fixed: Series, t: Real | None) -> Series:
        """A series of the fixed frame carried into the cam's at ``t``; None: bounds of moduli."""
        turn, rate = (1.0, 1.0) if t is None else (np.exp(-1j * t), -1j)
        return product(fixed, [turn * (rate**k / FACTORIALS[k]) for k in range(len(fixed))])

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients of c at ``t``."""
        at = np.asarray(t, dtype=float)
        centre, velocity = self._fixed(at, order)
        if self.distance:
            centre = [x + 1j * self.distance * y for x, y in zip(centre, unit(velocity), strict=False)]
        return self._in_cam(centre[: order + 1], at)

    def pitch_curvature(self, t: ArrayLike) -> Real:
        """Curvature of the centre's path, 1/mm: negative where the cam is convex, for it is travelled clockwise."""
        return _path_curvature(*self._fixed(np.asarray(t, dtype=float), 1)[1])

    def vertex_function(self, t: ArrayLike) -> Real:
        """Changes its sign where the curvature, of the path and of every parallel, is greatest or least."""
        _, (w, first, second) = self._fixed(np.asarray(t, dtype=float), 2)
        # of exp(-i t) w: its derivatives in the turning frame
        v, a, j = w, first - 1j * w, 2 * second - 2j * first - w
        return vertex_sign(v, a, j)

    def stretch(self, t: ArrayLike) -> Real:
        """1 - distance x curvature of the path: the curve's speed in that of the path, negative where it runs back."""
        return 1 - self.distance * self.pitch_curvature(t)

    def tangent(self, t: ArrayLike) -> Complex:
        at = np.asarray(t, dtype=float)
        velocity = self._fixed(at, 1 if self.distance else 0)[1]
        first = np.exp(-1j * at) * velocity[0]
        # a parallel curve may run back, see ``stretch``
        sense = np.where(1 - self.distance * _path_curvature(*velocity) < 0, -1.0, 1.0) if self.distance else 1.0
        return sense * first / np.abs(first)

    def curvature(self, t: ArrayLike) -> Real:
        path = self.pitch_curvature(t)
        with np.errstate(divide="ignore"):
            return path / np.abs(1 - self.distance * path)

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of the moduli of the Taylor coefficients on each interval: geometry/curves/bounds.py."""
        half = (b - a) / 2
        at_middle = self._fixed((a + b) / 2, order + 1)
        whole, rate = self._fixed_bound(order + 2, a, b)
        centre = sharpened(whole, at_middle[0], half)
        if self.distance:
            velocity = sharpened(rate, at_middle[1], half)
            # |w| is above its value at the middle less half the interval times the bound of |w'|
            least = np.abs(at_middle[1][0]) - half * velocity[1]
            with np.errstate(divide="ignore", invalid="ignore"):
                normal = unit_majorant(velocity, least)
            normal[0] = np.ones(np.shape(a))
            normal = [abs(self.distance) * np.where(least > 0, x, np.inf) for x in normal]
            centre = [x + y for x, y in zip(centre, normal, strict=False)]
        return self._in_cam(centre[: order + 1], None)


class FaceEnvelope(CamSpan, Record):
    """Envelope of a flat face in the cam's frame, over the cam angle t.

    The face stands ``distance`` + h(t) from the axis, its normal N = exp(i phi) points away from it. The contact is
    h N + (h'/phi') i N, and c' = v i N with v = h phi' + (h'/phi')': translating, v = -(R_b + S + S'').
    A parallel curve changes ``distance`` only.
    """

    lift: Lift
    mount: Faced
    start: float
    end: float
    distance: float = 0.0

    def support(self, t: ArrayLike, order: int) -> tuple[Series, Series]:
        """Taylor coefficients of the face's distance from the axis and of its normal's angle in the cam's frame."""
        at = np.asarray(t, dtype=float)
        height, angle = self.mount.face(taylor(self.lift.values(at, order)))
        height[0] = height[0] + self.distance
        angle[0] = angle[0] - at
        if order:
            angle[1] = angle[1] - 1.0
        return height, angle

    def reach(self, t: ArrayLike) -> Real:
        """Where the contact stands on the face: distance along i N from the foot of the axis, mm."""
        height, angle = self.support(t, 1)
        return height[1] / angle[1]

    def point(self, t: ArrayLike) -> Complex:
        height, angle = self.support(t, 1)
        return np.exp(1j * angle[0]) * (height[0] + 1j * height[1] / angle[1])

    def _speed(self, t: ArrayLike, order: int) -> tuple[Series, Series]:
        """Taylor coefficients of v, and those of the normal's angle."""
        height, angle = self.support(t, order + 2)
        rate = derived(angle)
        arm = quotient(derived(height), rate)
        turned = product(height, rate)
        return [turned[k] + (k + 1) * arm[k + 1] for k in range(order + 1)], angle

    def stretch(self, t: ArrayLike) -> Real:
        """v, mm/rad: negative where the cam is whole, its modulus then the radius of curvature times |phi'|."""
        return self._speed(t, 0)[0][0]

    def vertex_function(self, t: ArrayLike) -> Real:
        """Changes its sign where the curvature phi'/v is greatest or least."""
        speed, angle = self._speed(t, 1)
        return 2 * angle[2] * speed[0] - angle[1] * speed[1]

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients of c at ``t``."""
        speed, angle = self._speed(t, max(order - 1, 0))
        rate = product(speed, exponential([1j * x for x in angle[: len(speed)]]))
        return [self.point(t), *(1j * rate[k] / (k + 1) for k in range(order))]

    def tangent(self, t: ArrayLike) -> Complex:
        speed, angle = self._speed(t, 0)
        return np.where(speed[0] > 0, 1j, -1j) * np.exp(1j * angle[0])

    def curvature(self, t: ArrayLike) -> Real:
        speed, angle = self._speed(t, 0)
        with np.errstate(divide="ignore"):
            return angle[1] / np.abs(speed[0])

    def series_bound(self, order: int, a: Real, b: Real) -> Series:
        """Bounds of the moduli of the Taylor coefficients (the first one left out: 0) on each interval."""
        s = taylor(self.lift.bounds(order + 1, a, b))
        height, rate = self.mount.face_bound(s, (taylor(self.lift.values((a + b) / 2, order + 1)), (b - a) / 2))
        height[0] = height[0] + abs(self.distance)
        rate[0] = rate[0] + 1.0
        # phi' is farther from 0 than this: its value at the middle less half the interval times |phi''|
        least = np.abs(self.support((a + b) / 2, 1)[1][1]) - (b - a) / 2 * rate[1]
        with np.errstate(divide="ignore", invalid="ignore"):
            arm = product(derived(height), majorant_power(least, rate[1 : order + 1], -1.0))
        speed = [x + y for x, y in zip(product(height, rate), derived(arm), strict=False)]
        normal = exponential([0.0 * rate[0], *(rate[k - 1] / k for k in range(1, order))])
        found = product(speed, normal)
        return [0.0 * least, *(np.where(least > 0, found[k] / (k + 1), np.inf) for k in range(order))]

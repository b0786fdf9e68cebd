"""The envelope engine: the profile of body 1 that a given profile of body 2 cuts or drives, in any plane motion.

Savvin's method (analytical synthesis of plane cams, equations (1) to (28)): at a common point both bodies have a
common tangent, so the velocity of one against the other lies along it. With the relative motion A + i B,
delta = alpha_2 - alpha_1, the profile g(tau) in frame 2, W = delta' and u = (A + i B)' exp(-i delta) = R~ - i F~,

    Im(conj(g') (u + i W g)) = 0,

which is his (11) multiplied by omega_2 - omega_1: nothing is divided, no tangent of an angle is taken, and the
condition goes on where the bodies turn alike or one rests. Every root tau is a branch: outer and inner envelope,
both sides of a roller.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import ParameterError
from geometry.base.record import Record
from geometry.base.series import FACTORIALS, Series, composed, conjugate, derived, exponential, product
from geometry.curves.curve import Complex, Curve, Real, SeriesSpan, curvature_from_derivatives
from geometry.kinematics.motion import Pose
from geometry.laws.piece import sign_changes


class PlaneMotion(Protocol):
    """A moving frame, vectorised over t."""

    def pose(self, t: Real, order: int) -> Pose:
        """Taylor coefficients 0 to ``order`` of the origin (complex, mm) and of the angle alpha (rad)."""


class GivenMotion(Record):
    """Any motion, from a function (t, order) that returns its two series."""

    function: Callable[[Real, int], Pose]

    def pose(self, t: Real, order: int) -> Pose:
        """What the function says."""
        return self.function(t, order)


_TIME_SAMPLES, _PROFILE_SAMPLES = 361, 257
_BISECTIONS, _NEWTON_STEPS = 60, 12
_CUSP_SAMPLES = 513


def _constant(value: complex | float, t: Real, order: int) -> Series:
    zero = 0.0 * t
    return [value + zero, *([zero] * order)]


class Rotation(Record):
    """Turning about a fixed ``centre`` at a constant ``rate`` (rad per unit of t) from ``start``."""

    rate: float = 1.0
    centre: complex = 0j
    start: float = 0.0

    def pose(self, t: Real, order: int) -> Pose:
        """The origin rests, the angle is start + rate t."""
        angle = _constant(0.0, t, order)
        angle[0] = self.start + self.rate * t
        if order:
            angle[1] = self.rate + 0.0 * t
        return _constant(self.centre, t, order), angle


class Sliding(Record):
    """Uniform translation: the origin at ``start`` + ``velocity`` t, the frame turned by ``angle``."""

    velocity: complex
    start: complex = 0j
    angle: float = 0.0

    def pose(self, t: Real, order: int) -> Pose:
        """The angle rests."""
        origin = _constant(0j, t, order)
        origin[0] = self.start + self.velocity * t
        if order:
            origin[1] = self.velocity + 0.0 * t
        return origin, _constant(self.angle, t, order)


def relative_pose(first: PlaneMotion, second: PlaneMotion, t: Real, order: int) -> Pose:
    """Frame 2 seen from frame 1: A + i B and alpha_2 - alpha_1; Savvin's (6), (7)."""
    origin1, angle1 = first.pose(t, order)
    origin2, angle2 = second.pose(t, order)
    back = exponential([-1j * x for x in angle1])
    return product([b - a for a, b in zip(origin1, origin2, strict=True)], back), [
        b - a for a, b in zip(angle1, angle2, strict=True)
    ]


def instant_centre(first: PlaneMotion, second: PlaneMotion, t: Real) -> tuple[Real, Real]:
    """The relative instant centre in frame 1 (fixed centrode) and in frame 2 (moving one), complex, mm.

    (F, R) of Savvin's (12), (13); inf where the bodies do not turn against each other.
    """
    place, angle = relative_pose(first, second, t, 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        moving = 1j * place[1] * np.exp(-1j * angle[0]) / angle[1]
    return place[0] + moving * np.exp(1j * angle[0]), moving


class Branch(Record, eq=False):
    """One continuous root tau(t) of the contact condition: nodes from which it is refined."""

    t: Real
    tau: Real


class Contacts(Record):
    """Contact at many parameters: points in the frames of both bodies and in the fixed one, mm, and what happens there.

    ``pressure_angle``: acute, between the common normal and the follower's absolute velocity at the contact, rad
    ((23) to (28), corrected). ``sliding``: velocity of body 2 against body 1 along the profile's direction, mm per
    unit of t. Curvatures are signed, 1/mm, each along its own curve's travel.
    """

    point_1: Complex
    point_2: Complex
    fixed: Complex
    pressure_angle: Real
    sliding: Real
    curvature_1: Real
    curvature_2: Real


class Pair(Record):
    """Body 1 (the cam), body 2 (the follower) and the follower's profile in its own frame."""

    first: PlaneMotion
    second: PlaneMotion
    profile: Curve

    def _relative(self, t: Real, order: int) -> tuple[Series, Series, Series, Series]:
        """A + i B, delta, u and W, each to ``order``."""
        place, angle = relative_pose(self.first, self.second, t, order + 1)
        turned_back = product(derived(place), exponential([-1j * x for x in angle]))
        return place[: order + 1], angle[: order + 1], turned_back, derived(angle)

    def seen_from_second(self, points: Complex, t: Real) -> Complex:
        """Points of frame 1 in frame 2."""
        place, angle = relative_pose(self.first, self.second, np.asarray(t, dtype=float), 0)
        return (points - place[0]) * np.exp(-1j * angle[0])

    def condition(self, tau: Real, t: Real) -> Real:
        """The contact condition; 0 at a contact. Broadcasts ``tau`` against ``t``."""
        _, _, u, w = self._relative(np.asarray(t, dtype=float), 0)
        g, rate = self.profile.point(tau), self.profile.derivative(tau)
        return (np.conj(rate) * (u[0] + 1j * w[0] * g)).imag

    def _slope(self, tau: Real, t: Real) -> Real:
        """Derivative of the condition over tau."""
        _, _, u, w = self._relative(t, 0)
        g, rate, second = self.profile.point(tau), self.profile.derivative(tau), self.profile.derivative(tau, 2)
        return (np.conj(second) * (u[0] + 1j * w[0] * g)).imag + w[0] * np.abs(rate) ** 2

    def solved(self, guess: Real, t: Real) -> Real:
        """Roots near guesses by Newton's method; steps are kept within a hundredth of the profile."""
        tau, low, high = np.array(guess, dtype=float), *self.profile.domain
        reach = (high - low) / 100
        for _ in range(_NEWTON_STEPS):
            slope = self._slope(tau, t)
            with np.errstate(divide="ignore", invalid="ignore"):
                step = np.nan_to_num(self.condition(tau, t) / slope)
            tau = tau - np.clip(step, -reach, reach)
        return tau

    def branches(
        self, start: float, end: float, *, samples: int = _TIME_SAMPLES, profile_samples: int = _PROFILE_SAMPLES
    ) -> list[Branch]:
        """Every branch of the envelope over [start, end], the longest first.

        Roots are bracketed on a grid of ``samples`` by ``profile_samples`` and followed from one t to the next; two
        roots that merge end both their branches, and so does a root that leaves the profile.
        """
        t = np.linspace(start, end, samples)
        low, high = self.profile.domain
        grid = np.linspace(low, high, profile_samples)
        roots = self._roots_of_rows(t, grid)
        period = high - low if abs(complex(self.profile.point(low) - self.profile.point(high))) < 1e-12 else np.inf
        closed = np.isfinite(period)
        done: list[list[tuple[float, float]]] = []
        open_: list[list[tuple[float, float]]] = []
        reach = 12 * (high - low) / profile_samples
        for at, found in zip(t.tolist(), roots, strict=True):
            rest, still = list(found), []
            for chain in open_:
                last = chain[-1][1]
                expected = last if len(chain) < 2 else 2 * last - chain[-2][1]
                shifted = [r + period * round((expected - r) / period) if closed else r for r in rest]
                best = min(range(len(rest)), key=lambda k: abs(shifted[k] - expected), default=None)
                if best is not None and abs(shifted[best] - expected) <= reach:
                    chain.append((at, shifted[best]))
                    rest.pop(best)
                    still.append(chain)
                else:
                    done.append(chain)
            open_ = still + [[(at, r)] for r in rest]
        chains = sorted((c for c in done + open_ if len(c) > 1), key=len, reverse=True)
        return [Branch(np.array([x for x, _ in c]), np.array([y for _, y in c])) for c in chains]

    def _roots_of_rows(self, t: Real, grid: Real) -> list[list[float]]:
        values = self.condition(grid[None, :], t[:, None])
        # a root on a grid line belongs to the cell before it
        sign = np.where(values > 0, 1, -1)
        row, column = np.nonzero(sign[:, 1:] != sign[:, :-1])
        low, high, side = grid[column], grid[column + 1], sign[row, column]
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            same = np.where(self.condition(middle, t[row]) > 0, 1, -1) == side
            low, high = np.where(same, middle, low), np.where(same, high, middle)
        found: list[list[float]] = [[] for _ in t]
        for k, root in zip(row.tolist(), ((low + high) / 2).tolist(), strict=True):
            found[k].append(root)
        return found

    def contacts(self, t: Real, tau: Real) -> Contacts:
        """What happens at contacts (t, tau)."""
        t = np.asarray(t, dtype=float)
        place, angle, u, w = self._relative(t, 0)
        g, tangent = self.profile.point(tau), self.profile.tangent(tau)
        origin, turn = self.second.pose(t, 1)
        frame = np.exp(1j * turn[0])
        velocity = origin[1] + 1j * turn[1] * g * frame
        along = np.conj(tangent * frame) * velocity
        series = self.envelope_series(t, tau, 2)
        return Contacts(
            place[0] + g * np.exp(1j * angle[0]),
            g,
            origin[0] + g * frame,
            np.arctan2(np.abs(along.real), np.abs(along.imag)),
            (np.conj(tangent) * (u[0] + 1j * w[0] * g)).real,
            curvature_from_derivatives(series[1], 2 * series[2]),
            self.profile.curvature(tau),
        )

    def envelope_series(self, t: Real, tau: Real, order: int) -> Series:
        """Taylor coefficients over t of the envelope in frame 1; the profile is asked one order further."""
        place, angle, u, w = self._relative(t, order)
        jet = [
            self.profile.point(tau),
            *(self.profile.derivative(tau, k) / FACTORIALS[k] for k in range(1, order + 2)),
        ]
        rate = derived(jet)
        slope = self._slope(tau, t)
        foot: Series = [tau, *([0.0 * tau] * order)]
        for k in range(1, order + 1):
            # the coefficient of tau^(k) enters the condition's k-th coefficient linearly, times the slope
            velocity = [a + 1j * b for a, b in zip(u, product(w, composed(jet[: order + 1], foot)), strict=True)]
            condition = product(conjugate(composed(rate, foot)), velocity)[k].imag
            with np.errstate(divide="ignore", invalid="ignore"):
                foot[k] = -condition / slope
        body = product(composed(jet[: order + 1], foot), exponential([1j * x for x in angle]))
        return [a + b for a, b in zip(place, body, strict=True)]


class EnvelopeCurve(SeriesSpan, Record, eq=False):
    """One branch of an envelope in the frame of body 1, over the common parameter t; exact up to Newton's last digits.

    The order of a derivative must be one below what the profile knows. Parallel curves are those of
    geometry/curves/curve.py, and no derivative bounds are proven: approximations of it are "sampled".
    """

    pair: Pair
    branch: Branch
    start: float
    end: float

    def foot(self, t: ArrayLike) -> Real:
        """Profile parameter tau of the contact."""
        at = np.asarray(t, dtype=float)
        return self.pair.solved(np.interp(at, self.branch.t, self.branch.tau), at)

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients at ``t``."""
        at = np.asarray(t, dtype=float)
        return self.pair.envelope_series(at, self.foot(at), order)

    def contacts(self, t: ArrayLike) -> Contacts:
        """Contact points, pressure angle, sliding velocity and both curvatures."""
        at = np.asarray(t, dtype=float)
        return self.pair.contacts(at, self.foot(at))

    def signed_speed(self, t: ArrayLike) -> Real:
        """Speed along the profile's own direction: it changes sign at a cusp."""
        at = np.asarray(t, dtype=float)
        tau = self.foot(at)
        angle = relative_pose(self.pair.first, self.pair.second, at, 0)[1][0]
        direction = self.pair.profile.tangent(tau) * np.exp(1j * angle)
        return (np.conj(direction) * self.pair.envelope_series(at, tau, 1)[1]).real

    def cusps(self) -> Real:
        """Parameters at which the branch turns back."""
        return sign_changes(self.signed_speed, np.linspace(self.start, self.end, _CUSP_SAMPLES))

    def tangent(self, t: ArrayLike) -> Complex:
        at = np.asarray(t, dtype=float)
        tau = self.foot(at)
        angle = relative_pose(self.pair.first, self.pair.second, at, 0)[1][0]
        direction = self.pair.profile.tangent(tau) * np.exp(1j * angle)
        speed = (np.conj(direction) * self.pair.envelope_series(at, tau, 1)[1]).real
        return np.where(speed < 0, -1.0, 1.0) * direction

    def curvature(self, t: ArrayLike) -> Real:
        _, first, second = self.series(t, 2)
        return curvature_from_derivatives(first, 2 * second)


def envelopes(pair: Pair, start: float, end: float, *, samples: int = _TIME_SAMPLES) -> list[EnvelopeCurve]:
    """Every branch of the envelope over [start, end] as a curve, the longest first.

    Raises
    ------
    ParameterError
        There is no contact anywhere.
    """
    found = pair.branches(start, end, samples=samples)
    if not found:
        raise ParameterError("profile", start, "profile_never_touches")
    return [EnvelopeCurve(pair, b, float(b.t[0]), float(b.t[-1])) for b in found]

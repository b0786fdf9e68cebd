"""All curves of a noncircular gear's outline as one table, so that many of them are evaluated at once."""

from __future__ import annotations

import math

import numpy as np

from geometry.curves.curve import Complex, Mirrored, Real
from geometry.gears.noncircular.curves import RolledFillet, RolledFlank, RolledLand
from geometry.gears.noncircular.gear import NoncircularGear
from geometry.plane.distance import Indices

_SAMPLES, _EVERY = 13, 3
_NEWTON_STEPS = 25


class CurveTable:
    """Curves of one period: flanks, fillets and lands by their parameters; each has a tooth and a side.

    ``samples`` (curves, 13) points, ``lengths``: how far they are from each other, with room for bulges, at most
    ``steps``; ``few`` of them, (curves, 5), are at most ``strides`` apart.
    """

    def __init__(self, gear: NoncircularGear) -> None:
        outline = gear.outline
        self.gear, self.line = gear, gear.line
        self.first, self.teeth = outline.first, outline.sides.crossing.shape[1]
        self.tooth, self.side = np.array(outline.owners).T
        curves = [s.curve for s in outline.segments]
        plain = [c.base if isinstance(c, Mirrored) else c for c in curves]
        # the mirror image of a curve of parameters x and a has -x, and -a of a flank
        sign = np.array([-1.0 if isinstance(c, Mirrored) else 1.0 for c in curves])
        self.is_fillet = np.array([isinstance(c, RolledFillet) for c in plain])
        self.is_land = np.array([isinstance(c, RolledLand) for c in plain])
        self.place = sign * np.array([_place(c) for c in plain])
        angle = sign * np.array([c.angle if isinstance(c, RolledFlank) else 0.0 for c in plain])
        self.sense, self.sine, self.cosine = -np.sign(angle), np.sin(angle), np.cos(angle)
        self.lean = np.exp(1j * angle)
        self.flank_turn = self.sense * 1j * self.lean
        self.height = np.array([c.height if isinstance(c, RolledLand) else 0.0 for c in plain])
        self.cut = outline.cut
        self.low, self.high = np.array([c.domain for c in curves]).T
        self.shares = np.linspace(0, 1, _SAMPLES)
        t = self.low[:, None] + (self.high - self.low)[:, None] * self.shares
        index = np.repeat(np.arange(len(curves)), _SAMPLES)
        self.samples = self.at(index, t.ravel())[0].reshape(t.shape)
        self.lengths = 1.2 * np.abs(np.diff(self.samples))
        self.few = self.samples[:, ::_EVERY]
        self.steps = self.lengths.max(axis=1)
        self.strides = self.lengths.reshape(len(curves), -1, _EVERY).sum(axis=2).max(axis=1)

    def about(self, arc: float, reach: int) -> tuple[Indices, Complex]:
        """Curves of the teeth on either side of an arc length, and the turns that bring them there."""
        middle = round(arc / self.gear.pitch - self.gear.first_tooth)
        number = np.arange(middle - reach, middle + reach + 1) - self.first
        turns, index = np.divmod(number, self.teeth)
        row, curve = np.nonzero(self.tooth[None, :] == index[:, None])
        return curve, np.exp(2j * math.pi / self.gear.count * turns[row])

    def at(self, index: Indices, t: Real) -> tuple[Complex, Complex, Real, Real]:
        """Points of curves, their directions, speeds along them and how fast those turn."""
        fillet, land = self.is_fillet[index], self.is_land[index]
        u = np.where(fillet, t, 0.0)
        tan, secant, unwound = np.tan(u), 1 / np.cos(u), np.exp(-1j * u)
        depth, radius = self.cut.depth, self.cut.radius
        place = self.place[index]
        s = np.where(fillet, place - depth * tan, t)
        base, tangent, kappa = self.line.frame(s)
        cosine, arm = self.cosine[index], place - s
        fillet_arm = depth * (1j + tan) + 1j * radius * unwound
        land_arm = -1j * self.height[index]
        offset = np.where(fillet, fillet_arm, np.where(land, land_arm, arm * cosine * self.lean[index]))
        turn = np.where(fillet, unwound, np.where(land, 1.0, self.flank_turn[index]))
        rate = -depth * secant**2
        fillet_speed = radius * (1 - kappa * rate) + kappa * depth**2 * secant**3
        flank_speed = self.sense[index] * (arm * kappa * cosine - self.sine[index])
        speed = np.where(fillet, fillet_speed, np.where(land, 1 + self.height[index] * kappa, flank_speed))
        return base + offset * tangent, turn * tangent, speed, np.where(fillet, kappa * rate - 1, kappa)

    def distance(self, index: Indices, points: Complex) -> tuple[Real, Complex]:
        """Signed distance of points from curves, positive outside the material, and the direction in which it grows.

        Feet by Newton's method from the nearest sample; beyond a curve's end the end counts.
        """
        low, high = self.low[index], self.high[index]
        nearest = np.argmin(np.abs(points[:, None] - self.samples[index]), axis=1)
        t = low + (high - low) * self.shares[nearest]
        reach = (high - low) / (_SAMPLES - 1)
        rows = np.arange(len(t))
        for _ in range(_NEWTON_STEPS):
            place, direction, speed, turning = self.at(index[rows], t[rows])
            gap = np.conj(direction) * (points[rows] - place)
            slope = speed - turning * gap.imag
            step = gap.real / np.where(slope > 0, slope, np.maximum(speed, 1e-12))
            following = np.clip(t[rows] + np.clip(step, -reach[rows], reach[rows]), low[rows], high[rows])
            moving = np.abs(following - t[rows]) > 1e-9 * reach[rows]
            t[rows] = following
            # Newton's last step squares what is left
            rows = rows[moving]
            if not rows.size:
                break
        place, direction, _, _ = self.at(index, t)
        spoke = points - place
        outward = -1j * direction
        height = (np.conj(outward) * spoke).real
        size = np.abs(spoke)
        ends = (t <= low) | (t >= high)
        sign = np.where(height < 0, -1.0, 1.0)
        with np.errstate(divide="ignore", invalid="ignore"):
            beyond = np.where(size > 0, sign * spoke / size, outward)
        return np.where(ends, sign * size, height), np.where(ends, beyond, outward)


def _place(curve: object) -> float | Real:
    if isinstance(curve, RolledFlank):
        return curve.crossing
    return curve.centre if isinstance(curve, RolledFillet) else 0.0

"""Where flanks begin at their root fillets on a noncircular centrode: at the common tangent, or where undercut leaves
them.

A flank turns back where the rack's contact lies farther from the pitch point than the centrode's radius of curvature
allows, (x - s) kappa cos(a) = sin(a): undercut. Fillet and flank then cross, as on a circular gear.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from geometry.base.errors import UndercutError
from geometry.base.roots import halved
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Complex, Flags, Indices, Real
from geometry.gears.noncircular.curves import RolledFillet
from geometry.gears.noncircular.pitch_line import PitchLine

_SAMPLES = 33
_BISECTIONS, _NEWTON_STEPS = 60, 12


class Flanks(NamedTuple):
    """Tooth sides, n at once: flank crossings and rounding centres along the pitch line, ``sign`` 1 of lower sides.

    ``at_tip``: arc lengths of the flanks' upper ends. Lower sides come first, upper ones in the same order.
    """

    line: PitchLine
    crossing: Real
    sign: Real
    alpha: float
    centre: Real
    depth: float
    radius: float
    at_tip: Real

    def chosen(self, rows: Indices | tuple[slice, None]) -> Flanks:
        """Some of them."""
        return self._replace(
            crossing=self.crossing[rows], sign=self.sign[rows], centre=self.centre[rows], at_tip=self.at_tip[rows]
        )

    def columns(self) -> Flanks:
        """As columns, against rows of samples."""
        return self.chosen(np.s_[:, None])

    def stretch(self, s: Real) -> Real:
        """Speed of the flanks, not positive where they turn back."""
        kappa = self.line.curvature(s)
        return math.sin(self.alpha) - self.sign * (self.crossing - s) * kappa * math.cos(self.alpha)

    def flank(self, s: Real) -> tuple[Complex, Complex]:
        """Points and derivatives over s."""
        base, tangent, _ = self.line.frame(s)
        turn = np.exp(1j * self.sign * self.alpha)
        points = base + (self.crossing - s) * math.cos(self.alpha) * turn * tangent
        return points, -self.sign * 1j * turn * tangent * self.stretch(s)

    def fillet(self, u: Real) -> tuple[Complex, Complex]:
        """Points and derivatives over u."""
        curve = RolledFillet(self.line, self.centre, self.depth, self.radius, 0.0, 1.0)
        return curve.point(u), curve.derivative(u)


def flank_starts(flanks: Flanks) -> tuple[Real, Real, int]:
    """Arc lengths at which flanks begin, angles u at which their fillets end, and how many sides are undercut.

    Raises
    ------
    UndercutError
        No flank is left, or the fillets of both sides of a tooth meet.
    """
    limit = flanks.sign * (math.pi / 2 - flanks.alpha)
    joint = flanks.centre - flanks.sign * flanks.depth / math.tan(flanks.alpha)
    if np.any(flanks.sign * (flanks.at_tip - joint) <= 0):
        raise UndercutError("undercut", float(np.max(np.abs(flanks.at_tip - joint))), "no_flank_below_tip")
    share = np.linspace(0, 1, _SAMPLES)
    s = joint[:, None] + share * (flanks.at_tip - joint)[:, None]
    back = flanks.columns().stretch(s) <= 0
    rows = np.flatnonzero(back.any(axis=1))
    start, contact = joint.copy(), limit.copy()
    if rows.size:
        if back[rows, -1].any():
            raise UndercutError("undercut", float(rows.size), "undercut_leaves_no_flank")
        last = _SAMPLES - 1 - np.argmax(back[rows, ::-1], axis=1)
        part = flanks.chosen(rows)
        turning = _turning(part, s[rows, last], s[rows, last + 1])
        start[rows], contact[rows] = _crossings(part, joint[rows], turning, limit[rows])
        if np.any(flanks.sign * (flanks.at_tip - start) <= 0):
            raise UndercutError("undercut", float(rows.size), "undercut_leaves_no_flank")
        if not np.all(_joined(part, start[rows], contact[rows])):
            raise UndercutError("undercut", float(rows.size), "undercut_leaves_no_flank_to_fillet")
        _check_waist(flanks, contact)
    return start, contact, int(rows.size)


def _turning(part: Flanks, low: Real, high: Real) -> Real:
    """Where flanks turn back: between a place that does and one nearer to the tip that does not."""
    return halved(lambda s: part.stretch(s) <= 0, low, high, _BISECTIONS)[1]


def _crossings(part: Flanks, joint: Real, turning: Real, limit: Real) -> tuple[Real, Real]:
    """Where the fillets cross the flanks above their turning points: edges of polygons that cross, refined.

    What little undercut takes is less than the digits of points: the cusp's own crossing stands there.
    """
    # a crossing of little undercut lies near the fillet's end and near the flank's turning point
    near = 1 - np.geomspace(1e-9, 0.5, 2 * _SAMPLES)[::-1]
    share = np.unique(np.concatenate([np.linspace(0, 1, 2 * _SAMPLES), near]))
    u = share * limit[:, None]
    s = turning[:, None] + np.linspace(0, 1, 4 * _SAMPLES) ** 2 * (part.at_tip - turning)[:, None]
    fillets, flanks = part.columns().fillet(u)[0], part.columns().flank(s)[0]
    start, contact = _near_cusps(part, joint, turning, limit)
    a, b = contact.copy(), start.copy()
    for row, (one, two) in enumerate(zip(fillets, flanks, strict=True)):
        place = _first_crossing(one, two)
        if place is not None:
            i, j = place
            a[row], b[row] = (u[row, i] + u[row, i + 1]) / 2, (s[row, j] + s[row, j + 1]) / 2
    for _ in range(_NEWTON_STEPS):
        (one, v), (two, w) = part.fillet(a), part.flank(b)
        gap = two - one
        whole = (np.conj(v) * w).imag
        with np.errstate(divide="ignore", invalid="ignore"):
            a = a + np.nan_to_num((np.conj(gap) * w).imag / whole)
            b = b + np.nan_to_num((np.conj(gap) * v).imag / whole)
    # below the turning point both touch at the joint, and beyond its ends no fillet is: that is no crossing
    there = (part.sign * (b - turning) >= 0) & (a * limit >= 0) & (np.abs(a) <= np.abs(limit))
    found = there & _joined(part, b, a)
    return np.where(found, b, start), np.where(found, a, contact)


def _near_cusps(part: Flanks, joint: Real, turning: Real, limit: Real) -> tuple[Real, Real]:
    """Where fillets cross flanks of little undercut, whose turning points are cusps.

    With t from the cusp a flank is (t^2 / 2, k t^3 / 3), the fillet the tangent at the joint t = -d: both meet where
    2 (t/d)^3 + 3 (t/d)^2 = 1, at t = d / 2.
    """
    start = turning + (turning - joint) / 2
    contact = limit.copy()
    points = part.flank(start)[0]
    for _ in range(_NEWTON_STEPS):
        one, v = part.fillet(contact)
        contact = contact + (np.conj(v) * (points - one)).real / np.abs(v) ** 2
    return start, contact


def _joined(flanks: Flanks, start: Real, contact: Real) -> Flags:
    """Whether fillets end where flanks start, to the digits of the points and of the way along the pitch line."""
    ends, starts = flanks.fillet(contact)[0], flanks.flank(start)[0]
    size = max(float(np.max(np.abs(starts))), float(np.max(np.abs(flanks.crossing))))
    return np.abs(ends - starts) <= TOLERANCES.relative_join * size


def _first_crossing(one: Complex, two: Complex) -> tuple[int, int] | None:
    """Edges of two open polygons that cross, the first along the first one."""
    edge, other = np.diff(one)[:, None], np.diff(two)[None, :]
    ahead = (np.conj(edge) * (two[None, :] - one[:-1, None])).imag
    beside = (np.conj(other) * (one[:, None] - two[None, :-1])).imag
    crossed = (ahead[:, :-1] * ahead[:, 1:] <= 0) & (beside[:-1] * beside[1:] <= 0)
    places = np.argwhere(crossed)
    return (int(places[0, 0]), int(places[0, 1])) if places.size else None


def _check_waist(flanks: Flanks, contact: Real) -> None:
    """The fillets of both sides of a tooth leave something between them."""
    teeth = len(contact) // 2
    points = flanks.columns().fillet(np.linspace(0, 1, _SAMPLES) * contact[:, None])[0]
    middle = (flanks.crossing[:teeth] + flanks.crossing[teeth:]) / 2
    base, tangent, _ = flanks.line.frame(middle)
    along = (np.conj(np.tile(tangent, 2))[:, None] * (points - np.tile(base, 2)[:, None])).real
    if np.any(along[:teeth].max(axis=1) >= along[teeth:].min(axis=1)):
        raise UndercutError("undercut", float(teeth), "fillets_meet")

"""Where a spline surface is cut: rows and the places in each, as far apart as its curvature lets them be."""

from __future__ import annotations

import numpy as np

from geometry.curves.curve import Real
from geometry.solids.charts import Patch, span_shares

# samples of the bend, each span and at least in all, and by how much a step may differ from one that far away
_BENDS, _LEAST, _GROWTH = 4, 48, 0.5
# what is not bent at all is cut as if it were a little, part of the tolerance; by how much a tie may differ; and less
# than this part of the other bend is none but rounding
_FLAT, _TIE, _NONE = 1e-6, 1 + 1e-9, 1e-6


def bend_places(knots: Real) -> Real:
    """Shares of a spline's domain at which its bend is looked at."""
    return span_shares(knots, max(_BENDS, -(-_LEAST // (len(span_shares(knots)) - 1))))


def graded(places: Real, bends: Real, sag: float) -> Real:
    """Shares from 0 to 1 whose chords leave a curve of second derivatives ``bends`` at ``places`` by a sagitta."""
    steps = np.sqrt(8 * sag / np.maximum(bends, _FLAT * sag))
    # what is near a short step is short too
    steps = (steps + _GROWTH * np.abs(places[:, None] - places)).min(axis=1)
    passed = np.concatenate([[0.0], np.cumsum(np.diff(places) * (1 / steps[1:] + 1 / steps[:-1]) / 2)])
    count = max(1, int(np.ceil(passed[-1])))
    shares = np.interp(np.linspace(0.0, passed[-1], count + 1), passed, places)
    shares[[0, -1]] = 0.0, 1.0
    return shares


class Bends:
    """How patches on one net are bent along u and v, the most of any, at places of both."""

    def __init__(self, patch: Patch) -> None:
        self.u, self.v = bend_places(patch.surface.u_knots), bend_places(patch.surface.v_knots)
        normal = np.cross(patch.at(self.u, self.v, (1, 0)), patch.at(self.u, self.v, (0, 1)))
        normal /= np.maximum(np.linalg.norm(normal, axis=-1), 1e-300)[..., None]
        own = [np.sum(normal * patch.at(self.u, self.v, order), axis=-1) for order in ((2, 0), (1, 1), (0, 2))]
        along, twist, across = (np.abs(x).max(axis=0) for x in own)
        # a twist asks for both: shared as the bends are
        one, other = along.mean() + twist.mean(), across.mean() + twist.mean()
        share = np.sqrt(max(one, _NONE * other, 1e-300) / max(other, _NONE * one, 1e-300))
        self.along, self.across = along + share * twist, across + twist / share
        up, down = (np.abs(own[0] + share * (2 * way * own[1] + share * own[2])).mean() for way in (1, -1))
        # the same on any machine where both are alike
        self.rising = bool(up <= _TIE * down)

    def chords(self, sag: float) -> tuple[int, int]:
        """Steps along u, and along v, where the patches are bent most."""
        u, v = graded(self.u, self.along.max(axis=1), sag), graded(self.v, self.across.max(axis=0), sag)
        return len(u) - 1, len(v) - 1

    def rows(self, sag: float) -> tuple[Real, list[Real]]:
        """Shares of v of the rows within, and of u in each; at least one of both."""
        t = graded(self.v, self.across.max(axis=0), sag)
        t = t if len(t) > 2 else np.linspace(0, 1, 3)
        rows = []
        for low, high in zip(t[:-2], t[2:], strict=True):
            near = slice(max(int(np.searchsorted(self.v, low)) - 1, 0), int(np.searchsorted(self.v, high)) + 1)
            s = graded(self.u, self.along[:, near].max(axis=1), sag)
            rows.append(s[1:-1] if len(s) > 2 else np.array([0.5]))
        return t[1:-1], rows

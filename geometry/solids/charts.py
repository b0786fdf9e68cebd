"""Where the edges and faces of a solid run: points of edges, angles and heights on surfaces and back.

On planes u and v are lengths along the frame's first two axes, on surfaces of revolution u is the angle about the axis
and v the height, on tori and spheres the angle of the meridian from its outermost point; u x v looks outwards.
"""

from __future__ import annotations

import math
from functools import lru_cache
from itertools import pairwise

import numpy as np

from geometry.base.both import both
from geometry.base.distinct import distinct
from geometry.base.record import Record
from geometry.base.vectors import cross
from geometry.curves.bspline import basis_and_lower, basis_matrix
from geometry.curves.curve import Real
from geometry.solids.faces import (
    Circular,
    Cone,
    Cylinder,
    Edges,
    Frame,
    Index,
    Plane,
    Solid,
    Sphere,
    Spline,
    SplineSurface,
    Straight,
    Surface,
    Torus,
)  # fmt: skip

# of a unit vector the first part greater than this tells the sign: the greatest is 0.57 at least, no usual angle has it
_LEAST_PART = 0.1

TURN = 2 * np.pi
# longer arcs are cut into pieces where integrals run along them, rad
SHORT_ARC = math.pi / 4


def axes_of(solid: Solid, frame: Frame, rows: int) -> tuple[Real, Real]:
    """Origins (rows, 3) of frames, and their axes (rows, 3, 3): the direction of angle 0, across, and the axis."""
    origins, axes = np.empty((rows, 3)), np.empty((rows, 3, 3))
    origins[:] = solid.points[frame.origin]
    axes[:, 0], axes[:, 1], axes[:, 2] = frame.zero, cross(frame.axis, frame.zero), frame.axis
    return origins, axes


def arcs(solid: Solid, edges: Edges) -> tuple[Real, Real, Real, Real]:
    """Of arcs (n,): origins and axes of their circles, angles of their starts and sweeps, rad."""
    assert isinstance(edges.curve, Circular)
    origin, axes = axes_of(solid, edges.curve.frame, len(edges.start))
    ends = [np.einsum("nc,nkc->nk", solid.points[solid.vertices[x]] - origin, axes) for x in (edges.start, edges.end)]
    first, last = (np.arctan2(end[:, 1], end[:, 0]) for end in ends)
    return origin, axes, first, np.where(edges.start == edges.end, TURN, np.mod(last - first, TURN))


def along_edges(solid: Solid, edges: Edges, shares: Real) -> tuple[Real, Real]:
    """Points (n, k, 3) of edges at shares (k,) of their parameters, and the derivatives by these, mm."""
    low, high = (solid.points[solid.vertices[x]][:, None] for x in (edges.start, edges.end))
    curve = edges.curve
    if isinstance(curve, Straight):
        return low + (high - low) * shares[:, None], np.repeat(high - low, len(shares), axis=1)
    if isinstance(curve, Circular):
        origin, axes, first, sweep = arcs(solid, edges)
        turn = first[:, None] + sweep[:, None] * shares
        ways = np.stack([np.cos(turn), np.sin(turn)], axis=-1) * curve.radius
        steps = np.stack([-ways[..., 1], ways[..., 0]], axis=-1) * sweep[:, None, None]
        return origin[:, None] + ways @ axes[:, :2], steps @ axes[:, :2]
    poles = solid.points[curve.poles]
    return both(np.einsum("kp,npc->nkc", m, poles) for m in spline_rows(curve.degree, curve.knots, shares, 1))


def spline_rows(degree: int, knots: Real, shares: Real, order: int) -> tuple[Real, ...]:
    """What poles are multiplied by for points at shares of a spline's domain, and for derivatives up to an order.

    Matrices (k, poles), not to be written to; the derivatives are those by the share.
    """
    return _rows(degree, knots.tobytes(), shares.tobytes(), order)


@lru_cache(64)
def _rows(degree: int, all_knots: bytes, places: bytes, order: int) -> tuple[Real, ...]:
    """The same of bytes: curves that are alike, on every tooth and at both ends of it, share theirs."""
    knots, shares = np.frombuffer(all_knots), np.frombuffer(places)
    count, width = len(knots) - degree - 1, knots[-1] - knots[0]
    step = np.eye(count)
    found = []
    for k in range(order + 1):
        p = degree - k
        if p < 0:
            found.append(np.zeros((len(shares), count)))
            continue
        own = knots[k : len(knots) - k]
        found.append(basis_matrix(p, own, own[0] + shares * width) @ step * width**k)
        spread = own[p + 1 : -1] - own[1 : -p - 1] if p else np.zeros(0)
        # poles of the next derivative; none where a knot jumps
        with np.errstate(divide="ignore"):
            factor = np.where(spread > 0, p / spread, 0.0)
        step = factor[:, None] * np.diff(step, axis=0) if p else step
    for made in found:
        made.setflags(write=False)
    return tuple(found)


def spline_windows(degree: int, knots: Real, shares: Real) -> tuple[Index, Real, Real]:
    """Of shares (k,) the first pole at work, and what the degree + 1 poles from it on are multiplied by.

    (k, degree + 1) each: for points, and for derivatives by the share.
    """
    width = knots[-1] - knots[0]
    at = knots[0] + shares * width
    first, values, lower = basis_and_lower(degree, knots, at)
    index = first[:, None] + np.arange(degree)
    raised = lower * (degree * width / (knots[index + degree + 1] - knots[index + 1]))
    none = np.zeros((len(shares), 1))
    return first, values, np.concatenate([none, raised], axis=1) - np.concatenate([raised, none], axis=1)


def span_shares(knots: Real, pieces: int = 1) -> Real:
    """Where spans, each cut into so many pieces, begin and end, as shares of the domain."""
    places = distinct(knots)
    shares, spans = (places - places[0]) / (places[-1] - places[0]), len(places) - 1
    return np.interp(np.linspace(0, spans, spans * pieces + 1), np.arange(spans + 1), shares)


def smooth_shares(solid: Solid, edges: Edges, pieces: int = 1) -> Real:
    """Shares between which integrals along edges converge fast: spans, short arcs, each cut into so many pieces."""
    if isinstance(edges.curve, Spline):
        return span_shares(edges.curve.knots, pieces)
    longest = float(arcs(solid, edges)[3].max()) if isinstance(edges.curve, Circular) else 0.0
    return np.linspace(0, 1, pieces * max(1, math.ceil(longest / SHORT_ARC)) + 1)


class Chart(Record, eq=False):
    """One plane or surface of revolution: origin (3,), axes (3, 3) in rows, and its kind and sizes."""

    surface: Plane | Cylinder | Cone | Torus | Sphere
    origin: Real
    axes: Real

    @property
    def is_plane(self) -> bool:
        """Whether it has no angles."""
        return isinstance(self.surface, Plane)

    @property
    def is_central(self) -> bool:
        """Whether any turn about the z axis brings it onto itself."""
        return not (self.axes[2, :2].any() or (self.origin[:2].any() and not self.is_plane))

    @property
    def is_bent(self) -> bool:
        """Whether it is curved both ways."""
        return isinstance(self.surface, Torus | Sphere)

    def flat(self, points: Real) -> tuple[Real, Real]:
        """u and v of points (..., 3) on it; angles within half a turn of 0."""
        own = (points - self.origin) @ self.axes.T
        x, y, z = own[..., 0], own[..., 1], own[..., 2]
        if self.is_plane:
            return x, y
        if isinstance(self.surface, Torus | Sphere):
            centre = self.surface.radius if isinstance(self.surface, Torus) else 0.0
            return np.arctan2(y, x), np.arctan2(z, np.hypot(x, y) - centre)
        return np.arctan2(y, x), z

    def meridian(self, v: Real) -> tuple[Real, Real, Real, Real]:
        """Radius and height, mm, at heights or angles v of the meridian, and their derivatives by v."""
        s = self.surface
        if isinstance(s, Torus | Sphere):
            tube, centre = (s.tube, s.radius) if isinstance(s, Torus) else (s.radius, 0.0)
            return centre + tube * np.cos(v), tube * np.sin(v), -tube * np.sin(v), tube * np.cos(v)
        assert not isinstance(s, Plane)
        slope = np.tan(s.slant) if isinstance(s, Cone) else 0.0
        return s.radius + slope * v, v, np.full_like(v, slope), np.ones_like(v)

    def spatial(self, u: Real, v: Real) -> Real:
        """Points (..., 3) at u and v."""
        return self.with_normal(u, v)[0]

    def with_normal(self, u: Real, v: Real) -> tuple[Real, Real]:
        """Points (..., 3), and the cross products of their derivatives by u and v, whose shapes go together."""
        if self.is_plane:
            local = np.stack(np.broadcast_arrays(u, v, 0.0), axis=-1)
            return self.origin + local @ self.axes, np.broadcast_to(self.axes[2], local.shape)
        size, height, size_step, height_step = self.meridian(v)
        c, s = np.cos(u), np.sin(u)
        across, upwards = size * c, size * s
        local, normal = np.empty((2, *across.shape, 3))
        local[..., 0], local[..., 1], local[..., 2] = across, upwards, height
        normal[..., 0], normal[..., 1], normal[..., 2] = across * height_step, upwards * height_step, -size * size_step
        return self.origin + local @ self.axes, normal @ self.axes

    def turned(self, other: Chart, points: Real, angle: float) -> Real:
        """Points (n, 3) on another chart of this kind as they lie on this one, turned about its axis, rad."""
        c, s = np.cos(angle), np.sin(angle)
        way = np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
        return np.asarray(self.origin + (points - other.origin) @ other.axes.T @ way @ self.axes)

    def distance(self, points: Real) -> Real:
        """Of points (n, 3) from the whole surface, mm."""
        x, y, z = ((points - self.origin) @ self.axes.T).T
        surface, size = self.surface, np.hypot(x, y)
        if isinstance(surface, Plane):
            return np.abs(z)
        if isinstance(surface, Sphere):
            return np.abs(np.hypot(size, z) - surface.radius)
        if isinstance(surface, Torus):
            return np.abs(np.hypot(size - surface.radius, z) - surface.tube)
        slant = surface.slant if isinstance(surface, Cone) else 0.0
        return np.asarray(np.abs((size - surface.radius) * np.cos(slant) - z * np.sin(slant)))

    @property
    def alike(self) -> tuple[object, ...]:
        """By which surfaces of a solid that are one are told."""
        axis, s = self.axes[2], self.surface
        origin = self.origin
        # of two parts of an axis that are as great digits alone would choose
        side = np.sign(axis[np.argmax(np.abs(axis) > _LEAST_PART)])
        if isinstance(s, Plane):
            return ("plane", *_digits(axis * side), *_digits(origin @ axis * side))
        if isinstance(s, Cylinder):
            return ("cylinder", s.radius, *_digits(axis * side), *_digits(origin - origin @ axis * axis))
        if isinstance(s, Sphere):
            return ("sphere", s.radius, *_digits(origin))
        if isinstance(s, Cone):
            return ("cone", s.slant, *_digits(axis), *_digits(origin - s.radius / np.tan(s.slant) * axis))
        return ("torus", s.radius, s.tube, *_digits(np.abs(axis)), *_digits(origin))


def _digits(values: Real) -> list[float]:
    return (np.round(np.atleast_1d(values), 9) + 0.0).tolist()


def charts(solid: Solid, surface: Surface, rows: int) -> list[Chart]:
    """The charts of a bundle of faces, one for each."""
    assert isinstance(surface, Plane | Cylinder | Cone | Torus | Sphere)
    origin, axes = axes_of(solid, surface.frame, rows)
    return [Chart(surface, o, a) for o, a in zip(origin, axes, strict=True)]


class Patch(Record, eq=False):
    """Spline surfaces on one net: what gives points, derivatives by shares of both domains."""

    surface: SplineSurface
    poles: Real

    def rows(self, which: Index | slice) -> Patch:
        """Some of them."""
        return Patch(self.surface, self.poles[which])

    def scattered(self, places: Real) -> tuple[Real, Real, Real]:
        """Points (n, k, 3) at shares (k, 2), and derivatives by both."""
        s, poles = self.surface, self.poles
        ways = [*zip(s.degrees, (s.u_knots, s.v_knots), places.T, strict=True)]
        # span after span along the longer way of the net, all of it across at once
        turned = poles.shape[2] > poles.shape[1]
        if turned:
            ways, poles = ways[::-1], poles.transpose(0, 2, 1, 3)
        order = np.argsort(ways[0][2], kind="stable")
        (first, *along), (start, *across) = (spline_windows(d, k, np.clip(at[order], 0, 1)) for d, k, at in ways)
        whole = np.zeros((2, len(places), poles.shape[2]))
        for values, to in zip(across, whole, strict=True):
            np.put_along_axis(to, start[:, None] + np.arange(values.shape[1]), values, axis=1)
        net = poles.swapaxes(2, 3).reshape(*poles.shape[:2], -1)
        swept = np.empty((2, len(net), len(places), net.shape[2]))
        for begin, end in pairwise([0, *(np.flatnonzero(np.diff(first)) + 1).tolist(), len(first)]):
            for values, to in zip(along, swept, strict=True):
                to[:, begin:end] = values[begin:end] @ net[:, first[begin] : first[begin] + values.shape[1]]
        point, ahead = swept.reshape(*swept.shape[:3], 3, -1)
        made = np.empty((3, *point.shape[:3]))
        for to, x, y in zip(made, (point, ahead, point), whole[[0, 0, 1]], strict=True):
            to[:, order] = np.einsum("nkcj,kj->nkc", x, y)
        return made[0], made[1 + turned], made[2 - turned]

    def at(self, u: Real, v: Real, orders: tuple[int, int] = (0, 0)) -> Real:
        """Points, or derivatives of these orders, (n, u, v, 3) on a grid of shares."""
        s = self.surface
        along = spline_rows(s.degrees[0], s.u_knots, u, orders[0])[-1]
        across = spline_rows(s.degrees[1], s.v_knots, v, orders[1])[-1]
        return np.asarray(np.einsum("iu,nuvc,jv->nijc", along, self.poles, across, optimize=True))


def patch_of(solid: Solid, surface: SplineSurface) -> Patch:
    """The surfaces of a bundle."""
    return Patch(surface, solid.points[surface.poles])


def edge_rows(solid: Solid) -> tuple[Index, Index]:
    """Of every edge of a solid the bundle it is in and its row there."""
    sizes = [len(e.start) for e in solid.edges]
    return np.repeat(np.arange(len(sizes)), sizes), np.concatenate([np.arange(n) for n in sizes])

"""The faces of a worm: what its section's lines leave as splines, tip and root cylinders, cones or planes at the ends.

A side of a thread is a strip over the polar angle, from one end to the other: columns at even steps of the angle lie in
axial planes, and those at its ends on the cones. Between the last axial plane and an end the root goes on alone for
up to some turns, so the strip has more columns there, which meet the root cylinder at even steps too. All edges between
two faces are curves of constant parameter of both.
"""

from __future__ import annotations

import math
from functools import lru_cache, partial

import numpy as np

from geometry.approximation.outline import spline_outline
from geometry.approximation.tensor import axis_poles, greville
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.gears.worms.band import Lifted
from geometry.gears.worms.band_faces import BandFaces
from geometry.gears.worms.body import Screwed, WormBody, worm_moments
from geometry.gears.worms.shaft_faces import REST, WormRings
from geometry.gears.worms.strips import DEGREE, MARGIN, TARGET, fitted_knots
from geometry.gears.worms.thread import SectionLine
from geometry.solids import faces as kinds
from geometry.solids.faced import FacedBody, FacedSolid, Measured
from geometry.solids.faces import Frame, Index, Spline, Straight, Use, turned_over
from geometry.solids.rings import AHEAD, UP
from geometry.solids.splines import involute_walls


def faced_worm(body: WormBody) -> FacedBody:
    """A worm as files, mass and checks take it: the same faces for every tolerance that kernels allow."""
    thread = body.thread
    walls = [Measured(name, Screwed(thread, line, upper).distance)
             for upper in (True, False) for name, line in thread.lines]  # fmt: skip
    band = body.band
    if band is not None and band.run_out:
        walls += [Measured("run-out", Lifted(band, end).distance) for end in (-1, 1)]
    if body.bore is not None:
        walls += involute_walls(body.bore)
    made = lru_cache(maxsize=2)(partial(worm_solid, body))
    radii = [r for above in (False, True) for _, r in body.outline(above=above)]
    ends = *body.ends(), max(thread.worm.tip_radius, *radii)
    return FacedBody(
        lambda tolerance: made(min(tolerance, TARGET)), tuple(walls), partial(worm_moments, body), own_ends=ends
    )


def worm_solid(body: WormBody, tolerance: float) -> FacedSolid:
    """The faces of a worm, splines within ``tolerance`` mm and within what kernels call one point of the cylinders.

    Raises
    ------
    ConvergenceError
        64 spans for a step are not enough.
    """
    band = body.band
    made = CutThreads(body, tolerance) if band is None else BandFaces(body, band, tolerance)
    made.threaded()
    bore = None
    if body.bore is not None:
        bore = spline_outline(body.bore, tolerance, degree=DEGREE, continuity=DEGREE - 1)
    made.shafts(bore)
    worst = MARGIN * made.knots.worst
    return FacedSolid(made.solid(), worst if bore is None else max(worst, bore.max_error), "sampled")


class _Strip(Record, eq=False):
    """The columns of one side of every thread from the lower end to the upper one.

    ``levels``: of each column the number of its even step at the root, none at both ends; ``first``, ``last``: the
    columns between which lie whole axial planes; ``corners``: vertices (joints, n, columns); ``helices``: edges from
    column to column (joints, n, columns - 1); ``across``: edges along each line (n, columns).
    """

    levels: tuple[int, ...]
    first: int
    last: int
    corners: Index
    helices: Index
    across: tuple[Index, ...]


class CutThreads(WormRings):
    """Threads that are cut by the cones, or planes, at both ends."""

    def __init__(self, body: WormBody, tolerance: float) -> None:
        super().__init__(body)
        self.lines = [line for _, line in self.thread.lines]
        self.joints = [complex(line.point(line.domain[0])) for line in self.lines]
        self.joints.append(complex(self.worm.tip_radius, self.thread.tip_half))
        self.joints[0] = complex(self.worm.root_radius, self.thread.root_half)
        self.steps = self._steps()

        def points(k: int, u: Real, v: Real) -> Real:
            """Of both sides."""
            return np.concatenate([self._points(side, self.lines[k], u, v, alike=False) for side in (1, -1)])

        self.knots = fitted_knots(len(self.lines), points, tolerance, self.worm.tip_radius)
        self.strips: dict[int, _Strip] = {}

    # angles -----------------------------------------------------------------------------------------------------

    def _end(self, end: int, side: int, place: Complex) -> Real:
        """Polar angle at which a place of a side reaches an end."""
        height = end * self.body.end_height(place.real)
        return np.asarray((height - side * place.imag) / self.worm.parameter)

    def _steps(self) -> int:
        """How many even steps there are between both ends of all lines."""
        places = np.concatenate([line.point(np.linspace(*line.domain, 65)) for line in self.lines])
        least = min(float(self._end(1, side, places).min()) for side in (1, -1))
        return max(0, math.floor(2 * (least - REST * self.step) / self.step))

    def level(self, number: int) -> float:
        """The angle of an even step; half of them lie on each side of 0."""
        return (number - self.steps / 2) * self.step

    def _columns(self, side: int, place: Complex) -> tuple[list[Real], list[int]]:
        """Angles of a side's columns at places of the section, and the numbers of their steps."""
        found, numbers = [], []
        for end in (-1, 1):
            limit, root = self._end(end, side, place), float(self._end(end, side, np.array(self.joints[0])))
            base = self.level(self.steps if end > 0 else 0)
            extra = max(0, math.ceil((abs(root - base) - REST * self.step) / self.step) - 1)
            own = [base + (limit - base) * (end * k * self.step / (root - base)) for k in range(1, extra + 1)]
            own.append(limit)
            steps = [(self.steps if end > 0 else 0) + end * k for k in range(1, extra + 2)]
            if end < 0:
                found, numbers = own[::-1], steps[::-1]
                found += [np.full(place.shape, self.level(k)) for k in range(self.steps + 1)]
                numbers += list(range(self.steps + 1))
            else:
                found, numbers = found + own, numbers + steps
        return found, numbers

    def place_at(self, side: int, plane: Complex, angle: Real) -> tuple[Complex, Real]:
        """Points of a side of thread 0 as plane and height."""
        sign = self.worm.sign
        return plane.real * np.exp(1j * sign * angle), side * plane.imag + self.worm.parameter * angle

    def _points(self, side: int, line: SectionLine, u: Real, v: Real, *, alike: bool = True) -> Real:
        """Points (cells, u, v, 3) of a strip over a line, thread 0; without ``alike`` one of all cells that are."""
        plane = line.point(line.domain[0] + (line.domain[1] - line.domain[0]) * u)
        angles, numbers = self._columns(side, plane)
        columns = np.stack(angles)
        # the screw carries cells between whole axial planes into each other
        cells = np.array([alike or not 1 <= n < self.steps for n in numbers[:-1]])
        angle = columns[:-1][cells, :, None] * (1 - v) + columns[1:][cells, :, None] * v
        flat, z = self.place_at(side, np.broadcast_to(plane[:, None], angle.shape[1:]), angle)
        return np.stack([flat.real, flat.imag, z], axis=-1)

    # faces ------------------------------------------------------------------------------------------------------

    def threaded(self) -> None:
        """Threads, what lies between them, and their ends."""
        self.threads()
        self.lands()
        self.roots()
        self.thread_ends()

    def threads(self) -> None:
        """Both sides of all threads."""
        for side in (1, -1):
            self.strips[side] = self._strip(side)

    def _strip(self, side: int) -> _Strip:
        levels = self._columns(side, np.array(self.joints[:1]))[1]
        first = levels.index(0)
        # vertices, and helices between them
        corners, helix_points, helices, across = [], [], [], []
        v = greville(DEGREE, self.knots.around)
        cells_alike = slice(first, first + self.steps)
        for joint in self.joints:
            at = np.stack(self._columns(side, np.array([joint]))[0])[:, 0]
            angle = at[:-1, None] * (1 - v) + at[1:, None] * v
            flat, z = self.place_at(side, np.full(angle.shape, joint), angle)
            exact = np.stack([flat.real, flat.imag, z], axis=-1)
            ends = self.placed(np.concatenate([exact[:, 0], exact[-1:, -1]]))
            vertices = self.add_vertices(ends.ravel()).reshape(ends.shape)
            inner = self.placed(axis_poles(DEGREE, self.knots.around, exact, 1)[:, 1:-1])
            points = np.concatenate([ends[:, :-1, None], inner, ends[:, 1:, None]], axis=2)
            corners.append(vertices)
            helix_points.append(points)
            helices.append(self._splines(vertices[:, :-1], vertices[:, 1:], self.knots.around, points, cells_alike))
        for k, line in enumerate(self.lines):
            u_knots = self.knots.along[k]
            grid = self._points(side, line, greville(DEGREE, u_knots), v)
            poles = axis_poles(DEGREE, self.knots.around, axis_poles(DEGREE, u_knots, grid, 1), 2)
            columns = np.concatenate([poles[:, 1:-1, 0], poles[-1:, 1:-1, -1]])
            own, after = (self.points_of(corners[i]) for i in (k, k + 1))
            lines = np.concatenate([own[..., None], self.placed(columns), after[..., None]], axis=2)
            edges = self._splines(corners[k], corners[k + 1], u_knots, lines, slice(first, first + self.steps + 1))
            across.append(edges)
            cells = np.empty((len(self.starts), *poles.shape[:3]), dtype=np.intp)
            cells[:, :, 1:-1, 1:-1] = self.placed(poles[:, 1:-1, 1:-1])
            cells[:, :, :, 0], cells[:, :, :, -1] = lines[:, :-1], lines[:, 1:]
            cells[:, :, 0], cells[:, :, -1] = helix_points[k], helix_points[k + 1]
            # what the screw carries into each other is one bundle
            for own_cells in (slice(0, first), cells_alike, slice(first + self.steps, None)):
                surface = kinds.SplineSurface(
                    (DEGREE, DEGREE), u_knots, self.knots.around, cells[:, own_cells].reshape(-1, *cells.shape[2:])
                )
                if not len(surface.poles):
                    continue
                # along the line, then around: left of both seen from above
                around: list[Use] = [
                    (edges[:, :-1][:, own_cells].ravel(), True), (helices[k + 1][:, own_cells].ravel(), True),
                    (edges[:, 1:][:, own_cells].ravel(), False), (helices[k][:, own_cells].ravel(), False),
                ]  # fmt: skip
                if side < 0:
                    around = turned_over(around)
                self.face(surface, around, along=side > 0, threaded=True)
        return _Strip(tuple(levels), first, first + self.steps, np.stack(corners), np.stack(helices), tuple(across))

    def _splines(self, start: Index, end: Index, knots: Real, points: Index, alike: slice) -> Index:
        """Edges between vertices (n, k) with points (n, k, poles); those that the screw carries along are a bundle."""
        made = []
        for own in (slice(0, alike.start), alike, slice(alike.stop, None)):
            if not start[:, own].size:
                continue
            shape = Spline(DEGREE, knots, points[:, own].reshape(-1, points.shape[-1]))
            ends = start[:, own].ravel(), end[:, own].ravel()
            made.append(self.add_edges(*ends, shape).reshape(start[:, own].shape))
        return np.concatenate(made, axis=1)

    def lands(self) -> None:
        """The tip cylinder of every thread."""
        worm, upper, lower = self.worm, self.strips[1], self.strips[-1]
        surface = self.pipe(worm.tip_radius)
        tops, lows = upper.corners[-1], lower.corners[-1]
        inner = slice(lower.first, lower.last + 1), slice(upper.first, upper.last + 1)
        foot, head = lows[:, inner[0]], tops[:, inner[1]]
        edges = self.add_edges(foot.ravel(), head.ravel(), Straight(UP)).reshape(foot.shape)
        low, high = lower.helices[-1], upper.helices[-1]
        if self.steps:
            under, over = low[:, lower.first : lower.last].ravel(), high[:, upper.first : upper.last].ravel()
            right, left = edges[:, 1:].ravel(), edges[:, :-1].ravel()
            self.face(surface, [(under, True), (right, True), (over, False), (left, False)])
        self.tip_arcs = {
            end: self.arc(worm.tip_radius, end * float(self.body.end_height(worm.tip_radius)),
                           tops[:, column], lows[:, column])
            for end, column in ((-1, 0), (1, -1))
        }  # fmt: skip
        arc, way = self.tip_arcs[1]
        for own_low, own_high, before, after in (
            (low[:, : lower.first], high[:, : upper.first], self.tip_arcs[-1], (edges[:, 0], True)),
            (low[:, lower.last :], high[:, upper.last :], (edges[:, -1], False), (arc, not way)),
        ):
            around = [(e, True) for e in own_low.T]
            self.face(surface, [*around, after, *((e, False) for e in own_high.T[::-1]), before])

    def roots(self) -> None:
        """The root cylinder between the upper side of every thread and the lower side of the one above it."""
        worm, upper, lower, half = self.worm, self.strips[1], self.strips[-1], self.body.length / 2
        surface, radius = self.pipe(worm.root_radius), worm.root_radius
        n = len(self.starts)
        # the thread above is the one before, so many steps on
        above = np.roll(np.arange(n), 1)
        root = np.array([self.joints[0]])
        below_nodes = {number: upper.corners[0][:, c] for c, number in enumerate(upper.levels) if self._inner(upper, c)}
        above_nodes = {
            number - self.between: lower.corners[0][above, c]
            for c, number in enumerate(lower.levels) if self._inner(lower, c)
        }  # fmt: skip
        margin = REST * self.step / 2
        room = [
            (float(self._end(end, -1, root)[0]) - math.tau / n + margin, float(self._end(end, 1, root)[0]) - margin)
            for end in (-1, 1)
        ]
        numbers = range(
            min(*below_nodes, *above_nodes, 0) - self.between, max(*below_nodes, *above_nodes) + self.between
        )
        on_low, on_high, lines = self.uprights(numbers, (below_nodes, above_nodes), self.level, room, radius, half)
        # both ways from the lower end of the side above to the upper end of the side below
        start, stop = lower.corners[0][above, 0], upper.corners[0][:, -1]
        bottom, bottom_nodes = self.arcs(radius, -half, [start, *on_low, upper.corners[0][:, 0]])
        top, top_nodes = self.arcs(radius, half, [lower.corners[0][above, -1], *on_high, stop])
        bottom += [(e, True) for e in upper.helices[0].T]
        bottom_nodes += [upper.corners[0][:, c] for c in range(1, len(upper.levels))]
        top = [(e, True) for e in lower.helices[0][above].T] + top
        top_nodes = [lower.corners[0][above, c] for c in range(len(lower.levels) - 1)] + top_nodes
        self.space_arcs = {-1: bottom[: len(on_low) + 1], 1: top[len(lower.levels) - 1 :]}
        edges: Index | tuple[()] = ()
        if lines:
            # of a short thread there are none
            feet, heads = (np.concatenate([line[k] for line in lines]) for k in (0, 1))
            edges = self.add_edges(feet, heads, Straight(UP)).reshape(-1, n)
        # faces of alike bounds are one bundle
        alike: dict[tuple[bool, ...], list[list[Use]]] = {}
        for around in self.panels(edges, lines, (bottom, bottom_nodes), (top, top_nodes)):
            alike.setdefault(tuple(way for _, way in around), []).append(around)
        for ways, faces in alike.items():
            columns = [np.concatenate([around[k][0] for around in faces]) for k in range(len(ways))]
            self.face(surface, list(zip(columns, ways, strict=True)))

    def _inner(self, strip: _Strip, column: int) -> bool:
        """Whether a column is none of the ends."""
        return 0 < column < len(strip.levels) - 1

    def thread_ends(self) -> None:
        """What the cones, or planes, at both ends leave of every thread."""
        worm, half, upper, lower = self.worm, self.body.length / 2, self.strips[1], self.strips[-1]
        for end, column in ((-1, 0), (1, -1)):
            origin = self.on_axis(end * half)
            surface: kinds.Surface
            if self.body.end_angle > 0:
                frame = Frame(origin, -end * UP, AHEAD)
                surface = kinds.Cone(frame, worm.root_radius, math.pi / 2 - self.body.end_angle)
            else:
                surface = kinds.Plane(self.frame_at(end * half))
            under = self.arc(worm.root_radius, end * half, upper.corners[0][:, column], lower.corners[0][:, column])
            around: list[Use] = [(e[:, column], True) for e in upper.across]
            around.append(self.tip_arcs[end])
            around += [(e[:, column], False) for e in reversed(lower.across)]
            around.append((under[0], not under[1]))
            if end < 0:
                around = turned_over(around)
            self.face(surface, around, along=end > 0 or self.body.end_angle > 0)
            # the whole circle, thread by thread: what lies above thread j comes before it
            own = [*self.space_arcs[end], under]
            self.rims[end] = [(np.array([edge[j]]), way) for j in range(len(self.starts)) for edge, way in own]

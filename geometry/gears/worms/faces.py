"""The faces of a worm: what its section's lines leave as splines, tip and root cylinders, cones or planes at the ends.

A side of a thread is a strip over the polar angle, from one end to the other: columns at even steps of the angle lie in
axial planes, and those at its ends on the cones. Between the last axial plane and an end the root goes on alone for
up to some turns, so the strip has more columns there, which meet the root cylinder at even steps too. All edges between
two faces are curves of constant parameter of both.
"""

from __future__ import annotations

import math
from functools import lru_cache, partial
from itertools import pairwise

import numpy as np

from geometry.approximation.outline import Outline, spline_outline
from geometry.approximation.tensor import basis_matrix, clamped, greville
from geometry.base.errors import ConvergenceError
from geometry.base.record import Record
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc
from geometry.gears.worms.body import Screwed, WormBody, worm_moments
from geometry.gears.worms.thread import SectionLine
from geometry.solids import faces as kinds
from geometry.solids.faced import FacedBody, FacedSolid, Measured
from geometry.solids.faces import Circular, Faces, Frame, Index, Spline, Straight
from geometry.solids.rings import AHEAD, UP, Ring, RingBuilder

_DEGREE = 7
# kernels join curves and surfaces within 1e-7 mm; edges are kept well below that
_TARGET, _MARGIN = 2e-8, 1.5
# of the size, for rounding
_ROUNDING = 2e-15
# steps of the polar angle: one start has so many a turn; more starts have one or two from thread to thread
_STEPS = 4
# what is left between an axial plane and an end, part of a step
_REST = 0.25
_MOST_SPANS = 64
_SAMPLES = 11
_MOST_ROUNDS = 12

# an edge of every thread (n,), and whether it runs forwards
Use = tuple[Index, bool]


def faced_worm(body: WormBody) -> FacedBody:
    """A worm as files, mass and checks take it: the same faces for every tolerance that kernels allow."""
    thread = body.thread
    walls = [Measured(name, Screwed(thread, line, upper).distance)
             for upper in (True, False) for name, line in thread.lines]  # fmt: skip
    made = lru_cache(maxsize=2)(partial(worm_solid, body))
    radii = [r for above in (False, True) for _, r in body.outline(above=above)]
    ends = *body.ends(), max(thread.worm.tip_radius, *radii)
    return FacedBody(
        lambda tolerance: made(min(tolerance, _TARGET)), tuple(walls), partial(worm_moments, body), own_ends=ends
    )


def worm_solid(body: WormBody, tolerance: float) -> FacedSolid:
    """The faces of a worm, splines within ``tolerance`` mm and within what kernels call one point of the cylinders.

    Raises
    ------
    ConvergenceError
        64 spans for a step are not enough.
    """
    reach = body.thread.worm.tip_radius
    target = max(min(tolerance, _TARGET) / _MARGIN, 4 * _ROUNDING * reach)
    made = _Maker(body, target)
    made.threads()
    made.lands()
    made.roots()
    made.thread_ends()
    bore = None
    if body.bore is not None:
        bore = spline_outline(body.bore, tolerance, degree=_DEGREE, continuity=_DEGREE - 1)
    made.shafts(bore)
    worst = _MARGIN * made.worst
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


class _Maker(RingBuilder):
    """Vertices, edges and faces of one worm; angles are those of a right-hand one."""

    def __init__(self, body: WormBody, target: float) -> None:
        super().__init__()
        self.body, self.thread, self.worm = body, body.thread, body.thread.worm
        self.target, self.worst = target, 0.0
        self.lines = [line for _, line in self.thread.lines]
        self.joints = [complex(line.point(line.domain[0])) for line in self.lines]
        self.joints.append(complex(self.worm.tip_radius, self.thread.tip_half))
        self.joints[0] = complex(self.worm.root_radius, self.thread.root_half)
        self.starts = np.arange(self.worm.number_of_starts)
        # steps from thread to thread, and their angle
        self.between = max(1, math.ceil(_STEPS / len(self.starts)))
        self.step = math.tau / (len(self.starts) * self.between)
        self.steps = self._steps()
        self.v_knots = clamped(_DEGREE, np.array([0.0, 1.0]))
        self.u_knots = [self.v_knots for _ in self.lines]
        self._choose_knots()
        self.strips: dict[int, _Strip] = {}
        # by end (-1, 1) and radius: the vertices of circles, and their edges by the nodes they join
        self.rims: dict[int, list[Use]] = {}

    # angles -----------------------------------------------------------------------------------------------------

    def _end(self, end: int, side: int, place: Complex) -> Real:
        """Polar angle at which a place of a side reaches an end."""
        height = end * self.body.end_height(place.real)
        return np.asarray((height - side * place.imag) / self.worm.parameter)

    def _steps(self) -> int:
        """How many even steps there are between both ends of all lines."""
        places = np.concatenate([line.point(np.linspace(*line.domain, 65)) for line in self.lines])
        least = min(float(self._end(1, side, places).min()) for side in (1, -1))
        return max(0, math.floor(2 * (least - _REST * self.step) / self.step))

    def level(self, number: int) -> float:
        """The angle of an even step; half of them lie on each side of 0."""
        return (number - self.steps / 2) * self.step

    def _columns(self, side: int, place: Complex) -> tuple[list[Real], list[int]]:
        """Angles of a side's columns at places of the section, and the numbers of their steps."""
        found, numbers = [], []
        for end in (-1, 1):
            limit, root = self._end(end, side, place), float(self._end(end, side, np.array(self.joints[0])))
            base = self.level(self.steps if end > 0 else 0)
            extra = max(0, math.ceil((abs(root - base) - _REST * self.step) / self.step) - 1)
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

    # splines ----------------------------------------------------------------------------------------------------

    def _choose_knots(self) -> None:
        """As many spans over lines and cells as keep the splines within the target."""
        spans = [1] * (len(self.lines) + 1)
        for _ in range(_MOST_ROUNDS):
            self.v_knots = clamped(_DEGREE, np.linspace(0.0, 1.0, spans[-1] + 1))
            self.u_knots = [clamped(_DEGREE, np.linspace(0.0, 1.0, n + 1)) for n in spans[:-1]]
            errors = [self._errors(k) for k in range(len(self.lines))]
            self.worst = max(max(e) for e in errors)
            if self.worst <= self.target:
                return
            for k, (along, _) in enumerate(errors):
                spans[k] = self._more(spans[k], along)
            spans[-1] = self._more(spans[-1], max(e for _, e in errors))
            if max(spans) > _MOST_SPANS:
                break
        raise ConvergenceError("spline surfaces of the thread", self.worst, max(spans))

    def _more(self, spans: int, error: float) -> int:
        return (
            spans
            if error <= self.target / 2
            else math.ceil(spans * min(2.0, max(1.2, (error / self.target) ** (1 / 8))))
        )

    def _errors(self, k: int) -> tuple[float, float]:
        """Errors of the splines of a line along it and around, mm, each as if the other were exact."""
        line, fine = self.lines[k], [np.linspace(0, 1, _SAMPLES * (len(x) - 2 * _DEGREE - 1) + 1)
                                     for x in (self.u_knots[k], self.v_knots)]  # fmt: skip
        worst = [0.0, 0.0]
        for side in (1, -1):
            exact = self._points(side, line, fine[0], fine[1], alike=False)
            for way, knots in enumerate((self.u_knots[k], self.v_knots)):
                at = [greville(_DEGREE, knots), fine[1]] if way == 0 else [fine[0], greville(_DEGREE, knots)]
                poles = _poles(knots, self._points(side, line, *at, alike=False), 1 + way)
                made = np.moveaxis(
                    np.tensordot(basis_matrix(_DEGREE, knots, fine[way]), poles, axes=(1, 1 + way)), 0, 1 + way
                )
                worst[way] = max(worst[way], float(np.linalg.norm(made - exact, axis=-1).max()))
        return worst[0], worst[1]

    def _placed(self, points: Real) -> Index:
        """Numbers of points (..., 3) of thread 0 on all threads, (n, ...)."""
        turn = np.exp(1j * self.worm.sign * math.tau * self.starts / len(self.starts))
        plane = points[..., 0] + 1j * points[..., 1]
        shape = (len(self.starts),) + (1,) * plane.ndim
        return self.add_points(
            turn.reshape(shape) * plane, np.broadcast_to(points[..., 2], (len(self.starts), *plane.shape))
        )

    # faces ------------------------------------------------------------------------------------------------------

    def face(self, surface: kinds.Surface, around: list[Use], *, along: bool = True, threaded: bool = False) -> None:
        """Faces within edges that turn left about their surfaces' normals outwards, of a right-hand worm.

        ``along``: those point outwards; ``threaded``: a left-hand worm has them turned over.
        """
        if self.worm.sign < 0:
            around = [(edge, not way) for edge, way in reversed(around)]
            along = along != threaded
        loop = np.stack([edge for edge, _ in around], axis=1), np.array([way for _, way in around])
        self.faces.append(Faces(surface, (loop,), along))

    def threads(self) -> None:
        """Both sides of all threads."""
        for side in (1, -1):
            self.strips[side] = self._strip(side)

    def _strip(self, side: int) -> _Strip:
        levels = self._columns(side, np.array(self.joints[:1]))[1]
        first = levels.index(0)
        # vertices, and helices between them
        corners, helix_points, helices, across = [], [], [], []
        v = greville(_DEGREE, self.v_knots)
        cells_alike = slice(first, first + self.steps)
        for joint in self.joints:
            at = np.stack(self._columns(side, np.array([joint]))[0])[:, 0]
            angle = at[:-1, None] * (1 - v) + at[1:, None] * v
            flat, z = self.place_at(side, np.full(angle.shape, joint), angle)
            exact = np.stack([flat.real, flat.imag, z], axis=-1)
            ends = self._placed(np.concatenate([exact[:, 0], exact[-1:, -1]]))
            vertices = self.add_vertices(ends.ravel()).reshape(ends.shape)
            inner = self._placed(_poles(self.v_knots, exact, 1)[:, 1:-1])
            points = np.concatenate([ends[:, :-1, None], inner, ends[:, 1:, None]], axis=2)
            corners.append(vertices)
            helix_points.append(points)
            helices.append(self._splines(vertices[:, :-1], vertices[:, 1:], self.v_knots, points, cells_alike))
        for k, line in enumerate(self.lines):
            u_knots = self.u_knots[k]
            grid = self._points(side, line, greville(_DEGREE, u_knots), v)
            poles = _poles(self.v_knots, _poles(u_knots, grid, 1), 2)
            columns = np.concatenate([poles[:, 1:-1, 0], poles[-1:, 1:-1, -1]])
            own, after = (self.solid_points(corners[i]) for i in (k, k + 1))
            lines = np.concatenate([own[..., None], self._placed(columns), after[..., None]], axis=2)
            edges = self._splines(corners[k], corners[k + 1], u_knots, lines, slice(first, first + self.steps + 1))
            across.append(edges)
            cells = np.empty((len(self.starts), *poles.shape[:3]), dtype=np.intp)
            cells[:, :, 1:-1, 1:-1] = self._placed(poles[:, 1:-1, 1:-1])
            cells[:, :, :, 0], cells[:, :, :, -1] = lines[:, :-1], lines[:, 1:]
            cells[:, :, 0], cells[:, :, -1] = helix_points[k], helix_points[k + 1]
            # what the screw carries into each other is one bundle
            for own_cells in (slice(0, first), cells_alike, slice(first + self.steps, None)):
                surface = kinds.SplineSurface(
                    (_DEGREE, _DEGREE), u_knots, self.v_knots, cells[:, own_cells].reshape(-1, *cells.shape[2:])
                )
                if not len(surface.poles):
                    continue
                # along the line, then around: left of both seen from above
                around: list[Use] = [
                    (edges[:, :-1][:, own_cells].ravel(), True), (helices[k + 1][:, own_cells].ravel(), True),
                    (edges[:, 1:][:, own_cells].ravel(), False), (helices[k][:, own_cells].ravel(), False),
                ]  # fmt: skip
                if side < 0:
                    around = [(edge, not way) for edge, way in reversed(around)]
                self.face(surface, around, along=side > 0, threaded=True)
        return _Strip(tuple(levels), first, first + self.steps, np.stack(corners), np.stack(helices), tuple(across))

    def _splines(self, start: Index, end: Index, knots: Real, points: Index, alike: slice) -> Index:
        """Edges between vertices (n, k) with points (n, k, poles); those that the screw carries along are a bundle."""
        made = []
        for own in (slice(0, alike.start), alike, slice(alike.stop, None)):
            if not start[:, own].size:
                continue
            shape = Spline(_DEGREE, knots, points[:, own].reshape(-1, points.shape[-1]))
            ends = start[:, own].ravel(), end[:, own].ravel()
            made.append(self.add_edges(*ends, shape).reshape(start[:, own].shape))
        return np.concatenate(made, axis=1)

    def solid_points(self, vertices: Index) -> Index:
        """The points that vertices are."""
        return np.concatenate(self.vertices)[vertices]

    def _arc(self, radius: float, z: float, start: Index, end: Index) -> Use:
        """Arcs about the axis towards growing angles of a right-hand worm."""
        frame = Frame(self.add_points(np.zeros(1, complex), z), UP, AHEAD)
        if self.worm.sign < 0:
            return self.add_edges(end, start, Circular(frame, radius)), False
        return self.add_edges(start, end, Circular(frame, radius)), True

    def _pipe(self, radius: float) -> kinds.Cylinder:
        return kinds.Cylinder(Frame(self.add_points(np.zeros(1, complex), 0.0), UP, AHEAD), radius)

    def lands(self) -> None:
        """The tip cylinder of every thread."""
        worm, upper, lower = self.worm, self.strips[1], self.strips[-1]
        surface = self._pipe(worm.tip_radius)
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
            end: self._arc(worm.tip_radius, end * float(self.body.end_height(worm.tip_radius)),
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
        surface, radius = self._pipe(worm.root_radius), worm.root_radius
        n = len(self.starts)
        # the thread above is the one before, so many steps on
        above = np.roll(np.arange(n), 1)
        root = np.array([self.joints[0]])
        ends = {
            (side, end): float(self._end(end, side, root)[0]) - (math.tau / n if side < 0 else 0.0)
            for side in (1, -1) for end in (-1, 1)
        }  # fmt: skip
        below_nodes = {number: upper.corners[0][:, c] for c, number in enumerate(upper.levels) if self._inner(upper, c)}
        above_nodes = {
            number - self.between: lower.corners[0][above, c]
            for c, number in enumerate(lower.levels) if self._inner(lower, c)
        }  # fmt: skip
        margin = _REST * self.step / 2
        numbers = range(
            min(*below_nodes, *above_nodes, 0) - self.between, max(*below_nodes, *above_nodes) + self.between
        )
        # nodes on the circles at both ends, where lines stand on them
        circles: dict[int, list[tuple[int, Index]]] = {-1: [], 1: []}
        lines: list[tuple[int, Index, Index]] = []
        for number in numbers:
            angle = self.level(number)
            foot, head = below_nodes.get(number), above_nodes.get(number)
            on = {
                -1: ends[-1, -1] + margin < angle < ends[1, -1] - margin,
                1: ends[-1, 1] + margin < angle < ends[1, 1] - margin,
            }
            if foot is None and on[-1] and (head is not None or on[1]):
                foot = self._on_circle(number, radius, -half)
                circles[-1].append((number, foot))
            if head is None and on[1] and foot is not None:
                head = self._on_circle(number, radius, half)
                circles[1].append((number, head))
            if foot is not None and head is not None:
                lines.append((number, foot, head))
        # both ways from the lower end of the side above to the upper end of the side below
        start, stop = lower.corners[0][above, 0], upper.corners[0][:, -1]
        bottom, bottom_nodes = self._arcs(radius, -half, [start, *(x for _, x in circles[-1]), upper.corners[0][:, 0]])
        top, top_nodes = self._arcs(radius, half, [lower.corners[0][above, -1], *(x for _, x in circles[1]), stop])
        bottom += [(e, True) for e in upper.helices[0].T]
        bottom_nodes += [upper.corners[0][:, c] for c in range(1, len(upper.levels))]
        top = [(e, True) for e in lower.helices[0][above].T] + top
        top_nodes = [lower.corners[0][above, c] for c in range(len(lower.levels) - 1)] + top_nodes
        self.space_arcs = {-1: bottom[: len(circles[-1]) + 1], 1: top[len(lower.levels) - 1 :]}
        feet, heads = (np.stack([line[k] for line in lines]) for k in (1, 2))
        edges = self.add_edges(feet.ravel(), heads.ravel(), Straight(UP)).reshape(feet.shape)
        at = [(_find(bottom_nodes, foot), _find(top_nodes, head)) for _, foot, head in lines]
        cuts = [(0, 0), *at, (len(bottom), len(top))]
        # faces of alike bounds are one bundle
        alike: dict[tuple[bool, ...], list[list[Use]]] = {}
        for i, ((b0, t0), (b1, t1)) in enumerate(pairwise(cuts)):
            around = bottom[b0:b1]
            if i < len(edges):
                around = [*around, (edges[i], True)]
            around += [(edge, not way) for edge, way in reversed(top[t0:t1])]
            if i > 0:
                around.append((edges[i - 1], False))
            alike.setdefault(tuple(way for _, way in around), []).append(around)
        for ways, faces in alike.items():
            columns = [np.concatenate([around[k][0] for around in faces]) for k in range(len(ways))]
            self.face(surface, list(zip(columns, ways, strict=True)))

    def _inner(self, strip: _Strip, column: int) -> bool:
        """Whether a column is none of the ends."""
        return 0 < column < len(strip.levels) - 1

    def _on_circle(self, number: int, radius: float, z: float) -> Index:
        angle = self.worm.sign * (self.level(number) + math.tau * self.starts / len(self.starts))
        return self.add_vertices(self.add_points(radius * np.exp(1j * angle), z))

    def _arcs(self, radius: float, z: float, nodes: list[Index]) -> tuple[list[Use], list[Index]]:
        """Arcs from node to node; and the nodes."""
        return [self._arc(radius, z, a, b) for a, b in pairwise(nodes)], nodes

    def thread_ends(self) -> None:
        """What the cones, or planes, at both ends leave of every thread."""
        worm, half, upper, lower = self.worm, self.body.length / 2, self.strips[1], self.strips[-1]
        for end, column in ((-1, 0), (1, -1)):
            origin = self.add_points(np.zeros(1, complex), end * half)
            surface: kinds.Surface
            if self.body.end_angle > 0:
                frame = Frame(origin, -end * UP, AHEAD)
                surface = kinds.Cone(frame, worm.root_radius, math.pi / 2 - self.body.end_angle)
            else:
                surface = kinds.Plane(Frame(origin, UP, AHEAD))
            under = self._arc(worm.root_radius, end * half, upper.corners[0][:, column], lower.corners[0][:, column])
            around: list[Use] = [(e[:, column], True) for e in upper.across]
            around.append(self.tip_arcs[end])
            around += [(e[:, column], False) for e in reversed(lower.across)]
            around.append((under[0], not under[1]))
            if end < 0:
                around = [(edge, not way) for edge, way in reversed(around)]
            self.face(surface, around, along=end > 0 or self.body.end_angle > 0)
            # the whole circle, thread by thread: what lies above thread j comes before it
            own = [*self.space_arcs[end], under]
            self.rims[end] = [(np.array([edge[j]]), way) for j in range(len(self.starts)) for edge, way in own]

    # shafts -----------------------------------------------------------------------------------------------------

    def shafts(self, bore: Outline | None) -> None:
        """The shaft beyond both ends, the end faces, and the bore through all of it."""
        hole = None
        if bore is not None:
            low, high = self.body.ends()
            hole = {-1: self.ring(bore, low), 1: self.ring(bore, high)}
            self.swept(hole[-1], hole[1], UP)
        for end in (-1, 1):
            points = self.body.outline(above=end > 0)
            # as seen from the end
            outer: list[Use] = (
                self.rims[end] if self.worm.sign > 0 else [(e, not w) for e, w in reversed(self.rims[end])]
            )
            for before, after in pairwise(points):
                ring = self.ring(_whole(after[1]), after[0], self._first_angle(outer))
                if before[0] == after[0]:
                    self._level(
                        after[0], outer, [(e, True) for e in ring.edges], up=(after[1] < before[1]) == (end > 0)
                    )
                else:
                    self._round(before, after, outer, ring, end)
                outer = [(e, True) for e in ring.edges]
            inner = None if hole is None else hole[end].loop(forwards=end > 0)
            loops = [_loop(outer, left=end > 0)]
            self.cap(points[-1][0], loops if inner is None else [*loops, inner], up=end > 0)

    def _first_angle(self, outer: list[Use]) -> float:
        x, y, _ = self.place(self._first(outer))[0]
        return math.atan2(y, x)

    def _first(self, outer: list[Use]) -> Index:
        """The vertex (1,) at which a ring begins."""
        number, way = outer[0]
        place = int(number[0])
        for bundle in self.edges:
            if place < len(bundle.start):
                return (bundle.start if way else bundle.end)[place : place + 1]
            place -= len(bundle.start)
        raise IndexError(number)

    def _level(self, z: float, outer: list[Use], inner: list[Use], *, up: bool) -> None:
        """A plane ring between two circles."""
        wide, narrow = outer, inner
        if self._radius(outer) < self._radius(inner):
            wide, narrow = inner, outer
        self.cap(z, [_loop(wide, left=up), _loop(narrow, left=not up)], up=up)

    def _radius(self, outer: list[Use]) -> float:
        x, y, _ = self.place(self._first(outer))[0]
        return math.hypot(x, y)

    def _round(
        self, before: tuple[float, float], after: tuple[float, float], outer: list[Use], ring: Ring, end: int
    ) -> None:
        """A cylinder or a cone from a circle to the next one, outwards."""
        (z0, r0), (z1, r1) = before, after
        surface: kinds.Surface
        if r0 == r1:
            surface = kinds.Cylinder(Frame(self.add_points(np.zeros(1, complex), z0), UP, AHEAD), r0)
        else:
            # towards the wider end
            way = math.copysign(1.0, (r1 - r0) * (z1 - z0))
            z, r = (z0, r0) if r0 < r1 else (z1, r1)
            frame = Frame(self.add_points(np.zeros(1, complex), z), way * UP, AHEAD)
            surface = kinds.Cone(frame, r, math.atan2(abs(r1 - r0), abs(z1 - z0)))
        first = self._first(outer)
        straight = self.place(ring.starts[0]) - self.place(first)
        seam = self.add_edges(first, ring.starts[0], Straight(straight / np.linalg.norm(straight)))
        rim = [(e, True) for e in ring.edges]
        around = [*outer, (seam, True), *((e, not w) for e, w in reversed(rim)), (seam, False)]
        if end < 0:
            around = [(e, not w) for e, w in reversed(around)]
        edges, ways = zip(*around, strict=True)
        self.faces.append(Faces(surface, ((np.stack(edges, axis=1), np.array(ways)),)))


def _poles(knots: Real, points: Real, axis: int) -> Real:
    """Poles of splines through points at Greville's places along an axis."""
    moved = np.moveaxis(points, axis, 0)
    found = np.linalg.solve(basis_matrix(_DEGREE, knots, greville(_DEGREE, knots)), moved.reshape(len(moved), -1))
    return np.asarray(np.moveaxis(np.asarray(found.reshape(moved.shape), float), 0, axis))


def _find(nodes: list[Index], node: Index) -> int:
    return next(k for k, other in enumerate(nodes) if other[0] == node[0])


def _whole(radius: float) -> Outline:
    return Outline((Arc(0j, radius, 0.0, math.tau),), 1, 0.0, "exact")


def _loop(outer: list[Use], *, left: bool) -> kinds.Loop:
    """A ring, which turns left as seen from above, as the loop of a face."""
    around = outer if left else [(e, not w) for e, w in reversed(outer)]
    edges, ways = zip(*around, strict=True)
    return np.stack(edges, axis=1), np.array(ways)

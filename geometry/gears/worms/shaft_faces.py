"""What every worm has beside its thread: its frame, the shaft beyond both ends, the end faces, and the bore."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise

import numpy as np

from geometry.approximation.outline import Outline
from geometry.curves.curve import Real
from geometry.curves.line_arc import Arc
from geometry.gears.worms.body import WormBody
from geometry.solids import faces as kinds
from geometry.solids.faces import Circular, Index, Straight, Use, loop_of, turned_over
from geometry.solids.rings import UP, Ring, RingBuilder

# steps of the polar angle: one start has so many a turn; more starts have one or two from thread to thread
_STEPS = 4
# what is left of a step at an end at least, part of it
REST = 0.25


class WormRings(RingBuilder):
    """Vertices, edges and faces of one worm; angles are those of a right-hand one.

    ``rims``: by end (-1, 1) the edges of the circle in which the threaded part ends.
    """

    def __init__(self, body: WormBody) -> None:
        super().__init__()
        self.body, self.thread, self.worm = body, body.thread, body.thread.worm
        self.starts = np.arange(self.worm.number_of_starts)
        # steps from thread to thread, and their angle
        self.between = max(1, math.ceil(_STEPS / len(self.starts)))
        self.step = math.tau / (len(self.starts) * self.between)
        self.rims: dict[int, list[Use]] = {}

    def placed(self, points: Real) -> Index:
        """Numbers of points (..., 3) of thread 0 on all threads, (n, ...)."""
        turn = np.exp(1j * self.worm.sign * math.tau * self.starts / len(self.starts))
        plane = points[..., 0] + 1j * points[..., 1]
        shape = (len(self.starts),) + (1,) * plane.ndim
        return self.add_points(
            turn.reshape(shape) * plane, np.broadcast_to(points[..., 2], (len(self.starts), *plane.shape))
        )

    def face(self, surface: kinds.Surface, around: list[Use], *, along: bool = True, threaded: bool = False) -> None:
        """Faces within edges that turn left about their surfaces' normals outwards, of a right-hand worm.

        ``along``: those point outwards; ``threaded``: a left-hand worm has them turned over.
        """
        if self.worm.sign < 0:
            around, along = turned_over(around), along != threaded
        self.bounded(surface, around, along=along)

    def panels(
        self,
        edges: Sequence[Index] | Index,
        ends: Sequence[tuple[Index, Index]],
        below: tuple[list[Use], list[Index]],
        above: tuple[list[Use], list[Index]],
    ) -> list[list[Use]]:
        """What lies between two chains of edges, cut by ``edges`` from a node of the lower to one of the upper one."""
        (bottom, bottom_nodes), (top, top_nodes) = below, above
        at = [(_find(bottom_nodes, foot), _find(top_nodes, head)) for foot, head in ends]
        made = []
        for i, ((b0, t0), (b1, t1)) in enumerate(pairwise([(0, 0), *at, (len(bottom), len(top))])):
            right: list[Use] = [(edges[i], True)] if i < len(edges) else []
            left: list[Use] = [(edges[i - 1], False)] if i > 0 else []
            made.append([*bottom[b0:b1], *right, *turned_over(top[t0:t1]), *left])
        return made

    def on_circle(self, radius: float, angle: float, z: float) -> Index:
        """New vertices at an angle of thread 0 of a right-hand worm, rad, on all threads, (n,)."""
        turned = self.worm.sign * (angle + math.tau * self.starts / len(self.starts))
        return self.add_vertices(self.add_points(radius * np.exp(1j * turned), z))

    def uprights(
        self, numbers: Iterable[int], nodes: tuple[dict[int, Index], dict[int, Index]],
        angle_of: Callable[[int], float], room: Sequence[tuple[float, float]], radius: float, half: float,
    ) -> tuple[list[Index], list[Index], list[tuple[Index, Index]]]:  # fmt: skip
        """New nodes on the circles at -half and half, and the ends of upright lines, from the left on.

        ``nodes``: those of the lower and the upper chain by the ``numbers`` of their steps; where a chain has none, a
        line ends on its circle, if its angle has ``room`` there.
        """
        low, high, lines = list[Index](), list[Index](), list[tuple[Index, Index]]()
        for number in numbers:
            (foot, head), angle = (own.get(number) for own in nodes), angle_of(number)
            free = [least < angle < most for least, most in room]
            if foot is None and free[0] and (head is not None or free[1]):
                foot = self.on_circle(radius, angle, -half)
                low.append(foot)
            if head is None and free[1] and foot is not None:
                head = self.on_circle(radius, angle, half)
                high.append(head)
            if foot is not None and head is not None:
                lines.append((foot, head))
        return low, high, lines

    def arc(self, radius: float, z: float, start: Index, end: Index) -> Use:
        """Arcs about the axis towards growing angles of a right-hand worm."""
        forwards, circle = self.worm.sign > 0, Circular(self.frame_at(z), radius)
        return self.add_edges(*((start, end) if forwards else (end, start)), circle), forwards

    def arcs(self, radius: float, z: float, nodes: list[Index]) -> tuple[list[Use], list[Index]]:
        """Arcs from node to node; and the nodes."""
        return [self.arc(radius, z, a, b) for a, b in pairwise(nodes)], nodes

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
            outer = self.rims[end] if self.worm.sign > 0 else turned_over(self.rims[end])
            for before, after in pairwise(points):
                ring = self.ring(_whole(after[1]), after[0], cmath.phase(self._start(outer)))
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

    def _start(self, outer: list[Use]) -> complex:
        """Where a ring begins, x + iy."""
        x, y, _ = self.place(self._first(outer))[0].tolist()
        return complex(x, y)

    def _first(self, outer: list[Use]) -> Index:
        """The vertex (1,) at which a ring begins."""
        number, way = outer[0]
        ends = np.cumsum([len(bundle.start) for bundle in self.edges])
        k = int(np.searchsorted(ends, number[0], side="right"))
        return (self.edges[k].start if way else self.edges[k].end)[number[:1] - ends[k]]

    def _level(self, z: float, outer: list[Use], inner: list[Use], *, up: bool) -> None:
        """A plane ring between two circles."""
        narrow, wide = sorted((inner, outer), key=lambda ring: abs(self._start(ring)))
        self.cap(z, [_loop(wide, left=up), _loop(narrow, left=not up)], up=up)

    def _round(
        self, before: tuple[float, float], after: tuple[float, float], outer: list[Use], ring: Ring, end: int
    ) -> None:
        """A cylinder or a cone from a circle to the next one, outwards."""
        (z0, r0), (z1, r1) = before, after
        surface = self.lathed(complex(r0, z0), complex(r1, z1))
        first = self._first(outer)
        straight = self.place(ring.starts[0]) - self.place(first)
        seam = self.add_edges(first, ring.starts[0], Straight(straight / np.linalg.norm(straight)))
        around = [*outer, (seam, True), *((e, False) for e in reversed(ring.edges)), (seam, False)]
        self.bounded(surface, around if end > 0 else turned_over(around))


def _whole(radius: float) -> Outline:
    return Outline((Arc(0j, radius, 0.0, math.tau),), 1, 0.0, "exact")


def _loop(outer: list[Use], *, left: bool) -> kinds.Loop:
    """A ring, which turns left as seen from above, as the loop of a face."""
    return loop_of(outer if left else turned_over(outer))


def _find(nodes: list[Index], node: Index) -> int:
    return next(k for k, other in enumerate(nodes) if other[0] == node[0])

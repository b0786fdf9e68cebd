"""Level lines of a function of the plane: where f(x, y) = 0, as chains of points that are roots of f."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from itertools import pairwise

from geometry.base.record import Record
from geometry.base.roots import bracketed_root

Field = Callable[[float, float], float]
Edge = tuple[int, int, int]


class Box(Record):
    """A rectangle of the plane and the number of grid cells along each side."""

    left: float
    right: float
    bottom: float
    top: float
    cells: int

    def x(self, i: int) -> float:
        """Grid line i."""
        return self.left + (self.right - self.left) * i / self.cells

    def y(self, j: int) -> float:
        """Grid line j."""
        return self.bottom + (self.top - self.bottom) * j / self.cells


def level_lines(field: Field, box: Box, tolerance: float) -> list[list[complex]]:
    """The lines field = 0 inside a box; a closed line ends where it begins.

    Every point is a bracketed root; points are added until the middle of each chord is within ``tolerance`` of the
    line. Lines smaller than a grid cell may be missed; where the field is nan there is none.
    """

    def on_row(y: float, x: float) -> float:
        return field(x, y)

    n = box.cells
    values = [[field(box.x(i), box.y(j)) for j in range(n + 1)] for i in range(n + 1)]
    points: dict[Edge, complex] = {}
    for i in range(n + 1):
        for j in range(n + 1):
            here = values[i][j]
            if i < n and _crosses(here, values[i + 1][j]):
                y, ends = box.y(j), (here, values[i + 1][j])
                points[i, j, 0] = complex(_root(partial(on_row, y), box.x(i), box.x(i + 1), ends), y)
            if j < n and _crosses(here, values[i][j + 1]):
                x, ends = box.x(i), (here, values[i][j + 1])
                points[i, j, 1] = complex(x, _root(partial(field, x), box.y(j), box.y(j + 1), ends))
    links: dict[Edge, list[Edge]] = {edge: [] for edge in points}
    for i in range(n):
        for j in range(n):
            for one, two in _cell_links(field, box, values, points, i, j):
                links[one].append(two)
                links[two].append(one)
    return [_refined(field, [points[edge] for edge in chain], tolerance) for chain in _chains(links)]


def _crosses(one: float, two: float) -> bool:
    return math.isfinite(one) and math.isfinite(two) and (one >= 0) != (two >= 0)


def _root(function: Callable[[float], float], low: float, high: float, at_ends: tuple[float, float]) -> float:
    return bracketed_root(function, low, high, at_ends=at_ends).value


def _cell_links(
    field: Field, box: Box, values: list[list[float]], points: dict[Edge, complex], i: int, j: int
) -> list[tuple[Edge, Edge]]:
    """Which crossings on the border of a cell belong to one line."""
    # anticlockwise from the lower side
    sides = [e for e in ((i, j, 0), (i + 1, j, 1), (i, j + 1, 0), (i, j, 1)) if e in points]
    if len(sides) < 2:
        return []
    if len(sides) == 2:
        return [(sides[0], sides[1])]
    if len(sides) == 3:
        return []
    # a saddle: the middle tells which corners are joined
    middle = field((box.x(i) + box.x(i + 1)) / 2, (box.y(j) + box.y(j + 1)) / 2)
    if (middle >= 0) == (values[i][j] >= 0):
        return [(sides[0], sides[1]), (sides[2], sides[3])]
    return [(sides[0], sides[3]), (sides[1], sides[2])]


def _chains(links: dict[Edge, list[Edge]]) -> list[list[Edge]]:
    """Edges in the order of the lines, open ones first."""
    chains, left = [], {edge: list(ends) for edge, ends in links.items() if ends}
    while left:
        start = next((edge for edge, ends in left.items() if len(ends) == 1), next(iter(left)))
        chain, at = [start], start
        while left.get(at):
            ahead = left[at].pop()
            left[ahead].remove(at)
            chain.append(ahead)
            at = ahead
        chains.append(chain)
        left = {edge: ends for edge, ends in left.items() if ends}
    return chains


def _refined(field: Field, chain: list[complex], tolerance: float) -> list[complex]:
    result = chain[:1]
    for one, two in pairwise(chain):
        result += [*_between(field, one, two, tolerance, 8), two]
    return result


def _between(field: Field, one: complex, two: complex, tolerance: float, depth: int) -> list[complex]:
    """Points of the line between two of its points, found along the chord's normal."""
    length = abs(two - one)
    if depth == 0 or length < tolerance:
        return []
    middle, normal = (one + two) / 2, 1j * (two - one) / length

    def along(t: float) -> float:
        point = middle + t * normal
        return field(point.real, point.imag)

    # where the line passes so near nothing is added, and how near exactly need not be known
    if _crosses(along(-tolerance), along(tolerance)):
        return []
    # a little more than half, which a right-angled corner of the line takes
    reach = 0.55 * length
    ends = along(-reach), along(reach)
    if not _crosses(*ends):
        return []
    height = _root(along, -reach, reach, ends)
    if abs(height) <= tolerance:
        return []
    point = middle + height * normal
    before = _between(field, one, point, tolerance, depth - 1)
    return [*before, point, *_between(field, point, two, tolerance, depth - 1)]

"""Triangles of plane caps: toothed rings and annuli straight from numpy, any other region through manifold3d.

One tooth is triangulated and placed ``count`` times. Every triangulation is held against the exact sum of the
polygon's area before it is used; no vertex is added but the middle of a wheel without a bore.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from geometry.base.distinct import distinct
from geometry.base.errors import ThinWallError
from geometry.base.record import replace
from geometry.curves.curve import Complex, Real
from geometry.plane.contour import Contour

Triangles = NDArray[np.int64]
# triangles, and the points that were added for them
Filled = tuple[Triangles, Complex]
# of the grid on which vertices stand, in a reach of 1
_GRID_DIGITS = 8
# height of a triangle, in a reach of 1, that the roundings of a float32 may turn over
_FLAT = 2.0**-22
# decimals of angles (rad) and heights (mm) that are compared
_ANGLE_DIGITS, _HEIGHT_DIGITS = 11, 10


def grid_decimals(reach: float) -> int:
    """Decimals of a mesh's vertices: a step of 1e-8 of its reach or less, which a float32 does not hold."""
    return _GRID_DIGITS - math.floor(math.log10(reach) + 1e-9)


def cap_triangles(outer: Contour, holes: Sequence[Contour]) -> Filled:
    """Triangles of the plane region between chords, and the points that were added to the contours' own.

    Indices count the outer contour's vertices, period after period, then those of each hole, then the added
    points. The outer contour begins in a space of its teeth, see ``start_in_space``; loops may run either way.

    Raises
    ------
    ThinWallError
        No triangulation fills the region: chords touch or cross.
    """
    loops = [c.expanded()[0] for c in (outer, *holes)]
    points = np.concatenate(loops)
    rings = numbered(loops)
    if _area(loops[0]) < 0:
        # the rim of a recess runs clockwise as a wall, but bounds the floor from outside
        rings[0], outer = rings[0][::-1], Contour(loops[0], np.zeros(len(loops[0])))
    rings[1:] = [ring if _area(points[ring]) < 0 else ring[::-1] for ring in rings[1:]]
    area = sum(_area(points[ring]) for ring in rings)
    for attempt in (_by_teeth, _by_sectors, _whole):
        try:
            triangles, added = attempt(outer, holes, points, rings)
        except ThinWallError:
            continue
        doubled = _cross(np.append(points, added), triangles)
        # positive triangles that fill the area cannot overlap
        if np.all(doubled > 0) and np.isclose(0.5 * doubled.sum(), area, rtol=1e-9):
            return triangles, added
    raise ThinWallError("the outlines touch or cross at this tolerance; make it smaller")


def numbered(rings: Sequence[Complex | Real]) -> list[Triangles]:
    """The numbers of the points of rings that stand one behind the other."""
    ends = np.cumsum([0, *map(len, rings)]).tolist()
    return [np.arange(a, b) for a, b in pairwise(ends)]


def _area(polygon: Complex) -> float:
    """Signed area, counter-clockwise positive."""
    return 0.5 * float(np.sum((np.conj(polygon) * np.roll(polygon, -1)).imag))


_NONE = np.zeros(0, dtype=complex)


def _by_teeth(outer: Contour, holes: Sequence[Contour], points: Complex, rings: list[Triangles]) -> Filled:
    """Teeth above the chords between their spaces, then the core within those chords."""
    teeth, ring = _teeth(outer)
    ring = rings[0][ring]
    if not holes and _is_star(points[ring]):
        middle = np.full(len(ring), len(points))
        return np.concatenate([*teeth, np.stack([middle, ring, np.roll(ring, -1)], axis=1)]), np.zeros(1, complex)
    if len(holes) == 1 and is_round(holes[0]) and _is_star(points[ring]):
        core = _annulus(points, ring, rings[1][::-1])
    else:
        core = library_triangles(points, [ring, *rings[1:]])
    return np.concatenate([*teeth, core]), _NONE


def _whole(outer: Contour, holes: Sequence[Contour], points: Complex, rings: list[Triangles]) -> Filled:
    return library_triangles(points, rings), _NONE


def library_triangles(points: Complex, rings: list[Triangles]) -> Triangles:
    """Triangles of any polygon with holes; no vertex is added.

    Raises
    ------
    ThinWallError
        They do not fill it: rings (the first outside, the others clockwise) touch or cross.
    """
    import manifold3d

    # chords that meet within a few roundings are one to the library
    epsilon = 1e-14 * float(np.max(np.abs(points)))
    polygons = [np.stack([points[r].real, points[r].imag], axis=1) for r in rings]
    numbers = np.concatenate(rings)
    triangles: Triangles = numbers[manifold3d.triangulate(polygons, epsilon).astype(np.int64)]
    doubled = _cross(points, triangles)
    if not (np.all(doubled >= 0) and np.isclose(0.5 * doubled.sum(), sum(_area(points[r]) for r in rings), rtol=1e-9)):
        raise ThinWallError("the outlines touch or cross at this tolerance; make it smaller")
    # corners in one line, those of holes in rows, leave triangles without area, or what a file turns over
    corners = points[triangles]
    longest = np.abs(corners - np.roll(corners, 1, axis=1)).max(axis=1)
    flat = _FLAT * float(np.max(np.abs(points))) * longest
    return triangles if np.all(doubled > flat) else _delaunay(points, numbers, polygons)


def _delaunay(points: Complex, numbers: Triangles, polygons: list[Real]) -> Triangles:
    """The constrained Delaunay triangles of a polygon with holes, by the library of planes."""
    import shapely

    try:
        found = shapely.constrained_delaunay_triangles(shapely.Polygon(polygons[0], polygons[1:]))
    except shapely.errors.GEOSException as error:
        raise ThinWallError("the outlines touch or cross at this tolerance; make it smaller") from error
    x, y = shapely.get_coordinates(found).reshape(-1, 4, 2)[:, :3].transpose(2, 0, 1)
    order = numbers[np.argsort(points[numbers])]
    triangles = order[np.searchsorted(points[order], x + 1j * y)]
    return np.where(_cross(points, triangles)[:, None] > 0, triangles, triangles[:, ::-1])


def is_round(contour: Contour) -> bool:
    """Whether all vertices stand on one circle about the origin."""
    radii = np.abs(contour.vertices)
    return bool(np.ptp(radii) <= 1e-12 * radii[0])


def _is_star(ring: Complex) -> bool:
    """Whether every edge is seen from the origin, counter-clockwise."""
    return bool(np.all((np.conj(ring) * np.roll(ring, -1)).imag > 0))


def _teeth(outline: Contour) -> tuple[list[Triangles], Triangles]:
    """Triangles of all teeth above the chords between their spaces, and the ring of what is left."""
    size, count = len(outline.vertices), outline.count
    if count < 3 or is_round(outline):
        return [], np.arange(size * count)
    # the period begins with the tooth and ends with the root land, whose corners all stand on the ring
    tooth_end = _last_of_tooth(outline)
    land = np.append(np.arange(tooth_end, size), 0)
    ring = distinct(np.add.outer(land, np.arange(count) * size) % (size * count))
    polygon = np.append(outline.vertices, outline.period_ends()[-1])[: tooth_end + 1]
    return [_placed(_polygon_triangles(polygon), size, count)], ring


def aligned_bore(outline: Contour, bore: Contour) -> Contour:
    """A round bore, clockwise, with as many corners behind every tooth: for rims thinner than their chords."""
    count = -(-len(bore) // outline.count) * outline.count
    start = abs(bore.vertices[0]) * np.exp(1j * np.angle(outline.vertices[0]))
    return Contour(start * np.exp(-2j * np.pi / count * np.arange(count)), np.zeros(count))


def _by_sectors(outer: Contour, holes: Sequence[Contour], points: Complex, rings: list[Triangles]) -> Filled:
    """One whole sector between an aligned bore and a tooth, clipped and placed."""
    size, count = len(outer.vertices), outer.count
    if count < 3 or len(holes) != 1 or len(holes[0]) % count or not is_round(holes[0]):
        raise ThinWallError("the bore has no corners of its own behind every tooth")
    total, steps = size * count, len(holes[0]) // count
    period = np.arange(count)[:, None]
    outside = rings[0][(period * size + np.arange(size + 1)) % total]
    inside = total + (-(period * steps + np.arange(steps, -1, -1))) % (steps * count)
    places = np.concatenate([outside, inside], axis=1)
    return places[:, _ear_clipped(points[places[0]])].reshape(-1, 3), _NONE


def start_in_space(contour: Contour) -> int:
    """The vertex at which a tooth leaves the root circle: after the last one nearest to the axis."""
    size, half = len(contour.vertices), np.pi / contour.count
    ahead = np.flatnonzero(np.angle(contour.vertices) > half - 1e-12)
    first = int(ahead[0]) if ahead.size else 0
    radii = np.roll(np.abs(contour.vertices), -first)
    lowest = radii <= radii.min() * (1 + 1e-9)
    lead = 0
    while lead + 1 < size and lowest[lead] and lowest[lead + 1]:
        lead += 1
    return (first + lead) % size


def begun_at(contour: Contour, index: int) -> Contour:
    """The same contour, its period begun at another vertex."""
    turn = np.exp(1j * contour.pitch_angle)
    vertices = np.concatenate([contour.vertices[index:], contour.vertices[:index] * turn])
    return replace(contour, vertices=vertices, bulges=np.roll(contour.bulges, -index))


def _last_of_tooth(outline: Contour) -> int:
    """Index of the vertex at which a tooth comes back to the root circle (the period's length: at its end)."""
    radii = np.abs(outline.vertices)
    lowest = np.flatnonzero(radii <= radii.min() * (1 + 1e-9))
    after = lowest[lowest > int(np.argmax(radii))]
    return int(after[0]) if after.size else len(radii)


def _placed(triangles: Triangles, size: int, count: int) -> Triangles:
    """One period's triangles on every period; vertex ``size`` of a period is the first of the next one."""
    offsets = (np.arange(count) * size)[:, None, None]
    return ((triangles + offsets) % (size * count)).reshape(-1, 3)


def _polygon_triangles(polygon: Complex) -> Triangles:
    """Triangles of one tooth above the chord between its roots: a ladder up both sides, or ear clipping."""
    ladder = _ladder(polygon)
    # the signed areas of any ladder are the polygon's: where none is turned over it fills that
    return ladder if np.all(_cross(polygon, ladder) > 0) else _ear_clipped(polygon)


def _ladder(polygon: Complex) -> Triangles:
    """Both sides of a polygon zipped upwards from the ends of its closing edge, always the lower one next."""
    low, high = 0, len(polygon) - 1
    base = polygon[-1] - polygon[0]
    x = np.round((polygon * np.conj(-1j * base / abs(base))).real, _HEIGHT_DIGITS)
    triangles = []
    while high - low > 1:
        if x[low + 1] <= x[high - 1]:
            triangles.append((low, low + 1, high))
            low += 1
        else:
            triangles.append((low, high - 1, high))
            high -= 1
    return np.array(triangles, dtype=np.int64).reshape(len(triangles), 3)


def _ear_clipped(polygon: Complex) -> Triangles:
    """Triangles of any simple counter-clockwise polygon; for the rare tooth that is no ladder."""
    left = list(range(len(polygon)))
    triangles = []
    while len(left) > 3:
        for i in range(len(left)):
            a, b, c = left[i - 1], left[i], left[(i + 1) % len(left)]
            if _is_ear(polygon, a, b, c, left):
                triangles.append((a, b, c))
                left.pop(i)
                break
        else:
            raise ThinWallError("the outline of a tooth crosses itself at this tolerance; make it smaller")
    triangles.append((left[0], left[1], left[2]))
    return np.array(triangles, dtype=np.int64)


def _is_ear(polygon: Complex, a: int, b: int, c: int, left: list[int]) -> bool:
    corner = polygon[[a, b, c]]
    after = np.roll(corner, -1)
    if ((np.conj(corner[1] - corner[0])) * (corner[2] - corner[0])).imag <= 0:
        return False
    others = polygon[[i for i in left if i not in (a, b, c)]]
    inside = (np.conj(after - corner)[:, None] * (others - corner[:, None])).imag >= 0
    return not bool(np.any(np.all(inside, axis=0)))


def _annulus(points: Complex, outer: Triangles, inner: Triangles) -> Triangles:
    """Triangles between two rings of vertex indices, both counter-clockwise about the origin.

    Every edge of a ring takes its apex from the other: the edges of both are merged by their middle angles.
    """
    rings = []
    for ring in (outer, inner):
        angle = np.mod(np.angle(points[ring]), 2 * np.pi)
        rings.append(np.roll(ring, -int(np.argmin(angle))))
    outer, inner = rings
    middles = [_middle_angles(points[ring]) for ring in (outer, inner)]
    n, k = len(outer), len(inner)
    apex_in = np.searchsorted(middles[1], middles[0]) % k
    apex_out = np.searchsorted(middles[0], middles[1], side="right") % n
    outwards = np.stack([outer, np.roll(outer, -1), inner[apex_in]], axis=1)
    inwards = np.stack([inner, outer[apex_out], np.roll(inner, -1)], axis=1)
    return np.concatenate([outwards, inwards])


def _middle_angles(ring: Complex) -> Real:
    """Increasing angles of the middles of a ring's edges, twice as large, the ring starting near angle 0."""
    start = np.mod(np.angle(ring), 2 * np.pi)
    # rounded: corners that stand one behind the other are a tie on any machine
    return np.round(start + np.append(start[1:], start[0] + 2 * np.pi), _ANGLE_DIGITS)


def _cross(points: Complex, triangles: Triangles) -> Real:
    """Twice the signed area of each triangle."""
    a, b, c = points[triangles].T
    return (np.conj(b - a) * (c - a)).imag

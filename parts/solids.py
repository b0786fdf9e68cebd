"""The only builder of solids. Meshes of extruded sections come straight from numpy: no kernel, no boolean.

One period of the section is triangulated and placed ``count`` times; both caps share their vertices with the
walls, so the mesh is closed by construction.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from geometry.contour import Contour
from geometry.curve import Complex
from geometry.errors import GeometryError

Triangles = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Mesh:
    """Vertices (n, 3) float, mm; triangles (k, 3) int, counter-clockwise seen from outside."""

    vertices: NDArray[np.float64]
    triangles: Triangles


def extruded_gear(outer: Contour, bore: Contour | None, thickness: float) -> Mesh:
    """The mesh of a toothed section with an optional round bore, from z = 0 to ``thickness`` mm.

    ``outer``: chords only, one tooth a period about +x, its first vertex anywhere in the period.
    """
    outline = _starting_in_space(outer)
    try:
        points, top, loops = _cap_of_rings(outline, bore)
    except _CapError:
        points, top, loops = _cap_of_sectors(outline, bore)
    return _extruded(points, top, loops, thickness)


def _cap_of_rings(outline: Contour, bore: Contour | None) -> tuple[Complex, Triangles, list[Triangles]]:
    """Teeth above the chords between their spaces, and the hub between those chords and the bore."""
    points, _ = outline.expanded()
    size, count = len(outline.vertices), outline.count
    # the period begins with the tooth and ends with the root land, whose corners all stand on the hub's ring
    tooth_end = _last_of_tooth(outline)
    land = np.append(np.arange(tooth_end, size), 0) if tooth_end < size else np.array([0])
    ring = np.unique((land + (np.arange(count) * size)[:, None]) % (size * count))
    polygon = np.append(outline.vertices, outline.period_ends()[-1])[: tooth_end + 1]
    caps = [_placed(_polygon_triangles(polygon), size, count)]
    loops = [np.arange(len(points))]
    if bore is None:
        hub = len(points)
        points = np.append(points, 0j)
        caps.append(np.stack([np.full(len(ring), hub), ring, np.roll(ring, -1)], axis=1))
    else:
        inner, _ = bore.expanded()
        order = np.arange(len(inner)) + len(points)
        points = np.append(points, inner)
        loops.append(order)
        caps.append(_annulus(points, ring, order[::-1]))
    top = np.concatenate(caps)
    _check_cap(points, top, loops)
    return points, top, loops


def _cap_of_sectors(outline: Contour, bore: Contour | None) -> tuple[Complex, Triangles, list[Triangles]]:
    """One whole sector from the bore to the tooth, clipped and placed: for rims thinner than their chords."""
    if bore is None:
        raise GeometryError("the outline of a tooth crosses itself at this tolerance; make it smaller")
    size, count = len(outline.vertices), outline.count
    steps = -(-len(bore) // count)
    pitch = 2 * np.pi / count
    spoke = abs(bore.vertices[0]) * np.exp(1j * np.angle(outline.vertices[0]))
    arc = spoke * np.exp(1j * pitch * np.arange(steps + 1) / steps)
    sector = np.concatenate([outline.vertices, outline.period_ends()[-1:], arc[::-1]])
    local = _ear_clipped(sector)
    points = np.concatenate([outline.expanded()[0], Contour(arc[:-1], np.zeros(steps), count).expanded()[0]])
    # sector corner -> vertex of period 0, and which period's copy of it
    inner = size * count + np.append(np.arange(steps), 0)[::-1]
    index = np.concatenate([np.arange(size), [0], inner])
    step = np.concatenate([np.full(size + 1, size), np.full(steps + 1, steps)])
    ahead = np.concatenate([np.zeros(size), [1], [1], np.zeros(steps)]).astype(int)
    base = np.where(np.arange(len(sector)) > size, size * count, 0)
    period = np.arange(count)[:, None] + ahead
    places = base + (index - base + period * step) % np.where(base > 0, steps * count, size * count)
    top = np.concatenate([row[local] for row in places])
    loops = [np.arange(size * count), (np.arange(steps * count) + size * count)[::-1]]
    _check_cap(points, top, loops)
    return points, top, loops


def _starting_in_space(contour: Contour) -> Contour:
    """The contour begun where a tooth leaves the root circle: after the last vertex nearest to the axis."""
    half = np.pi / contour.count
    ahead = np.flatnonzero(np.angle(contour.vertices) > half - 1e-12)
    first = int(ahead[0]) if ahead.size else 0
    vertices = np.concatenate([contour.vertices[first:] * np.exp(-2j * half), contour.vertices[:first]])
    bulges = np.concatenate([contour.bulges[first:], contour.bulges[:first]])
    lowest = np.abs(vertices) <= np.abs(vertices).min() * (1 + 1e-9)
    lead = 0
    while lead + 1 < len(vertices) and lowest[lead] and lowest[lead + 1]:
        lead += 1
    turn = np.exp(2j * np.pi / contour.count)
    vertices = np.concatenate([vertices[lead:], vertices[:lead] * turn])
    return Contour(vertices, np.concatenate([bulges[lead:], bulges[:lead]]), contour.count)


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
    doubled = _cross(polygon, ladder)
    area = 0.5 * float(np.sum((np.conj(polygon) * np.roll(polygon, -1)).imag))
    if np.all(doubled > 0) and np.isclose(0.5 * doubled.sum(), area, rtol=1e-9):
        return ladder
    return _ear_clipped(polygon)


def _ladder(polygon: Complex) -> Triangles:
    """Both sides of a polygon zipped upwards from the ends of its closing edge, always the lower one next."""
    low, high = 0, len(polygon) - 1
    base = polygon[-1] - polygon[0]
    x = (polygon * np.conj(-1j * base / abs(base))).real
    triangles = []
    while high - low > 1:
        if x[low + 1] <= x[high - 1]:
            triangles.append((low, low + 1, high))
            low += 1
        else:
            triangles.append((low, high - 1, high))
            high -= 1
    return np.array(triangles, dtype=np.int64).reshape(-1, 3)


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
            raise GeometryError("the outline of a tooth crosses itself at this tolerance; make it smaller")
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


def _middle_angles(ring: Complex) -> NDArray[np.float64]:
    """Increasing angles of the middles of a ring's edges, the ring starting near angle 0."""
    start = np.mod(np.angle(ring), 2 * np.pi)
    return (start + np.append(start[1:], start[0] + 2 * np.pi)) / 2


def _cross(points: Complex, triangles: Triangles) -> NDArray[np.float64]:
    """Twice the signed area of each triangle."""
    a, b, c = points[triangles].T
    return (np.conj(b - a) * (c - a)).imag


def _check_cap(points: Complex, triangles: Triangles, loops: list[Triangles]) -> None:
    """Raise where the cap's triangles overlap: all must be positive and fill the section's area."""
    doubled = _cross(points, triangles)
    area = sum(0.5 * float(np.sum((np.conj(points[w]) * np.roll(points[w], -1)).imag)) for w in loops)
    if not (np.all(doubled > 0) and np.isclose(0.5 * doubled.sum(), area, rtol=1e-9)):
        raise _CapError("the cap cannot be triangulated from rings")


class _CapError(GeometryError):
    """The ring between root circle and bore is too thin for its chords."""


def _extruded(points: Complex, top: Triangles, loops: list[Triangles], thickness: float) -> Mesh:
    """Both caps and the walls; material lies left of every loop."""
    n = len(points)
    flat = np.stack([points.real, points.imag, np.zeros(n)], axis=1)
    vertices = np.concatenate([flat, flat + np.array([0.0, 0.0, thickness])])
    walls = []
    for loop in loops:
        after = np.roll(loop, -1)
        walls.append(np.stack([loop, after, after + n], axis=1))
        walls.append(np.stack([loop, after + n, loop + n], axis=1))
    return Mesh(vertices, np.concatenate([top[:, ::-1], top + n, *walls]))

"""A solid as its faces between shared edges: every edge one curve, made once, and run once each way by its faces.

What stands several times (the teeth of a wheel) is one bundle: a record whose arrays have a row for each place. Points,
vertices and edges are numbered through the whole solid, and curves and surfaces take their poles from its points, so
that a surface and the edges at its rim share them. Nothing here knows of a kernel, a mesh or a file.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from geometry.base.record import Record
from geometry.curves.curve import Complex, Flags, Real

Index = NDArray[np.intp]


class Frame(Record, eq=False):
    """Right-handed places (n or 1 rows): points (n,) of the solid, directions (n, 3) of the axis and of angle 0."""

    origin: Index
    axis: Real
    zero: Real


class Straight(Record, eq=False):
    """Lines along directions (n or 1, 3)."""

    direction: Real


class Circular(Record, eq=False):
    """Arcs about an axis, counter-clockwise; whole circles where start and end are one vertex. mm."""

    frame: Frame
    radius: float


class Spline(Record, eq=False):
    """B-splines on one clamped knot vector, with points (n, m) of the solid as poles."""

    degree: int
    knots: Real
    poles: Index


class Edges(Record, eq=False):
    """Edges of one kind from vertices ``start`` to ``end``, (n,)."""

    start: Index
    end: Index
    curve: Straight | Circular | Spline


class Plane(Record, eq=False):
    """Planes across their axes."""

    frame: Frame


class Cylinder(Record, eq=False):
    """Cylinders about their axes, normals outwards; mm."""

    frame: Frame
    radius: float


class Cone(Record, eq=False):
    """Cones that widen along their axes by ``slant`` rad, more than 0, from ``radius`` mm at the origin."""

    frame: Frame
    radius: float
    slant: float


class Torus(Record, eq=False):
    """Tori about their axes: radii to the middle of the tube and of the tube; mm."""

    frame: Frame
    radius: float
    tube: float


class Sphere(Record, eq=False):
    """Spheres; mm."""

    frame: Frame
    radius: float


class Extrusion(Record, eq=False):
    """What the curves of edges (n,) leave behind along a direction (1, 3); the normal is curve cross direction."""

    edges: Index
    direction: Real


class SplineSurface(Record, eq=False):
    """Tensor products on clamped knots, with points (n, u, v) of the solid as poles; the normal is u cross v."""

    degrees: tuple[int, int]
    u_knots: Real
    v_knots: Real
    poles: Index


Surface: TypeAlias = Plane | Cylinder | Cone | Torus | Sphere | Extrusion | SplineSurface
# edges (n, m) in order, the face on the left as seen from outside, and which of them (m,) run forwards
Loop: TypeAlias = tuple[Index, Flags]


# edges (n,) about faces, and whether they run forwards
Use: TypeAlias = tuple[Index, bool]


def loop_of(around: Sequence[Use]) -> Loop:
    """Edges in order as the loop of faces."""
    edges, ways = zip(*around, strict=True)
    return np.stack(edges, axis=1), np.array(ways)


def turned_over(around: Sequence[Use]) -> list[Use]:
    """The same edges the other way round."""
    return [(edge, not way) for edge, way in reversed(around)]


class Faces(Record, eq=False):
    """Faces of one kind, n of them, the outer loop first; ``along``: their surfaces' normals point outwards."""

    surface: Surface
    loops: tuple[Loop, ...]
    along: bool = True


class Solid(Record, eq=False):
    """One closed shell: points (n, 3) mm, the points (n,) that are vertices, edges and faces."""

    points: Real
    vertices: Index
    edges: tuple[Edges, ...]
    faces: tuple[Faces, ...]


class SolidBuilder:
    """Collects the points, edges and faces of a solid, and numbers them."""

    def __init__(self) -> None:
        self.points: list[Real] = []
        self.vertices: list[Index] = []
        self.edges: list[Edges] = []
        self.faces: list[Faces] = []
        # points on axes, by these and their heights
        self.axes: dict[tuple[complex, float], Index] = {}
        # how many points, vertices and edges there are
        self.counts = [0, 0, 0]

    def add_points(self, plane: Complex, z: Real | float) -> Index:
        """The numbers of new points by their places in the plane and their heights, mm; of the shape of ``plane``."""
        places = np.stack(np.broadcast_arrays(plane.real, plane.imag, z), axis=-1).reshape(-1, 3)
        self.points.append(places)
        return self._numbers(0, len(places)).reshape(plane.shape)

    def on_axis(self, z: float, axis: complex = 0j) -> Index:
        """The number of the point at a height, mm, on an upright axis, (1,), made once."""
        if (axis, z) not in self.axes:
            self.axes[axis, z] = self.add_points(np.array([axis]), z)
        return self.axes[axis, z]

    def place(self, vertices: Index) -> Real:
        """Where vertices stand, (n, 3) mm."""
        return np.concatenate(self.points)[self.points_of(vertices)]

    def points_of(self, vertices: Index) -> Index:
        """The numbers of the points that vertices are."""
        return np.concatenate(self.vertices)[vertices]

    def add_vertices(self, points: Index) -> Index:
        """The numbers of new vertices at points (n,)."""
        self.vertices.append(points)
        return self._numbers(1, len(points))

    def add_edges(self, start: Index, end: Index, curve: Straight | Circular | Spline) -> Index:
        """The numbers of new edges, (n,)."""
        self.edges.append(Edges(start, end, curve))
        return self._numbers(2, len(start))

    def bounded(self, surface: Surface, around: Sequence[Use], *, along: bool = True) -> None:
        """Faces within edges that turn left about them, as seen from outside."""
        self.faces.append(Faces(surface, (loop_of(around),), along))

    def solid(self) -> Solid:
        """What was collected."""
        points, vertices = np.concatenate(self.points), np.concatenate(self.vertices)
        return Solid(points, vertices, tuple(self.edges), tuple(self.faces))

    def _numbers(self, kind: int, count: int) -> Index:
        first = self.counts[kind]
        self.counts[kind] += count
        return np.arange(first, first + count)

"""Cylindrical cams for the kernel: walls as spline surfaces, true cylinders between their edges, plane ends.

Walls are one face for each stretch of the motion. Cylinders are cut upright where the roller stands still, for there
the edges of all walls stand above each other. Every edge is made once, with its curve in the parameters of each face.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from geometry.approximation.outline import spline_outline
from geometry.base.errors import GeometryError
from geometry.cams.barrel.body import BarrelBody, BoreWall, Cylinder, Plane, Ring, Track
from geometry.cams.barrel.splines import BarrelSplines, WallSpline
from geometry.cams.motion.follower_motion import TURN
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Real
from geometry.plane.profile import Label, Profile, circle
from parts.solids.brep_curves import closed_wire, knot_arrays
from parts.solids.brep_screw import CONFUSION, straight_path
from parts.solids.kernel import faces_of

# a cylinder's faces begin this far from the seam of its angle, rad
_FROM_SEAM = 0.1
# one face of a cylinder goes round by no more than this, rad, where the roller's rests allow it
_MOST_TURN = 3.5
_DEGREE = 7


def barrel_solid(body: BarrelBody, splines: BarrelSplines, tolerance: float = 1e-6) -> Any:
    """A TopoDS_Solid of a cylindrical cam; nothing is sewn, no boolean.

    Raises
    ------
    GeometryError
        The kernel refuses a face or the solid.
    """
    from OCP.BRep import BRep_Builder
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid
    from OCP.BRepLib import BRepLib
    from OCP.ShapeFix import ShapeFix_Shell
    from OCP.TopoDS import TopoDS_Shell

    made = _Maker(body, splines, tolerance)
    builder, shell = BRep_Builder(), TopoDS_Shell()
    builder.MakeShell(shell)
    for face in made.faces():
        builder.Add(shell, face)
    shell.Closed(True)
    fixer = ShapeFix_Shell()
    fixer.FixFaceOrientation(shell)
    solid = BRepBuilderAPI_MakeSolid(fixer.Shell())
    if not solid.IsDone():
        raise GeometryError("the kernel makes no solid of this cam")
    result = solid.Solid()
    BRepLib.OrientClosedSolid_s(result)
    return result


class _Maker:
    """Vertices, edges and faces of one cam."""

    def __init__(self, body: BarrelBody, splines: BarrelSplines, tolerance: float) -> None:
        self.body, self.cam, self.tolerance = body, body.cam, tolerance
        self.splines = splines.walls
        # edges of coarse splines leave their surfaces by more than what the kernel takes for one point
        self.confusion = max(CONFUSION, 2 * splines.max_error)
        self.count = len(next(iter(self.splines.values())))
        self.cuts = _cuts(next(iter(self.splines.values())))
        self.vertices: dict[object, Any] = {}
        self.edges: dict[object, Any] = {}
        self.wires: dict[object, Any] = {}

    def faces(self) -> list[Any]:
        """All faces, walls first: cylinders and ends take their edges."""
        faces = self.body.faces()
        found = [self._wall(w) for walls in self.splines.values() for w in walls]
        for face in faces:
            if isinstance(face, Cylinder):
                found += self._cylinder(face)
            elif isinstance(face, BoreWall):
                found += self._upright(face.profile, face.low, face.high, ("bore", face.low), ("bore", face.high))
        found += [self._plane(face) for face in faces if isinstance(face, Plane)]
        assert any(isinstance(face, Track) for face in faces)
        return found

    def _vertex(self, key: object, point: Real) -> Any:
        from OCP.BRep import BRep_Builder
        from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeVertex
        from OCP.gp import gp_Pnt

        if key not in self.vertices:
            self.vertices[key] = BRepBuilderAPI_MakeVertex(gp_Pnt(*(float(x) for x in point))).Vertex()
            BRep_Builder().UpdateVertex(self.vertices[key], self.confusion)
        return self.vertices[key]

    def _edge(self, key: object, curve: Any, start: Any, end: Any, domain: tuple[float, float]) -> Any:
        from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge

        if key not in self.edges:
            made = BRepBuilderAPI_MakeEdge(curve, start, end, *domain)
            if not made.IsDone():
                raise GeometryError(f"the kernel makes no edge of {key}: {made.Error()}")
            self.edges[key] = made.Edge()
        return self.edges[key]

    def _corner(self, side: int, row: int, k: int) -> tuple[Any, Real]:
        """The vertex of a wall at the start of stretch k on the inner (0) or outer (1) cylinder, and its point."""
        point = self.splines[side][k % self.count].poles[0, -row]
        return self._vertex((side, row, k % self.count), point), point

    def _rim(self, side: int, row: int, k: int) -> Any:
        """The edge of a wall along the inner (0) or outer (1) cylinder over stretch k, with growing cam angle."""
        spline = self.splines[side][k]
        start, end = self._corner(side, row, k)[0], self._corner(side, row, k + 1)[0]
        curve = _kernel_curve(spline.poles[:, -row], spline.along)
        return self._edge(("rim", side, row, k), curve, start, end, (spline.along[0], spline.along[-1]))

    def _wall(self, spline: WallSpline) -> Any:
        """The face of a wall over one stretch."""
        k = self.splines[spline.side].index(spline)
        sides = []
        for j in (k, k + 1):
            own = self.splines[spline.side][j % self.count]
            low, high = (self._corner(spline.side, row, j)[0] for row in (0, 1))
            curve = _kernel_curve(own.poles[0], own.across)
            sides.append(self._edge(("across", spline.side, j % self.count), curve, low, high, (0.0, 1.0)))
        around = [self._rim(spline.side, 0, k), sides[1], self._rim(spline.side, 1, k), sides[0]]
        a, b = float(spline.along[0]), float(spline.along[-1])
        paths = [((a, 0.0), (b, 0.0), (a, b)), ((b, 0.0), (b, 1.0), (0.0, 1.0)),
                 ((a, 1.0), (b, 1.0), (a, b)), ((a, 0.0), (a, 1.0), (0.0, 1.0))]  # fmt: skip
        loop = [(e, straight_path(*p), i < 2) for i, (e, p) in enumerate(zip(around, paths, strict=True))]
        return _face(_kernel_surface(spline), loop, self.confusion)

    def _cylinder(self, face: Cylinder) -> list[Any]:
        """The faces of a cylinder: whole between two circles, else one between each two cuts."""
        if not (face.lower.side or face.upper.side):
            low, high = ("circle", face.lower), ("circle", face.upper)
            profile = circle(face.lower.radius, Label.HUB)
            return self._upright(profile, face.lower.z, face.upper.z, low, high)
        row = 0 if face.lower.radius == self.cam.inner else 1
        found = []
        for i, (first, last) in enumerate(self.cuts):
            following = self.cuts[(i + 1) % len(self.cuts)][0]
            found.append(self._cylinder_part(face, row, first, last, following))
        return found

    def _cylinder_part(self, face: Cylinder, row: int, first: int, last: int, following: int) -> Any:
        """The part of a cylinder over the stretches from ``first`` to before ``last``; its polar angle goes down."""
        from OCP.Geom import Geom_CylindricalSurface
        from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt

        radius = face.lower.radius
        any_side = face.lower.side or face.upper.side
        right = self.splines[any_side][first].edges[row][0, 0]
        left = self.splines[any_side][last - 1].edges[row][-1, 0]
        base = left - _FROM_SEAM
        frame = gp_Ax3(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(math.cos(base), math.sin(base), 0))
        loop: list[tuple[Any, Any, bool]] = []
        for ring, is_lower in ((face.lower, True), (face.upper, False)):
            parts = self._ring(ring, row, first, last, base, (left, right))
            # the lower ring is run to the right, the upper one to the left; walls go left with the cam angle
            ahead = is_lower != bool(ring.side)
            loop += [(edge, path, ahead) for edge, path in (reversed(parts) if is_lower else parts)]
            at, k = (right, first) if is_lower else (left, following)
            loop.append((*self._seam(face, row, k, at, base), is_lower))
        return _face(Geom_CylindricalSurface(frame, radius), loop, self.confusion)

    def _ring(
        self, ring: Ring, row: int, first: int, last: int, base: float, turn: tuple[float, float]
    ) -> list[tuple[Any, Any]]:
        """Edges of a ring between two cuts with their paths on the cylinder; a circle's is one arc to the right."""
        if ring.side:
            return [
                (self._rim(ring.side, row, k), _path(self.splines[ring.side][k], row, base)) for k in range(first, last)
            ]
        from OCP.Geom import Geom_Circle
        from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

        left, right = turn
        axis = gp_Ax2(gp_Pnt(0, 0, ring.z), gp_Dir(0, 0, 1), gp_Dir(math.cos(left), math.sin(left), 0))
        start, end = self._on_circle(ring, last % self.count, left), self._on_circle(ring, first, right)
        arc = self._edge((ring, first), Geom_Circle(axis, ring.radius), start, end, (0.0, right - left))
        return [(arc, straight_path((left - base, ring.z), (right - base, ring.z), (0.0, right - left)))]

    def _on_circle(self, ring: Ring, k: int, polar: float) -> Any:
        """The vertex of a circle at the cut before stretch k."""
        point = np.array([ring.radius * math.cos(polar), ring.radius * math.sin(polar), ring.z])
        return self._vertex((ring, k), point)

    def _seam(self, face: Cylinder, row: int, k: int, polar: float, base: float) -> tuple[Any, Any]:
        """The upright edge of a cylinder at the cut before stretch k, upwards, with its path."""
        from OCP.Geom import Geom_Line
        from OCP.gp import gp_Dir, gp_Pnt

        ends, heights = [], []
        for ring in (face.lower, face.upper):
            if ring.side:
                vertex, point = self._corner(ring.side, row, k)
                heights.append(float(point[2]))
            else:
                vertex = self._on_circle(ring, k, polar)
                heights.append(ring.z)
            ends.append(vertex)
        radius, u = face.lower.radius, polar - base
        line = Geom_Line(gp_Pnt(radius * math.cos(polar), radius * math.sin(polar), heights[0]), gp_Dir(0, 0, 1))
        rise = heights[1] - heights[0]
        edge = self._edge(("seam", face, k), line, ends[0], ends[1], (0.0, rise))
        return edge, straight_path((u, heights[0]), (u, heights[1]), (0.0, rise))

    def _upright(self, profile: Profile, low: float, high: float, lower: object, upper: object) -> list[Any]:
        """Faces of an upright wall; its wires are kept for the ends."""
        from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
        from OCP.gp import gp_Vec
        from OCP.TopoDS import TopoDS

        outline = spline_outline(profile, self.tolerance, degree=_DEGREE, continuity=_DEGREE - 1)
        self.wires[lower] = closed_wire(list(outline.curves()), low)
        prism = BRepPrimAPI_MakePrism(self.wires[lower], gp_Vec(0, 0, high - low))
        if not prism.IsDone():
            raise GeometryError("the kernel makes no wall of this outline")
        self.wires[upper] = TopoDS.Wire_s(prism.LastShape())
        return list(faces_of(prism.Shape()))

    def _circle_wire(self, ring: Ring) -> Any:
        """The wire of a circle: of a hub, or of the arcs between the cuts of a cylinder with a wall."""
        if ("circle", ring) in self.wires:
            return self.wires["circle", ring]
        from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeWire

        wire = BRepBuilderAPI_MakeWire()
        for first, _ in reversed(self.cuts):
            wire.Add(self.edges[ring, first])
        return wire.Wire()

    def _plane(self, face: Plane) -> Any:
        """A plane end within its circle, without its hole."""
        from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
        from OCP.gp import gp_Dir, gp_Pln, gp_Pnt

        plane = gp_Pln(gp_Pnt(0, 0, face.outer.z), gp_Dir(0, 0, 1))
        made = BRepBuilderAPI_MakeFace(plane, self._circle_wire(face.outer), True)
        if face.inner is not None:
            made.Add(_as_wire(self._circle_wire(face.inner).Reversed()))
        if face.bore is not None:
            # the bore runs clockwise
            made.Add(_as_wire(self.wires["bore", face.outer.z]))
        if not made.IsDone():
            raise GeometryError("the kernel makes no end face of this cam")
        return made.Face() if face.up else made.Face().Reversed()


def _cuts(splines: tuple[WallSpline, ...]) -> list[tuple[int, int]]:
    """Runs of stretches (first, beyond the last) between cuts of the cylinders, all at rests of the roller."""
    starts = [s.stretch.start + TURN * s.stretch.turns for s in splines]
    ends = [*starts[1:], starts[0] + TURN]
    joints = [k for k, s in enumerate(splines) if s.stretch.rests]
    kept = [0]
    for k, following in zip(joints[1:], [*joints[2:], len(splines)], strict=True):
        if ends[following - 1] - starts[kept[-1]] > _MOST_TURN:
            kept.append(k)
    return list(zip(kept, [*kept[1:], len(splines)], strict=True))


def _path(spline: WallSpline, row: int, base: float) -> Any:
    """The path of a wall's edge in a cylinder's parameters."""
    from OCP.Geom2d import Geom2d_BSplineCurve
    from OCP.gp import gp_Pnt2d
    from OCP.TColgp import TColgp_Array1OfPnt2d

    poles = TColgp_Array1OfPnt2d(1, len(spline.edges[row]))
    for i, (polar, height) in enumerate(spline.edges[row].tolist()):
        poles.SetValue(i + 1, gp_Pnt2d(polar - base, height))
    return Geom2d_BSplineCurve(poles, *_knot_arrays(spline.along), _DEGREE)


def _knot_arrays(knots: Real) -> tuple[Any, Any]:
    return knot_arrays(BSpline(_DEGREE, knots, np.zeros(len(knots) - _DEGREE - 1, dtype=complex)))


def _kernel_curve(poles: Real, knots: Real) -> Any:
    from OCP.Geom import Geom_BSplineCurve
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array1OfPnt

    array = TColgp_Array1OfPnt(1, len(poles))
    for i, pole in enumerate(poles.tolist()):
        array.SetValue(i + 1, gp_Pnt(*pole))
    return Geom_BSplineCurve(array, *_knot_arrays(knots), _DEGREE)


def _kernel_surface(spline: WallSpline) -> Any:
    from OCP.Geom import Geom_BSplineSurface
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array2OfPnt

    poles = TColgp_Array2OfPnt(1, spline.poles.shape[0], 1, spline.poles.shape[1])
    for i, row in enumerate(spline.poles.tolist()):
        for j, pole in enumerate(row):
            poles.SetValue(i + 1, j + 1, gp_Pnt(*pole))
    (u, u_counts), (v, v_counts) = _knot_arrays(spline.along), _knot_arrays(spline.across)
    return Geom_BSplineSurface(poles, u, v, u_counts, v_counts, _DEGREE, _DEGREE)


def _face(surface: Any, loop: list[tuple[Any, Any, bool]], confusion: float) -> Any:
    """A face within a loop of edges, each with its path in the parameters and whether it is run forwards."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Face, TopoDS_Wire

    builder, face, wire = BRep_Builder(), TopoDS_Face(), TopoDS_Wire()
    builder.MakeFace(face, surface, CONFUSION)
    builder.MakeWire(wire)
    for edge, path, forwards in loop:
        builder.UpdateEdge(edge, path, face, confusion)
        builder.Add(wire, edge if forwards else edge.Reversed())
    wire.Closed(True)
    builder.Add(face, wire)
    return face


def _as_wire(shape: object) -> Any:
    from OCP.TopoDS import TopoDS

    return TopoDS.Wire_s(shape)

"""The solid of somebody else's STEP file as our faces, by the CAD kernel: exact, or refused by what it has beyond them.

Planes, cylinders, cones, spheres and tori between lines and circles are taken over one by one; how far the file's edges
lie off its faces is measured, and the volume is held against the kernel's own.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement3
from geometry.curves.curve import Real
from geometry.solids.charts import along_edges, charts, edge_rows
from geometry.solids.face_moments import face_moments
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import (
    Circular,
    Cone,
    Cylinder,
    Faces,
    Frame,
    Index,
    Loop,
    Plane,
    Solid,
    SolidBuilder,
    Sphere,
    Straight,
    Torus,
)  # fmt: skip
from parts.solids.kernel import solids_of

if TYPE_CHECKING:
    from OCP.gp import gp_Ax2, gp_Ax3, gp_Dir, gp_Pnt
    from OCP.TopoDS import TopoDS_Edge, TopoDS_Face, TopoDS_Shape, TopoDS_Wire

# by which edges may lie off their faces, mm, as a STEP file of ours may; part of the volume, of the size
_LOOSE, _VOLUME, _EXACT = 1e-6, 1e-7, 1e-13
_SHARES = np.linspace(0.0, 1.0, 9)


def foreign_body(text: str, part_from_file: Placement3) -> FacedBody:
    """The one solid of a STEP file's text, laid by ``part_from_file`` (mm); units are converted by the kernel.

    Raises
    ------
    ParameterError
        ``file``: the kernel is not installed, it finds no solid or several, or one that lines, circles and surfaces of
        revolution do not bound.
    """
    try:
        solids = solids_of(text)
    except ImportError:
        raise ParameterError("file", None, "needs_kernel") from None
    if len(solids) != 1:
        raise ParameterError("file", None, "step_solids", count=len(solids))
    made = _Taken(_laid(solids[0], part_from_file))
    solid = made.taken()
    error = _off_faces(solid)
    if not error <= _LOOSE:
        raise ParameterError("file", None, "step_loose", error=error, most=_LOOSE)
    found, volume = face_moments(solid).volume, _kernel_volume(made.shape)
    if not (volume > 0 and abs(found / volume - 1) <= _VOLUME):
        raise ParameterError("file", None, "step_volume", found=found, volume=volume)
    is_exact = error <= _EXACT * float(np.abs(solid.points).max())
    whole = FacedSolid(solid, 0.0 if is_exact else error, "exact" if is_exact else "sampled")
    return FacedBody(lambda _: whole)


def _laid(shape: TopoDS_Shape, placement: Placement3) -> TopoDS_Shape:
    from OCP.gp import gp_Trsf
    from OCP.TopLoc import TopLoc_Location

    motion = gp_Trsf()
    motion.SetValues(*placement.matrix().ravel().tolist())
    return shape.Moved(TopLoc_Location(motion))


def _kernel_volume(shape: TopoDS_Shape) -> float:
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps

    properties = GProp_GProps()
    BRepGProp.VolumePropertiesGK_s(shape, properties, _VOLUME / 10)
    return float(properties.Mass())


def _off_faces(solid: Solid) -> float:
    """How far edges lie off their faces at most, mm, by samples."""
    points = [along_edges(solid, edges, _SHARES)[0][0] for edges in solid.edges]
    bundle, _ = edge_rows(solid)
    return max(
        float(chart.distance(points[bundle[edge]]).max())
        for faces in solid.faces
        for chart in charts(solid, faces.surface, 1)
        for edges, _ in faces.loops
        for edge in edges[0].tolist()
    )


def _refused(code: str, what: object = None) -> NoReturn:
    raise ParameterError("file", None, code, what=str(what).rpartition("_")[2])


class _Taken(SolidBuilder):
    """Takes over the vertices, edges and faces of a kernel's solid, each once."""

    def __init__(self, shape: TopoDS_Shape) -> None:
        super().__init__()
        self.shape = shape

    def taken(self) -> Solid:
        """All of it."""
        from OCP.BRep import BRep_Tool
        from OCP.TopAbs import TopAbs_ShapeEnum
        from OCP.TopExp import TopExp
        from OCP.TopoDS import TopoDS
        from OCP.TopTools import TopTools_IndexedMapOfShape

        def mapped(kind: TopAbs_ShapeEnum) -> TopTools_IndexedMapOfShape:
            found = TopTools_IndexedMapOfShape()
            TopExp.MapShapes_s(self.shape, kind, found)
            return found

        if mapped(TopAbs_ShapeEnum.TopAbs_SHELL).Extent() != 1:
            _refused("step_hollow")
        corners, edges = mapped(TopAbs_ShapeEnum.TopAbs_VERTEX), mapped(TopAbs_ShapeEnum.TopAbs_EDGE)
        for number in range(1, corners.Extent() + 1):
            self.add_vertices(self.point(BRep_Tool.Pnt_s(TopoDS.Vertex_s(corners.FindKey(number)))))
        # numbers of our edges by those of the kernel's map; a pole is no edge
        numbers: dict[int, int] = {}
        for number in range(1, edges.Extent() + 1):
            edge = TopoDS.Edge_s(edges.FindKey(number))
            if not BRep_Tool.Degenerated_s(edge):
                first, last = (corners.FindIndex(v) - 1 for v in _ends(edge))
                made = self.edge(edge, np.array([first]), np.array([last]))
                numbers[number] = int(made[0])
        for number in range(1, (faces := mapped(TopAbs_ShapeEnum.TopAbs_FACE)).Extent() + 1):
            self.face(TopoDS.Face_s(faces.FindKey(number)), lambda edge: numbers.get(edges.FindIndex(edge)))
        return self.solid()

    def point(self, at: gp_Pnt) -> Index:
        """A point of the kernel's."""
        return self.add_points(np.array([complex(at.X(), at.Y())]), at.Z())

    def frame(self, axes: gp_Ax2 | gp_Ax3, way: float = 1.0, along: float = 0.0) -> Frame:
        """A frame of the kernel's, its axis turned over where ``way`` is -1, moved so far along it."""
        axis = way * _direction(axes.Direction())
        origin = self.point(axes.Location())
        if along:
            x, y, z = self.points[-1][0] + along * axis[0]
            origin = self.add_points(np.array([complex(x, y)]), z)
        return Frame(origin, axis, _direction(axes.XDirection()))

    def edge(self, edge: TopoDS_Edge, first: Index, last: Index) -> Index:
        """A line or an arc between two vertices."""
        from OCP.BRepAdaptor import BRepAdaptor_Curve
        from OCP.GeomAbs import GeomAbs_CurveType
        from OCP.TopAbs import TopAbs_Orientation
        from OCP.TopoDS import TopoDS

        curve = BRepAdaptor_Curve(TopoDS.Edge_s(edge.Oriented(TopAbs_Orientation.TopAbs_FORWARD)))
        if curve.GetType() == GeomAbs_CurveType.GeomAbs_Line:
            return self.add_edges(first, last, Straight(_direction(curve.Line().Direction())))
        if curve.GetType() != GeomAbs_CurveType.GeomAbs_Circle:
            _refused("step_curve", curve.GetType().name)
        circle = curve.Circle()
        return self.add_edges(first, last, Circular(self.frame(circle.Position()), circle.Radius()))

    def face(self, face: TopoDS_Face, number: Callable[[TopoDS_Edge], int | None]) -> None:
        """A face with its loops, the outer one first."""
        from OCP.BRepTools import BRepTools
        from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
        from OCP.TopExp import TopExp_Explorer
        from OCP.TopoDS import TopoDS

        plain = TopoDS.Face_s(face.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
        turned = face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        surface, direct = self.surface(plain)
        outer = BRepTools.OuterWire_s(plain)
        loops: list[Loop] = []
        explorer = TopExp_Explorer(plain, TopAbs_ShapeEnum.TopAbs_WIRE)
        while explorer.More():
            wire = TopoDS.Wire_s(explorer.Current())
            run = [(number(edge), ahead) for edge, ahead in _run(wire, plain)]
            kept = [(at, ahead != turned) for at, ahead in (run[::-1] if turned else run) if at is not None]
            if kept:
                loop: Loop = np.array([[at for at, _ in kept]]), np.array([ahead for _, ahead in kept])
                loops.insert(0 if wire.IsSame(outer) else len(loops), loop)
            explorer.Next()
        self.faces.append(Faces(surface, tuple(loops), direct != turned))

    def surface(self, face: TopoDS_Face) -> tuple[Plane | Cylinder | Cone | Torus | Sphere, bool]:
        """The surface of a face, and whether the kernel's normal looks where ours does."""
        from OCP.BRepAdaptor import BRepAdaptor_Surface
        from OCP.GeomAbs import GeomAbs_SurfaceType as Kind

        told = BRepAdaptor_Surface(face, False)
        kind = told.GetType()
        if kind == Kind.GeomAbs_Plane:
            axes = told.Plane().Position()
            return Plane(self.frame(axes)), axes.Direct()
        if kind == Kind.GeomAbs_Cylinder:
            axes = told.Cylinder().Position()
            return Cylinder(self.frame(axes), told.Cylinder().Radius()), axes.Direct()
        if kind == Kind.GeomAbs_Sphere:
            axes = told.Sphere().Position()
            return Sphere(self.frame(axes), told.Sphere().Radius()), axes.Direct()
        if kind == Kind.GeomAbs_Torus:
            axes, torus = told.Torus().Position(), told.Torus()
            if torus.MinorRadius() >= torus.MajorRadius():
                _refused("step_surface", "GeomAbs_Torus")
            return Torus(self.frame(axes), torus.MajorRadius(), torus.MinorRadius()), axes.Direct()
        if kind != Kind.GeomAbs_Cone:
            _refused("step_surface", kind.name)
        axes, cone = told.Cone().Position(), told.Cone()
        slant, radius = abs(cone.SemiAngle()), cone.RefRadius()
        # an apex is no place for a surface to begin
        aside = max(1.0 - radius, 0.0)
        return Cone(
            self.frame(axes, np.sign(cone.SemiAngle()), aside / np.tan(slant)), radius + aside, slant
        ), axes.Direct()


def _run(wire: TopoDS_Wire, face: TopoDS_Face) -> Iterator[tuple[TopoDS_Edge, bool]]:
    """The edges of a wire in order, and whether each runs forwards."""
    from OCP.BRepTools import BRepTools_WireExplorer
    from OCP.TopAbs import TopAbs_Orientation

    explorer = BRepTools_WireExplorer(wire, face)
    count = 0
    while explorer.More():
        count += 1
        yield explorer.Current(), explorer.Current().Orientation() == TopAbs_Orientation.TopAbs_FORWARD
        explorer.Next()
    if count != wire.NbChildren():
        _refused("step_wire")


def _ends(edge: TopoDS_Edge) -> tuple[TopoDS_Shape, TopoDS_Shape]:
    """The vertices at the start and the end of an edge's curve."""
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS

    plain = TopoDS.Edge_s(edge.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    return TopExp.FirstVertex_s(plain, False), TopExp.LastVertex_s(plain, False)


def _direction(way: gp_Dir) -> Real:
    return np.array([[way.X(), way.Y(), way.Z()]])

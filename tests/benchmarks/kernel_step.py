"""OCC's STEP file of a body that comes as curves and surfaces: made by its builders, healed, named, coloured, measured.

Run as a process of its own by bench_step: ``python -m tests.benchmarks.kernel_step SOLID FILE TURNS`` reads a pickled
``Solid`` with its name and colour, and prints the medians of what it took, and its peak memory.
"""

from __future__ import annotations

import json
import pickle
import sys
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeVertex
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepGProp import BRepGProp
from OCP.Geom import (
    Geom_BSplineCurve,
    Geom_BSplineSurface,
    Geom_Circle,
    Geom_ConicalSurface,
    Geom_CylindricalSurface,
    Geom_Plane,
    Geom_SphericalSurface,
    Geom_SurfaceOfLinearExtrusion,
    Geom_ToroidalSurface,
)
from OCP.gp import gp_Ax2, gp_Ax3, gp_Dir, gp_Pnt
from OCP.GProp import GProp_GProps
from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
from OCP.ShapeFix import ShapeFix_Shape
from OCP.STEPCAFControl import STEPCAFControl_Reader, STEPCAFControl_Writer
from OCP.TColgp import TColgp_Array1OfPnt, TColgp_Array2OfPnt
from OCP.TCollection import TCollection_ExtendedString
from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_LabelSequence
from OCP.TDocStd import TDocStd_Document
from OCP.TopAbs import TopAbs_ShapeEnum
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS_Face, TopoDS_Shape, TopoDS_Shell, TopoDS_Solid, TopoDS_Wire
from OCP.XCAFDoc import XCAFDoc_Area, XCAFDoc_ColorType, XCAFDoc_DocumentTool, XCAFDoc_Volume

from geometry.base.distinct import distinct
from geometry.curves.curve import Real
from geometry.solids.faces import (
    Circular,
    Cone,
    Cylinder,
    Extrusion,
    Faces,
    Frame,
    Plane,
    Solid,
    Sphere,
    SplineSurface,
    Straight,
    Torus,
)  # fmt: skip
from parts.solids.kernel import silent_kernel
from tests.benchmarks.bench_step import seconds

_TOLERANCE = 1e-7


class _Maker:
    """The vertices, edges and faces of a solid as the kernel's."""

    def __init__(self, solid: Solid) -> None:
        self.solid, self.builder = solid, BRep_Builder()
        self.points = [gp_Pnt(*place) for place in solid.points.tolist()]
        self.vertices = [BRepBuilderAPI_MakeVertex(self.points[k]).Vertex() for k in solid.vertices.tolist()]
        self.curves: list[Any] = []
        self.edges: list[Any] = []
        for bundle in solid.edges:
            ends = list(zip(bundle.start.tolist(), bundle.end.tolist(), strict=True))
            for (start, end), curve in zip(ends, self._curves(bundle.curve, len(ends)), strict=True):
                a, b = self.vertices[start], self.vertices[end]
                if curve is None:
                    made = BRepBuilderAPI_MakeEdge(a, b)
                elif isinstance(curve, Geom_BSplineCurve):
                    made = BRepBuilderAPI_MakeEdge(curve, a, b, curve.FirstParameter(), curve.LastParameter())
                else:
                    made = BRepBuilderAPI_MakeEdge(curve, a, b)
                self.curves.append(curve)
                self.edges.append(made.Edge())

    def _frames(self, frame: Frame, size: int) -> Iterator[gp_Ax2]:
        for k in range(size):
            origin = self.points[frame.origin[k % len(frame.origin)]]
            axis, zero = (gp_Dir(*ways[k % len(ways)].tolist()) for ways in (frame.axis, frame.zero))
            yield gp_Ax2(origin, axis, zero)

    def _curves(self, curve: Any, size: int) -> list[Any]:
        if isinstance(curve, Straight):
            return [None] * size
        if isinstance(curve, Circular):
            return [Geom_Circle(place, curve.radius) for place in self._frames(curve.frame, size)]
        knots, times = _knots(curve.knots)
        found = []
        for row in curve.poles.tolist():
            poles = TColgp_Array1OfPnt(1, len(row))
            for k, pole in enumerate(row, 1):
                poles.SetValue(k, self.points[pole])
            found.append(Geom_BSplineCurve(poles, knots, times, curve.degree))
        return found

    def _surfaces(self, surface: Any, size: int) -> list[Any]:
        if isinstance(surface, Extrusion):
            way = gp_Dir(*surface.direction[0].tolist())
            return [Geom_SurfaceOfLinearExtrusion(self.curves[k], way) for k in surface.edges.tolist()]
        if isinstance(surface, SplineSurface):
            (u, u_times), (v, v_times), found = _knots(surface.u_knots), _knots(surface.v_knots), []
            for net in surface.poles.tolist():
                poles = TColgp_Array2OfPnt(1, len(net), 1, len(net[0]))
                for i, row in enumerate(net, 1):
                    for j, pole in enumerate(row, 1):
                        poles.SetValue(i, j, self.points[pole])
                found.append(Geom_BSplineSurface(poles, u, v, u_times, v_times, *surface.degrees))
            return found
        made: dict[type, Callable[[gp_Ax3], Any]] = {
            Plane: Geom_Plane,
            Cylinder: lambda place: Geom_CylindricalSurface(place, surface.radius),
            Cone: lambda place: Geom_ConicalSurface(place, surface.slant, surface.radius),
            Torus: lambda place: Geom_ToroidalSurface(place, surface.radius, surface.tube),
            Sphere: lambda place: Geom_SphericalSurface(place, surface.radius),
        }
        return [made[type(surface)](gp_Ax3(place)) for place in self._frames(surface.frame, size)]

    def _faces(self, faces: Faces) -> Iterator[TopoDS_Face]:
        size = len(faces.loops[0][0])
        for k, surface in enumerate(self._surfaces(faces.surface, size)):
            face = TopoDS_Face()
            self.builder.MakeFace(face, surface, _TOLERANCE)
            for edges, senses in faces.loops:
                wire = TopoDS_Wire()
                self.builder.MakeWire(wire)
                for edge, forwards in zip(edges[k].tolist(), np.broadcast_to(senses, edges[k].shape), strict=True):
                    self.builder.Add(wire, self.edges[edge] if forwards else self.edges[edge].Reversed())
                wire.Closed(True)
                self.builder.Add(face, wire if faces.along else wire.Reversed())
            yield face if faces.along else face.Reversed()

    def whole(self) -> TopoDS_Shape:
        """The solid, its faces healed as those of a file that was read are."""
        shell, solid = TopoDS_Shell(), TopoDS_Solid()
        self.builder.MakeShell(shell)
        for faces in self.solid.faces:
            for face in self._faces(faces):
                self.builder.Add(shell, face)
        shell.Closed(True)
        self.builder.MakeSolid(solid)
        self.builder.Add(solid, shell)
        fix = ShapeFix_Shape(solid)
        fix.Perform()
        return fix.Shape()


def _knots(knots: Real) -> tuple[TColStd_Array1OfReal, TColStd_Array1OfInteger]:
    own = distinct(knots).tolist()
    told, times = TColStd_Array1OfReal(1, len(own)), TColStd_Array1OfInteger(1, len(own))
    for k, knot in enumerate(own, 1):
        told.SetValue(k, knot)
        times.SetValue(k, int((knots == knot).sum()))
    return told, times


def measured(shape: TopoDS_Shape) -> tuple[float, float]:
    """Volume and area."""
    volume, area = GProp_GProps(), GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, volume)
    BRepGProp.SurfaceProperties_s(shape, area)
    return volume.Mass(), area.Mass()


def write(shape: TopoDS_Shape, name: str, colour: str, file: str) -> None:
    """A file with what ours says: name, colour, volume and area."""
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    label = shapes.AddShape(shape)
    TDataStd_Name.Set_s(label, TCollection_ExtendedString(name))
    shades = [int(colour[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    shade = Quantity_Color(*shades, Quantity_TypeOfColor.Quantity_TOC_RGB)
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    colours.SetColor(label, shade, XCAFDoc_ColorType.XCAFDoc_ColorSurf)
    volume, area = measured(shape)
    XCAFDoc_Volume.Set_s(label, volume)
    XCAFDoc_Area.Set_s(label, area)
    writer = STEPCAFControl_Writer()
    for mode in (writer.SetNameMode, writer.SetColorMode, writer.SetPropsMode):
        mode(True)
    writer.Transfer(document)
    writer.Write(file)


def read(file: str) -> tuple[bool, float, float]:
    """Whether a file is one valid solid, and its volume and area; names, colours and properties are read too."""
    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    reader = STEPCAFControl_Reader()
    for mode in (reader.SetNameMode, reader.SetColorMode, reader.SetPropsMode):
        mode(True)
    reader.ReadFile(file)
    reader.Transfer(document)
    labels, shapes = TDF_LabelSequence(), XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    shapes.GetFreeShapes(labels)
    shape = shapes.GetShape_s(labels.Value(1))
    solids = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_SOLID)
    return solids.More() and BRepCheck_Analyzer(shape).IsValid(), *measured(shape)


def main() -> None:
    """Print the medians, s: made, written, read; whether it is valid, volume and area; peak memory, MB."""
    import resource

    stored, file, turns = sys.argv[1:]
    with open(stored, "rb") as stream:
        solid, name, colour = pickle.load(stream)
    shape = _Maker(solid).whole()
    with silent_kernel():
        works = (lambda: _Maker(solid).whole(), lambda: write(shape, name, colour, file), lambda: read(file))
        spent = [seconds(work, int(turns)) for work in works]
        found = read(file)
    print("\n" + json.dumps([spent, found, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024]))


if __name__ == "__main__":
    main()

"""B-rep solids of extruded sections for the kernel: finished curves in, no interpolation inside the kernel.

Arcs become true circles (so tip, root and bore are cylinders), splines keep our poles and knots. Only the
modules of OCP that are needed are imported, and only here and in exporters/step.py.
"""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from typing import Any

import numpy as np

from geometry.bspline import BSpline
from geometry.errors import GeometryError
from geometry.line_arc import Arc, Line
from geometry.outline import CadCurve


def extruded_solid(outer: Sequence[CadCurve], holes: Sequence[Sequence[CadCurve]], thickness: float) -> Any:
    """A TopoDS_Solid from closed chains of finished curves, z = 0 to ``thickness`` mm.

    Raises
    ------
    GeometryError
        The kernel refuses the section.
    """
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Dir, gp_Pln, gp_Pnt, gp_Vec
    from OCP.TopoDS import TopoDS

    plane = gp_Pln(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1))
    face = BRepBuilderAPI_MakeFace(plane, _wire(outer), True)
    for hole in holes:
        face.Add(_wire(hole))
    if not face.IsDone():
        raise GeometryError("the kernel makes no face of this section")
    prism = BRepPrimAPI_MakePrism(face.Face(), gp_Vec(0, 0, thickness))
    if not prism.IsDone():
        raise GeometryError("the kernel makes no solid of this section")
    return TopoDS.Solid_s(prism.Shape())


def _wire(curves: Sequence[CadCurve]) -> Any:
    """A closed wire whose neighbours share their vertices."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeVertex, BRepBuilderAPI_MakeWire
    from OCP.gp import gp_Pnt

    starts = [complex(c.point(c.domain[0])) for c in curves]
    vertices = [BRepBuilderAPI_MakeVertex(gp_Pnt(p.real, p.imag, 0.0)).Vertex() for p in starts]
    wire = BRepBuilderAPI_MakeWire()
    for index, curve in enumerate(curves):
        after = vertices[(index + 1) % len(curves)]
        handle, low, high = _kernel_curve(curve)
        edge = BRepBuilderAPI_MakeEdge(handle, vertices[index], after, low, high)
        if not edge.IsDone():
            raise GeometryError(f"the kernel makes no edge of curve {index}: {edge.Error()}")
        wire.Add(edge.Edge())
    return wire.Wire()


def _kernel_curve(curve: CadCurve) -> tuple[Any, float, float]:
    """The kernel's curve and its parameter interval."""
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    if isinstance(curve, Arc):
        from OCP.Geom import Geom_Circle

        direction = cmath.exp(1j * curve.start_angle)
        sense = 1 if curve.sweep > 0 else -1
        axis = gp_Ax2(
            gp_Pnt(curve.centre.real, curve.centre.imag, 0),
            gp_Dir(0, 0, sense),
            gp_Dir(direction.real, direction.imag, 0),
        )
        return Geom_Circle(axis, curve.radius), 0.0, abs(curve.sweep)
    if isinstance(curve, Line):
        from OCP.Geom import Geom_Line

        way = curve.end - curve.start
        start = gp_Pnt(curve.start.real, curve.start.imag, 0)
        return Geom_Line(start, gp_Dir(way.real, way.imag, 0)), 0.0, abs(way)
    return _kernel_spline(curve)


def _kernel_spline(curve: BSpline) -> tuple[Any, float, float]:
    from OCP.Geom import Geom_BSplineCurve
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array1OfPnt
    from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

    knots, counts = np.unique(curve.knots, return_counts=True)
    poles = TColgp_Array1OfPnt(1, len(curve.poles))
    for i, pole in enumerate(curve.poles.tolist()):
        poles.SetValue(i + 1, gp_Pnt(pole.real, pole.imag, 0.0))
    reals, integers = TColStd_Array1OfReal(1, len(knots)), TColStd_Array1OfInteger(1, len(knots))
    for i, (knot, count) in enumerate(zip(knots.tolist(), counts.tolist(), strict=True)):
        reals.SetValue(i + 1, knot)
        integers.SetValue(i + 1, count)
    return Geom_BSplineCurve(poles, reals, integers, curve.degree), float(knots[0]), float(knots[-1])

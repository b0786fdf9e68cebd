"""Finished curves for the kernel: edges that share their vertices, circles, lines, splines."""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from typing import Any

import numpy as np

from geometry.approximation.outline import CadCurve
from geometry.base.errors import GeometryError
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Real
from geometry.curves.line_arc import Arc, Line


def closed_wire(curves: Sequence[CadCurve], z: float) -> Any:
    """A closed wire at height ``z`` mm whose neighbours share their vertices."""
    edges, _ = closed_edges(curves, z)
    return wire_of(edges)


def wire_of(edges: Sequence[Any]) -> Any:
    """The wire of edges in order."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeWire

    wire = BRepBuilderAPI_MakeWire()
    for edge in edges:
        wire.Add(edge)
    return wire.Wire()


def closed_edges(curves: Sequence[CadCurve], z: float) -> tuple[list[Any], list[Any]]:
    """Edges of a closed chain at height ``z`` mm, and the vertices that they start from and share."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeVertex
    from OCP.gp import gp_Pnt

    starts = [complex(c.point(c.domain[0])) for c in curves]
    vertices = [BRepBuilderAPI_MakeVertex(gp_Pnt(p.real, p.imag, z)).Vertex() for p in starts]
    edges = []
    for index, curve in enumerate(curves):
        after = vertices[(index + 1) % len(curves)]
        handle, low, high = kernel_curve(curve, z)
        edge = BRepBuilderAPI_MakeEdge(handle, vertices[index], after, low, high)
        if not edge.IsDone():
            raise GeometryError(f"the kernel makes no edge of curve {index}: {edge.Error()}")
        edges.append(edge.Edge())
    return edges, vertices


def kernel_curve(curve: CadCurve, z: float) -> tuple[Any, float, float]:
    """The kernel's curve and its parameter interval."""
    from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt

    if isinstance(curve, Arc):
        from OCP.Geom import Geom_Circle

        direction = cmath.exp(1j * curve.start_angle)
        sense = 1 if curve.sweep > 0 else -1
        axis = gp_Ax2(
            gp_Pnt(curve.centre.real, curve.centre.imag, z),
            gp_Dir(0, 0, sense),
            gp_Dir(direction.real, direction.imag, 0),
        )
        return Geom_Circle(axis, curve.radius), 0.0, abs(curve.sweep)
    if isinstance(curve, Line):
        from OCP.Geom import Geom_Line

        way = curve.end - curve.start
        start = gp_Pnt(curve.start.real, curve.start.imag, z)
        return Geom_Line(start, gp_Dir(way.real, way.imag, 0)), 0.0, abs(way)
    low, high = curve.domain
    return kernel_spline(curve, np.full(len(curve.poles), z)), low, high


def kernel_spline(curve: BSpline, heights: Real) -> Any:
    """The kernel's curve over a plane spline's poles at ``heights`` mm."""
    from OCP.Geom import Geom_BSplineCurve
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array1OfPnt

    poles = TColgp_Array1OfPnt(1, len(curve.poles))
    for i, (pole, z) in enumerate(zip(curve.poles.tolist(), heights.tolist(), strict=True)):
        poles.SetValue(i + 1, gp_Pnt(pole.real, pole.imag, z))
    return Geom_BSplineCurve(poles, *knot_arrays(curve), curve.degree)


def knot_arrays(curve: BSpline) -> tuple[Any, Any]:
    """The different knots and their multiplicities."""
    from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

    knots, counts = np.unique(curve.knots, return_counts=True)
    reals, integers = TColStd_Array1OfReal(1, len(knots)), TColStd_Array1OfInteger(1, len(knots))
    for i, (knot, count) in enumerate(zip(knots.tolist(), counts.tolist(), strict=True)):
        reals.SetValue(i + 1, knot)
        integers.SetValue(i + 1, count)
    return reals, integers

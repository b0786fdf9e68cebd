"""The only builder of solids, B-rep half: exact bodies for the kernel, finished curves in, nothing interpolated there.

Arcs become true circles (so tip, root and bore are cylinders), splines keep our poles and knots. Only the
modules of OCP that are needed are imported, and only here and in exporters/step.py.
"""

from __future__ import annotations

import cmath
from collections.abc import Sequence
from typing import Any

import numpy as np

from geometry.body import Body, Cap, Wall
from geometry.bspline import BSpline
from geometry.errors import GeometryError
from geometry.line_arc import Arc, Line
from geometry.measure import profile_area
from geometry.outline import CadCurve, Outline, spline_outline

_DEGREE = 7


def body_outlines(body: Body, tolerance: float) -> tuple[Outline, ...]:
    """Every profile of a body as finished curves within ``tolerance`` mm.

    Degree 7: the kernel's files pay by the pole.
    """
    return tuple(spline_outline(p, tolerance, degree=_DEGREE, continuity=_DEGREE - 1) for p in body.profiles)


def body_solid(body: Body, outlines: Sequence[Outline]) -> Any:
    """A TopoDS_Solid from the finished curves of a body's profiles.

    Walls that meet in a loop share its edges, so the shell is closed by construction: nothing is sewn, no boolean.

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

    wires: dict[int, Any] = {}
    builder, shell = BRep_Builder(), TopoDS_Shell()
    builder.MakeShell(shell)
    # upright walls first: chamfers take their edges
    for wall in sorted(body.walls, key=lambda w: not body.is_upright(w)):
        make = _upright_faces if body.is_upright(wall) else _ruled_faces
        for face in make(body, wall, outlines, wires):
            builder.Add(shell, face)
    for cap in body.caps:
        builder.Add(shell, _cap_face(body, cap, wires))
    shell.Closed(True)
    fixer = ShapeFix_Shell()
    fixer.FixFaceOrientation(shell)
    solid = BRepBuilderAPI_MakeSolid(fixer.Shell())
    if not solid.IsDone():
        raise GeometryError("the kernel makes no solid of this body")
    result = solid.Solid()
    BRepLib.OrientClosedSolid_s(result)
    return result


def _upright_faces(body: Body, wall: Wall, outlines: Sequence[Outline], wires: dict[int, Any]) -> list[Any]:
    """Faces of a wall swept upwards; its two wires are kept for caps and chamfers."""
    from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
    from OCP.gp import gp_Vec
    from OCP.TopoDS import TopoDS

    low, high = body.height(wall)
    if wall.lower not in wires:
        wires[wall.lower] = _wire(list(outlines[body.loops[wall.lower].profile].curves()), low)
    prism = BRepPrimAPI_MakePrism(wires[wall.lower], gp_Vec(0, 0, high - low))
    if not prism.IsDone():
        raise GeometryError("the kernel makes no wall of this outline")
    wires[wall.upper] = TopoDS.Wire_s(prism.LastShape())
    return _faces(prism.Shape())


def _ruled_faces(body: Body, wall: Wall, outlines: Sequence[Outline], wires: dict[int, Any]) -> list[Any]:
    """Faces of a chamfer, ruled between matching edges of its two wires."""
    from OCP.BRepFill import BRepFill_Generator

    generator = BRepFill_Generator()
    for loop in (wall.lower, wall.upper):
        if loop not in wires:
            place = body.loops[loop]
            wires[loop] = _wire(list(outlines[place.profile].curves()), place.z)
        generator.AddWire(wires[loop])
    generator.Perform()
    return _faces(generator.Shell())


def _faces(shape: Any) -> list[Any]:
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    found, explorer = [], TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def _cap_face(body: Body, cap: Cap, wires: dict[int, Any]) -> Any:
    """A plane face within the wires of its loops."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.gp import gp_Dir, gp_Pln, gp_Pnt

    plane = gp_Pln(gp_Pnt(0, 0, body.loops[cap.outer].z), gp_Dir(0, 0, 1))
    counter_clockwise = profile_area(body.loop_profile(cap.outer)) > 0
    outer = wires[cap.outer] if counter_clockwise else wires[cap.outer].Reversed()
    face = BRepBuilderAPI_MakeFace(plane, _as_wire(outer), True)
    for hole in cap.holes:
        clockwise = profile_area(body.loop_profile(hole)) < 0
        face.Add(_as_wire(wires[hole] if clockwise else wires[hole].Reversed()))
    if not face.IsDone():
        raise GeometryError("the kernel makes no face of this section")
    return face.Face() if cap.up else face.Face().Reversed()


def _as_wire(shape: Any) -> Any:
    from OCP.TopoDS import TopoDS

    return TopoDS.Wire_s(shape)


def _wire(curves: Sequence[CadCurve], z: float) -> Any:
    """A closed wire at height ``z`` mm whose neighbours share their vertices."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeVertex, BRepBuilderAPI_MakeWire
    from OCP.gp import gp_Pnt

    starts = [complex(c.point(c.domain[0])) for c in curves]
    vertices = [BRepBuilderAPI_MakeVertex(gp_Pnt(p.real, p.imag, z)).Vertex() for p in starts]
    wire = BRepBuilderAPI_MakeWire()
    for index, curve in enumerate(curves):
        after = vertices[(index + 1) % len(curves)]
        handle, low, high = _kernel_curve(curve, z)
        edge = BRepBuilderAPI_MakeEdge(handle, vertices[index], after, low, high)
        if not edge.IsDone():
            raise GeometryError(f"the kernel makes no edge of curve {index}: {edge.Error()}")
        wire.Add(edge.Edge())
    return wire.Wire()


def _kernel_curve(curve: CadCurve, z: float) -> tuple[Any, float, float]:
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
    return _kernel_spline(curve, z)


def _kernel_spline(curve: BSpline, z: float) -> tuple[Any, float, float]:
    from OCP.Geom import Geom_BSplineCurve
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array1OfPnt
    from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal

    knots, counts = np.unique(curve.knots, return_counts=True)
    poles = TColgp_Array1OfPnt(1, len(curve.poles))
    for i, pole in enumerate(curve.poles.tolist()):
        poles.SetValue(i + 1, gp_Pnt(pole.real, pole.imag, z))
    reals, integers = TColStd_Array1OfReal(1, len(knots)), TColStd_Array1OfInteger(1, len(knots))
    for i, (knot, count) in enumerate(zip(knots.tolist(), counts.tolist(), strict=True)):
        reals.SetValue(i + 1, knot)
        integers.SetValue(i + 1, count)
    return Geom_BSplineCurve(poles, reals, integers, curve.degree), float(knots[0]), float(knots[-1])

"""Screw surfaces for the kernel: splines of section and turn, and true cylinders between helices.

Neighbouring faces share their edges: those of the sections, and one helix for each corner. Every edge gets its curve
in the parameters of both faces, so nothing is projected or sewn.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from geometry.approximation.outline import CadCurve, Outline
from geometry.base.errors import GeometryError
from geometry.base.placement import Placement2
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc
from geometry.solids.body import Body, Wall
from geometry.solids.screw import heights, surface_poles, turn_spans, turn_spline
from parts.solids.brep_curves import closed_edges, kernel_spline, knot_arrays, wire_of

# the kernel's own tolerance of faces and edges, mm
CONFUSION = 1e-7
# a cylinder's faces begin this far from the seam of its angle, rad
_FROM_SEAM = 0.5


class ScrewFaces:
    """Builds the faces of screw surfaces; the wires of their ends are kept for the caps."""

    def __init__(self, body: Body, outlines: Sequence[Outline], wires: dict[int, Any]) -> None:
        self.body, self.outlines, self.wires = body, outlines, wires
        self.ends: dict[int, tuple[list[CadCurve], list[Any], list[Any]]] = {}

    def faces(self, wall: Wall) -> list[Any]:
        """One face for each curve of the section: a cylinder for an arc about the axis, else a spline surface."""
        low, high = self.body.height(wall)
        twist = self.body.twist(wall)
        curves, lower, starts = self._end(wall.lower)
        _, upper, ends = self._end(wall.upper)
        reach = self.body.loop_profile(wall.lower).reach()
        turn = turn_spline(twist, turn_spans(twist, reach))
        rise = heights(turn, low, high)
        helices = []
        for curve, start, end in zip(curves, starts, ends, strict=True):
            corner = BSpline(turn.degree, turn.knots, complex(curve.point(curve.domain[0])) * turn.poles)
            helices.append(_edge(kernel_spline(corner, rise), start, end, turn.domain))
        faces = []
        for i, curve in enumerate(curves):
            around = lower[i], helices[(i + 1) % len(curves)], upper[i], helices[i]
            if isinstance(curve, Arc):
                faces.append(_cylinder_face(curve, twist, (low, high), around))
            else:
                assert isinstance(curve, BSpline)
                faces.append(spline_face(curve, turn, surface_poles(curve, turn), rise, around))
        return faces

    def _end(self, loop: int) -> tuple[list[CadCurve], list[Any], list[Any]]:
        """Turned curves of a loop, their edges and the vertices that these start from."""
        if loop not in self.ends:
            place = self.body.loops[loop]
            turned = Placement2(place.turn)
            curves = [c.placed(turned) if place.turn else c for c in self.outlines[place.profile].curves()]
            edges, vertices = closed_edges(curves, place.z)
            self.ends[loop] = curves, edges, vertices
            self.wires[loop] = wire_of(edges)
        return self.ends[loop]


def _edge(curve: Any, start: Any, end: Any, domain: tuple[float, float]) -> Any:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge

    made = BRepBuilderAPI_MakeEdge(curve, start, end, *domain)
    if not made.IsDone():
        raise GeometryError(f"the kernel makes no helix: {made.Error()}")
    return made.Edge()


def spline_face(section: BSpline, turn: BSpline, grid: Complex, rise: Real, around: tuple[Any, ...]) -> Any:
    """The face of a tensor product between its section at both ends and two edges along ``turn``.

    ``grid``: poles (u, v) in the plane on the knots of both; ``rise``: heights (v,) of the poles, mm. ``around``:
    lower, right, upper and left edge.
    """
    from OCP.Geom import Geom_BSplineSurface
    from OCP.gp import gp_Pnt
    from OCP.TColgp import TColgp_Array2OfPnt

    poles = TColgp_Array2OfPnt(1, grid.shape[0], 1, grid.shape[1])
    for i, row in enumerate(grid.tolist()):
        for j, pole in enumerate(row):
            poles.SetValue(i + 1, j + 1, gp_Pnt(pole.real, pole.imag, float(rise[j])))
    (u_knots, u_counts), (v_knots, v_counts) = knot_arrays(section), knot_arrays(turn)
    surface = Geom_BSplineSurface(poles, u_knots, v_knots, u_counts, v_counts, section.degree, turn.degree)
    (a, b), (c, d) = section.domain, turn.domain
    paths = [((a, c), (b, c), (a, b)), ((b, c), (b, d), (c, d)), ((a, d), (b, d), (a, b)), ((a, c), (a, d), (c, d))]
    return bounded_face(surface, around, [straight_path(*p) for p in paths], turns_left=True)


def _cylinder_face(arc: Arc, twist: float, height: tuple[float, float], around: tuple[Any, ...]) -> Any:
    """The face of a true cylinder between two arcs and two helices."""
    from OCP.Geom import Geom_CylindricalSurface
    from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt

    least = arc.start_angle + min(0.0, arc.sweep) + min(0.0, twist) - _FROM_SEAM
    frame = gp_Ax3(gp_Pnt(0, 0, height[0]), gp_Dir(0, 0, 1), gp_Dir(math.cos(least), math.sin(least), 0))
    surface = Geom_CylindricalSurface(frame, arc.radius)
    a, rise = arc.start_angle - least, height[1] - height[0]
    b, along = a + arc.sweep, (0.0, abs(arc.sweep))
    paths = [
        ((a, 0.0), (b, 0.0), along),
        ((b, 0.0), (b + twist, rise), (0.0, 1.0)),
        ((a + twist, rise), (b + twist, rise), along),
        ((a, 0.0), (a + twist, rise), (0.0, 1.0)),
    ]
    return bounded_face(surface, around, [straight_path(*p) for p in paths], turns_left=arc.sweep > 0)


def bounded_face(surface: Any, around: tuple[Any, ...], paths: list[Any], *, turns_left: bool) -> Any:
    """A face within four edges: lower, right, upper and left one, each with its path in the parameters."""
    from OCP.BRep import BRep_Builder
    from OCP.TopoDS import TopoDS_Face, TopoDS_Wire

    builder, face, wire = BRep_Builder(), TopoDS_Face(), TopoDS_Wire()
    builder.MakeFace(face, surface, CONFUSION)
    builder.MakeWire(wire)
    for index, (edge, path) in enumerate(zip(around, paths, strict=True)):
        builder.UpdateEdge(edge, path, face, CONFUSION)
        builder.Add(wire, edge if index < 2 else edge.Reversed())
    wire.Closed(True)
    builder.Add(face, wire if turns_left else wire.Reversed())
    return face


def straight_path(start: tuple[float, float], end: tuple[float, float], domain: tuple[float, float]) -> Any:
    """A straight path in a surface's parameters, run evenly over a parameter interval."""
    from OCP.Geom2d import Geom2d_BSplineCurve
    from OCP.gp import gp_Pnt2d
    from OCP.TColgp import TColgp_Array1OfPnt2d

    poles = TColgp_Array1OfPnt2d(1, 2)
    poles.SetValue(1, gp_Pnt2d(*start))
    poles.SetValue(2, gp_Pnt2d(*end))
    line = BSpline(1, np.array([domain[0], domain[0], domain[1], domain[1]]), np.zeros(2, complex))
    return Geom2d_BSplineCurve(poles, *knot_arrays(line), 1)

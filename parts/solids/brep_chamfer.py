"""Chamfers for the kernel: planes over lines, true cones over arcs, splines over all else.

Neighbouring faces share their edges: those of both boundaries, and one for each corner.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from geometry.approximation.chamfered import bezier_poles, node_shares
from geometry.approximation.outline import Outline
from geometry.base.errors import GeometryError
from geometry.curves.bspline import BSpline
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc, Line
from geometry.solids.body import Body, Wall
from parts.solids.brep_curves import closed_edges, kernel_spline, knot_arrays, wire_of
from parts.solids.brep_screw import bounded_face, spline_face, straight_path
from parts.solids.kernel import faces_of


def chamfer_faces(
    body: Body, wall: Wall, ends: tuple[int, int], outlines: Sequence[Outline], edges: dict[int, list[Any]]
) -> list[Any]:
    """One face for each curve of a chamfer between its loops of the whole boundary and of its end.

    ``edges``: those of every loop, which the chamfer takes or makes.
    """
    for loop in ends:
        if loop not in edges:
            place = body.loops[loop]
            edges[loop] = closed_edges(list(outlines[place.profile].curves()), place.z)[0]
    lower, upper = edges[wall.lower], edges[wall.upper]
    whole, end = (outlines[body.loops[loop].profile] for loop in ends)
    if whole.is_circle:
        return _full_cone(lower, upper)
    falls = ends[0] == wall.upper
    curves = list((end if falls else whole).curves())
    others = list((whole if falls else end).curves())
    grids = [grid[:, ::-1] if falls else grid for grid in end.chamfer_faces()]
    degree = grids[0].shape[1] - 1
    height = body.height(wall)
    rise = np.linspace(*height, degree + 1)
    along = BSpline(degree, np.repeat([0.0, 1.0], degree + 1), np.zeros(degree + 1, complex))
    corners = [
        _corner(BSpline(degree, along.knots, g[0]), rise, a, b) for g, a, b in zip(grids, lower, upper, strict=True)
    ]
    faces = []
    for i, (curve, other, grid) in enumerate(zip(curves, others, grids, strict=True)):
        around = lower[i], corners[(i + 1) % len(curves)], upper[i], corners[i]
        if isinstance(curve, BSpline):
            faces.append(spline_face(curve, along, grid, rise, around))
        elif isinstance(curve, Arc):
            assert isinstance(other, Arc)
            faces.append(_cone_face(curve, other, grid, height, around))
        else:
            faces.append(_plane_face(curve, complex(grid[0, -1]), height, around))
    return faces


def _corner(curve: BSpline, rise: Real, lower: Any, upper: Any) -> Any:
    """The edge of a corner between the starts of two edges."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge
    from OCP.TopExp import TopExp

    start, end = (TopExp.FirstVertex_s(edge, True) for edge in (lower, upper))
    made = BRepBuilderAPI_MakeEdge(kernel_spline(curve, rise), start, end, *curve.domain)
    if not made.IsDone():
        raise GeometryError(f"the kernel makes no edge of a chamfer: {made.Error()}")
    return made.Edge()


def _full_cone(lower: Sequence[Any], upper: Sequence[Any]) -> list[Any]:
    """The cone between two full circles."""
    from OCP.BRepFill import BRepFill_Generator

    generator = BRepFill_Generator()
    for edges in (lower, upper):
        generator.AddWire(wire_of(edges))
    generator.Perform()
    return list(faces_of(generator.Shell()))


def _plane_face(line: Line, corner: complex, height: tuple[float, float], around: tuple[Any, ...]) -> Any:
    """The plane face over a line; ``corner``: where its left edge ends."""
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.gp import gp_Dir, gp_Pln, gp_Pnt
    from OCP.TopoDS import TopoDS

    way, slant = line.end - line.start, corner - line.start
    along, across = (way.real, way.imag, 0.0), (slant.real, slant.imag, height[1] - height[0])
    plane = gp_Pln(gp_Pnt(line.start.real, line.start.imag, height[0]), gp_Dir(*np.cross(along, across).tolist()))
    lower, right, upper, left = around
    wire = wire_of([lower, right, *(TopoDS.Edge_s(edge.Reversed()) for edge in (upper, left))])
    made = BRepBuilderAPI_MakeFace(plane, wire, True)
    if not made.IsDone():
        raise GeometryError(f"the kernel makes no plane of a chamfer: {made.Error()}")
    return made.Face()


def _cone_face(lower: Arc, upper: Arc, grid: Complex, height: tuple[float, float], around: tuple[Any, ...]) -> Any:
    """The face of a true cone between two arcs about one centre and two corners; ``grid``: poles of its corners."""
    from OCP.Geom import Geom_ConicalSurface
    from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt

    centre, rise = lower.centre, height[1] - height[0]
    slant = math.atan2(upper.radius - lower.radius, rise)
    degree = grid.shape[1] - 1
    knots, shares = np.repeat([0.0, 1.0], degree + 1), node_shares(degree)
    middle = lower.start_angle + lower.sweep / 2
    # the angles of both corners, without a seam between them, and the cone's seam opposite to the face
    angles = [
        np.angle((BSpline(degree, knots, row).point(shares) - centre) * np.exp(-1j * middle)) + math.pi for row in grid
    ]
    seam = middle - math.pi
    frame = gp_Ax3(
        gp_Pnt(centre.real, centre.imag, height[0]), gp_Dir(0, 0, 1), gp_Dir(math.cos(seam), math.sin(seam), 0)
    )
    surface, length = Geom_ConicalSurface(frame, slant, lower.radius), rise / math.cos(slant)
    left, right = (_path(values, length) for values in angles)
    (a, b), (c, d) = ((row[0], row[-1]) for row in angles)
    paths = [
        straight_path((a, 0.0), (c, 0.0), (0.0, abs(lower.sweep))),
        right,
        straight_path((b, length), (d, length), (0.0, abs(upper.sweep))),
        left,
    ]
    return bounded_face(surface, around, paths, turns_left=lower.sweep > 0)


def _path(angles: Real, length: float) -> Any:
    """The path of a corner in a cone's parameters: its angles at the shares of the nodes, evenly along the cone."""
    from OCP.Geom2d import Geom2d_BSplineCurve
    from OCP.gp import gp_Pnt2d
    from OCP.TColgp import TColgp_Array1OfPnt2d

    degree = len(angles) - 1
    poles = TColgp_Array1OfPnt2d(1, degree + 1)
    for j, angle in enumerate(bezier_poles(angles.astype(complex)).real.tolist()):
        poles.SetValue(j + 1, gp_Pnt2d(angle, length * j / degree))
    knots = BSpline(degree, np.repeat([0.0, 1.0], degree + 1), np.zeros(degree + 1, complex))
    return Geom2d_BSplineCurve(poles, *knot_arrays(knots), degree)

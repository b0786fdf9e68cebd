"""Screw surfaces in STEP files: points of the kernel's faces and edges, held against the exact section."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from geometry.plane.measure import distance_to_profile
from geometry.solids.body import Body
from parts.base.readback import ReadError
from parts.solids.kernel import edges_of

if TYPE_CHECKING:
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.TopoDS import TopoDS_Face

Points = NDArray[np.float64]

_ALONG, _ACROSS, _PER_EDGE = 13, 9, 25
# a cylinder's axis meets that of the part, and heights in a file (8 decimals) a wall's ends, this well, mm and rad
_AXIS = 2e-8


def screw_deviation(samples: list[Points], body: Body, declared: float) -> float:
    """Greatest distance of points from the screw surfaces, each within the plane of its own height, mm."""
    if not samples:
        raise ReadError("the solid has no screw surface")
    points = np.concatenate(samples)
    best = np.full(len(points), np.inf)
    for wall in body.walls:
        if not body.is_screw(wall):
            continue
        low, high = body.height(wall)
        mine = np.flatnonzero((points[:, 2] > low - _AXIS) & (points[:, 2] < high + _AXIS))
        back = body.moved_back(wall, points[mine])
        found = distance_to_profile(back, body.loop_profile(wall.lower), trusted=declared)
        best[mine] = np.minimum(best[mine], found)
    return float(best.max())


def screw_samples(surface: BRepAdaptor_Surface, across: int = _ACROSS) -> Points:
    """Points of a spline surface between its ends, (n, 3); ``across``: at how many heights."""
    u = np.linspace(surface.FirstUParameter(), surface.LastUParameter(), _ALONG)
    v = np.linspace(surface.FirstVParameter(), surface.LastVParameter(), across)
    return _values(surface, [(a, b) for a in u.tolist() for b in v.tolist()])


def cylinder_samples(face: TopoDS_Face, surface: BRepAdaptor_Surface) -> Points:
    """Points of a cylinder's face between helices and of its edges, (n, 3).

    Raises
    ------
    ReadError
        Its axis is not that of the part.
    """
    axis = surface.Cylinder().Axis()
    place, way = axis.Location(), axis.Direction()
    if max(abs(place.X()), abs(place.Y()), abs(way.X()), abs(way.Y())) > _AXIS:
        raise ReadError("a cylinder between screw surfaces is not about the axis")
    return face_samples(face, surface)


def face_samples(face: TopoDS_Face, surface: BRepAdaptor_Surface) -> Points:
    """Points inside a face and on its edges, (n, 3)."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.BRepClass import BRepClass_FaceClassifier
    from OCP.gp import gp_Pnt2d
    from OCP.TopAbs import TopAbs_State

    u = np.linspace(surface.FirstUParameter(), surface.LastUParameter(), _ALONG)
    v = np.linspace(surface.FirstVParameter(), surface.LastVParameter(), _ACROSS)
    grid = [(a, b) for a in u.tolist() for b in v.tolist()]
    inside = [p for p in grid if BRepClass_FaceClassifier(face, gp_Pnt2d(*p), 1e-9).State() == TopAbs_State.TopAbs_IN]
    pieces = [_values(surface, inside)] if inside else []
    for edge in edges_of(face):
        curve = BRepAdaptor_Curve(edge)
        found = [curve.Value(t) for t in np.linspace(curve.FirstParameter(), curve.LastParameter(), _PER_EDGE).tolist()]
        pieces.append(np.array([(p.X(), p.Y(), p.Z()) for p in found]))
    return np.concatenate(pieces)


def has_helix(face: TopoDS_Face) -> bool:
    """Whether an edge of a face is a spline, which bounds a cylinder as a helix only."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.GeomAbs import GeomAbs_CurveType

    return any(BRepAdaptor_Curve(edge).GetType() == GeomAbs_CurveType.GeomAbs_BSplineCurve for edge in edges_of(face))


def _values(surface: BRepAdaptor_Surface, places: list[tuple[float, float]]) -> Points:
    found = [surface.Value(u, v) for u, v in places]
    return np.array([(p.X(), p.Y(), p.Z()) for p in found])

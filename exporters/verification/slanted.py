"""Slanted faces in STEP files: their points, and their shares of the volume by Green's theorem."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from exporters.verification.screw import face_samples, screw_samples
from geometry.plane.measure import gauss_rule
from parts.solids.kernel import edges_of

if TYPE_CHECKING:
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.TopoDS import TopoDS_Face

Points = NDArray[np.float64]

# at how many heights a spline is measured
_ACROSS = 5
# Gauss nodes and panels over a face, and nodes on an edge
_NODES, _PANELS, _EDGE_NODES = 8, 8, 16


def chamfer_samples(face: TopoDS_Face, surface: BRepAdaptor_Surface) -> Points:
    """Points of a slanted face, (n, 3): of a spline between its own ends, else within its edges."""
    from OCP.GeomAbs import GeomAbs_SurfaceType

    if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_BSplineSurface:
        return screw_samples(surface, _ACROSS)
    return face_samples(face, surface)


def slanted_share(face: TopoDS_Face, surface: BRepAdaptor_Surface) -> float:
    """Integral of z over the projection of a slanted face, its share of the volume, mm^3; upwards positive."""
    from OCP.GeomAbs import GeomAbs_SurfaceType

    kind = surface.GetType()
    if kind == GeomAbs_SurfaceType.GeomAbs_Plane:
        return _plane_share(face, surface)
    whole = surface.LastUParameter() - surface.FirstUParameter() > 2 * math.pi - 1e-9
    if kind == GeomAbs_SurfaceType.GeomAbs_Cone and not whole:
        return _cone_share(face, surface)
    return _patch_share(face, surface)


def _patch_share(face: TopoDS_Face, surface: BRepAdaptor_Surface) -> float:
    """The share of a face that runs between its surface's own ends."""
    from OCP.gp import gp_Pnt, gp_Vec
    from OCP.TopAbs import TopAbs_Orientation

    place, along, across = gp_Pnt(), gp_Vec(), gp_Vec()
    nodes, weights = (part.tolist() for part in gauss_rule(_NODES))
    total = 0.0
    low, high = surface.FirstVParameter(), surface.LastVParameter()
    for a, b in pairwise(np.linspace(surface.FirstUParameter(), surface.LastUParameter(), _PANELS + 1).tolist()):
        for node, weight in zip(nodes, weights, strict=True):
            for other, other_weight in zip(nodes, weights, strict=True):
                v = (low + high) / 2 + (high - low) / 2 * other
                surface.D1((a + b) / 2 + (b - a) / 2 * node, v, place, along, across)
                lift = along.X() * across.Y() - along.Y() * across.X()
                total += weight * other_weight * (b - a) * (high - low) / 4 * place.Z() * lift
    return -total if face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED else total


def _edge_nodes(face: TopoDS_Face) -> tuple[Points, Points]:
    """Points of a face's edges, and their weighted derivatives in the sense of the face, (n, 3) each."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.gp import gp_Pnt, gp_Vec
    from OCP.TopAbs import TopAbs_Orientation

    places, steps = [], []
    place, slope = gp_Pnt(), gp_Vec()
    nodes, weights = (part.tolist() for part in gauss_rule(_EDGE_NODES))
    for edge in edges_of(face):
        curve = BRepAdaptor_Curve(edge)
        half = (curve.LastParameter() - curve.FirstParameter()) / 2
        sense = -half if edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED else half
        for node, weight in zip(nodes, weights, strict=True):
            curve.D1(curve.FirstParameter() + half * (1 + node), place, slope)
            places.append((place.X(), place.Y(), place.Z()))
            steps.append((slope.X() * weight * sense, slope.Y() * weight * sense, slope.Z() * weight * sense))
    return np.array(places), np.array(steps)


def _plane_share(face: TopoDS_Face, surface: BRepAdaptor_Surface) -> float:
    """The share of a plane face: Green's theorem with the integral of z along x."""
    plane = surface.Plane()
    way, origin = plane.Axis().Direction(), plane.Location()
    along, across = -way.X() / way.Z(), -way.Y() / way.Z()
    at = origin.Z() - along * origin.X() - across * origin.Y()
    points, steps = _edge_nodes(face)
    x, y = points[:, 0], points[:, 1]
    return float(np.sum((along * x * x / 2 + across * x * y + at * x) * steps[:, 1]))


def _cone_share(face: TopoDS_Face, surface: BRepAdaptor_Surface) -> float:
    """The share of a part of an upright cone: Green's theorem over angle and height, dx dy = R R' dz dphi."""
    cone = surface.Cone()
    centre = complex(cone.Location().X(), cone.Location().Y())
    growth = math.tan(cone.SemiAngle()) * cone.Axis().Direction().Z()
    points, steps = _edge_nodes(face)
    spokes = points[:, 0] + 1j * points[:, 1] - centre
    middle = surface.Value(
        (surface.FirstUParameter() + surface.LastUParameter()) / 2,
        (surface.FirstVParameter() + surface.LastVParameter()) / 2,
    )
    angles = np.angle(spokes / (complex(middle.X(), middle.Y()) - centre))
    return float(-np.sum(angles * points[:, 2] * np.abs(spokes) * growth * steps[:, 2]))

"""STEP files of cylindrical cams read back: every face and edge, evaluated by the kernel, lies in an exact face."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from exporters.readers import ReadError, step_names
from exporters.verify import Verdict, deviation_failures
from exporters.verify_barrel import face_distance, surfaces_of
from exporters.verify_step import _read_step
from geometry.cams.barrel_body import BarrelBody, Cylinder, Plane, barrel_moments
from geometry.curve import Real

_ALONG, _ACROSS, _PER_EDGE = 41, 11, 25
# the kernel's volume of these smooth faces is good to this, and the walls' error times the solid's size, parts of it
_VOLUME = 1e-7
# what the kernel integrates to, part of the volume; without it, it is off by 1e-4 on steep walls
_QUADRATURE = 1e-9


def verify_barrel_step(file: Path, body: BarrelBody, declared: float, tolerance: float, name: str | None) -> Verdict:
    """Hold a STEP file of one cylindrical cam against its exact solid; see exporters/verify.py."""
    if name is not None and (found := step_names(file)) != [name]:
        raise ReadError(f"the file names its parts {', '.join(found) or 'nothing'} instead of {name}")
    return verify_barrel_solid(_read_step(file), body, declared, tolerance)


def verify_barrel_solid(solid: Any, body: BarrelBody, declared: float, tolerance: float) -> Verdict:
    """Hold a re-read solid against its exact one: faces, edges, ends, volume."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.GProp import GProp_GProps
    from OCP.TopAbs import TopAbs_ShapeEnum

    solids = len(_parts(solid, TopAbs_ShapeEnum.TopAbs_SOLID))
    failures = [] if solids == 1 else [f"{solids} solids instead of 1"]
    if not BRepCheck_Analyzer(solid).IsValid():
        failures.append("the kernel calls the solid invalid")
    surfaces = surfaces_of(body)
    used: set[int] = set()
    worst, cylinders = 0.0, 0
    for face in _parts(solid, TopAbs_ShapeEnum.TopAbs_FACE):
        points, is_cylinder = _samples(face)
        cylinders += is_cylinder
        away = [float(face_distance(body, surface, points).max()) for surface in surfaces]
        best = int(np.argmin(away))
        used.add(best)
        worst = max(worst, away[best])
    for index, surface in enumerate(surfaces):
        if index not in used:
            kind = {Cylinder: "cylinder", Plane: "plane face"}.get(type(surface), "wall")
            failures.append(f"a {kind} of the part is missing")
    reach = body.reach()
    failures += deviation_failures(worst, declared, tolerance, reach)
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(solid, properties, _QUADRATURE)
    volume, exact = float(properties.Mass()), barrel_moments(body).volume
    if not abs(volume / exact - 1) <= _VOLUME + 10 * declared / (body.cam.outer - body.cam.inner):
        failures.append(f"volume {volume:.12g} mm^3 instead of {exact:.12g} mm^3")
    measured = {
        "volume": volume,
        "volume_error": volume / exact - 1,
        "cylinders": float(cylinders),
        "max_deviation": worst,
    }
    return Verdict(measured, tuple(dict.fromkeys(failures)))


def _parts(shape: Any, kind: Any) -> list[Any]:
    from OCP.TopExp import TopExp_Explorer

    found, explorer = [], TopExp_Explorer(shape, kind)
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def _samples(face: Any) -> tuple[Real, bool]:
    """Points of a face over the box of its parameters, and of its edges; whether it is a cylinder.

    Walls fill their box; planes and cylinders go on beyond their edges in the same surface.
    """
    from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopoDS import TopoDS

    surface: Any = BRepAdaptor_Surface(TopoDS.Face_s(face))
    u = np.linspace(surface.FirstUParameter(), surface.LastUParameter(), _ALONG)
    v = np.linspace(surface.FirstVParameter(), surface.LastVParameter(), _ACROSS)
    found = [surface.Value(a, b) for a in u.tolist() for b in v.tolist()]
    for edge in _parts(face, TopAbs_ShapeEnum.TopAbs_EDGE):
        curve: Any = BRepAdaptor_Curve(TopoDS.Edge_s(edge))
        places = np.linspace(curve.FirstParameter(), curve.LastParameter(), _PER_EDGE)
        found += [curve.Value(t) for t in places.tolist()]
    points = np.array([(p.X(), p.Y(), p.Z()) for p in found])
    return points, surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder

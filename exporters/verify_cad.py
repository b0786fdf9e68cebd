"""Read-back of drawings and STEP files: splines evaluated by the libraries that read them, never by ours."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from exporters.readers import ReadError
from exporters.verify import Verdict, deviation_failures, is_simple
from geometry.curve import Complex
from geometry.line_arc import Arc
from geometry.measure import distance_to_profile, profile_area
from geometry.profile import Profile, Region

_PER_CURVE, _PER_WALL = 25, 13
# ends of neighbouring curves in one file meet this well, mm
_JOINT = 1e-9
_VOLUME = 1e-7


def verify_cad(file: Path, kind: str, region: Region, thickness: float, declared: float, tolerance: float) -> Verdict:
    """Hold a STEP or drawing file against its exact section; see exporters/verify.py."""
    if kind == "drawing":
        return _verdict(_loops(_read_drawing(file)), region, declared, tolerance, {})
    return verify_solid(_read_step(file), region, thickness, declared, tolerance)


def verify_solid(solid: Any, region: Region, thickness: float, declared: float, tolerance: float) -> Verdict:
    """Hold the solid of a part, as the kernel has read it, against its exact section."""
    faces = _measured_faces(solid, thickness)
    volume, exact = faces.area * thickness, sum(profile_area(p) for p in region.profiles()) * thickness
    failures = _solid_failures(solid, region, thickness, faces.cylinders)
    if not abs(volume / exact - 1) <= _VOLUME + 2 * declared / region.outer.reach():
        failures.append(f"volume {volume:.12g} mm^3 instead of {exact:.12g} mm^3")
    walls = np.min([distance_to_profile(faces.walls, p, trusted=declared) for p in region.profiles()], axis=0).max()
    failures += deviation_failures(float(walls), declared, tolerance, region)
    measured = {
        "volume": volume,
        "volume_error": volume / exact - 1,
        "cylinders": float(faces.cylinders),
        "wall_deviation": float(walls),
    }
    lower = _verdict(_loops(faces.lower), region, declared, tolerance, measured)
    upper = _verdict(_loops(faces.upper), region, declared, tolerance, measured)
    return Verdict(lower.measured, tuple(dict.fromkeys((*failures, *lower.failures, *upper.failures))))


def _verdict(
    loops: list[Complex], region: Region, declared: float, tolerance: float, measured: dict[str, float]
) -> Verdict:
    profiles = region.profiles()
    if len(loops) != len(profiles):
        return Verdict(measured, (f"{len(loops)} contours instead of {len(profiles)}",))
    failures: list[str] = []
    worst, left = 0.0, list(loops)
    for profile in profiles:
        rough = [float(distance_to_profile(x[:: max(1, len(x) // 16)], profile, trusted=np.inf).max()) for x in left]
        loop = left.pop(int(np.argmin(rough)))
        worst = max(worst, float(distance_to_profile(loop, profile, trusted=declared).max()))
        failures += _loop_failures(loop, profile)
    failures += deviation_failures(worst, declared, tolerance, region)
    return Verdict({**measured, "contours": float(len(loops)), "max_deviation": worst}, tuple(failures))


def _loop_failures(loop: Complex, profile: Profile) -> list[str]:
    """Self-crossing, and an area that is not the profile's (the samples' polygon knows it to a part in 500)."""
    failures = [] if is_simple(loop) else ["a contour crosses itself"]
    found, exact = 0.5 * abs(np.sum((np.conj(loop) * np.roll(loop, -1)).imag)), abs(profile_area(profile))
    if abs(found / exact - 1) > 2e-3:
        failures.append(f"encloses {found:.6g} mm^2 instead of {exact:.6g} mm^2")
    return failures


def _loops(pieces: list[Complex]) -> list[Complex]:
    """Sampled curves (each from its first to its last point) chained by their ends into closed loops."""
    left = list(pieces)
    loops = []
    # files carry 15 digits: the joints of large parts are that much wider
    joint = _JOINT + 1e-11 * max(float(np.abs(piece).max()) for piece in pieces) if pieces else _JOINT
    while left:
        chain = [left.pop()]
        while abs(chain[-1][-1] - chain[0][0]) > joint:
            ends = np.array([[piece[0], piece[-1]] for piece in left]).reshape(-1, 2)
            gaps = np.abs(ends - chain[-1][-1])
            if not gaps.size or gaps.min() > joint:
                raise ReadError(f"a contour is open at ({chain[-1][-1].real:.6g}, {chain[-1][-1].imag:.6g})")
            index, side = divmod(int(np.argmin(gaps)), 2)
            piece = left.pop(index)
            chain.append(piece if side == 0 else piece[::-1])
        loops.append(np.concatenate([piece[:-1] for piece in chain]))
    return loops


def _read_drawing(file: Path) -> list[Complex]:
    """Samples of every curve of a drawing DXF, evaluated by ezdxf."""
    import ezdxf

    try:
        drawing = ezdxf.readfile(str(file))
    except (ezdxf.DXFError, OSError, ValueError, LookupError, StopIteration, TypeError, AttributeError) as error:
        raise ReadError(f"not a readable DXF: {error or 'it ends too early'}") from error
    auditor = drawing.audit()
    if auditor.errors or auditor.fixes:
        raise ReadError(f"the DXF audit finds fault: {(auditor.errors + auditor.fixes)[0].message}")
    if drawing.header.get("$INSUNITS") != 4:
        raise ReadError("the DXF is not in mm ($INSUNITS is not 4)")
    return [_drawn(entity) for entity in drawing.modelspace()]


def _drawn(entity: Any) -> Complex:
    share = np.linspace(0, 1, _PER_CURVE)
    kind = entity.dxftype()
    if kind == "LINE":
        ends = [complex(p.x, p.y) for p in (entity.dxf.start, entity.dxf.end)]
        return np.asarray(ends[0] + share * (ends[1] - ends[0]), dtype=np.complex128)
    if kind in ("ARC", "CIRCLE"):
        centre, radius = complex(entity.dxf.center.x, entity.dxf.center.y), entity.dxf.radius
        low, high = (0.0, 360.0) if kind == "CIRCLE" else (entity.dxf.start_angle, entity.dxf.end_angle)
        share = np.linspace(0, 1, 10 * _PER_CURVE) if kind == "CIRCLE" else share
        turned = np.radians(low + share * ((high - low) % 360 or 360))
        return np.asarray(centre + radius * np.exp(1j * turned), dtype=np.complex128)
    if kind == "SPLINE":
        tool = entity.construction_tool()
        knots = np.asarray(tool.knots())
        return np.array([complex(p.x, p.y) for p in tool.points(knots[0] + share * (knots[-1] - knots[0]))])
    raise ReadError(f"a {kind} stands in the drawing; only lines, arcs, circles and splines belong there")


def _read_step(file: Path) -> Any:
    """The single shape of a STEP file."""
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.STEPControl import STEPControl_Reader

    from exporters.step import silent_kernel

    with silent_kernel():
        reader = STEPControl_Reader()
        if reader.ReadFile(str(file)) != IFSelect_RetDone:
            raise ReadError("not a readable STEP file")
        reader.TransferRoots()
        return reader.OneShape()


def _solid_failures(solid: Any, region: Region, thickness: float, cylinders: int) -> list[str]:
    """One valid solid of the right height, whose arcs have all become cylinders."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    solids, explorer = 0, TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_SOLID)
    while explorer.More():
        solids += 1
        explorer.Next()
    failures = [] if solids == 1 else [f"{solids} solids instead of 1"]
    if not BRepCheck_Analyzer(solid).IsValid():
        failures.append("the kernel calls the solid invalid")
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(solid, box, True, False)
    if abs(box.CornerMax().Z() - box.CornerMin().Z() - thickness) > 1e-6:
        failures.append("the solid is not as thick as the part")
    arcs = sum(isinstance(s.curve, Arc) for s in region.outer.period) * region.outer.count + len(region.holes)
    if cylinders != arcs:
        failures.append(f"{cylinders} cylinders instead of {arcs}")
    return failures


class _Faces(NamedTuple):
    """Samples of the edges of both plane faces, of the walls half way up, the area inside and the cylinders' number."""

    lower: list[Complex]
    upper: list[Complex]
    walls: Complex
    area: float
    cylinders: int


def _measured_faces(solid: Any, thickness: float) -> _Faces:
    """Every face of an extruded solid, measured with the kernel's own evaluation; area by Green's integral."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    levels: dict[bool, list[Complex]] = {False: [], True: []}
    walls, area, cylinders = [], 0.0, 0
    faces = TopExp_Explorer(solid, TopAbs_ShapeEnum.TopAbs_FACE)
    while faces.More():
        face = TopoDS.Face_s(faces.Current())
        surface = BRepAdaptor_Surface(face)
        cylinders += surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder
        normal_up = (
            surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Plane
            and abs(surface.Plane().Axis().Direction().Z()) > 1 - 1e-12
        )
        if normal_up:
            upper = surface.Plane().Location().Z() > thickness / 2
            pieces, share = _face_edges(face)
            levels[upper] += pieces
            area += 0.0 if upper else share
        else:
            walls.append(_wall_samples(surface, thickness))
        faces.Next()
    return _Faces(levels[False], levels[True], np.concatenate(walls), abs(area), cylinders)


def _wall_samples(surface: Any, thickness: float) -> Complex:
    """Points of a wall half way up; the vertical parameter of every wall runs along the axis."""
    middle = (surface.FirstVParameter() + surface.LastVParameter()) / 2
    low, high = surface.FirstUParameter(), surface.LastUParameter()
    places = [surface.Value(u, middle) for u in np.linspace(low, high, _PER_WALL).tolist()]
    if any(abs(p.Z() - thickness / 2) > 1e-6 for p in places):
        raise ReadError("a wall does not stand upright between both faces")
    return np.array([complex(p.X(), p.Y()) for p in places])


def _face_edges(face: Any) -> tuple[list[Complex], float]:
    """Samples of a plane face's edges in their sense, and the area inside them."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    pieces, area = [], 0.0
    edges = TopExp_Explorer(face, TopAbs_ShapeEnum.TopAbs_EDGE)
    while edges.More():
        edge = TopoDS.Edge_s(edges.Current())
        samples, share = _edge_samples(BRepAdaptor_Curve(edge))
        turned = edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        pieces.append(samples[::-1] if turned else samples)
        area += -share if turned else share
        edges.Next()
    return pieces, area


def _edge_samples(curve: Any) -> tuple[Complex, float]:
    """Points along an edge and its share of the area, by Gauss's rule on the kernel's own derivatives."""
    from OCP.GeomAbs import GeomAbs_CurveType
    from OCP.gp import gp_Pnt, gp_Vec

    low, high = curve.FirstParameter(), curve.LastParameter()
    count = 10 * _PER_CURVE if curve.GetType() == GeomAbs_CurveType.GeomAbs_Circle and high - low > 3 else _PER_CURVE
    points = [curve.Value(t) for t in np.linspace(low, high, count).tolist()]
    nodes, weights = np.polynomial.legendre.leggauss(16)
    breaks = np.linspace(low, high, 9)
    total = 0.0
    place, slope = gp_Pnt(), gp_Vec()
    for a, b in pairwise(breaks.tolist()):
        for node, weight in zip(nodes.tolist(), weights.tolist(), strict=True):
            curve.D1((a + b) / 2 + (b - a) / 2 * node, place, slope)
            total += weight * (b - a) / 4 * (place.X() * slope.Y() - place.Y() * slope.X())
    return np.array([complex(p.X(), p.Y()) for p in points]), total

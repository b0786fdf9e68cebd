"""Read-back of STEP files: faces and edges evaluated by the kernel that reads them, never by our own splines.

The volume is taken by Gauss's theorem from Green's integrals over the caps' edges and over the chamfers: the
kernel's own quadrature is good to 1e-6 only.
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from exporters.formats.chains import chained
from exporters.formats.read_step import ReadSolid
from exporters.verification.chamfers import chamfer_deviation
from exporters.verification.outlines import verify_samples
from exporters.verification.screw import cylinder_samples, face_samples, has_helix, screw_deviation, screw_samples
from exporters.verification.slanted import chamfer_samples, slanted_share
from exporters.verification.verdict import Verdict, deviation_failures
from geometry.base.record import Draft, field
from geometry.curves.curve import Complex
from geometry.curves.line_arc import Arc
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Profile
from geometry.solids.body import Body
from geometry.solids.mass import body_moments
from geometry.solids.screw import cut_twists
from parts.base.readback import ReadError
from parts.solids.kernel import count_solids, edges_of, faces_of

if TYPE_CHECKING:
    from OCP.BRepAdaptor import BRepAdaptor_Curve, BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType
    from OCP.TopoDS import TopoDS_Face, TopoDS_Shape

_PER_CURVE, _PER_WALL = 25, 13
_VOLUME = 1e-7
# heights in a file meet those of the body this well, mm
_LEVEL = 1e-7


def verify_solid(found: ReadSolid, body: Body, declared: float, tolerance: float) -> Verdict:
    """Hold a re-read solid against its exact body: caps, walls, cylinders, volume."""
    solid, body = found.shape, cut_twists(body)
    sheared = body.has_screws() and not body.twisted_profiles()
    faces = _measured_faces(solid, screws=bool(body.twisted_profiles()), sheared=sheared)
    exact = body_moments(body).volume
    failures = _solid_failures(solid, body, faces.cylinders)
    reach = max(p.reach() for p in body.profiles)
    if not abs(faces.volume - exact) <= (_VOLUME + 2 * declared / reach) * exact:
        failures.append(f"volume {faces.volume:.12g} mm^3 instead of {exact:.12g} mm^3")
    worst, walls_found = _wall_deviation(faces, body, declared)
    failures += walls_found
    if faces.chamfers:
        worst = max(worst, chamfer_deviation(np.concatenate(faces.chamfers), body, declared))
    if body.has_screws():
        worst = max(worst, screw_deviation(faces.screws, body, declared))
    contours, expected = 0, _cap_profiles(body)
    if len(expected) != len(faces.caps):
        failures.append(f"plane faces at {len(faces.caps)} heights instead of {len(expected)}")
    for z, pieces in faces.caps.items():
        near = min(expected, key=lambda level: abs(level - z))
        if abs(near - z) > _LEVEL:
            failures.append(f"a plane face stands at z = {z:.9g} mm")
            continue
        verdict = verify_samples(chained(pieces), expected[near], declared, tolerance)
        worst = max(worst, verdict.measured.get("max_deviation", 0.0))
        contours += int(verdict.measured["contours"])
        failures += verdict.failures
    failures += deviation_failures(worst, declared, tolerance, reach)
    measured = {
        "volume": faces.volume,
        "volume_error": faces.volume / exact - 1,
        "cylinders": float(faces.cylinders),
        "contours": float(contours),
        "max_deviation": worst,
    }
    return Verdict(measured, tuple(dict.fromkeys(failures)))


def _cap_profiles(body: Body) -> dict[float, list[Profile]]:
    """The profiles that bound the caps at each height, turned as they stand there."""
    found: dict[float, list[Profile]] = {}
    for cap in body.caps:
        loops = (cap.outer, *cap.holes)
        found.setdefault(body.loops[cap.outer].z, []).extend(
            body.loop_profile(i).placed(body.loops[i].placement) for i in loops
        )
    return found


def _wall_deviation(faces: _Faces, body: Body, declared: float) -> tuple[float, list[str]]:
    """Greatest distance of the upright walls' samples from the profiles of the walls at their height."""
    worst, failures = 0.0, []
    for z, samples in faces.walls.items():
        profiles = [
            body.loop_profile(w.lower)
            for w in body.walls
            if body.is_upright(w) and body.height(w)[0] < z < body.height(w)[1]
        ]
        if not profiles:
            failures.append(f"a wall stands at z = {z:.9g} mm, where there is none")
            continue
        points = np.concatenate(samples)
        worst = max(
            worst, float(np.min([distance_to_profile(points, p, trusted=declared) for p in profiles], axis=0).max())
        )
    return worst, failures


def _solid_failures(solid: TopoDS_Shape, body: Body, cylinders: int) -> list[str]:
    """One valid solid of the right height, whose arcs have all become cylinders."""
    from OCP.Bnd import Bnd_Box
    from OCP.BRepBndLib import BRepBndLib
    from OCP.BRepCheck import BRepCheck_Analyzer

    solids = count_solids(solid)
    failures = [] if solids == 1 else [f"{solids} solids instead of 1"]
    if not BRepCheck_Analyzer(solid).IsValid():
        failures.append("the kernel calls the solid invalid")
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(solid, box, True, False)
    levels = body.levels()
    if max(abs(box.CornerMin().Z() - levels[0]), abs(box.CornerMax().Z() - levels[-1])) > 1e-6:
        failures.append("the solid is not as thick as the part")
    arcs = sum(
        _cylinders(body.loop_profile(w.lower), turned=body.is_screw(w)) for w in body.walls if not body.is_chamfer(w)
    )
    if cylinders != arcs:
        failures.append(f"{cylinders} cylinders instead of {arcs}")
    return failures


def _cylinders(profile: Profile, *, turned: bool) -> int:
    """How many cylinders stand on a profile; a full circle is one. A ``turned`` one has those about the axis only."""
    arcs = [s.curve for s in profile.period if isinstance(s.curve, Arc) and not (turned and s.curve.centre)]
    whole = profile.count == 1 and len(arcs) == len(profile.period) and len({(a.centre, a.radius) for a in arcs}) == 1
    return 1 if whole else len(arcs) * profile.count


class _Faces(Draft):
    """Samples of cap edges by height, of upright walls by the height of their middle, of chamfers and of screw
    surfaces (n, 3); cylinders, volume.
    """

    caps: dict[float, list[Complex]] = field(default_factory=dict)
    walls: dict[float, list[Complex]] = field(default_factory=dict)
    chamfers: list[NDArray[np.float64]] = field(default_factory=list)
    screws: list[NDArray[np.float64]] = field(default_factory=list)
    cylinders: int = 0
    volume: float = 0.0


def _measured_faces(solid: TopoDS_Shape, *, screws: bool, sheared: bool) -> _Faces:
    """Every face of a solid, measured with the kernel's own evaluation; ``screws``: slanted faces are such.

    The walls of a ``sheared`` body carry no volume: the field z along their slope has divergence 1 and runs in them.
    """
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType

    found = _Faces()
    for face in faces_of(solid):
        surface = BRepAdaptor_Surface(face)
        kind = surface.GetType()
        found.cylinders += kind == GeomAbs_SurfaceType.GeomAbs_Cylinder
        slope = abs(surface.Plane().Axis().Direction().Z()) if kind == GeomAbs_SurfaceType.GeomAbs_Plane else -1.0
        if slope > 1 - 1e-12:
            z = _level(found.caps, surface.Plane().Location().Z())
            pieces, share = _face_edges(face)
            found.caps.setdefault(z, []).extend(pieces)
            found.volume += z * share
        elif sheared:
            found.screws.append(face_samples(face, surface))
        elif screws and kind == GeomAbs_SurfaceType.GeomAbs_Cylinder and has_helix(face):
            found.screws.append(cylinder_samples(face, surface))
        elif kind in _upright_kinds() or 0 <= slope < 1e-12:
            z, samples = _wall_samples(surface)
            found.walls.setdefault(_level(found.walls, z), []).append(samples)
        else:
            found.volume += slanted_share(face, surface)
            if screws:
                found.screws.append(screw_samples(surface))
            else:
                found.chamfers.append(chamfer_samples(face, surface))
    return found


def _upright_kinds() -> tuple[GeomAbs_SurfaceType, ...]:
    from OCP.GeomAbs import GeomAbs_SurfaceType

    return GeomAbs_SurfaceType.GeomAbs_Cylinder, GeomAbs_SurfaceType.GeomAbs_SurfaceOfExtrusion


def _level(known: dict[float, list[Complex]], z: float) -> float:
    """A height that is known already, or a new one."""
    return next((k for k in known if abs(k - z) <= _LEVEL), z)


def _wall_samples(surface: BRepAdaptor_Surface) -> tuple[float, Complex]:
    """Points of a wall half way up and their height; the second parameter of every wall runs along the axis."""
    middle = (surface.FirstVParameter() + surface.LastVParameter()) / 2
    low, high = surface.FirstUParameter(), surface.LastUParameter()
    places = [surface.Value(u, middle) for u in np.linspace(low, high, _PER_WALL).tolist()]
    heights = [p.Z() for p in places]
    if max(heights) - min(heights) > _LEVEL:
        raise ReadError("a wall does not stand upright between both faces")
    return heights[0], np.array([complex(p.X(), p.Y()) for p in places])


def _face_edges(face: TopoDS_Face) -> tuple[list[Complex], float]:
    """Samples of a plane face's edges in their sense, and the area inside them."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.TopAbs import TopAbs_Orientation

    pieces, area = [], 0.0
    for edge in edges_of(face):
        samples, share = _edge_samples(BRepAdaptor_Curve(edge))
        turned = edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        pieces.append(samples[::-1] if turned else samples)
        area += -share if turned else share
    return pieces, area


def _edge_samples(curve: BRepAdaptor_Curve) -> tuple[Complex, float]:
    """Points along an edge and its share of the area, by Gauss's rule on the kernel's own derivatives."""
    from OCP.GeomAbs import GeomAbs_CurveType
    from OCP.gp import gp_Pnt, gp_Vec

    low, high = curve.FirstParameter(), curve.LastParameter()
    count = 10 * _PER_CURVE if curve.GetType() == GeomAbs_CurveType.GeomAbs_Circle and high - low > 1.5 else _PER_CURVE
    points = [curve.Value(t) for t in np.linspace(low, high, count).tolist()]
    breaks, order = _quadrature(curve, low, high)
    nodes, weights = _gauss(order)
    total = 0.0
    place, slope = gp_Pnt(), gp_Vec()
    for a, b in pairwise(breaks):
        for node, weight in zip(nodes, weights, strict=True):
            curve.D1((a + b) / 2 + (b - a) / 2 * node, place, slope)
            total += weight * (b - a) / 4 * (place.X() * slope.Y() - place.Y() * slope.X())
    return np.array([complex(p.X(), p.Y()) for p in points]), total


def _quadrature(curve: BRepAdaptor_Curve, low: float, high: float) -> tuple[list[float], int]:
    """Where to break an edge and how many nodes each piece takes, so that Gauss's rule is exact or as good."""
    from OCP.GeomAbs import GeomAbs_CurveType

    kind = curve.GetType()
    if kind == GeomAbs_CurveType.GeomAbs_Line:
        return [low, high], 1
    if kind == GeomAbs_CurveType.GeomAbs_BSplineCurve and not curve.IsRational():
        spline = curve.BSpline()
        inner = [k for k in (spline.Knot(i) for i in range(1, spline.NbKnots() + 1)) if low < k < high]
        # x y' - y x' has degree 2 p - 1 between knots
        return [low, *inner, high], max(1, curve.Degree())
    return np.linspace(low, high, 9).tolist(), 16


@cache
def _gauss(order: int) -> tuple[list[float], list[float]]:
    nodes, weights = np.polynomial.legendre.leggauss(order)
    return nodes.tolist(), weights.tolist()

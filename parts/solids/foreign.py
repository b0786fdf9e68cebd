"""The solid of somebody else's STEP file as our faces, by the CAD kernel: exact, or refused by what it has beyond them.

Planes, cylinders, cones, spheres and tori between lines, circles and splines are taken over one by one, and spline
faces between the four ends of their surfaces, pole by pole. Splines and swept surfaces that are one of the former, as
rational ones mostly are, become it; other edges (ellipses, rational splines) become splines that follow them. How far
the edges lie off the faces is measured, and the volume is held against the kernel's own.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, NoReturn

import numpy as np

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement3
from geometry.base.tolerance import PRECISION
from geometry.curves.curve import Real
from geometry.solids.charts import along_edges, charts, edge_rows, patch_of, span_shares
from geometry.solids.face_moments import face_moments
from geometry.solids.faced import FacedBody, FacedSolid
from geometry.solids.faces import (
    Circular,
    Cone,
    Cylinder,
    Edges,
    Faces,
    Frame,
    Index,
    Loop,
    Plane,
    Solid,
    SolidBuilder,
    Sphere,
    Spline,
    SplineSurface,
    Straight,
    Torus,
)  # fmt: skip
from geometry.solids.measured import Measured
from geometry.solids.patch_distance import patch_distance
from parts.solids.kernel import KernelError, edges_of, explored, faces_of, kernel_errors, solids_of, volume_of

if TYPE_CHECKING:
    from OCP.Geom import Geom_BSplineCurve, Geom_BSplineSurface
    from OCP.GeomAbs import GeomAbs_CurveType, GeomAbs_SurfaceType
    from OCP.GeomAdaptor import GeomAdaptor_Surface
    from OCP.gp import gp_Ax2, gp_Ax3, gp_Dir, gp_Pnt
    from OCP.TopoDS import TopoDS_Edge, TopoDS_Face, TopoDS_Shape, TopoDS_Wire

# by which edges may lie off their faces, mm, as a STEP file of ours may; part of the volume, of the size
_LOOSE, _VOLUME, _EXACT = 1e-6, 1e-6, 1e-13
# what rounding leaves of it
_TIGHT = 0.9
_SHARES, _ON_SPAN = np.linspace(0.0, 1.0, 9), 16
# degrees that are read back at most; how near to the ends of a surface its edges run, part of it
_MOST_DEGREE, _AT_END = 8, 1e-6
# within which a spline is a circle, or a plane and so on, and what is asked of the kernel, mm, which is stricter then
_SAME, _SOUGHT = 1e-8, 1e-6
# to which splines follow what has no poles, mm, and how many pieces they may have
_FOLLOWED, _MOST_PIECES = 1e-9, 500
# lines on which the poles of a sphere may lie: through the corners, the edges and the faces of a cube
_CUBE = np.stack(np.meshgrid(*[[-1.0, 0.0, 1.0]] * 3), axis=-1).reshape(-1, 3)[:13]
_WAYS = _CUBE / np.linalg.norm(_CUBE, axis=1)[:, None]
# numbers of which the kernel comes to no end; what may look like one and is a name
_MOST_NUMBER, _LARGE, _QUOTED = 1e100, re.compile(r"[-+]?\d+\.?\d*[Ee]\+?\d{3,}"), re.compile(r"'[^']*'")
# what is taken over one by one
_TAKEN = ("Plane", "Cylinder", "Cone", "Sphere", "Torus")
# what STEP calls what the kernel calls otherwise
_CALLED = {
    "Ellipse": "ELLIPSE", "Hyperbola": "HYPERBOLA", "Parabola": "PARABOLA", "OffsetCurve": "OFFSET_CURVE_3D",
    "RationalCurve": "RATIONAL_B_SPLINE_CURVE", "RationalSurface": "RATIONAL_B_SPLINE_SURFACE",
    "SurfaceOfRevolution": "SURFACE_OF_REVOLUTION", "SurfaceOfExtrusion": "SURFACE_OF_LINEAR_EXTRUSION",
    "OffsetSurface": "OFFSET_SURFACE", "Torus": "TOROIDAL_SURFACE", "Cone": "CONICAL_SURFACE",
    "BSplineSurface": "B_SPLINE_SURFACE", "BezierSurface": "BEZIER_SURFACE", "BSplineCurve": "B_SPLINE_CURVE",
}  # fmt: skip


def foreign_body(text: str, part_from_file: Placement3, number: int | None = None) -> FacedBody:
    """A solid of a STEP file's text, laid by ``part_from_file`` (mm); units are converted by the kernel.

    ``number``: which of several, from 1 on.

    Raises
    ------
    ParameterError
        ``file``: the kernel is not installed, it finds no solid or several, or one that is bounded by what else there
        is than said above.
    """
    beyond = next((n for n in _LARGE.findall(_QUOTED.sub("", text)) if abs(float(n)) > _MOST_NUMBER), None)
    if beyond is not None:
        raise ParameterError("file", None, "step_number", found=beyond, most=_MOST_NUMBER)
    try:
        solids = solids_of(text)
    except ImportError:
        raise ParameterError("file", None, "needs_kernel") from None
    if not solids or (number is None and len(solids) > 1):
        raise ParameterError("file", None, "step_several" if solids else "step_solids", count=len(solids))
    if number is not None and number > len(solids):
        raise ParameterError("solid", number, "step_fewer", count=len(solids))
    try:
        with kernel_errors():
            made = _Taken(_laid(solids[(number or 1) - 1], part_from_file), text)
            solid = made.taken()
    except KernelError as failed:
        raise ParameterError("file", None, "step_kernel", why=str(failed)) from failed
    walls = tuple(
        Measured("spline", patch_distance(patch_of(solid, faces.surface)))
        for faces in solid.faces
        if isinstance(faces.surface, SplineSurface)
    )
    error = _off_faces(solid)
    if not error <= _TIGHT * _LOOSE:
        raise ParameterError("file", None, "step_loose", error=error, most=_LOOSE)
    moments = face_moments(solid)
    volume = volume_of([made.shape], moments.volume, _VOLUME)
    if not (volume > 0 and abs(moments.volume / volume - 1) <= _VOLUME):
        raise ParameterError("file", None, "step_volume", found=moments.volume, volume=volume)
    is_exact = not walls and error <= _EXACT * float(np.abs(solid.points).max())
    whole = FacedSolid(solid, 0.0 if is_exact else error, "exact" if is_exact else "sampled")
    precision = PRECISION if error <= _TIGHT * PRECISION else _LOOSE
    return FacedBody(lambda _: whole, walls, lambda: moments, precision=precision)


def _laid(shape: TopoDS_Shape, placement: Placement3) -> TopoDS_Shape:
    from OCP.gp import gp_Trsf
    from OCP.TopLoc import TopLoc_Location

    motion = gp_Trsf()
    motion.SetValues(*placement.matrix().ravel().tolist())
    return shape.Moved(TopLoc_Location(motion))


def _opened(shape: TopoDS_Shape) -> TopoDS_Shape:
    """A shape whose spline faces that close round themselves are cut in two each, with all edges that they share."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.ShapeBuild import ShapeBuild_ReShape
    from OCP.ShapeUpgrade import ShapeUpgrade_ShapeDivideClosed

    changed = ShapeBuild_ReShape()
    for face in faces_of(shape):
        closed = any(BRep_Tool.IsClosed_s(edge, face) for edge in edges_of(face))
        if closed and _named(BRepAdaptor_Surface(face, False).GetType()) not in _TAKEN and _known_surface(face) is None:
            halves = ShapeUpgrade_ShapeDivideClosed(face)
            halves.SetContext(changed)
            halves.Perform(False)
    return changed.Apply(shape)


def _off_faces(solid: Solid) -> float:
    """How far edges lie off their faces, and end off their vertices, at most, mm, by samples."""
    points = [along_edges(solid, edges, _shares(edges))[0][0] for edges in solid.edges]
    bundle, _ = edge_rows(solid)
    worst = 0.0
    for edges, run in zip(solid.edges, points, strict=True):
        ends = solid.points[solid.vertices[[edges.start[0], edges.end[0]]]]
        worst = max(worst, float(np.linalg.norm(run[[0, -1]] - ends, axis=1).max()))
    for faces in solid.faces:
        surface = faces.surface
        if isinstance(surface, SplineSurface):
            distance = patch_distance(patch_of(solid, surface))
        else:
            distance = charts(solid, surface, 1)[0].distance
        on_it = np.concatenate([points[bundle[edge]] for edges, _ in faces.loops for edge in edges[0].tolist()])
        worst = max(worst, float(distance(on_it).max()))
    return worst


def _shares(edges: Edges) -> Real:
    """Shares of edges at which they are held against their faces: as many on each span of a spline."""
    if not isinstance(edges.curve, Spline):
        return _SHARES
    return span_shares(edges.curve.knots, _ON_SPAN)


class _Taken(SolidBuilder):
    """Takes over the vertices, edges and faces of a kernel's solid, each once."""

    def __init__(self, shape: TopoDS_Shape, text: str) -> None:
        super().__init__()
        self.shape, self.text = _opened(shape), text
        # the ends of spline surfaces by the kernel's numbers of the edges that run along them, as these run
        self.ends: dict[int, Spline] = {}

    def taken(self) -> Solid:
        """All of it."""
        from OCP.BRep import BRep_Tool
        from OCP.TopAbs import TopAbs_ShapeEnum
        from OCP.TopExp import TopExp
        from OCP.TopoDS import TopoDS
        from OCP.TopTools import TopTools_IndexedMapOfShape

        def mapped(kind: TopAbs_ShapeEnum) -> TopTools_IndexedMapOfShape:
            found = TopTools_IndexedMapOfShape()
            TopExp.MapShapes_s(self.shape, kind, found)
            return found

        if mapped(TopAbs_ShapeEnum.TopAbs_SHELL).Extent() != 1:
            raise ParameterError("file", None, "step_hollow")
        corners, edges = mapped(TopAbs_ShapeEnum.TopAbs_VERTEX), mapped(TopAbs_ShapeEnum.TopAbs_EDGE)
        for number in range(1, corners.Extent() + 1):
            self.add_vertices(self.point(BRep_Tool.Pnt_s(TopoDS.Vertex_s(corners.FindKey(number)))))
        faces = mapped(TopAbs_ShapeEnum.TopAbs_FACE)
        each = [TopoDS.Face_s(faces.FindKey(number)) for number in range(1, faces.Extent() + 1)]
        surfaces = [self.surface(face, edges.FindIndex) for face in each]
        # numbers of our edges by those of the kernel's map; a pole is no edge
        numbers: dict[int, int] = {}
        for number in range(1, edges.Extent() + 1):
            edge = TopoDS.Edge_s(edges.FindKey(number))
            if not BRep_Tool.Degenerated_s(edge):
                first, last = (corners.FindIndex(v) - 1 for v in _ends(edge))
                curve = self.ends.get(number) or self.curve(edge)
                made = self.add_edges(np.array([first]), np.array([last]), curve)
                numbers[number] = int(made[0])
        for face, surface in zip(each, surfaces, strict=True):
            self.face(face, *surface, lambda edge: numbers.get(edges.FindIndex(edge)))
        return self.solid()

    def refuse(self, code: str, kind: str) -> NoReturn:
        """A refusal of what the kernel calls so, with the id of the first such entity."""
        called = _CALLED.get(kind, kind)
        found = re.search(rf"#(\d+)\s*=\s*[^;]*?\b{called}(?:_WITH_KNOTS)?\s*\(", self.text)
        raise ParameterError("file", None, code, what=f"#{found[1]} {called}" if found else called)

    def net(self, poles: Real) -> Index:
        """Points (..., 3) of the kernel's, by number."""
        return self.add_points(poles[..., 0] + 1j * poles[..., 1], poles[..., 2])

    def point(self, at: gp_Pnt) -> Index:
        """A point of the kernel's."""
        return self.add_points(np.array([complex(at.X(), at.Y())]), at.Z())

    def frame(self, axes: gp_Ax2 | gp_Ax3, way: float = 1.0, along: float = 0.0) -> Frame:
        """A frame of the kernel's, its axis turned over where ``way`` is -1, moved so far along it."""
        axis = way * _direction(axes.Direction())
        origin = self.point(axes.Location())
        if along:
            x, y, z = self.points[-1][0] + along * axis[0]
            origin = self.add_points(np.array([complex(x, y)]), z)
        return Frame(origin, axis, _direction(axes.XDirection()))

    def sphere_frame(self, face: TopoDS_Face, axes: gp_Ax3) -> Frame:
        """The frame of a sphere; where a face is not cut open along a seam, with poles far from its edges."""
        from OCP.BRep import BRep_Tool
        from OCP.BRepAdaptor import BRepAdaptor_Curve

        edges = list(edges_of(face))
        if any(BRep_Tool.IsClosed_s(edge, face) for edge in edges):
            return self.frame(axes)
        curves = [BRepAdaptor_Curve(edge) for edge in edges if not BRep_Tool.Degenerated_s(edge)]
        places = [c.Value(c.FirstParameter() + share * (c.LastParameter() - c.FirstParameter()))
                  for c in curves for share in _SHARES.tolist()]  # fmt: skip
        frame, centre = self.frame(axes), axes.Location()
        spokes = np.array([[p.X() - centre.X(), p.Y() - centre.Y(), p.Z() - centre.Z()] for p in places])
        nearest = np.abs(spokes @ _WAYS.T).max(axis=0)
        # the file's own axis where it is as good
        own = float(np.abs(spokes @ frame.axis[0]).max())
        if own <= float(nearest.min()):
            return frame
        axis = _WAYS[[int(nearest.argmin())]]
        zero = np.cross(axis, np.eye(3)[[int(np.abs(axis).argmin())]])
        return Frame(frame.origin, axis, zero / np.linalg.norm(zero))

    def curve(self, edge: TopoDS_Edge) -> Straight | Circular | Spline:
        """The line, arc or spline of an edge."""
        from OCP.BRepAdaptor import BRepAdaptor_Curve
        from OCP.GeomAbs import GeomAbs_CurveType as Kind
        from OCP.TopAbs import TopAbs_Orientation
        from OCP.TopoDS import TopoDS

        plain = TopoDS.Edge_s(edge.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
        curve = BRepAdaptor_Curve(plain)
        if curve.GetType() == Kind.GeomAbs_Line:
            return Straight(_direction(curve.Line().Direction()))
        if curve.GetType() == Kind.GeomAbs_Circle:
            circle = curve.Circle()
            return Circular(self.frame(circle.Position()), circle.Radius())
        spline = _poles_of(plain)
        if spline is None:
            known = _circle_of(plain)
            if known is not None:
                return Circular(self.frame(known[0]), known[1])
            spline = _followed(plain)
        if spline is None:
            self.refuse("step_curve", _named(curve.GetType()))
        poles = [spline.Pole(k + 1) for k in range(spline.NbPoles())]
        places = self.net(np.array([[[p.X(), p.Y(), p.Z()] for p in poles]]))
        return Spline(spline.Degree(), _knots(spline.NbKnots(), spline.Knot, spline.Multiplicity), places)

    def face(
        self, face: TopoDS_Face, surface: Plane | Cylinder | Cone | Torus | Sphere | SplineSurface, direct: bool,
        number: Callable[[TopoDS_Edge], int | None],
    ) -> None:  # fmt: skip
        """A face with its loops, the outer one first; ``direct``: the kernel's normal looks where ours does."""
        from OCP.BRepTools import BRepTools
        from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
        from OCP.TopoDS import TopoDS

        plain = TopoDS.Face_s(face.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
        turned = face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED
        outer = BRepTools.OuterWire_s(plain)
        loops: list[Loop] = []
        for found in explored(plain, TopAbs_ShapeEnum.TopAbs_WIRE):
            wire = TopoDS.Wire_s(found)
            run = [(number(edge), ahead) for edge, ahead in _run(wire, plain)]
            kept = [(at, ahead != turned) for at, ahead in (run[::-1] if turned else run) if at is not None]
            if kept:
                loop: Loop = np.array([[at for at, _ in kept]]), np.array([ahead for _, ahead in kept])
                loops.insert(0 if wire.IsSame(outer) else len(loops), loop)
        self.faces.append(Faces(surface, tuple(loops), direct != turned))

    def surface(
        self, face: TopoDS_Face, number: Callable[[TopoDS_Edge], int]
    ) -> tuple[Plane | Cylinder | Cone | Torus | Sphere | SplineSurface, bool]:
        """The surface of a face, and whether the kernel's normal looks where ours does."""
        from OCP.BRepAdaptor import BRepAdaptor_Surface

        told: BRepAdaptor_Surface | GeomAdaptor_Surface = BRepAdaptor_Surface(face, False)
        named, same = _named(told.GetType()), True
        if named not in _TAKEN:
            known = _known_surface(face)
            if known is None:
                return self.patch(face, named, number), True
            told, same = known
            named = _named(told.GetType())
        found = getattr(told, named)()
        axes = found.Position()
        direct = axes.Direct() == same
        if named == "Plane":
            return Plane(self.frame(axes)), direct
        if named == "Cylinder":
            return Cylinder(self.frame(axes), found.Radius()), direct
        if named == "Sphere":
            return Sphere(self.sphere_frame(face, axes), found.Radius()), direct
        if named == "Torus":
            if found.MinorRadius() >= found.MajorRadius():
                self.refuse("step_surface", "Torus")
            return Torus(self.frame(axes), found.MajorRadius(), found.MinorRadius()), direct
        slant, radius = abs(found.SemiAngle()), found.RefRadius()
        # an apex is no place for a surface to begin
        aside = max(1.0 - radius, 0.0)
        frame = self.frame(axes, np.sign(found.SemiAngle()), aside / np.tan(slant))
        return Cone(frame, radius + aside, slant), direct

    def patch(self, face: TopoDS_Face, kind: str, number: Callable[[TopoDS_Edge], int]) -> SplineSurface:
        """A spline surface between the four edges of a face, which get its ends as their curves."""
        found = _surface_of(face)
        if found is None:
            self.refuse("step_surface", kind)
        surface, bounds = found
        degrees = surface.UDegree(), surface.VDegree()
        count = surface.NbUPoles(), surface.NbVPoles()
        poles = [[surface.Pole(i + 1, j + 1) for j in range(count[1])] for i in range(count[0])]
        places = self.net(np.array([[[p.X(), p.Y(), p.Z()] for p in row] for row in poles]))
        u = _knots(surface.NbUKnots(), surface.UKnot, surface.UMultiplicity)
        v = _knots(surface.NbVKnots(), surface.VKnot, surface.VMultiplicity)
        # along v at both ends of u, along u at both ends of v
        sides = [(1, v, places[0]), (1, v, places[-1]), (0, u, places[:, 0]), (0, u, places[:, -1])]
        seen = []
        for edge, at in _sides(face, bounds):
            if at is None:
                self.refuse("step_trimmed", kind)
            side, ahead = at
            across, knots, row = sides[side]
            seen.append(side)
            # a line runs evenly as it is
            if len(row) > 2:
                run = (knots, row) if ahead else (knots[0] + knots[-1] - knots[::-1], row[::-1])
                own = Spline(degrees[across], run[0], run[1][None])
                kept = self.ends.setdefault(number(edge), own)
                # two surfaces that part an edge in other spans meet in none of them
                if kept.degree != own.degree or not _alike(kept.knots, own.knots):
                    self.refuse("step_trimmed", kind)
        if sorted(seen) != [0, 1, 2, 3]:
            self.refuse("step_trimmed", kind)
        return SplineSurface(degrees, u, v, places[None])


def _alike(one: Real, other: Real) -> bool:
    """Whether knots part a spline alike."""
    a, b = ((knots - knots[0]) / (knots[-1] - knots[0]) for knots in (one, other))
    return len(a) == len(b) and bool(np.abs(a - b).max() <= _AT_END)


def _named(kind: GeomAbs_CurveType | GeomAbs_SurfaceType) -> str:
    return str(kind.name).rpartition("_")[2]


def _knots(count: int, place: Callable[[int], float], times: Callable[[int], int]) -> Real:
    """Knots of the kernel's, each as often as it counts."""
    return np.repeat([place(k + 1) for k in range(count)], [times(k + 1) for k in range(count)])


def _poles_of(edge: TopoDS_Edge) -> Geom_BSplineCurve | None:
    """The curve of an edge as a spline from its first to its last pole; None: it has no such poles of its own."""
    from OCP.BRep import BRep_Tool
    from OCP.Geom import Geom_TrimmedCurve
    from OCP.GeomAbs import GeomAbs_CurveType as Kind
    from OCP.GeomAdaptor import GeomAdaptor_Curve
    from OCP.GeomConvert import GeomConvert

    low, high = BRep_Tool.Range_s(edge)
    curve = BRep_Tool.Curve_s(edge, low, high)
    if GeomAdaptor_Curve(curve).GetType() not in (Kind.GeomAbs_BSplineCurve, Kind.GeomAbs_BezierCurve):
        return None
    spline = GeomConvert.CurveToBSplineCurve_s(Geom_TrimmedCurve(curve, low, high))
    return None if spline.IsRational() or spline.Degree() > _MOST_DEGREE else spline


def _circle_of(edge: TopoDS_Edge) -> tuple[gp_Ax2, float] | None:
    """Place and radius of the circle that an edge is, about the axis about which it runs counter-clockwise."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve
    from OCP.gp import gp_Circ, gp_Pnt, gp_Vec
    from OCP.ShapeAnalysis import ShapeAnalysis_CanonicalRecognition

    circle = gp_Circ()
    if not ShapeAnalysis_CanonicalRecognition(edge).IsCircle(_SAME, circle):
        return None
    curve, at, way = BRepAdaptor_Curve(edge), gp_Pnt(), gp_Vec()
    curve.D1((curve.FirstParameter() + curve.LastParameter()) / 2, at, way)
    axes = circle.Position()
    if gp_Vec(axes.Location(), at).Crossed(way).Dot(gp_Vec(axes.Direction())) < 0:
        axes.SetDirection(axes.Direction().Reversed())
    return axes, circle.Radius()


def _followed(edge: TopoDS_Edge) -> Geom_BSplineCurve | None:
    """A spline that follows the curve of an edge; None where none does."""
    from OCP.BRep import BRep_Tool
    from OCP.Geom import Geom_TrimmedCurve
    from OCP.GeomAbs import GeomAbs_Shape
    from OCP.GeomConvert import GeomConvert_ApproxCurve

    low, high = BRep_Tool.Range_s(edge)
    curve = Geom_TrimmedCurve(BRep_Tool.Curve_s(edge, low, high), low, high)
    made = GeomConvert_ApproxCurve(curve, _FOLLOWED, GeomAbs_Shape.GeomAbs_C2, _MOST_PIECES, _MOST_DEGREE)
    return made.Curve() if made.HasResult() and made.MaxError() <= _SAME else None


def _known_surface(face: TopoDS_Face) -> tuple[GeomAdaptor_Surface, bool] | None:
    """The plane or surface of revolution that the surface of a face is, and whether their normals look one way."""
    from OCP.BRep import BRep_Tool
    from OCP.BRepTools import BRepTools
    from OCP.GeomAdaptor import GeomAdaptor_Surface
    from OCP.GeomAPI import GeomAPI_ProjectPointOnSurf
    from OCP.GeomConvert import GeomConvert_SurfToAnaSurf
    from OCP.GeomLProp import GeomLProp_SLProps

    surface, bounds = BRep_Tool.Surface_s(face), BRepTools.UVBounds_s(face)
    sought = GeomConvert_SurfToAnaSurf(surface)
    try:
        with kernel_errors():
            known = sought.ConvertToAnalytical(_SOUGHT)
    except KernelError:
        # it fails at some splines that are none of these
        return None
    if known is None or not sought.Gap() <= _SAME or _named(GeomAdaptor_Surface(known).GetType()) not in _TAKEN:
        return None
    u, v = (bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2
    at = GeomAPI_ProjectPointOnSurf(surface.Value(u, v), known).LowerDistanceParameters()
    normals = [GeomLProp_SLProps(x, *place, 1, _SAME).Normal() for x, place in ((surface, (u, v)), (known, at))]
    return GeomAdaptor_Surface(known), normals[0].Dot(normals[1]) > 0


def _surface_of(face: TopoDS_Face) -> tuple[Geom_BSplineSurface, Real] | None:
    """The part of a surface that a face takes as a spline, and where it begins and ends along u and v, (2, 2).

    What is rational or of too high a degree is followed by another; None where none does.
    """
    from OCP.BRep import BRep_Tool
    from OCP.BRepTools import BRepTools
    from OCP.Geom import Geom_RectangularTrimmedSurface
    from OCP.GeomAbs import GeomAbs_Shape
    from OCP.GeomConvert import GeomConvert, GeomConvert_ApproxSurface

    whole = BRep_Tool.Surface_s(face)
    bounds, ends = (np.reshape(found, (2, 2)) for found in (BRepTools.UVBounds_s(face), whole.Bounds()))
    for way, closed in enumerate((whole.IsUPeriodic(), whole.IsVPeriodic())):
        # the kernel's projections of edges end some 1e-9 beyond what there is
        bounds[way] = bounds[way] if closed else np.clip(bounds[way], *ends[way])
    part = Geom_RectangularTrimmedSurface(whole, *bounds.ravel().tolist())
    surface = GeomConvert.SurfaceToBSplineSurface_s(part)
    if surface.IsURational() or surface.IsVRational() or max(surface.UDegree(), surface.VDegree()) > _MOST_DEGREE:
        smooth = GeomAbs_Shape.GeomAbs_C1
        made = GeomConvert_ApproxSurface(part, _SAME, smooth, smooth, _MOST_DEGREE, _MOST_DEGREE, _MOST_PIECES, 0)
        if not made.HasResult() or made.MaxError() > 10 * _SAME:
            return None
        surface = made.Surface()
    return surface, bounds


def _sides(face: TopoDS_Face, bounds: Real) -> Iterator[tuple[TopoDS_Edge, tuple[int, bool] | None]]:
    """Edges of a face with the end of its surface at which each runs (u, then v), and whether it runs ahead there."""
    from OCP.BRepAdaptor import BRepAdaptor_Curve2d
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopoDS import TopoDS

    for edge in edges_of(face):
        plain = TopoDS.Edge_s(edge.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
        curve = BRepAdaptor_Curve2d(plain, face)
        low, high = curve.FirstParameter(), curve.LastParameter()
        places = [curve.Value(low + share * (high - low)) for share in _SHARES.tolist()]
        at = (np.array([[p.X(), p.Y()] for p in places]) - bounds[:, 0]) / (bounds[:, 1] - bounds[:, 0])
        away = np.abs(np.stack([at[:, 0], 1 - at[:, 0], at[:, 1], 1 - at[:, 1]])).max(axis=1)
        side = int(away.argmin())
        along = at[:, 1 - side // 2]
        whole = abs(abs(along[-1] - along[0]) - 1) <= _AT_END
        yield plain, (side, bool(along[-1] > along[0])) if away[side] <= _AT_END and whole else None


def _run(wire: TopoDS_Wire, face: TopoDS_Face) -> Iterator[tuple[TopoDS_Edge, bool]]:
    """The edges of a wire in order, and whether each runs forwards."""
    from OCP.BRepTools import BRepTools_WireExplorer
    from OCP.TopAbs import TopAbs_Orientation

    explorer = BRepTools_WireExplorer(wire, face)
    count = 0
    while explorer.More():
        count += 1
        yield explorer.Current(), explorer.Current().Orientation() == TopAbs_Orientation.TopAbs_FORWARD
        explorer.Next()
    if count != wire.NbChildren():
        raise ParameterError("file", None, "step_wire")


def _ends(edge: TopoDS_Edge) -> tuple[TopoDS_Shape, TopoDS_Shape]:
    """The vertices at the start and the end of an edge's curve."""
    from OCP.TopAbs import TopAbs_Orientation
    from OCP.TopExp import TopExp
    from OCP.TopoDS import TopoDS

    plain = TopoDS.Edge_s(edge.Oriented(TopAbs_Orientation.TopAbs_FORWARD))
    return TopExp.FirstVertex_s(plain, False), TopExp.LastVertex_s(plain, False)


def _direction(way: gp_Dir) -> Real:
    return np.array([[way.X(), way.Y(), way.Z()]])

"""Cams: the follower is rolled over the outline read back from a file, and its lift held against the exact law."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from exporters.read_dxf import read_dxf
from exporters.readers import Loop, ReadError, ReadMesh, read_3mf, read_stl, read_svg
from exporters.verify import Verdict
from geometry.cams.disk import DiskCam
from geometry.cams.follower_motion import TURN
from geometry.cams.rolled import Outline, lift_bound, outline_of_loop, outline_of_polynomials, rolled_lift
from geometry.contour import signed_area
from geometry.curve import Complex, Real
from geometry.distinct import distinct
from geometry.findings import Finding
from parts.part import Part

# a file, or a ReadMesh or kernel's shape that was read from an assembly
Source = Path | Any
ANGLES = 3600
# jumps of S'' above this share of its peak are told
_JUMP_SHARE = 0.1
# a second difference meets a joint between these many angles
_JUMP_WIDTH = 3
# samples of each span of a spline: polynomials up to this degree less one come back exactly
_SAMPLES = 8
# ends of neighbouring curves meet this well, part of the outline's size
_JOINT = 1e-9
# rounding of the rolling itself, part of the outline's size
_ROUNDING = 1e-12


def reroll(
    file: Source, kind: str, part: Part, offset: float, declared: float, verdict: Verdict
) -> tuple[Verdict, tuple[Finding, ...]]:
    """Add to a verdict what the follower does on the file: errors of lift, S' and S'' in mm (or degrees), per rad.

    ``file``: a path, or the mesh or shape that was read from an assembly.
    ``offset``: how far the file's outlines are moved out of the material; the follower rolled is that much smaller.
    A lift that is further off than ``declared`` mm of outline can make it is a failure. Files that are broken
    already are not rolled, nor are outlines trimmed by their offset, whose part of the lift is gone.
    """
    cam = part.cam
    if part.barrel is not None:
        from exporters.reroll_barrel import reroll_barrel

        return reroll_barrel(file, kind, part, offset, declared, verdict), ()
    if part.wedge is not None and not verdict.failures:
        from exporters.reroll_wedge import reroll_wedge

        return reroll_wedge(file, kind, part, offset, declared, verdict)
    if part.walls and not verdict.failures:
        from exporters.reroll_walls import reroll_walls

        return reroll_walls(file, kind, part, offset, declared, verdict)
    if cam is None or verdict.failures or part.section(offset).findings:
        return verdict, ()
    try:
        outline = outline_of_file(file, kind, part)
    except ReadError as refusal:
        return replace(verdict, failures=(*verdict.failures, str(refusal))), ()
    angle = np.arange(ANGLES) * (TURN / ANGLES)
    error = rolled_lift(cam, outline, ANGLES, offset) - cam.motion.value(angle)
    if np.any(np.isnan(error)):
        text = f"the follower finds no outline at cam angle {math.degrees(angle[np.isnan(error)][0]):.6g} degrees"
        return replace(verdict, failures=(*verdict.failures, text)), ()
    measured, jump, peak = rolled_differences(cam, error)
    size = _ROUNDING * float(np.abs(cam.contact(angle)).max())
    failure = rolled_failure(cam, error, lift_bound(cam, ANGLES, declared + size))
    failures = verdict.failures if failure is None else (*verdict.failures, failure)
    told = kind in ("dxf", "svg") and jump > _JUMP_SHARE * peak > 0
    return Verdict(verdict.measured | measured, failures), ((Finding("rolled_jumps", jump, peak),) if told else ())


def rolled_differences(cam: DiskCam, error: Real) -> tuple[dict[str, float], float, float]:
    """What is measured of a lift's errors over the turn (mm or rad), and the jump and the peak of S'' among it."""
    unit = math.degrees(1.0) if cam.swings else 1.0
    names = ("lift_error", "") if unit == 1.0 else ("swing_error_deg", "_deg")
    first, second = _differences(error * unit)
    angle = np.arange(ANGLES) * (TURN / ANGLES)
    peak = float(np.abs(_differences(cam.motion.value(angle) * unit)[1]).max())
    jump = float(np.abs(np.roll(second, -_JUMP_WIDTH) - second).max())
    measured = {
        names[0]: float(np.abs(error).max() * unit),
        f"velocity_error{names[1]}": float(np.abs(first).max()),
        f"acceleration_error{names[1]}": float(np.abs(second).max()),
        f"acceleration_jump{names[1]}": jump,
        f"acceleration_peak{names[1]}": peak,
    }
    return measured, jump, peak


def rolled_failure(cam: DiskCam, error: Real, bound: Real) -> str | None:
    """What is wrong with a lift whose errors (mm or rad) exceed their bound somewhere; None where they do not."""
    excess = np.abs(error) - bound
    worst = int(np.argmax(excess))
    if excess[worst] <= 0:
        return None
    size = math.degrees(abs(error[worst])) if cam.swings else abs(error[worst])
    found, place = f"{size:.6g} {'degrees' if cam.swings else 'mm'}", f"{worst * 360 / ANGLES:.6g} degrees"
    return f"the follower's lift is wrong by {found} at cam angle {place}, more than the outline's error allows"


def _differences(values: Real) -> tuple[Real, Real]:
    """Slope and bending of values over the whole turn, by central differences of neighbouring angles."""
    step, before, after = TURN / ANGLES, np.roll(values, 1), np.roll(values, -1)
    return (after - before) / (2 * step), (after - 2 * values + before) / step**2


def outline_of_file(file: Source, kind: str, part: Part) -> Outline:
    """The outline that the follower touches, from a file of any format.

    Raises
    ------
    ReadError
        The file holds no closed outline.
    """
    middle = part.face_width / 2
    if kind in ("dxf", "svg"):
        return _largest(read_dxf(file) if kind == "dxf" else read_svg(file))
    if kind in ("stl", "3mf"):
        mesh = mesh_of(file, kind, part)
        return _largest([Loop(loop, np.zeros(len(loop)), "") for loop in mesh_slices(mesh, middle)])
    loops = smooth_loops(file, kind, middle)
    if not loops:
        raise ReadError("there is no outline for the follower to touch")
    return outline_of_polynomials(max(loops, key=lambda c: float(np.ptp(c[:, 0].real))))


def mesh_of(file: Source, kind: str, part: Part) -> ReadMesh:
    """The mesh of a part, from its file or as it was read from an assembly."""
    if not isinstance(file, Path):
        mesh: ReadMesh = file
        return mesh
    return read_stl(file) if kind == "stl" else read_3mf(file, part.id)


def smooth_loops(file: Source, kind: str, z: float) -> list[Complex]:
    """The closed loops of a drawing, or of a STEP solid at a height, as polynomials (n, 8) of rising powers."""
    pieces = _drawing_pieces(file) if kind == "drawing" else _step_pieces(file, z)
    return [_coefficients(loop) for loop in _chained(pieces)]


def _largest(loops: list[Loop]) -> Outline:
    if not loops:
        raise ReadError("there is no outline for the follower to touch")
    outer = max(loops, key=lambda loop: abs(signed_area(loop.vertices, loop.bulges)))
    return outline_of_loop(outer.vertices, outer.bulges)


def mesh_slices(mesh: ReadMesh, z: float) -> list[Complex]:
    """Closed polygons in which a plane cuts a mesh; corners that stand on a straight edge are left out."""
    heights = mesh.vertices[:, 2]
    above = heights > z
    corners = mesh.triangles[above[mesh.triangles].any(axis=1) & ~above[mesh.triangles].all(axis=1)]
    ends = np.roll(corners, -1, axis=1)
    # each cut triangle is left through one edge that goes up and one that goes down
    up, down = (~above[corners] & above[ends]).argmax(axis=1), (above[corners] & ~above[ends]).argmax(axis=1)
    row = np.arange(len(corners))
    following = dict(
        zip(
            zip(corners[row, down].tolist(), ends[row, down].tolist(), strict=True),
            zip(ends[row, up].tolist(), corners[row, up].tolist(), strict=True),
            strict=True,
        )
    )
    loops = []
    while following:
        first, at = following.popitem()
        keys = [first]
        while at != first:
            if at not in following:
                raise ReadError("the outline of a wall is not closed")
            keys.append(at)
            at = following.pop(at)
        loops.append(_cut(mesh.vertices, np.array(keys), z))
    return loops


def _cut(vertices: NDArray[np.float64], keys: NDArray[np.int64], z: float) -> Complex:
    a, b = vertices[keys[:, 0]], vertices[keys[:, 1]]
    share = (z - a[:, 2]) / (b[:, 2] - a[:, 2])
    points = a[:, :2] + share[:, None] * (b[:, :2] - a[:, :2])
    places = points[:, 0] + 1j * points[:, 1]
    # the diagonals of upright walls cut their chords in the middle
    upright = np.all(a[:, :2] == b[:, :2], axis=1)
    return np.asarray(places[upright] if upright.sum() >= 3 else places)


def _drawing_pieces(file: Path) -> list[Complex]:
    """Samples of every smooth span of a drawing DXF, (8,) each, evaluated by ezdxf."""
    import ezdxf

    share = _nodes()
    pieces: list[Complex] = []
    entities: list[Any] = list(ezdxf.readfile(str(file)).modelspace())
    for entity in entities:
        kind = entity.dxftype()
        if kind == "LINE":
            a, b = (complex(p.x, p.y) for p in (entity.dxf.start, entity.dxf.end))
            pieces.append(np.asarray(a + share * (b - a), dtype=np.complex128))
        elif kind in ("ARC", "CIRCLE"):
            low = 0.0 if kind == "CIRCLE" else entity.dxf.start_angle
            sweep = 360.0 if kind == "CIRCLE" else (entity.dxf.end_angle - low) % 360 or 360.0
            edges = np.linspace(low, low + sweep, max(2, math.ceil(sweep / 5)) + 1)
            turned = np.radians(edges[:-1, None] + share * np.diff(edges)[:, None])
            pieces += list(complex(*entity.dxf.center.vec2) + entity.dxf.radius * np.exp(1j * turned))
        elif kind == "SPLINE":
            tool = entity.construction_tool()
            knots = distinct(np.asarray(tool.knots()))
            places = (knots[:-1, None] + share * np.diff(knots)[:, None]).ravel()
            pieces += list(np.array([complex(p.x, p.y) for p in tool.points(places)]).reshape(-1, _SAMPLES))
    return pieces


def _step_pieces(file: Source, z: float) -> list[Complex]:
    """Samples of every smooth span of the upright walls at a height, (8,) each, evaluated by the kernel."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    from exporters.verify_step import _read_step

    share, pieces = _nodes(), []
    shape = _read_step(file) if isinstance(file, Path) else file
    faces = TopExp_Explorer(shape, TopAbs_ShapeEnum.TopAbs_FACE)
    while faces.More():
        surface: Any = BRepAdaptor_Surface(TopoDS.Face_s(faces.Current()))
        faces.Next()
        low, high = surface.FirstVParameter(), surface.LastVParameter()
        bottom, top = (surface.Value(surface.FirstUParameter(), v) for v in (low, high))
        if not min(bottom.Z(), top.Z()) < z < max(bottom.Z(), top.Z()) or abs(bottom.X() - top.X()) > _JOINT:
            continue
        edges = _smooth_spans(surface)
        for a, b in pairwise(edges):
            places = [surface.Value(u, low) for u in (a + share * (b - a)).tolist()]
            pieces.append(np.array([complex(p.X(), p.Y()) for p in places]))
    return pieces


def _smooth_spans(surface: Any) -> Real:
    """Parameters between which a wall is smooth: knots of its spline (the kernel's intervals pass over simple ones)."""
    from OCP.GeomAbs import GeomAbs_CurveType, GeomAbs_SurfaceType

    low, high = surface.FirstUParameter(), surface.LastUParameter()
    kind = surface.GetType()
    if kind == GeomAbs_SurfaceType.GeomAbs_Cylinder:
        return np.linspace(low, high, max(2, math.ceil((high - low) / math.radians(5))) + 1)
    if kind == GeomAbs_SurfaceType.GeomAbs_SurfaceOfExtrusion:
        basis = surface.BasisCurve()
        if basis.GetType() == GeomAbs_CurveType.GeomAbs_BSplineCurve:
            spline = basis.BSpline()
            knots = np.array([spline.Knot(k) for k in range(1, spline.NbKnots() + 1)])
            return np.array([low, *knots[(knots > low + _JOINT) & (knots < high - _JOINT)], high])
    return np.array([low, high])


def _nodes() -> Real:
    """Places on 0 .. 1 with both ends, dense there: Chebyshev's."""
    return np.asarray((1 - np.cos(np.linspace(0, np.pi, _SAMPLES))) / 2)


def _chained(pieces: list[Complex]) -> list[Complex]:
    """Sampled spans, turned and put one behind the other into closed loops, (n, 8) each."""
    left, loops = np.array(pieces).reshape(-1, _SAMPLES), []
    joint = _JOINT * float(np.abs(left).max()) if len(left) else 0.0
    free = np.ones(len(left), dtype=bool)
    while free.any():
        at = int(np.argmax(free))
        free[at] = False
        chain = [left[at]]
        while abs(chain[-1][-1] - chain[0][0]) > joint:
            gaps = np.abs(left[:, [0, -1]] - chain[-1][-1])
            gaps[~free] = np.inf
            at, side = divmod(int(np.argmin(gaps)), 2)
            if gaps[at, side] > joint:
                raise ReadError("the outline of a wall is not closed")
            free[at] = False
            chain.append(left[at] if side == 0 else left[at][::-1])
        loops.append(np.array(chain))
    return loops


def _coefficients(samples: Complex) -> Complex:
    """Rising powers of t on 0 .. 1 of the polynomials through samples, (n, 8)."""
    return np.asarray(np.linalg.solve(np.vander(_nodes(), increasing=True), samples.T).T)

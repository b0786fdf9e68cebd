"""Read-back of STEP files: faces and edges of a solid that was read against its exact body."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np

from exporters.formats.read_curves import lobatto, spans_of
from exporters.formats.read_part21 import Index
from exporters.formats.read_solid import LEVEL, PLANE, SQUARE, Model
from exporters.formats.read_step import ReadSolid
from exporters.verification.area import told_verdict
from exporters.verification.chamfers import chamfer_distances
from exporters.verification.copies import copy_failures
from exporters.verification.outlines import verify_samples
from exporters.verification.samples import edge_points, foot_points, inner_points
from exporters.verification.verdict import Verdict, deviation_failures, volume_bound
from geometry.curves.curve import Complex, Flags, Real
from geometry.curves.line_arc import Arc
from geometry.plane.measure import distance_to_nearest, distance_to_profile
from geometry.plane.profile import Profile
from geometry.solids.body import Body, Wall
from geometry.solids.mass import body_moments, wall_area
from parts.base.texts import fault, unless

# heights of walls are told apart by so many digits
_DIGITS = 6


def verify_solid(found: ReadSolid, body: Body, declared: float, tolerance: float) -> Verdict:
    """Hold a re-read solid against its exact body: caps, walls, cylinders, volume."""
    model = found.model
    exact = body_moments(body).volume
    bound = volume_bound(exact, float(model.area.sum()), wall_area(body), declared)
    reach = max(p.reach() for p in body.profiles)
    told = told_verdict(found, exact, bound, body.precision)
    failures = [*_cylinder_failures(int(told.measured["cylinders"]), body), *told.failures, *copy_failures(model, body)]
    flat = (model.kind == PLANE) & (np.abs(model.frames.axes[:, 2, 2]) > 1 - SQUARE)
    sheared = body.has_screws() and not body.twisted_profiles()
    upright = model.is_upright & ~flat & (not sheared)
    if body.twisted_profiles():
        upright &= ~_between_helices(model)
    beside = upright & _beside_chamfers(model, body)
    contours, worst, found_wrong = _caps(model, np.flatnonzero(flat), body, declared, tolerance)
    failures += found_wrong
    # an extrusion of an edge between it and a cap is as good as that edge
    known = np.isin(model.moved, model.uses.edge[flat[model.uses.face]])
    deviation, found_wrong = _wall_deviation(model, np.flatnonzero(upright & ~known & ~beside), body, declared)
    failures += found_wrong
    # round walls of crowned teeth stand upright between ends of their own
    if beside.any():
        points = np.concatenate([of(model, np.flatnonzero(beside)) for of in (edge_points, inner_points)])
        off = np.minimum(
            chamfer_distances(points, body, declared),
            wall_distances(points, body, filter(body.is_upright, body.walls), declared),
        )
        deviation = max(deviation, float(off.max()))
    slanted = np.flatnonzero(~flat & ~upright)
    worst = max(worst, deviation)
    if slanted.size:
        points = np.concatenate([edge_points(model, slanted), inner_points(model, slanted)])
        off = np.minimum(
            wall_distances(points, body, filter(body.is_screw, body.walls), declared),
            chamfer_distances(points, body, declared),
        )
        worst = max(worst, float(off.max()))
    failures += unless(slanted.size or not body.has_screws(), "the solid has no screw surface")
    failures += deviation_failures(worst, declared, tolerance, reach)
    measured = told.measured | {"contours": float(contours), "max_deviation": worst}
    return Verdict(measured, tuple(dict.fromkeys(failures)))


def wall_distances(points: Real, body: Body, walls: Iterable[Wall], declared: float) -> Real:
    """Distances (n,) of points (n, 3) from upright walls or screw surfaces, each within the plane of its own height.

    mm; infinite where none stands at a point's height.
    """
    best = np.full(len(points), np.inf)
    for wall in walls:
        low, high = body.height(wall)
        mine = np.flatnonzero((points[:, 2] > low - LEVEL) & (points[:, 2] < high + LEVEL))
        back = body.moved_back(wall, points[mine])
        found = distance_to_profile(back, body.loop_profile(wall.lower), trusted=declared)
        best[mine] = np.minimum(best[mine], found)
    return best


def _beside_chamfers(model: Model, body: Body) -> Flags:
    """Which faces have their middle at the height of a chamfer."""
    low, high = model.heights
    middle, found = (low + high) / 2, np.zeros(len(model.faces), dtype=bool)
    for bottom, top in map(body.height, filter(body.is_chamfer, body.walls)):
        found |= (bottom < middle) & (middle < top)
    return found


def _caps(model: Model, faces: Index, body: Body, declared: float, tolerance: float) -> tuple[int, float, list[str]]:
    """How many bounds the faces across the axis have, their deviation from the profiles there, and what is wrong."""
    expected: dict[tuple[float, bool], list[Profile]] = {}
    for cap in body.caps:
        loops = (cap.outer, *cap.holes)
        expected.setdefault((body.loops[cap.outer].z, cap.up), []).extend(
            body.loop_profile(i).placed(body.loops[i].placement) for i in loops
        )
    found: dict[tuple[float, bool], list[int]] = {}
    up = (model.frames.axes[:, 2, 2] > 0) == model.normal
    for face in faces.tolist():
        z = float(model.frames.origins[face, 2])
        level = min(expected, key=lambda known: abs(known[0] - z))[0]
        found.setdefault((level if abs(level - z) <= LEVEL else z, bool(up[face])), []).append(face)
    if found.keys() != expected.keys():
        told = ", ".join(f"{z:.9g} mm {'up' if upwards else 'down'}" for z, upwards in sorted(found))
        return 0, 0.0, [f"plane faces at {told or 'no height'} instead of {len(expected)} others"]
    contours, worst, failures = 0, 0.0, list[str]()
    for key, profiles in expected.items():
        bounds, areas = _loops(model, np.array(found[key]))
        verdict = verify_samples(bounds, profiles, declared, tolerance, areas)
        worst = max(worst, verdict.measured.get("max_deviation", 0.0))
        contours += int(verdict.measured["contours"])
        failures += verdict.failures
    return contours, worst, failures


def _loops(model: Model, faces: Index) -> tuple[list[Complex], list[float]]:
    """Points of the bounds of faces across the axis, one loop behind the other, and what each encloses, mm^2."""
    mine = np.flatnonzero(np.isin(model.uses.face, faces))
    along = model.uses.along[mine]
    span, row = spans_of(model.curves, model.uses.edge[mine], along)
    points, slopes = (x[span, :, 0] + 1j * x[span, :, 1] for x in (model.points, model.slopes))
    shares = np.where(along[row], 0.5, -0.5) * ((np.conj(points) * slopes).imag @ lobatto()[1])
    points = np.where(along[row][:, None], points, points[:, ::-1])
    begin = np.flatnonzero(np.diff(model.uses.loop[mine][row], prepend=-1))
    pieces = np.split(points[:, :-1], begin[1:])
    return [piece.ravel() for piece in pieces], np.add.reduceat(shares, begin).tolist()


def _wall_deviation(model: Model, walls: Index, body: Body, declared: float) -> tuple[float, list[str]]:
    """Greatest distance of upright walls from the profiles of those at their height."""
    if not walls.size:
        return 0.0, []
    points, face = foot_points(model, walls)
    low, high = model.heights
    heights = np.round((low + high)[face] / 2, _DIGITS)
    worst, failures = 0.0, list[str]()
    for z in np.unique(heights).tolist():
        profiles = [body.loop_profile(w.lower) for w in body.walls if _stands(body, w, z)]
        if not profiles:
            failures.append(fault("a wall stands at z = {z:.9g} mm, where there is none", z=z))
            continue
        mine = points[heights == z]
        places = (mine[..., 0] + 1j * mine[..., 1]).ravel()
        worst = max(worst, float(distance_to_nearest(places, profiles, declared).max()))
    return worst, failures


def _stands(body: Body, wall: Wall, z: float) -> bool:
    low, high = body.height(wall)
    return body.is_upright(wall) and low < z < high


def _between_helices(model: Model) -> Flags:
    """Which faces have an edge that neither stands upright nor lies across the axis."""
    span, use = model.spans
    reach = np.ptp(model.points[span], axis=1)
    found = np.zeros(len(model.faces), dtype=bool)
    found[model.uses.face[use[(reach[:, 2] > LEVEL) & (reach[:, :2].max(axis=1) > LEVEL)]]] = True
    return found


def _cylinder_failures(cylinders: int, body: Body) -> list[str]:
    """All arcs have become cylinders; screw surfaces and crowned teeth may be cut across into several."""
    upright = sum(_cylinders(body.loop_profile(w.lower)) for w in filter(body.is_upright, body.walls))
    cut = [_cylinders(body.loop_profile(w.lower), turned=True) for w in filter(body.is_screw, body.walls)]
    cut += [_kept_arcs(body, w) for w in filter(body.is_chamfer, body.walls)]
    turned, more = sum(cut), cylinders - upright
    # each wall into as many as it needs
    right = more == turned or (more > turned > 0 and (more - turned) % math.gcd(*cut) == 0)
    return unless(right, "{count} cylinders instead of {wanted}", count=cylinders, wanted=upright + turned)


def _kept_arcs(body: Body, wall: Wall) -> int:
    """How many arcs about the axis a chamfer has that are as wide at both ends, as those of crowned teeth."""
    ends = [body.loop_profile(loop) for loop in (wall.lower, wall.upper)]
    pairs = [(a.curve, b.curve) for a, b in zip(*(end.period for end in ends), strict=True)]
    arcs = [(a, b) for a, b in pairs if isinstance(a, Arc) and isinstance(b, Arc) and not (a.centre or b.centre)]
    return sum(abs(a.radius - b.radius) < 10.0**-_DIGITS for a, b in arcs) * ends[0].count


def _cylinders(profile: Profile, *, turned: bool = False) -> int:
    """How many cylinders stand on a profile; a full circle is one. A ``turned`` one has those about the axis only."""
    arcs = [s.curve for s in profile.period if isinstance(s.curve, Arc) and not (turned and s.curve.centre)]
    whole = profile.count == 1 and len(arcs) == len(profile.period) and len({(a.centre, a.radius) for a in arcs}) == 1
    return 1 if whole else len(arcs) * profile.count

"""Views of parts against meshes of the same parts: lines lie on edges, hatching on what is cut, sizes at lines."""

from __future__ import annotations

import math
from functools import cache
from typing import Any

import numpy as np
import pytest
import shapely

from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.line_arc import Arc, Line
from parts.drawing.working import HIDDEN, VISIBLE, PartDrawing, View
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.mesh import body_mesh, mesh_outlines
from tests.parts.drawing.test_sections import bolt, drawing_of
from tests.parts.solids.test_every_kind import MADE

# mm: what a mesh leaves out at edges, and how far lines may stand off them; faces that meet more sharply have an edge
NEAR, OFF, SHARP = 0.02, 0.06, math.radians(12.0)
X, Y, Z = np.eye(3)
# right and up of a view as directions of the part; a shaft shows its first keyway, which points along y
ALONG, SIDE, FACE, ACROSS = (Z, Y), (Z, X), (X, Y), (Y, -X)
Frame = tuple[np.ndarray, np.ndarray]

KEYED_SHAFT: dict[str, Any] = {"kind": "shaft", "bore_diameter": 8.0, "steps": [
    {"diameter": 20.0, "length": 30.0, "chamfer": 1.0, "keyways": [{"at": 4.0, "length": 12.0, "ends": "square"}]},
    {"diameter": 28.0, "length": 25.0, "fillet": 1.0, "keyways": [
        {"at": 4.0, "length": 14.0, "angle_deg": 30.0, "ends": "square"},
        {"at": 6.0, "length": 10.0, "angle_deg": -90.0, "ends": "square"}]},
    {"diameter": 22.0, "length": 12.0, "grooves": [{"at": 3.0, "width": 2.0, "diameter": 20.0}]}]}  # fmt: skip
DISK: dict[str, Any] = {"kind": "turned", "points": [
    {"r": r, "z": z} for r, z in ((10.0, 0.0), (60.0, 0.0), (60.0, 10.0), (30.0, 10.0), (30.0, 16.0), (10.0, 16.0))],
    "holes": [{"count": 2, "diameter": 6.0, "pitch_circle_diameter": 90.0, "start_deg": 90.0},
              {"count": 1, "diameter": 5.0, "pitch_circle_diameter": 40.0, "start_deg": -90.0}]}  # fmt: skip
PARTS: dict[str, dict[str, Any]] = {
    "hollow": KEYED_SHAFT, "disk": DISK,
    "bolt": bolt(20.0), "hollow bolt": bolt(20.0, 4.0),
    "bored cam": MADE["drawn cam"] | {"bore": {"shape": "keyway", "diameter": 12.0, "angle_deg": 200.0}},
    **MADE,
}  # fmt: skip

# frames of the views of each; between which radii teeth are drawn as tips and roots, or a hole is drawn as it is not
VIEWS: dict[str, tuple[list[Frame | None], tuple[float, float]]] = {
    "hollow": ([ALONG, FACE, None, None], (99, 99)), "disk": ([ALONG, FACE], (99, 99)),
    "bolt": ([ALONG, FACE, FACE], (99, 99)), "hollow bolt": ([ALONG, FACE, FACE], (99, 99)),
    "bored cam": ([ALONG, FACE, None], (99, 99)),
    "drawn gear": ([ALONG, FACE, FACE], (37.0, 99)), "drawn ring": ([SIDE, FACE], (38.0, 43)),
    "drawn helical": ([ALONG, FACE], (23.0, 99)), "double": ([ALONG, FACE, FACE], (23.5, 99)),
    "square": ([ALONG, FACE, FACE], (21.0, 99)), "spoked": ([ALONG, FACE, FACE], (47.0, 99)),
    "drawn wheel": ([SIDE, FACE], (55.0, 99)), "drawn cam": ([ALONG, FACE, FACE], (99, 99)),
    "drawn groove": ([ALONG, FACE, FACE], (99, 99)), "drawn oval": ([ALONG, FACE], (99, 99)),
    "drawn disc": ([SIDE, FACE], (40.0, 50.0)), "drawn pin": ([SIDE], (99, 99)),
    "drawn eccentric": ([ALONG, FACE], (99, 99)), "drawn lantern": ([SIDE, FACE], (99, 99)),
    "drawn pin ring": ([SIDE, FACE], (39.9, 40.1)), "holes with a wall": ([SIDE, FACE], (99, 99)),
    "plate of pins": ([SIDE, FACE], (99, 99)), "plate with seats": ([SIDE, FACE], (99, 99)),
    "drawn barrel": ([SIDE, None], (99, 99)), "drawn box": ([ALONG, FACE, FACE], (99, 99)),
    "drawn plate": ([FACE], (99, 99)), "drawn carrier": ([FACE], (99, 99)), "drawn bearing": ([SIDE], (99, 99)),
    "drawn shaft": ([SIDE, None, ACROSS], (99, 99)), "turned spindle": ([SIDE, None, ACROSS], (99, 99)),
    "cover": ([SIDE, FACE], (99, 99)), "grooved": ([SIDE, None], (99, 99)),
    **{f"turned {name}": ([SIDE], (99, 99)) for name in ("grooves", "countersink", "both_sides", "tube")},
}  # fmt: skip


@cache
def drawn(name: str) -> tuple[PartDrawing, np.ndarray, np.ndarray]:
    """The drawing of a part; vertices and triangles of its mesh."""
    part = make_parts(scene_from_dict({"parts": {"p": PARTS[name]}}, "t", "t"), "t")[0]["p"]
    body = part.body(0.0)
    mesh = body_mesh(body, mesh_outlines(body, NEAR, 0.0))
    return drawing_of(PARTS[name]), mesh.vertices.astype(float), mesh.triangles.astype(np.int64)


def edges(vertices: np.ndarray, triangles: np.ndarray, frame: Frame) -> np.ndarray:
    """Both ends of each edge that a view may show: sharp ones, and those where the surface turns away."""
    corners = vertices[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    ends = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    order = np.lexsort((ends[:, 1], ends[:, 0]))
    one, two = (np.tile(np.arange(len(triangles)), 3)[order][k::2] for k in (0, 1))
    away = (normals[one] @ np.cross(*frame)) * (normals[two] @ np.cross(*frame)) <= 1e-9
    shown = away | (np.einsum("ij,ij->i", normals[one], normals[two]) < math.cos(SHARP))
    return on_paper(vertices, frame)[ends[order][::2][shown]]


def cut(vertices: np.ndarray, triangles: np.ndarray, frame: Frame) -> np.ndarray:
    """Both ends of each piece of the section of a mesh by the view's plane through the origin."""
    height, paper = vertices @ np.cross(*frame) - 1e-7, on_paper(vertices, frame)
    over = height[triangles] > 0
    crossed = (over.sum(1) % 3) > 0
    triangles, over = triangles[crossed], over[crossed]
    alone = np.where(over.sum(1) == 1, over.argmax(1), (~over).argmax(1))
    rows, pieces = np.arange(len(triangles)), []
    for k in (1, 2):
        a, b = triangles[rows, alone], triangles[rows, (alone + k) % 3]
        pieces.append(paper[a] + (paper[b] - paper[a]) * height[a] / (height[a] - height[b]))
    return np.stack(pieces, axis=1)


def on_paper(points: np.ndarray, frame: Frame) -> np.ndarray:
    return points @ frame[0] + 1j * (points @ frame[1])


def off(pieces: np.ndarray, points: np.ndarray) -> np.ndarray:
    """How far points stand off the nearest of straight pieces."""
    lines = shapely.linestrings(np.stack([pieces.real, pieces.imag], axis=-1))
    tree = shapely.STRtree(lines[shapely.length(lines) > 1e-9])
    found = tree.query_nearest(shapely.points(points.real, points.imag), return_distance=True, all_matches=False)[1]
    return np.asarray(found)


def chords(view: View, *layers: str) -> np.ndarray:
    points = [c.point(np.linspace(*c.domain, 2 if isinstance(c, Line) else 65)) for layer, c in view.strokes
              if not layers or layer in layers]  # fmt: skip
    return np.concatenate([np.stack([p[:-1], p[1:]], axis=1) for p in points])


def inside(pieces: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Which points the pieces enclose: those from which a ray to the right crosses an odd number of them."""
    a, b = pieces.T
    crosses = (a.imag > points.imag[:, None]) != (b.imag > points.imag[:, None])
    rise = np.where(a.imag == b.imag, 1.0, b.imag - a.imag)
    at = a.real + (b.real - a.real) * (points.imag[:, None] - a.imag) / rise
    return (crosses & (at > points.real[:, None])).sum(axis=1) % 2 == 1


def judged(
    view: View, vertices: np.ndarray, triangles: np.ndarray, frame: Frame, teeth: tuple[float, float]
) -> list[str]:
    """What of a view does not agree with the part."""
    along = frame[0] is Z

    def told(points: np.ndarray) -> np.ndarray:
        radius = np.abs(points.imag) if along else np.abs(points)
        return np.asarray((radius < teeth[0]) | (radius > teeth[1]))

    section, lines = cut(vertices, triangles, frame), chords(view)
    known = np.concatenate([edges(vertices, triangles, frame), section]) if along else edges(vertices, triangles, frame)
    points = np.concatenate([
        c.point(np.linspace(*c.domain, 17)) for layer, c in view.strokes if layer in (VISIBLE, HIDDEN)])  # fmt: skip
    faults = [f"a line off every edge at {p:.3f}" for p in points[told(points) & (off(known, points) > OFF)]]
    if view.hatched:
        loops = np.concatenate([chords(View(tuple((VISIBLE, c) for c in loop))) for loop in view.hatched])
        if along:
            middles = section.mean(axis=1)
            faults += [f"no line at {p:.3f}" for p in middles[told(middles) & (off(lines, middles) > OFF)]]
            low, high = (end(section.real) + 1j * end(section.imag) for end in (np.min, np.max))
            grid = np.random.default_rng(1).uniform(size=(200, 2)) @ np.diag([(high - low).real, (high - low).imag])
            grid = low + grid[:, 0] + 1j * grid[:, 1]
            grid = grid[told(grid) & (off(section, grid) > 2 * OFF)]
            wrong = grid[inside(section, grid) != inside(loops, grid)]
            faults += [f"hatched though it is not cut, or cut and not hatched, at {p:.3f}" for p in wrong]
    # an extension line begins where something is: at corners that are rounded away by one coordinate
    ends = np.concatenate([lines.ravel(), *(np.array([a.start, a.end]) for a in view.axes), *(
        c.centre + c.radius * np.array([1, -1, 1j, -1j]) for _, c in view.strokes if isinstance(c, Arc))])  # fmt: skip
    for size in view.sizes:
        upright = size.side in ("left", "right")
        for point in (size.start, size.end):
            gaps = np.abs((ends - point).imag if upright else (ends - point).real)
            centres = [r.centre for r in view.rounds] + [0j]
            reach = [abs((c - point).imag if upright else (c - point).real) for c in centres]
            if min(gaps.min(), *reach) > 1e-6:
                faults.append(f"{size.name} is measured from nothing at {point:.3f}")
    return faults


@pytest.mark.sampled(18)
@pytest.mark.parametrize("name", VIEWS)
def test_lines_lie_on_edges_and_what_is_cut_is_hatched(name: str) -> None:
    drawing, vertices, triangles = drawn(name)
    frames, teeth = VIEWS[name]
    assert len(drawing.views) == len(frames)
    for view, frame in zip(drawing.views, frames, strict=True):
        if frame is not None:
            assert judged(view, vertices, triangles, frame, teeth) == [], view.title


def test_a_line_beside_its_edge_and_a_bore_that_is_hatched_are_seen() -> None:
    drawing, vertices, triangles = drawn("disk")
    (section, face), ((along, across), teeth) = drawing.views, VIEWS["disk"]
    assert along is not None
    assert across is not None
    (layer, curve), *others = section.strokes
    for moved in (0.1, 0.1j):
        strokes = ((layer, curve.placed(Placement2(0.0, moved))), *others)
        assert judged(replace(section, strokes=strokes), vertices, triangles, along, teeth)
    assert judged(replace(section, strokes=tuple(others)), vertices, triangles, along, teeth)
    assert judged(replace(section, hatched=section.hatched[:1]), vertices, triangles, along, teeth)
    first, *rest = section.sizes
    assert judged(
        replace(section, sizes=(replace(first, end=first.end + 0.1 + 0.1j), *rest)), vertices, triangles, along, teeth
    )
    turned = tuple((name, one.placed(Placement2(0.1, 0j))) for name, one in face.strokes)
    assert judged(replace(face, strokes=turned), vertices, triangles, across, teeth)

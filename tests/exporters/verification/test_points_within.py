"""Places that are looked at within the faces of a read solid: on their surfaces, all over what they bound."""

from __future__ import annotations

import math
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.formats.read_solid import EXTRUSION, PLANE, Model
from exporters.formats.read_step import ReadSolid, read_step
from exporters.verification.samples import edge_points, foot_points, inner_points
from exporters.verification.solid import verify_solid
from geometry.plane.measure import distance_to_profile
from geometry.solids.body import Body
from parts.scene.load import make_parts, scene_from_dict
from parts.solids.faces import solid_curves, solid_faces
from parts.solids.step_text import StepForm, StepPart, step_text
from tests.exporters.verification.test_neighbours import body_of, said_of, solid_of

POINT = dict[str, float]


def turned(*points: POINT) -> dict[str, Any]:
    return {"kind": "turned", "points": list(points)}


# half sections r over z: a ball and a half one, a ring round its tube, a cone with its point, a flat disc with a hole
TURNED = {
    "ball": turned({"r": 0.0, "z": -4.0, "arc": 4.0}, {"r": 0.0, "z": 4.0}),
    "dome": turned({"r": 0.0, "z": 0.0}, {"r": 4.0, "z": 0.0, "arc": 4.0}, {"r": 0.0, "z": 4.0}),
    "tube": turned({"r": 6.0, "z": -2.0, "arc": 2.0}, {"r": 6.0, "z": 2.0, "arc": 2.0}),
    "cone": turned({"r": 0.0, "z": 0.0}, {"r": 5.0, "z": 0.0}, {"r": 0.0, "z": 7.0}),
    "frustum": turned({"r": 2.0, "z": 0.0}, {"r": 5.0, "z": 0.0}, {"r": 4.0, "z": 3.0}, {"r": 2.0, "z": 3.0}),
}


# a table of so few rows has as many surfaces, all of other knots
BARREL: dict[str, Any] = {
    "kind": "barrel_cam", "form": "end", "outer_diameter": 60.0, "groove_depth": 7.0, "roller_diameter": 10.0,
    "motion_table": [[0.0, 0.0], [50.0, 2.0], [120.0, 6.0], [200.0, 5.0], [290.0, 1.0]], "end_margin": 14.0,
}  # fmt: skip


@cache
def read(name: str) -> tuple[Model, Any]:
    """The model of a turned part's file, or of a barrel's, and its exact body."""
    import tempfile

    keys = TURNED.get(name, BARREL)
    body = make_parts(scene_from_dict({"parts": {"p": keys}}, "t", "t"), "t")[0]["p"].body(0.0)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "p.step"
        file.write_text(step_text(StepPart("p", solid_faces(body, solid_curves(body, 1e-6))), StepForm()), "ascii")
        return read_step(file).model, body


@pytest.mark.parametrize("name", TURNED)
def test_places_lie_in_their_faces_and_all_over_them(name: str) -> None:
    """None is off the exact surfaces or beyond its bounds; round the axis no gap is wider than a quarter of a turn."""
    model, body = read(name)
    for face in range(len(model.faces)):
        points = inner_points(model, np.array([face]))
        assert len(points) >= 30, face
        off = np.stack([surface.distance(points) for surface in body.surfaces])
        # the whole face is in one of them
        assert off.max(axis=1).min() < 1e-6
        low, high = (float(x[face]) for x in model.heights)
        if model.kind[face] == PLANE:
            assert points[:, 2] == pytest.approx(np.full(len(points), low), abs=1e-9)
        else:
            assert (points[:, 2] >= min(low, -4) - 1e-9).all()
            assert (points[:, 2] <= max(high, 4) + 1e-9).all()
        angles = np.sort(np.angle(points[:, 0] + 1j * points[:, 1]))
        gaps = np.append(np.diff(angles), angles[0] + math.tau - angles[-1])
        assert gaps.max() < math.tau / 4, face


def test_the_ends_of_a_ball_are_reached() -> None:
    """Two meridians bound it: lines across go all round, from near one pole to near the other."""
    model, _ = read("ball")
    points = np.concatenate([inner_points(model, np.array([face])) for face in range(len(model.faces))])
    assert np.linalg.norm(points, axis=1) == pytest.approx(np.full(len(points), 4.0), abs=1e-9)
    assert points[:, 2].min() < -2.5
    assert points[:, 2].max() > 2.5


def test_a_spline_face_is_looked_for_in_its_own_surface_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Before, in those of all faces: the square of a motion table's rows."""
    model, body = read("barrel")
    assert len(model.patches) >= 4
    asked, isin = [], np.isin

    def counted(these: Any, those: Any) -> Any:
        asked.append(these)
        return isin(these, those)

    monkeypatch.setattr(np, "isin", counted)
    for patches in model.patches:
        for face in patches.faces.tolist():
            points = inner_points(model, np.array([face]))
            assert min(float(np.abs(s.distance(points)).max()) for s in body.surfaces) < 1e-6
    assert len(asked) == sum(len(patches.faces) for patches in model.patches)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["hub", "chamfered", "plate"])
def test_walls_are_looked_at_over_their_feet_and_between_their_copies(name: str) -> None:
    """Extrusions of flanks: six heights over each node, from one end to the other; feet on the profile."""
    solid, body = solid_of(name), body_of(name)
    model = solid.model
    walls = np.flatnonzero(model.is_upright & (np.abs(model.frames.axes[:, 2, 2]) * (model.kind == PLANE) < 0.5))
    swept = walls[model.kind[walls] == EXTRUSION]
    assert (name == "plate") is not bool(len(swept))
    profiles = [body.loop_profile(wall.lower) for wall in body.walls if body.is_upright(wall)]
    for face in swept[:6].tolist():
        points = inner_points(model, np.array([face]))
        flat = points[:, 0] + 1j * points[:, 1]
        low, high = (float(x[face]) for x in model.heights)
        off = np.min([distance_to_profile(flat, p, trusted=np.inf) for p in profiles], axis=0)
        assert off.max() < 1e-6
        heights = np.unique(np.round(points[:, 2], 9))
        assert len(heights) == 6
        assert (heights[0], heights[-1]) == pytest.approx((low, high), abs=1e-9)
        # as often at each
        assert len(set(np.unique(np.round(points[:, 2], 9), return_counts=True)[1].tolist())) == 1
    at, faces = foot_points(model, walls)
    assert set(faces.tolist()) == set(walls.tolist())
    for profile_free in at.reshape(-1, 3)[:: max(1, len(at) // 8)]:
        flat = np.array([profile_free[0] + 1j * profile_free[1]])
        assert min(float(distance_to_profile(flat, p, trusted=np.inf)[0]) for p in profiles) < 1e-6


def test_edges_are_looked_at_all_along_where_they_lie_level() -> None:
    """Of each level edge twelve places, of others six; those of one face alone."""
    model = solid_of("plate").model
    cap = int(np.flatnonzero((model.kind == PLANE) & (np.abs(model.frames.axes[:, 2, 2]) > 0.5))[0])
    points = edge_points(model, np.array([cap]))
    assert len(points) % 12 == 0
    assert np.ptp(points[:, 2]) < 1e-12
    x, y = points[:, 0], points[:, 1]
    on_box = np.isclose(np.abs(x), 10) | np.isclose(np.abs(y), 6)
    on_hole = np.isclose(np.hypot(x - 3, y - 1), 2)
    assert (on_box | on_hole).all()
    assert on_box.sum() == 4 * 12
    side = int(np.flatnonzero((model.kind == PLANE) & (np.abs(model.frames.axes[:, 2, 2]) < 0.5))[0])
    assert len(edge_points(model, np.array([side]))) == 2 * 12 + 2 * 6


def test_what_a_solid_lacks_or_has_too_much_is_told() -> None:
    """A gear without a helix, and a hub where there is none."""
    assert "the solid has no screw surface" in said_of(solid_judge, solid_of("hub"), body_of("screw"), 1e-6)
    straight = body_of("hub", ("hub", None))
    assert "a wall stands at z = 2 mm, where there is none" in said_of(solid_judge, solid_of("hub"), straight, 1e-6)


def solid_judge(found: ReadSolid, body: Body, declared: float, tolerance: float) -> Any:
    return verify_solid(found, body, declared, tolerance)

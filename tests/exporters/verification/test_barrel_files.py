"""Files of cylindrical cams: read back, the roller put into the groove, and spoiled meshes and solids seen."""

from __future__ import annotations

import contextlib
import random
from collections.abc import Sequence
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from exporters.formats.read_step import read_step
from exporters.formats.read_stl import read_stl
from exporters.formats.readback import Loop, ReadMesh, ReadOutlines
from exporters.formats.reading import READERS
from exporters.formats.step import write_step
from exporters.formats.stl import write_stl
from exporters.production.recheck import recheck
from exporters.verification.faces import verify_faced_mesh
from exporters.verification.judge import held, probed
from exporters.verification.verdict import Verdict
from geometry.base.record import replace
from geometry.cams.barrel.body import BarrelBody, Plane, Track
from geometry.cams.barrel.cam import LOWER, UPPER
from geometry.cams.barrel.faces import barrel_faces
from geometry.cams.barrel.rolling import rolled_places, wall_height
from geometry.cams.motion.follower_motion import TURN
from geometry.plane.contour import edge_points
from parts.base.refusal import SceneError
from parts.cams.barrel_cam.probe import walls_of
from parts.scene.formats import FILE_KINDS
from parts.solids.faces import solid_curves, solid_faces
from parts.solids.mesh import Mesh, body_mesh, mesh_outlines
from parts.solids.step_text import StepForm, StepPart
from tests.exporters.making import read_report, run
from tests.parts.cams.barrel_cam.test_barrel_cam import CONE, END, GROOVE, SWING, body_of, part_of
from tests.parts.cams.disk_cam.test_cam import scene_text
from tests.sampling import some_of

FORMS = {"groove": GROOVE | {"clearance": 0.2, "bore": {"shape": "keyway", "diameter": 12.0},
                             "hub": {"diameter": 24.0, "above": 4.0, "below": 2.0}},
         "end": END | {"bore_diameter": 10.0}, "tube": END | {"web_thickness": 0.0}, "swing": SWING,
         "cone": CONE, "cone end": END | {"roller_form": "conical"}}  # fmt: skip
TOLERANCE = 0.2
# angles at which the roller is put in
COUNT = 240
faced = cache(barrel_faces)


def mesh_of(body: BarrelBody, tolerance: float = TOLERANCE) -> tuple[ReadMesh, float]:
    exact = faced(body)
    outlines = mesh_outlines(exact, tolerance, 0.0)
    made = body_mesh(exact, outlines)
    # vertices stand on a grid
    return ReadMesh(made.vertices, made.triangles), outlines[0].max_error + 1e-8 * body.cam.outer


@cache
def formed(name: str) -> tuple[BarrelBody, ReadMesh, float]:
    """One of the forms, its mesh and the error that is told of it, made once."""
    body = body_of(FORMS[name])
    return body, *mesh_of(body)


def verdict(mesh: ReadMesh, body: BarrelBody, error: float) -> Verdict:
    return verify_faced_mesh(mesh, faced(body), error, TOLERANCE)


def away_from_triangles(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Distance of each point from the nearest triangle: to its plane inside, to its edges outside."""
    found = []
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    for point in points:
        rest = point - corners
        height = (rest[:, 0] * normal).sum(axis=1)
        inside, best = np.ones(len(corners), dtype=bool), np.full(len(corners), np.inf)
        for k in range(3):
            edge = corners[:, (k + 1) % 3] - corners[:, k]
            inside &= (np.cross(edge, rest[:, k]) * normal).sum(axis=1) >= 0
            share = np.clip((edge * rest[:, k]).sum(axis=1) / (edge**2).sum(axis=1), 0, 1)
            best = np.minimum(best, np.linalg.norm(rest[:, k] - share[:, None] * edge, axis=1))
        found.append(np.where(inside, np.abs(height), best).min())
    return np.array(found)


@pytest.mark.heavy
@pytest.mark.parametrize("name", FORMS)
def test_meshes_are_closed_and_near_by_an_outside_measure(name: str) -> None:
    import trimesh

    body, mesh, error = formed(name)
    solid = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    assert solid.is_watertight
    assert solid.is_winding_consistent
    assert not verdict(mesh, body, error).failures
    # points of the walls by brute force stand on the mesh
    angles = np.linspace(0, TURN, 19)
    for side in body.cam.sides:
        for radius in (body.cam.inner, (body.cam.inner + body.cam.outer) / 2, body.cam.outer):
            points = body.cam.wall(angles, side, radius)
            assert away_from_triangles(points, mesh.vertices[mesh.triangles]).max() <= error


def test_spoiled_walls_are_seen_at_the_start_the_middle_and_the_end() -> None:
    body, mesh, error = formed("groove")
    walls = [face for face in body.faces() if isinstance(face, Track)]
    first, second = (np.flatnonzero(wall.distance(body.cam, mesh.vertices) < 1e-6) for wall in walls)
    for pick in (first[0], second[len(second) // 2], first[-1]):
        vertices = mesh.vertices.copy()
        vertices[pick, 2] += 2.5 * error
        assert any("deviates" in f for f in verdict(ReadMesh(vertices, mesh.triangles), body, error).failures)


def test_missing_triangles_and_faces_are_seen() -> None:
    body, mesh, error = formed("groove")
    for k in some_of((0, len(mesh.triangles) // 2, len(mesh.triangles) - 1)):
        holed = ReadMesh(mesh.vertices, np.delete(mesh.triangles, k, axis=0))
        assert "not closed" in verdict(holed, body, error).failures[0]
    bare = replace(body, hub=None)
    assert any("face" in f or "deviates" in f for f in verdict(mesh_of(bare)[0], body, error).failures)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("change", [{"lift": 19.0}, {"groove_depth": 7.9}, {}])
def test_the_mesh_of_another_cam_is_seen(change: dict[str, object]) -> None:
    """Of another lift, another groove, another length; all else is the same."""
    body, mesh, error = formed("groove")
    length = body.length if change else body.length + 0.2
    assert verdict(mesh, body_of(FORMS["groove"] | {"length": length} | change), error).failures


def test_the_roller_in_the_groove_feels_the_walls() -> None:
    """Heights by the mesh agree with the exact ones; a wall lifted by d lifts the roller by d."""
    body, mesh, error = formed("groove")
    cam = body.cam
    axis = cam.place(np.arange(COUNT) * TURN / COUNT, 0)[0].imag
    walls = walls_of(mesh.faces(), body)
    found, smaller = (rolled_places(replace(cam, radius=r), walls, COUNT) for r in (cam.radius, cam.radius - 0.5))
    for side in (UPPER, LOWER):
        assert np.abs(found[side] - axis).max() < 1.5 * error
    # half a mm of play on each side in a dwell, more on slopes
    play = smaller[UPPER] - smaller[LOWER]
    assert play.min() > 1.0 - 2 * error
    assert play[COUNT * 150 // 360] == pytest.approx(1.0, abs=2 * error)
    assert play.max() > 1.05
    away = next(f for f in body.faces() if isinstance(f, Track) and f.side == LOWER).distance(cam, mesh.vertices)
    vertices = mesh.vertices.copy()
    vertices[away < 1e-6, 2] += 0.3
    lifted = rolled_places(cam, walls_of(vertices[mesh.triangles], body), COUNT)
    assert np.abs(lifted[LOWER] - found[LOWER] - 0.3).max() < 1e-9
    assert np.array_equal(lifted[UPPER], found[UPPER])


def steep(lift: float = 40.0, angle: float = 120.0, **other: object) -> dict[str, object]:
    """A drum of 60 mm whose groove is steep: a roller of 4 mm lifted by 40 in 120 degrees has 60 of pressure angle."""
    rest = {"move": "dwell", "angle_deg": 180.0 - angle}
    moves = ({"move": move, "angle_deg": angle, "law": "sine"} for move in ("rise", "return_"))
    keys = GROOVE | {"roller_diameter": 4.0, "lift": lift, "phases": [x for m in moves for x in (m, rest)]} | other
    return {key: value for key, value in keys.items() if key != "lift" or "oscillating" not in other}


def swinging(**table: float) -> dict[str, object]:
    return {"swing_deg": 50.0, "oscillating": {"arm_length": 50.0, **table}}


STEEP = {"as told": steep(), "mild": steep(20.0), "steeper": steep(angle=90.0), "play": steep(clearance=0.1),
         "shallow": steep(groove_depth=3.0), "deep": steep(groove_depth=15.0),
         "large roller": steep(roller_diameter=8.0),
         "large drum": steep(80.0, outer_diameter=120.0), "swing": steep(**swinging()),
         "swing away": steep(**swinging(pivot_offset=-45.0)), "steep swing": steep(angle=80.0, **swinging()),
         "cone": steep(roller_form="conical"), "cone of its own": steep(roller_form="conical", cone_angle_deg=20.0),
         "end": steep(form="end"), "cone end": steep(form="end", roller_form="conical", cone_angle_deg=20.0),
         "hub as wide as the floor": steep(hub={"diameter": 43.0, "above": 3.0})}  # fmt: skip


def sections(corners: np.ndarray, body: BarrelBody, angles: np.ndarray, depths: Sequence[float]) -> float:
    """The greatest error of the roller's place by brute force: sections at each depth, circles on all edges."""
    cam, worst = body.cam, 0.0
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    turn, up = corners[..., 0] + 1j * corners[..., 1], normal[:, 2] / np.linalg.norm(normal, axis=1)
    inside = (np.abs(turn).max(axis=1) < cam.outer + 1e-4) & (np.abs(turn).min(axis=1) > 0.99 * cam.inner)
    inside &= (np.ptp(np.abs(turn), axis=1) > 1e-3) & (np.abs(up) > 1e-3)
    for face in (f for f in body.faces() if isinstance(f, Plane)):
        inside &= np.abs(corners[..., 2] - face.outer.z).max(axis=1) > 1e-4
    turn, z, up = turn[inside], corners[inside][..., 2], up[inside]
    for angle in angles:
        place, fixed = complex(cam.place(angle, 0)[0]), turn * np.exp(1j * angle)
        for x in depths:
            radius = float(cam.radius_at(x))
            over = fixed.real - x
            cut = (over.min(axis=1) < 0) & (over.max(axis=1) >= 0) & (fixed.real.min(axis=1) > 0)
            ends = np.full((int(cut.sum()), 3), np.nan, dtype=complex)
            for k, (i, j) in enumerate(((0, 1), (1, 2), (2, 0))):
                a, b = over[cut][:, i], over[cut][:, j]
                share = np.where((a < 0) != (b < 0), a / np.where(a == b, 1.0, a - b), np.nan)
                p, q = (fixed[cut][:, n].imag + 1j * z[cut][:, n] for n in (i, j))
                ends[:, k] = p + share * (q - p)
            ends = np.array([row[~np.isnan(row)] for row in ends])
            way = ends[:, 1:] - ends[:, :1]
            for side in cam.sides:
                # the circle touches an edge at one of its ends or where both are as steep
                with np.errstate(divide="ignore", invalid="ignore"):
                    steep = -side * radius * np.sign(way.real) * way.imag / np.abs(way)
                    share = np.clip((place.real + steep - ends[:, :1].real) / way.real, 0, 1)
                points = np.hstack([ends, ends[:, :1] + share * way]) - place
                mine = up[cut] * side < 0
                room = np.sqrt(np.where(np.abs(points.real) < radius, radius**2 - points.real**2, np.nan))
                error, across = room[mine] - side * points[mine].imag, points[mine].real + place.real
                k = int(np.nanargmax(error)) if np.isfinite(error).any() else 0
                # where the floor's or the outer cylinder cuts the wall off the roller does not touch it at this depth
                if np.isfinite(error).any() and 1.0005 * cam.inner < np.hypot(x, across.flat[k]) < 0.995 * cam.outer:
                    worst = max(worst, abs(float(error.flat[k])))
    return worst


def probed_mesh(keys: dict[str, object], mesh: ReadMesh, error: float) -> Verdict:
    return probed(mesh, part_of(keys), 0.0, error, Verdict({}, ()))


@pytest.mark.parametrize("name", [n if n == "cone end" else pytest.param(n, marks=pytest.mark.heavy) for n in STEEP])
def test_steep_grooves_are_not_refused_and_spoiled_ones_are(name: str) -> None:
    """Of any steepness; the error that is told holds at every depth and is near to the greatest one."""
    keys = STEEP[name]
    body = body_of(keys)
    mesh, error = mesh_of(body, 0.1)
    good = probed_mesh(keys, mesh, error)
    assert good.failures == ()
    told, cam = good.measured["lift_error"], body.cam
    at = wall_height(cam, walls_of(mesh.faces(), body), 0.0)
    depths = [at.depth, *np.linspace(cam.inner, cam.outer, 6)[1:-1].tolist()]
    truth = sections(mesh.faces(), body, at.angle + np.array([-0.3, -0.01, 0.0, 0.01, 2.0]), depths)
    assert 0.9 * told < truth < told
    # a wall a tenth of the roller too high, one corner in the middle of a wall too low
    for side, way in ((LOWER, 0.4), (cam.sides[0], -0.4)):
        wall = next(f for f in body.faces() if isinstance(f, Track) and f.side == side)
        mine, vertices = np.flatnonzero(wall.distance(body.cam, mesh.vertices) < 1e-6), mesh.vertices.copy()
        vertices[mine if way > 0 else mine[len(mine) // 2], 2] += way
        bad = probed_mesh(keys, ReadMesh(vertices, mesh.triangles), error)
        assert "the roller's place is wrong by 0." in bad.failures[0]


@pytest.mark.heavy
@pytest.mark.parametrize("seed", range(40))
def test_the_error_that_is_told_holds_at_every_depth(seed: int) -> None:
    rng = random.Random(1000 + seed)
    while True:
        keys = random_cam(rng)
        with contextlib.suppress(SceneError):
            body = body_of(keys)
            break
    exact = barrel_faces(body)
    outlines = mesh_outlines(exact, 2e-3 * body.cam.outer, 0.0)
    made, cam = body_mesh(exact, outlines), body.cam
    mesh = ReadMesh(made.vertices, made.triangles)
    good = probed_mesh(keys, mesh, outlines[0].max_error)
    assert good.failures == ()
    angles = np.random.default_rng(seed).uniform(0, TURN, 40)
    truth = sections(mesh.faces(), body, angles, np.linspace(cam.inner, cam.outer, 25)[1:-1].tolist())
    assert truth <= good.measured["lift_error"]


FLAT = {"end": "kerf = 0.2", "groove": "offset = -0.1", "swing": "offset = -0.1", "as told": "kerf = 0.2",
        "steep swing": "kerf = 0.2", "cone": "offset = -0.1"}  # fmt: skip


def rested(loop: Loop, body: BarrelBody, side: int, angles: np.ndarray) -> np.ndarray:
    """How far an unrolled outline moves the roller off its place, by brute force: its points wound about the drum."""
    cam = body.cam
    share = np.linspace(0, 1, 600, endpoint=False)
    sheet = edge_points(loop.vertices, np.roll(loop.vertices, -1), loop.bulges, share).ravel()
    found = []
    for angle in angles:
        place, fixed = (
            complex(cam.place(angle, 0)[0]),
            cam.outer * np.exp(1j * (sheet.real / cam.outer - np.pi + angle)),
        )
        size, aside = cam.radius_at(fixed.real), fixed.imag - place.real
        over = (np.abs(aside) < size) & (fixed.real > 0)
        room = np.sqrt((size**2 - aside**2)[over]) - side * (sheet.imag[over] + body.length / 2 - place.imag)
        found.append(room.max())
    return np.array(found)


@pytest.mark.parametrize("name", [n if n == "end" else pytest.param(n, marks=pytest.mark.heavy) for n in FLAT])
def test_flat_files_are_rolled(name: str, tmp_path: Path) -> None:
    """A roller on every unrolled outline read back: its error is told; another wall in its place is seen."""
    keys = {k: v for k, v in (FORMS | STEEP)[name].items() if k not in ("hub", "bore")}
    tail = f'tolerance = 0.02\ncurves = "lines"\n[[exports]]\nformat = "svg"\ntolerance = 0.02\n{FLAT[name]}\n'
    (tmp_path / "s.toml").write_text(scene_text(keys, tail), encoding="utf-8")
    assert run("build", tmp_path / "s.toml", "--out", tmp_path) == 0
    files = {f["path"]: f for f in read_report(tmp_path / "s")["files"]}
    assert len(files) == 2
    for path, file in files.items():
        # the sheet's own error, and what a steep edge makes of it
        assert 0.4 * file["max_error"] < file["measured"]["lift_error"] < 4 * file["max_error"]
        assert {"velocity_error", "acceleration_error"} <= file["measured"].keys()
        assert recheck(tmp_path / "s" / path).verdict.failures == ()
    body, part = body_of(keys), part_of(keys)
    told, declared = (files["cam.dxf"]["measured"]["lift_error"], files["cam.dxf"]["max_error"])
    found = READERS["dxf"](tmp_path / "s" / "cam.dxf")
    loops = sorted(found.loops, key=lambda x: float(x.vertices.imag.mean()))
    sides = sorted(body.cam.sides)
    brute = [rested(x, body, side, np.radians(np.arange(0, 360, 12))) for side, x in zip(sides, loops, strict=True)]
    assert 0.5 * told < np.abs(brute).max() < 1.01 * told
    # an edge of another lift; one corner of it moved
    last = loops[-1].vertices
    for moved in (0.02 * last.imag, 0.2 * (np.arange(len(last)) == len(last) // 2)):
        wrong = replace(loops[-1], vertices=last + 1j * moved)
        verdict = probed(ReadOutlines((*loops[:-1], wrong)), part, 0.0, declared, Verdict({}, ()))
        assert "the follower's lift is wrong by" in verdict.failures[0]
    doubled = probed(ReadOutlines((*loops, loops[-1])), part, 0.0, declared, Verdict({}, ()))
    assert f"there are {len(loops) + 1} jackets for the roller" in doubled.failures[0]


CONICAL = {"clearance": 0.1, "roller_form": "conical"}


@pytest.mark.heavy
def test_files_of_a_swinging_follower_with_a_conical_roller(tmp_path: Path) -> None:
    scene = tmp_path / "s.toml"
    tail = ('tolerance = 0.01\n[[exports]]\nformat = "stl"\ntolerance = 0.05\n'
            '[[exports]]\nformat = "dxf"\npurpose = "drawing"\ntolerance = 1e-2\n')  # fmt: skip
    scene.write_text(scene_text(SWING | CONICAL, tail), encoding="utf-8")
    assert run("build", scene, "--out", tmp_path / "o") == 0
    folder = tmp_path / "o" / "s"
    by_path = {f["path"]: f for f in read_report(folder)["files"]}
    measured = by_path["cam.stl"]["measured"]
    assert measured["lift_error"] < 1.3 * 0.05
    assert measured["least_play"] > 0.1 - 2 * 0.05
    assert by_path["cam.laser.dxf"]["entities"]["LWPOLYLINE"] == 2
    assert "SPLINE" in by_path["cam.drawing.dxf"]["entities"]
    assert recheck(folder / "cam.stl").verdict.failures == ()
    # walls that the mesh's own check would have let through
    lifted = read_stl(folder / "cam.stl")
    part = part_of(SWING | CONICAL)
    body, vertices = body_of(SWING | CONICAL), lifted.vertices.copy()
    wall = next(f for f in body.faces() if isinstance(f, Track) and f.side == LOWER)
    vertices[wall.distance(body.cam, vertices) < 1e-4, 2] += 0.1
    write_stl(folder / "bad.stl", Mesh(vertices, lifted.triangles))
    found = probed(read_stl(folder / "bad.stl"), part, 0.0, 0.05, Verdict({}, ()))
    assert "the roller's place is wrong by 0.1" in found.failures[0]
    # the file of another cam in its place
    body = body_of(SWING | CONICAL | {"swing_deg": 23.5, "length": measured_length(folder)})
    mesh, _ = mesh_of(body, 0.05)
    write_stl(folder / "cam.stl", Mesh(mesh.vertices, mesh.triangles))
    assert recheck(folder / "cam.stl").verdict.failures


def measured_length(folder: Path) -> float:
    return float(read_stl(folder / "cam.stl").vertices[:, 2].max())


def written_step(file: Path, body: BarrelBody) -> float:
    """Write a cam within 1e-6 mm; what its splines are off, mm."""
    exact = faced(body)
    curves = solid_curves(exact, 1e-6)
    write_step(file, StepPart("cam", solid_faces(exact, curves), None), StepForm())
    return max(c.max_error for c in curves)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["end", "cone"])
def test_a_step_file_holds_the_exact_cam(name: str, tmp_path: Path) -> None:
    pytest.importorskip("OCP", exc_type=ImportError)
    body = body_of(FORMS[name])
    file = tmp_path / f"{name}.step"
    error = written_step(file, body) + 1e-8
    assert error < 5e-8
    found = READERS["step"](file)

    def judged(exact: BarrelBody) -> Verdict:
        return held(found, FILE_KINDS["step"], faced(exact), error, 1e-6, "cam")

    good = judged(body)
    assert good.failures == ()
    assert abs(good.measured["volume_error"]) < 1e-8
    # against a cam that differs a little, at its walls, its floor, and its ends
    cam = body.cam
    low = replace(body, cam=replace(cam, guide=cam.guide.raised(1e-4)))
    assert any("deviates" in f for f in judged(low).failures)
    deep = replace(body, cam=replace(cam, inner=cam.inner - 1e-4))
    assert judged(deep).failures
    longer = replace(body, length=body.length + 1e-3)
    assert bool(judged(longer).failures) == cam.is_groove


def random_cam(rng: random.Random) -> dict[str, object]:
    """A cylindrical cam of any size, with a cone or a cylinder; what cannot be is refused, see the caller."""
    size = 10 ** rng.uniform(0.5, 3)
    shares = [rng.uniform(0.1, 1) for _ in range(4)]
    rise, high, fall = (x / sum(shares) * 360 for x in shares[:3])
    names = ("constant_acceleration", "sine", "modified_trapezoid", "gutman_13", "polynomial_4567")
    phases = [{"move": "rise", "angle_deg": rise, "law": rng.choice(names)}, {"move": "dwell", "angle_deg": high},
              {"move": "return_", "angle_deg": fall, "law": rng.choice(names)},
              {"move": "dwell", "angle_deg": 360 - (rise + high + fall)}]  # fmt: skip
    keys: dict[str, object] = {"kind": "barrel_cam", "form": rng.choice(["groove", "end"]), "phases": phases,
                               "outer_diameter": size, "groove_depth": size * rng.uniform(0.02, 0.4),
                               "roller_diameter": size * rng.uniform(0.01, 0.4)}  # fmt: skip
    if rng.random() < 0.5:
        keys |= {"roller_form": "conical"} | ({"cone_angle_deg": rng.uniform(5, 60)} if rng.random() < 0.5 else {})
    if rng.random() < 0.4:
        return keys | {"swing_deg": rng.uniform(2, 50), "oscillating": {"arm_length": size * rng.uniform(0.3, 1.5)}}
    return keys | {"lift": size * 10 ** rng.uniform(-2, 0)}


def possible_cam(rng: random.Random) -> BarrelBody:
    """The first of random cams that is not refused."""
    while True:
        with contextlib.suppress(SceneError):
            return body_of(random_cam(rng))


@pytest.mark.heavy
@pytest.mark.parametrize("seed", range(30))
def test_random_cams_become_good_files(seed: int, tmp_path: Path) -> None:
    pytest.importorskip("OCP", exc_type=ImportError)
    from exporters.verification.faces import verify_faced_solid

    body = possible_cam(random.Random(seed))
    tolerance = 1e-3 * body.cam.outer
    exact = barrel_faces(body)
    outlines = mesh_outlines(exact, tolerance, 0.0)
    made = body_mesh(exact, outlines)
    mesh = ReadMesh(made.vertices, made.triangles)
    # vertices stand on a grid, of which a file's rounding has its share
    declared = outlines[0].max_error + 1e-8 * exact.section_reach()
    assert verify_faced_mesh(mesh, exact, declared, tolerance).failures == ()
    file = tmp_path / "cam.step"
    error = max(1e-6, written_step(file, body))
    assert verify_faced_solid(read_step(file), exact, error, 1e-6).failures == ()

"""Files of helical parts: the command's own read-back, outside readers, spoiled files that are caught."""

from __future__ import annotations

import json
import math
import tracemalloc
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.formats.read_stl import read_stl
from exporters.formats.readback import ReadMesh
from exporters.formats.step import write_step
from exporters.formats.stl import write_stl
from exporters.verification.mesh import verify_mesh
from geometry.base.record import replace
from geometry.solids.body import Body
from parts.base.readback import ReadError
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, make_parts, scene_from_dict
from parts.solids.faces import solid_curves, solid_faces
from parts.solids.kernel import has_kernel
from parts.solids.mesh import body_mesh, mesh_outlines
from parts.solids.step_text import StepForm, StepPart
from tests.oracles.rack_sweep import RackTool
from tests.oracles.space_rack import space_penetration

needs_kernel = pytest.mark.skipif(not has_kernel(), reason="needs the CAD kernel")
GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "helix_angle_deg": 30.0, "face_width": 10.0,
        "bore_diameter": 10.0}  # fmt: skip
PARTS: dict[str, dict[str, Any]] = {
    "right": GEAR,
    "double": {**GEAR, "number_of_teeth": 10, "hand": "left", "double_helical": True, "tip_rounding": 0.2,
               "web": {"thickness": 4.0, "rim_diameter": 16.5}, "hub": {"diameter": 13.0, "above": 2.0}},
    "chamfered": {**GEAR, "number_of_teeth": 15, "face_chamfer": {"below": 0.4, "above": 0.6}, "tip_chamfer": 0.3},
    "chamfered_double": {**GEAR, "number_of_teeth": 12, "hand": "left", "double_helical": True, "tip_rounding": 0.3,
                         "hub": {"diameter": 16.0, "above": 3.0}, "face_chamfer": 0.3},
    "steep": {**GEAR, "number_of_teeth": 9, "helix_angle_deg": 45.0, "face_width": 70.0, "tip_chamfer": 0.2},
    "shaped": {**GEAR, "number_of_teeth": 15, "helix_angle_deg": 20.0, "cutter": {"number_of_teeth": 25}},
    "chamfered_ring": {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 18, "helix_angle_deg": 20.0,
                       "face_width": 10.0, "face_chamfer": {"below": 0.4, "above": 0.6}, "tip_rounding": 0.8,
                       "holes": {"count": 4, "diameter": 4.0, "pitch_circle_diameter": 54.0}},
    # its tips end on the base circle: the lowest slices of its chamfers are 6e-6 mm high
    "ring_of_cusps": {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 18, "helix_angle_deg": 15.0,
                      "face_width": 3.0, "face_chamfer": {"below": 0.4}, "rounded_root": {}},
    "ring": {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 40, "helix_angle_deg": 20.0, "face_width": 10.0},
    "rack": {"kind": "rack", "module": 2.0, "number_of_teeth": 3, "helix_angle_deg": 30.0, "face_width": 10.0},
    "chevrons": {"kind": "rack", "module": 2.0, "number_of_teeth": 3, "helix_angle_deg": 20.0, "tip_rounding": 0.3,
                 "double_helical": True},
}  # fmt: skip


def body_of(keys: dict[str, Any], offset: float = 0.0) -> Body:
    return make_parts(scene_from_dict({"parts": {"p": keys}}, "test", "test"), "test")[0]["p"].body(offset)


def write(folder: Path, parts: dict[str, Any], *exports: str) -> Path:
    file = folder / "s.toml"
    rows = [
        f"[parts.{name}]\n" + "\n".join(f"{k} = {_toml(v)}" for k, v in keys.items()) for name, keys in parts.items()
    ]
    file.write_text("\n".join([*rows, *(f"[[exports]]\n{e}" for e in exports)]))
    return file


def _toml(value: object) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{k} = {_toml(v)}" for k, v in value.items()) + "}"
    return json.dumps(value)


# chamfers of a ring leave the least to the slices on either side of their chords
@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.heavy] * (name not in ("shaped", "chamfered_ring"))) for name in PARTS],
)
def test_meshes_pass_their_read_back_and_trimesh(tmp_path: Path, name: str) -> None:
    import trimesh

    keys = PARTS[name]
    scene = write(
        tmp_path, {name: keys}, 'format = "stl"\ntolerance = 0.02', 'format = "3mf"\noffset = -0.05', 'format = "dxf"'
    )
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0
    report = json.loads((tmp_path / "s" / "report.json").read_text())
    for entry in report["files"]:
        if entry["format"] != "dxf":
            assert 0.4 * entry["max_error"] <= entry["measured"]["max_deviation"] <= entry["max_error"]
            assert abs(entry["measured"]["volume_error"]) < 4e-3
    mesh = trimesh.load(tmp_path / "s" / f"{name}.stl")
    assert mesh.is_watertight
    assert mesh.is_winding_consistent
    exact = _area_times_width(keys)
    if exact is not None:
        assert mesh.volume == pytest.approx(exact, rel=4e-3)
    for entry in report["files"]:
        codes = {f["code"] for f in entry["findings"]}
        assert ("transverse_section" in codes) == (entry["format"] == "dxf")


def test_large_meshes_are_written_and_read_back_in_little_memory(tmp_path: Path) -> None:
    """Of 3.9 million triangles it took 2.4 GB, 600 bytes of each: whatever is measured of all was laid out at once."""
    body = body_of({**GEAR, "face_width": 20.0})
    mesh = body_mesh(body, mesh_outlines(body, 5e-4, 1e-6))
    tracemalloc.start()
    try:
        write_stl(tmp_path / "g.stl", mesh)
        verdict = verify_mesh(read_stl(tmp_path / "g.stl"), body, 5e-4, 5e-4)
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert not verdict.failures
    assert most < 350 * len(mesh.triangles)


def test_every_block_of_a_mesh_is_judged(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One corner off its wall, and a normal of the last block turned over: neither is lost among the blocks."""
    for block in ("formats.read_stl._AT_ONCE", "verification.topology.AT_ONCE", "verification.twisted.AT_ONCE"):
        monkeypatch.setattr(f"exporters.{block}", 64)
    body = body_of(GEAR)
    mesh = body_mesh(body, mesh_outlines(body, 0.05, 1e-6))
    levels = mesh.vertices[:, 2]
    reach = np.hypot(*mesh.vertices.T[:2]) * ((levels > levels.min()) & (levels < levels.max()))
    moved, most = mesh.vertices.copy(), reach.argmax()
    moved[most, :2] *= 1 + 0.3 / reach[most]
    verdict = verify_mesh(ReadMesh(moved, mesh.triangles), body, 0.05, 0.05)
    assert verdict.measured["max_deviation"] == pytest.approx(0.3, rel=1e-6)
    file = tmp_path / "g.stl"
    write_stl(file, mesh)
    data = bytearray(file.read_bytes())
    data[-50:-38] = (-np.frombuffer(data[-50:-38], "<f4")).tobytes()
    file.write_bytes(data)
    with pytest.raises(ReadError, match="contradicts"):
        read_stl(file)


def _area_times_width(keys: dict[str, Any]) -> float | None:
    """Volume by Cavalieri from the same part without a helix of its transverse section; None where a web is cut out."""
    if "web" in keys or "face_chamfer" in keys:
        return None
    from geometry.plane.measure import profile_area

    made = make_parts(scene_from_dict({"parts": {"p": keys}}, "test", "test"), "test")[0]["p"]
    return sum(profile_area(p) for p in made.section(0.0).region.profiles()) * keys.get("face_width", 10.0)


def chamfered_reference(keys: dict[str, Any]) -> tuple[Any, float]:
    """The transverse section as a polygon, and how far teeth turn for each mm, rad: m_n z = 2 r cos(beta)."""
    import shapely

    part = make_parts(scene_from_dict({"parts": {"p": keys}}, "test", "test"), "test")[0]["p"]
    region = part.section(0.0).region
    rings = [
        np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 200))[:-1] for s in profile.segments()])
        for profile in (region.outer, *region.holes)
    ]
    beta = math.radians(keys["helix_angle_deg"])
    outer, *holes = (np.column_stack([ring.real, ring.imag]) for ring in rings)
    return shapely.Polygon(outer, holes), 2 * math.sin(beta) / (keys["module"] * keys["number_of_teeth"])


@pytest.mark.parametrize("name", ["chamfered", pytest.param("chamfered_ring", marks=pytest.mark.heavy)])
def test_chamfers_of_helical_teeth_are_roofs_over_the_section_where_the_helix_ends(tmp_path: Path, name: str) -> None:
    """Sections of the STL by trimesh against the section by shapely, turned and moved in at 45 degrees; none leaves the
    teeth that the helix would have there. The volume is what these sections hold. Holes of a ring stay in their place.
    """
    import shapely
    import trimesh

    keys = PARTS[name]
    below, above, width = 0.4, 0.6, keys["face_width"]
    scene = write(tmp_path, {"g": keys}, 'format = "stl"\ntolerance = 0.002')
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0
    mesh, (whole, rate) = trimesh.load(tmp_path / "s" / "g.stl"), chamfered_reference(keys)
    # of a ring the space within its teeth turns
    within = shapely.Polygon(whole.interiors[0])

    def turned(angle: float) -> Any:
        if name == "chamfered":
            return shapely.affinity.rotate(whole, angle, (0, 0), use_radians=True)
        return whole.union(within).difference(shapely.affinity.rotate(within, angle, (0, 0), use_radians=True))

    for z in (0.01, 0.2, 0.39, 0.41, 3.0, 9.39, 9.41, 9.7, 9.99):
        edges = trimesh.intersections.mesh_plane(mesh, [0, 0, 1], [0, 0, z])[:, :, :2].round(7)
        faces = shapely.polygonize(shapely.linestrings(edges)).geoms
        found = max(faces, key=lambda face: shapely.Polygon(face.exterior).area)
        depth = max(below - z, z - (width - above), 0.0)
        wanted = turned(rate * min(max(z, below), width - above)).buffer(-depth, join_style="mitre")
        # as an area over both outlines it is twice as much off at most
        assert found.symmetric_difference(wanted).area < 0.003 * wanted.length
        assert found.difference(turned(rate * z).buffer(0.003)).area == 0.0
    shares = np.linspace(0, 1, 5)
    areas = {c: [whole.buffer(-c * s, join_style="mitre").area for s in shares] for c in (below, above)}
    roofs = sum(c * float(np.dot([7, 32, 12, 32, 7], areas[c])) / 90 for c in areas)
    assert mesh.volume == pytest.approx(whole.area * (width - below - above) + roofs, rel=2e-4)


@needs_kernel
def test_step_points_lie_on_the_screw_surface(tmp_path: Path) -> None:
    """Module 2, 23 teeth, 30 degrees: the involute helicoid by its own formula, fillets by the rack swept in space."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.GeomAbs import GeomAbs_SurfaceType
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    from parts.solids.kernel import solids_of

    scene = write(tmp_path, {"right": GEAR}, 'format = "step"')
    assert main(["build", str(scene), "--out", str(tmp_path), "--no-verify"]) == 0
    text = (tmp_path / "s" / "right.step").read_text()
    points, radii = [], []
    explorer = TopExp_Explorer(solids_of(text)[0], TopAbs_ShapeEnum.TopAbs_FACE)
    while explorer.More():
        surface = BRepAdaptor_Surface(TopoDS.Face_s(explorer.Current()))
        if surface.GetType() == GeomAbs_SurfaceType.GeomAbs_Cylinder:
            radii.append(surface.Cylinder().Radius())
        elif surface.GetType() == GeomAbs_SurfaceType.GeomAbs_BSplineSurface:
            u = np.linspace(surface.FirstUParameter(), surface.LastUParameter(), 5)
            v = np.linspace(surface.FirstVParameter(), surface.LastVParameter(), 4)
            found = [surface.Value(a, b) for a in u.tolist() for b in v.tolist()]
            points.append([(p.X(), p.Y(), p.Z()) for p in found])
        explorer.Next()
    beta, alpha = math.radians(30.0), math.radians(20.0)
    reference = 23.0 / math.cos(beta)
    expected = [5.0] + 23 * [reference - 2.5] + 23 * [reference + 2.0]
    assert sorted(radii) == pytest.approx(expected, abs=1e-9)
    assert len(points) == 4 * 23
    error = _distance_from_helical_gear(np.array(points).reshape(-1, 3), 23, 2.0, alpha, beta)
    assert error.max() < 1e-6


def _distance_from_helical_gear(p: np.ndarray, teeth: int, module: float, alpha: float, beta: float) -> np.ndarray:
    """Distance from the zero helical gear: normal to the involute in its section, and the depth in the swept rack."""
    transverse = math.atan(math.tan(alpha) / math.cos(beta))
    reference = module * teeth / math.cos(beta) / 2
    base = reference * math.cos(transverse)
    place = (p[:, 0] + 1j * p[:, 1]) * np.exp(-1j * p[:, 2] * math.tan(beta) / reference)
    pitch = 2 * math.pi / teeth
    angle = np.abs(np.angle(place) - pitch * np.round(np.angle(place) / pitch))
    pressure = np.arccos(np.minimum(base / np.abs(place), 1.0))
    half = math.pi / 2 / teeth + math.tan(transverse) - transverse
    flank = base * np.abs(angle - (half - (np.tan(pressure) - pressure)))
    tool = RackTool(module, alpha, 1.0, 0.25, 0.38, 0.0)
    swept = np.abs(space_penetration(p[:, 0] + 1j * p[:, 1], p[:, 2], tool, teeth, beta))
    above = np.abs(place) > reference - 0.5 * module
    assert np.abs(swept - flank)[above].max() < 1e-9
    return np.where(above, flank, swept)


@pytest.mark.sampled(1)
@needs_kernel
@pytest.mark.parametrize(
    "name", ["double", "shaped", "rack", "chevrons", "chamfered", "chamfered_double", "chamfered_ring"]
)
def test_step_files_pass_their_read_back(tmp_path: Path, name: str) -> None:
    scene = write(tmp_path, {name: PARTS[name]}, 'format = "step"')
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0
    entry = json.loads((tmp_path / "s" / "report.json").read_text())["files"][0]
    assert entry["measured"]["max_deviation"] <= entry["max_error"] <= 1e-6
    assert abs(entry["measured"]["volume_error"]) < 1e-8


@pytest.mark.heavy
@needs_kernel
@pytest.mark.parametrize("name", ["steep", "ring", "ring_of_cusps"])
def test_long_step_files_pass_their_read_back(tmp_path: Path, name: str) -> None:
    test_step_files_pass_their_read_back(tmp_path, name)


@needs_kernel
def test_the_wrong_screw_is_seen_in_step(tmp_path: Path) -> None:
    """The solid of another hand, of a slightly other angle, of a single helix: none passes for the part."""
    from exporters.formats.read_step import read_step
    from exporters.verification.solid import verify_solid

    keys = {**GEAR, "number_of_teeth": 8, "bore_diameter": 4.0}
    body = body_of(keys)
    file = tmp_path / "gear.step"
    write_step(file, StepPart("gear", solid_faces(body, solid_curves(body, 9e-7)), None), StepForm())
    solid = read_step(file)
    assert not verify_solid(solid, body, 1e-6, 1e-6).failures
    for other in ({"hand": "left"}, {"double_helical": True}):
        assert verify_solid(solid, body_of(keys | other), 1e-6, 1e-6).failures
    slightly = replace(body, loops=tuple(replace(loop, turn=loop.turn * (1 + 1e-6)) for loop in body.loops))
    assert any("deviates" in f for f in verify_solid(solid, slightly, 1e-6, 1e-6).failures)


def read(body: Body, tolerance: float = 0.02) -> tuple[ReadMesh, float]:
    made = mesh_outlines(body, tolerance, 1e-4)
    mesh = body_mesh(body, made)
    return ReadMesh(mesh.vertices.astype(np.float32).astype(float), mesh.triangles), max(
        a.max_error for a in made
    ) + 1e-5


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["right", "double", "rack", "chevrons"])
def test_the_wrong_screw_is_seen_in_a_mesh(name: str) -> None:
    body = body_of(PARTS[name])
    mesh, declared = read(body)
    assert not verify_mesh(mesh, body, declared, 0.03).failures
    turned_round = {"right": "left", "left": "right"}[PARTS[name].get("hand", "right")]
    assert verify_mesh(mesh, body_of(PARTS[name] | {"hand": turned_round}), declared, 0.03).failures
    other = not PARTS[name].get("double_helical", False)
    assert verify_mesh(mesh, body_of(PARTS[name] | {"double_helical": other}), declared, 0.03).failures


@pytest.mark.sampled(1)
@pytest.mark.parametrize("upper", [False, True])
def test_a_chamfer_that_is_turned_is_seen(upper: bool) -> None:
    """The roof over another place of the helix, as over the section at the face itself."""
    body = body_of(PARTS["chamfered"])
    mesh, declared = read(body)
    assert not verify_mesh(mesh, body, declared, 0.03).failures
    ends = body.levels()[2:] if upper else body.levels()[:2]
    assert len(body.levels()) == 4
    loops = [replace(one, turn=one.turn + 2e-3) if one.z in ends and one.turn else one for one in body.loops]
    assert verify_mesh(mesh, replace(body, loops=tuple(loops)), declared, 0.03).failures


def test_a_spoiled_slice_is_seen() -> None:
    """A vertex between the ends that is moved, a slice that is turned, a slice that is left out."""
    body = body_of(GEAR)
    mesh, declared = read(body)
    z, places = mesh.vertices[:, 2], mesh.vertices[:, 0] + 1j * mesh.vertices[:, 1]
    inner = np.flatnonzero((z > 0) & (z < 10.0))
    for spoiled in (inner[:1], inner[len(inner) // 2 :][:1], inner[-1:], np.flatnonzero(z == z[inner[0]])):
        moved = mesh.vertices.copy()
        # a corner moves aside and outwards, a whole slice turns
        turned = places[spoiled] * np.exp((4j if len(spoiled) > 1 else 4 + 4j) * declared / 25.0)
        moved[spoiled, 0], moved[spoiled, 1] = turned.real, turned.imag
        assert verify_mesh(ReadMesh(moved, mesh.triangles), body, declared, 0.03).failures
    # every second slice left out: each slice is right, what lies between is not
    made = list(mesh_outlines(body, 0.02, 1e-4))
    made[0] = replace(made[0], turn_step=2 * made[0].turn_step)
    coarse = body_mesh(body, tuple(made))
    failures = verify_mesh(ReadMesh(coarse.vertices, coarse.triangles), body, declared, 0.03).failures
    assert any("deviates" in f for f in failures)


REFUSED: dict[str, tuple[dict[str, Any], str]] = {
    # tan 50 cos(atan(tan 20 / cos 50)) = 1.037
    "chamfered faces": ({**GEAR, "helix_angle_deg": 50.0, "face_chamfer": 0.5}, "face_chamfer"),
    "one chamfered face": ({**GEAR, "helix_angle_deg": -50.0, "face_chamfer": {"below": 0.5}}, "face_chamfer.below"),
    "chamfers that meet": ({**GEAR, "face_chamfer": 5.0}, "face_chamfer"),
    "double without an angle": ({**GEAR, "helix_angle_deg": 0.0, "double_helical": True}, "double_helical"),
    "too steep": ({**GEAR, "helix_angle_deg": 61.0}, "helix_angle_deg"),
    "no hand": ({**GEAR, "hand": "up"}, "hand"),
    "undercut away": (
        {
            **GEAR,
            "number_of_teeth": 5,
            "helix_angle_deg": 20.0,
            "profile_shift_coefficient": -0.9,
            "bore_diameter": 0.0,
        },
        "profile_shift_coefficient",
    ),
    "pointed ring": ({**PARTS["ring"], "profile_shift_coefficient": -3.0}, ""),
    "holes in a helical rack": ({**PARTS["rack"], "holes": {"count": 1, "diameter": 2.0}}, "holes.count"),
}


@pytest.mark.parametrize(("keys", "key"), REFUSED.values(), ids=REFUSED.keys())
def test_refusals_name_the_key(keys: dict[str, Any], key: str) -> None:
    with pytest.raises(SceneError) as caught:
        body_of(keys)
    assert key in caught.value.key
    assert (
        "work" in caught.value.remedy
        or "remove" in caught.value.remedy
        or "one of" in caught.value.remedy
        or ("at most 60" in caught.value.remedy)
    )


@pytest.mark.parametrize("sign", [1, -1])
def test_a_chamfer_is_refused_from_45_degrees_on_the_base_cylinder_on(sign: int) -> None:
    """sin(beta_b) = sin(beta) cos(alpha_n): 48.808 degrees, of 20."""
    limit = math.degrees(math.asin(math.sin(math.radians(45)) / math.cos(math.radians(20))))
    keys = GEAR | {"number_of_teeth": 15, "face_chamfer": 0.2}
    body_of(keys | {"helix_angle_deg": sign * (limit - 1e-4)})
    with pytest.raises(SceneError) as caught:
        body_of(keys | {"helix_angle_deg": sign * (limit + 1e-4)})
    assert caught.value.code == "chamfer_on_steep_helix"


def test_a_refused_shift_is_told_in_normal_modules_and_its_remedy_works() -> None:
    keys = {
        **GEAR,
        "number_of_teeth": 7,
        "helix_angle_deg": 40.0,
        "profile_shift_coefficient": 1.5,
        "bore_diameter": 0.0,
    }
    with pytest.raises(SceneError) as caught:
        body_of(keys)
    assert caught.value.key.endswith("profile_shift_coefficient")
    assert caught.value.value == pytest.approx(1.5)
    nearest = float(caught.value.remedy.rpartition("at most ")[2].split()[0])
    assert body_of(keys | {"profile_shift_coefficient": nearest}).walls
    with pytest.raises(SceneError):
        body_of(keys | {"profile_shift_coefficient": nearest + 0.01})


def test_the_built_in_scene_loads() -> None:
    assert make_parts(load_scene("helical_gears"), "helical_gears")[0]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("more", [{}, {"double_helical": True}, {"module": 0.01, "face_width": 0.05}])
@pytest.mark.parametrize(("kind", "teeth"), [("spur_gear", 20), ("ring_gear", 60), ("rack", 6)])
def test_the_least_helix_that_is_taken_is_told_by_every_file(
    kind: str, teeth: int, more: dict[str, Any], tmp_path: Path
) -> None:
    """Four steps of float32 at the rim, a millionth of a mm at least; beside a bore, which stands upright."""
    keys = {"kind": kind, "module": 2.0, "number_of_teeth": teeth, "face_width": 10.0} | more
    keys |= {"bore_diameter": 2 * keys["module"]} if kind == "spur_gear" else {}
    moved = max(1e-6, 4 * 2.0**-23 * math.pi / 2 * keys["module"] * (teeth + 4))
    half = keys["face_width"] / (2 if "double_helical" in more else 1)
    keys["helix_angle_deg"] = math.degrees(math.atan(1.001 * moved / half))
    scene = write(tmp_path, {"p": keys}, *(f'format = "{name}"' for name in ("stl", "step", "3mf")))
    assert main(["build", str(scene), "--out", str(tmp_path), "--quiet"]) == 0

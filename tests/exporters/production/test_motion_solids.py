"""Animated glTF: solids and poses by a reader of the tests' own, an axis that lies, spoiled files."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.formats.read_glb import read_glb
from exporters.production.build import build
from exporters.production.motion_solids import _quaternion
from exporters.production.plan import Plan, plan_build
from geometry.base.placement import Placement3
from parts.base.readback import ReadError
from parts.base.refusal import SceneError
from parts.scene.load import scene_from_toml
from tests.exporters.making import run
from tests.parts.scene.test_trains import DRIVE, FREE, JAMES

GLB = '[[exports]]\nformat = "glb"\n'
TURNED = JAMES + DRIVE.format("sun", "turns = 4.0") + GLB
TILTED = """[parts.a]
kind = "spur_gear"
module = 1.0
number_of_teeth = 20
[instances.a]
part = "a"
at = [5.0, 6.0, 7.0]
axis = [{}]
rotation_deg = 10.0
[[drives]]
instance = "a"
turns = 0.5
"""


def planned(text: str) -> Plan:
    return plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s", [], ["glb"])


def opened(file: Path) -> tuple[dict[str, Any], bytearray]:
    data = file.read_bytes()
    size = int.from_bytes(data[12:16], "little")
    return json.loads(data[20 : 20 + size]), bytearray(data[28 + size :])


def numbers(scene: dict[str, Any], blob: bytes, accessor: int) -> np.ndarray:
    told = scene["accessors"][accessor]
    view = scene["bufferViews"][told["bufferView"]]
    kind = "<f4" if told["componentType"] == 5126 else "<u4"
    return np.frombuffer(blob, kind, view["byteLength"] // 4, view["byteOffset"]).reshape(told["count"], -1)


def at(file: Path, name: str, share: float) -> np.ndarray:
    """(4, 4) of an instance, mm: matrices between values by the half-way rule, which only even turns obey."""
    import trimesh

    scene, blob = opened(file)
    number = next(k for k, node in enumerate(scene["nodes"]) if node["name"] == name)
    node = scene["nodes"][number]
    ways = {"translation": node.get("translation"), "rotation": node.get("rotation")}
    animation = scene["animations"][0]
    for channel in animation["channels"]:
        if channel["target"]["node"] == number:
            sampler = animation["samplers"][channel["sampler"]]
            times, values = (numbers(scene, blob, sampler[key]).astype(float) for key in ("input", "output"))
            place = share * float(times[-1, 0])
            k = min(int(np.searchsorted(times[:, 0], place, side="right")) - 1, len(times) - 2)
            part = (place - times[k, 0]) / (times[k + 1, 0] - times[k, 0])
            one, two = values[k], values[k + 1]
            if channel["target"]["path"] == "rotation":
                # the turn from one to the other, as an axis and an angle
                step = np.array(
                    trimesh.transformations.quaternion_multiply(np.roll(two, 1), np.roll(one, 1) * [1, -1, -1, -1])
                )
                step *= math.copysign(1.0, step[0])
                angle = 2 * math.atan2(float(np.linalg.norm(step[1:])), step[0]) * part
                axis = step[1:] / max(float(np.linalg.norm(step[1:])), 1e-30)
                turn = np.concatenate([[math.cos(angle / 2)], math.sin(angle / 2) * axis])
                ways["rotation"] = np.roll(trimesh.transformations.quaternion_multiply(turn, np.roll(one, 1)), -1)
            else:
                ways["translation"] = one + part * (two - one)
    found = trimesh.transformations.quaternion_matrix(np.roll(ways["rotation"], 1))
    found[:3, 3] = ways["translation"]
    return np.asarray(found)


def test_satellites_turn_and_stand_in_space_as_the_formula_says(tmp_path: Path) -> None:
    """40/40/120: in four turns of the sun the carrier makes one, a satellite turns by -2."""
    import trimesh

    plan = planned(TURNED)
    assert build(plan, tmp_path).well
    file = tmp_path / "s.glb"
    start = {i.id: i for i in plan.placing.instances}
    for share in (0.0, 0.037, 1 / 3, 0.71, 0.999):
        for name, turns in (("sun", 4), ("carrier", 1), ("planet_2", -2), ("ring", 0)):
            angle = start[name].rotation + 2 * math.pi * turns * share
            around = np.exp(2j * math.pi * share) if name == "planet_2" else 1.0
            place = start[name].centre * around
            exact = trimesh.transformations.rotation_matrix(angle, [0, 0, 1])
            exact[:3, 3] = place.real, place.imag, start[name].at[2]
            off = np.abs(at(file, name, share) - exact)
            assert off[:3, :3].max() < 2e-5
            assert off[:3, 3].max() < 0.02


def test_bounds_stand_beside_places_and_times_as_gltf_asks(tmp_path: Path) -> None:
    build(planned(TURNED), tmp_path)
    scene, blob = opened(tmp_path / "s.glb")
    places = {one["attributes"]["POSITION"] for mesh in scene["meshes"] for one in mesh["primitives"]}
    times = {one["input"] for film in scene["animations"] for one in film["samplers"]}
    for accessor in places | times:
        values, told = numbers(scene, blob, accessor), scene["accessors"][accessor]
        assert told["min"] == values.min(axis=0).tolist()
        assert told["max"] == values.max(axis=0).tolist()


def test_another_reader_finds_closed_solids_in_metres(tmp_path: Path) -> None:
    import trimesh

    plan = planned(TURNED)
    build(plan, tmp_path)
    scene = trimesh.load(tmp_path / "s.glb")
    assert isinstance(scene, trimesh.Scene)
    assert set(scene.geometry) == set(plan.parts)
    for name, mesh in scene.geometry.items():
        part = plan.parts[name]
        assert mesh.is_watertight
        assert mesh.volume == pytest.approx(part.made_by.moments(part.body(0.0)).volume, rel=2e-3)
    width = 2 * plan.parts["ring"].section(0.0).region.outer.reach() / 1000
    assert scene.extents[[0, 2]] == pytest.approx([width, width], rel=1e-3)


@pytest.mark.parametrize("axis", ["1.0, 0.0, 0.0", "0.0, -1.0, 0.0", "0.0, 0.0, -1.0", "0.6, 0.0, 0.8"])
def test_an_axis_that_lies_is_laid(tmp_path: Path, axis: str) -> None:
    plan = planned(TILTED.format(axis) + GLB)
    built = build(plan, tmp_path)
    assert built.well
    found = at(tmp_path / "s.glb", "a", 0.5)
    (exact,) = plan.placing.at([built.written[0].job.told["drive"] / 2])
    assert found[:3, :3] == pytest.approx(np.array(exact.scene_from_part.rotation), abs=1e-6)
    assert found[:3, 3] == pytest.approx([5, 6, 7])


def moved(scene: dict[str, Any], blob: bytearray, path: str, by: float) -> None:
    """Change a number of the first channel that moves by its path."""
    animation = scene["animations"][0]
    channel = next(c for c in animation["channels"] if c["target"]["path"] == path)
    accessor = animation["samplers"][channel["sampler"]]["output"]
    start = scene["bufferViews"][scene["accessors"][accessor]["bufferView"]]["byteOffset"] + 64
    value = np.frombuffer(blob, "<f4", 1, start)[0] + np.float32(by)
    blob[start : start + 4] = np.float32(value).tobytes()


def shrunk(scene: dict[str, Any], blob: bytearray) -> None:
    told = scene["bufferViews"][scene["accessors"][0]["bufferView"]]
    values = np.frombuffer(blob, "<f4", told["byteLength"] // 4, told["byteOffset"]).reshape(-1, 3) * np.float32(0.999)
    blob[told["byteOffset"] : told["byteOffset"] + told["byteLength"]] = values.tobytes()
    scene["accessors"][0] |= {"min": values.min(axis=0).tolist(), "max": values.max(axis=0).tolist()}


SPOILED: dict[str, Callable[[dict[str, Any], bytearray], object]] = {
    "a place": lambda scene, blob: moved(scene, blob, "translation", 0.1),
    "a turn": lambda scene, blob: moved(scene, blob, "rotation", 1e-3),
    "a solid": shrunk,
    "metres": lambda scene, blob: scene["nodes"][0].update(scale=[1.0] * 3),
    "another solid": lambda scene, blob: scene["nodes"][1].update(mesh=scene["nodes"][2]["mesh"]),
    "an instance": lambda scene, blob: scene["nodes"][2].update(name="x"),
    "steps": lambda scene, blob: scene["animations"][0]["samplers"][0].update(interpolation="STEP"),
    "an extension": lambda scene, blob: scene.update(extensionsRequired=["X"]),
    "bounds": lambda scene, blob: scene["accessors"][0].update(min=[0.0, 0.0, 0.0]),
    "a mirror": lambda scene, blob: scene["nodes"][1].update(scale=[-1.0, 1.0, 1.0]),
    "a hidden channel": lambda scene, blob: scene["animations"].append(scene["animations"][0]),
    "the buffer": lambda scene, blob: blob.extend(b"0000"),
}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("what", SPOILED)
def test_spoiled_films_are_seen(tmp_path: Path, what: str) -> None:
    build(planned(TURNED), tmp_path)
    file = tmp_path / "s.glb"
    assert run("verify", str(file)) == 0
    good = file.read_bytes()
    # the head: another kind of file, another version, another length
    for at in (0, 4, 8):
        spoilt = bytearray(good)
        spoilt[at] ^= 1
        file.write_bytes(spoilt)
        with pytest.raises(ReadError, match="does not begin"):
            read_glb(file)
    file.write_bytes(good)
    scene, blob = opened(file)
    SPOILED[what](scene, blob)
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    words = [int(n).to_bytes(4, "little") for n in (2, 28 + len(text) + len(blob), len(text), len(blob))]
    file.write_bytes(b"glTF" + words[0] + words[1] + words[2] + b"JSON" + text + words[3] + b"BIN\0" + blob)
    assert run("verify", str(file)) == 1


@pytest.mark.parametrize("export", ['format = "glb"', 'format = "stl"', 'format = "3mf"\nassembly = true'])
def test_a_tolerance_that_is_offered_serves_every_part(export: str, tmp_path: Path) -> None:
    """The refusal of a film ended in a traceback, that of meshes offered what the first part could keep."""
    plate = '[parts.{0}]\nkind = "plate"\nwidth = {1}.0\nheight = 9.0\nface_width = 3.0\n'
    text = plate.format("a", 20) + plate.format("b", 90) + '[[drives]]\ninstance = "b"\n' + f"[[exports]]\n{export}\n"

    def plan(tolerance: float) -> Plan:
        told = f"{text}tolerance = {tolerance}\n".encode()
        return plan_build(scene_from_toml(told, "s.toml", "s"), "s.toml", [], [])

    with pytest.raises(SceneError) as refused:
        build(plan(2e-6), tmp_path)
    assert (refused.value.key, refused.value.value) == ("exports[1].tolerance", 2e-6)
    offered = refused.value.nearest
    assert offered is not None
    assert build(plan(float(offered.value)), tmp_path).well
    with pytest.raises(SceneError):
        build(plan(0.99 * float(offered.value)), tmp_path)


RATCHET = """[parts.wheel]
kind = "ratchet_wheel"
module = 5.0
number_of_teeth = 24
face_width = 4.0
[parts.pawl]
kind = "pawl"
of = "wheel"
face_width = 4.0
[[mates]]
kind = "ratchet_pair"
first = "wheel"
second = "pawl"
[[drives]]
instance = "wheel"
turns = {turns}
[[exports]]
format = "{format}"
tolerance = {tolerance}
"""


def of_ratchet(folder: Path, form: str, tolerance: float, turns: float = 1.0) -> dict[str, Any]:
    """What the report says of the film of a pawl that drops off 24 teeth in a turn."""
    (folder / "r.toml").write_text(RATCHET.format(format=form, tolerance=tolerance, turns=turns), encoding="utf-8")
    assert run("build", folder / "r.toml", "--out", folder) == 0
    (film,) = json.loads((folder / "r" / "report.json").read_text("utf-8"))["files"]
    return dict(film)


@pytest.mark.parametrize(("tolerance", "told"), [(1e-4, True), (0.02, False)])
def test_a_film_that_is_coarser_than_asked_says_so(tmp_path: Path, tolerance: float, told: bool) -> None:
    film = of_ratchet(tmp_path, "glb", tolerance, 0.03)
    assert (film["max_error"] > tolerance) == told
    assert [f["code"] for f in film["findings"]] == ["coarser_than_asked"] * told


@pytest.mark.parametrize("form", ["motion", "glb"])
def test_a_film_has_many_values_only_where_they_are_needed(form: str, tmp_path: Path) -> None:
    """At even times it would have those of its steepest fall throughout: 16 000, and not be as near as asked."""
    film = of_ratchet(tmp_path, form, 0.02)
    assert film["max_error"] <= 0.02
    if form == "glb":
        scene, blob = opened(tmp_path / "r" / film["path"])
        times = [numbers(scene, blob, one["input"])[:, 0] for one in scene["animations"][0]["samplers"]]
    else:
        text = (tmp_path / "r" / film["path"]).read_text("utf-8")
        times = [np.array([float(x) for x in row.split(";")]) for row in re.findall('keyTimes="([^"]*)"', text)]
    most = max(times, key=len)
    assert len(most) < 1500
    assert np.diff(most).min() < most[-1] / 10_000


TIMES = {
    "late": (r'keyTimes="0;', 'keyTimes="0.001;', "do not go through its loop"),
    "back": (r'(keyTimes="0;[\d.]+;)[\d.]+', r"\g<1>0.0000001", "do not go through its loop"),
    "too soon": (r'(keyTimes="0;[^"]*);1"', r'\g<1>;0.9999"', "do not go through its loop"),
    "twice": (r'(keyTimes="0;)([\d.]+;)[\d.]+;', r"\g<1>\g<2>\g<2>", "do not go through its loop"),
    "one less": (r'(keyTimes="0;)[\d.]+;', r"\g<1>", "do not go through its loop"),
    "another": (r'(keyTimes="(?:[\d.]+;){9})[\d.]+;(0\.\d*?)(\d\d?);', r"\g<1>\g<2>;\g<2>\g<3>;", "off its place"),
    "no number": (r'(keyTimes="0;)[\d.]+', r"\g<1>x", "a time of a motion is no number"),
}


def test_spoiled_times_are_seen(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "r" / of_ratchet(tmp_path, "motion", 0.02)["path"]
    text = file.read_text(encoding="utf-8")
    assert run("verify", file) == 0
    for name, (old, new, said) in TIMES.items():
        spoiled = re.sub(old, new, text, count=1)
        assert spoiled != text, name
        file.write_text(spoiled, encoding="utf-8")
        capsys.readouterr()
        assert run("verify", file) == 1, name
        assert said in capsys.readouterr().out, name


def test_a_scene_without_drives_has_no_film() -> None:
    with pytest.raises(SceneError, match="shows what a drive moves"):
        planned(FREE + GLB)


@pytest.mark.parametrize(
    "axis",
    [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.6, 0.0, -0.8), (2 / 3, -1 / 3, 2 / 3)],
)
@pytest.mark.parametrize("angle", [0.0, 0.7, -2.5, 4.0])
def test_a_quaternion_turns_as_places_do(axis: tuple[float, float, float], angle: float) -> None:
    """v + 2 u x (u x v + w v) of unit vectors, against a turn about z laid on the axis."""
    x, y, z, w = _quaternion(axis, angle)
    own = np.array([x, y, z])
    assert x * x + y * y + z * z + w * w == pytest.approx(1.0, abs=1e-14)
    rows = np.eye(3)
    turned = rows + 2 * np.cross(own, np.cross(own, rows) + w * rows)
    c, s = math.cos(angle), math.sin(angle)
    laid = np.array(Placement3.towards(axis, 0.0).rotation) @ np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    assert pytest.approx(laid, abs=1e-14) == turned.T

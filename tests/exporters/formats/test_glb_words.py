"""A small film as glTF: what is written, poses between its values, and each fault refused by its own words."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.formats.glb import SolidTrack, write_glb
from exporters.formats.read_glb import read_glb
from parts.base.readback import ReadError
from parts.solids.mesh import Mesh

CORNERS = np.array([[0, 0, 0], [8, 0, 0], [0, 8, 0], [0, 0, 8]], dtype=float)
FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
SECONDS = 4.0


def turn(angle: float, axis: tuple[float, float, float] = (0.0, 0.0, 1.0)) -> np.ndarray:
    """A quaternion x y z w."""

    return np.array([*(math.sin(angle / 2) * x for x in axis), math.cos(angle / 2)])


PLACES = np.array([[0.0, 0, 0], [4, 0, 0], [4, 6, 0], [0, 6, 2], [1, 2, 3]])
WHEN = np.array([0.0, 0.1, 0.35, 0.4, 1.0])
HALVES = np.array([0.0, 0.5, 1.0])
ENDS = np.array([0.0, 1.0])
TURNS = np.array([turn(0.0), turn(1.1, (0.6, 0.0, 0.8)), -turn(2.0, (1.0, 0.0, 0.0))])


@pytest.fixture(scope="module")
def film(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """A body that turns and moves, one that turns in its place, one that stays."""
    file = tmp_path_factory.mktemp("film") / "f.glb"
    one, two = Mesh(CORNERS, FACES), Mesh(2 * CORNERS, FACES)
    tracks = [
        SolidTrack("a", "one", (WHEN, PLACES), (HALVES, TURNS)),
        SolidTrack("b", "two", (ENDS[:1], PLACES[4:]), (HALVES, TURNS)),
        SolidTrack("c", "one", (ENDS[:1], PLACES[3:4]), (ENDS[:1], TURNS[1:2])),
    ]
    write_glb(file, "Film", {"one": (one, "#ff8000"), "two": (two, "#0a0a0b")}, tracks, SECONDS)
    return file.read_bytes()


def opened(data: bytes) -> tuple[dict[str, Any], bytearray]:
    size = int.from_bytes(data[12:16], "little")
    return json.loads(data[20 : 20 + size]), bytearray(data[28 + size :])


def packed(scene: dict[str, Any], blob: bytes) -> bytes:
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    words = [n.to_bytes(4, "little") for n in (2, 28 + len(text) + len(blob), len(text), len(blob))]
    return b"glTF" + words[0] + words[1] + words[2] + b"JSON" + text + words[3] + b"BIN\0" + blob


def test_solids_stand_between_their_values_as_gltf_says(film: bytes, tmp_path: Path) -> None:
    """Places linear, turns by trimesh's slerp over the shorter way; before and behind the film as at its ends."""
    from trimesh.transformations import quaternion_matrix, quaternion_slerp

    (tmp_path / "f.glb").write_bytes(film)
    found = read_glb(tmp_path / "f.glb")
    assert found.seconds == SECONDS
    assert {name: track.solid for name, track in found.tracks.items()} == {"a": "one", "b": "two", "c": "one"}
    assert np.array_equal(found.solids["two"].vertices, 2 * CORNERS)
    assert np.array_equal(found.solids["one"].triangles, FACES)
    times = np.array([-1.0, 0.0, 0.3, 0.999, 1.0, 1.7, 2.0, 2.4, 3.9, 4.0, 5.0])
    ways = {"a": (PLACES, TURNS), "b": (PLACES[4:], TURNS), "c": (PLACES[3:4], TURNS[1:2])}
    for name, (places, turns) in ways.items():
        stand = found.tracks[name].stand(times, CORNERS)
        assert stand.shape == (len(times), 4, 3)
        for time, points in zip(times, stand, strict=True):
            share = min(max(time / SECONDS, 0.0), 1.0)
            at = np.array([np.interp(share, WHEN[: len(places)], column) for column in places.T])
            step = share * (len(turns) - 1)
            k = min(int(step), max(len(turns) - 2, 0))
            ends = [np.roll(turns[min(k + n, len(turns) - 1)], 1) for n in (0, 1)]
            laid = quaternion_matrix(quaternion_slerp(*ends, step - k))[:3, :3]
            assert np.allclose(points, CORNERS @ laid.T + at, atol=3e-6)


def test_colours_are_without_the_screen_s_curve_and_arrays_say_what_they_are(film: bytes) -> None:
    scene, blob = opened(film)
    shades = [m["pbrMetallicRoughness"]["baseColorFactor"] for m in scene["materials"]]
    # IEC 61966-2-1: 0x80 is 0.215861 of full light, 10 / 255 and 11 / 255 lie on both sides of its straight piece
    assert shades[0] == [1.0, 0.215861, 0.0, 1.0]
    assert shades[1] == pytest.approx([10 / 255 / 12.92, 10 / 255 / 12.92, 0.003347, 1.0], abs=2e-6)
    assert len(blob) == scene["buffers"][0]["byteLength"] == sum(v["byteLength"] for v in scene["bufferViews"])
    targets = [v.get("target") for v in scene["bufferViews"]]
    assert targets[:4] == [34962, 34963, 34962, 34963]
    assert set(targets[4:]) == {None}
    # times of as many values are told once: of five places and of three turns
    assert len(scene["accessors"]) == 4 + 2 + 3
    assert [len(a["samplers"]) for a in scene["animations"]] == [3]
    assert scene["nodes"][0]["scale"] == [0.001] * 3


Change = Callable[[dict[str, Any], bytearray], object]


def number(scene: dict[str, Any], blob: bytearray, path: str, at: int, value: float) -> None:
    """Another number in the values of what moves by its path."""
    film = scene["animations"][0]
    sampler = film["samplers"][next(c["sampler"] for c in film["channels"] if c["target"]["path"] == path)]
    told = scene["accessors"][sampler["output"]]
    start = scene["bufferViews"][told["bufferView"]]["byteOffset"] + 4 * at
    blob[start : start + 4] = np.float32(value).tobytes()


def timed(scene: dict[str, Any], blob: bytearray, at: int, value: float) -> None:
    """Another of the times of places, said in its bounds too."""
    told = scene["accessors"][scene["animations"][0]["samplers"][0]["input"]]
    start = scene["bufferViews"][told["bufferView"]]["byteOffset"]
    blob[start + 4 * at : start + 4 * at + 4] = np.float32(value).tobytes()
    values = np.frombuffer(blob, "<f4", told["count"], start)
    told |= {"min": [float(values.min())], "max": [float(values.max())]}


SPOILED: dict[str, tuple[Change, str]] = {
    "another table": (lambda s, b: s.update(extensionsUsed=["X"]), "holds .'extensionsUsed'., which"),
    "version": (lambda s, b: s["asset"].update(version="2.1"), "which our files do not"),
    "scene": (lambda s, b: s.update(scene=1), "which our files do not"),
    "buffer": (lambda s, b: s["buffers"][0].update(byteLength=8), "not as long as it says"),
    "two buffers": (lambda s, b: s["buffers"].append({"byteLength": 8}), "not as long as it says"),
    "count": (lambda s, b: s["accessors"][0].update(count=3), "accessor 0 does not fit its bytes"),
    "offset": (lambda s, b: s["bufferViews"][0].update(byteOffset=-4), "accessor 0 does not fit its bytes"),
    "beyond": (lambda s, b: s["bufferViews"][0].update(byteOffset=len(b) - 8), "accessor 0 does not fit its bytes"),
    "no number": (lambda s, b: number(s, b, "rotation", 2, np.nan), "a number of accessor . is none"),
    "least": (lambda s, b: s["accessors"][0].update(min=[0.0, 0.0, -1.0]), "says another min"),
    "most": (lambda s, b: s["accessors"][0].update(max=[9.0, 8.0, 8.0]), "says another max"),
    "lines": (lambda s, b: s["meshes"][0]["primitives"][0].update(mode=1), "one is not a mesh of triangles"),
    "colours": (lambda s, b: s["meshes"][1]["primitives"][0]["attributes"].update(COLOR_0=0), "two is not a mesh"),
    "corners": (lambda s, b: b.__setitem__(slice(48, 52), (4).to_bytes(4, "little")), "corners that are not there|max"),
    "names": (lambda s, b: s["meshes"][1].update(name="one"), "has two solids one"),
    "scenes": (lambda s, b: s["scenes"][0].update(nodes=[0, 1]), "millimetres upright"),
    "children": (lambda s, b: s["nodes"][0].update(children=[1, 2]), "millimetres upright"),
    "scale": (lambda s, b: s["nodes"][0].update(scale=[0.001, 0.001, -0.001]), "millimetres upright"),
    "root": (lambda s, b: s["nodes"][0].update(rotation=[0.7072, 0.0, 0.0, 0.7071]), "millimetres upright"),
    "moved": (lambda s, b: s["nodes"][0].update(translation=[1.0, 0.0, 0.0]), "millimetres upright"),
    "twice": (lambda s, b: s["nodes"][2].update(name="a"), "has two instances a"),
    "stretched": (lambda s, b: s["nodes"][3].update(scale=[1.0, 1.0, 1.1]), "instance c is not one solid"),
    "two places": (lambda s, b: s["nodes"][1].update(translation=[1.0, 0.0, 0.0]), "instance a is not one solid"),
    "width": (lambda s, b: s["nodes"][3].update(translation=[1.0, 0.0]), "instance c has a place or turn of the wrong"),
    "turn": (lambda s, b: s["nodes"][3].update(rotation=[1.0, 0.0, 0.0]), "instance c has a place or turn of the wr"),
    "long": (lambda s, b: s["nodes"][3].update(rotation=[0.0, 0.0, 0.0, 1.00001]), "c has a turn that is none"),
    "nothing": (lambda s, b: s["animations"][0]["channels"][0]["target"].update(path="scale"), "moves wh|not one"),
    "nobody": (lambda s, b: s["animations"][0]["channels"].append(
        {"sampler": 0, "target": {"node": 9, "path": "rotation"}}), "moves what is not there"),
    "both": (lambda s, b: s["animations"][0]["channels"][2]["target"].update(node=1), "node 1 has more than one"),
    "steps": (lambda s, b: s["animations"][0]["samplers"][0].update(interpolation="STEP"), "another one than linear"),
    "fewer times": (lambda s, b: s["animations"][0]["samplers"][0].update(
        input=s["animations"][0]["samplers"][1]["input"]), "another one than linear"),
    "late": (lambda s, b: timed(s, b, 0, 0.5), "times do not rise from 0"),
    "backwards": (lambda s, b: timed(s, b, 2, 0.4), "times do not rise from 0"),
    "longer": (lambda s, b: timed(s, b, 4, 5.0), "unlike times for their loop"),
    "another film": (lambda s, b: s["animations"].append({"channels": [], "samplers": []}), "unlike times"),
}  # fmt: skip


def test_each_fault_is_refused_by_its_own_words(film: bytes, tmp_path: Path) -> None:
    file = tmp_path / "f.glb"
    for name, (change, said) in SPOILED.items():
        scene, blob = opened(film)
        file.write_bytes(packed(scene, bytes(blob)))
        assert read_glb(file).seconds == SECONDS, name
        change(scene, blob)
        file.write_bytes(packed(scene, bytes(blob)))
        with pytest.raises(ReadError, match=said):
            read_glb(file)


@pytest.mark.parametrize("at", [0, 4, 8, 16, -1])
def test_another_head_or_length_is_refused(at: int, film: bytes, tmp_path: Path) -> None:
    spoilt = bytearray(film) if at >= 0 else bytearray(film[:-4])
    if at >= 0:
        spoilt[at] ^= 1
    (tmp_path / "f.glb").write_bytes(spoilt)
    with pytest.raises(ReadError, match="does not begin"):
        read_glb(tmp_path / "f.glb")


@pytest.mark.parametrize(("share", "good"), [(1 + 1e-7, True), (1.00001, False), (0.99999, False)])
def test_one_turn_of_a_film_that_is_none_is_told(film: bytes, tmp_path: Path, share: float, good: bool) -> None:
    """The second of three turns of a body, longer or shorter than a unit."""
    scene, blob = opened(film)
    held = np.frombuffer(blob, "<f4")
    windows = np.lib.stride_tricks.sliding_window_view(held, 4)
    at = 4 * int(np.argmin(np.abs(windows - TURNS[1]).max(axis=1)))
    assert np.frombuffer(blob[at : at + 16], "<f4") == pytest.approx(TURNS[1], abs=1e-6)
    del held, windows
    blob[at : at + 16] = (share * TURNS[1]).astype("<f4").tobytes()
    file = tmp_path / "f.glb"
    file.write_bytes(packed(scene, blob))
    if good:
        assert len(read_glb(file).tracks["a"].turns[1]) == 3
    else:
        with pytest.raises(ReadError, match="a has a turn that is none"):
            read_glb(file)

"""Films of bevel scenes, read here by own readers: where a file has each solid against the places of the scene."""

from __future__ import annotations

import json
import math
import re
import struct
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.production.plan import plan_build
from exporters.production.train_sheets import train_picture
from geometry.kinematics.mechanism import Rolling
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, make_parts, scene_from_dict
from parts.scene.placing import place
from tests.exporters.making import read_report
from tests.parts.gears.bevel.test_bevel_differential import frame, frames, laid_differential, meshes, stood


class Film:
    """A GLB: the frame (3, 4), mm, of each node at a share of its loop, by glTF 2.0 alone."""

    def __init__(self, file: Path) -> None:
        data = file.read_bytes()
        size = struct.unpack("<I", data[12:16])[0]
        self.doc, self.rest = json.loads(data[20 : 20 + size]), data[20 + size + 8 :]
        self.ways: dict[tuple[str, str], tuple[np.ndarray, np.ndarray]] = {}
        for channel in self.doc["animations"][0]["channels"]:
            sampler = self.doc["animations"][0]["samplers"][channel["sampler"]]
            name = self.doc["nodes"][channel["target"]["node"]]["name"]
            times, values = (self._numbers(sampler[key]) for key in ("input", "output"))
            self.ways[name, channel["target"]["path"]] = times[:, 0], values
        self.seconds = max(float(times[-1]) for times, _ in self.ways.values())

    def _numbers(self, index: int) -> np.ndarray:
        accessor = self.doc["accessors"][index]
        view = self.doc["bufferViews"][accessor["bufferView"]]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[accessor["type"]]
        start = view.get("byteOffset", 0) + accessor.get("byteOffset", 0)
        found = np.frombuffer(self.rest, "<f4", accessor["count"] * width, start)
        return found.reshape(-1, width).astype(float)

    def _value(self, name: str, path: str, share: float, default: list[float]) -> np.ndarray:
        node = next(n for n in self.doc["nodes"] if n.get("name") == name)
        if (name, path) not in self.ways:
            return np.array(node.get(path, default), dtype=float)
        times, values = self.ways[name, path]
        k = min(max(int(np.searchsorted(times, share * self.seconds)) - 1, 0), len(times) - 2)
        part = (share * self.seconds - times[k]) / (times[k + 1] - times[k])
        a, b = values[k], values[k + 1]
        if path == "translation":
            return np.asarray(a + part * (b - a))
        b = b if a @ b >= 0 else -b
        angle = math.acos(min(float(a @ b), 1.0))
        if angle < 1e-6:
            return np.asarray(a)
        return np.asarray((math.sin((1 - part) * angle) * a + math.sin(part * angle) * b) / math.sin(angle))

    def stands(self, name: str, share: float) -> np.ndarray:
        x, y, z, w = self._value(name, "rotation", share, [0.0, 0.0, 0.0, 1.0])
        turned = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                  [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                  [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]  # fmt: skip
        return np.column_stack([turned, self._value(name, "translation", share, [0.0, 0.0, 0.0])])


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("films")
    for name in ("bevel_differential", "bevel_reducer"):
        assert main(["build", name, "--out", str(out), "--format", "glb", "--format", "motion", "--no-verify"]) == 0
    return out


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["bevel_differential", "bevel_reducer"])
def test_solids_stand_in_the_film_as_the_scene_has_them(name: str, built: Path) -> None:
    """Corners of every solid within what the file declares, at shares of the loop that no value stands at."""
    file = load_scene(name)
    parts, matings = make_parts(file, name)
    placing = place(file.instances, file.drives, parts, matings, name)
    film = Film(built / name / f"{name}.glb")
    entry = next(e for e in read_report(built / name)["files"] if e["path"].endswith("glb"))
    loop = entry["drive"] / file.drives[0].turns
    probes = np.column_stack([30 * np.eye(3), np.zeros(3)]).T
    probes = np.column_stack([probes, np.ones(4)])
    for share in (0.0, 0.123, 0.777):
        for instance in placing.at([share * loop * drive.turns for drive in file.drives]):
            wanted, found = frame(instance) @ probes.T, film.stands(instance.id, share) @ probes.T
            assert np.abs(wanted - found).max() <= entry["max_error"] * 30 / 20 + 1e-4, instance.id


def svg_pose(text: str, name: str, share: float) -> tuple[complex, float]:
    """Place, y up, and turn (degrees, counter-clockwise) of a track at a share of its loop, straight between values."""
    own = text[text.index(f'<g id="{name}"') :]
    own = own[: own.index("<path")]

    def at(kind: str) -> np.ndarray:
        moved = re.search(rf'type="{kind}"[^>]*values="([^"]*)"', own)
        still = re.search(rf"{kind}\(([^)]*)\)", own)
        assert still is not None
        rows = [[float(x) for x in row.split(",")] for row in (moved[1].split(";") if moved else [still[1]] * 2)]
        values = np.array(rows)
        told = re.search(rf'type="{kind}"[^>]*keyTimes="([^"]*)"', own)
        times = [float(x) for x in told[1].split(";")] if told else np.linspace(0, 1, len(values))
        return np.array([np.interp(share, times, column) for column in values.T])

    x, y = at("translate")
    return complex(x, -y), -float(at("rotate")[0])


def test_what_lies_is_seen_from_above_in_the_picture(built: Path) -> None:
    """A satellite goes round with the cage, the right gear, turned over, as fast as the side gears' sum has it."""
    text = (built / "bevel_differential" / "bevel_differential.motion.svg").read_text("utf-8")
    entry = next(e for e in read_report(built / "bevel_differential")["files"] if e["path"].endswith("svg"))
    loop = entry["drive"]
    start, now = (svg_pose(text, "one", share) for share in (0.0, 0.1))
    turned = math.radians(360 * 0.1 * loop)
    assert now[0] == pytest.approx(start[0] * complex(math.cos(turned), math.sin(turned)), abs=0.02)
    for name, rate in (("one", 1.0), ("cage", 1.0), ("pin", 1.0), ("left", 1.5), ("right", 0.5)):
        before, after = (svg_pose(text, name, share)[1] for share in (0.02, 0.1))
        assert math.remainder(after - before - 360 * rate * 0.08 * loop, 360) == pytest.approx(0.0, abs=0.1)
    # the silhouette of the satellite: its outer tip circle, at the cone distance, is the widest
    own = text[text.index('<g id="one"') :]
    path = re.search(r'd="M([^"]*)Z"', own)
    assert path is not None
    corners = np.array([[float(x) for x in pair.split(",")] for pair in re.findall(r"-?[\d.e-]+,-?[\d.e-]+", path[1])])
    gear = load_scene("bevel_differential").parts["satellite"]
    delta = math.atan2(gear.number_of_teeth, gear.mate_number_of_teeth)
    widest = gear.module * gear.number_of_teeth / 2 + gear.module * math.cos(delta)
    assert np.abs(corners[:, 1]).max() == pytest.approx(widest, abs=0.02)


def test_what_goes_round_an_axis_that_lies_is_for_solids_alone() -> None:
    """A satellite of a laid differential: its silhouette changes."""
    drives = ("ring", 1.0), ("left", 1.0)
    raw = laid_differential([0.0, 1.0, 0.0], *drives, exports=[{"format": "motion"}])
    with pytest.raises(SceneError) as caught:
        plan_build(scene_from_dict(raw, "s", "s"), "s", [], ["motion"])
    assert "tilts" in str(caught.value)
    assert "glb" in str(caught.value)
    placing, _ = stood(raw)
    assert all(condition.met for mate in placing.mates for condition in mate.conditions)


def test_a_spur_stage_goes_on_from_a_laid_shaft(capsys: pytest.CaptureFixture[str]) -> None:
    """16 / 32 and 16 / 48: six turns of the input are one of the output; its teeth by meshes keep half the backlash."""
    assert main(["check", "bevel_reducer"]) == 0
    said = capsys.readouterr().out
    assert "bevel_pinion = 6, bevel_wheel = -3, wheel = 1" in said
    file = load_scene("bevel_reducer")
    parts, matings = make_parts(file, "s")
    placing = place(file.instances, file.drives, parts, matings, "s")
    solids = meshes({key: parts[key] for key in ("pinion", "wheel")})
    for turns in (0.0, 0.37):
        stands = frames(placing, turns)
        one, two = (solids[name].transform(stands[name]) for name in ("pinion", "wheel"))
        assert (one ^ two).volume() < 1e-6
        assert one.min_gap(two, 1.0) == pytest.approx(0.05, abs=0.02)
    moved = stands["wheel"][:, :3] @ frames(placing, 0.0)["wheel"][:, :3].T
    assert np.trace(moved) == pytest.approx(1 + 2 * math.cos(2 * math.pi * 0.37 / 6), abs=1e-9)


def test_the_scheme_of_a_train_is_that_of_its_gears_on_parallel_axes_wherever_these_lie() -> None:
    """What a bevel pinion drives: u = -48 / 16, the axes a_w apart, though the scene sees both from the side."""
    file = load_scene("bevel_reducer")
    parts, matings = make_parts(file, "s")
    placing = place(file.instances, file.drives, parts, matings, "s")
    assert placing.train is not None
    joints = placing.train.moving.stands.mechanism.joints
    spurs = [joint for joint in joints if isinstance(joint, Rolling) and joint.kind == "external"]
    picture, rims = train_picture(placing.train, spurs, placing.instances)
    assert rims == ["pinion", "wheel"]
    assert [link.rate for link in picture.links] == [1, Fraction(-16, 48)]
    (pair,) = (m.mating for m in placing.mates if m.mating.kind == "external_gear_pair")
    assert picture.links[1].axis - picture.links[0].axis == pytest.approx(pair.distance, abs=1e-9)

"""Files of ratchets: sizes read by ezdxf, what is spoiled is caught, idle turns and forces of the calculation."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

from exporters.formats.read_dxf import read_dxf
from geometry.base.record import replace
from parts.ratchets.probe import SeatProbe, ToothProbe
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.making import read_report, run, write_scene

WHEEL: dict[str, Any] = {"kind": "ratchet_wheel", "module": 5.0, "number_of_teeth": 16, "face_width": 4.0}
PARTS: dict[str, dict[str, Any]] = {
    "wheel": WHEEL,
    "cut": WHEEL | {"notch_angle_deg": 55.0, "tip_land": 6.0, "turns": "cw"},
    "ring": WHEEL | {"number_of_teeth": 24, "internal": True},
    "pawl": {"kind": "pawl", "of": "wheel"},
    "cut_pawl": {"kind": "pawl", "of": "cut", "tail_length": 12.0},
    "ring_pawl": {"kind": "pawl", "of": "ring"},
}
EXPORTS = (
    {"format": "dxf"}, {"format": "dxf", "name": "kerf", "kerf": 0.2}, {"format": "svg"}, {"format": "stl"},
    {"format": "step"},
)  # fmt: skip


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the files of all."""
    root = tmp_path_factory.mktemp("ratchet")
    assert run("build", write_scene(root / "s.toml", PARTS, EXPORTS), "--out", root / "out") == 0
    return root / "out" / "s"


def test_edges_roots_and_seats_are_measured_in_every_file(built: Path) -> None:
    files = read_report(built)["files"]
    assert len(files) == 30
    for entry in files:
        found, off = entry["measured"], 2 * entry["max_error"] + 1e-6
        if "pawl" in entry["part"]:
            # moved out of the material it overlaps as much
            assert found["seat_gap"] == pytest.approx(-entry["offset"], abs=off)
        else:
            assert found["edge_off"] <= off
            assert found["root_off"] <= off


@pytest.mark.parametrize("name", ["wheel", "cut", "ring"])
def test_a_foreign_reader_finds_the_sizes(built: Path, name: str) -> None:
    """Bulges and vertices of ezdxf: circles, number, land and rounding, the front angle by the line of each face."""
    keys = PARTS[name]
    teeth, module, internal = keys["number_of_teeth"], keys["module"], keys.get("internal", False)
    lines = ezdxf.readfile(built / f"{name}.laser.dxf").modelspace().query("LWPOLYLINE")
    loops = [[(complex(x, y), bulge) for x, y, bulge in line.get_points("xyb")] for line in lines]
    (loop,) = [one for one in loops if len(one) > 3 * teeth]
    rounds, lands, faces, root = [], [], [], math.inf
    tip = module * teeth / 2
    for k, (start, bulge) in enumerate(loop):
        end = loop[(k + 1) % len(loop)][0]
        if bulge:
            sweep = 4 * math.atan(bulge)
            radius = abs(end - start) / 2 / abs(math.sin(sweep / 2))
            centre = (start + end) / 2 + 1j * (end - start) / 2 / math.tan(sweep / 2)
            if abs(centre) < 1e-5:
                lands.append((radius, radius * abs(sweep)))
            else:
                rounds.append(radius)
                root = min(root, abs(abs(centre) + (radius if internal else -radius) - tip))
        elif abs(start) < 1e-6 or abs((end - start) / (abs(end) - abs(start) or 1e9)) < 1.2:
            faces.append(abs((np.conj(end - start) * start).imag) / abs(end - start))
    on_tip = [length for radius, length in lands if math.isclose(radius, tip, abs_tol=1e-5)]
    assert len(on_tip) == teeth
    assert on_tip == pytest.approx([keys.get("tip_land", module)] * teeth, abs=1e-5)
    assert rounds == pytest.approx([0.1 * module] * len(rounds), abs=1e-5)
    assert root == pytest.approx(0.75 * module, abs=1e-5)
    wanted = tip * math.sin(math.radians(15))
    assert sum(math.isclose(one, wanted, abs_tol=1e-5) for one in faces) == teeth


@pytest.mark.parametrize("name", ["wheel", "cut", "ring"])
def test_a_wheel_that_is_not_the_right_one_is_caught(built: Path, name: str) -> None:
    parts, _ = make_parts(scene_from_dict({"parts": PARTS}, "t", "t"), "t")
    wheel, file = parts[name].thing, read_dxf(built / f"{name}.laser.dxf")
    assert ToothProbe(wheel, 2.0).run(file, 0.0, 1e-6).failures == ()
    for other, word in (
        (replace(wheel, tip_radius=wheel.tip_radius + 1e-3), "edge"),
        (replace(wheel, depth=wheel.depth + 1e-3), "root"),
        (replace(wheel, front_angle=wheel.front_angle + 1e-3), "root"),
        (replace(wheel, ccw=not wheel.ccw), "root"),
    ):
        assert any(word in failure for failure in ToothProbe(other, 2.0).run(file, 0.0, 1e-6).failures)


@pytest.mark.parametrize("name", ["pawl", "cut_pawl", "ring_pawl"])
def test_a_pawl_that_does_not_sit_is_caught(built: Path, name: str) -> None:
    parts, _ = make_parts(scene_from_dict({"parts": PARTS}, "t", "t"), "t")
    shape, file = parts[name].thing.shape, read_dxf(built / f"{name}.laser.dxf")
    assert SeatProbe(shape, 2.0).run(file, 0.0, 1e-6).failures == ()
    for other in (
        replace(shape, length=shape.length + 1e-3),
        replace(shape, line_angle=shape.line_angle + 1e-4),
        replace(shape, wheel=replace(shape.wheel, ccw=not shape.wheel.ccw)),
    ):
        assert SeatProbe(other, 2.0).run(file, 0.0, 1e-6).failures


def calculated(capsys: pytest.CaptureFixture[str], *words: str) -> dict[str, Any]:
    capsys.readouterr()
    assert run("calc", "ratchet", *words, "--format", "json") == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def test_idle_turn_and_forces(capsys: pytest.CaptureFixture[str]) -> None:
    """360 / (z n) of pawls set evenly; F = 2 T / D; else the greatest way between two."""
    even = calculated(capsys, "ratchet", "part=wheel", "torque=20", "face_width=4")["values"]
    assert even["idle_turn_deg"] == pytest.approx(360 / (16 * 2))
    assert even["ratchet_force"] == pytest.approx(2 * 20 / 0.080)
    assert even["line_load"] == pytest.approx(500 / 4)
    assert even["pawl_friction_angle_deg"] == pytest.approx(math.degrees(math.atan(0.15)))
    three = calculated(capsys, "module=5", "number_of_teeth=16", "pawls_at=[1, 5.25, 9.5]")["values"]
    assert three["idle_turn_deg"] == pytest.approx(22.5 / 2)
    thirds = calculated(capsys, "module=5", "number_of_teeth=16", f"pawls_at=[1, {5 + 1 / 3}, {9 + 2 / 3}]")["values"]
    assert thirds["idle_turn_deg"] == pytest.approx(22.5 / 3)
    # the law of cosines of axis, edge and pivot
    leaned = calculated(capsys, "module=5", "number_of_teeth=16", "length=30", "line_angle_deg=10")["values"]
    square = 40**2 + 30**2 - 2 * 40 * 30 * math.cos(math.radians(100))
    assert leaned["pivot_distance"] == pytest.approx(math.sqrt(square))

"""Files of cycloidal discs and lantern gears, held against swept pins; spoiled ones and broken scenes are caught."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely

from tests.exporters import spoil
from tests.exporters.making import chains_of, read_report, run, table, write_scene
from tests.oracles.pin_sweep import disc_pins, lantern_pins, least_distance

DISC: dict[str, Any] = {
    "kind": "cycloidal_disc", "number_of_lobes": 11, "pin_circle_diameter": 80.0, "pin_diameter": 8.0,
    "eccentricity": 2.5, "bore_diameter": 22.0, "face_width": 5.0,
    "output_holes": {"count": 6, "pitch_circle_diameter": 46.0, "pin_diameter": 6.0},
}  # fmt: skip
GEAR: dict[str, Any] = {
    "kind": "lantern_gear", "number_of_teeth": 30, "number_of_pins": 10, "pin_circle_diameter": 60.0,
    "pin_diameter": 8.0, "bore_diameter": 10.0, "face_width": 5.0,
}  # fmt: skip
EXPORTS = ({"format": "dxf"}, {"format": "dxf", "name": "cut", "kerf": 0.2}, {"format": "svg"}, {"format": "stl"})
SHARES = {"start": 0.0, "middle": 0.5, "end": 1.0}


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a disc's and a gear's files."""
    root = tmp_path_factory.mktemp("pins")
    scene = write_scene(root / "s.toml", {"disc": DISC, "gear": GEAR}, EXPORTS)
    assert run("build", scene, "--out", root / "out") == 0
    return root / "out" / "s"


def away(name: str, points: np.ndarray) -> np.ndarray:
    """How far points of a file lie outside the body that the swept pins leave, mm, negative inside."""
    if name == "disc":
        centres, drive = disc_pins(12, 40.0, 2.5)[:1], np.linspace(0, 22 * math.pi, 6601)
        turn = cmath.exp(1j * math.pi / 11)
    else:
        centres, drive = lantern_pins(10, 30, 30.0), np.linspace(-1.2, 1.2, 1201)
        turn = cmath.exp(1j * math.pi / 30)
        # into the space on +x
        step = 2 * math.pi / 30
        points = points * np.exp(-1j * step * np.round(np.angle(points * turn) / step))
    return 4.0 - np.array([least_distance(complex(p) * turn, centres, drive) for p in points])


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["disc", "gear"])
def test_files_lie_on_what_the_pins_leave(built: Path, name: str) -> None:
    entries = [e for e in read_report(built)["files"] if e["part"] == name]
    assert len(entries) == 4
    for entry in entries:
        outline = chains_of(built / entry["path"])[-1]
        points = outline.dense(3).ravel()
        points = points[:: max(1, len(points) // 60)]
        if name == "gear":
            # the tip land is cut by no pin
            points = points[np.abs(points) < 100.3]
        found = away(name, points) - entry["offset"]
        # the cut has round corners where flank and root meet
        inside = found[found < 0.02] if entry["offset"] and name == "gear" else found
        assert np.abs(inside).max() <= entry["max_error"] + 1e-9
        assert np.abs(inside).max() <= entry["tolerance"]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("where", SHARES)
@pytest.mark.parametrize("change", [spoil.moved, spoil.dropped, spoil.flattened_or_bent], ids=lambda c: c.__name__)
@pytest.mark.parametrize("name", ["disc", "gear"])
def test_a_spoiled_outline_is_caught(built: Path, tmp_path: Path, name: str, change: Any, where: str) -> None:
    for file in ("report.json", f"{name}.laser.dxf"):
        (tmp_path / file).write_bytes((built / file).read_bytes())
    file = tmp_path / f"{name}.laser.dxf"
    assert run("verify", file) == 0
    spoil.change_dxf(file, -1, change, SHARES[where])
    assert run("verify", file) == 1


def test_check_tells_a_wrong_phase(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ring = {"kind": "pin_ring", "number_of_pins": 12, "pin_circle_diameter": 80.0, "pin_diameter": 8.0, "pins": "fixed",
            "inner_diameter": 83.0}  # fmt: skip
    mate = {"kind": "cycloidal_pair", "first": "ring", "second": "disc"}
    for turn, code in ((180 / 11, 0), (180 / 11 + 0.1, 1)):
        tail = table("[instances.ring]", {"at": [0.0, 0.0, 0.0]})
        tail += table("[instances.disc]", {"at": [2.5, 0.0, 0.0], "rotation_deg": turn})
        tail += table("[[mates]]", mate) + table("[checks]", {"interference": True})
        scene = write_scene(tmp_path / "s.toml", {"ring": ring, "disc": DISC}, [{"format": "svg"}], head="")
        scene.write_text(scene.read_text() + tail, encoding="utf-8")
        capsys.readouterr()
        assert run("check", scene) == code
        said = capsys.readouterr().out
        assert ("CONTACT" in said) is (code == 0)
        assert ("BROKEN" in said) is (code == 1)


@pytest.mark.heavy
def test_lost_motion_is_how_far_the_disc_of_a_file_turns_between_its_pins(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Every stop by bisection. By the first order of the gaps it was told a tenth more: 1.762 degrees for 1.606."""
    lobes, radius, pin, arm = 3, 100.0, 27.71, 22.85
    parts = {
        "ring": {"kind": "pin_ring", "number_of_pins": lobes + 1, "pin_circle_diameter": 2 * radius,
                 "pin_diameter": 2 * pin, "inner_diameter": 240.0, "outer_diameter": 300.0},
        "disc": {"kind": "cycloidal_disc", "number_of_lobes": lobes, "pin_circle_diameter": 2 * radius,
                 "pin_diameter": 2 * pin, "eccentricity": arm, "pin_clearance": 0.44, "pin_circle_shift": 0.5},
    }  # fmt: skip
    exports = [{"format": "dxf", "curves": "lines", "tolerance": 1e-4, "parts": ["disc"]}]
    mate = '[[mates]]\nkind = "cycloidal_pair"\nfirst = "ring"\nsecond = "disc"\n'
    file = write_scene(tmp_path / "s.toml", parts, exports, head=mate)
    assert run("build", file, "--out", tmp_path, "--quiet") == 0
    capsys.readouterr()
    run("check", file, "--json")
    told = json.loads(capsys.readouterr().out)["mates"][0]
    chain = max(ezdxf.readfile(tmp_path / "s" / "disc.dxf").modelspace().query("LWPOLYLINE"), key=len)
    outline = shapely.Polygon(chain.get_points("xy"))
    shapely.prepare(outline)
    pins = radius * np.exp(2j * np.pi * np.arange(lobes + 1) / (lobes + 1))

    def stops(angle: float, turn: float) -> bool:
        stand = math.radians(told["second_rotation_deg"]) - angle / lobes + turn
        seen = (pins - arm * np.exp(1j * angle)) * np.exp(-1j * stand)
        places = shapely.points(seen.real, seen.imag)
        return bool((shapely.contains(outline, places) | (shapely.distance(outline, places) < pin)).any())

    found = []
    for angle in (np.arange(96) + 0.5) / 96 * 2 * math.pi / (lobes + 1):
        play = 0.0
        for way in (1, -1):
            free, stopped = 0.0, math.radians(10.0)
            for _ in range(16):
                middle = (free + stopped) / 2
                free, stopped = (free, middle) if stops(angle, way * middle) else (middle, stopped)
            play += free
        found.append(math.degrees(play))
    assert told["lost_motion_deg"] == pytest.approx(max(found), rel=1e-3)

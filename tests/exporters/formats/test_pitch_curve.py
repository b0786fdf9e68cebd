"""The pitch curve of cams in drawings: where the follower's centre runs, on a layer of its own."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
from ezdxf.document import Drawing

from tests.exporters.making import read_report, run, write_scene
from tests.offered import cam, scenes

DRAWING = {"format": "dxf", "purpose": "drawing", "pitch_curve": True}
# a fit takes its time by its tolerance
COARSE = DRAWING | {"tolerance": 1e-4}
LAYER = "PITCH_CURVE"


def built(folder: Path, parts: dict[str, Any], *exports: dict[str, Any], verified: bool = True) -> int:
    """The exit code of a build of some parts, by default as drawings with pitch curves."""
    scene = write_scene(folder / "s.toml", parts, list(exports or (DRAWING,)))
    return run("build", scene, "--out", folder, *(() if verified else ("--no-verify",)))


def points_of(file: Path, layer: str = LAYER) -> np.ndarray:
    """Dense points of what stands on a layer."""
    found: list[complex] = []
    for entity in ezdxf.readfile(file).modelspace().query(f'*[layer=="{layer}"]'):
        if entity.dxftype() == "SPLINE":
            tool = entity.construction_tool()
            found += [complex(p.x, p.y) for p in tool.points(np.linspace(tool.knots()[0], tool.knots()[-1], 1_000))]
        else:
            dxf = entity.dxf
            last = dxf.start_angle + (dxf.end_angle - dxf.start_angle) % 360
            angles = np.radians(np.linspace(dxf.start_angle, last, 1_000))
            found += (complex(dxf.center.x, dxf.center.y) + dxf.radius * np.exp(1j * angles)).tolist()
    return np.array(found)


def farthest(points: np.ndarray, others: np.ndarray) -> float:
    """Greatest distance of points from others that are dense."""
    from scipy.spatial import cKDTree

    tree = cKDTree(np.stack([others.real, others.imag], axis=1))
    return float(tree.query(np.stack([points.real, points.imag], axis=1))[0].max())


def sine(u: np.ndarray) -> np.ndarray:
    return u - np.sin(2 * np.pi * u) / (2 * np.pi)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", ["cam", "groove_cam"])
def test_the_centre_of_a_roller_runs_along_it(tmp_path: Path, kind: str) -> None:
    """e + i (s_0 + S) in the frame of a cam that turns: s_0^2 = (R_b + r)^2 - e^2; both ways."""
    from scipy.spatial import cKDTree

    lift, base, radius, aside = 20.0, 30.0, 8.0, 5.0
    move = {"move": "rise", "angle_deg": 180.0, "law": "sine"}
    keys = cam(lift=lift, base_circle_radius=base, follower_radius=radius, follower_offset=aside,
               phases=[move, move | {"move": "return_"}])  # fmt: skip
    if kind == "groove_cam":
        keys = {k: v for k, v in keys.items() if k != "follower"} | {"kind": kind, "groove_depth": 5.0}
    # it is read back in the tests beside this one
    assert built(tmp_path, {"p": keys}, COARSE, verified=False) == 0
    (file,) = read_report(tmp_path / "s")["files"]
    assert file["pitch_curve"]
    t = np.linspace(0, 2 * np.pi, 400_001)
    rise = lift * sine(np.minimum(t, 2 * np.pi - t) / np.pi)
    path = np.exp(-1j * t) * (aside + 1j * (math.sqrt((base + radius) ** 2 - aside**2) + rise))
    points = points_of(tmp_path / "s" / "p.dxf")
    # between points of the path, 1e-3 mm apart, its own bow is some 1e-9 mm: what counts is across
    assert farthest(points, path) < 6e-4
    # and it is whole: no place of the path is farther than its own points are apart
    assert farthest(path[::500], points) < 0.6 * np.abs(np.diff(path)).max() * 400_000 / len(points)
    near = cKDTree(np.stack([path.real, path.imag], axis=1)).query(np.stack([points.real, points.imag], axis=1))[1]
    way = np.exp(1j * np.angle(np.roll(path[:-1], -1) - np.roll(path[:-1], 1)))[near % (len(path) - 1)]
    assert np.abs(((points - path[near]) * np.conj(way)).imag).max() <= file["max_error"] + 2e-9


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["swinging roller", "mushroom"])
def test_other_round_followers_have_one_too(tmp_path: Path, name: str) -> None:
    from scipy.spatial import cKDTree

    keys = copy.deepcopy(scenes()[name]["parts"]["p"])
    assert built(tmp_path, {"p": keys}, COARSE, verified=False) == 0
    file = tmp_path / "s" / "p.dxf"
    points, outline = points_of(file), points_of(file, "OUTLINE")
    tree = cKDTree(np.stack([outline.real, outline.imag], axis=1))
    gaps = tree.query(np.stack([points.real, points.imag], axis=1))[0]
    assert np.abs(gaps - keys["follower_radius"]).max() < 2e-3
    assert run("verify", file) == 0


def test_a_conjugate_pair_has_both_paths_beside_what_has_none(tmp_path: Path) -> None:
    raw = scenes()["conjugate_cams"]["parts"]
    parts = {key: part for key, part in raw.items() if part["kind"] in ("cam", "conjugate_cam")}
    parts["gear"] = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 12}
    assert built(tmp_path, parts, COARSE, verified=False) == 0
    told = {f["part"]: f.get("pitch_curve", False) for f in read_report(tmp_path / "s")["files"]}
    assert told == {key: part["kind"] != "spur_gear" for key, part in parts.items()}


def moved(drawing: Drawing) -> None:
    """A pole of a spline in its middle."""
    spline = drawing.modelspace().query(f'SPLINE[layer=="{LAYER}"]')[0]
    poles = [list(p) for p in spline.control_points]
    poles[len(poles) // 2][0] += 1e-4
    spline.control_points = poles


def on_layer(change: Callable[[Drawing, Any], object]) -> Callable[[Drawing], None]:
    """Every entity of the pitch curve changed."""

    def spoil(drawing: Drawing) -> None:
        for entity in list(drawing.modelspace().query(f'*[layer=="{LAYER}"]')):
            change(drawing, entity)

    return spoil


SPOILS: dict[str, tuple[Callable[[Drawing], object], str]] = {
    "moved": (moved, "pitch curve: deviates"),
    "gone": (on_layer(lambda d, e: d.modelspace().delete_entity(e)), "pitch curve: 0 contours instead of 1"),
    "among outlines": (on_layer(lambda d, e: e.dxf.set("layer", "OUTLINE")), "2 contours instead of 1"),
    "off": (lambda d: d.layers.get(LAYER).off(), f"layer {LAYER} is off"),
    "as an outline": (lambda d: setattr(d.layers.get(LAYER), "color", 7), f"layer {LAYER} looks otherwise"),
    "wide": (lambda d: d.layers.get("OUTLINE").dxf.set("lineweight", 200), "layer OUTLINE looks otherwise"),
}


@pytest.fixture(scope="module")
def good(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A drawing of a roller cam and its pitch curve."""
    folder = tmp_path_factory.mktemp("pitch")
    assert built(folder, {"p": cam()}, DRAWING | {"tolerance": 1e-5}) == 0
    return folder / "s"


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", SPOILS)
def test_a_spoiled_one_is_found(good: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    spoil, said = SPOILS[name]
    drawing = ezdxf.readfile(good / "p.dxf")
    spoil(drawing)
    drawing.saveas(tmp_path / "p.dxf")
    (tmp_path / "report.json").write_bytes((good / "report.json").read_bytes())
    assert run("verify", tmp_path / "p.dxf") == 1
    out, error = capsys.readouterr()
    assert said in out + error


def test_one_that_was_not_asked_for_is_found(good: Path, tmp_path: Path) -> None:
    report = (good / "report.json").read_text().replace('"pitch_curve": true', '"pitch_curve": false')
    (tmp_path / "report.json").write_text(report)
    (tmp_path / "p.dxf").write_bytes((good / "p.dxf").read_bytes())
    assert run("verify", tmp_path / "p.dxf") == 1


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("keys", "export", "said"),
    [(cam(), {"format": "dxf"}, 'only for purpose = "drawing"'),
     (cam(), {"format": "step"}, 'only for purpose = "drawing"'),
     ({"kind": "spur_gear", "module": 2.0, "number_of_teeth": 12}, DRAWING, "none of its parts has a pitch curve"),
     (cam(follower="pointed", follower_radius=0.0), DRAWING, "none of its parts has a pitch curve")],
)  # fmt: skip
def test_where_there_is_none_the_key_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], keys: dict[str, Any], export: dict[str, Any], said: str
) -> None:
    assert built(tmp_path, {"p": keys}, export | {"pitch_curve": True}) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "exports[1].pitch_curve = true" in told
    assert said in told

"""Reports of two plates and a pin, written without their files: all that is told of a build, and what is kept of it."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from exporters.production import report
from exporters.production.plan import Plan, plan_build
from parts.scene.load import resolved, scene_from_toml
from parts.scene.scene_file import SceneFile

SCENE = """
[parts.slab]
kind = "plate"
width = 30.0
height = 20.0
face_width = 4.0
density = 2.0
[parts.other]
kind = "plate"
width = 10.0
height = 5.0
face_width = 4.0
[instances]
slab = { at = [1.5, -2.0, 3.0], rotation_deg = 30.0 }
other = { at = [0.0, 9.0, 0.0], axis = [1.0, 0.0, 0.0] }
[[exports]]
format = "svg"
"""


@pytest.fixture(scope="module")
def plan() -> Plan:
    return plan_build(scene_from_toml(SCENE.encode(), "s.toml", "s"), "s", [], [])


def read_back(scene: SceneFile) -> Any:
    """A scene as a report has it."""
    return json.loads(json.dumps(resolved(scene)))


def written(
    plan: Plan, folder: Path, before: dict[str, Any] | None = None, previews: tuple[str, ...] = (),
    *, partial: bool = False, seconds: float = 1.0,
) -> tuple[dict[str, Any], list[str]]:  # fmt: skip
    for name in previews:
        (folder / name).write_bytes(name.encode())
    file = folder / "made.json"
    left = report.write_report(file, plan, [], [folder / name for name in previews], {"well": []}, seconds, folder,
                               before, partial=partial)  # fmt: skip
    text = file.read_bytes()
    assert text.endswith(b"\n}\n")
    return json.loads(text), left


def test_parts_places_and_previews_are_told(plan: Plan, tmp_path: Path) -> None:
    """30 x 20 x 4 mm of 2 g/cm3 weigh 4.8 g; nothing is told of the other, which is no solid and has no density."""
    found, left = written(plan, tmp_path, previews=("b.svg", "a.svg"), seconds=1.23456789)
    assert left == found["left_behind"] == found["files"] == found["failed"] == found["left_out"] == []
    assert found["scene"] == read_back(plan.scene)
    assert found["checks"] == {"well": []}
    slab, other = found["parts"]["slab"], found["parts"]["other"]
    assert slab["kind"] == other["kind"] == "plate"
    assert slab["mass"] == pytest.approx(4.8, rel=1e-12)
    assert {"kind", "findings"} <= other.keys() < slab.keys()
    assert not any("mass" in key for key in other)
    assert found["instances"] == {
        "slab": {"part": "slab", "at": [1.5, -2.0, 3.0], "rotation_deg": pytest.approx(30.0, abs=1e-12),
                 "placed_by": "at"},
        "other": {"part": "other", "at": [0.0, 9.0, 0.0], "rotation_deg": 0.0, "placed_by": "at",
                  "axis": [1.0, 0.0, 0.0]},
    }  # fmt: skip
    assert found["previews"] == [
        {"path": name, "bytes": 5, "sha256": hashlib.sha256(name.encode()).hexdigest()} for name in ("b.svg", "a.svg")
    ]
    assert found["run"]["seconds"] == 1.2346
    assert found["run"]["stages"] == {}
    assert not {"ezdxf", "lib3mf", "fpdf"} & found["versions"].keys()


@pytest.mark.parametrize(("system", "told"), [("linux", 3072.0), ("darwin", 3.0)])
def test_memory_is_told_in_megabytes(
    system: str, told: float, plan: Plan, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Linux tells KiB, macOS bytes (getrusage(2) of each)."""
    resource = pytest.importorskip("resource", reason="Windows has none")
    monkeypatch.setattr(resource, "getrusage", lambda who: SimpleNamespace(ru_maxrss=3 * 1024 * 1024 + 7 * (who != 0)))
    monkeypatch.setattr(report.sys, "platform", system)
    found, _ = written(plan, tmp_path)
    assert found["run"]["peak_memory_mb"] == told
    assert found["run"]["system"] == system


def entry(path: str, mark: int) -> dict[str, Any]:
    return {"path": path, "mark": mark}


@pytest.mark.parametrize("partial", [False, True])
@pytest.mark.parametrize("same", [False, True])
def test_what_an_earlier_build_made_stays_where_this_one_has_not_been(
    partial: bool, same: bool, plan: Plan, tmp_path: Path
) -> None:
    """Only a build of a part of the same scene keeps entries: all but those of its own paths, each kind in order.

    Files that no entry is left of are left behind as long as they lie there.
    """
    scene = read_back(plan.scene)
    before = {
        "scene": scene if same else {**scene, "parts": {}},
        "files": [entry("y.dxf", 1), entry("x.dxf", 2)], "failed": [entry("w.stl", 3)],
        "previews": [entry("z.svg", 4), entry("n.svg", 5)], "left_behind": ["old.svg", "gone.svg", "m.svg"],
    }  # fmt: skip
    for name in ("x.dxf", "z.svg", "old.svg", "m.svg", "w.stl"):
        (tmp_path / name).write_bytes(b"")
    found, left = written(plan, tmp_path, before, ("n.svg", "m.svg"), partial=partial)
    kept = partial and same
    assert [row["path"] for row in found["files"]] == ["x.dxf", "y.dxf"] * kept
    assert found["failed"] == [entry("w.stl", 3)] * kept
    assert [row["path"] for row in found["previews"]] == (["m.svg", "n.svg", "z.svg"] if kept else ["n.svg", "m.svg"])
    assert all("mark" not in row for row in found["previews"] if row["path"] in ("m.svg", "n.svg"))
    assert left == found["left_behind"] == (["old.svg"] if kept else ["old.svg", "x.dxf", "z.svg"])


def test_a_report_is_a_table_of_json_or_none(tmp_path: Path) -> None:
    assert report.read_report(tmp_path) is None
    assert report.read_report(tmp_path / "none") is None
    file = tmp_path / report.NAME
    for text in (b"", b"[]", b'"text"', b'{"scene": {', b"\xff{}", b"[" * 100_000):
        file.write_bytes(text)
        assert report.read_report(tmp_path) is None
        assert report.report_language(tmp_path / "any.svg") == "en"
    for scene, language in (
        ({}, "en"), ([], "en"), (None, "en"), ({"scene": {}}, "en"), ({"scene": {"language": "uk"}}, "uk"),
        ({"scene": {"language": "xx"}}, "en"),
    ):  # fmt: skip
        file.write_text(json.dumps({"scene": scene}), encoding="utf-8")
        assert report.read_report(tmp_path) == {"scene": scene}
        assert report.report_language(tmp_path / "any.svg") == language
    file.unlink()
    file.mkdir()
    with pytest.raises(IsADirectoryError):
        report.read_report(tmp_path)
    assert report.report_language(tmp_path / "any.svg") == "en"

"""Files of splined bores: the shaft goes in with the clearance that was told, and what is not so is caught."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from exporters.formats.read_dxf import read_dxf
from geometry.base.record import replace
from parts.keys.spline_probe import SplineProbe
from parts.keys.splines import InvoluteSplineTable, StraightSplineTable
from tests.exporters.making import read_report, run, write_scene

TABLES: dict[str, StraightSplineTable | InvoluteSplineTable] = {
    "straight": StraightSplineTable("D-6x23x26", clearance=0.2, angle_deg=40.0),
    "involute": InvoluteSplineTable("20x1", clearance=0.15),
}
BORES: dict[str, dict[str, Any]] = {
    "straight": {"shape": "spline", "size": "D-6\u044523\u044526H7/f7", "clearance": 0.2, "angle_deg": 40.0},
    "involute": {"shape": "involute_spline", "size": "20x1x9H", "clearance": 0.15},
}
EXPORTS = ({"format": "dxf"}, {"format": "dxf", "name": "cut", "kerf": 0.2}, {"format": "svg"}, {"format": "stl"})


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of the files of both, one with a chamfer."""
    root = tmp_path_factory.mktemp("spline")
    roller = {"kind": "roller", "diameter": 40.0, "face_width": 6.0}
    parts = {name: roller | {"bore": bore, "face_chamfer": 0.5} for name, bore in BORES.items()}
    assert run("build", write_scene(root / "s.toml", parts, EXPORTS), "--out", root / "out") == 0
    return root / "out" / "s"


def test_the_shaft_has_the_clearance_that_was_asked_for(built: Path) -> None:
    files = read_report(built)["files"]
    assert len(files) == 8
    for entry in files:
        wanted, off = TABLES[entry["part"]].clearance - entry["offset"], entry["max_error"] + 1e-6
        assert entry["measured"]["spline_gap"] == pytest.approx(wanted, abs=off)


@pytest.mark.parametrize("name", TABLES)
def test_another_shaft_is_caught(built: Path, name: str) -> None:
    """One that stands a tenth of a degree aslant, one that is looser, and one that is thicker."""
    bore, file = TABLES[name].bore(), read_dxf(built / f"{name}.laser.dxf")
    (good,) = TABLES[name].probes(3.0)
    assert good.run(file, 0.0, 5e-3).failures == ()
    thick = {"width": 6.02} if name == "straight" else {"thickness": bore.joint.thickness + 0.02}  # type: ignore[union-attr]
    for other in (
        replace(bore, angle=bore.angle + 0.0017),
        replace(bore, clearance=bore.clearance + 0.006),
        replace(bore, joint=replace(bore.joint, **thick)),
    ):
        (failure,) = SplineProbe(other, 3.0).run(file, 0.0, 5e-3).failures
        assert "clearance" in failure

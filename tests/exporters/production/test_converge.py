"""``higherpair converge``: error against run time as its table tells it, and the orders of the methods."""

from __future__ import annotations

import csv
import xml.etree.ElementTree as ET
from itertools import groupby, pairwise
from pathlib import Path

import numpy as np
import pytest

from exporters.production.converge import METHODS, orders
from exporters.production.plan import plan_build
from parts.scene.load import load_scene
from tests.exporters.making import part_keys, run, write_scene
from tests.exporters.outside import Gear

TEETH = 8


def test_errors_keep_their_bounds_and_fall_as_the_methods_do(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    # undercut: both curves of a tooth end where they cross
    scene = write_scene(tmp_path / "s.toml", {"g": part_keys(Gear(3.0, TEETH, bore=6.0))}, [{"format": "svg"}])
    assert run("converge", scene, "--out", tmp_path / "out") == 0
    assert "g.svg" in capsys.readouterr().out
    folder = tmp_path / "out" / "s"
    made = {"converge.csv", "converge.time.svg", "converge.pieces.svg"}
    assert {file.name for file in folder.iterdir()} == made
    files, curves = (folder / "converge.csv").read_text("utf-8").split("\n\n")
    rungs = list(csv.DictReader(files.splitlines()))
    tolerance, declared, measured, edges = (
        [float(row[name]) for row in rungs] for name in ("tolerance_mm", "declared_mm", "measured_mm", "edges")
    )
    assert all(0 < m <= d <= t for m, d, t in zip(measured, declared, tolerance, strict=True))
    assert len(rungs) == 10
    assert all(b < a for a, b in pairwise(tolerance))
    # arcs: the error falls with the cube of their number, down to edges that are too short for a laser
    assert edges[-1] > 3 * edges[0]
    assert measured[-1] < measured[0] / 100
    rows = list(csv.DictReader(curves.splitlines()))
    seen = set()
    for (curve, method, theory), group in groupby(rows, lambda r: (r["curve"], r["method"], r["order_of_method"])):
        pieces, errors = np.array([[float(row["pieces"]), float(row["error_mm"])] for row in group]).T
        seen.add((curve, method))
        assert (pieces == 16 * 2.0 ** np.arange(len(pieces))).all()
        if method != "degree 7 splines":
            assert -np.polyfit(np.log(pieces), np.log(errors), 1)[0] == pytest.approx(float(theory), rel=0.05)
    assert {curve for curve, _ in seen} == {"flank", "root_fillet"}
    assert {method for _, method in seen} >= set(METHODS) - {"degree 7 splines"}
    # a line for each file or curve, and its name in the key
    for name, count in (("time", 1), ("pieces", len(seen))):
        lines = [e for e in ET.parse(folder / f"converge.{name}.svg").iter() if e.tag.endswith("polyline")]
        assert len(lines) >= count


def test_what_has_no_files_to_measure_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    sheet = {"format": "sheet", "purpose": "part"}
    scene = write_scene(tmp_path / "s.toml", {"g": part_keys(Gear(2.0, 12))}, [sheet])
    assert run("converge", scene, "--out", tmp_path / "out") == 2
    assert "exports" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.heavy
@pytest.mark.parametrize("parts", [["pinion"], []], ids=["pinion", "pair"])
def test_every_order_of_the_practicum_pair_is_the_method_s_own(parts: list[str]) -> None:
    """Within 5 %, from 16 pieces a curve down to 100 roundings; degree 7 is below them at once."""
    found = orders(plan_build(load_scene("practicum_pair"), "practicum_pair", parts, ["dxf"]))
    assert {o.method for o in found} == set(METHODS)
    for order in found:
        if order.method == "degree 7 splines":
            assert max(order.errors, default=0.0) < 1e-9
        else:
            assert order.observed == pytest.approx(order.theory, rel=0.05), order

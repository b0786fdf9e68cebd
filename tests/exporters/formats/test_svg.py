"""Laser SVG: true size, plain shapes for the simplest of readers, and the outline measured from outside."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest

from tests.exporters.making import build_gear, check_deviation, dxf_chains, svg_chains, svg_shapes
from tests.exporters.outside import Gear

REFERENCE = Gear(2, 23, bore=8)
GEARS = {
    "m 2 z 23": REFERENCE,
    "practicum": Gear(10, 21, 0.384, tip_diameter=234.48, bore=50),
    "undercut": Gear(3, 8),
    "relieved": Gear(3, 30, bore=20, relief_depth=0.02),
    "fine watch": Gear(0.2, 60, bore=1),
}
NAMESPACE = "{http://www.w3.org/2000/svg}"


def built(folder: Path, gear: Gear, **export: Any) -> tuple[Path, dict[str, Any]]:
    """An SVG of one gear and its entry in the report."""
    report = build_gear(folder, gear, {"format": "svg", **export})
    return folder / "out" / "s" / "g.svg", report["files"][0]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", GEARS)
def test_one_user_unit_is_one_millimetre(tmp_path: Path, name: str) -> None:
    gear = GEARS[name]
    root, _ = svg_shapes(built(tmp_path, gear)[0])
    left, top, width, height = map(float, root.attrib["viewBox"].split())
    assert root.attrib["width"].endswith("mm")
    assert root.attrib["height"].endswith("mm")
    assert float(root.attrib["width"][:-2]) == width
    assert float(root.attrib["height"][:-2]) == height
    assert left == top == 0
    assert min(width, height) >= 2 * gear.tip_radius


@pytest.mark.parametrize("curves", ["arcs", "lines"])
def test_only_plain_paths_and_circles_with_a_style_of_their_own(tmp_path: Path, curves: str) -> None:
    file, _ = built(tmp_path, REFERENCE, curves=curves, kerf=0.1)
    root, shapes = svg_shapes(file)
    assert root.tag == NAMESPACE + "svg"
    assert {s.tag for s in shapes} <= {NAMESPACE + "path", NAMESPACE + "circle"}
    for shape in shapes:
        assert set(shape.attrib) <= {"d", "cx", "cy", "r", "id", "style"}
        assert re.search(r"stroke:#[0-9a-f]{6}", shape.attrib["style"])
        assert "fill:none" in shape.attrib["style"]
    assert len({s.attrib["id"] for s in shapes}) == len(shapes)
    text = file.read_text(encoding="ascii")
    assert not re.search(r"transform|class=|<use|<style|<g\b|<defs|<text|<image", text)
    paths = [s.attrib["d"] for s in shapes if "d" in s.attrib]
    assert paths
    assert all(re.fullmatch(r"M[-\d.,LA Z]+Z", data) for data in paths)


def test_inner_contours_come_first_in_another_colour(tmp_path: Path) -> None:
    _, (inner, outer) = svg_shapes(built(tmp_path, REFERENCE)[0])
    assert inner.attrib["id"] == "cut_inner"
    assert outer.attrib["id"] == "cut_outer"
    assert inner.attrib["style"] != outer.attrib["style"]


def test_a_round_bore_is_a_circle(tmp_path: Path) -> None:
    """LaserGRBL cuts a <circle> with true arcs and flattens the arcs of a path."""
    _, (inner, _) = svg_shapes(built(tmp_path, REFERENCE)[0])
    assert inner.tag == NAMESPACE + "circle"
    assert float(inner.attrib["r"]) == 4.0


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", GEARS)
@pytest.mark.parametrize("tolerance", [0.05, 0.005, 0.0002])
def test_every_piece_is_within_the_tolerance(tmp_path: Path, name: str, tolerance: float) -> None:
    file, entry = built(tmp_path, GEARS[name], tolerance=tolerance)
    check_deviation(file, GEARS[name], entry)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["m 2 z 23", "undercut"])
@pytest.mark.parametrize("export", [{"kerf": 0.15}, {"offset": -0.1}, {"kerf": 0.2, "curves": "lines"}], ids=str)
def test_a_kerf_moves_every_point_by_half_of_it(tmp_path: Path, name: str, export: dict[str, Any]) -> None:
    file, entry = built(tmp_path, GEARS[name], **export)
    check_deviation(file, GEARS[name], entry)


def test_y_runs_up_again_and_the_outline_is_that_of_the_dxf(tmp_path: Path) -> None:
    """The same vertices in the same order: an SVG mirrored by mistake would turn the other way."""
    build_gear(tmp_path, REFERENCE, {"format": "svg"}, {"format": "dxf"})
    svg, dxf = (read(tmp_path / "out" / "s" / f"g.{end}") for read, end in ((svg_chains, "svg"), (dxf_chains, "dxf")))
    assert np.abs(svg[-1].vertices - dxf[-1].vertices).max() < 1e-8
    assert np.abs(svg[-1].sweeps - dxf[-1].sweeps).max() < 1e-4
    assert svg[-1].area() > 0


def test_lines_only_has_no_arc(tmp_path: Path) -> None:
    _, shapes = svg_shapes(built(tmp_path, REFERENCE, curves="lines")[0])
    assert all("A" not in s.attrib.get("d", "") for s in shapes)


def test_the_preview_shows_text_safely(tmp_path: Path) -> None:
    build_gear(tmp_path, GEARS["undercut"], {"format": "svg"})
    root = ElementTree.parse(tmp_path / "out" / "s" / "g.preview.svg").getroot()
    texts = ["".join(e.itertext()) for e in root.iter() if e.tag.endswith("text")]
    assert any("undercut" in t for t in texts)
    assert any(f"{2 * GEARS['undercut'].tip_radius:.4f}" in t for t in texts)

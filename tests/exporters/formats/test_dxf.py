"""Laser DXF: what receivers demand, and the outline measured from outside."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.exporters.making import build_gear, check_deviation, dxf_chains
from tests.exporters.outside import Chain, Gear, distances, half_tooth
from tests.oracles.rack_sweep import RackTool, outline_error

REFERENCE = Gear(2, 23, bore=8)
PRACTICUM = Gear(10, 13, 0.694, tip_diameter=160.68, bore=30)
GEARS = {
    "m 2 z 23": REFERENCE,
    "practicum": PRACTICUM,
    "undercut": Gear(3, 8, bore=5),
    "shifted z 6": Gear(1, 6, 0.5, tip_diameter=8.4),
    "relieved": Gear(3, 30, bore=20, relief_depth=0.02),
    "thinned": Gear(2, 40, thinning=0.2, bore=10),
    "fine watch": Gear(0.2, 60, bore=1),
    "large": Gear(20, 30, 0.2, bore=100),
}

ARCS_AND_LINES = [*((n, "arcs") for n in GEARS), ("m 2 z 23", "lines"), ("undercut", "lines")]


def built(folder: Path, gear: Gear, **export: Any) -> tuple[Path, dict[str, Any]]:
    """A DXF of one gear and its entry in the report."""
    report = build_gear(folder, gear, {"format": "dxf", **export})
    return folder / "out" / "s" / "g.dxf", report["files"][0]


def pieces_of(chain: Chain, gear: Gear) -> dict[str, float]:
    """Number of edges of each piece, a tooth side or land each, by the middle of every edge."""
    _, names, piece = distances(chain.dense(2)[:, 1], gear)
    sides = {"root": 1, "tip": 1}
    return {n: float(np.count_nonzero(piece == i)) / gear.teeth / sides.get(n, 2) for i, n in enumerate(names)}


def group_codes(file: Path) -> list[tuple[str, str]]:
    """The file as pairs of code and value, without ezdxf."""
    lines = file.read_bytes().decode("ascii").split("\n")
    return [(code.strip(), value.strip()) for code, value in zip(lines[::2], lines[1::2], strict=False)]


def test_the_header_says_r2000_and_millimetres(tmp_path: Path) -> None:
    file, _ = built(tmp_path, REFERENCE)
    codes = group_codes(file)
    header = {v: codes[i + 1][1] for i, (c, v) in enumerate(codes) if c == "9"}
    assert header["$ACADVER"] == "AC1015"
    assert header["$INSUNITS"] == "4"
    # at 0 LibreCAD prints an empty page
    assert header["$PSVPSCALE"] == "1.0"
    assert header["$MEASUREMENT"] == "1"
    assert b"\r" not in file.read_bytes()


def test_the_extents_in_the_header_hold_the_drawing(tmp_path: Path) -> None:
    file, _ = built(tmp_path, REFERENCE)
    drawing = ezdxf.readfile(file)
    ring = np.concatenate([c.dense().ravel() for c in dxf_chains(file)])
    low, high = drawing.header["$EXTMIN"], drawing.header["$EXTMAX"]
    assert low[0] <= ring.real.min() + 1e-12
    assert low[1] <= ring.imag.min() + 1e-12
    assert ring.real.max() - 1e-12 <= high[0] <= ring.real.max() + 0.1
    assert ring.imag.max() - 1e-12 <= high[1] <= ring.imag.max() + 0.1


@pytest.mark.parametrize("version", ["R2000", "R12"])
@pytest.mark.parametrize("gear", [REFERENCE, Gear(1, 17)], ids=["bore", "no bore"])
def test_only_closed_polylines_inner_first_on_ascii_layers(tmp_path: Path, gear: Gear, version: str) -> None:
    file, _ = built(tmp_path, gear, dxf_version=version)
    drawing = ezdxf.readfile(file)
    assert drawing.dxfversion == {"R2000": "AC1015", "R12": "AC1009"}[version]
    entities = list(drawing.modelspace())
    kind = "LWPOLYLINE" if version == "R2000" else "POLYLINE"
    assert [e.dxftype() for e in entities] == [kind] * (2 if gear.bore else 1)
    assert [e.dxf.layer for e in entities] == (["CUT_INNER"] if gear.bore else []) + ["CUT_OUTER"]
    assert all(e.closed if version == "R2000" else e.is_closed for e in entities)
    assert all(layer.dxf.name.isascii() for layer in drawing.layers)
    assert all(not list(layout) for layout in drawing.layouts if layout.name != "Model")
    auditor = drawing.audit()
    assert not auditor.errors
    assert not auditor.fixes
    if gear.bore:
        inner, outer = dxf_chains(file)
        assert np.abs(inner.vertices).max() < np.abs(outer.vertices).min()


@pytest.mark.parametrize("version", ["R2000", "R12"])
def test_the_closed_flag_stands_in_the_file_and_the_first_vertex_is_not_repeated(tmp_path: Path, version: str) -> None:
    file, _ = built(tmp_path, REFERENCE, dxf_version=version)
    codes = group_codes(file)
    kind = "LWPOLYLINE" if version == "R2000" else "POLYLINE"
    starts = [i for i, pair in enumerate(codes) if pair == ("0", kind)]
    assert len(starts) == 2
    for start in starts:
        flag = next(int(v) for c, v in codes[start:] if c == "70")
        assert flag & 1
    for chain in dxf_chains(file):
        a, b = chain.edges()
        assert np.abs(b - a).min() > 1e-3


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", GEARS)
def test_at_most_twenty_vertices_a_tooth_at_five_micrometres(tmp_path: Path, name: str) -> None:
    gear = GEARS[name]
    file, entry = built(tmp_path, gear, tolerance=0.005)
    chains = dxf_chains(file)
    assert len(chains[-1].vertices) <= 20 * gear.teeth
    assert entry["entities"]["LWPOLYLINE"] == len(chains)
    assert entry["entities"]["vertices"] == sum(len(c.vertices) for c in chains)
    assert entry["entities"]["arcs"] == sum(int(np.count_nonzero(c.sweeps)) for c in chains)


def test_few_arcs_and_no_short_segment_on_the_reference_gear(tmp_path: Path) -> None:
    file, _ = built(tmp_path, REFERENCE, tolerance=0.005)
    outer = dxf_chains(file)[-1]
    a, b = outer.edges()
    assert np.abs(b - a).min() >= 0.02
    pieces = pieces_of(outer, REFERENCE)
    assert 1 <= pieces["flank"] <= 4, pieces
    assert 1 <= pieces["fillet"] <= 4, pieces


def test_flanks_and_fillets_are_smooth(tmp_path: Path) -> None:
    """G1 arcs: the only corners of a gear that is not undercut are the two tip corners of each tooth."""
    file, _ = built(tmp_path, REFERENCE)
    outer = dxf_chains(file)[-1]
    a, b = outer.edges()
    leaving, arriving = np.angle(b - a) - outer.sweeps / 2, np.angle(b - a) + outer.sweeps / 2
    turns = np.abs(np.angle(np.exp(1j * (leaving - np.roll(arriving, 1)))))
    assert np.count_nonzero(turns > 1e-4) == 2 * REFERENCE.teeth


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", GEARS)
@pytest.mark.parametrize("tolerance", [0.05, 0.005, 0.0002])
def test_every_piece_is_within_the_tolerance(tmp_path: Path, name: str, tolerance: float) -> None:
    file, entry = built(tmp_path, GEARS[name], tolerance=tolerance)
    check_deviation(file, GEARS[name], entry)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("share", [0.05, 0.3, -0.1])
@pytest.mark.parametrize(("name", "curves"), ARCS_AND_LINES)
def test_a_kerf_moves_every_point_by_half_of_it(tmp_path: Path, name: str, curves: str, share: float) -> None:
    """The unmoved outline is all that the measurement knows: the path must lie at its distance from it."""
    gear = GEARS[name]
    width = round(share * gear.module, 3)
    asked = {"kerf": width} if width > 0 else {"offset": width / 2}
    file, entry = built(tmp_path, gear, curves=curves, **asked)
    assert entry["offset"] == pytest.approx(width / 2)
    check_deviation(file, gear, entry)


def test_lines_only_has_no_arc_in_any_version(tmp_path: Path) -> None:
    for version in ("R2000", "R12"):
        folder = tmp_path / version
        folder.mkdir()
        file, entry = built(folder, REFERENCE, curves="lines", dxf_version=version)
        assert entry["entities"]["arcs"] == 0
        assert all(np.all(c.sweeps == 0) for c in dxf_chains(file))
        check_deviation(file, REFERENCE, entry)


def test_r12_holds_the_same_outline(tmp_path: Path) -> None:
    (tmp_path / "old").mkdir()
    new = dxf_chains(built(tmp_path, REFERENCE)[0])
    old = dxf_chains(built(tmp_path / "old", REFERENCE, dxf_version="R12")[0])
    for one, other in zip(new, old, strict=True):
        assert np.abs(one.vertices - other.vertices).max() < 1e-12
        assert np.abs(one.sweeps - other.sweeps).max() < 1e-12


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["m 2 z 23", "practicum", "undercut"])
def test_vertices_stand_on_the_gear_that_the_rack_leaves(tmp_path: Path, name: str) -> None:
    """Against the brute-force sweep of the rack: vertices are points of the exact curve, to nine decimals."""
    gear = GEARS[name]
    file, entry = built(tmp_path, gear, tolerance=1e-5)
    outer = dxf_chains(file)[-1]
    tool = RackTool(gear.module, np.radians(20), 1.0, 0.25, 0.38, gear.shift)
    assert outline_error(outer.vertices[:150], tool, gear.teeth, gear.tip_radius).max() < 0.71e-9
    between = outline_error(outer.dense(8)[:150, 1:].ravel(), tool, gear.teeth, gear.tip_radius).max()
    assert between <= entry["max_error"] <= 1e-5


@pytest.mark.parametrize("tolerance", [0.02, 0.001])
def test_area_agrees_with_the_outside_outline(tmp_path: Path, tolerance: float) -> None:
    file, entry = built(tmp_path, REFERENCE, tolerance=tolerance)
    inner, outer = dxf_chains(file)
    half = np.concatenate([[0j], *half_tooth(REFERENCE).values()])
    exact = 2 * REFERENCE.teeth * abs(0.5 * float(np.sum(np.imag(np.conj(half) * np.roll(half, -1)))))
    length = float(np.abs(np.diff(outer.dense().ravel())).sum())
    assert abs(outer.area() - exact) < entry["max_error"] * length
    assert inner.area() == pytest.approx(-np.pi * 16, rel=1e-12)
    assert outer.area() > 0


@pytest.mark.heavy
@settings(max_examples=150, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    module=st.floats(0.2, 20).map(lambda v: round(v, 3)),
    teeth=st.integers(9, 90),
    shift=st.floats(-0.2, 0.6),
    tolerance=st.floats(-4, -1.3).map(lambda v: 10**v),
    share=st.floats(-0.1, 0.3),
)
def test_any_gear_at_any_tolerance(
    tmp_path_factory: pytest.TempPathFactory, module: float, teeth: int, shift: float, tolerance: float, share: float
) -> None:
    gear = Gear(module, teeth, round(shift, 4), bore=round(0.4 * module * (teeth - 4), 3))
    folder = tmp_path_factory.mktemp("any")
    file, entry = built(folder, gear, tolerance=tolerance, offset=round(share * module / 2, 4))
    check_deviation(file, gear, entry)

"""``higherpair converge``: error against run time as its table tells it, and the orders of the methods."""

from __future__ import annotations

import csv
import xml.etree.ElementTree as ET
from itertools import groupby, pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.production import converge
from exporters.production.converge import (
    CAD_LADDER,
    LADDER,
    METHODS,
    Order,
    Rung,
    ladder,
    orders,
    write_csv,
    write_pictures,
)
from exporters.production.plan import plan_build
from geometry.curves.curve import Curve
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Label, Segment
from parts.base.texts import words
from parts.scene.load import load_scene, scene_from_dict
from tests.exporters.making import part_keys, run, write_scene
from tests.exporters.outside import Gear

TEETH = 8


def test_errors_keep_their_bounds_and_fall_as_the_methods_do(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    # each file is written once: its time is no matter here
    monkeypatch.setattr(converge, "_REPEATS", 1)
    # undercut: both curves of a tooth end where they cross
    scene = write_scene(tmp_path / "s.toml", {"g": part_keys(Gear(3.0, TEETH, bore=6.0))}, [{"format": "svg"}])
    assert run("converge", scene, "--out", tmp_path / "out") == 0
    assert "g.svg" in capsys.readouterr().out
    folder = tmp_path / "out" / "s"
    made = {f"converge.{name}.{ending}" for name in ("time", "pieces") for ending in ("csv", "svg")}
    assert {file.name for file in folder.iterdir()} == made
    # each is one table, as any reader of CSV takes it
    rungs, rows = (
        list(csv.DictReader((folder / f"converge.{name}.csv").read_text("utf-8").splitlines()))
        for name in ("time", "pieces")
    )
    assert all(None not in row and None not in row.values() for row in (*rungs, *rows))
    tolerance, declared, measured, edges = (
        [float(row[name]) for row in rungs] for name in ("tolerance_mm", "declared_mm", "measured_mm", "edges")
    )
    assert all(0 < m <= d <= t for m, d, t in zip(measured, declared, tolerance, strict=True))
    assert len(rungs) == 10
    assert all(b < a for a, b in pairwise(tolerance))
    # arcs: the error falls with the cube of their number, down to edges that are too short for a laser
    assert edges[-1] > 3 * edges[0]
    assert measured[-1] < measured[0] / 100
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


class Stub:
    """Keys as attributes."""

    def __init__(self, **keys: Any) -> None:
        self.__dict__.update(keys)


def test_rungs_are_halves_and_fifths_and_tenths() -> None:
    """0.1 mm to 0.1 um, each next one 2 or 2.5 times finer; CAD by tenths, down to 0.1 nm."""
    steps = [a / b for a, b in pairwise(LADDER)]
    assert steps == pytest.approx([2, 2.5, 2] * 3, rel=1e-12)
    assert LADDER[0] == 0.1
    assert pytest.approx([10.0**-k for k in range(2, 8)], rel=1e-12) == CAD_LADDER


def plan_of(*curves: tuple[Curve, Label]) -> Any:
    """One part with these curves in its outline."""
    profile = Stub(period=[Segment(curve, label) for curve, label in curves])
    region = Stub(profiles=lambda: [profile])
    part = Stub(id="g", section=lambda offset: Stub(region=region))
    return Stub(jobs=[Stub(part=part), Stub(part=part)], parts={"g": part})


FLANK = (Involute(10.0, 0.0, 0.5, 1.0), Label.FLANK)


def test_an_order_is_the_slope_of_errors_above_the_floor_of_rounding(monkeypatch: pytest.MonkeyPatch) -> None:
    """Errors 3 / n^2.5: all seven doublings from 16 to 1024, and 2.5; each curve once, neither lines nor circles."""
    even, flat = (lambda _, n: 3.0 * n**-2.5), (lambda _, n: 7.0 / n)
    methods = {"even": (2.5, even), "flat": (1.0, flat), "none": (8.0, lambda *_: 0.0)}
    monkeypatch.setattr("exporters.production.converge.METHODS", methods)
    line, arc = (Line(0j, 1 + 0j), Label.RIM), (Arc(0j, 5.0, 0.0, 1.0), Label.TIP_LAND)
    found = orders(plan_of(line, FLANK, arc, FLANK, (Involute(10.0, 0.0, 0.5, 1.0), Label.ROOT_FILLET)))
    assert [(o.part, o.curve, o.method, o.theory) for o in found] == [
        ("g", curve, method, theory) for curve in ("flank", "root_fillet")
        for method, theory in (("even", 2.5), ("flat", 1.0), ("none", 8.0))
    ]  # fmt: skip
    counts = (16, 32, 64, 128, 256, 512, 1024)
    first, second, third = found[:3]
    assert first.counts == second.counts == counts
    assert first.errors == tuple(3.0 * n**-2.5 for n in counts)
    assert (first.observed, second.observed) == (pytest.approx(2.5, rel=1e-12), pytest.approx(1.0, rel=1e-12))
    assert (third.counts, third.errors, third.observed) == ((), (), None)


@pytest.mark.parametrize(("share", "rungs"), [(1.01, 3), (0.99, 2)])
def test_what_is_below_a_hundred_roundings_of_the_curve_is_no_error(
    monkeypatch: pytest.MonkeyPatch, share: float, rungs: int
) -> None:
    """4e-13 of the farther end of the curve; one rung alone has no slope."""
    curve = FLANK[0]
    floor = 4e-13 * float(np.abs(curve.point(np.array(curve.domain))).max())
    errors = {16: 1.0, 32: 1e-3, 64: share * floor}
    monkeypatch.setattr("exporters.production.converge.METHODS", {"m": (1.0, lambda _, n: errors.get(n, 0.0))})
    (found,) = orders(plan_of(FLANK))
    assert found.counts == (16, 32, 64)[:rungs]
    errors[32] = 0.0
    (found,) = orders(plan_of(FLANK))
    assert (found.counts, found.observed) == ((16,), None)


RUNGS = [
    Rung("a.svg", "svg", 0.1, 0.09, 0.08, 40, 1200, 0.002, 0.0005),
    Rung("a.svg", "svg", 0.01, 0.009, 0.008, 90, 2400, 0.003, 0.001),
    Rung("b.stl", "stl", 0.1, 0.07, 0.06, 300, 9000, 0.02, 0.004),
]
ORDERS = [
    Order("g", "flank", "arcs", 3.0, 2.95, (16, 32), (1e-3, 1.25e-4)),
    Order("g", "flank", "splines", 8.0, None, (16,), (1e-12,)),
]


def test_both_tables_and_pictures_have_all_that_was_found(tmp_path: Path) -> None:
    tables = ["converge.time.csv", "converge.pieces.csv"]
    assert write_csv(tmp_path, RUNGS, []) == tables[:1]
    assert write_csv(tmp_path, RUNGS, ORDERS) == tables
    files, curves = ((tmp_path / name).read_bytes().decode("utf-8") for name in tables)
    assert "\r" not in files + curves
    heads = ("file", "format", "tolerance_mm", "declared_mm", "measured_mm", "edges", "bytes", "s", "spread_s")
    values = [
        [r.file, r.format, r.tolerance, r.max_error, r.measured, r.entities, r.bytes, r.seconds, r.spread]
        for r in RUNGS
    ]
    assert list(csv.reader(files.splitlines())) == [list(heads), *([str(v) for v in row] for row in values)]
    assert list(csv.reader(curves.splitlines())) == [
        ["part", "curve", "method", "order_of_method", "observed_order", "pieces", "error_mm"],
        ["g", "flank", "arcs", "3.0", "2.95", "16", "0.001"], ["g", "flank", "arcs", "3.0", "2.95", "32", "0.000125"],
        ["g", "flank", "splines", "8.0", "", "16", "1e-12"],
    ]  # fmt: skip
    for language in ("en", "uk"):
        names = ["converge.time.svg", "converge.pieces.svg"]
        assert write_pictures(tmp_path, RUNGS, ORDERS, words(language)) == names
        keys, points = [], []
        for name in names:
            every = [*ET.parse(tmp_path / name).iter()]
            keys.append([e.text for e in every if e.tag.endswith("text")])
            points.append([len(e.attrib["points"].split()) for e in every if e.tag.endswith("polyline")])
        # a line for each file and each curve, as many points as it has rungs
        assert points == [[2, 1], [2, 1]]
        assert {"a.svg", "b.stl"} < set(keys[0])
        arcs, flank = (words(language).text(word) for word in ("arcs", "flank"))
        assert {f"g {flank} {arcs} 2.95", f"g {flank} splines"} < set(keys[1])
        assert (flank == "flank") == (language == "en")
        assert (arcs == "arcs") == (language == "en")
        assert (
            bool(set(keys[0]) & {"time to write, s"})
            == bool(set(keys[1]) & {"pieces of a curve"})
            == (language == "en")
        )
        assert write_pictures(tmp_path, RUNGS, [], words(language)) == names[:1]


def test_a_rung_is_made_three_times_and_its_middle_time_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of 5, 1 and 3 s the least one, and 4 s between them; a ladder ends after a rung of more than 15 s."""
    keys = part_keys(Gear(3.0, TEETH, bore=6.0)) | {"kind": "spur_gear"}
    raw = {"parts": {"g": keys}, "exports": [{"format": "svg"}]}
    plan = plan_build(scene_from_dict(raw, "s", "s"), "s", [], [])
    shown: list[str] = []
    for spent, rungs in ((4.0, 2), (16.0, 1)):
        # before a rung, three times at its ends, after it
        clock = iter([x + 100 * k for k in range(2) for x in (0, 0, 5, 5, 6, 6, 9, 9 + spent - 3)])
        monkeypatch.setattr("exporters.production.converge.time", Stub(perf_counter=lambda clock=clock: next(clock)))
        monkeypatch.setattr("exporters.production.converge.LADDER", (0.1, 0.02))
        found = ladder(plan, tmp_path, shown.append)
        assert len(found) == rungs
        assert [(r.seconds, r.spread) for r in found] == [(1, 4)] * rungs
        assert [r.tolerance for r in found] == [0.1, 0.02][:rungs]
        assert not any(tmp_path.iterdir())
        for rung in found:
            assert (rung.file, rung.format) == ("g.svg", "svg")
            assert 0 < rung.measured <= rung.max_error <= rung.tolerance
            assert rung.bytes > 1000
    assert shown == ["g.svg", "g.svg"]


@pytest.mark.parametrize(("measured", "code"), [(0.01, 0), (0.0101, 1)])
def test_a_file_that_is_farther_off_than_it_declares_is_a_failure(
    measured: float, code: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rungs = [Rung("g.svg", "svg", 0.02, 0.02, 0.001, 10, 100, 0.1, 0.0),
             Rung("g.svg", "svg", 0.01, 0.01, measured, 12, 120, 0.1, 0.0)]  # fmt: skip
    monkeypatch.setattr("exporters.command.converge.ladder", lambda plan, folder: rungs)
    monkeypatch.setattr("exporters.command.converge.orders", lambda plan: [])
    parts = {"g": part_keys(Gear(3.0, TEETH, bore=6.0)) | {"kind": "spur_gear"}}
    scene = write_scene(tmp_path / "s.toml", parts, ({"format": "svg"},))
    assert run("converge", scene, "--out", tmp_path / "out") == code

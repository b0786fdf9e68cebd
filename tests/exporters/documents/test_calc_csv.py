"""``higherpair calc --format csv``: the file read by the standard reader, and the cam rolled by its follower alone."""

from __future__ import annotations

import csv
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.documents.render import render
from parts.pages.page import Section, Sheet, Step
from tests.exporters.command.test_cli import complaint

LIFT, BASE, ROLLER, OFFSET, RPM, CUTTER = 20.0, 40.0, 8.0, 5.0, 240.0, 12.0
CAM = (
    "follower=roller", f"lift={LIFT}", f"base_circle_radius={BASE}", f"follower_radius={ROLLER}",
    f"follower_offset={OFFSET}",
    'phases=[{move="rise",angle_deg=100,law="sine"},{move="dwell",angle_deg=40},'
    '{move="return_",angle_deg=120,law="sine"},{move="dwell",angle_deg=100}]',
)  # fmt: skip
Columns = dict[str, np.ndarray]


def tables_of(path: Path, *words: str) -> list[Columns]:
    """The tables of the file that the command writes, by the heads of their columns."""
    assert main(["calc", "cam", *words, "--format", "csv", "--out", str(path)]) == 0
    text = path.read_text(encoding="utf-8")
    assert text.endswith("\n")
    assert "\r" not in text
    found = []
    for block in text.split("\n\n"):
        head, *rows = csv.reader(block.splitlines())
        assert {len(row) for row in rows} == {len(head)}
        found.append(dict(zip(head, np.array(rows, dtype=float).T, strict=True)))
    return found


def lift_at(phi: np.ndarray) -> np.ndarray:
    """The cycloidal rise, dwell, return and dwell of CAM, written from the textbook; phi in degrees."""
    up, down = (np.clip((phi - a) / b, 0, 1) for a, b in ((0, 100), (140, 120)))
    one, two = (u - np.sin(2 * np.pi * u) / (2 * np.pi) for u in (up, down))
    return LIFT * (one - two)


def roller_at(phi: np.ndarray) -> np.ndarray:
    """The roller's centre in the cam's frame: the stem carried round against the cam."""
    start = math.sqrt((BASE + ROLLER) ** 2 - OFFSET**2)
    return (OFFSET + 1j * (start + lift_at(phi))) * np.exp(-1j * np.radians(phi))


def test_a_roller_cam_is_what_its_roller_and_a_cutter_leave(tmp_path: Path) -> None:
    table, graphical = tables_of(tmp_path / "a.csv", *CAM, "step=5", f"speed_rpm={RPM}", f"cutter_diameter={CUTTER}")
    assert list(table) == [
        "phi (deg)", "S (mm)", "S' (mm/rad)", "S'' (mm/rad2)", "v (mm/s)", "a (m/s2)", "nu (deg)", "rho (mm)",
        "x (mm)", "y (mm)", "r (mm)", "theta (deg)", "x_p (mm)", "y_p (mm)", "x_c (mm)", "y_c (mm)",
    ]  # fmt: skip
    assert len(graphical) > 5
    phi, omega = table["phi (deg)"], RPM * 2 * math.pi / 60
    assert list(phi) == [5.0 * k for k in range(72)]
    assert table["S (mm)"] == pytest.approx(lift_at(phi), abs=1e-12)
    pitch, profile, cutter = (table[f"x{k} (mm)"] + 1j * table[f"y{k} (mm)"] for k in ("_p", "", "_c"))
    assert pitch == pytest.approx(roller_at(phi), abs=1e-12)
    assert profile == pytest.approx(table["r (mm)"] * np.exp(1j * np.radians(table["theta (deg)"])), abs=1e-12)
    # time by differences of the lift
    second = 2e-3 * 180 / math.pi
    after, now, before = lift_at(phi + second), lift_at(phi), lift_at(phi - second)
    assert table["v (mm/s)"] == pytest.approx((after - before) / (2 * 2e-3) * omega, abs=2e-2)
    # at the joints the third derivative jumps
    assert table["a (m/s2)"] == pytest.approx((after - 2 * now + before) / 2e-3**2 * omega**2 / 1000, abs=0.2)
    # brute force: every roller of a fine turn leaves the profile outside, one of them touches it
    fine = np.linspace(0, 360, 100_001)
    rollers = roller_at(fine)
    for point, centre in zip(profile[::3], cutter[::3], strict=True):
        assert np.abs(rollers - point).min() == pytest.approx(ROLLER, abs=1e-5)
        assert abs(centre - point) == pytest.approx(CUTTER / 2, abs=1e-12)
        # of the offset by the roller less the cutter from the rollers' path
        assert np.abs(rollers - centre).min() == pytest.approx(ROLLER - CUTTER / 2, abs=1e-5)
    # the circle through three near points of the rollers' path, less the roller
    a, b, c = (roller_at(phi + d) for d in (-0.02, 0.0, 0.02))
    area = ((b - a).conj() * (c - a)).imag
    path = -np.abs(b - a) * np.abs(c - b) * np.abs(c - a) / (2 * area)
    smooth = [k for k, value in enumerate(phi) if value not in (0, 100, 140, 260)]
    assert 1 / table["rho (mm)"][smooth] == pytest.approx(1 / (path - ROLLER)[smooth], abs=1e-6)
    slope = (lift_at(phi + 0.01) - lift_at(phi - 0.01)) / math.radians(0.02)
    height = math.sqrt((BASE + ROLLER) ** 2 - OFFSET**2) + lift_at(phi)
    assert np.tan(np.radians(table["nu (deg)"])) == pytest.approx((slope - OFFSET) / height, abs=1e-6)


def test_json_has_the_same_columns_and_pages_have_those_that_they_had(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Polar coordinates and paths are data for a machine; a reader of the page has no more columns than before."""
    rows = tables_of(tmp_path / "a.csv", *CAM, "step=30")[0]
    assert capsys.readouterr().out == f"written: {tmp_path / 'a.csv'}\n"
    assert main(["calc", "cam", *CAM, "step=30", "--format", "json"]) == 0
    data = json.loads(capsys.readouterr().out)["positions"]
    for head, values in rows.items():
        assert [row[head.split(" (")[0]] for row in data] == values.tolist()
    assert main(["calc", "cam", *CAM, "step=30", "speed_rpm=60"]) == 0
    head = next(line for line in capsys.readouterr().out.splitlines() if line.startswith("φ"))
    shown = [cell.split(",")[0] for cell in re.split(r"\s{2,}", head)]
    assert shown == ["φ", "S", "S'", "S''", "v", "a", "ν", "ρ", "x", "y"]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("words", "names"), [
    (("groove_cam", "speed_rpm=60"), ["v", "a"]),
    (("conjugate_cams", "speed_rpm=60", "cutter_diameter=6"), ["omega", "epsilon"]),
    (("wedge_cam", "plate_velocity=100"), ["v", "a"]),
    (("barrel_cam", "part=barrel", "speed_rpm=60"), ["v", "a"]),
    (("linkage_cam", "speed_rpm=60"), ["omega", "epsilon"]),
], ids=lambda found: found[0])  # fmt: skip
def test_every_kind_of_cam_has_its_motion_at_a_speed(tmp_path: Path, words: tuple[str, ...], names: list[str]) -> None:
    """v = S' w and a = S'' w^2 of one constant w, whatever the kind."""
    table = tables_of(tmp_path / "a.csv", *words)[0]
    columns = {head.split(" (")[0]: values for head, values in table.items()}
    assert np.isfinite(columns["S"]).all()
    scale = math.pi / 180 if names == ["omega", "epsilon"] else 1.0
    speed = 100.0 if "plate_velocity=100" in words else 2 * math.pi
    metres = 1000 if names[1] == "a" else 1
    assert columns[names[0]] == pytest.approx(columns["S'"] * scale * speed, rel=1e-12)
    assert columns[names[1]] == pytest.approx(columns["S''"] * scale * speed**2 / metres, rel=1e-12)


def test_what_has_no_tables_and_a_cutter_that_does_not_fit_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert "no tables" in complaint(capsys, "calc", "gear-pair", "practicum_pair", "--format", "csv")
    for scene in ("practicum_roller_cam",):
        told = complaint(capsys, "calc", "cam", scene, "cutter_diameter=900", "--format", "csv")
        offered = re.search(r"cutter_diameter = 900.*hollow.*at most ([\d.]+) mm works", told)
        assert offered is not None, told
        # what is told is accepted, and a ten thousandth more is not
        assert main(["calc", "cam", scene, f"cutter_diameter={offered[1]}", "--format", "csv"]) == 0
        capsys.readouterr()
        beyond = f"cutter_diameter={float(offered[1]) + 2e-4:.4f}"
        assert "hollow" in complaint(capsys, "calc", "cam", scene, beyond, "--format", "csv")
        assert told.count("at most") == 1


def test_a_step_without_a_source_has_no_brackets() -> None:
    """Beside one that has it."""
    steps = [
        Step("working_centre_distance", 0, "a_w", 5.0, "mm", source="ISO 21771"),
        Step("contact_ratio", 0, "e", 1.5, ""),
    ]
    shown = render(Sheet("t", "Title", [Section("Part", steps)]), "text", "en")
    assert shown.count("[") == shown.count("[ISO 21771]") == 1

"""Motion tables from files, as spreadsheets, editors and measuring machines write them."""

import json
import math
from pathlib import Path

import pytest

from exporters.command.cli import main
from parts.base.refusal import SceneError
from parts.base.registry import KINDS
from parts.scene.load import load_scene
from parts.scene.schema import scene_schema

ROWS = [[float(a), round(10 - 10 * math.cos(math.radians(a)), 3)] for a in range(0, 360, 15)]
_CAM = """
[parts.cam]
kind = "cam"
follower = "roller"
follower_radius = 6.0
base_circle_radius = 30.0
face_width = 8.0
motion_table = {table}

[[exports]]
format = "dxf"
"""


def line(row: list[float], between: str, point: str = ".") -> str:
    return between.join(f"{value:g}" for value in row).replace(".", point)


def file_of(between: str, point: str = ".", head: str = "", end: str = "\n") -> str:
    return head + end.join(line(row, between, point) for row in ROWS) + end


# as Excel writes it with Ukrainian settings, in UTF-8 and by its old code page, and others
FILES = {
    "excel utf-8": file_of(";", ",", "Кут, °;Підйом, мм\r\n", "\r\n").encode("utf-8-sig"),
    "excel cp1251": file_of(";", ",", "Кут;Підйом S\r\n", "\r\n").encode("cp1251"),
    "excel text": file_of("\t", ",", "Кут\tПідйом\r\n", "\r\n").encode("utf-16"),
    "sep": file_of(";", ",", "sep=;\n").encode(),
    "semicolons, points": file_of(";").encode(),
    "plain": file_of(",", head="angle,lift\n").encode(),
    "comma and blank": file_of(", ").encode(),
    "blanks": file_of("  ", head="# measured\n\n").encode(),
    "blanks, decimal commas": file_of(" ", ",").encode(),
    "empty column": file_of(";", ",").replace("\n", ";;\n").encode(),
    # a sheet that had more rows once
    "empty rows": (file_of(";", ",", ";;\n") + ";\n;;\n").encode(),
    "quoted": ("\n".join(f'"{a:g}","{s:g}"' for a, s in ROWS)).encode(),
}


@pytest.mark.parametrize("name", FILES)
def test_rows_are_those_of_the_file(name: str, tmp_path: Path) -> None:
    (tmp_path / "lift.csv").write_bytes(FILES[name])
    (tmp_path / "s.toml").write_text(_CAM.format(table='{ file = "lift.csv" }'), "utf-8")
    made = load_scene(str(tmp_path / "s.toml"))
    (tmp_path / "t.toml").write_text(_CAM.format(table=ROWS), "utf-8")
    assert made.parts == load_scene(str(tmp_path / "t.toml")).parts


def test_the_report_keeps_the_rows_and_verify_needs_no_file(tmp_path: Path) -> None:
    (tmp_path / "measured").mkdir()
    (tmp_path / "measured" / "lift.csv").write_bytes(FILES["excel utf-8"])
    (tmp_path / "s.toml").write_text(_CAM.format(table='{ file = "measured/lift.csv" }'), "utf-8")
    assert main(["build", str(tmp_path / "s.toml"), "--out", str(tmp_path / "out")]) == 0
    report = json.loads((tmp_path / "out" / "s" / "report.json").read_text("utf-8"))
    assert report["scene"]["parts"]["cam"]["motion_table"] == ROWS
    (tmp_path / "measured" / "lift.csv").unlink()
    assert main(["verify", str(tmp_path / "out" / "s" / "cam.dxf")]) == 0


def test_an_assembly_takes_it_too(tmp_path: Path) -> None:
    (tmp_path / "lift.csv").write_bytes(FILES["plain"])
    text = """
[[assemblies]]
kind = "cam_model"
follower = "roller"
follower_radius = 6.0
base_circle_radius = 30.0
motion_table = { file = "lift.csv" }
"""
    (tmp_path / "s.toml").write_text(text, "utf-8")
    parts = load_scene(str(tmp_path / "s.toml")).parts
    tables = [[list(row) for row in rows] for part in parts.values() if (rows := getattr(part, "motion_table", None))]
    assert tables == [ROWS]


def test_a_folder_is_refused_in_the_language_of_the_scene(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The disk's own words stood there in English."""
    (tmp_path / "lift.csv").mkdir()
    head = '[scene]\nlanguage = "uk"\n'
    (tmp_path / "s.toml").write_text(head + _CAM.format(table='{ file = "lift.csv" }'), "utf-8")
    assert main(["check", str(tmp_path / "s.toml")]) == 2
    assert capsys.readouterr().err.endswith('motion_table.file = "lift.csv": не читається: це тека\n')


@pytest.mark.parametrize(
    ("name", "raw", "code", "numbers"),
    [
        ("no.csv", None, "no_such_file", {}),
        ("../lift.csv", b"", "file_elsewhere", {}),
        ("lift.csv", b"angle;lift\n0;0\n90;5\n180;ten\n", "no_row_of_motion", {"line": 4, "text": "180;ten"}),
        # a decimal comma between commas is no row of two
        ("lift.csv", b"0,0,0,0\n90,0,5,5\n", "no_row_of_motion", {"line": 1, "text": "0,0,0,0"}),
        ("lift.csv", b"0;0;0\n90;5;1\n", "no_row_of_motion", {"line": 1, "text": "0;0;0"}),
        ("lift.csv", "кут;підйом\n".encode(), "no_rows_of_motion", {}),
        ("lift.csv", b"", "no_rows_of_motion", {}),
    ],
)
def test_a_file_that_tells_no_motion_is_refused(
    name: str, raw: bytes | None, code: str, numbers: dict[str, object], tmp_path: Path
) -> None:
    if raw is not None:
        (tmp_path / "lift.csv").write_bytes(raw)
    (tmp_path / "s.toml").write_text(_CAM.format(table=f'{{ file = "{name}" }}'), "utf-8")
    with pytest.raises(SceneError) as refusal:
        load_scene(str(tmp_path / "s.toml"))
    assert (refusal.value.key, refusal.value.code) == ("parts.cam.motion_table.file", code)
    assert {key: refusal.value.numbers[key] for key in numbers} == numbers


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", ["cam", "linkage_cam", "groove_cam", "barrel_cam"])
def test_editors_know_it(kind: str) -> None:
    import jsonschema

    plain = json.loads(scene_schema())["$defs"][KINDS[kind].keys.__name__]["properties"]["motion_table"]
    judge = jsonschema.Draft202012Validator(plain)
    assert judge.is_valid({"file": "lift.csv"})
    assert judge.is_valid(ROWS)
    assert not judge.is_valid({"path": "lift.csv"})


def test_a_table_of_other_keys_is_no_motion(tmp_path: Path) -> None:
    (tmp_path / "s.toml").write_text(_CAM.format(table='{ path = "lift.csv" }'), "utf-8")
    with pytest.raises(SceneError) as refusal:
        load_scene(str(tmp_path / "s.toml"))
    assert refusal.value.key == "parts.cam.motion_table"

"""The command as people use it: exit codes, one line of complaint, listing, and a scene to start from."""

from __future__ import annotations

import errno
import json
import os
import re
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from exporters import __version__
from parts.base.registry import KINDS
from parts.mates.registry import MATES
from parts.scene.files import built_in_scenes
from tests.exporters.making import build_gear, part_keys, read_report, run, write_scene
from tests.exporters.outside import Gear
from tests.exporters.production.test_build import command
from tests.offered import ALONE
from tests.sampling import some_of

GEAR = Gear(2, 23, bore=8)


def complaint(capsys: pytest.CaptureFixture[str], *arguments: object) -> str:
    """The one line that wrong input gets; exit code 2 and nothing on stdout."""
    capsys.readouterr()
    assert run(*arguments) == 2
    out, error = capsys.readouterr()
    assert out == ""
    assert error.startswith("higherpair: ")
    assert error.count("\n") == 1
    assert error.endswith("\n")
    assert "Traceback" not in error
    return error


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """A sound scene of one gear, g, in all formats."""
    return write_scene(tmp_path / "s.toml", {"g": part_keys(GEAR)}, [{"format": f} for f in ("dxf", "svg", "stl")])


@pytest.mark.heavy
@pytest.mark.parametrize("name", built_in_scenes())
def test_every_built_in_scene_builds_and_verifies(name: str, tmp_path: Path) -> None:
    assert run("build", name, "--out", tmp_path) == 0
    files = [tmp_path / name / e["path"] for e in read_report(tmp_path / name)["files"]]
    assert files
    assert run("verify", *files) == 0


# in which format each built-in scene is built by default: all formats, a cheap one for a scene that takes long
DAILY = {
    "shaft_set": "step", "working_drawings": "svg",
    "barrel_cam": "svg", "bevel_pair": "stl", "clock_gears": "dxf", "crossed_helical_pair": "3mf",
    "face_gear_pair": "stl", "conjugate_cams": "svg", "cycloidal_reducer": "dxf", "groove_cam": "svg",
    "guidelines_cam": "svg", "helical_gears": "stl", "helical_pair": "3mf", "idler_train": "3mf",
    "contour_cams": "dxf", "geneva_drive": "dxf", "ratchet": "dxf",
    "chain_drive": "dxf", "belt_drive": "stl", "spline_joint": "3mf",
    "lantern_pair": "step", "laser_cam_model": "dxf", "laser_gear": "dxf", "laser_gear_set": "svg",
    "linkage_cam": "svg", "six_link_model": "dxf", "drawing_machine": "motion",
    "practicum_flat_cam": "stl", "practicum_pair": "dxf",
    "practicum_roller_cam": "stl", "print_cam_set": "stl", "print_gear": "stl", "rack_and_pinion": "sheet",
    "thesis_internal_pair": "dxf", "tmm42": "svg", "wedge_cam": "stl", "yoke_cam": "svg",
    "james": "motion", "james_laser": "svg", "james_print": "glb", "compound_two_stage": "3mf",
    "sector_gears": "svg", "worm": "dxf", "lesson_3": "pdf", "power_table_laser": "csv",
}  # fmt: skip
QUICK = (("practicum_flat_cam", "stl"), ("practicum_pair", "dxf"))
# sets like those: built whole among the heavy ones, checked with their recipe; coupons, lessons, ovals and worm wheels
# have their own tests
LIKE_JAMES = {
    "bevel_differential", "bevel_reducer", "spiral_bevel_pair",
    "fit_coupon", "kerf_coupon", "oval_gears", "worm_set_print",
    "david", "differential", "ferguson", "one_external_one_internal", "two_internal", "practicum_example_1",
    "practicum_example_2", "practicum_example_3", "practicum_example_3_laser", "practicum_example_3_print",
    "power_table_print", "power_module", "power_module_kinematics", "lesson_1", "lesson_2", "lesson_4", "lesson_5",
    "thesis_worm_1", "thesis_worm_2",
}  # fmt: skip


def formats_of_scenes() -> list[Any]:
    """Every built-in scene with each of the formats that it names."""
    exports = {name: tomllib.loads(path.read_text("utf-8"))["exports"] for name, path in built_in_scenes().items()}
    return [
        pytest.param(name, form, marks=() if DAILY.get(name) == form else pytest.mark.heavy)
        for name, found in exports.items()
        for form in sorted({e["format"] for e in found})
    ]


def test_every_built_in_scene_and_every_format_has_its_day() -> None:
    cases = [case.values for case in formats_of_scenes() if not case.marks]
    assert dict(cases) == DAILY
    assert set(DAILY) | LIKE_JAMES == set(built_in_scenes())
    assert set(DAILY.values()) == {case.values[1] for case in formats_of_scenes()}


# two quick ones by default: all go through the same lines, and each format has its own tests
@pytest.mark.parametrize(("name", "form"), [
    pytest.param(*case.values, marks=() if case.values in QUICK else pytest.mark.heavy) for case in formats_of_scenes()
])  # fmt: skip
def test_a_built_in_scene_builds_and_verifies_in_a_format(name: str, form: str, tmp_path: Path) -> None:
    """Each file is read back once, by the command for it."""
    assert run("build", name, "--out", tmp_path, "--format", form, "--no-verify") == 0
    files = [tmp_path / name / e["path"] for e in read_report(tmp_path / name)["files"]]
    assert files
    assert run("verify", *files) == 0


@pytest.mark.parametrize(
    "arguments",
    [
        (),
        ("biuld",),
        ("build",),
        ("build", "laser_gear", "--frmat", "dxf"),
        ("verify",),
        ("new",),
        ("list", "x"),
        ("build", "laser_gear", "--out"),
        ("build", "laser_gear", "--out", ""),
        ("calc", "spur", "module=2", "number_of_teeth=23", "--out", ""),
        ("converge", "a", "b"),
    ],
    ids=str,
)
def test_a_wrong_command_line_gets_one_line(arguments: tuple[str, ...], capsys: pytest.CaptureFixture[str]) -> None:
    assert "--help" in complaint(capsys, *arguments)


SPUR = ("calc", "spur", "module=2", "number_of_teeth=23")


@pytest.mark.parametrize(
    ("usual", "other"),
    [
        ((*SPUR, "--format", "json"), ("calc", "--format", "json", *SPUR[1:])),
        ((*SPUR, "--format", "json"), (*SPUR[:3], "--format", "json", *SPUR[3:])),
        (("check", "practicum_pair", "tmm42", "--json"), ("check", "practicum_pair", "--json", "tmm42")),
    ],
    ids=["all behind", "some behind", "scenes"],
)
def test_options_may_stand_among_the_words(
    usual: tuple[str, ...], other: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    said = []
    for arguments in (usual, other):
        assert run(*arguments) == 0
        said.append(capsys.readouterr().out)
    assert said[0] == said[1] != ""
    told = complaint(capsys, *other, "--nothing")
    assert f"unrecognized arguments: --nothing; see `higherpair {other[0]} --help`" in told


def test_what_is_left_over_of_a_command_of_one_scene_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert "unrecognized arguments: more;" in complaint(capsys, "new", "spur_gear", "--expand", "more")


def test_a_part_alone_is_well_and_has_nothing_to_run_into(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    # before: refused as wrong input, though it is built
    file = tmp_path / "alone.toml"
    file.write_text(new_scene(capsys, "cam"), encoding="utf-8")
    assert run("check", file) == 0
    assert capsys.readouterr().out == "no mates; no solids run into each other\n"
    file.write_text(file.read_text().replace("lift = 20.0", "lift = -20.0"), encoding="utf-8")
    assert "lift = -20.0" in complaint(capsys, "check", file)


def test_the_arm_that_a_new_cam_shows_swings(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Its pivot and its arm reach the circle of the base circle and the roller that stand above them."""
    for kind in ("cam", "groove_cam"):
        text = re.sub(r"^lift = .*", "swing_deg = 15.0", new_scene(capsys, kind), flags=re.MULTILINE)
        text = re.sub(r"^# (?=oscillating = )", "", text, flags=re.MULTILINE)
        file = tmp_path / "swing.toml"
        file.write_text(text, encoding="utf-8")
        assert run("build", file, "--out", tmp_path / "o", "--format", "svg", "--no-verify") == 0, (
            capsys.readouterr().err
        )


def test_wrong_input_leaves_no_file_and_no_folder(
    tmp_path: Path, scene: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    bad = tmp_path / "bad.toml"
    bad.write_text(scene.read_text(encoding="utf-8").replace("= 23", "= 2"), encoding="utf-8")
    wide = tmp_path / "wide.toml"
    wide.write_text(scene.read_text(encoding="utf-8").replace('"svg"', '"svg"\nkerf = 9.9'), encoding="utf-8")
    fine = tmp_path / "fine.toml"
    fine.write_text(scene.read_text(encoding="utf-8").replace('"stl"', '"stl"\ntolerance = 1e-7'), encoding="utf-8")
    before = {p.name for p in tmp_path.iterdir()}
    for arguments, words in (
        ([bad], "number_of_teeth = 2"), ([wide], "kerf = 9.9"), ([fine], "tolerance = 1e-07"),
        (["no_such_scene"], "see `higherpair list`"), ([tmp_path], "folder"), ([scene, "--part", "h"], "parts: g"),
        ([scene, "--format", "dwg"], "dxf, svg"), ([scene, "--format", "dxf", "--part", "G"], "parts: g"),
    ):  # fmt: skip
        for out in ([], ["--out", "new/deep"]):
            assert words in complaint(capsys, "build", *arguments, *out)
    assert {p.name for p in tmp_path.iterdir()} == before


def test_a_place_below_a_file_is_refused_and_left_alone(
    tmp_path: Path, scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    blocked = tmp_path / "file"
    blocked.write_bytes(b"mine")
    for place in (blocked, blocked / "deep" / "er"):
        assert "--out" in complaint(capsys, "build", scene, "--out", place)
    (tmp_path / "o").mkdir()
    (tmp_path / "o" / "s").write_bytes(b"mine too")
    assert "--out" in complaint(capsys, "build", scene, "--out", tmp_path / "o")
    assert "--out" in complaint(capsys, "build", scene, "--out", tmp_path / ("x" * 300))
    assert {p.name for p in tmp_path.iterdir()} == {"file", "o", "s.toml"}
    assert blocked.read_bytes() == b"mine"


def test_a_folder_where_a_file_should_go_is_refused_and_nothing_else_is_replaced(
    tmp_path: Path, scene: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "o" / "s"
    (folder / "g.stl").mkdir(parents=True)
    complaint(capsys, "build", scene, "--out", tmp_path / "o")
    assert {p.name for p in folder.iterdir()} == {"g.stl"}


@pytest.mark.parametrize("name", ["...toml", "..toml", "a b.toml", "a..toml", "a .toml", ".toml", "noending"])
def test_no_scene_name_leads_out_of_the_folder_for_results(tmp_path: Path, scene: Path, name: str) -> None:
    """A build stands in a folder of its own below --out, or is refused."""
    odd = scene.rename(tmp_path / name)
    code = run("build", odd, "--out", tmp_path / "up" / "out", "--format", "svg")
    written = [p.relative_to(tmp_path) for p in tmp_path.rglob("*") if p.is_file() and p != odd]
    assert (code == 0) == bool(written)
    assert all(p.parts[:2] == ("up", "out") and len(p.parts) == 4 for p in written), written
    # Windows takes dots and blanks off a folder's end
    assert all(p.parts[2] == p.parts[2].rstrip(". ") for p in written), written


def test_verify_complains_about_what_it_cannot_judge(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    build_gear(tmp_path, GEAR, {"format": "svg"})
    folder = tmp_path / "out" / "s"
    stranger = folder / "stranger.svg"
    stranger.write_bytes((folder / "g.svg").read_bytes())
    alone = tmp_path / "g.svg"
    alone.write_bytes(stranger.read_bytes())
    assert "no such file" in complaint(capsys, "verify", folder / "none.svg")
    assert "no such file" in complaint(capsys, "verify", folder)
    assert "g.svg" in complaint(capsys, "verify", stranger)
    assert "report.json" in complaint(capsys, "verify", alone)
    # with --json it was an IndexError
    assert "no such file" in complaint(capsys, "verify", folder / "none.svg", "--json")
    assert run("verify", folder / "g.svg", folder / "g.svg") == 0


@pytest.mark.parametrize("words", [("calc", "spurr"), ("calc", "planetary", "james"), ("new", "spurr")])
def test_words_of_the_command_line_are_told_as_its_usage_tells_them(
    words: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    """``calc: TOPIC = "spurr"`` was told where the usage says ТЕМА."""
    for language in ("en", "uk"):
        assert run(words[0], "--help", "--language", language) == 0
        usage = {word for word in re.findall(r"\w+", capsys.readouterr().out) if word.isupper()}
        told = complaint(capsys, *words, "--language", language)
        assert re.findall(r": (\w+) = ", told)[0] in usage


@pytest.mark.parametrize("name", ["spur_gear", "cam"])
def test_a_scene_to_start_from_names_commands_in_its_language(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """``higherpair new KIND.KEY`` was told in Ukrainian, where the usage says ВИД."""
    assert run("new", name, "--language", "uk") == 0
    commands = re.findall(r"higherpair \w+ (.+)", capsys.readouterr().out)
    assert len(commands) > 2
    assert [c for c in commands if re.search(r"\b[A-Z]{3,}\b", c)] == []


def test_what_the_system_forbids_is_told_in_the_language_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before, of a folder in which nobody may write, as /sys: ``Operation not permitted`` within a Ukrainian line."""

    def forbidden(folder: Path, *args: object, **more: object) -> None:
        raise PermissionError(errno.EPERM, os.strerror(errno.EPERM), str(folder))

    monkeypatch.setattr(Path, "mkdir", forbidden)
    assert run("build", "laser_gear", "--out", tmp_path / "new", "--language", "uk") == 2
    told = capsys.readouterr().err
    assert told.endswith("/laser_gear: система цього не дозволяє; оберіть інше місце через --out\n")


def test_a_file_that_cannot_be_read_does_not_keep_others_from_being_verified(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It was told to choose another place, and the files after it were not looked at."""
    build_gear(tmp_path, GEAR, {"format": "svg"})
    folder = tmp_path / "out" / "s"
    (folder / "locked.svg").write_bytes((folder / "g.svg").read_bytes())
    real = Path.read_bytes

    def locked(file: Path) -> bytes:
        if file.name == "locked.svg":
            raise PermissionError(13, "Permission denied", str(file))
        return real(file)

    monkeypatch.setattr(Path, "read_bytes", locked)
    assert run("verify", folder / "locked.svg", folder / "g.svg") == 2
    out, error = capsys.readouterr()
    assert "locked.svg: cannot be read: Permission denied" in error
    assert error.count("\n") == 1
    assert "g.svg" in out


@pytest.mark.sampled(3)
@pytest.mark.parametrize("spoil", [
    lambda r: [], lambda r: {}, lambda r: 3, lambda r: {"files": 3}, lambda r: {"files": [3]},
    lambda r: r | {"scene": None}, lambda r: r | {"scene": {}}, lambda r: r | {"scene": {"parts": []}},
    lambda r: r | {"scene": r["scene"] | {"parts": {}}}, lambda r: r | {"scene": r["scene"] | {"parts": {"g": 3}}},
    lambda r: r | {"scene": r["scene"] | {"exports": 3}}, lambda r: r | {"scene": r["scene"] | {"exports": [3]}},
    *(lambda r, k=k, v=v: r | {k: v} for k in ("files", "previews", "failed", "left_behind")
      for v in (None, 5, {}, [None], [[]], [{"path": 5}], [{"path": "../g.svg", "sha256": ""}])),
    *(lambda r, v=v: r | {"failed": [{"path": "h.svg", "failures": [], "kept": v}]}
      for v in (5, [1], {}, {"sha256": 1})),
    *(lambda r, v=v: r | {"scene": v} for v in ([], [1], "x", {"scene": []}, {"scene": {"language": []}})),
    *(lambda r, k=k: r | {"files": [{x: y for x, y in r["files"][0].items() if x != k}]}
      for k in ("part", "offset", "tolerance", "max_error", "format", "sha256", "path")),
    *(lambda r, k=k, v=v: r | {"files": [r["files"][0] | {k: v}]}
      for k, v in (("part", "h"), ("part", None), ("offset", "x"), ("offset", 1e9), ("offset", None),
                   ("tolerance", "x"),
                   ("max_error", [1]), ("path", [1]), ("part", {}))),
])  # fmt: skip
def test_a_damaged_report_is_one_line_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], spoil: Callable[[dict[str, Any]], object]
) -> None:
    report = build_gear(tmp_path, GEAR, {"format": "svg"})
    folder = tmp_path / "out" / "s"
    (folder / "report.json").write_text(json.dumps(spoil(report)), encoding="utf-8")
    complaint(capsys, "verify", folder / "g.svg")
    # another build takes nothing over from it
    assert run("build", tmp_path / "s.toml", "--out", tmp_path / "out", "--format", "svg", "--no-verify") == 0
    assert run("verify", folder / "g.svg") == 0


@pytest.mark.sampled(1)
@pytest.mark.parametrize("data", [b"", b"{", b"\xff\xfe", b"[" * 100_000, b"NaN", b'"x"'], ids=lambda d: repr(d)[:12])
def test_a_report_that_is_no_json_is_one_line_too(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], data: bytes
) -> None:
    build_gear(tmp_path, GEAR, {"format": "svg"})
    folder = tmp_path / "out" / "s"
    (folder / "report.json").write_bytes(data)
    assert "report.json" in complaint(capsys, "verify", folder / "g.svg")
    scene = tmp_path / "s.toml"
    assert run("build", scene, "--out", tmp_path / "out", "--format", "svg") == 0
    assert run("verify", folder / "g.svg") == 0


def test_a_process_ends_with_the_same_codes(tmp_path: Path, scene: Path) -> None:
    assert run("build", scene, "--out", tmp_path / "o", "--no-verify") == 0
    file = tmp_path / "o" / "s" / "g.stl"
    good = command("verify", file, cwd=tmp_path)
    assert (good.returncode, good.stderr) == (0, "")
    assert "g.stl" in good.stdout
    file.write_bytes(file.read_bytes()[:-50])
    assert command("verify", file, cwd=tmp_path).returncode == 1
    bad = command("build", "nothing", cwd=tmp_path)
    assert bad.returncode == 2
    assert bad.stdout == ""
    assert bad.stderr.count("\n") == 1


def test_help_and_version() -> None:
    shown = [command(*a, cwd=Path.cwd()) for a in (["--help"], ["build", "--help"], ["--version"])]
    assert [s.returncode for s in shown] == [0, 0, 0]
    assert all(word in shown[0].stdout for word in ("build", "verify", "list", "new"))
    assert all(word in shown[1].stdout for word in ("--out", "--part", "--format", "--no-verify"))
    assert shown[2].stdout.strip() == f"higherpair {__version__}"


def test_list_names_every_built_in_scene_and_kind(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("list") == 0
    out = capsys.readouterr().out
    folder = Path(next(iter(built_in_scenes().values()))).parent
    names = [p.stem for p in folder.glob("*.toml")]
    assert len(names) >= 3
    for name in [*names, "spur_gear"]:
        assert re.search(rf"^\s*{name}\s+\S", out, re.MULTILINE), name


def new_scene(capsys: pytest.CaptureFixture[str], kind: str = "spur_gear") -> str:
    """What `new KIND` prints."""
    capsys.readouterr()
    assert run("new", kind) == 0
    return capsys.readouterr().out


@pytest.mark.parametrize("name", ["spur_gear", "planetary_set", "idler_train"])
def test_a_scene_to_start_from_is_told_in_the_language_in_which_it_was_asked_for(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    capsys.readouterr()
    assert run("new", name, "--language", "uk") == 0
    assert tomllib.loads(capsys.readouterr().out)["scene"]["language"] == "uk"


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", ALONE)
def test_the_scene_to_start_from_builds(kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "mine.toml"
    file.write_text(new_scene(capsys, kind), encoding="utf-8")
    assert run("build", file, "--out", tmp_path / "o") == 0
    report = read_report(tmp_path / "o" / "mine")
    # nothing is asked for that the kind has not
    assert report["left_out"] == []
    wanted = {"stl"} | ({"dxf", "svg"} if KINDS[kind].has_outline else {"step"})
    assert {e["format"] for e in report["files"]} >= wanted


@pytest.mark.sampled(8)
@pytest.mark.parametrize("kind", MATES)
def test_new_prints_every_mate_with_its_keys(kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    table = tomllib.loads(new_scene(capsys, kind))["mates"][0]
    assert table["kind"] == kind
    assert {"first", "second"} <= set(table)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("kind", MATES)
def test_a_mate_of_which_there_is_a_scene_names_the_command_that_prints_it(
    kind: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """One of its own name, or any that has it."""
    assert run("new", kind) == 0
    said = capsys.readouterr().out.splitlines()
    commands = [line.partition("higherpair ")[2] for line in said if line.startswith("# A whole scene")]
    having = [
        name for name, file in built_in_scenes().items() if f'kind = "{kind}"' in file.read_text(encoding="utf-8")
    ]
    assert bool(commands) is bool(having)
    for told in commands:
        assert kind not in having or told == f"new {kind}.toml"
        assert run(*told.split()) == 0
        assert f'kind = "{kind}"' in capsys.readouterr().out


@pytest.mark.sampled(10)
@pytest.mark.parametrize("kind", KINDS)
def test_the_mate_at_the_end_of_a_new_scene_joins_its_kind(kind: str, capsys: pytest.CaptureFixture[str]) -> None:
    text = new_scene(capsys, kind)
    told = tomllib.loads("\n".join(line[3:] for line in text.splitlines() if line.startswith("## ")))
    mate, partner = told["mates"][0], re.search(r'second part, \[parts\.(\w+)\](?: of kind "(\w+)")?', text)
    joined = MATES[mate["kind"]].joins
    (own,) = (name for name, part in tomllib.loads(text)["parts"].items() if part["kind"] == kind)
    kinds = {own: kind, partner[1]: partner[2]}
    assert joined is None or (kinds[mate["first"]], kinds[mate["second"]]) in joined
    assert ("transmission_error" in text) is mate["kind"].endswith(
        ("external_gear_pair", "internal_gear_pair", "rack_pair")
    )


@pytest.mark.sampled(3)
@pytest.mark.parametrize("kind", ["spur_gear", "rack", "cam", "lantern_gear", "geneva_wheel", "geneva_driver"])
def test_a_new_scene_with_its_second_part_and_without_both_marks_stands(
    kind: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """All that follows the part too: both instances and one more, the mate, the drive of what may drive."""
    text = new_scene(capsys, kind)
    partner = re.search(r'second part, \[parts\.(\w+)\] of kind "(\w+)"', text)
    assert partner is not None
    text = re.sub("^## ?", "", text, flags=re.MULTILINE)
    if f"[parts.{partner[1]}]" not in text.replace(partner[0], ""):
        other = new_scene(capsys, partner[2]).partition("[[exports]]")[0].rpartition("[parts.")[2].partition("]")[2]
        text += f"[parts.{partner[1]}]{other}".replace('of = "source"', f'of = "{kind}"')
    (tmp_path / "s.toml").write_text(text, encoding="utf-8")
    assert run("check", tmp_path / "s.toml") == 0


def test_every_commented_key_may_be_set_alone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Defaults and examples as printed: each on its own builds, so that nobody starts with an error."""
    lines = new_scene(capsys).splitlines()
    keys = [i for i, line in enumerate(lines) if re.match(r"# [a-z_]+ = \S", line)]
    assert len(keys) > 15
    for index in some_of(keys, 6):
        changed = [line.removeprefix("# ") if i == index else line for i, line in enumerate(lines)]
        file = tmp_path / "one.toml"
        file.write_text("\n".join(changed), encoding="utf-8")
        assert run("build", file, "--out", tmp_path / "o", "--no-verify") == 0, lines[index]


def test_all_commented_keys_together_build_or_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = re.sub(r"^# (?=[a-z_]+ = \S)", "", new_scene(capsys), flags=re.MULTILINE)
    file = tmp_path / "all.toml"
    file.write_text(text, encoding="utf-8")
    assert run("build", file, "--out", tmp_path / "o") in (0, 2)
    assert "Traceback" not in capsys.readouterr().err


def test_new_knows_its_kinds(capsys: pytest.CaptureFixture[str]) -> None:
    assert "did you mean spur_gear" in complaint(capsys, "new", "spur_gaer")


@pytest.fixture
def ukrainian(tmp_path: Path) -> Path:
    """A scene that reports in Ukrainian."""
    head = '[scene]\ntitle = "Шестерня [b]"\nlanguage = "uk"\n\n'
    return write_scene(tmp_path / "uk.toml", {"g": part_keys(Gear(2, 8))}, [{"format": "svg"}], head)


def test_output_in_ukrainian(tmp_path: Path, ukrainian: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("build", ukrainian, "--out", tmp_path / "o") == 0
    out = capsys.readouterr().out
    assert "Шестерня [b]" in out
    assert "похибка" in out
    assert "зубець підрізаний" in out
    assert "undercut" not in out
    picture = (tmp_path / "o" / "uk" / "g.preview.svg").read_text(encoding="utf-8")
    assert "діаметр вершин" in picture


@pytest.mark.sampled(1)
@pytest.mark.parametrize("encoding", ["ascii", "cp1252", "cp1251", "utf-8"])
def test_output_in_ukrainian_on_a_console_of_another_alphabet(tmp_path: Path, ukrainian: Path, encoding: str) -> None:
    environment = {**os.environ, "PYTHONIOENCODING": encoding, "PYTHONUTF8": "0"}
    done = subprocess.run([sys.executable, "-m", "exporters", "build", str(ukrainian), "--out", "o"], cwd=tmp_path,
                          env=environment, capture_output=True, timeout=60, check=False)  # fmt: skip
    assert done.returncode == 0, done.stderr.decode(errors="replace")
    assert done.stderr == b""
    assert b"g.svg" in done.stdout


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of POSIX")
def test_a_reader_that_goes_away_is_no_error(tmp_path: Path) -> None:
    done = subprocess.run(f'"{sys.executable}" -m exporters list | head -c 1', shell=True, cwd=tmp_path, text=True,
                          capture_output=True, timeout=60, check=False)  # fmt: skip
    assert done.stderr == ""
    shut = subprocess.run(f'"{sys.executable}" -m exporters new spur_gear >&-', shell=True, cwd=tmp_path, text=True,
                          capture_output=True, timeout=60, check=False)  # fmt: skip
    assert "Traceback" not in shut.stderr


def test_a_pattern_that_the_shell_left_alone_means_its_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Those of Windows leave all of them, and the README's `verify out/.../*.dxf` found no such file."""
    monkeypatch.chdir(tmp_path)
    for name in ("one", "two"):
        write_scene(tmp_path / f"{name}.toml", {"g": part_keys(Gear(2, 23))}, [{"format": "dxf"}, {"format": "svg"}])
    assert run("build", "*.toml", "--out", "out", "--quiet") == 0
    assert sorted(p.name for p in (tmp_path / "out").iterdir()) == ["one", "two"]
    capsys.readouterr()
    assert run("verify", "out/*/*.dxf", "--json") == 0
    assert len(json.loads(capsys.readouterr().out)) == 2
    # a file whose own name has such a letter is that file, and a pattern of no file is told as it is
    (tmp_path / "out/one/g.dxf").rename(tmp_path / "out/one/g?.dxf")
    (tmp_path / "out/one/gg.dxf").write_text("no DXF")
    assert run("verify", "out/one/g?.dxf") == 2
    assert "g?.dxf" in capsys.readouterr().err
    assert run("verify", "out/*/*.stl") == 2
    assert "*.stl: no such file" in capsys.readouterr().err


def test_what_a_line_of_the_readme_has_behind_its_command_is_no_word_of_it(capsys: pytest.CaptureFixture[str]) -> None:
    """Shells that know no comments there hand them on: cmd, and zsh where somebody types."""
    assert run("calc", "involute", "angle_deg=20", "#", "also:", "involute=0.037985", "--nothing") == 0
    assert "0.0149" in capsys.readouterr().out
    assert run("calc", "involute", "angle_deg=20", "#also:") == 2

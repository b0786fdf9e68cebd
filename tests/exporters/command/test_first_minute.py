"""The first minute with the command: a scene to start from, its files named, results for people and for programs."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from exporters.command.cli import main
from exporters.command.new import new_scene
from exporters.documents.topics import TOPICS
from parts.base.registry import KINDS
from parts.mates.registry import MATES
from parts.recipes.registry import RECIPES
from parts.scene.files import SCENE_FOLDER, built_in_scenes
from tests.exporters.making import part_keys, run, write_scene
from tests.exporters.outside import Gear
from tests.sampling import some_of

GEAR = part_keys(Gear(2, 23))
HEAD = '[scene]\ntitle = "Колесо"\nlanguage = "uk"\n'


def said(capsys: pytest.CaptureFixture[str], *arguments: object) -> str:
    capsys.readouterr()
    assert run(*arguments) == 0
    return capsys.readouterr().out


def test_the_schema_takes_every_built_in_scene_and_every_new_one_and_no_wrong_one(
    capsys: pytest.CaptureFixture[str],
) -> None:
    import jsonschema

    text = said(capsys, "schema")
    judge = jsonschema.Draft202012Validator(json.loads(text))
    # an editor shows descriptions as they stand
    assert "``" not in text
    for file in some_of(built_in_scenes().values(), 12):
        assert not list(judge.iter_errors(tomllib.loads(file.read_text(encoding="utf-8")))), file
    for kind in some_of((*KINDS, *RECIPES), 10):
        assert not list(judge.iter_errors(tomllib.loads(said(capsys, "new", kind)))), kind
    wrong = [GEAR | {"modul": 1}, GEAR | {"number_of_teeth": 2}, {"kind": "spur_gaer"}]
    for spoiled in (
        {"parts": {}},
        {"scene": {}},
        {"assemblies": [{"kind": "planetary_set"}]},
        {"parts": {"g": GEAR}, "export": []},
        *({"parts": {"g": keys}} for keys in wrong),
    ):
        assert list(judge.iter_errors(spoiled)), spoiled
    assert not list(judge.iter_errors({"parts": {"g": GEAR}}))


@pytest.mark.parametrize("language", ["en", "uk"])
def test_new_writes_a_file_that_builds_whatever_the_terminal_can_show(tmp_path: Path, language: str) -> None:
    file = tmp_path / "my_gear.toml"
    assert run("new", "spur_gear", "--language", language, "--out", file) == 0
    assert run("build", file, "--out", tmp_path, "--format", "svg") == 0


def test_new_tells_every_key_of_a_table_and_each_bore_that_it_shows_is_made(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """``new`` shows a table in one line: what ``flat`` is measured from, the schema alone told."""
    text = said(capsys, "new", "spur_gear.bore")
    assert re.search(r"^flat = 7\.0 +# from the flat to the opposite side: at least", text, re.MULTILINE)
    blocks = text.split("\n\n")[1:]
    assert len(blocks) == 8
    gear = '[parts.gear]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 40\n[[exports]]\nformat = "svg"\n'
    for number, block in enumerate(blocks):
        file = tmp_path / f"bore_{number}.toml"
        # a spline is told by its designation
        file.write_text(gear + block.replace("# size =", "size =") + "\n", encoding="utf-8")
        assert run("check", "-q", file) == 0, block
        assert all(" # " in line for line in block.splitlines()[3:]), block
    deep = said(capsys, "new", "layered.layers.outlines")
    assert deep.isascii()
    assert re.search(r"^# count = 1 +# how often", deep, re.MULTILINE)
    assert "[[parts.layered.layers.outlines]]" in deep
    assert "\n# checked = " in said(capsys, "new", "exports.title_block")


# what is asked for, what it is no known one of, what was meant
NO_TABLES = [
    ("spur_gear.module", "table", ""),
    ("spur_gear.bor", "table", "spur_gear.bore"),
    ("spur_gear.bore.flat", "table", "spur_gear.bore"),
    ("plate.hole", "table", "plate.holes"),
    ("exports.paper", "table", ""),
    ("gear.bore", "kind", ""),
]


@pytest.mark.parametrize(("place", "what", "meant"), NO_TABLES)
def test_a_key_that_takes_no_table_is_refused_with_those_that_do(
    place: str, what: str, meant: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("new", place) == 2
    told = capsys.readouterr().err
    assert f'KIND = "{place}": unknown {what}' in told
    assert not meant or told.endswith(f"did you mean {meant}?\n")


def test_new_in_english_is_ascii(capsys: pytest.CaptureFixture[str]) -> None:
    """A shell that reads a pipe in its own code page spoils nothing."""
    for kind in (*KINDS, *MATES, *RECIPES):
        assert said(capsys, "new", kind).isascii(), kind


def test_new_prints_a_built_in_scene(capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("practicum_pair", "barrel_cam"):
        text = (SCENE_FOLDER / f"{name}.toml").read_text(encoding="utf-8")
        assert said(capsys, "new", f"{name}.toml") == text
        # the name alone is that of a kind where there is one
        assert (said(capsys, "new", name) == text) is (name not in KINDS)


def test_a_file_that_stands_is_told_before_the_page_is_made(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (file := tmp_path / "mine.txt").write_text("mine", encoding="utf-8")
    # what the page would say of it
    assert run("calc", "gear-pair", "no_such_scene", "--out", file) == 2
    assert "exists already" in capsys.readouterr().err


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("name", "begins"), [
    ("p.html", "<!DOCTYPE html>"), ("p.HTM", "<!DOCTYPE html>"), ("p.md", "# External gear"), ("p.json", "{"),
    ("p.csv", "higherpair"), ("p.txt", "External gear"), ("p", "External gear"),
])  # fmt: skip
def test_a_page_has_the_form_that_its_file_s_ending_tells(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str, begins: str
) -> None:
    """Unless one is asked for; tables as CSV are refused where there are none."""
    words = ("calc", "spur", "module=2", "number_of_teeth=23", "--out")
    assert run(*words, tmp_path / name) == (2 if name == "p.csv" else 0)
    told = capsys.readouterr().err if name == "p.csv" else (tmp_path / name).read_text(encoding="utf-8")
    assert told.startswith(begins)
    assert run(*words, tmp_path / f"text.{name}", "--format", "text") == 0
    assert (tmp_path / f"text.{name}").read_text(encoding="utf-8").startswith("External gear")


@pytest.mark.parametrize("name", ["p.docx", "p.pdf", "p.XLSX", "p.v2"])
def test_a_page_is_no_file_of_another_program(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    """Text under such a name is broken for what opens it; whoever asks for text has it under any."""
    words = ("calc", "spur", "module=2", "number_of_teeth=23", "--out", tmp_path / name)
    assert run(*words) == 2
    assert f'--out = "{name}": the ending of such a file: .txt, ' in (told := capsys.readouterr().err)
    assert '"p.html" works' in told
    assert not list(tmp_path.iterdir())
    assert run(*words, "--format", "text") == 0


@pytest.mark.parametrize("command", [("new", "spur_gear"), ("schema",), ("calc", "gear-pair", "practicum_pair")])
def test_no_page_is_written_over_a_file(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], command: tuple[str, ...]
) -> None:
    """Nor through a link, or into a device."""
    file, link = tmp_path / "mine.txt", tmp_path / "link.md"
    file.write_text("mine", encoding="utf-8")
    link.symlink_to(tmp_path / "nothing")
    for place in (file, link, Path(os.devnull)):
        assert run(*command, "--out", place) == 2
        assert "exists already" in capsys.readouterr().err
        if place != file:
            assert run(*command, "--force", "--out", place) == 2
            assert "exists already, and is a link or a device" in capsys.readouterr().err
    assert run(*command, "--out", tmp_path) == 2
    assert "is a folder; give the name of a file in it" in capsys.readouterr().err
    assert file.read_text(encoding="utf-8") == "mine"
    assert link.is_symlink()
    assert run(*command, "--force", "--out", file) == 0
    written = capsys.readouterr().out
    assert str(file) in written
    page = file.read_text(encoding="utf-8")
    assert run(*command) == 0
    assert page == capsys.readouterr().out
    missing = tmp_path / "none" / "a.md"
    assert run(*command, "--out", missing) == 2
    assert f"{missing}: No such file" in capsys.readouterr().err
    assert run(*command, "--language", "uk", "--out", missing) == 2
    assert f"{missing}: немає такого файлу чи теки; " in capsys.readouterr().err
    assert {p.name for p in tmp_path.iterdir()} == {"mine.txt", "link.md"}


def test_the_help_names_every_topic(capsys: pytest.CaptureFixture[str]) -> None:
    shown = said(capsys, "calc", "--help")
    assert all(topic in shown for topic in TOPICS)


@pytest.mark.parametrize("topic", TOPICS)
def test_a_topic_tells_every_key_that_its_refusals_know(capsys: pytest.CaptureFixture[str], topic: str) -> None:
    """Of two gears those of each are told by their kind; of many a refusal tells the first, and how many more."""
    shown = said(capsys, "calc", topic, "--keys")
    told = set(re.findall(r"(?m)^(?:# )?(\w+) = ", shown))
    for name, kind in re.findall(r"(?m)^# (\w+)\.KEY=…: see higherpair new (\w+)$", shown):
        told |= {name, "kind", *re.findall(r"(?m)^(?:# )?(\w+) = ", said(capsys, "new", kind).partition("[parts")[2])}
    told |= set(re.findall(r"(?m)^(\w+)\.\w+ = ", shown))
    assert run("calc", topic, "nothing=1") == 2
    known = re.search(
        r"known keys: ([\w, ]+?)(?: and (\d+) more, see .*)?(?:; did you mean .*)?$", capsys.readouterr().err.strip()
    )
    assert known
    first = set(known[1].split(", "))
    assert first <= told
    assert len(first) + int(known[2] or 0) <= len(told)


@pytest.mark.parametrize(
    ("topic", "typed"),
    [("cam", "kind=barrel_cam"), ("gear-pair", "second.kind=rack"), ("shift-choice", "second.kind=ring_gear")],
)
def test_a_topic_tells_the_other_kinds_it_has_pages_of(
    capsys: pytest.CaptureFixture[str], topic: str, typed: str
) -> None:
    kind = typed.partition("=")[2]
    assert f"# {typed}: see higherpair new {kind}\n" in said(capsys, "calc", topic, "--keys")
    assert kind in said(capsys, "new", kind)


def test_a_key_tells_its_own_meaning(capsys: pytest.CaptureFixture[str]) -> None:
    """Not that of its type: a stress; a length."""
    shown = said(capsys, "calc", "power-module", "--keys")
    assert re.search(r"bending_limit = 580.0 +# sigma_Flim of the pair's teeth: above 0", shown)
    assert run("calc", "power-module", "bending_limit=-1") == 2
    assert "sigma_Flim" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "meant"),
    [
        ("spur m=2", "module"), ("spur z=20", "number_of_teeth"), ("spur x=0.3", "profile_shift_coefficient"),
        ("spur beta=10", "helix_angle_deg"), ("gear-pair z1=20", "first.number_of_teeth"),
        ("gear-pair x2=0.5", "second.profile_shift_coefficient"),
        ("gear-pair aw=90", "working_centre_distance"),
        ("worm friction=0.1", "friction_coefficient"),
        ("worm z1=2", "number_of_starts"), ("worm q=10", "diameter_quotient"), ("bevel z2=40", "mate_number_of_teeth"),
        ("bevel mate_teeth=40", "mate_number_of_teeth"),
        ("bevel beta=35", "spiral_angle_deg"), ("bevel helix_angle_deg=35", "spiral_angle_deg"),
        ("planetary u=5", "ratio"), ("lever omega=10", "speed"), ("cam e=5", "follower_offset"),
        ("flywheel z=2", "lever"), ("epicyclic u=5", "planetary"), ("lever first=four_bar", "rods"),
    ],
)  # fmt: skip
def test_letters_and_words_of_books_lead_to_keys(capsys: pytest.CaptureFixture[str], words: str, meant: str) -> None:
    assert run("calc", *words.split()) == 2
    assert f"did you mean {meant}?" in capsys.readouterr().err


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16"])
def test_a_scene_with_a_mark_of_byte_order_is_read(tmp_path: Path, encoding: str) -> None:
    """PowerShell's > writes UTF-16, Notepad UTF-8 with a mark."""
    scene = write_scene(tmp_path / "s.toml", {"g": GEAR}, [{"format": "svg"}], HEAD)
    scene.write_text(scene.read_text(encoding="utf-8"), encoding=encoding)
    assert run("build", scene, "--out", tmp_path / "o") == 0
    report = json.loads((tmp_path / "o/s/report.json").read_text(encoding="utf-8"))
    assert report["scene"]["scene"]["title"] == "Колесо"


@pytest.mark.parametrize("encoding", ["utf-16-le", "utf-16-be", "utf-16"])
def test_a_scene_of_utf16_without_a_mark_is_told_how_to_be_saved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], encoding: str
) -> None:
    scene = write_scene(tmp_path / "s.toml", {"g": GEAR}, [{"format": "svg"}], HEAD)
    scene.write_text(scene.read_text(encoding="utf-8"), encoding=encoding)
    if encoding == "utf-16":
        # a mark at the head alone makes no text of what follows
        scene.write_bytes(b"\xef\xbb\xbf" + scene.read_bytes()[2:])
    assert run("build", scene, "--out", tmp_path / "o") == 2
    assert "save it as UTF-8" in capsys.readouterr().err


def test_a_pipe_gets_utf8_whatever_the_locale(tmp_path: Path) -> None:
    """A terminal may lack a letter, a file does not."""
    plain = {**os.environ, "LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONIOENCODING": "cp1252", "PYTHONCOERCECLOCALE": "0"}
    command = [sys.executable, "-m", "exporters", "calc", "gear-pair", "practicum_pair", "--language", "uk"]
    done = subprocess.run(command, capture_output=True, env=plain, check=True, timeout=60)
    file = tmp_path / "page.txt"
    assert run(*command[3:], "--out", file) == 0
    assert done.stdout.decode("utf-8").splitlines() == file.read_text(encoding="utf-8").splitlines()


def test_the_table_of_a_build_fits_a_page_and_names_what_an_earlier_build_left(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    name = "a_gear_with_a_long_name_that_nobody_would_cut_short"
    both = [{"format": "dxf"}, {"format": "svg"}]
    scene = write_scene(tmp_path / "s.toml", {"g": GEAR, name: GEAR}, both)
    lines = said(capsys, "build", scene, "--out", tmp_path / "o").splitlines()
    table = [line for line in lines if not line.startswith("preview") and str(tmp_path) not in line]
    assert max(map(len, table)) <= 80
    assert f"{name}.dxf" in lines
    write_scene(tmp_path / "s.toml", {"g": GEAR, name: GEAR}, both[:1])
    for options in ((), ("--format", "dxf")):
        out = said(capsys, "build", scene, "--out", tmp_path / "o", *options)
        assert {f"note: {tmp_path / 'o/s' / f'{part}.svg'} is of an earlier build: this one does not make it"
                for part in ("g", name)} <= {*out.splitlines()}  # fmt: skip
    (tmp_path / "o/s/g.svg").unlink()
    assert "g.svg is of" not in said(capsys, "build", scene, "--out", tmp_path / "o")


def test_what_was_not_asked_for_is_not_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    exports = [{"format": "dxf", "parts": ["g"]}, {"format": "svg"}]
    scene = write_scene(tmp_path / "s.toml", {"g": GEAR, "h": GEAR}, exports)
    assert "left out" not in said(capsys, "build", scene, "--out", tmp_path / "o", "--format", "dxf")
    assert "left out" not in said(capsys, "build", scene, "--out", tmp_path / "o", "--part", "g")
    write_scene(tmp_path / "s.toml", {"g": GEAR, "h": GEAR}, exports[:1])
    assert "left out: parts.h" in said(capsys, "build", scene, "--out", tmp_path / "o")


def test_several_scenes_at_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("one", "two"):
        write_scene(tmp_path / f"{name}.toml", {"g": GEAR}, [{"format": "svg"}])
    made = [tmp_path / "one.toml", tmp_path / "two.toml"]
    found = json.loads(said(capsys, "build", *made, "--out", tmp_path / "o", "--json"))
    assert [report["scene"]["name"] for report in found] == ["one", "two"]
    # wrong input makes nothing, whichever scene it is in
    (tmp_path / "one.toml").write_text("[parts.g]\nkind = 3", encoding="utf-8")
    assert run("build", *made, "--out", tmp_path / "p") == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "p").exists()
    (tmp_path / "x").mkdir()
    twin = write_scene(tmp_path / "x/TWO.toml", {"g": GEAR}, [{"format": "svg"}])
    assert run("build", made[1], twin, "--out", tmp_path / "q") == 2
    assert "one folder" in capsys.readouterr().err
    assert not (tmp_path / "q").exists()


def test_a_text_beside_a_scene_of_its_name_has_a_folder_of_its_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Alone it has that of its name without the ending."""
    for name, folder in (("a.txt", "a"), ("a.toml", "a"), ("a.txt", "a.txt")):
        scene = write_scene(tmp_path / name, {"g": GEAR}, [{"format": "svg"}])
        assert f"{folder}\n" in said(capsys, "build", scene, "--out", tmp_path / "o").replace("/g.svg", "")
    assert {p.name for p in (tmp_path / "o").iterdir()} == {"a", "a.txt"}


def test_results_as_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = write_scene(tmp_path / "s.toml", {"g": GEAR}, [{"format": "svg"}])
    report = json.loads(said(capsys, "build", scene, "--out", tmp_path, "--json"))
    assert report == json.loads((tmp_path / "s/report.json").read_text(encoding="utf-8"))
    file = tmp_path / "s/g.svg"
    found = json.loads(said(capsys, "verify", file, "--json"))
    assert (found["file"], found["ok"], found["same_bytes"]) == (str(file), True, True)
    assert 0 < found["measured"]["max_deviation"] <= found["declared"] <= found["tolerance"]
    file.write_text(file.read_text(encoding="utf-8").replace(" A0.", " A0.5", 1), encoding="utf-8")
    capsys.readouterr()
    assert run("verify", file, "--json") == 1
    spoiled = json.loads(capsys.readouterr().out)
    assert not spoiled["ok"]
    assert spoiled["failures"]
    checks = json.loads(said(capsys, "check", "practicum_pair", "--json"))
    assert checks["mates"][0]["verdict"] == "contact"
    assert set(json.loads(said(capsys, "list", "--json"))["parts"]) == set(KINDS)


def test_a_quiet_command_speaks_of_faults_only(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = write_scene(tmp_path / "s.toml", {"g": GEAR}, [{"format": "svg"}])
    file = tmp_path / "s/g.svg"
    assert said(capsys, "build", scene, "-q", "--out", tmp_path) == ""
    assert said(capsys, "verify", file, "-q") == said(capsys, "check", "practicum_pair", "-q") == ""
    file.write_text("<svg/>", encoding="utf-8")
    assert run("verify", file, "-q") == 1
    assert "FAILED" in capsys.readouterr().out


def test_a_long_value_of_a_calculation_is_no_file_name(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("calc", "spur", f"module={'9' * 300}") == 2
    assert "module" in capsys.readouterr().err


def test_a_film_of_one_part_is_not_left_out_in_silence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    only = ("--part", "wheel", "--format", "motion", "--out", tmp_path / "o")
    assert run("build", "geneva_drive", *only) == 2
    told = capsys.readouterr().err
    assert (
        told == 'higherpair: geneva_drive: --format = "motion": makes no file of a part alone here; leave --part out\n'
    )
    assert not (tmp_path / "o").exists()


@pytest.mark.sampled(3)
@pytest.mark.parametrize("words", [("calc", "spur"), ("build",), ("check",), ("verify",)])
@pytest.mark.parametrize("length", [251, 255, 256])
def test_a_name_that_is_too_long_is_no_matter_of_another_place(
    words: tuple[str, ...], length: int, capsys: pytest.CaptureFixture[str]
) -> None:
    """With its ending it is longer than names may be: asked whether such a file stands there, the system complains."""
    assert run(*words, "a" * length) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert "choose another place" not in told


def test_the_version_has_a_short_name(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as ended:
        main(["-V"])
    assert ended.value.code == 0
    assert capsys.readouterr().out.startswith("higherpair ")


@pytest.mark.parametrize(("language", "word"), [("en", "unrecognized"), ("uk", "невідомі"), ("xx", "unrecognized")])
def test_a_wrong_flag_is_told_in_the_language_that_is_asked_for(
    language: str, word: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("list", "--language", language, "--bogus") == 2
    assert word in capsys.readouterr().err.lower()


def test_a_plate_is_shown_with_what_it_is_fixed_to() -> None:
    """The first mate that joins plates is that of a linkage's members."""
    shown = new_scene("plate")
    assert '## kind = "fixed"' in shown
    assert "linkage" not in shown


@pytest.mark.parametrize(("command", "closest"), [("bulid", "build"), ("chek", "check"), ("catalog", "catalogue")])
def test_a_slip_in_a_command_is_answered_with_the_one_that_was_meant(
    command: str, closest: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(command, "practicum_pair") == 2
    told = capsys.readouterr().err
    assert f"'{command}', maybe you meant '{closest}'?" in told
    assert told.count("\n") == 1
    assert run("flurb", "practicum_pair") == 2
    assert "maybe" not in capsys.readouterr().err


@pytest.mark.parametrize("word", ["dfx", "slt", "svgg", "setp"])
def test_a_slip_in_a_format_is_answered_with_the_one_of_its_letters(
    word: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two letters in the wrong order are nearer than another word of most of them: dfx was answered with pdf."""
    assert run("build", "practicum_pair", "--format", word, "--out", tmp_path) == 2
    wanted = {"dfx": "dxf", "slt": "stl", "svgg": "svg", "setp": "step"}[word]
    assert f"did you mean {wanted}?" in capsys.readouterr().err

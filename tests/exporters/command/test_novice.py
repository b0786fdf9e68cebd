"""What a beginner types into a scene, and the one line that the command answers, in both languages."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from exporters.command.cli import main

PAIR = """[parts.a]
kind = "spur_gear"
module = 2.0
number_of_teeth = 17
face_width = 5.0
[parts.b]
kind = "spur_gear"
module = 2.0
number_of_teeth = 30
face_width = 5.0
[[mates]]
kind = "external_gear_pair"
first = "a"
second = "b"
[[exports]]
format = "dxf"
"""


def line(tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str | bytes, language: str = "en") -> str:
    """What ``check`` says of a scene that is refused."""
    file = tmp_path / "x.toml"
    file.write_bytes(text if isinstance(text, bytes) else text.encode())
    assert main(["check", str(file), "--language", language]) == 2
    said = capsys.readouterr()
    assert not said.out
    (told,) = said.err.splitlines()
    return told.removeprefix(f"higherpair: {file}: ")


# the line after which a key is typed, that key, and the answer
MISPLACED = (
    ("[parts.a]", "kerf = 0.2", "parts.a.kerf = 0.2: kerf belongs to [defaults] or [[exports]]"),
    ("[parts.a]", "normal_backlash = 0.1", "normal_backlash belongs to [defaults] or [[mates]]"),
    ("[parts.a]", "at = [0, 0, 0]", "at belongs to [instances.NAME]"),
    ("[parts.a]", "interference = true", "interference belongs to [checks]"),
    # a table of the part's own is told first
    ("[parts.a]", "count = 5", "count belongs to holes or spokes or [instances.NAME]"),
    ("[parts.a]", "diameter_quotient = 2", 'diameter_quotient belongs to [parts.NAME] of kind "worm_wheel", "worm"'),
    # in a table of a part that has the key itself
    ("[parts.a]", "hub = { diameter = 14, module = 2 }", "parts.a.hub.module = 2: module belongs to [parts.a]"),
    # a corner has x and y: the `at` of instances and the `centre` of plates are no help
    ("[parts.a]", "spokes = { count = 5, width = 4.0, at = [1.0, 2.0] }", "unknown key; known keys: count, width"),
    ("[parts.a]", "holes = { count = 5, centre = [1.0, 2.0] }", "unknown key; known keys: count, diameter"),
    # a near spelling of its own table's, or another book's word, is told before other tables
    ("[parts.a]", "face_widht = 2.0", "did you mean face_width?"),
    ("[parts.a]", "thickness = 2.0", "did you mean face_width?"),
    # a maker's words: letters lead the first one to the chamfer of the teeth's tips, the second nowhere
    ("[parts.a]", "chamfer = 0.3", "did you mean face_chamfer?"),
    ("[parts.a]", "elephant_foot = 0.3", "did you mean face_chamfer.below?"),
    ("[scene]", "kerf = 0.2", "scene.kerf = 0.2: kerf belongs to [defaults] or [[exports]]"),
    ("[scene]", "teeth = 20", "number_of_teeth belongs to [defaults] or [parts.NAME]"),
    ('kind = "external_gear_pair"', "module = 2.0", "is no key of a mate, but one of parts.a; write it there"),
    # it was sent to face_width
    ('kind = "external_gear_pair"', "height = 8.0", "mates[1].height = 8.0: at belongs to [instances.NAME]"),
    ('kind = "external_gear_pair"', "turns = 2.0", "turns belongs to [[drives]]"),
    ("[[exports]]", 'title = "x"', "title belongs to [parts.NAME] or [scene] or [instances.NAME]"),
    ("[defaults]", 'language = "uk"', "language belongs to [scene]"),
    # nothing has it anywhere
    ("[parts.a]", "colur_of_hair = 1", "unknown key; known keys"),
    ("[checks]", "xyzzy = 1", "unknown key; known keys: interference, workspace, transmission_error"),
)


@pytest.mark.parametrize(("after", "typed", "told"), MISPLACED, ids=lambda value: str(value)[:30])
def test_a_key_in_the_wrong_table_is_told_where_it_belongs(
    after: str, typed: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = PAIR if after in PAIR else f"{after}\n{PAIR}"
    assert told in line(tmp_path, capsys, text.replace(after, f"{after}\n{typed}", 1))


def test_a_key_above_all_tables_is_told_where_it_belongs(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert line(tmp_path, capsys, "kerf = 0.2\n" + PAIR) == "kerf = 0.2: kerf belongs to [defaults] or [[exports]]"


def test_a_key_that_other_kinds_in_the_scene_have_is_none_of_the_defaults(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """In [defaults] it would be that of the gears and still none of the bevel gear, which has hub_diameter."""
    bevel = '[parts.c]\nkind = "bevel_gear"\nmodule = 2.0\nnumber_of_teeth = 20\nmate_number_of_teeth = 40\n'
    told = line(tmp_path, capsys, f"{bevel}hub = {{ diameter = 20 }}\n{PAIR}")
    assert told.startswith('parts.c.hub = { diameter = 20 }: hub belongs to [parts.NAME] of kind "spur_gear", ')


def test_it_is_told_in_ukrainian_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = PAIR.replace("[parts.a]", "[parts.a]\nkerf = 0.2")
    assert line(tmp_path, capsys, text, "uk").endswith("kerf належить до [defaults] або [[exports]]")
    text = PAIR.replace("[parts.a]", "[parts.a]\ndiameter_quotient = 2")
    assert 'diameter_quotient належить до [parts.NAME] виду "worm_wheel", "worm"' in line(tmp_path, capsys, text, "uk")


def test_a_backlash_that_leaves_no_teeth_names_the_gears_and_the_greatest_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = PAIR.replace('second = "b"', 'second = "b"\nnormal_backlash = {}')
    told = line(tmp_path, capsys, text.format(9.0))
    assert told == "mates[1].normal_backlash = 9.0: leaves no whole teeth; gears: a, b; at most 2.267 mm works"
    assert "не лишає цілих зубців; колеса: a, b" in line(tmp_path, capsys, text.format(9.0), "uk")
    # between the limits of both only the smaller one is named
    assert "gears: a; at most 2.267 mm works" in line(tmp_path, capsys, text.format(2.3))
    file = tmp_path / "x.toml"
    file.write_text(text.format(2.267))
    assert main(["check", str(file)]) == 0


@pytest.mark.parametrize("letter", ["\u200b", "\ufeff"], ids=["U+200B", "U+FEFF"])
def test_a_character_that_nobody_sees_is_named_by_its_line(
    letter: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = PAIR.replace("number_of_teeth = 17", f"number_of_teeth ={letter}17")
    name = f"U+{ord(letter):04X}"
    told = line(tmp_path, capsys, text)
    assert told.endswith(f"line 4: has a character that nobody sees ({name}); type the line anew")
    assert f"рядок 4: містить невидимий символ ({name})" in line(tmp_path, capsys, text, "uk")
    # within words it stands as it was typed
    (tmp_path / "x.toml").write_text(PAIR.replace("[parts.a]", f'[parts.a]\ntitle = "a{letter}b"'), encoding="utf-8")
    assert main(["check", str(tmp_path / "x.toml")]) == 0


def test_lines_that_end_as_on_old_macs_are_read(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "x.toml").write_bytes(PAIR.replace("\n", "\r").encode())
    assert main(["check", str(tmp_path / "x.toml")]) == 0
    capsys.readouterr()
    wrong = PAIR.replace("\n", "\r").replace("= 17", "= 1,7").encode()
    assert line(tmp_path, capsys, wrong).endswith("line 4: a number has a comma; write 1.7 with a point")


def test_a_designation_without_quotes_is_told_as_it_is_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = '[parts.w]\nkind = "sprocket"\nnumber_of_teeth = 17\nchain = 40\n[[exports]]\nformat = "dxf"\n'
    assert line(tmp_path, capsys, text).endswith('; write chain = "40"')
    assert line(tmp_path, capsys, text, "uk").endswith('; напишіть chain = "40"')
    told = line(tmp_path, capsys, PAIR.replace("[parts.a]", "[parts.a]\nmaterial = 40"))
    assert told.endswith('; write material = "40"')


WORM = '[parts.w]\nkind = "worm"\nmodule = 2.0\nnumber_of_starts = 1\ndiameter_quotient = 10.0\nthread_length = 30.0\n'


@pytest.mark.parametrize(("language", "told"), [("en", "or leave it out of this export"), ("uk", "не включайте її")])
def test_what_takes_no_offset_is_told_how_to_be_left_out(
    language: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, gears = tmp_path / "x.toml", PAIR.partition("[[mates]]")[0]
    export = '[[exports]]\nformat = "stl"\noffset = -0.05\n'
    command = ["build", str(file), "--out", str(tmp_path / "out"), "--language", language]
    file.write_text(WORM + gears + export)
    assert main(command) == 2
    said = capsys.readouterr().err
    assert told in said
    assert 'parts = ["a", "b"]' in said
    # alone it cannot be left out
    file.write_text(WORM + export)
    assert main(command) == 2
    assert told not in capsys.readouterr().err
    file.write_text(WORM + gears + export + 'parts = ["a", "b"]\n')
    assert main(command) == 0


FILM = """[parts.pinion]
kind = "spur_gear"
module = 1.0
number_of_teeth = 12
face_width = 3.0
[parts.bar]
kind = "rack"
module = 1.0
number_of_teeth = 20
face_width = 3.0
[[mates]]
kind = "rack_pair"
first = "pinion"
second = "bar"
[[drives]]
instance = "pinion"
turns = 120.5
[[exports]]
format = "motion"
tolerance = 0.5
"""


@pytest.mark.parametrize(
    ("language", "told"),
    [
        ("en", "note: x.motion.svg: shows the first 82.6 % of what the drives do"),
        ("uk", "показано лише перші 82.6 % руху приводів"),
    ],
)
def test_a_film_that_shows_less_than_the_drives_do_says_so(
    language: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "x.toml"
    command = ["build", str(file), "--out", str(tmp_path / "out"), "--language", language]
    file.write_text(FILM)
    assert main(command) == 0
    assert told in capsys.readouterr().out
    # all of them are shown
    file.write_text(FILM.replace("120.5", "99.5"))
    assert main(command) == 0
    assert "%" not in capsys.readouterr().out


@pytest.mark.parametrize(
    ("right", "wrong", "told"),
    [
        ('"spur_gear"', '"spur_gear\u200b"', "did you mean spur_gear?"),
        ('"spur_gear"', '"\ufeffspur_gear"', "did you mean spur_gear?"),
        ('first = "a"', 'first = "a\u200d"', "did you mean a?"),
        ('"dxf"', '"dx\u00adf"', "did you mean dxf?"),
    ],
)
def test_a_character_that_nobody_sees_in_a_name_is_told(
    right: str, wrong: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (letter,) = {*wrong} - {*right}
    said = line(tmp_path, capsys, PAIR.replace(right, wrong, 1))
    assert said.endswith(f"; it has a character that nobody sees (U+{ord(letter):04X}); {told}")
    assert "; тут є невидимий символ (" in line(tmp_path, capsys, PAIR.replace(right, wrong, 1), "uk")


@pytest.mark.parametrize(
    ("typed", "stands", "told"),
    [
        ("pinoin.toml", "pinion.toml", "pinion.toml"),
        ("PINION.toml", "pinion.toml", "pinion.toml"),
        ("pinion.toml", "pinion.toml.txt", "pinion.toml.txt"),
        ("моє колесо", "моє колесо.toml", "моє колесо.toml"),
        # another one beside it is not meant
        ("practicum_par", "pinion.toml", "practicum_pair"),
        ("nosuch.toml", "clock.toml", None),
    ],
)
def test_a_file_of_nearly_that_name_is_meant(
    typed: str, stands: str, told: str | None, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    for folder in (".", "мої сцени"):
        (tmp_path / folder).mkdir(exist_ok=True)
        monkeypatch.chdir(tmp_path)
        (tmp_path / folder / stands).write_text(PAIR)
        asked = str(Path(folder) / typed)
        assert main(["check", asked]) == 2
        said = capsys.readouterr().err
        assert said.startswith(f"higherpair: {asked}: no such file or built-in scene")
        if told is None:
            assert "did you mean" not in said
        elif told == stands or folder == ".":
            assert said.endswith(f"; did you mean {Path(folder) / told}?\n")


@pytest.mark.parametrize("key", ['kind = "spur_gear"', 'format = "dxf"', 'title = "x"'])
def test_what_each_table_has_of_its_own_is_no_default(
    key: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = line(tmp_path, capsys, f"[defaults]\n{key}\n{PAIR}")
    assert said == f"defaults.{key}: is not one for all: give it in each part, mate or export itself"


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        (["measured.pb=20", "measured.pd=-1"], "lever.measured.pd = -1: is not allowed; lengths that you measured"),
        (["masses.2=heavy"], 'lever.masses.2 = "heavy": must be a number; masses of links'),
    ],
)
def test_an_entry_of_a_table_of_any_names_is_told_by_its_name(
    keys: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["calc", "lever", "code=1071", *keys]) == 2
    assert capsys.readouterr().err.startswith(f"higherpair: calc: {told}")


SPROCKETS = """[defaults]
chain = "06B1"
[parts.a]
kind = "sprocket"
number_of_teeth = 19
[parts.b]
kind = "sprocket"
number_of_teeth = 38
[[mates]]
kind = "chain_drive"
first = "a"
second = "b"
number_of_links = 80
[[exports]]
format = "dxf"
"""


def test_what_is_offered_for_a_default_is_tried_on_all_that_have_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # before: tried on one part, whose mate was still wrong, so nothing was offered
    said = line(tmp_path, capsys, SPROCKETS)
    assert said.startswith('parts.a: defaults.chain = "06B1": is no chain')
    assert said.endswith("; did you mean 06B-1?")
    # in each part by itself one line is not enough
    own = SPROCKETS.replace('[defaults]\nchain = "06B1"\n', "").replace('"sprocket"', '"sprocket"\nchain = "06B1"')
    assert "did you mean" not in line(tmp_path, capsys, own)


def test_a_number_offered_for_a_default_works(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    teeth = "number_of_teeth = 20\nmate_number_of_teeth = 20\n"
    head = f"[defaults]\nmodule = 3.0\nhub_diameter = 30.0\nhub_length = 10.0\nface_width = {{}}\n{teeth}"
    parts = '[parts.a]\nkind = "bevel_gear"\n[parts.b]\nkind = "bevel_gear"\n'
    text = head + parts + '[[mates]]\nkind = "bevel_pair"\nfirst = "a"\nsecond = "b"\n[[exports]]\nformat = "stl"\n'
    said = line(tmp_path, capsys, text.format("60.0"))
    offer = re.search(r"; at most ([\d.]+) mm works$", said)
    assert offer is not None, said
    (tmp_path / "x.toml").write_text(text.format(offer[1]))
    assert main(["check", str(tmp_path / "x.toml")]) == 0


@pytest.mark.parametrize("export", [
    'format = "dxf"', 'format = "dxf"\npurpose = "board"', 'format = "step"\nassembly = true',
    'format = "pdf"\npurpose = "model"',
])  # fmt: skip
def test_a_poor_part_is_told_whatever_file_it_is_in(
    export: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Of twelve teeth undercut, told once; of a board, an assembly or a sheet the report alone said so."""
    part = '[parts.a]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 12\nface_width = 3.0\n'
    board = "[boards.p]\nwidth = 60.0\nheight = 60.0\nthickness = 3.0\n" if "board" in export else ""
    (file := tmp_path / "x.toml").write_text(f"{part}{board}[[exports]]\n{export}\n", encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--no-verify"]) == 0
    told = [line for line in capsys.readouterr().out.splitlines() if "undercut" in line]
    assert told == ["note: a: the tooth is undercut: profile shift 0.0000 is below x_min = 0.2982"]


@pytest.mark.parametrize(("typed", "meant"), [("5 %", "5"), ("0,5%", "0.5"), ("5", "5")])
def test_percent_of_a_key_in_percent_are_as_many(typed: str, meant: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["calc", "ratio", "ratio=20", f'ratio_tolerance_percent="{typed}"']) == 2
    assert capsys.readouterr().err.rstrip().endswith(f"; did you mean {meant}?")


@pytest.mark.parametrize(
    ("typed", "told"),
    [
        ('module = "2"', "; did you mean 2?"),
        ('module = "2 mm"', "; did you mean 2?"),
        ('module = "1/2"', "; did you mean 0.5?"),
        ('module = "\u22122"', "at most 1000 mm"),
        ('profile_shift_coefficient = "\u22120.3"', "; did you mean -0.3?"),
        ('profile_shift_coefficient = "30 %"', "; did you mean 0.3?"),
        ('profile_shift_coefficient = "30 mm"', "at most 10 modules"),
        ('module = "2 in"', "; did you mean 50.8?"),
        ('module = "1/8 in"', "; did you mean 3.175?"),
        ("module = '0.125\"'", "; did you mean 3.175?"),
        ('module = "2,5 \u043c\u043c"', "; did you mean 2.5?"),
        ('module = "2 kW"', "at most 1000 mm"),
        ('pressure_angle_deg = "22\u00b030\'"', "; did you mean 22.5?"),
        ("pressure_angle_deg = 22\u00b030'", "line 4: numbers stand without units, lengths in mm, angles in degrees: "
                                           "pressure_angle_deg = 22.5"),
        ("pressure_angle_deg = 22\u00b030'36\"", "line 4: numbers stand without units, lengths in mm, angles in "
                                                "degrees: pressure_angle_deg = 22.51"),
        ('module = "1/0 mm"', "at most 1000 mm"),
        ("power = 2 kW", "line 4: numbers stand without units: power = 2000"),
        ("module = 2,5 mm", "line 4: numbers stand without units: module = 2.5"),
        ("module = 1/8 in", "line 4: numbers stand without units, lengths in mm, angles in degrees: module = 3.175"),
        ("module = [2.5]", "; did you mean 2.5?"),
        ("module = [2, 3]", "at most 1000 mm"),
        ("number_of_teeth = 17.0", "; did you mean 17?"),
        ("number_of_teeth = 17.5", "at most 10000"),
        ("number_of_teeth = true", "at most 10000"),
        ("profile_shift_coefficient = 30%", "line 4: a share is written as a number, without %: "
                                            "profile_shift_coefficient = 0.3"),
    ],
)  # fmt: skip
def test_a_number_that_people_write_is_told_as_it_is_read(
    typed: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    key = typed.partition(" = ")[0]
    rest = re.sub(rf"(?m)^{key} = .*\n", "", PAIR.partition("[parts.b]")[0])
    lines = rest.splitlines()
    text = "\n".join([*lines[:3], typed, *lines[3:]])
    said = line(tmp_path, capsys, text)
    assert told in said
    assert said.endswith(told) or "did you mean" not in said
    if found := re.search(r"did you mean (.+)\?$", said):
        (tmp_path / "x.toml").write_text(text.replace(typed, f"{key} = {found[1]}"))
        assert main(["check", str(tmp_path / "x.toml")]) == 0


@pytest.mark.parametrize(
    ("right", "wrong", "meant"),
    [
        ('kind = "spur_gear"', 'kind = "helical_gear"', "spur_gear"),
        ('kind = "spur_gear"', 'kind = "internal_gear"', "ring_gear"),
        ("number_of_teeth = 17", "tooth_number = 17", "number_of_teeth"),
        ("[[mates]]", "[[pairs]]", "mates"),
        ('first = "a"', 'gear1 = "a"', "first"),
        ("[parts.a]", '[scene]\nunits = "inch"\n[parts.a]', None),
        ("module = 2.0", "torque = 2.0", None),
        # d = m z, and no diameter of another circle
        ("module = 2.0", "pitch_diameter = 34.0", None),
        ("module = 2.0", "reference_diameter = 34.0", None),
        ("module = 2.0", "module = 2.0\ncorrection = 0.3", "profile_shift_coefficient"),
    ],
)
def test_a_word_of_other_books_leads_to_ours_and_no_word_to_one_like_it_by_chance(
    right: str, wrong: str, meant: str | None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    said = line(tmp_path, capsys, PAIR.replace(right, wrong, 1))
    assert said.endswith(f"; did you mean {meant}?") if meant else "did you mean" not in said


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("--language uk", "бракує аргументів: КОМАНДА;"),
        ("build spur_gear", "spur_gear: is a kind, no scene; `higherpair new spur_gear` begins a scene with it"),
        ("check external_gear_pair", "`higherpair new external_gear_pair` begins"),
        ("build planetary_set", "`higherpair new planetary_set` begins"),
        ("build james \u2014out x", "unrecognized arguments: \u2014out; did you mean --out?"),
        ("check james \u2013quiet", "unrecognized arguments: \u2013quiet; did you mean --quiet?"),
        ("build james --output x", "unrecognized arguments: --output; did you mean --out?"),
        ("build james -out x", "unrecognized arguments: -out; did you mean --out?"),
        ("build james --format dxf,stl", "takes one at a time: --format dxf --format stl"),
        ("build james --part sun,ring", "takes one at a time: --part sun --part ring"),
        ("calc gear_pair james", "did you mean gear-pair?"),
        ("calc thread M20", "M20: is neither a scene nor key=value, like number_of_teeth=23"),
        ("calc spur module number_of_teeth=23", "module: is neither a scene"),
        ("calc spur module:2 number_of_teeth:23", "module:2: is neither a scene"),
        ("calc spur practicum_pair pinion", "pinion: is neither a scene"),
        ("calc train wheels=[20,40]", "did you mean teeth?"),
        ("calc train teeth=20,40 meshes=1-2", "must be a list in brackets or a table"),
        ("calc power-table x=1,5 y=2", "write 1.5 with a point, or a list in brackets, [1, 5]"),
        ("calc train teeth=20,40,80 meshes=1-2", "did you mean [20, 40, 80]?"),
        ("calc planetary teeth=20;40;100", "did you mean [20, 40, 100]?"),
        ("calc worm module=4 number_of_teeth=40 power=2,2\u043a\u0412\u0442 speed_rpm=1440", "did you mean 2200?"),
        ('calc spur module=0.125" number_of_teeth=20', "did you mean 3.175?"),
        ("calc bevel module=2 number_of_teeth=20 mate=40", "did you mean mate_number_of_teeth?"),
        ("calc geneva slots=6", "did you mean number_of_slots?"),
        ("new parts", "unknown kind"),
    ],
)
def test_a_slip_in_a_command_is_told_in_one_line(
    command: str, told: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    try:
        code = main(command.split())
    except SystemExit as ended:
        code = int(ended.code or 0)
    said = capsys.readouterr()
    (one,) = said.err.splitlines()
    assert (code, said.out) == (2, "")
    assert told in one
    assert not [*tmp_path.iterdir()]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("before", [True, False])
def test_the_language_is_heard_before_the_command_and_behind_it(
    before: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = ["--language", "uk"]
    assert main([*asked, "list"] if before else ["list", *asked]) == 0
    assert "види деталей" in capsys.readouterr().out
    # the last word counts
    assert main([*asked, "list", "--language", "en"]) == 0
    assert "kinds of parts" in capsys.readouterr().out
    with pytest.raises(SystemExit) as ended:
        main([*asked, "--help"])
    assert not ended.value.code
    assert "використання: higherpair" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("table", "header", "key"),
    [
        ("scene", "[scene]", "title"), ("exports", "[[exports]]", "kerf"), ("boards", "[boards.NAME]", "grain"),
        ("beds", "[beds.NAME]", "depth"), ("drives", "[[drives]]", "turns"), ("checks", "[checks]", "interference"),
        ("instances", "[instances.NAME]", "rotation_deg"), ("steps", "[[steps]]", "bring"),
    ],
)  # fmt: skip
def test_the_keys_of_every_table_of_a_scene_are_told(
    table: str, header: str, key: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["new", table]) == 0
    shown = capsys.readouterr().out.splitlines()
    assert header in shown
    assert any(re.match(rf"(# )?{key} = ", row) for row in shown)
    # and a wrong key of a long one says where
    if table == "exports":
        said = line(tmp_path, capsys, PAIR + 'out = "x"\n')
        assert said.endswith("more, see `higherpair new exports`")


def test_all_that_lies_in_a_folder_can_be_verified(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a shell makes of * has the report too, which is held against nothing."""
    (tmp_path / "x.toml").write_text(PAIR)
    assert main(["build", str(tmp_path / "x.toml"), "--out", str(tmp_path), "--quiet"]) == 0
    files = [str(file) for file in (tmp_path / "x").iterdir()]
    assert any(file.endswith("report.json") for file in files)
    assert main(["verify", *files]) == 0
    assert not capsys.readouterr().err


def test_why_no_row_of_a_catalogue_can_be_built_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "x.toml").write_text(PAIR)
    assert main(["catalogue", str(tmp_path / "x.toml"), "--vary", "a.module=3,4", "--out", str(tmp_path)]) == 2
    told = "leaves no row that can be built; the first: mates[1]: parts.b.module: must be that of its mate; "
    assert told in capsys.readouterr().err
    assert (
        main(["catalogue", str(tmp_path / "x.toml"), "--vary", "a.number_of_teeth=8-20", "--out", str(tmp_path)]) == 2
    )
    assert "; the first: parts.a.number_of_teeth: must be a whole number; " in capsys.readouterr().err


@pytest.mark.parametrize(
    ("kind", "keys", "most"),
    [
        ("planetary_set", "teeth = [24, 24, 72]\nclearance = 40.0\n", "1.5"),
        ("planetary_set", "teeth = [24, 24, 72]\npin_diameter = 2.0\nclearance = 3.0\n", "0.5"),
        ("gear_pair_model", "teeth = [13, 21]\nclearance = 3.0\n", "1.5"),
        ("lever_model", "assignment = 4\nscale = 8.0\nclearance = 3.0\n", "1"),
        ("power_table", "clearance = 3.0\n", "1"),
    ],
)
def test_an_assembly_whose_pins_lie_loose_is_refused_with_what_works(
    kind: str, keys: str, most: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Satellites with 3 mm of play were in contact without a word; at 40 mm the bore of one part alone was told."""
    text = f'[[assemblies]]\nkind = "{kind}"\n{keys}[[exports]]\nformat = "step"\nassembly = true\n'
    said = line(tmp_path, capsys, text)
    assert said.startswith("assemblies[1].clearance = ")
    assert said.endswith(f"; at most {most} mm works")
    (tmp_path / "x.toml").write_text(re.sub(r"clearance = .*", f"clearance = {most}", text))
    assert main(["check", str(tmp_path / "x.toml"), "--quiet"]) == 0

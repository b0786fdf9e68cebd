"""What a beginner types into a scene, and the one line that the command answers, in both languages."""

from __future__ import annotations

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
    # a near spelling of its own table's, or another book's word, is told before other tables
    ("[parts.a]", "face_widht = 2.0", "did you mean face_width?"),
    ("[parts.a]", "thickness = 2.0", "did you mean face_width?"),
    ("[scene]", "kerf = 0.2", "scene.kerf = 0.2: kerf belongs to [defaults] or [[exports]]"),
    ("[scene]", "teeth = 20", "number_of_teeth belongs to [defaults] or [parts.NAME]"),
    ('kind = "external_gear_pair"', "module = 2.0", "is no key of a mate, but one of parts.a; write it there"),
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


def test_it_is_told_in_ukrainian_too(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = PAIR.replace("[parts.a]", "[parts.a]\nkerf = 0.2")
    assert line(tmp_path, capsys, text, "uk").endswith("kerf належить до [defaults] або [[exports]]")
    text = PAIR.replace("[parts.a]", "[parts.a]\ndiameter_quotient = 2")
    assert 'diameter_quotient належить до [parts.NAME] виду "worm_wheel", "worm"' in line(tmp_path, capsys, text, "uk")

"""The notes of a scene line by line: files with what lies on them, sheets for a class, the order, lengths to be cut."""

from __future__ import annotations

from pathlib import Path

import pytest

from exporters.production.notes import write_notes
from exporters.production.plan import plan_build
from parts.scene.load import scene_from_toml

GEAR = '[parts.wheel]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 12\nface_width = 4.0\nbore_diameter = 5.0\n'
PIN = '[parts.pin]\nkind = "pin"\ndiameter = 5.0\nlength = 10.5\ntitle = "Pin"\n'
TUBE = '[parts.tube]\nkind = "pin"\ndiameter = 8.0\nbore_diameter = 5.2\nlength = 20.0\n'
STAND = "[instances]\nwheel = { at = [0, 0, 0] }\npin = { count = 3, at = [30, 0, 0] }\ntube = { at = [60, 0, 0] }\n"
STEPS = (
    '[[steps]]\nbring = ["pin"]\nto = "wheel"\nalong = [0.0, 0.0, -1.0]\n[[steps]]\nbring = ["tube"]\nto = "wheel"\n'
)
BOARD = "[boards.wood]\nwidth = 100.0\nheight = 60.0\nthickness = 4.0\nsets = 2\n{kerf}"
ON_BOARDS = '[[exports]]\nformat = "dxf"\npurpose = "board"\n[[exports]]\nformat = "svg"\npurpose = "board"\n'
SHEETS = "".join(
    f'[[exports]]\nformat = "pdf"\ntolerance = 1e-3\npurpose = "{purpose}"\nname = "{name}"\n{more}'
    for purpose, name, more in (
        ("generating", "students", 'cells = "empty"\n'), ("generating", "teacher", ""), ("model", "paper", ""),
    )
)  # fmt: skip


def told(text: str, folder: Path, head: str = "") -> list[str]:
    plan = plan_build(scene_from_toml((head + text).encode(), "s.toml", "s"), "s", [], [])
    file = write_notes(plan, folder)
    assert file == folder / "s.notes.txt"
    whole = file.read_text(encoding="utf-8").replace("\xa0", " ")
    assert whole.endswith("\n")
    assert not whole.endswith("\n\n")
    lines = whole.removesuffix("\n").split("\n")
    assert all(len(line) <= 88 for line in lines)
    return lines


LENGTHS = [
    "", "To be cut from rods and tubes, mm (diameter × length):",
    "  2 × Ø8/Ø5.2 × 20   Pin tube", "  Ø8/Ø5.2 in all: 0.04 m, and what the cuts take",
    "  6 × Ø5 × 10.5   Pin", "  Ø5 in all: 0.063 m, and what the cuts take",
]  # fmt: skip
CUT = "Cut the boards: blue is engraved first, then green is cut, red last."


def test_everything_has_its_lines_in_their_order(tmp_path: Path) -> None:
    """Two sets: two wheels on one board, in both formats; six pins and two tubes by hand."""
    head = '[scene]\ntitle = "A wheel"\nnotes = ["First.", "Then."]\n'
    text = GEAR + PIN + TUBE + STAND + STEPS + BOARD.format(kerf="kerf = 0.2\n") + ON_BOARDS + SHEETS
    found = told(text, tmp_path, head)
    kerf = "If the fits are too loose or too tight, cut `kerf_coupon` and write the number it shows into `kerf` of the"
    cut = found[3 : found.index("", 3)]
    assert " ".join(cut) == f"{CUT} {kerf} board."
    rows = found[4 + len(cut) :]
    assert found[:3] == ["A wheel", "=======", ""]
    joined = " ".join(line if not line.startswith("    ") else line.strip() for line in rows[: rows.index("")])
    assert joined == (
        "s.board.1.dxf, .svg: 2 × Gear wheel z 12 m 2 "
        "s.students.pdf: to hand out: the given data are filled in, the cells of the results are empty "
        "s.teacher.pdf: the same with all numbers "
        "s.paper.pdf: 1:1, to be cut out: print at 100 %; its square must measure 100 mm"
    )
    assert rows[rows.index("") :] == [
        "", "First.", "", "Then.", "", "1. Pin 1 ... Pin 3 to wheel: from above",
        "2. tube to wheel: each straight to its axis", *LENGTHS,
    ]  # fmt: skip


FAST = """
[parts.plate]
kind = "plate"
width = 40.0
height = 20.0
face_width = 3.0
holes = [{ at = [0.0, 0.0], diameter = 5.0 }]

[parts.pin]
kind = "pin"
diameter = 5.0
length = 10.0

[parts.ring]
kind = "pin"
diameter = 9.0
bore_diameter = 5.2
length = 3.0

[[mates]]
kind = "fixed"
first = "plate"
second = "pin"

[[mates]]
kind = "coaxial"
first = "pin"
second = "ring"
height = 3.0

[[steps]]
bring = ["pin"]
to = "plate"
along = [0.0, 0.0, -1.0]

[[steps]]
bring = ["ring"]
to = "plate"
along = [0.0, 0.0, -1.0]

[[exports]]
format = "stl"
"""


@pytest.mark.parametrize(
    ("head", "lines"),
    [
        ("", ["1. pin to plate: from above, held fast", "2. ring to plate: from above"]),
        ('[scene]\nlanguage = "uk"\n', ["1. pin → plate: зверху, нерухомо", "2. ring → plate: зверху"]),
    ],
    ids=["en", "uk"],
)
def test_what_a_step_holds_fast_is_told_and_what_turns_is_not(head: str, lines: list[str], tmp_path: Path) -> None:
    """A pin glued into a plate, and a ring that turns on it."""
    assert [line for line in told(FAST, tmp_path, head) if line[:2] in ("1.", "2.")] == lines


def test_what_there_is_none_of_has_no_lines(tmp_path: Path) -> None:
    """A sheet with numbers alone needs no word; a board without a kerf asks for none; no rods, no lengths."""
    filled = SHEETS.split("[[exports]]\n")[2]
    text = GEAR + BOARD.format(kerf="") + ON_BOARDS.split("[[exports]]\n")[1].join(["[[exports]]\n", "[[exports]]\n"])
    assert told(text + filled, tmp_path) == ["s", "=", "", CUT, "", "s.board.1.dxf: 2 × Gear wheel z 12 m 2"]
    alone = '[[exports]]\nformat = "svg"\n'
    assert told(GEAR + alone, tmp_path) == ["s", "="]
    long = "word " * 60
    head = f'[scene]\ntitle = "{long}"\nnotes = ["{long}"]\n'
    found = told(GEAR + alone, tmp_path, head)
    assert found[found.index("=" * 88) - 1] != ""
    assert " ".join(found[: found.index("=" * 88)]) == " ".join(found[found.index("") + 1 :]) == long.strip()


@pytest.mark.parametrize(("copies", "remark"), [(1, False), (16, True)])
def test_boards_that_are_cut_several_times_say_so(copies: int, remark: bool, tmp_path: Path) -> None:
    """Four wheels of 28 mm on a board of 100 x 60 mm: of sixteen sets boards alike."""
    text = GEAR + BOARD.replace("sets = 2", f"sets = {copies}").format(kerf="") + ON_BOARDS
    (row,) = [line for line in told(text, tmp_path) if line.startswith("s.board.1.dxf, .svg: ")]
    assert ("boards like this one to be cut: " in row) is remark

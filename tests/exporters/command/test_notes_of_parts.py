"""What is noticed on a part is told by ``check`` as by ``build``, in the same words."""

from pathlib import Path

import pytest

from exporters.command.cli import main
from tests.exporters.making import table, write_scene

GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 8.0}
RING = GEAR | {"kind": "ring_gear", "number_of_teeth": 40}
RACK = GEAR | {"kind": "rack"}
BEVEL = {"kind": "bevel_gear", "module": 2.0, "number_of_teeth": 20, "mate_number_of_teeth": 40}
PULLEY = {"kind": "timing_pulley", "belt": "GT2", "number_of_teeth": 20, "face_width": 8.0, "outer_diameter": 12.0}


def notes_of(capsys: pytest.CaptureFixture[str], *words: str) -> list[str]:
    assert main(list(words)) == 0
    return [line for line in capsys.readouterr().out.splitlines() if line.startswith("note: ")]


@pytest.mark.parametrize(
    ("part", "told"),
    [
        (PULLEY, "the outer diameter is 12 mm, the belt's pitch asks for 12.224 mm"),
        *((part | {"hand": "left"}, "straight teeth have no hand") for part in (GEAR, RING, RACK, BEVEL)),
        (GEAR | {"hub": {"diameter": 14.0}}, "the hub stands out nowhere"),
        *((part | {"thinning_method": "deeper_cut"}, "nothing is thinned") for part in (GEAR, RING)),
    ],
)
def test_check_tells_what_build_tells(
    part: dict[str, object], told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = str(
        write_scene(tmp_path / "s.toml", {"p": part}, [{"format": "step" if part["kind"] == "bevel_gear" else "dxf"}])
    )
    built = notes_of(capsys, "build", scene, "--out", str(tmp_path / "out"))
    assert notes_of(capsys, "check", scene) == built
    assert [line for line in built if told in line]


@pytest.mark.parametrize("part", [GEAR, RING, RACK])
def test_helical_teeth_of_a_hand_have_no_such_note(
    part: dict[str, object], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    helical = part | {"hand": "left", "helix_angle_deg": 15.0}
    scene = str(write_scene(tmp_path / "s.toml", {"p": helical}, [{"format": "dxf"}]))
    assert not [line for line in notes_of(capsys, "check", scene) if "hand" in line]


@pytest.mark.parametrize("own", [True, False])
def test_what_is_thinned_by_a_key_or_by_a_mate_is_cut_deeper_without_a_note(
    own: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    deeper = GEAR | {"thinning_method": "deeper_cut"} | ({"circumferential_thinning": 0.1} if own else {})
    mate = {"kind": "external_gear_pair", "first": "p", "second": "w"} | ({} if own else {"normal_backlash": 0.2})
    scene = write_scene(tmp_path / "s.toml", {"p": deeper, "w": GEAR}, [{"format": "dxf"}], table("[[mates]]", mate))
    assert not [line for line in notes_of(capsys, "check", str(scene)) if "thinn" in line]


@pytest.mark.parametrize("part", [
    GEAR | {"hub": {"diameter": 14.0, "below": 3.0}},
    GEAR | {"hub": {"diameter": 14.0}, "web": {"thickness": 4.0, "rim_diameter": 30.0}},
])  # fmt: skip
def test_a_hub_that_stands_out_has_no_note(
    part: dict[str, object], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = str(write_scene(tmp_path / "s.toml", {"p": part}, [{"format": "stl"}]))
    assert not [line for line in notes_of(capsys, "check", scene) if "hub" in line]


def test_a_wheel_whose_hub_stands_out_nowhere_is_its_outline_and_lies_on_boards(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before, it was said that a flat outline holds only its section, and no board took it."""
    board = {"width": 100.0, "height": 80.0, "thickness": 8.0}
    exports = [{"format": "dxf"}, {"format": "dxf", "purpose": "board"}]
    for name, part in (("plain", GEAR), ("hub", GEAR | {"hub": {"diameter": 14.0}})):
        scene = write_scene(tmp_path / f"{name}.toml", {"p": part}, exports, table("[boards.b]", board))
        found = notes_of(capsys, "build", str(scene), "--out", str(tmp_path))
        assert not [line for line in found if "outline" in line]
    for one, other in (("p.dxf", "p.dxf"), ("hub.board.1.dxf", "plain.board.1.dxf")):
        assert (tmp_path / "hub" / one).read_bytes() == (tmp_path / "plain" / other).read_bytes()

"""A worm in its wheel: placed in space, held in sections, driven; what does not go together is refused."""

from __future__ import annotations

import math
import re
from pathlib import Path

import manifold3d
import numpy as np
import pytest

from exporters.command.cli import main
from parts.scene.load import load_scene, make_parts
from parts.scene.placing import place
from tests.sampling import some_of

PAIR = """
[parts.wheel]
kind = "worm_wheel"
module = 2.0
number_of_teeth = 20
number_of_starts = 2
hand = "{hand}"
face_width = 10.0
axial_thinning = {thinning}

[parts.worm]
kind = "worm"
module = 2.0
number_of_starts = 2
hand = "{worm_hand}"
thread_length = 36.0

[instances.wheel]
part = "wheel"
rotation_deg = 11.0

[[mates]]
kind = "worm_pair"
first = "wheel"
second = "worm"
direction_deg = 40.0

[[drives]]
instance = "worm"
turns = 3.0

[[exports]]
format = "stl"
"""


def _scene(folder: Path, *, hand: str = "right", worm_hand: str | None = None, thinning: float = 0.0) -> Path:
    file = folder / "pair.toml"
    file.write_text(PAIR.format(hand=hand, worm_hand=worm_hand or hand, thinning=thinning))
    return file


def _checked(file: Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, str]:
    code = main(["check", str(file)])
    said = capsys.readouterr()
    return code, said.out + said.err


@pytest.mark.sampled(1)
@pytest.mark.parametrize("hand", ["right", "left"])
def test_a_worm_touches_its_wheel_and_turns_it(tmp_path: Path, capsys: pytest.CaptureFixture[str], hand: str) -> None:
    code, said = _checked(_scene(tmp_path, hand=hand), capsys)
    assert code == 0
    assert "CONTACT" in said
    sign = "" if hand == "right" else "-"
    assert f"wheel = {sign}0.3" in said


def test_a_thinner_wheel_has_play_and_a_worm_of_the_other_hand_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    code, said = _checked(_scene(tmp_path, thinning=0.2), capsys)
    assert code == 0
    assert "CLEAR" in said
    code, said = _checked(_scene(tmp_path, hand="right", worm_hand="left"), capsys)
    assert code == 2
    assert "hand" in said


@pytest.mark.parametrize(
    ("given", "told"),
    [("diameter_quotient = 11.0", "11.0: must fit its mate; 10 works"),
     ("lead_angle_deg = 11.0", "11.0: must fit its mate; 11.309932474 degrees works")],
)  # fmt: skip
def test_a_worm_of_another_diameter_is_told_the_one_that_fits(
    given: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = _scene(tmp_path)
    file.write_text(file.read_text().replace("thread_length", f"{given}\nthread_length"))
    code, said = _checked(file, capsys)
    assert code == 2
    assert told in said


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("given", "code", "told"),
    # a = (q + z2 + 2 x) m / 2 is 30 mm without a shift
    [("working_centre_distance = 31.0", 0, "centre distance 31 mm, ratio 10: CONTACT"),
     ("profile_shift_coefficient = 0.5", 0, "centre distance 31 mm, ratio 10: CONTACT"),
     ("working_centre_distance = 23.0", 2, "working_centre_distance = 23.0: asks for a profile shift of -3.5 of"),
     ("working_centre_distance = 31.0\nprofile_shift_coefficient = 0.5", 2,
      "profile_shift_coefficient = 0.5: give either working_centre_distance or profile_shift_coefficient; "
       "remove profile_shift_coefficient")],
)  # fmt: skip
def test_a_wheel_is_shifted_for_a_given_centre_distance(
    given: str, code: int, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = _scene(tmp_path)
    file.write_text(file.read_text().replace("face_width", f"{given}\nface_width"))
    assert main(["check", str(file)]) == code
    said = capsys.readouterr()
    assert told in said.out + said.err
    if code == 0:
        assert main(["calc", "worm", str(file)]) == 0
        assert "x = 0.5" in capsys.readouterr().out
        assert main(["calc", "worm", str(file), "working_centre_distance=30.4"]) == 0
        assert "x = 0.2" in capsys.readouterr().out


def test_a_wheel_that_cannot_be_made_is_told_so_though_its_mate_begins_with_the_worm(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = _scene(tmp_path)
    text = file.read_text().replace("face_width", "working_centre_distance = 23.0\nface_width")
    first, second = re.findall(r'^(?:first|second) = (".*")', text, re.M)
    text = text.replace(f"first = {first}", f"first = {second}").replace(f"second = {second}", f"second = {first}")
    file.write_text(text)
    assert main(["check", str(file)]) == 2
    assert "working_centre_distance = 23.0: asks for a profile shift of -3.5 of" in capsys.readouterr().err


def test_a_size_that_the_worm_cannot_have_is_told_to_the_wheel(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = _scene(tmp_path)
    # no room for the rounding on a tip as narrow as the wheel's addendum makes it; before: no value was named
    worm = "addendum_coefficient = 0.6\ntip_rounding = 1.3\nthread_length"
    file.write_text(file.read_text().replace("thread_length", worm))
    code, said = _checked(file, capsys)
    assert code == 2
    assert "parts.wheel.addendum_coefficient = 1.0: " in said
    assert "; 0.6 modules works" in said


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("given", "told"),
    [("thread_length = 20.0\nthread_ends = 'run_out'", "parts.worm.thread_length = 20.0: the teeth of the wheel run"),
     ("shaft_above = [{diameter = 14.0, length = 3.0}, {diameter = 40.0, length = 3.0}]\nthread_length = 20.0",
      "parts.worm.shaft_above[2].diameter = 40.0: the teeth of the wheel run")],
)  # fmt: skip
def test_teeth_that_run_into_what_stands_beside_the_thread_are_refused_with_what_is_clear_of_them(
    given: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = _scene(tmp_path)
    bad = file.read_text().replace("thread_length = 36.0", given)
    file.write_text(bad)
    code, said = _checked(file, capsys)
    assert code == 2
    assert told in said
    value = re.search(r"at (?:least|most) ([0-9.]+) mm works", said)
    assert value is not None
    wrong = "diameter = 40.0" if "40.0" in given else "thread_length = 20.0"
    file.write_text(bad.replace(wrong, wrong.partition("=")[0] + f"= {value[1]}"))
    assert _checked(file, capsys)[0] == 0


@pytest.mark.parametrize("hand", [pytest.param("right", marks=pytest.mark.heavy), "left"])
def test_solids_in_their_places_are_apart_and_half_a_pitch_on_they_are_not(tmp_path: Path, hand: str) -> None:
    file = _scene(tmp_path, hand=hand, thinning=0.2)
    scene = load_scene(str(file))
    parts, matings = make_parts(scene, str(file))
    placing = place(scene.instances, scene.drives, parts, matings, str(file))
    solids = {}
    for instance in placing.instances:
        mesh = parts[instance.part].to_trimesh(0.05)
        vertices, triangles = np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32)
        solid = manifold3d.Manifold(manifold3d.Mesh(vertices, triangles))
        solids[instance.id] = (solid, instance)
    for turned in (0.0, 0.37):
        moved = {i.id: i for i in placing.at([turned])}
        one, two = (solids[k][0].transform(moved[k].scene_from_part.matrix()) for k in ("wheel", "worm"))
        assert (one ^ two).volume() == 0
    worm = solids["worm"][0].rotate([0.0, 0.0, math.degrees(math.pi / 2)])
    one, two = solids["wheel"], worm.transform(solids["worm"][1].scene_from_part.matrix())
    assert (one[0].transform(one[1].scene_from_part.matrix()) ^ two).volume() > 1.0


ERRORS = {
    "nearer": "centre_distance_error = -0.1",
    "tilted": "axis_angle_error_deg = 0.5",
    "aside": "wheel_axial_error = 0.4",
    "all": "centre_distance_error = 0.1\naxis_angle_error_deg = -0.3\nwheel_axial_error = -0.3",
}


@pytest.mark.heavy
@pytest.mark.parametrize("keys", ERRORS.values(), ids=ERRORS)
def test_axes_off_their_places_leave_the_gap_of_meshes_that_stand_so(tmp_path: Path, keys: str) -> None:
    file = _scene(tmp_path, thinning=0.3)
    file.write_text(file.read_text().replace("direction_deg = 40.0", f"direction_deg = 40.0\n{keys}"))
    scene = load_scene(str(file))
    parts, (mating,) = make_parts(scene, str(file))
    found = mating.contact(0.0, 0.0, None)
    placing = place(scene.instances, scene.drives, parts, [mating], str(file))
    meshes = {}
    for instance in placing.instances:
        mesh = parts[instance.part].to_trimesh(0.02)
        vertices, triangles = np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32)
        meshes[instance.id] = manifold3d.Manifold(manifold3d.Mesh(vertices, triangles))
    poses = [{i.id: i.scene_from_part.matrix() for i in placing.at([turned])} for turned in (0.0, 0.125, 0.25, 0.375)]
    # turned into the middle of its play, which is 3 degrees wide
    gaps = [
        min(meshes["wheel"].transform(p["wheel"]).min_gap(meshes["worm"].rotate([0, 0, turn]).transform(p["worm"]), 0.5)
            for p in poses)
        for turn in np.linspace(-1.0, 1.0, 9)
    ]  # fmt: skip
    assert found is not None
    assert found.worst.gap == pytest.approx(max(gaps), abs=0.015)


def test_errors_of_the_axes_are_told_and_what_stands_too_near_overlaps(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    # without backlash the exact place alone is one
    cases = ((0.2, "centre_distance_error = -0.05", "CLEAR"), (0.0, "axis_angle_error_deg = 0.01", "OVERLAP"))
    for thinning, error, verdict in some_of(cases):
        file = _scene(tmp_path, thinning=thinning)
        file.write_text(file.read_text().replace("direction_deg = 40.0", error))
        got, said = _checked(file, capsys)
        assert (got, verdict in said) == (int(verdict == "OVERLAP"), True)
        assert ("centre distance 29.95 mm" in said) == (verdict == "CLEAR")

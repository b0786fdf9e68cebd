"""The lessons of the practicum as sets: boards for ten groups, sheets with and without numbers, paper models."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path
from xml.etree import ElementTree

import ezdxf
import pytest
import shapely
from ezdxf.path import make_path

from exporters.command.cli import main
from parts.base.texts import languages
from parts.scene.files import SCENE_FOLDER, built_in_scenes
from parts.scene.load import load_scene, make_parts
from parts.scene.placing import place
from tests.exporters.production.test_boards import bodies_of, contours, pieces_of
from tests.exporters.production.test_sheet_words import SVG, faults
from tests.sampling import some_of

LESSONS = [f"lesson_{number}" for number in range(1, 6)]


@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_stands_and_has_all_that_a_class_wants(name: str) -> None:
    scene = load_scene(name)
    parts, matings = make_parts(scene, name)
    placing = place(scene.instances, scene.drives, parts, matings, name)
    assert placing.off_centre == ()
    assert all(condition.met for mate in placing.mates for condition in mate.conditions)
    (board,) = scene.boards.values()
    assert (board.width, board.height, board.thickness, board.sets) == (600, 400, 3, 10)
    made = {(e.purpose, e.name, e.cells) for e in scene.exports if e.format == "pdf"}
    asked = next(purpose for purpose, told, _ in made if told == "students")
    assert made == {(asked, "students", "empty"), (asked, "teacher", "numbers"), ("model", "paper", "numbers")}
    assert {e.format for e in scene.exports if e.purpose == "board"} == {"dxf", "svg"}
    # no shift that students find stands engraved on their model
    names = [n for part in parts.values() if (n := part.keys.label or part.name) and isinstance(n, str)]
    assert not [n for n in names if re.search(r"\bx\W*0[.,]\d", n)]


@pytest.mark.parametrize("name", LESSONS)
def test_the_board_alone_says_how_thick_the_plywood_is(name: str, tmp_path: Path) -> None:
    text = (SCENE_FOLDER / f"{name}.toml").read_text("utf-8")
    assert text.count("thickness = 3.0 ") == 1
    file = tmp_path / "thin.toml"
    file.write_text(text.replace("thickness = 3.0 ", "thickness = 2.0 "), encoding="utf-8")
    parts, _ = make_parts(load_scene(str(file)), str(file))
    flat = {key: part.face_width for key, part in parts.items() if part.is_plate and part.stock is None}
    assert set(flat.values()) == {2.0}, flat
    assert not [part.material for part in parts.values() if re.search(r"\d", part.material or "")]


def test_frame_and_dowels_of_a_pair_follow_the_board(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Thicker: nothing runs into the gears; thinner: they lie on the frame, and dowels are four boards long."""
    text = (SCENE_FOLDER / "lesson_3.toml").read_text("utf-8")
    for thick in (2.0, 4.5):
        file = tmp_path / "s.toml"
        file.write_text(text.replace("thickness = 3.0 ", f"thickness = {thick} "), encoding="utf-8")
        assert main(["check", str(file)]) == 0, capsys.readouterr()
        scene = load_scene(str(file))
        parts, matings = make_parts(scene, str(file))
        stand = {one.id: one for one in place(scene.instances, scene.drives, parts, matings, str(file)).instances}
        assert {key: one.at[2] for key, one in stand.items()} == {
            "pinion": 0.0, "wheel": 0.0, "frame": -thick, "axle_1": -thick, "axle_2": -thick
        }  # fmt: skip
        assert parts["axle"].face_width == 4 * thick
    file.write_text(text.replace("[13, 21]", "[13, 2]"), encoding="utf-8")
    assert main(["check", str(file)]) == 2
    assert "assemblies[1].teeth[2] = 2" in capsys.readouterr().err
    file.write_text(text + "[instances.frame]\nat = [0.0, 0.0, -2.0]\n", encoding="utf-8")
    assert main(["check", str(file)]) == 1


PAIR = """
[defaults]
module = 4.0
[parts.pinion]
kind = "spur_gear"
number_of_teeth = 13
profile_shift_coefficient = 0.694
[parts.wheel]
kind = "spur_gear"
number_of_teeth = 21
profile_shift_coefficient = 0.384
[[mates]]
kind = "external_gear_pair"
first = "pinion"
second = "wheel"
normal_backlash = 0.125
[[exports]]
format = "sheet"
name = "students"
cells = "empty"
[[exports]]
format = "sheet"
name = "teacher"
"""


def test_students_find_the_numbers_themselves(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "s.toml"
    file.write_text(PAIR, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--no-verify"]) == 0
    texts = {
        name: re.findall(r"<text[^>]*>([^<]*)", (tmp_path / "s" / f"s.{name}.1.svg").read_text("utf-8"))
        for name in ("students", "teacher")
    }
    # (3.4) of the practicum: m (z1 + z2) / 2 cos 20 / cos 26.9331
    for answer in ("71.673", "26.9331°", "0.694", "0.125"):
        assert answer in texts["teacher"]
        assert answer not in texts["students"]
    for given in ("4", "13", "21"):
        assert given in texts["students"]
    assert not any(re.search(r"= -?\d", text) for text in texts["students"])
    file.write_text(PAIR.replace('format = "sheet"\nname = "students"', 'format = "dxf"'), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 2
    assert "exports[1].cells" in capsys.readouterr().err


SHEETS = """
[[exports]]
format = "sheet"
purpose = "{purpose}"
name = "students"
cells = "empty"
tolerance = 1e-3
[[exports]]
format = "sheet"
purpose = "{purpose}"
name = "teacher"
tolerance = 1e-3
"""
CAM = """
[parts.cam]
kind = "cam"
follower = "roller"
lift = 20.0
follower_radius = 8.0
base_circle_radius = 40.0
phases = [{ move = "rise", angle_deg = 180.0, law = "sine" }, { move = "return_", angle_deg = 180.0, law = "sine" }]
"""
TRAIN = """
[[assemblies]]
kind = "planetary_set"
teeth = [24, 24, 72]
"""
DISK = """
[defaults]
module = 8.0
number_of_teeth = 9
[parts.zero]
kind = "spur_gear"
[parts.shifted]
kind = "spur_gear"
profile_shift_coefficient = 0.47
"""
ARM = """
[parts.cam]
kind = "cam"
follower = "roller"
swing_deg = 22.0
follower_radius = 8.0
base_circle_radius = 27.0
oscillating = { centre_distance = 75.0, arm_length = 62.0 }
phases = [
    { move = "rise", angle_deg = 140.0, law = "sine" }, { move = "dwell", angle_deg = 40.0 },
    { move = "return_", angle_deg = 140.0, law = "sine" }, { move = "dwell", angle_deg = 40.0 },
]
"""


@pytest.mark.sampled(1)
# what students draw, what is given and they start from, and what their table asks for
@pytest.mark.parametrize(
    ("purpose", "scene", "drawn", "given", "row"),
    [
        ("cam", CAM,
         {"DIAGRAM_BEND", "DIAGRAM_RATE", "DIAGRAM_LIFT", "JOINT_DIAGRAM", "CAM", "PITCH_CURVE", "CIRCLE_FAR"},
         {"AXIS", "PHASE", "CENTRE", "CIRCLE_BASE"}, "R"),
        ("cam", CAM.replace("base_circle_radius = 40.0", "least_transmission_angle_deg = 60.0"),
         {"DIAGRAM_BEND", "JOINT_DIAGRAM", "CAM", "CIRCLE_BASE"}, {"AXIS", "CENTRE"}, "R"),
        ("cam", CAM.replace('"roller"\nlift = 20.0', '"flat"\nlift = 20.0').replace("follower_radius = 8.0", ""),
         {"DIAGRAM_BEND", "JOINT_DIAGRAM", "CAM", "FOLLOWER"}, {"AXIS", "CENTRE", "CIRCLE_BASE"}, "R"),
        ("cam", ARM,
         {"DIAGRAM_BEND", "JOINT_DIAGRAM", "CAM", "FOLLOWER"}, {"AXIS", "CENTRE", "CIRCLE_BASE", "CIRCLE_PIVOT"}, "R"),
        ("meshing", PAIR.partition("[[exports]]")[0],
         {"OUTLINE", "ACTIVE_FLANK", "TOOTH_START", "CIRCLE_BASE", "CIRCLE_WORKING", "ARC_OF_ACTION"},
         {"CENTRE", "TANGENT"}, "m"),
        ("train", TRAIN, {"VELOCITY", "ANGULAR_VELOCITY"}, {"SCHEME", "AXIS", "CENTRE"}, "W"),
        ("generating", DISK, {"OUTLINE", "RACK", "CIRCLE_BASE", "CIRCLE_ROOT", "CIRCLE_TIP"},
         {"DISK", "CENTRE", "CIRCLE_REFERENCE"}, "72 mm"),
    ],
    ids=["base given", "angle given", "flat", "arm", "meshing", "train", "generating"],
)  # fmt: skip
def test_students_draw_the_pictures_themselves(
    purpose: str, scene: str, drawn: set[str], given: set[str], row: str, tmp_path: Path
) -> None:
    """Their lines stand on the teacher's sheet alone; what is given, on both and at the same places."""
    file = tmp_path / "s.toml"
    file.write_text(scene + SHEETS.format(purpose=purpose), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--no-verify"]) == 0
    lines: dict[str, dict[str, set[str]]] = {}
    words: dict[str, list[str]] = {}
    for name in ("students", "teacher"):
        (sheet,) = (tmp_path / "s").glob(f"s.{name}*.svg")
        groups = ElementTree.parse(sheet).getroot().findall(f"{SVG}g")
        lines[name] = {str(g.get("id")): {str(p.get("d")) for p in g.findall(f"{SVG}path")} for g in groups}
        words[name] = ["".join(t.itertext()) for g in groups for t in g.findall(f"{SVG}text")]
        assert faults(sheet) == []
        assert row in words[name]
    # scales are given
    assert {w for w in words["teacher"] if re.fullmatch(r"[\d.]+:[\d.]+", w)} <= set(words["students"])
    has = {name: {layer for layer, paths in found.items() if paths} for name, found in lines.items()}
    # the table has one sample of each line
    assert {layer for layer in drawn & has["students"] if len(lines["students"][layer]) > 1} == set()
    assert {layer for layer in drawn if len(lines["teacher"][layer]) < 2} <= {"CIRCLE_BASE", "CIRCLE_FAR"} & has[
        "teacher"
    ]
    assert given <= has["students"]
    for layer in given - {"AXIS"}:
        assert lines["students"][layer] <= lines["teacher"][layer]
    # a radius that is given has its number
    radius = re.search(r"base_circle_radius = (\d+)", scene)
    assert radius is None or f"= {radius[1]}.00" in " ".join(words["students"])
    assert (radius is None) == ("CIRCLE_BASE" not in given)


@pytest.mark.heavy
@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_builds_whole_in_both_languages(name: str, tmp_path: Path) -> None:
    for language in ("uk", "en"):
        assert main(["build", name, "--out", str(tmp_path / language), "--language", language]) == 0
    for file in sorted((tmp_path / "en" / name).glob("*.dxf")):
        outer, names = [], []
        for entity in ezdxf.readfile(file).modelspace():
            points = [(v.x, v.y) for v in make_path(entity).flattening(0.002)]
            (outer if entity.is_closed else names).append(points)
        edges = shapely.union_all([shapely.LinearRing(points) for points in outer])
        assert names
        assert shapely.distance(edges, shapely.MultiLineString(names)) >= 0.125
        left, low, right, high = edges.bounds
        assert min(left, low, 600 - right, 400 - high) >= 4.9


def board_alone(lesson: str, kerf: float, folder: Path) -> Path:
    """A lesson with its DXF board alone, of another kerf."""
    text = (SCENE_FOLDER / f"{lesson}.toml").read_text("utf-8").partition("[[exports]]")[0]
    file = folder / f"{lesson}.toml"
    file.write_text(
        text.replace("kerf = 0.2\n", f"kerf = {kerf}\n") + '[[exports]]\nformat = "dxf"\npurpose = "board"\n', "utf-8"
    )
    return file


@pytest.mark.heavy
@pytest.mark.parametrize("kerf", [0.0, 0.2, 0.3])
@pytest.mark.parametrize("name", ["lesson_3", "lesson_5"])
def test_boards_of_lessons_by_shapely_alone(name: str, kerf: float, tmp_path: Path) -> None:
    """Every contour closed and on the board, the gap kept to 1e-6 mm beyond what the file declares, names within."""
    assert main(["build", str(board_alone(name, kerf, tmp_path)), "--out", str(tmp_path)]) == 0
    parts = {"lesson_3": 3, "lesson_5": 9}[name]
    found = 0
    for file in sorted((tmp_path / name).glob("*.dxf")):
        entry = pieces_of(tmp_path / name, file.name)
        # kept between what is written, which may stand off the exact outlines by so much
        slack = 1e-6 + 2 * entry["max_error"]
        bodies = bodies_of(file, sag=4e-7)
        found += len(bodies)
        assert len(bodies) == len(entry["pieces"])
        assert all(body.is_valid for body in bodies)
        low_x, low_y, high_x, high_y = shapely.total_bounds(bodies)
        assert min(low_x, low_y, 600 - high_x, 400 - high_y) >= 5 - slack
        near = shapely.STRtree(bodies).query(bodies, predicate="dwithin", distance=2 - slack)
        assert near[0].tolist() == near[1].tolist()
        names = shapely.MultiLineString([rows[:, :2] for _, rows in contours(file, closed=False)])
        # half of a stroke of 0.25 mm within what is cut out, and not over its edge or a hole
        within = [b.simplify(1e-3).buffer(-0.125 + slack + 1e-3) for b in bodies]
        assert shapely.union_all(within).contains(names)
    assert found == 10 * parts


def test_a_kerf_that_closes_a_hole_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The mark at cam angle 0 is 2 mm wide."""
    assert main(["build", str(board_alone("lesson_5", 2.1, tmp_path)), "--out", str(tmp_path)]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "boards.plywood.kerf = 2.1" in said
    assert "at most 1.99" in said
    assert not (tmp_path / "lesson_5").exists()


@pytest.mark.heavy
@pytest.mark.parametrize("language", [pytest.param("en", marks=pytest.mark.heavy), "uk"])
def test_notes_name_every_length_that_no_machine_makes(tmp_path: Path, language: str) -> None:
    """A model of two sets: pins beside a board; the sizes by hand. What a bed holds is printed, not cut."""
    text = """
[scene.notes]
en = ["Glue the crank to its shaft."]
uk = ["Приклейте ручку до вала."]
[parts.plate]
kind = "plate"
width = 40.0
height = 30.0
face_width = 3.0
[parts.pin]
kind = "pin"
diameter = 5.0
length = 10.5
title = { en = "Pin", uk = "Палець" }
[parts.tube]
kind = "pin"
diameter = 8.0
bore_diameter = 5.2
length = 20.0
title = { en = "Tube", uk = "Труба" }
[instances.pin]
count = 3
at = [50.0, 0.0, 0.0]
"""
    board = "[boards.b]\nwidth = 200.0\nheight = 100.0\nthickness = 3.0\nsets = 2\n"
    board += '[[exports]]\nformat = "svg"\npurpose = "board"\n'
    bed = '[beds.b]\nwidth = 200.0\ndepth = 200.0\nheight = 100.0\n[[exports]]\nformat = "3mf"\npurpose = "plate"\n'
    point = "." if language == "en" else ","
    rows = ["6 × Ø5 × 10.5", "2 × Ø8/Ø5.2 × 20", "0.063 m" if language == "en" else "0.063 м"]
    flat = '[[exports]]\nformat = "svg"\n'
    for name, more, cut in some_of((("laser", board, True), ("printer", board + bed, False), ("flat", flat, None)), 2):
        (tmp_path / f"{name}.toml").write_text(text + more, encoding="utf-8")
        asked = ["build", str(tmp_path / f"{name}.toml"), "--out", str(tmp_path), "--language", language]
        assert main([*asked, "-q", "--no-verify"]) == 0
        told = (tmp_path / name / f"{name}.notes.txt").read_text("utf-8")
        assert ("Glue the crank" if language == "en" else "Приклейте ручку") in told
        # a laser's file of all parts has rods as their ends alone; no sheet asks for two sets
        rows = rows if cut is not None else ["3 × Ø5 × 10.5", "1 × Ø8/Ø5.2 × 20"]
        assert [row.replace(".", point) in told for row in rows] == [cut is not False] * len(rows), told
        # of each length, and of the tube in all
        assert told.count("Ø8/Ø5.2".replace(".", point)) == 2 * (cut is not False)
        # whatever the scene's file is called
        if cut is not None:
            plate = "Plate" if language == "en" else "Плита"
            assert f"{name}.board.1.svg: 2 × {plate}" in told
            assert (f"{name}.plate.1.3mf: 1 × {plate}, " in told) != cut


def test_lessons_and_coupons_have_notes_in_every_language() -> None:
    for name, file in built_in_scenes().items():
        notes = tomllib.loads(file.read_text("utf-8")).get("scene", {}).get("notes", {})
        assert notes or not ("lesson" in name or "coupon" in name)
        assert len({len(rows) for rows in notes.values()}) <= 1, name
        assert set(notes) in (set(), set(languages())), name


@pytest.mark.parametrize("name", [*LESSONS, "kerf_coupon", "fit_coupon", "print_cam_set", "power_table_print"])
def test_a_lesson_as_a_text_file_speaks_ukrainian(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", name, "--language", "uk"]) == 0
    told = capsys.readouterr().out
    own = (SCENE_FOLDER / f"{name}.toml").read_text("utf-8")
    # the same scene but for its language
    assert tomllib.loads(told.replace('language = "uk"\n', "")) == tomllib.loads(own)
    for comment in (line.partition(" # ")[2] for line in told.splitlines()):
        assert not comment or re.search("[А-яІЇЄҐіїєґ]|^[^A-Za-z]+$", comment), comment


def test_words_around_a_ukrainian_scene_are_ukrainian(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["calc", "train", "lesson_2", "--language", "uk"]) == 0
    assert "1 Сонячне колесо, 2 Сателіт 1, 3 Коронне колесо, H Водило" in capsys.readouterr().out
    (tmp_path / "s.toml").write_text("[scene]\nlanguage = uk\n", encoding="utf-8")
    assert main(["build", str(tmp_path / "s.toml")]) == 2
    assert "слова пишуть у прямих лапках" in capsys.readouterr().err

"""Engraved names in laser files, read by ezdxf and measured by shapely: inside clear material, or on a tag, told."""

from __future__ import annotations

import json
import re
import string
from pathlib import Path

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf.path import make_path

from exporters.command.cli import main
from exporters.command.new import new_scene
from geometry.approximation.chords import approximate_profile
from geometry.plane.letters import lettered, unknown_letters
from geometry.plane.profile import Profile
from parts.scene.load import make_parts, scene_from_toml
from parts.solids.naming import STROKE, _widest
from tests.exporters.making import table
from tests.offered import ALONE

_UKRAINIAN = "АБВГҐДЕЄЖЗИІЇЙКЛМНОПРСТУФХЦЧШЩЬЮЯ"
_GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "face_width": 3.0, "bore_diameter": 6.0}
_PARTS = {
    "gear": {**_GEAR, "label": True},
    "wheel": {
        **_GEAR, "number_of_teeth": 60, "label": "Ґанок їжака, Єва", "bore_diameter": 20.0,
        "spokes": {"count": 5, "inner_diameter": 34.0, "outer_diameter": 100.0, "width": 8.0},
    },
    "ring": {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 60, "outer_diameter": 150.0, "label": True},
    "rack": {"kind": "rack", "module": 2.0, "number_of_teeth": 12, "label": True},
    "frame": {"kind": "plate", "width": 80.0, "height": 60.0, "title": "Рама", "label": True,
              "holes": [{"at": [0.0, 0.0], "diameter": 20.0}]},
    "arm": {"kind": "follower_arm", "end": "roller", "arm_length": 62.0, "width": 12.0,
            "boss_diameter": 16.0, "pivot_diameter": 8.2, "pin_diameter": 4.0, "label": True},
    "small": {**_GEAR, "module": 1.0, "number_of_teeth": 9, "profile_shift_coefficient": 0.4, "bore_diameter": 4.0,
              "label": True},
}  # fmt: skip


def _scene(folder: Path, parts: dict, exports: list[dict], name: str = "s") -> Path:
    file = folder / f"{name}.toml"
    text = "".join(table(f"[parts.{key}]", keys) for key, keys in parts.items())
    file.write_text(text + "".join(table("[[exports]]", keys) for keys in exports), encoding="utf-8")
    return file


def _read(file: Path) -> tuple[shapely.Geometry, list[np.ndarray], list[str]]:
    """The material of a laser DXF, the engraved lines, and the layers in their order; read by ezdxf."""
    outer, inner, lines, layers = [], [], [], []
    for entity in ezdxf.readfile(file).modelspace():
        points = np.array([(v.x, v.y) for v in make_path(entity).flattening(0.002)])
        layers.append(entity.dxf.layer if entity.is_closed else "stroke")
        if not entity.is_closed:
            assert entity.dxf.layer == "ENGRAVE"
            lines.append(points)
        else:
            (outer if layers[-1] == "CUT_OUTER" else inner).append(shapely.Polygon(points))
    return shapely.difference(shapely.union_all(outer), shapely.union_all(inner)), lines, layers


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("labels")
    exports = [
        {"format": "dxf"},
        {"format": "svg", "kerf": 0.3},
        {"format": "dxf", "name": "r12", "dxf_version": "R12"},
    ]
    assert main(["build", str(_scene(folder, _PARTS, exports)), "--out", str(folder / "out")]) == 0
    return folder / "out" / "s"


@pytest.mark.sampled(1)
@pytest.mark.parametrize("part", _PARTS)
def test_every_name_lies_within_clear_material_by_half_a_stroke(made: Path, part: str) -> None:
    for ending in ("laser.dxf", "r12.dxf"):
        material, lines, layers = _read(made / f"{part}.{ending}")
        name = shapely.MultiLineString(lines)
        assert shapely.contains(material, name)
        assert shapely.distance(shapely.boundary(material), name) >= STROKE
        # engraved before anything is cut loose
        assert layers == sorted(layers, key=["stroke", "CUT_INNER", "CUT_OUTER"].index)
    ids = re.findall(' id="([^"]*)"', (made / f"{part}.svg").read_text())
    assert sum(name.startswith("engrave") for name in ids) == len(lines)
    assert len(set(ids)) == len(ids)


def test_a_name_without_room_stands_on_a_tag_and_is_told(made: Path) -> None:
    material, lines, layers = _read(made / "small.laser.dxf")
    assert layers.count("CUT_OUTER") == 2
    gear, tag = sorted(material.geoms, key=lambda piece: piece.bounds[0])
    assert gear.distance(tag) == pytest.approx(3.0, abs=0.1)
    assert shapely.contains(tag, shapely.MultiLineString(lines))
    report = json.loads((made / "report.json").read_text(encoding="utf-8"))
    told = {f["path"]: [x["code"] for x in f["findings"]] for f in report["files"]}
    assert all(("label_on_tag" in codes) == path.startswith("small.") for path, codes in told.items())


def test_what_a_file_must_do_is_asked_of_the_part_and_not_of_a_tag_wider_than_it(tmp_path: Path) -> None:
    wheel = {"kind": "ratchet_wheel", "module": 5.0, "number_of_teeth": 16}
    parts = {"w": wheel, "p": {"kind": "pawl", "of": "w", "label": "A NAME MUCH WIDER THAN ITS PART"}}
    exports = [{"format": "dxf", "parts": ["p"]}, {"format": "svg", "parts": ["p"]}]
    assert main(["build", str(_scene(tmp_path, parts, exports)), "--out", str(tmp_path)]) == 0
    files = json.loads((tmp_path / "s" / "report.json").read_text(encoding="utf-8"))["files"]
    assert all("label_on_tag" in {one["code"] for one in file["findings"]} for file in files)
    assert all(abs(file["measured"]["seat_gap"]) < 1e-6 for file in files)


def test_a_board_says_which_part_has_no_room_for_its_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text(
        '[parts.strip]\nkind = "plate"\nwidth = 40.0\nheight = 3.0\ntitle = "Thin strip"\n'
        '[parts.wide]\nkind = "plate"\nwidth = 40.0\nheight = 30.0\n'
        "[boards.one]\nwidth = 200.0\nheight = 100.0\nthickness = 3.0\n"
        '[[exports]]\nformat = "dxf"\npurpose = "board"\n',
        encoding="utf-8",
    )
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0
    (said,) = (line for line in capsys.readouterr().out.splitlines() if "no room" in line)
    assert said.startswith("note: Thin strip: ")


def test_a_tag_on_a_board_keeps_the_gap_of_its_cuts(tmp_path: Path) -> None:
    """Before: 3.1 mm off its part, whatever the board's gap."""
    board = "[boards.one]\nwidth = 60.0\nheight = 60.0\nthickness = 3.0\nkerf = 0.2\ngap = 7.0\n"
    roller = {"kind": "roller", "diameter": 12.0, "bore_diameter": 4.0, "face_width": 3.0}
    scene = _scene(tmp_path, {"roller": roller}, [{"format": "dxf", "purpose": "board"}])
    scene.write_text(scene.read_text() + board)
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0
    one, two = _read(tmp_path / "s" / "s.board.1.dxf")[0].geoms
    assert one.distance(two) == pytest.approx(7.0, abs=0.01)


def test_a_spoiled_stroke_is_caught(made: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, spoil in (
        ("gear.laser.dxf", lambda text: re.sub(r"(AcDbPolyline\n 90\n\d+\n 70\n0\n 10\n)-", r"\g<1>", text, count=1)),
        ("gear.svg", lambda text: text.replace('<path d="M', '<path d="M9', 1)),
        ("gear.svg", lambda text: "\n".join(x for i, x in enumerate(text.split("\n")) if i != 2)),
    ):
        file = made / name
        good = file.read_bytes()
        assert main(["verify", str(file)]) == 0
        file.write_text(spoil(good.decode()), encoding="utf-8", newline="\n")
        assert main(["verify", str(file)]) == 1
        assert "stroke" in capsys.readouterr().out
        file.write_bytes(good)


def test_without_a_label_nothing_is_engraved(made: Path, tmp_path: Path) -> None:
    scene = _scene(tmp_path, {"gear": {**_GEAR, "label": False}, "plain": _GEAR}, [{"format": "dxf"}])
    assert main(["build", str(scene), "--out", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "s" / "gear.dxf").read_bytes() == (tmp_path / "out" / "s" / "plain.dxf").read_bytes()
    assert "ENGRAVE" not in (tmp_path / "out" / "s" / "gear.dxf").read_text()


def test_a_letter_that_there_is_not_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = _scene(tmp_path, {"gear": {**_GEAR, "label": "歯車 23"}}, [{"format": "dxf"}])
    assert main(["build", str(scene), "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert "parts.gear.label" in said
    assert "歯車" in said
    assert not (tmp_path / "out").exists()


def test_every_letter_is_there_and_unlike_the_others() -> None:
    letters = string.ascii_letters + string.digits + "ЫЭЁЪыэёъ" + _UKRAINIAN + _UKRAINIAN.lower() + ".,:;-+=/()°±«»"
    letters += "ØøŁłßÄÖÜäöüÀàÉéÊêÇçÑñÅåČčĎŘřŠšĚěŮůŽžĄąĘęŚśŻżÓóŐőŢţȘșĂăĀā"
    assert not unknown_letters(letters)
    alike = dict(zip("АВЕКМНОРСТХІаеорсухі", "ABEKMHOPCTXIaeopcyxi", strict=True))
    seen: dict[object, str] = {}
    for letter in letters:
        strokes = lettered((letter,), 12.0)
        form = tuple(tuple((round(p.real, 6), round(p.imag, 6)) for p in stroke) for stroke in strokes)
        assert alike.get(letter, letter) == seen.setdefault(form, alike.get(letter, letter))


def test_marks_stand_over_or_under_their_letters() -> None:
    """The letter itself is the one without them; none touches it or reaches the line above or below."""
    for marked, plain, over in (("ÖÉŠÑÅő", "OESNAo", True), ("äéůž", "aeuz", True), ("Çşț", "Cst", False)):
        for sign, letter in zip(marked, plain, strict=True):
            strokes = lettered((sign,), 12.0)
            bare = [np.array(stroke) for stroke in lettered((letter,), 12.0)]
            own, marks = [np.array(s) for s in strokes[: len(bare)]], np.concatenate(strokes[len(bare) :])
            moved = own[0][0] - bare[0][0]
            for stroke, there in zip(own, bare, strict=True):
                assert stroke - moved == pytest.approx(there, abs=1e-9)
            body = np.concatenate(own).imag
            assert np.ptp(np.concatenate([*own, marks]).imag) <= 20.0 - 4.0
            assert marks.imag.min() > body.max() + 0.5 if over else marks.imag.min() < body.min() - 1.0
    # a mark stands in the place of a dot
    for marked in ("í", "î"):
        assert len(lettered((marked,), 6.0)) == len(lettered(("i",), 6.0)) == 2
    assert lettered(("о\u0308 Й",), 6.0) == lettered(("o\u0308 И\u0306",), 6.0)
    assert unknown_letters("Öl ų ḱ x⃗") == "\u20d7"


def test_lines_of_a_name_stand_in_the_middle_of_each_other() -> None:
    points = np.array([p for stroke in lettered(("MMMM", "L"), 5.0) for p in stroke])
    for row in (points[points.imag > 0], points[points.imag < 0]):
        assert row.real.min() + row.real.max() == pytest.approx(0.0, abs=1e-9)


def test_words_stand_apart_from_each_other_more_than_letters_do() -> None:
    def ends(text: str) -> list[float]:
        return sorted(p.real for stroke in lettered((text,), 12.0) for p in stroke)

    close, apart = ends("II"), ends("I I")
    # a third of a capital at the least, and not a whole one
    assert 4.0 < (apart[-1] - apart[0]) - (close[-1] - close[0]) < 12.0


def test_a_value_stays_with_its_letter(tmp_path: Path) -> None:
    """On a plate too narrow for one line, a line ends before m or x alone, as strokes of the file tell."""
    strip = {"kind": "plate", "width": 15.0, "height": 15.0, "label": "z 10 m 10 x 0"}
    assert main(["build", str(_scene(tmp_path, {"strip": strip}, [{"format": "dxf"}])), "--out", str(tmp_path)]) == 0
    _, lines, _ = _read(tmp_path / "s" / "strip.dxf")
    # strokes stand in the order of the text
    middles = [float(stroke[:, 1].mean()) for stroke in lines]
    rows = [k for k in range(1, len(middles)) if middles[k - 1] - middles[k] > 1.5]
    teeth, module = (len(lettered((text,), 1.0)) for text in ("z 10", "m 10"))
    assert rows
    assert set(rows) <= {teeth, teeth + module}


@pytest.mark.heavy
@pytest.mark.parametrize("kind", ALONE)
def test_a_name_finds_room_on_every_kind(kind: str) -> None:
    part = make_parts(scene_from_toml(new_scene(kind).encode(), kind, kind), kind)[0][
        "gear" if kind == "spur_gear" else kind
    ]
    region = part.cut(0.0, gap=2.0).region

    def ring(profile: Profile) -> shapely.Polygon:
        points = approximate_profile(profile, 0.002, arcs=False).geometry.expanded()[0]
        return shapely.Polygon(np.column_stack([points.real, points.imag]))

    outer = shapely.union_all([ring(p) for p in (region.outer, *region.apart)])
    material = shapely.difference(outer, shapely.union_all([ring(p) for p in (*region.holes, *region.marks)]))
    name = shapely.MultiLineString([[(p.real, p.imag) for p in stroke] for stroke in region.strokes])
    assert shapely.contains(material, name)
    assert shapely.distance(shapely.boundary(material), name) >= STROKE


BOARD = """
[boards.one]
width = 100.0
height = 100.0
thickness = 3.0
[[exports]]
format = "svg"
purpose = "board"
[[exports]]
format = "dxf"
"""


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("label", "codes"),
    [("z 21 m 2", ["label_tells_z"]), ("z 22 m 2,5", ["label_tells_m"]), ("z 22 m 2 x 0,3", []), ("No. 21", [])],
)
def test_a_label_that_tells_other_numbers_is_told(tmp_path: Path, label: str, codes: list[str]) -> None:
    text = '[parts.g]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 22\nprofile_shift_coefficient = 0.3\n'
    (tmp_path / "s.toml").write_text(f'{text}label = "{label}"\n{BOARD}', encoding="utf-8")
    assert main(["build", str(tmp_path / "s.toml"), "--out", str(tmp_path), "-q", "--no-verify"]) == 0
    report = json.loads((tmp_path / "s/report.json").read_text("utf-8"))
    for found in (report["parts"]["g"]["findings"], *(file["findings"] for file in report["files"])):
        assert [one["code"] for one in found if one["code"].startswith("label")] == codes


def test_engraved_numbers_have_the_mark_of_the_scenes_language(tmp_path: Path) -> None:
    """m 2,5 in Ukrainian, as on its drawing: it was 2.5."""
    told = {}
    for language, label in (("uk", "true"), ("uk", '"z 22 m 2,5"'), ("en", "true"), ("en", '"z 22 m 2.5"')):
        text = f'[scene]\nlanguage = "{language}"\n[parts.g]\nkind = "spur_gear"\nmodule = 2.5\nnumber_of_teeth = 22\n'
        (tmp_path / "s.toml").write_text(f'{text}label = {label}\n[[exports]]\nformat = "svg"\n', encoding="utf-8")
        assert main(["build", str(tmp_path / "s.toml"), "--out", str(tmp_path), "-q", "--no-verify"]) == 0
        told[language, label] = (tmp_path / "s/g.svg").read_bytes()
    assert told["uk", "true"] == told["uk", '"z 22 m 2,5"'] != told["en", "true"] == told["en", '"z 22 m 2.5"']


def test_of_a_wide_part_no_circle_is_sought_nearer_than_its_letters_need(monkeypatch: pytest.MonkeyPatch) -> None:
    """A gear of 1 m looked four times for the middle of its body to 0.02 mm: 0.7 s, of 7 m 4 s."""
    asked: list[float] = []
    sought = shapely.maximum_inscribed_circle

    def circle(material: shapely.Geometry, tolerance: float) -> shapely.Geometry:
        asked.append(tolerance)
        return sought(material, tolerance)

    monkeypatch.setattr(shapely, "maximum_inscribed_circle", circle)
    text = '[parts.g]\nkind = "spur_gear"\nmodule = 10.0\nnumber_of_teeth = 100\nbore_diameter = 6.0\nlabel = "A"\n'
    part = make_parts(scene_from_toml(text.encode() + b'[[exports]]\nformat = "svg"\n', "s", "s"), "s")[0]["g"]
    strokes = np.concatenate(part.cut(0.0, gap=2.0).region.strokes)
    assert np.ptp(strokes.imag) == pytest.approx(8.0)
    assert len(asked) == 1
    assert asked[0] >= 1.0


def test_the_widest_circle_is_near_where_letters_take_its_width() -> None:
    """Places all about its middle; a coarser search lost 0.13 mm of this one."""
    clear = shapely.Polygon([(-30.0, -30.0), (30.0, -27.0), (45.0, -13.0), (20.0, -8.0), (-30.0, -25.0)])
    middle, radius = _widest(clear)
    x, y = np.meshgrid(*(place + np.linspace(-1, 1, 81) for place in (middle.real, middle.imag)))
    best = shapely.distance(clear.exterior, shapely.points(x, y)).max()
    assert best - 0.02 <= radius <= best + 0.02

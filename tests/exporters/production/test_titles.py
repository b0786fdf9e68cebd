"""``title`` of a part, in any script: in STEP by OCCT's own reader, on sheets, previews and paper models."""

from __future__ import annotations

import re
import zipfile
from pathlib import Path

import pytest

from exporters.command.cli import main
from exporters.formats.read_3mf import read_3mf
from exporters.formats.read_step import read_step, read_step_assembly
from exporters.production.check_lines import names_of
from parts.base.part import Part
from parts.base.registry import KINDS
from parts.base.texts import told_in
from parts.scene.load import load_scene, make_parts, scene_from_toml

SCENE = """
[parts.pinion]
kind = "spur_gear"
module = 3.0
number_of_teeth = 12
profile_shift_coefficient = 0.1
title = "Шестерня «Ґ» 小歯車"
label = true
[parts.wheel]
kind = "spur_gear"
module = 3.0
number_of_teeth = 20
title = "Колесо"
label = true
[[mates]]
kind = "external_gear_pair"
first = "pinion"
second = "wheel"
[[exports]]
format = "step"
[[exports]]
format = "step"
assembly = true
name = "both"
[[exports]]
format = "sheet"
tolerance = 1e-3
[[exports]]
format = "svg"
[[exports]]
format = "sheet"
purpose = "generating"
tolerance = 1e-3
parts = ["wheel"]
title_block = true
[[exports]]
format = "3mf"
parts = ["wheel"]
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("titles")
    (folder / "s.toml").write_text(SCENE, encoding="utf-8")
    assert main(["build", str(folder / "s.toml"), "--out", str(folder), "--no-verify"]) == 0
    return folder / "s"


def test_step_has_them_beside_the_ids(folder: Path) -> None:
    pytest.importorskip("OCP", reason="the CAD kernel is an extra", exc_type=ImportError)
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.StepBasic import StepBasic_Product
    from OCP.STEPControl import STEPControl_Reader

    for name, wanted in (
        ("pinion", {"pinion": "Шестерня «Ґ» 小歯車 (pinion)"}),
        ("s.both", {"pinion": "Шестерня «Ґ» 小歯車 (pinion)", "wheel": "Колесо (wheel)"}),
    ):
        reader = STEPControl_Reader()
        assert reader.ReadFile(str(folder / f"{name}.step")) == IFSelect_RetDone
        model = reader.StepModel()
        found = {}
        for number in range(1, model.NbEntities() + 1):
            entity = model.Value(number)
            if isinstance(entity, StepBasic_Product):
                found[entity.Id().String().ToCString()] = entity.Name().String().ToCString()
        assert found.items() >= wanted.items()
        # without a Latin letter FreeCAD's reader takes the id
        assert set(wanted.values()) <= _shown(folder / f"{name}.step")


def _shown(file: Path) -> set[str]:
    """The names of all shapes as the kernel's document has them."""
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name
    from OCP.TDF import TDF_LabelSequence
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    document, reader = TDocStd_Document(TCollection_ExtendedString("x")), STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.ReadFile(str(file))
    reader.Transfer(document)
    labels, name = TDF_LabelSequence(), TDataStd_Name()
    XCAFDoc_DocumentTool.ShapeTool_s(document.Main()).GetShapes(labels)
    found = [labels.Value(k) for k in range(1, labels.Length() + 1)]
    return {name.Get().ToExtString() for label in found if label.FindAttribute(TDataStd_Name.GetID_s(), name)}


def test_a_changed_title_is_caught(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = folder / "wheel.step"
    good = file.read_text()
    title = "\\X2\\" + "".join(f"{ord(c):04X}" for c in "Колесо") + "\\X0\\"
    assert title in good
    for spoiled in ("wheel", "Rad"):
        file.write_text(good.replace(title, spoiled))
        assert main(["verify", str(file)]) == 1
        assert "title" in capsys.readouterr().out
    file.write_text(good)
    assert main(["verify", str(file)]) == 0


def test_a_3mf_has_the_title_for_people_and_the_id_as_part_number(
    folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = folder / "wheel.3mf"
    with zipfile.ZipFile(file) as package:
        good = {name: package.read(name) for name in package.namelist()}
    model = good["3D/3dmodel.model"].decode("utf-8")
    assert 'name="Колесо" partnumber="wheel"' in model
    assert re.findall(r'<metadata name="Title"[^>]*>([^<]*)<', model) == ["Колесо"]
    for spoiled in ("Rad", "wheel"):
        with zipfile.ZipFile(file, "w") as package:
            for name, content in good.items():
                package.writestr(name, content.replace("Колесо".encode(), spoiled.encode()))
        assert main(["verify", str(file)]) == 1
        assert "title" in capsys.readouterr().out


def test_a_3mf_tells_its_language_and_solids_have_the_usual_colour(folder: Path, tmp_path: Path) -> None:
    """Where the part has none of its own, in both formats that have colours."""
    file = tmp_path / "s.toml"
    file.write_text('[scene]\nlanguage = "uk"\n' + SCENE, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--no-verify", "--format", "3mf"]) == 0
    for made, language in ((folder, "en"), (tmp_path / "s", "uk")):
        model = zipfile.ZipFile(made / "wheel.3mf").read("3D/3dmodel.model").decode("utf-8")
        assert re.findall(r'xml:lang="([^"]*)"', model) == [language]
    assert read_3mf(folder / "wheel.3mf").colour == read_step(folder / "wheel.step").colour == "#b8c4d0"


def test_pictures_and_sheets_show_them(folder: Path) -> None:
    assert "小歯車" in (folder / "pinion.preview.svg").read_text("utf-8")
    assert "Колесо" in (folder / "s.preview.svg").read_text("utf-8")
    assert "Шестерня «Ґ» 小歯車 (1), Колесо (2)" in (folder / "s.meshing.1.svg").read_text("utf-8")
    assert "Колесо" in (folder / "s.generating.svg").read_text("utf-8")


def test_engraved_is_what_there_are_letters_for(folder: Path) -> None:
    strokes = {name: (folder / f"{name}.svg").read_text().count('id="engrave') for name in ("pinion", "wheel")}
    # "z 12 m 3 x 0.1" alone, where "Колесо z 20 m 3" has its title
    assert strokes["pinion"] < strokes["wheel"]


PLATE = """
[scene]
title = "A frame{scene}"
[parts.frame]
kind = "plate"
width = 40.0
height = 30.0
face_width = 3.0
title = "Frame{part}"
[boards.ply]
width = 100.0
height = 80.0
thickness = 3.0
"""


@pytest.mark.parametrize(
    ("scene", "part", "key"), [(" \U0001f600", "", "scene.title"), ("", " \U0001f600", "parts.frame.title")]
)
def test_a_title_that_a_pdf_cannot_write_is_refused_before_a_file(
    scene: str, part: str, key: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("fpdf")
    file = tmp_path / "s.toml"
    export = '[[exports]]\nformat = "pdf"\npurpose = "model"\n'
    file.write_text(PLATE.format(scene=scene, part=part) + export, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert f"{key} = " in said
    assert "has no letters \U0001f600" in said
    assert not (tmp_path / "out").exists()


def test_a_title_that_is_not_engraved_is_told(tmp_path: Path) -> None:
    file = tmp_path / "s.toml"
    export = '[[exports]]\nformat = "dxf"\npurpose = "board"\n'
    for part, told in ((" \U0001f600", True), ("", False)):
        file.write_text(PLATE.format(scene="", part=part) + export, encoding="utf-8")
        assert main(["build", str(file), "--out", str(tmp_path)]) == 0
        report = (tmp_path / "s" / "report.json").read_text(encoding="utf-8")
        assert ("title_not_engraved" in report) == told


SPOKEN = """
[scene]
title = { en = "A model", uk = "Модель" }
[parts.cog]
kind = "plate"
width = 40.0
height = 30.0
face_width = 3.0
title = { en = "Wheel", uk = "Колесо" }
label = { en = "left", uk = "ліве" }
[parts.pinion]
kind = "plate"
width = 40.0
height = 30.0
face_width = 3.0
title = { uk = "Шестерня" }
[instances.cog_2]
part = "cog"
[[mates]]
kind = "fixed"
first = "pinion"
second = "cog_2"
offset = [50.0, 0.0, 0.0]
[boards.ply]
width = 200.0
height = 100.0
thickness = 3.0
[[exports]]
format = "svg"
purpose = "board"
"""


def test_words_in_several_languages(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "s.toml"
    file.write_text(SPOKEN, encoding="utf-8")
    made = {}
    for language, wanted in (("en", ("A model", "Wheel", "Шестерня")), ("uk", ("Модель", "Колесо", "Шестерня"))):
        out = tmp_path / language
        assert main(["build", str(file), "--out", str(out), "--language", language, "--no-verify"]) == 0
        # how a mate joins whom, by their names
        assert f"{wanted[2]} - {wanted[1]} 2" in capsys.readouterr().out
        picture = (out / "s" / "s.board.1.preview.svg").read_text("utf-8")
        assert all(word in picture for word in (*wanted, "200 × 100 × 3"))
        made[language] = (out / "s" / "s.board.1.svg").read_bytes()
    # engraved in its language
    assert made["en"] != made["uk"]
    file.write_text(SPOKEN.replace('uk = "Колесо"', 'ru = "Колесо"'), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path / "no")]) == 2
    said = capsys.readouterr().err
    assert 'parts.cog.title.ru = "Колесо": unknown key; known keys: en, uk' in said
    assert said.count("\n") == 1


@pytest.mark.parametrize("size", [(60, 60), pytest.param((50, 300), marks=pytest.mark.heavy)])
def test_the_picture_of_a_board_holds_a_long_title(tmp_path: Path, size: tuple[int, int]) -> None:
    """No row goes over the edge, whatever the board; nothing is left out."""
    title, width, height = "зачеплення, яке треба виготовити", *size
    title = ", ".join([title] * 3)
    text = SPOKEN.replace('uk = "Модель"', f'uk = "{title}"').replace('uk = "Колесо"', f'uk = "{title}"')
    board = f"width = {width}.0\nheight = {height}.0"
    file = tmp_path / "s.toml"
    file.write_text(text.replace("width = 200.0\nheight = 100.0", board), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--language", "uk", "--no-verify"]) == 0
    picture = (tmp_path / "s" / "s.board.1.preview.svg").read_text("utf-8")
    page = float(re.findall(r'viewBox="0 0 (\S+) ', picture)[0])
    rows = re.findall(r'<text x="(\S+)" y="(\S+)" style="[^"]*font-size:([\d.]+)px">([^<]*)', picture)
    assert max(float(x) + 0.6 * float(size) * len(row) for x, _, size, row in rows) <= page
    told = " ".join(row for *_, row in rows)
    assert f"{title}: {width} × {height} × 3" in told
    assert told.count(title) == 2
    heights = [float(y) for _, y, _, _ in rows]
    assert len(set(heights)) == len(heights)


def test_a_part_of_an_assembly_is_called_in_the_language_of_the_scene() -> None:
    """The power module's recipe gives both titles; what is asked for is shown."""
    for language, title in (("uk", "Корпус"), ("en", "Housing")):
        scene = load_scene("power_module", language=language)
        assert told_in(scene.scene.language, scene.parts["body"].title) == title


@pytest.mark.parametrize("scene", ["ferguson", "james_print", "power_module_kinematics", "power_table_print"])
def test_what_a_recipe_makes_is_called_in_the_language_of_the_scene(scene: str) -> None:
    for language, letters in (("uk", "А-ЯІЇЄҐа-яіїєґ"), ("en", "A-Za-z")):
        made = load_scene(scene, language)
        parts = {
            key: Part(key, KINDS[str(spec.__struct_config__.tag)], spec, None, language)
            for key, spec in made.parts.items()
        }
        names = names_of(made.instances, parts)
        assert len(set(names.values())) == len(names)
        assert not [name for name in names.values() if not re.fullmatch(rf"[{letters}'’() 0-9]+", name)]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("language", ["en", "uk"])
def test_of_two_assemblies_of_one_kind_each_part_is_called_by_its_own(language: str) -> None:
    made = load_scene("compound_two_stage", language)
    names = names_of(made.instances, make_parts(made, "")[0])
    assert len(set(names.values())) == len(names)
    assert [names[f"{one}_sun"].endswith(f" ({one})") for one in ("first", "second")] == [True, True]
    assert [names[f"first_satellite_{k}"].endswith(f" (first) {k}") for k in (1, 2, 3)] == [True] * 3


def test_an_assembly_has_another_name_than_its_parts(tmp_path: Path) -> None:
    """A scene Pin.toml with a part `pin` that has a title: both were one product, and the file failed its check."""
    scene = tmp_path / "Pin.toml"
    scene.write_text(
        '[parts.pin]\nkind = "pin"\ndiameter = 4.0\nlength = 9.0\ntitle = "Палець"\n[parts.ring]\nkind = "pin"\n'
        'diameter = 8.0\nlength = 3.0\nbore_diameter = 4.0\n[[mates]]\nkind = "coaxial"\nfirst = "pin"\n'
        'second = "ring"\n[[exports]]\nformat = "step"\nassembly = true\n', encoding="utf-8",
    )  # fmt: skip
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0
    assert main(["verify", str(tmp_path / "Pin" / "Pin.step")]) == 0
    assert read_step_assembly(tmp_path / "Pin" / "Pin.step").title == "Pin.assembly"


def test_an_instance_of_a_name_of_its_own_is_called_by_both() -> None:
    """«Вісь vis2» read as if all of it were the title: what the scene calls it stands in brackets."""
    text = '[parts.vis]\nkind = "pin"\ndiameter = 5.0\nlength = 20.0\ntitle = "Вісь"\n'
    text += '[instances.vis_1]\npart = "vis"\n[instances.vis2]\npart = "vis"\nat = [20.0, 0.0, 0.0]\n'
    made = scene_from_toml(text.encode(), "s", "s")
    assert names_of(made.instances, make_parts(made, "s")[0]) == {"vis_1": "Вісь 1", "vis2": "Вісь (vis2)"}

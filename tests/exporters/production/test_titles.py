"""``title`` of a part, in any script: in STEP by OCCT's own reader, on sheets, previews and paper models."""

from __future__ import annotations

from pathlib import Path

import pytest

from exporters.command.cli import main

SCENE = """
[parts.pinion]
kind = "spur_gear"
module = 2.0
number_of_teeth = 17
profile_shift_coefficient = 0.1
title = "Шестерня «Ґ» 小歯車"
label = true
[parts.wheel]
kind = "spur_gear"
module = 2.0
number_of_teeth = 30
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
[[exports]]
format = "svg"
[[exports]]
format = "sheet"
purpose = "generating"
parts = ["wheel"]
title_block = true
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("titles")
    (folder / "s.toml").write_text(SCENE, encoding="utf-8")
    assert main(["build", str(folder / "s.toml"), "--out", str(folder)]) == 0
    return folder / "s"


def test_step_has_them_beside_the_ids(folder: Path) -> None:
    pytest.importorskip("OCP", reason="the CAD kernel is an extra")
    from OCP.IFSelect import IFSelect_RetDone
    from OCP.StepBasic import StepBasic_Product
    from OCP.STEPControl import STEPControl_Reader

    for name, wanted in (
        ("pinion", {"pinion": "Шестерня «Ґ» 小歯車"}),
        ("s.both", {"pinion": "Шестерня «Ґ» 小歯車", "wheel": "Колесо"}),
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


def test_pictures_and_sheets_show_them(folder: Path) -> None:
    assert "小歯車" in (folder / "pinion.preview.svg").read_text("utf-8")
    assert "Колесо" in (folder / "s.preview.svg").read_text("utf-8")
    assert "Шестерня «Ґ» 小歯車 (1), Колесо (2)" in (folder / "s.meshing.1.svg").read_text("utf-8")
    assert "Колесо" in (folder / "s.generating.svg").read_text("utf-8")


def test_engraved_is_what_there_are_letters_for(folder: Path) -> None:
    strokes = {name: (folder / f"{name}.svg").read_text().count('id="engrave"') for name in ("pinion", "wheel")}
    # "z 17 m 2 x 0.1" alone, where "Колесо z 30 m 2" has its title
    assert strokes["pinion"] < strokes["wheel"]

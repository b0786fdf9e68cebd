"""Parts lists of scenes, read from their files: positions, quantities, masses by hand, the form by its lines."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import Any

import pytest

from exporters.command.cli import main
from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.base.registry import KINDS
from parts.drawing.names import drawn_names
from parts.scene.load import make_parts, scene_from_toml

LIST = """
[scene]
title = "Bracket"
language = "{language}"

[parts.frame]
kind = "plate"
width = 60.0
height = 40.0
face_width = 5.0
holes = [{{ at = [-20.0, 0.0], diameter = 8.0 }}, {{ at = [20.0, 0.0], diameter = 8.0 }}]
material = "steel"
title = {{ en = "Frame", uk = "Рама" }}
position = 2
designation = "ABC.01.00.02"

[parts.rod]
kind = "pin"
diameter = 8.0
length = 50.0
title = "Rod"

[parts.screw]
kind = "pin"
diameter = 4.0
length = 16.0
material = "steel"
title = "Screw with a long cylindrical head and a hexagon socket in it"
standard = "GOST 11738-84"

[instances.rod_1]
part = "rod"
at = [-20.0, 0.0, 10.0]

[instances.rod_2]
part = "rod"
at = [20.0, 0.0, 10.0]

[instances.screw]
count = 7
at = [100.0, 0.0, 0.0]

[[exports]]
format = "csv"

[[exports]]
format = "sheet"
purpose = "parts_list"
title_block = {{ designation = "ABC.01.00.00", drawn = "N. N." }}
"""


def built(folder: Path, language: str = "en", more: str = "") -> Path:
    file = folder / "s.toml"
    file.write_text(LIST.format(language=language) + more, "utf-8")
    assert main(["build", str(file), "--out", str(folder / "out")]) == 0
    return folder / "out" / "s"


def test_csv_tells_positions_quantities_and_masses(tmp_path: Path) -> None:
    with (built(tmp_path) / "s.parts_list.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert [(r["Item"], r["Name"], r["Qty"], r["Section"]) for r in rows] == [
        ("2", "Frame", "1", "Parts"),
        # what has no number goes on from the greatest, parts first
        ("3", "Rod Ø8 × 50", "2", "Parts"),
        ("4", "Screw with a long cylindrical head and a hexagon socket in it", "7", "Standard items"),
    ]
    frame, rod, screw = rows
    assert frame["Designation"] == "ABC.01.00.02"
    assert screw["Standard"] == "GOST 11738-84"
    assert float(frame["Mass, kg"]) == pytest.approx((60 * 40 - 2 * math.pi * 16) * 5 * 7.85e-6, rel=1e-5)
    assert float(screw["Total mass, kg"]) == pytest.approx(7 * math.pi * 4 * 16 * 7.85e-6, rel=1e-5)
    assert rod["Mass, kg"] == rod["Total mass, kg"] == ""


@pytest.mark.parametrize("export", ['"csv"', '"dxf"', '"svg"\npurpose = "part"', '"pdf"\npurpose = "assembly"'])
def test_a_gear_that_cannot_be_chamfered_is_in_no_file(
    export: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (file := tmp_path / "s.toml").write_text(
        '[parts.g]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 12\nprofile_shift_coefficient = 0.7\n'
        f'material = "steel"\nface_chamfer = 0.8\n[[exports]]\nformat = {export}\n'
    )
    assert main(["build", str(file), "--out", str(tmp_path / "out")]) == 2
    assert "parts.g.face_chamfer = 0.8: leaves nothing of the outline" in capsys.readouterr().err


def test_two_parts_have_one_position_only_where_the_list_tells_them_alike(tmp_path: Path) -> None:
    # before: the file told the item twice
    pin = '[parts.{name}]\nkind = "pin"\ndiameter = {size}\nlength = 9.0\nposition = 3\ntitle = "{title}"\n'
    text = pin.format(name="a", size=4.0, title="Pin") + pin.format(name="b", size=5.0, title="{title}")
    text += '[[exports]]\nformat = "csv"\n'
    (file := tmp_path / "s.toml").write_text(text.format(title="Pin"))
    assert main(["build", str(file), "--out", str(tmp_path / "out")]) == 0
    rows = list(csv.DictReader((tmp_path / "out/s/s.parts_list.csv").read_text().splitlines()))
    assert [(row["Item"], row["Qty"]) for row in rows] == [("3", "2")]
    with pytest.raises(SceneError) as caught:
        plan_build(scene_from_toml(text.format(title="Axle").encode(), "s", "s"), "s", [], [])
    assert "parts.b.position = 3" in str(caught.value)
    assert "parts.a" in str(caught.value)
    assert "4 works" in str(caught.value)


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("orientation", "wanted"),
    [
        ("thesis", {"parts": (33, 42), "standard": (15, 417)}),
        # 34 and 35 are added, 15 and 57 dropped
        ("cranks", {"parts": (34, 59), "standard": (14, 416)}),
        # 36 to 39 are added
        ("idlers", {"parts": (37, 49), "standard": (15, 417)}),
    ],
)
def test_the_list_of_the_power_module_is_the_theses_or_what_keeps_it_parallel_changes_it(
    orientation: str, wanted: dict[str, tuple[int, int]]
) -> None:
    from parts.scene.load import in_keys_of_file, make_parts, scene_from_dict
    from parts.scene.parts_list import list_rows
    from parts.scene.placing import place

    made = scene_from_dict({"assemblies": [{"kind": "power_module", "orientation": orientation}]}, "t", "t")
    with in_keys_of_file(made.origins):
        parts, matings = make_parts(made, "t")
    placing = place(made.instances, made.drives, parts, matings, "t")
    rows = list_rows(placing.instances, parts, "uk")
    counts = {name: [row.count for row in rows if row.section == name] for name in ("parts", "standard")}
    assert {name: (len(found), sum(found)) for name, found in counts.items()} == wanted
    assert all(row.mass is not None for row in rows)


def test_the_sheet_is_form_1_of_gost_2_106(tmp_path: Path) -> None:
    import ezdxf

    space = ezdxf.readfile(built(tmp_path, "uk") / "s.parts_list.dxf").modelspace()
    lines = [(e.dxf.start, e.dxf.end) for e in space.query("LINE[layer=='FRAME']")]
    top = max(a.y for a, _ in lines)
    xs = sorted({round(a.x, 6) for a, b in lines if abs(a.x - b.x) < 1e-9 and max(a.y, b.y) > top - 1 and a.x > 19.9})
    assert xs == pytest.approx([20, 26, 32, 40, 110, 173, 183, 205])
    texts = {e.dxf.text: e.dxf.insert for e in space.query("TEXT")}
    for word in ("Рама", "Деталі", "Стандартні вироби", "Позначення", "ABC.01.00.00", "N. N.", "ГОСТ 11738-84"):
        assert word in texts, word
    # a head that is too long for its column is read from the right, as large as the others
    heads = {
        e.dxf.text: (e.dxf.height, round((e.dxf.align_point - e.dxf.insert).angle_deg)) for e in space.query("TEXT")
    }
    assert heads["Кільк."] == heads["Поз."] == (3.5, 90)
    assert heads["Позначення"] == (3.5, 0)
    # 60 x 40 x 5 of steel less its holes, and a screw in grams
    assert "90,3 г" in texts
    assert "1,58 г" in texts
    # rows of 8 mm below a head of 15
    assert (top - 15 - texts["Рама"].y) // 8 == 3
    assert texts["Деталі"].y > texts["Рама"].y > texts["Rod Ø8 × 50"].y > texts["Стандартні вироби"].y


def test_a_long_list_goes_on_with_form_2a(tmp_path: Path) -> None:
    import ezdxf

    more = "".join(f'[parts.p{k}]\nkind = "pin"\ndiameter = 3.0\nlength = {k}.0\n' for k in range(1, 41))
    folder = built(tmp_path, more=more.replace("[parts", "\n[parts"))
    files = [folder / f"s.parts_list.{n}.dxf" for n in (1, 2)]
    first, second = ([e.dxf.text for e in ezdxf.readfile(file).modelspace().query("TEXT")] for file in files)
    assert {"Drawn", "Sheets", "2"} <= set(first)
    assert "Drawn" not in second
    assert "ABC.01.00.00" in second
    assert sum(text.startswith("p") for text in first + second) == 40
    # a heading does not end a sheet
    assert "Standard items" in second


def test_a_spoiled_list_is_found(tmp_path: Path, capsys: Any) -> None:
    file = built(tmp_path) / "s.parts_list.csv"
    assert main(["verify", str(file)]) == 0
    file.write_text(file.read_text("utf-8").replace(",7,", ",8,"), "utf-8")
    assert main(["verify", str(file)]) != 0
    assert "4" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("export", "key"),
    [
        ('format = "csv"\npaper = "A3"', "exports[1].paper"),
        ('format = "csv"\nassembly = true', "exports[1].assembly"),
        ('format = "dxf"\npurpose = "parts_list"', "exports[1].purpose"),
        ('format = "sheet"\npurpose = "parts_list"\nscale = "1:2"', "exports[1].scale"),
    ],
)
def test_what_a_list_does_not_take_is_refused_by_key(export: str, key: str) -> None:
    text = f'[parts.a]\nkind = "pin"\ndiameter = 3.0\nlength = 3.0\n[[exports]]\n{export}\n'
    with pytest.raises(SceneError) as refused:
        scene_from_toml(text.encode(), "s", "s")
    assert refused.value.key == key


def test_what_has_no_title_is_called_by_its_kind_in_the_language_of_the_drawing() -> None:
    """Its id is the designation then; solids of any form have no such name."""
    raw = """
    [parts.disc]
    kind = "spur_gear"
    module = 2.0
    number_of_teeth = 20
    [parts.ball]
    kind = "turned"
    points = [{ r = 0.0, z = 0.0 }, { r = 5.0, z = 0.0 }, { r = 5.0, z = 5.0 }, { r = 0.0, z = 5.0 }]
    """
    parts, _ = make_parts(scene_from_toml(raw.encode(), "s.toml", "s"), "s")
    for language, name in (("en", "Gear"), ("uk", "Колесо зубчасте")):
        assert drawn_names(parts["disc"], language) == (name, "disc")
        assert drawn_names(parts["ball"], language) == ("ball", "")
    assert set(KINDS) - set(KINDS.called) == {"turned", "layered", "step_part"}

"""Densities by the names in a scene, and mass properties against trimesh."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from parts.base.densities import DENSITIES, NAMES, ROWS
from parts.base.materials import density_of, mass_properties, material_told
from parts.base.texts import words
from parts.scene.load import load_scene, make_parts, scene_from_dict
from tests.exporters.making import run


# by standards and makers' sheets: masses of GOST 2590 and EN 10060, GOST 9941, EN 10088-1, GOST 1412
@pytest.mark.parametrize(
    ("text", "density"),
    [
        ("PLA", 1.24),
        ("plywood 3 mm", 0.65),
        ("Stainless steel 1.4301", 7.9),
        ("Steel C45", 7.85),
        ("сталь 45", 7.85),
        ("Сталь 20Х ГОСТ 4543-71", 7.85),
        ("40Х", 7.85),
        # Latin X and C, and small letters
        ("40X", 7.85),
        ("ст3", 7.85),
        ("12х18н10т", 7.9),
        ("сталь 20Х13 ГОСТ 5949", 7.7),
        # the mark goes before the name, which is longer
        ("чавун СЧ20", 7.1),
        ("ВЧ50", 7.1),
        ("БрА9Ж4", 7.6),
        ("бронза БрО10Ф1", 8.8),
        ("ЛС59-1", 8.45),
        ("Д16Т", 2.78),
        ("EN AW-6082 T6", 2.7),
        # nominal densities of the makers' tables
        ("AW-2017A", 2.79),
        ("AW-5754", 2.67),
        ("C36000", 8.5),
        ("CuZn39Pb3", 8.47),
        ("ABS", 1.04),
        ("16MnCr5", 7.85),
        ("AISI 316L", 8.0),
        ("POM", 1.41),
        # the same in Cyrillic letters
        ("РОМ", 1.41),
        ("АБС-пластик", 1.04),
        ("деревина", 0.6),
        ("оргскло 4 мм", 1.19),
        ("plastic", None),
        ("45", None),
        ("A4", None),
        ("M3", None),
        (None, None),
    ],
)
def test_a_material_is_known_by_its_name_anywhere_in_the_text(text: str | None, density: float | None) -> None:
    assert density_of(text) == density


# data sheets and annexes of standards: EN 1561, EN 1563, GOST 1412 (irons), EN 10088-1, EN 573 (wrought aluminium),
# CEN/TS 13388 (copper), makers of tool steels, plastics and filaments
SHEETS = {
    "100Cr6": 7.81, "41CrAlMo7": 7.71, "HS6-5-2": 8.15, "HS18-0-1": 8.7, "X153CrMoV12": 7.7, "110Г13Л": 7.89,
    "1.4301": 7.9, "1.4401": 8.0, "1.4571": 8.0, "1.4016": 7.7, "1.4021": 7.7,
    "GJL-150": 7.1, "GJL-200": 7.15, "GJL-250": 7.2, "GJL-300": 7.25, "GJL-350": 7.3, "GJS-400": 7.1, "GJS-500": 7.1,
    "GJS-600": 7.2, "GJS-700": 7.2, "СЧ10": 6.8, "СЧ15": 7.0, "СЧ20": 7.1, "СЧ25": 7.2, "СЧ30": 7.3, "СЧ35": 7.4,
    "CW614N": 8.47, "CW617N": 8.43, "CW508L": 8.44, "CuZn30": 8.53, "Л68": 8.6, "ЛС59-1": 8.45, "Л60": 8.4,
    "ЛЦ40С": 8.5, "C36000": 8.5, "CuSn8": 8.8, "CuSn12": 8.7, "БрО10С10": 9.1, "CuAl10Fe3Mn2": 7.6,
    "CuAl10Ni5Fe4": 7.6, "БрБ2": 8.2, "БрКМц3-1": 8.4, "Cu-ETP": 8.94,
    "AW-6060": 2.7, "AW-1050A": 2.71, "АМц": 2.73, "Д1": 2.8, "AW-2017A": 2.79, "AW-2024": 2.78, "AW-5052": 2.68,
    "AW-5754": 2.67, "AW-5083": 2.66, "АМг5": 2.65, "АМг6": 2.64, "AlSi7Mg": 2.66, "В95": 2.85, "AW-7075": 2.81,
    "AZ91": 1.8, "ВТ1-0": 4.5, "Ti6Al4V": 4.43, "Zamak": 6.7, "Б83": 7.38,
    "PLA": 1.24, "ABS": 1.04, "PETG": 1.27, "ASA": 1.07, "TPU": 1.21, "HIPS": 1.04, "SBS": 1.05, "POM-C": 1.41,
    "POM-H": 1.42, "PA6": 1.13, "PA66": 1.14, "PA6-G": 1.15, "PA6-GF30": 1.36, "PA12": 1.01, "PA11": 1.05, "PP": 0.91,
    "PE-HD": 0.95, "LDPE": 0.92, "PE-UHMW": 0.93, "PVC": 1.4, "PET": 1.38, "PEEK": 1.31, "PTFE": 2.18, "PMMA": 1.19,
    "PC": 1.2, "гетинакс": 1.4, "FR4": 1.85, "CFRP": 1.55, "NBR": 1.2, "HDF": 0.85, "OSB": 0.62, "balsa": 0.16,
}  # fmt: skip


@pytest.mark.parametrize("name", SHEETS)
def test_a_density_is_that_of_data_sheets(name: str) -> None:
    assert density_of(name) == SHEETS[name]


def test_a_material_weighs_the_same_in_either_language() -> None:
    """Each English name by its translation, which stands in the table of marks."""
    told = {name: words("uk").text(name) for name in NAMES}
    assert [name for name, other in told.items() if DENSITIES.get(other) != NAMES[name]] == []


def test_no_name_stands_with_two_densities() -> None:
    """Neither twice in the table nor once in Cyrillic and once in Latin letters; all of them are whole words."""
    rows = [name for _, row in ROWS for name in row.split(", ")] + list(NAMES)
    assert len(rows) == len(set(rows)) == len(DENSITIES)
    assert [name for name in DENSITIES if density_of(name) != DENSITIES[name]] == []


def test_mass_and_inertia_agree_with_the_mesh() -> None:
    raw = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "bore": {"shape": "D", "diameter": 8, "flat": 7},
           "hub": {"diameter": 20, "above": 6}, "material": "brass"}  # fmt: skip
    part = make_parts(scene_from_dict({"parts": {"g": raw}}, "test", "test"), "test")[0]["g"]
    mesh, found = part.to_trimesh(tolerance=0.001), mass_properties(part.made_by.moments(part.body(0.0)), part.density)
    mesh.density = 8.5e-3
    assert found["mass"] == pytest.approx(mesh.mass, rel=2e-4)
    assert np.allclose(found["centre_of_mass"], mesh.center_mass, atol=1e-3)
    tensor = np.array(found["inertia_tensor"])
    assert np.allclose(tensor, mesh.moment_inertia, rtol=5e-4, atol=1e-4 * tensor[2, 2])
    # the axis stands beside the centre of mass: Steiner
    x, y, _ = found["centre_of_mass"]
    assert found["axial_inertia"] == pytest.approx(tensor[2, 2] + found["mass"] * (x * x + y * y), rel=1e-12)


def test_a_density_of_one_s_own_goes_first() -> None:
    raw = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "material": "PLA", "density": 1.1}
    part = make_parts(scene_from_dict({"parts": {"g": raw}}, "test", "test"), "test")[0]["g"]
    assert part.density == 1.1


GEAR = '[parts.g]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 23\n'
EXPORT = '[[exports]]\nformat = "svg"\n'
SET = '[[assemblies]]\nkind = "planetary_set"\nteeth = [24, 24, 72]\n'


@pytest.mark.parametrize(
    ("scene", "key", "meant"),
    [
        (f'{GEAR}material = "plywod 3 mm"\n', "parts.g.material", "plywood"),
        (f'{GEAR}material = "фанэра"\n', "parts.g.material", "фанера"),
        (f'{GEAR}material = "qwx"\n', "parts.g.material", ""),
        # 0.45 % of carbon (GOST 1050), and no cast steel
        (f'{GEAR}material = "45"\n', "parts.g.material", "steel 45"),
        (f'{GEAR}material = "65"\n', "parts.g.material", "steel 65"),
        # today another language is told
        (f'{GEAR}material = {{ en = "plywood", uk = "фанэра" }}\n', "parts.g.material.uk", "фанера"),
        (f'[defaults]\nmaterial = "stel"\n{GEAR}', "parts.g: defaults.material", "steel"),
        (f'{SET}material = "petgg"\n', "material", "PETG"),
        # the density of others is not this one's
        (f'[defaults]\ndensity = 1.1\n{GEAR}material = "wod"\n', "parts.g.material", "wood"),
    ],
)
def test_an_unknown_material_is_refused_with_the_names_that_are_known(
    scene: str, key: str, meant: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "s.toml"
    file.write_text(scene + EXPORT, encoding="utf-8")
    assert run("build", file, "--out", tmp_path / "out") == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert f"{key} = " in line
    assert f"did you mean {meant}?" in line if meant else "did you mean" not in line
    assert "`density`" in line
    assert "higherpair list" in line
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ('material = "plywood 3 mm"', (3.0, 10.0)),
        ('material = "фанера 3,5мм"', (3.5, 10.0)),
        ('material = "plywood 3 mm"\nface_width = 3.0', None),
        ('material = "plywood 3 mm"\n[boards.b]\nwidth = 600.0\nheight = 400.0\nthickness = 3.0', None),
        ('material = "plywood 3 mm"\n[boards.b]\nwidth = 600.0\nheight = 400.0\nthickness = 4.0', (3.0, 4.0)),
        # what a rod or a bar is, and what is no sheet of one thickness
        ('material = "steel Ø60 mm"', None),
        ('material = "steel 60x60 mm"', None),
        ('material = "steel \u2300 60 mm"', None),
        ('material = "steel 60 x 60 mm"', None),
        ('material = "plywood 3 mm"\nhub = { diameter = 20.0, above = 5.0 }', None),
    ],
)
def test_a_material_that_tells_another_thickness_is_noted(
    keys: str, told: tuple[float, float] | None, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "s.toml"
    file.write_text(f"{GEAR}{keys}\n{EXPORT}", encoding="utf-8")
    assert run("build", file, "--out", tmp_path / "out") == 0
    notes = [line for line in capsys.readouterr().out.splitlines() if "its material says" in line]
    assert len(notes) == (told is not None)
    if told is not None:
        assert "{:g} mm, it is {:g} mm thick: `face_width`".format(*told) in notes[0]


@pytest.mark.parametrize(
    "scene",
    [
        f'{GEAR}material = "unobtainium"\ndensity = 1.1\n',
        f'[defaults]\nmaterial = "unobtainium"\ndensity = 1.1\n{GEAR}',
        f'{SET}material = "unobtainium"\ndensity = 1.1\n',
    ],
)
def test_a_density_of_one_s_own_allows_any_name(scene: str, tmp_path: Path) -> None:
    file = tmp_path / "s.toml"
    file.write_text(scene + EXPORT, encoding="utf-8")
    parts = load_scene(str(file)).parts.values()
    assert {(part.material, part.density) for part in parts if part.material} == {("unobtainium", 1.1)}


def test_the_list_has_every_material(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("list") == 0
    told = capsys.readouterr().out
    assert all(name in told for name in DENSITIES)


def test_a_known_material_is_told_in_the_language_of_the_drawing() -> None:
    """Name and mm are translated: what else the user wrote stays, as does what nobody knows."""
    pairs = {"plywood 3 mm": "фанера 3 мм", "stainless steel 40Х": "нержавна сталь 40Х", "Steel": "сталь", "PLA": "PLA"}
    for given, told in {**pairs, "unobtainium": "unobtainium"}.items():
        assert material_told(given, words("uk")) == told
        assert material_told(given, words("en")) == given
    assert not material_told(None, words("uk"))


# marks of a family, and what any of them weighs, g/cm^3
FAMILIES = {
    r"AISI (1|4140|5|8)|C\d\d$|S\d{3}|\d\d(Х(?!1[3-8])|Г)|Ст": (7.65, 7.95),
    r"1\.4|AISI [34]|\d\d(Х1[3-8])": (7.6, 8.05),
    r"GJ|СЧ|ВЧ|КЧ": (6.7, 7.45),
    r"AW-|АМ|АД|Д\d|В95|АК|[267]\d{3}-T": (2.63, 2.86),
    r"CuZn|CW|C36|Л": (8.3, 8.95),
    r"CuSn|CuAl|Бр": (7.4, 9.15),
    r"Ti|ВТ": (4.4, 4.52),
    r"PA\d|ПА|POM|PE|PP|ABS|PLA|PC|PMMA|HIPS|TPU": (0.9, 1.45),
}


def test_marks_of_a_family_weigh_alike() -> None:
    """A digit that is missed, or a mark in the wrong row, stands out."""
    for pattern, (least, most) in FAMILIES.items():
        found = {m: d for m, d in DENSITIES.items() if re.match(pattern, m) and not m.startswith("PEEK")}
        assert len(found) >= 3, pattern
        assert {m: d for m, d in found.items() if not least <= d <= most} == {}

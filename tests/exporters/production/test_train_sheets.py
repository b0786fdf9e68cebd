"""Sheets of trains: ratios read off the written files, for all schemes of figure 2.1; spoiled lines are seen."""

from __future__ import annotations

import re
import tomllib
from fractions import Fraction
from itertools import pairwise
from pathlib import Path

import ezdxf
import pytest

from exporters.drawings.sheets import write_sheets
from exporters.drawings.verify import verify_sheets
from exporters.production.build import build
from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.drawing.choice import Asked
from parts.mates.sheets.train_picture import Link, Rim, TrainPicture
from parts.mates.sheets.train_sheet import train_sheet
from parts.scene.files import built_in_scenes
from parts.scene.load import scene_from_dict, scene_from_toml
from tests.parts.scene.test_trains import DRIVE, FREE, GEAR, JAMES

SHEET = '[[exports]]\nformat = "sheet"\npurpose = "train"\n'


def double(teeth: tuple[int, int, int, int], inner: tuple[bool, bool]) -> tuple[TrainPicture, Fraction]:
    """A set z1, z2-z2', z3 with its last wheel held, and u_1H by (3), (4) of seed 001."""
    z1, z2, z2b, z3 = teeth
    carried = Fraction(z2, z1) * (1 if inner[0] else -1) * Fraction(z3, z2b) * (1 if inner[1] else -1)
    ratio = 1 - carried
    rate = 1 / ratio
    planet = rate + (1 - rate) * Fraction(z1, z2) * (1 if inner[0] else -1)
    axis = abs(z1 - z2 if inner[0] else z1 + z2)
    links = (Link("1", 0, Fraction(1)), Link("2", axis, planet, 3), Link("3", 0, Fraction(0)), Link("H", 0, rate))
    rims = (Rim("1", 0, z1, 0, inner[0]), Rim("2", 1, z2), Rim("2'", 1, z2b, 1), Rim("3", 2, z3, 1, inner[1]))
    return TrainPicture(links, rims, ((0, 1), (3, 2))), ratio


def lines(file: Path, layer: str) -> list[tuple[complex, complex]]:
    space = ezdxf.readfile(file).modelspace()
    return [
        (complex(x.dxf.start.x, x.dxf.start.y), complex(x.dxf.end.x, x.dxf.end.y))
        for x in space.query(f'LINE[layer=="{layer}"]')
    ]


def ratios(file: Path) -> tuple[float, float]:
    """u_1H off the plan of velocities by p a / p c (section 4 of seed 001) and off that of angular ones by O1 / OH."""
    fan = lines(file, "ANGULAR_VELOCITY")
    (pole,) = {round(a.real, 9) for a, _ in fan}
    first, last = lines(file, "VELOCITY")[0], lines(file, "VELOCITY")[-1]
    slopes = [(b - a).real / (b - a).imag for a, b in (first, last)]
    return slopes[0] / slopes[1], (fan[0][1].real - pole) / (fan[-1][1].real - pole)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("language", ["en", "uk"])
def test_the_ratio_of_james_is_read_off_the_written_file(tmp_path: Path, language: str) -> None:
    """40/40/120 (seed 001, figure 5): 4.000 within 0.1 %."""
    text = f'[scene]\nlanguage = "{language}"\n' + JAMES + DRIVE.format("sun", "turns = 4.0") + SHEET
    plan = plan_build(scene_from_toml(text.encode(), "james.toml", "james"), "james", [], [])
    built = build(plan, tmp_path)
    assert built.well
    assert ratios(tmp_path / "james.train.dxf") == pytest.approx((4.0, 4.0), rel=1e-9)
    # the pitch point of the held ring stands still: it has no vector
    assert all(abs(b - a) > 0.1 for a, b in lines(tmp_path / "james.train.dxf", "DIMENSION"))
    measured = {w.file.name: w.measured for w in built.written}
    for file in ("james.train.dxf", "james.train.svg"):
        assert measured[file]["ratio_1_H_by_velocity"] == pytest.approx(4.0, rel=1e-7)
        assert measured[file]["ratio_1_2_by_angular_velocity"] == pytest.approx(-2.0, rel=1e-7)
    words = (tmp_path / "james.train.svg").read_text(encoding="utf-8")
    assert bool(re.search("[а-яіїє]", words)) == (language == "uk")
    for word in ("1 (z = 40)", "2 (z = 40)", "3 (z = 120)", ">H<", ">p<", ">a<", ">b<", ">ω<"):
        assert word in words


def test_the_held_link_stands_among_what_is_given_before_what_follows_from_it() -> None:
    """Its number stood in the column of symbols, after a ratio that holds only where it is held."""
    sheet = train_sheet("set", double((40, 20, 30, 90), (False, True))[0], ["a", "b", "c", "d"], Asked("en", 1e-6))
    texts = {text.text: text.box for text in sheet.canvas.texts}
    held, ratio = texts["held link"], next(box for name, box in texts.items() if name.startswith("ratio"))
    row = {name: box for name, box in texts.items() if abs(box.low - held.low) < 1e-6}
    teeth = texts["a: number of teeth"]
    assert teeth.low > held.low > ratio.low
    value = next(box for name, box in texts.items() if name == "40" and abs(box.low - teeth.low) < 1e-6)
    assert [box.left for name, box in row.items() if name == "3"] == [pytest.approx(value.left)]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("teeth", "inner"),
    [
        ((40, 20, 30, 90), (False, True)),
        ((50, 30, 20, 60), (False, False)),
        ((100, 40, 30, 90), (True, True)),
        ((100, 101, 99, 100), (False, False)),
    ],
)
def test_the_schemes_of_figure_2_1(tmp_path: Path, teeth: tuple[int, int, int, int], inner: tuple[bool, bool]) -> None:
    picture, ratio = double(teeth, inner)
    for band, language in ((0.0, "en"), (55.0, "uk")):
        sheet = train_sheet("set", picture, ["sun", "planet", "planet", "ring"], Asked(language, 1e-6, band))
        for ending in ("dxf", "svg"):
            file = tmp_path / f"set.{ending}"
            write_sheets(file, [sheet.canvas], "set")
            assert verify_sheets(file, [sheet], 0.0).failures == ()
        assert ratios(tmp_path / "set.dxf") == pytest.approx((float(ratio), float(ratio)), rel=1e-6)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("layer", ["VELOCITY", "ANGULAR_VELOCITY"])
@pytest.mark.parametrize("index", [0, 1, -1])
def test_a_line_that_is_off_is_seen(tmp_path: Path, layer: str, index: int) -> None:
    sheet = train_sheet("set", double((50, 30, 20, 60), (False, False))[0], ["a", "b", "c", "d"], Asked("en", 1e-6))
    file = tmp_path / "set.dxf"
    write_sheets(file, [sheet.canvas], "set")
    drawing = ezdxf.readfile(file)
    line = list(drawing.modelspace().query(f'LINE[layer=="{layer}"]'))[index]
    line.dxf.end = line.dxf.end + ezdxf.math.Vec3(0.01, 0, 0)
    drawing.saveas(file)
    assert any(layer in text for text in verify_sheets(file, [sheet], 1e-6).failures)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("driver", "distances", "ratios"),
    [
        ("a", (50.0, 70.0), {"12": "\N{MINUS SIGN}1.5", "13": "2"}),
        ("c", (70.0, 50.0), {"12": "\N{MINUS SIGN}0.75", "13": "0.5"}),
    ],
)
def test_axes_stand_apart_as_the_gears_do_and_every_ratio_is_told(
    tmp_path: Path, driver: str, distances: tuple[float, float], ratios: dict[str, str]
) -> None:
    """m (z1 + z2) / 2 on paper 1:1; u12 = -z2/z1, u13 = z3/z1 of 20, 30, 40 teeth."""
    teeth = {"a": 20, "b": 30, "c": 40}
    raw = {
        "parts": {key: {"kind": "spur_gear", "module": 2.0, "number_of_teeth": z} for key, z in teeth.items()},
        "mates": [{"kind": "external_gear_pair", "first": one, "second": two} for one, two in ("ab", "bc")],
        "drives": [{"instance": driver, "turns": 1.0}],
        "exports": [{"format": "sheet", "purpose": "train", "scale": "1:1"}],
    }
    assert build(plan_build(scene_from_dict(raw, "row", "row"), "row", [], []), tmp_path).well
    heights = sorted({round(a.imag, 6) for a, b in lines(tmp_path / "row.train.dxf", "CENTRE") if a.imag == b.imag})
    assert [high - low for low, high in pairwise(heights)] == pytest.approx(distances)
    texts = [text.dxf.text for text in ezdxf.readfile(tmp_path / "row.train.dxf").modelspace().query("TEXT")]
    assert {texts[k + 1]: texts[k + 2] for k, text in enumerate(texts) if text == "u"} == ratios
    assert texts[texts.index("W") + 1] == "1"


def test_what_no_drive_turns_is_refused() -> None:
    for text in (FREE + SHEET, GEAR.format("a", 20) + '[[drives]]\ninstance = "a"\n' + SHEET):
        with pytest.raises(SceneError) as caught:
            plan_build(scene_from_toml(text.encode(), "s.toml", "s"), "s", [], [])
        assert (caught.value.key, caught.value.code) == ("exports[1].purpose", "shows_driven_gears")


@pytest.mark.parametrize(("scene", "teeth"), [("clock_gears", (60, 8)), ("lantern_pair", (10, 30))])
def test_clock_gears_and_lanterns_are_gears_too(tmp_path: Path, scene: str, teeth: tuple[int, int]) -> None:
    """u12 = -z2/z1."""
    raw = tomllib.loads(built_in_scenes()[scene].read_text(encoding="utf-8"))
    raw["exports"] = [{"format": "sheet", "purpose": "train"}]
    assert build(plan_build(scene_from_dict(raw, "s", "s"), "s", [], []), tmp_path).well
    (file,) = tmp_path.glob("*.train.dxf")
    texts = [text.dxf.text for text in ezdxf.readfile(file).modelspace().query("TEXT")]
    (ratio,) = (float(texts[k + 2].replace("\N{MINUS SIGN}", "-")) for k, text in enumerate(texts) if text == "u")
    assert ratio == pytest.approx(-teeth[1] / teeth[0], rel=1e-5)

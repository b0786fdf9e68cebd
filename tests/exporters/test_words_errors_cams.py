"""Refusals of cams, their frames and sheets that speak Ukrainian: no English sentence, and the reason is told."""

from __future__ import annotations

import re
from typing import Any

import pytest

from exporters.plan import plan_build
from exporters.words_errors import in_ukrainian, piece_in_ukrainian
from exporters.words_errors_more import MEANINGS, MORE
from parts.scene import scene_from_dict
from parts.schema import SceneError
from tests.offered import PHASES, SWING, Raw, cam, english_in, put, scenes

SCENES = scenes()
YOKE, CONJUGATE = SCENES["new yoke_frame"], SCENES["new conjugate_cam"]
UNEQUAL = [PHASES[0] | {"angle_deg": 100.0}, PHASES[1] | {"angle_deg": 80.0}, *PHASES[2:]]
FLAT = {"follower": "flat", "follower_radius": None}


def one(part: Raw, **export: Any) -> Raw:
    return {"parts": {"p": part}, "exports": [{"format": "svg"} | export]}


def refusal(raw: Raw) -> SceneError:
    with pytest.raises(SceneError) as refused:
        plan_build(scene_from_dict(raw, "s", "s"), "s", [], [])
    return refused.value


def frame(key: str, value: Any) -> Raw:
    return put(YOKE, ("parts", "gear", key), value)


# what strangers met in English, with Ukrainian words that the refusal must hold
MET: dict[str, tuple[Raw, str]] = {
    "offset": (one(cam(follower_offset=38.0, base_circle_radius=30.0)), "має лежати в колі теоретичного профілю"),
    "offset to the left": (one(cam(follower_offset=-48.0)), "має лежати в колі теоретичного профілю"),
    "cone": (put(SCENES["barrel"], ("parts", "p"), SCENES["barrel"]["parts"]["p"] | {"roller_form": "conical",
                 "cone_angle_deg": 119.0}), "вершина конуса стоїть вище за дно"),
    "stem": (frame("stem_width", 500.0), "ширше за рамку"),
    "corner": (frame("corner_radius", 90.0), "зрізає стержень"),
    "shaft": (frame("shaft_diameter", 100.0), "зачіпає палець"),
    "of itself": (frame("of", "gear"), "це yoke_frame, а не cam"),
    "unequal": (put(YOKE, ("parts", "source", "phases"), UNEQUAL), "не є кулачком сталої ширини"),
    "conjugate of flat": (
        put(CONJUGATE, ("parts", "source"), {k: v for k, v in CONJUGATE["parts"]["source"].items()
                                             if k != "follower_radius"} | {"follower": "flat"}),
        'має follower = "flat"; спареному кулачку потрібен ролик'),
    "hub": (one(cam(hub={"diameter": 90.0, "above": 5.0})), "сягає кола западин, 80 мм"),
    "no centre distance": (one(cam(lift=None, swing_deg=20.0, oscillating={"arm_length": 70.0})),
                           "відсутнє: більше за 0"),
    "law": (one(cam(phases=[PHASES[0] | {"law": "cycloid"}, *PHASES[1:]])), "або таблиця"),
    "base circle of 0": (one(cam(base_circle_radius=0.0)), "більше за 0, щонайбільше 100000 мм"),
    "angle of 90": (one(cam(**FLAT, base_circle_radius=None, least_transmission_angle_deg=90.0)),
                    "більше за 0, менше за 90 град"),
    "colour": (one(cam(colour="red")), "колір на малюнках"),
    "file": (one(cam(), name="a/b"), "частина імені файла"),
    "mate": (put(SCENES["external"], ("mates", 0), {"kind": "rack_pair", "first": "a", "second": "b"}),
             "rack_pair з'єднує spur_gear і rack"),
    "meshing of a cam": (one(cam(), format="sheet", purpose="meshing"),
                         'наявні кулачки креслить purpose = "cam"'),
    "undercut": (one(cam(**FLAT, base_circle_radius=5.0)), "мм ходу; підходить щонайменше"),
    "swinging yoke": (put(YOKE, ("parts", "source"), {k: v for k, v in YOKE["parts"]["source"].items() if k != "lift"}
                          | {"swing_deg": 20.0, "oscillating": SWING}), "поступальним штовхачем"),
}  # fmt: skip


@pytest.mark.parametrize(("raw", "words"), MET.values(), ids=MET.keys())
def test_what_strangers_met_is_ukrainian_throughout(raw: Raw, words: str) -> None:
    told = in_ukrainian(refusal(raw).remedy)
    assert words in told
    assert english_in(told) == ""


def test_english_that_is_left_is_seen() -> None:
    assert english_in("це yoke_frame, not a cam")
    assert english_in("втрачає 0.002943 mm of lift")
    assert english_in("default: більше за 0")
    assert english_in("підходить spur_gear and rack")
    assert english_in('одне з: "a", "b"; підходить "sine"') == ""


def test_every_new_pattern_is_ukrainian_and_keeps_its_values() -> None:
    for line in MORE.strip().splitlines():
        en, _, uk = line.partition("|")
        assert re.search("[а-яіїєґ]", uk), line
        assert not re.search("[ыэъё]", uk), line
        assert en.count("{}") == uk.count("{}"), line
        assert piece_in_ukrainian(en.replace("{}", "7")) is not None, line


def test_a_description_gives_way_to_its_range_or_to_its_own_translation() -> None:
    for english, ukrainian in MEANINGS.items():
        assert in_ukrainian(f"{english}; remove it") == f"{ukrainian}; приберіть його"
    told = in_ukrainian("base circle; default: the least by least_transmission_angle_deg: above 0, at most 100000 mm")
    assert told == "більше за 0, щонайбільше 100000 мм"

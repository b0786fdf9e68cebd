"""Chain drives in scenes: links or distance, phases, drives, what is told and refused, the chain in pictures."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

from exporters.production.check import scene_checks
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from tests.exporters.making import run, table, write_scene

Keys = dict[str, Any]
SMALL: Keys = {"kind": "sprocket", "chain": "08B-1", "number_of_teeth": 17}
LARGE = SMALL | {"number_of_teeth": 38}
EXPORTS: tuple[Keys, ...] = (
    {"format": "svg"},
    {"format": "dxf", "purpose": "assembly", "paper": "A2", "scale": "1:2", "tolerance": 0.01},
)
MATE: Keys = {"kind": "chain_drive", "first": "a", "second": "b"}


def placed(mate: Keys, one: Keys = SMALL, two: Keys = LARGE, **more: Any) -> tuple[Placing, dict[str, Any]]:
    """Where both stand, and what the checks say of them."""
    tables = {
        "parts": {"a": one, "b": two},
        "mates": [MATE | mate],
        "drives": [{"instance": "a", "turns": 2.0}],
        **more,
    }
    made = scene_from_dict(tables, "t", "t")
    parts, matings = make_parts(made, "t")
    placing = place(made.instances, made.drives, parts, matings, "t")
    return placing, scene_checks(placing, parts, made.drives, "en", contact=True)


def test_both_turn_the_same_way_and_touch_no_roller_wrongly() -> None:
    placing, checks = placed({"number_of_links": 80, "direction_deg": 20.0})
    assert placing.turns[0] == pytest.approx({"a": 2.0, "b": 2.0 * 17 / 38})
    (mate,) = checks["mates"]
    assert mate["verdict"] == "contact"
    assert mate["findings"] == []
    # by the belt of textbooks 330.66 mm
    assert mate["working_centre_distance"] == pytest.approx(330.639, abs=5e-4)
    back = placed({"centre_distance": mate["working_centre_distance"] - 1e-6})[1]["mates"][0]
    assert back["number_of_links"] == 80
    assert back["chain_slack"] == pytest.approx(2e-6, rel=0.1)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("links", [58, 61, 64, 80, 101])
def test_a_chain_that_gives_its_distance_is_taut(links: int) -> None:
    """``chain -9.02e-14 mm longer than taut`` was told of 61 links."""
    (mate,) = placed({"number_of_links": links})[1]["mates"]
    assert mate["chain_slack"] == 0


@pytest.mark.sampled(2)
@pytest.mark.parametrize("links", [58, 64, 80, 100])
def test_a_distance_as_it_is_told_has_the_chain_that_told_it(links: int) -> None:
    """Of five decimals every second one is rounded up: it had two links more, or was refused."""
    taut = placed({"number_of_links": links})[1]["mates"][0]["working_centre_distance"]
    for told in (round(taut, 5), math.ceil(taut * 1e5) / 1e5):
        for more in ({}, {"number_of_links": links}):
            (mate,) = placed({"centre_distance": told} | more)[1]["mates"]
            assert (mate["number_of_links"], mate["findings"]) == (links, [])
            assert mate["working_centre_distance"] == pytest.approx(taut, abs=6e-6)
    with pytest.raises(SceneError):
        placed({"centre_distance": taut + 3e-5, "number_of_links": links})


@pytest.mark.parametrize("turn", [0.0, 7.0, 100.0])
def test_seats_of_a_second_that_stands_already_must_take_the_rollers(turn: float) -> None:
    there = placed({"number_of_links": 80, "direction_deg": 30.0}, instances={"a": {"rotation_deg": turn}, "b": {}})
    other = next(i for i in there[0].instances if i.id == "b")
    at = [*other.at]
    for off, met in ((0.0, True), (1e-3, False)):
        instances = {"a": {"rotation_deg": turn}, "b": {"at": at, "rotation_deg": math.degrees(other.rotation + off)}}
        (mate,) = placed({"number_of_links": 80}, instances=instances)[1]["mates"]
        assert all(condition["met"] for condition in mate["conditions"]) == met


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("less", "turn"), [(0.0, 0.0), (1.0, 0.0), (1.0, 0.7), (1.0, -0.7)])
def test_rollers_of_pictures_sit_in_the_seats_of_both_as_they_stand(less: float, turn: float) -> None:
    """Of a second turned within its play (0.75 degrees) too, and while both turn by the mean ratio, as drives do."""
    distance = 330.63882 - less
    one, two = placed({"centre_distance": distance})[0].instances
    instances = {"a": {}, "b": {"at": [*two.at], "rotation_deg": math.degrees(two.rotation) + turn}}
    placing, checks = placed({"centre_distance": distance}, instances=instances)
    (mate,) = placing.mates
    assert checks["mates"][0]["conditions"][1]["met"]
    radii = [12.7 / 2 / math.sin(math.pi / z) for z in (17, 38)]
    for turned in (0.0, 0.05, 0.17, 0.3):
        found = mate.rollers(turned)
        assert found is not None
        # in the middle of a strand that is taut links are longer by what the ratio is off its mean
        assert abs(found[0] - np.roll(found[0], 1)) == pytest.approx(12.7, abs=2e-3)
        stands = (one.centre, mate.first.rotation + turned), (two.centre, mate.second.rotation + turned * 17 / 38)
        for (centre, rotation), radius, z in zip(stands, radii, (17, 38), strict=True):
            seated = found[0][np.abs(np.abs(found[0] - centre) - radius) < 1e-6] - centre
            assert len(seated) >= z // 2 - 1
            off = np.angle(seated * np.exp(-1j * rotation)) * z / (2 * math.pi) - 0.5
            assert np.abs(off - np.round(off)).max() * 2 * math.pi * radius / z < 1e-6


@pytest.mark.parametrize(
    ("mate", "two", "key", "cure"),
    [
        ({}, LARGE, "mates[1].number_of_links", None),
        # tips of 74.3 and 159.3 mm: 2 a / p + 27.5 + 11.2 p / a = 47.1 links where they touch
        ({"number_of_links": 30}, LARGE, "mates[1].number_of_links", 48),
        ({"centre_distance": 110.0}, LARGE, "mates[1].centre_distance", None),
        ({"centre_distance": 1e6}, LARGE, "mates[1].centre_distance", 63325.347),
        ({"number_of_links": 80, "centre_distance": 335.0}, LARGE, "mates[1].centre_distance", 330.638823),
        ({"number_of_links": 90, "centre_distance": 330.0}, LARGE, "mates[1].number_of_links", 80),
        ({"number_of_links": 80}, LARGE | {"chain": "081"}, "mates[1]: parts.b.roller_diameter", None),
        ({"number_of_links": 80}, LARGE | {"chain": "08B-2"}, "mates[1]: parts.b.strands", None),
    ],
)
def test_drives_that_cannot_be_are_refused_with_what_works(mate: Keys, two: Keys, key: str, cure: float | None) -> None:
    with pytest.raises(SceneError) as refused:
        placed(mate, two=two)
    assert refused.value.key == key
    if cure is not None:
        assert refused.value.nearest is not None
        assert refused.value.nearest.value == pytest.approx(cure)
        placed(mate | {key.rpartition(".")[2]: refused.value.nearest.value}, two=two)


def test_rows_of_both_stand_as_far_apart() -> None:
    """Those of 2ПР-19,05-72 do not: as it was, one chain was told to go into rows 22.78 and 25.5 mm apart."""
    one, two = SMALL | {"chain": "2ПР-19,05-64"}, LARGE | {"chain": "2ПР-19,05-72"}
    with pytest.raises(SceneError) as refused:
        placed({"number_of_links": 80}, one, two)
    assert (refused.value.key, refused.value.code) == ("mates[1]: parts.b.transverse_pitch", "not_of_the_chain")
    placed({"number_of_links": 80}, one, two | {"chain": "12A-2"})


def test_a_row_of_teeth_takes_one_chain() -> None:
    """As it was: both lay in one plane, across each other. A sprocket of its own on the same shaft takes the other."""
    parts = {"a": {}, "b": {}, "c": {"part": "a"}, "d": {"part": "b"}}
    chains = [MATE | {"number_of_links": 80}, MATE | {"first": "b", "second": "c", "number_of_links": 70}]
    with pytest.raises(SceneError) as refused:
        placed({}, two=SMALL, instances=parts, mates=chains)
    assert (refused.value.key, refused.value.code) == ("mates[2].first", "teeth_are_taken")
    beside = {"kind": "fixed", "first": "b", "second": "d", "offset": [0.0, 0.0, 20.0]}
    mates = [chains[0], beside, chains[1] | {"first": "d"}]
    assert placed({}, two=SMALL, instances=parts, mates=mates)[0].turns[0]["c"] == pytest.approx(2.0)


def test_pictures_show_every_roller_and_drawings_the_pitch_line(tmp_path: Path) -> None:
    mate = table("[[mates]]", MATE | {"number_of_links": 80})
    mate += table("[instances.a]", {"rotation_deg": 180 / 17}) + "[instances.b]\n"
    scene = write_scene(tmp_path / "s.toml", {"a": SMALL, "b": LARGE}, EXPORTS, mate)
    assert run("build", scene, "--out", tmp_path / "out", "--no-verify") == 0
    assert (tmp_path / "out" / "s" / "s.preview.svg").read_text("utf-8").count("<circle") == 80
    # a link of the first lies on the line of centres: at that stand both strands are taut, whole links of 12.7 mm long
    drawing = ezdxf.readfile(tmp_path / "out" / "s" / "s.assembly.dxf")
    lines = drawing.modelspace().query('LINE[layer=="CENTRE"]')
    links = [drawing.header["$DIMLFAC"] * line.dxf.start.distance(line.dxf.end) / 12.7 for line in lines]
    assert [n for n in links if n > 10] == pytest.approx([26.0, 26.0], abs=1e-5)

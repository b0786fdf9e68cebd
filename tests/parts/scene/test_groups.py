"""Groups: ``count`` instances about an axis, and mates that run for each of them."""

from __future__ import annotations

import cmath
import math
import tomllib
from typing import Any

import pytest

from exporters.command.cli import main
from parts.base.refusal import SceneError
from parts.scene.files import built_in_scenes
from parts.scene.load import load_scene, resolved, scene_from_dict
from parts.scene.scene_file import SceneFile

WHEEL = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}


def scene(instances: dict[str, Any], *mates: dict[str, Any]) -> SceneFile:
    parts = {"sun": WHEEL, "planet": WHEEL}
    return scene_from_dict({"parts": parts, "instances": instances, "mates": list(mates)}, "t", "t")


def test_a_group_of_pins_is_what_twelve_tables_and_twelve_mates_are() -> None:
    raw = tomllib.loads(built_in_scenes()["cycloidal_reducer"].read_text("utf-8"))
    assert raw["instances"].pop("pin") == {"part": "ring_pin", "count": 12}
    assert raw["mates"].pop()["kind"] == "pin_seat"
    for number in range(1, 13):
        raw["instances"][f"pin_{number}"] = {"part": "ring_pin"}
        raw["mates"].append({"kind": "pin_seat", "first": "ring", "second": f"pin_{number}", "number": number})
    by_hand = scene_from_dict(raw, "t", "cycloidal_reducer")
    assert resolved(by_hand) == resolved(load_scene("cycloidal_reducer"))


def test_members_stand_about_their_axis() -> None:
    made = scene({"planet": {"count": 5, "at": [13.0, 4.0, 2.0], "about": [3.0, 4.0], "rotation_deg": 7.0}}).instances
    for k in range(5):
        at = made[f"planet_{k + 1}"].at
        assert at is not None
        assert at[2] == 2.0
        assert abs(complex(*at[:2]) - (3 + 4j) - cmath.rect(10.0, k * 2 * math.pi / 5)) < 1e-14
        assert made[f"planet_{k + 1}"].rotation_deg == 7.0 + 72.0 * k
    stepped = scene({"planet": {"count": 2, "at": [1.0, 0.0, 0.0], "step_deg": 90.0}}).instances
    assert stepped["planet_2"].at == pytest.approx([0.0, 1.0, 0.0], abs=1e-15)


def test_mates_go_on_with_the_members() -> None:
    group = {"planet": {"count": 4}, "pin": {"part": "planet", "count": 4}}
    mesh = {"kind": "external_gear_pair", "first": "sun", "second": "planet", "direction_deg": 30.0}
    fixed = {"kind": "fixed", "first": "planet", "second": "pin", "offset": [1.0, 0.0, 2.0]}
    about = {"kind": "fixed", "first": "sun", "second": "pin", "offset": [1.0, 0.0, 2.0], "rotation_deg": 5.0}
    mates = scene(group, mesh, fixed, about).mates
    assert [m.direction_deg for m in mates[:4]] == [30.0, 120.0, 210.0, 300.0]
    assert [(m.first, m.second, m.offset) for m in mates[4:8]] == [
        (f"planet_{k}", f"pin_{k}", (1.0, 0.0, 2.0)) for k in (1, 2, 3, 4)
    ]
    assert mates[9].offset == pytest.approx((0.0, 1.0, 2.0))
    assert mates[9].rotation_deg == 95.0


@pytest.mark.parametrize(
    ("instances", "mates", "place", "code"),
    [
        ({"planet": {"about": [0.0, 0.0]}}, [], "instances.planet.about", "only_of_a_count"),
        ({"planet": {"step_deg": 9.0}}, [], "instances.planet.step_deg", "only_of_a_count"),
        ({"planet": {"count": 3, "about": [1.0, 0.0]}}, [], "instances.planet.about", "about_needs_at"),
        ({"planet": {"count": 0}}, [], "instances.planet.count", "not_allowed"),
        ({"planet": {"count": 2}, "planet_2": {"part": "sun"}}, [], "instances.planet_2", "is_a_member"),
        ({"planet_2": {"part": "sun"}, "planet": {"count": 2}}, [], "instances.planet_2", "is_a_member"),
        ({"x" * 63: {"part": "sun", "count": 2}}, [], f"instances.{'x' * 63}", "not_a_name"),
        (
            {"planet": {"count": 2}, "sun": {"count": 3}},
            [{"kind": "fixed", "first": "sun", "second": "planet"}],
            "mates[1].second",
            "groups_differ",
        ),
    ],
)
def test_what_is_no_group_is_refused(
    instances: dict[str, Any], mates: list[dict[str, Any]], place: str, code: str
) -> None:
    with pytest.raises(SceneError) as refusal:
        scene(instances, *mates)
    assert (refusal.value.key, refusal.value.code) == (place, code)


def test_a_refusal_of_a_member_stands_at_the_mate_of_the_file(tmp_path: Any, capsys: Any) -> None:
    text = built_in_scenes()["cycloidal_reducer"].read_text("utf-8").replace("count = 12", "count = 13")
    (tmp_path / "many.toml").write_text(text)
    assert main(["check", str(tmp_path / "many.toml")]) == 2
    assert "many.toml: mates[10].number = 13: " in capsys.readouterr().err

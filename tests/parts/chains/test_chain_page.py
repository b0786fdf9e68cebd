"""``higherpair calc chain``: a worked example of a textbook, speeds and forces by the motion of the pins."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.documents.topics import calculate
from parts.base.refusal import SceneError
from tests.exporters.making import table, write_scene


def values(*words: str) -> dict[str, Any]:
    """What the page tells, by name."""
    found: dict[str, Any] = json.loads(calculate("chain", list(words), "json", "en"))["values"]
    return found


DRIVE = ("chain=08B-1", "number_of_teeth=17", "mate_number_of_teeth=38")


def test_speeds_and_forces_are_those_of_the_pins() -> None:
    found = values(*DRIVE, "number_of_links=80", "speed_rpm=300", "power=1500")
    # while the sprocket turns by a pitch the seated pin moves the strand by r sin(angle)
    radius, omega = 12.7 / (2 * math.sin(math.pi / 17)), math.pi * 300 / 30
    angle = np.linspace(-math.pi / 17, math.pi / 17, 20_001)
    speed = np.gradient(radius * np.sin(angle), angle) * omega / 1000
    assert found["greatest_chain_speed"] == pytest.approx(speed.max(), rel=1e-6)
    assert found["least_chain_speed"] == pytest.approx(speed[1:-1].min(), rel=1e-4)
    mean = 2 * radius * math.sin(math.pi / 17) / (2 * math.pi / 17 / omega) / 1000
    assert found["chain_speed"] == pytest.approx(mean, rel=1e-12)
    # Shigley's diagram of chordal speed variation has 1.7 per cent at 17 teeth
    assert found["chain_irregularity"] == pytest.approx(0.017, abs=5e-4)
    assert found["gear_speed"]["second"] == pytest.approx(300 * 17 / 38)
    # the strand's arm is r cos(angle): its pull, weighed by the chain that passes, is the power by the mean speed
    pull = 1500 / omega / (radius / 1000 * np.cos(angle))
    assert found["chain_force"] == pytest.approx(np.average(pull, weights=np.cos(angle)), rel=1e-6)
    assert found["chain_force"] * found["chain_speed"] == pytest.approx(1500.0, rel=1e-12)
    assert found["chain_safety"] == pytest.approx(17_800 / found["chain_force"])
    two = values("chain=2ПР-25,4-114", *DRIVE[1:], "number_of_links=80", "torque=90")
    assert two["chain_breaking_load"] == pytest.approx(114_000)
    # Dunaev, Lelikov: a drive that lies loads its shafts by 1.15 of the force; Sheinblit: mounted 0.5 % nearer
    assert found["chain_shaft_load"] == pytest.approx(1.15 * found["chain_force"])
    assert found["mounting_chain_distance"] == pytest.approx(0.995 * found["exact_chain_distance"])


def test_links_of_a_distance_are_those_of_textbooks() -> None:
    """Jindal, Machine Design, example 30-1: 17 and 51 teeth, p = 9.52 mm, 300 mm apart: 98 links by its formula."""
    found = values("pitch=9.52", "roller_diameter=6.35", "face_width=5", "number_of_teeth=17",
     "mate_number_of_teeth=51",
                   "centre_distance=300")  # fmt: skip
    assert found["textbook_links"] == pytest.approx(2 * 300 / 9.52 + 34 + (34 / (2 * math.pi)) ** 2 * 9.52 / 300)
    assert found["number_of_links"] == 98
    assert found["textbook_chain_distance"] > found["exact_chain_distance"] > 300
    assert found["chain_slack"] == pytest.approx(2 * (found["exact_chain_distance"] - 300), rel=0.05)


def test_the_second_sprocket_has_its_own_tip_diameter(tmp_path: Path) -> None:
    found = values(*DRIVE, "number_of_links=80", "tip_diameter=73", "mate_tip_diameter=160")
    assert found["chain_tip_diameter"] == {"first": 73.0, "second": 160.0}
    parts = {"a": {"kind": "sprocket", "chain": "08B-1", "number_of_teeth": 17}}
    parts["b"] = parts["a"] | {"number_of_teeth": 38, "tip_diameter": 160.0}
    mate = table("[[mates]]", {"kind": "chain_drive", "first": "a", "second": "b", "number_of_links": 80})
    scene = write_scene(tmp_path / "s.toml", parts, [{"format": "dxf"}], mate)
    assert values(str(scene))["chain_tip_diameter"]["second"] == 160.0
    with pytest.raises(SceneError) as refused:
        values(*DRIVE, "number_of_links=80", "mate_tip_diameter=170")
    assert refused.value.key == "chain.mate_tip_diameter"


@pytest.mark.parametrize(
    ("first", "second"),
    [
        ({}, {"tooth_form": "GOST 591", "displaced": True}),
        ({"tooth_form": "GOST 591"}, {"tooth_form": "ANSI B29.1"}),
        ({"tooth_form": "ANSI B29.1"}, {"form": 1.0}),
        ({"form": 0.25}, {"form": 0.75}),
        # what only the first one's standard has is none of the second's
        ({"form": 0.25}, {"tooth_form": "GOST 591"}),
        ({"tooth_form": "GOST 591", "displaced": True}, {"tooth_form": "ISO 606"}),
    ],
)
def test_the_second_sprocket_of_a_scene_has_its_own_tooth_form(
    first: dict[str, object], second: dict[str, object], tmp_path: Path
) -> None:
    """As each is told by itself: the second had the form of the first, over pins 0.14 mm less by GOST 591."""
    of = {"a": {"number_of_teeth": 17, **first}, "b": {"number_of_teeth": 38, **second}}
    parts = {name: {"kind": "sprocket", "chain": "08B-1", **keys} for name, keys in of.items()}
    mate = table("[[mates]]", {"kind": "chain_drive", "first": "a", "second": "b", "number_of_links": 80})
    found = values(str(write_scene(tmp_path / "s.toml", parts, [{"format": "dxf"}], mate)))
    for part, end in zip(parts, ("first", "second"), strict=True):
        typed = [f"{key}={json.dumps(value)}" for key, value in {"chain": "08B-1", **of[part]}.items()]
        alone = json.loads(calculate("sprocket", typed, "json", "en"))["values"]
        for name in ("chain_tip_diameter", "chain_root_diameter", "sprocket_over_pins"):
            assert found[name][end] == pytest.approx(alone[name], rel=1e-12), (name, end)


def test_what_only_the_standard_of_the_first_has_is_none_of_the_seconds() -> None:
    """Form 0.25 of ISO 606 was asked of GOST 591, where nothing was said of the second's."""
    drive = ("chain=08B-1", "number_of_teeth=17", "form=0.25", "mate_number_of_teeth=38", "number_of_links=80")
    found = values(*drive, "mate_tooth_form=GOST 591")
    alone = json.loads(
        calculate("sprocket", ["chain=08B-1", "number_of_teeth=38", "tooth_form=GOST 591"], "json", "en")
    )
    assert found["sprocket_over_pins"]["second"] == pytest.approx(alone["values"]["sprocket_over_pins"], rel=1e-12)


def test_a_scene_gives_its_drive() -> None:
    found = values("chain_drive", "part=pinion")
    assert found["number_of_links"] == 80
    with pytest.raises(SceneError, match="add part=ID"):
        values("chain_drive")
    with pytest.raises(SceneError, match="centre_distance"):
        values(*DRIVE)

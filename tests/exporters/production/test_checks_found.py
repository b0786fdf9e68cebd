"""What ``check`` finds as data: fits of seats, where drives have come as solids meet, and how pairs are told."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.production.check import check_pair, scene_checks
from parts.base.part import Part
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from tests.exporters.making import run, table


def turned(*points: tuple[float, float]) -> dict[str, Any]:
    return {"kind": "turned", "points": [{"r": r, "z": z} for r, z in points]}


def ring(bore: float) -> dict[str, Any]:
    return turned((bore, 0.0), (9.0, 0.0), (9.0, 6.0), (bore, 6.0))


def pin(radius: float) -> dict[str, Any]:
    return turned((0.0, 0.0), (radius, 0.0), (radius, 6.0), (0.0, 6.0))


PLATE = {"kind": "plate", "width": 20.0, "height": 10.0, "face_width": 3.0}
Raw = dict[str, Any]


def checked(raw: Raw, folder: Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, dict[str, Any]]:
    """Exit code and findings of the command."""
    text = "".join(table(f"[{n}.{key}]", keys) for n in ("parts", "instances") for key, keys in raw.get(n, {}).items())
    text += "".join(table(f"[[{n}]]", row) for n in ("mates", "drives") for row in raw.get(n, ()))
    text += table("[checks]", raw["checks"]) if "checks" in raw else ""
    (folder / "s.toml").write_text(text, encoding="utf-8")
    code = run("check", folder / "s.toml", "--json")
    return code, json.loads(capsys.readouterr().out)


def made(raw: Raw) -> tuple[Any, dict[str, Part], Placing]:
    scene = scene_from_dict(raw, "t", "t")
    parts, matings = make_parts(scene, "t")
    return scene, parts, place(scene.instances, scene.drives, parts, matings, "t")


def test_seats_are_told_by_their_parts_with_their_clearances(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Two pins of 4.9 and one of 5 in rings of 5 mm, one of 4.7 in a ring of 4.95; 1 mm of room is no seat.

    Nor do pins sit in each other that stand one on the other, 0 and 0.1 mm above its 6 mm.
    """
    parts = {"ring": ring(5.0), "other": ring(4.95), "loose": pin(4.9), "tight": pin(5.0), "slack": pin(4.7),
             "far": pin(4.0), "lid": pin(3.0), "turner": PLATE}  # fmt: skip
    at = {"ring_1": ("ring", 0), "loose_1": ("loose", 0), "ring_2": ("ring", 40), "loose_2": ("loose", 40),
          "ring_3": ("ring", 80), "tight_1": ("tight", 80), "other_1": ("other", 120), "slack_1": ("slack", 120),
          "ring_4": ("ring", 160), "far_1": ("far", 160)}  # fmt: skip
    stand = {key: {"part": part, "at": [x, 0.0, 0.0]} for key, (part, x) in at.items()}
    for x, height in ((200.0, 6.0), (240.0, 6.1)):
        stand |= {f"below_{x:g}": {"part": "far", "at": [x, 0.0, 0.0]}}
        stand |= {f"above_{x:g}": {"part": "lid", "at": [x, 0.0, height]}}
    raw = {
        "parts": parts, "instances": stand | {"turner": {"at": [0.0, 100.0, 0.0]}},
        "drives": [{"instance": "turner"}], "checks": {"workspace": 20},
    }  # fmt: skip
    code, found = checked(raw, tmp_path, capsys)
    assert code == 0
    fits = {tuple(sorted(row["parts"])): row for row in found["workspace"]["fits"]}
    assert {key: (row["pairs"], row["touching"]) for key, row in fits.items()} == {
        ("loose", "ring"): (2, 0), ("ring", "tight"): (1, 1), ("other", "slack"): (1, 0)
    }  # fmt: skip
    for key, gap in ((("loose", "ring"), 0.1), (("ring", "tight"), 0.0), (("other", "slack"), 0.25)):
        assert (fits[key]["least"], fits[key]["greatest"]) == pytest.approx((gap, gap), abs=1e-9)


RACK = {"kind": "rack", "module": 2.0, "number_of_teeth": 10, "face_width": 5.0}
PINION = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 5.0}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("travel", [12.0, -12.0])
def test_a_rack_that_runs_into_a_post_tells_how_far_it_has_travelled(
    travel: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A post of 4 mm stands 5 mm before its end, on its back: it is met from 5 mm on."""
    raw: Raw = {
        "parts": {"rack": RACK, "pinion": PINION, "post": {"kind": "pin", "diameter": 4.0, "length": 5.0}},
        "mates": [{"kind": "rack_pair", "first": "pinion", "second": "rack"}],
        "drives": [{"instance": "rack", "travel": travel}],
    }
    _, parts, placing = made(raw)
    stand = {i.id: i for i in placing.instances}
    rack, pinion = stand["rack"], stand["pinion"]
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 5))
                             for s in parts["rack"].section(0.0).region.outer.segments()])  # fmt: skip
    placed = points * cmath.exp(1j * rack.rotation) + rack.centre
    # along its way, and away from the pinion: the post stands 5 mm beyond its end, well within its back
    way = cmath.exp(1j * rack.rotation) * (1 if travel > 0 else -1)
    back = 1j * way if ((rack.centre - pinion.centre) / way).imag > 0 else -1j * way
    end, deep = ((placed / one).real.max() for one in (way, back))
    at = way * (end + 5.0 + 2.0) + back * (deep - 2.5)
    raw["instances"] = {"post": {"at": [at.real, at.imag, 0.0]}}
    code, found = checked(raw, tmp_path, capsys)
    assert code == 1
    (solid,) = found["solids"]
    assert {solid["first"], solid["second"]} == {"rack", "post"}
    assert solid["verdict"] == "overlap"
    assert 5.0 - 0.02 < abs(solid["drive_travel"]) <= 12.0
    assert solid["drive_travel"] * travel > 0
    assert f"where rack has travelled {solid['drive_travel']:.6g} mm" in solid["text"]
    assert solid["volume"] > 0


def test_pairs_tell_where_they_are_nearest_and_how_far_they_are_driven() -> None:
    """A pitch of 20 teeth is 18 degrees of the first; half a turn of it is 10 of them."""
    raw: Raw = {
        "parts": {"a": PINION, "b": PINION | {"number_of_teeth": 30}, "alone": PLATE},
        "mates": [{"kind": "external_gear_pair", "first": "a", "second": "b", "direction_deg": 30.0}],
        "drives": [{"instance": "a", "turns": -0.5}],
    }
    scene, parts, placing = made(raw)
    names = {"a": "Gear A"}
    found = scene_checks(placing, parts, scene.drives, "en", contact=True, transmission=True, names=names)
    (mate,) = found["mates"]
    assert mate["driven_pitches"] == pytest.approx(10.0)
    assert mate["direction_deg"] == pytest.approx(30.0)
    assert mate["second_rotation_deg"] == pytest.approx(
        next(i.rotation for i in placing.instances if i.id == "b") * 57.29577951308232
    )
    assert mate["verdict"] == "contact"
    assert abs(mate["gap"]) <= mate["tolerance"] == pytest.approx(2e-8)
    assert -1e-12 < mate["gap"] <= mate["greatest_gap"] < 1e-6
    assert abs(mate["drive_angle_deg"]) <= 18.0 + 1e-9
    assert set(mate["transmission_error"]) <= {"clockwise", "counter_clockwise"}
    assert found["in_a_row"] == ["alone"]
    assert found["drives"] == [{"instance": "a", "turns": -0.5, "train": {"a": -0.5, "b": pytest.approx(1 / 3)}}]
    # without contact only what is calculated
    plain = scene_checks(placing, parts, scene.drives, "en", contact=False)["mates"][0]
    assert "verdict" not in plain
    assert "transmission_error" not in plain
    assert plain["kind"] == "external_gear_pair"
    # drawn apart it has the way by the sine of 20 degrees on either flank, in the middle of its play
    mating = placing.mates[0].mating
    apart = check_pair(mating, "en", centre_shift=0.02, tolerance=1e-6)
    assert apart["verdict"] == "clear"
    assert apart["tolerance"] == 1e-6
    assert apart["gap"] == pytest.approx(0.02 * 0.3420201433, rel=0.01)
    near = check_pair(mating, "en", centre_shift=-0.02)
    assert near["verdict"] == "overlap"
    assert near["gap"] < 0


def test_what_stands_by_hand_is_held_within_what_places_are_good_to() -> None:
    """Off by less than 1e-5 mm a pair still stands; what breaks a condition is not held any more."""
    for off, met in ((8e-6, True), (1.2e-5, False)):
        raw: Raw = {
            "parts": {"a": PINION, "b": PINION | {"number_of_teeth": 30}},
            "instances": {"a": {"at": [0.0, 0.0, 0.0]}, "b": {"at": [50.0 + off, 0.0, 0.0], "rotation_deg": 6.0}},
            "mates": [{"kind": "external_gear_pair", "first": "a", "second": "b"}],
        }
        scene, parts, placing = made(raw)
        (mate,) = scene_checks(placing, parts, scene.drives, "en", contact=True, transmission=True,
                               names={"a": "Gear A"})["mates"]  # fmt: skip
        conditions = {c["code"]: c for c in mate["conditions"]}
        assert conditions["centre_distance"]["met"] is met
        assert conditions["centre_distance"]["value"] == pytest.approx(50 + off, abs=1e-9)
        told = conditions["centre_distance"]["required"], conditions["centre_distance"]["tolerance"]
        assert told == (50.0, pytest.approx(1e-5, rel=1e-6))
        assert "the centres of Gear A and b stand" in conditions["centre_distance"]["text"]
        assert ("verdict" in mate) is met
        assert ("transmission_error" in mate) is met
        if met:
            assert mate["tolerance"] == 1e-5


@pytest.mark.sampled(4)
@pytest.mark.parametrize("start", [0, 4])
@pytest.mark.parametrize("turns", [0.04, 0.24, 0.26, -0.24, -0.26, -0.46])
def test_a_rack_that_its_drive_takes_out_of_the_mesh_is_told(
    turns: float, start: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Seen where the drive has ended: whether any of the rack still lies across from the pinion's axis."""
    raw: Raw = {
        "parts": {"rack": RACK, "pinion": PINION},
        "instances": {"rack": {"at": [20.0, 2 * math.pi * start, 0.0], "rotation_deg": 90.0}},
        "mates": [{"kind": "rack_pair", "first": "pinion", "second": "rack"}],
        "drives": [{"instance": "pinion", "turns": turns}],
    }
    _, parts, placing = made(raw)
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 5))
                             for s in parts["rack"].section(0.0).region.outer.segments()])  # fmt: skip
    (rack,) = [i for i in placing.at([turns]) if i.id == "rack"]
    placed = (points * cmath.exp(1j * rack.rotation) + rack.centre).imag
    out = placed.min() > 0 or placed.max() < 0
    code, found = checked(raw, tmp_path, capsys)
    told = [f for f in found["mates"][0]["findings"] if f["code"] == "rack_runs_out"]
    assert (code, bool(told)) == (0, out)
    if told:
        assert told[0]["value"] == pytest.approx(abs(rack.centre.imag), abs=1e-9)
        assert told[0]["limit"] == pytest.approx(np.ptp(placed) / 2, abs=1e-9)


def test_two_of_one_title_are_told_by_their_ids(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Before: pair Gear - Gear, drive Gear: Gear = 1, Gear = -0.5; a title of its own stays as it is."""
    gear = {"kind": "spur_gear", "module": 2.0, "title": "Gear"}
    text = "".join(table(f"[parts.{key}]", gear | {"number_of_teeth": z}) for key, z in (("a", 20), ("b", 40)))
    text += table("[parts.c]", gear | {"number_of_teeth": 30, "title": "Idler"})
    for second, way in (("b", 0.0), ("c", 180.0)):
        pair = {"kind": "external_gear_pair", "first": "a", "second": second, "direction_deg": way}
        text += table("[[mates]]", pair)
    (tmp_path / "s.toml").write_text(text + table("[[drives]]", {"instance": "a"}), encoding="utf-8")
    assert run("check", tmp_path / "s.toml") == 0
    said = capsys.readouterr().out
    assert "pair Gear (a) - Gear (b)" in said
    assert "pair Gear (a) - Idler" in said
    assert "Gear (a) = 1, Gear (b) = -0.5, Idler = -0.666667" in said

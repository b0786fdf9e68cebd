"""Cycloidal gears in scenes: pairs that fit, what is refused and with which value, files against a rolled circle."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest

from exporters.production.build import build
from exporters.production.check import scene_checks
from exporters.production.plan import plan_build
from geometry.base.errors import OffsetError
from geometry.gears.cycloidal.gear import cycloidal_findings, cycloidal_side
from geometry.gears.teeth.offset import toothed_region
from parts.base.refusal import SceneError
from parts.gears.cycloidal_gear.drawing import data_table
from parts.scene.load import load_scene, make_parts, scene_from_dict

WHEEL: dict[str, Any] = {"kind": "cycloidal_gear", "module": 2.0, "number_of_teeth": 60, "mate_number_of_teeth": 8}
PINION: dict[str, Any] = WHEEL | {"number_of_teeth": 8, "mate_number_of_teeth": 60}
PAIR: dict[str, Any] = {"kind": "cycloidal_gear_pair", "first": "wheel", "second": "pinion"}


def scene_of(wheel: dict[str, Any] = {}, pinion: dict[str, Any] = {}, **mate: Any) -> Any:  # noqa: B006
    parts = {"wheel": {k: v for k, v in (WHEEL | wheel).items() if v is not None},
             "pinion": {k: v for k, v in (PINION | pinion).items() if v is not None}}  # fmt: skip
    return scene_from_dict({"parts": parts, "mates": [PAIR | mate]}, "t", "t")


def refused(scene: Any) -> SceneError:
    with pytest.raises(SceneError) as caught:
        make_parts(scene, "t")
    return caught.value


def test_backlash_thins_both_and_a_drive_goes_through() -> None:
    scene = load_scene("clock_gears")
    plan = plan_build(scene, "t", [], [])
    thin = {name: part.thing.circumferential_thinning for name, part in plan.parts.items()}
    assert thin == {"wheel": pytest.approx(0.1), "pinion": pytest.approx(0.1)}
    checks = scene_checks(plan.placing, plan.parts, scene.drives, "en", contact=True)
    (mate,) = checks["mates"]
    assert mate["verdict"] == "clear"
    # half of it on either side, less where the normal leans: 33.9 degrees at the end of contact, a little more beyond
    assert 0.1 * math.cos(math.radians(34.5)) < mate["gap"] < 0.1 * math.cos(math.radians(33.5))
    assert mate["working_centre_distance"] == pytest.approx(3.0 * 68 / 2)
    assert mate["approach_ratio"] + mate["recess_ratio"] == pytest.approx(mate["contact_ratio"])
    assert checks["drives"][0]["train"]["pinion"] == pytest.approx(-7.5)


@pytest.mark.parametrize(
    ("wheel", "pinion", "key", "code", "value"),
    [
        ({}, {"module": 2.5}, "mates[1]: parts.pinion.module", "not_that_of_mate", 2.0),
        ({}, {"mate_number_of_teeth": 50}, "mates[1]: parts.pinion.mate_number_of_teeth", "not_of_its_mate", 60),
        ({"mate_number_of_teeth": 9}, {}, "mates[1]: parts.wheel.mate_number_of_teeth", "not_of_its_mate", 8),
        ({}, {"number_of_teeth": 9}, "mates[1]: parts.wheel.mate_number_of_teeth", "not_of_its_mate", 9),
        (
            {},
            {"tip_rolling_diameter": 50.0},
            "mates[1]: parts.pinion.tip_rolling_diameter",
            "not_the_mates_root_circle",
            60.0,
        ),
        (
            {"tip_rolling_diameter": 9.0},
            {},
            "mates[1]: parts.pinion.root_rolling_diameter",
            "not_the_mates_tip_circle",
            None,
        ),
        (
            {"tip_rolling_diameter": 7.0},
            {},
            "mates[1]: parts.pinion.root_rolling_diameter",
            "not_the_mates_tip_circle",
            7.0,
        ),
    ],
)
def test_gears_that_are_no_pair_are_told_the_mate_s_circle(
    wheel: dict[str, Any], pinion: dict[str, Any], key: str, code: str, value: float | None
) -> None:
    """In the key that was typed; a circle of 9 mm is more than half of the pinion: no value of that key cures it."""
    found = refused(scene_of(wheel, pinion))
    assert (found.key, found.code) == (key, code)
    cure = found.nearest
    assert (None if cure is None else cure.value) == value
    if value is not None:
        owner, _, name = key.removeprefix("mates[1]: parts.").partition(".")
        cured = {"wheel": wheel, "pinion": pinion}
        make_parts(scene_of(**(cured | {owner: cured[owner] | {name: value}})), "t")


def test_what_is_missing_is_named() -> None:
    found = refused(scene_of({"mate_number_of_teeth": None}))
    assert (found.key, found.code) == ("parts.wheel.mate_number_of_teeth", "one_of_two_is_missing")


@pytest.mark.parametrize("backlash", [3.0, 6.5])
def test_backlash_that_leaves_no_teeth_is_told_what_does(backlash: float) -> None:
    found = refused(scene_of({"addendum_coefficient": 1.3}, normal_backlash=backlash))
    assert found.key == "mates[1].normal_backlash"
    assert found.nearest is not None
    assert isinstance(found.nearest.value, float)
    make_parts(scene_of({"addendum_coefficient": 1.3}, normal_backlash=found.nearest.value), "t")
    refused(scene_of({"addendum_coefficient": 1.3}, normal_backlash=found.nearest.value * 1.001))


def test_a_drawing_file_has_the_path_of_a_rolled_circle(tmp_path: Path) -> None:
    """Points of the DXF by another library; the circle of 4 mm rolls on 60 mm from where the flank crosses it."""
    raw = {"parts": {"wheel": WHEEL}, "exports": [{"format": "dxf", "purpose": "drawing"}]}
    build(plan_build(scene_from_dict(raw, "t", "t"), "t", [], []), tmp_path)
    (file,) = tmp_path.glob("*.dxf")
    splines = ezdxf.readfile(file).modelspace().query("SPLINE")
    found = np.concatenate([[complex(p.x, p.y) for p in s.flattening(1e-7)] for s in splines])
    radius, roll = 60.0, 4.0
    tips = found[(np.abs(found) > radius + 1e-3) & (np.abs(found) < 62.0 - 1e-6)]
    assert len(tips) > 1000
    # by the law of cosines: how far the circle has rolled when its point is that far out, and how far the point lags
    turned = np.arccos(((radius + roll) ** 2 + roll**2 - np.abs(tips) ** 2) / (2 * roll * (radius + roll)))
    lag = np.arcsin(roll * np.sin(turned) / np.abs(tips))
    beyond = turned * roll / radius - lag
    # from the flank's crossing of the pitch circle towards the middle of its tooth, 3 degrees from tooth to tooth apart
    from_middle = np.abs(np.angle(tips * np.exp(-1j * np.round(np.angle(tips) / math.radians(6)) * math.radians(6))))
    off = (math.radians(1.5) - beyond - from_middle) * np.abs(tips)
    # across the flank it is less than along the circle
    assert np.abs(off).max() < 3e-6


def test_a_drawing_asks_nothing_of_a_mate_that_stands_nowhere() -> None:
    """A pinion with tips as high as this wheel's would be pointed, and with roots as deep have no body."""
    for high_or_deep in ({"addendum_coefficient": 1.545}, {"dedendum_coefficient": 5.0}):
        scene = scene_from_dict({"parts": {"wheel": WHEEL | high_or_deep}}, "t", "t")
        parts, _ = make_parts(scene, "t")
        table = data_table(parts["wheel"], scene, ())
        assert [row.value for row in table.parts[0][:4]] == [2.0, 60, 4.0, 30.0]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("depth", [0.19, 0.02])
def test_a_shallow_root_keeps_a_flank_beside_its_fillet(depth: float, tmp_path: Path) -> None:
    """A circle of half the depth, on the root circle and on a radius, touches this at sqrt((r_f + rho)^2 - rho^2)."""
    raw = {"parts": {"wheel": WHEEL | {"dedendum_coefficient": depth}}, "exports": [{"format": "step"}]}
    plan = plan_build(scene_from_dict(raw, "t", "t"), "t", [], [])
    root, rounding = 60.0 - 2 * depth, depth
    assert plan.parts["wheel"].thing.form_radius == pytest.approx(math.sqrt((root + rounding) ** 2 - rounding**2))
    assert build(plan, tmp_path).well


def test_a_thin_rim_is_told_and_one_that_an_offset_closes_refused() -> None:
    """Roots at 57.5 mm: the rim is what the bore leaves of them, and an offset takes from both sides."""
    for bore, rim in ((112.0, 1.5), (110.0, None)):
        scene = scene_from_dict({"parts": {"wheel": WHEEL | {"bore_diameter": bore}}}, "t", "t")
        part = make_parts(scene, "t")[0]["wheel"]
        found = [(f.value, f.limit) for f in cycloidal_findings(part.thing) if f.code == "thin_rim"]
        assert found == ([] if rim is None else [(pytest.approx(rim), 2.0)])
    scene = scene_from_dict({"parts": {"wheel": WHEEL | {"bore_diameter": 114.0}}}, "t", "t")
    bored = make_parts(scene, "t")[0]["wheel"].thing
    for offset in (-0.24, 0.3):
        toothed_region(cycloidal_side, bored, offset)
    with pytest.raises(OffsetError) as caught:
        toothed_region(cycloidal_side, bored, -0.26)
    assert caught.value.reason == "leaves_no_rim"
    assert caught.value.nearest is not None
    assert caught.value.nearest.value == pytest.approx(-0.25, abs=1e-5)


@pytest.mark.parametrize(
    ("teeth", "key", "most", "code"),
    [
        (60, "tip_rolling_diameter", 60_000.0, "circle_all_but_straight"),
        (30, "tip_rolling_diameter", 30_000.0, "circle_all_but_straight"),
        # half the pitch circle draws radial flanks, a larger one leads them under the tooth
        (60, "root_rolling_diameter", 60.0, "root_flanks_undercut"),
        (30, "root_rolling_diameter", 30.0, "root_flanks_undercut"),
    ],
)
def test_circles_too_large_are_refused_with_the_largest(teeth: int, key: str, most: float, code: str) -> None:
    wheel = WHEEL | {"number_of_teeth": teeth, key: most * 1.01}
    found = refused(scene_from_dict({"parts": {"wheel": wheel}}, "t", "t"))
    assert (found.key, found.code) == (f"parts.wheel.{key}", code)
    assert found.nearest is not None
    assert found.nearest.value == most
    make_parts(scene_from_dict({"parts": {"wheel": wheel | {key: most}}}, "t", "t"), "t")


@pytest.mark.sampled(2)
@pytest.mark.parametrize("off", [-0.8, -0.6, 0.0, 0.6, 0.8])
def test_a_pinion_that_stands_by_itself_is_held_against_the_play(off: float) -> None:
    """Half of 0.2 mm on a radius of 8 mm is 0.716 degrees; what the turn takes of it is missing in the gap."""
    stands = {"kind": "fixed", "first": "wheel", "second": "pinion", "offset": [68.0, 0.0, 0.0]}
    raw = {
        "parts": {"wheel": WHEEL, "pinion": PINION},
        "mates": [stands | {"rotation_deg": 180 - 360 / 16 + off}, PAIR | {"normal_backlash": 0.2}],
        "exports": [{"format": "dxf"}],
    }
    plan = plan_build(scene_from_dict(raw, "t", "t"), "t", [], [])
    mate = scene_checks(plan.placing, plan.parts, [], "en", contact=True)["mates"][1]
    # by the key of the mate that has placed it
    phase = next(c for c in mate["conditions"] if c["code"] == "placed_phase")
    assert phase["value"] == pytest.approx(180 - 360 / 16 + off)
    assert math.remainder(phase["value"] - phase["required"] - off, 360 / 8) == pytest.approx(0.0, abs=1e-6)
    assert phase["tolerance"] == pytest.approx(math.degrees(0.1 / 8), abs=1e-4)
    assert phase["met"] == (abs(off) < 0.71)
    if phase["met"]:
        left = 0.1 - math.radians(abs(off)) * 8
        # the normal leans by 29.2 degrees at the end of contact on the tips: half of 58.4 degrees of their circle
        assert left * math.cos(math.radians(31)) < mate["gap"] < left

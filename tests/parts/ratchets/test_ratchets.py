"""Ratchets in scenes: pawls at their teeth, motion, what a drive may not do, refusals that name what works."""

from __future__ import annotations

import cmath
import json
import math
import random
from pathlib import Path
from typing import Any

import msgspec
import numpy as np
import pytest
import shapely
from shapely import affinity

from exporters.command.cli import main
from exporters.production.check import scene_checks
from exporters.production.check_lines import has_bad_verdict
from geometry.curves.line_arc import Line
from geometry.solids.mass import body_moments
from parts.base.refusal import SceneError
from parts.ratchets.pawl import PawlSpec, pawl_of
from parts.ratchets.wheel import RatchetWheelSpec, ratchet_of
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from tests.geometry.gears.ratchets.test_ratchets import blocked, polygon, ridden, wheel_polygon
from tests.sampling import some_of

Keys = dict[str, Any]
WHEEL: Keys = {"kind": "ratchet_wheel", "module": 5.0, "number_of_teeth": 16}
RING: Keys = WHEEL | {"number_of_teeth": 24, "internal": True}
PAWL: Keys = {"kind": "pawl", "of": "wheel"}
MATE: Keys = {"kind": "ratchet_pair", "first": "wheel", "second": "pawl"}


def placed(
    wheel: Keys, pawl: Keys, mates: list[Keys] | None = None, *, contact: bool = True, **more: Any
) -> tuple[Placing, dict[str, Any]]:
    """Where both stand, and what the checks say."""
    tables = {"parts": {"wheel": wheel, "pawl": pawl}, "mates": mates or [MATE], **more}
    made = scene_from_dict(tables, "t", "t")
    parts, matings = make_parts(made, "t")
    placing = place(made.instances, made.drives, parts, matings, "t")
    return placing, scene_checks(placing, parts, made.drives, "en", contact=contact)


def refusal(wheel: Keys, pawl: Keys | None) -> SceneError | None:
    try:
        make_parts(scene_from_dict({"parts": {"wheel": wheel} | ({"pawl": pawl} if pawl else {})}, "t", "t"), "t")
    except SceneError as error:
        return error
    return None


@pytest.mark.sampled(2)
@pytest.mark.parametrize("turns", ["ccw", "cw"])
@pytest.mark.parametrize("wheel", [WHEEL, RING], ids=["external", "internal"])
def test_a_pawl_rides_freely_and_is_told_where_it_holds(wheel: Keys, turns: str) -> None:
    sense = 1 if turns == "ccw" else -1
    teeth = wheel["number_of_teeth"]
    for run, told in ((2.5 * sense, []), (-0.5 * sense, ["turns_against_pawl"])):
        placing, checks = placed(wheel | {"turns": turns}, PAWL, drives=[{"instance": "wheel", "turns": run}])
        (mate,) = checks["mates"]
        assert mate["verdict"] == "contact"
        assert [one["code"] for one in mate.get("conditions", [])] == told
        # the drive cannot go on, and films show tooth and pawl in each other
        assert has_bad_verdict(checks) is bool(told)
        train = placing.train
        assert train is not None
        if told:
            # it holds: the pawl does not move
            assert train.poses([run / 2])["pawl"] == pytest.approx(train.poses([0])["pawl"])
            continue
        # lifted on a land, the same of any, whole turns later too; seated at the beginning alone
        ways = [train.poses([sense * (tooth - 0.05) / teeth])["pawl"][1] for tooth in (1, 2, teeth + 1, 2 * teeth)]
        start = train.poses([0])["pawl"][1]
        swing = math.radians(mate["pawl_swing_deg"])
        side = -1 if wheel is RING else 1
        for way in ways:
            assert math.remainder(way - start, 2 * math.pi) == pytest.approx(-side * sense * swing)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("turns", ["ccw", "cw"])
def test_whole_turns_of_a_wheel_are_counted_from_its_start(turns: str) -> None:
    """By polygons the pawl is lifted from the beginning on, and drops the first time an overrun after a pitch."""
    sense = 1 if turns == "ccw" else -1
    drives = [{"instance": "wheel", "turns": 3.0 * sense}]
    placing, _ = placed(WHEEL | {"turns": turns}, PAWL, contact=False, drives=drives)
    made, _ = make_parts(scene_from_dict({"parts": {"wheel": WHEEL, "pawl": PAWL}}, "t", "t"), "t")
    shape, train = made["pawl"].thing.shape, placing.train
    assert train is not None
    start = train.poses([0])["pawl"][1]
    for share in (0.15, 0.5, 0.85, 1.3, 1.6):
        turn = share * shape.wheel.pitch_angle
        found, _ = ridden(shape, turn if share < 1 else turn - shape.wheel.pitch_angle)
        for whole in (0, 1, 2):
            now = train.poses([sense * (turn / (2 * math.pi) + whole)])["pawl"][1]
            lift = -sense * math.remainder(now - start, 2 * math.pi)
            assert lift == pytest.approx(found, abs=1e-3)
    # a turn later all is as it was once it has dropped, wherever rounding leaves the angle
    for turn in np.linspace(0.13, 0.99, 60).tolist():
        first, later = (train.poses([sense * (turn + whole)])["pawl"][1] for whole in (0, 1))
        assert math.remainder(first - later, 2 * math.pi) == pytest.approx(0.0, abs=1e-6)


def test_pawls_stand_at_their_teeth_or_between_them() -> None:
    """Two half a pitch apart: the wheel turns back by half a pitch until the other one holds it."""
    mates = [MATE | {"tooth": 1.0}, MATE | {"second": "other", "tooth": 9.5}]
    instances: Keys = {"wheel": {}, "pawl": {}, "other": {"part": "pawl"}}
    placing, checks = placed(WHEEL, PAWL, mates, instances=instances)
    assert [mate["turn_back_deg"] for mate in checks["mates"]] == pytest.approx([0.0, 11.25])
    assert [mate["verdict"] for mate in checks["mates"]] == ["contact", "contact"]
    directions = [mate["direction_deg"] for mate in checks["mates"]]
    assert directions[1] - directions[0] == pytest.approx(8.5 * 22.5)
    # the same places by their directions
    by = [MATE | {"direction_deg": directions[0]}, MATE | {"second": "other", "direction_deg": directions[1]}]
    again, _ = placed(WHEEL, PAWL, by, contact=False, instances=instances)
    for one, two in zip(placing.instances, again.instances, strict=True):
        assert (one.centre, one.rotation) == pytest.approx((two.centre, two.rotation))


def test_a_wheel_that_a_pawl_holds_does_not_turn_back() -> None:
    """At every tooth: what rounding leaves of its direction is no whole pitch to turn back by."""
    for tooth in range(1, 17):
        _, checks = placed(WHEEL, PAWL, [MATE | {"tooth": float(tooth)}], contact=False)
        assert checks["mates"][0]["turn_back_deg"] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(("share", "told"), [(0.45, False), (0.51, True), (0.9, True)])
def test_a_drive_may_turn_a_wheel_back_as_far_as_the_pawl_lets_it(share: float, told: bool) -> None:
    """Midway between two teeth it is free for half a pitch."""
    drives = [{"instance": "wheel", "turns": -share / 16}]
    _, checks = placed(WHEEL, PAWL, [MATE | {"tooth": 9.5}], contact=False, drives=drives)
    found = [one for one in checks["mates"][0].get("conditions", []) if one["code"] == "turns_against_pawl"]
    assert [(one["value"], one["limit"]) for one in found] == (
        [(pytest.approx(share * 22.5), pytest.approx(11.25))] if told else []
    )


# with what a pawl touches the wheel: the turn, rad, at which it does
TOUCHING: dict[str, tuple[Keys, Keys, float]] = {
    "nose and face": (WHEEL | {"number_of_teeth": 12, "front_angle_deg": 0.26, "notch_angle_deg": 49.5,
                               "tooth_depth": 6.48}, PAWL | {"line_angle_deg": -11.1}, 0.517),
    "nose and face of five": (WHEEL | {"number_of_teeth": 5, "front_angle_deg": -14.8, "notch_angle_deg": 57.4,
                                       "root_fillet_radius": 0.0}, PAWL | {"nose_radius": 0.89}, 1.2409),
    "face and edge": (WHEEL | {"number_of_teeth": 3, "front_angle_deg": -18.0, "root_fillet_radius": 0.0}, PAWL,
                      2.0682),
    "lower side and edge": (WHEEL | {"number_of_teeth": 3, "front_angle_deg": -28.0, "notch_angle_deg": 94.0,
                                     "tip_land": 5.1, "root_fillet_radius": 0.81},
                            PAWL | {"length": 9.575, "clearance": 0.013}, 0.46),
    "the land of the next tooth": (WHEEL | {"number_of_teeth": 6, "tooth_depth": 4.891, "front_angle_deg": -29.0,
                                            "notch_angle_deg": 24.4, "root_fillet_radius": 0.0},
                                   PAWL | {"line_angle_deg": -12.7, "boss_diameter": 16.0}, 1.0079),
    "underside and land": (WHEEL | {"number_of_teeth": 6, "front_angle_deg": 6.7},
                           PAWL | {"line_angle_deg": 10.2, "length": 21.4}, 0.7453),
}  # fmt: skip


@pytest.mark.parametrize(("wheel", "pawl", "turn"), TOUCHING.values(), ids=TOUCHING.keys())
def test_each_side_of_a_pawl_may_be_what_touches(wheel: Keys, pawl: Keys, turn: float) -> None:
    """Front angles and lines of no practice too; by polygons."""
    made, _ = make_parts(scene_from_dict({"parts": {"wheel": wheel, "pawl": pawl}}, "t", "t"), "t")
    shape = made["pawl"].thing.shape
    assert shape.overrun <= turn <= shape.overrun + shape.wheel.pitch_angle
    found, below = ridden(shape, turn)
    assert shape.stands(turn) == pytest.approx(found, abs=1.5e-4)
    assert below > 1e-6


def test_a_pawl_that_leaves_the_face_below_the_edge_drops_later() -> None:
    """By polygons: all of its way down is free a little after the overrun, and not where its reach clears the edge."""
    wheel = WHEEL | {"number_of_teeth": 4, "front_angle_deg": -22.5, "notch_angle_deg": 43.5, "root_fillet_radius": 0.0}
    pawl = PAWL | {"line_angle_deg": 20.0, "clearance_angle_deg": 33.0, "clearance": 3.06}
    made, _ = make_parts(scene_from_dict({"parts": {"wheel": wheel, "pawl": pawl}}, "t", "t"), "t")
    shape = made["pawl"].thing.shape
    # by the law of cosines the nose is past the edge at this turn
    apart, tip = abs(shape.pivot), shape.wheel.tip_radius
    reach = abs(shape.nose - shape.pivot) + shape.nose_radius
    past = math.acos((apart**2 + tip**2 - reach**2) / (2 * apart * tip)) - abs(cmath.phase(shape.pivot))
    assert blocked(shape, 1.02 * shape.overrun) < 1e-5
    assert shape.overrun > 1.2 * past
    assert blocked(shape, past) > 1e-4


def test_conditions_of_a_pair_are_told_with_their_numbers() -> None:
    # arctan 0.15 is 8.53 degrees
    for front in (5.0, 8.5):
        _, checks = placed(WHEEL | {"front_angle_deg": front}, PAWL)
        (found,) = checks["mates"][0]["findings"]
        assert (found["code"], found["value"]) == ("pawl_slips_out", pytest.approx(front))
        assert found["limit"] == pytest.approx(math.degrees(math.atan(0.15)))
    for front, friction in ((5.0, 0.05), (8.6, 0.15)):
        _, checks = placed(WHEEL | {"front_angle_deg": front}, PAWL, [MATE | {"friction": friction}])
        assert checks["mates"][0]["findings"] == []
    made, _ = make_parts(
        scene_from_dict({"parts": {"wheel": WHEEL, "pawl": PAWL | {"nose_radius": 1.6}}}, "t", "t"), "t"
    )
    (shallow,) = made["pawl"].findings
    assert (shallow.code, shallow.limit) == ("shallow_pawl", pytest.approx(3.75 / 2))
    assert shallow.value < shallow.limit


def test_a_pawl_that_stands_elsewhere_is_told() -> None:
    """By hand it is turned off its place: nothing is contact then. By how much is told along the arc of its edge."""
    placing, _ = placed(WHEEL, PAWL | {"length": 25.0}, contact=False)
    (own,) = (one for one in placing.instances if one.id == "pawl")
    at = [own.centre.real, own.centre.imag, 0.0]
    for off, met in ((0.0, True), (1.0, False)):
        rotation = math.degrees(own.rotation) + off
        instances: Keys = {"wheel": {}, "pawl": {"at": at, "rotation_deg": rotation}}
        _, checks = placed(WHEEL, PAWL | {"length": 25.0}, contact=False, instances=instances)
        conditions = checks["mates"][0]["conditions"]
        assert all(one["met"] for one in conditions) == met
        (along,) = [one["value"] for one in conditions if one["code"] == "rack_phase"]
        assert along == pytest.approx(25.0 * math.radians(off), abs=1e-9)


NEVER_DOWN: list[tuple[Keys, Keys]] = [
    ({"number_of_teeth": 3, "front_angle_deg": -28.1, "tooth_depth": 3.17},
     {"length": 11.4, "line_angle_deg": 77.9, "boss_diameter": 7.5, "nose_height": 3.8, "clearance": 1.3,
      "nose_radius": 4.6}),
    ({"number_of_teeth": 5, "front_angle_deg": -10.04, "tooth_depth": 10.25},
     {"length": 30.0, "line_angle_deg": 61.9, "boss_diameter": 3.0, "nose_height": 7.4, "clearance": 1.0,
      "nose_radius": 0.98}),
    ({"number_of_teeth": 8, "front_angle_deg": -14.1, "tooth_depth": 14.7},
     {"length": 11.1, "line_angle_deg": 46.1, "boss_diameter": 4.1, "nose_height": 7.5, "clearance": 0.59,
      "nose_radius": 0.54}),
]  # fmt: skip


@pytest.mark.parametrize(("wheel", "pawl"), NEVER_DOWN)
def test_a_pawl_that_never_comes_down_is_refused(wheel: Keys, pawl: Keys) -> None:
    """It ended in a traceback. By polygons: wherever the wheel stands, it is stopped far above its notch."""
    refused = refusal(WHEEL | wheel, PAWL | pawl)
    assert refused is not None
    assert refused.code == "pawl_never_drops"
    own = msgspec.convert({"kind": "pawl", "of": "wheel"} | pawl, PawlSpec)
    shape = pawl_of(own, ratchet_of(msgspec.convert(WHEEL | wheel, RatchetWheelSpec)), 5.0)
    teeth, bar = wheel_polygon(shape.wheel), polygon(shape.edges())
    swung = [affinity.rotate(bar, -lift, (shape.pivot.real, shape.pivot.imag), use_radians=True)
             for lift in np.linspace(shape.swing, 0, 40)]  # fmt: skip
    for turn in np.linspace(0, shape.wheel.pitch_angle, 30, endpoint=False):
        stands = affinity.rotate(teeth, turn, (0, 0), use_radians=True)
        free = next(k for k, one in enumerate(swung) if one.intersection(stands).area > 1e-3)
        assert free < 20


REFUSED: dict[str, tuple[Keys, Keys | None, str, str]] = {
    "no land": (WHEEL | {"notch_angle_deg": 85.0}, None, "notch_angle_deg", "leaves_no_land"),
    "wide land": (WHEEL | {"tip_land": 15.8}, None, "tip_land", "leaves_no_notch"),
    "hardly a notch": (WHEEL | {"tip_land": 15.69}, None, "tip_land", "leaves_no_notch"),
    "no neck": (WHEEL | {"number_of_teeth": 6, "front_angle_deg": 25.0, "notch_angle_deg": 40.0, "tip_land": 1.0,
                         "tooth_depth": 8.0}, None, "tooth_depth", "leaves_no_neck"),
    "deep": (WHEEL | {"tooth_depth": 41.0}, None, "tooth_depth", "leaves_no_root_circle"),
    "round root": (WHEEL | {"root_fillet_radius": 6.0}, None, "root_fillet_radius", "rounding_takes_face"),
    "narrow": (WHEEL | {"tip_land": 12.0, "notch_angle_deg": 50.0}, None, "tip_land", "notch_too_narrow"),
    "few teeth of a ring": (RING | {"number_of_teeth": 6}, None, "tooth_depth", "back_does_not_fall"),
    "wide bore": (WHEEL | {"bore_diameter": 72.5}, None, "bore_diameter", "no_wall_around_bore"),
    "bore of a ring": (RING | {"bore_diameter": 6.0}, None, "bore_diameter", "only_of_external"),
    "thin ring": (RING | {"outer_diameter": 127.0}, None, "outer_diameter", "leaves_no_rim"),
    "rim": (WHEEL | {"outer_diameter": 200.0}, None, "outer_diameter", "only_of_internal"),
    "blunt nose": (WHEEL, PAWL | {"nose_radius": 8.0}, "nose_radius", "nose_does_not_fit"),
    "nose sharper than the root": (WHEEL, PAWL | {"nose_radius": 0.49}, "nose_radius", "nose_does_not_fit"),
    "thick boss": (WHEEL, PAWL | {"boss_diameter": 30.0, "length": 24.0}, "boss_diameter", "boss_reaches_teeth"),
    "line of a ring's pawl along the tangent": (RING, PAWL | {"line_angle_deg": 0.0}, "line_angle_deg",
                                                "no_whole_outline"),
    "line of a ring's pawl out of it": (RING, PAWL | {"line_angle_deg": -10.0}, "line_angle_deg", "no_whole_outline"),
    "tail of a ring's pawl": (RING, PAWL | {"tail_length": 60.0}, "tail_length", "tail_reaches_teeth"),
    "tail beside the wheel": (WHEEL, PAWL | {"tail_length": 30.0, "tail_angle_deg": -60.0}, "tail_length",
                              "tail_reaches_teeth"),
    "tail that hits as the pawl swings": (
        WHEEL, PAWL | {"tail_length": 10.0, "tail_angle_deg": -60.0, "tail_width": 3.0}, "tail_length",
        "tail_reaches_teeth"),
    "tail that hits seated": (RING, PAWL | {"tail_length": 90.0, "tail_angle_deg": 120.0, "tail_width": 6.0},
                              "tail_length", "tail_reaches_teeth"),
    "tail whose middle hits": (WHEEL, PAWL | {"tail_length": 30.0, "tail_angle_deg": -50.0, "tail_width": 3.0},
                               "tail_length", "tail_reaches_teeth"),
    "tail without a length": (WHEEL, PAWL | {"tail_width": 5.0}, "tail_width", "needs_other"),
    "tail within the boss": (WHEEL, PAWL | {"tail_length": 0.5}, "tail_length", "no_whole_outline"),
    "four teeth of a ring": (RING | {"number_of_teeth": 4}, None, "number_of_teeth", "back_does_not_fall"),
    "short": (WHEEL | {"number_of_teeth": 20, "tip_land": 2.0},
              PAWL | {"line_angle_deg": 36.0, "length": 8.0, "boss_diameter": 5.0, "pivot_diameter": 2.0},
              "length", "pawl_too_short"),
    "thin boss": (WHEEL, PAWL | {"boss_diameter": 3.0}, "pivot_diameter", "hole_reaches_edge"),
}  # fmt: skip


@pytest.mark.parametrize(("wheel", "pawl", "key", "code"), REFUSED.values(), ids=REFUSED.keys())
def test_what_cannot_be_is_refused_with_what_can(wheel: Keys, pawl: Keys | None, key: str, code: str) -> None:
    refused = refusal(wheel, pawl)
    assert refused is not None
    owner, _, name = refused.key.removeprefix("parts.").partition(".")
    assert (name, refused.code) == (key, code)
    found = refused.nearest
    assert found is not None
    parts = {"wheel": wheel, "pawl": pawl or PAWL}
    parts[owner] = {k: v for k, v in (parts[owner] | {key: found.value}).items() if v is not None}
    assert refusal(parts["wheel"], parts["pawl"] if pawl else None) is None


def test_any_number_of_teeth_makes_a_ratchet_from_two_keys() -> None:
    for teeth in some_of((3, 4, 6, 7, 12, 30, 100, 400), 2):
        for front in (0.0, 15.0):
            wheel = WHEEL | {"number_of_teeth": teeth, "front_angle_deg": front}
            _, checks = placed(wheel, PAWL)
            assert checks["mates"][0]["verdict"] == "contact"
    for teeth in some_of((8, 16, 60)):
        _, checks = placed(RING | {"number_of_teeth": teeth}, PAWL)
        assert checks["mates"][0]["verdict"] == "contact"


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("teeth", "line"), [(20, 36.0), (10, 37.5), (16, -10.0)])
def test_a_pawl_that_leans_is_as_long_as_its_teeth_need(teeth: int, line: float) -> None:
    """Its default length: one whose pivot stood before the knee of its underside ran into the teeth."""
    _, checks = placed(WHEEL | {"number_of_teeth": teeth}, PAWL | {"line_angle_deg": line})
    assert checks["mates"][0]["verdict"] == "contact"


_CAUGHT: list[tuple[Keys, Keys]] = [
    (WHEEL | {"number_of_teeth": 4, "front_angle_deg": 2.2, "tooth_depth": 7.4},
     PAWL | {"line_angle_deg": 44.9, "length": 55.6, "nose_height": 5.5, "clearance": 1.07}),
    (WHEEL | {"number_of_teeth": 3, "turns": "cw", "front_angle_deg": 1.2, "notch_angle_deg": 39.8,
              "root_fillet_radius": 1.0}, PAWL | {"line_angle_deg": 66.5}),
    (WHEEL | {"number_of_teeth": 4, "front_angle_deg": 9.2, "notch_angle_deg": 60.9},
     PAWL | {"line_angle_deg": 49.1, "clearance_angle_deg": 0.36, "nose_height": 8.4}),
]  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("wheel", "pawl"), _CAUGHT)
def test_a_pawl_that_the_face_does_not_let_out_is_refused(wheel: Keys, pawl: Keys) -> None:
    """By polygons: beyond the angle that is offered some turn of the wheel leaves it no place at all, below it does."""
    refused = refusal(wheel, pawl)
    assert refused is not None
    assert refused.nearest is not None
    assert (refused.key, refused.code) == ("parts.pawl.line_angle_deg", "pawl_is_caught")
    allowed = refused.nearest.value
    assert isinstance(allowed, float)
    assert refusal(wheel, pawl | {"line_angle_deg": allowed}) is None
    owner = msgspec.convert(wheel | {"face_width": 5.0}, RatchetWheelSpec)
    for angle, caught in ((pawl["line_angle_deg"], True), (allowed + 1.0, True), (allowed - 1e-4, False)):
        keys = msgspec.convert(pawl | {"line_angle_deg": angle, "face_width": 5.0}, PawlSpec)
        shape = pawl_of(keys, ratchet_of(owner), owner.module)
        edges, at = polygon(shape.edges()), (shape.pivot.real, shape.pivot.imag)
        least = []
        for turn in np.linspace(0.1, 0.9, 9) * shape.overrun:
            fixed = affinity.rotate(wheel_polygon(shape.wheel), turn, (0, 0), use_radians=True)
            lifts = shape.stands(turn) + np.linspace(-0.01, 0.01, 11)
            least.append(min(affinity.rotate(edges, -x, at, use_radians=True).intersection(fixed).area for x in lifts))
        assert (max(least) > 3e-4) is caught


def random_ratchet(draw: random.Random) -> tuple[Keys, Keys]:
    """Any keys within what is common, and a little beyond."""
    module = draw.choice([1.0, 2.5, 5.0, 10.0])
    wheel: Keys = {"kind": "ratchet_wheel", "module": module, "number_of_teeth": draw.choice([6, 8, 12, 20, 30, 90]),
                   "internal": draw.random() < 0.4, "front_angle_deg": draw.uniform(-5, 30),
                   "turns": draw.choice(["ccw", "cw"])}  # fmt: skip
    pawl: Keys = dict(PAWL)
    may: list[tuple[Keys, str, float, float]] = [
        (wheel, "notch_angle_deg", draw.uniform(30, 80), 1.0), (wheel, "tip_land", draw.uniform(0.1, 2.0), module),
        (wheel, "tooth_depth", draw.uniform(0.2, 1.4), module),
        (wheel, "root_fillet_radius", draw.choice([0.0, 0.02, 0.2]), module),
        (pawl, "line_angle_deg", draw.uniform(15, 75) if wheel["internal"] else draw.uniform(-15, 40), 1.0),
        (pawl, "length", draw.uniform(1.5, 12), module), (pawl, "clearance_angle_deg", draw.uniform(0, 40), 1.0),
        (pawl, "nose_radius", draw.uniform(0.02, 0.5), module), (pawl, "tail_length", draw.uniform(1.5, 5), module),
    ]  # fmt: skip
    for keys, key, value, unit in may:
        if draw.random() < 0.35:
            keys[key] = value * unit
    return wheel, pawl


@pytest.mark.parametrize("seed", some_of(range(60), 5))
def test_a_random_ratchet_rides_or_is_refused(seed: int) -> None:
    """What builds touches all the way and overlaps nowhere, where polygons say so; what is offered builds."""
    draw = random.Random(seed)
    wheel, pawl = random_ratchet(draw)
    refused = refusal(wheel, pawl)
    if refused is not None:
        if refused.nearest is not None:
            owner, _, key = refused.key.removeprefix("parts.").partition(".")
            (wheel if owner == "wheel" else pawl)[key] = refused.nearest.value
            again = refusal(wheel, pawl)
            assert again is None or again.key != refused.key
        return
    placing, checks = placed(wheel, pawl)
    assert checks["mates"][0]["verdict"] == "contact"
    assert {one.id for one in placing.instances} == {"wheel", "pawl"}
    made, _ = make_parts(scene_from_dict({"parts": {"wheel": wheel, "pawl": pawl}}, "t", "t"), "t")
    shape = made["pawl"].thing.shape
    turn = shape.overrun + draw.uniform(0.05, 0.95) * shape.wheel.pitch_angle
    found, _ = ridden(shape, turn)
    assert shape.stands(turn) == pytest.approx(found, abs=1e-3)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    "own", [{"clearance_angle_deg": 1.0}, {"clearance": 2.5}, {"clearance_angle_deg": 25.0, "nose_height": 2.0}]
)
def test_the_calculation_is_that_of_the_scene_s_own_pawl(
    own: Keys, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The distance at which it stands, and the ride as polygons of what the scene makes have it."""
    keys = "".join(f"{key} = {value}\n" for key, value in own.items())
    scene = tmp_path / "ratchet.toml"
    scene.write_text(
        '[parts.wheel]\nkind = "ratchet_wheel"\nmodule = 5.0\nnumber_of_teeth = 16\nface_width = 10.0\n'
        f'[parts.pawl]\nkind = "pawl"\nof = "wheel"\nface_width = 10.0\n{keys}'
    )
    assert main(["calc", "ratchet", str(scene), "rows=9", "--format", "json"]) == 0
    told = json.loads(capsys.readouterr().out)
    made, _ = make_parts(scene_from_dict({"parts": {"wheel": WHEEL, "pawl": PAWL | own}}, "t", "t"), "t")
    shape = made["pawl"].thing.shape
    assert told["values"]["pivot_distance"] == pytest.approx(abs(shape.pivot), rel=1e-12)
    for row in told["ride"][1:-1]:
        found, _ = ridden(shape, math.radians(row["φ"]))
        assert math.radians(row["ψ"]) == pytest.approx(found, abs=1e-3)


@pytest.mark.parametrize(("wheel", "pawl"), [
    (WHEEL, PAWL),
    (WHEEL | {"module": 1.0, "number_of_teeth": 20, "tooth_depth": 1.17}, PAWL | {"nose_radius": 0.437}),
    (WHEEL | {"module": 2.5, "number_of_teeth": 12, "tooth_depth": 2.9}, PAWL | {"clearance_angle_deg": 31.7}),
])  # fmt: skip
def test_bar_and_top_keep_the_clearance_off_the_tips(wheel: Keys, pawl: Keys) -> None:
    """Each straight side that begins and ends beyond the gap of 0.1 m is there all along, however flat it begins."""
    made, _ = make_parts(scene_from_dict({"parts": {"wheel": wheel, "pawl": pawl}}, "t", "t"), "t")
    least = wheel["module"] * (wheel["number_of_teeth"] / 2 + 0.1)
    sides = [edge for edge in made["pawl"].thing.shape.edges() if isinstance(edge, Line)]
    beyond = [one for one in sides if min(abs(one.start), abs(one.end)) > least - 1e-9]
    assert len(beyond) >= 2
    for one in beyond:
        assert (
            shapely.LineString([(z.real, z.imag) for z in (one.start, one.end)]).distance(shapely.Point(0, 0))
            > least - 1e-9
        )


def test_a_pawl_is_for_one_wheel() -> None:
    parts = {"wheel": WHEEL, "other": WHEEL | {"number_of_teeth": 18}, "pawl": PAWL | {"of": "other"}}
    with pytest.raises(SceneError) as refused:
        make_parts(scene_from_dict({"parts": parts, "mates": [MATE]}, "t", "t"), "t")
    assert (refused.value.key, refused.value.code) == ("mates[1]: parts.pawl.of", "made_for_another_wheel")


@pytest.mark.sampled(2)
@pytest.mark.parametrize("angle", [-20.0, -10.0, 0.0, 12.0, 45.0])
def test_a_tail_adds_to_the_pawl(angle: float) -> None:
    """Its area lies between that of the pawl without and that with all of the tail beyond the boss.

    At -20 and at 12 degrees a side of it meets one of the bar's where nothing of the boss is between them.
    """
    found = []
    for tail in (0.0, 20.0):
        own = PAWL | ({"tail_length": tail, "tail_width": 5.0, "tail_angle_deg": angle} if tail else {})
        made, _ = make_parts(scene_from_dict({"parts": {"wheel": WHEEL, "pawl": own}}, "t", "t"), "t")
        found.append(body_moments(made["pawl"].body(0.0)).volume / 10.0)
    assert 0.5 * 15 * 6 < found[1] - found[0] < 25 * 7.5

"""Transmission error of mates in a scene: whose sense, whose arm, only when asked, and its words."""

from __future__ import annotations

import json
import math
from functools import cache
from typing import Any

import pytest

from exporters.production.check import scene_checks
from exporters.production.check_lines import check_lines
from tests.parts.mates.test_mate_kinds import scene

SHORT = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "tip_diameter": 39.8}
RELIEVED = {"tip_relief": {"depth_coefficient": 0.02, "height_coefficient": 0.9}}
WHEEL = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 40}
RING = {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 60}
RACK = {"kind": "rack", "module": 2.0, "number_of_teeth": 12}


def mate_of(kind: str, first: dict[str, Any], second: dict[str, Any], transmission: bool = True, **keys: Any) -> Any:
    """The check of a mate of ``a`` and ``b``, made once."""
    return _checked(json.dumps([kind, first, second, keys]), transmission)


@cache
def _checked(asked: str, transmission: bool) -> Any:
    kind, first, second, keys = json.loads(asked)
    mate = {"kind": kind, "first": "a", "second": "b", **keys.pop("mate", {})}
    made, _, stand = scene({"a": first, "b": second}, mate, **keys)
    return scene_checks(stand, made, (), "en", contact=False, transmission=transmission)["mates"][0]


def test_only_when_asked() -> None:
    assert "transmission_error" not in mate_of("external_gear_pair", SHORT, WHEEL, transmission=False)
    found = mate_of("external_gear_pair", {**SHORT, "tip_diameter": 44.0}, WHEEL)["transmission_error"]
    assert found == {
        sense: {"line_of_action": pytest.approx(0, abs=1e-9), "second_arcsec": pytest.approx(0, abs=1e-5)}
        for sense in ("counter_clockwise", "clockwise")
    }


def test_arcseconds_are_those_of_the_second() -> None:
    found = mate_of("external_gear_pair", {**SHORT, **RELIEVED}, {**WHEEL, **RELIEVED})["transmission_error"][
        "clockwise"
    ]
    assert found["line_of_action"] > 1e-3
    base = 40.0 * math.cos(math.radians(20))
    assert found["second_arcsec"] == pytest.approx(math.degrees(found["line_of_action"] / base) * 3600, rel=1e-12)


def test_a_ring_that_drives_pushes_the_other_flanks() -> None:
    """A pinion with a thicker face on one side would tell; here: the same pair, with either one as the first."""
    one = mate_of("internal_gear_pair", SHORT, RING)["transmission_error"]
    two = mate_of("internal_gear_pair", RING, SHORT)["transmission_error"]
    for sense, other in (("clockwise", "counter_clockwise"), ("counter_clockwise", "clockwise")):
        assert one[sense]["line_of_action"] > 1e-3
        assert two[other]["line_of_action"] == pytest.approx(one[sense]["line_of_action"], rel=1e-9)
        # the pinion's base circle is a third of the ring's
        assert two[other]["second_arcsec"] == pytest.approx(3 * one[sense]["second_arcsec"], rel=1e-9)


def test_a_rack_travels() -> None:
    found = mate_of("rack_pair", {**SHORT, "tip_diameter": 39.4}, RACK)["transmission_error"]["clockwise"]
    assert found["second_travel"] == pytest.approx(found["line_of_action"] / math.cos(math.radians(20)), rel=1e-12)


@pytest.mark.heavy
def test_a_wide_helical_face_evens_out() -> None:
    helix = {"helix_angle_deg": 30.0, "tip_diameter": 46.5}
    widths = {}
    for width in (0.5, 20.0):
        first = {**SHORT, **helix, "face_width": width}
        second = {**WHEEL, "helix_angle_deg": 30.0, "hand": "left", "face_width": width}
        widths[width] = mate_of("external_gear_pair", first, second)["transmission_error"]["clockwise"][
            "line_of_action"
        ]
    assert widths[0.5] > 1e-3
    assert widths[20.0] == 0.0


def test_it_is_told_where_a_mate_stands_and_not_where_conditions_break() -> None:
    _, _, stand = scene({"a": SHORT, "b": WHEEL}, {"kind": "external_gear_pair", "first": "a", "second": "b"})
    there = stand.instances[1]
    place = {
        "a": {"at": [0, 0, 0]},
        "b": {"at": [there.centre.real, 0, 0], "rotation_deg": math.degrees(there.rotation)},
    }
    assert mate_of("external_gear_pair", SHORT, WHEEL, instances=place)["transmission_error"]
    place["b"]["rotation_deg"] += 3.0
    assert "transmission_error" not in mate_of("external_gear_pair", SHORT, WHEEL, instances=place)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("language", "word"), [("en", "transmission error"), ("uk", "кінематична похибка")])
def test_its_words(language: str, word: str) -> None:
    found = mate_of("rack_pair", {**SHORT, "tip_diameter": 39.4}, RACK)
    lines = [line for line in check_lines({"mates": [found]}, language) if word in line]
    assert len(lines) == 2
    assert all(f"{found['transmission_error']['clockwise']['line_of_action']:.2g}"[:4] in line for line in lines)


def test_teeth_that_slip_are_told() -> None:
    """Tips that overlap by some hundredths of a millimetre do not hold each other at all drive angles."""
    second = {**WHEEL, "number_of_teeth": 33}
    first = {**SHORT, "tip_diameter": 44.0}
    found = mate_of("external_gear_pair", first, second, mate={"working_centre_distance": 56.75})
    assert found["transmission_error"] == {}
    assert any("slip past" in line for line in check_lines({"mates": [found]}, "en"))

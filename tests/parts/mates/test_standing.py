"""How the second of every mate stands to the first, and what is told of both: by centre distances, teeth and arcs.

Where a mate puts its second it finds it standing: no turn off, at its distance; beside that it finds how far. Both hang
on nothing but how the two stand to each other.
"""

from __future__ import annotations

import cmath
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.command.cli import main
from geometry.base.errors import ParameterError
from geometry.kinematics.mechanism import Prismatic, Rolling
from parts.scene.load import make_parts, scene_from_dict
from tests.offered import GONE, Raw, cam, scenes
from tests.parts.limits import check_limit, check_refused, refused, with_key

CENTRE, TURN, DIRECTION = 3 + 4j, 0.7, math.radians(30.0)
COS20, TAN20 = math.cos(math.radians(20.0)), math.tan(math.radians(20.0))


def pair(mate: str, first: Raw, second: Raw, **keys: Any) -> Raw:
    return {"parts": {"a": first, "b": second}, "mates": [{"kind": mate, "first": "a", "second": "b"} | keys],
            "exports": [{"format": "svg"}]}  # fmt: skip


def matings(raw: Raw) -> list[Any]:
    return make_parts(scene_from_dict(raw, "s", "s"), "s")[1]


SPUR: Raw = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 10.0}
WHEEL = SPUR | {"number_of_teeth": 31}
RING: Raw = {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 60, "face_width": 10.0}
RACK: Raw = {"kind": "rack", "module": 2.0, "number_of_teeth": 20, "face_width": 10.0}
PINS: Raw = {"kind": "pin_ring", "number_of_pins": 12, "pin_circle_diameter": 80.0, "pin_diameter": 8.0}
DISC: Raw = {"kind": "cycloidal_disc", "number_of_lobes": 11, "pin_circle_diameter": 80.0, "pin_diameter": 8.0,
             "eccentricity": 2.5, "bore_diameter": 22.0, "face_width": 6.0, "output_holes": {
                 "count": 6, "pitch_circle_diameter": 46.0, "pin_diameter": 6.0, "start_deg": 10.0}}  # fmt: skip
ECCENTRIC: Raw = {"kind": "eccentric", "diameter": 22.0, "eccentricity": 2.5, "bore_diameter": 6.0}
OUTPUT: Raw = {"kind": "output_plate", "number_of_pins": 6, "pin_circle_diameter": 46.0, "pin_diameter": 6.0,
               "face_width": 5.0, "start_deg": 3.0}  # fmt: skip
LANTERN: Raw = {"kind": "lantern_wheel", "number_of_pins": 10, "pin_circle_diameter": 60.0, "pin_diameter": 8.0,
                "face_width": 9.0, "plate_thickness": 3.0}  # fmt: skip
COG: Raw = {"kind": "lantern_gear", "number_of_teeth": 30, "number_of_pins": 10, "pin_circle_diameter": 60.0,
            "pin_diameter": 8.0, "face_width": 6.0}  # fmt: skip
OVAL: Raw = {"kind": "noncircular_gear", "centrode": "oval", "axis_ratio": 1.4, "number_of_teeth": 18, "module": 2.0}
PLAIN: Raw = {"kind": "plate", "width": 20.0, "height": 10.0}
OUT: dict[str, Any] = {"working_centre_distance": 51.2, "normal_backlash": 0.5}

# what the place of the second tells: distance (mm), how many equal turns a pitch of it is, half of the play over which
# arm (mm), and its joint: kind, teeth of both
STANDING: dict[str, tuple[Raw, float, int, float, float, tuple[Any, ...]]] = {
    "external": (pair("external_gear_pair", SPUR, WHEEL), 51.0, 31, 0.0, 31 * COS20, ("external", 20, 31)),
    # what is wanted beside the zero distance and 0.5 mm of backlash
    "wide": (pair("external_gear_pair", SPUR, WHEEL, **OUT), 51.2, 31, 0.25, 31 * COS20, ("external", 20, 31)),
    "internal": (pair("internal_gear_pair", SPUR, RING), 40.0, 60, 0.0, 60 * COS20, ("internal", 20, 60)),
    "in a ring": (pair("internal_gear_pair", RING, SPUR), 40.0, 20, 0.0, 20 * COS20, ("internal", 60, 20)),
    "lantern": (pair("lantern_pair", LANTERN, COG), 120.0, 30, 0.0, 90.0, ("external", 10, 30)),
    "loose lantern": (pair("lantern_pair", LANTERN, COG | {"pin_clearance": 0.1}), 120.0, 30, 0.1, 90.0,
                      ("external", 10, 30)),
    "on a gear": (pair("lantern_pair", COG | {"pin_clearance": 0.1}, LANTERN), 120.0, 10, 0.1, 30.0,
                  ("external", 30, 10)),
    "cycloidal": (pair("cycloidal_pair", PINS, DISC), 2.5, 11, 0.0, 27.5, ("internal", 12, 11)),
    "output": (pair("output_pins", DISC, OUTPUT), 2.5, 6, 0.0, 23.0, ("internal", 1, 1)),
    # opposite ovals: half a turn lays each onto itself; greatest radius 1.4 times the least, both together the distance
    "oval": (pair("noncircular_gear_pair", OVAL, OVAL | {"role": "mate"}), math.nan, 2, 0.0, math.nan,
             ("external", 18, 18)),
}  # fmt: skip


@pytest.mark.sampled(10)
@pytest.mark.parametrize("name", STANDING)
@pytest.mark.parametrize("turned", [0.0, 2.0])
def test_the_second_stands_where_its_mate_puts_it_and_off_that_by_as_much_as_it_is_moved(
    name: str, turned: float
) -> None:
    raw, distance, times, play, arm, joint = STANDING[name]
    (mate,) = matings(raw)
    if math.isnan(distance):
        distance = mate.distance
        radii = mate.gears.second.radii
        assert sum(radii) == pytest.approx(distance)
        arm = radii[1]
    way = cmath.rect(1.0, turned)
    first = CENTRE * way, TURN + turned
    centre, rotation = mate.second_pose(*first, DIRECTION + turned)
    spoke = (centre - first[0]) / way
    sign = -1 if name == "output" else 1
    assert spoke == pytest.approx(sign * cmath.rect(distance, DIRECTION))
    pitch = 2 * math.pi / times
    for along, off, whole in ((0.0, 0.0, 0), (0.3, 0.0, 0), (0.0, 0.02, 0), (0.2, -0.03, 0), (0.0, 0.01, 1)):
        second = centre + sign * cmath.rect(along, DIRECTION + turned), rotation + off + whole * pitch
        found = mate.standing(first, second)
        assert found.distance == pytest.approx(distance + along)
        assert found.phase_off == pytest.approx(off, abs=1e-9)
        assert (found.play, found.arm, found.slides) == (pytest.approx(play / arm), pytest.approx(arm), False)
        assert found.slack(0.1) == pytest.approx(0.1 / arm)
    kind, *teeth = joint
    (rolling,) = mate.joints
    assert isinstance(rolling, Rolling)
    assert (rolling.kind, rolling.first, rolling.second, rolling.teeth) == (kind, "a", "b", tuple(teeth))


@pytest.mark.parametrize("number", [20, 21])
@pytest.mark.parametrize("backlash", [None, 0.3])
def test_a_rack_stands_off_along_itself(number: int, backlash: float | None) -> None:
    """The middle of its teeth, or the space beside that, faces a tooth of the gear: x is told along the rack."""
    (mate,) = matings(pair("rack_pair", SPUR, RACK | {"number_of_teeth": number}, normal_backlash=backlash)
                      if backlash else pair("rack_pair", SPUR, RACK | {"number_of_teeth": number}))  # fmt: skip
    centre, rotation = mate.second_pose(CENTRE, TURN, DIRECTION)
    assert rotation == pytest.approx(DIRECTION + math.pi / 2)
    for along, off in ((0.0, 0.0), (0.4, 0.0), (0.0, 0.25), (0.1, -1.0), (0.0, 2 * math.pi + 0.25)):
        second = centre + cmath.rect(1.0, DIRECTION) * complex(along, off), rotation
        found = mate.standing((CENTRE, TURN), second)
        assert found.distance == pytest.approx(20.0 + along)
        assert found.phase_off == pytest.approx(math.remainder(off, 2 * math.pi), abs=1e-9)
        assert (found.play, found.arm, found.slides) == (pytest.approx((backlash or 0.0) / 2 / COS20), 1.0, True)
    # a turn of the gear moves it by the rolling of the reference circle
    moved, _ = mate.second_pose(CENTRE, TURN + 0.05, DIRECTION)
    assert (moved - centre) / cmath.rect(1.0, DIRECTION) == pytest.approx(20.0 * 0.05j)
    slides, rolling = mate.joints
    assert slides == Prismatic("b")
    assert (rolling.kind, rolling.teeth, float(rolling.module)) == ("rack", (20, 1), 2.0)
    # a tooth of the gear on the line of centres meets the space of the rack
    on_line, _ = mate.second_pose(0j, 0.0, 0.0)
    assert on_line.imag == pytest.approx(0.0 if number % 2 == 0 else -math.pi)


# how the second turns as the first does, both on fixed axes: the ratio of their teeth
TURNS = {
    "external": -20 / 31, "internal": 1 / 3, "in a ring": 3.0, "lantern": -1 / 3, "on a gear": -3.0, "cycloidal": 1.0
}  # fmt: skip


@pytest.mark.parametrize("name", TURNS)
def test_the_second_turns_by_the_ratio_of_the_teeth(name: str) -> None:
    (mate,) = matings(STANDING[name][0])
    before, after = (mate.second_pose(0j, turn, DIRECTION)[1] for turn in (0.1, 0.15))
    pitch = 2 * math.pi / STANDING[name][2]
    ratio = TURNS[name]
    if name == "cycloidal":
        # the ring turned by 0.05 under a held eccentric: the disc rolls back by a lobe less
        ratio = 12 / 11
    assert math.remainder(after - before - 0.05 * ratio, pitch) == pytest.approx(0.0, abs=1e-9)


def tight_distance(one: int, two: int, shifts: float) -> float:
    """a_w from inv(alpha_w) = inv(alpha) + 2 (x1 + x2) tan(alpha) / (z1 + z2), by bisection; m = 2."""
    wanted = TAN20 - math.radians(20.0) + 2 * shifts * TAN20 / (one + two)
    low, high = 0.1, 1.0
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if math.tan(middle) - middle < wanted else (low, middle)
    return (one + two) * COS20 / math.cos(low)


def test_numbers_of_gear_pairs_are_those_of_the_textbook() -> None:
    shifted = pair("external_gear_pair", SPUR | {"profile_shift_coefficient": 0.5},
                   WHEEL | {"profile_shift_coefficient": 0.3})  # fmt: skip
    told = matings(shifted)[0].quantities()
    distance = tight_distance(20, 31, 0.8)
    assert told["working_centre_distance"] == pytest.approx(distance)
    angle = math.acos(51 * COS20 / distance)
    assert told["working_pressure_angle_deg"] == pytest.approx(math.degrees(angle))
    assert told["gear_ratio"] == pytest.approx(1.55)
    # Delta y = x1 + x2 - (a_w - a) / m; tips lowered by it
    shortening = 0.8 - (distance - 51.0) / 2
    assert told["tip_shortening_coefficient"] == pytest.approx(shortening)
    tips = 20 + 2 * (1 + 0.5 - shortening), 31 + 2 * (1 + 0.3 - shortening)
    bases = 20 * COS20, 31 * COS20
    ratio = (sum(math.sqrt(a**2 - b**2) for a, b in zip(tips, bases, strict=True)) - distance * math.sin(angle)) / (
        2 * math.pi * COS20)  # fmt: skip
    assert told["contact_ratio"] == pytest.approx(ratio)
    helical = matings(scenes()["helical pair"])[0].quantities()
    assert helical["overlap_ratio"] == pytest.approx(10 * math.sin(math.radians(20)) / (2 * math.pi))
    assert helical["total_contact_ratio"] == pytest.approx(
        helical["overlap_ratio"] + helical["effective_contact_ratio"]
    )
    assert helical["common_face_width"] == 10.0
    assert helical["working_centre_distance"] == pytest.approx(51 / math.cos(math.radians(20)))
    rack = matings(pair("rack_pair", SPUR, RACK))[0].quantities()
    assert rack["travel_per_turn"] == pytest.approx(40 * math.pi)
    assert rack["working_pressure_angle_deg"] == pytest.approx(20.0)
    assert rack["working_centre_distance"] == pytest.approx(20.0)
    # a tip at 22 over the base circle, an addendum of 2 over the line of action
    reach = math.sqrt(22**2 - (20 * COS20) ** 2) - 20 * math.sin(math.radians(20)) + 2 / math.sin(math.radians(20))
    assert rack["contact_ratio"] == pytest.approx(reach / (2 * math.pi * COS20))
    wide = matings(STANDING["wide"][0])[0].quantities()
    assert wide["normal_backlash"] == pytest.approx(0.5)
    assert wide["working_centre_distance"] == 51.2


def test_numbers_of_pins_are_those_of_their_circles() -> None:
    told = matings(STANDING["lantern"][0])[0].quantities()
    assert (told["gear_ratio"], told["working_centre_distance"], told["pitch"]) == pytest.approx((3, 120, 6 * math.pi))
    assert matings(STANDING["loose lantern"][0])[0].quantities()["pin_clearance"] == 0.1
    assert matings(STANDING["loose lantern"][0])[0].normal_backlash == pytest.approx(0.2)
    disc = matings(STANDING["cycloidal"][0])[0]
    assert disc.holds == ("a",)
    told = disc.quantities()
    assert (told["reduction"], told["eccentricity"], told["shortening_coefficient"]) == pytest.approx((-11, 2.5, 0.75))
    assert told["lost_motion_deg"] == 0.0
    assert told["pins_in_contact"] == 12
    loose = matings(pair("cycloidal_pair", PINS, DISC | {"pin_clearance": 0.05}))[0]
    turned = loose.quantities()
    # the clearance over the greatest arm of a pin's normal, on both sides
    assert turned["lost_motion_deg"] == pytest.approx(math.degrees(2 * 0.05 / 27.5), rel=0.2)
    assert turned["pins_in_contact"] < 12
    assert loose.standing((0j, 0.0), loose.second_pose(0j, 0.0, 0.0)).play == pytest.approx(0.05 / 27.5, rel=0.2)
    output = matings(STANDING["output"][0])[0].quantities()
    assert output == {"output_pins": 6, "hole_diameter": 11.0, "pin_diameter": 6.0, "eccentricity": 2.5}
    bearing = matings(pair("eccentric_bearing", ECCENTRIC, DISC | {"bore_diameter": 22.4}))[0]
    assert bearing.quantities() == {"eccentricity": 2.5, "bearing_play": pytest.approx(0.4)}


def test_a_disc_on_its_eccentric_stands_about_its_middle_and_a_free_one_anyhow() -> None:
    (mate,) = matings(pair("eccentric_bearing", ECCENTRIC, DISC | {"bore_diameter": 22.4}, height=1.5))
    centre, _ = mate.second_pose(CENTRE, TURN, DIRECTION)
    assert centre == pytest.approx(CENTRE + cmath.rect(2.5, TURN))
    found = mate.standing((CENTRE, TURN), (centre + 0.1j, 9.0))
    assert (found.distance, found.phase_off) == (pytest.approx(2.6), 0.0)
    assert (mate.height, mate.bond) == (1.5, "turning")
    # the play of the bore on either side, less what the disc stands off
    assert mate.contact(0.0, 0.0, None).worst.gap == pytest.approx(0.2)
    assert mate.contact(0.0, 0.05, None).worst.gap == pytest.approx(0.15)
    assert mate.contact(0.0, -0.05, None).worst.gap == pytest.approx(0.15)


def test_output_pins_have_the_play_that_their_holes_leave() -> None:
    holes = {**DISC["output_holes"], "clearance": 0.4}
    (mate,) = matings(pair("output_pins", DISC | {"output_holes": holes}, OUTPUT))
    assert mate.gap == pytest.approx(0.2)
    # half the play as an angle about the circle of the pins
    found = mate.standing((0j, 0.0), mate.second_pose(0j, 0.0, 0.0))
    assert found.play == pytest.approx(2 * math.asin(0.2 / 46))
    assert mate.contact(0.0, 0.0, None).worst.gap == pytest.approx(0.2)
    assert mate.contact(0.0, 0.1, None).worst.gap == pytest.approx(0.1)
    assert mate.contact(0.01, 0.0, None).worst.gap == pytest.approx(0.2 - 46 * math.sin(0.005))
    assert mate.findings() == ()
    # the plate's pins stand in the holes: both starts are told
    _, rotation = mate.second_pose(0j, 0.3, DIRECTION)
    assert rotation == pytest.approx(0.3 + math.radians(10.0 - 3.0))
    tight = make_parts(scene_from_dict(pair("output_pins", DISC, OUTPUT | {"pin_diameter": 6.2}), "s", "s"), "s")[1][0]
    assert [(f.code, f.value, f.limit) for f in tight.findings()] == [("output_holes_small", 11.0, pytest.approx(11.2))]


def test_lobes_keep_off_the_inside_of_their_ring() -> None:
    """Tips at 40 + 2.5 - 4 = 38.5 from the disc's axis, 41 from the ring's."""
    ring = PINS | {"inner_diameter": 82.1}
    (mate,) = matings(pair("cycloidal_pair", ring, DISC))
    assert mate.findings() == ()
    (near,) = matings(pair("cycloidal_pair", PINS | {"inner_diameter": 81.9}, DISC))
    assert [(f.code, f.value, f.limit) for f in near.findings()] == [("lobes_reach_ring", 81.9, pytest.approx(82.0))]
    # an inside that nobody gave yields: 4.9 for two eccentricities against pins of 4
    (free,) = matings(pair("cycloidal_pair", PINS, DISC))
    assert (free.findings(), free.ring.inner_radius) == ((), pytest.approx(41.4))
    assert free.contact(0.0, 0.0, None).worst.gap == pytest.approx(0.0, abs=1e-9)
    # and no ring whose pins are thinner than that clears them: the eccentricity that is told just does
    thin = {"pin_diameter": 4.0}
    (far,) = matings(pair("cycloidal_pair", PINS | thin, DISC | thin))
    (finding,) = far.findings()
    assert (finding.code, finding.value) == ("lobes_beyond_pins", 2.5)
    assert far.contact(0.0, 0.0, None).worst.gap == pytest.approx(40 - 43)
    (near,) = matings(pair("cycloidal_pair", PINS | thin, DISC | thin | {"eccentricity": finding.limit - 1e-9}))
    assert near.findings() == ()
    # 2 e from the valley to the top, less what the pins stand in: their hold is 2 % of their diameter
    assert finding.limit == pytest.approx((2 + 2 - 0.08) / 2)
    (near,) = matings(pair("cycloidal_pair", PINS | {"inner_diameter": 81.9}, DISC))
    beside = matings(pair("cycloidal_pair", PINS | {"pins": "holes"}, DISC))[0]
    assert (beside.findings(), beside.has_contact, beside.height) == ((), False, 10.0)
    assert (near.has_contact, near.height) == (True, 0.0)
    turned = matings(pair("cycloidal_pair", PINS, DISC, turned_lobes=2))[0]
    plain = matings(pair("cycloidal_pair", PINS, DISC))[0]
    one, two = (m.second_pose(0j, 0.0, DIRECTION)[1] for m in (plain, turned))
    assert two - one == pytest.approx(2 * 2 * math.pi / 11)


def test_the_gear_of_a_lantern_stands_midway_between_its_plates() -> None:
    assert matings(STANDING["lantern"][0])[0].height == 3.0 + (9.0 - 6.0) / 2
    assert matings(pair("lantern_pair", LANTERN | {"pins": "holes"}, COG))[0].height == 3.0
    assert matings(pair("lantern_pair", LANTERN, COG, height=0.5))[0].height == 0.5
    assert matings(pair("lantern_pair", COG, LANTERN))[0].height == -4.5
    assert matings(pair("lantern_pair", COG, LANTERN, height=0.5))[0].height == -0.5
    raw = STANDING["lantern"][0]
    check_limit(raw, "mates[1]: parts.b.face_width", "not_between_the_plates", 9.0, "at_most", near=3e-5)
    turned = pair("lantern_pair", COG, LANTERN)
    check_limit(turned, "mates[1]: parts.a.face_width", "not_between_the_plates", 9.0, "at_most", near=3e-5)


def test_what_is_fixed_and_what_turns_about_an_axis() -> None:
    (mate,) = matings(pair("fixed", SPUR, WHEEL, offset=[3.0, 4.0, 2.0], rotation_deg=30.0))
    assert mate.quantities() == {"offset": [3.0, 4.0, 2.0], "rotation_deg": pytest.approx(30.0)}
    pose = mate.second_pose(CENTRE, TURN, 0.0)
    assert pose[0] == pytest.approx(CENTRE + (3 + 4j) * cmath.rect(1.0, TURN))
    assert pose[1] == pytest.approx(TURN + math.radians(30.0))
    found = mate.standing((CENTRE, TURN), (pose[0] + 0.1, pose[1] + 0.02 + 2 * math.pi))
    assert (found.distance, found.phase_off) == (pytest.approx(5.1), pytest.approx(0.02))
    assert (mate.distance, mate.height, mate.bond) == (5.0, 2.0, "fixed")
    (axis,) = matings(pair("coaxial", SPUR, WHEEL, height=3.0, rotation_deg=90.0))
    assert axis.second_pose(CENTRE, TURN, 1.0) == (CENTRE, pytest.approx(TURN + math.pi / 2))
    assert axis.standing((CENTRE, 0.0), (CENTRE + 0.3j, 5.0)).distance == pytest.approx(0.3)
    assert (axis.height, axis.bond) == (3.0, "turning")
    (carried,) = matings(pair("carried", SPUR, WHEEL, offset=[3.0, 4.0, 2.0]))
    assert carried.second_pose(CENTRE, TURN, 0.0) == (
        pytest.approx(CENTRE + (3 + 4j) * cmath.rect(1.0, TURN)), TURN)  # fmt: skip
    place = carried.second_pose(CENTRE, TURN, 0.0)[0]
    told = carried.standing((CENTRE, TURN), (place + 0.2j, 3.0))
    assert (told.distance, told.phase_off) == (pytest.approx(5.2), 0.0)
    assert (carried.height, carried.bond) == (2.0, "turning")
    (free,) = matings(pair("carried", SPUR, WHEEL))
    assert free.standing((0j, 0.0), (1j, 0.0)) is None
    (alike,) = matings(pair("parallel", SPUR, WHEEL, offset=[3.0, 4.0, 2.0], rotation_deg=10.0))
    assert alike.second_pose(CENTRE, TURN, 1.0) == (CENTRE + 3 + 4j, pytest.approx(TURN + math.radians(10)))
    assert alike.standing((0j, TURN), (9j, TURN + math.radians(10) + 0.02)).phase_off == pytest.approx(0.02)
    assert (alike.joints[0].kind, alike.joints[0].teeth, alike.height) == ("parallel", (1, 1), 2.0)
    for lost in (matings(pair("parallel", SPUR, WHEEL))[0], free):
        with pytest.raises(ParameterError, match="place_on_carrier"):
            lost.second_pose(0j, 0.0, 0.0)


@pytest.mark.parametrize(("number", "angle"), [(1, 0.0), (3, 60.0), (12, 330.0)])
def test_a_pin_stands_in_its_seat(number: int, angle: float) -> None:
    pin = {"kind": "pin", "diameter": 8.0, "length": 20.0}
    (mate,) = matings(pair("pin_seat", PINS, pin, number=number, height=1.0))
    assert mate.offset == pytest.approx(cmath.rect(40.0, math.radians(angle)))
    assert (mate.distance, mate.height, mate.rotation) == (pytest.approx(40.0), 1.0, 0.0)


def test_seats_and_sizes_that_are_not_there_are_told() -> None:
    pin = {"kind": "pin", "diameter": 8.0, "length": 20.0}
    seats = pair("pin_seat", PINS, pin)
    found = refused(with_key(seats, "mates[1].number", 13))
    assert found is not None
    assert (found.key, found.code, found.value) == ("mates[1].number", "fewer_seats", 13)
    assert found.nearest is not None
    assert (found.nearest.value, found.nearest.side) == (12, "at_most")
    fixed = refused(pair("pin_seat", PINS | {"pins": "fixed"}, pin))
    assert fixed is not None
    assert (fixed.key, fixed.code) == ("mates[1].first", "has_its_pins")


LOBES: list[tuple[Raw, str, object, str, object]] = [
    # what is typed in two parts agrees to a billionth
    (pair("cycloidal_pair", PINS, DISC), "mates[1]: parts.b.number_of_lobes", 10, "one_lobe_fewer_than_pins", 11),
    (pair("cycloidal_pair", PINS, DISC), "mates[1]: parts.b.pin_diameter", 8.0 * (1 + 2e-9), "not_of_the_ring", 8.0),
    (pair("cycloidal_pair", PINS, DISC), "mates[1]: parts.b.pin_circle_diameter", 80.1, "not_of_the_ring", 80.0),
    (pair("eccentric_bearing", ECCENTRIC, DISC), "mates[1]: parts.b.eccentricity", 2.6, "not_of_the_eccentric", 2.5),
    (pair("eccentric_bearing", ECCENTRIC, DISC), "mates[1]: parts.b.bore_diameter", 0.0, "eccentric_needs_round_bore",
     22.0),
    (pair("output_pins", DISC, OUTPUT), "mates[1]: parts.b.number_of_pins", 5, "not_of_the_holes", 6),
    (pair("output_pins", DISC, OUTPUT), "mates[1]: parts.b.pin_circle_diameter", 46.1, "not_of_the_holes", 46.0),
    (pair("lantern_pair", LANTERN, COG), "mates[1]: parts.b.number_of_pins", 11, "not_of_the_lantern", 10),
    (pair("lantern_pair", LANTERN, COG), "mates[1]: parts.b.pin_circle_diameter", 60.1, "not_of_the_lantern", 60.0),
    (pair("lantern_pair", LANTERN, COG), "mates[1]: parts.b.pin_diameter", 8.1, "not_of_the_lantern", 8.0),
    (pair("lantern_pair", COG, LANTERN), "mates[1]: parts.a.pin_diameter", 8.1, "not_of_the_lantern", 8.0),
    (pair("pin_seat", PINS, {"kind": "pin", "diameter": 8.0, "length": 20.0}), "mates[1]: parts.b.diameter", 8.1,
     "not_of_the_seats", 8.0),
    (scenes()["cam and roller"], "mates[1]: parts.b.diameter", 16.1, "cam_has_another", 16.0),
    (scenes()["cam and arm"], "mates[1]: parts.b.arm_length", 70.1, "cam_has_another", 70.0),
    (scenes()["cam and arm"], "mates[1]: parts.b.sense", "with", "cam_has_another", "against"),
    (scenes()["external"], "mates[1]: parts.b.module", 2.5, "", ...),
]  # fmt: skip


@pytest.mark.parametrize(("raw", "key", "value", "code", "works"), LOBES)
def test_a_size_that_is_not_its_mates_is_told_that(raw: Raw, key: str, value: object, code: str, works: object) -> None:
    if not code:
        found = refused(with_key(raw, key, value))
        assert found is not None
        assert found.key.startswith("mates[1]: parts.b.")
        return
    check_refused(raw, key, value, code, works)
    if isinstance(value, float) and isinstance(works, float) and "cam" not in code and "round" not in code:
        assert refused(with_key(raw, key, works * (1 + 0.9e-9))) is None


def test_an_output_plate_needs_holes_and_a_cam_what_follows_it() -> None:
    bare = with_key(pair("output_pins", DISC, OUTPUT), "parts.a.output_holes", GONE)
    found = refused(bare)
    assert found is not None
    assert (found.key, found.code) == ("mates[1].first", "no_output_holes")
    swing = {"centre_distance": 90.0, "arm_length": 70.0}
    stem = pair(
        "cam_follower", cam(lift=None, swing_deg=20.0, oscillating=swing), {"kind": "follower", "end": "roller"}
    )
    found = refused(stem)
    assert found is not None
    assert (found.code, found.numbers["wanted"]) == ("cam_wants", "follower_arm")
    arm = pair("cam_follower", cam(), {"kind": "follower_arm", "end": "roller", "arm_length": 70.0})
    found = refused(arm)
    assert found is not None
    assert (found.code, found.numbers["wanted"]) == ("cam_wants", "follower")


FLAT: Raw = pair("cam_follower", cam(follower="flat", follower_radius=None),
                 {"kind": "follower", "end": "flat", "plate_diameter": 80.0})  # fmt: skip


def test_the_contact_stays_on_the_plate_of_a_follower() -> None:
    """Twice the greatest S' = 2 H / beta of the sine."""
    check_limit(FLAT, "mates[1]: parts.b.plate_diameter", "contact_over_edge", 4 * 20 / math.radians(120), "at_least",
                near=4e-5)  # fmt: skip


@pytest.mark.parametrize("name", ["cam and stem", "cam and roller"])
def test_a_follower_stands_off_along_its_way(name: str) -> None:
    """A stem is lifted by S over the lowest place; across its way it is told as distance, a turn by its height."""
    (mate,) = matings(scenes()[name])
    lowest = 40.0 if name == "cam and stem" else 48.0
    turn, way = math.radians(60.0), cmath.rect(1.0, math.radians(90.0))
    at, turned = mate.second_pose(CENTRE, turn, math.radians(90.0))
    # the sine at half of its rise; stems are drawn from their face, rollers from their middle
    assert at == pytest.approx(CENTRE + way * (lowest + 10.0))
    found = mate.standing((CENTRE, turn), (at + 0.2 + 0.3j, turned))
    assert found.distance == pytest.approx(0.2)
    assert (found.phase_off, found.slides, found.arm, found.play) == (pytest.approx(0.3), True, 1.0, 0.0)
    leaning = mate.standing((CENTRE, turn), (at, turned + 0.01))
    assert leaning.distance == pytest.approx(0.0 if name == "cam and roller" else 0.01 * lowest)
    assert (mate.module, mate.has_contact) == (pytest.approx(lowest), True)
    # turned with its mate's direction
    other, lean = mate.second_pose(CENTRE, turn + 0.4, math.radians(90.0) + 0.4)
    assert other - CENTRE == pytest.approx((at - CENTRE) * cmath.rect(1.0, 0.4))
    assert lean - turned == pytest.approx(0.4)


def test_an_arm_stands_off_by_its_turn() -> None:
    (mate,) = matings(scenes()["cam and arm"])
    assert (mate.distance, mate.quantities()) == (90.0, {"travel": pytest.approx(20.0), "unit": "deg"})
    at, turned = mate.second_pose(CENTRE, TURN, math.pi / 2)
    assert at == pytest.approx(CENTRE + 90.0)
    found = mate.standing((CENTRE, TURN), (at + 0.3j, turned + 0.01))
    assert (found.distance, found.phase_off, found.slides) == (pytest.approx(90.3), pytest.approx(0.7), True)
    assert not mate.has_contact


def test_a_roller_in_a_groove_has_its_play_outwards() -> None:
    groove = {k: v for k, v in cam().items() if k != "follower"} | {
        "kind": "groove_cam", "groove_depth": 5.0, "roller_clearance": 0.1}  # fmt: skip
    (mate,) = matings(pair("cam_follower", groove, {"kind": "roller", "diameter": 16.0}))
    assert mate.quantities() == {"travel": pytest.approx(20.0), "unit": "mm", "roller_clearance": 0.1}
    at, turned = mate.second_pose(0j, 0.0, math.pi / 2)
    assert [mate.standing((0j, 0.0), (at + 1j * out, turned)).play for out in (0.05, -0.05)] == [0.1, 0.0]


@pytest.mark.parametrize("direction", [90.0, 0.0, 210.0])
def test_a_yoke_rises_with_its_cam_and_has_half_of_its_play(direction: float) -> None:
    raw = scenes()["yoke_cam"]
    raw = with_key(raw, "mates[1].direction_deg", direction)
    mate = next(m for m in matings(raw) if m.kind == "cam_yoke")
    way = math.radians(direction)
    low, turned = mate.second_pose(CENTRE, way - math.pi / 2, way)
    assert low == pytest.approx(CENTRE)
    assert turned == pytest.approx(way - math.pi / 2)
    at, _ = mate.second_pose(CENTRE, way - math.pi / 2 + math.pi / 2, way)
    lift = mate.cam.motion.value(math.pi / 2)
    assert at == pytest.approx(CENTRE + cmath.rect(float(lift), way))
    found = mate.standing((CENTRE, way), (at + cmath.rect(0.3, way) + 1j * cmath.rect(0.2, way), turned))
    assert (found.distance, found.phase_off, found.play) == (
        pytest.approx(0.2),
        pytest.approx(0.3),
        pytest.approx(0.05),
    )
    lean = mate.standing((CENTRE, way), (at, turned + 0.01))
    assert lean.distance == pytest.approx(0.01 * 40.0)
    assert mate.quantities() == {"yoke_breadth": pytest.approx(100.1), "lift": pytest.approx(20.0),
                                 "normal_backlash": 0.1}  # fmt: skip
    assert np.isclose(mate.module, 40.0)


def test_two_disks_on_one_shaft_are_told_by_their_turn_and_their_rollers() -> None:
    (mate,) = matings(scenes()["conjugate"])
    assert mate.second_pose(CENTRE, TURN, 1.0) == (CENTRE, TURN)
    found = mate.standing((CENTRE, TURN), (CENTRE + 0.1j, TURN + 0.02))
    assert (found.distance, found.phase_off, found.arm) == (pytest.approx(0.1), pytest.approx(0.02), 48.0)
    assert mate.quantities() == {"between_rollers": pytest.approx(130.0), "unit": "mm"}
    assert (mate.height, mate.bond, mate.has_contact) == (12.0, "fixed", False)


@pytest.mark.parametrize("travel", [0.0, 40.0])
def test_a_follower_on_a_wedge_is_lifted_by_as_much_as_that_has_slid(travel: float) -> None:
    """The plate slides to -x under it, which goes up along y by S; its middle stands over the roller's place."""
    raw = with_key(scenes()["wedge_cam"], "mates[1].travel", travel)
    mate = next(m for m in matings(raw) if m.kind == "wedge_follower")
    way = cmath.rect(1.0, TURN)
    at, turned = mate.second_pose(CENTRE, TURN, 0.0)
    place = (at - CENTRE) / way
    lift = float(mate.cam.motion.value(travel))
    start = complex(mate.cam.centre(0.0))
    assert place.real == pytest.approx(start.real + travel)
    assert place.imag == pytest.approx(start.imag + lift)
    found = mate.standing((CENTRE, TURN), (at + way * (0.2 + 0.3j), turned))
    assert (found.distance, found.phase_off, found.slides) == (pytest.approx(0.2), pytest.approx(0.3), True)
    # a plate that has slid on by 5 lifts the same stem in its guide, which stays
    moved = mate.followed((CENTRE, TURN), (CENTRE - 5 * way, TURN))
    rise = float(mate.cam.motion.value(travel + 5.0)) - lift
    assert moved[0] == pytest.approx(at + way * 1j * rise)
    # pulled back to its run-in it has let it down
    moved = mate.followed((CENTRE, TURN), (CENTRE + (travel + 3) * way, TURN))
    assert moved[0] == pytest.approx(at - way * 1j * lift)
    told = mate.quantities()
    assert (told["travel"], told["unit"], told["plate_travel"]) == (pytest.approx(20.0), "mm", travel)
    assert mate.joints == (Prismatic(mate.first),)


def test_a_plate_slides_as_far_as_its_law_goes() -> None:
    raw = scenes()["wedge_cam"]
    most = next(m for m in matings(raw) if m.kind == "wedge_follower").cam.motion.travel
    check_limit(raw, "mates[1].travel", "plate_slides_less", most, "at_most", near=1e-5)


def test_a_member_of_a_linkage_stands_where_it_is_carried() -> None:
    found = {m.member: m for m in matings(scenes()["linkage_cam"]) if m.kind == "linkage_member"}
    assert found.keys() == {"coupler", "driven", "guide"}
    for mate in found.values():
        at, turned = mate.second_pose(CENTRE, TURN, math.pi / 2)
        told = mate.standing((CENTRE, TURN), (at + 0.2j, turned + 0.03 + 2 * math.pi))
        assert (told.distance, told.phase_off) == (pytest.approx(mate.distance + 0.2), pytest.approx(0.03))
        assert told.arm == pytest.approx(abs(complex(mate.cam.reference_point(0.0))))
        other, lean = mate.second_pose(CENTRE, TURN + 0.3, math.pi / 2 + 0.3)
        assert other - CENTRE == pytest.approx((at - CENTRE) * cmath.rect(1.0, 0.3))
        assert lean - turned == pytest.approx(0.3)
    assert found["driven"].quantities() == {"member": "driven", "swing_deg": pytest.approx(24.0)}
    (stem,) = (m for m in matings(scenes()["linkage_cam"]) if m.kind == "cam_follower")
    assert stem.quantities() == {"travel": pytest.approx(24.0), "unit": "deg"}


def test_a_worm_lies_across_the_line_of_centres() -> None:
    """a = m (q + z2) / 2, its axis at the middle of the rim's width, to the right of the line."""
    (mate,) = matings(with_key(scenes()["thesis_worm_1"], "mates[1].direction_deg", 0.0))
    assert (mate.distance, mate.height, mate.teeth[0]) == (pytest.approx(5 * (10 + 128) / 2), 13.0, 128)
    assert mate.second_axis(0.0) == pytest.approx((0.0, -1.0, 0.0))
    assert mate.second_axis(math.pi / 2) == pytest.approx((1.0, 0.0, 0.0))
    (rolling,) = mate.joints
    assert (rolling.kind, rolling.teeth, rolling.sense) == ("worm", (128, 1), 1)
    pose = mate.second_pose(CENTRE, 0.0, 0.0)
    assert pose[0] == pytest.approx(CENTRE + mate.distance)
    # a pitch of the wheel on is a turn of a worm of one start
    on = mate.second_pose(CENTRE, 1e-3, 0.0)
    assert math.remainder(on[1] - pose[1] - 128 * 1e-3, 2 * math.pi) == pytest.approx(0.0, abs=1e-9)
    told = mate.quantities()
    assert (told["centre_distance"], told["ratio"]) == (pytest.approx(345.0), 128.0)
    assert mate.standing((0j, 0.0), pose) is None
    raw = scenes()["thesis_worm_1"]
    for key, value in (("centre_distance_error", 0.3), ("wheel_axial_error", 0.2), ("axis_angle_error_deg", 1.0)):
        raw = with_key(raw, f"mates[1].{key}", value)
    (off,) = matings(raw)
    assert (off.distance, off.height) == (pytest.approx(345.3), pytest.approx(12.8))
    x, y, z = off.second_axis(0.0)
    assert (x, y, z) == pytest.approx((0.0, -math.cos(math.radians(1)), math.sin(math.radians(1))), abs=1e-12)
    assert off.field is None


def test_the_ratio_of_ovals_goes_from_one_axis_over_the_other_to_its_inverse() -> None:
    (mate,) = matings(STANDING["oval"][0])
    told = mate.quantities()
    assert (told["least_ratio"], told["greatest_ratio"]) == pytest.approx((1 / 1.4, 1.4))
    assert told["centre_distance"] == mate.distance
    thin = matings(pair("noncircular_gear_pair", OVAL, OVAL | {"role": "mate"}, normal_backlash=0.1))[0]
    assert thin.normal_backlash == pytest.approx(0.1)
    assert thin.gears.first.circumferential_thinning == pytest.approx(0.05 / COS20)
    # both turn, each by the arc that has rolled: driven back it is where it was
    rotation = mate.second_pose(0j, 0.4, DIRECTION)[1]
    assert mate.partner("a", 0.4, DIRECTION) == pytest.approx(rotation)
    assert math.remainder(mate.partner("b", rotation, DIRECTION) - 0.4, 2 * math.pi) == pytest.approx(0.0, abs=1e-9)


def test_gears_share_the_thinning_for_a_backlash() -> None:
    """Half each by the arc j_bn / (2 cos alpha); all of it where the other has its own, none where both do."""

    def thinnings(first: Raw, second: Raw, backlash: float) -> list[float]:
        parts, _ = make_parts(scene_from_dict(pair("external_gear_pair", SPUR | first, WHEEL | second,
                                                   normal_backlash=backlash), "s", "s"), "s")  # fmt: skip
        return [parts[name].thing.circumferential_thinning for name in "ab"]

    own = {"circumferential_thinning": 0.1}
    assert thinnings({}, {}, 0.2) == pytest.approx([0.1 / COS20] * 2)
    assert thinnings(own, {}, 0.2) == pytest.approx([0.1, 0.2 / COS20 - 0.1])
    assert thinnings({}, own, 0.2) == pytest.approx([0.2 / COS20 - 0.1, 0.1])
    both = pair("external_gear_pair", SPUR | own, WHEEL | own, normal_backlash=0.2 * COS20)
    assert refused(both) is None
    told = refused(with_key(both, "mates[1].normal_backlash", 0.2))
    assert told is not None
    assert (told.key, told.code) == ("mates[1].normal_backlash", "backlash_is_of_own_thinning")
    assert told.numbers["own"] == pytest.approx(0.2 * COS20)
    assert told.nearest is not None
    assert told.nearest.value is None
    check_limit(pair("external_gear_pair", SPUR | own, WHEEL, normal_backlash=0.2), "mates[1].normal_backlash",
                "backlash_already_more", 0.1 * COS20, "at_least", near=3e-5)  # fmt: skip


BY_HAND = """
[defaults]
module = 2.0
face_width = 8.0
[parts.sun]
kind = "spur_gear"
number_of_teeth = 20
[parts.satellite]
kind = "spur_gear"
number_of_teeth = 30
[parts.ring]
kind = "ring_gear"
number_of_teeth = 80
[instances.sun]
[instances.one]
part = "satellite"
[instances.two]
part = "satellite"
[instances.ring]
[[mates]]
kind = "external_gear_pair"
first = "sun"
second = "one"
[[mates]]
kind = "internal_gear_pair"
first = "one"
second = "ring"
direction_deg = 180.0
[[mates]]
kind = "external_gear_pair"
first = "sun"
second = "two"
direction_deg = {direction}
[[mates]]
kind = "internal_gear_pair"
first = "ring"
second = "two"
"""


@pytest.mark.parametrize(("direction", "goes_in"), [(33 * 3.6, True), (34 * 3.6, True), (120.0, False)])
def test_a_satellite_that_does_not_go_in_is_offered_no_key_that_its_mate_has_not(
    direction: float, goes_in: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """It goes in at whole parts of a turn, 360 / (20 + 80) degrees; a turn of its own would leave the other mesh."""
    file = tmp_path / "set.toml"
    file.write_text(BY_HAND.format(direction=direction))
    assert main(["check", str(file)]) == (0 if goes_in else 1)
    said = [line for line in capsys.readouterr().out.splitlines() if line.startswith("BROKEN")]
    assert len(said) == (not goes_in)
    for line in said:
        assert "rotation_deg" not in line
        stands, fits = map(float, re.findall(r"turned by (\S+) deg and would fit ring at (\S+) deg", line)[0])
        # a third of a tooth of the set off: by the ring's teeth 120 / 3.6 is no whole number
        assert math.remainder((stands - fits) * 30 / 360, 1) == pytest.approx(math.remainder(100 / 3, 1), abs=1e-6)


@pytest.mark.parametrize(("direction", "fits"), [(90.0, True), (91.0, False)])
@pytest.mark.parametrize("turned", [0.0, 5.0])
def test_a_ring_of_gears_that_does_not_close_is_offered_no_turn_of_the_first(
    direction: float, fits: bool, turned: float, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Four gears in a rhombus hang on the first: a turn of it leaves the last mesh as far off as before."""
    names = "abcd"
    ways = (0.0, direction, 180.0)
    pairs = [
        f'[[mates]]\nkind = "external_gear_pair"\nfirst = "{one}"\nsecond = "{two}"\n'
        + (f"direction_deg = {way}\n" if way is not None else "")
        for one, two, way in zip(names, "bcda", (*ways, None), strict=True)
    ]
    text = '[parts.g]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 21\nface_width = 8.0\n'
    text += "".join(
        f'[instances.{name}]\npart = "g"\n' + f"rotation_deg = {turned}\n" * (name == "a") for name in names
    )
    file = tmp_path / "ring.toml"
    file.write_text(text + "".join(pairs))
    assert main(["check", str(file)]) == (0 if fits else 1)
    said = [line for line in capsys.readouterr().out.splitlines() if line.startswith("BROKEN")]
    assert len(said) == (not fits)
    for line in said:
        assert "rotation_deg" not in line
        stands, would = map(float, re.findall(r"turned by (\S+) deg and would fit d at (\S+) deg", line)[0])
        assert (stands, would - stands) == (pytest.approx(turned), pytest.approx(4.0))

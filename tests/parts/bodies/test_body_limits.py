"""Turned, flat and layered bodies: every limit of their keys at both its sides, what they report, what moves."""

from __future__ import annotations

import cmath
import itertools
import math
from typing import Any

import numpy as np
import pytest

from geometry.base.errors import Nearest
from parts.base.part import Part
from parts.scene.load import make_parts, scene_from_dict
from tests.parts.limits import check_limit, check_offer, check_refused, offset_limits, refused, scene_of, with_key


def steps(*rows: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"kind": "shaft", "steps": list(rows), **more}


def step(diameter: float, length: float, **more: Any) -> dict[str, Any]:
    return {"diameter": diameter, "length": length, **more}


GROOVE = {"at": 10.0, "width": 2.0, "diameter": 16.0}
SHAFT = steps(step(20.0, 40.0, chamfer=1.0), step(28.0, 25.0), step(24.0, 30.0, chamfer=2.0))
GROOVED = steps(step(20.0, 40.0, chamfer=1.0, grooves=[GROOVE]), step(28.0, 25.0))
CENTRED = SHAFT | {"centre_holes": {"diameter": 2.0}}
KEYED = steps(step(20.0, 40.0, chamfer=1.0, fillet=0.5, keyways=[
    {"at": 5.0, "length": 20.0, "width": 6.0, "depth": 3.5}]), step(28.0, 25.0))  # fmt: skip
TUBE = KEYED | {"bore_diameter": 9.0}
TURNED: dict[str, Any] = {"kind": "turned", "points": [
    {"r": r, "z": z} for r, z in ((5.0, 0.0), (30.0, 0.0), (30.0, 8.0), (5.0, 8.0))]}  # fmt: skip
HOLED = TURNED | {"holes": {"count": 4, "diameter": 6.0, "pitch_circle_diameter": 40.0}}
PLATE: dict[str, Any] = {"kind": "plate", "width": 60.0, "height": 40.0, "face_width": 4.0}
CARRIER: dict[str, Any] = {"kind": "carrier_plate", "number_of_pins": 3, "pin_circle_diameter": 80.0,
                           "pin_diameter": 6.0, "face_width": 4.0}  # fmt: skip
WAY, GR = "steps[1].keyways[1]", "steps[1].grooves[1]"
# a keyway between the chamfer of its step and a groove's walls at 10 and 12
BETWEEN = steps(step(20.0, 40.0, chamfer=1.0, grooves=[GROOVE], keyways=[
    {"at": 15.0, "length": 10.0, "width": 3.0, "depth": 1.5}]), step(28.0, 25.0))  # fmt: skip
# degrees between keyways of half a width of 0.3 and a floor at 0.65 of the radius
APART = math.degrees(2 * math.atan(3 / 6.5))
UNLIKE = math.degrees(math.asin(3 / math.sqrt(82)) + math.atan(1 / 9))
RIM = math.sqrt(10**2 - 3**2)

LIMITS: list[tuple[dict[str, Any], str, str, float, str, dict[str, float]]] = [
    # bores below the thinnest place, grooves below their step
    (steps(step(28.0, 25.0), step(20.0, 40.0)), "bore_diameter", "leaves_no_wall", 20.0, "at_most", {}),
    (GROOVED, "bore_diameter", "leaves_no_wall", 16.0, "at_most", {}),
    (GROOVED, f"{GR}.diameter", "groove_not_in_step", 20.0, "at_most", {}),
    # amid the pilot of a centre hole, and amid its cone of 60 degrees
    (GROOVED | {"centre_holes": {"diameter": 2.0, "depth": 20.0}}, f"{GR}.diameter", "groove_into_centre_hole", 2.0,
     "at_least", {}),
    (GROOVED | {"centre_holes": {"diameter": 2.0, "mouth": 15.0}}, f"{GR}.diameter", "groove_into_centre_hole",
     15.0 - 20.0 * math.tan(math.pi / 6), "at_least", {}),
    # and from 10 to 12 of the last 40 mm, seen from the upper end
    (steps(step(28.0, 25.0), step(20.0, 40.0, grooves=[GROOVE | {"at": 28.0}])) | {
        "centre_holes": {"diameter": 2.0, "mouth": 15.0}}, "steps[2].grooves[1].diameter", "groove_into_centre_hole",
     15.0 - 20.0 * math.tan(math.pi / 6), "at_least", {}),
    # a keyway from 5 to 25 of 65 mm: its floor above the cone at its lower end
    (KEYED | {"centre_holes": {"diameter": 2.0, "mouth": 15.0}}, f"{WAY}.depth", "groove_into_centre_hole",
     2.5 + 5.0 * math.tan(math.pi / 6), "at_most", {}),
    # the cone of a centre hole is wider than its pilot and leaves a rim of both end faces
    (CENTRED, "centre_holes.mouth", "mouth_within_pilot", 2.0, "at_least", {"diameter": 2.0}),
    (CENTRED, "centre_holes.mouth", "leaves_no_wall", 18.0, "at_most", {}),
    (steps(step(28.0, 25.0), step(20.0, 40.0, chamfer=3.0), centre_holes={"diameter": 2.0}), "centre_holes.mouth",
     "leaves_no_wall", 14.0, "at_most", {}),
    # holes of both ends meet by their tips of 120 degrees; a neck is thicker than the cone where it begins
    (steps(step(24.0, 10.0), centre_holes={"diameter": 3.0, "mouth": 6.0}), "centre_holes.depth", "centre_holes_meet",
     5.0 - 1.5 * math.sqrt(3) - 1.5 / math.sqrt(3), "at_most", {}),
    (steps(step(24.0, 30.0), centre_holes={"diameter": 6.0, "depth": 0.0}), "centre_holes.mouth",
     "centre_holes_meet", 6.0 + 2 * (15.0 - 3 / math.sqrt(3)) / math.sqrt(3), "at_most", {}),
    (steps(step(24.0, 3.0), step(10.0, 40.0), step(24.0, 5.0), centre_holes={"diameter": 2.0}), "centre_holes.mouth",
     "leaves_no_wall", 10.0 + 6.0 / math.sqrt(3), "at_most", {}),
    (SHAFT, "steps[1].chamfer", "chamfer_leaves_nothing_of_step", 10.0, "at_most", {}),
    (SHAFT | {"bore_diameter": 6.0}, "steps[1].chamfer", "chamfer_leaves_nothing_of_step", 7.0, "at_most", {}),
    (SHAFT | {"bore_diameter": 6.0}, "steps[3].chamfer", "chamfer_leaves_nothing_of_step", 9.0, "at_most", {}),
    # a floor below the rim and above the bore; longer than its round ends are wide
    (KEYED, f"{WAY}.depth", "keyway_of_no_depth", 10 - RIM, "at_least", {}),
    (TUBE, f"{WAY}.depth", "keyway_of_no_depth", 5.5, "at_most", {}),
    (KEYED, f"{WAY}.length", "keyway_shorter_than_wide", 6.0, "at_least", {"width": 6.0}),
    # off the chamfer or the fillet of its step, whichever is larger, at both ends; a groove's walls at 10 and 12
    (KEYED, f"{WAY}.at", "keyway_beyond_step", 1.0, "at_least", {"length": 40.0}),
    (KEYED, f"{WAY}.at", "keyway_beyond_step", 19.0, "at_most", {"length": 40.0}),
    (steps(step(20.0, 40.0, fillet=1.5, keyways=KEYED["steps"][0]["keyways"]), step(28.0, 25.0)), f"{WAY}.at",
     "keyway_beyond_step", 1.5, "at_least", {"length": 40.0}),
    (BETWEEN, f"{WAY}.at", "keyway_beyond_step", 12.0, "at_least", {"length": 40.0}),
    (steps(step(20.0, 40.0, grooves=[GROOVE], keyways=[{"at": 3.0, "length": 6.0, "width": 3.0, "depth": 1.5}])),
     f"{WAY}.at", "keyway_beyond_step", 4.0, "at_most", {"length": 40.0}),
    # a rounding as high as the step beside it, less that one's chamfer; as long as its own step, less a chamfer there
    (steps(step(20.0, 40.0, fillet=1.0), step(28.0, 25.0)), "steps[1].fillet", "corner_longer_than_edge", 4.0,
     "at_most", {}),
    (steps(step(20.0, 40.0, fillet=1.0), step(28.0, 25.0, chamfer=1.5)), "steps[1].fillet", "corner_longer_than_edge",
     2.5, "at_most", {}),
    (steps(step(20.0, 3.0, chamfer=0.5, fillet=1.0), step(28.0, 25.0)), "steps[1].fillet", "corner_longer_than_edge",
     2.5, "at_most", {}),
    (steps(step(20.0, 3.0, chamfer=0.5, fillet=1.0), step(28.0, 25.0)), "steps[1].chamfer", "corner_longer_than_edge",
     2.0, "at_most", {}),
    # one chamfer at both ends of a step that stands out
    (steps(step(20.0, 40.0), step(28.0, 1.8, chamfer=0.5), step(20.0, 9.0)), "steps[2].chamfer",
     "corner_longer_than_edge", 0.9, "at_most", {}),
    # both roundings of a groove's bottom, 2 wide; its walls, 0.8 deep
    (GROOVED, f"{GR}.fillet", "corner_longer_than_edge", 1.0, "at_most", {}),
    (steps(step(20.0, 40.0, grooves=[GROOVE | {"diameter": 18.4}])), f"{GR}.fillet", "corner_longer_than_edge", 0.8,
     "at_most", {}),
    (TURNED, "points[2].chamfer", "corner_longer_than_edge", 8.0, "at_most", {}),
    # touches lines that meet at 60 degrees: as long as the shorter one's 10, by tan(30)
    ({"kind": "turned", "points": [{"r": 5.0, "z": 0.0}, {"r": 15.0, "z": 0.0}, {"r": 10.0, "z": 5 * math.sqrt(3)},
                                   {"r": 5.0, "z": 5 * math.sqrt(3)}]},
     "points[2].fillet", "corner_longer_than_edge", 10 * math.tan(math.pi / 6), "at_most", {}),
    # a hollow rounding between a cone and a face that is 3 wide, about a point of the axis
    ({"kind": "turned", "points": [{"r": 0.0, "z": 0.0}, {"r": 20.0, "z": 0.0}, {"r": 20.0, "z": 30.0},
                                   {"r": 3.0, "z": 10.0}, {"r": 0.0, "z": 10.0}]},
     "points[4].fillet", "arc_about_beyond_axis", 3 / math.tan(math.atan2(20, 17) / 2), "at_most", {}),
    (PLATE, "corner_radius", "rounding_above_half_side", 20.0, "at_most", {}),
    (PLATE | {"engraved": [{"start": [0, 0], "end": [5, 0], "width": 1.0}]}, "engraved[1].depth",
     "engraved_too_deep", 2.0, "at_most", {}),
    # round ends of 2.4 pins: sides of neighbours meet at 7.2 / sin(60), of arms of 7.2 and 3.6 at right angles at their
    # corner
    (CARRIER, "hub_diameter", "arms_meet", 2 * 7.2 / math.sin(math.pi / 3), "at_least", {}),
    (CARRIER | {"number_of_pins": 2, "spacers": {"count": 2, "pitch_circle_diameter": 60.0, "diameter": 3.0,
                                                 "start_deg": 90.0}},
     "hub_diameter", "arms_meet", 2 * math.hypot(7.2, 3.6), "at_least", {}),
]  # fmt: skip


@pytest.mark.parametrize(
    ("part", "key", "code", "limit", "side", "numbers"), LIMITS, ids=[f"{r[0]['kind']} {r[1]} {r[2]}" for r in LIMITS]
)
def test_a_limit_is_told_and_holds(
    part: dict[str, Any], key: str, code: str, limit: float, side: str, numbers: dict[str, float]
) -> None:
    check_limit(scene_of(part), f"parts.p.{key}", code, limit, side, **numbers)


@pytest.mark.parametrize(
    ("part", "key", "offer"),
    [
        # 1.499999 of a shoulder of 2.5 less its rounding of 1 was offered, though 1.5 builds
        (steps(step(25.0, 18.0, fillet=1.0), step(30.0, 40.0, chamfer=1.6)), "steps[2].chamfer", 1.5),
        (steps(step(20.0, 40.0), step(28.0, 1.8, chamfer=1.0), step(20.0, 9.0)), "steps[2].chamfer", 0.9),
        (steps(step(20.0, 40.0, grooves=[GROOVE | {"fillet": 1.1}])), f"{GR}.fillet", 1.0),
    ],
)
def test_an_edge_may_be_used_up_and_the_offer_says_so(part: dict[str, Any], key: str, offer: float) -> None:
    refusal = refused(scene_of(part))
    assert refusal is not None
    assert (refusal.key, refusal.nearest) == (f"parts.p.{key}", Nearest(offer, "at_most"))
    assert refused(with_key(scene_of(part), f"parts.p.{key}", offer)) is None


def test_a_keyway_that_no_place_is_long_enough_for_is_shorter_where_it_is() -> None:
    """From the groove to the chamfer there are 27 mm, behind its place 24."""
    check_offer(scene_of(BETWEEN), f"parts.p.{WAY}.length", 30.0, "keyway_beyond_step", 24.0, "at_most", length=40.0)


@pytest.mark.parametrize(
    ("part", "key", "value", "limit"),
    [
        # pins of 6 on a circle of 80 reach to 37: a bore just too wide was told as pins of 0.9999
        (CARRIER, "bore_diameter", 79.0, 74.0),
        (CARRIER, "bore_diameter", 90.0, 74.0),
        (CARRIER | {"outer_diameter": 100.0}, "bore_diameter", 79.0, 74.0),
        (CARRIER | {"bore_diameter": 20.0}, "pin_diameter", 66.0, 60.0),
    ],
)
def test_of_a_bore_and_the_pins_that_it_meets_the_one_is_told_that_has_to_change_less(
    part: dict[str, Any], key: str, value: float, limit: float
) -> None:
    check_offer(scene_of(part), f"parts.p.{key}", value, "hole_reaches_edge", limit, "at_most")


# limits of which no value is told: key, the last value that is made, the first that is refused, its code, numbers
WITHOUT: list[tuple[dict[str, Any], str, float, float, str, dict[str, float]]] = [
    # grooves between both chamfers of their step, behind the one before
    (GROOVED, f"{GR}.at", 1.001, 1.0, "groove_beyond_step", {"least": 1.0, "length": 40.0}),
    (GROOVED, f"{GR}.at", 36.999, 37.0, "groove_beyond_step", {"least": 1.0, "length": 40.0}),
    (steps(step(20.0, 40.0, grooves=[GROOVE | {"at": 20.0}, GROOVE])), "steps[1].grooves[1].at", 12.001, 12.0,
     "groove_beyond_step", {"least": 12.0, "length": 40.0}),
    # two alike beside each other: a corner of each floor in the plane between them
    (KEYED | {"steps": [KEYED["steps"][0] | {"keyways": [KEYED["steps"][0]["keyways"][0] | {"angle_deg": a}
                                                         for a in (0.0, 90.0)]}]},
     "steps[1].keyways[2].angle_deg", APART + 1e-6, APART - 1e-6, "keyways_meet", {}),
    # a narrow one, 1 deep, beside it: a corner of its floor, 9 and 1, is 3 off the other's middle plane
    (KEYED | {"steps": [KEYED["steps"][0] | {"keyways": [
        KEYED["steps"][0]["keyways"][0] | keys for keys in ({"angle_deg": 0.0}, {"width": 2.0, "depth": 1.0,
                                                                                "length": 10.0})]}]},
     "steps[1].keyways[2].angle_deg", UNLIKE + 1e-6, UNLIKE - 1e-6, "keyways_meet", {}),
    (KEYED | {"steps": [KEYED["steps"][0] | {"keyways": [
        KEYED["steps"][0]["keyways"][0] | keys for keys in ({"angle_deg": 0.0}, {"width": 2.0, "depth": 1.0,
                                                                                "length": 10.0})]}]},
     "steps[1].keyways[2].angle_deg", -UNLIKE - 1e-6, -UNLIKE + 1e-6, "keyways_meet", {}),
    # behind each other they may stand in one direction
    (KEYED | {"steps": [KEYED["steps"][0] | {"keyways": [KEYED["steps"][0]["keyways"][0] | {"at": at, "length": 8.0}
                                                         for at in (4.0, 20.0)]}]},
     "steps[1].keyways[2].at", 12.001, 12.0, "keyways_meet", {}),
    # holes of turned parts stand apart
    (TURNED | {"holes": [{"count": 1, "diameter": 6.0, "pitch_circle_diameter": 40.0},
                         {"count": 1, "diameter": 4.0, "pitch_circle_diameter": 30.0}]},
     "holes[1].pitch_circle_diameter", 40.001, 40.0, "hole_reaches_edge", {}),
    (CARRIER, "hub_diameter", 79.999, 80.0, "hub_reaches_pins", {"circle": 80.0}),
    # as it was: what touched an edge or a hole in one point was built, and its STEP was no valid solid
    (PLATE | {"holes": [{"at": [20.0, 0.0], "diameter": 4.0}]}, "holes[1].diameter", 19.999, 20.0,
     "hole_reaches_edge", {}),
    (PLATE | {"holes": [{"at": [at, 0.0], "diameter": 4.0} for at in (0.0, 10.0)]}, "holes[2].diameter", 15.999, 16.0,
     "hole_reaches_edge", {}),
    (PLATE | {"slots": [{"start": [0.0, 10.0], "end": [8.0, 10.0], "width": 4.0}]}, "slots[1].width", 19.999, 20.0,
     "hole_reaches_edge", {}),
    (PLATE | {"engraved": [{"start": [0.0, 10.0], "end": [8.0, 10.0], "width": 4.0}]}, "engraved[1].width", 19.999,
     20.0, "hole_reaches_edge", {}),
]  # fmt: skip


@pytest.mark.parametrize(("part", "key", "within", "beyond", "code", "numbers"), WITHOUT)
def test_a_limit_that_no_value_is_told_of_holds(
    part: dict[str, Any], key: str, within: float, beyond: float, code: str, numbers: dict[str, float]
) -> None:
    raw, place = scene_of(part), f"parts.p.{key}"
    assert refused(with_key(raw, place, within)) is None
    refusal = refused(with_key(raw, place, beyond))
    assert refusal is not None
    assert refusal.code == code
    if code not in ("keyways_meet", "hole_reaches_edge"):
        assert (refusal.key, refusal.value) == (place, beyond)
    assert refusal.numbers == numbers


def test_a_groove_is_named_as_it_is_written() -> None:
    """As it was: by its place along the step, where the scene has them in another order."""
    wrong = steps(step(20.0, 40.0, grooves=[GROOVE | {"at": 20.0, "diameter": 21.0}, GROOVE]))
    refusal = refused(scene_of(wrong))
    assert refusal is not None
    assert refusal.key == "parts.p.steps[1].grooves[1].diameter"


REFUSED: list[tuple[dict[str, Any], str, object, str, object]] = [
    (CENTRED, "bore_diameter", 3.0, "either_key", 0.0),
    (CARRIER | {"outer_diameter": 100.0}, "hub_diameter", 50.0, "is_round_already", None),
    # beside an arc, and on the axis, where the solid has no corner
    ({"kind": "turned", "points": [{"r": 0.0, "z": 0.0, "arc": 5.0}, {"r": 5.0, "z": 5.0}, {"r": 0.0, "z": 5.0}]},
     "points[2].fillet", 0.5, "corner_of_an_arc", 0.0),
    ({"kind": "turned", "points": [{"r": 0.0, "z": 0.0}, {"r": 5.0, "z": 5.0}, {"r": 0.0, "z": 5.0}]},
     "points[1].chamfer", 0.5, "corner_is_straight", 0.0),
    (CARRIER, "directions_deg", [0.0, 90.0], "not_one_a_pin", ...),
    # no key that is as wide as DIN 6885 wants it is known for a shaft of 3
    (steps(step(20.0, 40.0, keyways=[{"at": 5.0, "length": 20.0}])), "steps[1].diameter", 3.0, "no_keyway_row", ...),
]  # fmt: skip


@pytest.mark.parametrize(("part", "key", "value", "code", "works"), REFUSED)
def test_keys_that_do_not_go_together_are_told(
    part: dict[str, Any], key: str, value: object, code: str, works: object
) -> None:
    raw = scene_of(part)
    if code == "no_keyway_row":
        found = refused(with_key(raw, f"parts.p.{key}", value))
        assert found is not None
        assert found.key == f"parts.p.{key}"
        return
    check_refused(raw, f"parts.p.{key}", value, code, works)


def part_of(part: dict[str, Any]) -> Part:
    return make_parts(scene_from_dict(scene_of(part), "s", "s"), "s")[0]["p"]


def test_turned_bodies_report_what_they_are() -> None:
    assert part_of(SHAFT).quantities == {"outer_diameter": 28.0, "length": 95.0}
    assert part_of(SHAFT | {"bore_diameter": 6.0}).quantities == {
        "outer_diameter": 28.0, "bore_diameter": 6.0, "length": 95.0}  # fmt: skip
    assert part_of(TURNED).quantities == {"outer_diameter": 60.0, "bore_diameter": 10.0, "length": 8.0}
    assert part_of(CARRIER).circles == {"pin_circle_diameter": 80.0}
    assert part_of(CARRIER).quantities == {"number_of_pins": 3.0, "pin_diameter": 6.0}
    assert not part_of(TURNED).is_plate


def test_bodies_are_seen_along_their_axis_with_all_that_goes_through() -> None:
    """A ring of walls inside, between and outside of its holes; a tube between bore and outside."""
    region = part_of(HOLED).section(0.0).region
    assert region.outer.reach() == pytest.approx(30.0)
    assert len(region.holes) == 5
    centres = sorted(((s.curve.centre.real, s.curve.centre.imag) for p in region.holes  # type: ignore[attr-defined]
                      for s in p.period[:1]), key=lambda c: (round(c[0], 6), round(c[1], 6)))  # fmt: skip
    assert np.ravel(centres) == pytest.approx([-20, 0, 0, -20, 0, 0, 0, 20, 20, 0], abs=1e-9)
    offset_limits(HOLED, (23 - 30) / 2, 3.0)
    offset_limits(SHAFT | {"bore_diameter": 6.0}, (3 - 14) / 2, 3.0)
    with pytest.raises(ValueError, match="turned_as_it_is"):
        part_of(TURNED).body(0.1)


def volume(part: dict[str, Any]) -> float:
    made = part_of(part)
    return float(made.made_by.moments(made.body(0.0)).volume)


def cone(low: float, high: float, length: float) -> float:
    """A frustum between two diameters."""
    return math.pi * length / 12 * (low**2 + low * high + high**2)


def test_volumes_of_shafts_are_those_of_their_pieces() -> None:
    """Cylinders, frustums at chamfers, rings at grooves; pilots with their cones of 60 and tips of 120 degrees."""
    plain = cone(18, 20, 1) + cone(20, 20, 39) + cone(28, 28, 25) + cone(24, 24, 28) + cone(24, 20, 2)
    assert volume(SHAFT) == pytest.approx(plain, rel=1e-12)
    assert volume(SHAFT | {"bore_diameter": 6.0}) == pytest.approx(plain - cone(6, 6, 95), rel=1e-12)
    ring = cone(20, 20, 2) - cone(16, 16, 2)
    one = cone(18, 20, 1) + cone(20, 20, 39) + cone(28, 28, 25)
    assert volume(GROOVED) == pytest.approx(one - ring, rel=1e-12)
    for more, mouth, depth in (({}, 4.24, 2.0), ({"mouth": 5.0, "depth": 0.5}, 5.0, 0.5), ({"depth": 0.0}, 4.24, 0.0)):
        centre = {"diameter": 2.0, **more}
        leg = (mouth - 2.0) / 2 / math.tan(math.radians(30))
        hole = cone(mouth, 2.0, leg) + cone(2.0, 2.0, depth) + cone(2.0, 0.0, 1 / math.tan(math.radians(60)))
        assert volume(SHAFT | {"centre_holes": centre}) == pytest.approx(plain - 2 * hole, rel=1e-12)


def test_a_fillet_stands_in_the_corner_below_the_higher_step() -> None:
    """Of the lower of both steps: (1 - pi/4) r^2 turned about the axis at the distance of its centre of area."""
    for rows, radius in (((step(20.0, 40.0, fillet=2.0), step(28.0, 25.0)), 10.0),
                         ((step(28.0, 25.0), step(20.0, 40.0, fillet=2.0)), 10.0)):  # fmt: skip
        area = (1 - math.pi / 4) * 4
        # a square less a quarter of a circle about its far corner
        at = (4 * 1.0 - math.pi * (2 - 8 / (3 * math.pi))) / area
        bare = cone(20, 20, 40) + cone(28, 28, 25)
        assert volume(steps(*rows)) == pytest.approx(bare + 2 * math.pi * (radius + at) * area, rel=1e-9)


UPPER = {"thickness": 3.0, "polygons": [{"points": [[-20.0, -17.0], [50.0, -17.0], [50.0, 20.0], [-20.0, 20.0]]}]}
LAYER: dict[str, Any] = {"kind": "layered", "layers": [{"thickness": 4.0, "circles": [{"diameter": 30.0}]}, UPPER]}


def layer(**table: Any) -> dict[str, Any]:
    return {"kind": "layered", "layers": [{"thickness": 2.0, **table}]}


def points(*rows: tuple[float, ...]) -> list[dict[str, float]]:
    return [dict(zip(("x", "y", "arc"), row, strict=False)) for row in rows]


def test_layers_report_their_box_and_hold_what_their_outlines_enclose() -> None:
    assert part_of(LAYER).quantities == {"width": 70.0, "height": 37.0, "length": 7.0}
    assert not part_of(LAYER).is_plate
    square = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]]
    for corners in (square, square[::-1]):
        assert volume(layer(polygons=[{"points": corners}])) == pytest.approx(72.0)
        rounded = 36 - (4 - math.pi) * 1.5**2
        assert volume(layer(polygons=[{"points": corners, "corner_radius": 1.5}])) == pytest.approx(2 * rounded)
    assert volume(layer(slots=[{"start": [1, 2], "end": [5, 5], "width": 2.0}])) == pytest.approx(2 * (10 + math.pi))
    # a segment over a chord of 6, of radius 5: 25 asin(0.6) - 3 * 4
    cap = 25 * math.asin(0.6) - 12
    corners = [(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (0.0, 6.0)]
    for rows in (corners, corners[::-1]):
        for arc, area in ((0.0, 36.0), (5.0, 36 + cap), (-5.0, 36 - cap), (3.0, 36 + 4.5 * math.pi)):
            made = layer(outlines=[{"points": points((*rows[0], arc), *rows[1:])}])
            # above 0 it bulges out, whichever way round the points are written
            assert volume(made) == pytest.approx(2 * area), (rows, arc)
    # of two points: a circle of two halves, a lens
    assert volume(layer(outlines=[{"points": points((0, 0, 3), (6, 0, 3))}])) == pytest.approx(2 * 9 * math.pi)
    assert volume(layer(outlines=[{"points": points((0, 0, 5), (6, 0, 5))}])) == pytest.approx(4 * cap)


OUTLINE = layer(outlines=[{"points": points((0, 0, 5), (6, 0), (6, 6), (0, 6))}])
NOTHING = "layers[1].outlines[1].points"


def test_outlines_that_enclose_nothing_and_arcs_below_their_chords_are_refused() -> None:
    arc = "parts.p.layers[1].outlines[1].points[1].arc"
    check_limit(scene_of(OUTLINE), arc, "arc_shorter_than_chord", 3.0, "at_least")
    mirrored = with_key(scene_of(OUTLINE), arc, -5.0)
    check_limit(mirrored, arc, "arc_shorter_than_chord", -3.0, "at_most")
    for rows in (((0, 0), (6, 0), (6, 0), (0, 6)), ((0, 0), (6, 0)), ((0, 0, 5), (6, 0, -5)), ((0, 0, -5), (6, 0, -5))):
        found = refused(scene_of(layer(outlines=[{"points": points(*rows)}])))
        assert found is not None
        assert (found.key, found.code, found.value) == (f"parts.p.{NOTHING}", "outline_of_nothing", len(rows))
    found = refused(scene_of(layer()))
    assert found is not None
    assert (found.key, found.code) == ("parts.p.layers[1]", "layer_of_nothing")


def turned_on(count: int, *rows: tuple[float, ...]) -> dict[str, Any]:
    return layer(outlines=[{"points": points(*rows), "count": count}])


def test_corners_stand_about_the_axis_as_often_as_they_are_told_to() -> None:
    """A ratchet wheel of two corners a tooth is so many triangles; corners with arcs make what is typed in full."""
    for count in (3, 16):
        teeth = count * 20 * 16 * math.sin(math.tau / count) / 2
        assert volume(turned_on(count, (20, 0), (16, 0))) == pytest.approx(2 * teeth, rel=1e-12)
        assert volume(turned_on(count, (16, 0), (20, 0))) == pytest.approx(2 * teeth, rel=1e-12)
    tooth = ((10.0, 0.0, -2.0), (9.0, 3.0, 4.0), (8.0, 5.0))
    (c, s) = math.cos(math.tau / 5), math.sin(math.tau / 5)
    rows = list(tooth)
    for _ in range(4):
        rows += [(x * c - y * s, x * s + y * c, *arc) for x, y, *arc in rows[-3:]]
    full = volume(layer(outlines=[{"points": points(*rows)}]))
    assert volume(turned_on(5, *tooth)) == pytest.approx(full, rel=1e-12)


def test_a_tooth_told_clockwise_is_turned_where_it_makes_no_outline_as_it_stands() -> None:
    """Equal volumes either way round; a hooked tooth, which runs back a little, stands as it is told."""
    tooth = ((8.0, 0.0, -2.0), (9.0, 1.0, 0.0), (9.0, 3.0, 4.0), (6.4, 4.8))
    back = ((6.4, 4.8, 4.0), (9.0, 3.0, 0.0), (9.0, 1.0, -2.0), (8.0, 0.0))
    assert volume(turned_on(5, *back)) == pytest.approx(volume(turned_on(5, *tooth)), rel=1e-12)
    # an arc that reaches the next corner clockwise alone was refused as too short
    lead = cmath.rect(20.0, math.radians(3))
    lone = turned_on(12, (16.0, 0.0, 3.0), (lead.real, lead.imag))
    end = lead * cmath.rect(1.0, math.radians(-30))
    assert volume(turned_on(12, (16.0, 0.0), (end.real, end.imag, 3.0))) == pytest.approx(volume(lone), rel=1e-12)
    hook = (20.0, 0.0), (16.0, -1.0)
    step = cmath.rect(1.0, math.tau / 16)
    ends = (20 + 0j, 16 - 1j, 20 * step)
    shoelace = sum((a.conjugate() * b).imag for a, b in itertools.pairwise(ends)) / 2
    assert volume(turned_on(16, *hook)) == pytest.approx(16 * 2 * shoelace, rel=1e-12)


def test_an_outline_that_meets_itself_is_refused_by_its_key() -> None:
    """``check`` passed it, and files blamed their tolerance."""
    bow, touching = ((0, 0), (10, 10), (10, 0), (0, 9)), ((0, 0), (10, 0), (10, 10), (5, 0), (0, 10))
    twice = ((0, 0), (10, 0), (5, 5), (10, 10), (0, 10), (5, 5))
    for rows in (bow, bow[::-1], touching, twice):
        found = refused(scene_of(layer(outlines=[{"points": points(*rows)}])))
        assert found is not None
        assert (found.key, found.code) == (f"parts.p.{NOTHING}", "boundary_crosses_itself")
        found = refused(scene_of(layer(polygons=[{"points": [list(row) for row in rows]}])))
        assert found is not None
        assert (found.key, found.code) == ("parts.p.layers[1].polygons[1].points", "boundary_crosses_itself")
    # a tooth that is fifty degrees long goes about the axis seven times, not eight
    end = 19 * math.cos(math.radians(50)), 19 * math.sin(math.radians(50))
    assert refused(scene_of(turned_on(7, (20, 0), (16, 0), end))) is None
    found = refused(scene_of(turned_on(8, (20, 0), (16, 0), end)))
    assert found is not None
    assert (found.key, found.code) == ("parts.p.layers[1].outlines[1].count", "boundary_crosses_itself")


def test_corners_that_are_too_many_are_told_how_often_they_may_stand() -> None:
    count = "parts.p.layers[1].outlines[1].count"
    raw = scene_of(turned_on(700, (20, 0), (16, 0), (16.1, 0.1)))
    check_refused(raw, count, 700, "outline_of_too_many_points", 666, most=2000)


def test_a_side_that_is_too_short_for_its_axles_is_told_how_long_it_has_to_be() -> None:
    """A hole of 6 mm at 28 from the middle: 62 and two walls of 0.05; the plate that grows holds it as it is."""
    wheel = {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 20, "bore_diameter": 5.0}
    frame = PLATE | {"width": 50.0, "holes": [{"axis_of": "w", "diameter": 6.0}]}
    raw = {"parts": {"w": wheel, "f": frame}, "instances": {"w": {"part": "w", "at": [28.0, 3.0, 0.0]}},
           "exports": [{"format": "svg"}]}  # fmt: skip
    found = refused(raw)
    assert found is not None
    assert (found.key, found.code, found.value) == ("parts.f.width", "hole_of_axle_outside", 50.0)
    assert {name: found.numbers[name] for name in ("axle", "x", "y")} == {"axle": "w", "x": 28.0, "y": 3.0}
    assert found.nearest is not None
    assert found.nearest.side == "at_least"
    assert found.nearest.value == pytest.approx(62.0, abs=0.11)
    assert refused(with_key(raw, "parts.f.width", found.nearest.value)) is None
    assert refused(with_key(raw, "parts.f.width", 62.0 - 1e-3)) is not None
    grown = make_parts(scene_from_dict(with_key(raw, "parts.f.beyond_axles", 9.0), "s", "s"), "s")[0]["f"]
    corners = [complex(s.curve.point(s.curve.domain[0])) for s in grown.section(0.0).region.outer.segments()]
    assert max(p.real for p in corners) == pytest.approx(37.0)
    assert min(p.real for p in corners) == pytest.approx(-25.0)
    assert max(p.imag for p in corners) == pytest.approx(20.0)
    # without a hole of an axle it did nothing
    without_axles = refused({"parts": {"f": PLATE | {"beyond_axles": 9.0}}, "exports": [{"format": "svg"}]})
    assert without_axles is not None
    assert (without_axles.key, without_axles.code) == ("parts.f.beyond_axles", "needs_other")


def test_what_is_cut_where_no_part_is_is_told_by_its_place() -> None:
    """In a plate of 60 x 40; what lies within and is too large is told by its size."""
    slot = {"start": [0.0, 0.0], "end": [50.0, 0.0], "width": 2.0}
    cases: dict[str, tuple[dict[str, Any], str, object]] = {
        "holes": ({"at": [45.0, 0.0], "diameter": 3.0}, ".at", [45.0, 0.0]),
        "slots": (slot, "", {"start": [0.0, 0.0], "end": [50.0, 0.0]}),
        "engraved": (slot | {"depth": 1.0}, "", {"start": [0.0, 0.0], "end": [50.0, 0.0]}),
    }
    for key, (table, place, value) in cases.items():
        found = refused(scene_of(PLATE | {key: [table]}))
        assert found is not None
        assert (found.key, found.code) == (f"parts.p.{key}[1]{place}", "hole_lies_outside")
        assert found.value == value
        assert found.nearest is None
    within = refused(scene_of(PLATE | {"holes": [{"at": [20.0, 0.0], "diameter": 30.0}]}))
    assert within is not None
    assert (within.key, within.code) == ("parts.p.holes[1].diameter", "hole_reaches_edge")


GRID = {"at": [-25.0, -15.0], "diameter": 4.0, "columns": 6, "rows": 4, "pitch": 10.0}


def test_a_grid_of_holes_is_what_holes_typed_one_by_one_are() -> None:
    places = [[-25.0 + 10.0 * i, -15.0 + 8.0 * j] for j in range(4) for i in range(6)]
    typed = PLATE | {"holes": [{"at": at, "diameter": 4.0} for at in places]}
    assert volume(PLATE | {"holes": [GRID | {"row_pitch": 8.0}]}) == pytest.approx(volume(typed), rel=1e-13)
    row = PLATE | {"holes": [GRID | {"columns": 1, "rows": 3, "pitch": 12.0}]}
    assert volume(row) == pytest.approx(volume(PLATE) - 3 * 4 * math.pi * PLATE["face_width"], rel=1e-12)


def test_a_grid_of_holes_is_refused_by_the_key_that_cures_it() -> None:
    """In a plate of 60 x 40 with holes 5 mm off its edge."""

    def scene(**more: Any) -> dict[str, Any]:
        return scene_of(PLATE | {"holes": [{k: v for k, v in (GRID | more).items() if v is not None}]})

    def place(key: str) -> str:
        return f"parts.p.holes[1].{key}"

    check_refused(scene(columns=7), place("columns"), 7, "grid_lies_outside", 6)
    check_refused(scene(rows=9), place("rows"), 9, "grid_lies_outside", 4)
    check_offer(scene(pitch=11.0), place("pitch"), 11.0, "grid_lies_outside", 53 / 5, "at_most")
    check_refused(scene(row_pitch=12.0), place("rows"), 4, "grid_lies_outside", 3)
    for hole in (4.0, 3.0, 7.1, 0.3):
        tight = scene(diameter=hole, pitch=hole / 2)
        check_offer(tight, place("pitch"), hole / 2, "grid_holes_meet", hole + 2e-6, "at_least")
    # where neither number alone cures it, whatever the digits of the diameter
    corner = scene(at=[0.0, 0.0], columns=3, rows=3, diameter=3.0)
    check_offer(corner, place("pitch"), 50.0, "grid_lies_outside", 18.5 / 2, "at_most")
    large = scene(at=[-20.0, -10.0], columns=2, rows=2, diameter=12.0)
    check_offer(large, place("pitch"), 10.0, "grid_holes_meet", 12.0 + 2e-6, "at_least")
    # no pitch is wide enough in the plate: before, it was blamed all the same
    check_offer(scene(diameter=15.0), place("diameter"), 15.0, "grid_holes_meet", 10 - 3e-6, "at_most")
    # before: `at`, which no place cures, and the three rows
    check_offer(scene(rows=2, row_pitch=90.0), place("row_pitch"), 90.0, "grid_lies_outside", 33.0, "at_most")
    check_refused(scene(columns=1000), place("columns"), 1000, "grid_of_too_many_holes", 6)
    check_refused(scene(rows=500), place("rows"), 500, "grid_of_too_many_holes", 4)
    for wrong, key, code in (
        (scene(pitch=None), "pitch", "grid_needs_pitch"),
        (scene(columns=40, rows=30), "columns", "grid_of_too_many_holes"),
        (scene(columns=1, rows=1), "pitch", "only_of_a_grid"),
        (scene(rows=1, row_pitch=5.0), "row_pitch", "only_of_a_grid"),
        (scene(at=[-40.0, 0.0]), "at", "grid_lies_outside"),
    ):
        found = refused(wrong)
        assert found is not None
        assert (found.key, found.code) == (place(key), code)

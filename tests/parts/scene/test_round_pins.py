"""Parts and mates around round pins: places, ratios, verdicts, refusals that name what works."""

from __future__ import annotations

import cmath
import math
import re
from typing import Any

import numpy as np
import pytest

from exporters.production.check import scene_checks
from exporters.production.check_lines import check_lines, has_bad_verdict
from geometry.plane.distance import Boundary
from parts.base.refusal import SceneError
from parts.scene.load import KINDS, load_scene, make_parts, resolved, scene_from_dict, scene_from_resolved
from parts.scene.placing import Placing, place
from tests.sampling import some_of

Keys = dict[str, Any]
RING: Keys = {
    "kind": "pin_ring", "number_of_pins": 12, "pin_circle_diameter": 80.0, "pin_diameter": 8.0, "pins": "fixed",
    "inner_diameter": 83.0,
}  # fmt: skip
DISC: Keys = {
    "kind": "cycloidal_disc", "number_of_lobes": 11, "pin_circle_diameter": 80.0, "pin_diameter": 8.0,
    "eccentricity": 2.5, "bore_diameter": 22.0,
    "output_holes": {"count": 6, "pitch_circle_diameter": 46.0, "pin_diameter": 6.0},
}  # fmt: skip
PLATE: Keys = {"kind": "output_plate", "number_of_pins": 6, "pin_circle_diameter": 46.0, "pin_diameter": 6.0}
ECCENTRIC: Keys = {"kind": "eccentric", "diameter": 22.0, "eccentricity": 2.5, "bore_diameter": 6.0}
PIN: Keys = {"kind": "pin", "diameter": 8.0, "length": 10.0}
LANTERN: Keys = {"kind": "lantern_wheel", "number_of_pins": 10, "pin_circle_diameter": 60.0, "pin_diameter": 8.0}
GEAR: Keys = {
    "kind": "lantern_gear", "number_of_teeth": 30, "number_of_pins": 10, "pin_circle_diameter": 60.0,
    "pin_diameter": 8.0,
}  # fmt: skip
INNER: Keys = DISC["output_holes"] | {"pitch_circle_diameter": 40.0}
HOLES: Keys = {"count": 6, "diameter": 15.0, "pitch_circle_diameter": 46.0, "start_deg": 30.0}
PARTS: dict[str, Keys] = {
    "ring": RING, "disc": DISC, "plate": PLATE, "eccentric": ECCENTRIC, "pin": PIN, "lantern": LANTERN, "gear": GEAR
}  # fmt: skip


def scene(
    parts: dict[str, Keys], mates: list[Keys] | None = None, instances: dict[str, Keys] | None = None, **more: Any
):
    """A scene of tables."""
    tables = {"parts": parts, "mates": mates or [], "instances": instances or {}, **more}
    return scene_from_dict(tables, "t", "t")


def checked(*args: Any, contact: bool = True, **more: Any) -> tuple[Placing, dict[str, Any]]:
    """Where everything stands, and what the checks say."""
    made = scene(*args, **more)
    parts, matings = make_parts(made, "t")
    placing = place(made.instances, made.drives, parts, matings, "t")
    return placing, scene_checks(placing, parts, made.drives, "en", contact=contact)


REDUCER = [
    {"kind": "cycloidal_pair", "first": "ring", "second": "disc", "direction_deg": 40.0},
    {"kind": "coaxial", "first": "ring", "second": "eccentric", "rotation_deg": 30.0},
    {"kind": "eccentric_bearing", "first": "eccentric", "second": "disc"},
    {"kind": "output_pins", "first": "disc", "second": "plate", "direction_deg": 40.0},
    {"kind": "coaxial", "first": "ring", "second": "plate", "height": -10.0},
]
REDUCER_PARTS = {k: PARTS[k] for k in ("ring", "disc", "eccentric", "plate")}
TURNED = {"ring": {"rotation_deg": 10.0}, "eccentric": {}, "disc": {}, "plate": {}}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("pins", ["fixed", "half_round", "holes"])
def test_reducer_turns_and_touches(pins: str) -> None:
    ring = RING | {"pins": pins} | ({"inner_diameter": 0.0} if pins == "holes" else {})
    # a plate carries the disc on its face
    mates = [m | {"height": 10.0} if pins == "holes" and m["second"] == "eccentric" else m for m in REDUCER]
    drives = [{"instance": "eccentric", "turns": 11.0}]
    placing, checks = checked(REDUCER_PARTS | {"ring": ring}, mates, TURNED, drives=drives)
    assert not has_bad_verdict(checks) or pins == "holes"
    verdicts = [m.get("verdict") for m in checks["mates"]]
    assert verdicts == ["contact", None, "contact", "contact", None]
    assert checks["mates"][0]["pins_in_contact"] == 12
    assert placing.turns[0] == pytest.approx({"eccentric": 11.0, "disc": -1.0, "plate": -1.0})
    stand = {i.id: i for i in placing.instances}
    assert stand["disc"].centre == pytest.approx(2.5 * np.exp(1j * math.radians(40)))
    assert abs(stand["plate"].centre) <= 1e-12
    # a valley of the disc stands at every pin: seen from the ring's first pin on 10 degrees
    assert len(check_lines(checks, "uk")) >= 5


def test_disc_stands_in_its_pins_wherever_the_ring_is_turned() -> None:
    """Every pin of the placed ring is 4 mm from the placed disc."""
    for ring_turn, direction, lobes in ((0.0, 0.0, 0), (17.0, 200.0, 3), (-5.0, 77.0, -4)):
        mate = {"kind": "cycloidal_pair", "first": "ring", "second": "disc", "direction_deg": direction}
        tables = {"ring": {"rotation_deg": ring_turn}, "disc": {}}
        made = scene({"ring": RING, "disc": DISC}, [mate | {"turned_lobes": lobes}], tables)
        parts, matings = make_parts(made, "t")
        ring, disc = place(made.instances, [], parts, matings, "t").instances
        pins = 40 * np.exp(2j * math.pi * np.arange(12) / 12 + 1j * ring.rotation)
        local = (pins - disc.centre) * np.exp(-1j * disc.rotation)
        outline = Boundary(tuple(s.curve for s in parts["disc"].section(0.0).region.outer.segments()), closed=True)
        assert np.allclose(outline.feet(local).distance, 4.0, atol=1e-12)


SPOILED: dict[str, tuple[dict[str, Keys], list[Keys], dict[str, Keys], str]] = {
    "disc turned off": ({}, [], {"disc": {"at": [2.5, 0.0, 0.0], "rotation_deg": 16.9}}, "phase"),
    "disc off its place": ({}, [], {"disc": {"at": [2.6, 0.0, 0.0], "rotation_deg": 180 / 11}}, "centre_distance"),
    "lobes reach the ring": ({"ring": RING | {"inner_diameter": 81.0}}, [], {}, "overlap"),
}


@pytest.mark.parametrize("name", SPOILED)
def test_a_spoiled_reducer_is_told(name: str) -> None:
    parts, _, instances, what = SPOILED[name]
    mate = {"kind": "cycloidal_pair", "first": "ring", "second": "disc"}
    stand = {"ring": {"at": [0.0, 0.0, 0.0]}, "disc": {}} | instances
    _, checks = checked({"ring": RING, "disc": DISC} | parts, [mate], stand)
    assert has_bad_verdict(checks)
    found = checks["mates"][0]
    broken = [c["code"] for c in found.get("conditions", []) if not c["met"]]
    assert broken == [what] or found.get("verdict") == what
    if what == "overlap":
        # the finding names the diameter that clears the lobes
        (finding,) = found["findings"]
        assert finding["code"] == "lobes_reach_ring"
        parts = {"ring": RING | {"inner_diameter": finding["limit"]}, "disc": DISC}
        assert checked(parts, [mate], stand)[1]["mates"][0]["verdict"] == "contact"


def test_output_pins_are_held_against_their_holes() -> None:
    mates = [REDUCER[0] | {"direction_deg": 0.0}, REDUCER[3] | {"direction_deg": 0.0}]
    two = {"ring": RING, "disc": DISC, "plate": PLATE}
    verdicts: tuple[tuple[dict[str, float], str, float], ...] = (
        ({"pin_diameter": 6.01}, "overlap", -0.005),
        ({}, "contact", 0.0),
        ({"pin_diameter": 5.9}, "clear", 0.05),
    )
    for change, verdict, gap in some_of(verdicts):
        _, checks = checked(two | {"plate": PLATE | change}, mates)
        assert checks["mates"][1]["verdict"] == verdict
        assert checks["mates"][1]["gap"] == pytest.approx(gap, abs=1e-12)
        assert [f["code"] for f in checks["mates"][1]["findings"]] == ["output_holes_small"] * (gap < 0)
    # brute force: the placed pins in the placed holes over a turn of the eccentric, plate turned off
    at = {"disc": {"at": [2.5, 0.0, 0.0], "rotation_deg": 180 / 11}, "ring": {"at": [0.0, 0.0, 0.0]}}
    for turn in some_of((0.01, 0.0)):
        stand = {"plate": {"at": [0.0, 0.0, -10.0], "rotation_deg": 180 / 11 + turn}}
        _, checks = checked(two, mates, at | stand, contact=False)
        met = all(c["met"] for c in checks["mates"][1]["conditions"])
        assert met is (turn == 0.0)


def test_second_disc_lines_up_only_where_its_holes_do() -> None:
    again = {"kind": "cycloidal_pair", "first": "ring", "second": "upper", "direction_deg": 180.0, "height": 10.0}
    out = {"kind": "output_pins", "second": "plate"}
    parts = {"ring": RING | {"face_width": 20.0}, "disc": DISC, "plate": PLATE | {"pin_length": 20.0}}
    stand = {"ring": {}, "disc": {}, "upper": {"part": "disc"}, "plate": {}}
    for lobes, met in some_of(((6, True), (-5, True), (5, False), (0, False)), 2):
        mates = [
            REDUCER[0] | {"direction_deg": 0.0},
            again | {"turned_lobes": lobes},
            out | {"first": "disc"},
            out | {"first": "upper", "direction_deg": 180.0},
        ]
        _, checks = checked(parts, mates, stand, contact=False)
        assert all(c["met"] for c in checks["mates"][3]["conditions"]) is met, lobes


@pytest.mark.heavy
def test_a_second_disc_of_an_even_number_of_lobes_has_holes_of_its_own() -> None:
    """Ten lobes: the other disc stands half a lobe on, and so do its holes against its lobes."""
    ring = RING | {"number_of_pins": 11, "face_width": 20.0}
    disc = DISC | {"number_of_lobes": 10}
    for start, met in ((18.0, True), (0.0, False)):
        other = disc | {"output_holes": DISC["output_holes"] | {"start_deg": start}}
        parts = {"ring": ring, "disc": disc, "other": other, "plate": PLATE | {"pin_length": 20.0}}
        mates = [
            REDUCER[0] | {"direction_deg": 0.0},
            {"kind": "cycloidal_pair", "first": "ring", "second": "other", "direction_deg": 180.0, "height": 10.0},
            {"kind": "output_pins", "first": "disc", "second": "plate"},
            {"kind": "output_pins", "first": "other", "second": "plate", "direction_deg": 180.0},
        ]
        _, checks = checked(parts, mates)
        assert all(c["met"] for c in checks["mates"][3]["conditions"]) is met, start
        assert checks["mates"][1]["verdict"] == "contact"


def test_loose_pins_stand_in_their_seats() -> None:
    for holder in (RING | {"pins": "half_round"}, LANTERN | {"pins": "holes"}, PLATE | {"pins": "holes"}):
        size = {"pin": PIN | {"diameter": holder["pin_diameter"]}}
        mate = {"kind": "pin_seat", "first": "holder", "second": "pin", "number": 3}
        placing, checks = checked({"holder": holder} | size, [mate])
        angle = 4 * math.pi / holder["number_of_pins"]
        right = holder["pin_circle_diameter"] / 2 * np.exp(1j * angle)
        assert placing.instances[1].centre == pytest.approx(right)
        assert not has_bad_verdict(checks)


def test_lantern_pair() -> None:
    mate = {"kind": "lantern_pair", "first": "lantern", "second": "gear", "direction_deg": 25.0}
    drives = [{"instance": "lantern", "turns": 3.0}]
    stand = {"lantern": {"rotation_deg": 13.0}, "gear": {}}
    placing, checks = checked({"lantern": LANTERN, "gear": GEAR}, [mate], stand, drives=drives)
    assert not has_bad_verdict(checks)
    assert checks["mates"][0]["verdict"] == "contact"
    assert placing.turns[0] == pytest.approx({"lantern": 3.0, "gear": -1.0})
    gear = placing.instances[1]
    assert abs(gear.centre) == pytest.approx(120.0)
    # the placed pins against the placed outline
    made = scene({"lantern": LANTERN, "gear": GEAR})
    outline = make_parts(made, "t")[0]["gear"].section(0.0).region.outer
    pins = 30 * np.exp(1j * (math.radians(13.0) + 2 * math.pi * np.arange(10) / 10))
    local = (pins - gear.centre) * np.exp(-1j * gear.rotation)
    gaps = Boundary(tuple(s.curve for s in outline.segments()), closed=True).feet(local).distance - 4
    assert abs(gaps.min()) <= 1e-11
    right = math.degrees(gear.rotation)
    for turn, verdict in ((0.0, "contact"), (0.01, None)):
        x, y = gear.centre.real, gear.centre.imag
        put = {"gear": {"at": [x, y, 3.0], "rotation_deg": right + turn}, "lantern": {"rotation_deg": 13.0}}
        put["lantern"]["at"] = [0.0, 0.0, 0.0]
        _, checks = checked({"lantern": LANTERN, "gear": GEAR}, [mate], put)
        assert checks["mates"][0].get("verdict") == verdict
        assert has_bad_verdict(checks) is (verdict is None)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("turn", [-0.3, 0.0, 0.3])
def test_a_lantern_on_a_gear_that_stands_is_that_gear_on_its_lantern(turn: float) -> None:
    # a train of lanterns grows from the great wheel on, and from the escape wheel back
    loose = GEAR | {"pin_clearance": 0.2}
    parts = {"gear": loose, "lantern": LANTERN}
    mate = {"kind": "lantern_pair", "first": "gear", "second": "lantern", "direction_deg": 25.0}
    stand = {"gear": {"at": [5.0, 2.0, 3.0], "rotation_deg": 13.0}, "lantern": {}}
    placing, checks = checked(parts, [mate], stand, drives=[{"instance": "gear", "turns": 1.0}])
    assert checks["mates"][0]["verdict"] == "clear"
    assert placing.turns[0] == pytest.approx({"gear": 1.0, "lantern": -3.0})
    gear, lantern = placing.instances
    assert (lantern.centre - gear.centre) == pytest.approx(cmath.rect(120.0, math.radians(25.0)))
    # a lantern of 10 pins that is ahead is as its gear of 30 teeth a third as far ahead
    x, y = lantern.centre.real, lantern.centre.imag
    ahead = {"at": [x, y, 0.0], "rotation_deg": math.degrees(lantern.rotation) + turn}
    _, one = checked(parts, [mate], stand | {"lantern": ahead})
    back = {"kind": "lantern_pair", "first": "lantern", "second": "gear"}
    as_placed = ahead | {"rotation_deg": math.degrees(lantern.rotation)}
    turned = stand["gear"] | {"rotation_deg": 13.0 + turn / 3}
    _, two = checked(parts, [back], {"lantern": as_placed, "gear": turned})
    found, other = one["mates"][0], two["mates"][0]
    assert found["gap"] == pytest.approx(other["gap"], abs=1e-9)
    # of one sense the flanks on the other side are nearest
    assert found["point"] == pytest.approx(other["point"], abs=1e-4)
    assert found["gap"] == pytest.approx(0.2 - math.radians(abs(turn)) * 30.0, abs=1e-3)


# kind of part, changed keys, the key that is blamed
WRONG: dict[str, tuple[str, Keys, str]] = {
    "undercut": ("disc", {"eccentricity": 3.4}, "eccentricity"),
    "looped": ("disc", {"eccentricity": 6.0}, "eccentricity"),
    "pins that touch": ("disc", {"pin_diameter": 22.0, "output_holes": INNER},
                        "pin_diameter"),
    "bore of a disc": ("disc", {"bore_diameter": 70.0}, "bore_diameter"),
    "holes too far out": ("disc", {"output_holes": DISC["output_holes"] | {"pitch_circle_diameter": 60.0}},
                          "output_holes.pitch_circle_diameter"),
    "holes too far in": ("disc", {"output_holes": DISC["output_holes"] | {"pitch_circle_diameter": 30.0}},
                         "output_holes.pitch_circle_diameter"),
    "output pins too thick": ("disc", {"output_holes": DISC["output_holes"] | {"pin_diameter": 18.0}},
                              "output_holes.pin_diameter"),
    "lightening holes in the others": ("disc", {"holes": HOLES},
                                       "holes.diameter"),
    "chamfer of a disc": ("disc", {"face_chamfer": 4.0}, "face_chamfer"),
    "ring buries its pins": ("ring", {"inner_diameter": 70.0}, "inner_diameter"),
    "ring loses its pins": ("ring", {"inner_diameter": 90.0}, "inner_diameter"),
    "no rim": ("ring", {"outer_diameter": 83.01}, "outer_diameter"),
    "bolts in the pins": ("ring", {"holes": {"count": 3, "diameter": 4.0, "pitch_circle_diameter": 84.0}},
                          "holes.pitch_circle_diameter"),
    "seats of fixed pins": ("ring", {"seat_clearance": 0.1}, "seat_clearance"),
    "fat pins": ("ring", {"pin_diameter": 30.0}, "pin_diameter"),
    "bore of an eccentric": ("eccentric", {"bore_diameter": 18.0}, "bore_diameter"),
    "eccentric beside its axis": ("eccentric", {"eccentricity": 12.0}, "eccentricity"),
    "hollow pin": ("pin", {"bore_diameter": 8.0}, "bore_diameter"),
    "plate too small": ("plate", {"outer_diameter": 50.0}, "outer_diameter"),
    "bore in the pins": ("plate", {"bore_diameter": 42.0}, "bore_diameter"),
    "pins of a plate": ("plate", {"pin_diameter": 25.0}, "pin_diameter"),
    "two bores": ("plate", {"bore_diameter": 5.0, "bore": {"shape": "round", "diameter": 5.0}}, "bore_diameter"),
    "pointed": ("gear", {"tip_diameter": 210.0}, "tip_diameter"),
    "stump": ("gear", {"tip_diameter": 175.0}, "tip_diameter"),
    "no tooth": ("gear", {"pin_diameter": 19.0}, "pin_diameter"),
    "no tooth left": ("gear", {"root_clearance": 9.0}, "root_clearance"),
    "bore of a gear": ("gear", {"bore_diameter": 180.0}, "bore_diameter"),
}  # fmt: skip


def limit(text: str) -> float:
    """The value that a refusal says works."""
    found = re.search(r"(?:at most |at least |; |mm; |^)(-?[0-9.]+)(?: mm)? works", text)
    assert found, text
    return float(found[1])


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_part_names_its_key_and_what_works(name: str) -> None:
    kind, change, key = WRONG[name]
    keys = PARTS[kind] | change
    with pytest.raises(SceneError) as caught:
        make_parts(scene({"part": keys}), "t")
    message = str(caught.value)
    assert f"parts.part.{key} = " in message
    owner, _, inner = key.partition(".")
    value = limit(message)
    keys = keys | {owner: keys.get(owner, {}) | {inner: value} if inner else value}
    if name == "eccentric beside its axis":
        keys |= {"bore_diameter": 0.1}
    parts, _ = make_parts(scene({"part": keys}), "t")
    assert parts["part"].body(0.0).walls


MISMATCHED: dict[str, tuple[list[str], Keys, Keys, str]] = {
    "lobes": (["ring", "disc"], {"kind": "cycloidal_pair"}, {"number_of_lobes": 12}, "number_of_lobes"),
    "pin circle": (["ring", "disc"], {"kind": "cycloidal_pair"}, {"pin_circle_diameter": 81.0}, "pin_circle_diameter"),
    "pins": (["ring", "disc"], {"kind": "cycloidal_pair"}, {"pin_diameter": 7.0}, "pin_diameter"),
    "eccentric": (["eccentric", "disc"], {"kind": "eccentric_bearing"}, {"eccentricity": 2.4}, "eccentricity"),
    "bearing": (["eccentric", "disc"], {"kind": "eccentric_bearing"}, {"bore_diameter": 0.0}, "bore_diameter"),
    "output pins": (["disc", "plate"], {"kind": "output_pins"}, {"number_of_pins": 5}, "number_of_pins"),
    "output circle": (["disc", "plate"], {"kind": "output_pins"}, {"pin_circle_diameter": 47.0}, "pin_circle_diameter"),
    "lantern": (["lantern", "gear"], {"kind": "lantern_pair"}, {"number_of_pins": 9}, "number_of_pins"),
    "lantern pins": (["lantern", "gear"], {"kind": "lantern_pair"}, {"pin_diameter": 7.0}, "pin_diameter"),
    "wide gear": (["lantern", "gear"], {"kind": "lantern_pair"}, {"face_width": 12.0}, "face_width"),
    "thin pin": (["seats", "pin"], {"kind": "pin_seat"}, {"diameter": 7.0}, "diameter"),
}


@pytest.mark.parametrize("name", MISMATCHED)
def test_parts_that_do_not_belong_together(name: str) -> None:
    (first, second), mate, change, key = MISMATCHED[name]
    parts = PARTS | {"seats": RING | {"pins": "half_round"}}
    two = {first: parts[first], second: parts[second] | change}
    mate = mate | {"first": first, "second": second}
    with pytest.raises(SceneError) as caught:
        make_parts(scene(two, [mate]), "t")
    assert f"parts.{second}.{key} = " in str(caught.value)
    two[second] = two[second] | {key: type(change[key])(limit(str(caught.value)))}
    assert make_parts(scene(two, [mate]), "t")


def test_a_disc_on_no_eccentric_is_told_which_mates_put_it_on_one() -> None:
    """It was told to join a satellite to its carrier; a ring and its disc alone stand well until something drives."""
    rolls = {"kind": "cycloidal_pair", "first": "ring", "second": "disc"}
    carried = [{"kind": "coaxial", "first": "ring", "second": "eccentric"},
               {"kind": "eccentric_bearing", "first": "eccentric", "second": "disc"}]  # fmt: skip
    parts, drive = {key: PARTS[key] for key in ("ring", "disc", "eccentric")}, {"instance": "eccentric", "turns": 11.0}
    with pytest.raises(SceneError, match=r"mates\[1\].second.*coaxial.*eccentric_bearing"):
        checked(parts, [rolls, carried[1]], contact=False, drives=[drive])
    found = checked(parts, [rolls, *carried], contact=False, drives=[drive])[1]["drives"][0]["train"]
    assert found == {"eccentric": 11.0, "disc": pytest.approx(-1.0)}


def test_seats_that_are_not_there() -> None:
    mate = {"kind": "pin_seat", "first": "ring", "second": "pin", "number": 13}
    with pytest.raises(SceneError, match=r"mates\[1\]\.number.*12 works"):
        make_parts(scene({"ring": RING | {"pins": "half_round"}, "pin": PIN}, [mate]), "t")
    with pytest.raises(SceneError, match=r"mates\[1\]\.first.*pins already"):
        make_parts(scene({"ring": RING, "pin": PIN}, [mate | {"number": 1}]), "t")
    with pytest.raises(SceneError, match="pin_ring and cycloidal_disc"):
        make_parts(
            scene({"ring": RING, "pin": PIN}, [{"kind": "cycloidal_pair", "first": "ring", "second": "pin"}]), "t"
        )


@pytest.mark.parametrize("name", PARTS)
@pytest.mark.parametrize("offset", [0.0, 0.2, -0.2])
def test_sections_and_bodies_agree(name: str, offset: float) -> None:
    """Areas of moved sections by Steiner's formula in its first order; every body is built of them."""
    from geometry.plane.measure import profile_area

    part = make_parts(scene({"part": PARTS[name]}), "t")[0]["part"]

    def area(value: float) -> float:
        region = part.section(value).region
        return sum(profile_area(p) for p in (region.outer, *region.holes))

    step = 1e-4
    rate = (area(offset + step) - area(offset - step)) / (2 * step)
    mean = (area(offset + 0.05) - area(offset - 0.05)) / 0.1
    assert rate == pytest.approx(mean, rel=5e-3)
    assert rate > 0
    assert part.body(offset).caps


def test_scenes_survive_their_own_report() -> None:
    for name in ("cycloidal_reducer", "lantern_pair"):
        made = load_scene(name)
        assert resolved(scene_from_resolved(resolved(made), "t")) == resolved(made)


def test_kinds_are_registered() -> None:
    kinds = {"cycloidal_disc", "pin_ring", "output_plate", "eccentric", "pin", "lantern_wheel", "lantern_gear"}
    assert kinds <= set(KINDS)

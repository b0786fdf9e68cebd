"""Scenes in motion: at any drive value every mate is kept as exactly as at the start; what cannot move is told."""

from __future__ import annotations

import cmath
import math
import re

import pytest

from parts.base.refusal import SceneError
from parts.scene.load import load_scene, make_parts, resolved, scene_from_resolved, scene_from_toml
from parts.scene.placing import Placing, place
from parts.scene.standing import Instance

GEAR = '[parts.{}]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = {}\nface_width = 5.0\n'
PARTS = (
    GEAR.format("sun", 40)
    + GEAR.format("planet", 40)
    + GEAR.format("ring", 120).replace("spur_gear", "ring_gear")
    + "outer_diameter = 260.0\n"
    + '[parts.carrier]\nkind = "plate"\nwidth = 200.0\nheight = 200.0\nface_width = 3.0\n'
)
STAND = "[instances.planet]\ncount = 4\n[instances.ring]\n{}\n"
MESH = (
    '[[mates]]\nkind = "external_gear_pair"\nfirst = "sun"\nsecond = "planet"\ndirection_deg = 10.0\n'
    '[[mates]]\nkind = "internal_gear_pair"\nfirst = "planet_1"\nsecond = "ring"\ndirection_deg = 190.0\n'
    '[[mates]]\nkind = "internal_gear_pair"\nfirst = "planet_2"\nsecond = "ring"\n'
)
CARRIED = (
    '[[mates]]\nkind = "coaxial"\nfirst = "sun"\nsecond = "carrier"\nheight = 6.0\nrotation_deg = 10.0\n'
    '[[mates]]\nkind = "carried"\nfirst = "carrier"\nsecond = "planet"\n'
)
DRIVE = '[[drives]]\ninstance = "{}"\n{}\n'
JAMES = PARTS + STAND.format("held = true") + MESH + CARRIED
FREE = PARTS + STAND.format("") + MESH + CARRIED


def placed(text: str) -> Placing:
    scene = scene_from_toml(text.encode(), "s.toml", "s")
    parts, matings = make_parts(scene, "s.toml")
    return place(scene.instances, scene.drives, parts, matings, "s.toml")


def check_mates(placing: Placing, moved: tuple[Instance, ...]) -> None:
    """As each mate's own calculation has it: distance and phase as close as at the start."""
    stand = {i.id: i for i in moved}
    for mate in placing.mates:
        first, second = stand[mate.first.id], stand[mate.second.id]
        found = mate.mating.standing((first.centre, first.rotation), (second.centre, second.rotation))
        if found is None or mate.mating.kind == "carried":
            continue
        assert found.distance == pytest.approx(mate.mating.distance, abs=1e-9), mate.mating
        assert abs(found.phase_off) <= found.play + 1e-9, (mate.mating, found)


def test_satellites_go_round_in_mesh() -> None:
    placing = placed(JAMES + DRIVE.format("sun", "turns = 4.0"))
    (turns,) = placing.turns
    assert turns == {"sun": 4.0, "carrier": 1.0} | {f"planet_{k}": -2.0 for k in (1, 2, 3, 4)}
    assert placing.at([0]) == placing.instances
    assert placing.train is not None
    # three of the sun's four turns are rolled off on its satellites
    assert placing.train.rolled(placing.mates[0].mating) == [3.0]
    for turned in (0.1, 1 / 3, 2.75, -1234.5678):
        moved = placing.at([turned])
        check_mates(placing, moved)
        stand = {i.id: i for i in moved}
        where = cmath.rect(80.0, math.radians(10) + 2 * math.pi * math.remainder(turned / 4, 1))
        assert stand["planet_1"].centre == pytest.approx(where, abs=1e-10)
        assert stand["ring"] == placing.instances[-2] or stand["ring"].rotation == pytest.approx(
            {i.id: i for i in placing.instances}["ring"].rotation, abs=1e-15
        )


def test_two_drives_in_one_train() -> None:
    """A differential: (z1 w1 + z3 w3) / (z1 + z3) is the carrier's; a third drive is one too many."""
    both = FREE + DRIVE.format("sun", "turns = 3") + DRIVE.format("ring", "turns = -1")
    placing = placed(both)
    assert [train["carrier"] for train in placing.turns] == [0.75, -0.75]
    moved = placing.at([0.3, 0.9])
    check_mates(placing, moved)
    turned = {i.id: i.rotation for i in moved}["carrier"] - math.radians(10)
    assert math.remainder(turned - 2 * math.pi * (40 * 0.3 + 120 * 0.9) / 160, 2 * math.pi) == pytest.approx(
        0, abs=1e-14
    )
    with pytest.raises(SceneError, match=r"drives\[3\].instance = .carrier.: the drive of sun turns it already"):
        placed(both + DRIVE.format("carrier", ""))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("driven", ["oval", "second_oval"])
def test_oval_gears_turn_unevenly(driven: str) -> None:
    """Both centrodes touch at any turn, whichever of both is driven; whole turns agree with the ratio."""
    kept = resolved(load_scene("oval_gears")) | {"drives": [{"instance": driven}]}
    made = scene_from_resolved(kept, "t")
    parts, matings = make_parts(made, "t")
    placing = place(made.instances, made.drives, parts, matings, "t")
    uneven = 0.0
    for value in (0.03, 0.21, 0.48, 0.9, 1.63):
        moved = placing.at([value])
        check_mates(placing, moved)
        turns = [(b.rotation - a.rotation) / (2 * math.pi) for a, b in zip(placing.instances, moved, strict=True)]
        stand = dict(zip((i.id for i in moved), turns, strict=True))
        uneven = max(uneven, abs(math.remainder(stand["oval"] + stand["second_oval"], 1.0)))
        assert math.remainder(stand[driven] - value, 1.0) == pytest.approx(0, abs=1e-14)
    assert uneven > 0.01
    for key in ("oval", "second_oval"):
        assert (placing.train.rates(key) is None) == (key != driven)


@pytest.mark.parametrize("name", ["idler_train", "lantern_pair", "cycloidal_reducer"])
def test_built_in_scenes_with_drives_keep_their_mates(name: str) -> None:
    scene = load_scene(name)
    parts, matings = make_parts(scene, name)
    placing = place(scene.instances, scene.drives, parts, matings, name)
    for value in (0.123, 7.77):
        check_mates(placing, placing.at([value] * len(scene.drives)))


@pytest.mark.parametrize("name", ["laser_cam_model", "linkage_cam", "yoke_cam", "wedge_cam", "conjugate_cams"])
def test_what_a_cam_moves_follows_it(name: str) -> None:
    """Every follower stands where its mate puts it, and what is carried by it goes along."""
    scene = load_scene(name)
    kept = resolved(scene)
    drive = {"travel": 10.0} if name == "wedge_cam" else {}
    kept["drives"] = [{"instance": kept["mates"][0]["first"]} | drive]
    made = scene_from_resolved(kept, name)
    parts, matings = make_parts(made, name)
    placing = place(made.instances, made.drives, parts, matings, name)
    for value in (0.05, 0.4, 0.8):
        moved = placing.at([value * drive.get("travel", 1.0)])
        assert moved != placing.instances
        if name == "wedge_cam":
            continue
        check_mates(placing, moved)


def test_a_wedge_lifts_as_it_slides() -> None:
    """The plate slides to -x; the follower stays over its line and rises as the wedge's law has it."""
    kept = resolved(load_scene("wedge_cam"))
    start = kept["mates"][0]["travel"]
    lifts = []
    for travel, slid in ((start, 7.0), (start + 7.0, 0.0)):
        kept["mates"][0]["travel"] = travel
        kept["drives"] = [{"instance": kept["mates"][0]["first"], "travel": -7.0}]
        made = scene_from_resolved(kept, "t")
        parts, matings = make_parts(made, "t")
        placing = place(made.instances, made.drives, parts, matings, "t")
        plate, *_ = placing.at([-slid])
        stands, still = (
            {i.id: i.centre for i in found}["roller"] for found in (placing.at([-slid]), placing.at([0.0]))
        )
        assert stands.real == pytest.approx(still.real, abs=1e-12)
        lifts.append(stands)
        assert plate.centre.real == pytest.approx(placing.instances[0].centre.real - slid)
    assert lifts[0].imag == pytest.approx(lifts[1].imag, abs=1e-12)


RACK = (
    GEAR.format("gear", 20)
    + '[parts.rack]\nkind = "rack"\nmodule = 2.0\nnumber_of_teeth = 12\nface_width = 5.0\nbody_height = 10.0\n'
    + '[[mates]]\nkind = "rack_pair"\nfirst = "gear"\nsecond = "rack"\ndirection_deg = -90.0\n'
)


def test_a_rack_travels() -> None:
    placing = placed(RACK + DRIVE.format("gear", "turns = 0.5"))
    assert placing.train is not None
    assert placing.train.slid == ({"rack": pytest.approx(20 * math.pi)},)
    check_mates(placing, placing.at([0.21]))
    driven = placed(RACK + DRIVE.format("rack", "travel = 10.0"))
    assert driven.turns == ({"gear": pytest.approx(10 / (40 * math.pi))},)
    moved = driven.at([10.0])
    check_mates(driven, moved)
    assert moved[1].centre - driven.instances[1].centre == pytest.approx(10, abs=1e-12)


AXIS = '[[mates]]\nkind = "carried"\nfirst = "{}"\nsecond = "planet_1"\n{}\n'
WRONG = [
    (FREE + DRIVE.format("sun", ""), "drives[1].instance", "leaves planet_1, planet_2, planet_3, planet_4, ring"),
    (JAMES + DRIVE.format("sun", "") + DRIVE.format("carrier", ""), "drives[2].instance", "the drive of sun"),
    (JAMES + DRIVE.format("ring", ""), "drives[1].instance", "held by ring"),
    (JAMES + DRIVE.format("sun", "") + DRIVE.format("sun", ""), "drives[2].instance", "the drive of sun"),
    (JAMES.replace("held = true", 'held = "yes"'), "instances.ring.held", "true or false"),
    (JAMES + DRIVE.format("sun", "travel = 3.0"), "drives[1].travel", "give turns"),
    (JAMES + DRIVE.format("sun", "travel = 0.0"), "drives[1].travel", "must not be 0"),
    (RACK + DRIVE.format("rack", "turns = 1"), "drives[1].turns", "give travel"),
    (JAMES + AXIS.format("ring", "") + DRIVE.format("sun", ""), "mates[12].first", "already carried by carrier"),
    (RACK.split("[parts.rack]")[0] + GEAR.format("b", 20) + '[[mates]]\nkind = "external_gear_pair"\nfirst = "gear"\n'
     'second = "b"\n[[mates]]\nkind = "fixed"\nfirst = "gear"\nsecond = "b"\n' + DRIVE.format("gear", ""),
     "mates[1].second", "wheels of one body do not mesh"),
    (PARTS + AXIS.format("carrier", "").replace("planet_1", "planet"), "mates[1].offset", "the place on the carrier"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "named", "remedy"), WRONG)
def test_what_cannot_move_is_told_in_one_line(text: str, named: str, remedy: str) -> None:
    with pytest.raises(SceneError) as caught:
        placed(text)
    told = str(caught.value)
    assert re.search(re.escape(named), told), told
    assert remedy in told
    assert "\n" not in told


@pytest.mark.parametrize("way", ["turns", "travel"])
def test_what_a_cam_moves_is_no_drive(way: str) -> None:
    """By its own key, whichever way it is asked to go: travel was answered with turns, which do not work either."""
    kept = resolved(load_scene("yoke_cam")) | {"drives": [{"instance": "yoke", way: 1.0}]}
    made = scene_from_resolved(kept, "t")
    parts, matings = make_parts(made, "t")
    with pytest.raises(SceneError) as caught:
        place(made.instances, made.drives, parts, matings, "t")
    assert (caught.value.key, caught.value.value, caught.value.code) == ("drives[1].instance", "yoke", "moves_by_law")


def test_a_train_that_does_not_come_back_to_its_axis_is_told_by_how_much() -> None:
    """A dial train of one module: 20 + 60 and 12 + 36 teeth end 32 mm off; a satellite without a carrier was blamed."""
    parts = "".join(GEAR.format(name, teeth) for name, teeth in zip("abcd", (20, 60, 12, 36), strict=True))
    meshes = "".join(
        f'[[mates]]\nkind = "{kind}"\nfirst = "{one}"\nsecond = "{two}"\n{more}'
        for kind, one, two, more in (
            ("external_gear_pair", "a", "b", ""), ("fixed", "b", "c", "offset = [0.0, 0.0, 6.0]\n"),
            ("external_gear_pair", "c", "d", "direction_deg = 180.0\n"), ("coaxial", "a", "d", "height = 6.0\n"),
        )
    )  # fmt: skip
    found = placed(parts + meshes + DRIVE.format("a", "turns = 9.0"))
    off = found.mates[-1].conditions[0]
    assert (off.met, off.value) == (False, pytest.approx(32.0))
    assert found.turns == ({"a": 9.0, "b": -3.0, "c": -3.0, "d": 1.0},)


def test_a_train_that_its_mates_lock_cannot_be_driven() -> None:
    """Three external wheels in a triangle: placed by hand so that all mesh, they hold each other."""
    gears = "".join(GEAR.format(name, 20) for name in "abc")
    mate = '[[mates]]\nkind = "external_gear_pair"\nfirst = "{}"\nsecond = "{}"\ndirection_deg = {}\n'
    locked = gears + mate.format("a", "b", 0) + mate.format("a", "c", 60) + mate.format("b", "c", 120)
    with pytest.raises(SceneError, match=r"drives\[1\].instance = .a.: cannot turn: held by a-b, a-c, b-c"):
        placed(locked + DRIVE.format("a", ""))


def test_what_is_seldom_said_is_kept_only_where_it_is() -> None:
    scene = scene_from_toml((JAMES + DRIVE.format("sun", "")).encode(), "s.toml", "s")
    kept = resolved(scene)
    assert kept["instances"]["ring"]["held"] is True
    assert "held" not in kept["instances"]["sun"]
    assert "travel" not in kept["drives"][0]
    assert resolved(scene_from_resolved(kept, "r")) == kept

"""Timing pulleys and belt drives in scenes: solids with flanges, files with every groove, drives, refusals."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path
from typing import Any

import ezdxf
import pytest

from exporters.documents.topics import calculate
from exporters.formats.read_dxf import read_dxf
from exporters.production.check import scene_checks
from geometry.gears.belts.belt import belt_of
from geometry.plane.measure import profile_area
from geometry.solids.mass import body_moments
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.belts.probe import GrooveProbe
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from tests.exporters.making import read_report, run, table, write_scene

Keys = dict[str, Any]
PLATE: Keys = {"kind": "timing_pulley", "belt": "GT2", "number_of_teeth": 20, "bore_diameter": 5.0, "face_width": 7.0}
LARGE = PLATE | {"number_of_teeth": 60}
OWN: Keys = {"pitch": 5.0, "line_offset": 0.5, "groove_depth": 1.95, "groove_width": 3.32}
MATE: Keys = {"kind": "belt_drive", "first": "a", "second": "b"}


def made(keys: Keys) -> Part:
    """The part of its keys."""
    return make_parts(scene_from_dict({"parts": {"a": keys}}, "t", "t"), "t")[0]["a"]


def placed(mate: Keys, one: Keys = PLATE, two: Keys = LARGE, **more: Any) -> tuple[Placing, dict[str, Any]]:
    """Where both stand, and what the checks say of them."""
    tables = {
        "parts": {"a": one, "b": two}, "mates": [MATE | mate], "drives": [{"instance": "a", "turns": 3.0}], **more,
    }  # fmt: skip
    scene = scene_from_dict(tables, "t", "t")
    parts, matings = make_parts(scene, "t")
    placing = place(scene.instances, scene.drives, parts, matings, "t")
    return placing, scene_checks(placing, parts, scene.drives, "en", contact=True)


def test_a_belt_of_its_own_is_that_of_the_table() -> None:
    own = made(PLATE | {"belt": OWN | {"root_radius": 0.4, "tip_radius": 0.6}, "number_of_teeth": 30}).thing
    named = made(PLATE | {"belt": "T5", "number_of_teeth": 30, "outer_diameter": 2 * own.outer_radius}).thing
    assert own.belt.groove == named.belt.groove
    assert own.land == pytest.approx(named.land, rel=1e-12)
    assert own.outer_radius == pytest.approx(75 / math.pi - 0.5)


def test_letters_of_a_belt_may_be_cyrillic() -> None:
    """AT10 as it comes off a Ukrainian keyboard."""
    assert made(PLATE | {"belt": "\u0430\u0442 10"}).thing.belt is belt_of("AT10")


@pytest.mark.parametrize("offset", [0.0, -0.1])
@pytest.mark.parametrize("faces", [(True, True), (True, False), (False, True)])
def test_flanges_are_discs_beside_the_teeth(faces: tuple[bool, bool], offset: float) -> None:
    """Walls move with the offset, faces stay."""
    flanges = {"diameter": 16.0, "thickness": 1.5, "below": faces[0], "above": faces[1]}
    hub = {"diameter": 10.0 if not faces[1] else 12.0, "above": 6.0}
    part = made(PLATE | {"flanges": flanges, "hub": hub})
    teeth, discs = profile_area(part.section(offset).region.outer), sum(faces)
    wanted = 7.0 * teeth + discs * 1.5 * math.pi * (8.0 + offset) ** 2
    wanted += 6.0 * math.pi * (hub["diameter"] / 2 + offset) ** 2 - (13.0 + discs * 1.5) * math.pi * (2.5 - offset) ** 2
    assert body_moments(part.body(offset)).volume == pytest.approx(wanted, rel=1e-12)
    assert part.face_width == pytest.approx(7.0 + discs * 1.5)
    assert not part.is_plate
    assert not made(PLATE | {"flanges": flanges}).is_plate
    assert made(PLATE).is_plate


def test_a_page_has_the_groove_with_its_clearance() -> None:
    """Its walls stand off by it: every radius of the groove is greater by it, that of the tip stays."""

    def values(*words: str) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(calculate("pulley", [*words, "clearance=0.05"], "json", "en"))["values"]
        return found

    found = values("belt=T5", "number_of_teeth=30")
    names = "greatest_root_radius", "pulley_groove_depth", "groove_tip_radius", "groove_angle_deg"
    assert [found[name] for name in names] == pytest.approx([0.45, 2.0, 0.6, 50.0])
    found = values("belt=GT2", "number_of_teeth=20")
    names = "groove_floor_radius", "groove_flank_radius", "flank_centre_offset", "groove_tip_radius"
    assert [found[name] for name in names] == pytest.approx([0.605, 1.05, 0.40, 0.15])


def test_files_have_every_groove_and_one_that_is_filled_is_caught(tmp_path: Path) -> None:
    parts = {"gt": PLATE, "t": PLATE | {"belt": "T5", "flanges": {"diameter": 40.0}}}
    exports = ({"format": "dxf"}, {"format": "dxf", "name": "cut", "kerf": 0.2}, {"format": "stl"}, {"format": "step"})
    assert run("build", write_scene(tmp_path / "s.toml", parts, exports), "--out", tmp_path / "out") == 0
    built = tmp_path / "out" / "s"
    for entry in read_report(built)["files"]:
        if entry["format"] != "step":
            assert entry["measured"]["pin_gap"] == pytest.approx(-entry["offset"], abs=entry["max_error"] + 1e-6)
    pulley = made(PLATE).thing
    assert GrooveProbe(pulley, 3.0).run(read_dxf(built / "gt.laser.dxf"), 0.0, 1e-6).failures == ()
    # the groove between the last tooth and the first alone is filled a little
    document = ezdxf.readfile(built / "gt.laser.dxf")
    outline = max(document.modelspace().query("LWPOLYLINE"), key=len)
    rows = [(complex(x, y), bulge) for x, y, bulge in outline.get_points("xyb")]
    angle = -pulley.pitch_angle / 2
    spoiled = [
        p * (1 + 0.05 / abs(p))
        if abs(cmath.phase(p) - angle) < 0.4 * -angle and abs(p) < pulley.outer_radius - 0.3
        else p
        for p, _ in rows
    ]
    assert 0 < sum(p != q for (p, _), q in zip(rows, spoiled, strict=True)) < 20
    outline.set_points([(p.real, p.imag, b) for p, (_, b) in zip(spoiled, rows, strict=True)], format="xyb")
    document.saveas(tmp_path / "spoiled.dxf")
    (failure,) = GrooveProbe(pulley, 3.0).run(read_dxf(tmp_path / "spoiled.dxf"), 0.0, 1e-6).failures
    assert "grooves" in failure


def test_step_files_of_chamfered_pulleys_keep_within_their_digits(tmp_path: Path) -> None:
    """Heights and places are rounded both: a slant of 45 degrees moves by more than one last decimal of its places."""
    own = {"belt": "T5", "number_of_teeth": 19, "clearance": 0.106, "face_width": 10.0, "face_chamfer": 0.1}
    scene = write_scene(tmp_path / "s.toml", {"a": PLATE | own}, [{"format": "step"}])
    assert run("build", scene, "--out", tmp_path) == 0


def test_both_pulleys_turn_the_same_way_by_their_teeth() -> None:
    placing, checks = placed({"number_of_belt_teeth": 100, "direction_deg": 20.0})
    assert placing.turns[0] == pytest.approx({"a": 3.0, "b": 1.0})
    (mate,) = checks["mates"]
    assert mate["belt_length"] == 200.0
    assert "findings" not in mate
    distance = mate["working_centre_distance"]
    # L = 2 a cos(g) + pi (r1 + r2) + 2 g (r2 - r1), sin(g) = (r2 - r1) / a
    one, two = 20 / math.pi, 60 / math.pi
    slope = math.asin((two - one) / distance)
    assert 2 * distance * math.cos(slope) + math.pi * (one + two) + 2 * slope * (two - one) == pytest.approx(200.0)
    loose = placed({"centre_distance": distance - 0.2})[1]["mates"][0]
    assert loose["number_of_belt_teeth"] == 100
    assert loose["belt_slack"] == pytest.approx(0.4 * math.cos(slope), rel=0.01)
    assert len(loose["findings"]) == 1


@pytest.mark.parametrize(("small", "large", "belt"), [(20, 60, 100), (22, 51, 120), (36, 36, 101), (19, 33, 80)])
def test_a_distance_as_it_is_told_has_the_belt_that_told_it(small: int, large: int, belt: int) -> None:
    """Of five decimals every second one is rounded up: it had one tooth more and a note, or was refused."""
    one, two = PLATE | {"number_of_teeth": small}, LARGE | {"number_of_teeth": large}
    taut = placed({"number_of_belt_teeth": belt}, one, two)[1]["mates"][0]["working_centre_distance"]
    for told in (round(taut, 5), math.ceil(taut * 1e5) / 1e5):
        for more in ({}, {"number_of_belt_teeth": belt}):
            (mate,) = placed({"centre_distance": told} | more, one, two)[1]["mates"]
            assert mate["number_of_belt_teeth"] == belt
            assert mate["working_centre_distance"] == pytest.approx(taut, abs=6e-6)
            assert "findings" not in mate
    # rounded to hundredths of a millimetre it leaves the belt as taut as belts are made
    assert "findings" not in placed({"centre_distance": taut - 0.0049}, one, two)[1]["mates"][0]
    with pytest.raises(SceneError):
        placed({"centre_distance": taut + 3e-5, "number_of_belt_teeth": belt}, one, two)


def test_teeth_between_flanges_face_each_other_and_flanges_keep_apart() -> None:
    """Middles of 7 mm of teeth on a flange of 1.5 mm, and of 8 mm; tips stand off by half of both flanges."""
    one, two = PLATE | {"flanges": {"diameter": 16.0, "thickness": 1.5}}, LARGE | {"face_width": 8.0}
    placing, checks = placed({"number_of_belt_teeth": 100}, one, two)
    assert next(i for i in placing.instances if i.id == "b").at[2] == pytest.approx(1.5 + 3.5 - 4.0)
    (mate,) = checks["mates"]
    wide = mate["working_centre_distance"] - 8.0 - (60 / math.pi - 0.254)
    assert mate["rim_gap"] == pytest.approx(wide)
    assert mate["gear_ratio"] == pytest.approx(3.0)


@pytest.mark.parametrize(("turn", "direction"), [(0.0, 20.0), (7.0, 20.0), (100.0, -75.0)])
def test_teeth_of_a_placed_belt_stand_in_grooves_of_both(turn: float, direction: float) -> None:
    """Grooves are half a pitch beside tooth 1, which each pulley has at its turn."""
    mate = {"number_of_belt_teeth": 100, "direction_deg": direction}
    (placing, _) = placed(mate, instances={"a": {"rotation_deg": turn}, "b": {}})
    (joined,) = placing.mates
    poses = [(complex(*i.at[:2]), i.rotation) for i in (joined.first, joined.second)]
    places, _ = joined.mating.rollers(*poses)
    for (centre, rotation), z in zip(poses, (20, 60), strict=True):
        seated = [p - centre for p in places if abs(abs(p - centre) - z / math.pi) < 1e-9]
        assert len(seated) > 0.35 * z
        shares = [(cmath.phase(p) - rotation) * z / (2 * math.pi) - 0.5 for p in seated]
        assert max(abs(x - round(x)) for x in shares) < 1e-6


def test_the_page_of_a_drive_takes_its_pulleys_from_the_scene() -> None:
    """The scene has 20 and 60 teeth; what is asked besides goes first. Each has its own outer diameter."""

    def values(*words: str) -> dict[str, Any]:
        found: dict[str, Any] = json.loads(calculate("belt", list(words), "json", "en"))["values"]
        return found

    assert values("belt_drive")["number_of_teeth"] == {"first": 20, "second": 60}
    assert values("belt_drive", "mate_number_of_teeth=30")["number_of_teeth"] == {"first": 20, "second": 30}
    own = "belt=T5", "number_of_teeth=20", "mate_number_of_teeth=40"
    found = values(*own, "outer_diameter=31.2", "number_of_belt_teeth=100")
    assert found["pulley_outer_diameter"]["first"] == 31.2
    assert found["pulley_outer_diameter"]["second"] == pytest.approx(200 / math.pi - 0.85)
    found = values(*own, "outer_diameter=31.2", "mate_outer_diameter=62.9", "number_of_belt_teeth=100")
    assert found["pulley_outer_diameter"] == {"first": 31.2, "second": 62.9}
    taut = found["exact_belt_distance"]
    assert values(*own, "number_of_belt_teeth=100", f"centre_distance={taut!r}")["belt_slack"] == pytest.approx(
        0, abs=1e-9
    )


def test_flanges_of_the_first_pulley_are_none_of_the_second(tmp_path: Path) -> None:
    """As it was: 86 teeth were asked for, that two flanges of 44 mm go round, where 33.6 mm is far for 44 and 12 mm."""
    large, small = LARGE | {"flanges": {"diameter": 44.0}}, PLATE | {"outer_diameter": 12.1}
    mate = table("[[mates]]", MATE | {"number_of_belt_teeth": 76})
    scene = write_scene(tmp_path / "s.toml", {"a": large, "b": small}, [{"format": "dxf"}], mate)
    (checked,) = placed({"number_of_belt_teeth": 76}, large, small)[1]["mates"]
    found = json.loads(calculate("belt", [str(scene)], "json", "en"))["values"]
    assert found["exact_belt_distance"] == pytest.approx(checked["working_centre_distance"])
    assert found["pulley_outer_diameter"]["second"] == 12.1
    # of other teeth it has none of its own
    words = [str(scene), "mate_number_of_teeth=30", "number_of_belt_teeth=90"]
    found = json.loads(calculate("belt", words, "json", "en"))["values"]
    assert found["pulley_outer_diameter"]["second"] == pytest.approx(60 / math.pi - 0.508)


@pytest.mark.parametrize(
    ("words", "key"), [("7", "mate_number_of_teeth"), ("20 mate_outer_diameter=5", "mate_outer_diameter")]
)
def test_a_refusal_of_the_second_pulley_names_its_key(words: str, key: str) -> None:
    words = f"belt=T2.5 number_of_teeth=20 number_of_belt_teeth=100 mate_number_of_teeth={words}"
    with pytest.raises(SceneError) as refused:
        calculate("belt", words.split(), "json", "en")
    assert refused.value.key == f"belt.{key}"


@pytest.mark.parametrize("off", [0.0, 1e-3])
def test_a_second_pulley_that_stands_already_must_take_the_belt(off: float) -> None:
    there = placed({"number_of_belt_teeth": 100}, instances={"a": {"rotation_deg": 7.0}, "b": {}})[0]
    other = next(i for i in there.instances if i.id == "b")
    standing = {"at": [*other.at], "rotation_deg": math.degrees(other.rotation + off)}
    again = placed({"number_of_belt_teeth": 100}, instances={"a": {"rotation_deg": 7.0}, "b": standing})[1]
    assert all(condition["met"] for condition in again["mates"][0]["conditions"]) == (off == 0.0)


@pytest.mark.parametrize(
    ("keys", "key", "cure"),
    [
        (PLATE | {"belt": "T7"}, "belt", None),
        (PLATE | {"number_of_teeth": 6, "belt": "T2.5", "bore_diameter": 0.5}, "number_of_teeth", 10),
        (PLATE | {"clearance": 0.3}, "clearance", 0.2012),
        (PLATE | {"flanges": {"diameter": 12.0}}, "flanges.diameter", 12.2245),
        (PLATE | {"flanges": {"diameter": 16.0, "below": False, "above": False}}, "flanges.above", True),
        (PLATE | {"flanges": {"diameter": 16.0}, "face_chamfer": 0.3}, "face_chamfer", None),
        (PLATE | {"belt": OWN | {"groove_width": 7.0}}, "belt.groove_width", 4.823),
        (PLATE | {"bore_diameter": 11.0}, "bore_diameter", None),
        (PLATE | {"hub": {"diameter": 12.0, "above": 5.0}}, "hub.diameter", 10.6743),
        # the flange is at the other face
        (PLATE | {"flanges": {"diameter": 16.0, "above": False}, "hub": {"diameter": 12.0, "above": 5.0}},
         "hub.diameter", 10.6743),
        (PLATE | {"flanges": {"diameter": 16.0, "below": False}, "hub": {"diameter": 12.0, "below": 5.0}},
         "hub.diameter", 10.6743),
        (PLATE | {"flanges": {"diameter": 16.0}, "hub": {"diameter": 16.0, "above": 5.0}}, "hub.diameter", 15.95),
    ],
)  # fmt: skip
def test_bad_keys_are_refused_with_what_works(keys: Keys, key: str, cure: object) -> None:
    with pytest.raises(SceneError) as refused:
        made(keys)
    assert refused.value.key == f"parts.a.{key}"
    nearest = refused.value.nearest
    if cure is not None:
        assert nearest is not None
        assert nearest.value == (pytest.approx(cure) if isinstance(cure, float) else cure)
        outer, _, inner = key.partition(".")
        made(keys | {outer: keys[outer] | {inner: nearest.value} if inner else nearest.value})


@pytest.mark.parametrize(
    ("mate", "two", "key", "cure"),
    [
        ({}, LARGE, "mates[1].number_of_belt_teeth", None),
        # L = 2 a cos(g) + pi (r1 + r2) + 2 g (r2 - r1) is 136.56 mm where the rims meet, a = 24.957 mm
        ({"number_of_belt_teeth": 45}, LARGE, "mates[1].number_of_belt_teeth", 69),
        ({"centre_distance": 20.0}, LARGE, "mates[1].centre_distance", None),
        ({"number_of_belt_teeth": 100, "centre_distance": 60.0}, LARGE, "mates[1].centre_distance", 58.611527),
        ({"number_of_belt_teeth": 110, "centre_distance": 58.0}, LARGE, "mates[1].number_of_belt_teeth", 100),
        ({"number_of_belt_teeth": 101, "centre_distance": 58.0}, LARGE, "mates[1].number_of_belt_teeth", 100),
        ({"centre_distance": 1e6}, LARGE, "mates[1].centre_distance", None),
        ({"number_of_belt_teeth": 10_000, "centre_distance": 58.0}, LARGE, "mates[1].number_of_belt_teeth", 100),
        ({"number_of_belt_teeth": 100}, LARGE | {"belt": "MXL"}, "mates[1]: parts.b.belt", None),
    ],
)
def test_drives_that_cannot_be_are_refused_with_what_works(mate: Keys, two: Keys, key: str, cure: float | None) -> None:
    with pytest.raises(SceneError) as refused:
        placed(mate, two=two)
    assert refused.value.key == key
    if cure is not None:
        assert refused.value.nearest is not None
        assert refused.value.nearest.value == pytest.approx(cure)
        placed(mate | {key.rpartition(".")[2]: refused.value.nearest.value}, two=two)


def test_to_a_pulley_of_another_belt_that_of_the_first_is_offered() -> None:
    with pytest.raises(SceneError) as refused:
        placed({"number_of_belt_teeth": 100}, two=LARGE | {"belt": "MXL"})
    assert refused.value.nearest is not None
    assert refused.value.nearest.value == "GT2"


def test_one_pitch_circle_within_the_other_is_refused() -> None:
    """Outer diameters far too small let rims be apart there: radii of 5 mm by 10 and 100 teeth differ by 71.62 mm."""
    belt = {"pitch": 5.0, "line_offset": 0.5, "groove_depth": 0.5, "groove_width": 1.0}
    one = PLATE | {"belt": belt, "number_of_teeth": 10, "bore_diameter": 3.0}
    two = one | {"number_of_teeth": 100, "outer_diameter": 40.0}
    with pytest.raises(SceneError) as refused:
        placed({"centre_distance": 50.0}, one, two)
    assert refused.value.key == "mates[1].centre_distance"
    assert refused.value.nearest is not None
    assert refused.value.nearest.value == pytest.approx(90 * 5.0 / (2 * math.pi), rel=1e-4)

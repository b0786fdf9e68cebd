"""Instances, mates in a graph and drives: where everything stands, what holds there, and what is refused."""

from __future__ import annotations

import cmath
import json
import math
import re
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pytest
import shapely
from shapely import affinity

from exporters.command.cli import main
from geometry.approximation.chords import approximate_profile
from geometry.base.placement import Placement3
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, make_parts, resolved, scene_from_resolved, scene_from_toml
from parts.scene.placing import Placing, place

GEAR = '[parts.{}]\nkind = "spur_gear"\nmodule = {}\nnumber_of_teeth = {}\nprofile_shift_coefficient = {}\n'
MATE = '[[mates]]\nkind = "external_gear_pair"\nfirst = "{}"\nsecond = "{}"\n'
AB = GEAR.format("a", 2, 20, 0) + GEAR.format("b", 2, 25, 0)
ABC = AB + GEAR.format("c", 2, 30, 0)
# a polygon of the exact outline that is off by less than this, mm
CHORDS = 1e-5


def placed(text: str) -> tuple[dict[str, Part], Placing]:
    """The parts of a scene and where they stand."""
    scene = scene_from_toml(text.encode(), "s.toml", "s")
    parts, matings = make_parts(scene, "s.toml")
    return parts, place(scene.instances, scene.drives, parts, matings, "s.toml")


def instance(key: str, text: str) -> str:
    return f"[instances.{key}]\n{text}\n"


def polygon(part: Part, chords: float = 10 * CHORDS) -> shapely.Polygon:
    """The outer outline of a part by fine chords, in its own frame."""
    points, _ = approximate_profile(part.section(0.0).region.outer, chords, arcs=False).geometry.expanded()
    return shapely.Polygon(np.stack([points.real, points.imag], axis=1))


def put(shape: shapely.Polygon, angle: float, at: Iterable[float]) -> shapely.Polygon:
    """A shape turned (rad) and moved, by shapely's own mathematics."""
    x, y, _ = at
    return affinity.translate(affinity.rotate(shape, angle, origin=(0, 0), use_radians=True), x, y)


IDLER = load_scene("idler_train")


@pytest.mark.sampled(1)
@pytest.mark.parametrize("turn", [0.0, 0.05, 0.1234, 1.7])
def test_the_gears_of_an_idler_train_touch_and_never_overlap(turn: float) -> None:
    """By polygons: no mate leaves a gap or an overlap, whatever the driver's rotation; half a pitch more, it does."""
    parts, matings = make_parts(IDLER, "idler_train")
    stand = place(IDLER.instances, IDLER.drives, parts, matings, "idler_train")
    (train,) = stand.turns
    # practicum (3.2) twice: the idler's teeth cancel
    assert train["wheel"] == pytest.approx(17 / 31, rel=1e-14)
    assert train["idler"] == pytest.approx(-17 / 23, rel=1e-14)
    shapes = {
        i.id: put(polygon(parts[i.part], CHORDS), i.rotation + turn * train[i.id] / train["driver"], i.at)
        for i in stand.instances
    }
    for one, two in (("driver", "idler"), ("idler", "wheel")):
        # chords of two flanks cut into each other by their own error, along a few mm
        assert shapes[one].intersection(shapes[two]).area < 20 * CHORDS
        assert shapes[one].distance(shapes[two]) < 3 * CHORDS
    wheel = next(i for i in stand.instances if i.id == "wheel")
    wrong = put(polygon(parts["wheel"]), wheel.rotation + turn * train["wheel"] + math.pi / 31, wheel.at)
    assert shapes["idler"].intersection(wrong).area > 0.5
    assert shapes["driver"].disjoint(shapes["wheel"])


def test_an_idler_train_stands_where_the_directions_say() -> None:
    parts, matings = make_parts(IDLER, "idler_train")
    driver, idler, wheel = place(IDLER.instances, IDLER.drives, parts, matings, "").instances
    assert (driver.at, driver.rotation, driver.placed_by) == ((0, 0, 0), 0, "origin")
    assert cmath.phase(idler.centre) == 0
    assert cmath.phase(wheel.centre - idler.centre) == pytest.approx(math.radians(60))
    distances = [m.pair.working_centre_distance for m in matings]
    assert [abs(idler.centre), abs(wheel.centre - idler.centre)] == pytest.approx(distances)
    # a scene without [instances] gives each part one of its own id
    assert {i.id: i.part for i in (driver, idler, wheel)} == {k: k for k in IDLER.parts}


def test_one_part_may_stand_several_times() -> None:
    """Two planets of one part about a sun, opposite each other: both mesh."""
    text = AB + instance("p1", 'part = "b"') + instance("p2", 'part = "b"')
    text += MATE.format("a", "p1") + "direction_deg = 30\n" + MATE.format("a", "p2") + "direction_deg = -150\n"
    parts, stand = placed(text)
    assert [(i.id, i.part) for i in stand.instances] == [("a", "a"), ("p1", "b"), ("p2", "b")]
    sun, one, two = stand.instances
    assert one.centre == pytest.approx(-two.centre)
    shapes = [put(polygon(parts[i.part]), i.rotation, i.at) for i in (sun, one, two)]
    for planet in shapes[1:]:
        assert shapes[0].intersection(planet).area < 200 * CHORDS
        assert shapes[0].distance(planet) < 30 * CHORDS


def test_the_smallest_tip_that_any_instance_asks_for_wins() -> None:
    gears = GEAR.format("a", 2, 20, 0.2) + GEAR.format("b", 2, 25, 0.3) + GEAR.format("c", 2, 30, 0.6)
    alone, _ = placed(gears + MATE.format("b", "c"))
    text = gears + instance("b1", 'part = "b"') + instance("b2", 'part = "b"\nat = [0, 500, 0]')
    both, _ = placed(text + MATE.format("a", "b1") + MATE.format("b2", "c"))
    assert both["b"].circles["tip_diameter"] == alone["b"].circles["tip_diameter"]


def test_an_instance_of_a_parts_own_id_keeps_the_others_company() -> None:
    _, stand = placed(AB + instance("b", "at = [100, 0, 0]") + instance("b2", 'part = "b"\nat = [0, 100, 5]'))
    assert [i.id for i in stand.instances] == ["a", "b", "b2"]
    _, stand = placed(AB + instance("b2", 'part = "b"\nat = [0, 100, 5]\nrotation_deg = 90'))
    assert [i.id for i in stand.instances] == ["a", "b2"]
    found = stand.instances[1].scene_from_part.apply(np.array([[1.0, 0.0, 2.0]]))
    assert found == pytest.approx(np.array([[0.0, 101.0, 7.0]]))


def test_what_nothing_places_stands_in_a_row_and_touches_nothing() -> None:
    """Gears a, b and a train c - d without a place of its own, beside a pair: all clear of each other."""
    text = ABC + GEAR.format("d", 2, 40, 0) + GEAR.format("e", 2, 12, 0) + GEAR.format("f", 2, 13, 0)
    parts, stand = placed(text + MATE.format("a", "b") + MATE.format("c", "d") + "direction_deg = 180\n")
    assert [i.placed_by for i in stand.instances] == ["origin", "mate", "row", "mate", "row", "row"]
    shapes = [put(polygon(parts[i.part]), i.rotation, i.at) for i in stand.instances]
    for index, one in enumerate(shapes):
        for other, two in enumerate(shapes[:index]):
            mated = (other, index) in ((0, 1), (2, 3))
            assert (one.distance(two) < 1e-3) == mated
            assert one.intersection(two).area < 200 * CHORDS
    assert stand.close == ()


def test_a_row_leaves_5_mm_between_the_reaches_of_its_groups() -> None:
    """Tip radii 22, 27, 32, 42 and 14; a pair to the left of the origin, a train c - d the other way round, e alone."""
    text = ABC + GEAR.format("d", 2, 40, 0) + GEAR.format("e", 2, 12, 0)
    _, stand = placed(
        text + MATE.format("a", "b") + "direction_deg = 180\n" + MATE.format("c", "d") + "direction_deg = 180\n"
    )
    first = 22 + 5 + 42 + 70
    assert [i.at[0] for i in stand.instances] == pytest.approx([0, -45, first, first - 70, first + 32 + 5 + 14])


def test_placed_instances_are_only_checked() -> None:
    """m 2, z 20 / 25 without shift: 45 mm apart, and a tooth of the first looks at a space of the second."""
    good = AB + instance("b", "at = [0, 45, 0]\nrotation_deg = {}") + MATE.format("a", "b")
    # space of b at -90 deg (-pi/2 - pi/25) when a tooth of a stands at 90 deg: z 20 has one there
    right = math.degrees(-math.pi / 2 - math.pi / 25)
    _, stand = placed(good.format(right))
    (mate,) = stand.mates
    assert mate.only_checks
    assert {c.code: c.met for c in mate.conditions} == {
        "centre_distance": True, "phase": True, "common_face_width": True,
    }  # fmt: skip
    _, stand = placed(good.format(right + 1e-3))
    assert [c.code for c in stand.mates[0].conditions if not c.met] == ["phase"]
    for distance in ("45.001", "44.999"):
        _, stand = placed(good.format(right).replace("45", distance))
        assert [c.code for c in stand.mates[0].conditions if not c.met] == ["centre_distance"]
    for height in ("10", "11", "-10"):
        _, stand = placed(good.format(right).replace("45, 0]", f"45, {height}]"))
        assert [c.code for c in stand.mates[0].conditions if not c.met] == ["common_face_width"]


@pytest.mark.parametrize(("turned", "code", "word"), [(0.0, 0, "CONTACT"), (0.02, 1, "BROKEN"), (-7.2, 0, "CONTACT")])
def test_a_broken_condition_fails_the_command(
    tmp_path_factory: pytest.TempPathFactory, capsys: pytest.CaptureFixture[str], turned: float, code: int, word: str
) -> None:
    scene = tmp_path_factory.mktemp("s") / "s.toml"
    # teeth of b are 14.4 degrees apart: half a pitch more is wrong by the whole tooth
    rotation = 180 - 7.2 + turned * (1 if abs(turned) < 1 else 2)
    text = AB + instance("b", f"at = [45, 0, 0]\nrotation_deg = {rotation}") + MATE.format("a", "b")
    scene.write_text(text, encoding="utf-8")
    assert main(["check", str(scene)]) == code
    out = capsys.readouterr().out
    assert word in out
    assert ("rotation_deg = 172.8 " in out) == (code == 1)


def test_play_is_room_for_the_phase() -> None:
    thin = "circumferential_thinning = 0.1\n"
    gears = GEAR.format("a", 2, 20, 0) + thin + GEAR.format("b", 2, 25, 0) + thin
    # j_bn = 0.2 cos 20, half of it on each side, on the base radius 25 cos 20
    room = math.degrees(0.1 / 25)
    for share, met in ((0.99, True), (1.01, False), (-0.99, True), (-1.01, False)):
        text = gears + instance("b", f"at = [45, 0, 0]\nrotation_deg = {172.8 + share * room}") + MATE.format("a", "b")
        _, stand = placed(text)
        assert all(c.met for c in stand.mates[0].conditions) == met


def test_three_gears_in_a_ring_lock() -> None:
    """z 20 each: an equilateral triangle where every pair fits on its own is found to be locked by its speeds."""
    gears = "".join(GEAR.format(k, 2, 20, 0) for k in "abc")
    ring = MATE.format("a", "b") + MATE.format("b", "c") + "direction_deg = 120\n" + MATE.format("c", "a")
    _, stand = placed(gears + ring)
    last = {c.code: c for c in stand.mates[2].conditions}
    assert last["centre_distance"].met
    assert not last["train"].met
    assert (last["train"].value, last["train"].required) == (pytest.approx(1), pytest.approx(-1))
    # four in a square turn, and the last mate only checks
    gears += GEAR.format("d", 2, 20, 0)
    square = MATE.format("a", "b") + MATE.format("b", "c") + "direction_deg = 90\n"
    square += MATE.format("c", "d") + "direction_deg = 180\n" + MATE.format("d", "a")
    _, stand = placed(gears + square)
    assert stand.mates[3].only_checks
    assert all(c.met for c in stand.mates[3].conditions)


def test_gears_that_run_into_each_other_without_a_mate_are_noticed(
    tmp_path_factory: pytest.TempPathFactory, capsys: pytest.CaptureFixture[str]
) -> None:
    folded = ABC + MATE.format("a", "b") + MATE.format("b", "c") + "direction_deg = 170\n"
    _, stand = placed(folded)
    (close,) = stand.close
    assert (close.first, close.second) == ("a", "c")
    scene = tmp_path_factory.mktemp("s") / "s.toml"
    scene.write_text(folded, encoding="utf-8")
    assert main(["check", str(scene)]) == 1
    assert "a and c run into each other" in capsys.readouterr().out
    # one above the other they do not
    _, stand = placed(AB + instance("b", "at = [10, 0, 10]") + instance("a", "at = [0, 0, 0]"))
    assert stand.close == ()
    _, stand = placed(AB + instance("b", "at = [10, 0, 9.9]") + instance("a", "at = [0, 0, 0]"))
    assert len(stand.close) == 1
    # tip radii 22 and 27: nearer than both together, and not one within what may be the other's bore
    for apart, told in ((49.0, 0), (48.9999, 1), (5.001, 1), (4.999, 0)):
        _, stand = placed(AB + instance("b", f"at = [0, {apart}, 0]") + instance("a", "at = [0, 0, 0]"))
        assert len(stand.close) == told, apart


def test_a_drive_turns_its_whole_train_and_no_other() -> None:
    text = ABC + GEAR.format("d", 2, 40, 0) + MATE.format("a", "b") + MATE.format("c", "d")
    _, stand = placed(text + '[[drives]]\ninstance = "b"\nturns = -2\n')
    assert stand.turns == ({"b": -2.0, "a": pytest.approx(2 * 25 / 20)},)


def test_a_scene_with_instances_survives_its_report() -> None:
    text = AB + instance("b1", 'part = "b"\nat = [1, 2, 3]') + MATE.format("a", "b1") + '[[drives]]\ninstance = "a"\n'
    scene = scene_from_toml(text.encode(), "s.toml", "s")
    again = scene_from_resolved(resolved(scene), "r")
    assert resolved(again) == resolved(scene)
    assert again.instances["b1"].at == [1, 2, 3]


FIXED = MATE.replace("external_gear_pair", "fixed").format("c", "a")
INB = instance("x", 'part = "b"\n{}')
DRIVE = "[[drives]]\n{}\n"
WRONG = [
    (AB + instance("x", 'part = "q"'), 'instances.x.part = "q"', "parts: a, b"),
    (AB + instance("x", 'part = "aa"'), "instances.x.part", "did you mean a"),
    (AB + instance("x", "at = [0, 0, 0]"), "instances.x.part", "is missing"),
    (AB + instance("a", 'part = "b"'), "instances.a.part", "is itself a part"),
    (AB + INB.format("") + INB.format(""), "s.toml", "[instances.x] stands there a second time"),
    (AB + instance("x y", 'part = "b"').replace("x y", '"x y"'), "instances.x y", "letters"),
    (AB + "[instances]\nx = 3\n", "instances.x", "under a name, like [instances.left]"),
    ("instances = 3\n" + AB, "instances", "[instances.left]"),
    (AB + INB.format("at = [1, 2]"), "instances.x.at", "place [x, y, z]"),
    (AB + INB.format("at = [1, 2, 3, 4]"), "instances.x.at", "place [x, y, z]"),
    (AB + INB.format('at = [1, 2, "3"]'), "instances.x.at", "number"),
    (AB + INB.format("at = [1, 2, 1e9]"), "instances.x.at", "at most 1e+06"),
    (AB + INB.format("at = 3"), "instances.x.at", "list"),
    (AB + INB.format("at = [1, 2, inf]"), "instances.x.at[3]", "finite"),
    (AB + INB.format('rotation_deg = "x"'), "instances.x.rotation_deg", "number"),
    (AB + INB.format("rotation_deg = 1e6"), "instances.x.rotation_deg", "at most 36000"),
    (AB + INB.format("rotation = 3"), "instances.x.rotation", "did you mean rotation_deg"),
    (AB + INB.format("") + MATE.format("a", "b"), "mates[1].second", "its instances: x"),
    (AB + INB.format("") + MATE.format("y", "a"), "mates[1].first", "instances: a, x"),
    (AB + MATE.format("a", "a"), "mates[1].second", "no mate in itself"),
    (AB + MATE.format("a", "b") + MATE.format("a", "b"), "mates[2]", "listed twice"),
    (AB + INB.format("rotation_deg = 3") + MATE.format("a", "x"), "instances.x.rotation_deg", "mates[1]"),
    (ABC + MATE.format("b", "c") + MATE.format("a", "b"), "mates[2].first", "direction_deg = 180"),
    (ABC + MATE.format("a", "b") + MATE.format("c", "b"), "mates[2].first", "swap"),
    (ABC + MATE.format("a", "b") + FIXED, "mates[2].first", "put this mate before all others of a"),
    (ABC + GEAR.format("d", 2, 9, 0.6) + MATE.format("a", "b") + MATE.format("c", "d") + MATE.format("b", "c"),
     "mates[2].first", "mates[3]"),
    (ABC + GEAR.format("d", 2, 9, 0.6) + MATE.format("a", "b") + MATE.format("c", "d") + MATE.format("b", "d"),
     "mates[2].first", "start its train at a"),
    (AB + DRIVE.format('instance = "q"'), "drives[1].instance", "instances: a, b"),
    (AB + DRIVE.format("turns = 1"), "drives[1].instance", "is missing"),
    (AB + DRIVE.format('instance = "a"\nturns = 0'), "drives[1].turns", "must not be 0"),
    (AB + DRIVE.format('instance = "a"\nturns = "x"'), "drives[1].turns", "number"),
    (AB + DRIVE.format('instance = "a"\nspeed = 1'), "drives[1].speed", "unknown key"),
    (AB + MATE.format("a", "b") + DRIVE.format('instance = "a"') + DRIVE.format('instance = "b"'),
     "drives[2].instance", "the drive of a"),
    (AB + "[drives]\nx = 1\n", "drives", "[[drives]]"),
    (AB + '[[exports]]\nformat = "dxf"\nassembly = true\n', "exports[1].assembly", '"step", "3mf"'),
    (AB + '[[exports]]\nformat = "stl"\nassembly = true\n', "exports[1].assembly", '"step", "3mf"'),
    (AB + '[[exports]]\nformat = "3mf"\nassembly = 1\n', "exports[1].assembly", "true or false"),
]  # fmt: skip


def test_a_mate_that_begins_too_late_works_before_the_others() -> None:
    _, stand = placed(ABC + FIXED + "offset = [0.0, 0.0, 20.0]\n" + MATE.format("a", "b"))
    assert {i.id: i.at for i in stand.instances} == {
        "c": (0.0, 0.0, 0.0), "a": (0.0, 0.0, 20.0), "b": pytest.approx((45.0, 0.0, 20.0))
    }  # fmt: skip


@pytest.mark.parametrize(("text", "named", "remedy"), WRONG)
def test_what_is_wrong_is_told_in_one_line(text: str, named: str, remedy: str) -> None:
    with pytest.raises(SceneError) as caught:
        placed(text)
    told = str(caught.value)
    assert named in told
    assert remedy in told
    assert "\n" not in told


def test_placements_in_space_compose_and_undo() -> None:
    one, two = Placement3.about_z(0.7, (1.0, -2.0, 3.0)), Placement3.about_z(-2.1, (4.0, 0.5, -1.0))
    points = np.array([[1.0, 2.0, 3.0], [-4.0, 0.0, 2.0]])
    assert (one @ two).apply(points) == pytest.approx(one.apply(two.apply(points)))
    assert one.inverse().apply(one.apply(points)) == pytest.approx(points)
    assert one.apply(np.array([[1.0, 0.0, 0.0]])) == pytest.approx(
        np.array([[1 + math.cos(0.7), -2 + math.sin(0.7), 3.0]])
    )


@pytest.mark.parametrize(
    "axis", [(1.0, 0.0, 0.0), (0.3, -0.4, 0.5), (1e-9, 0.0, -3.0), (0.0, 0.0, -2.0), (0.0, 0.0, 4.0)]
)
def test_an_axis_lays_a_part_down_by_the_shortest_way(axis: tuple[float, float, float]) -> None:
    """Against Rodrigues' formula about z x axis; turned first, moved last."""
    text = AB + instance("a", f"at = [1, 2, 3]\nrotation_deg = 30\naxis = {list(axis)}")
    _, stand = placed(text)
    matrix = next(i for i in stand.instances if i.id == "a").scene_from_part.matrix()
    unit = np.array(axis) / np.linalg.norm(axis)
    across = np.cross([0.0, 0.0, 1.0], unit)
    size = np.linalg.norm(across)
    if size == 0:
        across, size = np.array([1.0, 0.0, 0.0]), 1.0
    k = across / size
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    sine, cosine = np.linalg.norm(np.cross([0.0, 0.0, 1.0], unit)), unit[2]
    laid = np.eye(3) + sine * cross + (1 - cosine) * cross @ cross
    c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
    assert np.allclose(matrix[:, :3], laid @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), atol=1e-14)
    assert np.allclose(matrix @ [0, 0, 1, 1], np.array([1, 2, 3]) + unit, atol=1e-14)


def test_a_tilted_part_stands_in_its_place_in_files_and_in_the_way(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    plate = '[parts.{}]\nkind = "plate"\nwidth = 20.0\nheight = {}.0\n'
    text = plate.format("a", 40) + plate.format("b", 30)
    text += instance("a", "at = [0, 0, 0]") + instance("b", "at = [10, 0, 5]\naxis = [0, 1, 0]")
    text += "[checks]\ninterference = true\n"
    file, lying = tmp_path / "s.toml", text.replace("10, 0, 5", "100, 0, 5")
    exports = "".join(f'[[exports]]\nformat = "{name}"\nassembly = true\n' for name in ("step", "3mf"))
    file.write_text(text, encoding="utf-8")
    assert main(["check", str(file)]) == 1
    file.write_text(lying + exports, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path / "out")]) == 0
    capsys.readouterr()
    report = json.loads((tmp_path / "out" / "s" / "report.json").read_text("utf-8"))
    assert report["instances"]["b"]["axis"] == [0.0, 1.0, 0.0]
    assert "axis" not in report["instances"]["a"]
    fixed = '[[mates]]\nkind = "fixed"\nfirst = "a"\nsecond = "b"\n'
    # it stands by hand as its mate has it, or it is told how it does not
    for more, broken in (
        ("offset = [100, 0, 5]\naxis = [0, 2, 0]\n", []),
        ("offset = [100, 0, 5]\n", ["shaft_angle"]),
        ("axis = [0, 1, 0]\n", ["centre_distance", "height"]),
    ):
        conditions = [c for mate in placed(lying + fixed + more)[1].mates for c in mate.conditions]
        assert [c.code for c in conditions if not c.met] == broken
    for wrong, told in (
        (lying.replace("at = [100, 0, 5]\n", ""), "only for an instance that"),
        (lying.replace("[0, 1, 0]", "[0, 0, 0]"), "has no direction"),
    ):
        with pytest.raises(SceneError, match=re.escape(told)):
            placed(wrong)


def test_what_nothing_places_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    plate = '[parts.{0}]\nkind = "plate"\nwidth = 20.0\nheight = 20.0\n'
    text = "".join(map(plate.format, ("low", "high", "loose"))) + '[[mates]]\nkind = "fixed"\nfirst = "low"\n'
    file = tmp_path / "s.toml"
    file.write_text(text + 'second = "high"\noffset = [0.0, 0.0, 10.0]\n', encoding="utf-8")
    for more, told in (("", True), ("[instances.loose]\nat = [50.0, 0.0, 0.0]\n", False)):
        file.write_text(file.read_text("utf-8") + more, encoding="utf-8")
        assert main(["check", str(file)]) == 0
        assert ("neither `at` nor a mate places them, so they stand in a row: loose" in capsys.readouterr().out) is told

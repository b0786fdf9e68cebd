"""What runs into each other on the way: found where polygons of GEOS, turned step by step, find it; repeats once."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path
from random import Random
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import affinity

from exporters.production.check import gear_contact, scene_checks
from geometry.approximation.chords import approximate_profile
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import PairContact
from parts.mates.involute import GearMating
from parts.scene.load import make_parts, scene_from_dict, scene_from_toml
from parts.scene.moving_solids import Meeting, motion_found
from parts.scene.placing import Placing, place
from parts.scene.relative_path import Course
from parts.scene.shapes import Shape
from parts.scene.standing import Instance
from tests.exporters.making import run, table
from tests.parts.scene.test_trains import DRIVE, JAMES

DWELL = {"move": "dwell", "angle_deg": 60.0}
CAM = {
    "kind": "cam", "follower": "flat", "lift": 18.0, "base_circle_radius": 28.0, "face_width": 3.0,
    "bore_diameter": 6.0, "phases": [{"move": "rise", "angle_deg": 120.0, "law": "polynomial_345"}, DWELL,
               {"move": "return_", "angle_deg": 120.0, "law": "sine"}, DWELL],
}  # fmt: skip
PLATE = {"kind": "plate", "width": 50.0, "height": 30.0, "face_width": 3.0}
POST = {"kind": "pin", "diameter": 6.0, "length": 3.0}
CAM_DRIVE = [{"instance": "cam"}]


def check(folder: Path, raw: dict[str, Any], capsys: pytest.CaptureFixture[str]) -> tuple[int, dict[str, Any]]:
    """Exit code and findings of ``higherpair check``."""
    text = "".join(
        table(f"[{name}.{key}]", keys) for name in ("parts", "instances") for key, keys in raw.get(name, {}).items()
    )
    text += "".join(table(f"[[{name}]]", row) for name in ("mates", "drives") for row in raw.get(name, ()))
    file = folder / "scene.toml"
    file.write_text(text, encoding="utf-8")
    code = run("check", str(file), "--json")
    return code, json.loads(capsys.readouterr().out)


def shapes_of(parts: dict[str, Any]) -> dict[str, Shape]:
    return {name: Shape(part) for name, part in parts.items()}


@pytest.mark.parametrize(
    ("apart", "sought"), [(0.05, 8.0), (0.5, 8.0), (3.0, 8.0), (9.0, 8.0), (-0.5, 8.0), (1.0, 0.0)]
)
def test_what_lies_near_is_found_by_a_short_search(apart: float, sought: float) -> None:
    """Of two gears 46 % of a build went to all that lay within 4 mm of each other, their backlash being 0.06."""
    manifold3d = pytest.importorskip("manifold3d")
    lengths = []

    class Cube:
        def __init__(self, solid: Any) -> None:
            self.solid = solid

        def min_gap(self, other: Any, length: float) -> float:
            lengths.append(length)
            return float(self.solid.min_gap(other, length))

        def volume(self) -> float:
            return float(self.solid.volume())

        def __xor__(self, other: Any) -> Any:
            return self.solid ^ other

    solid = manifold3d.Manifold.cube((1.0, 1.0, 1.0))
    sides: Any = tuple(SimpleNamespace(slabs=None, reach=2.0, solid=x) for x in (Cube(solid), solid))
    gap, _ = Meeting(sides, 0.0, 10.0, sought).meet(complex(1.0 + apart), 0.0)
    assert gap == pytest.approx(min(max(apart, 0.0), sought), abs=1e-9)
    assert max(lengths) <= max(min(8 * apart, sought), sought / 64)


def polygon(part: dict[str, Any]) -> Any:
    made = make_parts(scene_from_dict({"parts": {"a": part}}, "t", "t"), "t")[0]["a"]
    points, _ = approximate_profile(made.section(0.0).region.outer, 0.001, arcs=False).geometry.expanded()
    return shapely.Polygon(np.column_stack([points.real, points.imag]))


def deepest(one: Any, two: Any, places: tuple[complex, complex], rates: tuple[float, float], whole: int) -> float:
    """The greatest common area over many turns, by GEOS."""
    found = 0.0
    for t in np.linspace(0, whole, 240 * whole + 1):
        moved = [
            affinity.translate(affinity.rotate(p, 360 * t * w, origin=(0, 0)), at.real, at.imag)
            for p, at, w in zip((one, two), places, rates, strict=True)
        ]
        found = max(found, moved[0].intersection(moved[1]).area)
    return found


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("x", "strikes"), [(48.5, True), (48.9, True), (49.05, False), (60.0, False)])
def test_a_post_in_the_way_of_a_cam_is_found_though_the_first_pose_is_clear(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], x: float, strikes: bool
) -> None:
    """The cam reaches 28 + 18 mm, the post 3 mm: they meet below 49 mm."""
    placed = {"cam": {"at": [0, 0, 0]}, "post": {"at": [x, 0, 0]}}
    raw = {"parts": {"cam": CAM, "post": POST}, "instances": placed}
    assert check(tmp_path, raw, capsys) == (0, {"motion": {"one_pose": True}})
    code, found = check(tmp_path, {**raw, "drives": CAM_DRIVE}, capsys)
    assert code == int(strikes)
    assert len(found.get("solids", [])) == int(strikes)
    assert found["motion"]["poses"] <= 720 + 12
    if strikes:
        area = deepest(polygon(CAM), shapely.Point(0, 0).buffer(3.0, 256), (0j, complex(x)), (1.0, 0.0), 1)
        # what lies inside both for certain
        assert found["solids"][0]["volume"] == pytest.approx(3 * area, rel=0.1, abs=0.1)
        assert 0 < found["solids"][0]["drive_turn_deg"] < 360


def test_a_large_post_that_is_grazed_is_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A pin of 6 goes round at 30 mm, a post of 100 stands 0.005 mm too near, then as much too far."""
    posts = {"pin": POST, "post": POST | {"diameter": 100.0}, "disk": POST | {"diameter": 10.0}}
    mates = [{"kind": "fixed", "first": "disk", "second": "pin", "offset": [-18.0, -24.0, 5.0]}]
    for away, grazed in ((-0.005, True), (0.005, False)):
        stands = {"disk": {"at": [0.0, 0.0, 0.0]}, "post": {"at": [83.0 + away, 0.0, 5.0]}}
        raw = {"parts": posts, "instances": stands, "mates": mates, "drives": [{"instance": "disk", "turns": 1.0}]}
        code, found = check(tmp_path, raw, capsys)
        assert (code == 1) == grazed == bool(found.get("solids", [])), away


@pytest.mark.parametrize(("y", "strikes"), [(28.5, False), (27.5, True)])
def test_what_stands_still_beside_a_lying_gear_is_not_swept(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], y: float, strikes: bool
) -> None:
    """The plate ends at y = 20 and turned on its axis would reach the gear, whose tips turn at 8 mm: the one pose of
    what the gear sweeps tells all."""
    gear = {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 14, "profile_shift_coefficient": 0.3,
            "tip_diameter": 16.0, "face_width": 6.0}  # fmt: skip
    plate = {"kind": "plate", "width": 60.0, "height": 40.0, "face_width": 10.0}
    placed = {"plate": {"at": [0, 0, -5]}, "gear": {"at": [0, y, 0], "axis": [1, 0, 0]}}
    raw = {"parts": {"gear": gear, "plate": plate}, "instances": placed,
           "drives": [{"instance": "gear", "turns": 1.0}]}  # fmt: skip
    code, found = check(tmp_path, raw, capsys)
    assert code == int(strikes)
    assert strikes or found["motion"] == {"pairs": 1, "tested": 1, "poses": 1, "uncovered": []}


@pytest.mark.parametrize(("top", "strikes"), [(-11.5, False), (-9.5, True)])
def test_a_small_pin_under_a_long_lying_shaft_is_decided(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], top: float, strikes: bool
) -> None:
    """The shaft's thin part ends at z = -10; its collar keeps circles from telling so, and gaps of the pin were sought
    to 0.05 mm only, which left 720 poses too few: clear pairs were told as perhaps 0.13 mm in each other."""
    arm = {"kind": "plate", "width": 210.0, "height": 8.0, "face_width": 2.0}
    steps = [{"diameter": 100.0, "length": 8.0}, {"diameter": 20.0, "length": 250.0}]
    raw = {
        "parts": {"arm": arm, "pin": {"kind": "pin", "diameter": 4.0, "length": 5.0},
                  "shaft": {"kind": "shaft", "steps": steps}},
        "instances": {"arm": {"at": [0, 0, -22]}, "pin": {}, "shaft": {"at": [100, -175, 0], "axis": [0, 1, 0]}},
        "mates": [{"kind": "fixed", "first": "arm", "second": "pin", "offset": [100, 0, top + 17.0]}],
        "drives": [{"instance": "arm", "turns": 1.0}],
    }  # fmt: skip
    code, found = check(tmp_path, raw, capsys)
    assert code == int(strikes)
    assert strikes == ("solids" in found)
    assert found["motion"]["uncovered"] == []


@pytest.mark.sampled(1)
@pytest.mark.parametrize("slow", [0.01, 0.0001])
def test_a_carrier_far_slower_than_its_satellites_brings_them_to_a_post(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], slow: float
) -> None:
    # 400 turns of a satellite move the carrier by a fraction of a turn: the post was never reached, and all was clear
    file = tmp_path / "s.toml"
    text = table("[[assemblies]]", {"kind": "planetary_set", "teeth": [24, 24, 72], "held": "none"})
    text += table("[[drives]]", {"instance": "carrier", "turns": slow})
    text += table("[parts.post]", {"kind": "pin", "diameter": 2.0, "length": 5.0})
    text += table("[parts.base]", {"kind": "plate", "width": 10.0, "height": 10.0, "face_width": 3.0})
    text += table("[instances.base]", {"part": "base", "held": True})
    text += table("[[mates]]", {"kind": "coaxial", "first": "ring", "second": "base", "height": -60.0})
    text += table("[[mates]]", {"kind": "fixed", "first": "base", "second": "post", "offset": [30.0, 51.96, 62.0]})
    file.write_text(text, encoding="utf-8")
    assert run("check", str(file), "--json") == 1
    struck = json.loads(capsys.readouterr().out)["solids"]
    assert {one["first"] for one in struck} == {"satellite_1", "satellite_2", "satellite_3"}
    assert all(one["volume"] == pytest.approx(5 * np.pi, rel=0.01) for one in struck)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("teeth", "turns", "strikes"), [((997, 1009), 700, True), ((5003, 5009), 3500, False)])
def test_carried_plates_that_meet_after_hundreds_of_turns_are_found_or_told(
    teeth: tuple[int, int], turns: int, strikes: bool
) -> None:
    # the first 400 turns pass clear: the pair was called so, though they meet in the 700th, or where nobody has looked
    parts = make_parts(scene_from_dict({"parts": {"plate": {**PLATE, "width": 0.3, "height": 0.2}}}, "t", "t"), "t")[0]
    ratio = Fraction(teeth[0], teeth[1])

    def pose(key: str, t: Real) -> tuple[Complex, Real]:
        if key == "one":
            return 50 * np.exp(2j * np.pi * t), 2 * np.pi * t
        return 100 - 50 * np.exp(-2j * np.pi * float(ratio) * (t - turns)), -2 * np.pi * float(ratio) * t

    ends = [Instance(key, "plate", (place.real, place.imag, 0.0), float(turn)) for key in ("one", "two")
            for place, turn in [pose(key, np.float64(0.0))]]  # fmt: skip
    rates = {"one": (Fraction(1), Fraction(1)), "two": (-ratio, -ratio)}
    found = motion_found(Placing(tuple(ends)), shapes_of(parts), Course(pose, rates), set())
    if strikes:
        (struck,) = found.struck
        assert struck.time == pytest.approx(turns, abs=0.01)
    else:
        (told,) = found.uncovered
        assert told.share == pytest.approx(400 / sum(teeth), rel=1e-3)


def geared_cams(a: float) -> dict[str, Any]:
    """Two cams on shafts that wheels of 20 and 30 teeth join below them."""
    cam = {**CAM, "lift": 16.0}
    wheels = {
        name: {"kind": "spur_gear", "module": a / 25, "number_of_teeth": z, "face_width": 5}
        for name, z in (("w1", 20), ("w2", 30))
    }
    mates = [{"kind": "external_gear_pair", "first": "w1", "second": "w2"}]
    mates += [{"kind": "fixed", "first": w, "second": c, "offset": [0, 0, 6]} for w, c in (("w1", "c1"), ("w2", "c2"))]
    return {"parts": {**wheels, "c1": cam, "c2": cam}, "mates": mates, "drives": [{"instance": "w1"}]}


def test_two_cams_on_geared_shafts_are_held_over_their_common_period(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """They start clear and meet first in the second turn: the common period is three turns of the first."""
    code, found = check(tmp_path, geared_cams(84.0), capsys)
    cam = polygon({**CAM, "lift": 16.0})
    other = affinity.rotate(cam, found["mates"][0]["second_rotation_deg"], origin=(0, 0))
    area = deepest(cam, other, (0j, 84 + 0j), (1.0, -2 / 3), 3)
    assert code == 1
    (solid,) = found["solids"]
    assert solid["volume"] == pytest.approx(3 * area, rel=0.01)
    assert solid["drive_turn_deg"] > 360


@pytest.mark.parametrize("first", ["pin", "slot"])
@pytest.mark.parametrize(("end", "length", "strikes"), [(66.0, 7.9, False), (60.0, 7.9, True), (60.0, 4.4, False)])
def test_a_pin_of_a_rack_runs_against_the_end_of_its_slot(
    first: str, end: float, length: float, strikes: bool, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Half a turn of 20 teeth of module 2 moves the rack by 20 pi mm, the slot's walls stand 0.2 mm from the pin.

    The pin begins 4.5 mm below the plate: a short one passes under it. Either is the first of the pair.
    """
    slot = {"start": [-end, 0.0], "end": [end, 0.0], "width": 4.4}
    parts: dict[str, dict[str, Any]] = {
        "pin": {"kind": "pin", "diameter": 4.0, "length": length},
        "slot": {"kind": "plate", "width": 160.0, "height": 12.0, "face_width": 3.0, "slots": [slot]},
        "gear": {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 5.0},
        "rack": {"kind": "rack", "module": 2.0, "number_of_teeth": 40, "face_width": 5.0},
    }
    places: dict[str, dict[str, Any]] = {"pin": {}, "slot": {"at": [0.0, -27.0, -3.5]}}
    instances = {first: places.pop(first), **places, "gear": {"at": [0.0, 0.0, 0.0]}, "rack": {}}
    mates = [{"kind": "rack_pair", "first": "gear", "second": "rack", "direction_deg": -90.0},
             {"kind": "fixed", "first": "rack", "second": "pin", "offset": [0.0, -7.0, -8.0]}]  # fmt: skip
    raw = {"parts": parts, "instances": instances, "mates": mates, "drives": [{"instance": "gear", "turns": 0.5}]}
    code, found = check(tmp_path, raw, capsys)
    assert (code, len(found.get("solids", []))) == (int(strikes), int(strikes))
    if strikes:
        # the pin stands 0.2 mm off the end of the slot when it has gone 60 mm
        assert 180 * 60 / (20 * np.pi) < found["solids"][0]["drive_turn_deg"] <= 180


def test_what_lies_between_poses_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Circles of 44 mm, 88 mm apart: the cams only just touch, and no number of poses shows that they do not."""
    code, found = check(tmp_path, geared_cams(88.0), capsys)
    assert code == 0
    assert found["motion"]["poses"] <= 720
    (told,) = found["motion"]["uncovered"]
    assert (told["first"], told["second"], told["share"]) == ("c1", "c2", 1.0)
    assert 0 < told["depth"] < 1


def test_what_repeats_is_tested_once(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Three wheels run past one in the middle without touching it, geared below; then one is a degree off."""
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 30, "face_width": 5}
    wide = {"kind": "spur_gear", "module": 6.0, "number_of_teeth": 10, "face_width": 5, "circumferential_thinning": 2.0}
    names = {k: {"part": part} for part, k in (("gear", "sun"), ("wide", "middle"))}

    def found(turns: tuple[float, ...]) -> dict[str, Any]:
        mates = [{"kind": "fixed", "first": "sun", "second": "middle", "offset": [0, 0, 8]}]
        instances = dict(names)
        for k, turn in enumerate(turns):
            instances |= {f"planet_{k}": {"part": "gear"}, f"wide_{k}": {"part": "wide"}}
            mates += [
                {"kind": "external_gear_pair", "first": "sun", "second": f"planet_{k}", "direction_deg": 110.0 * k},
                {
                    "kind": "fixed",
                    "first": f"planet_{k}",
                    "second": f"wide_{k}",
                    "offset": [0, 0, 8],
                    "rotation_deg": turn,
                },
            ]
        raw = {
            "parts": {"gear": gear, "wide": wide},
            "instances": instances,
            "mates": mates,
            "drives": [{"instance": "sun"}],
        }
        code, checks = check(tmp_path, raw, capsys)
        assert code == 0
        return checks["motion"]

    alike, odd = found((24.0, 24.0, 24.0)), found((24.0, 25.0, 24.0))
    assert (alike["tested"], odd["tested"]) == (1, 2)
    assert alike["poses"] < odd["poses"] <= 2 * 733


def test_equal_satellites_are_held_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Four satellites in their ring: one contact of each mesh is sought, and the one that places the ring."""
    sought: list[tuple[str, str]] = []
    real = GearMating.contact
    gear_contact.cache_clear()

    def counted(self: GearMating, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        sought.append((type(self).__name__, self.kind))
        return real(self, phase_off, distance_off, tolerance)

    monkeypatch.setattr(GearMating, "contact", counted)
    all_in_ring = JAMES.replace('first = "planet_1"\nsecond = "ring"', 'first = "planet"\nsecond = "ring"', 1)
    scene = scene_from_toml((all_in_ring + DRIVE.format("sun", "turns = 4.0")).encode(), "s", "s")
    parts, matings = make_parts(scene, "s")
    placing = place(scene.instances, scene.drives, parts, matings, "s")
    found = scene_checks(placing, parts, scene.drives, "en", contact=True)
    gears = [mate for mate in found["mates"] if "contact_ratio" in mate]
    assert len(gears) >= 8
    assert {mate["verdict"] for mate in gears} == {"contact"}
    assert len(sought) == 3
    assert len(set(sought)) == 2


@pytest.mark.parametrize(("off_deg", "strikes"), [(0.0, False), (2.25, True)])
def test_a_satellite_turned_by_a_quarter_pitch_is_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], off_deg: float, strikes: bool
) -> None:
    """One that the sun drives and nothing joins to the ring, of 40 teeth: a quarter of a pitch is 2.25 degrees."""
    scene = scene_from_toml((JAMES + DRIVE.format("sun", "turns = 4.0")).encode(), "s", "s")
    parts, matings = make_parts(scene, "s")
    third = next(i for i in place(scene.instances, scene.drives, parts, matings, "s").instances if i.id == "planet_3")
    turned = float(np.degrees(third.rotation)) + off_deg
    text = JAMES.replace("count = 4", "count = 2\nstep_deg = 90.0") + DRIVE.format("sun", "turns = 4.0")
    odd = (
        f'[instances.odd]\npart = "planet"\nat = [{third.at[0]!r}, {third.at[1]!r}, 0.0]\nrotation_deg = {turned!r}\n'
        '[[mates]]\nkind = "external_gear_pair"\nfirst = "sun"\nsecond = "odd"\n'
        '[[mates]]\nkind = "carried"\nfirst = "carrier"\nsecond = "odd"\n'
    )
    file = tmp_path / "scene.toml"
    file.write_text(text + odd, encoding="utf-8")
    code = run("check", str(file), "--json")
    found = json.loads(capsys.readouterr().out)
    assert code == int(strikes)
    assert [{x["first"], x["second"]} for x in found.get("solids", [])] == [{"odd", "ring"}] * strikes
    phases = [c["met"] for m in found["mates"] for c in m.get("conditions", []) if c["code"] == "phase"]
    assert all(phases) is not strikes
    assert found["motion"]["tested"] == int(not strikes)


@pytest.mark.heavy
def test_random_motions_against_polygons() -> None:
    """Two parts that turn, one of them carried round or not: what 600 poses a period show is found, nothing else is."""
    random, keys = Random(13), {"cam": CAM, "post": POST, "plate": {**PLATE, "height": 20.0}}
    parts = make_parts(scene_from_dict({"parts": keys}, "t", "t"), "t")[0]
    outlines = {key: polygon(value) for key, value in keys.items()}
    for _ in range(150):
        kinds = [random.choice(list(keys)) for _ in range(2)]
        own, other, round_ = (Fraction(random.randint(-6, 6) or 1, random.randint(1, 4)) for _ in range(3))
        carrier = round_ if random.random() < 0.4 else Fraction()
        distance, starts = random.uniform(25, 75), [random.uniform(0, 6.28) for _ in range(2)]

        def pose(key: str, t: Real) -> tuple[Complex, Real]:
            if key == "one":
                return 0j * t, starts[0] + 2 * np.pi * float(own) * t  # noqa: B023
            place = distance * np.exp(2j * np.pi * float(carrier) * t)  # noqa: B023
            return place, starts[1] + 2 * np.pi * float(other) * t  # noqa: B023

        ends = Instance("one", kinds[0], rotation=starts[0]), Instance("two", kinds[1], (distance, 0.0, 0.0), starts[1])
        rates = {"one": (own,), "two": (other, carrier) if carrier else (other,)}
        found = motion_found(Placing(ends), shapes_of(parts), Course(pose, rates), set()).struck
        worst = 0.0
        for t in np.linspace(0, 12, 2401):
            moved = []
            for key, kind in zip(("one", "two"), kinds, strict=True):
                (place,), (turn,) = pose(key, np.array([t]))
                turned = affinity.rotate(outlines[kind], turn, origin=(0, 0), use_radians=True)
                moved.append(affinity.translate(turned, place.real, place.imag))
            if moved[0].intersects(moved[1]):
                worst = max(worst, 3 * moved[0].intersection(moved[1]).area)
            if worst > 1:
                break
        assert bool(found) or worst <= 1
        assert not found or worst > 0 or (found[0].volume or 0.0) < 0.5


def ring(*points: tuple[float, ...]) -> dict[str, Any]:
    names = ("r", "z", "arc")
    return {"kind": "turned", "points": [dict(zip(names, p, strict=False)) for p in points]}


@pytest.mark.parametrize(("post", "strikes"), [
    (None, False), (27.0, False), pytest.param(24.5, True, marks=pytest.mark.heavy),
])  # fmt: skip
def test_balls_that_roll_about_an_axis_need_no_poses_but_what_stands_in_their_way_is_found(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], post: float | None, strikes: bool
) -> None:
    """Balls of 8 on a circle of 20 reach 24 mm, the post is of 2: half sections part them from all that is round."""
    parts = {
        "race": ring((10, 0), (17, 0), (17, 4 - 7**0.5, -4.0), (17, 4 + 7**0.5), (17, 8), (10, 8)),
        "rotor": ring((5, 9), (18, 9), (18, 12), (5, 12)),
        "ball": {"kind": "turned", "points": [{"r": 0.0, "z": 0.0, "arc": 4.0}, {"r": 0.0, "z": 8.0}]},
        "post": ring((0, 0), (2, 0), (2, 8), (0, 8)),
    }
    places: dict[str, Any] = {"race": {"at": [0, 0, 0], "held": True}, "rotor": {}, "ball": {"count": 6}}
    places |= {} if post is None else {"post": {"at": [0.0, post, 0], "held": True}}
    mates = [
        {"kind": "coaxial", "first": "race", "second": "rotor"},
        {"kind": "fixed", "first": "rotor", "second": "ball", "offset": [20.0, 0.0, 0.0]},
    ]
    drives = [{"instance": "rotor"}]
    raw = {"parts": {key: parts[key] for key in places}, "instances": places, "mates": mates, "drives": drives}
    code, found = check(tmp_path, raw, capsys)
    assert code == int(strikes)
    assert found["motion"]["pairs"] >= 6
    assert (found["motion"]["poses"] > 0) is strikes
    assert {frozenset((x["first"], x["second"])) for x in found.get("solids", [])} >= (
        {frozenset(("ball_1", "post"))} if strikes else set()
    )

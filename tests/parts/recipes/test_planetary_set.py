"""Planetary sets told out of a few keys: phases by polygons, refusals at the recipe's keys, scenes in contact."""

from __future__ import annotations

import json
import math
import tomllib
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
import shapely
from shapely import affinity

from exporters.command.cli import main
from exporters.command.new import plain_scene
from exporters.production.check import scene_checks
from exporters.production.order import order_checks
from geometry.approximation.chords import approximate_profile
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.scene.files import built_in_scenes
from parts.scene.load import in_keys_of_file, load_scene, make_parts, resolved, scene_from_dict
from parts.scene.placing import place
from parts.scene.scene_file import SceneFile

SETS = (
    "james", "david", "one_external_one_internal", "two_internal", "differential", "ferguson", "compound_two_stage",
    "practicum_example_1", "practicum_example_2", "practicum_example_3", "james_laser", "james_print",
    "practicum_example_3_laser", "practicum_example_3_print",
)  # fmt: skip


DAVID = {"scheme": "david"}
CENTRAL = {
    "james": ("sun", "ring"), "david": ("sun", "second_sun"), "one_external_one_internal": ("sun", "ring"),
    "two_internal": ("ring", "second_ring"),
}  # fmt: skip


def scene(**keys: Any) -> SceneFile:
    return scene_from_dict({"assemblies": [{"kind": "planetary_set", **keys}]}, "t", "t")


def told(raw: dict[str, Any]) -> SceneError:
    """The refusal of a scene, as the command tells it."""

    def made() -> None:
        found = scene_from_dict(raw, "t", "t")
        with in_keys_of_file(found.origins):
            make_parts(found, "t")

    with pytest.raises(SceneError) as refusal:
        made()
    return refusal.value


def refusal(**keys: Any) -> SceneError:
    return told({"assemblies": [{"kind": "planetary_set", **keys}]})


def test_a_frame_stands_with_its_ring_and_out_of_the_way_of_larger_rims() -> None:
    # strangers: feet stood within the path of the rim of 27 teeth; a frame turned with a ring that drives
    assert refusal(teeth=[24, 30, 84], frame=True, held="first").code == "frame_holds_the_ring"
    assert refusal(teeth=[24, 24, 72], frame=True, held="none").code == "frame_holds_the_ring"
    made = resolved(scene(scheme="one_external_one_internal", teeth=[12, 27, 13, 52], module=1.0, frame=True))
    foot = next(m for m in made["mates"] if m["second"] == "foot_1")["offset"]
    tip = 1.0 * (12 + 27) / 2 + 1.0 * (27 / 2 + 1)
    assert math.hypot(*foot[:2]) - made["parts"]["foot"]["diameter"] / 2 > tip


def test_marks_of_thin_plates_and_wheels_leave_half_of_them() -> None:
    # a maker: wheels of 0.5 mm sheet were refused by the depth of marks, of which the set has no key
    parts = resolved(scene(teeth=[24, 24, 72], frame=True, face_width=0.5, plate_thickness=0.6))["parts"]
    assert [parts[wheel]["tooth_mark"]["depth"] for wheel in ("sun", "satellite", "ring")] == [0.25] * 3
    assert [parts[plate]["engraved"][0]["depth"] for plate in ("carrier", "base")] == [0.3] * 2


@pytest.mark.parametrize("module", [2.0, 4.0])
def test_screws_leave_a_wall_outside_the_roots_of_the_ring(module: float) -> None:
    """Of whatever module: 6 mm between the root circle and the holes, 5 mm outside them."""
    ring = resolved(scene(teeth=[24, 24, 72], module=module, frame=True))["parts"]["ring"]
    circle, hole = ring["holes"]["pitch_circle_diameter"] / 2, ring["holes"]["diameter"] / 2
    assert circle - hole - module * (72 / 2 + 1.25) >= 6.0
    assert ring["outer_diameter"] / 2 - circle - hole >= 5.0


def test_more_satellites_than_there_are_places_are_told_so() -> None:
    found = refusal(scheme="david", teeth=[100, 99, 100, 101], satellites=2)
    assert (found.code, found.numbers["places"]) == ("too_few_places", 1)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", SETS)
def test_every_set_is_in_contact_in_phase_and_runs_into_nothing(name: str, capsys: Any) -> None:
    assert main(["check", "--json", name]) == 0
    found = json.loads(capsys.readouterr().out)
    assert "solids" not in found
    meshes = [m for m in found["mates"] if "gear_pair" in m["kind"]]
    assert {m["verdict"] for m in meshes} == ({"clear"} if name.endswith(("laser", "print")) else {"contact"})
    assert all(c["met"] for m in found["mates"] for c in m.get("conditions", ()))


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    "keys",
    [
        {"teeth": [21, 15, 51], "satellites": 4, "direction_deg": 200.0},
        {"scheme": "david", "teeth": [25, 26, 25, 24], "satellites": 3, "identical": False, "direction_deg": 300.0},
    ],
)
def test_teeth_of_satellites_stand_in_spaces(keys: dict[str, Any]) -> None:
    """By polygons of the placed sections: no overlap, and a hundredth of a tooth more makes one."""
    made = scene(module=2.0, **keys)
    parts, matings = make_parts(made, "t")
    stand = {i.id: i for i in place(made.instances, made.drives, parts, matings, "t").instances}

    def polygon(key: str, turn: float = 0.0) -> shapely.Polygon:
        part = parts[stand[key].part]
        outline = part.section(0.0).region
        toothed = outline.holes[0] if part.kind == "ring_gear" else outline.outer
        points, _ = approximate_profile(toothed, 1e-4, arcs=False).geometry.expanded()
        shape = shapely.Polygon(np.stack([points.real, points.imag], axis=1))
        turned = affinity.rotate(shape, stand[key].rotation + turn, origin=(0, 0), use_radians=True)
        return affinity.translate(turned, *stand[key].at[:2])

    def common(first: str, second: str, turn: float) -> float:
        one, two = polygon(first), polygon(second, turn)
        ring = parts[stand[first].part].kind == "ring_gear"
        return float(two.difference(one).area if ring else one.intersection(two).area)

    for mate in (m for m in made.mates if "gear_pair" in m.__struct_config__.tag):
        ends = sorted((mate.first, mate.second), key=lambda key: parts[stand[key].part].kind)
        step = 2 * math.pi / parts[stand[ends[1]].part].keys.number_of_teeth / 100
        assert common(*ends, 0.0) < 0.02
        assert common(*ends, step) > 0.03


def signed_teeth(part: Part) -> int:
    """Below 0 of a ring."""
    return part.keys.number_of_teeth * (-1 if part.kind == "ring_gear" else 1)


def drawn(seed: int) -> tuple[SceneFile, dict[str, Any]]:
    """A set that is not refused, with the keys it was drawn as: two in three have two rims."""
    random = Random(seed)
    while True:
        scheme = random.choice(["james", "david", "one_external_one_internal", "two_internal", "david", "two_internal"])
        z1, z2, second, odd = random.randint(10, 60), random.randint(11, 40), random.randint(11, 40), 0
        if random.random() < 0.4:
            # one tooth more or less: coaxial by shifts
            odd = random.choice([-1, 1])
        teeth = {
            "james": [z1, z2, z1 + 2 * z2 + odd],
            "david": [z1, z2, second, z1 + z2 - second + odd],
            "one_external_one_internal": [z1, z2, second, z1 + z2 + second + odd],
            "two_internal": [z1 + z2, z2, second, z1 + second + odd],
        }[scheme]
        driver, held = random.sample(["first", "second", "carrier"], 2)
        keys = {
            "scheme": scheme, "teeth": teeth, "satellites": random.randint(1, 6), "identical": random.random() < 0.5,
            "spacing": random.choice(["equal", "unequal"]), "module": random.choice([0.5, 1.0, 2.5]),
            "direction_deg": random.uniform(-180, 180), "driver": driver, "held": held, "turns": 1.0,
            "helix_angle_deg": random.choice([0.0, 0.0, 18.0, -27.5]),
        }  # fmt: skip
        try:
            made = scene(**keys)
            make_parts(made, "t")
        except SceneError:
            continue
        return made, keys


@pytest.mark.parametrize(("name", "teeth", "hands"), [
    ("james", [20, 31, 80], {"sun": "left", "satellite": "right", "ring": "right"}),
    ("david", [25, 26, 25, 24], {"sun": "left", "satellite": "right", "second_satellite": "right",
                                 "second_sun": "left"}),
    ("two_internal", [60, 20, 24, 65], {"ring": "left", "satellite": "left", "second_satellite": "left",
                                        "second_ring": "left"}),
])  # fmt: skip
def test_wheels_of_a_helical_set_meet_at_one_distance_with_hands_that_mesh(
    name: str, teeth: list[int], hands: dict[str, str]
) -> None:
    """ISO 21771: inv(alpha_wt) = inv(alpha_t) + 2 tan(alpha_n) sum(x_n) / sum(z), and a_w cos(alpha_wt)."""
    from scipy.optimize import brentq

    keys = {"scheme": name, "teeth": teeth, "satellites": 1, "helix_angle_deg": -24.0, "module": 1.5}
    made = resolved(scene(**keys))["parts"]
    wheels = {name: part for name, part in made.items() if "number_of_teeth" in part}
    herringbone = resolved(scene(**keys, double_helical=True))["parts"]
    assert {name: herringbone[name] for name in wheels} == {
        name: part | {"double_helical": True} for name, part in wheels.items()
    }
    assert {name: part["hand"] for name, part in wheels.items()} == hands
    assert {part["helix_angle_deg"] for part in wheels.values()} == {24.0}
    beta, normal = math.radians(24), math.radians(20)
    section = math.atan(math.tan(normal) / math.cos(beta))
    rim = "second_satellite" if "second_satellite" in wheels else "satellite"
    found = []
    for one, two in ((CENTRAL[name][0], "satellite"), (CENTRAL[name][1], rim)):
        sign = -1 if wheels[one]["kind"] == "ring_gear" else 1
        z = wheels[one]["number_of_teeth"] + sign * wheels[two]["number_of_teeth"]
        x = wheels[one]["profile_shift_coefficient"] + sign * wheels[two]["profile_shift_coefficient"]
        wanted = math.tan(section) - section + 2 * math.tan(normal) * x / z
        working = brentq(lambda a, wanted=wanted: math.tan(a) - a - wanted, 0.0, 1.5, xtol=1e-15)
        found.append(1.5 * z / math.cos(beta) / 2 * math.cos(section) / math.cos(working))
    assert found[0] == pytest.approx(found[1], abs=1e-9)
    assert made["carrier"]["pin_circle_diameter"] == pytest.approx(2 * found[0], abs=1e-9)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("keys", ["teeth = [12, 12, 36]", "teeth = [12, 24, 60]", "teeth = [12, 24, 60]\nmodule = 0.7"])
def test_default_tips_of_satellites_yield_to_the_fillets_of_their_ring(keys: str, tmp_path: Path, capsys: Any) -> None:
    """Their cutter's fillets begin before theirs would end: by 0.00085 and 0.0005 mm they were in each other."""
    text = f'[[assemblies]]\nkind = "planetary_set"\nshaft_diameter = 3.0\npin_diameter = 3.0\n{keys}\n'
    (tmp_path / "set.toml").write_text(text + "[checks]\ninterference = true\n", encoding="utf-8")
    assert main(["check", "--json", str(tmp_path / "set.toml")]) == 0
    found = json.loads(capsys.readouterr().out)
    assert {m["verdict"] for m in found["mates"] if "gear_pair" in m["kind"]} == {"contact"}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("seed", range(300))
def test_random_sets_turn_through_their_period(seed: int) -> None:
    """No overlap, contact kept within 1e-8 modules all the way by the teeth that have passed, ratio by Willis."""
    made, keys = drawn(seed)
    parts, matings = make_parts(made, "t")
    placing = place(made.instances, made.drives, parts, matings, "t")
    found = scene_checks(placing, parts, made.drives, "en", contact=True)
    assert "solids" not in found
    assert not found["motion"]["uncovered"]
    meshes = [m for m in found["mates"] if "gear_pair" in m["kind"]]
    assert {m["verdict"] for m in meshes} == {"contact"}
    assert all(c["met"] for m in found["mates"] for c in m.get("conditions", ()))
    train = placing.train
    assert train is not None
    t = np.linspace(0, 7, 97)
    part_of = {i.id: parts[i.part] for i in placing.instances}
    for mesh in meshes:
        (at, turn), (other, turned) = (train.along(mesh[end], t) for end in ("first", "second"))
        line = np.angle(other - at)
        z1, z2 = (signed_teeth(part_of[mesh[end]]) for end in ("first", "second"))
        passed = z1 * (turn - line) + z2 * (turned - line)
        assert np.abs(np.angle(np.exp(1j * (passed - passed[0])))).max() < 2e-8
    z1, z2, *rest, z3 = keys["teeth"]
    ratio = Fraction(z2 * z3, z1 * (rest[0] if rest else z2))
    basic = -ratio if keys["scheme"] in ("james", "one_external_one_internal") else ratio
    names = {"first": CENTRAL[keys["scheme"]][0], "second": CENTRAL[keys["scheme"]][1], "carrier": "carrier"}
    turns = {end: placing.turns[0].get(name, 0.0) for end, name in names.items()}
    assert turns[keys["driver"]] == 1
    # (n1 - nH) / (n3 - nH) is the basic ratio
    willis = turns["first"] - turns["carrier"] - float(basic) * (turns["second"] - turns["carrier"])
    assert abs(willis) <= 1e-12 * max(map(abs, turns.values())) * (1 + abs(float(basic)))


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("name", "turns"),
    [
        ("james", {"sun": 4, "carrier": 1, "ring": 0}),
        ("david", {"sun": Fraction(-4, 5), "carrier": 1, "second_satellite_3": 4}),
        ("two_internal", {"carrier": 48, "ring": -7}),
        ("practicum_example_1", {"ring": 20, "wheel_7": 1}),
        ("practicum_example_2", {"wheel_1": 32, "carrier": 1}),
        ("practicum_example_3", {"wheel_1": 20, "carrier": 1}),
        ("compound_two_stage", {"first_sun": Fraction(108, 5), "second_carrier": 1}),
        ("ferguson", {"carrier": 10_000, "sun": 1}),
        # which do not tell it
        ("lesson_2", {"sun": 5, "carrier": 1}),
    ],
)
def test_drives_turn_the_sets_as_the_lesson_has_it(name: str, turns: dict[str, Fraction]) -> None:
    """Willis's formula by hand; the text's misprints beside its right values stand in the scenes."""
    made = load_scene(name)
    parts, matings = make_parts(made, name)
    (found,) = place(made.instances, made.drives, parts, matings, name).turns
    assert {key: found.get(key, 0.0) for key in turns} == pytest.approx(
        {key: float(t) for key, t in turns.items()}, rel=1e-15
    )


def test_ferguson_has_three_different_satellites() -> None:
    """101 and 100 teeth are turned to each other by thirds of what one tooth of each makes: 1/10100 of a turn."""
    made = load_scene("ferguson")
    fixed = [m for m in made.mates if m.__struct_config__.tag == "fixed" and m.second.startswith("second_satellite")]
    unit = 360 / (101 * 100)
    turned = [m.rotation_deg / unit % 1.0 for m in fixed]
    assert turned == pytest.approx([0.0, 1 / 3, 2 / 3], abs=1e-9) or turned == pytest.approx(
        [0.0, 2 / 3, 1 / 3], abs=1e-9
    )
    shifts = {
        key: made.parts[key].profile_shift_coefficient for key in made.parts if hasattr(made.parts[key], "module")
    }
    assert shifts["sun"] + shifts["satellite"] == pytest.approx(-0.4904, abs=5e-5)
    assert shifts["second_sun"] + shifts["second_satellite"] == pytest.approx(0.5093, abs=5e-5)


@pytest.mark.parametrize(
    ("keys", "key", "code"),
    [
        ({"teeth": [40, 40, 120]}, "satellites", "satellites_not_assembled"),
        ({"teeth": [24, 24, 72], "satellites": 50}, "satellites", "satellites_collide"),
        ({"teeth": [24, 24, 72], "helix_angle_deg": 45.0}, "teeth", "no_shifts_keep_all"),
        ({"teeth": [24, 24]}, "teeth", "wheels_of_scheme"),
        ({"teeth": [2, 24, 72]}, "teeth[1]", "not_allowed"),
        ({"teeth": [24, 24, 20]}, "teeth", "ring_not_above_rim"),
        ({"teeth": [24, 24, 82], "satellites": 2}, "teeth", "no_shifts_fit"),
        # distances about 2.5 mm are sought, down to none: it ended in a traceback
        ({"scheme": "two_internal", "teeth": [65, 64, 46, 50]}, "teeth", "no_shifts_fit"),
        ({"teeth": [24, 24, 72], "shifts": [0.1, 0.1, 0.5]}, "shifts", "shifts_not_coaxial"),
        ({"teeth": [24, 24, 72], "shifts": [0.1, 0.1]}, "shifts", "one_shift_a_wheel"),
        ({"teeth": [24, 24, 72], "held": "first"}, "driver", "driver_is_held"),
        ({"teeth": [24, 24, 72], "second_module": 3.0}, "second_module", "one_rim_one_module"),
        ({"scheme": "david", "teeth": [20, 20, 20, 20]}, "teeth", "transmits_nothing"),
        ({**DAVID, "teeth": [50, 30, 20, 60], "satellites": 2, "frame": True}, "frame", "frame_needs_ring_and_sun"),
        ({"teeth": [24, 24, 72], "shaft_diameter": 60.0}, "shaft_diameter", "reaches_root_circle"),
        ({"teeth": [24, 24, 72], "pin_diameter": 60.0}, "pin_diameter", "reaches_root_circle"),
        ({"teeth": [24, 24, 72], "second_shaft_diameter": 94.0}, "second_shaft_diameter", "hole_reaches_edge"),
        ({**DAVID, "teeth": [50, 30, 20, 60], "satellites": 2, "second_shaft_diameter": 200.0},
         "second_shaft_diameter", "reaches_root_circle"),
        ({"teeth": [24, 24, 72], "second_shaft_diameter": 9.0, "frame": True}, "second_shaft_diameter",
         "frame_has_one_shaft"),
    ],
)  # fmt: skip
def test_a_refusal_names_the_key_of_the_recipe(keys: dict[str, Any], key: str, code: str) -> None:
    found = refusal(**keys)
    assert (found.key, found.code) == (f"assemblies[1].{key}", code)


@pytest.mark.parametrize(
    ("keys", "broken"),
    [
        # z < 2 / sin(20 deg)^2 = 17.1 is undercut; at 44 mm a cos(alpha_w) = 45.1 mm
        ({"teeth": [10, 10, 30], "satellites": 1}, "mesh 1-2 without shifts of the rims: undercut of the satellite"),
        ({"teeth": [24, 24, 72], "working_centre_distance": 44.0}, "mesh 2-3 without shifts of the rims: no working"),
    ],
)
def test_shifts_that_are_not_found_are_refused_with_the_conditions_that_are_not_kept(
    keys: dict[str, Any], broken: str
) -> None:
    assert broken in str(refusal(**keys))


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("teeth", "satellites", "code"),
    [
        ([40, 40, 120], 3, "satellites_not_assembled"),
        ([13, 14, 42], 2, "satellites_not_assembled"),
        # shifts make room for them
        ([22, 45, 112], 4, "satellites_not_assembled"),
        ([25, 15, 55], 7, "satellites_not_assembled"),
        ([16, 10, 36], 6, "satellites_take_other_teeth"),
        ([20, 10, 40], 7, "satellites_take_other_teeth"),
    ],
)
def test_teeth_spacing_and_number_that_are_offered_for_satellites_that_do_not_go_in_are_built(
    teeth: list[int], satellites: int, code: str
) -> None:
    found = refusal(teeth=teeth, satellites=satellites)
    assert found.code == code
    assert found.nearest is not None
    scene(teeth=teeth, satellites=found.nearest.value)
    scene(teeth=[int(z) for z in str(found.numbers["teeth"]).split("/")], satellites=satellites)
    if code == "satellites_not_assembled":
        scene(teeth=teeth, satellites=satellites, spacing="unequal")
    else:
        assert refusal(teeth=teeth, satellites=satellites, spacing="unequal").code == "satellites_collide"


@pytest.mark.parametrize(
    ("teeth", "satellites", "shift", "room"),
    [
        # by the teeth alone tips of neighbours touch: half a module of shift makes them overlap by 1 mm, or keep 0.6
        ([17, 13, 43], 6, 0.5, -1.0),
        ([17, 13, 43], 6, -0.3, 0.6),
        ([33, 30, 93], 6, -0.2, -0.1),
        ([33, 30, 93], 6, -0.3, 0.1),
    ],
)
def test_neighbours_are_judged_by_the_tips_that_shifts_leave_them(
    teeth: list[int], satellites: int, shift: float, room: float
) -> None:
    """Before, by the teeth alone: tips that overlap were made, tips that keep apart were refused."""
    keys = {"teeth": teeth, "module": 1.0, "shaft_diameter": 3.0, "pin_diameter": 3.0}
    assert (sum(teeth[:2])) * math.sin(math.pi / satellites) - (teeth[1] + 2 + 2 * shift) == pytest.approx(room)
    given = {**keys, "shifts": [-shift, shift, shift]}
    if room > 0:
        scene(**given, satellites=satellites)
        return
    found = refusal(**given, satellites=satellites)
    assert (found.key, found.code) == ("assemblies[1].satellites", "satellites_collide")
    assert found.nearest is not None
    scene(**given, satellites=found.nearest.value)


def test_shifts_make_room_for_neighbours() -> None:
    """By the teeth the tips of six satellites would overlap by half a module; shifts that keep all were not sought."""
    made = scene(teeth=[33, 30, 93], satellites=6)
    parts, _ = make_parts(made, "t")
    circle, tip = parts["carrier"].keys.pin_circle_diameter, 2 * parts["satellite"].thing.tip_radius
    assert circle * math.sin(math.pi / 6) - tip >= -1e-9
    assert 2.0 * (63 * math.sin(math.pi / 6) - 32) == pytest.approx(-1.0)


def test_fewer_unequally_spaced_satellites_are_offered_where_neighbours_overlap() -> None:
    """The number that fits where they are equally spaced was tried alone, and none was told."""
    keys = {**DAVID, "teeth": [19, 39, 26, 32], "spacing": "unequal", "shaft_diameter": 3.0}
    found = refusal(**keys, satellites=6)
    assert found.code == "satellites_collide"
    assert found.nearest is not None
    scene(**keys, satellites=found.nearest.value)


@pytest.mark.parametrize(
    ("keys", "rim"),
    [
        ({"teeth": [49, 28, 109], "satellites": 1}, "satellite"),
        ({"teeth": [22, 48, 115], "satellites": 1}, "satellite"),
        ({"scheme": "one_external_one_internal", "teeth": [42, 12, 39, 93], "satellites": 4, "identical": False},
         "second_satellite"),
    ],
)  # fmt: skip
def test_satellites_follow_tooth_by_tooth_in_the_ring_as_it_is_cut(keys: dict[str, Any], rim: str) -> None:
    """Its cutter's fillets take tips off them: shifts were chosen that left contact ratios of 0.89, 0.53 and, with the
    sun, 1.04.

    ISO 21771: (sqrt(r_a1^2 - r_b1^2) - sqrt(r_a2^2 - r_b2^2) + a sin(alpha_w)) / p_b.
    """
    parts, _ = make_parts(scene(**keys, module=1.0, shaft_diameter=3.0, pin_diameter=3.0), "t")
    pinion, ring = parts[rim].thing, parts["ring"].thing
    distance = parts["carrier"].keys.pin_circle_diameter / 2
    line = math.sqrt(distance**2 - (ring.base_radius - pinion.base_radius) ** 2)
    ends = [math.sqrt(gear.tip_radius**2 - gear.base_radius**2) for gear in (pinion, ring)]
    assert (ends[0] - ends[1] + line) / (math.pi * math.cos(math.radians(20))) >= 1.1
    if rim == "satellite":
        sun = parts["sun"].thing
        line = math.sqrt(distance**2 - (sun.base_radius + pinion.base_radius) ** 2)
        ends[1] = math.sqrt(sun.tip_radius**2 - sun.base_radius**2)
        assert (ends[0] + ends[1] - line) / (math.pi * math.cos(math.radians(20))) >= 1.1


@pytest.mark.parametrize("keys", [{"teeth": [12, 12, 36]}, {**DAVID, "teeth": [50, 30, 20, 60]}])
def test_a_backlash_is_refused_by_what_all_pairs_of_the_set_take(keys: dict[str, Any]) -> None:
    """Before, what one pair takes was offered, which the next one did not, in a key that nobody can type."""
    found = refusal(**keys, satellites=2, normal_backlash=3.0)
    assert (found.key, found.code) == ("assemblies[1].normal_backlash", "backlash_leaves_no_teeth")
    assert found.nearest is not None
    most = found.nearest.value
    assert isinstance(most, float)
    make_parts(scene(**keys, satellites=2, normal_backlash=most), "t")
    assert refusal(**keys, satellites=2, normal_backlash=1.001 * most).key == "assemblies[1].normal_backlash"


def distance_of(teeth: int, total: float, beta: float = 0.0) -> float:
    """inv a_wt = inv a_t + 2 tan a_n x / z, a = m_n z cos a_t / (2 cos beta cos a_wt), m_n = 1; z and x with signs."""
    from scipy.optimize import brentq

    normal = math.radians(20)
    angle = math.atan(math.tan(normal) / math.cos(beta))
    value = math.tan(angle) - angle + 2 * math.tan(normal) * total / teeth
    working = brentq(lambda a: math.tan(a) - a - value, 1e-6, 1.2, xtol=1e-15)
    return float(teeth * math.cos(angle) / (2 * math.cos(beta) * math.cos(working)))


def test_shifts_that_are_given_make_one_distance() -> None:
    """The sun's and the satellite's by their sum, the ring's by its difference to the satellite's."""
    for beta in (0.0, 15.0):
        keys = {"teeth": [24, 24, 72], "helix_angle_deg": beta, "module": 1.0}
        found = refusal(**keys, shifts=[0.1, 0.15, 0.6])
        assert (found.key, found.code) == ("assemblies[1].shifts", "shifts_not_coaxial")
        assert found.numbers["first"] == pytest.approx(distance_of(48, 0.25, math.radians(beta)), rel=1e-9)
        assert found.numbers["second"] == pytest.approx(distance_of(48, 0.45, math.radians(beta)), rel=1e-9)
        made = scene(**keys, shifts=[0.1, 0.15, 0.4])
        circle = getattr(made.parts["carrier"], "pin_circle_diameter")  # noqa: B009
        assert circle / 2 == pytest.approx(distance_of(48, 0.25, math.radians(beta)), abs=1e-6)
    # inv a_w = 0.0149 - 0.0152 is none
    found = refusal(teeth=[24, 24, 72], shifts=[-0.5, -0.5, -1.5])
    assert (found.key, found.code) == ("assemblies[1].shifts", "shifts_leave_no_angle")
    assert distance_of(48, -0.98) < 23.0
    scene(teeth=[24, 24, 72], shifts=[-0.49, -0.49, -1.47])


def test_the_most_satellites_that_fit_are_named() -> None:
    """Ferguson with 50: tips of neighbours keep apart up to pi / asin of tip diameter over twice the distance."""
    keys = {"scheme": "david", "teeth": [100, 101, 100, 99], "identical": False, "working_centre_distance": 200.0}
    most = math.floor(math.pi / math.asin(2 * (101 + 2) / 2 / (100 + 101)))
    for found, number in ((refusal(satellites=50, **keys), most), (refusal(teeth=[24, 24, 72], satellites=50), 4)):
        assert found.nearest is not None
        assert (found.nearest.side, found.nearest.value) == ("at_most", number)


def test_a_key_of_a_part_that_the_recipe_made_is_told_with_the_assembly() -> None:
    made = {"assemblies": [{"kind": "planetary_set", "teeth": [24, 24, 72], "face_width": 4.0}]}
    assert told(made | {"parts": {"sun": {"tip_diameter": 20.0}}}).key == "parts.sun.tip_diameter"
    assert told(made | {"parts": {"pin": {"length": 0.0}}}).key == "parts.pin.length"
    assert told(made | {"parts": {"pin": 5}}).key == "parts.pin"
    assert told({"assemblies": made["assemblies"] * 2}).key == "assemblies[2].name"
    assert told(made | {"parts": {"sun": {"module": 3.0}}}).key == "parts.sun.module"


def test_what_a_scene_says_of_a_part_replaces_the_other_form_of_a_key() -> None:
    # a sun for the shaft of a motor: its flat is 0.5 mm off the circle, so the bore lacks a segment
    flat = {"shape": "D", "diameter": 8.0, "flat": 7.5}
    made = {"assemblies": [{"kind": "planetary_set", "teeth": [12, 18, 48], "density": 2.0, "material": "own"}]}
    plain = make_parts(scene_from_dict(made, "t", "t"), "t")[0]["sun"]
    own = {"parts": {"sun": {"bore": flat, "material": "steel"}, "carrier": {"material": "steel"}}}
    parts = make_parts(scene_from_dict(made | own, "t", "t"), "t")[0]
    segment = 16 * math.acos(3.5 / 4) - 3.5 * math.sqrt(16 - 3.5**2)
    volumes = [part.mass / part.density * 1e6 for part in (parts["sun"], plain) if part.mass and part.density]
    assert volumes[0] - volumes[1] == pytest.approx(10.0 * segment, rel=1e-9)
    keys = scene_from_dict(made | own, "t", "t").parts
    assert [keys[name].density for name in ("sun", "carrier", "satellite")] == [None, None, 2.0]
    # both forms in one table stay a refusal
    both = {"parts": {"sun": {"bore": flat, "bore_diameter": 8.0}}}
    assert told(made | both).key == "parts.sun.bore_diameter"


@pytest.mark.parametrize("name", ["compound_two_stage", "practicum_example_1", "ferguson"])
def test_the_expanded_scene_is_the_same_scene(name: str) -> None:
    text = built_in_scenes()[name].read_text("utf-8")
    plain = tomllib.loads(plain_scene(text, name))
    assert "assemblies" not in plain
    assert resolved(scene_from_dict(plain, "t", name)) == resolved(load_scene(name))


def test_new_prints_a_set_that_builds(tmp_path: Path, capsys: Any) -> None:
    assert main(["new", "planetary_set", "--out", str(tmp_path / "a.toml")]) == 0
    assert main(["new", "planetary_set", "--expand", "--out", str(tmp_path / "b.toml")]) == 0
    for file in ("a.toml", "b.toml"):
        assert main(["check", "-q", str(tmp_path / file)]) == 0
    assert resolved(load_scene(str(tmp_path / "a.toml"))) | {"name": ""} == resolved(
        load_scene(str(tmp_path / "b.toml"))
    ) | {"name": ""}


def test_the_second_shaft_goes_through_the_upper_plate_alone() -> None:
    """A ring has none, so the carrier is fixed on it; wheel 3 of two suns is, and the plate turns about it."""
    keys: dict[str, Any] = {"shaft_diameter": 8.0, "second_shaft_diameter": 12.0, "clearance": 0.2}
    for more, bores in (
        ({"teeth": [24, 24, 72]}, {"sun": 8.0, "carrier": 8.2, "upper_carrier": 12.0}),
        ({**DAVID, "teeth": [50, 30, 20, 60], "satellites": 2},
         {"sun": 8.0, "second_sun": 12.0, "carrier": 8.2, "upper_carrier": 12.2}),
    ):  # fmt: skip
        made = scene(**keys, **more)
        parts, matings = make_parts(made, "t")
        told_bores = {part: resolved(made)["parts"][part]["bore_diameter"] for part in bores}
        assert told_bores == pytest.approx(bores)
        assert made.instances["upper_carrier"].part == "upper_carrier"
        placing = place(made.instances, made.drives, parts, matings, "t")
        assert "solids" not in scene_checks(placing, parts, made.drives, "en", contact=True)


@pytest.mark.parametrize("pin", [18.0, 36.0])
def test_pins_may_be_as_thick_as_the_satellites_let_them(pin: float) -> None:
    # before: the carrier's mark ran into their seats, the crank was too short for its handle: keys that nobody types
    keys = {"teeth": [20, 30, 80], "satellites": 4, "module": 1.5, "shaft_diameter": 6.0, "frame": True}
    parts, _ = make_parts(scene(**keys, pin_diameter=pin), "t")
    # the holes of shaft and handle stand apart
    assert parts["crank"].keys.arm_length > (6.0 + pin) / 2
    assert refusal(**keys, pin_diameter=42.0).key == "assemblies[1].pin_diameter"


def test_a_second_stage_that_does_not_fit_is_told_the_turn_of_its_own_mate(tmp_path: Path) -> None:
    text = built_in_scenes()["compound_two_stage"].read_text("utf-8")
    for asked, met in ((234.0, True), (30.0, False)):
        (tmp_path / "s.toml").write_text(text.replace("rotation_deg = 234.0", f"rotation_deg = {asked}"), "utf-8")
        made = load_scene(str(tmp_path / "s.toml"))
        stand = place(made.instances, made.drives, *make_parts(made, ""), "")
        (found,) = [c for mate in stand.mates for c in mate.conditions if c.code == "fixed_phase" and c.required]
        assert found.met is met
        assert found.required == pytest.approx(asked)
        # the sun has twelve or ten teeth: what fits comes again with each
        assert math.remainder(found.value - 234.0, 36.0) == pytest.approx(0.0, abs=1e-9)


def held(made: SceneFile) -> dict[str, Any]:
    """What holding the order of a scene shows."""
    parts, matings = make_parts(made, "t")
    placing = place(made.instances, made.drives, parts, matings, "t")
    return order_checks(made.steps, placing, parts, "en")


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("made", "steps"),
    [
        (lambda: load_scene("james"), 5), (lambda: load_scene("differential"), 5), (lambda: load_scene("david"), 7),
        (lambda: load_scene("ferguson"), 7), (lambda: load_scene("two_internal"), 7),
        (lambda: load_scene("one_external_one_internal"), 7), (lambda: load_scene("james_laser"), 10),
        (lambda: load_scene("practicum_example_3_print"), 10), (lambda: load_scene("compound_two_stage"), 11),
        (lambda: load_scene("practicum_example_1"), 10), (lambda: load_scene("practicum_example_2"), 9),
        (lambda: load_scene("practicum_example_3"), 7),
        (lambda: scene(teeth=[24, 24, 72], helix_angle_deg=20.0), 5),
        # no spacers; each satellite for itself
        (lambda: scene(scheme="david", teeth=[50, 30, 20, 60], axial_gap=0.0, spacing="unequal", satellites=2), 6),
        (lambda: scene(scheme="one_external_one_internal", teeth=[12, 27, 13, 52], module=1.0, frame=True), 12),
    ],
)  # fmt: skip
def test_a_set_goes_together_from_below(made: Any, steps: int) -> None:
    """Every part reaches its place straight, and satellites do not under plate or wheels that lie over them."""
    one = made()
    found = held(one)
    assert (found["steps"], found["hindered"]) == (steps, [])
    last = max(k for k, step in enumerate(one.steps) if any("upper_carrier" in name for name in step.bring))
    first = min(k for k, step in enumerate(one.steps) if any("satellite" in name for name in step.bring))
    one.steps.insert(first, one.steps.pop(last))
    assert any("satellite" in row["coming"] and "carrier" in row["standing"] for row in held(one)["hindered"])


def test_beside_parts_of_the_scene_a_set_tells_no_order() -> None:
    """It is a part of larger drives: their scenes were to bring in each of their own parts, or were refused."""
    raw = {"assemblies": [{"kind": "planetary_set", "teeth": [24, 24, 72]}],
           "parts": {"more": {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 20}}}  # fmt: skip
    assert not scene_from_dict(raw, "t", "t").steps
    own = {"bring": ["more"], "to": "carrier"}
    assert scene_from_dict(raw | {"steps": [own]}, "t", "t").steps[-1].bring == ["more"]
    # what a scene says of parts of the set adds nothing
    changed = raw | {"parts": {"sun": {"colour": "#ffffff"}}, "instances": {"sun": {"title": "S"}}}
    assert len(scene_from_dict(changed, "t", "t").steps) == 5


def test_a_herringbone_has_no_order() -> None:
    assert not scene(teeth=[24, 24, 72], helix_angle_deg=20.0, double_helical=True).steps


def test_wheels_of_a_set_take_face_chamfers_in_their_own_tables() -> None:
    """To print a set: below, the outside of the ring is less by the chamfer, its teeth are farther from the axis."""
    keys = {"kind": "planetary_set", "teeth": [24, 24, 72], "satellites": 3, "module": 1.5, "frame": True}
    raw = {"assemblies": [keys], "parts": {"ring": {"face_chamfer": {"below": 0.3}}, "sun": {"face_chamfer": 0.2}}}
    parts = make_parts(scene_from_dict(raw, "t", "t"), "t")[0]
    assert [parts[name].is_plate for name in ("ring", "sun", "satellite")] == [False, False, True]
    body = parts["ring"].body(0.0)
    (cap,) = (c for c in body.caps if not c.up)
    outside, teeth = (body.loop_profile(loop) for loop in (cap.outer, cap.holes[0]))
    assert outside.reach() == pytest.approx(parts["ring"].thing.outer_radius - 0.3, rel=1e-12)
    assert teeth.reach() == pytest.approx(parts["ring"].thing.root_radius + 0.3, rel=1e-12)

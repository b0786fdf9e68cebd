"""The two-disk power table of flat parts: assembled, parallel, and free over its whole workspace, by polygons."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from fractions import Fraction
from itertools import combinations
from typing import Any

import numpy as np
import pytest
import shapely

from exporters.command.cli import main
from geometry.approximation.chords import approximate_profile
from geometry.kinematics.two_disk import TwoDisk
from parts.base.refusal import SceneError
from parts.scene.interference import by_contact, solid_overlaps
from parts.scene.load import in_keys_of_file, load_scene, make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from parts.scene.scene_file import SceneFile
from parts.scene.shapes import Shape
from parts.scene.workspace import workspace_found
from tests.sampling import some_of

Flat = tuple[str, float, float, shapely.Geometry]
# the table to print, without its beds
PRINT = {"module": 1.8, "drive": "worms", "clearance": 0.4, "fit": 0.1, "platform_size": 72.0, "normal_backlash": 0.2}
# what a kerf of 0.2 may cut away: nothing narrower than twice that stays
KERF = 0.2


def scene(**keys: Any) -> SceneFile:
    return scene_from_dict({"assemblies": [{"kind": "power_table", **keys}]}, "t", "t")


def placed(made: SceneFile) -> tuple[Placing, dict[str, Any]]:
    with in_keys_of_file(made.origins):
        parts, matings = make_parts(made, "t")
    return place(made.instances, made.drives, parts, matings, "t"), parts


def polygon(part: Any) -> shapely.Geometry:
    region = part.section(0.0).region

    def ring(profile: Any) -> shapely.Polygon:
        points, _ = approximate_profile(profile, 1e-3, arcs=False).geometry.expanded()
        return shapely.Polygon(np.stack([points.real, points.imag], axis=1))

    shape = ring(region.outer)
    for hole in region.holes:
        shape = shape.difference(ring(hole))
    return shape


def flats(placing: Placing, parts: dict[str, Any]) -> list[Flat]:
    """All but worm drives: lower and upper face and the outline, smaller by what outlines and glued rods touch."""
    upright = [i for i in placing.instances if i.axis[2] == 1 and parts[i.part].kind != "worm_wheel"]
    shapes = {key: polygon(parts[key]).buffer(-0.01, quad_segs=2) for key in {i.part for i in upright}}
    return [(i.id, i.at[2], i.at[2] + parts[i.part].face_width, shapes[i.part]) for i in upright]


def moved(shape: shapely.Geometry, place: complex, turn: float) -> shapely.Geometry:
    def way(points: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
        z = (points[:, 0] + 1j * points[:, 1]) * np.exp(1j * turn) + place
        return np.stack([z.real, z.imag], axis=1)

    return shapely.transform(shape, way)


def struck(
    placing: Placing, parts: dict[str, Any], runs: list[tuple[float, float]], least: int = 150
) -> set[frozenset[str]]:
    """Pairs that meet somewhere: all that stand at one height are tried; the mesh is left to its own check."""
    assert placing.train is not None
    bodies = placing.train.moving.stands.body
    found = flats(placing, parts)
    pairs = [
        (a, b)
        for a, b in combinations(range(len(found)), 2)
        if min(found[a][2], found[b][2]) - max(found[a][1], found[b][1]) > 1e-9
        and bodies(found[a][0]) != bodies(found[b][0])
        and {found[a][0], found[b][0]} != {"ring", "pinion"}
    ]
    assert len(pairs) >= least
    met = set()
    one, two = (np.array(side) for side in zip(*pairs, strict=True))
    for run in runs:
        poses = placing.train.poses([Fraction(r).limit_denominator(10**6) for r in run])
        shapes = np.array([moved(shape, *poses[key]) for key, _, _, shape in found])
        for a, b in np.array(pairs)[shapely.intersects(shapes[one], shapes[two])]:
            met.add(frozenset((found[a][0], found[b][0])))
    return met


def runs(count: int) -> Iterator[tuple[float, float]]:
    """Turns of disk 2 and of the ring over all that both can do against each other, evenly (Roberts)."""
    for k in range(count):
        yield 3 * ((0.7548776662 * k) % 1), 3 * ((0.5698402910 * k) % 1)


@pytest.mark.heavy
@pytest.mark.parametrize(("name", "meshes"), [("power_table_laser", 1), ("power_table_print", 3)])
def test_the_scene_stands_in_contact_and_turns_without_overlap(name: str, meshes: int, capsys: Any) -> None:
    assert main(["check", "--json", name]) == 0
    found = json.loads(capsys.readouterr().out)
    assert "solids" not in found
    told = found["workspace"]
    assert not told["uncovered"]
    # worms, bearings and collars lie: those too
    count = len(told["tested"]) + sum(map(len, told["rest"].values()))
    assert count == {"power_table_laser": 45 * 44 / 2, "power_table_print": 51 * 50 / 2}[name]
    assert all(c["met"] for m in found["mates"] for c in m.get("conditions", ()))
    assert [m["verdict"] for m in found["mates"] if "verdict" in m] == ["clear"] * meshes


def test_worms_turn_the_disk_and_the_ring_by_their_teeth() -> None:
    placing, _ = placed(scene(**PRINT))
    assert placing.train is not None
    disk, ring = placing.train.turned
    assert abs(disk["disk_worm"]) == 30
    assert abs(ring["ring_worm"]) == 2 * 24
    assert "ring_worm" not in disk
    assert "disk_worm" not in ring


def test_the_platform_goes_where_the_mechanism_says_and_keeps_parallel() -> None:
    made = scene()
    placing, _ = placed(made)
    assert placing.train is not None
    table = TwoDisk(arms=(18.0, 18.0), teeth=(32, 48))
    for disk, ring in runs(40):
        poses = placing.train.poses([Fraction(disk).limit_denominator(999), Fraction(ring).limit_denominator(999)])
        turns = [float(Fraction(run).limit_denominator(999)) for run in (disk, ring)]
        # the scene starts with O2 and O3 on +x; delta counts clockwise
        delta, theta = (-2 * math.pi * turn for turn in turns)
        beta = math.pi + table.ratio * (delta - theta)
        place, turn = poses["platform"]
        assert abs(place - table.forward(delta, beta) * -1j) < 1e-9
        assert abs(math.remainder(turn, 2 * math.pi)) < 1e-12
        for stage, carrier, far in (("first", "flange", 18.0), ("second", "platform", 18.0)):
            for k in (1, 2, 3):
                at, lean = poses[f"{stage}_crank_{k}"]
                pin = poses[f"{'upper' if stage == 'first' else 'platform'}_pin_{k}"][0]
                assert abs(at + far * np.exp(1j * lean) - pin) < 1e-9, (stage, carrier, k)


def test_nothing_is_in_the_way_over_the_whole_workspace() -> None:
    placing, parts = placed(scene())
    assert struck(placing, parts, list(runs(60))) == set()


@pytest.mark.heavy
@pytest.mark.parametrize("keys", [{}, {"second_arm": 22.0}, {"module": 3.0, "teeth": [40, 56]}, PRINT])
def test_nothing_is_in_the_way_anywhere(keys: dict[str, Any]) -> None:
    placing, parts = placed(scene(**keys))
    assert struck(placing, parts, list(runs(3000))) == set()


@pytest.mark.parametrize(
    ("changed", "pair"),
    [
        ({"flange_pin": {"length": 14.0}}, {"flange_pin_1", "platform"}),
        pytest.param({"first_crank": {"width": 70.0, "boss_diameter": 70.0}}, {"first_crank_1", "hub_1"},
                     marks=pytest.mark.heavy),
        pytest.param({"post": {"length": 60.0}}, {"post_1", "platform"}, marks=pytest.mark.heavy),
    ],
)  # fmt: skip
def test_a_spoiled_part_is_found(changed: dict[str, Any], pair: set[str]) -> None:
    made = scene_from_dict({"assemblies": [{"kind": "power_table"}], "parts": changed}, "t", "t")
    placing, parts = placed(made)
    brute = struck(placing, parts, list(runs(20)))
    assert frozenset(pair) in brute
    # by relative coordinates the same is found, and what polygons find in some poses
    shapes = {name: Shape(parts[name]) for name in dict.fromkeys(i.part for i in placing.instances)}
    home = {frozenset((x.first, x.second)) for x in solid_overlaps(placing, parts)}
    found = workspace_found(placing, shapes, by_contact(placing, parts), home, 400)
    all_over = home | {frozenset((x.first, x.second)) for x in found.struck}
    assert brute <= all_over
    # and where it is told
    told = struck(placing, parts, [(one.turns[0], one.turns[1]) for one in found.struck])
    assert {frozenset((x.first, x.second)) for x in found.struck} <= told


# what is brought in together, straight along the axes: from the front, or from the back
ORDER = [
    ("front", ["base"]), ("front", ["guide"]), ("front", ["post"]), ("back", ["foot"]),
    ("front", ["back", "tube", "dowel", "rim"]), ("front", ["disk_2", "shaft", "axle"]), ("front", ["ring"]),
    ("front", ["pinion", "hub", "platform_axle"]), ("front", ["first_crank"]),
    ("front", ["flange", "upper_pin", "flange_pin"]), ("front", ["second_crank"]),
    ("front", ["platform", "platform_pin"]), ("back", ["ring_hand_crank", "handle"]), ("back", ["disk_hand_crank"]),
]  # fmt: skip


def blocked(order: list[tuple[str, list[str]]]) -> list[tuple[str, str]]:
    """What is in the way of what, as each group comes along z to its place past all that stands already."""
    placing, parts = placed(scene())
    stand = {i.id: i for i in placing.instances}
    whole = {key: (low, high, moved(shape, stand[key].centre, stand[key].rotation))
             for key, low, high, shape in flats(placing, parts)}  # fmt: skip
    there: list[str] = []
    found = []
    for side, names in order:
        coming = [i.id for i in placing.instances if i.part in names and i.id not in there]
        # both hand cranks have such a handle: each comes with its own
        coming = [key for key in coming if not (key == "disk_handle" and "ring_hand_crank" in names)]
        coming += ["disk_handle"] if "disk_hand_crank" in names else []
        assert coming
        for key in coming:
            low, high, shape = whole[key]
            for other in there:
                beside = whole[other][1] > low + 1e-9 if side == "front" else whole[other][0] < high - 1e-9
                if beside and shape.intersects(whole[other][2]):
                    found.append((key, other))
        there += coming
    assert set(there) == set(stand)
    return found


def test_every_part_reaches_its_place_along_a_straight_way() -> None:
    assert blocked(ORDER) == []
    late = [group for group in ORDER if group[1] != ["second_crank"]]
    assert ("second_crank_1", "platform") in blocked([*late, ("front", ["second_crank"])])


def test_every_flat_part_is_wide_enough_for_its_kerf() -> None:
    _, parts = placed(load_scene("power_table_laser"))
    for key, part in some_of(parts.items(), 8):
        shape = polygon(part)
        assert shape.is_valid
        assert shape.geom_type == "Polygon", key
        # opened by a disc of twice the kerf nothing but sharp corners and tips of teeth goes, and nothing falls apart
        opened = shape.buffer(-KERF).buffer(KERF)
        assert opened.geom_type == "Polygon", key
        assert shape.difference(opened).area < 2e-3 * shape.area, key


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("keys", "code", "name"),
    [
        ({"teeth": [48, 32]}, "ring_as_its_wheel", "teeth"),
        ({"second_arm": 40.0}, "axle_beyond_pinion", "second_arm"),
        ({"second_arm": 6.0}, "axles_overlap", "second_arm"),
        ({"second_arm": 8.0}, "axles_meet", "second_arm"),
        ({"axle_diameter": 30.0}, "axles_overlap", "axle_diameter"),
        ({"second_arm": 0.5}, "axles_overlap", "second_arm"),
        ({"teeth": [47, 48]}, "axles_overlap", "teeth"),
        ({"clearance": 5.0}, "pins_lie_loose", "clearance"),
        ({"fit": 2.0}, "pins_lie_loose", "fit"),
        ({"plate_thickness": 1.0}, "ring_beside_pinion", "plate_thickness"),
        ({"axial_gap": 2.0}, "ring_beside_pinion", "axial_gap"),
        ({"name": "a", "normal_backlash": 3.0}, "backlash_leaves_no_teeth", "assemblies[1].normal_backlash"),
        (PRINT | {"worm_module": 1.0}, "axle_in_the_teeth", "worm_module"),
        ({"platform_size": 40.0}, "platform_too_small", "platform_size"),
        # a default was blamed, and the value that the rim has no room for was offered
        ({"pin_diameter": 18.0}, "hole_reaches_edge", "pin_diameter"),
        ({"platform_axle_diameter": 22.0}, "platform_too_small", "platform_axle_diameter"),
        ({"platform_axle_diameter": 22.0, "platform_size": 80.0}, "platform_too_small", "platform_axle_diameter"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_by_its_driver(keys: dict[str, Any], code: str, name: str) -> None:
    with pytest.raises(SceneError) as refused:
        placed(scene(**keys))
    assert refused.value.code == code
    assert name in refused.value.key
    near = refused.value.nearest
    if near is not None:
        placed(scene(**keys | {name.rpartition(".")[2]: near.value}))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("seed", range(200))
def test_random_drivers_stand_free_or_are_refused(seed: int) -> None:
    rng = np.random.default_rng(seed)
    pinion = int(rng.integers(16, 60))
    keys = {
        "module": float(rng.choice([1.0, 1.5, 2.0, 2.25, 3.0])), "teeth": [pinion, pinion + int(rng.integers(10, 30))],
        "second_arm": float(rng.uniform(8, 40)), "pin_diameter": float(rng.choice([3.0, 4.0, 6.0])),
        "plate_thickness": float(rng.choice([3.0, 4.0, 6.0])), "platform_size": 300.0,
    }  # fmt: skip
    try:
        placing, parts = placed(scene(**keys))
    except SceneError:
        return
    assert struck(placing, parts, list(runs(25))) == set()

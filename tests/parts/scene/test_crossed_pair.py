"""Helical gears on crossed axes in scenes: laid, held by their meshes, driven; what does not fit is refused by key."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import manifold3d
import numpy as np
import pytest

from exporters.production.check import scene_checks
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from tests.sampling import some_of

WHEEL = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 18, "helix_angle_deg": 30.0, "face_width": 12.0,
         "profile_shift_coefficient": 0.3}  # fmt: skip
PINION = WHEEL | {"number_of_teeth": 13, "helix_angle_deg": 40.0, "face_width": 15.0, "profile_shift_coefficient": 0.2}

THIN = {"circumferential_thinning": 0.3}
SMALL = {"module": 0.01, "face_width": 0.1}


def _scene(one: dict[str, Any], two: dict[str, Any], instances: dict[str, Any] | None = None, **mate: Any) -> Any:
    table = {
        "parts": {"one": WHEEL | one, "two": PINION | two},
        "mates": [{"kind": "crossed_helical_pair", "first": "one", "second": "two", "direction_deg": 25.0, **mate}],
        "drives": [{"instance": "one", "turns": 13.0}],
    }
    return scene_from_dict(table | ({"instances": instances} if instances else {}), "t", "t")


def _placed(scene: Any) -> tuple[Placing, dict[str, Any], Any]:
    parts, matings = make_parts(scene, "t")
    return place(scene.instances, scene.drives, parts, matings, "t"), parts, matings[0]


def _verdict(scene: Any) -> dict[str, Any]:
    placing, parts, _ = _placed(scene)
    found: dict[str, Any] = scene_checks(placing, parts, scene.drives, "en", contact=True)["mates"][0]
    return found


CASES: dict[str, tuple[dict[str, Any], dict[str, Any], dict[str, Any]]] = {
    "right": ({}, {}, {}),
    "left": ({"hand": "left"}, {"hand": "left"}, {}),
    "opposite": ({"helix_angle_deg": 55.0}, {"hand": "left", "helix_angle_deg": 20.0}, {}),
    "straight": ({"helix_angle_deg": 0.0}, {}, {}),
    "at_an_angle": ({}, {}, {"shaft_angle_deg": 71.0}),
}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", CASES)
def test_meshes_stand_half_of_the_backlash_apart_over_a_pitch(name: str) -> None:
    one, two, mate = CASES[name]
    laid = {"one": {"part": "one", "at": [1.0, 2.0, 3.0], "axis": [0.3, -0.4, 0.866]}, "two": {"part": "two"}}
    scene = _scene(one, two, laid, normal_backlash=0.2, **mate)
    placing, parts, mating = _placed(scene)
    assert mating.normal_backlash == pytest.approx(0.2, abs=1e-12)
    assert placing.turns[0]["two"] == float(Fraction(-13 * 18, 13))
    solids = {}
    for key, part in parts.items():
        mesh = part.to_trimesh(0.004)
        solids[key] = manifold3d.Manifold(
            manifold3d.Mesh(np.asarray(mesh.vertices, np.float32), np.asarray(mesh.faces, np.uint32))
        )
    gaps = []
    for turned in np.linspace(0.0, 1 / 18, 5)[:-1]:
        stand = {i.id: i.scene_from_part.matrix() for i in placing.at([turned])}
        placed = [solids[key].transform(stand[key]) for key in ("one", "two")]
        gaps.append(placed[0].min_gap(placed[1], 1.0))
    # chords and facets lie within 0.004 mm of both surfaces
    assert min(gaps) == pytest.approx(0.1, abs=0.009)
    assert max(gaps) == pytest.approx(0.1, abs=0.009)


def test_the_check_finds_contact_backlash_and_overlap() -> None:
    assert _verdict(_scene({}, {}))["verdict"] == "contact"
    found = _verdict(_scene({}, {}, normal_backlash=0.1))
    assert (found["verdict"], found["gap"]) == ("clear", pytest.approx(0.05, abs=1e-9))
    wide = found["working_centre_distance"] + 0.1
    opened = _verdict(_scene({}, {}, working_centre_distance=wide))
    # dj = 2 sin(alpha_wn) da
    slope = 2 * math.sin(math.radians(opened["working_pressure_angle_deg"]))
    assert opened["normal_backlash"] == pytest.approx(0.1 * slope, rel=0.01)


def test_two_that_stand_are_held_to_distance_angle_and_phase() -> None:
    placing, _, mating = _placed(_scene({}, {}, normal_backlash=0.1))
    one, two = placing.instances

    def again(move: float = 0.0, turn: float = 0.0, apart: float = 0.0) -> dict[str, Any]:
        """Both at places of their own, the second moved along its axis and turned as its helix then wants it."""
        away = apart * math.cos(math.radians(25.0)), apart * math.sin(math.radians(25.0)), 0.0
        at = [c + move * a + o for c, a, o in zip(two.at, two.axis, away, strict=True)]
        rotation = math.degrees(two.rotation + turn + mating.pair.twists[1] * move)
        stands = {
            "one": {"part": "one", "at": list(one.at)},
            "two": {"part": "two", "at": at, "axis": list(two.axis), "rotation_deg": rotation},
        }
        return _verdict(_scene({}, {}, stands, normal_backlash=0.1))

    for move in some_of((0.0, 3.0)):
        found = again(move)
        assert all(c["met"] for c in found["conditions"])
        assert found["gap"] == pytest.approx(0.05, abs=1e-5)
        assert found["direction_deg"] == pytest.approx(25.0, abs=1e-9)
    broken = {c["code"] for c in again(turn=0.02)["conditions"] if not c["met"]}
    assert broken == {"phase"}
    broken = {c["code"] for c in again(apart=0.01)["conditions"] if not c["met"]}
    assert "centre_distance" in broken


@pytest.mark.parametrize(
    ("one", "two", "mate", "told"),
    [
        ({}, {"helix_angle_deg": 30.0, "hand": "left"}, {}, "hand"),
        ({"helix_angle_deg": 0.0}, {"helix_angle_deg": 0.0}, {}, "helix_angle_deg"),
        ({}, {"double_helical": True}, {}, "double_helical"),
        ({}, {"module": 2.5}, {}, "module"),
        ({}, {}, {"working_centre_distance": 30.0}, "working_centre_distance"),
        ({}, {}, {"shaft_angle_deg": 20.0}, "shaft_angle_deg"),
        ({}, {}, {"shaft_angle_deg": 72.0, "working_centre_distance": 37.0}, "working_centre_distance"),
        ({}, {}, {"shaft_angle_deg": 0.0}, "shaft_angle_deg"),
        ({}, {}, {"shaft_angle_deg": 71.0, "working_centre_distance": 60.0}, "working_centre_distance"),
        (SMALL, SMALL, {"working_centre_distance": 1e6}, "working_centre_distance"),
        ({}, {}, {"working_centre_distance": 60.0, "normal_backlash": 0.1}, "working_centre_distance"),
        ({}, THIN, {"working_centre_distance": 60.0, "normal_backlash": 0.1}, "working_centre_distance"),
        ({}, THIN, {"working_centre_distance": 30.0, "normal_backlash": 0.1}, "working_centre_distance"),
    ],
)
def test_what_does_not_fit_is_refused_by_its_key_with_what_works(
    one: dict[str, Any], two: dict[str, Any], mate: dict[str, Any], told: str
) -> None:
    scene = _scene(one, two, **mate)
    with pytest.raises(SceneError) as refused:
        make_parts(scene, "t")
    assert refused.value.key.endswith(told)
    works = refused.value.nearest
    assert works is not None
    if told in mate:
        make_parts(_scene(one, two, **mate | {told: works.value}), "t")
    else:
        make_parts(_scene(one, two | {told: works.value}), "t")


def test_both_distance_and_angle_wrong_are_told_without_a_value_that_works() -> None:
    with pytest.raises(SceneError) as refused:
        make_parts(_scene({}, {}, shaft_angle_deg=10.0, working_centre_distance=30.0), "t")
    assert refused.value.key.endswith("shaft_angle_deg")
    assert refused.value.nearest is None


def test_thinned_teeth_may_stand_nearer_and_have_their_backlash() -> None:
    own = _placed(_scene({}, {}))[2].pair.working_centre_distance
    near = _scene({"circumferential_thinning": 0.2}, {}, working_centre_distance=own - 0.05, normal_backlash=0.15)
    assert _placed(near)[2].normal_backlash == pytest.approx(0.15, abs=1e-12)

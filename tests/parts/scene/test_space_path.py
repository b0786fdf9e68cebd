"""What lies in motion: trains laid as a whole, bounds of paths in space by points and gaps of meshes, refusals."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from exporters.production.check import scene_checks
from parts.base.refusal import SceneError
from parts.scene.checks import check_workspace
from parts.scene.files import built_in_scenes
from parts.scene.instances import DriveSpec
from parts.scene.relative_path import course_of
from parts.scene.shapes import Shape
from parts.scene.space_path import space_path
from tests.parts.gears.bevel.test_bevel_differential import differential, frames, meshes, rigid, stood

GEAR: dict[str, Any] = {"kind": "spur_gear", "module": 1.0, "face_width": 5.0}
AXES = [[0.0, 1.0, 0.0], [1.0, -2.0, 2.0], [0.0, 0.0, -1.0]]


def planetary(**ring: Any) -> dict[str, Any]:
    """Sun 16, satellites 16, ring 48, which is held, and what carries the satellites."""
    mates: list[dict[str, Any]] = [
        {"kind": "internal_gear_pair", "first": "ring", "second": "one", "normal_backlash": 0.05},
        {
            "kind": "external_gear_pair",
            "first": "one",
            "second": "sun",
            "direction_deg": 180.0,
            "normal_backlash": 0.05,
        },
        {"kind": "external_gear_pair", "first": "sun", "second": "two", "direction_deg": 180.0},
        {"kind": "coaxial", "first": "sun", "second": "arm", "height": 8.0},
        *({"kind": "carried", "first": "arm", "second": name} for name in ("one", "two")),
    ]  # fmt: skip
    return {
        "parts": {
            "sun": GEAR | {"number_of_teeth": 16},
            "planet": GEAR | {"number_of_teeth": 16},
            "ring": GEAR | {"kind": "ring_gear", "number_of_teeth": 48, "outer_diameter": 60.0},
            "arm": {"kind": "plate", "width": 50.0, "height": 10.0, "face_width": 3.0},
        },
        "instances": {"sun": {"part": "sun"}, "one": {"part": "planet"}, "two": {"part": "planet"},
                      "ring": {"part": "ring", "at": [0.0, 0.0, 0.0], "held": True, **ring}, "arm": {"part": "arm"}},
        "mates": mates,
        "drives": [{"instance": "sun", "turns": 1.0}],
    }  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize("axis", AXES)
def test_a_planetary_set_laid_as_a_whole_moves_as_the_upright_one(axis: list[float]) -> None:
    """Invariance: places, turns, checks; Willis: the arm turns 1 / (1 + 48 / 16)."""
    (one, parts), (two, _) = stood(planetary()), stood(planetary(at=[3.0, -4.0, 5.0], axis=axis))
    assert one.turns == two.turns
    assert one.turns[0]["arm"] == pytest.approx(0.25)
    assert all(condition.met for mate in two.mates for condition in mate.conditions)
    whole = rigid(frames(two, 0.0)["ring"])
    for at in (0.0, 0.3):
        first, second = frames(one, at), frames(two, at)
        for name, stands in first.items():
            assert np.allclose(rigid(second[name]), whole @ rigid(stands), atol=1e-9), name
    drives = [DriveSpec("sun", 1.0)]
    found = [scene_checks(p, parts, drives, "en", contact=True) for p in (one, two)]
    assert [check.get("solids") for check in found] == [None, None]
    assert found[0]["motion"]["pairs"] == found[1]["motion"]["pairs"]


def test_paths_bound_how_far_points_go_and_gaps_are_no_less_than_told() -> None:
    """A satellite as seen from a post, and from the other side gear: by points of its mesh, and gaps by manifold3d."""
    raw = differential(("ring", 1.0), ("left", 0.4))
    raw["parts"]["post"] = {"kind": "plate", "width": 4.0, "height": 4.0, "face_width": 40.0}
    raw["instances"]["post"] = {"part": "post", "at": [0.0, 30.0, 10.0]}
    raw["instances"]["left"]["at"] = [0.0, 0.0, 0.0]
    placing, parts = stood(raw)
    assert placing.train is not None
    course = course_of(placing.train, [i.id for i in placing.instances])
    shapes, solids = {key: Shape(part) for key, part in parts.items()}, meshes(parts)
    by_id = {i.id: i for i in placing.instances}
    rng = np.random.default_rng(5)
    for names in (("post", "one"), ("one", "right"), ("two", "post")):
        pair = by_id[names[0]], by_id[names[1]]
        own = shapes[pair[0].part], shapes[pair[1].part]
        path = space_path(pair, own, course, (False, False))
        assert path is not None
        assert path.share == 1.0
        points = np.asarray(solids[pair[1].part].to_mesh().vert_properties)[::97, :3]
        begin, end = sorted(rng.integers(0, len(path.times), 2).tolist())
        turned, places = path.seen(np.linspace(path.times[begin], path.times[end], 400))
        ways = np.einsum("tij,nj->tni", turned, points) + places[:, None]
        gone = np.linalg.norm(np.diff(ways, axis=0), axis=2).sum(axis=0).max()
        first = np.asarray(solids[pair[0].part].to_mesh().vert_properties)[None, ::97, :3]
        back = np.einsum("tji,tnj->tni", turned, first - places[:, None])
        seen = np.linalg.norm(np.diff(back, axis=0), axis=2).sum(axis=0).max()
        bound = path.length[end] - path.length[begin]
        # of both views the smaller one bounds, piece by piece
        assert min(gone, seen) <= bound * (1 + 1e-9)
        assert bound <= 3.0 * max(gone, seen)
        for k in rng.integers(0, len(path.times), 4):
            now, there = path.seen(path.times[k : k + 1])
            placed = solids[pair[1].part].transform(np.column_stack([now[0], there[0]]))
            # sought no farther than it matters
            gap = solids[pair[0].part].min_gap(placed, float(path.free[k]) + 1.0)
            assert path.free[k] <= gap + 1e-4
        # after a period it stands alike
        ends = path.seen(path.times[[0, -1]])
        assert np.allclose(ends[0][0], ends[0][1], atol=1e-9)
        assert np.allclose(ends[1][0], ends[1][1], atol=1e-7)


@pytest.mark.parametrize("axis", AXES)
def test_a_rack_beside_a_laid_gear_slides_along_its_own_x(axis: list[float]) -> None:
    """Invariance, and rolling without slip: 20 teeth of module 1 in a turn are 20 pi mm."""
    raw: dict[str, Any] = {
        "parts": {"gear": GEAR | {"number_of_teeth": 20}, "rack": GEAR | {"kind": "rack", "number_of_teeth": 20}},
        "instances": {"gear": {"part": "gear", "at": [0.0, 0.0, 0.0], "rotation_deg": 5.0}},
        "mates": [{"kind": "rack_pair", "first": "gear", "second": "rack", "direction_deg": 30.0}],
        "drives": [{"instance": "gear", "turns": 0.2}],
    }
    laid = {**raw, "instances": {"gear": {**raw["instances"]["gear"], "at": [3.0, -4.0, 5.0], "axis": axis}}}
    (one, parts), (two, _) = stood(raw), stood(laid)
    begin, now = frames(two, 0.0), frames(two, 0.2)
    whole = rigid(begin["gear"]) @ np.linalg.inv(rigid(frames(one, 0.0)["gear"]))
    for name, stands in frames(one, 0.2).items():
        assert np.allclose(rigid(now[name]), whole @ rigid(stands), atol=1e-9), name
    way = now["rack"][:, 3] - begin["rack"][:, 3]
    assert np.linalg.norm(way) == pytest.approx(4 * np.pi, abs=1e-9)
    assert abs(way @ begin["rack"][:, 0]) == pytest.approx(4 * np.pi, abs=1e-9)
    found = scene_checks(two, parts, [DriveSpec("gear", 0.2)], "en", contact=True)
    assert "solids" not in found


def test_a_workspace_is_refused_where_axes_go_round() -> None:
    placing, _ = stood(differential(("ring", 1.0), ("left", 1.0)))
    with pytest.raises(SceneError) as caught:
        check_workspace(50, placing, "s")
    assert "axes that lie and go round" in str(caught.value)


def test_a_group_of_pins_is_laid_about_what_carries_them() -> None:
    """Each a third of a turn on, its own axis too, by their ends: all point at the axis of the ring."""
    raw: dict[str, Any] = {
        "parts": {"ring": {"kind": "plate", "width": 20.0, "height": 20.0, "face_width": 4.0},
                  "pin": {"kind": "shaft", "steps": [{"diameter": 2.0, "length": 10.0}]}},
        "instances": {"ring": {"part": "ring", "at": [1.0, 2.0, 3.0], "rotation_deg": 20.0},
                      "pin": {"part": "pin", "count": 3}},
        "mates": [{"kind": "fixed", "first": "ring", "second": "pin", "offset": [30.0, 0.0, 2.0],
                   "axis": [-2.0, 0.0, 0.0]}],
    }  # fmt: skip
    placing, _ = stood(raw)
    pins = [one for one in placing.instances if one.part == "pin"]
    for k, pin in enumerate(pins):
        way = np.radians(20.0 + 120.0 * k)
        out = np.array([np.cos(way), np.sin(way), 0.0])
        assert np.allclose(pin.at, np.array([1.0, 2.0, 5.0]) + 30 * out, atol=1e-9)
        assert np.allclose(pin.axis, -out, atol=1e-12)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["oval_gears", "cycloidal_reducer", "idler_train", "lantern_pair", "worm_set_print"])
def test_built_in_trains_laid_as_a_whole_move_as_they_do_upright(name: str) -> None:
    """Invariance: what hangs together with the first of all, at a third of the drives' way."""
    raw = tomllib.loads(built_in_scenes()[name].read_text("utf-8"))
    raw = {key: raw[key] for key in ("parts", "instances", "mates", "drives") if key in raw}
    first = raw["mates"][0]["first"]
    stands = []
    for extra in ({}, {"axis": [1.0, -2.0, 2.0]}):
        own = raw.get("instances", {})
        stands.append(
            stood({**raw, "instances": {**own, first: {**own.get(first, {}), "at": [3.0, -4.0, 5.0], **extra}}})[0]
        )
    one, two = stands
    ways = [drive["turns"] / 3 if "turns" in drive else drive.get("travel", 1.0) / 3 for drive in raw["drives"]]
    nothing = [0.0] * len(ways)
    whole = rigid(frames(two, *nothing)[first]) @ np.linalg.inv(rigid(frames(one, *nothing)[first]))
    assert one.train is not None
    upright, laid = frames(one, *ways), frames(two, *ways)
    moved = set(one.turns[0]) | {first}
    assert len(moved) > 1
    for key in moved:
        assert np.allclose(rigid(laid[key]), whole @ rigid(upright[key]), atol=1e-9), key

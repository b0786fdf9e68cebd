"""Carried bevel satellites: ratios by Willis, rolling without slip by difference quotients, teeth by meshes, films."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import manifold3d
import numpy as np
import pytest

from exporters.production.check import scene_checks
from geometry.base.record import replace
from parts.base.refusal import SceneError
from parts.scene.instances import DriveSpec
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import Placing, place
from parts.scene.standing import Instance
from parts.solids.mesh import body_mesh, mesh_outlines

SIDE: dict[str, Any] = {"kind": "bevel_gear", "module": 2.0, "number_of_teeth": 18, "mate_number_of_teeth": 12,
                        "bore_diameter": 8.0}  # fmt: skip
SATELLITE: dict[str, Any] = {**SIDE, "number_of_teeth": 12, "mate_number_of_teeth": 18, "bore_diameter": 5.0}
RING: dict[str, Any] = {"kind": "plate", "width": 80.0, "height": 80.0, "corner_radius": 40.0, "face_width": 4.0,
                        "holes": [{"at": [0.0, 0.0], "diameter": 60.0}]}  # fmt: skip


def differential(*drives: tuple[str, float], **more: Any) -> dict[str, Any]:
    """Two side gears on one axis, two satellites whose axes a ring carries round."""
    pairs = [("left", "one", 0.0), ("left", "two", 180.0), ("one", "right", 0.0), ("two", "right", 0.0)]
    mates: list[dict[str, Any]] = [{"kind": "bevel_pair", "first": a, "second": b, "direction_deg": way,
                                    "normal_backlash": 0.2} for a, b, way in pairs]  # fmt: skip
    mates += [{"kind": "coaxial", "first": "left", "second": "ring", "height": 15.0}]
    mates += [{"kind": "carried", "first": "ring", "second": name} for name in ("one", "two")]
    return {
        "parts": {"side": SIDE, "satellite": SATELLITE, "ring": RING},
        "instances": {"left": {"part": "side", "rotation_deg": 11.0}, "right": {"part": "side"},
                      "one": {"part": "satellite"}, "two": {"part": "satellite"}, "ring": {"part": "ring"}},
        "mates": mates,
        "drives": [{"instance": key, "turns": turns} for key, turns in drives],
        **more,
    }  # fmt: skip


def laid_differential(axis: list[float], *drives: tuple[str, float], **more: Any) -> dict[str, Any]:
    """The same with the left gear on another axis: the direction of the right one counts from x as its mate is laid."""
    raw = differential(**more)
    raw["instances"]["left"] = {"part": "side", "at": [3.0, -4.0, 5.0], "axis": axis}
    one = next(i for i in stood(raw)[0].instances if i.id == "one")
    laid, way = frame(replace(one, rotation=0.0)), np.array(axis) / np.linalg.norm(axis)
    raw["mates"][2]["direction_deg"] = math.degrees(math.atan2(laid[:, 1] @ way, laid[:, 0] @ way))
    return {**raw, "drives": [{"instance": key, "turns": turns} for key, turns in drives]}


def stood(raw: dict[str, Any]) -> tuple[Placing, dict[str, Any]]:
    """Where all stands, and its parts."""
    file = scene_from_dict(raw, "s", "s")
    parts, matings = make_parts(file, "s")
    return place(file.instances, file.drives, parts, matings, "s"), parts


def frame(instance: Instance) -> np.ndarray:
    """(3, 4): turned about z, then z laid on the axis by the shortest way (Rodrigues), then moved."""
    unit = np.array(instance.axis)
    k = np.cross([0.0, 0.0, 1.0], unit)
    sine, cosine = np.linalg.norm(k), unit[2]
    k = k / sine if sine > 1e-12 else np.array([1.0, 0.0, 0.0])
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    laid = np.eye(3) + sine * cross + (1 - cosine) * cross @ cross
    c, s = math.cos(instance.rotation), math.sin(instance.rotation)
    return np.column_stack([laid @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]), instance.at])


def rigid(placed: np.ndarray) -> np.ndarray:
    """(4, 4) of (3, 4)."""
    return np.vstack([placed, [0.0, 0.0, 0.0, 1.0]])


def frames(placing: Placing, *values: float) -> dict[str, np.ndarray]:
    return {one.id: frame(one) for one in placing.at(values)}


def meshes(parts: dict[str, Any]) -> dict[str, Any]:
    """All parts as manifold3d has them."""
    found = {}
    for key, part in parts.items():
        mesh = body_mesh(part.body(0.0), mesh_outlines(part.body(0.0), 0.01, 0.0))
        corners, triangles = mesh.vertices.astype(np.float32), mesh.triangles.astype(np.uint32)
        found[key] = manifold3d.Manifold(manifold3d.Mesh(corners, triangles))
    return found


def test_turns_are_exact_fractions_by_willis() -> None:
    """(n_right - n_ring) / (n_left - n_ring) = -1; a satellite turns on the ring by z_side / z_satellite."""
    placing, _ = stood(differential(("ring", 1.0), ("left", 1.0)))
    train = placing.train
    assert train is not None
    shares = train.moving.turns.shares
    # the axis of the right one points down
    assert placing.instances[1].axis == (0.0, 0.0, -1.0)
    assert shares["right"] == {"ring": Fraction(-2), "left": Fraction(1)}
    assert shares["one"] == shares["two"] == {"ring": Fraction(3, 2), "left": Fraction(-3, 2)}
    for n_left, n_ring in ((Fraction(5, 7), Fraction(0)), (Fraction(3), Fraction(2)), (Fraction(0), Fraction(1))):
        n_right = -(shares["right"]["ring"] * n_ring + shares["right"]["left"] * n_left)
        assert n_right - n_ring == -(n_left - n_ring)


def test_a_ring_driven_alone_leaves_the_side_gears_free_and_holds_with_one_of_them_held() -> None:
    with pytest.raises(SceneError) as caught:
        stood(differential(("ring", 1.0)))
    assert "leaves" in str(caught.value)
    raw = differential(("ring", 1.0))
    raw["instances"]["left"]["held"] = True
    placing, _ = stood(raw)
    assert placing.turns[0]["right"] == -2.0


def test_gears_roll_without_slip_along_their_pitch_lines() -> None:
    """By difference quotients of places alone: points of both bodies on the common ray go alike; apex and axes stay."""
    placing, parts = stood(differential(("ring", 1.0), ("left", 1.0)))
    at, step, ways = (0.21, -0.37), 1e-6, (0.3, 1.1)
    now = frames(placing, *at)
    before, after = (frames(placing, *(v + s * w for v, w in zip(at, ways, strict=True))) for s in (-step, step))

    def speed(name: str, point: np.ndarray) -> np.ndarray:
        own = now[name][:, :3].T @ (point - now[name][:, 3])
        return np.asarray(after[name] @ [*own, 1.0] - before[name] @ [*own, 1.0]) / (2 * step)

    def apex(name: str, part: str) -> np.ndarray:
        return np.asarray(now[name] @ [0.0, 0.0, parts[part].thing.mounting_distance, 1.0])

    centre = apex("left", "side")
    for name, part in (("right", "side"), ("one", "satellite"), ("two", "satellite")):
        assert np.allclose(apex(name, part), centre, atol=1e-9)
    for side in ("left", "right"):
        for satellite in ("one", "two"):
            # the ray at the pitch angle of the side gear towards the satellite, both axes pointing at the apex
            down, aside = -now[side][:, 2], -now[satellite][:, 2]
            delta = math.atan2(18, 12)
            ray = math.cos(delta) * down + math.sin(delta) * aside
            for far in (5.0, 15.0, 21.0):
                point = centre + far * ray
                assert np.allclose(speed(side, point), speed(satellite, point), atol=1e-6)
                assert np.linalg.norm(speed(side, point)) > 1.0
    # the ring carries the axes round by its own turns
    assert np.allclose(speed("one", now["one"][:, 3]), speed("ring", now["one"][:, 3]), atol=1e-6)


def test_teeth_stay_in_spaces_wherever_the_drives_stand() -> None:
    """Meshes by manifold3d in places by Rodrigues: half the backlash at the inner end is kept; a wrong turn clashes."""
    placing, parts = stood(differential(("ring", 1.0), ("left", 1.0)))
    solids = meshes(parts)
    names = {"left": "side", "right": "side", "one": "satellite", "two": "satellite"}
    gear = parts["side"].thing
    least = 0.1 * gear.inner_distance / gear.cone_distance
    for values in ((0.0, 0.0), (0.13, -0.29), (-1.7, 0.6)):
        found = {name: solids[part].transform(frames(placing, *values)[name]) for name, part in names.items()}
        for side in ("left", "right"):
            for satellite in ("one", "two"):
                assert (found[side] ^ found[satellite]).volume() < 1e-6
                assert found[side].min_gap(found[satellite], 1.0) == pytest.approx(least, abs=0.02)
    wrong = found["one"].translate((0.0, 0.0, -1.0))
    assert (found["left"] ^ wrong).volume() > 0.1


@pytest.mark.sampled(1)
@pytest.mark.parametrize("beside", [19.0, 21.5, 23.0])
def test_what_a_satellite_strikes_as_it_comes_round_is_found(beside: float) -> None:
    """A post beside the ring's axis: struck or not as meshes in 120 places by Rodrigues have it."""
    raw = differential(("ring", 1.0), ("left", 1.0))
    # one satellite is enough
    del raw["instances"]["two"]
    raw["mates"] = [mate for mate in raw["mates"] if "two" not in (mate["first"], mate["second"])]
    raw["parts"]["post"] = {"kind": "plate", "width": 4.0, "height": 4.0, "face_width": 40.0}
    raw["instances"]["post"] = {"part": "post", "at": [0.0, beside + 2.0, 10.0]}
    raw["instances"]["left"]["at"] = [0.0, 0.0, 0.0]
    placing, parts = stood(raw)
    drives = [DriveSpec("ring", 1.0), DriveSpec("left", 1.0)]
    told = scene_checks(placing, parts, drives, "en", contact=True)
    solids = meshes(parts)
    post = solids["post"].transform(frame(next(i for i in placing.instances if i.id == "post")))
    common = max(
        (solids["satellite"].transform(frames(placing, t, t)["one"]) ^ post).volume() for t in np.linspace(0, 1, 120)
    )
    struck = {frozenset((x["first"], x["second"])) for x in told.get("solids", [])}
    assert (frozenset(("one", "post")) in struck) is (common > 1e-3)
    assert (common > 1e-3) is (beside < 22.0)
    for found in told["motion"]["uncovered"]:
        assert found["depth"] < 0.2


@pytest.mark.sampled(1)
@pytest.mark.parametrize("axis", [[0.0, 1.0, 0.0], [1.0, -2.0, 2.0], [0.0, 0.0, -1.0]])
def test_a_differential_laid_as_a_whole_moves_as_the_upright_one(axis: list[float]) -> None:
    """Invariance: all goes as in the upright scene, under one rigid motion, the drives alike."""
    drives = (("ring", 1.0), ("left", 1.0))
    upright, laid = differential(*drives), laid_differential(axis, *drives)
    upright["instances"]["left"] = {"part": "side", "at": [0.0, 0.0, 0.0]}
    one, two = stood(upright)[0], stood(laid)[0]
    assert one.train is not None
    assert two.train is not None
    assert one.train.turned == two.train.turned
    whole = rigid(frames(two, 0.0, 0.0)["left"])
    begin, stands, first, second = (frames(p, *at) for at in ((0.0, 0.0), (0.21, -0.4)) for p in (one, two))
    for name in begin:
        # which tooth stands where at first is of no matter
        gone, moved = (rigid(now[name]) @ np.linalg.inv(rigid(before[name]))
                       for now, before in ((first, begin), (second, stands)))  # fmt: skip
        assert np.allclose(moved, whole @ gone @ np.linalg.inv(whole), atol=1e-9), name
        assert np.allclose(rigid(stands[name])[:3, 3], (whole @ rigid(begin[name]))[:3, 3], atol=1e-9), name


def test_back_to_back_gears_on_one_shaft_turn_against_their_own_axes() -> None:
    """A wheel turned over on the shaft of another one: as told about its own axis it turns the other way."""
    raw: dict[str, Any] = {
        "parts": {"side": SIDE, "satellite": SATELLITE,
                  "gear": {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 20, "face_width": 5.0}},
        "mates": [
            {"kind": "bevel_pair", "first": "side", "second": "satellite"},
            {"kind": "fixed", "first": "satellite", "second": "gear", "offset": [0.0, 0.0, -9.0],
             "axis": [0.0, 0.0, -3.0]},
        ],
        "drives": [{"instance": "gear", "turns": 1.0}],
    }  # fmt: skip
    placing, _ = stood(raw)
    assert placing.turns[0] == {"gear": 1.0, "satellite": -1.0, "side": pytest.approx(2 / 3)}
    before, after = frames(placing, 0.0), frames(placing, 0.01)
    # both are one body
    seen = [np.linalg.inv(rigid(f["satellite"])) @ rigid(f["gear"]) for f in (before, after)]
    assert np.allclose(*seen, atol=1e-12)
    turned = after["gear"][:, :3] @ before["gear"][:, :3].T
    axis = before["gear"][:, 2]
    vector = np.array([turned[2, 1] - turned[1, 2], turned[0, 2] - turned[2, 0], turned[1, 0] - turned[0, 1]]) / 2
    assert np.allclose(vector, math.sin(0.02 * math.pi) * axis, atol=1e-12)

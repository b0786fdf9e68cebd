"""Normal backlash of helical mates: at right angles to the flanks, for every kind of pair and way of asking."""

from __future__ import annotations

import math
from typing import Any

import manifold3d
import numpy as np
import pytest
import shapely

from geometry.gears.mesh.search import PairContact
from geometry.gears.teeth.transverse import normal_share
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from tests import brute
from tests.geometry.gears.mesh.test_transmission_error import Brute

BETA = 25.0
SUN = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 19, "helix_angle_deg": BETA}
PARTS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "external_gear_pair": (SUN, {**SUN, "number_of_teeth": 33, "hand": "left"}),
    "internal_gear_pair": ({**SUN, "kind": "ring_gear", "number_of_teeth": 70}, SUN),
    "rack_pair": (SUN, {**SUN, "kind": "rack", "number_of_teeth": 9, "hand": "left"}),
}
KINDS = pytest.mark.parametrize("kind", PARTS)


def mated(kind: str, more: tuple[dict[str, Any], ...] = ({}, {}), **keys: Any) -> Any:
    """The pair of two parts, they and the mate with more keys."""
    first, second = (part | own for part, own in zip(PARTS[kind], more, strict=True))
    mate = {"kind": kind, "first": "a", "second": "b", **keys}
    return make_parts(scene_from_dict({"parts": {"a": first, "b": second}, "mates": [mate]}, "t", "t"), "t")[1][0]


def shares() -> tuple[float, float]:
    """cos(alpha_t) and cos(beta_b) by hand: sin(beta_b) = sin(beta) cos(alpha_n)."""
    alpha = math.atan(math.tan(math.radians(20)) / math.cos(math.radians(BETA)))
    return math.cos(alpha), math.cos(math.asin(math.sin(math.radians(BETA)) * math.cos(math.radians(20))))


@KINDS
def test_what_is_asked_is_normal_to_the_flanks(kind: str) -> None:
    mating = mated(kind, normal_backlash=0.1)
    cosine, share = shares()
    assert mating.normal_backlash == pytest.approx(0.1, rel=1e-9)
    assert mating.quantities()["normal_backlash"] == pytest.approx(0.1, rel=1e-9)
    # the thinning of both on the reference circles is the circumferential backlash
    names = ("gear", "rack") if kind == "rack_pair" else ("first", "second")
    bodies = [getattr(mating.pair, name) for name in names]
    thinning = sum(b.circumferential_thinning for b in bodies)
    assert thinning * cosine * share == pytest.approx(0.1, rel=1e-9)
    assert mating.contact(0.0, 0.0, None).worst.gap == pytest.approx(0.05, abs=6e-4)


def told_and_meshed(kind: str, backlash: float, more: tuple[dict[str, Any], ...]) -> tuple[PairContact, float]:
    """What is told of a pair as it stands at first, and the least gap of its meshes there, mm."""
    first, second = (part | {"face_width": 4.0} | own for part, own in zip(PARTS[kind], more, strict=True))
    mate = {"kind": kind, "first": "a", "second": "b", "normal_backlash": backlash}
    scene = scene_from_dict({"parts": {"a": first, "b": second}, "mates": [mate]}, "t", "t")
    parts, matings = make_parts(scene, "t")
    solids = []
    for instance in place(scene.instances, scene.drives, parts, matings, "t").instances:
        mesh = parts[instance.part].to_trimesh(0.002)
        vertices = instance.scene_from_part.apply(mesh.vertices).astype(np.float32)
        solids.append(manifold3d.Manifold(manifold3d.Mesh(vertices, mesh.faces.astype(np.uint32))))
    return matings[0].contact(0.0, 0.0, None), solids[0].min_gap(solids[1], 1.0)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("beta", [0.0, 35.0])
@pytest.mark.parametrize("kind", ["external_gear_pair", "internal_gear_pair"])
def test_the_gap_that_is_told_is_that_of_meshes(kind: str, beta: float) -> None:
    """Of helical teeth it was that of the transverse section: a sixth more at 35 degrees."""
    told, meshed = told_and_meshed(kind, 0.1, ({"helix_angle_deg": beta},) * 2)
    # chords and facets lie within 0.002 mm of both surfaces
    assert meshed == pytest.approx(told.worst.gap, abs=0.0041)
    assert told.gaps == pytest.approx([0.05] * len(told.gaps), abs=1e-9)
    assert told.greatest_gap == pytest.approx(max(told.side_gaps[0]), abs=1e-9)


LOW = {
    "helix_angle_deg": 40.0,
    "basic_rack": {"addendum_coefficient": 1.0, "tip_clearance_coefficient": 0.05, "tip_radius_coefficient": 0.05},
}
STEEP = {"helix_angle_deg": 35.0, "pressure_angle_deg": 17.5}


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("kind", "backlash", "more"),
    [
        # a tip's corner beside the fillet: 0.0477 mm was told, that of the section
        ("internal_gear_pair", 0.08,
         (STEEP | {"number_of_teeth": 40, "profile_shift_coefficient": -0.2},
          STEEP | {"number_of_teeth": 26, "profile_shift_coefficient": -0.3})),
        # in the section tips and roots are nearest, 0.1 mm, in space flanks
        ("external_gear_pair", 0.18, (LOW,) * 2),
        ("rack_pair", 0.18, (LOW,) * 2),
    ],
)  # fmt: skip
def test_the_gap_of_helical_teeth_is_that_in_space_whatever_is_nearest_in_the_section(
    kind: str, backlash: float, more: tuple[dict[str, Any], ...]
) -> None:
    told, meshed = told_and_meshed(kind, backlash, more)
    assert told.worst.gap == pytest.approx(backlash / 2, abs=2e-3)
    assert meshed == pytest.approx(told.worst.gap, abs=0.0041)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("beta", "own"), [(BETA, (0.2, 0.0)), (0.0, (0.15, 0.05))])
@KINDS
def test_thinned_teeth_may_stand_nearer_and_have_the_backlash_that_is_asked(
    kind: str, beta: float, own: tuple[float, float]
) -> None:
    """Polylines of both exact sections, turned until their flanks meet: half of the backlash either way."""
    keys = {"helix_angle_deg": beta}
    bare = mated(kind, (keys, keys)).distance
    nearer = bare + (0.1 if kind == "internal_gear_pair" else -0.1)
    thinned = tuple(keys | {"circumferential_thinning": thinning} for thinning in own)
    there = mated(kind, thinned, working_centre_distance=nearer).normal_backlash
    asked = there + (0.03 if 0.0 in own else 0.0)
    mating = mated(kind, thinned, working_centre_distance=nearer, normal_backlash=asked)
    assert mating.normal_backlash == pytest.approx(asked, abs=1e-9)
    ways = Brute(mating.pair, 1), Brute(mating.pair, -1)
    share = shares()[1] if beta else 1.0
    assert [b.touch(0.1) for b in ways] == pytest.approx([asked / share / 2] * 2, abs=2e-4)
    with pytest.raises(SceneError) as refused:
        mated(kind, thinned, working_centre_distance=nearer, normal_backlash=there - 0.01)
    assert refused.value.key.endswith("normal_backlash")


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("kind", "own", "distance"),
    [
        ("external_gear_pair", ({"profile_shift_coefficient": -0.9}, {"profile_shift_coefficient": -0.9}), 49.9),
        (
            "internal_gear_pair",
            ({"number_of_teeth": 33, "profile_shift_coefficient": 0.143},
             {"number_of_teeth": 23, "profile_shift_coefficient": 0.4749, "circumferential_thinning": 0.4917}),
            9.5,
        ),
    ],
)  # fmt: skip
def test_shifts_without_a_distance_of_their_own_mesh_where_there_is_room(
    kind: str, own: tuple[dict[str, Any], dict[str, Any]], distance: float
) -> None:
    straight = tuple(keys | {"helix_angle_deg": 0.0} for keys in own)
    with pytest.raises(SceneError, match="no working pressure angle"):
        mated(kind, straight)
    mating = mated(kind, straight, working_centre_distance=distance)
    touched = [Brute(mating.pair, way).touch(0.1) for way in (1, -1)]
    assert touched == pytest.approx([mating.normal_backlash / 2] * 2, abs=2e-4)
    with pytest.raises(SceneError) as refused:
        mated(kind, straight, working_centre_distance=distance - 2.0)
    assert refused.value.nearest is not None


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("kind", "own", "step"),
    [("rack_pair", (0.5, 0.3), -0.2), ("rack_pair", (1.0, 0.2), 0.1), ("internal_gear_pair", (0.8, 0.4), 0.3)],
)
def test_tips_beside_fillets_and_roots_may_be_nearer_than_half_of_the_backlash(
    kind: str, own: tuple[float, float], step: float
) -> None:
    """Of teeth that have much of it, or stand deep: as whole polygons are at 50 phases."""
    straight = tuple({"helix_angle_deg": 0.0, "circumferential_thinning": thinning} for thinning in own)
    first, second = (part | more for part, more in zip(PARTS[kind], straight, strict=True))
    mate = {"kind": kind, "first": "a", "second": "b"}
    mate["working_centre_distance"] = mated(kind, straight).distance + step
    parts, (mating,) = make_parts(scene_from_dict({"parts": {"a": first, "b": second}, "mates": [mate]}, "t", "t"), "t")
    worst = mating.contact(0.0, 0.0, None).worst
    regions = [parts[name].section(0.0).region for name in "ab"]
    # the toothed boundary alone: of a ring the hole
    toothed = [max((r.outer, *r.holes), key=lambda p: p.count) for r in regions]
    lines = [np.concatenate([brute.dense(s.curve, 40)[:-1] for s in profile.segments()]) for profile in toothed]

    def gap(turn: float) -> float:
        centre, rotation = mating.second_pose(0j, turn, 0.0)
        placed = lines[0] * np.exp(1j * turn), centre + lines[1] * np.exp(1j * rotation)
        one, other = (shapely.LinearRing(np.column_stack([p.real, p.imag])) for p in placed)
        return float(one.distance(other))

    assert worst.gap < mating.normal_backlash / 2 - 1e-3
    pitch = math.tau / first["number_of_teeth"]
    assert min(gap(pitch * k / 50) for k in range(50)) == pytest.approx(worst.gap, abs=2e-4)


@KINDS
def test_a_refused_backlash_names_a_normal_one_that_works(kind: str) -> None:
    with pytest.raises(SceneError) as refused:
        mated(kind, normal_backlash=9.0)
    most = float(refused.value.remedy.split("at most ")[1].split(" mm")[0])
    assert mated(kind, normal_backlash=most).normal_backlash == pytest.approx(most)
    with pytest.raises(SceneError):
        mated(kind, normal_backlash=most * 1.001)


def test_a_distance_that_gives_more_names_the_normal_one() -> None:
    far = mated("external_gear_pair", working_centre_distance=58.0)
    assert far.normal_backlash == pytest.approx(far.pair.normal_backlash * shares()[1], rel=1e-12)
    with pytest.raises(SceneError) as refused:
        mated("external_gear_pair", working_centre_distance=58.0, normal_backlash=0.01)
    least = float(refused.value.remedy.split("at least ")[1].split(" mm")[0])
    assert least == pytest.approx(far.normal_backlash, abs=1e-6)
    mated("external_gear_pair", working_centre_distance=58.0, normal_backlash=least)


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("kind", "share"), [("external_gear_pair", 1.1), ("internal_gear_pair", 0.9), ("rack_pair", 1.3)]
)
@pytest.mark.parametrize("own", [0.0, 0.3])
def test_a_distance_too_far_or_too_near_names_one_that_gives_no_more_than_is_asked(
    kind: str, share: float, own: float
) -> None:
    """At that of the shifts 0.3 mm of thinning are more than 0.1 mm of backlash already."""
    thinned, bare = ({}, {"circumferential_thinning": own}), mated(kind).distance
    for given, fault in ((share * bare, "normal_backlash"), ((2 - share) * bare, "teeth would overlap")):
        with pytest.raises(SceneError) as refused:
            mated(kind, thinned, working_centre_distance=given, normal_backlash=0.1)
        assert refused.value.key.endswith("working_centre_distance")
        assert refused.value.nearest is not None
        offered = refused.value.nearest.value
        assert isinstance(offered, float)
        found = mated(kind, thinned, working_centre_distance=offered, normal_backlash=0.1)
        assert found.normal_backlash == pytest.approx(0.1)
        with pytest.raises(SceneError, match=fault):
            mated(kind, thinned, working_centre_distance=offered + math.copysign(1e-3, given - bare),
                  normal_backlash=0.1)  # fmt: skip


def test_a_distance_beyond_which_teeth_still_run_with_interruptions_is_told_as_no_limit() -> None:
    """Tooth follows tooth up to 87.578 mm, the backlash allows 87.62 mm: less than a thousandth farther."""
    straight = {"helix_angle_deg": 0.0, "hand": "right"}
    own = (
        {**straight, "number_of_teeth": 25, "tip_diameter": 52.763},
        {**straight, "number_of_teeth": 62, "profile_shift_coefficient": -0.24, "circumferential_thinning": 0.0374},
    )
    with pytest.raises(SceneError, match="do not reach") as refused:
        mated("external_gear_pair", own, working_centre_distance=94.0, normal_backlash=0.8)
    assert refused.value.nearest is not None
    offered, side = refused.value.nearest.value, refused.value.nearest.side
    assert isinstance(offered, float)
    ratios = [
        mated("external_gear_pair", own, working_centre_distance=at, normal_backlash=0.8).pair.contact_ratio
        for at in (offered, offered + 0.02)
    ]
    assert ratios[0] > 1 > ratios[1] > 0
    assert side == "exactly"


def test_spur_pairs_keep_theirs() -> None:
    first, second = ({**p, "helix_angle_deg": 0.0, "hand": "right"} for p in PARTS["external_gear_pair"])
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b", "normal_backlash": 0.1}
    raw = {"parts": {"a": first, "b": second}, "mates": [mate]}
    mating = make_parts(scene_from_dict(raw, "t", "t"), "t")[1][0]
    assert mating.normal_backlash == mating.pair.normal_backlash == pytest.approx(0.1, rel=1e-9)


def test_a_screw_surface_that_turns_moves_by_the_share_along_its_normal() -> None:
    """Nearest distance in space from an involute screw surface to its copy turned by delta: r_b delta cos(beta_b)."""
    alpha = math.atan(math.tan(math.radians(20)) / math.cos(math.radians(BETA)))
    base, delta = 30.0 * math.cos(alpha), 1e-3
    screw = math.tan(math.radians(BETA)) / 30.0

    def point(roll: float, z: float, turn: float = 0.0) -> np.ndarray:
        at = base * (1 - 1j * roll) * np.exp(1j * (roll + screw * z + turn))
        return np.array([at.real, at.imag, z])

    target, (roll, z) = point(0.5, 0.0, delta), (0.5, 0.0)
    for _ in range(30):
        at = point(roll, z)
        slopes = np.column_stack([(point(roll + h, z + k) - at) / 1e-7 for h, k in ((1e-7, 0.0), (0.0, 1e-7))])
        step, *_ = np.linalg.lstsq(slopes, target - at, rcond=None)
        roll, z = roll + step[0], z + step[1]
    moved = float(np.linalg.norm(target - point(roll, z)))
    assert moved == pytest.approx(base * delta * normal_share(alpha, math.radians(BETA)), rel=1e-3)
    assert moved < 0.999 * base * delta

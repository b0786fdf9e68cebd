"""A sliding plate and its follower: every kind on the exact outlines over the whole travel, placed, and spoiled."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely

from exporters.production.check import scene_checks
from exporters.production.check_lines import check_lines, has_bad_verdict
from geometry.curves.curve import Complex
from geometry.plane.distance import Verdict
from geometry.plane.profile import Profile
from parts.mates.registry import MATES
from parts.scene.load import SceneError, make_parts, scene_from_toml
from parts.scene.placing import Placing, place

PHASES = """phases = [
    { move = "rise", travel = 70.0, law = "modified_sine" },
    { move = "dwell", travel = 15.0 },
    { move = "return_", travel = 45.0, law = "polynomial_345", share = 0.5 },
]
"""
STEMS = {
    "pointed": ("lift = 15.0", 'kind = "follower"\nend = "pointed"\ntip_angle_deg = 30.0\nstem_width = 6.0'),
    "roller": ("lift = 20.0\nfollower_radius = 6.0", 'kind = "roller"\ndiameter = 12.0'),
    "mushroom": (
        "lift = 12.0\nfollower_radius = 20.0",
        'kind = "follower"\nend = "mushroom"\nfollower_radius = 20.0\nplate_diameter = 26.0',
    ),
}
ARMS = {
    "pointed": ("", 'end = "pointed"\ntip_angle_deg = 30.0\ntip_height = 22.0'),
    "roller": ("follower_radius = 6.0", ""),
    "mushroom": ("follower_radius = 18.0", 'end = "mushroom"\nfollower_radius = 18.0\ntip_height = 15.0\nwidth = 6.0'),
}


def scene_text(kind: str, side: str | None, travel: float = 0.0, more: str = "", turned: float = 0.0) -> str:
    if side is None:
        cam, follower = STEMS[kind]
    else:
        size, shape = ARMS[kind]
        arm = f'oscillating = {{ arm_length = 80.0, pivot_height = 62.0, side = "{side}" }}'
        cam = f"swing_deg = 10.0\n{size}\n{arm}"
        sense = "against" if side == "trailing" else "with"
        follower = f'kind = "follower_arm"\nsense = "{sense}"\narm_length = 80.0\n{shape}'
        if not shape:
            follower = 'kind = "roller"\ndiameter = 12.0'
    return f"""
[parts.plate]
kind = "wedge_cam"
follower = "{kind}"
{cam}
{PHASES}
base_height = 25.0
run_in = 30.0
run_out = 30.0
[parts.follower]
{follower}
[instances.plate]
rotation_deg = {turned}
at = [3.0, -4.0, 0.0]
[instances.follower]
{more}
[[mates]]
kind = "wedge_follower"
first = "plate"
second = "follower"
travel = {travel}
"""


def made(text: str) -> tuple[Placing, dict[str, Any], Any]:
    scene = scene_from_toml(text.encode(), "t", "t")
    parts, matings = make_parts(scene, "t")
    return place(scene.instances, scene.drives, parts, matings, "t"), parts, matings[0]


CASES = [(k, None) for k in STEMS] + [(k, s) for k in ARMS for s in ("trailing", "leading")]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("kind", "side"), CASES)
def test_contact_over_the_travel_and_what_spoils_it(kind: str, side: str | None) -> None:
    _, _, mating = made(scene_text(kind, side))
    found = mating.contact(0.0, 0.0, None)
    assert found.verdict is Verdict.CONTACT
    assert max(map(abs, found.gaps)) < 1e-11
    assert found.drive_angles[-1] == pytest.approx(130)
    assert mating.contact(-1e-6, 0.0, None).verdict is Verdict.OVERLAP
    lifted = mating.contact(1e-6, 0.0, None)
    assert lifted.verdict is Verdict.CLEAR
    # across the profile a lift is the cosine of the pressure angle
    steep = math.cos(math.radians(40))
    assert all(steep * 1e-6 < g < 1.001e-6 for g in lifted.gaps)


def samples(profile: Profile) -> Complex:
    return np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 1000)[:-1]) for s in profile.segments()])


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("kind", "side"), CASES)
@pytest.mark.parametrize("travel", [0.0, 28.0, 110.0, 130.0])
def test_polygons_of_the_placed_parts_touch(kind: str, side: str | None, travel: float) -> None:
    """The outlines as placed, by GEOS: they touch and do not overlap, however the plate is turned."""
    placing, parts, _ = made(scene_text(kind, side, travel, turned=35.0))
    shapes = []
    for instance in placing.instances:
        points = samples(parts[instance.part].section(0.0).region.outer)
        points = points * np.exp(1j * instance.rotation) + instance.centre
        shapes.append(shapely.Polygon(np.stack([points.real, points.imag], axis=1)))
    assert shapes[0].distance(shapes[1]) < 2e-4
    assert shapes[0].intersection(shapes[1]).area < 1e-4


def test_a_body_that_runs_into_the_plate_is_found() -> None:
    """A blunt wedge at the follower's tip meets the slope beside its point."""
    blunt = scene_text("pointed", None).replace("tip_angle_deg = 30.0", "tip_angle_deg = 170.0")
    _, _, mating = made(blunt)
    found = mating.contact(0.0, 0.0, None)
    assert found.verdict is Verdict.OVERLAP
    assert found.worst.gap < -0.1
    # on the slope of 20.65 degrees, S' = 1.76 15 / 70
    assert 0 < found.worst.drive_angle < 70 or 85 < found.worst.drive_angle < 130


def checks_of(text: str) -> dict[str, Any]:
    placing, parts, _ = made(text)
    return scene_checks(placing, parts, (), "uk", contact=True)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("kind", "side"), CASES)
def test_followers_placed_by_hand_are_held_against_their_travel(kind: str, side: str | None) -> None:
    placing, _, _ = made(scene_text(kind, side, 28.0, turned=35.0))
    stands = placing.instances[1]

    def by_hand(along: float, across: float) -> dict[str, Any]:
        at = complex(stands.centre + complex(across, along) * np.exp(1j * math.radians(35)))
        place_at = f"at = [{at.real!r}, {at.imag!r}, 0.0]\nrotation_deg = {float(math.degrees(stands.rotation))!r}"
        return checks_of(scene_text(kind, side, 28.0, place_at, turned=35.0))

    good = by_hand(0.0, 0.0)
    assert not has_bad_verdict(good)
    assert good["mates"][0]["verdict"] == "contact"
    assert "drive_travel" in good["mates"][0]
    assert "після зсуву на 28 мм" in check_lines(good, "uk")[0]
    for off in ((0.01, 0.0), (-0.01, 0.0), (0.0, 0.01)):
        assert has_bad_verdict(by_hand(*off)), off


@pytest.mark.sampled(1)
@pytest.mark.parametrize("side", ["trailing", "leading"])
def test_an_arm_that_is_turned_by_hand_rises_by_its_own_turn(side: str) -> None:
    """Its pivot stays: a thousandth of a radian lifts or lowers an end of 80 mm by 0.08 mm, seen along its way."""
    pivot = made(scene_text("mushroom", side, 28.0))[0].instances[1]
    for turn in (1e-3, -1e-3):
        at = f"at = [{pivot.at[0]!r}, {pivot.at[1]!r}, 0.0]\nrotation_deg = {math.degrees(pivot.rotation + turn)!r}"
        conditions = {c.code: c for c in made(scene_text("mushroom", side, 28.0, at))[0].mates[0].conditions}
        # a pivot at -x has the end on its right: it rises as the arm turns counter-clockwise
        rises = turn > 0 if side == "leading" else turn < 0
        assert conditions["centre_distance"].met
        assert conditions["rack_phase"].value == pytest.approx(0.08 if rises else -0.08, rel=1e-9)


def test_a_stem_that_leans_is_off_its_place() -> None:
    stem = made(scene_text("pointed", None, 28.0))[0].instances[1]
    for lean, met in ((0.0, True), (0.01, False)):
        at = f"at = [{stem.at[0]!r}, {stem.at[1]!r}, 0.0]\nrotation_deg = {math.degrees(stem.rotation) + lean!r}"
        conditions = made(scene_text("pointed", None, 28.0, at))[0].mates[0].conditions
        assert all(c.met for c in conditions) is met


@pytest.mark.parametrize(("height", "width"), [(4.0, 6.0), (-4.0, 6.0), (10.0, 0.0), (-11.0, -1.0)])
def test_a_follower_at_another_height_must_share_the_face(height: float, width: float) -> None:
    """Both are 10 mm high; one that a mate lifts beside the plate touches nothing."""
    found = checks_of(scene_text("roller", None, 20.0) + f"height = {height}\n")["mates"][0]
    (condition,) = found["conditions"]
    assert (condition["code"], condition["value"]) == ("common_face_width", width)
    assert condition["met"] is ("verdict" in found) is (width > 0)


def test_a_motion_that_falls_first_is_told_whole() -> None:
    text = scene_text("pointed", "trailing").replace("swing_deg = 10.0", "swing_deg = 4.0")
    text = text.replace('"rise"', '"up"').replace('"return_"', '"rise"').replace('"up"', '"return_"')
    found = made(text)[2].quantities()
    assert (found["travel"], found["unit"]) == (pytest.approx(4.0), "deg")


def test_solids_of_plate_and_stem_above_it_do_not_meet() -> None:
    stem = 'kind = "follower"\nend = "roller"\nstem_width = 14.0\nstem_length = 60.0\npin_diameter = 4.0'
    text = scene_text("roller", None, 20.0).replace('kind = "roller"\ndiameter = 12.0', stem)
    found = checks_of(text + "height = 10.0\n")
    assert "verdict" not in found["mates"][0]
    assert "solids" not in found
    assert "solids" in checks_of(text)


WRONG = {
    "travel": (scene_text("roller", None, 131.0), "at most 130 mm works"),
    "diameter": (scene_text("roller", None).replace("diameter = 12.0", "diameter = 11.0"), "12 mm works"),
    "end": (scene_text("pointed", None).replace('follower = "pointed"', 'follower = "roller"\nfollower_radius = 3.0')
            .replace("tip_angle_deg = 30.0", ""), '"roller" works'),
    "arm": (scene_text("pointed", None).replace('kind = "follower"', 'kind = "follower_arm"\narm_length = 60.0')
            .replace("stem_width = 6.0", ""), "the cam is made for a follower"),
    "sense": (scene_text("mushroom", "leading").replace('"with"', '"against"'), '"with" works'),
    "length": (scene_text("pointed", "trailing").replace("arm_length = 80.0\nend", "arm_length = 79.0\nend"),
               "80 mm works"),
    "plate": (scene_text("mushroom", None).replace("plate_diameter = 26.0", "plate_diameter = 9.0")
              .replace("mushroom\"\nfollower_radius", "mushroom\"\nstem_width = 6.0\nfollower_radius"), "plate's edge"),
    "cam_follower": (scene_text("roller", None).replace('"wedge_follower"', '"cam_follower"')
                     .replace("travel = 0.0", ""),
                     'kind = "wedge_follower" joins these two'),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_wrong_mates_are_refused_with_what_works(case: str) -> None:
    text, told = WRONG[case]
    with pytest.raises(SceneError) as caught:
        made(text)
    assert told in str(caught.value)


def test_a_told_plate_diameter_works() -> None:
    text = WRONG["plate"][0]
    with pytest.raises(SceneError) as caught:
        made(text)
    told = str(caught.value).split("at least ")[1].split(" mm")[0]
    # the contact runs out by r sin(atan S'); a modified sine is steepest by 4 pi / (pi + 4)
    slope = 4 * math.pi / (math.pi + 4) * 12 / 70
    assert float(told) == pytest.approx(2 * 20.0 * math.sin(math.atan(slope)), rel=1e-5)
    _, _, mating = made(text.replace("plate_diameter = 9.0", f"plate_diameter = {told}"))
    assert mating.contact(0.0, 0.0, None).verdict is Verdict.CONTACT


def test_the_mate_is_listed() -> None:
    assert "wedge_follower" in MATES


@pytest.mark.sampled(8)
@pytest.mark.parametrize(("kind", "side"), [("roller", None), ("roller", "trailing"), ("pointed", "leading")])
@pytest.mark.parametrize("slid", [-165.0, -125.0, -115.0, -20.0, 60.0, 75.0])
def test_a_plate_that_its_drive_takes_from_under_its_follower_is_told(kind: str, side: str | None, slid: float) -> None:
    """Of a plate from 30 mm before its travel to 30 mm after it, driven by hand: is any of it still below the end?"""
    text = scene_text(kind, side, 40.0) + f'[[drives]]\ninstance = "plate"\ntravel = {slid}\n'
    scene = scene_from_toml(text.encode(), "t", "t")
    parts, matings = make_parts(scene, "t")
    placing = place(scene.instances, scene.drives, parts, matings, "t")
    stand = {one.id: one for one in placing.at([slid])}
    edge = samples(parts["plate"].section(0.0).region.outer).real + stand["plate"].centre.real
    cam, end = matings[0].cam, stand["follower"]
    arm = 80.0 if side and matings[0].end.arm_length else 0.0
    over = (end.centre + arm * np.exp(1j * end.rotation)).real
    out = not edge.min() <= over <= edge.max()
    found = scene_checks(placing, parts, scene.drives, "en", contact=False)["mates"][0]
    told = [f for f in found.get("findings", ()) if f["code"] == "plate_runs_out"]
    assert bool(told) == out
    if told:
        assert told[0]["value"] == pytest.approx(over - stand["plate"].centre.real, abs=1e-9)
        assert told[0]["limit"] == pytest.approx(min(cam.ends, key=lambda x: abs(x - told[0]["value"])), abs=1e-9)

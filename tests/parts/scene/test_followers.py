"""Followers, and their contact with the cam: every kind, guided and swinging, on the exact outlines."""

import math
from typing import Any

import numpy as np
import pytest
import shapely

from exporters.production.check import scene_checks
from exporters.production.check_lines import has_bad_verdict
from geometry.curves.curve import Complex
from geometry.plane.distance import Verdict
from geometry.plane.profile import Profile
from parts.mates.follower import CamFollowerMating
from parts.scene.files import built_in_scenes
from parts.scene.load import SceneError, load_scene, make_parts, scene_from_toml
from parts.scene.placing import Placing, place

PHASES = """phases = [
    { move = "rise", angle_deg = 120.0, law = "polynomial_345" },
    { move = "dwell", angle_deg = 60.0 },
    { move = "return_", angle_deg = 120.0, law = "sine" },
    { move = "dwell", angle_deg = 60.0 },
]
"""
TRANSLATING = {
    "pointed": ('follower = "pointed"', 'kind = "follower"\nend = "pointed"\ntip_angle_deg = 20.0'),
    "roller": ('follower = "roller"\nfollower_radius = 8.0\nfollower_offset = 4.0', 'kind = "roller"\ndiameter = 16.0'),
    "mushroom": (
        'follower = "mushroom"\nfollower_radius = 30.0',
        'kind = "follower"\nend = "mushroom"\nfollower_radius = 30.0\nplate_diameter = 48.0',
    ),
    "flat": ('follower = "flat"', 'kind = "follower"\nend = "flat"\nplate_diameter = 60.0'),
}
ARMS = {
    "pointed": ("arm_length = 70.0", 'end = "pointed"\narm_length = 70.0\ntip_angle_deg = 20.0\ntip_height = 25.0'),
    "mushroom": (
        "arm_length = 70.0",
        'end = "mushroom"\narm_length = 70.0\nfollower_radius = 25.0\ntip_height = 20.0\nwidth = 6.0',
    ),
    "flat": ("face_offset = 5.0", 'end = "flat"\narm_length = 110.0\nface_offset = 5.0\nboss_diameter = 9.0'),
}


def scene_text(kind: str, sense: str | None) -> str:
    if sense is None:
        cam, follower = TRANSLATING[kind]
        cam += "\nlift = 12.0"
    else:
        table, follower = ARMS[kind]
        radius = "\nfollower_radius = 25.0" if kind == "mushroom" else ""
        cam = f'follower = "{kind}"\nswing_deg = 9.0{radius}\n'
        cam += f'oscillating = {{ centre_distance = 80.0, sense = "{sense}", {table} }}'
        follower = f'kind = "follower_arm"\nsense = "{sense}"\n{follower}'
    return f"""
[parts.cam]
kind = "cam"
{cam}
{PHASES}
base_circle_radius = 30.0
[parts.follower]
{follower}
[instances.cam]
rotation_deg = {{turned}}
[instances.follower]
[[mates]]
kind = "cam_follower"
first = "cam"
second = "follower"
direction_deg = {{direction}}
[checks]
interference = true
"""


def made(text: str) -> tuple[Placing, dict[str, Any], Any]:
    scene = scene_from_toml(text.encode(), "t", "t")
    parts, matings = make_parts(scene, "t")
    return place(scene.instances, scene.drives, parts, matings, "t"), parts, matings[0]


CASES = [(k, None) for k in TRANSLATING] + [(k, s) for k in ARMS for s in ("against", "with")]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("kind", "sense"), CASES)
def test_contact_over_a_turn_and_what_spoils_it(kind: str, sense: str | None) -> None:
    _, _, mating = made(scene_text(kind, sense).replace("{turned}", "0.0").replace("{direction}", "90.0"))
    assert isinstance(mating, CamFollowerMating)
    found = mating.contact(0.0, 0.0, None)
    assert found is not None
    assert found.verdict is Verdict.CONTACT
    assert max(map(abs, found.gaps)) < 1e-11
    pressed, lifted = mating.contact(-1e-6, 0.0, None), mating.contact(1e-6, 0.0, None)
    assert pressed is not None
    assert pressed.verdict is Verdict.OVERLAP
    assert lifted is not None
    assert lifted.verdict is Verdict.CLEAR


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("kind", "sense"), CASES)
@pytest.mark.parametrize("turned", [75.0, 250.0])
def test_polygons_of_the_placed_parts_touch(kind: str, sense: str | None, turned: float) -> None:
    """The outlines as placed, by GEOS: they touch and do not overlap, whatever the direction of the follower."""
    text = scene_text(kind, sense).replace("{turned}", str(turned + 40)).replace("{direction}", "130.0")
    placing, parts, _ = made(text)
    shapes = []
    for instance in placing.instances:
        points = samples(parts[instance.part].section(0.0).region.outer)
        points = points * np.exp(1j * instance.rotation) + instance.centre
        shapes.append(shapely.Polygon(np.stack([points.real, points.imag], axis=1)))
    assert shapes[0].distance(shapes[1]) < 2e-4
    assert shapes[0].intersection(shapes[1]).area < 1e-4


def samples(profile: Profile) -> Complex:
    return np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 1000)[:-1]) for s in profile.segments()])


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["laser_cam_model", "print_cam_set"])
def test_built_in_models_fit_together(name: str) -> None:
    scene = load_scene(str(built_in_scenes()[name]))
    parts, matings = make_parts(scene, name)
    placing = place(scene.instances, scene.drives, parts, matings, name)
    checks = scene_checks(placing, parts, scene.drives, "uk", contact=True)
    assert not has_bad_verdict(checks)
    verdicts = [m["verdict"] for m in checks["mates"] if "verdict" in m]
    assert set(verdicts) == {"contact"}
    assert "solids" not in checks


def test_a_guide_in_the_way_is_found() -> None:
    text = built_in_scenes()["laser_cam_model"].read_text().replace("[13.15, 95.0, 0.0]", "[12.5, 95.0, 0.0]")
    scene = scene_from_toml(text.encode(), "t", "t")
    parts, matings = make_parts(scene, "t")
    placing = place(scene.instances, scene.drives, parts, matings, "t")
    checks = scene_checks(placing, parts, scene.drives, "en", contact=True)
    pairs = {frozenset((s["first"], s["second"])) for s in checks["solids"]}
    assert frozenset(("follower", "guide_right")) in pairs


@pytest.mark.parametrize(
    ("kind", "sense", "change", "named", "value"),
    [
        ("roller", None, ("diameter = 16.0", "diameter = 15.0"), "diameter", 16.0),
        ("mushroom", None, ('end = "mushroom"\nfollower_radius = 30.0', 'end = "mushroom"\nfollower_radius = 31.0'),
         "follower_radius", 30.0),
        ("flat", None, ("plate_diameter = 60.0", "plate_diameter = 20.0"), "plate_diameter", None),
        ("flat", "with", ("arm_length = 110.0", "arm_length = 60.0"), "arm_length", None),
        ("pointed", "with", ('kind = "follower_arm"\nsense = "with"', 'kind = "follower_arm"\nsense = "against"'),
         "sense", None),
        ("pointed", "with", ('arm_length = 70.0\ntip', 'arm_length = 71.0\ntip'), "arm_length", 70.0),
        ("roller", None, ('kind = "roller"\ndiameter = 16.0', 'kind = "follower"\nend = "flat"\nplate_diameter = 40.0'),
         "end", None),
        ("flat", None, ('end = "flat"', 'end = "flat"\nfollower_radius = 3.0'), "follower_radius", 0.0),
        # twice the greatest S' of the sine law, 2 h / phi: what its cam takes; the guides alone would take 20
        ("flat", None, ("plate_diameter = 60.0", ""), "plate_diameter", math.ceil(4e4 * 12 / math.radians(120)) / 1e4),
        ("pointed", None, ("tip_angle_deg = 20.0", "tip_angle_deg = 5.0"), "stem_length", None),
        ("mushroom", None, ("plate_diameter = 48.0", "plate_diameter = 70.0"), "plate_diameter", None),
        ("pointed", "with", ("tip_height = 25.0", "tip_height = 500.0"), "tip_height", None),
    ],
)  # fmt: skip
def test_refusals_name_what_works(
    kind: str, sense: str | None, change: tuple[str, str], named: str, value: float | None
) -> None:
    text = scene_text(kind, sense).replace("{turned}", "0.0").replace("{direction}", "90.0")
    assert change[0] in text
    broken = text.replace(*change)
    with pytest.raises(SceneError) as refusal:
        made(broken)
    assert refusal.value.key.rpartition(".")[2] == named
    if value is not None:
        assert f"{value:g}" in str(refusal.value)


@pytest.mark.parametrize(
    ("kind", "key", "other", "right"),
    [("flat", "face_offset", 6.0, 5.0), ("pointed", "arm_length", 71.0, 70.0), ("mushroom", "arm_length", 69.0, 70.0)],
)
def test_an_arm_of_another_size_than_its_cam_is_made_for_is_refused(
    kind: str, key: str, other: float, right: float
) -> None:
    text = scene_text(kind, "with").replace("{turned}", "0.0").replace("{direction}", "0.0")
    head, arm = text.split("[parts.follower]")
    text = f"{head}[parts.follower]{arm.replace(f'{key} = {right}', f'{key} = {other}', 1)}"
    with pytest.raises(SceneError) as caught:
        make_parts(scene_from_toml(text.encode(), "s", "s"), "s")
    told = caught.value
    assert (told.key.rpartition(".")[2], told.value, told.code) == (key, other, "cam_has_another")
    assert told.nearest is not None
    assert told.nearest.value == right

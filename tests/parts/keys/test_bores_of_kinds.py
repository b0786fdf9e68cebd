"""A bore that is no shape, and holes that meet, are refused by every kind that takes them, by the key that cures it."""

from __future__ import annotations

import math
import tomllib
from typing import Any

import pytest

from exporters.command.new import new_scene
from parts.base.refusal import SceneError
from parts.base.registry import KINDS
from parts.scene.load import make_parts, scene_from_dict

Raw = dict[str, Any]
MEET = 3 * (math.cos(math.pi / 6) + math.sin(math.pi / 6)) - 0.3
# what is wrong, the key of it, its code, and the limit by hand: a flat on the circle, a keyway as wide as it
WRONG: dict[str, tuple[Raw, str, str, float]] = {
    "flat outside": ({"shape": "D", "diameter": 8.0, "flat": 9.0}, "flat", "flat_outside_bore", 8.0),
    "flats outside": (
        {"shape": "double_D", "diameter": 8.0, "across_flats": 9.0}, "across_flats", "flat_outside_bore", 8.0,
    ),
    "keyway too wide": (
        {"shape": "keyway", "diameter": 8.0, "width": 9.0}, "width", "keyway_as_wide_as_bore", 8.0,
    ),
    "rounding too large": (
        {"shape": "hexagon", "across_flats": 6.0, "corner_radius": 5.0}, "corner_radius", "roundings_leave_no_side",
        3.0,
    ),
    "slots too wide": (
        {"shape": "spline", "teeth": 6, "inner_diameter": 6.0, "outer_diameter": 8.0, "width": 9.0, "chamfer": 0.3},
        # its half h is where chamfers meet between two slots: 3 (cos 30 + sin 30) - h = 0.3 + sqrt(9 - h^2)
        "width", "spline_sides_meet", MEET - math.sqrt(18 - MEET**2),
    ),
}  # fmt: skip
TAKING = [kind for kind in KINDS if "bore" in KINDS[kind].keys.__struct_fields__]
CAMS = [
    kind
    for kind in TAKING
    if (kind == "cam" or kind.endswith("_cam")) and "holes" in KINDS[kind].keys.__struct_fields__
]


def made(kind: str, key: str, value: object) -> None:
    """Its section with one key changed; no bore in short beside it."""
    raw = tomllib.loads(new_scene(kind))
    (own,) = (table for table in raw["parts"].values() if table["kind"] == kind)
    own.pop("bore_diameter", None)
    own[key] = value
    scene = scene_from_dict(raw | {"exports": [{"format": "svg"}]}, "s.toml", "s")
    for part in make_parts(scene, "s.toml")[0].values():
        part.section(0.0)


def refused(kind: str, key: str, value: object) -> SceneError:
    with pytest.raises(SceneError) as caught:
        made(kind, key, value)
    return caught.value


# as many as show every kind twice
@pytest.mark.sampled(len(TAKING))
@pytest.mark.parametrize("wrong", WRONG)
@pytest.mark.parametrize("kind", TAKING)
def test_a_bore_that_is_no_shape_is_refused_by_its_own_key(kind: str, wrong: str) -> None:
    bore, key, code, most = WRONG[wrong]
    refusal = refused(kind, "bore", bore)
    assert refusal.key.endswith(f".bore.{key}")
    assert refusal.code == code
    assert refusal.nearest is not None
    assert refusal.nearest.value == pytest.approx(most, abs=2e-4)
    made(kind, "bore", bore | {key: refusal.nearest.value})


@pytest.mark.sampled(2)
@pytest.mark.parametrize("kind", CAMS)
def test_holes_of_a_cam_that_meet_are_told_a_size_that_keeps_them_apart(kind: str) -> None:
    holes = {"count": 200, "diameter": 5.0, "pitch_circle_diameter": 30.0}
    refusal = refused(kind, "holes", holes)
    assert (refusal.key.rpartition(".")[2], refusal.code) == ("diameter", "holes_touch_each_other")
    assert refusal.nearest is not None
    # chords of 200 holes on a circle of 30 mm, less the least wall
    assert refusal.nearest.value == pytest.approx(30 * math.sin(math.pi / 200) - 0.05, abs=2e-4)
    made(kind, "holes", holes | {"diameter": refusal.nearest.value})

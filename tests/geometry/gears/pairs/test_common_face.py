"""Helical mates along their common face: verdicts beside a total contact ratio of 1, heights, double helices."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely

from exporters.production.check import scene_checks
from exporters.production.check_lines import check_lines
from parts.scene.load import make_parts, scene_from_dict
from tests import brute
from tests.parts.mates.test_mate_kinds import scene

# transverse contact ratios below 1
PAIRS: dict[str, tuple[dict[str, Any], dict[str, Any]]] = {
    "external_gear_pair": (
        {"kind": "spur_gear", "number_of_teeth": 12, "profile_shift_coefficient": 0.5, "hand": "right"},
        {"kind": "spur_gear", "number_of_teeth": 40, "profile_shift_coefficient": 0.5, "hand": "left"},
    ),
    "internal_gear_pair": (
        {"kind": "spur_gear", "number_of_teeth": 20, "tip_diameter": 57.5, "hand": "right"},
        {"kind": "ring_gear", "number_of_teeth": 60, "hand": "right"},
    ),
    "rack_pair": (
        {"kind": "spur_gear", "number_of_teeth": 14, "tip_diameter": 41.4, "hand": "right"},
        {"kind": "rack", "number_of_teeth": 12, "hand": "left"},
    ),
}


def two(kind: str, width: float, **keys: Any) -> tuple[dict[str, Any], dict[str, Any]]:
    """The keys of a pair; module 2, 45 degrees."""
    first, second = ({"module": 2.0, "helix_angle_deg": 45.0, "face_width": width, **p, **keys} for p in PAIRS[kind])
    return first, second


def checks_of(kind: str, width: float, instances: dict[str, Any] | None = None, **keys: Any) -> dict[str, Any]:
    """The check of a pair whose first is ``a`` and whose second is ``b``."""
    first, second = two(kind, width, **keys)
    made, _, stand = scene({"a": first, "b": second}, {"kind": kind, "first": "a", "second": "b"}, instances=instances)
    return scene_checks(stand, made, (), "en", contact=True)["mates"][0]


def enough(kind: str) -> float:
    """The face width that makes up for the transverse contact ratio, mm."""
    found = checks_of(kind, 1.0)
    assert 0.3 < found["effective_contact_ratio"] < 1
    return (1 - found["effective_contact_ratio"]) * math.pi * 2.0 / math.sin(math.radians(45))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("kind", PAIRS)
@pytest.mark.parametrize("double", [False, True])
def test_a_face_that_is_just_wide_enough_carries_on(kind: str, double: bool) -> None:
    width = enough(kind) * (2 if double else 1)
    for share, verdict, code in ((0.97, "clear", "total_contact_ratio"), (1.03, "contact", "transverse_contact_ratio")):
        found = checks_of(kind, share * width, double_helical=double)
        assert found["verdict"] == verdict
        assert (found["total_contact_ratio"] > 1) == (verdict == "contact")
        ratio = share * width / (2 if double else 1) * math.sin(math.radians(45)) / (math.pi * 2.0)
        assert found["overlap_ratio"] == pytest.approx(ratio, rel=1e-12)
        assert code in {f["code"] for f in found["findings"]}
        assert "contact_ratio" not in {f["code"] for f in found["findings"]}
        lines = check_lines({"mates": [found]}, "en")
        assert ("part on their way" in lines[0]) == (verdict == "clear")
        assert f"total {found['total_contact_ratio']:.4f}" in lines[0]


def test_straight_teeth_have_no_overlap() -> None:
    found = checks_of("external_gear_pair", 40.0, helix_angle_deg=0.0)
    assert not {"overlap_ratio", "total_contact_ratio"} & set(found)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("hand", ["right", "left"])
def test_sections_along_the_face_against_dense_polygons(hand: str) -> None:
    """Driven on one side: at every drive angle some section of a face that is wide enough touches; else not always."""
    first, second = two("external_gear_pair", 1.0)
    first["hand"], second["hand"] = hand, {"right": "left", "left": "right"}[hand]
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b", "normal_backlash": 0.3}
    raw = {"parts": {"a": first, "b": second}, "mates": [mate]}
    pair = make_parts(scene_from_dict(raw, "t", "t"), "t")[1][0].pair
    outlines = [brute.polygon(s.profile(), 60) for s in pair.sides]
    slope = math.tan(math.radians(45)) / np.array([g.reference_radius for g in pair.gears])
    slope *= np.array([1, -1]) if hand == "right" else np.array([-1, 1])

    def line(points: np.ndarray) -> shapely.Geometry:
        ring = shapely.LinearRing(np.column_stack([points.real, points.imag]))
        at = pair.working_radii[0]
        return shapely.clip_by_rect(ring, at - 7.0, -7.0, at + 7.0, 7.0)

    def apart(drive: float, height: float) -> float:
        turned = drive + slope[0] * height, pair.second_rotation(drive, contact=1) + slope[1] * height
        one = line(outlines[0] * np.exp(1j * turned[0]))
        other = line(outlines[1] * np.exp(1j * turned[1]) + pair.working_centre_distance)
        return float(one.distance(other))

    width = (1 - pair.effective_contact_ratio) * math.pi * 2.0 / math.sin(math.radians(45))
    drives = np.linspace(0, pair.first.pitch_angle, 20, endpoint=False)
    heights = np.linspace(0, 1.1 * width, 9)
    gaps = np.array([[apart(d, z) for z in heights] for d in drives])
    assert gaps.min(axis=1).max() < 1e-4
    assert gaps[:, :4].min(axis=1).max() > 5e-4


def test_heights_turn_helical_teeth_and_narrow_the_face() -> None:
    """The second stands 3 mm higher: it must be turned by what the first's teeth turn in 3 mm."""
    first, second = two("external_gear_pair", 10.0)
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b"}
    _, matings, stand = scene({"a": first, "b": second}, mate)
    there = stand.instances[1]
    turn = -math.degrees(math.tan(math.radians(45)) * 3.0 / matings[0].pair.second.reference_radius)
    place = {"a": {"at": [0, 0, 0]}, "b": {"at": [there.centre.real, there.centre.imag, 3.0]}}
    for extra, met in ((turn, True), (0.0, False)):
        place["b"]["rotation_deg"] = math.degrees(there.rotation) + extra  # type: ignore[assignment]
        found = checks_of("external_gear_pair", 10.0, place)
        assert {c["code"]: c["met"] for c in found["conditions"]}["phase"] is met
    place["b"]["rotation_deg"] = math.degrees(there.rotation) + turn  # type: ignore[assignment]
    found = checks_of("external_gear_pair", 10.0, place)
    assert found["verdict"] == "contact"
    assert found["common_face_width"] == pytest.approx(7.0, rel=1e-12)
    narrow = checks_of("external_gear_pair", 3.5, place)
    assert narrow["common_face_width"] == pytest.approx(0.5, rel=1e-12)
    assert narrow["verdict"] == "clear"


def test_herringbones_meet_at_one_height_only() -> None:
    first, second = two("external_gear_pair", 10.0, double_helical=True)
    mate = {"kind": "external_gear_pair", "first": "a", "second": "b"}
    _, _, stand = scene({"a": first, "b": second}, mate)
    there = stand.instances[1]
    for height, met in ((0.0, True), (0.5, False)):
        place = {"a": {"at": [0, 0, 0]}, "b": {"at": [there.centre.real, there.centre.imag, height],
                 "rotation_deg": math.degrees(there.rotation)}}  # fmt: skip
        found = checks_of("external_gear_pair", 10.0, place, double_helical=True)
        assert {c["code"]: c["met"] for c in found["conditions"]}["herringbone_height"] is met

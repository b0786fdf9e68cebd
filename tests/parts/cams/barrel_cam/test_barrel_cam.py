"""The part kind ``barrel_cam``: sizes that follow, refusals whose remedy works, offsets, and what is told."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from msgspec import convert

from exporters.production.plan import plan_build
from geometry.base.errors import OffsetError, ParameterError
from geometry.cams.barrel.body import BarrelBody, barrel_moments
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.cams.barrel_cam.part import BARREL_CAM
from parts.cams.barrel_cam.probe import GrooveRoller
from parts.keys.barrel import BarrelCamSpec
from parts.scene.load import load_scene, make_parts, scene_from_dict
from tests.exporters.making import read_report, run, write_scene
from tests.parts.nearest import cured, refused

PHASES = [
    {"move": "rise", "angle_deg": 130.0, "law": "sine"},
    {"move": "dwell", "angle_deg": 40.0},
    {"move": "return_", "angle_deg": 120.0, "law": "polynomial_345"},
    {"move": "dwell", "angle_deg": 70.0},
]
GROOVE: dict[str, Any] = {"kind": "barrel_cam", "form": "groove", "outer_diameter": 60.0, "groove_depth": 8.0,
                          "roller_diameter": 10.0, "lift": 20.0, "phases": PHASES}  # fmt: skip
END = GROOVE | {"form": "end", "lift": 12.0, "web_thickness": 3.0}
SWING = {k: v for k, v in GROOVE.items() if k != "lift"} | {"swing_deg": 24.0, "oscillating": {"arm_length": 50.0}}
CONE = SWING | {"roller_form": "conical", "cone_angle_deg": 40.0}


def part_of(keys: dict[str, Any]) -> Part:
    scene = scene_from_dict({"parts": {"cam": keys}}, "s", "s")
    return make_parts(scene, "s")[0]["cam"]


def body_of(keys: dict[str, Any]) -> BarrelBody:
    body = part_of(keys).thing
    assert body is not None
    return body


def moved(part: Part, offset: float) -> BarrelBody:
    """The solid of a part moved out of its material, as its probe has it."""
    (probe,) = part.probes
    assert isinstance(probe, GrooveRoller)
    return probe.body(offset)


def blamed(keys: dict[str, Any]) -> str:
    """The key that is blamed."""
    return refused({"cam": keys}).key.removeprefix("parts.cam.")


def test_the_length_follows_from_groove_and_margins() -> None:
    assert body_of(GROOVE).length == pytest.approx(20 + 10 + 2 * 5)
    assert body_of(GROOVE | {"end_margin": 2.5}).length == pytest.approx(35.0)
    long = body_of(GROOVE | {"length": 50.0})
    assert long.length == pytest.approx(50.0)
    # the groove stands in the middle
    assert long.cam.height_range() == pytest.approx((15.0, 35.0))
    end = body_of(END | {"end_margin": 6.0})
    assert end.length == pytest.approx(18.0)
    lowest = end.cam.wall(0.0, -1, 25.0)[2]
    assert lowest == pytest.approx(6.0)


def test_a_swinging_roller_strays_to_both_sides_alike() -> None:
    cam = body_of(SWING).cam
    low, high = cam.side_range()
    assert -low == pytest.approx(high, rel=1e-3)
    assert high == pytest.approx(25 * (1 - math.cos(math.radians(12))), rel=1e-3)
    low, high = cam.height_range()
    assert high - low == pytest.approx(2 * 50 * math.sin(math.radians(12)))


def test_the_clearance_widens_the_groove() -> None:
    part = part_of(GROOVE | {"clearance": 0.3})
    assert part.quantities["groove_width"] == pytest.approx(10.3)
    assert part.quantities["roller_diameter"] == 10.0


@pytest.mark.sampled(8)
@pytest.mark.parametrize(("keys", "key"), [
    (GROOVE | {"roller_diameter": 58.0, "groove_depth": 1.0}, "groove_depth"),
    (GROOVE | {"lift": 60.0, "phases": [PHASES[0] | {"angle_deg": 40.0}, PHASES[1] | {"angle_deg": 10.0},
               PHASES[2] | {"angle_deg": 40.0}, PHASES[3] | {"angle_deg": 270.0}], "roller_diameter": 20.0},
     "roller_diameter"),
    (GROOVE | {"groove_depth": 30.0}, "groove_depth"),
    (GROOVE | {"groove_depth": 26.0}, "groove_depth"),
    (GROOVE | {"length": 25.0}, "length"),
    (GROOVE | {"bore_diameter": 44.5}, "bore_diameter"),
    (GROOVE | {"hub": {"diameter": 70.0, "above": 3.0}}, "hub.diameter"),
    (GROOVE | {"bore_diameter": 20.0, "hub": {"diameter": 15.0, "above": 3.0}}, "hub.diameter"),
    (END | {"web_thickness": 9.0}, "web_thickness"),
    (END | {"web_thickness": 0.0, "bore_diameter": 8.0}, "web_thickness"),
    (END | {"clearance": 0.1}, "clearance"),
    (GROOVE | {"web_thickness": 2.0}, "web_thickness"),
    (GROOVE | {"swing_deg": 2.0}, "swing_deg"),
    (CONE | {"cone_angle_deg": 90.0}, "cone_angle_deg"),
    (CONE | {"cone_angle_deg": 60.0, "roller_diameter": 3.0, "groove_depth": 20.0}, "cone_angle_deg"),
    (GROOVE | {"lift": 60.0, "roller_diameter": 20.0, "roller_form": "conical", "clearance": 0.1,
               "phases": [PHASES[0] | {"angle_deg": 40.0}, PHASES[1] | {"angle_deg": 10.0},
                          PHASES[2] | {"angle_deg": 40.0}, PHASES[3] | {"angle_deg": 270.0}]}, "roller_diameter"),
    (SWING | {"swing_deg": 100.0, "oscillating": {"arm_length": 20.0}}, "swing_deg|roller_diameter"),
])  # fmt: skip
def test_every_refusal_names_a_value_that_works(keys: dict[str, Any], key: str) -> None:
    found = refused({"cam": keys})
    assert re.fullmatch(rf"parts\.cam\.({key})", found.key)
    cured({"cam": keys}, found)


def test_a_roller_wider_than_the_drum_wants_a_larger_drum() -> None:
    """No groove is shallow enough for it."""
    scene = {"cam": GROOVE | {"roller_diameter": 70.0}}
    found = refused(scene)
    assert found.key == "parts.cam.outer_diameter"
    cured(scene, found)


def test_a_cone_has_its_apex_on_the_cams_axis_or_an_angle_of_its_own() -> None:
    own = part_of(GROOVE | {"roller_form": "conical", "clearance": 0.2}).quantities
    assert math.tan(math.radians(own["cone_angle_deg"]) / 2) == pytest.approx(10 / 60)
    assert own["roller_floor_diameter"] == pytest.approx(10 * 22 / 30)
    assert own["groove_width"] == pytest.approx(10.2)
    assert part_of(CONE).quantities["cone_angle_deg"] == pytest.approx(40.0)
    # the track of an end is highest at its inner edge
    end = body_of(END | {"roller_form": "conical"})
    assert end.length == pytest.approx(end.cam.height_range()[1] - 5 * 22 / 30)
    assert blamed(GROOVE | {"cone_angle_deg": 20.0}) == "cone_angle_deg"


def test_a_cone_moved_by_an_offset_stays_parallel() -> None:
    part = part_of(CONE)
    body = moved(part, 0.3)
    points = body.cam.wall(np.linspace(0, 6, 40), 1, 26.0)
    assert np.abs(body_of(CONE).cam.distance(points) + 0.3).max() < 1e-12
    for keys in (CONE, GROOVE, END):
        for offset in (6.0, -30.0):
            with pytest.raises(OffsetError) as caught:
                part_of(keys).body(offset)
            part_of(keys).body(caught.value.nearest_offset)


def test_keys_that_exclude_each_other_are_refused() -> None:
    assert blamed(GROOVE | {"length": 60.0, "end_margin": 3.0}) == "end_margin"
    assert blamed(GROOVE | {"bore_diameter": 6.0, "bore": {"shape": "round", "diameter": 6.0}}) == "bore_diameter"
    stiff = [PHASES[0] | {"law": "constant_velocity"}, *PHASES[1:]]
    parts = {"cam": GROOVE | {"phases": stiff}}
    found = refused(parts)
    assert (found.key, found.code) == ("parts.cam.phases[1].law", "velocity_jumps_in_groove")
    cured(parts, found)
    # another law in one of two phases leaves the jump at the other one
    both = [
        PHASES[0] | {"law": "constant_velocity"},
        *PHASES[1:2],
        PHASES[2] | {"law": "constant_velocity"},
        *PHASES[3:],
    ]
    assert refused({"cam": GROOVE | {"phases": both}}).nearest is None
    with pytest.raises(ParameterError) as untried:
        BARREL_CAM.thing(convert(GROOVE | {"phases": both}, BarrelCamSpec), {})
    assert untried.value.nearest is None


def test_an_offset_moves_all_walls_but_the_ends() -> None:
    part = part_of(GROOVE | {"bore_diameter": 12.0})
    grown = moved(part, 0.5)
    assert (grown.cam.radius, grown.cam.outer, grown.cam.inner) == (4.5, 30.5, 22.5)
    assert grown.length == moved(part, 0.0).length
    with pytest.raises(OffsetError) as closed:
        part.body(5.5)
    part.body(closed.value.nearest_offset)
    with pytest.raises(OffsetError) as closed:
        part.body(-30.0)
    # the sum of what grows is the surface that moved: to first order
    step = 1e-4
    volumes = [barrel_moments(moved(part, x)).volume for x in (-step, step)]
    mesh = part.to_trimesh(0.05)
    flat = np.abs(mesh.face_normals[:, 2]) > 1 - 1e-9
    ends = [m for m in np.flatnonzero(flat) if mesh.triangles_center[m, 2] in (0.0, moved(part, 0.0).length)]
    upright = mesh.area - mesh.area_faces[ends].sum()
    # dwells are plane rings too, but inside
    assert (volumes[1] - volumes[0]) / (2 * step) == pytest.approx(upright, rel=5e-3)


def test_what_is_told_of_steep_and_tight_grooves() -> None:
    codes = {f.code for f in part_of(GROOVE | {"lift": 32.0}).findings}
    assert "steep_groove" in codes
    codes = {
        f.code
        for f in part_of(GROOVE | {"phases": [PHASES[0] | {"law": "constant_acceleration"}, *PHASES[1:]]}).findings
    }
    assert "soft_impact" in codes
    largest = part_of(GROOVE).quantities["largest_roller_diameter"]
    part_of(GROOVE | {"roller_diameter": largest * (1 - 1e-6)})
    assert any(f.code == "development" for f in part_of(GROOVE).flat_findings)


def test_the_built_in_scene_has_both_forms() -> None:
    parts, _ = make_parts(load_scene("barrel_cam"), "barrel_cam")
    assert {p.thing.cam.is_groove for p in parts.values() if p.kind == "barrel_cam"} == {True, False}
    assert parts["barrel"].density == 1.24


def test_a_bore_and_a_hub_that_no_number_fits_are_not_offered_one() -> None:
    found = refused({"cam": END | {"bore_diameter": 43.9, "hub": {"diameter": 43.95, "above": 3.0}}})
    assert (found.key, found.code, found.nearest) == ("parts.cam.bore_diameter", "no_room_for_hub", None)


@pytest.mark.parametrize("keys", [GROOVE, END | {"end_margin": 6.0}, SWING])
@pytest.mark.parametrize("diameter", [1e-4, 0.1, 0.79])
def test_rollers_longer_than_ten_diameters_are_refused(keys: dict[str, Any], diameter: float) -> None:
    """Walls are proven by pieces as small as the roller: a default STL took minutes of one of 0.1 mm, 8 mm long."""
    found = refused({"cam": keys | {"roller_diameter": diameter}})
    assert (found.key, found.code) == ("parts.cam.roller_diameter", "roller_too_slender")
    assert found.nearest is not None
    assert found.nearest.value == pytest.approx(0.8, abs=1e-12)
    assert body_of(keys | {"roller_diameter": 0.8}).cam.radius == pytest.approx(0.4)


def test_a_development_is_cut_from_no_board(tmp_path: Path) -> None:
    """A board as thick as the barrel is long, 20 + 10 + 2 x 5 mm, was laid out with what goes around its cylinder."""
    raw = {"parts": {"cam": GROOVE}, "boards": {"b": {"width": 300.0, "height": 200.0, "thickness": 40.0}},
           "exports": [{"format": "dxf", "purpose": "board"}]}  # fmt: skip
    with pytest.raises(SceneError) as told:
        plan_build(scene_from_dict(raw, "s", "s"), "s", [], [])
    assert (told.value.key, told.value.code) == ("boards.b.thickness", "no_flat_part")
    assert not part_of(GROOVE).is_plate
    # what its flat outline is says enough
    file = write_scene(tmp_path / "s.toml", {"cam": GROOVE}, [{"format": "svg"}])
    assert run("build", file, "--out", tmp_path) == 0
    (entry,) = read_report(tmp_path / "s")["files"]
    codes = [finding["code"] for finding in entry["findings"]]
    assert "development" in codes
    assert "flat_outline" not in codes

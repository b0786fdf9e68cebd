"""Carrier plates against the union of a hub and its arms by shapely; what is engraved in plates, in files."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely
from manifold3d import Manifold, Mesh
from shapely import affinity

from exporters.command.cli import main
from geometry.approximation.chords import approximate_profile
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from tests.parts.limits import refused, scene_of

PLATE = {"kind": "carrier_plate", "number_of_pins": 3, "pin_circle_diameter": 80.0, "pin_diameter": 6.0}
SPACERS = {"count": 3, "pitch_circle_diameter": 60.0, "diameter": 3.0, "start_deg": 60.0}


def part(**keys: Any) -> Part:
    return make_parts(scene_from_dict({"parts": {"p": {**PLATE, **keys}}}, "t", "t"), "t")[0]["p"]


def polygon(made: Part, offset: float = 0.0) -> shapely.Polygon:
    region = made.section(offset).region
    rings = [approximate_profile(p, 1e-4, arcs=False).geometry.expanded()[0] for p in (region.outer, *region.holes)]
    points = [np.stack([r.real, r.imag], axis=1) for r in rings]
    return shapely.Polygon(points[0], points[1:])


def disc(angle: float, distance: float, radius: float) -> shapely.Polygon:
    at = shapely.Point(distance * math.cos(math.radians(angle)), distance * math.sin(math.radians(angle)))
    return at.buffer(radius, quad_segs=128)


def arm(angle: float, distance: float, radius: float) -> shapely.Polygon:
    way = shapely.LineString([(0, 0), (distance, 0)])
    return affinity.rotate(way.buffer(radius, quad_segs=128), angle, origin=(0, 0))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("offset", [0.0, 0.4, -0.4])
def test_a_plate_is_its_hub_and_its_arms(offset: float) -> None:
    made = part(hub_diameter=36.0, bore_diameter=8.0, spacers=SPACERS, seat_clearance=0.1)
    pins, spacers = [(120.0 * k, 40.0, 7.2) for k in range(3)], [(60 + 120.0 * k, 30.0, 3.6) for k in range(3)]
    whole = shapely.union_all([disc(0, 0, 18.0), *(arm(*a) for a in pins + spacers)])
    holes = [*((a, d, 3.1) for a, d, _ in pins), *((a, d, 1.5) for a, d, _ in spacers), (0.0, 0.0, 4.0)]
    expected = whole.difference(shapely.union_all([disc(*hole) for hole in holes])).buffer(offset, quad_segs=128)
    assert polygon(made, offset).symmetric_difference(expected).area < 0.05


def test_arms_that_have_no_room_make_a_round_plate() -> None:
    assert polygon(part(number_of_pins=20)).exterior.hausdorff_distance(disc(0, 0, 47.2).exterior) < 5e-3


@pytest.mark.parametrize(
    ("keys", "key", "code"),
    [
        ({"hub_diameter": 12.0}, "hub_diameter", "arms_meet"),
        ({"hub_diameter": 85.0}, "hub_diameter", "hub_reaches_pins"),
        ({"hub_diameter": 50.0, "outer_diameter": 100.0}, "hub_diameter", "is_round_already"),
        ({"outer_diameter": 84.0}, "pin_diameter", "hole_reaches_edge"),
        ({"directions_deg": [0.0, 90.0]}, "directions_deg", "not_one_a_pin"),
        ({"engraved": [{"start": [0, 5], "end": [5, 5], "width": 1.0, "depth": 6.0}]}, "engraved[1].depth", ""),
        ({"engraved": [{"start": [0, 50], "end": [5, 50], "width": 1.0}]}, "engraved[1]", ""),
    ],
)
def test_what_is_no_plate_is_refused(keys: dict[str, Any], key: str, code: str) -> None:
    with pytest.raises(SceneError) as refusal:
        part(**keys)
    assert refusal.value.key == f"parts.p.{key}"
    assert refusal.value.code == code or not code


WHEELS = """
[parts.gear]
kind = "spur_gear"
module = 2.0
number_of_teeth = 40
bore_diameter = 8.0
face_width = 4.0
tooth_mark = { depth = 0.5 }
[parts.ring]
kind = "ring_gear"
module = 2.0
number_of_teeth = 81
outer_diameter = 190.0
face_width = 4.0
tooth_mark = { height = 4.0 }
[parts.pointer]
kind = "plate"
width = 40.0
height = 30.0
face_width = 4.0
engraved = [{ start = [5.0, 0.0], end = [15.0, 0.0], width = 2.0 }]
[[exports]]
format = "dxf"
kerf = 0.2
[[exports]]
format = "stl"
"""
# strokes of a seven-stroke display
STROKES = {"0": 6, "1": 2, "4": 4, "8": 7}


def test_marks_are_engraved_and_not_cut(tmp_path: Path) -> None:
    """On +x, at tooth 1, of a ring at space 1; the solid lacks their pockets and nothing else."""
    import trimesh

    (tmp_path / "s.toml").write_text(WHEELS)
    assert main(["build", "-q", str(tmp_path / "s.toml"), "--out", str(tmp_path), "--no-verify"]) == 0
    for name, text, depth in (("gear", "40", 0.5), ("ring", "81", 0.4), ("pointer", "", 0.4)):
        found = [e for e in ezdxf.readfile(tmp_path / "s" / f"{name}.dxf").modelspace() if e.dxf.layer == "ENGRAVE"]
        assert len(found) == 1 + sum(STROKES[digit] for digit in text)
        points = np.array([p[:2] for e in found for p in e.get_points()])
        assert points[:, 0].min() > 4.0
        assert abs(points[:, 1]).max() < 7.0
        mesh = trimesh.load(tmp_path / "s" / f"{name}.stl")
        assert mesh.is_watertight
        solid = Manifold(Mesh(mesh.vertices.astype(np.float32), mesh.faces.astype(np.uint32)))
        below, above = (solid.slice(z).area() for z in (3.4, 3.95))
        assert mesh.volume == pytest.approx(below * (4 - depth) + above * depth, rel=1e-6)
        assert below - above > 5.0


def test_digits_that_find_no_room_are_refused_with_what_works() -> None:
    ring: dict[str, Any] = {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 81, "tooth_mark": {"height": 9.0}}
    with pytest.raises(SceneError) as refusal:
        make_parts(scene_from_dict({"parts": {"p": ring}}, "t", "t"), "t")
    nearest = refusal.value.nearest
    assert (refusal.value.key, refusal.value.code) == ("parts.p.tooth_mark.height", "no_room_for_digits")
    assert nearest is not None
    ring["tooth_mark"] = {"height": nearest.value}
    make_parts(scene_from_dict({"parts": {"p": ring}}, "t", "t"), "t")


@pytest.mark.parametrize(("start", "fits"), [(180.0, True), (0.0, False)])
def test_a_hole_leaves_digits_no_room_only_where_they_stand(start: float, fits: bool) -> None:
    """They stand on +x: a hole on the other side of the rim is none of theirs."""
    hole = {"count": 1, "diameter": 6.0, "pitch_circle_diameter": 150.0, "start_deg": start}
    ring: dict[str, Any] = {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 60, "outer_diameter": 160.0,
                            "tooth_mark": {"height": 6.0}, "holes": hole}  # fmt: skip
    found = refused(scene_of(ring))
    assert (found is None) == fits
    assert found is None or (found.key, found.code) == ("parts.p.tooth_mark.height", "no_room_for_digits")


@pytest.mark.parametrize(("keys", "key", "given", "works"), [
    # a pin of 60 mm leaves no clearance room, one of 11.5 mm half of what is left in 12; a seat of no width is none
    ({"pin_diameter": 60.0, "seat_clearance": 0.5}, "pin_diameter", 60.0, 11.0),
    ({"pin_diameter": 11.5, "seat_clearance": 0.5}, "seat_clearance", 0.5, 0.25),
    ({"pin_diameter": 6.0, "seat_clearance": -5.0}, "seat_clearance", -5.0, -3.0),
    ({"pin_diameter": 12.01}, "pin_diameter", 12.01, 12.0),
    # ends of 2.4 pins follow theirs: three pins meet on their chords
    ({"pin_diameter": 6.0, "pin_circle_diameter": 4.0, "boss_diameter": None}, "pin_diameter", 6.0, 2 * math.sqrt(3)),
])  # fmt: skip
def test_a_seat_is_refused_by_the_key_that_was_typed(
    keys: dict[str, float | None], key: str, given: float, works: float
) -> None:
    with pytest.raises(SceneError) as caught:
        part(**{"boss_diameter": 12.0} | keys)
    refusal = caught.value
    assert (refusal.key, refusal.value) == (f"parts.p.{key}", given)
    assert refusal.nearest is not None
    assert refusal.nearest.value == pytest.approx(works, abs=2e-4)

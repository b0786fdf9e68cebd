"""What recipes make goes together: plates share no room, pins stand in holes of theirs and end where something does."""

from __future__ import annotations

import math
from itertools import combinations
from pathlib import Path
from typing import Any

import pytest
import shapely

from exporters.command.cli import main
from geometry.base.record import Record, replace
from parts.scene.load import load_scene, scene_from_dict
from tests.parts.recipes.test_power_table import moved, placed, polygon

# mm: what a pin ends short of or beyond what it stands in; what outlines by chords share
SHORT, TOUCH = 0.6, 0.02
KINEMATICS: dict[str, dict[str, Any]] = {
    f"kinematics {name}": {"kind": "power_module_kinematics", "orientation": name}
    for name in ("cranks", "thesis", "idlers")
}
KINEMATICS |= {
    f"thick {name}": keys | {"module": 4.0, "teeth": [72, 108], "wheel_width": 8.0} for name, keys in KINEMATICS.items()
}
# pins that stand out, which a hand or a table is for, or a follower that runs on them
FREE = {
    "power_table_laser": [*(f"foot_{k} ends at -62" for k in (1, 2, 3, 4)), "ring_handle ends at -29.5",
                          "disk_handle ends at -34"],
    "power_table_print": [*(f"foot_{k} ends at -62" for k in (1, 2, 3, 4)), "shaft ends at -42"],
    "lesson_2": ["handle ends at 35"], "lesson_4": ["axle ends at 9", "guide_pin_1 ends at 9", "guide_pin_2 ends at 9"],
    "lesson_5": ["axle ends at 9", "roller_pin ends at 1"], "james_laser": ["handle ends at 38"],
    "six_link_model": ["handle ends at -26"],
}  # fmt: skip
SCENES = ("power_table_laser", "power_table_print", "compound_two_stage", "ferguson", "lesson_2", "lesson_4",
          "lesson_5", "six_link_model", "david", "practicum_example_1", "james", "james_laser")  # fmt: skip


class Stands(Record):
    """A plate or pin where it stands: faces and outline, mm."""

    name: str
    kind: str
    low: float
    high: float
    shape: shapely.Polygon

    @property
    def filled(self) -> shapely.Polygon:
        return shapely.Polygon(self.shape.exterior)


def standing(name: str) -> list[Stands]:
    """All that stands upright in a scene and is as thick everywhere."""
    scene = scene_from_dict({"assemblies": [KINEMATICS[name]]}, "t", "t") if name in KINEMATICS else load_scene(name)
    placing, parts = placed(scene)
    shapes = {key: polygon(part) for key, part in parts.items() if part.is_plate}
    upright = [i for i in placing.instances if i.part in shapes and i.axis[2] == 1]
    return [
        Stands(i.id, parts[i.part].kind, i.at[2], i.at[2] + parts[i.part].face_width,
               moved(shapes[i.part], i.centre, i.rotation))
        for i in upright
    ]  # fmt: skip


def faults(found: list[Stands]) -> list[str]:
    """What does not go together."""
    told = []
    for a, b in combinations(found, 2):
        if min(a.high, b.high) - max(a.low, b.low) > 1e-6:
            common = a.shape.intersection(b.shape).area
            if common > TOUCH * math.sqrt(min(a.shape.area, b.shape.area)):
                told.append(f"{a.name} and {b.name} share {common:.2f} mm2")
    for pin in (one for one in found if one.kind == "pin" and not one.shape.interiors):
        centre, radius = pin.filled.centroid, math.sqrt(pin.filled.area / math.pi)
        around = [one for one in found if one is not pin and one.filled.contains(centre)]
        here = [one for one in around if min(one.high, pin.high) - max(one.low, pin.low) > 0.1]
        for one in here:
            holes = [shapely.Polygon(ring) for ring in one.shape.interiors]
            near = [hole for hole in holes if hole.contains(centre)]
            if not near:
                told.append(f"{pin.name} is in no hole of {one.name}")
                continue
            play = centre.distance(near[0].exterior) - radius
            if play <= -TOUCH:
                told.append(f"{pin.name} does not go into {one.name}")
        ends = [end for one in around for end in (one.low, one.high)]
        told += [f"{pin.name} ends at {end:g}" for end in (pin.low, pin.high)
                 if min((abs(end - other) for other in ends), default=math.inf) > SHORT]  # fmt: skip
    return told


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", [*KINEMATICS, *SCENES])
def test_plates_share_no_room_and_pins_stand_in_holes(name: str) -> None:
    assert faults(standing(name)) == FREE.get(name, [])


def test_a_pin_beside_its_hole_one_that_is_thick_and_one_that_ends_in_the_air_are_seen() -> None:
    found = standing("kinematics idlers")
    place, pin = next((k, one) for k, one in enumerate(found) if one.kind == "pin")
    for shape, higher in ((moved(pin.shape, 1.0 + 0j, 0.0), 0.0), (pin.shape.buffer(1.0), 0.0), (pin.shape, 2.0)):
        other = replace(pin, shape=shape, high=pin.high + higher)
        assert faults([*found[:place], other, *found[place + 1 :]]) != []


@pytest.mark.heavy
def test_a_printed_dowel_has_the_clearance_that_the_notes_tell(tmp_path: Path) -> None:
    """0.1 mm across, of which chords of the STL take a fifth at most: of the widest dowel, of the narrowest hole."""
    import manifold3d
    import trimesh

    assert main(["build", "power_table_print", "--part", "dowel", "--part", "back", "--format", "stl",
                 "--out", str(tmp_path)]) == 0  # fmt: skip
    dowel, back = (trimesh.load_mesh(tmp_path / "power_table_print" / f"{name}.stl") for name in ("dowel", "back"))
    width = 2 * max(math.hypot(x, y) for x, y, _ in dowel.vertices)
    body = manifold3d.Manifold(manifold3d.Mesh(back.vertices.astype("f4"), back.faces.astype("u4")))
    rings = [shapely.LinearRing(loop) for loop in body.slice(back.bounds[:, 2].mean()).to_polygons()]
    holes = [2 * shapely.Polygon(ring).centroid.distance(ring) for ring in rings]
    fits = [hole - width for hole in holes if abs(hole - width) < 0.5]
    assert len(fits) == 4
    assert min(fits) > 0.08
    assert max(fits) < 0.1 + 1e-5

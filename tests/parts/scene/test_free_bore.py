"""What is free about the axis of a part, against the sizes of its bore."""

from __future__ import annotations

from typing import Any

import pytest

from parts.scene.load import make_parts, scene_from_dict
from parts.scene.shapes import Shape

GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 23, "face_width": 8.0}
# a tube of 5 with a floor of 2 within it
CUP = {"kind": "turned", "points": [
    {"r": r, "z": z} for r, z in ((0.0, 4.0), (5.0, 4.0), (5.0, 0.0), (8.0, 0.0), (8.0, 9.0), (5.0, 9.0), (5.0, 6.0),
                                  (0.0, 6.0))]}  # fmt: skip

PLATE = {
    "kind": "plate",
    "width": 40.0,
    "height": 40.0,
    "face_width": 3.0,
    "holes": [{"at": [9.0, 0.0], "diameter": 4.0}],
}


@pytest.mark.parametrize(
    ("part", "free"),
    [
        (GEAR | {"bore_diameter": 12.0}, 6.0),
        # the flats are nearer than any corner
        (GEAR | {"bore": {"shape": "square", "across_flats": 12.0}}, 6.0),
        (GEAR | {"bore": {"shape": "hexagon", "across_flats": 10.0}}, 5.0),
        (GEAR, 0.0),
        (CUP, 0.0),
        (PLATE, 0.0),
    ],
)  # fmt: skip
def test_what_is_free_about_the_axis(part: dict[str, Any], free: float) -> None:
    """No more than the bore has, and hardly less."""
    parts, _ = make_parts(scene_from_dict({"parts": {"part": part}}, "t", "t"), "t")
    found = Shape(parts["part"]).bore
    assert found <= free
    assert found == pytest.approx(free, rel=0.003)

"""How far boundaries can be moved out of the material and into it: what closes or parts first, worked out by hand."""

from __future__ import annotations

import math
from typing import Any

import pytest

from tests.parts.cams.barrel_cam.test_barrel_drawing import END
from tests.parts.cams.barrel_cam.test_barrel_drawing import KEYS as BARREL
from tests.parts.cams.positive.test_yoke_frame import FLAT, ROLLERS
from tests.parts.limits import offset_limits
from tests.parts.positive_scenes import ROLLER

Keys = dict[str, Any]
NEVER = math.inf
# of a barrel of 70, the least that is left
WALL = 0.05
TURNED: Keys = {
    "kind": "turned",
    "points": [{"r": r, "z": z} for r, z in ((4.0, 0.0), (20.0, 0.0), (20.0, 9.0), (4.0, 9.0))],
}
YOKE: Keys = {"kind": "yoke_frame", "of": "cam", "wall": 9.0}
PINS: Keys = YOKE | {"shaft_diameter": 14.0, "pin_diameter": 6.0}
GROOVE: Keys = {"kind": "groove_cam", "follower_radius": 8.0, "base_circle_radius": 40.0, "lift": 20.0,
                "phases": ROLLER["phases"], "face_width": 12.0, "groove_depth": 6.0, "outer_diameter": 160.0,
                "bore_diameter": 20.0}  # fmt: skip
WEDGE: Keys = {"kind": "wedge_cam", "follower": "roller", "follower_radius": 8.0, "base_height": 15.0, "lift": 20.0,
               "phases": [{"move": "rise", "travel": 60.0, "law": "sine"}],
               "holes": {"diameter": 5.0, "x": 20.0, "y": 8.0}}  # fmt: skip
FLOOR: Keys = {"kind": "groove_piece", "of": "cam", "piece": "floor"}
HOLES: Keys = {"count": 4, "diameter": 6.0, "pitch_circle_diameter": 26.0}

LIMITS: dict[str, tuple[Keys, float, float, dict[str, Keys]]] = {
    # a bore of 8 in a disk of 40: 16 of wall on both sides of it
    "turned": (TURNED, -8.0, 4.0, {}),
    # outside of holes of 6 on a circle of 26: 20 - 13 - 3; they are the first to close
    "turned with holes": (TURNED | {"holes": HOLES}, -2.0, 3.0, {}),
    "roller": ({"kind": "roller", "diameter": 16.0, "bore_diameter": 6.0}, -2.5, 3.0, {}),
    "roller without a bore": ({"kind": "roller", "diameter": 16.0}, -8.0, NEVER, {}),
    # half of the bar
    "yoke": (YOKE, -4.5, NEVER, {"cam": FLAT}),
    "yoke with pins": (PINS, -4.5, 3.0, {"cam": ROLLERS}),
    # 80 to the rim, 10 to the bore
    "floor of a groove": (FLOOR, -35.0, 10.0, {"cam": GROOVE}),
    "wedge": (WEDGE, -NEVER, 2.5, {}),
}


@pytest.mark.parametrize("name", LIMITS)
def test_a_section_bears_offsets_until_something_closes(name: str) -> None:
    keys, low, high, others = LIMITS[name]
    offset_limits(keys, low, high, **others)


@pytest.mark.parametrize(
    ("keys", "low"),
    [
        (BARREL | {"bore_diameter": 46.0}, -(25 - 23 - WALL) / 2),
        (BARREL | {"form": "end"}, -(35 - 25 - WALL) / 2),
        (BARREL | END, -(35 - 25 - WALL) / 2),
    ],
)
def test_a_barrels_solid_bears_offsets_until_something_closes(keys: Keys, low: float) -> None:
    """A groove, or the way of an end cam's roller, of 10 closes at 5; inwards its floor, or its jacket, gets thin."""
    offset_limits(keys, low, 5.0, body=True)

"""Spokes whose hub ring and rim follow from the part: what is left out is what is typed."""

from __future__ import annotations

import math
from typing import Any

import pytest

from parts.base.part import Part
from parts.scene.load import make_parts, scene_from_dict
from tests.parts.limits import refused, scene_of

SPOKES = {"count": 5, "width": 3.0, "corner_radius": 1.0}
# kind, keys, and the inside of the rim, mm, where a textbook gives the roots
WHEELS: list[tuple[str, dict[str, Any], float | None]] = [
    ("spur_gear", {"module": 2.0, "number_of_teeth": 40}, 80 - 2 * 2.5 - 2 * 5.0),
    ("spur_gear", {"module": 2.0, "number_of_teeth": 40, "helix_angle_deg": 20.0},
     80 / math.cos(math.radians(20)) - 2 * 2.5 - 2 * 5.0),
    ("cycloidal_gear", {"module": 2.0, "number_of_teeth": 60, "mate_number_of_teeth": 10}, None),
    ("lantern_gear", {"number_of_teeth": 40, "number_of_pins": 10, "pin_circle_diameter": 40.0, "pin_diameter": 5.0},
     None),
    ("timing_pulley", {"belt": "T5", "number_of_teeth": 60}, None),
    ("sprocket", {"chain": "08B", "number_of_teeth": 38}, None),
    ("geneva_wheel", {"number_of_slots": 5, "centre_distance": 200.0, "pin_diameter": 6.0}, None),
    ("worm_wheel", {"module": 4.0, "number_of_teeth": 40}, 160 - 2 * 4.8 - 2 * 10.0),
    ("face_gear", {"module": 2.0, "number_of_teeth": 60, "pinion_number_of_teeth": 20}, None),
    ("noncircular_gear", {"centrode": "oval", "module": 2.0, "number_of_teeth": 40, "axis_ratio": 1.2}, None),
]  # fmt: skip


def made(part: dict[str, Any]) -> Part:
    return make_parts(scene_from_dict(scene_of(part), "s", "s"), "s")[0]["p"]


def windows(part: Part) -> list[float]:
    """Least and greatest distances from the axis of what is cut beside the bore, mm."""
    holes = [hole for hole in part.section(0.0).region.holes if any(s.label.name == "WINDOW" for s in hole.segments())]
    assert len(holes) == SPOKES["count"]
    places = [abs(s.curve.point(t)) for hole in holes for s in hole.segments() for t in s.curve.domain]
    return [float(min(places)), float(max(places))]


@pytest.mark.parametrize(("kind", "keys", "rim"), WHEELS)
def test_hub_ring_and_rim_follow_from_bore_and_roots(kind: str, keys: dict[str, Any], rim: float | None) -> None:
    part = {"kind": kind, **keys, "spokes": SPOKES, "bore_diameter": 6.0}
    low, high = windows(made(part))
    assert 2 * low == pytest.approx(1.6 * 6.0, rel=0.05)
    if rim is not None:
        assert 2 * high == pytest.approx(rim, rel=1e-4)
    typed = part | {"spokes": SPOKES | {"inner_diameter": 12.0, "outer_diameter": 2 * high - 2.0}}
    assert windows(made(typed))[1] == pytest.approx(high - 1.0, rel=1e-6)


def test_a_hub_a_web_and_wide_spokes_give_the_rings() -> None:
    part: dict[str, Any] = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 40, "spokes": SPOKES,
                            "face_width": 10.0, "bore_diameter": 6.0}  # fmt: skip
    hubbed = part | {"hub": {"diameter": 20.0, "above": 5.0}, "web": {"thickness": 4.0, "rim_diameter": 60.0}}
    low, high = windows(made(hubbed))
    assert (2 * low, 2 * high) == (pytest.approx(21.0, rel=0.02), pytest.approx(60.0 / 1.05, rel=1e-3))
    # twelve spokes of 4 mm do not fit about a ring of 9.6 mm
    wide = made(part | {"spokes": {"count": 12, "width": 4.0}}).thing.holes.spokes
    assert wide.inner_diameter > 4.0 / math.sin(math.pi / 12)


@pytest.mark.parametrize(
    ("keys", "key", "side"),
    [
        # before: inner and outer diameters that nobody typed were blamed
        ({"number_of_teeth": 6, "spokes": {"count": 5, "width": 0.5}}, "spokes", None),
        ({"number_of_teeth": 17, "bore_diameter": 8.0, "spokes": {"count": 5, "width": 0.5}}, "spokes", None),
        ({"number_of_teeth": 30, "spokes": {"count": 12, "width": 30.0}}, "spokes.width", "at_most"),
        (
            {"number_of_teeth": 22, "spokes": {"count": 3, "width": 13.0, "corner_radius": 0.4}},
            "spokes.width",
            "at_most",
        ),
    ],
)
def test_spokes_without_room_are_told_by_what_was_typed(keys: dict[str, Any], key: str, side: str | None) -> None:
    part = {"kind": "spur_gear", "module": 1.0, **keys}
    fault = refused(scene_of(part))
    assert fault is not None
    assert (fault.key, fault.code) == (f"parts.p.{key}", "no_room_for_spokes")
    found = fault.nearest
    assert (found and found.side) == side
    if found is not None:
        spokes = part["spokes"]
        assert isinstance(found.value, float)
        assert refused(scene_of(part | {"spokes": spokes | {"width": found.value}})) is None
        assert refused(scene_of(part | {"spokes": spokes | {"width": 1.001 * found.value}})) is not None

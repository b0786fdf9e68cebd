"""Drawings of cylindrical cams whose follower rests where the section passes: every corner of it by hand."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import shapely

from geometry.curves.line_arc import Line
from parts.drawing.working import VISIBLE, PartDrawing, Size
from tests.parts.drawing.test_sections import drawing_of

# at rest below about +x, at rest above about -x: cam angles 0 and 180 degrees
RESTS = [
    {"move": "dwell", "angle_deg": 40.0},
    {"move": "rise", "angle_deg": 100.0, "law": "sine"},
    {"move": "dwell", "angle_deg": 80.0},
    {"move": "return_", "angle_deg": 100.0, "law": "sine"},
    {"move": "dwell", "angle_deg": 40.0},
]
# outside 35, floor at 25; the roller's radius 5 is the margin at the ends
KEYS: dict[str, Any] = {
    "kind": "barrel_cam",
    "form": "groove",
    "outer_diameter": 70.0,
    "groove_depth": 10.0,
    "lift": 18.0,
    "roller_diameter": 10.0,
    "phases": RESTS,
}
HUB = {"diameter": 30.0, "above": 8.0, "below": 4.0}
END = {"form": "end", "web_thickness": 4.0}


def halves(made: PartDrawing) -> list[shapely.Polygon]:
    """What is hatched above the axis and below it."""
    found = []
    for loop in made.views[0].hatched:
        points = np.array([complex(c.start) for c in loop if isinstance(c, Line)])
        found.append(shapely.Polygon(np.column_stack([points.real, points.imag])))
    return found


def sizes(made: PartDrawing) -> dict[str, Size]:
    return {size.name: size for size in made.views[0].sizes}


def outline(*corners: complex) -> shapely.Polygon:
    return shapely.Polygon([(c.real, c.imag) for c in corners])


def same(one: shapely.Polygon, other: shapely.Polygon) -> bool:
    return bool(one.symmetric_difference(other).area < 1e-6)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("hub", [None, HUB])
def test_the_section_of_a_groove_has_its_two_walls(hub: dict[str, float] | None) -> None:
    """Margin 5, roller 10 and lift 18: 38 long; the groove from 5 to 15 at +x, from 23 to 33 at -x."""
    made = drawing_of(KEYS | {"bore_diameter": 12.0} | ({"hub": hub} if hub else {}))
    low, high, reach = (-4.0, 46.0, 15.0) if hub else (0.0, 38.0, 6.0)
    for way, polygon, start in zip((1, -1), halves(made), (5.0, 23.0), strict=True):
        ring = [complex(low, 6), complex(low, reach), complex(0, reach), 35j, complex(start, 35), complex(start, 25),
                complex(start + 10, 25), complex(start + 10, 35), 38 + 35j, complex(38, reach), complex(high, reach),
                complex(high, 6)]  # fmt: skip
        assert same(polygon, outline(*(p if way > 0 else p.conjugate() for p in ring)))
    told = sizes(made)
    ends = {name: (size.start, size.end, size.side, size.before) for name, size in told.items()}
    wanted = {
        "outer_diameter": (-35j, 35j, "left", "Ø"),
        "bore_diameter": (complex(high, -6), complex(high, 6), "right", "Ø"),
        "length": (-35j, 38 - 35j, "below", ""),
        "groove_depth": (5 + 25j, 38 + 35j, "right", ""),
    }
    if hub:
        wanted |= {
            "hub.diameter": (46 - 15j, 46 + 15j, "right", "Ø"),
            "hub.below": (-4 - 15j, -15j, "below", ""),
            "hub.above": (38 - 15j, 46 - 15j, "below", ""),
        }
    assert set(ends) == set(wanted)
    for name, (start, end, side, before) in wanted.items():
        assert ends[name][:2] == pytest.approx((start, end), abs=1e-9), name
        assert ends[name][2:] == (side, before)
    view = made.views[0]
    rough, bore = (note for note in view.notes if note.is_rough)
    assert abs(bore.at.imag) == pytest.approx(6.0)
    assert low <= bore.at.real <= high
    assert rough.at == pytest.approx(5 + 30j, abs=1e-9)
    (axis,) = view.axes
    assert (axis.start, axis.end) == (pytest.approx(low), pytest.approx(high))
    # the mouths of the bore behind the section, and no edge of the track
    upright = [c for name, c in view.strokes if name == VISIBLE and abs(c.start.real - c.end.real) < 1e-9]
    mouths = {round(c.start.real, 9) for c in upright if min(abs(c.start.imag), abs(c.end.imag)) < 1e-9}
    assert mouths == {low, high}


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("hub", "bore"), [(None, 12.0), (HUB, 12.0), ({"diameter": 30.0, "below": 4.0}, 12.0)])
def test_the_section_of_an_end_cam_ends_where_the_roller_rests(hub: dict[str, float] | None, bore: float) -> None:
    """The web's 4 and the margin's 5 above: told by its start height, which the closed form of the rest gives."""
    made = drawing_of(KEYS | END | {"bore_diameter": bore} | ({"hub": hub} if hub else {}))
    told = sizes(made)
    upper = told["start_height"].end.real
    # at +x the roller stands below: lower by all of the lift
    under, over, reach = (4.0, hub.get("above", 0.0), 15.0) if hub else (0.0, 0.0, bore / 2)
    for way, polygon, wall in zip((1, -1), halves(made), (upper - 18.0, upper), strict=True):
        ring = [
            complex(-under, 6),
            complex(-under, reach),
            complex(0, reach),
            35j,
            complex(wall, 35),
            complex(wall, 25),
            4 + 25j,
            complex(4, reach),
            complex(4 + over, reach),
            complex(4 + over, 6),
        ]
        assert same(polygon, outline(*(p if way > 0 else p.conjugate() for p in ring)))
    assert told["web"].end - told["web"].start == pytest.approx(4.0)
    assert told["web"].start == pytest.approx(-25j)
    assert (told["start_height"].start, told["start_height"].end.imag) == (-35j, -35.0)
    inner = told["inner_diameter"]
    assert (inner.start, inner.end, inner.side) == (
        pytest.approx(upper - 25j), pytest.approx(upper + 25j), "right",
    )  # fmt: skip
    if hub:
        diameter = told["hub.diameter"]
        at, side = (4 + over, "right") if over else (-4.0, "left")
        assert (diameter.start, diameter.end, diameter.side) == (
            pytest.approx(at - 15j), pytest.approx(at + 15j), side,
        )  # fmt: skip
        assert told["hub.below"].value == pytest.approx(4.0)
        assert ("hub.above" in told) == (over > 0)
        if over:
            assert (told["hub.above"].start, told["hub.above"].end) == (
                pytest.approx(4 - 15j), pytest.approx(12 - 15j),
            )  # fmt: skip


def test_a_ring_of_an_end_cam_without_a_web_is_open_below() -> None:
    made = drawing_of(KEYS | {"form": "end"})
    upper = sizes(made)["start_height"].end.real
    for way, polygon, wall in zip((1, -1), halves(made), (upper - 18.0, upper), strict=True):
        ring = [25j, 35j, complex(wall, 35), complex(wall, 25)]
        assert same(polygon, outline(*(p if way > 0 else p.conjugate() for p in ring)))
    assert set(sizes(made)) == {"outer_diameter", "inner_diameter", "start_height"}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("form", [{}, END])
def test_a_keyed_bore_has_a_view_of_its_own_between_section_and_development(form: dict[str, Any]) -> None:
    made = drawing_of(KEYS | form | {"bore": {"shape": "keyway", "diameter": 12.0, "angle_deg": 0.0}, "hub": HUB})
    assert len(made.views) == 3
    length, width = 2 * math.pi * 35, made.views[2].sizes[0]
    assert (width.name, width.side) == ("circumference", "below")
    assert width.value == pytest.approx(length, rel=1e-12)
    assert [size.name for size in made.views[2].sizes] == ["circumference"]
    # the key's way of 1.8 (DIN 6885) lies upwards
    above, under = halves(made)
    assert above.bounds[1] == pytest.approx(7.8, abs=1e-9)
    assert under.bounds[3] == pytest.approx(-6.0, abs=1e-9)


def test_the_development_tells_its_height_where_the_section_does_not() -> None:
    """A rest above that does not reach -x: the section's end there is lower than the end of the barrel."""
    early = [{"move": "rise", "angle_deg": 90.0, "law": "sine"}, {"move": "dwell", "angle_deg": 20.0},
             {"move": "return_", "angle_deg": 100.0, "law": "sine"}, {"move": "dwell", "angle_deg": 150.0}]  # fmt: skip
    made = drawing_of(KEYS | END | {"phases": early})
    around, height = made.views[-1].sizes
    assert (around.name, height.name, height.side) == ("circumference", "development.height", "left")
    assert height.value > sizes(made)["start_height"].value + 1
    assert height.start == around.start


def test_the_development_of_a_motion_that_runs_through_its_start_is_one_turn_long() -> None:
    """A measured motion: its walls end slanted, and both jackets together told 0.16 mm more than the circumference."""
    table = [[0.0, 0.0], [60.0, 6.0], [150.0, 12.0], [240.0, 3.0]]
    tabled = {key: value for key, value in KEYS.items() if key not in ("phases", "lift")} | {"motion_table": table}
    width = next(one for one in drawing_of(tabled).views[-1].sizes if one.name == "circumference")
    assert width.value == pytest.approx(2 * math.pi * 35, abs=1e-9)

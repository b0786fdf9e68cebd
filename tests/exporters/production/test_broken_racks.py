"""Long racks are drawn with a break: off the DXF, what is left, where it ends, what sizes over it say; GOST 2.305."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import ezdxf
import pytest

from tests.exporters.production.test_part_drawings import sizes, written
from tests.exporters.production.test_sheet_words import faults

LONG: dict[str, Any] = {"kind": "rack", "module": 2.0, "number_of_teeth": 120, "face_width": 20.0}
HOLES = {"count": 8, "diameter": 6.6, "spacing": 90.0}
# the keys, and all sizes of a rack of m = 2 by them: length, half a pitch, b, height, datum height, holes
CASES: dict[str, tuple[dict[str, Any], list[float]]] = {
    "plain": (LONG, [math.pi * 240, math.pi, 20.0, 9.5, 7.5]),
    "holes": (LONG | {"body_height": 20.0, "holes": HOLES},
              [math.pi * 240, math.pi, 20.0, 24.5, 22.5, 10.0, 90.0, 630.0, math.pi * 120 - 315.0, 6.6]),
    "two holes": (LONG | {"body_height": 20.0, "holes": HOLES | {"count": 2, "spacing": 700.0}},
                  [math.pi * 240, math.pi, 20.0, 24.5, 22.5, 10.0, 700.0, math.pi * 120 - 350.0, 6.6]),
    "helical": (LONG | {"helix_angle_deg": 20.0}, [*(x * math.pi / math.cos(math.radians(20.0)) for x in (240, 1)),
                                                   20.0, 9.5, 7.5]),
    "double": (LONG | {"helix_angle_deg": -20.0, "double_helical": True},
               [*(x * math.pi / math.cos(math.radians(20.0)) for x in (240, 1)), 20.0, 9.5, 7.5]),
    "tiny": (LONG | {"module": 0.1, "number_of_teeth": 500, "face_width": 1.0},
             [math.pi * 50, math.pi / 20, 1.0, 0.475, 0.375]),
    "more teeth": (LONG, [math.pi * 240, math.pi, 20.0, 9.5, 7.5]),
}  # fmt: skip


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", CASES)
def test_both_ends_of_a_long_rack_are_left_and_its_sizes_are_whole(tmp_path: Path, name: str) -> None:
    """It was a line 12 mm high across the sheet: 754 mm long, its teeth 4.5 mm."""
    part, wanted = CASES[name]
    teeth = 5 if name == "more teeth" else 0
    dxf, svg = written(tmp_path, part, drawing={"teeth": teeth})
    assert faults(svg) == []
    assert sorted(sizes(dxf).values()) == pytest.approx(sorted(wanted), abs=1e-6)
    document = ezdxf.readfile(dxf)
    space, scale = document.modelspace(), 1 / document.header["$DIMLFAC"]
    length = max(wanted)
    # that of the length stands between the corners as they are drawn, its number in words
    (size,) = (d for d in space.query("DIMENSION") if abs(d.dxf.actual_measurement - length) < 1e-6)
    left, right = sorted((size.dxf.defpoint2.x, size.dxf.defpoint3.x))
    assert right - left < 0.6 * scale * length
    assert f"{length:.3f}".rstrip("0") in size.dxf.text
    low = size.dxf.defpoint2.y
    lines = [(complex(e.dxf.start.x, e.dxf.start.y), complex(e.dxf.end.x, e.dxf.end.y))
             for e in space.query("LINE[layer=='OUTLINE']")]  # fmt: skip
    # the lower edge ends on two wavy lines, which stand as far apart all along
    edges = sorted((min(a.real, b.real), max(a.real, b.real)) for a, b in lines
                   if abs(a.imag - low) + abs(b.imag - low) < 1e-6 and left < (a + b).real / 2 < right)  # fmt: skip
    ends = [left, *(x for pair in edges for x in pair if left + 1e-6 < x < right - 1e-6), right]
    assert len(ends) == 4
    gap = ends[2] - ends[1]
    assert 0.0 < gap < 0.1 * (right - left)
    # two brackets stand beside the sign of roughness
    assert len(space.query("ARC[layer=='THIN']")) == 2 + 4 * (2 if "helix_angle_deg" in part else 1)
    # the waves go up from there without a break: two arcs each, which meet
    waves = [
        (complex(*arc.start_point.vec2), complex(*arc.end_point.vec2)) for arc in space.query("ARC[layer=='THIN']")
    ]
    for x in ends[1:3]:
        (begun,) = [b if abs(a - complex(x, low)) < 1e-5 else a for a, b in waves
                    if min(abs(a - complex(x, low)), abs(b - complex(x, low))) < 1e-5]  # fmt: skip
        (high,) = [a if abs(b - begun) < 1e-5 else b for a, b in waves
                   if min(abs(a - begun), abs(b - begun)) < 1e-5 and min(a.imag, b.imag) > low + 1e-3]  # fmt: skip
        assert (begun.real, high.real) == pytest.approx((x, x), abs=1e-5)
        assert high.imag - begun.imag == pytest.approx(begun.imag - low, abs=1e-5)
    # two holes at either end have the size between them, two alone are at an end each
    holes = [e for e in space.query("CIRCLE[layer=='OUTLINE']") if abs(e.dxf.radius - 3.3 * scale) < 1e-6]
    assert len(holes) == {"holes": 4, "two holes": 2}.get(name, 0)
    # flanks of the end teeth alone, or of three at either end
    tangent = math.tan(math.radians(20.0)) / (math.cos(math.radians(20.0)) if "helix_angle_deg" in part else 1.0)
    flanks = [a for a, b in lines if (way := b - a).imag and abs(abs(way.real / way.imag) - tangent) < 1e-5
              and low < a.imag < low + scale * max(wanted[3:5]) + 1e-6 and left < a.real < right]  # fmt: skip
    assert len(flanks) == (12 if teeth else 4)
    assert not any(ends[1] < a.real < ends[2] for a in flanks)


SHORT: list[dict[str, Any]] = [
    {"number_of_teeth": 20},
    {"body_height": 20.0, "holes": HOLES | {"count": 1}},
    {"body_height": 20.0, "holes": HOLES | {"count": 3}},
    {"face_width": 200.0, "helix_angle_deg": 45.0},
]


@pytest.mark.parametrize("more", SHORT)
def test_a_rack_whose_middle_tells_something_has_no_break(tmp_path: Path, more: dict[str, Any]) -> None:
    """A short one, one with holes in its middle, one whose teeth lean farther than would be left."""
    document = ezdxf.readfile(written(tmp_path, LONG | more, formats=("dxf",))[0])
    assert len(document.modelspace().query("ARC[layer=='THIN']")) == 2

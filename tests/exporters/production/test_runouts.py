"""Frames of runouts on working drawings, off the DXF: to what they point, which size has the mark of their datum."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path
from typing import Any

import ezdxf
import pytest

from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.scene.load import scene_from_dict
from tests.exporters.production.test_part_drawings import KEYED, PARTS, jobs, written
from tests.exporters.production.test_sheet_words import faults

RUNOUTS = {"tip_runout": 0.052, "face_runout": 0.021}
# what is measured about which size, by the keys: outer or inner diameter, the datum, where the face stands
CASES: dict[str, tuple[dict[str, Any], float, float, float]] = {
    # m (z + 2); keyway and hub, web, chamfers
    "gear": (PARTS["gear"] | {"bore": KEYED | {"diameter": 18.0}}, 84.0, 18.0, 20.0),
    # m z / cos(beta) + 2 m
    "helical": (PARTS["helical"], 50.0 / math.cos(math.radians(15.0)) + 4.0, 14.0, 18.0),
    "ring": (PARTS["ring"], 77.0, 112.0, 15.0),
    "worm wheel": (PARTS["wheel"], 136.0, 25.0, 30.0),
    "face gear": (PARTS["face"], 130.0, 25.0, 6.0),
    # a bore of 12, 1:1, has its arrows outside
    "small bore": (PARTS["helical"] | {"bore_diameter": 3.0}, 50.0 / math.cos(math.radians(15.0)) + 4.0, 3.0, 18.0),
    "hexagon": (PARTS["helical"] | {"bore": {"shape": "hexagon", "across_flats": 17.0}, "bore_diameter": 0.0},
                50.0 / math.cos(math.radians(15.0)) + 4.0, 17.0, 18.0),
    # GOST 1139: 6x23x28 is centred by its inner diameter unless told otherwise
    "spline": (PARTS["helical"] | {"bore": {"shape": "spline", "size": "6x23x28"}, "bore_diameter": 0.0},
               50.0 / math.cos(math.radians(15.0)) + 4.0, 23.0, 18.0),
    "tiny": ({"kind": "spur_gear", "module": 0.1, "number_of_teeth": 12, "face_width": 0.5, "bore_diameter": 0.3},
             1.4, 0.3, 0.5),
    "large": ({"kind": "spur_gear", "module": 25.0, "number_of_teeth": 60, "face_width": 200.0, "bore": KEYED | {
        "diameter": 100.0}}, 1550.0, 100.0, 200.0),
}  # fmt: skip

Ends = tuple[complex, complex]


class Read:
    """The lines of sizes, words and dimensions of a DXF, mm on paper."""

    def __init__(self, file: Path) -> None:
        document = ezdxf.readfile(file)
        space = document.modelspace()
        self.lines: list[Ends] = [
            (complex(e.dxf.start.x, e.dxf.start.y), complex(e.dxf.end.x, e.dxf.end.y))
            for e in space.query("LINE[layer=='DIMENSION']")
        ]
        self.words = [(t.dxf.text, complex(t.dxf.insert.x, t.dxf.insert.y)) for t in space.query("TEXT")]
        self.dimensions = []
        for one in space.query("DIMENSION"):
            value = one.dxf.actual_measurement
            scale = document.dimstyles.get(one.dxf.dimstyle).dxf.dimlfac
            points = [complex(p.x, p.y) for p in (one.dxf.defpoint2, one.dxf.defpoint3)]
            self.dimensions.append((value, scale, points, complex(one.dxf.defpoint.x, one.dxf.defpoint.y)))

    def sized(self, value: float) -> tuple[float, list[complex], complex]:
        """Scale, points and line of the dimension of a value."""
        return next(rest for size, *rest in self.dimensions if abs(size - value) < 1e-6)

    def frame(self, word: str) -> tuple[list[float], float, str]:
        """The upright lines of the frame about a word, where it is low, and the letter in its last cell."""
        ((_, at),) = [one for one in self.words if one[0] == word]
        upright = [(a, b) for a, b in self.lines if abs(a.real - b.real) < 1e-6 and abs(abs(a - b) - 7.0) < 1e-6]
        low = next(y for a, b in upright if 0.0 < at.imag - (y := min(a.imag, b.imag)) < 3.5)
        xs = sorted({round(a.real, 6) for a, b in upright if abs(min(a.imag, b.imag) - low) < 1e-6
                     and abs(a.real - at.real) < 25.0})  # fmt: skip
        first = max(k for k, x in enumerate(xs) if x < at.real) - 1
        edges = xs[first : first + 4]
        (letter,) = [t for t, p in self.words if edges[2] < p.real < edges[3] and low < p.imag < low + 7.0]
        return edges, low, letter

    def tip(self, edges: list[float], low: float) -> complex:
        """Where the leader of a frame ends: its shelf begins in the middle of a side."""
        ends = [complex(x, low + 3.5) for x in (edges[0], edges[-1])]
        pairs = [pair for line in self.lines for pair in (line, line[::-1])]
        (elbow,) = [b for a, b in pairs if min(abs(a - end) for end in ends) < 1e-5
                    and not edges[0] - 1e-5 < b.real < edges[-1] + 1e-5]  # fmt: skip
        far = [b for a, b in pairs if abs(a - elbow) < 1e-6 and min(abs(b - end) for end in ends) > 1e-5]
        return far[0]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("language", ["en", "uk"])
@pytest.mark.parametrize("name", CASES)
def test_frames_point_at_what_runs_and_name_the_size_that_has_the_mark(
    tmp_path: Path, name: str, language: str
) -> None:
    """GOST 2.308: leaders end straight on the tip line and on the face, the triangle on the line of its size."""
    part, tip, bore, width = CASES[name]
    dxf, svg = written(tmp_path, part, language, drawing=RUNOUTS)
    assert faults(svg) == []
    sheet, mark = Read(dxf), "," if language == "uk" else "."
    letters = []
    scale, ends, beside = sheet.sized(tip)
    axis, left = (ends[0] + ends[1]).imag / 2, sheet.sized(width)[1]
    for word, inner in ((f"0{mark}052", True), (f"0{mark}021", False)):
        edges, low, letter = sheet.frame(word)
        letters.append(letter)
        at = sheet.tip(edges, low)
        if inner and name == "ring":
            # within the ring, before the line of its inner diameter
            assert edges[-1] < beside.real
        if not inner and name == "face gear":
            # before that of the inner diameter of its teeth, which spans the face
            assert edges[-1] < sheet.sized(122.0)[2].real
        if inner:
            assert scale * abs(at.imag - axis) == pytest.approx(tip / 2, abs=1e-5)
            assert min(p.real for p in left) < at.real < max(p.real for p in left)
        else:
            assert at.real == pytest.approx(max(p.real for p in left), abs=1e-6)
            assert bore / 2 < scale * abs(at.imag - axis) < tip / 2 or name == "ring"
    (letter,) = set(letters)
    # the view of a bore that is not round has the first
    assert letter == ("АБ" if language == "uk" else "AB")[name in ("gear", "hexagon", "spline", "large")]
    # seventeen lines from the tip of a triangle as high as letters to its base, which is the extension line
    apexes = Counter(complex(round(p.real, 5), round(p.imag, 5)) for line in sheet.lines for p in line)
    apex, count = apexes.most_common(1)[0]
    assert count == 17 + 1
    fan = [b if abs(a - apex) < 1e-4 else a for a, b in sheet.lines if min(abs(a - apex), abs(b - apex)) < 1e-4]
    base = [p for p in fan if abs(abs(p - apex) - 3.5) < 0.6]
    foot = sum(base) / len(base)
    _, points, line = sheet.sized(bore)
    upright = abs(points[0].imag - points[1].imag) > abs(points[0].real - points[1].real)
    wanted = [complex(line.real, p.imag) if upright else complex(p.real, line.imag) for p in points]
    assert min(abs(foot - p) for p in wanted) < 1e-5
    assert abs(abs(foot - apex) - 3.5) < 1e-5
    # and the letter stands in a square beyond it
    way = (apex - foot) / 3.5
    middle = foot + way * (3.5 + 2.5 + 3.5)
    assert any(t == letter and abs(p + complex(1.2, 1.75) - middle) < 1.0 for t, p in sheet.words)


@pytest.mark.heavy
def test_a_bevel_gear_has_them_at_its_tip_cone_and_back_face(tmp_path: Path) -> None:
    """The leader to the cone is square to it: tan(delta_a) as its table has it."""
    dxf, svg = written(tmp_path, PARTS["bevel"], drawing=RUNOUTS)
    assert faults(svg) == []
    sheet = Read(dxf)
    edges, low, _ = sheet.frame("0.021")
    back = sheet.sized(12.0)[1]
    # between the face and the lines of the sizes beside it
    assert edges[0] > max(line.real for _, _, points, line in sheet.dimensions
                          if line.real < min(p.real for p in back) and points[0].real == points[1].real)  # fmt: skip
    assert sheet.tip(edges, low).real == pytest.approx(min(p.real for p in back), abs=1e-6)
    edges, low, _ = sheet.frame("0.052")
    at = sheet.tip(edges, low)
    leader = next(b - a for line in sheet.lines for a, b in (line, line[::-1])
                  if abs(a - at) < 1e-6 and abs(b - a) > 4.0)  # fmt: skip
    # equal depth of tip clearance: delta_a = delta + theta_f of the mate; x = 0.3, h_f = 1.2 m + x of the mate's
    delta, outer = math.atan(20 / 40), math.hypot(60.0, 120.0) / 2
    assert math.degrees(math.atan2(abs(leader.real), abs(leader.imag))) == pytest.approx(
        math.degrees(delta + math.atan((1.2 + 0.3) * 3.0 / outer)), abs=0.05
    )


@pytest.mark.parametrize(("name", "key"), [("rack", "tip_runout"), ("shaft", "face_runout"), ("cam", "tip_runout")])
def test_a_runout_that_nothing_drawn_has_is_refused_by_its_key(name: str, key: str) -> None:
    with pytest.raises(SceneError) as caught:
        jobs(PARTS[name], drawing={key: 0.05})
    assert caught.value.key == f"exports[1].drawing.{key}"
    with pytest.raises(SceneError):
        jobs(PARTS["gear"], drawing={key: 0.0})


def test_a_part_built_alone_keeps_what_the_scene_wishes_for_others() -> None:
    """A frame that a gear of the scene has is no fault of its rack, which the command asks for alone."""
    parts = {"gear": PARTS["gear"], "rack": PARTS["rack"]}
    export = {"format": "svg", "purpose": "part", "drawing": {"tip_runout": 0.05}}
    scene = scene_from_dict({"parts": parts, "exports": [export]}, "s", "s")
    for only in (["rack"], ["gear"], []):
        assert [job.path for job in plan_build(scene, "s", only, []).files] == [
            f"{name}.part.svg" for name in only or parts
        ]


def test_a_tolerance_stands_as_it_is_given_and_is_not_rounded_up(tmp_path: Path) -> None:
    dxf, _ = written(tmp_path, PARTS["helical"], drawing={"tip_runout": 0.0125, "face_runout": 0.0004})
    assert {"0.0125", "0.0004"} <= {text for text, _ in Read(dxf).words}


@pytest.mark.heavy
def test_smaller_sizes_stand_nearer_where_one_had_to_be_placed_before_them(tmp_path: Path) -> None:
    """GOST 2.307: the mark of the datum stood in the way of the mounting distance, which then took the first row."""
    gear = PARTS["bevel"] | {"module": 10.0, "number_of_teeth": 90, "mate_number_of_teeth": 18, "face_width": 120.0,
                             "profile_shift_coefficient": 0.0, "hub_diameter": 260.0, "hub_length": 80.0,
                             "bore": {"shape": "round", "diameter": 150.0}}  # fmt: skip
    (dxf,) = written(tmp_path, gear, formats=("dxf",), drawing=RUNOUTS)
    dimensions = Read(dxf).dimensions
    low = min(p.imag for _, _, points, _ in dimensions for p in points)
    below = sorted((value, line.imag) for value, _, points, line in dimensions
                   if points[0].imag == points[1].imag and line.imag < low)  # fmt: skip
    assert len(below) == 4
    assert [y for _, y in below] == sorted((y for _, y in below), reverse=True)

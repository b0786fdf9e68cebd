"""Working drawings of parts: dimensions off the files, what depends on what, words clear of lines, refusals by key."""

from __future__ import annotations

import math
import re
import subprocess
import sys
import tempfile
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import mpmath
import numpy as np
import pytest
import shapely
from ezdxf.math import Vec3
from ezdxf.path import make_path

from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.drawing import canvas
from parts.scene.load import scene_from_dict
from tests.exporters.production.test_sheet_words import faults

KEYED = {"shape": "keyway", "diameter": 20.0}
PARTS: dict[str, dict[str, Any]] = {
    "gear": {
        "kind": "spur_gear", "module": 2.0, "number_of_teeth": 40, "face_width": 20.0, "face_chamfer": 1.0,
        "web": {"thickness": 8.0, "rim_diameter": 64.0}, "hub": {"diameter": 34.0, "above": 5.0}, "bore": KEYED,
        "holes": {"count": 4, "diameter": 9.0, "pitch_circle_diameter": 49.0},
    },
    "helical": {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 25, "face_width": 18.0, "helix_angle_deg": 15.0,
                "bore_diameter": 14.0},
    "ring": {"kind": "ring_gear", "module": 2.0, "number_of_teeth": 40, "face_width": 15.0, "outer_diameter": 112.0,
             "tip_diameter": 77.0, "holes": {"count": 6, "diameter": 5.0, "pitch_circle_diameter": 100.0}},
    "rack": {"kind": "rack", "module": 2.0, "number_of_teeth": 15, "face_width": 15.0, "body_height": 12.0},
    "cam": {
        "kind": "cam", "follower": "roller", "follower_radius": 8.0, "base_circle_radius": 40.0, "lift": 20.0,
        "phases": [{"move": "rise", "angle_deg": 180.0, "law": "sine"},
                   {"move": "return_", "angle_deg": 180.0, "law": "sine"}],
        "bore": {"shape": "hexagon", "across_flats": 12.0}, "hub": {"diameter": 30.0, "above": 8.0},
    },
    "worm": {"kind": "worm", "module": 4.0, "thread_length": 50.0, "bore_diameter": 8.0,
             "shaft_above": [{"diameter": 25.0, "length": 20.0, "chamfer": 1.0}]},
    "wheel": {"kind": "worm_wheel", "module": 4.0, "number_of_teeth": 30, "face_width": 30.0, "outer_diameter": 136.0,
              "bore_diameter": 25.0},
    "bevel": {"kind": "bevel_gear", "module": 3.0, "number_of_teeth": 20, "mate_number_of_teeth": 40,
     "hub_diameter": 34.0,
              "profile_shift_coefficient": 0.3, "hub_length": 12.0, "bore": {"shape": "keyway", "diameter": 16.0}},
    "face": {"kind": "face_gear", "module": 2.0, "number_of_teeth": 60, "pinion_number_of_teeth": 20,
     "inner_diameter": 122.0,
             "outer_diameter": 130.0, "plate_thickness": 6.0, "bore_diameter": 25.0,
             "hub": {"diameter": 40.0, "below": 8.0, "above": 4.0},
             "holes": {"count": 6, "diameter": 12.0, "pitch_circle_diameter": 80.0}},
    "bearing": {"kind": "turned", "points": [
        {"r": 20.0, "z": 0.0}, {"r": 31.0, "z": 0.0, "chamfer": 1.0}, {"r": 31.0, "z": 16.0}, {"r": 20.0, "z": 16.0},
        {"r": 20.0, "z": 11.0, "arc": -3.5}, {"r": 20.0, "z": 5.0}]},
    "shaft": {"kind": "shaft", "centre_holes": {"diameter": 2.0}, "steps": [
        {"diameter": 20.0, "length": 30.0, "chamfer": 1.0, "keyways": [{"at": 5.0, "length": 20.0}]},
        {"diameter": 30.0, "length": 40.0}]},
    "plate": {"kind": "plate", "width": 120.0, "height": 80.0, "corner_radius": 8.0, "face_width": 5.0, "holes": [
        {"at": [-45.0, -25.0], "diameter": 6.0}, {"at": [45.0, -25.0], "diameter": 6.0},
        {"at": [0.0, 10.0], "diameter": 20.0}]},
}  # fmt: skip
PARTS["groove"] = {key: value for key, value in PARTS["cam"].items() if key not in ("hub", "follower")} | {
    "kind": "groove_cam", "face_width": 12.0, "groove_depth": 6.0, "outer_diameter": 160.0,
}  # fmt: skip
PARTS["oval"] = {"kind": "noncircular_gear", "centrode": "oval", "axis_ratio": 1.2, "number_of_teeth": 18,
                 "module": 2.0, "bore_diameter": 10.0}  # fmt: skip
PARTS["disc"] = {
    "kind": "cycloidal_disc", "number_of_lobes": 6, "pin_circle_diameter": 100.0, "pin_diameter": 10.0,
    "eccentricity": 3.0, "bore_diameter": 20.0, "face_width": 8.0,
    "output_holes": {"count": 6, "pin_diameter": 6.0, "pitch_circle_diameter": 56.0},
}  # fmt: skip
PARTS["clock"] = {"kind": "cycloidal_gear", "module": 2.0, "number_of_teeth": 30, "mate_number_of_teeth": 8,
 "bore_diameter": 8.0,
                  "face_width": 5.0}  # fmt: skip
PARTS["geneva"] = {"kind": "geneva_wheel", "number_of_slots": 4, "centre_distance": 80.0, "pin_diameter": 8.0,
                   "slot_clearance": 0.5, "locking_diameter": 84.0, "locking_clearance": 0.5, "end_clearance": 1.0,
                   "bore_diameter": 10.0}  # fmt: skip
PARTS["geneva ring"] = {key: value for key, value in PARTS["geneva"].items() if key != "bore_diameter"} | {
    "internal": True, "tip_rounding": 1.0, "outer_diameter": 320.0,
}  # fmt: skip
PARTS["ratchet"] = {"kind": "ratchet_wheel", "module": 5.0, "number_of_teeth": 16, "bore_diameter": 10.0,
                    "face_width": 8.0}  # fmt: skip
PARTS["ratchet ring"] = {"kind": "ratchet_wheel", "module": 5.0, "number_of_teeth": 24, "internal": True,
                         "tip_land": 6.0, "turns": "cw", "outer_diameter": 150.0}  # fmt: skip
PARTS["key"] = {"kind": "key", "shaft_diameter": 30.0, "length": 32.0}
PARTS["sprocket"] = {"kind": "sprocket", "chain": "08B-2", "number_of_teeth": 12, "bore_diameter": 14.0,
                     "hub": {"diameter": 30.0, "above": 8.0}}  # fmt: skip
PARTS["pulley"] = {"kind": "timing_pulley", "belt": "T5", "number_of_teeth": 18, "bore_diameter": 8.0,
                   "flanges": {"diameter": 34.0, "thickness": 1.5},
                   "hub": {"diameter": 20.0, "above": 6.0}}  # fmt: skip
PARTS |= {
    "pin": {"kind": "pin", "diameter": 8.0, "length": 60.0},
    "eccentric": {"kind": "eccentric", "diameter": 32.0, "eccentricity": 4.0, "bore_diameter": 10.0},
    "lantern": {"kind": "lantern_wheel", "number_of_pins": 12, "pin_circle_diameter": 80.0, "pin_diameter": 8.0,
                "bore_diameter": 15.0},
    "pin ring": {"kind": "pin_ring", "number_of_pins": 12, "pin_circle_diameter": 80.0, "pin_diameter": 8.0},
    "wide ring": {"kind": "pin_ring", "number_of_pins": 12, "pin_circle_diameter": 80.0, "pin_diameter": 8.0,
                  "inner_diameter": 83.0},
    "barrel": {"kind": "barrel_cam", "form": "groove", "outer_diameter": 70.0, "groove_depth": 8.0, "lift": 18.0,
               "roller_diameter": 10.0, "bore_diameter": 12.0, "phases": PARTS["cam"]["phases"]},
}  # fmt: skip

# steps beside the thread as thick as its root: no corner stands where it ends
PARTS["worm on its root"] = {"kind": "worm", "module": 4.0, "thread_length": 50.0, "shaft_below": [
    {"diameter": 30.4, "length": 6.0}], "shaft_above": [{"diameter": 30.4, "length": 8.0}]}  # fmt: skip
PARTS["box"] = {"kind": "layered", "layers": [
    {"thickness": 4.0, "polygons": [{"points": [[-30, -20], [30, -20], [30, 20], [-30, 20]], "corner_radius": 5.0}],
     "circles": [{"diameter": 4.0, "at": [-24.0, -14.0]}, {"diameter": 4.0, "at": [24.0, 14.0]}]},
    {"thickness": 8.0, "circles": [{"diameter": 30.0}, {"diameter": 20.0}]}]}  # fmt: skip
# steps that are nothing on paper beside 900 mm; a groove, of whose place the surface alone is enlarged
PARTS["thin"] = {"kind": "shaft", "steps": [
    {"diameter": 3.0, "length": 900.0}, {"diameter": 5.0, "length": 2.0},
    {"diameter": 4.9, "length": 0.5, "fillet": 0.05}, {"diameter": 3.0, "length": 30.0}]}  # fmt: skip
PARTS["long"] = {"kind": "shaft", "steps": [
    {"diameter": 30.0, "length": 500.0, "grooves": [{"at": 200.0, "width": 1.3, "diameter": 28.6}]}]}  # fmt: skip
PARTS["carrier"] = {"kind": "carrier_plate", "number_of_pins": 3, "pin_circle_diameter": 80.0, "pin_diameter": 6.0,
                    "boss_diameter": 15.0, "hub_diameter": 40.0, "bore_diameter": 10.0}  # fmt: skip


def oval_axis(teeth: int, module: float, ratio: float) -> float:
    """The long half-axis of an oval that is so many pitches long, by mpmath."""

    def arc(angle: Any) -> Any:
        low = 2 * ratio / (1 + ratio - (ratio - 1) * mpmath.cos(2 * angle))
        slope = -low * 2 * (ratio - 1) * mpmath.sin(2 * angle) / (1 + ratio - (ratio - 1) * mpmath.cos(2 * angle))
        return mpmath.sqrt(low**2 + slope**2)

    return float(ratio * mpmath.pi * module * teeth / (4 * mpmath.quad(arc, [0, mpmath.pi / 2])))


def bevel_sizes() -> list[float]:
    """Of m 3, z 20 / 40, x 0.3, by GOST 19624: three tenths of R_e wide."""
    d = math.atan(0.5)
    radius, high, deep = 30.0, 3.9, 2.7
    cone, share = radius / math.sin(d), 0.7
    root = radius - deep * math.cos(d)
    # the rim is half as thick as the hub leaves room, a hundredth of a module aside
    rim = (root - 0.03 - 17.0) / math.cos(d) / 2
    mounted = cone * math.cos(d) + deep * math.sin(d) + rim * math.sin(d) + 12.0
    tip, above = radius + high * math.cos(d), cone * math.cos(d) - high * math.sin(d)
    front = cone * math.cos(d) + deep * math.sin(d)
    keyway = [16.0, 18.3, 5.0, 0.25]
    # GOST 2.405: the face width and the angles of tips and back cone tell all else
    return [2 * tip, (1 - share) * cone, 34.0, 12.0, mounted, mounted - above, mounted - share * front, *keyway]


# what each drawing must measure, mm: typed sizes, those of the standards (d_a = m (z + 2 x + 2), DIN 6885, GOST 19650)
SIZES: dict[str, list[float]] = {
    "gear": [84, 20, 25, 64, 49, 34, 8, 6, 1, 20, 22.8, 6, 0.25, 9],
    "helical": [50 / math.cos(math.radians(15)) + 4, 14, 18],
    "ring": [112, 77, 15, 100, 5],
    "rack": [15 * 2 * math.pi, math.pi, 15, 12 + 2.5 + 2, 12 + 2.5],
    "cam": [80, 10, 18, 30, 12],
    "worm": [48, 25, 8, 50, 70, 1],
    "worm on its root": [48, 30.4, 6, 50, 64],
    "wheel": [136, 128, 25, 30, 15, 16],
    "bevel": bevel_sizes(),
    # 1 and 1.25 modules about the pitch plane, m z1 / 2 below the pinion's axis
    "face": [130, 122, 25, 6, 10.5, 28.5, 40, 8, 18, 80, 12],
    "bearing": [62, 40, 16, 1, 3.5, 5, 6],
    # the cone of a centre hole opens to 2.12 d at 60 degrees, its tip is that of a drill of 120 degrees
    "shaft": [20, 30, 30, 70, 1, 20, 5, 6, 16.5, 2, 4.24, *(np.cumsum([1.12 * math.sqrt(3), 2, 1 / math.sqrt(3)]))],
    "groove": [160, 12, 6, 12],
    # l, b and the radius of both ends
    "key": [32, 8, 4],
    # a centrode as long as its pitches, of a/b = 1.2: r = 2 a b / (a + b - (a - b) cos 2 phi)
    "oval": [10, 10, 2 * (oval_axis(18, 2.0, 1.2) + 2.0), 2 * (oval_axis(18, 2.0, 1.2) / 1.2 - 2.5)],
    # R - r + e and R - r - e; holes of pin + 2 e
    "disc": [8, 20, 56, 12, 96, 84],
    # m z, and a module and a quarter more
    "clock": [5, 8, 64],
    # a slot's walls begin where the pin enters, at a cos(pi / n); it ends beyond pin and gap at a -+ r
    "geneva": [
        10,
        10,
        2 * math.hypot(80 * math.cos(math.pi / 4), 4.25),
        8.5,
        80 * (1 - math.sin(math.pi / 4)) - 5,
        42.5,
    ],
    "geneva ring": [
        10,
        320,
        2 * (math.hypot(80 * math.cos(math.pi / 4), 5.25) - 1),
        8.5,
        80 * (1 + math.sin(math.pi / 4)) + 5,
        42.5,
        1,
    ],
    # m z, a depth of 0.75 m, height of a land of m over its edge, a tenth of m
    "ratchet": [8, 10, 80, 72.5, 40 * math.sin(5 / 40), 0.5],
    "ratchet ring": [10, 150, 120, 127.5, 60 * math.sin(6 / 60), 0.5],
    # ISO 606: d + p (1.125 - 0.8/z) - d1, b_f = 0.91 b1, p_t, p cot(180 deg / z) - 1.04 h2 - 0.76
    "sprocket": [
        14,
        30,
        12.7 / math.sin(math.pi / 12) + 12.7 * (1.125 - 0.8 / 12) - 8.51,
        0.91 * 7.75,
        13.92,
        13.92 + 0.91 * 7.75,
        21.92 + 0.91 * 7.75,
        12.7 / math.tan(math.pi / 12) - 1.04 * 11.81 - 0.76,
    ],
    # p z / pi less 0.85; teeth of 10 between flanges of 1.5, hub and bore
    "pulley": [8, 20, 90 / math.pi - 0.85, 10, 13, 19, 34],
    "plate": [120, 80, 8, 15, 105, 60, 15, 50, 6, 20],
    "pin": [8, 60],
    "eccentric": [10, 10, 4, 32],
    # plates of 3, pins of 10 between them; two pins of rim
    "lantern": [96, 80, 15, 3, 10, 16, 8],
    "pin ring": [104, 80, 10, 4],
    "wide ring": [104, 83, 80, 10, 4],
    # lift, roller and half a roller at each end
    "barrel": [70, 12, 38, 8, 70 * math.pi],
    # what stands alike on both sides of an axis from side to side
    "box": [4, 12, 60, 48, 40, 28, 5, 4, 30, 20],
    # those within the detail from its last place, which the view tells
    "thin": [932.5, 902.5, 2.5, 0.5, 3, 5, 4.9, 0.05],
    "long": [500, 200, 1.3, 30, 28.6],
    # no place of a pin: they stand on their circle
    "carrier": [80, 6, 7.5, 20, 10],
}


# every tooth, lobe or wall of these is a spline of its own
SLOW = ("oval", "disc", "groove")


def jobs(part: dict[str, Any], language: str = "en", formats: tuple[str, ...] = ("dxf", "svg"), **export: Any) -> Any:
    # rough curves: dimensions and words do not hang on them
    exports = [{"format": name, "purpose": "part", "tolerance": 1e-3} | export for name in formats]
    raw = {"scene": {"language": language}, "parts": {"p": part | {"material": "steel"}}, "exports": exports}
    return plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets


# of a dimension between two lines, by the DXF reference
ANGULAR = 2


def sizes(file: Path) -> dict[str, float]:
    """Every size of a DXF by the number of its kind of words, by ezdxf at the scale of its style; no angles."""
    document = ezdxf.readfile(file)
    found: dict[str, float] = {}
    for entity in document.modelspace().query("DIMENSION"):
        if entity.dimtype == ANGULAR:
            continue
        value = float(entity.get_measurement()) * document.dimstyles.get(entity.dxf.dimstyle).dxf.dimlfac
        assert value == pytest.approx(entity.dxf.actual_measurement, abs=1e-6)
        # FreeCAD takes the distance of both points, whatever the direction, and 0 where there are none
        aligned = entity.dxf.defpoint2.distance(entity.dxf.defpoint3)
        assert aligned * document.dimstyles.get(entity.dxf.dimstyle).dxf.dimlfac == pytest.approx(value, abs=3e-6)
        said = [text.dxf.text for text in document.blocks.get(entity.dxf.geometry).query("TEXT")]
        # views of a scale of their own have the number in words: LibreCAD knows the scale of the sheet alone
        before, sign, after = entity.dxf.text.replace("%%c", "Ø").partition("<>")
        assert (sign == "<>") == (
            document.header["$DIMLFAC"] == document.dimstyles.get(entity.dxf.dimstyle).dxf.dimlfac
        )
        # the font of dimensions in LibreCAD has no minus
        number = "".join(said).replace(" ", "").replace("\N{MINUS SIGN}", "-")
        if sign:
            shown = float(
                number.removeprefix(before.replace(" ", "")).removesuffix(after.replace(" ", "")).replace(",", ".")
            )
            assert shown == pytest.approx(value, abs=6e-4)
        else:
            assert number == before.replace(" ", "")
        kind = entity.dxf.text if sign else re.sub(r"\d+([.,]\d+)?", "<>", entity.dxf.text, count=1)
        found[f"{kind} {sum(key.startswith(kind + ' ') for key in found)}"] = value
    return found


def written(folder: Path, part: dict[str, Any], language: str = "en", **export: Any) -> list[Path]:
    """The files of a part's drawing, DXF and SVG where nothing else is asked, each found good by its own check."""
    files = []
    for job in jobs(part, language, **export):
        job.write({}, folder / job.path)
        assert job.verify(folder / job.path, 0.0).failures == ()
        # the rounding of the file's numbers stands within the tolerance that was asked for
        assert job.declared({})[0] <= job.export.tolerance
        files.append(folder / job.path)
    return files


def drawn(folder: Path, part: dict[str, Any], **export: Any) -> Path:
    """The DXF alone."""
    return written(folder, part, formats=("dxf",), **export)[0]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("export", [{}, {"paper": "A1"}, {"drawing": {"teeth": 3, "requirements": ["HRC 40 " * 30]}}])
@pytest.mark.parametrize("language", ["en", "uk"])
@pytest.mark.parametrize("name", [pytest.param(n, marks=pytest.mark.heavy) if n in SLOW else n for n in PARTS])
def test_every_dimension_measures_the_model_and_no_word_stands_over_a_line(
    tmp_path: Path, name: str, language: str, export: dict[str, Any]
) -> None:
    dxf, svg = written(tmp_path, PARTS[name], language, **export)
    assert faults(svg) == []
    assert sorted(sizes(dxf).values()) == pytest.approx(sorted(SIZES[name]), abs=1e-6)
    audit = ezdxf.readfile(dxf).audit()
    assert not audit.errors
    assert not audit.fixes


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["sprocket", "pulley", "clock"])
def test_teeth_of_round_wheels_are_not_cut_and_their_pitch_circle_is_an_axis(tmp_path: Path, name: str) -> None:
    """GOST 2.402: both were hatched to where the face ends, and all circles one thin line."""
    file = drawn(tmp_path, {key: value for key, value in PARTS[name].items() if key != "flanges"}, tolerance=1e-2)
    document = ezdxf.readfile(file)
    space, scale = document.modelspace(), 1 / document.header["$DIMLFAC"]
    # z p / pi and p / sin(180 deg / z), m z; below them the roots
    pitch, root = {
        "sprocket": (12.7 / math.sin(math.pi / 12), 12.7 / math.sin(math.pi / 12) - 8.51),
        # makers' tables: 2a = 0.85 of T5, an outer diameter of 27.80 with 18 teeth, and grooves 1.25 deep
        "pulley": (90 / math.pi, 90 / math.pi - 0.85 - 2 * 1.25),
        "clock": (60.0, 55.0),
    }[name]
    circles = {round(c.dxf.radius, 5): c.dxf for c in space.query("CIRCLE[layer=='CENTRE']")}
    axis = circles[round(pitch / 2 * scale, 5)].center.y
    heights = [abs(p.y - axis) for line in space.query("LINE[layer=='HATCH']") for p in (line.dxf.start, line.dxf.end)]
    assert max(heights) == pytest.approx(root / 2 * scale, abs=1e-6)


def words(file: Path) -> set[str]:
    """All words of a sheet that are no dimension's."""
    return {text.dxf.text for text in ezdxf.readfile(file).modelspace().query("TEXT")}


def shaft_keys(*angles: float, **other: Any) -> dict[str, Any]:
    """A shaft with a keyway of its own in the first step, others in the second."""
    ways = [{"at": 4.0, "length": 14.0, "angle_deg": angle} for angle in angles]
    steps = [{"diameter": 20.0, "length": 30.0, "keyways": [{"at": 4.0, "length": 12.0}]},
             {"diameter": 28.0, "length": 25.0, "keyways": ways}]  # fmt: skip
    return {"kind": "shaft", "steps": steps, **other}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("bore", [0.0, 9.0])
@pytest.mark.parametrize("angles", [(90.0,), (0.0,), (60.0,), (90.0, -90.0), (0.0, 135.0)])
def test_keyways_stand_in_their_directions_with_marks_of_their_sections(
    tmp_path: Path, angles: tuple[float, ...], bore: float
) -> None:
    job = jobs(shaft_keys(*angles, bore_diameter=bore), formats=("dxf",))[0]
    job.write({}, tmp_path / job.path)
    assert job.verify(tmp_path / job.path, 0.0).failures == ()
    space = ezdxf.readfile(tmp_path / job.path).modelspace()
    texts = [text.dxf.text for text in space.query("TEXT")]
    assert (texts.count("A"), texts.count("B")) == (2, 2)
    # each keyway has its own width and depth
    assert sum("N9" in key for key in sizes(tmp_path / job.path)) == 1 + len(angles)
    # the first looks at the reader, or stands in the section along the axis; others as they are
    assert bool(space.query("*[layer=='HIDDEN']")) == any((angle % 180 if bore else angle) != 90 for angle in angles)
    assert any(text.endswith("°") for text in texts) == any(angle % 90 for angle in angles)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("angle", [90.0, 30.0, 270.0])
def test_the_section_of_a_cam_stands_in_projection_with_its_face(tmp_path: Path, angle: float) -> None:
    bore = {"shape": "keyway", "diameter": 18.0, "standard": "GOST 23360", "angle_deg": angle}
    job = jobs(PARTS["cam"] | {"bore": bore}, formats=("dxf",), tolerance=1e-3)[0]
    job.write({}, tmp_path / job.path)
    space = ezdxf.readfile(tmp_path / job.path).modelspace()
    paths = [[complex(p.x, p.y) for p in make_path(e).flattening(1e-4)] for e in space.query("*[layer=='OUTLINE']")]
    # both ends of the axis of the face that is upright, the longest one
    upright = [e.dxf for e in space.query("LINE[layer=='CENTRE']") if e.dxf.start.x == e.dxf.end.x]
    middle = max(upright, key=lambda e: abs(e.end.y - e.start.y)).start.x
    face = sorted(
        a.imag + (b.imag - a.imag) * (middle - a.real) / (b.real - a.real)
        for path in paths for a, b in pairwise(path) if (a.real < middle) != (b.real < middle)
    )  # fmt: skip
    edges = {round(p.imag, 6) for path in paths for p in path if len(path) == 2 and p.real > middle + 55.0}
    assert len(face) == 6
    assert all(min(abs(y - edge) for edge in edges) < 1e-2 for y in face)
    signs = [a for a in space.query("ARC[layer=='DIMENSION']") if abs(a.dxf.radius - 2.5) < 1e-6]
    assert len(signs) == (angle != 90.0)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["geneva", "oval", "cam"])
def test_what_stands_behind_the_section_of_a_wheel_that_is_not_round_is_seen_in_it(tmp_path: Path, name: str) -> None:
    """GOST 2.305: the right half of the face in projection; sections ended at their plane, axes before the outline."""
    phases = [
        {"move": "rise", "angle_deg": 100.0, "law": "sine"},
        {"move": "return_", "angle_deg": 260.0, "law": "sine"},
    ]
    part = PARTS[name] | ({"phases": phases, "bore": {"shape": "round", "diameter": 9.0}} if name == "cam" else {})
    space = ezdxf.readfile(drawn(tmp_path, part, tolerance=1e-4)).modelspace()
    paths = [[complex(p.x, p.y) for p in make_path(e).flattening(1e-4)] for e in space.query("*[layer=='OUTLINE']")]
    axes = [e.dxf for e in space.query("LINE[layer=='CENTRE']")]
    upright = max((e for e in axes if e.start.x == e.end.x), key=lambda e: abs(e.end.y - e.start.y))
    lying = max((e for e in axes if e.start.y == e.end.y), key=lambda e: abs(e.end.x - e.start.x))
    middle, right = upright.start.x, max(lying.start.x, lying.end.x)
    # but for the marks of the section, which stand over the axis
    paths = [path for path in paths if any(abs(p.real - middle) > 1e-6 for p in path)]
    face, section = ([p for path in paths for p in path if (p.real < right) == way] for way in (True, False))
    behind = [p.imag for p in face if p.real >= middle]
    assert max(p.imag for p in section) == pytest.approx(max(behind), abs=1e-3)
    assert min(p.imag for p in section) == pytest.approx(min(behind), abs=1e-3)
    hatched = [at.y for e in space.query("LINE[layer=='HATCH']") for at in (e.dxf.start, e.dxf.end)]
    assert max(behind) - min(behind) > max(hatched) - min(hatched) + 0.2
    assert min(upright.start.y, upright.end.y) < min(p.imag for p in face)
    assert max(upright.start.y, upright.end.y) > max(p.imag for p in face)
    assert min(lying.start.x, lying.end.x) < min(p.real for p in face) < max(p.real for p in face) < right


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["cam", "groove"])
@pytest.mark.parametrize("even", [True, False])
def test_the_section_of_a_cam_is_marked_where_its_plane_is_none_of_symmetry(
    tmp_path: Path, name: str, even: bool
) -> None:
    """GOST 2.305: strokes and arrows over the face, both letters above the section; the bore has the next."""
    rise = 180.0 if even else 100.0
    phases = [{"move": "rise", "angle_deg": rise, "law": "sine"},
              {"move": "return_", "angle_deg": 360.0 - rise, "law": "sine"}]  # fmt: skip
    keyed = {"phases": phases, "bore": {"shape": "keyway", "diameter": 18.0, "standard": "GOST 23360"}}
    for language, (first, second) in {"en": "AB", "uk": "АБ"}.items():
        space = ezdxf.readfile(drawn(tmp_path, PARTS[name] | keyed, language=language, tolerance=1e-2)).modelspace()
        said = [(t.dxf.text.partition(" (")[0], t.dxf.insert) for t in space.query("TEXT")]
        letters = [text for text, _ in said if set(text) <= {first, second, "-"} and text != "-"]
        bore, marked = (first, []) if even else (second, [first, first, f"{first}-{first}"])
        assert sorted(letters) == sorted([*marked, bore, bore])
        if even:
            continue
        axes = [e.dxf for e in space.query("LINE[layer=='CENTRE']")]
        upright = max((e for e in axes if e.start.x == e.end.x), key=lambda e: abs(e.end.y - e.start.y))
        found = [e.dxf for e in space.query("LINE[layer=='OUTLINE']") if e.dxf.start.x == e.dxf.end.x]
        assert sum(abs(one.start.x - upright.start.x) < 1e-6 for one in found) == 2
        at = [place for text, place in said if text == first]
        # seen from the left: letters stand there
        assert all(place.x < upright.start.x for place in at)


def test_refusals_name_their_key() -> None:
    with pytest.raises(SceneError) as caught:
        jobs(PARTS["bearing"], paper="A4", scale="5:1")
    assert caught.value.key == "exports[1].paper"
    with pytest.raises(SceneError) as caught:
        jobs(PARTS["bearing"], cells="empty")
    assert caught.value.key == "exports[1].cells"
    with pytest.raises(SceneError) as caught:
        jobs(PARTS["bearing"], drawing={"bore": "7H"})
    assert caught.value.key == "exports[1].drawing.bore"
    with pytest.raises(SceneError) as caught:
        jobs(PARTS["bearing"], formats=("pdf",), drawing={"requirements": ["HRC 40", "日本語"]})
    assert caught.value.key == "exports[1].drawing.requirements[2]"
    # zones t begin above 24 mm (ISO 286-1)
    pin = {"kind": "pin", "length": 30.0}
    with pytest.raises(SceneError) as caught:
        jobs(pin | {"diameter": 24.0}, drawing={"shaft": "t7"})
    assert caught.value.key == "exports[1].drawing.shaft"
    assert jobs(pin | {"diameter": 24.5}, drawing={"shaft": "t7"})
    # and CD ends at 10 mm
    with pytest.raises(SceneError) as caught:
        jobs(pin | {"diameter": 10.5}, drawing={"shaft": "cd8"})
    assert caught.value.key == "exports[1].drawing.shaft"
    assert jobs(pin | {"diameter": 10.0}, drawing={"shaft": "cd8"})


@pytest.mark.heavy
def test_a_groove_nearly_as_wide_as_its_barrel_is_drawn(tmp_path: Path) -> None:
    """No spline was proven to follow its development: a traceback, then a refusal of any tolerance."""
    barrel = {"kind": "barrel_cam", "form": "groove", "outer_diameter": 15.0, "groove_depth": 0.024685,
              "roller_diameter": 10.0, "clearance": 2.0,
              "motion_table": [[0.0, 0.0], [60.0, 4.0], [120.0, 10.0], [200.0, 8.0], [300.0, 1.0]]}  # fmt: skip
    for job in jobs(barrel):
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, job.declared({})[0]).failures == ()


def test_a_cam_whose_table_no_one_spline_follows_is_held_row_by_row(tmp_path: Path) -> None:
    """Of 45 rows the curve is cut at each: it was sought in the file as a whole, and was off by inf."""
    rows = [[a, 6 - 6 * math.cos(math.radians(a))] for a in range(0, 360, 8)]
    roller = {"kind": "cam", "follower": "roller", "follower_radius": 8.0, "base_circle_radius": 25.0}
    for job in jobs(roller | {"motion_table": rows}, tolerance=1e-6):
        job.write({}, tmp_path / job.path)
        assert job.verify(tmp_path / job.path, job.declared({})[0]).failures == ()


def test_of_many_parts_a_refusal_names_the_one_that_has_no_room() -> None:
    raw = {"parts": {"pin": PARTS["pin"], "large": {"kind": "pin", "diameter": 8.0, "length": 600.0}},
           "exports": [{"format": "svg", "purpose": "part", "paper": "A4", "scale": "1:1"}]}  # fmt: skip
    with pytest.raises(SceneError) as caught:
        plan_build(scene_from_dict(raw, "t", "t"), "t", [], [])
    assert (caught.value.key, caught.value.numbers["part"]) == ("exports[1].paper", "large")
    assert "the drawing of large: the paper is too small at the scale 1:1" in str(caught.value)


def test_the_same_bytes_twice_and_a_dimension_that_lies_is_seen(tmp_path: Path) -> None:
    formats = ("dxf", "svg", "pdf")
    for job in jobs(PARTS["bearing"], formats=formats):
        file, other = tmp_path / job.path, tmp_path / f"again.{job.path}"
        job.write({}, file)
        job.write({}, other)
        assert file.read_bytes() == other.read_bytes()
    job = jobs(PARTS["bearing"])[0]
    file = tmp_path / job.path
    document = ezdxf.readfile(file)
    (dimension, *_) = document.modelspace().query("DIMENSION")
    x, y, z = dimension.dxf.defpoint2
    dimension.dxf.defpoint2 = (x + 0.001, y + 0.001, z)
    document.saveas(file)
    assert any("dimension" in failure.lower() for failure in job.verify(file, 0.0).failures)


_WORD = re.compile(r"<text x=\"([-.\d]+)\" y=\"([-.\d]+)\" ([^>]*)>([^<]*)</text>")


@cache
def good(name: str) -> tuple[Any, str]:
    """The drawing of a part as SVG, found good before it is spoiled: planned and read once."""
    with tempfile.TemporaryDirectory() as place:
        job = jobs(PARTS[name], formats=("svg",))[0]
        file = Path(place) / "a.svg"
        job.write({}, file)
        assert not job.verify(file, 0.0).failures
        return job, file.read_text()


@pytest.mark.sampled(4)
@pytest.mark.parametrize("spoil", ["words", "moved", "DIMENSION", "HATCH", "TABLE", "THIN", "more"])
def test_what_stands_elsewhere_in_a_file_is_seen(tmp_path: Path, spoil: str) -> None:
    """Two words exchanged, one moved, a line of any layer moved or too many: each passed as it was."""
    job, text = good("shaft" if spoil == "THIN" else "gear")
    file = tmp_path / "a.svg"
    found = _WORD.findall(text)
    if spoil == "words":
        one, two = (next(w for w in found if w[3] == said) for said in ("m", "z"))
        pairs = [(">m</text>", ">§</text>"), (">z</text>", ">m</text>"), (">§</text>", ">z</text>")]
        assert one != two
    elif spoil == "moved":
        x = next(w for w in found if w[3] == "z")[0]
        pairs = [(f'x="{x}"', f'x="{float(x) - 15:g}"')]
    else:
        group = re.search(rf'<g id="{"TABLE" if spoil == "more" else spoil}".*?</g>', text, re.DOTALL)
        assert group is not None
        path = re.search(r'<path d="M([-.\d]+),([-.\d]+) L([-.\d]+),([-.\d]+)"/>', group[0])
        assert path is not None
        x, y, u, v = map(float, path.groups())
        moved = f'<path d="M{x + 1.5:.8f},{y} L{u + 1.5:.8f},{v}"/>'
        pairs = [(path[0], path[0] + moved if spoil == "more" else moved)]
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new, 1)
    file.write_text(text)
    assert job.verify(file, 0.0).failures


def test_words_exchanged_in_a_dxf_are_seen(tmp_path: Path) -> None:
    """The number of teeth in the module's place."""
    job = jobs(PARTS["gear"], formats=("dxf",))[0]
    file = tmp_path / "a.dxf"
    job.write({}, file)
    document = ezdxf.readfile(file)
    one, two = (next(e for e in document.modelspace().query("TEXT") if e.dxf.text == said) for said in ("m", "z"))
    one.dxf.text, two.dxf.text = "z", "m"
    document.saveas(file)
    assert any("does not stand at" in told for told in job.verify(file, 0.0).failures)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("purpose", ["part", "assembly"])
def test_a_spline_that_leaves_its_way_between_its_ends_is_seen(tmp_path: Path, purpose: str) -> None:
    """A pole in its middle moved by 0.05 mm, both ends as they were: in assembly drawings it passed."""
    job = jobs(PARTS["cam"], formats=("dxf",), purpose=purpose, tolerance=1e-3)[0]
    file = tmp_path / "a.dxf"
    job.write({}, file)
    document = ezdxf.readfile(file)
    spline = max(document.modelspace().query("SPLINE"), key=lambda e: len(e.control_points))
    poles = [ezdxf.math.Vec3(p) for p in spline.control_points]
    poles[len(poles) // 2] += ezdxf.math.Vec3(0.05, 0.05)
    spline.control_points = poles
    document.saveas(file)
    assert any("no line" in told for told in job.verify(file, 0.0).failures)


@pytest.mark.parametrize(
    ("part", "key"),
    [({"designation": "X" * 59}, "parts.p.designation"), ({"title": "W" * 119}, ""), ({"title": "W " * 59 + "W"}, "")],
)
def test_words_that_their_cells_do_not_hold_are_refused_with_how_many_fit(part: dict[str, str], key: str) -> None:
    """No word is narrowed to less than 0.9 of its width, as programs that do not narrow at all would show it."""
    if key:
        with pytest.raises(SceneError) as caught:
            jobs(PARTS["bearing"] | part, formats=("dxf",))
        most = caught.value.numbers["most"]
        assert (caught.value.key, caught.value.code) == (key, "cell_holds_letters")
        assert isinstance(most, int)
        part = {name: value[:most] for name, value in part.items()}
    for job in jobs(PARTS["bearing"] | part, formats=("dxf",), drawing={"requirements": ["y" * 290]}):
        runs = [run for text in job.canvas.texts for run in text.runs]
        assert all(run.width >= 0.899 * canvas.plain_width(run.text, run.height) for run in runs)
        assert sum(run.text.count("y") for run in runs if set(run.text) == {"y"}) == 290


def test_the_row_of_holes_of_a_rack_is_told_to_its_last_one(tmp_path: Path) -> None:
    # before: the first distance alone, whatever their number
    holes = {"count": 3, "diameter": 4.0, "spacing": 30.0}
    found = sizes(drawn(tmp_path, PARTS["rack"] | {"holes": holes}))
    assert found["2×30=<> 0"] == pytest.approx(60.0)


def test_face_chamfers_are_told_by_how_many_there_are(tmp_path: Path) -> None:
    # two at the teeth, two at the bore, one more where the hub stands out
    wheel = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 30, "face_width": 12.0, "bore_diameter": 12.0,
             "face_chamfer": 0.5}  # fmt: skip
    assert sizes(drawn(tmp_path, wheel))["4 chamfers <>×45° 0"] == pytest.approx(0.5)
    hub = {"diameter": 24.0, "above": 6.0}
    assert sizes(drawn(tmp_path, wheel | {"hub": hub}))["5 chamfers <>×45° 0"] == pytest.approx(0.5)


def test_the_thread_of_a_worm_has_its_length_between_both_ends_of_its_shaft(tmp_path: Path) -> None:
    ends = [{"diameter": 28.0, "length": 20.0}]
    found = sizes(drawn(tmp_path, {"kind": "worm", "module": 4.0, "thread_length": 50.0, "shaft_below": ends,
                                   "shaft_above": ends}))  # fmt: skip
    assert sorted(value for key, value in found.items() if key.startswith("<>")) == pytest.approx([20, 50, 90])


def test_equal_holes_are_told_circle_by_circle_and_a_collar_is_seen_on_the_face(tmp_path: Path) -> None:
    rings = [(20.0, 0.0), (40.0, 0.0), (40.0, 20.0), (30.0, 20.0), (30.0, 30.0), (20.0, 30.0)]
    part = {"kind": "turned", "points": [{"r": r, "z": z} for r, z in rings],
            "holes": [{"count": 5, "diameter": 4.0, "pitch_circle_diameter": 70.0},
                      {"count": 3, "diameter": 4.0, "pitch_circle_diameter": 50.0, "start_deg": 20.0}]}  # fmt: skip
    file = drawn(tmp_path, part)
    assert {"5 holes %%c<> 0", "3 holes %%c<> 0"} <= set(sizes(file))
    space = ezdxf.readfile(file).modelspace()
    radii = sorted({c.dxf.radius for c in space.query("CIRCLE ARC") if c.dxf.layer == "OUTLINE"}, reverse=True)
    assert [r / radii[0] for r in radii] == pytest.approx([1.0, 0.75, 0.5, 0.05])
    assert any("4 on the circle Ø50: " in text.dxf.text for text in space.query("TEXT"))


@pytest.mark.sampled(1)
@pytest.mark.parametrize("steps", [17, 20])
def test_each_step_of_a_long_shaft_has_its_size_with_its_zone(tmp_path: Path, steps: int) -> None:
    """Lengths from the end, diameters with h11: of more than fifteen steps a table had them, without their zones."""
    lengths = [8.0 + 0.5 * k for k in range(steps)]
    diameters = [10.0 + 2 * min(k, steps - k) + 0.1 * k for k in range(steps)]
    keys = {"kind": "shaft", "steps": [
        {"diameter": d, "length": b} for d, b in zip(diameters, lengths, strict=True)]}  # fmt: skip
    dxf, svg = written(tmp_path, keys)
    assert faults(svg) == []
    found = sizes(dxf)
    assert sorted(v for k, v in found.items() if k.startswith("%%c<>h11")) == pytest.approx(sorted(diameters))
    ends = [sum(lengths[: k + 1]) for k in range(steps)]
    assert sorted(v for k, v in found.items() if not k.startswith("%%c")) == pytest.approx(ends)


@pytest.mark.parametrize("steps", [8, 12])
def test_a_worm_whose_sizes_have_no_room_is_refused_and_none_is_left_out(tmp_path: Path, steps: int) -> None:
    """Its table is that of the thread: of more than sixteen places along its shaft no length nor diameter was told."""
    down = [{"diameter": 26.0 - 1.5 * k, "length": 5.0 + 0.1 * k} for k in range(steps)]
    up = [{"diameter": 26.5 - 1.5 * k, "length": 6.0 + 0.1 * k} for k in range(steps)]
    keys = {"kind": "worm", "module": 2.0, "diameter_quotient": 16.0, "thread_length": 40.0, "shaft_below": down,
            "shaft_above": up}  # fmt: skip
    if steps > 10:
        with pytest.raises(SceneError, match="20 rows"):
            jobs(keys)
        return
    found = sizes(drawn(tmp_path, keys))
    diameters = [*(one["diameter"] for one in (*down, *up)), 36.0]
    assert sorted(v for k, v in found.items() if k.startswith("%%c")) == pytest.approx(sorted(diameters))
    assert sum(one["length"] for one in (*down, *up)) + 40.0 == pytest.approx(max(found.values()))


@pytest.mark.parametrize("side", ["below", "above", ""])
def test_the_diameter_of_a_hub_stands_where_it_has_an_edge(tmp_path: Path, side: str) -> None:
    """At the end face beyond the rim; of one that is flush with it nothing is seen, and it had a size all the same."""
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 12.0, "bore_diameter": 12.0}
    hub = {"diameter": 20.0} | ({side: 7.0} if side else {})
    space = ezdxf.readfile(drawn(tmp_path, gear | {"hub": hub})).modelspace()
    found = [d.dxf for d in space.query("DIMENSION") if abs(d.dxf.actual_measurement - 20.0) < 1e-6]
    assert len(found) == (1 if side else 0)
    level = [
        line.dxf for line in space.query("LINE[layer=='OUTLINE']") if abs(line.dxf.start.y - line.dxf.end.y) < 1e-6
    ]
    for size in found:
        ends = [p.x for e in level for p in (e.start, e.end) if abs(p.y - size.defpoint2.y) < 1e-6]
        assert size.defpoint2.x == pytest.approx((min if side == "below" else max)(ends), abs=1e-6)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("side", ["below", "above"])
def test_a_hub_on_one_side_closes_no_chain_and_a_negative_helix_is_told_by_its_hand(tmp_path: Path, side: str) -> None:
    gear = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 12.0, "helix_angle_deg": -15.0}
    file = drawn(tmp_path, gear | {"bore_diameter": 12.0, "hub": {"diameter": 20.0, side: 8.0}})
    assert sorted(v for k, v in sizes(file).items() if not k.startswith("%%c")) == pytest.approx([12.0, 20.0])
    assert {"15°", "left"} <= words(file)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("language", "mark"), [("en", "."), ("uk", ",")])
def test_programs_that_write_dimensions_anew_part_decimals_as_the_sheet_does(
    tmp_path: Path, language: str, mark: str
) -> None:
    drawing = ezdxf.readfile(written(tmp_path, PARTS["ring"], language)[0])
    styles = [style.dxf.dimdsep for style in drawing.dimstyles if style.dxf.name != "Standard"]
    assert {drawing.header["$DIMDSEP"], *styles} == {ord(mark)}


def test_a_requirement_that_stands_alone_has_no_number(tmp_path: Path) -> None:
    for more in ([], ["HRC 40"]):
        job = jobs(PARTS["bearing"], formats=("dxf",), drawing={"requirements": more})[0]
        job.write({}, tmp_path / job.path)
        numbered = {text[:2] for text in words(tmp_path / job.path) if text[:2] in ("1.", "2.")}
        assert numbered == ({"1.", "2."} if more else set())
        # GOST 2.316: what is asked of the material stands first
        assert ("1. HRC 40" in words(tmp_path / job.path)) is bool(more)


def test_two_per_cent_signs_begin_no_sign_of_another_program(tmp_path: Path) -> None:
    """AutoCAD and LibreCAD read %%c as the sign of a diameter: a title 5%%c was shown as 5Ø, a requirement refused."""
    job = jobs(PARTS["bearing"] | {"title": "5%%c"}, formats=("dxf",), drawing={"requirements": ["a%%%d"]})[0]
    job.write({}, tmp_path / job.path)
    assert job.verify(tmp_path / job.path, 0.0).failures == ()
    space = ezdxf.readfile(tmp_path / job.path).modelspace()
    pieces = sorted((t.dxf.insert.x, t.dxf.text) for t in space.query("TEXT") if "%" in t.dxf.text)
    assert [text for _, text in pieces if "." not in text] in (["5%", "%c", "%", "%d"], ["%", "%d", "5%", "%c"])
    assert not any("%%" in text for _, text in pieces)


@pytest.mark.parametrize("zones", [{"bore": "J7", "keyway": "ZC10"}, {"bore": "K8", "tip": "k9"}, {"tip": "j5"}])
def test_zones_that_exist_pass(zones: dict[str, str]) -> None:
    assert jobs(PARTS["bearing"], formats=("dxf",), drawing=zones)


def test_a_drawing_is_named_as_all_files_of_its_part_and_a_pdf_as_its_scene() -> None:
    formats = ("dxf", "svg", "pdf")
    assert [job.path for job in jobs(PARTS["bearing"], formats=formats)] == ["p.part.dxf", "p.part.svg", "t.part.pdf"]
    assert [job.path for job in jobs(PARTS["bearing"], name="sheet", formats=formats[:1])] == ["p.sheet.dxf"]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["gear", "ring", "rack", "wheel"])
def test_the_sign_of_teeth_stands_on_the_extension_of_a_pitch_line(tmp_path: Path, name: str) -> None:
    """Of a worm wheel, where the size of its throat stands there, an arrow points to the line's end at the face."""
    space = ezdxf.readfile(drawn(tmp_path, PARTS[name], tolerance=1e-2)).modelspace()
    beyond = 4.0 if name == "wheel" else 0.0
    ends = {(line.dxf.end - Vec3(beyond, 0, 0)).round(6) for line in space.query("LINE[layer=='CENTRE']")}
    stands = [line for line in space.query("LINE[layer=='DIMENSION']") if line.dxf.start.round(6) in ends]
    rises = [line.dxf.end.y - line.dxf.start.y for line in stands]
    assert min(rises) > 2 if beyond else rises == [pytest.approx(0, abs=1e-9)]


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("paper", "turn", "size"), [({"paper": "A4"}, 180, (70, 14)), ({"paper": "A3"}, 90, (14, 70)), ({}, 180, (70, 14))]
)
def test_the_designation_stands_turned_in_the_upper_left_corner(
    tmp_path: Path, paper: dict[str, str], turn: int, size: tuple[float, float]
) -> None:
    """GOST 2.104, graph 26: upside down on A4 and on sheets that lie, read from the right on larger upright ones."""
    part = PARTS["bearing"] if paper else PARTS["wheel"]
    document = ezdxf.readfile(drawn(tmp_path, part | {"designation": "HP.07"}, **paper))
    assert document.header["$DIMTXSTY"] == "unicode"
    turns = {}
    for text in document.modelspace().query("TEXT"):
        if text.dxf.text == "HP.07":
            turns[round(abs((text.dxf.align_point - text.dxf.insert).angle_deg))] = text
    assert set(turns) == {0, turn}
    frame = [e.dxf for e in document.modelspace().query("LINE[layer=='FRAME']")]
    left, top = 20.0, max(e.start.y for e in frame)
    corners = [(left, top), (left + size[0], top - size[1])]
    for x, y in corners:
        assert any(e.start.isclose((x, y, 0)) or e.end.isclose((x, y, 0)) for e in frame)
    for at in (turns[turn].dxf.insert, turns[turn].dxf.align_point):
        assert left < at.x < corners[1][0]
        assert corners[1][1] < at.y < top


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["gear", "cam", pytest.param("groove", marks=pytest.mark.heavy)])
def test_an_arrow_on_the_axis_tells_from_where_a_bore_is_seen(tmp_path: Path, name: str) -> None:
    space = ezdxf.readfile(drawn(tmp_path, PARTS[name])).modelspace()
    texts = [t.dxf for t in space.query("TEXT") if re.match(r"A( \(|$)", t.dxf.text)]
    axes = {round(e.dxf.start.y, 6) for e in space.query("LINE[layer=='CENTRE']") if e.dxf.start.y == e.dxf.end.y}
    lying = [e.dxf for e in space.query("LINE[layer=='DIMENSION']") if e.dxf.start.y == e.dxf.end.y]
    arrows = [e.start for e in lying if round(e.start.y, 6) in axes]
    # one beside its arrow, one over the view
    letters = [t for t in texts if any(abs(a.x - t.insert.x + 6) < 0.5 and 0 < t.insert.y - a.y < 9 for a in arrows)]
    assert len(texts) == 2
    assert [(letter.text, letter.height) for letter in letters] == [("A", 5.0)]


def test_a_curve_is_fitted_once_however_many_papers_are_tried(monkeypatch: pytest.MonkeyPatch) -> None:
    tried: list[Any] = []
    fit = canvas.fit_spline
    monkeypatch.setattr(canvas, "fit_spline", lambda curve, *a, **k: tried.append(curve) or fit(curve, *a, **k))
    jobs(PARTS["cam"], formats=("dxf",))
    assert 1 <= len(tried) == len(set(tried))


def test_scenes_without_drawings_import_nothing_of_them() -> None:
    code = (
        "import sys; from exporters.production.plan import plan_build; from parts.scene.load import load_scene\n"
        "plan_build(load_scene('laser_gear'), 'laser_gear', [], ['dxf'])\n"
        "print([m for m in sys.modules if m.endswith(('drawing.working', 'drawings', 'dimensioning', 'part_sheet'))])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.sampled(1)
@pytest.mark.parametrize("corner", [0.0, 8.0])
def test_lines_of_sizes_of_a_flat_body_begin_at_its_outline(tmp_path: Path, corner: float) -> None:
    """GOST 2.307: they began at the corners of the rectangle about it, where a frame with stems has nothing."""
    cam = {key: value for key, value in PARTS["cam"].items() if key != "follower_radius"} | {"follower": "flat"}
    yoke = {"kind": "yoke_frame", "of": "p", "wall": 10.0, "corner_radius": corner, "stem_below": 40.0}
    raw = {"parts": {"p": cam, "yoke": yoke}, "exports": [{"format": "dxf", "purpose": "part", "parts": ["yoke"]}]}
    (job,) = plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets
    job.write({}, tmp_path / job.path)
    space = ezdxf.readfile(tmp_path / job.path).modelspace()
    paths = (make_path(e).flattening(1e-4) for e in space.query("*[layer=='OUTLINE']"))
    edges = [shapely.LineString([(p.x, p.y) for p in path]) for path in paths]
    found = []
    for one in (one for one in space.query("DIMENSION") if one.dimtype == 0):
        turn = complex(math.cos(math.radians(one.dxf.angle)), math.sin(math.radians(one.dxf.angle)))
        at = complex(*one.dxf.defpoint.vec2)
        for line in space.doc.blocks.get(one.dxf.geometry).query("LINE"):
            ends = [(complex(*end.vec2) - at) / turn for end in (line.dxf.start, line.dxf.end)]
            if abs((ends[0] - ends[1]).real) < 1e-6:
                foot = at + turn * max(ends, key=lambda end: abs(end.imag))
                found.append(min(edge.distance(shapely.Point(foot.real, foot.imag)) for edge in edges))
    assert len(found) >= 16
    # where an arc rounds a corner, lines begin at the corner
    assert max(found) <= 1e-6 + corner / space.doc.header["$DIMLFAC"] * (math.sqrt(2) - 1)


def test_a_grid_of_holes_is_told_by_its_step_and_so_many_steps(tmp_path: Path) -> None:
    """GOST 2.307: the size between neighbours, and that between the outermost as a product; no table of holes."""
    grid = {"at": [12.5, 12.5], "diameter": 6.2, "columns": 10, "rows": 6, "pitch": 25.0, "row_pitch": 20.0}
    part = {"kind": "plate", "width": 250.0, "height": 150.0, "centre": [125.0, 75.0], "holes": [grid]}
    space = ezdxf.readfile(drawn(tmp_path, part)).modelspace()
    sizes = sorted((round(d.get_measurement(), 6), d.dxf.text) for d in space.query("DIMENSION") if d.dimtype == 0)
    assert sizes == [(6.2, "60 holes %%c<>"), (12.5, "<>"), (12.5, "<>"), (20.0, "<>"), (25.0, "<>"),
                     (100.0, "5×20=<>"), (150.0, "<>"), (225.0, "9×25=<>"), (250.0, "<>")]  # fmt: skip
    # an axis through each column and row
    assert len(space.query("LINE[layer=='CENTRE']")) == 16


@pytest.mark.parametrize("over", [True, False])
def test_a_wedge_cam_has_no_size_twice(tmp_path: Path, over: bool) -> None:
    """The origin's distance stood twice where a hole is over it; GOST 2.307."""
    wedge = {"kind": "wedge_cam", "follower": "roller", "follower_radius": 6.0, "lift": 20.0, "base_height": 18.0,
             "phases": [{"move": "rise", "travel": 70.0, "law": "sine"}], "face_width": 6.0,
             "run_in": 15.0, "holes": [{"x": 0.0 if over else 5.0, "y": 8.0, "diameter": 5.0}]}  # fmt: skip
    space = ezdxf.readfile(drawn(tmp_path, wedge, tolerance=1e-2)).modelspace()
    across = [round(one.get_measurement(), 6) for one in space.query("DIMENSION") if one.dimtype == 0]
    assert len(across) == len(set(across))


def test_holes_at_many_places_are_numbered_and_stand_in_a_table(tmp_path: Path) -> None:
    """As it was: 30 of them had a size for each x and each y, for which no paper had room."""
    places = [(7.0 * k - 100.0, 13.0 * k * k % 101 - 50.0) for k in range(1, 28)]
    holes = [{"at": list(p), "diameter": 4.0 + k % 2} for k, p in enumerate(places)]
    plate = {"kind": "plate", "width": 200.0, "height": 120.0, "face_width": 6.0, "holes": holes}
    (job,) = jobs(plate, formats=("dxf",))
    job.write({}, tmp_path / job.path)
    assert job.verify(tmp_path / job.path, 0.0).failures == ()
    document = ezdxf.readfile(tmp_path / job.path)
    assert sorted(sizes(tmp_path / job.path).values()) == pytest.approx([120.0, 200.0])
    texts = {text.dxf.text for text in document.modelspace().query("TEXT")}
    left, low = 100.0, 60.0
    for k, (x, y) in enumerate(places, 1):
        assert {str(k), f"{x + left:.3f}", f"{y + low:.3f}"} <= texts
    assert {"4.000", "5.000"} <= texts
    (job,) = jobs(plate | {"holes": holes[:4]}, formats=("dxf",))
    job.write({}, tmp_path / job.path)
    assert len(sizes(tmp_path / job.path)) == 2 + 8 + 2


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("teeth", "mate", "shaft"), [(20, 40, 90.0), (40, 20, 90.0), (14, 30, 60.0), (30, 20, 120.0)])
def test_cones_of_a_bevel_gear_stand_on_its_picture(teeth: int, mate: int, shaft: float, tmp_path: Path) -> None:
    """GOST 2.405: the angles of tips and back cone, off the arcs of the file and the edges that they end at.

    ezdxf measures each by the two lines of its dimension.
    """
    gear = {"kind": "bevel_gear", "module": 3.0, "number_of_teeth": teeth, "mate_number_of_teeth": mate,
     "bore_diameter": 8.0,
            "shaft_angle_deg": shaft}  # fmt: skip
    document = ezdxf.readfile(drawn(tmp_path, gear, paper="A3", scale="1:1", tolerance=1e-2))
    space = document.modelspace()
    sigma = math.radians(shaft)
    delta = math.atan2(math.sin(sigma), mate / teeth + math.cos(sigma))
    theta = math.atan(3.6 / (3.0 * teeth / 2 / math.sin(delta)))
    wanted = {90.0 - math.degrees(delta), math.degrees(delta + theta)}
    edges = [(complex(*e.dxf.start.vec2), complex(*e.dxf.end.vec2)) for e in space.query("LINE[layer=='OUTLINE']")]
    told = [one for one in space.query("DIMENSION") if one.dimtype == ANGULAR]
    assert sorted(one.get_measurement() for one in told) == pytest.approx(sorted(wanted), abs=1e-6)
    blocks = [document.blocks.get(one.dxf.geometry) for one in told]
    said = {text.dxf.text for block in blocks for text in block.query("TEXT")}
    found = set()
    for arc in (arc for block in blocks for arc in block.query("ARC[layer=='DIMENSION']")):
        at, first, last = complex(*arc.dxf.center.vec2), arc.dxf.start_angle, arc.dxf.end_angle
        ways = [math.degrees(math.atan2((b - a).imag, (b - a).real)) % 360
                for edge in edges for a, b in (edge, edge[::-1]) if abs(a - at) < 1e-5]  # fmt: skip
        # arrows stand within, or without on an arc that is 5 mm longer at each end
        for more in (0.0, math.degrees(5.0 / arc.dxf.radius)):
            ends = [(first + more) % 360, (last - more) % 360]
            level = [turn for turn in ends if min(abs(turn - x) for x in (0.0, 180.0, 360.0)) < 1e-3]
            slope = [turn for turn in ends if any(abs(turn - way) < 1e-3 for way in ways)]
            if len(level) == len(slope) == 1:
                found.add(round((last - first - 2 * more) % 360, 3))
    assert sorted(found) == pytest.approx(sorted(wanted), abs=2e-3)
    for angle in wanted:
        parts = [*divmod(round(angle * 3600), 3600)]
        words = f"{parts[0]}°{parts[1] // 60:02d}′{parts[1] % 60:02d}″"
        assert words.removesuffix("00″").removesuffix("00′") in said


def test_the_line_of_a_face_width_ends_beside_no_other_line(tmp_path: Path) -> None:
    """Its shelf began half a millimetre beside the line of the mounting distance: shapely, by the file alone."""
    gear = {"kind": "bevel_gear", "module": 2.0, "number_of_teeth": 30, "mate_number_of_teeth": 20,
     "bore_diameter": 10.0,
            "hub_diameter": 24.0, "hub_length": 8.0}  # fmt: skip
    # the paper and scale that it takes by itself
    document = ezdxf.readfile(drawn(tmp_path, gear, paper="A3", scale="1:1", tolerance=1e-2))
    lines: dict[bool, list[shapely.LineString]] = {True: [], False: []}
    for one in document.modelspace().query("DIMENSION"):
        slope = one.dxf.angle % 90 if one.dimtype != ANGULAR else 0.0
        for line in document.blocks.get(one.dxf.geometry).query("LINE"):
            way = (line.dxf.end - line.dxf.start).angle_deg
            if not slope or abs(math.remainder(way - one.dxf.angle, 180.0)) < 1e-3:
                ends = [tuple(at.vec2) for at in (line.dxf.start, line.dxf.end)]
                lines[bool(slope)].append(shapely.LineString(ends))
    own = max(lines[True], key=lambda line: line.length)
    others = shapely.MultiLineString(lines[False])
    assert min(shapely.Point(at).distance(others) for at in own.coords) > 1.0

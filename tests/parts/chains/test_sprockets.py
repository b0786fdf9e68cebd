"""Sprockets in scenes: chains by name or by sizes, rows of teeth, refusals that name what works, files with rollers."""

from __future__ import annotations

import cmath
import math
import re
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
from shapely.geometry import Point, Polygon

from exporters.formats.read_dxf import read_dxf
from geometry.base.record import replace
from geometry.plane.measure import profile_area
from geometry.solids.mass import body_moments
from parts.base.part import Part
from parts.base.refusal import SceneError, sentence
from parts.chains.probe import RollerProbe
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.making import read_report, run, write_scene

Keys = dict[str, Any]
PLATE: Keys = {"kind": "sprocket", "chain": "08B-1", "number_of_teeth": 17, "bore_diameter": 20.0}
OWN: Keys = {"kind": "sprocket", "pitch": 12.7, "roller_diameter": 8.51, "number_of_teeth": 17}


def made(keys: Keys) -> Part:
    """The part of its keys."""
    return make_parts(scene_from_dict({"parts": {"a": keys}}, "t", "t"), "t")[0]["a"]


def test_a_chain_by_its_name_is_one_by_its_sizes() -> None:
    by_name = made(PLATE).thing
    by_sizes = made(OWN | {"inner_width": 7.75, "bore_diameter": 20.0}).thing
    assert (by_name.tip_radius, by_name.face_width) == (by_sizes.tip_radius, by_sizes.face_width)
    assert made(PLATE).is_plate


def test_three_rows_of_teeth_are_plates_on_a_core() -> None:
    """Areas of the rows and of the circle that ISO 606 leaves to the plates, with hub and bore."""
    part = made(PLATE | {"chain": "08B-3", "hub": {"diameter": 40.0, "above": 6.0}})
    teeth = profile_area(part.section(0.0).region.outer)
    core = 12.7 / math.tan(math.pi / 17) - 1.04 * 11.81 - 0.76
    width, length = 0.91 * 7.75, 2 * 13.92 + 0.91 * 7.75
    assert part.face_width == pytest.approx(length)
    wanted = 3 * width * teeth + 2 * (13.92 - width) * math.pi * core**2 / 4 + 6.0 * math.pi * 20.0**2
    wanted -= (length + 6.0) * math.pi * 10.0**2
    assert body_moments(part.body(0.0)).volume == pytest.approx(wanted, rel=1e-12)
    assert not part.is_plate


@pytest.mark.parametrize("chain", ["08B-1", "08B-2"])
def test_bevelled_teeth_are_cut_by_cones(chain: str) -> None:
    """At any height the teeth within the circle of the cone; the volume by slices of shapely."""
    part = made(PLATE | {"chain": chain, "tooth_bevel": 1.6})
    sprocket, outline = part.thing, part.section(0.0).region.outer
    curves = [s.curve for s in outline.segments()]
    places = np.concatenate([c.point(np.linspace(*c.domain, 120)[:-1]) for c in curves])
    teeth = Polygon(np.column_stack((places.real, places.imag)))
    shares, weights = np.polynomial.legendre.leggauss(9)
    radii = sprocket.bevel_radius + (sprocket.tip_radius - sprocket.bevel_radius) * (1 + shares) / 2
    slices = [teeth.intersection(Point(0, 0).buffer(radius, 4096)).area for radius in radii]
    rows = sprocket.strands
    wanted = rows * (2 * 1.6 * float(np.dot(weights, slices)) / 2 + (sprocket.face_width - 3.2) * teeth.area)
    wanted += (rows - 1) * (13.92 - sprocket.face_width) * math.pi * sprocket.core_radius**2
    wanted -= sprocket.total_width * math.pi * 10.0**2
    assert body_moments(part.body(0.0)).volume == pytest.approx(wanted, rel=3e-5)
    assert not part.is_plate


def test_a_step_file_of_bevelled_teeth_is_read_back(tmp_path: Path) -> None:
    keys = PLATE | {"chain": "08B-2", "number_of_teeth": 9, "bore_diameter": 8.0, "tooth_bevel": 1.6}
    assert run("build", write_scene(tmp_path / "s.toml", {"a": keys}, [{"format": "step"}]), "--out", tmp_path) == 0


@pytest.mark.parametrize(
    ("keys", "key", "cure"),
    [
        (PLATE | {"chain": "08C"}, "chain", "08B"),
        (PLATE | {"chain": "081-2"}, "chain", "081"),
        # as bicycles and motorcycles name them: pitch and inner width in inches
        (PLATE | {"chain": "1/2x1/8"}, "chain", "081"),
        (PLATE | {"chain": '1/2" \u0445 3/16"'}, "chain", "083"),
        (PLATE | {"chain": "1/2 x 5/16"}, "chain", "08B"),
        (PLATE | {"chain": "5/8\u00d73/8"}, "chain", "10B"),
        (PLATE | {"pitch": 12.7}, "pitch", None),
        (OWN, "inner_width", None),
        (PLATE | {"face_width": 8.0}, "face_width", 7.749992),
        (PLATE | {"displaced": True}, "displaced", False),
        (PLATE | {"form": 0.5, "tooth_form": "GOST 591"}, "form", 0.0),
        (PLATE | {"form": 0.5, "tooth_form": "ANSI B29.1"}, "form", 0.0),
        (PLATE | {"displaced": True, "tooth_form": "ANSI B29.1"}, "displaced", False),
        (PLATE | {"tip_diameter": 77.0}, "tip_diameter", 76.480827),
        (PLATE | {"bore_diameter": 61.0}, "bore_diameter", 60.505767),
        (PLATE | {"chain": "08B-2", "face_chamfer": 0.5}, "face_chamfer", None),
        (PLATE | {"tooth_bevel": 4.0}, "tooth_bevel", 3.60374),
        (PLATE | {"tooth_bevel": 0.05}, "tooth_bevel", 0.127),
        (PLATE | {"tooth_bevel": 1.0, "face_chamfer": 0.5}, "face_chamfer", None),
        (OWN | {"inner_width": 7.75, "strands": 2}, "transverse_pitch", None),
    ],
)
def test_bad_keys_are_refused_with_what_works(keys: Keys, key: str, cure: object) -> None:
    with pytest.raises(SceneError) as refused:
        made(keys)
    assert refused.value.key == f"parts.a.{key}"
    nearest = refused.value.nearest
    if cure is not None:
        assert nearest is not None
        assert nearest.value == (pytest.approx(cure) if isinstance(cure, float) else cure)
        made(keys | {key: nearest.value})


def test_files_take_rollers_and_one_that_does_not_is_caught(tmp_path: Path) -> None:
    parts = {"iso": PLATE, "gost": PLATE | {"tooth_form": "GOST 591", "number_of_teeth": 12, "chain": "ПР-12,7-18,2"}}
    parts["ansi"] = PLATE | {"tooth_form": "ANSI B29.1", "chain": "ANSI 40"}
    exports = ({"format": "dxf"}, {"format": "dxf", "name": "cut", "kerf": 0.2}, {"format": "svg"}, {"format": "stl"})
    assert run("build", write_scene(tmp_path / "s.toml", parts, exports), "--out", tmp_path / "out") == 0
    built = tmp_path / "out" / "s"
    for entry in read_report(built)["files"]:
        gap = {"gost": 0.0025 * 8.51 + 0.05, "ansi": 0.0025 * 7.92 + 0.0381}.get(entry["part"], 0.0)
        off = entry["max_error"] + 1e-6
        assert entry["measured"]["roller_gap"] == pytest.approx(gap - entry["offset"], abs=off)
    sprocket, file = made(PLATE).thing, read_dxf(built / "iso.laser.dxf")
    assert RollerProbe(sprocket, 2.0).run(file, 0.0, 1e-6).failures == ()
    thick = replace(sprocket, chain=replace(sprocket.chain, roller_diameter=8.52))
    (failure,) = RollerProbe(thick, 2.0).run(file, 0.0, 1e-6).failures
    assert "rollers" in failure
    # the seat between the last tooth and the first alone stands too far out
    document = ezdxf.readfile(built / "iso.laser.dxf")
    outline = max(document.modelspace().query("LWPOLYLINE"), key=len)
    rows = [(complex(x, y), bulge) for x, y, bulge in outline.get_points("xyb")]
    angle, root = -sprocket.pitch_angle / 2, sprocket.root_radius
    spoiled = [p * 1.01 if abs(cmath.phase(p) - angle) < 0.3 * -angle and abs(p) < root + 2 else p for p, _ in rows]
    assert 0 < sum(p != q for (p, _), q in zip(rows, spoiled, strict=True)) < 20
    outline.set_points([(p.real, p.imag, b) for p, (_, b) in zip(spoiled, rows, strict=True)], format="xyb")
    document.saveas(tmp_path / "spoiled.dxf")
    assert len(RollerProbe(sprocket, 2.0).run(read_dxf(tmp_path / "spoiled.dxf"), 0.0, 1e-6).failures) == 1


@pytest.mark.parametrize(("chain", "teeth"), [("12A-1", 15), ("08B-1", 17), ("06B-1", 24), ("16A-1", 31)])
def test_both_limits_of_a_tip_diameter_work_as_they_are_told(chain: str, teeth: int) -> None:
    """d + 1.25 p - d1 = 103.527939 mm, told as 103.52794, was refused: beyond 96.7334 to 103.528 mm."""
    keys = PLATE | {"chain": chain, "number_of_teeth": teeth}
    for limit in made(keys).thing.form.tips(made(keys).thing.chain, teeth):
        assert made(keys | {"tip_diameter": round(limit, 5)}).circles["tip_diameter"] == pytest.approx(limit, abs=6e-6)
        for off in (-2e-3, 2e-3):
            if off * (limit - 2 * made(keys).thing.tip_radius) > 0:
                with pytest.raises(SceneError):
                    made(keys | {"tip_diameter": limit + off})


@pytest.mark.parametrize("language", ["en", "uk"])
def test_every_chain_that_a_refusal_names_is_one(language: str) -> None:
    """081 of bicycles was not among them, and nothing else led to it."""
    with pytest.raises(SceneError) as caught:
        made(PLATE | {"chain": "bicycle"})
    said = sentence(caught.value, language).partition(":")[2]
    named = re.findall(r"(?<![\w.-])(?:(?:PR|ПР)-[\d.-]+\d|\d{2,3}[A-Z]?)(?![\w.-])", said)
    assert {"081", "085", "04C", "72B", "25", "240", "415", "630"} <= {*named}
    for name in set(named) - {"606", "13568"}:
        assert made(PLATE | {"chain": name, "bore_diameter": 0.0}).thing.number_of_teeth == 17

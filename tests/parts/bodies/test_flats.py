"""Flats of shafts: what they take away, what goes on them, what is drawn of them, what is refused."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely
from ezdxf.path import make_path

from parts.base.refusal import SceneError
from parts.scene.interference import solid_overlaps
from parts.scene.load import make_parts, scene_from_dict
from parts.scene.placing import place
from tests.exporters.making import run, write_scene
from tests.parts.bodies.test_turned import body_of

Keys = dict[str, Any]
D = {"shape": "D", "flat": 4.5}
TWO = {"shape": "double_D", "across_flats": 4.0}


def shaft(*steps: Keys, **keys: Any) -> Keys:
    return {"kind": "shaft", "steps": list(steps)} | keys


def step(diameter: float, length: float, **keys: Any) -> Keys:
    return {"diameter": diameter, "length": length} | keys


def beyond(radius: float, floor: float) -> float:
    """Area of a circle beyond a chord."""
    return radius * radius * math.acos(floor / radius) - floor * math.sqrt(radius**2 - floor**2)


@pytest.mark.sampled(7)
@pytest.mark.parametrize("end", ["lower", "upper"])
@pytest.mark.parametrize(("flats", "count"), [(D, 1), (TWO, 2)])
@pytest.mark.parametrize("chamfer", [0.0, 0.3, 0.5, 0.8])
def test_flats_take_away_what_lies_beyond_them(chamfer: float, flats: Keys, count: int, end: str) -> None:
    """A chamfer that ends beyond the flats, on them, within them: slice by slice, and the middle of what is lost."""
    plain = body_of(shaft(step(5.0, 20.0, chamfer=chamfer))).moments
    cut = body_of(shaft(step(5.0, 20.0, chamfer=chamfer, flats=flats | {"length": 8.0, "end": end}))).moments
    nodes, weights = np.polynomial.legendre.leggauss(60)
    # from where the chamfer meets the flats to its end, and from there on
    start = max(0.0, chamfer - 0.5)
    heights = start + (chamfer - start) * (nodes + 1) / 2
    slices = [beyond(2.5 - chamfer + z, 2.0) for z in heights] if chamfer else [0.0] * 60
    lost = count * ((8.0 - chamfer) * beyond(2.5, 2.0) + (chamfer - start) / 2 * float(weights @ slices))
    assert plain.volume - cut.volume == pytest.approx(lost, rel=1e-7)
    where = (plain.volume * plain.centre - cut.volume * cut.centre) / lost
    assert abs(where[0]) < 1e-9
    assert (where[1] > 2.0) if count == 1 else abs(where[1]) < 1e-9
    assert (where[2] < 8.0) if end == "lower" else (where[2] > 12.0)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(("turn", "clearance"), [(0.0, 0.0), (0.0, 0.1), (3.9, 0.1), (8.0, 0.1)])
def test_a_bore_goes_on_the_shaft_of_its_keys_as_its_clearance_says(turn: float, clearance: float) -> None:
    """A corner of the flat comes to its bore at acos(0.8) - acos(2.1 / 2.5) = 4.01 degrees; GEOS has what is beyond."""
    mate = {"kind": "fixed", "first": "shaft", "second": "gear", "offset": [0.0, 0.0, 2.0], "rotation_deg": turn}
    raw = {
        "parts": {
            "shaft": shaft(step(5.0, 20.0, flats=D | {"length": 12.0})),
            "gear": {"kind": "spur_gear", "module": 1.0, "number_of_teeth": 20, "face_width": 8.0,
                     "bore": D | {"diameter": 5.0, "clearance": clearance}},
        },
        "mates": [mate],
    }  # fmt: skip
    scene = scene_from_dict(raw, "t", "t")
    parts, matings = make_parts(scene, "t")
    found = solid_overlaps(place(scene.instances, scene.drives, parts, matings, "t"), parts)

    def section(radius: float, floor: float, angle: float) -> shapely.Polygon:
        disk = shapely.Point(0, 0).buffer(radius, quad_segs=20_000)
        kept = shapely.box(-9, -9, 9, floor)
        return shapely.affinity.rotate(disk.intersection(kept), angle, origin=(0, 0))

    common = section(2.5, 2.0, 0.0).difference(section(2.5 + clearance, 2.0 + clearance, turn)).area * 8.0
    assert len(found) == (common > 1e-3)
    assert sum(one.volume or 0.0 for one in found) == pytest.approx(common, rel=0.1)


def test_files_of_a_shaft_with_flats(tmp_path: Path) -> None:
    """A laser's outline is what is seen along the axis; the drawing tells size and length."""
    keys = shaft(step(5.0, 20.0, chamfer=0.5, flats=D | {"length": 12.0}), step(3.0, 5.0))
    long = shaft(step(5.0, 20.0, chamfer=0.5, flats=TWO), step(3.0, 5.0))
    exports: list[Keys] = [{"format": "dxf"}, {"format": "dxf", "purpose": "part", "name": "drawn"}]
    run("build", str(write_scene(tmp_path / "s.toml", {"one": keys, "two": long}, exports)), "--out", str(tmp_path))
    area = {}
    for file in sorted(tmp_path.rglob("*.dxf")):
        space = ezdxf.readfile(file).modelspace()
        if "drawn" not in file.name:
            (outline,) = space.query("LWPOLYLINE")
            points = [(p.x, p.y) for p in make_path(outline).flattening(1e-5)]
            area[file.name[:3]] = shapely.Polygon(points).area
            continue
        told = list(space.query("DIMENSION"))
        # in the long view by its greatest length, in the section as it is told
        along = [float(one.get_measurement()) for one in told if one.dxf.text == "<>"]
        lengths = [round(25.0 * length / max(along), 6) for length in along]
        assert sorted(lengths) == ([12.0, 20.0, 25.0] if "one" in file.name else [20.0, 25.0])
        assert ("4.5" if "one" in file.name else "4") in [one.dxf.text for one in told]
        # hyperbolas: through the chamfer of one end, and of the step's other end where the flats reach it
        assert len(space.query("SPLINE")) == (2 if "one" in file.name else 4)
    assert area["one"] == pytest.approx(math.pi * 2.5**2, rel=1e-3)
    assert area["two"] == pytest.approx(math.pi * 2.5**2 - 2 * beyond(2.5, 2.0), rel=1e-3)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("bore", [0.0, 6.0])
@pytest.mark.parametrize("end", ["lower", "upper"])
def test_flats_of_which_a_chamfer_takes_the_middle_are_cut_where_their_cylinder_is(
    tmp_path: Path, end: str, bore: float
) -> None:
    """The section of a shaft with a flat hardly longer than the chamfer ended in a traceback."""
    flats = {"shape": "double_D", "across_flats": 21.0, "length": 3.0, "end": end}
    part = shaft(step(24.0, 14.0, chamfer=2.0, flats=flats), bore_diameter=bore)
    scene = write_scene(tmp_path / "s.toml", {"shaft": part}, [{"format": "dxf", "purpose": "part"}])
    run("build", str(scene), "--out", str(tmp_path))
    (file,) = tmp_path.rglob("shaft.part.dxf")
    arcs = [arc.dxf for arc in ezdxf.readfile(file).modelspace().query("ARC")]
    # what a chord 10.5 off the axis leaves of a circle of 12 on both sides
    left = [
        arc
        for arc in arcs
        if abs((arc.end_angle - arc.start_angle) % 360 - 2 * math.degrees(math.asin(10.5 / 12))) < 1e-6
    ]
    assert len(left) == 2
    assert len({arc.radius for arc in left}) == 1


def two(**keys: Any) -> Keys:
    return {"flats": TWO | keys}


def one(flat: float) -> Keys:
    return {"flats": {"shape": "D", "flat": flat}}


GROOVE = [{"at": 10.0, "width": 1.0, "diameter": 8.0}]
# all of 10 mm, 20 mm long, the first with these keys, and what comes after it
REFUSED: dict[str, tuple[Keys, list[Keys], str, str]] = {
    "outside": (one(10.0), [], "steps[1].flats.flat = 10.0", "at most 9.99999 mm"),
    "beyond the axis": (one(4.0), [], "steps[1].flats.flat = 4.0", "at least 5.000005 mm"),
    "long": (two(length=30.0), [], "steps[1].flats.length = 30.0", "at most 20 mm"),
    "chamfer": (two(length=0.5) | {"chamfer": 1.0}, [], "steps[1].flats.length = 0.5", "at least 1.000001 mm"),
    "fillet": (two() | {"fillet": 1.0}, [step(20.0, 5.0)], "steps[1].flats.length = 20.0", "at most 18.999999 mm"),
    "groove": (two(length=12.0) | {"grooves": GROOVE}, [], "steps[1].flats.length = 12.0", "at most 9.999999 mm"),
    "from a fillet": (
        two(length=5.0, end="upper") | {"fillet": 1.0}, [step(20.0, 5.0)], "steps[1].fillet = 1.0", "0 mm works"
    ),
    "beside": (two(), [step(9.0, 5.0)], "steps[1].flats.across_flats = 4.0", "at least 9.000009 mm"),
    "beside a fillet": (one(6.0), [step(4.0, 5.0, fillet=0.5)], "steps[1].flats.flat = 6.0", "at least 7.500008 mm"),
    "in a row": (two(), [step(10.0, 5.0, **one(9.0))], "steps[2].flats", "end in one plane"),
    "all round": (two(), [step(10.0, 5.0), step(10.0, 20.0, **two(angle_deg=0.0))], "steps", "free"),
    # as it was: wholly in what the flat takes away, and yet a solid
    "keyway beyond": (
        one(6.0) | {"keyways": [{"at": 5.0, "length": 9.0, "angle_deg": 45.0}]},
        [],
        "steps[1].keyways[1].angle_deg",
        "or a flat",
    ),
    "keyway": (
        one(9.0) | {"keyways": [{"at": 5.0, "length": 9.0}]}, [], "steps[1].keyways[1].angle_deg", "or a flat"
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_flats_that_cannot_be_are_refused_by_their_key(name: str) -> None:
    keys, after, key, words = REFUSED[name]
    with pytest.raises(SceneError) as found:
        body_of(shaft(step(10.0, 20.0, **keys), *after))
    assert f"parts.part.{key}" in str(found.value)
    assert words in str(found.value)


def test_flats_leave_a_wall_to_the_bore_and_stand_on_no_spline() -> None:
    with pytest.raises(SceneError, match=r"steps\[1\].flats.flat = 7.0: .* at least 8.000008 mm"):
        body_of(shaft(step(10.0, 20.0, **one(7.0)), bore_diameter=6.0))
    with pytest.raises(SceneError, match=r"steps\[1\].flats: .*spline"):
        body_of(shaft(step(20.0, 30.0, **two(), spline={"shape": "spline", "size": "6x16x20"})))

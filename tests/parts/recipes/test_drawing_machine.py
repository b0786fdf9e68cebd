"""The drawing machine: what its files draw, by polygons of them alone that a roller lies on, against the picture."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import ezdxf
import ezdxf.path
import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from exporters.command.cli import main
from exporters.production.check import scene_checks
from parts.base.refusal import SceneError
from parts.cams.disk_cam.part import cam_of
from parts.scene.load import load_scene, make_parts, resolved, scene_from_dict
from parts.scene.placing import place
from tests.sampling import examples

# a house with sharp corners and one chimney, the roof's tip first
HOUSE = [[0.0, 9.0], [-5.0, 5.0], [-4.0, 0.0], [4.0, 0.0], [5.0, 5.0], [3.5, 6.2], [3.5, 8.0], [2.0, 8.0], [2.0, 7.4]]


def scene(picture: object = HOUSE, **keys: object) -> dict[str, Any]:
    told = {"kind": "drawing_machine", "picture": picture, **keys}
    return {"assemblies": [told], "exports": [{"format": "dxf"}]}


def written(folder: Path, **keys: object) -> Path:
    """A scene as a file."""
    rows = "\n".join(f"{key} = {value}" for key, value in keys.items())
    file = folder / "s.toml"
    text = f'[[assemblies]]\nkind = "drawing_machine"\n{rows}\n[[exports]]\nformat = "dxf"\ntolerance = 0.002\n'
    file.write_text(text, encoding="utf-8")
    return file


def lines(file: Path, layer: str) -> list[np.ndarray]:
    """The polylines of a layer, arcs within a thousandth of a mm."""
    found = []
    for entity in ezdxf.readfile(file).modelspace():
        if entity.dxf.layer == layer:
            points = [(p.x, p.y) for p in ezdxf.path.make_path(entity).flattening(1e-3)]
            found.append(np.array(points))
    return found


def rolled(cam: Path, roller: float, angles: np.ndarray) -> np.ndarray:
    """How far a roller's centre stands from the axis over a cam's outline, along +y of a cam that turns so, rad."""
    (outline,) = lines(cam, "CUT_OUTER")
    # its last place is the first one again but for rounding
    grown = shapely.Polygon(outline[:-1]).buffer(roller, quad_segs=128)
    found = []
    for angle in angles:
        way = np.array([math.sin(angle), math.cos(angle)])
        found.append(np.abs(np.array(shapely.LineString([(0, 0), 500 * way]).intersection(grown).coords)).max(axis=0))
    return np.array([math.hypot(x, y) for x, y in found])


def middles(file: Path) -> list[complex]:
    """Of what is cut within a part, round holes and slots, by the box."""
    found = [(one.max(axis=0) + one.min(axis=0)) / 2 for one in lines(file, "CUT_INNER")]
    return [complex(*at) for at in found]


def apart(one: np.ndarray, two: np.ndarray) -> float:
    """The distance of two closed lines, both ways, at points at most 0.1 mm apart."""
    rings = [shapely.LinearRing(line) for line in (one, two)]
    points = [shapely.points(shapely.get_coordinates(shapely.segmentize(ring, 0.1))) for ring in rings]
    return float(max(shapely.distance(points[0], rings[1]).max(), shapely.distance(points[1], rings[0]).max()))


@pytest.mark.parametrize("keys", [
    {"picture": HOUSE, "size": 40.0, "smoothing": 0.5},
    pytest.param({"picture": HOUSE, "size": 60.0, "smoothing": 0.2, "start_point": 3, "backwards": "true"},
                 marks=pytest.mark.heavy),
])  # fmt: skip
def test_the_cams_of_the_files_draw_the_picture(keys: dict[str, Any], tmp_path: Path) -> None:
    """Rolled over the polygons that are cut; the pen over the table by the holes of both, against engraved line and
    picture. Another corner at the start than asked for would stand elsewhere.
    """
    names = [word for part in ("cam_x", "cam_y", "table", "slide") for word in ("--part", part)]
    assert main(["build", str(written(tmp_path, **keys)), "--out", str(tmp_path), "-q", *names]) == 0
    angles = np.linspace(0, 2 * math.pi, 720, endpoint=False)
    x, y = (rolled(tmp_path / "s" / f"cam_{name}.dxf", 6.0, angles) for name in "xy")
    # of the slide: its roller's pin, the pen's hole beside that; the table hangs on its roller's pin
    pen = max(middles(tmp_path / "s" / "slide.dxf"), key=lambda at: at.real)
    assert pen.imag == pytest.approx(0.0, abs=1e-9)
    assert any(abs(at) < 1e-6 for at in middles(tmp_path / "s" / "slide.dxf"))
    assert any(abs(at) < 1e-6 for at in middles(tmp_path / "s" / "table.dxf"))
    drawn = np.column_stack([pen.real - x, y])
    (engraved,) = lines(tmp_path / "s" / "table.dxf", "ENGRAVE")
    assert apart(drawn, engraved[:-1]) <= keys["smoothing"] + 0.01
    # the engraved line is the picture, as large as asked for
    picture = np.array(HOUSE) * keys["size"] / 10
    assert np.ptp(engraved, axis=0).max() == pytest.approx(keys["size"], abs=1e-6)
    moved = picture - picture.min(axis=0) + engraved.min(axis=0)
    assert apart(moved, engraved[:-1]) < 1e-6
    # smoothed as far as allowed, not left sharp
    assert apart(drawn, engraved[:-1]) > keys["smoothing"] / 2
    # it begins where asked, and goes on to the next corner, all at one pace
    first = keys.get("start_point", 1) - 1
    order = -1 if keys.get("backwards") else 1
    assert np.hypot(*(drawn[0] - moved[first])) <= keys["smoothing"] + 0.01
    second = moved[(first + order) % len(moved)]
    around = np.linalg.norm(np.diff(np.vstack([moved, moved[:1]]), axis=0), axis=1).sum()
    share = np.hypot(*(second - moved[first])) / around
    assert np.hypot(*(drawn[round(720 * share)] - second)) <= keys["smoothing"] + 0.02 * keys["size"]
    # pressure angles of both cams, by differences
    for way in (x, y):
        slope = (np.roll(way, -1) - np.roll(way, 1)) / (angles[2] - angles[0])
        assert math.degrees(np.arctan(np.abs(slope) / way).max()) <= 30.3
    # the report tells the same, and the machine stands at the start
    report = json.loads((tmp_path / "s" / "report.json").read_text("utf-8"))
    assert report["instances"]["table"]["at"][:2] == pytest.approx([x[0], 0.0], abs=0.005)
    assert report["instances"]["slide"]["at"][:2] == pytest.approx([0.0, y[0]], abs=0.005)
    (told,) = [mate for mate in report["checks"]["mates"] if mate["kind"] == "drawing_cams"]
    assert max(told["picture_error"], told["corner_cut"]) == pytest.approx(apart(drawn, engraved[:-1]), abs=0.02)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("start", [1, 4])
def test_backwards_the_pen_begins_at_the_same_corner(start: int) -> None:
    """And goes through the same places at the same distance from there, the other way round."""
    ways = []
    for backwards in (False, True):
        parts = scene_from_dict(scene(start_point=start, backwards=backwards), "s.toml", "s").parts
        tables = (np.array(parts[name].motion_table) for name in ("cam_x", "cam_y"))
        ways.append([np.interp(np.arange(0, 360, 5), *table.T, period=360) for table in tables])
    for one, other in zip(*ways, strict=True):
        assert np.abs(one - np.roll(other[::-1], 1)).max() < 1e-6


def test_a_line_that_is_missed_is_told_either_way(tmp_path: Path) -> None:
    """By the mate on its own two cams: nearer or farther than they come, and with a spike that the pen leaves out."""
    tables = resolved(load_scene(str(written(tmp_path, picture=HOUSE))))
    (own,) = [mate for mate in tables["mates"] if mate["kind"] == "drawing_cams"]
    cams = {name: tables["parts"][name] for name in ("cam_x", "cam_y")}

    def told(line: list[list[float]], tolerance: float) -> tuple[dict[str, Any], list[str]]:
        raw = {"parts": cams, "mates": [{**own, "line": line, "tolerance": tolerance}]}
        made = scene_from_dict(raw, "t", "t")
        parts, matings = make_parts(made, "t")
        placing = place(made.instances, made.drives, parts, matings, "t")
        (mate,) = scene_checks(placing, parts, made.drives, "en", contact=False)["mates"]
        return mate, [one["code"] for one in mate.get("findings", ())]

    mate, codes = told(own["line"], 5.0)
    off = max(mate["picture_error"], mate["corner_cut"])
    assert codes == []
    assert told(own["line"], 1.01 * off)[1] == []
    assert told(own["line"], 0.99 * off)[1] == ["picture_missed"]
    (x, y), *others = own["line"]
    spiked, codes = told([[x, y], [x + 30.0, y + 40.0], [x, y], *others], 5.0)
    assert spiked["picture_error"] <= off + 1e-6
    assert spiked["corner_cut"] == pytest.approx(50.0, abs=10.0)
    assert codes == ["picture_missed"]


def test_cams_with_a_swinging_follower_draw_nothing() -> None:
    phases = [{"move": move, "angle_deg": 180.0, "law": "sine"} for move in ("rise", "return")]
    swings = {"kind": "cam", "swing_deg": 15.0, "base_circle_radius": 30.0, "follower_radius": 8.0, "phases": phases,
              "follower": "roller", "oscillating": {"centre_distance": 90.0, "arm_length": 80.0}}  # fmt: skip
    mate = {"kind": "drawing_cams", "first": "a", "second": "b", "line": HOUSE}
    with pytest.raises(SceneError) as found:
        make_parts(scene_from_dict({"parts": {"a": swings, "b": swings}, "mates": [mate]}, "t", "t"), "t")
    assert (found.value.key, found.value.code) == ("mates[1].first", "draws_by_sliding")


def test_it_goes_together_and_round(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = written(tmp_path, picture=HOUSE)
    file.write_text(file.read_text("utf-8") + "[checks]\ninterference = true\n", encoding="utf-8")
    assert main(["check", str(file)]) == 0
    said = capsys.readouterr().out
    assert "each part reaches its place straight" in said
    assert said.count("CONTACT, least gap") == 2
    assert re.search(r"solids in motion: \d+ pairs over the period of each", said)


@pytest.mark.heavy
@pytest.mark.parametrize("keys", [
    {"size": 10.0, "smoothing": 1.0}, {"size": 20.0, "smoothing": 0.05, "follower_radius": 15.0},
], ids=["room about the shaft", "curvature"])  # fmt: skip
def test_where_the_pressure_angle_asks_for_small_cams_something_else_keeps_them_large(
    keys: dict[str, Any], tmp_path: Path
) -> None:
    """Small pictures, whose slides are kept off the shaft, and sharp ones under a large roller, that would undercut."""
    file = written(tmp_path, picture=HOUSE, greatest_pressure_angle_deg=60.0, **keys)
    file.write_text(file.read_text("utf-8") + "[checks]\ninterference = true\n", encoding="utf-8")
    assert main(["check", str(file)]) == 0


def test_a_large_roller_has_four_fifths_of_the_least_radius() -> None:
    """Of the path of its centre, by its second differences, where pressure angles leave smaller cams."""
    keys = {"size": 20.0, "smoothing": 0.05, "follower_radius": 15.0, "greatest_pressure_angle_deg": 60.0}
    parts = scene_from_dict(scene(**keys), "s.toml", "s").parts
    angles = np.linspace(0, 2 * math.pi, 36_000, endpoint=False)
    for name in ("cam_x", "cam_y"):
        # the cam turns counter-clockwise under its roller
        path = np.asarray(cam_of(parts[name]).reference_point(angles)) * np.exp(-1j * angles)
        after, before = np.roll(path, -1) - path, path - np.roll(path, 1)
        bends = 2 * (before.conj() * after).imag / (np.abs(before * after) * np.abs(before + after))
        # travelled clockwise
        assert np.median(bends) < 0
        assert 0.8 / -bends.min() >= 15.0 * (1 - 1e-3)


def test_the_longest_crank_passes_the_pen_by_a_millimetre() -> None:
    """Its round end, and the pen where that comes nearest to the shaft; what is offered is the longest."""
    with pytest.raises(SceneError) as found:
        scene_from_dict(scene(crank_length=90.0), "s.toml", "s")
    assert found.value.nearest is not None
    longest = found.value.nearest.value
    assert isinstance(longest, float)
    made = scene_from_dict(scene(crank_length=longest), "s.toml", "s")
    parts: Any = made.parts
    lift = np.asarray(cam_of(parts["cam_y"]).motion.value(np.linspace(0, 2 * math.pi, 3600)))
    low = parts["cam_y"].base_circle_radius + 6.0 + lift.min()
    pen = max((at for one in parts["slide"].layers[0].circles for at in [one.at]), key=lambda at: at[0])[0]
    gap = math.hypot(pen, low) - longest - parts["crank"].width / 2 - parts["pen"].diameter / 2
    assert gap == pytest.approx(1.0, abs=2e-3)


ZIGZAG = [[4.1, 5.5], [4.3, -6.1], [2.4, -4.2], [-4.1, -4.4], [-8.8, -6.8], [3.1, 5.3], [-7.1, 8.0], [-0.6, 5.1],
          [-8.3, -7.6], [5.7, -7.3], [-8.3, 2.8], [-8.2, -1.5]]  # fmt: skip


@pytest.mark.parametrize("keys", [
    {"picture": ZIGZAG, "smoothing": 20.0, "follower_radius": 30.0},
    {"picture": [[-8.3, -6.4], [8.7, -2.7], [5.4, 8.5], [6.4, 5.3]], "size": 5.0, "greatest_pressure_angle_deg": 60.0,
     "follower_radius": 10.0, "axle_diameter": 28.1},
    {"picture": [[8.3, 0.6], [-7.7, -9.1], [-2.9, 2.0], [2.1, 0.1]], "size": 57.0, "axle_diameter": 56.0},
], ids=["a picture far from its line", "a thick shaft", "a shaft as thick as the crank is long"])  # fmt: skip
def test_table_crank_and_cams_have_room_for_picture_and_holes(keys: dict[str, Any]) -> None:
    """They were refused in keys of parts that nobody had typed: strokes of the table, holes of cams and crank."""
    make_parts(scene_from_dict(scene(**keys), "s.toml", "s"), "s.toml")


def test_a_cam_turned_on_the_shaft_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Negative control: the second cam stands a quarter ahead, or is told off; a picture that is missed is told."""
    made = written(tmp_path, picture=HOUSE)
    more = '[[mates]]\nkind = "drawing_cams"\nfirst = "cam_y"\nsecond = "cam_x"\nheight = -3.0\ntolerance = 1.0\n'
    made.write_text(made.read_text("utf-8") + more + "line = [[0, 0], [9, 0], [9, 9]]\n", encoding="utf-8")
    assert main(["check", str(made)]) == 1
    said = capsys.readouterr().out
    assert "Cam of the table stands turned off Cam of the pen" in said
    assert "more than 1 mm" in said


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("keys", "code", "key"), [
    ({"picture": [[0, 0], [10, 0], [20, 0]]}, "picture_is_flat", "picture"),
    ({"picture": [[1, 1], [1, 1], [1, 1]]}, "picture_is_flat", "picture"),
    ({"start_point": 10}, "fewer_corners", "start_point"),
    ({"smoothing": 40.0}, "rest_within_tolerance", "smoothing"),
    ({"smoothing": 0.01, "size": 200.0, "follower_radius": 40.0}, "cams_too_large", "smoothing"),
    ({"size": 100.0, "greatest_pressure_angle_deg": 5.0}, "cams_too_large", "greatest_pressure_angle_deg"),
    ({"prime_circle_radius": 20.0}, "prime_circle_too_small", "prime_circle_radius"),
    ({"crank_length": 90.0}, "crank_meets_pen", "crank_length"),
    ({"crank_length": 20.0, "axle_diameter": 44.0}, "no_wall_beside_holes", "crank_length"),
    ({"slide_width": 10.0}, "no_wall_beside_holes", "slide_width"),
    ({"roller_pin_diameter": 9.9}, "no_wall_beside_holes", "follower_radius"),
    ({"clearance": 2.0}, "pins_lie_loose", "clearance"),
    ({"guide_pin_spacing": 5.0}, "no_wall_beside_holes", "guide_pin_spacing"),
])  # fmt: skip
def test_what_cannot_be_is_refused_with_what_works(keys: dict[str, Any], code: str, key: str) -> None:
    with pytest.raises(SceneError) as found:
        scene_from_dict(scene(**keys), "s.toml", "s")
    assert found.value.code == code
    assert found.value.key == f"assemblies[1].{key}"
    if code == "picture_is_flat":
        return
    assert found.value.nearest is not None
    scene_from_dict(scene(**keys | {key: found.value.nearest.value}), "s.toml", "s")


@st.composite
def blobs(draw: st.DrawFn) -> list[list[float]]:
    """Corners of a smooth closed line that may cross itself."""
    waves = st.tuples(st.floats(0, 0.35), st.floats(0, 2 * math.pi))
    t = np.linspace(0, 2 * math.pi, draw(st.integers(12, 90)), endpoint=False)
    radius = 1 + sum(size * np.cos((k + 2) * t + at) for k, (size, at) in enumerate(draw(st.lists(waves, max_size=4))))
    flat = draw(st.floats(0.3, 1.0))
    return [[float(x), float(y)] for x, y in zip(radius * np.cos(t), flat * radius * np.sin(t), strict=True)]


@examples(15)
@given(picture=blobs(), size=st.floats(15, 80), smoothing=st.floats(0.05, 1.0))
def test_any_smooth_picture_is_drawn(picture: list[list[float]], size: float, smoothing: float) -> None:
    """By the motions of both cams: within the smoothing, both ways, and with the pressure angle asked for."""
    made = scene_from_dict(scene(picture, size=size, smoothing=smoothing), "s.toml", "s")
    angles = np.linspace(0, 2 * math.pi, 1440, endpoint=False)
    lifts = []
    for keys in (made.parts["cam_x"], made.parts["cam_y"]):
        cam = cam_of(keys)
        lift = np.asarray(cam.motion.value(angles))
        slope = (np.roll(lift, -1) - np.roll(lift, 1)) / (angles[2] - angles[0])
        centre = np.abs(np.asarray(cam.reference_point(angles)))
        assert np.allclose(centre - lift, keys.base_circle_radius + 6.0)
        assert math.degrees(np.arctan(np.abs(slope) / centre).max()) <= 30.1
        lifts.append(lift)
    wanted = np.array(picture)
    wanted = (wanted - [wanted[:, 0].max(), wanted[:, 1].min()]) * size / np.ptp(wanted, axis=0).max()
    drawn = np.column_stack([-lifts[0], lifts[1]])
    assert apart(drawn, wanted) <= smoothing + 2e-3 * size


def test_a_picture_of_a_file_is_that_of_its_corners(tmp_path: Path) -> None:
    path = "M" + " ".join(f"{x},{-y}" for x, y in HOUSE) + "Z"
    (tmp_path / "house.svg").write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{path}"/></svg>', "utf-8")
    told = load_scene(str(written(tmp_path, picture='{ file = "house.svg" }')))
    assert told.parts == load_scene(str(written(tmp_path, picture=HOUSE))).parts


def test_refusals_of_a_strange_file_name_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = written(tmp_path, picture='{ file = "none.svg" }')
    assert main(["check", str(file)]) == 2
    assert "assemblies[1].picture.file" in capsys.readouterr().err

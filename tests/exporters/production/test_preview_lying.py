"""What lies, what has pins of one piece, and outlines of very many curves, in the picture of a scene."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
import shapely

from exporters.command.cli import main
from exporters.production.plan import plan_build
from exporters.production.preview import outlines_of, part_preview, scene_preview
from geometry.curves.line_arc import Line
from geometry.plane.profile import Label, Profile, Region, Segment
from parts.scene.load import scene_from_toml
from tests.exporters.production.test_preview_places import SVG, opened, rings, words

BLOCK = '[parts.block]\nkind = "plate"\nwidth = 20.0\nheight = 10.0\nface_width = 4.0\n'
BASE = (
    '[parts.base]\nkind = "plate"\nwidth = 100.0\nheight = 60.0\nface_width = 2.0\n[instances.base]\nat = [0, 0, 0]\n'
)
# three levels: its rim from 0 to 3, its hub to 11
HUB = (
    '[parts.block]\nkind = "spur_gear"\nmodule = 1.0\nnumber_of_teeth = 20\nface_width = 3.0\nbore_diameter = 4.0\n'
    "hub = { diameter = 9.0, above = 8.0 }\n"
)
WORD = re.compile("block|base")


def seen(text: str, folder: Path) -> tuple[dict[str, list[np.ndarray]], list[tuple[str, complex, float]]]:
    """Loops of each instance, y upwards about the middle of the base; words with place and size."""
    text = re.sub(r"\[parts\.(\w+)\]\n", r'[parts.\1]\ntitle = "\1"\n', text)
    plan = plan_build(scene_from_toml((text + '[[exports]]\nformat = "stl"\n').encode(), "s.toml", "s"), "s", [], [])
    outlines = {key: outlines_of(part.section(0.0).region) for key, part in plan.parts.items()}
    root, _, _ = opened(scene_preview(plan, outlines, {}, folder))
    paths = [rings(path) for path in root.iter(f"{SVG}path")]
    order = sorted(plan.placing.instances, key=lambda i: i.at[2])
    base = paths[[i.id for i in order].index("base")][0]
    middle = complex((base.real.min() + base.real.max()) / 2, (base.imag.min() + base.imag.max()) / 2)
    loops = {i.id: [np.conj(loop - middle) for loop in own] for i, own in zip(order, paths, strict=False)}
    told = [(name, complex(x, y) - middle, size) for name, x, y, size in words(root) if WORD.fullmatch(name)]
    return loops, [(name, at.conjugate(), size) for name, at, size in told]


def turned(axis: tuple[float, float, float], turn: float, points: np.ndarray) -> np.ndarray:
    """Turned about z, then z laid on an axis by the shortest way (Rodrigues)."""
    unit = np.array(axis) / np.linalg.norm(axis)
    k = np.cross([0.0, 0.0, 1.0], unit)
    sine, cosine = np.linalg.norm(k), unit[2]
    k = k / sine
    cross = np.array([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    laid = np.eye(3) + sine * cross + (1 - cosine) * cross @ cross
    c, s = math.cos(turn), math.sin(turn)
    return points @ (laid @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])).T


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (1.0, 1.0, 1.0), (-0.6, 0.2, -0.3)])
def test_a_box_that_lies_is_seen_as_the_hull_of_its_corners(axis: tuple[float, float, float], tmp_path: Path) -> None:
    """No corner is missing, nothing drawn beyond; its name stands about the middle."""
    place = f"[instances.block]\nat = [12, -7, 35]\nrotation_deg = 25.0\naxis = {list(axis)}\n"
    sides = BLOCK.replace("20.0", "40.0").replace("10.0", "30.0").replace("4.0", "16.0")
    loops, told = seen(sides + BASE + place, tmp_path)
    corners = np.array([[x, y, z] for x in (-20, 20) for y in (-15, 15) for z in (0, 16)], dtype=float)
    spots = turned(axis, math.radians(25), corners)[:, :2] + np.array([12, -7])
    exact = shapely.MultiPoint(spots).convex_hull
    (loop,) = loops["block"]
    drawn = shapely.Polygon(np.column_stack([loop.real, loop.imag]))
    assert drawn.symmetric_difference(exact).area < 1e-5 * exact.area
    assert all(np.abs(loop - complex(*corner)).min() < 1e-4 for corner in exact.exterior.coords)
    (at,) = (at for name, at, _ in told if name == "block")
    (x0, y0, x1, y1), size = exact.bounds, np.sqrt(exact.area)
    assert abs(at - complex(x0 + x1, y0 + y1) / 2) < 0.2 * size


def test_a_hub_that_lies_is_seen_to_its_end(tmp_path: Path) -> None:
    """As long as all of it, as wide as its teeth; upright the picture has its bore."""
    where = "[instances.block]\nat = [5, 0, 15]\n"
    loops, _ = seen(HUB + BASE + where + "axis = [1.0, 0.0, 0.0]\n", tmp_path)
    (loop,) = loops["block"]
    assert (loop.real.min(), loop.real.max()) == pytest.approx((5, 16), abs=1e-3)
    assert (loop.imag.min(), loop.imag.max()) == pytest.approx((-11, 11), abs=0.01)
    upright, _ = seen(HUB + BASE + where, tmp_path)
    assert len(upright["block"]) == 2


def test_a_gear_turned_over_is_seen_from_its_back(tmp_path: Path) -> None:
    """With its bore, its teeth where a turn about x has brought them: those of the upright one, mirrored and turned."""
    where = "[instances.block]\nat = [5, 0, 15]\nrotation_deg = 4.0\n"
    upright, over = (seen(HUB + BASE + where + axis, tmp_path)[0]["block"] for axis in ("", "axis = [0, 0, -1]\n"))
    assert len(over) == len(upright) == 2
    for loop, other in zip(over, upright, strict=True):
        own = (other - 5) * np.exp(-1j * math.radians(4))
        assert np.allclose(loop, own.conj() * np.exp(-1j * math.radians(4)) + 5, atol=2e-3)


def test_pins_of_one_piece_are_filled_where_they_stand(tmp_path: Path) -> None:
    """Six pins of 3 mm on 16 mm, in a plate turned by 20 degrees about (30, 5); a bore is no pin."""
    plate = (
        '[parts.block]\nkind = "output_plate"\nnumber_of_pins = 6\npin_circle_diameter = 16.0\npin_diameter = 3.0\n'
        'pin_length = 5.0\npins = "solid"\nouter_diameter = 26.0\nbore_diameter = 4.0\nface_width = 3.0\n'
    )
    text = plate + BASE + "[instances.block]\nat = [30, 5, 2]\nrotation_deg = 20.0\n"
    plan = plan_build(scene_from_toml((text + '[[exports]]\nformat = "stl"\n').encode(), "s.toml", "s"), "s", [], [])
    outlines = {key: outlines_of(part.section(0.0).region) for key, part in plan.parts.items()}
    root, _, _ = opened(scene_preview(plan, outlines, {}, tmp_path))
    paths = list(root.iter(f"{SVG}path"))
    (pins,) = (path for path in paths if "#7f8c99" in path.get("style", ""))
    base = rings(paths[0])[0]
    middle = complex((base.real.min() + base.real.max()) / 2, (base.imag.min() + base.imag.max()) / 2)
    round_ = [np.conj(loop - middle) for loop in rings(pins)]
    centres = np.array([complex(loop[:-1].mean()) for loop in round_])
    exact = 30 + 5j + 8 * np.exp(1j * (math.radians(20) + math.tau * np.arange(6) / 6))
    assert len(centres) == 6
    assert all(np.abs(exact - centre).min() < 0.01 for centre in centres)
    assert all(np.abs(loop - centre) == pytest.approx(np.full(len(loop), 1.5), abs=0.01)
               for loop, centre in zip(round_, centres, strict=True))  # fmt: skip


def star(count: int) -> Region:
    """A zigzag of so many lines between circles of 9 and 10 mm."""
    radii = np.where(np.arange(count) % 2 == 0, 9.0, 10.0)
    points = radii * np.exp(1j * math.tau * np.arange(count) / count)
    lines = [Segment(Line(complex(a), complex(b)), Label.RIM) for a, b in zip(points, np.roll(points, -1), strict=True)]
    return Region(Profile(tuple(lines), 1, clockwise=False))


@pytest.mark.parametrize("count", [300, 302])
def test_an_outline_of_many_curves_is_drawn_by_points_of_each(count: int) -> None:
    """Up to 300 curves as they are, of more eight points of each, all of them on it."""
    (made,) = outlines_of(star(count))
    vertices, bulges = made.geometry.expanded()
    assert len(vertices) == (count if count <= 300 else 8 * count)
    assert not bulges.any()
    exact = shapely.Polygon([(s.curve.start.real, s.curve.start.imag) for s in star(count).outer.period])
    drawn = shapely.Polygon(np.column_stack([vertices.real, vertices.imag]))
    assert drawn.symmetric_difference(exact).area < 1e-9
    assert (made.max_error, made.tolerance) == pytest.approx((2e-3, 2e-3) if count > 300 else (0, 2e-3), abs=1e-9)


def test_a_part_s_own_picture_has_its_remarks_its_name_and_nothing_over_its_edge(tmp_path: Path) -> None:
    text = BLOCK.replace("face_width", 'title = "Block"\nlabel = true\ncolour = "#123456"\nface_width')
    plan = plan_build(scene_from_toml((text + '[[exports]]\nformat = "dxf"\n').encode(), "s.toml", "s"), "s", [], [])
    part = plan.parts["block"]
    root, (width, height), _ = opened(part_preview(part, outlines_of(part.section(0.0).region), tmp_path, "en"))
    fill, name = root.iter(f"{SVG}path")
    middle = 10.8 + 5.8j
    assert "fill:#123456" in fill.get("style", "")
    assert "stroke:#0000ff" in name.get("style", "")
    (box,) = rings(fill)
    assert sorted((round(p.real, 4), round(p.imag, 4)) for p in {p - middle for p in box.tolist()}) == [
        (-10, -5), (-10, 5), (10, -5), (10, 5)
    ]  # fmt: skip
    for stroke in rings(name):
        assert np.abs((stroke - middle).real).max() < 10
        assert np.abs((stroke - middle).imag).max() < 5
    told = words(root)
    assert told[0][0] == "Block"
    assert width > 2 * middle.real
    assert height == pytest.approx(max(2 * middle.imag, 1.7 * 2 * told[0][3]), rel=1e-3)


def test_what_is_turned_shows_its_axial_section_below_the_view_along_its_axis(tmp_path: Path) -> None:
    """A shaft of two steps was a circle: its section is as long and as thick, each step where it is."""
    table = (
        '[parts.a]\nkind = "shaft"\nsteps = [{ diameter = 12.0, length = 70.0 }, { diameter = 20.0, length = 30.0 }]\n'
    )
    scene = tmp_path / "turned.toml"
    scene.write_text(table + '[[exports]]\nformat = "svg"\n', encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path), "-q"]) == 0
    shown = (tmp_path / "turned" / "a.preview.svg").read_text(encoding="utf-8")
    paths = [np.array(re.findall(r"[ML]([-\d.]+),([-\d.]+)", d), float) for d in re.findall(r' d="([^"]+)"', shown)]
    (places,) = [p for p in paths if len(p) > 8]
    middle = (places[:, 1].min() + places[:, 1].max()) / 2
    ends = {(round(x - places[:, 0].min(), 3), round(abs(y - middle), 3)) for x, y in places.tolist()}
    assert ends == {(x, r) for x, radii in ((0, (0, 6)), (70, (6, 10)), (100, (0, 10))) for r in radii}
    wide, high = (float(v) for v in re.findall(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', shown)[0])
    assert places[:, 0].max() < wide
    assert places[:, 1].max() < high

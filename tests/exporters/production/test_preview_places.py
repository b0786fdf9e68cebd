"""Pictures of a part, of a scene and of a board: outlines, circles, names and words where they belong."""

from __future__ import annotations

import json
import math
import re
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import ezdxf
import numpy as np
import pytest
import shapely

from exporters.production.preview import _cross
from exporters.production.recheck import recheck
from tests.exporters.making import run
from tests.exporters.production.test_checks_told import PARTS

SVG = "{http://www.w3.org/2000/svg}"
LETTER = 0.6
NAMES = ("Gear a", "Gear b", "Plate")


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two gears in mesh and a slab beside them; all three on a board, with their names."""
    folder = tmp_path_factory.mktemp("built")
    exports = '[[exports]]\nformat = "svg"\n[[exports]]\nformat = "dxf"\npurpose = "board"\n'
    labelled = PARTS.replace("[parts.slab]\n", "[parts.slab]\nlabel = true\n")
    (folder / "s.toml").write_text(labelled + exports, encoding="utf-8")
    assert run("build", folder / "s.toml", "--out", folder, "-q", "--no-verify") == 0
    return folder / "s"


def opened(file: Path) -> tuple[ElementTree.Element, tuple[float, float], complex]:
    """The picture, its size, and where what is moved in it stands."""
    root = ElementTree.parse(file).getroot()
    left, top, width, height = map(float, root.get("viewBox", "").split())
    assert (left, top) == (0, 0)
    assert [root.get(key, "").removesuffix("mm") for key in ("width", "height")] == [
        f"{s:.11g}" for s in (width, height)
    ]
    moved = [g.get("transform", "") for g in root.iter(f"{SVG}g")]
    x, y = re.findall(r"translate\(([-\d.]+) ([-\d.]+)\)", moved[0])[0] if moved else (0, 0)
    return root, (width, height), complex(float(x), float(y))


def rings(path: ElementTree.Element) -> list[np.ndarray]:
    """The corners of each loop of a path, arcs by their ends and middle."""
    found = []
    for loop in path.get("d", "").split("M")[1:]:
        rows = re.findall(r"([LA]?)([^LAZ]+)", loop)
        points: list[complex] = []
        for kind, text in rows:
            if not (numbers := [float(n) for n in re.findall(r"-?[\d.]+", text)]):
                continue
            end = complex(*numbers[-2:])
            if kind == "A":
                chord, radius = end - points[-1], numbers[0]
                side = -1 if numbers[4] else 1
                rise = radius - math.sqrt(max(radius**2 - abs(chord) ** 2 / 4, 0.0))
                # y is downwards: an arc that is clockwise for the eye bulges to the left of its way
                points.append((points[-1] + end) / 2 + side * 1j * chord / abs(chord) * rise)
            points.append(end)
        found.append(np.array(points))
    return found


def shape(path: ElementTree.Element, by: complex = 0j) -> shapely.Polygon:
    made = [shapely.Polygon([(p.real, p.imag) for p in ring + by]).buffer(0) for ring in rings(path)]
    made.sort(key=lambda polygon: -polygon.area)
    return made[0].difference(shapely.union_all(made[1:]))


def words(root: ElementTree.Element) -> list[tuple[str, float, float, float]]:
    """Each with where it begins or has its middle, and its size."""
    found = []
    for text in root.iter(f"{SVG}text"):
        scale = float((re.findall(r"scale\(([\d.]+)\)", text.get("transform", "")) or [1])[0])
        size = float(re.findall(r"font-size:([\d.]+)", text.get("style", ""))[0])
        x, y = float(text.get("x", "")), float(text.get("y", ""))
        found.append(("".join(text.itertext()), scale * x, scale * y, scale * size))
    return found


def test_a_part_stands_in_the_middle_with_its_circles_and_its_numbers_beside_it(built: Path) -> None:
    root, (width, height), _ = opened(built / "a.preview.svg")
    middle = round(1.08 * 14, 6)
    outline = shape(next(root.iter(f"{SVG}path")))
    assert (outline.centroid.x, outline.centroid.y) == pytest.approx((middle, middle), abs=1e-3)
    assert height == pytest.approx(max(2 * middle, 0))
    assert shapely.Point(middle, middle).distance(outline) == pytest.approx(2.5, abs=0.1)
    circles = {round(2 * float(c.get("r", "")), 3) for c in root.iter(f"{SVG}circle")}
    told = words(root)
    for name, diameter in (("tip diameter", 28.0), ("reference diameter", 24.0), ("root diameter", 19.0),
                           ("base diameter", 24 * math.cos(math.radians(20)))):  # fmt: skip
        assert round(diameter, 3) in circles
        assert any(text.startswith(name) and text.endswith(f"\xa0mm\xa0\xa0{diameter:.4f}") for text, *_ in told)
    assert all(c.get("cx") == c.get("cy") == f"{middle:g}" for c in root.iter(f"{SVG}circle"))
    lines = {tuple(float(e.get(k, "")) for k in ("x1", "y1", "x2", "y2")) for e in root.iter(f"{SVG}line")}
    low, high = middle - 1.05 * 14, middle + 1.05 * 14
    assert {tuple(round(x, 6) for x in line) for line in lines} == {
        (round(low, 6), middle, round(high, 6), middle), (middle, round(low, 6), middle, round(high, 6))}  # fmt: skip
    heights = [y for _, _, y, _ in told]
    assert np.diff(heights) == pytest.approx(np.full(len(heights) - 1, 1.7 * told[0][3]), abs=0.01)
    for text, x, y, size in told:
        assert 2 * middle < x < x + LETTER * size * len(text) < width
        assert 0 < y < height


def test_instances_stand_as_far_apart_as_they_are_and_their_names_on_them(built: Path) -> None:
    root, (width, height), by = opened(built / "s.preview.svg")
    one, two, slab = (shape(path, by) for path in root.iter(f"{SVG}path"))
    assert two.centroid.x - one.centroid.x == pytest.approx(27.0, abs=2e-3)
    assert two.centroid.y == pytest.approx(one.centroid.y, abs=2e-3)
    assert slab.area == pytest.approx(600.0, rel=1e-6)
    ends = np.array([p.bounds for p in (one, two, slab)])
    reach = (ends[:, 2].max() - ends[:, 0].min()) / 2
    assert width == pytest.approx(2 * 1.08 * reach, rel=1e-4)
    assert ends[:, 0].min() == pytest.approx(0.08 * reach, rel=1e-3)
    assert ends[:, 2].max() == pytest.approx(width - 0.08 * reach, rel=1e-3)
    told = words(root)
    names = [(text, x + by.real, y + by.imag, size) for text, x, y, size in told if text in NAMES]
    for (name, x, y, size), polygon, middle in zip(names, (one, two, slab), (one, two, slab), strict=True):
        assert size == pytest.approx(reach / 30, rel=1e-3)
        assert x == pytest.approx(middle.centroid.x, abs=0.01), name
        # on its material, not in the bore
        assert polygon.contains(shapely.Point(x, y - size / 4)), name
    caption = [row for row in told if row[0] not in NAMES]
    assert caption[0][0] == "s"
    low = max(y for _, _, y, _ in caption)
    # the caption above, all of the scene below it, and no more than a margin beneath
    assert low < ends[:, 1].min()
    assert ends[:, 3].max() == pytest.approx(height - 0.08 * reach, abs=0.02 * reach)
    assert all(x + 0.5 * size * len(text) < width for text, x, _, size in caption)


def test_a_board_holds_all_that_is_cut_from_it_and_says_what_that_is(built: Path) -> None:
    root, (width, height), _ = opened(built / "s.board.1.preview.svg")
    board, *samples = (r for r in root.iter(f"{SVG}rect") if r.get("width") != "100%")
    left, top, wide, high = (float(board.get(k, "")) for k in ("x", "y", "width", "height"))
    assert (wide, high) == (200.0, 200.0)
    assert left == top == pytest.approx(width - left - wide, abs=1e-3)
    filled = [path for path in root.iter(f"{SVG}path") if "fill:none" not in path.get("style", "")]
    named = [path for path in root.iter(f"{SVG}path") if "stroke:#0000ff" in path.get("style", "")]
    assert len(filled) == len(named) == 3
    table = shapely.box(left, top, left + wide, top + high)
    pieces = [shape(path) for path in filled]
    assert all(table.contains(piece) for piece in pieces)
    assert all(a.distance(b) > 1.0 for k, a in enumerate(pieces) for b in pieces[:k])
    assert 600.0 in [round(p.area, 1) for p in pieces]
    for piece, name in zip(pieces, named, strict=True):
        strokes = np.concatenate(rings(name))
        box = shapely.box(strokes.real.min(), strokes.imag.min(), strokes.real.max(), strokes.imag.max())
        assert piece.convex_hull.buffer(12).contains(box)
        assert 1.0 < np.ptp(strokes.imag) < 25
    told = words(root)
    assert told[0][0] == "s: 200 × 200 × 4"
    assert sorted(text.replace("\xa0", " ") for text, *_ in told[1:]) == [
        "1 × Gear a z 12 m 2",
        "1 × Gear b z 15 m 2",
        "1 × Plate slab",
    ]
    for (text, x, y, size), sample in zip(told[1:], samples, strict=True):
        sx, sy, side = (float(sample.get(k, "")) for k in ("x", "y", "width"))
        assert side == size
        # beside its colour, on its line, and clear of the next one
        assert (x, y) == pytest.approx((sx + 1.4 * size, sy + 0.8 * size), abs=1e-3)
        fill = re.findall(r"fill:(#\w+)", sample.get("style", ""))[0]
        own = [p for p, path in zip(pieces, filled, strict=True) if fill in path.get("style", "")]
        assert len(own) == 1
        assert (own[0].area == pytest.approx(600.0)) == (text == "1 × Plate slab")
        assert top + high < y < height
        following = [float(other.get("x", "")) for other in samples if float(other.get("x", "")) > sx]
        assert x + 0.45 * size * len(text) < min(following, default=width)


BARS = """
[beds.printer]
width = 200.0
depth = 200.0
height = 100.0
[[exports]]
format = "3mf"
purpose = "plate"
"""


def test_words_on_a_plate_s_pieces_are_as_large_as_these_have_room_for(tmp_path: Path) -> None:
    """Wide, narrow and small pieces: the name where it has room, else its number, never over the edge."""
    sizes = {"wide": (60.0, 20.0), "small": (3.2, 3.2), "short": (14.0, 8.0)}
    keys = "[parts.{}]\nkind = 'plate'\nwidth = {}\nheight = {}\nface_width = 4.0\n"
    text = "".join(keys.format(name, *size) for name, size in sizes.items())
    (tmp_path / "p.toml").write_text(text + BARS, encoding="utf-8")
    assert run("build", tmp_path / "p.toml", "--out", tmp_path, "-q", "--no-verify") == 0
    root, _, _ = opened(tmp_path / "p" / "p.plate.1.preview.svg")
    pieces = [shape(path) for path in root.iter(f"{SVG}path")]
    told = [(text.replace("\xa0", " "), x, y, size) for text, x, y, size in words(root)]
    seen = {}
    for piece in pieces:
        (word,) = [row for row in told if piece.contains(shapely.Point(row[1], row[2] - 0.35 * row[3]))]
        text, x, y, size = word
        half = 0.55 * size * len(text) / 2
        assert piece.buffer(0.02).contains(shapely.box(x - half, y - 0.85 * size, x + half, y + 0.15 * size))
        left, top, right, bottom = piece.bounds
        name = min(sizes, key=lambda n: abs(sizes[n][0] * sizes[n][1] - (right - left) * (bottom - top)))
        seen[name] = (text.lstrip("123 "), size)
    assert seen["wide"][0] == "Plate"
    assert seen["short"][0] in ("", "Plate")
    # a number alone, in letters of three quarters: larger ones are higher than the piece
    assert seen["small"] == ("", pytest.approx(0.75 * seen["wide"][1]))


def test_ways_and_lengths_of_a_board_are_those_of_its_file(built: Path) -> None:
    """In the order of the file: engraved strokes from end to end, contours round from where they begin."""
    file = built / "s.board.1.dxf"
    measured = recheck(file).verdict.measured
    at, way, engraved, cut = 0j, 0.0, 0.0, 0.0
    for entity in ezdxf.readfile(file).modelspace().query("LWPOLYLINE"):
        rows = [(complex(x, y), bulge) for x, y, bulge in entity.get_points("xyb")]
        way += abs(rows[0][0] - at)
        closed = entity.closed
        length = 0.0
        for (start, bulge), (end, _) in pairwise([*rows, rows[0]] if closed else rows):
            angle = 4 * math.atan(abs(bulge))
            length += abs(end - start) if not angle else abs(end - start) / 2 / math.sin(angle / 2) * angle
        at = rows[0][0] if closed else rows[-1][0]
        if closed:
            cut += length
        else:
            engraved += length
    assert measured["engraved_length"] == pytest.approx(engraved, rel=1e-9)
    assert measured["cut_length"] == pytest.approx(cut, rel=1e-9)
    assert measured["way_between"] == pytest.approx(way, rel=1e-9)


def test_the_locking_disc_of_a_driver_of_one_piece_is_seen_on_its_plate(tmp_path: Path) -> None:
    """Its widest and its hollow reach as far from the axis as the report says; the hollow is turned upwards."""
    (tmp_path / "s.toml").write_text(
        '[parts.cross]\nkind = "geneva_wheel"\nnumber_of_slots = 6\ncentre_distance = 60.0\n'
        '[parts.driver]\nkind = "geneva_driver"\nof = "cross"\n'
        '[[mates]]\nkind = "geneva_pair"\nfirst = "driver"\nsecond = "cross"\n'
        '[instances.driver]\nrotation_deg = 90.0\n[instances.cross]\n'
        '[[exports]]\nformat = "stl"\n', encoding="utf-8")  # fmt: skip
    assert run("build", tmp_path / "s.toml", "--out", tmp_path, "-q", "--no-verify") == 0
    root, _, _ = opened(tmp_path / "s" / "s.preview.svg")
    plate, disc, *_ = root.iter(f"{SVG}path")
    (points,) = rings(disc)
    left, top, right, low = shape(plate).bounds
    away = points - complex(left + right, top + low) / 2
    sizes = json.loads((tmp_path / "s" / "report.json").read_text(encoding="utf-8"))["parts"]["driver"]
    assert np.abs(away).max() == pytest.approx(sizes["locking_diameter"] / 2, abs=2e-3)
    nearest = away[np.abs(away).argmin()]
    assert -nearest.imag == pytest.approx(sizes["relief_apex"], abs=2e-3)


@pytest.mark.parametrize(("corner", "seen"), [
    (-40 - 20j, [(1.2, 43.2, 85.2, 43.2), (43.2, 21.2, 43.2, 65.2)]),
    (1 - 20j, [(42.2, 43.2, 85.2, 43.2)]),
    (-40 + 1j, [(43.2, 21.2, 43.2, 44.2)]),
    (1 + 1j, []),
])  # fmt: skip
def test_centre_lines_stand_out_of_the_part_by_a_twentieth(corner: complex, seen: list[tuple[float, ...]]) -> None:
    """A part whose upper right corner is 40 + 20i about its origin at (43.2, 43.2); none beside it."""
    half = max(40 - corner.real, 20 - corner.imag) / 2
    lines = [{key: float(v) for key, v in re.findall(r'([xy]\d)="([-\d.]+)"', line)}
             for line in _cross(43.2 + 43.2j, corner, 40 + 20j)]  # fmt: skip
    out = np.array([-0.05, -0.05, 0.05, 0.05]) * (half - 40)
    for line, told in zip(lines, seen, strict=True):
        way = np.array([told[0] != told[2], told[1] != told[3]] * 2)
        assert [line[k] for k in ("x1", "y1", "x2", "y2")] == pytest.approx(np.array(told) + out * way)


def test_a_browser_shows_a_picture_whole_and_a_laser_cuts_it_at_its_size(tmp_path: Path) -> None:
    """A rack of 1005 mm: its pictures fit the window, what is cut is never made smaller by it."""
    gears = {"pinion": ("spur_gear", 18), "rack": ("rack", 80)}
    text = "".join(
        f'[parts.{name}]\nkind = "{kind}"\nmodule = 4.0\nnumber_of_teeth = {teeth}\n'
        for name, (kind, teeth) in gears.items()
    )
    text += '[[mates]]\nkind = "rack_pair"\nfirst = "pinion"\nsecond = "rack"\n[[drives]]\ninstance = "pinion"\n'
    text += "[boards.b]\nwidth = 1100.0\nheight = 400.0\nthickness = 10.0\n"
    text += '[[exports]]\nformat = "svg"\n[[exports]]\nformat = "svg"\npurpose = "board"\n'
    (tmp_path / "s.toml").write_text(f'{text}[[exports]]\nformat = "motion"\n', encoding="utf-8")
    assert run("build", tmp_path / "s.toml", "--out", tmp_path, "-q") == 0
    found = {file.name: ElementTree.parse(file).getroot().get("style") for file in (tmp_path / "s").glob("*.svg")}
    cut = {"pinion.svg", "rack.svg", "s.board.1.svg"}
    assert cut < found.keys()
    assert {name for name, style in found.items() if style is None} == cut
    assert set(found.values()) == {None, "max-width:100%;max-height:100vh"}
    assert {"s.motion.svg", "s.preview.svg", "rack.preview.svg", "s.board.1.preview.svg"} < found.keys()

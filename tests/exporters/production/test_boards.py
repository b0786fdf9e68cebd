"""Boards and plates by the command: the written files measured by ezdxf and shapely, each check with a spoiled file."""

from __future__ import annotations

import json
import math
import re
from collections import defaultdict
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pytest
import shapely
import shapely.affinity
from ezdxf.entities import LWPolyline

from exporters.boards.cuts import nearest_next
from exporters.boards.nest import Room, nest
from exporters.command.cli import main
from exporters.formats.read_svg import read_svg
from exporters.production.recheck import recheck
from exporters.verification import board

PARTS = """
[parts.ring]
kind = "plate"
width = 90.0
height = 80.0
corner_radius = 10.0
holes = [{{ at = [0.0, 0.0], diameter = 64.0 }}]
face_width = 3.0
[parts.wheel]
kind = "spur_gear"
module = 2.0
number_of_teeth = 17
face_width = 3.0
bore_diameter = 6.0
[parts.bar]
kind = "plate"
width = 60.0
height = 9.0
holes = [{{ at = [-25.0, 0.0], diameter = 3.0 }}]
engraved = [{{ start = [0.0, 0.0], end = [12.0, 0.0], width = 1.0 }}]
face_width = 3.0
[boards.plywood]
width = {width}
height = 120.0
thickness = 3.0
gap = {gap}
kerf = {kerf}
grain = {grain}
sets = 2
copies = {{ bar = 3 }}
feed = 10.0
engraving_feed = 80.0
{more}
"""
EXPORTS = """
[[exports]]
format = "dxf"
kerf = {kerf}

[[exports]]
format = "dxf"
purpose = "board"
[[exports]]
format = "svg"
purpose = "board"
"""


def scene(folder: Path, *, width: float = 200.0, gap: float = 2.0, kerf: float = 0.2, grain: bool = False,
          more: str = "", exports: str = EXPORTS) -> Path:  # fmt: skip
    file = folder / "set.toml"
    told = PARTS.format(width=width, gap=gap, kerf=kerf, grain=str(grain).lower(), more=more)
    file.write_text(told + exports.format(kerf=kerf), encoding="utf-8")
    return file


def built(folder: Path, **keys: Any) -> Path:
    assert main(["build", str(scene(folder, **keys)), "--out", str(folder), "--quiet"]) == 0
    return folder / "set"


def contours(file: Path, *, closed: bool = True) -> list[tuple[str, np.ndarray]]:
    """Layer and rows (x, y, bulge) of each polyline of a DXF, by ezdxf, in their order; open ones are names."""
    found = []
    for entity in ezdxf.readfile(file).modelspace():
        assert entity.dxftype() == "LWPOLYLINE"
        assert entity.closed or entity.dxf.layer == "ENGRAVE"
        if entity.closed == closed:
            found.append((entity.dxf.layer, np.array(entity.get_points("xyb"))))
    return found


def polygon(rows: np.ndarray, steps: int = 96, sag: float | None = None) -> shapely.Polygon:
    """A contour by many points of each arc, or by chords so near to it, mm."""
    points: list[complex] = []
    for (x, y, bulge), (to_x, to_y, _) in zip(rows, np.roll(rows, -1, axis=0), strict=True):
        start, end = complex(x, y), complex(to_x, to_y)
        if bulge == 0:
            points.append(start)
            continue
        # centre and radius of the arc through both ends
        half = 2 * math.atan(bulge)
        centre = (start + end) / 2 + 1j * (end - start) / 2 / math.tan(half)
        if sag is not None:
            steps = math.ceil(abs(half) / math.acos(1 - sag / abs(start - centre)))
        points += [centre + (start - centre) * np.exp(2j * half * k / steps) for k in range(steps)]
    return shapely.Polygon([(p.real, p.imag) for p in points])


def bodies_of(file: Path, sag: float | None = None) -> list[shapely.Polygon]:
    """What is cut out whole: the material between the contours, by even and odd."""
    rings = [polygon(rows, sag=sag) for layer, rows in contours(file) if layer != "ENGRAVE"]
    first = shapely.points([ring.exterior.coords[0] for ring in rings])
    inner, outer = shapely.STRtree(rings).query(first, predicate="within")
    around = [{int(b) for a, b in zip(inner, outer, strict=True) if a == k != b} for k in range(len(rings))]
    return [
        shapely.Polygon(
            ring.exterior,
            [rings[i].exterior for i, own in enumerate(around) if k in own and len(own) == len(around[k]) + 1],
        )
        for k, ring in enumerate(rings)
        if len(around[k]) % 2 == 0
    ]


def bodies_gap(bodies: list[shapely.Polygon]) -> float:
    """The least distance of two pieces that are near each other."""
    tree = shapely.STRtree(bodies)
    near = zip(*tree.query(bodies, predicate="dwithin", distance=6.0), strict=True)
    return min((bodies[a].distance(bodies[b]) for a, b in near if a < b), default=math.inf)


def pieces_of(folder: Path, name: str) -> dict[str, Any]:
    report = json.loads((folder / "report.json").read_text("utf-8"))
    entry: dict[str, Any] = next(e for e in report["files"] if e["path"] == name)
    return entry


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return built(tmp_path_factory.mktemp("boards"))


def test_pieces_are_whole_on_the_board_and_apart(folder: Path) -> None:
    files = sorted(folder.glob("set.board.*.dxf"))
    counts: dict[str, int] = defaultdict(int)
    for file in files:
        entry = pieces_of(folder, file.name)
        for piece in entry["pieces"].values():
            counts[piece["part"]] += 1
        bodies = bodies_of(file)
        assert len(bodies) == len(entry["pieces"])
        low_x, low_y, high_x, high_y = shapely.union_all(bodies).bounds
        assert min(low_x, low_y, 200 - high_x, 120 - high_y) >= 5 - 1e-6
        gap = bodies_gap(bodies)
        assert gap >= 2 - 1e-6
        assert entry["measured"].get("least_gap", 3.0) == pytest.approx(min(gap, 3.0), abs=5e-3)
        # arcs may stand out of chords: what is told is never more than there is
        margin = min(low_x, low_y, 200 - high_x, 120 - high_y)
        assert margin - 3e-4 < entry["measured"]["least_margin"] <= margin + 1e-9
        assert entry["measured"].get("least_gap", 0.0) <= gap
        assert entry["measured"]["use_percent"] == pytest.approx(
            100 * sum(b.area for b in bodies) / (200 * 120), rel=1e-4
        )
        length = sum(polygon(rows).length for _, rows in contours(file))
        names = [rows[:, :2] for _, rows in contours(file, closed=False)]
        assert shapely.contains(shapely.union_all(bodies).buffer(-0.125), shapely.MultiLineString(names))
        engraved = shapely.MultiLineString(names).length
        length += engraved
        engraved += sum(polygon(rows).length for layer, rows in contours(file) if layer == "ENGRAVE")
        seconds = (length - engraved) / 10 + engraved / 80
        told = entry["measured"]
        assert told["cut_length"] + told["engraved_length"] == pytest.approx(length, rel=1e-4)
        assert told["cut_seconds"] == pytest.approx(seconds, rel=1e-4)
    assert counts == {"ring": 2, "wheel": 2, "bar": 6}


def test_contours_are_those_of_the_part_moved(folder: Path) -> None:
    for file in sorted(folder.glob("set.board.*.dxf")):
        left = [rows for _, rows in contours(file)]
        for piece in pieces_of(folder, file.name)["pieces"].values():
            turn, at = 1j ** (piece["turn_deg"] // 90), complex(*piece["at"])
            for _, own in contours(folder / f"{piece['part']}.dxf"):
                moved = (own[:, 0] + 1j * own[:, 1]) * turn + at
                alike = [
                    i
                    for i, rows in enumerate(left)
                    if len(rows) == len(own)
                    and np.abs(rows[:, 0] + 1j * rows[:, 1] - moved).max() <= 1e-9
                    and np.array_equal(rows[:, 2], own[:, 2])
                ]
                assert len(alike) == 1
                left.pop(alike[0])
        assert left == []


def test_small_pieces_lie_in_holes_and_are_cut_before_them(folder: Path) -> None:
    file = folder / "set.board.1.dxf"
    found = contours(file)
    rings = [polygon(rows) for _, rows in found]
    nested = 0
    for index, ring in enumerate(rings):
        for other, (layer, _) in enumerate(found):
            if other != index and layer != "ENGRAVE" and rings[other].contains(ring):
                assert index < other
                nested += found[index][0] == "CUT_INNER" and ring.area > 500 and rings[other].area < 4000
    # a wheel in the hole of each ring
    assert nested == 2
    order = [("ENGRAVE", "CUT_INNER", "CUT_OUTER").index(layer) for layer, _ in found]
    assert order == sorted(order)


def test_svg_holds_the_same_board(folder: Path) -> None:
    for file in sorted(folder.glob("set.board.*.dxf")):
        svg = file.with_suffix(".svg")
        # an SVG is read about its middle
        loops = [np.column_stack([x.vertices.real + 100, x.vertices.imag + 60, x.bulges]) for x in read_svg(svg).loops]
        boxes = [[polygon(rows).bounds for rows in shapes] for shapes in ([r for _, r in contours(file)], loops)]
        off = np.abs(np.array(boxes[0])[:, None] - np.array(boxes[1])[None]).max(axis=2)
        assert len(loops) == len(boxes[0])
        assert off.min(axis=0).max() <= 2e-3
        assert recheck(svg).verdict.failures == ()


@pytest.mark.heavy
def test_the_same_bytes_twice(folder: Path, tmp_path: Path) -> None:
    again = built(tmp_path)
    for file in folder.glob("set.board.*"):
        assert file.read_bytes() == (again / file.name).read_bytes()


@pytest.mark.heavy
def test_wider_cuts_and_gaps_and_a_grain(tmp_path: Path) -> None:
    folder = built(tmp_path, kerf=0.3, gap=4.0, grain=True)
    for file in folder.glob("set.board.*.dxf"):
        assert bodies_gap(bodies_of(file)) >= 4 - 1e-6
        assert {p["turn_deg"] for p in pieces_of(folder, file.name)["pieces"].values()} <= {0, 180}


@pytest.mark.heavy
def test_no_kerf_and_no_gap(tmp_path: Path) -> None:
    folder = built(tmp_path, kerf=0.0, gap=0.0)
    for file in folder.glob("set.board.*.dxf"):
        assert bodies_gap(bodies_of(file)) >= -1e-6


def copied(folder: Path, to: Path) -> Path:
    for file in folder.iterdir():
        (to / file.name).write_bytes(file.read_bytes())
    return to / "set.board.1.dxf"


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("spoil", "words"), [
    ("moved", "is off the other|deviates by"), ("engraved", "an engraved line comes after a closed contour"),
    ("order", "comes after the layer that follows its own"),
    ("layer", "a contour stands on CUT_INNER instead of CUT_OUTER"), ("missing", "contours instead of"),
    ("kind", "a contour stands on ENGRAVE instead of CUT_INNER"), ("far", "is missing or not in its place"),
])  # fmt: skip
def test_a_spoiled_board_is_caught(spoil: str, words: str, folder: Path, tmp_path: Path) -> None:
    file = copied(folder, tmp_path)
    drawing = ezdxf.readfile(file)
    space = drawing.modelspace()
    first, *_, last = space
    if spoil == "moved":
        last.translate(0.01, 0.0, 0.0)
    elif spoil in ("engraved", "order"):
        late = first if spoil == "engraved" else next(e for e in space if e.dxf.layer == "CUT_INNER")
        space.unlink_entity(late)
        space.add_entity(late)
    elif spoil == "layer":
        last.dxf.layer = "CUT_INNER"
    elif spoil == "kind":
        next(e for e in space if e.dxf.layer == "CUT_INNER").dxf.layer = "ENGRAVE"
    elif spoil == "far":
        last.translate(0.6, 0.0, 0.0)
    else:
        space.delete_entity(last)
    drawing.saveas(file)
    failures = recheck(file).verdict.failures
    assert any(re.search(words, failure) for failure in failures), failures


def test_a_word_that_is_engraved_elsewhere_is_caught(folder: Path, tmp_path: Path) -> None:
    file = copied(folder, tmp_path)
    drawing = ezdxf.readfile(file)
    next(e for e in drawing.modelspace() if e.dxf.layer == "ENGRAVE").translate(0.0, 0.05, 0.0)
    drawing.saveas(file)
    assert recheck(file).verdict.failures == ("an engraved stroke is not where it should be",)


@pytest.mark.parametrize(("key", "value", "words"), [
    ("gap", 3.0, "mm apart instead of 3"), ("margin", 6.0, "from the edge of the board instead of 6"),
])  # fmt: skip
def test_pieces_nearer_than_asked_are_caught(key: str, value: float, words: str, folder: Path, tmp_path: Path) -> None:
    file = copied(folder, tmp_path)
    report = json.loads((tmp_path / "report.json").read_text("utf-8"))
    report["scene"]["boards"]["plywood"][key] = value
    (tmp_path / "report.json").write_text(json.dumps(report), encoding="utf-8")
    assert [f for f in recheck(file).verdict.failures if words in f]


@pytest.mark.parametrize(("keys", "key", "words"), [
    ({"width": 85.0}, "boards.plywood.width", "the part ring needs 90.2 x 80.2 mm"),
    # 120 - 40 mm in height for 80.2
    ({"more": "margin = 20.0"}, "boards.plywood.height", "the part ring needs 90.2 x 80.2 mm"),
    ({"width": 2e-6}, "boards.plywood.width", "at least 1, at most"),
    ({"gap": 500.0}, "boards.plywood.gap", "less than the shorter side of the board, 120"),
    ({"kerf": 3.2, "exports": EXPORTS.split("\n\n")[1]}, "boards.plywood.kerf", "bar"),
    ({"more": 'margin = 60.0'}, "boards.plywood.margin", "less than half of the side of 120"),
    ({"more": 'parts = ["whel"]'}, "boards.plywood.parts", "wheel"),
    ({"exports": '[[exports]]\nformat = "dxf"\npurpose = "board"\nkerf = 0.1\n'}, "exports[1].kerf", "boards.NAME"),
    ({"exports": '[[exports]]\nformat = "3mf"\npurpose = "plate"\n'}, "exports[1].purpose", "[beds.NAME]"),
])  # fmt: skip
def test_bad_boards_are_refused_in_one_line(
    keys: dict[str, Any], key: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["build", str(scene(tmp_path, **keys)), "--out", str(tmp_path)]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert key in told
    assert words in told
    assert not (tmp_path / "set").exists()


def test_a_part_has_its_tag_on_the_board_and_none_in_its_own_file(tmp_path: Path) -> None:
    # both files were made of one outline: the build ended in an error
    text = """[parts.link_with_a_long_name]
kind = "follower_arm"
end = "roller"
arm_length = 18.0
boss_diameter = 10.0
pivot_diameter = 4.2
pin_diameter = 4.2
face_width = 4.0
[boards.plywood]
width = 100.0
height = 60.0
thickness = 4.0
kerf = 0.2
[[exports]]
format = "dxf"
purpose = "board"
[[exports]]
format = "dxf"
kerf = 0.2
"""
    (tmp_path / "tagged.toml").write_text(text, encoding="utf-8")
    assert main(["build", str(tmp_path / "tagged.toml"), "--out", str(tmp_path), "-q"]) == 0
    drawn = {}
    for name in ("tagged.board.1.dxf", "link_with_a_long_name.dxf"):
        space = ezdxf.readfile(tmp_path / "tagged" / name).modelspace()
        drawn[name] = sum(1 for e in space if isinstance(e, LWPolyline) and e.closed)
    assert drawn["tagged.board.1.dxf"] == drawn["link_with_a_long_name.dxf"] + 1


MANY = """
[parts.bar]
kind = "plate"
width = 60.0
height = 9.0
face_width = 3.0
[parts.tile]
kind = "plate"
width = 22.0
height = 20.0
face_width = 3.0
[boards.ply]
width = 110.0
height = 70.0
thickness = 3.0
sets = {sets}
copies = {{ tile = {tiles} }}
[[exports]]
format = "dxf"
purpose = "board"
"""


def test_many_sets_repeat_boards_and_too_many_are_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "many.toml"
    file.write_text(MANY.format(sets=1000, tiles=2), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path)]) == 0
    counts: dict[str, int] = defaultdict(int)
    said, boards = capsys.readouterr().out, 0
    for path in sorted((tmp_path / "many").glob("*.dxf")):
        entry = pieces_of(tmp_path / "many", path.name)
        boards += entry["times"]
        repeated = f"{path.name}: boards like this one to be cut: {entry['times']}\n"
        assert (repeated in said) is (entry["times"] > 1)
        for piece in entry["pieces"].values():
            counts[piece["part"]] += entry["times"]
        assert bodies_gap(bodies_of(path)) >= 2 - 1e-6
    assert counts == {"bar": 1000, "tile": 2000}
    # by hand: 250 with eight tiles and a bar each, 94 with eight bars
    assert boards <= 1.1 * (250 + 94)
    file.write_text(MANY.format(sets=1000, tiles=30), encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path / "no")]) == 2
    told = capsys.readouterr().err
    assert (
        "boards.ply.sets = 1000: makes 31000 pieces, more than the 20000 that are laid out at once; at most 645 works"
        in told
    )


def test_a_kerf_that_all_but_closes_a_hole_is_refused_or_read_back(tmp_path: Path) -> None:
    """The kerf that a refusal offers leaves a hole of 1e-4 mm: two edges, which are a ring all the same."""
    lines = (
        "[parts.p]",
        'kind = "plate"',
        "width = 20.0",
        "height = 20.0",
        "face_width = 3.0",
        "holes = [{ at = [0.0, 0.0], diameter = 2.0 }]",
        "[boards.b]",
        "width = 60.0",
        "height = 60.0",
        "thickness = 3.0",
        "kerf = 1.9999",
        "[[exports]]",
        'format = "dxf"',
        'purpose = "board"',
    )
    (scene := tmp_path / "s.toml").write_text("\n".join(lines), encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path)]) == 0


@pytest.mark.parametrize(("width", "height"), [(180.0, 180.0), (180.0, 72.0), (179.9401, 71.9401)])
def test_pieces_that_nearly_fill_the_room_are_laid(width: float, height: float) -> None:
    """No place on the grid of the room is free for them: they stand between two of its lines, and keep the gap."""
    room = Room(width, height, 5.0, 2.0)
    shapes = {"long": (shapely.box(0, 0, 169.94, 59.94), 3), "small": (shapely.Point(0, 0).buffer(9.0), 4)}
    boards = defaultdict(list)
    for one in nest(shapes, room):
        turned = shapely.affinity.rotate(shapes[one.shape][0], 90 * one.turn, origin=(0, 0))
        boards[one.board].append(shapely.affinity.translate(turned, one.at.real, one.at.imag))
    assert sum(map(len, boards.values())) == 7
    inner = shapely.box(5 - 1e-9, 5 - 1e-9, width - 5 + 1e-9, height - 5 + 1e-9)
    for pieces in boards.values():
        assert all(inner.covers(piece) for piece in pieces)
        assert all(a.distance(b) >= 2 - 1e-9 for k, a in enumerate(pieces) for b in pieces[:k])


GEAR = '[parts.g]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 17\n'
PLATE = '[parts.p]\nkind = "plate"\nwidth = 60.0\nheight = 30.0\nface_width = 3.0\n'
ROD = '[parts.r]\nkind = "pin"\ndiameter = 4.0\nlength = 10.0\n'
BOARD = "[boards.b]\nwidth = 200.0\nheight = 100.0\nthickness = 3.0\n"
DXF, SVG_ALONE = '[[exports]]\nformat = "dxf"\n', '[[exports]]\nformat = "svg"\n'
ON_BOARDS, ON_PAPER = f'{DXF}purpose = "board"\n', '[[exports]]\nformat = "pdf"\npurpose = "model"\n'


@pytest.mark.parametrize(
    ("scene", "key", "why"),
    [
        (ROD + BOARD + ON_BOARDS, "boards.b.thickness", "pins are cut from rods"),
        (f'{GEAR}face_width = 5.0\n{BOARD}parts = ["g"]\n{ON_BOARDS}', "boards.b.thickness", "g is 5 mm thick"),
        (f"{PLATE}holes = [{{ diameter = 4.0 }}]\n{DXF}", "parts.p.holes[1].at", "or axis_of"),
        (f'{PLATE}holes = [{{ axis_of = "w", diameter = 4.0 }}]\n{DXF}', "holes[1].axis_of", "no such instance"),
        (f"{PLATE}slots = [{{ start = [0.0, 0.0], end = [5.0, 0.0], width = 0.2 }}]\n{BOARD}kerf = 0.3\n{ON_BOARDS}",
         "boards.b.kerf", "closes a slot"),
        (f'{GEAR}title = "  "\n{DXF}', "parts.g.title", "must not be blank"),
        (f'{GEAR}{ON_PAPER}scale = "1:2"\n', "exports[1].scale", "in full size"),
        (f"{GEAR}{ON_PAPER}title_block = true\n", "exports[1].title_block", "on bare sheets"),
        (f"{GEAR}{ON_PAPER}tolerance = 1e-7\n", "exports[1].tolerance", "is finer than a PDF can tell places"),
        (f'[scene]\ntitle = "\\u6b6f"\n{GEAR}[[exports]]\nformat = "pdf"\npurpose = "generating"\ntitle_block = true\n',
         "scene.title", "the font of a PDF has no letters"),
    ],
)  # fmt: skip
def test_what_no_board_and_no_paper_takes_is_refused_in_one_line(
    scene: str, key: str, why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "s.toml"
    file.write_text(scene, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path / "out")]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert key in line
    assert why in line
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("scene", "told"),
    [
        (f'{GEAR}profile_shift_coefficient = 0.3\nlabel = "z 17 m 2 x 0.5"\n', "its label says x 0.5"),
        ('[parts.r]\nkind = "roller"\ndiameter = 4.0\nbore_diameter = 3.2\n', "thin wall: 0.4 mm about its bore"),
    ],
)
def test_remarks_on_what_is_cut(scene: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    file = tmp_path / "s.toml"
    file.write_text(scene + SVG_ALONE, encoding="utf-8")
    assert main(["build", str(file), "--out", str(tmp_path), "--no-verify"]) == 0
    assert told in capsys.readouterr().out


def test_the_way_between_cuts_goes_to_the_nearest_that_is_left() -> None:
    points = np.random.default_rng(7).normal(size=(40, 2)) @ [1, 1j] * 100
    way, end = nearest_next(points, 30 + 20j)
    left, at, wanted = {*range(40)}, 30 + 20j, []
    while left:
        wanted.append(min(left, key=lambda k: abs(points[k] - at)))
        left.remove(wanted[-1])
        at = points[wanted[-1]]
    assert (way, end) == (wanted, at)


def test_a_board_that_is_too_small_is_told_how_large_it_must_be(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The greater of two discs decides, not the first one: 60 mm, margins of 5 mm; one step less is refused again."""
    text = "".join(f'[parts.{name}]\nkind = "roller"\ndiameter = {d}\nface_width = 3.0\n'
                   for name, d in (("small", 30.0), ("large", 60.0)))  # fmt: skip
    text += '[[exports]]\nformat = "svg"\npurpose = "board"\n[boards.b]\nwidth = 300.0\nthickness = 3.0\n'
    file = tmp_path / "s.toml"

    def refusal(height: float) -> str:
        file.write_text(f"{text}height = {height!r}\n")
        code = main(["build", str(file), "--out", str(tmp_path / "out"), "--no-verify"])
        said = capsys.readouterr().err
        assert (code == 2) == bool(said)
        return said

    said = refusal(20.0)
    assert "boards.b.height = 20.0: the part large needs 60" in said
    least = float(re.findall(r"at least ([\d.]+) mm works", said)[0])
    assert 70 <= least < 70.2
    assert "boards.b.height" in refusal(least - 1e-4)
    assert refusal(least) == ""


def test_a_piece_that_a_box_about_another_only_touches_has_its_distance() -> None:
    """Spacers that stand just as far apart as neighbours are looked for were told to lie nan mm apart: clipped by a box
    that it touches at a point, nothing is left of one. By shapely, of the whole pieces.
    """
    for reach in (1.5, 3.0, 4.25):
        for radius in (2.0, 5.1, 7.5):
            one, two = (shapely.Point(x, 9.0).buffer(radius) for x in (8.0, 8.0 + 2 * radius + reach))
            apart = float(shapely.distance(one, two))
            assert board.distance_within(one, two, apart) == apart
            assert board.distance_within(two, one, 2 * reach) == apart

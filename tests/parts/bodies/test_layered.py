"""Bodies of layers: volume by plane geometry, files read back, contours that meet refused."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest

from exporters.command.cli import main
from exporters.command.new import new_scene
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict, scene_from_toml
from tests.parts.limits import check_limit, refused, scene_of, with_key

Keys = dict[str, Any]
SQUARE = {"points": [[-30, -20], [30, -20], [30, 20], [-30, 20]]}
BOX: list[Keys] = [
    {"thickness": 4.0, "polygons": [SQUARE], "circles": [{"diameter": 5.0, "at": [20.0, 0.0]}]},
    {"thickness": 8.0, "circles": [{"diameter": 30.0}, {"diameter": 20.0}]},
    {"thickness": 3.0, "circles": [{"diameter": 36.0}, {"diameter": 20.0}, {"diameter": 2.0, "at": [12.5, 0.0]}],
     "slots": [{"start": [-12.5, -2.0], "end": [-12.5, 2.0], "width": 3.0}],
     # a lens, half a disk told clockwise, a slice out of which an arc is cut
     "outlines": [
         {"points": [{"x": -1.0, "y": 14.0, "arc": 2.0}, {"x": 1.0, "y": 14.0, "arc": 2.0}]},
         {"points": [{"x": 1.0, "y": -13.0}, {"x": -1.0, "y": -13.0, "arc": 1.0}]},
         {"points": [{"x": 11.5, "y": 4.0}, {"x": 13.0, "y": 4.0}, {"x": 13.0, "y": 6.0},
                     {"x": 11.5, "y": 6.0, "arc": -2.0}]},
     ]},
    # a rim of its own on a wider one
    {"thickness": 1.0, "circles": [{"diameter": 34.0}, {"diameter": 32.0}]},
]  # fmt: skip


def made(layers: list[Keys]) -> Any:
    return make_parts(scene_from_dict({"parts": {"box": {"kind": "layered", "layers": layers}}}, "t", "t"), "t")[0][
        "box"
    ]


def disk(diameter: float) -> float:
    return math.pi * diameter**2 / 4


def test_a_volume_is_that_of_its_layers() -> None:
    part = made(BOX)
    slot = disk(3.0) + 4 * 3
    # of a circle of radius 2 beyond a chord of 2
    beyond = 2 * (math.pi / 3 - math.sin(math.pi / 3))
    outlines = 2 * beyond + disk(2) / 2 + 3 - beyond
    areas = [2400 - disk(5), disk(30) - disk(20), disk(36) - disk(20) - disk(2) - slot - outlines, disk(34) - disk(32)]
    wanted = sum(area * layer["thickness"] for area, layer in zip(areas, BOX, strict=True))
    assert part.made_by.moments(part.body(0.0)).volume == pytest.approx(wanted, rel=1e-12)
    mesh = part.to_trimesh(0.001)
    assert mesh.is_watertight
    assert mesh.volume == pytest.approx(wanted, rel=2e-4)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("angle", [90.0, 0.0, 17.0])
def test_a_hexagon_of_a_layer_takes_its_nut(angle: float, tmp_path: Path) -> None:
    """A pocket of 7.2 mm, sqrt(3) / 2 of its square: in the STL a nut of 7.18 goes in, one of 7.22 does not."""
    import manifold3d
    import trimesh

    nut = {"across_flats": 7.2, "at": [5.0, 3.0], "angle_deg": angle}
    layers: list[Keys] = [
        {"thickness": 3.0, "polygons": [SQUARE]},
        {"thickness": 4.0, "polygons": [SQUARE], "hexagons": [nut]},
    ]
    part = made(layers)
    assert part.made_by.moments(part.body(0.0)).volume == pytest.approx(
        7 * 2400 - 4 * math.sqrt(3) / 2 * 7.2**2, rel=1e-12
    )
    square = "polygons = [{ points = [[-30, -20], [30, -20], [30, 20], [-30, 20]] }]"
    (tmp_path / "trap.toml").write_text(f"""[parts.trap]
kind = "layered"
[[parts.trap.layers]]
thickness = 3.0
{square}
[[parts.trap.layers]]
thickness = 4.0
{square}
hexagons = [{{ across_flats = 7.2, at = [5.0, 3.0], angle_deg = {angle} }}]
[[exports]]
format = "stl"
[[exports]]
format = "step"
[[exports]]
format = "svg"
purpose = "part"
""")
    assert main(["build", str(tmp_path / "trap.toml"), "--out", str(tmp_path)]) == 0
    mesh = trimesh.load(tmp_path / "trap" / "trap.stl")
    assert isinstance(mesh, trimesh.Trimesh)
    trap = manifold3d.Manifold(manifold3d.Mesh(mesh.vertices.astype("f4"), mesh.faces.astype("u4")))

    def struck(across: float) -> float:
        # six sides, the first corner on +x: its flats stand at 30, 90 ... degrees
        rod = manifold3d.Manifold.cylinder(10.0, across / math.sqrt(3), circular_segments=6)
        return float((trap ^ rod.rotate((0.0, 0.0, angle - 30.0)).translate((5.0, 3.0, 3.0))).volume())

    assert struck(7.18) < 1e-6
    assert struck(7.22) > 0.1


def test_a_hexagon_that_crosses_a_circle_is_told_by_its_key() -> None:
    layer: Keys = {"thickness": 3.0, "circles": [{"diameter": 30.0}], "hexagons": [{"across_flats": 29.0}]}
    with pytest.raises(SceneError) as told:
        made([layer])
    assert "hexagons[1]" in str((told.value.key, told.value.numbers))


def shown(number: int) -> Part:
    """The part that ``new`` shows in place of its own, by its number."""
    text = new_scene("layered")
    rows = re.findall(r"^# (layers = .*?)  # \.\.\. or this", text, re.MULTILINE)
    used = re.sub(r"^layers = .*$", rows[number], text, flags=re.MULTILINE)
    return make_parts(scene_from_toml(used.encode(), "t", "t"), "t")[0]["layered"]


def test_the_hand_that_new_shows_is_a_flat_part_of_lines_and_arcs() -> None:
    """A trapezium with half a disk at each end, less a slot and a hole; what an outline takes was not shown."""
    part = shown(0)
    area = 60 * (8 + 2) / 2 + (disk(8) + disk(2)) / 2 - (15 * 2 + disk(2)) - disk(3)
    assert part.made_by.moments(part.body(0.0)).volume == pytest.approx(3 * area, rel=1e-12)
    assert part.is_plate


def test_the_ratchet_wheel_that_new_shows_has_sixteen_teeth() -> None:
    part = shown(1)
    area = 16 * 20 * 16 * math.sin(math.pi / 8) / 2 - disk(6)
    assert part.made_by.moments(part.body(0.0)).volume == pytest.approx(5 * area, rel=1e-12)
    assert part.is_plate


def test_its_files_are_read_back(tmp_path: Path) -> None:
    scene = tmp_path / "box.toml"
    rows = ", ".join("{" + ", ".join(f"{key} = {_toml(value)}" for key, value in row.items()) + "}" for row in BOX)
    text = f'[parts.box]\nkind = "layered"\nlayers = [{rows}]\n'
    scene.write_text(text + '[[exports]]\nformat = "step"\n[[exports]]\nformat = "stl"\n', encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path), "-q"]) == 0


def test_one_layer_is_cut_from_a_board_of_its_thickness(tmp_path: Path) -> None:
    """A hand of a clock, a kite about a shaft: its files are read back and held against its outline."""
    kite = {"points": [[-8, 0], [0, -12], [8, 0], [0, 90]]}
    layer = {"thickness": 4.0, "polygons": [kite], "circles": [{"diameter": 6.0}]}
    scene = tmp_path / "clock.toml"
    text = f'[parts.hand]\nkind = "layered"\nlayers = [{_toml(layer)}]\n'
    board = "[boards.plywood]\nwidth = 300.0\nheight = 200.0\nthickness = 4.0\n"
    exports = '[[exports]]\nformat = "svg"\n[[exports]]\nformat = "dxf"\npurpose = "board"\n'
    scene.write_text(text + board + exports, encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path), "-q"]) == 0
    made = {file.name for file in (tmp_path / "clock").iterdir()}
    assert {"hand.svg", "clock.board.1.dxf"} < made


def _toml(value: Any) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(_toml(item) for item in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(item)}" for key, item in value.items()) + "}"
    return str(value)


@pytest.mark.parametrize(
    ("layers", "word"),
    [
        ([{"thickness": 1, "circles": [{"diameter": 10}, {"diameter": 10, "at": [4, 0]}]}], "cross"),
        # touching
        ([{"thickness": 1, "circles": [{"diameter": 10}, {"diameter": 4, "at": [3, 0]}]}], "cross"),
        # a wall that goes on beside one that ends there
        ([{"thickness": 1, "polygons": [SQUARE]}, {"thickness": 1, "circles": [{"diameter": 60}]}], "cross"),
        ([{"thickness": 1, "circles": [{"diameter": 10}, {"diameter": 4, "at": [9, 0]}]}], "several"),
        ([{"thickness": 1, "circles": [{"diameter": 10, "at": [x, 0]}]} for x in (0, 19)], "several"),
        ([{"thickness": 1}], "no contour"),
        ([{"thickness": 1, "outlines": [{"points": [{"x": 0, "y": 0}, {"x": 9, "y": 0}]}]}], "encloses nothing"),
        ([{"thickness": 1, "outlines": [{"points": [{"x": 0, "y": 0, "arc": 4}, {"x": 9, "y": 0}]}]}], "not reach"),
        # told clockwise: points[3] was blamed
        ([{"thickness": 1, "outlines": [{"points": [{"x": 0, "y": 0, "arc": 4}, {"x": 0, "y": 9}, {"x": 9, "y": 9}]}]}],
         r"points\[1\]\.arc"),
    ],
)  # fmt: skip
def test_what_is_no_body_is_refused(layers: list[Keys], word: str) -> None:
    with pytest.raises(SceneError, match=word):
        made(layers)


ROUND = SQUARE | {"corner_radius": 5.0}
# the limit worked out by hand: off the sides, out of the corners, out of the rounded ones, beside another circle
CROSSING: list[tuple[list[Keys], str, float, str, str]] = [
    ([{"thickness": 1, "polygons": [SQUARE], "circles": [{"diameter": 9.0}]}], "layers[1].circles[1]", 40.0, "at_most",
     "layers[1].polygons[1]"),
    ([{"thickness": 1, "polygons": [SQUARE]}, {"thickness": 1, "circles": [{"diameter": 9e1}]}], "layers[2].circles[1]",
     2 * math.hypot(30, 20), "at_least", "layers[1].polygons[1]"),
    ([{"thickness": 1, "circles": [{"diameter": 90.0}]}, {"thickness": 1, "polygons": [ROUND]}], "layers[1].circles[1]",
     2 * (math.hypot(25, 15) + 5), "at_least", "layers[2].polygons[1]"),
    ([{"thickness": 1, "circles": [{"diameter": 50.0}, {"diameter": 10.0, "at": [12.0, 0.0]}]}],
     "layers[1].circles[2]", 26.0, "at_most", "layers[1].circles[1]"),
    ([{"thickness": 1, "circles": [{"diameter": 50.0}], "slots": [{"start": [-6, 0], "end": [6, 0], "width": 4.0}]}],
     "layers[1].circles[1]", 16.0, "at_least", "layers[1].slots[1]"),
]  # fmt: skip


@pytest.mark.parametrize(("layers", "circle", "limit", "side", "other"), CROSSING)
def test_a_circle_that_crosses_a_contour_is_told_the_diameter_that_does_not(
    layers: list[Keys], circle: str, limit: float, side: str, other: str
) -> None:
    """Before: the layer was told, and nothing that works; chords of arcs left rounded corners more room."""
    raw, key = scene_of({"kind": "layered", "layers": layers}), f"parts.p.{circle}.diameter"
    check_limit(raw, key, "contours_cross", limit, side)
    beyond = refused(with_key(raw, key, limit * (1.001 if side == "at_most" else 0.999)))
    assert beyond is not None
    assert beyond.numbers["other"] == other


def test_contours_that_meet_are_told_by_both_names() -> None:
    """Two polygons, without a size to change; one circle told twice; an outline that is a hole in the next layer."""
    kite = {"points": [[-25, -25], [25, -25], [0, 35]]}
    for layers, key, code, told in (
        ([{"thickness": 1, "polygons": [SQUARE]}, {"thickness": 1, "polygons": [kite]}], "layers[2].polygons[1]",
         "contours_cross", {"other": "layers[1].polygons[1]"}),
        ([{"thickness": 1, "circles": [{"diameter": 8.0}] * 2}], "layers[1].circles[2].diameter", "contours_cross",
         {"other": "layers[1].circles[1]"}),
        ([{"thickness": 1, "polygons": [SQUARE], "circles": [{"diameter": 8.0}]},
          {"thickness": 1, "circles": [{"diameter": 8.0}]}], "layers[1].circles[1]", "contour_turns", {}),
    ):  # fmt: skip
        found = refused(scene_of({"kind": "layered", "layers": layers}))
        assert found is not None
        assert (found.key, found.code, found.numbers) == (f"parts.p.{key}", code, told)


@pytest.mark.parametrize(("gap", "meets"), [(4.0, False), (0.002, False), (0.0, True), (-2.0, True)])
def test_windows_with_sides_on_one_line_stand_apart_and_those_that_share_a_piece_of_it_meet(
    gap: float, meets: bool
) -> None:
    """Before, those were refused whose boxes have a place in common: two windows one behind the other along x = y."""
    windows = [{"points": [[x, x], [x + 10, x + 10], [x + 10 - wide, x + 10 + wide], [x - wide, x + wide]]}
               for x, wide in ((0, 5), (10 + gap, 6))]  # fmt: skip
    plate = {"points": [[-20, -20], [60, -20], [60, 60], [-20, 60]]}
    layers: list[Keys] = [{"thickness": 2.0, "polygons": [plate, *windows]}]
    found = refused(scene_of({"kind": "layered", "layers": layers}))
    assert (found is not None and found.code == "contours_cross") == meets
    if not meets:
        part = made(layers)
        volume = part.made_by.moments(part.body(0.0)).volume
        assert volume == pytest.approx(2.0 * (80 * 80 - 2 * 50 - 2 * 60), rel=1e-12)

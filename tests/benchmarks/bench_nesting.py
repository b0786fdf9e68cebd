"""Boards against spyrrow (a strip packer by random search): the area that is used, and the time.

``python -m tests.benchmarks.bench_nesting [SECONDS]``; spyrrow is asked where it is installed (pip install spyrrow).
It packs one strip as high as a board, without the holes of parts. Ours is as many boards as it takes: all but the last
count whole, the last as far as pieces lie.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Mapping
from importlib.util import find_spec
from itertools import starmap

import shapely
from shapely.affinity import rotate, translate
from shapely.geometry.base import BaseGeometry

from exporters.boards.nest import Laid, Room, nest
from exporters.production.boards import material
from parts.scene.boards import parts_of_board, pieces_of
from parts.scene.load import load_scene, make_parts, scene_from_toml

_GEAR = '[parts.{0}]\nkind = "spur_gear"\nmodule = {1}\nnumber_of_teeth = {2}\nface_width = 3.0\nbore_diameter = 6.0\n'
_PLATE = '[parts.{0}]\nkind = "plate"\nwidth = {1}\nheight = {2}\ncorner_radius = 4.0\nface_width = 3.0\n'
Shapes = Mapping[str, tuple[BaseGeometry, int]]


def shapes_of(text: str, counts: Mapping[str, int]) -> Shapes:
    parts, _ = make_parts(scene_from_toml(text.encode(), "bench", "bench"), "bench")
    return {name: (material(parts[name].section(0.1).region), count) for name, count in counts.items()}


def cases() -> Mapping[str, Shapes]:
    """Sets of parts for classes: a pair with its frame, a cam with what it moves, a train, one wheel alone."""
    model = make_parts(load_scene("laser_cam_model"), "")[0]
    james = make_parts(load_scene("james_laser"), "")[0]
    pair = _GEAR.format("pinion", 4.0, 13) + _GEAR.format("wheel", 4.0, 21) + _PLATE.format("frame", 150.0, 50.0)
    train = "".join(starmap(_GEAR.format, (("a", 2.0, 17), ("b", 2.0, 31), ("c", 2.0, 46)))) + _PLATE.format(
        "bar", 90, 14
    )
    flat = {"sun": 1, "satellite": 3, "ring": 1, "carrier": 1, "base": 1, "crank": 1}
    return {
        "10 cams with followers": {
            name: (material(model[name].section(0.1).region), count)
            for name, count in {"cam": 10, "follower": 10, "guide": 20, "cover": 10, "frame": 10}.items()
        },
        "10 pairs with frames": shapes_of(pair, {"pinion": 10, "wheel": 10, "frame": 20}),
        "8 trains": shapes_of(train, {"a": 8, "b": 8, "c": 8, "bar": 16}),
        "4 sets of James": {name: (material(james[name].section(0.1).region), 4 * n) for name, n in flat.items()},
        "60 equal wheels": shapes_of(_GEAR.format("wheel", 2.0, 23), {"wheel": 60}),
        "200 equal wheels": shapes_of(_GEAR.format("wheel", 1.5, 20), {"wheel": 200}),
    }


def of_scene(name: str) -> tuple[Shapes, Room]:
    """What the first board of a built-in scene holds, with its names and tags."""
    scene = load_scene(name)
    parts = make_parts(scene, name)[0]
    board = next(iter(scene.boards.values()))
    counts = pieces_of(board, parts_of_board(board, parts, name, ""), scene.instances, name, "")
    shapes = {k: (material(parts[k].cut(board.kerf / 2, gap=board.gap).region), n) for k, n in counts.items()}
    return shapes, Room(board.width, board.height, board.margin, board.gap)


def placed(shapes: Shapes, one: Laid) -> BaseGeometry:
    turned = rotate(shapes[one.shape][0], 90 * one.turn, origin=(0, 0))
    return translate(turned, one.at.real, one.at.imag)


def strip_of_boards(shapes: Shapes, laid: list[Laid], room: Room) -> float:
    """How long a strip of boards is, end to end, without their margins, mm."""
    last = max(one.board for one in laid)
    end = max(placed(shapes, one).bounds[2] for one in laid if one.board == last) - room.margin
    return last * (room.width - 2 * room.margin) + end


def strip_of_spyrrow(shapes: Shapes, room: Room, seconds: int) -> float:
    import spyrrow  # type: ignore[import-not-found]

    items = []
    for name, (shape, count) in shapes.items():
        # of a part with a tag beside it the part alone
        whole = max(shapely.get_parts(shape), key=lambda piece: piece.area)
        outer = shapely.Polygon(whole.exterior).simplify(0.01)
        items.append(spyrrow.Item(name, list(outer.exterior.coords), count, [0.0, 90.0, 180.0, 270.0]))
    instance = spyrrow.StripPackingInstance("board", room.height - 2 * room.margin, items)
    config = spyrrow.StripPackingConfig(
        early_termination=False, total_computation_time=seconds, min_items_separation=room.gap, num_workers=2, seed=1
    )
    return float(instance.solve(config).width)


def main() -> None:
    seconds = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    own_room = Room(600.0, 400.0, 5.0, 2.0)
    found = {name: (shapes, own_room) for name, shapes in cases().items()}
    found |= {name: of_scene(name) for name in ("lesson_3", "lesson_4", "lesson_5", "power_table_laser")}
    for name, (shapes, room) in found.items():
        start = time.process_time()
        laid = nest(shapes, room)
        spent, own = time.process_time() - start, strip_of_boards(shapes, laid, room)
        boards = 1 + max(one.board for one in laid)
        print(f"{name:<24} {len(laid):4d} pieces  {boards} boards  {own:8.1f} mm  {spent:6.2f} s", end="", flush=True)
        if find_spec("spyrrow"):
            other = strip_of_spyrrow(shapes, room, seconds)
            print(f"   spyrrow {other:8.1f} mm: {own / other:.3f}", end="")
        print()


if __name__ == "__main__":
    main()

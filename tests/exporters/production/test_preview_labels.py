"""Names on pictures of scenes stand over no other name, and near what they name."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import numpy as np
import pytest
import shapely

from exporters.command.cli import main
from exporters.production.preview_labels import Label, Tops, spread_labels
from parts.scene.load import load_scene, make_parts
from parts.scene.placing import place
from tests.parts.gears.bevel.test_bevel_differential import frame

PARTS = "".join(f'[parts.plate_number_{k}]\nkind = "plate"\nwidth = 60.0\nheight = 40.0\n'
                f"[instances.plate_number_{k}]\nat = [{25.0 * k}, 0.0, {5.0 * k}]\n" for k in range(1, 9))  # fmt: skip


def overlapping(labels: list[Label | None]) -> int:
    boxes = [label.box for label in labels if label]
    pairs = itertools.combinations(boxes, 2)
    return sum(a[0] < b[2] and b[0] < a[2] and a[1] < b[3] and b[1] < a[3] for a, b in pairs)


def test_words_at_one_place_are_spread() -> None:
    wanted = [Label(f"part_{k}", 10.0, 20.0 + 0.1 * k, 4.0) for k in range(15)]
    assert overlapping(wanted) == 105
    made = spread_labels(wanted)
    assert overlapping(made) == 0
    assert made[0] == wanted[0]
    assert max(abs(m.y - w.y) for m, w in zip(made, wanted, strict=True) if m) < 15 * 4.0
    assert [m.text for m in made if m] == [w.text for w in wanted]


def test_words_that_have_room_stay() -> None:
    wanted = [Label("one", 0.0, 0.0, 4.0), Label("two", 40.0, 0.0, 4.0)]
    assert spread_labels(wanted) == wanted


@pytest.mark.parametrize("text", [PARTS])
def test_parts_over_each_other_keep_their_names_apart(text: str, tmp_path: Path) -> None:
    scene = tmp_path / "pile.toml"
    scene.write_text(f'{text}[[exports]]\nformat = "svg"\n', encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path), "--no-verify"]) in (0, 1)
    picture = (tmp_path / "pile" / "pile.preview.svg").read_text(encoding="utf-8")
    found = re.findall(
        r'<text x="([-\d.e]+)" y="([-\d.e]+)" style="[^"]*font-size:([\d.]+)px[^"]*">(Plate plate_number_\d)<',
        picture,
    )
    assert len(found) == 8
    labels = [Label(name, float(x), float(y), float(size)) for x, y, size, name in found]
    assert overlapping(labels) == 0


def test_no_name_of_a_covered_part_stands_on_the_part_above_it() -> None:
    """Squares over each other and one beside, by the corners of the words' boxes; without the heights it fails."""
    squares = [(10.0, 20.0), (0.0, 60.0), (5.0, 50.0), (10.0, 35.0), (200.0, 20.0)]
    loops = [[np.array([x, x + s, x + s * (1 + 1j), x + s * 1j])] for x, s in squares]
    wanted = [Label(f"part_{k}", x + s / 2, s / 2, 3.0) for k, (x, s) in enumerate(squares)]
    # of the grid
    cell = 220 / 200

    def covered(made: list[Label | None]) -> int:
        found = 0
        for number, label in enumerate(made):
            if label is not None:
                left, top, right, low = label.box
                above = squares[number + 1 :]
                found += any(
                    left + cell < x + s and right - cell > x and top + cell < s and low > cell for x, s in above
                )
        return found

    assert covered(spread_labels(wanted)) > 0
    made = spread_labels(wanted, Tops(loops))
    assert covered(made) == 0
    assert [one is None for one in made] == [True, False, False, False, False]
    assert made[3:] == wanted[3:]


def test_a_hole_shows_what_lies_under_it() -> None:
    square = np.array([0, 40, 40 + 40j, 40j])
    tops = Tops([[square], [square, 10 + 10j + square / 2]])
    assert tops.shows(Label("in", 20.0, 22.0, 4.0), 0)
    assert not tops.shows(Label("in", 20.0, 38.0, 4.0), 0)
    assert tops.shows(Label("in", 20.0, 38.0, 4.0), 1)


def test_a_name_stands_on_no_edge_where_there_is_a_place() -> None:
    square = np.array([0, 40, 40 + 40j, 40j])
    tops = Tops([[square], [square / 2 + 30 + 30j]])
    first, second = spread_labels([Label("wide", 3.0, 20.0, 4.0), Label("side", 31.0, 45.0, 4.0)], tops)
    assert first is not None
    assert second is not None
    for label, (low, high) in ((first, (0, 40)), (second, (30, 50))):
        left, top, right, bottom = label.box
        assert low <= left
        assert right <= high
        assert low <= top
        assert bottom <= high


def test_a_name_without_a_place_over_no_edge_is_written_smaller() -> None:
    """A board among higher ones, for whose name at full height it is too narrow by a tenth."""
    square = np.array([0, 40, 40 + 40j, 40j])
    tops = Tops([[square], *([square + 40 * complex(x, y)] for x in (-1, 0, 1) for y in (-1, 0, 1) if x or y)])
    wanted = Label("ten letter", 20.0, 20.0, 1.1 * 40 / 6.2)
    (made,) = spread_labels([wanted], tops)
    assert made is not None
    assert made.size < wanted.size
    assert tops.shows(made, 0) == 2


def test_names_of_what_is_covered_stand_in_the_caption(tmp_path: Path) -> None:
    scene = tmp_path / "two.toml"
    scene.write_text(
        '[parts.large]\nkind = "plate"\nwidth = 60.0\nheight = 60.0\n[parts.small]\nkind = "plate"\nwidth = 20.0\n'
        "height = 20.0\n[instances.small]\nat = [0.0, 0.0, 0.0]\n[instances.large]\nat = [0.0, 0.0, 9.0]\n"
        '[[exports]]\nformat = "svg"\n',
        encoding="utf-8",
    )
    assert main(["build", str(scene), "--out", str(tmp_path), "--no-verify"]) == 0
    picture = (tmp_path / "two" / "two.preview.svg").read_text(encoding="utf-8")
    assert re.findall(r">([^<>]*Plate[^<>]*)</text>", picture) == [
        "Plate large",
        "without its name in the picture: Plate\xa0small",
    ]


def test_a_name_that_has_no_place_stands_aside_with_a_line_to_what_it_names() -> None:
    """A pin in the middle of a disk that lies over all beside it."""
    turn = np.exp(2j * np.pi * np.arange(60) / 60)
    tops = Tops([[50 + 50j + 5 * turn], [50 + 50j + 45 * turn, 50 + 50j + 5 * turn]])
    pin, disk = spread_labels([Label("input shaft", 50.0, 50.0, 4.0), Label("disk", 50.0, 70.0, 4.0)], tops)
    assert disk is not None
    assert disk.leads is None
    assert pin is not None
    assert pin.leads is not None
    assert abs(pin.leads - (50 + 50j)) < 5
    # the disk is wide enough for its line
    assert (
        5 < min(abs(at - (50 + 50j)) for at in _corners(pin)) < max(abs(at - (50 + 50j)) for at in _corners(pin)) < 45
    )


def _corners(label: Label) -> list[complex]:
    left, top, right, low = label.box
    return [complex(x, y) for x in (left, right) for y in (top, low)]


def _crossing(loops: list[list[np.ndarray]], made: list[Label | None]) -> list[str]:
    """The names of those whose box meets a seen edge of a part: holes and all, less what lies over it; by shapely."""
    shapes = []
    for outer, *holes in loops:
        shape = shapely.Polygon(np.column_stack([outer.real, outer.imag]))
        shapes.append(shape.difference([shapely.Polygon(np.column_stack([h.real, h.imag])) for h in holes]).item(0)
                      if holes else shape)  # fmt: skip
    seen = [
        shape.boundary.difference(shapely.union_all([s.buffer(1e-9) for s in shapes[k + 1 :]]))
        for k, shape in enumerate(shapes)
    ]
    return [label.text for label in made if label and any(edge.intersects(shapely.box(*label.box)) for edge in seen)]


def _roller_on_a_cam() -> tuple[list[list[np.ndarray]], list[Label]]:
    """As lesson 5 has it: a frame, a cam that stands out of it, a roller on the cam, a narrow stem over the roller."""
    turn = np.exp(2j * np.pi * np.arange(120) / 120)
    frame = np.array([0, 60, 60 + 160j, 160j])
    loops = [[frame], [40 + 110j + 35 * turn], [30 + 66j + 10 * turn], [np.array([26, 34, 34 + 66j, 26 + 66j])]]
    wanted = [("frame", 30, 150), ("cam", 40, 120), ("roller", 30, 74), ("stem", 30, 40)]
    return loops, [Label(text, float(x), float(y), 4.0) for text, x, y in wanted]


def test_no_name_crosses_an_edge_or_stands_on_another_part_without_a_line() -> None:
    loops, wanted = _roller_on_a_cam()
    assert _crossing(loops, list(wanted)) == ["roller", "stem"]
    tops = Tops(loops, picture=(-30 - 10j, 110 + 170j))
    made = spread_labels(wanted, tops)
    assert [label.text for label in made if label] == ["frame", "cam", "roller", "stem"]
    assert _crossing(loops, made) == []
    for number, label in enumerate(made):
        assert label is not None
        assert label.leads is not None or tops.shows(label, number)
        if label.leads is not None:
            # well within what is seen of its part
            assert all(
                tops.shows(Label("", label.leads.real + x, label.leads.imag, 1e-6), number) == 2 for x in (-1, 1)
            )


def test_a_line_to_what_it_names_runs_through_no_word() -> None:
    """Eight pins in a disk of two halves, whose words stand between them and its edge; by shapely."""
    turn = np.exp(2j * np.pi * np.arange(60) / 60)
    pins = [50 + 50j + 20 * way + 2 * turn for way in np.exp(2j * np.pi * (np.arange(8) + 0.5) / 8)]
    half = 45 * np.exp(1j * np.pi * np.arange(61) / 60)
    halves = [[50 + 50j + half, *pins[:4]], [50 + 50j - half, *pins[4:]]]
    tops = Tops([*([pin] for pin in pins), *halves], picture=(-20 - 20j, 120 + 120j))
    wanted = [Label(f"pin {k}", 50.0, 50.0, 4.0) for k in range(8)]
    wanted += [Label("a half of the disk", 50.0, 80.0, 4.0), Label("other half of disk", 50.0, 22.0, 4.0)]
    made = [label for label in spread_labels(wanted, tops) if label]
    lines = [(label, shapely.LineString([(at.real, at.imag) for at in label.line])) for label in made if label.line]
    assert len(lines) == 8
    crossing = [
        (label.text, other.text)
        for label, line in lines
        for other in made
        if other != label and line.intersects(shapely.box(*other.box))
    ]
    assert crossing == []
    assert not any(one.crosses(two) for (_, one), (_, two) in itertools.combinations(lines, 2))


def test_a_bevel_gear_that_lies_has_its_teeth_in_the_picture(tmp_path: Path) -> None:
    """Its area is that of all triangles of its own STL seen from the side, by shapely; its hub is no part of a hull."""
    gear = (
        'kind = "bevel_gear"\nmodule = 3.0\nnumber_of_teeth = {}\nmate_number_of_teeth = {}\nhub_diameter = 14.0\n'
        "hub_length = 9.0\nbore_diameter = 5.0\n"
    )
    scene = tmp_path / "pair.toml"
    scene.write_text(
        f'[parts.one]\n{gear.format(12, 15)}[parts.two]\n{gear.format(15, 12)}[[mates]]\nkind = "bevel_pair"\n'
        'first = "one"\nsecond = "two"\n[[exports]]\nformat = "stl"\ntolerance = 0.02\n',
        encoding="utf-8",
    )
    assert main(["build", str(scene), "--out", str(tmp_path), "--no-verify"]) == 0
    picture = (tmp_path / "pair" / "pair.preview.svg").read_text(encoding="utf-8")
    path = re.findall(r'<path d="([^"]*)" style="fill:#', picture)[-1]
    seen = shapely.Polygon(np.array(re.findall(r"(-?[\d.]+),(-?[\d.]+)", path), dtype=float)).area
    rows = np.frombuffer((tmp_path / "pair" / "two.stl").read_bytes()[84:], dtype=[("v", "<f4", 12), ("n", "<u2")])
    corners = rows["v"].reshape(-1, 4, 3)[:, 1:]
    file = load_scene(str(scene))
    parts, matings = make_parts(file, "s")
    stands = place(file.instances, file.drives, parts, matings, "s").instances[1]
    flat = (corners @ frame(stands)[:, :3].T)[:, :, :2]
    (ax, ay), (bx, by) = (flat[:, 1] - flat[:, 0]).T, (flat[:, 2] - flat[:, 0]).T
    areas = np.abs(ax * by - ay * bx)
    whole = shapely.union_all(shapely.polygons(flat[areas > 1e-9])).area
    assert seen == pytest.approx(whole, rel=3e-3)
    assert seen < 0.97 * shapely.MultiPoint(flat.reshape(-1, 2)).convex_hull.area


def test_many_alike_are_named_once(tmp_path: Path) -> None:
    scene = tmp_path / "row.toml"
    scene.write_text(
        '[parts.bed]\nkind = "plate"\nwidth = 90.0\nheight = 90.0\n[parts.locating_pin]\nkind = "pin"\n'
        "diameter = 4.0\nlength = 8.0\n[instances.bed]\nat = [0.0, 0.0, 0.0]\n[instances.locating_pin]\ncount = 8\n"
        'at = [43.0, 0.0, 9.0]\n[[exports]]\nformat = "svg"\n',
        encoding="utf-8",
    )
    assert main(["build", str(scene), "--out", str(tmp_path), "--no-verify"]) == 0
    picture = (tmp_path / "row" / "row.preview.svg").read_text(encoding="utf-8")
    assert re.findall(r">([^<>]*Pin[^<>]*)</text>", picture) == ["Pin × 8"]


def test_no_name_stands_partly_beyond_the_picture() -> None:
    square, beyond = np.array([0, 40, 40 + 40j, 40j]), Label("beyond", 50.0, 20.0, 4.0)
    assert Tops([[square]]).shows(beyond, 0) == 1
    assert Tops([[square]], picture=(-3 - 3j, 58 + 43j)).shows(beyond, 0) == 0


def test_the_uppermost_part_is_known_all_over_a_picture() -> None:
    """Squares within squares by even and odd, at the middle of each of 20 x 20 cells, against shapely."""
    square = np.array([0, 20, 20 + 20j, 20j])
    rings = [[square], [1 + 1j + 0.9 * square, 5 + 5j + 0.5 * square], [10 + 3j + 0.4 * square, 12 + 5j + 0.2 * square]]
    polygons = []
    for loops in rings:
        outer, *holes = (shapely.Polygon(np.column_stack([loop.real, loop.imag])) for loop in loops)
        polygons.append(outer.difference(shapely.union_all(holes)))
    tops = Tops(rings, cells=20)
    seen = set()
    for x in np.arange(20) + 0.5:
        for y in np.arange(20) + 0.5:
            exact = max(k for k, polygon in enumerate(polygons) if polygon.contains(shapely.Point(x, y)))
            seen.add(exact)
            # a word as small as a point: it has half its height of letters about it
            dot = Label("", x, y + 0.35 * 1e-6, 1e-6)
            assert [tops.shows(dot, k) for k in range(3)] == [2 if k == exact else 0 for k in range(3)], (x, y)
    assert seen == {0, 1, 2}
    assert [tops.seen(k) for k in range(4)] == [True, True, True, False]


@pytest.mark.sampled(3)
@pytest.mark.parametrize(("label", "rank"), [
    # letters of 2: 6.2 wide, 2.6 high with their room; on the square alone, over its edge, beside it, too far
    (Label("seven", 20.0, 20.0, 2.0), 2), (Label("seven", 1.0, 20.0, 2.0), 0), (Label("seven", -4.0, 20.0, 2.0), 1),
    (Label("seven", -6.0, 20.0, 2.0), 0), (Label("seven", 20.0, 1.5, 2.0), 0), (Label("seven", 20.0, -1.5, 2.0), 1),
    (Label("seven", 20.0, -3.5, 2.0), 0), (Label("seven", 20.0, 41.0, 2.0), 0), (Label("seven", 20.0, 43.0, 2.0), 1),
    (Label("seven", 20.0, 46.0, 2.0), 0), (Label("seven", 44.0, 20.0, 2.0), 1), (Label("seven", 47.0, 20.0, 2.0), 0),
])  # fmt: skip
def test_a_word_stands_on_beside_or_away_from_its_part(label: Label, rank: int) -> None:
    """A square of 40; beside it: nearer than the height of the letters."""
    tops = Tops([[np.array([0, 40, 40 + 40j, 40j])], [np.array([99, 100, 100 + 1j, 99 + 1j])]], cells=1000)
    assert tops.shows(label, 0) == rank


def test_boxes_of_words_are_as_wide_as_their_letters_and_a_little_more() -> None:
    """0.62 of the height a letter, 0.15 of it free all round; from the foot of the letters up."""
    assert Label("four", 10.0, 50.0, 10.0).box == pytest.approx((10 - 12.4 - 1.5, 50 - 10 - 1.5, 10 + 12.4 + 1.5, 51.5))


def test_a_word_goes_to_the_nearest_place_that_is_free() -> None:
    """Nearest by its way across and half as much again of its way up or down; none beyond the last ring."""
    one, two, three = spread_labels([Label(text, 0.0, 0.0, 4.0) for text in ("aa", "bb", "cc")])
    assert (one.x, one.y) == (0, 0)
    step = 4 * 1.3
    wide = 2 * 0.62 * 4
    # straight below costs 1.5 steps, beside it a width and a tenth
    places = [(0, step), (0, -step)] + [
        (s * wide * w, k * step) for s in (1, -1) for w in (0.6, 1.1, 1.7) for k in (0, 1, -1)
    ]
    free = [(x, y) for x, y in places if abs(x) >= wide + 2 * 0.15 * 4 or abs(y) >= step]
    best = min(abs(x) + 1.5 * abs(y) for x, y in free)
    assert abs(two.x) + 1.5 * abs(two.y) == pytest.approx(best)
    assert abs(three.x) + 1.5 * abs(three.y) >= best
    boxes = [label.box for label in (one, two, three)]
    assert all(
        a[2] <= b[0] or b[2] <= a[0] or a[3] <= b[1] or b[3] <= a[1] for k, a in enumerate(boxes) for b in boxes[:k]
    )


def test_a_word_wider_than_its_part_stands_above_or_below_it_in_a_row() -> None:
    """Neighbours stand beside its ends: lines to all of them were drawn; between two of them it would name neither."""
    square = np.array([0, 40, 40 + 40j, 40j])
    tops = Tops([[square + 60 * k] for k in range(3)], picture=(-60 - 60j, 220 + 100j))
    word = Label("as wide as two", 80.0, -4.0, 11.0)
    left, _, right, _ = word.box
    assert left < 40
    assert right > 120
    assert [tops.shows(word, k) for k in range(3)] == [0, 1, 0]
    assert tops.shows(Label(word.text, 50.0, -4.0, 11.0), 0) == tops.shows(Label(word.text, 50.0, -4.0, 11.0), 1) == 0
    named = spread_labels([Label(f"as wide as two {k}", 20.0 + 60 * k, 24.0, 11.0) for k in range(3)], tops)
    assert [one is not None and one.leads is None and one.x for one in named] == [20.0, 80.0, 140.0]


def test_what_is_told_no_colour_has_one_of_its_own(tmp_path: Path) -> None:
    """Eight parts, as a lesson's model has them: five colours came again from the sixth part on."""
    scene = tmp_path / "pile.toml"
    scene.write_text(f'{PARTS}[[exports]]\nformat = "svg"\n', encoding="utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path), "--no-verify"]) in (0, 1)
    picture = (tmp_path / "pile" / "pile.preview.svg").read_text(encoding="utf-8")
    assert len(set(re.findall(r"fill:(#\w+);fill-opacity", picture))) == 8


def test_instances_of_one_part_have_one_colour(tmp_path: Path) -> None:
    """Twelve like pins of a reducer were of all colours."""
    scene = tmp_path / "row.toml"
    pins = "".join(f'[instances.pin_{k}]\npart = "pin"\nat = [{9.0 * k - 40}, 0.0, 0.0]\n' for k in range(7))
    scene.write_text(
        '[parts.base]\nkind = "plate"\nwidth = 90.0\nheight = 20.0\n[parts.pin]\nkind = "pin"\ndiameter = 4.0\n'
        f'length = 5.0\n[instances.base]\n{pins}[[exports]]\nformat = "svg"\n', encoding="utf-8",
    )  # fmt: skip
    assert main(["build", str(scene), "--out", str(tmp_path), "--no-verify"]) in (0, 1)
    picture = (tmp_path / "row" / "row.preview.svg").read_text(encoding="utf-8")
    colours = re.findall(r"fill:(#\w+);fill-opacity", picture)
    assert (len(colours), len(set(colours))) == (8, 2)


def test_a_word_that_covers_the_end_of_its_line_has_none() -> None:
    """A small word on a corner of its part: it stands on what it names, and a dot stood within the word."""
    assert Label("Base", 10.0, 10.0, 4.0, leads=9.0 + 9.0j).line is None
    assert Label("Base", 10.0, 10.0, 4.0, leads=9.0 + 19.0j).line == (9.0 + 10.6j, 9.0 + 19.0j)

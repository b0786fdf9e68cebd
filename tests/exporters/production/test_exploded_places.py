"""What an exploded view draws over what, where its numbers stand, and every outline in it, by plain isometry."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
import shapely
import shapely.affinity

from exporters.command.cli import main
from exporters.production.exploded_preview import from_behind, seen_at, spread
from tests.exporters.production.test_exploded import isometric, loops

# towards the viewer
SIGHT = np.array([1.0, -1.0, 1.0])


def over(order: list[int], boxes: np.ndarray) -> None:
    """No box is drawn over one that stands before it, on any of many lines of sight through all of the picture."""
    through = np.stack(np.meshgrid(*2 * [np.arange(-20.25, 20, 0.5)], [0.0]), axis=-1).reshape(-1, 3)
    # between which multiples of SIGHT each line runs in each box, from behind
    ends = np.sort((boxes[order][:, None] - through[:, None]) / SIGHT, axis=2)
    first, last = ends[:, :, 0].max(axis=2), ends[:, :, 1].min(axis=2)
    hit = last - first > 1e-9
    assert hit.sum() > 100
    for k in range(1, len(order)):
        both = hit[:k] & hit[k]
        assert (last[:k] <= first[k] + 1e-9)[both].all(), (order, k)


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize("gap", [0.0, 1.5])
def test_of_two_boxes_the_nearer_one_is_drawn_last(axis: int, gap: float) -> None:
    """Side by side along one axis, touching or apart, whichever is named first; the far one as large as may be."""
    near, far = (np.array([[-2.0, -2, -2], [2, 2, 2]]) for _ in range(2))
    way = np.sign(SIGHT[axis])
    near[:, axis] += way * (2 + gap / 2)
    far[:, axis] -= way * (2 + gap / 2)
    far[:, (axis + 1) % 3] *= 4
    for boxes, order in (([far, near], [0, 1]), ([near, far], [1, 0])):
        assert from_behind(np.array(boxes)) == order
        over(order, np.array(boxes))


@pytest.mark.parametrize("seed", range(4))
def test_nothing_is_drawn_over_what_stands_before_it(seed: int) -> None:
    """Boxes of random sizes in the cells of a grid."""
    rng = np.random.default_rng(seed)
    cells = rng.permutation(27)[:9]
    low = np.stack([cells // 9, cells // 3 % 3, cells % 3], axis=1) * 4.0 - 6
    boxes = np.stack([low + rng.uniform(0, 1, low.shape), low + rng.uniform(2.5, 4, low.shape)], axis=1)
    over(from_behind(boxes), boxes)


def test_a_flat_wide_box_under_a_small_tall_one_is_behind_it_though_its_middle_is_nearer() -> None:
    base, post = np.array([[-10.0, -10, 0], [10, 10, 1]]), np.array([[-9.5, 9, 1], [-9, 9.5, 2]])
    assert post.mean(axis=0) @ SIGHT < base.mean(axis=0) @ SIGHT
    assert from_behind(np.array([post, base])) == [1, 0]


def test_what_stands_within_another_is_drawn_over_it() -> None:
    """A ball in its cage: their boxes have no plane between them."""
    cage, ball = np.array([[-5.0, -5, -5], [5, 5, 5]]), np.array([[-4.0, 1, -4], [-1, 4, -1]])
    assert from_behind(np.array([cage, ball])) == [0, 1]
    assert from_behind(np.array([ball, cage])) == [1, 0]


@pytest.mark.parametrize(("wanted", "found"), [
    ([], []),
    ([3.0], [3.0]),
    ([12.0], [10.0]),
    ([1.0, 1.5, 9.0], [1.0, 3.0, 9.0]),
    # 9, 11, 13 end 3 too low: the last goes up to 10 and takes the others with it
    ([9.0, 9.5, 9.8], [6.0, 8.0, 10.0]),
    # the first one has room and stays
    ([0.0, 8.5, 9.0], [0.0, 8.0, 10.0]),
    ([-4.0, -3.0], [-4.0, -2.0]),
])  # fmt: skip
def test_numbers_stand_two_apart_and_end_at_ten(wanted: list[float], found: list[float]) -> None:
    assert spread(wanted, 2.0, 10.0) == found


def square(x: float, y: float, wide: float, high: float) -> shapely.Polygon:
    return shapely.box(x, y, x + wide, y + high)


def test_a_number_stands_in_the_widest_of_what_is_seen() -> None:
    """Squares over each other, what is left of them in strips; the middle of a strip is half its width within."""
    below, strip = square(0, 0, 10, 10), square(3, -1, 2, 12)
    # 3 to the left, 5 to the right of the strip
    found = seen_at(["below", "strip"], [below, strip], ["below"])
    assert found is not None
    assert found.real == pytest.approx(7.5, abs=0.06)
    assert 2.4 < found.imag < 7.6
    # what covers all of it, what is none of these parts, and what only touches
    assert seen_at(["below", "strip"], [below, square(-1, -1, 12, 12)], ["below"]) is None
    assert seen_at(["below", "strip"], [below, strip], ["other"]) is None
    touching = seen_at(["below", "strip"], [below, square(10, 0, 4, 10)], ["below"])
    assert touching == pytest.approx(5 + 5j, abs=0.2)


def test_of_several_alike_the_one_of_which_most_is_seen_has_the_number() -> None:
    shown, shapes = ["pin"] * 3 + ["lid"], [square(20 * k, 0, 10, 10) for k in range(3)]
    # of the first 2, of the second 7, of the third 4 are seen
    lid = shapely.union_all([square(2, -1, 9, 12), square(27, -1, 4, 12), square(44, -1, 7, 12)])
    found = seen_at(shown, [*shapes, lid], ["pin"])
    assert found is not None
    assert found.real == pytest.approx(23.5, abs=0.1)
    # parts of a list stand in one row of it
    assert seen_at(["a", "b", "lid"], [shapes[0], shapes[1], lid], ["a", "b"]) == pytest.approx(found, abs=0.1)


def test_the_second_of_two_and_some_of_many_are_looked_at() -> None:
    """The first is covered; of thirteen every other one is tried, of two both; a small one counts too."""
    for count in (2, 13):
        shapes = [square(k, 0, 0.5, 0.5) for k in range(count)]
        found = seen_at(["pin"] * count + ["lid"], [*shapes, square(-1, -1, 1.75, 3)], ["pin"])
        assert found is not None
        assert found.real > 1
        assert any(shape.contains(shapely.Point(found.real, found.imag)) for shape in shapes[1:])


SCENE = """
[parts.base]
kind = "plate"
width = 60.0
height = 40.0
face_width = 5.0

[parts.block]
kind = "plate"
width = 20.0
height = 10.0
face_width = 4.0
colour = "#204060"

[parts.pin]
kind = "turned"
points = [{ r = 0.0, z = 0.0 }, { r = 4.0, z = 0.0 }, { r = 4.0, z = 20.0 }, { r = 0.0, z = 20.0 }]

[parts.barrel]
kind = "barrel_cam"
form = "groove"
outer_diameter = 24.0
groove_depth = 3.0
roller_diameter = 5.0
lift = 6.0
length = 30.0
phases = [{ move = "rise", angle_deg = 180.0, law = "sine" }, { move = "return_", angle_deg = 180.0, law = "sine" }]

[instances]
base = { part = "base", at = [0, 0, 0] }
block_1 = { part = "block", at = [-15, 10, 5] }
block_2 = { part = "block", at = [15, 10, 5] }
block_3 = { part = "block", at = [20, -10, 5], rotation_deg = 90.0 }
pin_1 = { part = "pin", at = [-20, -10, 5] }
pin_2 = { part = "pin", at = [0, -10, 5], rotation_deg = 37.0 }
pin_3 = { part = "pin", at = [0, -16, 12], axis = [1.0, 0.0, 0.0] }
barrel = { part = "barrel", at = [0, 100, 0] }

[[steps]]
bring = ["block_1", "block_2", "block_3", "pin_1", "pin_2", "pin_3", "barrel"]
to = "base"
along = [0.0, 0.0, -1.0]

[[exports]]
format = "svg"
"""
# corners of what is a box, and of what turns about z; the drum reaches as far as its radius
BLOCKS = {"base": (60, 40, 5), "block_1": (20, 10, 4), "block_2": (20, 10, 4), "block_3": (10, 20, 4)}
ROUND = {"pin_1": (4, 20), "pin_2": (4, 20), "barrel": (12, 30)}


@pytest.fixture(scope="module")
def view(tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("pile")
    (folder / "pile.toml").write_text(SCENE, encoding="utf-8")
    assert main(["build", str(folder / "pile.toml"), "--out", str(folder), "--no-verify", "-q"]) == 0
    return (folder / "pile" / "pile.exploded.preview.svg").read_text(encoding="utf-8")


def hull(name: str) -> list[tuple[complex, complex]]:
    """What an instance covers about its own origin: pairs of its lower and upper rim, seen."""
    if name in BLOCKS:
        x, y, z = BLOCKS[name]
        rim = [(a * x / 2, b * y / 2) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    else:
        radius, z = ROUND[name]
        rim = [(radius * math.cos(t), radius * math.sin(t)) for t in np.linspace(0, 2 * math.pi, 181)]
    return [(isometric(x, y, 0), isometric(x, y, z)) for x, y in rim]


def test_every_outline_is_that_of_its_solid_seen(view: str) -> None:
    """Convex things cover the hull of their rims; what is alike shares a drawing, however a round one is turned."""
    uses = {name: of for name, of in re.findall(r'<use id="(\w+)" xlink:href="#(d\d+)"', view)}
    assert uses["block_1"] == uses["block_2"] != uses["block_3"]
    assert uses["pin_1"] == uses["pin_2"] != uses["pin_3"]
    assert len(set(uses.values())) == 6
    groups = dict(re.findall(r'<g id="(d\d+)">(.*?)</g>', view, re.DOTALL))
    assert groups.keys() == set(uses.values())
    bounds = [loops(group.split('class="o" d="')[1].split('"')[0])[0] for group in groups.values()]
    assert len(bounds) == 6
    size = None
    for name in (*BLOCKS, *ROUND):
        data = groups[uses[name]].split('class="o" d="')[1].split('"')[0]
        (loop,) = loops(data)
        wanted = shapely.MultiPoint([(p.real, p.imag) for pair in hull(name) for p in pair]).convex_hull
        drawn = shapely.Polygon(loop)
        size = size or math.sqrt(drawn.area / wanted.area)
        exact = shapely.affinity.scale(wanted, size, size, origin=(0, 0))
        # an eye sees no less than what is left out and what arcs are off
        assert shapely.hausdorff_distance(exact.boundary, drawn.boundary, densify=0.25) < 0.5, name
        assert len(loop) == (6 if name in BLOCKS else len(loop))


def test_the_upper_face_is_light_and_stands_over_the_walls(view: str) -> None:
    """A box shows its wall, then its upper face, whose corners are the four of its upper rim."""
    uses = dict(re.findall(r'<use id="(\w+)" xlink:href="#(d\d+)"', view))
    groups = dict(re.findall(r'<g id="(d\d+)">(.*?)</g>', view, re.DOTALL))
    base = shapely.Polygon(loops(groups[uses["base"]].split('class="o" d="')[1].split('"')[0])[0])
    size = math.sqrt(base.area / shapely.MultiPoint([(p.real, p.imag) for pair in hull("base") for p in pair]
                                                    ).convex_hull.area)  # fmt: skip
    for name in BLOCKS:
        paths = re.findall(r'<path ([^>]*?) ?d="([^"]*)"/>', groups[uses[name]])
        looks = [look for look, _ in paths]
        assert len(paths) == 3
        assert looks[0].startswith('fill="url(#g')
        assert looks[1].startswith('class="f" fill="#')
        assert looks[2] == 'class="o"'
        (top,) = loops(paths[1][1])
        rim = np.array([[p.real * size, p.imag * size] for _, p in hull(name)])
        assert len(top) == 4
        assert all(np.hypot(*(top - corner).T).min() < 0.11 for corner in rim), name
    block = groups[uses["block_1"]]
    # #204060 lighter by 8 %
    assert 'fill="#234568"' in block


def test_numbers_of_a_path_are_tenths_without_a_zero_before_their_point(view: str) -> None:
    """What SVG allows, and a quarter of the file."""
    for data in re.findall(r' d="(M[^"]*l[^"]*)"', view):
        assert re.fullmatch(r"(M-?\d*\.?\d,-?\d*\.?\d l?|[Ml]|-?(?:[1-9]\d*|0)?(?:\.[1-9])?|[, z])*", data), data[:80]
        assert not re.search(r"(?<!\d)0\.", data)


def test_a_set_for_the_laser_is_drawn_apart_with_the_rods_that_no_file_cuts(tmp_path: Path) -> None:
    """Its pins, feet and shaft are cut to length from rods; one part alone makes no picture of the whole."""
    assert main(["build", "james_laser", "--format", "dxf", "--out", str(tmp_path), "-q"]) == 0
    pictures = {file.name for file in (tmp_path / "james_laser").glob("james_laser*.preview.svg")}
    assert pictures == {"james_laser.preview.svg", "james_laser.exploded.preview.svg"}
    drawn = (tmp_path / "james_laser/james_laser.exploded.preview.svg").read_text("utf-8")
    assert all(word in drawn for word in ("Shaft", "Foot", "Satellite", "Hand crank"))
    assert main(["build", "james_laser", "--part", "sun", "--out", str(tmp_path / "one"), "-q"]) == 0
    assert not [*(tmp_path / "one/james_laser").glob("james_laser*.preview.svg")]

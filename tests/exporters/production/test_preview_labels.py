"""Names on pictures of scenes stand over no other name, and near what they name."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.production.preview_labels import Label, Tops, spread_labels

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
        r'<text x="([-\d.e]+)" y="([-\d.e]+)" style="[^"]*font-size:([\d.]+)px[^"]*">(plate_number_\d)<', picture
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
    assert tops.shows(made, 0) == 3


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
    assert re.findall(r">([^<>]*(?:small|large)[^<>]*)</text>", picture) == [
        "large",
        "without its name in the picture: small",
    ]


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
    assert re.findall(r">([^<>]*pin[^<>]*)</text>", picture) == ["locating_pin × 8"]


def test_no_name_stands_partly_beyond_the_picture() -> None:
    square, beyond = np.array([0, 40, 40 + 40j, 40j]), Label("beyond", 40.0, 20.0, 4.0)
    assert Tops([[square]]).shows(beyond, 0) == 1
    assert Tops([[square]], picture=(-3 - 3j, 43 + 43j)).shows(beyond, 0) == 0

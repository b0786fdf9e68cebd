"""Names on pictures of scenes stand over no other name, and near what they name."""

from __future__ import annotations

import itertools
import re
from pathlib import Path

import pytest

from exporters.command.cli import main
from exporters.production.preview_labels import Label, spread_labels

PARTS = "".join(f'[parts.plate_number_{k}]\nkind = "plate"\nwidth = 60.0\nheight = 40.0\n'
                f"[instances.plate_number_{k}]\nat = [0.0, 0.0, {5.0 * k}]\n" for k in range(1, 9))  # fmt: skip


def overlapping(labels: list[Label]) -> int:
    return sum(a.covers(b) for a, b in itertools.combinations(labels, 2))


def test_words_at_one_place_are_spread() -> None:
    wanted = [Label(f"part_{k}", 10.0, 20.0 + 0.1 * k, 4.0) for k in range(15)]
    assert overlapping(wanted) == 105
    made = spread_labels(wanted)
    assert overlapping(made) == 0
    assert made[0] == wanted[0]
    assert max(abs(m.y - w.y) for m, w in zip(made, wanted, strict=True)) < 15 * 4.0
    assert [m.text for m in made] == [w.text for w in wanted]


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

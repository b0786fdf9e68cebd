"""What is told, by name: steps of calculations, and results, circles and remarks of every kind of part and mate.

``contents.txt`` lists names and never numbers: what a page and a report have to say. Who adds one or drops one runs
``python -m tests.contents`` and reads the difference.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from exporters.documents.topics import sheet_of
from parts.base.texts import words
from parts.pages.page import Sheet
from parts.scene.files import built_in_scenes
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.documents import (
    test_calc,
    test_calc_cam_kinds,
    test_calc_cam_linkage,
    test_calc_pairs,
    test_calc_planetary,
    test_calc_round_pins,
    test_calc_train,
)
from tests.exporters.documents.test_calc import sheet_for
from tests.offered import scenes

FILE = Path(__file__).parent / "contents.txt"
_CAM_SCENES = ("groove_cam", "conjugate_cams", "yoke_cam", "wedge_cam", "barrel_cam part=end", "barrel_cam part=barrel")


def pages() -> dict[str, tuple[str, ...]]:
    """The words of ``calc`` whose pages are listed, by themselves in one line."""
    cams = [test_calc_cam_kinds.GROOVE, test_calc_cam_kinds.SWINGING_BARREL, test_calc_cam_kinds.SWINGING_WEDGE]
    cams += [*test_calc_cam_linkage.WORDS.values(), *((word, *rest) for word, *rest in map(str.split, _CAM_SCENES))]
    found = [*test_calc.SHEETS, *test_calc_round_pins.SHEETS, *(tuple(row.split()) for row in test_calc_pairs.SHEETS)]
    found += [("planetary", *row) for row in test_calc_planetary.SHEETS]
    found += [("train", *row) for row in (test_calc_train.LOADED, test_calc_train.FERGUSON)]
    return {" ".join(row): tuple(row) for row in [*found, *(("cam", *row) for row in cams)]}


@cache
def page_of(page: str) -> Sheet:
    """A page, the same that the tests of pages make where they make it."""
    topic, *rest = pages()[page]
    return sheet_for(page) if page.split() == [topic, *rest] else sheet_of(topic, rest)[0]


def cases() -> list[str]:
    """Scenes of every kind of part and mate, without those that are built in: each of these repeats many a part."""
    return [name for name in scenes() if name not in built_in_scenes()]


def lines_of_page(sheet: Sheet) -> Iterator[str]:
    """Each section with the names of its steps, 1 or 2 behind them of which gear; tables with their heads; remarks."""
    say = words("en").say
    for section in sheet.sections:
        yield from _line(say(section.title), (f"{step.name}{step.gear or ''}" for step in section.steps))
    for table in sheet.tables:
        yield from _line(f"table {table.name}", (symbol for symbol, _ in table.heads))
    yield from _line("data", sorted(sheet.data))
    for note in sheet.notes:
        yield f"  note: {say(note)[:60].rstrip()}"


def lines_of_scene(name: str) -> Iterator[str]:
    """The results, circles and remarks of each part, and the results of each mate."""
    parts, mates = make_parts(scene_from_dict(scenes()[name], name, name), name)
    for key, part in parts.items():
        yield from _line(key, (*part.quantities, *(f"circle {circle}" for circle in part.circles)))
        remarks = (*part.findings, *part.flat_findings)
        yield from _line(f"{key} remarks", (remark.code for remark in remarks))
    for index, mate in enumerate(mates, 1):
        yield from _line(f"mate {index}", mate.quantities())


def _line(head: str, names: Iterable[str]) -> Iterator[str]:
    told = ", ".join(names)
    if told:
        yield f"  {head}: {told}"


def listed() -> dict[str, list[str]]:
    """What the file lists, by page and scene."""
    found, head = dict[str, list[str]](), ""
    for line in FILE.read_text(encoding="utf-8").splitlines():
        if line.startswith("  "):
            found[head].append(line)
        else:
            head = line
            found[head] = []
    return found


if __name__ == "__main__":
    text = [f"calc {page}\n" + "".join(f"{line}\n" for line in lines_of_page(page_of(page))) for page in pages()]
    text += [f"scene {name}\n" + "".join(f"{line}\n" for line in lines_of_scene(name)) for name in cases()]
    FILE.write_text("".join(text), encoding="utf-8")

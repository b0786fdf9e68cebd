"""What is told, by name: steps of pages, results and remarks of every kind of part, what recipes make.

``contents.txt`` lists names and no number. Who adds something or drops it runs ``python -m tests.contents`` and reads
the difference.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from parts.base.fields import given_keys
from parts.base.texts import words
from parts.pages.page import Sheet
from parts.scene.files import built_in_scenes
from parts.scene.load import load_scene, make_parts, scene_from_dict
from tests.exporters.documents import (
    test_calc,
    test_calc_cam_kinds,
    test_calc_cam_linkage,
    test_calc_pairs,
    test_calc_planetary,
    test_calc_round_pins,
    test_calc_strength,
    test_calc_train,
)
from tests.exporters.documents.test_calc import sheet_for
from tests.offered import scenes

FILE = Path(__file__).parent / "contents.txt"
# pages that have what no other has: words of a page in a line, parted by "; "
RARE = Path(__file__).parent / "rare_pages.txt"
_CAM_SCENES = ("groove_cam", "conjugate_cams", "yoke_cam", "wedge_cam", "barrel_cam part=end", "barrel_cam part=barrel")


def pages() -> dict[str, tuple[str, ...]]:
    """The words of ``calc`` whose pages are listed, by themselves in one line."""
    cams = [test_calc_cam_kinds.GROOVE, test_calc_cam_kinds.SWINGING_BARREL, test_calc_cam_kinds.SWINGING_WEDGE]
    cams += [*test_calc_cam_linkage.WORDS.values(), *((word, *rest) for word, *rest in map(str.split, _CAM_SCENES))]
    found = [
        *test_calc.SHEETS,
        *test_calc_round_pins.SHEETS,
        *test_calc_strength.SHEETS,
        *(tuple(row.split()) for row in test_calc_pairs.SHEETS),
    ]
    found += [("planetary", *row) for row in test_calc_planetary.SHEETS]
    found += [("train", *row) for row in (test_calc_train.LOADED, test_calc_train.FERGUSON)]
    rare = [tuple(line.split("; ")) for line in RARE.read_text(encoding="utf-8").splitlines()]
    return {" ".join(row): tuple(row) for row in [*found, *(("cam", *row) for row in cams), *rare]}


def page_of(page: str) -> Sheet:
    """A page, the same that the tests of pages make where they make it."""
    return sheet_for(pages()[page])


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


def recipes() -> list[str]:
    """Built-in scenes of which recipes make parts."""
    return [name for name, file in built_in_scenes().items() if "[[assemblies" in file.read_text("utf-8")]


def lines_of_recipe(name: str) -> Iterator[str]:
    """Each part with the keys that it gives, each instance with its part, mates, drives and steps by what they join."""
    scene = load_scene(name)
    for key, part in scene.parts.items():
        yield from _line(f"{_tag(part)} {key}", _given(part))
    yield from _line(
        "instances", (f"{key} ({spec.part}: {' '.join(_given(spec))})" for key, spec in scene.instances.items())
    )
    yield from _line("mates", (f"{_tag(m)} {m.first} {m.second} ({' '.join(_given(m))})" for m in scene.mates))
    yield from _line("drives", (f"{d.instance} ({' '.join(_given(d))})" for d in scene.drives))
    yield from _line("steps", (" ".join(_given(step)) for step in scene.steps))


def _tag(spec: Any) -> str:
    return str(type(spec).__struct_config__.tag)


def _given(spec: Any) -> list[str]:
    """Keys whose values are not those that they have when nothing is said."""
    return [key for key, value in given_keys(spec).items() if value not in ([], {})]


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


def written() -> Iterator[str]:
    """The file as it has to be."""
    for kind, names, lines in KINDS_OF_LIST:
        for name in names():
            yield from (f"{kind} {name}", *lines(name))


KINDS_OF_LIST: tuple[tuple[str, Callable[[], Iterable[str]], Callable[[str], Iterator[str]]], ...] = (
    ("calc", pages, lambda page: lines_of_page(page_of(page))),
    ("scene", cases, lines_of_scene),
    ("recipe", recipes, lines_of_recipe),
)


if __name__ == "__main__":
    FILE.write_text("".join(f"{line}\n" for line in written()), encoding="utf-8")

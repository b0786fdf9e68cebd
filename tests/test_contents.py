"""Pages, reports and recipes hold what ``contents.txt`` lists, no more and no less."""

from __future__ import annotations

from functools import cache

import pytest

from tests.contents import KINDS_OF_LIST, lines_of_page, listed, page_of, pages

LISTED = cache(listed)

# of a second and more
SLOW = ("calc power-module orientation", "calc power-module load=2000",
        "calc planetary scheme=one_external", "calc shift-choice first.number_of_teeth=17",
        "calc shift-choice kind=internal_gear_pair module=2 first.number_of_teeth=20",
        "calc power-module module=4", "calc power-module force_x=600",
        "calc worm module=2 number_of_teeth=40 outer_diameter=99",
        "calc worm module=2 number_of_teeth=40 face_width=200",
         "recipe power_module")  # fmt: skip
CASES = [
    pytest.param(kind, name, marks=pytest.mark.heavy) if f"{kind} {name}".startswith(SLOW) else (kind, name)
    for kind, names, _ in KINDS_OF_LIST for name in names()
]  # fmt: skip


@pytest.mark.parametrize(("kind", "name"), CASES)
def test_what_is_told_is_what_is_listed(kind: str, name: str) -> None:
    lines = next(lines for known, _, lines in KINDS_OF_LIST if known == kind)
    assert list(lines(name)) == LISTED()[f"{kind} {name}"]


def test_nothing_else_is_listed() -> None:
    assert {*LISTED()} == {f"{kind} {name}" for kind, names, _ in KINDS_OF_LIST for name in names()}


def test_a_step_that_is_lost_is_seen() -> None:
    page = next(iter(pages()))
    sheet = page_of(page)
    sheet.sections[0].steps.insert(0, lost := sheet.sections[0].steps.pop())
    try:
        assert list(lines_of_page(sheet)) != LISTED()[f"calc {page}"]
    finally:
        sheet.sections[0].steps.append(sheet.sections[0].steps.pop(0))
    assert lost is sheet.sections[0].steps[-1]

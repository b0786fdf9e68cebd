"""Pages and reports hold what ``contents.txt`` lists, no more and no less."""

from __future__ import annotations

from functools import cache

import pytest

from tests.contents import cases, lines_of_page, lines_of_scene, listed, page_of, pages

LISTED = cache(listed)


@pytest.mark.parametrize("page", pages())
def test_a_page_holds_what_is_listed(page: str) -> None:
    assert list(lines_of_page(page_of(page))) == LISTED()[f"calc {page}"]


@pytest.mark.parametrize("scene", cases())
def test_parts_and_mates_tell_what_is_listed(scene: str) -> None:
    assert list(lines_of_scene(scene)) == LISTED()[f"scene {scene}"]


def test_nothing_else_is_listed() -> None:
    assert {*LISTED()} == {*(f"calc {page}" for page in pages()), *(f"scene {name}" for name in cases())}


def test_a_step_that_is_lost_is_seen() -> None:
    page = next(iter(pages()))
    sheet = page_of(page)
    sheet.sections[0].steps.insert(0, lost := sheet.sections[0].steps.pop())
    try:
        assert list(lines_of_page(sheet)) != LISTED()[f"calc {page}"]
    finally:
        sheet.sections[0].steps.append(sheet.sections[0].steps.pop(0))
    assert lost is sheet.sections[0].steps[-1]

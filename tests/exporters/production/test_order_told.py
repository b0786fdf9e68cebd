"""The order of assembly as it is told: ways by their directions, pairs by how they were decided, what is hindered."""

from __future__ import annotations

from typing import Any

import pytest

from exporters.production.check_lines import check_lines
from exporters.production.order import hindered_told, order_lines, steps_told
from parts.base.texts import words
from parts.scene.steps import StepSpec

NAMES = {"a": "Gear A", "pin_1": "Pin 1", "pin_2": "Pin 2", "pin_3": "Pin 3"}


@pytest.mark.parametrize(("keys", "way"), [
    ({"along": [0.0, 0.0, -1.0]}, "from above"), ({"along": [0.0, 0.0, 0.5]}, "from below"),
    ({"along": [3.0, 0.0, 0.0]}, "along x"), ({"along": [-1.0, 0.0, 0.0]}, "against x"),
    ({"along": [0.0, 2.0, 0.0]}, "along y"), ({"along": [0.0, -2.0, 0.0]}, "against y"),
    # by its greatest share
    ({"along": [1.0, -4.0, 2.0]}, "along (0.25, -1, 0.5)"), ({}, "each straight to its axis"),
    ({"along": [0.0, 0.0, -1.0], "outwards": 2.5}, "from above, then 2.5 mm outwards from its axis"),
    ({"along": [0.0, 0.0, -1.0], "outwards": -2.5}, "from above, then 2.5 mm inwards to its axis"),
    ({"along": [1.0, 0.0, 0.0], "outwards": 8.0, "one_hole": True},
     "along x, then 8 mm outwards from its axis, each through the hole of the first, the row turned on"),
    ({"along": [0.0, 0.0, -1.0], "opened": 1.5}, "from above, opened by 1.5 mm"),
    ({"along": [0.0, 1.0, 0.0], "screwed": True}, "along y, turned in along its thread or teeth"),
])  # fmt: skip
def test_each_way_has_its_words(keys: dict[str, Any], way: str) -> None:
    (line,) = steps_told([StepSpec(bring=["pin_1", "pin_2", "pin_3"], to="a", **keys)], NAMES, "en")
    assert line == f"1. Pin 1 ... Pin 3 to Gear A: {way}"


def test_steps_are_numbered_and_names_that_nobody_gave_are_ids() -> None:
    steps = [StepSpec(bring=["x", "pin_1"], to="y"), StepSpec(bring=["y"], to="a")]
    lines = [*steps_told(steps, NAMES, "en")]
    assert lines == ["1. x, Pin 1 to y: each straight to its axis", "2. y to Gear A: each straight to its axis"]
    assert [*steps_told(steps, NAMES, "uk")] != lines


HINDERED = {"step": 2, "coming": "a", "standing": "x", "volume": 1.23456, "verdict": "overlap"}


def test_what_is_hindered_is_told_with_what_is_in_its_way() -> None:
    told = words("en")
    said = "step 2: a does not reach its place past x: 1.235 mm^3 in its way"
    assert hindered_told(HINDERED, told) == said
    assert hindered_told(HINDERED, told, NAMES) == said.replace(" a ", " Gear A ")
    thin = HINDERED | {"volume": None, "verdict": "undecided"}
    assert hindered_told(thin, told) == "step 2: a wall is too thin to tell whether a reaches its place past x"


def test_pairs_are_counted_by_how_they_were_decided() -> None:
    pairs = {"boxes": 12, "mesh": 0, "sections": 1, "layers": 3, "solids": 2}
    found = {"steps": 4, "pairs": pairs, "hindered": []}
    decided = "12 pairs apart by boxes, 1 pair by sections about their axes, 3 pairs layer by layer, 2 pairs by solids"
    assert [*order_lines(found, words("en"))] == [
        f"order of assembly, 4 steps: each part reaches its place straight, past all that stands: {decided}"
    ]
    hindered = found | {"steps": 1, "hindered": [HINDERED, HINDERED | {"volume": None, "verdict": "undecided"}]}
    assert check_lines({"order": hindered}, "en", NAMES) == [
        f"order of assembly, 1 step: {decided}",
        "OVERLAP: step 2: Gear A does not reach its place past x: 1.235 mm^3 in its way",
        "UNDECIDED: step 2: a wall is too thin to tell whether Gear A reaches its place past x",
    ]

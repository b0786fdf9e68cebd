"""``higherpair calc`` against worked examples of textbooks: gears, helical gears, a worm, cams."""

from __future__ import annotations

import json
from typing import Any

import pytest

from exporters.documents.topics import calculate, sheet_of
from tests.exporters.documents.test_calc import PUBLISHED, evaluated

CASES = json.loads((PUBLISHED / "textbook_pages.json").read_text(encoding="utf-8"))["cases"]


@pytest.mark.sampled(12)
@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_what_a_textbook_prints(case: dict[str, Any]) -> None:
    topic, *words = case["words"]
    values = json.loads(calculate(topic, words, "json", "en"))["values"]
    for name, (printed, near) in case["printed"].items():
        key, _, gear = name.partition(".")
        found = values[key][gear] if gear else values[key]
        assert found == pytest.approx(printed, abs=near), name
        # five hundredths more would be noticed
        assert abs(found * 1.05 - printed) > near, name


@pytest.mark.parametrize(
    "words",
    [
        ("size=25z x 1m x 30P x 5H/6e", "standard=ISO 4156", "length=20"),
        ("size=60z x 10m x 30R x 7H", "standard=ISO 4156", "torque=500", "length=40"),
        ("size=50x2x9H/9g",),
        ("size=120x3x38x9H/8f", "standard=DIN 5480", "pin_diameter=6"),
    ],
)
def test_formulas_of_the_limits_of_a_spline_give_them(words: tuple[str, ...]) -> None:
    steps = [step for step in sheet_of("involute-spline", words)[0].steps() if step.formula]
    assert sum(step.name.startswith(("least_", "greatest_")) for step in steps) >= 5
    for step in steps:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-9, abs=1e-9), step.name

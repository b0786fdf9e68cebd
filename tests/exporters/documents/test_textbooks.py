"""``higherpair calc`` against worked examples of textbooks: gears, helical gears, a worm, cams."""

from __future__ import annotations

import json
from typing import Any

import pytest

from exporters.documents.topics import calculate
from tests.exporters.documents.test_calc import PUBLISHED

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

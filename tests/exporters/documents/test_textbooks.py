"""``higherpair calc`` against worked examples of textbooks: gears, helical gears, a worm, cams."""

from __future__ import annotations

import json
from typing import Any

import pytest

from exporters.documents.topics import calculate, sheet_of
from parts.base.refusal import SceneError
from tests.exporters.documents.test_calc import PUBLISHED, evaluated

CASES = json.loads((PUBLISHED / "textbook_pages.json").read_text(encoding="utf-8"))["cases"]


@pytest.mark.sampled(12)
@pytest.mark.parametrize("case", CASES, ids=[case["id"] for case in CASES])
def test_what_a_textbook_prints(case: dict[str, Any]) -> None:
    topic, *words = case["words"]
    data = json.loads(calculate(topic, words, "json", "en"))
    # names are told once, links and points of a lever mechanism have their signs
    values = data["values"] | {step["symbol"]: step["value"] for step in data["steps"] if topic == "lever"}
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


@pytest.mark.parametrize("words", [("spline", "size=6x23x26"), ("involute-spline", "size=50x2")], ids=lambda w: w[0])
def test_a_share_of_the_sides_carries_a_torque_alone(words: tuple[str, ...]) -> None:
    topic, *keys = words
    with pytest.raises(SceneError, match=r"load_share = 0\.7: needs torque too"):
        calculate(topic, [*keys, "load_share=0.7"], "text", "en")


def test_limits_of_a_straight_spline_are_those_of_a_worked_example() -> None:
    """A Ukrainian coursework, d-6x18x22: 0.018/-0.018 on d, -0.3/-0.43 on D, 0.01/0.028 and -0.03/-0.048 on b."""
    page = sheet_of("spline", ("size=d-6x18H7/h7x22H12/a11x5F8/d8",))[0]
    limits, clearances = (next(t for t in page.tables if t.name == name) for name in ("limits", "clearances"))
    told = {labels[:2]: row for labels, row in zip(limits.labels, limits.rows, strict=True)}
    assert told["d", "hub"] == pytest.approx((18, 0, 18.018, 18))
    assert told["d", "shaft"] == pytest.approx((0, -18, 18, 17.982))
    assert told["D", "hub"] == pytest.approx((210, 0, 22.21, 22))
    assert told["D", "shaft"] == pytest.approx((-300, -430, 21.7, 21.57))
    assert told["b", "hub"] == pytest.approx((28, 10, 5.028, 5.01))
    assert told["b", "shaft"] == pytest.approx((-30, -48, 4.97, 4.952))
    assert [row for _, row in zip(clearances.labels, clearances.rows, strict=True)] == [
        pytest.approx(pair) for pair in ((0, 36), (300, 640), (40, 76))
    ]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("cutter", [24, 25, 30, 38, 40, 60, 80, 100])
def test_rings_of_eighteen_teeth_more_than_the_cutter_can_be_fed_into(cutter: int) -> None:
    """Elements of Metric Gear Technology, table 5-3 (1): without shifts no tip is trimmed from z0 + 18 teeth on."""
    for more, fits in ((17, False), (18, True)):
        words = ("kind=internal_gear_pair", "module=1", f"first.number_of_teeth={cutter}",
                 f"second.number_of_teeth={cutter + more}", "first.basic_rack.addendum_coefficient=1.25",
                 "second.tip_rule=KHK", "second.rounded_root.full_round=true")  # fmt: skip
        values = json.loads(calculate("gear-pair", words, "json", "en"))["values"]
        # the ring has its tips whole, and the pinion those of a cutter
        assert values["tip_radius"]["second"] == pytest.approx((cutter + more) / 2 - 1, rel=1e-12)
        assert values["tip_radius"]["first"] == pytest.approx(cutter / 2 + 1.25, rel=1e-12)
        assert (values["radial_assembly_margin"] > 0) == fits

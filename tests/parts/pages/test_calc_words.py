"""Calculations in English hold no Ukrainian letter, give typed numbers back, and tell steps of one name apart."""

from __future__ import annotations

import json
import math
import re

import pytest

from exporters.documents.render import SPOKEN
from exporters.documents.topics import calculate
from geometry.laws.named import NAMED_LAWS
from parts.base.texts import words
from parts.keys.law import LawTable, law_of
from parts.mates.pages import shift_choice
from parts.pages.cam_steps import as_typed, law_text
from parts.pages.page import number, pretty
from parts.pages.symbols import symbol_text
from parts.pages.terms import TERMS

CYRILLIC = re.compile("[а-яіїєґА-ЯІЇЄҐ]")
SHEETS = {
    "noncircular": ("noncircular", ["oval_gears", "part=oval"]),
    "lantern": ("lantern", ["lantern_pair"]),
    "geneva": ("geneva", ["geneva_drive", "part=ring"]),
    "ratchet": ("ratchet", ["ratchet", "part=ring", "torque=5"]),
    "chain": ("chain", ["chain_drive", "part=printed_pinion", "speed_rpm=300", "torque=5"]),
    "belt": ("belt", ["belt_drive", "speed_rpm=300", "torque=0.5"]),
    "cycloidal": ("cycloidal", ["cycloidal_reducer"]),
    "barrel": ("cam", ["barrel_cam", "part=barrel"]),
    "wedge": ("cam", ["wedge_cam"]),
    "linkage": ("cam", ["linkage_cam"]),
    "yoke": ("cam", ["yoke_cam"]),
    "cam": ("cam", ["guidelines_cam"]),
}


def test_every_symbol_has_an_english_index() -> None:
    found = [term.symbol for term in TERMS.values() if CYRILLIC.search(term.symbol)]
    assert len(found) > 20
    assert [s for s in found if CYRILLIC.search(symbol_text(s, words("en")))] == []
    assert symbol_text("z_екв", words("en")) == "z_e"
    assert symbol_text("z_екв", words("uk")) == "z_екв"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("topic", "asked"), SHEETS.values(), ids=SHEETS.keys())
@pytest.mark.parametrize("form", SPOKEN)
def test_an_english_calculation_has_no_ukrainian_letter(topic: str, asked: list[str], form: str) -> None:
    told = calculate(topic, asked, form, "en")
    assert CYRILLIC.findall(told) == []
    assert CYRILLIC.search(calculate(topic, asked, form, "uk"))


@pytest.mark.parametrize("name", NAMED_LAWS)
def test_every_law_is_told_in_ukrainian_backwards_too(name: str) -> None:
    """No word of English is left; a name of a person and CV are no words."""
    for back in (False, True):
        told = words("uk").say(law_text(law_of(LawTable(name=name, reverse=back), "law").name))
        assert CYRILLIC.search(told), told
        assert re.findall(r"(?i)[a-z]{3,}", told) == [], told


CAM = ["follower=roller", "follower_radius=10", "lift=30", "base_circle_radius=50", 'phases=[{move="rise", angle_deg=95'
       ', law="sine", share=0.7}, {move="rise", angle_deg=71, law="sine", share=0.3}, {move="return_", angle_deg=121, '
       'law="cosine"}, {move="dwell", angle_deg=73}]']  # fmt: skip


def test_the_lift_is_what_was_typed_and_factors_tell_their_phases() -> None:
    data = json.loads(calculate("cam", CAM, "json", "en"))
    assert data["values"]["lift"] == 30.0
    assert [phase["angle_deg"] for phase in data["phases"]] == [95.0, 71.0, 121.0, 73.0]
    assert data["values"]["least_base_circle_radius"] == 50.0
    factors = [step["text"] for step in data["steps"] if step["name"] == "graphical_factor"]
    assert len(set(factors)) == len(factors) == 3
    assert "rise" in factors[0]
    assert "return" in factors[2]


def test_only_rounding_is_taken_for_what_was_typed() -> None:
    assert as_typed(30.000000000000007) == 30.0
    assert as_typed(45.81466903731541) == 45.81466903731541
    assert as_typed(30.0000000001) == 30.0000000001


@pytest.mark.parametrize(
    ("formula", "printed"),
    [
        ("m * z / 2", "m·z/2"),
        ("pi * m", "π·m"),
        ("abs((e - f) / f) * 100", "|(e - f)/f|·100"),
        ("abs(a)", "|a|"),
        ("abs(arctan(a / (b - sin(c))) - 1) * abs(d)", "|arctan(a/(b - sin c)) - 1|·|d|"),
        ("cos(alpha)**2", "cos² alpha"),
        ("tan(gamma + rho)", "tan(gamma + rho)"),
        ("inv(alpha)", "inv alpha"),
        ("sqrt(a**2 + b**3)", "√(a² + b³)"),
        ("cbrt(x)", "∛(x)"),
        ("q**(1 / (a + b)) * c**2", "q^(1/(a + b))·c²"),
    ],
)
def test_formulas_are_printed_as_they_are_written_by_hand(formula: str, printed: str) -> None:
    assert pretty(formula, words("en")) == printed


@pytest.mark.parametrize(
    ("value", "unit", "enclosed", "printed"),
    [
        (0.1 + 0.2, "mm", False, "0.3"), (-0.0, "mm", False, "0"), (1 / 3, "mm", False, "0.33333"), (3, "", False, "3"),
        (0.0149043838673, "", False, "0.0149044"), (-2.5, "deg", True, "(-2.5°)"), (20.0, "deg", True, "20°"),
        (math.inf, "mm", False, "∞"), (-math.inf, "mm", False, "-∞"), (12.3456, "%", False, "12.346"),
        # no digit that a number of double precision has not
        (1e9 / 3 * 1e11, "N", False, "3.33333333333333e+19"), (123456789012345.678, "mm", False, "123456789012346"),
        (9999999999.123456, "mm", False, "9999999999.12346"), (-1e300, "N", True, "(-1e+300)"),
    ],
)  # fmt: skip
def test_numbers_are_printed_as_a_reader_wants_them(value: float, unit: str, enclosed: bool, printed: str) -> None:
    assert number(value, unit, enclosed=enclosed) == printed


def test_a_table_without_a_pair_tells_which_of_both_it_lacks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Before: ``у таблиці для нього поруч із 13 немає рекомендованого зміщення``, of no gear that was named."""
    # tables alone: what is sought, and the contour, take a hundred times as long
    monkeypatch.setattr(shift_choice, "_found_choices", lambda *given: [])
    monkeypatch.setattr(shift_choice, "usual_box", lambda pair: None)
    asked = ["first.number_of_teeth=13", "second.number_of_teeth=21", "module=4"]
    told = {language: calculate("shift-choice", asked, "text", language) for language in ("en", "uk")}
    assert "kinematic drive: no shift is recommended for 21 teeth beside 13; at least 22 works" in told["en"]
    assert "для числа зубців 21 поруч із 13 зміщення не рекомендовано; підходить щонайменше 22" in told["uk"]


def test_a_percentage_has_a_space_before_its_sign() -> None:
    """As in all other texts (ISO 80000-1, 7.1.4); it was ``0%``."""
    page = calculate("gear-pair", ["practicum_pair"], "text", "uk")
    assert re.search(r"= 0 %$", page, re.MULTILINE)
    assert not re.search(r"\d%", page)


def test_a_designation_that_has_no_symbol_stands_alone() -> None:
    """Before: ``— = M20-6g``, and a dash in the column of formulas."""
    told = {form: calculate("thread", ["thread=M20"], form, "uk") for form in ("text", "md")}
    assert "позначення різьби\n    M20-6g\n" in told["text"]
    assert "| позначення різьби |  | M20-6g |" in told["md"]

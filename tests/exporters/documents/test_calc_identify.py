"""An unknown gear by two spans: against published spans, and against gears whose spans are written down anew here."""

from __future__ import annotations

import json
import math
import re
import tomllib
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.exporters.making import run


def identified(capsys: pytest.CaptureFixture[str], **keys: float) -> dict[str, Any]:
    capsys.readouterr()
    assert run("calc", "identify", *(f"{k}={v}" for k, v in keys.items()), "--format", "json") == 0
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


# KHK, Gear Technical Reference, calculations of spans: m 3, 20 degrees, z 24, x 0.4; spur over 4, at 25 degrees over 5
@pytest.mark.parametrize(
    ("span", "spanned", "helix"), [(32.8266, 4, 0.0), (42.0085, 5, 25.0)], ids=["spur", "helical"]
)  # fmt: skip
def test_the_gears_of_published_spans_are_found(
    capsys: pytest.CaptureFixture[str], span: float, spanned: int, helix: float
) -> None:
    tip = 3 * 24 / math.cos(math.radians(helix)) + 2 * 3 * (1 + 0.4)
    found = identified(
        capsys, number_of_teeth=24, teeth_spanned=spanned, span=span, next_span=span + 8.856,
        helix_angle_deg=helix, tip_diameter=tip, root_diameter=tip - 2 * 3 * 2.25,
    )["values"]  # fmt: skip
    assert (found["module"], found["pressure_angle_deg"]) == pytest.approx((3.0, 20.0), rel=1e-12)
    assert found["profile_shift_coefficient"] == pytest.approx(0.4, abs=1e-4)
    assert (found["addendum_coefficient"], found["dedendum_coefficient"]) == pytest.approx((1.0, 1.25), abs=1e-4)
    # the faces touch at both ends of W, which leans by beta_b: sin beta_b = sin beta cos alpha_n
    sine = math.sin(math.radians(helix)) * math.cos(math.radians(20))
    alpha = math.atan(math.tan(math.radians(20)) / math.cos(math.radians(helix)))
    base = 72.0 / math.cos(math.radians(helix)) * math.cos(alpha)
    touched = math.sqrt(base**2 + (span + 8.856) ** 2 * (1 - sine**2))
    assert found["span_contact_diameter"] == pytest.approx(touched, rel=1e-9)


def test_the_scene_that_is_told_has_the_span_that_was_measured(capsys: pytest.CaptureFixture[str]) -> None:
    first, second = spans_of(2.5, 20.0, 31, 0.2371, 4)
    keys = {"number_of_teeth": 31, "teeth_spanned": 4, "span": first, "next_span": second}
    (told,) = [note.partition(": ")[2] for note in identified(capsys, **keys)["notes"] if note.startswith("in a scene")]
    assert run("calc", "spur", *told.replace(" = ", "=").split(", "), "teeth_spanned=4", "--format", "json") == 0
    assert json.loads(capsys.readouterr().out)["values"]["span"] == pytest.approx(first, abs=1e-3)


# NREL 5 MW gearboxes print shifts beside sizes over pins; a helical ring's is written down anew below
@pytest.mark.parametrize(
    ("module", "teeth", "pin", "over", "shift"),
    [(45.0, 19, 95.0, 1050.69, 0.617), (45.0, 17, 110.0, 1008.755, 0.80211), (21.0, 36, 40.0, 836.492, 0.50391)],
)
def test_shifts_are_found_by_published_sizes_over_pins(
    capsys: pytest.CaptureFixture[str], module: float, teeth: int, pin: float, over: float, shift: float
) -> None:
    found = identified(capsys, module=module, number_of_teeth=teeth, pin_diameter=pin, over_pins=over)["values"]
    # printed to 0.005 mm
    assert found["profile_shift_coefficient"] == pytest.approx(shift, abs=0.01 / module)


@pytest.mark.parametrize("teeth", [60, 61])
@pytest.mark.parametrize(("key", "sign"), [("over_pins", 1), ("between_pins", -1)])
@pytest.mark.parametrize(("angle", "helix"), [(20.0, 0.0), (25.0, -30.0)])
def test_shifts_are_found_by_a_ball_between_two_flanks(
    capsys: pytest.CaptureFixture[str], key: str, sign: int, teeth: int, angle: float, helix: float
) -> None:
    """The ball's centre stands where an involute parallel to the flank by its radius meets the middle of the space."""
    shift, module, ball = 0.37, 2.0, 3.6
    alpha, beta = math.radians(angle), math.radians(abs(helix))
    across = math.atan(math.tan(alpha) / math.cos(beta))
    base = module * teeth / math.cos(beta) * math.cos(across)
    # half of the space at the base circle; of a ring that of an external tooth of the same shift
    half = math.tan(across) - across + (math.pi / 2 + 2 * shift * math.tan(alpha)) / teeth
    polar = half + sign * ball / (module * teeth * math.cos(alpha)) - (math.pi / teeth if sign > 0 else 0.0)
    low, high = 0.0, 1.5
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if math.tan(middle) - middle < polar else (low, middle)
    size = base / math.cos(low) * (math.cos(math.pi / (2 * teeth)) if teeth % 2 else 1.0) + sign * ball
    keys = {"number_of_teeth": teeth, "pin_diameter": ball, "module": module, "helix_angle_deg": helix, key: size}
    reference = module * teeth / math.cos(beta)
    heights = {"tip_diameter": reference + 2 * module * (shift + sign), "root_diameter": reference + 2 * module * (
        shift - 1.25 * sign)}  # fmt: skip
    found = identified(capsys, pressure_angle_deg=angle, **keys, **heights)["values"]
    assert found["profile_shift_coefficient"] == pytest.approx(shift, abs=1e-9)
    assert (found["addendum_coefficient"], found["dedendum_coefficient"]) == pytest.approx((1.0, 1.25), abs=1e-9)


def spans_of(module: float, angle_deg: float, teeth: int, shift: float, spanned: int) -> list[float]:
    """Arcs of the base circle, which a calliper's faces unroll: k - 1 pitches and a tooth."""
    alpha = math.radians(angle_deg)
    base, tooth = module * teeth * math.cos(alpha) / 2, math.pi / 2 + 2 * shift * math.tan(alpha)
    half = tooth / teeth + math.tan(alpha) - alpha
    return [2 * base * (half + (k - 1) * math.pi / teeth) for k in (spanned, spanned + 1)]


@pytest.mark.parametrize(
    ("module", "angle"),
    [(2.0, 20.0), (25.4 / 12, 14.5), (25.4 / 24, 20.0), (25.4 / 32, 14.5), (5.0, 25.0), (0.8, 20.0)],
)
def test_modules_and_diametral_pitches_are_found_off_readings_of_a_hundredth(
    capsys: pytest.CaptureFixture[str], module: float, angle: float
) -> None:
    first, second = spans_of(module, angle, 30, 0.25, 4)
    for slip in (-0.01, 0.0, 0.01) if module > 1 else (0.0,):
        keys = {"number_of_teeth": 30, "teeth_spanned": 4, "span": first, "next_span": second + slip}
        found = identified(capsys, **keys)["values"]
        assert (found["module"], found["pressure_angle_deg"]) == pytest.approx((module, angle), rel=1e-12)
        assert found["profile_shift_coefficient"] == pytest.approx(0.25, abs=1e-9)


@pytest.mark.parametrize(
    ("module", "angle", "teeth", "spanned", "shift"),
    # of the last nothing else fits: a seldom shift goes before a pitch that is not there
    [(1.5, 25.0, 62, 9, -0.256), (5.0, 30.0, 49, 9, -0.261), (2.75, 14.5, 92, 8, -0.115), (2.0, 20.0, 30, 5, 1.3)],
)
def test_of_angles_that_fit_both_spans_that_comes_first_whose_shift_gears_have(
    capsys: pytest.CaptureFixture[str], module: float, angle: float, teeth: int, spanned: int, shift: float
) -> None:
    """1.5 mm at 25 degrees are 18 teeth an inch at 14.5 within 0.5 %, with a shift of 2.2."""
    first, second = spans_of(module, angle, teeth, shift, spanned)
    keys = {"number_of_teeth": teeth, "teeth_spanned": spanned, "span": first, "next_span": second}
    page = identified(capsys, **keys)
    found = page["values"]
    assert (found["module"], found["pressure_angle_deg"]) == pytest.approx((module, angle), rel=1e-12)
    assert found["profile_shift_coefficient"] == pytest.approx(shift, abs=1e-9)
    assert page["modules"][0]["x"] == pytest.approx(shift, abs=1e-9)


# module, angle, teeth, heights above and below the pitch line in modules
@pytest.mark.parametrize(
    ("module", "angle_deg", "teeth", "addendum", "dedendum"),
    [
        (3.0, 25.0, 24, 1.0, 1.25),
        (25.4 / 9, 14.5, 24, 1.0, 1.157),
        (2.0, 20.0, 30, 0.8, 1.0),
        (4.0, 30.0, 17, 0.9, 1.2),
    ],
)
def test_of_angles_that_fit_both_spans_that_comes_first_whose_teeth_are_as_high_as_teeth_are(
    capsys: pytest.CaptureFixture[str], module: float, angle_deg: float, teeth: int, addendum: float, dedendum: float
) -> None:
    """Module 3 of 25 degrees read to a hundredth was told to be 9 / inch of 14.5, whose roots would be 1.6 modules."""
    first, second = (round(span, 2) for span in spans_of(module, angle_deg, teeth, 0.0, 4))
    keys = {"number_of_teeth": teeth, "teeth_spanned": 4, "span": first, "next_span": second}
    high = {"tip_diameter": module * (teeth + 2 * addendum), "root_diameter": module * (teeth - 2 * dedendum)}
    page = identified(capsys, **keys, **high)
    assert page["values"]["pressure_angle_deg"] == pytest.approx(angle_deg)
    assert page["values"]["module"] == pytest.approx(module, rel=1e-4)
    for row in page["modules"]:
        own = module * teeth - row["m"] * teeth
        told = addendum * module + own / 2, dedendum * module - own / 2
        shift = row["x"] * row["m"]
        assert (row["h_a*"] * row["m"] + shift, row["h_f*"] * row["m"] - shift) == pytest.approx(told, abs=1e-6)


def test_what_is_known_decides_and_what_fits_nothing_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    first, second = spans_of(2.15, 20.0, 30, 0.0, 4)
    keys = {"number_of_teeth": 30, "teeth_spanned": 4, "span": first, "next_span": second}
    assert any("no module of a row" in note for note in identified(capsys, pressure_angle_deg=20, **keys)["notes"])
    # 2.75 mm at 20 degrees are 2.797 at 22.5, near 25.4 / 9, and 2.984 at 30; 2 mm are near nothing at any other
    several = [any("more than one fits" in note for note in identified(capsys, **keys | {"next_span": first + pitch})[
        "notes"]) for pitch in (math.pi * math.cos(math.radians(20)) * m for m in (2.0, 2.75))]  # fmt: skip
    assert several == [False, True]
    found = identified(capsys, module=2.15, **keys)["values"]
    assert found["pressure_angle_deg"] == pytest.approx(20.0, rel=1e-12)
    assert found["profile_shift_coefficient"] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"next_span": 32.0}, "identify.next_span = 32.0: must be more than the span over one tooth less, 32.83 mm"),
        ({"teeth_spanned": 24}, "at most 23 works"),
        ({"tip_diameter": 79.0}, "measure over fewer teeth"),
        ({"pin_diameter": 5.0}, "identify.pin_diameter = 5.0: needs over_pins too"),
    ],
    ids=["next", "many", "beyond", "pin"],
)
def test_readings_that_cannot_be_are_told(
    capsys: pytest.CaptureFixture[str], changed: dict[str, float], told: str
) -> None:
    keys = {"number_of_teeth": 24, "teeth_spanned": 4, "span": 32.83, "next_span": 41.68} | changed
    code = run("calc", "identify", *(f"{k}={v}" for k, v in keys.items()))
    shown = capsys.readouterr()
    assert told in shown.out + shown.err
    assert code == (0 if "tip_diameter" in changed else 2)


@pytest.mark.parametrize(
    ("keys", "told"),
    [
        ({}, "identify.teeth_spanned: is missing: give it or over_pins"),
        ({"over_pins": 50.0}, "identify.module: is missing: give it or span"),
        ({"over_pins": 50.0, "span": 32.83}, "give either over_pins or span"),
        ({"over_pins": 50.0, "between_pins": 32.83}, "give either over_pins or between_pins"),
        ({"over_pins": 45.0, "module": 2.0, "pin_diameter": 3.5}, "the pin falls between the flanks"),
        ({"over_pins": 70.0, "module": 2.0, "pin_diameter": 3.5}, "no gear has such a shift"),
    ],
    ids=["nothing", "module", "span", "both", "low", "high"],
)
def test_what_pins_cannot_tell_is_told(capsys: pytest.CaptureFixture[str], keys: dict[str, float], told: str) -> None:
    run("calc", "identify", "number_of_teeth=24", *(f"{k}={v}" for k, v in keys.items()))
    shown = capsys.readouterr()
    assert told in shown.out + shown.err


@given(
    module=st.sampled_from([1.0, 1.5, 2.0, 3.0, 4.0]), teeth=st.integers(15, 80), shift=st.floats(-0.3, 0.6),
    off=st.floats(-0.004, 0.004),
)  # fmt: skip
def test_usual_gears_are_found_though_readings_are_off(module: float, teeth: int, shift: float, off: float) -> None:
    from geometry.gears.teeth.identified import ANGLES, matches, shift_of_span

    spanned = max(2, round(teeth / 9))
    first, second = spans_of(module, 20.0, teeth, shift, spanned)
    found = matches((second - first) * (1 + off), [math.radians(a) for a in ANGLES])[0]
    assert (found.module, math.degrees(found.pressure_angle)) == pytest.approx((module, 20.0), rel=1e-12)
    assert shift_of_span(first, spanned, teeth, found, 0.0) == pytest.approx(shift, abs=1e-9)


def test_what_stands_in_a_scene_is_typed_with_points_in_every_language(capsys: pytest.CaptureFixture[str]) -> None:
    """A module of 2.5 mm, and the keys of its note copied into a scene."""
    span, next_span = spans_of(2.5, 20.0, 31, 0.2, 4)
    words = f"number_of_teeth=31 teeth_spanned=4 span={span:.2f} next_span={next_span:.2f}".split()
    assert run("calc", "identify", *words, "--language", "uk") == 0
    keys = capsys.readouterr().out.split("у сцені: ")[1].split("\n")[0]
    table = tomllib.loads(keys.replace(", ", "\n"))
    assert (table["module"], table["number_of_teeth"]) == (2.5, 31)
    assert table["profile_shift_coefficient"] == pytest.approx(0.2, abs=0.002)


@pytest.mark.parametrize("missed", [-2, -1, 1, 2])
def test_teeth_that_were_counted_wrong_are_told_of(missed: int, capsys: pytest.CaptureFixture[str]) -> None:
    """A tooth or two too many or too few: a shift of 4.7 was told as the gear's. The right number is offered."""
    span, next_span = spans_of(3.0, 20.0, 24, 0.4, 4)
    notes = identified(
        capsys, number_of_teeth=24, teeth_spanned=4 + missed, span=round(span, 2), next_span=round(next_span, 2)
    )["notes"]
    assert re.search(r"count the teeth of both spans again, teeth_spanned = 4 gives 0\.(40|39)\d*$", notes[-1])

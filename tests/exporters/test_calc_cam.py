"""``higherpair calc cam``: the cases of lessons 4 and 5 and of table 2.2, refusals, the table in every format."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from exporters.calculations.topics import calculate
from tests.exporters.test_cli import complaint

CASES = json.loads((Path(__file__).parents[1] / "published" / "cams.json").read_text(encoding="utf-8"))["cases"]
LAWS = {
    "constant acceleration": "constant_acceleration",
    "cosine acceleration": "cosine",
    "sine acceleration": "sine",
    "linearly decreasing acceleration": "linearly_decreasing",
    "3-4-5 polynomial": "polynomial_345",
}


def phases(rise: float, far: float, back: float, law: str) -> str:
    """The phases of a cam as a key of the command."""
    near = 360 - rise - far - back
    moves = [("rise", rise, law), ("dwell", far, ""), ("return_", back, law), ("dwell", near, "")]
    law_of = {"": ""} | {law: f', law = "{law}"'}
    text = ", ".join(f'{{ move = "{m}", angle_deg = {a}{law_of[w]} }}' for m, a, w in moves if a)
    return f"phases=[{text}]"


def calculated(*words: str) -> dict[str, Any]:
    return json.loads(calculate("cam", words, "json", "en"))


@pytest.mark.parametrize("case", [c for c in CASES if ".p4.r0." in c["id"]], ids=lambda c: c["id"])
def test_lesson_4(case: dict[str, Any]) -> None:
    law = LAWS[case["inputs"]["law"]]
    data = calculated("follower=flat", "lift=38", "follower_offset=2", phases(120, 30, 120, law),
                      "least_transmission_angle_deg=45", "least_curvature_radius=10")  # fmt: skip
    expected, values = case["recomputed"], data["values"]
    assert values["least_base_radius"] == pytest.approx(expected["r0_mm"], rel=1e-12)
    assert values["least_cam_radius"] == pytest.approx(expected["R_min_with_rho_10_mm"], rel=1e-12)
    assert values["peak_acceleration"] == pytest.approx(expected["S2_max_mm"], rel=1e-12)
    assert [values[k] for k in ("rise_angle_deg", "far_dwell_angle_deg", "return_angle_deg", "near_dwell_angle_deg")] \
        == pytest.approx([120, 30, 120, 90])  # fmt: skip


@pytest.mark.parametrize("case", [c for c in CASES if ".p5.r0." in c["id"]], ids=lambda c: c["id"])
@pytest.mark.parametrize(("offset", "side"), [(3, "helps"), (-3, "hinders")])
def test_lesson_5(case: dict[str, Any], offset: float, side: str) -> None:
    law = LAWS[case["inputs"]["law"]]
    data = calculated("follower=pointed", "lift=30", f"follower_offset={offset}", phases(130, 50, 130, law),
                      "least_transmission_angle_deg=60")  # fmt: skip
    expected, values = case["recomputed"], data["values"]
    assert values["least_base_radius"] == pytest.approx(expected[f"r0_offset_{side}_mm"], rel=1e-12)
    assert values["initial_height"] == pytest.approx(expected[f"s0_offset_{side}_mm"], rel=1e-12)
    assert values["transmission_angle_reached_deg"] == pytest.approx(60, abs=1e-9)


@pytest.mark.parametrize("case", [c for c in CASES if "table2_2.k" in c["id"]], ids=lambda c: c["id"])
def test_table_2_2(case: dict[str, Any]) -> None:
    data = calculated("guidelines_cam", "step=11.25")
    at = 90 * case["inputs"]["k"]
    # at 90 degrees the table holds what follows; the law is odd about its middle, its end the negative of its start
    row = next(r for r in data["positions"] if r["phi"] == pytest.approx(at if at < 90 else 0))
    expected, end = case["recomputed"], at == 90
    found = [row["S"] + 32 * end, row["S'"], row["S''"] * (-1 if end else 1)]
    assert found == pytest.approx([expected[k] for k in ("S_mm", "S1_mm", "S2_mm")], rel=1e-12, abs=1e-12)
    assert data["values"]["least_base_radius"] == pytest.approx(45.81466903731541, rel=1e-12)


def test_positions_hold_the_textbooks_contact_point() -> None:
    """Flat face: contact at S' beside the axis and R_b + S above it, turned back by the cam angle."""
    import cmath
    import math

    data = calculated("practicum_flat_cam", "step=7")
    base = data["values"]["least_cam_radius"]
    assert len(data["positions"]) == 52 + 3
    for row in data["positions"]:
        point = complex(row["S'"], base + row["S"]) * cmath.exp(-1j * math.radians(row["phi"]))
        assert complex(row["x"], row["y"]) == pytest.approx(point, abs=1e-10)
        assert row["rho"] == pytest.approx(base + row["S"] + row["S''"], abs=1e-9)


def test_both_languages_hold_the_table() -> None:
    for form in ("text", "md", "html"):
        assert "Положення" in calculate("cam", ["guidelines_cam"], form, None)
        assert "Positions" in calculate("cam", ["guidelines_cam"], form, "en")
    text = calculate("cam", ["guidelines_cam"], "text", "uk")
    assert "м'який удар при куті повороту 90°" in text
    assert "лінійно спадне прискорення" in text


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("follower=flat", "lift=3"), "phases"),
        (("practicum_flat_cam", "step=0"), "step"),
        (("practicum_flat_cam", "part=cams"), "did you mean cam"),
        (("practicum_pair",), "0 cams"),
        (("practicum_roller_cam", "follower_radius=80"), "works"),
        (("practicum_flat_cam", "lft=3"), "did you mean lift"),
    ],
)
def test_wrong_input_gets_one_clear_line(
    arguments: tuple[str, ...], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert expected in complaint(capsys, "calc", "cam", *arguments)

"""Roll angles, single contact, form diameters of splines: pages against unwound involutes and points that contact."""

from __future__ import annotations

import cmath
import json
import math
from typing import Any

import pytest

from tests.exporters.documents.test_calc import render, sheet_of, values_of

PAIRS = {
    "external": "gear-pair practicum_pair",
    "helical": "gear-pair helical_pair",
    "internal": "gear-pair thesis_internal_pair",
}


def unwound(base: float, radius: float) -> float:
    """The angle, degrees, by which a string is unwound from a base circle until its end lies on another, by halving."""
    low, high = 0.0, 20.0
    for _ in range(200):
        middle = (low + high) / 2
        end = cmath.rect(base, middle) * (1 - 1j * middle)
        low, high = (middle, high) if abs(end) < radius else (low, middle)
    return math.degrees(low)


@pytest.mark.parametrize("page", PAIRS.values(), ids=PAIRS)
def test_roll_angles_of_pairs(page: str) -> None:
    values: dict[str, Any] = values_of(page)["values"]
    for gear in ("first", "second"):
        base = values["base_radius"][gear]
        for name, diameter in (
            ("root_form", "root_form_diameter"), ("start", "start_of_active_profile_diameter"),
            ("end", "active_tip_diameter"), ("tip_form", "tip_form_diameter"),
            ("single_contact_start", "single_contact_start_diameter"),
            ("single_contact_end", "single_contact_end_diameter"),
        ):  # fmt: skip
            if diameter in values:
                found = values[f"roll_angle_at_{name}_deg"][gear]
                assert found == pytest.approx(unwound(base, values[diameter][gear] / 2), rel=1e-9), name
        working = values["working_radius"][gear] if "working_radius" in values else None
        if working is not None:
            assert values["roll_angle_at_pitch_point_deg"] == pytest.approx(unwound(base, working), rel=1e-9)


@pytest.mark.parametrize("page", PAIRS.values(), ids=PAIRS)
def test_one_pair_is_in_contact_between_b_and_d(page: str) -> None:
    """Contacts stand a base pitch apart on the line of action; counted from its ends, in the plane of both axes."""
    values: dict[str, Any] = values_of(page)["values"]
    one = values["base_radius"]["first"]
    internal = values["reference_radius"]["second"] > values["working_centre_distance"]
    alpha = math.radians(values["working_pressure_angle_deg"])
    pitch = 2 * math.pi * one / values["number_of_teeth"]["first"]
    axis = values["working_centre_distance"] * (-1 if internal else 1)
    foot, along = cmath.rect(one, -alpha), 1j * cmath.exp(-1j * alpha)

    def place(diameter: float) -> float:
        return math.sqrt((diameter / 2) ** 2 - one**2)

    begin, end = (place(values[f"{n}_diameter"]["first"]) for n in ("start_of_active_profile", "active_tip"))

    def count(at: float) -> int:
        return sum(begin < at + k * pitch < end for k in range(-3, 4))

    inner, outer = (place(values[f"single_contact_{n}_diameter"]["first"]) for n in ("start", "end"))
    assert [count(at) for at in (inner - 1e-6, inner + 1e-6, outer - 1e-6, outer + 1e-6)] == [2, 1, 1, 2]
    for name, at in (("start", inner), ("end", outer)):
        apart = abs(foot + at * along - axis)
        assert values[f"single_contact_{name}_diameter"]["second"] == pytest.approx(2 * apart, rel=1e-9)


def test_roll_angles_on_a_rack() -> None:
    """Contact begins at the rack's tip line and ends at the pinion's tips."""
    values: dict[str, Any] = values_of("gear-pair rack_and_pinion")["values"]
    base, pitch_radius, alpha = values["base_radius"]["first"], values["reference_radius"]["first"], math.radians(20)

    def of(name: str) -> float:
        return float(values[f"{name}_diameter"]["first"]) / 2

    along = (values["rack_distance"] - 2 - pitch_radius) / math.sin(alpha)
    start = abs(pitch_radius + along * cmath.rect(1, math.pi / 2 - alpha))
    assert of("start_of_active_profile") == pytest.approx(start, abs=1e-4)
    assert of("active_tip") == of("tip_form") == pytest.approx(values["tip_radius"]["first"], rel=1e-12)
    base_pitch = 2 * math.pi * base / 18
    lengths = {n: math.sqrt(of(n) ** 2 - base**2) for n in ("start_of_active_profile", "active_tip")}
    inner, outer = lengths["active_tip"] - base_pitch, lengths["start_of_active_profile"] + base_pitch
    assert of("single_contact_start") == pytest.approx(abs(base + 1j * inner), rel=1e-9)
    assert of("single_contact_end") == pytest.approx(abs(base + 1j * outer), rel=1e-9)
    for name, radius in (
        ("root_form", of("root_form")), ("start", of("start_of_active_profile")), ("end", of("active_tip")),
        ("tip_form", of("tip_form")), ("single_contact_start", of("single_contact_start")),
        ("single_contact_end", of("single_contact_end")),
    ):  # fmt: skip
        found = values[f"roll_angle_at_{name}_deg"]["first"]
        assert found == pytest.approx(unwound(base, radius), rel=1e-9), name
    assert values["roll_angle_at_pitch_point_deg"] == pytest.approx(unwound(base, pitch_radius), rel=1e-9)


def test_no_contact_is_single_where_two_pairs_always_share() -> None:
    """A contact ratio above 2."""
    keys = "module=2 first.number_of_teeth=60 second.number_of_teeth=80 pressure_angle_deg=14.5"
    values = values_of(f"gear-pair {keys}")["values"]
    assert values["contact_ratio"] > 2
    assert "single_contact_start_diameter" not in values
    assert "roll_angle_at_start_deg" in values


@pytest.mark.parametrize(
    "page", ["spur module=2 number_of_teeth=17", "spur module=2 number_of_teeth=31 helix_angle_deg=20 tip_chamfer=0.2",
             "ring module=2 number_of_teeth=60"],
)  # fmt: skip
def test_roll_of_one_gear(page: str) -> None:
    values = values_of(page)["values"]
    base = values["base_diameter"] / 2
    for name, diameter in (("root_form", "root_form_diameter"), ("tip_form", "tip_form_diameter"),
                           ("reference", "reference_diameter")):  # fmt: skip
        angle = unwound(base, values[diameter] / 2)
        assert values[f"roll_angle_at_{name}_deg"] == pytest.approx(angle, rel=1e-5 if angle < 1 else 1e-9)
        if name != "reference":
            assert values[f"roll_length_at_{name}"] == pytest.approx(base * math.radians(angle), rel=1e-5)
    assert (values["tip_form_diameter"] != values["tip_diameter"]) == ("chamfer" in page)


def test_form_diameters_of_iso_4156() -> None:
    """D_Fi = m (z + 1) + 2 c_F, as Inventor's help has it; D_Fe by h_s = 0.6 m; rho = 0.2 m."""
    page = sheet_of("involute-spline", ["size=25z x 1m x 30P", "standard=ISO 4156"])[0]
    values: dict[str, Any] = json.loads(render(page, "json", "en"))["values"]
    assert values["hub_form_diameter"] == pytest.approx(26.2, rel=1e-12)
    shaft = 2 * math.hypot(12.5 * math.cos(math.pi / 6), 12.5 * math.sin(math.pi / 6) - 0.6 / math.sin(math.pi / 6))
    assert values["shaft_form_diameter"] == pytest.approx(shaft, rel=1e-12)
    assert (values["shaft_rounding"], values["hub_rounding"]) == (0.2, 0.2)
    assert values["shaft_root_diameter"] < values["shaft_side_diameter"] < shaft
    assert values["hub_form_diameter"] < values["hub_side_diameter"] < values["hub_root_diameter"]

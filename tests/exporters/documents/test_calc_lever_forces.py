"""The forces of ``calc lever``: plans that close, the closed form of a piston, the flywheel's mean, wrong keys."""

from __future__ import annotations

import cmath
import math
import re
import xml.etree.ElementTree as ET
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.documents.topics import calculate
from parts.base.refusal import SceneError
from tests.exporters.documents.test_calc import evaluated, sheet_for
from tests.exporters.documents.test_calc_lever import calculated, value

ENGINE = ("first=slider", "crank_length=70", "coupler_length=210", "speed=150", "start_angle_deg=40")
SIX = ("masses.1=5", "masses.2=3", "masses.3=20", "inertias.3=1.5", "centre_offsets.3=20", "masses.4=6",
       "inertias.4=0.2", "masses.5=40", "point_masses.A=1")  # fmt: skip
SLOW = ("first=slider", "crank_length=70", "coupler_length=210", "speed=5", "start_angle_deg=40", "resistance=300",
        "unevenness=0.05", "masses.3=40")  # fmt: skip
THREE = ("masses.1=5", "centres.1=10", "masses.2=3", "inertias.2=0.02", "masses.3=4", "resistance=1000")


def keys_of(assignment: int) -> tuple[str, ...]:
    """Loads for an assignment, of every kind that it takes."""
    if assignment in (8, 9):
        return THREE
    return (*SIX, "resisting_moment=100") if assignment == 10 else (*SIX, "resistance=1000")


def rows(data: dict[str, Any], table: str) -> list[list[Any]]:
    return [list(row.values()) for row in data[table]]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("assignment", range(1, 11))
def test_every_assignment_holds_its_loads_all_round(assignment: int) -> None:
    """12 positions of a row of it: finite, in balance by powers, plans closed, both methods of one moment."""
    for variant in (1, 6, 10):
        keys = (f"assignment={assignment}", f"variant={variant}", *keys_of(assignment))
        data = calculated(*keys)
        told = np.array(rows(data, "forces"), dtype=float)
        assert told.shape == (12, 2 + (4 if assignment in (8, 9) else 7))
        assert np.isfinite(told).all()
        # what the table tells first is what the steps tell
        assert told[0][1] == pytest.approx(value(data, "M_b"), rel=1e-12)
        powers = np.array([row[-1] for row in rows(data, "powers")])
        assert abs(powers.sum()) < 1e-12 * np.abs(powers).sum()
        assert value(data, "ΔM") < 1e-10
        for plan in [name for name in data if name.startswith("force_plan")]:
            vectors = {row[0]: cmath.rect(row[1], math.radians(row[2])) for row in rows(data, plan)}
            room = 1e-12 * sum(map(abs, vectors.values()))
            # across the polygon: what the first link of a group passes on to the second
            inner, link = f"R_{plan[-2:]}", plan[-2]
            if passed := vectors.pop(inner, None):
                own = [
                    v
                    for name, v in vectors.items()
                    if name in {f"G_{link}", f"F_i{link}"} or name[:4] == f"R_{chr(ord(link) - 1)}{link}"
                ]
                assert abs(sum(own) - passed) < room, plan
                assert abs(passed) == pytest.approx(value(data, inner), rel=1e-12)
            assert (passed is None) == (plan == "force_plan_1")
            assert abs(sum(vectors.values())) < room, plan
        greatest = {row[0]: row[1] for row in rows(data, "greatest_forces")}
        first = data["forces"]
        assert all(greatest[name] >= row[name] * (1 - 1e-12) for row in first for name in greatest)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("assignment", [1, 3, 4, 8, 10])
def test_the_mean_balancing_moment_is_the_flywheels_driving_moment(assignment: int) -> None:
    """Over a turn weights and inertia do no work: what is left is the resistance, whose work Mertsalov adds up."""
    data = calculated(f"assignment={assignment}", *keys_of(assignment), "unevenness=0.05")
    span = value(data, "M_b,max") - value(data, "M_b,min")
    assert value(data, "M_b,m") == pytest.approx(value(data, "M_d"), abs=1e-12 * span)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("angle", [40, 130, 260, 345])
def test_a_piston_by_the_textbook(angle: int) -> None:
    """Rod F / cos(beta), thrust F tan(beta), moment F r sin(phi + beta) / cos(beta); against the motion."""
    keys = (*ENGINE[:4], f"start_angle_deg={angle}", "resistance=5000")
    data = calculated(*keys)
    phi = math.radians(angle)
    beta = math.asin(70 * math.sin(phi) / 210)
    assert value(data, "R_12") == pytest.approx(5000 / math.cos(beta), rel=1e-12)
    assert value(data, "R_03") == pytest.approx(5000 * abs(math.tan(beta)), rel=1e-12)
    moment = 5000 * 0.07 * abs(math.sin(phi + beta)) / math.cos(beta)
    assert value(data, "M_b") == pytest.approx(moment, rel=1e-12)
    for row in data["forces"]:
        phi = math.radians(row["φ_1"])
        beta = math.asin(70 * math.sin(phi) / 210)
        assert row["M_b"] == pytest.approx(350 * abs(math.sin(phi + beta)) / math.cos(beta), rel=1e-11)
    # only on one of its ways: the crank drives then, and runs free on the other
    one = calculated(*keys, "resisted=forward")
    for row, both in zip(one["forces"], data["forces"], strict=True):
        assert row["M_b"] == pytest.approx(both["M_b"] if math.sin(math.radians(row["φ_1"])) < 0 else 0, abs=1e-12)


def test_a_guide_holds_what_turns_its_slider() -> None:
    """A mass 30 mm ahead of the pin in a flat guide: its weight and the thrust together pass x from the pin."""
    data = calculated(*ENGINE[:3], "start_angle_deg=90", "masses.3=2", "centres.3=30", "resistance=700", "speed=1e-3")
    weight = 2 * 9.81
    thrust = -700 * math.tan(math.asin(70 / 210))
    # at 90 degrees the piston goes to the shaft: the rod draws it there, and up
    vectors = {row[0]: cmath.rect(row[1], math.radians(row[2])) for row in rows(data, "force_plan_23")}
    assert vectors["R_03"] == pytest.approx(1j * (weight + thrust), rel=1e-6)
    assert value(data, "M_03") == pytest.approx(30e-3 * weight, rel=1e-6)
    assert value(data, "x_03") == pytest.approx(30 * weight / (weight + thrust), rel=1e-6)


def test_the_weight_of_a_rod_turns_it_about_its_far_joint() -> None:
    """Of a slow rod whose far joint is on the right: m g (l/2) cos(beta), counter-clockwise, is what A carries."""
    data = calculated(*ENGINE[:3], "start_angle_deg=90", "masses.2=2", "speed=1e-6")
    moment = 2 * 9.81 * 0.105 * math.sqrt(8 / 9)
    assert value(data, "M_B") == pytest.approx(moment, rel=1e-9)
    assert value(data, "R_12t") == pytest.approx(moment / 0.21, rel=1e-9)


def test_a_wheel_presses_the_shaft_of_the_crank() -> None:
    """F = M / (r cos(alpha)); with the pinion below, its pull along the circle and its push away from it."""
    plain = calculated(*ENGINE, "resistance=5000")
    data = calculated(*ENGINE, "resistance=5000", "drive_radius=100", "drive_pressure_angle_deg=25")
    moment = value(data, "M_b")
    assert moment == value(plain, "M_b") > 0
    assert value(data, "F_b") == pytest.approx(moment / (0.1 * math.cos(math.radians(25))), rel=1e-12)
    # as a power it is a force alone, where a coupling is a moment alone
    assert rows(data, "powers")[-1] == ["F_b", value(data, "F_b"), 0, pytest.approx(moment * 150)]
    assert rows(plain, "powers")[-1] == ["M_b", 0, moment, pytest.approx(moment * 150)]
    assert "g" not in {step["symbol"] for step in data["steps"]}
    vectors = {row[0]: cmath.rect(row[1], math.radians(row[2])) for row in rows(data, "force_plan_1")}
    along = moment / 0.1
    assert vectors["F_b"] == pytest.approx(along + 1j * along * math.tan(math.radians(25)), rel=1e-12)
    assert vectors["R_01"] == pytest.approx(-vectors["R_21"] - vectors["F_b"], rel=1e-12)


def test_substitute_masses_of_a_rod_balance_as_the_rod_does() -> None:
    """m l^2 / 12 about its middle is a sixth at each end and two thirds between, for frame, moment and flywheel."""
    mass, length = 6.0, 0.21
    rod = (*ENGINE, "resistance=2000", "unevenness=0.05")
    whole = calculated(*rod, f"masses.2={mass}", f"inertias.2={mass * length**2 / 12!r}")
    parts = calculated(
        *rod, f"masses.2={2 * mass / 3!r}", f"point_masses.A={mass / 6!r}", f"point_masses.B={mass / 6!r}"
    )
    for one, other in zip(whole["forces"], parts["forces"], strict=True):
        for name in ("M_b", "R_01", "R_03"):
            assert one[name] == pytest.approx(other[name], rel=1e-9, abs=1e-6), name
    for one, other in zip(whole["cycle"], parts["cycle"], strict=True):
        assert one["J"] == pytest.approx(other["J"], rel=1e-12)
    assert value(whole, "J_m") == pytest.approx(value(parts, "J_m"), rel=1e-9)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("assignment", [1, 6, 8, 10])
def test_masses_at_points_move_as_the_points_do(assignment: int) -> None:
    """Their forces of inertia are mass by acceleration of the plan."""
    points = "AB" if assignment == 8 else "ABCD"
    data = calculated(f"assignment={assignment}", "variant=2", *(f"point_masses.{p}=3" for p in points))
    plan = {row[0]: row[1] for row in rows(data, "acceleration_plan")}
    for point in points:
        assert value(data, f"F_i{point}") == pytest.approx(3 * plan[f"π{point.lower()}"], rel=1e-12), point


def test_centres_of_mass_stand_where_keys_say() -> None:
    """Beside the crank at 90 degrees: on -x, where a weight turns it counter-clockwise; on the rod at AS2 / AB."""
    data = calculated(*ENGINE[:4], "start_angle_deg=90", "masses.1=2", "centre_offsets.1=50")
    assert value(data, "M_b") == pytest.approx(-0.05 * 2 * 9.81, rel=1e-12)
    data = calculated("assignment=8", "variant=4", "masses.2=2")
    assert value(data, "x_S2") == pytest.approx(0.34 * 2.8 * 120, rel=1e-12)
    # where none is given: O1, the stone's pin, halfway along levers and rods, a slider's pin
    data = calculated("code=1071", *(f"masses.{link}=1" for link in range(1, 6)))
    assert [value(data, f"x_S{link}") for link in range(1, 6)] == [0, 0, 540, 378, 0]


def test_a_moment_on_a_rocker_works_through_its_swing() -> None:
    """Against it both ways, so over a turn M times twice the swing; one way half of that."""
    keys = ("assignment=10", "resisting_moment=100", "positions=720")
    data = calculated(*keys)
    swing = np.radians(np.ptp(np.unwrap([row["φ_5"] for row in data["positions"]], period=360)))
    assert value(data, "M_b,m") * 2 * math.pi == pytest.approx(200 * swing, rel=2e-3)
    # that is also the work for which a flywheel is sized
    wheel = calculated(*keys, "unevenness=0.05")
    assert value(wheel, "A_c") == pytest.approx(200 * swing, rel=1e-4)
    assert wheel["cycle"][-1]["A_c"] == pytest.approx(value(wheel, "A_c"), rel=1e-12)
    one = calculated(*keys, "resisted=forward")
    assert value(one, "M_b,m") * 2 * math.pi == pytest.approx(100 * swing, rel=2e-3)
    for row, at in zip(one["forces"], data["positions"], strict=True):
        assert (abs(row["M_b"]) > 1e-9) == (at["ω_5"] > 1e-9)


def test_a_flywheel_of_a_lever_that_goes_all_the_way_round() -> None:
    """A drag link: its lever turns with the crank, so a moment against it works through 2 pi."""
    drag = ("first=rods", "crank_length=100", "frame_length=40", "coupler_length=110", "lever_length=90", "speed=5",
            "resisting_moment=10", "unevenness=0.05")  # fmt: skip
    data = calculated(*drag)
    assert value(data, "A_c") == pytest.approx(20 * math.pi, rel=1e-9)
    assert value(data, "M_d") == pytest.approx(10, rel=1e-9)
    # what the lever has taken of it: 10 times the angle that it has turned through
    turned = np.degrees(np.unwrap(np.radians([row["φ_3"] for row in data["positions"]])))
    gained = [10 * math.radians((row["φ_1"] - turn) - (data["cycle"][0]["φ_1"] - turned[0])) for row, turn in
              zip(data["cycle"], turned, strict=False)]  # fmt: skip
    assert [row["ΔT"] for row in data["cycle"][:-1]] == pytest.approx(gained, abs=1e-9)
    assert refused(*drag, "resisted=backward") == ("resisting_moment", "no_work_over_cycle")


def test_the_greatest_reactions_are_those_of_their_positions() -> None:
    # of an engine they are where its piston turns back, which comes after a whole turn's 360 degrees
    for keys in (("assignment=6", *keys_of(6)), (*ENGINE, "masses.3=4")):
        for row in calculated(*keys)["greatest_forces"]:
            name, most, angle = row.values()
            assert 0 <= angle < 360
            alone = [key for key in keys if not key.startswith("start")]
            at = calculated(*alone, f"start_angle_deg={angle!r}")["forces"][0]
            assert at[name] == pytest.approx(most, rel=1e-9), name


def test_the_flywheel_takes_masses_without_the_forces_of_weight() -> None:
    heavy = calculated(*ENGINE, "resistance=2000", "unevenness=0.05", "masses.3=5")
    flat = calculated(*ENGINE, "resistance=2000", "unevenness=0.05", "masses.3=5", "gravity=0")
    assert value(heavy, "J_m") == value(flat, "J_m")
    assert any("left out of the flywheel" in note for note in heavy["notes"])
    assert "J_m,G" not in {step["symbol"] for step in flat["steps"]}
    assert "g" in {step["symbol"] for step in heavy["steps"]}
    assert "g" not in {step["symbol"] for step in flat["steps"]}
    light = calculated(*ENGINE, "resistance=2000", "unevenness=0.05")
    assert not any("left out of the flywheel" in note for note in light["notes"])
    assert not any("left out of the flywheel" in note for note in flat["notes"])


def test_the_flywheel_with_the_work_of_the_weights() -> None:
    # an upright piston, by its closed form: the crank turns evenly, so the work of its weight goes to the flywheel
    told = calculated(*SLOW, "gravity_angle_deg=180")
    angle = math.radians(40) + np.linspace(0, 2 * math.pi, 100001)
    sine, root = np.sin(angle), np.sqrt(0.21**2 - (0.07 * np.sin(angle)) ** 2)
    place = 0.07 * np.cos(angle) + root
    speed = 5 * -0.07 * (sine + 0.07 * sine * np.cos(angle) / root)
    resisted = 300 * np.append(0.0, np.cumsum(np.abs(np.diff(place))))
    rest = resisted[-1] * (angle - angle[0]) / (2 * math.pi) - resisted - 40 * speed**2 / 2
    assert value(told, "ΔT_m") == pytest.approx(float(np.ptp(rest)), rel=1e-5)
    with_weight = float(np.ptp(rest - 40 * 9.81 * place))
    assert value(told, "ΔT_m,G") == pytest.approx(with_weight, rel=1e-5)
    assert value(told, "J_m,G") == pytest.approx(with_weight / (5**2 * 0.05), rel=1e-5)
    assert with_weight > 1.5 * value(told, "ΔT_m")
    # across the guide the weight of a piston does nothing
    level = calculated(*SLOW)
    assert value(level, "J_m,G") == pytest.approx(value(level, "J_m"), rel=1e-12)


def test_the_greatest_of_a_turn_is_not_that_of_the_positions_told() -> None:
    """A heavy piston beside the shaft, resisted both ways: by its closed form at two million places, jumps and all.

    Of 3600 positions alone a reaction at its jump was 2e-6 of it less, the flywheel's energy and the moment 1e-6.
    """
    crank, rod, beside, speed, mass, force = 0.07, 0.1, 0.012, 50.0, 4.0, 300.0
    data = calculated("first=slider", "crank_length=70", "coupler_length=100", "guide_height=12", "speed=50",
                      "start_angle_deg=40", "masses.3=4", "gravity=0", "resistance=300", "unevenness=0.05")  # fmt: skip
    angle = math.radians(40) + np.linspace(0, 2 * math.pi, 2_000_001)
    lean = (beside - crank * np.sin(angle)) / rod
    leaning = -crank * np.cos(angle) / rod
    cosine = np.sqrt(1 - lean**2)
    place = crank * np.cos(angle) + rod * cosine
    rate = -crank * np.sin(angle) - rod * lean * leaning / cosine
    bend = (-crank * np.cos(angle) - rod * (leaning**2 + lean * (beside / rod - lean)) / cosine
            - rod * (lean * leaning) ** 2 / cosine**3)  # fmt: skip
    velocity, acceleration = speed * rate, speed**2 * bend
    load = mass * acceleration + force * np.sign(rate)
    resisted = force * np.append(0.0, np.cumsum(np.abs(np.diff(place))))
    moment = load * rate
    told = data["values"]
    assert told["greatest_output_velocity"] == pytest.approx(np.abs(velocity).max(), rel=1e-10)
    assert told["greatest_output_acceleration"] == pytest.approx(np.abs(acceleration).max(), rel=1e-10)
    greatest = {row["force"]: row["value"] for row in data["greatest_forces"]}
    # beside a jump the nearest place is up to 3e-6 rad off
    assert greatest["R_12"] == pytest.approx(np.abs(load / cosine).max(), rel=1e-7)
    assert greatest["R_03"] == pytest.approx(np.abs(load * lean / cosine).max(), rel=1e-7)
    assert told["greatest_balancing_moment"] == pytest.approx(moment.max(), rel=1e-9)
    assert told["least_balancing_moment"] == pytest.approx(moment.min(), rel=1e-9)
    assert told["mean_balancing_moment"] == pytest.approx(resisted[-1] / (2 * math.pi), rel=1e-10)
    assert told["greatest_reduced_inertia"] == pytest.approx(mass * (rate**2).max(), rel=1e-10)
    rest = resisted[-1] * (angle - angle[0]) / (2 * math.pi) - resisted - mass * velocity**2 / 2
    assert told["flywheel_energy"] == pytest.approx(np.ptp(rest), rel=1e-10)


def test_a_drive_that_turns_round_lifts_least_there() -> None:
    """Where the balancing moment passes through 0 a wheel's push changes its flank: the shaft's force has a corner.

    A mass at A asks no moment but by its weight, none where it hangs below the shaft and is heaviest.
    """
    data = calculated("first=slider", "crank_length=70", "coupler_length=210", "speed=20", "start_angle_deg=40.03",
                      "point_masses.A=3", "drive_radius=200", "drive_pressure_angle_deg=30")  # fmt: skip
    greatest = {row["force"]: row["value"] for row in data["greatest_forces"]}
    assert greatest["R_01"] == pytest.approx(3 * (9.81 + 0.07 * 400), rel=1e-9)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("factor", [1e-9, 1.0, 1e6])
def test_masses_of_any_size(factor: float) -> None:
    data = calculated("assignment=6", "gravity=9.81", f"masses.2={3 * factor!r}", f"masses.5={factor!r}")
    one = calculated("assignment=6", "masses.2=3", "masses.5=1")
    for row, other in zip(data["forces"], one["forces"], strict=True):
        for name in row:
            scale = 1.0 if name == "φ_1" else factor
            assert row[name] == pytest.approx(other[name] * scale, rel=1e-9)


def test_small_forces_keep_their_digits_in_tables() -> None:
    """A rod of 10 mg: its weight is 98.1 uN, all is a millionth of that of 10 kg, to 7 decimals."""
    small, large = (
        calculate("lever", [*ENGINE[:3], "speed=20", f"masses.2={m}"], "text", "en") for m in ("1e-5", "10")
    )
    seen = []
    for text in (small, large):
        table = text.partition("Plan of forces of links 2 and 3")[2].partition("Plan")[0].splitlines()
        seen.append({line.split()[0]: float(line.split()[1]) for line in table[3:] if line})
    assert seen[0]["G_2"] == pytest.approx(9.81e-5, rel=1e-12)
    for name, force in seen[1].items():
        assert seen[0][name] == pytest.approx(force * 1e-6, abs=0.501e-7), name


def test_no_masses_no_forces() -> None:
    for keys in (("masses.2=0",), ("point_masses.D=0", "drive_radius=50"), ("masses.3=1e9", "masses.4=1e-9")):
        data = calculated("assignment=1", *keys)
        told = np.array(rows(data, "forces"), dtype=float)
        assert np.isfinite(told).all()
        assert told[:, 1:].any() == ("masses.3=1e9" in keys)
    # what is nothing has no direction
    for angle in (0, 40, 130, 220):
        data = calculated(*ENGINE[:4], f"start_angle_deg={angle}", "masses.2=0")
        assert [row[1:] for name in ("force_plan_23", "force_plan_1") for row in rows(data, name)] == [[0, 0, 0]] * 6


@pytest.mark.heavy
def test_forces_across_their_velocities_balance_by_themselves() -> None:
    """A mass on an even crank asks no moment, whatever rounding leaves: the check is measured by what forces could."""
    for assignment in range(1, 11):
        data = calculated(f"assignment={assignment}", "variant=3", "point_masses.A=1e6", "gravity=0")
        assert value(data, "ΔM") < 1e-10
        assert abs(value(data, "M_b")) < 1e-12 * value(data, "ΣM")


def test_couples_too_are_what_the_check_is_measured_by() -> None:
    """A rod with an inertia and no mass: J |epsilon_2 omega_2| / omega_1 is all that there is."""
    data = calculated(*ENGINE, "inertias.2=0.4")
    # nothing is told of a mass that it has not
    assert not {"m_2", "G_2", "g", "F_i2", "x_S2"} & {step["symbol"] for step in data["steps"]}
    wanted = 0.4 * value(data, "ε_2") * value(data, "ω_2") / value(data, "ω_1")
    assert value(data, "ΣM") == pytest.approx(wanted, rel=1e-12)
    assert abs(value(data, "M_b")) == pytest.approx(wanted, rel=1e-9)


def test_a_crank_that_speeds_up() -> None:
    """a_A = r sqrt(omega^4 + epsilon^2), and an inertia on it asks J epsilon more of the shaft."""
    data = calculated(*ENGINE, "acceleration=30000", "masses.1=2", "inertias.1=0.01", "gravity=0")
    assert value(data, "a_A") == pytest.approx(0.07 * math.hypot(150**2, 30000), rel=1e-12)
    assert value(data, "M_b") == pytest.approx(0.01 * 30000, rel=1e-12)
    assert value(data, "R_01") == 0
    vectors = {row[0]: cmath.rect(row[1], math.radians(row[2])) for row in rows(data, "acceleration_plan")}
    assert vectors["πn1"] + vectors["n1a"] == pytest.approx(vectors["πa"], rel=1e-12)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "words",
    [f"lever assignment=1 {' '.join(keys_of(1))}", f"lever assignment=10 variant=3 {' '.join(keys_of(10))}",
     f"lever assignment=4 {' '.join(keys_of(4))} drive_radius=80 acceleration=20",
     f"lever assignment=8 {' '.join(THREE)}",
     f"lever {' '.join(ENGINE)} resistance=100 masses.3=2 centre_offsets.3=8 gravity_angle_deg=0"],
)  # fmt: skip
def test_every_printed_formula_gives_its_value(words: str) -> None:
    checked = [step for step in sheet_for(words).steps() if step.formula]
    assert len(checked) >= 15
    for step in checked:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-9, abs=1e-9), (step.symbol, step.formula)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    "keys", [("assignment=4", "velocity_scale=0.1"), ("assignment=8",), ("assignment=10",)], ids=str
)
def test_every_vector_of_a_plan_has_room_on_paper(keys: tuple[str, ...]) -> None:
    """At scales of the page's own none is longer than 120 mm, and some are longer than 40."""
    for variant in range(1, 11):
        data = calculated(*keys, f"variant={variant}", "masses.2=1", "masses.3=4")
        for plan in ("velocity_plan", "acceleration_plan", "force_plan_23", "force_plan_1"):
            if plan.split("_")[0] not in str(keys):
                assert 40 < max(row[-1] for row in rows(data, plan)) <= 120 * (1 + 1e-12), (variant, plan)


def test_plans_stand_in_the_order_of_the_work() -> None:
    """Positions, velocities, accelerations, and then forces, from the last group to the crank."""
    order = ["lengths", "positions", "velocity_plan", "acceleration_plan", "force_plan_45", "force_plan_23",
             "force_plan_1", "powers", "forces", "greatest_forces"]  # fmt: skip
    assert [name for name in calculated("assignment=1", *keys_of(1)) if name in order] == order


def test_where_the_output_stands_its_resistance_is_told_in_a_line() -> None:
    data = calculated(*ENGINE[:4], "resistance=5000", "positions=4")
    assert [row["R_12"] for row in data["forces"]] == pytest.approx([0, 5000 / math.sqrt(8 / 9)] * 2)
    assert [note for note in data["notes"] if "φ_1 = 0°, 180°" in note]
    assert not [note for note in calculated(*ENGINE, "resistance=5000")["notes"] if "stands at" in note]


def test_dead_positions_are_told_in_a_line() -> None:
    """A rod that is hardly longer than the crank stands across its guide at 90 and 270 degrees."""
    keys = ("first=slider", "crank_length=70", "coupler_length=70.000002", "speed=1", "masses.3=1", "positions=4")
    data = calculated(*keys)
    assert [row["φ_1"] for row in data["forces"]] == [0, 180]
    assert [note for note in data["notes"] if "dead positions, φ_1 = 90°, 270°" in note]
    # nor do they count among the greatest of the turn
    assert all(abs(row["φ_1"] % 180 - 90) > 0.05 for row in data["greatest_forces"])
    beside = [value(calculated(*keys, f"start_angle_deg={a}"), "M_b") for a in (89.9, 90.1, 269.9, 270.1)]
    assert value(data, "M_b,max") == pytest.approx(max(beside), rel=1e-6)
    assert value(data, "M_b,min") == pytest.approx(min(beside), rel=1e-6)
    # a sine of 0.05 is enough
    near = calculated(*keys[:2], f"coupler_length={70 / math.sqrt(1 - 0.05**2)!r}", *keys[3:])
    assert [row["φ_1"] for row in near["forces"]] == [0, 90, 180, 270]
    # there no plan of forces is drawn, nor is anything else about them
    at_once = calculated(*keys, "start_angle_deg=90")
    assert not [name for name in at_once if name.startswith("force_plan")]
    assert not [step for step in at_once["steps"] if step["symbol"].startswith("R_")]


def test_the_picture_has_the_plans_of_forces(tmp_path: Path) -> None:
    file = tmp_path / "lever.svg"
    text = calculate("lever", ["assignment=1", *keys_of(1), f"picture={file}"], "text", "uk")
    assert "План сил ланок 4 і 5" in text
    # titles within titles too are in the language: no word of another one is left
    assert "План сил ведучої ланки, " in text
    assert not re.findall("[A-Za-z]{4,}", text)
    told = [e for e in ET.parse(file).iter() if e.tag.endswith("}text")]
    words = {"".join(e.itertext()) for e in told}
    assert {"План сил ланок 4 і 5", "План сил ланок 2 і 3", "План сил ведучої ланки"} <= words
    assert {"R05", "Fc", "R43", "R21"} <= words
    # before: R_05, as it is typed
    for name in (e for e in told if "".join(e.itertext()) in ("R05", "Fc")):
        (index,) = name
        assert (name.text, index.text) in (("R", "05"), ("F", "c"))
        assert float(index.get("dy", 0.0)) > 0


@cache
def refused(*keys: str) -> tuple[str, str]:
    with pytest.raises(SceneError) as found:
        calculate("lever", keys, "text", "en")
    return found.value.key.partition("lever.")[2] or found.value.key, found.value.code


@pytest.mark.parametrize(
    ("keys", "key", "code"),
    [
        (("assignment=8", "masses.4=1"), "masses.4", "no_such_link"),
        (("assignment=8", "inertias.3=1"), "inertias.3", "does_not_turn"),
        (("assignment=1", "masses.2=1", "centres.3=5"), "centres.3", "needs_other"),
        (("assignment=1", "masses.2=1", "centre_offsets.6=5"), "centre_offsets.6", "no_such_link"),
        (("assignment=8", "masses.2=1", "centres.2=5"), "centres.2", "other_is_given"),
        (("assignment=1", "centres.3=5"), "centres", "of_no_link"),
        (("assignment=1", "force_scale=5"), "force_scale", "of_no_link"),
        (("assignment=1", "drive_radius=5"), "drive_radius", "of_no_link"),
        (("assignment=1", "masses.2=1", "drive_angle_deg=5"), "drive_angle_deg", "needs_other"),
        (("assignment=1", "resisting_moment=5"), "resisting_moment", "needs_rocker"),
        (("assignment=10", "resistance=5"), "resistance", "needs_slider"),
        (("assignment=1", "masses.2=1", "resisted=both"), "resisted", "of_no_link"),
        (("assignment=1", "resistance=1", "gravity=9.8"), "gravity", "of_no_link"),
        (("assignment=1", "inertias.3=1", "gravity_angle_deg=9"), "gravity_angle_deg", "of_no_link"),
        (("assignment=1", "masses.2=1", "gravity=0", "gravity_angle_deg=9"), "gravity_angle_deg", "of_no_link"),
        (("assignment=1", "masses={}", "force_scale=9"), "force_scale", "of_no_link"),
        (("assignment=8", "point_masses.C=9"), "point_masses.C", "no_such_point"),
        (("assignment=1", "resistance=1", "unevenness=0.1", "acceleration=1"), "acceleration", "other_is_given"),
        (("assignment=10", "masses.2=5", "unevenness=0.1"), "unevenness", "needs_other"),
    ],
)  # fmt: skip
def test_wrong_loads_are_refused_by_their_keys(keys: tuple[str, ...], key: str, code: str) -> None:
    assert refused(*keys) == (key, code)

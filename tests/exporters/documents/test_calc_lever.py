"""``calc lever``: the guidelines' worked example and assignments, plans that close, wrong input by its key."""

from __future__ import annotations

import cmath
import json
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

ROWS = json.loads((Path(__file__).parents[2] / "published" / "levers.json").read_text(encoding="utf-8"))["cases"]
CASES = {case["id"].removeprefix("003."): case for case in ROWS}
FULL = CASES["ex.full"]["recomputed"]


@cache
def calculated(*keys: str) -> dict[str, Any]:
    return json.loads(calculate("lever", keys, "json", "en"))


def value(data: dict[str, Any], symbol: str) -> float:
    return next(s["value"] for s in data["steps"] if s["symbol"] == symbol)


SYMBOLS = {
    "V_A_m_s": "V_A", "V_A3_m_s": "V_A3", "V_A3A2_m_s": "V_A3A2", "omega3_rad_s": "ω_3", "V_B_m_s": "V_B",
    "V_C_m_s": "V_C", "a_A_m_s2": "a_A", "a_Coriolis_m_s2": "a_A3A2_k", "a_n_A3_m_s2": "a_3n", "a_t_A3_m_s2": "a_3t",
    "eps3_rad_s2": "ε_3", "a_B_m_s2": "a_B", "a_C_m_s2": "a_C", "omega4_rad_s": "ω_4", "V_D_m_s": "V_D",
    "V_DC_m_s": "V_DC", "eps4_rad_s2": "ε_4", "a_t_DC_m_s2": "a_4t", "a_n_DC_m_s2": "a_4n",
    "psi_deg": "φ_3", "delta_CD_deg": "φ_4",
}  # fmt: skip


def test_the_worked_example_is_recomputed() -> None:
    data = calculated("code=1071")
    for name, symbol in SYMBOLS.items():
        assert value(data, symbol) == pytest.approx(FULL[name], rel=1e-10), symbol
    assert value(data, "l_AO3") == pytest.approx(1000 * FULL["O3A_m"], rel=1e-12)
    assert value(data, "a_D") == pytest.approx(abs(FULL["a_D_m_s2"]), abs=1e-9)
    given = CASES["ex.lengths"]["recomputed"]
    for name, symbol in (("O1O3_m", "l_O1O3"), ("BO3_m", "l_BO3"), ("CO3_m", "l_CO3"), ("CD_m", "l_CD")):
        assert value(data, symbol) == pytest.approx(1000 * given[name], rel=1e-12)
    assert [value(data, s) for s in ("n", "p_5", "p_4", "W")] == [5, 7, 0, 1]
    # group 4-5, what is left, group 2-3, the crank: 3.4, 1
    assert [s["value"] for s in data["steps"] if s["symbol"] in ("W_g", "W_m")] == [0, 1, 0, 1]


def _collinear(rod: float, rocker: float, frame: float, crank: float) -> float:
    """Angle between the lines of crank and rod at both dead points of a crank-rocker, by the law of cosines, rad."""
    far, near = ((rod + k * crank) for k in (1, -1))
    one, two = (math.acos((r**2 + frame**2 - rocker**2) / (2 * r * frame)) for r in (far, near))
    return abs(one - two)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("keys", "between"),
    [
        (("crank_length=90", "frame_length=300", "lever_length=500"), 2 * math.asin(90 / 300)),
        (("crank_length=90", "frame_length=300", "lever_length=500", "second=slider", "rod_length=700",
          "guide_height=20", "frame_angle_deg=35", "start_angle_deg=77"), None),
        (("first=rods", "crank_length=40", "coupler_length=120", "lever_length=80", "frame_length=100"),
         _collinear(120, 80, 100, 40)),
        (("first=slider", "crank_length=50", "coupler_length=200", "guide_height=30"),
         math.asin(30 / 150) - math.asin(30 / 250)),
        (("first=slider", "crank_length=50", "coupler_length=200"), 0.0),
    ],
)  # fmt: skip
def test_the_ways_to_and_fro_take_their_times(keys: tuple[str, ...], between: float | None) -> None:
    """K = (pi + theta) / (pi - theta), theta between both lines of the crank at its dead points (Levitsky, Norton)."""
    found = calculated(*keys)["values"]
    assert found["forward_angle_deg"] + found["backward_angle_deg"] == pytest.approx(360, rel=1e-12)
    if between is not None:
        assert found["ratio_of_ways"] == pytest.approx((math.pi + between) / (math.pi - between), rel=1e-9)
    # at rest there
    for end in ("rear_dead_point_deg", "front_dead_point_deg"):
        data = calculated(*(k for k in keys if "start" not in k), f"start_angle_deg={found[end]!r}", "positions=2")
        row = data["positions"][0]
        last = "V_D" if "second=slider" in keys else "V_B" if "first=slider" in keys else "ω_3"
        assert row[last] == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(
    "keys",
    [
        ("first=rods", "crank_length=40", "coupler_length=120", "lever_length=80", "frame_length=100"),
        ("first=rods", "crank_length=40", "coupler_length=90", "lever_length=110", "frame_length=100", "first_side=-1",
         "frame_angle_deg=70"),
        ("first=rods", "crank_length=100", "coupler_length=90", "lever_length=110", "frame_length=40"),
        ("first=slider", "crank_length=50", "coupler_length=200", "guide_height=-30", "guide_angle_deg=25"),
        ("first=slider", "crank_length=50", "coupler_length=200", "guide_height=30"),
    ],
)  # fmt: skip
def test_the_transmission_angle_is_that_between_the_links(keys: tuple[str, ...]) -> None:
    data = calculated(*keys, "start_angle_deg=40", "positions=720", "mass_point=0.25")
    normal = 90 + next((float(key.partition("=")[2]) for key in keys if "guide_angle" in key), 0)
    told = [(row["φ_2"] - row.get("φ_3", normal)) % 180 for row in data["positions"]]
    angles = [min(angle, 180 - angle) for angle in told]
    assert data["values"]["transmission_angle_deg"] == pytest.approx(angles[0], rel=1e-9)
    least = data["values"]["joint_transmission_angle_deg"]
    assert least <= min(angles) + 1e-9
    assert least == pytest.approx(min(angles), abs=0.3)


def test_a_point_of_the_rod_has_its_velocity_and_acceleration() -> None:
    """Differences of its places: the crank of Khurmi 8.1 and a four-bar linkage that speeds up."""
    for keys in (
        ("first=slider", "crank_length=150", "coupler_length=600"),
        ("first=rods", "crank_length=40", "coupler_length=120", "lever_length=80", "frame_length=100"),
    ):
        step, crank = 1e-3, float(keys[1].partition("=")[2])
        rates = "speed=1", "acceleration=0.5", "positions=2", "mass_point=0.3"

        def place(time: float, keys: tuple[str, ...] = keys, crank: float = crank) -> complex:
            turned = math.radians(40) + time + 0.25 * time**2
            row = calculated(*keys, f"start_angle_deg={math.degrees(turned)!r}", "positions=2")["positions"][0]
            rod = float(keys[2].partition("=")[2]) * cmath.exp(1j * math.radians(row["φ_2"]))
            return cmath.rect(crank, turned) + 0.3 * rod

        before, here, after = (place(time) for time in (-step, 0, step))
        data = calculated(*keys, "start_angle_deg=40", *rates)
        assert value(data, "V_S2") == pytest.approx(abs(after - before) / (2000 * step), rel=1e-5)
        assert value(data, "a_S2") == pytest.approx(abs(after - 2 * here + before) / (1000 * step**2), rel=1e-4)


def test_a_crank_turns_by_its_speed_in_rpm_too() -> None:
    """Khurmi 8.4: crank 150, rod 600 mm, 300 rpm, 45 degrees from the inner dead point: 4 m/s, rod 5.67 rad/s."""
    row = calculated("first=slider", "crank_length=150", "coupler_length=600", "speed_rpm=300", "start_angle_deg=45")
    crank, ratio, turn = math.radians(45), 600 / 150, 10 * math.pi
    lean = math.sqrt(ratio**2 - math.sin(crank) ** 2)
    velocity = -0.15 * turn * (math.sin(crank) + math.sin(2 * crank) / (2 * lean))
    assert row["positions"][0]["V_B"] == pytest.approx(velocity, rel=1e-12)
    # the book measures a plan
    assert abs(velocity) == pytest.approx(4, abs=0.1)
    assert abs(row["positions"][0]["ω_2"]) == pytest.approx(5.67, abs=0.05)
    assert value(row, "ω_1") == pytest.approx(turn, rel=1e-15)


def test_the_stroke_ends_at_the_dead_points() -> None:
    """Rod and crank lie on one line there; by the finest positions it was 3e-5 mm less."""
    data = calculated("first=slider", "crank_length=173", "coupler_length=483", "guide_height=-34",
                      "guide_angle_deg=40", "second_side=-1")  # fmt: skip
    far, near = (math.sqrt((483 + side * 173) ** 2 - 34**2) for side in (1, -1))
    assert value(data, "H") == pytest.approx(far - near, abs=1e-10)


def test_a_lever_that_goes_round_has_no_dead_points() -> None:
    assert "ratio_of_ways" not in calculated("crank_length=100", "frame_length=60", "lever_length=150")["values"]


@pytest.mark.parametrize(
    ("case", "symbol", "number"),
    [("omega3", "ω_3", "13.2"), ("V_B", "V_B", "14.22"), ("V_C", "V_C", "3.56"), ("V_D", "V_D", "3.58"),
     ("omega4", "ω_4", "0.542"), ("a_cor", "a_A3A2_k", "73.1"), ("a_n", "a_3n", "154.6"), ("eps3", "ε_3", "42.6"),
     ("a_B", "a_B", "194.1"), ("a_C", "a_C", "48.6"), ("a_n_DC", "a_4n", "0.22"), ("eps4", "ε_4", "64.3"),
     ("a_D", "a_D", "0.3")],
)  # fmt: skip
def test_what_the_example_prints_is_told_beside_the_right_number(case: str, symbol: str, number: str) -> None:
    assert any(str(printed).rstrip("0") == number.rstrip("0") for printed in CASES[f"ex.{case}"]["printed"].values())
    told = next(s for s in calculated("code=1071")["steps"] if s["symbol"] == symbol)
    assert f": {number} (" in told["misprint"]
    # of another number there is nothing to tell, though its keys are the same
    other = calculated("assignment=1", "variant=7", "start_angle_deg=20", "speed=40")
    assert value(other, symbol) == pytest.approx(told["value"], rel=1e-12)
    assert not [s for s in other["steps"] if "misprint" in s]


def _rows(data: dict[str, Any], name: str) -> list[list[Any]]:
    return [list(row.values()) for row in data[name]]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("code", ["1071", "5530", "2384"])
def test_the_page_tells_the_rows_that_a_code_chooses(code: str) -> None:
    """Each group of columns is that of the assignment by the row told alone."""
    data = calculated(f"code={code}")
    (note,) = [note for note in data["notes"] if note.startswith("assignment")]
    found = re.fullmatch(r"assignment (\d+), rows (\d+), (\d+), (\d+) of columns a, b, v: .*", note)
    assert found
    for row, symbol in zip(found.groups()[1:], ("φ_1", "ω_1", "l_AO1"), strict=True):
        alone = calculated(f"assignment={found[1]}", f"variant={row}")
        assert value(alone, symbol) == value(data, symbol)
        assert any(told.startswith(f"assignment {found[1]}, row {row}: ") for told in alone["notes"])


def test_both_plans_have_the_lengths_of_the_example() -> None:
    data = calculated("code=1071")
    speeds = {row[0]: row[-1] for row in _rows(data, "velocity_plan")}
    changes = {row[0]: row[-1] for row in _rows(data, "acceleration_plan")}
    for found, name, case, key in (
        (speeds, "pa", "V_A", "pa_mm"), (speeds, "pa3", "V_A3", "a3o3_mm"), (speeds, "a3a2", "V_A3", "a3a2_mm"),
        (speeds, "pb", "V_B", "pb_mm"), (speeds, "pd", "V_D", "pd5_mm"), (speeds, "cd", "omega4", "c4d4_mm"),
        (changes, "πa", "a_A", "pi_a_mm"), (changes, "n3a3", "eps3", "n3a3_mm"), (changes, "πb", "a_B", "b3o3_mm"),
        (changes, "πc", "a_C", "c3o3_mm"), (changes, "n4d", "eps4", "n4d4_mm"),
    ):  # fmt: skip
        assert found[name] == pytest.approx(CASES[f"ex.{case}"]["recomputed"][key], rel=1e-6), name
    drawn = {row[0]: row[-1] for row in _rows(data, "lengths")}
    for name, right in CASES["ex.drawing_lengths"]["recomputed"].items():
        symbol = {"AO1_mm": "l_AO1"}.get(name, f"l_{name.removesuffix('_mm')}")
        assert drawn[symbol] == pytest.approx(right, rel=1e-12)


# lengths that the guidelines measured on the plans of their example, 3.4: of a_D its 0.3 m/s2 at 3 m/s2 for 1 mm
ON_THE_PLANS = {
    "pa3": ("V_A3", "a3o3_mm"), "a3a2": ("V_A3", "a3a2_mm"), "pb": ("V_B", "pb_mm"), "pd": ("V_D", "pd5_mm"),
    "cd": ("omega4", "c4d4_mm"), "n3a3": ("eps3", "n3a3_mm"), "πb": ("a_B", "b3o3_mm"), "πc": ("a_C", "c3o3_mm"),
    "n4d": ("eps4", "n4d4_mm"), "πd": ("a_D", "a_D_m_s2"),
}  # fmt: skip


def test_lengths_measured_on_a_plan_are_held_against_the_exact_ones() -> None:
    """Guidelines, 2.2.2, 7: at most 3 %; their own plans keep it but for cd, and πd is shorter than can be read."""
    printed, right = {}, {}
    for name, (case, key) in ON_THE_PLANS.items():
        printed[name] = CASES[f"ex.{case}"]["printed"][key] / (3 if name == "πd" else 1)
        right[name] = abs(FULL[key]) / 3 if name == "πd" else CASES[f"ex.{case}"]["recomputed"][key]
    data = calculated("code=1071", *(f"measured.{name.replace('π', 'pi')}={x}" for name, x in printed.items()))
    rows = {row[0]: row[1:] for t in ("measured_velocities", "measured_accelerations") for row in _rows(data, t)}
    assert rows.keys() == printed.keys()
    assert [len(data[t]) for t in ("measured_velocities", "measured_accelerations")] == [5, 5]
    for name, (length, exact, read, speed, off) in rows.items():
        scale = 0.1 if name in list(ON_THE_PLANS)[:5] else 3
        assert (length, read) == pytest.approx((printed[name], printed[name] * scale), rel=1e-12)
        assert (exact, speed) == pytest.approx((right[name], right[name] * scale), rel=1e-6)
        assert off == pytest.approx(100 * (printed[name] / right[name] - 1), rel=1e-6)
    assert [name for name, row in rows.items() if abs(row[-1]) > 3] == ["cd", "πd"]
    told = [note for note in data["notes"] if note.startswith(("cd", "πd", "what was measured"))]
    assert told == [
        "cd is off by -6.6 %, more than the 3 % that the guidelines allow",
        "πd: 0.1 mm, to which a plan is read, is more than 3 % of its 0.0191 mm",
    ]
    # what the example misprints is told as without
    assert value(data, "V_D") == value(calculated("code=1071"), "V_D")
    assert sum("misprint" in step for step in data["steps"]) == 14


@pytest.mark.parametrize(("length", "kept"), [(97.1, True), (96.9, False), (102.9, True), (103.1, False), (0, False)])
def test_a_plan_may_be_off_by_3_percent(length: float, kept: bool) -> None:
    """A crank of 100 mm at 10 rad/s: 1 m/s, 100 mm to the scale that is given."""
    own = ("crank_length=100", "speed=10", "frame_length=300", "lever_length=500", "velocity_scale=0.01")
    data = calculated(*own, f"measured.pa={length}")
    assert [[*row.values()][1:] for row in data["measured_velocities"]] == [
        pytest.approx([length, 100, length / 100, 1, length - 100])
    ]
    assert "measured_accelerations" not in data
    limit = [note for note in data["notes"] if "guidelines allow" in note]
    assert [note.startswith("what was measured is within") for note in limit] == [kept]


@pytest.mark.parametrize("keys", [("code=1071",), ("assignment=4",), ("assignment=8",), ("assignment=10",)], ids=str)
def test_plans_close(keys: tuple[str, ...]) -> None:
    """Along any other way from the pole a vector ends where the direct one does."""
    ways = {
        "velocity_plan": [("pa3", ("pa", "a3a2")), ("pb", ("pa", "ab")), ("pd", ("pc", "cd"))],
        "acceleration_plan": [("πa", ("πn3", "n3a3", "-ka3", "-a2k")), ("πb", ("πa", "an2", "n2b")),
                              ("πd", ("πc", "cn4", "n4d")), ("πb", ("πn3", "n3b")), ("πd", ("πn5", "n5d"))],
    }  # fmt: skip
    closed = 0
    for table, checks in ways.items():
        vectors = {r[0]: cmath.rect(r[1], math.radians(r[2])) for r in _rows(calculated(*keys), table)}
        for direct, way in checks:
            if direct in vectors and all(step.lstrip("-") in vectors for step in way):
                total = sum(-vectors[s[1:]] if s.startswith("-") else vectors[s] for s in way)
                assert abs(total - vectors[direct]) < 1e-9 * max(map(abs, vectors.values()))
                closed += 1
    assert closed == {"assignment=8": 2, "code=1071": 4}.get(keys[0], 5)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("keys", "link", "end"), [(("assignment=10",), "5", "D"), (("assignment=4",), "3", "B")], ids=str
)
def test_a_rocker_has_both_parts_of_its_acceleration(keys: tuple[str, ...], link: str, end: str) -> None:
    """Its angular acceleration is what its angular velocity grows by, its normal part points to its pivot."""
    data, step = calculated(*keys), 1e-3
    start = data["positions"][0]["φ_1"]
    near = [calculated(*keys, f"start_angle_deg={start + k * step}")["positions"][0][f"ω_{link}"] for k in (-1, 1)]
    rate = (near[1] - near[0]) / math.radians(2 * step) * value(data, "ω_1")
    assert value(data, f"ε_{link}") == pytest.approx(abs(rate), rel=1e-6)
    plan = {r[0]: cmath.rect(r[1], math.radians(r[2])) for r in _rows(data, "acceleration_plan")}
    normal, across = plan[f"πn{link}"], plan[f"n{link}{end.lower()}"]
    assert abs(normal) == pytest.approx(value(data, f"a_{link}n"), rel=1e-9)
    assert abs(across) == pytest.approx(value(data, f"a_{link}t"), rel=1e-9)
    lever = cmath.rect(1, math.radians(data["positions"][0][f"φ_{link}"]))
    assert abs(normal / lever + abs(normal)) < 1e-9 * abs(normal)
    assert (across / lever).imag == pytest.approx(math.copysign(abs(across), rate), rel=1e-9)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("variant", range(1, 11))
def test_variants_of_the_first_assignment(variant: int) -> None:
    right, data = CASES[f"task1.variant{variant}"]["recomputed"], calculated("assignment=1", f"variant={variant}")
    for name in ("V_A_m_s", "V_A3A2_m_s", "V_B_m_s", "V_C_m_s", "a_B_m_s2", "a_C_m_s2"):
        assert value(data, SYMBOLS[name]) == pytest.approx(abs(right[name]), rel=1e-9, abs=1e-9), name
    assert value(data, "ω_3") == pytest.approx(abs(right["omega3_rad_s"]), rel=1e-9)
    assert value(data, "ε_3") == pytest.approx(abs(right["eps3_signed_rad_s2"]), rel=1e-9, abs=1e-9)
    # variant 6: the stone leaves its lever (3.5 against 3.0 cranks)
    assert any("leaves the lever" in note for note in data["notes"]) == (variant == 6)


@pytest.mark.parametrize("height", [-0.3, -0.2, -0.1, 0.1, 0.2])
def test_other_guides_of_the_example(height: float) -> None:
    right = CASES[f"ex.guide.{height}"]["recomputed"]
    data = calculated("assignment=1", "variant=7", "start_angle_deg=20", "speed=40", f"guide_height={1000 * height}")
    assert value(data, "φ_4") == pytest.approx(right["delta_CD_deg"], rel=1e-10)
    assert value(data, "ω_4") == pytest.approx(abs(right["omega4_rad_s"]), rel=1e-9)
    assert value(data, "V_D") == pytest.approx(right["V_D_m_s"], rel=1e-10)
    assert value(data, "ε_4") == pytest.approx(right["eps4_rad_s2"], rel=1e-9)
    assert value(data, "a_D") == pytest.approx(abs(right["a_D_m_s2"]), rel=1e-8)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("assignment", range(1, 11))
def test_every_assignment_moves_all_round(assignment: int) -> None:
    """Every row of it; what the tables tell is what the steps tell, and the output comes back to where it began."""
    for variant in range(1, 11):
        data = calculated(f"assignment={assignment}", f"variant={variant}", "positions=24")
        rows = np.array(_rows(data, "positions"), dtype=float)
        assert rows.shape[0] == 24
        assert np.allclose(np.diff(rows[:, 0]), 15.0)
        assert np.isfinite(rows).all()
        # the first row is the position of the steps
        first = data["positions"][0]
        link = "ω_2" if "ω_2" in first else "ω_3"
        assert abs(first[link]) == pytest.approx(value(data, link))
        # what slides comes back: its velocity over the turn is nothing in the mean, and its stroke is seen
        if "S_D" in first or "S_B" in first:
            out = "D" if "S_D" in first else "B"
            speeds = [row[f"V_{out}"] for row in data["positions"]]
            assert abs(np.mean(speeds)) < 0.03 * np.abs(speeds).max()
            travel = np.ptp([row[f"S_{out}"] for row in data["positions"]])
            assert 0.9 * value(data, "H") < travel <= value(data, "H") * (1 + 1e-9)


AGAIN = [
    *((f"assignment={number}", f"variant={row}") for number in range(1, 11) for row in (1, 4, 9)),
    ("assignment=4", "guide_angle_deg=20"), ("assignment=8", "guide_angle_deg=70"),
    ("assignment=8", "second_guide_angle_deg=90"),
    ("assignment=9", "guide_angle_deg=20", "guide_height=12", "second_guide_angle_deg=-60"),
]  # fmt: skip


@pytest.mark.sampled(8)
@pytest.mark.parametrize("keys", AGAIN, ids=str)
def test_a_page_is_reckoned_again_from_what_it_gives(keys: tuple[str, ...]) -> None:
    """Both loops close in every position, with their first and second derivatives: by the section "Given" alone."""
    data = calculated(*keys)
    given = {s["symbol"]: s["value"] for s in data["steps"] if s["section"] == "Given"}

    def turned(row: dict[str, float], link: str, length: float, more: float = 0.0) -> np.ndarray:
        """A vector of a link, its velocity and acceleration."""
        rate, change = (given["ω_1"], 0.0) if link == "1" else (row[f"ω_{link}"], row[f"ε_{link}"])
        unit = length * cmath.exp(1j * math.radians(row[f"φ_{link}"] + more))
        return np.array([unit, 1j * rate * unit, (1j * change - rate**2) * unit])

    def still(length: float, angle: float) -> np.ndarray:
        return np.array([cmath.rect(length, math.radians(angle)), 0, 0])

    def on_guide(point: np.ndarray, guide: str = "γ_h") -> np.ndarray:
        """How far it is off a guide."""
        return (point * cmath.exp(-1j * math.radians(given.get(guide, 0.0)))).imag - np.array([given["h"], 0, 0])

    for row in data["positions"]:
        end, found = turned(row, "1", given["l_AO1"]), []
        if "l_O1O3" not in given:
            found.append(on_guide(end + turned(row, "2", given["l_AB"])))
            if "γ_h2" in given:
                found.append(on_guide(end + turned(row, "4", given["l_AB"]), "γ_h2"))
        else:
            pivot = still(given["l_O1O3"], given["γ_0"])
            if "l_AB" in given:
                found.append(end + turned(row, "2", given["l_AB"]) - pivot - turned(row, "3", given["l_BO3"]))
            else:
                # the stone keeps to the lever: seen from its pivot nothing lies across it
                seen, way = end - pivot, turned(row, "3", 1.0).conjugate()
                products = seen[0] * way[0], seen[1] * way[0] + seen[0] * way[1], seen @ (way[::-1] * [1, 2, 1])
                found.append(np.array(products).imag)
            own = turned(row, "3", given["l_CO3"], given["γ_C"]) + turned(row, "4", given["l_CD"])
            if "h" in given:
                found.append(on_guide(own))
            else:
                found.append(own - still(given["l_O3O5"], given["γ_5"]) - turned(row, "5", given["l_DO5"]))
        for gap in found:
            assert (
                np.abs(gap) < 1e-9 * given["l_AO1"] * np.array([1, 10, 100]) * [1, given["ω_1"], given["ω_1"] ** 2]
            ).all()


@pytest.mark.sampled(1)
@pytest.mark.parametrize("assignment", range(2, 11))
def test_what_is_said_to_be_free_is_taken(assignment: int) -> None:
    """Keys by which the note says that the lost figure may be made up for; a machine of two cylinders is named."""
    data = calculated(f"assignment={assignment}")
    (free,) = (note.partition("otherwise: ")[2].split(", ") for note in data["notes"] if "figure" in note)
    given = {s["symbol"]: s["value"] for s in data["steps"]}
    symbols = {"frame_angle_deg": "γ_0", "arm_angle_deg": "γ_C", "pivot_angle_deg": "γ_5", "guide_height": "h"}
    for key in free:
        other = -1 if key.endswith("side") else given.get(symbols.get(key, ""), 0.0) - 1
        changed = calculated(f"assignment={assignment}", f"{key}={other}")
        assert changed["positions"][0] != data["positions"][0], key
    assert any("second_guide_angle_deg adds it" in note for note in data["notes"]) == (assignment in (8, 9))


def test_the_second_cylinder_is_the_first_at_another_angle() -> None:
    """Of one crank: what it does is what the first does where the crank is as far from its own guide."""
    own = "assignment=9", "variant=3", "guide_height=7"
    both = calculated(*own, "second_guide_angle_deg=60")
    alone, early = calculated(*own), calculated(*own, "start_angle_deg=5")
    assert [value(both, s) for s in ("n", "p_5", "W")] == [5, 7, 1]
    for row, first, second in zip(both["positions"], alone["positions"], early["positions"], strict=True):
        assert {key: row[key] for key in first} == first
        assert row["φ_4"] == pytest.approx(second["φ_2"] + 60)
        names = {"ω_4": "ω_2", "ε_4": "ε_2", "S_D": "S_B", "V_D": "V_B", "a_D": "a_B"}
        assert [row[name] for name in names] == pytest.approx([second[of] for of in names.values()], abs=1e-6)
    for name in ("V", "a"):
        assert value(both, f"{name}_D") == pytest.approx(value(early, f"{name}_B"), rel=1e-12)
        assert value(both, f"{name}_S4") == pytest.approx(value(early, f"{name}_S2"), rel=1e-12)
    # the plans close: a and d, and what both were before
    for plan in ("velocity_plan", "acceleration_plan"):
        ends = {row["vector"]: cmath.rect(row["value"], math.radians(row["direction"])) for row in both[plan]}
        pole = "p" if plan == "velocity_plan" else "π"
        chain = ["ad"] if pole == "p" else ["an4", "n4d"]
        assert abs(ends[f"{pole}a"] + sum(ends[name] for name in chain) - ends[f"{pole}d"]) < 1e-9 * abs(
            ends[f"{pole}a"]
        )


def test_the_second_cylinder_is_drawn(tmp_path: Path) -> None:
    """Its slider and its rod from A stand in the scheme, two blocks in all; loads are those of one cylinder."""
    file = tmp_path / "scheme.svg"
    calculate("lever", ("assignment=8", "second_guide_angle_deg=90", f"picture={file}"), "text", "en")
    scheme = ET.parse(file).getroot().find("{http://www.w3.org/2000/svg}g")
    assert scheme is not None
    tags = [element.tag.rpartition("}")[2] for element in scheme.iter()]
    assert tags.count("rect") == 2
    names = [element.text for element in scheme.iter() if element.tag.endswith("text")]
    assert {"A", "B", "D", "O1", "S2", "S4"} <= {*names}
    for load in ("masses.2=3", "resistance=500", "point_masses.B=2"):
        with pytest.raises(SceneError, match="second_guide_angle_deg is given already"):
            calculate("lever", ("assignment=8", "second_guide_angle_deg=90", load), "text", "en")
    with pytest.raises(SceneError, match="belongs to no link"):
        calculate("lever", ("assignment=4", "second_guide_angle_deg=90"), "text", "en")


def test_the_choice_by_number_is_that_of_the_guidelines() -> None:
    """Row 1 for a, 10 for b, 7 for v, assignment 1."""
    right, data = CASES["selection"]["recomputed"], calculated("code=10-71")
    assert value(data, "φ_1") == right["phi0_deg"]
    assert value(data, "ω_1") == right["omega1_rad_s"]
    assert value(data, "l_AO1") == 1000 * right["AO1_m"]
    assert value(data, "l_O1O3") / value(data, "l_AO1") == pytest.approx(right["O1O3/AO1"])
    assert value(data, "l_CD") / value(data, "l_CO3") == pytest.approx(right["CD/CO3"])


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "words",
    ["lever code=1071", "lever assignment=4 variant=3", "lever assignment=8 variant=2", "lever assignment=10",
     "lever assignment=2 variant=5"],
)  # fmt: skip
def test_every_printed_formula_gives_its_value(words: str) -> None:
    checked = [step for step in sheet_for(words).steps() if step.formula]
    assert len(checked) >= 4
    for step in checked:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-9, abs=1e-9), (step.symbol, step.formula)


def test_the_picture_shows_scheme_plans_and_diagrams(tmp_path: Path) -> None:
    file = tmp_path / "lever.svg"
    calculate("lever", ["code=1071", f"picture={file}"], "text", "uk")
    words = [e.text for e in ET.parse(file).iter() if e.tag.endswith("}text")]
    assert {"O1", "O3", "A", "B", "C", "D", "pa", "pa3", "a3a2", "πa", "a2k"} <= set(words)
    assert "План швидкостей" in words
    assert sum(bool(word) and word.startswith(("S, мм ", "V, м/с ", "a, м/с² ")) for word in words) == 3
    # the links as drawn are as long as they are, in one scale
    lines = [
        e.attrib["points"]
        for e in ET.parse(file).iter()
        if e.tag.endswith("polyline") and "width:3" in e.attrib["style"]
    ]
    ends = [[complex(*map(float, p.split(","))) for p in line.split()] for line in lines]
    sizes = sorted(abs(a - b) for a, b in ends)
    assert np.allclose(np.array(sizes) / sizes[0], np.array(sorted([300, 1080, 270, 756])) / 270, rtol=1e-3)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("assignment", "link"), [(10, "5"), (1, None)])
def test_the_diagrams_are_those_of_what_the_output_does(assignment: int, link: str | None, tmp_path: Path) -> None:
    """A rocker turns: its angle, angular velocity and acceleration, as its sheet has them; a slider travels."""
    file = tmp_path / "lever.svg"
    own = [f"assignment={assignment}", "positions=720", f"picture={file}"]
    rows = json.loads(calculate("lever", own, "json", "en"))["positions"]
    told = [e.text for e in ET.parse(file).iter() if e.tag.endswith("}text") and e.text and " … " in e.text]
    names = [f"ψ, °=φ_{link}", f"ω, rad/s=ω_{link}", f"ε, rad/s²=ε_{link}"]
    if link is None:
        names = ["S, mm=S_D", "V, m/s=V_D", "a, m/s²=a_D"]
    for text, name in zip(told, names, strict=True):
        head, column = name.split("=")
        values = np.array([row[column] for row in rows])
        if column.startswith("φ"):
            values = np.degrees(np.unwrap(np.radians(values)))
            values -= values.min()
        shown, ends = text.split("  ")
        assert shown == head
        low, high = (float(end.replace("\u2212", "-")) for end in ends.split(" … "))
        assert (low, high) == pytest.approx((min(values.min(), 0), max(values.max(), 0)), rel=1e-3)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("count", [12, 8])
def test_the_scheme_shows_every_position_by_its_number(count: int, tmp_path: Path) -> None:
    file = tmp_path / "lever.svg"
    own = ["crank_length=100", "speed=10", "first=rods", "frame_length=260", "coupler_length=270", "lever_length=210"]
    calculate("lever", [*own, "start_angle_deg=15", f"positions={count}", f"picture={file}"], "text", "en")
    found = [*ET.parse(file).iter()]
    assert {str(n) for n in range(count)} <= {e.text for e in found if e.tag.endswith("}text")}

    def drawn(width: str) -> np.ndarray:
        marks = (e for e in found if e.tag.endswith("polyline") and e.attrib["style"].endswith(f"width:{width}"))
        pairs = ([complex(*map(float, p.split(","))).conjugate() for p in e.attrib["points"].split()] for e in marks)
        return np.array([*pairs])

    bold, thin = drawn("2.5"), drawn("0.5").reshape(count - 1, 3, 2)[::-1]
    pivot, scale = bold[0, 0], abs(bold[0, 1] - bold[0, 0]) / 100
    cranks, levers = (thin[:, 0, 1] - pivot) / scale, (thin[:, 2] - pivot) / scale
    assert np.allclose(cranks, 100 * np.exp(1j * np.radians(15 + 360 / count * np.arange(1, count))), atol=0.05)
    # of the triangle of diagonal, coupler and lever by the cosine rule
    frame = levers[:, 0]
    assert np.allclose(abs(frame), 260, atol=0.05)
    diagonal = cranks - frame
    corner = np.arccos((abs(diagonal) ** 2 + 210**2 - 270**2) / (2 * abs(diagonal) * 210))
    ways = [frame + 210 * diagonal / abs(diagonal) * np.exp(sign * 1j * corner) for sign in (1, -1)]
    assert any(np.allclose(levers[:, 1], way, atol=0.1) for way in ways)


@pytest.mark.parametrize(
    ("keys", "key", "code", "nearest"),
    [
        (("assignment=11",), "assignment", "not_among_ten", 10),
        (("assignment=1", "variant=0"), "variant", "not_among_ten", 1),
        (("variant=2",), "variant", "needs_other", None),
        (("code=107",), "code", "not_four_digits", None),
        (("code=1071", "variant=2"), "variant", "other_is_given", None),
        (("assignment=8", "frame_length=20"), "frame_length", "of_no_link", None),
        (("assignment=1", "pivot_distance=20"), "pivot_distance", "of_no_link", None),
        (("assignment=10", "guide_height=20"), "guide_height", "of_no_link", None),
        (("assignment=1", "gravity=0"), "gravity", "of_no_link", None),
        ((), "crank_length", "missing_key", None),
        (("crank_length=30",), "frame_length", "missing_key", None),
        (("crank_length=30", "first=slider", "coupler_length=30", "resistance=5", "unevenness=0.1"), "coupler_length",
         "rod_does_not_reach", 30.0001),
        (("crank_length=30", "first=slider", "coupler_length=20", "start_angle_deg=410"),
         "start_angle_deg", "links_do_not_meet", 401.8093),
        (("crank_length=30", "first=slider", "coupler_length=20", "start_angle_deg=-50"), "start_angle_deg",
         "links_do_not_meet", -41.8093),
        (("crank_length=30", "first=slider", "coupler_length=20", "guide_height=50.1"), "coupler_length",
         # what closes as the crank stands, by the height of its end; so below: by C of the lever, by A and the pivot
         "rod_does_not_reach", 50.1),
        (("crank_length=30", "first=slider", "coupler_length=90", "second=slider"), "second", "lever_needed", None),
        (("crank_length=30", "frame_length=30", "lever_length=90"), "start_angle_deg", "links_do_not_meet", 0.001),
        (("crank_length=30", "frame_length=30", "lever_length=90", "sheet=a.dxf"), "frame_length",
         "stone_through_pivot", None),
        (("assignment=1", "rod_length=50"), "rod_length", "rod_does_not_reach",
         200.88 * math.cos(math.radians(6.86777))),
        (("assignment=4", "coupler_length=900"), "coupler_length", "rods_do_not_close",
         294 + abs(364 - cmath.rect(140, math.radians(20)))),
        # the frame less crank and lever; before: what closes at every angle, 890 mm
        (("crank_length=100", "first=rods", "frame_length=1000", "coupler_length=270", "lever_length=210"),
         "coupler_length", "rods_do_not_close", 690.0),
        (("assignment=4", "measured.pe=30"), "pe", "no_such_name", None),
        (("assignment=8", "measured.pid=30"), "pid", "no_such_name", None),
        # πd told twice: it was a traceback
        (("assignment=4", "measured.πd=30", "measured.pid=30"), "pid", "either_key", None),
    ],
)  # fmt: skip
def test_wrong_input_is_refused_by_its_key(keys: tuple[str, ...], key: str, code: str, nearest: object) -> None:
    with pytest.raises(SceneError) as found:
        calculate("lever", keys, "text", "en")
    assert (found.value.key.rpartition(".")[2], found.value.code) == (key, code)
    if nearest is not None:
        offered = found.value.nearest
        assert offered is not None
        assert offered.value == pytest.approx(nearest, rel=2e-6)
        changed = [k for k in keys if not k.startswith(f"{key}=")]
        calculate("lever", [*changed, f"{key}={offered.value}"], "text", "en")


PUMP = ("first=slider", "crank_length=100", "coupler_length=300", "speed=20", "resistance=2000", "unevenness=0.04")


def test_a_flywheel_for_a_pump() -> None:
    """Work over a turn: force by stroke, twice of it where both ways resist; masses at A change nothing."""
    data = calculated(*PUMP, "resisted=backward", "point_masses.B=10", "point_masses.A=2")
    assert value(data, "A_c") == pytest.approx(2000 * 0.2, rel=1e-9)
    assert value(data, "J_min") == pytest.approx(2 * 0.1**2, rel=1e-9)
    assert value(data, "J_m") == pytest.approx(value(data, "ΔT_m") / (20**2 * 0.04), rel=1e-12)
    assert value(calculated(*PUMP), "A_c") == pytest.approx(2000 * 0.4, rel=1e-9)
    heavier = calculated(*PUMP, "resisted=backward", "point_masses.B=10", "point_masses.A=50")
    assert value(heavier, "J_m") == pytest.approx(value(data, "J_m"), rel=1e-12)
    rows = data["cycle"]
    assert len(rows) == 13
    for row in rows:
        # the slider's own kinetic energy, from its velocity in the other table
        assert row["ΔT"] == pytest.approx(row["A_d"] - row["A_c"], abs=1e-9)
        assert row["ΔT_m"] == pytest.approx(row["ΔT"] - row["ΔT_l"], abs=1e-9)
    for row, at in zip(rows, data["positions"], strict=False):
        assert row["M_c"] == pytest.approx(max(-at["V_B"], 0.0) * 2000 / 20, abs=1e-9)
        assert row["J"] == pytest.approx(2 * 0.01 + 10 * (at["V_B"] / 20) ** 2, rel=1e-9)


def test_a_flywheel_of_the_screen() -> None:
    data = calculated("code=1071", "resistance=1000", "unevenness=0.02", "point_masses.D=20")
    assert value(data, "A_c") == pytest.approx(1000 * 2 * value(data, "H") / 1000, rel=1e-8)
    forward = calculated("code=1071", "resistance=1000", "unevenness=0.02", "resisted=forward")
    assert value(forward, "A_c") == pytest.approx(1000 * value(data, "H") / 1000, rel=1e-8)


@pytest.mark.parametrize(
    ("keys", "key", "code"),
    [
        ((*PUMP[:4], "unevenness=0.02"), "unevenness", "needs_other"),
        ((*PUMP, "point_masses.D=1"), "D", "no_such_point"),
        (("assignment=10", "resistance=100", "unevenness=0.02"), "resistance", "needs_slider"),
    ],
)
def test_a_flywheel_needs_what_it_follows_from(keys: tuple[str, ...], key: str, code: str) -> None:
    with pytest.raises(SceneError) as found:
        calculate("lever", keys, "text", "en")
    assert (found.value.key.rpartition(".")[2], found.value.code) == (key, code)


ROCKER = ("first=rods", "crank_length=300", "coupler_length=360", "lever_length=360", "frame_length=600")


@pytest.mark.parametrize("side", [1, -1])
def test_a_double_rocker_has_its_position_and_the_angles_between_which_it_moves(side: int) -> None:
    loads = ("masses.2=3", "masses.3=2", "resisting_moment=5", "gravity_angle_deg=-70")
    data = calculated(*ROCKER, "start_angle_deg=60", "speed=10", "acceleration=30", f"first_side={side}", *loads)
    limit = math.degrees(math.acos((300**2 + 600**2 - 720**2) / (2 * 300 * 600)))
    assert value(data, "φ_1min") == pytest.approx(-limit, rel=1e-12)
    assert value(data, "φ_1max") == pytest.approx(limit, rel=1e-12)
    # differences of the places of B, found by circles
    step = 1e-3

    def place(time: float) -> complex:
        joint = cmath.rect(300.0, math.radians(60) + 10 * time + 15 * time**2)
        across = math.sqrt(360**2 - (abs(joint - 600) / 2) ** 2)
        return (joint + 600) / 2 + side * across * 1j * (joint - 600) / abs(joint - 600)

    before, here, after = (place(k * step) for k in (-1, 0, 1))
    assert value(data, "V_B") == pytest.approx(abs(after - before) / (2 * step) / 1000, rel=1e-4)
    assert value(data, "a_B") == pytest.approx(abs(after - 2 * here + before) / step**2 / 1000, rel=1e-4)
    (row,) = data["positions"]
    assert complex(row["x_B"], row["y_B"]) == pytest.approx(here, rel=1e-12)
    assert value(data, "M_b") == pytest.approx(value(data, "M_bZ"), rel=1e-10)
    assert len(data["forces"]) == 1
    # of a whole turn nothing is told
    assert {"greatest_output_velocity", "joint_transmission_angle_deg", "rear_dead_point_deg"}.isdisjoint(
        data["values"]
    )
    assert not {"cycle", "greatest_forces"} & data.keys()
    assert any("-100.953° and 100.953°" in note for note in data["notes"])
    assert any("coupler_length = 540.00" in note for note in data["notes"])


def test_a_second_group_may_hinder_the_crank(tmp_path: Path) -> None:
    """C swings on an arc of 270 mm; a rod of 250 reaches the guide where the lever leans far enough."""
    file = tmp_path / "screen.svg"
    words = ("crank_length=300", "frame_length=600", "frame_angle_deg=180", "lever_length=1080", "second=slider",
             "arm_length=270", "arm_angle_deg=-90", "rod_length=250", f"picture={file.as_posix()}")  # fmt: skip
    data = calculated(*words, "start_angle_deg=97")
    lean = math.acos(250 / 270)
    low, high = (value(data, symbol) for symbol in ("φ_1min", "φ_1max"))
    # O3A leans by that angle: the law of sines in O1O3A
    known = sorted(
        math.degrees(lean + k) for k in (math.asin(2 * math.sin(lean)), math.pi - math.asin(2 * math.sin(lean)))
    )
    assert (low, high) == pytest.approx(tuple(known), rel=1e-9)
    drawn = file.read_text(encoding="utf-8")
    assert "Plan of accelerations" in drawn
    assert "Output over a turn" not in drawn


def test_what_needs_a_whole_turn_is_refused_where_there_is_none() -> None:
    for more in (("unevenness=0.05", "resisting_moment=5"), ("sheet=a.dxf",)):
        with pytest.raises(SceneError) as found:
            calculate("lever", (*ROCKER, "start_angle_deg=60", *more), "text", "en")
        assert (found.value.key.rpartition(".")[2], found.value.code) == ("coupler_length", "rods_do_not_close")


@pytest.mark.parametrize(
    ("keys", "limits"),
    [
        (ROCKER, 2),
        ((*ROCKER, "frame_angle_deg=50", "start_angle_deg=400"), 2),
        ((*ROCKER, "frame_angle_deg=-200", "start_angle_deg=-900"), 2),
        # in line one over the other, too near to O3
        (("first=rods", "crank_length=90", "coupler_length=200", "lever_length=60", "frame_length=100",
          "start_angle_deg=180"), 2),
        (("first=rods", "crank_length=90", "coupler_length=60", "lever_length=90", "frame_length=60",
          "start_angle_deg=200"), 2),
        (("first=slider", "crank_length=90", "coupler_length=60"), 0),
    ],
)  # fmt: skip
def test_limits_of_the_crank_have_their_formula(keys: tuple[str, ...], limits: int) -> None:
    steps = [s for s in sheet_for(("lever", *keys)).steps() if s.symbol in ("φ_1min", "φ_1max")]
    assert len(steps) == 2
    told = [step for step in steps if step.formula]
    assert len(told) == limits
    for step in told:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-12, abs=1e-9)


def test_a_printed_picture_stays_on_its_page() -> None:
    """Its plans stand below each other, 2056 by 976: on A4 across the page, 392 mm high, a plan was cut in two."""
    page = calculate("lever", ["assignment=4", "variant=2", "masses.5=40", "resistance=1500"], "html", "en")
    ((wide, high),) = re.findall(r'<svg [^>]*viewBox="0 0 (\d+) (\d+)"', page)
    (margin,) = re.findall(r"@page{margin:(\d+)mm}", page)
    print_rules = page.partition("@media print{")[2].partition("</style>")[0]
    (most,) = re.findall(r"svg{max-height:(\d+)mm}", print_rules)
    assert (210 - 2 * int(margin)) * int(high) / int(wide) > 297
    # A4 and Letter
    assert int(most) <= min(297, 279) - 2 * int(margin)
    assert "figure{margin:0;page-break-inside:avoid}" in print_rules

"""``higherpair calc cam``: the cases of lessons 4 and 5 and of table 2.2, refusals, the table in every format."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.documents.topics import calculate
from parts.base.refusal import SceneError
from parts.base.texts import MINUS
from tests.exporters.command.test_cli import complaint

CASES = json.loads((Path(__file__).parents[2] / "published" / "cams.json").read_text(encoding="utf-8"))["cases"]
LAWS = {
    "constant acceleration": "constant_acceleration",
    "cosine acceleration": "cosine",
    "sine acceleration": "sine",
    "linearly decreasing acceleration": "linearly_decreasing",
    "3-4-5 polynomial": "polynomial_345",
}
JOINED = (("join", 0.25), ("constant_velocity", 0.5), ("join", 0.25))


def phases(rise: float, far: float, back: float, law: str) -> str:
    """The phases of a cam as a key of the command."""
    near = 360 - rise - far - back
    moves = [("rise", rise, law), ("dwell", far, ""), ("return_", back, law), ("dwell", near, "")]
    law_of = {"": ""} | {law: f', law = "{law}"'}
    text = ", ".join(f'{{ move = "{m}", angle_deg = {a}{law_of[w]} }}' for m, a, w in moves if a)
    return f"phases=[{text}]"


def calculated(*words: str) -> dict[str, Any]:
    return json.loads(calculate("cam", words, "json", "en"))


@pytest.mark.sampled(2)
@pytest.mark.parametrize("case", [c for c in CASES if ".p4.r0." in c["id"]], ids=lambda c: c["id"])
def test_lesson_4(case: dict[str, Any]) -> None:
    law = LAWS[case["inputs"]["law"]]
    data = calculated("follower=flat", "lift=38", "follower_offset=2", phases(120, 30, 120, law),
                      "least_transmission_angle_deg=45", "least_curvature_radius=10")  # fmt: skip
    expected, values = case["recomputed"], data["values"]
    assert values["least_prime_circle_radius"] == pytest.approx(expected["r0_mm"], rel=1e-12)
    assert values["least_base_circle_radius"] == pytest.approx(expected["R_min_with_rho_10_mm"], rel=1e-12)
    assert values["peak_acceleration"] == pytest.approx(expected["S2_max_mm"], rel=1e-12)
    assert [values[k] for k in ("rise_angle_deg", "far_dwell_angle_deg", "return_angle_deg", "near_dwell_angle_deg")] \
        == pytest.approx([120, 30, 120, 90])  # fmt: skip


def test_the_base_circle_of_a_flat_follower_follows_from_its_least_radius_of_curvature_alone() -> None:
    """The example of the README of gabemorris12/mechanism: R_b 1.893, face 2.55; the digits beyond by s + s'' at 50."""
    words = ("follower=flat", "lift=1", phases(90, 90, 90, "sine"))
    values = calculated(*words, "least_curvature_radius=0.25")["values"]
    assert values["least_base_circle_radius"] == pytest.approx(1.8926312786, abs=1e-10)
    assert values["least_base_circle_radius"] == pytest.approx(1.893, abs=5e-4)
    assert values["least_curvature_radius"] == pytest.approx(0.25, abs=1e-9)
    with pytest.raises(SceneError) as told:
        calculated(*words)
    assert (told.value.key, told.value.code) == ("cam.base_circle_radius", "base_circle_missing_flat")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("case", [c for c in CASES if ".p5.r0." in c["id"]], ids=lambda c: c["id"])
@pytest.mark.parametrize(("offset", "side"), [(3, "helps"), (-3, "hinders")])
def test_lesson_5(case: dict[str, Any], offset: float, side: str) -> None:
    law = LAWS[case["inputs"]["law"]]
    data = calculated("follower=pointed", "lift=30", f"follower_offset={offset}", phases(130, 50, 130, law),
                      "least_transmission_angle_deg=60")  # fmt: skip
    expected, values = case["recomputed"], data["values"]
    assert values["least_prime_circle_radius"] == pytest.approx(expected[f"r0_offset_{side}_mm"], rel=1e-12)
    assert values["initial_height"] == pytest.approx(expected[f"s0_offset_{side}_mm"], rel=1e-12)
    assert values["transmission_angle_reached_deg"] == pytest.approx(60, abs=1e-9)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("offset", [0.0, 6.0, -6.0])
@pytest.mark.parametrize("kind", ["pointed", "roller", "mushroom", "flat"])
def test_the_greatest_radius_of_lesson_4(kind: str, offset: float) -> None:
    """Fig. 4.3: r_max = r_0 + h of a central follower; with an offset the farthest point of the profile tells."""
    size = ("follower_radius=7",) if kind in ("roller", "mushroom") else ()
    data = calculated(f"follower={kind}", "lift=18", f"follower_offset={offset}", *size, "base_circle_radius=55",
                      phases(120, 30, 110, "sine"), "step=0.5")  # fmt: skip
    found, least = (data["values"][f"{word}_radius"] for word in ("greatest_cam", "least_base_circle"))
    assert found == pytest.approx(max(math.hypot(row["x"], row["y"]) for row in data["positions"]), rel=1e-12)
    central = offset == 0 or kind == "flat"
    assert (found == pytest.approx(least + 18, rel=1e-14)) == central
    step = next(s for s in data["steps"] if s["name"] == "greatest_cam_radius")
    assert (step["formula"] == "R_min + H") == central


RETURN_FIRST = """phases=[{move="return_",angle_deg=150,law="sine"},{move="rise",angle_deg=210,law="sine"}]"""


@pytest.mark.parametrize(("motion", "given"), [
    ((RETURN_FIRST, "lift=18"), 55.0), (("motion_table=[[0,5],[120,20],[240,5]]",), 30.0),
])  # fmt: skip
@pytest.mark.parametrize("kind", ["pointed", "flat"])
def test_a_follower_that_does_not_begin_lowest_is_told_its_base_circle_and_the_least_radius(
    kind: str, motion: tuple[str, ...], given: float
) -> None:
    """The circle of S = 0 is what was given; least and greatest radius are those of the profile's points."""
    data = calculated(f"follower={kind}", f"base_circle_radius={given}", *motion, "step=0.5")
    values, far = data["values"], [math.hypot(row["x"], row["y"]) for row in data["positions"]]
    assert "least_base_circle_radius" not in values
    assert values["base_circle_radius"] == pytest.approx(given, rel=1e-14)
    assert values["least_cam_radius"] == pytest.approx(min(far), rel=1e-6)
    assert values["greatest_cam_radius"] == pytest.approx(max(far), rel=1e-6)


def test_a_diagram_of_too_few_intervals_offers_the_fewest_that_raise_the_follower() -> None:
    """A sharp nose under a point: the middles of 8 intervals miss how it slows down; of one less than offered too."""
    keys = ["follower=pointed", "base_circle_radius=40", "lift=20",
            "contour={rise_angle_deg=75.0, nose_radius=5.0}"]  # fmt: skip
    with pytest.raises(SceneError) as found:
        calculate("cam", keys, "json", "en")
    assert (found.value.code, found.value.nearest.side) == ("mid_ordinates_raise_nothing", "exactly")
    fewest = int(found.value.nearest.value)
    assert json.loads(calculate("cam", [*keys, f"intervals={fewest}"], "json", "en"))["graphical"]
    with pytest.raises(SceneError):
        calculate("cam", [*keys, f"intervals={fewest - 1}"], "json", "en")


def rocker_angles(rows: list[dict[str, float]], distance: float, prime: float, sense: int) -> np.ndarray:
    """tan nu = (L (1 + sense psi') - d cos psi) / (d sin psi) of an arm of 80 mm, by the table's S and S'."""
    turn, rate = (np.radians([row[name] for row in rows]) for name in ("S", "S'"))
    psi = math.acos((distance**2 + 80**2 - prime**2) / (160 * distance)) + turn
    return np.degrees(np.arctan((80 * (1 + sense * rate) - distance * np.cos(psi)) / (distance * np.sin(psi))))


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("sense", "distance"), [("against", 100.0), ("with", 86.0), ("with", None)])
def test_the_least_rocker(sense: str, distance: float | None) -> None:
    """Lesson 4, question 13, of a roller: brute force over circles, and over distances where none is given."""
    sign, steep = 1 if sense == "against" else -1, 40.0
    away = [] if distance is None else [f"oscillating.centre_distance={distance}"]
    data = calculated("follower=roller", "follower_radius=5", "swing_deg=20", "oscillating.arm_length=80", *away,
                      f"oscillating.sense={sense}", phases(130, 50, 130, "modified_sine"), "step=0.5",
                      "least_transmission_angle_deg=50")  # fmt: skip
    values, rows = data["values"], data["positions"]
    found, prime = values["centre_distance"], values["least_prime_circle_radius"]
    assert values["least_base_circle_radius"] == pytest.approx(prime - 5, rel=1e-12)

    def keeps(d: float, circle: float, what: list[dict[str, float]] = rows) -> bool:
        return bool(np.abs(rocker_angles(what, d, circle, sign)).max() <= steep + 1e-3)

    assert keeps(found, prime)
    circles = np.arange(abs(found - 80) + 0.05, 80, 0.05)
    assert next(r for r in circles if keeps(found, r)) == pytest.approx(prime, abs=0.06)
    rise = [row for row in rows if row["phi"] <= 130]
    assert next(r for r in circles if keeps(found, r, rise)) == pytest.approx(values["least_rise_radius"], abs=0.06)
    assert max(values["pressure_angle_rise_deg"], values["pressure_angle_return_deg"]) == pytest.approx(steep, abs=1e-6)
    best, smallest = values["best_centre_distance"], values["smallest_prime_circle_radius"]
    assert keeps(best, smallest)
    assert not any(keeps(d, smallest - 0.05) for d in np.arange(81 - smallest, 79 + smallest, 0.05))
    if distance is None:
        assert (found, prime) == (best, pytest.approx(smallest, rel=1e-12))


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("reserve", "mount"), [
    (0.0, ("lift=20", "follower_offset=6")), (9.0, ("lift=20",)), (60.0, ("lift=20",)),
    (0.0, ("swing_deg=20", "oscillating.arm_length=80", "oscillating.centre_distance=90")),
])  # fmt: skip
def test_the_largest_roller_of_a_pitch_curve(reserve: float, mount: tuple[str, ...]) -> None:
    """By circles through three neighbouring points of the pitch curve, which a pointed follower draws."""
    keys = (*mount, phases(110, 40, 100, "sine"), f"least_curvature_radius={reserve}", "step=0.1")
    values = calculated("follower=roller", "follower_radius=3", "base_circle_radius=27", *keys)["values"]
    rows = calculated("follower=pointed", "base_circle_radius=30", *keys)["positions"]
    z = np.array([complex(row["x"], row["y"]) for row in rows])
    before, after = np.diff(z, append=z[0])[:-1], np.diff(z)
    before, after = after[:-1], after[1:]
    # clockwise curves are convex where they turn right
    turn = -np.angle(after / before) / np.abs(z[2:] - z[:-2]) * 2
    pitch = 1 / turn[np.abs(z[2:] - z[:-2]) > 1e-6].max()
    assert values["least_pitch_radius"] == pytest.approx(pitch, rel=2e-3)
    allowed = min(0.8 * pitch, pitch - reserve)
    assert ("largest_roller_radius" in values) == (allowed > 0)
    if allowed > 0:
        assert values["largest_roller_radius"] == pytest.approx(allowed, rel=4e-3)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("case", [c for c in CASES if "table2_2.k" in c["id"]], ids=lambda c: c["id"])
def test_table_2_2(case: dict[str, Any]) -> None:
    data = calculated("guidelines_cam", "step=11.25")
    at = 90 * case["inputs"]["k"]
    # of the two rows at 90 degrees the first is the end of the rise
    row = next(r for r in data["positions"] if r["phi"] == pytest.approx(at))
    expected = case["recomputed"]
    found = [row[k] for k in ("S", "S'", "S''")]
    assert found == pytest.approx([expected[k] for k in ("S_mm", "S1_mm", "S2_mm")], rel=1e-12, abs=1e-12)
    assert data["values"]["least_prime_circle_radius"] == pytest.approx(45.81466903731541, rel=1e-12)


def test_an_impact_has_a_row_for_each_of_its_sides() -> None:
    """S'' jumps at the ends of both moves, as the turn closes too; a plate's and a linkage's tables do the same."""
    rows = calculated("guidelines_cam", "step=30")["positions"]
    sides = [(r["phi"], round(r["S''"], 2)) for r in rows if r["phi"] in (0, 90, 150, 240, 360)]
    assert sides == [
        (0, 77.81), (90, -77.81), (90, 0), (150, 0), (150, -77.81), (240, 77.81), (240, 0), (360, 0),
    ]  # fmt: skip
    assert len(rows) == 12 + 4
    assert not [r for r in calculated("practicum_flat_cam", "step=30")["positions"] if r["phi"] == 360]
    wedge = calculated("kind=wedge_cam", "follower=pointed", "lift=8", "base_height=15", "step=20",
                       'phases=[{move="rise",travel=60,law="constant_acceleration"}]')["positions"]  # fmt: skip
    assert [(r["s"], round(r["S''"], 6)) for r in wedge] == [
        (0, 0.008889), (20, 0.008889), (30, 0.008889), (30, -0.008889), (40, -0.008889), (60, -0.008889),
    ]  # fmt: skip


def test_positions_hold_the_textbooks_contact_point() -> None:
    """Flat face: contact at S' beside the axis and R_b + S above it, turned back by the cam angle."""
    import cmath

    data = calculated("practicum_flat_cam", "step=7")
    base = data["values"]["least_base_circle_radius"]
    assert len(data["positions"]) == 52 + 3
    for row in data["positions"]:
        point = complex(row["S'"], base + row["S"]) * cmath.exp(-1j * math.radians(row["phi"]))
        assert complex(row["x"], row["y"]) == pytest.approx(point, abs=1e-10)
        assert row["rho"] == pytest.approx(base + row["S"] + row["S''"], abs=1e-9)


def test_laws_of_the_scca_family_by_name_and_by_their_shares(capsys: pytest.CaptureFixture[str]) -> None:
    """MSC 50: ramps of 1/16 of the phase, falls of 3/16, half of it at constant velocity."""
    cam = ("follower=roller", "follower_radius=5", "base_circle_radius=40", "lift=20")
    moves = 'phases=[{{move="rise",angle_deg=180,law={0}}},{{move="return_",angle_deg=180,law={0}}}]'
    named = calculated(*cam, moves.format('"modified_sine_cv50"'))
    typed = calculated(*cam, moves.format("{sine_constant_cosine=[0.125,0,0.375]}"))
    assert named["positions"] == typed["positions"]
    assert [named["values"][f"{k}_coefficient"] for k in ("velocity", "acceleration")] \
        == pytest.approx([1.2752581729, 8.0126834148], abs=1e-9)  # fmt: skip
    told = complaint(capsys, "calc", "cam", *cam, moves.format("{sine_constant_cosine=[0.5,0.5,0.5]}"))
    assert "law.sine_constant_cosine" in told
    assert "three shares" in told


def test_a_phase_joins_the_motion_of_its_neighbours(capsys: pytest.CaptureFixture[str]) -> None:
    """VDI 2143, rest to motion: 2 z^3 - z^4 where the velocity at the end is twice the mean one; motion to motion."""
    cam = ("follower=roller", "follower_radius=5", "base_circle_radius=40", "lift=20", "step=1")
    phase = '{{move="{}",angle_deg={},law="{}",share={}}}'.format
    moves = [
        *(phase("rise", 30, law, share) for law, share in JOINED),
        phase("return_", 60, "sine", 0.25),
        phase("return_", 30, "join", 0.1),
        phase("return_", 60, "constant_velocity", 0.45),
        phase("return_", 45, "join", 0.2),
        '{move="dwell",angle_deg=75}',
    ]
    data = calculated(*cam, f"phases=[{','.join(moves)}]")
    rows = {row["phi"]: row for row in data["positions"]}
    assert not [note for note in data["notes"] if "impact" in note]
    assert any("does not begin at rest" in note for note in data["notes"])
    for phi in range(31):
        z = phi / 30
        assert rows[phi]["S"] == pytest.approx(5 * (2 * z**3 - z**4), abs=1e-13)
        assert rows[90 - phi]["S"] == pytest.approx(20 - 5 * (2 * z**3 - z**4), abs=1e-13)
    fast = -9 / math.radians(60)
    assert [rows[180][k] for k in ("S", "S'", "S''")] == pytest.approx([13, fast, 0], abs=1e-12)
    assert rows[285]["S"] == pytest.approx(0, abs=1e-13)
    # the cam's whole motion by the table alone: S is the sum of its S', by Simpson's rule over two rows
    for phi in range(0, 358, 2):
        mean = (rows[phi]["S'"] + 4 * rows[phi + 1]["S'"] + rows[phi + 2]["S'"]) / 6
        assert rows[phi + 2]["S"] - rows[phi]["S"] == pytest.approx(mean * math.radians(2), abs=2e-6)
    wedge = ("kind=wedge_cam", "follower=roller", "follower_radius=2", "lift=8", "base_height=15", "step=10")
    way = '{{move="rise",travel={},law="{}",share={}}}'.format
    data = calculated(*wedge, f"phases=[{','.join(way(20, law, share) for law, share in JOINED)}]")
    assert [row["S"] for row in data["positions"]] == pytest.approx([0, 0.375, 2, 4, 6, 7.625, 8], abs=1e-13)
    beside = [phase("rise", 90, "join", 0.5), phase("rise", 90, "join", 0.5), phase("return_", 180, "sine", 1)]
    told = complaint(capsys, "calc", "cam", *cam, f"phases=[{','.join(beside)}]")
    assert 'phases[1].law = "join"' in told
    assert "joins too" in told


def test_both_languages_hold_the_table() -> None:
    for form in ("text", "md", "html"):
        assert "Положення" in calculate("cam", ["guidelines_cam"], form, None)
        assert "Positions" in calculate("cam", ["guidelines_cam"], form, "en")
    text = calculate("cam", ["guidelines_cam"], "text", "uk")
    assert "м'який удар за кута повороту 90°" in text
    assert "лінійно спадне прискорення" in text
    assert "φ<sub>д.в.</sub>" in calculate("cam", ["guidelines_cam"], "html", "uk")


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("follower=flat", "lift=3"), "phases"),
        (("practicum_flat_cam", "step=0"), "step"),
        (("practicum_flat_cam", "part=cams"), "did you mean cam"),
        (("practicum_pair",), "has no cam"),
        (("practicum_roller_cam", "follower_radius=80"), "works"),
        (("practicum_flat_cam", "lft=3"), "did you mean lift"),
    ],
)
def test_wrong_input_gets_one_clear_line(
    arguments: tuple[str, ...], expected: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert expected in complaint(capsys, "calc", "cam", *arguments)


def test_the_graphical_method_stands_beside_the_exact_motion() -> None:
    """Table 2.2 by drawing: a straight S'' gives S' exactly, the scales by (4.2) are 128/129 of the true ones."""
    data = calculated("guidelines_cam")
    values, rows = data["values"], data["graphical"]
    assert values["graphical_factor"] == pytest.approx(128 / 129, rel=1e-13)
    assert values["graphical_prime_circle_radius"] == pytest.approx(
        (45.81466903731541 + 32) * 128 / 129 - 32, rel=1e-12
    )
    error = values["graphical_prime_circle_radius"] - values["least_prime_circle_radius"]
    assert values["graphical_radius_error"] == pytest.approx(error, rel=1e-12)
    for case in (c for c in CASES if "table2_2.k" in c["id"]):
        row = rows[round(8 * case["inputs"]["k"])]
        assert row["phi"] == pytest.approx(90 * case["inputs"]["k"])
        assert row["S"] == pytest.approx(case["recomputed"]["S_mm"], abs=1e-9)
        assert row["S'"] == pytest.approx(case["recomputed"]["S1_mm"], abs=1e-9)
        assert row["S'g"] == pytest.approx(case["recomputed"]["S1_mm"] * 128 / 129, abs=1e-9)
    assert values["graphical_lift_error"] == pytest.approx(max(abs(r["Sg"] - r["S"]) for r in rows), rel=1e-12)
    finer = calculated("guidelines_cam", "intervals=16")
    assert len(finer["graphical"]) == 34
    assert 3.8 < values["graphical_velocity_error"] / finer["values"]["graphical_velocity_error"] < 4.2
    assert calculated("guidelines_cam", "drawing=chords")["values"]["graphical_factor"] == pytest.approx(64 / 63)
    for language, words in (("uk", "Графічний метод"), ("en", "Graphical method")):
        text = calculate("cam", ["guidelines_cam"], "text", language)
        assert words in text
    assert "практикум, заняття 4, 3.1, рис. 4.5" in calculate("cam", ["guidelines_cam"], "text", "uk")


def test_a_law_with_a_rigid_impact_has_no_graphical_method() -> None:
    data = calculated("follower=pointed", "lift=10", phases(120, 30, 120, "constant_velocity"), "base_circle_radius=60")
    assert "graphical" not in data
    assert any("does not begin at rest, or its velocity jumps" in note for note in data["notes"])


def test_speeds_are_those_of_the_sine_law() -> None:
    """H = 38 in T = phi / omega: v = 2 H / T, a = 2 pi H / T^2 (cycloidal motion)."""
    import math

    values = calculated("practicum_flat_cam", "speed_rpm=300")["values"]
    time = 60 / 300 * 120 / 360
    assert values["angular_speed"] == pytest.approx(10 * math.pi)
    assert values["time_of_phase"] == pytest.approx(time)
    assert values["greatest_velocity"] == pytest.approx(2 * 38 / time)
    assert values["greatest_acceleration"] == pytest.approx(2 * math.pi * 38e-3 / time**2)
    assert "angular_speed" not in calculated("practicum_flat_cam")["values"]
    assert "об/хв" in calculate("cam", ["practicum_flat_cam", "speed_rpm=300"], "text", "uk")


def test_misprints_of_table_2_2_are_told_where_its_rise_is() -> None:
    """The values printed and right are those of the published set; of other rises nothing is said."""
    page = calculate("cam", ["guidelines_cam"], "text", "en")
    table = {c["id"].removeprefix("003.table2_2.k"): c for c in CASES if ".table2_2." in c["id"]}
    wrong = [("2_8", "S_mm", "5.000"), ("5_8", "S_plus_S2_mm", "2.42"), ("7_8", "S_plus_S2_mm", "-27.74")]
    for place, quantity, right in wrong:
        assert float(right) == pytest.approx(table[place]["recomputed"][quantity], abs=0.006)
        printed = f"{table[place]['printed'][quantity]:g}"
        assert f"= {printed} at k = {place[0]}/8 of the rise: right is {right}".replace("-", MINUS) in page
    assert "table 2.2" not in calculate("cam", ["practicum_flat_cam"], "text", "en")


def test_printed_rows_are_the_numbers_of_json() -> None:
    """To four decimals, what is infinite as such: the radius of a straight stretch and of no curvature."""
    words = ["follower=pointed", "lift=8", "kind=wedge_cam", "base_height=15", "step=20",
             'phases=[{move="rise",travel=40,law="constant_velocity"},{move="dwell",travel=20}]']  # fmt: skip
    rows = json.loads(calculate("cam", words, "json", "en"))["positions"]
    text = calculate("cam", words, "md", "en").partition("## Positions")[2]
    printed = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| ")][2:]
    assert len(printed) >= len(rows) > 2
    seen = set()
    for row, cells in zip(rows, printed, strict=False):
        for value, cell in zip(row.values(), cells, strict=False):
            seen.add(cell if value is None else "number")
            assert cell in ("∞", "-∞") if value is None else abs(float(cell) - value) <= 5.1e-5
    assert {"∞", "number"} <= seen


@pytest.mark.sampled(1)
@pytest.mark.parametrize(
    ("angles", "jerks"), [((180.0, 180.0, 0.0), 2), ((170.0, 190.0, 0.0), 0), ((120.0, 120.0, 120.0), 0)]
)
def test_a_cosine_law_has_a_jerk_where_both_of_its_phases_meet_without_a_dwell(
    angles: tuple[float, float, float], jerks: int
) -> None:
    """S'' = +-h/2 (pi/phi)^2 at both ends: one of both sides where the angles are equal, and C_j = pi^3 / 2."""
    moves = [("rise", angles[0]), ("return_", angles[1])]
    phases = [f'{{move="{move}",angle_deg={angle},law="cosine"}}' for move, angle in moves]
    phases += [f'{{move="dwell",angle_deg={angles[2]}}}'] if angles[2] else []
    words = ["kind=cam", "follower=pointed", "lift=20", "base_circle_radius=40", f"phases=[{','.join(phases)}]"]
    found = re.findall(r"C_j = (\S+)", calculate("cam", words, "text", "en"))
    assert found == [f"{math.pi**3 / 2:.6f}" if jerks else "∞"] * 2


@pytest.mark.parametrize(("law", "jerk"), [("polynomial_4567", "52.5"), ("polynomial_345", "60")])
def test_a_jump_is_that_of_the_law_which_has_it(law: str, jerk: str) -> None:
    """A law that ends at rest keeps the C_j of VDI 2143 beside one that does not."""
    phases = f'{{move="rise",angle_deg=160,law="{law}"}},{{move="return_",angle_deg=200,law="cosine"}}'
    words = ["kind=cam", "follower=pointed", "lift=20", "base_circle_radius=40", f"phases=[{phases}]"]
    assert re.findall(r"C_j = (\S+)", calculate("cam", words, "text", "en")) == [jerk, "∞"]


@pytest.mark.sampled(1)
@pytest.mark.parametrize("sense", ["against", "with"])
def test_the_page_of_a_swinging_follower_tells_pivot_and_arm(sense: str) -> None:
    """The roller's centre, pivot and axis make a triangle: (R + r)^2 = d^2 + L^2 - 2 d L cos psi_0."""
    swing = f'oscillating={{centre_distance=90, arm_length=70, sense="{sense}"}}'
    data = calculated("follower=roller", "follower_radius=8", "base_circle_radius=32", "swing_deg=20", swing,
                      phases(100, 50, 140, "sine"))  # fmt: skip
    first = [step["name"] for step in data["steps"] if step["section"] == "Characteristics"]
    assert {"swing_deg", "centre_distance", "arm_length", "follower_radius"} <= {*first}
    values = data["values"]
    d, arm, start = values["centre_distance"], values["arm_length"], math.radians(values["start_angle_deg"])
    assert (d, arm) == (90, 70)
    assert d**2 + arm**2 - 2 * d * arm * math.cos(start) == pytest.approx((32 + 8) ** 2, rel=1e-12)
    flat = calculated("follower=flat", "base_circle_radius=40", "swing_deg=8", phases(100, 50, 140, "sine"),
                      f'oscillating={{centre_distance=120, face_offset=-5, sense="{sense}"}}')["values"]  # fmt: skip
    # the face stands R from the axis and f from the pivot's parallel
    assert 120 * math.sin(math.radians(flat["start_angle_deg"])) == pytest.approx(40 + flat["face_offset"], rel=1e-12)
    assert flat["face_offset"] == -5
    assert "arm_length" not in flat


def test_a_pivot_that_is_found_is_a_result_and_one_that_is_given_is_not() -> None:
    words = ["follower=roller", "follower_radius=8", "swing_deg=20", "least_transmission_angle_deg=50",
             phases(100, 50, 140, "sine")]  # fmt: skip
    for place, more in (("Sizes", ""), ("Characteristics", "centre_distance=90, ")):
        steps = calculated(*words, f"oscillating={{{more}arm_length=70}}")["steps"]
        assert [step["section"] for step in steps if step["name"] == "centre_distance"] == [place]


def test_a_radius_is_called_by_what_has_it() -> None:
    for follower, name in (("roller", "radius of the roller"), ("mushroom", "radius of the mushroom's face")):
        words = (f"follower={follower}", "follower_radius=8", "base_circle_radius=40", "lift=10")
        steps = calculated(*words, phases(120, 30, 120, "sine"))["steps"]
        assert [step["text"] for step in steps if step["name"] == "follower_radius"] == [name]


# what other books call a law, and its s at a quarter of the phase by their formulas
OF_OTHER_BOOKS = {
    "simple harmonic": (1 - math.cos(math.pi / 4)) / 2,
    "Cycloidal": 0.25 - math.sin(math.pi / 2) / (2 * math.pi),
    "inclined_sine": 0.25 - math.sin(math.pi / 2) / (2 * math.pi),
    "parabolic": 2 * 0.25**2,
    "cubic": 3 * 0.25**2 - 2 * 0.25**3,
    "3-4-5": 10 * 0.25**3 - 15 * 0.25**4 + 6 * 0.25**5,
    "4-5-6-7": 35 * 0.25**4 - 84 * 0.25**5 + 70 * 0.25**6 - 20 * 0.25**7,
    "uniform": 0.25,
}


@pytest.mark.parametrize("name", OF_OTHER_BOOKS)
def test_laws_by_the_names_of_other_books_are_offered_ours(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    line = complaint(capsys, "calc", "cam", "follower=pointed", "lift=1", phases(120, 30, 120, name))
    offered = line.rpartition("did you mean ")[2].rstrip("?\n")
    rows = calculated("follower=pointed", "lift=1", "base_circle_radius=40", phases(120, 30, 120, offered))["positions"]
    assert next(row["S"] for row in rows if row["phi"] == 30) == pytest.approx(OF_OTHER_BOOKS[name], abs=1e-14)


def test_scales_of_a_drawing_give_the_motion_that_was_drawn() -> None:
    # constant acceleration drawn by hand: y'' 20 over half of L 120, y' = y'' x / H_2, y = integral of y' / H_1
    first, second, high = 45.0, 30.0, 20.0
    rate, lift = high * 60 / second, high * 60**2 / (first * second)
    data = calculated("follower=flat", "lift=38", "follower_offset=2", phases(120, 30, 120, "constant_acceleration"),
                      "base_circle_radius=60", "drawn.length=120", f"drawn.greatest_ordinate={lift!r}",
                      f"drawn.pole_1={first}", f"drawn.pole_2={second}", "drawn.axis=50")  # fmt: skip
    values, turn = data["values"], math.radians(120)
    assert values["angle_scale"] == pytest.approx(turn / 120, rel=1e-15)
    assert values["rate_scale"] * rate == pytest.approx(2 * 38 / turn, rel=1e-14)
    assert values["bend_scale"] * high == pytest.approx(4 * 38 / turn**2, rel=1e-14)
    assert values["joint_factor"] == pytest.approx(values["bend_scale"] * lift / 38, rel=1e-14)
    assert (values["drawn_offset"], values["drawn_radius"]) == pytest.approx((2 * lift / 38, 50 * 38 / lift), rel=1e-14)
    assert values["working_angle_deg"] == 270


def test_misprints_of_lessons_4_and_5_are_told_of_their_own_cams_alone() -> None:
    for scene, told in (("practicum_flat_cam", "γ_min = 45°"), ("practicum_roller_cam", "R_min = r_0 - r")):
        notes = calculated(scene)["notes"]
        assert sum(told in note for note in notes) == 1
        assert sum("s_B stands behind the root" in note for note in notes) == 1
        assert not any("practicum" in note for note in calculated(scene, "lift=37")["notes"])

"""``calc power-table`` and ``power-module``: every case of the thesis on the power module, its misprints flagged."""

from __future__ import annotations

import csv
import io
import itertools
import json
import math
import re
from functools import cache
from pathlib import Path
from typing import Any

import ezdxf
import mpmath
import numpy as np
import pytest

from exporters.command.cli import main
from exporters.documents.topics import calculate
from geometry.base import hertz
from geometry.base.record import replace
from geometry.kinematics.two_disk import TwoDisk
from parts.base.refusal import SceneError, sentence
from parts.base.texts import words
from parts.pages.misprints import printed_for_delta
from tests.exporters.documents.test_calc import evaluated, sheet_for

ROWS = json.loads((Path(__file__).parents[2] / "published" / "power_module.json").read_text(encoding="utf-8"))["cases"]
CASES = {case["id"].removeprefix("004."): case for case in ROWS}
TABLE_HEADS = ["x (mm)", "y (mm)", "δ (deg)", "β (deg)", "θ (deg)", "n_I", "n_II", "φ_6 (deg)"]


@cache
def _told(topic: str, *keys: str) -> str:
    return calculate(topic, keys, "json", "en")


def calculated(topic: str, *keys: str) -> dict[str, Any]:
    return json.loads(_told(topic, *keys))


def rows(*keys: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(calculate("power-table", keys, "csv", "en"))))


def step(data: dict[str, Any], name: str, drive: str = "") -> dict[str, Any]:
    return next(s for s in data["steps"] if s["name"] == name and s["text"].endswith(drive))


@pytest.mark.parametrize("case", [c for key, c in CASES.items() if key.startswith("ik.point")], ids=lambda c: c["id"])
def test_points_of_the_thesis_and_where_its_formula_is_wrong(case: dict[str, Any]) -> None:
    given, right = case["inputs"], case["recomputed"]
    keys = (f"x={given['x_mm']}", f"y={given['y_mm']}", f"arms=[{given['L1_mm']},{given['L2_mm']}]")
    data = calculated("power-table", *keys)
    delta = step(data, "delta_deg")
    assert step(data, "beta_deg")["value"] == pytest.approx(right["beta_deg"], abs=1e-9)
    assert step(data, "angle_at_o1_deg")["value"] == pytest.approx(right["angle_at_O1_deg"], abs=1e-9)
    assert math.remainder(delta["value"] - right["delta_deg"], 360) == pytest.approx(0, abs=1e-9)
    printed = right["delta_printed_formula_deg"]
    wrong = printed is None or abs(math.remainder(printed - right["delta_deg"], 360)) > 1e-6
    assert ("misprint" in delta) == wrong
    if wrong and printed is not None:
        assert f"{printed:.4f}°" in delta["misprint"]


def test_a_row_for_each_elbow_with_worms_and_the_platforms_turn() -> None:
    found = rows("x=[50,60]", "y=[80,-20]", "orientation=thesis")
    assert list(found[0]) == ["elbow", *TABLE_HEADS, "γ (deg)", "Δβ' (deg)"]
    assert [float(row["elbow"]) for row in found] == [1, 1, -1, -1]
    for row in found:
        delta, beta = float(row["δ (deg)"]), float(row["β (deg)"])
        assert float(row["n_I"]) == pytest.approx(128 * delta / 360)
        assert float(row["n_II"]) == pytest.approx(106 * (delta - beta * 96 / 144) / 360)
        assert float(row["φ_6 (deg)"]) == pytest.approx(2 * beta)
    # the move: gamma by the coupling, what is left for the ring's own drive
    one, two = found[:2]
    moved = [float(two[key]) - float(one[key]) for key in ("δ (deg)", "β (deg)")]
    assert float(two["γ (deg)"]) == pytest.approx(1.5 * moved[0])
    assert float(two["Δβ' (deg)"]) == pytest.approx(moved[1] - 1.5 * moved[0])
    assert [float(r["φ_6 (deg)"]) for r in rows("x=50", "y=80")] == [0, 0]


def test_what_is_refused() -> None:
    for keys, told in (
        (("x=100", "y=120"), "x = 100"),
        (("x=50",), "y: is missing"),
        (("x=[1,2]", "y=1"), "as many values as x"),
        (("x=50", "y=80", "elbow=-1"), "elbow = -1: needs path too"),
        (("x=50", "y=80", "tolerance=0.5"), "tolerance = 0.5: needs path too"),
        (("x=50", "y=80", "orientation_teeth=[35,36]"), 'is for orientation = "thesis" only'),
        (("path=[[0,0,9,9,0]]", "y=80"), "y = 80.0: is given together with path"),
        (("path=nothing.dxf",), "no such file"),
        (("path=[[0,0,0,0,1]]",), "begins where it ends"),
        (("x=1", "y=1", "pair_teeth=[96,96]"), "a ring has more teeth"),
        (("path=[[0,0,50,0,0],[51,0,60,0,0]]",), "where no piece before it ends"),
    ):
        with pytest.raises(SceneError) as refused:
            calculate("power-table", keys, "text", "en")
        text = sentence(refused.value, "en")
        if told == "x = 100":
            told, nearest = "156.205 mm from O1", 144 * complex(100, 120) / abs(complex(100, 120))
            offered = complex(*map(float, re.findall(r"[xy]=([\d.]+)", text)))
            assert abs(offered - nearest) < 2e-6
            assert abs(offered) <= 144
        assert told in text, text


def test_a_path_of_a_dxf(tmp_path: Path) -> None:
    drawing = ezdxf.new()
    space = drawing.modelspace()
    space.add_line((-40, -40), (40, -40))
    space.add_lwpolyline([(40, 40, 0), (-40, 40, 0.3), (-40, -40, 0)], format="xyb")
    space.add_arc((40, 0), 40, -90, 90)
    file = tmp_path / "path.dxf"
    drawing.saveas(file)
    found = rows(f"path={file}", "tolerance=0.005")
    assert list(found[0]) == ["s (mm)", *TABLE_HEADS]
    bulged = 4 * math.atan(0.3)
    length = 80 + 40 * math.pi + 80 + bulged * 40 / math.sin(bulged / 2)
    assert float(found[-1]["s (mm)"]) == pytest.approx(length)
    ends = [complex(float(row["x (mm)"]), float(row["y (mm)"])) for row in (found[0], found[-1])]
    assert abs(ends[0] - (-40 - 40j)) + abs(ends[1] - (-40 - 40j)) < 1e-9
    assert calculated("power-table", f"path={file}", "tolerance=0.005")["values"]["path_error"] <= 0.005
    for entity, told in (("POINT", "has a POINT"), ("LINE", "is not one path")):
        spoiled = ezdxf.readfile(file)
        more = spoiled.modelspace()
        more.add_point((0, 0)) if entity == "POINT" else more.add_line((90, 0), (95, 0))
        spoiled.saveas(tmp_path / "spoiled.dxf")
        with pytest.raises(SceneError) as refused:
            calculate("power-table", (f"path={tmp_path / 'spoiled.dxf'}",), "text", "en")
        assert told in sentence(refused.value, "en")


def test_the_scheme_of_a_point_and_of_a_path(tmp_path: Path) -> None:
    """O2 and O3 of both elbows where the angles put them; the path as long as it is drawn."""
    shown = {}
    for name, keys in (("point", ("x=50", "y=80")), ("path", ("path=[[-50,0,50,0,1],[50,0,60,20,0]]",))):
        file = tmp_path / f"{name}.svg"
        calculate("power-table", (*keys, f"picture={file}"), "text", "uk")
        text = file.read_text(encoding="utf-8")
        lines = re.findall(r'<polyline points="([^"]+)" style="fill:none;stroke:(#\w+);stroke-width:[23]"', text)
        scale, middle = 280 / (216 * 1.03), 310
        shown[name] = [
            [complex(float(x) - middle, middle - float(y)) / scale for x, y in (p.split(",") for p in points.split())]
            for points, _ in lines
        ]
    assert len(shown["point"]) == 2
    for first, second, third in shown["point"]:
        assert abs(first) + abs(third - (50 + 80j)) < 0.05
        assert abs(second) == pytest.approx(72, abs=0.02)
        assert abs(third - second) == pytest.approx(72, abs=0.02)
    drawn = shown["path"][0]
    length = sum(abs(b - a) for a, b in itertools.pairwise(drawn))
    assert length == pytest.approx(50 * math.pi + abs(10 + 20j), abs=0.1)


@pytest.fixture(scope="module")
def module() -> dict[str, Any]:
    return calculated("power-module")


# page and step that show a number of a case: which of several steps, how many times it, and what its formula has there
# in place of the page's own, where the thesis has rounded or tried another value
MODULE, OPPOSED = "power-module", "power-module loaded_turns=1"
PAIR = (
    "gear-pair kind=internal_gear_pair module=3 first.number_of_teeth=96 second.number_of_teeth=144 "
    "basic_rack.tip_clearance_coefficient=0.2 second.tip_diameter=427.2 second.cutter.number_of_teeth=34 "
    "second.cutter.addendum_coefficient=1.2"
)
Shown = tuple[str, str, str, str, str | int, float, dict[str, float]]
OF_WORMS: tuple[tuple[str, str, str, dict[str, float]], ...] = (
    ("T2", "T2_Nm", "wheel_torque", {}),
    ("module", "m_mm", "thesis_least_module", {}),
    ("module", "m_without_cos_gamma_mm", "thesis_least_module", {"gamma": 0.0}),
    ("sigma_FP2", "sigma_FP2_MPa", "allowed_bending_stress", {}),
    ("sigma_FP2", "sigma_HP2_MPa", "allowed_contact_stress", {}),
    ("sigma_H", "sigma_H_MPa", "thesis_contact_stress", {}),
    ("sigma_H", "sigma_H_full_width_MPa", "contact_stress", {"psi": 1.0}),
    ("sigma_H", "sigma_H_half_width_sqrt2_MPa", "contact_stress", {"psi": 0.5}),
    ("sigma_H", "sigma_H_width_26_of_45_MPa", "contact_stress", {}),
    ("base", "gamma_b_deg", "base_lead_angle_deg", {}),
    ("base", "d_b_mm", "worm_base_diameter", {}),
    *(("geometry", key, name, {}) for key, name in (
        ("a_w_mm", "worm_centre_distance"), ("d1_mm", "worm_reference_diameter"), ("d_w1_mm", "worm_pitch_diameter"),
        ("d2_mm", "wheel_reference_diameter"), ("gamma_deg", "lead_angle_deg"), ("h1_mm", "thread_height"),
        ("gamma_w_deg", "pitch_lead_angle_deg"), ("h_a1_mm", "thread_addendum"), ("d_a1_mm", "worm_tip_diameter"),
        ("d_a2_mm", "throat_diameter"), ("d_ae2_mm", "most_outer_diameter"), ("rho_f1_mm", "worm_fillet_radius"),
        ("b1_min_mm", "least_worm_length"), ("b1_plus_25_mm", "ground_worm_length"), ("b2_max_mm", "most_face_width"),
    )),
)  # fmt: skip
ANGLE, TURN, TORQUE = {"alpha_b": 11.717434703203375}, {"C": 1057958.1660654577}, {"T_11": 247.0}
SHOWN: tuple[Shown, ...] = (
    *((f"worm{drive}.{case}", key, MODULE, name, f"drive {drive}", 1.0, put)
      for drive in ("I", "II") for case, key, name, put in OF_WORMS),
    ("gear.sigma_FP1", "sigma_FP1_MPa", MODULE, "pair_allowed_bending", "", 1, {}),
    ("gear.module", "m_mm", MODULE, "pair_least_module", "", 1, TORQUE),
    ("gear.module", "m_with_rounded_inputs_mm", MODULE, "pair_least_module", "", 1,
     {**TORQUE, "u": 1 / 0.667, "sigma_FP1": 263.0}),
    ("gear.module", "m_with_u_1.5_and_Z1_96_mm", MODULE, "pair_least_module", "", 1,
     {**TORQUE, "u": 1 / 1.5, "z_12": 96, "sigma_FP1": 263.0}),
    ("gear.module", "m_with_u_1.5_and_Z1_144_mm", MODULE, "pair_least_module", "", 1,
     {**TORQUE, "u": 1 / 1.5, "sigma_FP1": 263.0}),
    ("gear.T", "T_Nm", MODULE, "pair_torque", "", 1, {}),
    ("gear.F_t", "F_t_N", MODULE, "circumferential_force", "", 1, TORQUE),
    ("gear.sigma_HP", "sigma_HP_MPa", MODULE, "pair_allowed_contact", "", 1, {}),
    ("gear.sigma_H", "sigma_H_MPa", MODULE, "pair_contact_stress", "", 1, {"F_t": 1715.0}),
    ("gear.Z", "Z_H", MODULE, "exact_zone_factor", "", 1, {}),
    # from the rounded 1.87
    ("gear.Z", "Z_eps", MODULE, "exact_overlap_factor", "", 1, {"eps_r": 1.87}),
    ("gear.eps", "eps_alpha", MODULE, "approximate_contact_ratio", "", 1, {}),
    ("gear.eps", "eps_gamma", MODULE, "approximate_contact_ratio", "", 1, {}),
    ("gear.eps", "eps_beta", MODULE, "overlap_ratio", "", 1, {}),
    ("gear.eps", "eps_alpha_exact_from_tip_circles", PAIR, "contact_ratio", "", 1, {}),
    ("gear.geometry", "p_mm", PAIR, "pitch", "", 1, {}),
    ("gear.geometry", "inv_alpha_tw", PAIR, "involute_of_working_pressure_angle", "", 1, {}),
    ("gear.geometry", "a_w_mm", PAIR, "working_centre_distance", "", 1, {}),
    ("gear.geometry", "u", PAIR, "gear_ratio", "", 1, {}),
    *(("gear.geometry", f"{key}{gear}_mm", PAIR, name, gear, 2, {}) for gear in (1, 2) for key, name in (
        ("d", "reference_radius"), ("d_w", "working_radius"), ("d_a", "tip_radius"), ("d_f", "root_radius"),
    )),
    ("gear.geometry", "d_f1_with_c_0.25_mm", "gear-pair thesis_internal_pair", "root_radius", 1, 2, {}),
    ("gear.geometry", "d_f2_with_c_0.25_mm", MODULE, "ring_root_diameter", "", 1, {}),
    ("ball.F_a", "F_a_N", MODULE, "worm_tangential_force", "drive II", 1, {}),
    ("ball.F_H", "F_H_N", MODULE, "preload", "", 1, {}),
    ("ball.F_H", "F_H_with_i2_1_N", OPPOSED, "preload", "", 1, {}),
    ("ball.F_R_gear", "F_TZ_N", MODULE, "circumferential_force", "", 1, TORQUE),
    ("ball.F_R_gear", "F_RZ_N", MODULE, "pair_radial_force", "", 1, {"F_t": 247_000 / 144}),
    ("ball.F_R_worm", "F_TC_N", MODULE, "worm_tangential_force", "drive II", 1, {}),
    ("ball.F_R_worm", "F_RC_N", MODULE, "thesis_worm_radial_force", "", 1, {}),
    ("ball.F_R_worm", "F_t2_of_the_wheel_N", MODULE, "worm_axial_force", "drive II", 1, {}),
    ("ball.F_R_worm", "F_r_from_wheel_force_N", MODULE, "worm_radial_force", "drive II", 1, {"alpha_xw": 20.0}),
    ("ball.F_R", "F_R_N", MODULE, "bearing_radial_force", "", 1, {"F_RZ": 624.0, "F_RC": 51.0}),
    ("ball.F_R", "alpha_deg", MODULE, "contact_angle_deg", "", 1, {"F_R": 675.0}),
    ("ball.C", "C", MODULE, "turn_capacity", "", 1, ANGLE),
    ("ball.C", "C_times_1e-6", MODULE, "turn_capacity", "", 1e-6, ANGLE),
    ("ball.j_a", "j_a_times_1e-4_N_mm", MODULE, "axial_stiffness", "", 1e-4, TURN),
    ("ball.j_a", "j_a_with_i2_1_times_1e-4_N_mm", OPPOSED, "axial_stiffness", "", 1e-4, {**TURN, "F_H": 140 / 1.5}),
    ("ball.k4_argument", "arg", MODULE, "preload_ratio", "", 1, {"F_H": 94.0, "F_R": 675.0, "alpha_b": 11.717}),
    ("ball.j_r", "j_r_with_i2_0_times_1e-4_N_mm", MODULE, "radial_stiffness", "", 1e-4,
     {"j_a": 70_900.0, "alpha_b": 11.717}),
    ("ball.j_r", "j_r_times_1e-4_N_mm", OPPOSED, "radial_stiffness", "", 1e-4,
     {"j_a": 70_900.0, "alpha_b": 11.717}),
    ("ball.ring", "least_pitch_diameter_mm", MODULE, "least_ball_circle", "", 1, {}),
    ("ball.ring", "ring_root_diameter_mm", PAIR, "root_radius", 2, 2, {}),
    ("ball.ring", "wall_between_root_and_groove_mm", MODULE, "ball_wall", "", 1, {"d_f12": 439.2}),
    ("layout.O1O2", "a_w_mm", PAIR, "working_centre_distance", "", 1, {}),
    ("layout.O1O2", "L1_mm", MODULE, "first_arm", "", 1, {}),
    ("layout.L2", "L2_mm", MODULE, "second_arm", "", 1, {}),
    ("layout.ring", "ring_root_radius_mm", PAIR, "root_radius", 2, 1, {}),
    ("layout.ring", "ring_tip_radius_mm", PAIR, "tip_radius", 2, 1, {}),
    ("layout.ring", "clearance_tip_to_root_mm", PAIR, "bottom_clearance_at_root", 2, 1, {}),
    ("layout.ring", "clearance_ring_tip_to_pinion_root_mm", PAIR, "bottom_clearance_at_root", 1, 1, {}),
    ("layout.wheels", "worm_wheel_I_outer_mm", MODULE, "most_outer_diameter", "drive I", 1, {}),
    ("layout.wheels", "worm_wheel_II_outer_mm", MODULE, "most_outer_diameter", "drive II", 1, {}),
    ("layout.wheels", "ring_root_mm", PAIR, "root_radius", 2, 2, {}),
)  # fmt: skip


def shown(page: str, name: str, which: str | int, put: dict[str, float]) -> float:
    """What a page has, or what its own formula gives with other numbers put in."""
    found = next(
        s for s in sheet_for(page).steps()
        if s.name == name and (s.gear == which if isinstance(which, int) else words("en").text(s.of).endswith(which))
    )  # fmt: skip
    assert put.keys() <= found.inputs.keys()
    if not put:
        return float(found.value)
    inputs = {key: replace(known, value=put.get(key, known.value)) for key, known in found.inputs.items()}
    return evaluated(replace(found, inputs=inputs))


@pytest.mark.sampled(8)
@pytest.mark.parametrize("case", sorted({row[0] for row in SHOWN}))
def test_numbers_of_the_thesis_stand_on_a_page(case: str) -> None:
    for _, key, page, name, which, times, put in (row for row in SHOWN if row[0] == case):
        found = shown(page, name, which, put) * times
        assert found == pytest.approx(CASES[case]["recomputed"][key], rel=1e-9, abs=1e-12), (key, name)


def laid_out() -> dict[tuple[str, str], float]:
    """What follows from several numbers of pages, and from the mechanism."""
    table, turn = TwoDisk(), 2 * math.pi
    a, tip, root = (shown(PAIR, name, gear, {}) for name, gear in (
        ("working_centre_distance", 0), ("tip_radius", 1), ("root_radius", 1)))  # fmt: skip
    axes = [shown(MODULE, "worm_centre_distance", f"drive {drive}", {}) for drive in ("I", "II")]
    thread = shown(MODULE, "worm_tip_diameter", "drive I", {}) / 2
    # the page's ratio is what the mechanism does
    assert shown(MODULE, "disk_3_ratio", 0, {}) == pytest.approx(math.tau / abs(table.angles(0.0, 1.0)[1]), rel=1e-12)
    # disk 2 turned once, the ring held
    delta, beta = table.angles(128.0, 0.0)
    (least, most), turned = table.reach, table.platform_turn
    relative = table.angles(1.0, 0.0)
    return {
        ("layout.ring", "pinion_tip_reach_mm"): a + tip, ("layout.ring", "pinion_root_reach_mm"): a + root,
        ("layout.wheels", "difference_of_worm_axes_mm"): axes[0] - axes[1],
        ("layout.wheels", "worm_tip_to_axis_I_mm"): axes[0] - thread,
        ("layout.wheels", "worm_tip_to_axis_II_mm"): axes[1] - thread,
        ("layout.L2", "reach_mm"): most, ("ik.reach", "r_min_mm"): least, ("ik.reach", "r_max_mm"): most,
        ("ik.reach", "stroke_mm"): 2 * most, ("layout.total_ratio", "disk2"): turn / relative[0],
        ("layout.total_ratio", "disk3_relative_to_disk2"): shown(MODULE, "disk_3_ratio", 0, {}),
        ("gamma", "gamma_over_d_delta"): table.ratio,
        # disk 3 turns back by what beta grows
        ("gamma", "rel_rotation_of_disk3_from_pitch_point_velocity"): -beta / delta,
        ("gamma", "abs_rotation_of_disk3"): (delta - beta) / delta,
        ("orientation", "platform_rotation"): turned(1.0), ("orientation", "both_30deg_platform_deg"): turned(0.0),
        ("orientation", "disk2_0_disk3_30deg_platform_deg"): turned(30.0),
        ("orientation", "disk2_30deg_disk3_minus_15deg_platform_deg"): turned(-15.0 - 30.0),
        ("ik.singular_centre", "beta_deg"): float(table.inverse(0j)[1]),
        ("gear.geometry", "tan_alpha_t"): math.tan(math.radians(shown(PAIR, "pressure_angle_deg", 0, {}))),
        **{(f"worm{drive}.geometry", "cos_gamma_b"):
           math.cos(math.radians(shown(MODULE, "base_lead_angle_deg", f"drive {drive}", {}))) for drive in ("I", "II")},
    }  # fmt: skip


def test_what_follows_from_several_numbers() -> None:
    for (case, key), value in laid_out().items():
        assert value == pytest.approx(CASES[case]["recomputed"][key], rel=1e-9, abs=1e-12), (case, key)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("arms", [(72.0, 72.0), (72.0, 50.0), (50.0, 72.0)])
def test_a_grid_over_the_reach_and_where_the_printed_formula_is_wrong(arms: tuple[float, float]) -> None:
    """Below O1, and where O2's angle at O1 is obtuse; the page flags just these."""
    (one, two), table = arms, TwoDisk(arms=arms)
    right = CASES[f"ik.grid.{one:g}_{two:g}"]["recomputed"]
    least, most = table.reach
    line = np.linspace(-most, most, 1201)
    points = (line + 1j * line[:, None]).ravel()
    points = points[(abs(points) > least + 1e-9) & (abs(points) < most - 1e-9)]
    off = table.forward(*table.inverse(points)) - points
    assert abs(off).max() <= right["max_error_of_atan2_form"]
    branch = math.sqrt(max(two**2 - one**2, 0.0))
    assert branch == pytest.approx(right.get("branch_radius_sqrt(L2^2-L1^2)", 0.0))
    wrong = (points.imag < 0) | (abs(points) < branch)
    x, y = points.real, points.imag
    for share, among in (
        ("printed_wrong_share", abs(points) > 0), ("wrong_for_y_above_0", y > 0), ("wrong_for_y_below_0", y < 0),
        ("wrong_for_y_0_x_positive", (y == 0) & (x > 0)), ("wrong_for_y_0_x_negative", (y == 0) & (x < 0)),
    ):  # fmt: skip
        assert wrong[among].mean() == right[share], share
    assert len(points) == right["points"]
    for k in np.random.default_rng(4).choice(len(points), 200):
        flagged = printed_for_delta(complex(points[k]), arms, float(table.inverse(points[k])[0]))
        assert (flagged is not None) == wrong[k], points[k]


def test_no_number_of_a_case_is_left_out() -> None:
    """Points, the grid and the parts list have tests of their own; the survey's sum of two equal forces is no sheet."""
    held = {row[:2] for row in SHOWN} | laid_out().keys()
    others = ("ik.grid.", "ik.point.", "bom.", "force_redistribution")
    left = [
        (case, key) for case, row in CASES.items() if not case.startswith(others)
        for key, value in row["recomputed"].items() if isinstance(value, float | int) and (case, key) not in held
    ]  # fmt: skip
    assert left == []
    assert CASES["bom.count"]["recomputed"] == {"positions": 48.0, "parts": 42.0, "standard_items": 417.0}


def test_misprints_stand_beside_the_right_values_and_only_there(module: dict[str, Any]) -> None:
    marked = {s["name"] for s in module["steps"] if "misprint" in s}
    assert marked == {
        "worm_pitch_diameter", "worm_radial_force", "thesis_least_module", "thesis_contact_stress", "contact_stress",
        "pair_least_module", "pair_allowed_contact", "overlap_ratio", "preload", "thesis_worm_radial_force",
        "turn_capacity", "axial_stiffness", "radial_stiffness",
    }  # fmt: skip
    # of the thesis's own chain, not of what stands beside it
    assert [s["value"] for s in module["steps"] if s["name"] == "preload" and "misprint" in s] == [
        pytest.approx(280 / 3)
    ]
    other = calculated("power-module", "module=4", "worm_module=6")
    assert not [s for s in other["steps"] if "misprint" in s]
    # at another torque the thesis's formulas are still wrong, its numbers are of another load
    lighter = calculated("power-module", "worm_torque=2.2")
    assert {s["name"] for s in lighter["steps"] if "misprint" in s} == {"worm_pitch_diameter", "contact_stress"}


def test_the_load_that_both_worms_hold_anywhere(module: dict[str, Any]) -> None:
    # arm of drive I at the centre: L1 + (u - 1) L2 = 108, of II everywhere u L2 = 108 mm
    assert module["values"]["load"] == pytest.approx(371 / 0.108)
    # by the layer's statics: the second worm carries its 3.5 N m, the pinion the thesis's 247 N m
    assert step(module, "worm_torque_asked", "drive II")["value"] == pytest.approx(3.5, rel=1e-12)
    assert step(module, "worm_torque_asked", "drive I")["value"] == pytest.approx(371 / 128, rel=1e-12)
    assert module["values"]["pinion_torque"] == pytest.approx(371 * 2 / 3, rel=1e-12)
    # friction leaves the load that all of the worms' torque holds; a moment that wheels pass on is asked of them too
    for typed in (("friction_coefficient=0.05",), ("orientation=thesis", "force_x=600", "force_y=0", "moment=40")):
        other = calculated("power-module", *typed)
        efficiency = other["values"].get("worm_efficiency", 1.0)
        for drive, ratio in (("drive I", 128), ("drive II", 106)):
            asked = step(other, "load_torque", drive)["value"] / ratio / efficiency
            assert step(other, "worm_torque_asked", drive)["value"] == pytest.approx(asked, rel=1e-9)
            row = carried(other, "load_worst", drive, "torque on the worm")
            assert row["at most"] == pytest.approx(asked, rel=1e-9)
        pinion = step(other, "load_torque", "drive II")["value"] / 1.5
        assert other["values"]["pinion_torque"] == pytest.approx(pinion, rel=1e-9)
    more = calculated("power-module", "load=5000")
    assert any("do not hold" in note for note in more["notes"])
    assert step(more, "wheel_torque", "drive II")["value"] == pytest.approx(371)


def carried(data: dict[str, Any], table: str, part: str, quantity: str) -> dict[str, float]:
    return next(r for r in data[table] if r["carried by"] == part and r["quantity"].startswith(quantity))


def test_the_most_that_every_bearing_carries(module: dict[str, Any]) -> None:
    # the greatest torque on the pinion, F L2, over its pitch radius 144, by the pressure angle
    load, lean = 371 / 0.108, math.radians(20)
    mesh = load * 72 / 144 / math.cos(lean)
    assert carried(module, "load_worst", "pair 11-12", "force")["at most"] == pytest.approx(mesh, rel=1e-9)
    assert carried(module, "load_worst", "drive II", "torque")["at most"] == pytest.approx(3.5, rel=1e-9)
    inner = carried(module, "load_worst", "disk 3 in disk 2", "force across")
    assert inner["at most"] == pytest.approx(load + mesh, rel=1e-9)
    assert abs(inner["β"]) == pytest.approx(20, abs=1e-4)
    # the mesh and the worm's 1400 N as vectors: the thesis adds up what is radial, 675 N
    worm = 1400 / math.cos(math.atan(math.tan(lean) / math.cos(math.atan(0.1))))
    ring = carried(module, "load_worst", "ring on disk 2", "force across")
    assert ring["at most"] == pytest.approx(mesh + worm, rel=1e-4)
    assert ring["at most"] <= ring["nowhere more than"] <= 1.0011 * ring["at most"]
    assert carried(module, "load_worst", "ring on disk 2", "force along")["at most"] == pytest.approx(140, rel=1e-9)
    # the row's preload must hold its tilting too
    lifted = carried(module, "load_worst", "ring on disk 2", "force and moment that lift")["at most"]
    tilt = carried(module, "load_worst", "ring on disk 2", "tilting")["at most"] * 1000
    assert 2 * tilt / 280 < lifted <= 2 * tilt / 280 + 140
    preloads = [s["value"] for s in module["steps"] if s["name"] == "preload"]
    assert preloads == [pytest.approx(140 / 1.5), pytest.approx(lifted / 1.5)]
    # balls of 8 mm in grooves of 0.52 of them, on a circle of 280 mm about a race; those of disk 3 on a plain bore
    groove = (1 / 4 - 1 / (0.52 * 8), 1 / 4 + 1 / (280 - 4))
    modulus = 206_000 / (2 * (1 - 0.3**2))
    for part, curvatures in (("ring on disk 2", groove), ("disk 3 in disk 2", (1 / 4, 1 / 4))):
        ball, pressed = (carried(module, "load_worst", part, what)["at most"] for what in ("load of one", "pressure"))
        assert pressed == pytest.approx(hertz.pressure(ball, curvatures, modulus), rel=1e-9)


def test_a_load_that_is_told_at_a_place() -> None:
    keys = ("force_x=600", "force_y=-800", "force_z=-500", "moment=40", "x=50", "y=80", "elbow=-1", "load_height=20")
    data = calculated("power-module", *keys)
    assert data["values"]["load"] == pytest.approx(1000)
    for row in data["load_here"]:
        assert (row["x"], row["y"]) == pytest.approx((50, 80))
        assert row["φ_F"] == pytest.approx(math.degrees(math.atan2(-800, 600)))
        assert row["β"] < 0
    # the force's own work: what moves O3 by a turn of the ring, u L2 across O2O3
    here = carried(data, "load_here", "drive II", "torque")
    delta, beta = math.radians(here["δ"]), math.radians(here["β"])
    third = 50 + 80j - 72 * complex(math.sin(delta), math.cos(delta))
    assert abs(third) == pytest.approx(72)
    assert abs(beta) < math.pi
    moment = abs(1.5 * (third.conjugate() * (600 - 800j)).imag) / 1000
    assert here["at most"] == pytest.approx(moment / 106, rel=1e-9)
    cranks = [carried(data, "load_worst", f"crank on the {who}", "force")["at most"] for who in ("body", "platform")]
    assert cranks == [pytest.approx(40_000 / (1.5 * 53), rel=1e-9)] * 2
    # for the thesis's wheels a moment is work of both drives
    other = calculated("power-module", "force_x=600", "force_y=-800", "moment=40", "orientation=thesis")
    assert step(other, "load_torque", "drive II")["value"] == pytest.approx(108 + 2 * 1.5 * 40)
    rubbing = calculated("power-module", "friction_coefficient=0.05")
    share = math.atan(0.05 / math.cos(math.radians(20)))
    worth = 0.1 / math.tan(math.atan(0.1) + share)
    assert rubbing["values"]["load"] == pytest.approx(371 / 0.108 * worth)
    assert carried(rubbing, "load_worst", "drive II", "torque")["at most"] == pytest.approx(3.5)
    assert step(rubbing, "worm_tangential_force", "drive II")["value"] == pytest.approx(140)


def test_loads_that_are_refused_or_too_much() -> None:
    for keys, told in (
        (("load=100", "force_x=3"), "is given together with force_x, force_y"),
        (("x=100",), "y: is missing"),
        (("x=100", "y=120"), "x, y = [100.0, 120.0]: is 156.205 mm from O1"),
        (("elbow=-1",), "elbow = -1: needs x, y too"),
        (("x=50", "y=80", "elbow=2"), "one of 1, -1"),
        (("arms=[70,60]",), "give, 72 mm; [72.0, 60.0] works"),
        (("moment=3", "orientation=idlers"), "is taken up by cranks"),
    ):
        with pytest.raises(SceneError) as refused:
            calculate("power-module", keys, "text", "en")
        assert told in sentence(refused.value, "en")
    notes = calculated("power-module", "load=9000", "ball_pressure_limit=3000")["notes"]
    assert any("pressed" in note for note in notes)
    assert any("do not hold" in note for note in notes)
    page = calculate("power-module", ("force_y=900",), "html", "uk")
    assert all(text in page for text in ("перекидний", "1378,8"))


def test_points_out_of_reach_offer_what_can_be_typed() -> None:
    """Before: a list for the keys ``x, y``, which there are none of."""
    for topic in ("power-table", "power-module"):
        with pytest.raises(SceneError) as refused:
            calculate(topic, ("x=-3000", "y=40"), "text", "en")
        assert refused.value.nearest is not None
        typed = str(refused.value.nearest.value).split()
        assert math.hypot(*(float(word[2:]) for word in typed)) == pytest.approx(144, abs=1e-5)
        assert calculate(topic, typed, "text", "en")
    with pytest.raises(SceneError) as refused:
        calculate("power-table", ("path=[[50,80,160,90,0]]",), "text", "en")
    assert (refused.value.key, refused.value.code) == ("power-table.path", "out_of_reach")


def test_what_is_missing_of_a_place_is_told_in_the_language_asked(capsys: Any) -> None:
    assert main(["calc", "power-module", "force_x=600", "x=50", "--language", "uk"]) != 0
    assert "відсутнє: x та y точки" in capsys.readouterr().err


def test_errors_by_play_over_the_workspace(module: dict[str, Any], tmp_path: Path) -> None:
    errors = module["errors"]
    first, last = errors[0], errors[-1]
    assert (first["r"], last["r"]) == (0, 144)
    assert (last["I"], first["I"]) == pytest.approx((0.005625, 0.016875))
    for row in errors:
        assert (row["II"], row["11-12"]) == pytest.approx((0.0204, 0.025), abs=5e-5)
        assert row["Σ"] <= row["I"] + row["II"] + row["11-12"] + 1e-12
    for name, asked_for in (("errors.svg", ("uk",)), ("turn.svg", ("uk", "orientation=thesis"))):
        file = tmp_path / name
        language, *more = asked_for
        asked = ["calc", "power-module", f"picture={file}", *more, "--language", language, "--out", f"{file}.txt"]
        assert main(asked) == 0
        assert file.read_text(encoding="utf-8").count("<circle") >= 48
    with pytest.raises(SceneError, match="the ending of such a file"):
        calculate("power-module", (f"picture={tmp_path / 'x.dxf'}",), "text", "en")


@pytest.mark.parametrize(("sharp", "flat"), [(0.25, 0.25), (0.27, 0.1), (0.25, 0.0096), (0.3, 0.0005)])
def test_hertz_against_forty_digits(sharp: float, flat: float) -> None:
    """K and E of mpmath, the ratio of the axes by its root finder."""
    modulus = 113_187.0
    with mpmath.workdps(40):

        def parts(k: Any) -> tuple[Any, Any]:
            return mpmath.ellipk(1 - k * k), mpmath.ellipe(1 - k * k)

        def off(k: Any) -> Any:
            first, second = parts(k)
            return (second / k**2 - first) / (first - second) - mpmath.mpf(sharp) / flat

        k = mpmath.mpf(1) if sharp == flat else mpmath.findroot(off, (1e-4, 0.9999), solver="anderson")
        first, second = parts(k)
        half = mpmath.cbrt(3 * k * second / (mpmath.pi * modulus * (sharp + mpmath.mpf(flat))))
        exact = (3 * k * first / (2 * mpmath.pi * modulus * half)) ** mpmath.mpf(-1.5)
    assert hertz.stiffness((flat, sharp), modulus) == pytest.approx(float(exact), rel=1e-9)
    if sharp == flat:
        # a ball of radius R on a plane: 4/3 E* sqrt(R)
        assert hertz.stiffness((flat, sharp), modulus) == pytest.approx(4 / 3 * modulus * math.sqrt(1 / sharp))


def test_sizes_of_the_module_stand_with_their_rules_on_one_page(module: dict[str, Any]) -> None:
    found = {row["size"]: row["value"] for row in module["sizes"] if row["rule"] and row["reason"]}
    # as formulas are printed, not as they are typed for Python
    rules = {row["size"]: row["rule"] for row in module["sizes"]}
    assert rules["r_56"] == "⌊r_root - 10⌋"
    assert rules["r_3"] == "⌈max(r_tip, r_56 + 10 + ball/2 + 4)⌉ + 2"
    assert rules["h_groove"] == "√(r_groove² - (gap_race + r_groove - ball/2)²)"
    assert not any(re.search(r"\*|\b(ceil|floor|sqrt|pi)\b", rule) for rule in rules.values())
    # the thesis's axes, and half the circle on which the list's 2 x 58 balls run
    assert (found["arm"], found["a_1"], found["a_2"], found["r_large"]) == (72.0, 345.0, 290.0, 280.0)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("keys", [(), ("orientation=thesis",), ("module=3.1",)], ids=str)
def test_no_default_stands_beside_what_the_page_finds(keys: tuple[str, ...], module: dict[str, Any]) -> None:
    """The circle of the pivots, the axes of ring and pinion, the balls of the ring's row: as the sizes have them."""
    data = calculated("power-module", *keys) if keys else module
    found = {row["size"]: row["value"] for row in data["sizes"]}
    # the thesis's wheels have none: that of the cranks in their place
    circle = found.get("r_pivots", 53.0)
    assert data["values"]["pivot_circle"] == circle
    play = math.degrees(4 * 0.02 / (circle * math.cos(math.pi / 6)))
    assert step(data, "platform_play_deg", "cranks")["value"] == pytest.approx(play, rel=1e-12)
    assert (data["values"]["first_arm"], data["values"]["second_arm"]) == (found["arm"], found["arm"])
    assert [s["value"] for s in data["steps"] if s["name"] == "balls"] == [180, found["large_balls"]]


def test_limits_of_the_module_stand_beside_them_with_what_is_left(module: dict[str, Any]) -> None:
    left = {(row["driving size"], row["what must be left"]): row["left"] for row in module["limits"] if row["rule"]}
    # 48 teeth more, less one; 2 x 32 balls of 8 on 151.2 mm, with 3 mm between two
    assert left["teeth = 96, 144", "room of the pinion in the ring"] == 47
    assert left["balls = 180", "room between two balls of the small circle"] == pytest.approx(
        math.tau * 151.2 / 32 - 11
    )
    assert min(left.values()) >= 0
    thin = calculated("power-module", "face_width=17")
    missing = [row for row in thin["limits"] if row["left"] < 0]
    assert [row["driving size"] for row in missing] == ["face_width = 17.0"]
    assert any("lacks 1 mm" in note for note in thin["notes"])

"""``calc power-table`` and ``power-module``: every case of the thesis on the power module, its misprints flagged."""

from __future__ import annotations

import csv
import io
import itertools
import json
import math
import re
from pathlib import Path
from typing import Any

import ezdxf
import mpmath
import pytest

from exporters.command.cli import main
from exporters.documents.topics import calculate
from geometry.base import hertz
from parts.base.refusal import SceneError, sentence

ROWS = json.loads((Path(__file__).parents[2] / "published" / "power_module.json").read_text(encoding="utf-8"))["cases"]
CASES = {case["id"].removeprefix("004."): case for case in ROWS}
TABLE_HEADS = ["x (mm)", "y (mm)", "δ (deg)", "β (deg)", "θ (deg)", "n_I", "n_II", "φ_6 (deg)"]


def calculated(topic: str, *keys: str) -> dict[str, Any]:
    return json.loads(calculate(topic, keys, "json", "en"))


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
        (("x=[1,2]", "y=1"), "as many as x has"),
        (("x=50", "y=80", "elbow=-1"), "elbow = -1: needs path too"),
        (("path=[[0,0,9,9,0]]", "y=80"), "y = 80.0: is given beside path"),
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
            assert f"[{nearest.real:.9f}"[:-1] in text
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
    for entity, told in (("POINT", "holds a POINT"), ("LINE", "is not one path")):
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


# name of the step, drive, case, its number, how near (inputs that the thesis has rounded before)
NUMBERS = [
    *(
        (name, f"drive {drive}", f"worm{drive}.{case}", key, 1e-9)
        for drive in ("I", "II")
        for name, case, key in (
            ("wheel_torque", "T2", "T2_Nm"),
            ("thesis_least_module", "module", "m_mm"),
            ("allowed_bending_stress", "sigma_FP2", "sigma_FP2_MPa"),
            ("allowed_contact_stress", "sigma_FP2", "sigma_HP2_MPa"),
            ("thesis_contact_stress", "sigma_H", "sigma_H_MPa"),
            ("contact_stress", "sigma_H", "sigma_H_width_26_of_45_MPa"),
            ("worm_base_diameter", "base", "d_b_mm"),
            ("worm_centre_distance", "geometry", "a_w_mm"),
            ("most_outer_diameter", "geometry", "d_ae2_mm"),
        )
    ),
    ("pair_allowed_bending", "", "gear.sigma_FP1", "sigma_FP1_MPa", 1e-9),
    ("pair_least_module", "", "gear.module", "m_mm", 2e-3),
    ("pair_torque", "", "gear.T", "T_Nm", 1e-9),
    ("circumferential_force", "", "gear.F_t", "F_t_N", 2e-3),
    ("pair_allowed_contact", "", "gear.sigma_HP", "sigma_HP_MPa", 1e-9),
    ("pair_contact_stress", "", "gear.sigma_H", "sigma_H_MPa", 1e-3),
    ("exact_zone_factor", "", "gear.Z", "Z_H", 1e-9),
    ("preload", "", "ball.F_H", "F_H_N", 1e-9),
    ("pair_radial_force", "", "ball.F_R_gear", "F_RZ_N", 2e-3),
    ("thesis_worm_radial_force", "", "ball.F_R_worm", "F_RC_N", 1e-9),
    ("bearing_radial_force", "", "ball.F_R", "F_R_N", 2e-3),
    ("contact_angle_deg", "", "ball.F_R", "alpha_deg", 2e-3),
    ("turn_capacity", "", "ball.C", "C", 5e-3),
    ("least_ball_circle", "", "ball.ring", "least_pitch_diameter_mm", 1e-9),
]


@pytest.fixture(scope="module")
def module() -> dict[str, Any]:
    return calculated("power-module")


@pytest.mark.parametrize(("name", "drive", "case", "key", "near"), NUMBERS)
def test_numbers_of_the_module(module: dict[str, Any], name: str, drive: str, case: str, key: str, near: float) -> None:
    assert step(module, name, drive)["value"] == pytest.approx(CASES[case]["recomputed"][key], rel=near)


def test_stiffness_of_the_ring_with_one_i2_throughout(module: dict[str, Any]) -> None:
    right = CASES["ball.j_a"]["recomputed"]
    assert step(module, "axial_stiffness")["value"] == pytest.approx(right["j_a_times_1e-4_N_mm"] * 1e4, rel=5e-3)
    right = CASES["ball.j_r"]["recomputed"]
    found = step(module, "radial_stiffness")
    assert found["value"] == pytest.approx(right["j_r_with_i2_0_times_1e-4_N_mm"] * 1e4, rel=5e-3)
    assert "5.5e4" in found["misprint"]
    both = calculated("power-module", "loaded_turns=1")
    assert step(both, "preload")["value"] == pytest.approx(46.67, rel=1e-3)
    assert step(both, "axial_stiffness")["value"] == pytest.approx(112142.23, rel=5e-3)
    assert step(both, "radial_stiffness")["value"] == pytest.approx(86895.922, rel=5e-3)


def test_misprints_stand_beside_the_right_values_and_only_there(module: dict[str, Any]) -> None:
    marked = {s["name"] for s in module["steps"] if "misprint" in s}
    assert marked == {
        "worm_pitch_diameter", "worm_radial_force", "thesis_least_module", "thesis_contact_stress", "contact_stress",
        "pair_least_module", "pair_allowed_contact", "preload", "thesis_worm_radial_force", "turn_capacity",
        "radial_stiffness",
    }  # fmt: skip
    other = calculated("power-module", "module=4", "worm_module=6")
    assert not [s for s in other["steps"] if "misprint" in s]


def test_the_load_that_both_worms_hold_anywhere(module: dict[str, Any]) -> None:
    # arm of drive I at the centre: L1 + (u - 1) L2 = 108, of II everywhere u L2 = 108 mm
    assert module["values"]["load"] == pytest.approx(371 / 0.108)
    # by the layer's statics: the second worm carries its 3.5 N m, the pinion the thesis's 247 N m
    assert step(module, "worm_torque_asked", "drive II")["value"] == pytest.approx(3.5, rel=1e-12)
    assert step(module, "worm_torque_asked", "drive I")["value"] == pytest.approx(371 / 128, rel=1e-12)
    assert module["values"]["pinion_torque"] == pytest.approx(371 * 2 / 3, rel=1e-12)
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
        (("load=100", "force_x=3"), "is given beside force_x, force_y"),
        (("x=100",), "y: is missing"),
        (("x=100", "y=120"), "x, y = [100.0, 120.0]: is 156.205 mm from O1"),
        (("elbow=-1",), "elbow = -1: needs x, y too"),
        (("x=50", "y=80", "elbow=2"), "one of 1, -1"),
        (("arms=[70,60]",), "72 mm apart; [72.0, 60.0] works"),
        (("moment=3", "orientation=idlers"), "is carried by cranks"),
    ):
        with pytest.raises(SceneError) as refused:
            calculate("power-module", keys, "text", "en")
        assert told in sentence(refused.value, "en")
    notes = calculated("power-module", "load=9000", "ball_pressure_limit=3000")["notes"]
    assert any("pressed" in note for note in notes)
    assert any("do not hold" in note for note in notes)
    assert all(text in calculate("power-module", ("force_y=900",), "html", "uk") for text in ("перекидний", "1378.8"))


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
    for name, words in (("errors.svg", ("uk",)), ("turn.svg", ("uk", "orientation=thesis"))):
        file = tmp_path / name
        language, *more = words
        asked = ["calc", "power-module", f"picture={file}", *more, "--language", language, "--out", f"{file}.txt"]
        assert main(asked) == 0
        assert file.read_text(encoding="utf-8").count("<circle") >= 48
    with pytest.raises(SceneError, match="pictures end in"):
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
    # the thesis's axes, and half the circle on which the list's 2 x 58 balls run
    assert (found["arm"], found["a_1"], found["a_2"], found["r_large"]) == (72.0, 345.0, 290.0, 280.0)


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

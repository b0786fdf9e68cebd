"""``higherpair calc cam`` of grooves, pairs, yokes, wedges and barrels, held against sweeps by rigid motions alone."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest

from exporters.documents.render import SPOKEN, render
from exporters.documents.topics import calculate, sheet_of
from tests.exporters.command.test_cli import complaint

Rows = list[dict[str, float]]
GROOVE = (
    "kind=groove_cam", "lift=20", "follower_radius=6", "roller_clearance=0.3", "base_circle_radius=30",
    "follower_offset=4", "groove_depth=5",
    'phases=[{move="rise",angle_deg=120,law="sine"},{move="return_",angle_deg=140,law="polynomial_345"},'
    '{move="dwell",angle_deg=100}]',
)  # fmt: skip
SWINGING_BARREL = (
    "kind=barrel_cam", "form=groove", "outer_diameter=90", "roller_diameter=10", "groove_depth=8", "swing_deg=20",
    "oscillating.arm_length=80",
    'phases=[{move="rise",angle_deg=150,law="sine"},{move="return_",angle_deg=210,law="sine"}]',
)  # fmt: skip
SWINGING_WEDGE = (
    "kind=wedge_cam", "follower=roller", "follower_radius=5", "swing_deg=15", "base_height=20",
    "oscillating.arm_length=80", "oscillating.pivot_height=20",
    'phases=[{move="rise",travel=80,law="sine"},{move="return_",travel=60,law="polynomial_345",share=0.5}]',
)  # fmt: skip


def calculated(*words: str) -> dict[str, Any]:
    return json.loads(calculate("cam", words, "json", "en"))


def column(rows: Rows, name: str) -> np.ndarray:
    return np.array([math.inf if row[name] is None else row[name] for row in rows])


def points(rows: Rows, x: str = "x", y: str = "y") -> np.ndarray:
    return column(rows, x) + 1j * column(rows, y)


def circle_radius(a: complex, b: complex, c: complex) -> float:
    """Of the circle through three points, above 0 where they turn left."""
    area = ((b - a).conjugate() * (c - a)).imag / 2
    return abs(b - a) * abs(c - b) * abs(a - c) / (4 * area) if area else math.inf


def radii_by_points(curve: np.ndarray, step: int) -> np.ndarray:
    """Radius of curvature at every ``step``-th point of a fine closed table, by its neighbours."""
    n = len(curve)
    return np.array([circle_radius(curve[k - 1], curve[k], curve[(k + 1) % n]) for k in range(0, n, step)])


def smooth_lift(rows: Rows, angle: np.ndarray, period: float) -> np.ndarray:
    """S between the rows of a table: cubic Hermite pieces through S and S' of a fine table."""
    x, s, rate = (column(rows, k) for k in ("phi", "S", "S'"))
    x = np.radians(x)
    x, s, rate = np.append(x, period), np.append(s, s[0]), np.append(rate, rate[0])
    k = np.clip(np.searchsorted(x, angle, side="right") - 1, 0, len(x) - 2)
    h = x[k + 1] - x[k]
    u = (angle - x[k]) / h
    return (
        (1 + 2 * u) * (1 - u) ** 2 * s[k]
        + u * (1 - u) ** 2 * h * rate[k]
        + u * u * (3 - 2 * u) * s[k + 1]
        + u * u * (u - 1) * h * rate[k + 1]
    )


def test_both_walls_of_a_groove_stand_where_a_swept_roller_touches_them() -> None:
    """Every wall point is as far from the nearest place of the roller's centre as its own radius: turned, no more."""
    data, fine = calculated(*GROOVE, "step=15"), calculated(*GROOVE, "step=0.1")
    drive = np.linspace(0, 2 * math.pi, 36_001)
    height = data["values"]["initial_height"] + smooth_lift(fine["positions"], drive, 2 * math.pi)
    path = (4 + 1j * height) * np.exp(-1j * drive)
    assert height[0] == pytest.approx(math.sqrt(36**2 - 4**2), rel=1e-12)
    for name, radius in (("positions", 6.0), ("positions_outer", 6.3)):
        for at in points(data[name]):
            assert np.abs(path - at).min() == pytest.approx(radius, abs=2e-6), name
    inner, outer = points(data["positions"]), points(data["positions_outer"])
    assert np.abs(outer - inner) == pytest.approx(12.3, abs=1e-9)
    assert np.all(np.abs(outer) > np.abs(inner))
    assert data["values"]["groove_width"] == pytest.approx(12.3)
    assert data["values"]["outer_wall_radius"] == pytest.approx(np.abs(path).max() + 6.3, abs=1e-6)


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("name", "sign"), [("positions", -1), ("positions_outer", 1)])
def test_radii_of_the_walls_are_those_of_circles_through_three_points(name: str, sign: int) -> None:
    """Profiles run clockwise over the cam angle: the inner wall's material lies to their right, the outer's left."""
    fine = calculated(*GROOVE, "step=0.1")[name]
    found, told = radii_by_points(points(fine), 7), column(fine, "rho")[::7]
    smooth = np.abs(np.gradient(column(fine, "rho")))[::7] < 0.02 * np.abs(told)
    assert smooth.sum() > 300
    assert sign * found[smooth] == pytest.approx(told[smooth], rel=5e-3)


def test_the_least_radius_of_a_groove_serves_both_ways() -> None:
    """Brute force: of all bases only those from r_0 on keep the angle on rise and return, by tan nu of the table."""
    data = calculated("groove_cam", "step=0.5")
    rows, base = data["positions"], data["values"]["least_radius_both_ways"]
    rate, lift = column(rows, "S'"), column(rows, "S")
    steepest = np.degrees(np.arctan(np.abs(rate) / (base + lift))).max()
    assert steepest == pytest.approx(30, abs=1e-4)
    steep_return = GROOVE[-1].replace("angle_deg=140", "angle_deg=60").replace("angle_deg=100", "angle_deg=180")
    keys = (*GROOVE[1:3], steep_return, "least_transmission_angle_deg=60")
    one_way = calculated("follower=roller", *keys)["values"]["least_prime_circle_radius"]
    both = calculated("kind=groove_cam", "groove_depth=5", *keys)["values"]["least_radius_both_ways"]
    assert both > 1.2 * one_way


def test_both_disks_of_a_conjugate_pair_touch_the_rollers_of_one_follower() -> None:
    data = calculated("conjugate_cams", "step=5")
    values, first, second = data["values"], data["positions"], data["positions_second"]
    angle = np.radians(column(first, "phi"))
    # the follower by its own sizes: pivot at 90 mm, both arms 78 mm
    start = math.acos((90**2 + 78**2 - 40**2) / (2 * 90 * 78))
    psi = start + np.radians(column(first, "S"))
    one = 90 - 78 * np.exp(-1j * psi)
    two = 90 - 78 * np.exp(-1j * (psi + math.radians(values["roller_angle_deg"])))
    for rows, centre, radius in ((first, one, 8.0), (second, two, 7.0)):
        touch = points(rows) * np.exp(1j * angle)
        assert np.abs(touch - centre) == pytest.approx(radius, abs=1e-9)
    # and no roller reaches into the other places' points
    for rows, centre, radius in ((first, one, 8.0), (second, two, 7.0)):
        seen = centre * np.exp(-1j * angle)
        assert np.abs(points(rows)[:, None] - seen[None, :]).min(axis=1) == pytest.approx(radius, abs=1e-9)
    assert column(second, "S") == pytest.approx(-column(first, "S"), abs=1e-9)
    turned = np.abs(points(second) * np.exp(1j * (angle + 0.01)) - two)
    assert not np.allclose(turned, 7.0, atol=1e-3)


def test_a_yoke_touches_its_cam_from_both_sides_at_every_angle() -> None:
    data = calculated("yoke_cam", "step=3")
    rows, values = data["yoke"], data["values"]
    assert values["breadth"] == pytest.approx(100)
    assert values["breadth_error"] < 1e-12
    assert column(rows, "B") == pytest.approx(100, abs=1e-9)
    profile = points(calculated("yoke_cam", "step=0.1")["positions"])
    for row in rows[::4]:
        turned = profile * np.exp(1j * math.radians(row["phi"]))
        assert turned.imag.max() == pytest.approx(row["y_1"], abs=1e-3)
        assert turned.imag.min() == pytest.approx(row["y_2"], abs=1e-3)
        assert row["y_1"] == pytest.approx(40 + row["S"], abs=1e-9)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("words", [("wedge_cam",), SWINGING_WEDGE], ids=["sliding", "swinging"])
def test_a_wedge_is_touched_by_its_follower_along_the_whole_travel(words: tuple[str, ...]) -> None:
    fine = calculated(*words, "step=0.05")["positions"]
    s, lift = column(fine, "s"), column(fine, "S")
    if words[0] == "wedge_cam":
        radius, path = 6.0, s + 1j * (24 + lift)
    else:
        # the arm's end stands over the follower's starting place at S = 0, its pivot at y = 20 on +x
        radius, start = 5.0, math.asin((25 - 20) / 80)
        path = s + 80 * math.cos(start) + 20j - 80 * np.exp(-1j * (start + np.radians(lift)))
    at = points(fine)
    for k in range(100, len(at), 149):
        assert np.abs(path - at[k]).min() == pytest.approx(radius, abs=1e-6)
    left = np.array([circle_radius(*at[k - 1 : k + 2]) for k in range(101, len(at) - 100, 149)])
    told = column(fine, "rho")[101 : len(at) - 100 : 149]
    curved = np.abs(told) < 400
    assert curved.sum() > 5
    # the profile runs to +x over the material
    assert -left[curved] == pytest.approx(told[curved], rel=0.02)
    assert np.degrees(np.arctan(column(fine, "S'"))) == pytest.approx(column(fine, "nu"), abs=1e-9) or radius == 5.0


@pytest.mark.sampled(1)
@pytest.mark.parametrize("words", [("barrel_cam", "part=barrel"), ("barrel_cam", "part=end"), SWINGING_BARREL],
                         ids=["groove", "end", "swinging"])  # fmt: skip
def test_the_development_of_a_barrel_lies_on_walls_that_the_roller_sweeps(words: tuple[str, ...]) -> None:
    """Roll every point up again: its distance from the moving axis is the roller's radius, and never less."""
    data, fine = calculated(*words, "step=20"), calculated(*words, "step=0.2")
    values, rows = data["values"], fine["positions"]
    radius = (values.get("groove_width") or values["roller_diameter"]) / 2
    drive = np.radians(column(rows, "phi"))
    axis_y, axis_z = column(rows, "y"), column(rows, "z")
    inner = "floor_diameter" if "groove_width" in values else "inner_diameter"
    for name, key in (("development", "outer_diameter"), ("development_floor", inner)):
        cylinder = values[key] / 2
        table = data[name]
        for index in ("_1", "_2") if "x_1" in table[0] else ("",):
            for row in table:
                polar = row[f"x{index}"] / cylinder - math.pi
                # the cam turns back by its angle: the point in the fixed frame
                y = cylinder * np.sin(polar + drive)
                ahead = np.cos(polar + drive) > 0
                gap = np.hypot(y - axis_y, row[f"z{index}"] - axis_z)[ahead]
                assert gap.min() == pytest.approx(radius, abs=3e-4), (name, index, row["phi"])


@pytest.mark.heavy
@pytest.mark.sampled(1)
@pytest.mark.parametrize("words", [("barrel_cam", "part=barrel"), SWINGING_BARREL], ids=["groove", "swinging"])
def test_radii_of_the_development_are_those_of_circles_through_three_points(words: tuple[str, ...]) -> None:
    fine = calculated(*words, "step=0.1")["development"]
    for index, sign in (("_1", -1), ("_2", 1)):
        curve = points(fine, f"x{index}", f"z{index}")
        told = column(fine, f"rho{index}")[5:-5:13]
        found = np.array([circle_radius(*curve[k - 1 : k + 2]) for k in range(5, len(curve) - 5, 13)])
        tame = np.abs(np.gradient(np.minimum(column(fine, f"rho{index}"), 1e6)))[5:-5:13] < 0.01 * np.abs(told)
        curved = (np.abs(told) < 300) & tame
        assert curved.sum() > 30
        assert sign * found[curved] == pytest.approx(told[curved], rel=0.01)


def test_pressure_angles_of_a_barrel_at_the_outside_are_the_textbooks() -> None:
    """tan nu = S' / R, and at the floor the exact one is steeper."""
    values = calculated("barrel_cam", "part=barrel")["values"]
    steep = 2 * 1.7596033 * 18 / 2 / math.radians(140)
    assert values["outer_pressure_angle_rise_deg"] == pytest.approx(math.degrees(math.atan(steep / 35)), rel=1e-6)
    assert values["pressure_angle_rise_deg"] > math.degrees(math.atan(steep / 27))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("words", [("groove_cam",), ("conjugate_cams",), ("yoke_cam",), ("wedge_cam",),
                                   ("barrel_cam", "part=end"), SWINGING_WEDGE, SWINGING_BARREL], ids=str)  # fmt: skip
def test_every_kind_speaks_both_languages_in_every_format(words: tuple[str, ...]) -> None:
    page, _ = sheet_of("cam", words)
    for form in (f for f in SPOKEN if f != "json"):
        assert "Положення" in render(page, form, "uk")
        assert "Positions" in render(page, form, "en")


def test_a_page_of_a_pair_is_chosen_by_itself_and_parts_by_name() -> None:
    assert "positions_second" in calculated("conjugate_cams")
    assert "positions_second" not in calculated("conjugate_cams", "part=first")
    assert "yoke" not in calculated("yoke_cam", "part=cam")


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("barrel_cam",), "several: barrel, end"),
        (("kind=grove_cam",), "did you mean groove_cam"),
        (("kind={}",), "known kinds"),
        (("kind=conjugate_cam",), "of.follower=roller"),
        (("conjugate_cams", "of.lift=3"), "which has swing_deg instead"),
        (("conjugate_cams", "base_circle_radius=3"), "base_circle_radius"),
        (("groove_cam", "roller_clearance=-1"), "roller_clearance"),
        (("groove_cam", "groove_depth=30"), "works"),
        (("wedge_cam", "step=0.001"), "at least"),
        (("wedge_cam", "follower_radius=80"), "works"),
        (("barrel_cam", "part=barrel", "groove_depth=34"), "the roller needs a wider floor"),
        (("cycloidal_reducer",), "has no cam"),
    ],
)
def test_wrong_input_gets_one_clear_line(words: tuple[str, ...], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert told in complaint(capsys, "calc", "cam", *words)


def test_a_stem_on_a_wedge_leans_by_the_slope_of_its_lift() -> None:
    rows = calculated("wedge_cam")["positions"]
    slope = column(rows, "S'")
    assert slope.min() < 0 < slope.max()
    assert column(rows, "nu") == pytest.approx(np.degrees(np.arctan(slope)), abs=1e-9)


def test_an_end_cam_has_a_track_and_no_groove() -> None:
    for language, word in (("en", "groove"), ("uk", "паз")):
        assert word in calculate("cam", ["barrel_cam", "part=barrel"], "text", language).lower()
        assert word not in calculate("cam", ["barrel_cam", "part=end"], "text", language).lower()


@pytest.mark.parametrize("given", [[], ["cone_angle_deg=12"]], ids=["apex on the axis", "given"])
def test_the_cone_of_a_roller_is_told(given: list[str]) -> None:
    """With its apex on the cam's axis a roller of diameter d at the radius R has the angle 2 arctan(d / 2 R)."""
    values = calculated(*SWINGING_BARREL, "roller_form=conical", *given)["values"]
    assert values["cone_angle_deg"] == pytest.approx(12 if given else math.degrees(2 * math.atan(5 / 45)), rel=1e-12)
    assert "cone_angle_deg" not in calculated(*SWINGING_BARREL)["values"]


def test_the_angle_between_both_arms_is_told_on_either_side() -> None:
    """Each arm stands at the angle that the triangle of pivot, axis and roller has, the two on either side of d."""
    values = calculated("conjugate_cams")["values"]

    def from_line_of_centres(arm: float, reach: float) -> float:
        return math.degrees(math.acos((90**2 + arm**2 - reach**2) / (2 * 90 * arm)))

    # the second roller is nearest to the axis where the first is highest
    first, second = from_line_of_centres(78, 32 + 8) + 18, from_line_of_centres(78, 34 + 7)
    assert values["inner_roller_angle_deg"] == pytest.approx(first + second, rel=1e-12)
    assert values["roller_angle_deg"] == pytest.approx(360 - first - second, rel=1e-12)

"""``higherpair calc cam`` of a linkage cam, held against 40-digit poses, sweeps and its own printed formulas."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest

from exporters.documents.render import SPOKEN, render
from exporters.documents.topics import calculate, sheet_of
from geometry.base.record import replace
from geometry.kinematics.linkage import Linkage, RockerDrive, RockerGuide, SliderDrive, SliderGuide
from parts.base.texts import words
from parts.pages.misprints import CASES
from parts.pages.page import Known, Sheet, Step
from tests.exporters.command.test_cli import complaint
from tests.exporters.documents.test_calc import evaluated
from tests.geometry.cams.linkage_oracle import MP, Case, centre, pose

PHASES = (
    'phases=[{move="rise",angle_deg=130,law="sine"},{move="dwell",angle_deg=50},'
    '{move="return_",angle_deg=130,law="polynomial_345"},{move="dwell",angle_deg=50}]'
)
FOUR = (
    "kind=linkage_cam", PHASES, 'driven={member="rocker",pivot=[91,26],length=58,start_angle_deg=167}',
    'guide={member="rocker",pivot=[62,124],length=68}', "coupler_length=43",
)  # fmt: skip
ROLLER = (*FOUR, "follower=roller", "follower_radius=6", "coupler_point=[6,16]", "swing_deg=24")
FLAT = (*FOUR, "follower=flat", "follower_direction_deg=-60", "coupler_point=[2,11]", "swing_deg=12")
MUSHROOM = (*FOUR, "follower=mushroom", "follower_direction_deg=-60", "follower_radius=20", "coupler_point=[6,16]",
            "swing_deg=24")  # fmt: skip
SLIDERS = (
    "kind=linkage_cam", PHASES, "follower=roller", "follower_radius=6", "coupler_length=50", "coupler_point=[6,9]",
    'driven={member="slider",start=[25,30],direction_deg=70}', "lift=15",
    'guide={member="slider",through=[0,50],direction_deg=10}',
)  # fmt: skip
BACKWARD = (
    "kind=linkage_cam", PHASES, "follower=pointed", "coupler_length=60", "coupler_point=[5,12]", "swing_deg=12",
    'driven={member="rocker",pivot=[85,15],length=55,start_angle_deg=160}',
    'guide={member="slider",through=[0,80],direction_deg=10,assembly="backward"}',
)  # fmt: skip
CROSSED = (
    "kind=linkage_cam", PHASES, "follower=pointed", "coupler_length=64", "coupler_point=[26,6]", "swing_deg=12",
    'driven={member="rocker",pivot=[69,1],length=58,start_angle_deg=162}',
    'guide={member="rocker",pivot=[94,44],length=28,assembly="right"}',
)  # fmt: skip
D = math.radians
LINKS = {
    "roller": Case(Linkage(RockerDrive(91 + 26j, 58.0, D(167), -1), 43.0, RockerGuide(62 + 124j, 68.0)), 6 + 16j, 0.0),
    "flat": Case(Linkage(RockerDrive(91 + 26j, 58.0, D(167), -1), 43.0, RockerGuide(62 + 124j, 68.0)), 2 + 11j, D(-60)),
    "mushroom": Case(
        Linkage(RockerDrive(91 + 26j, 58.0, D(167), -1), 43.0, RockerGuide(62 + 124j, 68.0)), 6 + 16j, D(-60)
    ),
    "sliders": Case(Linkage(SliderDrive(25 + 30j, D(70)), 50.0, SliderGuide(50j, D(10))), 6 + 9j, 0.0),
    "backward": Case(Linkage(RockerDrive(85 + 15j, 55.0, D(160), -1), 60.0, SliderGuide(80j, D(10), -1)), 5 + 12j, 0.0),
    "crossed": Case(
        Linkage(RockerDrive(69 + 1j, 58.0, D(162), -1), 64.0, RockerGuide(94 + 44j, 28.0, -1)), 26 + 6j, 0.0
    ),
}
WORDS = {"roller": ROLLER, "flat": FLAT, "mushroom": MUSHROOM, "sliders": SLIDERS, "backward": BACKWARD,
         "crossed": CROSSED}  # fmt: skip
TRAVEL = {"roller": D(24), "flat": D(12), "mushroom": D(24), "sliders": 15.0, "backward": D(12), "crossed": D(12)}
RADIUS = {"roller": 6.0, "mushroom": 20.0, "sliders": 6.0}


@cache
def page_of(name: str, *more: str) -> Sheet:
    return sheet_of("cam", (*WORDS[name], *more))[0]


@cache
def calculated(name: str, *more: str) -> dict[str, Any]:
    return json.loads(calculate("cam", [*WORDS[name], *more], "json", "en"))


def lift(name: str, t: Any) -> Any:
    """S over the cam angle, rad: sine and 3-4-5 laws at 40 digits."""
    rise = MP.radians(130)
    if t < rise:
        u = t / rise
        return TRAVEL[name] * (u - MP.sin(2 * MP.pi * u) / (2 * MP.pi))
    u = (t - MP.radians(180)) / rise
    if u < 0:
        return MP.mpf(TRAVEL[name])
    return TRAVEL[name] * (1 - (10 * u**3 - 15 * u**4 + 6 * u**5)) if u < 1 else MP.mpf(0)


def place(name: str, t: Any) -> Any:
    """Path of the reference point in the cam's frame."""
    return centre(LINKS[name], lift(name, t)) * MP.expj(-t)


def slope(function: Callable[[Any], Any], t: Any, order: int = 1) -> complex:
    return complex(MP.diff(function, t, order, h=MP.mpf("1e-9")))


def angle_between(a: complex, b: complex) -> float:
    """Acute angle of two lines, degrees, signed from b to a."""
    found = math.degrees(np.angle(a / b))
    return found - 180 * round(found / 180)


def whole_turns(degrees: float) -> float:
    """How far an angle is from the nearest whole number of turns."""
    return degrees - 360 * round(degrees / 360)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", WORDS)
@pytest.mark.parametrize("at", ["47", "231"])
def test_a_position_is_that_of_forty_digit_poses(name: str, at: str) -> None:
    """Pose by the law of cosines, its derivatives by differences; the contact by the normal to the path."""
    found, t, case = calculated(name, f"position_deg={at}")["values"], MP.radians(MP.mpf(at)), LINKS[name]
    joint, theta = pose(case.linkage, lift(name, t))
    far = joint + case.linkage.coupler_length * MP.expj(theta)
    for key, point in (("joint_a", joint), ("joint_b", far), ("reference", centre(case, lift(name, t)))):
        assert complex(found[f"{key}_x"], found[f"{key}_y"]) == pytest.approx(complex(point), abs=1e-9)
    assert whole_turns(found["coupler_angle_deg"] - math.degrees(theta)) == pytest.approx(0, abs=1e-9)
    for order, key in ((1, "coupler_velocity"), (2, "coupler_acceleration")):
        turning = slope(lambda x: pose(case.linkage, lift(name, x))[1], t, order).real
        assert found[key] == pytest.approx(turning, abs=1e-8)
    for order in (1, 2):
        rate = slope(lambda x: place(name, x), t, order)
        assert complex(found[f"savvin_a{order}"], found[f"savvin_b{order}"]) == pytest.approx(rate, rel=1e-8)
    guide = case.linkage.guide
    way = complex(far)
    if isinstance(guide, RockerGuide):
        way -= guide.pivot
    else:
        assert isinstance(guide, SliderGuide)
        way = 1j * complex(np.exp(1j * guide.direction))
    mu = abs(angle_between(complex(MP.expj(theta)), way))
    assert found["transmission_angle_deg"] == pytest.approx(mu, abs=1e-9)
    # the contact, carried by the coupler and by the cam
    profile = complex(found["contact_x1"], found["contact_y1"])
    carried = (MP.mpc(profile) * MP.expj(t) - joint) * MP.expj(-theta)

    def material(x: Any) -> Any:
        a, turned = pose(case.linkage, lift(name, x))
        return a + carried * MP.expj(turned)

    velocity, relative = slope(material, t), slope(lambda x: material(x) * MP.expj(-x), t)
    path = slope(lambda x: place(name, x), t)
    normal = 1j * path * complex(MP.expj(t))
    if name == "flat":
        normal = complex(MP.expj(theta + case.direction))
    nu = angle_between(normal, velocity)
    assert found["position_contact_pressure_angle_deg"] == pytest.approx(nu, abs=1e-7)
    assert abs(relative) == pytest.approx(abs(found.get("sliding_velocity", found.get("rolling_velocity"))), rel=1e-8)
    if name in RADIUS:
        assert abs(profile - complex(place(name, t))) == pytest.approx(RADIUS[name], abs=1e-9)
        assert angle_between(profile - complex(place(name, t)), 1j * path) == pytest.approx(0, abs=1e-7)
        at_centre = slope(lambda x: centre(case, lift(name, x)), t)
        assert found["position_pressure_angle_deg"] == pytest.approx(angle_between(normal, at_centre), abs=1e-7)
    elif name != "flat":
        assert profile == pytest.approx(complex(place(name, t)), abs=1e-9)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["roller", "sliders", "mushroom", "crossed"])
def test_no_place_of_the_follower_cuts_into_the_profile(name: str) -> None:
    """The nearest of all places of the circle's centre is the radius away from every point of the table."""
    rows = calculated(name, "step=15")["positions"]
    t = [math.radians(x) for x in np.arange(0, 360, 0.5)]
    path = np.array([complex(place(name, MP.mpf(x))) for x in t])
    for row in rows:
        point = complex(row["x"], row["y"])
        assert np.abs(path - point).min() == pytest.approx(RADIUS.get(name, 0.0), abs=1e-9)
        assert abs(path[round(row["phi"] * 2) % 720] - point) == pytest.approx(RADIUS.get(name, 0.0), abs=1e-9)


@pytest.mark.heavy
def test_every_place_of_a_flat_face_holds_the_profile_on_one_side() -> None:
    case, rows = LINKS["flat"], calculated("flat", "step=15")["positions"]
    heights, normals = [], []
    for x in np.arange(0, 360, 0.25):
        t = MP.radians(MP.mpf(float(x)))
        normal = MP.expj(pose(case.linkage, lift("flat", t))[1] + case.direction - t)
        normals.append(complex(normal))
        heights.append(float((place("flat", t) * MP.conj(normal)).real))
    for row in rows:
        beyond = (complex(row["x"], row["y"]) * np.conj(normals)).real - heights
        assert beyond.max() == pytest.approx(0, abs=1e-9)
        assert beyond[round(row["phi"] * 4) % 1440] == pytest.approx(0, abs=1e-9)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", WORDS)
def test_radii_of_curvature_are_those_of_circles_through_three_points(name: str) -> None:
    for at in (47.0, 231.0):
        near = [calculated(name, f"position_deg={at + d}")["values"] for d in (-0.02, 0.0, 0.02)]
        a, b, c = (complex(v["contact_x1"], v["contact_y1"]) for v in near)
        area = ((b - a).conjugate() * (c - a)).imag / 2
        radius = -abs(b - a) * abs(c - b) * abs(a - c) / (4 * area)
        assert near[1]["position_curvature_radius"] == pytest.approx(radius, rel=1e-5)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", WORDS)
def test_the_linkage_table_holds_the_positions(name: str) -> None:
    data = calculated(name, "step=15", "position_deg=45")
    row, values = data["linkage"][3], data["values"]
    assert row["phi"] == 45
    for column, key in (("x_A", "joint_a_x"), ("y_B", "joint_b_y"), ("x_02", "reference_x"),
                        ("mu", "transmission_angle_deg"), ("nu_c", "position_contact_pressure_angle_deg")):  # fmt: skip
        assert row[column] == pytest.approx(values[key], abs=1e-9)
    assert whole_turns(row["theta"] - values["coupler_angle_deg"]) == pytest.approx(0, abs=1e-9)
    assert max(abs(r["theta"] - s["theta"]) for r, s in zip(data["linkage"], data["linkage"][1:], strict=False)) < 30
    assert min(r["mu"] for r in data["linkage"]) >= values["joint_transmission_angle_deg"] - 1e-9


def spoilt(step: Step, key: str) -> Step:
    known = step.inputs[key]
    return replace(step, inputs={**step.inputs, key: Known(known.symbol, float(known.value) + 1e-2, known.unit)})


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", WORDS)
def test_every_printed_formula_gives_its_value_and_needs_all_of_its_inputs(name: str) -> None:
    steps = [s for s in page_of(name, "position_deg=47").steps() if s.formula]
    assert len(steps) > 35
    for step in steps:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-9, abs=1e-9), (step.name, step.formula)
        for key in step.inputs:
            wrong = evaluated(spoilt(step, key))
            assert wrong != pytest.approx(step.value, rel=1e-9, abs=1e-9), (step.name, key)


def test_savvins_numbers_stand_beside_his_equations_and_misprints_are_told() -> None:
    steps = {s.name: s for s in page_of("roller").steps()}
    sources = {n: s.source for n, s in steps.items() if s.source.startswith("Savvin")}
    told = set(re.findall(r"\((\d+)\)", " ".join(sources.values())))
    assert told >= {str(k) for k in (4, 5, 6, 7, 12, 13, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28)}
    marked = {n for n, s in steps.items() if s.printed}
    assert marked == {"savvin_f", "savvin_r", "contact_x2", "contact_y2", "contact_x1", "normal_angle_deg",
                      "position_contact_pressure_angle_deg"}  # fmt: skip
    flat = {s.source for s in page_of("flat").steps()}
    assert {"Savvin (11)", "Savvin (15)", "Savvin (16)"} <= flat


def test_what_is_printed_is_in_no_language() -> None:
    """Formulas and numbers: what is said of them, which is translated, stands behind."""
    assert not [p.text for case in CASES.values() for p in case.values() if re.search(r"[a-z]{2,} [a-z]{2,}", p.text)]
    steps = {s.name: s for s in page_of("roller").steps()}
    printed = [steps[name].printed for name in ("contact_x2", "contact_y2")]
    assert [p and p.text for p in printed] == ["r·F/√(R² + F²)", "r·R/√(R² + F²)"]


def test_the_printed_21_misses_the_roller() -> None:
    """The negative control of the misprint: with the printed plus the point is no roller's radius from the centre."""
    values = calculated("roller", "position_deg=47")["values"]
    between = math.radians(values["follower_angle_deg"] - 47)
    x, y = values["contact_x2"], values["contact_y2"]
    printed = complex(values["savvin_a"] + x * math.cos(between) + y * math.sin(between), values["contact_y1"])
    assert abs(abs(printed - complex(values["savvin_a"], values["savvin_b"])) - 6) > 0.5


def test_a_follower_at_rest_has_a_pressure_angle_without_a_velocity() -> None:
    steps = {s.name: s for s in page_of("roller", "position_deg=150").steps()}
    assert "velocity_angle_deg" not in steps
    step = steps["position_contact_pressure_angle_deg"]
    assert step.formula == ""
    just = calculated("roller", "position_deg=129.99")["values"]["position_contact_pressure_angle_deg"]
    assert step.value == pytest.approx(just, abs=0.05)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", WORDS)
def test_both_languages_in_every_format(name: str) -> None:
    page = page_of(name, "speed_rpm=60")
    for form in (f for f in SPOKEN if f != "json"):
        uk, en = render(page, form, "uk"), render(page, form, "en")
        assert "Положення" in uk
        assert "кут шатуна" in uk
        assert "Positions" in en
        assert "Linkage: coupler angle" in en
    texts = [*(s.title for s in page.sections), *page.notes, *(t.title for t in page.tables)]
    for english, ukrainian in ((words("en").say(t), words("uk").say(t)) for t in texts):
        assert not re.search("[а-яіїє]{2}", english)
        assert re.search("[а-яіїє]{3}", ukrainian)


def test_the_scene_is_its_own_page_and_changes_by_keys() -> None:
    data = json.loads(calculate("cam", ["linkage_cam"], "json", "en"))
    same = calculated("roller")
    assert data["values"]["swing_deg"] == pytest.approx(24)
    assert data["positions"] == same["positions"]
    assert json.loads(calculate("cam", ["linkage_cam", "swing_deg=20"], "json", "en"))["values"]["swing_deg"] == 20
    longer = json.loads(calculate("cam", ["linkage_cam", "driven.length=59"], "json", "en"))["values"]
    assert (longer["driven_length"], longer["driven_pivot_x"]) == (59.0, 91.0)


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("linkage_cam", "coupler_length=20"), "coupler_length"),
        (("linkage_cam", "follower_radius=60"), "works"),
        (("linkage_cam", "position_deg=400"), "position_deg"),
        (("linkage_cam", "lift=3"), "swing_deg instead"),
        (("linkage_cam", "driven.pivots=[1,2]"), "did you mean pivot"),
        (("kind=linkage_cam",), "follower"),
    ],
)
def test_wrong_input_gets_one_clear_line(words: tuple[str, ...], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert told in complaint(capsys, "calc", "cam", *words)

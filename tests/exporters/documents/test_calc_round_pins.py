"""``higherpair calc`` of cycloidal discs, lanterns and noncircular gears, against rigid motions and mpmath."""

from __future__ import annotations

import json
import math
import random
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from exporters.documents.render import SPOKEN, render
from exporters.documents.topics import calculate, sheet_of
from exporters.production.check import scene_checks
from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.base.texts import words
from parts.scene.load import load_scene
from tests.exporters.command.test_cli import complaint
from tests.exporters.documents.test_calc import evaluated
from tests.oracles.pin_sweep import disc_pins, lantern_pins, least_distance

DISC = ("number_of_lobes=9", "pin_circle_diameter=90", "pin_diameter=9", "eccentricity=2", "pin_clearance=0.1",
        "pin_circle_shift=0.2")  # fmt: skip
LANTERN = ("number_of_teeth=24", "number_of_pins=8", "pin_circle_diameter=60", "pin_diameter=8", "pin_clearance=0.05",
           "root_clearance=0.2")  # fmt: skip
CLOCK = ("cycloidal-gear", "module=2", "number_of_teeth=60", "mate_number_of_teeth=8")
OVAL = ("centrode=oval", "axis_ratio=1.4", "number_of_teeth=42", "module=2", "step=15")
ELLIPSE = ("centrode=focal_ellipse", "eccentricity=0.4", "number_of_teeth=35", "module=2", "step=15")
RATIO = ("centrode=ratio", "number_of_teeth=24", "mate_number_of_teeth=48", "centre_distance=120",
         "ratio_cosines=[0.2,0.03]", "ratio_sines=[0.05]", "step=15")  # fmt: skip
SHEETS = [("cycloidal", *DISC), ("cycloidal", "cycloidal_reducer"), ("cycloidal", *DISC[:3], "eccentricity=0.5"),
          ("lantern", *LANTERN), ("cycloidal-gear", "clock_gears", "part=wheel"),
          ("geneva", "geneva_drive", "part=wheel", "speed_rpm=75", "number_of_pins=2"),
          ("geneva", "geneva_drive", "part=ring", "speed_rpm=75"),
          ("cycloidal-gear", "module=2", "number_of_teeth=30", "tip_rolling_diameter=10", "root_rolling_diameter=10",
           "mate_number_of_teeth=20", "mate_addendum_coefficient=0.8", "circumferential_thinning=0.05",
            "root_rounding=0.3"),
          ("noncircular", *OVAL), ("noncircular", *ELLIPSE), ("noncircular", *RATIO),
          ("noncircular", *RATIO[:1], "role=mate", "number_of_teeth=48", "mate_number_of_teeth=24", *RATIO[3:]),
          ("cam", "groove_cam"), ("cam", "wedge_cam"), ("cam", "barrel_cam", "part=barrel"),
          ("cam", "yoke_cam")]  # fmt: skip

PUBLISHED = Path(__file__).parents[2] / "published"
GENEVA_TABLE = json.loads((PUBLISHED / "geneva_drives.json").read_text(encoding="utf-8"))["external"]


def calculated(*words: str) -> dict[str, Any]:
    return json.loads(calculate(words[0], words[1:], "json", "en"))


def column(rows: list[dict[str, float]], name: str) -> np.ndarray:
    return np.array([math.inf if row[name] is None else row[name] for row in rows])


@pytest.mark.sampled(4)
@pytest.mark.parametrize("words", SHEETS, ids=lambda w: " ".join(w)[:60])
def test_every_printed_formula_gives_its_value(words: tuple[str, ...]) -> None:
    steps = [s for s in sheet_of(words[0], words[1:])[0].steps() if s.formula]
    assert len(steps) >= 5
    for step in steps:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-9, abs=1e-9), (step.name, step.formula)
    spoilt = [s for s in steps if s.inputs and evaluated(s, 1e-3) == pytest.approx(s.value, rel=1e-9, abs=1e-12)]
    assert [s.name for s in spoilt] == []


@pytest.mark.sampled(2)
@pytest.mark.parametrize("topic", ["cycloidal", "lantern", "cycloidal-gear", "noncircular"])
def test_both_languages_in_every_format(topic: str) -> None:
    page, _ = sheet_of(topic, next(w for w in SHEETS if w[0] == topic)[1:])
    for form in SPOKEN:
        one, two = (render(page, form, language) for language in ("en", "uk"))
        assert one != two
        if form != "json":
            assert words("en").say(page.title) in one
            assert words("uk").say(page.title) in two


def test_a_disc_stands_where_its_pins_sweep() -> None:
    """Every point of the table is one generating pin's radius away from the nearest place of any pin."""
    data = calculated("cycloidal", *DISC, "step=15")
    values = data["values"]
    assert values["generating_pin_radius"] == pytest.approx(4.6)
    centres = disc_pins(10, values["generating_radius"], 2.0)
    drive = np.linspace(0, 18 * math.pi, 20_001)
    # the sweep has a pin's valley on +x; the table a lobe
    turn = np.exp(1j * math.pi / 9)
    for row in data["profile"]:
        at = complex(row["x"], row["y"]) * turn
        assert least_distance(at, centres, drive) == pytest.approx(4.6, abs=1e-9)
    spoilt = complex(data["profile"][4]["x"], data["profile"][4]["y"]) * turn + 0.01
    assert least_distance(spoilt, centres, drive) != pytest.approx(4.6, abs=1e-3)


def test_arms_and_pressure_angles_of_pins_are_those_of_the_velocities() -> None:
    """Turn the eccentric a little: a pin's centre moves along the disc's tangent, its normal stands across it."""
    data = calculated("cycloidal", *DISC, "step=20")
    values, z, e = data["values"], 9, 2.0
    big, small, h = values["generating_radius"], values["generating_pin_radius"], 1e-6
    for row in data["profile"][1:-1]:
        psi = math.radians(row["psi"])

        def seen(drive: float, psi: float = psi) -> complex:
            """The pin's centre in the disc, the eccentric on +x at first."""
            return (big * np.exp(1j * psi) - e * np.exp(1j * drive)) * np.exp(1j * drive / z)

        way = (seen(h) - seen(-h)) / (2 * h)
        normals = [side * 1j * way / abs(way) for side in (1, -1)]
        # inwards is nearer to the pole, which lies at e N
        normal = min(normals, key=lambda n: abs(seen(0.0) + small * n - (e * 10 - e)))
        touch = seen(0.0) + small * normal
        arm = abs((np.conj(touch) * normal).imag)
        assert row["l"] == pytest.approx(arm, rel=1e-6)
        # the way of the touched point about the disc's axis
        turning = 1j * touch / abs(touch)
        angle = math.degrees(math.acos(min(1.0, abs((np.conj(turning) * normal).real))))
        assert row["alpha"] == pytest.approx(angle, abs=1e-4)
    fine = calculated("cycloidal", *DISC, "step=0.1")["profile"]
    assert values["least_disc_pressure_angle_deg"] == pytest.approx(column(fine, "alpha").min(), abs=1e-4)
    assert values["greatest_force_arm"] == pytest.approx(column(fine, "l").max(), rel=1e-5)
    assert values["greatest_arm_angle_deg"] == pytest.approx(fine[int(column(fine, "l").argmax())]["psi"], abs=0.1)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("words", [DISC, ("number_of_lobes=3", "pin_circle_diameter=80", "pin_diameter=6",
                                          "eccentricity=1.2")], ids=["vertex", "lobe"])  # fmt: skip
def test_the_least_radius_of_a_path_is_that_of_mpmath(words: tuple[str, ...]) -> None:
    values = calculated("cycloidal", *words)["values"]
    big, e, n = (mpmath.mpf(values[k]) for k in ("generating_radius", "eccentricity", "number_of_pins"))

    def radius(s: Any) -> Any:
        first = 1j * (big * mpmath.expj(s) - e * n * mpmath.expj(n * s))
        second = -(big * mpmath.expj(s) - e * n**2 * mpmath.expj(n * s))
        bend = mpmath.im(mpmath.conj(first) * second)
        return abs(first) ** 3 / bend if bend > 0 else mpmath.inf

    span = 2 * mpmath.pi / (n - 1)
    coarse = min(range(4000), key=lambda k: radius(span * k / 4000))
    # the radius is flat there: a step of 1/50 is off by some 1e-12 of it
    near = [span * (coarse + mpmath.mpf(k) / 50) / 4000 for k in range(-100, 101)]
    assert values["least_path_curvature_radius"] == pytest.approx(float(min(map(radius, near))), rel=1e-8)
    assert values["least_profile_radius"] == pytest.approx(
        values["least_path_curvature_radius"] - values["generating_pin_radius"]
    )


def test_the_greatest_eccentricity_is_where_the_pins_begin_to_cut() -> None:
    values = calculated("cycloidal", *DISC)["values"]
    most = values["greatest_eccentricity"]
    near = calculated("cycloidal", *DISC[:3], f"eccentricity={most * 0.97}", *DISC[4:])["values"]
    assert 0 < near["least_profile_radius"] < values["least_profile_radius"]
    with pytest.raises(Exception, match="undercut"):
        calculated("cycloidal", *DISC[:3], f"eccentricity={most * 1.001}", *DISC[4:])


def result_of(page: str, *, of: str) -> str:
    """The digits of a quantity as the text of a page prints them."""
    lines = page.splitlines()
    row = lines[next(k for k, line in enumerate(lines) if line.split("  [")[0] == of) + 1]
    return row.rpartition("= ")[2].split()[0]


@pytest.mark.sampled(2)
@pytest.mark.parametrize("seed", range(5))
def test_the_greatest_eccentricity_and_pin_build_as_they_are_told(seed: int) -> None:
    """Of 15 discs and 15 lanterns none was built: at the limit itself the lobes are sharp, the teeth gone."""
    draw = random.Random(seed)
    disc = [f"number_of_lobes={draw.randint(6, 30)}", f"pin_circle_diameter={draw.uniform(50, 120):.2f}",
            f"pin_diameter={draw.uniform(2, 6):.2f}"]  # fmt: skip
    lantern = [
        f"number_of_teeth={draw.randint(12, 40)}",
        f"number_of_pins={draw.randint(7, 14)}",
        f"pin_circle_diameter={draw.uniform(40, 90):.2f}",
        "root_clearance=0.2",
    ]
    for topic, asked, key, name, per, called in (
        ("cycloidal", disc, "eccentricity=", "greatest_eccentricity", 1, "greatest eccentricity without undercut"),
        ("lantern", lantern, "pin_diameter=", "greatest_pin_radius", 2,
         "greatest radius of pins that leave a tooth between them"),
    ):  # fmt: skip
        begun = [*asked, f"{key}{0.5 if topic == 'cycloidal' else 3}"]
        whole = json.loads(calculate(topic, begun, "json", "en"))["values"][name]
        told = float(result_of(calculate(topic, begun, "text", "en"), of=called))
        assert whole - 1e-5 <= told <= whole
        for value in (whole, told):
            calculate(topic, [*asked, f"{key}{per * value!r}"], "json", "en")
        with pytest.raises(SceneError, match=r"cut|between|touch|loops"):
            calculate(topic, [*asked, f"{key}{per * whole * 1.0002!r}"], "json", "en")


def test_a_lantern_gear_stands_where_its_pins_sweep() -> None:
    data = calculated("lantern", *LANTERN, "rows=9")
    drive = np.linspace(-math.pi / 3, math.pi / 3, 4001)
    centres = lantern_pins(8, 24, 30.0)
    # the sweep's pin on the line of centres makes a space on +x, the table has a tooth there
    turn = np.exp(1j * math.pi / 24)
    for row in data["flank"]:
        at = complex(row["x"], row["y"]) * turn
        # 0.05 mm of clearance stand between flank and pin
        assert least_distance(at, centres, drive) == pytest.approx(4.05, abs=1e-9)


def test_pressure_angles_of_a_lantern_are_those_of_the_chord_to_the_pole() -> None:
    """The pin on its circle, the pole where both pitch circles touch: the normal goes through both (Willis)."""
    data = calculated("lantern", *LANTERN, "rows=9")
    values = data["values"]
    for row in data["flank"]:
        pin = 30 * np.exp(1j * math.radians(row["phi"]))
        chord = pin - 30
        assert row["alpha"] == pytest.approx(math.degrees(math.atan(abs(chord.real / chord.imag))), abs=1e-9)
        assert row["phi"] == pytest.approx(3 * row["u"])
    assert values["end_pressure_angle_deg"] == pytest.approx(data["flank"][-1]["alpha"])


def test_the_contact_ratio_of_a_lantern_counts_pins_that_touch() -> None:
    """Brute force: over the gear's turns, the mean number of pins between the flank's ends."""
    values = calculated("lantern", *LANTERN)["values"]
    first, last = values["flank_start_angle_deg"], values["flank_end_angle_deg"]
    turns = np.linspace(0, 15, 3001)[:-1]
    pins = [sum(first <= t + 15 * k < last for k in range(-3, 4)) for t in turns]
    assert np.mean(pins) == pytest.approx(values["lantern_contact_ratio"], abs=2e-3)


def test_ovals_and_ellipses_are_the_closed_forms_by_mpmath() -> None:
    for asked, lobes, e in ((OVAL, 2, 0.4 / 2.4), (ELLIPSE, 1, 0.4)):
        data = calculated("noncircular", *asked)
        values = data["values"]
        p = mpmath.mpf(values["centrode_parameter"])

        def radius(t: Any, p: Any = p, e: float = e, lobes: int = lobes) -> Any:
            return p / (1 - e * mpmath.cos(lobes * t))

        length = mpmath.quad(
            lambda t: mpmath.hypot(radius(t), mpmath.diff(radius, t)), mpmath.linspace(0, 2 * mpmath.pi, 9)
        )
        assert values["perimeter"] == pytest.approx(float(length), rel=1e-9)
        assert values["module"] == pytest.approx(2.0, rel=1e-9)
        assert values["mate_turns"] == pytest.approx(360, abs=1e-9)
        assert values["least_ratio"] == pytest.approx((1 - e) / (1 + e), rel=1e-9)
        assert values["greatest_ratio"] == pytest.approx((1 + e) / (1 - e), rel=1e-9)
        stretch = (1 + e) / (1 - e)
        for row in data["centrodes"]:
            half = math.radians(row["phi_1"]) * lobes / 2
            angle = math.degrees(math.atan2(stretch * math.sin(half), math.cos(half))) * 2 / lobes
            assert (row["phi_2"] - angle) % (360 / lobes) == pytest.approx(0, abs=1e-7) or (row["phi_2"] - angle) % (
                360 / lobes
            ) == pytest.approx(360 / lobes, abs=1e-7)


def test_radii_of_curvature_of_both_centrodes_are_those_of_three_points() -> None:
    rows = calculated("noncircular", *RATIO[:-1], "step=0.2")["centrodes"]
    for index in (1, 2):
        # the second one seen from its axis, over its own angle
        curve = column(rows, f"r_{index}") * np.exp(1j * np.radians(column(rows, f"phi_{index}")))
        for k in range(10, len(rows) - 10, 97):
            a, b, c = curve[k - 1 : k + 2]
            area = ((b - a).conjugate() * (c - a)).imag / 2
            radius = abs(b - a) * abs(c - b) * abs(a - c) / (4 * area)
            assert rows[k][f"rho_{index}"] == pytest.approx(radius, rel=1e-3)


def test_a_given_ratio_is_met_and_closes() -> None:
    data = calculated("noncircular", *RATIO)
    values = data["values"]

    def ratio(t: float) -> float:
        return 0.5 * (1 + 0.2 * math.cos(t) + 0.03 * math.cos(2 * t) + 0.05 * math.sin(t))

    for row in data["centrodes"]:
        t = math.radians(row["phi_1"])
        assert row["i"] == pytest.approx(ratio(t), rel=1e-12)
        assert row["phi_2"] == pytest.approx(math.degrees(float(mpmath.quad(ratio, [0, t]))), abs=1e-9)
        assert row["r_1"] + row["r_2"] == pytest.approx(120)
    assert values["mate_turns"] == pytest.approx(180, abs=1e-9)
    assert values["mate_lobes"] == 2
    fine = [ratio(t) for t in np.linspace(0, 2 * math.pi, 100_001)]
    assert values["least_ratio"] == pytest.approx(min(fine), rel=1e-8)
    assert values["greatest_ratio"] == pytest.approx(max(fine), rel=1e-8)


def test_a_gear_of_a_scene_runs_with_the_tips_that_its_mate_has_there() -> None:
    """The tips of the scene's pinion are lower than its wheel's; before the line and beyond change."""
    wheel, pinion = (calculated("cycloidal-gear", "clock_gears", f"part={part}") for part in ("wheel", "pinion"))
    scene = load_scene("clock_gears")
    (mate,) = scene_checks(plan_build(scene, "t", [], []).placing, {}, scene.drives, "en", contact=False)["mates"]
    for key, mirrored in (("approach", "recess"), ("recess", "approach")):
        assert wheel["values"][f"{key}_contact_ratio"] == pytest.approx(mate[f"{key}_ratio"], rel=1e-12)
        assert pinion["values"][f"{key}_contact_ratio"] == pytest.approx(mate[f"{mirrored}_ratio"], rel=1e-12)
    assert wheel["values"]["bottom_clearance_at_root"]["first"] == pytest.approx(3.0 * (1.25 - 0.7))
    assert (wheel["notes"], pinion["notes"]) == ([], [])
    # as thick as the build makes them: p / 2, less half of the 0.2 mm that the mate asks for
    for told, part in ((wheel, "wheel"), (pinion, "pinion")):
        thing = plan_build(scene, "t", [], []).parts[part].thing
        assert told["values"]["reference_thickness"]["first"] == pytest.approx(1.5 * math.pi - 0.1, rel=1e-12)
        assert told["values"]["tip_thickness"]["first"] == pytest.approx(thing.tip_thickness, rel=1e-12)
        assert told["values"]["normal_backlash"] == pytest.approx(mate["normal_backlash"], rel=1e-12)
    other = calculated("cycloidal-gear", "clock_gears", "part=wheel", "mate_addendum_coefficient=1.3")
    assert other["values"]["bottom_clearance_at_root"]["first"] == pytest.approx(3.0 * (1.25 - 1.3))


def test_of_a_mate_the_tips_alone_are_asked() -> None:
    """Roots as deep and teeth as thin as a wheel of 60 can have, and a pinion of 8 cannot."""
    plain, deep = (calculated(*CLOCK, *more)["values"] for more in ((), ("dedendum_coefficient=5",)))
    assert deep["approach_contact_ratio"] == plain["approach_contact_ratio"]
    thin = calculated(*CLOCK[:2], "number_of_teeth=8", "mate_number_of_teeth=60", "addendum_coefficient=0.5",
                      "circumferential_thinning=1.8", "mate_addendum_coefficient=1.3")  # fmt: skip
    assert thin["values"]["approach_contact_ratio"] > 0


def test_the_rule_for_equal_ovals_is_told() -> None:
    assert any("two equal parts mesh" in n for n in calculated("noncircular", *OVAL)["notes"])
    other = calculated("noncircular", *OVAL[:2], "number_of_teeth=44", *OVAL[3:])
    assert any("do not mesh" in n for n in other["notes"])


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("cycloidal", *DISC[:3], "eccentricity=9"), "works"),
        (("cycloidal", "lantern_pair"), "has no cycloidal_disc"),
        (("cycloidal", "cycloidal_reducer", "part=disk"), "did you mean disc"),
        (("lantern", "lantern_pair", "pin_diameter=25"), "works"),
        (("lantern", "number_of_teeth=12"), "number_of_pins"),
        (("lantern", "practicum_pair", "part=wheel"), "the scene has no lantern_gear"),
        ((*CLOCK, "mate_addendum_coefficient=4"), "mate_addendum_coefficient = 4.0: the tooth is pointed"),
        (
            (*CLOCK[:3], "tip_rolling_diameter=30", "mate_number_of_teeth=10"),
            "gear.tip_rolling_diameter = 30.0: is more than",
        ),
        (("noncircular", "oval_gears"), "oval, ellipse; add part=ID"),
        (("noncircular", *OVAL[:1], "axis_ratio=3", *OVAL[2:]), "works"),
        (("noncircular", *OVAL, "stp=3"), "did you mean step"),
    ],
)
def test_wrong_input_gets_one_clear_line(words: tuple[str, ...], told: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert told in complaint(capsys, "calc", *words)


@pytest.mark.parametrize("row", GENEVA_TABLE, ids=lambda row: str(row["slots"]))
def test_geneva_wheels_of_printed_tables(row: dict[str, Any]) -> None:
    found = calculated("geneva", f"number_of_slots={row['slots']}", "centre_distance=100", "pin_diameter=4")["values"]
    degrees, minutes = row["angle"]
    assert found["acceleration_angle_deg"] == pytest.approx(degrees + minutes / 60, abs=0.6 / 60)
    half = 0.05 if row["slots"] == 3 else 0.005
    for name, key, digit in (
        ("greatest_velocity_ratio", "velocity", 0.005),
        ("motion_share", "motion_share", 5e-5),
        ("entry_acceleration_ratio", "entry", 5e-4),
        ("greatest_acceleration_ratio", "acceleration", half),
    ):
        assert found[name] == pytest.approx(row[key], abs=digit)
    assert int(found["pin_limit"] + 1e-9) == row["most_pins"]


def test_times_and_speeds_of_an_internal_geneva_wheel() -> None:
    """By the triangle of both axes and the pin, whose angle at the wheel is told by a difference quotient."""
    words = ("number_of_slots=5", "centre_distance=40", "pin_diameter=4", "internal=true", "speed_rpm=90")
    data = calculated("geneva", *words)
    found, pin = data["values"], math.sin(math.pi / 5)
    assert found["motion_time"] == pytest.approx(60 / 90 * (5 + 2) / 10)
    assert found["motion_time"] + found["dwell_time"] == pytest.approx(60 / 90)
    step, omega = 1e-4, math.pi * 3
    end = math.pi / 2 + math.pi / 5

    def turned(alpha: float) -> float:
        return math.atan2(pin * math.sin(alpha), 1 + pin * math.cos(alpha))

    assert found["greatest_angular_velocity"] == pytest.approx(omega * turned(step) / step, rel=1e-6)
    bend = (turned(end) - 2 * turned(end - step) + turned(end - 2 * step)) / step**2
    assert found["greatest_angular_acceleration"] == pytest.approx(abs(bend) * omega**2, rel=1e-3)
    rows = data["motion"]
    assert column(rows, "φ_2") == pytest.approx([math.degrees(turned(math.radians(row["α"]))) for row in rows])

"""The part kind ``worm``: files of every form through the command, measures by independent ways, refusals that work."""

from __future__ import annotations

import json
import math
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from exporters.command.cli import main
from exporters.formats.read_step import read_step
from exporters.formats.read_stl import read_stl
from exporters.formats.stl import write_stl
from exporters.verification.faces import verify_faced_mesh, verify_faced_solid
from geometry.base.errors import Nearest
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.scene.files import built_in_scenes
from parts.scene.load import make_parts, scene_from_dict, tomllib
from parts.solids.mesh import body_mesh, mesh_outlines
from parts.solids.step_text import StepForm, StepPart, step_text
from tests.geometry.gears.worms.screwed import screwed
from tests.parts.limits import refused as refused_scene
from tests.parts.nearest import cured, refused
from tests.parts.positive_scenes import parts_of

WORM: dict[str, Any] = {"kind": "worm", "module": 5.0, "thread_length": 40.0}
SHORT = "a thread shorter than its spaces are wide", "blunt threads within less than a step", "no step"
EXTREMES: dict[str, dict[str, Any]] = {
    # before: the plane ring between them had no points to be looked at
    "a shaft just under the root": {"end_angle_deg": 0.0, "shaft_below": [{"diameter": 37.985, "length": 9.0}]},
    # before: a cone that is none, by the last digit of the root
    "a shaft as thick as the root": {"module": 3.0, "number_of_starts": 2, "diameter_quotient": 12.08,
                                     "thread_length": 18.0, "shaft_below": [{"diameter": 29.04, "length": 9.0}]},
    # before: its triangles passed for those of the roundings beside it
    "a land narrower than the tolerance": {
        "number_of_starts": 8, "diameter_quotient": 7.39, "tip_rounding": 0.6166, "thread_length": 44.0
    },
    # before: a traceback, since no line crosses the spaces between its ends
    SHORT[0]: {
        "module": 0.243, "number_of_starts": 5, "form": "ZN1", "addendum_coefficient": 0.825, "lead_angle_deg": 11.423,
        "tip_clearance_coefficient": 0.315, "thread_length": 1.077, "end_angle_deg": 41.4,
    },
    # before: an upright edge between two angles, and no mesh was near enough
    SHORT[1]: {"number_of_starts": 4, "diameter_quotient": 11.82, "form": "ZN2", "thread_length": 30.0,
               "thread_ends": "blunt"},
    # before: called off by its read-back, since cells that are off both ways were told to be off by one
    SHORT[2]: {"module": 1.0, "number_of_starts": 6, "diameter_quotient": 21.97, "form": "ZN2",
               "thread_length": 2.8011, "end_angle_deg": 5.0},
    "plain ends": {"module": 3.0, "number_of_starts": 2, "thread_length": 16.0, "form": "ZA", "end_angle_deg": 0.0,
                   "shaft_below": [{"diameter": 22.8, "length": 4.0}]},
    "run out": {"thread_length": 20.0, "thread_ends": "run_out", "run_out_deg": 60.0, "hand": "left",
                "shaft_below": [{"diameter": 80.0, "length": 9.0, "chamfer": 1.0}], "bore_diameter": 20.0},
    "blunt ends": {"thread_length": 30.0, "thread_ends": "blunt", "tip_rounding": 0.3, "number_of_starts": 2},
    "ground": {"module": 3.0, "number_of_starts": 2, "thread_length": 20.0, "form": "ZK1"},
    "base above the root": {"number_of_starts": 4, "diameter_quotient": 8.0, "tip_rounding": 0.3},
    "q 50": {"module": 1.0, "diameter_quotient": 50.0, "thread_length": 8.0, "form": "ZA", "hand": "left"},
    "q 4": {"module": 2.0, "diameter_quotient": 4.0, "thread_length": 16.0, "form": "ZN1", "end_angle_deg": 45.0},
    "ten starts": {"module": 2.0, "number_of_starts": 10, "diameter_quotient": 30.0, "thread_length": 22.0,
                   "form": "ZN2", "shaft_above": [{"diameter": 20.0, "length": 5.0, "chamfer": 1.0}],
                   "bore_diameter": 8.0},
    "lead of 60 degrees": {"number_of_starts": 6, "lead_angle_deg": 60.0, "addendum_coefficient": 0.3,
                           "tip_clearance_coefficient": 0.1, "fillet_coefficient": 0.05, "pressure_angle_deg": 10.0,
                           "form": "ZN1"},
}  # fmt: skip


def part_of(**keys: Any) -> Part:
    return make_parts(scene_from_dict({"parts": {"worm": WORM | keys}}, "s", "s"), "s")[0]["worm"]


def test_the_keys_of_the_thesis_give_its_numbers() -> None:
    part = part_of(thread_length=120.0, tip_rounding=0.5)
    found = part.circles | part.quantities
    # table 2.2 of the thesis; alpha_x of an involute worm by its own formula
    assert found["reference_diameter"] == 50.0
    assert found["tip_diameter"] == 60.0
    assert found["root_diameter"] == pytest.approx(38.0)
    assert found["base_diameter"] == pytest.approx(13.185, abs=5e-4)
    assert found["lead_angle_deg"] == pytest.approx(5.7106, abs=5e-5)
    assert found["axial_pressure_angle_deg"] == pytest.approx(20.0918, abs=5e-5)
    assert found["lead"] == pytest.approx(5 * math.pi)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("keys", [{}, {"number_of_starts": 3, "form": "ZN1", "hand": "left"}, {"form": "ZA"}])
def test_balls_touch_both_flanks_of_their_space_and_the_chord_is_the_shortest(keys: dict[str, Any]) -> None:
    part = part_of(**keys)
    thread, worm = part.thing.thread, part.thing.thread.worm
    ball = part.quantities["ball_diameter"]
    radius = (part.quantities["over_balls"] - ball) / 2
    centre = np.array([radius, 0.0, math.pi * worm.module / 2])
    line = dict(thread.lines)["flank"]
    # brute force over the upper flank below the ball and the lower one above it
    t, turn = np.meshgrid(np.linspace(*line.domain, 400), np.linspace(-0.6, 0.6, 1201))
    for upper, up in ((True, 0.0), (False, math.pi * worm.module)):
        points = screwed(thread, line.point(t), turn, upper=upper) + np.array([0.0, 0.0, up])
        assert np.linalg.norm(points - centre, axis=-1).min() == pytest.approx(ball / 2, abs=2e-4)
    r, half = worm.reference_radius, worm.screw.half_thickness
    turns = np.linspace(-0.3, 0.3, 200_001)
    sizes = 2 * np.hypot(r * np.sin(turns), half + worm.parameter * turns)
    assert part.quantities["thread_chord"] == pytest.approx(sizes.min(), abs=1e-9)
    least = turns[sizes.argmin()]
    assert part.quantities["thread_chord_height"] == pytest.approx(worm.tip_radius - r * math.cos(least), abs=1e-5)


@pytest.mark.parametrize("form", ["ZI", "ZN2"])
def test_the_flat_section_is_that_of_the_screw_surfaces(form: str) -> None:
    part = part_of(number_of_starts=2, hand="left", bore_diameter=10.0, form=form)
    worm = part.thing.thread.worm
    outer = part.section(0.0).region.outer
    assert outer.count == 2
    for segment in outer.period:
        t = np.linspace(*segment.curve.domain, 9)
        point = segment.curve.point(t)
        if segment.label == "flank":
            turned = np.abs(np.angle(point)) - worm.half_thickness(np.abs(point)) / worm.parameter
            assert np.abs(turned).max() < 1e-12
        step = 1e-5
        middle = t[1:-1]
        for order in (1, 2, 3):
            low, high = (
                segment.curve.derivative(x, order - 1) if order > 1 else segment.curve.point(x)
                for x in (middle - step, middle + step)
            )
            assert segment.curve.derivative(middle, order) == pytest.approx(
                (high - low) / (2 * step), rel=1e-5, abs=1e-5
            )


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", [
    name if name in ("plain ends", *SHORT) else pytest.param(name, marks=pytest.mark.heavy) for name in EXTREMES
])  # fmt: skip
def test_files_of_extreme_worms_are_read_back_as_they_should_be(name: str, tmp_path: Path) -> None:
    rows = []
    for key, value in (WORM | EXTREMES[name]).items():
        told = json.dumps(value) if not isinstance(value, list) else (
            "[" + ", ".join("{" + ", ".join(f"{k} = {v}" for k, v in row.items()) + "}" for row in value) + "]"
        )  # fmt: skip
        rows.append(f"{key} = {told}")
    exports = [
        '[[exports]]\nformat = "step"',
        '[[exports]]\nformat = "stl"\ntolerance = 0.1',
        '[[exports]]\nformat = "dxf"',
    ]
    scene = tmp_path / "one.toml"
    scene.write_text("\n".join(["[parts.worm]", *rows, *exports]) + "\n", "utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path / "out")]) == 0
    report = json.loads(next((tmp_path / "out").rglob("report.json")).read_text("utf-8"))
    assert len(report["files"]) == 3
    for file in report["files"]:
        assert file["measured"]["max_deviation"] <= file["max_error"] <= file["tolerance"]


@pytest.mark.parametrize(
    ("keys", "key"),
    [
        ({"diameter_quotient": 2.0}, "diameter_quotient"),
        ({"number_of_starts": 8, "lead_angle_deg": 60.0, "form": "ZN1"}, "lead_angle_deg"),
        ({"thread_length": 9.0}, "thread_length"),
        ({"thread_length": 12.0, "thread_ends": "blunt"}, "thread_length"),
        ({"thread_length": 9.0, "thread_ends": "run_out"}, "thread_length"),
        ({"fillet_coefficient": 1.9}, "fillet_coefficient"),
        ({"tip_rounding": 5.0}, "tip_rounding"),
        ({"addendum_coefficient": 3.0}, "addendum_coefficient"),
        # before: an outline that does not come about, without a key
        ({"axial_thinning": 9.0}, "axial_thinning"),
        # before: no value, since of the few that were tried the lowest had no room for the rounding
        (
            {
                "module": 1.25,
                "number_of_starts": 4,
                "diameter_quotient": 3.756,
                "form": "ZK1",
                "thread_length": 18.56,
                "tip_rounding": 0.286,
                "axial_thinning": 0.095,
            },
            "addendum_coefficient",
        ),
        # before: no value, since of an addendum whose thread stands the thread was too short to end in
        (
            {
                "module": 0.2,
                "number_of_starts": 8,
                "diameter_quotient": 3.07,
                "pressure_angle_deg": 30.0,
                "thread_length": 1.04,
                "thread_ends": "blunt",
            },
            "addendum_coefficient",
        ),
        # before: no value, since the last that leaves a land leaves a rounding no room, or the thread no length
        ({"tip_rounding": 1.2, "axial_thinning": 5.0}, "axial_thinning"),
        (
            {
                "module": 3.819,
                "number_of_starts": 7,
                "diameter_quotient": 7.153,
                "tip_clearance_coefficient": 0.694,
                "thread_length": 11.54,
                "thread_ends": "run_out",
                "run_out_deg": 95.9,
                "tip_rounding": 1.092,
            },
            "tip_rounding",
        ),
        # before: no value, since no quotient cures what another key does
        (
            {"diameter_quotient": 8.0, "pressure_angle_deg": 30.0, "form": "ZN1", "number_of_starts": 5},
            "addendum_coefficient",
        ),
        ({"shaft_above": [{"diameter": 45.0, "length": 5.0}]}, "shaft_above[1].diameter"),
        ({"shaft_below": [{"diameter": 20.0, "length": 5.0, "chamfer": 6.0}]}, "shaft_below[1].chamfer"),
        # before: a groove between both
        (
            {"shaft_below": [{"diameter": 20.0, "length": 5.0, "chamfer": 1.0}, {"diameter": 30.0, "length": 5.0}]},
            "shaft_below[1].chamfer",
        ),
        # before: without effect
        ({"run_out_deg": 60.0}, "run_out_deg"),
        ({"grinding_wheel_diameter": 200.0}, "grinding_wheel_diameter"),
        ({"thread_ends": "blunt", "thread_length": 50.0, "end_angle_deg": 20.0}, "end_angle_deg"),
        ({"bore_diameter": 40.0}, "bore_diameter"),
        ({"diameter_quotient": 12.0, "lead_angle_deg": 10.0}, "diameter_quotient"),
        # before: the usual q was dropped
        ({"diameter_quotient": 10.0, "lead_angle_deg": 12.0}, "diameter_quotient"),
        # before: what was offered had a core and no thread, so that nothing was
        ({"diameter_quotient": 2.2, "form": "ZN1"}, "diameter_quotient"),
        ({"diameter_quotient": 2.0, "form": "ZN2", "number_of_starts": 4}, "diameter_quotient"),
        ({"lead_angle_deg": 60.0, "form": "ZN1", "number_of_starts": 4}, "lead_angle_deg"),
    ],
)
def test_a_worm_that_cannot_be_is_refused_with_a_value_that_works(keys: dict[str, Any], key: str) -> None:
    refusal = refused({"worm": WORM | keys})
    assert refusal.key == f"parts.worm.{key}"
    assert cured({"worm": WORM | keys}, refusal) is not None


@pytest.mark.parametrize(("form", "quotient"), [("ZN1", 3.8), ("ZN2", 3.8), ("ZN2", 3.1)])
def test_a_thread_as_wide_as_its_worm_is_refused_by_a_key(form: str, quotient: float) -> None:
    """The line of the normal section stands where a rounding decides whether it reaches the reference cylinder."""
    keys = {"form": form, "number_of_starts": 10, "diameter_quotient": quotient, "thread_length": 60.0}
    assert refused({"worm": WORM | {"module": 2.0} | keys}).key.startswith("parts.worm.")


def test_a_thinned_thread_that_is_offered_has_a_land_that_takes_a_mesh() -> None:
    found = refused({"worm": WORM | {"axial_thinning": 9.0}}).nearest
    assert found is not None
    # before: 0.0001 mm, and an STL in which that face had no triangle
    assert part_of(axial_thinning=found.value).thing.thread.tip_half >= 1e-3 * WORM["module"]


def test_a_wheel_of_a_worm_without_core_is_told_a_quotient_that_has_teeth() -> None:
    wheel = {
        "kind": "worm_wheel",
        "module": 2.0,
        "number_of_teeth": 40,
        "number_of_starts": 8,
        "diameter_quotient": 2.2,
    }
    refusal = refused({"wheel": wheel})
    assert (refusal.key, refusal.code) == ("parts.wheel.diameter_quotient", "worm_root_under_axis")
    found = refusal.nearest
    assert found is not None
    assert found.side == "at_least"
    assert isinstance(found.value, float)
    assert parts_of({"wheel": wheel | {"diameter_quotient": found.value}})
    # the nearest but for what a costly search leaves
    with pytest.raises(SceneError):
        parts_of({"wheel": wheel | {"diameter_quotient": found.value - 0.3}})


def test_a_quotient_may_say_the_same_as_the_lead_angle() -> None:
    lead = math.degrees(math.atan(0.1))
    alone, both = part_of(lead_angle_deg=lead), part_of(lead_angle_deg=lead, diameter_quotient=10.0)
    assert both.circles == alone.circles == pytest.approx(part_of().circles)


def test_a_negative_module_is_refused_by_its_range() -> None:
    refusal = refused({"worm": WORM | {"module": -5.0}})
    assert refusal.key == "parts.worm.module"


@pytest.mark.sampled(1)
@pytest.mark.parametrize("seed", range(40))
def test_random_worms_are_closed_and_within_their_bounds_as_step_and_stl(seed: int, tmp_path: Path) -> None:
    rng = random.Random(seed)
    module, quotient = rng.choice([0.5, 1.0, 2.0, 5.0, 10.0]), round(rng.uniform(4.0, 50.0), 1)
    root = module * (quotient - 2.4)
    keys = {
        "module": module, "number_of_starts": rng.choice([1, 2, 3, 4, 6, 10]), "diameter_quotient": quotient,
        "form": rng.choice(["ZA", "ZI", "ZN1", "ZN2", "ZK1"]), "hand": rng.choice(["left", "right"]),
        "thread_length": round(module * rng.uniform(6.0, 15.0), 2),
        **rng.choice([{"end_angle_deg": rng.choice([0.0, 20.0, 45.0, 60.0])}, {}, {"thread_ends": "blunt"},
                      {"thread_ends": "run_out", "run_out_deg": rng.uniform(10.0, 120.0)}]),
        "tip_rounding": rng.choice([0.0, 0.05, 0.2]) * module, "fillet_coefficient": rng.choice([0.0, 0.2, 0.3]),
        "shaft_above": [{"diameter": rng.uniform(1.0, 1.99) * root, "length": 2 * module, "chamfer": 0.05 * module}],
        "shaft_below": [{"diameter": 1.999 * root, "length": module}], "bore_diameter": 0.3 * root,
    }  # fmt: skip
    try:
        part = part_of(**keys)
    except SceneError as refusal:
        if not refusal.code.startswith("worm_"):
            raise
        return
    body: Any = part.body(0.0)
    faces = body.within(1e-4)
    file = tmp_path / "worm.step"
    file.write_text(step_text(StepPart("worm", faces.geometry), StepForm(9)))
    verdict = verify_faced_solid(read_step(file), body, faces.max_error + 2e-9 + 1e-12 * body.reach(), 1e-4)
    assert verdict.failures == ()
    assert abs(verdict.measured["volume_error"]) < 1e-8
    chords = mesh_outlines(body, 0.02 * module, 0.0)
    file = tmp_path / "worm.stl"
    write_stl(file, body_mesh(body, chords))
    assert (
        verify_faced_mesh(read_stl(file), body, chords[0].max_error + 1e-5 * module * quotient, 0.02 * module).failures
        == ()
    )


def test_a_worm_is_measured_over_the_balls_of_its_standard() -> None:
    """GOST 19650: 1.67 modules."""
    for module in (2.0, 5.0):
        scene = scene_from_dict({"parts": {"p": WORM | {"module": module}}}, "s", "s")
        assert make_parts(scene, "s")[0]["p"].quantities["ball_diameter"] == pytest.approx(1.67 * module, rel=1e-12)


@pytest.mark.parametrize("module", [0.47, 3.76, 4.0])
def test_a_shaft_of_the_root_diameter_is_not_thicker_than_it(module: float) -> None:
    """7.6 m of q 10; what rounding leaves of it was found: 28.576 is thicker than 28.576 mm."""
    for more, builds in ((0.0, True), (1e-6, False)):
        step = {"diameter": round(7.6 * module, 6) + more, "length": 5.0}
        keys = {"kind": "worm", "module": module, "thread_length": 12 * module, "shaft_below": [step]}
        raw = scene_from_dict({"parts": {"w": keys}}, "t", "t")
        if builds:
            make_parts(raw, "t")
            continue
        with pytest.raises(SceneError) as found:
            make_parts(raw, "t")
        assert found.value.code == "worm_shaft_over_root"


def test_a_worm_that_is_told_twice_is_refused_beside_its_wheel_too() -> None:
    """What its wheel has too was taken from that as well, where it has no default: a traceback."""
    raw = tomllib.loads(built_in_scenes()["worm_set_print"].read_text(encoding="utf-8"))
    raw["parts"]["worm"]["lead_angle_deg"] = 5.7
    refusal = refused_scene(raw)
    assert refusal is not None
    assert (refusal.key, refusal.nearest) == ("parts.worm.lead_angle_deg", Nearest(None))

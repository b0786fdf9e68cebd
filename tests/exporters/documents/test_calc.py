"""``higherpair calc``: published cases, every formula evaluated, every format and language, every refusal one line."""

from __future__ import annotations

import html
import itertools
import json
import math
import random
import re
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from exporters.documents.render import SPOKEN, render
from exporters.documents.topics import TOPICS, calculate, sheet_of
from geometry.base.angles import inverse_involute, involute_function
from geometry.base.errors import Nearest
from parts.base.refusal import SceneError
from parts.base.texts import words
from parts.mates.pages import shift_choice
from parts.pages.page import KEYS, Sheet, Step
from parts.pages.terms import TERMS
from parts.scene.files import built_in_scenes
from parts.scene.load import load_scene, make_parts, scene_from_dict
from parts.texts.findings import finding_text
from tests.exporters.command.test_cli import complaint
from tests.exporters.making import run

PUBLISHED = Path(__file__).parents[2] / "published"
PRACTICUM = json.loads((PUBLISHED / "practicum_calculations.json").read_text(encoding="utf-8"))["cases"]
RINGS = json.loads((PUBLISHED / "ring_measurement.json").read_text(encoding="utf-8"))
THESIS_WORM = ("module=5", "face_width=26", "worm_length=120", "torque=3.5")
PAIR = ("module=3", "first.number_of_teeth=12", "second.number_of_teeth=60")
# regressions that broke others: branch switches at 20 and 25 degrees, steep helix with shift, many teeth, undercut
SHEETS = [
    ("bevel", "bevel_pair", "part=pinion", "torque=12", "speed_rpm=300"),
    ("bevel", "module=3", "number_of_teeth=16", "mate_number_of_teeth=24", "tip_cone=apex", "power=200",
     "speed_rpm=90"),
    ("bevel", "module=3", "number_of_teeth=9", "mate_number_of_teeth=30", "normal_backlash=0.1", "shaft_angle_deg=75"),
    ("bevel", "module=3", "number_of_teeth=30", "mate_number_of_teeth=24", "thickness_coefficient=0.03",
     "shaft_angle_deg=120"),
    ("bevel", "spiral_bevel_pair", "part=wheel", "torque=12", "speed_rpm=300"),
    ("bevel", "module=3", "number_of_teeth=16", "mate_number_of_teeth=24", "spiral_angle_deg=0", "cutter_radius=20",
     "torque=5"),
    ("bevel", "module=3", "number_of_teeth=16", "mate_number_of_teeth=24", "spiral_angle_deg=20", "tooth_line=straight",
     "normal_backlash=0.1", "torque=5"),
    ("face-gear", "face_gear_pair", "torque=12", "speed_rpm=300"),
    ("face-gear", "face_gear_pair", "torque=12", "shaper_number_of_teeth=22"),
    ("face-gear", "module=1", "number_of_teeth=200", "pinion_number_of_teeth=40", "circumferential_thinning=0.1",
     "power=200",
     "speed_rpm=90"),
    ("gear-pair", "crossed_helical_pair", "torque=12", "speed_rpm=300", "friction_coefficient=0.1"),
    ("gear-pair", "kind=crossed_helical_pair", "module=3", "first.number_of_teeth=15", "second.number_of_teeth=24",
     "first.helix_angle_deg=-20", "second.helix_angle_deg=-55", "first.profile_shift_coefficient=0.4", "power=200",
     "speed_rpm=90", "friction_coefficient=0.15", "normal_backlash=0.1"),
    ("gear-pair", "kind=crossed_helical_pair", "module=2", "number_of_teeth=20", "first.helix_angle_deg=30",
     "shaft_angle_deg=30.1", "face_width=12", "torque=3"),
    ("spur", "practicum_pair", "part=pinion"),
    ("spur", "module=2", "number_of_teeth=24", "profile_shift_coefficient=0.3", "circumferential_thinning=0.1",
     "helix_angle_deg=20", "diameter=50"),
    ("spur", "module=2", "number_of_teeth=25", "circumferential_thinning=0.1", "thinning_method=deeper_cut",
     "pin_diameter=3.5", "measured_over_pins=54.3"),
    ("spur", "module=2", "number_of_teeth=23", "kerf=0.2", "measured_span=15.1"),
    ("spur", "module=2", "number_of_teeth=23", "helix_angle_deg=10", "kerf=0.2", "measured_span=15",
     "measured_over_pins=51", "circumferential_thinning=0.1"),
    *(("spur", "module=1", f"number_of_teeth={z}") for z in (6, 8, 17, 41, 42, 43, 200, 10_000)),
    *(("spur", "module=1", f"number_of_teeth={z}", "pressure_angle_deg=25") for z in (26, 27)),
    ("spur", "module=1", "number_of_teeth=20", "helix_angle_deg=45", "profile_shift_coefficient=0.5"),
    ("spur", "module=2", "number_of_teeth=20", "tip_relief.depth_coefficient=0.02", "tip_diameter=43.5"),
    ("spur", "module=2", "number_of_teeth=20", "cutter.number_of_teeth=25", "profile_shift_coefficient=0.3"),
    ("spur", "module=2", "number_of_teeth=23", "helix_angle_deg=20", "cutter.number_of_teeth=25",
     "cutter.profile_shift_coefficient=0.2", "circumferential_thinning=0.1", "thinning_method=deeper_cut",
     "profile_shift_coefficient=-0.2"),
    ("ring", "thesis_internal_pair"),
    ("ring", "module=2", "number_of_teeth=61", "profile_shift_coefficient=0.3", "circumferential_thinning=0.1",
     "helix_angle_deg=-20", "diameter=131", "kerf=0.2", "measured_between_pins=127"),
    ("ring", "module=2", "number_of_teeth=60", "helix_angle_deg=20", "tip_rule=KHK", "rounded_root.full_round=true",
     "circumferential_thinning=0.1", "thinning_method=deeper_cut"),
    ("ring", "module=2", "number_of_teeth=45", "circumferential_thinning=0.1", "thinning_method=deeper_cut",
     "pin_diameter=3.5", "kerf=0.2", "measured_span=35.2", "measured_between_pins=86", "spaces_spanned=6",
     "cutter.number_of_teeth=20", "cutter.profile_shift_coefficient=0.1"),
    ("ring", "module=1", "number_of_teeth=2000", "rounded_root.radius_coefficient=0.2",
     "rounded_root.full_round=false"),
    ("rack", "rack_and_pinion"),
    ("rack", "module=2", "number_of_teeth=12", "circumferential_thinning=0.1", "pin_diameter=3.5", "kerf=0.2"),
    ("rack", "module=2", "number_of_teeth=12", "circumferential_thinning=0.1", "helix_angle_deg=15", "kerf=0.2",
     "measured_over_pin=9.7"),
    ("tmm42", "module=10", "reference_diameter=100"),
    ("tmm42", "module=5", "number_of_teeth=20"),
    ("tmm42", "practicum_pair", "part=wheel"),
    ("train", "case=practicum_1"),
    ("train", "case=practicum_1", "counted_turns=0.06"),
    ("planetary", "scheme=david", "teeth=[50,30,20,60]", "satellites=4"),
    ("planetary", "scheme=one_external_one_internal", "teeth=[18,36,20,72]", "helix_angle_deg=-20"),
    ("identify", "number_of_teeth=24", "teeth_spanned=4", "span=32.83", "next_span=41.68", "tip_diameter=80.4",
     "root_diameter=66.9"),
    ("identify", "number_of_teeth=24", "teeth_spanned=5", "span=42.01", "next_span=50.87", "helix_angle_deg=25"),
    ("identify", "number_of_teeth=61", "module=2", "between_pins=125.9", "pin_diameter=3.5", "tip_diameter=127.1",
     "root_diameter=136", "helix_angle_deg=20"),
    ("identify", "number_of_teeth=24", "module=2", "over_pins=56.9", "pin_diameter=3.5", "helix_angle_deg=-20",
     "tip_diameter=56", "root_diameter=47"),
    ("ratio", "ratio=3.2", "module=2"),
    ("ratio", "ratio=12.37", "stages=2"),
    ("gear-pair", "practicum_pair", "speed_rpm=300"),
    ("gear-pair", *PAIR),
    ("gear-pair", *PAIR, "helix_angle_deg=30", "working_centre_distance=125", "second.profile_shift_coefficient=0"),
    ("gear-pair", *PAIR, "helix_angle_deg=-30", "first.profile_shift_coefficient=0.09809", "side_clearance_class=C"),
    ("gear-pair", *PAIR, "working_centre_distance=109", "normal_backlash=0.1"),
    ("gear-pair", *PAIR, "working_centre_distance=109.2", "normal_backlash=0.5", "profile_shift_coefficient=0.2"),
    ("gear-pair", *PAIR, "circumferential_backlash=0.1", "first.profile_shift_coefficient=0.4",
     "thinning_method=deeper_cut"),
    ("gear-pair", "module=2", "first.number_of_teeth=150", "second.number_of_teeth=8", "tip_chamfer=0.1"),
    ("gear-pair", *PAIR, "first.cutter.number_of_teeth=20", "first.profile_shift_coefficient=0.4"),
    ("gear-pair", "module=1", "first.number_of_teeth=30", "second.number_of_teeth=11", "helix_angle_deg=30"),
    ("gear-pair", "module=1", "first.number_of_teeth=16", "second.number_of_teeth=40"),
    ("strength", "practicum_pair", "torque=100"),
    ("shift-choice", "first.number_of_teeth=17", "second.number_of_teeth=33", "module=2",
     "working_centre_distance=51.5"),
    ("shift-choice", "first.number_of_teeth=17", "second.number_of_teeth=31", "module=2", "helix_angle_deg=25",
     "face_width=16", "least_contact_ratio=2.2", "least_tip_thickness=0.45", "working_centre_distance=54.5"),
    ("involute",),
    ("involute", "angle_deg=26.9"),
    ("involute", "involute=0.037985"),
    ("worm", *THESIS_WORM, "number_of_teeth=128", "form_factor=1.26"),
    ("worm", *THESIS_WORM, "number_of_teeth=106", "form_factor=1.27"),
    ("worm", "module=2", "number_of_starts=4", "number_of_teeth=40", "diameter_quotient=8", "form=ZK1", "face_width=12",
     "profile_shift_coefficient=0.5", "power=300", "speed_rpm=1400", "form_factor=1.5", "friction_coefficient=0.08",
     "worm_length=20"),
    ("worm", "module=4", "number_of_teeth=40", "wheel_torque=200", "speed_rpm=960", "friction_coefficient=0.05"),
    ("cam", "practicum_flat_cam"),
    ("cam", "practicum_flat_cam", "drawn.length=120", "drawn.greatest_ordinate=76", "drawn.pole_1=40",
     "drawn.pole_2=30", "drawn.axis=40.5"),
    ("cam", "practicum_roller_cam", "drawn.length=130", "drawn.greatest_ordinate=60", "drawn.pole_1=45",
     "drawn.pole_2=35", "drawn.axis=50"),
    ("cam", "guidelines_cam", "step=2.5"),
    ("cam", "practicum_roller_cam"),
    ("cam", "linkage_cam"),
    ("cycloidal", "cycloidal_reducer"),
    ("cycloidal-gear", "clock_gears", "part=wheel"),
    ("lantern", "lantern_pair"),
    ("geneva", "geneva_drive", "part=wheel"),
    ("ratchet", "ratchet", "part=wheel", "torque=20"),
    ("ratchet", "ratchet", "part=ring"),
    ("spline", "size=d-6x23x26", "torque=150", "length=30"),
    ("involute-spline", "size=45x2", "torque=500", "length=40", "clearance=0.05"),
    ("involute-spline", "size=20x1", "root=fillet", "pin_diameter=2.2"),
    ("thread", "thread=M20x1.5-6g-LH"),
    ("sprocket", "chain=16A-2", "number_of_teeth=18"),
    ("sprocket", "pitch=12.7", "roller_diameter=8.51", "face_width=5", "number_of_teeth=9", "form=0.5",
     "tip_diameter=41"),
    ("sprocket", "chain_drive", "part=printed_pinion"),
    ("sprocket", "chain=ANSI 80", "tooth_form=ANSI B29.1", "number_of_teeth=17"),
    ("chain", "chain_drive", "part=pinion", "speed_rpm=300", "power=1500"),
    ("chain", "chain_drive", "part=printed_pinion", "torque=20"),
    ("pulley", "belt=T5", "number_of_teeth=20", "clearance=0.05"),
    ("pulley", "belt_drive", "part=wheel"),
    ("pulley", "belt=AT5", "number_of_teeth=30", "outer_diameter=46.5"),
    ("belt", "belt_drive", "speed_rpm=600", "torque=0.4"),
    ("belt", "belt=5M", "number_of_teeth=20", "mate_number_of_teeth=40", "centre_distance=180", "speed_rpm=1450",
     "power=500"),
    ("noncircular", "oval_gears", "part=oval", "profile_shift_coefficient=0.2"),
    ("power-table", "x=50", "y=-80", "orientation=thesis"),
    ("power-table", "arms=[72,50]", "x=-30", "y=40"),
    ("lever", "code=1071"),
    ("lever", "assignment=4", "masses.1=3", "centres.1=20", "centre_offsets.2=9", "masses.2=8", "inertias.2=0.05",
     "masses.5=40", "resistance=2000", "drive_radius=120", "acceleration=5"),
    ("power-module", "orientation=thesis"),
    ("power-module", "load=2000", "loaded_turns=1", "arms=[72,60]"),
]  # fmt: skip


def sheet_for(words: str | tuple[str, ...]) -> Sheet:
    """The sheet of a calculation, made once; a value of several words makes a tuple of them."""
    return _sheet(*(words.split() if isinstance(words, str) else words))


@cache
def _sheet(topic: str, *rest: str) -> Sheet:
    return sheet_of(topic, rest)[0]


@cache
def values_of(words: str) -> dict[str, Any]:
    """The json of a calculation."""
    return json.loads(render(sheet_for(words), "json", "en"))


@cache
def tables_of(words: str) -> dict[str, Any]:
    """The json of a choice of shifts by tables alone: what is sought, and the contour, take a hundred times as long."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(shift_choice, "_found_choices", lambda *given: [])
        patch.setattr(shift_choice, "usual_box", lambda pair: None)
        return json.loads(render(sheet_of("shift-choice", words.split()[1:])[0], "json", "en"))


def ident(words: tuple[str, ...]) -> str:
    return " ".join(words)


@pytest.mark.parametrize(
    "case",
    PRACTICUM,
    ids=lambda c: f"{c['id']} {c['name']} {c.get('gear', '')}",
)
def test_the_practicum_and_the_guidelines(case: dict[str, Any]) -> None:
    data = (tables_of if case["words"].startswith("shift-choice") else values_of)(case["words"])
    found = data["values"][case["name"]]
    found = found[case["gear"]] if "gear" in case else found
    assert found == pytest.approx(case["recomputed"], rel=1e-12)
    steps = [s for s in data["steps"] if (s["name"], s.get("gear")) == (case["name"], case.get("gear"))]
    if case.get("misprint"):
        assert case["printed"].split()[0] in steps[0]["misprint"]


def test_what_a_student_measured_on_the_disk_stands_beside_the_profile() -> None:
    """Lesson 1, 3.2, 9: thicknesses and space widths by the formulas of tables 1.1 and 1.2; z 10, m 10, xi 7/17."""
    words = "tmm42 module=10 reference_diameter=100"
    told = values_of(f"{words} measured.e_t1=15.8 measured.S_t1=15.5 measured.S_t2=18.8 measured.e_t2=12.5")["measured"]
    alpha, pitch = math.radians(20), 10 * math.pi
    thick = pitch / 2 + 2 * 10 * 7 / 17 * math.tan(alpha)
    right = {"S_t1": (15.5, pitch / 2), "e_t1": (15.8, pitch / 2), "P_t1": (31.3, pitch), "S_t2": (18.8, thick),
             "e_t2": (12.5, pitch - thick), "P_t2": (31.3, pitch)}  # fmt: skip
    assert [row["quantity"] for row in told] == [*right]
    for row, (length, exact) in zip(told, right.values(), strict=True):
        wanted = [length, exact, length - exact, 100 * (length / exact - 1)]
        assert [*row.values()][1:] == pytest.approx(wanted, rel=1e-9, abs=1e-9)
    # both halves of a pitch are needed for it, a pitch that was measured is kept
    assert [r["quantity"] for r in values_of(f"{words} measured.S_t2=18.5")["measured"]] == ["S_t2"]
    whole = values_of(f"{words} measured.S_t2=18.5 measured.e_t2=12.8 measured.P_t2=31.4")["measured"]
    assert [r["measured"] for r in whole] == [18.5, 12.8, 31.4]
    assert "measured" not in values_of(words)
    with pytest.raises(SceneError) as refused:
        sheet_for(f"{words} measured.W1=30")
    assert (refused.value.key, refused.value.code) == ("tmm42.measured.W1", "no_such_name")


@pytest.mark.parametrize(
    ("teeth", "table", "shortening"),
    [("13/21", "А.1", 0.16), ("12/50", "Б.1", 0.17), ("14/28", "А.1", 0.175), ("10/20", "Б.1", 0.15)],
)
def test_the_tables_shortening_is_told_and_taken(teeth: str, table: str, shortening: float) -> None:
    """The practicum takes the shortening from table А.1 or Б.1, rounded; here it is exact where none is given."""
    first, second = teeth.split("/")
    words = f"gear-pair first.number_of_teeth={first} second.number_of_teeth={second} module=10 shifts=practicum"
    plain, given = values_of(words), values_of(f"{words} tip_shortening_coefficient={shortening}")
    note = f"table {table} rounds Δy to {shortening:g}: tip_shortening_coefficient={shortening:g} takes that"
    assert note in plain["notes"]
    assert note not in given["notes"]
    assert plain["values"]["tip_shortening_coefficient"] == pytest.approx(shortening, abs=6e-4)
    step = next(s for s in given["steps"] if s["name"] == "tip_shortening_coefficient")
    assert (step["value"], step["source"]) == (shortening, f"practicum, table {table}")
    shift = given["values"]["profile_shift_coefficient"]["first"]
    tip = 10 * (int(first) / 2 + 1 + shift - shortening)
    assert given["values"]["tip_radius"]["first"] == pytest.approx(tip, rel=1e-12)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("case", [c for c in PRACTICUM if "table2_1" in c["id"]], ids=lambda c: c["id"])
def test_the_doubtful_rows_of_table_2_1_are_told_where_shifts_are_chosen(case: dict[str, Any]) -> None:
    """Printed alpha_w that the row's own shifts do not give: in the choice by that table, and at 20 degrees alone."""
    pair = " ".join(word for word in case["words"].split()[1:] if "shift" not in word)
    data = tables_of(f"shift-choice {pair}")
    mine = [s for s in data["steps"] if s["section"].endswith("least wear by table 2.1")]
    (angle,) = (s for s in mine if s["name"] == "working_pressure_angle_deg")
    assert angle["value"] == pytest.approx(case["recomputed"], rel=1e-12)
    assert (case["printed"] in angle.get("misprint", "")) == case.get("misprint", False)
    assert not any("misprint" in s for s in data["steps"] if s not in mine and s["name"] == angle["name"])
    other = case["words"].replace("module=1", "module=1 pressure_angle_deg=19.9")
    assert not [s for s in values_of(other)["steps"] if "misprint" in s]


def test_only_the_printed_pair_is_flagged() -> None:
    words = "gear-pair module=10 first.number_of_teeth=13 second.number_of_teeth=21 first.profile_shift_coefficient=0.7"
    assert not [s for s in values_of(words)["steps"] if "misprint" in s]


@pytest.mark.parametrize(("more", "flagged"), [
    ("", True), ("first.pressure_angle_deg=25 second.pressure_angle_deg=25", False),
    ("first.profile_shift_coefficient=0.3 second.profile_shift_coefficient=0.3", False),
])  # fmt: skip
def test_only_the_printed_internal_pair_is_flagged(more: str, flagged: bool) -> None:
    steps = values_of(f"gear-pair thesis_internal_pair {more}".strip())["steps"]
    names = {"contact_ratio", "pitch", "root_radius", "tip_radius"}
    assert {s["name"] for s in steps if "misprint" in s} == (names if flagged else set())


def test_a_number_that_the_source_prints_rightly_is_not_flagged() -> None:
    """The thesis's d_f and d_a2 follow from its c* = 0.2 and its 0.2 for the ring's tips: with those they are right."""
    data = json.loads((PUBLISHED / "power_module.json").read_text(encoding="utf-8"))
    printed = next(case["printed"] for case in data["cases"] if case["id"] == "004.gear.geometry")
    words = (
        "gear-pair thesis_internal_pair first.basic_rack.tip_clearance_coefficient=0.2 "
        f"second.tip_diameter={printed['d_a2_mm']} second.rounded_root.dedendum_coefficient=1.2"
    )
    for more, flagged in (("gear-pair thesis_internal_pair", True), (words, False)):
        steps = values_of(more)["steps"]
        for name, gear, key in (("root_radius", "first", "d_f1_mm"), ("root_radius", "second", "d_f2_mm"),
                                ("tip_radius", "second", "d_a2_mm")):  # fmt: skip
            step = next(s for s in steps if (s["name"], s.get("gear")) == (name, gear))
            assert (step["value"] == pytest.approx(printed[key] / 2)) == (not flagged)
            assert (f": {printed[key] / 2:g} ({key[:-3]} = {printed[key]:g}:" in step.get("misprint", "")) == flagged


def test_the_misprinted_inequality_and_left_side_are_named() -> None:
    told = calculate("tmm42", ["module=10", "number_of_teeth=10"], "text", "uk")
    assert "x_min ≤ x ≤ x_0,3" in told
    assert "x = 0: табл. 1.1\n" in told
    page = calculate("tmm42", ["module=10", "number_of_teeth=10"], "html", "uk")
    assert '<td class="f">x<sub>0,3</sub></td>' in page
    assert "<td>d<sub>Ff</sub></td>" in page
    assert "(3.4) prints alpha_w" in calculate("gear-pair", ["practicum_pair"], "text", None)


@pytest.mark.parametrize("words", ["lever code=1071", "gear-pair practicum_pair"])
def test_every_step_is_reached_by_its_name(words: str) -> None:
    """One by one off the page: the next one of each name."""
    data = values_of(words)
    taken: dict[tuple[str, str | None], int] = {}
    for step in data["steps"]:
        key = step["name"], step.get("gear")
        place = taken.setdefault(key, 0)
        rows = data["repeated"].get(key[0], data["values"][key[0]])
        row = rows if key[1] is None else rows[key[1]]
        assert (row[place] if isinstance(row, list) else row) == step["value"]
        taken[key] += 1
    assert {name for (name, _), count in taken.items() if count > 1} == set(data["repeated"])


def evaluated(step: Step, spoilt: float = 0.0) -> float:
    """A printed formula worked out with all digits; angles go in as radians. ``spoilt`` changes its first input."""
    names = {
        "cos": math.cos, "sin": math.sin, "tan": math.tan, "arccos": math.acos, "arctan": math.atan,
        "arcsin": math.asin,
        "sqrt": math.sqrt, "cbrt": math.cbrt, "abs": abs, "pi": math.pi, "inv": involute_function,
        "arcinv": inverse_involute, "ln": math.log, "lg": math.log10,
    }  # fmt: skip

    def value(match: re.Match[str]) -> str:
        known = step.inputs[match[1]]
        number = float(known.value) + spoilt * (match[1] == next(iter(step.inputs)))
        return f"({math.radians(number) if known.unit == 'deg' else number!r})"

    result = eval(KEYS.sub(value, step.formula), {"__builtins__": {}}, names)
    return math.degrees(result) if step.unit == "deg" else result


@pytest.mark.parametrize("words", SHEETS, ids=ident)
def test_every_printed_formula_gives_its_value(words: tuple[str, ...]) -> None:
    sheet = sheet_for(words)
    checked = [step for step in sheet.steps() if step.formula]
    few = {"cam": 4, "pulley": 2, "planetary": 4, "involute": 0, "spline": 3, "thread": 8, "ratio": 3}
    assert len(checked) >= few.get(words[0], 8)
    for step in checked:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-9, abs=1e-9), (step.name, step.formula)


def test_a_wrong_formula_would_be_noticed() -> None:
    sheet = sheet_for("gear-pair practicum_pair")
    wrong = [s for s in sheet.steps() if s.formula and evaluated(s, 1e-3) == pytest.approx(s.value, rel=1e-9)]
    assert [s.name for s in wrong] == []


def test_every_term_speaks_both_languages() -> None:
    for name, term in TERMS.items():
        told = words("uk").text(term.name)
        assert term.name.isascii(), name
        assert re.search(r"[а-яіїєґ]{3}", told), name
        assert not re.search(r"[ыэъё]", told), name


@pytest.mark.parametrize("asked", SHEETS, ids=ident)
def test_headings_notes_and_misprints_speak_both_languages(asked: tuple[str, ...]) -> None:
    sheet = sheet_for(asked)
    texts = [sheet.title, *(s.title for s in sheet.sections), *sheet.notes]
    texts += [s.printed.why for s in sheet.steps() if s.printed]
    for text in texts:
        en, uk = (words(one).say(text) for one in ("en", "uk"))
        assert not re.search(r"[а-яіїєґА-ЯІЇЄҐ]{2}", en), en
        assert re.search(r"[а-яіїєґА-ЯІЇЄҐ]{2}|\bз ", uk) or uk[0].isdigit() or "cos" in uk or "inv" in uk, uk


# points that name: equations, figures, tables and sections, threads; and those of keys as a scene has them
NAMED = r"\b[a-z]+_[a-z_]+ = \d+\.\d+|\(\d\.\d+\)|(рис|табл|пп)\. \d\.\d+(–\d\.\d+)?|таблиця 1\.\d|M20×1\.5"


def test_every_topic_has_a_sheet_here() -> None:
    assert {words[0] for words in SHEETS} == set(TOPICS)


@pytest.mark.sampled(5)
@pytest.mark.parametrize("topic", TOPICS)
@pytest.mark.parametrize("language", ["en", "uk"])
def test_every_format_of_every_topic(topic: str, language: str) -> None:
    sheet = sheet_for(" ".join(next(w for w in SHEETS if w[0] == topic)))
    made = {form: render(sheet, form, language) for form in SPOKEN}
    assert all(text.endswith("\n") for text in made.values())
    told = words(language)
    title = told.phrase(told.say(sheet.title))
    assert made["text"].startswith(title)
    # one mark in all that people read
    mark = "," if language == "uk" else "."
    assert all(re.search(rf"\d{mark}\d", made[form]) for form in ("text", "md", "html"))
    assert language == "uk" or not re.search(r"\d,\d", made["text"])
    assert made["md"].startswith(f"# {title}")
    assert f'<html lang="{language}">' in made["html"]
    # else a phone shows it as wide as a desk's screen, too small to read
    assert '<meta name="viewport" content="width=device-width, initial-scale=1">' in made["html"]
    # what is printed has the mark of its language, and true minus signs
    results = [html.unescape(cell) for cell in re.findall(r'<td class="r">(.*?)</td>', made["html"])]
    for result, step in zip(results, sheet.steps(), strict=True):
        if not isinstance(step.value, str):
            assert not re.search(r"-\d|\d\.\d" if language == "uk" else r"-\d|\d,\d", result), result
    for tag in ("html", "table", "tr", "td", "ul", "sub", "svg"):
        assert len(re.findall(rf"<{tag}[ >]", made["html"])) == made["html"].count(f"</{tag}>"), tag
    for note in map(told.phrase, map(told.say, sheet.notes)):
        assert note in made["text"]
        assert f"<li>{html.escape(note)}</li>" in made["html"]
    steps = list(sheet.steps())
    # tables stand behind them
    for step, row in zip(steps, re.findall(r"<tr><td>.*?</tr>", made["html"])[: len(steps)], strict=True):
        if not isinstance(step.value, str):
            result = html.unescape(re.findall(r'<td class="r">(.*?)</td>', row)[0])
            assert f"{result}\n" in made["text"]
            assert f"| {result} |" in made["md"]
    if language == "uk":
        lines = [re.sub(r" {2}\[.*\]$", "", line) for line in made["text"].splitlines()]
        assert [line for line in lines if re.search(r"\d\.\d", re.sub(NAMED, "", line))] == []
        # in words and pictures too, but for names of equations, figures, tables and sections; the last cell is a source
        shown = re.sub(r"<td>[^<]*(<span|</td></tr>)|<style>.*?</style>|<[^>]*>", " ", made["html"], flags=re.DOTALL)
        assert not re.search(r".{0,30}\d\.\d", re.sub(NAMED, "", html.unescape(shown)))
    data = json.loads(made["json"])
    assert len(data["steps"]) == len(sheet.steps())
    for step in data["steps"]:
        assert told.phrase(step["text"]) in made["text"]


def test_json_has_full_precision_and_design_names() -> None:
    values = values_of("gear-pair practicum_pair")["values"]
    assert values["working_centre_distance"] == pytest.approx(179.18263740574994, rel=1e-15)
    assert set(values["root_form_diameter"]) == {"first", "second"}


def test_a_kerf_that_was_forgotten_shows_in_span_and_pins() -> None:
    """An outline offset by half the kerf: an involute stays one, turned about its base circle."""
    plain = values_of("spur module=2 number_of_teeth=23 pin_diameter=3.5")["values"]
    cut = values_of("spur module=2 number_of_teeth=23 pin_diameter=3.5 kerf=0.2")["values"]
    assert cut["span_after_kerf"] == pytest.approx(plain["span"] - 0.2, rel=1e-12)
    # a pin in a space whose flanks lie 0.1 mm deeper sits as a pin thicker by 0.2 mm would, minus its own thickness
    thinner = values_of("spur module=2 number_of_teeth=23 pin_diameter=3.3")["values"]
    assert cut["over_pins_after_kerf"] == pytest.approx(thinner["over_pins"] + 0.2, rel=1e-12)


def test_a_kerf_that_leaves_a_pointed_tooth_or_drops_the_pin() -> None:
    """Sizes over pins need no tip: a thin one was refused by a key that does not exist; a wide cut, by the pin's."""
    keys = "spur module=0.5 pressure_angle_deg=25 number_of_teeth=9 profile_shift_coefficient=0.48"
    plain = values_of(keys + " pin_diameter=0.9")["values"]
    assert plain["tip_thickness"] < 0.1
    cut = values_of(keys + " pin_diameter=1.0 kerf=0.1")["values"]
    assert cut["over_pins_after_kerf"] == pytest.approx(plain["over_pins"] + 0.1, rel=1e-12)
    for asked in (keys, "ring module=2 number_of_teeth=63"):
        with pytest.raises(SceneError, match=r"kerf = 5\.0: .*at most ([\d.]+) mm works") as refused:
            calculate(asked.split()[0], [*asked.split()[1:], "kerf=5"], "text", "en")
        assert refused.value.nearest is not None
        values_of(f"{asked} kerf={refused.value.nearest.value}")


def test_the_scene_gives_the_language(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    scene = tmp_path / "pair.toml"
    scene.write_text(
        '[scene]\nlanguage = "uk"\n[parts.a]\nkind = "spur_gear"\nmodule = 2.0\nnumber_of_teeth = 23\n', "utf-8"
    )
    assert run("calc", "spur", scene) == 0
    assert "товщина зубця" in capsys.readouterr().out
    assert run("calc", "spur", scene, "--language", "en") == 0
    assert "tooth thickness" in capsys.readouterr().out


def refused(topic: str, *arguments: str) -> SceneError:
    """What ``higherpair calc`` refuses, as data."""
    options = dict(itertools.pairwise(arguments))
    given = {word for one in options if one.startswith("--") for word in (one, options[one])}
    with pytest.raises(SceneError) as caught:
        calculate(topic, [word for word in arguments if word not in given], options.get("--format", "text"),
                  options.get("--language"))  # fmt: skip
    return caught.value


@pytest.mark.parametrize(
    ("arguments", "key", "code", "nearest"),
    [
        (("spr",), "TOPIC", "unknown_topic", "spur"),
        (("spur", "module=2"), "spur.number_of_teeth", "missing_key", None),
        (("spur", "module=2", "number_of_teth=20"), "spur.number_of_teth", "unknown_key", "number_of_teeth"),
        (("spur", "module=2", "number_of_teeth=two"), "spur.number_of_teeth", "wrong_type_of", None),
        (("spur", "module=2", "module=3"), "module", "given_twice", None),
        (("spur", "module=2", "number_of_teeth=20", "--format", "pdf"), "--format", "not_one_of", None),
        (("spur", "module=2", "number_of_teeth=20", "--language", "de"), "--language", "not_one_of", None),
        (("spur", "module=2", "number_of_teeth=20", "--language", "eng"), "--language", "not_one_of", "en"),
        (
            ("spur", "module=2", "number_of_teeth=20", "profile_shift_coefficient=3"),
            "spur.profile_shift_coefficient",
            "flanks_meet_below_form",
            1.2223,
        ),
        (("spur", "module=2", "number_of_teeth=20", "teeth_spanned=21"), "spur.teeth_spanned", "span_beyond_teeth", 20),
        (("spur", "module=2", "number_of_teeth=20", "diameter=30"), "spur.diameter", "inside_base_circle", 37.5878),
        (
            ("spur", "module=2", "number_of_teeth=20", "pin_diameter=0.01"),
            "spur.pin_diameter",
            "pin_falls_through",
            2.392,
        ),
        (
            ("ring", "module=2", "number_of_teeth=60", "spaces_spanned=61"),
            "ring.spaces_spanned",
            "span_beyond_teeth",
            60,
        ),
        (("ring", "module=2", "number_of_teeth=60", "diameter=100"), "ring.diameter", "inside_base_circle", 112.7632),
        (
            ("ring", "module=2", "number_of_teeth=60", "pin_diameter=5"),
            "ring.pin_diameter",
            "pin_beyond_base_circle",
            4.6327,
        ),
        (
            ("ring", "module=2", "number_of_teeth=60", "spaces_spanned=7", "measured_span=40"),
            "ring.measured_span",
            "below_nominal",
            40.0584,
        ),
        (
            ("ring", "module=1", "number_of_teeth=40", "pin_diameter=1.7", "measured_between_pins=37.59"),
            "ring.measured_between_pins",
            "below_nominal",
            37.5952,
        ),
        (
            ("spur", "module=1", "number_of_teeth=20", "pin_diameter=1.7", "measured_over_pins=22.3"),
            "spur.measured_over_pins",
            "above_nominal",
            22.294,
        ),
        (
            ("rack", "module=2", "number_of_teeth=12", "pin_diameter=3.5", "measured_over_pin=100"),
            "rack.measured_over_pin",
            "above_nominal",
            10.0509,
        ),
        (
            ("rack", "module=2", "number_of_teeth=12", "pin_diameter=3.5", "measured_over_pin=8.4"),
            "rack.measured_over_pin",
            "pin_falls_through",
            8.5,
        ),
        (
            ("ring", "module=2", "number_of_teeth=60", "helix_angle_deg=10", "measured_span=40"),
            "ring.measured_span",
            "no_span_of_helical_ring",
            None,
        ),
        (("spur", "module=nan", "number_of_teeth=20"), "spur.module", "not_finite", None),
        (("spur", "practicum_pair"), "parts", "choose_a_part", None),
        (("spur", "practicum_pair", "part=pinon"), "part", "no_such_part", "pinion"),
        (("spur", "no_such_scene.toml"), "", "no_such_scene", None),
        (("spur", "no_such_scene"), "no_such_scene", "neither_scene_nor_key", None),
        # a ratio as people write it, with its key and without
        (("ratio", "1:4"), "1:4", "neither_scene_nor_key", "ratio=0.25"),
        (("ratio", "ratio=3 : 4"), "ratio.ratio", "wrong_type_of", 0.75),
        # two numbers are asked for there
        (("spur", "2"), "2", "neither_scene_nor_key", None),
        (("spur", "practicum_pair", "laser_gear"), "laser_gear", "one_scene_only", None),
        (("spur", "module", "=", "2", "number_of_teeth=23"), "module = 2", "write_key_value", None),
        (("spur", "number_of_teeth=23", "module=", "2"), "module= 2", "write_key_value", None),
        (("power-table", "power_table_laser"), "TOPIC", "keys_not_a_scene", None),
        (("tmm42", "module=10", "reference_diameter=101"), "tmm42.reference_diameter", "no_whole_modules", 100.0),
        (("tmm42", "module=10"), "tmm42.reference_diameter", "give_it_or", None),
        (
            ("tmm42", "module=10", "reference_diameter=100", "number_of_teeth=11"),
            "tmm42.number_of_teeth",
            "teeth_of_disk",
            None,
        ),
        (("gear-pair", "module=2"), "gear-pair.first.number_of_teeth", "missing_key", None),
        (
            ("gear-pair", *PAIR, "working_center_distance=100"),
            "gear-pair.working_center_distance",
            "unknown_key",
            "working_centre_distance",
        ),
        (
            ("gear-pair", *PAIR, "working_centre_distance=90"),
            "gear-pair.working_centre_distance",
            "no_working_angle",
            105.8727,
        ),
        (("gear-pair", *PAIR, "side_clearance_class=F"), "gear-pair.side_clearance_class", "not_allowed", None),
        (
            ("gear-pair", *PAIR, "normal_backlash=0.1", "side_clearance_class=C"),
            "gear-pair.normal_backlash",
            "other_is_given",
            None,
        ),
        (("gear-pair", *PAIR, "second.module=4"), "gear-pair.second.module", "not_that_of_first", 3.0),
        (("gear-pair", *PAIR, "first.tip_diameter=80"), "gear-pair.first.tip_diameter", "tooth_pointed", 44.414),
        (("gear-pair", *PAIR, "kind=external"), "gear-pair.kind", "unknown_pair", "external_gear_pair"),
        (("gear-pair", *PAIR, "measured_arc_of_action=1"), "gear-pair.measured_arc_of_action", "needs_other", None),
        (("gear-pair", "laser_gear"), "mates", "no_gear_pair", None),
        (("cam", "practicum_flat_cam", "drawn.length=120"), "cam.drawn.greatest_ordinate", "missing_key", None),
        (
            (
                "cam",
                "print_cam_set",
                "part=swing_cam",
                "drawn.length=120",
                "drawn.greatest_ordinate=76",
                "drawn.pole_1=40",
                "drawn.pole_2=40",
            ),
            "cam.drawn.length",
            "drawn_is_one_translating_rise",
            None,
        ),
        (
            (
                "train",
                "meshes=1-2, 2-3 internal",
                "teeth=[20,30,80]",
                "carriers.H=2",
                "speeds.1=100",
                "speeds.3=-20",
                "counted_turns=1",
            ),
            "train.counted_turns",
            "of_one_driver",
            None,
        ),
        (("gear-pair", "practicum_pair", "mate=2"), "mate", "no_such_pair", 1),
        # before: a traceback
        (("power-table", "path=[[30,20,60,20,1e300]]"), "power-table.path[1][5]", "not_allowed", None),
        # q is at most 1000; before: no whole outline, in English whatever the language
        (("worm", "module=2", "lead_angle_deg=0.01"), "worm.lead_angle_deg", "out_of_range", 0.0573),
        (("shift-choice", "first.number_of_teeth=13"), "shift-choice.second", "missing_key", None),
        (
            ("shift-choice", "first.number_of_teeth=13", "second.number_of_teeth=21", "face_width=9"),
            "shift-choice.face_width",
            "of_helical_gears_alone",
            0.0,
        ),
        (
            ("shift-choice", "first.number_of_teeth=13", "second.number_of_teeth=21", "double_helical=true"),
            "shift-choice.double_helical",
            "of_helical_gears_alone",
            False,
        ),
        (
            ("shift-choice", "first.number_of_teeth=13", "second.number_of_teeth=21", "basic_rack=ISO"),
            "shift-choice.basic_rack",
            "not_allowed",
            "ISO 53 D",
        ),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, tuple) else "",
)
def test_wrong_input_gets_one_clear_line(
    arguments: tuple[str, ...], key: str, code: str, nearest: object, capsys: pytest.CaptureFixture[str]
) -> None:
    told = refused(*arguments)
    assert (told.key, told.code, told.nearest and told.nearest.value) == (key, code, nearest)
    assert complaint(capsys, "calc", *arguments) == f"higherpair: {told}\n"


@pytest.mark.parametrize(
    ("key", "value", "code"),
    [
        ("first.profile_shift_coefficient", 6.94, "no_involute_below_tip"),
        ("first.profile_shift_coefficient", 2.776, "flanks_meet_below_form"),
        ("first.circumferential_thinning", 1000.0, "fillets_meet"),
        ("second.circumferential_thinning", 1000.0, "flanks_meet_below_form"),
        # before: nothing was offered, as what the tooth may have alone, -1.2161, has no distance to its mate
        ("first.profile_shift_coefficient", -10.0, "leaves_no_flank"),
        ("second.profile_shift_coefficient", -3.0, "fillets_meet"),
    ],
)
def test_the_limit_of_a_tooth_is_that_with_the_tip_which_its_mate_leaves_it(key: str, value: float, code: str) -> None:
    """Before: that of the tooth alone, of 6.94 a shift of 0.8766, where beside the mate 1.3097 is made."""
    pair = "gear-pair module=10 first.number_of_teeth=13 second.number_of_teeth=21"
    told = refused(*pair.split(), f"{key}={value}")
    assert (told.key, told.code) == (f"gear-pair.{key}", code)
    assert told.nearest is not None
    most = told.nearest.value
    assert isinstance(most, float)
    values_of(f"{pair} {key}={most}")
    # a thousandth of the module farther in mm, of a coefficient in modules
    step = math.copysign(1e-3 if key.endswith("coefficient") else 1e-2, value)
    refused(*pair.split(), f"{key}={most + step}")


def test_a_helical_pair_is_refused_in_the_normal_terms_that_were_typed() -> None:
    """Before: shifts and angles of the transverse section, -1.22160040702 for -1.3, and at least -0.780958 of those."""
    pair = "gear-pair module=10 helix_angle_deg=20 first.number_of_teeth=13 second.number_of_teeth=21"
    told = refused(*pair.split(), "second.profile_shift_coefficient=-1.3")
    assert (told.key, told.value) == ("gear-pair.second.profile_shift_coefficient", -1.3)
    # inv(alpha_wt) = 0 where x cos(beta) = -(z1 + z2) inv(alpha_t) / (2 tan(alpha_t))
    angle = math.atan(math.tan(math.radians(20)) / math.cos(math.radians(20)))
    least = -17 * (math.tan(angle) - angle) / math.tan(angle) / math.cos(math.radians(20))
    assert told.nearest is not None
    assert isinstance(told.nearest.value, float)
    assert least <= told.nearest.value < least + 2e-4
    other = refused(*pair.split(), "first.pressure_angle_deg=25")
    assert (other.key, other.value, other.nearest) == ("gear-pair.second.pressure_angle_deg", 20.0, Nearest(25.0))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    "asked",
    [
        # tips on the axis; before: a traceback
        "shift-choice first.number_of_teeth=18 second.kind=ring_gear second.number_of_teeth=63 "
        "first.profile_shift_coefficient=-10",
        # a wheel beside its worm; before: a warning of NumPy
        "worm module=5 number_of_teeth=40 wheel_axial_error=-100",
    ],
)
def test_what_touches_nothing_is_told_without_a_traceback_or_a_warning(asked: str) -> None:
    values_of(asked)


def test_what_is_offered_for_an_element_of_a_list_has_been_tried() -> None:
    """Before: return_ in place of a rise for the whole turn, and then the rise in place of that."""
    cam = ("cam", "follower=roller", "lift=20", "follower_radius=8", "base_circle_radius=40")

    def phases(*rows: tuple[str, float]) -> str:
        told = (f'{{move="{move}",angle_deg={angle},law="sine"}}' for move, angle in rows)
        return f"phases=[{','.join(told)}]"

    for move in ("rise", "return_"):
        told = refused(*cam, phases((move, 360.0)))
        assert (told.key, told.nearest) == ("cam.phases[1].move", None)
    told = refused(*cam, phases(("rise", 150.0), ("return_", 150.0)))
    assert (told.key, told.nearest) == ("cam.phases[2].angle_deg", Nearest(210.0))
    calculate(cam[0], [*cam[1:], phases(("rise", 150.0), ("return_", 210.0))], "json", "en")


def test_a_shift_table_cell_that_was_mended_is_flagged() -> None:
    # the sheet that is there already
    data = values_of(" ".join(next(words for words in SHEETS if words[0] == "shift-choice")))
    flagged = [s for s in data["steps"] if "misprint" in s]
    assert [s["value"] for s in flagged] == [0.487]
    assert "0.951 / 0.459" in flagged[0]["misprint"]
    assert {line["name"] for line in data["blocking_contour"]} >= {"undercut_first", "contact_ratio", "equal_sliding"}


HELICAL = "number_of_teeth=17 second.number_of_teeth=31 module=2 helix_angle_deg=25"


def test_shifts_of_a_helical_pair_are_those_that_its_own_calculation_has() -> None:
    """Each choice laid before ``calc gear-pair``: distance, both contact ratios, tips and sliding."""
    data = values_of(" ".join(next(words for words in SHEETS if "least_contact_ratio=2.2" in words)))
    assert len(data["choices"]) == 3
    steps = {}
    for step in data["steps"]:
        steps[step["section"].partition(".")[0], step["name"], step.get("gear")] = step["value"]
    for number, choice in enumerate(data["choices"], 1):
        x1, x2 = choice["profile_shift_coefficient"].values()
        shifts = f"first.profile_shift_coefficient={x1!r} second.profile_shift_coefficient={x2!r}"
        own = values_of(f"gear-pair first.{HELICAL} face_width=16 {shifts}")["values"]
        for name in ("working_centre_distance", "contact_ratio", "total_contact_ratio", "working_pressure_angle_deg"):
            assert steps[str(number), name, None] == pytest.approx(own[name], rel=1e-9)
        assert own["total_contact_ratio"] >= 2.2 - 1e-9
        for who in ("first", "second"):
            assert steps[str(number), "tip_thickness", who] == pytest.approx(own["tip_thickness"][who], rel=1e-9)
            assert own["tip_thickness"][who] >= 2 * 0.45 - 1e-9
            if number != 2:
                assert steps[str(number), "root_sliding", who] == pytest.approx(own["root_sliding"][who], rel=1e-6)
    assert own["working_centre_distance"] == pytest.approx(54.5, abs=1e-6)
    # ISO 21771: h_Ff is where the rounding of the normal rack begins, and z sin^2(alpha_t) / (2 cos(beta)) the base's
    beta, least = math.radians(25), 1.25 - 0.38 * (1 - math.sin(math.radians(20)))
    sine = math.sin(math.atan(math.tan(math.radians(20)) / math.cos(beta)))
    for who, z in (("first", 17), ("second", 31)):
        value = steps["Given", "least_shift_without_undercut", who]
        assert value == pytest.approx(least - z * sine**2 / (2 * math.cos(beta)), abs=1e-12)


def test_a_scene_tells_its_helix_and_the_face_that_both_gears_have() -> None:
    given = [s for s in tables_of("shift-choice helical_pair")["steps"] if s["section"] == "Given"]
    told = {s["name"]: s["value"] for s in given}
    assert (told["helix_angle_deg"], told["face_width"]) == (25.0, 16.0)
    assert told["overlap_ratio"] == pytest.approx(16 * math.sin(math.radians(25)) / (2 * math.pi), rel=1e-12)
    assert "helix_angle_deg" not in tables_of("shift-choice helical_pair helix_angle_deg=0")["values"]


@pytest.mark.parametrize(
    ("words", "typed"),
    [
        ("spline spline_joint", "spline size=d-6x23x26"),
        ("spline spline_joint part=gear torque=80 length=9", "spline size=d-6x23x26 clearance=0.15 torque=80 length=9"),
        ("involute-spline spline_joint part=hub", "involute-spline size=20x1 clearance=0.12"),
    ],
)
def test_a_scene_tells_its_splines_of_a_shaft_and_of_bores(words: str, typed: str) -> None:
    assert values_of(words) == values_of(typed)


def test_splines_of_several_joints_are_chosen_by_their_part(tmp_path: Path) -> None:
    scene = tmp_path / "s.toml"
    gears = "\n".join(
        f'[parts.{name}]\nkind = "spur_gear"\nmodule = 3.0\nnumber_of_teeth = 30\n'
        f'bore = {{ shape = "spline", size = "{size}" }}'
        for name, size in (("a", "6x23x26"), ("b", "6x28x32"), ("c", "6x23x26"))
    )
    scene.write_text(gears, "utf-8")
    with pytest.raises(SceneError) as refused:
        calculate("spline", [str(scene)], "text", "en")
    assert (refused.value.code, refused.value.numbers["known"]) == ("choose_a_part", ["a", "b"])
    assert values_of(f"spline {scene} part=b")["values"]["spline_outer_diameter"] == 32.0
    # of a shaft with two the first
    steps = (f'{{ diameter = {d}, length = 30, spline = {{ shape = "spline", size = "{size}" }} }}'
             for d, size in ((26, "6x23x26"), (32, "6x28x32")))  # fmt: skip
    scene.write_text(f'[parts.s]\nkind = "shaft"\nsteps = [{", ".join(steps)}]', "utf-8")
    assert values_of(f"spline {scene}")["values"]["spline_outer_diameter"] == 26.0


def test_the_picture_is_written_in_the_language(tmp_path: Path) -> None:
    file = tmp_path / "contour.svg"
    words = ["first.number_of_teeth=17", "second.number_of_teeth=33", f'picture="{file.as_posix()}"']
    calculate("shift-choice", words, "text", "uk")
    text = file.read_text(encoding="utf-8")
    assert text.startswith("<svg")
    assert "однакове ковзання" in text
    assert text.count("<polyline") >= 8


def test_both_wheels_of_the_device_are_compared() -> None:
    # m 16, z 10: the shift xi = 7/17 makes S_t thicker by 2 x m tan 20 degrees, at 40 digits
    table = json.loads(calculate("tmm42", ["module=16", "reference_diameter=160"], "json", "en"))
    rows = {name: values for name, *values in (row.values() for row in table["comparison"])}
    assert set(rows) == {"S_t", "e_t", "P_t", "S_b", "S_a", "d_Ff"}
    assert rows["S_t"][2] == pytest.approx(4.795843086801725, rel=1e-12)
    assert rows["e_t"][2] == pytest.approx(-rows["S_t"][2], rel=1e-12)
    assert all(shifted - zero == pytest.approx(more, abs=1e-12) for zero, shifted, more in rows.values())


def test_a_formula_cannot_use_what_is_not_known_yet() -> None:
    page = Sheet("x", "x")
    page.section("x")
    with pytest.raises(KeyError, match="not known yet"):
        page.add("pitch", 1.0, "pi * {m}")


@pytest.mark.parametrize("teeth", [24, 25])
def test_helical_gears_are_measured_over_balls_and_told_when_pins_do(teeth: int) -> None:
    sheet = sheet_for(f"spur module=2 number_of_teeth={teeth} helix_angle_deg=20")
    names = {s.name for s in sheet.steps()}
    assert "over_balls" in names
    assert {name for name in names if {"pin", "pins"} & set(name.split("_"))} == (
        {"over_opposite_pins"} if teeth % 2 else set()
    )
    assert "Over balls" in [s.title for s in sheet.sections]
    notes = " ".join(words("en").say(note) for note in sheet.notes)
    assert ("same M" in notes) == (teeth % 2 == 0)
    assert ("M_p for pins" in notes) == (teeth % 2 == 1)
    straight = {s.name for s in sheet_for(f"spur module=2 number_of_teeth={teeth}").steps()}
    assert "over_pins" in straight
    assert "over_balls" not in straight


@pytest.mark.parametrize(("width", "word"), [(2.0, "too small"), (7.0, "little hold"), (30.0, "")])
def test_a_face_too_narrow_for_the_span_is_told(width: float, word: str) -> None:
    """W sin(beta_b) by hand: beta_b = asin(sin 20 cos 20), W from the sheet."""
    sheet = sheet_for(f"spur module=2 number_of_teeth=24 helix_angle_deg=20 face_width={width}")
    values = {s.name: s.value for s in sheet.steps()}
    beta_b = math.asin(math.sin(math.radians(20)) * math.cos(math.radians(20)))
    least = float(values["span"]) * math.sin(beta_b)
    assert values["least_face_width"] == pytest.approx(least, rel=1e-12)
    assert float(values["secure_face_width"]) > least
    notes = " ".join(words("en").say(note) for note in sheet.notes)
    told = [w for w in ("too small", "little hold") if w in notes]
    assert told == ([word] if word else [])


def test_a_pin_in_a_helical_space_touches_where_a_ball_does() -> None:
    """The axis of a pin, along the screw line of the ball's centre, is at right angles to the flank's normal there."""
    import numpy as np

    module, teeth, beta, size = 2.0, 24, math.radians(20), 3.5
    alpha = math.atan(math.tan(math.radians(20)) / math.cos(beta))
    base = module / math.cos(beta) * teeth / 2 * math.cos(alpha)
    lead = math.pi * module * teeth / math.sin(beta)
    values = {s.name: s.value for s in sheet_for(
        "spur module=2 number_of_teeth=24 helix_angle_deg=20 pin_diameter=3.5").steps()}  # fmt: skip
    centre = np.array([float(values["ball_centre_diameter"]) / 2, 0.0, 0.0])
    screw = 2 * math.pi / lead

    def flank(u: float, z: float) -> np.ndarray:
        # an involute of the base circle, turned so that the ball touches it, carried along the helix
        point = base * np.exp(1j * (u + start)) * (1 - 1j * u) * np.exp(1j * screw * z)
        return np.array([point.real, point.imag, z])

    def nearest(angle: float) -> tuple[float, np.ndarray, np.ndarray]:
        nonlocal start
        start = angle
        u, z = 0.4, 0.0
        for _ in range(60):
            at = flank(u, z)
            du, dz = (flank(u + 1e-6, z) - at) / 1e-6, (flank(u, z + 1e-6) - at) / 1e-6
            step, *_ = np.linalg.lstsq(np.column_stack([du, dz]), centre - at, rcond=None)
            u, z = u + 0.7 * step[0], z + 0.7 * step[1]
        at = flank(u, z)
        return float(np.linalg.norm(centre - at)), at, centre - at

    start, touched = 0.0, []
    gaps = [(a, nearest(a)[0] - size / 2) for a in np.linspace(-1.2, 0.6, 73)]
    for (one, before), (two, after) in itertools.pairwise(gaps):
        if before * after > 0:
            continue
        for _ in range(40):
            middle = (one + two) / 2
            same = (nearest(middle)[0] > size / 2) == (before > 0)
            one, two = (middle, two) if same else (one, middle)
        gap, at, normal = nearest(one)
        axis = np.array([0.0, screw * centre[0], 1.0])
        assert abs(float(axis @ normal)) / np.linalg.norm(axis) / gap < 1e-5
        touched.append(math.hypot(at[0], at[1]))
    # the tooth beside the ball is touched from the outside, and once from within
    wanted = float(values["ball_contact_diameter"]) / 2
    assert min(abs(t - wanted) for t in touched) < 1e-5


@pytest.mark.parametrize("row", RINGS["rings"], ids=lambda r: f"z{r['number_of_teeth']}")
def test_a_ring_is_measured_as_in_the_reports_of_a_wind_turbine(row: dict[str, Any]) -> None:
    """KISSsoft's reports of the NREL 5 MW gearbox: span over spaces, size between pins, chord; thinned too."""
    keys = f"module={row['module']} number_of_teeth={row['number_of_teeth']} profile_shift_coefficient={row['x']}"
    asked = f"ring {keys} tip_diameter={row['tip_diameter']} pin_diameter={row['pin']}"
    for thinning, printed in ((0.0, row), *((one["thinning"], one) for one in row["allowances"])):
        values = values_of(f"{asked} circumferential_thinning={thinning}")["values"]
        assert values["spaces_spanned"] == row["spaces"]
        for name, key in (
            ("span_over_spaces", "span"),
            ("between_pins", "between_pins"),
            ("chordal_thickness", "chord"),
        ):
            assert values[name] == pytest.approx(printed[key], abs=5.1e-4), name
    assert values["best_pin_diameter"] == pytest.approx(row["best_pin"], abs=5.1e-4)
    assert values["span_nominal"] == pytest.approx(row["span"], abs=5.1e-4)
    assert values["between_pins_nominal"] == pytest.approx(row["between_pins"], abs=5.1e-4)


@pytest.mark.parametrize("undercut", ["x=-0.476 alpha=14.5", "x=-0.476 alpha=14.5 thinning=0.03", "x=-0.6 alpha=20"])
def test_a_pin_that_nobody_asked_for_touches_the_involute(undercut: str) -> None:
    """Where d + 2 x m lies in the undercut the pin that would touch there touches nothing, and none may be sunk."""
    long = {"x": "profile_shift_coefficient", "alpha": "pressure_angle_deg", "thinning": "circumferential_thinning"}
    keys = " ".join(f"{long[k]}={v}" for k, v in (word.split("=") for word in undercut.split()))
    values = values_of(f"spur module=0.808 number_of_teeth=11 {keys}")["values"]
    assert values["over_pins"] > values["tip_diameter"]
    assert values["best_pin_diameter"] < values["least_pin_diameter"]
    assert values["root_form_diameter"] < values["pin_contact_diameter"] < values["tip_diameter"]


def test_a_ring_cut_without_correction_is_wider() -> None:
    plain = values_of("ring module=2 number_of_teeth=60 pin_diameter=3.3")["values"]
    cut = values_of("ring module=2 number_of_teeth=60 pin_diameter=3.3 kerf=0.2")["values"]
    assert cut["span_after_kerf"] == pytest.approx(plain["span_over_spaces"] + 0.2, rel=1e-12)
    # as outside: a pin that is thinner by the kerf would sit there, in a space whose flanks lie 0.1 mm deeper
    thinner = values_of("ring module=2 number_of_teeth=60 pin_diameter=3.1")["values"]
    assert cut["between_pins_after_kerf"] == pytest.approx(thinner["between_pins"] - 0.2, rel=1e-12)
    sawn = values_of("rack module=2 number_of_teeth=6 pin_diameter=3.3 kerf=0.2")["values"]
    thinner = values_of("rack module=2 number_of_teeth=6 pin_diameter=3.1")["values"]
    # the rack's back is lower by as much as the pin's top would stand higher
    assert sawn["over_pin_after_kerf"] == pytest.approx(thinner["over_pin"], rel=1e-12)


def test_a_helical_ring_is_measured_between_balls_alone() -> None:
    sheet = sheet_for("ring module=2 number_of_teeth=61 helix_angle_deg=20")
    names = {s.name for s in sheet.steps()}
    assert "between_balls" in names
    assert not names & {"span_over_spaces", "between_pins", "over_balls"}
    notes = " ".join(words("en").say(note) for note in sheet.notes)
    assert "no span" in notes
    assert "pins do not fit" in notes


def test_a_chord_beyond_the_tip_is_not_told() -> None:
    """A ring whose whole tooth stands outside its reference circle."""
    sheet = sheet_for("ring module=2 number_of_teeth=240 profile_shift_coefficient=1.5")
    assert not {s.name for s in sheet.steps()} & {"chordal_thickness", "constant_chord"}
    assert all(section.steps for section in sheet.sections)
    assert sum("beyond the tip" in words("en").say(note) for note in sheet.notes) == 2


@pytest.mark.parametrize("x", [-1.0, -1.2])
def test_the_greatest_shift_is_no_matter_of_the_gear_s_own(x: float) -> None:
    """Searched from a shift of -1 on, it was never found: the search did not end."""
    found = [
        values_of(f"spur module=1 number_of_teeth=60 profile_shift_coefficient={own}")["values"] for own in (0.0, x)
    ]
    greatest = [values["greatest_shift_for_tip_thickness"] for values in found]
    assert greatest[1] == pytest.approx(greatest[0], rel=1e-9)


# the JSON's name of each printed quantity of the thesis's worm drives
WORM_NAMES = {
    "T2_Nm": "wheel_torque", "m_mm": "thesis_least_module", "sigma_FP2_MPa": "allowed_bending_stress",
    "sigma_HP2_MPa": "allowed_contact_stress", "sigma_H_MPa": "thesis_contact_stress",
    "sigma_H_width_26_of_45_MPa": "contact_stress", "a_w_mm": "worm_centre_distance",
    "d1_mm": "worm_reference_diameter", "d2_mm": "wheel_reference_diameter", "d_w1_mm": "worm_pitch_diameter",
    "gamma_deg": "lead_angle_deg", "gamma_w_deg": "pitch_lead_angle_deg", "h1_mm": "thread_height",
    "h_a1_mm": "thread_addendum", "d_a1_mm": "worm_tip_diameter", "d_a2_mm": "throat_diameter",
    "d_ae2_mm": "most_outer_diameter", "rho_f1_mm": "worm_fillet_radius", "b1_min_mm": "least_worm_length",
    "b2_max_mm": "most_face_width", "gamma_b_deg": "base_lead_angle_deg", "d_b_mm": "worm_base_diameter",
    "cos_gamma_b": "base_lead_cosine", "b1_plus_25_mm": "ground_worm_length",
}  # fmt: skip
# what the thesis could have had with another width of the rim
WORM_WIDTHS = {"sigma_H_full_width_MPa": 45.0, "sigma_H_half_width_sqrt2_MPa": 22.5}


@pytest.mark.parametrize("drive", ["wormI.", "wormII."])
def test_every_number_of_the_thesis_worm_drives(drive: str) -> None:
    cases = json.loads((PUBLISHED / "worm_drives.json").read_text(encoding="utf-8"))["cases"]
    words = next(w for w in SHEETS if w[0] == "worm" and f"number_of_teeth={128 if drive == 'wormI.' else 106}" in w)
    data, seen = values_of(" ".join(words)), set()
    others = [word for word in words if not word.startswith("face_width")]
    wide = {key: values_of(" ".join([*others, f"face_width={b}"]))["values"] for key, b in WORM_WIDTHS.items()}
    misprinted = {step["name"] for step in data["steps"] if "misprint" in step}
    for case in (c for c in cases if drive in c["id"]):
        for key, value in case["recomputed"].items():
            if name := WORM_NAMES.get(key):
                assert data["values"][name] == pytest.approx(value, rel=1e-12), (case["id"], key)
            elif key in wide:
                assert wide[key]["contact_stress"] == pytest.approx(value, rel=1e-12), (case["id"], key)
            else:
                # the thesis has left the cosine out
                assert key == "m_without_cos_gamma_mm"
                cosine = math.cos(math.radians(data["values"]["lead_angle_deg"]))
                assert data["values"]["thesis_least_module"] / cosine ** (1 / 3) == pytest.approx(value, rel=1e-12)
            seen.add(key)
        if case["verdict"] == "misprint":
            assert {WORM_NAMES[k] for k in case["printed_text"]} <= misprinted, case["id"]
    assert seen == {*WORM_NAMES, *WORM_WIDTHS, "m_without_cos_gamma_mm"}


@pytest.mark.parametrize(("ball", "cure"), [("0.5", "at least 1.6833 mm"), ("30", "at most 4.8934 mm")])
def test_balls_that_touch_no_flank_of_a_worm_are_refused(ball: str, cure: str) -> None:
    words = ("module=2", "diameter_quotient=15.5")
    with pytest.raises(SceneError, match=f"worm.ball_diameter = .*{cure} works"):
        calculate("worm", (*words, f"ball_diameter={ball}"), "json", "en")
    near = cure.split()[2]
    assert "over_balls" in json.loads(calculate("worm", (*words, f"ball_diameter={near}"), "json", "en"))["values"]


@pytest.mark.parametrize(
    ("typed", "other"),
    [
        (("torque=5", "width_factor=1.2"), "form_factor"),
        (("torque=5", "tensile_strength=150"), "form_factor"),
        (("torque=5", "contact_life_factor=0.9"), "form_factor"),
        (("form_factor=1.3",), "torque"),
    ],
)
def test_what_the_strength_of_a_worm_wheel_takes_is_not_taken_in_vain(typed: tuple[str, ...], other: str) -> None:
    key = typed[-1].partition("=")[0]
    with pytest.raises(SceneError, match=f"worm.{key} = .*: needs {other} too"):
        calculate("worm", ("module=4", "number_of_teeth=40", *typed), "text", None)


@pytest.mark.parametrize(("topic", "size"), [("spline", "d-6x23x26"), ("involute-spline", "45x2")])
def test_the_share_of_the_sides_of_a_spline_is_not_taken_without_a_torque(topic: str, size: str) -> None:
    with pytest.raises(SceneError, match=rf"{topic}.load_share = 0.5: needs torque too"):
        calculate(topic, (f"size={size}", "length=30", "load_share=0.5"), "text", None)


def test_a_worm_is_told_by_its_lead_angle_as_in_scenes(capsys: pytest.CaptureFixture[str]) -> None:
    lead = math.degrees(math.atan2(2, 8))
    words = "worm module=2 number_of_starts=2 number_of_teeth=30"
    told, usual = (values_of(f"{words} {key}")["values"] for key in (f"lead_angle_deg={lead!r}", "diameter_quotient=8"))
    assert told.keys() == usual.keys()
    assert all(told[key] == pytest.approx(usual[key], rel=1e-12) for key in usual if key != "worm_form")
    # in place of the q of a scene
    assert values_of(f"worm worm_set_print lead_angle_deg={lead!r}")["values"]["worm_centre_distance"] == 38.0
    for key, said in (
        ("lead_angle_deg=12 diameter_quotient=10", "worm.diameter_quotient = 10.0: give either"),
        (
            "lead_angle_deg=50",
            "worm.lead_angle_deg = 50.0: leaves no core: the spaces of the thread reach the axis; at most 39.79",
        ),
        ("hob_diameter_quotient=9.5", "worm.hob_diameter_quotient = 9.5: must not be less than the worm's"),
    ):
        assert said in complaint(capsys, "calc", *f"{words} {key}".split())


def test_a_worm_drive_says_of_its_wheel_what_the_part_is_told() -> None:
    # before: a page of an undercut wheel, and of one that no hob leaves, held its peace
    wheel = {"module": 2.0, "number_of_teeth": 17, "diameter_quotient": 8.0}
    words = [f"{key}={value}" for key, value in wheel.items()]
    made = make_parts(scene_from_dict({"parts": {"wheel": {"kind": "worm_wheel", **wheel}}}, "s", "s"), "s")[0]["wheel"]
    (told,) = (finding_text("en", f) for f in made.findings if f.code == "worm_wheel_undercut")
    assert f"note: {told}" in calculate("worm", words, "text", "en")
    assert "undercut" not in calculate("worm", [*words, "profile_shift_coefficient=0.5"], "text", "en")
    wide = calculate("worm", ["module=2", "number_of_teeth=30", "face_width=30"], "text", "en")
    assert "note: such a wheel cannot be made, face_width = 30.0: " in wide
    assert "at most 21.6" in wide


def test_a_worm_drive_that_locks_itself_says_so() -> None:
    words = "worm module=5 number_of_teeth=40 torque=3 form_factor=1.5 friction_coefficient=0.12"
    assert values_of(words)["values"]["back_driving_efficiency"] == 0.0
    assert "self-locking" in calculate("worm", words.split()[1:], "text", "en")
    assert "самогальмівна" in calculate("worm", words.split()[1:], "text", "uk")
    # asked without any friction, the page tells from which on it would: a hair more locks, a hair less does not
    edge = values_of("worm module=5 number_of_teeth=40")["values"]["self_locking_friction"]
    for share, locked in ((1 - 1e-6, False), (1 + 1e-6, True)):
        words = f"worm module=5 number_of_teeth=40 friction_coefficient={edge * share}"
        assert (values_of(words)["values"]["back_driving_efficiency"] == 0.0) is locked
    words = "worm module=5 number_of_teeth=40 torque=3 form_factor=1.5 friction_coefficient=0.12"
    # four starts do not lock: the wheel pushes a wedge of that slope, held by friction
    free = values_of(f"{words} number_of_starts=4 diameter_quotient=8")["values"]
    slope, held = math.atan(4 / 8), math.atan(0.12 / math.cos(math.radians(20)))
    assert free["back_driving_efficiency"] == pytest.approx(math.tan(slope - held) / math.tan(slope), rel=1e-12)
    assert free["worm_efficiency"] == pytest.approx(math.tan(slope) / math.tan(slope + held), rel=1e-12)


def test_a_worm_pushes_its_wheel_as_a_wedge_that_slides() -> None:
    """Forces of a wedge of slope gamma held by friction, powers and speeds by the lead; strength is not asked for."""
    got = values_of(
        "worm module=4 number_of_teeth=40 number_of_starts=2 profile_shift_coefficient=0.5 friction_coefficient=0.04 "
        "power=2200 speed_rpm=1440"
    )["values"]
    radius, lead, turns = 22.0, 8 * math.pi, 24.0
    slope = math.atan(lead / (2 * math.pi * radius))
    around, along = got["worm_tangential_force"], got["worm_axial_force"]
    # at the pitch point z grows with r by 4 (tan - arctan)(sqrt(r^2 / r_b^2 - 1)), r_b by the involute thread of 20 deg
    base = math.acos(math.cos(math.radians(20)) * math.cos(math.atan(2 / 10)))
    drop = [4 * (t - math.atan(t)) for r in (21.999, 22.001) for t in (math.sqrt((r * math.tan(base) / 4) ** 2 - 1),)]
    normal = (drop[1] - drop[0]) / 0.002, math.tan(slope), 1.0
    sliding = 0.0, 0.04 * math.cos(slope), -0.04 * math.sin(slope)
    push = [n / math.hypot(*normal) + f for n, f in zip(normal, sliding, strict=True)]
    told = got["worm_radial_force"] / along, around / along
    assert told == pytest.approx((push[0] / push[2], push[1] / push[2]), rel=1e-7)
    assert around * 2 * math.pi * radius * turns == pytest.approx(2200e3, rel=1e-12)
    assert along * lead * turns == pytest.approx(1e3 * got["worm_power_out"], rel=1e-12)
    assert got["worm_sliding_speed"] == pytest.approx(turns * math.hypot(2 * math.pi * radius, lead), rel=1e-12)
    assert got["worm_wheel_speed"] == pytest.approx(1440 * 2 / 40, rel=1e-12)
    assert "contact_stress" not in got
    # the same drive by what its wheel has to give
    words = (
        "worm module=4 number_of_teeth=40 number_of_starts=2 profile_shift_coefficient=0.5 friction_coefficient=0.04"
    )
    again = values_of(f"{words} speed_rpm=1440 wheel_torque={got['wheel_torque']!r}")["values"]
    for name in ("worm_torque", "pair_power", "worm_power_out", "worm_tangential_force", "worm_radial_force"):
        assert again[name] == pytest.approx(got[name], rel=1e-12), name


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("teeth", "table", "shifts", "note"),
    [
        ((13, 21), "practicum", (0.694, 0.384), "В.1"),
        # the example under table В.1, a printed misprint, a pair of Б and Г, the guidelines' last row
        ((12, 18), "practicum", (0.609, 0.358), "В.1"),
        ((12, 23), "practicum", (0.693, 0.334), "0.673 / 0.334"),
        ((10, 40), "practicum", (0.59, 0.625), "Г.1"),
        ((12, 12), "guidelines", (0.504, 0.504), "2.1"),
    ],
)
def test_a_pair_takes_the_shifts_of_a_table(
    teeth: tuple[int, int], table: str, shifts: tuple[float, float], note: str
) -> None:
    words = f"gear-pair module=10 first.number_of_teeth={teeth[0]} second.number_of_teeth={teeth[1]}"
    got = values_of(f"{words} shifts={table}")
    assert tuple(got["values"]["profile_shift_coefficient"].values()) == shifts
    assert any(note in told for told in got["notes"])
    given = "".join(f" {k}.profile_shift_coefficient={x}" for k, x in zip(("first", "second"), shifts, strict=True))
    assert got["values"] == values_of(words + given)["values"]


def test_tables_of_the_practicum_are_right_where_it_misprints() -> None:
    """Д.1 and Е.1 as printed: every cell but those that are told is that of the page, rounded or cut off."""
    printed = json.loads((PUBLISHED / "involute_tables.json").read_text(encoding="utf-8"))
    page = values_of("involute")
    told = {(t, place) for t, place in re.findall(r"table (..1) prints \S+ at (\S+):", " ".join(page["notes"]))}
    off = set()
    for table, name in (("Д.1", "involutes"), ("Е.1", "cosines")):
        made = {int(row["α"]): row for row in page[name]}
        for degree, cells in printed[table].items():
            for minute, cell in zip(range(0, 60, 10), cells, strict=True):
                exact, size = made[int(degree)][f"{minute}'"], 10.0 ** -len(cell.partition(".")[2])
                angle = math.radians(int(degree) + minute / 60)
                assert exact == pytest.approx(math.tan(angle) - angle if table == "Д.1" else math.cos(angle), rel=1e-12)
                # half a unit, and one where it was cut off
                if not -size / 2 <= exact - float(cell) < size:
                    off.add((table, f"{degree}°{minute}'"))
    assert off == told == {("Д.1", "29°50'"), ("Д.1", "32°50'"), ("Д.1", "35°0'"), ("Е.1", "26°20'")}


def test_an_angle_is_found_of_its_involute_in_degrees_and_minutes() -> None:
    """Practicum 3.1: 0.037985 is 26°56', of which 26°55' is printed."""
    got = values_of("involute involute=0.037985")["values"]
    angle = math.radians(got["function_angle_deg"])
    assert math.tan(angle) - angle == pytest.approx(0.037985, rel=1e-12)
    assert got["angle_in_minutes"] == "26°56'"


@pytest.mark.parametrize(("teeth", "shifts", "sign"), [((13, 21), (0.694, 0.384), 1), ((24, 60), (0.2, 0.35), -1)])
def test_specific_pressure_is_that_of_the_textbooks(
    teeth: tuple[int, int], shifts: tuple[float, float], sign: int
) -> None:
    """Levitskaya, Popov: 2 (z2 + z1) / (z1 z2 cos alpha tan alpha_w) at the pitch point, with z2 - z1 of a ring."""
    first, second = (f"number_of_teeth={z} {end}.profile_shift_coefficient={x}" for z, x, end in
                     zip(teeth, shifts, ("first", "second"), strict=True))  # fmt: skip
    kind = "external_gear_pair" if sign > 0 else "internal_gear_pair"
    got = values_of(f"gear-pair kind={kind} module=7 first.{first} second.{second}")["values"]
    angle = math.radians(got["working_pressure_angle_deg"])
    (one, two), slope = teeth, math.cos(math.radians(20)) * math.tan(angle)
    assert got["specific_pressure"] == pytest.approx(2 * (two + sign * one) / (one * two * slope), rel=1e-9)


@pytest.mark.parametrize(
    ("topic", "second", "kind"),
    [
        ("gear-pair", "ring_gear", "internal_gear_pair"),
        ("gear-pair", "rack", "rack_pair"),
        # as in test_calc_internal_shifts, so that one search serves both
        pytest.param(
            "shift-choice second.cutter.number_of_teeth=25 working_centre_distance=40.5",
            "ring_gear",
            "internal_gear_pair",
            marks=pytest.mark.heavy,
        ),
    ],
)
def test_a_pair_is_what_its_second_gear_makes_it(topic: str, second: str, kind: str) -> None:
    words = f"{topic} first.number_of_teeth=20 second.number_of_teeth=60 module=2"
    assert values_of(f"{words} second.kind={second}") == values_of(f"{words} kind={kind}")


def test_a_ring_tells_where_its_tooth_is_pointed() -> None:
    """S / d = inv(20) - inv(alpha_y) there, by halving; a tooth that is thick at the base circle has no such place."""
    thickness, low, high = math.pi - 2.1, 0.0, math.radians(20)
    wanted = math.tan(high) - high - thickness / 80
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if math.tan(middle) - middle < wanted else (low, middle)
    values = values_of("ring module=2 number_of_teeth=40 circumferential_thinning=2.1")["values"]
    assert values["pointed_diameter"] == pytest.approx(80 * math.cos(math.radians(20)) / math.cos(low), rel=1e-9)
    assert "pointed_diameter" not in values_of("ring module=2 number_of_teeth=40")["values"]


def test_a_wheel_turned_down_uses_less_of_its_worm_as_the_part_itself_says(capsys: pytest.CaptureFixture[str]) -> None:
    wheel = {"kind": "worm_wheel", "module": 2.0, "number_of_teeth": 30, "number_of_starts": 2, "face_width": 14.0}
    words = "worm module=2 number_of_teeth=30 number_of_starts=2 face_width=14 outer_diameter="
    for outer in (64.5, 67.0):
        parts = make_parts(scene_from_dict({"parts": {"wheel": wheel | {"outer_diameter": outer}}}, "s", "s"), "s")[0]
        steps = {step["name"]: step["value"] for step in values_of(f"{words}{outer}")["steps"]}
        assert steps["worm_length_used"] == pytest.approx(parts["wheel"].quantities["worm_length_used"], abs=1e-6)
    assert "at least 64 mm works" in complaint(capsys, "calc", *f"{words}60".split())
    for key in ("outer_diameter", "face_width", "wheel_thinning"):
        told = complaint(capsys, "calc", "worm", "module=2", f"{key}=14")
        assert f"{key} is given, which belongs to a worm drive" in told


def test_errors_of_the_axes_have_the_gap_that_check_tells(tmp_path: Path) -> None:
    scene = tmp_path / "off.toml"
    text = built_in_scenes()["worm_set_print"].read_text("utf-8")
    scene.write_text(text.replace('second = "worm"', 'second = "worm"\naxis_angle_error_deg = 0.4'), "utf-8")
    steps = {step["name"]: step["value"] for step in values_of(f"worm {scene}")["steps"]}
    assert steps["axis_angle_error_deg"] == 0.4
    scene_of = load_scene(str(scene))
    (mating,) = make_parts(scene_of, str(scene))[1]
    found = mating.contact(0.0, 0.0, None)
    assert found is not None
    assert (steps["least_flank_gap"], steps["contact_verdict"]) == (pytest.approx(found.worst.gap, abs=1e-9), "CLEAR")


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("shift", "starts", "least"),
    # GOST 19650 for z2 = 40, by hand; between two shifts of its table the longer one
    [(-1.0, 1, 23.0), (-0.5, 2, 20.8), (-0.4, 1, 26.8), (0.0, 4, 32.2), (0.3, 1, 30.0), (1.0, 1, 32.0), (1.0, 4, 34.0)],
)
def test_the_least_length_of_a_worm_goes_by_the_shift(shift: float, starts: int, least: float) -> None:
    words = f"worm module=2 number_of_teeth=40 number_of_starts={starts} profile_shift_coefficient={shift}"
    assert values_of(words)["values"]["least_worm_length"] == pytest.approx(least, rel=1e-12)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    "words", ["number_of_teeth=22", "number_of_teeth=13", "number_of_teeth=31 helix_angle_deg=20", "number_of_teeth=57"]
)
def test_the_greatest_shift_for_a_tip_is_not_thin_as_it_is_told(words: str) -> None:
    """Rounded to the nearest digit every second one was; the text and the json tell one that is not."""
    name, note = "greatest_shift_for_tip_thickness", "the tip is thinner than 0.3 m"
    page = render(sheet_for(f"spur module=3 {words}"), "text", "en").splitlines()
    row = next(k for k, line in enumerate(page) if line.startswith("greatest shift with a tip of 0.3 m"))
    whole, told = values_of(f"spur module=3 {words}")["values"][name], float(page[row + 1].rpartition("= ")[2])
    assert whole - 1e-6 < told <= whole
    for shift, thin in ((whole, False), (told, False), (whole + 2e-6, True)):
        found = values_of(f"spur module=3 {words} profile_shift_coefficient={shift!r}")
        assert (note in found["notes"]) == thin
    # the tip thickness of the transverse section there is 0.3 m_t
    values = values_of(f"spur module=3 {words} profile_shift_coefficient={whole!r}")["values"]
    cosine = math.cos(math.radians(20 if "helix" in words else 0))
    assert values["tip_thickness"] * cosine == pytest.approx(0.9, rel=1e-9)


@pytest.mark.parametrize("words", ["spur number_of_teeth=26", "spur number_of_teeth=29 helix_angle_deg=20",
                                   "ring number_of_teeth=73", "ring number_of_teeth=49",
                                   "rack number_of_teeth=20"])  # fmt: skip
def test_the_least_and_the_greatest_pin_touch_as_they_are_told(words: str) -> None:
    """A pin of 1.386 mm touched no involute: 1.386 to 2.896 mm touch."""
    tool = "ball" if "helix" in words else "pin"
    values = values_of(f"{words} module=1")["values"]
    name = "rack_pin" if "rack" in words else f"{tool}_diameter"
    least, greatest = (round(values[f"{end}_{name}"], 5) for end in ("least", "greatest"))
    for pin, told in ((least, False), (greatest, False), (least - 2e-5, True), (greatest + 2e-5, True)):
        notes = values_of(f"{words} module=1 pin_diameter={pin:.5f}")["notes"]
        assert any(re.search("touches no involute|does not touch", note) for note in notes) == told


@pytest.mark.parametrize(
    "words", ["number_of_teeth=22", "number_of_teeth=13", "number_of_teeth=11 helix_angle_deg=20", "number_of_teeth=9"]
)
def test_the_least_shift_as_it_is_told_is_not_undercut(words: str) -> None:
    """Rounded down by up to 5e-6 modules it was; 1e-5 modules less are."""
    least = values_of(f"spur module=3 {words}")["values"]["least_shift_without_undercut"]
    for shift, told in ((round(least, 5), False), (round(least - 1e-5, 5), True)):
        notes = values_of(f"spur module=3 {words} profile_shift_coefficient={shift!r}")["notes"]
        assert ("the tooth is undercut: x < x_min" in notes) == told


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("module", "quotient", "teeth", "distance", "least"),
    # (8 + 0.06 z2) m of x = -0.5, (11 + 0.1 z2) m of x = 0.5 by GOST 19650
    [(1.6, 8, 31, 30.4, 15.776), (3.15, 8, 40, 74.025, 32.76), (3.15, 10, 31, 66.15, 44.415), (2, 10, 40, 51, 30.0)],
)
def test_a_shift_that_a_centre_distance_asks_has_its_own_row(
    module: float, quotient: int, teeth: int, distance: float, least: float
) -> None:
    """x = -0.5000000000000036 had the longer one of two rows, 42.21 mm for 32.76."""
    words = f"worm module={module} diameter_quotient={quotient} number_of_teeth={teeth} number_of_starts=2"
    values = values_of(f"{words} working_centre_distance={distance}")["values"]
    assert values["least_worm_length"] == pytest.approx(least, rel=1e-12)


@pytest.mark.parametrize(
    ("words", "sizes"),
    [("module=1.6 number_of_starts=4 number_of_teeth=40 diameter_quotient=8", (25.76, 10.72, 68.8)),
     ("module=1.6 number_of_starts=1 number_of_teeth=31 diameter_quotient=10", (20.576, 14.4, 56.0)),
     ("module=3.15 number_of_starts=1 number_of_teeth=31 diameter_quotient=8", (40.509, 23.625, 110.25))],
)  # fmt: skip
def test_the_least_and_the_greatest_of_gost_19650_are_not_beyond_it(words: str, sizes: tuple[float, ...]) -> None:
    """(12.5 + 0.09 z2) m, 0.75 d_a1 and d_a2 + 6 m / (z1 + 2): a worm of 25.76 mm was shorter than 25.76 mm."""
    for share, told in ((0.0, 0), (0.001, 3)):
        length, width, outer = sizes[0] * (1 - share), sizes[1] * (1 + share), sizes[2] * (1 + share)
        given = f"worm_length={length:.9g} face_width={width:.9g} outer_diameter={outer:.9g}"
        notes = values_of(f"worm {words} {given}")["notes"]
        beyond = [n for n in notes if re.search(r"shorter than|rim is wider than \d|is more than", n)]
        assert len(beyond) == told


def test_a_rim_wider_than_its_throat_is_calculated() -> None:
    """The throat of radius 8 is 16 mm wide; beside it the rim is the outer cylinder, which the worm does not reach."""
    used = [values_of(f"worm module=2 number_of_teeth=40 face_width={b}")["values"] for b in (16, 17, 200)]
    assert used[0]["worm_length_used"] < used[1]["worm_length_used"]
    assert "worm_length_used" not in used[2]


def test_text_of_digits_needs_no_quotes_which_no_shell_leaves(capsys: pytest.CaptureFixture[str]) -> None:
    pages = []
    for chain in ("40", '"40"'):
        assert run("calc", "sprocket", "number_of_teeth=17", f"chain={chain}") == 0
        pages.append(capsys.readouterr().out)
    # 40 of ANSI is half an inch
    assert pages[0] == pages[1]
    assert "p = 12.7 mm" in pages[0]


@pytest.mark.sampled(7)
@pytest.mark.parametrize("seed", range(12))
def test_the_diameter_at_which_a_tooth_is_pointed_is_typed_back_as_it_is_told(seed: int) -> None:
    """Rounded to the nearest digit, every other one was refused as pointed; one more digit is."""
    draw = random.Random(seed)
    words = [f"module={draw.choice([1, 1.25, 2.5])}", f"number_of_teeth={draw.randint(12, 90)}",
             f"profile_shift_coefficient={round(draw.uniform(0, 0.8), 2)}"]  # fmt: skip
    told = re.search(r"at which the tooth is pointed.*\n    d_p = ([\d.]+) mm", calculate("spur", words, "text", "en"))
    assert told is not None
    assert calculate("spur", [*words, f"tip_diameter={told[1]}"], "text", "en")
    beyond = float(told[1]) + 2 * 10.0 ** -len(told[1].partition(".")[2])
    with pytest.raises(SceneError) as refusal:
        calculate("spur", [*words, f"tip_diameter={beyond!r}"], "text", "en")
    assert refusal.value.code == "tooth_pointed"


@pytest.mark.sampled(3)
@pytest.mark.parametrize("seed", range(10))
def test_pins_that_a_note_tells_are_typed_back(seed: int) -> None:
    """The least one was sunk below the tips of every other gear; it stands out, and one a little thinner does not."""
    draw = random.Random(seed)
    words = [f"module={draw.choice([1, 2])}", f"number_of_teeth={draw.randint(20, 60)}",
             f"profile_shift_coefficient={round(draw.uniform(-0.2, 0.5), 2)}"]  # fmt: skip
    noted = re.compile(r"a pin of .* mm touches no involute or is sunk; ([\d.]+) to ([\d.]+) mm touch")

    def note(pin: str) -> re.Match[str] | None:
        return noted.search(calculate("spur", [*words, f"pin_diameter={pin}"], "text", "en"))

    thick = note(f"{6 * int(words[0][-1])}")
    assert thick is not None
    for told, way in ((thick[1], -2), (thick[2], 2)):
        assert note(told) is None
        assert note(repr(float(told) + way * 10.0 ** -len(told.partition(".")[2]))) is not None
    # ISO 21771, by hand: the pin reaches beyond the tip circle
    page = json.loads(calculate("spur", [*words, f"pin_diameter={thick[1]}"], "json", "en"))["values"]
    assert page["pin_centre_diameter"] + float(thick[1]) > page["tip_diameter"]


@pytest.mark.parametrize("row", ["first_deg=30", "last_deg=30"])
@pytest.mark.parametrize("angle", ["angle_deg=10", "involute=0.1"])
def test_rows_of_the_tables_are_refused_where_no_table_is_printed(angle: str, row: str) -> None:
    with pytest.raises(SceneError) as refused:
        calculate("involute", [angle, row], "text", "en")
    assert refused.value.key == f"involute.{row.partition('=')[0]}"
    assert refused.value.numbers["other"] == angle.partition("=")[0]


@pytest.mark.parametrize("helix", [0.0, 25.0])
def test_a_crowned_gear_is_told_that_its_sizes_are_those_of_the_middle(helix: float) -> None:
    """A calliper at a face reads what the same teeth thinned by the crowning have: nobody said so."""
    words = ["module=2", "number_of_teeth=23", f"helix_angle_deg={helix}", "face_width=20"]
    transverse = math.atan(math.tan(math.radians(20)) / math.cos(math.radians(helix)))
    plain, crowned, face = (
        json.loads(calculate("spur", [*words, *more], "json", "en"))
        for more in ([], ["crowning=0.02"], [f"circumferential_thinning={0.04 / math.cos(transverse)}"])
    )
    assert crowned["values"] == plain["values"]
    less = plain["values"]["span"] - face["values"]["span"]
    (note,) = set(crowned["notes"]) - set(plain["notes"])
    assert f"the span is {less:.6g} mm less" in note

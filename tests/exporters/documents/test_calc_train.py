"""``higherpair calc train``: every case of lesson 2 and of the guide on trains, misprints beside the right values."""

from __future__ import annotations

import json
import math
import random
import re
import subprocess
import sys
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from exporters.documents.render import SPOKEN, render
from exporters.documents.topics import calculate, sheet_of
from parts.base.refusal import SceneError
from parts.base.texts import words
from parts.mates.pages.train_cases import CASES
from tests.exporters.documents.test_calc import evaluated

PUBLISHED = json.loads((Path(__file__).parents[2] / "published" / "trains.json").read_text(encoding="utf-8"))["cases"]
TEXTBOOK = json.loads((Path(__file__).parents[2] / "published" / "textbook_trains.json").read_text())["cases"]
RECOMPUTED = {entry["id"]: entry["recomputed"] for entry in PUBLISHED}
JAMES = ("teeth=[40,40,120]", "meshes=1-2, 2-3 internal", "carriers.H=2")
LOADED = (*JAMES, "held=3", "mesh_efficiency=0.98", "module=2", "torques.H=-20", "speeds.1=120")
FERGUSON = ("teeth.1=100", "teeth.2=101", "teeth.2'=100", "teeth.3=99", "meshes=1-2, 2'-3", "carriers.H=2", "held=3",
            "driver=H", "driven=1", "mesh_efficiency=0.98")  # fmt: skip


def calculated(*keys: str) -> dict[str, Any]:
    return json.loads(calculate("train", keys, "json", "en"))


def by_symbol(data: dict[str, Any]) -> dict[str, float]:
    found: dict[str, float] = {}
    for step in data["steps"]:
        if step["value"] is not None:
            found.setdefault(step["symbol"], step["value"])
    return found


def misprints(data: dict[str, Any]) -> dict[str, str]:
    return {step["symbol"]: step["misprint"] for step in data["steps"] if "misprint" in step}


@pytest.mark.parametrize("case", CASES)
def test_every_printed_formula_gives_its_value(case: str) -> None:
    steps = [s for s in sheet_of("train", (f"case={case}",))[0].steps() if s.formula]
    assert len(steps) >= 4
    for step in steps:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-12), (step.symbol, step.formula)


# the id, more keys, and what the page calls the recomputed numbers
@pytest.mark.parametrize(
    ("entry", "more", "symbols"),
    [
        ("000.p2.ex1", (), {"u14": "u_14^H", "u1H": "u_1H^4", "u57": "u_57", "u17": "u_17"}),
        ("000.p2.ex2", (), {"u36": "u_36^H", "u12": "u_12", "u3H": "u_3H^6", "u1H": "u_1H"}),
        ("000.p2.ex3", (), {"u12": "u_12", "u35": "u_35^H", "u3H": "u_3H^5", "u1H": "u_1H"}),
        ("001.ex1", (), {"u12": "u_12"}),
        ("001.ex2", (), {"u12": "u_12"}),
        ("001.ex3", (), {"u12": "u_12", "omega2_rad_s": "ω_2"}),
        ("001.ex4", (), {"u12": "u_12", "z2": "z_2"}),
        ("001.ex5", (), {"u13": "u_13", "a12_mm": "a_12", "a23_mm": "a_23"}),
        ("001.ex6", (), {"u13": "u_13", "a12_mm": "a_12", "a23_mm": "a_2'3"}),
        ("001.ex7", (), {"u1H": "u_1H", "omega_H_rad_s": "ω_H", "u2H": "u_2H^3", "omega_2_rad_s": "ω_2"}),
        ("001.ex7.coaxial", ("teeth.2=40",),
         {"u1H": "u_1H", "omega_H_rad_s": "ω_H", "u2H": "u_2H^3", "omega_2_rad_s": "ω_2"}),
        ("001.ex8", (), {"ratio_z2z3_over_z1z2p": "u_13^H", "u1H": "u_1H", "omega_H_rad_s": "ω_H",
                         "u2H": "u_2'H^3", "omega_2_rad_s": "ω_2"}),
        ("001.ex8.z1_50", ("teeth.1=50",), {"ratio_z2z3_over_z1z2p": "u_13^H", "u1H": "u_1H", "omega_H_rad_s": "ω_H",
                                            "u2H": "u_2'H^3", "omega_2_rad_s": "ω_2"}),
        ("001.ex9", (), {"u12": "u_12", "u24": "u_H4^5", "u14": "u_14"}),
        ("001.ex10", (), {"u": "u_1H2", "u_stage1": "u_1H1^3", "u_stage2": "u_4H2^6"}),
    ],
)  # fmt: skip
def test_published_examples(entry: str, more: tuple[str, ...], symbols: dict[str, str]) -> None:
    case = next(e["case"] for e in PUBLISHED if e["id"] == entry)
    found = by_symbol(calculated(f"case={case}", *more))
    for name, symbol in symbols.items():
        assert found[symbol] == pytest.approx(RECOMPUTED[entry][name], rel=1e-12), (name, symbol)


@pytest.mark.parametrize("entry", [e for e in PUBLISHED if ".W." in e["id"]], ids=lambda e: e["id"])
def test_published_mobility(entry: dict[str, Any]) -> None:
    found = by_symbol(calculated(f"case={entry['case']}"))
    assert [found[s] for s in ("n", "p_5", "p_4", "W")] == [*entry["inputs"].values(), entry["recomputed"]["W"]]


@pytest.mark.parametrize("entry", [e for e in PUBLISHED if "exercise" in e["id"]], ids=lambda e: e["case"])
def test_exercises_have_both_signs_and_say_why(entry: dict[str, Any]) -> None:
    data = calculated(f"case={entry['case']}")
    ratios = [*entry["recomputed"]["variants"].values()]
    assert data["values"]["total_ratio"] == ratios[0] == -ratios[1]
    assert data["values"]["degree_of_freedom"] == entry["recomputed"]["W"]
    note = next(n for n in data["notes"] if "figure is lost" in n)
    assert f"gives {ratios[0]:g}" in note
    assert f"gives {ratios[1]:g}" in note
    assert not any("not coaxial" in n for n in data["notes"])


@pytest.mark.parametrize(
    ("case", "marked"),
    [
        ("practicum_1", {"u_14^H": "(-48/88)·(-44/4)"}),
        ("practicum_2", {"u_36^H": "6", "u_1H": "20", "u_3H^6": "(4): 1 - z_2·z_3/(z_1·z_2)"}),
        ("practicum_3", {"u_35^H": "(30/20)·(-80/30)"}),
        ("trains_7", {"ω_2": "-150"}),
        ("trains_8", {"u_13^H": "9/5", "u_1H^3": "-0.8", "ω_H": "150", "ω_2": "600"}),
        ("trains_2", {}),
    ],
)
def test_misprints_stand_beside_the_right_values(case: str, marked: dict[str, str]) -> None:
    found = misprints(calculated(f"case={case}"))
    assert set(found) == set(marked)
    for symbol, text in marked.items():
        assert f": {text} (" in found[symbol]


def test_what_cannot_be_built_is_told_with_what_can() -> None:
    told = " ".join(calculated("case=practicum_2")["notes"])
    assert "48 / 56 teeth, not coaxial" in told
    assert "3.5 / 3" in told
    told = " ".join(calculated("case=trains_7")["notes"])
    assert "would be 3, by the teeth 4" in told
    assert "z_2 = 40 is coaxial, with 4" in told
    assert "z_3 = 42 is coaxial, with 21.6" in " ".join(calculated("case=trains_10")["notes"])


def test_the_table_of_inversion_is_told_for_a_link_that_it_has() -> None:
    """Wheels 2 and 3 on one shaft are link 2: the table was told for one turn of a link 3, which it had not."""
    told = calculate("train", ["practicum_example_2"], "text", "en")
    link = re.findall(r"Inversion .*, turns for one of (\S+)\n", told)
    table = told.partition("Inversion ")[2].partition("\n\n")[0]
    assert link == re.findall(r"(?m)^ *(\S+) +1 +\S+$", table) == ["2"]


def test_the_table_of_inversion_is_that_of_the_speeds() -> None:
    rows = {row["link"]: row for row in calculated("case=trains_7", "teeth.2=40")["inversion_H"]}
    assert rows["1"]["n"] == 1
    assert rows["H"] == {"link": "H", "n": 0.25, "n - n_H": 0.0}
    assert (rows["3"]["n"], rows["3"]["n - n_H"]) == (0.0, -0.25)
    assert (rows["2"]["n"], rows["2"]["n - n_H"]) == (-0.5, -0.75)


def test_random_rows_of_stages_are_their_product() -> None:
    """Fixed pairs and James stages one after the other, 2 to 8: Willis by hand."""
    random.seed(7)
    for _ in range(10):
        teeth, meshes, shafts, carriers, held, u, last = [], [], [], {}, [], Fraction(1), ""
        for stage in range(random.randint(2, 8)):
            z1, z2 = random.randint(12, 60), random.randint(12, 60)
            k = len(teeth)
            if random.random() < 0.5:
                names, end = (f"{k + 1}", f"{k + 2}"), f"{k + 2}"
                teeth += [z1, z2]
                meshes.append("-".join(names))
                u *= -Fraction(z2, z1)
            else:
                names, end = (f"{k + 1}", f"{k + 2}", f"{k + 3}"), f"H{stage}"
                teeth += [z1, z2, z1 + 2 * z2]
                meshes += [f"{names[0]}-{names[1]}", f"{names[1]}-{names[2]} internal"]
                carriers[end] = names[1]
                held.append(names[2])
                u *= 1 + Fraction(z1 + 2 * z2, z1)
            if last:
                shafts.append(f"{last}-{names[0]}")
            last = end
        given = {"teeth": teeth, "meshes": ", ".join(meshes), "shafts": ", ".join(shafts), "driven": last}
        given |= {f"carriers.{c}": s for c, s in carriers.items()} | ({"held": ",".join(held)} if held else {})
        data = calculated(*(f"{key}={value}" for key, value in given.items()))
        assert Fraction(data["exact"]["ratio"]) == u
        assert not any("not coaxial" in note for note in data["notes"])


def test_a_train_of_1e12_is_exact() -> None:
    pairs = ", ".join(f"{2 * k + 1}-{2 * k + 2}" for k in range(12))
    shafts = ", ".join(f"{2 * k}-{2 * k + 1}" for k in range(1, 12))
    data = calculated(f"teeth={[12, 120] * 12}", f"meshes={pairs}", f"shafts={shafts}")
    assert data["exact"]["ratio"] == str(10**12)


def test_differential_from_two_speeds() -> None:
    """Willis with both suns driven: w_H = (40 w_1 + 120 w_3) / 160."""
    data = calculated(*JAMES, "speeds.1=120", "speeds.3=10", "mesh_efficiency=0.98")
    assert by_symbol(data)["ω_H"] == pytest.approx((40 * 120 + 120 * 10) / 160)
    assert data["exact_turns"] == {"1": {"1": "1", "3": "0"}, "2": {"1": "-1/2", "3": "3/2"}, "3": {"1": "0", "3": "1"},
                             "H": {"1": "1/4", "3": "3/4"}}  # fmt: skip
    assert data["values"]["degree_of_freedom"] == 2
    assert 0.97 < data["values"]["efficiency"] < 0.98


def test_a_closed_differential_is_solved_as_a_whole() -> None:
    """Sun and ring both driven by a shaft 4-5: w_1 = -w/2, w_3 = -w/3; w_H = (40 w_1 + 120 w_3) / 160."""
    teeth = ("teeth.1=40", "teeth.2=40", "teeth.3=120", "teeth.4=20", "teeth.1'=40", "teeth.5=20", "teeth.3'=60")
    meshes = ("meshes=1-2, 2-3 internal, 4-1', 5-3'", "shafts=4-5", "carriers.H=2")
    data = calculated(*teeth, *meshes, "driver=4", "driven=H", "mesh_efficiency=0.97")
    assert data["exact"]["ratio"] == str(1 / (Fraction(-40, 2 * 160) + Fraction(-120, 3 * 160)))
    assert any("closed differential" in note for note in data["notes"])
    assert any("Willis" in note for note in data["notes"])
    assert 0.9 < data["values"]["efficiency"] < 0.97


def test_a_ring_of_four_turns_with_one_redundant_mesh() -> None:
    data = calculated("teeth=[20,30,40,50]", "meshes=1-2, 2-3, 3-4, 4-1", "driven=3")
    assert (data["values"]["degree_of_freedom"], data["values"]["exact_degree_of_freedom"]) == (0, 1)
    assert any("redundant" in note and "4-1" in note for note in data["notes"])
    assert data["exact"]["ratio"] == "2"


def test_statics_of_james_and_of_ferguson() -> None:
    """(1 + 3 eta^2) / 4; the research: 0.2519 %, and it cannot be driven back."""
    data = calculated(*LOADED)
    found = by_symbol(data)
    assert found["η"] == pytest.approx((1 + 3 * 0.98**2) / 4, rel=1e-12)
    assert sum(found[f"T_{name}"] for name in "13H") == pytest.approx(0, abs=1e-9)
    sun = next(row for row in data["flows_1"] if row["mesh"] == "1-2")
    assert sun["F_t"] == pytest.approx(2000 * found["T_1"] / (2 * 40))
    ferguson = calculated(*FERGUSON)
    assert by_symbol(ferguson)["η"] == pytest.approx(0.002519, abs=5e-7)
    assert any("driven back" in note and "self-locking" in note for note in ferguson["notes"])
    assert any("power goes round" in note for note in ferguson["notes"])


@pytest.mark.parametrize("keys", [("case=practicum_2",), ("case=trains_8",), LOADED, ("case=trains_4",)], ids=str)
def test_both_languages_in_every_format(keys: tuple[str, ...]) -> None:
    page, _ = sheet_of("train", keys)
    for form in SPOKEN:
        one, two = (render(page, form, language) for language in ("en", "uk"))
        assert one != two
        if form != "json":
            assert words("uk").say(page.title) in two


def test_report_form_has_a_place_for_the_count() -> None:
    told = calculate("train", ("case=practicum_3",), "text", "en")
    order = ["1. Scheme", "2. Degree of freedom", "3. Ratios", "Whole mechanism", "4. Check by experiment", "________"]
    places = [told.index(part) for part in order]
    assert places == sorted(places)


@pytest.mark.parametrize(
    ("keys", "parts"),
    [
        (("practicum_example_1", "module=2"), ("train.module = 2.0", "follows from meshes")),
        (("teeth=[20,30]", "meshes=1-1"), ('"1-1"', "wheels of one body do not mesh")),
        (("teeth=[20,30,40]", "meshes=1-2, 2-3", "shafts=1-2"), ('"1-2"', "wheels of one body do not mesh")),
        (("teeth=[20,30,40]", "meshes=1-2, 2-3", "shafts=H"), ('"H"', "as 2-3")),
        ((*JAMES, "held=3", "speeds.1=3", "driver=2"), ('driver = "2"', "speed")),
        (("teeth=[20,30,30]", "meshes=1-2", "carriers.H=3"), ("carriers.H", "holds satellites")),
        ((*JAMES[:2], "carriers.H=", "held=3"), ('carriers.H = ""', "holds satellites")),
        ((*JAMES, "carriers.K=2", "held=3"), ("carriers.K", "already carried by H")),
        ((*JAMES, "held=3", "speeds.1=3", "speeds.H=4"), ("speeds", "turned already by", "3")),
        (JAMES, ("left free", "H, 2, 3")),
        ((*JAMES, "held=3,H"), ("held", "3, H", "hold one less")),
        ((*JAMES, "held=1,3"), ('"1"', "is held and cannot be the driver")),
        (("teeth=[20,30,40]", "meshes=1-2, 2-3, 3-1"), ("meshes", "W = 0")),
        (("teeth=[20,30]", "meshes=1-2 internl"), ("internl", "did you mean internal")),
        (("teeth=[20,30]", "meshes=1-3"), ("wheel 3 has no number of teeth",)),
        (("teeth=[20,0]", "meshes=1-2"), ("= 0", "at least 1")),
        (("teeth=[30,30]", "meshes=1-2 internal"), ("more teeth",)),
        (("case=trains_77",), ("trains_77", "did you mean trains_7")),
        (("case=trains_4", "speeds.2=7"), ("85.7143", "not whole")),
        ((), ("meshes", "missing")),
        ((*JAMES, "held=3", "torques.3=4"), ("torques", "its torque is a result")),
        ((*JAMES, "held=3", "driven=5"), ("driven", "no such link")),
        ((*JAMES, "held=3", "mesh_efficiency=0"), ("mesh_efficiency", "above 0")),
    ],
)
def test_refusals_are_one_line(keys: tuple[str, ...], parts: tuple[str, ...]) -> None:
    with pytest.raises(SceneError) as caught:
        calculate("train", keys, "text", "en")
    line = str(caught.value)
    assert "\n" not in line
    for part in parts:
        assert part in line


@pytest.mark.parametrize("case", TEXTBOOK, ids=[case["id"] for case in TEXTBOOK])
def test_speeds_of_a_textbook(case: dict[str, Any]) -> None:
    given = case["driven_at"]
    data = calculated(*case["words"], *(f"speeds.{link}={speed}" for link, speed in given.items()))
    told = by_symbol(data)
    for link, printed in case["printed"].items():
        # T_3 is the torque of a link, 3 its speed
        found = told.get(link if link.startswith("T_") else f"ω_{link}")
        if "exact_turns" in data and not link.startswith("T_"):
            found = sum(float(Fraction(data["exact_turns"][link][one])) * speed for one, speed in given.items())
        assert found == pytest.approx(printed, abs=0.5001 * 10 ** -case["digits"])


@pytest.mark.sampled(3)
@pytest.mark.parametrize("teeth", [(20, 40, 100), (40, 13, 66), (17, 70, 157), (30, 30, 90)])
@pytest.mark.parametrize("each", [0.99, 0.95])
def test_efficiencies_of_a_planetary_set_by_kudryavtsev(teeth: tuple[int, int, int], each: float) -> None:
    """V. N. Kudryavtsev, Planetary gears: of each way through a set with p = z_3 / z_1, psi of the stopped carrier."""
    p, whole = teeth[2] / teeth[0], each**2
    known = {
        ("1", "H", "3"): (1 + p * whole) / (1 + p),
        ("H", "1", "3"): (1 + p) / (1 + p / whole),
        ("3", "H", "1"): (p + whole) / (1 + p),
        ("H", "3", "1"): (1 + p) / (p + 1 / whole),
        ("1", "3", "H"): whole,
    }
    for (driver, driven, held), efficiency in known.items():
        words = (f"teeth={[*teeth]}", "meshes=1-2, 2-3 internal", "carriers.H=2", f"mesh_efficiency={each}")
        data = calculated(*words, f"held={held}", f"driver={driver}", f"driven={driven}")
        assert data["values"]["efficiency"] == pytest.approx(efficiency, rel=1e-12)


@pytest.mark.parametrize("teeth", [(99, 50, 51, 100), (100, 101, 100, 99), (60, 20, 30, 91), (101, 100, 99, 100)])
@pytest.mark.parametrize("kind", ["", " internal"])
def test_efficiencies_of_sets_whose_wheels_turn_alike(teeth: tuple[int, int, int, int], kind: str) -> None:
    """Radzimovsky's formulas for i_0 = u_13 with the carrier stopped, above 0; the carrier drives, wheel 3 is held."""
    names, whole = ("1", "2", "2'", "3"), 0.98**2
    ratio = teeth[1] * teeth[3] / (teeth[0] * teeth[2])
    data = calculated(*(f"teeth.{name}={z}" for name, z in zip(names, teeth, strict=True)), "carriers.H=2", "held=3",
                      f"meshes=1-2{kind}, 2'-3{kind}", "driver=H", "driven=1", "mesh_efficiency=0.98")  # fmt: skip
    known = (ratio - 1) / (ratio / whole - 1) if ratio > 1 else (1 - ratio) / (1 - ratio * whole)
    assert data["values"]["efficiency"] == pytest.approx(known, rel=1e-12)


def test_wheels_on_a_carriers_shaft_are_listed_with_its_turns() -> None:
    teeth = {"1": 20, "2": 20, "3": 60, "4": 30, "5": 30, "2'": 20}
    words = ("meshes=1-2, 2'-3 internal, 4-5", "carriers.H=2", "shafts=4-H", "speeds.1=10", "speeds.3=5")
    data = calculated(*(f"teeth.{name}={z}" for name, z in teeth.items()), *words)
    told = data["exact_turns"]
    assert list(told) == [row["link"] for row in data["turns"]] == [*teeth, "H"]
    # Willis, z_3 / z_1 = 3: n_H = (n_1 + 3 n_3) / 4
    assert told["4"] == told["H"] == {"1": "1/4", "3": "3/4"}
    assert told["2'"] == told["2"] == {"1": "-1/2", "3": "3/2"}
    assert told["5"] == {"1": "-1/4", "3": "-3/4"}


def test_nothing_heavy_is_loaded() -> None:
    script = (
        "import sys; from exporters.documents.topics import calculate; "
        "calculate('train', ['case=practicum_1'], 'html', 'en'); calculate('planetary', ['ratio=2.5'], 'html', 'en'); "
        "print([m for m in ('scipy', 'OCP', 'matplotlib', 'shapely', 'ezdxf') if m in sys.modules])"
    )
    told = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "[]"


def test_symbols_of_links_are_lowered_and_what_is_held_is_raised() -> None:
    page = calculate("train", ("case=trains_8",), "html", "en")
    assert "u<sub>13</sub><sup>H</sup>" in page
    assert "u<sub>2&#x27;3</sub><sup>H</sup>" in page
    assert "z<sub>2</sub>&#x27;" in page
    assert "^" not in page.split("<ul>")[0]


@pytest.mark.parametrize(("load", "drives"), [(100, True), (-100, False)])
def test_a_load_that_turns_with_its_link_is_told(load: int, drives: bool) -> None:
    text = calculate("train", [*JAMES, "held=3", "speeds.1=100", f"torques.H={load}"], "text", "en")
    assert ("the load on H acts along its turning" in text) == drives


@pytest.mark.parametrize(("mesh", "speed", "ratio"), [("1-2", 50, -2), ("1-2", -50, -2), ("1-2 internal", 50, 2)])
def test_speeds_without_a_sign_are_those_of_their_mesh(mesh: str, speed: int, ratio: int) -> None:
    """External wheels turn against each other, whether the second one's speed says so or not."""
    steps = sheet_of("train", ("teeth.1=20", f"meshes={mesh}", "speeds.1=100", f"speeds.2={speed}"))[0].steps()
    assert {s.value for s in steps if s.symbol == "u_12" and isinstance(s.value, float)} == {ratio}
    assert next(s.value for s in steps if s.symbol == "z_2") == 40


def test_speeds_are_taken_and_told_in_rpm_too() -> None:
    """The carrier of 24/24/72 turns once for four turns of the sun: 1440 rpm, 150.796 rad/s."""
    words = ["meshes=1-2, 2-3 internal", "teeth=[24,24,72]", "carriers.H=2", "held=3"]
    text = calculate("train", [*words, "speeds_rpm.1=1440"], "text", "en")
    assert "N_1 = 1440 rpm" in text
    assert "= 150.79645 rad/s" in text
    assert re.search(r"N_H = .* = 360 rpm", text)
    same = calculate("train", [*words, f"speeds.1={48 * math.pi!r}"], "text", "en")
    assert re.search(r"N_1 = .* = 1440 rpm", same)
    assert re.search(r"N_H = .* = 360 rpm", same)
    with pytest.raises(SceneError, match=r"speeds_rpm\.1"):
        calculate("train", [*words, "speeds_rpm.1=1440", "speeds.1=1"], "text", "en")


@pytest.mark.parametrize(
    ("counted", "off"), [("-0.0740741", 3.5e-5), ("-0.0777778", 5.00003), ("0.0740741", 200.00004)]
)
def test_counted_turns_are_compared_with_the_ratio(counted: str, off: float) -> None:
    # exercise 2.10.7: u = -27/2
    steps = {step["name"]: step for step in calculated("case=2.10.7", f"counted_turns={counted}")["steps"]}
    assert steps["turns_counted"]["value"] == float(counted)
    assert steps["counted_difference_percent"]["value"] == pytest.approx(off, rel=1e-5)

"""``higherpair calc strength``: formulas, the thesis's pair, what torques are allowed, remarks, refusals, any keys.

Numbers of KISSsoft and of ISO/TR 6336-30 stand with the textbooks, the critical section in ``tests/geometry``.
"""

from __future__ import annotations

import csv
import io
import json
import math
import subprocess
import sys
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from exporters.documents.render import SPOKEN, render
from exporters.documents.topics import calculate, sheet_of
from parts.base.refusal import SceneError, sentence
from parts.base.texts import words
from parts.pages.page import Sheet
from tests.exporters.command.test_cli import complaint
from tests.exporters.documents.test_calc import PUBLISHED, evaluated, sheet_for
from tests.sampling import examples

PAIR = ("module=3", "first.number_of_teeth=20", "second.number_of_teeth=41")
RING = ("module=2", "first.number_of_teeth=20", "second.number_of_teeth=80", "second.kind=ring_gear")
GOST = "method=GOST 21354"
SHEETS = [
    ("strength", "practicum_pair", "torque=100", "speed_rpm=300", "accuracy_grade=7", "material_group=Eh",
     "load_cycles=2e5"),
    ("strength", "practicum_pair"),
    ("strength", "practicum_pair", "torque=100", GOST),
    ("strength", "helical_pair", "torque=100", "speed_rpm=9000", "accuracy_grade=4", "material_group=V", "hardness=190",
     "yield_strength=600", "rim_thickness=3", "flank_roughness=[3,6]", "oil_viscosity=100"),
    ("strength", "helical_pair", "torque=100", "method=ISO 6336:2006", "flank_factor=0.95", "root_face_load_factor=1.1",
     "contact_limit=[1200,1100]"),
    ("strength", *PAIR, "torque=10", "circumferential_thinning=0.1", "thinning_method=deeper_cut", "helix_angle_deg=15",
     "face_width=20", "working_centre_distance=96"),
    ("strength", *PAIR, "torque=10", "circumferential_thinning=0.1", "helix_angle_deg=15", "face_width=5",
     "profile_factor=1.2", "speed_rpm=1000", "accuracy_grade=6", "material_group=St", "hardness=300"),
    ("strength", *PAIR, "torque=10", "first.cutter.number_of_teeth=25", "helix_angle_deg=15", GOST, "material_group=V",
     "hardness=250", "face_width=80", "life_hours=100", "speed_rpm=9000"),
    ("strength", "module=3", "first.number_of_teeth=60", "second.number_of_teeth=90", "power=1000", "speed_rpm=900",
     "basic_rack.addendum_coefficient=1.4", "accuracy_grade=4", "elastic_modulus=[206000,3000]",
     "poisson_ratio=[0.3,0.4]"),
    ("strength", "thesis_internal_pair", "torque=247", GOST, "contact_limit=850", "bending_limit=580",
     "form_factor=3.55"),
    ("strength", "thesis_internal_pair", "torque=247", 'material_group=["Eh","V alloy"]', "hardness=[700,240]",
     "flank_roughness=3", "root_roughness=20", "oil_viscosity=220", "speed_rpm=100", "accuracy_grade=6",
     "life_hours=1000", "rim_thickness=[6,8]"),
    ("strength", *RING, "torque=10", "helix_angle_deg=20", "second.rounded_root.full_round=true",
     "second.circumferential_thinning=0.1"),
    ("strength", *RING, "torque=10", "working_centre_distance=61", GOST),
]  # fmt: skip


def values(*typed: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(calculate("strength", typed, "json", "en"))
    return found


@pytest.mark.parametrize("typed", SHEETS, ids=" ".join)
def test_every_printed_formula_gives_its_value(typed: tuple[str, ...]) -> None:
    sheet = sheet_for(typed)
    checked = [step for step in sheet.steps() if step.formula]
    assert len(checked) >= 20
    for step in checked:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-9, abs=1e-9), (step.name, step.formula)


def test_a_wrong_formula_would_be_noticed() -> None:
    steps = [s for s in sheet_for(SHEETS[0]).steps() if s.formula]
    wrong = [s.name for s in steps if evaluated(s, 1e-3) == pytest.approx(s.value, rel=1e-9)]
    assert wrong == []


@pytest.mark.sampled(6)
@pytest.mark.parametrize("typed", SHEETS[::4], ids=" ".join)
@pytest.mark.parametrize("form", SPOKEN)
def test_both_languages_and_every_form(typed: tuple[str, ...], form: str) -> None:
    sheet = sheet_for(typed)
    texts = [sheet.title, *(s.title for s in sheet.sections), *sheet.notes]
    assert all(words("uk").say(text) != words("en").say(text) for text in texts)
    told = render(sheet, form, "uk")
    assert render(sheet, form, "en") != told
    assert "**(" not in told


def test_the_thesis_pair_by_gost() -> None:
    """Its Z_R Z_v, Y_R, Y_delta and K_R; its stress by the same formula with its rounded Z_H and Z_eps."""
    cases = json.loads((PUBLISHED / "power_module.json").read_text(encoding="utf-8"))["cases"]
    of = {c["id"].removeprefix("004.gear."): c["recomputed"] for c in cases if c["id"].startswith("004.gear.")}
    given_keys = (
        "thesis_internal_pair", "torque=247", GOST, "contact_limit=850", "bending_limit=580", "form_factor=3.55",
        "flank_factor=0.9405", "surface_factor=1.05", "gradient_factor=0.98", "reversing_factor=0.75",
        "least_bending_safety=1.7", "least_contact_safety=1.2", "dynamic_factor=1.01", "face_load_factor=1.05",
        "face_width=25",
    )  # fmt: skip
    found = values(*given_keys)["values"]
    assert found["allowed_root_stress"]["first"] == pytest.approx(of["sigma_FP1"]["sigma_FP1_MPa"], rel=1e-12)
    assert found["allowed_flank_stress"]["first"] == pytest.approx(of["sigma_HP"]["sigma_HP_MPa"], rel=1e-12)
    assert found["zone_factor"] == pytest.approx(of["Z"]["Z_H"], rel=1e-12)
    assert found["reference_force"] == pytest.approx(of["F_t"]["F_t_N"], rel=1e-12)
    stress = next(s for s in sheet_of("strength", given_keys)[0].steps() if s.name == "contact_stress")
    put = {"Z_H": 2.49, "Z_eps": 0.84, "F_t": 1715.0}
    formula = stress.formula
    for key, known in stress.inputs.items():
        formula = formula.replace(f"{{{key}}}", repr(float(put.get(key, known.value))))
    thesis = eval(formula, {"sqrt": math.sqrt})
    assert thesis == pytest.approx(of["sigma_H"]["sigma_H_MPa"], rel=1e-12)


def test_gost_form_factors_by_hand() -> None:
    """Y_FS of 25 teeth without shift: 3.47 + 13.2 / 25; with x = 0.5 less by 29.7 x / z - 0.092 x^2."""
    found = values("module=2", "number_of_teeth=25", GOST)["values"]["whole_form_factor"]
    assert found == {"first": pytest.approx(3.998), "second": pytest.approx(3.998)}
    found = values("module=2", "number_of_teeth=25", GOST, "profile_shift_coefficient=0.5")["values"]
    assert found["whole_form_factor"]["first"] == pytest.approx(3.998 - 0.594 + 0.023)


# from 13 N/mm to 272, from 652 to 272 and to less than 100, up to which the dynamic factor is that at 100
_FAST = ("speed_rpm=1500", "accuracy_grade=8")


@pytest.mark.parametrize(
    ("method", "typed"),
    [("ISO 6336", ("torque=30",)), ("ISO 6336:2006", ("torque=30",)), ("GOST 21354", ("torque=30",)),
     ("ISO 6336", ("torque=10", *_FAST)), ("ISO 6336", ("torque=500", *_FAST)),
     ("ISO 6336", ("torque=500", "flank_factor=0.4", *_FAST)), ("GOST 21354", ("torque=10", *_FAST))],
)  # fmt: skip
def test_the_torque_that_is_allowed_leaves_the_least_safety(method: str, typed: tuple[str, ...]) -> None:
    keys = (*PAIR, f"method={method}", "contact_limit=1300", "bending_limit=400", "least_contact_safety=1.1",
            "least_bending_safety=1.4", "helix_angle_deg=12", "face_width=25")  # fmt: skip
    allowed = values(*keys, *typed)["values"]["allowed_torque"]
    found = values(*keys, *typed[1:], f"torque={allowed!r}")["values"]
    shares = [found["contact_safety"][g] / 1.1 for g in ("first", "second")]
    shares += [found["bending_safety"][g] / 1.4 for g in ("first", "second")]
    assert min(shares) == pytest.approx(1, rel=1e-12)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("key", "one", "two", "method"),
    [
        ("contact_limit", 900, 1200, ""), ("bending_limit", 300, 400, ""), ("flank_factor", 0.9, 0.95, ""),
        ("contact_size_factor", 0.9, 0.95, ""), ("hardening_factor", 1.1, 1.2, ""), ("surface_factor", 0.9, 1.1, ""),
        ("gradient_factor", 0.9, 1.1, ""), ("reversing_factor", 0.7, 0.9, ""), ("yield_strength", 500, 900, ""),
        ("root_roughness", 5, 30, ""), ("rim_thickness", 4, 5, ""), ("hardness", 220, 300, ""),
        ("material_quality", '"ML"', '"ME"', ""), ("material_group", '"IF"', '"V alloy"', ""),
        ("form_factor", 3.5, 4.0, GOST), ("flank_factor", 0.9, 0.95, GOST), ("surface_factor", 0.9, 1.1, GOST),
        ("gradient_factor", 0.9, 1.1, GOST), ("reversing_factor", 0.7, 0.9, GOST), ("hardness", 220, 300, GOST),
    ],
)  # fmt: skip
def test_a_list_has_the_first_gears_value_first(key: str, one: object, two: object, method: str) -> None:
    """Each gear bears and is loaded as if its value stood alone, and another value is another number."""
    rest = {"material_group": '"V alloy"', "hardness": 250, "load_cycles": 1e6, "torque": 20}
    told = [f"{k}={v}" for k, v in rest.items() if k != key] + ([method] if method else [])
    names = ("contact_strength", "root_strength", "root_stress")
    found = {
        given_value: {n: values(*PAIR, *told, f"{key}={given_value}")["values"][n] for n in names}
        for given_value in (f"[{one},{two}]", f"{one}", f"{two}")
    }
    listed, first, second = found.values()
    # a hard mate hardens a soft gear
    names = names[1:] if key == "material_group" else names
    for name in names:
        assert listed[name]["first"] == pytest.approx(first[name]["first"], rel=1e-12)
        assert listed[name]["second"] == pytest.approx(second[name]["second"], rel=1e-12)
    assert any(first[name]["first"] != second[name]["first"] for name in names)


def test_lists_of_words_go_through_any_shell() -> None:
    """Of material_group=["V","Eh"] it leaves [V,Eh], which was refused."""
    rest = (*PAIR, "torque=20", "hardness=[200, 700]", "load_cycles=1e6")
    whole = values(*rest, 'material_group=["V","Eh"]', 'material_quality=["ML","ME"]')
    assert values(*rest, "material_group=[V,Eh]", "material_quality=[ML, ME]") == whole
    assert values(*rest, "material_group=[V alloy,Eh]") == values(*rest, 'material_group=["V alloy", "Eh"]')
    assert values(*rest, "material_group=[V,V]") != whole
    _, refused = made([*PAIR, "material_group=[V,]"])
    assert refused is not None
    assert refused.key == "strength.material_group[2]"


def test_a_key_of_both_gears_is_no_key_of_one() -> None:
    """It was an unknown one, beside a list of those of a gear."""
    _, refused = made([*PAIR, "second.material_group=V"])
    assert refused is not None
    assert "without second. before it" in sentence(refused, "en")


def test_both_gears_stand_in_a_table() -> None:
    keys = (*PAIR, "torque=30", "contact_limit=1300", "bending_limit=400")
    found = values(*keys)
    rows = list(csv.DictReader(io.StringIO(calculate("strength", keys, "csv", "en"))))
    assert [*rows[0]] == [
        "gear",
        "σ_H (MPa)",
        "σ_HG (MPa)",
        "S_H",
        "σ_F (MPa)",
        "σ_FG (MPa)",
        "S_F",
        "T_H (N*m)",
        "T_F (N*m)",
    ]
    for row, gear in zip(rows, ("first", "second"), strict=True):
        assert float(row["S_F"]) == pytest.approx(found["values"]["bending_safety"][gear], rel=1e-6)
        assert float(row["T_H (N*m)"]) == pytest.approx(found["values"]["contact_torque"][gear], rel=1e-6)
    # GOST has one contact stress of both
    keys = (*PAIR, "torque=30", "contact_limit=1300", GOST)
    rows = list(csv.DictReader(io.StringIO(calculate("strength", keys, "csv", "en"))))
    assert rows[0]["σ_H (MPa)"] == rows[1]["σ_H (MPa)"]


@pytest.mark.parametrize("widths", [(30, 20), (20, 30)])
def test_the_narrower_face_bears(widths: tuple[int, int]) -> None:
    """By hand: sigma_H0 falls with the root of the common width, 20 mm."""
    each, whole = (f"first.face_width={widths[0]}", f"second.face_width={widths[1]}"), ("face_width=80",)
    bare, wide = (values(*PAIR, "torque=10", *keys)["values"] for keys in (each, whole))
    assert bare["face_width"] == 20
    assert bare["nominal_contact_stress"] == pytest.approx(2 * wide["nominal_contact_stress"])


def test_factors_of_soft_and_hard_flanks_by_hand() -> None:
    """ISO 6336-2: Z_W = 1.2 - (HB - 130) / 1700 of a soft gear on a hard one alone, C_ZL = 0.83 of the softer one."""
    mixed = values(*PAIR, 'material_group=["Eh","V alloy"]', "hardness=[700,240]", "oil_viscosity=100")["values"]
    assert mixed["hardening_factor"] == {"first": 1.0, "second": pytest.approx(1.2 - 110 / 1700)}
    # ISO 6336-2: (3 / R_zH)^0.15 beside it, where roughness, oil and speed tell R_zH: 3 um or less smooth, 16 at most
    curvature, oil = 30 * 61.5 / 91.5 * math.sin(math.radians(20)), (100 * math.pi / 1500) ** 0.33
    run = 5 * (10 / curvature) ** 0.33 * (5 / 6) ** 0.66 / oil
    for soft, groups, hardness in (
        ("second", '["Eh","V alloy"]', "[700,240]"),
        ("first", '["V alloy","Eh"]', "[240,700]"),
    ):
        for height, roughness in ((5, run), (1, 3), (40, 16)):
            heights = [height, 6] if soft == "second" else [6, height]
            typed = (f"material_group={groups}", f"hardness={hardness}", f"flank_roughness={heights}")
            rough = values(*PAIR, *typed, "oil_viscosity=100", "speed_rpm=1000")["values"]["hardening_factor"]
            assert rough[soft] == pytest.approx((1.2 - 110 / 1700) * (3 / roughness) ** 0.15)
    # no hard flank grows harder, nor one of iron
    for groups, hardness in (('["NV","Eh"]', "[450,700]"), ('["Eh","GG"]', "[700,200]"), ('["GGG","Eh"]', "[200,700]")):
        still = values(*PAIR, f"material_group={groups}", f"hardness={hardness}")["values"]
        assert still["hardening_factor"] == {"first": 1.0, "second": 1.0}
    for limits in ("[1300,800]", "[800,1300]"):
        assert values(*PAIR, f"contact_limit={limits}", "oil_viscosity=100")["values"]["lubricant_coefficient"] == 0.83
    # by GOST 21354-87 Z_v = 0.85 v^0.1 of soft flanks; 10 m/s on a radius of 30 mm
    fast = values(*PAIR, GOST, "contact_limit=500", f"speed_rpm={1e4 / math.pi}")["values"]
    assert fast["gost_flank_factor"]["first"] == pytest.approx(0.85 * 10**0.1)


@pytest.mark.parametrize(
    ("typed", "told"),
    [((*PAIR, "material_group=V alloy", "hardness=360"), False),
     ((*PAIR, "material_group=V alloy", "hardness=361"), True),
     ((*RING, "rim_thickness=[30,3.51]"), False), ((*RING, "rim_thickness=[30,3.49]"), True)],
)  # fmt: skip
def test_remarks_begin_at_the_limits_of_the_standard(typed: tuple[str, ...], told: bool) -> None:
    """ISO 6336-5: lines of alloyed steel hold to 360 HV; ISO 6336-3: rims of rings from 1.75 modules on."""
    notes = values(*typed)["notes"]
    assert any("is outside" in note or "too thin" in note for note in notes) == told


def test_the_load_helps_no_tooth() -> None:
    """Twice the torque is twice the bending stress and sqrt 2 of the contact stress."""
    one, two = (values(*PAIR, f"torque={t}")["values"] for t in (20, 40))
    for gear in ("first", "second"):
        assert two["root_stress"][gear] == pytest.approx(2 * one["root_stress"][gear], rel=1e-12)
        assert two["flank_contact_stress"][gear] == pytest.approx(
            math.sqrt(2) * one["flank_contact_stress"][gear], rel=1e-12
        )


@pytest.mark.parametrize(
    ("typed", "note"),
    [
        ((*PAIR, "helix_angle_deg=40"), "helix angle 40 deg is beyond 30 deg"),
        (("module=3", "first.number_of_teeth=8", "second.number_of_teeth=40"), "outside 1 to 2.5"),
        (("module=3", "number_of_teeth=200", "pressure_angle_deg=34", "basic_rack.addendum_coefficient=0.8"),
         "no tangent at 30 deg"),
        ((*PAIR, "torque=10", "material_group=St", "hardness=300"), "hardness 300 is outside"),
        ((*PAIR, "torque=10", "rim_thickness=1"), "a rim of 1 mm is too thin"),
        ((*PAIR, "torque=10", "contact_limit=100"), "safety in contact"),
        ((*PAIR, "torque=10", "bending_limit=1"), "safety in bending"),
        ((*PAIR, "basic_rack.tip_radius_coefficient=0", "profile_shift_coefficient=0.8"), "outside 1 to 8"),
        ((*PAIR, "torque=10", "speed_rpm=60000", "accuracy_grade=6"), "is beyond 3 m/s"),
        ((*RING, GOST), "no formula for Y_FS of a ring"),
        ((*PAIR, "torque=10", "material_group=V", "hardness=250"), "of its group in contact"),
        ((*PAIR, "torque=10", "material_group=V", "hardness=250"), "of its group in bending"),
        ((*PAIR, "form_factor=3", "pits_allowed=true", "load_cycles=1e6", "material_group=Eh"),
         "ISO 6336 has no form_factor: not used"),
        ((*PAIR, GOST, "oil_viscosity=100", "pits_allowed=true"), "has no pits_allowed, oil_viscosity: not used"),
        ((*PAIR, "method=ISO 6336:2006", "profile_factor=1.1"), "ISO 6336:2006 has no profile_factor: not used"),
        ((*PAIR, GOST, "material_group=Eh"), "without bending_limit the root has no safety"),
        ((*PAIR, "contact_limit=900", "load_cycles=1e5"), "gear 2: the factor of life in contact is taken as 1"),
        ((*PAIR, "bending_limit=900", "load_cycles=1e4"), "gear 2: the factor of life in bending is taken as 1"),
        ((*PAIR, "contact_limit=900", "load_cycles=1e4", GOST), "it needs hardness"),
    ],
)  # fmt: skip
def test_what_is_remarked(typed: tuple[str, ...], note: str) -> None:
    assert any(note in told for told in values(*typed)["notes"])
    assert not values(*PAIR, "torque=10", "contact_limit=1500", "bending_limit=400")["notes"]


@pytest.mark.parametrize(
    ("more", "key"),
    [
        (("method=ISO 6337",), "strength.method"),
        (("application_factor=0",), "strength.application_factor"),
        (("accuracy_grade=2",), "strength.accuracy_grade"),
        (("material_group=steel",), "strength.material_group"),
        (("hardness=[200]",), "strength.hardness"),
        (("bending_limit=-5",), "strength.bending_limit"),
        (("life_hours=100",), "strength.life_hours"),
        (("life_hours=100", "load_cycles=1e6", "speed_rpm=10"), "strength.life_hours"),
        (("torque=5", "power=100"), "strength.power"),
        (("material_group=V", "torque=5"), "strength.material_group"),
        (("kind=rack_pair",), "strength.kind"),
        (("hardnes=200",), "strength.hardnes"),
        (("working_centre_distance=120", "profile_shift_coefficient=0"), "strength.working_centre_distance"),
        (("first.pressure_angle_deg=25",), "strength.second.pressure_angle_deg"),
        (("first.hardness=250",), "strength.first.hardness"),
        (("pits_allowed=true",), "strength.pits_allowed"),
        (("long_life_factor=0.9",), "strength.long_life_factor"),
        (("yield_strength=500",), "strength.yield_strength"),
        (("yield_strength=500", "material_group=Eh"), "strength.yield_strength"),
        (("measured_arc_of_action=9", "measured_working_pitch=9"), "strength.measured_arc_of_action"),
        (("material_group=V", GOST), "strength.material_group"),
        (("first.profile_shift_coefficient=-9",), "strength.first.profile_shift_coefficient"),
    ],
)
def test_what_is_refused(more: tuple[str, ...], key: str) -> None:
    with pytest.raises(SceneError) as refused:
        sheet_of("strength", (*PAIR, "contact_limit=900", *more) if "material_group=V" not in more else (*PAIR, *more))
    assert refused.value.key == key
    assert "\n" not in sentence(refused.value, "en")


FACTORS = ("application_factor=1.5", "dynamic_factor=1.3", "face_load_factor=1.2", "root_face_load_factor=1.1",
           "transverse_load_factor=1.1", "root_transverse_load_factor=1.2")  # fmt: skip
SAFETIES = ("least_contact_safety=1.1", "least_bending_safety=1.4")


@pytest.mark.parametrize(
    ("method", "key"),
    [*(("method=ISO 6336", key) for key in (*FACTORS, *SAFETIES)), *((GOST, key) for key in FACTORS)],
)
def test_what_multiplies_a_load_is_refused_without_one(method: str, key: str) -> None:
    """Without a torque these changed no number of the page, and nobody said so."""
    page, refusal = made([*PAIR, method, key])
    assert page is None
    assert refusal is not None
    assert (refusal.code, refusal.numbers["other"]) == ("needs_other", "torque")
    assert refusal.key == f"strength.{key.partition('=')[0]}"
    assert made([*PAIR, method, key, "torque=10", "contact_limit=900", "bending_limit=300"])[1] is None


OF_LIMITS = ("accuracy_grade=7", "load_cycles=1e5", "oil_viscosity=100", "material_quality=ME", "hardness=200",
             "flank_roughness=5", "root_roughness=20", "flank_factor=0.9", "contact_size_factor=0.9",
             "hardening_factor=1.1", "surface_factor=0.9", "gradient_factor=0.9", "reversing_factor=0.7",
             "speed_rpm=300", "profile_factor=1.1", *SAFETIES)  # fmt: skip


@pytest.mark.parametrize("method", ["method=ISO 6336", GOST])
@pytest.mark.parametrize(
    "given", [(), ("contact_limit=900",), ("bending_limit=300",), ("contact_limit=900", "load_cycles=2e5")]
)
def test_a_key_that_changes_nothing_is_refused(given: tuple[str, ...], method: str) -> None:
    """Of a life, a hardness or an oil without limits nothing was printed, and nobody said so."""
    plain, _ = made([*PAIR, method, *given])
    for key in (key for key in OF_LIMITS if not any(one.startswith(key.partition("=")[0]) for one in given)):
        page, refusal = made([*PAIR, method, *given, key])
        if refusal is not None:
            assert refusal.code == "needs_other"
        # a film of oil is 1 by GOST up to 5 m/s
        elif "speed" not in key or method != GOST:
            assert page is not None
            assert (page.known, page.notes) != (plain.known, plain.notes), key


def test_a_key_is_told_what_it_needs_beside_the_others() -> None:
    """A grade acts by the speed where there is a load; a speed without one by a life in hours."""
    refusal = made([*PAIR, "torque=10", "contact_limit=900", "accuracy_grade=7"])[1]
    assert refusal is not None
    assert (refusal.key, refusal.numbers["other"]) == ("strength.accuracy_grade", "speed_rpm")
    assert made([*PAIR, "bending_limit=300", "life_hours=1000", "speed_rpm=300"])[1] is None


def test_the_command_tells_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    assert "strength.torque = -1" in complaint(capsys, "calc", "strength", *PAIR, "torque=-1")


FACTORS = st.floats(0.01, 3)
KEYS = {
    "torque": st.floats(0.001, 1e4), "helix_angle_deg": st.sampled_from([0, 8, 20, 45]),
    "profile_shift_coefficient": st.floats(-0.5, 1), "face_width": st.floats(1, 200), "method": st.sampled_from(
        ["ISO 6336", "ISO 6336:2006", "GOST 21354", "AGMA 2001"]), "application_factor": FACTORS,
    "dynamic_factor": FACTORS, "accuracy_grade": st.integers(1, 13), "face_load_factor": FACTORS,
    "load_cycles": st.floats(0.1, 1e12), "life_hours": st.floats(1, 1e6), "speed_rpm": st.floats(0.1, 1e5),
    "material_group": st.sampled_from(["St", "V", "Eh", "GG", "NV", "wood"]), "hardness": st.floats(50, 900),
    "contact_limit": st.floats(-1, 2000), "bending_limit": st.floats(1, 900), "flank_roughness": st.floats(0.1, 50),
    "root_roughness": st.floats(0.1, 90), "rim_thickness": st.floats(0.1, 30), "oil_viscosity": st.floats(1, 1000),
    "profile_factor": st.floats(0.9, 1.3), "circumferential_thinning": st.floats(0, 0.3),
    "long_life_factor": st.floats(0.8, 1.1), "yield_strength": st.floats(100, 1500), "form_factor": FACTORS,
}  # fmt: skip


CHOSEN = st.dictionaries(st.sampled_from([*KEYS]), st.none(), max_size=6)


@examples(120)
@given(st.integers(6, 60), st.integers(6, 120), st.booleans(), CHOSEN, st.data())
def test_any_keys_make_a_page_or_one_refusal(
    one: int, two: int, ring: bool, chosen: dict[str, None], data: st.DataObject
) -> None:
    keys = [f"first.number_of_teeth={one}", f"second.number_of_teeth={two}", "module=2"]
    keys += ["second.kind=ring_gear"] if ring else []
    keys += [f"{name}={data.draw(KEYS[name])}" for name in chosen]
    sheet, refused = made(keys)
    if refused is not None:
        assert refused.key.startswith("strength")
        assert sentence(refused, "uk")
    for step in sheet.steps() if sheet else ():
        if isinstance(step.value, float):
            assert math.isfinite(step.value), (step.name, keys)
        if step.formula:
            assert evaluated(step) == pytest.approx(step.value, rel=1e-8, abs=1e-9), (step.name, keys)
    assert sheet is None or render(sheet, "text", "uk")


def made(keys: list[str]) -> tuple[Sheet | None, SceneError | None]:
    """The page of keys, or its refusal."""
    try:
        return sheet_of("strength", keys)[0], None
    except SceneError as refused:
        return None, refused


def test_a_plain_pair_imports_nothing_of_strength() -> None:
    """Whoever asks for no strength does not load it."""
    code = (
        "import sys; from exporters.documents.topics import calculate\n"
        "calculate('gear-pair', ['practicum_pair'], 'text', 'en')\n"
        "print([m for m in sys.modules if 'strength' in m])"
    )
    told = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == "[]"

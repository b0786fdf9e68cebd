"""Shift tables against the printed ones, their own equalising shift, and classes of side clearance."""

from __future__ import annotations

import json
import math
from itertools import pairwise
from pathlib import Path

import pytest

from geometry.base.errors import Nearest, ParameterError
from geometry.gears.pairs.external import external_pair
from geometry.gears.pairs.side_clearance import (
    SIDE_CLEARANCE_CLASSES,
    guaranteed_normal_backlash,
    normal_from_circumferential,
)
from geometry.gears.shifts.external import ShiftPair, state_of
from geometry.gears.shifts.tables import MENDED, gost_16532, guidelines, kudryavtsev
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.spur import SpurGear

PRINTED = json.loads(
    (Path(__file__).parents[3] / "published" / "shift_tables_as_printed.json").read_text(encoding="utf-8")
)
RACK = iso_53()
# cells off their neighbours by 2 to 4 thousandths, left as printed: table, z1, z2
DOUBTED = (("В.1", 15, 30), ("В.1", 17, 31), ("В.1", 18, 18), ("Г.1", 13, 50), ("Г.1", 13, 60))


def teeth(key: str) -> tuple[int, int]:
    one, two = key.split("/")
    return int(one), int(two)


def exact_shortening(z1: int, z2: int, x1: float, x2: float) -> float:
    """Delta y of a pair from its working angle."""
    return state_of(ShiftPair(z1, z2, RACK), x1, x2).tip_shortening


def test_table_v_is_the_printed_one_but_for_the_misprints() -> None:
    for key, printed in PRINTED["V"].items():
        found = kudryavtsev(*teeth(key))
        right = PRINTED["V_misprints"].get(key, printed)
        assert [found.first, found.second] == right
        assert found.table == "В.1"
        assert (found.mended is not None) == (key in PRINTED["V_misprints"])
        if found.mended is not None:
            assert list(found.mended.printed) == printed
            assert list(found.mended.right) == right


def test_table_g_is_the_printed_one_but_for_the_misprints() -> None:
    count = 0
    for key, printed in PRINTED["G"].items():
        z1, z2 = teeth(key)
        if z2 < 2 * z1 or key in PRINTED["V"]:
            continue
        count += 1
        found = kudryavtsev(z1, z2)
        assert found.second == PRINTED["G_misprints"].get(key, printed)
        assert [found.tip_shortening, found.first] == PRINTED["B"][str(z1)]
    assert count > 120
    assert {(m.first_teeth, m.second_teeth) for m in MENDED if m.table == "Г.1"} == {
        teeth(k) for k in PRINTED["G_misprints"]
    }


def test_every_cell_gives_the_equalising_shift_of_its_table() -> None:
    """The tables' own law, which shows the misprints: Delta y = x1 + x2 - y is that of table А or Б."""
    doubted = {(z1, z2) for _, z1, z2 in DOUBTED}
    for key in PRINTED["V"]:
        z1, z2 = teeth(key)
        found = kudryavtsev(z1, z2)
        exact = exact_shortening(z1, z2, found.first, found.second)
        slack = 1e-3 if (z1, z2) in doubted else 6e-4
        assert abs(exact - PRINTED["A"][str(z1)]) < slack, key
        if found.mended is not None:
            printed = found.mended.printed
            assert abs(exact_shortening(z1, z2, *printed) - PRINTED["A"][str(z1)]) > 1.4e-3, key
    for key in PRINTED["G"]:
        z1, z2 = teeth(key)
        if z2 >= 2 * z1 and key not in PRINTED["V"]:
            found = kudryavtsev(z1, z2)
            assert found.table == "Г.1"
            assert abs(exact_shortening(z1, z2, found.first, found.second) - PRINTED["B"][str(z1)][0]) < 2e-3, key


def test_between_the_rows_of_table_g() -> None:
    found = kudryavtsev(12, 47)
    low, high = kudryavtsev(12, 45), kudryavtsev(12, 50)
    assert found.between == (45, 50)
    assert found.second == pytest.approx(low.second + 0.4 * (high.second - low.second), rel=1e-12)
    assert found.tip_shortening == 0.17
    assert kudryavtsev(13, 21).tip_shortening == 0.16


def test_at_u_2_each_table_has_what_the_other_lacks() -> None:
    """Both are headed for u = 2; В.1 has columns z1 = 11 to 18 up to z2 = 35, Г.1 goes on."""
    tables = {(z1, 2 * z1): kudryavtsev(z1, 2 * z1) for z1 in range(10, 25)}
    assert {pair for pair, found in tables.items() if found.table == "В.1"} == {(z, 2 * z) for z in range(11, 18)}
    for z1, x1, x2, shortening in ((10, 0.59, 0.397, 0.15), (20, 1.22, 0.547, 0.25)):
        found = tables[z1, 2 * z1]
        assert (found.first, found.second, found.tip_shortening) == (x1, x2, shortening)
    assert tables[18, 36].between == (35, 40)
    for pair, found in tables.items():
        assert found.tip_shortening is not None
        assert exact_shortening(*pair, found.first, found.second) == pytest.approx(found.tip_shortening, abs=1e-3)


def test_the_guidelines() -> None:
    for key, shifts in PRINTED["guidelines_2_1"].items():
        found = guidelines(*teeth(key))
        assert [found.first, found.second] == shifts


@pytest.mark.parametrize(("function", "pair", "expected"), [
    (kudryavtsev, (8, 20), "10/20"), (kudryavtsev, (13, 80), "16/80"), (kudryavtsev, (20, 30), "18/30"),
    (kudryavtsev, (12, 61), "12/60"), (kudryavtsev, (21, 13), Nearest(13, "at_most")), (guidelines, (13, 21), "12/12"),
    (gost_16532, (9, 30), Nearest(10, "at_least")),
], ids=lambda v: getattr(v, "__name__", str(v)))  # fmt: skip
def test_pairs_beyond_the_tables_get_the_nearest(function, pair, expected) -> None:
    with pytest.raises(ParameterError) as refused:
        function(*pair)
    assert (refused.value.nearest or refused.value.numbers["known"]) == expected


def test_gost_16532() -> None:
    assert [(s.first, s.second) for s in gost_16532(24, 40)] == [(0.0, 0.0), (0.5, 0.5)]
    assert [(s.first, s.second) for s in gost_16532(16, 60)] == [(0.3, -0.3), (0.5, 0.5)]
    assert [(s.first, s.second) for s in gost_16532(16, 40)] == [(0.5, 0.5)]
    assert [(s.first, s.second) for s in gost_16532(14, 30, kinematic=True)] == [(0.3, -0.3)]
    with pytest.raises(ParameterError) as refused:
        gost_16532(14, 20, kinematic=True)
    assert refused.value.nearest == Nearest(22, "at_least")
    # what they are for: no undercut
    for z1, z2 in ((24, 40), (16, 60), (14, 30)):
        for shifts in gost_16532(z1, z2):
            assert shifts.first > 0.99997 - z1 * math.sin(math.radians(20)) ** 2 / 2


def test_side_clearance_classes_are_tolerance_grades() -> None:
    """Classes E to A are IT7 to IT11 of ISO 286: 16, 25, 40, 64, 100 i with i = 0.45 D^(1/3) + 0.001 D (D in mm)."""
    units = {"E": 16, "D": 25, "C": 40, "B": 64, "A": 100}
    steps = (30, 50, 80, 120, 180, 250, 315, 400, 500)
    for name, factor in units.items():
        for low, high in pairwise(steps[1:]):
            size = math.sqrt(low * high)
            unit = 0.45 * size ** (1 / 3) + 0.001 * size
            distance = min(0.5 * (low + high), 1990)
            assert guaranteed_normal_backlash(name, distance) * 1000 == pytest.approx(factor * unit, rel=0.06), (
                name,
                low,
            )
    assert guaranteed_normal_backlash("H", 100) == 0
    assert [guaranteed_normal_backlash("C", a) for a in (80, 80.01, 125, 2000)] == [0.074, 0.087, 0.087, 0.370]
    for name in SIDE_CLEARANCE_CLASSES[1:]:
        values = [guaranteed_normal_backlash(name, a) for a in range(50, 2001, 50)]
        assert values == sorted(values)
    for wrong in (("F", 100), ("C", 2001)):
        with pytest.raises(ParameterError, match="side_clearance_class"):
            guaranteed_normal_backlash(*wrong)


# ISO 286-1:2010, table 1: standard tolerance grades, micrometres, of sizes over each step up to the next one
STEPS = (50, 80, 120, 180, 250, 315, 400, 500, 630, 800, 1000, 1250, 1600, 2000)
GRADES = {
    "E": (30, 35, 40, 46, 52, 57, 63, 70, 80, 90, 105, 125, 150),
    "D": (46, 54, 63, 72, 81, 89, 97, 110, 125, 140, 165, 195, 230),
    "C": (74, 87, 100, 115, 130, 140, 155, 175, 200, 230, 260, 310, 370),
    "B": (120, 140, 160, 185, 210, 230, 250, 280, 320, 360, 420, 500, 600),
    "A": (190, 220, 250, 290, 320, 360, 400, 440, 500, 560, 660, 780, 920),
}


@pytest.mark.parametrize("name", GRADES)
def test_a_class_has_its_grade_in_every_range(name: str) -> None:
    """IT7 to IT11; ranges end with their upper number, of which GOST 1643 has 125 where ISO 286 has 120."""
    for low, high, grade in zip(STEPS[:-1], STEPS[1:], GRADES[name], strict=True):
        low, high = (125 if x == 120 else x for x in (low, high))
        for distance in (low + 1e-6, (low + high) / 2, high):
            assert guaranteed_normal_backlash(name, distance) == grade / 1000
            assert guaranteed_normal_backlash("H", distance) == 0.0
    assert guaranteed_normal_backlash(name, 1.0) == GRADES[name][0] / 1000
    with pytest.raises(ParameterError) as refused:
        guaranteed_normal_backlash(name, 2000.001)
    assert (refused.value.code, refused.value.numbers) == ("classes_end_at_distance", {"distance": 2000})
    with pytest.raises(ParameterError) as refused:
        guaranteed_normal_backlash(name.lower(), 100.0)
    assert (refused.value.code, refused.value.nearest) == ("not_one_of", Nearest("C"))
    assert refused.value.numbers == {"known": ("H", "E", "D", "C", "B", "A")}


def test_mended_cells_tell_what_is_printed_and_what_is_right() -> None:
    for mended in MENDED:
        key = f"{mended.first_teeth}/{mended.second_teeth}"
        printed, right = PRINTED[mended.table[0].replace("В", "V").replace("Г", "G")], "V_misprints"
        if mended.table == "Г.1":
            right = "G_misprints"
            assert (mended.printed, mended.right) == ((printed[key],), (PRINTED[right][key],))
            assert kudryavtsev(mended.first_teeth, mended.second_teeth).mended is mended
        else:
            assert (list(mended.printed), list(mended.right)) == (printed[key], PRINTED[right][key])


def test_where_the_rules_of_gost_16532_begin_and_end() -> None:
    zero, third, half = (0.0, 0.0), (0.3, -0.3), (0.5, 0.5)
    for pair, kinematic, wanted in (
        ((20, 20), False, [half]), ((21, 21), False, [zero, half]), ((30, 31), False, [zero, half]),
        ((31, 31), False, [zero]), ((14, 49), False, [third, half]), ((14, 48), False, [half]),
        ((13, 60), False, [half]), ((20, 70), False, [third, half]), ((10, 10), False, [half]),
        ((21, 80), False, [zero, half]), ((17, 17), True, [zero]), ((16, 22), True, [third]), ((12, 22), True, [third]),
        ((17, 40), True, [zero]),
    ):  # fmt: skip
        found = gost_16532(*pair, kinematic=kinematic)
        assert [(s.first, s.second) for s in found] == wanted
        assert {(s.table, s.tip_shortening, s.mended, s.between) for s in found} == {
            ("GOST 16532-70", None, None, None)
        }
    for pair, kinematic, key, code, least in (
        ((9, 20), False, "first.number_of_teeth", "no_recommendation", 10),
        ((11, 30), True, "first.number_of_teeth", "no_recommendation", 12),
        ((12, 21), True, "second.number_of_teeth", "no_recommendation_with", 22),
        ((16, 21), True, "second.number_of_teeth", "no_recommendation_with", 22),
    ):  # fmt: skip
        with pytest.raises(ParameterError) as refused:
            gost_16532(*pair, kinematic=kinematic)
        assert (refused.value.name, refused.value.code) == (key, code)
        assert refused.value.nearest == Nearest(least, "at_least")


def test_pairs_at_the_ends_of_the_tables() -> None:
    """Five times as many teeth at most; rows of table Г.1 begin and end with their z1."""
    assert kudryavtsev(12, 60).between is None
    for pair in ((10, 51), (16, 81), (10, 19), (19, 19)):
        with pytest.raises(ParameterError) as refused:
            kudryavtsev(*pair)
        assert refused.value.code == "not_in_table"
        one, two = map(int, str(refused.value.numbers["known"]).split("/"))
        kudryavtsev(one, two)
    found = kudryavtsev(11, 23)
    low, high = PRINTED["G"]["11/20"], PRINTED["G"]["11/25"]
    assert found.between == (20, 25)
    assert found.second == pytest.approx(low + 0.6 * (high - low))
    assert (found.first, found.tip_shortening) == (0.66, 0.16)


def test_a_backlash_along_the_working_circle_is_the_normal_one() -> None:
    asked = 0.12
    # A_1 + A_2 = j_bn / cos(alpha)
    thin = asked / math.cos(math.radians(20)) / 2
    gears = [SpurGear(3.0, z, RACK, 0.2, circumferential_thinning=thin) for z in (20, 31)]
    pair = external_pair(gears[0], gears[1])
    assert pair.normal_backlash == pytest.approx(asked, rel=1e-12)
    assert normal_from_circumferential(pair.circumferential_backlash, pair.working_pressure_angle) == pytest.approx(
        asked
    )

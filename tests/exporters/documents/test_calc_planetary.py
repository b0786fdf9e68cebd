"""``higherpair calc planetary``: published sets, the research's counts, each refusal in one line, both languages."""

from __future__ import annotations

import csv
import io
import json
import math
import re
from fractions import Fraction
from typing import Any

import pytest

from exporters.documents.render import SPOKEN, render
from exporters.documents.topics import calculate, sheet_of
from parts.base.refusal import SceneError
from parts.base.texts import words
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.documents.test_calc import evaluated

DAVID = ("scheme=david", "teeth=[50,30,20,60]", "satellites=4")
SHEETS = [("ratio=2.5",), ("ratio=12", "rows=2"), ("teeth=[33,21,75]",), DAVID, ("scheme=david", "ratio=-9", "rows=3"),
          ("scheme=two_internal", "teeth=[88,48,12,132]", "second_module=1", "module=3", "satellites=1"),
          ("scheme=one_external_one_internal", "ratio=1.3", "held=first", "driver=second", "rows=2"),
          ("teeth=[33,21,75]", "driver=carrier", "held=first"),
          ("teeth=[33,21,75]", "driver=second", "held=carrier")]  # fmt: skip


def calculated(*keys: str) -> dict[str, Any]:
    return json.loads(calculate("planetary", keys, "json", "en"))


def refused(*keys: str) -> str:
    with pytest.raises(SceneError) as caught:
        calculate("planetary", keys, "text", "en")
    line = str(caught.value)
    assert "\n" not in line
    return line


@pytest.mark.sampled(2)
@pytest.mark.parametrize("keys", SHEETS, ids=" ".join)
def test_every_printed_formula_gives_its_value(keys: tuple[str, ...]) -> None:
    steps = [s for s in sheet_of("planetary", keys)[0].steps() if s.formula]
    assert len(steps) >= 5
    for step in steps:
        assert evaluated(step) == pytest.approx(step.value, rel=1e-12), (step.name, step.formula)


@pytest.mark.parametrize("keys", [SHEETS[0], DAVID])
def test_both_languages_in_every_format(keys: tuple[str, ...]) -> None:
    page, _ = sheet_of("planetary", keys)
    for form in SPOKEN:
        one, two = (render(page, form, language) for language in ("en", "uk"))
        assert one != two
        if form != "json":
            assert words("uk").say(page.title) in two


@pytest.mark.parametrize(
    ("keys", "ratio"),
    [
        # Norton P9; a compound set after Khurmi: arithmetic only
        (("teeth=[33,21,75]",), "36/11"),
        (("scheme=david", "teeth=[30,27,24,21]", "driver=carrier"), "80/17"),
        # seed 001, examples 7, 8, 9, 10 and the practicum's three, stage by stage
        (("teeth=[40,40,120]", "satellites=4"), "4"),
        (("scheme=david", "teeth=[40,30,20,60]"), "-5/4"),
        (("scheme=david", "teeth=[50,30,20,60]", "satellites=4"), "-4/5"),
        (("scheme=david", "teeth=[72,48,45,75]", "driver=carrier", "held=second"), "-9"),
        (("teeth=[12,15,42]",), "9/2"),
        (("scheme=two_internal", "teeth=[88,48,4,44]", "satellites=1"), "-5"),
        (("scheme=david", "teeth=[15,33,11,45]", "satellites=1"), "-8"),
        (("teeth=[20,30,80]", "satellites=2"), "5"),
        (("scheme=david", "teeth=[100,101,100,99]", "driver=carrier", "identical=false"), "10000"),
    ],
)
def test_published_ratios(keys: tuple[str, ...], ratio: str) -> None:
    data = calculated(*keys)
    assert data["values"]["exact_ratio"] == ratio
    assert data["values"]["planetary_ratio"] == pytest.approx(float(Fraction(ratio)), rel=1e-15)


def test_what_is_not_coaxial_is_told_with_what_would_be() -> None:
    assert any("57 teeth against 45; m'/m = 19/15" in note for note in
               calculated("scheme=david", "teeth=[30,27,24,21]", "driver=carrier")["notes"])  # fmt: skip
    notes = calculated("scheme=david", "teeth=[15,33,11,45]", "satellites=1")["notes"]
    assert any("48 teeth against 56" in note for note in notes)
    # example 2 in modules 3.5 and 3: both meshes at 84 mm
    assert any("3.5 / 3" in note for note in notes)
    whole = calculated("scheme=david", "teeth=[15,33,11,45]", "satellites=1", "module=3.5", "second_module=3")
    assert whole["values"]["working_centre_distance"] == 84.0
    assert any("z_2 = 40 fits" in note for note in calculated("teeth=[40,20,120]")["notes"])


def test_as_many_sets_as_the_research_counted() -> None:
    """Issue 13: 55 sets at 2.5, two on the bound; three at 12, whose suns need shift."""
    data = calculated("ratio=2.5", "rows=100")
    assert data["values"]["sets_found"] == len(data["sets"]) == 55
    teeth = [(int(r["z_1"]), int(r["z_2"]), int(r["z_3"])) for r in data["sets"]]
    assert {(80, 20, 121), (80, 21, 121)} <= set(teeth)
    assert all((z1 + z3) % 3 == 0 and abs(z1 + 2 * z2 - z3) <= 1 for z1, z2, z3 in teeth)
    twelve = calculated("ratio=12")["sets"]
    assert [(r["z_1"], r["z_2"], r["z_3"]) for r in twelve] == [(11, 55, 121), (12, 60, 132), (13, 65, 143)]
    for row in twelve:
        # x_min of ISO 53 A at 20 degrees
        assert row["x_1"] >= 1 - row["z_1"] * math.sin(math.radians(20)) ** 2 / 2 - 1e-3


def test_shifts_bring_both_meshes_to_one_distance() -> None:
    """Practicum (3.3), (3.4) forwards, of every row of every scheme, by its own inverse involute."""
    from geometry.base.angles import inverse_involute, involute_function

    alpha = math.radians(20)
    for scheme, ratio in (
        ("james", "2.5"),
        ("david", "-9"),
        ("two_internal", "-0.8"),
        ("one_external_one_internal", "20"),
    ):
        for row in calculated(f"scheme={scheme}", f"ratio={ratio}", "rows=8")["sets"]:
            z1, z2, z3, x1, x2, x3 = (row[k] for k in ("z_1", "z_2", "z_3", "x_1", "x_2", "x_3"))
            z2p, x2p = row.get("z_2'", z2), row.get("x_2'", x2)
            signs = {"james": (1, -1), "david": (1, 1), "two_internal": (-1, -1), "one_external_one_internal": (1, -1)}
            for sign, z, x, rim, x_rim in ((signs[scheme][0], z1, x1, z2, x2), (signs[scheme][1], z3, x3, z2p, x2p)):
                span, total = z + sign * rim, x + sign * x_rim
                angle = inverse_involute(involute_function(alpha) + 2 * total * math.tan(alpha) / span)
                assert span / 2 * math.cos(alpha) / math.cos(angle) == pytest.approx(row["a_w"], abs=1e-9)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("teeth", "n", "allowed"),
    # allowed ring addendum without involute interference, by the research
    [("12,10,32", 4, 0.501), ("16,10,36", 4, 0.511), ("10,9,28", 2, 0.449), ("13,13,39", 4, 0.644)],
)
def test_traps_are_assembled_with_interference_named_and_cured(teeth: str, n: int, allowed: float) -> None:
    notes = calculated(f"teeth=[{teeth}]", f"satellites={n}")["notes"]
    told = next(note for note in notes if "the ring's addendum is" in note)
    assert "involute interference" in told
    assert "0.75" in told
    assert float(told.split("at most ")[1].split()[0]) == pytest.approx(allowed, abs=5e-4)
    assert any(note.endswith("by exact contact: CONTACT") for note in notes)
    cure = next(note for note in notes if "removes the interference" in note)
    shift = float(cure.split("x = ")[1].split()[0])
    # KHK: z1 / z2 >= 1 - tan(alpha_a2) / tan(alpha_w), at the build's addendum 0.75 - 0.125 x and equal shifts
    _, z1, z2 = (int(z) for z in teeth.split(","))
    alpha = math.radians(20)

    def clear(x: float) -> bool:
        tip = z2 / 2 - (1 - x - (0.25 - 0.125 * x))
        angle = math.acos(z2 / 2 * math.cos(alpha) / tip)
        return z1 / z2 >= 1 - math.tan(angle) / math.tan(alpha)

    assert clear(shift)
    assert not clear(shift - 0.02)


def test_three_satellites_of_40_40_120_are_refused_with_what_works() -> None:
    line = refused("teeth=[40,40,120]")
    assert "satellites = 3" in line
    assert "4 works" in line
    assert "39/39/117" in line
    assert "0, 119.25, 240.75" in line
    for keys in (("satellites=4",), ("spacing=unequal",)):
        assert calculated("teeth=[40,40,120]", *keys)["set"]["works"]
    assert calculated("teeth=[39,39,117]")["set"]["works"]


def test_ferguson() -> None:
    """Research: x sums -0.49044 and +0.50932 at 200 mm, 606 mm across, no two satellites alike."""
    data = calculated("scheme=david", "teeth=[100,101,100,99]", "module=2", "driver=carrier", "identical=false")
    steps = [s for s in data["steps"] if s["name"] == "profile_shift_coefficient"]
    shifts = [s["value"] for s in steps]
    assert data["values"]["working_centre_distance"] == 200.0
    assert shifts[0] + shifts[1] == pytest.approx(-0.49044, abs=5e-6)
    assert shifts[2] + shifts[3] == pytest.approx(0.50932, abs=5e-6)
    assert data["values"]["set_diameter"] == pytest.approx(606, abs=0.5)
    assert len(set(data["clocking"])) == 3
    assert "1 works" in refused("scheme=david", "teeth=[100,101,100,99]", "module=2")


def test_tables_as_csv() -> None:
    rows = list(csv.DictReader(io.StringIO(calculate("planetary", ("ratio=12",), "csv", "en"))))
    assert [float(row["z_3"]) for row in rows] == [121, 132, 143]


@pytest.mark.parametrize(
    ("keys", "parts"),
    [
        (("teeth=[40,40,120]", "satellites=50"), ("satellites = 50", "at most 5 works")),
        (("ratio=0",), ("ratio = 0", "must not be 0")),
        (("teeth=[40,40,2]",), ("= 2", "at least 3")),
        (("teeth=[40,40,30]",), ("ring of 30 teeth", "40")),
        (("teeth=[40,40]",), ("3 wheels",)),
        (("teeth=[40,40,120]", "ratio=4"), ("ratio = 4", "teeth")),
        ((), ("ratio", "teeth")),
        (("ratio=2.5", "driver=second"), ('driver = "second"', "held", '"first" works')),
        (("ratio=2.5", "second_module=2"), ("second_module = 2", "one module")),
        (("ratio=2.5", "least_teeth=200"), ("least_teeth = 200", "is above most_teeth")),
        (("ratio=14.2",), ("ratio = 14.2", "works")),
        (("ratio=2.5", "spacing=unequal"), ('spacing = "unequal"', "needs teeth too")),
        (("teeth=[40,40,120]", "largest_diameter=50"), ("largest_diameter = 50", "needs ratio too")),
        (("scheme=david", "teeth=[30,20,20,30]"), ("transmits nothing",)),
        (("scheme=jemes", "ratio=3"), ('"jemes"', "james")),
        (("idler_train",), ("takes keys only, no scene",)),
    ],
)
def test_refusals_are_one_line(keys: tuple[str, ...], parts: tuple[str, ...]) -> None:
    line = refused(*keys)
    for part in parts:
        assert part in line


def test_the_ratio_that_a_refusal_names_works() -> None:
    line = refused("ratio=14.2")
    ratio = line.split("; ")[-1].split()[0]
    assert calculated(f"ratio={ratio}")["values"]["sets_found"] >= 1


@pytest.mark.parametrize(
    ("ratio", "keys"),
    [
        # two rims have more than one; two meshes alike turn the output back, and have most where the carrier drives
        (40, ["scheme=one_external_one_internal"]),
        (-5, ["scheme=david"]),
        (100, ["scheme=two_internal", "driver=carrier"]),
    ],
)
def test_a_ratio_that_a_scheme_does_not_have_leads_to_one_that_has(ratio: float, keys: list[str]) -> None:
    """Where no tolerance helped, nothing was told but another ratio: 12.46 for 40."""
    told = refused(f"ratio={ratio}").partition("some have it with ")[2].partition(";")[0]
    assert [key.replace('"', "").replace(" = ", "=") for key in told.split(", ")] == keys
    row = calculated(f"ratio={ratio}", *keys)["sets"][0]
    # Willis: w1 / w3 with the carrier held is above 0 where both meshes are alike
    carried = row["z_2"] * row["z_3"] / (row["z_1"] * row["z_2'"]) * (-1 if "one_" in keys[0] else 1)
    assert (1 - carried) ** (1 if len(keys) == 1 else -1) == pytest.approx(ratio, rel=5e-3)


def test_a_ratio_of_other_links_leads_to_them() -> None:
    """Willis: 1 + z1 / z3 where the ring drives the carrier and the sun is held."""
    told = refused("ratio=1.3").partition("some have it with ")[2].partition(";")[0]
    assert told == 'driver = "second", held = "first"'
    row = calculated("ratio=1.3", "driver=second", "held=first")["sets"][0]
    assert 1 + row["z_1"] / row["z_3"] == pytest.approx(1.3, rel=5e-3)


@pytest.mark.heavy
def test_a_scheme_that_is_told_takes_the_module_of_the_second_mesh() -> None:
    asked = ["ratio=3", "second_module=2"]
    told = refused("scheme=two_internal", *asked).partition("some have it with ")[2].partition(";")[0]
    assert calculated(told.replace('"', "").replace(" = ", "="), *asked)["values"]["sets_found"] >= 1


def test_a_ratio_is_told_in_six_digits_where_the_tolerance_takes_them() -> None:
    """Before: 12.4615384615, which is 162/13."""
    assert refused("ratio=1000").endswith("; 12.4615 works")
    assert calculated("ratio=12.4615")["values"]["sets_found"] >= 1
    # where it takes none beside it, all digits
    assert refused("ratio=1000", "ratio_tolerance_percent=1e-6").endswith("; 12.4615384615 works")
    assert calculated("ratio=12.4615384615", "ratio_tolerance_percent=1e-6")["values"]["sets_found"] >= 1


def test_helical_sets_without_shifts_tell_their_contact_ratio() -> None:
    """Before: a traceback, of a condition that had no words."""
    assert "small contact ratio" in calculate("planetary", ("teeth=[24,24,72]", "helix_angle_deg=60"), "text", "en")


def test_a_set_without_shifts_has_no_numbers_in_their_place() -> None:
    text = calculate("planetary", ("ratio=2.5", "pressure_angle_deg=32"), "text", "en")
    assert "∞" not in text
    assert re.search(r"^ *42 +11 +63 .* –( +–)* *$", text, re.MULTILINE)


def test_a_refusal_waits_for_no_search_of_shifts(monkeypatch: pytest.MonkeyPatch) -> None:
    words = ("ratio=2.5", "pressure_angle_deg=45")
    monkeypatch.setattr("geometry.gears.planetary.fitting.Fitting.fit", None)
    with pytest.raises(SceneError) as caught:
        calculate("planetary", words, "text", "en")
    # rack A: 2.25 m tan(alpha) of each flank and the flat between them are pi m / 2 at least
    assert caught.value.nearest is not None
    assert caught.value.nearest.value == pytest.approx(math.degrees(math.atan(math.pi / 4 / 1.25)), abs=2e-4)


def test_without_a_working_pressure_angle_nothing_else_is_told_as_broken() -> None:
    """a cos(alpha_w) = 24 cos 20 deg = 22.55 mm: at 22 mm 19 conditions were told, an addendum of 0.75 over 1.19."""
    told = [note for note in calculated("teeth=[24,24,72]", "working_centre_distance=22")["notes"] if "mesh" in note]
    ending = "without shifts of the rims: no working pressure angle"
    assert told == [f"mesh 1-2 {ending}", f"mesh 2-3 {ending}"]


@pytest.mark.parametrize(
    ("teeth", "helix"),
    [((39, 46, 128), 0.0), ((45, 19, 86), 0.0), ((31, 21, 76), 0.0), ((40, 24, 89), 27.5), ((59, 31, 121), 12.0)],
)
def test_the_contact_ratio_of_teeth_as_made_is_told(teeth: tuple[int, int, int], helix: float) -> None:
    """ISO 21771, of the parts: tips shortened for the sun reach less into the ring, 1.6374 alone was told of 39/46/128.

    Those that keep off the ring's fillets were told to reach them: 1.3201 in place of 1.3166, 1.4017 of 1.3982.
    """
    keys = {"teeth": [*teeth], "satellites": 1, "module": 1.0, "shaft_diameter": 3.0, "pin_diameter": 3.0,
            "helix_angle_deg": helix}  # fmt: skip
    scene = scene_from_dict({"assemblies": [{"kind": "planetary_set", **keys}]}, "t", "t")
    parts, _ = make_parts(scene, "t")
    pinion, ring = parts["satellite"].thing, parts["ring"].thing
    ends = [math.sqrt(gear.tip_radius**2 - gear.base_radius**2) for gear in (pinion, ring)]
    line = math.sqrt(
        (parts["carrier"].keys.pin_circle_diameter / 2) ** 2 - (ring.base_radius - pinion.base_radius) ** 2
    )
    page = calculated(f"teeth=[{','.join(map(str, teeth))}]", "satellites=1", f"helix_angle_deg={helix}")
    told = page["repeated"].get("made_contact_ratio", [page["values"]["made_contact_ratio"]])[-1]
    made = (ends[0] - ends[1] + line) * ring.number_of_teeth / (2 * math.pi * ring.base_radius)
    assert told == pytest.approx(made, abs=1e-9)


@pytest.mark.parametrize("module", [0.01, 0.03])
def test_tips_of_small_modules_yield_as_far_as_those_of_large_ones(module: float) -> None:
    """By modules: rounded to 1e-4 mm whatever the module, those of 0.01 mm lost up to 0.01 modules more."""

    def tip(module: float) -> float:
        sizes = {"module": module, "shaft_diameter": 3 * module, "pin_diameter": 3 * module}
        keys = {"kind": "planetary_set", "teeth": [31, 21, 76], "satellites": 1, **sizes}
        parts, _ = make_parts(scene_from_dict({"assemblies": [keys]}, "t", "t"), "t")
        return float(parts["satellite"].thing.tip_radius) / module

    assert tip(module) == pytest.approx(tip(100.0), abs=1e-3)


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("teeth", "satellites", "least", "most"),
    [((60, 13, 87), 3, 0.0, 14), ((31, 12, 53), 3, 0.0, 8), ((49, 22, 91), 2, 0.0, 8), ((24, 24, 72), 3, 0.0, 5),
     # two rims, the larger one decides; 0.452 mm are left between four
     ((18, 36, 20, 72), 2, 0.3, 4), ((18, 36, 20, 72), 2, 0.5, 3)],
)  # fmt: skip
def test_the_most_satellites_are_those_of_the_tips_with_their_shifts(
    teeth: tuple[int, ...], satellites: int, least: float, most: int
) -> None:
    """Circles of the tips on the circle of the pins, as the recipe makes both; by the teeth 15, 9 and 9 were told."""
    keys = {"teeth": [*teeth], "satellites": satellites, "module": 1.0, "shaft_diameter": 3.0, "pin_diameter": 3.0}
    more = {} if len(teeth) == 3 else {"scheme": "one_external_one_internal"}
    scene = scene_from_dict({"assemblies": [{"kind": "planetary_set", **keys, **more}]}, "t", "t")
    parts, _ = make_parts(scene, "t")
    tip = max(part.thing.tip_radius for name, part in parts.items() if name in ("satellite", "second_satellite"))
    circle = parts["carrier"].keys.pin_circle_diameter / 2
    gaps = [2 * (circle * math.sin(math.pi / n) - tip) for n in (most, most + 1)]
    assert gaps[0] > least > gaps[1]
    words = [f"teeth=[{','.join(map(str, teeth))}]", f"satellites={satellites}", f"least_gap={least}"]
    found = calculated(*words, *(f"{key}={value}" for key, value in more.items()))["values"]
    assert found.get("made_most_satellites", found["most_satellites"]) == most

"""Sprockets: makers' tables, forms by the constructions of their standards, rollers as disks of shapely."""

from __future__ import annotations

import cmath
import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely.geometry import Point, Polygon

from geometry.base.errors import ParameterError, PointedTipError
from geometry.base.findings import Finding
from geometry.base.record import replace
from geometry.curves.curve import Complex
from geometry.curves.line_arc import Arc
from geometry.gears.chains.chain import Chain, chain_of, chains, like_chain
from geometry.gears.chains.sprocket import (
    AnsiForm,
    GostForm,
    IsoForm,
    SeatedForm,
    Sprocket,
    checked_sprocket,
    face_width,
    flank_of,
    sprocket_findings,
    sprocket_side,
)
from geometry.plane.profile import Label, Profile
from tests.sampling import examples

PRINTED = json.loads((Path(__file__).parents[3] / "published" / "sprockets.json").read_text(encoding="utf-8"))
FORMS = (IsoForm(), IsoForm(0.5), IsoForm(1.0), GostForm(), GostForm(displaced=True), AnsiForm())


def named(designation: str) -> Chain:
    """A chain of the table."""
    found = chain_of(designation)
    assert found is not None
    return found


def points(profile: Profile, each: int = 60) -> Complex:
    """Along the outline, arcs by chords."""
    return np.concatenate([s.curve.point(np.linspace(*s.curve.domain, each)[:-1]) for s in profile.segments()])


@pytest.mark.parametrize("row", PRINTED["chains"]["rows"], ids=lambda row: row[0])
def test_chains_of_a_makers_table(row: list[float]) -> None:
    chain = named(str(row[0]))
    sizes = chain.pitch, chain.transverse_pitch, chain.roller_diameter, chain.inner_width, chain.plate_height
    # the maker rounds inches to 0.01 mm in its own way
    assert sizes == pytest.approx(row[1:], abs=0.011)
    assert chain.strands == 2


@pytest.mark.parametrize("row", PRINTED["largest"]["rows"], ids=lambda row: row[0])
def test_the_largest_chains_of_a_makers_table(row: list[float]) -> None:
    """As it was: ISO 606 ended with 48B."""
    chain = named(str(row[0]))
    assert (chain.pitch, chain.transverse_pitch, chain.roller_diameter, chain.inner_width) == tuple(row[1:5])
    assert chain.plate_height == pytest.approx(row[5], abs=0.051)
    assert chain.breaking_load == row[6]


@pytest.mark.parametrize("row", PRINTED["loads"]["rows"], ids=lambda row: row[0])
def test_strands_of_series_b_break_below_as_many_times_the_load_of_one(row: list[float]) -> None:
    """As it was: two strands of 08B broke at 35.6 kN, which is 31.1 in ISO 606."""
    for strands, load in zip((2, 3), row[1:], strict=True):
        assert named(f"{row[0]}-{strands}").breaking_load == pytest.approx(load, rel=2.5e-3)


@pytest.mark.parametrize(
    ("designation", "apart", "load"),
    [("12A-2", 22.78, 62.6), ("12A-3", 22.78, 93.9), ("2ПР-12,7-31,8", 13.92, 31.8), ("3ПР-12,7-45,4", 13.92, 45.4),
     ("2ПР-19,05-64", 22.78, 64), ("3ПР-19,05-96", 22.78, 96), ("2ПР-19,05-72", 25.5, 72), ("3ПР-19,05-108", 25.5, 108),
     ("2ПР-25,4-114", 29.29, 114), ("3ПР-31,75-265,5", 35.76, 265.5), ("2ПР-44,45-344,8", 48.87, 344.8)],
)  # fmt: skip
def test_names_of_gost_tell_the_load_of_all_strands(designation: str, apart: float, load: float) -> None:
    """GOST 13568-97, and its chains of 3/4 inch of 1975, whose strands stood farther apart."""
    chain = named(designation)
    assert (chain.transverse_pitch, chain.breaking_load) == pytest.approx((apart, load))


@pytest.mark.parametrize("row", PRINTED["motorcycles"]["rows"], ids=lambda row: row[0])
def test_chains_of_motorcycles(row: list[float]) -> None:
    chain = named(str(row[0]))
    assert (chain.pitch, chain.roller_diameter) == (row[1], row[2])
    # ISO has the least width, which is that of its other chains of as many eighths of an inch
    assert 0.05 < row[3] - chain.inner_width < 0.14


@pytest.mark.parametrize(
    ("typed", "like"),
    [("8B-1", "08B-1"), ("DIN 8187 08B-1", "08B-1"), ("25H", "ANSI 25"), ("60H-2", "ANSI 60"), ("428H", "428"),
     ("80B", None), ("208A", None), ("C2040", None), ("219", None), ("1/2", None), ("1/2x3/32", "082"),
     ("2ПР-19,05", "PR-19.05-31.8")],
)  # fmt: skip
def test_a_chain_of_another_pitch_is_not_offered(typed: str, like: str | None) -> None:
    """As it was: 28A for 208A, 32B-1 for 219, 12B for 1/2; and 20B, of 31.75 mm, for the motorcycle's 520."""
    assert chain_of(typed) is None
    assert like_chain(typed) == like


def test_numbers_of_japan_are_those_of_ansi() -> None:
    assert named("RS40") == named("ANSI 40")
    assert named("RS60-2") == named("60-2")


@pytest.mark.parametrize(("table", "chain"), [("plate_wheels_081", "081-1"), ("duplex_32B", "32B-2")])
def test_pitch_and_tip_diameters_of_catalogues(table: str, chain: str) -> None:
    for teeth, tip, pitch in PRINTED[table]["rows"]:
        sprocket = Sprocket(teeth, named(chain), IsoForm())
        if pitch is not None:
            # printed to 0.01, some cut off and not rounded
            assert 2 * sprocket.pitch_radius == pytest.approx(pitch, abs=0.035)
        if tip is not None:
            # inside the limits of the standard, which leave makers their choice
            least, most = sprocket.form.tips(sprocket.chain, teeth)
            assert least < tip < most
            assert checked_sprocket(Sprocket(teeth, named(chain), IsoForm(), tip)).tip_radius == tip / 2


def test_sizes_of_a_sprocket_08b_by_hand() -> None:
    """z = 17, p = 12.7, d1 = 8.51, b1 = 7.75: every formula of ISO 606, put in by hand to four figures and more."""
    form, chain = IsoForm(), named("08B-1")
    sprocket = Sprocket(17, chain, form, face_width=1.0)
    assert 2 * sprocket.pitch_radius == pytest.approx(69.1158, abs=1e-4)
    assert 2 * sprocket.root_radius == pytest.approx(60.6058, abs=1e-4)
    assert form.tips(chain, 17) == pytest.approx((72.1105, 76.4808), abs=1e-4)
    # M_R = d cos(90 deg / z) + d_R, 17 is odd; of 18 teeth d + d_R with d = 73.1364
    assert sprocket.over_pins == pytest.approx(69.1158 * math.cos(math.radians(90 / 17)) + 8.51, abs=2e-4)
    assert Sprocket(18, chain, form).over_pins == pytest.approx(73.1364 + 8.51, abs=1e-4)
    assert face_width(chain, form) == pytest.approx(0.93 * 7.75)
    assert face_width(named("16B-1"), form) == pytest.approx(0.95 * 17.02)
    assert face_width(named("08B-2"), form) == pytest.approx(0.91 * 7.75)
    assert face_width(named("16B-3"), form) == pytest.approx(0.93 * 17.02)
    # GOST 591-69
    assert face_width(chain, GostForm()) == pytest.approx(0.93 * 7.75 - 0.15)
    assert face_width(named("08B-2"), GostForm()) == pytest.approx(0.90 * 7.75 - 0.15)
    assert sprocket.plate_room == pytest.approx(12.7 / math.tan(math.pi / 17) - 1.04 * 11.81 - 0.76)
    assert [form.flank_radius(8.51, 17), IsoForm(1.0).flank_radius(8.51, 17)] == pytest.approx([19.4028, 31.9295])
    assert [form.seating_radius(8.51), IsoForm(1.0).seating_radius(8.51)] == pytest.approx([4.2976, 4.4384], abs=1e-4)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("teeth", [11, 12])
def test_callipers_find_the_chord_between_roots(form: IsoForm | SeatedForm, teeth: int) -> None:
    """The least distance of two opposite gaps, point by point; pins pressed into seats of GOST stand that far apart."""
    sprocket = Sprocket(teeth, named("ПР-19,05-31,8"), form)
    side = [s.curve for s in sprocket_side(sprocket).segments if s.label is Label.ROOT_FILLET]
    half = np.concatenate([curve.point(np.linspace(*curve.domain, 400)) for curve in side])
    half *= cmath.rect(1.0, sprocket.pitch_angle / 2)
    gap = np.concatenate([half, half.conj()])
    other = gap * cmath.rect(1.0, sprocket.pitch_angle * (teeth // 2))
    found = float(np.min(np.abs(gap[:, None] - other)))
    assert sprocket.root_chord == pytest.approx(found, abs=1e-4)
    # no point lies nearer, of the seats of ANSI but for the rounding of the one that is nearest
    assert sprocket.root_chord <= found * (1 + 1e-15 * isinstance(form, AnsiForm))
    if isinstance(form, SeatedForm):
        assert sprocket.over_pins == pytest.approx(found + 2 * 11.91, abs=1e-4)


@pytest.mark.parametrize("displaced", [False, True])
@pytest.mark.parametrize(
    ("chain", "teeth"), [("ПР-25,4-60", 25), ("ПР-12,7-18,2", 9), ("ПР-38,1-127", 40), ("ПР-9,525-9,1", 60)]
)
def test_gost_gaps_have_the_centres_of_their_standard(chain: str, teeth: int, displaced: bool) -> None:
    """Centres O, O1, O2 by the coordinates that GOST 591-69 gives, x across the gap and y outwards from O."""
    found = named(chain)
    size, sprocket = found.roller_diameter, Sprocket(teeth, found, GostForm(displaced))
    alpha, beta = math.radians(55 - 60 / teeth), math.radians(18 - 56 / teeth)
    radius = 0.5025 * size + 0.05
    centre = sprocket.pitch_radius + (0.5j * 0.03 * found.pitch if displaced else 0j)
    seat, wide = complex(0.8 * size * math.cos(alpha), -0.8 * size * math.sin(alpha)), 1.24 * size
    head = wide * complex(-math.sin(math.pi / teeth), math.cos(math.pi / teeth))
    turned = cmath.rect(1.0, -math.pi / teeth)
    wanted = [(centre + o) * turned for o in (0j, seat, head)]
    arcs = [s.curve for s in sprocket_side(sprocket).segments if isinstance(s.curve, Arc) and s.label != Label.TIP_LAND]
    assert [arc.centre for arc in arcs] == pytest.approx(wanted, abs=1e-9 * sprocket.tip_radius)
    assert [arc.radius for arc in arcs[:2]] == pytest.approx([radius, 0.8 * size + radius])
    assert arcs[1].sweep == pytest.approx(-beta)
    # D_e = t (K + cot(180 deg / z)), K by the pitch over the roller: 0.532 of 1.6, 0.480 of 1.49 and 1.5, 0.575 of 1.71
    height = {"ПР-25,4-60": 0.532, "ПР-12,7-18,2": 0.480, "ПР-38,1-127": 0.575, "ПР-9,525-9,1": 0.480}[chain]
    assert 2 * sprocket.tip_radius == pytest.approx(found.pitch * (height + 1 / math.tan(math.pi / teeth)))


def test_pitch_diameters_of_a_table_for_one_inch() -> None:
    for teeth, diameter in enumerate(PRINTED["one_inch"]["diameters"], PRINTED["one_inch"]["from"]):
        assert 2 * Sprocket(teeth, named("16B"), IsoForm()).pitch_radius == pytest.approx(diameter, abs=0.0051), teeth


@pytest.mark.parametrize("row", PRINTED["ansi"]["rows"], ids=lambda row: str(row[0]))
def test_chains_and_teeth_of_ansi(row: list[float]) -> None:
    """Its inches, rounded to 0.001, beside the millimetres that ISO 606 has for the same chains."""
    number, pitch, roller, width, single, several = row
    chain = named(f"ANSI {number:.0f}")
    assert chain == named(f"{number:.0f}") == named(f"no. {number:.0f}")
    assert (chain.pitch, chain.roller_diameter) == pytest.approx((25.4 * pitch, 25.4 * roller), abs=0.017)
    # ISO 606 has the least, ANSI the nominal width
    assert 0 <= 25.4 * width - chain.inner_width < 0.3
    exact = replace(chain, inner_width=25.4 * width)
    assert face_width(exact, AnsiForm()) / 25.4 == pytest.approx(single, abs=0.0011)
    if number != 41:
        two = named(f"{number:.0f}-2")
        assert two.strands == 2
        assert face_width(replace(two, inner_width=25.4 * width), AnsiForm()) / 25.4 == pytest.approx(
            several, abs=0.0011
        )


@pytest.mark.parametrize(("number", "teeth"), [("25", 9), ("40", 25), ("60", 11), ("80", 60), ("240", 120)])
def test_ansi_gaps_have_the_centres_of_their_standard(number: str, teeth: int) -> None:
    """The arcs' centres by M, T, W and V of ANSI B29.1, x across the gap and y outwards from the seat's centre."""
    chain = named(number)
    size, sprocket = chain.roller_diameter, checked_sprocket(Sprocket(teeth, chain, AnsiForm()))
    a, b = math.radians(35 + 60 / teeth), math.radians(18 - 56 / teeth)
    inch = size / 25.4
    seat = 25.4 * (1.005 * inch + 0.003) / 2
    wide, head = complex(0.8 * size * math.cos(a), 0.8 * size * math.sin(a)), 1.4 * size
    turned = cmath.rect(1.0, -math.pi / teeth)
    across = head * complex(math.cos(math.pi / teeth), math.sin(math.pi / teeth))
    # x across to +y here, y outwards to +x
    wanted = [(sprocket.pitch_radius + complex(o.imag, -o.real)) * turned for o in (0j, wide)]
    arcs = [s.curve for s in sprocket_side(sprocket).segments if isinstance(s.curve, Arc) and s.label != Label.TIP_LAND]
    assert [arc.centre for arc in arcs[:2]] == pytest.approx(wanted, abs=1e-9 * sprocket.tip_radius)
    assert [arc.radius for arc in arcs[:2]] == pytest.approx([seat, 1.3025 * size + 25.4 * 0.0015])
    assert arcs[1].sweep == pytest.approx(-b)
    centre = (sprocket.pitch_radius + complex(-across.imag, across.real)) * turned
    assert arcs[2].centre == pytest.approx(centre, abs=1e-9 * sprocket.tip_radius)
    # H and J are those of the standard: pointed teeth reach P cot(180 deg / N) + 2 H, turned ones P (0.6 + cot)
    cot, radius = 1 / math.tan(math.pi / teeth), arcs[2].radius
    pointed = chain.pitch * cot + 2 * math.sqrt(radius**2 - (1.4 * size - chain.pitch / 2) ** 2)
    assert 2 * flank_of(sprocket).pointed_radius == pytest.approx(pointed)
    assert 2 * sprocket.tip_radius == pytest.approx(chain.pitch * (0.6 + cot))
    assert sprocket.plate_room == pytest.approx(chain.pitch * (cot - 1) - 0.762)


@pytest.mark.parametrize("form", FORMS, ids=repr)
def test_outlines_are_smooth_but_for_their_tips_and_take_a_roller_in_every_gap(form: IsoForm | SeatedForm) -> None:
    for designation, teeth in (("08B", 17), ("ПР-19,05-31,8", 6), ("081", 50)):
        sprocket = checked_sprocket(Sprocket(teeth, named(designation), form))
        side = sprocket_side(sprocket)
        joints = [
            abs(complex(b.curve.tangent(0.0)) - complex(a.curve.tangent(a.curve.domain[1])))
            for a, b in zip(side.segments[:-2], side.segments[1:-1], strict=True)
        ]
        assert max(joints) < 1e-9
        outline = points(side.profile())
        roller, depth = sprocket.chain.roller_diameter / 2, sprocket.gap.depth
        for k in range(teeth):
            centre = cmath.rect(sprocket.pitch_radius, (2 * k + 1) * math.pi / teeth)
            assert np.abs(outline - centre).min() - roller == pytest.approx(depth - roller, abs=1e-4)
        assert np.abs(outline).min() == pytest.approx(sprocket.root_radius, abs=1e-9 * sprocket.tip_radius)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("form", FORMS, ids=repr)
def test_a_roller_that_leaves_along_its_involute_cuts_no_tooth(form: IsoForm | SeatedForm) -> None:
    """A link that is straightened about its seated neighbour: the roller at its end runs on a circle about that."""
    for designation, teeth in (("08B", 9), ("08B", 38), ("16A", 17)):
        sprocket = checked_sprocket(Sprocket(teeth, named(designation), form))
        outline = points(sprocket_side(sprocket).profile())
        plate = Polygon(np.column_stack((outline.real, outline.imag)))
        chain, step = sprocket.chain, sprocket.pitch_angle
        seat = cmath.rect(sprocket.pitch_radius, step / 2)
        deepest = 0.0
        for turn in np.linspace(0.0, step, 13):
            # from the next gap outwards by as much as the sprocket turns on: then it seats the next roller
            place = seat + (cmath.rect(sprocket.pitch_radius, 1.5 * step) - seat) * cmath.rect(1.0, -turn)
            disk = Point(place.real, place.imag).buffer(chain.roller_diameter / 2, 128)
            deepest = max(deepest, plate.intersection(disk).area)
        assert deepest < 1e-4 * chain.roller_diameter**2


@examples(25)
@given(
    teeth=st.integers(6, 200),
    name=st.sampled_from(sorted(chains())),
    form=st.sampled_from(FORMS),
    offset=st.sampled_from((-0.1, -0.01, 0.01, 0.1)),
)
def test_every_sprocket_of_the_table_is_an_outline(
    teeth: int, name: str, form: IsoForm | SeatedForm, offset: float
) -> None:
    sprocket = checked_sprocket(Sprocket(teeth, named(name), form))
    side = sprocket_side(sprocket, offset)
    plain = Polygon([(p.real, p.imag) for p in points(side.profile(), 12)])
    whole = Polygon([(p.real, p.imag) for p in points(sprocket_side(sprocket).profile(), 12)])
    assert plain.is_valid
    # outline and parallel lie |offset| apart, chords of 12 to an arc aside
    if not side.findings:
        # of one period: the others are like it
        around = plain.exterior.coords[: len(plain.exterior.coords) // teeth]
        apart = [whole.exterior.distance(Point(place)) for place in around]
        assert max(apart) == pytest.approx(abs(offset), abs=0.01 * sprocket.chain.pitch)
    assert (plain.area - whole.area) * offset > 0


@pytest.mark.parametrize(
    ("chain", "teeth", "height"), [(named("08A"), 190, 0.555), (Chain(12.7, 12.7 / 1.41), 60, 0.480)]
)
def test_displaced_teeth_that_would_be_pointed_are_lower_than_their_standard(
    chain: Chain, teeth: int, height: float
) -> None:
    """The tip circle runs through a fiftieth of a pitch of each, that of D_e of GOST 591-69 through none."""
    sprocket = checked_sprocket(Sprocket(teeth, chain, GostForm(displaced=True)))
    standard = chain.pitch * (height + 1 / math.tan(math.pi / teeth))
    (finding,) = sprocket_findings(sprocket)
    assert finding == Finding("lowered_sprocket_tip", 2 * sprocket.tip_radius, pytest.approx(standard))
    flank = flank_of(sprocket)
    for radius, land in ((sprocket.tip_radius, 0.02 * chain.pitch), (standard / 2, 0.0)):
        half = radius * np.exp(-1j * sprocket.pitch_angle * np.linspace(0.0, 0.5, 20001))
        inside = np.abs(half - flank.centre) < flank.radius
        assert 2 * float(np.sum(inside)) * abs(half[1] - half[0]) == pytest.approx(land, abs=2e-4 * chain.pitch)
    with pytest.raises(PointedTipError):
        checked_sprocket(replace(sprocket, given_tip_diameter=standard))


def test_a_tip_diameter_that_is_given_lower_than_that_of_the_standard_is_not_told() -> None:
    sprocket = Sprocket(20, named("08B-1"), GostForm())
    lower = replace(sprocket, given_tip_diameter=2 * sprocket.tip_radius - 0.5)
    assert sprocket_findings(checked_sprocket(lower)) == ()


def test_refusals_name_what_works() -> None:
    chain = named("08B-1")
    for wrong, cured in ((80.0, 76.4808), (70.0, 72.1105)):
        with pytest.raises(ParameterError) as refused:
            checked_sprocket(Sprocket(17, chain, IsoForm(), wrong))
        assert refused.value.name == "tip_diameter"
        assert refused.value.nearest is not None
        assert refused.value.nearest.value == pytest.approx(cured, abs=2e-4)
        checked_sprocket(Sprocket(17, chain, IsoForm(), float(str(refused.value.nearest.value))))
    with pytest.raises(ParameterError, match="no_height_of_tooth"):
        checked_sprocket(Sprocket(17, Chain(12.7, 6.0), GostForm()))
    with pytest.raises(ParameterError, match="leaves_no_tooth_between_rollers"):
        checked_sprocket(Sprocket(17, Chain(12.7, 12.6), IsoForm()))
    with pytest.raises(ParameterError) as refused:
        checked_sprocket(Sprocket(17, Chain(12.7, 12.6), IsoForm()))
    assert refused.value.nearest is not None
    widest = float(str(refused.value.nearest.value))
    checked_sprocket(Sprocket(17, Chain(12.7, widest), IsoForm()))
    with pytest.raises(ParameterError):
        checked_sprocket(Sprocket(17, Chain(12.7, widest + 0.01), IsoForm()))
    with pytest.raises(ParameterError, match="leaves_no_tooth_between_rollers"):
        checked_sprocket(Sprocket(17, Chain(0.1, 0.06), GostForm()))
    assert chain_of("08X-1") is None
    assert chain_of("081-2") is None

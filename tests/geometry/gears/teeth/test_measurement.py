"""Span, pins, chords: published tables, and the same read off exact flanks by brute force."""

from __future__ import annotations

import json
import math
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.teeth import measurement as m
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.limits import root_form_diameter
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import base_helix_angle, normal_angle, overlap_ratio, transverse_gear
from tests.brute import works

TABLES = json.loads((Path(__file__).parents[3] / "published" / "gear_measurement.json").read_text(encoding="utf-8"))
RACK = iso_53()


def gear_of(row: dict[str, Any]) -> tuple[SpurGear, float]:
    """The transverse section and helix angle of a published row, from normal or from transverse data."""
    helix = math.radians(row.get("helix_angle_deg", 0.0))
    if "transverse_module" in row:
        angle, cosine = normal_angle(math.radians(row["transverse_pressure_angle_deg"]), helix), math.cos(helix)
        rack = BasicRack(angle, 1.0, 0.25, 0.38)
        normal = SpurGear(row["transverse_module"] * cosine, row["number_of_teeth"], rack, row["x_transverse"] / cosine)
    else:
        normal = SpurGear(row["module"], row["number_of_teeth"], RACK, row["x"])
    return transverse_gear(normal, helix), helix


@pytest.mark.parametrize("row", TABLES["spans"], ids=lambda r: r["table"])
def test_published_spans(row: dict[str, Any]) -> None:
    gear, helix = gear_of(row)
    assert m.teeth_to_span(gear, helix) == pytest.approx(row["teeth_to_span"], abs=5.1e-6)
    best = m.best_span(gear, helix)
    assert best is not None
    assert best.teeth == row["teeth"]
    assert best.length == pytest.approx(row["span"], abs=5.1e-5)
    assert best.touches_flanks
    for key, angle in (("transverse_pressure_angle_deg", gear.rack.pressure_angle),
                       ("normal_pressure_angle_deg", normal_angle(gear.rack.pressure_angle, helix))):  # fmt: skip
        assert math.degrees(angle) == pytest.approx(row.get(key, math.degrees(angle)), abs=5.1e-6)


@pytest.mark.parametrize("row", TABLES["over_pins"], ids=lambda r: r["table"])
def test_published_sizes_over_pins(row: dict[str, Any]) -> None:
    gear, helix = gear_of(row)
    found = m.over_pins(gear, row["pin"], helix)
    assert found.length == pytest.approx(row["over_pins"], abs=5.1e-5)
    assert math.degrees(math.acos(2 * gear.base_radius / found.centre_diameter)) == pytest.approx(
        row["angle_deg"], abs=5.1e-5
    )
    assert found.touches_flanks
    assert found.stands_out


@pytest.mark.parametrize("z", [int(z) for z in TABLES["best_pins"]["rows"]])
def test_published_best_pins(z: int) -> None:
    row = TABLES["best_pins"]["rows"][str(z)]
    for x, pin in zip(TABLES["best_pins"]["x"], row, strict=True):
        assert m.best_pin_diameter(SpurGear(1.0, z, RACK, x)) == pytest.approx(pin, abs=5.1e-5)


@pytest.mark.parametrize("row", TABLES["chords"], ids=lambda r: r["table"])
def test_published_chords(row: dict[str, Any]) -> None:
    gear, helix = gear_of(row)
    chord = m.reference_chord(gear, helix)
    assert (chord.thickness, chord.height) == pytest.approx((row["thickness"], row["height"]), abs=5.1e-5)
    arc = row.get("arc", row.get("arc_normal"))
    assert gear.reference_thickness * math.cos(helix) == pytest.approx(arc, abs=5.1e-5)


def test_the_tables_of_spans_begin_where_everybody_s_do() -> None:
    """k of the usual table for 20 degrees and x = 0: z 9 to 17 two teeth, 18 to 26 three, 27 to 35 four."""
    for z in (13, 17, 18, 26, 27, 35, 36):
        best = m.best_span(SpurGear(1.0, z, RACK))
        assert best is not None
        assert best.teeth == (z + 9) // 9


def random_gear(rng: random.Random) -> SpurGear:
    z, x = rng.randint(12, 80), rng.uniform(-0.2, 0.8)
    return SpurGear(rng.choice((0.5, 2.0, 10.0)), z, RACK, x, circumferential_thinning=rng.choice((0.0, 0.02)))


def upper_flank(gear: SpurGear, tooth: int) -> Any:
    """Points of the upper flank of a tooth, tooth 0 on +x."""
    flank = gear.flank()
    roll = np.array([flank.roll_at_radius(r) for r in np.linspace(gear.base_radius, gear.tip_radius, 4001)])
    return np.conj(flank.point(roll)) * np.exp(1j * tooth * gear.pitch_angle)


def test_a_span_is_the_distance_of_parallel_faces_on_the_flanks() -> None:
    rng = random.Random(7)
    for _ in range(12):
        gear = random_gear(rng)
        best = m.best_span(gear)
        if best is None:
            continue
        # faces normal to the middle of the span: the farthest flank points on either side
        middle = (best.teeth - 1) / 2 * gear.pitch_angle
        direction = np.exp(1j * (middle + math.pi / 2))
        high = (upper_flank(gear, best.teeth - 1) * np.conj(direction)).real.max()
        low = (np.conj(upper_flank(gear, 0)) * np.conj(direction)).real.min()
        assert high - low == pytest.approx(best.length, rel=1e-6)


def test_a_pin_of_that_size_touches_both_flanks() -> None:
    rng = random.Random(8)
    for _ in range(12):
        gear = random_gear(rng)
        pin = m.best_pin_diameter(gear) * rng.uniform(1.0, 1.05)
        found = m.over_pins(gear, pin)
        centre = found.centre_diameter / 2 * np.exp(0.5j * gear.pitch_angle)
        clearance = np.abs(upper_flank(gear, 0) - centre).min() - pin / 2
        assert abs(clearance) < 1e-6 * gear.module
        # where both pins lie: in opposite spaces, or as near to it as an odd number allows
        z = gear.number_of_teeth
        other = centre * np.exp(1j * gear.pitch_angle * (z // 2))
        assert abs(other - centre) + pin == pytest.approx(found.length, rel=1e-12)


def test_a_ball_touches_the_screw_surface() -> None:
    """Both parities of helical gears: the least distance from the ball's centre to the helicoid is its radius."""
    for z, beta in ((20, 15.0), (21, -30.0)):
        helix = math.radians(beta)
        gear = transverse_gear(SpurGear(2.0, z, RACK, 0.2), helix)
        ball = m.best_pin_diameter(gear, helix)
        found = m.over_pins(gear, ball, helix)
        centre = found.centre_diameter / 2 * np.exp(0.5j * gear.pitch_angle)
        flank, lead = gear.flank(), gear.reference_radius / math.tan(helix)
        heights, rolls = np.linspace(-ball, ball, 801), np.linspace(0, 1.2, 801)
        points = np.conj(flank.point(rolls))[None, :] * np.exp(1j * heights / lead)[:, None]
        distance = np.sqrt(np.abs(points - centre) ** 2 + heights[:, None] ** 2)
        assert distance.min() == pytest.approx(ball / 2, abs=2e-5)
        assert distance.min() >= ball / 2 - 1e-9


def test_best_pin_touches_where_it_is_asked_to() -> None:
    for z, x, beta in ((17, 0.0, 0.0), (30, 0.5, 0.0), (20, 0.3, 20.0), (60, 1.0, 0.0)):
        helix = math.radians(beta)
        gear = transverse_gear(SpurGear(3.0, z, RACK, x), helix)
        pin = m.best_pin_diameter(gear, helix)
        middle = gear.reference_radius + gear.profile_shift_coefficient * gear.module
        assert m.over_pins(gear, pin, helix).contact_diameter == pytest.approx(2 * middle, rel=1e-12)
        low, high = m.pin_limits(gear, helix)
        assert low < pin < high
        assert m.over_pins(gear, low, helix).contact_diameter == pytest.approx(root_form_diameter(gear), rel=1e-9)
        assert not m.over_pins(gear, 1.01 * high, helix).touches_flanks


def test_the_chosen_pin_is_that_which_drawings_tell() -> None:
    gear = transverse_gear(SpurGear(3.0, 20, RACK, 0.3), math.radians(20.0))
    best, chosen = (f(gear, math.radians(20.0)) for f in (m.best_pin_diameter, m.fit_pin_diameter))
    assert chosen == float(f"{best:.3f}") != best


def test_thinning_is_what_a_span_tells() -> None:
    gear = SpurGear(2.0, 31, RACK, 0.1)
    full, thin = m.span(gear, 4), m.span(replace(gear, circumferential_thinning=0.15), 4)
    assert full.length - thin.length == pytest.approx(0.15 * math.cos(math.radians(20)), rel=1e-12)
    assert m.gear_with_span(gear, 4, thin.length).circumferential_thinning == pytest.approx(0.15, rel=1e-9)
    with pytest.raises(ParameterError, match="above_nominal") as caught:
        m.gear_with_span(gear, 4, full.length + 0.01)
    assert full.length - 1e-4 <= works(caught.value) <= full.length
    assert m.over_pins(gear, 3.5).length > m.over_pins(replace(gear, circumferential_thinning=0.15), 3.5).length


def test_thickness_on_any_circle_is_between_the_exact_flanks() -> None:
    gear = SpurGear(4.0, 19, RACK, 0.3)
    points = upper_flank(gear, 0)
    for index in (0, 1500, 4000):
        radius = float(abs(points[index]))
        thickness = 2 * radius * float(np.angle(points[index]))
        assert m.thickness_at(gear, max(radius, gear.base_radius)) == pytest.approx(thickness, rel=1e-9)
    assert m.thickness_at(gear, gear.base_radius) == pytest.approx(m.base_thickness(gear), rel=1e-12)
    with pytest.raises(ParameterError, match="inside_base_circle") as caught:
        m.thickness_at(gear, 0.9 * gear.base_radius)
    assert m.thickness_at(gear, works(caught.value) / 2) == pytest.approx(m.base_thickness(gear), rel=1e-4)


def test_the_published_helical_pair() -> None:
    """Tables 6-1 and 6-2: normal module 3, 30 degrees, z 12/60."""
    from geometry.gears.pairs.external import external_pair
    from geometry.gears.shifts.choice import shift_sum_for_distance

    row = TABLES["helical_pair"]
    helix = math.radians(row["helix_angle_deg"])
    gears = [transverse_gear(SpurGear(row["module"], z, RACK, x), helix)
             for z, x in zip(row["number_of_teeth"], row["x"], strict=True)]  # fmt: skip
    pair = external_pair(gears[0], gears[1])
    assert math.degrees(gears[0].rack.pressure_angle) == pytest.approx(row["transverse_pressure_angle_deg"], abs=5e-6)
    assert math.degrees(pair.working_pressure_angle) == pytest.approx(row["working_pressure_angle_deg"], abs=5.1e-5)
    assert pair.working_centre_distance == pytest.approx(row["working_centre_distance"], abs=5.1e-4)
    for key, attribute in (("reference_diameter", "reference_radius"), ("base_diameter", "base_radius"),
                           ("tip_diameter", "tip_radius"), ("root_diameter", "root_radius")):  # fmt: skip
        found = [2 * getattr(g, attribute) for g in pair.gears]
        assert found == pytest.approx(row[key], abs=1.1e-3), key
    assert [2 * r for r in pair.working_radii] == pytest.approx(row["working_diameter"], abs=5.1e-4)
    total = shift_sum_for_distance(gears[0], gears[1], row["working_centre_distance"])
    assert total / math.cos(helix) == pytest.approx(sum(row["x"]), abs=5.1e-6)


def test_the_published_spur_pair() -> None:
    """Table 4-4: module 3, z 12/24, x 0.6/0.36."""
    from geometry.gears.pairs.external import external_pair

    row = TABLES["spur_pair"]
    gears = [SpurGear(row["module"], z, RACK, x) for z, x in zip(row["number_of_teeth"], row["x"], strict=True)]
    pair = external_pair(gears[0], gears[1])
    assert math.degrees(pair.working_pressure_angle) == pytest.approx(row["working_pressure_angle_deg"], abs=5.1e-5)
    assert pair.centre_distance_coefficient == pytest.approx(row["centre_distance_coefficient"], abs=5.1e-6)
    assert pair.working_centre_distance == pytest.approx(row["working_centre_distance"], abs=1.1e-4)
    for key, values in (("base_diameter", [2 * g.base_radius for g in pair.gears]),
                        ("working_diameter", [2 * r for r in pair.working_radii]),
                        ("tip_diameter", [2 * g.tip_radius for g in pair.gears]),
                        ("root_diameter", [2 * g.root_radius for g in pair.gears])):  # fmt: skip
        assert values == pytest.approx(row[key], abs=1.1e-3), key


def test_a_steep_helix_with_shift_keeps_its_normal_thickness() -> None:
    """45 degrees, x = 0.5, m_n = 1: what others got wrong by 0.2 mm."""
    helix = math.radians(45)
    gear = transverse_gear(SpurGear(1.0, 20, RACK, 0.5), helix)
    assert gear.reference_thickness * math.cos(helix) == pytest.approx(
        math.pi / 2 + math.tan(math.radians(20)), rel=1e-12
    )
    assert 2 * gear.reference_radius == pytest.approx(20 / math.cos(helix), rel=1e-12)
    assert math.sin(base_helix_angle(gear.rack.pressure_angle, helix)) == pytest.approx(
        math.sin(helix) * math.cos(math.radians(20)), rel=1e-12
    )
    assert overlap_ratio(math.pi / math.sin(helix), -helix, 1.0) == pytest.approx(1.0, rel=1e-12)


def test_a_helix_of_nothing_changes_nothing_and_a_right_angle_is_refused() -> None:
    gear = SpurGear(1.0, 20, RACK)
    assert transverse_gear(gear, 0.0) is gear
    with pytest.raises(ParameterError, match="not_below_right_angle"):
        transverse_gear(gear, math.pi / 2 + 1e-9)

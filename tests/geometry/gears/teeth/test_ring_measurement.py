"""Rings and racks measured: published reports, and pins and faces laid by brute force into the exact contour."""

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
from geometry.base.roots import bracketed_root
from geometry.gears.teeth import measurement as m
from geometry.gears.teeth import rack_measurement
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.rack import Rack, checked_part_rack
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_made import settled_ring
from geometry.gears.teeth.ring_tooth import ring_side
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear
from geometry.gears.teeth.transverse_ring import transverse_ring
from geometry.plane.profile import Label
from tests import brute
from tests.brute import works

TABLES = json.loads((Path(__file__).parents[3] / "published" / "ring_measurement.json").read_text(encoding="utf-8"))
ALPHA = math.radians(20.0)


def ring(z: int, x: float = 0.0, beta: float = 0.0, **keys: Any) -> RingGear:
    """The transverse section of a ring with the default cutter; the helix angle in degrees."""
    module = keys.pop("module", 2.0)
    cutter = PinionCutter(module, 25, ALPHA)
    made = RingGear(module, z, ALPHA, 1e9, cutter, x, any_cutter=True, **keys)
    return settled_ring(transverse_ring(made, math.radians(beta)))


def published(row: dict[str, Any]) -> RingGear:
    root = RoundedRoot(1.25, None)
    tip = row.get("tip_diameter")
    return RingGear(row["module"], row["number_of_teeth"], ALPHA, 1e9, root, row["x"], given_tip_diameter=tip)


@pytest.mark.parametrize("row", TABLES["rings"], ids=lambda r: f"{r['source']} z{r['number_of_teeth']}")
def test_the_reports_of_a_wind_turbine(row: dict[str, Any]) -> None:
    gear = published(row)
    best = m.best_span(gear)
    assert best is not None
    assert (best.teeth, best.touches_flanks) == (row["spaces"], True)
    assert best.length == pytest.approx(row["span"], abs=5.1e-4)
    assert m.best_pin_diameter(gear) == pytest.approx(row["best_pin"], abs=5.1e-4)
    found = m.over_pins(gear, row["pin"])
    assert found.length == pytest.approx(row["between_pins"], abs=5.1e-4)
    assert (found.touches_flanks, found.stands_out) == (True, True)
    assert gear.reference_thickness == pytest.approx(row["arc"], abs=5.1e-4)
    assert m.reference_chord(gear).thickness == pytest.approx(row["chord"], abs=5.1e-4)
    for allowed in row["allowances"]:
        thin = replace(gear, circumferential_thinning=allowed["thinning"])
        assert m.span(thin, row["spaces"]).length == pytest.approx(allowed["span"], abs=5.1e-4)
        assert m.over_pins(thin, row["pin"]).length == pytest.approx(allowed["between_pins"], abs=5.1e-4)
        assert m.reference_chord(thin).thickness == pytest.approx(allowed["chord"], abs=5.1e-4)
        told = m.gear_with_span(gear, row["spaces"], allowed["span"])
        assert told.circumferential_thinning == pytest.approx(allowed["thinning"], abs=1.1e-3)
        told = m.gear_with_size(gear, row["pin"], allowed["between_pins"])
        assert told.circumferential_thinning == pytest.approx(allowed["thinning"], abs=1.1e-3)


@pytest.mark.parametrize("row", TABLES["between_pins"], ids=lambda r: r["source"])
def test_published_sizes_between_pins(row: dict[str, Any]) -> None:
    assert m.over_pins(published(row), row["pin"]).length == pytest.approx(row["between_pins"], abs=5.1e-5)


@pytest.mark.parametrize("row", TABLES["racks"], ids=lambda r: f"{r['source']} {r['helix_angle_deg']}")
def test_published_sizes_over_a_pin_of_racks(row: dict[str, Any]) -> None:
    helix = math.radians(row["helix_angle_deg"])
    rack = checked_part_rack(Rack(row["module"], 10, iso_53(), row["back"] - 1.25 * row["module"]), helix)
    assert rack_measurement.over_pin(rack, row["pin"], helix).length == pytest.approx(row["over_pin"], abs=5.1e-5)
    assert rack_measurement.pin_touching_at(rack, 0.0, helix) == pytest.approx(row["best_pin"], abs=5.1e-5)


def contour(gear: RingGear) -> np.ndarray:
    """Points of both sides of space 1, of a ring as it is built: root, fillet, flank, tip."""
    side = np.concatenate([brute.dense(s.curve, 6000) for s in ring_side(gear).segments])
    return np.concatenate([side, np.conj(side)])


def flank(gear: RingGear, points: int = 20_001) -> np.ndarray:
    """Points of the lower flank of space 1."""
    curve = next(s.curve for s in ring_side(gear).segments if s.label is Label.FLANK)
    return brute.dense(curve, points)


CASES = [
    (60, 0.0, 0.0),
    (61, 0.0, 0.1),
    (37, 0.5, 0.0),
    (93, -0.117, 0.32),
    (240, 1.5, 0.0),
]


@pytest.mark.parametrize(("z", "x", "thinning"), CASES)
def test_a_pin_pushed_into_a_space_stops_where_it_is_said_to(z: int, x: float, thinning: float) -> None:
    gear = ring(z, x, circumferential_thinning=thinning)
    wall = contour(gear)
    for share in (0.97, 1.0, 1.05):
        pin = m.best_pin_diameter(gear) * share
        found = m.over_pins(gear, pin)
        assert (found.touches_flanks, found.stands_out) == (True, True)

        def room(radius: float, pin: float = pin) -> float:
            return float(np.abs(wall - radius).min()) - pin / 2

        # from the tip inwards there is room; the pin moves out until there is none
        stopped = bracketed_root(room, gear.tip_radius - pin / 4, gear.root_radius).value
        assert stopped == pytest.approx(found.centre_diameter / 2, abs=2e-6 * gear.module)
        # both pins, one in the space opposite or the nearest to it
        other = stopped * np.exp(1j * gear.pitch_angle * (z // 2))
        assert abs(stopped - other) - pin == pytest.approx(found.length, abs=5e-6 * gear.module)


@pytest.mark.parametrize(("z", "beta"), [(60, 15.0), (61, -30.0)])
def test_a_ball_touches_the_hollow_screw_surface(z: int, beta: float) -> None:
    helix, gear = math.radians(beta), ring(z, 0.3, beta)
    ball = m.best_pin_diameter(gear, helix)
    found = m.over_pins(gear, ball, helix)
    assert (found.touches_flanks, found.stands_out) == (True, True)
    lower, lead = flank(gear, 1501), gear.reference_radius / math.tan(helix)
    heights = np.linspace(-ball, ball, 1501)
    turned = lower[None, :] * np.exp(1j * heights / lead)[:, None]
    distance = np.sqrt(np.abs(turned - found.centre_diameter / 2) ** 2 + heights[:, None] ** 2)
    assert distance.min() == pytest.approx(ball / 2, abs=5e-6)
    assert distance.min() >= ball / 2 - 1e-9
    at = np.unravel_index(distance.argmin(), distance.shape)
    assert abs(turned[at]) == pytest.approx(found.contact_diameter / 2, abs=5e-3)


@pytest.mark.parametrize(("z", "x", "thinning"), CASES)
def test_a_span_over_spaces_is_the_greatest_distance_from_a_flank_to_the_other(
    z: int, x: float, thinning: float
) -> None:
    """A hollow flank seen from beyond its centre of curvature: the common normal is the longest way."""
    gear = ring(z, x, circumferential_thinning=thinning)
    best = m.best_span(gear)
    assert best is not None
    lower = flank(gear)
    start = lower[np.abs(np.abs(lower) - best.contact_diameter / 2).argmin()]
    upper = np.conj(lower) * np.exp(1j * gear.pitch_angle * (best.teeth - 1))
    ways = np.abs(upper - start)
    assert 0 < ways.argmax() < len(ways) - 1
    assert ways.max() == pytest.approx(best.length, abs=1e-6 * gear.module)


@pytest.mark.parametrize(("z", "x", "thinning"), CASES)
def test_chords_of_a_ring_s_tooth_are_on_its_flanks(z: int, x: float, thinning: float) -> None:
    gear = ring(z, x, circumferential_thinning=thinning)
    # the flank of the tooth that is centred on the real axis
    tooth = flank(gear, 200_001) * np.exp(0.5j * gear.pitch_angle)
    chord, constant = m.reference_chord(gear), m.constant_chord(gear)
    if chord.height > 0:
        at = tooth[np.abs(np.abs(tooth) - gear.reference_radius).argmin()]
        assert (2 * at.imag, at.real - gear.tip_radius) == pytest.approx((chord.thickness, chord.height), abs=1e-4)
    if constant.height <= 0:
        # the whole tooth stands outside its reference circle
        assert x > 1
        return
    # a basic rack's flank stands at the pressure angle to the tooth's centre line
    slopes = np.angle(np.diff(tooth) / np.sign(np.diff(tooth).real))
    at = tooth[np.abs(np.abs(slopes) - gear.pressure_angle).argmin()]
    assert (2 * at.imag, at.real - gear.tip_radius) == pytest.approx((constant.thickness, constant.height), abs=1e-3)


def test_thickness_on_any_circle_is_what_the_spaces_leave() -> None:
    gear = ring(60, 0.3)
    for point in flank(gear, 5):
        space = -2 * abs(point) * float(np.angle(point))
        arc = gear.pitch_angle * abs(point)
        assert m.thickness_at(gear, abs(point)) == pytest.approx(arc - space, rel=1e-12)
    assert m.thickness_at(gear, gear.reference_radius) == pytest.approx(gear.reference_thickness, rel=1e-12)


def test_the_limits_of_pins_are_where_the_flank_ends() -> None:
    rng = random.Random(5)
    for _ in range(8):
        beta = rng.choice((0.0, 20.0))
        gear, helix = ring(rng.randint(40, 120), rng.uniform(-0.1, 0.8), beta), math.radians(beta)
        low, high = m.pin_limits(gear, helix)
        root, tip = (2 * r for r in m.flank_radii(gear))
        assert m.over_pins(gear, low, helix).contact_diameter == pytest.approx(root, rel=1e-9)
        assert m.over_pins(gear, high * (1 - 1e-12), helix).contact_diameter >= tip * (1 - 1e-5)
        assert low < m.best_pin_diameter(gear, helix) < high
        assert not m.over_pins(gear, 0.99 * low, helix).touches_flanks
    # a tip near the base circle: pins end where their centres come to it
    gear = RingGear(2.0, 60, ALPHA, 1e9, RoundedRoot(), 0.0, given_tip_diameter=112.9)
    high = m.pin_limits(gear)[1]
    assert m.over_pins(gear, high * (1 - 1e-9)).centre_diameter == pytest.approx(2 * gear.base_radius, rel=1e-4)
    with pytest.raises(ParameterError, match="pin_beyond_base_circle") as caught:
        m.over_pins(gear, 1.001 * high)
    assert works(caught.value) == pytest.approx(high, rel=1e-4)


def test_a_measured_size_tells_the_thinning() -> None:
    """Both parities, outside and inside, straight and helical, by either way of thinning."""
    rng = random.Random(11)
    for k in range(16):
        beta, deeper = rng.choice((0.0, 20.0)), rng.random() < 0.5
        helix, z = math.radians(beta), rng.randint(40, 90)
        keys: dict[str, Any] = {"circumferential_thinning": rng.uniform(0.01, 0.2), "thinning_by_deeper_cut": deeper}
        outer = transverse_gear(SpurGear(2.0, z, iso_53(), 0.2), helix)
        whole: m.Measured = ring(z, 0.3, beta) if k % 2 else outer
        pin, thin = m.best_pin_diameter(whole, helix), replace(whole, **keys)
        told = m.gear_with_size(whole, pin, m.over_pins(thin, pin, helix).length, helix)
        assert told.circumferential_thinning == pytest.approx(thin.circumferential_thinning, rel=1e-9)
        sense = 1 if k % 2 else -1
        with pytest.raises(ParameterError, match="_nominal") as caught:
            m.gear_with_size(whole, pin, m.over_pins(whole, pin, helix).length - sense * 0.01, helix)
        assert works(caught.value) == pytest.approx(m.over_pins(whole, pin, helix).length, rel=1e-5)
    with pytest.raises(ParameterError, match="pin_falls_through") as caught:
        m.gear_with_size(SpurGear(2.0, 20, iso_53()), 3.5, 40.0)
    assert works(caught.value) > 40.0


def test_a_broken_tip_is_no_flank() -> None:
    """Faces and pins that would touch a chamfer or a relief do not touch the involute, outside and inside."""
    for plain, chamfered in (
        (SpurGear(2.0, 23, iso_53()), SpurGear(2.0, 23, iso_53(), tip_chamfer=0.5)),
        (ring(60), ring(60, tip_chamfer=0.5)),
    ):
        high, less = m.pin_limits(plain)[1], m.pin_limits(chamfered)[1]
        assert less < high
        pin = (less + high) / 2
        assert m.over_pins(plain, pin).touches_flanks
        assert not m.over_pins(chamfered, pin).touches_flanks


@pytest.mark.parametrize("beta", [0.0, -25.0])
def test_a_size_over_a_pin_tells_what_a_rack_was_thinned_by(beta: float) -> None:
    """The size of a rack that is thinned already; and down to a pin that lies on the root."""
    helix = math.radians(beta)
    rack = checked_part_rack(Rack(3.0, 5, iso_53(), 10.0, 0.1), helix)
    for thinning in (0.0, 0.1, 0.37):
        size = rack_measurement.over_pin(replace(rack, circumferential_thinning=thinning), 5.2, helix).length
        found = rack_measurement.rack_with_size(rack, 5.2, size, helix)
        assert found.circumferential_thinning == pytest.approx(thinning, abs=1e-12)
    sunk = rack_measurement.rack_with_size(rack, 5.2, rack.body_height + 5.2, helix)
    with pytest.raises(ParameterError):
        rack_measurement.rack_with_size(rack, 5.2, rack.body_height + 5.2 - 1e-9, helix)
    wide = (sunk.pitch - sunk.tooth_thickness) / 2 * math.cos(helix)
    # the foot of the normal from the middle of the pin, half of it above the root line, stands on the flank
    y = 5.2 / 2 * (1 - math.sin(ALPHA)) - rack.dedendum
    assert wide + y * math.tan(ALPHA) == pytest.approx(5.2 / 2 * math.cos(ALPHA), abs=1e-12)


def test_a_rack_s_pin_lies_on_both_of_its_flanks() -> None:
    for beta, thinning in ((0.0, 0.0), (0.0, 0.2), (25.0, 0.1)):
        helix = math.radians(beta)
        rack = checked_part_rack(Rack(3.0, 5, iso_53(), 10.0, thinning), helix)
        for pin in (*rack_measurement.pin_limits(rack, helix), 5.2):
            found = rack_measurement.over_pin(rack, pin, helix)
            height = found.length - pin / 2 - rack.body_height - rack.dedendum
            # the space in the normal section: straight flanks of slope tan(alpha_n)
            wide = (rack.pitch - rack.tooth_thickness) / 2 * math.cos(helix)
            y = np.linspace(-rack.form_dedendum, rack.addendum, 200_001)
            distance = np.hypot(wide + y * math.tan(ALPHA), y - height)
            assert distance.min() == pytest.approx(pin / 2, abs=1e-6)
            assert y[distance.argmin()] == pytest.approx(found.contact_height, abs=1e-3)
    assert rack_measurement.constant_chord(rack, helix).thickness == pytest.approx(
        rack.tooth_thickness * math.cos(helix) * math.cos(ALPHA) ** 2, rel=1e-12
    )

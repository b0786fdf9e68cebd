"""The outline of a tooth against both oracles, to 1e-12 of the tip radius."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given

from geometry.curves.curve import end_point, start_point
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.curves.trochoid import TrochoidFillet
from geometry.gears.teeth.basic_rack import BasicRack, TipRelief, full_round_radius, iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.plane.profile import Label, Profile, joint_turn
from tests import brute
from tests.oracles import exact_gear, rack_sweep
from tests.sampling import examples
from tests.strategies import gears

RIGHT = 1e-12
RELIEF = TipRelief(0.02)
_FULL = BasicRack(math.radians(20), 1.0, 0.25, full_round_radius(math.radians(20), 1.25))


def _on_pitch_line(name: str) -> SpurGear:
    """x = h_f - rho: the rounding centre rolls on the reference circle (theory note A10 ii)."""
    rack = iso_53(name)
    return SpurGear(1.0, 23, rack, rack.dedendum - rack.tip_radius)


CASES = {
    "z23": SpurGear(2.0, 23, iso_53()),
    "z13 of the practicum": SpurGear(10.0, 13, iso_53(), 0.694, given_tip_diameter=160.68),
    "z8 undercut": SpurGear(2.0, 8, iso_53("C"), 0.1),
    "z10 undercut deeply": SpurGear(1.0, 10, iso_53("D"), -0.2),
    "z17 at the limit": SpurGear(1.0, 17, iso_53()),
    "z18 rack C, grazing": SpurGear(1.0, 18, iso_53("C")),
    "z5": SpurGear(1.0, 5, iso_53(), 0.6, given_tip_diameter=7.6),
    "z4": SpurGear(0.1, 4, iso_53(), 0.6, given_tip_diameter=0.62),
    "z1000": SpurGear(0.3, 1000, iso_53("B"), 0.3),
    "14.5 degrees": SpurGear(1.0, 41, iso_53("B", math.radians(14.5))),
    "25 degrees": SpurGear(50.0, 17, iso_53("C", math.radians(25)), 0.2),
    "30 degrees": SpurGear(1.0, 12, iso_53("A", math.radians(30))),
    "full round": SpurGear(1.0, 30, _FULL),
    "sharp rack": SpurGear(1.0, 30, BasicRack(math.radians(20), 1.0, 0.25, 1e-6)),
    "relief": SpurGear(2.0, 23, iso_53(relief=RELIEF)),
    "relief, shifted": SpurGear(2.0, 40, iso_53(relief=TipRelief(0.01, 0.6)), 0.5),
    "relief and undercut": SpurGear(2.0, 10, iso_53(relief=RELIEF), 0.0),
    "wider rack tooth": SpurGear(2.0, 23, iso_53(), 0.1, circumferential_thinning=0.15),
    "deeper cut": SpurGear(2.0, 23, iso_53(), 0.1, circumferential_thinning=0.15, thinning_by_deeper_cut=True),
    "deeper cut, relief": SpurGear(
        2.0, 23, iso_53(relief=RELIEF), circumferential_thinning=0.1, thinning_by_deeper_cut=True
    ),
    **{f"centre on the pitch line, {name}": _on_pitch_line(name) for name in "ABCD"},
    "centre beyond the pitch line": SpurGear(1.0, 23, iso_53(), 0.95),
}
EVERY = pytest.mark.parametrize("gear", CASES.values(), ids=CASES.keys())


def side_points(gear: SpurGear, count: int) -> np.ndarray:
    """Points of every segment of the lower side of tooth 1, ends included."""
    return np.concatenate([brute.dense(s.curve, count) for s in tooth_side(gear).segments])


@pytest.mark.sampled(1)
@EVERY
def test_outline_against_fifty_digits(gear: SpurGear) -> None:
    """Root land, fillet, joint, flank, relief and tip: every point lies on the envelope's outline."""
    parameters = brute.exact_parameters(gear)
    worst = max(abs(float(exact_gear.normal_distance(complex(p), parameters))) for p in side_points(gear, 6))
    assert worst <= RIGHT * gear.tip_radius


@pytest.mark.sampled(3)
@EVERY
def test_outline_against_the_swept_rack(gear: SpurGear) -> None:
    points = side_points(gear, 40)
    error = rack_sweep.outline_error(points, brute.rack_tool(gear), gear.number_of_teeth, gear.tip_radius)
    assert error.max() <= RIGHT * gear.tip_radius


@pytest.mark.sampled(2)
@EVERY
def test_the_whole_oracle_outline_is_there(gear: SpurGear) -> None:
    """The other way round: no part of the envelope's outline is missing, in any period."""
    profile, parameters = tooth_side(gear).profile(), brute.exact_parameters(gear)
    half = [complex(p) for s in exact_gear.half_tooth(parameters) for p in exact_gear.sample(s, 7)]
    points = np.concatenate([half, np.conj(half)])
    turned = points * np.exp(2j * math.pi / gear.number_of_teeth * np.arange(len(points)))
    assert brute.distance_to_outline(turned, profile).max() <= RIGHT * gear.tip_radius


@pytest.mark.sampled(1)
@EVERY
def test_joint_and_labels_against_the_oracle(gear: SpurGear) -> None:
    """Each piece ends where the oracle's ends; the joint is smooth unless undercut, where it is a convex corner."""
    parameters = brute.exact_parameters(gear)
    # at a full round the root land is an angle of rounding only
    pieces = {s.kind: s for s in exact_gear.half_tooth(parameters) if s.kind != "root" or s.hi - s.lo > 1e-11}
    names = {
        "root": Label.ROOT_LAND,
        "fillet": Label.ROOT_FILLET,
        "flank": Label.FLANK,
        "relief": Label.RELIEF,
        "tip": Label.TIP_LAND,
    }
    side = tooth_side(gear).segments
    assert [s.label for s in side] == [label for kind, label in names.items() if kind in pieces]
    joint = exact_gear.junction(parameters)
    fillet, flank = (next(s.curve for s in side if s.label is label) for label in (Label.ROOT_FILLET, Label.FLANK))
    assert isinstance(fillet, TrochoidFillet)
    assert isinstance(flank, Involute)
    # near the undercut limit the joint slides along the flank by the root of rounding (theory note B11)
    slack = 1e-7 if gear.number_of_teeth in (17, 18) else 1e-11
    assert abs(end_point(fillet) - complex(joint.point).conjugate()) <= slack * gear.tip_radius
    turn = joint_turn(fillet, flank)
    if joint.undercut:
        assert turn > 1e-9
    else:
        assert abs(turn) <= 1e-9
    if "relief" in pieces:
        relief = next(s.curve for s in side if s.label is Label.RELIEF)
        corner = complex(exact_gear.relief_corner(parameters)[2]).conjugate()
        assert abs(start_point(relief) - corner) <= 1e-11 * gear.tip_radius
        assert joint_turn(flank, relief) > 0


@examples(25)
@given(gears())
def test_any_gear_is_what_the_rack_leaves(gear: SpurGear) -> None:
    points = side_points(gear, 25)
    error = rack_sweep.outline_error(points, brute.rack_tool(gear), gear.number_of_teeth, gear.tip_radius)
    assert error.max() <= RIGHT * gear.tip_radius
    side = tooth_side(gear)
    assert abs(np.angle(start_point(side.segments[0].curve)) + gear.pitch_angle / 2) <= 1e-12
    last = side.segments[-1]
    assert last.label is Label.TIP_LAND
    assert abs(end_point(last.curve).imag) <= RIGHT * gear.tip_radius


@pytest.mark.sampled(2)
@pytest.mark.parametrize("place", [0.02, 0.5, 0.98], ids=["start", "middle", "end"])
@pytest.mark.parametrize("label", [Label.ROOT_FILLET, Label.FLANK])
def test_both_oracles_see_a_hair(label: Label, place: float) -> None:
    """Negative control: a point 1e-10 of the tip radius off, either way, is seen by both with its size."""
    gear = CASES["z23"]
    curve = next(s.curve for s in tooth_side(gear).segments if s.label is label)
    t = curve.domain[0] + place * (curve.domain[1] - curve.domain[0])
    step = 1e-10 * gear.tip_radius
    for side in (1, -1):
        point = complex(curve.point(t)) + side * step * 1j * complex(curve.tangent(t))
        exact = abs(float(exact_gear.normal_distance(point, brute.exact_parameters(gear))))
        swept = rack_sweep.outline_error([point], brute.rack_tool(gear), 23, gear.tip_radius)[0]
        assert exact == pytest.approx(step, rel=1e-3)
        assert swept == pytest.approx(step, rel=1e-3)


@pytest.mark.sampled(1)
@EVERY
def test_thickness_against_the_oracle(gear: SpurGear) -> None:
    """s on the reference circle, where the flank reaches it, and psi_b from the involute that the flank is."""
    parameters = brute.exact_parameters(gear)
    flank = next(s.curve for s in tooth_side(gear).segments if s.label is Label.FLANK)
    if abs(start_point(flank)) <= gear.reference_radius <= abs(end_point(flank)):
        exact = float(exact_gear.tooth_thickness(parameters, gear.reference_radius))
        assert abs(gear.reference_thickness - exact) <= RIGHT * gear.tip_radius
    radius = abs(end_point(flank))
    exact = float(exact_gear.tooth_thickness(parameters, radius * (1 - 1e-15)))
    # the arc of both flanks, from the trimmed segment's own end
    assert abs(-2 * radius * np.angle(end_point(flank)) - exact) <= RIGHT * gear.tip_radius


def test_thinning_both_ways() -> None:
    """The same thickness; a wider rack tooth keeps the root diameter, a deeper cut lowers it by thinning/tan(alpha)."""
    plain, wide, deep = CASES["z23"], CASES["wider rack tooth"], CASES["deeper cut"]
    shift = 2 * 0.1 * math.tan(math.radians(20)) * 2.0
    for gear in (wide, deep):
        assert gear.reference_thickness == pytest.approx(plain.reference_thickness + shift - 0.15, rel=1e-14)
        assert gear.tip_radius == plain.tip_radius + 0.1 * 2.0
    assert wide.root_radius == pytest.approx(plain.root_radius + 0.2, rel=1e-15)
    assert deep.root_radius == pytest.approx(wide.root_radius - 0.15 / (2 * math.tan(math.radians(20))), rel=1e-14)


def _tip_break(gear: SpurGear) -> tuple[object, object, object]:
    side = tooth_side(gear).segments
    index = next(i for i, s in enumerate(side) if s.label is Label.TIP_BREAK)
    assert side[index + 1].label is Label.TIP_LAND
    return side[index - 1].curve, side[index].curve, side[index + 1].curve


BROKEN = {
    "plain": SpurGear(2.0, 23, iso_53()),
    "undercut": SpurGear(2.0, 10, iso_53()),
    "relief": SpurGear(2.0, 40, iso_53(relief=RELIEF)),
    "large": SpurGear(50.0, 41, iso_53("C", math.radians(25)), 0.3),
}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", BROKEN)
@pytest.mark.parametrize("share", [0.001, 0.02, 0.1])
def test_tip_chamfer(name: str, share: float) -> None:
    """Radial height as asked, 45 degrees to the radius through its foot, foot on flank, corner on tip circle."""
    base = BROKEN[name]
    height = share * base.module
    gear = SpurGear(base.module, base.number_of_teeth, base.rack, base.profile_shift_coefficient, tip_chamfer=height)
    flank, line, land = _tip_break(gear)
    assert isinstance(line, Line)
    assert isinstance(land, Arc)
    foot, corner = start_point(line), end_point(line)
    assert abs(gear.tip_radius - abs(foot) - height) <= RIGHT * gear.tip_radius
    assert abs(abs(corner) - gear.tip_radius) <= RIGHT * gear.tip_radius
    assert abs(np.angle((corner - foot) / foot) - math.pi / 4) <= 1e-12 * gear.tip_radius / height
    assert joint_turn(flank, line) > 0
    assert joint_turn(line, land) > 0
    tool = brute.rack_tool(base)
    below = rack_sweep.penetration(np.append(brute.dense(flank, 20), foot), tool, gear.number_of_teeth)
    assert np.abs(below).max() <= RIGHT * gear.tip_radius
    # the chamfer takes metal away: all of it lies inside the tooth as the rack left it
    assert rack_sweep.penetration(brute.dense(line, 20)[1:], tool, gear.number_of_teeth).max() < 0


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", BROKEN)
@pytest.mark.parametrize("share", [0.001, 0.02, 0.1])
def test_tip_rounding(name: str, share: float) -> None:
    """An arc of the radius asked for, tangent to the flank and to the tip circle."""
    base = BROKEN[name]
    radius = share * base.module
    gear = SpurGear(base.module, base.number_of_teeth, base.rack, base.profile_shift_coefficient, tip_rounding=radius)
    flank, arc, land = _tip_break(gear)
    assert isinstance(arc, Arc)
    assert abs(arc.radius - radius) <= RIGHT * gear.tip_radius
    assert abs(joint_turn(flank, arc)) <= 1e-9
    assert abs(joint_turn(arc, land)) <= 1e-9
    assert arc.sweep > 0
    assert abs(end_point(arc)) == pytest.approx(gear.tip_radius, rel=RIGHT)
    tool = brute.rack_tool(base)
    below = rack_sweep.penetration(brute.dense(flank, 20), tool, gear.number_of_teeth)
    assert np.abs(below).max() <= RIGHT * gear.tip_radius
    inside = rack_sweep.penetration(brute.dense(arc, 20)[1:], tool, gear.number_of_teeth)
    assert inside.max() <= RIGHT * gear.tip_radius


@pytest.mark.sampled(3)
@EVERY
def test_upper_side_mirrors_the_lower(gear: SpurGear) -> None:
    """One period: lower side, tip, upper side, root; mirrored in the x axis and travelled back it is itself."""
    profile: Profile = tooth_side(gear).profile()
    teeth = [s for s in profile.period if s.label is not Label.ROOT_LAND]
    assert [s.label for s in teeth] == [s.label for s in reversed(teeth)]
    points = np.concatenate([brute.dense(s.curve, 9) for s in teeth])
    mirror = np.conj(points[::-1])
    assert brute.distance_to_outline(mirror, profile).max() <= RIGHT * gear.tip_radius
    assert profile.count == gear.number_of_teeth

"""Crossed helical pairs against helicoids drawn by their definition, textbook formulas, and a search in sections."""

from __future__ import annotations

import math

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.placement import Placement3
from geometry.base.record import replace
from geometry.gears.mesh.crossed import _Teeth, crossed_contact
from geometry.gears.pairs.crossed import CrossedPair, crossed_pair, crossing
from geometry.gears.teeth.basic_rack import iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear
from geometry.plane.distance import Verdict
from geometry.plane.profile import Label
from tests.sampling import some_of

# m_n, z, beta in degrees (above 0 right-hand), x, face width of both
KHK = (3.0, (15, 24), (20.0, 30.0), (0.4, 0.2), (20.0, 20.0))
CASES = {
    "zero_shifts": (3.0, (13, 26), (45.0, 45.0), (0.0, 0.0), (18.0, 20.0)),
    "shifted": KHK,
    "left": (3.0, (15, 24), (-20.0, -30.0), (0.4, 0.2), (20.0, 20.0)),
    "straight": (2.0, (20, 30), (0.0, 30.0), (0.1, -0.2), (12.0, 20.0)),
    "opposite": (2.0, (18, 25), (55.0, -20.0), (0.0, 0.3), (20.0, 16.0)),
    "obtuse": (2.0, (12, 30), (60.0, 55.0), (0.3, 0.0), (30.0, 25.0)),
}


def _bare(case: tuple[float, tuple[int, int], tuple[float, float], tuple[float, float], tuple[float, float]],
          thinning: float = 0.0) -> CrossedPair:  # fmt: skip
    m, teeth, helices, shifts, widths = case
    rack = iso_53("A", math.radians(20.0))
    one, two = (
        transverse_gear(
            SpurGear(module=m, number_of_teeth=z, rack=rack, profile_shift_coefficient=x,
                     circumferential_thinning=thinning),
            math.radians(abs(beta)),
        )
        for z, beta, x in zip(teeth, helices, shifts, strict=True)
    )  # fmt: skip
    first, second = (math.radians(beta) for beta in helices)
    return CrossedPair(one, two, (first, second), widths, (widths[0] / 2, widths[1] / 2))


def _flank(gear: SpurGear, beta: float, roll: float, z: float, turned: float, side: int) -> np.ndarray:
    """A point of an involute helicoid by its definition: a transverse involute that turns as it rises."""
    half = math.pi / (2 * gear.number_of_teeth) + 2 * gear.profile_shift_coefficient * math.tan(gear.pressure_angle) / (
        gear.number_of_teeth
    )
    half += (
        math.tan(gear.pressure_angle)
        - gear.pressure_angle
        - gear.circumferential_thinning / (2 * gear.reference_radius)
    )
    start = turned + z * math.tan(beta) / gear.reference_radius - side * half
    w = gear.base_radius * np.exp(1j * (start + side * roll)) * (1 - 1j * side * roll)
    return np.array([w.real, w.imag, z])


def _least_gap(pair: CrossedPair, side: int) -> float:
    """The least distance of two flanks that face each other where they are well within their path, mm."""
    from scipy.optimize import minimize

    angle, along = pair.shaft_angle, 0.3 * pair.path[0] + 0.7 * pair.path[1]
    axis = (0.0, math.sin(angle), math.cos(angle))
    laid = np.array(Placement3.towards(axis, 0.0).rotation)
    foot = np.array([pair.working_centre_distance, 0.0, pair.feet[0]]) - pair.feet[1] * np.array(axis)
    rolls = [
        length * math.cos(b) / g.base_radius
        for length, b, g in zip((along, pair.action.length - along), pair.base_helices, pair.gears, strict=True)
    ]
    up = [f + side * h for f, h in zip(pair.feet, pair.heights(along), strict=True)]
    # the turn that brings tooth 1 of the first there, and the tooth of the second that faces it
    one, there = (
        side * (angle - roll + gear.base_half_angle) - twist * z
        for angle, roll, gear, twist, z in zip(
            (pair.action.angles[0], pair.action.angles[1] - math.pi), rolls, pair.gears, pair.twists, up, strict=True
        )
    )
    two, pitch = pair.second_rotation(one), pair.second.pitch_angle
    two += pitch * round((there - two) / pitch)

    def apart(p: np.ndarray) -> float:
        here = _flank(pair.first, pair.helices[0], p[0], p[1], one, side)
        return float(np.sum((here - foot - laid @ _flank(pair.second, pair.helices[1], p[2], p[3], two, side)) ** 2))

    start = np.array([rolls[0], up[0], rolls[1], up[1]]) + np.array([0.01, 0.1, -0.01, 0.1])
    return math.sqrt(minimize(apart, start, method="Nelder-Mead",
                              options={"xatol": 1e-10, "fatol": 1e-16, "maxiter": 4000}).fun)  # fmt: skip


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", CASES)
def test_gaps_between_helicoids_are_half_the_backlash_wherever_the_pair_stands(name: str) -> None:
    bare = _bare(CASES[name], thinning=0.08)
    nominal = crossed_pair(bare)
    askew = crossed_pair(bare, shaft_angle=abs(nominal.shaft_angle) + 0.01)
    wider = crossed_pair(bare, nominal.working_centre_distance + 0.3, abs(nominal.shaft_angle) - 0.004)
    for pair in some_of((nominal, askew, wider)):
        for side in (1, -1):
            assert _least_gap(pair, side) == pytest.approx(pair.normal_backlash / 2, abs=1e-7)


@pytest.mark.parametrize("name", CASES)
def test_of_all_shaft_angles_the_operating_helices_have_the_least_distance(name: str) -> None:
    bare = _bare(CASES[name])
    pair = crossed_pair(bare)
    own, step = abs(pair.shaft_angle), 1e-4
    assert pair.shaft_angle == pytest.approx(sum(pair.working_helices), abs=1e-13)
    assert pair.working_centre_distance == pytest.approx(sum(pair.working_radii), rel=1e-14)
    assert pair.normal_backlash == 0
    beside = [crossed_pair(bare, shaft_angle=own + way * step).working_centre_distance for way in (-1, 1)]
    assert min(beside) > pair.working_centre_distance
    # stationary: what is left of the difference quotient is the curvature's
    assert beside[1] - beside[0] == pytest.approx(0.0, abs=0.01 * (sum(beside) - 2 * pair.working_centre_distance))


def test_distances_of_textbooks() -> None:
    """KHK, screw gears: z 13 / 26 at 45 degrees; shifted by virtual numbers of teeth, which is near."""
    plain = crossed_pair(_bare(CASES["zero_shifts"]))
    assert plain.working_centre_distance == pytest.approx(3 * 39 / (2 * math.cos(math.pi / 4)), rel=1e-14)
    assert math.degrees(plain.shaft_angle) == 90
    # KHK: a = 67.1925 with alpha_wn = 22.9338 degrees, y = 0.55977 by z / cos^3 beta
    shifted = crossed_pair(_bare(KHK))
    assert shifted.working_centre_distance == pytest.approx(67.1925, abs=1e-3)
    assert math.degrees(shifted.working_pressure_angle) == pytest.approx(22.9338, abs=0.03)


@pytest.mark.parametrize("name", CASES)
def test_sliding_and_efficiency_at_the_pole_are_those_of_textbooks(name: str) -> None:
    pair = crossed_pair(_bare(CASES[name]))
    (one, two), f, cosine = pair.working_helices, 0.12, math.cos(pair.working_pressure_angle)
    assert pair.sliding(pair.pole) == pytest.approx(
        pair.working_radii[0] * abs(math.sin(pair.shaft_angle)) / math.cos(two), rel=1e-12
    )
    way = math.copysign(f, pair.shaft_angle)
    worth = (cosine - way * math.tan(two)) / (cosine + way * math.tan(one))
    assert pair.efficiency(f) == pytest.approx(worth, rel=1e-12)
    worth = (cosine - way * math.tan(one)) / (cosine + way * math.tan(two))
    assert pair.efficiency(f, back=True) == pytest.approx(worth, rel=1e-12)


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("friction", [0.0, 0.12])
def test_forces_at_the_pole_are_those_of_the_normal_and_of_friction_and_pass_on_the_power(
    name: str, friction: float
) -> None:
    pair = crossed_pair(_bare(CASES[name]))
    told = pair.forces(friction)
    for forces in told:
        # friction lies in the plane that both pitch cylinders touch
        assert forces.radial == pytest.approx(math.sin(pair.working_pressure_angle), rel=1e-12)
        whole = math.hypot(forces.circumferential, forces.radial, forces.axial)
        assert whole == pytest.approx(math.hypot(1.0, friction), rel=1e-12)
    powers = [f.circumferential * r / z for f, r, z in zip(told, pair.working_radii, CASES[name][1], strict=True)]
    assert powers[1] / powers[0] == pytest.approx(pair.efficiency(friction), rel=1e-12)


def test_a_gear_that_cannot_drive_gives_nothing_however_rough_the_flanks_are() -> None:
    """Power left of what goes in, by the forces along both tooth lines: none from cos(alpha_n) / tan(beta_2) on."""
    pair = crossed_pair(_bare((2.0, (20, 20), (-55.0, 60.0), (0.0, 0.0), (20.0, 20.0))))
    locked = math.cos(math.radians(20.0)) / math.tan(math.radians(60.0))
    assert pair.efficiency(0.99 * locked) > 0
    assert [pair.efficiency(f) for f in (1.01 * locked, 0.66, 0.8, 1.0)] == [0.0] * 4
    assert 0 < pair.efficiency(1.0, back=True) < 1


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", CASES)
def test_sections_of_whole_teeth_find_the_gap_of_the_closed_form_and_no_less(name: str) -> None:
    pair = crossed_pair(_bare(CASES[name]))
    found = crossed_contact(pair)
    assert found.verdict is Verdict.CONTACT
    assert abs(found.worst.gap) < 1e-12
    turned = 0.01 / pair.arms[1]
    one, two = crossed_contact(pair, turned).side_gaps
    assert min(one) == pytest.approx(0.01, abs=1e-10)
    # how deep a tip's edge is, is told across the axis
    assert np.median(two) == pytest.approx(-0.01, abs=1e-10)
    assert -0.01 / math.cos(max(map(abs, pair.base_helices))) - 1e-5 < min(two)


def test_a_pair_that_is_moved_together_overlaps_and_one_that_is_moved_apart_is_clear() -> None:
    pair = crossed_pair(_bare(KHK))
    a = pair.working_centre_distance
    # the flanks of a pair whose path is its own
    near = crossed_contact(replace(pair, working_centre_distance=a - 0.05))
    assert near.verdict is Verdict.OVERLAP
    assert np.median(near.gaps) == pytest.approx(-0.05 * math.sin(pair.working_pressure_angle), abs=1e-9)
    far = crossed_contact(replace(pair, working_centre_distance=a + 0.05))
    assert far.verdict is Verdict.CLEAR
    # tips that reach into roots and fillets are no matter of flanks
    low = replace(pair.second, given_tip_diameter=2 * (a - pair.first.root_radius + 0.02))
    deep = crossed_contact(replace(pair, second=low))
    assert deep.verdict is Verdict.OVERLAP
    assert deep.worst.gap < -0.019


def test_narrow_faces_are_in_contact_for_their_contact_ratio() -> None:
    """The share of drive angles at which sections touch; the flanks' search knows nothing of the path."""
    m, teeth, helices, shifts, _ = KHK
    pair = crossed_pair(_bare((m, teeth, helices, shifts, (20.0, 3.0))))
    assert 0.4 < pair.contact_ratio < 0.9 < pair.path_contact_ratio
    assert {f.code for f in pair.findings()} == {"contact_ratio", "crossed_face_second"}
    found = crossed_contact(pair)
    assert found.verdict is Verdict.CLEAR
    for gaps in found.side_gaps:
        share = sum(abs(gap) < 1e-7 for gap in gaps) / len(gaps)
        assert share == pytest.approx(pair.contact_ratio, abs=1.01 / len(gaps))
    wide = crossed_pair(_bare((m, teeth, helices, shifts, pair.least_face_widths)))
    assert wide.contact_ratio == pytest.approx(wide.path_contact_ratio, rel=1e-12)


def test_the_contact_ratio_is_that_of_the_flanks_that_faces_beside_the_line_of_centres_use_less() -> None:
    """As above: of the first a tenth of the face lies below it."""
    m, teeth, helices, shifts, _ = KHK
    pair = crossed_pair(replace(_bare((m, teeth, helices, shifts, (4.0, 20.0))), feet=(0.4, 10.0)))
    shares = [sum(abs(gap) < 1e-7 for gap in gaps) / len(gaps) for gaps in crossed_contact(pair).side_gaps]
    assert max(shares) > 0.9
    assert min(shares) == pytest.approx(pair.contact_ratio, abs=1.01 / 24)


def test_what_cannot_be_is_refused_with_what_works() -> None:
    bare = _bare(KHK)
    own = crossed_pair(bare)
    with pytest.raises(ParameterError) as refused:
        crossed_pair(bare, own.working_centre_distance - 1)
    assert refused.value.nearest is not None
    assert refused.value.nearest.value == pytest.approx(own.working_centre_distance, abs=1e-6)
    with pytest.raises(ParameterError, match="shaft_angle"):
        crossed_pair(bare, shaft_angle=0.1)
    with pytest.raises(ParameterError, match="profile_shift_coefficient"):
        crossed_pair(_bare((3.0, (15, 24), (20.0, 30.0), (-1.0, -2.0), (20.0, 20.0))))


def test_the_line_of_centres_of_placements() -> None:
    axis = (0.6, 0.0, 0.8)
    placed = Placement3.towards(axis, 0.3, (0.6 * 7, -5.0, 2 + 0.8 * 7))
    offset, feet = crossing(placed)
    assert offset == pytest.approx(-5j, abs=1e-12)
    assert feet == pytest.approx((2.0, -7.0), abs=1e-12)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("own", [0, 1])
def test_places_beside_a_tips_edge_are_as_deep_as_the_nearest_of_flank_and_tip_in_space(own: int) -> None:
    """Against a cloud of points of the gear's screw surfaces; in the section the tip cylinder may be nearer."""
    from scipy.spatial import cKDTree

    pair = crossed_pair(_bare(CASES["obtuse"]))
    teeth, gear, side = _Teeth(pair, own, 1), pair.gears[own], pair.sides[own]
    flank = next(s.curve for s in side.segments if s.label is Label.FLANK)
    edge = complex(flank.point(np.array([flank.domain[1]]))[0])
    rolls = np.linspace(*flank.domain, 400)
    curves = [flank.point(rolls), gear.tip_radius * np.exp(1j * np.linspace(np.angle(edge), 0.0, 200))]
    z = np.linspace(-0.6, 0.6, 401)
    turned = np.concatenate(curves)[:, None] * np.exp(1j * teeth.twist * z)
    cloud = np.stack([turned.real, turned.imag, np.broadcast_to(z, turned.shape)], axis=-1).reshape(-1, 3)
    draw = np.random.default_rng(0)
    places = edge + draw.uniform(-0.15, 0.15, 200) + 1j * draw.uniform(-0.15, 0.15, 200)
    feet, share = teeth.feet(places, np.zeros(200))
    found, _ = cKDTree(cloud).query(np.stack([places.real, places.imag, np.zeros(200)], axis=-1))
    inside = feet.distance < 0
    assert inside.sum() > 40
    assert np.abs(feet.distance * share)[inside] == pytest.approx(found[inside], rel=0.02, abs=0.006)

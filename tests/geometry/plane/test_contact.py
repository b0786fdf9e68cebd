"""Signed distances against dense brute force and 40-digit roots; corners, signs and searches on well-known shapes.

Whole gears in mesh are held against dense polygons.
"""

from __future__ import annotations

import cmath
import math
import random
from functools import cache
from typing import NamedTuple

import mpmath
import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st
from shapely import affinity

from geometry.base.placement import Placement2
from geometry.curves.curve import Curve, Real
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.curves.trochoid import TrochoidFillet
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.pairs.external import ExternalPair, external_pair
from geometry.gears.teeth.basic_rack import TipRelief, iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide, tooth_side
from geometry.plane.distance import Boundary, Indices, Verdict, folded, least_in_brackets, promising
from tests import brute
from tests.oracles.trochoid import Trochoid
from tests.sampling import examples
from tests.strategies import fillets, gears, involutes, numbers, trochoids

RACK = iso_53()
BOX = Boundary(tuple(Line(a, b) for a, b in ((0j, 4 + 0j), (4 + 0j, 4 + 2j), (4 + 2j, 2j), (2j, 0j))), closed=True)
# an L: the corner at 1 + 1i is concave
ELL_POINTS = (0j, 3 + 0j, 3 + 1j, 1 + 1j, 1 + 3j, 3j)
ELL = Boundary(
    tuple(Line(a, b) for a, b in zip(ELL_POINTS, (*ELL_POINTS[1:], ELL_POINTS[0]), strict=True)), closed=True
)


class Approach(NamedTuple):
    """The least signed distance of a curve from a boundary: mm, where on the curve, where on the boundary."""

    distance: float
    parameter: float
    boundary_index: int
    boundary_parameter: float


def closest_approach(curve: Curve, boundary: Boundary, samples: int = 65, accuracy: float = 1e-13) -> Approach:
    """Least signed distance of the points of a curve from a boundary, mm; negative: depth of the deepest point.

    Every bracket between samples is searched that may hold less than the least sample (1-Lipschitz bound);
    two minima within one sample step count as one.
    """
    t = np.linspace(*curve.domain, samples)

    def evaluate(at: Real, _rows: Indices) -> tuple[Real, Real]:
        feet = boundary.feet(curve.point(at))
        return feet.distance, (np.conj(feet.normal) * curve.derivative(at)).real

    value, slope = evaluate(t, np.arange(samples))
    lengths = 1.2 * np.abs(np.diff(curve.point(t)))
    chosen = np.flatnonzero(promising(value[:-1], value[1:], slope[:-1], slope[1:], lengths, value.min()))
    where, least = least_in_brackets(evaluate, t[chosen], t[chosen + 1], (slope[chosen], slope[chosen + 1]), accuracy)
    at = float(np.append(where, t)[np.argmin(np.append(least, value))])
    feet = boundary.feet(curve.point(np.array([at])))
    return Approach(float(feet.distance[0]), at, int(feet.curve_index[0]), float(feet.parameter[0]))


def involute_gap(first: Involute, second: Involute) -> tuple[float, float, float] | None:
    """Distance of two facing involutes along their common normal, mm, and both roll angles; None where it misses one.

    Both are branches that turn left on their way out (roll > 0), as lower flanks of two external gears that face
    each other. The common normal touches both base circles at psi = delta + alpha_w, cos(alpha_w) =
    (r_b1 + r_b2) / a, and the gap is a sin(alpha_w) - r_b1 f1 - r_b2 f2, negative where they overlap.
    """
    line = second.centre - first.centre
    distance, radii = abs(line), first.base_radius + second.base_radius
    if not distance > radii:
        return None
    angle = math.acos(radii / distance)
    psi = math.atan2(line.imag, line.real) + angle
    rolls = []
    for curve, at in ((first, psi), (second, psi + math.pi)):
        middle = (curve.start_roll + curve.end_roll) / 2
        roll = middle + math.remainder(at - curve.base_angle - middle, 2 * math.pi)
        if not curve.start_roll <= roll <= curve.end_roll:
            return None
        rolls.append(roll)
    gap = distance * math.sin(angle) - first.base_radius * rolls[0] - second.base_radius * rolls[1]
    return gap, rolls[0], rolls[1]


def half_pitch(side: ToothSide) -> Boundary:
    """The lower half pitch of a gear as a boundary that goes on as its mirror image."""
    ends = cmath.exp(-0.5j * side.pitch_angle), 1 + 0j
    return Boundary(tuple(s.curve for s in side.segments), end_normals=ends)


@pytest.mark.parametrize(("point", "distance", "normal"), [
    (2 - 1j, 1.0, -1j), (2 + 0.25j, -0.25, -1j), (7 + 6j, 5.0, 0.6 + 0.8j), (4.5 + 1j, 0.5, 1 + 0j),
    (3.75 + 1j, -0.25, 1 + 0j), (-3 - 4j, 5.0, -0.6 - 0.8j), (2 + 2j, 0.0, 1j),
])  # fmt: skip
def test_a_box(point: complex, distance: float, normal: complex) -> None:
    feet = BOX.feet(np.array([point]))
    assert feet.distance[0] == pytest.approx(distance, abs=1e-15)
    assert feet.normal[0] == pytest.approx(normal, abs=1e-15)


def test_a_concave_corner_is_inside_material() -> None:
    feet = ELL.feet(np.array([0.7 + 0.6j, 1.2 + 1.5j, 0.5 + 2j]))
    assert feet.distance == pytest.approx([-0.5, 0.2, -0.5], abs=1e-15)
    assert feet.normal[0] == pytest.approx(0.6 + 0.8j)
    assert sorted(ELL.convex_corners, key=abs) == sorted((p for p in ELL_POINTS if p != 1 + 1j), key=abs)


def test_open_chains_end_as_they_are_told() -> None:
    curve = (Line(1 + 0j, 1 + 1j),)
    assert Boundary(curve).convex_corners == ()
    assert Boundary(curve, end_normals=(-1j, 1 + 1j)).convex_corners == (1 + 0j, 1 + 1j)
    assert Boundary(curve).feet(np.array([2 + 2j])).distance[0] == pytest.approx(math.sqrt(2))


@examples(30)
@given(gears(), st.integers(0, 2**32))
def test_distance_from_any_gear_as_brute_force_has_it(gear: SpurGear, seed: int) -> None:
    """Folded into half a pitch: distance by ternary search over the whole outline, side by a dense polygon."""
    side = tooth_side(gear)
    profile, draw = side.profile(), np.random.default_rng(seed)
    radii = draw.uniform(gear.root_radius - gear.module, gear.tip_radius + gear.module, 60)
    points = np.maximum(radii, 0.3 * gear.root_radius) * np.exp(1j * draw.uniform(-math.pi, math.pi, 60))
    inner, _ = folded(points, points, gear.pitch_angle)
    found = half_pitch(side).feet(inner)
    assert np.abs(found.distance) == pytest.approx(brute.distance_to_outline(points, profile), abs=1e-9 * gear.module)
    vertices = brute.polygon(profile, 60)
    shape = shapely.Polygon(np.column_stack([vertices.real, vertices.imag]))
    inside = shapely.contains_xy(shape, points.real, points.imag)
    clear = np.abs(found.distance) > 0.01 * gear.module
    assert np.array_equal((found.distance < 0)[clear], inside[clear])


@examples(60)
@given(st.one_of(involutes(), fillets(), trochoids()), st.data())
def test_feet_are_where_the_offset_curve_says(curve: Involute | TrochoidFillet | Trochoid, data: st.DataObject) -> None:
    """A point set off along the normal, less far than the least radius of curvature, is found again with its sign."""
    t = np.linspace(*curve.domain, 40)[1:-1]
    room = 0.2 / float(np.max(np.abs(curve.curvature(t))) + 0.05)
    offset = room * data.draw(numbers(-1, 1))
    points = curve.point(t) - 1j * curve.tangent(t) * offset
    feet = Boundary((curve,)).feet(points)
    away = np.min(np.abs(curve.point(np.linspace(*curve.domain, 4001))[:, None] - points), axis=0)
    own = away > abs(offset) * (1 - 1e-9) - 1e-12  # another part of a spiral may be nearer
    assert np.all(np.abs(feet.distance) <= away * (1 + 1e-12) + 1e-12)
    scale = float(np.max(np.abs(curve.point(t)))) + 1
    assert feet.distance[own] == pytest.approx(np.full(own.sum(), offset), abs=1e-12 * scale + 1e-9 * abs(offset))


def facing(rng: random.Random) -> tuple[Involute, Involute, float]:
    """Two facing flanks with a small gap either way, and their angle of action."""
    one, two, angle = rng.uniform(5, 80), rng.uniform(5, 80), rng.uniform(0.2, 0.7)
    distance = (one + two) / math.cos(angle)
    direction, gap = rng.uniform(-3, 3), rng.uniform(-0.02, 0.02)
    length = distance * math.sin(angle)
    at = rng.uniform(0.3, 0.7) * length
    roll, mate = at / one, (length - at - gap) / two
    first = Involute(one, direction + angle - roll, 0.5 * roll, 1.5 * roll)
    second = Involute(two, direction + angle + math.pi - mate, 0.5 * mate, 1.5 * mate,
                      cmath.rect(distance, direction))  # fmt: skip
    return first.placed(Placement2(0.0, 3 - 2j)), second.placed(Placement2(0.0, 3 - 2j)), gap


@pytest.mark.sampled(8)
@pytest.mark.parametrize("seed", range(25))
def test_involute_gap_against_forty_digits_and_the_search(seed: int) -> None:
    """The oracle solves for two points whose connection is normal to both curves; it knows no base circles."""
    first, second, meant = facing(random.Random(seed))
    found = involute_gap(first, second)
    assert found is not None
    gap, roll, mate = found
    assert gap == pytest.approx(meant, abs=1e-12)
    with mpmath.workdps(40):

        def spoke(c: Involute, f: mpmath.mpf) -> mpmath.mpc:
            return mpmath.exp(1j * (c.base_angle + mpmath.re(f)))

        def point(c: Involute, f: mpmath.mpf) -> mpmath.mpc:
            return c.centre + c.base_radius * spoke(c, f) * (1 - 1j * mpmath.re(f))

        def equations(f: mpmath.mpf, g: mpmath.mpf) -> tuple[mpmath.mpf, mpmath.mpf]:
            step, one, two = point(second, g) - point(first, f), spoke(first, f), spoke(second, g)
            return mpmath.re(mpmath.conj(one) * step), mpmath.im(mpmath.conj(one) * two)

        f, g = mpmath.findroot(equations, (roll + 1e-3, mate - 1e-3))
        exact = mpmath.re((point(second, g) - point(first, f)) * mpmath.conj(-1j * spoke(first, f)))
        assert abs(exact - gap) < 1e-12
    near = closest_approach(second, Boundary((first,)))
    assert near.distance == pytest.approx(gap, abs=1e-12)
    assert near.parameter == pytest.approx(mate, abs=1e-5)
    assert near.boundary_parameter == pytest.approx(roll, abs=1e-5)
    moved = second.placed(Placement2(0.0, 1e-6 * cmath.exp(1j * (first.base_angle + roll)) * -1j))
    assert involute_gap(first, moved)[0] == pytest.approx(gap + 1e-6, abs=1e-11)  # type: ignore[index]


def test_involute_gap_where_no_common_normal_meets_both() -> None:
    first, second, _ = facing(random.Random(1))
    assert involute_gap(first, second.placed(Placement2(0.0, -second.centre + first.centre))) is None
    assert involute_gap(first.trimmed(first.start_roll, first.start_roll * 1.01), second) is None


@pytest.mark.parametrize("depth", [0.3, 1e-3, 0.0, -1e-6, -1e-3, -0.2])
def test_a_round_over_a_box_and_into_its_corner(depth: float) -> None:
    """A circle's lowest point over an edge, and beside a corner along the diagonal."""
    circle = Arc(2 + 1j * (2 + 0.5 + depth), 0.5, -3.0, 2.8)
    assert closest_approach(circle, BOX).distance == pytest.approx(depth, abs=1e-13)
    if depth > 0:
        beside = Arc(4 + 2j + (0.5 + depth) * cmath.exp(0.25j * math.pi), 0.5, -3.0, 2.8)
        assert closest_approach(beside, BOX).distance == pytest.approx(depth, abs=1e-13)


def test_a_pointed_curve_reaches_deepest_with_its_end() -> None:
    assert closest_approach(Line(2 + 3j, 2.1 + 1.99j), BOX).distance == pytest.approx(-0.01, abs=1e-15)
    assert closest_approach(Line(2 + 3j, 2.1 + 2.01j), BOX).distance == pytest.approx(0.01, abs=1e-15)


@pytest.mark.sampled(7)
@pytest.mark.parametrize("seed", range(12))
def test_any_curve_against_a_relieved_tooth_by_brute_force(seed: int) -> None:
    """Tip corners, relief and fillets of a tooth against an arc placed anywhere near."""
    rng = random.Random(seed)
    side = tooth_side(SpurGear(1.0, rng.randint(8, 30), iso_53(relief=TipRelief(0.02)), rng.uniform(0.2, 0.6)))
    tooth = half_pitch(side)
    middle = cmath.rect(
        rng.uniform(0.9, 1.1) * abs(complex(tooth.vertices[2])), -side.pitch_angle * rng.uniform(0, 0.6)
    )
    curve = Arc(middle, rng.uniform(0.1, 0.6), rng.uniform(-3, 3), rng.choice((-1, 1)) * rng.uniform(0.5, 4))
    found = closest_approach(curve, tooth)
    dense = tooth.feet(brute.dense(curve, 6001)).distance
    assert dense.min() - 1e-6 <= found.distance <= dense.min() + 1e-13
    assert found.distance == pytest.approx(float(tooth.feet(curve.point(np.array([found.parameter]))).distance[0]))


def practicum_pair(thinning: float = 0.0) -> ExternalPair:
    """Lesson 3 of the practicum, each tooth thinned by some mm."""
    return external_pair(SpurGear(10.0, 13, RACK, 0.694, circumferential_thinning=thinning),
                         SpurGear(10.0, 21, RACK, 0.384, circumferential_thinning=thinning))  # fmt: skip


@cache
@cache
def outline(gear: SpurGear, side: int, pair: ExternalPair, count: int = 120) -> shapely.Polygon:
    """A dense polygon of a whole gear; chords are within 2e-5 module."""
    points = brute.polygon(pair.sides[side].profile(), count)
    return shapely.Polygon(np.column_stack([points.real, points.imag]))


def placed(pair: ExternalPair, drive: float, second: float) -> tuple[shapely.Polygon, shapely.Polygon]:
    """Both polygons in the frame of the line of centres."""
    one = affinity.rotate(outline(pair.first, 0, pair), drive, origin=(0, 0), use_radians=True)
    two = affinity.rotate(outline(pair.second, 1, pair), second, origin=(0, 0), use_radians=True)
    return one, affinity.translate(two, pair.working_centre_distance)


BRUTE = {
    "practicum": (practicum_pair(), 0.0),
    "turned clear": (practicum_pair(0.4), 1e-3),
    "turned in": (practicum_pair(), 4e-3),
    "long tips": (external_pair(SpurGear(1.0, 30, RACK, given_tip_diameter=32.2),
                                SpurGear(1.0, 40, RACK, given_tip_diameter=42.7)), 0.0),
    "undercut": (external_pair(SpurGear(2.0, 27, RACK, 0.06), SpurGear(2.0, 9, RACK, -0.33)), 0.0),
    "relief": (external_pair(*(SpurGear(1.0, z, iso_53(relief=TipRelief(0.05, 0.6)), 0.1, tip_chamfer=0.1)
                               for z in (18, 33))), 0.0),
    "rounded tips": (external_pair(*(SpurGear(1.0, z, RACK, 0.1, tip_rounding=0.15, circumferential_thinning=0.1)
                                     for z in (18, 33))), 2e-3),
    "roots": (external_pair(SpurGear(1.0, 20, RACK, given_tip_diameter=23.0), SpurGear(1.0, 25, RACK)), 0.0),
}  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", BRUTE)
def test_gap_curve_against_dense_polygons(name: str) -> None:
    """Distance where they are apart, deepest point of either outline inside the other where they are not."""
    pair, turn = BRUTE[name]
    found = GearMesh(pair, second_turn=turn).contact()
    assert found.verdict is not Verdict.UNDECIDED
    for k in range(0, len(found.gaps), 11):
        drive = found.drive_angles[k]
        one, two = placed(pair, drive, pair.second_rotation(drive) + turn)
        gap = one.distance(two)
        common = shapely.get_parts(shapely.intersection(one, two))
        corners = [p for part in common if part.geom_type == "Polygon" for p in part.exterior.coords]
        if corners:
            points, at, m = shapely.points(np.array(corners)), pair.working_radii[0], 5 * pair.module
            near = [shapely.clip_by_rect(s.boundary, at - m, -m, at + m, m) for s in (one, two)]
            depth = [shapely.distance(points, line) for line in near]
            gap = -max(float(d.max()) for d in depth)
        # the depth of tip and root lands inside each other differs by which of both is asked, by the second order
        assert found.gaps[k] == pytest.approx(gap, abs=5e-5 * pair.module, rel=1e-3 if gap < 0 else 0), drive


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", ["long tips", "roots", "undercut", "relief"])
def test_either_gear_may_be_the_first(name: str) -> None:
    """A corner that strikes is found whichever gear it belongs to: with the same place and nearly the same depth."""
    pair, _ = BRUTE[name]
    one, two = GearMesh(pair).contact(), GearMesh(external_pair(pair.second, pair.first)).contact()
    assert one.verdict is two.verdict
    assert one.worst.gap == pytest.approx(two.worst.gap, rel=1e-3, abs=1e-9)
    assert one.greatest_gap == pytest.approx(two.greatest_gap, rel=0.02, abs=1e-9)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("direction", [0.0, 1.1, -2.5, math.pi])
def test_the_phase_holds_for_any_line_of_centres(direction: float) -> None:
    """Whole gears by polygons: no overlap and no play, from any rotation of the first gear."""
    pair = practicum_pair()
    for drive in (0.0, 0.37, -4.0):
        second = pair.second_rotation(drive, direction)
        one = affinity.rotate(outline(pair.first, 0, pair), drive, origin=(0, 0), use_radians=True)
        two = affinity.rotate(outline(pair.second, 1, pair), second, origin=(0, 0), use_radians=True)
        centre = pair.working_centre_distance * np.exp(1j * direction)
        moved = affinity.translate(two, centre.real, centre.imag)
        assert one.intersection(moved).area < 1e-3
        assert one.distance(moved) < 4e-4  # chords of both
        turned = affinity.rotate(moved, 1e-3, origin=(centre.real, centre.imag), use_radians=True)
        assert one.intersection(turned).area > 0.05


@pytest.mark.heavy
def test_an_idler_meshes_with_both_its_mates() -> None:
    """One gear in two pairs on a bent line of centres: its rotation in the first pair drives the second."""
    sun, idler, wheel = SpurGear(2.0, 17, RACK, 0.3), SpurGear(2.0, 24, RACK, 0.1), SpurGear(2.0, 41, RACK, -0.2)
    tips = [g.tip_radius for g in (external_pair(sun, idler).second, external_pair(idler, wheel).first)]
    idler = SpurGear(2.0, 24, RACK, 0.1, 2 * min(tips))
    before, after = external_pair(sun, idler), external_pair(after_first := idler, wheel)
    assert before.second == after.first == after_first
    assert GearMesh(before).contact().verdict is GearMesh(after).contact().verdict is Verdict.CONTACT
    turn = 0.77
    second = before.second_rotation(turn, 0.2)
    third = after.second_rotation(second, 1.3)
    two = affinity.rotate(outline(idler, 0, after), second, origin=(0, 0), use_radians=True)
    three = affinity.rotate(outline(wheel, 1, after), third, origin=(0, 0), use_radians=True)
    centre = after.working_centre_distance * np.exp(1.3j)
    moved = affinity.translate(three, centre.real, centre.imag)
    assert two.intersection(moved).area < 1e-4
    assert two.distance(moved) < 1e-5

"""Teeth of bevel gears by their definitions: a rolled great circle, a rolled cutter, a spur gear, conjugate mates."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import ParameterError, PointedTipError, UndercutError
from geometry.base.record import replace
from geometry.curves.curve import Real
from geometry.gears.bevel.gear import BevelGear, Blank
from geometry.gears.bevel.pair import BevelPair
from geometry.gears.bevel.sphere import SphericalInvolute, spatial
from geometry.gears.bevel.walls import fillet_off, tooth_off, wall_distance
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.distance import Verdict
from tests.sampling import examples

SHARE = np.linspace(0.0, 1.0, 41)
# teeth of both, shaft angle, shift of the first
PAIRS = ((20, 40, 90.0, 0.3), (13, 17, 70.0, 0.1), (16, 24, 120.0, 0.0), (9, 40, 90.0, 0.0), (30, 30, 90.0, 0.0))


@cache
def gears(first: int, second: int, angle: float, shift: float, module: float = 3.0) -> tuple[BevelGear, BevelGear]:
    """Both gears of a pair, without backlash."""
    made = [
        BevelGear(module, z, mate, 4 * module, Blank(0.5 * module), math.radians(angle), profile_shift_coefficient=x)
        for z, mate, x in ((first, second, shift), (second, first, -shift))
    ]
    return made[0].checked(), made[1].checked()


@cache
def both_sides(number: int) -> BevelPair:
    return BevelPair(*gears(*PAIRS[number]))


def turned(vectors: Real, axis: Real, angle: float | Real) -> Real:
    """Vectors turned about an axis (Rodrigues), by one angle or each by its own."""
    along, by = (vectors @ axis)[..., None] * axis, np.asarray(angle)[..., None]
    return np.asarray(along + np.cos(by) * (vectors - along) + np.sin(by) * np.cross(axis, vectors))


@pytest.mark.parametrize("base", [0.05, 0.6, 1.2])
def test_the_involute_is_drawn_by_a_great_circle_that_rolls_off_the_base_circle(base: float) -> None:
    """The great circle that touches at azimuth b, from the touching point back by the arc b sin(base)."""
    curve, z = SphericalInvolute(base), np.array([0.0, 0.0, 1.0])
    for rolled in (0.01, 0.3, 0.9):
        azimuth = rolled / math.sin(base)
        touching = spatial(np.array(base), np.array(azimuth))
        way = np.cross(z, touching) / math.sin(base)
        drawn = math.cos(rolled) * touching - math.sin(rolled) * way
        own = spatial(curve.angle(rolled), curve.involute(rolled))
        assert np.allclose(own, drawn, rtol=0, atol=1e-15 / base)
        assert float(curve.arc(curve.angle(rolled))) == pytest.approx(rolled, rel=1e-12)


@pytest.mark.parametrize("number", range(len(PAIRS)))
def test_the_fillet_is_what_a_rounding_leaves_that_rolls_with_the_crown_gear(number: int) -> None:
    """The crown gear turns about its axis, the pitch cone rolls on its plane: nothing is nearer than the rounding."""
    gear = both_sides(number).first
    fillet, delta = gear.fillet, gear.pitch_angle
    # in the frame of the gear: its axis is z, the pitch line lies in the half plane of +x, the crown's axis beyond
    crown = np.array([math.cos(delta), 0.0, -math.sin(delta)])
    line = np.array([math.sin(delta), 0.0, math.cos(delta)])
    # places so far apart miss the nearest one by 6e-5 of the rounding at most
    rolled = np.linspace(-0.6, 1.2, 3601)
    start = math.cos(fillet.depth) * line - math.sin(fillet.depth) * crown
    # the crown's tooth has come so far; its centre stands aside of the middle
    places = turned(start, crown, fillet.aside - rolled)
    centres = turned(places, np.array([0.0, 0.0, 1.0]), -rolled / math.sin(delta))
    points = spatial(*fillet.place(gear.joint[0] * SHARE))
    points[:, 1] *= -1
    gaps = np.arccos(np.clip(points @ centres.T, -1.0, 1.0))
    assert gaps.min(axis=1) == pytest.approx(fillet.radius, rel=6e-5)
    assert float(gaps.min()) > fillet.radius * (1 - 1e-9)


@pytest.mark.parametrize("number", range(len(PAIRS)))
def test_fillet_and_flank_meet_and_touch_unless_undercut(number: int) -> None:
    for gear in both_sides(number).gears:
        (a, b), (c, d) = (gear.tooth_places(name, SHARE) for name in ("fillet", "flank"))
        assert (a[-1], b[-1]) == pytest.approx((c[0], d[0]), rel=0, abs=1e-14)
        step = 1e-6
        crossing, arc = gear.joint
        before = np.diff(spatial(*gear.fillet_place(np.array([crossing - step, crossing]))), axis=0)[0]
        rolled = gear.involute.angle(np.array([arc, arc + step]))
        after = np.diff(spatial(rolled, gear.half_angle(rolled)), axis=0)[0]
        turn = math.acos(min(1.0, float(before @ after / np.linalg.norm(before) / np.linalg.norm(after))))
        if gear.is_undercut:
            assert turn > 0.01
        else:
            assert turn < 1e-4


def test_the_undercut_one_is_undercut_and_the_least_shift_ends_it() -> None:
    gear = both_sides(3).first
    assert gear.is_undercut
    assert not replace(gear, profile_shift_coefficient=gear.least_shift + 1e-6).is_undercut
    assert replace(gear, profile_shift_coefficient=gear.least_shift - 1e-6).is_undercut


@pytest.mark.parametrize("number", [2, 3])
def test_a_tooth_that_is_hardly_undercut_keeps_its_flank(number: int) -> None:
    """From 0 to 6e-5 modules below the least shift it was refused: no part of the involute is left below the tip."""
    for gear in both_sides(number).gears:
        for less in (1e-8, 1e-7, 1e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4, 3e-4, 1e-3):
            cut = replace(gear, profile_shift_coefficient=gear.least_shift - less)
            if abs(cut.profile_shift_coefficient) < 1:
                (a, b), (c, d) = (cut.tooth_places(name, SHARE) for name in ("fillet", "flank"))
                assert (a[-1], b[-1]) == pytest.approx((c[0], d[0]), rel=0, abs=5e-14)
                assert cut.involute.base - 1e-15 < c[0] < cut.pitch_angle


def test_beside_a_plane_mate_it_is_a_spur_gear() -> None:
    """The cones of a pinion whose mate has ten million teeth are cylinders to 1e-6 of its size."""
    rack = BasicRack(math.radians(20.0), 1.0, 0.2, 0.2)
    spur = SpurGear(2.0, 18, rack, 0.25)
    bevel = BevelGear(2.0, 18, 18_000_000, 5.0, Blank(1.0), profile_shift_coefficient=0.25)
    assert bevel.pitch_angle == pytest.approx(1e-6, rel=1e-6)
    for name, curve in (("fillet", spur.fillet()), ("flank", spur.flank())):
        points = bevel.points(name, SHARE)
        radius, azimuth = np.hypot(points[:, 0], points[:, 1]), np.arctan2(points[:, 1], points[:, 0])
        # the spur gear's tooth 1 on +x, too
        dense = curve.point(np.linspace(*curve.domain, 4001))
        own = np.interp(radius, *_sorted(np.abs(dense), np.abs(np.angle(dense))))
        assert azimuth * radius == pytest.approx(own * radius, abs=2e-5)


def _sorted(radius: Real, azimuth: Real) -> tuple[Real, Real]:
    order = np.argsort(radius)
    return radius[order], azimuth[order]


@pytest.mark.parametrize("number", [0, 1, 2, 4])
def test_flanks_of_mates_touch_at_every_angle_and_a_push_is_overlap(number: int) -> None:
    pair = both_sides(number)
    found = pair.contact()
    assert found.verdict is Verdict.CONTACT
    assert np.abs(np.array(found.side_gaps)).max() < 1e-12
    radius = pair.second.module * pair.second.number_of_teeth / 2
    pushed = pair.contact(1e-4 / radius)
    assert pushed.verdict is Verdict.OVERLAP
    sides = np.array(pushed.side_gaps)
    # what overlaps is deepest at the outer end, what gapes least at the inner one
    ends = np.array([-1.0, pair.first.inner_distance / pair.first.cone_distance])
    assert np.sort(sides.mean(axis=1)) == pytest.approx(ends * 1e-4 * math.cos(math.radians(20)), rel=1e-6)


def test_backlash_is_shared_by_both_sides_and_an_undercut_drive_is_interrupted() -> None:
    thin = BevelPair(*(replace(g, circumferential_thinning=0.05) for g in both_sides(0).gears))
    found = thin.contact()
    assert found.verdict is Verdict.CLEAR
    inner = thin.first.inner_distance / thin.first.cone_distance
    assert np.array(found.side_gaps) == pytest.approx(0.05 * inner * math.cos(math.radians(20)), rel=1e-9)
    assert thin.normal_backlash == pytest.approx(0.1 * math.cos(math.radians(20)), rel=1e-12)
    lost = BevelPair(*gears(8, 40, 90.0, 0.0))
    assert lost.contact_ratio < 1
    assert lost.contact().verdict is Verdict.CLEAR
    assert min(lost.form_reserves) < 0


def test_the_contact_ratio_is_counted_off_a_pitch_of_turning() -> None:
    """How many teeth touch on one side, mean over a pitch: by the gaps of each tooth alone."""
    pair = both_sides(0)
    first, second = pair.gears
    inv, pitch = first.involute, math.tau / first.number_of_teeth
    own, rolled = float(first.half_angle(first.pitch_angle)), float(inv.arc(first.pitch_angle))
    touching, steps = 0, 4000
    # along the line of action the mate's arc is what is left of both base arcs
    both = rolled + float(second.involute.arc(second.pitch_angle))
    for k in range(steps):
        for tooth in range(-4, 5):
            arc = rolled + math.sin(inv.base) * (pitch * (k / steps + tooth) + own)
            if not first.joint[1] <= arc <= first.tip_arc:
                continue
            touching += second.joint[1] <= both - arc <= second.tip_arc
    assert touching / steps == pytest.approx(pair.contact_ratio, abs=2e-3)


def test_the_contact_ratio_inwards_is_that_of_a_pair_with_the_teeth_of_that_end() -> None:
    """At the inner end teeth are those of a smaller pair whose tips are lower: h_a = h_ai, c so much more."""
    pair = both_sides(0)
    share = pair.first.inner_distance / pair.first.cone_distance
    smaller = []
    for gear in pair.gears:
        high = float(gear.addendum_at(gear.inner_distance)) / (gear.module * share)
        shift, clearance = gear.profile_shift_coefficient, gear.addendum_coefficient + gear.tip_clearance_coefficient
        own = high - shift
        smaller.append(replace(gear, module=gear.module * share, face_width=1.0, addendum_coefficient=own,
                               tip_clearance_coefficient=clearance - own))  # fmt: skip
    inner = BevelPair(*smaller)
    assert pair.contact_ratio_at(pair.first.inner_distance) == pytest.approx(inner.contact_ratio, rel=1e-12)
    assert inner.contact_ratio < pair.contact_ratio - 0.01


def test_the_ratio_of_the_back_cones_comes_near_it_for_slender_cones() -> None:
    """Tredgold's virtual gears: 1e-3 off for 20/40, less the more teeth there are."""
    off = []
    for scale in (1, 2, 4):
        pair = BevelPair(*gears(20 * scale, 40 * scale, 90.0, 0.0))
        virtual = 0.0
        for gear in pair.gears:
            r, a = gear.module * gear.virtual_teeth / 2, gear.pressure_angle
            virtual += math.sqrt((r + gear.addendum) ** 2 - (r * math.cos(a)) ** 2) - r * math.sin(a)
        off.append(abs(virtual / (math.pi * gear.module * math.cos(a)) - pair.contact_ratio))
    assert off[0] < 3e-3
    assert off[2] < off[1] / 2 < off[0] / 4


@pytest.mark.parametrize("number", range(len(PAIRS)))
def test_tips_stay_as_far_above_the_root_of_the_mate_along_the_face(number: int) -> None:
    """In the plane of both axes, the mate's root cone laid beside the tips: c at the outer end, and no less inwards."""
    pair = both_sides(number)
    for gear, mate in (pair.gears, pair.gears[::-1]):
        clearance = mate.dedendum - gear.addendum
        along = np.linspace(0.0, 1.0, 7)
        tips = gear.wall_points("flank", np.array([1.0]), along)[0]
        depth, radius = gear.mounting_distance - tips[:, 2], np.hypot(tips[:, 0], tips[:, 1])
        # the mate's axis stands Sigma off this gear's, its root cone delta_f2 off that, on the side of this gear
        root = gear.shaft_angle - mate.root_angle
        gaps = depth * math.sin(root) - radius * math.cos(root)
        assert gaps == pytest.approx(clearance * math.cos(mate.dedendum_angle), rel=1e-12)
        # and they are ends of flanks
        assert wall_distance(gear, "flank", 1, tips) == pytest.approx(0.0, abs=1e-13)
        apart = replace(gear, tip_to_apex=True)
        inner = apart.inner(apart.inner_tip_angle)
        gap = inner.imag * math.sin(root) - inner.real * math.cos(root)
        least = gaps[0] * gear.inner_distance / gear.cone_distance
        assert gap == pytest.approx(least, rel=1e-9)


@pytest.mark.parametrize("number", range(len(PAIRS)))
def test_distances_of_walls_are_those_of_points_moved_along_normals(number: int) -> None:
    """Surfaces are cones: their normals are those of the curves, at any distance from the apex."""
    gear = both_sides(number).first
    apex = np.array([0.0, 0.0, gear.mounting_distance])
    for name in ("fillet", "flank"):
        for way in (1, -1):
            points = apex + 0.8 * (gear.points(name, SHARE[1:-1]) - apex)
            step = gear.points(name, SHARE[1:-1] + 1e-6) - gear.points(name, SHARE[1:-1] - 1e-6)
            normal = np.cross(points - apex, step)
            normal /= np.linalg.norm(normal, axis=1)[:, None]
            mirror = np.array([1.0, way, 1.0])
            for off in (0.0, 1e-3, -1e-3):
                found = wall_distance(gear, name, way, (points + off * normal) * mirror)
                assert found == pytest.approx(abs(off), abs=2e-8)


def test_places_in_spaces_and_teeth_are_told_apart() -> None:
    gear = both_sides(0).first
    angle = np.array([gear.pitch_angle, gear.pitch_angle, gear.root_angle - 0.01, gear.tip_angle + 0.02])
    azimuth = np.array([0.0, math.pi / gear.number_of_teeth, math.pi / gear.number_of_teeth, 0.0])
    inside, space, root, above = tooth_off(gear, angle, azimuth)
    assert inside < 0 < space
    assert root == pytest.approx(-0.01)
    assert above == pytest.approx(0.02)


@given(
    st.integers(6, 80), st.integers(6, 80), st.floats(40, 140), st.floats(-0.4, 0.4), st.floats(14.5, 25),
)  # fmt: skip
@examples(40)
def test_every_gear_is_made_or_refused_with_a_value_that_works(
    first: int, second: int, angle: float, shift: float, pressure: float
) -> None:
    gear = BevelGear(1.0, first, second, 0.5, Blank(0.2), math.radians(angle), math.radians(pressure),
                     profile_shift_coefficient=shift)  # fmt: skip
    refused = None
    try:
        gear = gear.checked()
    except ParameterError as refusal:
        refused = refusal
    if refused is not None:
        assert refused.nearest is not None
        assert replace(gear, **{refused.name: refused.nearest.value}).checked()
        return
    for name in ("fillet", "flank"):
        angles, azimuths = gear.tooth_places(name, SHARE)
        assert np.all(np.diff(angles) > 0)
        assert np.all(azimuths > 0)
        assert np.all(azimuths < math.pi / first)


@pytest.mark.parametrize(
    ("keys", "code", "kind"),
    [
        ({"tip_radius_coefficient": 0.6}, "bevel_rounding_too_large", ParameterError),
        ({"pressure_angle": math.radians(35)}, "bevel_crown_too_narrow", ParameterError),
        ({"thickness_coefficient": 1.0}, "bevel_crown_pointed", ParameterError),
        ({"circumferential_thinning": 3.3}, "bevel_pointed", PointedTipError),
        ({"addendum_coefficient": 1.9}, "bevel_pointed", PointedTipError),
        ({"profile_shift_coefficient": 1.18}, "bevel_shift_leaves_no_tooth", ParameterError),
        ({"number_of_teeth": 8, "profile_shift_coefficient": 0.9}, "bevel_pointed", PointedTipError),
        ({"number_of_teeth": 5, "profile_shift_coefficient": -0.9}, "no_involute_below_tip", UndercutError),
        ({"circumferential_thinning": 10.0}, "thinning_leaves_no_tip", ParameterError),
        ({"number_of_teeth": 400, "mate_number_of_teeth": 3}, "bevel_too_flat", ParameterError),
        ({"face_width": 60.0}, "bevel_face_to_apex", ParameterError),
        ({"face_width": 44.0}, "bevel_tips_run_out", ParameterError),
        ({"number_of_teeth": 3, "mate_number_of_teeth": 3, "face_width": 1.0}, "bevel_below_crown", UndercutError),
        ({"blank": Blank(40.0)}, "bevel_rim_over_axis", ParameterError),
        ({"blank": Blank(2.0, 60.0, 3.0)}, "bevel_hub_over_rim", ParameterError),
    ],
)
def test_what_cannot_be_is_refused_with_the_nearest_that_can(
    keys: dict[str, object], code: str, kind: type[ParameterError]
) -> None:
    gear = BevelGear(3.0, 16, 30, 12.0, Blank(0.5))
    with pytest.raises(kind) as caught:
        replace(gear, **keys).checked()
    refusal = caught.value
    assert refusal.code == code
    # what nobody has given, an addendum of one module, is not to blame
    assert refusal.name in keys or "pressure_angle" not in keys
    found = refusal.nearest
    assert found is not None
    name, value = refusal.name, found.value
    changed = replace(gear, **keys)
    if hasattr(changed, name):
        assert replace(changed, **{name: value}).checked()
    else:
        assert replace(changed, blank=replace(changed.blank, **{name: value})).checked()


@pytest.mark.parametrize("pair", PAIRS[:3])
def test_a_fillet_beside_another_of_the_same_normals_is_off_by_the_difference_of_their_roundings(
    pair: tuple[int, int, float, float],
) -> None:
    """Parallel on the sphere: cutters with one centre of their rounding; how fast the gear turns by differences."""
    for gear in gears(*pair):
        fillet, u = gear.fillet, np.linspace(0.02, 0.98, 41) * gear.joint[0]
        for more in (-0.3, 0.0, 0.1):
            angle, azimuth = replace(fillet, radius=(1 + more) * fillet.radius).place(u)
            found = fillet_off(gear, angle, math.pi / gear.number_of_teeth - azimuth)
            assert np.abs(found) == pytest.approx(np.full(41, abs(math.sin(more * fillet.radius))), abs=1e-14)
            assert (np.sign(found[np.abs(found) > 1e-14]) == -np.sign(more)).all()
        slope = (fillet.turn(u + 1e-5) - fillet.turn(u - 1e-5)) / 2e-5
        assert fillet.turn_rate(u) == pytest.approx(slope, rel=1e-7)

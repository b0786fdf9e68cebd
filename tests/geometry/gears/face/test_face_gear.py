"""Teeth of face gears against the shaper that sweeps them out, the equation of meshing, and their pinion."""

from __future__ import annotations

import math
import tracemalloc

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.curves.bspline import basis_matrix
from geometry.curves.curve import Real
from geometry.gears.face.faces import faced_face_gear
from geometry.gears.face.gear import FILLET, FLANK, SIDES, FaceGear, Places, form_length, sized
from geometry.gears.face.pair import FacePair
from geometry.gears.face.walls import wall_distance
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.distance import Verdict
from geometry.solids.faces import SplineSurface
from parts.gears.spur_gear.part import basic_rack_of

Case = tuple[float, int, int, float, float, float, float, int]
# module, teeth of pinion and gear, pressure angle, tip rounding of the shaper, thinning, shift of the pinion, and more
# teeth of the shaper
CASES: tuple[Case, ...] = ((2.0, 20, 60, 20.0, 0.2, 0.05, 0.0, 0), (1.0, 12, 36, 20.0, 0.01, 0.0, 0.3, 0),
                           (1.0, 40, 200, 20.0, 0.2, 0.0, 0.0, 0), (1.5, 25, 30, 25.0, 0.1, 0.0, -0.2, 0),
                           (2.0, 20, 60, 20.0, 0.2, 0.05, 0.1, 2))  # fmt: skip


def made(
    m: float, z1: int, z2: int, alpha: float, rounding: float, thinning: float, shift: float = 0.0, more: int = 0
) -> FaceGear:
    shaper = PinionCutter(m, z1, math.radians(alpha), shift, tip_rounding=rounding)
    gear = sized(FaceGear(shaper, z2, m, 0.0, 0.0, 3 * m, thinning), None, None).checked()
    if more:
        middle = (gear.inner_radius + gear.outer_radius) / 2
        gear = sized(replace(gear, more_teeth=more, contact_plane=middle), None, None).checked()
    return gear


def inside(shaper: PinionCutter, y: Real, h: Real) -> Real:
    """How deep places are within the nearest tooth of a shaper, a tooth straight down: less than 0 outside."""
    r, base = np.hypot(y, h), shaper.base_radius
    a, pitch = np.arctan2(y, h), math.tau / shaper.number_of_teeth
    a = np.abs(a - pitch * np.round(a / pitch))
    length = np.sqrt(np.maximum(r * r - base * base, 0.0))
    flank = base * (shaper.base_half_angle - (length / base - np.arctan(length / base)) - a)
    found = np.minimum(flank, shaper.tip_radius - r)
    rounding = shaper.rounding_radius
    corner = (a > shaper.corner_angle) & (length > shaper.form_length - rounding)
    centre = shaper.corner_radius * np.exp(1j * shaper.corner_angle)
    return np.where(corner, np.minimum(found, rounding - np.abs(r * np.exp(1j * a) - centre)), found)


def cut(gear: FaceGear, radius: Real, azimuth: Real, depth: Real, shaper: PinionCutter | None = None) -> Real:
    """How deep its shaper, or another one, gets over places of the gear on its way, mm: by brute force."""
    shaper, turned = shaper or gear.shaper, np.linspace(-1.2, 1.2, 3001)
    a = azimuth[:, None] - math.pi / gear.number_of_teeth + turned * shaper.number_of_teeth / gear.number_of_teeth
    y, h = radius[:, None] * np.sin(a), depth[:, None]
    r, own = np.hypot(y, h), np.arctan2(y, h) - turned
    return np.asarray(inside(shaper, r * np.sin(own), r * np.cos(own)).max(axis=1))


def places(gear: FaceGear, which: int) -> Places:
    share, radius = np.meshgrid(np.linspace(0.0, 1.0, 5), np.linspace(gear.inner_radius, gear.outer_radius, 4))
    return gear.side(which, share.ravel(), radius.ravel())


@pytest.mark.sampled(3)
@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("which", SIDES)
def test_the_shaper_sweeps_up_to_the_side_and_no_deeper(case: Case, which: int) -> None:
    gear = made(*case)
    at, step = places(gear, which), 1e-3
    way = step * at.around / np.abs(at.around)
    for sign in (-1, 1):
        depth = cut(gear, at.radius, at.azimuth + sign * way.real / at.radius, at.depth + sign * way.imag)
        assert depth * sign == pytest.approx(step, abs=5e-5)


@pytest.mark.parametrize("which", SIDES)
def test_normals_stand_across_the_relative_motion_and_the_surface(which: int) -> None:
    """The equation of meshing, and the normal by difference quotients of the surface itself."""
    gear = made(*CASES[0])
    share, radius = np.full(5, 0.4), np.linspace(gear.inner_radius + 0.1, gear.outer_radius - 0.1, 5)

    def spatial(share: Real, radius: Real) -> Real:
        at = gear.side(which, share, radius)
        return np.stack([at.plane.real, at.plane.imag, -at.depth], axis=-1)

    step = 1e-5
    across = (spatial(share + step, radius) - spatial(share - step, radius)) / (2 * step)
    along = (spatial(share, radius + step) - spatial(share, radius - step)) / (2 * step)
    normal = np.cross(across, along)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    at = gear.side(which, share, radius)
    # as it is cut it stands in the section at x, on one side of the shaper or the other
    y = np.sqrt(at.radius**2 - at.x**2)
    found = []
    for way in (-1, 1):
        turn = np.arctan2(way * y, at.x) - at.azimuth
        c, s = np.cos(turn), np.sin(turn)
        fixed = np.stack([c * normal[:, 0] - s * normal[:, 1], s * normal[:, 0] + c * normal[:, 1], normal[:, 2]], -1)
        place = np.stack([at.x, way * y, -at.depth], -1)
        # the shaper turns about x, the gear about z
        gone = np.cross([1.0, 0.0, 0.0], place) - np.cross([0.0, 0.0, gear.rolled], place)
        own = np.stack([0 * at.x, at.normal.real, -at.normal.imag], -1)
        found.append(np.abs(np.sum(fixed * gone, axis=1)) + np.linalg.norm(np.cross(fixed, own), axis=1))
    assert np.min(found, axis=0) == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize("case", CASES)
def test_inside_of_the_undercut_radius_flanks_are_cut_off(case: Case) -> None:
    gear = made(*case)
    for off, deep in ((0.02, False), (-0.02, True)):
        gear = replace(gear, inner_radius=gear.undercut_radius + off * gear.module)
        at = gear.side(FLANK, np.linspace(0.0, 0.03, 13), gear.inner_radius)
        over = cut(gear, at.radius, at.azimuth, at.depth)
        assert (over.max() > 2e-7) == deep


@pytest.mark.parametrize("case", CASES)
def test_beyond_the_pointed_radius_nothing_is_left_of_the_tip(case: Case) -> None:
    gear = made(*case)
    radius = gear.pointed_radius + np.array([-0.01, 0.01]) * gear.module
    over = cut(gear, radius, np.zeros(2), np.full(2, gear.tip_depth))
    assert over[0] < 0 < over[1]


def pair(case: Case, **pinion: float) -> FacePair:
    gear = made(*case)
    rack: BasicRack = basic_rack_of("ISO 53 A", gear.shaper.pressure_angle)
    own = SpurGear(gear.module, case[1], rack, case[6], **pinion)
    gear = sized(gear, None, None, form_length(own))
    return FacePair(gear, own, gear.inner_radius - 1.0, gear.outer_radius + 1.0)


@pytest.mark.sampled(1)
@pytest.mark.parametrize("case", [CASES[0], CASES[3], CASES[4]])
def test_pinion_and_gear_touch_all_over_a_pitch(case: Case) -> None:
    """Conjugate: turned in their ratio they stay together within 1e-8 modules; further round they clash."""
    found = pair(case, circumferential_thinning=0.02)
    play = found.normal_backlash / 2 / found.pinion.base_radius
    assert found.normal_backlash == pytest.approx((case[5] + 0.02) * math.cos(math.radians(case[3])), rel=1e-12)
    for side, way in enumerate((-1, 1)):
        contact = found.contact(way * play)
        assert contact.verdict is Verdict.CONTACT
        assert np.abs(contact.side_gaps[side]).max() < 1e-9 * case[0]
        assert found.contact(way * (play + 1e-5)).verdict is Verdict.OVERLAP
    middle = found.contact()
    assert middle.verdict is Verdict.CLEAR
    assert middle.worst.gap == pytest.approx(found.normal_backlash / 2, rel=2e-3)


def test_crowned_flanks_leave_the_pinion_room_beside_the_plane_of_contact() -> None:
    """The pinion swept over the flanks by brute force, thick enough to drive: it touches them, cuts none, and stays off
    the ends of the face as the pair says; a shaper of its own teeth leaves it no room.
    """
    for case, is_crowned in ((CASES[4], True), ((*CASES[4][:-1], 0), False)):
        found = pair(case)
        gear = found.gear
        pinion = replace(gear.cutter, addendum=1.0, tip_rounding=0.0, widening=case[5] / 2)
        shares, radii = np.meshgrid(np.linspace(0, 1, 33), np.linspace(gear.inner_radius, gear.outer_radius, 9))
        at = gear.side(FLANK, shares.ravel(), radii.ravel())
        # the pinion's axis lies so much lower as its root clearance is the usual one
        lower = gear.shaper.tip_radius - (pinion.tip_radius + 0.25 * case[0])
        gap = -cut(gear, at.radius, at.azimuth, at.depth - lower, pinion).reshape(radii.shape).max(axis=1)
        assert gap.min() == pytest.approx(0.0, abs=3e-6)
        assert gap.max() == pytest.approx(found.end_gap, abs=5e-5)
        assert (gap.max() > 1e-3) == is_crowned


def test_a_pinion_of_another_pressure_angle_clashes() -> None:
    found = pair(CASES[2])
    other = replace(found.pinion, rack=basic_rack_of("ISO 53 A", math.radians(20.2)))
    assert pair(CASES[2]).contact().verdict is Verdict.CONTACT
    assert replace(found, pinion=other).contact().verdict is Verdict.OVERLAP


def test_splines_follow_the_sides_and_points_off_them_are_measured() -> None:
    gear = made(*CASES[0])
    rng = np.random.default_rng(2)
    share, radius = rng.uniform(0, 1, 300), rng.uniform(gear.inner_radius, gear.outer_radius, 300)
    for which in SIDES:
        at = gear.side(which, share, radius)
        points = np.stack([at.plane.real, at.plane.imag, gear.mounting_distance - at.depth], axis=-1)
        points[:, 1] *= rng.choice([-1, 1], 300)
        assert wall_distance(gear, which, points).max() < 1e-12
        near = wall_distance(gear, which, points + np.array([0.0, 0.0, 1e-4]))
        # sideways of a step upwards: the share of the normal along the axis
        assert near == pytest.approx(1e-4 * np.abs(at.normal.imag), abs=2e-7)
    for tolerance in (1e-6, 1e-7):
        found = faced_face_gear(gear).within(tolerance)
        assert found.max_error < tolerance
        for surface in (faces.surface for faces in found.geometry.faces if isinstance(faces.surface, SplineSurface)):
            u, v = rng.uniform(0, 1, 40), np.concatenate([[0.0, 1.0], rng.uniform(0, 1, 20)])
            rows, columns = map(basis_matrix, surface.degrees, (surface.u_knots, surface.v_knots), (u, v))
            points = np.einsum("iu,uvc,jv->ijc", rows, found.geometry.points[surface.poles[3]], columns)
            off = [wall_distance(gear, which, points.reshape(-1, 3)) for which in SIDES]
            assert np.min(off, axis=0).max() < found.max_error
            # kernels join them to the cylinders of both ends within 1e-7 mm
            ends = np.hypot(points[:, :2, 0], points[:, :2, 1]) - (gear.outer_radius, gear.inner_radius)
            assert np.abs(ends).max() < 3e-8


def test_many_places_are_measured_in_little_memory() -> None:
    """A STEP of a low face gear has a million of them, which took 0.9 GB and waited for the slowest, all together."""
    gear, count = made(*CASES[0]), 50_000
    share, radius = np.linspace(0.05, 0.95, count), np.full(count, (gear.inner_radius + gear.outer_radius) / 2)
    at = gear.side(FILLET, share, radius)
    points = np.stack([at.plane.real, at.plane.imag, gear.mounting_distance - at.depth], axis=-1)
    tracemalloc.start()
    try:
        off = wall_distance(gear, FILLET, points)
        most = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert off.max() < 1e-12
    assert most < 200 * count


def test_the_told_error_of_splines_is_that_of_their_end_spans_too() -> None:
    # few spans on a long fillet: these were off most between the samples beside the root
    gear = made(0.05, 12, 400, 20.0, 0.2, 0.0)
    found = faced_face_gear(gear).within(1e-6)
    sides = [faces.surface for faces in found.geometry.faces if isinstance(faces.surface, SplineSurface)]
    worst = []
    for surface in sides:
        ends = np.concatenate([near := np.geomspace(1e-3, 0.1, 40), 1 - near])
        rows, columns = map(basis_matrix, surface.degrees, (surface.u_knots, surface.v_knots), (ends, ends))
        points = np.einsum("iu,uvc,jv->ijc", rows, found.geometry.points[surface.poles[3]], columns)
        worst.append(np.min([wall_distance(gear, which, points.reshape(-1, 3)) for which in SIDES], axis=0).max())
    assert 1e-7 < max(worst) < found.max_error / 1.3


def test_the_volume_is_that_of_the_plate_and_of_teeth_sliced_on_cylinders() -> None:
    gear = made(*CASES[1])
    nodes, weights = np.polynomial.legendre.leggauss(24)
    radii = (gear.inner_radius + gear.outer_radius) / 2 + gear.face_width / 2 * nodes
    teeth = 0.0
    for radius, weight in zip(radii, weights, strict=True):
        chain = [gear.side(which, np.linspace(0.0, 1.0, 4001), radius) for which in SIDES]
        azimuth, depth = (np.concatenate([getattr(at, name) for at in chain]) for name in ("azimuth", "depth"))
        height = gear.mounting_distance - gear.thickness - depth
        area = 2 * radius * (np.sum((azimuth[1:] + azimuth[:-1]) / 2 * np.diff(height)))
        teeth += gear.number_of_teeth * area * weight * gear.face_width / 2
    plate = math.pi * gear.outer_radius**2 * gear.thickness
    assert faced_face_gear(gear).moments.volume == pytest.approx(plate + teeth, rel=1e-7)


@pytest.mark.parametrize(
    ("inner", "outer", "key", "code"),
    [(57.0, 65.0, "inner_diameter", "face_gear_below_base"), (60.0, 70.0, "outer_diameter", "face_gear_pointed"),
     (69.1, 70.0, "inner_diameter", "face_gear_pointed_inside"), (62.0, 61.0, "outer_diameter", "face_gear_narrow")],
)  # fmt: skip
def test_what_has_no_teeth_is_refused_with_what_has(inner: float, outer: float, key: str, code: str) -> None:
    gear = replace(made(*CASES[0]), inner_radius=inner, outer_radius=outer)
    with pytest.raises(ParameterError) as refusal:
        gear.checked()
    assert (refusal.value.name, refusal.value.code) == (key, code)
    assert refusal.value.nearest is not None
    value = refusal.value.nearest.value
    assert isinstance(value, float)
    name = key.replace("diameter", "radius")
    changed = replace(gear, **{name: value / 2})
    if code == "face_gear_pointed_inside":
        changed = replace(changed, outer_radius=changed.inner_radius + 0.1)
    if code == "face_gear_below_base":
        assert changed.checked().inner_radius == pytest.approx(gear.form_radius(0.0), abs=1e-3)
    changed.checked()


def test_fillets_are_those_of_the_tip_edge_where_it_is_sharp() -> None:
    """Every place of them lies on the path of the shaper's corner."""
    gear = made(2.0, 20, 60, 20.0, 0.0, 0.0)
    at = places(gear, FILLET)
    turned = np.linspace(-0.6, 0.6, 240001)
    corner = gear.shaper.corner_radius * np.exp(1j * (turned - gear.shaper.corner_angle))
    for radius, azimuth, depth in zip(at.radius, at.azimuth, at.depth, strict=True):
        y, h = corner.imag, corner.real
        turn = np.arcsin(y / radius) - gear.rolled * turned + math.pi / gear.number_of_teeth
        assert np.hypot(radius * (turn - azimuth), h - depth).min() < 2e-5

"""Worm flanks by what defines each form, wheels by brute-force hobbing, and the numbers of the thesis's drives."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.worms.drive import WormDrive
from geometry.gears.worms.flank import FORMS
from geometry.gears.worms.worm import Worm
from tests.sampling import examples

THESIS = WormDrive(Worm(5.0, 1, 10.0), 128)
RADII = np.linspace(19.0, 30.0, 23)


@st.composite
def worms(draw: st.DrawFn) -> Worm:
    """Worms of every form whose threads are not pointed."""
    starts = draw(st.integers(1, 6))
    quotient = draw(st.floats(max(6.0, 1.5 * starts), 30.0))
    worm = Worm(
        draw(st.floats(0.5, 10.0)),
        starts,
        quotient,
        draw(st.sampled_from(sorted(FORMS))),
        math.radians(draw(st.floats(14.0, 25.0))),
        draw(st.sampled_from(["right", "left"])),
        thinning=draw(st.floats(0.0, 0.1)),
    )
    return worm.checked()


@given(worms())
@examples(60)
def test_drop_is_zero_on_the_reference_and_slope_is_its_derivative(worm: Worm) -> None:
    flank, step = worm.flank, 1e-5 * worm.module
    radius = np.linspace(max(worm.form_radius * 1.01, worm.root_radius), worm.tip_radius, 7)
    assert abs(float(flank.drop(worm.reference_radius))) < 1e-12 * worm.module
    by_difference = (flank.drop(radius + step) - flank.drop(radius - step)) / (2 * step)
    assert flank.slope(radius) == pytest.approx(by_difference, rel=1e-6, abs=1e-7)


def test_za_is_straight_in_the_axial_section_and_its_wheel_an_involute_gear() -> None:
    worm = Worm(5.0, 2, 9.0, "ZA", math.radians(20))
    drive = WormDrive(worm, 40, 0.3)
    radius = np.linspace(worm.root_radius, worm.tip_radius, 30)
    assert worm.axial_pressure_angle == pytest.approx(math.radians(20), abs=1e-14)
    point, _ = drive.section(radius)
    base = drive.reference_radius * math.cos(math.radians(20))
    roll = np.sqrt((np.abs(point) / base) ** 2 - 1)
    turned = np.angle(-point) + (roll - np.arctan(roll))
    assert np.ptp(turned) < 1e-12


@pytest.mark.parametrize("starts", [1, 4])
def test_zi_is_an_involute_helical_gear(starts: int) -> None:
    worm = Worm(5.0, starts, 10.0)
    gamma = math.atan(starts / 10.0)
    base = starts * 5.0 / 2 / math.tan(math.acos(math.cos(math.radians(20)) * math.cos(gamma)))
    radius = np.linspace(base * 1.0001, worm.tip_radius, 40)
    roll = np.sqrt((radius / base) ** 2 - 1)
    # from the base circle on, a taut thread unwinds
    involute = base * (1 - 1j * roll) * np.exp(1j * roll)
    half = worm.half_thickness(radius) / worm.parameter
    assert np.ptp(half + np.angle(involute)) < 1e-12
    assert np.abs(involute) == pytest.approx(radius, rel=1e-14)


@pytest.mark.parametrize("form", ["ZN1", "ZN2"])
def test_zn_is_straight_in_the_normal_plane_of_thread_or_space(form: str) -> None:
    worm = Worm(5.0, 3, 9.0, form)
    gamma, p = worm.lead_angle, worm.parameter
    middle = 0.0 if form == "ZN1" else worm.screw.half_thickness + worm.screw.half_space
    found = []
    for radius in np.linspace(worm.root_radius, worm.tip_radius, 9):
        # where the helix of that radius on the upper flank pierces the plane through the middle
        start = float(worm.half_thickness(radius)) - middle
        low, high = -1.5, 1.5

        def beyond(turn: float, r: float = radius, z: float = start) -> float:
            return r * math.sin(turn) * math.cos(gamma) + (z + p * turn) * math.sin(gamma)

        for _ in range(80):
            mid = (low + high) / 2
            low, high = (low, mid) if beyond(low) * beyond(mid) <= 0 else (mid, high)
        y, z = radius * math.sin(low), start + p * low
        found.append((radius * math.cos(low), z * math.cos(gamma) - y * math.sin(gamma)))
    x, across = np.array(found).T
    lean = np.diff(across) / np.diff(x)
    assert np.ptp(lean) < 1e-11
    assert lean[0] == pytest.approx(-math.tan(math.radians(20)), abs=1e-11)


def test_zk1_is_what_a_conical_wheel_leaves() -> None:
    worm = Worm(5.0, 4, 10.0, "ZK1", wheel_diameter=120.0)
    gamma, p, mean = worm.lead_angle, worm.parameter, 60.0
    lean, centre = math.tan(math.radians(20)), worm.reference_radius + 60.0
    distance, phi = np.meshgrid(np.linspace(mean - 7, mean + 7, 1201), np.linspace(-0.4, 0.4, 1201))
    width = worm.flank.half_width() + (mean - distance) * lean
    x = centre - distance * np.cos(phi)
    y = distance * np.sin(phi) * math.cos(gamma) - width * math.sin(gamma)
    z = distance * np.sin(phi) * math.sin(gamma) + width * math.cos(gamma)
    radius, half = np.hypot(x, y), z - p * np.arctan2(y, x)
    for r in (19.5, 22.0, 25.0, 29.0):
        ring = np.abs(radius - r) < 0.006
        swept = half[ring].max()
        expected = worm.screw.half_space + float(worm.flank.drop(r))
        assert swept == pytest.approx(expected, abs=0.006)
        assert swept <= expected + 0.006 * float(worm.flank.slope(r)) + 1e-9


def test_zk1_of_a_huge_wheel_is_zi() -> None:
    ground, involute = (Worm(5.0, 2, 10.0, form, wheel_diameter=1e8) for form in ("ZK1", "ZI"))
    assert ground.flank.drop(RADII) == pytest.approx(involute.flank.drop(RADII), abs=1e-6)


def test_the_thesis_drive_on_exact_surfaces() -> None:
    assert math.degrees(THESIS.worm.axial_pressure_angle) == pytest.approx(20.0918, abs=5e-5)
    assert 2 * THESIS.worm.flank.least_radius == pytest.approx(13.185358988164113, rel=1e-12)
    assert THESIS.tip_radius_at(13.0) == pytest.approx(329.80, abs=5e-3)
    assert _tooth(THESIS, 325.0, 0.0) == pytest.approx(4.087, abs=5e-4)
    assert _tooth(THESIS, 329.80, 13.0) == pytest.approx(3.351, abs=5e-4)
    corners = sorted(abs(THESIS.tip_contact(13.0, upper=u) or 0.0) for u in (True, False))
    assert corners == pytest.approx([24.9, 35.99], abs=0.02)
    assert THESIS.worm_length_used(26.0) == pytest.approx(72.0, abs=0.05)


def _tooth(drive: WormDrive, radius: float, distance: float) -> float:
    """Thickness of the wheel's tooth along an arc, mm."""
    worm = drive.worm
    r = np.linspace(max(worm.form_radius, distance * 1.0001), worm.tip_radius, 100_001)
    angles = []
    for upper in (True, False):
        point, _ = drive.section(r, distance, upper=upper)
        angles.append(np.interp(-radius, -np.abs(point), np.angle(-point)))
    space = abs(angles[1] - angles[0])
    return radius * (2 * math.pi / drive.number_of_teeth - space)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("form", sorted(FORMS))
@pytest.mark.parametrize("distance", [-9.0, 0.0, 9.0])
def test_the_wheel_touches_its_worm_and_nothing_more(form: str, distance: float) -> None:
    drive = WormDrive(Worm(5.0, 2, 10.0, form, hand="left"), 40, 0.2)
    worm, pitch = drive.worm, drive.reference_radius
    r = np.linspace(worm.root_radius + 1.2, worm.tip_radius, 6)
    # the worm's own section, finely, and where it slides
    radii = np.linspace(worm.root_radius, worm.tip_radius, 4001)
    x = np.sqrt(radii**2 - distance**2) - drive.centre_distance
    z = worm.axial(radii, distance)[0]
    for flank, slid in zip(*drive.section(r, distance), strict=True):
        gaps = []
        for way in slid + np.linspace(-3.0, 3.0, 601):
            # the wheel's point in the plane of the section, the wheel turned along with the sliding worm
            there = flank * np.exp(-1j * way / pitch)
            gaps.append(there.imag - np.interp(there.real, x, z + way, left=-np.inf, right=-np.inf))
        assert min(gaps) == pytest.approx(0.0, abs=1e-6)
        moved = (flank - 1e-4j) * np.exp(-1j * slid / pitch)
        assert moved.imag - np.interp(moved.real, x, z + slid) < -5e-5


@pytest.mark.parametrize(
    ("worm", "key"),
    [
        (Worm(5.0, 1, 2.0), "diameter_quotient"),
        (replace(THESIS.worm, addendum_coefficient=3.0), "addendum_coefficient"),
    ],
)
def test_worms_that_cannot_exist_are_refused_with_what_works(worm: Worm, key: str) -> None:
    with pytest.raises(ParameterError) as caught:
        worm.checked()
    assert caught.value.name == key
    offered = caught.value.nearest
    assert offered is not None
    replace(worm, **{key: offered.value}).checked()


def test_a_flank_that_begins_above_the_root_has_its_corners() -> None:
    drive = WormDrive(Worm(5.0, 4, 8.0), 40)
    assert drive.worm.form_radius > drive.worm.root_radius + 1
    radii = np.linspace(drive.worm.form_radius, drive.worm.tip_radius, 50_002)[1:]
    farthest = 0.0
    for distance in (-10.0, 0.0, 10.0):
        for upper in (True, False):
            points, slid = drive.section(radii, distance, upper=upper)
            along = drive.worm.axial(radii, distance)[0 if upper else 1] + slid
            nearest = np.abs(np.abs(points) - drive.tip_radius_at(distance)).argmin()
            farthest = max(farthest, abs(along[nearest]))
    assert drive.worm_length_used(20.0) == pytest.approx(2 * farthest, abs=1e-2)


@pytest.mark.parametrize("starts", [1, 2, 4])
@pytest.mark.parametrize("teeth", [30, 80])
def test_lengths_and_widths_are_those_of_gost_19650(starts: int, teeth: int) -> None:
    """Least length of the thread by shift and starts, row by row of its table; between two rows the longer one."""
    rows = {-1.0: 10.5 + starts, -0.5: 8 + 0.06 * teeth, 0.0: 11 + 0.06 * teeth, 0.5: 11 + 0.1 * teeth,
            1.0: 12 + 0.1 * teeth}  # fmt: skip
    if starts > 2:
        rows = {-1.0: 10.5 + starts, -0.5: 9.5 + 0.09 * teeth, 0.0: 12.5 + 0.09 * teeth, 0.5: 12.5 + 0.1 * teeth,
                1.0: 13 + 0.1 * teeth}  # fmt: skip
    worm = Worm(2.0, starts, 10.0)
    for shift, length in rows.items():
        assert WormDrive(worm, teeth, shift).least_worm_length == pytest.approx(2 * length, rel=1e-12)
    for low, high in ((-1.0, -0.5), (-0.5, 0.0), (0.0, 0.5), (0.5, 1.0)):
        for shift in (0.9 * low + 0.1 * high, 0.1 * low + 0.9 * high):
            assert WormDrive(worm, teeth, shift).least_worm_length == pytest.approx(2 * max(rows[low], rows[high]))
    # beyond the table its ends
    assert WormDrive(worm, teeth, -1.4).least_worm_length == pytest.approx(2 * rows[-1.0])
    assert WormDrive(worm, teeth, 1.4).least_worm_length == pytest.approx(2 * rows[1.0])
    drive = WormDrive(worm, teeth, 0.3)
    number, of_starts, of_teeth = drive.least_worm_length_terms
    assert 2 * (number + of_starts * starts + of_teeth * teeth) == pytest.approx(drive.least_worm_length)
    assert drive.most_face_width == pytest.approx(0.75 * 24 if starts <= 3 else 0.67 * 24)
    # d_ae2 <= d_a2 + 6 m / (z_1 + 2)
    assert drive.most_outer_diameter == pytest.approx(2 * teeth + 2 * 2 * 1.3 + 12 / (starts + 2))


def test_sizes_of_a_drive_by_hand() -> None:
    """m 2, q 10, z 3 / 40, x 0.3: a_w = (40 + 10 + 0.6), the throat and an outside that reaches it."""
    drive = WormDrive(Worm(2.0, 3, 10.0), 40, 0.3)
    assert drive.ratio == pytest.approx(40 / 3)
    assert (drive.reference_radius, drive.centre_distance) == pytest.approx((40.0, 50.6))
    assert drive.pitch_radius_of_worm == pytest.approx(10.6)
    assert math.tan(drive.pitch_lead_angle) == pytest.approx(3 / 10.6)
    assert drive.tip_radius == pytest.approx(42.6)
    assert drive.root_radius == pytest.approx(40 - 2 * (1 + drive.worm.tip_clearance_coefficient - 0.3))
    assert drive.throat_radius == pytest.approx(8.0)
    # a throat round a third of the worm: 2 a_w - r_throat
    assert drive.default_outer_diameter == pytest.approx(min(85.2 + 12 / 5, 101.2 - 8.0))
    slim = WormDrive(Worm(2.0, 1, 8.0), 40)
    assert slim.default_outer_diameter == pytest.approx(min(84 + 4, 96 - 6))
    thick = WormDrive(Worm(2.0, 1, 5.0), 40)
    assert thick.throat_radius == pytest.approx(3.0)
    assert thick.default_outer_diameter == pytest.approx(min(84 + 4, 90 - 3))
    for distance in (0.0, 5.0, -5.0):
        assert drive.tip_radius_at(distance) == pytest.approx(50.6 - math.sqrt(64 - distance**2))
    assert drive.tip_radius_at(8.0) == math.inf == drive.tip_radius_at(-9.0)

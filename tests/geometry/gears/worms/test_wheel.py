"""Teeth of worm wheels against worms and hobs that are turned past them step by step."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.worms.contact import clearing_thinning, worm_contact
from geometry.gears.worms.drive import WormDrive
from geometry.gears.worms.hob import Hob, oversized_hob
from geometry.gears.worms.thread import thread_of
from geometry.gears.worms.wheel import WormTeeth
from geometry.gears.worms.worm import Worm
from geometry.plane.distance import Verdict

Real = NDArray[np.float64]
THESIS = WormDrive(Worm(5.0, 1, 10.0), 128)


def _own_hob(drive: WormDrive, rounding: float) -> Hob:
    return oversized_hob(drive, rounding, drive.worm.diameter_quotient)


def _teeth(drive: WormDrive, width: float, outer: float | None = None, rounding: float = 0.2) -> WormTeeth:
    radius = drive.most_outer_diameter / 2 if outer is None else outer
    return WormTeeth(_own_hob(drive, rounding).checked(), drive.centre_distance, drive.throat_radius, radius, width)


def _standing(teeth: WormTeeth) -> WormTeeth:
    assert teeth.ended is None
    return teeth


def _gap(hob: Hob, plane: NDArray[np.complex128], height: Real, slid: Real) -> Real:
    """Axial distance of points of the lower side of tooth 1 from the hob's lower flank where it has slid so far."""
    teeth, worm = hob.number_of_teeth, hob.worm
    # the space beside tooth 1 faces the hob, and the wheel turns by one tooth for each thread
    turned = plane * np.exp(1j * math.pi / teeth) * np.exp(-1j * worm.number_of_starts * slid / worm.parameter / teeth)
    x, y, z = hob.centre_distance - turned.real, -height, -turned.imag
    sine, cosine = math.sin(hob.swivel), math.cos(hob.swivel)
    y, z = y * cosine + z * sine, z * cosine - y * sine
    thread = worm.sign * worm.parameter * np.arctan2(y, x) + slid
    return thread - worm.half_thickness(np.hypot(x, y)) - z


@pytest.mark.parametrize(("form", "near"), [("ZI", 1e-9), ("ZA", 1e-9), ("ZN1", 1e-9), ("ZN2", 1e-9), ("ZK1", 1e-6)])
def test_every_point_of_a_flank_touches_the_worm_once_and_stays_out_of_it(form: str, near: float) -> None:
    drive = WormDrive(replace(THESIS.worm, form=form), 128)
    teeth = _teeth(drive, 26.0)
    side = teeth.side(np.linspace(-13.0, 13.0, 14))
    cut = teeth.flank(side, np.linspace(0.0, 1.0, 41)[:, None])
    assert float(np.abs(cut.slid).max()) < 60.0
    far = np.concatenate([_gap(teeth.hob, cut.plane, side.heights, np.full((), s))[None] for s in range(-60, 61, 5)])
    assert float(far.min()) > -near
    close = np.stack([_gap(teeth.hob, cut.plane, side.heights, cut.slid + d) for d in (-0.03, -0.01, 0.0, 0.01, 0.03)])
    assert close.min(axis=0) == pytest.approx(0.0, abs=near)
    # pushed in and pulled off
    out = 1e-4 * cut.normal
    assert float(_gap(teeth.hob, cut.plane + out, side.heights, cut.slid).max()) < -5e-5
    assert (
        float(np.stack([_gap(teeth.hob, cut.plane - out, side.heights, cut.slid + d) for d in (-0.1, 0, 0.1)]).min())
        > 5e-5
    )


def _hobbed(hob: Hob, radius: float, height: float, near: float) -> float:
    """Angle of the wheel's lower side at a radius and height as the turning hob leaves it, near one, by bisection."""
    slid = np.linspace(-45.0, 45.0, 4001)
    low, high = near - 2e-3, near + 2e-3
    for _ in range(40):
        middle = (low + high) / 2
        gap = _gap(hob, np.full(slid.shape, radius * np.exp(1j * middle)), np.full(slid.shape, height), slid)
        # between the steps the gap is a parabola
        k = int(np.clip(gap.argmin(), 1, len(gap) - 2))
        bend = gap[k - 1] - 2 * gap[k] + gap[k + 1]
        least = gap[k] - (gap[k + 1] - gap[k - 1]) ** 2 / (8 * bend)
        low, high = (middle, high) if least < 0 else (low, middle)
    return low


@pytest.mark.sampled(1)
@pytest.mark.parametrize("hand", ["right", "left"])
def test_an_oversized_hob_leaves_the_crown_of_brute_force_hobbing(hand: str) -> None:
    drive = replace(THESIS, worm=replace(THESIS.worm, hand=hand))
    hob = oversized_hob(drive, 0.2, 10.5)
    assert 2 * hob.worm.reference_radius == pytest.approx(52.48, abs=5e-3)
    assert abs(math.degrees(hob.swivel)) == pytest.approx(0.270, abs=5e-4)
    crowns = {}
    for height in (-12.0, 0.0, 12.0):
        own = _crown(drive, hob, height)
        radius, crown, angles = own
        for r, angle in list(zip(radius, angles, strict=True))[::4]:
            assert r * abs(_hobbed(hob, r, height, angle) - angle) < 1e-6
        crowns[height] = crown
    assert float(np.abs(crowns[0.0]).max()) < 1e-3
    up = 12.0 if hand == "right" else -12.0
    assert crowns[up][[0, -1]] * 1e3 == pytest.approx([47, 70], abs=1.0)
    assert crowns[-up][[0, -1]] * 1e3 == pytest.approx([24.5, 63], abs=1.0)
    wrong = replace(hob, swivel=-hob.swivel)
    assert _crown(drive, wrong, up)[1][-1] * 1e3 == pytest.approx(-58, abs=1.0)
    assert _crown(drive, wrong, -up)[1][-1] * 1e3 == pytest.approx(244, abs=1.0)


def _deepest(drive: WormDrive, teeth: WormTeeth, heights: Real) -> float:
    """How deep lower sides run into the worm, along its axis, mm: places about each one's contact with the hob."""
    worm, cut = drive.worm, teeth.flank(teeth.side(heights), np.linspace(0.0, 1.0, 21)[:, None])
    deep = 0.0
    for slid in (cut.slid + step * worm.module for step in np.linspace(-0.6, 0.6, 121)):
        turn = math.pi / drive.number_of_teeth - worm.number_of_starts * slid / worm.parameter / drive.number_of_teeth
        reach = np.hypot(drive.centre_distance - (cut.plane * np.exp(1j * turn)).real, heights)
        gap = _gap(_own_hob(drive, 0.2), cut.plane, heights, slid)
        deep = max(deep, -float(gap[reach < worm.tip_radius].min(initial=0.0)))
    return deep


@pytest.mark.parametrize(("form", "most"), [("ZA", 0.013), ("ZN1", 0.022), ("ZN2", 0.016), ("ZI", 1e-9)])
def test_a_larger_hob_of_any_form_leaves_the_mid_plane_as_the_worm_has_it_there(form: str, most: float) -> None:
    # straight flanks of another lead are bent otherwise, by so much at half a module from the pitch point; of another
    # angle too, before: 0.034 and 0.027 mm of ZN1 and ZN2
    drive = WormDrive(Worm(5.0, 2, 10.0, form), 40)
    teeth = WormTeeth(oversized_hob(drive, 0.2, 12.0), drive.centre_distance, drive.throat_radius, 106.0, 20.0)
    assert _deepest(drive, teeth, np.array([0.0])) < most


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("worm", "teeth", "hob"), [(Worm(2.0, 1, 10.0, "ZA"), 30, 10.5), (Worm(3.15, 3, 9.0), 41, 9.3)]
)
def test_thicker_threads_of_a_larger_hob_clear_what_runs_into_the_worm(worm: Worm, teeth: int, hob: float) -> None:
    drive = WormDrive(worm, teeth)
    sizes = drive.centre_distance, drive.throat_radius, drive.tip_radius, drive.most_face_width
    made = WormTeeth(oversized_hob(drive, 0.2, hob), *sizes).narrowed()
    found, heights = clearing_thinning(thread_of(worm), made), np.linspace(-made.width / 2, made.width / 2, 41)
    assert found is not None
    assert _deepest(drive, made, heights) > 0.9 * found[0]
    thicker = replace(made.hob, worm=replace(made.hob.worm, thinning=-found[1]))
    assert _deepest(drive, replace(made, hob=thicker), heights) == 0.0
    less = replace(made.hob, worm=replace(made.hob.worm, thinning=-0.8 * found[1]))
    assert _deepest(drive, replace(made, hob=less), heights) > 0.0
    # what the worm itself cuts is clear
    plain = replace(made, hob=_own_hob(drive, 0.2))
    assert clearing_thinning(thread_of(worm), plain) is None


def _crown(drive: WormDrive, hob: Hob, height: float) -> tuple[Real, Real, Real]:
    """Radii, how far the hob cuts deeper than the worm along the normal of the rack, mm, and the angles it leaves."""
    radius, angles = np.linspace(317.5, 328.0 if height else 325.0, 9), []
    for tool in (_own_hob(drive, 0.2), hob):
        r = np.linspace(tool.form_radius, 20.0, 20_001)
        cut = tool.cut(tool.flank(r), height)
        angles.append(np.interp(radius, np.abs(cut.plane), np.angle(cut.plane)))
    return radius, radius * (angles[1] - angles[0]) * math.cos(math.radians(20)), angles[1]


def test_the_thesis_wheel_has_the_teeth_of_the_probe() -> None:
    teeth = _standing(_teeth(THESIS, 26.0))
    heights = np.array([-13.0, 0.0, 13.0])
    assert teeth.tip_radius(heights) == pytest.approx([329.80, 325.0, 329.80], abs=5e-3)
    thickness = teeth.thickness(heights) * teeth.tip_radius(heights)
    assert thickness == pytest.approx([3.351, 4.087, 3.351], abs=1e-3)
    assert not teeth.undercut_ends
    assert teeth.breaks == (-13.0, 13.0)


def test_steep_worms_have_wheels_up_to_where_teeth_end() -> None:
    whole = _standing(_teeth(WormDrive(Worm(1.5, 2, 10.0), 40), 0.75 * 18.0, 65.25 / 2, 0.1))
    assert whole.is_whole()
    assert len(whole.breaks) == 4
    drive = WormDrive(Worm(5.0, 4, 8.0), 40)
    _standing(_teeth(drive, 16.0))
    wide = _teeth(drive, 50.0)
    assert wide.ended is not None
    # the rim stands within what the hob cuts up to where its tip meets the outer cylinder
    out = drive.centre_distance - drive.most_outer_diameter / 2
    reach = math.sqrt((drive.centre_distance - drive.root_radius) ** 2 - out**2)
    widest = wide.widest(WormTeeth.stands)
    assert widest is not None
    assert 1.9 * reach < _standing(widest).width < 2 * reach


@pytest.mark.parametrize(("quotient", "starts", "teeth", "width"), [(6.0, 1, 20, 12.0), (20.0, 1, 30, 29.7)])
def test_wide_faces_end_in_a_ridge_or_without_a_flank(quotient: float, starts: int, teeth: int, width: float) -> None:
    wide = _standing(_teeth(WormDrive(Worm(2.0, starts, quotient), teeth), width))
    heights = np.linspace(-width / 2, width / 2, 25)
    lower, upper = wide.side(heights), wide.side(-heights)
    ends = wide.flank(lower, 1.0).plane, np.conj(wide.flank(upper, 1.0).plane)
    pointed = np.array([any(low < z < high for low, high in wide.ridges) for z in heights])
    assert pointed.any() == (quotient == 6.0)
    assert lower.all_fillet.any() == (quotient == 20.0)
    # a ridge lies on both sides and below the tip, a tip on its circle
    assert np.abs(ends[0] - ends[1])[pointed] == pytest.approx(0.0, abs=1e-9)
    assert (np.abs(ends[0]) < wide.tip_radius(heights) - 1e-6)[pointed].all()
    assert np.abs(ends[0])[~pointed] == pytest.approx(wide.tip_radius(heights)[~pointed], abs=1e-9)
    assert wide.thickness(heights)[~pointed].min() > 1e-3


def test_undercut_teeth_end_where_fillet_and_flank_cross() -> None:
    drive = WormDrive(Worm(2.0, 1, 10.0), 12)
    teeth = _teeth(drive, 10.0)
    side = teeth.side(np.array([-4.0, -2.0, 0.0]))
    assert side.undercut.all()
    (end,) = teeth.undercut_ends
    assert teeth.side([end - 1e-6, end + 1e-6]).undercut.tolist() == [True, False]
    assert _standing(teeth).ridges[1] == pytest.approx((4.556, 5.0), abs=1e-3)
    ends = teeth.flank(side, 0.0).plane, teeth.fillet(side, 1.0).plane
    assert np.abs(ends[0] - ends[1]).max() < 1e-10
    hob = teeth.hob
    for share in (0.0, 0.5, 1.0):
        cut = teeth.flank(side, share)
        near = np.stack([_gap(hob, cut.plane, side.heights, cut.slid + d) for d in (-0.02, 0.0, 0.02)])
        assert near.min(axis=0) == pytest.approx(0.0, abs=1e-9)
    # above the crossing no tip of the hob cuts the flank
    fillet = teeth.fillet(side, np.linspace(0.0, 1.0, 9)[:, None]).plane
    assert (np.diff(np.abs(fillet), axis=0) > 0).all()


def test_a_rounding_that_leaves_no_land_is_refused_with_the_largest() -> None:
    with pytest.raises(ParameterError) as caught:
        _own_hob(THESIS, 1.2).checked()
    assert caught.value.name == "hob_rounding_coefficient"
    cure = caught.value.nearest
    assert cure is not None
    assert isinstance(cure.value, float)
    _own_hob(THESIS, cure.value).checked()


@pytest.mark.parametrize("hob", [10.0, pytest.param(10.5, marks=pytest.mark.heavy)])
def test_a_worm_pushed_in_overlaps_and_one_pulled_off_does_not_touch(hob: float) -> None:
    teeth = _standing(WormTeeth(oversized_hob(THESIS, 0.2, hob), 345.0, THESIS.throat_radius, 330.0, 26.0))
    verdicts = {off: worm_contact(THESIS.worm, teeth, 0.0, off, None) for off in (-1e-4, 0.0, 1e-4)}
    assert verdicts[-1e-4].verdict is Verdict.OVERLAP
    assert verdicts[-1e-4].worst.gap == pytest.approx(-1e-4 * math.sin(math.radians(20)), rel=0.5)
    assert verdicts[1e-4].verdict is Verdict.CLEAR
    if hob == 10.0:
        assert verdicts[0.0].verdict is Verdict.CONTACT
        assert -1e-9 < verdicts[0.0].worst.gap <= verdicts[0.0].greatest_gap < 1e-9
    # turned out of the middle it runs into one side: on both it is the same place, over the line of centres and under
    one, other = (worm_contact(THESIS.worm, teeth, turn, 0.0, None) for turn in (1e-3, -1e-3))
    assert one.verdict is other.verdict is Verdict.OVERLAP
    assert one.worst.point.imag * other.worst.point.imag < 0
    assert one.worst.point.conjugate() == pytest.approx(other.worst.point, abs=1e-6)
    # and within the worm, which stands along +x
    assert abs(345.0 - one.worst.point.real) < THESIS.worm.tip_radius
    assert abs(one.worst.point.imag) < 40.0
    thin = replace(THESIS.worm, thinning=0.1)
    assert worm_contact(thin, teeth, 1e-3, 0.0, None).verdict is Verdict.CLEAR


def test_a_fillet_cuts_a_flank_from_where_undercut_begins_and_not_a_step_later() -> None:
    drive = WormDrive(Worm(10.0, 2, 23.51), 14)
    teeth = _teeth(drive, 60.0)
    (_, end) = teeth.undercut_ends
    side = teeth.side(end - np.linspace(0.0, 0.6, 61))
    steps = -np.diff(side.inner)
    # before: none at first, then 0.06 mm at once, over which splines went unseen
    assert steps.min() >= 0.0
    assert steps.max() < 1.5 * steps.mean()
    apart = np.abs(teeth.flank(side, 0.0).plane - teeth.fillet(side, 1.0).plane)
    assert float(apart.max()) < 1e-8

"""Noncircular gears: a rack rolled by brute force, the circle as a special case, perimeters, curves, limits."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
import shapely

from geometry.base.errors import CuspError, Nearest, OffsetError, ParameterError, PointedTipError
from geometry.base.record import replace
from geometry.curves.curve import Curve
from geometry.gears.noncircular.gear import NoncircularGear, cut_outline
from geometry.gears.noncircular.offset import findings_of, moved_outline, noncircular_region
from geometry.gears.noncircular.pairing import Centrode, paired
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.kinematics.centrodes import FourierRatio, LobedEllipse, RatioCentrode
from geometry.plane.measure import distance_to_profile, profile_area
from geometry.plane.profile import Label
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles
from tests import laws
from tests.oracles import rolled_rack
from tests.sampling import some_of

ALPHA = math.radians(20)


def gear(
    centrode: Centrode,
    teeth: int,
    *,
    mate: bool = False,
    x: float = 0.0,
    thinning: float = 0.0,
) -> NoncircularGear:
    pairing = paired(centrode, (teeth, teeth), 2.0, None)
    return NoncircularGear(
        pairing.lines[1 if mate else 0], teeth, iso_53("A"), 0.5 if mate else 0.0, x, thinning, pairing=pairing
    )


OVAL, ELLIPSE = LobedEllipse(1.0, 0.2, 2), LobedEllipse(1.0, 0.5)


def rack_of(made: NoncircularGear, inset: float = 0.0) -> rolled_rack.RackTooth:
    """ISO 53 A at module 2, from its coefficients."""
    m, p = 2.0, 2.0 * math.pi
    x = made.profile_shift_coefficient
    half = p / 4 - x * m * math.tan(ALPHA) + made.circumferential_thinning / 2 + inset / math.cos(ALPHA)
    first = (made.first_tooth + 0.5) * p
    return rolled_rack.RackTooth(p, ALPHA, half, (1.25 - x) * m + inset, 0.38 * m + inset, first)


def samples(made: NoncircularGear, labels: set[Label], count: int = 9, every: int = 1) -> np.ndarray:
    return np.concatenate([
        s.curve.point(np.linspace(*s.curve.domain, count)) for s in made.outline.segments[::every] if s.label in labels
    ])  # fmt: skip


CUT = {Label.FLANK, Label.ROOT_FILLET, Label.ROOT_LAND}


def focal(teeth: int, e: float) -> rolled_rack.Centrode:
    """The ellipse whose perimeter is so many pitches, by the complete elliptic integral."""
    return rolled_rack.ellipse(teeth * 2 * math.pi / (4 * float(mpmath.ellipe(e * e))), e)


def oval(made: NoncircularGear, e: float) -> rolled_rack.Centrode:
    p = made.radii[0] * (1 + e)
    return rolled_rack.polar(
        lambda t: p / (1 - e * np.cos(2 * t)), lambda t: -2 * p * e * np.sin(2 * t) / (1 - e * np.cos(2 * t)) ** 2
    )


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("x", "thinning"), [(0.0, 0.0), (0.3, 0.1)])
def test_a_rolling_rack_touches_every_point_of_an_ellipse(x: float, thinning: float) -> None:
    made = gear(ELLIPSE, 31, x=x, thinning=thinning)
    found = rolled_rack.least_distance(focal(31, 0.5), rack_of(made), samples(made, CUT, every=5), 0.5)
    assert np.abs(found).max() < 1e-9


@pytest.mark.heavy
def test_a_rolling_rack_touches_every_point_of_an_undercut_oval() -> None:
    made = gear(LobedEllipse(1.0, 0.3, 2), 22)
    assert made.outline.undercut == 6
    found = rolled_rack.least_distance(oval(made, 0.3), rack_of(made), samples(made, CUT), 0.9)
    assert np.abs(found).max() < 1e-9


def test_the_rack_tells_of_a_spoiled_outline() -> None:
    """Negative control: points a hundredth of a micrometre off, to both sides, at the start, the middle and the end."""
    made = gear(ELLIPSE, 31)
    curves = [s.curve for s in made.outline.segments if s.label is Label.FLANK]
    chosen = [curves[0], curves[len(curves) // 2], curves[-1]]
    middles = np.array([(c.domain[0] + c.domain[1]) / 2 for c in chosen])
    for off in (1e-5, -1e-5):
        points = np.array([complex(c.point(t) + 1j * off * c.tangent(t)) for c, t in zip(chosen, middles, strict=True)])
        found = rolled_rack.least_distance(focal(31, 0.5), rack_of(made), points, 0.5)
        assert np.allclose(found, off, atol=1e-8)


def test_perimeters_by_elliptic_integrals() -> None:
    for e in (0.0, 0.3, 0.6, 0.9):
        made = gear(LobedEllipse(1.0, e), 41)
        axis = (made.radii[0] + made.radii[1]) / 2
        assert 4 * axis * float(mpmath.ellipe(e * e)) == pytest.approx(41 * 2 * math.pi, rel=1e-13)
        assert made.module == pytest.approx(2.0, rel=1e-14)
        assert made.pairing is not None
        assert made.pairing.lines[1].length == pytest.approx(made.line.length, rel=1e-13)
        # the teeth's arc, point by point, is that of the oracle
        oracle = focal(41, e)
        t = np.linspace(0.1, 6.2, 23)
        assert np.abs(made.line.frame(oracle.arc(t))[0] - oracle.point(t)).max() < 1e-11 * axis


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("teeth", "x"), [(23, 0.0), (40, 0.4), (12, 0.0)])
def test_a_circle_gives_the_spur_gear(teeth: int, x: float) -> None:
    """Whole and undercut (12 teeth), driver and mate."""
    spur = SpurGear(module=2.0, number_of_teeth=teeth, rack=iso_53("A"), profile_shift_coefficient=x)
    profile = tooth_side(spur).profile()
    for mate in (False, True):
        made = gear(LobedEllipse(1.0, 0.0), teeth, mate=mate, x=x)
        turn = np.exp(1j * math.pi / teeth) if mate else 1.0
        points = samples(made, {*CUT, Label.TIP_LAND}) / turn
        assert distance_to_profile(points, profile).max() < 1e-11
        assert bool(made.outline.undercut) == (teeth == 12)


@pytest.mark.parametrize("x", [0.2, 0.43, 0.45, 0.88])
def test_pointed_teeth_of_a_tiny_circle_are_refused_as_those_of_the_spur_gear(x: float) -> None:
    """Flanks that reach far round a small centrode: their tips are not taken for those of the next turn."""
    spur = SpurGear(module=2.0, number_of_teeth=3, rack=iso_53("A"), profile_shift_coefficient=x)
    with pytest.raises(PointedTipError):
        tooth_side(spur)
    with pytest.raises(PointedTipError):
        _ = gear(LobedEllipse(1.0, 0.0), 3, x=x).outline


def test_undercut_may_be_as_little_as_one_likes() -> None:
    """It sets in within a chamfer's depth: all sections are closed, each within the one before."""
    made, onset = gear(OVAL, 30), 0.2164464454
    assert cut_outline(made, onset).undercut == 0
    areas = []
    for beyond in np.geomspace(1e-9, 1e-2, 6).tolist():
        assert cut_outline(made, onset + beyond).undercut == 2
        areas.append(profile_area(moved_outline(made, -onset - beyond)))
    assert np.all(np.diff(areas) < 0)


def test_undercut_that_leaves_nothing_is_refused() -> None:
    pairing = paired(RatioCentrode(FourierRatio(1.0, (0.295,), (0.091, 0.018), 3), 1.0), (17, 17), 10.0, None)
    with pytest.raises(ParameterError):
        _ = NoncircularGear(pairing.lines[1], 17, iso_53("A"), 0.5, -0.686, pairing=pairing).outline


def test_tips_lie_on_the_parallel_curve() -> None:
    made = gear(OVAL, 38)
    oracle = oval(made, 0.2)
    points = samples(made, {Label.TIP_LAND}, 3)[:, None]
    rough = np.linspace(0, 2 * math.pi, 2001)
    near = rough[np.argmin(np.abs(points - oracle.point(rough)), axis=1)]
    t = near[:, None] + np.linspace(-1, 1, 8001) * rough[1]
    distance = np.abs(points - oracle.point(t)).min(axis=1)
    assert np.abs(distance - 2.0).max() < 1e-9


def curves_of(made: NoncircularGear) -> list[Curve]:
    pieces = made.outline.segments
    return [s.curve for s in (*pieces[:6], *pieces[-6:])]


def test_curves_keep_the_laws() -> None:
    """Derivatives by differences, tangent, curvature, parallel curves, bounds, mirror images."""
    for made in (gear(ELLIPSE, 31), gear(OVAL, 40, mate=True, x=-0.2)):
        for curve in curves_of(made):
            laws.check_derivatives_together(curve)
            laws.check_alike(curve)
            low, high = curve.domain
            t = np.linspace(low, high, 7)[1:-1]
            h = 2e-4 * (high - low)
            for order in range(1, 5):
                before = curve.point if order == 1 else lambda s, c=curve, k=order: c.derivative(s, k - 1)
                found = (8 * (before(t + h) - before(t - h)) - before(t + 2 * h) + before(t - 2 * h)) / (12 * h)
                exact = curve.derivative(t, order)
                scale = np.abs(exact).max() + np.abs(before(t)).max() * 1e-10 / h
                assert np.abs(found - exact).max() < 1e-8 * scale
                dense = np.abs(curve.derivative(np.linspace(low, high, 201), order)).max()
                bound = curve.derivative_bound(order, low, high)
                assert bound is not None
                assert dense <= bound <= 40 * dense + 1e-9
            first, second = curve.derivative(t), curve.derivative(t, 2)
            assert np.abs(first / np.abs(first) - curve.tangent(t)).max() < 1e-12
            bend = (np.conj(first) * second).imag / np.abs(first) ** 3
            assert np.abs(bend - curve.curvature(t)).max() < 1e-12
            moved = curve.offset(0.05)
            assert np.abs(moved.point(t) - curve.point(t) - 0.05j * curve.tangent(t)).max() < 1e-13
            mirrored = curve.mirrored()
            assert np.abs(mirrored.point(-t) - np.conj(curve.point(t))).max() == 0


def test_a_parallel_curve_that_turns_back_is_refused() -> None:
    """The upper flank of the foremost tooth, whose evolute is farthest; a fillet closes at its radius."""
    pieces = gear(OVAL, 38).outline.segments
    for label, distance in ((Label.FLANK, 40.0), (Label.ROOT_FILLET, -1.5)):
        curve = next(s.curve for s in pieces if s.label is label)
        curve.offset(0.2 * distance)
        with pytest.raises(CuspError):
            curve.offset(distance)


def nearest(points: np.ndarray, curves: list[Curve]) -> np.ndarray:
    """Distances by samples of all curves, three times finer about the nearest ones."""
    shares = np.linspace(0, 1, 41)
    away = np.array([np.abs(points - c.point(c.domain[0] + np.ptp(c.domain) * shares)[:, None]) for c in curves])
    best = away.min(axis=(0, 1))
    for k, near in enumerate(away.min(axis=1) < best + 0.05):
        if near.any():
            curve, (low, high) = curves[k], curves[k].domain
            step = (high - low) / 40
            t = low + step * away[k][:, near].argmin(axis=0)
            for _ in range(5):
                place = np.clip(t[:, None] + step * np.linspace(-1, 1, 41), low, high)
                gaps = np.abs(points[near, None] - curve.point(place))
                t, step = place[np.arange(len(t)), gaps.argmin(axis=1)], step / 20
                best[near] = np.minimum(best[near], gaps.min(axis=1))
    return best


@pytest.mark.heavy
@pytest.mark.parametrize("offset", [0.1, -0.4, *(pytest.param(x, marks=pytest.mark.heavy) for x in (0.5, -0.1))])
def test_offset_outlines_are_parallel(offset: float) -> None:
    made = gear(LobedEllipse(1.0, 0.3, 2), 18)
    exact = made.outline.profile(made.count)
    moved = noncircular_region(made, offset).region.outer
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 7)) for s in moved.period[::3]])
    assert np.abs(nearest(points, [s.curve for s in exact.segments()]) - abs(offset)).max() < 1e-9


def test_an_offset_that_does_not_work_names_one_that_does() -> None:
    made = gear(LobedEllipse(1.0, 0.1, 2), 14)
    for asked in some_of((3.0, -2.0)):
        with pytest.raises(OffsetError) as refusal:
            noncircular_region(made, asked)
        assert 0 < abs(refusal.value.nearest_offset) < abs(asked)
        moved_outline(made, refusal.value.nearest_offset * (1 - 1e-6))
        with pytest.raises(ParameterError):
            noncircular_region(made, refusal.value.nearest_offset * 1.01)


def test_low_wide_spaces_grow_until_a_fillet_closes() -> None:
    """Shapely grows a dense polygon by more than half of what lies between two tips: no space closes."""
    made = replace(gear(OVAL, 18), rack=BasicRack(math.radians(45), 0.1, 0.2, 1.0))
    exact, moved = (
        shapely.Polygon(
            [
                (point.real, point.imag)
                for s in outline.segments()
                for point in s.curve.point(np.linspace(*s.curve.domain, 20)[:-1])
            ]
        )
        for outline in (made.outline.profile(made.count), noncircular_region(made, 1.9).region.outer)
    )
    grown = exact.buffer(1.9, quad_segs=32)
    assert not grown.interiors
    assert moved.symmetric_difference(grown).area < 1e-3 * grown.length


def test_an_inset_is_a_larger_rack() -> None:
    made = gear(ELLIPSE, 31)
    small = cut_outline(made, 0.2)
    points = np.concatenate([
        s.curve.point(np.linspace(*s.curve.domain, 5)) for s in small.segments[::7] if s.label in CUT
    ])  # fmt: skip
    assert np.abs(rolled_rack.least_distance(focal(31, 0.5), rack_of(made, 0.2), points, 0.5)).max() < 1e-9


def test_concave_centrodes_are_refused() -> None:
    with pytest.raises(ParameterError, match="concave"):
        _ = gear(LobedEllipse(1.0, 0.4, 2), 60).outline
    # the flat place of the limit itself is cut
    assert gear(LobedEllipse(1.0, 1 / 3, 2), 42).outline.undercut == 0


@pytest.mark.parametrize(("teeth", "closing"), [(50, 57), (46, 38), (5, 19)])
def test_a_mate_that_does_not_close_is_offered_whole_lobes_nearby(teeth: int, closing: int) -> None:
    """38 teeth of 2 lobes: the mate has a multiple of 19."""
    with pytest.raises(ParameterError, match="mate_does_not_close") as refusal:
        paired(OVAL, (38, teeth), 2.0, None)
    assert refusal.value.nearest == Nearest(closing)


def test_a_ratio_gives_its_centrodes() -> None:
    """The mate's radius and angle against quadrature at 20 digits."""
    ratio = FourierRatio(0.5, (0.2,), (0.1, 0.03))
    pairing = paired(RatioCentrode(ratio, 1.0), (20, 40), 2.0, None)
    first, second = pairing.lines
    assert second.length == pytest.approx(2 * first.length, rel=1e-13)

    def value(t: mpmath.mpf) -> mpmath.mpf:
        return mpmath.mpf(1) / 2 * (1 + 0.2 * mpmath.cos(t) + 0.1 * mpmath.sin(t) + 0.03 * mpmath.sin(2 * t))

    for phi in (0.7, 2.0, 5.0):
        turned = float(mpmath.quad(value, [0, phi]))
        arc = first.arc_at_angle(-phi)
        assert float(second.angle(-arc)) == pytest.approx(turned, abs=1e-12)
        radii = abs(complex(first.frame(arc)[0])), abs(complex(second.frame(-arc)[0]))
        assert sum(radii) == pytest.approx(pairing.centre_distance, rel=1e-13)
        assert radii[0] / radii[1] == pytest.approx(float(value(mpmath.mpf(phi))), rel=1e-12)


def test_symmetric_outlines_repeat() -> None:
    made = gear(OVAL, 38)
    assert made.count == 2
    assert gear(OVAL, 37).count == 1
    turned = replace(made, first_tooth=0.0)
    assert turned.outline.profile(2).reach() < made.tip_radius * (1 + 1e-12)


@pytest.mark.parametrize("offset", [0.15, -0.4])
def test_offset_outlines_of_few_teeth_are_parallel_and_closed(offset: float) -> None:
    """Every second piece of a period, corners' arcs among them; as large as GEOS' buffer of the outline."""
    made = gear(LobedEllipse(1.0, 0.1, 2), 14)
    exact = made.outline.profile(made.count)
    moved = noncircular_region(made, offset).region.outer
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 4)) for s in moved.period[::2]])
    assert np.abs(nearest(points, [s.curve for s in exact.segments()]) - abs(offset)).max() < 1e-9
    assert any(s.label is Label.CORNER for s in moved.period) == (offset > 0)
    one, two = (
        shapely.Polygon([(p.real, p.imag) for s in outline.segments()
                         for p in s.curve.point(np.linspace(*s.curve.domain, 16)[:-1])])
        for outline in (exact, moved)
    )  # fmt: skip
    assert two.is_valid
    assert two.symmetric_difference(one.buffer(offset, quad_segs=16)).area < 3e-3 * one.length * abs(offset)
    assert profile_area(moved) == pytest.approx(two.area, rel=5e-4)


def test_holes_leave_a_rim_between_them_and_the_root() -> None:
    made = gear(OVAL, 18)
    bored = replace(made, hub=HubHoles(RoundBore(2 * (made.root_radius - 0.8))))
    noncircular_region(bored, -0.4 * (1 - 1e-6))
    with pytest.raises(OffsetError) as refused:
        noncircular_region(bored, -0.4 * (1 + 1e-6))
    assert refused.value.reason == "leaves_no_rim"
    assert refused.value.nearest_offset == pytest.approx(-0.4, rel=1e-8)
    assert refused.value.nearest_offset > -0.4


def test_what_is_legal_and_poor_is_told() -> None:
    """Undercut by the curvature of the centrode, tips by 0.3 modules, rims by one."""
    good = gear(LobedEllipse(1.0, 0.05, 2), 36)
    assert findings_of(good) == ()
    steep = gear(LobedEllipse(1.0, 0.2, 2), 22)
    (undercut,) = (f for f in findings_of(steep) if f.code == "undercut_on_centrode")
    form = 1.25 - 0.38 * (1 - math.sin(ALPHA))
    assert undercut.limit == pytest.approx(form * 2.0 / math.sin(ALPHA) ** 2)
    angles = np.linspace(0, 2 * math.pi, 20_001)
    radius = steep.pairing.centrode.series(angles, 2)  # type: ignore[union-attr]
    r, r1, r2 = radius[0], radius[1], 2 * radius[2]
    bend = (r * r + 2 * r1 * r1 - r * r2) / (r * r + r1 * r1) ** 1.5
    assert undercut.value == pytest.approx(1 / bend.max(), rel=1e-6)
    for x, told in ((0.4, False), (0.8, True)):
        thin = gear(LobedEllipse(1.0, 0.05, 2), 20, x=x)
        found = [f for f in findings_of(thin) if f.code == "thin_tip"]
        assert bool(found) == told
        if told:
            assert (found[0].value, found[0].limit) == (thin.outline.tip_thickness, pytest.approx(0.6))
            assert found[0].value < 0.6
    for rim, told in ((2.001, False), (1.999, True)):
        bored = replace(good, hub=HubHoles(RoundBore(2 * (good.root_radius - rim))))
        found = [f for f in findings_of(bored) if f.code == "thin_rim"]
        assert [(f.value, f.limit) for f in found] == ([(pytest.approx(rim), pytest.approx(2.0))] if told else [])


def test_pairings_are_alike_by_their_numbers() -> None:
    one = paired(LobedEllipse(1.0, 0.2, 2), (22, 22), 2.0, None)
    assert one.is_like(paired(LobedEllipse(1.0, 0.2, 2), (22, 22), 2.0, None))
    ratio = FourierRatio(1.0, (0.25,), (0.1,))
    other = paired(RatioCentrode(ratio, 1.0), (18, 18), 2.0, None)
    assert other.is_like(paired(RatioCentrode(ratio, 1.0), (18, 18), 2.0, None))
    oval = LobedEllipse(1.0, 0.2, 2)
    flatter = paired(LobedEllipse(1.0, 0.2001, 2), (22, 22), 2.0, None)
    larger = [
        paired(oval, teeth, module, None) for teeth, module in (((20, 20), 2.0), ((22, 33), 2.0), ((22, 22), 2.001))
    ]
    for wrong in (flatter, *larger, other):
        assert not one.is_like(wrong)
        assert not wrong.is_like(one)
    for waves in (((0.25,), ()), ((0.1,), (0.25,)), ((), (0.25, 0.1)), ((0.25, 0.01), (0.1,))):
        assert not other.is_like(paired(RatioCentrode(FourierRatio(1.0, *waves), 1.0), (18, 18), 2.0, None))
    assert one.lobes == (2, 2)
    assert paired(LobedEllipse(1.0, 0.2, 2), (22, 33), 2.0, None).lobes == (2, 3)
    assert one.pitch == pytest.approx(2 * math.pi)
    assert one.pitch * 22 == pytest.approx(one.lines[0].length)

"""Rings: outline against the swept cutter, dimensions, limits, offsets, refusals whose remedies work."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import assume, example, given
from hypothesis import strategies as st

from geometry.base.errors import GeometryError, OffsetError, ParameterError, PointedTipError
from geometry.base.record import replace
from geometry.gears.teeth import ring_limits
from geometry.gears.teeth.cutter import PinionCutter, checked_cutter, full_round
from geometry.gears.teeth.internal_mesh import InternalMesh
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_limits import checked_ring
from geometry.gears.teeth.ring_offset import chamfered_teeth, ring_region
from geometry.gears.teeth.ring_tooth import ring_side
from geometry.gears.teeth.sector import Sector
from geometry.plane.measure import profile_area
from geometry.plane.profile import Label, Profile, Region, joint_turn
from tests import brute
from tests.oracles.cutter_sweep import CutterTool, least_distance
from tests.sampling import examples
from tests.strategies import numbers, with_default_cutter

ALPHA = math.radians(20.0)
RIGHT = 1e-12


def ring(teeth: int = 60, cutter: PinionCutter | RoundedRoot | None = None, x: float = 0.0, **keys: object) -> RingGear:
    """A ring of module 2, cut with 25 teeth where nothing else is said."""
    root = PinionCutter(2.0, 25, ALPHA) if cutter is None else cutter
    return RingGear(2.0, teeth, ALPHA, 2.0 * teeth + 60, root, x, **keys)  # type: ignore[arg-type]


CASES: dict[str, RingGear] = {
    "usual": ring(),
    "shifted": ring(60, PinionCutter(2.0, 25, ALPHA, -0.2, tip_rounding=0.1), 0.5),
    "wide cutter": ring(80, PinionCutter(2.0, 30, ALPHA, 0.3), circumferential_thinning=0.2),
    "deeper cut": ring(80, PinionCutter(2.0, 30, ALPHA, 0.3), circumferential_thinning=0.2,
                       thinning_by_deeper_cut=True),
    "sharp corner, centre inside the pitch circle": ring(40, PinionCutter(2.0, 20, ALPHA, -0.4, tip_rounding=0.0), 0.9),
    "large shift": ring(100, PinionCutter(2.0, 60, ALPHA, tip_rounding=0.25), 2.0),
    "full round": ring(60, full_round(PinionCutter(2.0, 25, ALPHA))),
    "large cutter": ring(144, PinionCutter(2.0, 100, ALPHA)),
    "large ring": ring(5000, PinionCutter(2.0, 40, ALPHA)),
}  # fmt: skip
EVERY = pytest.mark.parametrize("gear", CASES.values(), ids=CASES.keys())


def tool_of(gear: RingGear) -> CutterTool:
    """The oracle's own cutter of a ring."""
    cutter = gear.root
    assert isinstance(cutter, PinionCutter)
    thick = 0.0 if gear.thinning_by_deeper_cut else gear.circumferential_thinning / 2
    return CutterTool(
        cutter.module, cutter.number_of_teeth, cutter.pressure_angle, cutter.profile_shift_coefficient,
        cutter.addendum, cutter.tip_rounding, thick,
    )  # fmt: skip


def sweep_distance(gear: RingGear, points: int = 120) -> np.ndarray:
    """Least distance of the swept cutter from the ring's root, fillet and flank, as a part of the root radius."""
    labels = (Label.ROOT_LAND, Label.ROOT_FILLET, Label.FLANK)
    outline = [brute.dense(s.curve, points) for s in ring_side(gear).segments if s.label in labels]
    found = least_distance(np.concatenate(outline), tool_of(gear), gear.number_of_teeth, gear.generating_distance)
    return found / gear.root_radius


@pytest.mark.sampled(2)
@EVERY
def test_outline_against_the_swept_cutter(gear: RingGear) -> None:
    checked_ring(gear)
    assert np.abs(sweep_distance(gear)).max() <= RIGHT


@pytest.mark.sampled(5)
@EVERY
def test_the_sweep_notices_a_wrong_outline(gear: RingGear) -> None:
    """A fillet of another rounding, a flank turned by 1e-9 of the radius: both far above what is right."""
    fillet, tool = gear.fillet(), tool_of(gear)
    wrong = replace(fillet, tip_radius=fillet.tip_radius + 1e-8)
    a = least_distance(brute.dense(wrong, 60), tool, gear.number_of_teeth, gear.generating_distance)
    assert np.abs(a).max() == pytest.approx(1e-8, rel=0.01)
    flank = next(s.curve for s in ring_side(gear).segments if s.label is Label.FLANK)
    turned = brute.dense(flank, 60) * np.exp(1e-9j)
    b = least_distance(turned, tool, gear.number_of_teeth, gear.generating_distance)
    assert b.min() < -5e-10 * gear.base_radius


@EVERY
def test_root_and_flank_join_smoothly_and_the_hole_closes(gear: RingGear) -> None:
    side = ring_side(gear)
    kinds = [s.label for s in side.segments]
    for before, after in zip(side.segments[:-1], side.segments[1:], strict=True):
        if after.label is not Label.TIP_LAND and gear.root.tip_rounding != 0.0:  # type: ignore[union-attr]
            assert abs(joint_turn(before.curve, after.curve)) <= 1e-9
    assert kinds[-1] is Label.TIP_LAND
    profile = side.profile()
    assert profile.clockwise
    assert profile.count == gear.number_of_teeth
    area = -profile_area(profile)
    assert math.pi * gear.tip_radius**2 < area < math.pi * gear.root_radius**2


def test_dimensions_without_shift_and_thinning() -> None:
    """GOST 19274 by hand: d 120, d_b = 120 cos 20, d_a = 120 - 2 (1 - 0.25) 2, root 2.5 m outside where x = x0 = 0."""
    gear = ring()
    assert 2 * gear.reference_radius == 120
    assert gear.base_radius == pytest.approx(60 * math.cos(ALPHA), rel=1e-15)
    assert 2 * gear.tip_radius == 117
    assert 2 * replace(gear, plain_tip=True).tip_radius == 116
    # k_2 = 0.25 - 0.125 x_2: 0.15 of a shift of 0.8, none from 2 on
    for shift, tip in ((0.8, 120 - 4 * (1 - 0.8 - 0.15)), (2.4, 120 - 4 * (1 - 2.4))):
        assert 2 * replace(gear, profile_shift_coefficient=shift).tip_radius == pytest.approx(tip, rel=1e-12)
    assert 2 * gear.root_radius == pytest.approx(125, rel=1e-14)
    assert gear.reference_thickness == pytest.approx(math.pi, rel=1e-14)


@given(st.integers(36, 150), st.integers(15, 30), numbers(-0.3, 1.0), numbers(-0.3, 0.5), numbers(0, 0.3))
@examples(20)
def test_any_ring_that_is_not_refused_is_what_its_cutter_leaves(
    teeth: int, cutter_teeth: int, x: float, x0: float, rounding: float
) -> None:
    gear = ring(teeth, PinionCutter(2.0, cutter_teeth, ALPHA, x0, tip_rounding=rounding), x)
    assume(brute.refusal(lambda: checked_ring(gear)) is None)
    assert np.abs(sweep_distance(gear, 40)).max() <= RIGHT


@pytest.mark.heavy
@pytest.mark.parametrize("degrees", [14.5, 20.0, 25.0])
@pytest.mark.parametrize("cutter_teeth", [12, 15, 20, 25, 34, 50, 76, 100])
@pytest.mark.parametrize("teeth", [34, 40, 60, 77, 100, 200, 1000])
def test_sweep_of_rings(teeth: int, cutter_teeth: int, degrees: float) -> None:
    """Every ring of the sweep is exact or refused with a value that works."""
    angle = math.radians(degrees)
    for x in (-0.4, 0.0, 0.3, 1.0, 2.0):
        for x0 in (-0.3, 0.0, 0.4):
            for rounding in (0.0, 0.1, 0.3):
                cutter = PinionCutter(1.0, cutter_teeth, angle, x0, tip_rounding=rounding)
                gear = RingGear(1.0, teeth, angle, teeth + 60.0, cutter, x)
                refused = brute.refusal(lambda g=gear: checked_ring(g))  # type: ignore[misc]
                if refused is None:
                    assert np.abs(sweep_distance(gear, 40)).max() <= RIGHT, gear
                else:
                    assert isinstance(refused, ParameterError)


@pytest.mark.parametrize(("teeth", "least"), [(15, 34), (16, 34), (17, 35), (18, 36), (20, 38), (22, 40), (25, 43)])
def test_least_ring_for_a_cutter_to_be_fed_in(teeth: int, least: int) -> None:
    """KHK's table of rings and cutters, h_a0 = 1.25, x = 0, ring addendum 1.0."""

    def fed_in(ring_teeth: int) -> bool:
        gear = RingGear(1.0, ring_teeth, ALPHA, 100.0, PinionCutter(1.0, teeth, ALPHA), plain_tip=True)
        mesh = ring_limits.generation(gear)
        assert mesh is not None
        return ring_limits.tip_above_base(gear).margin >= 0 and mesh.radial_assembly().margin >= 0

    assert next(z for z in range(teeth + 2, 100) if fed_in(z)) == least


def test_a_cutter_beyond_its_limit_trims_the_tips() -> None:
    """Negative control: one tooth too many, and the swept cutter takes what the outline claims."""
    cutters = [ring(60, PinionCutter(2.0, z, ALPHA, tip_rounding=0.0)) for z in range(42, 57, 2)]
    meshes = [ring_limits.generation(g) for g in cutters]
    limits = [None if m is None else m.trochoid_interference().margin for m in meshes]
    for gear, margin in zip(cutters, limits, strict=True):
        assert margin is not None
        outline = brute.dense(next(s.curve for s in ring_side(gear).segments if s.label is Label.FLANK), 80)
        least = least_distance(outline, tool_of(gear), 60, gear.generating_distance, reach=2.5).min()
        assert (least < -1e-9) == (margin < 0), (gear.cutter, margin, least)
    signs = [m >= 0 for m in limits if m is not None]
    assert True in signs
    assert False in signs


@pytest.mark.parametrize("root", [RoundedRoot(), RoundedRoot(1.25, 0.1), RoundedRoot(1.0, 0.0)])
def test_rounded_roots_without_a_cutter(root: RoundedRoot) -> None:
    gear = checked_ring(ring(60, root, 0.2))
    side = ring_side(gear)
    assert gear.root_radius == pytest.approx(60 + 2 * (root.dedendum + 0.2), rel=1e-15)
    fillets = [s.curve for s in side.segments if s.label is Label.ROOT_FILLET]
    if root.radius == 0.0:
        assert not fillets
        return
    turns = [joint_turn(a.curve, b.curve) for a, b in zip(side.segments[:-2], side.segments[1:-1], strict=True)]
    assert np.abs(turns).max() <= 1e-9
    farthest = max(abs(complex(p)) for p in brute.dense(fillets[0], 2000))
    assert farthest == pytest.approx(gear.root_radius, rel=1e-12)


def test_tip_chamfer_and_rounding() -> None:
    plain, chamfered = ring(), ring(tip_chamfer=0.3)
    rounded = ring(tip_rounding=0.3)
    line = next(s.curve for s in ring_side(chamfered).segments if s.label is Label.TIP_BREAK)
    foot, corner = complex(line.point(0.0)), complex(line.point(1.0))
    assert abs(foot) == pytest.approx(plain.tip_radius + 0.3, rel=1e-14)
    assert abs(corner) == pytest.approx(plain.tip_radius, rel=1e-14)
    assert abs(np.angle((corner - foot) / -foot)) == pytest.approx(math.pi / 4, abs=1e-12)
    side = ring_side(rounded)
    turns = [abs(joint_turn(a.curve, b.curve)) for a, b in zip(side.segments[:-1], side.segments[1:], strict=True)]
    assert max(turns) <= 1e-9
    assert side.flank_radii()[1] > plain.tip_radius


def section(region: Region, points: int) -> shapely.Polygon:
    """A dense polygon of a region."""
    return polygon(region.outer, points).difference(polygon(region.holes[0], points))


def polygon(profile: Profile, points: int) -> shapely.Polygon:
    one = np.concatenate([brute.dense(s.curve, points)[:-1] for s in profile.period])
    turns = np.exp(1j * profile.pitch_angle * np.arange(profile.count))
    ring_points = (turns[:, None] * one).ravel()
    return shapely.Polygon(np.column_stack([ring_points.real, ring_points.imag]))


OFFSET_CASES = {
    "sharp tips": ring(40, PinionCutter(2.0, 20, ALPHA, tip_rounding=0.2)),
    "chamfer": ring(40, PinionCutter(2.0, 20, ALPHA), tip_chamfer=0.2),
    "rounding": ring(40, PinionCutter(2.0, 20, ALPHA), tip_rounding=0.2),
    "rounded root": ring(40, RoundedRoot(1.25, 0.1)),
    "full round": ring(40, RoundedRoot()),
}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("offset", [-0.5, -0.1, 0.05, 0.3, 0.6])
@pytest.mark.parametrize("gear", OFFSET_CASES.values(), ids=OFFSET_CASES.keys())
def test_offsets_lie_at_their_distance(gear: RingGear, offset: float) -> None:
    """Every point of an offset outline is as far from the outline as asked, and none is left out."""
    hole, moved = (ring_region(gear, d).region.holes[0] for d in (0.0, offset))
    points = np.concatenate([brute.dense(s.curve, 60) for s in moved.period])
    assert np.abs(brute.distance_to_outline(points, hole) - abs(offset)).max() <= 1e-9
    # the same by GEOS, as far as polygons go: nothing is missing, nothing is too much
    exact = polygon(moved, 60)
    assert exact.is_valid
    buffered = polygon(hole, 60).buffer(-offset, quad_segs=24)
    assert exact.symmetric_difference(buffered).area <= 1e-4 * exact.area
    assert ring_region(gear, offset).region.outer.reach() == pytest.approx(gear.outer_radius + offset, rel=1e-15)


@pytest.mark.sampled(10)
@pytest.mark.parametrize("offset", [3.0, -6.0, math.inf, -20.0])
@pytest.mark.parametrize("gear", OFFSET_CASES.values(), ids=OFFSET_CASES.keys())
def test_offsets_that_no_ring_survives_name_one_that_works(gear: RingGear, offset: float) -> None:
    refused = brute.refusal(lambda: ring_region(gear, offset))
    assert isinstance(refused, OffsetError)
    assert section(ring_region(gear, refused.nearest_offset * (1 - 1e-9)).region, 20).is_valid
    if refused.nearest_offset:
        with pytest.raises(OffsetError):
            ring_region(gear, refused.nearest_offset * 1.001)


def test_a_thin_rim_is_taken_from_both_sides() -> None:
    """One of 1.2 mm about the roots, whose circle is found on the outline, is gone at 0.6 mm."""
    gear = ring(40, PinionCutter(2.0, 25, ALPHA))
    root = ring_region(gear).region.holes[0].reach()
    thin = replace(gear, outer_diameter=2 * (root + 1.2))
    assert ring_region(thin, -0.59).region.outer.reach() == pytest.approx(root + 0.61)
    refused = brute.refusal(lambda: ring_region(thin, -0.61))
    assert isinstance(refused, OffsetError)
    assert refused.nearest_offset == pytest.approx(-0.6, abs=1e-3)


REFUSED: dict[str, RingGear] = {
    "cutter too large": ring(60, PinionCutter(2.0, 55, ALPHA)),
    "cutter as large as the ring": ring(60, PinionCutter(2.0, 60, ALPHA)),
    "cutter below the base circle": replace(ring(60, PinionCutter(2.0, 18, ALPHA)), plain_tip=True),
    "cutter pointed": ring(60, PinionCutter(2.0, 25, ALPHA, addendum=2.0)),
    "cutter corner": ring(60, PinionCutter(2.0, 25, ALPHA, tip_rounding=0.9)),
    "tip below the base circle": ring(given_tip_diameter=100.0),
    "tip above the root": ring(given_tip_diameter=130.0),
    "tip pointed": ring(circumferential_thinning=2.6),
    "chamfer": ring(tip_chamfer=3.0),
    "rounding": ring(tip_rounding=3.0),
    "no working angle": ring(x=-3.0),
    "root rounding": ring(60, RoundedRoot(1.25, 1.0)),
    "root pointed": ring(60, RoundedRoot(3.0)),
    "rim": replace(ring(), outer_diameter=120.0),
    "small ring": with_default_cutter(ring(12)),
    "shift": with_default_cutter(ring(40, x=-1.0)),
}  # fmt: skip


def changed(gear: RingGear, name: str, value: float) -> RingGear:
    """The ring with one parameter set to another value."""
    owner, _, field = name.rpartition(".")
    if owner:
        return replace(gear, root=replace(gear.root, **{field: value}))
    if name == "pressure_angle":
        return replace(gear, pressure_angle=value, root=replace(gear.root, pressure_angle=value))
    return replace(gear, **{"given_tip_diameter" if name == "tip_diameter" else name: value})


@pytest.mark.parametrize("gear", REFUSED.values(), ids=REFUSED.keys())
def test_refusals_name_a_value_that_works(gear: RingGear) -> None:
    refused = brute.refusal(lambda: checked_ring(gear))
    assert isinstance(refused, ParameterError)
    mended = changed(gear, refused.name, brute.works(refused))
    checked_ring(with_default_cutter(mended) if gear.any_cutter else mended)


def test_pointed_ring_teeth_are_told_so() -> None:
    gear = ring(circumferential_thinning=2.6)
    with pytest.raises(PointedTipError, match="ring_tooth_pointed"):
        ring_side(gear)


@given(st.sampled_from(["module", "profile_shift_coefficient", "given_tip_diameter", "circumferential_thinning",
                        "tip_chamfer", "tip_rounding", "outer_diameter", "addendum"]),
       st.sampled_from([0.0, -1.0, 1e-300, 1e300, math.inf, -math.inf, math.nan, 1e6]))  # fmt: skip
@example("tip_rounding", 1e300)
@examples(30)
def test_hostile_numbers_are_refused_or_built(key: str, value: float) -> None:
    gear = replace(ring(), **{key: value})
    refused = brute.refusal(lambda: checked_ring(gear))
    assert refused is None or isinstance(refused, GeometryError)


@pytest.mark.parametrize("teeth", [36, 48, 60, 96, 144, 300])
def test_a_cutter_that_nobody_named_is_one_that_works(teeth: int) -> None:
    gear = checked_ring(with_default_cutter(ring(teeth)))
    mesh = ring_limits.generation(gear)
    assert isinstance(mesh, InternalMesh)
    assert min(m.margin for m in mesh.margins()) >= 0
    assert gear.cutter is not None
    checked_cutter(gear.cutter)


def cutter(teeth: int, x: float, rounding: float) -> PinionCutter:
    return PinionCutter(2.0, teeth, ALPHA, x, tip_rounding=rounding)


# rings and offsets at which something is used up, and what is told of it; each was found by its way through the code
USED_UP: dict[str, tuple[RingGear, float, set[str]]] = {
    "a rounded root's arc": (ring(34, RoundedRoot(1.16, 0.1), 0.625, tip_rounding=0.17), 0.77,
                             {"fillet_cusp_trimmed", "space_shallowed"}),
    "a rounded root's arc, its land left": (
        ring(70, RoundedRoot(1.38, 0.3), 0.585, circumferential_thinning=0.3, given_tip_diameter=136.6), 0.623,
        {"fillet_cusp_trimmed"}),
    "all of a fillet": (ring(34, cutter(30, 0.045, 0.0), 1.19), 0.88, {"fillet_cusp_trimmed"}),
    "all of a fillet, beside a chamfer": (ring(40, cutter(18, 0.07, 0.05), 1.09, tip_chamfer=1.02), 0.626,
                                          {"fillet_cusp_trimmed", "space_shallowed"}),
    "a part of a fillet": (ring(100, cutter(30, 0.21, 0.2), 0.754), 0.529, {"fillet_cusp_trimmed"}),
    "a part of a fillet and the root": (ring(40, cutter(25, 0.38, 0.2), 0.14, tip_rounding=0.385), 0.83,
                                        {"fillet_cusp_trimmed", "space_shallowed"}),
    "nothing": (ring(60, cutter(25, 0.0, 0.2)), 0.1, set()),
    "a sharp root that opens": (ring(40, RoundedRoot(1.3, 0.0), 0.19, tip_rounding=0.435), -0.1, set()),
    "a sharp root and the tip rounding": (ring(100, RoundedRoot(1.16, 0.0), 0.8, tip_rounding=0.3), -1.3, set()),
    "a chamfer": (ring(40, cutter(25, 0.063, 0.1), 1.106, tip_chamfer=0.0734), -0.336, set()),
    "a chamfer and the tip": (
        ring(34, cutter(25, -0.16, 0.05), 1.343, tip_chamfer=1.06, circumferential_thinning=0.49), -0.441, set()),
    "the tip beside a chamfer": (ring(40, cutter(18, 0.07, 0.05), 1.09, tip_chamfer=1.02), -1.05, set()),
}  # fmt: skip


@pytest.mark.sampled(1)
@pytest.mark.parametrize("name", USED_UP)
def test_a_moved_ring_lies_at_its_distance_whatever_is_used_up(name: str) -> None:
    """Every point of a period so far from the outline, none nearer to it, the hole as large as GEOS' buffer of it."""
    gear, offset, told = USED_UP[name]
    plain, moved = ring_region(gear), ring_region(gear, offset)
    whole, found = plain.region.holes[0], moved.region.holes[0]
    points = brute.period_points(found, 12)
    assert np.abs(brute.distance_to_outline(points, whole, 120) - abs(offset)).max() <= 1e-9 * gear.root_radius
    assert {f.code for f in moved.findings} - {f.code for f in plain.findings} == told
    # a hole runs clockwise, period after period
    turns = np.exp(-2j * math.pi / gear.number_of_teeth * np.arange(gear.number_of_teeth))[:, None]
    around = [(turns * brute.polygon(p, 24, 1)).ravel() for p in (whole, found)]
    polygons = [shapely.Polygon(np.column_stack([p.real, p.imag])) for p in around]
    assert polygons[1].is_valid
    wanted = polygons[0].buffer(-offset, quad_segs=24)
    assert polygons[1].symmetric_difference(wanted).area < 1e-3 * gear.number_of_teeth * gear.module**2
    assert profile_area(moved.region.outer) == pytest.approx(math.pi * (gear.outer_radius + offset) ** 2)
    if "tip_lost" in told:
        (finding,) = (f for f in moved.findings if f.code == "tip_lost")
        assert finding.value == pytest.approx(np.abs(points).min() - gear.tip_radius + offset, abs=1e-3)
    if "space_shallowed" in told:
        (finding,) = (f for f in moved.findings if f.code == "space_shallowed")
        assert finding.value == pytest.approx(np.abs(points).max(), abs=1e-9)
        assert finding.limit == pytest.approx(gear.root_radius - offset)
    if "fillet_cusp_trimmed" in told:
        (finding,) = (f for f in moved.findings if f.code == "fillet_cusp_trimmed")
        assert finding.value == offset
        rounding = gear.root.tip_rounding * 2 if isinstance(gear.root, PinionCutter) else 0.0
        assert finding.limit == pytest.approx(rounding, abs=1e-12)


@pytest.mark.parametrize("rim", [1.999, 2.001])
@pytest.mark.parametrize("thickness", [0.299, 0.301])
def test_thin_tips_and_rims_are_told_below_their_limits(rim: float, thickness: float) -> None:
    """A rim of a module outside the root, and 0.3 modules of a tip: its diameter is sought by its own thickness."""
    gear = RingGear(2.0, 60, math.radians(20), 200.0, RoundedRoot(), 0.8)

    def with_tip(radius: float) -> RingGear:
        return replace(gear, given_tip_diameter=2 * radius)

    # s_a = 2 r (pi / (2 z) - 2 x tan(alpha) / z - inv alpha + inv alpha_a) of a ring's tooth, thinner inwards
    def width(radius: float) -> float:
        at = math.acos(gear.base_radius / radius)
        lean = math.tan(math.radians(20))
        return 2 * radius * (math.pi / 120 - 1.6 * lean / 60 - (lean - math.radians(20)) + math.tan(at) - at)

    low, high = gear.base_radius * 1.0001, 60.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if width(middle) < thickness * 2 else (low, middle)
    made = replace(with_tip(low), outer_diameter=2 * (gear.root_radius + rim))
    wanted = [("thin_tip", thickness * 2, 0.6)] if thickness < 0.3 else []
    wanted += [("thin_ring_rim", rim, 2.0)] if rim < 2 else []
    found = [(f.code, f.value, f.limit) for f in ring_limits.findings(made)]
    assert found == [(code, pytest.approx(value, rel=1e-9), pytest.approx(least)) for code, value, least in wanted]


SHARP = RoundedRoot(1.25, 0.0)
CHAMFERED: dict[str, RingGear] = {
    **{name: CASES[name] for name in ("usual", "wide cutter", "sharp corner, centre inside the pitch circle")},
    "rounded root": ring(40, RoundedRoot(1.25, 0.2), tip_chamfer=0.3),
    "one round root": ring(40, RoundedRoot(), tip_rounding=0.6),
    "sharp root": ring(40, SHARP),
    "sector": ring(40, SHARP, sector=Sector(3, -2, 2)),
    "sector with a blank": ring(40, sector=Sector(3, -2, 2, 92.0)),
}


@pytest.mark.sampled(1)
@pytest.mark.parametrize("inset", [0.0, 0.05])
@pytest.mark.parametrize("name", CHAMFERED)
def test_teeth_are_moved_for_a_chamfer_as_shapely_moves_them_and_keep_their_segments(name: str, inset: float) -> None:
    """Sharp roots stay sharp, roundings of roots grow, those of tips shrink; an inset before rounds the corners."""
    gear, depth, points = CHAMFERED[name], 0.4, 400 if name.startswith("sector") else 60
    whole = polygon(ring_region(gear, -inset).region.holes[0], points)
    made = chamfered_teeth(gear, inset, depth, depth)
    assert [s.label for s in made.period] == [s.label for s in chamfered_teeth(gear, inset, 0.0, depth).period]
    wanted = whole.buffer(depth, join_style="mitre", mitre_limit=20.0)
    found = polygon(made, points)
    assert found.is_valid
    assert found.symmetric_difference(wanted).area < 1e-4 * wanted.length
    # of another depth it is another
    other = polygon(chamfered_teeth(gear, inset, depth - 0.01, depth), points)
    assert other.symmetric_difference(wanted).area > 5e-3 * wanted.length

"""Splines: sizes as the standards print them, areas by quadrature, shafts in their hubs, what has no shape."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
import shapely

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.curves.line_arc import Line
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.measurement import over_pins, span
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.measure import distance_to_profile, profile_area
from geometry.plane.profile import Label, Profile
from geometry.solids.spline_standards import STRAIGHT_JOINTS, din_5480, gost_6033, iso_4156, teeth_of
from geometry.solids.splines import InvoluteJoint, Root, SplineBore, StraightJoint
from tests import brute

# z x d x D x b, f and r of GOST 1139-80, light, medium and heavy series, as a list for broaches has them; the light and
# medium ones are those of ISO 14
PUBLISHED = """6x23x26x6 .3 .2|6x26x30x6 .3 .2|6x28x32x7 .3 .2|8x32x36x6 .4 .3|8x36x40x7 .4 .3|8x42x46x8 .4 .3
8x46x50x9 .4 .3|8x52x58x10 .5 .5|8x56x62x10 .5 .5|8x62x68x12 .5 .5|10x72x78x12 .5 .5|10x82x88x12 .5 .5|10x92x98x14 .5 .5
10x102x108x16 .5 .5|10x112x120x18 .5 .5|6x11x14x3 .3 .2|6x13x16x3.5 .3 .2|6x16x20x4 .3 .2|6x18x22x5 .3 .2
6x21x25x5 .3 .2|6x23x28x6 .3 .2|6x26x32x6 .4 .3|6x28x34x7 .4 .3|8x32x38x6 .4 .3|8x36x42x7 .4 .3|8x42x48x8 .4 .3
8x46x54x9 .5 .5|8x52x60x10 .5 .5|8x56x65x10 .5 .5|8x62x72x12 .5 .5|10x72x82x12 .5 .5|10x82x92x12 .5 .5
10x92x102x14 .5 .5|10x102x112x16 .5 .5|10x112x125x18 .5 .5|10x16x20x2.5 .3 .2|10x18x23x3 .3 .2|10x21x26x3 .3 .2
10x23x29x4 .3 .2|10x26x32x4 .4 .3|10x28x35x4 .4 .3|10x32x40x5 .4 .3|10x36x45x5 .4 .3|10x42x52x6 .4 .3
10x46x56x7 .5 .5""".replace("\n", "|").split("|")
GOST = gost_6033(50.0, 2.0, 24, outer=False, root="flat")
JOINTS: dict[str, StraightJoint | InvoluteJoint] = {
    "light": STRAIGHT_JOINTS[0],
    "heavy, on its sides": replace(STRAIGHT_JOINTS[-2], centring="sides"),
    "own": StraightJoint(3, 10.0, 14.0, 5.0, 10.0),
    "GOST 6033": GOST,
    "round roots": gost_6033(50.0, 2.0, 24, outer=False, root="fillet"),
    "by the outer diameter": gost_6033(60.0, 2.5, 22, outer=True, root="flat"),
    "DIN 5480": din_5480(30.0, 2.0, 14),
    "ISO 4156, 30P": iso_4156(24, 2.5, 30.0, "flat"),
    "ISO 4156, 37.5R": iso_4156(12, 1.0, 37.5, "fillet"),
    "ISO 4156, 45R": iso_4156(40, 0.5, 45.0, "fillet"),
    # sides that go on below the base circle, and roundings that would reach the tips of the mate
    "ISO 4156, 6 teeth": iso_4156(6, 2.0, 30.0, "flat"),
    "DIN 5480, 6 teeth": din_5480(14.0, 2.0, 6),
    "DIN 5480, 8 teeth": din_5480(90.0, 10.0, 8),
    "round roots, 9 teeth": gost_6033(90.0 + 10.0, 10.0, 9, outer=False, root="fillet"),
}


def polygon(profile: Profile) -> shapely.Polygon:
    points = np.concatenate([brute.dense(s.curve, 80)[:-1] for s in profile.segments()])
    return shapely.Polygon(np.column_stack([points.real, points.imag]))


def test_straight_joints_are_those_of_the_tables() -> None:
    made = {tuple(map(float, (*j.sizes, j.chamfer, j.rounding))) for j in STRAIGHT_JOINTS}
    for row in PUBLISHED:
        sizes, *corners = row.split()
        assert tuple(map(float, (*sizes.split("x"), *corners))) in made
    # beyond that list stand the eight largest of the heavy series and all d1, of another reader of the standard
    assert len(made) == len(PUBLISHED) + 8
    assert all(joint.root < joint.inner for joint in STRAIGHT_JOINTS)


# D, m and z of GOST 6033-80, of memory: no table of the standard was at hand; d_B x m x z of DIN 5480 from designations
# that its sellers and textbooks show (N 120 x 3 x 38, N 45 x 2 x 21, W 30 x 2 x 14, W 25 x 1.25 x 18, W 50 x 2 x 24)
@pytest.mark.parametrize(
    ("diameter", "module", "teeth"),
    [(50, 2, 24), (20, 1, 18), (40, 2, 18), (60, 2.5, 22), (80, 3, 25), (120, 3, 38), (45, 2, 21), (30, 2, 14),
     (25, 1.25, 18)],
)  # fmt: skip
def test_the_number_of_teeth_follows_from_the_diameter(diameter: float, module: float, teeth: int) -> None:
    assert teeth_of(diameter, module)[0] == teeth


def test_relations_of_gost_6033() -> None:
    """Those that Inventor's help has for GOST: D, D_f, D_a, d_f, d_a, s, with m = 2, z = 24, x m = -0.1."""
    assert GOST.hub_diameters == pytest.approx((50 - 2 * 2, 50))
    assert GOST.shaft_diameters == pytest.approx((50 - 2.2 * 2, 50 - 0.2 * 2))
    assert GOST.thickness == pytest.approx(math.pi / 2 * 2 + 2 * -0.1 * math.tan(math.pi / 6))
    fillet, outer = JOINTS["round roots"], JOINTS["by the outer diameter"]
    assert isinstance(fillet, InvoluteJoint)
    assert isinstance(outer, InvoluteJoint)
    assert (fillet.shaft_diameters[0], fillet.hub_diameters[1]) == pytest.approx((50 - 2.76 * 2, 50 + 0.44 * 2))
    assert outer.shaft_diameters[1] == outer.hub_diameters[1] == 60


@pytest.mark.parametrize(
    ("angle", "root", "sizes"),
    [(30.0, "flat", (56.25, 62.5, 57.74, 63.75)), (30.0, "fillet", (55.5, 62.5, 57.74, 64.5)),
     (37.5, "fillet", (56.5, 62.25, 57.86, 63.5)), (45.0, "fillet", (57.0, 62.0, 58.05, 63.0))],
)  # fmt: skip
def test_diameters_of_iso_4156(angle: float, root: str, sizes: tuple[float, ...]) -> None:
    """D_ie, D_ee, D_ii, D_ei of 24z x 2.5m from m (z + k), k as Inventor's help lists it; D_ii by mpmath from D_Fe."""
    joint = iso_4156(24, 2.5, angle, root)
    assert (*joint.shaft_diameters, *joint.hub_diameters) == pytest.approx(sizes, abs=5e-3)


@pytest.mark.parametrize("size", [(30.0, "flat"), (30.0, "fillet"), (37.5, "fillet"), (45.0, "fillet")])
def test_sides_of_iso_4156_reach_its_form_diameters(size: tuple[float, Root]) -> None:
    """D_Fe by h_s, and D_Fi = m (z + 1, 0.9, 0.8) + 2 c_F, c_F = 0.1 m. Before, one arc filled roots of 37.5 and 45."""
    alpha, (height, tip) = mpmath.radians(size[0]), {30: (0.6, 1.0), 37.5: (0.55, 0.9), 45: (0.5, 0.8)}[size[0]]
    for teeth in (6, 7, 8, 9, 12, 30, 100, 200):
        joint = iso_4156(teeth, 1.0, *size)
        along = teeth / 2 * mpmath.sin(alpha) - height / mpmath.sin(alpha)
        least, most = 2 * mpmath.hypot(teeth / 2 * mpmath.cos(alpha), along), teeth + tip + 0.2
        assert joint.form_diameters == pytest.approx((float(least), most), rel=1e-12)
        shaft, hub = joint.shaft(), joint.hub()
        assert shaft.side_diameters[0] <= least
        assert hub.side_diameters[1] >= most
        # roots are as round as in the standard; in the narrow slots of few teeth one arc goes from side to side
        rho = 0.2 if size[1] == "flat" else {30.0: 0.4, 37.5: 0.3, 45.0: 0.25}[size[0]]
        assert shaft.root_rounding == rho
        assert hub.crest_rounding == rho or (0.85 * rho < hub.crest_rounding < rho and teeth < 11)


@pytest.mark.sampled(2)
@pytest.mark.parametrize("distance", [-0.25, -0.02, 0.02, 0.25])
@pytest.mark.parametrize("name", ["ISO 4156, 6 teeth", "DIN 5480, 6 teeth"])
def test_sides_below_the_base_circle_have_parallels(name: str, distance: float) -> None:
    joint, lines = JOINTS[name], list[Line]()
    for form in (joint.shaft(), joint.hub()):
        whole, moved = polygon(form.outline()), polygon(form.outline(distance))
        assert moved.is_valid
        assert moved.symmetric_difference(whole.buffer(distance, quad_segs=90)).area < 3e-4 * moved.length
        flanks = (s.curve for s in form.outline(distance).segments() if s.label is Label.FLANK)
        lines += [curve for curve in flanks if isinstance(curve, Line)]
    assert lines
    # beside the radius that the side was, by as much as it has moved
    for line in lines:
        start, along = line.point(np.array([0.0]))[0], line.tangent(np.array([0.0]))[0]
        assert abs((start * along.conjugate()).imag) == pytest.approx(abs(distance), rel=1e-9)


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", JOINTS)
def test_a_shaft_goes_into_its_hub_and_does_not_turn_there(name: str) -> None:
    joint = JOINTS[name]
    shaft, hub = polygon(joint.shaft().outline()), polygon(joint.hub().outline())
    assert shaft.is_valid
    assert hub.is_valid
    # chords of two curves that lie on each other cut no more than they bulge
    assert shaft.difference(hub.buffer(1e-3)).is_empty
    # turned by a fifth of a degree it is stopped by the sides
    assert shapely.affinity.rotate(shaft, 0.2, (0, 0)).difference(hub.buffer(1e-3)).area > 1e-3


def test_a_rounding_that_an_offset_uses_up_is_a_corner() -> None:
    """0.2 * 1.5 - 0.3 is 5e-17: an arc of no spoke was drawn about it, which ended in a division by zero."""
    form = iso_4156(20, 1.5, 30.0, "flat").hub()
    assert 0 < form.crest_rounding - 0.3 < 1e-15
    lost, nearly = (polygon(form.outline(distance)) for distance in (-0.3, -0.3 + 1e-9))
    assert lost.symmetric_difference(nearly).area < 1e-6
    assert len([s for s in form.outline(-0.3).segments() if s.label is Label.TIP_BREAK]) == 0


@pytest.mark.parametrize("name", ["own", "GOST 6033", "ISO 4156, 37.5R"])
def test_areas_by_quadrature(name: str) -> None:
    """Shells about the axis, with sharp corners."""
    joint = JOINTS[name]
    form = replace(joint.hub(), crest_rounding=0.0)

    def half_angle(radius: float) -> float:
        if isinstance(joint, StraightJoint):
            return float(mpmath.asin(joint.width / 2 / radius))
        reference, alpha = joint.module * joint.teeth / 2, joint.pressure_angle
        found = mpmath.acos(reference * mpmath.cos(alpha) / radius)
        return float(joint.thickness / 2 / reference + mpmath.tan(alpha) - alpha - mpmath.tan(found) + found)

    slots = float(mpmath.quad(lambda r: 2 * r * half_angle(r), [form.inner, form.outer]))
    assert profile_area(form.outline()) == pytest.approx(math.pi * form.inner**2 + joint.teeth * slots, rel=1e-12)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("play", [0.0, 0.03, -0.04])
@pytest.mark.parametrize("name", [name for name, joint in JOINTS.items() if isinstance(joint, InvoluteJoint)])
def test_pins_touch_the_sides_they_are_measured_on(name: str, play: float) -> None:
    """By brute force on the outline itself; M of a shaft, and W, are those of the gear with its teeth."""
    joint = JOINTS[name]
    assert isinstance(joint, InvoluteJoint)
    for is_shaft, form in ((True, joint.shaft()), (False, joint.hub())):
        found, way = joint.measured(play, is_shaft=is_shaft), 1 if is_shaft else -1
        half_turn = math.cos(math.pi / 2 / joint.teeth) if joint.teeth % 2 else 1.0
        centre = (found.over_pins - way * found.pin_diameter) / 2 / half_turn
        turn = math.pi / joint.teeth if is_shaft else 0.0
        near = distance_to_profile(np.array([centre * np.exp(1j * turn)]), form.outline(play))
        assert near == pytest.approx([found.pin_diameter / 2], rel=1e-12)
    teeth = joint.measured(play, is_shaft=True)
    slack = math.pi / 2 * joint.module - joint.thickness - 2 * play / math.cos(joint.pressure_angle)
    shift = -slack / 2 / math.tan(joint.pressure_angle) / joint.module
    gear = SpurGear(joint.module, joint.teeth, BasicRack(joint.pressure_angle, 0.4, 0.3, 0.1), shift)
    assert teeth.thickness == pytest.approx(gear.reference_thickness)
    assert teeth.over_pins == pytest.approx(over_pins(gear, teeth.pin_diameter).length, rel=1e-12)
    assert teeth.span == pytest.approx(span(gear, teeth.teeth_spanned).length, rel=1e-12)


@pytest.mark.parametrize(
    ("joint", "clearance", "key"),
    [(StraightJoint(6, 23.0, 26.0, 12.1, 23.0), 0.0, "bore.size"),
     (StraightJoint(6, 26.0, 23.0, 6.0, 26.0), 0.0, "bore.size"),
     (replace(din_5480(30.0, 2.0, 14), thickness=9.0), 0.0, "bore.size"),
     (STRAIGHT_JOINTS[0], 3.2, "bore.clearance")],
)  # fmt: skip
def test_what_is_no_spline_is_refused(joint: StraightJoint | InvoluteJoint, clearance: float, key: str) -> None:
    with pytest.raises(ParameterError) as caught:
        SplineBore(joint, ("bore.size", ""), clearance).check()
    assert caught.value.name == key

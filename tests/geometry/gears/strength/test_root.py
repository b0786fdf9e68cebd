"""The critical section of the root: against brute force, against ISO 6336-3's closed form, and where there is none."""

from __future__ import annotations

import cmath
import math

import mpmath
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from geometry.base.errors import GeometryError
from geometry.base.record import replace
from geometry.base.roots import bracketed_root
from geometry.gears.strength.root import (
    RootSection,
    form_factor,
    lever_arm,
    root_load,
    root_section,
    stress_correction,
    virtual_gear,
    virtual_share,
)
from geometry.gears.teeth.basic_rack import BasicRack, iso_53
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_tooth import rounded_root_plug
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.transverse import transverse_gear
from geometry.gears.teeth.transverse_ring import transverse_ring
from tests.oracles.root_tangent import cutter_corner, rack_corner, touched
from tests.sampling import examples

TEETH, SHIFTS, HELICES = st.integers(8, 150), st.floats(-0.3, 0.8), st.floats(0.0, 0.6)
THINNINGS, ROUNDINGS = st.floats(0.0, 0.2), st.floats(0.15, 0.38)


def rack_cut(teeth: int, shift: float, thinning: float = 0.0, rounding: float = 0.38, **more: object) -> SpurGear:
    rack = BasicRack(math.radians(20), 1.0, 0.25, rounding)
    return SpurGear(2.0, teeth, rack, shift, circumferential_thinning=thinning, **more)  # type: ignore[arg-type]


def same(section: RootSection, oracle: tuple[object, object, object]) -> None:
    found = section.thickness, section.radius, section.distance
    assert found == pytest.approx([float(x) for x in oracle], rel=1e-8)  # type: ignore[arg-type]


@examples(25)
@given(TEETH, SHIFTS, HELICES, THINNINGS, ROUNDINGS, st.booleans())
def test_the_section_of_a_rack_cut_tooth_by_brute_force(
    teeth: int, shift: float, helix: float, thinning: float, rounding: float, deeper: bool
) -> None:
    """Virtual gears of helical teeth too: their rack is the one that was typed, their number of teeth no whole one."""
    gear = rack_cut(teeth, shift, thinning, rounding, thinning_by_deeper_cut=deeper)
    virtual = virtual_gear(transverse_gear(gear, helix), helix)
    try:
        section = root_section(virtual)
    except GeometryError:
        section = None
    assume(section is not None)
    assert section is not None
    normal = thinning * math.cos(helix)
    own = shift - normal / (4 * math.tan(math.radians(20))) if deeper else shift
    with mpmath.workdps(30):
        alpha = math.atan(math.tan(math.radians(20)) / math.cos(helix))
        base = math.asin(math.sin(helix) * math.cos(math.radians(20)))
        assert math.tan(base) == pytest.approx(math.tan(helix) * math.cos(alpha), rel=1e-12)
        number = mpmath.mpf(teeth) / (mpmath.cos(base) ** 2 * mpmath.cos(helix))
        wider = 0.0 if deeper else normal / 2
        outline = rack_corner(number, mpmath.mpf(2), mpmath.radians(20), mpmath.mpf(1.25), mpmath.mpf(rounding),
                              mpmath.mpf(own), mpmath.mpf(wider))  # fmt: skip
        # to start from: where the common normal leans as much
        height = (1.25 - rounding - own) * 2
        start = -math.pi / 2 * 2 + float(math.pi / 2 + wider - (1.25 - rounding) * 2 * math.tan(math.radians(20))
                                         - 2 * rounding / math.cos(math.radians(20)))  # fmt: skip
        near = (height * math.tan(section.parameter) - start) / float(number)
        same(section, touched(outline, 30, near - 1e-4, near + 1e-4))


def standard_form(gear: SpurGear, ratio: float, tip: float) -> tuple[float, float, float, float]:
    """s_Fn, rho_F, h_Fe and alpha_Fen by the formulas of ISO 6336-3, 6, of a spur gear without thinning; mm and rad."""
    m, z, x, alpha = gear.module, gear.number_of_teeth, gear.profile_shift_coefficient, gear.rack.pressure_angle
    depth, rho = gear.rack.dedendum, gear.rack.tip_radius
    wide = math.pi / 4 * m - depth * m * math.tan(alpha) - (1 - math.sin(alpha)) * rho * m / math.cos(alpha)
    g, h = rho - depth + x, 2 / z * (math.pi / 2 - wide / m) - math.pi / 3
    theta = bracketed_root(lambda t: t - 2 * g / z * math.tan(t) + h, 0.0, math.pi / 2 - 1e-9).value
    thick = z * math.sin(math.pi / 3 - theta) + math.sqrt(3) * (g / math.cos(theta) - rho)
    radius = rho + 2 * g**2 / (math.cos(theta) * (z * math.cos(theta) ** 2 - 2 * g))
    base = m * z * math.cos(alpha)
    loaded = math.sqrt((tip / 2) ** 2 - (base / 2) ** 2) - math.pi * m * math.cos(alpha) * (ratio - 1)
    circle = 2 * math.sqrt(loaded**2 + (base / 2) ** 2)
    inv = [math.tan(a) - a for a in (alpha, math.acos(base / circle))]
    gamma = (math.pi / 2 + 2 * math.tan(alpha) * x) / z + inv[0] - inv[1]
    angle = math.acos(base / circle) - gamma
    arm = (math.cos(gamma) - math.sin(gamma) * math.tan(angle)) * circle / m
    arm = (arm - z * math.cos(math.pi / 3 - theta) - (g / math.cos(theta) - rho)) / 2
    return thick * m, radius * m, arm * m, angle


@examples(50)
@given(st.integers(12, 150), SHIFTS, st.floats(1.0, 1.9))
def test_the_standards_closed_form_is_that_of_a_rack_cut_tooth(teeth: int, shift: float, ratio: float) -> None:
    gear = rack_cut(teeth, shift)
    section = root_section(gear)
    assume(section is not None)
    assert section is not None
    load = root_load(gear, gear.tip_radius, ratio)
    found = section.thickness, section.radius, lever_arm(gear, section, load), load.angle
    right = standard_form(gear, ratio, 2 * gear.tip_radius)
    assert found == pytest.approx(right, rel=1e-9, abs=1e-10)
    form = 6 * right[2] * 2 * math.cos(right[3]) / (right[0] ** 2 * math.cos(math.radians(20)))
    assert form_factor(gear, section, load) == pytest.approx(form, rel=1e-9)


def test_a_thinner_tooth_has_another_section_than_the_standards_form() -> None:
    """The negative control, and the point of an exact fillet: a tenth of the module is a tenth of Y_F."""
    thin, plain = rack_cut(20, 0.0, 0.2), rack_cut(20, 0.0)
    sections = [root_section(g) for g in (thin, plain)]
    forms = [
        form_factor(g, s, root_load(g, g.tip_radius, 1.6)) for g, s in zip((thin, plain), sections, strict=True) if s
    ]
    assert forms[0] / forms[1] == pytest.approx(1.11, abs=0.03)
    assert abs(sections[0].thickness - standard_form(plain, 1.6, 44)[0]) > 0.1  # type: ignore[union-attr]


@examples(12)
@given(st.integers(17, 80), st.floats(0.0, 0.6), st.integers(20, 40))
def test_the_section_that_a_pinion_cutter_leaves_by_brute_force(teeth: int, shift: float, own: int) -> None:
    cutter = PinionCutter(2.0, own, math.radians(20))
    gear = replace(rack_cut(teeth, shift), cutter=cutter)
    section = root_section(gear)
    assume(section is not None)
    assert section is not None
    total = teeth + own
    rolling = [gear.generating_distance * n / total for n in (teeth, own)]
    fillet = gear.fillet()
    with mpmath.workdps(30):
        outline = cutter_corner(mpmath.mpf(rolling[0]), teeth, mpmath.mpf(rolling[1]), mpmath.mpf(cutter.corner_radius),
                                mpmath.mpf(cutter.corner_angle), mpmath.mpf(cutter.rounding_radius), 1)  # fmt: skip
        near = nearest_roll(outline, complex(fillet.point(section.parameter)))
        same(section, touched(outline, 30, near - 1e-4, near + 1e-4))


@examples(12)
@given(st.integers(50, 120), st.floats(-0.3, 0.5), st.integers(18, 30))
def test_the_section_of_a_ring_by_brute_force(teeth: int, shift: float, own: int) -> None:
    cutter = PinionCutter(2.0, own, math.radians(20))
    ring = RingGear(2.0, teeth, math.radians(20), 1e9, cutter, shift)
    section = root_section(ring)
    assume(section is not None)
    assert section is not None
    rolling = [ring.generating_distance * n / (teeth - own) for n in (teeth, own)]
    point = complex(ring.fillet().point(section.parameter)) * complex(
        math.cos(math.pi / teeth), math.sin(math.pi / teeth)
    )
    with mpmath.workdps(30):
        outline = cutter_corner(mpmath.mpf(rolling[0]), teeth, mpmath.mpf(rolling[1]), mpmath.mpf(cutter.corner_radius),
                                mpmath.mpf(cutter.corner_angle), mpmath.mpf(cutter.rounding_radius), -1)  # fmt: skip
        near = nearest_roll(outline, point)
        same(section, touched(outline, 60, near - 1e-4, near + 1e-4))


def nearest_roll(outline: object, point: complex) -> float:
    """The roll at which an outline comes nearest to a point, by a fine search: to start from."""
    low, high = -0.6, 0.6
    for _ in range(6):
        rolls = [low + (high - low) * k / 60 for k in range(61)]
        best = min(rolls, key=lambda r: abs(complex(outline(r)) - point))  # type: ignore[operator]
        low, high = best - (high - low) / 60, best + (high - low) / 60
    return (low + high) / 2


def test_the_section_of_a_ring_with_a_rounded_root_lies_on_its_arc() -> None:
    """From the middle of the arc, off the normal of the tangent, whose angle is 60 degrees, by the radius."""
    ring = RingGear(2.0, 60, math.radians(20), 1e9, RoundedRoot(1.25, 0.3), 0.2)
    plug = rounded_root_plug(ring)
    middle = cmath.rect(plug.corner_radius, math.pi / 60 - plug.corner_angle)
    touching = middle + 0.6 * cmath.exp(-1j * math.pi / 6)
    section = root_section(ring)
    assert section is not None
    found = section.thickness, section.radius, section.distance
    assert found == pytest.approx((2 * touching.imag, 0.6, touching.real), rel=1e-12)


def test_the_virtual_gear_of_straight_teeth_is_the_gear_itself() -> None:
    for gear in (
        rack_cut(23, 0.2, 0.1),
        RingGear(2.0, 60, math.radians(20), 1e9, PinionCutter(2.0, 25, math.radians(20))),
    ):
        virtual = virtual_gear(gear, 0.0)
        assert virtual_share(gear.pressure_angle, 0.0) == 1
        assert root_section(virtual) == root_section(gear)
        assert virtual.tip_radius == pytest.approx(gear.tip_radius, rel=1e-15)


def test_virtual_teeth_of_a_helix_have_the_rack_that_was_typed() -> None:
    helix = math.radians(25)
    for normal in (rack_cut(23, 0.2), replace(rack_cut(23, 0.2), cutter=PinionCutter(2.0, 25, math.radians(20)))):
        virtual = virtual_gear(transverse_gear(normal, helix), helix)
        assert isinstance(virtual, SpurGear)
        assert virtual.module == pytest.approx(2, rel=1e-14)
        assert virtual.rack.tip_radius == pytest.approx(0.38, rel=1e-14)
        assert virtual.rack.stretch == pytest.approx(1, rel=1e-14)
        assert virtual.profile_shift_coefficient == pytest.approx(0.2, rel=1e-14)
        assert root_section(virtual) is not None
    ring = RingGear(2.0, 60, math.radians(20), 1e9, RoundedRoot())
    turned = virtual_gear(transverse_ring(ring, helix), helix)
    assert isinstance(turned, RingGear)
    assert turned.pressure_angle == pytest.approx(math.radians(20), rel=1e-14)
    assert root_section(turned) is not None


def test_a_cutter_of_so_many_teeth_leaves_a_helix_the_section_of_its_rack() -> None:
    """Its rounding and its height are those of the normal section, whatever the helix: those of the rack in the end."""
    helix, found = 0.5, []
    for cutter in (None, PinionCutter(2.0, 20_000, math.radians(20), addendum=1.25, tip_rounding=0.3)):
        gear = transverse_gear(rack_cut(40, 0.2, rounding=0.3, cutter=cutter), helix)
        section = root_section(virtual_gear(gear, helix))
        assert section is not None
        found.append((section.thickness, section.radius, section.distance))
    assert found[1] == pytest.approx(found[0], rel=2e-3)


def test_a_rounded_root_of_a_helical_ring_is_as_deep_in_its_normal_section() -> None:
    """Heights along a radius are the same in both sections, and so is the arc that was typed in normal modules."""
    ring = RingGear(2.0, 60, math.radians(20), 1e9, RoundedRoot(1.25, 0.3))
    section = transverse_ring(ring, 0.5)
    virtual = virtual_gear(section, 0.5)
    assert isinstance(virtual, RingGear)
    assert virtual.root_radius - virtual.reference_radius == pytest.approx(2.0 * 1.25)
    assert virtual.root == RoundedRoot(pytest.approx(1.25), pytest.approx(0.3))


def test_where_no_tangent_touches_there_is_no_section() -> None:
    """A ring with a root of no rounding has a corner, and a rack of 35 degrees flanks steeper than the tangent."""
    assert root_section(RingGear(2.0, 60, math.radians(20), 1e9, RoundedRoot(1.25, 0.0))) is None
    steep = SpurGear(2.0, 200, BasicRack(math.radians(35), 0.8, 0.2, 0.1))
    assert root_section(steep) is None
    assert root_section(SpurGear(2.0, 20, iso_53("A"))) is not None


def test_the_stress_correction_by_hand() -> None:
    """Y_S of the test gear of ISO 6336-5: q_s 2.5 and s_Fn = 2 h_Fe or so gives 2, by which Y_ST is defined."""
    assert stress_correction(2.0, 1.0, 2.5) == pytest.approx(1.46 * 2.5 ** (1 / 2.36), rel=1e-15)
    assert stress_correction(2.0, 1.0, 2.5) == pytest.approx(2.0, abs=0.2)

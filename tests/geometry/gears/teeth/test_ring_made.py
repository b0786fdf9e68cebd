"""Rings whose cutter nobody named, and whose default tip no cutter leaves: made as deep as can be cut."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.pairs.internal import internal_pair
from geometry.gears.teeth import ring_limits
from geometry.gears.teeth.cutter import PinionCutter, checked_cutter
from geometry.gears.teeth.limits import checked_gear
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_limits import checked_ring
from geometry.gears.teeth.ring_made import DEFAULT_CUTTER_TEETH, makes, settled_ring
from geometry.gears.teeth.ring_tooth import ring_side
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Label
from parts.gears.spur_gear.part import basic_rack_of
from tests import brute
from tests.geometry.gears.teeth.test_ring import tool_of
from tests.oracles.cutter_sweep import least_distance
from tests.sampling import examples
from tests.strategies import numbers


def bare(teeth: int, degrees: float, x: float = 0.0, module: float = 1.0, **keys: object) -> RingGear:
    """A ring whose keys name no cutter."""
    angle = math.radians(degrees)
    return RingGear(module, teeth, angle, 1e9, PinionCutter(module, 25, angle), x, any_cutter=True, **keys)  # type: ignore[arg-type]


def trimmed(gear: RingGear) -> float:
    """How far the swept cutter reaches into the flank, a part of the root radius; 0 but for rounding: it leaves it."""
    flank = brute.dense(next(s.curve for s in ring_side(gear).segments if s.label is Label.FLANK), 200)
    least = least_distance(flank, tool_of(gear), gear.number_of_teeth, gear.generating_distance, reach=2.5).min()
    return -float(least) / gear.root_radius


SMALL = {
    "z 30, 20 deg": bare(30, 20.0), "z 30, KHK": bare(30, 20.0, plain_tip=True), "z 20": bare(20, 20.0),
    "z 40, m 0.8, 32 deg": bare(40, 32.0, module=0.8), "z 24, 25 deg": bare(24, 25.0, plain_tip=True),
    "z 34: an unusual cutter": bare(34, 20.0), "z 42, KHK: an unusual cutter": bare(42, 20.0, plain_tip=True),
    "z 45, 14.5 deg": bare(45, 14.5), "z 36, x -0.5": bare(36, 20.0, -0.5), "z 26, x 0.5, KHK": bare(26, 20.0, 0.5),
}  # fmt: skip
EVERY = pytest.mark.parametrize("gear", SMALL.values(), ids=SMALL.keys())


@pytest.mark.sampled(4)
@EVERY
def test_small_rings_are_made_and_nothing_trims_their_tips(gear: RingGear) -> None:
    made = checked_ring(settled_ring(gear))
    assert made.cutter is not None
    checked_cutter(made.cutter)
    assert made.tip_radius >= made.base_radius
    assert trimmed(made) <= 1e-12


@pytest.mark.sampled(1)
@EVERY
def test_a_tip_that_yields_is_the_deepest_that_any_cutter_leaves(gear: RingGear) -> None:
    """A hundredth of a module deeper, and every cutter there is reaches into the flank, or there is no involute."""
    made = settled_ring(gear)
    deeper = made.tip_radius - 0.01 * gear.module
    if made.tip_radius == made.default_tip_radius:
        assert made.least_tip_diameter == 0
        return
    for teeth in range(8, gear.number_of_teeth - 1):
        root = replace(made.root, number_of_teeth=teeth, tip_rounding=0.0)  # type: ignore[arg-type]
        tried = replace(made, root=root, given_tip_diameter=2 * deeper)
        if deeper >= gear.base_radius and brute.refusal(lambda g=tried: ring_side(g)) is None:  # type: ignore[misc]
            mesh = ring_limits.generation(tried)
            assert mesh is not None
            fed_in = mesh.radial_assembly().margin >= 0
            assert trimmed(tried) > 1e-9 or not fed_in, teeth


def test_usual_cutters_come_first_and_the_largest_of_them() -> None:
    for teeth in (60, 80, 120, 300):
        made = settled_ring(bare(teeth, 20.0))
        assert isinstance(made.root, PinionCutter)
        assert made.root.number_of_teeth in DEFAULT_CUTTER_TEETH
        larger = [z for z in DEFAULT_CUTTER_TEETH if made.root.number_of_teeth < z < teeth]
        for z in larger:
            assert not makes(replace(made, root=replace(made.root, number_of_teeth=z), any_cutter=False))


def test_a_cutter_that_would_be_pointed_is_shorter() -> None:
    made = settled_ring(bare(40, 32.0, module=0.8))
    assert isinstance(made.root, PinionCutter)
    assert made.root.addendum < 1.25
    assert 2 * replace(made.root, tip_rounding=0.0).corner_angle * made.root.tip_radius == pytest.approx(0.08)


@pytest.mark.parametrize("root", [RoundedRoot(), PinionCutter(1.0, 14, math.radians(20.0))], ids=["rounded", "named"])
def test_the_tip_yields_to_a_named_cutter_and_to_the_base_circle(root: PinionCutter | RoundedRoot) -> None:
    gear = replace(bare(30, 20.0, plain_tip=True), root=root, any_cutter=False)
    made = checked_ring(settled_ring(gear))
    assert made.base_radius <= made.tip_radius < made.reference_radius
    if isinstance(root, RoundedRoot):
        assert made.tip_radius == pytest.approx(made.base_radius)


def test_a_named_cutter_is_refused_where_another_leaves_the_default_tip() -> None:
    gear = replace(bare(60, 20.0), root=PinionCutter(1.0, 55, math.radians(20.0)), any_cutter=False)
    with pytest.raises(ParameterError) as refused:
        checked_ring(settled_ring(gear))
    assert refused.value.name == "cutter.number_of_teeth"


def test_a_given_tip_never_yields() -> None:
    gear = settled_ring(bare(30, 20.0, given_tip_diameter=27.0))
    with pytest.raises(ParameterError, match="involute_ends_at_base_circle") as refused:
        checked_ring(gear)
    assert refused.value.name == "tip_diameter"
    named = brute.works(refused.value)
    assert 28.6 <= named < 28.7
    checked_ring(settled_ring(bare(30, 20.0, given_tip_diameter=named)))


@given(st.integers(16, 60), st.sampled_from([14.5, 20.0, 25.0, 30.0, 32.0]), numbers(-0.5, 1.5), st.booleans())
@examples(15)
def test_any_small_ring_is_refused_with_reason_or_what_its_cutter_leaves(
    teeth: int, degrees: float, x: float, plain: bool
) -> None:
    gear = settled_ring(bare(teeth, degrees, x, plain_tip=plain))
    assume(brute.refusal(lambda: checked_ring(gear)) is None)
    assert trimmed(gear) <= 1e-12


@pytest.mark.sampled(1)
@pytest.mark.parametrize(("ring", "pinion", "degrees"), [(30, 17, 20.0), (40, 17, 32.0), (24, 10, 20.0)])
def test_pairs_with_small_rings_touch_and_do_not_overlap(ring: int, pinion: int, degrees: float) -> None:
    hole = checked_ring(settled_ring(bare(ring, degrees)))
    gear = checked_gear(SpurGear(1.0, pinion, basic_rack_of("ISO 53 A", math.radians(degrees))))
    pair = internal_pair(gear, hole)
    found = GearMesh(pair).contact()
    assert found.verdict.value == "contact"
    assert pair.effective_contact_ratio > 1
    # negative control: a tooth of the pinion shifted into the flank overlaps
    assert GearMesh(pair, second_turn=1e-4).contact().verdict.value == "overlap"


def test_lengths_scale_with_the_module() -> None:
    one, two = (settled_ring(bare(30, 20.0, module=m)) for m in (0.01, 900.0))
    assert one.tip_radius * 900.0 / 0.01 == pytest.approx(two.tip_radius, rel=1e-9)
    assert np.isfinite(one.root_radius)

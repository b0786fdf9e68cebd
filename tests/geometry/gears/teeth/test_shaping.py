"""External gears cut by a pinion cutter: outline against the swept cutter, undercut, the rack as a limit, refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.mesh.gears import GearMesh
from geometry.gears.pairs.external import external_pair
from geometry.gears.teeth.basic_rack import TipRelief, iso_53
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.limits import checked_gear, least_shift_without_undercut
from geometry.gears.teeth.offset import gear_region
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.plane.distance import Verdict
from geometry.plane.profile import Label, joint_turn
from tests import brute
from tests.oracles.cutter_sweep import CutterTool, least_distance
from tests.sampling import examples
from tests.strategies import numbers

ALPHA = math.radians(20.0)
RIGHT = 1e-12


def shaped(
    teeth: int, cutter_teeth: int, x: float = 0.0, x0: float = 0.0, rho: float = 0.2, **keys: object
) -> SpurGear:
    cutter = PinionCutter(2.0, cutter_teeth, ALPHA, x0, tip_rounding=rho)
    return SpurGear(2.0, teeth, iso_53(), x, cutter=cutter, **keys)  # type: ignore[arg-type]


CASES = {
    "usual": shaped(23, 25),
    "undercut": shaped(10, 30, -0.1, 0.2, 0.1),
    "sharp and thinned": shaped(40, 20, 0.5, 0.3, 0.0, circumferential_thinning=0.2),
    "deeper cut": shaped(40, 20, 0.5, -0.1, circumferential_thinning=0.2, thinning_by_deeper_cut=True),
    "large": shaped(200, 100, 0.0, 0.0, 0.25),
}


def sweep_distance(gear: SpurGear, points: int = 100) -> np.ndarray:
    """Least distance of the swept cutter from root, fillet and flank, as a part of the tip radius."""
    cutter = gear.cutter
    assert cutter is not None
    thick = 0.0 if gear.thinning_by_deeper_cut else gear.circumferential_thinning / 2
    tool = CutterTool(2.0, cutter.number_of_teeth, ALPHA, cutter.profile_shift_coefficient, cutter.addendum,
                      cutter.tip_rounding, thick)  # fmt: skip
    labels = (Label.ROOT_LAND, Label.ROOT_FILLET, Label.FLANK)
    outline = np.concatenate([brute.dense(s.curve, points) for s in tooth_side(gear).segments if s.label in labels])
    # the oracle's space stands on +x
    turned = outline * np.exp(1j * math.pi / gear.number_of_teeth)
    return least_distance(turned, tool, -gear.number_of_teeth, gear.generating_distance) / gear.tip_radius


@pytest.mark.sampled(2)
@pytest.mark.parametrize("gear", CASES.values(), ids=CASES.keys())
def test_outline_against_the_swept_cutter(gear: SpurGear) -> None:
    checked_gear(gear)
    assert np.abs(sweep_distance(gear)).max() <= RIGHT
    wrong = replace(gear, cutter=replace(gear.cutter, addendum=1.25 + 1e-6))  # type: ignore[type-var]
    outline = np.concatenate([brute.dense(s.curve, 40) for s in tooth_side(wrong).segments])
    assert abs(np.abs(outline).min() - gear.root_radius + 2e-6) <= 1e-10


@given(st.integers(8, 120), st.integers(12, 60), numbers(-0.4, 1.0), numbers(-0.3, 0.5), numbers(0, 0.3))
@examples(15)
def test_any_gear_that_is_not_refused_is_what_its_cutter_leaves(
    teeth: int, cutter_teeth: int, x: float, x0: float, rounding: float
) -> None:
    gear = shaped(teeth, cutter_teeth, x, x0, rounding)
    assume(brute.refusal(lambda: checked_gear(gear)) is None)
    assert np.abs(sweep_distance(gear, 40)).max() <= RIGHT


def test_root_diameter_follows_from_the_cutters_distance() -> None:
    """inv alpha_w0 = inv alpha + 2 (x + x0) tan alpha / (z + z0), r_f = a_0 - r_a0."""
    gear = shaped(17, 20, 0.1, 0.2)
    angle = inverse_involute(involute_function(ALPHA) + 2 * 0.3 * math.tan(ALPHA) / 37)
    distance = 37 * math.cos(ALPHA) / math.cos(angle)
    assert gear.root_radius == pytest.approx(distance - (20 + 2 * (1.25 + 0.2)), rel=1e-14)
    assert shaped(17, 20, 0.1, -0.1).root_radius == pytest.approx(17 - 2 * (1.25 - 0.1), rel=1e-14)


def test_undercut_begins_at_the_least_shift() -> None:
    for teeth, cutter_teeth in ((8, 20), (12, 40), (17, 100)):
        gear = shaped(teeth, cutter_teeth)
        limit = least_shift_without_undercut(gear)

        def corner(shift: float, g: SpurGear = gear) -> float:
            side = tooth_side(replace(g, profile_shift_coefficient=shift))
            index = next(i for i, s in enumerate(side.segments) if s.label is Label.FLANK)
            return abs(joint_turn(side.segments[index - 1].curve, side.segments[index].curve))

        assert corner(limit + 1e-3) <= 1e-7
        assert corner(limit - 1e-2) > 1e-3


def test_a_very_large_cutter_is_a_rack() -> None:
    rack_cut = SpurGear(2.0, 40, iso_53())
    wide = [shaped(40, z, rho=0.38) for z in (1000, 10_000)]
    points = [np.concatenate([brute.dense(s.curve, 50) for s in tooth_side(g).segments]) for g in wide]
    errors = [brute.distance_to_outline(p, tooth_side(rack_cut).profile()).max() for p in points]
    assert errors[0] < 5e-3
    assert errors[1] == pytest.approx(errors[0] / 10, rel=0.1)


@pytest.mark.parametrize("offset", [-0.3, 0.1, 0.5])
def test_offsets_lie_at_their_distance(offset: float) -> None:
    gear = shaped(23, 25)
    outline, moved = (gear_region(gear, d).region.outer for d in (0.0, offset))
    points = brute.period_points(moved, 40)
    assert np.abs(brute.distance_to_outline(points, outline) - abs(offset)).max() <= 1e-9


def test_contact_of_shaped_gears() -> None:
    pair = external_pair(shaped(23, 40), shaped(31, 40, 0.1))
    found = GearMesh(pair).contact()
    assert found.verdict is Verdict.CONTACT
    assert np.abs(np.array(found.side_gaps)).max() <= 1e-8 * 2
    assert GearMesh(pair, second_turn=1e-6).contact().verdict is Verdict.OVERLAP


def test_refusals() -> None:
    relieved = replace(shaped(23, 25), rack=iso_53(relief=TipRelief(0.02)))
    cases = {
        "tip_diameter": replace(shaped(60, 12), given_tip_diameter=126.0),
        "cutter.addendum": shaped(60, 8, 0.0, 0.5, 0.0),
        "cutter.tip_rounding": shaped(23, 25, rho=0.9),
        "cutter.module": replace(shaped(23, 25), cutter=PinionCutter(3.0, 25, ALPHA)),
        "cutter.pressure_angle": replace(shaped(23, 25), cutter=PinionCutter(2.0, 25, 0.3)),
        "relief.depth": relieved,
        "cutter.number_of_teeth": shaped(23, 1_000_000),
    }
    for name, gear in cases.items():
        refused = brute.refusal(lambda g=gear: checked_gear(g))  # type: ignore[misc]
        assert isinstance(refused, ParameterError), name
        assert refused.name == name
        # a cutter that is pointed at any height has no addendum that works
        assert refused.nearest is not None or name == "cutter.addendum"

"""Sliding against the velocities of the touching points; readings off the outline against the involute."""

from __future__ import annotations

import cmath
import math

import pytest

from geometry.base.errors import ParameterError
from geometry.gears.pairs.external import ExternalPair, external_pair
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.pairs.sliding import active_line, specific_sliding
from geometry.gears.pictures.readings import profile_readings
from geometry.gears.teeth import limits, measurement
from geometry.gears.teeth.basic_rack import TipRelief, iso_53
from geometry.gears.teeth.spur import SpurGear
from tests.brute import works
from tests.geometry.gears.pairs.test_internal_pair import pair_of

RACK = iso_53()
RINGED = pair_of(20, 61, 0.2, 0.3, 2.0)
PAIR = external_pair(SpurGear(10.0, 13, RACK, 0.694), SpurGear(10.0, 21, RACK, 0.384))


@pytest.mark.parametrize("share", [0.0, 0.25, 0.5, 0.9, 1.0])
def test_sliding_is_that_of_the_touching_points(share: float) -> None:
    line = active_line(PAIR)
    position = line.start + share * line.length
    alpha, distance = PAIR.working_pressure_angle, PAIR.working_centre_distance
    # axes at 0 and a_w; the line of action leaves the first base circle at angle alpha below the line of centres
    normal = cmath.exp(1j * (math.pi / 2 - alpha))
    foot = PAIR.first.base_radius * cmath.exp(-1j * alpha)
    point = foot + position * normal
    speeds = 1j * 1.0 * point, 1j * (-1 / PAIR.gear_ratio) * (point - distance)
    along_normal = [(v * normal.conjugate()).real for v in speeds]
    assert along_normal[0] == pytest.approx(along_normal[1], rel=1e-12)
    one, two = ((v * normal.conjugate()).imag for v in speeds)
    assert line.specific_sliding(position) == pytest.approx((1 - two / one, 1 - one / two), rel=1e-9)
    pole = foot + line.pole * normal
    assert pole == pytest.approx(PAIR.working_radii[0], rel=1e-12)
    factors = line.speed_factors(PAIR.working_radii[0])
    if share in (0.0, 1.0):
        assert abs(one - two) / PAIR.working_radii[0] == pytest.approx(factors[round(share)], rel=1e-9)


@pytest.mark.parametrize("pair", [PAIR, RINGED], ids=["external", "internal"])
def test_active_flanks_lie_between_the_ends_of_contact(pair: ExternalPair | InternalPair) -> None:
    """Radii of the points where contact begins and ends, seen from either axis; of a ring the axis is on this side."""
    line = active_line(pair)
    alpha = pair.working_pressure_angle
    foot, along = pair.first.base_radius * cmath.exp(-1j * alpha), 1j * cmath.exp(-1j * alpha)
    ends = [foot + at * along for at in (line.start, line.start + line.length)]
    for found, axis in zip(pair.active_profile_radii, (0.0, pair.sign * pair.working_centre_distance), strict=True):
        assert found == pytest.approx(sorted(abs(point - axis) for point in ends), rel=1e-12)
        assert found[0] < found[1]


def test_the_parts_of_the_active_line() -> None:
    line = active_line(PAIR)
    assert line.approach + line.recess == pytest.approx(line.length, rel=1e-12)
    assert line.length / PAIR.base_pitch == pytest.approx(PAIR.contact_ratio, rel=1e-9)
    assert line.root_sliding[0] < 0 < line.tip_sliding[0] < 1
    assert specific_sliding(0.0, 10.0, 2.0)[0] == -math.inf
    assert specific_sliding(10.0, 10.0, 2.0)[1] == -math.inf


@pytest.mark.parametrize("gear", [
    SpurGear(10.0, 10, RACK), SpurGear(10.0, 10, RACK, 0.41), SpurGear(2.0, 23, RACK),
    SpurGear(2.0, 40, RACK, -0.3, circumferential_thinning=0.1),
], ids=lambda g: f"{g.number_of_teeth} {g.profile_shift_coefficient}")  # fmt: skip
def test_readings_above_the_form_circle_are_the_formula_s(gear: SpurGear) -> None:
    form = limits.root_form_diameter(gear) / 2
    for share in (1e-3, 0.3, 0.999):
        radius = form + share * (gear.tip_radius - form)
        found = profile_readings(gear, radius)
        assert found.thickness == pytest.approx(measurement.thickness_at(gear, radius), rel=1e-11)
        assert found.thickness + found.space_width == pytest.approx(gear.pitch_angle * radius, rel=1e-12)


def test_an_undercut_tooth_is_thinner_than_its_involute() -> None:
    gear = SpurGear(10.0, 10, RACK)
    read = profile_readings(gear, gear.base_radius).thickness
    assert measurement.base_thickness(gear) - read > 0.1
    relieved = SpurGear(10.0, 20, iso_53(relief=TipRelief(0.02)))
    assert profile_readings(relieved, relieved.tip_radius).thickness < measurement.thickness_at(
        relieved, relieved.tip_radius
    )
    assert profile_readings(gear, gear.tip_radius).thickness == pytest.approx(limits.tip_thickness(gear), rel=1e-12)


@pytest.mark.parametrize("radius", [30.0, 70.0])
def test_a_circle_that_misses_the_teeth_is_refused(radius: float) -> None:
    with pytest.raises(ParameterError, match="not_between_root_and_tip") as caught:
        profile_readings(SpurGear(10.0, 10, RACK), radius)
    assert profile_readings(SpurGear(10.0, 10, RACK), works(caught.value) / 2)


@pytest.mark.parametrize("near", [0.0, 1e-15, 1e-8, 1e-3])
def test_sliding_at_a_base_circle_has_no_bound(near: float) -> None:
    """A search that ends beside a base circle finds no number there: 1e-8 of the line off it would be -3e7."""
    line = 20.0
    first, second = specific_sliding(near * line, line, 3.0)[0], specific_sliding((1 - near) * line, line, 3.0)[1]
    if near < 1e-6:
        assert first == second == -math.inf
    else:
        assert (first, second) == pytest.approx((1 - 0.999 / 0.003, 1 - 3 * 0.999 / 0.001))

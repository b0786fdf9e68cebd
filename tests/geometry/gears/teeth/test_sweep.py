"""The sweep: every module, tooth number, angle, shift and rack is built exactly or refused with a reason."""

from __future__ import annotations

import itertools
import math
import random
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pytest
import shapely

from geometry.base.errors import GeometryError, ParameterError
from geometry.base.record import replace
from geometry.gears.teeth.basic_rack import ISO_53, BasicRack, iso_53
from geometry.gears.teeth.limits import checked_gear
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide, tooth_side
from parts.base.reasons import reason
from tests import brute
from tests.oracles import rack_sweep

MODULES = (0.1, 0.3, 2.0, 10.0, 50.0)
TEETH = (3, 4, 5, 6, 8, 10, 13, 17, 23, 41, 42, 43, 100, 200, 1000)
DEGREES = (14.5, 20.0, 25.0, 30.0)
SHIFTS: tuple[float | None, ...] = (*(round(-0.6 + 0.1 * k, 1) for k in range(17)), None)  # None: x = h_f - rho
RIGHT = 1e-12


@dataclass(frozen=True)
class Outcome:
    """What became of one gear of the sweep."""

    gear: SpurGear
    built: bool


def rack_of(name: str, degrees: float) -> BasicRack:
    return iso_53(name) if degrees == 20.0 else iso_53(name, math.radians(degrees))


def every_combination() -> list[tuple[str, float, int, float | None]]:
    """All racks, angles, tooth numbers and shifts."""
    return list(itertools.product(sorted(ISO_53), DEGREES, TEETH, SHIFTS))


def check_combination(
    name: str,
    degrees: float,
    teeth: int,
    shift: float | None,
    *,
    points: int,
    modules: Sequence[float] = MODULES,
) -> Outcome | None:
    """One gear at module 1 against the swept rack, and its likenesses at other modules; None: no such rack."""
    no_rack = brute.refusal(lambda: rack_of(name, degrees))
    if no_rack is not None:
        assert isinstance(no_rack, ParameterError)
        assert no_rack.name.startswith("rack.")
        return None
    rack = rack_of(name, degrees)
    gear = SpurGear(1.0, teeth, rack, rack.dedendum - rack.tip_radius if shift is None else shift)
    refused = brute.refusal(lambda: tooth_side(gear))
    if refused is not None:
        check_refusal(gear, refused, modules)
        return Outcome(gear, built=False)
    side = tooth_side(gear)
    outline = np.concatenate([brute.dense(s.curve, points) for s in side.segments])
    error = rack_sweep.outline_error(outline, brute.rack_tool(gear), teeth, gear.tip_radius)
    assert error.max() <= RIGHT * gear.tip_radius, gear
    check_simple(side, gear)
    check_likenesses(gear, side, outline, points, modules)
    return Outcome(gear, built=True)


def check_simple(side: ToothSide, gear: SpurGear) -> None:
    """Closed (the profile checks its joins), counter-clockwise, without self-crossing; beyond 13 teeth, three."""
    profile = side.profile()
    teeth = profile.count if profile.count <= 13 else 3
    vertices = brute.polygon(profile, 24, periods=teeth)
    if teeth == profile.count:
        ring = shapely.LinearRing(np.column_stack([vertices.real, vertices.imag]))
        assert ring.is_closed
    else:
        vertices = np.concatenate([vertices, [0j]])  # a slice: closed over the centre
        ring = shapely.LinearRing(np.column_stack([vertices.real, vertices.imag]))
    assert ring.is_simple, gear
    assert ring.is_ccw
    assert np.abs(vertices).max() <= gear.tip_radius * (1 + RIGHT)


def check_likenesses(
    gear: SpurGear, side: ToothSide, outline: np.ndarray, points: int, modules: Sequence[float]
) -> None:
    """Homothety: at any other module the outline is the same times the module."""
    for module in modules:
        other = tooth_side(replace(gear, module=module))
        assert [s.label for s in other.segments] == [s.label for s in side.segments]
        scaled = np.concatenate([brute.dense(s.curve, points) for s in other.segments])
        assert np.abs(scaled / module - outline).max() <= 1e-7 * gear.tip_radius  # parameters of a joint may slide
        error = np.abs(np.abs(scaled[-1]) / module - np.abs(outline[-1]))
        assert error <= 1e-14 * gear.tip_radius


def check_refusal(gear: SpurGear, refusal: GeometryError, modules: Sequence[float]) -> None:
    """A refusal has a key, a reason and a value; the same at every module."""
    assert isinstance(refusal, ParameterError)
    assert refusal.name
    assert reason(refusal.code) != refusal.code, "a code without a sentence"
    for module in modules:
        with pytest.raises(type(refusal)):
            tooth_side(replace(gear, module=module))


def check_remedy(gear: SpurGear) -> None:
    with pytest.raises(ParameterError) as caught:
        checked_gear(gear)
    key, value = caught.value.name, brute.works(caught.value)
    if key == "tip_diameter":
        assert caught.value.value == 2 * gear.tip_radius
        key = "given_tip_diameter"
    else:
        assert getattr(gear, key) == caught.value.value
    assert checked_gear(replace(gear, **{key: value}))


def test_a_sample_of_the_sweep() -> None:
    """Seeded: gears over all axes, each at two modules more, and every rack with its centre on the pitch line."""
    chosen = random.Random(53).sample(every_combination(), 100)
    chosen += [(name, 20.0, z, None) for name in sorted(ISO_53) for z in (8, 23, 100)]
    outcomes = [
        check_combination(*c, points=7, modules=(MODULES[k % 5], MODULES[(k + 2) % 5])) for k, c in enumerate(chosen)
    ]
    made = [o for o in outcomes if o is not None]
    assert sum(o.built for o in made) >= 0.6 * len(made)
    for refused in [o.gear for o in made if not o.built][:6]:
        check_remedy(refused)


@pytest.mark.heavy
@pytest.mark.parametrize("degrees", DEGREES)
@pytest.mark.parametrize("name", sorted(ISO_53))
def test_the_whole_sweep(name: str, degrees: float) -> None:
    outcomes = [check_combination(name, degrees, z, x, points=32) for z in TEETH for x in SHIFTS]
    made = [o for o in outcomes if o is not None]
    assert len(made) in (0, len(outcomes))
    if not made:
        # D's rack tooth at 30 degrees is pointed above its tip line, and so is no other (theory note B1)
        assert (name, degrees) == ("D", 30.0)
        return
    # what is refused is pointed, cut away or beyond the axis: few teeth only
    assert all(o.built for o in made if o.gear.number_of_teeth >= 41 and abs(o.gear.profile_shift_coefficient) <= 0.5)
    for refused in [o.gear for o in made if not o.built][::7]:
        check_remedy(refused)


@pytest.mark.parametrize("place", [0, 40, -1])
def test_the_sweep_sees_a_spoiled_point(place: int) -> None:
    """Negative control: one point moved by 1e-11 of the tip radius fails the bound of the sweep."""
    gear = SpurGear(1.0, 17, iso_53(), 0.1)
    outline = np.concatenate([brute.dense(s.curve, 25) for s in tooth_side(gear).segments])
    outline[place] *= 1 + 1e-11
    error = rack_sweep.outline_error(outline, brute.rack_tool(gear), 17, gear.tip_radius)
    assert error.max() > RIGHT * gear.tip_radius
    assert int(np.argmax(error)) == place % len(outline)


def test_the_sweep_sees_a_crossing() -> None:
    """Negative control: two vertices exchanged make a ring that is not simple."""
    vertices = brute.polygon(tooth_side(SpurGear(1.0, 13, iso_53())).profile(), 24)
    vertices[[30, 40]] = vertices[[40, 30]]
    assert not shapely.LinearRing(np.column_stack([vertices.real, vertices.imag])).is_simple

"""What is no number, no size or no angle is refused by its own name, before anything is made of it."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from geometry.gears.teeth.basic_rack import checked_rack, iso_53
from geometry.gears.teeth.limits import checked_gear
from geometry.gears.teeth.rack import Rack, checked_part_rack
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.ring_limits import checked_ring
from geometry.gears.teeth.spur import SpurGear

GEAR = SpurGear(2.0, 20, iso_53(), 0.1)
RING = RingGear(2.0, 50, math.radians(20), 140.0, RoundedRoot(), 0.2)
RACK = Rack(2.0, 9, iso_53(), 8.0)
NEVER = [math.nan, math.inf, -math.inf]
SIZE, SHARE = "not_finite_above_zero", "not_finite_or_negative"


def rooted(field: str) -> Callable[[Any, float], Any]:
    return lambda ring, value: replace(ring, root=RoundedRoot(**{field: value}))


def sized(field: str) -> Callable[[Any, float], Any]:
    return lambda part, value: replace(part, **{field: value})


# what is checked, what is changed in it, its name, the code, values that are refused beside those that are no numbers,
# and such as are not
CASES: list[tuple[Callable[[Any], Any], Any, Callable[[Any, float], Any], str, str, list[float], list[float]]] = [
    *((check, part, sized("module"), "module", SIZE, [0.0, -2.0], [1e-3, 50.0])
      for check, part in ((checked_gear, GEAR), (checked_part_rack, RACK))),
    (checked_ring, RING, sized("module"), "module", SIZE, [0.0, -2.0], [0.5]),
    (checked_ring, RING, sized("outer_diameter"), "outer_diameter", SIZE, [0.0, -2.0], [200.0]),
    (checked_ring, RING, sized("pressure_angle"), "pressure_angle", "not_below_right_angle",
     [0.0, -0.3, math.pi / 2, 2.0], [0.3]),
    (checked_rack, iso_53(), sized("pressure_angle"), "pressure_angle", "not_below_right_angle",
     [0.0, -0.3, math.pi / 2, 2.0], [0.3]),
    (checked_rack, iso_53(), sized("addendum"), "rack.addendum", SHARE, [-1e-9], [0.0, 0.8]),
    (checked_rack, iso_53(), sized("tip_radius"), "rack.tip_radius", SHARE, [-1e-9], [0.0, 0.1]),
    (checked_part_rack, RACK, sized("body_height"), "body_height", SIZE, [0.0, -1.0], [20.0]),
    *((check, part, sized("given_tip_diameter"), "tip_diameter", SIZE, [0.0, -1.0], [given])
      for check, part, given in ((checked_gear, GEAR, 44.0), (checked_ring, RING, 98.0))),
    *((check, part, sized("profile_shift_coefficient"), "profile_shift_coefficient", "not_finite", [], [0.0, 0.3])
      for check, part in ((checked_gear, GEAR), (checked_ring, RING))),
    *((check, part, sized(name), name, SHARE, [-1e-9, -1.0], [0.0, 0.01])
      for check, part in ((checked_gear, GEAR), (checked_ring, RING), (checked_part_rack, RACK))
      for name in ("circumferential_thinning", "tip_chamfer", "tip_rounding")),
    (checked_ring, RING, rooted("dedendum"), "root.dedendum", SHARE, [-1e-9], [1.2, 1.25]),
    (checked_ring, RING, rooted("radius"), "root.radius", SHARE, [-1e-9], [0.0, 0.2]),
]  # fmt: skip


def test_what_is_no_number_is_refused_by_its_name() -> None:
    for check, part, change, name, code, refused, fine in CASES:
        for value in (*NEVER, *refused):
            with pytest.raises(ParameterError) as caught:
                check(change(part, value))
            assert (caught.value.name, caught.value.code) == (name, code), value
        for value in fine:
            check(change(part, value))


@pytest.mark.parametrize(("check", "part", "least"), [(checked_ring, RING, 4), (checked_part_rack, RACK, 1)])
def test_so_many_teeth_at_least(check: Callable[[Any], Any], part: Any, least: int) -> None:
    for teeth in (least - 1, 0, -5):
        with pytest.raises(ParameterError) as caught:
            check(replace(part, number_of_teeth=teeth))
        assert (caught.value.name, caught.value.code) == ("number_of_teeth", "too_few")
        assert caught.value.nearest is not None
        assert caught.value.nearest.value == least

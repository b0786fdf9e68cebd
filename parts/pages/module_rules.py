"""Sizes of the power module (thesis): one table of rules, what each belongs to, how it follows, and why.

The table is ``module_rules.psv``, its names those of ``DRIVERS`` and of the rules above; lengths in mm. ``r_``: radius,
about the axis of the part's own disk; ``z_``: height, 0 is the back of the disks, the front is up. ``CONDITIONS``, of
``module_limits.psv``, are lengths that must be left; each names the driver that a refusal names. What has an
``orientation`` is of those alone: the wheels of the thesis, idlers, or cranks.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Mapping, Sequence
from functools import cache
from types import CodeType
from typing import TypeVar

from geometry.base.record import Record
from parts.base.psv import rows_of


class Rule(Record):
    """A size: its name, the positions of the parts list that have it, what it is made of, and why so."""

    name: str
    positions: tuple[int, ...]
    made_of: str
    reason: str
    orientation: str = ""


class Condition(Record):
    """What must be at least 0, the driver that is to blame where it is not, and what it is."""

    driver: str
    made_of: str
    reason: str
    orientation: str = ""


Of = TypeVar("Of", Rule, Condition)

# of the standard items: hole that a screw passes, diameter and height of its head
M4, M8, M10, M12, M14 = (4.5, 7.0, 2.8), (9.0, 13.0, 8.0), (11.0, 16.0, 10.0), (13.5, 18.0, 12.0), (15.0, 21.0, 14.0)

# what is given, with the thesis's numbers and what goes with them
DRIVERS: Mapping[str, float] = {
    "module": 3.0, "teeth_19": 96, "teeth_21": 144, "wheel_module": 2.0, "worm_module": 5.0, "worm_quotient": 10.0,
    "worm_teeth_25": 128, "worm_teeth_23": 106, "worm_wheel_width": 26.0, "worm_length": 120.0, "face_width": 25.0,
    "wheel_width": 15.0, "disk_thickness": 30.0, "axial_gap": 5.0, "clearance": 0.1, "ball": 8.0, "balls": 180,
    "platform_size": 260.0,
}  # fmt: skip

RULES = tuple(
    Rule(name, tuple(map(int, positions.split(","))), made_of, reason, orientation)
    for name, orientation, positions, made_of, reason in rows_of(__file__, "module_rules")
)
CONDITIONS = tuple(
    Condition(driver, made_of, reason, orientation)
    for driver, orientation, made_of, reason in rows_of(__file__, "module_limits")
)


def _beside(reach: float, height: float) -> float:
    """Half the chord of a circle at a distance from its middle; 0 where that is outside of it."""
    return math.sqrt(max(reach**2 - height**2, 0.0))


def _chord_left(ring: float, throat: float, aside: float, distance: float) -> float:
    """Where a ring about a worm is clear of its wheel's throat, along the worm, in a plane so far from its axis."""
    reach, height = (distance - math.sqrt(max(r**2 - aside**2, 0.0)) for r in (throat, ring))
    return _beside(reach, height)


_KNOWN: Mapping[str, object] = {
    "ceil": lambda x: math.ceil(x - 1e-9), "floor": lambda x: math.floor(x + 1e-9), "max": max, "min": min,
    "round": round, "pi": math.pi, "sqrt": math.sqrt, "beside": _beside, "chord_left": _chord_left,
}  # fmt: skip


@cache
def _code(made_of: str) -> CodeType:
    return compile(ast.parse(made_of, mode="eval"), made_of, "eval")


def of_orientation(rows: Sequence[Of], orientation: str) -> list[Of]:
    """The rules or conditions of an orientation, and those of all."""
    return [row for row in rows if not row.orientation or orientation in row.orientation.split()]


def sizes(drivers: Mapping[str, float], orientation: str) -> dict[str, float]:
    """The drivers and every size by its name."""
    found = dict(drivers)
    for rule in of_orientation(RULES, orientation):
        found[rule.name] = valued(rule.made_of, found)
    return found


def valued(made_of: str, known: Mapping[str, float]) -> float:
    """What a rule or a condition comes to."""
    value: float = eval(_code(made_of), {"__builtins__": {}, **_KNOWN}, dict(known))
    return value


def listed(made_of: str, known: Mapping[str, object]) -> list[tuple[float, ...]]:
    """What points or holes come to that are made of such sizes; empty of no words."""
    values: list[tuple[float, ...]] = eval(_code(made_of or "[]"), {"__builtins__": {}, **_KNOWN}, dict(known))
    return values

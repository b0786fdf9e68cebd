"""What mates beyond gear pairs have in common: sizes that must be equal, and what most of them answer."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from geometry.errors import ParameterError

if TYPE_CHECKING:
    from geometry.findings import Finding
    from geometry.gears.mesh_search import PairContact

# sizes that must be equal in two parts: they are typed, not calculated
_SAME = 1e-9


def same_size(key: str, own: float, other: float, whose: str) -> None:
    """Refuse a size of the second part that is not the first one's; ``whose``: the first one in words."""
    if abs(own - other) > _SAME * max(abs(own), abs(other)):
        raise ParameterError(key, own, f"must be that of {whose}; {other:.12g} works")


def turn_off(found: float, right: float, pitch: float) -> float:
    """How far a rotation is off the right one, rad, pitches left out."""
    return math.remainder(found - right, pitch)


@dataclass(frozen=True, slots=True)
class Joined:
    """What mates other than pairs of involute gears have in common; each overrides what it has of its own."""

    first: str
    second: str
    direction_deg: float
    height: float

    @property
    def pair(self) -> Any:
        """None: no pair of gears."""
        return None

    @property
    def first_teeth(self) -> int:
        """1."""
        return 1

    @property
    def normal_backlash(self) -> float:
        """0."""
        return 0.0

    @property
    def has_contact(self) -> bool:
        """Whether ``contact`` decides."""
        return True

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact | None:
        """None: nothing moves here."""
        return None

    def findings(self) -> tuple[Finding, ...]:
        """None: what a part is warned of stands there."""
        return ()

    def quantities(self) -> dict[str, Any]:
        """None."""
        return {}

"""What belt and chain drives have in common: it turns both wheels the same way, and alone touches them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from parts.base.mate import Toothed

if TYPE_CHECKING:
    from geometry.kinematics.mechanism import Kind


class Wrapped(Toothed, kw_only=True):
    """Two wheels, and what is wrapped about them."""

    rolls: Kind | None = "internal"
    has_contact: bool = False


def gap_away(rotation: float, direction: float, step: float) -> float:
    """Phase of the first wheel's gap that is nearest to the side away from the second, rad; ``step`` between gaps."""
    return math.pi + math.remainder(rotation - direction + step / 2 - math.pi, step)

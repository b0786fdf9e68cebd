"""The helix of a gear's teeth: its angle on the reference cylinder, its hand, and which helices mesh.

A right-hand tooth turns counter-clockwise about z as it rises: its screw is right-handed, on rings too. Source: ISO
21771; ISO 1122-1 for the hands.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal

from geometry.base.errors import Nearest
from geometry.base.record import Record

if TYPE_CHECKING:
    from geometry.solids.body import Twist

Hand = Literal["right", "left"]
# angles that are typed have a handful of decimals, rad
_SAME_ANGLE = 1e-9


class Helix(Record):
    """``angle`` on the reference cylinder, rad, 0 for spur gears; ``hand``: of the lower half where ``double``."""

    angle: float = 0.0
    hand: Hand = "right"
    double: bool = False

    @property
    def signed_angle(self) -> float:
        """beta, rad, positive for right hand."""
        return self.angle if self.hand == "right" else -self.angle

    def twist(self, reference_radius: float) -> Twist | None:
        """How the teeth turn along the axis: tan(beta) / r rad/mm; None for spur gears."""
        if self.angle == 0:
            return None
        from geometry.solids.body import Twist

        return Twist(math.tan(self.signed_angle) / reference_radius, self.double)

    def shear(self) -> Twist | None:
        """How the teeth of a rack move along its length; None for straight ones.

        Seen from the tips with the gear's axis upright, right-hand teeth rise to the right: towards -x in the rack
        frame, whose teeth point to +y.
        """
        if self.angle == 0:
            return None
        from geometry.solids.body import Twist

        return Twist(slope=complex(-math.tan(self.signed_angle)), double=self.double)

    def lead(self, reference_radius: float) -> float:
        """p_z = 2 pi r / tan(beta): rise of a tooth in one turn, mm; inf for spur gears."""
        return 2 * math.pi * reference_radius / math.tan(self.angle) if self.angle else math.inf


def mesh_fault(first: Helix, second: Helix, *, internal: bool = False) -> tuple[str, object, str, Nearest] | None:
    """Why two gears on parallel axes, or a gear and a rack, do not mesh: key of the second one, value, code, cure.

    Both need one helix angle; the hands are opposite, but alike where one of them is a ring (``internal``). Modules,
    pressure angles and the rest are the pair's of the transverse sections.
    """
    if abs(first.angle - second.angle) > _SAME_ANGLE:
        wanted = Nearest(round(math.degrees(first.angle), 12))
        return "helix_angle_deg", math.degrees(second.angle), "not_that_of_mate", wanted
    if first.angle == 0:
        return None
    if first.double != second.double:
        return "double_helical", second.double, "one_double_helix", Nearest(first.double)
    hand = first.hand if internal else {"right": "left", "left": "right"}[first.hand]
    if second.hand != hand:
        code = "not_hand_of_pinion" if internal else "hands_not_opposite"
        return "hand", second.hand, code, Nearest(hand)
    return None

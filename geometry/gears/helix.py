"""The helix of a gear's teeth: its angle on the reference cylinder, its hand, and which helices mesh.

A right-hand tooth turns counter-clockwise about z as it rises: its screw is right-handed, on rings too. Source: ISO
21771; ISO 1122-1 for the hands.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from geometry.body import Twist

Hand = Literal["right", "left"]
# angles that are typed have a handful of decimals, rad
_SAME_ANGLE = 1e-9


@dataclass(frozen=True, slots=True)
class Helix:
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
        return Twist(math.tan(self.signed_angle) / reference_radius, self.double)

    def shear(self) -> Twist | None:
        """How the teeth of a rack move along its length; None for straight ones.

        Seen from the tips with the gear's axis upright, right-hand teeth rise to the right: towards -x in the rack
        frame, whose teeth point to +y.
        """
        return None if self.angle == 0 else Twist(slope=complex(-math.tan(self.signed_angle)), double=self.double)

    def lead(self, reference_radius: float) -> float:
        """p_z = 2 pi r / tan(beta): rise of a tooth in one turn, mm; inf for spur gears."""
        return 2 * math.pi * reference_radius / math.tan(self.angle) if self.angle else math.inf


def mesh_fault(first: Helix, second: Helix, *, internal: bool = False) -> tuple[str, object, str] | None:
    """Why two gears on parallel axes, or a gear and a rack, do not mesh: key of the second one, its value, remedy.

    Both need one helix angle; the hands are opposite, but alike where one of them is a ring (``internal``). Modules,
    pressure angles and the rest are the pair's of the transverse sections.
    """
    if abs(first.angle - second.angle) > _SAME_ANGLE:
        angle = math.degrees(second.angle)
        return "helix_angle_deg", angle, f"must be that of its mate; {math.degrees(first.angle):.12g} works"
    if first.angle == 0:
        return None
    if first.double != second.double:
        text = "a double helical gear meshes with another one only"
        return "double_helical", second.double, f"{text}; {str(first.double).lower()} works"
    wanted = first.hand if internal else {"right": "left", "left": "right"}[first.hand]
    if second.hand != wanted:
        rule = "a ring has the hand of its pinion" if internal else "mates have opposite hands"
        return "hand", second.hand, f'{rule}; "{wanted}" works'
    return None

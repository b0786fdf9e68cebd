"""What face chamfers of gears and of rings have in common: the helix that has none, the rounding that they take."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geometry.base.errors import Nearest, ParameterError
from geometry.base.findings import Finding, beyond
from parts.keys.wheel import FaceChamferTable, both_faces

if TYPE_CHECKING:
    from geometry.gears.teeth.helix import Helix
    from geometry.gears.teeth.involute_teeth import InvoluteTeeth


def check_face_chamfer(given: float | FaceChamferTable, helix: Helix, section: InvoluteTeeth) -> None:
    """A chamfer that stands upright over the end of a helix stays within the teeth: beta_b is below 45 degrees."""
    both = {"": given} if not isinstance(given, FaceChamferTable) else {".below": given.below, ".above": given.above}
    slope = math.tan(helix.angle) * section.base_radius / section.reference_radius
    for key, value in both.items():
        if value > 0 and slope >= 1:
            angle = math.degrees(math.atan(slope))
            raise ParameterError(f"face_chamfer{key}", value, "chamfer_on_steep_helix", Nearest(0.0), angle=angle)


def chamfer_finding(given: float | FaceChamferTable, tip_rounding: float) -> tuple[Finding, ...]:
    """The remark that a tip rounding keeps some of its radius where a plain chamfer would leave none: sizes in mm."""
    from geometry.gears.teeth.moved_segments import KEPT_ROUNDING

    both, whole = both_faces(given), (1 - KEPT_ROUNDING) * tip_rounding
    return beyond("tip_rounding_kept", max(both.below, both.above), whole) if whole > 0 else ()

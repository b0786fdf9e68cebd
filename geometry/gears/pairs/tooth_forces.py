"""Forces between teeth without friction: along the common normal of both flanks, at the pole."""

from __future__ import annotations

import math

from geometry.base.record import Record


class ToothForces(Record):
    """Parts of the force on a tooth, N: along its working circle, towards the axis, along the axis, and the whole.

    The two halves of double helical teeth hold each other: nothing of theirs goes along the axis.
    """

    circumferential: float
    radial: float
    axial: float
    normal: float


def tooth_forces(torque: float, radius: float, angle: float, helix: float, *, double: bool = False) -> ToothForces:
    """The forces by a torque, N m, on a gear whose working circle has a ``radius``, mm.

    Parameters
    ----------
    angle
        Working pressure angle of the transverse section, rad.
    helix
        Angle of the teeth on the working circle, rad.
    """
    along = 1000 * torque / radius
    radial, axial = along * math.tan(angle), along * math.tan(abs(helix))
    return ToothForces(along, radial, 0.0 if double else axial, math.hypot(along, radial, axial))

"""The transverse section of a helical ring that is given in normal data; ISO 21771."""

from __future__ import annotations

import math

from geometry.base.record import replace
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.ring import RingGear, RoundedRoot
from geometry.gears.teeth.transverse import transverse_angle, transverse_cutter


def transverse_ring(normal: RingGear, helix_angle: float) -> RingGear:
    """The section of a ring across its axis; the helix angle on the reference cylinder in rad, below a right angle.

    Lengths stay. The tip's k_2 of GOST 19274 follows from the normal shift. A rounded root's arcs are circles of the
    transverse section, their radius in normal modules.
    """
    if helix_angle == 0:
        return normal
    cosine = math.cos(helix_angle)
    return replace(
        normal,
        module=normal.module / cosine,
        pressure_angle=transverse_angle(normal.pressure_angle, helix_angle),
        root=transverse_root(normal.root, helix_angle),
        profile_shift_coefficient=normal.profile_shift_coefficient * cosine,
        addendum=(normal.addendum - normal.tip_shortening_coefficient) * cosine,
        plain_tip=True,
    )


def transverse_root(root: PinionCutter | RoundedRoot, helix_angle: float) -> PinionCutter | RoundedRoot:
    """What makes a ring's root, in its transverse section; the angle in rad."""
    if helix_angle == 0:
        return root
    if isinstance(root, PinionCutter):
        return transverse_cutter(root, helix_angle)
    cosine = math.cos(helix_angle)
    return RoundedRoot(root.dedendum * cosine, None if root.radius is None else root.radius * cosine)

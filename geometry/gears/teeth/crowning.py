"""Lengthwise crowning of teeth: each section is that of a gear whose teeth are thinner towards the faces.

At a height z each flank is relieved by C (2 z / b - 1)^2, along the base tangent of its section, as deviations of
helices are measured (ISO 1328-1; ISO 21771: C_beta): an involute turns about the axis, and its fillet is that of the
wider rack tooth, so that every section is exact. Helical teeth turn besides, but not in the chamfers of their faces;
either half of double helical ones is crowned by itself.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache, partial
from itertools import pairwise
from typing import TYPE_CHECKING

from geometry.base.errors import GeometryError
from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Profile
from geometry.solids.wheel import inset_of

if TYPE_CHECKING:
    from geometry.solids.body import BodyBuilder, Twist
    from geometry.solids.wheel import Rim

# reliefs and depths that differ by rounding only have one section, mm
_DIGITS = 12


def relieved(gear: SpurGear, relief: float) -> SpurGear:
    """The gear with each flank ``relief`` mm deeper in its teeth."""
    thinned = 2 * relief / math.cos(gear.pressure_angle)
    return replace(gear, circumferential_thinning=gear.circumferential_thinning + thinned)


def has_form(outline: Callable[[SpurGear], Profile], gear: SpurGear, crowning: float) -> bool:
    """Whether the outline at the faces exists, with the segments of that in the middle."""
    try:
        ends = outline(relieved(gear, crowning))
    except GeometryError:
        return False
    return [s.label for s in ends.period] == [s.label for s in outline(gear).period]


def crowned_teeth(
    outline: Callable[[SpurGear, float, float], Profile],
    gear: SpurGear,
    crowning: float,
    width: float,
    chamfers: tuple[float, float],
    twist: Twist | None = None,
) -> Rim:
    """Teeth relieved by ``crowning`` at both faces, with face chamfers below and above; mm.

    ``outline`` makes that of a gear, moved out of the material and then cut so deep by a chamfer.

    Raises
    ------
    ParameterError
        A chamfer leaves no tooth at a face.
    """
    below, above = chamfers
    double = twist is not None and twist.double
    half = width / 2 if double else width

    def among(z: float) -> float:
        """The height between the chamfers, which at a middle beyond one is its end: walls of the bore end with it."""
        return min(max(z, below), width - above)

    def along(z: float) -> float:
        """How far along the helix, which goes back from the middle of double helical teeth on."""
        return min(z, width - z) if double else z

    def rim(made: BodyBuilder, offset: float) -> tuple[int, int]:
        @lru_cache
        def section(relief: float, depth: float) -> Profile:
            return outline(relieved(gear, relief), offset, depth)

        def at(z: float) -> Profile:
            depth = max(below - z, z - (width - above), 0.0)
            upright = section(round(crowning * (2 * along(z) / half - 1) ** 2, _DIGITS), round(depth, _DIGITS))
            turn = 0.0 if twist is None else twist.rate * along(among(z))
            return upright.placed(Placement2(turn)) if turn else upright

        for side, chamfer in (("below", below), ("above", above)):
            if chamfer:
                inset_of(partial(outline, relieved(gear, crowning)), min(offset, 0.0), chamfer, side, "outline")
        middles = (half / 2, half, width - half / 2) if double else (half / 2,)
        levels = sorted({0.0, below, *map(among, middles), width - above, width})
        loops = [made.loop(at(z), z) for z in levels]
        for lower, upper in pairwise(loops):
            made.wall(lower, upper, at)
        return loops[0], loops[-1]

    return rim

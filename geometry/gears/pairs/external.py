"""The external spur pair: how it is made, its tip shortening and what an undercut gear of it is told.

Symbols are those of ISO 21771; equation numbers those of the practicum, lesson 3.
"""

from __future__ import annotations

from functools import cached_property

from geometry.base.both import both
from geometry.base.record import replace
from geometry.gears.pairs.involute import InvolutePair, common_sums, with_room, working_angle
from geometry.gears.teeth.limits import undercut
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide, tooth_side


class ExternalPair(InvolutePair[SpurGear, ToothSide], dict=True):
    """Two external spur gears in mesh; made by ``external_pair``. Both carry their shortened tips."""

    tip_shortening_coefficient: float

    @cached_property
    def second_side(self) -> ToothSide:
        """The exact side of the second gear's teeth; raises ParameterError where it cannot be built."""
        return tooth_side(self.second)

    def _flank_cut_away(self) -> tuple[bool, bool]:
        """Of undercut gears."""
        return both(undercut(g).margin < 0 for g in self.gears)


def external_pair(first: SpurGear, second: SpurGear, working_centre_distance: float | None = None) -> ExternalPair:
    """The pair of two gears at zero backlash but for their thinning, or at a given centre distance, mm.

    Working angle by (3.3), centre distance by (3.4), tips shortened by Delta y = x1 + x2 - y where that is
    positive, by (3.11), (3.12): gears with a given tip diameter keep it, and no tip is ever lengthened.

    Raises
    ------
    ParameterError
        Modules or pressure angles differ; no working angle exists (inv alpha_w < 0); the centre distance leaves
        no room for the teeth. Each names the nearest value that works.
    """
    sums = common_sums(first, second, "first")
    if working_centre_distance is None:
        angle = working_angle(sums, first, second, "first")
        distance = sums.distance(angle)
    else:
        distance, angle = with_room(sums, working_centre_distance)
    reference = first.reference_radius + second.reference_radius
    shortening = sums.shift - (distance - reference) / first.module
    return ExternalPair(_shortened(first, shortening), _shortened(second, shortening), distance, angle, shortening)


def tip_beside(gear: SpurGear, mate: SpurGear, working_centre_distance: float | None = None) -> float:
    """Tip diameter that a gear keeps beside its mate, mm; neither needs to exist alone, where it may be pointed.

    Raises
    ------
    ParameterError
        As ``external_pair``.
    """
    return 2 * external_pair(gear, mate, working_centre_distance).first.tip_radius


def _shortened(gear: SpurGear, shortening: float) -> SpurGear:
    """The gear with its tip radius by (3.11); a given tip diameter stays, a tip is never lengthened."""
    if gear.given_tip_diameter is not None or shortening <= 0:
        return gear
    return replace(gear, given_tip_diameter=2 * (gear.tip_radius - shortening * gear.module))

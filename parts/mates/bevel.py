"""Two bevel gears in mesh: their apexes are one, and a tooth of one stands in a space of the other."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.base.findings import Finding
from parts.base.mate import End, LaidStanding
from parts.keys.mate import GearPairKeys, backlash
from parts.mates.gear_pair import GearPair, Meeting
from parts.mates.sizes import same_size, same_sizes

if TYPE_CHECKING:
    from geometry.base.placement import Placement3, Vector
    from geometry.gears.bevel.gear import BevelGear
    from geometry.gears.bevel.pair import BevelPair

# keys that both have alike, and those of which the second has the negative
_ALIKE = ("module", "shaft_angle_deg", "pressure_angle_deg", "addendum_coefficient", "tip_clearance_coefficient")
_OPPOSITE = ("profile_shift_coefficient", "thickness_coefficient")
# of the module
_ROUNDING = 1e-9


_NORMAL_BACKLASH = backlash("normal backlash at the outer end: thins both gears by half")


class BevelPairSpec(GearPairKeys, tag="bevel_pair", kw_only=True):
    """Keys of ``bevel_pair``."""

    normal_backlash: Annotated[float, _NORMAL_BACKLASH] | None = None


class BevelMating(Meeting):
    """Two bevel gears; the second's axis is laid so that the apexes meet."""

    pair: BevelPair

    def second_axis(self, direction: float) -> Vector:
        """From the second's back face to the apex."""
        angle = self.pair.first.shaft_angle
        aside = cmath.rect(-math.sin(angle), direction)
        return aside.real, aside.imag, math.cos(angle)

    def second_rotation(self, rotation: float, direction: float) -> float:
        """Where a space of the second stands on the tooth, or a tooth on the space, of the first."""
        first, second = self.pair.gears
        ahead = math.remainder(rotation - direction, math.tau / first.number_of_teeth)
        turn = math.pi / second.number_of_teeth - ahead * first.number_of_teeth / second.number_of_teeth
        return direction + math.pi + turn

    def laid_standing(self, first: Placement3, second: Placement3) -> LaidStanding:
        """In the frame of the first, where its tooth is on +x: apexes, axes, and how far the second is turned off."""
        import numpy as np

        one, other = self.pair.gears
        seen = first.inverse() @ second
        apex = seen.apply(np.array([0.0, 0.0, other.mounting_distance])) - np.array([0.0, 0.0, one.mounting_distance])
        arm = other.cone_distance * math.sin(other.involute.base)
        return self.seen_standing(seen, float(np.linalg.norm(apex)), one.shaft_angle, arm, other.cone_distance)

    def findings(self) -> tuple[Finding, ...]:
        """Whether a tip meets what is no flank, or a root, and whether one tooth follows on the other."""
        found = []
        names = ("first", "second")
        for name, gear, reserve in zip(names, self.pair.gears, self.pair.form_reserves, strict=True):
            if reserve < -_ROUNDING * gear.module:
                begins = gear.joint[1] * gear.cone_distance
                code = f"active_flank_cut_away_{name}" if gear.is_undercut else f"fillet_interference_{name}"
                found.append(Finding(code, begins + reserve, begins))
        if self.pair.total_contact_ratio < 1:
            name = "contact_ratio" if self.pair.first.is_straight else "total_contact_ratio"
            found.append(Finding(name, self.pair.total_contact_ratio, 1.0))
        return tuple(found)

    def _overlap(self) -> dict[str, float]:
        """Of teeth that are not straight."""
        if self.pair.first.is_straight:
            return {}
        return {"overlap_ratio": self.pair.face_contact_ratio,
                "total_contact_ratio": self.pair.total_contact_ratio}  # fmt: skip

    def quantities(self) -> dict[str, Any]:
        """Ratio, contact ratio, clearances."""
        clearances = self.pair.bottom_clearances
        return {
            "ratio": self.pair.ratio,
            "transverse_contact_ratio": self.pair.contact_ratio,
            **self._overlap(),
            "normal_backlash": self.pair.normal_backlash,
            "bottom_clearance_at_root": {"first": clearances[0], "second": clearances[1]},
        }


class BevelPairKind(GearPair[BevelPairSpec, "BevelGear", "BevelGear"]):
    """Two bevel gears made for each other."""

    name, keys = "bevel_pair", BevelPairSpec
    joins = (("bevel_gear", "bevel_gear"),)

    def check(self, keys: BevelPairSpec, first: Struct, second: Struct) -> None:
        """The second is what the first is made for."""
        for key, wanted in (("number_of_teeth", "mate_number_of_teeth"), ("mate_number_of_teeth", "number_of_teeth")):
            same_size(key, getattr(second, key), getattr(first, wanted), "not_of_its_mate")
        same_sizes(_ALIKE, second, first, "not_of_its_mate")
        for key in _OPPOSITE:
            same_size(key, getattr(second, key), -getattr(first, key) or 0.0, "not_of_its_mate")

    def build(self, end: End[Any]) -> BevelGear:
        """The whole gear."""
        gear: BevelGear = end.thing
        return gear.checked()

    def cosine(self, first: End[BevelGear], second: End[BevelGear]) -> float:
        """At the outer end."""
        return first.thing.normal_share

    def mating(self, keys: BevelPairSpec, first: End[BevelGear], second: End[BevelGear]) -> BevelMating:
        """Each must be what the other one is made for."""
        from geometry.gears.bevel.pair import BevelPair

        _check_lines(first, second)
        pair, angle = BevelPair(first.thing, second.thing), first.thing.shaft_angle
        distances = first.thing.mounting_distance, second.thing.mounting_distance
        return BevelMating(
            *self.joined(keys),
            height=distances[0] - distances[1] * math.cos(angle),
            distance=distances[1] * math.sin(angle),
            module=first.thing.module,
            normal_backlash=pair.normal_backlash,
            teeth=(first.thing.number_of_teeth, second.thing.number_of_teeth),
            pair=pair,
        )


def _check_lines(first: End[BevelGear], second: End[BevelGear]) -> None:
    """Refuse the second's key in which tooth lines are not the first's on the crown gear, seen from its two sides."""
    if first.thing.is_straight and second.thing.is_straight:
        return
    # the crown gear of both is one: its tooth lines are the same, not nearly
    for key in ("spiral_angle_deg", "tooth_line"):
        if (own := getattr(second.keys, key)) != (wanted := getattr(first.keys, key)):
            raise ParameterError(key, own, "not_of_its_mate", Nearest(wanted))
    # the mean cone distance is that of the face
    same_sizes(("face_width", "cutter_radius"), second.thing, first.thing, "not_of_its_mate")
    same_size("hand", second.thing.hand, first.thing.opposite().hand, "not_of_its_mate")

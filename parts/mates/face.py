"""A face gear and its spur pinion: both axes meet at a right angle, a tooth of one stands in a space of the other."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any

from geometry.base.errors import Nearest, ParameterError
from geometry.base.findings import Finding
from geometry.base.record import replace
from geometry.base.tolerance import CONTACT_TOLERANCE
from parts.base.mate import End, LaidStanding
from parts.keys.base import mm
from parts.keys.helix import helix_of
from parts.keys.mate import GearPairKeys, backlash
from parts.keys.wheel import shape_of
from parts.mates.gear_pair import GearPair, Meeting
from parts.mates.sizes import same_size, same_sizes

if TYPE_CHECKING:
    from geometry.base.placement import Placement3, Vector
    from geometry.gears.face.gear import FaceGear
    from geometry.gears.face.pair import FacePair
    from geometry.gears.teeth.spur import SpurGear

# of the module
_ROUNDING = 1e-9

_PINION_OFFSET = mm("how far the middle of the pinion's face is off that of the gear's, outwards", least=-1e4, most=1e4)


class FaceGearPairSpec(GearPairKeys, tag="face_gear_pair", kw_only=True):
    """Keys of ``face_gear_pair``."""

    pinion_offset: Annotated[float, _PINION_OFFSET] = 0.0
    normal_backlash: Annotated[float, backlash("normal backlash: thins both gears by half")] | None = None


class FaceMating(Meeting):
    """A face gear (first) and its pinion, whose z leads to the gear's axis."""

    pair: FacePair

    def second_axis(self, direction: float) -> Vector:
        """Towards the gear's axis."""
        return -math.cos(direction), -math.sin(direction), 0.0

    def second_rotation(self, rotation: float, direction: float) -> float:
        """Where a tooth of the pinion stands in a space of the gear."""
        gear = self.pair.gear
        pitch = math.tau / gear.number_of_teeth
        ahead = math.remainder(rotation + pitch / 2 - direction, pitch)
        return direction + math.pi - ahead * self.pair.ratio

    def laid_standing(self, first: Placement3, second: Placement3) -> LaidStanding:
        """In the frame of the first, where its tooth is on +x: axes, and how far the pinion is turned off."""
        import numpy as np

        pinion, meet = self.pair.pinion, np.array([0.0, 0.0, self.pair.gear.mounting_distance])
        seen = first.inverse() @ second
        apart = float(np.linalg.norm(np.cross(meet - seen.apply(np.zeros(3)), seen.z)))
        return self.seen_standing(seen, apart, math.pi / 2, pinion.base_radius, self.pair.gear.outer_radius)

    def laid(self, first: Placement3, second: Placement3) -> FaceMating:
        """The same pair with the pinion's face where it stands."""
        import numpy as np

        seen = first.inverse() @ second
        start = float(np.hypot(*seen.apply(np.zeros(3))[:2]))
        width = self.pair.high - self.pair.low
        return replace(self, pair=replace(self.pair, low=start - width, high=start))

    def findings(self) -> tuple[Finding, ...]:
        """Whether a tip meets what is no flank, or a root, and whether one tooth follows on the other."""
        from geometry.gears.teeth.limits import root_form_diameter

        pair, found = self.pair, []
        least = -_ROUNDING * pair.gear.module
        if pair.form_reserve < least:
            begins = pair.form_length
            found.append(Finding("fillet_interference_second", begins + pair.form_reserve, begins))
        elif pair.tip_in_fillet[0] < -CONTACT_TOLERANCE * pair.gear.module:
            begins = root_form_diameter(pair.pinion) / 2
            found.append(Finding("contact_below_flank_second", pair.tip_in_fillet[1], begins))
        if pair.gear_form_reserve < least:
            ends = pair.gear.shaper.form_length
            found.append(Finding("fillet_interference_first", ends - pair.gear_form_reserve, ends))
        for name, clearance in zip(("first", "second"), pair.bottom_clearances, strict=True):
            if clearance < least:
                found.append(Finding(f"tip_clearance_{name}", clearance, 0.0))
        if pair.hub_clearance < least:
            found.append(Finding("hub_clearance_first", pair.hub_clearance, 0.0))
        if pair.contact_ratio < 1:
            found.append(Finding("contact_ratio", pair.contact_ratio, 1.0))
        return tuple(found)

    def quantities(self) -> dict[str, Any]:
        """Ratio, contact ratio, clearances."""
        clearances = self.pair.bottom_clearances
        return {
            "ratio": self.pair.ratio,
            "contact_ratio": self.pair.contact_ratio,
            "normal_backlash": self.pair.normal_backlash,
            "bottom_clearance_at_root": {"first": clearances[0], "second": clearances[1]},
            **({"end_gap": self.pair.end_gap} if self.pair.gear.more_teeth else {}),
        }


class FaceGearPairKind(GearPair[FaceGearPairSpec, "FaceGear", "SpurGear"]):
    """A face gear and the pinion that it is made for."""

    name, keys = "face_gear_pair", FaceGearPairSpec
    joins = (("face_gear", "spur_gear"),)

    def check(self, keys: FaceGearPairSpec, first: Any, second: Any) -> None:
        """The pinion is the one that the gear is made for: straight, of its teeth and its shift."""
        helix = helix_of(second)
        if helix.angle:
            raise ParameterError("helix_angle_deg", second.helix_angle_deg, "not_of_its_mate", Nearest(0.0))
        if second.number_of_teeth != first.pinion_number_of_teeth:
            raise ParameterError("number_of_teeth", second.number_of_teeth, "not_of_its_mate",
                                 Nearest(first.pinion_number_of_teeth), of="pinion_number_of_teeth")  # fmt: skip
        same_sizes(("module", "pressure_angle_deg"), second, first, "not_of_its_mate")
        shift = first.pinion_profile_shift_coefficient
        same_size("profile_shift_coefficient", second.profile_shift_coefficient, shift, "not_of_its_mate")

    def build(self, end: End[Any]) -> object:
        """The whole gear, or a tooth of the pinion."""
        from geometry.gears.teeth.tooth import tooth_side

        return end.thing.checked() if end.kind == "face_gear" else tooth_side(end.thing)

    def cosine(self, first: End[FaceGear], second: End[SpurGear]) -> float:
        """Of the pinion."""
        return math.cos(second.thing.pressure_angle)

    def mating(self, keys: FaceGearPairSpec, first: End[FaceGear], second: End[SpurGear]) -> FaceMating:
        """The pinion's face over the gear's."""
        from geometry.gears.face.pair import FacePair
        from parts.gears.spur_gear.part import SpurGearSpec

        gear, pinion = first.thing, second.thing
        assert isinstance(second.keys, SpurGearSpec)
        width, hub = second.keys.face_width, shape_of(second.keys).hub
        middle = (gear.inner_radius + gear.outer_radius) / 2 + keys.pinion_offset
        room = (gear.face_width + width) / 2
        if abs(keys.pinion_offset) >= room:
            raise ParameterError("mate.pinion_offset", keys.pinion_offset, "face_gear_beside", Nearest(0.0))
        pair = FacePair(gear, pinion, middle - width / 2, middle + width / 2, hub)
        return FaceMating(
            *self.joined(keys),
            height=gear.mounting_distance,
            distance=middle + width / 2,
            module=gear.module,
            normal_backlash=pair.normal_backlash,
            teeth=(gear.number_of_teeth, pinion.number_of_teeth),
            pair=pair,
        )

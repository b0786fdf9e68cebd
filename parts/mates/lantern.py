"""The mate ``lantern_pair``: a lantern and the gear that its pins drive."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any

from geometry.base.errors import ParameterError, limit
from parts.base.mate import End, MateKeys, MateKind, Pose, Standing, Toothed
from parts.keys.mate import Direction, height
from parts.mates.sizes import same_size

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.gears.mesh.search import PairContact
    from geometry.gears.pins.lantern import LanternGear
    from geometry.solids.pin_plates import PinPlate


class LanternPairSpec(MateKeys, tag="lantern_pair", kw_only=True):
    """Keys of ``lantern_pair``."""

    direction_deg: Direction = 0.0
    height: Annotated[float, height("gear above the lantern's lower face; default: midway on the pins")] | None = None


class LanternMating(Toothed):
    """A lantern and its gear."""

    gear: LanternGear
    in_scheme = True

    @property
    def ratio(self) -> float:
        """Turns of the gear for one of the lantern."""
        return -self.gear.number_of_pins / self.gear.number_of_teeth

    def second_rotation(self, rotation: float, direction: float) -> float:
        """Where a pin stands on the line of centres, a space does."""
        return direction + math.pi - self.gear.pitch_angle / 2 + (rotation - direction) * self.ratio

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and the gear's turn off the middle of its play."""
        # a pin's normal passes the gear's axis at r at most
        return self.turned_off(first, second, self.gear.pitch_angle, self.gear.pitch_radius)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict of all pins over one pitch."""
        from geometry.gears.pins.contact import pin_contact
        from geometry.gears.pins.lantern import LanternMotion, lantern_side

        return pin_contact(lantern_side(self.gear), LanternMotion(self.gear, phase_off, distance_off), tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """A drive that is interrupted."""
        from geometry.gears.pins.lantern import lantern_findings

        return lantern_findings(self.gear)

    def quantities(self) -> dict[str, Any]:
        """Sizes of the pair, mm."""
        return {
            "gear_ratio": 1 / abs(self.ratio),
            "working_centre_distance": self.distance,
            "pitch": self.gear.pitch,
            "lantern_contact_ratio": self.gear.contact_ratio,
            "pin_clearance": self.gear.pin_clearance,
        }


class LanternPair(MateKind[LanternPairSpec, "PinPlate", "LanternGear"]):
    """A lantern and its gear."""

    name, keys = "lantern_pair", LanternPairSpec
    joins = (("lantern_wheel", "lantern_gear"),)

    def mating(self, keys: LanternPairSpec, first: End[PinPlate], second: End[LanternGear]) -> LanternMating:
        """The gear is for these pins, and goes between the plates."""
        lantern, gear = first.thing, second.thing
        same_size("number_of_pins", gear.number_of_pins, lantern.pins.count, "not_of_the_lantern")
        circles = gear.pin_circle_diameter, lantern.pins.pitch_circle_diameter
        same_size("pin_circle_diameter", *circles, "not_of_the_lantern")
        same_size("pin_diameter", gear.pin_diameter, lantern.pins.diameter, "not_of_the_lantern")
        height = keys.height
        if height is None:
            height = lantern.thickness
            if lantern.solid:
                if gear.face_width > lantern.length:
                    most = limit(lantern.length, gear.face_width)
                    raise ParameterError("face_width", gear.face_width, "not_between_the_plates", most)
                height += (lantern.length - gear.face_width) / 2
        return LanternMating(
            *self.joined(keys),
            height=height,
            distance=gear.centre_distance,
            module=gear.pin_diameter / 2,
            # pins are teeth
            rolls="external",
            teeth=(gear.number_of_pins, gear.number_of_teeth),
            # on both sides together
            normal_backlash=2 * gear.pin_clearance,
            # a single plate stands beside the gear
            has_contact=lantern.solid,
            gear=gear,
        )

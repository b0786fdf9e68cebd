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
    """A lantern and its gear, in either order."""

    gear: LanternGear
    gear_first: bool
    in_scheme = True

    @property
    def ratio(self) -> float:
        """Turns of the second for one of the first."""
        return -self.teeth[0] / self.teeth[1]

    def second_rotation(self, rotation: float, direction: float) -> float:
        """Where a pin stands on the line of centres, a space does."""
        # of the first a pin or a space lies towards the second, of the second what goes with it
        space = self.gear.pitch_angle / 2
        towards, back = (space, 0.0) if self.gear_first else (0.0, space)
        return direction + math.pi - back + (rotation - direction + towards) * self.ratio

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and the second's turn off the middle of its play."""
        # a pin's normal passes an axis at the pitch radius at most
        arm = self.gear.lantern_radius if self.gear_first else self.gear.pitch_radius
        return self.turned_off(first, second, math.tau / self.teeth[1], arm)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict of all pins over one pitch."""
        from geometry.gears.pins.contact import LanternMotion, pin_contact
        from geometry.gears.pins.lantern import lantern_side

        # a lantern that is ahead meets the flanks that a gear would meet that is ahead
        turn = phase_off * self.gear.number_of_pins / self.gear.number_of_teeth if self.gear_first else phase_off
        return pin_contact(lantern_side(self.gear), LanternMotion(self.gear, turn, distance_off), tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """A drive that is interrupted."""
        from geometry.gears.pins.lantern import lantern_findings

        return lantern_findings(self.gear)

    def quantities(self) -> dict[str, Any]:
        """Sizes of the pair, mm."""
        return {
            "gear_ratio": self.gear.number_of_teeth / self.gear.number_of_pins,
            "working_centre_distance": self.distance,
            "pitch": self.gear.pitch,
            "lantern_contact_ratio": self.gear.contact_ratio,
            "pin_clearance": self.gear.pin_clearance,
        }


class LanternPair(MateKind[LanternPairSpec, "PinPlate | LanternGear", "PinPlate | LanternGear"]):
    """A lantern and its gear, in either order."""

    name, keys = "lantern_pair", LanternPairSpec
    joins = (("lantern_wheel", "lantern_gear"), ("lantern_gear", "lantern_wheel"))

    def mating(self, keys: LanternPairSpec, first: End[Any], second: End[Any]) -> LanternMating:
        """The gear is for these pins, and goes between the plates."""
        gear_first = first.kind == "lantern_gear"
        lantern: PinPlate = (second if gear_first else first).thing
        gear: LanternGear = (first if gear_first else second).thing
        blamed = "first." if gear_first else ""
        same_size(f"{blamed}number_of_pins", gear.number_of_pins, lantern.pins.count, "not_of_the_lantern")
        circles = gear.pin_circle_diameter, lantern.pins.pitch_circle_diameter
        same_size(f"{blamed}pin_circle_diameter", *circles, "not_of_the_lantern")
        same_size(f"{blamed}pin_diameter", gear.pin_diameter, lantern.pins.diameter, "not_of_the_lantern")
        height = keys.height
        if height is None:
            height = lantern.thickness
            if lantern.solid:
                if gear.face_width > lantern.length:
                    most = limit(lantern.length, gear.face_width)
                    raise ParameterError(f"{blamed}face_width", gear.face_width, "not_between_the_plates", most)
                height += (lantern.length - gear.face_width) / 2
        teeth = gear.number_of_pins, gear.number_of_teeth
        return LanternMating(
            *self.joined(keys),
            # of the second above the first
            height=-height if gear_first else height,
            distance=gear.centre_distance,
            module=gear.pin_diameter / 2,
            # pins are teeth
            rolls="external",
            teeth=teeth[::-1] if gear_first else teeth,
            # on both sides together
            normal_backlash=2 * gear.pin_clearance,
            # a single plate stands beside the gear
            has_contact=lantern.solid,
            gear=gear,
            gear_first=gear_first,
        )

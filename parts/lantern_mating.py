"""What the mates of lanterns, loose pins and shafts make of their parts."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from geometry.errors import ParameterError
from parts.fixed_mate import FixedMating
from parts.joined import Joined, same_size, turn_off
from parts.pin_mates import CoaxialSpec, LanternPairSpec, PinSeatSpec
from parts.standing import Standing

if TYPE_CHECKING:
    from geometry.findings import Finding
    from geometry.gears.lantern import LanternGear
    from geometry.gears.mesh_search import PairContact
    from geometry.pin_plates import PinPlate, RoundDisc
    from geometry.pin_ring import PinRing


@dataclass(frozen=True, slots=True)
class CoaxialMating(Joined):
    """Two instances on one axis."""

    rotation: float
    kind: str = "coaxial"
    ratio: None = None
    distance: float = 0.0
    module: float = 1.0
    # the solids tell
    has_contact: bool = False

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """On the axis of the first."""
        return centre, rotation + self.rotation

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How far the axes are apart; the second is free to turn."""
        return Standing(0.0, abs(second[0] - first[0]), 0.0, 0.0)


def coaxial_mating(mate: CoaxialSpec, first: Any, second: Any) -> CoaxialMating:
    """The mating of two parts on one axis."""
    return CoaxialMating(mate.first, mate.second, 0.0, mate.height, math.radians(mate.rotation_deg))


def pin_seat_mating(mate: PinSeatSpec, holder: PinRing | PinPlate, pin: RoundDisc) -> FixedMating:
    """The mating of a loose pin with its seat.

    Raises
    ------
    ParameterError
        There is no such seat, the holder has no loose pins, or the pin has another diameter.
    """
    from geometry.pin_ring import PinRing
    from geometry.windows import RoundHoles

    if isinstance(holder, PinRing):
        loose, count = holder.pins != "fixed", holder.number_of_pins
        centres = RoundHoles(count, 2 * holder.seat_radius, 2 * holder.pin_circle_radius).centres()
    else:
        loose, centres = not holder.solid, holder.pins.centres()
    if not loose:
        raise ParameterError("mate.first", mate.first, "has its pins already; give it seats or holes")
    if mate.number > len(centres):
        raise ParameterError("mate.number", mate.number, f"there are {len(centres)} seats; {len(centres)} works")
    same_size("diameter", 2 * pin.radius, 2 * holder.pin_radius, "the seats")
    centre = centres[mate.number - 1]
    return FixedMating(mate.first, mate.second, 0.0, mate.height, centre, 0.0, kind="pin_seat")


@dataclass(frozen=True, slots=True)
class LanternMating(Joined):
    """A lantern and its gear."""

    lantern: PinPlate
    gear: LanternGear
    kind: str = "lantern_pair"

    @property
    def distance(self) -> float:
        """a, mm."""
        return self.gear.centre_distance

    @property
    def module(self) -> float:
        """The pin's radius, mm."""
        return self.gear.pin_diameter / 2

    @property
    def first_teeth(self) -> int:
        """N."""
        return self.gear.number_of_pins

    @property
    def normal_backlash(self) -> float:
        """Gap between flank and pin, mm, on both sides together."""
        return 2 * self.gear.pin_clearance

    @property
    def ratio(self) -> float:
        """-N / z."""
        return -self.gear.number_of_pins / self.gear.number_of_teeth

    @property
    def has_contact(self) -> bool:
        """A single plate stands beside the gear."""
        return self.lantern.solid

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The gear beyond the line of centres; where a pin stands on it, a space does."""
        turned = direction + math.pi - self.gear.pitch_angle / 2 + (rotation - direction) * self.ratio
        return centre + cmath.rect(self.distance, direction), turned

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """Centre distance, and the gear's turn off the middle of its play."""
        spoke = second[0] - first[0]
        direction = cmath.phase(spoke)
        _, right = self.second_pose(*first, direction)
        off = turn_off(second[1], right, self.gear.pitch_angle)
        # a pin's normal passes the gear's axis at r at most
        arm = self.gear.pitch_radius
        return Standing(direction, abs(spoke), off, self.gear.pin_clearance / arm, arm)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict of all pins over one pitch."""
        from geometry.gears.lantern import LanternMotion, lantern_side
        from geometry.gears.pin_contact import pin_contact

        return pin_contact(lantern_side(self.gear), LanternMotion(self.gear, phase_off, distance_off), tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """A drive that is interrupted."""
        from geometry.gears.lantern import lantern_findings

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


def lantern_mating(mate: LanternPairSpec, lantern: PinPlate, gear: LanternGear) -> LanternMating:
    """The mating of a lantern and its gear.

    Raises
    ------
    ParameterError
        The gear is not for these pins, or is too wide for the lantern.
    """
    if gear.number_of_pins != lantern.pins.count:
        raise ParameterError(
            "number_of_pins", gear.number_of_pins, f"the lantern has others; {lantern.pins.count} works"
        )
    same_size("pin_circle_diameter", gear.pin_circle_diameter, lantern.pins.pitch_circle_diameter, "the lantern")
    same_size("pin_diameter", gear.pin_diameter, lantern.pins.diameter, "the lantern")
    height = mate.height
    if height is None:
        height = lantern.thickness
        if lantern.solid:
            if gear.face_width > lantern.length:
                text = f"does not go between the plates; at most {lantern.length:.12g} mm works"
                raise ParameterError("face_width", gear.face_width, text)
            height += (lantern.length - gear.face_width) / 2
    return LanternMating(mate.first, mate.second, mate.direction_deg, height, lantern, gear)

"""What the mates of a cycloidal reducer make of their parts: disc in its ring, on its eccentric, with output pins."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from geometry.errors import ParameterError
from geometry.findings import Finding
from parts.joined import Joined, same_size, turn_off
from parts.pin_mates import CycloidalPairSpec, EccentricBearingSpec, OutputPinsSpec
from parts.standing import Standing

if TYPE_CHECKING:
    from geometry.gears.cycloidal import CycloidalDisc
    from geometry.gears.mesh_search import ContactPlace, PairContact
    from geometry.pin_plates import PinPlate, RoundDisc
    from geometry.pin_ring import PinRing
    from geometry.windows import RoundHoles

# sums of typed sizes
_ROUNDING = 1e-12


@dataclass(frozen=True, slots=True)
class CycloidalMating(Joined):
    """A disc in its ring. The pins turn nothing on: the eccentric does."""

    ring: PinRing
    disc: CycloidalDisc
    turned_lobes: int = 0
    kind: str = "cycloidal_pair"
    ratio: None = None

    @property
    def distance(self) -> float:
        """e, mm."""
        return self.disc.eccentricity

    @property
    def module(self) -> float:
        """The pin's radius, mm: what tolerances go by."""
        return self.disc.pin_diameter / 2

    @property
    def has_contact(self) -> bool:
        """A plate with holes stands beside the disc."""
        return self.ring.pins != "holes"

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The disc's centre towards the eccentric, a valley at the pin that it points to."""
        turned = self.disc.rotation(direction - rotation) + self.turned_lobes * self.disc.pitch_angle
        return centre + cmath.rect(self.distance, direction), rotation + turned

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """Eccentric distance, and the disc's turn off the middle of its play."""
        from geometry.gears.pin_contact import DiscMotion, pin_contact

        spoke = second[0] - first[0]
        direction = cmath.phase(spoke) if spoke else 0.0
        right = first[1] + self.disc.rotation(direction - first[1])
        off = turn_off(second[1], right, self.disc.pitch_angle)
        gap = pin_contact(self.disc.side(), DiscMotion(self.disc)).worst.gap
        # a pin's normal passes the disc's centre at e z at most
        return Standing(direction, abs(spoke), off, max(gap, 0.0) / self.disc.pitch_radius, self.disc.pitch_radius)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict of all pins, and of the lobes against the inside of the ring, over a turn of the eccentric."""
        from geometry.gears.pin_contact import DiscMotion, pin_contact

        motion = DiscMotion(self.disc, phase_off, distance_off)
        return pin_contact(self.disc.side(), motion, tolerance, self._inside(distance_off))

    def _inside(self, distance_off: float) -> tuple[ContactPlace, ...]:
        """A lobe's top comes nearest to the ring where it points along the eccentric."""
        from geometry.gears.mesh_search import ContactPlace
        from geometry.profile import Label

        if not self.has_contact:
            return ()
        reach = self.disc.tip_radius + self.distance + distance_off
        labels = (Label.RIM, Label.LOBE)
        return (ContactPlace(self.ring.inner_radius - reach, math.pi, complex(reach), labels),)

    def findings(self) -> tuple[Finding, ...]:
        """Lobes that reach the inside of the ring."""
        needed = 2 * (self.disc.tip_radius + self.distance)
        if not self.has_contact or 2 * self.ring.inner_radius >= needed * (1 - _ROUNDING):
            return ()
        return (Finding("lobes_reach_ring", 2 * self.ring.inner_radius, needed),)

    def quantities(self) -> dict[str, Any]:
        """Reduction with the ring held: turns of the eccentric for one of the disc, against each other."""
        from geometry.gears.pin_contact import DiscMotion, lost_motion, pins_in_contact

        side, motion = self.disc.side(), DiscMotion(self.disc)
        return {
            "reduction": -float(self.disc.number_of_lobes),
            "eccentricity": self.disc.eccentricity,
            "shortening_coefficient": self.disc.shortening,
            "least_path_radius": self.disc.least_path_radius,
            "pins_in_contact": pins_in_contact(side, motion),
            "lost_motion_deg": math.degrees(lost_motion(side, motion)),
        }


def cycloidal_mating(mate: CycloidalPairSpec, ring: PinRing, disc: CycloidalDisc) -> CycloidalMating:
    """The mating of a disc and its ring.

    Raises
    ------
    ParameterError
        The disc is not for these pins; names its key and what works.
    """
    if disc.number_of_pins != ring.number_of_pins:
        text = f"{ring.number_of_pins} pins need one lobe fewer; {ring.number_of_pins - 1} works"
        raise ParameterError("number_of_lobes", disc.number_of_lobes, text)
    same_size("pin_circle_diameter", disc.pin_circle_diameter, 2 * ring.pin_circle_radius, "the ring")
    same_size("pin_diameter", disc.pin_diameter, 2 * ring.pin_radius, "the ring")
    height = mate.height
    if height is None:
        height = ring.face_width if ring.pins == "holes" else 0.0
    return CycloidalMating(mate.first, mate.second, mate.direction_deg, height, ring, disc, mate.turned_lobes)


@dataclass(frozen=True, slots=True)
class BearingMating(Joined):
    """A disc on its eccentric."""

    eccentric: RoundDisc
    disc: CycloidalDisc
    bore_diameter: float
    kind: str = "eccentric_bearing"

    @property
    def distance(self) -> float:
        """e, mm."""
        return self.eccentric.eccentricity

    @property
    def module(self) -> float:
        """Radius of the eccentric, mm."""
        return self.eccentric.radius

    @property
    def ratio(self) -> float:
        """-1 / z with the ring held."""
        return -1 / self.disc.number_of_lobes

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The disc about the eccentric's middle, turned as in a ring whose first pin is on +x."""
        return centre + cmath.rect(self.distance, rotation), self.disc.rotation(rotation)

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How far the disc is from the eccentric's middle is added to the distance; it turns freely on it."""
        centre, _ = self.second_pose(*first, 0.0)
        return Standing(first[1], self.distance + abs(second[0] - centre), 0.0, 0.0)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """The bore about the eccentric."""
        from geometry.gears.pin_contact import PIN_CONTACT_TOLERANCE, stated_contact
        from geometry.profile import Label

        gap = self.bore_diameter / 2 - self.module - abs(distance_off)
        allowed = PIN_CONTACT_TOLERANCE * self.module if tolerance is None else tolerance
        return stated_contact(gap, allowed, (Label.BODY, Label.BORE), complex(self.distance + self.module))

    def quantities(self) -> dict[str, Any]:
        """The play of the bearing on the diameter, mm."""
        return {"eccentricity": self.distance, "bearing_play": self.bore_diameter - 2 * self.module}


def bearing_mating(mate: EccentricBearingSpec, eccentric: RoundDisc, disc: CycloidalDisc) -> BearingMating:
    """The mating of an eccentric and a disc.

    Raises
    ------
    ParameterError
        Their eccentricities differ, or the disc has no round bore.
    """
    from geometry.bores import RoundBore

    same_size("eccentricity", disc.eccentricity, eccentric.eccentricity, "the eccentric")
    bore = disc.holes.bore
    if not isinstance(bore, RoundBore):
        text = f"the disc needs a round bore for the eccentric; {2 * eccentric.radius:.12g} works"
        raise ParameterError("bore_diameter", 0.0 if bore is None else 2 * bore.reach, text)
    return BearingMating(mate.first, mate.second, 0.0, mate.height, eccentric, disc, bore.diameter)


@dataclass(frozen=True, slots=True)
class OutputMating(Joined):
    """The pins of a plate in the holes of a disc: each touches its hole in the direction of the eccentric."""

    disc: CycloidalDisc
    output: RoundHoles
    plate: PinPlate
    kind: str = "output_pins"
    ratio: float = 1.0

    @property
    def distance(self) -> float:
        """e, mm."""
        return self.disc.eccentricity

    @property
    def module(self) -> float:
        """The pin's radius, mm."""
        return self.plate.pin_radius

    @property
    def has_contact(self) -> bool:
        """Loose pins are other instances."""
        return self.plate.solid

    @property
    def gap(self) -> float:
        """Of every pin in its hole, mm, at the exact place: half of the holes' clearance."""
        return self.output.diameter / 2 - self.plate.pin_radius - self.distance

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The plate's axis against the eccentric's direction, its pins in the holes."""
        return centre - cmath.rect(self.distance, direction), rotation + self.output.start - self.plate.pins.start

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """Distance of the axes, and the plate's turn against the holes."""
        _, right = self.second_pose(*first, 0.0)
        off = turn_off(second[1], right, 2 * math.pi / self.output.count)
        arm = self.output.pitch_circle_diameter / 2
        spoke = first[0] - second[0]
        play = 2 * math.asin(min(1.0, max(self.gap, 0.0) / (2 * arm)))
        return Standing(cmath.phase(spoke) if spoke else 0.0, abs(spoke), off, play, arm)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """All pins over a turn: the worst has the axes' offset and the turn in one direction."""
        from geometry.gears.pin_contact import PIN_CONTACT_TOLERANCE, stated_contact
        from geometry.profile import Label

        arm = self.output.pitch_circle_diameter / 2
        gap = self.gap - distance_off - 2 * arm * abs(math.sin(phase_off / 2))
        allowed = PIN_CONTACT_TOLERANCE * self.module if tolerance is None else tolerance
        return stated_contact(gap, allowed, (Label.HOLE, Label.PIN), complex(arm + self.module))

    def findings(self) -> tuple[Finding, ...]:
        """Holes that are too small for their pins to go round by the eccentricity."""
        needed = 2 * (self.plate.pin_radius + self.distance)
        if self.output.diameter >= needed * (1 - _ROUNDING):
            return ()
        return (Finding("output_holes_small", self.output.diameter, needed),)

    def quantities(self) -> dict[str, Any]:
        """Sizes of pins and holes, mm."""
        return {
            "output_pins": self.output.count,
            "hole_diameter": self.output.diameter,
            "pin_diameter": 2 * self.plate.pin_radius,
            "eccentricity": self.distance,
        }


def output_mating(mate: OutputPinsSpec, disc: CycloidalDisc, plate: PinPlate) -> OutputMating:
    """The mating of a disc and its output plate.

    Raises
    ------
    ParameterError
        The plate's pins are not those of the holes.
    """
    if disc.output is None:
        raise ParameterError("mate.first", mate.first, "has no output_holes; give the disc that table")
    if plate.pins.count != disc.output.count:
        raise ParameterError("number_of_pins", plate.pins.count, f"the disc has other holes; {disc.output.count} works")
    same_size("pin_circle_diameter", plate.pins.pitch_circle_diameter, disc.output.pitch_circle_diameter, "the holes")
    height = -plate.thickness if mate.height is None else mate.height
    return OutputMating(mate.first, mate.second, mate.direction_deg, height, disc, disc.output, plate)

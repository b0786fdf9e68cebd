"""Mates of a cycloidal reducer: the disc in its ring, on its eccentric, with output pins."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError
from geometry.base.findings import Finding
from geometry.base.record import replace
from parts.base.mate import End, MateKeys, MateKind, Pose, Standing, Touching
from parts.keys.mate import AboveKeys, Height, direction, height
from parts.mates.sizes import same_size

if TYPE_CHECKING:
    from geometry.gears.mesh.search import ContactPlace, PairContact
    from geometry.gears.pins.cycloidal import CycloidalDisc
    from geometry.solids.pin_plates import PinPlate, RoundDisc
    from geometry.solids.pin_ring import PinRing
    from geometry.solids.windows import RoundHoles

# sums of typed sizes
_ROUNDING = 1e-12
# radii of a pin by which the inside of a ring that yields keeps off the lobes
_OFF_LOBES = 0.1
_Eccentric = Annotated[float, direction("direction of the eccentric, from the pins' axis")]

_TURNED_LOBES = Meta(ge=-10_000, le=10_000, description="turns the disc on by whole lobes: for holes that must line up")


class CycloidalPairSpec(MateKeys, tag="cycloidal_pair", kw_only=True):
    """Keys of ``cycloidal_pair``."""

    direction_deg: _Eccentric = 0.0
    turned_lobes: Annotated[int, _TURNED_LOBES] = 0
    height: Height | None = None


class EccentricBearingSpec(AboveKeys, tag="eccentric_bearing"):
    """Keys of ``eccentric_bearing``."""


class OutputPinsSpec(MateKeys, tag="output_pins", kw_only=True):
    """Keys of ``output_pins``."""

    direction_deg: _Eccentric = 0.0
    height: Annotated[float, height("plate above the disc; default: it carries the disc on its face")] | None = None


class CycloidalMating(Touching):
    """A disc in its ring, which is held. The pins turn nothing on: the eccentric does."""

    ring: PinRing
    disc: CycloidalDisc
    turned_lobes: int

    without_carrier = "disc_on_no_eccentric"

    @property
    def holds(self) -> tuple[str, ...]:
        """The ring."""
        return (self.first,)

    def second_rotation(self, rotation: float, direction: float) -> float:
        """A valley at the pin to which the eccentric points."""
        turned = self.disc.rotation(direction - rotation) + self.turned_lobes * self.disc.pitch_angle
        return rotation + turned

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Eccentric distance, and the disc's turn off the middle of its play."""
        from geometry.gears.pins.contact import DiscMotion, pin_contact

        spoke = second[0] - first[0]
        direction = cmath.phase(spoke) if spoke else 0.0
        right = first[1] + self.disc.rotation(direction - first[1])
        off = math.remainder(second[1] - right, self.disc.pitch_angle)
        gap = pin_contact(self.disc.side(), DiscMotion(self.disc)).worst.gap
        # a pin's normal passes the disc's centre at e z at most
        return Standing(abs(spoke), off, max(gap, 0.0) / self.disc.pitch_radius, self.disc.pitch_radius)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict of all pins, and of the lobes against the inside of the ring, over a turn of the eccentric."""
        from geometry.gears.pins.contact import DiscMotion, pin_contact

        motion = DiscMotion(self.disc, phase_off, distance_off)
        return pin_contact(self.disc.side(), motion, tolerance, self._inside(distance_off))

    def _inside(self, distance_off: float) -> tuple[ContactPlace, ...]:
        """A lobe's top comes nearest to the ring where it points along the eccentric."""
        from geometry.gears.mesh.search import ContactPlace
        from geometry.plane.profile import Label

        if not self.has_contact:
            return ()
        reach = self.disc.tip_radius + self.distance + distance_off
        labels = (Label.RIM, Label.LOBE)
        return (ContactPlace(self.ring.inner_radius - reach, math.pi, complex(reach), labels),)

    def findings(self) -> tuple[Finding, ...]:
        """Lobes that reach the inside of the ring, or that of any ring which would hold its pins."""
        needed = 2 * (self.disc.tip_radius + self.distance)
        if not self.has_contact or 2 * self.ring.inner_radius >= needed * (1 - _ROUNDING):
            return ()
        if needed > 2 * (most := self.ring.inner_limits[1]):
            most_eccentricity = self.distance - (needed / 2 - most) / 2
            return (Finding("lobes_beyond_pins", self.distance, most_eccentricity),)
        return (Finding("lobes_reach_ring", 2 * self.ring.inner_radius, needed),)

    def quantities(self) -> dict[str, Any]:
        """Reduction with the ring held: turns of the eccentric for one of the disc, against each other."""
        from geometry.gears.pins.contact import DiscMotion, lost_motion, pins_in_contact

        side, motion = self.disc.side(), DiscMotion(self.disc)
        return {
            "reduction": -float(self.disc.number_of_lobes),
            "eccentricity": self.disc.eccentricity,
            "shortening_coefficient": self.disc.shortening,
            "least_path_radius": self.disc.least_path_radius,
            "pins_in_contact": pins_in_contact(side, motion),
            # angles below that are rounding
            "lost_motion_deg": round(math.degrees(lost_motion(side, motion)), 12) + 0.0,
        }


class BearingMating(Touching):
    """A disc on its eccentric."""

    disc: CycloidalDisc
    bore_diameter: float

    bond = "turning"

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """The disc about the eccentric's middle, turned as in a ring whose first pin is on +x."""
        return centre + cmath.rect(self.distance, rotation), self.disc.rotation(rotation)

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the disc is from the eccentric's middle is added to the distance; it turns freely on it."""
        return self.off_place(first, second, free=True)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """The bore about the eccentric."""
        from geometry.gears.pins.contact import PIN_CONTACT_TOLERANCE, stated_contact
        from geometry.plane.profile import Label

        gap = self.bore_diameter / 2 - self.module - abs(distance_off)
        allowed = self.tolerated(PIN_CONTACT_TOLERANCE, tolerance)
        return stated_contact(gap, allowed, (Label.BODY, Label.BORE), complex(self.distance + self.module))

    def quantities(self) -> dict[str, Any]:
        """The play of the bearing on the diameter, mm."""
        return {"eccentricity": self.distance, "bearing_play": self.bore_diameter - 2 * self.module}


class OutputMating(Touching):
    """The pins of a plate in the holes of a disc: each touches its hole in the direction of the eccentric."""

    output: RoundHoles
    plate: PinPlate

    @property
    def gap(self) -> float:
        """Of every pin in its hole, mm, at the exact place: half of the holes' clearance."""
        return self.output.diameter / 2 - self.plate.pin_radius - self.distance

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """The plate's axis against the eccentric's direction, its pins in the holes."""
        return centre - cmath.rect(self.distance, direction), rotation + self.output.start - self.plate.pins.start

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Distance of the axes, and the plate's turn against the holes."""
        _, right = self.second_pose(*first, 0.0)
        off = math.remainder(second[1] - right, 2 * math.pi / self.output.count)
        arm = self.output.pitch_circle_diameter / 2
        play = 2 * math.asin(min(1.0, max(self.gap, 0.0) / (2 * arm)))
        return Standing(abs(first[0] - second[0]), off, play, arm)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """All pins over a turn: the worst has the axes' offset and the turn in one direction."""
        from geometry.gears.pins.contact import PIN_CONTACT_TOLERANCE, stated_contact
        from geometry.plane.profile import Label

        arm = self.output.pitch_circle_diameter / 2
        gap = self.gap - distance_off - 2 * arm * abs(math.sin(phase_off / 2))
        allowed = self.tolerated(PIN_CONTACT_TOLERANCE, tolerance)
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


class CycloidalPair(MateKind[CycloidalPairSpec, "PinRing", "CycloidalDisc"]):
    """A disc in its ring."""

    name, keys = "cycloidal_pair", CycloidalPairSpec
    joins = (("pin_ring", "cycloidal_disc"),)

    def tips(
        self, keys: CycloidalPairSpec, first: End[PinRing], second: End[CycloidalDisc]
    ) -> tuple[float | None, float | None]:
        """An inside that keeps off the lobes where that which nobody gave does not; the pins must keep their hold."""
        ring, disc = first.thing, second.thing
        reach = disc.tip_radius + disc.eccentricity
        if ring.pins == "holes" or getattr(first.keys, "inner_diameter", None) is not None:
            return None, None
        if ring.inner_radius >= reach * (1 - _ROUNDING) or reach > (most := ring.inner_limits[1]):
            return None, None
        return min(math.ceil(1e4 * (reach + _OFF_LOBES * ring.pin_radius)) / 1e4, most), None

    def shortened(self, thing: PinRing, radius: float) -> PinRing:
        """A ring of pins has no teeth, but an inside."""
        return replace(thing, inner_radius=radius)

    def mating(self, keys: CycloidalPairSpec, first: End[PinRing], second: End[CycloidalDisc]) -> CycloidalMating:
        """The disc is for these pins."""
        ring, disc = first.thing, second.thing
        if disc.number_of_pins != ring.number_of_pins:
            wanted, pins = Nearest(ring.number_of_pins - 1), ring.number_of_pins
            raise ParameterError("number_of_lobes", disc.number_of_lobes, "one_lobe_fewer_than_pins", wanted, pins=pins)
        same_size("pin_circle_diameter", disc.pin_circle_diameter, 2 * ring.pin_circle_radius, "not_of_the_ring")
        same_size("pin_diameter", disc.pin_diameter, 2 * ring.pin_radius, "not_of_the_ring")
        # a plate with holes stands beside the disc
        beside = ring.pins == "holes"
        return CycloidalMating(
            *self.joined(keys),
            height=(ring.face_width if beside else 0.0) if keys.height is None else keys.height,
            distance=disc.eccentricity,
            module=disc.pin_diameter / 2,
            has_contact=not beside,
            # within the pins, carried by the eccentric
            rolls="internal",
            teeth=(disc.number_of_pins, disc.number_of_lobes),
            ring=ring,
            disc=disc,
            turned_lobes=keys.turned_lobes,
        )


class EccentricBearing(MateKind[EccentricBearingSpec, "RoundDisc", "CycloidalDisc"]):
    """A disc on its eccentric."""

    name, keys = "eccentric_bearing", EccentricBearingSpec
    joins = (("eccentric", "cycloidal_disc"),)

    def mating(self, keys: EccentricBearingSpec, first: End[RoundDisc], second: End[CycloidalDisc]) -> BearingMating:
        """One eccentricity, and a round bore in the disc."""
        from geometry.solids.bores import RoundBore

        eccentric, disc = first.thing, second.thing
        same_size("eccentricity", disc.eccentricity, eccentric.eccentricity, "not_of_the_eccentric")
        bore = disc.holes.bore
        if not isinstance(bore, RoundBore):
            given = 0.0 if bore is None else 2 * bore.reach
            raise ParameterError("bore_diameter", given, "eccentric_needs_round_bore", Nearest(2 * eccentric.radius))
        return BearingMating(
            *self.joined(keys),
            height=keys.height,
            distance=eccentric.eccentricity,
            module=eccentric.radius,
            disc=disc,
            bore_diameter=bore.diameter,
        )


class OutputPins(MateKind[OutputPinsSpec, "CycloidalDisc", "PinPlate"]):
    """Pins in the holes of a disc."""

    name, keys = "output_pins", OutputPinsSpec
    joins = (("cycloidal_disc", "output_plate"),)

    def mating(self, keys: OutputPinsSpec, first: End[CycloidalDisc], second: End[PinPlate]) -> OutputMating:
        """The plate's pins are those of the holes."""
        disc, plate = first.thing, second.thing
        if disc.output is None:
            raise ParameterError("mate.first", keys.first, "no_output_holes")
        same_size("number_of_pins", plate.pins.count, disc.output.count, "not_of_the_holes")
        circles = plate.pins.pitch_circle_diameter, disc.output.pitch_circle_diameter
        same_size("pin_circle_diameter", *circles, "not_of_the_holes")
        return OutputMating(
            *self.joined(keys),
            height=-plate.thickness if keys.height is None else keys.height,
            distance=disc.eccentricity,
            module=plate.pin_radius,
            # loose pins are other instances
            has_contact=plate.solid,
            # parallel cranks: both turn alike, wherever the eccentric stands
            rolls="internal",
            output=disc.output,
            plate=plate,
        )

"""Plates with pins as exact bodies: an output plate, a lantern with its pins between two plates; eccentric disks."""

from __future__ import annotations

import math

from geometry.base.errors import OffsetError
from geometry.base.record import Record
from geometry.plane.profile import Label, Profile, Region, circle
from geometry.solids.body import Body, BodyBuilder, plate
from geometry.solids.hub_holes import HubHoles
from geometry.solids.windows import RoundHoles


class PinPlate(Record):
    """A round plate with ``pins`` (their circle and size as of holes) and ``holes`` about its axis; mm.

    ``solid``: the pins are of one piece with it; a flat section shows their holes all the same, ``seat_clearance``
    wider on the radius, as loose pins want them. ``thickness`` of a plate, ``length`` of its pins.
    """

    pins: RoundHoles
    outer_radius: float
    holes: HubHoles
    solid: bool
    seat_clearance: float = 0.0
    thickness: float = 0.0
    length: float = 0.0

    @property
    def pin_radius(self) -> float:
        """Radius of a pin, mm."""
        return self.pins.diameter / 2

    @property
    def takes_loose_pins(self) -> bool:
        """Whether the pins are parts of their own."""
        return not self.solid

    def pin_centres(self) -> list[complex]:
        """Where the pins stand, mm."""
        return self.pins.centres()

    @property
    def seats(self) -> RoundHoles:
        """The holes for loose pins."""
        seat = self.pins.diameter + 2 * self.seat_clearance
        return RoundHoles(self.pins.count, seat, self.pins.pitch_circle_diameter, self.pins.start)

    def region(self, offset: float, *, seats: bool = True) -> Region:
        """The plate's own section, moved ``offset`` mm out of the material; ``seats``: with holes for its pins.

        Raises
        ------
        OffsetError
            A hole or a wall does not survive.
        """
        wall = self.outer_radius - max(self.seats.reach if seats else self.pins.reach, self.holes.reach)
        if -2 * offset >= wall:
            raise OffsetError(offset, "leaves_no_rim")
        own = (self.seats,) if seats else ()
        every = HubHoles(self.holes.bore, (*own, *self.holes.round_holes), self.holes.spokes)
        return Region(circle(self.outer_radius + offset, Label.BODY), every.profiles(offset))

    def pin_profiles(self, offset: float) -> list[Profile]:
        """The pins of one piece, counter-clockwise.

        Raises
        ------
        OffsetError
            They vanish, or touch each other.
        """
        radius = self.pin_radius + offset
        if radius <= 0 or 2 * offset >= self.pins.wall_between():
            raise OffsetError(offset, "leaves_no_pins")
        return [circle(radius, Label.PIN, centre=centre) for centre in self.pins.centres()]

    def body(self, offset: float, *, between: bool = False) -> Body:
        """One plate with its pins standing on the upper face, or two with the pins ``between`` them."""
        region = self.region(offset, seats=not self.solid)
        if not self.solid:
            return plate(region, 0.0, self.thickness)
        made, inside = BodyBuilder(), (self.thickness, self.thickness + self.length)
        profiles = (region.outer, *region.holes)
        lower = [made.upright(p, 0.0, inside[0]) for p in profiles]
        upper = [made.upright(p, inside[1], inside[1] + self.thickness) for p in profiles] if between else []
        pins = [made.upright(p, *inside) for p in self.pin_profiles(offset)]
        made.cap(lower[0][0], [low for low, _ in lower[1:]], up=False)
        made.cap(lower[0][1], [*(high for _, high in lower[1:]), *(low for low, _ in pins)], up=True)
        if upper:
            made.cap(upper[0][0], [*(low for low, _ in upper[1:]), *(high for _, high in pins)], up=False)
            made.cap(upper[0][1], [high for _, high in upper[1:]], up=True)
            return made.body()
        for _, high in pins:
            made.cap(high, [], up=True)
        return made.body()


def pin_reach(plate_: PinPlate) -> tuple[float, float]:
    """Least and greatest distance from the axis of what holds the pins, mm."""
    half = plate_.pins.pitch_circle_diameter / 2
    size = max(plate_.pin_radius, plate_.seats.diameter / 2)
    return half - size, half + size


class RoundDisc(Record):
    """A round disc about ``eccentricity`` on +x with holes about the origin; mm."""

    radius: float
    eccentricity: float
    holes: HubHoles

    def region(self, offset: float) -> Region:
        """The section, moved ``offset`` mm out of the material.

        Raises
        ------
        OffsetError
            The hole or the disc does not survive.
        """
        wall = math.inf
        if self.holes.bore is not None:
            wall = self.radius - self.eccentricity - self.holes.bore_reach
        if self.radius + offset <= 0 or -2 * offset >= wall:
            raise OffsetError(offset, "leaves_no_wall")
        outer = circle(self.radius + offset, Label.BODY, centre=complex(self.eccentricity))
        return Region(outer, self.holes.profiles(offset))

"""The driver of a Geneva wheel: a crank plate, on it the locking disc and the pins; whole, or a flat piece of it."""

from __future__ import annotations

import math

import numpy as np

from geometry.base.errors import OffsetError
from geometry.base.record import Record
from geometry.curves.line_arc import Arc, Line
from geometry.gears.pins.geneva import GenevaDisc
from geometry.plane.profile import Label, Profile, Region, Segment, circle
from geometry.solids.body import Body, plate
from geometry.solids.hub_holes import HubHoles
from geometry.solids.layers import Contour, Layer, Layers
from geometry.solids.plate import moved_edges
from geometry.solids.windows import RoundHoles

# what chords of an engraved outline leave of it, mm
_CHORD = 0.01


class GenevaDriver(Record):
    """Sizes in mm. ``piece``: "whole", or of flat pieces the "plate" with holes for loose pins, or the "disc".

    ``seat_clearance``: radius of a hole for a pin beyond the pin's. ``pin_length``: from the plate on.
    """

    disc: GenevaDisc
    piece: str
    holes: HubHoles
    plate_radius: float
    plate_thickness: float
    width: float
    pin_length: float
    seat_clearance: float = 0.0

    @property
    def pin_radius(self) -> float:
        """Radius of a pin, mm."""
        return self.disc.wheel.pin_diameter / 2

    @property
    def takes_loose_pins(self) -> bool:
        """Whether the pins are parts of their own."""
        return self.piece == "plate"

    def pin_centres(self) -> list[complex]:
        """Where the pins stand, mm."""
        return self.disc.pin_centres()

    @property
    def seats(self) -> RoundHoles:
        """The holes for loose pins, as the flat outline of the plate has them."""
        crank = self.disc.drive.crank_radius
        return RoundHoles(self.disc.number_of_pins, 2 * (self.pin_radius + self.seat_clearance), 2 * crank)

    @property
    def height(self) -> float:
        """Along the axis, mm."""
        if self.piece == "disc":
            return self.width
        return self.plate_thickness + (max(self.width, self.pin_length) if self.piece == "whole" else 0.0)

    @property
    def has_bored_disc(self) -> bool:
        """Whether the axis stands in the disc: in an internal wheel it stands beside it."""
        return not self.disc.drive.internal

    def region(self, offset: float) -> Region:
        """The disc, or the plate with holes for its pins and the disc's place, moved ``offset`` mm out of the material.

        Raises
        ------
        GeometryError
            A hole or a wall does not survive.
        """
        if self.piece == "disc":
            edges = moved_edges(self.disc.outline(), offset)
            bore = self.holes.profiles(offset) if self.has_bored_disc else ()
            if bore and -2 * offset >= self.disc.apex - self.holes.reach:
                raise OffsetError(offset, "leaves_no_rim")
            return Region(Profile(tuple(Segment(e, Label.BODY) for e in edges)), bore)
        if -2 * offset >= self.plate_radius - self.seats.reach:
            raise OffsetError(offset, "leaves_no_rim")
        holes = HubHoles(self.holes.bore, (self.seats, *self.holes.round_holes))
        return Region(
            circle(self.plate_radius + offset, Label.BODY), holes.profiles(offset), strokes=(self.disc_place(),)
        )

    def disc_place(self) -> tuple[complex, ...]:
        """The outline of the disc in chords, where it is glued on the plate."""
        points: list[complex] = []
        for edge in self.disc.outline():
            count = math.ceil(abs(edge.sweep) * math.sqrt(edge.radius / (8 * _CHORD))) if isinstance(edge, Arc) else 1
            points += edge.point(np.linspace(*edge.domain, count + 1)[:-1]).tolist()
        return (*points, points[0])

    def body(self, offset: float) -> Body:
        """The piece, or all of it: the plate, the disc and pins upon it.

        Raises
        ------
        GeometryError
            A hole or a wall does not survive.
        """
        if self.piece != "whole":
            return plate(self.region(offset), 0.0, self.height)
        return self.layers().body(offset)

    def layers(self) -> Layers:
        """All of it in layers."""
        bores = tuple(_outline(profile) for profile in self.holes.profiles())
        inner = bores if self.has_bored_disc else ()
        pins = tuple(_round(self.pin_radius, centre) for centre in self.pin_centres())
        made = [
            Layer(self.plate_thickness, (_round(self.plate_radius), *bores)),
            Layer(min(self.width, self.pin_length), (Contour(self.disc.outline()), *inner, *pins)),
        ]
        if self.pin_length > self.width:
            made.append(Layer(self.pin_length - self.width, pins))
        elif self.pin_length < self.width:
            made.append(Layer(self.width - self.pin_length, (Contour(self.disc.outline()), *inner)))
        return Layers(tuple(made))


def _round(radius: float, centre: complex = 0j) -> Contour:
    return Contour((Arc(centre, radius, 0.0, math.pi), Arc(centre, radius, math.pi, math.pi)))


def _outline(hole: Profile) -> Contour:
    """A clockwise hole of lines and arcs as a contour."""
    edges = tuple(segment.curve.reversed() for segment in reversed(tuple(hole.segments())))
    made = tuple(edge for edge in edges if isinstance(edge, Line | Arc))
    assert len(made) == len(edges)
    return Contour(made)

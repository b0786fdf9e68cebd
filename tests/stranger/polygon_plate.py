"""A kind of part and a kind of mate from outside: a plate in the form of a regular polygon, and a stack of two of them.

One file says all that there is to say of either; they are registered by ``add_kind`` and ``add_mate`` of
``parts.outside``, and their Ukrainian stands in a catalogue of their own beside it.
"""

from __future__ import annotations

import cmath
import math
from pathlib import Path
from typing import Annotated, Any, ClassVar

import numpy as np
from msgspec import Meta

from geometry.base.errors import ParameterError, limit
from geometry.base.findings import Finding
from geometry.base.nearest import nearest
from geometry.base.record import Record
from geometry.plane.offset_region import OffsetRegion
from geometry.solids.body import Body, plate
from geometry.solids.plate import PlateHole, PlateOutline, rounded
from parts.base.kind import Kind, Others, Report
from parts.base.mate import End, MateKind, Mating, Pose, Standing
from parts.base.readback import Probe, Probed, ReadBack
from parts.base.texts import N_
from parts.keys.base import MadeKeys, mm
from parts.keys.mate import AboveKeys
from parts.pages.inputs import checked, part_of_kind, refusal
from parts.pages.page import Sheet
from parts.pages.terms import add_terms

LOCALE = Path(__file__).parent / "locale"
# material that stays between the hole and each side, mm
LEAST_WALL = 1.0

add_terms("""
sides|n|n||number of sides
across_flats|s|s|mm|width across flats
wall|w|w|mm|wall between the hole and a side
""")


class PolygonPlateKeys(MadeKeys, forbid_unknown_fields=True, tag_field="kind", tag="polygon_plate", kw_only=True):
    """A flat plate in the form of a regular polygon, with a hole for a pin in its middle."""

    sides: Annotated[int, Meta(ge=3, le=360, description=N_("number of sides"), examples=[6])]
    across_flats: Annotated[float, mm(N_("width across flats"), above=0, most=10_000), Meta(examples=[40.0])]
    pin_diameter: Annotated[float, mm(N_("diameter of the pin"), above=0, most=10_000), Meta(examples=[8.0])]


class PolygonPlate(Record):
    """Its exact outline; a side is met at right angles by +x."""

    sides: int
    inner_radius: float
    pin_diameter: float

    @property
    def wall(self) -> float:
        """Material between the hole and a side, mm."""
        return self.inner_radius - self.pin_diameter / 2

    @property
    def outline(self) -> PlateOutline:
        """Sides and hole."""
        half = math.pi / self.sides
        radius = self.inner_radius / math.cos(half)
        corners = [(cmath.rect(radius, (2 * k - 1) * half), 0.0) for k in range(self.sides)]
        return PlateOutline(rounded(corners), (PlateHole(0j, self.pin_diameter),))


class PinFits(Probe):
    """The pin goes into the hole of every file, as far as the file may be off."""

    diameter: float
    height: float

    def run(self, file: ReadBack, offset: float, declared: float) -> Probed:
        """The least distance of the hole from the axis, against the pin's radius less the offset."""
        hole = min(file.section(self.height), key=lambda loop: loop.size)
        room = float(np.abs(hole.points).min()) * 2
        missing = self.diameter - 2 * offset - room
        short = missing > 2 * declared + 1e-9 * self.diameter
        return Probed({"hole": room}, (f"the pin does not fit by {missing:.6g} mm",) if short else ())


class PolygonPlateKind(Kind[PolygonPlateKeys, PolygonPlate]):
    """What the product has to know of it."""

    name, keys, page = "polygon_plate", PolygonPlateKeys, __name__
    reasons: ClassVar = {"pin_leaves_no_wall": N_("the hole leaves {wall} mm of wall")}
    quantities: ClassVar = {"wall": N_("wall")}
    findings: ClassVar = {
        "polygon_thin_wall": N_("thin wall: {value:.2f} mm between hole and side, less than {limit:.2f} mm")
    }

    def thing(self, keys: PolygonPlateKeys, others: Others) -> PolygonPlate:
        """The plate, checked to have a wall about its hole."""
        made = PolygonPlate(keys.sides, keys.across_flats / 2, keys.pin_diameter)
        if made.wall < LEAST_WALL:
            most = keys.across_flats - 2 * LEAST_WALL

            def has_wall(diameter: float) -> bool:
                return PolygonPlate(keys.sides, keys.across_flats / 2, diameter).wall >= LEAST_WALL

            cure = None if most <= 0 else lambda: nearest(has_wall, keys.pin_diameter, limit(most, math.inf).value)  # type: ignore[arg-type]
            raise ParameterError("pin_diameter", keys.pin_diameter, "pin_leaves_no_wall", cure, wall=made.wall)
        return made

    def section(self, keys: PolygonPlateKeys, thing: PolygonPlate, offset: float) -> OffsetRegion:
        """Its outline moved."""
        return thing.outline.region(offset)

    def solid(self, keys: PolygonPlateKeys, thing: PolygonPlate, offset: float) -> Body:
        """Its outline, extruded."""
        return plate(thing.outline.region(offset).region, 0.0, keys.face_width)

    def report(self, keys: PolygonPlateKeys, thing: PolygonPlate) -> Report:
        """Its wall, and a remark where that is thin."""
        thin = (Finding("polygon_thin_wall", thing.wall, 2.0),) if thing.wall < 2.0 else ()
        return Report(thin, {"pin_diameter": thing.pin_diameter}, {"wall": thing.wall})

    def probes(self, keys: PolygonPlateKeys, thing: PolygonPlate) -> tuple[Probe, ...]:
        """The pin."""
        return (PinFits(thing.pin_diameter, keys.face_width / 2, name="pin"),)


POLYGON_PLATE = PolygonPlateKind()


class CalculatedKeys(PolygonPlateKeys, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the calculation."""


table_from = part_of_kind(POLYGON_PLATE.name)


def sheet(table: dict[str, Any]) -> Sheet:
    """``higherpair calc polygon_plate``."""
    keys: CalculatedKeys = checked(table, CalculatedKeys, POLYGON_PLATE.name)
    try:
        made = POLYGON_PLATE.thing(keys, {})
    except ParameterError as error:
        raise refusal(POLYGON_PLATE.name, error) from error
    page = Sheet(POLYGON_PLATE.name, N_("Plate in the form of a regular polygon"))
    page.section(N_("Given"))
    page.add("sides", made.sides)
    page.add("across_flats", keys.across_flats)
    page.add("pin_diameter", made.pin_diameter, key="d")
    page.section(N_("Wall"))
    page.add("wall", made.wall, "({s} - {d}) / 2")
    return page


class PolygonStackKeys(AboveKeys, tag="polygon_stack", kw_only=True):
    """A polygon on top of another one, side over side."""


class StackMating(Mating):
    """Both on one axis; the second stands by whole sides."""

    sides: int

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """On the axis of the first, turned alike."""
        return centre, rotation

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the second is off the axis, mm, and off the side below, rad."""
        step = 2 * math.pi / self.sides
        return Standing(abs(second[0] - first[0]), math.remainder(second[1] - first[1], step), 0.0)


class PolygonStack(MateKind[PolygonStackKeys, PolygonPlate, PolygonPlate]):
    """Two plates of as many sides, one upon the other."""

    name, keys = "polygon_stack", PolygonStackKeys
    joins = ((POLYGON_PLATE.name, POLYGON_PLATE.name),)
    reasons: ClassVar = {"stack_of_other_sides": N_("must have as many sides as the plate below")}
    told = N_("{second} stands on {first}")

    def mating(self, keys: PolygonStackKeys, first: End[PolygonPlate], second: End[PolygonPlate]) -> StackMating:
        """The second on the first."""
        below, above = first.thing, second.thing
        if below.sides != above.sides:
            cure = limit(below.sides, above.sides)
            raise ParameterError("sides", above.sides, "stack_of_other_sides", cure)
        return StackMating(*self.joined(keys), height=keys.height, sides=below.sides)


POLYGON_STACK = PolygonStack()

"""The part kind ``cycloidal_disc``: the disc of a cycloidal reducer with bearing bore and output holes."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Annotated

import msgspec
from msgspec import Meta, Struct

from geometry.base.errors import Nearest, OffsetError, ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import replace
from geometry.solids.hub_holes import HubHoles, least_wall
from geometry.solids.wheel import check_wheel
from geometry.solids.windows import RoundHoles
from parts.base.kind import Others, Report, diameters
from parts.keys.base import mm, part_mm
from parts.keys.holes import Direction, holes_of
from parts.keys.pins import MARGIN, LobeCount, PinCircle, PinDiameter, check_holes, most_of
from parts.keys.wheel import HubbedKeys, WheelKind, shape_of

if TYPE_CHECKING:
    from geometry.gears.pins.cycloidal import CycloidalDisc
    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile


class OutputHolesTable(Struct, forbid_unknown_fields=True):
    """Holes of the output pins; each is wider than its pin by twice the eccentricity and the clearance."""

    count: Annotated[int, Meta(ge=1, le=200, description="number of output pins", examples=[6])]
    pitch_circle_diameter: Annotated[float, part_mm("circle of the output pins' centres", above=0, example=44.0)]
    pin_diameter: Annotated[float, part_mm("diameter of an output pin or its roller", above=0, example=6.0)]
    clearance: Annotated[float, mm("of the hole's diameter beyond pin + 2 e", least=0, most=100)] = 0.0
    start_deg: Direction = 0.0


_PIN_CLEARANCE = mm("moves the profile into the disc along its normals (equidistant)", least=-10, most=100)
_PIN_CIRCLE_SHIFT = mm("radius of the generating pin circle less than the true one", least=-10, most=100)


class CycloidalDiscSpec(HubbedKeys, kw_only=True, tag_field="kind", tag="cycloidal_disc"):
    """Keys of ``cycloidal_disc``."""

    number_of_lobes: LobeCount
    pin_circle_diameter: PinCircle
    pin_diameter: PinDiameter
    eccentricity: Annotated[float, part_mm("eccentricity e; below R / (z + 1)", above=0, example=2.5)]
    pin_clearance: Annotated[float, _PIN_CLEARANCE] = 0.0
    pin_circle_shift: Annotated[float, _PIN_CIRCLE_SHIFT] = 0.0
    output_holes: OutputHolesTable | None = None


def _output_group(table: OutputHolesTable, eccentricity: float) -> RoundHoles:
    """The round holes of the output pins: pin + 2 e + clearance."""
    diameter = table.pin_diameter + 2 * eccentricity + table.clearance
    return RoundHoles(table.count, diameter, table.pitch_circle_diameter, math.radians(table.start_deg))


class CycloidalDiscKind(WheelKind[CycloidalDiscSpec, "CycloidalDisc"]):
    """A disc with its holes."""

    name, keys = "cycloidal_disc", CycloidalDiscSpec
    drawing = "parts.pins.drawings"
    data_table = "parts.pins.data_tables"

    def thing(self, keys: CycloidalDiscSpec, others: Others) -> CycloidalDisc:
        """The disc, checked to exist with its bore, output holes and other holes."""
        from geometry.gears.pins.cycloidal import CycloidalDisc, checked_disc

        disc = checked_disc(
            CycloidalDisc(
                keys.number_of_lobes,
                keys.pin_circle_diameter,
                keys.pin_diameter,
                keys.eccentricity,
                keys.pin_clearance,
                keys.pin_circle_shift,
            )
        )
        table = keys.output_holes
        own: tuple[RoundHoles, ...] = () if table is None else (_output_group(table, keys.eccentricity),)
        holes = holes_of(keys, *own)
        if table is not None and keys.bore_diameter > 0:
            _check_bore(keys.bore_diameter, own[0], disc)
        bare = msgspec.structs.replace(keys, output_holes=None, holes=None)
        check_holes(bare, HubHoles(holes.bore), disc.root_radius)
        if table is not None:
            _check_output(table, own[0], disc, holes)
        check_holes(keys, holes, disc.root_radius, own=len(own))
        check_wheel(shape_of(keys), 2 * disc.root_radius, holes)
        return replace(disc, holes=holes, output=own[0] if own else None)

    def section(self, keys: CycloidalDiscSpec, thing: CycloidalDisc, offset: float) -> OffsetRegion:
        """The exact section, moved."""
        from geometry.gears.pins.cycloidal import disc_region

        return disc_region(thing, offset)

    def outline(self, thing: CycloidalDisc, offset: float) -> Profile:
        """Of its lobes."""
        least, most = thing.offset_limits()
        if not least <= offset <= most:
            raise OffsetError(offset, "leaves_no_outline", most if offset > most else least)
        return thing.profile(offset)

    def report(self, keys: CycloidalDiscSpec, thing: CycloidalDisc) -> Report:
        """Diameters, reduction and radii of curvature."""
        from geometry.gears.pins.cycloidal import disc_findings

        circles = diameters(thing, "tip", "root") | {"pin_circle_diameter": thing.pin_circle_diameter}
        quantities = {
            "reduction": float(thing.number_of_lobes),
            "number_of_pins": float(thing.number_of_pins),
            "eccentricity": thing.eccentricity,
            "shortening_coefficient": thing.shortening,
            "least_path_radius": thing.least_path_radius,
            "least_convex_curvature_radius": thing.least_curvature_radius,
        }
        return Report(disc_findings(thing), circles, quantities)


CYCLOIDAL_DISC = CycloidalDiscKind()


def _check_bore(bore: float, group: RoundHoles, disc: CycloidalDisc) -> None:
    """A bore that leaves no room for output holes that would fit without it, on no circle."""
    least = least_wall(disc.root_radius) * (1 + MARGIN)
    size, circle = group.diameter, group.pitch_circle_diameter
    inside = group.wall_between() > least and circle + size < 2 * (disc.root_radius - least)
    room = circle - size - 2 * least
    if inside and room > 0 and bore > room * (1 - MARGIN) and bore + 2 * size + 4 * least > 2 * disc.root_radius:
        raise ParameterError("bore_diameter", bore, "bore_reaches_output_holes", most_of(room, bore))


def _check_output(table: OutputHolesTable, group: RoundHoles, disc: CycloidalDisc, holes: HubHoles) -> None:
    """The output holes stand between the bore and the valleys and beside each other, with a wall left.

    The pitch circle is to blame where another one has room for them, else the pins, where thinner ones fit.
    """
    least = least_wall(disc.root_radius) * (1 + MARGIN)
    outer, inner = 2 * (disc.root_radius - least), 2 * (holes.bore_reach + least) if holes.bore is not None else 0.0
    moving = 2 * disc.eccentricity + table.clearance

    def widest(circle: float, count: int = table.count) -> float:
        """The largest of so many holes on a pitch circle."""
        chord = math.inf if count == 1 else circle * math.sin(math.pi / count) - least
        beside_bore = circle - inner if holes.bore is not None else math.inf
        return min(outer - circle, beside_bore, chord) * (1 - MARGIN)

    size, circle = group.diameter, table.pitch_circle_diameter
    if size <= widest(circle):
        return
    best = _best_circle(outer, inner if holes.bore is not None else -0.98 * outer, least, table.count)
    told = {"diameter": size}
    if size <= widest(best):
        cure = partial(nearest, lambda c: size <= widest(c), circle, best, digits=6)
        raise ParameterError("output_holes.pitch_circle_diameter", circle, "output_holes_do_not_fit", cure, **told)
    if (room := widest(circle) - moving) > 1e-3 * table.pin_diameter:
        most = most_of(room, table.pin_diameter)
        raise ParameterError("output_holes.pin_diameter", table.pin_diameter, "output_holes_do_not_fit", most, **told)
    if widest(best) - moving > 1e-3 * table.pin_diameter:
        code = "output_holes_fit_elsewhere"
        raise ParameterError("output_holes.pin_diameter", table.pin_diameter, code, **told, circle=best)
    if (fewer := next((n for n in range(table.count - 1, 0, -1) if size <= widest(circle, n)), None)) is not None:
        most = Nearest(fewer, "at_most")
        raise ParameterError("output_holes.count", table.count, "output_holes_do_not_fit", most, **told)
    raise ParameterError("output_holes.count", table.count, "output_holes_have_no_room", **told)


def _best_circle(outer: float, inner: float, least: float, count: int) -> float:
    """The pitch circle on which the largest holes fit."""
    middle = (outer + inner) / 2
    if count == 1:
        return middle
    return max(middle, (outer + least) / (1 + math.sin(math.pi / count)))

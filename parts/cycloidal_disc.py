"""The part kind ``cycloidal_disc``: the disc of a cycloidal reducer with bearing bore and output holes."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

import msgspec
from msgspec import Meta, Struct

from geometry.errors import OffsetError, ParameterError, told
from geometry.hub_holes import HubHoles, least_wall
from geometry.wheel import check_wheel, wheel_body, wheel_sections
from geometry.windows import RoundHoles
from parts.hole_keys import BoreTable, Direction, HolesTable
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, mm
from parts.part import Part
from parts.round_keys import MOST, LobeCount, PinCircle, PinDiameter, check_holes, holes_of, round_part
from parts.wheel_keys import FaceChamfer, FaceChamferTable, HubTable, as_typed, wheel_shape

if TYPE_CHECKING:
    from geometry.body import Body
    from geometry.gears.cycloidal import CycloidalDisc
    from geometry.profile import Profile

_MARGIN = 1e-6


class OutputHolesTable(Struct, forbid_unknown_fields=True):
    """Holes of the output pins; each is wider than its pin by twice the eccentricity and the clearance."""

    count: Annotated[int, Meta(ge=1, le=200, description="number of output pins")]
    pitch_circle_diameter: Annotated[float, mm("circle of the output pins' centres", above=0, most=MOST)]
    pin_diameter: Annotated[float, mm("diameter of an output pin or its roller", above=0, most=MOST)]
    clearance: Annotated[float, mm("of the hole's diameter beyond pin + 2 e", least=0, most=100)] = 0.0
    start_deg: Direction = 0.0


class CycloidalDiscSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="cycloidal_disc"):
    """Disc of a cycloidal reducer; it rolls inside number_of_lobes + 1 pins and turns 1 / number_of_lobes as fast."""

    number_of_lobes: LobeCount
    pin_circle_diameter: PinCircle
    pin_diameter: PinDiameter
    eccentricity: Annotated[float, mm("eccentricity e; below R / (z + 1)", above=0, most=MOST)]
    pin_clearance: Annotated[
        float, mm("moves the profile into the disc along its normals (equidistant)", least=-10, most=100)
    ] = 0.0
    pin_circle_shift: Annotated[
        float, mm("radius of the generating pin circle less than the true one", least=-10, most=100)
    ] = 0.0
    output_holes: OutputHolesTable | None = None
    face_width: FaceWidth = 10.0
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    hub: HubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def output_group(table: OutputHolesTable, eccentricity: float) -> RoundHoles:
    """The round holes of the output pins: pin + 2 e + clearance."""
    diameter = table.pin_diameter + 2 * eccentricity + table.clearance
    return RoundHoles(table.count, diameter, table.pitch_circle_diameter, math.radians(table.start_deg))


def checked_cycloidal_disc(spec: CycloidalDiscSpec) -> CycloidalDisc:
    """The disc of a part, checked to exist.

    Raises
    ------
    ParameterError
        Names the key and the nearest value that works.
    """
    from geometry.gears.cycloidal import CycloidalDisc, checked_disc

    disc = checked_disc(
        CycloidalDisc(
            spec.number_of_lobes,
            spec.pin_circle_diameter,
            spec.pin_diameter,
            spec.eccentricity,
            spec.pin_clearance,
            spec.pin_circle_shift,
        )
    )
    if not disc.root_radius > 0:
        raise ParameterError("pin_diameter", spec.pin_diameter, "leaves nothing in the valleys; thinner pins work")
    table = spec.output_holes
    own: tuple[RoundHoles, ...] = () if table is None else (output_group(table, spec.eccentricity),)
    holes = holes_of(spec, *own)
    if table is not None and spec.bore_diameter > 0:
        _check_bore(spec.bore_diameter, own[0], disc)
    bare = msgspec.structs.replace(spec, output_holes=None, holes=None)
    check_holes(bare, HubHoles(holes.bore), disc.root_radius)
    if table is not None:
        _check_output(table, own[0], disc, holes)
    check_holes(spec, holes, disc.root_radius, own=len(own))
    shape = wheel_shape(spec.face_width, None, spec.hub, spec.face_chamfer)
    try:
        check_wheel(shape, 2 * disc.root_radius, holes)
    except ParameterError as refusal:
        raise as_typed(spec, refusal) from refusal
    return replace(disc, holes=holes, output=own[0] if own else None)


def _check_bore(bore: float, group: RoundHoles, disc: CycloidalDisc) -> None:
    """A bore that leaves no room for output holes that would fit without it, on no circle."""
    least = least_wall(disc.root_radius) * (1 + _MARGIN)
    size, circle = group.diameter, group.pitch_circle_diameter
    inside = group.wall_between() > least and circle + size < 2 * (disc.root_radius - least)
    room = (circle - size - 2 * least) * (1 - _MARGIN)
    if inside and room > 0 and bore > room and bore + 2 * size + 4 * least > 2 * disc.root_radius:
        raise ParameterError("bore_diameter", bore, f"reaches the output holes; at most {told(room)} mm works")


def _check_output(table: OutputHolesTable, group: RoundHoles, disc: CycloidalDisc, holes: HubHoles) -> None:
    """The output holes stand between the bore and the valleys and beside each other, with a wall left."""
    least = least_wall(disc.root_radius) * (1 + _MARGIN)
    outer, inner = 2 * (disc.root_radius - least), 2 * (holes.bore_reach + least) if holes.bore is not None else 0.0
    moving = 2 * disc.eccentricity + table.clearance

    def widest(circle: float, count: int) -> float:
        """The largest hole on a pitch circle."""
        chord = math.inf if count == 1 else circle * math.sin(math.pi / count) - least
        beside_bore = circle - inner if holes.bore is not None else math.inf
        return min(outer - circle, beside_bore, chord) * (1 - _MARGIN)

    size, circle = group.diameter, table.pitch_circle_diameter
    if size <= widest(circle, table.count):
        return
    why = f"holes of {size:.6g} mm (pin + 2 e + clearance) do not fit"
    best = _best_circle(outer, inner if holes.bore is not None else -0.98 * outer, least, table.count)
    if size <= widest(best, table.count):
        low, high = circle, best
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (low, middle) if size <= widest(middle, table.count) else (middle, high)
        text = f"at most {told(high)}" if high < circle else f"at least {told(high, up=True)}"
        raise ParameterError("output_holes.pitch_circle_diameter", circle, f"{why}; {text} mm works")
    if (room := widest(circle, table.count) - moving) > 1e-3 * table.pin_diameter:
        raise ParameterError(
            "output_holes.pin_diameter", table.pin_diameter, f"{why}; at most {told(room * (1 - _MARGIN))} mm works"
        )
    if (room := widest(best, table.count) - moving) > 1e-3 * table.pin_diameter:
        both = f"{told(room * (1 - _MARGIN))} mm with pitch_circle_diameter = {best:.12g} works"
        raise ParameterError("output_holes.pin_diameter", table.pin_diameter, f"{why}; {both}")
    raise ParameterError(
        "output_holes.count", table.count, f"{why} between bore and valleys; a disc without output_holes works"
    )


def _best_circle(outer: float, inner: float, least: float, count: int) -> float:
    """The pitch circle on which the largest holes fit."""
    middle = (outer + inner) / 2
    if count == 1:
        return middle
    return max(middle, (outer + least) / (1 + math.sin(math.pi / count)))


def cycloidal_disc_part(part_id: str, spec: CycloidalDiscSpec, disc: CycloidalDisc) -> Part:
    """The part of a disc; sections are computed when an export asks."""
    from geometry.gears.cycloidal import disc_findings, disc_region

    shape = wheel_shape(spec.face_width, None, spec.hub, spec.face_chamfer)

    def outline(offset: float, depth: float) -> Profile:
        moved = offset - depth
        least, most = disc.offset_limits()
        if not least <= moved <= most:
            raise OffsetError(moved, "leaves no outline", most if moved > most else least)
        return disc.profile(moved)

    sections = wheel_sections(outline, disc.root_radius, disc.holes)

    def body(offset: float) -> Body:
        return wheel_body(shape, sections, offset)

    return round_part(
        part_id,
        spec,
        lambda offset: disc_region(disc, offset),
        body,
        face_width=spec.face_width,
        is_plate=shape.is_plate,
        findings=disc_findings(disc),
        circles={
            "tip_diameter": 2 * disc.tip_radius,
            "root_diameter": 2 * disc.root_radius,
            "pin_circle_diameter": disc.pin_circle_diameter,
        },
        quantities={
            "reduction": float(disc.number_of_lobes),
            "number_of_pins": float(disc.number_of_pins),
            "eccentricity": disc.eccentricity,
            "shortening_coefficient": disc.shortening,
            "least_path_radius": disc.least_path_radius,
            "least_convex_curvature_radius": disc.least_curvature_radius,
        },
    )

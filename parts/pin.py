"""The part kinds ``pin`` (a round pin or its sleeve) and ``eccentric`` (the disc that moves a cycloidal disc)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from msgspec import Struct

from geometry.errors import ParameterError, told
from geometry.hub_holes import HubHoles, least_wall
from parts.hole_keys import BoreTable
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, mm
from parts.part import Part
from parts.round_keys import MOST, check_holes, holes_of, moved_section, round_part

if TYPE_CHECKING:
    from geometry.body import Body
    from geometry.pin_plates import RoundDisc


class PinSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="pin"):
    """Round pin, or with a bore the sleeve that turns on it."""

    diameter: Annotated[float, mm("outer diameter", least=0.01, most=MOST)]
    length: Annotated[float, mm("length along the axis", least=0.01, most=10_000)]
    bore_diameter: BoreDiameter = 0.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


class EccentricSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="eccentric"):
    """Round disc whose centre stands off its axis along +x; the bore is about the axis."""

    diameter: Annotated[float, mm("diameter of the disc", least=0.01, most=MOST)]
    eccentricity: Annotated[float, mm("from the axis to the disc's centre", least=0, most=MOST)]
    face_width: FaceWidth = 10.0
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def checked_pin(spec: PinSpec) -> RoundDisc:
    """The pin of a part.

    Raises
    ------
    ParameterError
        The bore leaves no wall.
    """
    most = spec.diameter - 2 * least_wall(spec.diameter / 2)
    if spec.bore_diameter > most:
        text = f"leaves no wall; at most {told(most)} mm works"
        raise ParameterError("bore_diameter", spec.bore_diameter, text)
    from geometry.bores import RoundBore
    from geometry.pin_plates import RoundDisc

    holes = HubHoles(RoundBore(spec.bore_diameter)) if spec.bore_diameter > 0 else HubHoles()
    return RoundDisc(spec.diameter / 2, 0.0, holes)


def checked_eccentric(spec: EccentricSpec) -> RoundDisc:
    """The eccentric of a part.

    Raises
    ------
    ParameterError
        Names the key and the nearest value that works.
    """
    from geometry.pin_plates import RoundDisc

    radius, holes = spec.diameter / 2, holes_of(spec)
    if holes.bore is not None:
        most = radius - 2 * least_wall(radius)
        if spec.eccentricity >= most:
            text = f"the bore's axis leaves the disc; at most {told(most * (1 - 1e-6))} mm works with a smaller bore"
            raise ParameterError("eccentricity", spec.eccentricity, text)
        check_holes(spec, holes, radius, centre=spec.eccentricity)
    return RoundDisc(radius, spec.eccentricity, holes)


def pin_part(part_id: str, spec: PinSpec, disc: RoundDisc) -> Part:
    """The part of a pin."""
    return _part(part_id, spec, disc, spec.length)


def eccentric_part(part_id: str, spec: EccentricSpec, disc: RoundDisc) -> Part:
    """The part of an eccentric."""
    return _part(part_id, spec, disc, spec.face_width)


def _part(part_id: str, spec: PinSpec | EccentricSpec, disc: RoundDisc, width: float) -> Part:
    from geometry.body import plate

    section = moved_section(disc.region)

    def body(offset: float) -> Body:
        return plate(section(offset).region, 0.0, width)

    quantities = {"diameter": spec.diameter}
    if isinstance(spec, EccentricSpec):
        quantities["eccentricity"] = spec.eccentricity
    return round_part(part_id, spec, section, body, face_width=width, quantities=quantities)

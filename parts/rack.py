"""The part kind ``rack``: a straight rack with its body."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct

from parts.cutter_keys import RackName
from parts.helix_keys import Double, HandName, HelixAngle, checked_helix, helix_of, in_normal_terms, section_finding
from parts.keys import Colour, Density, FaceWidth, Material, mm
from parts.materials import density_of
from parts.part import Part
from parts.spur_gear import RackTable, basic_rack_of

if TYPE_CHECKING:
    from geometry.body import Body
    from geometry.gears.rack import Rack

# modules below the root line where no body was asked for
_BODY = 2.5


class RackHolesTable(Struct, forbid_unknown_fields=True):
    """A row of round holes in the body, symmetric about the middle."""

    count: Annotated[int, Meta(ge=1, le=1000, description="number of holes")]
    diameter: Annotated[float, mm("diameter of each hole", above=0, most=100_000)]
    spacing: Annotated[float, mm("from hole to hole", above=0, most=100_000)] = 20.0
    depth: (
        Annotated[float, mm("centres below the root line; default: the middle of the body", above=0, most=100_000)]
        | None
    ) = None


class RackSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="rack"):
    """Straight rack, spur or helical; its teeth are those of the basic rack."""

    module: Annotated[float, mm("module m; the normal module where helix_angle_deg is not 0", least=0.01, most=1000)]
    number_of_teeth: Annotated[int, Meta(ge=1, le=500, description="number of teeth")]
    pressure_angle_deg: Annotated[float, Meta(ge=5, le=40, description="pressure angle", extra={"unit": "degrees"})] = (
        20.0
    )
    basic_rack: RackName | RackTable = "ISO 53 A"
    body_height: Annotated[float, mm("body below the root line; default: 2.5 m", above=0, most=100_000)] | None = None
    circumferential_thinning: Annotated[
        float, mm("thinning of each tooth for backlash, on the datum line", least=0, most=1000)
    ] = 0.0
    tip_chamfer: Annotated[float, mm("height of a 45 degree tip chamfer", least=0, most=1000)] = 0.0
    tip_rounding: Annotated[float, mm("radius of the tip corner", least=0, most=1000)] = 0.0
    helix_angle_deg: HelixAngle = 0.0
    hand: HandName = "right"
    double_helical: Double = False
    face_width: FaceWidth = 10.0
    holes: RackHolesTable | None = None
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def checked_rack_part(spec: RackSpec) -> Rack:
    """The rack of a part, checked to exist: its transverse section, where it is helical.

    Raises
    ------
    ParameterError
        The rack cannot exist; names the key and the nearest value that works.
    """
    from geometry.errors import ParameterError
    from parts.remedies import sure_remedy

    try:
        return _rack_of(spec)
    except ParameterError as refusal:
        raise sure_remedy(spec, refusal, _builds) from refusal


def _rack_of(spec: RackSpec) -> Rack:
    from geometry.errors import ParameterError
    from geometry.gears.basic_rack import checked_rack
    from geometry.gears.rack import Rack, checked_part_rack
    from geometry.gears.rack_holes import RackHoles
    from geometry.gears.transverse import transverse_rack

    if spec.tip_chamfer > 0 and spec.tip_rounding > 0:
        raise ParameterError("tip_rounding", spec.tip_rounding, "give either tip_chamfer or tip_rounding; 0 works")
    basic = basic_rack_of(spec.basic_rack, math.radians(spec.pressure_angle_deg))
    body = spec.body_height if spec.body_height is not None else _BODY * spec.module
    holes = None
    if (row := spec.holes) is not None:
        depth = row.depth if row.depth is not None else body / 2
        holes = RackHoles(row.count, row.diameter, row.spacing, depth)
    helix = checked_helix(spec)
    if helix.angle and spec.holes is not None:
        raise ParameterError("holes.count", spec.holes.count, "helical racks have none; remove holes")
    # the normal rack must have teeth before its transverse section is looked at
    checked_rack(basic)
    rack = Rack(
        spec.module / math.cos(helix.angle),
        spec.number_of_teeth,
        transverse_rack(basic, helix.angle) if helix.angle else basic,
        body,
        spec.circumferential_thinning,
        spec.tip_chamfer,
        spec.tip_rounding,
        holes,
    )
    try:
        return checked_part_rack(rack)
    except ParameterError as refusal:
        raise in_normal_terms(spec, refusal, _builds) from refusal


def _builds(spec: RackSpec) -> bool:
    from geometry.errors import GeometryError

    try:
        _rack_of(spec)
    except GeometryError:
        return False
    return True


def rack_part(part_id: str, spec: RackSpec, rack: Rack) -> Part:
    """The part of a rack, its datum line on the x axis; sections are computed when an export asks."""
    from geometry.body import plate
    from geometry.gears.rack import rack_region

    quantities = {
        "pitch": rack.pitch,
        "tooth_thickness": rack.tooth_thickness,
        "tip_tooth_thickness": rack.tip_thickness,
        **({"normal_pitch": math.pi * spec.module} if spec.helix_angle_deg else {}),
    }
    section = lru_cache(maxsize=8)(lambda offset: rack_region(rack, offset))
    shear = helix_of(spec).shear()

    def body(offset: float) -> Body:
        region = section(offset).region
        return plate(region, 0.0, spec.face_width, shear, toothed=region.outer)

    return Part(
        part_id,
        "rack",
        section=section,
        body=lru_cache(maxsize=2)(body),
        face_width=spec.face_width,
        flat_findings=section_finding(spec),
        quantities=quantities,
        material=spec.material,
        colour=spec.colour,
        density=spec.density or density_of(spec.material),
    )

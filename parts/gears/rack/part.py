"""The part kind ``rack``: a straight rack with its body."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct

from geometry.base.errors import ParameterError
from parts.base.kind import Kind, Others, Report
from parts.gears.spur_gear.part import RackTable, basic_rack_of, rounding_finding
from parts.keys.base import degrees, mm
from parts.keys.cutter import RackName
from parts.keys.helix import (
    ToothedKeys,
    checked_teeth,
    hand_finding,
    helix_of,
    idle_helix,
    section_finding,
    told_in_keys,
)

if TYPE_CHECKING:
    from geometry.gears.teeth.rack import Rack
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.body import Body

# modules below the root line where no body was asked for
_BODY = 2.5

_DEPTH = mm("centres below the root line; default: the middle of the body", above=0, most=100_000, example=2.5)


class RackHolesTable(Struct, forbid_unknown_fields=True):
    """A row of round holes in the body, symmetric about the middle."""

    count: Annotated[int, Meta(ge=1, le=1000, description="number of holes", examples=[5])]
    diameter: Annotated[float, mm("diameter of each hole", above=0, most=100_000, example=2.5)]
    spacing: Annotated[float, mm("from hole to hole", above=0, most=100_000)] = 20.0
    depth: Annotated[float, _DEPTH] | None = None


_BODY_HEIGHT = mm("body below the root line; default: 2.5 m", above=0, most=100_000, example=6.0)
_CIRCUMFERENTIAL_THINNING = mm("thinning of each tooth for backlash, on the datum line", least=0, most=1000)


class RackSpec(ToothedKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="rack"):
    """Keys of ``rack``."""

    number_of_teeth: Annotated[int, Meta(ge=1, le=500, description="number of teeth", examples=[23])]
    pressure_angle_deg: Annotated[float, degrees("pressure angle", least=5, most=40)] = 20.0
    basic_rack: RackName | RackTable = "ISO 53 A"
    body_height: Annotated[float, _BODY_HEIGHT] | None = None
    circumferential_thinning: Annotated[float, _CIRCUMFERENTIAL_THINNING] = 0.0
    tip_chamfer: Annotated[float, mm("height of a 45 degree tip chamfer", least=0, most=1000)] = 0.0
    holes: RackHolesTable | None = None


@told_in_keys
def checked_rack_part(keys: RackSpec) -> Rack:
    """The rack of a part, checked to exist: its transverse section, where it is helical.

    Raises
    ------
    ParameterError
        The rack cannot exist; names the key and the nearest value that works.
    """
    from geometry.gears.teeth.rack import Rack, checked_part_rack
    from geometry.gears.teeth.rack_holes import RackHoles

    basic = basic_rack_of(keys.basic_rack, math.radians(keys.pressure_angle_deg))
    body = keys.body_height if keys.body_height is not None else _BODY * keys.module
    helix, holes = checked_teeth(keys, keys.number_of_teeth), None
    if (row := keys.holes) is not None:
        if helix.angle:
            raise ParameterError("holes.count", row.count, "no_holes_in_helical_rack")
        holes = RackHoles(row.count, row.diameter, row.spacing, row.depth if row.depth is not None else body / 2)
    rack = Rack(keys.module, keys.number_of_teeth, basic, body, keys.circumferential_thinning,
                keys.tip_chamfer, keys.tip_rounding, holes)  # fmt: skip
    return checked_part_rack(rack, helix.angle)


class RackKind(Kind[RackSpec, "Rack"]):
    """A straight rack; its datum line lies on the x axis."""

    name, keys = "rack", RackSpec
    drawing = "parts.gears.drawings"
    data_table = "parts.gears.data_tables"

    def idle(self, keys: RackSpec, others: Others) -> Iterator[ParameterError]:
        """Two helices without an angle."""
        return idle_helix(keys)

    def thing(self, keys: RackSpec, others: Others) -> Rack:
        """The transverse section of the rack."""
        return checked_rack_part(keys)

    def section(self, keys: RackSpec, thing: Rack, offset: float) -> OffsetRegion:
        """The exact section, moved."""
        from geometry.gears.teeth.rack import rack_region

        return rack_region(thing, offset)

    def solid(self, keys: RackSpec, thing: Rack, offset: float) -> Body:
        """The section, extruded along the helix."""
        from geometry.solids.body import plate

        region = self.section(keys, thing, offset).region
        return plate(region, 0.0, keys.face_width, helix_of(keys).shear(), toothed=region.outer)

    def report(self, keys: RackSpec, thing: Rack) -> Report:
        """Pitch and thicknesses."""
        quantities = {
            "pitch": thing.pitch,
            "tooth_thickness": thing.tooth_thickness,
            "tip_tooth_thickness": thing.tip_thickness,
            **({"normal_pitch": math.pi * keys.module} if keys.helix_angle_deg else {}),
        }
        found = (*rounding_finding(keys), *hand_finding(keys.hand, not keys.helix_angle_deg))
        return Report(found, quantities=quantities, flat_findings=section_finding(keys))


RACK = RackKind()

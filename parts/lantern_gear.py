"""The part kind ``lantern_gear``: the wheel that meshes with the pins of a lantern."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct

from geometry.errors import ParameterError
from geometry.wheel import check_wheel, wheel_body, wheel_sections
from parts.hole_keys import BoreTable, HolesTable, SpokesTable
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, mm
from parts.part import Part
from parts.round_keys import MOST, PinDiameter, check_holes, holes_of, round_part
from parts.wheel_keys import FaceChamfer, FaceChamferTable, HubTable, WebTable, as_typed, wheel_shape

if TYPE_CHECKING:
    from geometry.body import Body
    from geometry.gears.lantern import LanternGear
    from geometry.profile import Profile


class LanternGearSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="lantern_gear"):
    """External gear for a lantern: flanks parallel to the epicycloid of its pins."""

    number_of_teeth: Annotated[int, Meta(ge=3, le=1000, description="number of teeth z")]
    number_of_pins: Annotated[int, Meta(ge=3, le=1000, description="number of pins N of the lantern")]
    pin_circle_diameter: Annotated[float, mm("pin circle of the lantern: its pitch circle", least=0.1, most=MOST)]
    pin_diameter: PinDiameter
    pin_clearance: Annotated[float, mm("gap between flank and pin along the normal", least=0, most=100)] = 0.0
    root_clearance: Annotated[float, mm("radius of the root beyond pin and pin_clearance", least=0, most=100)] = 0.0
    tip_diameter: (
        Annotated[float, mm("tip diameter; default: a tip land of a tenth of the pitch", above=0, most=2 * MOST)] | None
    ) = None
    face_width: FaceWidth = 10.0
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    spokes: SpokesTable | None = None
    web: WebTable | None = None
    hub: HubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


def checked_lantern_gear_part(spec: LanternGearSpec) -> LanternGear:
    """The gear of a part, checked to exist.

    Raises
    ------
    ParameterError
        Names the key and the nearest value that works.
    """
    from geometry.gears.lantern import LanternGear, checked_lantern_gear

    gear = checked_lantern_gear(
        LanternGear(
            spec.number_of_teeth,
            spec.number_of_pins,
            spec.pin_circle_diameter,
            spec.pin_diameter,
            spec.pin_clearance,
            spec.root_clearance,
            spec.tip_diameter,
        )
    )
    holes = holes_of(spec)
    check_holes(spec, holes, gear.root_radius)
    shape = wheel_shape(spec.face_width, spec.web, spec.hub, spec.face_chamfer)
    try:
        check_wheel(shape, 2 * gear.root_radius, holes)
    except ParameterError as refusal:
        raise as_typed(spec, refusal) from refusal
    return replace(gear, holes=holes, face_width=spec.face_width)


def lantern_gear_part(part_id: str, spec: LanternGearSpec, gear: LanternGear) -> Part:
    """The part of a gear; sections are computed when an export asks."""
    from geometry.gears.lantern import lantern_findings, lantern_region, lantern_side, limits_of

    shape = wheel_shape(spec.face_width, spec.web, spec.hub, spec.face_chamfer)

    def outline(offset: float, depth: float) -> Profile:
        return lantern_side(gear, offset - depth).profile()

    sections = wheel_sections(outline, gear.root_radius, gear.holes)

    def body(offset: float) -> Body:
        return wheel_body(shape, sections, offset)

    found = limits_of(gear)
    return round_part(
        part_id,
        spec,
        lambda offset: lantern_region(gear, offset),
        body,
        face_width=spec.face_width,
        is_plate=shape.is_plate,
        findings=lantern_findings(gear),
        circles={
            "tip_diameter": 2 * gear.tip_radius,
            "pitch_diameter": 2 * gear.pitch_radius,
            "root_diameter": 2 * gear.root_radius,
        },
        quantities={
            "pitch": gear.pitch,
            "tip_tooth_thickness": gear.tip_thickness,
            "pointed_tip_diameter": 2 * found.pointed_radius,
            "flank_start_diameter": 2 * found.start_radius,
            "lantern_contact_ratio": gear.contact_ratio,
        },
    )

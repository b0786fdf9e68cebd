"""The part kind ``lantern_gear``: the wheel that meshes with the pins of a lantern."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from msgspec import Meta

from geometry.base.record import replace
from parts.base.kind import Others, Report, diameters
from parts.keys.base import MOST_LENGTH, mm, part_mm
from parts.keys.pins import PinDiameter, wheel_holes
from parts.keys.wheel import WheelKeys, WheelKind

if TYPE_CHECKING:
    from geometry.gears.pins.lantern import LanternGear
    from geometry.gears.teeth.tooth import ToothSide


_TIP_DIAMETER = mm(
    "tip diameter; default: a tip land of a tenth of the pitch", above=0, most=2 * MOST_LENGTH, example=220.0
)
_PIN_CIRCLE_DIAMETER = part_mm("pin circle of the lantern: its pitch circle", least=0.1, example=80.0)


class LanternGearSpec(WheelKeys, kw_only=True, tag_field="kind", tag="lantern_gear"):
    """Keys of ``lantern_gear``."""

    number_of_teeth: Annotated[int, Meta(ge=3, le=1000, description="number of teeth z", examples=[30])]
    number_of_pins: Annotated[int, Meta(ge=3, le=1000, description="number of pins N of the lantern", examples=[12])]
    pin_circle_diameter: Annotated[float, _PIN_CIRCLE_DIAMETER]
    pin_diameter: PinDiameter
    pin_clearance: Annotated[float, mm("gap between flank and pin along the normal", least=0, most=100)] = 0.0
    root_clearance: Annotated[float, mm("radius of the root beyond pin and pin_clearance", least=0, most=100)] = 0.0
    tip_diameter: Annotated[float, _TIP_DIAMETER] | None = None


class LanternGearKind(WheelKind[LanternGearSpec, "LanternGear"]):
    """A lantern's gear."""

    name, keys = "lantern_gear", LanternGearSpec
    drawing = "parts.pins.drawings"
    data_table = "parts.pins.data_tables"

    def thing(self, keys: LanternGearSpec, others: Others) -> LanternGear:
        """The gear, checked to have teeth, and holes inside its roots."""
        from geometry.gears.pins.lantern import LanternGear, checked_lantern_gear

        gear = checked_lantern_gear(
            LanternGear(
                keys.number_of_teeth,
                keys.number_of_pins,
                keys.pin_circle_diameter,
                keys.pin_diameter,
                keys.pin_clearance,
                keys.root_clearance,
                keys.tip_diameter,
            )
        )
        return replace(gear, holes=wheel_holes(keys, gear.root_radius), face_width=keys.face_width)

    def side(self, thing: LanternGear, offset: float) -> ToothSide:
        """Of its teeth."""
        from geometry.gears.pins.lantern import lantern_side

        return lantern_side(thing, offset)

    def report(self, keys: LanternGearSpec, thing: LanternGear) -> Report:
        """Diameters, pitch and what is poor."""
        from geometry.gears.pins.lantern import lantern_findings, limits_of

        found = limits_of(thing)
        circles = diameters(thing, "tip", "pitch", "root")
        quantities = {
            "pitch": thing.pitch,
            "tip_tooth_thickness": thing.tip_thickness,
            "pointed_tip_diameter": 2 * found.pointed_radius,
            "flank_start_diameter": 2 * found.start_radius,
            "lantern_contact_ratio": thing.contact_ratio,
        }
        return Report(lantern_findings(thing), circles, quantities)


LANTERN_GEAR = LanternGearKind()

"""The part kind ``cycloidal_gear``: a wheel or a pinion of clockwork, its flanks drawn by rolling circles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from msgspec import Meta

from geometry.base.errors import ParameterError
from geometry.base.record import replace
from parts.base.kind import Others, Report, diameters
from parts.keys.base import in_modules, mm, part_mm, start
from parts.keys.pins import wheel_holes
from parts.keys.wheel import WheelKeys, WheelKind

if TYPE_CHECKING:
    from geometry.gears.cycloidal.gear import CycloidalGear
    from geometry.gears.teeth.tooth import ToothSide


_MATE_NUMBER_OF_TEETH = Meta(ge=4, le=2000, description="of the mate, whose straight root flanks its tips touch")
_TIP_ROLLING_DIAMETER = part_mm(
    "circle that rolls outside and draws the tips' flanks; default: half the mate's pitch diameter",
    above=0,
    example=8.0,
)
_ROOT_ROLLING_DIAMETER = part_mm(
    "circle that rolls inside and draws the root flanks; default: half the pitch diameter, straight flanks",
    above=0,
    example=60.0,
)
_ROOT_ROUNDING = mm(
    "fillet; default: a fifth of the module, half the depth, or the full round", least=0, most=1000, example=0.4
)
_CIRCUMFERENTIAL_THINNING = mm("thinning of each tooth for backlash, arc of the pitch circle", least=0, most=1000)


class CycloidalGearSpec(WheelKeys, kw_only=True, tag_field="kind", tag="cycloidal_gear"):
    """Keys of ``cycloidal_gear``."""

    module: Annotated[float, mm("module m", least=0.01, most=1000, example=2.0)]
    number_of_teeth: Annotated[int, Meta(ge=4, le=2000, description="number of teeth z", examples=[60])]
    mate_number_of_teeth: Annotated[int, _MATE_NUMBER_OF_TEETH, start(8)] | None = None
    tip_rolling_diameter: Annotated[float, _TIP_ROLLING_DIAMETER] | None = None
    root_rolling_diameter: Annotated[float, _ROOT_ROLLING_DIAMETER] | None = None
    addendum_coefficient: Annotated[float, in_modules("height of the tips", least=0.001, most=10)] = 1.0
    dedendum_coefficient: Annotated[float, in_modules("depth of the roots", least=0.001, most=10)] = 1.25
    root_rounding: Annotated[float, _ROOT_ROUNDING] | None = None
    circumferential_thinning: Annotated[float, _CIRCUMFERENTIAL_THINNING] = 0.0


class CycloidalGearKind(WheelKind[CycloidalGearSpec, "CycloidalGear"]):
    """A cycloidal gear, whose teeth a mate may have thinned."""

    name, keys = "cycloidal_gear", CycloidalGearSpec
    drawing = data_table = "parts.gears.cycloidal_gear.drawing"

    def thing(self, keys: CycloidalGearSpec, others: Others) -> CycloidalGear:
        """The gear, checked to have teeth, and holes inside its roots."""
        from geometry.gears.cycloidal.gear import CycloidalGear, checked_cycloidal_gear

        tip, root = keys.tip_rolling_diameter, keys.root_rolling_diameter
        if tip is None and keys.mate_number_of_teeth is None:
            raise ParameterError("mate_number_of_teeth", None, "one_of_two_is_missing", other="tip_rolling_diameter")
        gear = checked_cycloidal_gear(
            CycloidalGear(
                keys.number_of_teeth,
                keys.module,
                keys.module * (keys.mate_number_of_teeth or 0) / 4 if tip is None else tip / 2,
                keys.module * keys.number_of_teeth / 4 if root is None else root / 2,
                keys.addendum_coefficient,
                keys.dedendum_coefficient,
                keys.circumferential_thinning,
                keys.root_rounding,
            )
        )
        return replace(gear, holes=wheel_holes(keys, gear.root_radius))

    def side(self, thing: CycloidalGear, offset: float) -> ToothSide:
        """Of its teeth."""
        from geometry.gears.cycloidal.gear import cycloidal_side

        return cycloidal_side(thing, offset)

    def report(self, keys: CycloidalGearSpec, thing: CycloidalGear) -> Report:
        """Diameters, thicknesses and what is poor."""
        from geometry.gears.cycloidal.gear import cycloidal_findings

        circles = diameters(thing, "tip", "pitch", "root")
        quantities = {
            "pitch": thing.pitch,
            "tooth_thickness": thing.tooth_thickness,
            "tip_tooth_thickness": thing.tip_thickness,
            "pointed_tip_diameter": 2 * thing.pointed_radius,
            "tip_rolling_diameter": 2 * thing.tip_rolling_radius,
            "root_rolling_diameter": 2 * thing.root_rolling_radius,
            "root_rounding": thing.root_rounding,
        }
        return Report(cycloidal_findings(thing), circles, quantities)


CYCLOIDAL_GEAR = CycloidalGearKind()

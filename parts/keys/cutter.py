"""Scene keys of a pinion cutter, for rings and for external gears that are shaped, and of the basic rack."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from parts.keys.base import degrees, in_modules

if TYPE_CHECKING:
    from geometry.gears.teeth.cutter import PinionCutter

RackName = Literal["ISO 53 A", "ISO 53 B", "ISO 53 C", "ISO 53 D", "GOST 13755"]
PressureAngle = Annotated[float, degrees("pressure angle of the rack", least=5, most=45)]


class CutterTable(Struct, forbid_unknown_fields=True):
    """A pinion cutter: its teeth and its shift set the root diameter, its corner leaves the fillet."""

    number_of_teeth: Annotated[int, Meta(ge=3, le=10_000, description="teeth of the cutter z_0", examples=[23])]
    profile_shift_coefficient: Annotated[float, in_modules("shift x_0 of the cutter", least=-5, most=5)] = 0.0
    addendum_coefficient: Annotated[float, in_modules("addendum of the cutter h_a0", least=0.1, most=3)] = 1.25
    tip_rounding_coefficient: Annotated[float, in_modules("rounding of its tip corners", least=0, most=2)] = 0.2
    full_round: Annotated[bool, Meta(description="the largest rounding that its tooth takes instead")] = False


def cutter_of(table: CutterTable, module: float, pressure_angle: float) -> PinionCutter:
    """The cutter that the keys describe; ``pressure_angle`` in rad.

    Raises
    ------
    ParameterError
        Its tooth cannot exist; names the key of the table and what would work.
    """
    from geometry.base.record import replace
    from geometry.gears.teeth.cutter import PinionCutter, checked_cutter, full_round

    cutter = PinionCutter(
        module,
        table.number_of_teeth,
        pressure_angle,
        table.profile_shift_coefficient,
        table.addendum_coefficient,
        table.tip_rounding_coefficient,
    )
    if not table.full_round:
        return cutter
    return full_round(checked_cutter(replace(cutter, tip_rounding=0.0)))

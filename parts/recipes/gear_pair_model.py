"""The assembly ``gear_pair_model``: two spur gears of flat parts that turn on dowels in a frame, to be cut and turned.

From below, in boards: the frame, both gears. The dowels stand in it, flush with its lower face, and two boards beyond
the gears.
"""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from parts.keys.base import mm
from parts.recipes.making import Making, check_play
from parts.recipes.recipe import Expansion, ModelKeys, Recipe

# mm: of the frame about its axles, and at least beyond the hole of one; its corners
_BESIDE, _WALL, _CORNER = 10.0, 5.0, 5.0
_WHEELS = ("pinion", "wheel")

_TEETH = Meta(description="z1, z2", examples=[[13, 21]])
_Shift = Annotated[float, Meta(ge=-10, le=10)]
_SHIFTS = Meta(description="profile shift coefficients x1, x2", examples=[[0.694, 0.384]])


class GearPairModelKeys(ModelKeys, kw_only=True, tag="gear_pair_model"):
    """Keys of ``gear_pair_model``."""

    teeth: Annotated[tuple[Annotated[int, Meta(ge=3, le=10_000)], Annotated[int, Meta(ge=3, le=10_000)]], _TEETH]
    module: Annotated[float, mm("of both gears", least=0.01, most=1000)] = 4.0
    shifts: Annotated[tuple[_Shift, _Shift], _SHIFTS] = (0.0, 0.0)
    normal_backlash: Annotated[float, mm("normal backlash of the pair", least=0, most=100)] = 0.1
    plate_thickness: Annotated[float, mm("of all flat parts", least=0.5, most=100)] = 3.0
    clearance: Annotated[float, mm("of the gears' bores on the dowels", least=0, most=5)] = 0.2
    axle_diameter: Annotated[float, mm("of the dowels on which the gears turn", least=0.5, most=200)] = 6.0


def _expanded(keys: GearPairModelKeys) -> Expansion:
    """The tables of one model: the pinion at the origin; the frame comes under both axles, wherever they stand."""
    check_play(keys.clearance, keys.axle_diameter)
    thick, making = keys.plate_thickness, Making("gear_pair_model", keys.plate_thickness, keys)
    # named by what students are given
    for wheel, teeth, shift in zip(_WHEELS, keys.teeth, keys.shifts, strict=True):
        making.part(
            wheel, kind="spur_gear", module=keys.module, number_of_teeth=teeth, profile_shift_coefficient=shift,
            face_width=keys.plate_thickness, bore_diameter=keys.axle_diameter + keys.clearance,
            label=f"z {teeth} m {keys.module:g}",
        )  # fmt: skip
    beside = max(_BESIDE, keys.axle_diameter / 2 + _WALL)
    making.part(
        "frame", kind="plate", face_width=thick, corner_radius=_CORNER, width=2 * beside, height=2 * beside,
        beyond_axles=beside, holes=[{"axis_of": wheel, "diameter": keys.axle_diameter} for wheel in _WHEELS],
    )  # fmt: skip
    making.found.instances |= {key: {"part": key} for key in (*_WHEELS, "frame")}
    making.pin("axle", keys.axle_diameter, 4 * thick)
    making.mate("external_gear_pair", *_WHEELS, normal_backlash=keys.normal_backlash)
    for number, wheel in enumerate(_WHEELS, 1):
        making.put("coaxial", wheel, f"axle_{number}", "axle", height=-thick)
    making.order("")
    making.name_all()
    return making.found


GEAR_PAIR_MODEL = Recipe(GearPairModelKeys, _expanded)

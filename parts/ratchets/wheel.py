"""The part kind ``ratchet_wheel``: external or internal teeth that a pawl holds in one sense of turning."""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Annotated, Literal

import msgspec
from msgspec import Meta

from geometry.base.errors import ParameterError
from geometry.base.nearest import kept, nearest
from geometry.base.record import replace
from parts.base.kind import Others, Report, diameters
from parts.keys.base import MOST_LENGTH, degrees, mm, part_mm
from parts.keys.rings import SidedKeys, SidedKind, sided_holes

if TYPE_CHECKING:
    from geometry.gears.ratchets.wheel import RatchetWheel
    from parts.base.readback import Probe

# modules, by default: handbooks' depth of the teeth and land on their tips; the rounding of the root, the rim of a ring
_DEPTH, _LAND, _FILLET, _RIM = 0.75, 1.0, 0.1, 1.5
# of few teeth
_NOTCH_ANGLE = math.radians(60)
# what is tried where a key is to blame, in modules or degrees
_TRIED: dict[str, tuple[float, ...] | tuple[int, ...]] = {
    "tooth_depth": (0.75, 0.5, 0.25, 0.1, 1.0, 1.5, 2.5),
    "root_fillet_radius": (0.0,),
    "tip_land": (1.0, 0.5, 2.0, 0.2, 2.5),
    "notch_angle_deg": (60.0, 70.0, 50.0, 80.0, 40.0, 30.0, 20.0),
    "front_angle_deg": (0.0, 10.0),
    "number_of_teeth": (12, 24, 60, 200),
}

Module = Annotated[float, mm("module m: the outside diameter, of a ring the inside one, is m z", above=0, most=1000,
                             example=5.0)]  # fmt: skip
_DEPTH_KEY = part_mm("depth of the teeth along the radius; default: 0.75 m", above=0, example=3.75)
_FRONT = degrees(
    "of the working face to the radius through its edge; above 0 it is undercut and pulls the pawl in",
    least=-30, most=45,
)  # fmt: skip
_NOTCH = degrees(
    "between the working face and the back of the next tooth; default: the straight back that tip_land leaves",
    least=10, most=120, example=60.0,
)  # fmt: skip
_LAND_KEY = part_mm(
    "along the tip circle; default: m (a notch of 60 degrees of few teeth), or what notch_angle_deg leaves; with both"
    " keys the root has an arc between",
    above=0,
    example=5.0,
)
_FILLET_KEY = part_mm("rounding of the root; default: 0.1 m", least=0, example=0.5)
_TURNS = Meta(description="the sense in which it turns freely, seen from above; the pawl holds it in the other")
_OUTER_DIAMETER = mm(
    "of an internal wheel; default: 1.5 m beyond the roots", above=0, most=2 * MOST_LENGTH, example=150.0
)


class RatchetWheelSpec(SidedKeys, kw_only=True, tag_field="kind", tag="ratchet_wheel"):
    """Keys of ``ratchet_wheel``."""

    module: Module
    number_of_teeth: Annotated[int, Meta(ge=3, le=1000, description="number of teeth z", examples=[16])]
    internal: Annotated[bool, Meta(description="teeth point inwards, the pawl stands within the ring")] = False
    turns: Annotated[Literal["ccw", "cw"], _TURNS] = "ccw"
    tooth_depth: Annotated[float, _DEPTH_KEY] | None = None
    front_angle_deg: Annotated[float, _FRONT] = 15.0
    notch_angle_deg: Annotated[float, _NOTCH] | None = None
    tip_land: Annotated[float, _LAND_KEY] | None = None
    root_fillet_radius: Annotated[float, _FILLET_KEY] | None = None
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None


class RatchetWheelKind(SidedKind[RatchetWheelSpec, "RatchetWheel"]):
    """A wheel that turns one way."""

    name, keys = "ratchet_wheel", RatchetWheelSpec
    drawing = "parts.ratchets.drawing"

    def thing(self, keys: RatchetWheelSpec, others: Others) -> RatchetWheel:
        """The wheel, checked to have teeth, and holes within them."""
        from geometry.gears.ratchets.wheel import checked_wheel

        try:
            wheel = checked_wheel(ratchet_of(keys))
        except ParameterError as refusal:
            raise _cured(keys, refusal) from refusal
        return replace(wheel, holes=sided_holes(keys, wheel, "holes_reach_teeth"))

    def probes(self, keys: RatchetWheelSpec, thing: RatchetWheel) -> tuple[Probe, ...]:
        """Its edges, roots and working faces stand where they must."""
        from parts.ratchets.probe import ToothProbe

        return (ToothProbe(thing, keys.face_width / 2),)

    def report(self, keys: RatchetWheelSpec, thing: RatchetWheel) -> Report:
        """Its sizes."""
        circles = diameters(thing, "tip", "root")
        quantities = {
            "tooth_depth": thing.depth,
            "tip_land": thing.tip_land,
            "notch_angle_deg": math.degrees(thing.cut_angle),
            "root_fillet_radius": thing.fillet_radius,
            "face_circle_diameter": 2 * thing.face_circle_radius,
            "root_thickness": thing.root_thickness,
        }
        return Report(circles=circles, quantities=quantities)


RATCHET_WHEEL = RatchetWheelKind()


def ratchet_of(keys: RatchetWheelSpec) -> RatchetWheel:
    """The wheel of the keys, not yet checked, without holes.

    Where neither tip_land nor notch_angle_deg is given and there are so few teeth that a straight back would dip below
    the root circle, they are cut by a notch of 60 degrees.

    Raises
    ------
    ParameterError
        There are no notches.
    """
    from geometry.gears.ratchets.wheel import back_falls

    wheel = _plain(keys)
    free = keys.tip_land is None and keys.notch_angle_deg is None and not keys.internal
    return replace(wheel, land=None, notch_angle=_NOTCH_ANGLE) if free and not back_falls(wheel) else wheel


def _plain(keys: RatchetWheelSpec) -> RatchetWheel:
    """The wheel of the keys, with a straight back where they leave it open."""
    from geometry.gears.ratchets.wheel import RatchetWheel

    module = keys.module
    tip = module * keys.number_of_teeth / 2
    depth = _DEPTH * module if keys.tooth_depth is None else keys.tooth_depth
    land = _LAND * module if keys.tip_land is None and keys.notch_angle_deg is None else keys.tip_land
    outer = tip + depth + _RIM * module if keys.outer_diameter is None else keys.outer_diameter / 2
    return RatchetWheel(
        keys.number_of_teeth,
        tip,
        depth,
        math.radians(keys.front_angle_deg),
        _FILLET * module if keys.root_fillet_radius is None else keys.root_fillet_radius,
        land,
        None if keys.notch_angle_deg is None else math.radians(keys.notch_angle_deg),
        keys.internal,
        keys.turns == "ccw",
        outer if keys.internal else 0.0,
    )


def _cured(keys: RatchetWheelSpec, refusal: ParameterError) -> ParameterError:
    """The refusal by the first key that alone cures it, the one to blame before the others."""
    from geometry.gears.ratchets.wheel import checked_wheel

    blamed, usual = refusal.name, _plain(keys)
    sizes = {"tooth_depth": usual.depth, "root_fillet_radius": usual.fillet_radius, "tip_land": usual.land}
    for key in sorted(_TRIED, key=lambda one: (one == "number_of_teeth", getattr(keys, one) is None, one != blamed)):
        given = getattr(keys, key)
        if given is None and key == blamed:
            given = sizes.get(key)
        sized = key not in ("notch_angle_deg", "front_angle_deg", "number_of_teeth")
        ends = [share * keys.module for share in _TRIED[key]] if sized else _TRIED[key]

        def fits(value: float, key: str = key) -> bool:
            changed = msgspec.structs.replace(keys, **{key: value})
            return checked_wheel(ratchet_of(changed)).depth > 0

        if given is not None and any(kept(fits, end) for end in ends):
            return ParameterError(key, given, refusal.code, partial(nearest, fits, given, ends, digits=6))
    return refusal

"""The part kind ``geneva_wheel``: a wheel, or a ring, whose radial slots a pin enters one after another."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Annotated

import msgspec
from msgspec import Meta

from geometry.base.errors import ParameterError
from geometry.base.nearest import kept, nearest
from geometry.base.record import replace
from parts.base.kind import Others, Report, diameters
from parts.keys.base import MOST_LENGTH, either, mm, part_mm, start
from parts.keys.rings import SidedKeys, SidedKind, sided_holes

if TYPE_CHECKING:
    from geometry.gears.pins.geneva import GenevaWheel
    from parts.base.readback import Probe

# by default: the pin's diameter as a part of the crank radius; of the pin's, the wall of a tip, at most such a part of
# what a slot leaves of the crank for disc and tip; of the pin's, gaps that no key tells
_PIN, _TIP, _MOST_OF_TIP, _GAP = 1 / 8, 1.0, 1 / 6, 0.1
# discs that are tried where the one that is given does not work, as parts of the room
_DISCS = (0.8, 0.9, 0.95, 0.98, 0.99)

_CENTRE_DISTANCE = part_mm("between the axes of driver and wheel; or give crank_radius", above=0)
_CRANK_RADIUS = part_mm("from the driver's axis to a pin, in place of centre_distance", above=0, example=30.0)
_PIN_DIAMETER = part_mm("diameter of each pin; default: an eighth of the crank radius", least=0.01, example=3.75)
_END_CLEARANCE = mm("gap at the end of a slot; default: a tenth of the pin", least=0, most=100, example=0.6)
_LOCKING_DIAMETER = part_mm(
    "of the driver's disc; default: leaves tips as thick as the pin, at most a fifth of the disc's radius",
    above=0,
    example=48.75,
)
_OUTER_DIAMETER = mm("of an internal wheel; default: two pins beyond", above=0, most=2 * MOST_LENGTH, example=240.0)


class GenevaWheelSpec(SidedKeys, kw_only=True, tag_field="kind", tag="geneva_wheel"):
    """Keys of ``geneva_wheel``."""

    number_of_slots: Annotated[int, Meta(ge=3, le=100, description="number of slots n", examples=[6])]
    centre_distance: Annotated[float, _CENTRE_DISTANCE, start(60.0)] | None = None
    crank_radius: Annotated[float, _CRANK_RADIUS] | None = None
    pin_diameter: Annotated[float, _PIN_DIAMETER] | None = None
    internal: Annotated[bool, Meta(description="slots open inwards, the driver turns within the wheel")] = False
    slot_clearance: Annotated[float, mm("width of a slot beyond the pin's diameter", least=0, most=100)] = 0.0
    end_clearance: Annotated[float, _END_CLEARANCE] | None = None
    locking_diameter: Annotated[float, _LOCKING_DIAMETER] | None = None
    locking_clearance: Annotated[float, mm("gap between that disc and the wheel's arcs", least=0, most=100)] = 0.0
    tip_rounding: Annotated[float, mm("radius between a slot and the tip circle", least=0, most=1000)] = 0.0
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None


class GenevaWheelKind(SidedKind[GenevaWheelSpec, "GenevaWheel"]):
    """A wheel with radial slots."""

    name, keys = "geneva_wheel", GenevaWheelSpec
    drawing = "parts.pins.geneva_drawing"

    def thing(self, keys: GenevaWheelSpec, others: Others) -> GenevaWheel:
        """The wheel, checked to have slots and tips, and holes within them."""
        wheel = _with_tips(keys)
        return replace(wheel, holes=sided_holes(keys, wheel, "holes_reach_slots"))

    def probes(self, keys: GenevaWheelSpec, thing: GenevaWheel) -> tuple[Probe, ...]:
        """The pin goes through its slots, the disc into its arcs."""
        from parts.pins.geneva_probe import SlotProbe

        return (SlotProbe(thing, keys.face_width / 2),)

    def report(self, keys: GenevaWheelSpec, thing: GenevaWheel) -> Report:
        """Its sizes."""
        drive = thing.drive
        circles = diameters(thing, "tip", "root")
        quantities = {
            "centre_distance_of_pair": drive.centre_distance,
            "crank_radius": drive.crank_radius,
            "slot_width": 2 * thing.half_width,
            "locking_diameter": 2 * thing.locking_radius,
            "tip_width": thing.tip_width,
        }
        return Report(circles=circles, quantities=quantities)


GENEVA_WHEEL = GenevaWheelKind()


def wheel_of(keys: GenevaWheelSpec) -> GenevaWheel:
    """The wheel of the keys, not yet checked, without holes.

    Raises
    ------
    ParameterError
        Both or none of ``centre_distance`` and ``crank_radius`` are given.
    """
    from geometry.gears.pins.geneva import Geneva, GenevaWheel

    if keys.centre_distance is not None and keys.crank_radius is not None:
        raise either("crank_radius", keys.crank_radius, "centre_distance")
    if keys.centre_distance is not None:
        drive = Geneva(keys.number_of_slots, keys.centre_distance, internal=keys.internal)
    elif keys.crank_radius is not None:
        whole = Geneva(keys.number_of_slots, 1.0, internal=keys.internal)
        drive = replace(whole, centre_distance=keys.crank_radius / whole.crank_radius)
    else:
        raise ParameterError("centre_distance", None, "needs_distance_or_crank")
    pin = _PIN * drive.crank_radius if keys.pin_diameter is None else keys.pin_diameter
    gap = _GAP * pin if keys.end_clearance is None else keys.end_clearance
    wheel = GenevaWheel(drive, pin, 0.0, keys.slot_clearance, gap, keys.locking_clearance, keys.tip_rounding)
    room = wheel.room_of_disc
    usual = room - min(_TIP * pin, _MOST_OF_TIP * room)
    wheel = replace(wheel, locking_radius=usual if keys.locking_diameter is None else keys.locking_diameter / 2)
    if not keys.internal:
        return wheel
    outer = wheel.root_radius + 2 * pin
    return replace(wheel, outer_radius=outer if keys.outer_diameter is None else keys.outer_diameter / 2)


def _with_tips(keys: GenevaWheelSpec) -> GenevaWheel:
    """The wheel of the keys, checked; the first key that alone cures it is to blame."""
    from geometry.gears.pins.geneva import checked_wheel

    wheel = wheel_of(keys)
    try:
        return checked_wheel(wheel)
    except ParameterError as refusal:
        discs = [] if keys.locking_diameter is None else [2 * wheel.room_of_disc * part for part in _DISCS]
        pins = [_PIN * wheel.drive.crank_radius * 0.5**k for k in range(12)]
        ways = {key: [0.0] for key in ("tip_rounding", "slot_clearance", "locking_clearance", "end_clearance")}
        for key, ends in (ways | {"locking_diameter": discs, "pin_diameter": pins}).items():
            given = getattr(keys, key) or (wheel.pin_diameter if key == "pin_diameter" else 0.0)

            def fits(value: float, key: str = key) -> bool:
                return checked_wheel(wheel_of(msgspec.structs.replace(keys, **{key: value}))).locks

            if given and any(kept(fits, end) for end in ends):
                cure = partial(nearest, fits, given, ends, digits=6)
                raise ParameterError(key, given, refusal.code, cure) from refusal
        raise

"""The kinds of parts around round pins, for the registry of scenes."""

from __future__ import annotations

from typing import Any

from msgspec import Struct

from parts.cycloidal_disc import CycloidalDiscSpec, checked_cycloidal_disc, cycloidal_disc_part
from parts.lantern_gear import LanternGearSpec, checked_lantern_gear_part, lantern_gear_part
from parts.pin import EccentricSpec, PinSpec, checked_eccentric, checked_pin, eccentric_part, pin_part
from parts.pin_plate import (
    LanternWheelSpec,
    OutputPlateSpec,
    checked_pin_plate,
    lantern_wheel_part,
    output_plate_part,
)
from parts.pin_ring import PinRingSpec, checked_pin_ring, pin_ring_part

# each kind: its keys, what checks them, and what makes the part
ROUND_PIN_KINDS: dict[str, tuple[type[Struct], Any, Any]] = {
    "cycloidal_disc": (CycloidalDiscSpec, checked_cycloidal_disc, cycloidal_disc_part),
    "pin_ring": (PinRingSpec, checked_pin_ring, pin_ring_part),
    "output_plate": (OutputPlateSpec, checked_pin_plate, output_plate_part),
    "eccentric": (EccentricSpec, checked_eccentric, eccentric_part),
    "pin": (PinSpec, checked_pin, pin_part),
    "lantern_wheel": (LanternWheelSpec, checked_pin_plate, lantern_wheel_part),
    "lantern_gear": (LanternGearSpec, checked_lantern_gear_part, lantern_gear_part),
}

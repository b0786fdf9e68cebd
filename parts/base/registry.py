"""The kinds of parts, one line each: where the kind is found."""

from __future__ import annotations

from typing import Any

from parts.base.kind import Kind
from parts.base.lazy import Registry

KINDS: Registry[Kind[Any, Any]] = Registry(
    {
        "spur_gear": "parts.gears.spur_gear.part:SPUR_GEAR",
        "ring_gear": "parts.gears.ring_gear.part:RING_GEAR",
        "rack": "parts.gears.rack.part:RACK",
        "noncircular_gear": "parts.gears.noncircular_gear.part:NONCIRCULAR_GEAR",
        "cam": "parts.cams.disk_cam.part:CAM",
        "linkage_cam": "parts.cams.coupler_cam.part:LINKAGE_CAM",
        "groove_cam": "parts.cams.groove_cam.part:GROOVE_CAM",
        "groove_piece": "parts.cams.groove_cam.piece:GROOVE_PIECE",
        "conjugate_cam": "parts.cams.positive.conjugate:CONJUGATE_CAM",
        "yoke_frame": "parts.cams.positive.yoke:YOKE_FRAME",
        "wedge_cam": "parts.cams.wedge_cam.part:WEDGE_CAM",
        "barrel_cam": "parts.cams.barrel_cam.part:BARREL_CAM",
        "cycloidal_disc": "parts.pins.cycloidal_disc:CYCLOIDAL_DISC",
        "pin_ring": "parts.pins.pin_ring:PIN_RING",
        "output_plate": "parts.pins.pin_plate:OUTPUT_PLATE",
        "eccentric": "parts.pins.pin:ECCENTRIC",
        "pin": "parts.pins.pin:PIN",
        "lantern_wheel": "parts.pins.pin_plate:LANTERN_WHEEL",
        "lantern_gear": "parts.pins.lantern_gear:LANTERN_GEAR",
        "follower": "parts.cams.follower:FOLLOWER",
        "follower_arm": "parts.cams.follower:FOLLOWER_ARM",
        "roller": "parts.cams.follower:ROLLER",
        "plate": "parts.bodies.plate:PLATE",
    }
)

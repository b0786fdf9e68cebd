"""The kinds of mates, one line each: where the kind is found."""

from __future__ import annotations

from typing import Any

from parts.base.lazy import Registry
from parts.base.mate import MateKind

MATES: Registry[MateKind[Any, Any, Any]] = Registry(
    {
        "external_gear_pair": "parts.mates.involute:EXTERNAL",
        "internal_gear_pair": "parts.mates.involute:INTERNAL",
        "rack_pair": "parts.mates.involute:RACK",
        "cam_follower": "parts.mates.follower:CAM_FOLLOWER",
        "linkage_member": "parts.mates.linkage_member:LINKAGE_MEMBER",
        "wedge_follower": "parts.mates.wedge:WEDGE_FOLLOWER",
        "conjugate_cams": "parts.mates.positive:CONJUGATE_CAMS",
        "cam_yoke": "parts.mates.positive:CAM_YOKE",
        "fixed": "parts.mates.fixed:FIXED",
        "coaxial": "parts.mates.fixed:COAXIAL",
        "cycloidal_pair": "parts.mates.cycloidal:CYCLOIDAL_PAIR",
        "eccentric_bearing": "parts.mates.cycloidal:ECCENTRIC_BEARING",
        "output_pins": "parts.mates.cycloidal:OUTPUT_PINS",
        "pin_seat": "parts.mates.fixed:PIN_SEAT",
        "lantern_pair": "parts.mates.lantern:LANTERN_PAIR",
        "noncircular_gear_pair": "parts.mates.noncircular:NONCIRCULAR_GEAR_PAIR",
    }
)

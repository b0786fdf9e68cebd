"""The kinds of mates, one entry each: where the kind is found, and what it is in a phrase."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from parts.base.lazy import Index

if TYPE_CHECKING:
    from parts.base.mate import MateKind

MATES: Index[MateKind[Any, Any, Any]] = Index(
    {
        "external_gear_pair": (
            "parts.mates.involute:EXTERNAL",
            "Two external spur gears in mesh: exact centre distance, tip shortening, phase",
        ),
        "internal_gear_pair": ("parts.mates.involute:INTERNAL", "A pinion in a ring gear, in either order"),
        "rack_pair": (
            "parts.mates.involute:RACK",
            "A gear (first) and a rack (second) that moves across the direction from the gear to it",
        ),
        "cam_follower": (
            "parts.mates.follower:CAM_FOLLOWER",
            "A cam (first) and what follows it (second); the cam's own turn tells at which cam angle it stands",
        ),
        "linkage_member": (
            "parts.mates.linkage_member:LINKAGE_MEMBER",
            "A linkage cam (first) and a member of its linkage (second), which stands where the cam's turn puts it",
        ),
        "wedge_follower": (
            "parts.mates.wedge:WEDGE_FOLLOWER",
            "A wedge cam (first) and what follows it (second), which rises across the plate: rotation_deg turns both",
        ),
        "conjugate_cams": (
            "parts.mates.positive:CONJUGATE_CAMS",
            "A cam (first) and the conjugate cam made from it (second), keyed to one shaft",
        ),
        "cam_yoke": (
            "parts.mates.positive:CAM_YOKE",
            "A cam of constant breadth (first) and its yoke (second), lifted as the cam's own turn says",
        ),
        "fixed": (
            "parts.mates.fixed:FIXED",
            "The second instance stands still on the first: offset and rotation_deg in the first one's frame",
        ),
        "coaxial": ("parts.mates.fixed:COAXIAL", "The second instance on the axis of the first, free to turn"),
        "carried": (
            "parts.mates.fixed:CARRIED",
            "The axis of the second stands on the first and goes round with it: a satellite on its carrier",
        ),
        "parallel": (
            "parts.mates.parallel:PARALLEL",
            "The second turns as the first does: cranks of a parallelogram, or what they hold and what that hangs on",
        ),
        "cycloidal_pair": (
            "parts.mates.cycloidal:CYCLOIDAL_PAIR",
            "A cycloidal disc (second) in its pin ring (first): eccentric distance and phase",
        ),
        "eccentric_bearing": (
            "parts.mates.cycloidal:ECCENTRIC_BEARING",
            "A cycloidal disc (second) on its eccentric (first), which drives it",
        ),
        "output_pins": (
            "parts.mates.cycloidal:OUTPUT_PINS",
            "The pins of an output plate (second) in the holes of a cycloidal disc (first)",
        ),
        "pin_seat": ("parts.mates.fixed:PIN_SEAT", "A loose pin (second) in a seat or hole of a ring or plate (first)"),
        "cycloidal_gear_pair": (
            "parts.mates.cycloidal_gears:CYCLOIDAL_GEAR_PAIR",
            "Two cycloidal gears in mesh, each one's tips on the other's roots",
        ),
        "lantern_pair": (
            "parts.mates.lantern:LANTERN_PAIR",
            "A lantern (first) and its gear (second): exact centre distance and phase",
        ),
        "chain_drive": (
            "parts.mates.chain:CHAIN_DRIVE",
            "Two sprockets and their chain: links or centre distance, phase; both turn the same way",
        ),
        "geneva_pair": (
            "parts.mates.geneva:GENEVA_PAIR",
            "A driver (first) and its Geneva wheel (second), which it turns step by step and locks between",
        ),
        "bevel_pair": (
            "parts.mates.bevel:BEVEL_PAIR",
            "Two bevel gears made for each other, laid so that the apexes of their cones meet",
        ),
        "face_gear_pair": (
            "parts.mates.face:FACE_GEAR_PAIR",
            "A face gear (first) and its spur pinion (second), laid across its axis so that both axes meet",
        ),
        "crossed_helical_pair": (
            "parts.mates.crossed:CROSSED_HELICAL_PAIR",
            "Two helical gears on crossed axes (screw gears), the second laid as their helix angles want it",
        ),
        "worm_pair": (
            "parts.mates.worm:WORM_PAIR",
            "A worm wheel (first) and its worm (second), laid across the line of centres in the middle of the rim",
        ),
        "noncircular_gear_pair": (
            "parts.mates.noncircular:NONCIRCULAR_GEAR_PAIR",
            "Two noncircular gears of one pair: exact centre distance, and the phase at which their centrodes touch",
        ),
    }
)

"""The kinds of parts: for each its keys, what checks them and gives the thing itself, and what makes the part of it."""

from __future__ import annotations

from parts.lazy import LazyTable

KINDS = LazyTable(
    {
        "spur_gear": ("parts.spur_gear", "SpurGearSpec", "checked_spur_gear", "spur_gear_part"),
        "ring_gear": ("parts.ring_gear", "RingGearSpec", "checked_ring_gear", "ring_gear_part"),
        "rack": ("parts.rack", "RackSpec", "checked_rack_part", "rack_part"),
        "noncircular_gear": (
            "parts.noncircular_gear",
            "NoncircularGearSpec",
            "checked_noncircular_gear",
            "noncircular_gear_part",
        ),
        "cam": ("parts.cam", "CamSpec", "checked_cam", "cam_part"),
        "linkage_cam": ("parts.linkage_cam", "LinkageCamSpec", "checked_linkage_cam", "linkage_cam_part"),
        "groove_cam": ("parts.groove_cam", "GrooveCamSpec", "checked_groove", "groove_part"),
        "groove_piece": ("parts.groove_piece", "GroovePieceSpec", "checked_piece", "piece_part"),
        "conjugate_cam": ("parts.conjugate_cam", "ConjugateCamSpec", "checked_conjugate", "conjugate_part"),
        "yoke_frame": ("parts.yoke_frame", "YokeFrameSpec", "checked_yoke", "yoke_part"),
        "wedge_cam": ("parts.wedge_cam", "WedgeCamSpec", "checked_wedge", "wedge_part"),
        "barrel_cam": ("parts.barrel_cam", "BarrelCamSpec", "checked_barrel_cam", "barrel_cam_part"),
        "cycloidal_disc": (
            "parts.cycloidal_disc",
            "CycloidalDiscSpec",
            "checked_cycloidal_disc",
            "cycloidal_disc_part",
        ),
        "pin_ring": ("parts.pin_ring", "PinRingSpec", "checked_pin_ring", "pin_ring_part"),
        "output_plate": ("parts.pin_plate", "OutputPlateSpec", "checked_pin_plate", "output_plate_part"),
        "eccentric": ("parts.pin", "EccentricSpec", "checked_eccentric", "eccentric_part"),
        "pin": ("parts.pin", "PinSpec", "checked_pin", "pin_part"),
        "lantern_wheel": ("parts.pin_plate", "LanternWheelSpec", "checked_pin_plate", "lantern_wheel_part"),
        "lantern_gear": ("parts.lantern_gear", "LanternGearSpec", "checked_lantern_gear_part", "lantern_gear_part"),
        "follower": ("parts.follower", "FollowerSpec", "checked_follower", "follower_part"),
        "follower_arm": ("parts.follower", "FollowerArmSpec", "checked_arm", "follower_part"),
        "roller": ("parts.follower", "RollerSpec", "checked_roller", "roller_part"),
        "plate": ("parts.plate", "PlateSpec", "checked_plate", "plate_part"),
    }
)

"""The kinds of parts, one entry each: where the kind is found, and what it is in a phrase."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from parts.base.lazy import Index

if TYPE_CHECKING:
    from parts.base.kind import Kind

KINDS: Index[Kind[Any, Any]] = Index(
    {
        "spur_gear": (
            "parts.gears.spur_gear.part:SPUR_GEAR",
            "External gear, spur or helical, cut by a rack or by a pinion cutter",
        ),
        "ring_gear": (
            "parts.gears.ring_gear.part:RING_GEAR",
            "Ring gear (internal teeth), spur or helical, cut by a pinion cutter",
        ),
        "rack": (
            "parts.gears.rack.part:RACK",
            "Straight rack, spur or helical; its teeth are those of the basic rack",
        ),
        "worm_wheel": (
            "parts.gears.worm_wheel.part:WORM_WHEEL",
            "Worm wheel, the envelope of its worm or of a larger hob: the keys tell the worm, then the rim",
        ),
        "noncircular_gear": (
            "parts.gears.noncircular_gear.part:NONCIRCULAR_GEAR",
            "Noncircular gear, one of a pair: the keys tell the driver's centrode, role which of both this part is",
        ),
        "worm": (
            "parts.gears.worm.part:WORM",
            "Cylindrical worm with its shaft, form ZA, ZI, ZN1, ZN2 or ZK1; the middle of its thread lies at z = 0",
        ),
        "bevel_gear": (
            "parts.gears.bevel_gear.part:BEVEL_GEAR",
            "Bevel gear of spherical involutes, straight, skew or spiral, for one mate; its back face lies at z = 0",
        ),
        "face_gear": (
            "parts.gears.face_gear.part:FACE_GEAR",
            "Face gear (crown gear), conjugate to a spur pinion on an axis at 90 degrees; its lower face lies at z = 0",
        ),
        "cam": (
            "parts.cams.disk_cam.part:CAM",
            "Disk cam; it turns counter-clockwise, cam angle 0 is the start of the first phase",
        ),
        "linkage_cam": (
            "parts.cams.coupler_cam.part:LINKAGE_CAM",
            "Disk cam for a follower on the coupler of a linkage; it turns counter-clockwise about the origin",
        ),
        "groove_cam": (
            "parts.cams.groove_cam.part:GROOVE_CAM",
            "Groove cam; the keys of the motion, bore, holes and hub are those of cam",
        ),
        "groove_piece": (
            "parts.cams.groove_cam.piece:GROOVE_PIECE",
            "A plate of a groove cam: the core within the groove, the ring about it, or the disk under both",
        ),
        "conjugate_cam": (
            "parts.cams.positive.conjugate:CONJUGATE_CAM",
            "Second cam of a pair, turned as it sits on the shaft of the first: both have rotation_deg = 0",
        ),
        "yoke_frame": (
            "parts.cams.positive.yoke:YOKE_FRAME",
            "Frame about a cam, drawn as it stands at cam angle 0: "
            "two flat faces, or a plate with pins for two rollers",
        ),
        "wedge_cam": (
            "parts.cams.wedge_cam.part:WEDGE_CAM",
            "Translating cam plate; it slides along -x, the follower starts over x = 0",
        ),
        "barrel_cam": (
            "parts.cams.barrel_cam.part:BARREL_CAM",
            "Cylindrical cam: a groove around a barrel, or a track on the end of a tube; it turns counter-clockwise",
        ),
        "cycloidal_disc": (
            "parts.pins.cycloidal_disc:CYCLOIDAL_DISC",
            "Disc of a cycloidal reducer; "
            "it rolls inside number_of_lobes + 1 pins and turns 1 / number_of_lobes as fast",
        ),
        "pin_ring": ("parts.pins.pin_ring:PIN_RING", "Ring that holds pins on a circle, the first one on +x"),
        "output_plate": (
            "parts.pins.pin_plate:OUTPUT_PLATE",
            "Plate with the output pins of a cycloidal reducer on its upper face, or with holes for them",
        ),
        "eccentric": (
            "parts.pins.pin:ECCENTRIC",
            "Round disc whose centre stands off its axis along +x; the bore is about the axis",
        ),
        "pin": ("parts.pins.pin:PIN", "Round pin, or with a bore the sleeve that turns on it"),
        "lantern_wheel": (
            "parts.pins.pin_plate:LANTERN_WHEEL",
            "Lantern: round pins between two plates, or one of its plates with holes for them; the first pin on +x",
        ),
        "lantern_gear": (
            "parts.pins.lantern_gear:LANTERN_GEAR",
            "External gear for a lantern: flanks parallel to the epicycloid of its pins",
        ),
        "geneva_wheel": (
            "parts.pins.geneva_wheel:GENEVA_WHEEL",
            "Wheel of a Geneva drive, external or internal: radial slots, and arcs that the driver's disc locks",
        ),
        "geneva_driver": (
            "parts.pins.geneva_driver:GENEVA_DRIVER",
            "Driver of a Geneva wheel: crank plate, locking disc and pins, or one of its flat pieces; pin 1 on +x",
        ),
        "sprocket": (
            "parts.chains.sprocket:SPROCKET",
            "Sprocket for a roller chain, with the teeth of ISO 606 or of GOST 591; rollers stand on its pitch circle",
        ),
        "cycloidal_gear": (
            "parts.gears.cycloidal_gear.part:CYCLOIDAL_GEAR",
            "Cycloidal gear, as clocks have it: tips by a circle that rolls outside, roots by one that rolls inside",
        ),
        "follower": (
            "parts.cams.follower:FOLLOWER",
            "Translating follower: its reference point is the origin, the stem runs along +y",
        ),
        "follower_arm": (
            "parts.cams.follower:FOLLOWER_ARM",
            "Oscillating follower: its pivot is the origin, the arm runs along +x",
        ),
        "roller": ("parts.cams.follower:ROLLER", "Roller of a cam follower"),
        "turned": (
            "parts.bodies.turned:TURNED",
            "Solid turned about its axis, told by half its section of lines and arcs: a ring, a ball, a cover",
        ),
        "shaft": (
            "parts.bodies.turned:SHAFT",
            "Shaft of steps with chamfers, fillets, grooves, keyways, centre holes or a bore; its lower end at z = 0",
        ),
        "step_part": (
            "parts.bodies.step_part:STEP_PART",
            "Solid of a STEP file of your own, like a motor; taken over as it is, needs the extra cad",
        ),
        "layered": (
            "parts.bodies.layered:LAYERED",
            "Upright body of layers, each within contours of its own: a housing, a plate with counterbores, a cage",
        ),
        "carrier_plate": (
            "parts.bodies.carrier:CARRIER_PLATE",
            "Plate of a carrier: a hub with an arm for the pin of each satellite, the first on +x, or a round plate",
        ),
        "plate": (
            "parts.bodies.plate:PLATE",
            "Rectangular plate with rounded corners, holes and slots: a frame, a guide, a cover",
        ),
    }
)

"""The assembly ``power_module_kinematics``: disks and wheels of the power module (thesis) as far as motion needs them.

From the front: platform 4 on its axle 9, disks 2 and 3 in one plane, a spacer, ring 21 and pinion 19, then what turns
the platform: the wheels 16, 14, 11 of the thesis (``thesis``, which does not keep it parallel), an idler on each arm,
or cranks. Numbers are those of the parts list; figure 2.1 has 6, 7, 8, 9, 11, 12, 15, 18 and 16/19 for its 11, 16, 14,
13, 19, 21, 25, 23 and 26. Worms, their wheels, balls, housing and screws are not in it. Wheels of the thesis: 16 is
held, 14 stands on the axis of disk 3, twice as wide, 16 and 11 in two planes: they pass over each other near O1.

Idlers: z 24/12/24, shifted by -0.3, 0.3, -0.3, so that each mesh stays at half an arm; that of arm O1O2 rides on a link
of its own behind the wheels, since disk 2 does not reach it. Cranks: as in ``power_table``, the second stage before the
first, so that no axle crosses a plane of cranks whose pivots' circle is smaller than a crank.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal

from msgspec import Meta

from geometry.base.errors import ParameterError, limit
from parts.keys.base import mm
from parts.recipes.making import Making, hole, holes_on, module_to_span, on_circle, place, refused_by
from parts.recipes.recipe import Expansion, ModelKeys, Recipe, Turns

# mm: walls between holes, boss of a crank about its pin, rim beyond the ring's teeth, the idler's link about its axles,
# room for the balls between both disks
_WALL, _BOSS, _RIM, _LINK, _GUIDE = 8.0, 8.0, 20.0, 24.0, 2.0
# shift of an idler, of its partners the same below 0: z 12 without undercut, each mesh at its plain distance
IDLER_SHIFT = 0.3
_Teeth = Annotated[int, Meta(ge=12, le=1000)]

_TEETH = Meta(
    description=("of the pinion 19 and of the ring 21; O1O2 and O2O3 are half their difference times the module")
)
_ORIENTATION = Meta(description="what turns the platform; thesis: its wheels 6, 7, 8, which do not keep it parallel")
_WHEEL_WIDTH = mm("of the wheels, links and cranks that turn the platform", least=1, most=1000)


class PowerModuleKinematicsKeys(ModelKeys, kw_only=True, tag="power_module_kinematics"):
    """Keys of ``power_module_kinematics``."""

    orientation: Annotated[Literal["cranks", "idlers", "thesis"], _ORIENTATION] = "cranks"
    module: Annotated[float, mm("module of ring and pinion", least=0.1, most=100)] = 3.0
    teeth: Annotated[tuple[_Teeth, _Teeth], _TEETH] = (96, 144)
    wheel_module: Annotated[float, mm("module of the wheels that turn the platform", least=0.1, most=100)] = 2.0
    face_width: Annotated[float, mm("of ring and pinion", least=1, most=1000)] = 25.0
    wheel_width: Annotated[float, _WHEEL_WIDTH] = 15.0
    disk_thickness: Annotated[float, mm("of disks and platform", least=1, most=1000)] = 30.0
    axial_gap: Annotated[float, mm("between planes that turn against each other", least=0.1, most=100)] = 5.0
    clearance: Annotated[float, mm("of bores and holes on what turns in them", least=0, most=5)] = 0.5
    platform_axle_diameter: Annotated[float, mm("of the platform's axle 9", least=1, most=500)] = 30.0
    satellite_axle_diameter: Annotated[float, mm("of the axle 13 and of the post", least=1, most=500)] = 20.0
    pin_diameter: Annotated[float, mm("of idlers' and cranks' pins", least=1, most=200)] = 10.0
    platform_size: Annotated[float, mm("side of the platform", above=0, most=5000)] = 260.0
    turns_of_disk: Annotated[Turns, Meta(description="how far disk 2 is turned")] = 1.0
    turns_of_ring: Annotated[Turns, Meta(description="how far the ring is turned")] = -2.0


class _Sizes:
    """What follows from the keys, mm."""

    def __init__(self, keys: PowerModuleKinematicsKeys) -> None:
        self.keys, (pinion, ring), pin = keys, keys.teeth, keys.pin_diameter / 2
        # O1O2 = O2O3: the centre distance of ring and pinion, and of the wheels of equal pitch circles
        self.arm = keys.module * (ring - pinion) / 2
        beyond = self.arm + keys.platform_axle_diameter / 2
        # radius of disk 3: the platform's axle in it, and the pinion's tips behind it; of a crank's round end
        self.disk_3 = math.ceil(max(keys.module * (pinion / 2 + 1), beyond + _WALL)) + 3.0
        self.boss = pin + _BOSS
        # of the hub on which the flange runs: the platform's axle goes through it
        self.hub = math.ceil(beyond + _WALL)
        # of the second pivots' circle: outside of the hub, and beyond a crank from the platform's axle
        past = self.arm + self.boss + keys.platform_axle_diameter / 2 + 2
        self.pivots = math.ceil(max(past, self.hub + keys.clearance + pin + _WALL))
        # of the first pivots' circle: the flange's long pins stand outside of all that the spider reaches
        self.posts = math.ceil(self.arm + self.pivots + self.boss + pin + 2)

    @property
    def wheels(self) -> tuple[int, int]:
        """Teeth of the wheels 6, 7, 8 of the thesis, or of wheels and idlers: their meshes span an arm."""
        keys = self.keys
        exact = self.arm / keys.wheel_module
        thirds = 1 if keys.orientation == "thesis" else 3
        teeth = (exact, exact) if thirds == 1 else (exact * 2 / 3, exact / 3)
        whole = round(teeth[0]), round(teeth[1])
        if abs(whole[0] - teeth[0]) > 1e-9 or min(whole) < 12 or whole[1] % 2 or whole[0] % 2:
            cure = module_to_span(keys.wheel_module, self.arm / thirds, 2)
            raise ParameterError("wheel_module", keys.wheel_module, "wheels_do_not_span_arm", cure, arm=self.arm)
        return whole

    def checked(self) -> _Sizes:
        """Refuse what nothing follows from, by the driver and its limit."""
        keys = self.keys
        if keys.teeth[0] >= keys.teeth[1]:
            raise ParameterError("teeth", list(keys.teeth), "ring_as_its_wheel")
        most = keys.module * (keys.teeth[0] / 2 - 1.25) - keys.platform_axle_diameter / 2 - _WALL / 2
        if self.arm > most:
            names = ("platform_axle_diameter", "module", "teeth")
            raise refused_by(keys, names, _checked, "axle_beyond_pinion", most=max(most, 0.0))
        if keys.orientation != "cranks":
            teeth, idler = self.wheels
            wall = self.arm - (keys.platform_axle_diameter + keys.satellite_axle_diameter) / 2 - keys.clearance
            if wall < _WALL / 2:
                given = keys.satellite_axle_diameter
                raise ParameterError("satellite_axle_diameter", given, "axles_meet", None, wall=wall)
            shift = IDLER_SHIFT if keys.orientation == "idlers" else 0.0
            root = keys.wheel_module * (teeth - 2.5 - 2 * shift) - 2 * keys.wheel_module
            for name in ("platform_axle_diameter", "satellite_axle_diameter"):
                if (given := getattr(keys, name)) > root:
                    raise ParameterError(name, given, "axle_in_the_teeth", limit(root, given))
            root = keys.wheel_module * (idler - 2.5 + 2 * shift - 2)
            if keys.orientation == "idlers" and keys.pin_diameter > root:
                raise ParameterError("pin_diameter", keys.pin_diameter, "axle_in_the_teeth",
                                     limit(root, keys.pin_diameter))  # fmt: skip
        return self


def _checked(keys: PowerModuleKinematicsKeys) -> _Sizes:
    return _Sizes(keys).checked()


class _Making(Making):
    """The tables as they grow; heights are of lower faces, that of the disks is 0."""

    def __init__(self, sizes: _Sizes) -> None:
        self.sizes, self.keys = sizes, sizes.keys
        super().__init__("power_module_kinematics", self.keys.wheel_width, self.keys)
        self.gears = -self.keys.axial_gap - self.keys.face_width
        # planes behind the pinion, the nearest first
        pitch = self.keys.axial_gap + self.keys.wheel_width
        self.planes = [self.gears - pitch * k for k in range(1, 7)]

    def all(self) -> Expansion:
        """All of it."""
        keys = self.keys
        self._disks()
        {"cranks": self._cranks, "idlers": self._idlers, "thesis": self._wheels}[keys.orientation]()
        self.drive(keys, disk_2="turns_of_disk", ring="turns_of_ring")
        self.name_all()
        return self.found

    def _disks(self) -> None:
        """Disk 2, in it disk 3 with spacer and pinion, which is in mesh with the ring; all about O1 and O2."""
        sizes, keys = self.sizes, self.keys
        arm, axle, disk = complex(sizes.arm), keys.platform_axle_diameter, keys.disk_thickness
        outer = 2 * (sizes.arm + sizes.disk_3 + _GUIDE + _RIM)
        self.plate("disk_2", outer, [hole(arm, 2 * (sizes.disk_3 + _GUIDE))], face_width=disk)
        turning = axle + 2 * keys.clearance
        self.plate("disk_3", 2 * sizes.disk_3, [hole(arm, turning)], face_width=disk)
        self.plate("spacer", 2 * sizes.hub, [hole(arm, turning)], face_width=keys.axial_gap)
        root = keys.module * (keys.teeth[1] + 2.5)
        self.part(
            "ring", kind="ring_gear", module=keys.module, number_of_teeth=keys.teeth[1], face_width=keys.face_width,
            outer_diameter=math.ceil(root + 2 * _RIM),
        )  # fmt: skip
        self.part(
            "pinion", kind="spur_gear", module=keys.module, number_of_teeth=keys.teeth[0], face_width=keys.face_width,
            bore_diameter=0.0 if keys.orientation == "cranks" else keys.satellite_axle_diameter,
            holes=holes_on(1, turning, sizes.arm),
        )  # fmt: skip
        # the body stands behind all else
        last = self.planes[{"thesis": 1, "idlers": 2, "cranks": 4}[keys.orientation]]
        self.low = low = last - keys.axial_gap - keys.disk_thickness
        reach = 2 * (sizes.arm + sizes.disk_3 + _RIM)
        post = 2 * (sizes.posts + keys.pin_diameter + _WALL) if keys.orientation == "cranks" else 0.0
        self.plate("body", math.ceil(max(reach, post)), [], face_width=disk)
        self.found.instances["body"] = {"part": "body", "at": [0.0, 0.0, round(low, 6)], "held": True}
        self.put("coaxial", "body", "disk_2", height=-low)
        self.put("coaxial", "body", "ring", height=self.gears - low)
        self.put("carried", "disk_2", "pinion", offset=place(arm, self.gears))
        self.mate("internal_gear_pair", "ring", "pinion")
        self.fix("pinion", "spacer", 0j, keys.face_width)
        self.fix("pinion", "disk_3", 0j, -self.gears)

    def _platform(self, last: float, holder: str, height: float) -> None:
        """Axle and platform, one body with ``holder`` at a ``height``; the axle ends at ``last``."""
        keys = self.keys
        front = keys.disk_thickness + keys.axial_gap
        self.plate("platform", keys.platform_size, [hole(0j, keys.platform_axle_diameter)], square=True,
                   face_width=keys.disk_thickness)  # fmt: skip
        self.pin("platform_axle", keys.platform_axle_diameter, front + keys.disk_thickness - last)
        self.fix(holder, "platform_axle", 0j, last - height)
        self.fix(holder, "platform", 0j, front - height)

    def _wheel(self, name: str, teeth: int, bore: float, width: float, shift: float = 0.0) -> None:
        self.part(
            name, "idler" if name.startswith("idler") else "wheel", kind="spur_gear", module=self.keys.wheel_module,
            number_of_teeth=teeth, bore_diameter=bore, face_width=width, profile_shift_coefficient=shift,
        )  # fmt: skip

    def _three(self, teeth: int, wide: float, shift: float = 0.0) -> None:
        """Wheels about O1, O2 and O3, that in the middle so wide."""
        keys = self.keys
        turning = keys.satellite_axle_diameter + 2 * keys.clearance
        self._wheel("central_wheel", teeth, keys.satellite_axle_diameter, keys.wheel_width, shift)
        self._wheel("satellite_wheel", teeth, turning, wide, shift)
        self._wheel("platform_wheel", teeth, keys.platform_axle_diameter, keys.wheel_width, shift)

    def _axles(self, last: float, top: float) -> None:
        """The axle 13 on the pinion, and the post on the body that holds the central wheel, up to ``top``."""
        keys = self.keys
        self.pin("satellite_axle", keys.satellite_axle_diameter, self.gears + keys.face_width - last)
        self.fix("pinion", "satellite_axle", 0j, last - self.gears)
        self.pin("post", keys.satellite_axle_diameter, top - self.low - keys.disk_thickness)
        self.fix("body", "post", 0j, keys.disk_thickness)

    def _wheels(self) -> None:
        """The thesis's 16, 14, 11."""
        keys, (teeth, _) = self.keys, self.sizes.wheels
        front, rear = self.planes[0], self.planes[1]
        self._three(teeth, 2 * keys.wheel_width + keys.axial_gap)
        self._axles(rear, rear + keys.wheel_width)
        self.fix("body", "central_wheel", 0j, rear - self.low)
        self.put("external_gear_pair", "central_wheel", "satellite_wheel")
        self.mate("carried", "disk_2", "satellite_wheel")
        self.put("carried", "pinion", "platform_wheel", offset=place(complex(self.sizes.arm), front - self.gears))
        self.mate("external_gear_pair", "satellite_wheel", "platform_wheel")
        self._platform(front, "platform_wheel", front)

    def _idlers(self) -> None:
        """Central wheel, idler, satellite wheel with two rims, idler, platform's wheel."""
        sizes, keys, (teeth, few) = self.sizes, self.keys, self.sizes.wheels
        front, rear, behind = self.planes[:3]
        turning = keys.satellite_axle_diameter + 2 * keys.clearance
        small = keys.pin_diameter + 2 * keys.clearance
        self._three(teeth, keys.wheel_width, -IDLER_SHIFT)
        self._wheel("idler", few, small, keys.wheel_width, IDLER_SHIFT)
        self._axles(behind, rear + keys.wheel_width)
        self.fix("body", "central_wheel", 0j, rear - self.low)
        self.put("external_gear_pair", "central_wheel", "idler_1", "idler")
        self.put("external_gear_pair", "idler_1", "satellite_wheel")
        self.fix("satellite_wheel", "satellite_front", 0j, front - rear, "satellite_wheel")
        self.mate("carried", "disk_2", "satellite_wheel")
        self.put("external_gear_pair", "satellite_front", "idler_2", "idler")
        self.put("external_gear_pair", "idler_2", "platform_wheel")
        self.mate("carried", "pinion", "platform_wheel")
        self.mate("carried", "pinion", "idler_2")
        self.part(
            "link", kind="plate", width=sizes.arm + _LINK + keys.satellite_axle_diameter,
            height=_LINK + keys.satellite_axle_diameter, centre=[sizes.arm / 2, 0.0],
            corner_radius=(_LINK + keys.satellite_axle_diameter) / 2, face_width=keys.wheel_width,
            holes=[hole(0j, turning), hole(sizes.arm / 2 + 0j, keys.pin_diameter), hole(sizes.arm + 0j, turning)],
        )  # fmt: skip
        # hinged on O1 and O2 it turns as disk 2 does
        self.fix("disk_2", "link", 0j, behind)
        self.mate("carried", "link", "idler_1")
        self.pin("idler_pin", keys.pin_diameter, rear + keys.wheel_width - behind)
        self.fix("link", "idler_pin_1", complex(sizes.arm / 2), 0.0, "idler_pin")
        self.pin("front_idler_pin", keys.pin_diameter, self.gears - front)
        self.fix("pinion", "idler_pin_2", complex(sizes.arm / 2), front - self.gears, "front_idler_pin")
        self._platform(front, "platform_wheel", front)

    def _cranks(self) -> None:
        """Hub and flange, cranks to the spider on the platform's axle, and behind it those on the posts of the body."""
        sizes, keys, thick = self.sizes, self.keys, self.keys.wheel_width
        arm, axle, pin = complex(sizes.arm), keys.platform_axle_diameter, keys.pin_diameter
        flange, upper, spider, lower = self.planes[:4]
        ends, holes = (2 * sizes.boss,) * 2, (pin + 2 * keys.clearance,) * 2
        posts, pivots = on_circle(3, sizes.posts), on_circle(3, sizes.pivots, 60.0)
        self.plate("hub", 2 * sizes.hub, [hole(arm, axle + 2 * keys.clearance)], face_width=thick + keys.axial_gap)
        self.fix("pinion", "hub", 0j, flange - self.gears)
        self.hang_flange(pin, sizes.posts, sizes.pivots, sizes.boss, sizes.hub + keys.clearance)
        self.put("carried", "disk_2", "flange", offset=place(arm, flange))
        self.mate("parallel", "body", "flange")
        self.part(
            "spider", kind="carrier_plate", number_of_pins=3, pin_circle_diameter=2 * sizes.pivots, pin_diameter=pin,
            boss_diameter=2 * sizes.boss, face_width=thick, bore_diameter=axle, directions_deg=[60.0, 180.0, 300.0],
        )  # fmt: skip
        self.put("carried", "pinion", "spider", offset=place(arm, spider - self.gears))
        self.mate("parallel", "flange", "spider")
        self.crank("crank", sizes.arm, holes, ends)
        self.pin("flange_pin", pin, flange + thick - upper)
        self.pin("spider_pin", pin, upper + thick - spider)
        self.pin("long_pin", pin, flange + thick - lower)
        self.pin("body_post", pin, lower + thick - self.low - keys.disk_thickness)
        pins = ("flange", "flange_pin", upper - flange), ("spider", "spider_pin", 0.0)
        self.hang_cranks("second_crank", "crank", "pinion", pivots, upper - self.gears, pins, "flange")
        pins = ("flange", "long_pin", lower - flange), ("body", "body_post", keys.disk_thickness)
        self.hang_cranks("first_crank", "crank", "disk_2", posts, lower, pins)
        self._platform(spider, "spider", spider)


POWER_MODULE_KINEMATICS = Recipe(PowerModuleKinematicsKeys, lambda keys: _Making(_checked(keys)).all())

"""The assembly ``power_table``: the two-disk power table (thesis) out of flat plates and dowels, to be cut and turned.

From the back: hand cranks or worm drives, base with feet, back disk, disk 2 within a rim, ring and pinion (disk 3),
cranks of the first stage on posts, the flange that they hold, cranks of the second stage, platform. Back disk, rim and
ring are one body, as the thesis's 12, 13, 18 are; the tube of the back disk and the shaft of disk 2 within it carry the
drives. The flange runs on a hub of the pinion: no axle crosses the plane of the first cranks.

Worms are turned by a hexagon key in their bores, that of the ring nearer to the base. Their bearings stand in slots of
the base; a worm is pushed in along its axis, the thin journal first, and held by a collar.
"""

from __future__ import annotations

import math
from typing import Annotated, Literal

from msgspec import Meta

from geometry.base.errors import ParameterError
from parts.keys.base import mm
from parts.keys.pins import MARGIN, most_of
from parts.recipes.making import LOOSE, Making, hole, holes_on, mark, on_circle, place, refused_by
from parts.recipes.recipe import Expansion, ModelKeys, Recipe, Table, Turns

# modules: what a ring's root is beyond its reference circle at most, with its clearance; a rim beyond that, mm
_ROOT, _RIM = 1.25, 8.0
# mm: wall beside a hole, of a boss about a pin beyond its radius, of a tube; feet, cranks by hand, handles
_WALL, _BOSS, _TUBE = 3.0, 3.0, 3.0
_FOOT, _FEET_HEIGHT, _HANDLE, _GRIP = 10.0, 70.0, 6.0, 25.0
# worms: quotient q; addendum, dedendum and length of the thread, modules; bearings, neck before them, collar, mm
_Q, _ADDENDUM, _DEDENDUM, _THREAD = 10.0, 1.0, 1.2, 20.0
_BEARING, _NECK, _COLLAR = 6.0, 6.0, 5.0

_TEETH = Meta(description="of the pinion and of the ring; O1O2 is half their difference times the module")
_DRIVE = Meta(description="what turns disk 2 and the ring, behind the base")
_WormWheelTeeth = Annotated[int, Meta(ge=20, le=1000)]
_WORM_WHEEL_TEETH = Meta(description="of the worm wheels of disk 2 and of the ring; their worms have one start")


class PowerTableKeys(ModelKeys, kw_only=True, tag="power_table"):
    """Keys of ``power_table``."""

    module: Annotated[float, mm("module of ring and pinion", least=0.1, most=100)] = 2.25
    teeth: Annotated[tuple[Annotated[int, Meta(ge=8, le=1000)], Annotated[int, Meta(ge=8, le=1000)]], _TEETH] = (32, 48)
    second_arm: Annotated[float, mm("O2O3; default: as O1O2", above=0, most=1000, example=18.0)] | None = None
    normal_backlash: Annotated[float, mm("of ring and pinion", least=0, most=10)] = 0.15
    plate_thickness: Annotated[float, mm("of all flat parts", least=0.5, most=100)] = 4.0
    axial_gap: Annotated[float, mm("between planes that turn against each other", least=0, most=100)] = 0.5
    clearance: Annotated[float, mm("of holes on the pins and shafts that turn in them", least=0, most=5)] = 0.2
    pin_diameter: Annotated[float, mm("of the cranks' pins", least=0.5, most=100)] = 4.0
    axle_diameter: Annotated[float, mm("of the shaft of disk 2, and of the axle of disk 3", least=1, most=200)] = 8.0
    fit: Annotated[float, mm("how much thinner rods are than the holes in which they are glued", least=0, most=2)] = 0.0
    drive: Annotated[Literal["hand_cranks", "worms"], _DRIVE] = "hand_cranks"
    worm_module: Annotated[float, mm("module of the worms", least=0.2, most=50)] = 2.0
    worm_wheel_teeth: Annotated[tuple[_WormWheelTeeth, _WormWheelTeeth], _WORM_WHEEL_TEETH] = (30, 24)
    worm_thinning: Annotated[float, mm("of the wheels' teeth, along the worms, for backlash", least=0, most=5)] = 0.2
    platform_axle_diameter: Annotated[float, mm("of the platform's axle", least=0.5, most=200)] = 6.0
    platform_size: Annotated[float, mm("side of the platform", above=0, most=2000)] = 84.0
    turns_of_disk: Annotated[Turns, Meta(description="how far disk 2 is turned")] = 1.0
    turns_of_ring: Annotated[Turns, Meta(description="how far the ring is turned")] = -2.0


class _Sizes:
    """What follows from the keys, mm."""

    def __init__(self, keys: PowerTableKeys) -> None:
        self.keys, (pinion, ring) = keys, keys.teeth
        pin, platform_axle = keys.pin_diameter / 2, keys.platform_axle_diameter / 2
        # O1O2: the centre distance of ring and pinion without shifts; O2O3
        self.arm = keys.module * (ring - pinion) / 2
        self.second_arm = keys.second_arm or self.arm
        # radius of the round end of a crank; of the pinion's hub, through which the platform's axle goes
        self.boss = pin + _BOSS
        self.hub = math.ceil(self.second_arm + platform_axle + _WALL)
        # outer radius of ring, rim and back disk; of disk 2, which stands into the plane of the ring's tips by a gap
        self.ring = math.ceil(keys.module * (ring / 2 + _ROOT) + _RIM)
        self.disk = math.floor(keys.module * (ring / 2 - 1) - keys.clearance)
        # radius of the posts' circle: out of the ring's way, their first cranks out of the hub's
        beside = self.ring + keys.clearance + pin + _WALL + 2
        self.posts = math.ceil(max(beside, self.hub + self.arm + self.boss + 1, _side_by_side(self.arm, self.boss)))
        # of the second pivots' circle on the flange: beside the hub, cranks beside the platform's axle
        past, wall = self.second_arm + platform_axle + self.boss + 1, self.hub + keys.clearance + pin + _WALL
        self.pivots = math.ceil(max(past, wall, _side_by_side(self.second_arm, self.boss)))
        # outer diameter of the tube about the shaft of disk 2
        self.tube = keys.axle_diameter + keys.clearance + 2 * _TUBE
        # seven modules, as whole teeth have it on a worm of q 10; diameter of a worm at its root
        self.worm_wheel_width = 7 * keys.worm_module
        self.worm_core = 2 * keys.worm_module * (_Q / 2 - _DEDENDUM)
        # of a worm's thick journal, through whose bearing its thread goes; width of its bearings
        self.journal = 2 * keys.worm_module * (_Q / 2 + _ADDENDUM) + 2
        self.bearing = self.journal + keys.clearance + 2 * (_WALL + 1)
        # how far the bearings stand from the middle of the worms: out of the wheels' way
        wheel = max(map(self.worm_wheel, keys.worm_wheel_teeth)) / 2 + 1
        inner = min(map(self.worm_distance, keys.worm_wheel_teeth)) - self.bearing / 2
        past = math.sqrt(max(wheel**2 - max(inner, 0.0) ** 2, 0.0))
        self.beside = max(past, keys.worm_module * _THREAD / 2 + _NECK)
        # heights of the axes of the worms of disk 2 and of the ring, below the base, the ring's nearer to it
        near = -(self.journal / 2 + 1)
        self.worm_planes = near - self.worm_wheel_width / 2 - 1 - self.journal / 2, near
        # half a side of the base: beyond the posts, and the slots of the worms' bearings
        self.half = self.posts + pin + 8
        if keys.drive == "worms":
            far = max(map(self.worm_distance, keys.worm_wheel_teeth)) + self.bearing / 2
            self.half = max(self.half, far + _BEARING + 3)

    def worm_distance(self, teeth: int) -> float:
        """Centre distance of a worm and its wheel."""
        return self.keys.worm_module * (_Q + teeth) / 2

    def worm_wheel(self, teeth: int) -> float:
        """Outer diameter of a worm wheel."""
        return self.keys.worm_module * (teeth + 2.5)

    def checked(self) -> _Sizes:
        """Refuse sizes that nothing follows from, by the driver and its limit."""
        keys, (pinion, ring) = self.keys, self.keys.teeth
        if pinion >= ring:
            raise ParameterError("teeth", list(keys.teeth), "ring_as_its_wheel")
        for name in ("clearance", "fit"):
            if getattr(keys, name) > (most := keys.pin_diameter * LOOSE):
                raise self._refused((name, "pin_diameter"), "pins_lie_loose", most=most, diameter=keys.pin_diameter)
        # dowels stand in the middle of the rim
        if keys.pin_diameter > (most := _RIM * (1 - MARGIN)):
            raise ParameterError(
                "pin_diameter", keys.pin_diameter, "hole_reaches_edge", most_of(most, keys.pin_diameter)
            )
        # the pinion stands two gaps higher than the ring
        if keys.plate_thickness <= 2 * keys.axial_gap:
            raise self._refused(("axial_gap", "plate_thickness"), "ring_beside_pinion")
        root = keys.module * (pinion / 2 - _ROOT)
        most = root - keys.platform_axle_diameter / 2 - _WALL
        if self.second_arm > most:
            names = ("second_arm", "platform_axle_diameter", "teeth", "module")
            raise self._refused(names, "axle_beyond_pinion", most=max(most, 0.0))
        between = self.second_arm - (keys.axle_diameter + keys.platform_axle_diameter) / 2 - keys.clearance
        if between < _WALL / 2:
            raise self._axles_meet(between, "second_arm", "axle_diameter", "platform_axle_diameter", "teeth", "module")
        if self.arm + keys.axle_diameter / 2 + _WALL > self.disk or self.arm - keys.axle_diameter < _WALL / 2:
            between = min(self.disk - self.arm - keys.axle_diameter / 2, self.arm - keys.axle_diameter)
            raise self._axles_meet(between, "axle_diameter", "teeth", "module")
        least = 2 * (self.pivots + self.boss)
        if keys.platform_size < least:
            limits = ("platform_size", "pin_diameter", "platform_axle_diameter", "second_arm", "teeth", "module")
            raise self._refused(limits, "platform_too_small", least=least)
        if keys.drive == "worms":
            for bore, teeth in zip((keys.axle_diameter, self.tube), keys.worm_wheel_teeth, strict=True):
                root = (teeth - 2 - 2 * _DEDENDUM) * keys.worm_module
                if bore + 4 * _WALL > root:
                    raise self._refused(("worm_module", "worm_wheel_teeth", "axle_diameter"), "axle_in_the_teeth")
        return self

    def _axles_meet(self, wall: float, *names: str) -> ParameterError:
        if wall < 0:
            return self._refused(names, "axles_overlap", depth=-wall)
        return self._refused(names, "axles_meet", wall=wall)

    def _refused(self, names: tuple[str, ...], code: str, **told: float) -> ParameterError:
        """A refusal by the first of some keys that is changed and alone to blame, with its nearest value that works."""
        # what is not given follows
        return refused_by(self.keys, names, _checked, code, {"second_arm": (self.second_arm, self.arm)}, **told)


def _checked(keys: PowerTableKeys) -> _Sizes:
    return _Sizes(keys).checked()


def _side_by_side(crank: float, boss: float) -> float:
    """Least pivot circle of three parallel cranks in one plane that pass each other."""
    return (crank + 2 * boss + 0.5) / math.sqrt(3)


class _Making(Making):
    """The tables as they grow; heights are of lower faces, the base's is 0."""

    def __init__(self, sizes: _Sizes) -> None:
        self.sizes, self.keys = sizes, sizes.keys
        thick, gap = self.keys.plate_thickness, self.keys.axial_gap
        super().__init__("power_table", thick, self.keys)
        self.back = thick + gap
        self.mark = mark(thick)
        # lower ends of tube and shaft
        self.ends = -gap - thick, -2 * (gap + thick)
        if self.keys.drive == "worms":
            disk, ring = (plane - sizes.worm_wheel_width / 2 for plane in sizes.worm_planes)
            self.ends = ring, disk
        self.ring = self.back + 2 * thick
        self.disk = self.back + thick + gap
        self.pinion = self.ring + 2 * gap
        self.first_cranks = self.pinion + thick + gap
        self.flange = self.first_cranks + thick + gap
        self.second_cranks = self.flange + thick + gap
        self.platform = self.second_cranks + thick + gap

    def all(self) -> Expansion:
        """All of it."""
        self._body()
        self._ring()
        self._disks()
        self._first_stage()
        self._second_stage()
        (self._worms if self.keys.drive == "worms" else self._hand_cranks)()
        self.order(self.keys.drive)
        self.drive(self.keys, disk_2="turns_of_disk", ring="turns_of_ring")
        self.name_all()
        return self.found

    def pin(self, name: str, diameter: float, length: float, bore: float = 0.0) -> None:
        """A rod or a tube, thinner than its hole."""
        super().pin(name, diameter - self.keys.fit, length, bore)

    def _body(self) -> None:
        """The base on its feet, the guide about the ring's stack, and the posts of the first cranks."""
        sizes, keys = self.sizes, self.keys
        corners, posts = on_circle(4, math.sqrt(2) * (sizes.half - _FOOT), 45.0), on_circle(3, sizes.posts)
        fixed = [hole(at, _FOOT) for at in corners] + [hole(at, keys.pin_diameter) for at in posts]
        slots = {"slots": self._slots()} if keys.drive == "worms" else {}
        self.plate("base", 2 * sizes.half, [hole(0j, sizes.tube + keys.clearance), *fixed], square=True, **slots)
        self.plate("guide", 2 * sizes.half, [hole(0j, 2 * (sizes.ring + keys.clearance)), *fixed], square=True)
        self.found.instances["base"] = {"part": "base", "held": True}
        thick = keys.plate_thickness
        self.fix("base", "guide", 0j, thick)
        height = _FEET_HEIGHT
        if slots:
            height = max(height, math.ceil(2 * thick + sizes.bearing / 2 - sizes.worm_planes[0]) + 5.0)
        self.pin("foot", _FOOT, height)
        self.pin("post", keys.pin_diameter, self.first_cranks + thick)
        self.fix_each("base", "foot", [(at, 2 * thick - height) for at in corners])
        self.fix_each("base", "post", [(at, 0.0) for at in posts])

    def _ring(self) -> None:
        """Back disk, rim and ring, one body on four dowels; the tube in it."""
        sizes, keys, thick = self.sizes, self.keys, self.keys.plate_thickness
        circle = sizes.ring - _RIM / 2
        dowels = on_circle(4, circle, 45.0)
        holes = [hole(at, keys.pin_diameter) for at in dowels]
        self.plate("back", 2 * sizes.ring, [hole(0j, sizes.tube), *holes])
        self.plate("rim", 2 * sizes.ring, [hole(0j, 2 * (sizes.disk + keys.clearance)), *holes])
        self.part(
            "ring", kind="ring_gear", module=keys.module, number_of_teeth=keys.teeth[1], face_width=thick,
            outer_diameter=2 * sizes.ring, tooth_mark=self.mark,
            holes=holes_on(4, keys.pin_diameter, circle, 45.0),
        )  # fmt: skip
        self.put("coaxial", "base", "ring", height=self.ring)
        self.fix("ring", "back", 0j, self.back - self.ring)
        self.fix("ring", "rim", 0j, self.back + thick - self.ring)
        self.pin("dowel", keys.pin_diameter, 3 * thick)
        self.fix_each("ring", "dowel", [(at, self.back - self.ring) for at in dowels])
        low, _ = self.ends
        self.pin("tube", sizes.tube, self.back + thick - low, keys.axle_diameter + keys.clearance)
        self.fix("ring", "tube", 0j, low - self.ring, "tube")

    def _disks(self) -> None:
        """Disk 2 with its shaft and the axle of disk 3; the pinion with its hub and the platform's axle."""
        sizes, keys, thick = self.sizes, self.keys, self.keys.plate_thickness
        arm, second = complex(sizes.arm), complex(sizes.second_arm)
        shaft, axle = keys.axle_diameter, keys.platform_axle_diameter
        slot = {"start": [sizes.disk - 12, 0.0], "end": [sizes.disk - 4, 0.0], "width": 1.0} | self.mark
        self.plate("disk_2", 2 * sizes.disk, [hole(0j, shaft), hole(arm, shaft)], engraved=[slot])
        self.put("coaxial", "base", "disk_2", height=self.disk)
        _, low = self.ends
        self.pin("shaft", shaft, self.disk + thick - low)
        self.fix("disk_2", "shaft", 0j, low - self.disk)
        top = self.pinion + 3 * thick
        self.pin("axle", shaft, top - self.disk)
        self.fix("disk_2", "axle", arm, 0.0)
        self.part(
            "pinion", kind="spur_gear", module=keys.module, number_of_teeth=keys.teeth[0], face_width=thick,
            bore_diameter=shaft + keys.clearance, tooth_mark=self.mark, holes=holes_on(1, axle, sizes.second_arm),
        )  # fmt: skip
        self.put("carried", "disk_2", "pinion", offset=place(arm, self.pinion - self.disk))
        self.mate("internal_gear_pair", "ring", "pinion", normal_backlash=keys.normal_backlash)
        bores = [hole(0j, shaft + keys.clearance), hole(second, axle)]
        self.plate("hub", 2 * sizes.hub, bores)
        for k in (1, 2):
            self.fix("pinion", f"hub_{k}", 0j, k * thick, "hub")
        self.pin("platform_axle", axle, self.platform + thick - self.pinion)
        self.fix("pinion", "platform_axle", second, 0.0)

    def _first_stage(self) -> None:
        """The flange, which runs on the hub, hung on the posts by cranks as long as O1O2."""
        sizes, keys, thick = self.sizes, self.keys, self.keys.plate_thickness
        self.hang_flange(keys.pin_diameter, sizes.posts, sizes.pivots, sizes.boss, sizes.hub + keys.clearance)
        self.put("carried", "disk_2", "flange", offset=place(complex(sizes.arm), self.flange - self.disk))
        self.mate("parallel", "base", "flange")
        turning = (keys.pin_diameter + keys.clearance,) * 2
        self.crank("first_crank", sizes.arm, turning, (2 * sizes.boss,) * 2)
        self.pin("upper_pin", keys.pin_diameter, self.flange + thick - self.first_cranks)
        posts, pins = on_circle(3, sizes.posts), [("flange", "upper_pin", self.first_cranks - self.flange)]
        self.hang_cranks("first_crank", "first_crank", "disk_2", posts, self.first_cranks - self.disk, pins)

    def _second_stage(self) -> None:
        """The platform on its axle, hung on the flange by cranks as long as O2O3."""
        sizes, keys, thick = self.sizes, self.keys, self.keys.plate_thickness
        pivots, middle = on_circle(3, sizes.pivots, 60.0), hole(0j, keys.platform_axle_diameter + keys.clearance)
        around = [hole(at, keys.pin_diameter) for at in pivots]
        self.plate("platform", keys.platform_size, [middle, *around], square=True)
        self.put("carried", "pinion", "platform", offset=place(complex(sizes.second_arm), self.platform - self.pinion))
        self.mate("parallel", "flange", "platform")
        turning = (keys.pin_diameter + keys.clearance,) * 2
        self.crank("second_crank", sizes.second_arm, turning, (2 * sizes.boss,) * 2)
        self.pin("flange_pin", keys.pin_diameter, self.second_cranks + thick - self.flange)
        self.pin("platform_pin", keys.pin_diameter, self.platform + thick - self.second_cranks)
        height = self.second_cranks - self.pinion
        pins = ("flange", "flange_pin", 0.0), ("platform", "platform_pin", self.second_cranks - self.platform)
        self.hang_cranks("second_crank", "second_crank", "pinion", pivots, height, pins, "flange")

    def _hand_cranks(self) -> None:
        """Behind the base: that of the ring on the tube, that of disk 2 on the shaft, shorter, further back."""
        keys, thick = self.keys, self.keys.plate_thickness
        lengths = {"ring": round(0.7 * self.sizes.half, 1), "disk": round(0.45 * self.sizes.half, 1)}
        bores = {"ring": self.sizes.tube, "disk": keys.axle_diameter}
        self.pin("handle", _HANDLE, thick + _GRIP)
        for name, owner, height in zip(("ring", "disk"), ("ring", "disk_2"), self.ends, strict=True):
            part = f"{name}_hand_crank"
            self.crank(part, lengths[name], (bores[name], _HANDLE), (bores[name] + 4 * _WALL, 2 * _HANDLE))
            self.fix(owner, part, 0j, height - (self.ring if owner == "ring" else self.disk))
            self.fix(part, f"{name}_handle", complex(lengths[name]), -_GRIP, "handle")

    def _slots(self) -> list[Table]:
        """Of the base, for the bearings of both worms; beyond their edges by the clearance."""
        sizes, keys = self.sizes, self.keys
        middle, half = sizes.beside + _BEARING / 2, (sizes.bearing + keys.clearance) / 2
        return [
            {"start": place(complex(side * (far - half), way * middle), 0.0)[:2],
             "end": place(complex(side * (far + half), way * middle), 0.0)[:2], "width": _BEARING + keys.clearance}
            for side, far in zip((-1, 1), map(sizes.worm_distance, keys.worm_wheel_teeth), strict=True)
            for way in (1, -1)
        ]  # fmt: skip

    def _worms(self) -> None:
        """Behind the base: the wheel of the ring on the tube, that of disk 2 on the shaft, each with its worm."""
        sizes, keys = self.sizes, self.keys
        above = {"disk": sizes.worm_planes[1] - sizes.worm_wheel_width / 2, "ring": 0.0}
        owners, bores = {"disk": "disk_2", "ring": "ring"}, {"disk": keys.axle_diameter, "ring": sizes.tube}
        stands = {"disk": self.disk, "ring": self.ring}
        for name, teeth, plane in zip(owners, keys.worm_wheel_teeth, sizes.worm_planes, strict=True):
            wheel, low = f"{name}_worm_wheel", plane - sizes.worm_wheel_width / 2
            top = above[name] - keys.axial_gap - low - sizes.worm_wheel_width
            self.part(
                wheel, "worm_wheel", kind="worm_wheel", module=keys.worm_module, number_of_teeth=teeth,
                diameter_quotient=_Q, face_width=sizes.worm_wheel_width, outer_diameter=sizes.worm_wheel(teeth),
                axial_thinning=keys.worm_thinning, bore_diameter=bores[name],
                hub={"diameter": bores[name] + 4 * _WALL, "above": round(top, 6)},
            )  # fmt: skip
            self.fix(owners[name], wheel, 0j, low - stands[name])
            self._worm(name, wheel, teeth, plane, 1 if name == "ring" else -1)

    def _worm(self, name: str, wheel: str, teeth: int, plane: float, side: int) -> None:
        """A worm beside +x or -x with its bearings, the thick journal's at +y or -y, and its collar."""
        sizes, keys = self.sizes, self.keys
        core, gap, neck = sizes.worm_core, keys.axial_gap, sizes.beside - keys.worm_module * _THREAD / 2
        thin = core - 3
        self.part(
            f"{name}_worm", "worm", kind="worm", module=keys.worm_module, diameter_quotient=_Q,
            thread_length=_THREAD * keys.worm_module, tip_rounding=0.15 * keys.worm_module,
            bore={"shape": "hexagon", "across_flats": 3 * keys.worm_module + keys.clearance},
            shaft_below=[{"diameter": core, "length": neck}, {"diameter": sizes.journal, "length": _BEARING + 2}],
            shaft_above=[{"diameter": core, "length": neck - gap},
                         {"diameter": thin, "length": _BEARING + 2 * gap + _COLLAR}],
        )  # fmt: skip
        self.put("worm_pair", wheel, f"{name}_worm", direction_deg=0.0 if side > 0 else 180.0)
        far, over = side * sizes.worm_distance(teeth), keys.plate_thickness - keys.clearance - plane
        for end, diameter, way in (("thick", sizes.journal, side), ("thin", thin, -side)):
            self.part(
                f"{name}_{end}_bearing", "bearing", kind="plate", width=sizes.bearing, height=over + sizes.bearing / 2,
                centre=place(complex(0, over / 2 - sizes.bearing / 4), 0.0)[:2], face_width=_BEARING,
                holes=[hole(0j, diameter + keys.clearance)],
            )  # fmt: skip
            self._upright(f"{name}_{end}_bearing", complex(far, way * (sizes.beside + _BEARING / 2)), plane, _BEARING)
        middle = sizes.beside + _BEARING + gap + _COLLAR / 2
        self.pin(f"{name}_collar", core + 3, _COLLAR, thin + keys.fit)
        self._upright(f"{name}_collar", complex(far, -side * middle), plane, _COLLAR)

    def _upright(self, name: str, middle: complex, height: float, length: float) -> None:
        """A part that stands still with its axis along -y."""
        at = place(middle + 0.5j * length, height)
        self.found.instances[name] = {"part": name, "at": at, "axis": [0.0, -1.0, 0.0], "held": True}


POWER_TABLE = Recipe(PowerTableKeys, lambda keys: _Making(_checked(keys)).all())

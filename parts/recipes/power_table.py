"""The assembly ``power_table``: the two-disk power table (thesis) out of flat plates and dowels, to be cut and turned.

From the back: cranks, base with feet, back disk, disk 2 within a rim, ring and pinion (disk 3), cranks of the first
stage on posts, the flange that they hold, cranks of the second stage, platform. Back disk, rim and ring are one body,
as the thesis's 12, 13, 18 are; the tube of the back disk and the shaft of disk 2 within it carry the hand cranks. The
flange runs on a hub of the pinion: no axle crosses the plane of the first cranks.
"""

from __future__ import annotations

import cmath
import math
from typing import Annotated

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.record import Record
from parts.keys.base import Material, mm
from parts.recipes.recipe import Expansion, Recipe, RecipeKeys, Table

# modules: what a ring's root is beyond its reference circle at most, with its clearance; a rim beyond that, mm
_ROOT, _RIM = 1.25, 8.0
# mm: wall beside a hole, of a boss about a pin beyond its radius, of a tube; feet, cranks by hand, handles
_WALL, _BOSS, _TUBE = 3.0, 3.0, 3.0
_FOOT, _FEET_HEIGHT, _HANDLE, _GRIP = 10.0, 70.0, 6.0, 25.0
_COLOURS = {
    "base": "#ece8df", "guide": "#e0d8c8", "back": "#c9b79c", "rim": "#c9b79c", "ring": "#9fb0c0", "disk": "#d9a066",
    "pinion": "#4f8fc0", "hub": "#70a0d0", "flange": "#b5c7a3", "crank": "#d98880", "platform": "#f2e2b6",
    "pin": "#d0d4d8",
}  # fmt: skip
_Turns = Annotated[float, Meta(ge=-1000, le=1000, extra={"unit": "turns"})]


class PowerTableKeys(RecipeKeys, kw_only=True, tag="power_table"):
    """Keys of ``power_table``."""

    module: Annotated[float, mm("module of ring and pinion", least=0.1, most=100)] = 2.25
    teeth: Annotated[
        tuple[Annotated[int, Meta(ge=8, le=1000)], Annotated[int, Meta(ge=8, le=1000)]],
        Meta(description="of the pinion and of the ring; half their difference by the module is O1O2"),
    ] = (32, 48)
    second_arm: Annotated[float, mm("O2O3; default: as O1O2", above=0, most=1000, example=18.0)] | None = None
    normal_backlash: Annotated[float, mm("of ring and pinion", least=0, most=10)] = 0.15
    plate_thickness: Annotated[float, mm("of all flat parts", least=0.5, most=100)] = 4.0
    axial_gap: Annotated[float, mm("between planes that turn against each other", least=0, most=100)] = 0.5
    clearance: Annotated[float, mm("of holes that turn on something beyond it", least=0, most=5)] = 0.2
    pin_diameter: Annotated[float, mm("of the cranks' pins", least=0.5, most=100)] = 4.0
    axle_diameter: Annotated[float, mm("of the shaft of disk 2, and of the axle of disk 3", least=1, most=200)] = 8.0
    platform_axle_diameter: Annotated[float, mm("of the platform's axle", least=0.5, most=200)] = 6.0
    platform_size: Annotated[float, mm("side of the platform", above=0, most=2000)] = 84.0
    turns_of_disk: Annotated[_Turns, Meta(description="how far disk 2 is turned")] = 1.0
    turns_of_ring: Annotated[_Turns, Meta(description="how far the ring is turned")] = -2.0
    material: Material | None = None


class _Sizes(Record):
    """What follows from the keys, mm: each by the rule beside it."""

    keys: PowerTableKeys

    @property
    def arm(self) -> float:
        """O1O2: the centre distance of ring and pinion without shifts."""
        pinion, ring = self.keys.teeth
        return self.keys.module * (ring - pinion) / 2

    @property
    def second_arm(self) -> float:
        """O2O3."""
        return self.keys.second_arm or self.arm

    @property
    def boss(self) -> float:
        """Radius of the round end of a crank."""
        return self.keys.pin_diameter / 2 + _BOSS

    @property
    def hub(self) -> float:
        """Radius of the pinion's hub: the platform's axle goes through it."""
        return math.ceil(self.second_arm + self.keys.platform_axle_diameter / 2 + _WALL)

    @property
    def ring(self) -> float:
        """Outer radius of ring, rim and back disk."""
        return math.ceil(self.keys.module * (self.keys.teeth[1] / 2 + _ROOT) + _RIM)

    @property
    def disk(self) -> float:
        """Radius of disk 2: within the ring's tips, into whose plane it stands by a gap."""
        return math.floor(self.keys.module * (self.keys.teeth[1] / 2 - 1) - self.keys.clearance)

    @property
    def posts(self) -> float:
        """Radius of the posts' circle: out of the ring's way, their first cranks out of the hub's."""
        beside = self.ring + self.keys.clearance + self.keys.pin_diameter / 2 + _WALL + 2
        return math.ceil(max(beside, self.hub + self.arm + self.boss + 1, _side_by_side(self.arm, self.boss)))

    @property
    def pivots(self) -> float:
        """Radius of the second pivots' circle on the flange: beside the hub, cranks beside the platform's axle."""
        past = self.second_arm + self.keys.platform_axle_diameter / 2 + self.boss + 1
        wall = self.hub + self.keys.clearance + self.keys.pin_diameter / 2 + _WALL
        return math.ceil(max(past, wall, _side_by_side(self.second_arm, self.boss)))

    @property
    def half(self) -> float:
        """Half a side of the base."""
        return self.posts + self.keys.pin_diameter / 2 + 8

    def checked(self) -> _Sizes:
        """Refuse sizes that nothing follows from, by the driver and its limit."""
        keys, (pinion, ring) = self.keys, self.keys.teeth
        if pinion >= ring:
            raise ParameterError("teeth", list(keys.teeth), "ring_as_its_wheel")
        root = keys.module * (pinion / 2 - _ROOT)
        most = root - keys.platform_axle_diameter / 2 - _WALL
        if self.second_arm > most:
            name = "second_arm" if keys.second_arm else "teeth"
            raise ParameterError(name, keys.second_arm or list(keys.teeth), "axle_beyond_pinion",
                                 limit(most, self.second_arm) if keys.second_arm else None, most=most)  # fmt: skip
        between = self.second_arm - (keys.axle_diameter + keys.platform_axle_diameter) / 2 - keys.clearance
        if between < _WALL / 2:
            name = "second_arm" if keys.second_arm else "axle_diameter"
            raise ParameterError(name, self.second_arm if keys.second_arm else keys.axle_diameter, "axles_meet", None,
                                 wall=between)  # fmt: skip
        if self.arm + keys.axle_diameter / 2 + _WALL > self.disk or self.arm - keys.axle_diameter < _WALL / 2:
            between = min(self.disk - self.arm - keys.axle_diameter / 2, self.arm - keys.axle_diameter)
            raise ParameterError("axle_diameter", keys.axle_diameter, "axles_meet", None, wall=between)
        least = 2 * (self.pivots + self.boss)
        if keys.platform_size < least:
            raise ParameterError("platform_size", keys.platform_size, "platform_too_small", Nearest(least, "at_least"))
        return self


def _side_by_side(crank: float, boss: float) -> float:
    """Least pivot circle of three parallel cranks in one plane that pass each other."""
    return (crank + 2 * boss + 0.5) / math.sqrt(3)


class PowerTableRecipe(Recipe[PowerTableKeys]):
    """Plates, dowels and tubes."""

    name, keys = "power_table", PowerTableKeys

    def expanded(self, keys: PowerTableKeys) -> Expansion:
        """The tables of one table."""
        return _Making(_Sizes(keys).checked()).all()


POWER_TABLE = PowerTableRecipe()


class _Making:
    """The tables as they grow; heights are of lower faces, the base's is 0."""

    def __init__(self, sizes: _Sizes) -> None:
        self.sizes, self.keys, self.found = sizes, sizes.keys, Expansion()
        thick, gap = self.keys.plate_thickness, self.keys.axial_gap
        self.back = thick + gap
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
        self._hand_cranks()
        keys = self.keys
        self.found.drives.append({"instance": "disk_2", "turns": keys.turns_of_disk})
        self.found.drives.append({"instance": "ring", "turns": keys.turns_of_ring})
        self.found.origins |= {
            "parts.ring.number_of_teeth": "teeth", "parts.pinion.number_of_teeth": "teeth",
            "parts.ring.module": "module", "parts.pinion.module": "module",
            "drives[1].turns": "turns_of_disk", "drives[2].turns": "turns_of_ring",
            "parts.pinion.bore_diameter": "axle_diameter", "parts.platform.width": "platform_size",
        }  # fmt: skip
        return self.found

    def _plate(self, name: str, size: float, holes: list[Table], *, round_: bool, colour: str, **more: object) -> None:
        radius = size / 2 if round_ else min(_FOOT, size / 8)
        table: Table = {"kind": "plate", "width": size, "height": size, "corner_radius": radius,
                        "face_width": self.keys.plate_thickness, "holes": holes, **more}  # fmt: skip
        self.found.parts[name] = table | self._looks(colour)

    def _looks(self, colour: str) -> Table:
        own = {"colour": _COLOURS[colour]}
        return own if self.keys.material is None else {"material": self.keys.material, **own}

    def _pin(self, name: str, diameter: float, length: float, bore: float = 0.0) -> None:
        self.found.parts[name] = {"kind": "pin", "diameter": diameter, "length": length, "bore_diameter": bore,
                                  "colour": _COLOURS["pin"]}  # fmt: skip

    def _put(self, kind: str, first: str, second: str, part: str = "", **keys: object) -> None:
        self.found.instances[second] = {"part": part or second}
        self.found.mates.append({"kind": kind, "first": first, "second": second, **keys})

    def _fix(self, first: str, second: str, at: complex, height: float, part: str = "") -> None:
        """``height`` above the lower face of the first."""
        self._put("fixed", first, second, part, offset=[round(at.real, 6), round(at.imag, 6), round(height, 6)])

    def _body(self) -> None:
        """The base on its feet, the guide about the ring's stack, and the posts of the first cranks."""
        sizes, keys = self.sizes, self.keys
        tube = keys.axle_diameter + keys.clearance + 2 * _TUBE
        corners = [cmath.rect(math.sqrt(2) * (sizes.half - _FOOT), math.pi / 4 + k * math.pi / 2) for k in range(4)]
        posts = [sizes.posts * cmath.exp(2j * math.pi * k / 3) for k in range(3)]
        fixed = [_hole(at, _FOOT) for at in corners] + [_hole(at, keys.pin_diameter) for at in posts]
        self._plate("base", 2 * sizes.half, [_hole(0j, tube + keys.clearance), *fixed], round_=False, colour="base")
        self._plate("guide", 2 * sizes.half, [_hole(0j, 2 * (sizes.ring + keys.clearance)), *fixed], round_=False,
                    colour="guide")  # fmt: skip
        self.found.instances["base"] = {"part": "base", "held": True}
        thick = keys.plate_thickness
        self._fix("base", "guide", 0j, thick)
        self._pin("foot", _FOOT, _FEET_HEIGHT)
        self._pin("post", keys.pin_diameter, self.first_cranks + thick)
        for k, at in enumerate(corners, 1):
            self._fix("base", f"foot_{k}", at, 2 * thick - _FEET_HEIGHT, "foot")
        for k, at in enumerate(posts, 1):
            self._fix("base", f"post_{k}", at, 0.0, "post")

    def _ring(self) -> None:
        """Back disk, rim and ring, one body on four dowels; the tube in it."""
        sizes, keys, thick = self.sizes, self.keys, self.keys.plate_thickness
        tube = keys.axle_diameter + keys.clearance + 2 * _TUBE
        circle = sizes.ring - _RIM / 2
        dowels = [cmath.rect(circle, math.pi / 4 + k * math.pi / 2) for k in range(4)]
        holes = [_hole(at, keys.pin_diameter) for at in dowels]
        self._plate("back", 2 * sizes.ring, [_hole(0j, tube), *holes], round_=True, colour="back")
        self._plate(
            "rim", 2 * sizes.ring, [_hole(0j, 2 * (sizes.disk + keys.clearance)), *holes], round_=True, colour="rim"
        )
        self.found.parts["ring"] = {
            "kind": "ring_gear", "module": keys.module, "number_of_teeth": keys.teeth[1], "face_width": thick,
            "outer_diameter": 2 * sizes.ring, "tooth_mark": {},
            "holes": {"count": 4, "diameter": keys.pin_diameter, "start_deg": 45.0,
                      "pitch_circle_diameter": 2 * circle},
        } | self._looks("ring")  # fmt: skip
        self._put("coaxial", "base", "ring", height=self.ring)
        self._fix("ring", "back", 0j, self.back - self.ring)
        self._fix("ring", "rim", 0j, self.back + thick - self.ring)
        self._pin("dowel", keys.pin_diameter, 3 * thick)
        for k, at in enumerate(dowels, 1):
            self._fix("ring", f"dowel_{k}", at, self.back - self.ring, "dowel")
        # down to the lower face of its crank
        low = -keys.axial_gap - thick
        self._pin("tube", tube, self.back + thick - low, keys.axle_diameter + keys.clearance)
        self._fix("ring", "tube", 0j, low - self.ring, "tube")

    def _disks(self) -> None:
        """Disk 2 with its shaft and the axle of disk 3; the pinion with its hub and the platform's axle."""
        sizes, keys, thick = self.sizes, self.keys, self.keys.plate_thickness
        arm, second = complex(sizes.arm), complex(sizes.second_arm)
        shaft, axle = keys.axle_diameter, keys.platform_axle_diameter
        mark = {"start": [sizes.disk - 12, 0.0], "end": [sizes.disk - 4, 0.0], "width": 1.0}
        self._plate("disk_2", 2 * sizes.disk, [_hole(0j, shaft), _hole(arm, shaft)], round_=True, colour="disk",
                    engraved=[mark])  # fmt: skip
        self._put("coaxial", "base", "disk_2", height=self.disk)
        low = -2 * keys.axial_gap - 2 * thick
        self._pin("shaft", shaft, self.disk + thick - low)
        self._fix("disk_2", "shaft", 0j, low - self.disk)
        top = self.pinion + 3 * thick
        self._pin("axle", shaft, top - self.disk)
        self._fix("disk_2", "axle", arm, 0.0)
        self.found.parts["pinion"] = {
            "kind": "spur_gear", "module": keys.module, "number_of_teeth": keys.teeth[0], "face_width": thick,
            "bore_diameter": shaft + keys.clearance, "tooth_mark": {},
            "holes": {"count": 1, "diameter": axle, "start_deg": 0.0, "pitch_circle_diameter": 2 * sizes.second_arm},
        } | self._looks("pinion")  # fmt: skip
        self._put("carried", "disk_2", "pinion", offset=[sizes.arm, 0.0, self.pinion - self.disk])
        mesh = {"kind": "internal_gear_pair", "first": "ring", "second": "pinion"}
        self.found.mates.append({**mesh, "normal_backlash": keys.normal_backlash})
        bores = [_hole(0j, shaft + keys.clearance), _hole(second, axle)]
        self._plate("hub", 2 * sizes.hub, bores, round_=True, colour="hub")
        for k in (1, 2):
            self._fix("pinion", f"hub_{k}", 0j, k * thick, "hub")
        self._pin("platform_axle", axle, self.platform + thick - self.pinion)
        self._fix("pinion", "platform_axle", second, 0.0)

    def _first_stage(self) -> None:
        """The flange, which runs on the hub, hung on the posts by cranks as long as O1O2."""
        sizes, keys, thick = self.sizes, self.keys, self.keys.plate_thickness
        self.found.parts["flange"] = {
            "kind": "carrier_plate", "number_of_pins": 3, "pin_circle_diameter": 2 * sizes.posts,
            "pin_diameter": keys.pin_diameter, "boss_diameter": 2 * sizes.boss, "face_width": thick,
            "hub_diameter": 2 * (sizes.pivots + sizes.boss), "bore_diameter": 2 * (sizes.hub + keys.clearance),
            "spacers": {"count": 3, "pitch_circle_diameter": 2 * sizes.pivots, "diameter": keys.pin_diameter,
                        "boss_diameter": 2 * sizes.boss, "start_deg": 60.0},
        } | self._looks("flange")  # fmt: skip
        self._put("carried", "disk_2", "flange", offset=[sizes.arm, 0.0, self.flange - self.disk])
        self.found.mates.append({"kind": "parallel", "first": "base", "second": "flange"})
        self._crank("first_crank", sizes.arm)
        self._pin("upper_pin", keys.pin_diameter, self.flange + thick - self.first_cranks)
        for k in range(3):
            at = sizes.posts * cmath.exp(2j * math.pi * k / 3)
            place = [round(at.real, 6), round(at.imag, 6), self.first_cranks - self.disk]
            self._put("parallel", "disk_2", f"first_crank_{k + 1}", "first_crank", offset=place)
            self._fix("flange", f"upper_pin_{k + 1}", at, self.first_cranks - self.flange, "upper_pin")

    def _second_stage(self) -> None:
        """The platform on its axle, hung on the flange by cranks as long as O2O3."""
        sizes, keys, thick = self.sizes, self.keys, self.keys.plate_thickness
        pivots = [cmath.rect(sizes.pivots, math.pi / 3 + 2 * math.pi * k / 3) for k in range(3)]
        holes = [
            _hole(0j, keys.platform_axle_diameter + keys.clearance),
            *(_hole(p, keys.pin_diameter) for p in pivots),
        ]
        self._plate("platform", keys.platform_size, holes, round_=False, colour="platform")
        place = [sizes.second_arm, 0.0, self.platform - self.pinion]
        self._put("carried", "pinion", "platform", offset=place)
        self.found.mates.append({"kind": "parallel", "first": "flange", "second": "platform"})
        self._crank("second_crank", sizes.second_arm)
        self._pin("flange_pin", keys.pin_diameter, self.second_cranks + thick - self.flange)
        self._pin("platform_pin", keys.pin_diameter, self.platform + thick - self.second_cranks)
        for k, at in enumerate(pivots, 1):
            place = [round(at.real, 6), round(at.imag, 6), self.second_cranks - self.pinion]
            self._put("parallel", "pinion", f"second_crank_{k}", "second_crank", offset=place)
            self.found.mates.append({"kind": "carried", "first": "flange", "second": f"second_crank_{k}"})
            self._fix("flange", f"flange_pin_{k}", at, 0.0, "flange_pin")
            self._fix("platform", f"platform_pin_{k}", at, self.second_cranks - self.platform, "platform_pin")

    def _crank(self, name: str, length: float) -> None:
        """A link with two holes that turn on pins."""
        hole = self.keys.pin_diameter + self.keys.clearance
        self.found.parts[name] = {
            "kind": "follower_arm", "end": "roller", "arm_length": length, "width": 2 * self.sizes.boss,
            "boss_diameter": 2 * self.sizes.boss, "pivot_diameter": hole, "pin_diameter": hole,
            "face_width": self.keys.plate_thickness,
        } | self._looks("crank")  # fmt: skip

    def _hand_cranks(self) -> None:
        """Behind the base: that of the ring on the tube, that of disk 2 on the shaft, shorter, further back."""
        keys, thick = self.keys, self.keys.plate_thickness
        tube = keys.axle_diameter + keys.clearance + 2 * _TUBE
        lengths = {"ring": round(0.7 * self.sizes.half, 1), "disk": round(0.45 * self.sizes.half, 1)}
        bores, low = {"ring": tube, "disk": keys.axle_diameter}, -keys.axial_gap - thick
        self._pin("handle", _HANDLE, thick + _GRIP)
        for name, owner, height in (("ring", "ring", low), ("disk", "disk_2", low - keys.axial_gap - thick)):
            part = f"{name}_hand_crank"
            self.found.parts[part] = {
                "kind": "follower_arm", "end": "roller", "arm_length": lengths[name], "width": 2 * _HANDLE,
                "boss_diameter": bores[name] + 4 * _WALL, "pivot_diameter": bores[name], "pin_diameter": _HANDLE,
                "face_width": thick,
            } | self._looks("crank")  # fmt: skip
            self._fix(owner, part, 0j, height - (self.ring if owner == "ring" else self.disk))
            self._fix(part, f"{name}_handle", complex(lengths[name]), -_GRIP, "handle")


def _hole(at: complex, diameter: float) -> Table:
    return {"at": [round(at.real, 6), round(at.imag, 6)], "diameter": diameter}

"""The assembly ``power_module``: the two-coordinate power table of the thesis, every position of its parts list.

Sizes follow by ``parts/pages/module_rules.py``. From the front: platform 4; shields 7, 8; disk 2 with disk 3 in it
on two rows of balls, in the body on a third; wheel 21 with pinion 19 behind them; ring 24 and worm wheel 25 on disk 2;
ring 22, the inner race of the fourth row, and worm wheel 23 on wheel 21; what turns the platform;
both worms in the body. All of disk 2 comes in from the front, guide 6 then closes the opening about it, and guide 5
the row of balls between them; each worm comes in through the wall and the seat that its cover then closes. Threads
are plain cylinders of the nominal diameter. The groove that section 2.3 has in wheel 21 is turned in ring 22, one body
with it.

The platform is turned by the wheels 16, 14, 11 of the thesis, or kept parallel: by an idler between each two of them,
on links about O1, O2 and O3, wheel 11 on the end of the axle beyond nut 47; or by cranks: plate 16 on the body, ring 14
about O2, plate 11 on the platform's axle, between them two planes of three cranks each, which no axle crosses. Ring 14
runs on its rim in guide 13, a cup on the pinion, within which plate 11 turns; axially collars of the pins hold it.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Annotated, Literal

from msgspec import Meta
from msgspec.structs import replace

from geometry.base.errors import Nearest, ParameterError
from geometry.base.nearest import nearest
from parts.base.psv import rows_of
from parts.base.texts import N_, Message, words
from parts.keys.base import mm
from parts.pages.module_rules import (
    CONDITIONS,
    DRIVERS,
    M4,
    M8,
    M10,
    M12,
    Condition,
    listed,
    of_orientation,
    sizes,
    valued,
)
from parts.recipes.making import Making, holes_on, module_to_span, on_circle, place
from parts.recipes.names import NAMES
from parts.recipes.power_module_kinematics import IDLER_SHIFT
from parts.recipes.recipe import Expansion, Recipe, RecipeKeys, Table, Turns

_Teeth = Annotated[int, Meta(ge=12, le=1000)]
# across flats of M8 and M12, height of their heads and nuts
_HEX_8, _HEX_12 = (13.0, 5.3), (18.0, 7.5, 10.8)
# step of a casting from one level to the next, play of what is turned by hand, mm
_STEP, _PLAY = 1.0, 0.05
# radius of the platform axle's thread under nut 47, and of axle 13
_THREAD_47, _AXLE = 22.5, 10.0
# depth of the groove of a snap ring
_SNAP = 1.5
# guide 6: height of its flange, which screws M8x16 hold by as much, how many, how deep their holes are
_FLANGE, _GUIDE_SCREWS, _DEEP = 8.0, 20, 10.0
# guide 5: how many screws, where the first is, degrees
_RACE_SCREWS, _RACE_START = 32, 1.875
# disk 3: how deep its recess for screws is
_RECESS = 17.0
# what is turned, a row of ``module_bodies.psv`` each: points of half a section, holes and lengths of its own, made of
# sizes and of these
_BODIES = {
    name: (points, holes, dict(one.split(" = ") for cell in own for one in cell.split("; ")))
    for name, points, holes, *own in rows_of(__file__, "module_bodies")
}

_DESIGNATION, _STANDARD = N_("KRB.PM.25.33.13.00.{number}"), N_("GOST {number}")

_ORIENTATION = Meta(
    description="cranks keep the platform parallel: plates 11 and 16, ring 14, its guide 13, cranks 34 and "
    "pins 35, without 15 and 57; idlers too: wheels 11, 14, 16 with idlers 36 between, their pins 37, links "
    "38, post 39; thesis: its wheels 11, 14, 16, axle 13"
)
_SECOND_ARM = mm("O2O3; must be what ring and pinion give", above=0, most=1000, example=72.0)
_TEETH = Meta(description="of the pinion 19 and of the ring 21")
_WHEEL_MODULE = mm("module of the thesis's wheels 11, 14, 16", least=0.1, most=100)
_WORM_QUOTIENT = Meta(ge=4, le=30, description="q = d1 / m of both worms")
_WORM_TEETH = Meta(description="of the worm wheels 25 (I) and 23 (II)")
_WHEEL_WIDTH = mm("of the wheels 11 and 16, or of plates, ring and cranks", least=1, most=1000)
_DISK_THICKNESS = mm("of disk 2, and with its gaps of disk 3", least=1, most=1000)
_AXIAL_GAP = mm("between planes that turn against each other", least=0.1, most=100)
_CLEARANCE = mm("radius of bores that turn on something, beyond it", least=0.01, most=1)
_BALLS = Meta(ge=8, le=2000, description="balls of both rows of each circle together")


class PowerModuleKeys(RecipeKeys, kw_only=True, tag="power_module"):
    """Keys of ``power_module``: its drivers."""

    orientation: Annotated[Literal["cranks", "thesis", "idlers"], _ORIENTATION] = "cranks"
    module: Annotated[float, mm("module of ring and pinion", least=0.1, most=100)] = DRIVERS["module"]
    teeth: Annotated[tuple[_Teeth, _Teeth], _TEETH] = (int(DRIVERS["teeth_19"]), int(DRIVERS["teeth_21"]))
    second_arm: Annotated[float, _SECOND_ARM] | None = None
    wheel_module: Annotated[float, _WHEEL_MODULE] = DRIVERS["wheel_module"]
    worm_module: Annotated[float, mm("module of worms and worm wheels", least=0.1, most=100)] = DRIVERS["worm_module"]
    worm_quotient: Annotated[float, _WORM_QUOTIENT] = DRIVERS["worm_quotient"]
    worm_teeth: Annotated[tuple[_Teeth, _Teeth], _WORM_TEETH] = (
        int(DRIVERS["worm_teeth_25"]),
        int(DRIVERS["worm_teeth_23"]),
    )
    worm_wheel_width: Annotated[float, mm("of the worm wheels' rims", least=1, most=1000)] = DRIVERS["worm_wheel_width"]
    worm_length: Annotated[float, mm("of the worms' threads", least=1, most=5000)] = DRIVERS["worm_length"]
    face_width: Annotated[float, mm("of ring and pinion", least=1, most=1000)] = DRIVERS["face_width"]
    wheel_width: Annotated[float, _WHEEL_WIDTH] = DRIVERS["wheel_width"]
    disk_thickness: Annotated[float, _DISK_THICKNESS] = DRIVERS["disk_thickness"]
    axial_gap: Annotated[float, _AXIAL_GAP] = DRIVERS["axial_gap"]
    clearance: Annotated[float, _CLEARANCE] = DRIVERS["clearance"]
    ball: Annotated[float, mm("diameter of all balls", least=1, most=100)] = DRIVERS["ball"]
    balls: Annotated[int, _BALLS] = int(DRIVERS["balls"])
    platform_size: Annotated[float, mm("side of the platform", above=0, most=5000)] = DRIVERS["platform_size"]
    turns_of_disk: Annotated[Turns, Meta(description="how far disk 2 is turned")] = 1.0
    turns_of_ring: Annotated[Turns, Meta(description="how far wheel 21 is turned")] = -2.0
    names: Annotated[Literal["en", "uk"], Meta(description="language of designations")] = "en"


_DRIVERS = tuple(name for name in DRIVERS if "teeth" not in name)


def drivers(keys: PowerModuleKeys) -> dict[str, float]:
    """The drivers by the names that rules have for them."""
    found = {name: getattr(keys, name) for name in _DRIVERS}
    return found | {
        "teeth_19": keys.teeth[0], "teeth_21": keys.teeth[1],
        "worm_teeth_25": keys.worm_teeth[0], "worm_teeth_23": keys.worm_teeth[1],
    }  # fmt: skip


def checked_sizes(keys: PowerModuleKeys) -> dict[str, float]:
    """Every size by its rule.

    Raises
    ------
    ParameterError
        A condition is not kept: its driver, what lacks and by how much.
    """
    found = sizes(drivers(keys), keys.orientation)
    for condition in of_orientation(CONDITIONS, keys.orientation):
        left = valued(condition.made_of, found)
        if left < 0:
            name, cure = _to_blame(keys, condition)
            given, told = getattr(keys, name), {"lacks": -left, "what": Message(condition.reason)}
            raise ParameterError(name, list(given) if isinstance(given, tuple) else given, "module_lacks", cure, **told)
    arm = found["arm"]
    if keys.second_arm is not None and abs(keys.second_arm - arm) > 1e-9:
        raise ParameterError("second_arm", keys.second_arm, "arm_of_ring_and_pinion", Nearest(arm), arm=arm)
    if keys.orientation == "cranks" and keys.wheel_module != DRIVERS["wheel_module"]:
        raise ParameterError("wheel_module", keys.wheel_module, "for_thesis_only")
    if not _spanned(keys, arm):
        cure = module_to_span(keys.wheel_module, arm / (3 if keys.orientation == "idlers" else 1))
        raise ParameterError("wheel_module", keys.wheel_module, "wheels_do_not_span_arm", cure, arm=arm)
    return found


def _spanned(keys: PowerModuleKeys, arm: float) -> bool:
    """Whether wheels with whole teeth span an arm; an idler is half as large as its neighbours."""
    whole = arm / keys.wheel_module / (3 if keys.orientation == "idlers" else 1)
    return keys.orientation == "cranks" or (abs(whole - round(whole)) <= 1e-9 and round(whole) >= 12)


def _to_blame(keys: PowerModuleKeys, condition: Condition) -> tuple[str, Nearest | None]:
    """The changed driver that mends everything, with its nearest value that does on the way to its default; or this
    alone; or that which does most for it.
    """
    usual = PowerModuleKeys()
    names = dict.fromkeys((condition.driver, *_DRIVERS, "worm_teeth", "teeth"))
    changed = [name for name in names if getattr(keys, name) != getattr(usual, name)]
    every = of_orientation(CONDITIONS, keys.orientation)

    def left(rows: Sequence[Condition], name: str, value: object) -> float:
        known = sizes(drivers(replace(keys, **{name: value})), keys.orientation)
        return min(valued(row.made_of, known) for row in rows)

    for kept in (every, [condition]):
        for name in changed:
            if left(kept, name, getattr(usual, name)) >= 0:
                if kept is not every:
                    return name, None

                def works(value: object, name: str = name) -> bool:
                    arm = sizes(drivers(replace(keys, **{name: value})), keys.orientation)["arm"]
                    return left(every, name, value) >= 0 and _spanned(replace(keys, **{name: value}), arm)

                search = _nearest_teeth if "teeth" in name else nearest
                return name, search(works, getattr(keys, name), getattr(usual, name))
    return max(changed, key=lambda name: left([condition], name, getattr(usual, name)), default=condition.driver), None


def _nearest_teeth(
    works: Callable[[tuple[int, ...]], bool], given: tuple[int, ...], usual: tuple[int, ...]
) -> Nearest | None:
    """Numbers of teeth that work, each in its turn as near to what is given as it goes, the next at their usual."""
    found = usual
    for k, wanted in enumerate(given):

        def one(value: float, k: int = k) -> bool:
            return works((*found[:k], int(value), *found[k + 1 :]))  # noqa: B023

        if one(wanted):
            found = (*found[:k], wanted, *found[k + 1 :])
        elif (near := nearest(one, wanted, usual[k])) is not None and isinstance(near.value, int):
            found = (*found[:k], near.value, *found[k + 1 :])
    return Nearest(list(found)) if works(found) else None


class _Making(Making):
    """The tables as they grow; heights above the back of the disks."""

    def __init__(self, keys: PowerModuleKeys) -> None:
        self.keys, self.s = keys, checked_sizes(keys)
        super().__init__("power_module", keys.disk_thickness, keys)
        self.within = ""
        # cranks, no wheels; idlers between the wheels
        self.cranks, self.idlers = keys.orientation == "cranks", keys.orientation == "idlers"
        # heights of what others are fixed to
        self.low = {"body": self.s["z_floor"] - self.s["h_floor"]}

    def all(self) -> Expansion:
        """All of it."""
        self._body()
        self._outer_disk()
        self._ring()
        self._inner_disk()
        turning = {"cranks": self._ring_between_cranks, "thesis": self._satellite, "idlers": self._idlers}
        turning[self.keys.orientation]()
        self._platform()
        self._worms()
        self.drive(self.keys, disk_2="turns_of_disk", ring="turns_of_ring")
        inwards = self.s["r_small"] - self.s["r_3"] - self.keys.ball / 2 - _PLAY
        self.order(self.keys.orientation, inwards={"outwards": inwards, "one_hole": True},
                   outwards={"outwards": self.keys.ball}, opened={"opened": _SNAP})  # fmt: skip
        self.name_all()
        return self.found

    def name_all(self) -> None:
        """Position, titles, designation or standard and material of every part."""
        told = words(self.keys.names)
        for name, table in self.found.parts.items():
            # standard items with "_down" and "_up" are the same, laid the other way round
            known = self.names.get(name) or self.names[re.sub("_(down|up)$", "", name)]
            position, number = int(known.position), known.standard
            if number:
                table["standard"] = told.text(_STANDARD, number=number)
            else:
                table["designation"] = told.text(_DESIGNATION, number=f"{position:02}")
            table |= {"material": known.material, "colour": known.colour, "position": position,
                      "title": known.title}  # fmt: skip
        self.found.name_instances(NAMES["power_module, instances"])

    def put(self, kind: str, first: str, second: str, part: str = "", **keys: object) -> None:
        """An instance by its first mate, in the sub-assembly that grows."""
        self._made(part or second)
        super().put(kind, first, second, part, **keys)
        self.found.instances[second]["subassembly"] = self.within

    def _set(self, first: str, part: str, z: float, at: complex = 0j, name: str = "", **more: object) -> None:
        """An instance or a group of them (``count``), one body with another; ``z``: its lower face."""
        name = name or part
        self._made(part)
        self.found.instances[name] = {"part": part, "subassembly": self.within, **more}
        self.low[name] = z
        self.mate("fixed", first, name, offset=place(at, z - self.low[first]))

    def _circle(
        self, first: str, name: str, part: str, count: int, radius: float, z: float, start: float = 0.0
    ) -> None:
        """A group on a circle about the axis of what it is fixed to; ``start``: its first one, degrees."""
        self._set(first, part, z, cmath.rect(radius, math.radians(start)), name, count=count)

    def _turned(self, name: str, points: Sequence[Sequence[float]], *holes: Table) -> str:
        """A turned part: r, z and the arc to the next point, z above its own lower face; its name."""
        rows = [dict(zip(("r", "z", "arc"), (round(x, 6) for x in row), strict=False)) for row in points]
        table: Table = {"kind": "turned", "points": rows}
        self.found.parts[name] = table | ({"holes": list(holes)} if holes else {})
        return name

    def _made(self, *names: str) -> None:
        """Parts of the table of what is turned, where they are needed first: files have all in the order of making."""
        for name in names:
            if name in _BODIES and name not in self.found.parts:
                *told, own = _BODIES[name]
                known = _SHAPES | self.s | {key: valued(made_of, self.s) for key, made_of in own.items()}
                points, holes = (listed(made_of, known) for made_of in told)
                self._turned(name, points, *(holes_on(int(count), *where) for count, *where in holes))

    def _layers(self, name: str, layers: Sequence[tuple[float, Table]]) -> str:
        """A part of layers: thickness and contours of each; what is of no thickness is left out; its name."""
        rows = [{"thickness": round(thick, 6), **table} for thick, table in layers if thick > 1e-9]
        self.found.parts[name] = {"kind": "layered", "layers": rows}
        return name

    # -- what stands still

    def _body(self) -> None:
        s, keys = self.s, self.keys
        self.within = "housing"
        self.found.instances["body"] = {
            "part": "body", "at": [0.0, 0.0, round(self.low["body"], 6)], "held": True, "subassembly": self.within,
        }  # fmt: skip
        self._layers("body", self._casting())
        # the guide about the balls of disk 2 closes the opening of the lip, its screws in that
        self._set("body", "guide_6", 0.0)
        self._circle("body", "guide_6_screw", "screw_51", _GUIDE_SCREWS, s["r_6_screws"], s["h_5"] - 16)
        # what holds the central wheel
        self._set("body", "spacer_18", s["z_boss"])
        if self.cranks:
            self._body_plate()
        elif self.idlers:
            self._post()
        else:
            self._wheel("central_wheel", keys.wheel_width, 2 * _AXLE, holes=holes_on(6, M8[0], s["r_54"]))
            self._set("body", "central_wheel", s["z_16"])
        self._circle("body", "central_screw", "screw_54", 6, s["r_54"], s["z_boss"] + s["h_18"] + s["h_54"] - 75)
        # to the bed
        self._hex("bolt_42", 12, 45, _HEX_12[:2])
        self._layers("nut_44", [(_HEX_12[2], {"polygons": [_hexagon(_HEX_12[0])], "circles": [_round(12)]})])
        out = s["half"] + 20
        for k, at in enumerate(_around(out), 1):
            self._set("body", "bolt_42", s["z_floor"] - 45, at, name=f"bolt_42_{k}")
            self._set("body", "nut_44", self.low["body"] - _HEX_12[2], at, name=f"nut_44_{k}")

    def _casting(self) -> list[tuple[float, Table]]:
        """The body's layers from the flange to the lip."""
        s = self.s
        top = s["h_5"] - _FLANGE
        levels = {self.low["body"], s["z_floor"], s["z_boss"], s["z_lip"]}
        levels |= {top - _DEEP, top}
        seats = [seat for worm in (1, 2) for seat in self._seats(worm)]
        for _, _, bottom, above, cap in seats:
            levels |= {bottom, above, cap}
        levels |= {s[f"z_{worm}"] + side * s["h_window"] for worm in (1, 2) for side in (-1, 1)}
        found = []
        for low, high in pairwise(sorted(levels)):
            circles: list[Table] = []
            polygons: list[Table] = [_square(s["half"])]
            if high <= s["z_floor"]:
                polygons = [_square(s["half"] + 40)]
                circles += [_round(M12[0], at) for at in _around(s["half"] + 20)]
            elif high <= s["z_lip"]:
                polygons = self._wall((low + high) / 2)
                if high <= s["z_boss"]:
                    circles.append(_round(s["arm"] + 6))
                    circles += [_round(8, at) for at in on_circle(6, s["r_54"])]
                for rows in seats:
                    polygons += _seat_at(rows, (low + high) / 2)
            else:
                circles.append(_round(2 * s["r_open"]))
                if high > top - _DEEP:
                    circles += [_round(8, at) for at in on_circle(_GUIDE_SCREWS, s["r_6_screws"])]
            # set screws: of worm I from the front, of worm II, which lies under wheel 25, through the floor
            if low >= s["z_1"] + s["h_seat"]:
                circles += [_round(8, at) for at in self._set_screws(1)]
            if high <= s["z_2"] - s["h_seat"]:
                circles += [_round(8, at) for at in self._set_screws(2)]
            found.append((high - low, {"polygons": polygons, "circles": circles}))
        return found

    def _wall(self, z: float) -> list[Table]:
        """The walls at a height, opened where worms come in: worm I on the right, II on the left."""
        s = self.s
        opened = [abs(z - s[f"z_{worm}"]) < s["h_window"] for worm in (1, 2)]
        if not any(opened):
            return [_square(s["half"]), _square(s["half_room"])]
        out, room = s["half"] - _STEP, s["half_room"] + _STEP
        right, left = (complex(side * s[f"a_{worm}"], s["h_window"]) for worm, side in ((1, 1), (2, -1)))
        # from the opening on the right over the back to that on the left, and on
        upper = [(out, right.real + right.imag), (out, out), (-out, out)]
        upper_in = [(-room, room), (room, room), (room, right.real + right.imag)]
        lower = [(-out, -out), (out, -out), (out, right.real - right.imag)]
        lower_in = [(room, right.real - right.imag), (room, -room), (-room, -room)]
        if not opened[1]:
            return [_corners([*upper, *lower, *lower_in, *upper_in])]
        ends = [[(x, left.real + side * left.imag) for x in (-out, -room)] for side in (1, -1)]
        if not opened[0]:
            return [
                _corners([*ends[1][:1], *lower[:2], *upper[1:], *ends[0], *upper_in[:2], *lower_in[1:], *ends[1][1:]])
            ]
        return [_corners([*upper, *ends[0], *upper_in]), _corners([*ends[1][:1], *lower, *lower_in, *ends[1][1:]])]

    def _cap(self, worm: int) -> float:
        """Top of the seat of a worm's cover."""
        return self.s["z_lip"] if worm == 1 else self.s["z_2"] + self.s["h_seat"] + 8

    def _seats(self, worm: int) -> list[tuple[complex, complex, float, float, float]]:
        """Both blocks that a worm runs in: half their tunnels and outsides as corners, bottom, top and cap of it."""
        s, side, z = self.s, 1 if worm == 1 else -1, self.s[f"z_{worm}"]
        found = []
        for far, (begin, half) in enumerate(((s["x_seat"], s["h_seat"]), (s["x_end"], s["r_worm_journal"] + _PLAY))):
            wide = s["w_seat"] - 5 * far
            way = side * (1 - 2 * far)
            x = sorted((way * begin, way * (begin + wide)))
            centre = side * s[f"a_{worm}"]
            cap = z + half + 8 if far else self._cap(worm)
            found.append((complex(*x), complex(centre, half), z - half, z + half, cap))
        return found

    def _set_screws(self, worm: int) -> list[complex]:
        """Holes over a cover, or under it."""
        s, side = self.s, 1 if worm == 1 else -1
        return [complex(side * (s["x_seat"] + x), side * s[f"a_{worm}"]) for x in (6, 16)]

    # -- what turns with disk 2

    def _outer_disk(self) -> None:
        s, keys = self.s, self.keys
        self.within = "outer_disk_unit"
        t, arm = keys.disk_thickness, s["arm"]
        seat = 2 * s["r_33_out"]
        behind = [_round(8, at) for at in on_circle(12, s["r_53"])]
        front = [_round(4, at) for at in on_circle(16, s["r_53"], 11.25)]
        own = [_round(4, at + arm) for at in on_circle(16, s["r_8"])]
        # out of the bore a hole through which both rows come in; the first screw of either ring 33 holds its plug
        clips = [_round(4, at + arm) for at in on_circle(12, s["r_59"])[1:]]
        bore = _radial(s["r_32"], s["r_59"], s["w_32"] / 2, arm)
        # the flange under the balls of the body, through which the screws of guide 5 go
        edge, rest = _round(2 * s["r_2"]), [_round(2 * s["r_5"])]
        rest += [_round(M8[0], at) for at in on_circle(_RACE_SCREWS, s["r_41"], _RACE_START)]
        low, high, thread, race = s["seat_33"], t - s["seat_33"], s["h_thread"], s["z_race"]
        levels = sorted({0.0, low, thread, high, t, race})
        self._layers("disk_2", [
            (end - start, {"circles": [
                *(rest if end <= race else [edge]), *([] if low <= start and end <= high else [_round(seat, arm)]),
                *(behind if end <= thread else front), *(clips if low <= start and end <= high else []),
                *(own if thread <= start else []),
            ], "outlines": [bore] if low <= start and end <= high else []}) for start, end in pairwise(levels)
        ])  # fmt: skip
        self.low["disk_2"] = 0.0
        self.put("coaxial", "body", "disk_2", height=round(-self.low["body"], 6))
        # shields
        self._set("disk_2", "shield_7", t)
        self._set("disk_2", "shield_8", t, arm)
        tip = t + s["h_shield"] - 6
        self._made("screw_59", "screw_59_down")
        self._circle("disk_2", "shield_7_screw", "screw_59", 16, s["r_53"], tip, 11.25)
        self._circle("shield_8", "shield_8_screw", "screw_59", 16, s["r_8"], tip)
        self._balls()
        self._ring_24()

    def _balls(self) -> None:
        """The rings that hold the balls of disk 3, those balls, and the row under the body."""
        s, t, arm = self.s, self.keys.disk_thickness, self.s["arm"]
        rear, fore = s["seat_33"] - s["h_33"], t - s["seat_33"]
        self._set("disk_2", "protective_ring", fore, arm, name="protective_ring_1")
        self._set("disk_2", "protective_ring", rear, arm, name="protective_ring_2")
        self._layers("plug", [(s["h_32"], {
            "outlines": [_radial(s["r_32"] + s["gap_32"], s["r_59"], s["w_32"] / 2 - _PLAY, -s["r_59"], beyond=True)],
            "circles": [_round(4)],
        })])  # fmt: skip
        for k, z in enumerate((t - s["seat_33"] - s["h_32"], s["seat_33"]), 1):
            self._set("disk_2", "plug", z, complex(arm + s["r_59"]), name=f"plug_{k}")
        self._circle("protective_ring_1", "front_clip", "screw_59", 12, s["r_59"], fore + s["h_33"] - 6)
        self._circle("protective_ring_2", "rear_clip", "screw_59_down", 12, s["r_59"], rear - M4[2])
        self._made("ball")
        self._cage("small_cage", s["r_small"], int(s["small_balls"]))
        for k, z in enumerate((s["z_upper"], s["z_lower"]), 1):
            self._row("disk_2", "small", k, z, arm)
        self._cage("large_cage", s["r_large"], int(s["large_balls"]))
        self._row("disk_2", "large", 1, s["z_ball"])

    def _ring_24(self) -> None:
        """Ring 24 with the worm wheel and the outer races."""
        s, h, wide = self.s, self.s["h_24"], self.keys.worm_wheel_width
        edges, through = [_round(2 * s["r_24"]), _round(2 * s["r_24_in"])], on_circle(12, s["r_53"])
        passing = [_round(M8[0], at) for at in through]
        bolts = [_round(8, at) for at in on_circle(24, s["r_41"])]
        guides = [_round(8, at) for at in on_circle(_RACE_SCREWS, s["r_41"], _RACE_START)]
        self._set("disk_2", self._layers("spacer_24", [
            (40 - wide + 1, {"circles": [*edges, *passing, *bolts]}),
            (h - (40 - wide + 1) - (25 - s["h_5"] + 1), {"circles": [*edges, *passing]}),
            (25 - s["h_5"] + 1, {"circles": [*edges, *passing, *guides]}),
        ]), -h)  # fmt: skip
        self._made("screw_53", "screw_53_down")
        self._circle("disk_2", "spacer_24_screw", "screw_53_down", 12, s["r_53"], -h - M8[2])
        self._set("disk_2", "guide_5", s["z_race"])
        self._circle("disk_2", "guide_5_screw", "screw_52", _RACE_SCREWS, s["r_41"], s["h_5"] - 25, _RACE_START)
        self._worm_wheel("worm_wheel_25", 0, s["r_25_in"], [
            holes_on(24, M8[0], s["r_41"]), holes_on(24, 8, s["r_20_screws"]),
        ])  # fmt: skip
        self._set("disk_2", "worm_wheel_25", -h - wide)
        self._hex("bolt_41", 8, 40, _HEX_8, down=True)
        self._circle("disk_2", "worm_wheel_25_bolt", "bolt_41", 24, s["r_41"], -h - wide - _HEX_8[1])
        high = s["h_20"]
        for k, z in enumerate((s["z_20"], s["z_20"] - high), 1):
            self._set("disk_2", "bearing_ring", z, name=f"bearing_ring_{k}")
        self._circle("disk_2", "bearing_screw", "screw_53_down", 24, s["r_20_screws"], s["z_20"] - high - M8[2])

    # -- what turns with wheel 21

    def _ring(self) -> None:
        s, keys = self.s, self.keys
        self.within = "ring_unit"
        self.part(
            "ring", kind="ring_gear", module=keys.module, number_of_teeth=keys.teeth[1], face_width=keys.face_width,
            outer_diameter=2 * s["r_21"], holes=holes_on(12, M8[0], s["r_21_screws"]),
        )  # fmt: skip
        z = -s["h_24"]
        self.low["ring"] = z
        self.put("coaxial", "body", "ring", height=round(z - self.low["body"], 6))
        self._set("ring", "spacer_22", s["z_23"] + keys.worm_wheel_width)
        self._circle("ring", "ring_screw", "screw_53", 12, s["r_21_screws"], z + keys.face_width - 45)
        self._row("ring", "large", 2, s["z_20"])
        self._worm_wheel("worm_wheel_23", 1, s["r_22_in"], [holes_on(12, M8[0], s["r_21_screws"])])
        self._set("ring", "worm_wheel_23", s["z_23"])
        self._circle("ring", "worm_wheel_23_screw", "screw_53_down", 12, s["r_21_screws"], s["z_23"] - M8[2])

    # -- what turns with disk 3

    def _inner_disk(self) -> None:
        s, keys = self.s, self.keys
        self.within = "inner_disk_unit"
        t, arm = keys.disk_thickness, s["arm"]
        bore = 2 * (s["r_journal"] + keys.clearance)
        third = holes_on(1, bore, arm)
        self.part(
            "pinion", kind="spur_gear", module=keys.module, number_of_teeth=keys.teeth[0], face_width=keys.face_width,
            bore_diameter=20.0, holes=[third, holes_on(6, 12, s["r_56"], 30.0), *(
                holes_on(1, 8, abs(at), math.degrees(cmath.phase(at))) for at in _about(arm, s["r_journal"] + 16)
            )],
        )  # fmt: skip
        z = -s["h_24"]
        self._moving("carried", "disk_2", "pinion", "", complex(arm), z)
        self.mate("internal_gear_pair", "ring", "pinion")
        self._set("pinion", "sleeve_17", z + keys.face_width)
        self._set("pinion", "disk_3", 0.5)
        self._circle("pinion", "disk_3_screw", "screw_56", 6, s["r_56"], t - 0.5 - _RECESS - 35, 30.0)
        self._set("pinion", "cover_12", z - s["h_12"], complex(arm))
        self._circle("cover_12", "cover_12_screw", "screw_51_down", 4, s["r_journal"] + 16, z - s["h_12"] - M8[2], 45)

    # -- what turns the platform: the wheels of the thesis

    def _satellite(self) -> None:
        """The axle 13, and what holds wheel 14 on it."""
        s, keys = self.s, self.keys
        self._satellite_axle(s["z_16"], s["z_11"] + keys.wheel_width)
        self._wheel("satellite_wheel", s["h_14"], 2 * (_AXLE + keys.clearance))
        self.put("external_gear_pair", "central_wheel", "satellite_wheel")
        self.mate("carried", "disk_2", "satellite_wheel")

    def _satellite_axle(self, low: float, high: float) -> None:
        """The axle 13 of what turns between two heights, clamped to the pinion by nut 46."""
        keys, z = self.keys, -self.s["h_24"]
        end, collar = low - keys.clearance, high + keys.clearance
        self._set("pinion", self._turned("satellite_axle", [
            (7.0, 0.0), (10.0, 0.0), (10.0, collar - end), (15.0, collar - end), (15.0, z - end), (10.0, z - end),
            (10.0, z + keys.face_width + 10 - end), (0.0, z + keys.face_width + 10 - end), (0.0, 17.0), (7.0, 17.0),
        ]), end)  # fmt: skip
        self._nut_46()
        self._set("pinion", "spacer_15", end - 5)
        self._set("pinion", "screw_57", end - 5 - 14)

    def _platform_wheel(self) -> None:
        """Wheel 11, in mesh with wheel 14, or with the idler between."""
        keys, mesh = self.keys, "external_gear_pair"
        self._wheel("platform_wheel", keys.wheel_width, 2 * (self.s["r_end"] if self.idlers else _THREAD_47))
        self._on_axle("platform_wheel", self.s["z_11"])
        if not self.idlers:
            self.mate(mesh, "satellite_wheel", "platform_wheel")
            return
        self._idler(2, "platform_wheel", "pinion", direction_deg=180.0)
        self.mate(mesh, "satellite_wheel", "idler_2")

    def _on_axle(self, name: str, z: float) -> None:
        """What turns with the platform, about O3."""
        self._moving("carried", "pinion", name, name, complex(self.s["arm"]), z)

    def _nut_46(self) -> None:
        """On what is clamped to the pinion in its middle."""
        self._set("pinion", "nut_46", self.keys.face_width - self.s["h_24"])

    # -- what keeps it parallel: an idler on each arm

    def _post(self) -> None:
        """What holds wheel 16 over the link of arm O1O2."""
        s, keys = self.s, self.keys
        self._set("body", "post", s["z_39"])
        self._wheel("central_wheel", keys.wheel_width, 2 * s["r_end"])
        self._set("post", "central_wheel", s["z_16"])

    def _idlers(self) -> None:
        """Axle 13 with wheel 14 between both links, and the idler of arm O1O2."""
        s, keys = self.s, self.keys
        self._satellite_axle(s["z_38_rear"], s["z_38"] + s["h_38"])
        teeth = round(s["arm"] / keys.wheel_module / 3)
        self.part("idler", kind="spur_gear", module=keys.wheel_module, number_of_teeth=teeth,
                  profile_shift_coefficient=IDLER_SHIFT, bore_diameter=2 * (s["r_37"] + keys.clearance),
                  face_width=keys.wheel_width)  # fmt: skip
        turning = 2 * (s["r_neck"] + keys.clearance)
        self._made("idler_pin", "idler_pin_down")
        self._set("disk_2", self._layers("link", [(s["h_38"], {
            "slots": [{"start": [0.0, 0.0], "end": [s["arm"], 0.0], "width": 2 * s["r_38"]}],
            "circles": [_round(turning), _round(2 * s["r_37"], s["arm"] / 2), _round(turning, s["arm"])],
        })]), s["z_38_rear"], name="link_1")  # fmt: skip
        self._set("link_1", "idler_pin", s["z_38_rear"], complex(s["arm"] / 2), name="idler_pin_1")
        self._idler(1, "central_wheel", "disk_2")
        self._wheel("satellite_wheel", s["h_14"], 2 * (_AXLE + keys.clearance))
        self.put("external_gear_pair", "idler_1", "satellite_wheel")
        self.mate("carried", "disk_2", "satellite_wheel")
        self._set("pinion", "link", s["z_38"], name="link_2")
        low = s["z_11"] - s["play_36"] - s["h_37"]
        self._set("pinion", "idler_pin_down", low, complex(s["arm"] / 2), name="idler_pin_2")

    def _idler(self, number: int, wheel: str, holder: str, **more: object) -> None:
        """In mesh with a wheel, carried by the disk whose arm it stands on."""
        self.put("external_gear_pair", wheel, f"idler_{number}", "idler", **more)
        self.mate("carried", holder, f"idler_{number}")

    # -- what keeps it parallel: cranks

    def _moving(self, kind: str, first: str, instance: str, part: str, at: complex, z: float) -> None:
        """An instance that turns for itself or with another, its axis carried; ``z``: its lower face."""
        self.low[instance] = z
        self.put(kind, first, instance, part, offset=place(at, z - self.low[first]))

    def _pins(self, first: str, z: float, start: float, *, behind: bool = False) -> None:
        """Three pins pressed into a plate, before or behind its face at a height, their collars on that."""
        low = z - self.keys.wheel_width - (self.s["h_collar"] if behind else 0.0)
        self._circle(first, f"{first}_pin{'_rear' * behind}", "crank_pin", 3, self.s["r_pivots"], low, start)

    def _pivots(self, start: float) -> list[complex]:
        return on_circle(3, self.s["r_pivots"], start)

    def _body_plate(self) -> None:
        """Plate 16 with the pins of the first cranks; pins and cranks of both planes are alike."""
        s, keys = self.s, self.keys
        self._set("body", "body_plate", s["z_16"])
        self._pins("body_plate", s["z_16"] + keys.wheel_width, 0.0)
        turning = 2 * (s["r_35"] + keys.clearance)
        self._layers("crank", [(keys.wheel_width, {
            "slots": [{"start": [0.0, 0.0], "end": [s["arm"], 0.0], "width": 2 * s["r_34"]}],
            "circles": [_round(turning), _round(turning, s["arm"])],
        })])  # fmt: skip

    def _ring_between_cranks(self) -> None:
        """Guide 13 on the pinion, ring 14 in it, the first cranks behind it and the second before it."""
        s, low = self.s, self.s["z_14"]
        self._set("pinion", "ring_guide", low)
        self._nut_46()
        self.within = "platform_unit"
        self._moving("carried", "disk_2", "free_ring", "free_ring", complex(s["arm"]), low)
        self.mate("parallel", "body", "free_ring")
        self._pins("free_ring", low, 0.0, behind=True)
        self._pins("free_ring", low + self.keys.wheel_width, 60.0)
        for k, at in enumerate(self._pivots(0.0), 1):
            self._moving("parallel", "disk_2", f"first_crank_{k}", "crank", at, s["z_34_rear"])
        for k, at in enumerate(self._pivots(60.0), 1):
            self._moving("parallel", "pinion", f"second_crank_{k}", "crank", at, s["z_34"])
            self.mate("carried", "free_ring", f"second_crank_{k}")

    def _platform_plate(self) -> None:
        """Plate 11 about nut 47, as parallel as the ring."""
        low = self.s["z_11"] + self.keys.wheel_width - self.s["h_11"]
        self._on_axle("platform_plate", low)
        self.mate("parallel", "free_ring", "platform_plate")
        self._pins("platform_plate", low, 60.0, behind=True)

    def _platform(self) -> None:
        s, keys = self.s, self.keys
        self.within = "platform_unit"
        (self._platform_plate if self.cranks else self._platform_wheel)()
        first = "platform_plate" if self.cranks else "platform_wheel"
        end, r, clamped = s["z_47"] - 2, s["r_journal"], s["z_47"] + s["h_47"] + (not self.idlers) * keys.wheel_width
        # with idlers a neck for their link goes on below the thread, and wheel 11 on its end
        neck = [(0.0, end)]
        if self.idlers:
            step, end = s["z_11"] + keys.wheel_width, s["z_11"]
            wheel = [(s["r_end"], end), (s["r_end"], step)]
            neck = [(0.0, end), *wheel, (s["r_neck"], step), (s["r_neck"], s["z_47"] - 2)]
        shoulder, flange = clamped - end, s["z_flange"] - end
        self._set(first, self._turned("platform_axle", [
            *((radius, z - end) for radius, z in neck), (_THREAD_47, s["z_47"] - 2 - end), (_THREAD_47, shoulder),
            (r, shoulder), (r, flange), (s["r_55"] + 10, flange),
            (s["r_55"] + 10, flange + 12), (r, flange + 12), (r, flange + 18), (0, flange + 18),
        ], holes_on(6, 10, s["r_55"])), end)  # fmt: skip
        self._set(first, "nut_47", s["z_47"])
        top = -s["h_24"] - 1
        self._set(first, self._turned("spacer_10", _tube(r, r + 6, top - clamped)), clamped)
        half = keys.platform_size / 2
        side, screws = _square(half, 10.0), on_circle(6, s["r_55"])
        sunk = M10[2] + 1
        hold = s["h_4"] - sunk
        self._set(first, self._layers("platform", [
            (hold, {"polygons": [side], "circles": [_round(2 * r), *(_round(M10[0], at) for at in screws)]}),
            (sunk, {"polygons": [side], "circles": [_round(2 * r), *(_round(M10[1] + 1, at) for at in screws)]}),
        ]), s["z_4"])  # fmt: skip
        self._circle(first, "platform_screw", "screw_55", 6, s["r_55"], s["z_4"] + hold - 30)

    # -- worms

    def _worms(self) -> None:
        s, keys = self.s, self.keys
        r, start = s["r_worm_journal"], keys.worm_length / 2
        cover, flange = s["x_seat"], 8.0
        out = cover + s["w_seat"] + flange
        steps = [(r, out + 0.2 - start), (r - _SNAP, 2.0), (r, 5.0), (r - 4, 40.0)]
        self.part(
            "worm", kind="worm", module=keys.worm_module, diameter_quotient=keys.worm_quotient,
            thread_length=keys.worm_length,
            shaft_above=[{"diameter": 2 * radius, "length": round(length, 6)} for radius, length in steps],
            shaft_below=[{"diameter": 2 * r, "length": round(s["x_end"] + s["w_seat"] - 5 + 2 - start, 6)}],
        )  # fmt: skip
        for worm, wheel, direction in ((1, "worm_wheel_25", 90.0), (2, "worm_wheel_23", -90.0)):
            self.within = f"worm_{worm}_unit"
            self.put("worm_pair", wheel, f"worm_{worm}", "worm", direction_deg=direction)
            way = 1 if worm == 1 else -1
            for part, x in (("end_cover", cover), ("spacer_28", start + 1), ("snap_ring", out + 0.3)):
                self._made(part)
                self.found.instances[f"{part}_{worm}"] = {
                    "part": part, "at": [round(way * x, 6), round(way * s[f"a_{worm}"], 6), round(s[f"z_{worm}"], 6)],
                    "axis": [float(way), 0.0, 0.0], "held": True, "subassembly": self.within,
                }  # fmt: skip
            low = s["z_1"] + s["h_seat"] if worm == 1 else s["z_2"] - s["h_seat"] - 12
            for k, at in enumerate(self._set_screws(worm), 1):
                self._set("body", f"screw_49{'_up' * (worm == 2)}", low, at, name=f"set_screw_{worm}_{k}")

    # -- bodies

    def _wheel(self, name: str, width: float, bore: float, **more: object) -> None:
        """A wheel that spans an arm with its like, or with an idler between."""
        teeth = round(self.s["arm"] / self.keys.wheel_module * (2 / 3 if self.idlers else 1))
        shift = {"profile_shift_coefficient": -IDLER_SHIFT} if self.idlers else {}
        self.part(name, kind="spur_gear", module=self.keys.wheel_module, number_of_teeth=teeth, bore_diameter=bore,
                  face_width=width, **shift, **more)  # fmt: skip

    def _worm_wheel(self, name: str, which: int, bore: float, holes: list[Table]) -> None:
        keys = self.keys
        self.part(
            name, kind="worm_wheel", module=keys.worm_module, number_of_teeth=keys.worm_teeth[which],
            diameter_quotient=keys.worm_quotient, face_width=keys.worm_wheel_width, bore_diameter=2 * bore,
            outer_diameter=2 * self.s["r_25" if which == 0 else "r_23"], holes=holes,
        )  # fmt: skip

    def _hex(self, name: str, diameter: float, length: float, head: tuple[float, float], *, down: bool = False) -> None:
        """A bolt with a hexagonal head, its tip below; ``down``: its head below."""
        layers: list[tuple[float, Table]] = [
            (length, {"circles": [_round(diameter)]}), (head[1], {"polygons": [_hexagon(head[0])]}),
        ]  # fmt: skip
        self._layers(name, layers[::-1] if down else layers)

    def _cage(self, name: str, radius: float, count: int) -> None:
        """A ring under the balls, and between two of them two posts, or one where they are near each other."""
        ball = self.keys.ball
        half, low = 0.1 * ball, 0.175 * ball
        pitch = 2 * math.pi * radius / count
        # along the circle from the middle of a ball: where a post begins and ends, short of that before the next
        begin, stop = 0.63 * ball, min(1.05 * ball, pitch / 2 - 0.1 * ball)
        along = [(begin, stop), (-begin, -stop)]
        if stop - begin < half:
            along = [(0.62 * ball, pitch - 0.62 * ball)]
        posts = []
        for turn, ends in ((2 * math.pi * k / count, row) for k in range(count) for row in along):
            start, end = ([round(x, 9) for x in _pair(cmath.rect(radius, turn + x / radius))] for x in ends)
            posts.append({"start": start, "end": end, "width": 1.4 * half})
        edges = [_round(2 * (radius + half)), _round(2 * (radius - half))]
        self._layers(name, [(low, {"circles": edges}), (0.65 * ball, {"slots": posts})])

    def _row(self, first: str, size: str, number: int, z: float, at: float = 0.0) -> None:
        """A cage with its balls, their middles at a height."""
        name, ball = f"{size}_cage_{number}", self.keys.ball
        self._set(first, f"{size}_cage", z - 0.7 * ball, complex(at), name=name)
        self._circle(
            name, f"{size}_ball_{number}", "ball", int(self.s[f"{size}_balls"]), self.s[f"r_{size}"], z - ball / 2
        )


POWER_MODULE = Recipe(PowerModuleKeys, lambda keys: _Making(keys).all())


def _pair(at: complex) -> list[float]:
    return [round(at.real, 9), round(at.imag, 9)]


def _round(diameter: float, at: complex = 0j) -> Table:
    """A circle of a layer."""
    return {"diameter": diameter, "at": _pair(complex(at))}


def _square(half: float, corner: float = 0.0) -> Table:
    return {"points": [[-half, -half], [half, -half], [half, half], [-half, half]], "corner_radius": corner}


def _corners(points: Sequence[tuple[float, float]]) -> Table:
    """A polygon of a layer."""
    return {"points": [[round(x, 6), round(y, 6)] for x, y in points]}


def _radial(inner: float, centre: float, half: float, axis: float, *, beyond: bool = False) -> Table:
    """The circle about an axis on x with a rounded slot out of it, ``half`` as wide, about a place so far from the
    axis; ``beyond``: only what of the slot lies outside of the circle.
    """
    mouth = math.sqrt(inner**2 - half**2)
    arcs = [(mouth, -half, 0.0), (centre, -half, half), (centre + half, 0.0, half), (centre, half, 0.0)]
    arcs += [(mouth, half, -inner)] if beyond else [(mouth, half, inner), (-inner, 0.0, inner)]
    return {"points": [
        {"x": round(axis + x, 9), "y": round(y, 9), "arc": round(arc, 9)} for x, y, arc in arcs
    ]}  # fmt: skip


def _hexagon(across: float) -> Table:
    return {"points": [_pair(cmath.rect(across / math.sqrt(3), math.pi * k / 3)) for k in range(6)]}


def _about(arm: float, radius: float) -> list[complex]:
    """Four places about the axis O3."""
    return [arm + at for at in on_circle(4, radius, 45.0)]


def _around(half: float) -> list[complex]:
    """Corners and middles of a square."""
    return [complex(x * half, y * half) for x in (-1, 0, 1) for y in (-1, 0, 1) if x or y]


def _tube(inner: float, outer: float, height: float) -> list[tuple[float, float]]:
    return [(inner, 0), (outer, 0), (outer, height), (inner, height)]


def _screw(diameter: float, length: float, wide: float, high: float) -> list[tuple[float, float]]:
    """Shank and round head, its tip below."""
    shank, top = diameter / 2, length + high
    return [(0.0, 0.0), (shank, 0.0), (shank, length), (wide / 2, length), (wide / 2, top), (0.0, top)]


def _turned_over(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    return [(r, points[-1][1] - z) for r, z in points]


# what the table of bodies is made of beside the module's sizes
_SHAPES: dict[str, object] = {
    "tube": _tube, "screw": _screw, "turned_over": _turned_over, "flange": _FLANGE, "guide_screws": _GUIDE_SCREWS,
    "race_screws": _RACE_SCREWS, "race_start": _RACE_START, "recess": _RECESS, "thread": _THREAD_47, "play": _PLAY,
    "snap": _SNAP,
}  # fmt: skip


def _seat_at(seat: tuple[complex, complex, float, float, float], z: float) -> list[Table]:
    """What of a worm's seat stands at a height: the block, its two sides, its cap."""
    x, y, bottom, top, cap = seat
    if z > cap:
        return []
    centre, half = y.real, y.imag
    out = half + 8
    if not bottom < z < top:
        return [_box((x.real, x.imag), (centre - out, centre + out))]
    inset = (x.real + _STEP, x.imag - _STEP)
    return [
        _box(inset, (centre - out + _STEP, centre - half)),
        _box(inset, (centre + half, centre + out - _STEP)),
    ]


def _box(x: tuple[float, float], y: tuple[float, float]) -> Table:
    return {"points": [[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]]}

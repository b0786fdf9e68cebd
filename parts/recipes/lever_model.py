"""The assembly ``lever_model``: a plane lever mechanism out of flat links and dowels, to be cut and turned by hand.

From the back, in boards: hand crank; frame; crank, glued to the axle that the hand crank turns; over it the rod, or at
once the lever in whose slot the crank's pin runs; the lever; the second rod; its rocker. Each link lies on the one
before it, at its own axle on spacers as high. The pins are glued into one of both links and turn in the other; those of
sliders go down to slots of the frame, in washers; where the links below leave them no way there, up to the slot of a
bridge, which stands over all links on two pillars. Caps on the free ends of dowels hold the links, wherever there is
room for them. Links of one layer are held apart all the way round.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import combinations, count
from typing import TYPE_CHECKING, Annotated

import numpy as np
from msgspec import Meta, convert, field

from geometry.base.errors import LateError, ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import Draft, Record, replace
from parts.base.fields import given_keys
from parts.base.schema import tried, value_at
from parts.keys.base import degrees, mm, start
from parts.keys.levers import (
    MECHANISM,
    Assignment,
    Code,
    MechanismTable,
    Variant,
    levers_of,
    scaled,
    turning_levers,
)
from parts.mates.pages.lever_tasks import chosen
from parts.recipes.making import WAYS, Making, check_play, hole, place
from parts.recipes.recipe import Expansion, ModelKeys, Recipe, Table, Turns

if TYPE_CHECKING:
    from geometry.curves.curve import Complex, Real
    from geometry.kinematics.levers import Slider

# mm: walls about and between holes; between what moves in one layer; of slots beyond the way of a pin; how much shorter
# dowels are than what they go through; of the frame about its axles and slots; its corners; rings about dowels; the
# handle of the hand crank
_WALL, _APART, _SLACK, _SHORT, _BESIDE, _CORNER, _RING, _GRIP = 2.0, 1.0, 1.0, 0.5, 10.0, 6.0, 3.0, 20.0
# length of the hand crank over the width of links
_REACH = 2.5
# by which pillars are moved out until they have room
_STEP = 1.0
# mm within which joints are one
_SAME = 1e-9
# positions of the crank in which links of a layer are held apart
_SAMPLES = 720
# of what is given, tried where it is refused, nearest first: of a width or a scale, of lengths
_SMALLER, _LONGER = (0.9, 0.75, 0.6, 0.45, 0.3, 0.1, 0.03), (1.05, 1.1, 1.25, 1.5, 2.0, 3.0, 4.0, 0.95, 0.9, 0.75)
_CRANK_ROCKER = {
    "first": "rods", "crank_length": 25.0, "frame_length": 80.0, "coupler_length": 70.0, "lever_length": 50.0,
}  # fmt: skip
_CRANK_ANGLE = degrees("where the model is drawn; default: of the assignment, or 0", least=-360, most=360, example=60.0)
_HAND_CRANK = Meta(description="behind the frame, on the axle of the crank; false: the crank turns on a fixed axle")
_CAPS = Meta(description="on the free ends of dowels, where there is room: they keep the links from coming off")
_CLEARANCE = mm("of slots and holes on the dowels that run in them", least=0, most=5)


class LeverModelKeys(ModelKeys, kw_only=True, tag="lever_model"):
    """Keys of ``lever_model``."""

    mechanism: Annotated[MechanismTable, MECHANISM, start(_CRANK_ROCKER)] = field(default_factory=MechanismTable)
    code: Code = None
    assignment: Assignment = None
    variant: Variant = None
    scale: Annotated[float, Meta(ge=0.001, le=10_000, description="lengths of the mechanism over the model's")] = 1.0
    crank_angle_deg: Annotated[float, _CRANK_ANGLE] | None = None
    turns: Annotated[Turns, Meta(description="of the crank")] = 1.0
    link_width: Annotated[float, mm("of all links, their ends are round", above=0, most=1000)] = 12.0
    plate_thickness: Annotated[float, mm("of all flat parts", least=0.5, most=100)] = 3.0
    clearance: Annotated[float, _CLEARANCE] = 0.3
    axle_diameter: Annotated[float, mm("of the dowels in the frame on which links turn", least=0.5, most=200)] = 6.0
    pin_diameter: Annotated[float, mm("of the dowels that join links", least=0.5, most=200)] = 4.0
    hand_crank: Annotated[bool, _HAND_CRANK] = True
    caps: Annotated[bool, _CAPS] = True


class _Link(Draft):
    """A link in its own frame, mm: ``ends`` of its axis, holes (place, diameter, the key of its place), a slot."""

    member: str
    number: str
    layer: int
    label: str
    ends: list[complex]
    holes: list[tuple[complex, float, str]]
    slot: tuple[float, float] | None = None


class _Dowel(Record):
    """A dowel glued into a link (``0``: the frame) at a place of it, from below a layer to above another one.

    ``key``: of the length that has put it there; ``rings``: whether rings lie about it below its upper layer; ``cap``:
    the layer beyond its free end that a cap may have.
    """

    name: str
    link: str
    at: complex
    size: float
    layers: tuple[int, int]
    key: str
    rings: str = ""
    cap: int | None = None

    @property
    def capped(self) -> tuple[int, int]:
        """The layers with that of the cap."""
        cap = self.layers[0] if self.cap is None else self.cap
        return min(*self.layers, cap), max(*self.layers, cap)


class _Solid(Record):
    """What fills layers: a link, rings about a dowel or its cap; by the number of the link on which it stands."""

    name: str
    number: str
    layers: range
    ends: Sequence[complex]
    radius: float
    key: str = ""


class _Making(Making):
    """A model that grows: links and dowels, held against each other."""

    def __init__(self, keys: LeverModelKeys) -> None:
        super().__init__("lever_model", keys.plate_thickness, keys)
        self.keys = keys
        check_play(keys.clearance, keys.pin_diameter, keys.axle_diameter)
        given, *_ = chosen(keys.code, keys.assignment, keys.variant)
        own = {key: value for key, value in given.items() if key in MechanismTable.__struct_fields__}
        self.machine = convert(own | given_keys(keys.mechanism), MechanismTable)
        turning_levers(self.machine)
        self.mechanism = scaled(self.machine, keys.scale)
        self.levers = levers_of(self.mechanism)
        self.start = given.get("start_angle_deg", 0.0) if keys.crank_angle_deg is None else keys.crank_angle_deg
        self.pin_size, self.axle_size = keys.pin_diameter, keys.axle_diameter
        self.links: dict[str, _Link] = {}
        self.dowels: list[_Dowel] = []
        # rings by name, with the link on whose dowel they lie, and their layer
        self.rings: list[tuple[str, str, int]] = []
        # caps alike
        self.caps: list[tuple[str, str, int]] = []
        self.guides: list[tuple[complex, complex]] = []
        # layer and corners of the bridge, holes of its pillars and ends of its slot
        self.bridge: tuple[int, list[complex], list[complex]] | None = None
        self.moving = self._moving()
        self._first()
        self._second()
        self._check_walls()
        self._check_room()
        self.dowels = [*self._capped()]

    def _link(self, name: str, member: str, number: str, layer: int, label: str, *ends: complex) -> _Link:
        link = _Link(member, number, layer, label, [0j, *ends], [])
        self.links[name] = link
        return link

    def _turning(self, link: _Link, pivot: complex, number: int, key: str) -> None:
        """A link on an axle of its own."""
        top = link.layer
        link.holes.append((0j, self.axle_size + self.keys.clearance, key))
        self.dowels.append(_Dowel(f"axle_{number}", "0", pivot, self.axle_size, (0, top), key, "spacer", top + 1))

    def _joint(self, name: str, link: str, at: complex, layers: tuple[int, int], key: str, rings: str = "") -> None:
        """A pin glued into a link; one with rings goes down to the frame, others up to the next link."""
        self.links[link].holes.append((at, self.pin_size, key))
        cap = layers[0] - 1 if rings else layers[1] + 1
        self.dowels.append(_Dowel(f"pin_{name}", link, at, self.pin_size, layers, key, rings, cap))

    def _slider(self, name: str, link: str, at: complex, layer: int, key: str, guide: Slider) -> None:
        """A pin that runs in a slot, of the frame if it finds its way down, and that slot."""
        from geometry.kinematics.levers import travel

        found, way = travel(self.levers, "slider"), cmath.exp(1j * guide.angle)
        ends = [guide.on + reach * way for reach in (found.least - _SLACK, found.greatest + _SLACK)]
        others = [*self._solids()]
        self._joint(name, link, at, (0, layer), key, "washer")
        down = self.dowels[-1]
        if self._has_room(self._about(down, down.rings, range(1, layer)), others):
            self.guides.append((ends[0], ends[1]))
            return
        self.dowels[-1] = replace(down, layers=(layer, layer + 1), rings="", cap=layer + 2)
        pillars = [
            self._pillar(k, end, out, layer, key, others) for k, end, out in ((1, ends[0], -way), (2, ends[1], way))
        ]
        self.bridge = layer + 1, pillars, ends

    def _pillar(self, number: int, end: complex, out: complex, top: int, key: str, others: Sequence[_Solid]) -> complex:
        """One of a bridge over a layer: the first place out from an end of its slot that nothing comes to."""
        wall = (self.pin_size + self.keys.clearance + self.axle_size) / 2 + _WALL
        for k in count():
            at = end + (wall + k * _STEP) * out
            dowel = _Dowel(f"pillar_{number}", "0", at, self.axle_size, (0, top + 1), key, "spacer")
            if self._has_room(self._about(dowel, dowel.rings, range(1, top + 1)), others):
                break
        self.dowels.append(dowel)
        return at

    def _first(self) -> None:
        """The crank, and what its pin joins."""
        from geometry.kinematics.levers import Rods, Slider

        levers, first, loose = self.levers, self.levers.first, self.pin_size + self.keys.clearance
        crank = self._link("crank", "", "1", 1, f"O1A {levers.crank:.6g}", levers.crank)
        if self.keys.hand_crank:
            crank.holes.append((0j, self.axle_size, "mechanism.crank_length"))
            self.dowels.append(_Dowel("axle_1", "crank", 0j, self.axle_size, (-1, 1), "mechanism.crank_length"))
        else:
            self._turning(crank, 0j, 1, "mechanism.crank_length")
        self._joint("a", "crank", levers.crank, (1, 2), "mechanism.crank_length")
        if isinstance(first, Rods | Slider):
            rod = self._link("rod", "rod", "2", 2, f"AB {first.rod:.6g}", first.rod)
            rod.holes.append((0j, loose, "mechanism.coupler_length"))
        if isinstance(first, Slider):
            self._slider("b", "rod", first.rod, 2, "mechanism.coupler_length", first)
        elif isinstance(first, Rods):
            self._joint("b", "rod", first.rod, (2, 3), "mechanism.coupler_length")
            lever = self._link("rocker", "lever", "3", 3, f"O3B {levers.lever:.6g}", levers.lever)
            self._turning(lever, first.pivot, 3, "mechanism.frame_length")
            lever.holes.append((levers.lever, loose, "mechanism.lever_length"))
        else:
            far = abs(first.pivot)
            near, most = abs(far - levers.crank) - _SLACK, far + levers.crank + _SLACK
            lever = self._link("slotted_lever", "lever", "3", 2, f"O3B {levers.lever:.6g}", max(most, levers.lever))
            self._turning(lever, first.pivot, 3, "mechanism.frame_length")
            lever.slot = near, most

    def _second(self) -> None:
        """The second rod, which hangs on the lever, and what it moves."""
        from geometry.kinematics.levers import Rods

        levers, second = self.levers, self.levers.second
        if second is None:
            return
        (name, lever), loose = [*self.links.items()][-1], self.pin_size + self.keys.clearance
        top = lever.layer + 1
        given = "lever_length" if self.mechanism.arm_length is None else "arm_length"
        if lever.slot is None and abs(levers.arm - levers.lever) < _SAME:
            # one pin through both rods and the lever between
            self.dowels[-2] = replace(self.dowels[-2], layers=(2, top), cap=top + 1)
        else:
            lever.ends.append(levers.arm)
            lever.label += f" O3C {abs(levers.arm):.6g}"
            self._joint("c", name, levers.arm, (lever.layer, top), f"mechanism.{given}")
        rod = self._link("second_rod", "second_rod", "4", top, f"CD {second.rod:.6g}", second.rod)
        rod.holes.append((0j, loose, "mechanism.rod_length"))
        if isinstance(second, Rods):
            self._joint("d", "second_rod", second.rod, (top, top + 1), "mechanism.rod_length")
            label = f"O5D {second.rocker:.6g}"
            rocker = self._link("second_rocker", "second_rocker", "5", top + 1, label, second.rocker)
            self._turning(rocker, second.pivot, 5, "mechanism.pivot_distance")
            rocker.holes.append((second.rocker, loose, "mechanism.rocker_length"))
        else:
            self._slider("d", "second_rod", second.rod, top, "mechanism.rod_length", second)

    def _refused(self, code: str, names: Sequence[str], **numbers: object) -> ParameterError:
        """A refusal by the first of some keys that can cure it, sought when somebody asks."""

        def works(name: str, value: float) -> bool:
            _Making(tried(self.keys, name, value))
            return True

        def sought() -> ParameterError:
            found = []
            # at another scale all lengths are others; those of the assignment are nobody's to change
            own, scale = [n for n in names if value_at(self.keys, n) is not None], ["scale"] * (self.keys.scale != 1)
            for name in dict.fromkeys([*own, *scale, *names]):
                given = value_at(self.keys, name)
                if given is None:
                    # of the assignment
                    given = getattr(self.machine, name.rpartition(".")[2])
                shares = _LONGER if name.startswith("mechanism") else _SMALLER
                cure = nearest(partial(works, name), given, [given * share for share in shares])
                found.append(ParameterError(name, given, code, cure, **numbers))
            return next((one for one in found if one.nearest is not None), found[0])

        return LateError(code, sought)

    def _check_walls(self) -> None:
        """Walls about all holes, and between those of a link."""
        widest = max(self.pin_size, self.axle_size) + self.keys.clearance
        if self.keys.link_width < (least := widest + 2 * _WALL):
            raise ParameterError.beyond("link_width", self.keys.link_width, "no_wall_beside_holes", least)
        for link in self.links.values():
            for (one, wide, _), (other, hole_there, key) in combinations(sorted(link.holes, key=_from_pivot), 2):
                if abs(one - other) < (wide + hole_there) / 2 + _WALL:
                    raise self._refused("no_wall_between_holes", [key])
            if link.slot is None:
                continue
            for at, wide, key in link.holes:
                apart = _to_way(np.array(at), (np.array(link.slot[0]), np.array(link.slot[1])))
                if apart < (wide + self.pin_size + self.keys.clearance) / 2 + _WALL:
                    raise self._refused("no_wall_between_holes", [key])

    def _solids(self) -> Iterator[_Solid]:
        """All that moves or stands above the frame, layer by layer."""
        for name, link in self.links.items():
            yield _Solid(name, link.number, range(link.layer, link.layer + 1), link.ends, self.keys.link_width / 2)
        if self.keys.hand_crank:
            yield _Solid("hand_crank", "1", range(-1, 0), [0j, complex(self._reach)], self.keys.link_width / 2)
        for dowel in self.dowels:
            if dowel.rings:
                yield self._about(dowel, dowel.rings, range(1, dowel.layers[1]))
        if self.bridge is not None:
            layer, pillars, _ = self.bridge
            yield _Solid("bridge", "0", range(layer, layer + 1), pillars, self.keys.link_width / 2)

    @property
    def _reach(self) -> float:
        """Length of the hand crank, mm."""
        return _REACH * self.keys.link_width

    def _about(self, dowel: _Dowel, name: str, layers: range) -> _Solid:
        """Rings about a dowel, or its cap."""
        number = "0" if dowel.link == "0" else self.links[dowel.link].number
        return _Solid(name, number, layers, [dowel.at], dowel.size / 2 + _RING, dowel.key)

    def _capped(self) -> Iterator[_Dowel]:
        """The dowels, with the caps that meet nothing."""
        taken = [*self._solids()]
        for dowel in self.dowels:
            if dowel.cap is None:
                yield dowel
                continue
            cap = self._about(dowel, "cap", range(dowel.cap, dowel.cap + 1))
            if self.keys.caps and self._has_room(cap, taken):
                taken.append(cap)
                yield dowel
            else:
                yield replace(dowel, cap=None)

    def _moving(self) -> dict[str, tuple[Complex, Complex]]:
        """Origin and direction of each link by its number, all the way round."""
        from geometry.kinematics.kinetostatics import frames

        turn = 2 * math.pi * np.arange(_SAMPLES) / _SAMPLES
        moving = {key: (one.origin[0], one.way[0]) for key, one in frames(self.levers, self.levers.moved(turn)).items()}
        return moving | {"0": (np.zeros(_SAMPLES, complex), np.ones(_SAMPLES, complex))}

    def _apart(self, one: _Solid, other: _Solid) -> float:
        """How far what fills layers stays from another, mm; one of both is round."""
        if not range(max(one.layers.start, other.layers.start), min(one.layers.stop, other.layers.stop)):
            return math.inf
        low, high = sorted((one, other), key=lambda solid: len(solid.ends))
        (at, *_), corners = ([self.moving[solid.number][0] + end * self.moving[solid.number][1] for end in solid.ends]
                             for solid in (low, high))  # fmt: skip
        return float(_off_hull(at, corners).min()) - one.radius - other.radius

    def _has_room(self, solid: _Solid, others: Sequence[_Solid]) -> bool:
        return all(self._apart(solid, other) >= _APART for other in others)

    def _check_room(self) -> None:
        """Nothing meets in a layer, wherever the crank stands."""
        for one, other in combinations(self._solids(), 2):
            if self._apart(one, other) < _APART:
                names = [key for key in (other.key, one.key) if key]
                raise self._refused("links_meet", [*names, "link_width"], one=one.name, other=other.name, least=_APART)

    def all(self) -> Expansion:
        """Every part, as it stands on what is made before, and the turn of the crank."""
        keys, thick = self.keys, self.thickness
        self._frame()
        for name, link in self.links.items():
            self._flat(name, link)
        if self.bridge is not None:
            self._bridge(*self.bridge)
        for ring, size in (("spacer", self.axle_size), ("washer", self.pin_size)):
            if any(dowel.rings == ring and dowel.layers[1] > 1 for dowel in self.dowels):
                self.plate(ring, size + 2 * _RING, [hole(0j, size + keys.clearance)], label=False)
        for cap, size in (("axle_cap", self.axle_size), ("pin_cap", self.pin_size)):
            if any(_cap_of(dowel) == cap for dowel in self.dowels):
                self.plate(cap, size + 2 * _RING, [hole(0j, size)], label=False)
        for dowel in self.dowels:
            low, high = dowel.capped
            self.pin(dowel.name, dowel.size, round((high - low + 1) * thick - _SHORT, 6))
        # what stands in the frame comes first: drawings cut through its axles
        self._stand_all("spacer", [dowel for dowel in self.dowels if dowel.link == "0"])
        self.put("coaxial", "frame", "crank", height=thick, rotation_deg=self.start)
        for name, link in [*self.links.items()][1:]:
            self.put("lever_member", "crank", name, member=link.member, height=(link.layer - 1) * thick)
        self._stand_all("washer", [dowel for dowel in self.dowels if dowel.link != "0"])
        if self.bridge is not None:
            self.fix("frame", "bridge", 0j, self.bridge[0] * thick)
        capped = [dowel for dowel in self.dowels if dowel.cap is not None]
        for k, dowel in enumerate(capped, 1):
            self._stand(dowel, f"cap_{k}", dowel.cap or 0, _cap_of(dowel))
            self.caps.append((f"cap_{k}", dowel.link, dowel.cap or 0))
        if keys.hand_crank:
            self._hand_crank()
        self._order()
        self.drive(keys, crank="turns")
        self.name_all()
        return self.found

    def _stand_all(self, ring: str, dowels: Sequence[_Dowel]) -> None:
        """Dowels in what holds them, and rings about them below their upper layer."""
        for dowel in dowels:
            self._stand(dowel, dowel.name, dowel.capped[0])
        rings = [(one, layer) for one in dowels if one.rings for layer in range(1, one.layers[1])]
        for k, (dowel, layer) in enumerate(rings, 1):
            self._stand(dowel, f"{ring}_{k}", layer, ring)
            self.rings.append((f"{ring}_{k}", dowel.link, layer))

    def _hand_crank(self) -> None:
        """Behind the frame, with its handle."""
        width, reach, thick = self.keys.link_width, self._reach, self.thickness
        self.crank("hand_crank", reach, (self.axle_size, self.axle_size), (width, width))
        self.pin("handle", self.axle_size, thick + _GRIP)
        self.fix("crank", "hand_crank", 0j, -2 * thick)
        self.fix("crank", "handle", complex(reach), -2 * thick - _GRIP)

    def _order(self) -> None:
        """The order of assembly: each link with its pins, rings and caps, layer by layer down to the frame."""

        def step(name: str, to: str, way: str) -> None:
            self.found.steps.append({"bring": [name], "to": to, "along": list(WAYS[way])})

        for dowel in (one for one in self.dowels if one.link == "0"):
            step(dowel.name, "frame", "front")
        for name, link in self.links.items():
            for dowel in (one for one in self.dowels if one.link == name):
                step(dowel.name, name, "front")
            for ring, on, _ in reversed(self.rings):
                if on == name:
                    step(ring, name, "behind")
            for ring, on, layer in self.rings:
                if on == "0" and layer == link.layer:
                    step(ring, "frame", "front")
            step(name, "frame", "front")
            if name == "crank" and self.keys.hand_crank:
                step("hand_crank", "crank", "behind")
                step("handle", "crank", "behind")
            above = [link.layer + 1]
            if self.bridge is not None and self.bridge[0] == link.layer + 1:
                above.append(link.layer + 2)
                step("bridge", "frame", "front")
            for cap, on, layer in self.caps:
                if layer in above:
                    step(cap, "frame" if on == "0" else on, "front")
                elif layer < 0 and on == name:
                    step(cap, on, "behind")

    def _stand(self, dowel: _Dowel, name: str, layer: int, part: str = "") -> None:
        """Fix a dowel, or a ring about it, with its lower face in a layer, 0 that of the frame."""
        if dowel.link == "0":
            self.fix("frame", name, dowel.at, layer * self.thickness, part)
        else:
            self.fix(dowel.link, name, dowel.at, (layer - self.links[dowel.link].layer) * self.thickness, part)

    def _frame(self) -> None:
        """A rectangle about all axles and slots."""
        wide = self.pin_size + self.keys.clearance
        fast = [(dowel.at, self.axle_size) for dowel in self.dowels if dowel.link == "0"]
        loose = [(0j, self.axle_size + self.keys.clearance)] if self.keys.hand_crank else []
        axles = loose + fast
        about = [(at, self.axle_size / 2) for at, _ in axles]
        about += [(end, wide / 2) for first, last in self.guides for end in (first, last)]
        reach = [(at.real + sign * (half + _BESIDE), at.imag + sign * (half + _BESIDE)) for at, half in about
                 for sign in (-1, 1)]  # fmt: skip
        (left, right), (low, high) = ((math.floor(min(xs)), math.ceil(max(xs))) for xs in zip(*reach, strict=True))
        slots = [
            {"start": place(first, 0.0)[:2], "end": place(last, 0.0)[:2], "width": wide} for first, last in self.guides
        ]
        lengths = {"axle_3": ("O1O3", self.mechanism.frame_length), "axle_5": ("O3O5", self.mechanism.pivot_distance)}
        found = [f"{name} {length:.6g}" for axle, (name, length) in lengths.items()
                 if length is not None and any(one.name == axle for one in self.dowels)]  # fmt: skip
        label = {"label": " ".join(found)} if found else {}
        self.part(
            "frame", kind="plate", face_width=self.thickness, width=float(right - left), height=float(high - low),
            centre=[(left + right) / 2, (low + high) / 2], corner_radius=_CORNER,
            holes=[hole(at, size) for at, size in axles], slots=slots, **label,
        )  # fmt: skip
        self.found.instances["frame"] = {"part": "frame", "at": [0.0, 0.0, -self.thickness], "held": True}

    def _bridge(self, layer: int, pillars: Sequence[complex], slot: Sequence[complex]) -> None:
        """A strip over its pillars, in the frame of the frame."""
        (one, two), wide = ((place(at, 0.0)[:2] for at in slot), self.pin_size + self.keys.clearance)
        circles = [{"at": place(at, 0.0)[:2], "diameter": self.axle_size} for at in pillars]
        outline = {"points": _rounded(pillars, self.keys.link_width / 2)}
        self.part("bridge", kind="layered", layers=[{
            "thickness": self.thickness, "outlines": [outline], "circles": circles,
            "slots": [{"start": one, "end": two, "width": wide}],
        }])  # fmt: skip

    def _flat(self, name: str, link: _Link) -> None:
        """A link as a flat part: the crank, an arm, or the hull of round ends."""
        keys, width = self.keys, self.keys.link_width
        holes = [(at, diameter) for at, diameter, _ in link.holes]
        slots = [{"start": [near, 0.0], "end": [far, 0.0], "width": self.pin_size + keys.clearance}
                 for near, far in ([link.slot] if link.slot else ())]  # fmt: skip
        if name == "crank":
            self.part(
                name, kind="lever_crank", mechanism=given_keys(self.mechanism), width=width, boss_diameter=width,
                face_width=self.thickness, pivot_diameter=holes[0][1], pin_diameter=holes[1][1], label=link.label,
            )  # fmt: skip
        elif len(corners := _hull(link.ends)) == 2 and corners[0] == 0 and corners[1].imag == 0 < corners[1].real:
            more = [hole(at, diameter) for at, diameter in holes[1:] if at != corners[1]]
            at_end = next((diameter for at, diameter in holes if at == corners[1]), 0.0)
            self.part(
                name, kind="follower_arm", end="roller", arm_length=corners[1].real, boss_diameter=width, width=width,
                pivot_diameter=holes[0][1], pin_diameter=at_end, face_width=self.thickness, label=link.label,
                holes=more, slots=slots,
            )  # fmt: skip
        else:
            circles = [{"at": [at.real, at.imag], "diameter": diameter} for at, diameter in holes]
            layer = {"thickness": self.thickness, "outlines": [{"points": _rounded(corners, width / 2)}],
                     "circles": circles, "slots": slots}  # fmt: skip
            self.part(name, kind="layered", layers=[layer], label=link.label)


def _cap_of(dowel: _Dowel) -> str:
    """The part that is its cap."""
    return "" if dowel.cap is None else "axle_cap" if dowel.link == "0" else "pin_cap"


def _from_pivot(one: tuple[complex, float, str]) -> float:
    return abs(one[0])


def _hull(places: Sequence[complex]) -> list[complex]:
    """The corners of the hull of up to three places, counter-clockwise; of two where all lie on a line."""
    if len(places) == 3:
        one, two, three = places
        area = ((two - one).conjugate() * (three - one)).imag
        if abs(area) > _SAME * max(abs(two - one), abs(three - one)) ** 2:
            return [one, two, three] if area > 0 else [one, three, two]
    return [*max(combinations(places, 2), key=lambda pair: abs(pair[1] - pair[0]))]


def _rounded(corners: Sequence[complex], radius: float) -> list[Table]:
    """The outline of the hull of circles about corners, counter-clockwise, as ``layered`` has it."""
    points: list[Table] = []
    for one, two in zip(corners, [*corners[1:], corners[0]], strict=True):
        out = radius * -1j * (two - one) / abs(two - one)
        points += [{"x": (one + out).real, "y": (one + out).imag},
                   {"x": (two + out).real, "y": (two + out).imag, "arc": radius}]  # fmt: skip
    return points


def _to_way(at: Complex, way: tuple[Complex, Complex]) -> Real:
    """How far places are from straight ways, mm."""
    start, along = way[0], way[1] - way[0]
    share = np.clip(np.real((at - start) * np.conj(along)) / np.maximum(np.abs(along) ** 2, _SAME**2), 0.0, 1.0)
    return np.asarray(np.abs(at - start - share * along))


def _off_hull(at: Complex, corners: Sequence[Complex]) -> Real:
    """How far places are from the hull of up to three corners, mm; 0 within."""
    edges = [*zip(corners, [*corners[1:], corners[0]], strict=True)]
    sides = np.array([((b - a).conjugate() * (at - a)).imag for a, b in edges])
    within = np.abs(np.sign(sides).sum(axis=0)) == 3
    return np.where(within, 0.0, np.min([_to_way(at, edge) for edge in edges], axis=0))


LEVER_MODEL = Recipe(LeverModelKeys, lambda keys: _Making(keys).all())

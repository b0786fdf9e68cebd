"""The assembly ``planetary_set``: both meshes of a planetary set, its satellites on a carrier, and what holds them.

Wheels 1 and 3 are central, 2 and 2' the rims of a satellite, as in ``calc planetary``. A wheel's plane is its lower
face; the first wheel that is placed stands at height 0.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import cache
from typing import Annotated, Literal

from msgspec import Meta

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.errors import Nearest, ParameterError
from geometry.base.nearest import kept
from geometry.base.record import Record
from geometry.base.tolerance import PLACED_MM
from geometry.gears.planetary.assembly import Satellites, given_set, least_angle
from geometry.gears.planetary.fitting import Fitting, gap_between
from geometry.gears.planetary.sets import LINKS, SCHEMES, PlanetarySet, Scheme, ratio_of
from geometry.gears.shifts.external import Requirements
from geometry.gears.teeth.basic_rack import ISO_53_ANGLE, iso_53
from geometry.gears.teeth.helix import Hand
from geometry.gears.teeth.transverse import transverse_angle
from parts.keys.base import degrees, mm, part_mm
from parts.keys.helix import Double, HelixAngle
from parts.keys.mate import further
from parts.recipes.making import Making, check_play, hole, holes_on, mark, on_circle
from parts.recipes.recipe import Expansion, ModelKeys, Recipe, Table

# what meshes keep where their shifts are chosen: tip thickness, modules, and contact ratio
_WISH = Requirements(0.25, 1.1)
# wheels of each scheme in the order z1, z2, z2', z3
_WHEELS = {
    "james": ("sun", "satellite", "satellite", "ring"),
    "one_external_one_internal": ("sun", "satellite", "second_satellite", "ring"),
    "two_internal": ("ring", "satellite", "second_satellite", "second_ring"),
    "david": ("sun", "satellite", "second_satellite", "second_sun"),
}
# mm: a ring's rim beyond its teeth where screws go through it, the screws, the base beyond the ring, a crank's handle,
# the engraved mark of a carrier
_RIM, _SCREW, _MARGIN, _HANDLE, _MARK = 14.0, 4.0, 12.0, 25.0, 1.0
_MOST_TURNS = 10_000
# of the wheels 1, 2, 2', 3
Shifts = tuple[float, float, float, float]

_WORKING_CENTRE_DISTANCE = part_mm(
    "centre distance of both meshes; default: as the teeth need it", above=0, example=48.0
)
_SHIFTS = Meta(description="shift of each wheel as in teeth; default: least that work", examples=[[0.0, 0.0, 0.0]])
_NORMAL_BACKLASH = mm("normal backlash of both meshes", least=0, most=100, example=0.1)
_TURNS = Meta(
    ge=-_MOST_TURNS,
    le=_MOST_TURNS,
    examples=[4.0],
    extra={"unit": "turns"},
    description="how far the driver is turned; default: until what it drives has turned once, of a differential 1",
)
_SCHEME = Meta(description="scheme of the practicum's figure 2.1, as in calc planetary")
_TEETH = Meta(description="numbers of teeth z1, z2, z3, or with two rims z1, z2, z2', z3", examples=[[24, 24, 72]])
_SPACING = Meta(description="satellites equally spaced, or as equally as alike ones can be")
_DRIVER = Meta(description="what is driven: wheel 1, wheel 3, the carrier, or none of them here")
_HELD = Meta(description="what stands still: wheel 1, wheel 3, the carrier, or none: a differential")
_SECOND_SHAFT = mm(
    "of the shaft through the upper plate of the carrier: wheel 3's where it is a sun, else one fixed in that plate; "
    "default: the suns' shaft goes through both",
    above=0,
    most=10_000,
    example=10.0,
)
_FRAME = Meta(description="with shaft and crank, and a base under the ring, which stands on feet; marks engraved")


class PlanetarySetKeys(ModelKeys, kw_only=True, tag="planetary_set"):
    """Keys of ``planetary_set``."""

    scheme: Annotated[Literal["james", "one_external_one_internal", "two_internal", "david"], _SCHEME] = "james"
    teeth: Annotated[list[Annotated[int, Meta(ge=3, le=10_000)]], _TEETH]
    satellites: Annotated[int, Meta(ge=1, le=1000, description="number of satellites")] = 3
    spacing: Annotated[Literal["equal", "unequal"], _SPACING] = "equal"
    identical: Annotated[bool, Meta(description="both rims of all satellites are clocked alike")] = True
    module: Annotated[float, mm("module of the mesh 1-2", least=0.01, most=1000)] = 2.0
    second_module: Annotated[float, mm("module of the mesh 2'-3", least=0.01, most=1000, example=2.0)] | None = None
    working_centre_distance: Annotated[float, _WORKING_CENTRE_DISTANCE] | None = None
    shifts: Annotated[list[Annotated[float, Meta(ge=-10, le=10)]], _SHIFTS] | None = None
    normal_backlash: Annotated[float, _NORMAL_BACKLASH] | None = None
    helix_angle_deg: HelixAngle = 0.0
    hand: Annotated[Literal["right", "left"], Meta(description="hand of wheel 1; of the others as they mesh")] = "right"
    double_helical: Double = False
    driver: Annotated[Literal["first", "second", "carrier", "none"], _DRIVER] = "first"
    held: Annotated[Literal["first", "second", "carrier", "none"], _HELD] = "second"
    turns: Annotated[float, _TURNS] | None = None
    direction_deg: Annotated[float, degrees("direction of the first satellite", least=-360, most=360)] = 0.0
    face_width: Annotated[float, mm("face width of every wheel", least=0.1, most=10_000)] = 10.0
    plate_thickness: Annotated[float, mm("thickness of carrier, frame and crank", least=0.1, most=10_000)] = 4.0
    axial_gap: Annotated[float, mm("between planes of wheels and plates", least=0, most=1000)] = 0.5
    pin_diameter: Annotated[float, mm("of the satellites' pins", above=0, most=10_000)] = 6.0
    shaft_diameter: Annotated[float, mm("of the suns' shaft", above=0, most=10_000)] = 8.0
    second_shaft_diameter: Annotated[float, _SECOND_SHAFT] | None = None
    clearance: Annotated[float, mm("of bores on the pins and shafts that turn in them", least=0, most=100)] = 0.0
    frame: Annotated[bool, _FRAME] = False


class _Wheel(Record):
    """One wheel: its id, its place in ``teeth``, teeth, module (mm), shift, whether a ring, its lower face (mm)."""

    id: str
    item: int
    teeth: int
    module: float
    shift: float
    is_ring: bool
    height: float
    hand: Hand = "right"


class _Set(Record):
    """What the tables are made of: the wheels 1, 2, 2', 3, the centre distance (mm), where satellites stand (turns).

    ``carried_ratio``: w1 / w3 with the carrier held.
    """

    keys: PlanetarySetKeys
    carried_ratio: Fraction
    wheels: tuple[_Wheel, _Wheel, _Wheel, _Wheel]
    distance: float
    places: tuple[Fraction, ...]

    @property
    def equal(self) -> bool:
        """Whether they are equally spaced."""
        return self.keys.spacing == "equal"

    @property
    def low(self) -> float:
        """Lower face of all wheels, mm."""
        return min(w.height for w in self.wheels)

    @property
    def high(self) -> float:
        """Upper face of all wheels, mm."""
        return max(w.height for w in self.wheels) + self.keys.face_width

    @property
    def chain(self) -> tuple[_Wheel, _Wheel, _Wheel, _Wheel]:
        """The wheels in the order in which they are placed: a ring before a sun."""
        first, last = self.wheels[0], self.wheels[3]
        return self.wheels[::-1] if last.is_ring and not first.is_ring else self.wheels


def _expanded(keys: PlanetarySetKeys) -> Expansion:
    """Wheels, carrier, pins, and with a frame what a model needs to be turned and counted."""
    made = _settled(keys)
    making = Making("planetary_set", keys.plate_thickness, keys)
    for wheel in dict.fromkeys(made.wheels):
        making.part(wheel.id, **_wheel_keys(made, wheel))
        module = "module" if wheel.module == keys.module else "second_module"
        making.told(wheel.id, number_of_teeth=f"teeth[{wheel.item}]", module=module, helix_angle_deg="helix_angle_deg")
        if keys.shifts is not None:
            making.told(wheel.id, profile_shift_coefficient=f"shifts[{wheel.item}]")
    _add_meshes(made, making.found)
    _add_carrier(made, making)
    if keys.frame:
        _add_frame(made, making)
    _add_drive(made, making.found)
    # no whole wheel of a herringbone comes in between others
    if not keys.double_helical:
        making.order(keys.scheme, meshing={"screwed": True} if keys.helix_angle_deg else {})
    making.name_all()
    return making.found


PLANETARY_SET = Recipe(PlanetarySetKeys, _expanded, grows=True)


def _settled(keys: PlanetarySetKeys) -> _Set:
    """Teeth that are assembled, shifts that meet at one distance."""
    scheme = SCHEMES[keys.scheme]
    check_play(keys.clearance, keys.pin_diameter, keys.shaft_diameter)
    if keys.second_module is not None and not scheme.double:
        raise ParameterError("second_module", keys.second_module, "one_rim_one_module")
    modules = keys.module, keys.second_module or keys.module
    cosine = Fraction(math.cos(math.radians(keys.helix_angle_deg)))
    one = given_set(scheme, keys.teeth, (Fraction(str(modules[0])), Fraction(str(modules[1]))), cosine)
    if one.carried_ratio == 1:
        raise ParameterError("teeth", keys.teeth, "transmits_nothing")
    mesh = _fitted if keys.shifts is None else _given_shifts

    @cache
    def meshed(other: PlanetarySet, apart: Fraction | None) -> tuple[float, Shifts]:
        return mesh(keys, other, apart)

    try:
        places = Satellites(keys.satellites, keys.spacing, keys.identical).places(
            one, lambda other, apart: kept(lambda at: bool(meshed(other, at)), apart)
        )
    except ParameterError:
        # another number helps only where one alone has its meshes
        meshed(one, None)
        raise
    distance, shifts = meshed(one, least_angle(places))
    step = keys.face_width + keys.axial_gap
    heights = (0.0, 0.0, step, step) if scheme.double else (0.0, 0.0, 0.0, 0.0)
    items = (1, 2, 3, 4) if scheme.double else (1, 2, 2, 3)
    rings = scheme.internal[0], False, False, scheme.internal[1]
    columns = zip(_WHEELS[keys.scheme], items, one.teeth, (modules[0],) * 2 + (modules[1],) * 2, shifts, rings, heights,
                  _hands(keys, scheme), strict=True)  # fmt: skip
    first, rim, second_rim, last = (_Wheel(*column) for column in columns)
    return _Set(keys, one.carried_ratio, (first, rim, second_rim, last), distance, places)


def _hands(keys: PlanetarySetKeys, scheme: Scheme) -> tuple[Hand, Hand, Hand, Hand]:
    """Of wheels 1, 2, 2', 3: both rims of a satellite alike, mates opposite, a ring as its rim."""
    other: dict[Hand, Hand] = {"right": "left", "left": "right"}
    first: Hand = keys.hand if keys.helix_angle_deg >= 0 else other[keys.hand]
    rim = first if scheme.internal[0] else other[first]
    return first, rim, rim, rim if scheme.internal[1] else other[rim]


def _fitted(keys: PlanetarySetKeys, one: PlanetarySet, apart: Fraction | None) -> tuple[float, Shifts]:
    """Distance and shifts as ``calc planetary`` chooses them; ``apart``: the least angle of satellites, turns."""
    beta = abs(math.radians(keys.helix_angle_deg))
    fitting = Fitting(iso_53("A"), _WISH, apart, 0.0, keys.working_centre_distance, beta)
    fit = fitting.fit(one)
    if fit is None:
        from parts.texts.planetary import broken_told

        one_distance, other = (float(d) for d in one.distances)
        # meshes of one distance have it, and break what else a set keeps
        broken = broken_told(fitting, one) if math.isclose(one_distance, other) else []
        code = "no_shifts_keep_all" if broken else "no_shifts_fit"
        raise ParameterError("teeth", keys.teeth, code, first=one_distance, second=other, broken=broken)
    return fit.distance, fit.shifts


def _given_shifts(keys: PlanetarySetKeys, one: PlanetarySet, apart: Fraction | None) -> tuple[float, Shifts]:
    """Shifts that the scene gives, held against one distance and the tips of satellites so far apart, turns."""
    given = keys.shifts or []
    if len(given) != len(keys.teeth):
        raise ParameterError("shifts", given, "one_shift_a_wheel", wheels=len(keys.teeth))
    x1, x2, *rest = given
    shifts = (x1, x2, rest[0] if one.scheme.double else x2, rest[-1])
    found = []
    angle = transverse_angle(ISO_53_ANGLE, math.radians(keys.helix_angle_deg))
    inside = one.scheme.internal
    # sums of the shifts of both meshes, or differences where one is internal
    totals = shifts[0] + (-shifts[1] if inside[0] else shifts[1]), shifts[3] + (-shifts[2] if inside[1] else shifts[2])
    for span, reference, total in zip(one.spans, one.distances, totals, strict=True):
        value = involute_function(angle) + 2 * math.tan(ISO_53_ANGLE) * total / span
        if value < 0:
            raise ParameterError("shifts", given, "shifts_leave_no_angle")
        found.append(float(reference) * math.cos(angle) / math.cos(inverse_involute(value)))
    distance = keys.working_centre_distance or found[0]
    if keys.working_centre_distance is None and abs(found[0] - found[1]) > PLACED_MM:
        raise ParameterError("shifts", given, "shifts_not_coaxial", first=found[0], second=found[1])
    rims = zip(one.modules, one.teeth[1:3], shifts[1:3], totals, one.distances, inside, strict=True)
    for module, teeth, shift, total, reference, is_ring in rims:
        height = 1 + shift - (0.0 if is_ring else max(total - (distance - float(reference)) / float(module), 0.0))
        tip = float(module) * (teeth / (2 * math.cos(math.radians(keys.helix_angle_deg))) + height)
        if gap_between(distance, tip, apart) < -PLACED_MM:
            raise ParameterError("satellites", keys.satellites, "satellites_collide")
    return distance, shifts


def _wheel_keys(made: _Set, wheel: _Wheel) -> Table:
    keys = made.keys
    table: Table = {
        "kind": "ring_gear" if wheel.is_ring else "spur_gear", "module": wheel.module, "number_of_teeth": wheel.teeth,
        "profile_shift_coefficient": wheel.shift, "face_width": keys.face_width,
    }  # fmt: skip
    if keys.helix_angle_deg:
        table |= {"helix_angle_deg": abs(keys.helix_angle_deg), "hand": wheel.hand}
    if keys.double_helical:
        table["double_helical"] = True
    if wheel.is_ring and keys.frame:
        screws, outside = _rim(made, wheel)
        table |= {"outer_diameter": 2 * outside, "holes": holes_on(4, _SCREW, screws, 45.0)}
    elif not wheel.is_ring:
        key = _bore_key(made, wheel)
        # satellites turn on their pins
        table["bore_diameter"] = getattr(keys, key) + (keys.clearance if key == "pin_diameter" else 0.0)
    if keys.frame:
        table["tooth_mark"] = mark(keys.face_width)
    return table


def _bore_key(made: _Set, wheel: _Wheel) -> str:
    """The key of what stands in a wheel's bore."""
    if wheel in made.wheels[1:3]:
        return "pin_diameter"
    has_own = wheel is made.wheels[3] and made.keys.second_shaft_diameter is not None
    return "second_shaft_diameter" if has_own else "shaft_diameter"


def _rim(made: _Set, ring: _Wheel) -> tuple[float, float]:
    """Radii of the circle of screws in a ring's rim and of its outside, mm, half millimetres.

    Feet stand there, out of the way of a satellite's larger rim below the ring.
    """
    cosine = math.cos(math.radians(made.keys.helix_angle_deg))
    root = math.ceil(2 * ring.module * (ring.teeth / cosine / 2 + 1.25 + ring.shift)) / 2
    passed = made.distance + max(w.module * (w.teeth / cosine / 2 + 1 + w.shift) for w in made.wheels[1:3])
    screws = max(root + _RIM / 2 + 1, math.ceil(2 * (passed + 1.25 * _SCREW + 1)) / 2)
    return screws, screws + _RIM / 2


def _stand(made: _Set, found: Expansion, group: str, part: str) -> None:
    """One instance of a part for each satellite."""
    if made.equal:
        found.instances[group] = {"part": part, "count": len(made.places)}
    else:
        found.instances |= {f"{group}_{k}": {"part": part} for k, _ in enumerate(made.places, 1)}


def _join(made: _Set, found: Expansion, mate: Table, groups: tuple[str, ...], turns: Sequence[float] = ()) -> None:
    """A mate with ends that are groups: one for all, or one for each; ``turns``: rotation of each second, degrees."""
    if made.equal and not any(turns):
        found.mates.append(mate)
        return
    for k, place in enumerate(made.places, 1):
        own = {key: f"{value}_{k}" if value in groups else value for key, value in mate.items()}
        if "direction_deg" in mate:
            own["direction_deg"] = further(mate["direction_deg"], 360 * float(place))
        if "number" in mate:
            own["number"] = k
        if turns:
            own["rotation_deg"] = turns[k - 1]
        found.mates.append(own)


def _mesh(made: _Set, first: _Wheel, second: _Wheel, direction: float) -> Table:
    keys, kind = made.keys, "internal" if first.is_ring or second.is_ring else "external"
    table: Table = {"kind": f"{kind}_gear_pair", "first": first.id, "second": second.id, "direction_deg": direction}
    if keys.working_centre_distance is not None:
        table["working_centre_distance"] = keys.working_centre_distance
    if keys.normal_backlash is not None:
        table["normal_backlash"] = keys.normal_backlash
    return table


def _add_meshes(made: _Set, found: Expansion) -> None:
    """The satellites in mesh with the first wheel, their other rims fixed to them, and the other wheel in mesh."""
    keys = made.keys
    one, rim, other_rim, other = made.chain
    rims = tuple(dict.fromkeys((rim.id, other_rim.id)))
    for group in rims:
        _stand(made, found, group, group)
    _join(made, found, _mesh(made, one, rim, keys.direction_deg), rims)
    if rim.id != other_rim.id:
        height = other_rim.height - rim.height
        fixed = {"kind": "fixed", "first": rim.id, "second": other_rim.id, "offset": [0.0, 0.0, height]}
        _join(made, found, fixed, rims, _clocking(made))
        if keys.axial_gap > 0:
            length, bore = keys.axial_gap, keys.pin_diameter + keys.clearance
            found.parts["spacer"] = {"kind": "pin", "diameter": 1.4 * bore, "length": length, "bore_diameter": bore}
            _stand(made, found, "spacer", "spacer")
            between = keys.face_width if height > 0 else -length
            spaced = {"kind": "fixed", "first": rim.id, "second": "spacer", "offset": [0.0, 0.0, between]}
            _join(made, found, spaced, (rim.id, "spacer"))
    _join(made, found, _mesh(made, other_rim, other, math.remainder(keys.direction_deg + 180, 360)), rims)


def _clocking(made: _Set) -> list[float]:
    """By how much the other rim of each satellite is turned against its first, degrees, from the first satellite on.

    The mate puts rim r of a satellite at theta (1 +- z_c / z_r) beyond that of the first, as if it had rolled there on
    wheel c: + on an external one. Both rims are so where they mesh; a whole tooth of the other rim makes no difference.
    """
    one, rim, other_rim, other = made.chain
    own, wanted = (Fraction(-w.teeth if w.is_ring else w.teeth, r.teeth) for w, r in ((one, rim), (other, other_rim)))
    pitch = Fraction(1, other_rim.teeth)
    start = made.keys.direction_deg
    turns = []
    for place in made.places:
        # a direction is turned back by a whole turn where it leaves its range
        back = round((further(start, 360 * float(place)) - start) / 360 - float(place))
        turns.append((place + back) * (wanted - own) % pitch)
    return [360 * float(turn - pitch if turn > pitch / 2 else turn) for turn in turns]


def _add_carrier(made: _Set, making: Making) -> None:
    """Two plates below and above all wheels, and the pins between them on which the satellites turn."""
    keys, first, found = made.keys, made.chain[0], making.found
    thick, gap = keys.plate_thickness, keys.axial_gap
    bottom, inside = made.low - gap - thick, made.high - made.low + 2 * gap
    plate: Table = {
        "kind": "carrier_plate", "number_of_pins": len(made.places), "pin_circle_diameter": 2 * made.distance,
        "pin_diameter": keys.pin_diameter, "bore_diameter": keys.shaft_diameter + keys.clearance, "face_width": thick,
    }  # fmt: skip
    if not made.equal:
        plate["directions_deg"] = [360 * float(p) for p in made.places]
    making.part("carrier", **plate)
    if (second := keys.second_shaft_diameter) is not None:
        # a ring has no shaft: the carrier has it, and does not turn on it
        turns = not made.wheels[3].is_ring
        plate["bore_diameter"] = second + (keys.clearance if turns else 0.0)
        making.part("upper_carrier", "carrier", **plate)
        if not (turns and keys.clearance):
            making.told("upper_carrier", bore_diameter="second_shaft_diameter")
    # between the shaft and a pin, where there is room
    start = max(0.5 * made.distance, (keys.shaft_diameter + keys.clearance) / 2 + _MARK)
    end = min(0.75 * made.distance, made.distance - keys.pin_diameter / 2 - _MARK)
    if keys.frame and start < end:
        slot = {"start": [start, 0.0], "end": [end, 0.0], "width": _MARK}
        found.parts["carrier"]["engraved"] = [slot | mark(thick)]
    making.pin("pin", keys.pin_diameter, inside + 2 * thick)
    making.put("coaxial", first.id, "carrier", height=bottom - first.height, rotation_deg=keys.direction_deg)
    upper = "carrier" if keys.second_shaft_diameter is None else "upper_carrier"
    making.put("fixed", "carrier", "upper_carrier", upper, offset=[0.0, 0.0, thick + inside])
    _stand(made, found, "pin", "pin")
    _join(made, found, {"kind": "pin_seat", "first": "carrier", "second": "pin", "number": 1}, ("pin",))
    rim = made.chain[1]
    turning = {"kind": "coaxial", "first": "pin", "second": rim.id, "height": rim.height - bottom}
    _join(made, found, turning, ("pin", rim.id))
    for wheel in made.wheels:
        if not wheel.is_ring:
            key = _bore_key(made, wheel)
            # with a clearance the bore of what turns is no key's own
            if not (key == "pin_diameter" and made.keys.clearance):
                making.told(wheel.id, bore_diameter=key)


def _add_frame(made: _Set, making: Making) -> None:
    """A base on which the ring stands on feet, and the sun's shaft with a crank; a pointer on the base."""
    keys = made.keys
    ring, *_, sun = made.chain
    if not ring.is_ring or sun.is_ring:
        raise ParameterError("frame", keys.frame, "frame_needs_ring_and_sun", Nearest(False))
    if keys.held != ("first" if ring is made.wheels[0] else "second"):
        raise ParameterError("frame", keys.frame, "frame_holds_the_ring", Nearest(False))
    if (second := keys.second_shaft_diameter) is not None:
        raise ParameterError("second_shaft_diameter", second, "frame_has_one_shaft", Nearest(None))
    thick, gap = keys.plate_thickness, keys.axial_gap
    screws, outside = _rim(made, ring)
    floor, top = made.low - 2 * gap - thick, made.high + 2 * gap + thick
    half, arm = outside + _MARGIN, round(max(0.8 * made.distance, 3 * keys.shaft_diameter, 3 * keys.pin_diameter), 1)
    feet = on_circle(4, screws, 45.0)
    pointer = {"start": [outside + 2, 0.0], "end": [half - 2, 0.0], "width": 1.5} | mark(thick)
    making.plate(
        "base", 2 * half, [hole(0j, keys.shaft_diameter + keys.clearance), *(hole(at, _SCREW) for at in feet)],
        corner_radius=_MARGIN, engraved=[pointer],
    )  # fmt: skip
    making.pin("foot", 2.5 * _SCREW, ring.height - floor, _SCREW)
    making.pin("shaft", keys.shaft_diameter, top - floor + 2 * thick)
    ends = keys.shaft_diameter, keys.pin_diameter
    making.crank("crank", arm, ends, (2 * ends[0], 2 * ends[1]))
    making.pin("handle", keys.pin_diameter, thick + _HANDLE)
    making.found.instances["foot"] = {"part": "foot", "count": 4}
    making.mate("fixed", ring.id, "foot", offset=[feet[0].real, feet[0].imag, floor - ring.height])
    making.mate("fixed", ring.id, "base", offset=[0.0, 0.0, floor - thick - ring.height])
    making.mate("fixed", sun.id, "shaft", offset=[0.0, 0.0, floor - thick - sun.height])
    making.mate("fixed", "shaft", "crank", offset=[0.0, 0.0, top - floor + thick])
    making.mate("fixed", "crank", "handle", offset=[arm, 0.0, 0.0])


def _add_drive(made: _Set, found: Expansion) -> None:
    """What stands still, and what is turned."""
    keys = made.keys
    links = {"first": made.wheels[0].id, "second": made.wheels[3].id, "carrier": "carrier"}
    if keys.driver == keys.held != "none":
        raise ParameterError("driver", keys.driver, "driver_is_held")
    if keys.held != "none":
        held = links[keys.held]
        found.instances[held] = {**found.instances.get(held, {"part": held}), "held": True}
    if keys.driver != "none":
        found.drives.append({"instance": links[keys.driver], "turns": _turns(made)})


def _turns(made: _Set) -> float:
    """Of the driver: as given, else until what it drives has turned once."""
    keys = made.keys
    if keys.turns is not None or keys.driver == "none" or keys.held == "none":
        return 1.0 if keys.turns is None else keys.turns
    (driven,) = (link for link in LINKS if link not in (keys.driver, keys.held))
    ratio = float(ratio_of(made.carried_ratio, keys.driver, driven) or 1)
    return max(-_MOST_TURNS, min(_MOST_TURNS, ratio))

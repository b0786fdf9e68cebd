"""The part kind ``pawl``: what holds a ratchet wheel, made for the notches of one; it works in thrust."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta
from msgspec.structs import replace

from geometry.base.errors import GeometryError, Nearest, ParameterError
from geometry.base.findings import Finding
from geometry.base.nearest import kept, nearest
from geometry.base.record import Record
from parts.base.kind import Others, Report
from parts.base.links import owner_of
from parts.bodies.plate import Extruded, FlatKeys, checked_outline
from parts.keys.base import check_idle, degrees, in_vain, part_mm
from parts.ratchets.wheel import RATCHET_WHEEL, RatchetWheelSpec

if TYPE_CHECKING:
    from geometry.gears.ratchets.pawl import PawlShape
    from geometry.gears.ratchets.wheel import RatchetWheel
    from geometry.solids.plate import PlateOutline
    from parts.base.readback import Probe

# by default, modules: gap to the tips, height of the nose over them, pivot hole; of that hole the boss; of the root's
# rounding the nose's; of the shortest length that has room for boss and teeth
_CLEARANCE, _HEIGHT, _HOLE, _BOSS, _NOSE, _LENGTH = 0.1, 0.6, 0.75, 2.0, 1.2, 1.25
# of the module, where the root is sharp; degrees of a pawl in a ring
_SHARP, _INWARDS = 0.05, 45.0
# of the depth of the teeth: with less of its face a pawl works at the edge alone
_ENOUGH = 0.5
# of a size that is given, tried where it is to blame
_SHARES = (1.25, 0.8, 1.6, 0.6, 2.5, 0.4, 4.0, 0.2, 0.1)
_WHEEL: dict[str, object] = {"kind": "ratchet_wheel", "module": 5.0, "number_of_teeth": 16}

_LENGTH_KEY = part_mm(
    "from the edge of the tooth that it holds to its pivot; default: as the boss and the teeth have room", above=0,
    example=30.0,
)  # fmt: skip
_LINE = degrees(
    "of the line from that edge to the pivot off the tangent of the tip circle, away from the teeth; default: 0, in a"
    " ring 45",
    least=-30, most=80, example=0.0,
)  # fmt: skip
_NOSE_KEY = part_mm("rounding of the nose; default: 1.2 times that of the root", above=0, example=0.6)
_HEIGHT_KEY = part_mm("of the face beyond the tip circle; default: 0.6 m", above=0, example=3.0)
_CLEARANCE_KEY = part_mm("gap between all but the nose and the tips of the teeth; default: 0.1 m", above=0, example=0.5)
_BOSS_KEY = part_mm("of the round end about the pivot; default: twice the hole", above=0, example=7.5)
_PIVOT_KEY = part_mm("hole for the pivot; 0 is none; default: 0.75 m", least=0, example=3.75)
_TAIL = part_mm(
    "of a tail behind the pivot, for a thumb or a spring, to the middle of its round end; 0 is none", least=0
)
_TAIL_ANGLE = degrees("of the tail off the bar's line, away from the wheel", least=-120, most=120)
_TAIL_WIDTH = part_mm("of its round end; default: the boss's three quarters", above=0, example=5.0)


# as the calculation has them too
Length = Annotated[float, _LENGTH_KEY] | None
LineAngle = Annotated[float, _LINE] | None
NoseRadius = Annotated[float, _NOSE_KEY] | None
NoseHeight = Annotated[float, _HEIGHT_KEY] | None
ClearanceAngle = Annotated[float, degrees("between its underside and the tooth's back", least=0, most=60)]
Clearance = Annotated[float, _CLEARANCE_KEY] | None
BossDiameter = Annotated[float, _BOSS_KEY] | None
PivotDiameter = Annotated[float, _PIVOT_KEY] | None


class PawlSpec(FlatKeys, forbid_unknown_fields=True, kw_only=True, tag_field="kind", tag="pawl"):
    """Keys of ``pawl``."""

    of: Annotated[str, Meta(description="the part of kind ratchet_wheel that it holds")]
    length: Length = None
    line_angle_deg: LineAngle = None
    nose_radius: NoseRadius = None
    nose_height: NoseHeight = None
    clearance_angle_deg: ClearanceAngle = 10.0
    clearance: Clearance = None
    boss_diameter: BossDiameter = None
    pivot_diameter: PivotDiameter = None
    tail_length: Annotated[float, _TAIL] = 0.0
    tail_angle_deg: Annotated[float, _TAIL_ANGLE] = 0.0
    tail_width: Annotated[float, _TAIL_WIDTH] | None = None


class Pawl(Record):
    """A pawl's shape, and its outline with holes."""

    shape: PawlShape
    outline: PlateOutline


class PawlKind(Extruded[PawlSpec, Pawl]):
    """What holds a ratchet wheel."""

    name, keys, made_from = "pawl", PawlSpec, _WHEEL

    def idle(self, keys: PawlSpec, others: Others) -> Iterator[ParameterError]:
        """Sizes of a tail that is not there."""
        if not keys.tail_length:
            yield from in_vain(keys, ("tail_angle_deg", "tail_width"), other="tail_length")

    def thing(self, keys: PawlSpec, others: Others) -> Pawl:
        """The pawl of another part's wheel, checked to have an outline that keeps off its teeth."""
        from geometry.gears.ratchets.pawl import checked_pawl

        check_idle(self.idle(keys, others))
        owner = owner_of(keys.of, others, RatchetWheelSpec)
        wheel = RATCHET_WHEEL.thing(owner, others)
        try:
            shape = checked_pawl(pawl_of(keys, wheel, owner.module))
        except GeometryError as refusal:
            raise _cured(keys, wheel, owner.module, refusal) from refusal
        hole = pivot_hole(keys, owner.module)
        own = [("pivot_diameter", 0j, hole)] if hole > 0 else []
        return Pawl(shape, checked_outline(shape.outline().edges, keys, own))

    def flat(self, thing: Pawl) -> PlateOutline:
        """Its outline."""
        return thing.outline

    def axle_diameter(self, keys: PawlSpec) -> float:
        """That of the pivot, where a key tells it."""
        return keys.pivot_diameter or 0.0

    def probes(self, keys: PawlSpec, thing: Pawl) -> tuple[Probe, ...]:
        """It sits in the notch of its wheel and touches both sides."""
        from parts.ratchets.probe import SeatProbe

        return (SeatProbe(thing.shape, keys.face_width / 2),)

    def report(self, keys: PawlSpec, thing: Pawl) -> Report:
        """Its sizes, and how it stands to the wheel."""
        shape = thing.shape
        depth, enough = shape.contact_depth, _ENOUGH * shape.wheel.depth
        quantities = {
            "pawl_length": shape.length,
            "pivot_distance": shape.pivot_distance,
            "nose_radius": shape.nose_radius,
            "contact_depth": depth,
            "pull_in_angle_deg": math.degrees(shape.pull_in_angle),
            "pawl_swing_deg": math.degrees(shape.swing),
            "overrun_deg": math.degrees(shape.overrun),
        }
        return Report((Finding("shallow_pawl", depth, enough),) if depth < enough else (), quantities=quantities)


PAWL = PawlKind()


def pivot_hole(keys: PawlSpec, module: float) -> float:
    """Diameter of the hole for the pivot, mm."""
    return _HOLE * module if keys.pivot_diameter is None else keys.pivot_diameter


def pawl_of(keys: PawlSpec, wheel: RatchetWheel, module: float) -> PawlShape:
    """The pawl of the keys, not yet checked."""
    from geometry.gears.ratchets.pawl import PawlShape

    line = _usual_line(wheel) if keys.line_angle_deg is None else keys.line_angle_deg
    gap = _CLEARANCE * module if keys.clearance is None else keys.clearance
    boss = keys.boss_diameter or _BOSS * (pivot_hole(keys, module) or _HOLE * module)
    tip, sine = wheel.tip_radius, math.sin(math.radians(line))
    if wheel.internal:
        # there the pivot is nearest to the axis
        usual = tip * max(sine, 0.1)
    else:
        # where the boss comes to the circle that keeps off the teeth, and a pitch beyond the edge
        clear = math.sqrt((tip * sine) ** 2 + (tip + gap + boss / 2) ** 2 - tip**2) - tip * sine
        usual = _LENGTH * max(clear, tip * wheel.pitch_angle + boss / 2)
    nose = keys.nose_radius or (_NOSE * wheel.fillet_radius or _SHARP * module)
    width = keys.tail_width or 0.75 * boss
    tail = (keys.tail_length, math.radians(keys.tail_angle_deg), width) if keys.tail_length else None
    return PawlShape(
        wheel,
        keys.length or usual,
        math.radians(line),
        nose,
        math.radians(keys.clearance_angle_deg),
        gap,
        keys.nose_height or _HEIGHT * module,
        boss / 2,
        tail,
    )


def _usual_line(wheel: RatchetWheel) -> float:
    """The line angle where no key tells it, degrees."""
    return _INWARDS if wheel.internal else 0.0


def _cured(keys: PawlSpec, wheel: RatchetWheel, module: float, refusal: GeometryError) -> ParameterError:
    """The refusal by the first key that alone cures it, the one to blame before the others."""
    from geometry.gears.ratchets.pawl import checked_pawl

    blamed, code = getattr(refusal, "name", "nose_height"), getattr(refusal, "code", "no_whole_outline")
    sizes = ("nose_radius", "boss_diameter", "length", "nose_height", "clearance", "clearance_angle_deg",
             "line_angle_deg", "tail_length", "tail_angle_deg", "tail_width")  # fmt: skip
    for key in sorted(sizes, key=lambda one: one != blamed):
        given = getattr(keys, key)
        if given is None or (given == 0 and key != "line_angle_deg"):
            continue

        def fits(value: float, key: str = key) -> bool:
            return checked_pawl(pawl_of(replace(keys, **{key: value}), wheel, module)).length > 0

        ends = [given * share for share in _SHARES]
        if key == "nose_radius":
            ends = [wheel.fillet_radius * _NOSE or _SHARP * module, *ends]
        if key.startswith("tail") or key.endswith("_deg"):
            ends.append(_usual_line(wheel) if key == "line_angle_deg" else 0.0)
        if any(kept(fits, end) for end in ends):
            return ParameterError(key, given, code, partial(nearest, fits, given, ends, digits=6))
    without = next((key for key in sizes if getattr(keys, key) is not None), "")
    return ParameterError(blamed, getattr(keys, blamed, None), code, Nearest(None) if without == blamed else None)

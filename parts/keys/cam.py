"""Scene keys of a follower's motion: phases with their laws, or a table."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Literal, Protocol, TypeAlias

from msgspec import Meta, Struct

from geometry.base.errors import Cure, Nearest, ParameterError
from geometry.base.findings import Finding
from geometry.base.nearest import kept
from geometry.base.record import Record, replace
from parts.keys.base import MOST_LENGTH, check_idle, degrees, in_vain, part_mm, start
from parts.keys.law import LawName, LawTable, PhaseLaw, law_of

if TYPE_CHECKING:
    from geometry.cams.motion.follower_motion import FollowerMotion, Phase

# angles that miss a turn by less are closed by the last phase, degrees
_CLOSING_DEG = 5e-8
# a phase that is so many times shorter than the last one was mistyped
_FAR_SHORTER = 4
# usual limits of the pressure angle, degrees: sliding and swinging followers (practicum: 30 to 35, 40 to 50)
USUAL_PRESSURE_ANGLE = {False: 30.0, True: 45.0}
# velocities of a law of stroke and length 1 below this are none
_ROUGH = 1e-9
# a law at rest at its ends, offered in place of one that moves there
LAW_AT_REST = "sine"


# the last as programs name it, where return is a word of the language
Move: TypeAlias = Annotated[Literal["rise", "dwell", "return", "return_"], Meta(description="what the follower does")]


class PhaseTable(Struct, forbid_unknown_fields=True):
    """A phase of the motion; together they make 360 degrees, from cam angle 0."""

    move: Move
    angle_deg: Annotated[float, degrees("cam angle of the phase", above=0, most=360)]
    law: PhaseLaw | LawTable | None = None
    share: Annotated[float, Meta(gt=0, le=1, description="of the lift, in this phase")] = 1.0


def turn(back: LawName) -> list[dict[str, object]]:
    """Phases to start from, as a scene has them; ``back``: law of the return."""
    rest: dict[str, object] = {"move": "dwell", "angle_deg": 60.0}
    rise, fall = ({"move": move, "angle_deg": 120.0} for move in ("rise", "return"))
    return [{**rise, "law": "sine"}, rest, {**fall, "law": back}, rest]


# keys that several kinds of cams have
Follower = Annotated[
    Literal["pointed", "roller", "mushroom", "flat"],
    Meta(description="shape of the follower's end", examples=["roller"]),
]
Lift = Annotated[float, part_mm("lift H of a translating follower", least=0), start(20.0)]
Swing = Annotated[float, degrees("swing of an oscillating follower", least=0, below=180)]
Phases = Annotated[list[PhaseTable], Meta(min_length=1, max_length=100)]
# a row of a table of the motion: the cam angle, where the follower stands
_Told = Annotated[float, Meta(ge=-MOST_LENGTH, le=MOST_LENGTH)]
MotionRow = tuple[_Told, _Told]
MotionTable = Annotated[
    list[MotionRow],
    Meta(
        min_length=3,
        max_length=2000,
        description='in place of phases: [cam angle deg, lift mm or deg], or { file = "lift.csv" }',
        examples=[[[0.0, 0.0], [120.0, 10.0], [240.0, 5.0]]],
    ),
]
TableTolerance = Annotated[
    float,
    Meta(
        ge=0,
        le=1000,
        description="motion_table: how far its rows may be left, mm or deg, so that a measured motion runs smoothly",
    ),
]
FollowerRadius = Annotated[float, part_mm("radius of the roller or mushroom", least=0), start(8.0)]
_BASE_CIRCLE = (
    "base circle, where S = 0; default: the least by least_transmission_angle_deg, of a flat follower by "
    "least_curvature_radius"
)
BaseCircle = Annotated[float, part_mm(_BASE_CIRCLE, above=0), start(30.0)]
LeastTransmission = Annotated[
    float,
    degrees(
        "gamma_min = 90 - pressure angle: on the rise, of a swinging roller on the return too; flat: 45",
        above=0,
        below=90,
        example=60.0,
    ),
]
_LEAST_RETURN = "gamma_min on the return; 0 is any, the default but of a swinging roller, whose is that of the rise"
LeastReturn = Annotated[float, degrees(_LEAST_RETURN, least=0, below=90, example=20.0)]
LeastCurvature = Annotated[float, part_mm("rho: least convex radius of the cam", least=0)]
FollowerOffset = Annotated[
    float, part_mm("line of motion at x = e; e > 0 lowers the pressure angle of the rise", least=-MOST_LENGTH)
]


class Stroke(Protocol):
    """Keys of a follower that slides or swings."""

    lift: float
    swing_deg: float


class Moved(Stroke, Protocol):
    """Keys of a follower's motion over a turn."""

    phases: list[PhaseTable] | None
    motion_table: list[MotionRow] | None
    table_tolerance: float


class MovingPhase(Protocol):
    """A phase over an angle or a way."""

    move: Move
    law: PhaseLaw | LawTable | None
    share: float


def stroke_key(swings: bool) -> tuple[str, float]:
    """The key of a follower's travel, and its unit in mm or rad."""
    return ("swing_deg", math.radians(1.0)) if swings else ("lift", 1.0)


def motion_of(keys: Moved, swings: bool) -> FollowerMotion:
    """The follower's motion from its keys, mm, or rad of one that swings.

    Raises
    ------
    ParameterError
        Both or neither of phases and table, or a motion that cannot be.
    """
    from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
    from geometry.cams.motion.joins import with_joins

    key, unit = stroke_key(swings)
    lift: float = getattr(keys, key)
    phases, table = keys.phases, keys.motion_table
    if table is not None:
        if phases is not None:
            raise ParameterError("phases", None, "phases_or_table", Nearest(None) if lift == 0 else None)
        if lift != 0:
            raise ParameterError(key, lift, "lift_in_table", Nearest(0.0))
        try:
            return _tabled(tuple(table), unit, keys.table_tolerance)
        except ParameterError as refusal:
            # a lift of a row, and what it may be left by, stand in the unit of its key
            in_unit = refusal.name.endswith("[2]") or refusal.name == "table_tolerance"
            raise refusal.renamed(refusal.name, 1 / unit if in_unit else None) from refusal
    check_idle(idle_tolerance(keys))
    if phases is None:
        raise ParameterError("phases", None, "phases_or_table")
    if not lift > 0:
        raise ParameterError(key, lift, "no_lift")
    lift *= unit
    made = []
    for index, phase in enumerate(phases):
        angle = math.radians(phase.angle_deg)
        if phase.move == "dwell":
            check_dwell(phase, index)
            made.append(dwell(angle))
            continue
        law = law_of(phase.law, f"phases[{index + 1}].law")
        made.append((rise if phase.move == "rise" else return_)(angle, phase.share * lift, law))
    _check_whole_turn(phases)
    _check_return(phases)
    return follower_motion(with_joins(made, closed=True))


# trials of another key of the cam ask for it, and a smoothed table of a thousand rows takes 60 ms
@lru_cache(maxsize=16)
def _tabled(table: tuple[tuple[float, float], ...], unit: float, tolerance: float) -> FollowerMotion:
    """The motion of a table whose lifts, and what they may be left by, stand in a unit."""
    from geometry.cams.motion.follower_motion import motion_of_table

    return motion_of_table([math.radians(a) for a, _ in table], [s * unit for _, s in table], tolerance * unit)


def steep(steepest: float, usual: float, code: str = "steep_pressure_angle") -> list[Finding]:
    """The remark that a pressure angle is greater than usual, degrees."""
    return [Finding(code, steepest, usual)] if steepest > usual + 1e-9 else []


def stroke_quantity(lift: float, *, swings: bool) -> dict[str, float]:
    """A follower's travel, mm or rad, under its key."""
    return {"swing_deg": math.degrees(lift)} if swings else {"lift": lift}


def table_quantities(motion: FollowerMotion, *, swings: bool) -> dict[str, float]:
    """How far a smoothed motion leaves the rows of its table, mm or degrees; nothing of another one."""
    if motion.left_rows is None:
        return {}
    return {"table_deviation_deg": math.degrees(motion.left_rows)} if swings else {"table_deviation": motion.left_rows}


def idle_tolerance(keys: Moved) -> Iterator[ParameterError]:
    """The tolerance of a table that is not given."""
    if keys.motion_table is None:
        yield from in_vain(keys, ("table_tolerance",), "tolerance_without_table")


def idle_motion(keys: Moved, swings: bool, table: str = "oscillating") -> Iterator[ParameterError]:
    """What is of another follower's travel, or of a table that is not given; see ``idle_stroke``."""
    yield from idle_stroke(keys, swings, tabled=keys.motion_table is not None, table=table)
    yield from idle_tolerance(keys)


def idle_stroke(keys: Stroke, swings: bool, *, tabled: bool, table: str = "oscillating") -> Iterator[ParameterError]:
    """A follower has a lift or a swing: the other one, without which it moves where the right one is given too.

    ``table``: the key of its arm, "" where it is none of its own; ``tabled``: a table holds its motion.
    """
    key, other = ("lift", "swing_deg") if swings else ("swing_deg", "lift")
    value = getattr(keys, key)
    if value == 0:
        return
    code = "swing_without_arm" if table and not swings else "stroke_of_another"
    works = Nearest(0.0) if tabled or getattr(keys, other) != 0 else None
    yield ParameterError(key, value, code, works, other=other, table=table)


def check_dwell(phase: MovingPhase, index: int) -> None:
    """A dwell has neither law nor share; refused by the one that it has."""
    place = f"phases[{index + 1}]"
    if phase.law is not None and phase.share != 1:
        raise ParameterError(f"{place}.move", "dwell", "dwell_with_law")
    if phase.law is not None:
        law = phase.law if isinstance(phase.law, str) else None
        raise ParameterError(f"{place}.law", law, "dwell_with_law", Nearest(None))
    if phase.share != 1:
        raise ParameterError(f"{place}.share", phase.share, "dwell_with_law", Nearest(1.0))


class RoughLaw(Record):
    """A law whose velocity jumps at an end of its phase: its key, its name if it has one, and whether it alone does."""

    key: str
    law: str | None
    alone: bool

    def cure(self, whole: Callable[[str], bool]) -> Cure:
        """A law at rest at its ends in its place, where ``whole`` holds of the part with it."""
        if not self.alone:
            return None
        return lambda: Nearest(LAW_AT_REST) if kept(whole, LAW_AT_REST) else None


def rough_law(keys: Sequence[MovingPhase], phases: Sequence[Phase], calm: Callable[[str], bool]) -> RoughLaw | None:
    """The first law that moves at an end of its phase; before it the first that alone makes the velocity jump.

    ``calm``: whether nothing jumps any more with ``LAW_AT_REST`` at a key.
    """
    rough = []
    for index, phase in enumerate(phases):
        ends = () if phase.law is None else ((phase.law.pieces[0], 0.0), (phase.law.pieces[-1], 1.0))
        if any(abs(float(piece.value(at, 1))) > _ROUGH for piece, at in ends):
            law, key = keys[index].law, f"phases[{index + 1}].law"
            rough.append(RoughLaw(key, law if isinstance(law, str) else None, False))
    alone = next((law for law in rough if kept(calm, law.key)), None)
    return replace(alone, alone=True) if alone else next(iter(rough), None)


def _check_whole_turn(phases: list[PhaseTable]) -> None:
    """The phases fill one turn; else refused by the last one that can, or one that is far too short, with what fits."""
    angles = [p.angle_deg for p in phases]
    whole = math.fsum(angles)
    if abs(whole - 360) <= _CLOSING_DEG:
        return
    index = next((k for k in reversed(range(len(angles))) if angles[k] + 360 - whole > 0), 0)
    if whole < 360 and _FAR_SHORTER * min(angles) < angles[index]:
        index = angles.index(min(angles))
    fitting = round(angles[index] + 360 - whole, 9)
    works = Nearest(fitting) if fitting > 0 else None
    key, off = f"phases[{index + 1}].angle_deg", round(abs(whole - 360), 9)
    raise ParameterError(key, angles[index], "phases_not_a_turn", works, whole=whole, off=off)


def _check_return(phases: list[PhaseTable]) -> None:
    """Rises and returns cancel; else refused with the share of one of them that makes them do."""
    signs = [{"rise": 1, "dwell": 0}.get(p.move, -1) for p in phases]
    total = math.fsum(sign * p.share for sign, p in zip(signs, phases, strict=True))
    if abs(total) <= 1e-12:
        return
    for index in reversed(range(len(phases))):
        sign, own = signs[index], phases[index].share
        fitting = round(own - sign * total, 12)
        if sign and 0 < fitting <= 1:
            raise ParameterError(f"phases[{index + 1}].share", own, "does_not_come_back", Nearest(fitting))
    rest = next((k for k, p in reversed(list(enumerate(phases))) if p.move == "dwell"), None)
    if rest is not None:
        raise ParameterError(f"phases[{rest + 1}].move", "dwell", "does_not_come_back")
    one_way = next(k for k in reversed(range(len(phases))) if signs[k] * total > 0)
    other = Nearest("return" if total > 0 else "rise")
    raise ParameterError(f"phases[{one_way + 1}].move", phases[one_way].move, "does_not_come_back", other)

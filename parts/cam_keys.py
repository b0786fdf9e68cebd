"""Scene keys of a follower's motion: phases with their laws, or a table."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any, Literal

from msgspec import Meta, Struct

from geometry.errors import ParameterError
from parts.keys import mm
from parts.law_keys import LawName, LawTable, law_of

if TYPE_CHECKING:
    from geometry.cams.disk import DiskCam
    from geometry.cams.follower_motion import FollowerMotion

__all__ = [
    "FollowerOffset",
    "LawName",
    "Lift",
    "MotionTable",
    "PhaseTable",
    "Phases",
    "Swing",
    "check_stroke",
    "in_degrees",
    "motion_of",
    "without_base",
]
_MOST = 100_000.0
# angles that miss a turn by less are closed by the last phase, degrees
_CLOSING_DEG = 5e-8


class PhaseTable(Struct, forbid_unknown_fields=True):
    """A phase of the motion; together they make 360 degrees, from cam angle 0."""

    move: Annotated[Literal["rise", "dwell", "return_"], Meta(description="what the follower does")]
    angle_deg: Annotated[float, Meta(gt=0, le=360, description="cam angle of the phase", extra={"unit": "degrees"})]
    law: LawName | LawTable | None = None
    share: Annotated[float, Meta(gt=0, le=1, description="of the lift, in this phase")] = 1.0


# keys that several kinds of cams have
Lift = Annotated[float, mm("lift H of a translating follower", least=0, most=_MOST)]
Swing = Annotated[float, Meta(ge=0, lt=180, description="swing of an oscillating follower", extra={"unit": "degrees"})]
Phases = Annotated[list[PhaseTable], Meta(min_length=1, max_length=100)]
MotionTable = Annotated[
    list[tuple[float, float]],
    Meta(min_length=3, max_length=2000, description="in place of phases: [cam angle deg, lift mm or deg]"),
]
FollowerOffset = Annotated[float, mm("line of motion at x = e; e > 0 eases the rise", least=-_MOST, most=_MOST)]


def motion_of(
    phases: list[PhaseTable] | None, table: list[tuple[float, float]] | None, lift: float, lift_key: str
) -> FollowerMotion:
    """The follower's motion from its keys; ``lift`` in mm, or rad of an oscillating follower.

    Raises
    ------
    ParameterError
        Both or neither of phases and table, or a motion that cannot be.
    """
    from geometry.cams.follower_motion import dwell, follower_motion, motion_of_table, return_, rise

    if (phases is None) == (table is None):
        raise ParameterError("phases", None, "give either phases or motion_table")
    if table is not None:
        if lift != 0:
            raise ParameterError(lift_key, lift, "the table holds the lift; 0 works")
        return motion_of_table([math.radians(a) for a, _ in table], [s for _, s in table])
    if not lift > 0:
        raise ParameterError(lift_key, lift, "phases need a lift above 0")
    made = []
    for index, phase in enumerate(phases or ()):
        angle = math.radians(phase.angle_deg)
        if phase.move == "dwell":
            check_dwell(phase, index)
            made.append(dwell(angle))
            continue
        law = law_of(phase.law, f"phases.item {index + 1}.law")
        made.append((rise if phase.move == "rise" else return_)(angle, phase.share * lift, law))
    _check_whole_turn(phases or [])
    _check_return(phases or [])
    return follower_motion(made)


def check_stroke(spec: Any, swings: bool, table: str = "oscillating") -> None:
    """A follower has a lift or a swing; ``table``: the key of its arm, "" where it is none of its own.

    Raises
    ------
    ParameterError
        Offers the other one in its place, unless that is given too.
    """
    key, other = ("lift", "swing_deg") if swings else ("swing_deg", "lift")
    value = getattr(spec, key)
    if value == 0:
        return
    reason = f"this follower has {other} instead"
    if table and not swings:
        reason += f"; swing_deg belongs to the table {table}"
    given = getattr(spec, other) != 0 or getattr(spec, "motion_table", None) is not None
    works = "0 works" if given else f"with {key} = 0, {other} = {value:.12g} it works"
    raise ParameterError(key, value, f"{reason}; {works}")


def in_degrees(value: object) -> object:
    """A refused angle of the mathematics as it was typed; what is no number stays."""
    return math.degrees(value) if isinstance(value, float) else value


def check_dwell(phase: Any, index: int) -> None:
    """A dwell has neither law nor share; refused by the one that it has."""
    has_law, has_share = phase.law is not None, phase.share != 1
    place = f"phases.item {index + 1}"
    if has_law and has_share:
        text = f"a dwell has neither law nor share; with no {place}.law, no {place}.share it works"
        raise ParameterError(f"{place}.move", "dwell", text)
    if has_law:
        law = phase.law if isinstance(phase.law, str) else None
        raise ParameterError(f"{place}.law", law, "a dwell has neither law nor share; remove it")
    if has_share:
        raise ParameterError(f"{place}.share", phase.share, "a dwell has neither law nor share; remove it")


def _check_whole_turn(phases: list[PhaseTable]) -> None:
    """The phases fill one turn; else refused with the angle of one of them, the last that can, that makes them do."""
    whole = math.fsum(p.angle_deg for p in phases)
    if abs(whole - 360) <= _CLOSING_DEG:
        return
    reason = f"the phases make {whole:.9g} degrees together, not 360"
    for index in reversed(range(len(phases))):
        own = phases[index].angle_deg
        fitting = round(own + 360 - whole, 9)
        if fitting > 0:
            raise ParameterError(f"phases.item {index + 1}.angle_deg", own, f"{reason}; {fitting:.12g} degrees works")
    # no single one does: all in proportion
    shares = [float(f"{p.angle_deg * 360 / whole:.4g}") for p in phases[:-1]]
    told = [*shares, round(360 - math.fsum(shares), 9)]
    text = ", ".join(f"phases.item {k + 1}.angle_deg = {value:.12g}" for k, value in enumerate(told))
    raise ParameterError("phases.item 1.angle_deg", phases[0].angle_deg, f"{reason}; with {text} it works")


def _check_return(phases: list[PhaseTable]) -> None:
    """Rises and returns cancel; else refused with the share of one of them that makes them do."""
    signs = {"rise": 1, "dwell": 0, "return_": -1}
    total = math.fsum(signs[p.move] * p.share for p in phases)
    if abs(total) <= 1e-12:
        return
    reason = "rises and returns must cancel: the follower has to come back"
    for index in reversed(range(len(phases))):
        sign, own = signs[phases[index].move], phases[index].share
        fitting = round(own - sign * total, 12)
        if sign and 0 < fitting <= 1:
            raise ParameterError(f"phases.item {index + 1}.share", own, f"{reason}; {fitting:.12g} works")
    one_way = next(k for k, p in reversed(list(enumerate(phases))) if signs[p.move] * total > 0)
    other = "return_" if total > 0 else "rise"
    rest = next((k for k, p in reversed(list(enumerate(phases))) if p.move == "dwell"), None)
    if rest is not None:
        place = f"phases.item {rest + 1}"
        text = f'{reason}; with {place}.move = "{other}", {place}.law = "sine" it works'
        raise ParameterError(f"{place}.move", "dwell", text)
    raise ParameterError(f"phases.item {one_way + 1}.move", phases[one_way].move, f'{reason}; "{other}" works')


def without_base(cam: DiskCam) -> str:
    """What helps an undercut cam that no base circle does, in words."""
    if any(joint.impact == "rigid" for joint in cam.motion.impacts()):
        return 'a law without rigid impacts, as law = "sine", or follower = "pointed" works'
    if cam.radius == 0:
        return "a smaller lift or longer phases work"
    return "a smaller lift, longer phases or a smaller follower_radius work"

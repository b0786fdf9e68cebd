"""Scene keys of a follower's motion: phases with their laws, or a table."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal

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
    "in_degrees",
    "motion_of",
    "without_base",
]
_MOST = 100_000.0


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
            if phase.law is not None or phase.share != 1:
                raise ParameterError(f"phases.item {index + 1}.move", "dwell", "a dwell has neither law nor share")
            made.append(dwell(angle))
            continue
        law = law_of(phase.law, f"phases.item {index + 1}.law")
        made.append((rise if phase.move == "rise" else return_)(angle, phase.share * lift, law))
    return follower_motion(made)


def in_degrees(value: object) -> object:
    """A refused angle of the mathematics as it was typed; what is no number stays."""
    return math.degrees(value) if isinstance(value, float) else value


def without_base(cam: DiskCam) -> str:
    """What helps an undercut cam that no base circle does, in words."""
    if any(joint.impact == "rigid" for joint in cam.motion.impacts()):
        return 'a law without rigid impacts, as law = "sine", or follower = "pointed" works'
    if cam.radius == 0:
        return "a smaller lift or longer phases work"
    return "a smaller lift, longer phases or a smaller follower_radius work"

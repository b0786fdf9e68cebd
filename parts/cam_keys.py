"""Scene keys of a follower's motion: phases, laws by name or by their acceleration diagram, tables."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from geometry.errors import ParameterError

if TYPE_CHECKING:
    from geometry.cams.follower_motion import FollowerMotion
    from geometry.motion_laws.diagram import Stretch
    from geometry.motion_laws.law import Law

LawName = Literal[
    "constant_velocity",
    "constant_acceleration",
    "linearly_decreasing",
    "cosine",
    "sine",
    "trapezoid",
    "triangle",
    "modified_trapezoid",
    "modified_sine",
    "polynomial_345",
    "polynomial_4567",
    "gutman_13",
]
Width = Annotated[float, Meta(gt=0, le=1e6, description="width, any scale")]
Ordinate = Annotated[float, Meta(ge=-1e6, le=1e6, description="ordinate, any scale; below the axis negative")]
Share = Annotated[float, Meta(ge=0, le=1, description="share of the width")]


class ConstantTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="constant"):
    """Horizontal segment of the acceleration diagram."""

    width: Width
    ordinate: Ordinate


class LinearTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="linear"):
    """Sloping segment."""

    width: Width
    first: Ordinate
    last: Ordinate


class HalfSineTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="half_sine"):
    """0, the peak, 0."""

    width: Width
    peak: Ordinate


class QuarterSineTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="quarter_sine"):
    """0 to the peak, where it is horizontal."""

    width: Width
    peak: Ordinate


class QuarterCosineTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="quarter_cosine"):
    """Horizontal at the peak, down to 0."""

    width: Width
    peak: Ordinate


class HalfCosineTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="half_cosine"):
    """Horizontal at both ends."""

    width: Width
    first: Ordinate
    last: Ordinate


class TrapezoidTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="trapezoid"):
    """0, ramp, level, ramp, 0."""

    width: Width
    ordinate: Ordinate
    up: Share
    down: Share | None = None


class PointsTable(Struct, forbid_unknown_fields=True, tag_field="shape", tag="points"):
    """A cubic spline through points (place, ordinate)."""

    width: Width
    points: Annotated[list[tuple[float, float]], Meta(min_length=2, max_length=2000, description="[place, ordinate]")]


StretchTable = (
    ConstantTable
    | LinearTable
    | HalfSineTable
    | QuarterSineTable
    | QuarterCosineTable
    | HalfCosineTable
    | TrapezoidTable
    | PointsTable
)


class DiagramTable(Struct, forbid_unknown_fields=True):
    """A law of one's own: its acceleration diagram, in any scale."""

    diagram: Annotated[list[StretchTable], Meta(min_length=1, max_length=200, description="segments side by side")]
    balance: Annotated[bool, Meta(description="scale what lies below the axis so that the diagram closes")] = False


class PhaseTable(Struct, forbid_unknown_fields=True):
    """A phase of the motion; together they make 360 degrees, from cam angle 0."""

    move: Annotated[Literal["rise", "dwell", "return_"], Meta(description="what the follower does")]
    angle_deg: Annotated[float, Meta(gt=0, le=360, description="cam angle of the phase", extra={"unit": "degrees"})]
    law: LawName | DiagramTable | None = None
    share: Annotated[float, Meta(gt=0, le=1, description="of the lift, in this phase")] = 1.0


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
        law = _law_of(phase.law, index)
        made.append((rise if phase.move == "rise" else return_)(angle, phase.share * lift, law))
    return follower_motion(made)


def _law_of(law: LawName | DiagramTable | None, index: int) -> Law:
    from geometry.motion_laws.diagram import law_of_diagram
    from geometry.motion_laws.named import NAMED_LAWS

    place = f"phases.item {index + 1}.law"
    if law is None:
        raise ParameterError(place, None, f"is missing; one of {', '.join(NAMED_LAWS)}, or {{ diagram = [...] }}")
    if isinstance(law, str):
        return NAMED_LAWS[law]()
    try:
        stretches = [s for table in law.diagram for s in _stretches(table)]
        return law_of_diagram("own diagram", stretches, balance=law.balance)
    except ParameterError as refusal:
        raise ParameterError(f"{place}.{refusal.name}", refusal.value, refusal.allowed) from refusal


def _stretches(table: StretchTable) -> list[Stretch]:
    from geometry.motion_laws import diagram

    width = table.width
    if isinstance(table, ConstantTable):
        return [diagram.constant(width, table.ordinate)]
    if isinstance(table, LinearTable):
        return [diagram.linear(width, table.first, table.last)]
    if isinstance(table, HalfSineTable):
        return [diagram.half_sine(width, table.peak)]
    if isinstance(table, QuarterSineTable):
        return [diagram.quarter_sine(width, table.peak)]
    if isinstance(table, QuarterCosineTable):
        return [diagram.quarter_cosine(width, table.peak)]
    if isinstance(table, HalfCosineTable):
        return [diagram.half_cosine(width, table.first, table.last)]
    if isinstance(table, TrapezoidTable):
        return diagram.trapezoid(width, table.ordinate, table.up, table.down)
    return diagram.tabulated(width, [p for p, _ in table.points], [a for _, a in table.points])

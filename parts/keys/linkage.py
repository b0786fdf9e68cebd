"""Scene keys of a linkage that carries a follower on its coupler: the driven member, the guiding one, the coupler."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from parts.keys.base import MOST_LENGTH, degrees, mm, part_mm

if TYPE_CHECKING:
    from geometry.kinematics.linkage import Drive, Guide

Coordinate = Annotated[float, part_mm("a coordinate", least=-MOST_LENGTH)]
Direction = Annotated[float, degrees("of the guide, from +x counter-clockwise", least=-360, most=360)]

_START_ANGLE = degrees("at S = 0, from +x counter-clockwise", least=-360, most=360, example=167.0)
_SENSE = Meta(description="how the rocker turns while the follower rises")


class DrivenRocker(Struct, forbid_unknown_fields=True, tag_field="member", tag="rocker"):
    """Rocker with joint A at its end, whose angle is start_angle_deg and the motion."""

    pivot: Annotated[tuple[Coordinate, Coordinate], mm("x, y of its pivot", example=[91.0, 26.0])]
    length: Annotated[float, part_mm("from the pivot to joint A", above=0, example=58.0)]
    start_angle_deg: Annotated[float, _START_ANGLE]
    sense: Annotated[Literal["counter_clockwise", "clockwise"], _SENSE] = "clockwise"


class DrivenSlider(Struct, forbid_unknown_fields=True, tag_field="member", tag="slider"):
    """Slider with joint A, which stands at start and moves by the motion."""

    start: Annotated[tuple[Coordinate, Coordinate], mm("x, y of joint A at S = 0", example=[25.0, 30.0])]
    direction_deg: Direction = 90.0


_ASSEMBLY = Meta(description="side of the line from joint A to the pivot on which B stands")


class GuidingRocker(Struct, forbid_unknown_fields=True, tag_field="member", tag="rocker"):
    """Rocker with joint B at its end."""

    pivot: Annotated[tuple[Coordinate, Coordinate], mm("x, y of its pivot", example=[62.0, 124.0])]
    length: Annotated[float, part_mm("from the pivot to joint B", above=0, example=68.0)]
    assembly: Annotated[Literal["left", "right"], _ASSEMBLY] = "left"


_GUIDING_SLIDER_ASSEMBLY = Meta(description="B ahead of joint A's foot on the line or behind it")


class GuidingSlider(Struct, forbid_unknown_fields=True, tag_field="member", tag="slider"):
    """Slider with joint B on a line."""

    through: Annotated[tuple[Coordinate, Coordinate], mm("x, y of any point of the line", example=[0.0, 60.0])]
    direction_deg: Direction = 0.0
    assembly: Annotated[Literal["forward", "backward"], _GUIDING_SLIDER_ASSEMBLY] = "forward"


def drive_of(table: DrivenRocker | DrivenSlider) -> Drive:
    """The member that the motion drives."""
    from geometry.kinematics.linkage import RockerDrive, SliderDrive

    if isinstance(table, DrivenSlider):
        return SliderDrive(complex(*table.start), math.radians(table.direction_deg))
    sense = -1 if table.sense == "clockwise" else 1
    return RockerDrive(complex(*table.pivot), table.length, math.radians(table.start_angle_deg), sense)


def guide_of(table: GuidingRocker | GuidingSlider) -> Guide:
    """The member that guides joint B."""
    from geometry.kinematics.linkage import RockerGuide, SliderGuide

    if isinstance(table, GuidingSlider):
        side = 1 if table.assembly == "forward" else -1
        return SliderGuide(complex(*table.through), math.radians(table.direction_deg), side)
    return RockerGuide(complex(*table.pivot), table.length, 1 if table.assembly == "left" else -1)

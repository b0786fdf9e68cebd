"""Scene keys of the part kind ``barrel_cam``."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta, Struct

from parts.base.part_keys import MaterialKeys
from parts.keys.base import MOST_LENGTH, BoreDiameter, degrees, mm, part_mm, start
from parts.keys.cam import MotionTable, Phases, Swing, TableTolerance, turn
from parts.keys.holes import BoreTable
from parts.keys.law import with_own_laws
from parts.keys.wheel import HubTable

_PIVOT_OFFSET = part_mm(
    "from the cam's axis to the pivot, square to the roller's axis; above 0 the cam's surface runs "
    "towards it; default: the roller strays as far to either side",
    least=-MOST_LENGTH,
    example=40.0,
)
_START_ANGLE = degrees(
    "arm above the plane across the axis where the phases begin; default: half the swing below",
    above=-90,
    below=90,
    example=-10.0,
)


class SwingingTable(Struct, forbid_unknown_fields=True):
    """A follower that swings about a pivot parallel to its roller's axis, beside the cam."""

    arm_length: Annotated[float, part_mm("from the pivot to the roller's axis", above=0, example=40.0)]
    pivot_offset: Annotated[float, _PIVOT_OFFSET] | None = None
    start_angle_deg: Annotated[float, _START_ANGLE] | None = None


_ROLLER_DIAMETER = part_mm(
    "diameter of the roller, its axis across the cam's; of a cone at the barrel's outer radius", above=0, example=10.0
)
_CONE_ANGLE = degrees(
    "between opposite sides of a conical roller; default: its apex lies on the cam's axis",
    above=0,
    below=120,
    example=20.0,
)
_LENGTH = part_mm("length of the barrel; default: the groove and end_margin", above=0, example=60.0)
_END_MARGIN = part_mm("material between the groove and each end; default: the roller's radius", least=0.01, example=8.0)
_FORM = Meta(description="groove: moves the roller both ways; end: a spring holds it", examples=["groove"])
_ROLLER_FORM = Meta(description="conical: thinner towards the cam's axis, so that it rolls and hardly slides")


class BarrelCamSpec(MaterialKeys, forbid_unknown_fields=True, tag_field="kind", tag="barrel_cam"):
    """Keys of ``barrel_cam``."""

    form: Annotated[Literal["groove", "end"], _FORM]
    outer_diameter: Annotated[float, part_mm("diameter of the barrel", above=0, example=60.0)]
    roller_diameter: Annotated[float, _ROLLER_DIAMETER]
    groove_depth: Annotated[float, part_mm("depth of the groove, or width of the track", least=0.01, example=8.0)]
    roller_form: Annotated[Literal["cylindrical", "conical"], _ROLLER_FORM] = "cylindrical"
    cone_angle_deg: Annotated[float, _CONE_ANGLE] | None = None
    lift: Annotated[float, part_mm("lift H along the axis", least=0), start(20.0)] = 0.0
    swing_deg: Swing = 0.0
    phases: Annotated[Phases, with_own_laws(turn("polynomial_345"))] | None = None
    motion_table: MotionTable | None = None
    table_tolerance: TableTolerance = 0.0
    oscillating: SwingingTable | None = None
    clearance: Annotated[float, mm("groove wider than the roller by this", least=0, most=100)] = 0.0
    length: Annotated[float, _LENGTH] | None = None
    end_margin: Annotated[float, _END_MARGIN] | None = None
    web_thickness: Annotated[float, part_mm("end: bottom of the tube; 0 leaves it open", least=0)] = 0.0
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    hub: HubTable | None = None

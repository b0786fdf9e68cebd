"""The keys of ``higherpair calc lever``."""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta

from parts.keys.base import degrees, mm, size
from parts.keys.levers import MOST, Assignment, Code, MechanismTable, Variant
from parts.keys.sheet import PaperName
from parts.keys.title import TitleBlockKey
from parts.mates.pages.lever_picture import LARGE_ROOM, ROOM

_TWIN = "direction of the guide of a second, equal slider on the same crank, as of a compressor: links 4 and 5"
_MASS = "AS2 / AB: centre of mass, or any point, of the rod AB: its velocity, acceleration, and its path in the picture"

_MASSES = "substitute masses of the links at A, B, C, D: point_masses.D=12; A is of the crank, B and C of link 3"
_LINK_MASSES = "masses of links by their numbers, beside those at points: masses.2=12"
_INERTIAS = "moments of inertia of links about their centres of mass: inertias.3=0.8"
_CENTRES = (
    "centres of mass along links from O1, A, O3, C or O5, of a slider from its pin: centres.3=250; where none is "
    "given, the middle of a rod or lever, O1 of the crank, the pin of a slider"
)
_OFFSETS = "how far centres of mass lie to the left of their links: centre_offsets.3=40"
_FORCE = "useful resistance on the slider, against its motion"
_MOMENT = "moment of the useful resistance on the lever or rocker that is the output, against its motion"
_WAYS = "along which way of its guide the slider is resisted; forward of a rocker is counter-clockwise"
_TOOTHED = "pitch radius of the wheel on the crank's shaft by which it is driven; none: by a coupling, a moment alone"
_SHEET = (
    "DXF, SVG or PDF file of the coursework's sheet to write: scheme in all positions, plans, diagrams, forces and "
    "Zhukovsky's lever, each to its scale"
)
_PAPER = "size of the sheet's paper; default: A3 or A2 where one sheet of it holds all drawings, else A1"
_DRAWN = "length of the crank on the drawing; default: 30 mm, on a sheet what gives a round scale"
_SECOND = "number of another position whose plans the sheet has too"
_MEASURED = (
    "lengths that you measured on your own plans, drawn to the scales of velocity_scale and acceleration_scale, by "
    "the names of their vectors, pi for π: measured.pd=35.8 measured.pid=0.1"
)
_Mass = Annotated[float, Meta(ge=0, le=1e9, extra={"unit": "kg"})]
_Inertia = Annotated[float, Meta(ge=0, le=1e9, extra={"unit": "kg*m2"})]
_OnPaper = Annotated[float, Meta(ge=0, le=10_000, extra={"unit": "mm"})]
_Place = Annotated[float, Meta(ge=-MOST, le=MOST, extra={"unit": "mm"})]


_DRIVE_ANGLE = degrees("direction from O1 to the axis of the wheel that drives it", least=-360, most=360)


class LeverKeys(MechanismTable, kw_only=True, forbid_unknown_fields=True):
    """Keys of the topic; those of an assignment stand for what is not given."""

    code: Code = None
    assignment: Assignment = None
    variant: Variant = None
    start_angle_deg: Annotated[float, degrees("angle of the crank from +x", least=-36_000, most=36_000)] = 0.0
    speed: Annotated[float, size("rad/s", "angular velocity of the crank", above=0, most=1e6)] = 1.0
    speed_rpm: Annotated[float, size("rpm", "the same in place of speed", above=0, most=1e7)] | None = None
    acceleration: Annotated[float, size("rad/s2", "angular acceleration of the crank", least=-1e9, most=1e9)] = 0.0
    second_guide_angle_deg: Annotated[float, degrees(_TWIN, least=-360, most=360)] | None = None
    mass_point: Annotated[float, Meta(ge=0, le=1, description=_MASS)] | None = None
    point_masses: Annotated[dict[str, _Mass], Meta(description=_MASSES)] | None = None
    masses: Annotated[dict[str, _Mass], Meta(description=_LINK_MASSES)] | None = None
    inertias: Annotated[dict[str, _Inertia], Meta(description=_INERTIAS)] | None = None
    centres: Annotated[dict[str, _Place], Meta(description=_CENTRES)] | None = None
    centre_offsets: Annotated[dict[str, _Place], Meta(description=_OFFSETS)] | None = None
    gravity: Annotated[float, size("m/s2", "0 where the mechanism lies flat", least=0, most=1e3)] = 9.81
    gravity_angle_deg: Annotated[float, degrees("direction of gravity", least=-360, most=360)] = -90.0
    resistance: Annotated[float, size("N", _FORCE, above=0, most=1e9)] | None = None
    resisting_moment: Annotated[float, size("N*m", _MOMENT, above=0, most=1e9)] | None = None
    resisted: Annotated[Literal["forward", "backward", "both"], Meta(description=_WAYS)] = "both"
    drive_radius: Annotated[float, mm(_TOOTHED, above=0, most=MOST)] | None = None
    drive_pressure_angle_deg: Annotated[float, degrees("working pressure angle of that wheel", least=0, most=60)] = 20.0
    drive_angle_deg: Annotated[float, _DRIVE_ANGLE] = -90.0
    unevenness: Annotated[float, Meta(gt=0, le=0.5, description="delta: gives the flywheel")] | None = None
    positions: Annotated[int, Meta(ge=2, le=720, description="positions of the crank in the table")] = 12
    drawn_crank: Annotated[float, mm(_DRAWN, above=0, most=1000)] | None = None
    velocity_scale: Annotated[float, Meta(gt=0, le=1e6, description="m/s for 1 mm of the plan")] | None = None
    acceleration_scale: Annotated[float, Meta(gt=0, le=1e9, description="m/s2 for 1 mm of the plan")] | None = None
    measured: Annotated[dict[str, _OnPaper], Meta(description=_MEASURED)] | None = None
    force_scale: Annotated[float, Meta(gt=0, le=1e12, description="N for 1 mm of the plans of forces")] | None = None
    picture: Annotated[str, Meta(description="SVG file of scheme, plans and diagrams to write")] | None = None
    sheet: Annotated[str, Meta(description=_SHEET)] | None = None
    paper: Annotated[PaperName, Meta(description=_PAPER)] | None = None
    title_block: TitleBlockKey = True
    second_position: Annotated[int, Meta(ge=1, le=719, description=_SECOND)] | None = None


def room_of(keys: LeverKeys) -> float:
    """Room of the longest vector of a plan, mm."""
    return LARGE_ROOM if keys.sheet is not None and keys.paper in (None, "A1", "A0") else ROOM

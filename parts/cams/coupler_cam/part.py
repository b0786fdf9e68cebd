"""The part kind ``linkage_cam``: a disk cam whose follower is carried by the connecting rod of a linkage.

General plane motion of the follower: Savvin's synthesis of plane cams.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta

from geometry.base.errors import LateError, Nearest, ParameterError, UndercutError
from geometry.base.findings import Finding, beyond
from geometry.base.nearest import kept, nearest
from geometry.base.record import Record
from parts.base.kind import Others, Report
from parts.base.schema import replaced
from parts.cams.disk_cam.part import (
    USUAL_ROLLER_SHARE,
    DiskKind,
    cam_circles,
    check_face,
    idle_plate,
    largest_roller_radius,
    motion_findings,
    pressure_angles,
    undercut,
)
from parts.cams.wheel import DiskKeys, check_disk
from parts.keys.base import check_idle, degrees, mm, part_mm, start
from parts.keys.cam import (
    Follower,
    MotionRow,
    Phases,
    TableTolerance,
    idle_motion,
    motion_of,
    steep,
    stroke_key,
    stroke_quantity,
    table_quantities,
    turn,
)
from parts.keys.law import with_own_laws
from parts.keys.linkage import Coordinate, DrivenRocker, DrivenSlider, GuidingRocker, GuidingSlider, drive_of, guide_of

if TYPE_CHECKING:
    from geometry.cams.plane.coupler import LinkageCam

# usual limits, degrees: the pressure angle of a follower that turns, and the transmission angle of a linkage
_USUAL_PRESSURE_ANGLE, _USUAL_TRANSMISSION_ANGLE = 45.0, 40.0

_COUPLER_POINT = mm(
    "roller's centre, tip, arc's centre or a point of the face, from joint A, +x towards joint B", example=[6.0, 16.0]
)
_PLATE_DIAMETER = part_mm("width of a flat or mushroom face about coupler_point", above=0, example=60.0)
_MOTION_TABLE = Meta(
    min_length=3,
    max_length=2000,
    description='in place of phases: [cam angle deg, travel mm or deg], or { file = "lift.csv" }',
    examples=[[[0.0, 0.0], [120.0, 10.0], [240.0, 5.0]]],
)
_FOLLOWER_DIRECTION = degrees(
    "stem, or normal of a flat face, away from the cam, from the coupler's +x", least=-360, most=360
)


class LinkageCamSpec(DiskKeys, forbid_unknown_fields=True, tag_field="kind", tag="linkage_cam"):
    """Keys of ``linkage_cam``."""

    follower: Follower
    driven: DrivenRocker | DrivenSlider
    coupler_length: Annotated[float, part_mm("from joint A to joint B", above=0, example=43.0)]
    guide: GuidingRocker | GuidingSlider
    coupler_point: Annotated[tuple[Coordinate, Coordinate], _COUPLER_POINT]
    follower_direction_deg: Annotated[float, _FOLLOWER_DIRECTION] = 0.0
    follower_radius: Annotated[float, part_mm("radius of the roller or mushroom", least=0), start(6.0)] = 0.0
    plate_diameter: Annotated[float, _PLATE_DIAMETER] | None = None
    lift: Annotated[float, part_mm("travel of a driven slider", least=0)] = 0.0
    swing_deg: Annotated[float, degrees("swing of a driven rocker", least=0, below=180), start(24.0)] = 0.0
    phases: Annotated[Phases, with_own_laws(turn("sine"))] | None = None
    motion_table: Annotated[list[MotionRow], _MOTION_TABLE] | None = None
    table_tolerance: TableTolerance = 0.0
    least_curvature_radius: Annotated[float, part_mm("rho: least convex radius of the cam", least=0)] = 0.0


# what is tried of each key, nearest first: shares of a length, a part of its range, degrees either way
_SHORTER = (0.9, 0.7, 0.5, 0.3, 0.1, 0.02)
_BETWEEN = (0.01, 0.05, 0.15, 0.3, 0.5, 0.7)
_TURNS = tuple(turn * side for turn in (5, 15, 30, 45, 60, 75, 90, 120, 150, 180) for side in (-1, 1))
# keys that are asked for a refusal of the mathematics, the most natural one first
_ASKED: Mapping[str, Sequence[str]] = {
    "coupler_length": ("coupler_length", "stroke", "sense", "start"),
    "direction": ("direction",),
    "sense": ("direction", "sense"),
    "point": ("follower_radius", "direction", "start", "point"),
    "lift": ("stroke", "direction", "start"),
    "near": ("coupler_length", "stroke", "direction", "start"),
    "undercut": ("follower_radius", "stroke", "direction", "start", "point"),
}


class Asked(Record):
    """A key that may be to blame: its name and value, and values that are tried in its place."""

    name: str
    value: float | str | list[float]
    trials: Sequence[Any] = ()


def _to_blame(keys: LinkageCamSpec, refusal: ParameterError, whole: Callable[[LinkageCamSpec], bool]) -> ParameterError:
    """The refusal told of the first key of which another value gives a ``whole`` cam; else of the first key."""
    fault = "undercut" if isinstance(refusal, UndercutError) else refusal.name
    asked = [key for name in _ASKED[fault] if (key := _asked(keys, name, refusal)) is not None]
    for key in asked:
        found = _nearest(keys, key, whole)
        if found is not None:
            return refusal.told_of(key.name, key.value, found)
    return refusal.told_of(asked[0].name, asked[0].value, None)


def _nearest(keys: LinkageCamSpec, key: Asked, whole: Callable[[LinkageCamSpec], bool]) -> Nearest | None:
    def works(value: object) -> bool:
        return whole(replaced(keys, key.name, value))

    if isinstance(key.value, float):
        return nearest(works, key.value, key.trials)
    # a word has nothing between
    return next((Nearest(value) for value in key.trials if kept(works, value)), None)


def _asked(keys: LinkageCamSpec, name: str, refusal: ParameterError) -> Asked | None:
    """The key of a name, where a cam of this follower and linkage has it."""
    flat, driven = keys.follower == "flat", keys.driven
    if name == "coupler_length":
        return Asked(name, keys.coupler_length, _lengths(keys.coupler_length, refusal))
    if name == "stroke" and keys.motion_table is None:
        key, _ = stroke_key(isinstance(driven, DrivenRocker))
        value: float = getattr(keys, key)
        return Asked(key, value, [value * share for share in _SHORTER])
    if name == "follower_radius" and keys.follower_radius > 0:
        return Asked(name, keys.follower_radius, [keys.follower_radius * share for share in _SHORTER])
    if name == "direction" and flat:
        return Asked("follower_direction_deg", keys.follower_direction_deg, _turned(keys.follower_direction_deg))
    if name == "start" and isinstance(driven, DrivenRocker):
        return Asked("driven.start_angle_deg", driven.start_angle_deg, _turned(driven.start_angle_deg))
    if name == "point":
        return Asked("coupler_point", list(keys.coupler_point))
    return _other_way(driven) if name == "sense" else None


def _other_way(driven: DrivenRocker | DrivenSlider) -> Asked:
    """The driven member, the other way round."""
    if isinstance(driven, DrivenRocker):
        other = "clockwise" if driven.sense == "counter_clockwise" else "counter_clockwise"
        return Asked("driven.sense", driven.sense, (other,))
    way = driven.direction_deg
    return Asked("driven.direction_deg", way, (way - 180 if way > 0 else way + 180, *_turned(way)))


def _turned(angle: float) -> list[float]:
    """Angles beside one, degrees."""
    return [angle + turn for turn in _TURNS if abs(angle + turn) <= 360]


def _lengths(length: float, refusal: ParameterError) -> list[float]:
    """Lengths with which the coupler closes, nearest first, mm; beside its own where they are not known."""
    least, most = (refusal.numbers.get(name) for name in ("least", "most"))
    if not isinstance(least, float) or not isinstance(most, float):
        return [length * (1 + side * share) for share in (0.02, 0.1, 0.3, 0.6) for side in (1, -1)]
    if not least < most:
        return []
    # of a slider there is no longest one
    room = min(most, 4 * max(least, length)) - least
    ends = [least + room * share for share in _BETWEEN]
    return ends if length <= least else [least + room * (1 - share) for share in _BETWEEN]


def _idle(keys: LinkageCamSpec) -> Iterator[ParameterError]:
    """What is of another follower, or of another motion."""
    yield from idle_motion(keys, isinstance(keys.driven, DrivenRocker), table="")
    yield from idle_plate(keys)


def linkage_cam_of(keys: LinkageCamSpec) -> LinkageCam:
    """The cam of the keys, not yet checked for undercut; refusals speak of the mathematics."""
    from geometry.cams.plane.coupler import check_holds, linkage_cam
    from geometry.cams.plane.disk import FollowerKind
    from geometry.kinematics.linkage import Linkage

    swings = isinstance(keys.driven, DrivenRocker)
    check_idle(_idle(keys))
    cam = linkage_cam(
        motion_of(keys, swings),
        FollowerKind(keys.follower),
        Linkage(drive_of(keys.driven), keys.coupler_length, guide_of(keys.guide)),
        complex(*keys.coupler_point),
        direction=math.radians(keys.follower_direction_deg),
        radius=keys.follower_radius,
    )
    check_holds(cam)
    return cam


def _is_whole(keys: LinkageCamSpec) -> bool:
    """Whether nothing of the cam is undercut, and it has room for plate and holes."""
    from geometry.cams.plane.undercut import is_uncut

    cam = linkage_cam_of(keys)
    if not is_uncut(cam):
        return False
    _check_part(keys, cam)
    return True


def _check_part(keys: LinkageCamSpec, cam: LinkageCam) -> None:
    check_face(keys, cam)
    check_disk(keys, cam)


def _quantities(keys: LinkageCamSpec, cam: LinkageCam) -> dict[str, float]:
    """Named results: sizes in mm, angles in degrees."""
    from geometry.cams.plane.synthesis import least_convex_radius

    found = stroke_quantity(cam.motion.lift, swings=cam.swings) | table_quantities(cam.motion, swings=cam.swings)
    if cam.radius > 0:
        found["follower_radius"] = cam.radius
    found |= pressure_angles(cam)
    if cam.radius > 0:
        found["contact_pressure_angle_deg"] = math.degrees(cam.greatest(cam.contact_pressure_angle))
    found["least_curvature_radius"] = least_convex_radius(cam).value
    if cam.kind == "roller":
        found["largest_roller_radius"] = largest_roller_radius(cam, keys.least_curvature_radius)
    found["coupler_swing_deg"] = math.degrees(cam.member_swing("coupler"))
    found["least_transmission_angle_deg"] = math.degrees(cam.mount.linkage.transmission_angle())
    if cam.kind != "roller":
        found["greatest_sliding_velocity"] = cam.greatest(cam.sliding_velocity)
    if cam.kind in ("flat", "mushroom"):
        found["face_from"], found["face_to"] = cam.face_reach()
        found["least_plate_diameter"] = cam.least_plate_diameter()
    return found


def linkage_findings(keys: LinkageCamSpec, cam: LinkageCam) -> tuple[Finding, ...]:
    """Impacts, steep pressure angles, large rollers, poor transmission angles."""
    from geometry.cams.motion.follower_motion import PhaseKind
    from geometry.cams.plane.synthesis import greatest_pressure_angle, least_convex_radius

    found = motion_findings(cam.motion, swings=cam.swings)
    steepest = math.degrees(greatest_pressure_angle(cam, PhaseKind.RISE).value)
    found += steep(steepest, _USUAL_PRESSURE_ANGLE)
    transmission = math.degrees(cam.mount.linkage.transmission_angle())
    if transmission < _USUAL_TRANSMISSION_ANGLE:
        found.append(Finding("small_transmission_angle", transmission, _USUAL_TRANSMISSION_ANGLE))
    convex = least_convex_radius(cam).value
    if cam.kind == "roller":
        found += beyond("large_roller", cam.radius, USUAL_ROLLER_SHARE * (convex + cam.radius))
    if convex < keys.least_curvature_radius * (1 - 1e-6):
        found.append(Finding("linkage_curvature_radius", convex, keys.least_curvature_radius))
    return tuple(found)


class CouplerCam(DiskKind[LinkageCamSpec, "LinkageCam"]):
    """A disk cam whose follower is carried by the connecting rod of a linkage."""

    name, keys = "linkage_cam", LinkageCamSpec
    data_table = "parts.cams.data_tables"

    def idle(self, keys: LinkageCamSpec, others: Others) -> Iterator[ParameterError]:
        """What is of another follower, or of another motion."""
        return _idle(keys)

    def thing(self, keys: LinkageCamSpec, others: Others) -> LinkageCam:
        """The cam, checked to move its follower all the way."""
        from geometry.cams.plane.coupler import LinkageError
        from geometry.cams.plane.undercut import lost_to_undercut

        try:
            cam = linkage_cam_of(keys)
            lost = lost_to_undercut(cam)
            if lost is not None:
                raise undercut(cam, "follower_radius", keys.follower_radius, lost, None)
        except (LinkageError, UndercutError) as refusal:
            raise LateError(refusal.code, partial(_to_blame, keys, refusal, _is_whole)) from refusal
        except ParameterError as refusal:
            raise refusal.renamed({"radius": "follower_radius"}.get(refusal.name, refusal.name)) from refusal
        _check_part(keys, cam)
        return cam

    def report(self, keys: LinkageCamSpec, thing: LinkageCam) -> Report:
        """Impacts, pressure and transmission angles, curvature."""
        return Report(linkage_findings(keys, thing), cam_circles(thing), _quantities(keys, thing))


LINKAGE_CAM = CouplerCam()

"""The part kind ``groove_cam``: a disk with a closed groove whose two walls drive a roller both ways."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Annotated

from msgspec.structs import replace

from geometry.base.errors import OffsetError, ParameterError, UndercutError, limit
from geometry.base.findings import Finding, beyond
from geometry.base.nearest import moved
from geometry.base.record import Record
from geometry.plane.offset_region import OffsetRegion
from geometry.plane.profile import Label, Profile, Region, circle
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import WheelShape, wheel_body, wheel_sections
from parts.base.kind import Kind, Others, Report
from parts.base.schema import nearest_key
from parts.cams.disk_cam.part import (
    CamSpec,
    OscillatingTable,
    by_impact,
    cam_circles,
    cam_of,
    cam_quantities,
    idle_follower,
    larger_bases,
    motion_findings,
    not_kept,
)
from parts.cams.wheel import DiskKeys, check_disk, inner_radius
from parts.keys.base import MOST_LENGTH, degrees, mm, part_mm, start
from parts.keys.cam import (
    USUAL_PRESSURE_ANGLE,
    FollowerOffset,
    Lift,
    MotionTable,
    Phases,
    Swing,
    TableTolerance,
    idle_motion,
    steep,
    turn,
)
from parts.keys.law import with_own_laws
from parts.keys.wheel import cross_holes, shape_of

if TYPE_CHECKING:
    from geometry.cams.plane.disk import DiskCam
    from geometry.solids.body import Body
    from geometry.solids.cross_holes import CrossHole
    from parts.base.readback import Probe
    from parts.cams.probes import TurningProbe

# default rim beyond the groove, part of the groove's width
_RIM_SHARE = 0.5
# thinner rims and floors are mistakes of the keyboard, mm
_LEAST_WALL = 0.05
# usual play of a roller in its groove, part of its diameter: with less it jams, with more it knocks
_USUAL_CLEARANCE = 0.02

_BASE_CIRCLE_RADIUS = part_mm("circle inside the groove; default: by least_transmission_angle_deg", above=0)
_LEAST_TRANSMISSION_ANGLE = degrees("gamma_min = 90 - pressure angle, both ways", above=0, below=90, example=60.0)
_OUTER_DIAMETER = mm(
    "of the disk; default: a rim of half the groove's width", above=0, most=2 * MOST_LENGTH, example=160.0
)
_GROOVE_DEPTH = mm("from the upper face to the groove's floor, below face_width", above=0, most=10_000, example=5.0)


class GrooveCamSpec(DiskKeys, forbid_unknown_fields=True, tag_field="kind", tag="groove_cam"):
    """Keys of ``groove_cam``."""

    follower_radius: Annotated[float, part_mm("radius of the roller", above=0, example=8.0)]
    groove_depth: Annotated[float, _GROOVE_DEPTH]
    lift: Lift = 0.0
    swing_deg: Swing = 0.0
    phases: Annotated[Phases, with_own_laws(turn("sine"))] | None = None
    motion_table: MotionTable | None = None
    table_tolerance: TableTolerance = 0.0
    follower_offset: FollowerOffset = 0.0
    oscillating: OscillatingTable | None = None
    base_circle_radius: Annotated[float, _BASE_CIRCLE_RADIUS, start(30.0)] | None = None
    least_transmission_angle_deg: Annotated[float, _LEAST_TRANSMISSION_ANGLE] | None = None
    roller_clearance: Annotated[float, mm("groove's width less the roller's diameter", least=0, most=100)] = 0.0
    outer_diameter: Annotated[float, _OUTER_DIAMETER] | None = None


class GrooveDisk(Record):
    """A groove cam that exists: roller and motion, play, depth of the groove, the disk about it, its holes, mm."""

    cam: DiskCam
    clearance: float
    depth: float
    outer_radius: float
    shape: WheelShape
    holes: HubHoles

    @property
    def floor(self) -> float:
        """Height of the groove's floor, mm."""
        return self.shape.face_width - self.depth

    @property
    def outermost(self) -> float:
        """Greatest distance of the groove from the axis, mm."""
        from geometry.cams.plane.walls import path_reach

        return path_reach(self.cam) + self.cam.radius + self.clearance

    def inner(self, offset: float = 0.0) -> Profile:
        """The wall nearer to the axis."""
        from geometry.cams.plane.shape import cam_shape

        return cam_shape(self.cam, offset).profile

    def outer(self, offset: float = 0.0) -> Profile:
        """The wall beyond the roller."""
        from geometry.cams.plane.walls import outer_wall

        return outer_wall(self.cam, self.clearance, offset)

    def wall_probes(self, height: float) -> tuple[TurningProbe, TurningProbe]:
        """A roller along the inner wall and one along the outer one, of a solid cut at a height, mm."""
        from geometry.cams.plane.walls import wide_roller
        from parts.cams.probes import TurningProbe

        wide = wide_roller(self.cam, self.clearance)
        return (
            TurningProbe(self.cam, height, self.inner, name="inner"),
            TurningProbe(wide, height, self.outer, below=False, name="outer"),
        )


def _as_cam(spec: GrooveCamSpec) -> CamSpec:
    """The keys that a groove cam shares with a disk cam."""
    shared = {*CamSpec.__struct_fields__} & {*GrooveCamSpec.__struct_fields__}
    return CamSpec(follower="roller", **{name: getattr(spec, name) for name in shared})


def _roller_cam(spec: GrooveCamSpec) -> DiskCam:
    """The roller and its motion; a groove's least base circle serves the return too."""
    as_cam = _as_cam(spec)
    angle = spec.least_transmission_angle_deg
    if spec.base_circle_radius is None and angle is not None and spec.oscillating is None:
        from geometry.cams.plane.synthesis import roller_prime_radius

        first = cam_of(as_cam)
        limit = math.radians(90 - angle)
        both = roller_prime_radius(first.motion, spec.follower_offset, limit, limit) - spec.follower_radius
        as_cam = replace(as_cam, base_circle_radius=max(both, first.base_radius))
    return cam_of(as_cam)


def _check_walls(keys: GrooveCamSpec, cam: DiskCam) -> None:
    """Both walls are whole: the roller is smaller than every hollow of its path."""
    from geometry.cams.plane.undercut import is_uncut
    from geometry.cams.plane.walls import lost_on

    lost = lost_on(cam, keys.roller_clearance)
    if not lost:
        return

    def whole(other: GrooveCamSpec) -> bool:
        made = _roller_cam(other)
        return all(is_uncut(made, grow) for grow in (0.0, 2 * made.radius + other.roller_clearance))

    if (refusal := by_impact(keys, cam.motion, whole, swings=cam.swings, both=True)) is not None:
        raise refusal
    base = cam.base_radius
    code = "undercut_inner_wall" if max(lost, key=lambda wall: lost[wall]) == "inner" else "undercut_outer_wall"
    cure = partial(nearest_key, keys, "base_circle_radius", base, larger_bases(base), whole)
    raise UndercutError("base_circle_radius", base, code, cure)


def _outer_radius(keys: GrooveCamSpec, reach: float, chamfer: float) -> float:
    width = 2 * keys.follower_radius + keys.roller_clearance
    if keys.outer_diameter is None:
        # a whole number of mm
        return math.ceil(2 * (reach + max(_RIM_SHARE * width, chamfer + _LEAST_WALL)) - 1e-9) / 2
    least = 2 * (reach + chamfer + _LEAST_WALL)
    if not keys.outer_diameter >= least:
        given = keys.outer_diameter
        raise ParameterError("outer_diameter", given, "no_rim_beyond_groove", limit(least, given))
    return keys.outer_diameter / 2


def groove_section(disk: GrooveDisk, offset: float) -> OffsetRegion:
    """The exact section with every boundary moved out of the material; the groove's walls are marks on it."""
    refusals = _offset_limits(disk, offset)
    try:
        holes = disk.holes.profiles(offset)
    except OffsetError as refusal:
        refusals.append(refusal)
    if refusals:
        # what works for the narrowest of them works for all
        raise min(refusals, key=lambda r: abs(r.nearest_offset))
    marks, gaps = moved(partial(_moved_walls, disk), offset, "no_groove")
    outer = circle(disk.outer_radius + offset, Label.BODY)
    found = (Finding("outline_trimmed", float(gaps), offset),) if gaps else ()
    return OffsetRegion(Region(outer, holes, marks), offset, found)


def _offset_limits(disk: GrooveDisk, offset: float) -> list[OffsetError]:
    """Refusals of an offset that closes the groove, or leaves no rim or no wall within it."""
    inside, width = inner_radius(disk.cam), 2 * disk.cam.radius + disk.clearance
    found = []
    if not offset < width / 2:
        found.append(OffsetError(offset, "groove_closed", width / 2 * (1 - 1e-6)))
    rim = disk.outer_radius - disk.outermost
    if not -2 * offset < rim:
        found.append(OffsetError(offset, "leaves_no_rim", -rim / 2 * (1 - 1e-6)))
    if not inside + offset > (disk.holes.reach - offset if disk.holes.number else 0.0):
        least = (disk.holes.reach - inside) / 2 if disk.holes.number else -inside
        found.append(OffsetError(offset, "no_wall_inside_groove", least * (1 - 1e-9)))
    return found


def _moved_walls(disk: GrooveDisk, offset: float) -> tuple[tuple[Profile, Profile], int]:
    """Both walls, outer one first, and how many places of them are trimmed."""
    from geometry.cams.plane.undercut import kept_arcs

    grown = 2 * disk.cam.radius + disk.clearance - offset
    gaps = sum(len(kept_arcs(disk.cam, grow).gaps) for grow in (offset, grown))
    return (disk.outer(offset), disk.inner(offset)), gaps


def _findings(spec: GrooveCamSpec, disk: GrooveDisk) -> tuple[Finding, ...]:
    from geometry.cams.motion.follower_motion import PhaseKind
    from geometry.cams.plane.synthesis import greatest_pressure_angle

    found = motion_findings(disk.cam.motion, swings=disk.cam.swings)
    # a groove drives both ways: the limit holds for the return too
    usual = USUAL_PRESSURE_ANGLE[spec.oscillating is not None]
    for kind, code, way in (
        (PhaseKind.RISE, "steep_pressure_angle", ""),
        (PhaseKind.RETURN, "steep_return_pressure_angle", "return_"),
    ):
        if not disk.cam.motion.moving_pieces(kind):
            continue
        steepest = math.degrees(greatest_pressure_angle(disk.cam, kind).value)
        found += (*steep(steepest, usual, code), *not_kept(way, spec.least_transmission_angle_deg, steepest))
    most = _USUAL_CLEARANCE * 2 * spec.follower_radius
    jams = spec.roller_clearance == 0
    play = (Finding("roller_play", 0.0, most),) if jams else beyond("roller_play", spec.roller_clearance, most)
    return (*found, *play)


class GrooveCam(Kind[GrooveCamSpec, GrooveDisk]):
    """A disk with a groove."""

    name, keys = "groove_cam", GrooveCamSpec
    drawing = "parts.cams.drawings"
    data_table = "parts.cams.data_tables"

    def idle(self, keys: GrooveCamSpec, others: Others) -> Iterator[ParameterError]:
        """What is of another motion, the offset of an arm."""
        yield from idle_motion(keys, keys.oscillating is not None)
        yield from idle_follower(_as_cam(keys))

    def thing(self, keys: GrooveCamSpec, others: Others) -> GrooveDisk:
        """The disk, checked to let its roller through."""
        from geometry.cams.plane.walls import path_reach

        cam = _roller_cam(keys)
        _check_walls(keys, cam)
        depth, width = keys.groove_depth, keys.face_width
        if not depth <= width - _LEAST_WALL:
            if width <= _LEAST_WALL:
                raise ParameterError(
                    "face_width", width, "no_room_for_groove", limit((depth + _LEAST_WALL) * (1 + 1e-9), width)
                )
            raise ParameterError("groove_depth", depth, "groove_goes_through", limit(width - _LEAST_WALL, depth))
        shape = shape_of(keys)
        reach = path_reach(cam) + cam.radius + keys.roller_clearance
        radius = _outer_radius(keys, reach, max(shape.chamfer_below, shape.chamfer_above))
        return GrooveDisk(cam, keys.roller_clearance, depth, radius, shape, check_disk(keys, cam, "groove"))

    def section(self, keys: GrooveCamSpec, thing: GrooveDisk, offset: float) -> OffsetRegion:
        """The walls are marks on the disk."""
        return groove_section(thing, offset)

    def cross_holes(self, keys: GrooveCamSpec, thing: GrooveDisk) -> tuple[CrossHole, ...]:
        """For set screws."""
        return cross_holes(thing.shape)

    def solid(self, keys: GrooveCamSpec, thing: GrooveDisk, offset: float) -> Body:
        """The wheel with its groove."""
        from geometry.cams.plane.walls import with_groove

        def outline(moved: float, depth: float) -> Profile:
            return circle(thing.outer_radius + moved - depth, Label.BODY)

        outer, inner = groove_section(thing, offset).region.marks
        wheel = wheel_body(thing.shape, wheel_sections(outline, inner_radius(thing.cam), thing.holes), offset)
        return with_groove(wheel, inner, outer, thing.floor, thing.shape.face_width)

    def pitch_curve(self, keys: GrooveCamSpec, thing: GrooveDisk) -> Profile:
        """The inner wall, moved out by the roller's radius."""
        return thing.inner(thing.cam.radius)

    def is_plate(self, keys: GrooveCamSpec, thing: GrooveDisk) -> bool:
        """Without hub and chamfers."""
        return thing.shape.is_plate

    def report(self, keys: GrooveCamSpec, thing: GrooveDisk) -> Report:
        """Those of the roller's cam, both ways, and of the groove."""
        circles = {"outer_diameter": 2 * thing.outer_radius} | cam_circles(thing.cam)
        groove = {"groove_width": 2 * thing.cam.radius + thing.clearance, "groove_depth": thing.depth}
        quantities = cam_quantities(_as_cam(keys), thing.cam) | groove
        engraved = (Finding("engraved_groove", thing.depth, keys.face_width),)
        return Report(_findings(keys, thing), circles, quantities, engraved)

    def probes(self, keys: GrooveCamSpec, thing: GrooveDisk) -> tuple[Probe, ...]:
        """A roller along each wall."""
        return thing.wall_probes(thing.floor + thing.depth / 2)


GROOVE_CAM = GrooveCam()

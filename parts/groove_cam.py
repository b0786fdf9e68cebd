"""The part kind ``groove_cam``: a disk with a closed groove whose two walls drive a roller both ways."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, Struct
from msgspec.structs import fields, replace

from geometry.errors import GeometryError, OffsetError, ParameterError, UndercutError, at_least, at_most
from geometry.findings import Finding
from geometry.hub_holes import HubHoles
from geometry.offset_region import OffsetRegion
from geometry.profile import Label, Profile, Region, circle
from geometry.trial import is_trial
from geometry.wheel import WheelShape, check_wheel, wheel_body, wheel_sections
from parts.cam import CamSpec, OscillatingTable, base_radius, cam_circles, cam_of, cam_quantities, inner_radius
from parts.cam_keys import FollowerOffset, Lift, MotionTable, Phases, Swing
from parts.hole_keys import BoreTable, HolesTable, RoundBoreTable, hub_holes, wide_bore
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, mm
from parts.materials import density_of
from parts.part import Part
from parts.timing_mark import TimingMarkTable, with_timing_mark
from parts.wheel_keys import FaceChamfer, FaceChamferTable, HubTable, wheel_shape

if TYPE_CHECKING:
    from geometry.body import Body
    from geometry.cams.disk import DiskCam

_MOST = 100_000.0
_BISECTIONS = 40
# a groove drives both ways: the limit holds for the return too; translating and swinging, degrees
_USUAL_PRESSURE_ANGLE = {False: 30.0, True: 45.0}
# default rim beyond the groove, part of the groove's width
_RIM_SHARE = 0.5
# thinner rims and floors are mistakes of the keyboard, mm
_LEAST_WALL = 0.05
# usual play of a roller in its groove, part of its diameter: with less it jams, with more it knocks
_USUAL_CLEARANCE = (0.0, 0.02)


class GrooveCamSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="groove_cam"):
    """Groove cam; the keys of the motion, bore, holes and hub are those of ``cam``."""

    follower_radius: Annotated[float, mm("radius of the roller", above=0, most=_MOST)]
    groove_depth: Annotated[
        float, mm("from the upper face to the groove's floor, below face_width", above=0, most=10_000)
    ]
    lift: Lift = 0.0
    swing_deg: Swing = 0.0
    phases: Phases | None = None
    motion_table: MotionTable | None = None
    follower_offset: FollowerOffset = 0.0
    oscillating: OscillatingTable | None = None
    base_circle_radius: (
        Annotated[float, mm("circle inside the groove; default: by least_transmission_angle_deg", above=0, most=_MOST)]
        | None
    ) = None
    least_transmission_angle_deg: (
        Annotated[
            float,
            Meta(gt=0, lt=90, description="gamma_min = 90 - pressure angle, both ways", extra={"unit": "degrees"}),
        ]
        | None
    ) = None
    roller_clearance: Annotated[float, mm("groove's width less the roller's diameter", least=0, most=100)] = 0.0
    outer_diameter: (
        Annotated[float, mm("of the disk; default: a rim of half the groove's width", above=0, most=2 * _MOST)] | None
    ) = None
    face_width: FaceWidth = 10.0
    bore_diameter: BoreDiameter = 0.0
    bore: BoreTable | None = None
    holes: HolesTable | list[HolesTable] | None = None
    timing_mark: TimingMarkTable | None = None
    hub: HubTable | None = None
    face_chamfer: FaceChamfer | FaceChamferTable = 0.0
    material: Material | None = None
    density: Density | None = None
    colour: Colour | None = None


@dataclass(frozen=True, slots=True)
class GrooveDisk:
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
        from geometry.cams.walls import path_reach

        return path_reach(self.cam) + self.cam.radius + self.clearance

    def inner(self, offset: float = 0.0) -> Profile:
        """The wall nearer to the axis."""
        from geometry.cams.walls import inner_wall

        return inner_wall(self.cam, offset)

    def outer(self, offset: float = 0.0) -> Profile:
        """The wall beyond the roller."""
        from geometry.cams.walls import outer_wall

        return outer_wall(self.cam, self.clearance, offset)


def checked_groove(spec: GrooveCamSpec) -> GrooveDisk:
    """The groove cam of a part, checked to exist and to let its roller through.

    Raises
    ------
    ParameterError
        Names the key and what would work.
    """
    cam = _roller_cam(spec)
    _check_walls(spec, cam)
    if not spec.groove_depth <= spec.face_width - _LEAST_WALL:
        remedy = f"goes through: the disk would fall apart; at most {at_most(spec.face_width - _LEAST_WALL)} mm works"
        if spec.face_width <= _LEAST_WALL:
            raise ParameterError("face_width", spec.face_width, "has no room for a groove; 10 mm works")
        raise ParameterError("groove_depth", spec.groove_depth, remedy)
    shape = wheel_shape(spec.face_width, None, spec.hub, spec.face_chamfer)
    disk = GrooveDisk(cam, spec.roller_clearance, spec.groove_depth, 0.0, shape, _holes_of(spec))
    reach = disk.outermost
    chamfer = max(shape.chamfer_below, shape.chamfer_above)
    radius = _outer_radius(spec, reach, chamfer)
    inside = inner_radius(cam)
    if not disk.holes.bore_reach < inside:
        raise wide_bore(spec, inside, "leaves no wall to the groove")
    if disk.holes.reach > inside:
        remedy = f"the holes must stay inside the groove, within {inside:.6g} mm of the axis"
        raise ParameterError("holes", 2 * disk.holes.reach, remedy)
    holes = with_timing_mark(disk.holes, spec.timing_mark, cam, inside)
    check_wheel(shape, 2 * inside, holes)
    return GrooveDisk(cam, disk.clearance, disk.depth, radius, shape, holes)


def groove_part(part_id: str, spec: GrooveCamSpec, disk: GrooveDisk) -> Part:
    """The part of a groove cam; sections are computed when an export asks."""
    from geometry.cams.walls import CamWall, wide_roller

    section = lru_cache(maxsize=8)(lambda offset: groove_section(disk, offset))
    height = disk.floor + disk.depth / 2
    walls = (
        CamWall("inner", disk.cam, height, disk.inner),
        CamWall("outer", wide_roller(disk.cam, disk.clearance), height, disk.outer, below=False),
    )
    return Part(
        part_id,
        "groove_cam",
        section,
        lru_cache(maxsize=2)(lambda offset: _body(disk, section(offset).region, offset)),
        spec.face_width,
        disk.shape.is_plate,
        _findings(spec, disk),
        {"outer_diameter": 2 * disk.outer_radius} | cam_circles(disk.cam),
        _quantities(spec, disk),
        spec.material,
        spec.colour,
        spec.density or density_of(spec.material),
        flat_findings=(Finding("engraved_groove", disk.depth, spec.face_width),),
        cam=disk.cam,
        walls=walls,
    )


def _as_cam(spec: GrooveCamSpec) -> CamSpec:
    """The keys that a groove cam shares with a disk cam."""
    shared = {f.name for f in fields(CamSpec)} & {f.name for f in fields(GrooveCamSpec)}
    return CamSpec(follower="roller", **{name: getattr(spec, name) for name in shared})


def _roller_cam(spec: GrooveCamSpec) -> DiskCam:
    """The roller and its motion; a groove's least base circle serves the return too."""
    as_cam = _as_cam(spec)
    angle = spec.least_transmission_angle_deg
    if spec.base_circle_radius is None and angle is not None and spec.oscillating is None:
        from geometry.cams.synthesis import roller_prime_radius

        first = cam_of(as_cam)
        limit = math.radians(90 - angle)
        both = roller_prime_radius(first.motion, spec.follower_offset, limit, limit) - spec.follower_radius
        as_cam = replace(as_cam, base_circle_radius=max(both, base_radius(first)))
    return cam_of(as_cam)


def _check_walls(spec: GrooveCamSpec, cam: DiskCam) -> None:
    """Both walls are whole: the roller is smaller than every hollow of its path."""
    from geometry.cams.undercut import is_whole
    from geometry.cams.walls import lost_on

    lost = lost_on(cam, spec.roller_clearance)
    if not lost:
        return
    wall, amount = max(lost.items(), key=lambda item: item[1])
    unit = "rad" if spec.oscillating else "mm"
    told = "all of its lift" if math.isinf(amount) else f"{amount:.4g} {unit} of lift"
    base = base_radius(cam)

    def works(value: float) -> bool:
        try:
            other = _roller_cam(replace(spec, base_circle_radius=value))
            return all(is_whole(other, grow) for grow in (0.0, 2 * other.radius + spec.roller_clearance))
        except GeometryError:
            return False

    high = None if is_trial() else next((base * 1.5**k for k in range(1, 13) if works(base * 1.5**k)), None)
    if high is None:
        remedy = "a smaller follower_radius, longer phases or a law without impacts work"
    else:
        low = base
        for _ in range(_BISECTIONS):
            middle = (low + high) / 2
            low, high = (low, middle) if works(middle) else (middle, high)
        remedy = f"at least {at_least(high, 4)} mm works"
    raise UndercutError("base_circle_radius", base, f"the groove's {wall} wall is undercut and loses {told}; {remedy}")


def _outer_radius(spec: GrooveCamSpec, reach: float, chamfer: float) -> float:
    width = 2 * spec.follower_radius + spec.roller_clearance
    if spec.outer_diameter is None:
        # a whole number of mm
        return math.ceil(2 * (reach + max(_RIM_SHARE * width, chamfer + _LEAST_WALL)) - 1e-9) / 2
    least = 2 * (reach + chamfer + _LEAST_WALL)
    if not spec.outer_diameter >= least:
        remedy = f"leaves no rim beyond the groove; at least {at_least(least, 4)} mm works"
        raise ParameterError("outer_diameter", spec.outer_diameter, remedy)
    return spec.outer_diameter / 2


def _holes_of(spec: GrooveCamSpec) -> HubHoles:
    if spec.bore is not None and spec.bore_diameter > 0:
        raise ParameterError("bore_diameter", spec.bore_diameter, "give either bore_diameter or bore; 0 works")
    bore = RoundBoreTable(spec.bore_diameter) if spec.bore_diameter > 0 else spec.bore
    return hub_holes(bore, spec.holes, None)


def groove_section(disk: GrooveDisk, offset: float) -> OffsetRegion:
    """The exact section with every boundary moved out of the material; the groove's walls are marks on it."""
    refusals = _offset_limits(disk, offset)
    try:
        holes = disk.holes.profiles(offset)
    except OffsetError as refusal:
        refusals.append(refusal)
    if refusals:
        # what works for the narrowest of them works for all
        raise min(refusals, key=lambda r: abs(r.nearest))
    try:
        marks, gaps = _moved_walls(disk, offset)
    except GeometryError as refusal:
        raise OffsetError(offset, "leaves no groove", _nearest_offset(disk, offset)) from refusal
    outer = circle(disk.outer_radius + offset, Label.BODY)
    found = (Finding("outline_trimmed", float(gaps), offset),) if gaps else ()
    return OffsetRegion(Region(outer, holes, marks), offset, found)


def _offset_limits(disk: GrooveDisk, offset: float) -> list[OffsetError]:
    """Refusals of an offset that closes the groove, or leaves no rim or no wall within it."""
    inside, width = inner_radius(disk.cam), 2 * disk.cam.radius + disk.clearance
    found = []
    if not offset < width / 2:
        found.append(OffsetError(offset, "closes the groove", width / 2 * (1 - 1e-6)))
    rim = disk.outer_radius - disk.outermost
    if not -2 * offset < rim:
        found.append(OffsetError(offset, "leaves no rim", -rim / 2 * (1 - 1e-6)))
    if not inside + offset > (disk.holes.reach - offset if disk.holes.number else 0.0):
        least = (disk.holes.reach - inside) / 2 if disk.holes.number else -inside
        found.append(OffsetError(offset, "leaves no wall inside the groove", least * (1 - 1e-9)))
    return found


def _moved_walls(disk: GrooveDisk, offset: float) -> tuple[tuple[Profile, Profile], int]:
    """Both walls, outer one first, and how many places of them are trimmed."""
    from geometry.cams.undercut import kept_arcs

    grown = 2 * disk.cam.radius + disk.clearance - offset
    gaps = sum(len(kept_arcs(disk.cam, grow).gaps) for grow in (offset, grown))
    return (disk.outer(offset), disk.inner(offset)), gaps


def _nearest_offset(disk: GrooveDisk, refused: float) -> float:
    works, fails = 0.0, refused
    for _ in range(24):
        middle = (works + fails) / 2
        try:
            _moved_walls(disk, middle)
            works = middle
        except GeometryError:
            fails = middle
    return works


def _body(disk: GrooveDisk, region: Region, offset: float) -> Body:
    """The solid: the wheel with its groove."""
    from geometry.cams.walls import with_groove

    def outline(moved: float, depth: float) -> Profile:
        return circle(disk.outer_radius + moved - depth, Label.BODY)

    sections = wheel_sections(outline, inner_radius(disk.cam), disk.holes)
    outer, inner = region.marks
    return with_groove(wheel_body(disk.shape, sections, offset), inner, outer, disk.floor, disk.shape.face_width)


def _quantities(spec: GrooveCamSpec, disk: GrooveDisk) -> dict[str, float]:
    groove = {"groove_width": 2 * disk.cam.radius + disk.clearance, "groove_depth": disk.depth}
    return cam_quantities(_as_cam(spec), disk.cam) | groove


def _findings(spec: GrooveCamSpec, disk: GrooveDisk) -> tuple[Finding, ...]:
    from geometry.cams.follower_motion import PhaseKind
    from geometry.cams.synthesis import greatest_pressure_angle

    found = []
    for impact, order in (("rigid", 1), ("soft", 2)):
        jumps = [(abs(j.jumps[order]), math.degrees(j.angle)) for j in disk.cam.motion.impacts() if j.impact == impact]
        if jumps:
            found.append(Finding(f"{impact}_impact", *max(jumps)))
    usual = _USUAL_PRESSURE_ANGLE[spec.oscillating is not None]
    for kind, code in ((PhaseKind.RISE, "steep_pressure_angle"), (PhaseKind.RETURN, "steep_return_pressure_angle")):
        if not disk.cam.motion.moving_pieces(kind):
            continue
        steepest = math.degrees(greatest_pressure_angle(disk.cam, kind).value)
        if steepest > usual + 1e-9:
            found.append(Finding(code, steepest, usual))
    share = spec.roller_clearance / (2 * spec.follower_radius)
    if not _USUAL_CLEARANCE[0] < share <= _USUAL_CLEARANCE[1]:
        found.append(Finding("roller_play", spec.roller_clearance, _USUAL_CLEARANCE[1] * 2 * spec.follower_radius))
    return tuple(found)

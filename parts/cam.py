"""The part kind ``cam``: a disk cam for a pointed, roller, mushroom or flat follower."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from geometry.errors import GeometryError, OffsetError, ParameterError, UndercutError, at_least, at_most
from geometry.findings import Finding
from geometry.hub_holes import HubHoles
from geometry.offset_region import OffsetRegion
from geometry.profile import Profile, Region
from geometry.trial import is_trial
from geometry.wheel import WheelShape, check_wheel, wheel_body, wheel_sections
from parts.cam_keys import (
    FollowerOffset,
    Lift,
    MotionTable,
    Phases,
    Swing,
    check_stroke,
    in_degrees,
    motion_of,
    without_base,
)
from parts.cam_report import cam_findings, cam_quantities
from parts.hole_keys import BoreTable, HolesTable, RoundBoreTable, hub_holes, wide_bore
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, mm
from parts.materials import density_of
from parts.part import Part
from parts.timing_mark import TimingMarkTable, with_timing_mark
from parts.wheel_keys import FaceChamfer, FaceChamferTable, HubTable, wheel_shape

__all__ = ["CamSpec", "cam_findings", "cam_of", "cam_part", "cam_quantities", "checked_cam"]

if TYPE_CHECKING:
    from geometry.cams.disk import DiskCam
    from geometry.cams.follower_motion import FollowerMotion
    from parts.linkage_cam import LinkageCamSpec

_MOST = 100_000.0
_BISECTIONS = 40


class OscillatingTable(Struct, forbid_unknown_fields=True):
    """A follower that swings about a pivot on +x."""

    centre_distance: Annotated[float, mm("from the cam's axis to the pivot", above=0, most=_MOST)]
    arm_length: Annotated[float, mm("from the pivot to the roller's centre; not for flat", least=0, most=_MOST)] = 0.0
    sense: Annotated[
        Literal["against", "with"], Meta(description="how the follower rises: against or with the cam's turning")
    ] = "against"
    face_offset: Annotated[float, mm("flat face nearer to the axis than the pivot", least=-_MOST, most=_MOST)] = 0.0


class CamSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="cam"):
    """Disk cam; it turns counter-clockwise, cam angle 0 is the start of the first phase."""

    follower: Annotated[
        Literal["pointed", "roller", "mushroom", "flat"], Meta(description="shape of the follower's end")
    ]
    lift: Lift = 0.0
    swing_deg: Swing = 0.0
    phases: Phases | None = None
    motion_table: MotionTable | None = None
    follower_radius: Annotated[float, mm("radius of the roller or mushroom", least=0, most=_MOST)] = 0.0
    follower_offset: FollowerOffset = 0.0
    plate_diameter: (
        Annotated[float, mm("round plate of a translating flat or mushroom follower", above=0, most=_MOST)] | None
    ) = None
    oscillating: OscillatingTable | None = None
    base_circle_radius: (
        Annotated[float, mm("base circle; default: the least by least_transmission_angle_deg", above=0, most=_MOST)]
        | None
    ) = None
    least_transmission_angle_deg: (
        Annotated[
            float,
            Meta(gt=0, lt=90, description="gamma_min = 90 - pressure angle; flat: 45", extra={"unit": "degrees"}),
        ]
        | None
    ) = None
    least_curvature_radius: Annotated[float, mm("rho: least convex radius of the cam", least=0, most=_MOST)] = 0.0
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


def checked_cam(spec: CamSpec) -> DiskCam:
    """The cam of a part, checked to exist and to move its follower all the way.

    Raises
    ------
    ParameterError
        Names the key and what would work; an undercut cam is told the base circle that is large enough.
    """
    from geometry.cams.undercut import kept_arcs

    cam = cam_of(spec)
    try:
        gaps = kept_arcs(cam).gaps
    except UndercutError:
        gaps, lost = None, "all of the profile"
    if gaps:
        lost = f"{max(g.lost_lift for g in gaps):.4g} {'rad' if spec.oscillating else 'mm'} of lift"
    if gaps is None or gaps:
        raise UndercutError(
            "base_circle_radius", base_radius(cam), f"the cam is undercut and loses {lost}; {_whole(spec, cam)}"
        )
    _check_plate(spec, cam)
    check_cam_bore(spec, cam)
    check_wheel(_shape_of(spec), 2 * inner_radius(cam), cam_holes(spec, cam))
    return cam


def cam_part(part_id: str, spec: CamSpec, cam: DiskCam) -> Part:
    """The part of a cam; sections are computed when an export asks."""
    holes, shape = cam_holes(spec, cam), _shape_of(spec)
    section = lru_cache(maxsize=8)(lambda offset: cam_section(cam, holes, offset))

    def outline(offset: float, depth: float) -> Profile:
        return section(offset).region.outer if depth == 0 else cam_outline(cam, offset - depth)

    sections = wheel_sections(outline, inner_radius(cam), holes)
    return Part(
        part_id,
        "cam",
        section,
        lru_cache(maxsize=2)(lambda offset: wheel_body(shape, sections, offset)),
        spec.face_width,
        shape.is_plate,
        cam_findings(spec, cam),
        cam_circles(cam),
        cam_quantities(spec, cam),
        spec.material,
        spec.colour,
        spec.density or density_of(spec.material),
        cam=cam,
    )


def base_radius(cam: DiskCam) -> float:
    """Radius of the base circle, mm."""
    return float(abs(cam.reference_point(0.0))) - cam.radius


def inner_radius(cam: DiskCam) -> float:
    """The largest circle about the axis inside the cam, mm: that of the lowest follower."""
    import numpy as np

    angles = np.concatenate([p.extremes(0) for p in cam.motion.pieces])
    # both sides of every joint are the same in S
    return float(np.abs(cam.reference_point(angles)).min()) - cam.radius


def cam_of(spec: CamSpec) -> DiskCam:
    """The cam of the keys, not yet checked for undercut; refusals speak in the scene's keys."""
    from geometry.cams.disk import FollowerKind, oscillating_cam, translating_cam

    swing = spec.oscillating
    check_stroke(spec, swing is not None)
    scale = math.radians(1.0) if swing else 1.0
    table = None if spec.motion_table is None else [(a, s * scale) for a, s in spec.motion_table]
    lift = math.radians(spec.swing_deg) if swing else spec.lift
    motion = motion_of(spec.phases, table, lift, "swing_deg" if swing else "lift")
    kind = FollowerKind(spec.follower)
    base = spec.base_circle_radius
    try:
        if swing is None:
            base = _least_base(spec, motion) if base is None else base
            return translating_cam(
                motion, kind, base, radius=spec.follower_radius, follower_offset=spec.follower_offset
            )
        if base is None:
            raise ParameterError("base_circle_radius", None, "is missing: an oscillating follower needs it")
        if spec.follower_offset:
            raise ParameterError("follower_offset", spec.follower_offset, "an oscillating follower has none; 0 works")
        if swing.face_offset and spec.follower != "flat":
            raise ParameterError("face_offset", swing.face_offset, "is for flat followers only; remove it")
        return oscillating_cam(
            motion,
            kind,
            base,
            centre_distance=swing.centre_distance,
            arm_length=swing.arm_length,
            radius=spec.follower_radius,
            sense=1 if swing.sense == "against" else -1,
            face_offset=swing.face_offset,
        )
    except ParameterError as refusal:
        raise _in_keys(spec, refusal) from refusal


def _in_keys(spec: CamSpec, refusal: ParameterError) -> ParameterError:
    """A refusal of the mathematics under the name of the scene's key."""
    swing = spec.oscillating is not None
    names = {"radius": "follower_radius"} | ({"lift": "swing_deg"} if swing else {})
    if swing:
        names |= {key: f"oscillating.{key}" for key in ("centre_distance", "arm_length", "face_offset", "sense")}
    if refusal.name == "base_circle_radius" and spec.base_circle_radius is not None:
        # the mathematics speaks of the prime circle
        return _reachable(spec, spec.base_circle_radius, refusal)
    value = in_degrees(refusal.value) if refusal.name == "lift" and swing else refusal.value
    return ParameterError(names.get(refusal.name, refusal.name), value, refusal.allowed)


def _reachable(spec: CamSpec, base: float, refusal: ParameterError) -> ParameterError:
    """A base circle that the arm does not reach, with the nearest one that it does."""
    swing = spec.oscillating
    if swing is None or spec.follower == "flat":
        return refusal
    low = abs(swing.centre_distance - swing.arm_length) - spec.follower_radius
    high = swing.centre_distance + swing.arm_length - spec.follower_radius
    margin = 1e-3 * (high - low)
    limit = f"at least {at_least(low + margin, 4)}" if base < high else f"at most {at_most(high - margin, 4)}"
    return ParameterError("base_circle_radius", base, f"the arm does not reach this circle; {limit} mm works")


def _least_base(spec: CamSpec, motion: FollowerMotion) -> float:
    """The base circle by the textbook's condition: r_0 + rho of a flat face, r_0 - r of a roller."""
    from geometry.cams.synthesis import convex_roller_base_radius, flat_base_radius, roller_prime_radius

    angle = spec.least_transmission_angle_deg
    if angle is None:
        remedy = "is missing; give it, or least_transmission_angle_deg, from which the least one follows"
        raise ParameterError("base_circle_radius", None, remedy)
    if spec.follower == "flat":
        if angle != 45:
            remedy = "a flat face always pushes along its normal: 45 stands for the tangent's slope in S(S''); 45 works"
            raise ParameterError("least_transmission_angle_deg", angle, remedy)
        return max(flat_base_radius(motion, spec.least_curvature_radius).value, 1e-3 * motion.lift)
    prime = roller_prime_radius(motion, spec.follower_offset, math.radians(90 - angle))
    base = prime - spec.follower_radius
    if not base > 0:
        remedy = f"the prime circle is {prime:.6g} mm only; {_smaller(prime)}"
        raise ParameterError("follower_radius", spec.follower_radius, remedy)
    if spec.follower == "pointed":
        return base
    rho = spec.least_curvature_radius
    return max(base, convex_roller_base_radius(motion, spec.follower_radius, rho, follower_offset=spec.follower_offset))


def _smaller(prime: float) -> str:
    return f"at most {at_most(prime * 0.999, 4)} mm works" if prime > 0 else "a base_circle_radius works"


def _whole(spec: CamSpec, cam: DiskCam) -> str:
    """What base circle leaves the cam whole, in words."""
    from geometry.cams.undercut import is_whole

    if is_trial():
        return "a larger one works"

    def works(base: float) -> bool:
        try:
            from msgspec.structs import replace

            return is_whole(cam_of(replace(spec, base_circle_radius=base)))
        except GeometryError:
            return False

    low = base_radius(cam)
    high = 2 * low
    for _ in range(12):
        if works(high):
            break
        high *= 1.5
    else:
        # a flat face that swings has a greatest base circle too
        high = next((h for h in (low * (1 + k / 16) for k in range(1, 16)) if works(h)), 0.0)
    if high == 0:
        return without_base(cam)
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2
        low, high = (low, middle) if works(middle) else (middle, high)
    return f"at least {at_least(high, 4)} mm works"


def cam_holes(spec: CamSpec | LinkageCamSpec, cam: DiskCam) -> HubHoles:
    """Bore, holes and timing mark of a cam."""
    return with_timing_mark(_core_of(spec), spec.timing_mark, cam, inner_radius(cam))


def _core_of(spec: CamSpec | LinkageCamSpec) -> HubHoles:
    if spec.bore is not None and spec.bore_diameter > 0:
        raise ParameterError("bore_diameter", spec.bore_diameter, "give either bore_diameter or bore; 0 works")
    bore = RoundBoreTable(spec.bore_diameter) if spec.bore_diameter > 0 else spec.bore
    return hub_holes(bore, spec.holes, None)


def _shape_of(spec: CamSpec) -> WheelShape:
    return wheel_shape(spec.face_width, None, spec.hub, spec.face_chamfer)


def _check_plate(spec: CamSpec, cam: DiskCam) -> None:
    """The contact stays on the follower's face."""
    if spec.plate_diameter is None:
        return
    if spec.follower not in ("flat", "mushroom") or spec.oscillating is not None:
        raise ParameterError(
            "plate_diameter", spec.plate_diameter, "is for translating flat and mushroom followers only"
        )
    least = cam.least_plate_diameter()
    if not spec.plate_diameter >= least:
        remedy = f"the contact runs over the plate's edge; at least {at_least(least, 4)} mm works"
        raise ParameterError("plate_diameter", spec.plate_diameter, remedy)


def check_cam_bore(spec: CamSpec | LinkageCamSpec, cam: DiskCam) -> None:
    """The holes stay inside the circle that is surely material."""
    holes, inside = _core_of(spec), inner_radius(cam)
    if not holes.bore_reach < inside:
        raise wide_bore(spec, inside, "leaves no wall to the base circle")
    if holes.reach > inside:
        remedy = f"the holes must stay inside the base circle, within {inside:.6g} mm of the axis"
        raise ParameterError("holes", 2 * holes.reach, remedy)


def cam_outline(cam: DiskCam, offset: float) -> Profile:
    """The profile moved ``offset`` mm out of the material."""
    from geometry.cams.shape import cam_shape

    return cam_shape(cam, offset).profile


def cam_section(cam: DiskCam, holes: HubHoles, offset: float) -> OffsetRegion:
    """The exact section with every boundary moved out of the material."""
    from geometry.cams.shape import cam_shape

    inside = inner_radius(cam)
    if not inside + offset > (holes.reach - offset if holes.number else 0.0):
        least = (holes.reach - inside) / 2 if holes.number else -inside
        raise OffsetError(offset, "leaves no rim", least * (1 - 1e-9))
    try:
        shape = cam_shape(cam, offset)
    except GeometryError as refusal:
        raise OffsetError(offset, "leaves no outline", nearest_offset(cam, offset)) from refusal
    found = (Finding("outline_trimmed", float(len(shape.gaps)), offset),) if shape.gaps else ()
    return OffsetRegion(Region(shape.profile, holes.profiles(offset)), offset, found)


def nearest_offset(cam: DiskCam, refused: float) -> float:
    """The offset of the outline nearest to a refused one that works, mm."""
    works, fails = 0.0, refused
    for _ in range(24):
        middle = (works + fails) / 2
        try:
            cam_outline(cam, middle)
            works = middle
        except GeometryError:
            fails = middle
    return works


def cam_circles(cam: DiskCam) -> dict[str, float]:
    """Named diameters of a cam, mm."""
    circles = {"base_circle_diameter": 2 * base_radius(cam)}
    if cam.radius > 0:
        circles["prime_circle_diameter"] = 2 * (base_radius(cam) + cam.radius)
    return circles

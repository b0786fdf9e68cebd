"""The part kind ``linkage_cam``: a disk cam whose follower is carried by the connecting rod of a linkage.

General plane motion of the follower: Savvin's synthesis of plane cams.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta, Struct

from geometry.errors import ParameterError, UndercutError, at_least
from geometry.findings import Finding
from geometry.profile import Profile
from geometry.wheel import check_wheel, wheel_body, wheel_sections
from parts.cam import cam_circles, cam_holes, cam_outline, cam_section, check_cam_bore, inner_radius
from parts.cam_keys import PhaseTable, check_stroke, motion_of
from parts.hole_keys import BoreTable, HolesTable
from parts.keys import BoreDiameter, Colour, Density, FaceWidth, Material, mm
from parts.linkage_keys import Coordinate, DrivenRocker, DrivenSlider, GuidingRocker, GuidingSlider, drive_of, guide_of
from parts.linkage_remedies import refusal_of
from parts.materials import density_of
from parts.part import Part
from parts.timing_mark import TimingMarkTable
from parts.wheel_keys import FaceChamfer, FaceChamferTable, HubTable, wheel_shape

if TYPE_CHECKING:
    from geometry.cams.linkage_cam import LinkageCam

_MOST = 100_000.0
# usual limits, degrees: the pressure angle of a follower that turns, and the transmission angle of a linkage
_USUAL_PRESSURE_ANGLE, _USUAL_TRANSMISSION_ANGLE = 45.0, 40.0
# rollers are kept below this share of the least convex radius of the pitch curve
_USUAL_ROLLER_SHARE = 0.8


class LinkageCamSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="linkage_cam"):
    """Disk cam for a follower on the coupler of a linkage; it turns counter-clockwise about the origin."""

    follower: Annotated[
        Literal["pointed", "roller", "mushroom", "flat"], Meta(description="shape of the follower's end")
    ]
    driven: DrivenRocker | DrivenSlider
    coupler_length: Annotated[float, mm("from joint A to joint B", above=0, most=_MOST)]
    guide: GuidingRocker | GuidingSlider
    coupler_point: Annotated[
        tuple[Coordinate, Coordinate],
        Meta(
            description="roller's centre, tip, arc's centre or a point of the face, from joint A, +x towards joint B",
            extra={"unit": "mm"},
        ),
    ]
    follower_direction_deg: Annotated[
        float,
        Meta(
            ge=-360,
            le=360,
            description="stem, or normal of a flat face, away from the cam, from the coupler's +x",
            extra={"unit": "degrees"},
        ),
    ] = 0.0
    follower_radius: Annotated[float, mm("radius of the roller or mushroom", least=0, most=_MOST)] = 0.0
    plate_diameter: (
        Annotated[float, mm("width of a flat or mushroom face about coupler_point", above=0, most=_MOST)] | None
    ) = None
    lift: Annotated[float, mm("travel of a driven slider", least=0, most=_MOST)] = 0.0
    swing_deg: Annotated[
        float, Meta(ge=0, lt=180, description="swing of a driven rocker", extra={"unit": "degrees"})
    ] = 0.0
    phases: Annotated[list[PhaseTable], Meta(min_length=1, max_length=100)] | None = None
    motion_table: (
        Annotated[
            list[tuple[float, float]],
            Meta(min_length=3, max_length=2000, description="in place of phases: [cam angle deg, travel mm or deg]"),
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


def checked_linkage_cam(spec: LinkageCamSpec) -> LinkageCam:
    """The cam of a part, checked to exist and to move its follower all the way.

    Raises
    ------
    ParameterError
        Names the key and the nearest value that was tried and works.
    """
    from geometry.cams.undercut import kept_arcs

    try:
        cam = linkage_cam_of(spec)
        try:
            gaps = kept_arcs(cam).gaps
        except UndercutError:
            gaps, told = None, "all of the profile"
        if gaps is None or gaps:
            if gaps:
                told = f"{max(g.lost_lift for g in gaps):.4g} {'rad' if cam.swings else 'mm'} of lift"
            raise UndercutError("follower_radius", spec.follower_radius, f"the cam is undercut and loses {told}")
    except ParameterError as refusal:
        raise refusal_of(spec, refusal, whole_cam_of, _check_part) from refusal
    _check_part(spec, cam)
    return cam


def whole_cam_of(spec: LinkageCamSpec) -> LinkageCam:
    """The cam of the keys where the quick test proves that nothing is undercut, for trials."""
    from geometry.cams.undercut import is_whole

    cam = linkage_cam_of(spec)
    if not is_whole(cam):
        raise UndercutError("follower_radius", spec.follower_radius, "the cam is undercut")
    return cam


def _check_part(spec: LinkageCamSpec, cam: LinkageCam) -> None:
    """Plate, bore, holes and body fit the cam."""
    _check_plate(spec, cam)
    check_cam_bore(spec, cam)
    shape = wheel_shape(spec.face_width, None, spec.hub, spec.face_chamfer)
    check_wheel(shape, 2 * inner_radius(cam), cam_holes(spec, cam))


def linkage_cam_of(spec: LinkageCamSpec) -> LinkageCam:
    """The cam of the keys, not yet checked for undercut."""
    from geometry.cams.disk import FollowerKind
    from geometry.cams.linkage import Linkage
    from geometry.cams.linkage_cam import check_holds, linkage_cam

    swings = isinstance(spec.driven, DrivenRocker)
    check_stroke(spec, swings, "")
    key = "swing_deg" if swings else "lift"
    unit = math.radians(1.0) if swings else 1.0
    table = None if spec.motion_table is None else [(a, s * unit) for a, s in spec.motion_table]
    motion = motion_of(spec.phases, table, getattr(spec, key) * unit, key)
    linkage = Linkage(drive_of(spec.driven), spec.coupler_length, guide_of(spec.guide))
    cam = linkage_cam(
        motion,
        FollowerKind(spec.follower),
        linkage,
        complex(*spec.coupler_point),
        direction=math.radians(spec.follower_direction_deg),
        radius=spec.follower_radius,
    )
    check_holds(cam)
    return cam


def _check_plate(spec: LinkageCamSpec, cam: LinkageCam) -> None:
    """The contact stays on the follower's face."""
    if spec.plate_diameter is None:
        return
    if spec.follower not in ("flat", "mushroom"):
        raise ParameterError(
            "plate_diameter", spec.plate_diameter, "is for flat and mushroom followers only; remove it"
        )
    least = cam.least_plate_diameter()
    if not spec.plate_diameter >= least:
        remedy = f"the contact runs over the plate's edge; at least {at_least(least, 4)} mm works"
        raise ParameterError("plate_diameter", spec.plate_diameter, remedy)


def linkage_cam_part(part_id: str, spec: LinkageCamSpec, cam: LinkageCam) -> Part:
    """The part of a cam; sections are computed when an export asks."""
    holes, shape = cam_holes(spec, cam), wheel_shape(spec.face_width, None, spec.hub, spec.face_chamfer)
    section = lru_cache(maxsize=8)(lambda offset: cam_section(cam, holes, offset))

    def outline(offset: float, depth: float) -> Profile:
        return section(offset).region.outer if depth == 0 else cam_outline(cam, offset - depth)

    sections = wheel_sections(outline, inner_radius(cam), holes)
    return Part(
        part_id,
        "linkage_cam",
        section,
        lru_cache(maxsize=2)(lambda offset: wheel_body(shape, sections, offset)),
        spec.face_width,
        shape.is_plate,
        linkage_findings(spec, cam),
        cam_circles(cam),
        _quantities(cam),
        spec.material,
        spec.colour,
        spec.density or density_of(spec.material),
        cam=cam,
    )


def _quantities(cam: LinkageCam) -> dict[str, float]:
    """Named results: sizes in mm, angles in degrees."""
    from geometry.cams.follower_motion import PhaseKind
    from geometry.cams.synthesis import greatest_pressure_angle, least_convex_radius

    travel = math.degrees(cam.motion.lift) if cam.swings else cam.motion.lift
    found = {"swing_deg" if cam.swings else "lift": travel}
    if cam.radius > 0:
        found["follower_radius"] = cam.radius
    for kind in (PhaseKind.RISE, PhaseKind.RETURN):
        if cam.motion.moving_pieces(kind):
            name = f"pressure_angle_{'rise' if kind is PhaseKind.RISE else 'return'}_deg"
            found[name] = math.degrees(greatest_pressure_angle(cam, kind).value)
    if cam.radius > 0:
        found["contact_pressure_angle_deg"] = math.degrees(cam.greatest(cam.contact_pressure_angle))
    found["least_curvature_radius"] = least_convex_radius(cam).value
    found["coupler_swing_deg"] = math.degrees(cam.member_swing("coupler"))
    found["least_transmission_angle_deg"] = math.degrees(cam.mount.linkage.transmission_angle())
    if cam.kind != "roller":
        found["greatest_sliding_velocity"] = cam.greatest(cam.sliding_velocity)
    if cam.kind in ("flat", "mushroom"):
        found["face_from"], found["face_to"] = cam.face_reach()
        found["least_plate_diameter"] = cam.least_plate_diameter()
    return found


def linkage_findings(spec: LinkageCamSpec, cam: LinkageCam) -> tuple[Finding, ...]:
    """Impacts, steep pressure angles, large rollers, poor transmission angles."""
    from geometry.cams.follower_motion import PhaseKind
    from geometry.cams.synthesis import greatest_pressure_angle, least_convex_radius

    found = []
    for impact, order in (("rigid", 1), ("soft", 2)):
        jumps = [(abs(j.jumps[order]), math.degrees(j.angle)) for j in cam.motion.impacts() if j.impact == impact]
        if jumps:
            found.append(Finding(f"{impact}_impact", *max(jumps)))
    steepest = math.degrees(greatest_pressure_angle(cam, PhaseKind.RISE).value)
    if steepest > _USUAL_PRESSURE_ANGLE + 1e-9:
        found.append(Finding("steep_pressure_angle", steepest, _USUAL_PRESSURE_ANGLE))
    transmission = math.degrees(cam.mount.linkage.transmission_angle())
    if transmission < _USUAL_TRANSMISSION_ANGLE:
        found.append(Finding("small_transmission_angle", transmission, _USUAL_TRANSMISSION_ANGLE))
    convex = least_convex_radius(cam).value
    if cam.kind == "roller" and cam.radius > _USUAL_ROLLER_SHARE * (convex + cam.radius):
        found.append(Finding("large_roller", cam.radius, _USUAL_ROLLER_SHARE * (convex + cam.radius)))
    if convex < spec.least_curvature_radius * (1 - 1e-6):
        found.append(Finding("linkage_curvature_radius", convex, spec.least_curvature_radius))
    return tuple(found)

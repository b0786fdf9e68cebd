"""``higherpair calc cam`` of a cam whose follower sits on the connecting rod of a linkage."""

from __future__ import annotations

import math
from typing import Annotated

import numpy as np

from geometry.cams.motion.follower_motion import PhaseKind
from geometry.cams.plane.coupler import LinkageCam
from geometry.cams.plane.synthesis import least_convex_radius
from geometry.kinematics.linkage import RockerDrive, RockerGuide, SliderDrive, SliderGuide
from parts.base.texts import N_, message
from parts.cams.coupler_cam.part import LINKAGE_CAM, LinkageCamSpec, linkage_findings
from parts.cams.coupler_cam.position_page import point, position_at, position_steps
from parts.cams.disk_cam.page import finish, phases_of, roller_section
from parts.cams.disk_cam.part import pressure_angles
from parts.cams.wheel import inner_radius
from parts.keys.base import degrees
from parts.keys.linkage import DrivenSlider
from parts.pages.cam_steps import (
    DEFAULT_INTERVALS,
    TOPIC,
    Drawing,
    Intervals,
    Speed,
    Step,
    cam_angles,
    coefficient_steps,
    phase_steps,
    positions,
    radius_step,
)
from parts.pages.inputs import calculation
from parts.pages.page import Sheet, Table, table_of
from parts.texts.findings import finding_message

_SAMPLES = 720
# remarks of every page
_NOTES = (
    N_("the graphical method integrates the motion S of the driven member; the profile drawn from it is the linkage's"),
    N_("nu_0 is at the centre of a roller, which turns freely; nu, Savvin's (28), at the contact with a follower "
     "that is fixed to the connecting rod"),
)  # fmt: skip

_POSITION = degrees("cam angle worked out in numbers; default: middle of the first rise", least=0, below=360)


class LinkageKeys(LinkageCamSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a linkage cam, the step of its table, and the position that is worked out in numbers."""

    step: Step = 10.0
    intervals: Intervals = DEFAULT_INTERVALS
    drawing: Drawing = "smooth"
    speed_rpm: Speed | None = None
    position_deg: Annotated[float, _POSITION] | None = None


@calculation(TOPIC, LinkageKeys)
def sheet(keys: LinkageKeys) -> Sheet:
    """The calculation of a linkage cam."""
    cam = LINKAGE_CAM.thing(keys, {})
    title = N_("Cam with its follower on a connecting rod")
    page, phases = Sheet(TOPIC, title), phases_of(cam)
    phase_steps(page, phases)
    radius_step(page, cam.kind, cam.radius)
    _linkage(page, keys, cam)
    coefficient_steps(page, phases)
    _sizes(page, keys, cam)
    roller_section(page, cam, keys.least_curvature_radius)
    position_steps(page, position_at(cam, _chosen(keys, cam)))
    page.data["phases"] = phases.data()
    page.tables.append(positions(cam, keys.step, speed_rpm=keys.speed_rpm))
    page.tables.append(linkage_table(cam, keys.step))
    finish(page, keys, cam, _NOTES)
    told = [f for f in linkage_findings(keys, cam) if not f.code.endswith("_impact")]
    page.notes += [finding_message(f) for f in told]
    return page


def _chosen(keys: LinkageKeys, cam: LinkageCam) -> float:
    """The cam angle that is worked out, rad: as typed, or the middle of the first rise."""
    if keys.position_deg is not None:
        return math.radians(keys.position_deg)
    at = 0.0
    for phase in cam.motion.phases:
        if phase.kind is PhaseKind.RISE:
            return at + phase.angle / 2
        at += phase.angle
    # a table of points: where it rises most steeply
    angle = np.linspace(0, 2 * math.pi, _SAMPLES, endpoint=False)
    return float(angle[np.argmax(cam.motion.value(angle, 1))])


def _linkage(page: Sheet, keys: LinkageKeys, cam: LinkageCam) -> None:
    """The data of the linkage, fixed frame: the axis of the cam is its origin."""
    page.section("Linkage (the axis of the cam is the origin)")
    linkage = cam.mount.linkage
    drive, guide = linkage.drive, linkage.guide
    if isinstance(drive, RockerDrive):
        point(page, ("driven_pivot_x", "driven_pivot_y"), drive.pivot)
        page.told(driven_length=drive.length, driven_start_angle_deg=math.degrees(drive.start_angle))
    elif isinstance(drive, SliderDrive) and isinstance(keys.driven, DrivenSlider):
        point(page, ("driven_start_x", "driven_start_y"), drive.start)
        page.add("driven_direction_deg", keys.driven.direction_deg)
    page.add("coupler_length", linkage.coupler_length)
    if isinstance(guide, RockerGuide):
        point(page, ("guide_pivot_x", "guide_pivot_y"), guide.pivot)
        page.add("guide_length", guide.length)
    elif isinstance(guide, SliderGuide):
        point(page, ("guide_through_x", "guide_through_y"), guide.point)
        page.add("guide_direction_deg", math.degrees(guide.direction))
    point(page, ("coupler_point_x", "coupler_point_y"), cam.mount.point)
    if str(cam.kind) in ("flat", "mushroom"):
        page.add("follower_direction_deg", math.degrees(cam.mount.direction))


def _sizes(page: Sheet, keys: LinkageKeys, cam: LinkageCam) -> None:
    """What the cam and the linkage reach over a turn."""
    page.section("Sizes")
    page.told(curvature_reserve=keys.least_curvature_radius or None)
    page.told(least_cam_radius=inner_radius(cam), greatest_cam_radius=cam.greatest(lambda t: np.abs(cam.contact(t))))
    page.told(**pressure_angles(cam))
    if cam.radius:
        page.add("contact_pressure_angle_deg", math.degrees(cam.greatest(cam.contact_pressure_angle)))
    page.add("least_curvature_radius", least_convex_radius(cam).value)
    page.add("coupler_swing_deg", math.degrees(cam.member_swing("coupler")))
    page.add("joint_transmission_angle_deg", math.degrees(cam.mount.linkage.transmission_angle()))
    if str(cam.kind) != "roller":
        page.add("greatest_sliding_velocity", cam.greatest(cam.sliding_velocity))
    if str(cam.kind) in ("flat", "mushroom"):
        low, high = cam.face_reach()
        page.told(face_from=low, face_to=high, least_plate_diameter=cam.least_plate_diameter())


def linkage_table(cam: LinkageCam, step: float) -> Table:
    """Joints, coupler angle, reference point, transmission angle, pressure angle and sliding at the contact."""
    degrees, angle = cam_angles(cam.motion, step)
    linkage = cam.mount.linkage
    joint, turn = (x[0] for x in linkage.pose([cam.motion.value(angle)]))
    far, place = joint + linkage.coupler_length * turn, cam.place(angle)
    guide = linkage.guide
    if isinstance(guide, RockerGuide):
        across = np.abs((np.conj(turn) * (far - guide.pivot)).imag) / guide.length
    else:
        assert isinstance(guide, SliderGuide)
        across = np.abs((turn * np.exp(-1j * guide.direction)).real)
    columns = [degrees, np.degrees(np.unwrap(np.angle(turn)))]
    for at in (joint, far, place):
        columns += [at.real, at.imag]
    columns += [np.degrees(np.arcsin(np.minimum(across, 1.0))), np.degrees(cam.contact_pressure_angle(angle))]
    columns.append(cam.sliding_velocity(angle))
    heads = [("phi", "deg"), ("theta", "deg"), ("x_A", "mm"), ("y_A", "mm"), ("x_B", "mm"), ("y_B", "mm"),
             ("x_02", "mm"), ("y_02", "mm"), ("mu", "deg"), ("nu_c", "deg"), ("v_s", "mm/rad")]  # fmt: skip
    columns_told = N_(
        "Linkage: coupler angle, joints, follower, transmission angle, pressure angle at the contact, {last}"
    )
    last = message("rolling velocity") if str(cam.kind) == "roller" else message("sliding velocity")
    return table_of("linkage", message(columns_told, last=last), heads, zip(*columns, strict=True))

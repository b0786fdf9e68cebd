"""``higherpair calc cam``: phases, coefficients, least sizes, table of motion and profile, of every kind of cam.

A scene's part tells its kind; without a scene ``kind=groove_cam`` does. The disk cam's own page is here.
"""

from __future__ import annotations

import importlib
import math
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from geometry.base.errors import ConvergenceError, GeometryError
from geometry.cams.motion.follower_motion import PhaseKind
from geometry.cams.motion.guides import Oscillating, Translating, oscillating_prime_radius
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.rocker import rocker_base
from geometry.cams.plane.synthesis import (
    flat_base_radius,
    greatest_pressure_angle,
    least_convex_radius,
    least_pitch_radius,
    oscillating_axis,
    oscillating_start_angles,
    roller_prime_radius,
)
from geometry.laws.contour import Contour
from parts.base.refusal import SceneError, meant
from parts.base.texts import N_
from parts.cams.disk_cam.contour import contour_of
from parts.cams.disk_cam.graphical_page import graphical_section
from parts.cams.disk_cam.part import (
    CAM,
    USUAL_ROLLER_SHARE,
    CamSpec,
    largest_roller_radius,
    pressure_angles,
    pressure_limits,
)
from parts.cams.disk_cam.scale_page import DrawnTable, scale_section
from parts.cams.disk_cam.speed_page import speed_section
from parts.cams.wheel import inner_radius
from parts.pages.cam_steps import (
    DEFAULT_INTERVALS,
    LESSON_4,
    LESSON_5,
    TOPIC,
    Cutter,
    Drawing,
    Intervals,
    Phases,
    Speed,
    Step,
    coefficient_steps,
    impact_notes,
    phase_steps,
    positions,
    radius_step,
)
from parts.pages.inputs import PLACE, SceneKeys, calculation, chosen_part, given
from parts.pages.misprints import printed_for_cam, printed_for_rise
from parts.pages.page import Sheet

# where the page of each kind is made of its keys as a table
PAGES = {
    "cam": ("parts.cams.disk_cam.page", "disk_sheet"),
    "groove_cam": ("parts.cams.groove_cam.page", "sheet"),
    "conjugate_cam": ("parts.cams.positive.page", "conjugate_sheet"),
    "yoke_frame": ("parts.cams.positive.page", "yoke_sheet"),
    "wedge_cam": ("parts.cams.wedge_cam.page", "sheet"),
    "barrel_cam": ("parts.cams.barrel_cam.page", "sheet"),
    "linkage_cam": ("parts.cams.coupler_cam.page", "sheet"),
}
OTHER_KINDS = tuple(("kind", kind) for kind in PAGES if kind != "cam")


class CamKeys(CamSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of the topic: those of a cam, and the step of its table."""

    step: Step = 10.0
    intervals: Intervals = DEFAULT_INTERVALS
    drawing: Drawing = "smooth"
    speed_rpm: Speed | None = None
    cutter_diameter: Cutter | None = None
    drawn: DrawnTable | None = None


def table_from(scene: SceneKeys, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The keys of a cam of a scene, changed by those of the command line.

    A conjugate cam or a yoke has the keys of the cam that it is made of under ``of``.
    """
    kinds = {key: spec.__struct_config__.tag for key, spec in scene.parts.items()}
    cams = [key for key, kind in kinds.items() if kind in PAGES]
    # a page of the second disk or of the yoke tells of the cam too
    whole = [c for c in cams if c not in {getattr(scene.parts[other], "of", None) for other in cams}]
    chosen = chosen_part("cam", cams, whole, source, table)
    found, kind = given(scene.parts[chosen]), kinds[chosen]
    if kind == "cam":
        return found | table
    # a linkage's member is changed key by key, or given anew with its name
    for key in ("driven", "guide"):
        if isinstance(table.get(key), dict) and "member" not in table[key] and key in found:
            table[key] = found[key] | table[key]
    owner = scene.parts.get(getattr(scene.parts[chosen], "of", ""))
    if owner is not None:
        found["of"] = given(owner) | (table.pop("of") if isinstance(table.get("of"), dict) else {})
    return found | table | {"kind": kind}


def sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of one cam."""
    kind = table.get("kind", "cam")
    if not isinstance(kind, str) or kind not in PAGES:
        raise SceneError(PLACE, "kind", kind, "unknown_kind", meant(kind, PAGES), known=list(PAGES))
    module, name = PAGES[kind]
    page: Sheet = getattr(importlib.import_module(module), name)({k: v for k, v in table.items() if k != "kind"})
    return page


@calculation(TOPIC, CamKeys)
def disk_sheet(keys: CamKeys) -> Sheet:
    """The calculation of one disk cam."""
    return disk_page(keys, CAM.thing(keys, {}))


def phases_of(cam: DiskCam) -> Phases:
    """The phases of a disk cam."""
    return Phases(cam.motion.phases, cam.motion.lift, cam.swings, left_rows=cam.motion.left_rows)


def disk_page(keys: CamKeys, cam: DiskCam) -> Sheet:
    """The page of a disk cam."""
    page = Sheet(TOPIC, N_("Disk cam"))
    phases = phases_of(cam)
    characteristics(page, keys, cam)
    if sorted(name for name, _ in phases.named()) == ["far", "near", "return", "rise"]:
        worked = 360 - float(page.value_of("phi_n").value)
        page.add("working_angle_deg", worked, "{phi_r} + {phi_f} + {phi_b}", LESSON_4)
    coefficient_steps(page, phases)
    sizes(page, keys, cam)
    if keys.contour is not None:
        contour_section(page, contour_of(keys), cam)
    roller_section(page, cam, keys.least_curvature_radius)
    page.data["phases"] = phases.data()
    page.tables.append(positions(cam, keys.step, speed_rpm=keys.speed_rpm, cutter_diameter=keys.cutter_diameter))
    asked = keys.least_transmission_angle_deg
    finish(page, keys, cam, limits=(None, None) if asked is None else pressure_limits(keys, asked))
    if keys.drawn is not None:
        scale_section(page, cam, keys.drawn)
    for phase in cam.motion.phases:
        if phase.law is not None and cam.is_flat:
            angle = round(math.degrees(phase.angle), 9)
            page.notes += printed_for_rise(phase.law.name, phase.lift, angle)
    angles = [round(math.degrees(phase.angle), 9) for phase in cam.motion.phases]
    if not cam.swings:
        page.notes += printed_for_cam(cam.kind, [cam.motion.lift, *angles, keys.follower_offset])
    return page


def finish(
    page: Sheet,
    keys: Any,
    cam: DiskCam,
    notes: Sequence[str] = (),
    limits: tuple[float | None, float | None] = (None, None),
) -> None:
    """The graphical method (its least radius by these angles), velocities, ``notes`` and the remarks on the motion."""
    graphical_section(page, cam, limits, keys.intervals, keys.drawing)
    if keys.speed_rpm is not None:
        speed_section(page, cam.motion, keys.speed_rpm, slides=not cam.swings)
    page.notes += notes
    impact_notes(page, cam.motion)


def characteristics(page: Sheet, keys: Any, cam: DiskCam) -> None:
    """The characteristics table of the sheets: H, phases, E, gamma_min."""
    phase_steps(page, phases_of(cam))
    if isinstance(cam.mount, Oscillating):
        _arm_steps(page, keys, cam, cam.mount)
    else:
        page.add("follower_offset", keys.follower_offset)
    page.told(least_transmission_angle_deg=keys.least_transmission_angle_deg)
    radius_step(page, cam.kind, cam.radius)


def _arm_steps(page: Sheet, keys: Any, cam: DiskCam, mount: Oscillating) -> None:
    """How the follower swings, as the scene has it: the pivot, the arm, or the face beside the pivot."""
    if keys.oscillating.centre_distance is not None:
        page.add("centre_distance", mount.centre_distance)
    if cam.is_flat:
        page.add("face_offset", mount.face_offset)
    else:
        page.add("arm_length", mount.arm_length)


def sizes(page: Sheet, keys: CamKeys, cam: DiskCam) -> None:
    """Least radius by the pressure angle or the curvature, and what the cam has."""
    page.section("Sizes")
    asked = keys.least_transmission_angle_deg
    page.told(least_return_transmission_angle_deg=keys.least_return_transmission_angle_deg or None)
    if isinstance(cam.mount, Translating):
        if cam.is_flat:
            page.add("least_prime_circle_radius", flat_base_radius(cam.motion).value, "", LESSON_4)
        elif asked is not None:
            rise, back = pressure_limits(keys, asked)
            whole = (back, "least_prime_circle_radius")
            for limit, name in (whole,) if back is None else ((None, "least_rise_radius"), whole):
                least = roller_prime_radius(cam.motion, keys.follower_offset, rise, limit)
                page.add(name, least, "", LESSON_5)
    if isinstance(cam.mount, Oscillating):
        if cam.is_flat:
            _rocker(page, keys, cam, cam.mount)
        elif asked is not None:
            rocker_sizes(page, keys, cam, cam.mount, *pressure_limits(keys, asked))
    page.told(curvature_reserve=keys.least_curvature_radius or None)
    base = cam.base_radius
    derived = cam.is_flat and keys.base_circle_radius is None and keys.least_curvature_radius > 0
    exact = derived and abs(base - flat_base_radius(cam.motion).value - keys.least_curvature_radius) < 1e-12 * base
    told = ("{r_0} + {rho}", LESSON_4) if exact else ("", "")
    base_step(page, cam, *told, given=keys.base_circle_radius is not None)
    if isinstance(cam.mount, Translating):
        # the profile's farthest point stands on the radius of the highest place of the follower, fig. 4.3
        beside = 0.0 if cam.is_flat else cam.mount.offset
        most = math.hypot(beside, cam.mount.start_height + cam.motion.extremes()[1]) - cam.radius
        page.add("greatest_cam_radius", most, *(("", "") if beside else ("{R_min} + {H}", LESSON_4)))
    reached(page, cam)
    page.add("least_curvature_radius", least_convex_radius(cam).value)
    if isinstance(cam.mount, Translating) and cam.kind in ("flat", "mushroom"):
        page.add("least_plate_diameter", cam.least_plate_diameter())


def base_step(page: Sheet, cam: DiskCam, formula: str = "", source: str = "", *, given: bool = False) -> None:
    """The base circle; it is the least radius of a cam whose follower stands lowest at S = 0."""
    lowest = cam.motion.starts_lowest
    name = "least_base_circle_radius" if lowest else "base_circle_radius"
    page.add(name, cam.base_radius, formula, source, given=given)
    if not lowest:
        page.add("least_cam_radius", inner_radius(cam))


def contour_section(page: Sheet, shape: Contour, cam: DiskCam) -> None:
    """The sizes of an outline of arcs and lines, those that followed among them, and where the contact changes."""
    page.section("Contour")
    page.add("nose_radius", shape.nose_radius)
    page.add("nose_distance", shape.centre_distance, "{R_min} + {H} - {r_n}")
    if shape.is_eccentric:
        return
    if shape.curvature:
        page.add("flank_radius", 1 / shape.curvature)
    change = shape.nose_normal if cam.is_flat else shape.change(cam.radius)
    page.told(nose_change_deg=math.degrees(change), nose_change_lift=float(cam.motion.value(change)))


def roller_section(page: Sheet, cam: DiskCam, least_curvature_radius: float) -> None:
    """The largest roller that the pitch curve allows: of two reserves the one that counts."""
    if cam.kind != "roller":
        return
    most, pitch = largest_roller_radius(cam, least_curvature_radius), least_pitch_radius(cam)
    page.section("Roller")
    page.add("least_pitch_radius", pitch)
    if not most:
        return
    usual = most == USUAL_ROLLER_SHARE * pitch
    page.add("largest_roller_radius", most, f"{USUAL_ROLLER_SHARE} * {{rho_p}}" if usual else "{rho_p} - {rho}")


def reached(page: Sheet, cam: DiskCam) -> None:
    """Initial height, and the pressure angles that the cam has."""
    if isinstance(cam.mount, Translating):
        page.add("initial_height", cam.mount.start_height)
    if isinstance(cam.mount, Oscillating):
        page.add("start_angle_deg", math.degrees(cam.mount.start_angle))
    page.told(**pressure_angles(cam))
    if not cam.is_flat and cam.motion.moving_pieces(PhaseKind.RISE):
        steep = math.degrees(greatest_pressure_angle(cam, PhaseKind.RISE).value)
        page.add("transmission_angle_reached_deg", 90 - steep, "", LESSON_5)


def _rocker(page: Sheet, keys: CamKeys, cam: DiskCam, mount: Oscillating) -> None:
    """The least base circle of a flat rocker's convex cam at its pivot's distance, where there is one."""
    with suppress(GeometryError):
        least = rocker_base(
            cam.motion, mount.centre_distance, mount.sense, mount.face_offset, keys.least_curvature_radius
        )
        page.add("least_prime_circle_radius", least.prime_radius)


def rocker_sizes(page: Sheet, keys: Any, cam: DiskCam, mount: Oscillating, rise: float, back: float | None) -> None:
    """The least prime circle of a swinging roller at its pivot's distance and at the best one.

    ``rise``, ``back``: the greatest pressure angles, rad; None: any.
    """
    arm = mount.arm_length
    if keys.oscillating.centre_distance is None:
        page.add("centre_distance", mount.centre_distance)
    whole = (back, "least_prime_circle_radius")
    for limit, name in (whole,) if back is None else ((None, "least_rise_radius"), whole):
        low, high = oscillating_start_angles(cam.motion, arm, mount.centre_distance, mount.sense, rise, limit)
        if low <= high:
            page.add(name, oscillating_prime_radius(low, mount.centre_distance, arm), "", LESSON_4)
    with suppress(ConvergenceError):
        best = oscillating_axis(cam.motion, arm, mount.sense, rise, back)
        page.told(best_centre_distance=best.centre_distance, smallest_prime_circle_radius=best.prime_radius)

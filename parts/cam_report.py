"""What a cam is told of itself: its sizes, its angles, and where it is poor."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from geometry.findings import Finding

if TYPE_CHECKING:
    from geometry.cams.disk import DiskCam
    from parts.cam import CamSpec

# usual limits of the pressure angle: translating 30, swinging 45 degrees (practicum: 30 to 35, 40 to 50)
_USUAL_PRESSURE_ANGLE = {False: 30.0, True: 45.0}
# rollers are kept below this share of the least convex radius of the pitch curve
_USUAL_ROLLER_SHARE = 0.8
# cam angles at which the greatest radius is looked for: off by a part in a million
_SAMPLES = 3601


def cam_quantities(spec: CamSpec, cam: DiskCam) -> dict[str, float]:
    """Named results of a cam: sizes in mm, angles in degrees."""
    from geometry.cams.follower_motion import PhaseKind
    from geometry.cams.synthesis import greatest_pressure_angle, least_convex_radius

    found: dict[str, float] = {}
    if spec.oscillating is None:
        found["lift"] = cam.motion.lift
    else:
        found["swing_deg"] = math.degrees(cam.motion.lift)
        found["start_angle_deg"] = math.degrees(cam.swing.start_angle)
    if cam.radius > 0:
        found["follower_radius"] = cam.radius
    if spec.oscillating is None and not cam.is_flat:
        found["follower_offset"] = spec.follower_offset
    for kind in (PhaseKind.RISE, PhaseKind.RETURN):
        if cam.motion.moving_pieces(kind):
            name = f"pressure_angle_{'rise' if kind is PhaseKind.RISE else 'return'}_deg"
            found[name] = math.degrees(greatest_pressure_angle(cam, kind).value)
    found["least_curvature_radius"] = least_convex_radius(cam).value
    if cam.kind in ("flat", "mushroom"):
        found["face_from"], found["face_to"] = cam.face_reach()
        if spec.oscillating is None:
            found["least_plate_diameter"] = cam.least_plate_diameter()
    return found


def cam_findings(spec: CamSpec, cam: DiskCam) -> tuple[Finding, ...]:
    """Impacts, steep pressure angles and large rollers of a cam."""
    from geometry.cams.follower_motion import PhaseKind
    from geometry.cams.synthesis import greatest_pressure_angle, least_convex_radius

    found = []
    for impact, order in (("rigid", 1), ("soft", 2)):
        jumps = [(abs(j.jumps[order]), math.degrees(j.angle)) for j in cam.motion.impacts() if j.impact == impact]
        if jumps:
            size, angle = max(jumps)
            found.append(Finding(f"{impact}_impact", size, angle))
    swings = spec.oscillating is not None
    steepest = math.degrees(greatest_pressure_angle(cam, PhaseKind.RISE).value)
    if steepest > _USUAL_PRESSURE_ANGLE[swings] + 1e-9:
        found.append(Finding("steep_pressure_angle", steepest, _USUAL_PRESSURE_ANGLE[swings]))
    pitch = least_convex_radius(cam).value + cam.radius
    if cam.kind == "roller" and cam.radius > _USUAL_ROLLER_SHARE * pitch:
        found.append(Finding("large_roller", cam.radius, _USUAL_ROLLER_SHARE * pitch))
    if spec.oscillating is None and cam.is_flat and spec.follower_offset != 0:
        found.append(Finding("flat_offset", spec.follower_offset, cam.least_plate_diameter()))
    if swings and (within := _greatest_radius(cam) - cam.swing.centre_distance) > 0:
        found.append(Finding("pivot_within_cam", within, cam.swing.centre_distance))
    if pitch - cam.radius < (asked := spec.least_curvature_radius) * (1 - 1e-6):
        found.append(Finding("curvature_radius_not_kept", pitch - cam.radius, asked))
    return tuple(found)


def _greatest_radius(cam: DiskCam) -> float:
    """Greatest distance of the profile from the axis, mm."""
    import numpy as np

    return float(np.abs(cam.profile_point(np.linspace(0, 2 * math.pi, _SAMPLES))).max())

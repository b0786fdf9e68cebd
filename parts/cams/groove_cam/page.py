"""``higherpair calc cam`` of a groove cam: the page of its motion, sizes that serve both ways, both walls."""

from __future__ import annotations

import math

from geometry.cams.motion.guides import Oscillating, Translating
from geometry.cams.plane.synthesis import least_convex_radius, least_hollow_radius, roller_prime_radius
from parts.base.texts import N_
from parts.cams.disk_cam.page import base_step, characteristics, finish, phases_of, reached, rocker_sizes
from parts.cams.groove_cam.part import GROOVE_CAM, GrooveCamSpec, GrooveDisk
from parts.cams.wheel import inner_radius
from parts.pages.cam_steps import (
    DEFAULT_INTERVALS,
    LESSON_5,
    TOPIC,
    Drawing,
    Intervals,
    Speed,
    Step,
    coefficient_steps,
    positions,
)
from parts.pages.inputs import calculation
from parts.pages.page import Sheet

_SIGN = N_("a radius of curvature is positive where the wall's material is convex, negative where it is hollow")


class GrooveKeys(GrooveCamSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a groove cam, and the step of its table."""

    step: Step = 10.0
    intervals: Intervals = DEFAULT_INTERVALS
    drawing: Drawing = "smooth"
    speed_rpm: Speed | None = None


@calculation(TOPIC, GrooveKeys)
def sheet(keys: GrooveKeys) -> Sheet:
    """The calculation of a groove cam."""
    disk = GROOVE_CAM.thing(keys, {})
    cam = disk.cam
    page, phases = Sheet(TOPIC, N_("Groove cam")), phases_of(disk.cam)
    characteristics(page, keys, cam)
    coefficient_steps(page, phases)
    _sizes(page, keys, disk)
    page.data["phases"] = phases.data()
    page.tables.append(positions(cam, keys.step, whose=N_("inner wall"), speed_rpm=keys.speed_rpm))
    beyond = cam.radius + disk.clearance
    outer = N_("outer wall")
    page.tables.append(positions(cam, keys.step, "positions_outer", outer, beyond=beyond, speed_rpm=keys.speed_rpm))
    # the drawing's least radius is that of the rise alone
    finish(page, keys, cam)
    page.note(_SIGN)
    return page


def _sizes(page: Sheet, keys: GrooveKeys, disk: GrooveDisk) -> None:
    cam = disk.cam
    page.section("Sizes")
    asked = keys.least_transmission_angle_deg
    limit = math.radians(90 - (asked or 0.0))
    if isinstance(cam.mount, Translating) and asked is not None:
        least = roller_prime_radius(cam.motion, keys.follower_offset, limit, limit)
        page.add("least_radius_both_ways", least, "", LESSON_5)
    if isinstance(cam.mount, Oscillating) and asked is not None:
        rocker_sizes(page, keys, cam, cam.mount, limit, limit)
    base_step(page, cam)
    reached(page, cam)
    page.told(least_curvature_radius=least_convex_radius(cam).value, least_hollow_radius=least_hollow_radius(cam).value)
    page.section("Groove")
    page.add("clearance", disk.clearance)
    page.add("groove_width", 2 * cam.radius + disk.clearance, "2 * {r} + {c_r}")
    page.add("least_path_radius", inner_radius(cam) + cam.radius)
    farthest = disk.outermost - cam.radius - disk.clearance
    page.add("greatest_path_radius", farthest)
    page.add("outer_wall_radius", disk.outermost, "{R_2} + {r} + {c_r}")
    page.told(groove_depth=disk.depth, outer_diameter=2 * disk.outer_radius)

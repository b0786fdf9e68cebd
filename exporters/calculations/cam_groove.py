"""``higherpair calc cam`` of a groove cam: the page of its motion, sizes that serve both ways, both walls."""

from __future__ import annotations

import math
from typing import Any

from exporters.calculations.cam import characteristics, finish, phases_of, reached
from exporters.calculations.cam_steps import (
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
from exporters.calculations.inputs import checked, refusal
from exporters.calculations.sheet import Sheet
from geometry.cams.mounts import Translating
from geometry.cams.synthesis import least_convex_radius, least_hollow_radius, roller_prime_radius
from geometry.errors import ParameterError
from parts.cam import base_radius, inner_radius
from parts.groove_cam import GrooveCamSpec, GrooveDisk, checked_groove

_SIGN = (
    "a radius of curvature is positive where the wall's material is convex, negative where it is hollow",
    "радіус кривини додатний там, де стінка опукла, від'ємний там, де вона вгнута",
)


class GrooveKeys(GrooveCamSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a groove cam, and the step of its table."""

    step: Step = 10.0
    intervals: Intervals = DEFAULT_INTERVALS
    drawing: Drawing = "smooth"
    speed_rpm: Speed | None = None


def sheet(kind: str, table: dict[str, Any]) -> Sheet:
    """The calculation of a groove cam."""
    keys: GrooveKeys = checked(table, GrooveKeys, TOPIC)
    try:
        disk = checked_groove(keys)
    except ParameterError as error:
        raise refusal(TOPIC, error) from error
    cam = disk.cam
    page, phases = Sheet(TOPIC, ("Groove cam", "Пазовий кулачок")), phases_of(disk.cam)
    characteristics(page, keys, cam)
    coefficient_steps(page, phases)
    _sizes(page, keys, disk)
    page.data["phases"] = phases.data()
    page.tables.append(positions(cam, keys.step, whose=("inner wall", "внутрішня стінка")))
    beyond = cam.radius + disk.clearance
    outer = ("outer wall", "зовнішня стінка")
    page.tables.append(positions(cam, keys.step, "positions_outer", outer, beyond=beyond))
    # the drawing's least radius is that of the rise alone
    finish(page, keys, cam, None)
    page.notes.append(_SIGN)
    return page


def _sizes(page: Sheet, keys: GrooveKeys, disk: GrooveDisk) -> None:
    cam = disk.cam
    page.section("Sizes", "Розміри")
    asked = keys.least_transmission_angle_deg
    if isinstance(cam.mount, Translating) and asked is not None:
        limit = math.radians(90 - asked)
        least = roller_prime_radius(cam.motion, keys.follower_offset, limit, limit)
        page.add("least_radius_both_ways", least, "", LESSON_5)
    page.add("least_base_circle_radius", base_radius(cam))
    reached(page, cam)
    page.add("least_curvature_radius", least_convex_radius(cam).value)
    page.add("least_hollow_radius", least_hollow_radius(cam).value)
    page.section("Groove", "Паз")
    page.add("clearance", disk.clearance)
    page.add("groove_width", 2 * cam.radius + disk.clearance, "2 * {r} + {c_r}")
    page.add("least_path_radius", inner_radius(cam) + cam.radius)
    farthest = disk.outermost - cam.radius - disk.clearance
    page.add("greatest_path_radius", farthest)
    page.add("outer_wall_radius", disk.outermost, "{R_2} + {r} + {c_r}")
    page.add("groove_depth", disk.depth)
    page.add("outer_diameter", 2 * disk.outer_radius)

"""``higherpair calc cam`` of a conjugate pair, both disks, and of a cam of constant breadth with its yoke."""

from __future__ import annotations

import math
from typing import Any

from geometry.base.errors import ParameterError
from geometry.cams.contact.positive import between_rollers
from geometry.cams.plane.positive import breadth_error
from geometry.cams.plane.synthesis import greatest_pressure_angle, least_convex_radius
from parts.base.refusal import SceneError
from parts.base.texts import N_
from parts.cams.disk_cam.page import CamKeys, disk_page
from parts.cams.disk_cam.part import CAM
from parts.cams.positive.conjugate import CONJUGATE_CAM, ConjugateCamSpec, SecondCam
from parts.cams.positive.yoke import YOKE_FRAME, YokeFrame, YokeFrameSpec
from parts.cams.wheel import inner_radius
from parts.pages.cam_steps import TOPIC, cam_angles, positions
from parts.pages.inputs import PLACE, checked, refusal
from parts.pages.page import Sheet, table_of

# keys of the page, not of either part
_PAGE = ("step", "intervals", "drawing", "speed_rpm", "cutter_diameter")


class ConjugateKeys(ConjugateCamSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a second disk."""


class YokeKeys(YokeFrameSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a yoke."""


def conjugate_sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of conjugate cams."""
    return _sheet(table, conjugate=True)


def yoke_sheet(table: dict[str, Any]) -> Sheet:
    """The calculation of a cam in its yoke."""
    return _sheet(table, conjugate=False)


def _sheet(table: dict[str, Any], *, conjugate: bool) -> Sheet:
    """A cam and what is made of it: ``of`` holds the cam's keys."""
    own = dict(table)
    of = own.pop("of", None)
    if not isinstance(of, dict):
        raise SceneError(PLACE, f"{TOPIC}.of", of, "first_cam_under_it")
    first: CamKeys = checked(of | {k: own.pop(k) for k in _PAGE if k in own}, CamKeys, f"{TOPIC}.of")
    keys = checked(own | {"of": "first"}, ConjugateKeys if conjugate else YokeKeys, TOPIC)
    try:
        cam = CAM.thing(first, {})
    except ParameterError as error:
        raise refusal(TOPIC, error, "of") from error
    try:
        others = {"first": first}
        found = CONJUGATE_CAM.thing(keys, others) if conjugate else YOKE_FRAME.thing(keys, others)
    except ParameterError as error:
        # of another name than the cam's own
        raise refusal(TOPIC, error) from error
    try:
        page = disk_page(first, cam)
        if isinstance(found, SecondCam):
            _second(page, found, first)
    except ParameterError as error:
        raise refusal(TOPIC, error, keys=first) from error
    if isinstance(found, SecondCam):
        page.title = N_("Conjugate cams")
    else:
        page.title = N_("Cam of constant breadth")
        _yoke(page, found, first.step)
    return page


def _second(page: Sheet, second: SecondCam, keys: CamKeys) -> None:
    cam = second.cam
    page.section("Second disk")
    between = between_rollers(second.first, second.pair)
    if cam.swings:
        page.told(inner_roller_angle_deg=360.0 - math.degrees(between), roller_angle_deg=math.degrees(between))
        page.add("second_arm_length", cam.swing.arm_length)
    else:
        page.add("roller_distance", between)
    page.told(second_follower_radius=cam.radius, second_least_radius=inner_radius(cam))
    page.add("second_pressure_angle_deg", math.degrees(greatest_pressure_angle(cam).value))
    page.add("second_curvature_radius", least_convex_radius(cam).value)
    whose = N_("second disk, as it sits on the shaft")
    second_table = positions(
        cam,
        keys.step,
        "positions_second",
        whose,
        turn=second.pair.turn,
        speed_rpm=keys.speed_rpm,
        cutter_diameter=keys.cutter_diameter,
    )
    page.tables.insert(1, second_table)
    page.note("S of the second disk is that of its own roller: it sinks where the first one rises")


def _yoke(page: Sheet, frame: YokeFrame, step: float) -> None:
    cam = frame.cam
    low = cam.motion.extremes()[0]
    page.section("Yoke")
    # the height of the face or of the roller's centre stands among the sizes already
    page.add("breadth", frame.breadth - frame.play, "2 * {s_0} + {H}" if low == 0 else "")
    page.told(breadth_error=breadth_error(cam.motion), yoke_play=frame.play)
    page.add("yoke_opening", frame.breadth, "{B} + {c_y}")
    page.add("yoke_middle", frame.middle, "{s_0} - {B} / 2")
    if cam.is_flat:
        page.add("window_width", 2 * frame.half_width)
    degrees, angle = cam_angles(cam.motion, step)
    upper = cam.contact(angle)
    # the lower face or roller touches the cam as the upper one does half a turn later, seen from the other side
    lower = -cam.contact(angle + math.pi)
    reached = cam.reference_point(angle).imag + cam.reference_point(angle + math.pi).imag
    columns = [degrees, cam.motion.value(angle), upper.real, upper.imag, lower.real, lower.imag, reached]
    heads = [("phi", "deg"), ("S", "mm"), ("x_1", "mm"), ("y_1", "mm"), ("x_2", "mm"), ("y_2", "mm"), ("B", "mm")]
    title = N_("Contacts in the frame: upper (1) and lower (2), and the breadth between faces or rollers")
    page.tables.insert(1, table_of("yoke", title, heads, zip(*columns, strict=True)))

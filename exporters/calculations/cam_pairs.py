"""``higherpair calc cam`` of a conjugate pair, both disks, and of a cam of constant breadth with its yoke."""

from __future__ import annotations

import math
from typing import Any

from exporters.calculations.cam import CamKeys, disk_page
from exporters.calculations.cam_steps import TOPIC, cam_angles, cam_swings, positions, table_of
from exporters.calculations.inputs import PLACE, checked, refusal
from exporters.calculations.sheet import Sheet
from geometry.cams.positive import breadth_error
from geometry.cams.positive_contact import between_rollers
from geometry.cams.synthesis import greatest_pressure_angle, least_convex_radius
from geometry.errors import ParameterError
from parts.cam import checked_cam, inner_radius
from parts.conjugate_cam import ConjugateCamSpec, SecondCam, checked_conjugate
from parts.schema import SceneError
from parts.yoke_frame import YokeFrame, YokeFrameSpec, checked_yoke

# keys of the page, not of either part
_PAGE = ("step", "intervals", "drawing", "speed_rpm")


class ConjugateKeys(ConjugateCamSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a second disk."""


class YokeKeys(YokeFrameSpec, kw_only=True, tag=False, forbid_unknown_fields=True):
    """Keys of a yoke."""


def sheet(kind: str, table: dict[str, Any]) -> Sheet:
    """The calculation of a cam and of what is made of it: ``of`` holds the cam's keys."""
    own = dict(table)
    of = own.pop("of", None)
    if not isinstance(of, dict):
        remedy = "give the first cam's keys under it, as of.follower=roller of.lift=20, or name a scene with the part"
        raise SceneError(PLACE, f"{TOPIC}.of", of, remedy)
    first: CamKeys = checked(of | {k: own.pop(k) for k in _PAGE if k in own}, CamKeys, f"{TOPIC}.of")
    conjugate = kind == "conjugate_cam"
    keys = checked(own | {"of": "first"}, ConjugateKeys if conjugate else YokeKeys, TOPIC)
    try:
        cam = checked_cam(first)
    except ParameterError as error:
        raise refusal(TOPIC, error, "of") from error
    try:
        found = (checked_conjugate if conjugate else checked_yoke)(keys, {"first": first})
    except ParameterError as error:
        # of another name than the cam's own
        raise refusal(TOPIC, error) from error
    page = disk_page(first, cam)
    if isinstance(found, SecondCam):
        page.title = ("Conjugate cams", "Спряжені кулачки")
        _second(page, found, first.step)
    else:
        page.title = ("Cam of constant breadth", "Кулачок сталої ширини")
        _yoke(page, found, first.step)
    return page


def _second(page: Sheet, second: SecondCam, step: float) -> None:
    cam = second.cam
    page.section("Second disk", "Другий диск")
    between = between_rollers(second.first, second.pair)
    if cam_swings(cam):
        page.add("roller_angle_deg", math.degrees(between))
    else:
        page.add("roller_distance", between)
    page.add("second_follower_radius", cam.radius)
    page.add("second_least_radius", inner_radius(cam))
    page.add("second_pressure_angle_deg", math.degrees(greatest_pressure_angle(cam).value))
    page.add("second_curvature_radius", least_convex_radius(cam).value)
    whose = ("second disk, as it sits on the shaft", "другий диск у своєму положенні на валу")
    page.tables.insert(1, positions(cam, step, "positions_second", whose, turn=second.pair.turn))
    page.notes.append(("S of the second disk is that of its own roller: it sinks where the first one rises",
                       "S другого диска стосується його ролика: він іде вниз, коли перший угору"))  # fmt: skip


def _yoke(page: Sheet, frame: YokeFrame, step: float) -> None:
    cam = frame.cam
    low = cam.motion.extremes()[0]
    page.section("Yoke", "Рамка")
    # the height of the face or of the roller's centre stands among the sizes already
    page.add("breadth", frame.breadth - frame.play, "2 * {s_0} + {H}" if low == 0 else "")
    page.add("breadth_error", breadth_error(cam.motion))
    page.add("yoke_play", frame.play)
    page.add("yoke_opening", frame.breadth, "{B} + {c_y}")
    page.add("yoke_middle", frame.middle, "{s_0} - {B} / 2")
    if cam.is_flat:
        page.add("window_width", 2 * frame.half_width)
    degrees, angle = cam_angles(cam.motion, step)
    upper = cam.contact(angle)
    # the lower face or roller touches the cam as the upper one does half a turn later, seen from the other side
    lower = -cam.contact(angle + math.pi)
    columns = [degrees, cam.motion.value(angle), upper.real, upper.imag, lower.real, lower.imag]
    heads = [("phi", "deg"), ("S", "mm"), ("x_1", "mm"), ("y_1", "mm"), ("x_2", "mm"), ("y_2", "mm"), ("B", "mm")]
    reached = cam.reference_point(angle).imag + cam.reference_point(angle + math.pi).imag
    title = ("Contacts in the frame: upper (1) and lower (2), and the breadth between faces or rollers",
             "Точки дотику в нерухомій системі: верхня (1) і нижня (2), ширина між гранями або роликами")  # fmt: skip
    page.tables.insert(1, table_of("yoke", title, [*columns, reached], heads))

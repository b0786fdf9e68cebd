"""The linkage on a cam's sheet: turned about the cam with its follower, drawn whole at four of the positions."""

from __future__ import annotations

import cmath
import math

import numpy as np

from geometry.cams.plane.coupler import LinkageCam
from geometry.curves.line_arc import Arc
from geometry.kinematics.linkage import RockerDrive, RockerGuide, SliderDrive, SliderGuide
from parts.base.texts import words
from parts.cams.sheets.diagrams import Drawn
from parts.cams.sheets.picture import CamPicture
from parts.cams.sheets.tables import Grid
from parts.drawing.canvas import SMALL_TEXT, Canvas, Paper
from parts.drawing.labels import Labeller
from parts.pages.page import unit_text
from parts.texts.sheets import sheet_words

_TURN = 2 * math.pi
# linkages drawn whole, about evenly over the turn
_WHOLE = 4
# radius of a joint, half of a slider's length and width, half of its guide's line, mm of paper
_JOINT, _BLOCK, _GUIDE = 0.9, complex(4.0, 2.0), 14.0
_COLUMNS = (9.0, 14.0, 15.0, 15.0, 15.0, 14.0, 14.0, 15.0, 15.0)


def linkage_cam_of(picture: CamPicture) -> LinkageCam | None:
    """The cam of a picture whose follower sits on a linkage; None of any other."""
    return picture.cam if isinstance(picture.cam, LinkageCam) else None


def frame_ray(cam: LinkageCam, least: float) -> complex:
    """End of the frame's ray that numbers the positions: towards the driven member's pivot or start, fixed frame.

    It reaches the pivot, and at least ``least`` mm.
    """
    mark = _driven_mark(cam)
    return mark / abs(mark) * max(abs(mark), least) if mark else complex(0.0, least)


def _driven_mark(cam: LinkageCam) -> complex:
    """The driven rocker's pivot, or joint A of the driven slider at S = 0."""
    drive = cam.mount.linkage.drive
    if isinstance(drive, RockerDrive):
        return drive.pivot
    assert isinstance(drive, SliderDrive)
    return drive.start


def pivots(cam: LinkageCam) -> list[complex]:
    """Pivots of the rockers, fixed frame."""
    linkage = cam.mount.linkage
    return [x.pivot for x in (linkage.drive, linkage.guide) if isinstance(x, RockerDrive | RockerGuide)]


def joints_at(cam: LinkageCam, angle: float) -> tuple[complex, complex, complex]:
    """Joints A and B and the reference point at a cam angle, fixed frame."""
    joint, turn = (complex(x[0]) for x in cam.mount.linkage.pose([cam.motion.value(np.float64(angle))]))
    return joint, joint + cam.mount.linkage.coupler_length * turn, joint + cam.mount.point * turn


def links_reach(picture: CamPicture, cam: LinkageCam, scale: float) -> float:
    """The farthest point of the linkages from the axis, mm."""
    far = [abs(p) for p in pivots(cam)]
    for position in picture.positions:
        far += [abs(p) for p in joints_at(cam, position.angle)[:2]]
    beyond = _JOINT if len(pivots(cam)) == 2 else _GUIDE
    return max(far) + beyond / scale


def whole_numbers(picture: CamPicture) -> set[int]:
    """The positions whose linkage is drawn whole."""
    angles = np.array([p.angle for p in picture.positions])
    return {int(np.abs(angles - k * _TURN / _WHOLE).argmin()) for k in range(_WHOLE)}


def draw_links(canvas: Canvas, drawn: Drawn, picture: CamPicture, cam: LinkageCam, paper: Paper, least: float) -> None:
    """Of every position the driven member and the rod to the follower; four linkages whole; rays from ``least`` mm."""
    shown, ray, mark = whole_numbers(picture), frame_ray(cam, least), _driven_mark(cam)
    for position in picture.positions:
        back = cmath.exp(-1j * position.angle)
        joint, far, place = joints_at(cam, position.angle)
        whole = position.number in shown

        def line(layer: str, start: complex, end: complex, back: complex = back) -> None:
            drawn.line(canvas, layer, paper.point(start * back), paper.point(end * back))

        line("CONSTRUCTION", 0j, ray)
        layer = "FOLLOWER" if whole else "CONSTRUCTION"
        if isinstance(cam.mount.linkage.drive, RockerDrive):
            line(layer, mark, joint)
        ends = [(joint, place), (joint, far), (far, place)] if whole else [(joint, place)]
        for start, end in ends:
            # the follower may sit on a joint
            if abs(end - start) * paper.scale > _JOINT / 2:
                line(layer, start, end)
        if whole:
            _members(canvas, drawn, cam, paper, back, (joint, far))


def _members(
    canvas: Canvas, drawn: Drawn, cam: LinkageCam, paper: Paper, back: complex, joints: tuple[complex, complex]
) -> None:
    """The guiding rocker, sliders on their lines, joints and pivots of one whole linkage."""
    linkage = cam.mount.linkage
    guide = linkage.guide
    if isinstance(guide, RockerGuide):
        drawn.line(canvas, "FOLLOWER", paper.point(joints[1] * back), paper.point(guide.pivot * back))
    for member, at in zip((linkage.drive, guide), joints, strict=True):
        if not isinstance(member, SliderDrive | SliderGuide):
            continue
        way = cmath.exp(1j * member.direction) * back
        middle = paper.point(at * back)
        drawn.line(canvas, "FOLLOWER", middle - _GUIDE * way, middle + _GUIDE * way)
        half = [complex(x * _BLOCK.real, y * _BLOCK.imag) for x, y in ((1, 1), (-1, 1), (-1, -1), (1, -1))]
        corners = [middle + way * x for x in half]
        for start, end in zip(corners, [*corners[1:], corners[0]], strict=True):
            drawn.line(canvas, "FOLLOWER", start, end)
    for point in (*joints, *pivots(cam)):
        canvas.add("FOLLOWER", Arc(paper.point(point * back), _JOINT, 0.0, _TURN))


def name_links(labels: Labeller, picture: CamPicture, cam: LinkageCam, paper: Paper) -> None:
    """Names of the joints, pivots and lengths of the linkage at position 0."""
    linkage, say = cam.mount.linkage, picture.say
    joint, far, place = joints_at(cam, picture.positions[0].angle)
    labels.name("A", paper.point(joint), prefer=_outward(joint))
    labels.name("B", paper.point(far), prefer=_outward(far))
    labels.name("O_{2}", paper.point(place), prefer=_outward(place))
    labels.name(f"b = {say(linkage.coupler_length)}", paper.point((joint + far) / 2), SMALL_TEXT, answer=False)
    for member, name, symbol, at in ((linkage.drive, "O_{1}", "l_{1}", joint), (linkage.guide, "C", "c", far)):
        if isinstance(member, RockerDrive | RockerGuide):
            labels.name(name, paper.point(member.pivot), prefer=_outward(member.pivot))
            middle = paper.point((member.pivot + at) / 2)
            labels.name(f"{symbol} = {say(member.length)}", middle, SMALL_TEXT, answer=False)


def position_grid(picture: CamPicture, cam: LinkageCam) -> Grid:
    """The numbered positions: cam angle, rod's angle, O_2, angles, profile."""
    language, angle = picture.language, np.array([p.angle for p in picture.positions])
    turn = cam.mount.linkage.pose([cam.motion.value(angle)])[1][0]
    theta, place, profile = np.degrees(np.unwrap(np.angle(turn))), cam.place(angle), cam.profile_point(angle)
    centre, contact = (np.degrees(f(angle)) for f in (cam.pressure_angle, cam.contact_pressure_angle))
    heads = ("№", "φ", "θ", "x_{02}", "y_{02}", "ν_{0}", "ν", "ξ_{1}", "η_{1}")
    mm = unit_text("mm", words(language))
    units = ("", "°", "°", mm, mm, "°", "°", mm, mm)
    rows: list[tuple[str, ...]] = [(sheet_words(language, "cam_positions"),), heads, units]
    for k, position in enumerate(picture.positions):
        values = (math.degrees(position.angle), theta[k], place[k].real, place[k].imag, centre[k], contact[k],
                  profile[k].real, profile[k].imag)  # fmt: skip
        rows.append((str(position.number), *(picture.say(float(x)) for x in values)))
    return Grid(_COLUMNS, tuple(rows), answers=(0, 0, 0, *[7] * len(picture.positions)), heads=3)


def _outward(point: complex) -> complex:
    """Direction away from the axis, to the right from the axis itself."""
    return point / abs(point) if point else 1.0 + 0j

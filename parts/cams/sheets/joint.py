"""The joint diagram: S over S' (roller, point, mushroom) or over S'' (flat), its tangents and the cam's centre."""

from __future__ import annotations

import cmath
import math

import numpy as np

from geometry.base.record import Record, replace
from geometry.cams.motion.diagrams import joint_diagram
from geometry.cams.motion.follower_motion import PhaseKind
from geometry.cams.motion.guides import Translating
from geometry.cams.plane.synthesis import AxisRegion, axis_region, flat_base_radius
from geometry.curves.line_arc import Arc
from parts.cams.sheets.diagrams import Drawn
from parts.cams.sheets.picture import CamPicture
from parts.cams.sheets.rocker import numbered
from parts.drawing.canvas import SCALES, SMALL_TEXT, TEXT_HEIGHT, Box, Canvas, Paper, text_width
from parts.drawing.choice import Asked
from parts.drawing.labels import Labeller

# strokes of the hatching along a border, mm
HATCH, HATCH_STEP = 4.0, 2.5
_MARK = 0.7
# around squared paper, for the axes' ends and names, mm
NAMES = 5.0


class Joint(Record):
    """The joint diagram in model mm: abscissa S^(order); S_0 is 0, the axis of the cam stands below it.

    ``borders``: lines y = slope x - a as (a, slope) below which the axis may stand; ``least``: O'_1, the nearest
    axis on the line of the offset; ``centre``: the cam's own axis; ``return_line`` for form closure.
    """

    picture: CamPicture
    order: int
    offset: float
    borders: tuple[tuple[float, float], ...]
    least: complex
    centre: complex
    return_line: tuple[float, float] | None

    def window(self) -> Box:
        """What must be seen, model mm."""
        low, high = self.picture.cam.motion.extremes(self.order)
        depth = min(self.least.imag, self.centre.imag)
        least, most = self.picture.cam.motion.extremes(0)
        tall, wide = most - depth, max(high - low, 0.3 * (most - depth))
        return Box(
            min(low, self.offset, 0.0) - 0.12 * wide,
            min(depth, least) - 0.1 * tall,
            max(high, self.offset, 0.0) + 0.12 * wide,
            max(most, 0.0) + 0.08 * tall,
        )

    def draw(self, canvas: Canvas, paper: Paper, window: Box, asked: Asked) -> Drawn:
        """The diagram with its axes, positions, tangents, admissible region and centres; names come with ``name``.

        By hand: squared paper with the axes, to draw it on.
        """
        drawn, to = Drawn(), paper.point
        if asked.by_hand:
            room = Box.of([to(corner) for corner in window.corners]).grown(-NAMES)
            canvas.squares_about(paper.origin, room, free=self._named_by_hand(canvas.letters))
        canvas.line("AXIS", to(1j * window.low), to(1j * window.high))
        canvas.line("AXIS", to(complex(window.left, 0)), to(complex(window.right, 0)))
        for tip, way in ((to(1j * window.high), 1j), (to(complex(window.right, 0)), 1.0)):
            canvas.arrow("AXIS", tip, way)
        if asked.by_hand:
            return drawn
        for piece in self.picture.cam.motion.pieces:
            curve = joint_diagram(piece, self.order, paper.origin, paper.scale)
            if curve is not None:
                drawn.add(canvas, "JOINT_DIAGRAM", curve, asked.tolerance)
        for point in _points(self):
            canvas.add("JOINT_DIAGRAM", Arc(to(point), _MARK, 0.0, 2 * math.pi))
        for a, slope in self.borders:
            start, end = _clipped(-1j * a, 1 + 1j * slope, window)
            drawn.line(canvas, "GAMMA_TANGENT", to(start), to(end))
        _hatch(canvas, self, paper, window)
        if self.return_line is not None:
            a, slope = self.return_line
            ends = _clipped(-1j * a, 1 + 1j * slope, window)
            if ends[0] != ends[1]:
                drawn.line(canvas, "RETURN_TANGENT", to(ends[0]), to(ends[1]))
        if self.offset:
            low, high = (to(complex(self.offset, y)) for y in (window.low, window.high))
            drawn.line(canvas, "OFFSET_AXIS", low, high)
        for point in dict.fromkeys((0j, self.least, self.centre)):
            canvas.add("DIMENSION", Arc(to(point), 0.9, 0.0, 2 * math.pi))
        drawn.line(canvas, "DIMENSION", to(0j), to(self.least))
        _angle(canvas, self, paper)
        return drawn

    def _named_by_hand(self, letters: float) -> complex:
        """Width and height of what stands below the right end of the axis: its name and the angles asked for, mm."""
        names = [self.picture.axis_name(self.order), *asked_angles(self.picture)]
        return complex(max(text_width(name, letters) for name in names), len(names) * (letters + 0.7 * NAMES))

    def name(self, labels: Labeller, paper: Paper, window: Box, *, by_hand: bool) -> None:
        """Names of axes, positions, centres and sizes; by hand of the axes alone."""
        to, say = paper.point, self.picture.say
        labels.name(self.picture.axis_name(0), to(1j * window.high), prefer=1 - 1j)
        labels.name(self.picture.axis_name(self.order), to(complex(window.right, 0)), prefer=-1 + 1j)
        if by_hand:
            free = self._named_by_hand(labels.letters)
            middle = to(complex(window.right, 0)) - complex(NAMES + free.real / 2, free.imag / 2)
            name_asked(labels, self.picture, middle)
            return
        labels.name("S_{0}", to(0j), SMALL_TEXT, prefer=-1 - 1j)
        if self.offset:
            text = f"E = {say(self.offset)}"
            labels.name(text, to(complex(self.offset, window.high)), SMALL_TEXT, prefer=1 - 1j, answer=False)
        is_least = abs(self.centre - self.least) < 1e-9 * abs(self.least)
        radius = abs(self.least)
        name = "O'_{1}" if self.offset and self.order == 1 else "O_{1}"
        labels.name(name, to(self.least), prefer=1 - 1j)
        if not is_least:
            labels.name("O", to(self.centre), prefer=1 - 1j)
            if self.order == 2:
                labels.name(
                    f"{self.picture.base_name} = {say(abs(self.centre))}",
                    to((self.centre + self.least) / 2),
                    prefer=1 + 0j,
                )
        labels.name(f"r_{{0}} = {say(radius)}", to(self.least / 2), prefer=1 + 0j)
        if self.picture.gamma is not None:
            symbol = "γ_{min}" if self.picture.asked or self.order == 2 else "γ"
            centre, arc = _angle_arc(self, paper, self.picture.gamma)
            text = f"{symbol} = {angle_text(self.picture, self.picture.gamma)}"
            labels.name(text, centre + arc, prefer=arc, answer=False if self.picture.asked else None)
            a, slope = self.borders[-1]
            name_return(labels, self.picture, paper.point(complex(a / slope, 0.0)))
        angles = np.array([p.angle for p in self.picture.positions])
        points = self.picture.cam.motion.value(angles, self.order) + 1j * self.picture.cam.motion.value(angles)
        for text, point in numbered(self.picture, [to(point) for point in points.tolist()]):
            labels.name(text, point, SMALL_TEXT, prefer=complex(point.real - paper.origin.real, 0.1))


def joint_of(picture: CamPicture) -> Joint | None:
    """The joint diagram of a translating follower; None of an oscillating one or one that never rises."""
    cam = picture.cam
    mount = cam.mount
    if not isinstance(mount, Translating) or not cam.motion.moving_pieces(PhaseKind.RISE):
        return None
    if cam.is_flat:
        radius = flat_base_radius(cam.motion).value
        least, centre = complex(0, -radius), complex(0, -mount.start_height)
        return Joint(picture, 2, mount.offset, ((radius, -1.0),), least, centre, None)
    if picture.gamma is None:
        return None
    limit = math.pi / 2 - picture.gamma
    least_back = None if picture.gamma_back is None else math.pi / 2 - picture.gamma_back
    region: AxisRegion = axis_region(cam.motion, limit, least_back)
    least = complex(mount.offset, -region.least_height(mount.offset))
    back = None
    if least_back is None and cam.motion.moving_pieces(PhaseKind.RETURN):
        back = axis_region(cam.motion, limit, limit).lines[-1]
    return Joint(picture, 1, mount.offset, region.lines, least, complex(mount.offset, -mount.start_height), back)


def joint_paper(window: Box, area: Box) -> tuple[Paper, Box]:
    """The largest standard scale, and the window widened to the area, model mm."""
    room = min(area.wide / window.wide, area.tall / window.tall)
    scale = next((s for s in SCALES if s <= room), room)
    middle = window.middle
    spread = min(area.wide / scale / 2, 0.75 * window.wide)
    seen = replace(window, left=middle.real - spread, right=middle.real + spread)
    return Paper(scale, area.middle - scale * middle), seen


def _points(joint: Joint) -> list[complex]:
    """Numbered points: (S^(order), S), on both sides of a jump where there is one."""
    motion = joint.picture.cam.motion
    angles = np.array([p.angle for p in joint.picture.positions])
    before = np.nextafter(np.where(angles == 0, 2 * math.pi, angles), 0)
    points = []
    for at in (angles, before):
        points += (motion.value(at, joint.order) + 1j * motion.value(at)).tolist()
    return points


def asked_angles(picture: CamPicture) -> list[str]:
    """The transmission angles that the scene asks for, that of the return where it is one of its own."""
    if not picture.asked or picture.gamma is None:
        return []
    told = [f"γ_{{min}} = {angle_text(picture, picture.gamma)}"]
    if picture.gamma_back is not None and picture.gamma_back != picture.gamma:
        told.append(f"γ'_{{min}} = {angle_text(picture, picture.gamma_back)}")
    return told


def name_asked(labels: Labeller, picture: CamPicture, point: complex) -> None:
    """Those angles, for students to draw their lines."""
    for told in asked_angles(picture):
        labels.name(told, point, prefer=-1j, answer=False)


def name_return(labels: Labeller, picture: CamPicture, point: complex) -> None:
    """The transmission angle of the return, where it has one of its own."""
    back = picture.gamma_back
    if back is not None and back != picture.gamma:
        labels.name(f"γ'_{{min}} = {angle_text(picture, back)}", point, prefer=-1 - 1j, answer=False)


def angle_text(picture: CamPicture, angle: float) -> str:
    """A transmission angle, rad, as the sheet tells it."""
    return f"{picture.say(math.degrees(angle)).rstrip('0').rstrip(',.')}°"


def _clipped(point: complex, way: complex, box: Box) -> tuple[complex, complex]:
    """The part of a line within a box; both ends the point itself where there is none."""
    low, high = box.span(point, way)
    return (point + low * way, point + high * way) if low < high else (point, point)


def _hatch(canvas: Canvas, joint: Joint, paper: Paper, window: Box) -> None:
    """Short strokes along the borders of the admissible region, on its side."""
    for a, slope in joint.borders:
        start, end = _clipped(-1j * a, 1 + 1j * slope, window)
        length = abs(end - start) * paper.scale
        if not length:
            continue
        way = (end - start) / abs(end - start)
        # the region lies below: on the right of a line that runs to the right
        inward = way * cmath.exp(-1j * math.radians(60))
        for k in range(1, int(length / HATCH_STEP)):
            foot = start + way * (k * HATCH_STEP / paper.scale)
            tip = foot + inward * (HATCH / paper.scale)
            inside = all(p.imag <= s * p.real - b + 1e-9 for b, s in joint.borders for p in (foot, tip))
            if inside and tip.imag >= window.low:
                canvas.line("HATCH", paper.point(foot), paper.point(tip))


def _angle(canvas: Canvas, joint: Joint, paper: Paper) -> None:
    gamma = joint.picture.gamma
    if gamma is None:
        return
    centre, arc = _angle_arc(joint, paper, gamma)
    start = 0.0 if joint.order == 1 else math.pi - gamma
    canvas.add("DIMENSION", Arc(centre, abs(arc), start, gamma))


def _angle_arc(joint: Joint, paper: Paper, gamma: float) -> tuple[complex, complex]:
    """Where the first tangent meets the axis of abscissae, on paper, and the middle of its arc from there."""
    a, slope = joint.borders[0]
    middle = gamma / 2 if joint.order == 1 else math.pi - gamma / 2
    return paper.point(complex(a / slope, 0.0)), cmath.rect(3 * TEXT_HEIGHT, middle)

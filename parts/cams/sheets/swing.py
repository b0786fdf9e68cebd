"""The joint diagram of an oscillating follower: L (1 +- psi') along a roller's arm, the faces of a flat one; and where
the cam's axis may stand."""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

import numpy as np

from geometry.base.errors import GeometryError
from geometry.base.record import Record
from geometry.cams.motion.diagrams import ArmCurve
from geometry.cams.motion.follower_motion import PhaseKind
from geometry.cams.motion.guides import Oscillating
from geometry.cams.plane.synthesis import oscillating_axis
from geometry.curves.line_arc import Arc
from parts.cams.sheets.diagrams import Drawn
from parts.cams.sheets.joint import HATCH, HATCH_STEP, NAMES, angle_text, name_asked, name_return
from parts.cams.sheets.picture import CamPicture
from parts.cams.sheets.rocker import draw_faces, faces_box, from_pivot, name_numbers, name_rocker, rocker_region
from parts.drawing.canvas import SMALL_TEXT, Box, Canvas, Paper
from parts.drawing.choice import Asked
from parts.drawing.labels import Labeller

# half-planes of the region's border on each piece that moves
_PLANES = 181


class Swing(Record):
    """Model mm, the cam's axis at 0 and the pivot on +x; ``least``: the axis of the smallest cam, with its r_0.

    ``planes``: (point, normal) of half-planes in which the axis may stand, of rises and returns that have a limit (of a
    flat follower, whose cam must be convex, all of the turn); ``lowest`` roller centre, or foot of ``least`` on the
    lowest face.
    """

    picture: CamPicture
    pivot: complex
    lowest: complex
    least: complex
    least_radius: float
    planes: tuple[tuple[complex, complex], ...]

    def window(self) -> Box:
        """What must be seen, model mm."""
        points = [0j, self.pivot, self.lowest, self.least]
        if self.picture.cam.is_flat:
            points += faces_box(self.picture).corners
        else:
            points += [foot for foot, _ in self.planes]
        for curve in _curves(self.picture, Paper(1.0, 0j)):
            points += curve.point(np.linspace(*curve.domain, 33)).tolist()
        box = Box.of(points)
        return box.grown(0.12 * max(box.wide, box.tall))

    def draw(self, canvas: Canvas, paper: Paper, window: Box, asked: Asked) -> Drawn:
        """Arms, the diagram, the region's border with its hatching, both axes; by hand these on squared paper."""
        drawn, to, mount = Drawn(), paper.point, self.picture.cam.swing
        if asked.by_hand:
            canvas.squares_about(to(0j), Box.of([to(corner) for corner in window.corners]).grown(-NAMES))
            drawn.line(canvas, "AXIS", to(0j), to(self.pivot))
            for point in (0j, self.pivot):
                canvas.add("DIMENSION", Arc(to(point), 0.9, 0.0, 2 * math.pi))
            return drawn
        for curve in _curves(self.picture, paper):
            drawn.add(canvas, "JOINT_DIAGRAM", curve, asked.tolerance)
        drawn.line(canvas, "AXIS", to(0j), to(self.pivot))
        if self.picture.cam.is_flat:
            draw_faces(canvas, drawn, self.picture, paper)
        else:
            start, sweep = cmath.phase(self.lowest - self.pivot), -mount.sense * self.picture.cam.motion.extremes()[1]
            if sweep:
                canvas.add("CENTRE", Arc(to(self.pivot), paper.scale * mount.arm_length, start, sweep))
            for foot, end in _arms(self.picture):
                drawn.line(canvas, "CONSTRUCTION", to(self.pivot), to(end))
                drawn.line(canvas, "ORDINATE", to(end), to(foot))
                canvas.add("JOINT_DIAGRAM", Arc(to(foot), 0.7, 0.0, 2 * math.pi))
        border = _border(self, window)
        for a, b in border:
            drawn.line(canvas, "GAMMA_TANGENT", to(a), to(b))
        _hatch(canvas, border, paper, window)
        drawn.line(canvas, "DIMENSION", to(self.lowest), to(self.least))
        for point in (0j, self.pivot, self.lowest, self.least):
            canvas.add("DIMENSION", Arc(to(point), 0.9, 0.0, 2 * math.pi))
        return drawn

    def name(self, labels: Labeller, paper: Paper, window: Box, *, by_hand: bool) -> None:
        """Names of axes, pivot, radius, numbers of positions; by hand of the axes alone."""
        to, say = paper.point, self.picture.say
        labels.name("O", to(0j), prefer=-1 - 1j)
        labels.name("C", to(self.pivot), prefer=1 - 1j)
        if by_hand:
            name_asked(labels, self.picture, to(self.pivot))
            return
        if not self.picture.cam.is_flat:
            labels.name("B_{0}", to(self.lowest), SMALL_TEXT, prefer=1 - 1j)
        labels.name("O_{1}", to(self.least), prefer=-1 - 1j)
        # the smallest cam of a roller's arm stands at a distance of its own
        radius = f"{'r_{0}' if self.picture.cam.is_flat else 'r_{0d}'} = {say(self.least_radius)}"
        labels.name(radius, to((self.lowest + self.least) / 2), SMALL_TEXT, prefer=-1 + 0j)
        if self.picture.cam.is_flat:
            name_rocker(labels, self.picture, paper, self.least)
            return
        if self.picture.gamma is not None:
            symbol = "γ_{min}" if self.picture.asked else "γ"
            text = f"{symbol} = {angle_text(self.picture, self.picture.gamma)}"
            point = self.least + 0.25 * (self.lowest - self.least)
            labels.name(text, to(point), prefer=1 + 0j, answer=False if self.picture.asked else None)
            name_return(labels, self.picture, to(self.least + 0.5 * (self.lowest - self.least)))
        name_numbers(labels, self.picture, [to(foot) for foot, _ in _arms(self.picture)], to(self.pivot))


def swing_of(picture: CamPicture) -> Swing | None:
    """The diagram of an oscillating follower; None where no axis keeps gamma, or makes a flat one's cam convex."""
    cam, mount = picture.cam, picture.cam.mount
    if not isinstance(mount, Oscillating):
        return None
    if cam.is_flat:
        found = rocker_region(picture)
        if found is None:
            return None
        least, foot, base, region = found
        return Swing(picture, complex(mount.centre_distance), foot, least, base, region)
    if picture.gamma is None:
        return None
    rise = math.pi / 2 - picture.gamma
    back = None if picture.gamma_back is None else math.pi / 2 - picture.gamma_back
    try:
        best = oscillating_axis(cam.motion, mount.arm_length, mount.sense, rise, back)
    except GeometryError:
        return None
    pivot, lowest = complex(mount.centre_distance, 0.0), complex(cam.reference_point(0.0))
    placed = from_pivot(pivot, (lowest - pivot) / abs(lowest - pivot), mount.sense)
    planes = []
    kinds = ((PhaseKind.RISE, rise), (PhaseKind.RETURN, back))
    limits = [(set(cam.motion.moving(kind).tolist()), limit) for kind, limit in kinds if limit is not None]
    for k, piece in enumerate(cam.motion.pieces):
        for limit in dict.fromkeys(limit for members, limit in limits if k in members):
            t = np.linspace(piece.start, piece.end, _PLANES)
            for s, rate in zip(piece.value(t).tolist(), piece.value(t, 1).tolist(), strict=True):
                along = cmath.exp(-1j * s)
                foot = placed(mount.arm_length * (1 + mount.sense * rate) * along)
                for side in (1.0, -1.0):
                    normal = math.tan(limit) * 1j * along + side * along
                    planes.append((foot, (placed(normal) - pivot) / abs(normal)))
    least = placed(cmath.rect(best.centre_distance, best.start_angle))
    return Swing(picture, pivot, lowest, least, best.prime_radius, tuple(planes))


def _curves(picture: CamPicture, paper: Paper) -> list[ArmCurve]:
    """The exact diagram of every moving piece, on paper."""
    mount = picture.cam.swing
    if picture.cam.is_flat:
        return []
    direction = math.pi - mount.sense * mount.start_angle
    origin = paper.point(complex(mount.centre_distance, 0.0))
    return [
        ArmCurve(p, p.start, p.end, origin, paper.scale, mount.arm_length, mount.sense, direction)
        for p in picture.cam.motion.moving_pieces()
    ]


def _arms(picture: CamPicture) -> list[tuple[complex, complex]]:
    """Of each position the diagram's point and the roller's centre, model mm."""
    cam, mount = picture.cam, picture.cam.swing
    found = []
    for position in picture.positions:
        end = complex(cam.reference_point(position.angle))
        reach = 1 + mount.sense * float(cam.motion.value(position.angle, 1))
        found.append((mount.centre_distance + (end - mount.centre_distance) * reach, end))
    return found


def _border(swing: Swing, window: Box) -> list[tuple[complex, complex]]:
    """Edges of the admissible region within the window, the region on their left."""
    polygon = [*window.corners]
    for foot, normal in swing.planes:
        slack = [((p - foot) * normal.conjugate()).real for p in polygon]
        kept: list[complex] = []
        for k, (p, inside) in enumerate(zip(polygon, slack, strict=True)):
            q, other = polygon[(k + 1) % len(polygon)], slack[(k + 1) % len(polygon)]
            if inside >= 0:
                kept.append(p)
            if (inside < 0) != (other < 0):
                kept.append(p + (q - p) * inside / (inside - other))
        polygon = kept
        if not polygon:
            return []
    edges = []
    for a, b in pairwise([*polygon, polygon[0]]):
        middle = (a + b) / 2
        inner = min(middle.real - window.left, window.right - middle.real, middle.imag - window.low,
                    window.high - middle.imag)  # fmt: skip
        if abs(b - a) > 1e-9 * window.wide and inner > 1e-9:
            edges.append((a, b))
    return edges


def _hatch(canvas: Canvas, border: list[tuple[complex, complex]], paper: Paper, window: Box) -> None:
    """Short strokes at even steps along the border, into the region."""
    gone = 0.0
    for a, b in border:
        way, length = (b - a) / abs(b - a), abs(b - a) * paper.scale
        while gone < length:
            foot = a + way * gone / paper.scale
            tip = foot + way * cmath.exp(1j * math.radians(60)) * HATCH / paper.scale
            if window.left < tip.real < window.right and window.low < tip.imag < window.high:
                canvas.line("HATCH", paper.point(foot), paper.point(tip))
            gone += HATCH_STEP
        gone -= length

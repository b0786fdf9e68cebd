"""The joint diagram of a flat rocker: the faces of all positions, and where the axis of a convex cam may stand."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Sequence

import numpy as np

from geometry.base.errors import GeometryError
from geometry.cams.plane.rocker import rocker_base, rocker_planes
from geometry.curves.line_arc import Arc
from parts.cams.sheets.diagrams import Drawn
from parts.cams.sheets.picture import CamPicture
from parts.drawing.canvas import SMALL_TEXT, Box, Canvas, Paper
from parts.drawing.labels import Labeller

# half-planes of the region's border on each piece of the motion
_PLANES = 91
# places that lie nearer than this on paper are one, mm
_ONE = 0.7


def from_pivot(pivot: complex, arm: complex, sense: int) -> Callable[[complex], complex]:
    """From the pivot's frame, whose x axis is the lowest ``arm`` and whose axis of the cam stands above."""
    return lambda point: pivot + arm * (point if sense > 0 else point.conjugate())


def rocker_region(
    picture: CamPicture,
) -> tuple[complex, complex, float, tuple[tuple[complex, complex], ...]] | None:
    """The axis of the smallest convex cam at this distance of the pivot, its foot on the lowest face, its base circle,
    and the half-planes (point, normal), model mm; None where none is convex."""
    cam, mount = picture.cam, picture.cam.swing
    radius = picture.least_curvature_radius
    try:
        best = rocker_base(cam.motion, mount.centre_distance, mount.sense, mount.face_offset, radius)
    except GeometryError:
        return None
    pivot = complex(mount.centre_distance)
    placed = from_pivot(pivot, cmath.exp(1j * (math.pi - mount.sense * mount.start_angle)), mount.sense)
    planes = []
    for piece in cam.motion.pieces:
        # where it rests one position tells of all
        t = np.linspace(*piece.domain, 1 if piece.is_constant else _PLANES)
        for normal, level in zip(*rocker_planes(piece, t, mount.sense, radius + mount.face_offset), strict=True):
            foot = placed(complex(normal * level))
            planes.append((foot, (placed(complex(normal)) - pivot)))
    axis = cmath.rect(best.centre_distance, best.start_angle)
    foot = complex(axis.real, mount.face_offset)
    return placed(axis), placed(foot), best.prime_radius, tuple(planes)


def faces(picture: CamPicture) -> list[tuple[complex, complex]]:
    """Of each position the face's point nearest to the pivot, and where it touches the cam, model mm."""
    cam, mount = picture.cam, picture.cam.swing
    found = []
    for position in picture.positions:
        normal = complex(cam.normal(position.angle))
        found.append((mount.centre_distance - mount.face_offset * normal, complex(cam.contact(position.angle))))
    return found


def draw_faces(canvas: Canvas, drawn: Drawn, picture: CamPicture, paper: Paper) -> None:
    """The faces from beside the pivot to the contact, which is marked."""
    for beside, contact in faces(picture):
        drawn.line(canvas, "CONSTRUCTION", paper.point(beside), paper.point(contact))
        canvas.add("JOINT_DIAGRAM", Arc(paper.point(contact), 0.7, 0.0, 2 * math.pi))


def name_rocker(labels: Labeller, picture: CamPicture, paper: Paper, least: complex) -> None:
    """The radius of curvature that is kept, and the numbers of the positions."""
    to, say = paper.point, picture.say
    kept = say(picture.least_curvature_radius).rstrip("0").rstrip(",.") or "0"
    labels.name(f"ρ_{{min}} = {kept}", to(least), SMALL_TEXT, prefer=1 + 0j, answer=False)
    name_numbers(labels, picture, [to(contact) for _, contact in faces(picture)], to(least))


def name_numbers(labels: Labeller, picture: CamPicture, places: Sequence[complex], centre: complex) -> None:
    """The numbers of the positions at their places on paper, away from a centre; those of one place together."""
    for text, place in numbered(picture, places):
        labels.name(text, place, SMALL_TEXT, prefer=place - centre)


def numbered(picture: CamPicture, places: Sequence[complex]) -> list[tuple[str, complex]]:
    """The numbers of the positions at their places on paper, those of one place together."""
    found: list[tuple[list[int], complex]] = []
    for position, place in zip(picture.positions, places, strict=True):
        near = next((numbers for numbers, other in found if abs(other - place) < _ONE), None)
        if near is None:
            found.append(([position.number], place))
        else:
            near.append(position.number)
    return [(", ".join(map(str, numbers)), place) for numbers, place in found]


def faces_box(picture: CamPicture) -> Box:
    """What of the faces must be seen, model mm."""
    return Box.of(p for pair in faces(picture) for p in pair)

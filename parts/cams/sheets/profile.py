"""The profile by inversion: the cam at rest, the follower turned about it against the cam's turning."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator

import numpy as np

from geometry.base.record import Record, replace
from geometry.cams.motion.guides import Oscillating, Translating
from geometry.cams.plane.disk import FollowerKind
from geometry.cams.plane.shape import cam_shape, whole_profile
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Arc
from parts.cams.sheets.diagrams import Drawn
from parts.cams.sheets.links import draw_links, frame_ray, linkage_cam_of, links_reach, name_links, pivots
from parts.cams.sheets.picture import CamPicture, thinned
from parts.drawing.canvas import SCALES, SMALL_TEXT, Box, Canvas, Paper, draw, exact_each, fitted_each, text_width
from parts.drawing.choice import Asked
from parts.drawing.expected import Circle
from parts.drawing.labels import Labeller

# lines of motion run beyond the farthest centre by this, and numbers stand this far from their ends, mm of paper
_BEYOND, _NUMBER = 4.0, 3.0
# a flat face is drawn as far beyond its contact, and at least as long to each side, mm of paper
_FACE_BEYOND, _FACE_LEAST = 6.0, 12.0
# a mushroom's face to each side of its contact, rad
_FACE_HALF = math.radians(25)
_TURN = 2 * math.pi


class Reach(Record):
    """Radii of the construction, mm: base circle, that of S = 0, of the highest follower, where the lines of motion
    end, and of all that is drawn.
    """

    base: float
    prime: float
    far: float
    rays: float
    whole: float


def reach_of(picture: CamPicture, scale: float) -> Reach:
    """What the construction needs at a scale, model mm; ``whole`` without the numbers."""
    cam = picture.cam
    base = cam.base_radius
    angles = np.concatenate([cam.motion.stack.extremes(0)[1], np.linspace(0, _TURN, 181)])
    far = float(np.abs(cam.reference_point(angles)).max())
    rays = far + (cam.radius if cam.kind is FollowerKind.ROLLER else 0.0) + _BEYOND / scale
    whole, mount = rays, cam.mount
    if isinstance(mount, Oscillating):
        whole = max(far + cam.radius, mount.centre_distance)
    elif cam.is_flat:
        for position in picture.positions:
            height = abs(complex(cam.reference_point(position.angle)))
            whole = max(whole, *(math.hypot(height, end) for end in _face_ends(picture, position.angle, scale)))
    if (linked := linkage_cam_of(picture)) is not None:
        whole = max(whole, links_reach(picture, linked, scale))
    return Reach(base, base + cam.radius, far, rays, whole)


def _face_ends(picture: CamPicture, angle: float, scale: float) -> tuple[float, float]:
    """Ends of a flat face from the foot of the axis, mm along it: beyond the contact, and a least length."""
    cam = picture.cam
    contact = complex(cam.contact(angle))
    normal = complex(cam.normal(angle))
    places = [contact]
    if (linked := linkage_cam_of(picture)) is not None:
        # the point of the face that the rod carries
        places.append(complex(linked.place(angle)))
    along = [(place * (1j * normal).conjugate()).real for place in places]
    beyond, least = _FACE_BEYOND / scale, _FACE_LEAST / scale
    return min(min(along) - beyond, -least), max(max(along) + beyond, least)


def profile_paper(picture: CamPicture, area: Box) -> Paper:
    """The largest standard scale at which the construction and its numbers fit."""
    room = min(area.wide, area.tall) / 2 - _number_room(picture)
    far = reach_of(picture, 1.0).far
    start = next((k for k, s in enumerate(SCALES) if s * far <= room), len(SCALES) - 1)
    scale = next((s for s in SCALES[start:] if reach_of(picture, s).whole * s <= room), SCALES[-1])
    return Paper(scale, complex(area.left + area.right, area.low + area.high) / 2)


def profile_side(picture: CamPicture, most: float) -> float:
    """Width and height of the construction at the scale that fits into a square of ``most`` mm."""
    scale = profile_paper(picture, Box(0.0, 0.0, most, most)).scale
    return min(most, 2 * (reach_of(picture, scale).whole * scale + _number_room(picture)) + 0.1)


def _number_room(picture: CamPicture) -> float:
    return _NUMBER + text_width(str(len(picture.positions)), SMALL_TEXT) / 2 + 1.5


def draw_profile(
    canvas: Canvas, picture: CamPicture, paper: Paper, asked: Asked, *, base_given: bool
) -> tuple[Drawn, list[Circle], dict[str, list[Curve]]]:
    """The construction; lines that are checked, circles on paper, exact curves of each layer in model mm.

    By hand: the centre and the circles that are given.
    """
    cam, reach = picture.cam, reach_of(picture, paper.scale)
    drawn, circles = Drawn(), []

    def circle(layer: str, centre: complex, radius: float) -> None:
        made = Arc(paper.point(centre), paper.scale * radius, 0.0, _TURN)
        canvas.add(layer, made)
        circles.append(Circle(layer, made.centre, made.radius))

    for way in (1, 1j):
        canvas.line("CENTRE", paper.point(-1.08 * reach.base * way), paper.point(1.08 * reach.base * way))
    for layer, radius in _circles_about(picture, reach, by_hand=asked.by_hand, base_given=base_given):
        circle(layer, 0j, radius)
    if asked.by_hand:
        _turning(canvas, paper, reach)
        return drawn, circles, {}
    if (linked := linkage_cam_of(picture)) is not None:
        draw_links(canvas, drawn, picture, linked, paper, reach.rays)
    _marks(canvas, picture, paper)
    for position in picture.positions:
        _follower(canvas, drawn, picture, paper, reach, position.angle)
        centre = _turned(position.angle, complex(cam.reference_point(position.angle)))
        if cam.kind is FollowerKind.MUSHROOM:
            # the part of the face about the contact
            down = cmath.phase(-_turned(position.angle, complex(cam.normal(position.angle))))
            face = Arc(paper.point(centre), paper.scale * cam.radius, down - _FACE_HALF, 2 * _FACE_HALF)
            canvas.add("ROLLER", face)
            circles.append(Circle("ROLLER", face.centre, face.radius))
        elif cam.radius:
            circle("ROLLER", centre, cam.radius)
        elif not cam.is_flat:
            canvas.add("ROLLER", Arc(paper.point(centre), 0.6, 0.0, _TURN))
    curves: dict[str, list[Curve]] = {"CAM": [s.curve for s in whole_profile(cam).period]}
    if cam.radius:
        pitch = replace(cam, kind=FollowerKind.POINTED, radius=0.0)
        curves["PITCH_CURVE"] = [s.curve for s in cam_shape(pitch).profile.period]
    for layer, exact in curves.items():
        each = fitted_each(canvas, exact, paper.scale, asked.tolerance)
        draw(canvas, layer, [one for made in each for one in made], paper)
        curves[layer] = [part for parts in exact_each(exact, each) for part in parts]
    _turning(canvas, paper, reach)
    return drawn, circles, curves


def _circles_about(
    picture: CamPicture, reach: Reach, *, by_hand: bool, base_given: bool
) -> Iterator[tuple[str, float]]:
    """The circles about the cam's axis, each with its layer and radius in model mm."""
    cam, mount = picture.cam, picture.cam.mount
    if base_given or not by_hand:
        yield "CIRCLE_BASE", reach.base
    if not by_hand:
        if cam.radius:
            yield "CIRCLE_PRIME", reach.prime
        yield "CIRCLE_FAR", reach.far
    if isinstance(mount, Translating) and mount.offset and not cam.is_flat:
        yield "CIRCLE_OFFSET", abs(mount.offset)
    if isinstance(mount, Oscillating):
        yield "CIRCLE_PIVOT", mount.centre_distance
    if (linked := linkage_cam_of(picture)) is not None:
        # none about a pivot that stands on the axis
        yield from (("CIRCLE_PIVOT", abs(pivot)) for pivot in pivots(linked) if pivot)


def _turned(angle: float, point: complex) -> complex:
    """A point of the fixed frame in the cam's."""
    return point * cmath.exp(-1j * angle)


def _follower(canvas: Canvas, drawn: Drawn, picture: CamPicture, paper: Paper, reach: Reach, angle: float) -> None:
    """The follower of one position: its line of motion, and its flat face; or pivot and arm."""
    cam, mount = picture.cam, picture.cam.mount

    def line(layer: str, start: complex, end: complex) -> None:
        drawn.line(canvas, layer, paper.point(_turned(angle, start)), paper.point(_turned(angle, end)))

    here = complex(cam.reference_point(angle))
    if isinstance(mount, Translating):
        beside = 0.0 if cam.is_flat else mount.offset
        top = math.sqrt(reach.rays**2 - beside**2)
        line("CONSTRUCTION", complex(beside, 0.0), complex(beside, top))
    elif isinstance(mount, Oscillating):
        line("CONSTRUCTION", 0j, complex(mount.centre_distance, 0.0))
        if not cam.is_flat:
            line("FOLLOWER", complex(mount.centre_distance, 0.0), here)
    if cam.is_flat:
        way = 1j * complex(cam.normal(angle))
        low, high = _face_ends(picture, angle, paper.scale)
        line("FOLLOWER", here + low * way, here + high * way)


def _marks(canvas: Canvas, picture: CamPicture, paper: Paper) -> None:
    """The stroke's division on the line of position 0, and the arcs that carry it to each position."""
    cam = picture.cam
    if not isinstance(cam.mount, Translating):
        return
    for position in picture.positions:
        start = complex(cam.reference_point(position.angle))
        if cam.is_flat:
            start = complex(0.0, start.imag)
        centre = paper.point(0j)
        radius, phase = paper.scale * abs(start), cmath.phase(start)
        canvas.line("ORDINATE", paper.point(start) - 1.0, paper.point(start) + 1.0)
        # the shorter way round
        sweep = -position.angle if position.angle <= math.pi else _TURN - position.angle
        if abs(sweep) > 1e-9:
            canvas.add("CONSTRUCTION", Arc(centre, radius, phase, sweep))


def _turning(canvas: Canvas, paper: Paper, reach: Reach) -> None:
    """An arrow that turns with the cam."""
    radius = 0.45 * paper.scale * reach.base
    arc = Arc(paper.point(0j), radius, math.radians(200), math.radians(60))
    canvas.add("DIMENSION", arc)
    canvas.arrow("DIMENSION", complex(arc.point(arc.sweep)), complex(arc.tangent(arc.sweep)), half=14.0)


def number_positions(canvas: Canvas, picture: CamPicture, paper: Paper) -> None:
    """Numbers at the outer ends of the lines of motion, or outside of the pivots."""
    cam, mount, reach = picture.cam, picture.cam.mount, reach_of(picture, paper.scale)
    if isinstance(mount, Translating):
        beside = 0.0 if cam.is_flat else mount.offset
        radius = reach.rays + _NUMBER / paper.scale
        start = complex(beside, math.sqrt(radius**2 - beside**2))
    elif (linked := linkage_cam_of(picture)) is not None:
        ray = frame_ray(linked, reach.rays)
        radius = abs(ray) + _NUMBER / paper.scale
        start = radius * ray / abs(ray)
    else:
        radius = cam.swing.centre_distance + _NUMBER / paper.scale
        start = complex(radius, 0.0)
    widest = text_width(str(len(picture.positions)), SMALL_TEXT) + 1.0
    angles = np.array([p.angle for p in picture.positions])
    kept = thinned(angles * radius * paper.scale, widest)
    # the last one must not meet the first
    for position, named in zip(picture.positions, kept, strict=True):
        if not named or (position.number and (_TURN - position.angle) * radius * paper.scale < widest):
            continue
        at = paper.point(start * cmath.exp(-1j * position.angle))
        text = str(position.number)
        canvas.write(text, at - complex(text_width(text, SMALL_TEXT), SMALL_TEXT) / 2, SMALL_TEXT)


def name_profile(labels: Labeller, picture: CamPicture, paper: Paper, *, by_hand: bool, base_given: bool) -> None:
    """Centre, sense of turning, radii, offset; by hand without the radii that are not given."""
    cam, say, reach = picture.cam, picture.say, reach_of(picture, paper.scale)
    labels.name("O", paper.point(0j), prefer=1 - 1j)
    turning = paper.point(0.45 * reach.base * cmath.exp(1j * math.radians(230)))
    labels.name("ω", turning, prefer=1 + 1j)
    name = picture.base_name if cam.is_flat or cam.radius else "r_{0}"
    spoke = cmath.exp(1j * math.radians(290))
    if base_given or not by_hand:
        text = f"{name} = {say(reach.base)}"
        labels.name(text, paper.point(reach.base * spoke), SMALL_TEXT, prefer=-spoke, answer=not base_given)
    if cam.radius and not by_hand:
        spoke = cmath.exp(1j * math.radians(310))
        labels.name(f"r_{{0}} = {say(reach.prime)}", paper.point(reach.prime * spoke), SMALL_TEXT, prefer=-spoke)
    mount = cam.mount
    if isinstance(mount, Translating):
        if mount.offset and not cam.is_flat:
            spoke = cmath.exp(1j * math.radians(330))
            text = f"E = {say(abs(mount.offset))}"
            labels.name(text, paper.point(abs(mount.offset) * spoke), SMALL_TEXT, prefer=spoke, answer=False)
    elif (linked := linkage_cam_of(picture)) is not None:
        if not by_hand:
            name_links(labels, picture, linked, paper)
    else:
        spoke = cmath.exp(1j * math.radians(20))
        distance = cam.swing.centre_distance
        point = paper.point(distance * spoke)
        labels.name(f"d = {say(distance)}", point, SMALL_TEXT, prefer=-spoke, answer=False)

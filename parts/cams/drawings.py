"""The working drawings of cams that are disks: their profile with the base circle, or a groove in a round disk."""

from __future__ import annotations

import math

from geometry.base.record import replace
from geometry.cams.contact.outlines import FollowerEnd
from geometry.cams.plane.disk import FollowerKind
from geometry.curves.curve import Curve
from geometry.curves.line_arc import Arc, Line
from geometry.plane.profile import Profile, Region
from geometry.solids.wheel import WheelShape
from parts.bodies import plate_drawing
from parts.cams.follower import Ended
from parts.cams.groove_cam.part import GrooveDisk
from parts.cams.groove_cam.piece import GroovePiece, GroovePieceSpec
from parts.cams.positive.yoke import Yoke, YokeFrame
from parts.cams.wedge_cam.part import WedgeCamSpec
from parts.cams.wheel import Turned
from parts.drawing.directions import directions
from parts.drawing.disk_views import disk_drawing
from parts.drawing.extent import reach
from parts.drawing.revolved import below, closed
from parts.drawing.wheel_views import Wheel, wheel_views
from parts.drawing.working import VISIBLE, Note, PartDrawing, Size, Stroke, Subject, requirements

_SAME = 1e-9


def part_drawing(subject: Subject) -> PartDrawing:
    """Section across the profile or the groove, face, bore."""
    part = subject.part
    if isinstance(part.made_by, Ended | Yoke):
        return plate_drawing.part_drawing(subject, _faces(part.thing, part.section(0.0).region))
    if isinstance(part.keys, WedgeCamSpec):
        return _wedge(subject)
    if isinstance(part.thing, GrooveDisk):
        return _groove(subject, part.thing)
    if isinstance(part.thing, GroovePiece):
        disk, shape = part.thing.disk, WheelShape(part.thing.thickness)
        if isinstance(part.keys, GroovePieceSpec) and part.keys.piece == "ring":
            return plate_drawing.part_drawing(subject)
        return disk_drawing(subject, shape, disk.holes, "zero_x")
    kind = part.made_by
    assert isinstance(kind, Turned)
    circles = [name for name in part.circles if name == "base_circle_diameter"]
    return disk_drawing(subject, kind.body(part.keys, part.thing), kind.holes(part.keys, part.thing), "zero_x", circles)


def _faces(thing: FollowerEnd | YokeFrame, region: Region) -> list[Curve]:
    """What of a follower, or of a frame, a cam runs on; nothing of one with a roller or a point."""
    outer = [segment.curve for segment in region.outer.segments()]
    if isinstance(thing, YokeFrame):
        window = [s.curve for hole in region.holes for s in hole.segments() if isinstance(s.curve, Line)]
        return [c for c in window if c.start.imag == c.end.imag] if thing.cam.is_flat else []
    if thing.kind is FollowerKind.MUSHROOM:
        return [c for c in outer if isinstance(c, Arc) and abs(c.radius - thing.radius) < _SAME]
    height = thing.sense * thing.face_offset
    flat = [c for c in outer if isinstance(c, Line) and abs(c.start.imag - height) + abs(c.end.imag - height) < _SAME]
    return [*flat] if thing.kind is FollowerKind.FLAT else []


def _wedge(subject: Subject) -> PartDrawing:
    """A plate with the origin of its table, on the lower edge, and how far that is from its end."""
    made = plate_drawing.part_drawing(subject)
    (view,) = made.views
    region = subject.part.section(0.0).region
    up = Line(0j, 1j * plate_drawing.extent(region)[1].imag)
    left = plate_drawing.edge([s.curve for s in region.outer.segments()], -1, -1j)
    # a hole over the origin has the same size
    told = any(one.side == "below" and abs(one.end.real) < _SAME for one in view.sizes)
    sizes = [] if told else [Size("origin", left, 0j, "below")]
    view = view.plus(axes=[up], sizes=sizes, notes=[Note(0j, "O", free=-1 - 1j)])
    return replace(made, views=(view,))


def _groove(subject: Subject, disk: GrooveDisk) -> PartDrawing:
    """A round disk with the walls of its groove; how wide that is stands in the table: the section cuts it aslant."""
    radius, top, floor = disk.outer_radius, disk.shape.face_width, disk.floor
    wheel = Wheel(disk.shape, disk.holes, (radius, radius), None, stands=False)
    walls: tuple[Profile, ...] = subject.part.section(0.0).region.marks
    section, face, *others = wheel_views(wheel, subject, walls)
    strokes, hatched = list[Stroke](), list[tuple[Line | Arc, ...]]()
    for way in (1, -1):
        low, high = sorted(reach(wall, way * math.pi / 2) for wall in walls)
        corners = [complex(top, low), complex(floor, low), complex(floor, high), complex(top, high)]
        cut = closed(corners) if way > 0 else below(closed(corners))
        hatched.append(cut)
        strokes += [
            (VISIBLE, line) for line in cut if isinstance(line, Line) and line.start.real + line.end.real < 2 * top
        ]
        if way > 0:
            depth = Size("groove_depth", complex(floor, high), complex(top, high), "above")
            rough = tuple(subject.worked(complex((floor + top) / 2, wall)) for wall in (low, high))
    section = section.plus(strokes, hatched, sizes=[depth], notes=rough)
    face = face.plus((VISIBLE, s.curve) for wall in walls for s in wall.segments())
    return PartDrawing((section, face, *others), requirements(subject, *directions(disk.holes, subject, "zero_x")))

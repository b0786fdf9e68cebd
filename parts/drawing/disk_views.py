"""The working drawing of a disk whose outline is no circle: the exact profile, circles of it, the axial section."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from geometry.base.record import replace
from geometry.curves.line_arc import Arc
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import WheelShape
from parts.drawing.directions import directions
from parts.drawing.extent import reach
from parts.drawing.wheel_views import PITCH, Groove, Wheel, ring_face, ring_section, wheel_views
from parts.drawing.working import PartDrawing, Round, Stroke, Subject, requirements

# where a circle about the axis has its size, the first that has room
_AROUND = (-60.0, -120.0, -30.0, 210.0)


def disk_drawing(
    subject: Subject, shape: WheelShape, holes: HubHoles, zero: str, circles: Sequence[str] = (), teeth: int = 0,
    grooves: tuple[Groove, ...] = (),
    bevel: tuple[float, float] | None = None,
    rim: float | None = None,
) -> PartDrawing:  # fmt: skip
    """Section, face as the files have it, bore.

    ``zero``: the key of the words for its direction +x; ``circles``: names of those of the part that are shown with
    sizes; ``teeth``: how many stand about it, any of which is as good as the first; ``grooves`` and ``bevel``: of its
    rim; ``rim``: how far it reaches where that is more than the outline, mm.
    """
    outline = subject.part.section(0.0).region.outer
    if all(isinstance(s.curve, Arc) and s.curve.centre == 0 for s in outline.period):
        # turned, it is the same
        radius = outline.reach()
        wheel = Wheel(shape, holes, (radius, radius), None, runs=True)
        return PartDrawing(wheel_views(wheel, subject), requirements(subject, *directions(holes, subject, "")))
    bare = Wheel(shape, holes, (0.0, 0.0), outline)
    rounds = tuple(
        Round(name.removesuffix("_diameter"), 0j, subject.part.circles[name] / 2, angles=_AROUND) for name in circles
    )
    radii, root = subject.part.circles, None
    tip, has_teeth = (reach(outline, math.pi / 2), reach(outline, -math.pi / 2)), PITCH in (one.name for one in rounds)
    if has_teeth:
        # teeth are not cut (GOST 2.402)
        tip, root = (radii[circles[0]] / 2,) * 2, radii["root_diameter"] / 2
    if rim is not None:
        tip = rim, rim
    wheel = replace(bare, tip=tip, root=root, rounds=rounds, stands=False, grooves=grooves, bevel=bevel)
    views = wheel_views(wheel, subject)
    if has_teeth:
        # the table tells the other circles (GOST 2.408)
        sized = [one for one in views[1].rounds if one not in rounds[1:]]
        views = views[0], replace(views[1], rounds=tuple(sized)), *views[2:]
    return PartDrawing(views, requirements(subject, *directions(holes, subject, zero, teeth)))


def ring_drawing(
    subject: Subject, radii: tuple[float, float, float], holes: HubHoles, circles: Mapping[str, float],
    strokes: Sequence[Stroke], zero: str, teeth: int,
) -> PartDrawing:  # fmt: skip
    """Section and face of a ring that works inside, where ``radii`` (see ``ring_section``) have it farthest out.

    ``circles``: radii with sizes, mm; ``strokes``: of the inside on its face; ``zero``, ``teeth``: as a disk has them.
    """
    shape = WheelShape(subject.part.face_width)
    section, face = ring_section(shape, radii, holes, subject), ring_face(radii[2], holes, subject)
    told = (Round(name, 0j, radius, angles=_AROUND) for name, radius in circles.items())
    section = section.plus(notes=[subject.worked(complex(subject.part.face_width / 2, -radii[1]), free=1j)])
    face = replace(face, rounds=(*told, *face.rounds)).plus(strokes)
    return PartDrawing((section, face), requirements(subject, *directions(holes, subject, zero, teeth)))

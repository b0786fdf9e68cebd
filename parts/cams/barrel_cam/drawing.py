"""The working drawing of a cylindrical cam: its axial section, its bore, the development of its outer cylinder."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from geometry.cams.barrel.body import BarrelBody
from geometry.cams.barrel.cam import LOWER, UPPER, BarrelCam
from geometry.curves.line_arc import Line
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles
from parts.cams.barrel_cam.part import BarrelCamSpec
from parts.drawing.directions import directions
from parts.drawing.extent import farthest
from parts.drawing.revolved import below, closed, outlined, seen_edges
from parts.drawing.wheel_views import bore_radii, bore_view, seen_along
from parts.drawing.working import VISIBLE, Note, PartDrawing, Size, Stroke, Subject, View, requirements
from parts.keys.holes import bore_of, hub_holes
from parts.texts.sheets import sheet_words

# pieces of a wall in the plane of the section; steps to the cam angle at which it passes there, rad that are none
_PIECES, _STEPS, _SETTLED = 24, 60, 1e-13


def part_drawing(subject: Subject) -> PartDrawing:
    """Section through +x, where cam angle 0 stands, and -x; bore; the outer cylinder unrolled."""
    keys, body = subject.part.keys, subject.part.thing
    assert isinstance(keys, BarrelCamSpec)
    holes = hub_holes(bore_of(keys), None, None)
    section = _section(body, holes, subject)
    more = directions(holes, subject, "zero_development")
    made = holes.bore
    views = [section, _development(subject)]
    if made is not None and not isinstance(made, RoundBore):
        views = [seen_along(section, _ends(body)[1], subject), bore_view(made, subject), views[1]]
    return PartDrawing(tuple(views), requirements(subject, *more))


def _ends(body: BarrelBody) -> tuple[float, float]:
    """Both ends of the bore, mm."""
    under, over = (0.0, 0.0) if body.hub is None else body.hub[1:]
    return -under, (body.length if body.cam.is_groove else body.web) + over


def _section(body: BarrelBody, holes: HubHoles, subject: Subject) -> View:
    """The axial section; edges of the walls behind it are left to the development."""
    strokes: list[Stroke] = []
    hatched, sizes = [], list[Size]()
    for way, polar, bore in zip((1, -1), (0.0, math.pi), bore_radii(holes.bore), strict=True):
        whole, cut = closed([*_outline(body, bore)]), closed([*_outline(body, bore, polar)])
        side = cut if way > 0 else below(cut)
        strokes += outlined(side)
        if body.cam.is_groove:
            strokes += [(VISIBLE, e if way > 0 else e.mirrored()) for e in seen_edges(whole, cut=True)]
        hatched.append(side)
    low, high = _ends(body)
    cam, wishes = body.cam, subject.wishes
    outer, inner, length = cam.outer, cam.inner, body.length

    def diameter(name: str, radius: float, z: float, side: str, fit: str = "") -> None:
        sizes.append(Size(name, complex(z, -radius), complex(z, radius), side, "Ø", fit))  # type: ignore[arg-type]

    diameter("outer_diameter", outer, 0.0, "left", wishes.tip)
    if not cam.is_groove:
        diameter("inner_diameter", inner, _wall(cam, LOWER, inner, math.pi), "right")
    if isinstance(holes.bore, RoundBore):
        diameter("bore_diameter", holes.bore.diameter / 2, high, "right", wishes.bore)
    if body.hub is not None:
        radius, under, over = body.hub
        diameter("hub.diameter", radius, high if over else low, "right" if over else "left")
        for name, start, end in (("hub.below", -under, 0.0), ("hub.above", high - over, high)):
            if end > start:
                sizes.append(Size(name, complex(start, -radius), complex(end, -radius), "below"))
    if cam.is_groove:
        sizes.append(Size("length", -1j * outer, complex(length, -outer), "below"))
        floor = complex(_wall(cam, LOWER, inner, 0.0), inner)
        sizes.append(Size("groove_depth", floor, complex(length, outer), "right"))
    else:
        sizes.append(Size("web", -1j * inner, complex(body.web, -inner), "below"))
        edge = complex(_wall(cam, LOWER, outer, math.pi), -outer)
        sizes.append(Size("start_height", -1j * outer, edge, "below"))
    middle = (outer + inner) / 2
    at = complex(_wall(cam, LOWER, middle, 0.0), middle)
    rough = Note(at, f"Ra {subject.say(wishes.flank_roughness)}", is_rough=True)
    axes = (Line(complex(min(low, 0.0)), complex(max(high, length))),)
    return View(tuple(strokes), tuple(hatched), axes, tuple(size for size in sizes if size.value), notes=(rough,))


def _outline(body: BarrelBody, bore: float, polar: float | None = None) -> Iterator[complex]:
    """Half of the section, z + ir; with the walls as they pass through the half plane at a polar angle."""
    cam, (low, high) = body.cam, _ends(body)
    outer, inner, web, length = cam.outer, cam.inner, body.web, body.length
    hub = bore if body.hub is None else body.hub[0]
    if cam.is_groove or web > 0:
        yield from (complex(low, bore), complex(low, hub), complex(0.0, hub))
    else:
        yield 1j * inner
    yield 1j * outer
    radii = np.linspace(outer, inner, _PIECES + 1).tolist()
    if polar is not None:
        yield from (complex(_wall(cam, LOWER, r, polar), r) for r in radii)
        if cam.is_groove:
            yield from (complex(_wall(cam, UPPER, r, polar), r) for r in reversed(radii))
    elif not cam.is_groove:
        yield from (complex(length, outer), complex(length, inner))
    if cam.is_groove:
        yield from (complex(length, outer), complex(length, hub), complex(high, hub), complex(high, bore))
    elif web > 0:
        yield from (complex(web, inner), complex(web, hub), complex(high, hub), complex(high, bore))


def _wall(cam: BarrelCam, side: int, radius: float, polar: float) -> float:
    """The height of a wall on a cylinder at a polar angle, mm: its polar angle falls as the cam angle grows."""
    angle = -polar % math.tau
    for _ in range(_STEPS):
        x, y, z = cam.wall(angle % math.tau, side, radius).tolist()
        off = math.remainder(math.atan2(y, x) - polar, math.tau)
        angle += off
        if abs(off) < _SETTLED:
            break
    return float(z)


def _development(subject: Subject) -> View:
    """The jackets of the outer cylinder."""
    region = subject.part.section(0.0).region
    outlines = (region.outer, *region.apart)
    curves = [s.curve for outline in outlines for s in outline.segments()]
    left, right, low, high = (farthest(curves, way) for way in (-1, 1, -1j, 1j))
    corner = complex(left.real, low.imag)
    sizes = (
        Size("circumference", corner, complex(right.real, low.imag), "below"),
        Size("development.height", corner, complex(left.real, high.imag), "left"),
    )
    strokes = [(VISIBLE, curve) for curve in curves]
    return View(tuple(strokes), (), (), sizes, title=sheet_words(subject.language, "development"))

"""The working drawing of a cylindrical cam: its axial section, its bore, the development of its outer cylinder."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.record import Record
from geometry.base.series import Series, exponential
from geometry.cams.barrel.body import BarrelBody
from geometry.cams.barrel.cam import LOWER, UPPER, BarrelCam
from geometry.curves.curve import Curve, Real, SeriesSpan, end_point, start_point
from geometry.curves.line_arc import Line
from geometry.laws.piece import LawPiece
from geometry.solids.bores import RoundBore
from geometry.solids.hub_holes import HubHoles
from parts.cams.barrel_cam.part import BarrelCamSpec
from parts.drawing.directions import directions
from parts.drawing.extent import farthest
from parts.drawing.revolved import Loop, below, closed, outlined, seen_edges
from parts.drawing.shown import shown_pieces
from parts.drawing.wheel_views import bore_cut, bore_note, spline_cut, with_bore
from parts.drawing.working import VISIBLE, Note, PartDrawing, Side, Size, Stroke, Subject, View, requirements
from parts.keys.holes import holes_of

# pieces of a wall in the plane of the section; steps to the cam angle at which it passes there, rad that are none
_PIECES, _STEPS, _SETTLED = 24, 60, 1e-13
# the section has +x upwards: by how much it is turned, rad
_TURNED = math.pi / 2
# mm that are none; sine of the angle to the section's plane within which an edge behind it is not drawn: 0.05 of a
# thousandth of its radius, where it would end in a point at which it stands still
_SAME, _EDGE_ON = 1e-6, 0.01


def part_drawing(subject: Subject) -> PartDrawing:
    """Section through +x, where cam angle 0 stands, and -x; bore; the outer cylinder unrolled."""
    keys, body = subject.part.keys, subject.part.thing
    assert isinstance(keys, BarrelCamSpec)
    holes = holes_of(keys)
    section = _section(body, holes, subject)
    more = directions(holes, subject, "zero_development")
    told = body.length if body.cam.is_groove else _wall(body.cam, LOWER, body.cam.outer, math.pi)
    views = with_bore((section,), holes.bore, body.bore_ends[1], subject, _TURNED)
    return PartDrawing((*views, _development(subject, told)), requirements(subject, *more))


def _section(body: BarrelBody, holes: HubHoles, subject: Subject) -> View:
    """The axial section; of a groove the edges behind it are left to the development."""
    strokes: list[Stroke] = []
    hatched, sizes = list[Loop](), list[Size]()
    low, high = body.bore_ends
    walls, bore_edges = bore_cut(holes.bore, low, high, _TURNED)
    spline = spline_cut(holes.bore, low, high)
    for way, polar, bore in zip((1, -1), (0.0, math.pi), walls, strict=True):
        whole, cut = closed([*_outline(body, bore)]), closed([*_outline(body, bore, polar)])
        side = cut if way > 0 else below(cut)
        strokes += outlined(side)
        # an end cam has no upper end that is plane
        edges = (e for e in seen_edges(whole, cut=True) if body.cam.is_groove or e.start.real < body.length - _SAME)
        strokes += [(VISIBLE, e if way > 0 else e.mirrored()) for e in edges]
        hatched.append(side)
    strokes += [(VISIBLE, edge) for edge in (*bore_edges, *spline.roots, *_track_edges(body))]
    hatched += spline.teeth
    cam, wishes = body.cam, subject.wishes
    outer, inner, length = cam.outer, cam.inner, body.length

    def diameter(name: str, radius: float, z: float, side: Side, fit: str = "") -> None:
        sizes.append(Size(name, complex(z, -radius), complex(z, radius), side, "Ø", fit))

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
    notes = [subject.worked(at), Note(-1j * outer, "z = 0", free=-1 - 1j)]
    if holes.bore is not None:
        notes.append(bore_note((low, high), -walls[1], subject.rough(wishes.bore_roughness)))
    axes = (Line(complex(min(low, 0.0)), complex(max(high, length))), *spline.axes)
    return View(
        tuple(strokes),
        tuple(map(tuple, hatched)),
        axes,
        tuple(size for size in sizes if size.value),
        notes=tuple(notes),
    )


def _outline(body: BarrelBody, bore: float, polar: float | None = None) -> Iterator[complex]:
    """Half of the section, z + ir; with the walls as they pass through the half plane at a polar angle."""
    cam, (low, high) = body.cam, body.bore_ends
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
    """The height of a wall on a cylinder at a polar angle, mm."""
    return float(_walls(cam, side, radius, polar))


def _walls(cam: BarrelCam, side: int, radius: ArrayLike, polar: ArrayLike) -> Real:
    """The same of many: the polar angle falls as the cam angle grows."""
    wanted = np.asarray(polar, dtype=float)
    angle = -wanted
    for _ in range(_STEPS):
        x, y, z = np.moveaxis(cam.wall(angle % math.tau, side, radius), -1, 0)
        off = np.angle(np.exp(1j * (np.arctan2(y, x) - wanted)))
        angle = angle + off
        if np.abs(off).max() < _SETTLED:
            break
    return np.asarray(z)


class _TrackEdge(SeriesSpan, Record):
    """An edge of an end cam's track on a cylinder, as it is seen across the axis, over the cam angle t: z + ix."""

    cam: BarrelCam
    piece: LawPiece
    radius: float
    start: float
    end: float

    def series(self, t: ArrayLike, order: int) -> Series:
        """Taylor coefficients at ``t``."""
        turns, heights = self.turns(t, order)
        return [z + 1j * self.radius * turn.real for z, turn in zip(heights, turns, strict=True)]

    def turns(self, t: ArrayLike, order: int) -> tuple[Series, Series]:
        """Of the direction from the axis, a complex number of modulus 1, and of the height."""
        polar, heights = self.cam.edge_series(self.piece, LOWER, self.radius, np.asarray(t, dtype=float), order)
        return exponential([1j * x for x in polar]), heights


def _track_edges(body: BarrelBody) -> Iterator[Curve]:
    """Both edges of an end cam's track behind the section, as far as neither tube nor hub stands before them."""
    cam, hub = body.cam, body.hub
    for radius in (cam.inner, cam.outer) if not cam.is_groove else ():
        for piece in cam.motion.pieces:
            edge = _TrackEdge(cam, piece, radius, piece.start, piece.end)

            def hidden(t: Real, edge: _TrackEdge = edge) -> np.ndarray:
                (turn, *_), (height, *_) = edge.turns(t, 0)
                across = edge.radius * turn.real
                # what is nearer stands at the inner cylinder, or in the plane of the section
                near = np.maximum(np.abs(across), cam.inner)
                over = _walls(cam, LOWER, near, -np.arccos(np.clip(across / near, -1.0, 1.0)))
                found = (turn.imag > -_EDGE_ON) | (height < over - _SAME)
                if hub is not None:
                    found |= (np.abs(across) < hub[0]) & (height < body.web + hub[2])
                return np.asarray(found)

            for seen in shown_pieces(edge, hidden):
                yield Line(start_point(seen), end_point(seen)) if piece.is_constant else seen


def _development(subject: Subject, told: float) -> View:
    """The jackets of the outer cylinder; ``told``: the height that the section tells."""
    region = subject.part.section(0.0).region
    outlines = (region.outer, *region.apart)
    jackets = [[s.curve for s in outline.segments()] for outline in outlines]
    curves = [curve for jacket in jackets for curve in jacket]
    low, high = (farthest(curves, way) for way in (-1j, 1j))
    # where the walls run through the start slanted, the jackets' ends stand aside of each other
    lowest = min(jackets, key=lambda jacket: farthest(jacket, -1j).imag)
    left, right = (farthest(lowest, way) for way in (-1, 1))
    corner = complex(left.real, low.imag)
    around = Size("circumference", corner, complex(right.real, low.imag), "below")
    height = Size("development.height", corner, complex(left.real, high.imag), "left")
    sizes = (around,) if abs(height.value - told) < _SAME else (around, height)
    strokes = [(VISIBLE, curve) for curve in curves]
    return View(tuple(strokes), (), (), sizes, title=subject.words("development"))

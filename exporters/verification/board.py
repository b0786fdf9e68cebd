"""Boards read back: every piece whole and in its place, on the board, clear of the others, cut in order.

The file alone is measured: its contours are found by their boxes, moved back and held against the exact outlines, the
copies of a part against its first one. Distances are those of GEOS between polygons of the file's own lines and arcs.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from functools import reduce
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from exporters.formats.readback import Loop, ReadOutlines
from exporters.formats.reading import READERS
from exporters.verification.outlines import stroke_failures, verify_loops
from exporters.verification.verdict import Verdict, of_readable
from geometry.base.record import Record, made_once
from geometry.curves.curve import Complex, Real
from geometry.plane.contour import edge_box, edge_points
from geometry.plane.profile import Profile, Region
from parts.base.part import Part
from parts.base.texts import N_, fault, fault_of, unless
from parts.keys.boards import BoardSpec
from parts.scene.formats import FileKind

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry


# quarter turns are exact
_QUARTERS = (1 + 0j, 1j, -1 + 0j, -1j)
# a contour is found where its box is so near to the exact one's, mm; copies of a part are alike to this, mm
_FOUND, _ALIKE = 0.5, 1e-9
# points of a curve by which its box is known
_BOX_POINTS = 65
# arcs are measured as chords so near to them, mm; gap and margin are kept to this, mm
_SAG, _KEPT = 2e-4, 1e-6


class BoardPiece(Record):
    """A copy of a part on a board: turned by so many degrees about its origin, which stands ``at``, mm."""

    id: str
    part: str
    turn_deg: float
    at: complex

    @property
    def told(self) -> dict[str, Any]:
        """As plain data."""
        return {"part": self.part, "at": [self.at.real, self.at.imag], "turn_deg": self.turn_deg}

    @property
    def turn(self) -> complex:
        """The factor that turns: pieces are laid by quarters."""
        return _QUARTERS[round(self.turn_deg / 90) % 4]

    def moved(self, points: Complex) -> Complex:
        """Points of the part where they stand on the board."""
        return np.asarray(points * self.turn + self.at)

    def moved_back(self, points: Complex) -> Complex:
        """Points of the board in the frame of the part."""
        return np.asarray((points - self.at) * self.turn.conjugate())


class ExpectedBoard(Record):
    """What a board's file must hold: parts by name, their boundaries moved ``offset`` mm out, and where they lie."""

    board: BoardSpec
    parts: dict[str, Part]
    pieces: tuple[BoardPiece, ...]
    offset: float

    def region(self, piece: BoardPiece) -> Region:
        """The section of a piece with its name, in the frame of its part."""
        return self.parts[piece.part].cut(self.offset, self.board.gap).region


@of_readable
def verify_board(file: Path, kind: FileKind, expected: ExpectedBoard, declared: float, tolerance: float) -> Verdict:
    """Read a board's file back and hold it against what it must be, within a declared error, mm."""
    found = READERS[kind.name](file)
    assert isinstance(found, ReadOutlines)
    board = expected.board
    # an SVG is read about its middle
    corner = 0j if kind.format == "dxf" else complex(board.width, board.height) / 2
    loops = [Loop(x.vertices + corner, x.bulges, x.layer.upper()) for x in found.loops]
    return _verdict(loops, [stroke + corner for stroke in found.strokes], expected, declared, tolerance)


def _verdict(
    loops: list[Loop], strokes: list[Complex], expected: ExpectedBoard, declared: float, tolerance: float
) -> Verdict:
    from shapely import symmetric_difference

    rows = [(piece, index) for piece in expected.pieces for index in _found(piece, expected)]
    owners = _owners(loops, rows)
    if isinstance(owners, str):
        return Verdict({"contours": float(len(loops))}, (owners,))
    polygons = [_polygon(x) for x in loops]
    measured: dict[str, float] = {"pieces": float(len(expected.pieces)), "contours": float(len(loops))}
    failures: list[str] = []
    inside = _inside(polygons)
    failures += _order_failures(loops, inside)
    first: dict[str, list[Loop]] = {}
    worst, shortest = 0.0, math.inf
    of_piece: dict[str, list[int]] = {piece.id: [] for piece in expected.pieces}
    for index, (owner, _) in enumerate(owners):
        of_piece[owner].append(index)
    material: list[BaseGeometry] = []
    for piece in expected.pieces:
        own = of_piece[piece.id]
        back = [Loop(piece.moved_back(loops[i].vertices), loops[i].bulges, "") for i in own]
        # what is engraved takes nothing away
        material.append(reduce(symmetric_difference, (polygons[i] for i in own if loops[i].layer != "ENGRAVE")))
        region = expected.region(piece)
        for i in own:
            layer = region.layers()[owners[i][1]]
            wanted = "CUT_INNER" if layer == "CUT_OUTER" and inside[i] else layer
            told = N_("{id}: a contour stands on {layer} instead of {wanted}")
            failures += unless(loops[i].layer == wanted, told, id=piece.id, layer=loops[i].layer, wanted=wanted)
        # in the order of the part's own profiles, so that copies compare
        back = [x for _, x in sorted(zip((owners[i][1] for i in own), back, strict=True), key=lambda row: row[0])]
        if piece.part not in first:
            first[piece.part] = back
            said = verify_loops(back, region.profiles(), region.layers(), declared, tolerance)
            worst = max(worst, said.measured.get("max_deviation", math.inf))
            shortest = min(shortest, said.measured.get("shortest_edge", math.inf))
            failures += [fault_of(piece.id, failure) for failure in said.failures]
        else:
            off, told = _unlike(back, first[piece.part]), N_("{id} is off the other {part} by {off:.3g} mm")
            failures += unless(off <= _ALIKE, told, id=piece.id, part=piece.part, off=off)
    measured |= {"max_deviation": worst, "shortest_edge": shortest}
    failures += _room_failures(expected, material, measured)
    names = [p.moved(np.array(stroke)) for p in expected.pieces for stroke in expected.region(p).strokes]
    failures += stroke_failures(strokes, names, declared)
    measured |= _ways(loops, strokes, expected)
    area = sum(m.area for m in material)
    measured["use_percent"] = 100 * area / (expected.board.width * expected.board.height)
    return Verdict(measured, tuple(failures))


def _found(piece: BoardPiece, expected: ExpectedBoard) -> list[tuple[int, Real]]:
    """The number of each profile of a piece, and the box that its contour must have."""
    return [(k, _box(piece.moved(_points(p)))) for k, p in enumerate(expected.region(piece).profiles())]


def _points(profile: Profile) -> Complex:
    """Points all along a profile, once for all copies of a part."""
    return made_once(profile, "all_along", lambda: _all_along(profile))


def _all_along(profile: Profile) -> Complex:
    period = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, _BOX_POINTS)) for s in profile.period])
    return np.asarray((np.exp(1j * profile.pitch_angle * np.arange(profile.count))[:, None] * period).ravel())


def _box(points: Complex) -> Real:
    return np.array([points.real.min(), points.imag.min(), points.real.max(), points.imag.max()])


def _owners(loops: Sequence[Loop], rows: Sequence[tuple[BoardPiece, tuple[int, Real]]]) -> list[tuple[str, int]] | str:
    """Which piece, and which profile of it, each loop is; or what is missing."""
    if len(loops) != len(rows):
        return f"{len(loops)} contours instead of {len(rows)}"
    if any(len(x.vertices) < 2 or not np.all(np.isfinite(x.vertices)) for x in loops):
        return "a contour holds no shape or a coordinate that is not a number"
    corners = [edge_box(x.vertices, np.roll(x.vertices, -1), x.bulges) for x in loops]
    boxes = np.array([[a.real, a.imag, b.real, b.imag] for a, b in corners])
    found: list[tuple[str, int]] = [("", 0)] * len(loops)
    free = np.ones(len(loops), dtype=bool)
    for piece, (number, box) in rows:
        off = np.where(free, np.abs(boxes - box).max(axis=1), np.inf)
        best = int(off.argmin())
        if not off[best] <= _FOUND:
            return f"a contour of {piece.id} is missing or not in its place"
        free[best], found[best] = False, (piece.id, number)
    return found


def _polygon(loop: Loop) -> BaseGeometry:
    """A loop by chords that stay within ``_SAG`` of its arcs."""
    import shapely

    starts, ends = loop.vertices, np.roll(loop.vertices, -1)
    bent = np.abs(loop.bulges)
    crown = np.abs(ends - starts) * bent / 2
    # a chord of 1/n of an arc has 1/n^2 of its crown, of one of more than half a turn less than four times as much
    counts = np.ceil(np.sqrt(4 * crown * np.maximum(1, bent) / _SAG)).astype(int)
    # two edges alone are a circle, however small
    counts = np.maximum(counts, 2 if len(starts) == 2 else 1)
    points = []
    for count in sorted(set(counts.tolist())):
        own = np.flatnonzero(counts == count)
        shares = np.linspace(0, 1, count, endpoint=False)
        places = edge_points(starts[own], ends[own], loop.bulges[own], shares)
        points += list(zip(own.tolist(), places, strict=True))
    whole = np.concatenate([p for _, p in sorted(points, key=lambda row: row[0])])
    return shapely.Polygon(np.stack([whole.real, whole.imag], axis=1))


def _inside(polygons: Sequence[BaseGeometry]) -> list[list[int]]:
    """In which others each contour lies: where its first point does, since each is held to its own place besides."""
    import shapely

    tree = shapely.STRtree(list(polygons))
    first = shapely.points([polygon.exterior.coords[0] for polygon in polygons])
    inner, outer = tree.query(first, predicate="within")
    found: list[list[int]] = [[] for _ in polygons]
    # none is found in itself: its first point lies on its bound
    for a, b in zip(inner.tolist(), outer.tolist(), strict=True):
        found[a].append(b)
    return found


def _order_failures(loops: Sequence[Loop], inside: Sequence[Sequence[int]]) -> Iterable[str]:
    """Nothing is cut after what it lies in, nor after the layer that follows its own."""
    layers = [("ENGRAVE", "CUT_INNER", "CUT_OUTER").index(x.layer) for x in loops]
    yield from unless(layers == sorted(layers), "a contour comes after the layer that follows its own")
    cut = [[k for k in others if loops[k].layer != "ENGRAVE"] for others in inside]
    if any(other < index for index, others in enumerate(cut) for other in others):
        yield fault("a contour is cut after the one that it lies in")


def _unlike(back: Sequence[Loop], first: Sequence[Loop]) -> float:
    """How far the contours of two copies are from each other, mm."""
    worst = 0.0
    for one, two in zip(back, first, strict=True):
        if len(one.vertices) != len(two.vertices):
            return math.inf
        if len(one.vertices) == 2 and np.all(np.abs(one.bulges) == 1) and np.all(np.abs(two.bulges) == 1):
            # circles, which may begin anywhere
            ends = one.vertices, two.vertices
            middle, radius = np.diff([x.mean() for x in ends]), np.diff([abs(x[0] - x[1]) / 2 for x in ends])
            worst = max(worst, float(abs(middle[0]) + abs(radius[0])))
            continue
        chords = np.abs(np.roll(two.vertices, -1) - two.vertices)
        bent = np.abs(one.bulges - two.bulges) * chords / 2
        worst = max(worst, float(np.abs(one.vertices - two.vertices).max()), float(bent.max()))
    return worst


def _room_failures(
    expected: ExpectedBoard, material: Sequence[BaseGeometry], measured: dict[str, float]
) -> Iterable[str]:
    """Everything lies on the board, and no two pieces come nearer than the gap."""
    import shapely

    board = expected.board
    bounds = shapely.bounds(np.array(material, dtype=object))
    edges = np.concatenate([bounds[:, :2], np.array([board.width, board.height]) - bounds[:, 2:]], axis=1)
    # arcs may stand out of their chords
    measured["least_margin"] = float(edges.min()) - _SAG
    margin, piece = measured["least_margin"], expected.pieces[int(edges.min(axis=1).argmin())]
    told = N_("{id} lies {found:.6g} mm from the edge of the board instead of {margin:g}")
    yield from unless(margin >= board.margin - _KEPT, told, id=piece.id, found=margin, margin=board.margin)
    tree, every = shapely.STRtree(list(material)), np.array(material, dtype=object)
    for a, b in zip(*tree.query(every, predicate="intersects").tolist(), strict=True):
        if a < b:
            yield fault("{id} and {other} overlap", id=expected.pieces[a].id, other=expected.pieces[b].id)
    near = zip(*tree.query(every, predicate="dwithin", distance=board.gap + 1.0).tolist(), strict=True)
    pairs = [(a, b) for a, b in near if a < b]
    if not pairs:
        return
    gaps = [distance_within(material[a], material[b], board.gap + 1.0) - 2 * _SAG for a, b in pairs]
    nearest = int(np.argmin(gaps))
    measured["least_gap"] = gap = gaps[nearest]
    a, b = (expected.pieces[k].id for k in pairs[nearest])
    told = N_("{a} and {b} lie {nearest:.6g} mm apart instead of {gap:g}")
    yield from unless(gap >= board.gap - _KEPT, told, a=a, b=b, nearest=gap, gap=board.gap)


def distance_within(one: BaseGeometry, two: BaseGeometry, reach: float) -> float:
    """The distance of two pieces within ``reach`` of each other, mm: of what each has near the other's box.

    A box that one only touches holds nothing of it, so that it is as much wider.
    """
    import shapely

    parts = []
    for own, other in ((one, two), (two, one)):
        low_x, low_y, high_x, high_y = other.bounds
        box = low_x - 2 * reach, low_y - 2 * reach, high_x + 2 * reach, high_y + 2 * reach
        parts.append(shapely.clip_by_rect(own.boundary, *box))
    return float(shapely.distance(*parts))


def _ways(loops: Sequence[Loop], strokes: Sequence[Complex], expected: ExpectedBoard) -> dict[str, float]:
    """Lengths of cuts, of engraved lines and of the way between them, mm, and how long all cuts take, s."""
    found = {"cut_length": 0.0, "engraved_length": 0.0, "way_between": 0.0}
    at = 0j
    for stroke in strokes:
        found["engraved_length"] += float(np.abs(np.diff(stroke)).sum())
        found["way_between"] += float(abs(stroke[0] - at))
        at = complex(stroke[-1])
    for loop in loops:
        chords, quarter = np.abs(np.roll(loop.vertices, -1) - loop.vertices), np.arctan(np.abs(loop.bulges))
        with np.errstate(invalid="ignore", divide="ignore"):
            arcs = np.where(quarter > 0, chords * 2 * quarter / np.sin(2 * quarter), chords)
        found["engraved_length" if loop.layer == "ENGRAVE" else "cut_length"] += float(arcs.sum())
        found["way_between"] += float(abs(loop.vertices[0] - at))
        at = complex(loop.vertices[0])
    if (feed := expected.board.feed) is not None:
        engraving = found["engraved_length"] / (expected.board.engraving_feed or feed)
        found["cut_seconds"] = found["cut_length"] / feed + engraving
    return found

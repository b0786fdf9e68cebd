"""The solids of a STEP file: every reference followed, shells closed, curves, surfaces and vertices where they meet.

ISO 10303-42: an edge runs along its curve or against it, a face's normal is its surface's or against it, and looks out
of the material; seen from its tip the bounds run round the face on their left; in a closed shell every edge is used
twice, once each way.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from functools import cached_property
from itertools import pairwise

import numpy as np

from exporters.formats.read_curves import Curves, Frames, Knots, Patches, lobatto
from exporters.formats.read_part21 import Entities, Index, Row
from exporters.formats.read_solid import EXTRUSION, GAP, PLANE, ROUND, SPHERE, SPLINE, TORUS, Model, Uses, refuse
from exporters.formats.read_surfaces import measure
from geometry.base.record import replace
from geometry.base.vectors import cross
from geometry.curves.curve import Flags, Real
from parts.base.readback import ReadError, refuse_if

# spans of arcs at most, rad, as polynomials off by 6e-12 of the radius, and degree of splines: integrals over them are
# exact up to 7, and of 8 to rounding
_ARC, _MOST_DEGREE = np.pi / 6, 8
# directions that differ by less give no frame, rad
_LEAST_TURN = 1e-6
_SOLIDS, _SHELLS, _FACES, _LOOPS = ("MANIFOLD_SOLID_BREP",), ("CLOSED_SHELL",), ("ADVANCED_FACE",), ("EDGE_LOOP",)
_BOUNDS, _USES, _EDGES = ("FACE_BOUND", "FACE_OUTER_BOUND"), ("ORIENTED_EDGE",), ("EDGE_CURVE",)
_VERTICES, _POINTS, _PLACES = ("VERTEX_POINT",), ("CARTESIAN_POINT",), ("AXIS2_PLACEMENT_3D",)
_DIRECTIONS, _VECTORS = ("DIRECTION",), ("VECTOR",)
_CURVES = _LINES, _ARCS, _SPLINES = "LINE", "CIRCLE", "B_SPLINE_CURVE_WITH_KNOTS"
_SURFACES = {
    "PLANE": PLANE, "CYLINDRICAL_SURFACE": ROUND, "CONICAL_SURFACE": ROUND, "SPHERICAL_SURFACE": SPHERE,
    "TOROIDAL_SURFACE": TORUS, "SURFACE_OF_LINEAR_EXTRUSION": EXTRUSION, "B_SPLINE_SURFACE_WITH_KNOTS": SPLINE,
}  # fmt: skip

_NONE = np.zeros(0, np.int64)


def read_model(read: Followed) -> Model:
    """The solids of a file.

    Raises
    ------
    ReadError
        A reference leads to nothing, a shell is not closed, or curves, surfaces and vertices do not meet.
    """
    ids = read.ids(*_EDGES)
    rows = read.rows(*_EDGES)
    ends = read.found(rows[:, :2].ravel(), _VERTICES, np.repeat(ids, 2)).reshape(-1, 2)
    uses, faces, face_rows, solid = _topology(read, ids, ends)
    surface = read.found(face_rows[:, 0], list(_SURFACES), faces)
    kind, frames, sizes, swept = _surfaces(read, surface)
    vertices = read.points(read.rows(*_VERTICES)[:, 0], read.ids(*_VERTICES))[ends]
    curve, sense = read.found(rows[:, 2], _CURVES, ids), rows[:, 3] > 0
    # an extrusion moves the curve of one of its own edges, or one that is none's
    moved = np.full(len(faces), -1)
    own = (curve[uses.edge] == swept[uses.face]) & sense[uses.edge]
    moved[uses.face[own]] = uses.edge[own]
    more = (swept >= 0) & (moved < 0)
    moved[more] = len(ids) + np.arange(np.count_nonzero(more))
    within = max(
        [GAP, *(i.numbers[0] for i in read.entities.items.values() if i.kind == "UNCERTAINTY_MEASURE_WITH_UNIT")]
    )
    curves = _curves(read, np.concatenate([curve, swept[more]]), vertices, ends, sense, ids)
    points, slopes = curves.at(lobatto()[0])
    _check_ends(curves, points, vertices, ids, within)
    model = Model(
        read.ids(*_SOLIDS), ids, curve < len(read.ids(_LINES)), curves, points, slopes, uses, faces, kind, solid,
        frames, sizes, face_rows[:, 1] > 0, moved, _patches(read, surface), *np.zeros((3, len(faces))),
    )  # fmt: skip
    flux, area, gap = measure(model, within)
    return replace(model, flux=flux, area=area, gap=gap)


class Followed:
    """Follows the references of a file."""

    def __init__(self, entities: Entities) -> None:
        self.entities = entities
        self.tables = entities.fixed | entities.listed
        # of kinds that were asked for: all ids, and in which order they grow
        self.known: dict[tuple[str, ...], tuple[Index, Index]] = {}

    def ids(self, *kinds: str) -> Index:
        """Of all entities of some kinds, kind after kind."""
        if kinds not in self.known:
            found = [self.tables[k].ids for k in kinds if k in self.tables] or [_NONE]
            ids = found[0] if len(found) == 1 else np.concatenate(found)
            self.known[kinds] = ids, np.argsort(ids, kind="stable") if len(ids) else _NONE
        return self.known[kinds][0]

    def rows(self, *kinds: str) -> Real:
        """What varies in them."""
        found = [self.entities.table(kind).rows for kind in kinds]
        return found[0] if len(found) == 1 else np.concatenate(found)

    def found(self, references: Real | Index, kinds: Sequence[str], who: Index) -> Index:
        """The places of what is referred to among all entities of some kinds."""
        ids = self.ids(*kinds)
        order = self.known[tuple(kinds)][1]
        place = order.take(ids.searchsorted(references, sorter=order), mode="clip") if len(ids) else order
        good = ids[place] == references if len(ids) else np.zeros(len(references), bool)
        if not good.all():
            wrong = int(np.argmin(good))
            raise ReadError(
                f"#{who[wrong]} of the STEP file refers to #{int(references[wrong])}, which is no {' or '.join(kinds)}"
            )
        return place

    def lists(self, texts: Sequence[bytes], kinds: Sequence[str], who: Index) -> tuple[Index, Index]:
        """The same of lists of references, one behind the other, and of how many each consists."""
        counts = np.array([text.count(b"#") for text in texts], dtype=np.int64)
        numbers = b",".join(texts).translate(None, b"#()")
        references = np.array(list(map(int, numbers.split(b",") if numbers else ())), dtype=np.int64)
        return self.found(references, kinds, np.repeat(who, counts)), counts

    def poles(self, texts: Sequence[bytes], who: Index) -> tuple[Real, Index, Index]:
        """Places of points in such lists, one list behind the other, how many each has, and where each begins."""
        flat, sizes = self.lists(texts, _POINTS, who)
        return self.rows(*_POINTS)[flat], sizes, np.cumsum(sizes) - sizes

    def points(self, references: Real | Index, who: Index) -> Real:
        """Places of points, (n, 3)."""
        return self.rows(*_POINTS)[self.found(references, _POINTS, who)]

    @cached_property
    def directions(self) -> Real:
        """Unit vectors of all directions, (n, 3)."""
        found = self.rows(*_DIRECTIONS)
        sizes = np.linalg.norm(found, axis=1)
        refuse(sizes == 0, self.ids(*_DIRECTIONS), "is a direction without length")
        return np.asarray(found / sizes[:, None])

    @cached_property
    def vectors(self) -> Real:
        """Unit vectors along all vectors, (n, 3)."""
        rows, who = self.rows(*_VECTORS), self.ids(*_VECTORS)
        refuse(rows[:, 1] == 0, who, "is a vector without length")
        return np.asarray(self.directions[self.found(rows[:, 0], _DIRECTIONS, who)])

    @cached_property
    def lines(self) -> tuple[Real, Real]:
        """Origins and directions of all lines, (n, 3) each."""
        rows, who = self.rows(_LINES), self.ids(_LINES)
        return self.points(rows[:, 0], who), self.vectors[self.found(rows[:, 1], _VECTORS, who)]

    @cached_property
    def frames(self) -> Frames:
        """All frames, by their axis and a direction along."""
        rows, who = self.rows(*_PLACES), self.ids(*_PLACES)
        axes, along = self.directions[
            self.found(rows[:, 1:].T.ravel(), _DIRECTIONS, np.concatenate([who, who]))
        ].reshape(2, -1, 3)
        refuse(np.linalg.norm(cross(axes, along), axis=1) < _LEAST_TURN, who, "has axes of one direction")
        return framed(self.points(rows[:, 0], who), axes, along)

    def placed(self, references: Real | Index, who: Index) -> Frames:
        """Some of the frames."""
        found = self.found(references, _PLACES, who)
        return Frames(self.frames.origins[found], self.frames.axes[found])


def framed(origins: Real, axes: Real, along: Real) -> Frames:
    """Frames of origins (n, 3), axes and directions near the first of the others."""
    first = along - np.sum(along * axes, axis=1)[:, None] * axes
    first /= np.linalg.norm(first, axis=1)[:, None]
    return Frames(origins, np.stack([first, cross(axes, first), axes], axis=1))


def _topology(read: Followed, edges: Index, ends: Index) -> tuple[Uses, Index, Real, Index]:
    """Uses of edges by faces; ids of the faces, their surfaces and senses (f, 2), and the solid of each."""
    solids, shells, faces = (read.ids(kind) for kind in (*_SOLIDS, *_SHELLS, *_FACES))
    bounds, loops, ways = (read.ids(*kinds) for kinds in (_BOUNDS, _LOOPS, _USES))
    listed = {kind: read.entities.listed_of(kind) for kind in (*_SHELLS, *_FACES, *_LOOPS)}
    solid_of = _once(read.found(read.rows(*_SOLIDS)[:, 0], _SHELLS, solids), np.arange(len(solids)), shells)
    members, counts = read.lists([row[0] for row in listed[_SHELLS[0]]], _FACES, shells)
    solid = _once(members, np.repeat(solid_of, counts), faces)
    members, counts = read.lists([row[0] for row in listed[_FACES[0]]], _BOUNDS, faces)
    face_of = _once(members, np.repeat(np.arange(len(faces)), counts), bounds)
    rows = read.rows(*_BOUNDS)
    bound_of = _once(read.found(rows[:, 0], _LOOPS, bounds), np.arange(len(bounds)), loops)
    members, counts = read.lists([row[0] for row in listed[_LOOPS[0]]], _USES, loops)
    loop = np.repeat(np.arange(len(loops)), counts)
    _once(members, loop, ways)
    rows_of_use, sense = read.rows(*_USES), rows[:, 1] > 0
    edge = read.found(rows_of_use[:, 0], _EDGES, ways)[members]
    along = rows_of_use[members, 1] > 0
    left = along == sense[bound_of[loop]]
    uses = Uses(edge, loop, face_of[bound_of[loop]], along, left)
    # one end of a use is the beginning of the next one in its loop
    last = np.cumsum(counts) - 1
    following = np.arange(len(edge)) + 1
    following[last] = last - counts + 1
    begin, end = (np.where(along, ends[edge, k], ends[edge, 1 - k]) for k in (0, 1))
    refuse(end != begin[following], loops[loop], "is a loop that is not closed")
    ways_of_edge = np.bincount(2 * edge + left, minlength=2 * len(edges))
    refuse(np.any(ways_of_edge.reshape(-1, 2) != 1, axis=1), edges, "is an edge that is not used once each way")
    _check_whole(uses, edges, solid, solids)
    texts = [(row[1], row[2]) for row in listed[_FACES[0]]]
    return uses, faces, np.array(texts, dtype=float).reshape(-1, 2), solid


def _once(members: Index, owners: Index, ids: Index) -> Index:
    """The owner of each entity, which must be owned once."""
    refuse(np.bincount(members, minlength=len(ids)) != 1, ids, "is not used once")
    found = np.empty(len(ids), dtype=np.int64)
    found[members] = owners
    return found


def _check_whole(uses: Uses, edges: Index, solid: Index, solids: Index) -> None:
    """The faces of each solid hang together by edges, and have none in common with another's."""
    order = np.argsort(uses.edge, kind="stable").reshape(len(edges), 2)
    a, b = uses.face[order].T
    label, before = np.arange(len(solid)), np.full(len(solid), -1)
    while not np.array_equal(label, before):
        before = label.copy()
        least = np.minimum(label[a], label[b])
        np.minimum.at(label, a, least)
        np.minimum.at(label, b, least)
        label = label[label]
    pieces = np.count_nonzero(label == np.arange(len(solid)))
    if pieces != len(solids) or np.any(solid != solid[label]):
        raise ReadError(f"{pieces} closed surfaces in the STEP file instead of {len(solids)}")


def _surfaces(read: Followed, surface: Index) -> tuple[Index, Frames, Real, Index]:
    """Kinds, frames and sizes (f, 2) of the faces' surfaces, and the curve that an extrusion moves, else -1."""
    ids_of = {name: read.ids(name) for name in _SURFACES}
    counts = [len(ids) for ids in ids_of.values()]
    kinds, total = np.repeat([*_SURFACES.values()], counts), sum(counts)
    frames, sizes, moved = (
        Frames(np.zeros((total, 3)), np.zeros((total, 3, 3))),
        np.zeros((total, 2)),
        np.full(total, -1),
    )
    for end, (name, ids) in zip(np.cumsum(counts).tolist(), ids_of.items(), strict=True):
        own, code = slice(end - len(ids), end), _SURFACES[name]
        if code == SPLINE or not len(ids):
            continue
        rows = read.rows(name)
        if code == EXTRUSION:
            axis = read.vectors[read.found(rows[:, 1], _VECTORS, ids)]
            found = framed(np.zeros_like(axis), axis, np.eye(3)[np.argmin(np.abs(axis), axis=1)])
            curve = read.found(rows[:, 0], _CURVES, ids)
            flat = np.flatnonzero(curve < len(read.ids(_LINES)))
            origin, way = (x[curve[flat]] for x in read.lines)
            across = cross(way, axis[flat])
            length = np.linalg.norm(across, axis=1)
            refuse(length == 0, ids[flat], "moves a line along itself")
            plane = framed(origin, across / length[:, None], way)
            found.origins[flat], found.axes[flat] = plane.origins, plane.axes
            kinds[own][flat], curve[flat] = PLANE, -1
            moved[own] = curve
        else:
            found = read.placed(rows[:, 0], ids)
            sizes[own, : rows.shape[1] - 1] = rows[:, 1:]
            if name == "CONICAL_SURFACE":
                sizes[own, 1] = np.tan(sizes[own, 1])
        frames.origins[own], frames.axes[own] = found.origins, found.axes
    return kinds[surface], Frames(frames.origins[surface], frames.axes[surface]), sizes[surface], moved[surface]


def _curves(read: Followed, curve: Index, vertices: Real, ends: Index, sense: Flags, ids: Index) -> Curves:
    """Every edge's curve between its vertices, and behind them whole curves that extrusions move."""
    lines, arcs = len(read.ids(_LINES)), len(read.ids(_ARCS))
    counts = np.ones(len(curve), dtype=np.int64)
    straight = np.flatnonzero(curve < lines)
    round_ = np.flatnonzero((curve >= lines) & (curve < lines + arcs))
    refuse_if(np.any(round_ >= len(ids)), "an extrusion of the STEP file moves an arc that is none of its edges")
    of_lines = straight, *np.zeros((2, 0, 3))
    if straight.size:
        origin, way = (x[curve[straight]] for x in read.lines)
        reach = np.sum((vertices[straight] - origin[:, None]) * way[:, None], axis=2)
        refuse((reach[:, 1] > reach[:, 0]) != sense[straight], ids[straight], "runs against its line")
        of_lines = straight, origin + reach[:, :1] * way, origin + reach[:, 1:] * way
    rows = read.rows(_ARCS)
    which = curve[round_] - lines
    whole = read.placed(rows[:, 0], read.ids(_ARCS))
    frames = Frames(whole.origins[which], whole.axes[which])
    local = frames.local(np.arange(len(which)), vertices[round_])
    angles = np.arctan2(local[..., 1], local[..., 0])
    way = np.where(sense[round_], 1.0, -1.0)
    sweep = np.mod(way * (angles[:, 1] - angles[:, 0]), 2 * np.pi)
    sweep[ends[round_, 0] == ends[round_, 1]] = 2 * np.pi
    counts[round_] = np.maximum(1, np.ceil(sweep / _ARC))
    of_arcs = round_, frames, rows[which, 1], angles[:, 0], way * sweep
    return Curves(counts, of_lines, of_arcs, _splines(read, curve - lines - arcs, sense, counts))


def _splines(read: Followed, spline: Index, sense: Flags, counts: Index) -> list[tuple[Knots, Index, Flags, Real]]:
    """The curves that are splines, by their knots: numbers, against which sense, and poles; ``counts`` gets spans."""
    if not (listed := read.entities.listed_of(_SPLINES)):
        return []
    poles, sizes, first = read.poles([row[1] for row in listed], read.ids(_SPLINES))
    groups = defaultdict[Row, list[int]](list)
    for number, (degree, _, closed, often, at) in enumerate(listed):
        groups[degree, often, at].append(number)
        if closed == b"1" and np.any(poles[first[number]] != poles[first[number] + sizes[number] - 1]):
            raise ReadError(f"#{read.ids(_SPLINES)[number]} of the STEP file is said to be closed")
    against = np.concatenate([~sense, np.zeros(len(spline) - len(sense), bool)])
    found = []
    for (degree, often, at), numbers in groups.items():
        members = np.array(numbers)
        who = read.ids(_SPLINES)[members]
        knots = _knots(degree, often, at, int(who[0]))
        count = len(knots.knots) - knots.degree - 1
        refuse(sizes[members] != count, who, f"has not {count} poles, as its knots ask for")
        which = np.flatnonzero(np.isin(spline, members))
        counts[which] = len(knots.spans)
        found.append((knots, which, against[which], poles[first[spline[which]][:, None] + np.arange(count)]))
    return found


def _knots(degree: bytes, often: bytes, at: bytes, who: int) -> Knots:
    """Knots, each as often as it counts: a spline that ends in its first and last pole, without a gap between.

    Raises
    ------
    ReadError
        They are not such.
    """
    places, times = list(map(float, at.split(b","))), list(map(int, often.split(b",")))
    order = int(degree)
    good = len(places) == len(times) > 1 and 1 <= order <= _MOST_DEGREE and times[0] == times[-1] == order + 1
    if not (good and all(a < b for a, b in pairwise(places)) and all(1 <= n <= order for n in times[1:-1])):
        raise ReadError(f"#{who} of the STEP file has knots of no spline between its first and its last pole")
    return Knots(order, tuple(np.repeat(places, times).tolist()))


def _check_ends(curves: Curves, points: Real, vertices: Real, ids: Index, within: float) -> None:
    first = curves.starts[: len(ids)]
    last = first + curves.counts[: len(ids)] - 1
    off = np.linalg.norm(np.stack([points[first, 0], points[last, -1]], axis=1) - vertices, axis=2).max(axis=1)
    refuse(~(off <= within), ids, "does not end at its vertices")


def _patches(read: Followed, surface: Index) -> tuple[Patches, ...]:
    """The spline surfaces that faces lie in, by their knots."""
    kind = "B_SPLINE_SURFACE_WITH_KNOTS"
    if not (listed := read.entities.listed_of(kind)):
        return ()
    ids = read.ids(kind)
    before = sum(len(read.ids(k)) for k in _SURFACES) - len(ids)
    places, _, first = read.poles([row[2] for row in listed], ids)
    groups = defaultdict[Row, list[int]](list)
    for face, number in enumerate((surface - before).tolist()):
        if number >= 0:
            row = listed[number]
            groups[row[0], row[1], *row[3:]].append(face)
    found = []
    for (u, v, often_u, often_v, at_u, at_v), members in groups.items():
        numbers = surface[members] - before
        along, across = (_knots(*x, int(ids[numbers[0]])) for x in ((u, often_u, at_u), (v, often_v, at_v)))
        shape = tuple(len(k.knots) - k.degree - 1 for k in (along, across))
        rows = np.array([[r.count(b"#") for r in listed[n][2].split(b"),(")] == [shape[1]] * shape[0] for n in numbers])
        refuse(~rows, ids[numbers], f"has not {shape[0]} x {shape[1]} poles, as its knots ask for")
        poles = places[first[numbers][:, None] + np.arange(shape[0] * shape[1])].reshape(-1, *shape, 3)
        found.append(Patches(np.array(members), poles, along, across))
    return tuple(found)

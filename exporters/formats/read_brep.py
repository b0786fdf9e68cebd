"""The solids of a STEP file: every reference followed, shells closed, curves, surfaces and vertices where they meet.

ISO 10303-42: an edge runs along its curve or against it, a face's normal is its surface's or against it, and looks out
of the material; seen from its tip the bounds run round the face on their left; in a closed shell every edge is used
twice, once each way.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from exporters.formats.read_curves import Curves, Flags, Frames, Knots, Patches, lobatto, spans_of
from exporters.formats.read_part21 import Entities, Index, Real, Row
from exporters.formats.read_surfaces import EXTRUSION, PLANE, ROUND, SPHERE, SPLINE, TORUS, forms, whole
from geometry.base.record import Record, replace
from parts.base.readback import ReadError

# edges lie on their surfaces and end at their vertices this well, mm: as the files say themselves
_GAP = 1e-7
# spans of arcs at most, rad: integrals over them are exact to rounding
_ARC = np.pi / 4
# degree of splines at most: integrals over them are exact
_MOST_DEGREE = 7
# axes are upright, and heights are one, so well: 1 - cosine, mm
_SQUARE, _LEVEL = 1e-12, 1e-7
# edges of so many spans are held against their surfaces at a time; grid points of spline surfaces
_OF_FACES = ("faces", "kind", "solid", "sizes", "normal", "moved", "flux", "gap")
_ROWS, _POINTS_AT_ONCE = 20_000, 400_000
_LINES, _ARCS, _SPLINES = "LINE", "CIRCLE", "B_SPLINE_CURVE_WITH_KNOTS"
_CURVES = (_LINES, _ARCS, _SPLINES)
_SOLIDS, _SHELLS, _FACES, _BOUNDS = ["MANIFOLD_SOLID_BREP"], ["CLOSED_SHELL"], ["ADVANCED_FACE"], ["FACE_BOUND", "FACE_OUTER_BOUND"]
_LOOPS, _USES, _EDGES, _VERTICES, _POLES = ["EDGE_LOOP"], ["ORIENTED_EDGE"], ["EDGE_CURVE"], ["VERTEX_POINT"], ["CARTESIAN_POINT"]
_SURFACES = {
    "PLANE": PLANE, "CYLINDRICAL_SURFACE": ROUND, "CONICAL_SURFACE": ROUND, "SPHERICAL_SURFACE": SPHERE,
    "TOROIDAL_SURFACE": TORUS, "SURFACE_OF_LINEAR_EXTRUSION": EXTRUSION, "B_SPLINE_SURFACE_WITH_KNOTS": SPLINE,
}  # fmt: skip


class Uses(Record):
    """Edges as the bounds of faces use them, (u,) each, loop after loop: edge, loop, face, and the way.

    ``along``: whether the loop runs along the edge; ``left``: whether the face lies on its left, seen from its normal.
    """

    edge: Index
    loop: Index
    face: Index
    along: Flags
    left: Flags


class Model(Record):
    """The solids of a file, measured.

    Edges (e,) are the first of ``curves``; those after them are the ones that extrusions move. Of all spans ``points``
    and ``slopes`` (n, 12, 3) at ``lobatto()``. Of faces (f,) ``kind``, ``solid``, ``frames``, ``sizes`` (f, 2),
    whether the ``normal`` is the surface's, and the curve that an extrusion has ``moved``; its share of the volume ``flux``, and ``gap``, mm, between it and its edges.
    ``solids``: the ids of the entities.
    """

    solids: Index
    edges: Index
    straight: Flags
    curves: Curves
    points: Real
    slopes: Real
    uses: Uses
    faces: Index
    kind: Index
    solid: Index
    frames: Frames
    sizes: Real
    normal: Flags
    moved: Index
    patches: tuple[Patches, ...]
    flux: Real
    gap: Real

    @property
    def spans(self) -> tuple[Index, Index]:
        """The spans of all uses, and the use that each belongs to."""
        return spans_of(self.curves, self.uses.edge)

    @property
    def heights(self) -> tuple[Real, Real]:
        """The least and the greatest z on the edges of each face, mm."""
        span, use = self.spans
        face, z = self.uses.face[use], self.points[span, :, 2]
        low, high = np.full(len(self.faces), np.inf), np.full(len(self.faces), -np.inf)
        np.minimum.at(low, face, z.min(axis=1))
        np.maximum.at(high, face, z.max(axis=1))
        return low, high

    @property
    def is_upright(self) -> Flags:
        """Which faces stand upright."""
        along = np.abs(self.frames.axes[:, 2, 2])
        swept = (self.kind == EXTRUSION) | ((self.kind == ROUND) & (self.sizes[:, 1] == 0))
        return np.where(swept, along > 1 - _SQUARE, (self.kind == PLANE) & (along < _SQUARE))

    def feet(self, walls: Index) -> tuple[Index, Index]:
        """The spans on which upright walls stand, and the wall of each.

        Raises
        ------
        ReadError
            A wall has no edge across the axis at its lower end.
        """
        span, use = self.spans
        face, low = self.uses.face[use], self.heights[0]
        mine = np.isin(face, walls) & (np.abs(self.points[span, :, 2] - low[face][:, None]).max(axis=1) <= _LEVEL)
        lost = ~np.isin(walls, face[mine])
        if np.any(lost):
            raise ReadError(f"#{self.faces[walls[lost][0]]} of the STEP file does not stand across the axis")
        return span[mine], face[mine]

    def only(self, number: int) -> Model:
        """One of the solids, with all edges of the file."""
        if len(self.solids) == 1:
            return self
        mine, uses = self.solid == number, self.uses
        place, used = np.cumsum(mine) - 1, mine[uses.face]
        return replace(
            self,
            solids=self.solids[[number]],
            uses=Uses(uses.edge[used], uses.loop[used], place[uses.face[used]], uses.along[used], uses.left[used]),
            frames=Frames(self.frames.origins[mine], self.frames.axes[mine]),
            patches=tuple(
                replace(p, faces=place[p.faces[own]], poles=p.poles[own])
                for p in self.patches
                if (own := mine[p.faces]).any()
            ),
            **{name: getattr(self, name)[mine] for name in _OF_FACES},
        )


def read_model(entities: Entities) -> Model:
    """The solids of a file.

    Raises
    ------
    ReadError
        A reference leads to nothing, a shell is not closed, or curves, surfaces and vertices do not meet.
    """
    read = _Reader(entities)
    ids = read.ids(*_EDGES)
    rows = read.rows(*_EDGES)
    ends = np.stack([read.found(rows[:, k], _VERTICES, ids) for k in (0, 1)], axis=1)
    uses, faces, face_rows, solid = _topology(read, ids, ends)
    surface = read.found(face_rows[:, 0], list(_SURFACES), faces)
    kind = np.concatenate([np.full(len(read.ids(k)), code) for k, code in _SURFACES.items()])[surface]
    frames, sizes, moved = _surfaces(read, surface)
    vertices = read.points(read.rows(*_VERTICES)[:, 0], read.ids(*_VERTICES))[ends]
    curve = read.found(rows[:, 2], _CURVES, ids)
    curves = _curves(read, np.concatenate([curve, moved[moved >= 0]]), vertices, ends, rows[:, 3] > 0, ids)
    moved[moved >= 0] = len(ids) + np.arange(np.count_nonzero(moved >= 0))
    points, slopes = curves.at(lobatto()[0])
    _check_ends(curves, points, vertices, ids)
    model = Model(
        read.ids(*_SOLIDS), ids, curve < len(read.ids(_LINES)), curves, points, slopes, uses, faces, kind, solid, frames,
        sizes, face_rows[:, 1] > 0, moved, _patches(read, surface), *np.zeros((2, len(faces))),
    )  # fmt: skip
    flux, gap = _measure(model)
    return replace(model, flux=flux, gap=gap)


class _Reader:
    """Follows the references of a file."""

    def __init__(self, entities: Entities) -> None:
        self.entities = entities

    def ids(self, *kinds: str) -> Index:
        """Of all entities of some kinds, kind after kind."""
        tables = self.entities.fixed | self.entities.listed
        return np.concatenate([np.zeros(0, np.int64), *(tables[k].ids for k in kinds if k in tables)])

    def rows(self, *kinds: str) -> Real:
        """What varies in them."""
        return np.concatenate([self.entities.table(kind).rows for kind in kinds])

    def found(self, references: Real | Index, kinds: Sequence[str], who: Index) -> Index:
        """The places of what is referred to among all entities of some kinds."""
        ids = self.ids(*kinds)
        order = np.argsort(ids, kind="stable")
        place = np.minimum(np.searchsorted(ids[order], references), len(ids) - 1)
        good = ids[order][place] == references if len(ids) else np.zeros(len(references), bool)
        if not good.all():
            wrong = int(np.argmin(good))
            raise ReadError(
                f"#{who[wrong]} of the STEP file refers to #{int(references[wrong])}, which is no {' or '.join(kinds)}"
            )
        return np.asarray(order[place])

    def lists(self, texts: Sequence[bytes], kinds: Sequence[str], who: Index) -> tuple[Index, Index]:
        """The same of lists of references, one behind the other, and of how many each consists."""
        counts = np.array([text.count(b"#") for text in texts], dtype=np.int64)
        numbers = b",".join(texts).translate(None, b"#()")
        references = np.array(list(map(int, numbers.split(b",") if numbers else ())), dtype=np.int64)
        return self.found(references, kinds, np.repeat(who, counts)), counts

    def points(self, references: Real | Index, who: Index) -> Real:
        """Places of points, (n, 3)."""
        return self.rows("CARTESIAN_POINT")[self.found(references, ["CARTESIAN_POINT"], who)]

    def directions(self, references: Real, who: Index) -> Real:
        """Unit vectors, (n, 3)."""
        found = self.rows("DIRECTION")[self.found(references, ["DIRECTION"], who)]
        sizes = np.linalg.norm(found, axis=1)
        _refuse(sizes == 0, who, "has a direction without length")
        return np.asarray(found / sizes[:, None])

    def placed(self, references: Real, who: Index) -> Frames:
        """Frames by their axis and a direction along."""
        rows = self.rows("AXIS2_PLACEMENT_3D")[self.found(references, ["AXIS2_PLACEMENT_3D"], who)]
        return framed(self.points(rows[:, 0], who), self.directions(rows[:, 1], who), self.directions(rows[:, 2], who))


def frames_of(entities: Entities, references: Index, who: Index) -> Frames:
    """Frames that other entities name."""
    return _Reader(entities).placed(references, who)


def framed(origins: Real, axes: Real, along: Real) -> Frames:
    """Frames of origins (n, 3), axes and directions near the first of the others."""
    first = along - np.sum(along * axes, axis=1)[:, None] * axes
    first /= np.linalg.norm(first, axis=1)[:, None]
    return Frames(origins, np.stack([first, np.cross(axes, first), axes], axis=1))


def _refuse(wrong: Flags, who: Index, what: str) -> None:
    if np.any(wrong):
        raise ReadError(f"#{who[int(np.argmax(wrong))]} of the STEP file {what}")


def _topology(read: _Reader, edges: Index, ends: Index) -> tuple[Uses, Index, Real, Index]:
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
    _refuse(end != begin[following], loops[loop], "is a loop that is not closed")
    ways_of_edge = np.bincount(2 * edge + left, minlength=2 * len(edges))
    _refuse(np.any(ways_of_edge.reshape(-1, 2) != 1, axis=1), edges, "is an edge that is not used once each way")
    _check_whole(uses, edges, solid, solids)
    texts = [(row[1], row[2]) for row in listed[_FACES[0]]]
    return uses, faces, np.array(texts, dtype=float).reshape(-1, 2), solid


def _once(members: Index, owners: Index, ids: Index) -> Index:
    """The owner of each entity, which must be owned once."""
    _refuse(np.bincount(members, minlength=len(ids)) != 1, ids, "is not used once")
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
    pieces = np.unique(np.stack([label, solid]), axis=1)
    if pieces.shape[1] != len(solids) or len(np.unique(pieces[0])) != len(solids):
        raise ReadError(f"{len(np.unique(label))} closed surfaces in the STEP file instead of {len(solids)}")


def _surfaces(read: _Reader, surface: Index) -> tuple[Frames, Real, Index]:
    """Frames and sizes (f, 2) of the faces' surfaces, and the curve that an extrusion moves, -1 where there is none."""
    origins, axes, sizes, moved = [], [], [], []
    for name, kind in _SURFACES.items():
        ids = read.ids(name)
        count = len(ids)
        size, curve = np.zeros((count, 2)), np.full(count, -1)
        if kind == SPLINE:
            frames = Frames(np.zeros((count, 3)), np.zeros((count, 3, 3)))
        elif kind == EXTRUSION:
            rows = read.rows(name)
            vectors = read.rows("VECTOR")[read.found(rows[:, 1], ["VECTOR"], ids)]
            axis = read.directions(vectors[:, 0], ids)
            frames = framed(np.zeros((count, 3)), axis, np.eye(3)[np.argmin(np.abs(axis), axis=1)])
            curve = read.found(rows[:, 0], _CURVES, ids)
        else:
            rows = read.rows(name)
            frames = read.placed(rows[:, 0], ids)
            size[:, : rows.shape[1] - 1] = rows[:, 1:]
            _refuse(np.any(size < 0, axis=1), ids, "has a size below 0")
            if name == "CONICAL_SURFACE":
                size[:, 1] = np.tan(size[:, 1])
        origins.append(frames.origins)
        axes.append(frames.axes)
        sizes.append(size)
        moved.append(curve)
    frames = Frames(np.concatenate(origins)[surface], np.concatenate(axes)[surface])
    return frames, np.concatenate(sizes)[surface], np.concatenate(moved)[surface]


def _curves(read: _Reader, curve: Index, vertices: Real, ends: Index, sense: Flags, ids: Index) -> Curves:
    """Every edge's curve between its vertices, and behind them whole curves that extrusions move."""
    lines, arcs = len(read.ids(_LINES)), len(read.ids(_ARCS))
    counts = np.ones(len(curve), dtype=np.int64)
    straight = np.flatnonzero(curve < lines)
    round_ = np.flatnonzero((curve >= lines) & (curve < lines + arcs))
    _refuse(np.concatenate([straight, round_]) >= len(ids), np.array([0]), "moves a line or an arc along a line")
    rows = read.rows(_LINES)
    who = read.ids(_LINES)
    vectors = read.rows("VECTOR")[read.found(rows[:, 1], ["VECTOR"], who)]
    origin = read.points(rows[:, 0], who)[curve[straight]]
    way = read.directions(vectors[:, 0], who)[curve[straight]]
    reach = np.sum((vertices[straight] - origin[:, None]) * way[:, None], axis=2)
    _refuse((reach[:, 1] > reach[:, 0]) != sense[straight], ids[straight], "runs against its line")
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


def _splines(read: _Reader, spline: Index, sense: Flags, counts: Index) -> list[tuple[Knots, Index, Flags, Real]]:
    """The curves that are splines, by their knots: numbers, against which sense, and poles; ``counts`` gets spans."""
    listed = read.entities.listed_of(_SPLINES)
    flat, sizes = read.lists([row[1] for row in listed], _POLES, read.ids(_SPLINES))
    first = np.cumsum(sizes) - sizes
    poles = read.rows(*_POLES)[flat]
    groups = defaultdict[Row, list[int]](list)
    for number, (degree, _, often, at) in enumerate(listed):
        groups[degree, often, at].append(number)
    order = np.argsort(spline, kind="stable")
    sorted_ = spline[order]
    against = np.concatenate([~sense, np.zeros(len(spline) - len(sense), bool)])
    found = []
    for (degree, often, at), numbers in groups.items():
        members = np.array(numbers)
        who = read.ids(_SPLINES)[members]
        knots = _knots(degree, often, at, int(who[0]))
        count = len(knots.knots) - knots.degree - 1
        _refuse(sizes[members] != count, who, f"has not {count} poles, as its knots ask for")
        low, high = np.searchsorted(sorted_, members), np.searchsorted(sorted_, members, side="right")
        used = np.repeat(members, high - low)
        which = order[np.repeat(low, high - low) + np.arange(len(used)) - np.repeat(np.cumsum(high - low) - (high - low), high - low)]
        counts[which] = len(knots.spans)
        found.append((knots, which, against[which], poles[first[used][:, None] + np.arange(count)]))
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


def _check_ends(curves: Curves, points: Real, vertices: Real, ids: Index) -> None:
    first = curves.starts[: len(ids)]
    last = first + curves.counts[: len(ids)] - 1
    off = np.linalg.norm(points[first, 0] - vertices[:, 0], axis=1)
    off = np.maximum(off, np.linalg.norm(points[last, -1] - vertices[:, 1], axis=1))
    _refuse(~(off <= _GAP), ids, "does not end at its vertices")
    """neighbouring spans of a spline whose inner knot counts as its degree meet in a pole"""


def _patches(read: _Reader, surface: Index) -> tuple[Patches, ...]:
    """The spline surfaces that faces lie in, by their knots."""
    kind = "B_SPLINE_SURFACE_WITH_KNOTS"
    listed, ids = read.entities.listed_of(kind), read.ids(kind)
    before = sum(len(read.ids(k)) for k in _SURFACES) - len(ids)
    flat, sizes = read.lists([row[2] for row in listed], _POLES, ids)
    first = np.cumsum(sizes) - sizes
    places = read.rows(*_POLES)[flat]
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
        _refuse(~rows, ids[numbers], f"has not {shape[0]} x {shape[1]} poles, as its knots ask for")
        poles = places[first[numbers][:, None] + np.arange(shape[0] * shape[1])].reshape(-1, *shape, 3)
        found.append(Patches(np.array(members), poles, along, across))
    return tuple(found)


def _measure(model: Model) -> tuple[Real, Real]:
    """Flux and gap of every face, which must lie on the left of its bounds."""
    uses, count = model.uses, len(model.faces)
    flux, area, turns, about, gap = np.zeros((5, count))
    span, row = spans_of(model.curves, uses.edge)
    kinds = model.kind[uses.face[row]]
    weights = lobatto()[1]
    for kind in (PLANE, ROUND, SPHERE, TORUS, EXTRUSION):
        mine = np.flatnonzero(kinds == kind)
        if kind == TORUS and mine.size:
            about = _about(model, span[mine], uses.face[row[mine]])
        for start in range(0, len(mine), _ROWS):
            part = mine[start : start + _ROWS]
            face = uses.face[row[part]]
            at = model.frames.local(face, model.points[span[part]])
            way = np.where(uses.left[row[part]], 1.0, -1.0)[:, None, None]
            step = way * model.frames.local(face, model.slopes[span[part]], moved=False)
            found = forms(kind, at, step, model.frames.centres[face], model.sizes[face], about[face])
            for total, form in ((flux, found.flux), (area, found.area), (turns, found.turn)):
                total += np.bincount(face, form @ weights, count)
            np.maximum.at(gap, face, found.gap.max(axis=1))
    sense = np.where(model.normal, 1.0, -1.0)
    for kind in (SPHERE, TORUS):
        mine = np.flatnonzero(model.kind == kind)
        more = whole(kind, model.sizes[mine], model.frames.centres[mine, 2], turns[mine], area[mine], sense[mine])
        flux[mine] += more
        area[mine] += np.where(more != 0, sense[mine] * np.inf, 0.0)
    _follow(model, np.flatnonzero(model.kind[uses.face] == EXTRUSION), area, gap)
    for patches in model.patches:
        _measure_patches(model, patches, flux, area, gap)
    if not gap.max(initial=0.0) <= _GAP:
        wrong = int(np.argmax(gap))
        raise ReadError(f"#{model.faces[wrong]} of the STEP file is {gap[wrong]:.6g} mm away from its edges")
    _refuse(~(sense * area > 0), model.faces, "is a face turned inside out")
    return flux, gap


def _about(model: Model, span: Index, face: Index) -> Real:
    """For faces on a torus a middle angle of their bounds round the tube, rad."""
    at = model.frames.local(face, model.points[span])
    spokes = np.hypot(at[..., 0], at[..., 1]) - model.sizes[face, :1] + 1j * at[..., 2]
    total = (spokes / np.abs(spokes)).sum(axis=1)
    return np.angle(np.bincount(face, total.real, len(model.faces)) + 1j * np.bincount(face, total.imag, len(model.faces)))


def _follow(model: Model, mine: Index, area: Real, gap: Real) -> None:
    """Edges of extrusions: straight ones are rulings at an end of the moved curve, others copies of it, span by span."""
    uses, curves = model.uses, model.curves
    face, edge = uses.face[mine], uses.edge[mine]
    basis = model.moved[face]
    alike = curves.counts[edge] == curves.counts[basis]
    off = np.where(alike | model.straight[edge], 0.0, np.inf)
    ruling = np.flatnonzero(model.straight[edge])
    first, last = curves.starts[basis[ruling]], (curves.starts + curves.counts)[basis[ruling]] - 1
    at = model.frames.local(face[ruling], model.points[curves.starts[edge[ruling]]])
    ends = np.stack([model.points[first, 0], model.points[last, -1]], axis=1)
    away = at[:, :, None, :2] - model.frames.local(face[ruling], ends)[:, None, :, :2]
    off[ruling] = np.hypot(away[..., 0], away[..., 1]).max(axis=1).min(axis=1)
    copy = np.flatnonzero(alike & ~model.straight[edge])
    if copy.size:
        span, row = spans_of(curves, edge[copy])
        begin = np.flatnonzero(np.diff(row, prepend=-1))
        at = model.frames.local(face[copy][row], model.points[span])
        gaps = []
        for way in (1, -1):
            its, _ = spans_of(curves, basis[copy], np.full(len(copy), way > 0))
            away = at - model.frames.local(face[copy][row], model.points[its])[:, ::way]
            gaps.append(np.maximum.reduceat(np.hypot(away[..., 0], away[..., 1]).max(axis=1), begin))
        off[copy] = np.minimum(*gaps)
        way = np.where(gaps[0] <= gaps[1], 1.0, -1.0) * np.where(uses.left[mine[copy]], 1.0, -1.0)
        height = np.add.reduceat(at[..., 2].mean(axis=1), begin) / curves.counts[edge[copy]]
        np.add.at(area, face[copy], -height * way)
    np.maximum.at(gap, face, off)


def _measure_patches(model: Model, patches: Patches, flux: Real, area: Real, gap: Real) -> None:
    """Spline faces between the four ends of their surfaces: the same, by Gauss's rule on every span."""
    uses, curves = model.uses, model.curves
    nodes, weights = lobatto()
    order = np.argsort(uses.face, kind="stable")
    low = np.searchsorted(uses.face[order], patches.faces)
    four = np.searchsorted(uses.face[order], patches.faces, side="right") - low == 4
    _refuse(~four, model.faces[patches.faces], "is a spline face without four edges")
    mine = order[low[:, None] + np.arange(4)]
    shape = tuple(len(k.spans) for k in (patches.along, patches.across))
    block = max(1, _POINTS_AT_ONCE // (shape[0] * shape[1] * len(nodes) ** 2))
    for start in range(0, len(mine), block):
        part = slice(start, start + block)
        points, along, across = patches.grid(nodes, part)
        normal = np.sum(points * np.cross(along, across), axis=3) / 3
        spread = np.einsum("nij,i,j->n", normal, np.tile(weights, shape[0]), np.tile(weights, shape[1]))
        faces = patches.faces[part]
        flux[faces] = np.where(model.normal[faces], spread, -spread)
        sides = points[:, :, 0], points[:, -1], points[:, ::-1, -1], points[:, 0, ::-1]
        # the side that each edge runs along, and whether round the patch on its left
        side, way, off = (np.full((len(faces), 4), x) for x in (-1, 0.0, np.inf))
        for place in range(4):
            edge = uses.edge[mine[part, place]]
            for number, line in enumerate(sides):
                fits = np.flatnonzero(curves.counts[edge] * len(nodes) == line.shape[1])
                span, _ = spans_of(curves, edge[fits])
                run = model.points[span].reshape(len(fits), *line.shape[1:])
                for turn in (1, -1):
                    away = np.linalg.norm(run[:, ::turn] - line[fits], axis=2).max(axis=1)
                    nearer = away < off[fits, place]
                    chosen = fits[nearer]
                    off[chosen, place], side[chosen, place] = away[nearer], number
                    way[chosen, place] = turn * np.where(uses.left[mine[part, place]], 1, -1)[chosen]
        proper = np.all(np.sort(side, axis=1) == np.arange(4), axis=1) & np.all(way == way[:, :1], axis=1)
        gap[faces] = np.where(proper, off.max(axis=1), np.inf)
        area[faces] = way[:, 0]

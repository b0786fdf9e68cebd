"""Surfaces of a STEP file against the edges of their faces: how far these lie off, and what flux a face has.

The flux of X/3 through a face is its share of the volume. On planes, surfaces of revolution and extrusions it is that
of a 1-form round the bounds (Stokes): with a surface's own parameters u and v, v along the axis,
X . (X_u x X_v) / 3 du dv = d(-H du), H its integral over v. Spline surfaces are integrated over between their ends.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from exporters.formats.read_curves import Patches, lobatto, spans_of
from exporters.formats.read_part21 import Index
from exporters.formats.read_solid import EXTRUSION, GAP, PLANE, ROUND, SPHERE, SPLINE, TORUS, Model, refuse
from geometry.base.record import Record
from geometry.base.vectors import cross
from geometry.curves.curve import Flags, Real
from parts.base.readback import ReadError

# a seam whose spans turn less than this round the axis of a torus runs round its tube, rad
_SEAM = 1e-9
# edges of so many spans are held against their surfaces at a time; grid points of spline surfaces
_ROWS, _POINTS_AT_ONCE = 20_000, 400_000


class Forms(Record, eq=False):
    """At nodes (n, k) of edges: distance from the surface, mm, and the 1-forms of flux, area, area of (u, v), and u.

    Of extrusions the last two areas hang on which way their moved curve is run: see ``_follow``.
    """

    gap: Real
    flux: Real
    size: Real
    area: Real
    turn: Real


def forms(kind: int, at: Real, step: Real, centre: Real, sizes: Real, about: Real) -> Forms:
    """Of points and steps (n, k, 3) in the frames of their surfaces; ``centre`` (n, 3): a frame's own origin in it.

    ``sizes`` (n, 2): radius, and tangent of the half angle of a cone, or a torus's second radius; ``about`` (n, 2):
    angles round the tube of a torus, rad: one within half a turn of theirs, and one of the face, which integrals over
    v begin at: from 0 on a tube far wider than its face is off the axis would sweep more than digits can hold.
    """
    x, y, z = np.moveaxis(at, 2, 0)
    c1, c2, c3 = (centre[:, k, None] for k in range(3))
    r, s = sizes[:, 0, None], sizes[:, 1, None]
    turn = x * step[..., 1] - y * step[..., 0]
    if kind == PLANE:
        return Forms(np.abs(z), c3 / 6 * turn, turn / 2, turn / 2, turn)
    if kind == EXTRUSION:
        none = np.zeros_like(x)
        return Forms(none, -z / 3 * turn, none, none, turn)
    size = np.hypot(x, y)
    with np.errstate(divide="ignore", invalid="ignore"):
        turn = np.where(size > 0, turn / size**2, 0.0)
        across = np.where(size > 0, (x * c1 + y * c2) / size, 0.0)
    if kind == ROUND:
        # the normal is (n - s a) of size root(1 + s^2); on a flat cone heights tell less of its area than distances
        with np.errstate(divide="ignore", invalid="ignore"):
            spread = -np.where(s > 1, (size * size - r * r) / (2 * s), r * z + s * z * z / 2) * turn
        slant = np.sqrt(1 + s * s)
        gap = np.abs(size - (r + z * s)) / slant
        return Forms(gap, (across - s * c3 + r) / 3 * spread, slant * spread, -z * turn, turn)
    if kind == SPHERE:
        v = np.arctan2(z, size)
        inside = across * (v / 2 + np.sin(2 * v) / 4) + c3 * np.sin(v) ** 2 / 2 + r * np.sin(v)
        area = -np.sin(v) * turn
        return Forms(np.abs(np.hypot(size, z) - r), -r * r / 3 * inside * turn, r * r * area, area, turn)
    near, base = about[:, :1], about[:, 1:]
    v = np.unwrap(np.angle((size - r + 1j * z) * np.exp(-1j * near)))
    # an end may lie half a turn away
    v += near - 2 * np.pi * np.round(v[:, [v.shape[1] // 2]] / (2 * np.pi)) - base
    # once round a tube takes two pieces to hold all digits
    shares, weights = lobatto() if np.abs(v).max() <= np.pi else _halved()
    cos, sin = (f(base[..., None] + v[..., None] * shares) for f in (np.cos, np.sin))
    ring = r[..., None] + s[..., None] * cos
    outwards = (across + r)[..., None] * cos + c3[..., None] * sin + s[..., None]
    inside, spread = (s * turn * v * (x @ weights) for x in (ring * outwards, ring))
    return Forms(np.abs(np.hypot(size - r, z) - s), -inside / 3, -spread, -v * turn, turn)


@cache
def _halved() -> tuple[Real, Real]:
    """Nodes and weights of both halves of 0 .. 1."""
    nodes, weights = lobatto()
    return np.concatenate([nodes, 1 + nodes]) / 2, np.tile(weights, 2) / 2


def poles_of(sizes: Real, along: Real, turns: Real, bare: Flags, sense: Real) -> tuple[Real, Real]:
    """Flux and area that faces round a pole of a sphere, and whole spheres, have beside those of their bounds.

    ``along``: the centre's place on the axis; ``turns``: of the bounds round it; ``bare``: without bounds but seams.
    """
    r = sizes[:, 0]
    poles = np.sign((turns / (2 * np.pi)).round()) * sense
    size = sense * 2 * np.pi * r * r * np.where(poles != 0, 1.0, np.where(bare, 2.0, 0.0))
    return size * (r + poles * along / 2) / 3, size


def measure(model: Model, within: float) -> tuple[Real, Real, Real]:
    """Flux, area and gap of every face, which must lie on the left of its bounds, ``within`` so many mm of them."""
    uses, count = model.uses, len(model.faces)
    flux, size, area, turns, gap = np.zeros((5, count))
    span, row = spans_of(model.curves, uses.edge)
    kinds = model.kind[uses.face[row]]
    weights = lobatto()[1]
    # edges on both sides of which one face lies
    pairs = np.argsort(uses.edge, kind="stable").reshape(-1, 2)
    seams = np.empty(len(uses.edge), dtype=bool)
    seams[pairs] = (uses.face[pairs[:, 0]] == uses.face[pairs[:, 1]])[:, None]
    sense, centres = np.where(model.normal, 1.0, -1.0), model.frames.centres
    bare = np.bincount(uses.face, ~seams, count) == 0
    for kind in np.unique(kinds[kinds != SPLINE]).tolist():
        mine = np.flatnonzero(kinds == kind)
        about, rows = np.zeros((len(mine), 2)), _ROWS
        if kind == TORUS:
            rows //= len(_halved()[0])
            about = _about(model, span[mine], uses.face[row[mine]], uses.left[row[mine]], seams[row[mine]])
        for start in range(0, len(mine), rows):
            part = mine[start : start + rows]
            face = uses.face[row[part]]
            at = model.frames.local(face, model.points[span[part]])
            way = np.where(uses.left[row[part]], 1.0, -1.0)[:, None, None]
            step = way * model.frames.local(face, model.slopes[span[part]], moved=False)
            if kind == SPHERE:
                poles = (np.hypot(at[..., 0], at[..., 1]).min(axis=1) <= GAP) & ~seams[row[part]]
                refuse(poles, model.faces[face], "is a face with an edge through a pole")
            found = forms(kind, at, step, centres[face], model.sizes[face], about[start : start + rows])
            # a seam runs there and back, at an apex by more than digits hold; of a torus its sides may be a turn apart
            once = ~seams[row[part]] | (kind == TORUS)
            for total, form in (flux, found.flux), (size, found.size), (area, found.area), (turns, found.turn):
                total += np.bincount(face[once], form[once] @ weights, count)
            np.maximum.at(gap, face, found.gap.max(axis=1))
    # round an axis bounds go there and back, or once about an apex or a pole
    twice = np.isin(model.kind, (ROUND, SPHERE, TORUS)) & (np.abs(turns) > 3 * np.pi)
    refuse(twice, model.faces, "is a face with bounds that go round it the same way")
    if (mine := np.flatnonzero(model.kind == SPHERE)).size:
        more = poles_of(model.sizes[mine], centres[mine, 2], turns[mine], bare[mine], sense[mine])
        flux[mine] += more[0]
        size[mine] += more[1]
        area[mine] += np.where(more[1] != 0, sense[mine] * np.inf, 0.0)
    # a face on a cone round the apex, at z = -r / s, has a bound of no length there
    if (apex := np.flatnonzero((model.kind == ROUND) & (model.sizes[:, 1] > 0) & (np.abs(turns) > np.pi))).size:
        r, s = model.sizes[apex].T
        spread = -r * r / (2 * s) * turns[apex]
        flux[apex] += (r - s * centres[apex, 2]) / 3 * spread
        size[apex] += np.sqrt(1 + s * s) * spread
        area[apex] -= r / s * turns[apex]
    if (swept := np.flatnonzero(model.kind[uses.face] == EXTRUSION)).size:
        _follow(model, swept, size, area, gap)
    for patches in model.patches:
        _measure_patches(model, patches, flux, size, area, gap)
    if not gap.max(initial=0.0) <= within:
        wrong = int(np.argmax(gap))
        raise ReadError(f"#{model.faces[wrong]} of the STEP file is {gap[wrong]:.6g} mm away from its edges")
    refuse(~(sense * area > 0), model.faces, "is a face turned inside out")
    return flux, np.abs(size), gap


def area_of(model: Model, pieces: int) -> float:
    """The area of all faces, mm^2, spans of spline surfaces cut into so many pieces each way, and of moved curves."""
    if pieces == 1:
        return float(model.area.sum())
    nodes, weights = lobatto()
    steps = np.arange(pieces)[:, None]
    shares, parts = ((steps + nodes) / pieces).ravel(), np.tile(weights, pieces) / pieces
    total = float(model.area.sum())
    if (swept := np.flatnonzero(model.kind == EXTRUSION)).size:
        span, wall = spans_of(model.curves, model.moved[swept])
        whole, finer = (
            np.bincount(wall, (np.linalg.norm(slopes, axis=2) @ sizes)[span])
            for slopes, sizes in ((model.slopes, weights), (model.curves.at(shares)[1], parts))
        )
        total += float(model.area[swept] @ (finer / whole - 1))
    for patches in model.patches:
        for row in range(len(patches.faces)):
            _, along, across = patches.grid(shares, shares, slice(row, row + 1))
            wide, high = np.tile(parts, len(patches.along.spans)), np.tile(parts, len(patches.across.spans))
            size = np.linalg.norm(cross(along, across), axis=3)[0]
            total += float(wide @ size @ high) - float(model.area[patches.faces[row]])
    return total


def _about(model: Model, span: Index, face: Index, left: Flags, seams: Flags) -> Real:
    """For spans of the bounds of faces on a torus angles round the tube, near theirs and of the face, rad, (n, 2).

    A face that is cut open by a seam round the axis reaches from it once round the tube: its sides are a turn apart.
    By a seam round the tube a face lies where that does; others lie where their bounds do.
    """
    at, step = (
        model.frames.local(face, of[span], moved=moved) for of, moved in ((model.points, True), (model.slopes, False))
    )
    size = np.hypot(at[..., 0], at[..., 1])
    spokes = size - model.sizes[face, :1] + 1j * at[..., 2]
    turn = ((at[..., 0] * step[..., 1] - at[..., 1] * step[..., 0]) / size**2) @ lobatto()[1]
    rank = np.where(seams, np.where(np.abs(turn) > _SEAM, 2, 1), 0)
    best = np.zeros(len(model.faces), dtype=int)
    np.maximum.at(best, face, rank)
    own = (spokes / np.abs(spokes) * np.linalg.norm(step, axis=2)) @ lobatto()[1]
    own *= (rank == best[face]) * np.where(rank == 2, -1.0, 1.0)
    total = np.bincount(face, own.real, len(model.faces)) + 1j * np.bincount(face, own.imag, len(model.faces))
    side = np.sign(turn) * np.where(left == model.normal[face], np.pi, -np.pi)
    middle = np.angle(total)[face]
    return np.column_stack([middle - np.where(rank == 2, side, 0.0), middle])


def _follow(model: Model, mine: Index, size: Real, area: Real, gap: Real) -> None:
    """Edges of extrusions: straight ones are rulings at an end of the moved curve, others its copies, span by span."""
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
        with_it = np.where(gaps[0] <= gaps[1], 1.0, -1.0) * np.where(uses.left[mine[copy]], 1.0, -1.0)
        height = np.add.reduceat(at[..., 2].mean(axis=1), begin) / curves.counts[edge[copy]]
        steps = model.frames.local(face[copy][row], model.slopes[span], moved=False)
        length = np.add.reduceat(np.hypot(steps[..., 0], steps[..., 1]) @ lobatto()[1], begin)
        np.add.at(area, face[copy], -height * with_it)
        np.add.at(size, face[copy], -height * with_it * length)
    np.maximum.at(gap, face, off)


def _measure_patches(model: Model, patches: Patches, flux: Real, size: Real, area: Real, gap: Real) -> None:
    """Spline faces between the four ends of their surfaces: the same, by Gauss's rule on every span.

    An end that is a point has no edge.
    """
    uses, curves = model.uses, model.curves
    nodes, weights = lobatto()
    order = np.argsort(uses.face, kind="stable")
    low = np.searchsorted(uses.face[order], patches.faces)
    own = np.searchsorted(uses.face[order], patches.faces, side="right") - low
    refuse((own != 4) & (own != 3), model.faces[patches.faces], "is a spline face without four edges")
    mine = order[low[:, None] + np.minimum(np.arange(4), own[:, None] - 1)]
    shape = tuple(len(k.spans) for k in (patches.along, patches.across))
    block = max(1, _POINTS_AT_ONCE // (shape[0] * shape[1] * len(nodes) ** 2))
    for start in range(0, len(mine), block):
        part = slice(start, start + block)
        points, along, across = patches.grid(nodes, nodes, part)
        normal = cross(along, across)
        wide, high = np.tile(weights, shape[0]), np.tile(weights, shape[1])
        spread = np.einsum("nij,i,j->n", np.sum(points * normal, axis=3) / 3, wide, high)
        faces = patches.faces[part]
        flux[faces] = np.where(model.normal[faces], spread, -spread)
        size[faces] = np.einsum("nij,i,j->n", np.sqrt(np.sum(normal * normal, axis=3)), wide, high)
        sides = points[:, :, 0], points[:, -1], points[:, ::-1, -1], points[:, 0, ::-1]
        # the side that each edge runs along, and whether round the patch on its left
        side, way, off = (np.full((len(faces), 4), x) for x in (-1, 0.0, np.inf))
        for corner in range(4):
            edge = uses.edge[mine[part, corner]]
            for number, line in enumerate(sides):
                fits = np.flatnonzero(curves.counts[edge] * len(nodes) == line.shape[1])
                span, _ = spans_of(curves, edge[fits])
                run = model.points[span].reshape(len(fits), *line.shape[1:])
                for turn in (1, -1):
                    away = np.linalg.norm(run[:, ::turn] - line[fits], axis=2).max(axis=1)
                    nearer = away < off[fits, corner]
                    chosen = fits[nearer]
                    off[chosen, corner], side[chosen, corner] = away[nearer], number
                    way[chosen, corner] = turn * np.where(uses.left[mine[part, corner]], 1, -1)[chosen]
        # of three edges the fourth end has no length
        lengths = np.stack([np.linalg.norm(line - line[:, :1], axis=2).max(axis=1) for line in sides], axis=1)
        three = np.flatnonzero(own[part] == 3)
        side[three, 3], off[three, 3] = lengths[three].argmin(axis=1), lengths[three].min(axis=1)
        proper = np.all(np.sort(side, axis=1) == np.arange(4), axis=1) & np.all(way == way[:, :1], axis=1)
        gap[faces] = np.where(proper, off.max(axis=1), np.inf)
        area[faces] = way[:, 0]

"""What stands for a part where solids are held against each other: circles, symmetry, and a mesh where it is wanted."""

from __future__ import annotations

import math
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.base.record import Record, made_once
from geometry.curves.curve import Complex, Real
from geometry.curves.line_arc import Arc
from geometry.plane.profile import Profile
from geometry.solids.body import Body
from parts.base.part import Part
from parts.scene.half_sections import Sectioned, sectioned
from parts.scene.interference import inner_solid, is_slabs

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from geometry.solids.faced import FacedBody
    from parts.scene.standing import Instance

# what is one length, mm; what radii may lie beyond samples, or chords, as a part of them
_SAME, _DIGITS, _MARGIN = 1e-7, 7, 1e-3
_TURN = 2 * math.pi
# mm: as near as faces are wanted to see of what kind they are
_ROUGH = 0.1
# what turns about an axis is swept in so many layers and sides; part of the reach by which radii differ
_LAYERS, _SIDES, _LEVEL = 500, 256, 1e-4


class Slab(Record):
    """A section (a polygon of shapely) between two levels, mm."""

    low: float
    high: float
    section: BaseGeometry


class Shape:
    """What stands for a part: its reach and free bore (mm), levels, walls that are not round; its solid when asked for.

    ``walls``: how often each looks alike in a turn, and the radii (mm) between which it lies.
    """

    def __init__(self, part: Part) -> None:
        self.part, body = part, part.blank(0.0)
        self.low, self.high = body.levels()[0], body.levels()[-1]
        self.reach, self.walls = _outline(body)

    def count(self, near: float, far: float) -> int:
        """How often it looks alike in a turn between two radii, mm; 0: it is round."""
        return math.gcd(*(n for n, low, high in self.walls if low < far and high > near))

    @cached_property
    def solid(self) -> Any:
        """A mesh inside it; GeometryError where a wall is too thin for one."""
        return inner_solid(self.part)

    @property
    def sections(self) -> Sectioned | None:
        """Those about its axis, if they tell where it is: not of a wheel whose teeth are taken for whole."""
        made = sectioned(self.part)
        return made if made.known and not made.teeth else None

    @cached_property
    def profile(self) -> tuple[Real, Real]:
        """Levels (n + 1), mm, and how far it reaches from its axis between each two (n), no less."""
        mesh = self.solid.to_mesh()
        corners = np.asarray(mesh.vert_properties, dtype=float)[:, :3][np.asarray(mesh.tri_verts)]
        radii = np.hypot(corners[..., 0], corners[..., 1]).max(axis=1)
        low, high = corners[..., 2].min(axis=1), corners[..., 2].max(axis=1)
        # shoulders are levels of their own
        even = np.linspace(low.min(), high.max(), _LAYERS + 1)
        thin = _SAME * max(self.reach, even[-1] - even[0])
        levels = np.unique(np.concatenate([even, low[high - low <= thin]]))
        levels = levels[np.concatenate([[True], np.diff(levels) > 2 * thin])]
        count = len(levels) - 1
        # each triangle reaches its greatest radius in every layer that it goes through
        first, last = (np.searchsorted(levels, z, "right") - 1 for z in (low + 2 * thin, high - 2 * thin))
        first, last = np.clip(first, 0, count - 1), np.clip(last, 0, count - 1)
        counts = np.maximum(last - first, 0) + 1
        layers = np.repeat(first, counts) + np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        reach = np.zeros(count)
        np.maximum.at(reach, layers, np.repeat(radii, counts))
        # layers of one radius are one
        grid = _LEVEL * self.reach
        reach = np.ceil(reach / grid) * grid
        starts = np.concatenate([[True], np.diff(reach) != 0])
        return np.concatenate([levels[:-1][starts], levels[-1:]]), reach[starts]

    def swept(self, near: float = 0.0, far: float = 0.0) -> Any:
        """What it sweeps as its axis goes about another one, ``near`` to ``far`` from it (mm), a mesh no smaller.

        About its own axis its free bore is left out.
        """
        if self.sections is not None:
            return self.sections.swept(near, far)
        import manifold3d

        levels, reach = self.profile
        outer = (far + reach) / math.cos(math.pi / _SIDES)
        inner = np.maximum(near - reach, 0.0) if far else np.full(len(reach), self.bore)
        sides = [[(float(r), float(z)) for r, *ends in zip(radii, levels, levels[1:], strict=False) for z in ends]
                 for radii in (outer, np.minimum(inner, outer))]  # fmt: skip
        return manifold3d.Manifold.revolve(manifold3d.CrossSection([[*sides[0], *reversed(sides[1])]]), _SIDES)

    @property
    def is_slabs(self) -> bool:
        """Whether it is upright slabs: no screws, chamfers or curved faces."""
        return is_slabs(self.part.blank(0.0))

    @cached_property
    def slabs(self) -> tuple[Slab, ...] | None:
        """The solid as upright slabs; None of one with screws, chamfers or curved faces."""
        import shapely

        if not self.is_slabs:
            return None
        found = []
        for low, high in pairwise(self.part.blank(0.0).levels()):
            loops = [np.asarray(points) for points in self.solid.slice((low + high) / 2).to_polygons()]
            rings = [shapely.Polygon(points) for points in loops]
            turns = [shapely.is_ccw(ring.exterior) for ring in rings]
            walls, holes = ([r for r, left in zip(rings, turns, strict=True) if left == side] for side in (True, False))
            section = shapely.difference(shapely.union_all(walls), shapely.union_all(holes))
            shapely.prepare(section)
            found.append(Slab(low, high, section))
        return tuple(found)

    @cached_property
    def bore(self) -> float:
        """Radius about the axis that is free of it, mm: by its sections, else where no triangle, seen along the axis,
        comes nearer.
        """
        if self.sections is not None:
            return float(self.sections.bands[:, 2:4].min()) * (1 - _MARGIN)
        mesh = self.solid.to_mesh()
        vertices = np.asarray(mesh.vert_properties, dtype=float)
        points = vertices[:, 0] + 1j * vertices[:, 1]
        starts = points[np.asarray(mesh.tri_verts)]
        chords = np.roll(starts, -1, axis=1) - starts
        along, across = (np.conj(chords) * -starts).real, (np.conj(chords) * -starts).imag
        share = np.clip(along / np.maximum(np.abs(chords) ** 2, 1e-300), 0.0, 1.0)
        around = np.all(across >= 0, axis=1) | np.all(across <= 0, axis=1)
        nearest = 0.0 if around.any() else float(np.abs(starts + share * chords).min())
        return nearest * (1 - _MARGIN) if nearest > _SAME else 0.0


def shape_of(part: Part) -> Shape:
    """What stands for a part, once for all that ask."""
    return made_once(part, "shape", lambda: Shape(part))


class SweptShape(Shape):
    """What a part sweeps as it turns about its own axis: round, and no smaller."""

    def __init__(self, shape: Shape) -> None:
        self.part, self.low, self.high, self.reach, self.walls = shape.part, shape.low, shape.high, shape.reach, ()
        self.solid = shape.swept()
        self.slabs = None


class LyingShape(Shape):
    """A part on an axis that is not upright, turned as it lies, its own axis at the origin; one that ``turns`` about
    its own axis is what it sweeps there.
    """

    def __init__(self, shape: Shape, instance: Instance, *, turns: bool) -> None:
        self.part, self.turns = shape.part, turns
        solid = shape.swept() if turns else shape.solid
        matrix = np.array(instance.scene_from_part.matrix())
        matrix[:, 3] = 0.0
        self.solid = solid.transform(matrix)
        self.slabs = None
        corners = np.asarray(self.solid.to_mesh().vert_properties)
        self.low, self.high = float(corners[:, 2].min()), float(corners[:, 2].max())
        self.reach = float(np.hypot(corners[:, 0], corners[:, 1]).max())
        self.walls = ((1, 0.0, self.reach),)

    @property
    def sections(self) -> None:
        """None about the upright axis."""


def _outline(body: Body | FacedBody) -> tuple[float, tuple[tuple[int, float, float], ...]]:
    """Reach of a body, mm, and its walls; one that no plane outline sweeps has none that repeats."""
    if body.is_faced and _is_round(body):
        return body.section_reach(), ()
    if body.is_faced or any(loop.shift for loop in body.loops):
        reach = body.section_reach() * (1 + _MARGIN)
        return reach, ((1, 0.0, reach),)
    alike: dict[tuple[int, float, float, object], list[complex]] = {}
    reach = 0.0
    for profile in body.profiles:
        points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 65)) for s in profile.period])
        middle, form, (near, far) = _form(profile, points)
        reach = max(reach, far * (1 + _MARGIN))
        if far - near > _SAME:
            alike.setdefault((profile.count, near * (1 - _MARGIN), far * (1 + _MARGIN), form), []).append(middle)
    found = []
    for (count, near, far, _), middles in alike.items():
        # a row of equal ones about the axis
        directions = np.sort(np.angle(middles) % _TURN)
        gaps = np.diff([*directions, directions[0] + _TURN])
        even = count == 1 and float(np.abs(gaps - _TURN / len(middles)).max()) <= _SAME
        found.append((len(middles) if even else count, near, far))
    return reach, tuple(found)


def _is_round(body: FacedBody) -> bool:
    """Whether all faces of a body are turned about its axis."""
    from geometry.solids.faces import Extrusion, Sphere, SplineSurface

    solid = body.within(_ROUGH).geometry
    for faces in solid.faces:
        if isinstance(faces.surface, Extrusion | SplineSurface):
            return False
        frame = faces.surface.frame
        if np.abs(solid.points[frame.origin, :2]).max() > _SAME:
            return False
        if not isinstance(faces.surface, Sphere) and np.abs(np.abs(frame.axis[:, 2]) - 1).max() > _SAME:
            return False
    return True


def _form(profile: Profile, points: Complex) -> tuple[complex, object, tuple[float, float]]:
    """The middle of an outline, what it has in common with those that are turned about the axis, its radii, mm."""
    arcs = [s.curve for s in profile.period if isinstance(s.curve, Arc)]
    if len(arcs) == len(profile.period) and all(abs(a.centre - arcs[0].centre) <= _SAME for a in arcs):
        centre, radius = arcs[0].centre, arcs[0].radius
        ends = round(abs(abs(centre) - radius), _DIGITS), round(abs(centre) + radius, _DIGITS)
        return centre, round(radius, _DIGITS), ends
    middle, radii = complex(points.mean()), np.abs(points)
    turned = points * (abs(middle) / middle if middle else 1.0)
    ends = round(float(radii.min()), _DIGITS), round(float(radii.max()), _DIGITS)
    return middle, tuple(np.round(turned, _DIGITS - 1).tolist()), ends


def free_between(distances: Real, shapes: tuple[Shape, Shape]) -> Real:
    """What circles about both axes leave between two solids at distances of the axes, mm; bores are asked for last."""
    one, two = shapes
    outside: Real = distances - one.reach - two.reach
    wider = (one, two) if one.reach > two.reach else (two, one)
    if outside.min() > 0 or distances.min() + wider[1].reach > wider[0].reach:
        return outside
    return np.maximum(outside, wider[0].bore - wider[1].reach - distances)

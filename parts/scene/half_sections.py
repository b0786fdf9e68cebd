"""Pairs decided by half sections: where both bodies may be, r over z, about one axis.

What is apart about a common axis is apart however either is turned there, and as far as the sections are; holes beside
the axis only take away. Where the one is whole all round and the other is somewhere there, they run into each other.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from functools import cache, cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from geometry.approximation.chords import approximate_profile
from geometry.base.record import Record, made_once, replace
from geometry.curves.curve import Complex, Indices, Real
from geometry.gears.bevel.gear import BevelGear
from geometry.gears.worms.body import WormBody
from geometry.solids.body import Body
from geometry.solids.turned import HalfSection, Hole
from parts.base.part import Part
from parts.gears.worm_wheel.part import WheelThing
from parts.scene.standing import UPWARDS, Instance

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

# what chords leave of curves, and what is touch, not overlap: less than half of what two solids may lie in each other
_CHORD, TOUCH = 1e-4, 1e-3
# what is one place, mm, and its digits
_SAME, _DIGITS = 1e-7, 7
# points along radius, height and turn by which a common volume is measured
_GRID = 48
# radii that differ by less of the largest are seen as one along the axis
_LITTLE = 0.03
# farther than anything reaches, mm
FAR = 1e6
# sides of a circle about teeth, and of one about a thread
_SIDES, _ROUND = 1024, 256


class Fit(Record):
    """What keeps two solids apart, mm, 0 where they touch; what they have in common, mm^3; ``is_least``: no less."""

    gap: float
    volume: float = 0.0
    is_least: bool = False


class _Region(Record, dict=True):
    """Where a body is about an axis, r over z: at some turn at most, and all round.

    ``exact``: at each place it is, at some turn.
    """

    some: BaseGeometry
    all_round: BaseGeometry | None
    exact: bool

    @cached_property
    def inset(self) -> BaseGeometry:
        """All but what only touches."""
        return self.some.buffer(-TOUCH, join_style="mitre")

    @cached_property
    def upwards(self) -> _Region:
        """Drawn out along the axis without end."""
        return replace(self, some=drawn_along(self.some, 1j * FAR))

    @cached_property
    def downwards(self) -> _Region:
        """The same against it."""
        return replace(self, some=drawn_along(self.some, -1j * FAR))


class Sectioned:
    """The sections of a part: half of one that is turned, else those of its layers; none of what has other faces."""

    def __init__(self, part: Part) -> None:
        self.thing, self.body, self.teeth = part.thing, part.blank(0.0), 0.0
        upright = isinstance(self.body, Body) and all(self.body.is_upright(wall) for wall in self.body.walls)
        # half a section that has all of it within, and the round holes that run through the whole
        self.half: Complex | None = None
        self.holes: tuple[Hole, ...] = ()
        if isinstance(self.thing, HalfSection):
            self.half, self.holes = self.thing.chords(_CHORD), self.thing.holes
        elif isinstance(self.thing, WormBody):
            self.half = _worm_outline(self.thing)
        elif isinstance(self.thing, BevelGear):
            self.half = _bevel_outline(self.thing)
        elif isinstance(self.thing, WheelThing):
            # its core, and all about that counts as teeth
            self.body, self.teeth, upright = self.thing.wheel.core, self.body.section_reach(), True
        self.known = self.half is not None or upright
        # by place of the axis, or by the distances at which it goes about another one
        self.at, self.going, self.swept = cache(self._at), cache(self._going), cache(self._swept)

    @cached_property
    def bands(self) -> Real:
        """Inner and outer radius at two levels: rows z0, z1, inner at both, outer at both, mm."""
        if self.half is not None:
            return _bands(self.half)
        near, far = self._radii(0j)
        return np.column_stack([self._levels, near, near, far, far])

    @cached_property
    def hull(self) -> Any | None:
        """A mesh about a worm, its thread whole; None of all else."""
        return self.swept(0.0, 0.0) if isinstance(self.thing, WormBody) else None

    def _swept(self, near: float, far: float) -> Any:
        """A mesh about all that it sweeps as its axis goes about another one, ``near`` to ``far`` from it, mm."""
        import manifold3d

        rings, _ = self._rings(near, far)
        rings[:, 1:3, 0] /= math.cos(math.pi / _ROUND)
        sides = manifold3d.CrossSection(rings.tolist(), manifold3d.FillRule.NonZero)
        return manifold3d.Manifold.revolve(sides, _ROUND)

    @cached_property
    def plan(self) -> list[tuple[float, float, BaseGeometry]]:
        """Pieces of the section between two levels, mm, as they are seen along the axis."""
        import shapely

        if self.half is None:
            return self.layers
        holes = shapely.union_all([_disk(h.radius, h.centre) for h in self.holes])
        return [
            (z0, z1, shapely.difference(_disk(outer), shapely.union(_disk(inner), holes)))
            for z0, z1, inner, outer in _steps(self.bands)
        ]

    @cached_property
    def cylinders(self) -> Real:
        """Pieces about its axis that hold it: rows z0, z1, radius, mm."""
        rows = self.bands
        return np.column_stack([rows[:, 0], rows[:, 1], rows[:, 4:].max(axis=1)])

    @cached_property
    def layers(self) -> list[tuple[float, float, BaseGeometry]]:
        """Connected pieces of the section between two levels, mm."""
        import shapely

        body, found = self.body, []
        assert isinstance(body, Body)
        for low, high in pairwise(body.levels()):
            loops: list[tuple[bool, shapely.Polygon]] = []
            for wall in body.walls:
                ends = body.height(wall)
                if ends[0] < (low + high) / 2 < ends[1]:
                    loop = body.loops[wall.lower]
                    contour = approximate_profile(body.profiles[loop.profile], _CHORD, arcs=False).geometry
                    xy = contour.expanded()[0] * np.exp(1j * loop.turn) + loop.shift
                    polygon = shapely.Polygon(np.column_stack([xy.real, xy.imag]))
                    loops.append((bool(shapely.is_ccw(polygon.exterior)), polygon))
            walls, holes = (shapely.union_all([p for left, p in loops if left == side]) for side in (True, False))
            if self.teeth and walls.area > 0:
                rim = shapely.Point(0, 0).buffer(self.teeth / math.cos(math.pi / _SIDES), quad_segs=_SIDES // 4)
                walls = shapely.union(rim, walls)
            found += [(low, high, piece) for piece in shapely.get_parts(shapely.difference(walls, holes))]
        return found

    @cached_property
    def _levels(self) -> Real:
        """Between which the layers lie, (n, 2), mm."""
        return np.array([(low, high) for low, high, _ in self.layers])

    @cached_property
    def _corners(self) -> tuple[Real, Indices]:
        """Those of all layers, one after the other, mm, and where those of each begin."""
        import shapely

        corners, layer = shapely.get_coordinates([section for _, _, section in self.layers], return_index=True)
        return corners, np.searchsorted(layer, np.arange(len(self.layers)))

    def _radii(self, at: complex) -> tuple[Real, Real]:
        """Between which each layer lies about a place, mm."""
        import shapely

        corners, first = self._corners
        near = shapely.distance(shapely.Point(at.real, at.imag), [section for _, _, section in self.layers])
        far = np.hypot(corners[:, 0] - at.real, corners[:, 1] - at.imag)
        return near, np.maximum.reduceat(far, first)

    def _at(self, at: complex) -> _Region:
        """About an upright axis in its own frame."""
        import shapely

        if self.half is not None:
            low, high = float(self.half.imag.min()) - 1, float(self.half.imag.max()) + 1
            if abs(at) > _SAME:
                # in a hole that runs through there is nothing
                free = max((h.radius - abs(h.centre - at) for h in self.holes), default=0.0)
                beside = self.going(round(abs(at), _DIGITS), round(abs(at), _DIGITS))
                if free <= 0:
                    return beside
                return _Region(shapely.difference(beside.some, shapely.box(0.0, low, free, high)), None, False)
            some = shapely.make_valid(shapely.Polygon(_pairs(self.half)))
            if not isinstance(self.thing, HalfSection) or not self.thing.is_round:
                return _Region(some, None, False)
            bored = [shapely.box(abs(h.centre) - h.radius, low, abs(h.centre) + h.radius, high) for h in self.holes]
            return _Region(some, shapely.difference(some, shapely.union_all(bored)), True)
        low, high, near, far = _joined(np.column_stack([self._levels, *self._radii(at)])).T
        return _Region(shapely.union_all(shapely.box(near, low, far, high)), None, not self.teeth)

    def _going(self, near: float, far: float) -> _Region:
        """As its own axis goes about another one, ``near`` to ``far`` from it, mm."""
        import shapely

        rings, aside = self._rings(near, far)
        exact = aside and isinstance(self.thing, HalfSection) and self.thing.is_round and not self.thing.holes
        return _Region(shapely.union_all(shapely.polygons(rings)), None, exact)

    def _rings(self, near: float, far: float) -> tuple[Real, bool]:
        """The same as rings (n, 4, 2), r and z of the corners; whether each leaves the axis as free as it was."""
        z0, z1, *radii = self.bands.T
        inner, outer = np.array(radii[:2]), np.array(radii[2:])
        beside, about = (near >= outer).all(axis=0), (far <= inner).all(axis=0)
        least = np.where(beside, near - outer, np.where(about, inner - far, 0.0))
        (a, b), (c, d) = least, outer + far
        rings = np.array([[a, z0], [c, z0], [d, z1], [b, z1]]).transpose(2, 0, 1)
        return rings, bool((beside | about).all())


def sectioned(part: Part) -> Sectioned:
    """The sections of a part, once for all that ask."""
    return made_once(part, "sectioned", lambda: Sectioned(part))


class Sections:
    """The parts of a scene by their sections."""

    def __init__(self, parts: Mapping[str, Part]) -> None:
        self.parts = parts
        self._held: dict[object, Fit | None] = {}

    def made(self, key: str) -> Sectioned:
        """The sections of one of them."""
        return sectioned(self.parts[key])

    def between(self, one: Instance, two: Instance) -> Fit | None:
        """Two instances as they stand, if sections about the axis of either tell it."""
        if max(abs(a - b) for a, b in zip(one.axis, two.axis, strict=True)) > _SAME:
            pair = (one, two) if one.axis == UPWARDS else (two, one)
            gap = self._across(*pair) if pair[0].axis == UPWARDS else 0.0
            return Fit(gap, is_least=True) if gap > 0 else None
        if (stand := _stand(one, two)) is None:
            return None
        first, second, lift = stand
        key = (one.part, two.part, first, second, round(lift, _DIGITS))
        if key not in self._held:
            self._held[key] = self._between(one.part, two.part, first, second, lift)
        return self._held[key]

    def _between(self, one: str, two: str, first: complex, second: complex, lift: float) -> Fit | None:
        """``first``: the second's axis in the frame of the first; ``second``: the other way round."""
        made = self.made(one), self.made(two)
        if not all(m.known for m in made):
            return None
        least: Fit | None = None
        for k, at in ((0, second), (1, first)):
            regions = made[k].at(0j), made[1 - k].at(at)
            raised = lift if k == 0 else -lift
            gap = _apart(regions, raised)
            if gap is not None:
                # about either axis it is at least so much
                least = Fit(gap) if least is None else Fit(max(gap, least.gap))
            elif (volume := self._common(made[1 - k], regions, at, raised)) > 0:
                return Fit(0.0, volume)
        return least

    def lets_in(self, coming: Instance, standing: Instance, way: int) -> bool:
        """Whether the one comes to its place straight along its axis (``way`` 1) or against it (-1), past the other.

        Both axes have one direction; those that lie have one line.
        """
        parts = (coming.part, standing.part)
        if not all(self.made(part).known for part in parts) or (stand := _stand(coming, standing)) is None:
            return False
        first, second, lift = stand
        for k, at in ((0, second), (1, first)):
            regions = [self.made(parts[k]).at(0j), self.made(parts[1 - k]).at(at)]
            regions[k] = regions[k].downwards if way > 0 else regions[k].upwards
            if _apart((regions[0], regions[1]), -lift if k else lift) is not None:
                return True
        return False

    def _across(self, upright: Instance, lying: Instance) -> float:
        """What keeps an upright part from one that lies across it, mm, at least: cylinders about both."""
        made = self.made(upright.part), self.made(lying.part)
        if not all(m.known for m in made):
            return 0.0
        mine, theirs = (m.cylinders for m in made)
        way, at = np.array(lying.axis), np.array(lying.at) - upright.at
        ends = [at + theirs[:, k, None] * way for k in (0, 1)]
        slope = math.hypot(way[0], way[1])
        low, high = (f(ends[0][:, 2], ends[1][:, 2]) for f in (np.minimum, np.maximum))
        steep = theirs[:, 2] * slope
        heights = np.maximum(low[:, None] - steep[:, None] - mine[:, 1], mine[:, 0] - (high + steep)[:, None])
        # how near the middle line comes to the upright axis
        start, along = ends[0][:, :2], (ends[1] - ends[0])[:, :2]
        whole = np.maximum((along**2).sum(axis=1), _SAME)
        share = np.clip(-(start * along).sum(axis=1) / whole, 0.0, 1.0)
        line = np.linalg.norm(start + share[:, None] * along, axis=1)
        return float(np.maximum(heights, (line - theirs[:, 2])[:, None] - mine[:, 2]).min())

    def pass_each_other(self, one: str, at: complex, two: str, near: float, far: float, lift: float) -> bool:
        """Whether a part stays off another one about an axis at ``at`` in the frame of the first, ``near`` to ``far``
        from which the axis of the second goes, ``lift`` above.
        """
        made = self.made(one), self.made(two)
        if not all(m.known for m in made):
            return False
        near, far = round(near, _DIGITS), round(far, _DIGITS)
        return _apart((made[0].at(_rounded(at)), made[1].going(near, far)), lift) is not None

    def _common(self, other: Sectioned, regions: tuple[_Region, _Region], at: complex, lift: float) -> float:
        """What is certainly in common, mm^3: where the first is whole all round and the other, turned, is; or 0."""
        import shapely

        one, two = regions
        if one.all_round is None or not two.exact or not isinstance(other.thing, HalfSection):
            return 0.0
        common = shapely.intersection(one.all_round.buffer(-TOUCH, join_style="mitre"), _raised(two.inset, lift))
        if common.area <= 0:
            return 0.0
        r0, z0, r1, z1 = common.bounds
        steps = (np.arange(_GRID) + 0.5) / _GRID
        r, z = (a.ravel() for a in np.meshgrid(r0 + (r1 - r0) * steps, z0 + (z1 - z0) * steps))
        kept = shapely.contains_xy(common, r, z)
        r, z = r[kept], z[kept]
        half = math.pi if abs(at) <= other.thing.radii()[1] else math.asin(other.thing.radii()[1] / abs(at))
        turns = half * (2 * steps - 1)
        places = r[:, None] * np.exp(1j * turns) - abs(at)
        own = other.at(0j).some
        within = shapely.contains_xy(own, np.abs(places).ravel(), np.repeat(z - lift, _GRID)).reshape(places.shape)
        cell = (r1 - r0) * (z1 - z0) / _GRID**2 * 2 * half / _GRID
        return float((within.sum(axis=1) * r).sum() * cell)


def _bevel_outline(gear: BevelGear) -> Complex:
    """Half a section about a bevel gear, its teeth whole up to the tips, its bore as wide as it is all round."""
    hub, bore, inside = gear.blank, gear.blank.holes.bore, 0.0
    if bore is not None:
        contour = approximate_profile(bore.profile(), _CHORD, arcs=False).geometry
        # nearest in the middle of a side
        xy = contour.expanded()[0]
        way = np.roll(xy, -1) - xy
        share = np.clip(-(xy * way.conj()).real / np.maximum(np.abs(way) ** 2, _SAME**2), 0.0, 1.0)
        inside = float(np.abs(xy + share * way).min()) - _CHORD
    rows = [gear.rim, gear.outer(gear.tip_angle), gear.inner(gear.inner_tip_angle), gear.front]
    cones = [complex(at.real, gear.mounting_distance - at.imag) for at in rows]
    back = [complex(hub.hub_diameter / 2, z) for z in (0.0, hub.hub_length)] if hub.hub_length else []
    return np.array([complex(inside, 0.0), *back, *cones, complex(inside, cones[-1].imag)])


def _steps(bands: Real) -> list[tuple[float, float, float, float]]:
    """Bands as rings about them: those beside each other whose radii differ by little are one."""
    found: list[tuple[float, float, float, float]] = []
    little = _LITTLE * float(bands[:, 2:].max())
    first: tuple[float, float] = (0.0, 0.0)
    for z0, z1, *radii in bands.tolist():
        inner, outer = min(radii[:2]), max(radii[2:])
        if found and found[-1][1] == z0 and max(abs(inner - first[0]), abs(outer - first[1])) <= little:
            low, _, least, most = found.pop()
            found.append((low, z1, min(least, inner), max(most, outer)))
        else:
            first = inner, outer
            found.append((z0, z1, inner, outer))
    return found


def _stand(one: Instance, two: Instance) -> tuple[complex, complex, float] | None:
    """Of two whose axes have one direction, each axis in the frame of the other, and how far the second is above."""
    way = [b - a for a, b in zip(one.at, two.at, strict=True)]
    lift = math.fsum(w * x for w, x in zip(way, one.axis, strict=True))
    offset = complex(way[0], way[1])
    if one.axis != UPWARDS:
        if math.dist(way, [lift * x for x in one.axis]) > _SAME:
            return None
        offset = 0j
    first, second = (_rounded(at * cmath.rect(1.0, -i.rotation)) for i, at in ((one, offset), (two, -offset)))
    return first, second, lift


def drawn_along(section: BaseGeometry, way: complex) -> BaseGeometry:
    """All that a section passes as it goes a way in its plane, mm."""
    import shapely

    moved = shapely.transform(section, lambda xy: xy + np.array([way.real, way.imag]))
    if shapely.convex_hull(section).area <= section.area * (1 + _SAME):
        return shapely.convex_hull(shapely.union(section, moved))
    pieces = shapely.get_parts(section)
    rings = [line for piece in pieces for line in (piece.exterior, *piece.interiors)]
    sides = [side for ring in rings for side in _sides_drawn(shapely.get_coordinates(ring), way)]
    return shapely.union_all([section, moved, *sides])


def _sides_drawn(points: Real, way: complex) -> Sequence[BaseGeometry]:
    """What each side of a polygon passes on a way; sides along it pass nothing."""
    import shapely

    a, b, w = points[:-1], points[1:], np.array([way.real, way.imag])
    across = (b - a)[:, 0] * w[1] - (b - a)[:, 1] * w[0]
    a, b = a[np.abs(across) > _SAME * abs(way)], b[np.abs(across) > _SAME * abs(way)]
    found: Sequence[BaseGeometry] = list(shapely.polygons(np.stack([a, b, b + w, a + w, a], axis=1)))
    return found


def _disk(radius: float, centre: complex = 0j) -> BaseGeometry:
    """A circle by chords that leave as little of it as they may."""
    import shapely

    if radius <= 0:
        return shapely.Polygon()
    count = math.ceil(math.pi / math.acos(max(1 - _CHORD / radius, 0.0)))
    points = centre + radius * np.exp(2j * math.pi * np.arange(count) / count)
    return shapely.Polygon(_pairs(points))


def _rounded(at: complex) -> complex:
    return complex(round(at.real, _DIGITS) + 0.0, round(at.imag, _DIGITS) + 0.0)


def _apart(regions: tuple[_Region, _Region], lift: float) -> float | None:
    """What keeps two regions apart, mm; None: they are deeper in each other than what touches."""
    import shapely

    one, two = regions
    gap = float(shapely.distance(one.some, _raised(two.some, lift)))
    if gap > 0:
        return gap if gap > TOUCH else 0.0
    return None if shapely.intersects(one.inset, _raised(two.inset, lift)) else 0.0


def _raised(region: BaseGeometry, lift: float) -> BaseGeometry:
    import shapely

    return shapely.transform(region, lambda rz: rz + np.array([0.0, lift])) if lift else region


def _joined(rings: Real) -> Real:
    """Rings, rows z0, z1, inner and outer radius: those of one layer that meet are one, as most pieces of it do."""
    found: list[list[float]] = []
    for z0, z1, inner, outer in sorted(rings.tolist()):
        if found and found[-1][:2] == [z0, z1] and inner <= found[-1][3]:
            found[-1][3] = max(found[-1][3], outer)
        else:
            found.append([z0, z1, inner, outer])
    return np.array(found)


def _pairs(points: Complex) -> Real:
    return np.column_stack([points.real, points.imag])


def _worm_outline(worm: WormBody) -> Complex:
    """Half a section about a worm, its thread whole up to the tips."""
    half, tip = worm.start[0], worm.thread.worm.tip_radius
    below, above = ([complex(r, z) for z, r in worm.outline(above=side)[1:]] for side in (False, True))
    ends = [complex(0.0, z) for z in worm.ends()]
    return np.array([ends[0], *below[::-1], complex(tip, -half), complex(tip, half), *above, ends[1]])


def _bands(outline: Complex) -> Real:
    """A half section cut at the levels of its corners: rows z0, z1, inner radius at both, outer at both."""
    after, rows = np.roll(outline, -1), list[tuple[float, ...]]()
    levels = np.unique(np.round(outline.imag, _DIGITS + 2))
    for z0, z1 in pairwise(levels):
        middle = (z0 + z1) / 2
        crossing = (outline.imag > middle) != (after.imag > middle)
        a, b = outline[crossing], after[crossing]
        slope = (b.real - a.real) / (b.imag - a.imag)
        ends = [a.real + slope * (z - a.imag) for z in (z0, z1)]
        order = np.argsort(ends[0] + ends[1])
        low, high = ends[0][order], ends[1][order]
        sides = np.stack([low, high])
        # a level is rounded: beyond a corner both sides would cross
        radii = [pick(sides[:, ::2], sides[:, 1::2]) for pick in (np.minimum, np.maximum)]
        rows += [(z0, z1, *at) for at in np.vstack(radii).T.tolist()]
    return np.array(rows)

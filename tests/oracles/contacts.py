"""Where upright parts told by half sections and layers touch: plane faces on each other, cylinders in each other.

Written from the tables of a scene alone. Of wheels the plane faces between bore and tips count, and their bores.
"""

from __future__ import annotations

import math
from collections import defaultdict
from collections.abc import Iterator
from functools import cached_property
from itertools import combinations, pairwise
from typing import Any, NamedTuple

import numpy as np
import shapely
import shapely.affinity

from tests.oracles.clearances import _groups, standing

_SIDES = 64


class Cylinder(NamedTuple):
    """An upright round wall about an axis: whether material lies outside of it, its ends."""

    axis: complex
    radius: float
    is_hole: bool
    low: float
    high: float


def disk(radius: float, at: complex = 0j) -> Any:
    turn = np.exp(2j * math.pi * np.arange(_SIDES) / _SIDES)
    return shapely.Polygon([(p.real, p.imag) for p in at + radius * turn])


def ring(inner: float, outer: float) -> Any:
    return disk(outer) if inner <= 0 else disk(outer).difference(disk(inner))


class Surfaces:
    """Faces of one part: by height those that look up and down, and its round walls."""

    def __init__(self, keys: Any) -> None:
        self.planes: dict[tuple[float, bool], Any] = defaultdict(shapely.Polygon)
        self.walls: list[Cylinder] = []
        self.holes = _groups(keys)
        kind = keys.__struct_config__.tag
        if kind == "turned":
            self._turned([(p.r, p.z, p.arc) for p in keys.points])
        elif kind == "layered":
            self._layered(keys.layers)
        else:
            tip = keys.module * (keys.number_of_teeth / 2 + (-1 if kind == "ring_gear" else 1))
            bore = tip if kind == "ring_gear" else keys.bore_diameter / 2
            outer = keys.outer_diameter / 2 if kind in ("ring_gear", "worm_wheel") else tip
            section = [(bore, 0.0, 0.0), (outer, 0.0, 0.0), (outer, keys.face_width, 0.0), (bore, keys.face_width, 0.0)]
            self._turned(section, wheel=True)

    def _plane(self, z: float, up: bool, region: Any) -> None:
        if region.area > 1e-9:
            self.planes[round(z, 6), up] = self.planes[round(z, 6), up].union(region)

    def _turned(self, rows: list[tuple[float, float, float]], *, wheel: bool = False) -> None:
        turn = sum(a[0] * b[1] - a[1] * b[0] for a, b in pairwise([*rows, rows[0]]))
        if turn < 0 and len(rows) > 2:
            rows = [(a[0], a[1], b[2]) for a, b in zip(rows[::-1], [*rows[-2::-1], rows[-1]], strict=True)]
        bored = shapely.union_all([disk(radius, at) for at, radius in self.holes])
        low, high = min(z for _, z, _ in rows), max(z for _, z, _ in rows)
        for (r, z, bulge), (r_next, z_next, _) in pairwise([*rows, rows[0]]):
            if bulge:
                continue
            if z == z_next:
                self._plane(z, r_next < r, ring(min(r, r_next), max(r, r_next)).difference(bored))
            elif r == r_next and r > 0 and not (wheel and r != rows[0][0]):
                self.walls.append(Cylinder(0j, r, z_next < z, min(z, z_next), max(z, z_next)))
        self.walls += [Cylinder(at, radius, True, low, high) for at, radius in self.holes]

    def _layered(self, layers: Any) -> None:
        z, regions, levels = 0.0, [], [0.0]
        for layer in layers:
            loops = [disk(c.diameter / 2, complex(*c.at)) for c in layer.circles]
            loops += [shapely.Polygon(p.points) for p in layer.polygons]
            for slot in layer.slots:
                loops.append(shapely.LineString([slot.start, slot.end]).buffer(slot.width / 2))
            # in pairs, in pairs of those and so on: hundreds of slots cost little
            while len(loops) > 1:
                last = [loops[-1]] if len(loops) % 2 else []
                loops = [a.symmetric_difference(b) for a, b in zip(loops[::2], loops[1::2], strict=False)] + last
            region = loops[0] if loops else shapely.Polygon()
            for c in layer.circles:
                at, radius = complex(*c.at), c.diameter / 2
                is_hole = not region.contains(shapely.Point(at.real + 0.99 * radius, at.imag + 1e-3))
                self.walls.append(Cylinder(at, radius, is_hole, z, z + layer.thickness))
            z += layer.thickness
            regions.append(region)
            levels.append(z)
        for height, below, above in zip(
            levels, [shapely.Polygon(), *regions], [*regions, shapely.Polygon()], strict=True
        ):
            self._plane(height, True, below.difference(above))
            self._plane(height, False, above.difference(below))


class Contacts:
    """All upright instances of a scene, where they stand."""

    def __init__(self, scene: Any) -> None:
        self.scene, self.stands = scene, standing(scene)
        self.keys = [key for key in scene.instances if abs(self.stands[key][0][2, 2]) > 1 - 1e-12]
        skip = {"worm"}
        self.keys = [
            key for key in self.keys if scene.parts[scene.instances[key].part].__struct_config__.tag not in skip
        ]
        self.own = {part: Surfaces(scene.parts[part]) for part in {scene.instances[key].part for key in self.keys}}

    def _placed(self, key: str, region: Any) -> Any:
        axes, at = self.stands[key]
        matrix = [axes[0, 0], axes[0, 1], axes[1, 0], axes[1, 1], at[0], at[1]]
        return shapely.affinity.affine_transform(region, matrix)

    @cached_property
    def planes(self) -> dict[str, set[tuple[str, bool]]]:
        """Of each instance the parts that it touches with a plane face, and whether that is its upper one."""
        faces: dict[tuple[float, bool], list[tuple[str, Any]]] = defaultdict(list)
        for key in self.keys:
            for (z, up), region in self.own[self.scene.instances[key].part].planes.items():
                faces[round(z + float(self.stands[key][1][2]), 5), up].append((key, self._placed(key, region)))
        found: dict[str, set[tuple[str, bool]]] = {key: set() for key in self.keys}
        for (z, up), lower in faces.items():
            if not up:
                continue
            for (one, a), (two, b) in ((x, y) for x in lower for y in faces.get((z, False), ())):
                if one != two and a.intersection(b).area > 0.5:
                    found[one].add((self.scene.instances[two].part, True))
                    found[two].add((self.scene.instances[one].part, False))
        return found

    def _walls(self) -> Iterator[tuple[str, Cylinder]]:
        for key in self.keys:
            axes, at = self.stands[key]
            for wall in self.own[self.scene.instances[key].part].walls:
                axis = axes @ np.array([wall.axis.real, wall.axis.imag, 0.0]) + at
                place = complex(round(float(axis[0]), 4) + 0.0, round(float(axis[1]), 4) + 0.0)
                yield key, Cylinder(place, wall.radius, wall.is_hole, wall.low + at[2], wall.high + at[2])

    @cached_property
    def fits(self) -> dict[tuple[str, str], set[float]]:
        """By part in the hole and part about it: how much wider, mm of radius, where it is less than 2 mm."""
        axes: dict[complex, list[tuple[str, Cylinder]]] = defaultdict(list)
        for key, wall in self._walls():
            axes[wall.axis].append((key, wall))
        found: dict[tuple[str, str], set[float]] = defaultdict(set)
        for walls in axes.values():
            for (one, a), (two, b) in combinations(walls, 2):
                if one == two or a.is_hole is b.is_hole or min(a.high, b.high) - max(a.low, b.low) < 0.2:
                    continue
                (inner, pin), (outer, hole) = ((one, a), (two, b)) if b.is_hole else ((two, b), (one, a))
                play = hole.radius - pin.radius
                if -1.0 < play < 2.0:
                    parts = self.scene.instances[inner].part, self.scene.instances[outer].part
                    found[parts].add(round(play, 6) + 0.0)
        return found

    def gap(self, lower: str, upper: str) -> float:
        """The least distance from a face of a part up to one of another that stands over it, mm; inf: none does."""
        low, high = ([key for key in self.keys if self.scene.instances[key].part == part] for part in (lower, upper))
        best = math.inf
        for one, two in ((one, two) for one in low for two in high if one != two):
            for (z, up), a in self.own[lower].planes.items():
                for (top, over), b in self.own[upper].planes.items():
                    away = top + self.stands[two][1][2] - z - self.stands[one][1][2]
                    if (
                        up
                        and not over
                        and -1e-6 < away < best
                        and self._placed(one, a).intersection(self._placed(two, b)).area > 0.5
                    ):
                        best = away
        return float(best)

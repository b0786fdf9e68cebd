"""Do parts told by half sections and layers run into each other? Points just within the one, sought in the other.

Written from the tables of a scene alone: no solids, no kernel, none of the rules that have sized them. Wheels count
with all that lies between bore and tips, worms as cylinders.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Set
from typing import Any

import numpy as np

# how deep points lie: above what chords leave of arcs, mm
EPS = 2e-3
# a contour: a polygon, or centre and radius of a circle
Loop = np.ndarray | tuple[complex, float]


def arc(start: complex, end: complex, radius: float) -> np.ndarray:
    """From one point to another, without the last; ``radius`` above 0 bulges to the right of the way."""
    if not radius:
        return start + (end - start) * np.linspace(0, 1, 9)[:-1]
    way = end - start
    centre = (start + end) / 2 + 1j * math.copysign(1, radius) * way / abs(way) * math.sqrt(
        max(radius**2 - abs(way) ** 2 / 4, 0.0)
    )
    sweep = np.angle((end - centre) / (start - centre))
    sweep = sweep % (2 * math.pi) if radius > 0 else sweep % (2 * math.pi) - 2 * math.pi
    # chords leave 5e-4 mm of it at most
    count = max(128, math.ceil(abs(sweep) * math.sqrt(abs(radius) / 4e-3)))
    return centre + (start - centre) * np.exp(1j * sweep * np.linspace(0, 1, count + 1)[:-1])


def inside(points: np.ndarray, loop: Loop) -> np.ndarray:
    """Even and odd crossings of a ray to the right."""
    if isinstance(loop, tuple):
        return np.asarray(np.abs(points - loop[0]) < loop[1])
    found = np.zeros(len(points), bool)
    x, y = points.real, points.imag
    beside = (y > loop.imag.min()) & (y < loop.imag.max()) & (x > loop.real.min()) & (x < loop.real.max())
    # which of them, from below, each chord has on its height
    near = np.flatnonzero(beside)
    near = near[np.argsort(y[near])]
    a, b = loop, np.roll(loop, -1)
    first, last = (np.searchsorted(y[near], at) for at in (np.minimum(a.imag, b.imag), np.maximum(a.imag, b.imag)))
    chord = np.repeat(np.arange(len(loop)), last - first)
    rank = np.arange(len(chord)) - np.repeat(np.cumsum(last - first) - last, last - first)
    a, b, p = a[chord], b[chord], points[near[rank]]
    crossed = p.real < a.real + (p.imag - a.imag) * (b.real - a.real) / (b.imag - a.imag)
    found[near] = np.bincount(rank[crossed], minlength=len(near)) % 2 == 1
    return found


def odd(points: np.ndarray, loops: list[Loop]) -> np.ndarray:
    """Which points an odd number of loops surrounds."""
    circles = np.array([loop for loop in loops if isinstance(loop, tuple)]).reshape(-1, 2)
    found = (np.abs(points[:, None] - circles[:, 0]) < circles[:, 1].real).sum(axis=1)
    return (found + sum(inside(points, loop) for loop in loops if not isinstance(loop, tuple))) % 2 == 1


def within(loop: Loop, left: bool = True) -> np.ndarray:
    """Points beside the middles of a loop's chords, EPS to the left, or to the right."""
    if isinstance(loop, tuple):
        return np.asarray(loop[0] + (loop[1] - (EPS if left else -EPS)) * np.exp(2j * math.pi * np.arange(24) / 24))
    after = np.roll(loop, -1)
    way = after - loop
    way, middle = way[np.abs(way) > 1e-9], ((loop + after) / 2)[np.abs(way) > 1e-9]
    return np.asarray(middle + (1j if left else -1j) * EPS * way / np.abs(way))


class Solid:
    """A body that tells points just within its surface, and which points lie in it."""

    def __init__(
        self,
        section: np.ndarray | None,
        layers: list[tuple[float, float, list[Loop]]],
        holes: list[tuple[complex, float]],
    ) -> None:
        self.section, self.layers, self.holes = section, layers, holes
        if section is not None and ((np.conj(section) * np.roll(section, -1)).imag.sum() < 0):
            self.section = section[::-1]
        self.points = np.concatenate([*self._points()])
        self.reach = float(np.hypot(self.points[:, 0], self.points[:, 1]).max()) + 2 * EPS
        self.low, self.high = float(self.points[:, 2].min()) - 2 * EPS, float(self.points[:, 2].max()) + 2 * EPS

    def _points(self) -> Iterator[np.ndarray]:
        if self.section is not None:
            half = within(self.section)
            half = half[half.real > EPS][:: 1 + len(half) // 120]
            turn = np.exp(2j * math.pi * (np.arange(24) + 0.137) / 24)
            flat = (half.real[:, None] * turn).ravel()
            kept = ~np.any([np.abs(flat - at) < radius + EPS for at, radius in self.holes or [(0j, -1.0)]], axis=0)
            yield np.column_stack([flat.real, flat.imag, np.repeat(half.imag, 24)])[kept]
            for at, radius in self.holes:
                wall = at + (radius + EPS) * turn
                for z in np.quantile(half.imag, np.linspace(0, 1, 5)):
                    kept = inside(np.abs(wall) + 1j * z, self.section)
                    yield np.column_stack([wall.real, wall.imag, np.full(24, z)])[kept]
        for low, high, loops in self.layers:
            edges = [within(loop, left) for loop in loops for left in (True, False)]
            edge = np.concatenate([points[:: 1 + len(points) // 240] for points in edges])
            kept = edge[odd(edge, loops)]
            for z in (low + EPS, (low + high) / 2, high - EPS):
                yield np.column_stack([kept.real, kept.imag, np.full(len(kept), z)])

    def holds(self, points: np.ndarray) -> np.ndarray:
        """Which points lie in it, EPS / 2 or deeper off its plane faces."""
        flat = points[:, 0] + 1j * points[:, 1]
        if self.section is not None:
            found = inside(np.abs(flat) + 1j * points[:, 2], self.section)
        else:
            found = np.zeros(len(points), bool)
            for low, high, loops in self.layers:
                at = (points[:, 2] > low) & (points[:, 2] < high)
                if at.any():
                    found[at] = odd(flat[at], loops)
        for hole in self.holes:
            found &= ~inside(flat, hole)
        return found


def _groups(keys: Any) -> list[tuple[complex, float]]:
    tables = getattr(keys, "holes", None)
    tables = tables if isinstance(tables, list) else [tables] if tables else []
    return [
        (
            complex(t.pitch_circle_diameter / 2 * np.exp(1j * math.radians(t.start_deg + 360 * k / t.count))),
            t.diameter / 2,
        )
        for t in tables
        for k in range(t.count)
    ]


def _tube(inner: float, outer: float, height: float) -> np.ndarray:
    corners = [complex(inner, 0), complex(outer, 0), complex(outer, height), complex(inner, height)]
    return chain(corners)


def chain(corners: list[complex]) -> np.ndarray:
    """Lines from corner to corner, and back to the first."""
    return np.concatenate([arc(a, b, 0.0) for a, b in zip(corners, [*corners[1:], corners[0]], strict=True)])


def solid_of(keys: Any) -> Solid:
    """The body of a part of the module."""
    kind = keys.__struct_config__.tag
    if kind == "turned":
        rows = [(complex(p.r, p.z), p.arc) for p in keys.points]
        order = sum((a[0].conjugate() * b[0]).imag for a, b in zip(rows, [*rows[1:], rows[0]], strict=True))
        ends = zip(rows, [*rows[1:], rows[0]], strict=True)
        # an arc bulges out of the material: to the right where the points run counter-clockwise
        sign = 1 if order > 0 or len(rows) == 2 else -1
        return Solid(np.concatenate([arc(a[0], b[0], sign * a[1]) for a, b in ends]), [], _groups(keys))
    if kind == "layered":
        z, layers = 0.0, []
        for layer in keys.layers:
            loops: list[Loop] = [(complex(*c.at), c.diameter / 2) for c in layer.circles]
            for polygon in layer.polygons:
                loops.append(chain([complex(*p) for p in polygon.points]))
            for outline in layer.outlines:
                rows = [(complex(p.x, p.y), p.arc) for p in outline.points]
                ends = list(zip(rows, [*rows[1:], rows[0]], strict=True))
                sign = 1 if sum((a[0].conjugate() * b[0]).imag for a, b in ends) > 0 else -1
                loops.append(np.concatenate([arc(a[0], b[0], sign * a[1]) for a, b in ends]))
            # of many alike those beside the members that are looked at
            for slot in layer.slots[:14]:
                start, end = complex(*slot.start), complex(*slot.end)
                side = 1j * slot.width / 2 * (end - start) / abs(end - start)
                turn = np.exp(1j * math.pi * np.linspace(0, 1, 9))
                loops.append(np.concatenate([end - side * turn, start + side * turn]))
            layers.append((z, z + layer.thickness, loops))
            z += layer.thickness
        return Solid(None, layers, [])
    if kind == "worm":
        tip, half = keys.module * (keys.diameter_quotient / 2 + 1), keys.thread_length / 2
        z, corners = half, [complex(tip, -half), complex(tip, half)]
        for step in keys.shaft_above:
            corners += [complex(step.diameter / 2, z), complex(step.diameter / 2, z + step.length)]
            z += step.length
        below = [complex(0.0, -half), complex(keys.shaft_below[0].diameter / 2, -half)]
        below[0:1] = [complex(0, -half - keys.shaft_below[0].length)]
        foot = complex(keys.shaft_below[0].diameter / 2, -half - keys.shaft_below[0].length)
        corners = [below[0], foot, below[1], *corners, complex(0.0, z)]
        return Solid(chain(corners), [], [])
    tip = keys.module * (keys.number_of_teeth / 2 + (-1 if kind == "ring_gear" else 1))
    bore = tip if kind == "ring_gear" else keys.bore_diameter / 2
    outer = keys.outer_diameter / 2 if kind in ("ring_gear", "worm_wheel") else tip
    if kind == "worm_wheel":
        # the worm lies in its throat
        z = np.linspace(0, keys.face_width, 65)
        throat = keys.module * (keys.diameter_quotient / 2 - 1)
        deep = np.sqrt(np.maximum(throat**2 - (z - keys.face_width / 2) ** 2, 0.0))
        r = np.minimum(outer, keys.module * (keys.number_of_teeth + keys.diameter_quotient) / 2 - deep)
        return Solid(
            np.concatenate([[complex(bore, keys.face_width), complex(bore, 0)], r + 1j * z]), [], _groups(keys)
        )
    return Solid(_tube(bore, outer, keys.face_width), [], _groups(keys))


def standing(scene: Any, turns: Mapping[str, float] | None = None) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Where every instance stands as the tables say: axes as columns, place; ``turns``: about their own axes, radians.

    What is fixed or parallel to another is turned with it, what is carried by it only goes along.
    """
    upright = np.eye(3)
    found: dict[str, tuple[np.ndarray, np.ndarray]] = {}
    for key, spec in scene.instances.items():
        if spec.at is not None:
            axes = upright
            if spec.axis is not None:
                z = np.array(spec.axis)
                axes = np.column_stack([[0.0, 0.0, -z[0]], np.cross(z, [0.0, 0.0, -z[0]]), z])
            found[key] = axes, np.array(spec.at)
    for mate in scene.mates:
        if mate.second in found:
            continue
        axes, at = found[mate.first]
        kind = mate.__struct_config__.tag
        if kind == "worm_pair":
            wheel, worm = (scene.parts[scene.instances[key].part] for key in (mate.first, mate.second))
            far = worm.module * (wheel.number_of_teeth + worm.diameter_quotient) / 2
            side = 1.0 if mate.direction_deg > 0 else -1.0
            z = np.array([side, 0.0, 0.0])
            axes = np.column_stack([[0.0, 0.0, -side], np.cross(z, [0.0, 0.0, -side]), z])
            found[mate.second] = axes, at + np.array([0.0, side * far, wheel.face_width / 2])
        elif kind == "external_gear_pair":
            wheels = [scene.parts[scene.instances[key].part] for key in (mate.first, mate.second)]
            far = wheels[0].module * sum(w.number_of_teeth for w in wheels) / 2
            way = math.radians(mate.direction_deg)
            # along the arm of what carries it
            carrier = next(found[m.first][0] for m in scene.mates
                           if m.second == mate.second and m.__struct_config__.tag == "carried")  # fmt: skip
            found[mate.second] = upright, at + carrier @ np.array([far * math.cos(way), far * math.sin(way), 0.0])
        elif kind in ("fixed", "parallel"):
            found[mate.second] = axes, at + (axes if kind == "fixed" else upright) @ np.array(mate.offset)
        else:
            turn = (turns or {}).get(mate.second, 0.0)
            own = np.array([[math.cos(turn), -math.sin(turn), 0], [math.sin(turn), math.cos(turn), 0], [0, 0, 1.0]])
            offset = [0.0, 0.0, mate.height] if kind == "coaxial" else mate.offset
            found[mate.second] = own, at + axes @ np.array(offset)
    return found


def overlaps(
    scene: Any, turns: Mapping[str, float] | None = None, parts: Set[str] | None = None
) -> dict[tuple[str, str], int]:
    """Pairs that run into each other, and by how many points; of a group's members some stand for all of them.

    ``parts``: one of each pair is of these.
    """
    meshed = {frozenset((m.first, m.second)) for m in scene.mates if m.__struct_config__.tag.endswith("pair")}
    stands, solids = standing(scene, turns), {key: solid_of(spec) for key, spec in scene.parts.items()}
    seen: dict[tuple[str, float], int] = {}
    chosen = []
    for key, spec in scene.instances.items():
        row = (spec.part, round(float(stands[key][1][2]), 6))
        seen[row] = seen.get(row, 0) + 1
        if seen[row] in (1, 2, 6):
            chosen.append(key)
    found = {}
    for one in chosen:
        mine = solids[scene.instances[one].part]
        axes, at = stands[one]
        points = mine.points @ axes.T + at
        middle = (mine.low + mine.high) / 2
        centre, far = at + axes[:, 2] * middle, math.hypot(mine.reach, mine.high - middle)
        for two in chosen:
            other = solids[scene.instances[two].part]
            if parts is not None and not parts & {scene.instances[one].part, scene.instances[two].part}:
                continue
            theirs, there = stands[two]
            local = (centre - there) @ theirs
            if one == two or frozenset((one, two)) in meshed or np.hypot(local[0], local[1]) > far + other.reach:
                continue
            if local[2] > other.high + far or local[2] < other.low - far:
                continue
            p = (points - there) @ theirs
            p = p[(p[:, 2] > other.low) & (p[:, 2] < other.high)]
            p = p[np.hypot(p[:, 0], p[:, 1]) < other.reach]
            if len(p) and (count := int(other.holds(p).sum())):
                found[one, two] = count
    return found

"""Measuring files from outside: an outline, arc formulas and readers that share no code with the product.

The outline comes from the common normal alone: a point of the rack cuts where its normal passes through the
pitch point (Willis). It is sampled so densely that straight pieces between samples are exact to about 1e-7 mm.
An outline moved by a kerf is not computed at all: its points must lie at that distance from the unmoved one.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import shapely
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Points = NDArray[np.complex128]

SAMPLES = 6000
_COARSE = 30


@dataclass(frozen=True)
class Gear:
    """Numbers of a gear as a user would state them; lengths in mm, coefficients in modules."""

    module: float
    teeth: int
    shift: float = 0.0
    angle_deg: float = 20.0
    addendum: float = 1.0
    clearance: float = 0.25
    tip_rounding: float = 0.38
    tip_diameter: float | None = None
    bore: float = 0.0
    thinning: float = 0.0
    relief_depth: float = 0.0
    relief_height: float = 0.45

    @property
    def radius(self) -> float:
        """Rolling radius."""
        return self.module * self.teeth / 2

    @property
    def tip_radius(self) -> float:
        """Half of the tip diameter."""
        if self.tip_diameter is not None:
            return self.tip_diameter / 2
        return self.radius + (self.addendum + self.shift) * self.module

    @property
    def root_radius(self) -> float:
        """The rack's tip line at its deepest."""
        return self.radius + (self.shift - self.addendum - self.clearance) * self.module


def _cut(gear: Gear, places: Points, normals: Points) -> Points:
    """Gear points that rack points (fixed frame, rack tooth about polar angle 0) make with their normals."""
    roll = np.imag(np.conj(normals) * (gear.radius - places)) / np.real(normals)
    return (places + 1j * roll) * np.exp(-1j * roll / gear.radius)


def _flank(gear: Gear, angle: float, start: float, low: float) -> Points:
    """What a straight rack flank makes that leaves the main flank at height ``start``; from height ``low`` up."""
    m, alpha = gear.module, math.radians(gear.angle_deg)
    high = (gear.tip_radius - gear.radius - gear.shift * m) + 2 * m
    y = np.linspace(low, high, SAMPLES)
    half = (math.pi * m / 2 + gear.thinning) / 2 + start * math.tan(alpha) + (y - start) * math.tan(angle)
    return _cut(gear, gear.radius + gear.shift * m + y + 1j * half, np.full(SAMPLES, -1j * np.exp(1j * angle)))


def _fillet(gear: Gear) -> Points:
    """What the rounding of the rack's tip makes."""
    m, alpha, rho = gear.module, math.radians(gear.angle_deg), gear.tip_rounding * gear.module
    height = rho - (gear.addendum + gear.clearance) * m
    half = (math.pi * m / 2 + gear.thinning) / 2 + height * math.tan(alpha) - rho / math.cos(alpha)
    normals = np.exp(-1j * np.linspace(0, math.pi / 2 - alpha, SAMPLES))
    return _cut(gear, gear.radius + gear.shift * m + height + 1j * half - rho * normals, normals)


@lru_cache(maxsize=64)
def half_tooth(gear: Gear) -> dict[str, Points]:
    """The upper side of tooth 1 by name of piece, from the root's centre to the tip's; polar angles pi/z to 0.

    The rack tooth at angle pi/z leaves its lower side there; where two curves stand at one radius, the one that
    takes more of the tooth away is the outline: that is undercut, and relief, without a formula for either.
    """
    alpha, m = math.radians(gear.angle_deg), gear.module
    rho, deep = gear.tip_rounding, gear.addendum + gear.clearance
    curves = {"fillet": _fillet(gear), "flank": _flank(gear, alpha, 0.0, (rho * (1 - math.sin(alpha)) - deep) * m)}
    if gear.relief_depth:
        start = (gear.addendum - gear.relief_height) * m
        angle = alpha + math.atan(gear.relief_depth * math.cos(alpha) / gear.relief_height)
        curves["relief"] = _flank(gear, angle, start, start - 0.2 * m)
    sides: dict[str, tuple[Floats, Floats]] = {}
    for name, points in curves.items():
        upper = np.conj(points) * np.exp(1j * math.pi / gear.teeth)
        first = int(np.argmin(np.abs(upper)))
        sides[name] = np.abs(upper[first:]), np.angle(upper[first:])
    kept = {name: _least(sides, name, gear.tip_radius) for name in sides}
    tip_angle = float(np.angle(list(kept.values())[-1][-1]))
    land_end = float(np.angle(kept["fillet"][0]))
    root = gear.root_radius * np.exp(1j * np.linspace(math.pi / gear.teeth, land_end, SAMPLES))
    return {"root": root, **kept, "tip": gear.tip_radius * np.exp(1j * np.linspace(tip_angle, 0, SAMPLES))}


def _least(sides: dict[str, tuple[Floats, Floats]], name: str, tip: float) -> Points:
    """The part of one curve that is the outline, its ends interpolated where another curve takes over."""
    radius, angle = sides[name]
    spare = np.full(radius.shape, np.inf)
    for other, (rho, phi) in sides.items():
        if other != name:
            least = np.interp(radius, rho, phi, left=math.inf, right=math.inf)
            gap = least - angle
            # both are tangent where the rounding ends: what is level within rounding belongs to the first
            spare = np.minimum(spare, np.where(np.abs(gap) < 1e-12, 1e-12, gap))
    spare = np.minimum(spare, tip - radius)
    inside = np.flatnonzero(spare >= 0)
    low, high = int(inside[0]), int(inside[-1])
    points = radius * np.exp(1j * angle)
    return np.concatenate([_crossed(points, spare, low, -1), points[low : high + 1], _crossed(points, spare, high, 1)])


def _crossed(points: Points, spare: Floats, at: int, step: int) -> Points:
    """The point between a kept sample and its neighbour at which the curve is given up."""
    beyond = at + step
    if not 0 <= beyond < len(points) or not np.isfinite(spare[[at, beyond]]).all():
        return points[:0]
    share = spare[at] / (spare[at] - spare[beyond])
    return points[at : at + 1] + share * (points[beyond] - points[at])


def folded(points: Points, gear: Gear) -> Points:
    """Points brought to the upper half of tooth 1."""
    pitch = 2 * math.pi / gear.teeth
    angle = np.angle(points)
    return np.abs(points) * np.exp(1j * np.abs(angle - pitch * np.round(angle / pitch)))


def distances(points: Points, gear: Gear) -> tuple[Floats, list[str], NDArray[np.int64]]:
    """Signed distance (outside the metal positive) from the toothed outline, piece names, nearest piece."""
    near = folded(points, gear)
    pieces = half_tooth(gear)
    table = np.array([_to_chain(near, chain) for chain in pieces.values()])
    metal = np.concatenate([[0j], *pieces.values()])
    polygon = shapely.Polygon(np.stack([metal.real, metal.imag], axis=1))
    shapely.prepare(polygon)
    # a point on the sector's own borders is neither inside nor outside of it
    asked = np.abs(near) * np.exp(1j * np.clip(np.angle(near), 1e-9, math.pi / gear.teeth - 1e-9))
    inside = shapely.contains_xy(polygon, asked.real, asked.imag)
    return np.where(inside, -1, 1) * table.min(axis=0), list(pieces), table.argmin(axis=0)


def _to_chain(points: Points, chain: Points) -> Floats:
    """Distance of points (n,) from a chain of straight pieces: near a coarse sample, then on every piece there."""
    if len(chain) < 2:
        return np.full(points.shape, np.inf)
    places = np.unique(np.append(np.arange(0, len(chain), _COARSE), len(chain) - 1))
    best = np.empty(points.shape)
    window = np.arange(-_COARSE - 1, _COARSE + 2)
    for block in np.array_split(np.arange(len(points)), max(1, len(points) // 4000)):
        near = places[np.argmin(np.abs(points[block, None] - chain[places]), axis=1)]
        index = np.clip(near[:, None] + window, 0, len(chain) - 2)
        best[block] = _to_pieces(points[block, None], chain[index], chain[index + 1]).min(axis=1)
    return best


def _to_pieces(points: Points, starts: Points, ends: Points) -> Floats:
    along = ends - starts
    square = np.maximum(np.abs(along) ** 2, 1e-300)
    share = np.clip(np.real(np.conj(along) * (points - starts)) / square, 0, 1)
    return np.abs(points - starts - share * along)


@lru_cache(maxsize=64)
def points_at(gear: Gear, distance: float, step: int = 60) -> Points:
    """Points of the outline moved outwards by ``distance`` that no other part of the gear cuts off (upper half)."""
    found = []
    for chain in half_tooth(gear).values():
        if len(chain) > 2 * step:
            normal = 1j * (chain[2:] - chain[:-2])
            moved = chain[1:-1] + distance * normal / np.abs(normal)
            found.append(moved[::step])
    moved = np.concatenate(found)
    off, _, _ = distances(moved, gear)
    ahead = np.abs(np.angle(moved)) <= math.pi / gear.teeth
    return moved[(np.abs(off - distance) < 1e-6) & ahead]


@dataclass(frozen=True)
class Chain:
    """A closed chain found in a file: vertices (n,), the signed sweep of each edge (0: straight), its layer."""

    vertices: Points
    sweeps: Floats
    layer: str

    def edges(self) -> tuple[Points, Points]:
        """Start and end of every edge."""
        return self.vertices, np.roll(self.vertices, -1)

    def dense(self, count: int = 24) -> Points:
        """Points (n, count) of every edge, by centre and radius; its start included, its end not."""
        starts, ends = self.edges()
        share = np.arange(count) / count
        straight = starts[:, None] + (ends - starts)[:, None] * share
        bent = self.sweeps != 0
        if not bent.any():
            return straight
        sweep, a, b = self.sweeps[bent], starts[bent], ends[bent]
        # the centre lies on the bisector of the chord, left of it for a left turn of less than half
        centre = (a + b) / 2 + 1j * (b - a) / 2 / np.tan(sweep / 2)
        straight[bent] = centre[:, None] + (a - centre)[:, None] * np.exp(1j * sweep[:, None] * share)
        return straight

    def area(self) -> float:
        """Signed area: the polygon and a circular segment on every bent edge."""
        a, b = self.edges()
        with np.errstate(divide="ignore", invalid="ignore"):
            radius = np.abs(b - a) / 2 / np.sin(np.abs(self.sweeps) / 2)
            caps = np.where(self.sweeps == 0, 0, radius**2 / 2 * (self.sweeps - np.sin(self.sweeps)))
        return float(0.5 * np.sum(np.imag(np.conj(a) * b)) + caps.sum())


def deviations(chains: list[Chain], gear: Gear, offset: float) -> dict[str, float]:
    """Greatest deviation by piece: file to outline, and under "missed" the outline's points from the file.

    ``chains``: bore first where there is one.
    """
    worst: dict[str, float] = {}
    outer = chains[-1]
    if len(chains) > 1:
        ring = chains[0].dense().ravel()
        worst["bore"] = float(np.abs(np.abs(ring) - (gear.bore / 2 - offset)).max())
    points = outer.dense(12 if len(outer.vertices) < 1000 else 5).ravel()
    off, names, piece = distances(points, gear)
    for index, name in enumerate(names):
        mine = piece == index
        if mine.any():
            worst[name] = float(np.abs(off[mine] - offset).max())
    asked = points_at(gear, offset)
    turns = np.exp(2j * math.pi * np.arange(gear.teeth) / gear.teeth)
    chosen = turns[[0, gear.teeth // 3, gear.teeth // 2, gear.teeth - 1]]
    for turn in chosen:
        off = _to_file(np.concatenate([asked, np.conj(asked)]) * turn, outer)
        worst["missed"] = max(worst.get("missed", 0.0), float(off.max()))
    return worst


def _to_file(points: Points, chain: Chain) -> Floats:
    """Distance of points that lie close together from a file's lines and arcs, by centre and radius."""
    starts, ends = chain.edges()
    middle = points.mean()
    reach, long = np.abs(points - middle).max(), np.abs(ends - starts).max()
    near = np.abs(starts - middle) < 1.5 * reach + 2 * long
    a, b, sweep, p = starts[near], ends[near], chain.sweeps[near], points[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        centre = (a + b) / 2 + 1j * (b - a) / 2 / np.tan(sweep / 2)
        turned = np.angle((p - centre) / (a - centre)) * np.sign(sweep) % (2 * math.pi)
        round_off = np.where(turned <= np.abs(sweep), np.abs(np.abs(p - centre) - np.abs(a - centre)), np.inf)
    round_off = np.minimum(round_off, np.minimum(np.abs(p - a), np.abs(p - b)))
    return np.where(sweep == 0, _to_pieces(p, a, b), round_off).min(axis=1)

"""Slow and simple measuring, written apart from the product: dense points, golden section, elementary arcs."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from geometry.base.errors import GeometryError, ParameterError
from geometry.curves.curve import Curve
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Profile
from tests.oracles.exact_gear import GearParameters
from tests.oracles.rack_sweep import RackTool

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]
_GOLDEN, _GOLDEN_STEPS = (math.sqrt(5) - 1) / 2, 58


def works(refused: object) -> Any:
    """The value that a refusal says works."""
    assert isinstance(refused, ParameterError)
    assert refused.nearest is not None, refused
    return refused.nearest.value


def refusal(build: Callable[[], object]) -> GeometryError | None:
    """The GeometryError with which something is refused, or None where it is built."""
    try:
        build()
    except GeometryError as error:
        return error
    return None


def dense(curve: Curve, count: int = 400) -> Complex:
    """Points of a curve, ends included."""
    return np.asarray(curve.point(np.linspace(*curve.domain, count)))


def period_points(profile: Profile, count: int = 400) -> Complex:
    """Dense points of the first period, segment after segment."""
    return np.concatenate([dense(s.curve, count) for s in profile.period])


def polygon(profile: Profile, count: int, periods: int | None = None) -> Complex:
    """Vertices of the whole outline (or its first periods), without the end point of each segment."""
    one = np.concatenate([dense(s.curve, count + 1)[:-1] for s in profile.period])
    turns = np.exp(2j * math.pi / profile.count * np.arange(periods or profile.count))
    return (turns[:, None] * one).ravel()


def distance_to_curve(points: Complex, curve: Curve, samples: int = 400) -> Real:
    """Least distance by nearest sample and golden section beside it."""
    coarse, nearest = _nearest(points, dense(curve, samples))
    return _refined(points, curve, samples, coarse, nearest)


def _nearest(points: Complex, samples: Complex) -> tuple[Real, NDArray[np.intp]]:
    """Distance of each point from its nearest sample, and the sample's index."""
    nearest = [np.argmin(np.abs(points[i : i + 2000, None] - samples), axis=1) for i in range(0, len(points), 2000)]
    index = np.concatenate(nearest)
    return np.abs(points - samples[index]), index


def _refined(points: Complex, curve: Curve, samples: int, best: Real, nearest: NDArray[np.intp]) -> Real:
    """The golden section between the neighbours of the nearest sample: one new place a step."""
    t = np.linspace(*curve.domain, samples)
    low, high = t[np.maximum(nearest - 1, 0)], t[np.minimum(nearest + 1, samples - 1)]
    a, b = high - _GOLDEN * (high - low), low + _GOLDEN * (high - low)
    da, db = np.abs(curve.point(a) - points), np.abs(curve.point(b) - points)
    best = np.minimum(best, np.minimum(da, db))
    for _ in range(_GOLDEN_STEPS):
        left = da <= db
        low, high = np.where(left, low, a), np.where(left, b, high)
        new = np.where(left, high - _GOLDEN * (high - low), low + _GOLDEN * (high - low))
        there = np.abs(curve.point(new) - points)
        a, b = np.where(left, new, b), np.where(left, a, new)
        da, db = np.where(left, there, db), np.where(left, da, there)
        best = np.minimum(best, there)
    return best


def distance_to_outline(points: Complex, profile: Profile, samples: int = 200) -> Real:
    """Least distance to any segment of any period within one pitch of the point.

    A segment is searched only for the points that it may be nearest to: its nearest sample less the widest gap
    between samples is no farther than the nearest sample of all.
    """
    pitch = 2 * math.pi / profile.count
    middle = np.angle(np.mean(period_points(profile, 9))) if profile.count > 1 else 0.0
    folded = points * np.exp(-1j * pitch * np.round((np.angle(points) - middle) / pitch))
    best = np.full(points.shape, np.inf)
    found = []
    for segment in profile.period:
        on_curve = dense(segment.curve, samples)
        gap = float(np.abs(np.diff(on_curve)).max())
        for shift in range(profile.count) if profile.count <= 3 else (-1, 0, 1):
            turned = folded * np.exp(-1j * pitch * shift)
            coarse, nearest = _nearest(turned, on_curve)
            found.append((segment.curve, turned, gap, coarse, nearest))
            best = np.minimum(best, coarse)
    result = best.copy()
    for curve, turned, gap, coarse, nearest in found:
        mine = np.flatnonzero(coarse - gap <= best)
        if mine.size:
            refined = _refined(turned[mine], curve, samples, coarse[mine], nearest[mine])
            result[mine] = np.minimum(result[mine], refined)
    return result


def arc_points(start: complex, end: complex, bulge: float, count: int) -> Complex:
    """Points of one edge by the angle about its centre."""
    share = np.linspace(0, 1, count)
    if bulge == 0:
        return start + share * (end - start)
    sweep = 4 * math.atan(bulge)
    centre = (start + end) / 2 + 1j * (end - start) / (2 * math.tan(sweep / 2))
    return centre + (start - centre) * np.exp(1j * sweep * share)


def distance_to_edge(points: Complex, start: complex, end: complex, bulge: float) -> Real:
    """Distance to one line or arc."""
    ends = np.minimum(np.abs(points - start), np.abs(points - end))
    if bulge == 0:
        along = ((points - start) * np.conj(end - start)).real / abs(end - start) ** 2
        across = np.abs(((points - start) * np.conj(end - start)).imag) / abs(end - start)
        return np.where((along > 0) & (along < 1), across, ends)
    sweep = 4 * math.atan(bulge)
    centre = (start + end) / 2 + 1j * (end - start) / (2 * math.tan(sweep / 2))
    middle = (start + end) / 2 - 1j * (end - start) / 2 * bulge
    inside = np.abs(np.angle((points - centre) / (middle - centre))) <= abs(sweep) / 2
    return np.where(inside, np.abs(np.abs(points - centre) - abs(start - centre)), ends)


def distance_to_contour(points: Complex, vertices: Complex, bulges: Real, count: int) -> Real:
    """Distance of points beside the first period to the contour of that period and its neighbours."""
    best = np.full(points.shape, np.inf)
    turn = np.exp(2j * math.pi / count)
    ends = np.append(vertices[1:], vertices[0] * turn)
    for start, end, bulge in zip(vertices, ends, bulges, strict=True):
        for shift in (0,) if count == 1 else (-1, 0, 1):
            k = turn**shift
            best = np.minimum(best, distance_to_edge(points, start * k, end * k, float(bulge)))
    return best


def contour_points(vertices: Complex, bulges: Real, count: int, per_edge: int = 60) -> Complex:
    """Points of every edge of the first period."""
    ends = np.append(vertices[1:], vertices[0] * np.exp(2j * math.pi / count))
    edges = zip(vertices, ends, bulges, strict=True)
    return np.concatenate([arc_points(complex(s), complex(e), float(b), per_edge) for s, e, b in edges])


def rack_tool(gear: SpurGear) -> RackTool:
    """The sweeping oracle's tool for a gear; a deeper cut is a standard tool fed further in."""
    rack, deeper = gear.rack, gear.thinning_by_deeper_cut
    infeed = gear.circumferential_thinning / (2 * math.tan(rack.pressure_angle)) if deeper else 0.0
    return RackTool(
        m=gear.module,
        alpha=rack.pressure_angle,
        ha=rack.addendum,
        c=rack.tip_clearance,
        rho=rack.tip_radius,
        x=gear.profile_shift_coefficient - infeed / gear.module,
        thinning=0.0 if deeper else gear.circumferential_thinning,
        relief_depth=rack.relief.depth if rack.relief else 0.0,
        relief_height=rack.relief.height if rack.relief else 0.45,
    )


def exact_parameters(gear: SpurGear) -> GearParameters:
    """The 50-digit oracle's gear, with the product's own tip radius."""
    tool = rack_tool(gear)
    return GearParameters(
        z=gear.number_of_teeth,
        m=tool.m,
        alpha=tool.alpha,
        ha=tool.ha,
        c=tool.c,
        rho=tool.rho,
        x=tool.x,
        thinning=tool.thinning,
        tip_radius=gear.tip_radius,
        relief_depth=tool.relief_depth,
        relief_height=tool.relief_height,
    )


def distance_to_polygon(polygon: shapely.Polygon, points: np.ndarray) -> Real:
    """From each shapely point to the boundary, edge by edge: a tree of edges finds them a hundred times sooner."""
    edges = [np.stack([at[:-1], at[1:]], axis=1) for ring in (polygon.exterior, *polygon.interiors)
             for at in [shapely.get_coordinates(ring)]]  # fmt: skip
    tree = shapely.STRtree(shapely.linestrings(np.concatenate(edges)))
    (places, _), far = tree.query_nearest(points, return_distance=True, all_matches=False)
    assert (places == np.arange(len(points))).all()
    return far


def hausdorff(one: shapely.Polygon, two: shapely.Polygon) -> float:
    """The farthest that a corner of the boundary of one is from that of the other, as shapely's own has it."""
    pairs = ((one, two), (two, one))
    return max(float(distance_to_polygon(a, shapely.points(shapely.get_coordinates(b))).max()) for a, b in pairs)

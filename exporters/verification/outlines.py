"""Outlines against exact profiles: closed, simple, in their place, on their layer, within the tolerance.

Measured densely and between the writer's own nodes: chains of lines and arcs edge by edge, sampled curves as they are.
Of a chain that repeats itself one period is measured, and every other one against it, vertex by vertex.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from exporters.formats.readback import Loop, ReadOutlines
from exporters.verification.verdict import Verdict, deviation_failures
from geometry.curves.curve import Complex, Real
from geometry.plane.contour import Contour, edge_points, signed_area
from geometry.plane.measure import distance_to_profile, profile_area, profile_disc
from geometry.plane.profile import Profile, Region
from parts.base.texts import N_, fault, unless

if TYPE_CHECKING:
    from exporters.formats.read_drawing import ReadDrawing

# how many points of a file are measured: all edges get at least 3 between their ends
_POINTS = 10_000
# periods of a file that differ by more than this share of the declared bound are each measured
_ALIKE = 0.01
# what a sampled loop encloses is known to this, part of it
_AREA = 2e-3
# what is cut out before it is engraved or pierced falls or moves
_ORDER = ("ENGRAVE", "CUT_INNER", "CUT_OUTER")
# points of a loop by which it is told from others
_ROUGH = 16
# points of an edge by which its shape is seen
_SHAPE = 16


def verify_outlines(found: ReadOutlines, region: Region, declared: float, tolerance: float) -> Verdict:
    """Lines and arcs of a file, and what it engraves, against a section."""
    verdict = verify_loops(found.loops, region.profiles(), region.layers(), declared, tolerance)
    return verdict.also(stroke_failures(found.strokes, [np.array(s) for s in region.strokes], declared))


def verify_drawing(found: ReadDrawing, region: Region, declared: float, tolerance: float) -> Verdict:
    """True curves of a file against a section."""
    return verify_samples(found.loops(), region.profiles(), declared, tolerance)


def verify_loops(
    loops: Sequence[Loop],
    profiles: Sequence[Profile],
    layers: Sequence[str],
    declared: float,
    tolerance: float,
    *,
    known_simple: bool = False,
) -> Verdict:
    """Closed loops against exact profiles; ``layers``: where each profile's loop must stand (empty: anywhere)."""
    count = {"contours": float(len(loops))}
    if failures := _count_failures(loops, profiles):
        return Verdict(count, tuple(failures))
    cut = [loop.layer.upper() for loop in loops if loop.layer.upper() in _ORDER]
    later = next((b for a, b in pairwise(cut) if _ORDER.index(b) < _ORDER.index(a)), "")
    failures = unless(not later, "a contour on {later} comes after one that lets it fall", later=later)
    worst, shortest = 0.0, float("inf")
    order = _matched([x.vertices for x in loops], profiles, declared)
    for loop, profile, layer in zip((loops[i] for i in order), profiles, layers, strict=True):
        right, told = loop.layer.upper() in ("", layer), N_("a contour stands on {layer} instead of {wanted}")
        failures += unless(right, told, layer=loop.layer, wanted=layer)
        deviation, found = _check_loop(loop, profile, declared, known_simple)
        worst = max(worst, deviation)
        shortest = min(shortest, float(np.abs(np.roll(loop.vertices, -1) - loop.vertices).min()))
        failures += found
    failures += deviation_failures(worst, declared, tolerance, max(p.reach() for p in profiles))
    return Verdict(count | {"max_deviation": worst, "shortest_edge": shortest}, tuple(failures))


def _count_failures(loops: Sequence[object], profiles: Sequence[Profile]) -> list[str]:
    """There are as many contours as there should be."""
    count, wanted = len(loops), len(profiles)
    return unless(count == wanted, "{count} contours instead of {wanted}", count=count, wanted=wanted)


def stroke_failures(found: Sequence[Complex], strokes: Sequence[Complex], declared: float) -> tuple[str, ...]:
    """What is wrong with the engraved strokes of a file, each point within the declared error of its own, mm."""
    if len(found) != len(strokes):
        return (fault("{count} engraved strokes instead of {wanted}", count=len(found), wanted=len(strokes)),)
    for one, exact in zip(found, strokes, strict=True):
        if len(one) != len(exact) or not np.abs(one - exact).max() <= declared:
            return (fault("an engraved stroke is not where it should be"),)
    return ()


def verify_samples(
    loops: Sequence[Complex],
    profiles: Sequence[Profile],
    declared: float,
    tolerance: float,
    areas: Sequence[float] | None = None,
) -> Verdict:
    """Densely sampled loops against exact profiles; ``areas``: what each encloses, mm^2, where more than that is known.

    The samples' polygon knows it to a part in 500, besides what the declared error along the loop makes.
    """
    count = {"contours": float(len(loops))}
    if failures := _count_failures(loops, profiles):
        return Verdict(count, tuple(failures))
    worst = 0.0
    found = list(areas if areas is not None else (signed_area(x, np.zeros(len(x))) for x in loops))
    for index, profile in zip(_matched(loops, profiles, declared), profiles, strict=True):
        loop, area, exact = loops[index], abs(found[index]), abs(profile_area(profile))
        worst = max(worst, _samples_deviation(loop, profile, declared))
        failures += unless(is_simple(loop), "a contour crosses itself")
        told = N_("encloses {area:.6g} mm^2 instead of {exact:.6g} mm^2")
        allowed = _AREA * exact + declared * float(np.abs(np.roll(loop, -1) - loop).sum())
        failures += unless(not abs(area - exact) > allowed, told, area=area, exact=exact)
    failures += deviation_failures(worst, declared, tolerance, max(p.reach() for p in profiles))
    return Verdict(count | {"max_deviation": worst}, tuple(failures))


def _samples_deviation(loop: Complex, profile: Profile, declared: float) -> float:
    """Greatest deviation of samples, mm.

    Where periods repeat, all samples of the first are measured, of the others those that may be farther off.
    """
    count = profile.count
    if count > 1 and len(loop) % count == 0:
        pitch = np.copysign(2 * np.pi / count, signed_area(loop, np.zeros(len(loop))))
        periods = loop.reshape(count, -1)
        spread = np.abs(periods * np.exp(-1j * pitch * np.arange(count))[:, None] - periods[0]).max()
        first = distance_to_profile(periods[0], profile, trusted=declared)
        loop = periods[:, first + 2 * spread >= first.max()].ravel()
    return float(distance_to_profile(loop, profile, trusted=declared).max())


def _matched(loops: Sequence[Complex], profiles: Sequence[Profile], declared: float) -> list[int]:
    """The loop of each profile: of those that are left the one that stays nearest to it at all of its points."""
    rough = np.array([x[np.linspace(0, len(x), _ROUGH, endpoint=False).astype(int)] for x in loops])
    left = np.ones(len(loops), dtype=bool)
    order = []
    for profile in profiles:
        best, found = np.inf, int(np.argmax(left))
        if left.sum() > 1:
            middle, reach = profile_disc(profile)
            # so far at least: most loops of a plate with many holes need no more
            least = np.nan_to_num(np.where(left, np.abs(rough - middle).max(axis=1) - reach, np.inf), nan=np.inf)
            while least.min() < best:
                index = int(np.argmin(least))
                away = float(distance_to_profile(rough[index], profile, trusted=declared).max())
                if away < best:
                    best, found = away, index
                least[index] = np.inf
        left[found] = False
        order.append(found)
    return order


def _check_loop(loop: Loop, profile: Profile, declared: float, known_simple: bool) -> tuple[float, list[str]]:
    """Greatest deviation of a loop, and what is wrong with its shape."""
    starts, ends = loop.vertices, np.roll(loop.vertices, -1)
    if len(starts) < 2 or not (np.all(np.isfinite(starts)) and np.all(np.isfinite(loop.bulges))):
        return float("inf"), ["a contour holds no shape or a coordinate that is not a number"]
    failures = unless(not np.any(starts == ends), "a contour repeats a vertex")
    exact, found = abs(profile_area(profile)), loop.size
    deviation, length = _deviation(loop, profile, declared)
    bound = max(deviation, declared) * length + 1e-12 * exact
    told = N_("encloses {found:.9g} mm^2 instead of {exact:.9g} mm^2")
    failures += unless(not abs(found - exact) > bound, told, found=found, exact=exact)
    shares = _shares(len(starts))
    few = shares[:: max(1, len(shares) // 4)]
    simple = known_simple or is_simple(edge_points(starts, ends, loop.bulges, few).ravel())
    return deviation, failures + unless(simple, "a contour crosses itself")


def _deviation(loop: Loop, profile: Profile, declared: float) -> tuple[float, float]:
    """Greatest deviation of a loop, mm, and its length; where periods repeat, at most ``_ALIKE`` too large."""
    spread = _spread(loop, profile.count)
    if spread <= _ALIKE * declared:
        deviation, length = _measured(loop, profile, declared, len(loop.vertices) // profile.count)
        if deviation + spread <= declared:
            return deviation + spread, length * profile.count
    return _measured(loop, profile, declared, len(loop.vertices))


def _measured(loop: Loop, profile: Profile, declared: float, count: int) -> tuple[float, float]:
    """Greatest deviation of the first edges of a loop, mm, and their length."""
    ends = np.roll(loop.vertices, -1)[:count]
    points = edge_points(loop.vertices[:count], ends, loop.bulges[:count], _shares(count))
    deviation = float(distance_to_profile(points.ravel(), profile, trusted=declared).max())
    return deviation, float(np.abs(np.diff(points, axis=1, append=ends[:, None])).sum())


def _shares(count: int) -> Real:
    """Where an edge is measured, the first end included, among so many."""
    return np.linspace(0, 1, int(np.clip(_POINTS // count, 3, 24)) + 2)[:-1]


def _spread(loop: Loop, count: int) -> float:
    """How far the edges of any period, turned back about the origin, stand from those of the first, mm.

    inf where the loop does not repeat itself. An arc of at most half a turn follows its ends by at most sqrt(2) times
    their way, and its bulge by at most half of the chord times the change.
    """
    if count == 1 or len(loop.vertices) % count or np.abs(loop.bulges).max() > 1:
        return np.inf
    pitch = np.copysign(2 * np.pi / count, signed_area(loop.vertices, loop.bulges))
    periods, bulges = loop.vertices.reshape(count, -1), loop.bulges.reshape(count, -1)
    moved = np.abs(periods * np.exp(-1j * pitch * np.arange(count))[:, None] - periods[0]).max()
    bent = np.abs(bulges - bulges[0]).max() * np.abs(np.roll(loop.vertices, -1) - loop.vertices).max() / 2
    return float(np.sqrt(2) * moved + bent)


def is_crossed(contour: Contour) -> bool:
    """Whether a closed chain of lines and arcs crosses itself, seen by a few points of each."""
    return not is_simple(contour.sampled(_SHAPE))


def is_simple(points: Complex) -> bool:
    """Whether a closed polygon does not cross itself: one seen whole from the origin cannot, others by GEOS."""
    turns = (np.conj(points) * np.roll(points, -1)).imag
    # all edges turn about the origin alike, by less than half a turn each and by one turn together
    if np.all(turns > 0) or np.all(turns < 0):
        whole = np.angle(np.roll(points, -1) * np.conj(points)).sum()
        if abs(whole) < 3 * np.pi:
            return True
    import shapely

    ring = shapely.linearrings(np.stack([points.real, points.imag], axis=1))
    return bool(shapely.is_simple(ring))

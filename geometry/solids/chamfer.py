"""Chamfers cut into lower ones: where one polynomial over the depth, or one ring of triangles, does not follow them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial

import numpy as np

from geometry.base.nearest import last_that_holds
from geometry.base.placement import Placement2
from geometry.base.record import made_once, replace
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Complex, Curve
from geometry.curves.line_arc import Arc
from geometry.plane.measure import distance_to_profile, profile_area
from geometry.plane.profile import Profile, joint_turn
from geometry.solids.body import Body, BodyBuilder, Wall

# the share of a mesh's tolerance that the bow of a chamfer's slices may take
_BOW_SHARE = 0.25
# shares of a segment and of a slice's depth at which its bow is sampled, and how much more it may be between them
_ALONG, _ACROSS, _SAMPLED = 17, (0.5, 0.25, 0.75), 1.1
# part of a mesh's tolerance by which an edge has opened where it is first cut again
_LEAST_SLICE = 1 / 16
# lower bows are rounding, mm
_NO_BOW = 1e-11
# decimals of depths, mm, beyond which they are rounding
_DIGITS = 9

# an edge opens with the root of the depth: its pieces grow with this power of their number
_OPENING_POWER = 4
# within this share of the depth, so often halved, the place is found where an edge opens
_OPENING_SHARE, _OPENING_STEPS = 1e-4, 14

# so many depths of a chamfer: from a corner with a smaller radius edges run nearly as from a cusp
_CUSP_DEPTHS = 0.25

# the shares of the depth, up to 1, at which a chamfer is cut: its wall, its loops of the whole boundary and of its end
Pieces = Callable[[Wall, int, int], Sequence[float]]


def cut_chamfers(body: Body, pieces: Pieces) -> Body:
    """The body with its chamfers cut into pieces; others of one profile and depth are cut alike."""
    known: dict[tuple[int, int], Sequence[float]] = {}
    sections: dict[tuple[int, int, float], Profile] = {}
    made = BodyBuilder(list(body.profiles), {loop: i for i, loop in enumerate(body.loops)}, [])
    made.walls += [wall for wall in body.walls if not body.is_chamfer(wall)]
    for wall, whole, end in body.chamfers():
        key = body.loops[whole].profile, body.loops[end].profile
        shares = known.setdefault(key, known.get(key) or pieces(wall, whole, end))
        below = whole
        for share in shares:
            z = (1 - share) * body.loops[whole].z + share * body.loops[end].z
            if share < 1 and (*key, share) not in sections:
                sections[*key, share] = body.section(wall, z)
            placed = body.loops[whole].turn, body.loops[whole].shift
            above = end if share == 1 else made.loop(sections[*key, share], z, *placed)
            lower, upper = (below, above) if whole == wall.lower else (above, below)
            made.wall(lower, upper, wall.section)
            below = above
    return body if len(made.loops) == len(body.loops) else replace(made.body(), caps=body.caps)


def openings(body: Body, wall: Wall, whole: int, end: int) -> tuple[float, ...]:
    """The shares of its depth at which a chamfer begins to meet itself in edges more, over vertices of the boundary.

    None where it does not: the end has as many corners as the whole boundary. From a corner at the cusp of a curve on,
    as at an involute's on its base circle, its edge runs with the root of the depth as well.
    """

    def corners(share: float) -> int:
        return len(_corners(body.section_at(wall, whole, end, share)))

    def is_known(share: float) -> bool:
        return corners(share) <= known

    boundary = body.loop_profile(whole)
    known, last = len(_corners(boundary)), corners(1.0)
    if last <= known:
        return (0.0,) if _has_cusp(boundary, _inset(boundary, body.loop_profile(end))) else ()
    place, found = _OPENING_SHARE, list[float]()
    if (begun := corners(place)) > known:
        known = begun
        found.append(0.0)
    while known < last and place < 1:
        near = (1 - place) / 2**_OPENING_STEPS
        place = last_that_holds(is_known, 1.0, place, _OPENING_STEPS)
        found.append(place)
        place = min(place + near, 1.0)
        known = max(known + 1, corners(place))
    return tuple(found)


def _inset(whole: Profile, end: Profile) -> float:
    """How far inwards a chamfer goes, mm, by the area that it takes: crowned teeth lose little over their height."""
    length = whole.count * float(np.abs(np.diff(_points(whole))).sum())
    return abs(profile_area(whole) - profile_area(end)) / length


def _has_cusp(profile: Profile, depth: float) -> bool:
    """Whether a curve bends at a corner of a profile so sharply, against a chamfer's depth, mm, as at its cusp."""
    return any(
        not isinstance(c, Arc) and abs(float(c.curvature(t))) * _CUSP_DEPTHS * depth > 1
        for a, b in _corners(profile)
        for c, t in ((a, a.domain[1]), (b, b.domain[0]))
    )


def _corners(profile: Profile) -> list[tuple[Curve, Curve]]:
    """The curves before and after each corner of a profile's period; its end is joined by the next period's start."""
    curves = [s.curve for s in profile.period]
    following = [*curves[1:], curves[0].placed(Placement2(profile.pitch_angle))]
    pairs = zip(curves, following, strict=True)
    return [(a, b) for a, b in pairs if abs(joint_turn(a, b)) > TOLERANCES.smooth_angle]


def even_shares(count: int, opens: float | None = None) -> tuple[float, ...]:
    """Shares of the depth that end so many pieces: equal ones; twice as many, ever larger, from where an edge opens."""
    if opens is None:
        return tuple(k / count for k in range(1, count + 1))
    even = [k / (2 * count) for k in range(1, 2 * count + 1)]
    return (*(opens * x for x in even if opens), *(opens + (1 - opens) * x**_OPENING_POWER for x in even))


def level_pieces(body: Body, tolerance: float) -> Pieces:
    """Where chamfers are cut, all of one depth alike, so that lines between the cuts bow by a share of the tolerance.

    Slices much lower than the tolerance, mm, bow by less.
    """
    worst = made_once(body, "bow", lambda: _worst(body))

    def pieces(wall: Wall, whole: int, end: int) -> Sequence[float]:
        depth = _depth(body, wall)
        most, opens = worst[depth]
        shares = even_shares(max(1, math.ceil(math.sqrt(most / (_BOW_SHARE * tolerance)))), opens)
        if opens is None:
            return shares
        low = opens + _LEAST_SLICE * tolerance / depth
        return tuple(share for share in shares if share <= opens or share >= min(low, 1.0))

    return pieces


def _worst(body: Body) -> dict[float, tuple[float, float | None]]:
    """How far lines across chamfers of each depth bow, mm, and the least share at which an edge of theirs opens."""
    groups: dict[float, list[tuple[Wall, int, int]]] = {}
    for chamfer in body.chamfers():
        groups.setdefault(_depth(body, chamfer[0]), []).append(chamfer)
    found = {}
    for depth, chamfers in groups.items():
        opens = [share for chamfer in chamfers for share in openings(body, *chamfer)]
        found[depth] = chamfer_bow(body, chamfers), min(opens, default=None)
    return found


def _depth(body: Body, wall: Wall) -> float:
    """The height of a chamfer, mm, the same for all that differ by rounding."""
    low, high = body.height(wall)
    return round(high - low, _DIGITS)


def chamfer_bow(body: Body, chamfers: Iterable[tuple[Wall, int, int]]) -> float:
    """How far lines between equal shares of chamfers' loops lie off their sections at most, within their planes, mm."""
    worst = _NO_BOW
    for chamfer in chamfers:
        section = partial(body.section_at, *chamfer)
        lower, upper = _points(section(0.0)), _points(section(1.0))
        for share in _ACROSS:
            middle = section(share)
            points = (1 - share) * lower + share * upper
            # a line is its own extension; what is nearer than the worst by its own place is nearer by any
            if (near := float(np.abs(points - _points(middle)).max())) > worst:
                off = float(distance_to_profile(points, middle, trusted=math.inf).max())
                worst = max(worst, min(near, off))
    return _SAMPLED * worst if worst > _NO_BOW else 0.0


def _points(profile: Profile) -> Complex:
    shares = np.linspace(0, 1, _ALONG)
    return np.concatenate(
        [s.curve.point((1 - shares) * s.curve.domain[0] + shares * s.curve.domain[1]) for s in profile.period]
    )

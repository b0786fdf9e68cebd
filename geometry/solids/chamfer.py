"""Chamfers cut into lower ones: where one polynomial over the depth, or one ring of triangles, does not follow them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from geometry.base.nearest import last_that_holds
from geometry.base.record import made_once, replace
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Complex
from geometry.curves.line_arc import Arc
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Profile, joint_turn
from geometry.solids.body import Body, BodyBuilder, Wall

# the share of a mesh's tolerance that the bow of a chamfer's slices may take
_BOW_SHARE = 0.25
# shares of a segment and of a slice's depth at which its bow is sampled, and how much more it may be between them
_ALONG, _ACROSS, _SAMPLED = 17, (0.25, 0.5, 0.75), 1.1
# lower bows are rounding, mm
_NO_BOW = 1e-11

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


def opening(body: Body, wall: Wall, whole: int, end: int) -> float | None:
    """The share of its depth at which a chamfer begins to meet itself in an edge: over a vertex of the boundary.

    None where it does not: the end has as many corners as the whole boundary. From a corner at the cusp of a curve on,
    as at an involute's on its base circle, its edge runs with the root of the depth as well.
    """

    def opened(share: float) -> bool:
        return _corners(body.section_at(wall, whole, end, share)) > corners

    boundary = body.loop_profile(whole)
    corners = _corners(boundary)
    if not opened(1.0):
        return 0.0 if _has_cusp(boundary, abs(body.loops[end].z - body.loops[whole].z)) else None
    if opened(_OPENING_SHARE):
        return 0.0
    return last_that_holds(lambda share: not opened(share), 1.0, _OPENING_SHARE, _OPENING_STEPS)


def _has_cusp(profile: Profile, depth: float) -> bool:
    """Whether a curve bends at a corner of a profile so sharply, against a chamfer's depth, mm, as at its cusp."""
    curves = [s.curve for s in profile.period]
    return any(
        not isinstance(c, Arc) and abs(float(c.curvature(t))) * _CUSP_DEPTHS * depth > 1
        for a, b in zip(curves, curves[1:] + curves[:1], strict=True)
        if abs(joint_turn(a, b)) > TOLERANCES.smooth_angle
        for c, t in ((a, a.domain[1]), (b, b.domain[0]))
    )


def _corners(profile: Profile) -> int:
    """How many of the joints of a profile's period are corners."""
    curves = [s.curve for s in profile.period]
    return sum(
        abs(joint_turn(a, b)) > TOLERANCES.smooth_angle for a, b in zip(curves, curves[1:] + curves[:1], strict=True)
    )


def even_shares(count: int, opens: float | None = None) -> tuple[float, ...]:
    """Shares of the depth that end so many pieces: equal ones; twice as many, ever larger, from where an edge opens."""
    if opens is None:
        return tuple(k / count for k in range(1, count + 1))
    even = [k / (2 * count) for k in range(1, 2 * count + 1)]
    return (*(opens * x for x in even if opens), *(opens + (1 - opens) * x**_OPENING_POWER for x in even))


def level_shares(body: Body, tolerance: float) -> tuple[float, ...]:
    """Where all chamfers are cut, so that lines between the cuts bow by a share of the tolerance, mm."""
    most, opens = made_once(body, "bow", lambda: _worst(body))
    if most is None:
        return (1.0,)
    return even_shares(max(1, math.ceil(math.sqrt(most / (_BOW_SHARE * tolerance)))), opens)


def _worst(body: Body) -> tuple[float | None, float | None]:
    """How far lines across any chamfer bow, mm, and the least share at which an edge opens; None: there is none."""
    chamfers = list(body.chamfers())
    opens = [found for chamfer in chamfers if (found := opening(body, *chamfer)) is not None]
    return max((chamfer_bow(body, *chamfer) for chamfer in chamfers), default=None), min(opens, default=None)


def chamfer_bow(body: Body, wall: Wall, whole: int, end: int) -> float:
    """How far lines between equal shares of a chamfer's loops lie off its sections, within their planes, mm."""
    section = partial(body.section_at, wall, whole, end)
    lower, upper = _points(section(0.0)), _points(section(1.0))
    worst = 0.0
    for share in _ACROSS:
        middle = section(share)
        points = (1 - share) * lower + share * upper
        # a line is its own extension
        near = float(np.abs(points - _points(middle)).max())
        if near > _NO_BOW:
            near = min(near, float(distance_to_profile(points, middle, trusted=math.inf).max()))
        worst = max(worst, near)
    return _SAMPLED * worst if worst > _NO_BOW else 0.0


def _points(profile: Profile) -> Complex:
    shares = np.linspace(0, 1, _ALONG)
    return np.concatenate(
        [s.curve.point((1 - shares) * s.curve.domain[0] + shares * s.curve.domain[1]) for s in profile.period]
    )

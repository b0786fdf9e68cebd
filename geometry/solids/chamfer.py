"""Chamfers cut into lower ones: where one polynomial over the depth, or one ring of triangles, does not follow them."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np

from geometry.base.record import replace
from geometry.curves.curve import Complex
from geometry.plane.measure import distance_to_profile
from geometry.plane.profile import Profile
from geometry.solids.body import Body, BodyBuilder, Wall

# the share of a mesh's tolerance that the bow of a chamfer's slices may take
_BOW_SHARE = 0.25
# shares of a segment and of a slice's depth at which its bow is sampled, and how much more it may be between them
_ALONG, _ACROSS, _SAMPLED = 17, (0.25, 0.5, 0.75), 1.1
# lower bows are rounding, mm
_NO_BOW = 1e-11

# how many pieces a chamfer is cut into: its wall, its loop of the whole boundary and that of its end
Pieces = Callable[[Wall, int, int], int]


def cut_chamfers(body: Body, pieces: Pieces) -> Body:
    """The body with its chamfers cut into pieces of equal depth; others of one profile and depth are cut alike."""
    counts: dict[tuple[int, int], int] = {}
    made = BodyBuilder(list(body.profiles), {loop: i for i, loop in enumerate(body.loops)}, [])
    made.walls += [wall for wall in body.walls if not body.is_chamfer(wall)]
    for wall, whole, end in body.chamfers():
        key = body.loops[whole].profile, body.loops[end].profile
        count = counts.setdefault(key, counts.get(key) or pieces(wall, whole, end))
        below = whole
        for k in range(1, count + 1):
            share = k / count
            z = (1 - share) * body.loops[whole].z + share * body.loops[end].z
            above = end if k == count else made.loop(body.section(wall, z), z)
            lower, upper = (below, above) if whole == wall.lower else (above, below)
            made.wall(lower, upper, wall.section)
            below = above
    return body if len(made.loops) == len(body.loops) else replace(made.body(), caps=body.caps)


def chamfer_slices(body: Body, wall: Wall, whole: int, end: int, tolerance: float) -> int:
    """Into how many slices a chamfer is cut, so that lines between them bow by a share of the tolerance, mm."""
    return max(1, math.ceil(math.sqrt(chamfer_bow(body, wall, whole, end) / (_BOW_SHARE * tolerance))))


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

"""Contact of a sliding plate with its follower over the whole travel, on the exact outlines: the gap everywhere."""

from __future__ import annotations

import cmath
import math

import numpy as np

from geometry.cams.contact.follower import judged, press_in
from geometry.cams.contact.outlines import FollowerEnd
from geometry.cams.plane.fence import Fence
from geometry.cams.plane.wedge import Upright, WedgeCam, wedge_profile
from geometry.curves.curve import Complex, Real
from geometry.gears.mesh.search import PairContact

_PLACES = 361


def wedge_contact(cam: WedgeCam, end: FollowerEnd, tolerance: float, *, out: float = 0.0) -> PairContact:
    """The gap between plate and follower at 361 places of the travel and at every joint of the motion, mm.

    ``drive_angles`` of the answer are travels, mm, its point lies in the plate's frame. ``out`` and the verdicts as in
    ``follower_contact``.
    """
    edges = [p.start for p in cam.motion.pieces]
    travel = np.unique(np.concatenate([np.linspace(0, cam.motion.travel, _PLACES), edges]))
    fence = Fence(wedge_profile(cam))
    shift = out * outwards(cam, travel)
    centre, normal = cam.centre(travel) + shift, 1j * cam.rate(travel)
    gaps = fence.signed_distance(centre) - cam.radius
    points = centre - cam.radius * normal / np.abs(normal)
    if end.outline is not None:

        def pose(place: float) -> tuple[complex, complex]:
            origin, turn = wedge_follower_pose(cam, end, place)
            return origin + out * complex(outwards(cam, np.asarray(place))), cmath.exp(1j * turn)

        travel, gaps, points = press_in(travel, gaps, points, fence, end, pose, tolerance)
    return judged(travel, (gaps, gaps), points, tolerance)


def outwards(cam: WedgeCam, travel: Real) -> Complex:
    """Unit vectors of the follower's way as it rises."""
    way = cam.mount.centre([cam.motion.value(travel), np.ones(np.shape(travel))])[1]
    return np.asarray(way / np.abs(way))


def wedge_follower_pose(cam: WedgeCam, end: FollowerEnd, travel: float) -> tuple[complex, float]:
    """Where a follower's frame stands in the plate's: its origin, mm, and its turn, rad."""
    if end.arm_length is None or isinstance(cam.mount, Upright):
        return complex(cam.centre(travel)), 0.0
    swung = cam.mount.start_angle + float(cam.motion.value(travel))
    return travel + cam.mount.pivot, math.pi - swung if cam.mount.side > 0 else swung

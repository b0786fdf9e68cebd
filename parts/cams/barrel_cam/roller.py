"""The roller of a cylindrical cam and what it asks of the barrel: its cone, its largest size, heights of its walls."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import TYPE_CHECKING

from geometry.base.errors import ParameterError, limit
from geometry.base.record import replace
from parts.keys.barrel import BarrelCamSpec

if TYPE_CHECKING:
    from geometry.cams.barrel.cam import BarrelCam

# the roller's axis stays this share of the floor's radius away from its side
INSIDE = 0.98
# the smallest roller that is looked for, as a part of the largest
_SMALLEST = 1e-4


def taper(keys: BarrelCamSpec, radius: float) -> float:
    """How much wider a groove of half the width ``radius`` gets for each mm outwards: as its roller does."""
    if keys.roller_form == "cylindrical":
        return 0.0
    if keys.cone_angle_deg is not None:
        return math.tan(math.radians(keys.cone_angle_deg) / 2)
    return (2 * radius - keys.clearance) / keys.outer_diameter


def check_cone(keys: BarrelCamSpec, cam: BarrelCam, stray: float) -> None:
    """A conical roller does not end above the floor."""
    if keys.cone_angle_deg is None:
        return
    room = cam.outer - math.sqrt(cam.inner**2 - (stray + cam.radius) ** 2)
    if not cam.taper * room < keys.roller_diameter / 2:
        most = 2 * math.degrees(math.atan(keys.roller_diameter / 2 / room))
        nearest = limit(most * (1 - 1e-6), keys.cone_angle_deg)
        raise ParameterError("cone_angle_deg", keys.cone_angle_deg, "apex_above_floor", nearest)


def kept_apex(keys: BarrelCamSpec) -> float | None:
    """The play of a groove whose cone keeps its apex on the cam's axis, mm; None where its angle is given."""
    return keys.clearance if keys.roller_form == "conical" and keys.cone_angle_deg is None else None


def takes_a_roller(cam: BarrelCam, apex_play: float | None = None) -> bool:
    """Whether there is a roller, however small, that undercuts no wall: ``largest_radius`` is above 0."""
    spare, least, most = _sizes(cam, apex_play)
    return spare(least) > 0 or spare(most) >= 0


@lru_cache(maxsize=64)
def largest_radius(cam: BarrelCam, apex_play: float | None = None) -> float:
    """Radius of the roller whose walls are nearly undercut, mm; 0 if none is small enough, no more than has room.

    ``apex_play``: mm by which the groove is wider than a cone that keeps its apex on the cam's axis.
    """
    from geometry.base.roots import bracketed_root

    spare, least, most = _sizes(cam, apex_play)
    if spare(most) >= 0:
        return most
    return bracketed_root(spare, least, most).value if spare(least) > 0 else 0.0


def _sizes(cam: BarrelCam, apex_play: float | None) -> tuple[Callable[[float], float], float, float]:
    """What a roller's radius leaves of the least edge speed, and the least and the greatest that are looked at, mm."""
    from geometry.cams.barrel.cam import LEAST_SPEED

    def spare(radius: float) -> float:
        taper = cam.taper if apex_play is None else (radius - apex_play / 2) / cam.reference
        return replace(cam, radius=radius, taper=taper).least_edge_speed()[0] - LEAST_SPEED

    stray = max(map(abs, cam.side_range()))
    most = INSIDE * cam.inner - stray
    least = _SMALLEST * most
    if apex_play is not None:
        least += apex_play / 2
    elif cam.taper:
        # a cone of this angle must reach the floor
        least += cam.taper * (cam.reference - math.sqrt(cam.inner**2 - (stray + cam.radius) ** 2))
    return spare, least, most


def thinnest(cam: BarrelCam) -> float:
    """Half the groove's width at the floor, or a little less, mm."""
    aside = max(map(abs, cam.side_range())) + cam.radius
    return float(cam.radius_at(math.sqrt(max(0.0, cam.inner**2 - aside**2))))


def end_height(cam: BarrelCam) -> float:
    """The highest point of an end cam's track, mm: where the roller rests highest, inside where it is a cone."""
    import numpy as np

    from geometry.cams.barrel.cam import LOWER

    at = [(p, p.extremes(0)) for p in cam.motion.pieces]
    return max(float(cam.wall(t[:, None], LOWER, np.array([cam.inner, cam.outer]), p)[..., 2].max()) for p, t in at)


def moved_cam(cam: BarrelCam, offset: float) -> BarrelCam:
    """The cam with walls, floor and outside moved out of the material; a cone is then wider across its axis."""
    radius = cam.radius - offset / cam.upright
    # material grows at a groove's floor outwards, at a tube's inside inwards
    inner = cam.inner + (offset if cam.is_groove else -offset)
    return replace(cam, radius=radius, outer=cam.outer + offset, inner=inner)


def guides(cam: BarrelCam) -> bool:
    """Whether the roller has room over the floor and undercuts no wall."""
    aside = max(map(abs, cam.side_range())) + cam.radius
    return bool(0 < aside < INSIDE * cam.inner and cam.least_edge_speed()[0] > 0)

"""Walls of cams that hold a roller, and grooves cut into a solid."""

from __future__ import annotations

from geometry.base.record import replace
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.shape import cam_shape
from geometry.cams.plane.undercut import lost_to_undercut
from geometry.plane.profile import Profile, Segment
from geometry.solids.body import Body, Cap, opened


def reversed_profile(profile: Profile) -> Profile:
    """The same closed chain run the other way."""
    turned = tuple(Segment(s.curve.reversed(), s.label) for s in reversed(profile.period))
    return Profile(turned, profile.count, not profile.clockwise if profile.count > 1 else profile.clockwise)


def outer_wall(cam: DiskCam, clearance: float, offset: float = 0.0) -> Profile:
    """The wall beyond the roller, clockwise, moved ``offset`` mm out of the material, towards the roller.

    It is the parallel of the roller's path at r + ``clearance`` mm away from the axis.

    Raises
    ------
    UndercutError
        Nothing of it hangs together.
    """
    return reversed_profile(cam_shape(cam, 2 * cam.radius + clearance - offset).profile)


def wide_roller(cam: DiskCam, clearance: float) -> DiskCam:
    """The cam with the roller that fills its groove: the one that follows the motion on the outer wall."""
    return replace(cam, radius=cam.radius + clearance)


def lost_on(cam: DiskCam, clearance: float) -> dict[str, float]:
    """Lift that undercut takes on each wall, by its name, mm (rad if oscillating); whole walls are not named."""
    grown = (("inner", 0.0), ("outer", 2 * cam.radius + clearance))
    return {name: lost for name, grow in grown if (lost := lost_to_undercut(cam, grow)) is not None}


def path_reach(cam: DiskCam) -> float:
    """Greatest distance of the roller's centre from the axis, mm; it stands where S is extreme."""
    import numpy as np

    angles = cam.motion.stack.extremes(0)[1]
    return float(np.abs(cam.reference_point(angles)).max())


def with_groove(body: Body, inner: Profile, outer: Profile, floor: float, top: float) -> Body:
    """A body with a groove cut from its face at z = ``top`` mm down to ``floor``, between two closed walls.

    ``inner`` counter-clockwise, ``outer`` clockwise about it. All other edges of that face lie either within ``inner``
    or beyond ``outer``.

    Raises
    ------
    ValueError
        The body has no face there.
    """
    made, face = opened(body, top)
    (inner_foot, inner_edge), (outer_foot, outer_edge) = (made.upright(wall, floor, top) for wall in (inner, outer))
    made.caps += [
        Cap(face.outer, (outer_edge,), True),
        Cap(inner_edge, face.holes, True),
        Cap(outer_foot, (inner_foot,), True),
    ]
    return made.body()

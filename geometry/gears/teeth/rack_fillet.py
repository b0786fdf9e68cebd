"""The root fillet of a rack's tooth: an arc of the basic rack's circle, or of its ellipse in a transverse section."""

from __future__ import annotations

import cmath
import math

from geometry.base.errors import OffsetError
from geometry.base.placement import Placement2
from geometry.base.tolerance import TOLERANCES
from geometry.curves.curve import Curve, end_point, start_point
from geometry.curves.ellipse import EllipticArc, ellipse_angle
from geometry.curves.line_arc import Arc, arc_between


def root_fillet(
    depth: float, half: float, angle: float, radius: float, stretch: float, offset: float
) -> tuple[Curve | None, complex, complex]:
    """The fillet of a lower half tooth in the mesh frame, moved ``offset`` mm out of the material; its foot and root.

    ``depth`` of the root line, ``half`` the tooth's half thickness on the datum line, ``radius`` of the rounding along
    the depth, mm, ``stretch`` times that along the datum line; ``angle`` of the flank, rad. No curve where the offset
    leaves none: both points are the corner.

    Raises
    ------
    OffsetError
        The offset turns an elliptic fillet back.
    """
    sine, cosine = math.sin(angle), math.cos(angle)
    support = radius * math.hypot(sine, stretch * cosine)
    centre = complex(depth - radius, -(half + (depth - radius) * math.tan(angle) + support / cosine))
    if radius - offset <= TOLERANCES.relative_length * depth:
        wide, lower = half + offset / cosine, depth - offset
        corner = complex(lower, -(wide + lower * math.tan(angle)))
        return None, corner, corner
    if stretch == 1:
        fillet = radius - offset
        foot, root = centre + fillet * 1j * cmath.exp(-1j * angle), centre + fillet
        return arc_between(centre, foot, root, turns_left=False), foot, root
    # an ellipse bends sharpest at its end of the greater semi-axis: at the root line it is flattest
    touch = ellipse_angle(math.pi / 2 - angle, stretch)
    ellipse = EllipticArc(Arc(0j, radius, touch, -touch), stretch, Placement2(0.0, centre))
    least = min(1 / abs(float(k)) for k in (ellipse.curvature(0.0), ellipse.curvature(touch)))
    if offset >= least:
        raise OffsetError(offset, "turns_fillets_back")
    curve = ellipse.offset(-offset) if offset else ellipse
    return curve, start_point(curve), end_point(curve)

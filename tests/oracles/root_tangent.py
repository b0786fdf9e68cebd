"""The critical section of a tooth by brute force: the cutter's rounded corner rolls past, 30 digits, no closed form.

The corner's centre is carried round as gear and cutter roll; where it leaves the gear's outline the common normal
passes through the pitch point. Slopes and curvatures are differences of that outline.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mpmath

Outline = Callable[[Any], Any]


def rack_corner(teeth: Any, module: Any, alpha: Any, depth: Any, rounding: Any, shift: Any, wider: Any) -> Outline:
    """The outline of the lower side of tooth 1, centred on +x, that a rack leaves; ``wider``: mm, each side."""
    radius = module * teeth / 2
    # the rounding touches the tip line and the flank of the rack's tooth
    across = mpmath.pi * module / 4 + wider - (depth - rounding) * module * mpmath.tan(alpha)
    across -= rounding * module / mpmath.cos(alpha)
    down = (depth - rounding - shift) * module
    start = -mpmath.pi * module / 2 + across

    def outline(roll: Any) -> Any:
        centre = mpmath.expj(-roll) * (radius - down + 1j * (start + radius * roll))
        return _left(centre, radius * mpmath.expj(-roll), rounding * module, down)

    return outline


def cutter_corner(
    radius: Any, teeth: Any, cutter_radius: Any, corner: Any, angle: Any, rounding: Any, sign: int
) -> Outline:
    """The same of a pinion cutter's corner, its centre ``corner`` from the cutter's axis, mm and rad; sign -1: a ring.

    ``radius`` and ``cutter_radius``: those of rolling, mm. A ring's tooth is turned to +x, its side lies above.
    """
    distance = radius + sign * cutter_radius
    turned = mpmath.expj(-mpmath.pi / teeth) if sign > 0 else mpmath.expj(mpmath.pi / teeth)

    def outline(roll: Any) -> Any:
        own = mpmath.expj(-angle - sign * roll * radius / cutter_radius)
        fixed = distance - sign * corner * own
        return turned * mpmath.expj(-roll) * _left(fixed, radius, rounding, corner - cutter_radius)

    return outline


def _left(centre: Any, pole: Any, rounding: Any, beyond: Any) -> Any:
    """The point of the outline: from the corner's centre along the line from the pole, outwards of the cutter."""
    way = centre - pole
    return centre + rounding * mpmath.sign(beyond) * way / abs(way)


def touched(outline: Outline, degrees: float, low: float, high: float) -> tuple[Any, Any, Any]:
    """Thickness, radius of curvature and distance from the axis where a line at an angle to +x touches the outline."""
    slope = mpmath.expj(mpmath.radians(degrees))

    def lean(roll: Any) -> Any:
        return mpmath.im(mpmath.conj(slope) * mpmath.diff(outline, roll))

    roll = mpmath.findroot(lean, (low, high), solver="anderson", tol=1e-40, maxsteps=100)
    first, second = mpmath.diff(outline, roll), mpmath.diff(outline, roll, 2)
    bend = mpmath.im(mpmath.conj(first) * second) / abs(first) ** 3
    point = outline(roll)
    return 2 * abs(mpmath.im(point)), 1 / abs(bend), mpmath.re(point)

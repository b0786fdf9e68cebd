"""Where a curve meets a line, a circle, or any level of a function of the point: bracketed roots."""

from __future__ import annotations

from collections.abc import Callable

from geometry.base.errors import ConvergenceError
from geometry.base.roots import Root, bracketed_root
from geometry.curves.curve import Curve, end_point, start_point


def crossing(curve: Curve, height: Callable[[complex], float]) -> Root:
    """Parameter at which ``height`` of the point changes sign between the ends of a curve.

    Raises
    ------
    ConvergenceError
        ``height`` has one sign at both ends.
    """
    return bracketed_root(lambda t: height(complex(curve.point(t))), *curve.domain)


def crossing_line(curve: Curve, point: complex, direction: complex) -> Root:
    """Parameter at which a curve crosses the line through ``point`` along ``direction``."""
    return crossing(curve, lambda p: height_over_line(p, point, direction))


def crossing_circle(curve: Curve, radius: float) -> Root:
    """Parameter at which a curve crosses a circle about the origin."""
    return crossing(curve, lambda p: abs(p) - radius)


def height_over_line(p: complex, point: complex, direction: complex) -> float:
    """Signed distance of ``p`` to the left of a line, mm; ``direction`` has unit length."""
    return ((p - point) * direction.conjugate()).imag


def first_above(curves: list[Curve], height: Callable[[complex], float]) -> tuple[int, float] | None:
    """Index and parameter of the first point of a chain from which ``height`` is positive at a curve's end.

    None where no curve of the chain ends above.
    """
    for index, curve in enumerate(curves):
        if height(end_point(curve)) > 0:
            low = curve.domain[0]
            if height(start_point(curve)) > 0:
                return index, low
            try:
                return index, crossing(curve, height).value
            except ConvergenceError:
                return index, low
    return None

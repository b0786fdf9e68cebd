"""Every way in which a geometry can be refused, each with the numbers that explain it."""

from __future__ import annotations

import math
from collections.abc import Callable


class GeometryError(Exception):
    """Root of all errors raised by this project's geometry."""


class ParameterError(GeometryError, ValueError):
    """A parameter has a value that cannot be built.

    ``name`` is the key as the user types it, ``value`` what was given, ``allowed`` a sentence that
    names the nearest value that works.
    """

    def __init__(self, name: str, value: object, allowed: str) -> None:
        self.name = name
        self.value = value
        self.allowed = allowed
        super().__init__(f"{name} = {format_value(value)}: {allowed}")


class UndercutError(ParameterError):
    """The cutter removes so much of the flank that no usable tooth is left."""


class PointedTipError(ParameterError):
    """Both flanks of a tooth meet below its tip circle."""


class OffsetError(ParameterError):
    """An offset that no outline survives, mm, with the one nearest to it that works."""

    def __init__(self, offset: float, reason: str, nearest: float) -> None:
        self.reason, self.nearest = reason, nearest
        text = f"at most {at_most(nearest)}" if nearest >= 0 else f"at least {at_least(nearest)}"
        super().__init__("offset", offset, f"{reason}; {text} mm works")


class CuspError(GeometryError):
    """An offset curve turns back on itself where 1 - curvature * distance changes sign."""

    def __init__(self, t: float, distance: float) -> None:
        self.t = t
        self.distance = distance
        super().__init__(f"offset by {distance:g} mm has a cusp at parameter {t:.12g}")


class DisconnectedProfileError(GeometryError):
    """Consecutive segments of a profile do not meet."""

    def __init__(self, index: int, gap: float) -> None:
        self.index = index
        self.gap = gap
        super().__init__(f"segment {index} does not start where its predecessor ends: gap {gap:.3g} mm")


class ConvergenceError(GeometryError, ArithmeticError):
    """An iteration stopped before its residual was small enough."""

    def __init__(self, what: str, residual: float, iterations: int) -> None:
        self.residual = residual
        self.iterations = iterations
        super().__init__(f"{what}: residual {residual:.3g} after {iterations} iterations")


class ThinWallError(GeometryError):
    """Chords of two outlines touch or cross: a wall is thinner than the tolerance."""


def at_most(value: float, digits: int = 6) -> str:
    """An upper limit rounded down, so that the printed number itself still works."""
    return _rounded(value, digits, math.floor)


def at_least(value: float, digits: int = 6) -> str:
    """A lower limit rounded up, so that the printed number itself still works."""
    return _rounded(value, digits, math.ceil)


def told(value: float, *, up: bool = False) -> str:
    """A limit as printed, six digits after the point and more where it is small; rounded so that it works."""
    digits = 6 if value == 0 else max(6, 4 - math.floor(math.log10(abs(value))))
    return at_least(value, digits) if up else at_most(value, digits)


def _rounded(value: float, digits: int, rounding: Callable[[float], int]) -> str:
    text = f"{rounding(value * 10**digits) / 10**digits:.{digits}f}"
    return text.rstrip("0").rstrip(".")


def format_value(value: object) -> str:
    """A value as it would stand in a scene file."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        text = f"{value:.12g}"
        return f"{text}.0" if text.lstrip("-").isdigit() else text
    return f'"{value}"' if isinstance(value, str) else str(value)

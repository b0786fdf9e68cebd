"""Every way in which a geometry can be refused, each with the numbers that explain it."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cached_property
from typing import Literal, Self

from geometry.base.record import Record


class GeometryError(Exception):
    """Root of all errors raised by this project's geometry."""


Side = Literal["at_most", "at_least", "exactly", "meant", "same", "like"]
# sides whose value is words to be read, and none of the parameter
TOLD: tuple[Side, ...] = ("meant", "same", "like")


class Nearest(Record):
    """The value of a refused parameter nearest to the given one that works; None: it works when left out.

    ``side``: an upper limit (``at_most``), a lower one (``at_least``), a value of its own, the word that was
    probably ``meant``, a key of ours with the value that says the ``same``, or what the key is written ``like``.
    ``too``: other things that had the given value too, and work with this one only.
    """

    value: float | str | bool | list[float] | None
    side: Side = "exactly"
    too: tuple[str, ...] = ()

    def scaled(self, factor: float) -> Nearest:
        """The same limit in another unit, rounded again to the side that works."""
        if not isinstance(self.value, float):
            return self
        value = self.value * factor
        return (
            Nearest(value) if self.side == "exactly" else Nearest(rounded(value, up=self.side == "at_least"), self.side)
        )


def rounded(value: float, *, up: bool, digits: int = 4) -> float:
    """A limit as it is told: ``digits`` after the point, or four in all where it is small, up or down."""
    if value != 0:
        # beyond that a double has no power of ten
        digits = min(max(digits, 3 - math.floor(math.log10(abs(value)))), 300)
    shift = 10.0**digits
    steps = (math.ceil if up else math.floor)(value * shift)
    # a product that is rounded past the value is a step too near
    steps += (steps / shift < value) if up else -(steps / shift > value)
    return steps / shift


def limit(value: float, given: float, *, digits: int = 4) -> Nearest:
    """The last value that works on the way to a ``given`` one that does not, as it is told: so that it works too.

    ``digits`` after the point; an angle in rad wants 9, since it is told in degrees.
    """
    side: Side = "at_most" if value < given else "at_least"
    return Nearest(value if isinstance(value, int) else rounded(value, up=side == "at_least", digits=digits), side)


# a value that works, or how to find it
Cure = Nearest | Callable[[], "Nearest | None"] | None


class Curable:
    """What may know the value that works, or how to find it, which is done when somebody asks and only then."""

    _cure: Cure = None

    @property
    def nearest(self) -> Nearest | None:
        """The value nearest to the given one that works; None where it alone cannot cure what is wrong."""
        if callable(self._cure):
            self._cure = self._cure()
        return self._cure


class ParameterError(Curable, GeometryError, ValueError):
    """A parameter has a value that cannot be built: data, the words for it stand at the edge.

    ``name``: the parameter as its owner names it (``tip_relief.depth``), ``value``: what was given, ``code``: what is
    wrong, ``numbers``: what the sentence of that code needs, ``nearest``: the value that works, or how to find it,
    which is done when somebody asks for it and only then.
    """

    def __init__(self, name: str, value: object, code: str, nearest: Cure = None, /, **numbers: object) -> None:
        self.name, self.value, self.code, self.numbers = name, value, code, numbers
        self._cure = nearest
        super().__init__(name, value, code)

    @classmethod
    def beyond(cls, name: str, value: float, code: str, last: float, /, *, digits: int = 4, **numbers: object) -> Self:
        """The refusal of a value beyond the ``last`` one that works, which is told with ``digits`` after the point."""
        return cls(name, value, code, limit(last, value, digits=digits), **numbers)

    def __str__(self) -> str:
        told = "".join(f", {name} {format_value(value)}" for name, value in self.numbers.items())
        return f"{self.name} = {format_value(self.value)}: {self.code}{told}"

    def renamed(self, name: str, factor: float | None = None) -> ParameterError:
        """The same refusal under another name, its value and nearest times ``factor`` where one is given."""
        value = self.value * factor if factor is not None and isinstance(self.value, int | float) else self.value

        def cure() -> Nearest | None:
            found = self.nearest
            return found if found is None or factor is None else found.scaled(factor)

        return self.told_of(name, value, cure)

    def told_of(self, name: str, value: object, nearest: Cure) -> ParameterError:
        """The same refusal told of a parameter that can cure it, with the value that does."""
        return type(self)(name, value, self.code, nearest, **self.numbers)


class UndercutError(ParameterError):
    """The cutter removes so much of the flank that no usable tooth is left."""


class PointedTipError(ParameterError):
    """Both flanks of a tooth meet below its tip circle."""


class LateError(ParameterError):
    """A refusal of which it is sought whom it blames when somebody asks, and only then: one of a trial is never asked.

    ``seek``: finds what is told, of the same ``code``.
    """

    def __init__(self, code: str, seek: Callable[[], ParameterError]) -> None:
        self.code, self._seek = code, seek
        self._cure = lambda: self._told.nearest
        Exception.__init__(self)

    @cached_property
    def _told(self) -> ParameterError:
        return self._seek()

    def __getattr__(self, name: str) -> object:
        """Name, value and numbers of what is told."""
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._told, name)

    def renamed(self, name: str, factor: float | None = None) -> ParameterError:
        """As any other one; whoever names it has asked."""
        return self._told.renamed(name, factor)

    def told_of(self, name: str, value: object, nearest: Cure) -> ParameterError:
        """As any other one."""
        return self._told.told_of(name, value, nearest)


class OffsetError(ParameterError):
    """An offset that no outline survives, mm, with the one nearest to it that works, or 0 where ``moved`` seeks it.

    ``alone``: no other one does.
    """

    def __init__(self, offset: float, reason: str, nearest: float = 0.0, *, alone: bool = False) -> None:
        self.reason, self.nearest_offset = reason, nearest
        cure = Nearest(nearest) if alone else lambda: limit(nearest, offset, digits=6)
        super().__init__("offset", offset, reason, cure)


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


def format_value(value: object) -> str:
    """A value as it would stand in a scene file."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        text = f"{value:.12g}"
        return f"{text}.0" if text.lstrip("-").isdigit() else text
    return f'"{value}"' if isinstance(value, str) else str(value)

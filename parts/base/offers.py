"""What a refusal of a part offers: a value that builds, tried in the part and beside what hangs on it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Generic, TypeVar

from geometry.base.errors import TOLD, GeometryError, Nearest, ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import replace
from parts.base.refusal import SceneError, placed
from parts.base.schema import as_typed, tried, unit_of, value_at

if TYPE_CHECKING:
    from parts.base.part_keys import MaterialKeys

K = TypeVar("K", bound="MaterialKeys")
T = TypeVar("T")
# offers for one key that are tried, one after another: each limit may lie beyond the one before
MOST_OFFERS = 4
# parts of a limit by which further values are tried where something beside it stops it; how near that is found
_FURTHER, _SHARE = (1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2, 3 / 4, 7 / 8, 1.0), 8e-4


class Trial(Generic[K, T]):
    """Other values of one key of a part at a time.

    ``make``: its thing as it is in its scene; ``fits`` refuses keys and their thing where what hangs on the part does
    not take them, and names the parts that must change as it does; ``solid``: made too, where only that tells whether
    a value builds, as what a chamfer leaves of edges.
    """

    def __init__(
        self,
        keys: K,
        make: Callable[[K], T],
        fits: Callable[[K, T], Iterable[str]],
        solid: Callable[[K, T, float], object] | None,
    ) -> None:
        self._keys, self._make, self._fits, self._solid = keys, make, fits, solid
        # what an offer makes is asked for again by what hangs on it
        self._last: tuple[tuple[str, str], tuple[K, T]] | None = None

    def told(self, refusal: ParameterError, source: str, place: str) -> SceneError:
        """A refusal under the scene's key; what it offers is tried when it is asked for."""
        typed = as_typed(self._keys, refusal)
        error = placed(source, place, typed, unit_of(type(self._keys), typed.name))
        # a part may reckon with another number than the one in its file: the shift in the transverse section
        if isinstance(typed.value, float) and isinstance(given := value_at(self._keys, typed.name), float):
            error.value = given
        error.offer(lambda: self._with_others(typed, self._cure(typed, one_for_both=typed is not refusal)))
        return error

    def _with_others(self, told: ParameterError, found: Nearest | None) -> Nearest | None:
        """What works with the parts that it works with only if they have it too; a word for one alone is none."""
        if found is None:
            return None
        others = tuple(self._fits(*self._made(told.name, found.value)))
        return None if others and found.side in TOLD else replace(found, too=others)

    def _cure(self, told: ParameterError, *, one_for_both: bool) -> Nearest | None:
        """The value that builds and that all that hangs on the part takes."""
        found = self._alone(told, one_for_both=one_for_both)
        for _ in range(MOST_OFFERS):
            if found is None:
                return None
            try:
                self._fits(*self._made(told.name, found.value))
            except ParameterError as again:
                if again.name != told.name:
                    return self._beyond(told, found, self._stands, _SHARE)
                found = again.nearest
            except (GeometryError, ArithmeticError, SceneError):
                return self._beyond(told, found, self._stands, _SHARE)
            else:
                return found
        return None

    def _alone(self, told: ParameterError, *, one_for_both: bool) -> Nearest | None:
        """The value with which the part builds by itself; ``one_for_both``: one number stands for both sides."""
        found = told.nearest
        if one_for_both and isinstance(told.value, float):
            return nearest(lambda value: self._works(told.name, value), told.value, 0.0)
        if found is None:
            return None
        try:
            self._works(told.name, found.value)
        except (GeometryError, ArithmeticError):
            return self._beyond(told, found, self._works, 0.0 if self._solid else _SHARE)
        return found

    def _beyond(
        self, told: ParameterError, found: Nearest, holds: Callable[[str, float], bool], share: float
    ) -> Nearest | None:
        """Further from what was given than what something beside it stops: a chamfer, a hub, a mate."""
        given, limit = told.value, found.value
        if not isinstance(given, float) or not isinstance(limit, float):
            return None
        way = math.copysign(abs(limit), limit - given)
        further = [limit + way * share_of for share_of in _FURTHER]
        return nearest(lambda value: holds(told.name, value), limit, further, share=share)

    def _made(self, name: str, value: object) -> tuple[K, T]:
        asked = name, repr(value)
        if self._last is None or self._last[0] != asked:
            changed = tried(self._keys, name, value)
            self._last = asked, (changed, self._make(changed))
        return self._last[1]

    def _works(self, name: str, value: object) -> bool:
        changed, thing = self._made(name, value)
        if self._solid:
            self._solid(changed, thing, 0.0)
        return True

    def _stands(self, name: str, value: object) -> bool:
        self._fits(*self._made(name, value))
        return self._works(name, value)

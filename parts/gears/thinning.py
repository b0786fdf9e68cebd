"""Backlash of two gears as thinning of their teeth: half each, all of it from one where the other sets its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import Protocol

from geometry.base.errors import GeometryError, Nearest, ParameterError, rounded
from geometry.base.nearest import kept, nearest
from parts.base.refusal import REMOVED


class Thinned(Protocol):
    """A gear whose teeth can be thinned."""

    @property
    def module(self) -> float:
        """m, mm."""

    @property
    def circumferential_thinning(self) -> float:
        """Of each tooth, mm along the reference circle."""


def shared_thinning(
    backlash: float,
    gears: Sequence[Thinned],
    build: Callable[[int, float], object],
    cosine: float,
    there: float | None = None,
    share: float = 1.0,
) -> tuple[float, float]:
    """What a normal backlash (mm) takes of each tooth of two gears, mm; 0 of a gear that sets its own thinning.

    ``build(0 or 1, thinning)`` makes a tooth of that gear, ``cosine``: of the pressure angle, ``there``: backlash of
    the gears as they are, mm (None: by their own thinning alone), ``share``: j_bn over the backlash of their section.

    Raises
    ------
    ParameterError
        ``mate.normal_backlash`` is less than there is already, leaves no whole teeth, or is another than that of two
        gears which both set their thinning.
    """
    own = [gear.circumferential_thinning for gear in gears]
    free = [index for index, thinning in enumerate(own) if thinning == 0]
    if there is None:
        there = sum(own) * cosine
    least = there * share

    def each(value: float) -> float:
        """The thinning of each free gear."""
        return (value / share - there) / cosine / len(free)

    def whole(value: float) -> bool:
        """Whether whole teeth are left."""
        return all(stands(each(value), index) for index in free)

    def stands(thinning: float, index: int) -> bool:
        """Whether whole teeth are left of one gear."""
        build(index, thinning)
        return True

    if not free:
        # calculations print five decimals of it
        if abs(backlash - least) > 1e-5:
            raise ParameterError("mate.normal_backlash", backlash, "backlash_is_of_own_thinning", REMOVED, own=least)
        return 0.0, 0.0
    found = each(backlash)
    if found < -1e-12 * gears[0].module:
        cure = Nearest(rounded(least, up=True, digits=6), "at_least")
        raise ParameterError("mate.normal_backlash", backlash, "backlash_already_more", cure)
    try:
        if found > 0:
            whole(backlash)
    except GeometryError as refusal:
        raise ParameterError(
            "mate.normal_backlash",
            backlash,
            "backlash_leaves_no_teeth",
            lambda: nearest(whole, backlash, least),
            gears=[k + 1 for k in free if not kept(partial(stands, each(backlash)), k)],
        ) from refusal
    return found if 0 in free else 0.0, found if 1 in free else 0.0

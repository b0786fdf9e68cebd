"""Sizes that must be equal in two parts."""

from __future__ import annotations

import math
from collections.abc import Iterable

from geometry.base.errors import Nearest, ParameterError

# sizes that must be equal in two parts: they are typed, not calculated
_SAME = 1e-9
# radii and lengths that people type agree with those of the cam this well, mm
_SAME_AS_CAM = 1e-6


def same_size(key: str, own: float | str | None, other: float | str | None, code: str) -> None:
    """Refuse a size, or a word, of the second part that is not the first one's, or is said of one; ``code``: whose."""
    if own == other:
        return
    if not (
        isinstance(own, int | float) and isinstance(other, int | float) and math.isclose(own, other, rel_tol=_SAME)
    ):
        raise ParameterError(key, own, code, Nearest(other))


def same_sizes(keys: Iterable[str], second: object, first: object, code: str) -> None:
    """Refuse sizes of the second part that are not those of the first."""
    for key in keys:
        same_size(key, getattr(second, key), getattr(first, key), code)


def same_as_cam(key: str, value: float, wanted: float, code: str = "cam_has_another") -> None:
    """Refuse a size of the follower that is not the one its cam is made for, mm."""
    if abs(value - wanted) > _SAME_AS_CAM:
        raise ParameterError(key, value, code, Nearest(wanted))

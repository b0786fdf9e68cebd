"""The key of a picture: a closed line by its corners."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta

from parts.keys.base import MOST_LENGTH

MOST_POINTS = 1000

_Told = Annotated[float, Meta(ge=-MOST_LENGTH, le=MOST_LENGTH)]
# a drop, its tip upwards
_DROP = [[0.0, 30.0], [-10.0, 10.0], [-8.0, 2.0], [0.0, -2.0], [8.0, 2.0], [10.0, 10.0]]
Picture = Annotated[list[tuple[_Told, _Told]], Meta(min_length=3, examples=[_DROP])]

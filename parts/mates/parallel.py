"""The mate ``parallel``: two instances that always turn alike, wherever their axes go."""

from __future__ import annotations

import math
from typing import Annotated, Any

from msgspec import Meta

from geometry.base.errors import ParameterError
from parts.base.mate import End, MateKeys, MateKind, Mating, Pose, Standing
from parts.keys.base import degrees, mm

_MOST = 1e6
_Shift = Annotated[float, mm("a coordinate of the second's axis from the first's", least=-_MOST, most=_MOST)]

_OFFSET = mm(
    "x, y, z of its axis at the start, along the scene's axes; default: where other mates put it",
    example=[40.0, 0.0, 0.0],
)


class ParallelSpec(MateKeys, tag="parallel", kw_only=True):
    """Keys of ``parallel``."""

    second: Annotated[str, Meta(description="instance that turns alike; other mates carry its axis")]
    offset: Annotated[tuple[_Shift, _Shift, _Shift], _OFFSET] | None = None
    rotation_deg: Annotated[float, degrees("turn of the second against the first", least=-36_000, most=36_000)] = 0.0


class ParallelMating(Mating):
    """The second as the cranks of a parallelogram hold it."""

    offset: complex | None
    rotation: float

    asks_height = False

    @property
    def placed_turn(self) -> float | None:
        """Against the first."""
        return self.rotation

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """Beside the first, turned as it is."""
        if self.offset is None:
            raise ParameterError("offset", None, "place_on_carrier", None)
        return centre + self.offset, rotation + self.rotation

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the second is turned against the first; its axis is for other mates to hold."""
        off = math.remainder(second[1] - first[1] - self.rotation, 2 * math.pi)
        return Standing(self.distance, off, 0.0)


class Parallel(MateKind[ParallelSpec, Any, Any]):
    """Anything and anything."""

    name, keys = "parallel", ParallelSpec

    def mating(self, keys: ParallelSpec, first: End[Any], second: End[Any]) -> ParallelMating:
        """Whatever the parts are."""
        x, y, z = keys.offset or (0.0, 0.0, 0.0)
        offset = None if keys.offset is None else complex(x, y)
        turn = math.radians(keys.rotation_deg)
        # both turn alike against whatever carries both
        return ParallelMating(*self.joined(keys), height=z, rolls="parallel", offset=offset, rotation=turn)

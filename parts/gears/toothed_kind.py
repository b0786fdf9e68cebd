"""What the kinds of gears and rings with involute teeth have in common: drawings, and what assemblies show of them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, TypeVar

from geometry.base.errors import ParameterError
from parts.base.kind import Kind, Others
from parts.keys.helix import ToothedKeys, idle_helix

if TYPE_CHECKING:
    from geometry.gears.teeth.ring import RingGear
    from geometry.gears.teeth.spur import SpurGear
    from geometry.solids.sketch import Sketch

K = TypeVar("K", bound=ToothedKeys)
T = TypeVar("T", bound="SpurGear | RingGear")


class ToothedKind(Kind[K, T]):
    """A gear or a ring."""

    drawing = "parts.gears.drawings"
    data_table = "parts.gears.data_tables"

    def idle(self, keys: K, others: Others) -> Iterator[ParameterError]:
        """Two helices without an angle."""
        return idle_helix(keys)

    def sketch(self, keys: K, thing: T) -> Sketch:
        """Circles for its teeth, those of a sector as they are."""
        from geometry.solids.sketch import Teeth, sketch_of_body

        solid = self.solid(keys, thing, 0.0)
        assert not solid.is_faced
        teeth = None if thing.sector else Teeth(thing.tip_radius, thing.root_radius, thing.reference_radius)
        return sketch_of_body(solid, teeth)

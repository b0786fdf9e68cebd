"""The part kind ``step_part``: somebody else's solid from a STEP file, like the motor that a gear sits on."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from msgspec import Meta, field
from msgspec.structs import replace as changed

from geometry.base.errors import ParameterError
from parts.base.content import content_beside
from parts.base.kind import Kind, Others
from parts.base.part_keys import MaterialKeys
from parts.keys.base import degrees, mm

if TYPE_CHECKING:
    from geometry.plane.offset_region import OffsetRegion
    from geometry.solids.faced import FacedBody

_MOST, MOST_BYTES = 1e6, 8_000_000
_Place = Annotated[float, mm("a coordinate in the file", least=-_MOST, most=_MOST)]
_Way = Annotated[float, Meta(ge=-_MOST, le=_MOST)]

_FILE = Meta(
    pattern=r"\.([sS][tT][eE]?[pP])\Z",
    max_length=200,
    description="STEP file, beside the scene's file or in a folder there; needs the extra cad",
    examples=["motor.step"],
)
_SOLID = Meta(ge=1, le=1000, description="which of the file's solids, from 1 on, where it has several", examples=[2])
_ORIGIN = mm("the part's origin in the file, which mates place")
_AXIS = Meta(description="direction of the part's axis in the file")
_ROTATION = degrees("turn of the part's x axis about its axis", least=-36_000, most=36_000)
_HELD = Meta(description="texts of files by their names, as reports keep them; what it lacks is read", examples=[{}])


class StepPartSpec(MaterialKeys, kw_only=True, tag_field="kind", tag="step_part"):
    """Keys of ``step_part``."""

    file: Annotated[str, _FILE]
    solid: Annotated[int, _SOLID] | None = None
    origin: Annotated[tuple[_Place, _Place, _Place], _ORIGIN] = (0.0, 0.0, 0.0)
    axis: Annotated[tuple[_Way, _Way, _Way], _AXIS] = (0.0, 0.0, 1.0)
    rotation_deg: Annotated[float, _ROTATION] = 0.0
    held: Annotated[dict[str, str], _HELD] = field(default_factory=dict)


class StepPart(Kind[StepPartSpec, "FacedBody"]):
    """A solid that is taken over as it is; its flat section is the circle about it."""

    name, keys, has_outline, unmoved = "step_part", StepPartSpec, False, "step_not_moved"

    def gathered(self, keys: StepPartSpec, folder: Path) -> StepPartSpec:
        """The keys with the file's text, and no other one."""
        text = keys.held.get(keys.file)
        return changed(keys, held={keys.file: _read(keys.file, folder) if text is None else text})

    def thing(self, keys: StepPartSpec, others: Others) -> FacedBody:
        """The body, in the part's frame."""
        from geometry.base.placement import Placement3
        from parts.solids.foreign import foreign_body

        size = math.hypot(*keys.axis)
        if not size:
            raise ParameterError("axis", list(keys.axis), "no_direction")
        x, y, z = (value / size for value in keys.axis)
        laid = Placement3.towards((x, y, z), math.radians(keys.rotation_deg), keys.origin).inverse()
        try:
            return foreign_body(keys.held[keys.file], laid, keys.solid)
        except ParameterError as refusal:
            if refusal.name == "solid":
                raise
            raise ParameterError("file", keys.file, refusal.code, None, **refusal.numbers) from refusal

    def section(self, keys: StepPartSpec, thing: FacedBody, offset: float) -> OffsetRegion:
        """The circle about it."""
        from geometry.plane.offset_region import OffsetRegion
        from geometry.plane.profile import Label, Region, circle

        return OffsetRegion(Region(circle(thing.section_reach(), Label.BODY), ()), offset, ())

    def solid(self, keys: StepPartSpec, thing: FacedBody, offset: float) -> FacedBody:
        """As it is."""
        return thing

    def height(self, keys: StepPartSpec, thing: FacedBody) -> float:
        """From its lowest to its highest place."""
        low, high = thing.levels()
        return high - low


STEP_PART = StepPart()


def _read(name: str, folder: Path) -> str:
    """The text of a file in a folder, or in one below it."""
    raw = content_beside(name, folder, MOST_BYTES)
    if len(raw) > MOST_BYTES:
        raise ParameterError("file", name, "too_large_step", None, most=MOST_BYTES)
    return raw.decode("ascii", "replace").replace("\ufffd", "?")

"""The part kind ``key``: a parallel key of DIN 6885 or GOST 23360, with round or square ends and chamfered edges."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta

from geometry.base.errors import ParameterError, limit
from geometry.base.record import Record, replace
from parts.base.kind import Kind, Others
from parts.base.part_keys import MaterialKeys
from parts.keys.base import either, part_mm, start
from parts.keys.pins import MARGIN

if TYPE_CHECKING:
    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile
    from geometry.solids.body import Body
    from geometry.solids.plate import Edge, PlateOutline
    from geometry.solids.sketch import Sketch


_SHAFT_DIAMETER = part_mm("of the shaft whose key it is by DIN 6885 and GOST 23360", above=0, example=18.0)
_CHAMFER = part_mm("of the edges of both faces; default: the standards' least", least=0, example=0.25)
_FORM = Meta(description="A (1 of GOST 23360): both ends round, B (2): none, C (3): the right one")


class KeySpec(MaterialKeys, kw_only=True, tag_field="kind", tag="key"):
    """Keys of ``key``."""

    length: Annotated[float, part_mm("length l along x, round ends included", above=0, example=20.0)]
    shaft_diameter: Annotated[float, _SHAFT_DIAMETER, start(18.0)] | None = None
    width: Annotated[float, part_mm("width b, or give shaft_diameter", above=0, example=6.0)] | None = None
    height: Annotated[float, part_mm("height h, or give shaft_diameter", above=0, example=6.0)] | None = None
    form: Annotated[Literal["A", "B", "C"], _FORM] = "A"
    chamfer: Annotated[float, _CHAMFER] | None = None


class Key(Record):
    """A key about its middle, its length along x, its height along z from 0; mm."""

    width: float
    height: float
    length: float
    chamfer: float
    round_ends: tuple[bool, bool]

    def outline(self) -> PlateOutline:
        """As it is seen from above."""
        from geometry.curves.line_arc import Arc, Line
        from geometry.solids.plate import PlateOutline

        radius = self.width / 2
        left, right = (side * self.length / 2 - side * radius * is_round
                       for side, is_round in zip((-1, 1), self.round_ends, strict=True))  # fmt: skip
        corners = [complex(left, -radius), complex(right, -radius), complex(right, radius), complex(left, radius)]
        edges: list[Edge] = []
        for k, (one, two) in enumerate(zip(corners, corners[1:] + corners[:1], strict=True)):
            if k % 2 and self.round_ends[k == 1]:
                edges.append(Arc((one + two) / 2, radius, -math.pi / 2 if k == 1 else math.pi / 2, math.pi))
            else:
                edges.append(Line(one, two))
        return PlateOutline(tuple(edges))


class KeyKind(Kind[KeySpec, Key]):
    """A parallel key."""

    name, keys = "key", KeySpec
    drawing = "parts.bodies.parallel_key_drawing"

    def thing(self, keys: KeySpec, others: Others) -> Key:
        """The key by its shaft or by its sizes, checked to be longer than its ends and thicker than its chamfers."""
        from geometry.solids.keyways import key_chamfer

        width, height = _section(keys)
        round_ends = keys.form == "A", keys.form != "B"
        if keys.length <= (least := width / 2 * sum(round_ends)):
            raise ParameterError("length", keys.length, "key_shorter_than_its_ends", limit(least * (1 + 1e-6), -1.0))
        chamfer = min(key_chamfer(width), height / 4) if keys.chamfer is None else keys.chamfer
        most = min(width, height, keys.length) / 2 * (1 - MARGIN)
        if chamfer > most:
            raise ParameterError("chamfer", chamfer, "chamfers_meet", limit(most, math.inf))
        return Key(width, height, keys.length, chamfer, round_ends)

    def section(self, keys: KeySpec, thing: Key, offset: float) -> OffsetRegion:
        """As it is seen from above."""
        return thing.outline().region(offset)

    def solid(self, keys: KeySpec, thing: Key, offset: float) -> Body:
        """With the chamfers of both faces."""
        from geometry.solids.hub_holes import HubHoles
        from geometry.solids.wheel import WheelShape, wheel_body, wheel_sections

        def moved(offset: float, depth: float) -> Profile:
            return thing.outline().region(offset - depth).region.outer

        shape = WheelShape(thing.height, chamfer_below=thing.chamfer, chamfer_above=thing.chamfer)
        return wheel_body(shape, wheel_sections(moved, min(thing.width, thing.length) / 2, HubHoles()), offset)

    def sketch(self, keys: KeySpec, thing: Key) -> Sketch | None:
        """As a key, which lies along x."""
        made = super().sketch(keys, thing)
        return None if made is None else replace(made, is_key=True)

    def height(self, keys: KeySpec, thing: Key) -> float:
        """h, mm."""
        return thing.height

    def is_plate(self, keys: KeySpec, thing: Key) -> bool:
        """Whether it has no chamfers."""
        return not thing.chamfer

    def numbers(self, keys: KeySpec) -> str:
        """b x h x l, as keys are ordered."""
        width, height = _section(keys)
        return f"{width:.4g}\u00d7{height:.4g}\u00d7{keys.length:.4g}"


KEY = KeyKind()


def _section(keys: KeySpec) -> tuple[float, float]:
    """Width and height, mm.

    Raises
    ------
    ParameterError
        They are told twice, one of them is missing, or no standard has such a shaft.
    """
    from geometry.solids.keyways import keyway_row

    sizes = {"width": keys.width, "height": keys.height}
    if keys.shaft_diameter is not None:
        for key, value in sizes.items():
            if value is not None:
                raise either(key, value, "shaft_diameter")
        try:
            row = keyway_row("GOST 23360", keys.shaft_diameter)
        except ParameterError as refusal:
            raise refusal.renamed("shaft_diameter") from refusal
        return row.width, row.height
    for key, value in sizes.items():
        if value is None:
            raise ParameterError(key, None, "one_of_two_is_missing", other="shaft_diameter")
    return keys.width or 0.0, keys.height or 0.0

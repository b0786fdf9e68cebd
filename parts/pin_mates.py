"""Mates of round pins: cycloidal disc in its pin ring, its eccentric and output pins, lantern and gear, loose pins."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, Struct

from parts.keys import mm

_MOST = 1e6
First = Annotated[str, Meta(description="instance that is already placed")]
Second = Annotated[str, Meta(description="instance that is placed by this mate")]
_Angle = Meta(ge=-36_000, le=36_000, description="turn about z", extra={"unit": "degrees"})
Eccentric = Annotated[
    float,
    Meta(ge=-360, le=360, description="direction of the eccentric, from the pins' axis", extra={"unit": "degrees"}),
]
Height = Annotated[float, mm("lower face of the second above that of the first", least=-_MOST, most=_MOST)]


class CycloidalPairSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="cycloidal_pair"):
    """A cycloidal disc (second) in its pin ring (first): eccentric distance and phase."""

    first: First
    second: Second
    direction_deg: Eccentric = 0.0
    turned_lobes: Annotated[
        int, Meta(ge=-10_000, le=10_000, description="turns the disc on by whole lobes: for holes that must line up")
    ] = 0
    height: Height | None = None


class EccentricBearingSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="eccentric_bearing"):
    """A cycloidal disc (second) on its eccentric (first), which drives it."""

    first: First
    second: Second
    height: Height = 0.0


class OutputPinsSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="output_pins"):
    """The pins of an output plate (second) in the holes of a cycloidal disc (first)."""

    first: First
    second: Second
    direction_deg: Eccentric = 0.0
    height: (
        Annotated[float, mm("plate above the disc; default: it carries the disc on its face", least=-_MOST, most=_MOST)]
        | None
    ) = None


class CoaxialSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="coaxial"):
    """The second instance on the axis of the first, free to turn."""

    first: First
    second: Second
    height: Height = 0.0
    rotation_deg: Annotated[float, _Angle] = 0.0


class PinSeatSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="pin_seat"):
    """A loose pin (second) in a seat or hole of a ring or plate (first)."""

    first: First
    second: Second
    number: Annotated[int, Meta(ge=1, le=1000, description="which seat, counted from the first one")] = 1
    height: Height = 0.0


class LanternPairSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="lantern_pair"):
    """A lantern (first) and its gear (second): exact centre distance and phase."""

    first: First
    second: Second
    direction_deg: Annotated[
        float, Meta(ge=-360, le=360, description="direction of the line of centres", extra={"unit": "degrees"})
    ] = 0.0
    height: (
        Annotated[
            float, mm("gear above the lantern's lower face; default: midway on the pins", least=-_MOST, most=_MOST)
        ]
        | None
    ) = None

"""Scene keys that give a wheel its body: web, hub, face chamfers."""

from __future__ import annotations

from typing import Annotated

from msgspec import Struct

from geometry.errors import ParameterError
from geometry.wheel import Hub, Web, WheelShape
from parts.keys import mm


class WebTable(Struct, forbid_unknown_fields=True):
    """The thin disk between rim and hub."""

    thickness: Annotated[float, mm("thickness of the web along the axis", above=0, most=10_000)]
    rim_diameter: Annotated[float, mm("inner diameter of the rim", above=0, most=100_000)]
    shift: Annotated[float, mm("how far the web stands above the middle", least=-10_000, most=10_000)] = 0.0


class HubTable(Struct, forbid_unknown_fields=True):
    """The hub about the bore."""

    diameter: Annotated[float, mm("outer diameter of the hub", above=0, most=100_000)]
    below: Annotated[float, mm("how far the hub stands out below", least=0, most=10_000)] = 0.0
    above: Annotated[float, mm("how far the hub stands out above", least=0, most=10_000)] = 0.0


class FaceChamferTable(Struct, forbid_unknown_fields=True):
    """45 degree chamfers along every edge of the end faces."""

    below: Annotated[float, mm("chamfer of the lower face: against the elephant foot", least=0, most=100)] = 0.0
    above: Annotated[float, mm("chamfer of the upper face", least=0, most=100)] = 0.0


FaceChamfer = Annotated[float, mm("45 degree chamfer along every edge of both end faces", least=0, most=100)]


def as_typed(spec: object, error: ParameterError) -> ParameterError:
    """A refusal of one face's chamfer in the key that the scene has: one number for both, or a table."""
    if error.name.startswith("face_chamfer.") and isinstance(getattr(spec, "face_chamfer", None), float):
        return ParameterError("face_chamfer", error.value, error.allowed)
    return error


def wheel_shape(
    face_width: float, web: WebTable | None, hub: HubTable | None, chamfer: float | FaceChamferTable
) -> WheelShape:
    """The keys of a wheel as its exact shape."""
    both = chamfer if isinstance(chamfer, FaceChamferTable) else FaceChamferTable(chamfer, chamfer)
    return WheelShape(
        face_width,
        None if web is None else Web(web.thickness, web.rim_diameter, web.shift),
        None if hub is None else Hub(hub.diameter, hub.below, hub.above),
        both.below,
        both.above,
    )

"""Scene keys of the pairs of gears among the mates."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, Struct

from parts.keys import mm

_First = Annotated[str, Meta(description="instance that is already placed")]
_Second = Annotated[str, Meta(description="instance that is brought into mesh")]
_Direction = Annotated[
    float, Meta(ge=-360, le=360, description="direction of the line of centres", extra={"unit": "degrees"})
]
_Distance = Annotated[float, mm("centre distance; default: that of the shifts, without backlash", above=0, most=1e6)]
_Backlash = Annotated[
    float,
    mm("normal backlash j_bn = j_wt cos(alpha_wt) cos(beta_b), at right angles to the flanks: thins both gears by half",
       least=0, most=100),
]  # fmt: skip


class ExternalGearPairSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="external_gear_pair"):
    """Two external spur gears in mesh: exact centre distance, tip shortening, phase."""

    first: _First
    second: _Second
    direction_deg: _Direction = 0.0
    working_centre_distance: _Distance | None = None
    normal_backlash: _Backlash | None = None


class InternalGearPairSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="internal_gear_pair"):
    """A pinion in a ring gear, in either order."""

    first: _First
    second: _Second
    direction_deg: _Direction = 0.0
    working_centre_distance: _Distance | None = None
    normal_backlash: _Backlash | None = None


class RackPairSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="rack_pair"):
    """A gear (first) and a rack (second) that moves across the direction from the gear to it."""

    first: _First
    second: _Second
    direction_deg: _Direction = 0.0
    working_centre_distance: (
        Annotated[float, mm("from the gear's axis to the rack's datum line; default: r + x m", above=0, most=1e6)]
        | None
    ) = None
    normal_backlash: _Backlash | None = None

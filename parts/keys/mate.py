"""Keys that kinds of mates share: each takes what it has of this chain and says the rest itself."""

from __future__ import annotations

import math
from typing import Annotated

from msgspec import Meta

from parts.base.mate import MateKeys
from parts.keys.base import degrees, mm

_FAR, _TURN = 1e6, 360.0
Direction = Annotated[float, degrees("direction of the line of centres", least=-360, most=360)]
Distance = Annotated[
    float, mm("centre distance; default: that of the shifts, without backlash", above=0, most=_FAR, example=60.5)
]


def direction(text: str) -> Meta:
    """A direction with another meaning."""
    return degrees(text, least=-360, most=360)


def backlash(text: str) -> Meta:
    """A normal backlash with another meaning."""
    return mm(text, least=0, most=100, example=0.1)


def further(direction_deg: float, angle: float) -> float:
    """A direction so many degrees on, within the range of the key; turned back by whole turns only beyond that."""
    found = direction_deg + angle
    return found if abs(found) <= _TURN else math.fmod(found, _TURN)


def height(text: str, most: float = _FAR, example: float = 0.0) -> Meta:
    """A height with another meaning."""
    return mm(text, least=-most, most=most, example=example)


Height = Annotated[float, height("lower face of the second above that of the first")]


class AboveKeys(MateKeys, kw_only=True):
    """The second at a height above the first."""

    height: Height = 0.0


class GearPairKeys(MateKeys, kw_only=True):
    """Two gears in mesh."""

    second: Annotated[str, Meta(description="instance that is brought into mesh")]
    direction_deg: Direction = 0.0


_NORMAL_BACKLASH = backlash(
    "normal backlash j_bn = j_wt cos(alpha_wt) cos(beta_b), at right angles to the flanks: thins both gears by half"
)


class InvolutePairKeys(GearPairKeys, kw_only=True):
    """Two gears with involute teeth."""

    working_centre_distance: Distance | None = None
    normal_backlash: Annotated[float, _NORMAL_BACKLASH] | None = None

    def leaves(self, backlash: float) -> bool:
        """Whether gears with so much normal backlash, mm, may be thinned to what is asked for."""
        return self.normal_backlash is None or backlash <= self.normal_backlash

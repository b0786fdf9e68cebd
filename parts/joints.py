"""Mates that are no pair of involute gears: what each joins, and what makes a mating of it.

A mate of this registry places its second instance and may check its own contact; it changes no part.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from msgspec import Struct

from parts.cam_mate import CamFollowerSpec, cam_follower_mating
from parts.fixed_mate import FixedSpec, fixed_mating
from parts.mate_kinds import Mating


@dataclass(frozen=True, slots=True)
class Joint:
    """A kind of mate: its keys, the kinds of parts it joins (first and second; ``None``: any), and its mating.

    ``mating`` takes the keys and both parts as their kind's check gives them.

    Raises ``ParameterError`` with the key of the second part, or of the mate as ``mate.KEY``.
    """

    spec: type[Struct]
    joins: tuple[tuple[str, str], ...] | None
    mating: Callable[[Any, Any, Any], Mating]


_FOLLOWERS = ("follower", "follower_arm", "roller")
JOINTS: dict[str, Joint] = {
    "cam_follower": Joint(CamFollowerSpec, tuple(("cam", f) for f in _FOLLOWERS), cam_follower_mating),
    "fixed": Joint(FixedSpec, None, fixed_mating),
}

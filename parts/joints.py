"""Mates that are no pair of involute gears: what each joins, and what makes a mating of it.

A mate of this registry places its second instance and may check its own contact; it changes no part.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from msgspec import Struct

from parts import pin_mates
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


def _later(module: str, name: str) -> Callable[[Any, Any, Any], Mating]:
    """What makes a mating, loaded when a scene has one."""

    def mating(mate: Any, first: Any, second: Any) -> Mating:
        made: Mating = getattr(import_module(module), name)(mate, first, second)
        return made

    return mating


_CYCLOIDAL, _LANTERN = "parts.cycloidal_matings", "parts.lantern_mating"
JOINTS: dict[str, Joint] = {
    "fixed": Joint(FixedSpec, None, fixed_mating),
    "coaxial": Joint(pin_mates.CoaxialSpec, None, _later(_LANTERN, "coaxial_mating")),
    "cycloidal_pair": Joint(
        pin_mates.CycloidalPairSpec, (("pin_ring", "cycloidal_disc"),), _later(_CYCLOIDAL, "cycloidal_mating")
    ),
    "eccentric_bearing": Joint(
        pin_mates.EccentricBearingSpec, (("eccentric", "cycloidal_disc"),), _later(_CYCLOIDAL, "bearing_mating")
    ),
    "output_pins": Joint(
        pin_mates.OutputPinsSpec, (("cycloidal_disc", "output_plate"),), _later(_CYCLOIDAL, "output_mating")
    ),
    "pin_seat": Joint(
        pin_mates.PinSeatSpec, tuple((p, "pin") for p in pin_mates.PIN_HOLDERS), _later(_LANTERN, "pin_seat_mating")
    ),
    "lantern_pair": Joint(
        pin_mates.LanternPairSpec, (("lantern_wheel", "lantern_gear"),), _later(_LANTERN, "lantern_mating")
    ),
}

"""Mates that are no pair of involute gears: what each joins, and what makes a mating of it.

A mate of this registry places its second instance and may check its own contact; it changes no part.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from msgspec import Struct

from parts import pin_mates
from parts.cycloidal_matings import bearing_mating, cycloidal_mating, output_mating
from parts.fixed_mate import FixedSpec, fixed_mating
from parts.lantern_mating import coaxial_mating, lantern_mating, pin_seat_mating
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


JOINTS: dict[str, Joint] = {
    "fixed": Joint(FixedSpec, None, fixed_mating),
    "coaxial": Joint(pin_mates.CoaxialSpec, None, coaxial_mating),
    "cycloidal_pair": Joint(pin_mates.CycloidalPairSpec, (("pin_ring", "cycloidal_disc"),), cycloidal_mating),
    "eccentric_bearing": Joint(pin_mates.EccentricBearingSpec, (("eccentric", "cycloidal_disc"),), bearing_mating),
    "output_pins": Joint(pin_mates.OutputPinsSpec, (("cycloidal_disc", "output_plate"),), output_mating),
    "pin_seat": Joint(pin_mates.PinSeatSpec, tuple((p, "pin") for p in pin_mates.PIN_HOLDERS), pin_seat_mating),
    "lantern_pair": Joint(pin_mates.LanternPairSpec, (("lantern_wheel", "lantern_gear"),), lantern_mating),
}

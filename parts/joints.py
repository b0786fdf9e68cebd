"""Mates that are no pair of involute gears: what each joins, and what makes a mating of it.

A mate of this registry places its second instance and may check its own contact; it changes no part but in
its thinning for backlash.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from msgspec import Struct

from parts.fixed_mate import FixedSpec, fixed_mating
from parts.mate_kinds import Mating
from parts.noncircular_mate import NoncircularGearPairSpec, noncircular_mating


@dataclass(frozen=True, slots=True)
class Joint:
    """A kind of mate: its keys, the kinds of parts it joins (first and second; ``None``: any), and its mating.

    ``mating`` takes the keys and both parts as their kind's check gives them. ``thins``: its ``normal_backlash`` thins
    both parts by half, as that of gear pairs does.

    Raises ``ParameterError`` with the key of the second part, or of the mate as ``mate.KEY``.
    """

    spec: type[Struct]
    joins: tuple[tuple[str, str], ...] | None
    mating: Callable[[Any, Any, Any], Mating]
    thins: bool = False


JOINTS: dict[str, Joint] = {
    "fixed": Joint(FixedSpec, None, fixed_mating),
    "noncircular_gear_pair": Joint(
        NoncircularGearPairSpec, (("noncircular_gear", "noncircular_gear"),), noncircular_mating, thins=True
    ),
}

"""Mates that are no pair of involute gears: what each joins, and where its keys and what makes a mating of it live.

A mate of this registry places its second instance and may check its own contact; it changes no part but in
its thinning for backlash.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

from msgspec import Struct

from parts.mate_kinds import Mating


@dataclass(frozen=True, slots=True)
class Joint:
    """A kind of mate: the kinds of parts it joins (first and second; ``None``: any), its keys, its mating.

    ``spec_at`` and ``mating_at``: module and name; loaded when a scene has such a mate.
    ``thins``: its ``normal_backlash`` thins both parts by half, as that of gear pairs does.
    """

    joins: tuple[tuple[str, str], ...] | None
    spec_at: tuple[str, str]
    mating_at: tuple[str, str]
    thins: bool = False

    @property
    def spec(self) -> type[Struct]:
        """Its keys."""
        spec: type[Struct] = _loaded(self.spec_at)
        return spec

    @property
    def mating(self) -> Callable[[Any, Any, Any], Mating]:
        """Takes the keys and both parts as their kind's check gives them.

        Raises ``ParameterError`` with the key of the second part, or of the mate as ``mate.KEY``.
        """
        mating: Callable[[Any, Any, Any], Mating] = _loaded(self.mating_at)
        return mating


def _loaded(place: tuple[str, str]) -> Any:
    return getattr(import_module(place[0]), place[1])


def _joint(module: str, spec: str, mating: str, joins: tuple[tuple[str, str], ...] | None) -> Joint:
    """A kind of mate that lives in one module."""
    return Joint(joins, (module, spec), (module, mating))


_FOLLOWERS = ("follower", "follower_arm", "roller")
_PIN_HOLDERS = ("pin_ring", "output_plate", "lantern_wheel")
_CYCLOIDAL, _LANTERN = "parts.cycloidal_matings", "parts.lantern_mating"
JOINTS: dict[str, Joint] = {
    "cam_follower": _joint(
        "parts.cam_mate",
        "CamFollowerSpec",
        "cam_follower_mating",
        tuple((cam, follower) for cam in ("cam", "groove_cam", "linkage_cam") for follower in _FOLLOWERS),
    ),
    "linkage_member": _joint(
        "parts.linkage_member",
        "LinkageMemberSpec",
        "linkage_member_mating",
        tuple(("linkage_cam", member) for member in ("plate", "follower_arm")),
    ),
    "wedge_follower": _joint(
        "parts.wedge_mate",
        "WedgeFollowerSpec",
        "wedge_mating",
        tuple(("wedge_cam", follower) for follower in _FOLLOWERS),
    ),
    "conjugate_cams": _joint(
        "parts.positive_mates", "ConjugateCamsSpec", "conjugate_mating", (("cam", "conjugate_cam"),)
    ),
    "cam_yoke": _joint("parts.positive_mates", "CamYokeSpec", "yoke_mating", (("cam", "yoke_frame"),)),
    "fixed": _joint("parts.fixed_mate", "FixedSpec", "fixed_mating", None),
    "coaxial": Joint(None, ("parts.pin_mates", "CoaxialSpec"), (_LANTERN, "coaxial_mating")),
    "cycloidal_pair": Joint(
        (("pin_ring", "cycloidal_disc"),),
        ("parts.pin_mates", "CycloidalPairSpec"),
        (_CYCLOIDAL, "cycloidal_mating"),
    ),
    "eccentric_bearing": Joint(
        (("eccentric", "cycloidal_disc"),),
        ("parts.pin_mates", "EccentricBearingSpec"),
        (_CYCLOIDAL, "bearing_mating"),
    ),
    "output_pins": Joint(
        (("cycloidal_disc", "output_plate"),), ("parts.pin_mates", "OutputPinsSpec"), (_CYCLOIDAL, "output_mating")
    ),
    "pin_seat": Joint(
        tuple((holder, "pin") for holder in _PIN_HOLDERS),
        ("parts.pin_mates", "PinSeatSpec"),
        (_LANTERN, "pin_seat_mating"),
    ),
    "lantern_pair": Joint(
        (("lantern_wheel", "lantern_gear"),), ("parts.pin_mates", "LanternPairSpec"), (_LANTERN, "lantern_mating")
    ),
    "noncircular_gear_pair": Joint(
        (("noncircular_gear", "noncircular_gear"),),
        ("parts.noncircular_mate", "NoncircularGearPairSpec"),
        ("parts.noncircular_mate", "noncircular_mating"),
        thins=True,
    ),
}

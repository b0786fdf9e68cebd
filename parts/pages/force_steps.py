"""Steps of the load of a pair of gears: power, torques on both shafts, forces between the teeth."""

from __future__ import annotations

import math
from typing import Annotated, Protocol

from msgspec import Struct

from geometry.base.errors import ParameterError
from geometry.gears.pairs.external import ExternalPair
from geometry.gears.pairs.internal import InternalPair
from geometry.gears.pairs.rack import RackPair
from geometry.gears.pairs.tooth_forces import tooth_forces
from parts.base.refusal import REMOVED
from parts.keys.base import size
from parts.pages.contact_steps import Helical
from parts.pages.page import Sheet

_SPEED = "speed of the first gear: adds the speeds of sliding"
_TORQUE = "torque on the first gear, which drives: adds the forces between the teeth"
_POWER = "power that the first gear takes in, by its speed: in place of its torque"


Speed = Annotated[float, size("rpm", _SPEED, above=0, most=1e6)] | None
Torque = Annotated[float, size("N*m", _TORQUE, above=0, most=1e9)] | None
Power = Annotated[float, size("W", _POWER, above=0, most=1e9)] | None


class DrivenKeys(Struct, kw_only=True):
    """Keys of a pair at work."""

    speed_rpm: Speed = None
    torque: Torque = None
    power: Power = None


class Driven(Protocol):
    """What has these keys."""

    speed_rpm: float | None
    torque: float | None
    power: float | None


def asked_torque(keys: Driven) -> float | None:
    """The torque on what drives, N*m, where it is given: by itself or by a power.

    Raises
    ------
    ParameterError
        A torque and a power, or a power without a speed.
    """
    if keys.power is None:
        return keys.torque
    if keys.torque is not None:
        raise ParameterError("power", keys.power, "other_is_given", REMOVED, other="torque")
    if keys.speed_rpm is None:
        raise ParameterError("power", keys.power, "needs_other", REMOVED, other="speed_rpm")
    return keys.power / (math.pi * keys.speed_rpm / 30)


def driving_torque(page: Sheet, keys: Driven) -> float | None:
    """The torque on the first gear, N*m, under a heading of its own, where the load is given."""
    torque = asked_torque(keys)
    if torque is not None:
        page.section("Torques and forces, without friction")
        torque_steps(page, keys, torque, "gear_torque", 1)
    return torque


def torque_steps(page: Sheet, keys: Driven, torque: float, name: str, gear: int = 0) -> None:
    """The torque that drives, N*m, as the term ``name`` has it, and the power of it."""
    if keys.power is not None:
        page.add("pair_power", keys.power, given=True)
        page.add(name, torque, "30 * {P} / (pi * {n1})", gear=gear)
        return
    page.add(name, torque, gear=gear, given=True)
    if keys.speed_rpm is not None:
        page.add("pair_power", torque * math.pi * keys.speed_rpm / 30, "{T1} * pi * {n1} / 30")


def both_speeds(page: Sheet, speeds: tuple[float, float], formula: str = "{n1} / {u}") -> None:
    """Speeds of what drives, as given, and of what is driven, rpm, under a heading of their own."""
    page.section("Speeds")
    page.add("gear_speed", speeds[0], gear=1, given=True)
    page.add("gear_speed", speeds[1], formula, gear=2)


def force_steps(page: Sheet, pair: ExternalPair | InternalPair | RackPair, helical: Helical, keys: DrivenKeys) -> None:
    """Torques and forces where the load is given: by a torque on the first gear, or by its power and speed."""
    torque = driving_torque(page, keys)
    if torque is None:
        return
    radius = pair.working_radii[0]
    if not isinstance(pair, RackPair):
        page.add("gear_torque", torque * pair.gear_ratio, "{T1} * {u}", gear=2)
    helix = math.atan(math.tan(helical.angle) * radius / pair.gears[0].reference_radius)
    forces = tooth_forces(torque, radius, pair.working_pressure_angle, helix, double=helical.face.helix.double)
    page.add("circumferential_force", forces.circumferential, "1000 * {T1} / {r_w1}")
    page.add("radial_force", forces.radial, "{F_t} * tan({alpha_w})")
    whole = "sqrt({F_t}**2 + {F_r}**2)"
    if helical.angle:
        slant = "{F_t} * {r_w1} / {r1} * tan(abs({beta}))"
        page.add("axial_force", forces.axial, "" if helical.face.helix.double else slant)
        # both halves of double helical teeth together
        last = f"({slant})" if helical.face.helix.double else "{F_a}"
        whole = f"sqrt({{F_t}}**2 + {{F_r}}**2 + {last}**2)"
    page.add("normal_force", forces.normal, whole)

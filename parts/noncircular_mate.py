"""Two noncircular gears in mesh: their centrodes roll on each other, at any angle of the first one."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta, Struct

from geometry.errors import ParameterError, format_value
from parts.joined import Joined
from parts.keys import mm
from parts.standing import Standing

if TYPE_CHECKING:
    from geometry.findings import Finding
    from geometry.gears.mesh_search import PairContact
    from geometry.gears.noncircular import NoncircularGear
    from geometry.gears.noncircular_pair import NoncircularPair


class NoncircularGearPairSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="noncircular_gear_pair"):
    """Two noncircular gears of one pair: exact centre distance, and the phase at which their centrodes touch."""

    first: Annotated[str, Meta(description="instance that is already placed")]
    second: Annotated[str, Meta(description="instance that is brought into mesh")]
    direction_deg: Annotated[
        float, Meta(ge=-360, le=360, description="direction of the line of centres", extra={"unit": "degrees"})
    ] = 0.0
    normal_backlash: (
        Annotated[float, mm("backlash along the line of action: thins both gears by half", least=0, most=100)] | None
    ) = None


@dataclass(frozen=True, slots=True)
class NoncircularMating(Joined):
    """A driver and its mate in either order, or two equal drivers."""

    gears: NoncircularPair
    kind: str = "noncircular_gear_pair"

    @property
    def distance(self) -> float:
        """Centre distance, mm."""
        return self.gears.centre_distance

    @property
    def module(self) -> float:
        """m, mm."""
        return self.gears.first.module

    @property
    def first_teeth(self) -> int:
        """Number of teeth of the placed gear."""
        return self.gears.first.number_of_teeth

    @property
    def normal_backlash(self) -> float:
        """j_bn, mm: the thinning of both gears along the line of action."""
        return self.gears.normal_backlash

    @property
    def ratio(self) -> float:
        """Of whole turns: the mean of a ratio that changes."""
        return -self.gears.first.number_of_teeth / self.gears.second.number_of_teeth

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The second gear beyond the line of centres, its centrode on that of the first."""
        return centre + cmath.rect(self.distance, direction), self.gears.second_rotation(rotation, direction)

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """Centre distance, and the second gear's turn off the middle of its backlash: only this phase fits."""
        direction = cmath.phase(second[0] - first[0])
        turn = math.remainder(second[1] - self.gears.second_rotation(first[1], direction), 2 * math.pi)
        symmetry = 2 * math.pi / self.gears.second.count
        # no line of action is farther from the axis
        arm = self.gears.second.radii[1]
        return Standing(
            direction,
            abs(second[0] - first[0]),
            math.remainder(turn, symmetry),
            max(self.normal_backlash, 0.0) / (2 * arm),
            arm,
        )

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one whole turn of the first gear, or the part of it after which all comes again."""
        from geometry.gears.noncircular_contact import noncircular_contact

        return noncircular_contact(self.gears, phase_off, distance_off, tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """Teeth that part, with the least contact ratio."""
        return self.gears.findings()

    def quantities(self) -> dict[str, Any]:
        """Centre distance, the ratio's range, the least contact ratio."""
        least, greatest = self.gears.ratio_range
        return {
            "centre_distance": self.distance,
            "least_ratio": least,
            "greatest_ratio": greatest,
            "least_contact_ratio": self.gears.least_contact_ratio,
            "normal_backlash": self.normal_backlash,
        }


def noncircular_mating(mate: NoncircularGearPairSpec, first: NoncircularGear, second: NoncircularGear) -> Any:
    """The mating of two gears.

    Raises
    ------
    ParameterError
        They are not one pair; names the second part's key, and the value that works.
    """
    from geometry.gears.noncircular_pair import NoncircularPair

    one, two = first.pairing, second.pairing
    assert one is not None
    assert two is not None
    if not one.is_like(two):
        raise _unlike(first, second)
    if (first.first_tooth == second.first_tooth) and not one.twins_mesh:
        role = "mate" if first.first_tooth == 0 else "driver"
        lobes = one.lobes[0]
        odd = max(1, (one.teeth[0] // lobes) | 1)
        reason = "two gears of one role mesh only where a tooth on the long radius meets a space on the short one"
        more = f" (as of {odd * lobes} teeth)" if one.is_self_mating else ""
        here = "driver" if role == "mate" else "mate"
        raise ParameterError("role", here, f'{reason}{more}; "{role}" works')
    for key, wanted in (
        ("pressure_angle_deg", math.degrees(first.rack.pressure_angle)),
        # a part that meshes with itself has none
        ("profile_shift_coefficient", 0.0 if first is second else -first.profile_shift_coefficient + 0.0),
    ):
        found = math.degrees(second.rack.pressure_angle) if key.startswith("pressure") else getattr(second, key)
        if not math.isclose(found, wanted, abs_tol=1e-12):
            raise ParameterError(key, found, f"must fit its mate; {format_value(wanted)} works")
    return NoncircularMating(mate.first, mate.second, mate.direction_deg, 0.0, NoncircularPair(first, second))


def _unlike(first: NoncircularGear, second: NoncircularGear) -> ParameterError:
    """The first key in which the second gear is not of the first one's pair."""
    one: Any = first.pairing
    two: Any = second.pairing
    # the second tells the pair as its own role sees it
    own = 1 if second.first_tooth else 0
    for key, place in (("number_of_teeth", own), ("mate_number_of_teeth", 1 - own)):
        if one.teeth[place] != two.teeth[place]:
            text = f"is not of the first gear's pair; {one.teeth[place]} works"
            return ParameterError(key, two.teeth[place], text)
    mine, theirs = getattr(one.centrode, "eccentricity", None), getattr(two.centrode, "eccentricity", None)
    if mine is not None and theirs is not None and one.lobes == two.lobes:
        if not math.isclose(mine, theirs, rel_tol=1e-9, abs_tol=1e-9):
            text = f"the centrodes differ in shape (axis_ratio or eccentricity); {format_value(mine)} works"
            return ParameterError("eccentricity", theirs, text)
        if not math.isclose(first.module, second.module, rel_tol=1e-9):
            text = f"is not of the first gear's pair; {format_value(first.module)} works"
            return ParameterError("module", second.module, text)
    text = "is not of the same pair: centrode, its shape, module and numbers of teeth must be the first one's"
    return ParameterError("centrode", _described(two), f"{text}, {_described(one)}")


def _described(pairing: Any) -> str:
    z_1, z_2 = pairing.teeth
    return f"z {z_1}/{z_2}, a {pairing.centre_distance:.6g} mm"

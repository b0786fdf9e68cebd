"""Two noncircular gears in mesh: their centrodes roll on each other, at any angle of the first one."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any

from geometry.base.errors import Nearest, ParameterError
from parts.base.mate import End, Pose, Standing, Toothed
from parts.keys.mate import GearPairKeys, backlash
from parts.mates.gear_pair import GearPair

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.gears.mesh.search import PairContact
    from geometry.gears.noncircular.gear import NoncircularGear
    from geometry.gears.noncircular.pair import NoncircularPair
    from geometry.gears.noncircular.pairing import Pairing


_NORMAL_BACKLASH = backlash("backlash along the line of action: thins both gears by half of it")


class NoncircularGearPairSpec(GearPairKeys, tag="noncircular_gear_pair", kw_only=True):
    """Keys of ``noncircular_gear_pair``."""

    normal_backlash: Annotated[float, _NORMAL_BACKLASH] | None = None


class NoncircularMating(Toothed):
    """A driver and its mate in either order, or two equal drivers."""

    gears: NoncircularPair

    uneven = True

    def partner(self, driver: str, rotation: float, direction: float) -> float:
        """By the arcs that have rolled."""
        turned = self.gears.second_rotation if driver == self.first else self.gears.first_rotation
        return turned(rotation, direction)

    def second_rotation(self, rotation: float, direction: float) -> float:
        """Its centrode on that of the first."""
        return self.gears.second_rotation(rotation, direction)

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and the second gear's turn off the middle of its backlash: only this phase fits."""
        # no line of action is farther from the axis
        return self.turned_off(first, second, 2 * math.pi / self.gears.second.count, self.gears.second.radii[1])

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one whole turn of the first gear, or the part of it after which all comes again."""
        from geometry.gears.noncircular.contact import noncircular_contact

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


class NoncircularGearPair(GearPair[NoncircularGearPairSpec, "NoncircularGear", "NoncircularGear"]):
    """Two gears of one pair."""

    name, keys = "noncircular_gear_pair", NoncircularGearPairSpec
    joins = (("noncircular_gear", "noncircular_gear"),)

    def check(self, keys: NoncircularGearPairSpec, first: Any, second: Any) -> None:
        """Both tell one ratio: what else makes them a pair their centrodes tell."""
        super().check(keys, first, second)
        if not first.centrode == second.centrode == "ratio":
            return
        for key in ("ratio_cosines", "ratio_sines"):
            mine, theirs = ([*(getattr(own, key) or ())] for own in (first, second))
            both = zip(mine, theirs, strict=False)
            if len(mine) != len(theirs) or not all(math.isclose(a, b, rel_tol=1e-9, abs_tol=1e-9) for a, b in both):
                raise ParameterError(key, theirs, "other_centrode_shape", Nearest(mine or None))

    def build(self, end: End[Any]) -> object:
        """All teeth of the gear; there is one centre distance."""
        return end.thing.outline

    def cosine(self, first: End[NoncircularGear], second: End[NoncircularGear]) -> float:
        """Of the rack."""
        return math.cos(first.thing.rack.pressure_angle)

    def mating(
        self, keys: NoncircularGearPairSpec, first: End[NoncircularGear], second: End[NoncircularGear]
    ) -> NoncircularMating:
        """They are one pair, and their teeth meet spaces."""
        from geometry.gears.noncircular.pair import NoncircularPair

        _check_pair(first, second)
        gears = NoncircularPair(first.thing, second.thing)
        return NoncircularMating(
            *self.joined(keys),
            distance=gears.centre_distance,
            module=gears.first.module,
            # of whole turns: the mean of a ratio that changes
            rolls="external",
            teeth=(gears.first.number_of_teeth, gears.second.number_of_teeth),
            normal_backlash=gears.normal_backlash,
            gears=gears,
        )


def _check_pair(here: End[NoncircularGear], there: End[NoncircularGear]) -> None:
    """Refuse the second's key in which two gears are not one pair."""
    first, second = here.thing, there.thing
    one, two = first.pairing, second.pairing
    assert one is not None
    assert two is not None
    if not one.is_like(two):
        raise _unlike(here, there, one, two)
    if first.first_tooth == second.first_tooth and not one.twins_mesh:
        role, other = ("driver", "mate") if first.first_tooth == 0 else ("mate", "driver")
        if not one.is_self_mating:
            raise ParameterError("role", role, "one_role_does_not_mesh", Nearest(other))
        teeth = one.lobes[0] * max(1, (one.teeth[0] // one.lobes[0]) | 1)
        raise ParameterError("role", role, "one_role_meshes_with_teeth", Nearest(other), teeth=teeth)
    angles = math.degrees(second.rack.pressure_angle), math.degrees(first.rack.pressure_angle)
    # a part that meshes with itself has no shift
    wanted = 0.0 if first is second else -first.profile_shift_coefficient + 0.0
    for key, found, fitting in (
        ("pressure_angle_deg", *angles),
        ("profile_shift_coefficient", second.profile_shift_coefficient, wanted),
    ):
        if not math.isclose(found, fitting, abs_tol=1e-12):
            raise ParameterError(key, found, "not_of_its_mate", Nearest(fitting))


def _unlike(first: End[NoncircularGear], second: End[NoncircularGear], one: Pairing, two: Pairing) -> ParameterError:
    """The first key in which the second gear is not of the first one's pair."""
    from geometry.kinematics.centrodes import LobedEllipse
    from parts.gears.noncircular_gear.part import NoncircularGearSpec

    # the second tells the pair as its own role sees it
    own = 1 if second.thing.first_tooth else 0
    for key, place in (("number_of_teeth", own), ("mate_number_of_teeth", 1 - own)):
        if one.teeth[place] != two.teeth[place]:
            return ParameterError(key, two.teeth[place], "not_of_the_pair", Nearest(one.teeth[place]))
    mine, theirs, keys = one.centrode, two.centrode, (first.keys, second.keys)
    if isinstance(mine, LobedEllipse) and isinstance(theirs, LobedEllipse) and one.lobes == two.lobes:
        if not math.isclose(mine.eccentricity, theirs.eccentricity, rel_tol=1e-9, abs_tol=1e-9):
            assert isinstance(keys[0], NoncircularGearSpec)
            assert isinstance(keys[1], NoncircularGearSpec)
            key = keys[1].slender_key
            wanted = mine.eccentricity if key == "eccentricity" else keys[0].axis_ratio
            given = theirs.eccentricity if key == "eccentricity" else keys[1].axis_ratio
            return ParameterError(key, given, "other_centrode_shape", None if wanted is None else Nearest(wanted))
        modules = first.thing.module, second.thing.module
        if not math.isclose(*modules, rel_tol=1e-9):
            return ParameterError("module", modules[1], "not_of_the_pair", Nearest(modules[0]))
    return ParameterError("centrode", _described(two), "not_of_the_pair_at_all", pair=_described(one))


def _described(pairing: Pairing) -> str:
    z_1, z_2 = pairing.teeth
    return f"z {z_1}/{z_2}, a {pairing.centre_distance:.6g} mm"

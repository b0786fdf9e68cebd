"""The mate ``cycloidal_gear_pair``: a wheel and a pinion of clockwork, each drawn by the other's rolling circle."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Struct

from geometry.base.errors import Nearest, ParameterError
from parts.base.mate import End, Pose, Standing, Toothed
from parts.gears.cycloidal_gear.part import CycloidalGearSpec
from parts.keys.mate import GearPairKeys, backlash
from parts.mates.gear_pair import GearPair
from parts.mates.sizes import same_size

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.gears.cycloidal.gear import CycloidalGear
    from geometry.gears.cycloidal.pair import CycloidalPair
    from geometry.gears.mesh.search import PairContact


_NORMAL_BACKLASH = backlash("backlash along the pitch circles: thins both gears by half of it")


class CycloidalGearPairSpec(GearPairKeys, tag="cycloidal_gear_pair", kw_only=True):
    """Keys of ``cycloidal_gear_pair``."""

    normal_backlash: Annotated[float, _NORMAL_BACKLASH] | None = None


class CycloidalGearMating(Toothed):
    """Two gears whose pitch circles roll on each other."""

    gears: CycloidalPair
    in_scheme = True

    def second_rotation(self, rotation: float, direction: float) -> float:
        """A space where the first has a tooth."""
        return self.gears.second_rotation(rotation, direction)

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and the second's turn off the middle of the backlash."""
        # normals of the flanks pass through the pitch point
        return self.turned_off(first, second, self.gears.second.pitch_angle, self.gears.second.pitch_radius)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one pitch."""
        from geometry.gears.cycloidal.pair import CycloidalMesh

        return CycloidalMesh(self.gears, phase_off, distance_off).contact(tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """A drive that is interrupted, tips that strike the roots."""
        return self.gears.findings()

    def quantities(self) -> dict[str, Any]:
        """Centre distance, ratio, and how contact lies about the line of centres."""
        gears = self.gears
        return {
            "gear_ratio": gears.second.number_of_teeth / gears.first.number_of_teeth,
            "working_centre_distance": self.distance,
            "contact_ratio": gears.contact_ratio,
            "approach_ratio": gears.approach_ratio,
            "recess_ratio": gears.recess_ratio,
            "normal_backlash": self.normal_backlash,
        }


class CycloidalGearPair(GearPair[CycloidalGearPairSpec, "CycloidalGear", "CycloidalGear"]):
    """Two cycloidal gears of one module and the same two rolling circles."""

    name, keys = "cycloidal_gear_pair", CycloidalGearPairSpec
    joins = (("cycloidal_gear", "cycloidal_gear"),)

    def check(self, keys: CycloidalGearPairSpec, first: Struct, second: Struct) -> None:
        """The teeth that each is made for are those of the other, unless circles of their own say how both roll."""
        assert isinstance(first, CycloidalGearSpec)
        assert isinstance(second, CycloidalGearSpec)
        for own, other, owner in ((first, second, "first."), (second, first, "")):
            of_teeth = own.tip_rolling_diameter is None and other.root_rolling_diameter is None
            if of_teeth and own.module == other.module and own.mate_number_of_teeth != other.number_of_teeth:
                cure = Nearest(other.number_of_teeth)
                raise ParameterError(f"{owner}mate_number_of_teeth", own.mate_number_of_teeth, "not_of_its_mate", cure)

    def build(self, end: End[Any]) -> object:
        """The gear, checked to have teeth; there is one centre distance."""
        from geometry.gears.cycloidal.gear import checked_cycloidal_gear

        return checked_cycloidal_gear(end.thing)

    def mating(
        self, keys: CycloidalGearPairSpec, first: End[CycloidalGear], second: End[CycloidalGear]
    ) -> CycloidalGearMating:
        """Tips of each touch roots of the other that the same circle has drawn."""
        from geometry.gears.cycloidal.pair import CycloidalPair

        one, two = first.thing, second.thing
        same_size("module", two.module, one.module, "not_that_of_mate")
        same_size(
            "tip_rolling_diameter", 2 * two.tip_rolling_radius, 2 * one.root_rolling_radius, "not_the_mates_root_circle"
        )
        same_size(
            "root_rolling_diameter", 2 * two.root_rolling_radius, 2 * one.tip_rolling_radius, "not_the_mates_tip_circle"
        )
        gears = CycloidalPair(one, two)
        return CycloidalGearMating(
            *self.joined(keys),
            distance=gears.centre_distance,
            module=one.module,
            rolls="external",
            teeth=(one.number_of_teeth, two.number_of_teeth),
            normal_backlash=gears.normal_backlash,
            gears=gears,
        )

"""A worm and its wheel: axes crossed at a right angle, the worm in the middle of the wheel's rim."""

from __future__ import annotations

import cmath
import math
from functools import partial
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.nearest import nearest
from parts.base.mate import End, MateKind, Touching
from parts.keys.mate import GearPairKeys
from parts.keys.worm import AngleError, AxialError, DistanceError, quotient_of
from parts.mates.sizes import same_sizes

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.base.placement import Vector
    from geometry.gears.mesh.search import PairContact
    from geometry.gears.worms.body import WormBody
    from geometry.gears.worms.contact import AxisErrors
    from geometry.gears.worms.drive import WormDrive
    from geometry.gears.worms.field import Field
    from geometry.gears.worms.wheel import WormTeeth
    from geometry.gears.worms.worm import Worm
    from parts.gears.worm_wheel.part import WheelThing

# keys that both have alike
_ALIKE = ("module", "pressure_angle_deg", "addendum_coefficient", "number_of_starts", "form", "hand")


class WormPairSpec(GearPairKeys, tag="worm_pair", kw_only=True):
    """Keys of ``worm_pair``: how far the axes stand off their places."""

    centre_distance_error: DistanceError = 0.0
    axis_angle_error_deg: AngleError = 0.0
    wheel_axial_error: AxialError = 0.0


class WormMating(Touching):
    """A wheel (first) and its worm."""

    body: WormBody
    wheel: WormTeeth
    drive: WormDrive
    errors: AxisErrors

    # their solids touch along lines: meshes cannot tell
    decides_solids = True

    @property
    def worm(self) -> Worm:
        """The worm itself."""
        return self.body.thread.worm

    @property
    def field(self) -> Field | None:
        """Where both touch; None where that is at points: a larger hob cut the wheel, or the axes stand off."""
        from geometry.gears.worms.field import Field
        from geometry.gears.worms.thread import FlankLine

        flank = next(line for _, line in self.body.thread.lines if isinstance(line, FlankLine))
        if self.wheel.hob.swivel or self.errors.any:
            return None
        return Field(self.wheel, *flank.radius(flank.domain).tolist())

    def second_axis(self, direction: float) -> Vector:
        """Across the line of centres, to its right."""
        axis = cmath.rect(math.cos(self.errors.angle), direction - math.pi / 2)
        return axis.real, axis.imag, math.sin(self.errors.angle)

    def second_rotation(self, rotation: float, direction: float) -> float:
        """Where a thread of the worm stands in the space that faces it."""
        from geometry.gears.worms.contact import turn_for

        pitch = 2 * math.pi / self.wheel.number_of_teeth
        ahead = math.remainder(rotation + pitch / 2 - direction, pitch)
        turn = self.worm.sign * ahead * self.drive.ratio + turn_for(self.wheel, self.errors)
        return direction + math.pi + turn

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one pitch, in sections across the wheel's axis."""
        from geometry.gears.worms.contact import contact_under, worm_contact

        if self.errors.any or self.wheel.hob.swivel:
            # at points: the least gap is sought between places and planes
            return contact_under(self.body.thread, self.wheel, self.errors, tolerance)
        return worm_contact(self.worm, self.wheel, phase_off, distance_off, tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """Whether the thread is as long as the wheel touches it, and clear of the teeth of a larger hob."""
        from geometry.base.findings import Finding
        from geometry.gears.worms.contact import clearing_thinning

        field = self.field
        if field is None:
            cleared = None if self.errors.any else clearing_thinning(self.body.thread, self.wheel)
            return () if cleared is None else (Finding("worm_wheel_hob_overlap", *cleared),)
        slope, whole = math.tan(self.body.end_angle), self.body.length - self.body.lost
        used = field.length_used(slope)
        code = "worm_slanted_not_long_enough" if slope > 0 else "worm_not_long_enough"
        return (Finding(code, whole, used),) if whole < used else ()

    def quantities(self) -> dict[str, Any]:
        """Centre distance, ratio, and how much of the worm the wheel touches."""
        field = self.field
        return {
            "centre_distance": self.distance,
            "ratio": self.drive.ratio,
            **({} if field is None else {"worm_length_used": field.length_used()}),
        }


class WormPair(MateKind[WormPairSpec, "WheelThing", "WormBody"]):
    """A worm in its wheel."""

    name, keys = "worm_pair", WormPairSpec
    joins = (("worm_wheel", "worm"),)

    def check(self, keys: WormPairSpec, first: Struct, second: Struct) -> None:
        """The worm is the one that the wheel is for."""
        from parts.gears.worm.part import WormSpec
        from parts.gears.worm_wheel.part import WormWheelSpec

        assert isinstance(first, WormWheelSpec)
        assert isinstance(second, WormSpec)
        same_sizes(_ALIKE, second, first, "not_of_its_mate")
        if not math.isclose(quotient_of(second), first.diameter_quotient, rel_tol=1e-9):
            key, wanted = "diameter_quotient", first.diameter_quotient
            if second.lead_angle_deg is not None:
                key, wanted = "lead_angle_deg", math.degrees(math.atan2(first.number_of_starts, wanted))
            raise ParameterError(key, getattr(second, key), "not_of_its_mate", Nearest(wanted))

    def mating(self, keys: WormPairSpec, first: End[WheelThing], second: End[WormBody]) -> WormMating:
        """The worm is the one that the wheel is for."""
        from geometry.gears.worms.contact import AxisErrors

        drive, worm = first.thing.drive, second.thing.thread.worm
        _check_room(first.thing, second.thing, first.thing.drive.centre_distance + keys.centre_distance_error)
        angle = math.radians(keys.axis_angle_error_deg)
        errors = AxisErrors(keys.centre_distance_error, angle, keys.wheel_axial_error)
        return WormMating(
            *self.joined(keys),
            height=first.thing.teeth.width / 2 - errors.axial,
            distance=drive.centre_distance + errors.centre_distance,
            module=worm.module,
            # the starts of a worm are its teeth
            rolls="worm",
            sense=worm.sign,
            teeth=(drive.number_of_teeth, worm.number_of_starts),
            body=second.thing,
            wheel=first.thing.teeth,
            drive=drive,
            errors=errors,
        )


def _check_room(wheel: WheelThing, body: WormBody, distance: float) -> None:
    """Refuse a shaft, or a thread too short for its run-out, into which the wheel's teeth run."""
    for key, away, radius in body.beside():
        room = wheel.teeth.room(away, distance)
        if radius <= room:
            continue
        if key == "thread_length":
            raise ParameterError(key, body.length, "worm_run_out_in_wheel", partial(_long, wheel, body, distance))
        raise ParameterError(key, 2 * radius, "worm_shaft_in_wheel", limit(2 * room, 2 * radius))


def _long(wheel: WheelThing, body: WormBody, distance: float) -> Nearest | None:
    """How long the thread has to be for the wheel's teeth to stay off what is beyond it."""

    def clear(length: float) -> bool:
        return wheel.teeth.room((length - body.lost) / 2, distance) >= body.start[1]

    return nearest(clear, body.length, body.length + 2 * wheel.teeth.outer_radius)

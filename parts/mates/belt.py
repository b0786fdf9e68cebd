"""The mate ``belt_drive``: two pulleys and the timing belt about them."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta, field

from geometry.base.errors import Nearest, ParameterError, limit
from geometry.base.tolerance import PLACED_MM
from parts.base.mate import End, MateKeys, MateKind, Pose, Standing
from parts.keys.base import mm
from parts.keys.mate import Direction, height
from parts.mates.wrapped import Idlers, IdlerTable, Wrapped, check_idlers, gap_away, idler_quantities, idler_wheels

if TYPE_CHECKING:
    from collections.abc import Sequence

    from geometry.base.findings import Finding
    from geometry.curves.curve import Complex
    from geometry.gears.belts.drive import BeltMesh
    from geometry.gears.belts.pulley import Pulley
    from geometry.plane.loop import Loop

# teeth of a belt at most
_MOST_TEETH = 10_000
# of a pitch, by which a belt may be too short
_ROUNDING = 1e-9
# half the width of the belt in pictures, in pitches
_DRAWN = 0.15

BeltTeeth = Annotated[int, Meta(ge=6, le=_MOST_TEETH, description="teeth of the belt", examples=[100])]
_CENTRE_DISTANCE = mm(
    "centre distance; default: that at which a belt of number_of_belt_teeth is taut", above=0, most=1e6, example=150.0
)


class BeltDriveSpec(MateKeys, tag="belt_drive", kw_only=True):
    """Keys of ``belt_drive``."""

    second: Annotated[str, Meta(description="instance that the belt drives, or that drives it")]
    number_of_belt_teeth: BeltTeeth | None = None
    centre_distance: Annotated[float, _CENTRE_DISTANCE] | None = None
    idlers: Idlers = field(default_factory=list)
    direction_deg: Direction = 0.0
    height: Annotated[float, height("second above the first; default: teeth face each other")] | None = None


class BeltMating(Wrapped):
    """Two pulleys of one belt."""

    mesh: BeltMesh

    @property
    def loop(self) -> Loop:
        """About the pitch circles."""
        return self.mesh.drive.loop

    def _groove(self, rotation: float, direction: float) -> float:
        return gap_away(rotation, direction, self.mesh.pulleys[0].pitch_angle)

    def second_rotation(self, rotation: float, direction: float) -> float:
        """Where its grooves take the belt's teeth."""
        phase = self.mesh.drive.second_phase(self._groove(rotation, direction), self.mesh.pitch)
        return direction + phase - self.mesh.pulleys[1].pitch_angle / 2

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and the second's turn off where its grooves take the belt's teeth."""
        pulley = self.mesh.pulleys[1]
        return self.turned_off(first, second, pulley.pitch_angle, pulley.pitch_radius)

    def rollers(self, first: Pose, second: Pose) -> tuple[Complex, float]:
        """Places of the belt's teeth on its pitch line."""
        direction = cmath.phase(second[0] - first[0])
        phase = self._groove(first[1], direction)
        places = self.mesh.drive.teeth(phase, self.mesh.pitch, self.mesh.belt_teeth)
        return first[0] + places * cmath.rect(1.0, direction), _DRAWN * self.mesh.pitch

    def findings(self) -> tuple[Finding, ...]:
        """A belt that is not taut, few teeth in mesh."""
        return self.mesh.findings()

    def quantities(self) -> dict[str, Any]:
        """Teeth and length of the belt, distance, ratio, wrap, teeth in mesh, what the belt is longer than taut, mm."""
        mesh = self.mesh
        about = idler_quantities(mesh.drive.loop.idler_wraps, mesh.taut_idler) if mesh.idlers else {}
        return {
            "number_of_belt_teeth": mesh.belt_teeth,
            "belt_length": mesh.belt_teeth * mesh.pitch,
            "working_centre_distance": self.distance,
            "gear_ratio": self.teeth[1] / self.teeth[0],
            "wrap_deg": math.degrees(min(mesh.drive.loop.both_wraps)),
            "teeth_in_mesh": mesh.in_mesh,
            "belt_slack": max(mesh.slack, 0.0),
            "rim_gap": mesh.rim_gap,
            **about,
        }


class BeltDriveKind(MateKind[BeltDriveSpec, "Pulley", "Pulley"]):
    """Two pulleys of one belt."""

    name, keys = "belt_drive", BeltDriveSpec
    joins = (("timing_pulley", "timing_pulley"),)
    alone = True

    def mating(self, keys: BeltDriveSpec, first: End[Pulley], second: End[Pulley]) -> BeltMating:
        """Both take the same belt, which goes round them."""
        one, two = first.thing, second.thing
        if two.belt != one.belt:
            named, own = (getattr(end.keys, "belt", None) for end in (first, second))
            raise ParameterError("belt", own, "not_of_the_belt", Nearest(named) if isinstance(named, str) else None)
        mesh = belt_mesh((one, two), keys.number_of_belt_teeth, keys.centre_distance, keys.idlers)
        return BeltMating(
            *self.joined(keys),
            height=one.middle - two.middle if keys.height is None else keys.height,
            distance=mesh.centre_distance,
            module=one.belt.pitch / math.pi,
            teeth=(one.number_of_teeth, two.number_of_teeth),
            mesh=mesh,
        )


def belt_mesh(
    pulleys: tuple[Pulley, Pulley],
    teeth: int | None,
    distance: float | None,
    idlers: Sequence[IdlerTable] = (),
    prefix: str = "mate.",
) -> BeltMesh:
    """The drive of two pulleys by the belt's teeth, its centre distance (mm), or both; ``prefix``: of their keys.

    With idlers, which stand where they do, by the distance, and the belt's teeth if they are told.

    Raises
    ------
    ParameterError
        None of both is given, the pulleys meet, the belt is too short or too long, or does not come to an idler; names
        the key and what works.
    """
    from geometry.gears.belts.drive import BeltDrive, BeltMesh, exact_distance

    pitch, radii = pulleys[0].belt.pitch, (pulleys[0].pitch_radius, pulleys[1].pitch_radius)
    # nearer, the rims of both meet
    least = max(sum(p.reach for p in pulleys), abs(radii[0] - radii[1])) * (1 + _ROUNDING)
    keys = f"{prefix}number_of_belt_teeth", f"{prefix}centre_distance"
    if teeth is None and distance is None:
        raise ParameterError(keys[0], None, "one_of_two_is_missing", other="centre_distance")
    if distance is not None and distance < least:
        raise ParameterError(keys[1], distance, "pulleys_meet", limit(least, distance))
    if idlers:
        if distance is None:
            raise ParameterError(keys[1], None, "missing_beside_idlers")
        wheels = idler_wheels(idlers, prefix, lambda teeth: teeth * pitch / (2 * math.pi))
        drive = BeltDrive(radii, distance, wheels)
        check_idlers(drive.loop, wheels, idlers, prefix)
        fewest = math.ceil((drive.length - PLACED_MM) / pitch)
        if teeth is not None and teeth != fewest:
            cure = Nearest(fewest)
            raise ParameterError(keys[0], teeth, "belt_does_not_fit", cure, length=drive.length, teeth=fewest)
        return BeltMesh(pulleys, distance, fewest, wheels)
    most = _MOST_TEETH if teeth is None else teeth
    found = exact_distance(radii, most * pitch, least)
    if found is None:
        fewest = math.ceil(BeltDrive(radii, least).length / pitch)
        raise ParameterError(keys[0], teeth, "belt_too_short_for_pulleys", Nearest(fewest, "at_least"))
    if distance is None:
        return BeltMesh(pulleys, found, most)
    # as it is told, with five decimals, a distance may be beyond the taut one
    if distance > found + PLACED_MM:
        raise ParameterError(
            keys[1], distance, "belt_too_short", limit(found, distance, digits=6), teeth=most
        )  # fmt: skip
    fitting = math.ceil(BeltDrive(radii, distance - PLACED_MM).length / pitch)
    if teeth is not None and fitting < teeth:
        raise ParameterError(keys[0], teeth, "belt_too_long", Nearest(fitting), teeth=fitting)
    taut = exact_distance(radii, fitting * pitch, least)
    return BeltMesh(pulleys, min(distance, taut or distance), fitting)

"""The mate ``geneva_pair``: a driver and the Geneva wheel that it turns step by step."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, Any

from geometry.base.errors import ParameterError
from parts.base.mate import End, MateKeys, MateKind, Pose, Standing, Toothed
from parts.keys.mate import Direction, height

if TYPE_CHECKING:
    from geometry.gears.mesh.search import PairContact
    from geometry.gears.pins.geneva import GenevaDisc, GenevaWheel
    from geometry.gears.pins.geneva_driver import GenevaDriver


class GenevaPairSpec(MateKeys, tag="geneva_pair", kw_only=True):
    """Keys of ``geneva_pair``."""

    direction_deg: Direction = 0.0
    height: Annotated[float, height("wheel above the driver's lower face; default: midway on the disc")] | None = None


class GenevaMating(Toothed):
    """A driver and its wheel."""

    disc: GenevaDisc

    uneven = True
    only_first_drives = True

    def partner(self, driver: str, rotation: float, direction: float) -> float:
        """The wheel's rotation, dwells included."""
        return self.second_rotation(rotation, direction)

    def second_rotation(self, rotation: float, direction: float) -> float:
        """As the driver stands."""
        return self.disc.drive.wheel_rotation(rotation, direction)

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and the wheel's turn off the middle of its play."""
        drive = self.disc.drive
        # no pin is farther from the wheel's axis
        arm = max(drive.mouth_radius, drive.deepest_radius)
        return self.turned_off(first, second, 2 * drive.half_slot_angle, arm)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict of pins, disc and tips over the cycle of one pin."""
        from geometry.gears.pins.geneva_contact import GenevaContact

        return GenevaContact(self.disc, phase_off, distance_off).result(tolerance)

    def quantities(self) -> dict[str, Any]:
        """Sizes of the pair, mm, what the wheel turns at a time, and the part of the time in which it turns."""
        drive = self.disc.drive
        return {
            "working_centre_distance": self.distance,
            "crank_radius": drive.crank_radius,
            "step_deg": math.degrees(2 * drive.half_slot_angle),
            "motion_share": drive.motion_share,
        }


class GenevaPair(MateKind[GenevaPairSpec, "GenevaDriver", "GenevaWheel"]):
    """A driver and its wheel."""

    name, keys = "geneva_pair", GenevaPairSpec
    joins = (("geneva_driver", "geneva_wheel"),)

    def mating(self, keys: GenevaPairSpec, first: End[GenevaDriver], second: End[GenevaWheel]) -> GenevaMating:
        """The driver is made for this wheel, which stands above its plate."""
        driver, wheel = first.thing, second.thing
        if driver.disc.wheel != wheel:
            raise ParameterError("first.of", None, "made_for_another_wheel")
        drive, above = driver.disc.drive, keys.height
        if above is None:
            width = float(getattr(second.keys, "face_width", 0.0))
            above = 0.0 if driver.piece == "disc" else driver.plate_thickness
            above += max(driver.width - width, 0.0) / 2 if driver.piece != "plate" else 0.0
        return GenevaMating(
            *self.joined(keys),
            height=above,
            distance=drive.centre_distance,
            module=driver.pin_radius,
            # of whole turns: pins and slots are teeth
            rolls="internal" if drive.internal else "external",
            teeth=(drive.number_of_pins, drive.number_of_slots),
            normal_backlash=min(wheel.slot_clearance, 2 * wheel.locking_clearance),
            # the plate alone stands beside the wheel
            has_contact=driver.piece != "plate",
            disc=driver.disc,
        )

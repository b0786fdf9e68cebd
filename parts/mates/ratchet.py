"""The mate ``ratchet_pair``: a ratchet wheel and a pawl, which rides over its teeth and holds it the other way."""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta

from geometry.base.errors import ParameterError
from parts.base.mate import End, MateKeys, MateKind, Pose, Standing, Touching
from parts.keys.base import either
from parts.keys.mate import Height, direction

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.gears.mesh.search import PairContact
    from geometry.gears.ratchets.pawl import PawlShape
    from geometry.gears.ratchets.wheel import RatchetWheel
    from parts.base.mate import Frames
    from parts.ratchets.pawl import Pawl

_DIRECTION = direction("from the wheel's axis to the pivot; default: where the pawl sits at `tooth`")
_TOOTH = Meta(
    ge=-1000,
    le=1000,
    description="the tooth that it holds where the wheel stands at rotation 0, in the free sense; 7.5 is midway",
    examples=[8.5],
)
Friction = Annotated[float, Meta(ge=0, le=1, description="coefficient of friction between pawl and tooth")]


class RatchetPairSpec(MateKeys, tag="ratchet_pair", kw_only=True):
    """Keys of ``ratchet_pair``."""

    first: Annotated[str, Meta(description="instance of a ratchet_wheel that is already placed")]
    second: Annotated[str, Meta(description="instance of its pawl")]
    direction_deg: Annotated[float, _DIRECTION] | None = None
    tooth: Annotated[float, _TOOTH] | None = None
    friction: Friction = 0.15
    height: Height = 0.0


class RatchetMating(Touching):
    """A wheel and a pawl."""

    pawl: PawlShape
    friction: float

    follows = True
    # it is seated at first, and drops later when it has been lifted
    counts_turns = True

    @property
    def _sense(self) -> int:
        return 1 if self.pawl.wheel.ccw else -1

    def _left(self, rotation: float, towards: float) -> float:
        """How far the wheel has left the last tooth that the pawl holds, rad, the pivot standing in a direction."""
        return self.pawl.phase(self._sense * (rotation - towards) + cmath.phase(self.pawl.pivot))

    def _pose(self, centre: complex, towards: float, lift: float) -> Pose:
        pawl, sense = self.pawl, self._sense
        seated = cmath.phase(-pawl.towards_pivot) - cmath.phase(pawl.pivot)
        turned = towards + sense * (seated - pawl.wheel.side * lift)
        return centre + cmath.rect(self.distance, towards), turned

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """Seated, or where the tooth lifts it."""
        return self._pose(centre, direction, self.pawl.stands(self._left(rotation, direction)))

    def followed(self, start: Pose, now: Pose) -> Pose:
        """Lifted by every tooth that has passed, dropped when that was beyond its reach."""
        towards = math.radians(self.direction_deg)
        turned = self._left(start[1], towards) + self._sense * (now[1] - start[1])
        return self._pose(now[0], towards, self.pawl.lift(turned))

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and how far the pawl is turned off its place, mm at the edge that it holds."""
        spoke = second[0] - first[0]
        _, turned = self.second_pose(*first, cmath.phase(spoke))
        off = math.remainder(second[1] - turned, 2 * math.pi) * self.pawl.length
        return Standing(abs(spoke), off, 0.0, slides=True)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict from the tooth that it holds until it drops in front of the next one."""
        from geometry.gears.ratchets.contact import RatchetContact

        turned = self._sense * phase_off / self.pawl.length
        return RatchetContact(self.pawl, turned, distance_off).result(tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """Whether the tooth pulls the pawl in against friction."""
        from geometry.base.findings import Finding

        pull, least = math.degrees(self.pawl.pull_in_angle), math.degrees(math.atan(self.friction))
        return () if pull > least else (Finding("pawl_slips_out", pull, least),)

    @property
    def stands_in_mesh(self) -> bool:
        """It is asked for all of the way."""
        return True

    def blocked(self, first: Frames, second: Frames) -> Mapping[str, dict[str, float]]:
        """Whether drives turn the wheel where the pawl holds it: farther back than to the tooth behind it."""
        import numpy as np

        turned = self._sense * np.unwrap(np.arctan2(first[0][:, 1, 0], first[0][:, 0, 0]))
        back = math.degrees(float((turned[0] - turned).max()))
        free = math.degrees(self._left(self._sense * float(turned[0]), math.radians(self.direction_deg)))
        # a thousandth of a degree is what a scene's numbers leave
        return {"turns_against_pawl": {"value": back, "limit": free}} if back > free + 1e-3 else {}

    def quantities(self) -> dict[str, Any]:
        """Sizes of the pair, mm and degrees; how far a wheel at rotation 0 turns back until this pawl holds it."""
        pawl = self.pawl
        return {
            "working_centre_distance": self.distance,
            "pawl_swing_deg": math.degrees(pawl.swing),
            "overrun_deg": math.degrees(pawl.overrun),
            "pull_in_angle_deg": math.degrees(pawl.pull_in_angle),
            "contact_depth": pawl.contact_depth,
            "turn_back_deg": math.degrees(self._left(0.0, math.radians(self.direction_deg))),
        }


class RatchetPair(MateKind[RatchetPairSpec, "RatchetWheel", "Pawl"]):
    """A wheel and a pawl."""

    name, keys = "ratchet_pair", RatchetPairSpec
    joins = (("ratchet_wheel", "pawl"),)

    def mating(self, keys: RatchetPairSpec, first: End[RatchetWheel], second: End[Pawl]) -> RatchetMating:
        """The pawl is made for this wheel."""
        pawl, wheel = second.thing.shape, first.thing
        if pawl.wheel != wheel:
            raise ParameterError("of", None, "made_for_another_wheel")
        if keys.direction_deg is not None and keys.tooth is not None:
            raise either("mate.tooth", keys.tooth, "direction_deg")
        towards = keys.direction_deg
        if towards is None:
            towards = math.degrees(seat_direction(pawl, 1.0 if keys.tooth is None else keys.tooth))
        return RatchetMating(
            self.name,
            keys.first,
            keys.second,
            towards,
            height=keys.height,
            distance=pawl.pivot_distance,
            module=wheel.tip_radius,
            pawl=pawl,
            friction=keys.friction,
        )


def seat_direction(pawl: PawlShape, tooth: float) -> float:
    """From the axis of a wheel at rotation 0 to the pivot of a pawl that holds a tooth, rad within half a turn."""
    wheel = pawl.wheel
    found = cmath.phase(pawl.pivot) + (tooth - 1) * wheel.pitch_angle
    return math.remainder(found if wheel.ccw else -found, 2 * math.pi)

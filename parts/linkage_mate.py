"""A linkage cam and what follows it: a roller on the coupler, or a stem fixed to it."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from geometry.errors import ParameterError, at_least
from parts.cam_mate import CamFollowerMating, CamFollowerSpec
from parts.standing import Standing

if TYPE_CHECKING:
    from geometry.cams.follower_shape import FollowerEnd

# radii that people type agree with those of the cam this well, mm
_SAME = 1e-6


@dataclass(frozen=True, slots=True)
class LinkageFollowerMating(CamFollowerMating):
    """A cam and its follower on a coupler; the stem's frame stands at coupler_point, +y along its direction."""

    @property
    def distance(self) -> float:
        """From the axis to the reference point at cam angle 0, mm."""
        return self.module

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How far the follower is off its place across its way (added to the distance) and along it, mm."""
        import numpy as np

        direction = math.radians(self.direction_deg)
        place, turned = self.second_pose(*first, direction)
        beside = direction - math.pi / 2
        angle = np.asarray(first[1] - beside)
        way = complex(self.cam.way(angle, self.cam.reference_point(angle))) * cmath.exp(1j * beside)
        off = (second[0] - place) * abs(way) / way
        lean = 0.0 if self.end.outline is None else math.remainder(second[1] - turned, 2 * math.pi) * self.module
        return Standing(direction, self.distance + math.hypot(off.imag, lean), off.real, 0.0, slides=True)

    def quantities(self) -> dict[str, Any]:
        """How far the driven member moves."""
        travel = self.cam.motion.lift
        if self.cam.swings:
            return {"travel": math.degrees(travel), "unit": "deg"}
        return {"travel": travel, "unit": "mm"}


def linkage_follower_mating(mate: CamFollowerSpec, cam: Any, end: FollowerEnd) -> LinkageFollowerMating:
    """The mating, its follower held against what the cam was made for.

    Raises
    ------
    ParameterError
        Another kind or size of follower; names its key and what the cam needs.
    """
    made = LinkageFollowerMating(mate.first, mate.second, mate.direction_deg, mate.height, cam, end)
    if end.arm_length is not None:
        raise ParameterError("kind", "follower_arm", 'the linkage carries the follower; "follower" works')
    if end.kind != cam.kind:
        raise ParameterError("end", str(end.kind), f'the cam is made for another follower; "{cam.kind}" works')
    if end.outline is None or end.kind == "mushroom":
        key, factor = ("diameter", 2) if end.outline is None else ("follower_radius", 1)
        if abs(factor * (end.radius - cam.radius)) > _SAME:
            text = f"the cam is made for another; {factor * cam.radius:.9g} mm works"
            raise ParameterError(key, factor * end.radius, text)
    if end.reach is not None and not 2 * end.reach[1] >= (least := cam.least_plate_diameter()):
        text = f"the contact runs over the plate's edge; at least {at_least(least, 4)} mm works"
        raise ParameterError("plate_diameter", 2 * end.reach[1], text)
    return made

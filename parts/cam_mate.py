"""A cam and its follower (stem, arm, or roller): where the follower stands at a cam angle, and contact over a turn."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta, Struct

from geometry.errors import ParameterError, at_least
from parts.joined import Joined
from parts.keys import mm
from parts.standing import Standing

if TYPE_CHECKING:
    from geometry.cams.disk import DiskCam
    from geometry.cams.follower_shape import FollowerEnd
    from geometry.gears.mesh_search import PairContact
    from parts.groove_cam import GrooveDisk

# radii and lengths that people type agree with those of the cam this well
_SAME = 1e-6


class CamFollowerSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="cam_follower"):
    """A cam (first) and what follows it (second); the cam's own turn tells at which cam angle it stands."""

    first: Annotated[str, Meta(description="instance of a cam that is already placed")]
    second: Annotated[str, Meta(description="its follower, follower_arm or roller")]
    direction_deg: Annotated[
        float,
        Meta(
            ge=-360,
            le=360,
            description="way of a translating follower as it rises; of an arm 90 puts its pivot at +x",
            extra={"unit": "degrees"},
        ),
    ] = 90.0
    height: Annotated[
        float, mm("how far the follower's lower face stands above the cam's", least=-10_000, most=10_000)
    ] = 0.0


@dataclass(frozen=True, slots=True)
class CamFollowerMating(Joined):
    """A disk cam and its follower, or the roller of it; in a groove it stands at the inner wall."""

    cam: DiskCam
    end: FollowerEnd
    groove: GrooveDisk | None = None
    kind: str = "cam_follower"
    ratio: None = None

    @property
    def normal_backlash(self) -> float:
        """Play of a roller between the walls of its groove, mm."""
        return 0.0 if self.groove is None else self.groove.clearance

    @property
    def has_contact(self) -> bool:
        """Stems and arms for rollers do not touch the cam: their roller does."""
        return self.end.kind != "roller" or self.end.outline is None

    @property
    def module(self) -> float:
        """The length that tolerances go by: the distance of the lowest reference point from the axis, mm."""
        return float(abs(self.cam.reference_point(0.0)))

    @property
    def _swings(self) -> bool:
        from geometry.cams.mounts import Oscillating

        return isinstance(self.cam.mount, Oscillating)

    @property
    def distance(self) -> float:
        """From the axis to the pivot, or to the line of motion, mm."""
        mount: Any = self.cam.mount
        return mount.centre_distance if self._swings else abs(mount.offset)

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The follower where the cam, turned by ``rotation``, has lifted it."""
        turned = direction - math.pi / 2
        from geometry.cams.follower_contact import follower_pose

        at, lean = follower_pose(self.cam, self.end, rotation - turned)
        return centre + at * cmath.rect(1.0, turned), turned + lean

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How far the follower is off its place across its way (added to the distance) and along it, mm."""
        direction = math.radians(self.direction_deg)
        place, turned = self.second_pose(*first, direction)
        off = (second[0] - place) * cmath.rect(1.0, math.pi / 2 - direction)
        lean = math.remainder(second[1] - turned, 2 * math.pi)
        if self._swings and self.end.arm_length is not None:
            return Standing(direction, self.distance + abs(off), lean * self.end.arm_length, 0.0, slides=True)
        # a round roller may stand turned
        lean = 0.0 if self.end.outline is None else lean * self.module
        # outwards a roller has the play of its groove
        play = self.normal_backlash if off.imag > 0 else 0.0
        return Standing(direction, self.distance + math.hypot(off.real, lean), off.imag, play, slides=True)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact | None:
        """Verdict over one turn of the cam; ``phase_off``: mm by which the follower stands too far out."""
        if not self.has_contact:
            return None
        from geometry.cams.follower_contact import CONTACT_TOLERANCE, follower_contact

        allowed = CONTACT_TOLERANCE * self.module if tolerance is None else tolerance
        beyond = None if self.groove is None else self.groove.outer()
        return follower_contact(self.cam, self.end, allowed, out=phase_off, beyond=beyond)

    def quantities(self) -> dict[str, Any]:
        """How far the follower moves, and its play in a groove, mm."""
        low, high = self.cam.motion.extremes()
        travel = math.degrees(high - low) if self._swings else high - low
        play = {} if self.groove is None else {"roller_clearance": self.groove.clearance}
        return {"travel": travel, "unit": "deg" if self._swings else "mm", **play}


def cam_follower_mating(mate: CamFollowerSpec, first: DiskCam | GrooveDisk, end: FollowerEnd) -> CamFollowerMating:
    """The mating, its follower held against what the cam was made for.

    Raises
    ------
    ParameterError
        Another kind or size of follower; names its key and what the cam needs.
    """
    from geometry.cams.disk import DiskCam

    cam, groove = (first, None) if isinstance(first, DiskCam) else (first.cam, first)
    if hasattr(cam, "follower_pose"):
        from parts.linkage_mate import linkage_follower_mating

        return linkage_follower_mating(mate, cam, end)
    made = CamFollowerMating(mate.first, mate.second, mate.direction_deg, mate.height, cam, end, groove)
    if end.kind != cam.kind:
        raise ParameterError("end", str(end.kind), f'the cam is made for another follower; "{cam.kind}" works')
    stands_alone = end.outline is None
    if stands_alone or end.kind == "mushroom":
        key, factor = ("diameter", 2) if stands_alone else ("follower_radius", 1)
        same_as_cam(key, factor * end.radius, factor * cam.radius)
    mount: Any = cam.mount
    if not stands_alone and made._swings != (end.arm_length is not None):
        wanted = "follower_arm" if made._swings else "follower"
        raise ParameterError("kind", "follower" if made._swings else "follower_arm", f'"{wanted}" works with this cam')
    if end.arm_length is not None:
        if end.sense != mount.sense:
            raise ParameterError(
                "sense", sense_name(end.sense), f'the cam is made for "{sense_name(mount.sense)}", which works'
            )
        if cam.is_flat:
            same_as_cam("face_offset", end.face_offset, mount.face_offset)
        else:
            same_as_cam("arm_length", end.arm_length, mount.arm_length)
    _check_reach(cam, end)
    return made


def sense_name(sense: int) -> str:
    """The sense of an arm as scenes have it."""
    return "against" if sense > 0 else "with"


def same_as_cam(key: str, value: float, wanted: float) -> None:
    """Refuse a size of the follower that is not the one its cam is made for."""
    if abs(value - wanted) > _SAME:
        raise ParameterError(key, value, f"the cam is made for another; {wanted:.9g} mm works")


def _check_reach(cam: DiskCam, end: FollowerEnd) -> None:
    """The contact stays on a plate or a face."""
    if end.reach is None:
        return
    if end.arm_length is None:
        least = cam.least_plate_diameter()
        if not 2 * end.reach[1] >= least:
            text = f"the contact runs over the plate's edge; at least {at_least(least, 4)} mm works"
            raise ParameterError("plate_diameter", 2 * end.reach[1], text)
        return
    # face_reach counts from the axis' foot on the face towards the pivot
    from geometry.cams.follower_contact import reach_from_pivot

    far = reach_from_pivot(cam)
    if not end.reach[1] >= far:
        text = f"the contact runs over the bar's end; at least {at_least(far, 4)} mm works"
        raise ParameterError("arm_length", end.reach[1], text)

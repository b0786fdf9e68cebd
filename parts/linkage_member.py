"""The mate ``linkage_member``: a plate or an arm as a member of the linkage under a cam's follower."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any, Literal

from msgspec import Meta, Struct

from geometry.errors import ParameterError
from parts.keys import mm
from parts.standing import Standing

if TYPE_CHECKING:
    from geometry.cams.linkage_cam import LinkageCam
    from geometry.findings import Finding
    from geometry.gears.mesh_search import PairContact

# lengths that people type agree with those of the linkage this well, mm
_SAME = 1e-6
_TURN = 2 * math.pi


class LinkageMemberSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="linkage_member"):
    """A linkage cam (first) and a member of its linkage (second), which stands where the cam's turn puts it.

    Frames: rocker: origin at its pivot, x axis to its joint; coupler: origin in joint A, x axis to joint B; slider:
    origin in its joint, x axis along its direction.
    """

    first: Annotated[str, Meta(description="instance of a linkage_cam that is already placed")]
    second: Annotated[str, Meta(description="a plate or follower_arm with the member's holes")]
    member: Annotated[Literal["driven", "coupler", "guide"], Meta(description="which member it is")]
    direction_deg: Annotated[
        float,
        Meta(ge=-360, le=360, description="as in cam_follower: turns the whole linkage", extra={"unit": "degrees"}),
    ] = 90.0
    height: Annotated[float, mm("its lower face above the cam's", least=-10_000, most=10_000)] = 0.0


@dataclass(frozen=True, slots=True)
class LinkageMemberMating:
    """A cam and a member of its linkage; whether solids run into each other is for the solids to tell."""

    first: str
    second: str
    member: str
    direction_deg: float
    height: float
    cam: LinkageCam
    kind: str = "linkage_member"
    pair: Any = None
    first_teeth: int = 1
    normal_backlash: float = 0.0
    ratio: None = None
    has_contact: bool = False

    @property
    def module(self) -> float:
        """The length that tolerances go by: the distance of the lowest reference point from the axis, mm."""
        return float(abs(self.cam.reference_point(0.0)))

    @property
    def distance(self) -> float:
        """From the cam's axis to the member's origin at cam angle 0, mm."""
        return abs(self._pose(0.0)[0])

    def _pose(self, angle: float) -> tuple[complex, float]:
        """Origin and turn of the member in the cam's fixed frame."""
        lift = float(self.cam.motion.value(angle % _TURN))
        return self.cam.mount.linkage.member(self.member, lift)

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The member where the cam, turned by ``rotation``, has moved it."""
        turned = direction - math.pi / 2
        at, lean = self._pose(rotation - turned)
        return centre + at * cmath.rect(1.0, turned), turned + lean

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How far the member is from its place, mm (added to the distance), and its turn off it, rad."""
        direction = math.radians(self.direction_deg)
        place, turned = self.second_pose(*first, direction)
        off = math.remainder(second[1] - turned, _TURN)
        return Standing(direction, self.distance + abs(second[0] - place), off, 0.0, self.module)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact | None:
        """None: joints are no contacts of outlines."""
        return None

    def findings(self) -> tuple[Finding, ...]:
        """None."""
        return ()

    def quantities(self) -> dict[str, Any]:
        """By how much it turns over a turn of the cam."""
        return {"member": self.member, "swing_deg": math.degrees(self.cam.member_swing(self.member))}


def linkage_member_mating(mate: LinkageMemberSpec, first: LinkageCam, second: Any) -> LinkageMemberMating:
    """The mating; an arm is held against the length of its rocker.

    Raises
    ------
    ParameterError
        An arm of another length, or one in place of a slider.
    """
    arm = getattr(second, "arm_length", None)
    length = first.mount.linkage.length(mate.member)
    if arm is not None and length is None:
        raise ParameterError("kind", "follower_arm", 'this member is a slider; "plate" works')
    if arm is not None and length is not None and abs(arm - length) > _SAME:
        raise ParameterError("arm_length", arm, f"the linkage has another; {length:.9g} mm works")
    return LinkageMemberMating(mate.first, mate.second, mate.member, mate.direction_deg, mate.height, first)

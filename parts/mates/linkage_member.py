"""The mate ``linkage_member``: a plate or an arm as a member of the linkage under a cam's follower."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Any, Literal

from msgspec import Meta

from geometry.base.errors import ParameterError
from parts.base.mate import End, MateKeys, MateKind, Mating, Pose, Standing
from parts.keys.mate import direction, height
from parts.mates.sizes import same_as_cam

if TYPE_CHECKING:
    from geometry.cams.plane.coupler import LinkageCam

_TURN = 2 * math.pi
Member = Literal["driven", "coupler", "guide"]


class LinkageMemberSpec(MateKeys, tag="linkage_member", kw_only=True):
    """Keys of ``linkage_member``.

    Frames: rocker: origin at its pivot, x axis to its joint; coupler: origin in joint A, x axis to joint B; slider:
    origin in its joint, x axis along its direction.
    """

    first: Annotated[str, Meta(description="instance of a linkage_cam that is already placed")]
    second: Annotated[str, Meta(description="a plate or follower_arm with the member's holes")]
    member: Annotated[Member, Meta(description="which member it is", examples=["coupler"])]
    direction_deg: Annotated[float, direction("as in cam_follower: turns the whole linkage")] = 90.0
    height: Annotated[float, height("its lower face above the cam's", 10_000)] = 0.0


class LinkageMemberMating(Mating):
    """A cam and a member of its linkage; whether solids run into each other is for the solids to tell."""

    member: Member
    cam: LinkageCam
    # the length by which turns are held, mm
    arm: float

    follows = True

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """The member where the cam, turned by ``rotation``, has moved it."""
        turned = direction - math.pi / 2
        at, lean = _pose(self.cam, self.member, rotation - turned)
        return centre + at * cmath.rect(1.0, turned), turned + lean

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the member is from its place, mm (added to the distance), and its turn off it, rad."""
        return self.off_place(first, second, math.radians(self.direction_deg), self.arm)

    def quantities(self) -> dict[str, Any]:
        """By how much it turns over a turn of the cam."""
        return {"member": self.member, "swing_deg": math.degrees(self.cam.member_swing(self.member))}


def _pose(cam: LinkageCam, member: Member, angle: float) -> Pose:
    """Origin and turn of a member in the cam's fixed frame."""
    return cam.mount.linkage.member(member, float(cam.motion.value(angle % _TURN)))


class LinkageMember(MateKind[LinkageMemberSpec, "LinkageCam", Any]):
    """A plate or an arm in the linkage."""

    name, keys = "linkage_member", LinkageMemberSpec
    joins = tuple(("linkage_cam", member) for member in ("plate", "follower_arm"))

    def mating(self, keys: LinkageMemberSpec, first: End[LinkageCam], second: End[Any]) -> LinkageMemberMating:
        """An arm has the length of its rocker."""
        cam = first.thing
        if second.kind == "follower_arm":
            length = cam.mount.linkage.length(keys.member)
            if length is None:
                raise ParameterError("kind", "follower_arm", "member_is_a_slider")
            same_as_cam("arm_length", second.thing.arm_length, length, "linkage_has_another")
        return LinkageMemberMating(
            *self.joined(keys),
            height=keys.height,
            distance=abs(_pose(cam, keys.member, 0.0)[0]),
            # the distance of the lowest reference point from the axis
            arm=float(abs(cam.reference_point(0.0))),
            member=keys.member,
            cam=cam,
        )

"""The mate ``lever_member``: a flat part as a link of the lever mechanism that a crank turns."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any, Literal

from msgspec import Meta

from geometry.base.errors import ParameterError
from parts.base.mate import End, MateKeys, MateKind, Mating, Pose, Standing
from parts.keys.mate import height
from parts.mates.follower import travelled
from parts.mates.sizes import same_size

if TYPE_CHECKING:
    from geometry.kinematics.levers import Levers
    from parts.bodies.lever_crank import LeverCrank

Member = Literal["rod", "stone", "lever", "slider", "second_rod", "second_rocker"]


class LeverMemberSpec(MateKeys, tag="lever_member", kw_only=True):
    """Keys of ``lever_member``.

    Frames: rod: origin in joint A, x axis to B; stone: origin in A, x axis along the lever; lever: origin at its pivot
    O3, x axis to B or through A; second rod: origin in C, x axis to D; second rocker: origin at O5, x axis to D;
    slider: origin in its joint, x axis along its guide.
    """

    first: Annotated[str, Meta(description="instance of a lever_crank that is already placed")]
    second: Annotated[str, Meta(description="a flat part with the link's holes")]
    member: Annotated[Member, Meta(description="which link of the mechanism it is", examples=["rod"])]
    height: Annotated[float, height("its lower face above the crank's", 10_000)] = 0.0


class LeverMemberMating(Mating):
    """A crank and a link of its mechanism; whether solids run into each other is for the solids to tell."""

    member: Member
    levers: Levers

    follows = True

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """The link where the crank, turned by ``rotation``, has moved it."""
        at, lean = _pose(self.levers, self.member, rotation)
        return centre + at, lean

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the link is from its place, mm (added to the distance), and its turn off it, rad."""
        return self.off_place(first, second, arm=self.levers.crank)

    def quantities(self) -> dict[str, Any]:
        """How far it slides, mm, or turns, degrees, over a turn of the crank."""
        from geometry.kinematics.levers import travel

        run = travel(self.levers, self.member).run
        return {"member": self.member} | travelled(run, swings=self.member != "slider")


def _pose(levers: Levers, member: Member, angle: float) -> Pose:
    """Origin and turn of a link in the frame of the mechanism."""
    import numpy as np

    from geometry.kinematics.kinetostatics import frames
    from geometry.kinematics.levers import members

    frame = frames(levers, levers.moved(angle))[members(levers)[member]]
    return complex(frame.origin[0]), float(np.angle(frame.way[0]))


class LeverMember(MateKind[LeverMemberSpec, "LeverCrank", Any]):
    """A flat part in the mechanism."""

    name, keys = "lever_member", LeverMemberSpec
    joins = tuple(("lever_crank", member) for member in ("plate", "follower_arm", "layered"))

    def mating(self, keys: LeverMemberSpec, first: End[LeverCrank], second: End[Any]) -> LeverMemberMating:
        """An arm has the length of its link."""
        from geometry.kinematics.levers import lengths, members

        levers = first.thing.levers
        if keys.member not in members(levers):
            raise ParameterError("mate.member", keys.member, "no_such_link", None, known=[*members(levers)])
        length = lengths(levers).get(keys.member)
        if second.kind == "follower_arm" and length is not None:
            same_size("arm_length", second.thing.arm_length, length, "linkage_has_another")
        return LeverMemberMating(
            *self.joined(keys),
            height=keys.height,
            distance=abs(_pose(levers, keys.member, 0.0)[0]),
            member=keys.member,
            levers=levers,
        )

"""Mates of positive drives: conjugate cams on one shaft, a cam and its yoke; contact from both sides over a turn."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta

from geometry.base.errors import ParameterError
from parts.base.mate import End, MateKeys, MateKind, Pose, Standing, Touching
from parts.base.registry import KINDS
from parts.keys.mate import direction, height
from parts.mates.follower import travelled

if TYPE_CHECKING:
    from geometry.cams.plane.disk import DiskCam
    from geometry.gears.mesh.search import PairContact
    from parts.cams.positive.conjugate import SecondCam
    from parts.cams.positive.yoke import YokeFrame

# contact is a gap within this part of the lowest follower's distance from the axis
_CONTACT = 1e-8
_HEIGHT = "how far the second one's lower face stands above the first one's; default: "


class ConjugateCamsSpec(MateKeys, tag="conjugate_cams", kw_only=True):
    """Keys of ``conjugate_cams``."""

    first: Annotated[str, Meta(description="instance of a cam that is already placed")]
    second: Annotated[str, Meta(description="instance of the conjugate_cam made from it")]
    height: Annotated[float, height(f"{_HEIGHT}upon the first one", 10_000, 10.0)] | None = None


class CamYokeSpec(MateKeys, tag="cam_yoke", kw_only=True):
    """Keys of ``cam_yoke``."""

    first: Annotated[str, Meta(description="instance of a cam that is already placed")]
    second: Annotated[str, Meta(description="instance of the yoke_frame made from it")]
    direction_deg: Annotated[float, direction("direction in which the yoke rises")] = 90.0
    height: Annotated[float, height(f"{_HEIGHT}0, of rollers upon the first one", 10_000, 10.0)] | None = None


class ConjugateMating(Touching):
    """Both disks turn together; the contact is that of both rollers of their follower."""

    cam: DiskCam
    other: SecondCam

    bond = "fixed"

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """On the same axis, turned alike: the profile is drawn as it sits on the shaft."""
        return centre, rotation

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the axes stand apart, mm, and the second disk's turn against the first, rad."""
        return self.off_place(first, second, arm=self.module)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one turn: the gaps under both rollers; ``phase_off`` rad: the second disk's turn."""
        from geometry.cams.contact.positive import conjugate_contact

        return conjugate_contact(self.cam, self.other.pair, self.tolerated(_CONTACT, tolerance), second_turn=phase_off)

    def quantities(self) -> dict[str, Any]:
        """How both rollers stand on their follower."""
        from geometry.cams.contact.positive import between_rollers

        found = travelled(between_rollers(self.cam, self.other.pair), swings=self.cam.swings)
        return {"between_rollers": found["travel"], "unit": found["unit"]}


class YokeMating(Touching):
    """A cam and the yoke that touches it from both sides."""

    cam: DiskCam
    frame: YokeFrame

    follows = True

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """The frame is drawn about the axis as it stands at cam angle 0; S lifts it."""
        turned = direction - math.pi / 2
        lift = float(self.cam.motion.value(rotation - turned))
        return centre + lift * cmath.exp(1j * direction), turned

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the frame is off its place across its way (added to the distance) and along it, mm."""
        direction = math.radians(self.direction_deg)
        place, turned = self.second_pose(*first, direction)
        off = (second[0] - place) * cmath.exp(1j * (math.pi / 2 - direction))
        lean = math.remainder(second[1] - turned, 2 * math.pi) * self.module
        return Standing(math.hypot(off.real, lean), off.imag, self.frame.play / 2, slides=True)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one turn of the cam; ``phase_off``: mm by which the frame stands too far out."""
        from geometry.cams.contact.positive import yoke_contact

        breadth, allowed = self.frame.breadth - self.frame.play, self.tolerated(_CONTACT, tolerance)
        return yoke_contact(self.cam, breadth, self.frame.play, allowed, out=phase_off)

    def quantities(self) -> dict[str, Any]:
        """Breadth between faces or roller centres with the play in it, and the lift, mm."""
        return {"yoke_breadth": self.frame.breadth, "lift": self.cam.motion.lift, "normal_backlash": self.frame.play}


def _lowest(cam: DiskCam) -> float:
    """The length that tolerances go by: the distance of the lowest roller or face from the axis, mm."""
    return float(abs(cam.reference_point(0.0)))


def _above(height: float | None, first: End[DiskCam]) -> float:
    """The height that a scene gives, or that of the first part, mm."""
    return KINDS[first.kind].height(first.keys, first.thing) if height is None else height


class ConjugateCams(MateKind[ConjugateCamsSpec, "DiskCam", "SecondCam"]):
    """Two disks with one follower."""

    name, keys = "conjugate_cams", ConjugateCamsSpec
    joins = (("cam", "conjugate_cam"),)

    def mating(self, keys: ConjugateCamsSpec, first: End[DiskCam], second: End[SecondCam]) -> ConjugateMating:
        """The second disk is made from the first."""
        cam, other = first.thing, second.thing
        if other.first != cam:
            raise ParameterError("of", None, "made_from_another_cam")
        return ConjugateMating(
            *self.joined(keys),
            height=_above(keys.height, first),
            module=_lowest(cam),
            has_contact=False,
            cam=cam,
            other=other,
        )


class CamYoke(MateKind[CamYokeSpec, "DiskCam", "YokeFrame"]):
    """A disk in its frame."""

    name, keys = "cam_yoke", CamYokeSpec
    joins = (("cam", "yoke_frame"),)

    def mating(self, keys: CamYokeSpec, first: End[DiskCam], second: End[YokeFrame]) -> YokeMating:
        """The yoke is made from the cam."""
        cam, frame = first.thing, second.thing
        if frame.cam != cam:
            raise ParameterError("of", None, "made_from_another_cam")
        return YokeMating(
            *self.joined(keys),
            # a plate with pins lies upon the cam, faces stand about it
            height=(keys.height or 0.0) if cam.is_flat else _above(keys.height, first),
            module=_lowest(cam),
            normal_backlash=frame.play,
            # flat faces touch the cam; of a plate with pins the rollers do
            has_contact=cam.is_flat,
            cam=cam,
            frame=frame,
        )

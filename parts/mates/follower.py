"""A cam and its follower (stem, arm, or roller): where the follower stands at a cam angle, and contact over a turn."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError, limit
from parts.base.mate import End, MateKeys, MateKind, Pose, Standing, Touching
from parts.keys.mate import direction, height
from parts.mates.sizes import same_as_cam

if TYPE_CHECKING:
    from geometry.cams.contact.outlines import FollowerEnd
    from geometry.cams.plane.coupler import LinkageCam
    from geometry.cams.plane.disk import DiskCam
    from geometry.cams.plane.wedge import WedgeCam
    from geometry.gears.mesh.search import PairContact
    from parts.cams.groove_cam.part import GrooveDisk

# parts that may follow a cam
FOLLOWERS = ("follower", "follower_arm", "roller")

_DIRECTION = direction("direction in which a translating follower rises; for an arm 90 puts its pivot at +x")


class CamFollowerSpec(MateKeys, tag="cam_follower", kw_only=True):
    """Keys of ``cam_follower``."""

    first: Annotated[str, Meta(description="instance of a cam that is already placed")]
    second: Annotated[str, Meta(description="its follower, follower_arm or roller")]
    direction_deg: Annotated[float, _DIRECTION] = 90.0
    height: Annotated[float, height("how far the follower's lower face stands above the cam's", 10_000)] = 0.0


def travelled(travel: float, *, swings: bool) -> dict[str, Any]:
    """How far a follower moves, mm, or rad of one that swings."""
    return {"travel": math.degrees(travel) if swings else travel, "unit": "deg" if swings else "mm"}


class CamFollowerMating(Touching):
    """A disk cam and its follower, or the roller of it; in a groove it stands at the inner wall."""

    cam: DiskCam
    end: FollowerEnd
    groove: GrooveDisk | None = None

    follows = True

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """The follower where the cam, turned by ``rotation``, has lifted it."""
        turned = direction - math.pi / 2
        from geometry.cams.contact.follower import follower_pose

        at, lean = follower_pose(self.cam, self.end, rotation - turned)
        return centre + at * cmath.rect(1.0, turned), turned + lean

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the follower is off its place across its way (added to the distance) and along it, mm."""
        direction = math.radians(self.direction_deg)
        place, turned = self.second_pose(*first, direction)
        off = (second[0] - place) * cmath.rect(1.0, math.pi / 2 - direction)
        lean = math.remainder(second[1] - turned, 2 * math.pi)
        if self.cam.swings and self.end.arm_length is not None:
            return Standing(self.distance + abs(off), lean * self.end.arm_length, 0.0, slides=True)
        # a round roller may stand turned
        lean = 0.0 if self.end.outline is None else lean * self.module
        # outwards a roller has the play of its groove
        play = self.normal_backlash if off.imag > 0 else 0.0
        return Standing(self.distance + math.hypot(off.real, lean), off.imag, play, slides=True)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact | None:
        """Verdict over one turn of the cam; ``phase_off``: mm by which the follower stands too far out."""
        if not self.has_contact:
            return None
        from geometry.cams.contact.follower import CONTACT_TOLERANCE, follower_contact

        allowed = self.tolerated(CONTACT_TOLERANCE, tolerance)
        beyond = None if self.groove is None else self.groove.outer()
        return follower_contact(self.cam, self.end, allowed, out=phase_off, beyond=beyond)

    def quantities(self) -> dict[str, Any]:
        """How far the follower moves, and its play in a groove, mm."""
        play = {} if self.groove is None else {"roller_clearance": self.groove.clearance}
        return travelled(self.cam.motion.lift, swings=self.cam.swings) | play


class LinkageFollowerMating(CamFollowerMating):
    """A cam and its follower on a coupler; the stem's frame stands at coupler_point, +y along its direction."""

    cam: LinkageCam

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the follower is off its place across its way (added to the distance) and along it, mm."""
        import numpy as np

        direction = math.radians(self.direction_deg)
        place, turned = self.second_pose(*first, direction)
        beside = direction - math.pi / 2
        angle = np.asarray(first[1] - beside)
        way = complex(self.cam.way(angle, self.cam.reference_point(angle))) * cmath.exp(1j * beside)
        off = (second[0] - place) * abs(way) / way
        lean = 0.0 if self.end.outline is None else math.remainder(second[1] - turned, 2 * math.pi) * self.module
        return Standing(self.distance + math.hypot(off.imag, lean), off.real, 0.0, slides=True)


class CamFollower(MateKind[CamFollowerSpec, "DiskCam | GrooveDisk", "FollowerEnd"]):
    """A follower on a disk, in a groove, or carried by a linkage."""

    name, keys = "cam_follower", CamFollowerSpec
    joins = tuple((cam, follower) for cam in ("cam", "groove_cam", "linkage_cam") for follower in FOLLOWERS)

    def mating(self, keys: CamFollowerSpec, first: End[Any], second: End[FollowerEnd]) -> CamFollowerMating:
        """The follower is the one that the cam was made for."""
        end = second.thing
        groove: GrooveDisk | None = first.thing if first.kind == "groove_cam" else None
        cam: Any = first.thing if groove is None else groove.cam
        lowest = float(abs(cam.reference_point(0.0)))
        carried = first.kind == "linkage_cam"
        if carried and end.arm_length is not None:
            raise ParameterError("kind", "follower_arm", "linkage_carries_follower")
        check_end(cam, end)
        if carried:
            distance = lowest
        else:
            _check_arm(cam, end)
            # to the pivot, or to the line of motion
            distance = cam.swing.centre_distance if cam.swings else abs(cam.slide.offset)
        _check_reach(cam, end)
        return (LinkageFollowerMating if carried else CamFollowerMating)(
            *self.joined(keys),
            height=keys.height,
            distance=distance,
            module=lowest,
            # play of a roller between the walls of its groove
            normal_backlash=0.0 if groove is None else groove.clearance,
            has_contact=touches(end),
            cam=cam,
            end=end,
            groove=groove,
        )


def touches(end: FollowerEnd) -> bool:
    """Stems and arms for rollers do not touch the cam: their roller does."""
    return end.kind != "roller" or end.outline is None


def sense_name(sense: int) -> str:
    """The sense of an arm as scenes have it."""
    return "against" if sense > 0 else "with"


def check_end(cam: DiskCam | WedgeCam, end: FollowerEnd) -> None:
    """Refuse another end, or one of another radius, than the cam is made for."""
    if end.kind != cam.kind:
        raise ParameterError("end", str(end.kind), "cam_has_another", Nearest(str(cam.kind)))
    stands_alone = end.outline is None
    if stands_alone or end.kind == "mushroom":
        key, factor = ("diameter", 2) if stands_alone else ("follower_radius", 1)
        same_as_cam(key, factor * end.radius, factor * cam.radius)


def check_mount(swings: bool, end: FollowerEnd) -> None:
    """Refuse a stem where the cam has an arm, or an arm where it has a stem."""
    if end.outline is not None and swings != (end.arm_length is not None):
        given, wanted = ("follower", "follower_arm") if swings else ("follower_arm", "follower")
        raise ParameterError("kind", given, "cam_wants", wanted=wanted)


def check_sense(end: FollowerEnd, sense: int) -> None:
    """Refuse an arm whose other side looks at the cam."""
    if end.sense != sense:
        raise ParameterError("sense", sense_name(end.sense), "cam_has_another", Nearest(sense_name(sense)))


def check_plate(end: FollowerEnd, least: float) -> None:
    """Refuse a plate over whose edge the contact runs; ``least``: its diameter, mm."""
    if end.reach is not None and not 2 * end.reach[1] >= least:
        raise ParameterError("plate_diameter", 2 * end.reach[1], "contact_over_edge", limit(least, 0.0))


def _check_arm(cam: DiskCam, end: FollowerEnd) -> None:
    check_mount(cam.swings, end)
    if end.arm_length is not None:
        mount = cam.swing
        check_sense(end, mount.sense)
        if cam.is_flat:
            same_as_cam("face_offset", end.face_offset, mount.face_offset)
        else:
            same_as_cam("arm_length", end.arm_length, mount.arm_length)


def _check_reach(cam: DiskCam, end: FollowerEnd) -> None:
    """The contact stays on a plate or a face."""
    if end.reach is None:
        return
    if end.arm_length is None:
        check_plate(end, cam.least_plate_diameter())
        return
    # face_reach counts from the axis' foot on the face towards the pivot
    from geometry.cams.contact.follower import reach_from_pivot

    far = reach_from_pivot(cam)
    if not end.reach[1] >= far:
        raise ParameterError("arm_length", end.reach[1], "contact_over_bar", limit(far, 0.0))

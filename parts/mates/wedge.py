"""A sliding cam plate and its follower (stem, arm, or roller): where it stands at a travel, contact over all of it."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta

from geometry.base.errors import ParameterError, limit
from geometry.base.record import replace
from parts.base.mate import End, MateKeys, MateKind, Pose, Standing, Touching
from parts.keys.base import mm
from parts.keys.mate import height
from parts.mates.follower import FOLLOWERS, check_end, check_mount, check_plate, check_sense, touches, travelled
from parts.mates.sizes import same_as_cam

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.cams.contact.outlines import FollowerEnd
    from geometry.cams.plane.wedge import WedgeCam
    from geometry.gears.mesh.search import PairContact
    from geometry.kinematics.mechanism import Joint
    from parts.base.mate import Frames


class WedgeFollowerSpec(MateKeys, tag="wedge_follower", kw_only=True):
    """Keys of ``wedge_follower``."""

    first: Annotated[str, Meta(description="instance of a wedge_cam that is already placed")]
    second: Annotated[str, Meta(description="its follower, follower_arm or roller")]
    travel: Annotated[float, mm("how far the plate has slid under its follower", least=0, most=1e7)] = 0.0
    height: Annotated[float, height("how far the follower's lower face stands above the plate's", 10_000)] = 0.0


class WedgeMating(Touching):
    """A sliding plate and its follower, or the roller of it, at a travel of the plate, mm."""

    cam: WedgeCam
    end: FollowerEnd
    travel: float

    follows = True

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The plate slides along its own x axis."""
        from geometry.kinematics.mechanism import Prismatic

        return (Prismatic(self.first),)

    def followed(self, start: Pose, now: Pose) -> Pose:
        """Where the follower stands on a plate that has slid to -x: over the same place of its guide."""
        slid = self.travel + ((start[0] - now[0]) * cmath.rect(1.0, -start[1])).real
        # before its law and after it the edge is straight
        travel = min(max(slid, 0.0), self.cam.motion.travel)
        centre, turned = replace(self, travel=travel).second_pose(*now, 0.0)
        return centre + (slid - travel) * cmath.rect(1.0, now[1]), turned

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """The follower where the plate at its travel has lifted it; it has no direction but the plate's."""
        from geometry.cams.contact.wedge import wedge_follower_pose

        at, lean = wedge_follower_pose(self.cam, self.end, self.travel)
        return centre + at * cmath.rect(1.0, rotation), rotation + lean

    def standing(self, first: Pose, second: Pose) -> Standing:
        """How far the follower is off its place across its way (added to the distance) and along it, mm."""
        import numpy as np

        from geometry.cams.contact.wedge import outwards
        from geometry.cams.plane.wedge import Swinging

        place, turned = self.second_pose(*first, 0.0)
        off = (second[0] - place) * cmath.rect(1.0, -first[1])
        lean = math.remainder(second[1] - turned, 2 * math.pi)
        if self.end.arm_length is not None:
            # an arm rises with its own turn: against it where its pivot stands at +x
            side = self.cam.mount.side if isinstance(self.cam.mount, Swinging) else 1
            risen = -side * lean * self.end.arm_length
            return Standing(self.distance + abs(off), risen, 0.0, slides=True)
        off *= 1j / complex(outwards(self.cam, np.asarray(self.travel)))
        lean = 0.0 if self.end.outline is None else lean * self.module
        return Standing(math.hypot(off.real, lean), off.imag, 0.0, slides=True)

    def driven(self, first: Frames, second: Frames) -> tuple[Finding, ...]:
        """Whether the plate slides from under its follower, whose centre then lies beyond an end of it."""
        from geometry.base.findings import Finding

        turned, at = first
        slid = self.travel + float((at[0] - at[-1]) @ turned[0, :, 0])
        travel = min(max(slid, 0.0), self.cam.motion.travel)
        over, (start, end) = float(self.cam.centre(travel).real) + slid - travel, self.cam.ends
        return () if start <= over <= end else (Finding("plate_runs_out", over, start if over < start else end),)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact | None:
        """Verdict over the whole travel; ``phase_off``: mm by which the follower stands too far out."""
        if not self.has_contact:
            return None
        from geometry.cams.contact.follower import CONTACT_TOLERANCE
        from geometry.cams.contact.wedge import wedge_contact

        return wedge_contact(self.cam, self.end, self.tolerated(CONTACT_TOLERANCE, tolerance), out=phase_off)

    def quantities(self) -> dict[str, Any]:
        """How far the follower moves, and where the plate stands, mm."""
        from geometry.cams.plane.wedge import Swinging

        swings = isinstance(self.cam.mount, Swinging)
        return travelled(self.cam.motion.lift, swings=swings) | {"plate_travel": self.travel}


class WedgeFollower(MateKind[WedgeFollowerSpec, "WedgeCam", "FollowerEnd"]):
    """A follower on a sliding plate."""

    name, keys = "wedge_follower", WedgeFollowerSpec
    joins = tuple(("wedge_cam", follower) for follower in FOLLOWERS)

    def mating(self, keys: WedgeFollowerSpec, first: End[WedgeCam], second: End[FollowerEnd]) -> WedgeMating:
        """The follower is the one that the plate was made for, and the plate slides so far."""
        from geometry.cams.contact.wedge import wedge_follower_pose
        from geometry.cams.plane.wedge import Swinging

        cam, end = first.thing, second.thing
        if end.kind == cam.kind and not keys.travel <= cam.motion.travel:
            raise ParameterError("mate.travel", keys.travel, "plate_slides_less", limit(cam.motion.travel, math.inf))
        check_end(cam, end)
        check_mount(isinstance(cam.mount, Swinging), end)
        if end.arm_length is not None and isinstance(cam.mount, Swinging):
            check_sense(end, cam.mount.side)
            same_as_cam("arm_length", end.arm_length, cam.mount.arm_length)
        if end.reach is not None and end.arm_length is None:
            check_plate(end, _least_plate(cam))
        return WedgeMating(
            self.name,
            keys.first,
            keys.second,
            direction_deg=90.0,
            height=keys.height,
            # to the pivot; a stem and a roller have none
            distance=0.0 if end.arm_length is None else abs(wedge_follower_pose(cam, end, keys.travel)[0]),
            # the height of the follower's centre at S = 0
            module=float(cam.centre(0.0).imag),
            has_contact=touches(end),
            cam=cam,
            end=end,
            travel=keys.travel,
        )


def _least_plate(cam: WedgeCam) -> float:
    """The diameter of a stem's mushroom plate over whose edge the contact does not run, mm."""
    import numpy as np

    slope = max(float(np.abs(p.value(p.extremes(1), 1)).max()) for p in cam.motion.pieces)
    return 2 * cam.radius * slope / math.hypot(1.0, slope)

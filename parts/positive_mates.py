"""Mates of positive drives: conjugate cams on one shaft, a cam and its yoke; contact from both sides over a turn."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta, Struct

from geometry.errors import ParameterError
from parts.joined import Joined
from parts.keys import mm
from parts.standing import Standing

if TYPE_CHECKING:
    from geometry.cams.disk import DiskCam
    from geometry.gears.mesh_search import PairContact
    from parts.conjugate_cam import SecondCam
    from parts.yoke_frame import YokeFrame

# contact is a gap within this part of the lowest follower's distance from the axis
_CONTACT = 1e-8
_Height = Annotated[
    float, mm("how far the second one's lower face stands above the first one's", least=-10_000, most=10_000)
]


class ConjugateCamsSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="conjugate_cams"):
    """A cam (first) and the conjugate cam made from it (second), keyed to one shaft."""

    first: Annotated[str, Meta(description="instance of a cam that is already placed")]
    second: Annotated[str, Meta(description="instance of the conjugate_cam made from it")]
    height: _Height = 0.0


class CamYokeSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="cam_yoke"):
    """A cam of constant breadth (first) and its yoke (second), lifted as the cam's own turn says."""

    first: Annotated[str, Meta(description="instance of a cam that is already placed")]
    second: Annotated[str, Meta(description="instance of the yoke_frame made from it")]
    direction_deg: Annotated[
        float, Meta(ge=-360, le=360, description="way of the yoke as it rises", extra={"unit": "degrees"})
    ] = 90.0
    height: _Height = 0.0


@dataclass(frozen=True, slots=True)
class ConjugateMating(Joined):
    """Both disks turn together; the contact is that of both rollers of their follower."""

    cam: DiskCam
    other: SecondCam
    kind: str = "conjugate_cams"
    distance: float = 0.0
    ratio: float = 1.0
    has_contact: bool = False

    @property
    def module(self) -> float:
        """The length that tolerances go by: the distance of the lowest roller from the axis, mm."""
        return float(abs(self.cam.reference_point(0.0)))

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """On the same axis, turned alike: the profile is drawn as it sits on the shaft."""
        return centre, rotation

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How far the axes stand apart, mm, and the second disk's turn against the first, rad."""
        turn = math.remainder(second[1] - first[1], 2 * math.pi)
        return Standing(0.0, abs(second[0] - first[0]), turn, 0.0, self.module)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one turn: the gaps under both rollers; ``phase_off`` rad: the second disk's turn."""
        from geometry.cams.positive_contact import between_rollers, conjugate_contact

        allowed = _CONTACT * self.module if tolerance is None else tolerance
        pair = self.other.pair
        return conjugate_contact(self.cam, pair, between_rollers(self.cam, pair), allowed, second_turn=phase_off)

    def quantities(self) -> dict[str, Any]:
        """How both rollers stand on their follower."""
        from geometry.cams.mounts import Translating
        from geometry.cams.positive_contact import between_rollers

        found = between_rollers(self.cam, self.other.pair)
        slides = isinstance(self.cam.mount, Translating)
        return {"between_rollers": found if slides else math.degrees(found), "unit": "mm" if slides else "deg"}


@dataclass(frozen=True, slots=True)
class YokeMating(Joined):
    """A cam and the yoke that touches it from both sides."""

    cam: DiskCam
    frame: YokeFrame
    kind: str = "cam_yoke"
    distance: float = 0.0
    ratio: None = None

    @property
    def has_contact(self) -> bool:
        """Flat faces touch the cam; of a plate with pins the rollers do."""
        return self.cam.is_flat

    @property
    def module(self) -> float:
        """The length that tolerances go by: the distance of the lowest face or roller from the axis, mm."""
        return float(abs(self.cam.reference_point(0.0)))

    @property
    def normal_backlash(self) -> float:
        """Play between both faces or rollers, mm."""
        return self.frame.play

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The frame is drawn about the axis as it stands at cam angle 0; S lifts it."""
        turned = direction - math.pi / 2
        lift = float(self.cam.motion.value(rotation - turned))
        return centre + lift * cmath.exp(1j * direction), turned

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How far the frame is off its place across its way (added to the distance) and along it, mm."""
        direction = math.radians(self.direction_deg)
        place, turned = self.second_pose(*first, direction)
        off = (second[0] - place) * cmath.exp(1j * (math.pi / 2 - direction))
        lean = math.remainder(second[1] - turned, 2 * math.pi) * self.module
        return Standing(direction, math.hypot(off.real, lean), off.imag, self.frame.play / 2, slides=True)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one turn of the cam; ``phase_off``: mm by which the frame stands too far out."""
        from geometry.cams.positive_contact import yoke_contact

        allowed = _CONTACT * self.module if tolerance is None else tolerance
        breadth = self.frame.breadth - self.frame.play
        return yoke_contact(self.cam, breadth, self.frame.play, allowed, out=phase_off)

    def quantities(self) -> dict[str, Any]:
        """Breadth between faces or roller centres with the play in it, and the lift, mm."""
        return {"yoke_breadth": self.frame.breadth, "lift": self.cam.motion.lift, "normal_backlash": self.frame.play}


def conjugate_mating(mate: ConjugateCamsSpec, cam: DiskCam, second: SecondCam) -> ConjugateMating:
    """The mating of two disks; the second one must be made from the first.

    Raises
    ------
    ParameterError
        It is made from another cam.
    """
    if second.first != cam:
        raise ParameterError("of", None, "is made from another cam than the mate's first; name that one")
    return ConjugateMating(mate.first, mate.second, 0.0, mate.height, cam, second)


def yoke_mating(mate: CamYokeSpec, cam: DiskCam, frame: YokeFrame) -> YokeMating:
    """The mating of a cam and its yoke; the yoke must be made from it.

    Raises
    ------
    ParameterError
        It is made from another cam.
    """
    if frame.cam != cam:
        raise ParameterError("of", None, "is made from another cam than the mate's first; name that one")
    return YokeMating(mate.first, mate.second, mate.direction_deg, mate.height, cam, frame)

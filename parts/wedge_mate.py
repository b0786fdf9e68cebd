"""A sliding cam plate and its follower (stem, arm, or roller): where it stands at a travel, contact over all of it."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Any

from msgspec import Meta, Struct

from geometry.errors import ParameterError, at_least, at_most
from parts.cam_mate import same_as_cam, sense_name
from parts.joined import Joined
from parts.keys import mm
from parts.standing import Standing

if TYPE_CHECKING:
    from geometry.cams.follower_shape import FollowerEnd
    from geometry.cams.wedge import WedgeCam
    from geometry.gears.mesh_search import PairContact


class WedgeFollowerSpec(Struct, forbid_unknown_fields=True, tag_field="kind", tag="wedge_follower"):
    """A wedge cam (first) and what follows it (second), which rises across the plate: rotation_deg turns both."""

    first: Annotated[str, Meta(description="instance of a wedge_cam that is already placed")]
    second: Annotated[str, Meta(description="its follower, follower_arm or roller")]
    travel: Annotated[float, mm("how far the plate has slid under its follower", least=0, most=1e7)] = 0.0
    height: Annotated[
        float, mm("how far the follower's lower face stands above the plate's", least=-10_000, most=10_000)
    ] = 0.0


@dataclass(frozen=True, slots=True)
class WedgeMating(Joined):
    """A sliding plate and its follower, or the roller of it, at a travel of the plate, mm."""

    cam: WedgeCam
    end: FollowerEnd
    travel: float
    kind: str = "wedge_follower"
    ratio: None = None

    @property
    def has_contact(self) -> bool:
        """Stems and arms for rollers do not touch the plate: their roller does."""
        return self.end.kind != "roller" or self.end.outline is None

    @property
    def module(self) -> float:
        """The length that tolerances go by: the height of the follower's centre at S = 0, mm."""
        return float(self.cam.centre(0.0).imag)

    @property
    def _is_arm(self) -> bool:
        return self.end.arm_length is not None

    @property
    def distance(self) -> float:
        """From the plate's origin to the pivot, mm; 0 of a stem or a roller."""
        from geometry.cams.wedge_contact import wedge_follower_pose

        return abs(wedge_follower_pose(self.cam, self.end, self.travel)[0]) if self._is_arm else 0.0

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The follower where the plate at its travel has lifted it; it has no direction but the plate's."""
        from geometry.cams.wedge_contact import wedge_follower_pose

        at, lean = wedge_follower_pose(self.cam, self.end, self.travel)
        return centre + at * cmath.rect(1.0, rotation), rotation + lean

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How far the follower is off its place across its way (added to the distance) and along it, mm."""
        from geometry.cams.wedge_contact import outwards

        place, turned = self.second_pose(*first, 0.0)
        off = (second[0] - place) * cmath.rect(1.0, -first[1])
        lean = math.remainder(second[1] - turned, 2 * math.pi)
        if self.end.arm_length is not None:
            # an arm rises with its own turn: against it where its pivot stands at +x
            risen = -getattr(self.cam.mount, "side", 1) * lean * self.end.arm_length
            return Standing(first[1], self.distance + abs(off), risen, 0.0, slides=True)
        off *= 1j / complex(outwards(self.cam, self._at))
        lean = 0.0 if self.end.outline is None else lean * self.module
        return Standing(first[1], math.hypot(off.real, lean), off.imag, 0.0, slides=True)

    @property
    def _at(self) -> Any:
        import numpy as np

        return np.asarray(self.travel)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact | None:
        """Verdict over the whole travel; ``phase_off``: mm by which the follower stands too far out."""
        if not self.has_contact:
            return None
        from geometry.cams.follower_contact import CONTACT_TOLERANCE
        from geometry.cams.wedge_contact import wedge_contact

        allowed = CONTACT_TOLERANCE * self.module if tolerance is None else tolerance
        return wedge_contact(self.cam, self.end, allowed, out=phase_off)

    def quantities(self) -> dict[str, Any]:
        """How far the follower moves, and where the plate stands, mm."""
        from geometry.cams.wedge import Swinging

        low, high = self.cam.motion.extremes()
        swings = isinstance(self.cam.mount, Swinging)
        moved = math.degrees(high - low) if swings else high - low
        return {"travel": moved, "unit": "deg" if swings else "mm", "plate_travel": self.travel}


def wedge_mating(mate: WedgeFollowerSpec, cam: WedgeCam, end: FollowerEnd) -> WedgeMating:
    """The mating, its follower held against what the plate was made for.

    Raises
    ------
    ParameterError
        Another kind or size of follower, or a travel beyond the plate's; names its key and what works.
    """
    from geometry.cams.wedge import Swinging

    if end.kind != cam.kind:
        raise ParameterError("end", str(end.kind), f'the plate is made for another follower; "{cam.kind}" works')
    if not mate.travel <= cam.motion.travel:
        text = f"the plate slides less; at most {at_most(cam.motion.travel)} mm works"
        raise ParameterError("mate.travel", mate.travel, text)
    stands_alone = end.outline is None
    if stands_alone or end.kind == "mushroom":
        key, factor = ("diameter", 2) if stands_alone else ("follower_radius", 1)
        same_as_cam(key, factor * end.radius, factor * cam.radius)
    swings = isinstance(cam.mount, Swinging)
    if not stands_alone and swings != (end.arm_length is not None):
        wanted = "follower_arm" if swings else "follower"
        raise ParameterError("kind", "follower" if swings else "follower_arm", f'"{wanted}" works with this plate')
    if end.arm_length is not None and isinstance(cam.mount, Swinging):
        if end.sense != cam.mount.side:
            text = f'the plate lies on the other side; "{sense_name(cam.mount.side)}" works'
            raise ParameterError("sense", sense_name(end.sense), text)
        same_as_cam("arm_length", end.arm_length, cam.mount.arm_length)
    _check_face(cam, end)
    return WedgeMating(mate.first, mate.second, 90.0, mate.height, cam, end, mate.travel)


def _check_face(cam: WedgeCam, end: FollowerEnd) -> None:
    """The contact stays on a stem's mushroom plate."""
    if end.reach is None or end.arm_length is not None:
        return
    import numpy as np

    slope = max(float(np.abs(p.value(p.extremes(1), 1)).max()) for p in cam.motion.pieces)
    least = 2 * cam.radius * slope / math.hypot(1.0, slope)
    if not 2 * end.reach[1] >= least:
        text = f"the contact runs over the plate's edge; at least {at_least(least, 4)} mm works"
        raise ParameterError("plate_diameter", 2 * end.reach[1], text)

"""Mates of a scene, kind by kind: how the second instance stands to the first, contact, quantities.

Every kind answers the same questions, so that placing, checks and reports need not know which one they have.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol

from parts.common_face import STRAIGHT, CommonFace
from parts.standing import Standing

if TYPE_CHECKING:
    from geometry.findings import Finding
    from geometry.gears.internal_pair import InternalPair
    from geometry.gears.mesh_search import PairContact
    from geometry.gears.pair import ExternalPair
    from geometry.gears.rack_pair import RackPair


class Mating(Protocol):
    """Two instances in mesh, with the gears as they are built; ``kind`` is the scene's."""

    @property
    def kind(self) -> str:
        """The scene's name of the mate."""

    @property
    def first(self) -> str:
        """Instance that was placed."""

    @property
    def second(self) -> str:
        """Instance in mesh with it."""

    @property
    def direction_deg(self) -> float:
        """Direction from the first to the second, as the scene has it."""

    @property
    def pair(self) -> Any:
        """The calculated pair of gears, None of other mates."""

    @property
    def distance(self) -> float:
        """Working centre distance, or from the axis to the datum line of a rack, mm."""

    @property
    def module(self) -> float:
        """m, mm."""

    @property
    def first_teeth(self) -> int:
        """Number of teeth of the first."""

    @property
    def normal_backlash(self) -> float:
        """j_bn, mm."""

    @property
    def ratio(self) -> float | None:
        """Turns of the second for one of the first, negative where they turn against each other; None: a rack."""

    @property
    def height(self) -> float:
        """How far the second's lower face stands above the first's, mm."""

    @property
    def has_contact(self) -> bool:
        """Whether ``contact`` decides how the outlines of two plates stand to each other; else their solids do."""

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """Axis (mm) and rotation (rad) of the second where the first stands so."""

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """How two placed instances (axis, rotation) stand to each other."""

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact | None:
        """Verdict over one pitch, the second that far off its exact place; None where nothing moves."""

    def findings(self) -> tuple[Finding, ...]:
        """Conditions of the pair that are not kept."""

    def quantities(self) -> dict[str, Any]:
        """What the calculation says, for reports."""


@dataclass(frozen=True, slots=True)
class ExternalMating:
    """Two external gears."""

    first: str
    second: str
    direction_deg: float
    pair: ExternalPair
    kind: str = "external_gear_pair"
    height: float = 0.0
    has_contact: bool = True
    face: CommonFace = STRAIGHT
    # cos(beta_b), see ``transverse.normal_share``
    normal_share: float = 1.0

    @property
    def distance(self) -> float:
        """Working centre distance, mm."""
        return self.pair.working_centre_distance

    @property
    def module(self) -> float:
        """m, mm."""
        return self.pair.module

    @property
    def first_teeth(self) -> int:
        """z_1."""
        return self.pair.first.number_of_teeth

    @property
    def normal_backlash(self) -> float:
        """j_bn, mm; the pair's own is that of its transverse section."""
        return self.pair.normal_backlash * self.normal_share

    @property
    def ratio(self) -> float:
        """-z_1 / z_2."""
        return -1 / self.pair.gear_ratio

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The second gear beyond the line of centres, a tooth in the first one's space."""
        axis = centre + cmath.rect(self.distance, direction)
        return axis, self.pair.second_rotation(rotation, direction)

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """Centre distance, and the second gear's turn off the middle of its backlash."""
        gear = self.pair.second
        direction = cmath.phase(second[0] - first[0])
        middle = self.pair.second_rotation(first[1], direction)
        turn = math.remainder(second[1] - middle, gear.pitch_angle)
        arm = gear.base_radius
        play = max(self.pair.normal_backlash, 0.0) / (2 * arm)
        return Standing(direction, abs(second[0] - first[0]), turn, play, arm)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one pitch of the first gear."""
        from geometry.gears.pair_contact import pair_contact

        overlap = self.face.overlap_ratio
        return pair_contact(
            self.pair, second_turn=phase_off, centre_shift=distance_off, tolerance=tolerance, overlap_ratio=overlap
        )

    def findings(self) -> tuple[Finding, ...]:
        """Conditions of the pair that are not kept."""
        return self.face.findings(self.pair.findings(), self.pair.effective_contact_ratio)

    def quantities(self) -> dict[str, Any]:
        """Practicum, lesson 3."""
        return {
            "gear_ratio": self.pair.gear_ratio,
            "working_pressure_angle_deg": math.degrees(self.pair.working_pressure_angle),
            "working_centre_distance": self.distance,
            "tip_shortening_coefficient": self.pair.tip_shortening_coefficient,
            "contact_ratio": self.pair.contact_ratio,
            "effective_contact_ratio": self.pair.effective_contact_ratio,
            **self.face.quantities(self.pair.effective_contact_ratio),
            "normal_backlash": self.normal_backlash,
        }


@dataclass(frozen=True, slots=True)
class InternalMating:
    """A pinion in a ring; ``ring_first``: the ring is the placed one. The pair itself has the ring at its origin."""

    first: str
    second: str
    direction_deg: float
    pair: InternalPair
    ring_first: bool
    kind: str = "internal_gear_pair"
    height: float = 0.0
    has_contact: bool = True
    face: CommonFace = STRAIGHT
    # cos(beta_b), see ``transverse.normal_share``
    normal_share: float = 1.0

    @property
    def distance(self) -> float:
        """Working centre distance, mm."""
        return self.pair.working_centre_distance

    @property
    def module(self) -> float:
        """m, mm."""
        return self.pair.module

    @property
    def first_teeth(self) -> int:
        """Number of teeth of the placed gear."""
        return self.pair.teeth[1 if self.ring_first else 0]

    @property
    def normal_backlash(self) -> float:
        """j_bn, mm; the pair's own is that of its transverse section."""
        return self.pair.normal_backlash * self.normal_share

    @property
    def ratio(self) -> float:
        """Both turn the same way."""
        return self.pair.gear_ratio if self.ring_first else 1 / self.pair.gear_ratio

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The second beside the first; the mesh lies on the pinion's side of the ring's axis."""
        axis = centre + cmath.rect(self.distance, direction)
        return axis, self._middle(rotation, direction)

    def _middle(self, rotation: float, direction: float) -> float:
        """Rotation of the second in the middle of the backlash."""
        if self.ring_first:
            return self.pair.pinion_rotation(rotation, direction)
        return self.pair.ring_rotation(rotation, direction + math.pi)

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """Centre distance, and the second one's turn off the middle of its backlash."""
        gear = self.pair.pinion if self.ring_first else self.pair.ring
        direction = cmath.phase(second[0] - first[0])
        turn = math.remainder(second[1] - self._middle(first[1], direction), gear.pitch_angle)
        arm = gear.base_radius
        play = max(self.pair.normal_backlash, 0.0) / (2 * arm)
        return Standing(direction, abs(second[0] - first[0]), turn, play, arm)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one pitch of the pinion."""
        from geometry.gears.internal_contact import internal_contact

        # a pinion that is ahead meets the flanks that a ring would meet that lags behind
        turn = -phase_off / self.pair.gear_ratio if self.ring_first else phase_off
        overlap = self.face.overlap_ratio
        return internal_contact(
            self.pair, ring_turn=turn, centre_shift=distance_off, tolerance=tolerance, overlap_ratio=overlap
        )

    def findings(self) -> tuple[Finding, ...]:
        """Conditions of the pair that are not kept: interference, assembly, clearance."""
        return self.face.findings(self.pair.findings(), self.pair.effective_contact_ratio)

    def quantities(self) -> dict[str, Any]:
        """Working quantities and the margins of the internal conditions."""
        return {
            "gear_ratio": self.pair.gear_ratio,
            "working_pressure_angle_deg": math.degrees(self.pair.working_pressure_angle),
            "working_centre_distance": self.distance,
            "contact_ratio": self.pair.contact_ratio,
            "effective_contact_ratio": self.pair.effective_contact_ratio,
            **self.face.quantities(self.pair.effective_contact_ratio),
            "normal_backlash": self.normal_backlash,
            "margins": {m.name: m.margin for m in self.pair.margins() if math.isfinite(m.margin)}
            | {"normal_backlash": self.normal_backlash},
        }


@dataclass(frozen=True, slots=True)
class RackMating:
    """A gear and a rack; the rack's teeth look at the gear's axis."""

    first: str
    second: str
    direction_deg: float
    pair: RackPair
    kind: str = "rack_pair"
    height: float = 0.0
    has_contact: bool = True
    face: CommonFace = STRAIGHT
    # cos(beta_b), see ``transverse.normal_share``
    normal_share: float = 1.0

    @property
    def distance(self) -> float:
        """From the gear's axis to the rack's datum line, mm."""
        return self.pair.distance

    @property
    def module(self) -> float:
        """m, mm."""
        return self.pair.module

    @property
    def first_teeth(self) -> int:
        """z of the gear."""
        return self.pair.gear.number_of_teeth

    @property
    def normal_backlash(self) -> float:
        """j_bn, mm; the pair's own is that of its transverse section."""
        return self.pair.normal_backlash * self.normal_share

    @property
    def ratio(self) -> None:
        """A rack does not turn."""
        return None

    @property
    def _middle_space(self) -> float:
        """x of the space nearest to the rack's middle, mm."""
        return 0.0 if self.pair.rack.number_of_teeth % 2 == 0 else self.pair.rack.pitch / 2

    def second_pose(self, centre: complex, rotation: float, direction: float) -> tuple[complex, float]:
        """The rack beyond the line of centres, its middle space about a tooth of the gear."""
        turned = math.remainder(rotation - direction, self.pair.gear.pitch_angle)
        along = self.pair.rack_position(turned) - self._middle_space
        return centre + cmath.rect(1.0, direction) * complex(self.distance, along), direction + math.pi / 2

    def standing(self, first: tuple[complex, float], second: tuple[complex, float]) -> Standing:
        """Distance of the datum line, and how far the rack is off the middle of its backlash, mm."""
        direction = second[1] - math.pi / 2
        place = (second[0] - first[0]) * cmath.rect(1.0, -direction)
        middle, _ = self.second_pose(0j, first[1], direction)
        off = place.imag - (middle * cmath.rect(1.0, -direction)).imag
        play = max(self.pair.normal_backlash, 0.0) / (2 * math.cos(self.pair.rack.rack.pressure_angle))
        return Standing(direction, place.real, math.remainder(off, self.pair.rack.pitch), play, slides=True)

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one pitch of the gear."""
        from geometry.gears.rack_contact import rack_contact

        overlap = self.face.overlap_ratio
        return rack_contact(
            self.pair, rack_shift=phase_off, distance_shift=distance_off, tolerance=tolerance, overlap_ratio=overlap
        )

    def findings(self) -> tuple[Finding, ...]:
        """Conditions of the pair that are not kept; a rack has the teeth that are in contact at once, and one more."""
        from geometry.findings import Finding

        teeth, needed = self.pair.rack.number_of_teeth, math.ceil(self.pair.contact_ratio) + 1
        short = (Finding("short_rack", float(teeth), float(needed)),) if teeth < needed else ()
        return self.face.findings((*self.pair.findings(), *short), self.pair.effective_contact_ratio)

    def quantities(self) -> dict[str, Any]:
        """Working quantities; the working circle is the reference circle."""
        return {
            "working_pressure_angle_deg": math.degrees(self.pair.rack.rack.pressure_angle),
            "working_centre_distance": self.distance,
            "travel_per_turn": self.pair.travel_per_turn,
            "contact_ratio": self.pair.contact_ratio,
            "effective_contact_ratio": self.pair.effective_contact_ratio,
            **self.face.quantities(self.pair.effective_contact_ratio),
            "normal_backlash": self.normal_backlash,
        }

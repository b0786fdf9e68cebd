"""The mates of involute gears: two external ones, a pinion in its ring, a gear on its rack.

Each sets distance and phase, and thins both gears for its backlash; the external pair shortens tips, and both gears
those that would reach the mate's fillet or root.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated, Any, Generic, Literal, TypeVar, cast

from msgspec import Meta

from geometry.base.errors import ConvergenceError, GeometryError, Nearest, ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import replace
from parts.base.mate import End, Pose, Standing, Toothed
from parts.keys.base import mm
from parts.keys.mate import InvolutePairKeys
from parts.mates.gear_pair import GearPair, as_far_as_teeth_follow
from parts.mates.sizes import same_size

if TYPE_CHECKING:
    import numpy as np
    from msgspec import Struct
    from numpy.typing import NDArray

    from geometry.base.findings import Finding
    from geometry.base.placement import Placement3
    from geometry.gears.mesh.search import MeshSearch, PairContact
    from geometry.gears.mesh.transmission_error import TransmissionError
    from geometry.gears.pairs.common_face import CommonFace
    from geometry.gears.pairs.external import ExternalPair
    from geometry.gears.pairs.internal import InternalPair
    from geometry.gears.pairs.rack import RackPair
    from geometry.gears.pairs.sector_mesh import SectorMesh, Steps
    from geometry.gears.teeth.rack import Rack
    from geometry.gears.teeth.ring import RingGear
    from geometry.gears.teeth.spur import SpurGear
    from geometry.kinematics.mechanism import Joint, Kind
    from parts.base.mate import Frames

    Pair = ExternalPair | InternalPair | RackPair

# of the module, by which tips are tried shorter
_SHORTER = (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
# what is no turn, rad
_SLIGHT = 1e-9


_INTERMITTENT = Meta(
    description="the first one, with a sector, turns so; the second stands while no tooth of it is in mesh",
    examples=["counter_clockwise"],
)


class ExternalGearPairSpec(InvolutePairKeys, tag="external_gear_pair", kw_only=True):
    """Keys of ``external_gear_pair``."""

    intermittent: Annotated[Literal["counter_clockwise", "clockwise"], _INTERMITTENT] | None = None


class InternalGearPairSpec(InvolutePairKeys, tag="internal_gear_pair"):
    """Keys of ``internal_gear_pair``."""


_WORKING_CENTRE_DISTANCE = mm(
    "from the gear's axis to the rack's datum line; default: r + x m", above=0, most=1e6, example=60.5
)


class RackPairSpec(InvolutePairKeys, tag="rack_pair", kw_only=True):
    """Keys of ``rack_pair``."""

    working_centre_distance: Annotated[float, _WORKING_CENTRE_DISTANCE] | None = None


class GearMating(Toothed):
    """Two involute gears in mesh, as they are built at last.

    ``normal_share``: of a gap in the transverse section that is left at right angles to the flanks, cos(beta_b).
    ``alone``: the same pair with the tips that its keys give it, where this mate made them shorter.
    ``sectors``: where the teeth of sectors are in mesh, by their place in the pair; ``steps``: of an intermittent one.
    """

    pair: Pair
    normal_share: float
    alone: ExternalPair | InternalPair | None = None
    sectors: tuple[tuple[int, SectorMesh], ...] = ()
    steps: Steps | None = None

    @property
    def uneven(self) -> bool:
        """Of an intermittent one."""
        return self.steps is not None

    @property
    def only_first_drives(self) -> bool:
        """A mate that no tooth touches moves nothing."""
        return self.steps is not None

    def partner(self, driver: str, rotation: float, direction: float) -> float:
        """The second one's rotation, while it stands too."""
        return self.second_rotation(rotation, direction)

    def place(self, end: int) -> int:
        """The place in the pair of the mate's first (0) or second (1)."""
        return end

    @property
    def stands_in_mesh(self) -> bool:
        """Where a sector moves the other to and fro."""
        return bool(self.sectors) and self.steps is None

    def sees(self, end: int) -> float:
        """The direction in which the mate's first or second sees the mesh, off that to the other's axis, rad."""
        return 0.0

    def towards(self, end: int, first: Frames, second: Frames) -> NDArray[np.float64]:
        """From the axis of the first or the second to the other's."""
        return second[1] - first[1] if end == 0 else first[1] - second[1]

    def driven(self, first: Frames, second: Frames) -> tuple[Finding, ...]:
        """Whether the teeth of a sector leave the mesh on the way of the drives."""
        if not self.stands_in_mesh:
            return ()
        import numpy as np

        from geometry.base.findings import Finding

        found, meshes = list[Finding](), dict(self.sectors)
        for end, (turned, _) in enumerate((first, second)):
            if (mesh := meshes.get(self.place(end))) is None:
                continue
            seen = (turned * self.towards(end, first, second)[..., None]).sum(-2)
            rho = np.unwrap(-np.arctan2(seen[..., 1], seen[..., 0]) - self.sees(end))
            beyond = mesh.beyond(float(rho.min()), float(rho.max()), float(rho[0]))
            if beyond > _SLIGHT:
                found.append(Finding("sector_leaves_mesh", math.degrees(beyond), math.degrees(mesh.mesh_angle)))
                found += mesh.jam
        return tuple(found)

    def _sectors(self) -> dict[str, Any]:
        """What sectors do: over which of their turns they are in mesh, and by how much they move the other."""
        told, meshes = [], dict(self.sectors)
        for end, name, other in ((0, self.first, self.second), (1, self.second, self.first)):
            if (mesh := meshes.get(self.place(end))) is None:
                continue
            low, high = map(math.degrees, mesh.ends())
            slides = isinstance(self, RackMating)
            way = (mesh.mesh_angle if self.steps is None else self.steps.moved * mesh.pitch) * mesh.rate
            told.append(
                {
                    "sector": name,
                    "mate": other,
                    "teeth": mesh.teeth,
                    "runs": mesh.runs,
                    "mesh_angle_deg": math.degrees(mesh.mesh_angle),
                    "mesh_from_deg": low,
                    "mesh_to_deg": high,
                    "entry_margin": mesh.entry_margin,
                    "intermittent": self.steps is not None,
                    **({"mate_travel": way} if slides else {"mate_turn_deg": math.degrees(way)}),
                }
            )
        return {"sectors": told} if told else {}

    def findings(self) -> tuple[Finding, ...]:
        """Conditions of the pair that are not kept, and the tips that are not those that the keys alone would give."""
        from geometry.base.findings import Finding

        found = self.face.findings(self.pair.findings(), self.pair.effective_contact_ratio)
        if self.alone is None:
            return found
        made = zip(self.alone.roles, self._tips(self.pair), self._tips(self.alone), strict=True)
        return *found, *(Finding(f"tips_shortened_{role}", at, had) for role, at, had in made if at != had)

    @staticmethod
    def _tips(pair: Pair) -> list[float]:
        """The tip diameters of both gears, mm."""
        return [2 * gear.tip_radius for gear in pair.gears]

    def _ratios(self) -> dict[str, Any]:
        """Contact ratios and backlash."""
        return {
            "contact_ratio": self.pair.contact_ratio,
            "effective_contact_ratio": self.pair.effective_contact_ratio,
            **self.face.quantities(self.pair.effective_contact_ratio),
            "normal_backlash": self.normal_backlash,
            **self._sectors(),
        }

    @property
    def joints(self) -> tuple[Joint, ...]:
        """Of an intermittent pair the ratio of whole turns: each run moves the second by its teeth."""
        if self.steps is None:
            return super().joints
        from geometry.kinematics.mechanism import Rolling

        assert self.rolls is not None
        moved = self.steps.moved * self.steps.mesh.runs
        return (Rolling(self.rolls, self.first, self.second, (moved, self.teeth[1]), sense=self.sense),)

    def _turned(self, first: Pose, second: Pose, gear: SpurGear | RingGear) -> Standing:
        """Centre distance, and the second gear's turn off the middle of its backlash."""
        return self.turned_off(first, second, gear.pitch_angle, gear.base_radius, self.pair.normal_backlash)

    def _mesh(self, phase_off: float, distance_off: float) -> MeshSearch:
        """The mesh, the second that far (rad, or mm of a rack) and the distance that many mm off."""
        raise NotImplementedError

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one pitch of the first gear, or of the pinion."""
        return self._mesh(phase_off, distance_off).contact(tolerance, self.face.overlap_ratio, self.normal_share)

    def _errors(self, distance_off: float) -> tuple[TransmissionError, TransmissionError, float]:
        """Errors where the first turns counter-clockwise and clockwise; the second's arm on the line of action, mm."""
        from geometry.gears.mesh.transmission_error import transmission_errors

        found = transmission_errors(self._mesh(0.0, distance_off), self.face.overlap_ratio)
        return *found, found[0].arm

    def transmission_error(self, distance_off: float) -> dict[str, Any]:
        """Peak to peak over a pitch, for each sense of the first's rotation; ``distance_off``: mm beyond the distance.

        ``line_of_action`` mm; and of the second: ``second_arcsec``, or ``second_travel`` mm where it is a rack. Empty
        where teeth slip past each other at some drive angle.
        """
        try:
            forward, backward, arm = self._errors(distance_off)
        except ConvergenceError:
            return {}
        return {"counter_clockwise": self._peaks(forward, arm), "clockwise": self._peaks(backward, arm)}

    def _peaks(self, error: TransmissionError, arm: float) -> dict[str, float]:
        motion = error.peak_to_peak / arm
        if isinstance(self, RackMating):
            return {"line_of_action": error.peak_to_peak, "second_travel": motion}
        return {"line_of_action": error.peak_to_peak, "second_arcsec": math.degrees(motion) * 3600}


class ExternalMating(GearMating):
    """Two external gears."""

    pair: ExternalPair

    def second_rotation(self, rotation: float, direction: float) -> float:
        """A tooth of one in a space of the other."""
        if self.steps is not None:
            rotation = direction + self.steps.advanced(rotation - direction)
        return self.pair.second_rotation(rotation, direction)

    def broken(self, direction: float) -> Mapping[str, dict[str, float]]:
        """An intermittent mate stands so that the first tooth comes in; else shorter tips of the sector, if any."""
        if (steps := self.steps) is None or steps.mesh.entry_margin >= 0:
            return {}
        from geometry.gears.pairs.external import external_pair
        from geometry.gears.pairs.sector_mesh import Steps, sector_meshes

        gear, mate = self.pair.gears
        given = 2 * gear.tip_radius

        def comes_in(tip: float) -> bool:
            pair = external_pair(replace(gear, given_tip_diameter=tip), mate, self.distance)
            mesh = sector_meshes(pair)[0]
            return mesh.entry_margin >= 0 and pair.contact_ratio > 0 and Steps(mesh, pair, steps.way).rest > 0

        found = nearest(comes_in, given, [given - share * gear.module for share in _SHORTER])
        turned = math.degrees(math.remainder(direction + steps.jams_at, math.tau))
        numbers = {"value": steps.mesh.entry_margin, "angle_deg": turned}
        if found is None or not isinstance(found.value, float):
            return {"first_tooth_jams": numbers}
        return {"first_tooth_jams_unless_shorter": numbers | {"tip_diameter": found.value}}

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and the second gear's turn off the middle of its backlash."""
        return self._turned(first, second, self.pair.second)

    def _mesh(self, phase_off: float, distance_off: float) -> MeshSearch:
        from geometry.gears.mesh.gears import GearMesh

        return GearMesh(self.pair, phase_off, distance_off)

    def quantities(self) -> dict[str, Any]:
        """Practicum, lesson 3."""
        return {
            "gear_ratio": self.pair.gear_ratio,
            "working_pressure_angle_deg": math.degrees(self.pair.working_pressure_angle),
            "working_centre_distance": self.distance,
            # of the section's pair in transverse modules, told in normal ones as scenes have them
            "tip_shortening_coefficient": self.pair.tip_shortening_coefficient / math.cos(self.face.helix.angle),
            **self._ratios(),
        }


class InternalMating(GearMating):
    """A pinion in a ring, in either order. The pair itself has the ring at its origin."""

    pair: InternalPair

    @property
    def ring_first(self) -> bool:
        """Whether the ring is the placed one."""
        return self.teeth[0] > self.teeth[1]

    def place(self, end: int) -> int:
        """The pinion is the pair's first."""
        return 1 - end if self.ring_first else end

    def sees(self, end: int) -> float:
        """A pinion sees the mesh away from the ring's axis."""
        return 0.0 if self.place(end) else math.pi

    def second_rotation(self, rotation: float, direction: float) -> float:
        """A tooth of one in a space of the other."""
        if self.ring_first:
            return self.pair.pinion_rotation(rotation, direction)
        return self.pair.second_rotation(rotation, direction + math.pi)

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Centre distance, and the second one's turn off the middle of its backlash."""
        return self._turned(first, second, self.pair.pinion if self.ring_first else self.pair.ring)

    def _mesh(self, phase_off: float, distance_off: float) -> MeshSearch:
        from geometry.gears.mesh.gears import GearMesh

        # a pinion that is ahead meets the flanks that a ring would meet that lags behind
        turn = -phase_off / self.pair.gear_ratio if self.ring_first else phase_off
        return GearMesh(self.pair, turn, distance_off)

    def _errors(self, distance_off: float) -> tuple[TransmissionError, TransmissionError, float]:
        found = GearMating._errors(self, distance_off)
        if self.ring_first:
            # a ring that drives counter-clockwise pushes the flanks with which a pinion would drive clockwise
            return found[1], found[0], self.pair.pinion.base_radius
        return found

    def quantities(self) -> dict[str, Any]:
        """Working quantities and the margins of the internal conditions."""
        return {
            "gear_ratio": self.pair.gear_ratio,
            "working_pressure_angle_deg": math.degrees(self.pair.working_pressure_angle),
            "working_centre_distance": self.distance,
            **self._ratios(),
            "margins": {m.name: m.margin for m in self.pair.margins() if math.isfinite(m.margin)}
            | {"normal_backlash": self.normal_backlash},
        }


class RackMating(GearMating):
    """A gear and a rack; the rack's teeth look at the gear's axis."""

    pair: RackPair

    @property
    def joints(self) -> tuple[Joint, ...]:
        """The rack slides along its own x axis; pi times this module is its pitch along it."""
        from geometry.kinematics.mechanism import Prismatic, Rolling

        rolling = Rolling("rack", self.first, self.second, (self.teeth[0], 1), module=Fraction(str(self.module)))
        return Prismatic(self.second), rolling

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """The rack beyond the line of centres, its middle space about a tooth of the gear."""
        turned = math.remainder(rotation - direction, self.pair.gear.pitch_angle)
        # of an odd number of teeth one stands in the rack's middle
        space = 0.0 if self.pair.rack.number_of_teeth % 2 == 0 else self.pair.rack.pitch / 2
        along = self.pair.rack_position(turned) - space
        return centre + cmath.rect(1.0, direction) * complex(self.distance, along), direction + math.pi / 2

    def centres_direction(self, offset: complex, stand: Placement3) -> float:
        """Against the rack's teeth, wherever its middle has slid."""
        (_, x, _), (_, y, _), _ = stand.rotation
        return cmath.phase(-complex(x, y) or offset)

    def standing(self, first: Pose, second: Pose) -> Standing:
        """Distance of the datum line, and how far the rack is off the middle of its backlash, mm."""
        direction = second[1] - math.pi / 2
        place = (second[0] - first[0]) * cmath.rect(1.0, -direction)
        middle, _ = self.second_pose(0j, first[1], direction)
        off = place.imag - (middle * cmath.rect(1.0, -direction)).imag
        play = max(self.pair.normal_backlash, 0.0) / (2 * math.cos(self.pair.rack.rack.pressure_angle))
        return Standing(place.real, math.remainder(off, self.pair.rack.pitch), play, slides=True)

    def _mesh(self, phase_off: float, distance_off: float) -> MeshSearch:
        from geometry.gears.mesh.rack import RackMesh

        return RackMesh(self.pair, phase_off, distance_off)

    def findings(self) -> tuple[Finding, ...]:
        """Conditions of the pair that are not kept; a rack has the teeth that are in contact at once, and one more."""
        from geometry.base.findings import Finding

        teeth, needed = self.pair.rack.number_of_teeth, math.ceil(self.pair.contact_ratio) + 1
        short = (Finding("short_rack", float(teeth), float(needed)),) if teeth < needed else ()
        return self.face.findings((*self.pair.findings(), *short), self.pair.effective_contact_ratio)

    def driven(self, first: Frames, second: Frames) -> tuple[Finding, ...]:
        """Whether the rack slides out of the mesh: its middle then lies half its length or more from the gear."""
        from geometry.base.findings import Finding

        turned, middle = second
        found = super().driven(first, second)
        farthest = float(abs(((middle - first[1]) * turned[..., 0]).sum(-1)).max())
        half = self.pair.rack.length / 2
        return (*found, Finding("rack_runs_out", farthest, half)) if farthest > half else found

    def towards(self, end: int, first: Frames, second: Frames) -> NDArray[np.float64]:
        """Against the rack's teeth."""
        return -second[0][..., 1]

    def quantities(self) -> dict[str, Any]:
        """Working quantities; the working circle is the reference circle."""
        return {
            "working_pressure_angle_deg": math.degrees(self.pair.rack.rack.pressure_angle),
            "working_centre_distance": self.distance,
            "travel_per_turn": self.pair.travel_per_turn,
            **self._ratios(),
        }


def _sectors(keys: InvolutePairKeys, pair: Pair, face: CommonFace) -> dict[str, Any]:
    """What a mating says of the sectors of its pair, nothing where there is none.

    Raises
    ------
    ParameterError
        What is to move the other step by step is no sector, or helical, or never lets it stand; or that is a sector.
    """
    way: str | None = getattr(keys, "intermittent", None)
    if way is None and all(gear.sector is None for gear in pair.gears):
        return {}
    from geometry.gears.pairs.external import ExternalPair
    from geometry.gears.pairs.sector_mesh import Steps, sector_meshes

    found = sector_meshes(pair, math.copysign(face.overlap_ratio, face.helix.signed_angle))
    if way is None or not isinstance(pair, ExternalPair):
        return {"sectors": tuple(found.items())}
    if 0 not in found:
        raise ParameterError("mate.intermittent", way, "intermittent_needs_sector", Nearest(None))
    if 1 in found:
        raise ParameterError("mate.intermittent", way, "intermittent_needs_whole_mate", Nearest(None))
    if face.helix.angle:
        raise ParameterError("mate.intermittent", way, "intermittent_needs_straight_teeth", Nearest(None))
    steps = Steps(found[0], pair, 1 if way == "counter_clockwise" else -1)
    if steps.rest <= 0:
        raise ParameterError("mate.intermittent", way, "intermittent_never_stands", Nearest(None))
    return {"sectors": tuple(found.items()), "steps": steps}


A = TypeVar("A")
B = TypeVar("B")
K = TypeVar("K", bound=InvolutePairKeys)
M = TypeVar("M", bound=GearMating)


class InvolutePair(GearPair[K, A, B], Generic[K, A, B, M]):
    """What the three have in common: helices that mesh, distance, thinning. Of a ring its keys are blamed."""

    meshes = True
    internal = False

    # what their mating is, and as what pair they roll
    mated: type[M]
    rolls: Kind

    def paired(self, first: End[A], second: End[B], distance: float | None) -> Pair:
        """Both at a distance, mm; None: that of the shifts.

        Raises
        ------
        ParameterError
            They do not mesh, or not at ``working_centre_distance``.
        """
        raise NotImplementedError

    def made(self, keys: K, first: End[Any], second: End[Any], distance: float | None) -> M:
        """The mating of ``paired``."""
        from parts.keys.helix import common_face

        pair, share = self.paired(first, second, distance), self.normal_share(first, second)
        face = common_face(first.keys, second.keys)
        return self.mated(
            *self.joined(keys),
            distance=pair.working_centre_distance,
            rolls=self.rolls,
            teeth=(first.thing.number_of_teeth, second.thing.number_of_teeth),
            module=pair.module,
            normal_backlash=pair.normal_backlash * share,
            normal_share=share,
            pair=pair,
            face=face,
            **_sectors(keys, pair, face),
        )

    def pressure_angle(self, first: End[Any], second: End[Any]) -> float:
        """Of the external gear, in the section in which both are, rad."""
        gear = first if first.kind == "spur_gear" else second
        return float(gear.thing.rack.pressure_angle)

    def build(self, end: End[Any]) -> object:
        """A tooth of a gear, a ring or a rack."""
        if end.kind == "ring_gear":
            from geometry.gears.teeth.ring_limits import checked_ring

            return checked_ring(end.thing)
        if end.kind == "rack":
            from geometry.gears.teeth.rack import checked_part_rack

            return checked_part_rack(end.thing)
        from geometry.gears.teeth.tooth import tooth_side

        return tooth_side(end.thing)

    def check(self, keys: K, first: Any, second: Any) -> None:
        """Helices that mesh, and one normal section: in the keys of the parts, before their transverse sections."""
        from parts.keys.helix import helix_of

        one, two = helix_of(first), helix_of(second)
        if (one.angle == 0) is not (two.angle == 0):
            # straight teeth mesh with straight ones; the same angle would need the other hand too
            owner, bent = ("first.", first) if two.angle == 0 else ("", second)
            raise ParameterError(f"{owner}helix_angle_deg", bent.helix_angle_deg, "mate_is_straight", Nearest(0.0))
        if one.angle:
            from geometry.gears.teeth.helix import mesh_fault

            fault = mesh_fault(one, two, internal=self.internal)
            if fault is not None:
                raise ParameterError(*fault)
        # the points of both herringbones stand half way up
        gear, mate, owner = first, second, ""
        if first.__struct_config__.tag != "spur_gear":
            # what a gear runs in is made for it
            gear, mate, owner = second, first, "first."
        for key in ("module", "pressure_angle_deg", *["face_width"] * one.double):
            same_size(f"{owner}{key}", getattr(mate, key), getattr(gear, key), "not_that_of_mate")

    def there(self, keys: K, first: End[A], second: End[B]) -> float | None:
        """That of the distance."""
        return (
            None if keys.working_centre_distance is None else self._reaching(keys, first, second).pair.normal_backlash
        )

    def cosine(self, first: End[A], second: End[B]) -> float:
        """Of both, in their section."""
        return math.cos(self.pressure_angle(first, second))

    def normal_share(self, first: End[A], second: End[B]) -> float:
        """j_bn over the backlash of transverse sections: cos(beta_b)."""
        from parts.keys.helix import helix_of

        helix = helix_of(first.keys)
        if not helix.angle:
            return 1.0
        from geometry.gears.teeth.transverse import normal_share

        return normal_share(self.pressure_angle(first, second), helix.angle)

    def tips(self, keys: K, first: End[A], second: End[B]) -> tuple[float | None, float | None]:
        """None is changed; the teeth must reach each other."""
        self._reaching(keys, first, second)
        return None, None

    def mating(self, keys: K, first: End[A], second: End[B]) -> M:
        """At the distance that the keys give."""
        return self.made(keys, first, second, keys.working_centre_distance)

    def _reaching(self, keys: K, first: End[Any], second: End[Any]) -> M:
        """The mating at the distance that the keys give, at which the teeth must reach each other."""
        distance = keys.working_centre_distance
        code, numbers = "teeth_do_not_reach", dict[str, Any]()
        touching: Nearest | None = None
        try:
            made = self.made(keys, first, second, distance)
            if distance is None or made.pair.contact_ratio > 0:
                return made
        except ParameterError as refusal:
            if distance is None or refusal.name != "working_centre_distance":
                raise self._in_normal_terms(refusal, first, second) from refusal
            code, numbers, touching = refusal.code, refusal.numbers, refusal.nearest

        def cure() -> Nearest | None:
            """From the distance of the shifts on: as far as tooth follows tooth, no more backlash than is asked."""
            try:
                nominal = self.made(keys, first, second, None)
            except ParameterError:
                # shifts without a distance of their own
                return touching

            def ratio(at: float) -> float:
                made = self.made(keys, first, second, at)
                return made.pair.contact_ratio if keys.leaves(made.normal_backlash) else 0.0

            toward = nominal.distance if keys.leaves(nominal.normal_backlash) else nominal.pair.touching_distance
            return as_far_as_teeth_follow(ratio, min(1.0, nominal.pair.contact_ratio), distance, toward, 1.0)

        raise ParameterError("mate.working_centre_distance", distance, code, cure, **numbers)

    def _in_normal_terms(self, refusal: ParameterError, first: End[Any], second: End[Any]) -> ParameterError:
        """A refusal of transverse sections with the normal value that the blamed part's keys give."""
        from parts.keys.helix import in_normal_terms

        one, other, owner = (first, second, "first.") if first.kind == "ring_gear" else (second, first, "")
        return in_normal_terms(refusal, one.keys, other.keys).renamed(owner + refusal.name)


class YieldingPair(InvolutePair[K, A, B, M], Generic[K, A, B, M]):
    """Two gears whose tips yield, unless given, where they would reach the mate's fillet or root."""

    def mating(self, keys: K, first: End[Any], second: End[Any]) -> M:
        """At the distance that the keys give, and whose tips are not those of its keys."""
        made = super().mating(keys, first, second)
        one, two = (replace(e, thing=replace(e.thing, given_tip_diameter=_given(e))) for e in (first, second))
        try:
            alone = cast("ExternalPair | InternalPair", self.made(keys, one, two, keys.working_centre_distance).pair)
            yields = any(_off_roots(alone, first, second))
        except GeometryError:
            # pointed with the tip that its keys give it
            return made
        return replace(made, alone=alone) if yields else made


def _off_roots(
    pair: ExternalPair | InternalPair, first: End[Any], second: End[Any]
) -> tuple[float | None, float | None]:
    """Tip radii, mm, of both ends of a pair that keep off; None: as they are, as one is whose tip is given."""
    tips = pair.tips_off_roots()
    one, two = tips[::-1] if first.kind == "ring_gear" else tips
    return one if _given(first) is None else None, two if _given(second) is None else None


class ExternalGearPair(YieldingPair[ExternalGearPairSpec, "SpurGear", "SpurGear", ExternalMating]):
    """Two external gears; their tips are shortened where the shifts bring them too near."""

    name, keys, mated, rolls = "external_gear_pair", ExternalGearPairSpec, ExternalMating, "external"
    joins = (("spur_gear", "spur_gear"),)

    def tip_beside(self, keys: ExternalGearPairSpec, part: Struct, other: Struct) -> tuple[float, ...]:
        """That of the pair of both as they are alone."""
        from geometry.gears.pairs.external import tip_beside
        from parts.gears.spur_gear.part import SpurGearSpec, bare_section

        if not (isinstance(part, SpurGearSpec) and isinstance(other, SpurGearSpec)):
            return ()
        return (tip_beside(bare_section(part), bare_section(other), keys.working_centre_distance),)

    def paired(self, first: End[SpurGear], second: End[SpurGear], distance: float | None) -> ExternalPair:
        """Both gears."""
        from geometry.gears.pairs.external import external_pair

        return external_pair(first.thing, second.thing, distance)

    def tips(
        self, keys: ExternalGearPairSpec, first: End[SpurGear], second: End[SpurGear]
    ) -> tuple[float | None, float | None]:
        """Those of the pair, which must leave something of the involutes, or those that keep off roots."""
        from geometry.gears.pairs.external import external_pair

        pair = self._reaching(keys, first, second).pair
        gears, distance = (first.thing, second.thing), keys.working_centre_distance

        def works(shift: float) -> bool:
            changed = replace(gears[1], profile_shift_coefficient=shift)
            return external_pair(gears[0], changed, distance).contact_ratio > 0

        given = gears[1].profile_shift_coefficient
        try:
            for gear, bare in zip(pair.gears, gears, strict=True):
                if gear.tip_radius < bare.tip_radius:
                    self.build(End(first.keys, gear))
        except GeometryError as fault:
            ends = [given + sign * 0.05 * 1.4**k for k in range(11) for sign in (-1, 1)]
            raise ParameterError(
                "profile_shift_coefficient",
                given,
                "shortened_tips_keep_no_involute",
                lambda: nearest(works, given, ends),
            ) from fault
        one, two = _off_roots(pair, first, second)
        return one or pair.first.tip_radius, two or pair.second.tip_radius


class InternalGearPair(
    YieldingPair[InternalGearPairSpec, "SpurGear | RingGear", "SpurGear | RingGear", InternalMating]
):
    """A pinion in its ring, in either order."""

    name, keys, mated, rolls = "internal_gear_pair", InternalGearPairSpec, InternalMating, "internal"
    joins = (("ring_gear", "spur_gear"), ("spur_gear", "ring_gear"))
    internal = True

    def paired(self, first: End[Any], second: End[Any], distance: float | None) -> InternalPair:
        """The pinion in its ring."""
        from geometry.gears.pairs.internal import internal_pair

        pinion, ring = (second, first) if first.kind == "ring_gear" else (first, second)
        return internal_pair(pinion.thing, ring.thing, distance)

    def tips(self, keys: InternalGearPairSpec, first: End[Any], second: End[Any]) -> tuple[float | None, float | None]:
        """Those that keep off the mate's fillet and root; a given tip diameter stays."""
        return _off_roots(self._reaching(keys, first, second).pair, first, second)


def _given(end: End[Any]) -> float | None:
    """The tip diameter that its keys give."""
    return float(end.thing.given_tip_diameter) if getattr(end.keys, "tip_diameter", None) is not None else None


class RackGearPair(InvolutePair[RackPairSpec, "SpurGear", "Rack", RackMating]):
    """A gear on its rack."""

    name, keys, mated, rolls = "rack_pair", RackPairSpec, RackMating, "rack"
    joins = (("spur_gear", "rack"),)

    def paired(self, first: End[SpurGear], second: End[Rack], distance: float | None) -> RackPair:
        """The gear on its rack."""
        from geometry.gears.pairs.rack import rack_pair

        return rack_pair(first.thing, second.thing, distance)

"""Two helical gears on crossed axes: the second is laid at the angle that the helices make, a tooth in a space."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Annotated, Any

from msgspec.structs import replace as changed

from geometry.base.errors import Nearest, ParameterError
from geometry.base.nearest import kept
from geometry.base.record import replace
from parts.base.mate import End, LaidStanding, MateKind, Pose, Touching
from parts.gears.thinning import shared_thinning
from parts.keys.base import MadeKeys, degrees
from parts.keys.helix import helix_of
from parts.keys.mate import InvolutePairKeys
from parts.mates.gear_pair import as_far_as_teeth_follow
from parts.mates.sizes import same_sizes

if TYPE_CHECKING:
    from geometry.base.findings import Finding
    from geometry.base.placement import Placement3, Vector
    from geometry.gears.mesh.search import PairContact
    from geometry.gears.pairs.crossed import CrossedPair
    from geometry.gears.teeth.spur import SpurGear

# between axes that are parallel, rad
_PARALLEL = 1e-7

ShaftAngle = Annotated[
    float,
    degrees(
        "angle between both axes; default: the sum of both operating helix angles, of opposite hands their difference",
        least=0,
        most=180,
        example=90.0,
    ),
]


class CrossedHelicalPairSpec(InvolutePairKeys, tag="crossed_helical_pair", kw_only=True):
    """Keys of ``crossed_helical_pair``."""

    shaft_angle_deg: ShaftAngle | None = None


class CrossedMating(Touching):
    """Two helical gears; their face widths have their middles on the line of centres."""

    pair: CrossedPair

    lies = True
    asks_height = False

    def second_axis(self, direction: float) -> Vector:
        """Turned from the first's about the line of centres."""
        aside = cmath.rect(math.sin(self.pair.shaft_angle), direction + math.pi / 2)
        return aside.real, aside.imag, math.cos(self.pair.shaft_angle)

    def second_pose(self, centre: complex, rotation: float, direction: float) -> Pose:
        """Where a space of the second stands about a tooth of the first, or a tooth in its space."""
        aside = complex(self.distance, -self.pair.feet[1] * math.sin(self.pair.shaft_angle))
        return centre + cmath.rect(1.0, direction) * aside, self.pair.second_rotation(rotation, direction)

    def centres_direction(self, offset: complex, stand: Placement3) -> float:
        """At right angles to both axes."""
        x, y, _ = stand.z
        across = complex(y, -x) or offset
        return cmath.phase(across * math.copysign(1.0, (across.conjugate() * offset).real))

    def laid(self, first: Placement3, second: Placement3) -> CrossedMating:
        """The same pair with its faces where they stand: each may be moved along its axis."""
        from geometry.gears.pairs.crossed import crossing

        return replace(self, pair=replace(self.pair, feet=crossing(first.inverse() @ second)[1]))

    def laid_standing(self, first: Placement3, second: Placement3) -> LaidStanding:
        """In the frame of the first, where its tooth is on +x: distance and angle of the axes, turn of the second."""
        from geometry.base.placement import Placement3
        from geometry.gears.pairs.crossed import crossing

        seen = first.inverse() @ second
        offset, feet = crossing(seen)
        pair, direction = replace(self.pair, feet=feet), cmath.phase(offset)
        x, y, z = seen.z
        # about the line of centres, the way that the hands have it
        side = (complex(x, y) * cmath.rect(1.0, -direction)).imag * math.copysign(1.0, pair.shaft_angle)
        off = Placement3.towards(seen.z, pair.second_rotation(0.0, direction)).inverse() @ seen
        arm = pair.arms[1]
        return LaidStanding(
            abs(offset), math.atan2(side, z), abs(pair.shaft_angle),
            math.remainder(off.turn, pair.second.pitch_angle), self.normal_backlash / 2 / arm, arm,
            max(*pair.face_widths), "centre_distance", pair.working_centre_distance,
        )  # fmt: skip

    def contact(self, phase_off: float, distance_off: float, tolerance: float | None) -> PairContact:
        """Verdict over one pitch of the first gear."""
        from geometry.gears.mesh.crossed import crossed_contact

        return crossed_contact(self.pair, phase_off, tolerance)

    def findings(self) -> tuple[Finding, ...]:
        """Conditions of the pair that are not kept."""
        return self.pair.findings()

    def quantities(self) -> dict[str, Any]:
        """Distance, angles, contact ratio, sliding."""
        pair = self.pair
        helices = [math.degrees(angle) for angle in pair.working_helices]
        return {
            "ratio": pair.ratio,
            "working_centre_distance": self.distance,
            "shaft_angle_deg": math.degrees(abs(pair.shaft_angle)),
            "working_pressure_angle_deg": math.degrees(pair.working_pressure_angle),
            "working_helix_angle_deg": dict(zip(("first", "second"), helices, strict=True)),
            "contact_ratio": pair.contact_ratio,
            "least_face_width": dict(zip(("first", "second"), pair.least_face_widths, strict=True)),
            "sliding_per_rad": pair.sliding(pair.pole),
            "normal_backlash": self.normal_backlash,
        }


class CrossedHelicalPair(MateKind[CrossedHelicalPairSpec, "SpurGear", "SpurGear"]):
    """Two external gears, of which one may be straight."""

    name, keys = "crossed_helical_pair", CrossedHelicalPairSpec
    joins = (("spur_gear", "spur_gear"),)

    def check(self, keys: CrossedHelicalPairSpec, first: Any, second: Any) -> None:
        """One normal section, and helices that make an angle."""
        one, two = helix_of(first), helix_of(second)
        for owner, helix in (("first.", one), ("", two)):
            if helix.double:
                raise ParameterError(f"{owner}double_helical", True, "no_herringbone_on_crossed_axes", Nearest(False))
        same_sizes(("module", "pressure_angle_deg"), second, first, "not_that_of_mate")
        if abs(one.signed_angle + two.signed_angle) < _PARALLEL:
            if one.angle == 0:
                raise ParameterError("helix_angle_deg", second.helix_angle_deg, "axes_would_be_parallel", Nearest(45.0))
            other = {"right": "left", "left": "right"}[second.hand]
            raise ParameterError("hand", second.hand, "axes_would_be_parallel", Nearest(other))

    def thinning(
        self, keys: CrossedHelicalPairSpec, first: End[SpurGear], second: End[SpurGear]
    ) -> tuple[float, float]:
        """What the backlash asks for beyond that of distance and angle: half each, in the normal section."""
        if keys.normal_backlash is None:
            return 0.0, 0.0
        from geometry.gears.teeth.tooth import tooth_side
        from geometry.gears.teeth.transverse import normal_angle

        gears, cosines = (first.thing, second.thing), [math.cos(helix_of(end.keys).angle) for end in (first, second)]
        there = None if keys.working_centre_distance is None else self.reaching(keys, first, second).normal_backlash
        normal = [
            replace(gear, circumferential_thinning=gear.circumferential_thinning * cosine)
            for gear, cosine in zip(gears, cosines, strict=True)
        ]

        def build(index: int, thinning: float) -> object:
            return tooth_side(replace(gears[index], circumferential_thinning=thinning / cosines[index]))

        angle = normal_angle(gears[0].pressure_angle, helix_of(first.keys).angle)
        one, two = shared_thinning(keys.normal_backlash, normal, build, math.cos(angle), there)
        return one / cosines[0], two / cosines[1]

    def tips(
        self, keys: CrossedHelicalPairSpec, first: End[SpurGear], second: End[SpurGear]
    ) -> tuple[float | None, float | None]:
        """Those of the pair, shortened where the distance is less than the shifts have it; the teeth must reach."""
        pair = self.reaching(keys, first, second)
        return pair.first.tip_radius, pair.second.tip_radius

    def mating(self, keys: CrossedHelicalPairSpec, first: End[SpurGear], second: End[SpurGear]) -> CrossedMating:
        """At the distance and the angle that the keys give."""
        pair = self.made(keys, first, second)
        angle = pair.shaft_angle
        return CrossedMating(
            *self.joined(keys),
            height=pair.feet[0] - pair.feet[1] * math.cos(angle),
            distance=pair.working_centre_distance,
            module=pair.normal_module,
            normal_backlash=pair.normal_backlash,
            # along the line of centres both turn against each other, whatever their hands
            rolls="crossed",
            sense=-1,
            teeth=(pair.first.number_of_teeth, pair.second.number_of_teeth),
            pair=pair,
        )

    def reaching(self, keys: CrossedHelicalPairSpec, first: End[SpurGear], second: End[SpurGear]) -> CrossedPair:
        """The pair, whose teeth must reach each other where distance or angle are asked for."""
        asked = [key for key in ("shaft_angle_deg", "working_centre_distance") if getattr(keys, key) is not None]
        code = "teeth_do_not_reach"
        try:
            pair = self.made(keys, first, second)
            if pair.contact_ratio > 0 or not asked:
                return pair
        except ParameterError as refusal:
            if refusal.name != "shaft_angle" and refusal.code != code:
                raise
            code = refusal.code

        def tried(key: str, value: float | None) -> CrossedPair:
            return self.made(changed(keys, **{key: value}), first, second)

        # the one without which they reach each other; none of them where both are wrong
        alone = [key for key in asked if kept(lambda name: tried(name, None).contact_ratio > 0, key)]
        key = (alone or asked)[0]
        given = getattr(keys, key)

        def cure() -> Nearest | None:
            """From what both make of themselves on: as far as tooth follows tooth, no more backlash than is asked."""
            if not alone:
                return None
            own = tried(key, None)
            if key == "shaft_angle_deg":
                toward = math.degrees(abs(own.shaft_angle))
            else:
                toward = own.working_centre_distance if keys.leaves(own.normal_backlash) else own.touching_distance

            def ratio(value: float) -> float:
                pair = tried(key, value)
                return pair.contact_ratio if keys.leaves(pair.normal_backlash) else 0.0

            return as_far_as_teeth_follow(ratio, min(1.0, own.contact_ratio), given, toward, math.inf)

        raise ParameterError(f"mate.{key}", given, code, cure)

    def made(self, keys: CrossedHelicalPairSpec, first: End[SpurGear], second: End[SpurGear]) -> CrossedPair:
        """The pair; raises ParameterError in the keys of mate and parts, but for an angle that has no common normal."""
        from geometry.gears.pairs.crossed import CrossedPair, crossed_pair

        specs = [end.keys for end in (first, second)]
        helices = [helix_of(spec).signed_angle for spec in specs]
        widths = [spec.face_width for spec in specs if isinstance(spec, MadeKeys)]
        bare = CrossedPair(first.thing, second.thing, (helices[0], helices[1]), (widths[0], widths[1]),
                           (widths[0] / 2, widths[1] / 2))  # fmt: skip
        angle = None if keys.shaft_angle_deg is None else math.radians(keys.shaft_angle_deg)
        try:
            return crossed_pair(bare, keys.working_centre_distance, angle)
        except ParameterError as refusal:
            if refusal.name == "profile_shift_coefficient":
                # of the second's normal section
                raise refusal.renamed(refusal.name, 1 / math.cos(helices[1])) from refusal
            if refusal.name == "working_centre_distance":
                raise refusal.renamed(f"mate.{refusal.name}") from refusal
            raise

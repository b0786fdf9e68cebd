"""A bevel gear: cones, the exact tooth of its spherical involutes, and the blank that carries it.

Pitch, base and root cone meet in the apex (GOST 19325-73, axial form I). The tip cone runs parallel to the mate's root
cone, so that the clearance is the same along the face, or it meets them too. Lengths of the tooth are those of the
outer end (GOST 19624-74), on the back cone, which stands at right angles on the pitch cone.

On every sphere about the apex the tooth has the same section, up to its tip; a tooth line of the crown gear turns these
about the axis. Where it is straight, so is the gear.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.errors import ConvergenceError, ParameterError, PointedTipError, UndercutError
from geometry.base.nearest import kept, nearest
from geometry.base.record import Record, replace, with_value
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Real
from geometry.gears.bevel.sphere import SphericalFillet, SphericalInvolute, spatial
from geometry.gears.bevel.tooth_line import ToothLine
from geometry.plane.profile import Label, circle
from geometry.solids.body import Body
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import Hub, WheelShape, wheel_body, wheel_sections

# the tip cone is a cone that opens away from the apex
_STEEPEST = math.radians(89.5)
# what is no length, part of the module
_NOTHING = 1e-6
# what is in no tooth's way, where that is not 0
_HARMLESS = {"pressure_angle": math.radians(20.0)}
# least addendum and dedendum, in modules
_LEAST_HEIGHT = 0.05
# where a shift that works is sought, from the given one on; and teeth of the mate, in those of the gear
_SHIFTS, _RATIOS = (0.2, 0.4, 0.6, 0.8, 1.0, 1.4, 2.0), (1, 3, 10, 30)
# of the addendum, where a shorter one is sought
_SHARES = (0.8, 0.6, 0.4, 0.3)
# share of a cone distance that a face takes at most, and of one that is sought
_MOST_FACE, _LEAST_FACE = 0.99, 1e-3
# spiral angle of a tooth line at most, anywhere along the face; cutters among which one that works is sought, in R_m
_STEEPEST_LINE, _CUTTERS = math.radians(60.0), (1.0, 2.0, 5.0, 50.0)
# rolled below the base cone, rad: both branches of the involute, 2/3 of its cube apart, are one within rounding
_CUT = 3e-5
# share of the outer flank that is left at the inner end
_LEAST_FLANK = 0.01


class Blank(Record):
    """What carries the teeth, mm: the rim below the outer root, along the back cone, and the hub behind it; holes."""

    rim_thickness: float
    hub_diameter: float = 0.0
    hub_length: float = 0.0
    holes: HubHoles = HubHoles()


class BevelGear(Record, dict=True):
    """A bevel gear for a mate of ``mate_number_of_teeth`` at the shaft angle; mm at the outer end, rad.

    ``pressure_angle``, like all of the tooth, is that of the section on a sphere, so of the transverse one.

    ``thickness_coefficient``: x_tau, by which the tooth is thicker than its shift makes it, in modules; both
    coefficients of the mate have the other sign. The crown gear that cuts it has the tip rounding. ``tip_to_apex``: the
    tip cone meets the apex, else it runs parallel to the mate's root cone. ``spiral_angle`` at the mean cone distance,
    ``cutter_radius`` and ``hand`` are those of the tooth line; of a right-hand tooth the azimuth falls outwards.
    """

    module: float
    number_of_teeth: int
    mate_number_of_teeth: int
    face_width: float
    blank: Blank
    shaft_angle: float = math.pi / 2
    pressure_angle: float = math.radians(20.0)
    addendum_coefficient: float = 1.0
    tip_clearance_coefficient: float = 0.2
    tip_radius_coefficient: float = 0.2
    profile_shift_coefficient: float = 0.0
    thickness_coefficient: float = 0.0
    circumferential_thinning: float = 0.0
    tip_to_apex: bool = False
    spiral_angle: float = 0.0
    cutter_radius: float = math.inf
    hand: Literal["right", "left"] = "right"

    # tooth line -------------------------------------------------------------------------------------------------

    @property
    def is_straight(self) -> bool:
        """Whether its tooth lines meet the apex."""
        return self.tooth_type == "straight"

    @property
    def tooth_type(self) -> Literal["straight", "skew", "spiral", "zerol"]:
        """By ISO 23509."""
        if math.isinf(self.cutter_radius):
            return "skew" if self.spiral_angle else "straight"
        return "spiral" if self.spiral_angle else "zerol"

    @property
    def normal_pressure_angle(self) -> float:
        """alpha_n, across the tooth at the mean cone distance."""
        return math.atan(math.tan(self.pressure_angle) * math.cos(self.spiral_angle))

    @property
    def mean_distance(self) -> float:
        """R_m, mm."""
        return self.cone_distance - self.face_width / 2

    @property
    def mean_normal_module(self) -> float:
        """m_mn, mm."""
        return self.module * self.mean_distance / self.cone_distance * math.cos(self.spiral_angle)

    @property
    def line(self) -> ToothLine:
        """Of the crown gear."""
        return ToothLine(self.mean_distance, self.spiral_angle, self.cutter_radius)

    def spin(self, distance: ArrayLike) -> Real:
        """Azimuth by which the section on a sphere stands ahead of that at the mean cone distance; radii in mm."""
        way = -1.0 if self.hand == "right" else 1.0
        return np.asarray(way * self.line.turn(distance) / math.sin(self.pitch_angle))

    def opposite(self) -> BevelGear:
        """Its mirror image, whose upper flanks are the lower ones of this gear."""
        return self if self.is_straight else replace(self, hand="left" if self.hand == "right" else "right")

    @property
    def normal_share(self) -> float:
        """Of an arc of the pitch circle that is left along the flank's normal, at the outer end."""
        return self.normal_share_at(self.cone_distance)

    def normal_share_at(self, distance: float) -> float:
        """The same at a cone distance, mm."""
        cosine = math.cos(self.pressure_angle)
        return cosine / math.hypot(1.0, math.tan(float(self.line.spiral(distance))) * cosine)

    def at(self, distance: float) -> BevelGear:
        """The straight gear whose outer teeth are as those at a cone distance, mm."""
        share = distance / self.cone_distance
        module, shift = share * self.module, self.profile_shift_coefficient
        high = float(self.addendum_at(distance)) / module - shift
        return replace(
            self, module=module, face_width=share * self.face_width, addendum_coefficient=high,
            tip_clearance_coefficient=self.addendum_coefficient + self.tip_clearance_coefficient - high,
            circumferential_thinning=share * self.circumferential_thinning, spiral_angle=0.0, cutter_radius=math.inf,
        )  # fmt: skip

    # cones ------------------------------------------------------------------------------------------------------

    @property
    def pitch_angle(self) -> float:
        """delta: tan delta = sin Sigma / (u + cos Sigma)."""
        ratio = self.mate_number_of_teeth / self.number_of_teeth
        return math.atan2(math.sin(self.shaft_angle), ratio + math.cos(self.shaft_angle))

    @property
    def cone_distance(self) -> float:
        """R_e, outer, mm."""
        return self.module * self.number_of_teeth / (2 * math.sin(self.pitch_angle))

    @property
    def inner_distance(self) -> float:
        """R_i, mm."""
        return self.cone_distance - self.face_width

    @property
    def addendum(self) -> float:
        """h_ae, mm."""
        return self.module * (self.addendum_coefficient + self.profile_shift_coefficient)

    @property
    def dedendum(self) -> float:
        """h_fe, mm."""
        shift = self.profile_shift_coefficient
        return self.module * (self.addendum_coefficient + self.tip_clearance_coefficient - shift)

    @property
    def addendum_angle(self) -> float:
        """theta_a, by which the tip cone opens wider than the pitch cone: theta_f of the mate (GOST 19624-74)."""
        clearance = 0.0 if self.tip_to_apex else self.tip_clearance_coefficient * self.module
        return math.atan((self.addendum + clearance) / self.cone_distance)

    @property
    def dedendum_angle(self) -> float:
        """theta_f."""
        return math.atan(self.dedendum / self.cone_distance)

    @property
    def tip_cone_angle(self) -> float:
        """delta_a."""
        return self.pitch_angle + self.addendum_angle

    @property
    def tip_angle(self) -> float:
        """Between the axis and the ray from the apex to the outer tip circle: delta_a where ``tip_to_apex``."""
        return self.pitch_angle + math.atan(self.addendum / self.cone_distance)

    def addendum_at(self, distance: ArrayLike) -> Real:
        """h_a, mm, at cone distances from the apex along the pitch cone, mm."""
        within = self.cone_distance - np.asarray(distance, dtype=float)
        return np.asarray(self.addendum - within * math.tan(self.addendum_angle))

    def tip_angle_at(self, distance: ArrayLike) -> Real:
        """The same as ``tip_angle`` at cone distances, mm."""
        if self.tip_to_apex:
            return np.full(np.shape(distance), self.tip_angle)
        return np.asarray(self.pitch_angle + np.arctan(self.addendum_at(distance) / np.asarray(distance, dtype=float)))

    @property
    def inner_tip_angle(self) -> float:
        """The same at the inner end."""
        return float(self.tip_angle_at(self.inner_distance))

    @property
    def root_angle(self) -> float:
        """delta_f."""
        return self.pitch_angle - self.dedendum_angle

    @property
    def involute(self) -> SphericalInvolute:
        """Of its base cone: sin delta_b = sin delta cos alpha."""
        return SphericalInvolute(math.asin(math.sin(self.pitch_angle) * math.cos(self.pressure_angle)))

    @property
    def virtual_teeth(self) -> float:
        """z_v of the back cone, z / cos delta (Tredgold)."""
        return self.number_of_teeth / math.cos(self.pitch_angle)

    @property
    def virtual_diameter(self) -> float:
        """Of the outer pitch circle of the back cone, mm."""
        return self.module * self.virtual_teeth

    @property
    def virtual_half_angle(self) -> float:
        """psi_e of the tooth on the back cone."""
        return self.thickness / self.virtual_diameter

    # tooth ------------------------------------------------------------------------------------------------------

    @property
    def thickness(self) -> float:
        """s_e on the pitch cone, along the arc, mm."""
        shift = 2 * self.profile_shift_coefficient * math.tan(self.pressure_angle)
        return self.module * (math.pi / 2 + shift + self.thickness_coefficient) - self.circumferential_thinning

    @property
    def half_pitch_angle(self) -> float:
        """Azimuth of the flank off the middle of its tooth, on the pitch cone."""
        return self.thickness / (self.module * self.number_of_teeth)

    def half_angle(self, angle: ArrayLike) -> Real:
        """The same at an angle from the axis."""
        inv = self.involute
        return np.asarray(self.half_pitch_angle + inv.involute_at(self.pitch_angle) - inv.involute_at(angle))

    @cached_property
    def fillet(self) -> SphericalFillet:
        """What the tip rounding of the crown gear leaves."""
        radius = self._rounding
        depth = self.dedendum_angle - radius
        crown = SphericalInvolute(math.pi / 2 - self.pressure_angle)
        space = math.pi / self.number_of_teeth - self.half_pitch_angle
        half = space * math.sin(self.pitch_angle) + crown.involute_at(math.pi / 2)
        # the rounding's centre runs on a parallel of the flank
        aside = half - radius / math.cos(self.pressure_angle) - crown.involute_at(math.pi / 2 + depth)
        return SphericalFillet(self.pitch_angle, depth, radius, float(aside))

    def fillet_place(self, u: ArrayLike) -> tuple[Real, Real]:
        """Angle from the axis, and azimuth off the middle of its tooth."""
        angle, aside = self.fillet.place(u)
        return angle, math.pi / self.number_of_teeth - aside

    @property
    def _rounding(self) -> float:
        """Radius of the rounding of the crown gear's tip, rad."""
        return math.atan(self.tip_radius_coefficient * self.module / self.cone_distance)

    @property
    def _touching(self) -> float:
        """Of the line of action from the pitch line to where it touches the base cone, rad."""
        return math.atan(math.tan(self.pitch_angle) * math.sin(self.pressure_angle))

    @property
    def _cut_away(self) -> float:
        """How far the crown gear's flank reaches beyond where the line of action touches the base cone, rad."""
        return float(self.fillet.reach(math.pi / 2 - self.pressure_angle)) - self._touching

    @property
    def is_undercut(self) -> bool:
        """Whether the crown gear's flank reaches below the base cone."""
        return self._cut_away > 0

    @cached_property
    def joint(self) -> tuple[float, float]:
        """Where fillet and flank meet: ``u`` of the fillet, and the arc of the involute.

        Raises
        ------
        UndercutError
            The fillet takes all of the flank.
        """
        inv, end = self.involute, math.pi / 2 - self.pressure_angle
        if self._cut_away <= _CUT * math.sin(inv.base):
            return end, float(inv.arc(self.fillet.place(end)[0]))

        def lead(u: float) -> float:
            angle, azimuth = self.fillet_place(u)
            return float(azimuth - self.half_angle(max(float(angle), inv.base)))

        def above_base(u: float) -> float:
            return float(self.fillet.place(u)[0]) - inv.base

        low = 0.0 if above_base(0.0) > 0 else bracketed_root(above_base, 0.0, end).value
        try:
            crossing = bracketed_root(lead, low, end).value
        except ConvergenceError as error:
            raise UndercutError(
                "profile_shift_coefficient", self.profile_shift_coefficient, "no_involute_below_tip"
            ) from error
        return crossing, float(inv.arc(max(float(self.fillet.place(crossing)[0]), inv.base)))

    @property
    def tip_arc(self) -> float:
        """Of the involute at the outer tip circle."""
        return float(self.involute.arc(self.tip_angle))

    @property
    def tip_land(self) -> float:
        """s_ae, mm, along the arc of the outer tip circle."""
        return 2 * float(self.half_angle(self.tip_angle)) * self.outer(self.tip_angle).real

    def tooth_places(self, name: str, share: Real) -> tuple[Real, Real]:
        """Angles and azimuths of the upper side at shares of its ``fillet`` or its ``flank``, from the root on."""
        crossing, arc = self.joint
        if name == "fillet":
            # tan u = sinh: as much of the fillet near the flank as near the root, where its normal turns fast
            return self.fillet_place(np.arctan(np.sinh(math.asinh(math.tan(crossing)) * share)))
        return self._flank(arc + (self.tip_arc - arc) * share)

    def _flank(self, rolled: Real) -> tuple[Real, Real]:
        """Angles and azimuths of the upper side where so much of the great circle is rolled off."""
        start = self.half_pitch_angle + self.involute.involute_at(self.pitch_angle)
        return self.involute.angle(rolled), start - self.involute.involute(rolled)

    # the blank --------------------------------------------------------------------------------------------------

    def outer(self, angle: float) -> complex:
        """Where a ray from the apex meets the back cone: radius and distance from the apex along the axis, mm."""
        return self._on_cone(self.cone_distance, angle)

    def inner(self, angle: float) -> complex:
        """The same of the cone at the inner end."""
        return self._on_cone(self.inner_distance, angle)

    def _on_cone(self, distance: float, angle: float) -> complex:
        size = distance / math.cos(angle - self.pitch_angle)
        return complex(size * math.sin(angle), size * math.cos(angle))

    @property
    def rim(self) -> complex:
        """Where the back cone ends below the outer root: radius and distance from the apex along the axis, mm."""
        down = complex(-math.cos(self.pitch_angle), math.sin(self.pitch_angle))
        return self.outer(self.root_angle) + self.blank.rim_thickness * down

    @property
    def mounting_distance(self) -> float:
        """From the apex to the back face, mm."""
        return self.rim.imag + self.blank.hub_length

    @property
    def front(self) -> complex:
        """The inner root circle, in whose plane the front face lies."""
        return self.inner(self.root_angle)

    @property
    def height(self) -> float:
        """From the back face to the inner tip circle, mm."""
        return self.mounting_distance - min(self.inner(self.inner_tip_angle).imag, self.front.imag)

    def points(self, name: str, share: Real) -> Real:
        """Points (k, 3) of the upper side of tooth 0 on the back cone, mm; the apex on the axis over the back face."""
        angle, azimuth = self.tooth_places(name, share)
        return self._spun(self.cone_distance, angle, azimuth)

    def wall_points(self, name: str, share: Real, along: Real) -> Real:
        """Points (k, n, 3) of the upper ``fillet`` or ``flank`` of tooth 0, mm: shares (k,) of its height, and of b."""
        distance, arc = self.cone_distance - along * self.face_width, self.joint[1]
        if name == "fillet":
            angle, azimuth = self.tooth_places(name, share[:, None])
        else:
            tips = self.involute.arc(self.tip_angle_at(distance))
            angle, azimuth = self._flank(arc + share[:, None] * (tips - arc))
        return self._spun(distance, angle, azimuth)

    def _spun(self, distance: ArrayLike, angle: Real, azimuth: Real) -> Real:
        """Points of places at cone distances, mm."""
        size = np.asarray(distance / np.cos(angle - self.pitch_angle))
        return self.placed(size[..., None] * spatial(angle, azimuth + self.spin(size)))

    def placed(self, points: Real) -> Real:
        """From the frame of the apex, z into the gear, to that of the part: the back face at z = 0, the apex above."""
        return points * np.array([1.0, 1.0, -1.0]) + np.array([0.0, 0.0, self.mounting_distance])

    # limits -----------------------------------------------------------------------------------------------------

    def checked(self) -> BevelGear:
        """The gear, which exists.

        Raises
        ------
        ParameterError
            It does not: the parameter, why, and the nearest value that works where that one can cure it.
        """
        self._check_cones()
        self._check_whole_tooth()
        self._check_blank()
        return self

    def _changed(self, name: str, value: float) -> BevelGear:
        """The gear with another value; a cutter of the mean cone distance, as by default, follows the face."""
        changed = with_value(self, name, value)
        if name == "face_width" and self.cutter_radius == self.mean_distance:
            return replace(changed, cutter_radius=self.cone_distance - value / 2)
        return changed

    def _cured(self, name: str, toward: float | Sequence[float], check: Callable[[BevelGear], None], code: str,
               error: type[ParameterError] = ParameterError, **numbers: float) -> ParameterError:  # fmt: skip
        """A refusal that offers the nearest value on the way ``toward`` one with which a check passes."""
        given = getattr(self, name)

        def holds(value: float) -> bool:
            check(self._changed(name, value))
            return True

        digits = 7 if name.endswith("_angle") else 4
        return error(name, given, code, lambda: nearest(holds, given, toward, digits=digits), **numbers)

    def _check_cones(self) -> None:
        shift, whole = self.profile_shift_coefficient, self.module * _LEAST_HEIGHT
        if self.addendum < whole or self.dedendum < whole:
            low = _LEAST_HEIGHT - self.addendum_coefficient
            high = self.addendum_coefficient + self.tip_clearance_coefficient - _LEAST_HEIGHT
            raise ParameterError.beyond(
                "profile_shift_coefficient", shift, "bevel_shift_leaves_no_tooth", low if shift < low else high
            )
        if self.tip_cone_angle > _STEEPEST:
            more = [step * self.number_of_teeth for step in _RATIOS]
            raise self._cured("mate_number_of_teeth", more, BevelGear._check_cones, "bevel_too_flat",
                              most=math.degrees(_STEEPEST))  # fmt: skip
        if self.root_angle <= 0 or self.rim_room <= self._wall:
            raise self._cured("number_of_teeth", 10 * self.number_of_teeth, BevelGear._check_cones, "bevel_no_root")

    def _check_tooth(self) -> None:
        if self.thickness <= _NOTHING * self.module:
            raise self._cured("circumferential_thinning", 0.0, BevelGear._check_tooth, "thinning_leaves_no_tip")
        if self._is_pointed():
            name = self._without(lambda gear: not gear._is_pointed(), "circumferential_thinning",
                                 "thickness_coefficient", "profile_shift_coefficient", *self._steep())  # fmt: skip
            ways = {"profile_shift_coefficient": self._shifted(-1), "addendum_coefficient": self._lower_addenda()}
            raise self._cured(
                name,
                ways.get(name, [_HARMLESS.get(name, 0.0)]),
                BevelGear._check_tooth,
                "bevel_pointed",
                PointedTipError,
            )
        if self._is_crown_pointed():
            # a shift makes the crown's tooth as much thicker as it makes it longer
            name = self._without(lambda gear: not gear._is_crown_pointed(), "thickness_coefficient",
                                 *self._steep(), "tip_radius_coefficient")  # fmt: skip
            ways = {"addendum_coefficient": self._lower_addenda()}
            codes = {"tip_radius_coefficient": "bevel_rounding_too_large", "pressure_angle": "bevel_crown_too_narrow"}
            code = codes.get(name, "bevel_crown_pointed")
            raise self._cured(name, ways.get(name, [_HARMLESS.get(name, 0.0)]), BevelGear._check_tooth, code)
        if self.fillet.depth >= self.pressure_angle:
            # spherical involutes of a crown gear end so far from its pitch plane
            raise self._cured("profile_shift_coefficient", self._shifted(1), BevelGear._check_whole_tooth,
                              "bevel_below_crown", UndercutError)  # fmt: skip
        if not kept(BevelGear._has_flank, self):
            raise self._cured("profile_shift_coefficient", self._shifted(1), BevelGear._check_whole_tooth,
                              "no_involute_below_tip", UndercutError)  # fmt: skip

    def _is_pointed(self) -> bool:
        """Whether both flanks meet below the tip cone."""
        return float(self.half_angle(self.tip_angle)) <= _NOTHING / self.number_of_teeth

    def _is_crown_pointed(self) -> bool:
        """Whether the crown gear's tooth has no room for its rounding."""
        return self.fillet.aside <= _NOTHING * self.module / self.cone_distance

    def _without(self, holds: Callable[[BevelGear], bool], *names: str) -> str:
        """The first of the parameters to blame: with what is harmless in its place neither gear nor crown gear is
        pointed, or else a check holds; of none, the addendum."""
        harmless = {name: self._changed(name, _HARMLESS.get(name, 0.0)) for name in names}

        def whole(gear: BevelGear) -> bool:
            return not (gear._is_pointed() or gear._is_crown_pointed())

        found = (name for check in (whole, holds) for name in names if check(harmless[name]))
        return next(found, "addendum_coefficient")

    def _steep(self) -> tuple[str, ...]:
        """The pressure angle, where it is what differs from the usual crown gear's tooth and not its height."""
        usual = self.addendum_coefficient == 1 and self.tip_radius_coefficient <= 0.2 and not self.spiral_angle
        return ("pressure_angle",) if usual and self.pressure_angle > _HARMLESS["pressure_angle"] else ()

    def _lower_addenda(self) -> list[float]:
        """Addenda among which one that works is sought."""
        return [share * self.addendum_coefficient for share in _SHARES]

    def _shifted(self, way: int) -> list[float]:
        """Shifts among which one that works is sought, the nearest first, upwards (1) or downwards (-1)."""
        return [self.profile_shift_coefficient + way * step for step in _SHIFTS]

    def _has_flank(self) -> bool:
        """Whether the fillet leaves some of it."""
        return self.joint[1] < self.tip_arc

    def _check_whole_tooth(self) -> None:
        self._check_tooth()
        self._check_face()

    def _check_face(self) -> None:
        least = _LEAST_FACE * self.cone_distance
        if self.face_width > _MOST_FACE * self.cone_distance:
            raise self._cured("face_width", least, BevelGear._check_face, "bevel_face_to_apex",
                              distance=self.cone_distance)  # fmt: skip
        if not self._has_inner_flank():
            raise self._cured("face_width", least, BevelGear._check_face, "bevel_tips_run_out")
        self._check_line()

    def _check_line(self) -> None:
        steepest = self._steepest_line()
        if steepest <= _STEEPEST_LINE:
            return
        cures: dict[str, list[float]] = {"spiral_angle": [0.0], "face_width": [_LEAST_FACE * self.cone_distance]}
        if math.isfinite(self.cutter_radius):
            # an arc through the apex leans less inwards
            through = [0.5 / math.sin(self.spiral_angle)] if self.spiral_angle else []
            cures = {"cutter_radius": [share * self.mean_distance for share in (*_CUTTERS, *through)]} | cures
        name = next(
            name for name, ends in cures.items()
            if name == "face_width" or any(self._changed(name, end)._steepest_line() <= _STEEPEST_LINE for end in ends)
        )  # fmt: skip
        raise self._cured(name, cures[name], BevelGear._check_line, "bevel_line_too_steep",
                          angle=math.degrees(steepest), most=math.degrees(_STEEPEST_LINE))  # fmt: skip

    def _steepest_line(self) -> float:
        """Of its spiral angles: an end of the face has it."""
        furthest = max(self.cone_distance / math.cos(t - self.pitch_angle) for t in (self.tip_angle, self.root_angle))
        return float(np.abs(self.line.spiral([self.inner_distance, furthest])).max())

    def _has_inner_flank(self) -> bool:
        """Whether the tip cone leaves some of it at the inner end."""
        left = float(self.involute.arc(self.inner_tip_angle)) - self.joint[1]
        return float(self.addendum_at(self.inner_distance)) > 0 and left > _LEAST_FLANK * (self.tip_arc - self.joint[1])

    def _check_blank(self) -> None:
        rim, hub = self.blank.rim_thickness, self.blank.hub_diameter
        if rim > self.rim_room:
            raise ParameterError.beyond("rim_thickness", rim, "bevel_rim_over_axis", self.rim_room)
        if hub / 2 > (room := self.rim.real - self._wall):
            raise ParameterError.beyond("hub_diameter", hub, "bevel_hub_over_rim", 2 * room, rim=2 * self.rim.real)

    @property
    def rim_room(self) -> float:
        """How far down the back cone the rim may reach, mm: there it gets narrower."""
        return (self.outer(self.root_angle).real - self._wall) / math.cos(self.pitch_angle)

    @property
    def least_shift(self) -> float:
        """x without undercut: the crown gear's flank ends at the base cone (DERIVATIONS.md, section 20)."""
        deepest = self._rounding + math.asin(math.sin(self.pressure_angle) * math.sin(self._touching - self._rounding))
        whole = self.addendum_coefficient + self.tip_clearance_coefficient
        return whole - self.cone_distance / self.module * math.tan(deepest)

    @property
    def virtual_least_shift(self) -> float:
        """The same of the virtual gear (Tredgold), whose flanks are plane involutes."""
        sine = math.sin(self.pressure_angle)
        deep = self.addendum_coefficient + self.tip_clearance_coefficient - self.tip_radius_coefficient * (1 - sine)
        return deep - self.virtual_teeth * sine**2 / 2

    @property
    def _wall(self) -> float:
        """The least that is left of a wall, mm."""
        return 0.01 * self.module

    @property
    def bore_room(self) -> float:
        """How far from the axis a bore may reach, mm."""
        back = self.blank.hub_diameter / 2 if self.blank.hub_length else self.core_radius
        return min(self.core_radius, back) - self._wall

    @property
    def core_radius(self) -> float:
        """Within it front and back are planes, mm."""
        return min(self.front.real, self.rim.real)

    @property
    def core_shape(self) -> WheelShape:
        """What is within that, without its holes; the hub stands below."""
        length, high = self.blank.hub_length, self.rim.imag - self.front.imag
        return WheelShape(high, hub=Hub(self.blank.hub_diameter, length) if length else None)

    @property
    def core(self) -> Body:
        """The same as it stands, with its holes; the gear takes the place of its first wall."""
        rim = circle(self.core_radius, Label.BODY)
        sections = wheel_sections(lambda *_: rim, self.core_radius, self.blank.holes)
        return wheel_body(self.core_shape, sections).raised(self.blank.hub_length)

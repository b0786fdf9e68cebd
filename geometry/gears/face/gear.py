"""A face gear: the envelope of a spur shaper that rolls on it about an axis that meets its own at a right angle.

Frame: the gear's axis is z, its lower face lies at z = 0, tooth 1 is centred on +x, teeth point upwards. The shaper's
axis is parallel to x, ``shaper_height`` above the lower face, and y + ih tells places of its section from there,
h downwards. Turned by phi from where a tooth points straight down the shaper turns the gear by phi z_0 / z_2, so in
the plane at x from the axis both touch where their common normal meets the pitch point, x z_0 / z_2 below the
shaper's axis (Litvin, Gear Geometry and Applied Theory, 18.4). The plane's pressure angle alpha tells it:
x = r_b0 z_2 / (z_0 cos alpha). The upper side of tooth 1 is described; the lower one is its mirror image.

A shaper of more teeth than the pinion crowns the flanks: its axis stands as much higher as lets the common normals of
one plane, x_c from the axis, go through one pitch point, and its shift makes its tooth there as thick as the pinion's.
In that plane both are conjugate to the gear; beside it the gear leaves the pinion room.
"""

from __future__ import annotations

import cmath
import math
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

from geometry.base.angles import involute_function, tangent_length
from geometry.base.errors import ConvergenceError, ParameterError
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.curves.curve import Complex, Real
from geometry.gears.teeth.cutter import PinionCutter
from geometry.gears.teeth.limits import root_form_diameter
from geometry.gears.teeth.spur import SpurGear
from geometry.plane.profile import Label, circle
from geometry.solids.hub_holes import HubHoles
from geometry.solids.wheel import Hub, Web, WheelShape, wheel_body, wheel_sections

if TYPE_CHECKING:
    from geometry.solids.body import Body

P = TypeVar("P", Real, Complex)
FILLET, FLANK = 0, 1
SIDES = (FILLET, FLANK)
# Newton's steps for the pressure angle on a cylinder, after which one more is enough, rad, and what is on it, part of
# the radius squared; the step of the derivative, which goes off the real axis and cancels nothing
_STEPS, _ENOUGH, _ON, _ASIDE = 30, 1e-9, 1e-13, 1e-30
# pressure angles between which limits are sought
_LEAST_ANGLE, _MOST_ANGLE, _LIMIT_STEPS = 1e-6, 1.5, 65
# where a fillet is held against folding: shares and radii
_SHARES, _RADII = np.linspace(0.0, 1.0, 33), 9
# a face is no narrower, a tip no thinner, a flank no lower, modules; what a limit is stepped back from by default
LEAST_FACE, _LEAST_TIP, _LEAST_FLANK, _NEXT = 0.05, 1e-3, 0.05, 1e-12
NEAR_UNDERCUT, USUAL_TIP, USUAL_FACE = 0.1, 0.4, 0.5
# addenda by default, the first that leaves a wide face, modules
_ADDENDA, _WIDE_FACE = tuple(k / 20 for k in range(20, 1, -1)), 1.0


class Places(Record, eq=False):
    """Places of a side: radius, azimuth (rad, from the middle of tooth 1), depth below the shaper's axis, mm.

    ``normal``: out of the material, y + ih of the shaper's section where it cuts them; ``x``: of that section, mm;
    ``turn``: how far the shaper has turned then from where a tooth points straight down, rad.
    """

    radius: Real
    azimuth: Real
    depth: Real
    normal: Complex
    x: Real
    turn: Real

    @property
    def plane(self) -> Complex:
        """Along the axis, mm."""
        return np.asarray(self.radius * np.exp(1j * self.azimuth))

    @property
    def around(self) -> Complex:
        """The part of the normal that lies on the cylinder about the axis: along the azimuth, and downwards."""
        return np.asarray(self.normal.real * self.x / self.radius + 1j * self.normal.imag)


class FaceGear(Record, dict=True):
    """A face gear for the pinion whose teeth ``cutter`` has, cut by one with thicker teeth, or more; lengths in mm.

    ``circumferential_thinning``: of its teeth, along the shaper's reference circle.
    ``addendum``: of its teeth above the pitch plane, the plane that touches the pinion's reference cylinder, or, of a
    pinion with a shift, above a plane so much farther from its axis;
    ``thickness``: of the plate below the root, which ``web``, ``hub`` and ``holes`` shape within the teeth.
    ``more_teeth``: of the shaper than of the pinion; ``contact_plane``: x_c, where they then touch.
    """

    cutter: PinionCutter
    number_of_teeth: int
    addendum: float
    inner_radius: float
    outer_radius: float
    thickness: float
    circumferential_thinning: float = 0.0
    holes: HubHoles = HubHoles()
    hub: Hub | None = None
    web: Web | None = None
    more_teeth: int = 0
    contact_plane: float = 0.0

    # sizes ----------------------------------------------------------------------------------------------------------

    @cached_property
    def shaper(self) -> PinionCutter:
        """What cuts it, thicker than standard by the thinning."""
        own = replace(self.cutter, widening=self.circumferential_thinning / 2)
        if not self.more_teeth:
            return own
        slope, teeth = math.tan(own.pressure_angle), own.number_of_teeth + self.more_teeth
        bent = involute_function(self.contact_angle) - involute_function(own.pressure_angle)
        shift = own.profile_shift_coefficient + self.more_teeth * bent / (2 * slope)
        high = (own.tip_radius + self.axes_apart) / self.module - teeth / 2 - shift
        return replace(own, number_of_teeth=teeth, profile_shift_coefficient=shift, addendum=high)

    @property
    def contact_angle(self) -> float:
        """Pressure angle in the plane of contact, rad."""
        return math.acos(self.reference_radius * math.cos(self.cutter.pressure_angle) / self.contact_plane)

    @property
    def axes_apart(self) -> float:
        """How high the shaper's axis stands above the pinion's."""
        return self.contact_plane * self.more_teeth / self.number_of_teeth

    @property
    def length_apart(self) -> float:
        """How much longer the shaper's line of action in the plane of contact is, from its base circle on."""
        if not self.more_teeth:
            return 0.0
        return (self.shaper.base_radius - self.cutter.base_radius) * math.tan(self.contact_angle)

    @property
    def module(self) -> float:
        """m, mm."""
        return self.cutter.module

    @property
    def reference_radius(self) -> float:
        """r_2 = m z_2 / 2, where the pressure angle is the shaper's."""
        return self.module * self.number_of_teeth / 2

    @property
    def rolled(self) -> float:
        """z_0 / z_2: what the gear turns for a turn of the shaper."""
        return self.shaper.number_of_teeth / self.number_of_teeth

    @property
    def ratio(self) -> float:
        """u, turns of the pinion for one of the gear."""
        return self.number_of_teeth / self.cutter.number_of_teeth

    @property
    def tip_depth(self) -> float:
        """Of the tip plane below the shaper's axis."""
        own = self.cutter
        return own.reference_radius + own.profile_shift_coefficient * self.module - self.addendum + self.axes_apart

    @property
    def whole_depth(self) -> float:
        """h, from root to tip."""
        return self.shaper.tip_radius - self.tip_depth

    @property
    def height(self) -> float:
        """From the lower face to the tips."""
        return self.thickness + self.whole_depth

    @property
    def mounting_distance(self) -> float:
        """Of the pinion's axis from the lower face."""
        return self.thickness + self.cutter.tip_radius

    @property
    def shaper_height(self) -> float:
        """Of the shaper's axis."""
        return self.thickness + self.shaper.tip_radius

    @property
    def face_width(self) -> float:
        """b, along the radius."""
        return self.outer_radius - self.inner_radius

    @cached_property
    def shape(self) -> WheelShape:
        """Plate, web and hub."""
        return WheelShape(self.thickness, self.web, self.hub)

    @cached_property
    def core(self) -> Body:
        """What is within the teeth; teeth and plate take the place of its first wall, a circle of the inner radius."""
        rim = circle(self.inner_radius, Label.BODY)
        return wheel_body(self.shape, wheel_sections(lambda *_: rim, self.inner_radius, self.holes))

    # places ---------------------------------------------------------------------------------------------------------

    def section_x(self, alpha: ArrayLike) -> Real:
        """Distance from the axis of the plane in which the pressure angle is ``alpha``, rad."""
        return np.asarray(self.shaper.base_radius / self.rolled / np.cos(alpha))

    def tip_length(self, alpha: P) -> P:
        """Of the shaper's line of action in a plane up to the tip of the gear, from the base circle on, mm."""
        return cast("P", (self.tip_depth - self.shaper.base_radius * np.cos(alpha)) / np.sin(alpha))

    def side(self, which: int, share: ArrayLike, radius: ArrayLike) -> Places:
        """Places of a fillet (0) or flank (1) at shares from its root to its tip and at radii, of one shape.

        Raises
        ------
        ConvergenceError
            A radius is less than that of the base cylinder's limit.
        """
        u, r = np.broadcast_arrays(np.asarray(share, float), np.asarray(radius, float))
        alpha = np.arccos(self.section_x(0.0) / r)
        last = False
        for _ in range(_STEPS):
            y, depth, normal, phi = self._contact(which, u, alpha + 1j * _ASIDE)
            x = self.section_x(alpha)
            off = x**2 + y.real**2 - r**2
            if last:
                break
            step = off / (2 * x**2 * np.tan(alpha) + 2 * y.real * y.imag / _ASIDE)
            alpha, last = alpha - step, bool((np.abs(step) < _ENOUGH).all())
        if not (np.abs(off) < _ON * r**2).all():
            raise ConvergenceError("section of a face gear", float(np.nanmax(np.abs(off))), _STEPS)
        azimuth = math.pi / self.number_of_teeth + np.arctan2(y.real, x) - self.rolled * phi
        return Places(r, azimuth, depth.real, normal, x, phi)

    def _contact(self, which: int, u: Real, alpha: Complex) -> tuple[Complex, Complex, Complex, Real]:
        """Where the shaper cuts a side: y, h, the normal, and how far it has turned; alpha stands off the real axis."""
        base, rounding = self.shaper.base_radius, self.shaper.rounding_radius
        sine: Complex = np.sin(alpha)
        cosine: Complex = np.cos(alpha)
        if which == FLANK:
            s: Complex = (1 - u) * self.shaper.form_length + u * self.tip_length(alpha)
            phi = (alpha - s / base).real + self.shaper.base_half_angle
            return base * sine - s * cosine, base * cosine + s * sine, np.asarray(cosine - 1j * sine), np.asarray(phi)
        # the normal's angle from straight down; the rounding's centre and the contact lie on it beyond the pitch point
        turn: Complex = u * (alpha - math.pi / 2)
        pitch: Complex = base / cosine
        sine, cosine = np.sin(turn), np.cos(turn)
        aside: Complex = pitch * sine
        radius = self.shaper.corner_radius
        centre: Complex = np.sqrt((radius - aside) * (radius + aside)) - pitch * cosine
        phi = np.arctan2((centre * sine).real, (pitch + centre * cosine).real) + self.shaper.corner_angle
        reach = centre + rounding
        return reach * sine, pitch + reach * cosine, np.asarray(-sine - 1j * cosine), np.asarray(phi)

    # limits ---------------------------------------------------------------------------------------------------------

    def cut_radius(self, alpha: ArrayLike, s: ArrayLike) -> Real:
        """Radius of what is cut ``s`` mm along the line of action in the plane of a pressure angle, mm."""
        angle, length = np.asarray(alpha, float), np.asarray(s, float)
        y = self.shaper.base_radius * np.sin(angle) - length * np.cos(angle)
        return np.hypot(self.section_x(angle), y)

    @cached_property
    def undercut_angle(self) -> float:
        """Pressure angle of the plane in which s t = (x tan alpha)^2 at the end of the flank, rad.

        s and t: lengths along the line of action from the base circle and from the pitch point. Both ways along the
        flank have one direction then (DERIVATIONS.md).
        """
        base, s = self.shaper.base_radius, self.shaper.form_length

        def left(alpha: float) -> float:
            slope = math.tan(alpha)
            return s * (s - base * slope) - (float(self.section_x(alpha)) * slope) ** 2

        return bracketed_root(left, 0.0, math.atan(s / base)).value

    @property
    def undercut_radius(self) -> float:
        """Inside of it the shaper's tip cuts its own flank off, mm."""
        return float(self.cut_radius(self.undercut_angle, self.shaper.form_length))

    def form_radius(self, s: float) -> float:
        """From which radius on tips meet the pinion's involute ``s`` mm along its line of action or more; 0: all."""

        def over(alpha: float) -> float:
            return float(self.tip_length(np.asarray(alpha))) - s

        if over(_MOST_ANGLE) < 0:
            return math.inf
        # where tips reach deepest along it
        deepest = math.acos(min(self.shaper.base_radius / self.tip_depth, math.cos(_LEAST_ANGLE)))
        if over(deepest) >= 0:
            return 0.0
        return float(self.cut_radius(bracketed_root(over, deepest, _MOST_ANGLE).value, s))

    @cached_property
    def flank_radius(self) -> float:
        """Inside of it fillets reach the tip, mm: there h = r_b cos(alpha) + s sin(alpha) of the end of the flank."""
        base, s = self.shaper.base_radius, self.shaper.form_length
        depth = (self.tip_depth + _LEAST_FLANK * self.module) / math.hypot(base, s)
        return 0.0 if depth >= 1 else float(self.cut_radius(max(math.atan2(s, base) - math.acos(depth), 0.0), s))

    @property
    def least_radius(self) -> float:
        """The inner radius may not be less: of undercut, of fillets, and of tips below the shaper's base circle."""
        return max(self.undercut_radius, self.flank_radius, self.form_radius(0.0))

    def tip_thickness(self, radius: ArrayLike) -> Real:
        """Of the tip, an arc at radii, mm."""
        at = self.side(FLANK, 1.0, radius)
        return np.asarray(2 * at.radius * at.azimuth)

    def tip_limit(self, thickness: float) -> float:
        """The radius at which tips are that thick, mm; or the least one, where they are thinner."""
        least = self.least_radius * (1 + _NEXT)
        if math.isinf(least):
            return least
        tip = np.asarray(1.0)

        def over(alpha: float) -> float:
            y, _, _, phi = self._contact(FLANK, tip, np.asarray(complex(alpha)))
            x = complex(float(self.section_x(alpha)), float(y.real))
            turn = math.pi / self.number_of_teeth + cmath.phase(x) - self.rolled * float(phi)
            return 2 * abs(x) * turn - thickness

        begins = math.acos(float(self.section_x(0.0) / self.side(FLANK, 1.0, least).x))
        if over(begins) <= 0:
            return least
        steps = np.linspace(begins, _MOST_ANGLE, _LIMIT_STEPS)
        ends = next((float(alpha) for alpha in steps if over(alpha) < 0), None)
        if ends is None:
            raise ConvergenceError("pointed tips of a face gear", over(_MOST_ANGLE), _LIMIT_STEPS)
        alpha = bracketed_root(over, begins, ends).value
        return float(self.cut_radius(alpha, self.tip_length(np.asarray(alpha))))

    @cached_property
    def pointed_radius(self) -> float:
        """Where both flanks of a tooth meet on the tip plane, mm."""
        return self.tip_limit(0.0)

    def checked(self) -> FaceGear:
        """The gear itself, or a refusal that names the nearest value that works.

        Raises
        ------
        ParameterError
            The face begins within the undercut, or ends beyond the pointed tips.
        """
        m, inner, outer = self.module, 2 * self.inner_radius, 2 * self.outer_radius
        least, thin = 2 * self.least_radius, _LEAST_TIP * m
        most = 2 * self.tip_limit(thin)
        room = 2 * LEAST_FACE * m
        if math.isinf(least):
            raise ParameterError("addendum_coefficient", self.addendum / m, "face_gear_no_tip")
        if most - least < room:
            code = "face_gear_no_width"
            raise ParameterError("addendum_coefficient", self.addendum / m, code, inner=least, outer=most)
        if inner < least:
            codes = {self.flank_radius: "face_gear_no_flank", self.undercut_radius: "face_gear_undercut"}
            code = codes.get(self.least_radius, "face_gear_below_base")
            raise ParameterError.beyond("inner_diameter", inner, code, least * (1 + 1e-9), diameter=least)
        if inner > most - room:
            code = "face_gear_pointed_inside"
            raise ParameterError.beyond("inner_diameter", inner, code, most - room, diameter=most, thin=thin)
        if outer > most:
            raise ParameterError.beyond("outer_diameter", outer, "face_gear_pointed", most, diameter=most, thin=thin)
        if outer < inner + room:
            raise ParameterError.beyond("outer_diameter", outer, "face_gear_narrow", inner + room, diameter=inner)
        if self._folds():
            raise ParameterError("inner_diameter", inner, "face_gear_undercut", diameter=least)
        return self

    def _folds(self) -> bool:
        """Whether a fillet turns back on its way from root to flank on some cylinder."""
        radii = np.linspace(self.inner_radius, self.outer_radius, _RADII)
        at = self.side(FILLET, _SHARES[:, None], radii)
        way = np.diff(at.azimuth, axis=0) * at.radius[1:] + 1j * np.diff(at.depth, axis=0)
        # along the material from root to tip: upwards, its normal to one side
        along = (np.conj(at.around[1:] + at.around[:-1]) * way).imag
        return not (along < 0).all()


def form_length(pinion: SpurGear) -> float:
    """From the base circle to where a pinion's involute begins, along its line of action, mm."""
    return tangent_length(root_form_diameter(pinion) / 2, pinion.base_radius)


def _usual_inner(gear: FaceGear, form_length: float) -> float:
    """Beyond the undercut, and from where on tips meet the pinion's involute, mm."""
    return max(gear.least_radius, gear.form_radius(form_length + gear.length_apart)) + NEAR_UNDERCUT * gear.module


def topped(gear: FaceGear, form_length: float = 0.0) -> FaceGear:
    """The gear with an addendum of a module, or less where its pinion's teeth are so few that the face would be narrow.

    ``form_length``: as of ``sized``. No thinning changes it.
    """
    m, whole = gear.module, replace(gear, circumferential_thinning=0.0)
    for share in _ADDENDA:
        whole = replace(whole, addendum=share * m)
        if whole.tip_limit(USUAL_TIP * m) - _usual_inner(whole, form_length) >= _WIDE_FACE * m:
            break
    return replace(gear, addendum=whole.addendum)


def sized(gear: FaceGear, inner: float | None, outer: float | None, form_length: float = 0.0) -> FaceGear:
    """The gear with radii that are given, mm, or those of the widest face without undercut and thin tips.

    By default its tips begin where the pinion still has its involute, from ``form_length`` mm of its line of action on.
    """
    m = gear.module
    if inner is None:
        inner = _usual_inner(gear, form_length)
        inner = max(min(inner, gear.pointed_radius - USUAL_FACE * m), gear.least_radius * (1 + _NEXT))
    if outer is None:
        outer = max(gear.tip_limit(USUAL_TIP * m), min(inner + USUAL_FACE * m, gear.tip_limit(_LEAST_TIP * m)))
    return replace(gear, inner_radius=inner, outer_radius=outer)

"""Two helical gears on crossed axes (ISO 1122-1: crossed helical gear pair): distance, shaft angle, path of contact.

Two involute helicoids touch in a point of the line that touches both base cylinders at their base helix angles, at any
centre distance and shaft angle. A flank's tangent plane lies R (theta - phi + psi_b) from the gear's middle,
R = r_b cos(beta_b), so that gaps are closed forms. Derivation: DERIVATIONS.md.

Frame: the line of centres is the x axis, from the first gear to the second; z is the first gear's axis, and the
second's is (0, sin Sigma, cos Sigma). The second always turns against the first.
"""

from __future__ import annotations

import math
from functools import cached_property

from geometry.base.angles import involute_function, tangent_length
from geometry.base.both import both
from geometry.base.errors import ParameterError, limit
from geometry.base.findings import Finding
from geometry.base.placement import Placement3, Vector
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.base.tolerance import is_told
from geometry.gears.pairs.tooth_forces import ToothForces
from geometry.gears.teeth.limits import undercut
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import ToothSide, tooth_side
from geometry.gears.teeth.transverse import base_helix_angle

# angles below are those of parallel axes, rad; lengths below this part of the distance are rounding
_PARALLEL, _ROUNDING = 1e-7, 1e-12
# how near to its end the range of working angles is searched
_WITHIN = 1 - 1e-12
_DIGITS = 6


class Action(Record):
    """The line of action of the first gear's lower flanks: its unit ``normal``, out of them into the second gear.

    ``angles``: between the line of centres and where it touches each base cylinder, transverse, rad. ``touches``: z of
    these places along each axis from the line of centres, mm; ``length`` between them, mm.
    """

    normal: Vector
    angles: tuple[float, float]
    touches: tuple[float, float]
    length: float


class CrossedPair(Record, dict=True):
    """Two gears in mesh on crossed axes; lengths in mm, angles in rad. Results for both are tuples (first, second).

    ``first``, ``second``: transverse sections; ``helices``: beta on the reference cylinders, above 0 right-hand.
    ``feet``: where the line of centres meets each axis above the lower face.
    """

    first: SpurGear
    second: SpurGear
    helices: tuple[float, float]
    face_widths: tuple[float, float]
    feet: tuple[float, float]
    working_centre_distance: float = 0.0
    shaft_angle: float = 0.0

    @property
    def gears(self) -> tuple[SpurGear, SpurGear]:
        """Both gears."""
        return self.first, self.second

    @property
    def ratio(self) -> float:
        """u = z2 / z1."""
        return self.second.number_of_teeth / self.first.number_of_teeth

    @property
    def normal_module(self) -> float:
        """m_n, mm."""
        return self.first.module * math.cos(self.helices[0])

    @cached_property
    def base_helices(self) -> tuple[float, float]:
        """beta_b, with the sign of the hand."""
        return both(base_helix_angle(g.pressure_angle, b) for g, b in zip(self.gears, self.helices, strict=True))

    @cached_property
    def arms(self) -> tuple[float, float]:
        """R = r_b cos(beta_b) = z m_n cos(alpha_n) / 2: how far a flank moves along its normal for one rad."""
        return both(g.base_radius * math.cos(b) for g, b in zip(self.gears, self.base_helices, strict=True))

    @property
    def twists(self) -> tuple[float, float]:
        """tan(beta) / r: how teeth turn along their axes, rad/mm."""
        return both(math.tan(b) / g.reference_radius for g, b in zip(self.gears, self.helices, strict=True))

    @property
    def base_pitch(self) -> float:
        """p_bn = pi m_n cos(alpha_n): from flank to flank along the line of action."""
        return self.arms[0] * self.first.pitch_angle

    @property
    def pressure_angle(self) -> float:
        """alpha_n."""
        return math.acos(self.base_pitch / (math.pi * self.normal_module))

    @property
    def thinning_backlash(self) -> float:
        """What thinning gives of the backlash: thinning cos(beta) cos(alpha_n) of both."""
        thinned = (g.circumferential_thinning * math.cos(b) for g, b in zip(self.gears, self.helices, strict=True))
        return sum(thinned) * math.cos(self.pressure_angle)

    @property
    def normal_backlash(self) -> float:
        """j_bn = p_bn + 2 a sin(alpha_wn) - 2 (R_1 (theta_1 + psi_b1) + R_2 (theta_2 + psi_b2))."""
        opened = self.working_centre_distance - self._distance_at(self.action)
        if abs(opened) < _ROUNDING * self.working_centre_distance:
            opened = 0.0
        return self.thinning_backlash + 2 * opened * self.action.normal[0]

    @property
    def touching_distance(self) -> float:
        """At which both would have no backlash at this angle, mm."""
        return self.working_centre_distance - self.normal_backlash / (2 * self.action.normal[0])

    def _distance_at(self, action: Action) -> float:
        """The distance of the shifts on such a line of action: without backlash but for the thinning."""
        reached = sum(
            arm * (angle + gear.base_half_angle)
            for arm, angle, gear in zip(self.arms, action.angles, self.gears, strict=True)
        )
        return (self.thinning_backlash - self.base_pitch + 2 * reached) / (2 * action.normal[0])

    @cached_property
    def action(self) -> Action:
        """The line of action; raises ParameterError named ``shaft_angle`` where no common tangent is one."""
        sine, cosine = math.sin(self.shaft_angle), math.cos(self.shaft_angle)
        s1, s2 = (math.sin(b) for b in self.base_helices)
        c1 = math.cos(self.base_helices[0])
        if sine == 0:
            raise ParameterError("shaft_angle", self.shaft_angle, "no_common_normal")
        # both base helices tell the parts along the axes; y and the second's y are against each other
        y, across = -(s2 + s1 * cosine) / sine, -(s1 + s2 * cosine) / sine
        if not (y < 0 and across < 0 and abs(y) < c1):
            raise ParameterError("shaft_angle", self.shaft_angle, "no_common_normal")
        x = math.sqrt((c1 - y) * (c1 + y))
        one, two = math.atan2(x, -y), math.atan2(x, -across)
        r1, r2 = self.first.base_radius, self.second.base_radius
        length = (self.working_centre_distance - r1 * math.cos(one) - r2 * math.cos(two)) / x
        # T_2 - T_1 = L N, T_2 = (a - r_b2 cos, -r_b2 sin along the second's y, its z)
        second = (r1 * math.sin(one) + r2 * math.sin(two) * cosine + length * y) / sine
        first = second * cosine + r2 * math.sin(two) * sine - length * s1
        return Action((x, y, s1), (one, two), (first, second), length)

    def at(self, along: float) -> Vector:
        """A place of the line of action, mm from where it touches the first base cylinder."""
        (x, y, z), angle, radius = self.action.normal, self.action.angles[0], self.first.base_radius
        return (radius * math.cos(angle) + along * x, radius * math.sin(angle) + along * y,
                self.action.touches[0] + along * z)  # fmt: skip

    @property
    def pole(self) -> float:
        """Where the line of action is nearest to the line of centres, mm along it: meets it, but for a given angle."""
        _, y, z = self.at(0.0)
        _, ny, nz = self.action.normal
        return -(y * ny + z * nz) / (ny * ny + nz * nz)

    @property
    def working_radii(self) -> tuple[float, float]:
        """r_w of the operating pitch cylinders: from each axis to the pole."""
        lengths = self.pole, self.action.length - self.pole
        return both(
            math.hypot(g.base_radius, at * math.cos(b))
            for g, at, b in zip(self.gears, lengths, self.base_helices, strict=True)
        )

    @property
    def working_helices(self) -> tuple[float, float]:
        """beta_w on them, tan(beta_w) = r_w tan(beta) / r; their sum is Sigma but for a shaft angle of one's own."""
        return both(math.atan(r * twist) for r, twist in zip(self.working_radii, self.twists, strict=True))

    @property
    def working_pressure_angle(self) -> float:
        """alpha_wn, of the line of action from the plane that touches both operating pitch cylinders."""
        return math.asin(self.action.normal[0])

    @cached_property
    def sides(self) -> tuple[ToothSide, ToothSide]:
        """Exact sides of both teeth; raises ParameterError where one cannot be built."""
        return tooth_side(self.first), tooth_side(self.second)

    @cached_property
    def path(self) -> tuple[float, float]:
        """Where contact begins and ends on the line of action between both flanks, whatever the face widths, mm."""
        ends = []
        for gear, side, beta in zip(self.gears, self.sides, self.base_helices, strict=True):
            low, high = (tangent_length(r, gear.base_radius) / math.cos(beta) for r in side.flank_radii(relief=True))
            ends.append((low, high))
        (low, high), (start, end), length = *ends, self.action.length
        return max(low, length - end), min(high, length - start)

    @property
    def tips_path(self) -> tuple[float, float]:
        """The same as both tips would have it, were the flanks whole down to the axes."""
        one, two = (
            tangent_length(side.flank_radii(relief=True)[1], gear.base_radius) / math.cos(beta)
            for gear, side, beta in zip(self.gears, self.sides, self.base_helices, strict=True)
        )
        return self.action.length - two, one

    def heights(self, along: float) -> tuple[float, float]:
        """z along each axis, from the line of centres, of a place on the line of action, mm."""
        (one, two), (s1, s2) = self.action.touches, (math.sin(b) for b in self.base_helices)
        return one + along * s1, two + (self.action.length - along) * s2

    def used(self, way: int = 1) -> tuple[float, float]:
        """Of the path what lies within both faces, mm; ``way`` -1: that of the upper flanks, turned by half a turn."""
        low, high = self.path
        for k, s in ((0, math.sin(self.base_helices[0])), (1, -math.sin(self.base_helices[1]))):
            top, bottom = self.face_widths[k] - self.feet[k], -self.feet[k]
            bottom, top = (bottom, top) if way > 0 else (-top, -bottom)
            begins = self.heights(0.0)[k]
            if s == 0:
                low, high = (low, high) if bottom <= begins <= top else (high, high)
                continue
            ends = sorted((end - begins) / s for end in (bottom, top))
            low, high = max(low, ends[0]), min(high, ends[1])
        return low, high

    @property
    def path_contact_ratio(self) -> float:
        """eps of the whole path between the flanks."""
        return max(self.path[1] - self.path[0], 0.0) / self.base_pitch

    @property
    def contact_ratio(self) -> float:
        """eps within both face widths too, of the side that has less."""
        found = min(high - low for low, high in (self.used(1), self.used(-1)))
        return max(found, 0.0) / self.base_pitch

    @property
    def least_face_widths(self) -> tuple[float, float]:
        """Of each gear the face, its middle on the line of centres, that uses the whole path, mm."""
        ends = [self.heights(end) for end in self.path]
        return 2 * max(abs(end[0]) for end in ends), 2 * max(abs(end[1]) for end in ends)

    @property
    def tip_clearances(self) -> tuple[float, float]:
        """Bottom clearance at the root of the first and of the second gear, mm."""
        a_w, (one, two) = self.working_centre_distance, self.gears
        return a_w - one.root_radius - two.tip_radius, a_w - two.root_radius - one.tip_radius

    def second_rotation(self, first_rotation: float, direction: float = 0.0) -> float:
        """Rotation of the second in the middle of the backlash, both of the lower faces, rad; it runs on."""
        z1, z2 = (g.number_of_teeth for g in self.gears)
        one, two = (twist * foot for twist, foot in zip(self.twists, self.feet, strict=True))
        return direction + math.pi + math.pi / z2 - (first_rotation + one - direction) * z1 / z2 - two

    def speeds(self, along: float) -> tuple[Vector, Vector]:
        """Of both gears at a place of the line of action, mm per rad of the first."""
        x, y, z = self.at(along)
        rate, a = -1 / self.ratio, x - self.working_centre_distance
        sine, cosine = rate * math.sin(self.shaft_angle), rate * math.cos(self.shaft_angle)
        return (-y, x, 0.0), (sine * z - cosine * y, cosine * a, -sine * a)

    def sliding(self, along: float) -> float:
        """How fast the flanks slide there, mm per rad of the first."""
        return math.dist(*self.speeds(along))

    def efficiency(self, friction: float, *, back: bool = False) -> float:
        """Of a contact at the pole, the first driving, or the second; 0: it cannot.

        At the pole on the line of centres (cos(alpha_wn) - f tan(beta_w2)) / (cos(alpha_wn) + f tan(beta_w1)).
        """
        one, two = self.speeds(self.pole)
        slides = [a - b for a, b in zip(one, two, strict=True)]
        size = math.hypot(*slides)
        push = abs(sum(n * v for n, v in zip(self.action.normal, one, strict=True)))
        along = [friction * sum(s * v for s, v in zip(slides, way, strict=True)) / size for way in (one, two)]
        into, out = (push - along[1], push - along[0]) if back else (push + along[0], push + along[1])
        # steep friction turns the driver's sign too, and their quotient would be above 1
        return out / into if out > 0 else 0.0

    def forces(self, friction: float) -> tuple[ToothForces, ToothForces]:
        """Parts of what each gear bears of a normal force of 1 at the pole, the first driving; without their signs."""
        at, speeds, a = self.at(self.pole), self.speeds(self.pole), self.working_centre_distance
        slides = [w - v for v, w in zip(*speeds, strict=True)]
        size = math.hypot(*slides)
        acts = [n + friction * s / size for n, s in zip(self.action.normal, slides, strict=True)]
        found = []
        for axis, begin in (((0.0, 0.0, 1.0), 0.0), ((0.0, math.sin(self.shaft_angle), math.cos(self.shaft_angle)), a)):
            spoke = (at[0] - begin, at[1], at[2])
            along = sum(s * z for s, z in zip(spoke, axis, strict=True))
            out = [s - along * z for s, z in zip(spoke, axis, strict=True)]
            radius = math.hypot(*out)
            radial = sum(f * s for f, s in zip(acts, out, strict=True)) / radius
            axial = sum(f * z for f, z in zip(acts, axis, strict=True))
            around = math.sqrt(max(sum(f * f for f in acts) - radial**2 - axial**2, 0.0))
            found.append(ToothForces(around, abs(radial), abs(axial), 1.0))
        return found[0], found[1]

    def findings(self) -> tuple[Finding, ...]:
        """What is not kept: whole flanks under the mate's tips, one tooth after the other, clearance, backlash."""
        found, least = [], _ROUNDING * self.working_centre_distance
        (low, high), (start, end) = self.tips_path, self.path
        for name, gear, asked, has in (
            ("first", self.first, low, start),
            ("second", self.second, self.action.length - high, self.action.length - end),
        ):
            if asked < has - 1e3 * least:
                cut = "active_flank_cut_away" if undercut(gear).margin < 0 else "fillet_interference"
                found.append(Finding(f"{cut}_{name}", asked, has))
        if self.contact_ratio < 1:
            found.append(Finding("contact_ratio", self.contact_ratio, 1.0))
        for name, width, needed in zip(("first", "second"), self.face_widths, self.least_face_widths, strict=True):
            if width < needed - least:
                found.append(Finding(f"crossed_face_{name}", width, needed))
        for name, clearance in zip(("first", "second"), self.tip_clearances, strict=True):
            if clearance < -least:
                found.append(Finding(f"tip_clearance_{name}", clearance, 0.0))
        return tuple(found)


def crossed_pair(
    bare: CrossedPair, working_centre_distance: float | None = None, shaft_angle: float | None = None
) -> CrossedPair:
    """The pair at zero backlash but for its thinning; ``bare``: both gears, distance and angle left out.

    The operating pitch cylinders touch on the line of centres, Sigma = beta_w1 + beta_w2; of all shaft angles this has
    the least distance. A ``working_centre_distance`` (mm) alone opens them to it; a ``shaft_angle`` (rad, without its
    sign) alone has its own distance, both together have backlash. Tips are shortened as much as the distance is less
    than r_1 + r_2 + (x_1 + x_2) m_n; a given tip diameter stays.

    Raises
    ------
    ParameterError
        The axes are parallel, no working angle exists, or the distance leaves the teeth no room.
    """
    own_distance = working_centre_distance if shaft_angle is None else None
    pair = _opened(bare, _working_sine(bare, own_distance, bare.thinning_backlash))
    if abs(pair.shaft_angle) < _PARALLEL:
        raise ParameterError("helix_angle", bare.helices[1], "axes_would_be_parallel")
    if shaft_angle is not None:
        pair = replace(pair, shaft_angle=math.copysign(shaft_angle, pair.shaft_angle))
        pair = replace(pair, working_centre_distance=pair._distance_at(pair.action))
    if working_centre_distance is not None:
        pair = replace(pair, working_centre_distance=working_centre_distance)
        if pair.normal_backlash < -_ROUNDING * working_centre_distance:
            own = _least_distance(bare) if shaft_angle is None else pair.touching_distance
            if is_told(working_centre_distance, own):
                return crossed_pair(bare, own, shaft_angle)
            cure = limit(own, working_centre_distance, digits=_DIGITS)
            raise ParameterError("working_centre_distance", working_centre_distance, "teeth_overlap", cure)
    shifts = sum(g.profile_shift_coefficient * g.module for g in bare.gears)
    less = sum(g.reference_radius for g in bare.gears) + shifts - pair.working_centre_distance
    one, two = (
        g if less <= 0 or g.given_tip_diameter is not None else replace(g, given_tip_diameter=2 * (g.tip_radius - less))
        for g in bare.gears
    )
    return replace(pair, first=one, second=two)


def _working_sine(bare: CrossedPair, distance: float | None, backlash: float) -> float:
    """sin(alpha_wn) of a backlash, mm: sum of 2 R inv(alpha_wt) = j_bn - p_bn + sum of 2 R psi_b.

    Or, monotonous too, of a distance r_w1 + r_w2 = a_w, mm.
    """
    top = min(math.cos(b) for b in bare.base_helices) * _WITHIN

    def opened(sine: float) -> float:
        if distance is not None:
            return sum(_working_radii(bare, sine)) - distance
        rolled = (involute_function(angle) for angle in _working_angles(bare, sine))
        return 2 * sum(arm * inv for arm, inv in zip(bare.arms, rolled, strict=True)) - wanted

    wanted = backlash - bare.base_pitch
    wanted += 2 * sum(arm * g.base_half_angle for arm, g in zip(bare.arms, bare.gears, strict=True))
    if distance is not None and opened(0.0) >= 0:
        cure = limit(_least_distance(bare), distance, digits=_DIGITS)
        raise ParameterError("working_centre_distance", distance, "no_working_angle", cure)
    if opened(0.0) > 0:
        gear = bare.second
        slope = 2 * gear.module * math.tan(gear.pressure_angle) * bare.arms[1] / gear.reference_radius
        x = gear.profile_shift_coefficient
        cure = limit(x - wanted / slope, x, digits=_DIGITS)
        raise ParameterError("profile_shift_coefficient", x, "no_working_angle_with_first", cure, involute=wanted)
    if distance is not None and opened(top) < 0:
        raise ParameterError("working_centre_distance", distance, "teeth_do_not_reach")
    own = math.sin(bare.pressure_angle)
    # zero shifts: the operating cylinders are the reference cylinders, to the last digit
    if abs(opened(own)) < 1e-14 * sum(bare.arms):
        return own
    return bracketed_root(opened, 0.0, top).value


def _working_angles(bare: CrossedPair, sine: float) -> list[float]:
    """alpha_wt of both where sin(alpha_wn) is this: sin(alpha_wt) = sin(alpha_wn) / cos(beta_b)."""
    return [math.asin(sine / math.cos(b)) for b in bare.base_helices]


def _working_radii(bare: CrossedPair, sine: float) -> list[float]:
    """r_w = r_b / cos(alpha_wt), mm."""
    return [g.base_radius / math.cos(a) for g, a in zip(bare.gears, _working_angles(bare, sine), strict=True)]


def _opened(bare: CrossedPair, sine: float) -> CrossedPair:
    """The pair whose operating pitch cylinders touch where sin(alpha_wn) is this."""
    radii = _working_radii(bare, sine)
    angle = sum(math.atan(r * twist) for r, twist in zip(radii, bare.twists, strict=True))
    if abs(angle - sum(bare.helices)) < _ROUNDING:
        angle = sum(bare.helices)
    return replace(bare, working_centre_distance=sum(radii), shaft_angle=angle)


def _least_distance(bare: CrossedPair) -> float:
    """At which the operating pitch cylinders touch and no backlash is left, mm."""
    return _opened(bare, _working_sine(bare, None, 0.0)).working_centre_distance


def crossing(second: Placement3) -> tuple[complex, tuple[float, float]]:
    """The line of centres of the z axis and that of a placement, mm: across both, and where it meets each of them.

    On axes that are parallel, at the height of the placement's origin.
    """
    (x, y, z), (ox, oy, oz) = second.z, second.translation
    across, offset = complex(x, y), complex(ox, oy)
    size = abs(across)
    if size == 0:
        return offset, (oz, 0.0)
    along = across / size
    foot = -(along.conjugate() * offset).real / size
    return 1j * along * (along.conjugate() * offset).imag, (oz + foot * z, foot)

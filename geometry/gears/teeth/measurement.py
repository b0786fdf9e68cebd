"""What a calliper reads on an involute gear, external or internal: span, pins or balls, chords; spur and helical.

``gear`` is the transverse section (``transverse.transverse_gear``, ``transverse_ring``), ``helix_angle`` on the
reference cylinder, rad. A ring is measured from within: its span is one over spaces, and M lies between its pins. What
an external gear has outwards, a ring has towards the axis: ``_sense``, which is the sign of ISO 21771's tooth number.
The gear's own thinning counts: ``nominal`` gives the same gear without it. Lengths in mm.
Sources: ISO 21771; GOST 16532-70 (span, pins, chords); exact, no table of constants.
"""

from __future__ import annotations

import math
from typing import TypeVar

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record, replace
from geometry.base.roots import bracketed_root
from geometry.gears.teeth.ring import RingGear
from geometry.gears.teeth.ring_tooth import ring_side
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.gears.teeth.transverse import base_helix_angle, normal_angle

Measured = SpurGear | RingGear
G = TypeVar("G", bound=SpurGear | RingGear)

# b_M, mm: length of contact that a measuring face needs on helical teeth, and its growth with W_k; DIN 3960
SPAN_CONTACT = (1.2, 0.018)
# decimals of diameters on drawings, mm
_TOLD = 3


class Span(Record):
    """W_k over ``teeth`` teeth, of a ring over as many spaces, mm, and where the faces touch: ``contact_diameter``, mm.

    ``touches_flanks``: both faces lie on the involute between its form circle and its tip.
    ``least_face_width``: a helical gear must be wider than this, mm, for the faces to find both flanks;
    ``secure_face_width``: W sin(beta_b) + b_M cos(beta_b), with b_M of them in contact on each; DIN 3960.
    """

    teeth: int
    length: float
    contact_diameter: float
    touches_flanks: bool
    least_face_width: float
    secure_face_width: float


class OverPins(Record):
    """M over two pins or balls, of a ring between them, mm; ``touches_flanks`` as in ``Span``.

    ``stands_out``: the pins reach beyond the tip circle and do not sit on the root circle.
    """

    pin_diameter: float
    length: float
    centre_diameter: float
    contact_diameter: float
    touches_flanks: bool
    stands_out: bool


class Chord(Record):
    """Chordal thickness and the height from the tip at which it is measured, mm."""

    thickness: float
    height: float


def _base_helix(gear: Measured, helix_angle: float) -> float:
    return base_helix_angle(gear.pressure_angle, helix_angle)


def flank_radii(gear: Measured) -> tuple[float, float]:
    """Radii at which the main flank ends, mm: at its fillet, and at the tip or what breaks it (chamfer, relief)."""
    return (ring_side(gear) if isinstance(gear, RingGear) else tooth_side(gear)).flank_radii()


def _on_flank(gear: Measured, radius: float) -> bool:
    low, high = sorted(flank_radii(gear))
    return low <= radius <= high


def _middle_radius(gear: Measured) -> float:
    """r + x m, the circle at which pins and faces are to touch, but for the base circle; mm."""
    return gear.reference_radius + gear.profile_shift_coefficient * gear.module


def nominal(gear: G) -> G:
    """The gear without its thinning."""
    return replace(gear, circumferential_thinning=0.0)


def thickness_at(gear: Measured, radius: float) -> float:
    """s_y: arc of the tooth between its main flanks on a circle of a radius, mm; ISO 21771.

    Raises
    ------
    ParameterError
        The circle lies inside the base circle, where there is no involute.
    """
    if radius < gear.base_radius:
        raise ParameterError.beyond("diameter", 2 * radius, "inside_base_circle", 2 * gear.base_radius)
    arc = -2 * radius * gear.flank().polar_angle_at_radius(radius)
    return gear.pitch_angle * radius - arc if isinstance(gear, RingGear) else arc


def base_thickness(gear: Measured) -> float:
    """s_b = 2 r_b psi_b, mm; of a ring e_b, the arc of its space."""
    return 2 * gear.base_radius * gear.base_half_angle


def span(gear: Measured, teeth: int, helix_angle: float = 0.0) -> Span:
    """W_k = cos(beta_b) ((k - 1) p_bt + s_bt), of a ring with e_bt in the place of s_bt; ISO 21771.

    A helical ring has none: no faces find its hollow screw surfaces.

    Raises
    ------
    ParameterError
        ``teeth`` is not from 1 to z.
    """
    if not 1 <= teeth <= gear.number_of_teeth:
        z = gear.number_of_teeth
        cure = Nearest(1, "at_least") if teeth < 1 else Nearest(z, "at_most")
        key = "spaces_spanned" if isinstance(gear, RingGear) else "teeth_spanned"
        raise ParameterError(key, teeth, "span_beyond_teeth", cure, teeth=z)
    base_helix = _base_helix(gear, helix_angle)
    cosine = math.cos(base_helix)
    length = cosine * ((teeth - 1) * gear.pitch_angle * gear.base_radius + base_thickness(gear))
    contact = math.hypot(gear.base_radius, length * cosine / 2)
    width = length * abs(math.sin(base_helix))
    secure = width + (SPAN_CONTACT[0] + SPAN_CONTACT[1] * length) * cosine
    return Span(teeth, length, 2 * contact, _on_flank(gear, contact), width, secure)


def teeth_to_span(gear: Measured, helix_angle: float = 0.0) -> float:
    """k before rounding: the span that would touch the flanks at d + 2 x m; GOST 16532-70, KHK.

    k = z / pi (tan(alpha_x) / cos^2(beta_b) - 2 x tan(alpha) / z - inv(alpha)) + 1/2 with the circle's angle alpha_x,
    no smaller than that of the base circle.
    """
    tangent = math.sqrt(max((_middle_radius(gear) / gear.base_radius) ** 2 - 1, 0.0))
    cosine = math.cos(_base_helix(gear, helix_angle))
    thick = nominal(gear).base_half_angle
    return (tangent / cosine**2 - thick) * gear.number_of_teeth / math.pi + 1


def best_span(gear: Measured, helix_angle: float = 0.0) -> Span | None:
    """The span whose k is nearest to ``teeth_to_span`` among those that touch the flanks; None where none does."""
    wanted = teeth_to_span(gear, helix_angle)
    nearest = max(1, min(gear.number_of_teeth, round(wanted)))
    around = range(max(1, nearest - 3), min(gear.number_of_teeth, nearest + 3) + 1)
    found = [s for s in (span(gear, k, helix_angle) for k in around) if s.touches_flanks]
    # halfway between two the tables take the greater
    return min(found, key=lambda s: (round(abs(s.teeth - wanted), 9), -s.teeth), default=None)


def best_pin_diameter(gear: Measured, helix_angle: float = 0.0) -> float:
    """D_M that touches the flanks at d + 2 x m, mm; exact for balls in helical gears too."""
    return pin_touching_at(nominal(gear), max(_middle_radius(gear), gear.base_radius), helix_angle)


def pin_touching_at(gear: Measured, radius: float, helix_angle: float = 0.0) -> float:
    """The pin or ball that touches both flanks of a space at a distance from the axis, mm.

    With c = cos(beta_b), eta = pi / z - psi_b and the angle alpha_y at that circle: the pin's centre lies at
    tan(alpha_K) = tan(alpha_y) + c D / d_b on the plane of action, and inv(alpha_K) = D / (d_b c) - eta brings it to
    the middle of the space. In a ring both change their signs: tan(alpha_K) = tan(alpha_y) - c D / d_b and
    inv(alpha_K) = eta - D / (d_b c).

    Raises
    ------
    ParameterError
        No pin in front of the axis touches there: the space is wider than the angle that the tangents leave.
    """
    if radius < gear.base_radius:
        raise ParameterError.beyond("diameter", 2 * radius, "inside_base_circle", 2 * gear.base_radius)
    cosine, sense = math.cos(_base_helix(gear, helix_angle)), gear.sign
    eta, tangent = _space_half_angle(gear), math.sqrt((radius / gear.base_radius) ** 2 - 1)

    def excess(angle: float) -> float:
        return (math.tan(angle) - tangent) / cosine**2 - sense * eta - (math.tan(angle) - angle)

    # the centre lies farther out than the contact, in a ring farther in
    low, high = (math.atan(tangent), math.pi / 2 - 1e-9) if sense > 0 else (0.0, math.atan(tangent))
    if excess(low) >= 0 or excess(high) <= 0:
        raise ParameterError("pin_diameter", 2 * radius, "no_pin_touches_there")
    angle = bracketed_root(excess, low, high).value
    return sense * (math.tan(angle) - tangent) * 2 * gear.base_radius / cosine


def pin_limits(gear: Measured, helix_angle: float = 0.0) -> tuple[float, float]:
    """The least and greatest pins that touch the involute itself, from its form circle to its tip, mm.

    In a ring the greatest is also the one whose centre comes to the base circle.
    """
    root, tip = flank_radii(gear)
    low = pin_touching_at(gear, max(root, gear.base_radius), helix_angle)
    cosine = math.cos(_base_helix(gear, helix_angle))
    tangent = cosine**2 * _space_half_angle(gear)
    if isinstance(gear, RingGear) and tip <= gear.base_radius * math.hypot(1.0, tangent):
        return low, 2 * gear.base_radius * tangent / cosine
    return low, pin_touching_at(gear, tip, helix_angle)


def fit_pin_diameter(gear: Measured, helix_angle: float = 0.0) -> float:
    """The best pin, mm; where that touches no involute (undercut, thinning) or is sunk, the middle of those that do.

    One that goes into the spaces of the gear without thinning too; where none does, the best all the same. It has as
    many decimals as drawings tell, so that the size over it is that over the pin they tell.
    """
    best, (low, high) = best_pin_diameter(gear, helix_angle), pin_limits(gear, helix_angle)
    if not (low <= best <= high and over_pins(gear, best, helix_angle).stands_out):
        high = min(high, pin_limits(nominal(gear), helix_angle)[1])
        best = (low + high) / 2 if low <= high else best
    told = round(best, _TOLD)
    return told if low <= told <= high and over_pins(gear, told, helix_angle).stands_out else best


def over_pins(gear: Measured, pin_diameter: float, helix_angle: float = 0.0) -> OverPins:
    """M_d over two pins (balls in helical gears) in opposite spaces, or the nearest to opposite for odd z.

    inv(alpha_K) = D / (d_b cos(beta_b)) - eta, eta = pi / z - psi_b, d_K = d_b / cos(alpha_K);
    M = d_K + D for even z, d_K cos(pi / (2 z)) + D for odd z; ISO 21771, GOST 16532-70.
    Between those of a ring: inv(alpha_K) = eta - D / (d_b cos(beta_b)), M = d_K - D or d_K cos(pi / (2 z)) - D.

    Raises
    ------
    ParameterError
        The pin is so small that it falls through to the bottom of the space; of a ring, so large that its centre would
        not come to the base circle.
    """
    cosine, sense = math.cos(_base_helix(gear, helix_angle)), gear.sign
    value = sense * (pin_diameter / (2 * gear.base_radius * cosine) - _space_half_angle(gear))
    if not value >= 0:
        bound = _space_half_angle(gear) * 2 * gear.base_radius * cosine
        code = "pin_falls_through" if sense > 0 else "pin_beyond_base_circle"
        raise ParameterError.beyond("pin_diameter", pin_diameter, code, bound)
    angle = inverse_involute(value)
    centre = gear.base_radius / math.cos(angle)
    tangent = math.tan(angle) - sense * pin_diameter * cosine / (2 * gear.base_radius)
    contact = gear.base_radius * math.hypot(1.0, tangent)
    odd = gear.number_of_teeth % 2 == 1
    pin = sense * pin_diameter
    length = 2 * centre * (math.cos(math.pi / (2 * gear.number_of_teeth)) if odd else 1.0) + pin
    touches = tangent >= 0 and _on_flank(gear, contact)
    return OverPins(pin_diameter, length, 2 * centre, 2 * contact, touches, _out(gear, centre, pin_diameter) > 0)


def _out(gear: Measured, centre: float, pin_diameter: float) -> float:
    """How far pins reach beyond the tip circle and stand off the root circle, the less of both, mm."""
    sense, pin = gear.sign, gear.sign * pin_diameter / 2
    return min(sense * (centre + pin - gear.tip_radius), sense * (centre - pin - gear.root_radius))


def measuring_limits(gear: Measured, helix_angle: float = 0.0) -> tuple[float, float]:
    """The least and greatest pins, mm, that touch the involute and stand out; where none does, those that touch."""
    low, high = pin_limits(gear, helix_angle)

    def out(pin: float) -> float:
        return _out(gear, over_pins(gear, pin, helix_angle).centre_diameter / 2, pin)

    return (bracketed_root(out, low, high).value if out(low) < 0 < out(high) else low), high


def gear_with_span(gear: G, teeth: int, length: float, helix_angle: float = 0.0) -> G:
    """The gear thinned so that its span over ``teeth`` teeth (of a ring: spaces) is ``length``, mm.

    Raises
    ------
    ParameterError
        The span is longer than the nominal one, of a ring shorter: that tooth is thicker, not thinner.
    """
    full = span(nominal(gear), teeth, helix_angle).length
    lack = gear.sign * (full - length)
    if lack < 0:
        code = "below_nominal" if isinstance(gear, RingGear) else "above_nominal"
        raise ParameterError.beyond("measured_span", length, code, full)
    return replace(gear, circumferential_thinning=lack / normal_share(gear, helix_angle))


def gear_with_size(gear: G, pin_diameter: float, length: float, helix_angle: float = 0.0) -> G:
    """The gear thinned so that its size over pins or balls, of a ring between them, is ``length``, mm.

    What is lacking shows in the space on the base circle: 2 r (eta - eta_0), both by the equation of ``over_pins``.

    Raises
    ------
    ParameterError
        The size is that of a thicker tooth, or so small that the pin would fall through.
    """
    ring, sense = isinstance(gear, RingGear), gear.sign
    key, full = "measured_between_pins" if ring else "measured_over_pins", nominal(gear)
    whole = over_pins(full, pin_diameter, helix_angle).length
    if sense * length > sense * whole:
        raise ParameterError.beyond(key, length, "below_nominal" if ring else "above_nominal", whole)
    odd = math.cos(math.pi / (2 * gear.number_of_teeth)) if gear.number_of_teeth % 2 else 1.0
    centre = (length - sense * pin_diameter) / (2 * odd)
    if centre < gear.base_radius:
        least = 2 * odd * gear.base_radius + sense * pin_diameter
        raise ParameterError.beyond(key, length, "pin_falls_through", least)
    polar = involute_function(math.acos(gear.base_radius / centre))
    eta = pin_diameter / (2 * gear.base_radius * math.cos(_base_helix(gear, helix_angle))) - sense * polar
    return replace(gear, circumferential_thinning=2 * gear.reference_radius * (eta - _space_half_angle(full)))


def normal_share(gear: Measured, helix_angle: float = 0.0) -> float:
    """What a millimetre of thinning takes from a tooth along the normals of its flanks: cos(beta_b) cos(alpha_t)."""
    return math.cos(_base_helix(gear, helix_angle)) * math.cos(gear.pressure_angle)


def reference_chord(gear: Measured, helix_angle: float = 0.0) -> Chord:
    """Chord of the tooth at the reference circle, in the normal section of helical gears; ISO 21771.

    d_n = d / cos^2(beta), s_n = s cos(beta): thickness d_n sin(s_n / d_n), height r_a - r + d_n sin^2(s_n / (2 d_n)),
    in a ring r - r_a - d_n sin^2(s_n / (2 d_n)).
    """
    diameter = 2 * gear.reference_radius / math.cos(helix_angle) ** 2
    half = gear.reference_thickness * math.cos(helix_angle) / diameter
    height = gear.tip_radius - gear.reference_radius + diameter * math.sin(half / 2) ** 2
    return Chord(diameter * math.sin(half), gear.sign * height)


def constant_chord(gear: Measured, helix_angle: float = 0.0) -> Chord:
    """Chord between the points where the basic rack's flanks touch, the same for every z; GOST 16532-70.

    s_c = s_n cos^2(alpha_n), height r_a - r - s_c tan(alpha_n) / 2; the tooth of a ring has it as well, its height
    r - r_a - s_c tan(alpha_n) / 2 (DERIVATIONS.md, 3).
    """
    alpha = normal_angle(gear.pressure_angle, helix_angle)
    thickness = gear.reference_thickness * math.cos(helix_angle) * math.cos(alpha) ** 2
    addendum = gear.sign * (gear.tip_radius - gear.reference_radius)
    return Chord(thickness, addendum - thickness * math.tan(alpha) / 2)


def _space_half_angle(gear: Measured) -> float:
    """eta_b = pi / z - psi_b: half of the space's angle on the base circle, rad; negative: overlap."""
    own = gear.base_half_angle
    return own if isinstance(gear, RingGear) else math.pi / gear.number_of_teeth - own


def angle_at(gear: Measured, radius: float) -> float:
    """alpha_y = arccos(r_b / r_y): the involute's pressure angle on a circle, rad."""
    return math.acos(min(gear.base_radius / radius, 1.0))

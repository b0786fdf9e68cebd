"""The atlas of stiff and extreme cases: what the program computes there, and the same at 50 digits.

A case drives one size to where digits are lost: angles towards 0, a pair towards its last shift, arms towards a dead
point. Its truth is the formula of the source that is named, evaluated by mpmath, and shares no code with what it
judges. Inputs are floats, taken as exact by both; whole numbers (teeth) have no rounding that could be magnified.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import mpmath

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.hertz import stiffness
from geometry.base.record import Record
from geometry.cams.motion.follower_motion import dwell, follower_motion, return_, rise
from geometry.cams.plane.disk import FollowerKind, translating_cam
from geometry.curves.cycloid import path_curvature
from geometry.curves.involute import Involute
from geometry.curves.trochoid import TrochoidFillet
from geometry.gears.noncircular.pitch_line import DriverShape, PitchLine
from geometry.gears.pairs.external import external_pair
from geometry.gears.pairs.involute import Sums
from geometry.gears.planetary.sets import SCHEMES, PlanetarySet, ratio_of
from geometry.gears.teeth.basic_rack import BasicRack
from geometry.gears.teeth.measurement import over_pins, span, thickness_at
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.gears.worms.worm import Worm
from geometry.kinematics.centrodes import LobedEllipse
from geometry.kinematics.two_disk import TwoDisk
from geometry.laws.named import modified_trapezoid, polynomial_345, polynomial_law
from geometry.solids.mass import section_moments
from parts.base.texts import N_

MP = mpmath.mp.clone()
MP.dps = 50
# numbers of mpmath, which has no types
Number = Any
Inputs = tuple[float, ...]
ALPHA = math.radians(20)


class Case(Record):
    """One size on its way to the extreme.

    ``inputs`` of a value, as ``ours`` and ``truth`` take them; ``size``: the largest number, in the unit of the result,
    that a way through the sizes of the drawing has to go through (radii, where differences of theirs are told), 0 where
    the result itself is that.
    """

    name: str
    varied: str
    values: Inputs
    inputs: Callable[[float], Inputs]
    ours: Callable[..., complex]
    truth: Callable[..., Number]
    size: Callable[..., float] = lambda *inputs: 0.0


def _inv(angle: Number) -> Number:
    return MP.tan(angle) - angle


def _angle(involute: Number) -> Number:
    """The angle of an involute function, by Newton's method for t = tan(alpha), t - atan(t) = inv."""
    t = MP.cbrt(3 * involute) if involute < 1 else involute + MP.pi / 2
    for _ in range(60):
        step = (t - MP.atan(t) - involute) * (1 + 1 / t**2)
        t -= step
        if abs(step) < MP.mpf(10) ** -48 * t:
            break
    return MP.atan(t)


def _gear(m: float, z: int, x: float, alpha: float, tip: float | None = None) -> SpurGear:
    return SpurGear(m, z, BasicRack(alpha, 1.0, 0.25, 0.38), x, tip)


def _half_angle(z: int, x: Number, alpha: Number) -> Number:
    """Half of a tooth's angle on the base circle, ISO 21771: (pi/2 + 2 x tan alpha)/z + inv alpha."""
    return (MP.pi / 2 + 2 * x * MP.tan(alpha)) / z + _inv(alpha)


def _working(z: int, x: Number, alpha: Number) -> Number:
    return _angle(_inv(alpha) + 2 * x * MP.tan(alpha) / z)


# -- gears and pairs


def _last_shift(share: float) -> Inputs:
    """Shift sums of an internal pair 20 / 41 that leave this share of inv(alpha)."""
    return (-(1 - share) * 21 * (math.tan(ALPHA) - ALPHA) / (2 * math.tan(ALPHA)), ALPHA)


def _contact_ratio(m: Number, z: int, x: Number, alpha: Number) -> Number:
    """ISO 21771 of two equal gears, tips shortened by x1 + x2 - y (practicum 3.11)."""
    angle = _working(z, x, alpha)
    r, rb = m * z / 2, m * z * MP.cos(alpha) / 2
    distance = 2 * rb / MP.cos(angle)
    shortening = MP.mpf(2) * x - (distance - 2 * r) / m
    tip = r + (1 + x - max(shortening, 0)) * m
    return (2 * MP.sqrt(tip**2 - rb**2) - distance * MP.sin(angle)) / (MP.pi * m * MP.cos(alpha))


def _tip_thickness(m: Number, z: int, x: Number, tip: Number, alpha: Number) -> Number:
    rb = m * z * MP.cos(alpha) / 2
    return 2 * tip * (_half_angle(z, x, alpha) - _inv(MP.acos(rb / tip)))


def _below_point(gap: float) -> Inputs:
    """A tip diameter so far below that of the pointed tooth, z 12, x 0.5."""
    half = (math.pi / 2 + math.tan(ALPHA)) / 12 + involute_function(ALPHA)
    return (2.0, 12, 0.5, 24 * math.cos(ALPHA) / math.cos(inverse_involute(half)) - gap, ALPHA)


def _over_pins(m: Number, z: int, x: Number, pin: Number, alpha: Number) -> Number:
    """ISO 21771: inv alpha_K = inv alpha - pi/(2z) + (D/m + 2 x sin alpha)/(z cos alpha), z even."""
    at = _angle(_inv(alpha) - MP.pi / (2 * z) + (pin / m + 2 * x * MP.sin(alpha)) / (z * MP.cos(alpha)))
    return m * z * MP.cos(alpha) / MP.cos(at) + pin


def _span(m: Number, z: int, x: Number, k: int, alpha: Number) -> Number:
    """Practicum and ISO 21771: W = m cos alpha (pi (k - 1/2) + z inv alpha + 2 x tan alpha)."""
    return m * MP.cos(alpha) * (MP.pi * (k - MP.mpf(1) / 2) + z * _inv(alpha) + 2 * x * MP.tan(alpha))


def _trochoid(r: Number, depth: Number, rho: Number, u: Number) -> Number:
    """The rounding's point of contact: its centre rolls with the rack, the common normal goes through the pole."""
    centre = r - depth + 1j * depth * MP.tan(u)
    return (centre - rho * MP.expj(-u)) * MP.expj(-depth * MP.tan(u) / r)


def _area(m: Number, z: int, alpha: Number) -> Number:
    """Area of a gear of rack A without shift and undercut: arcs, involutes and trochoids of half a pitch."""
    r, rb, tip = m * z / 2, m * z * MP.cos(alpha) / 2, m * z / 2 + m
    rho, rise = MP.mpf(0.38) * m, MP.mpf(1.25) * m
    depth, half = rise - rho, _half_angle(z, MP.mpf(0), alpha)
    top = MP.tan(MP.acos(rb / tip))
    start = MP.tan(alpha) - (depth + rho * MP.sin(alpha)) / (r * MP.sin(alpha) * MP.cos(alpha))

    def swept(u: Number) -> Number:
        q = depth / r
        speed = rho * (1 + q / MP.cos(u) ** 2) + depth * q / MP.cos(u) ** 3
        tangent = 1j * MP.expj(-q * MP.tan(u) - u)
        return (MP.conj(_trochoid(r, depth, rho, u)) * tangent * speed).imag / 2

    land = (m * (MP.pi / 4 - MP.mpf(1.25) * MP.tan(alpha)) - rho * (1 / MP.cos(alpha) - MP.tan(alpha))) / r
    fillet = MP.quad(swept, [0, MP.pi / 4, MP.pi / 2 - alpha])
    flank = rb**2 * (top**3 - start**3) / 6
    arc = tip**2 * (half - (top - MP.atan(top))) / 2 + (r - rise) ** 2 * land / 2
    return 2 * z * (arc + flank + fillet)


# -- laws and cams


def _rest_to_rest(order: int) -> tuple[tuple[float, int, float], ...]:
    return tuple((end, k, end if k == 0 else 0.0) for end in (0.0, 1.0) for k in range(order))


def _acceleration(u: Number, order: int) -> Number:
    """s'' of the polynomial with ``order`` conditions at each end: s' = (u (1 - u))^(order - 1) / B(order, order)."""
    n = order - 1
    return n * (u * (1 - u)) ** (n - 1) * (1 - 2 * u) / MP.beta(order, order)


def _modified_trapezoid(u: Number, ramp: Number) -> Number:
    """s by two integrations of its acceleration, quarter sines of the share ``ramp`` in place of straight ramps."""

    def rate(t: Number) -> Number:
        if t > 0.5:
            return -rate(1 - t)
        edge = min(t, MP.mpf(0.5) - t)
        return MP.sin(MP.pi * edge / (2 * ramp)) if edge < ramp else MP.mpf(1)

    def place(at: Number) -> Number:
        ends = [MP.mpf(0), ramp, MP.mpf(0.5) - ramp, MP.mpf(0.5) + ramp, 1 - ramp]
        return MP.quad(lambda t: (at - t) * rate(t), [*(e for e in ends if e < at), at])

    return place(u) / place(MP.mpf(1))


def _cam_curvature(lift: Number, prime: Number, roller: Number, angle: Number, way: Number) -> Number:
    """Radius of curvature of a cam's profile, 3-4-5 rise, roller on the line through the axis; Norton, 7."""
    u = angle / way
    x = prime + lift * (10 * u**3 - 15 * u**4 + 6 * u**5)
    first = lift / way * 30 * u**2 * (1 - u) ** 2
    second = lift / way**2 * 60 * u * (1 - u) * (1 - 2 * u)
    return (x**2 + first**2) ** MP.mpf(1.5) / (x**2 + 2 * first**2 - x * second) - roller


def _cam(lift: float, prime: float, roller: float, angle: float, way: float) -> float:
    law = polynomial_345()
    motion = follower_motion([rise(way, lift, law), return_(way, lift, law), dwell(2 * math.pi - 2 * way)])
    cam = translating_cam(motion, FollowerKind.ROLLER, prime - roller, radius=roller)
    return float(cam.curvature_radius(angle))


def _last_roller(gap: float) -> Inputs:
    path = float(_cam_curvature(*(MP.mpf(x) for x in (20.0, 40.0, 0.0, 0.9, 1.2))))
    return (20.0, 40.0, path - gap, 0.9, 1.2)


# -- mechanisms


def _two_disk(x: Number, y: Number, one: Number, two: Number) -> Number:
    """delta + i beta by the law of cosines, thesis (2.1)."""
    far = MP.hypot(x, y)
    beta = MP.acos((one**2 + two**2 - far**2) / (2 * one * two))
    return MP.atan2(x, y) - MP.acos((one**2 + far**2 - two**2) / (2 * one * far)) + 1j * beta


def _arms(x: float, y: float, one: float, two: float) -> complex:
    delta, beta = TwoDisk((one, two)).inverse(complex(x, y))
    return complex(float(delta), float(beta))


def _near(radius: float, second: float) -> Inputs:
    return (radius * math.sin(0.7), radius * math.cos(0.7), 72.0, second)


def _ratio(z1: int, z2: int, z2p: int, z3: int) -> float:
    return float(
        ratio_of(PlanetarySet(SCHEMES["david"], (z1, z2, z2p, z3)).carried_ratio, "carrier", "first") or math.nan
    )


def _carrier(z1: int, z2: int, z2p: int, z3: int) -> Number:
    """Turns of the carrier for one of wheel 1 where wheel 3 is held; Willis, practicum (2.5)."""
    return 1 / (1 - MP.mpf(z2) * z3 / (MP.mpf(z1) * z2p))


def _stiffness(flat: Number, sharp: Number) -> Number:
    """Hertz, point contact; Johnson, Contact Mechanics, 4.2."""

    def off(k: Number) -> Number:
        first, second = MP.ellipk(1 - k**2), MP.ellipe(1 - k**2)
        return (second / k**2 - first) - sharp / flat * (first - second)

    k = MP.findroot(off, (MP.mpf(10) ** -7, 1 - MP.mpf(10) ** -15), solver="anderson", tol=1e-80, maxsteps=300)
    half = (3 * k * MP.ellipe(1 - k**2) / (MP.pi * 115e3 * (flat + sharp))) ** (MP.mpf(1) / 3)
    return (3 * k * MP.ellipk(1 - k**2) / (2 * MP.pi * 115e3 * half)) ** MP.mpf(-1.5)


def _perimeter(parameter: Number, eccentricity: Number) -> Number:
    """Perimeter of the ellipse p / (1 - e cos phi): 4 a E(e)."""
    return 4 * parameter / (1 - eccentricity**2) * MP.ellipe(eccentricity**2)


CASES: tuple[Case, ...] = (
    Case(
        N_("involute function"), N_("α, rad"), (1e-8, 1e-5, 1e-3, 0.1, 0.35, 1.0, 1.5, 1.57079),
        lambda v: (v,), involute_function, _inv,
    ),
    Case(
        N_("angle of an involute function"), "inv α", (1e-24, 1e-15, 1e-9, 1e-4, 0.015, 1.0, 1e3, 1e9),
        lambda v: (v,), inverse_involute, _angle,
    ),
    Case(
        N_("point of an involute by its cusp"), N_("roll angle, rad"), (1e-15, 1e-9, 1e-4, 0.1, 1.0, 10.0),
        lambda v: (10.0, v), lambda r, f: complex(Involute(r, 0.0, 0.0, 20.0).point(f)),
        lambda r, f: r * MP.expj(f) * (1 - 1j * f),
    ),
    Case(
        N_("working angle of an internal pair 20 / 41 by its last shift"), N_("share of inv α left"),
        (1.0, 0.1, 1e-3, 1e-6, 1e-9, 1e-12), _last_shift,
        lambda x, alpha: inverse_involute(Sums(-21, -x, -1.0, 0.0, alpha).involute),
        lambda x, alpha: _working(21, x, alpha),
    ),
    Case(
        N_("contact ratio of two equal gears"), "z", (18.0, 30.0, 100.0, 1000.0, 10000.0),
        lambda v: (2.0, int(v), 0.1, ALPHA),
        lambda m, z, x, alpha: external_pair(_gear(m, z, x, alpha), _gear(m, z, x, alpha)).contact_ratio,
        _contact_ratio, lambda m, z, x, alpha: z,
    ),
    Case(
        N_("tooth thickness on the tip of an all but pointed tooth"), N_("below the point, mm"),
        (1.0, 0.1, 1e-3, 1e-6, 1e-9, 1e-11), _below_point,
        lambda m, z, x, tip, alpha: thickness_at(_gear(m, z, x, alpha, tip), tip / 2),
        lambda m, z, x, tip, alpha: _tip_thickness(m, z, x, tip / 2, alpha),
    ),
    Case(
        N_("size over pins"), "z", (10.0, 20.0, 100.0, 1000.0, 10000.0), lambda v: (2.0, int(v), 0.3, 3.5, ALPHA),
        lambda m, z, x, pin, alpha: over_pins(_gear(m, z, x, alpha), pin).length,
        _over_pins,
    ),
    Case(
        N_("span over teeth"), "z", (12.0, 20.0, 100.0, 1000.0, 10000.0),
        lambda v: (2.0, int(v), 0.3, int(v) // 9 + 1, ALPHA),
        lambda m, z, x, k, alpha: span(_gear(m, z, x, alpha), k).length, _span,
    ),
    Case(
        N_("fillet whose rounding centre comes to the pitch line"), N_("depth D, mm"),
        (1.0, 1e-3, 1e-6, 1e-12, 0.0, -1e-6, -0.05), lambda v: (20.0, v, 0.76, 0.9),
        lambda r, d, rho, u: complex(TrochoidFillet(r, d, rho, 0.0, 0.0, 1.2).point(u)), _trochoid,
    ),
    Case(
        N_("area of a gear"), "z", (18.0, 30.0, 100.0, 1000.0, 10000.0), lambda v: (2.0, int(v), ALPHA),
        lambda m, z, alpha: float(section_moments(tooth_side(_gear(m, z, 0.0, alpha)).profile())[0]), _area,
        lambda m, z, alpha: (m * z / 2) ** 2 * z * involute_function(alpha),
    ),
    Case(
        N_("acceleration of a polynomial law by the end of its phase, u = 0.999"), N_("degree"),
        (3.0, 5.0, 7.0, 15.0, 23.0, 31.0), lambda v: (0.999, int(v + 1) // 2),
        lambda u, order: float(polynomial_law(_rest_to_rest(order)).value(u, 2)), _acceleration,
        lambda u, order: 0.0,
    ),
    Case(
        N_("modified trapezoid with steep ramps, s at u = 0.3"), N_("share of a ramp"),
        (0.125, 0.01, 1e-3), lambda v: (0.3, v), lambda u, ramp: float(modified_trapezoid(ramp).value(u)),
        _modified_trapezoid,
    ),
    Case(
        N_("radius of curvature of a roller cam by undercut"), N_("left of it, mm"),
        (10.0, 1.0, 1e-3, 1e-6, 1e-9, 1e-12), _last_roller, _cam, _cam_curvature,
    ),
    Case(
        N_("angles of the two-disk table by its centre, equal arms"), N_("from the centre, mm"),
        (100.0, 1.0, 1e-3, 1e-6, 1e-9, 1e-12), lambda v: _near(v, 72.0), _arms, _two_disk,
    ),
    Case(
        N_("angles of the two-disk table by its rim"), N_("from the rim, mm"),
        (10.0, 0.1, 1e-3, 1e-6, 1e-9, 1e-11), lambda v: _near(144.0 - v, 72.0), _arms, _two_disk,
    ),
    Case(
        N_("angles of the two-disk table by its inner rim, unequal arms"), N_("from the rim, mm"),
        (10.0, 0.1, 1e-3, 1e-6, 1e-9, 1e-11), lambda v: _near(22.0 + v, 50.0), _arms, _two_disk,
    ),
    Case(
        N_("turns of the carrier for one of wheel 1, David z / z + 1 - z / z - 1"), "z", (100.0, 1e4, 1e6, 1e8, 1e12),
        lambda v: (int(v), int(v) + 1, int(v), int(v) - 1), _ratio, _carrier,
    ),
    Case(
        N_("axial pressure angle of an involute worm"), N_("lead angle, deg"),
        (0.01, 1.0, 5.71, 30.0, 60.0, 80.0, 89.0),
        lambda v: (5.0, 1 / math.tan(math.radians(v)), ALPHA),
        lambda m, q, alpha: Worm(m, 1, q, "ZI", alpha).axial_pressure_angle,
        lambda m, q, alpha: MP.atan(MP.tan(alpha) * MP.sqrt(1 + 1 / q**2)),
    ),
    Case(
        N_("stiffness of two bodies pressed together"), N_("ratio of curvatures"),
        (1 + 1e-12, 1 + 1e-6, 1.01, 2.0, 1e3, 1e6, 1e8), lambda v: (0.01, 0.01 * v),
        lambda flat, sharp: stiffness((flat, sharp), 115e3), _stiffness,
    ),
    Case(
        N_("curvature of a cycloidal disc's path by its cusp"), "1 - λ", (0.5, 1e-2, 1e-4, 1e-8, 1e-12),
        lambda v: (30.0, 1 - v, 11.0), lambda a, short, m: float(path_curvature(a, short, m, (1 - short) ** 2)),
        lambda a, short, m: -((m - 1) * (1 - short**2) - (m + 1) * (1 - short) ** 2) / (2 * a * (1 - short) ** 3),
    ),
    Case(
        N_("perimeter of a slender ellipse"), N_("eccentricity"), (0.1, 0.5, 0.9, 0.99, 0.999),
        lambda v: (20.0, v), lambda p, e: PitchLine(DriverShape(LobedEllipse(p, e))).length, _perimeter,
    ),
)  # fmt: skip

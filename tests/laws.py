"""Laws that every exact curve must satisfy, held against 50-digit arithmetic.

``exact_point`` rebuilds each curve from its definition (an unwound string, a rolling rack, a common normal through
the pitch point) in mpmath; it uses none of the curve's own formulas.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from typing import Any, cast

import mpmath
import numpy as np

from geometry.base.errors import CuspError
from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.curve import Carried, Curve, Mirrored, OffsetCurve, Reversed
from geometry.curves.cutter_fillet import CutterFillet
from geometry.curves.ellipse import EllipticArc
from geometry.curves.elliptic_fillet import EllipticFillet
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.curves.trochoid import TrochoidFillet
from tests.brute import refusal
from tests.oracles.trochoid import Trochoid

MP: Any = mpmath.mp.clone()
MP.dps = 50
ExactPoint = Callable[[Any], Any]
ROUNDING = 1e-13


def exact_point(curve: Curve) -> ExactPoint:
    """The curve's point at 50 digits as a function of an mpf parameter."""
    if isinstance(curve, Line):
        return lambda t: MP.mpc(curve.start) + t * (MP.mpc(curve.end) - MP.mpc(curve.start))
    if isinstance(curve, Arc):
        sense = 1 if curve.sweep > 0 else -1
        return lambda t: MP.mpc(curve.centre) + curve.radius * MP.expj(curve.start_angle + sense * t)
    if isinstance(curve, Involute):
        return lambda f: _string_end(curve, f)
    if isinstance(curve, Trochoid):
        return lambda s: _rolled(curve, s, MP.mpc(curve.pitch_radius - MP.mpf(curve.depth), s))
    if isinstance(curve, TrochoidFillet):
        return lambda u: _enveloped(curve, u)
    if isinstance(curve, EllipticArc):
        return lambda t: _stretched(curve, exact_point(curve.arc)(t))
    if isinstance(curve, EllipticFillet):
        return lambda u: _rolled_off(curve, u)
    if isinstance(curve, CutterFillet):
        return lambda u: _shaped(curve, u)
    if isinstance(curve, OffsetCurve):
        return lambda t: _parallel(exact_point(curve.base), curve.distance, t)
    if isinstance(curve, Reversed):
        return lambda t: exact_point(curve.base)(-t)
    if isinstance(curve, Mirrored):
        return lambda t: MP.conj(exact_point(curve.base)(-t))
    if isinstance(curve, Carried):
        place = curve.placement
        return lambda t: MP.expj(MP.mpf(place.angle)) * exact_point(curve.base)(t) + MP.mpc(place.translation)
    raise TypeError(type(curve))


def _string_end(curve: Involute, roll: Any) -> Any:
    """End of a taut string of the unwound length, tangent to the base circle."""
    spoke = MP.expj(MP.mpf(curve.base_angle) + roll)
    return MP.mpc(curve.centre) + curve.base_radius * spoke + curve.base_radius * roll * (-1j * spoke)


def _rolled(curve: Trochoid | TrochoidFillet | EllipticFillet, shift: Any, point: Any) -> Any:
    """A fixed-frame point in the frame of the gear that has rolled by ``shift`` along the rack."""
    return MP.mpc(curve.centre) + MP.expj(MP.mpf(curve.angle) - shift / MP.mpf(curve.pitch_radius)) * point


def _enveloped(curve: TrochoidFillet, u: Any) -> Any:
    """Contact point of the rounding: its normal, of direction exp(-iu), passes through the pitch point."""
    normal, radius = MP.expj(-u), MP.mpf(curve.pitch_radius)
    # the centre's position along the pitch line for which (pitch point - centre) is parallel to the normal
    shift = -MP.mpf(curve.depth) * normal.imag / normal.real
    centre = MP.mpc(radius - MP.mpf(curve.depth), shift)
    return _rolled(curve, shift, centre - curve.tip_radius * normal)


def _stretched(curve: EllipticArc, point: Any) -> Any:
    place = curve.placement
    return MP.expj(place.angle) * MP.mpc(point.real, curve.stretch * point.imag) + MP.mpc(place.translation)


def _rolled_off(curve: EllipticFillet, u: Any) -> Any:
    """Contact point of an ellipse moved outwards: where its gradient is along exp(-iu)."""
    normal, radius = MP.expj(-u), MP.mpf(curve.pitch_radius)
    deep, wide = MP.mpf(curve.semi_axis), MP.mpf(curve.semi_axis) * MP.mpf(curve.stretch)
    # the gradient (x / deep^2, y / wide^2) of the ellipse is parallel to the normal
    touch = MP.mpc(deep**2 * normal.real, wide**2 * normal.imag)
    touch /= MP.sqrt((touch.real / deep) ** 2 + (touch.imag / wide) ** 2)
    touch += (MP.mpf(curve.tip_radius) - deep) * normal
    # the rack's position for which the line from the contact to the pitch point is parallel to the normal
    depth = MP.mpf(curve.depth) + touch.real
    contact = MP.mpc(radius - depth, -depth * normal.imag / normal.real)
    shift = contact.imag + touch.imag
    return _rolled(curve, shift, contact)


def _shaped(curve: CutterFillet, u: Any) -> Any:
    """Contact point of a cutter's corner: its centre is where the normal through the pitch point meets its circle."""
    normal, radius, rolling = MP.expj(-u), MP.mpf(curve.pitch_radius), MP.mpf(curve.cutter_radius)
    corner = abs(rolling) + MP.mpf(curve.depth)
    axis, sense = radius - rolling, MP.sign(rolling)
    # |radius + w normal - axis| = corner, the root that is the corner beyond the pitch point at u = 0
    half = (MP.conj(normal) * (radius - axis)).real
    along = -half + sense * MP.sqrt(half**2 - rolling**2 + corner**2)
    centre = radius + along * normal
    turned = MP.arg(sense * (centre - axis))
    work = MP.mpf(curve.angle) - turned * rolling / radius
    return MP.mpc(curve.centre) + MP.expj(work) * (centre + sense * MP.mpf(curve.tip_radius) * normal)


def _parallel(base: ExactPoint, distance: float, t: Any) -> Any:
    first = MP.diff(base, t)
    return base(t) + 1j * MP.mpf(distance) * first / abs(first)


def parameters(curve: Curve, count: int = 5) -> np.ndarray:
    """Parameters of a curve, ends included, at uneven places."""
    low, high = curve.domain
    return low + (high - low) * np.linspace(0, 1, count) ** 1.3


def size(curve: Curve) -> float:
    """Largest distance of the curve from the origin or of its ends from each other, mm; at least its own scale."""
    scale = float(np.max(np.abs(curve.point(parameters(curve, 33)))))
    for name in ("pitch_radius", "base_radius", "radius", "tip_radius", "cutter_radius"):
        scale = max(scale, abs(getattr(curve, name, 0.0)))
    return scale


def check_derivatives_together(curve: Curve) -> None:
    """What one evaluation gives agrees with differences of points: the curve, turned, mirrored and travelled back."""
    for other in (curve, Carried(curve, Placement2(0.7, 3 - 2j)), Mirrored(curve), Reversed(curve)):
        low, high = other.domain
        step = 1e-4 * (high - low)
        t = np.linspace(low + step, high - step, 9)
        before, at, after = (other.point(t + k * step) for k in (-1, 0, 1))
        point, first, second = other.derivatives(t, 2)
        assert np.abs(point - at).max() <= 1e-12 * np.abs(at).max()
        for found, wanted in ((first * step, (after - before) / 2), (second * step**2, after - 2 * at + before)):
            assert np.abs(found - wanted).max() <= 1e-4 * np.abs(wanted).max() + 1e-14 * np.abs(at).max()


def check_alike(curve: Curve) -> None:
    """Curves that call each other alike, asked together, are what each is alone: every number of one may differ."""
    numbers = {name: getattr(curve, name) for name in getattr(curve, "__struct_fields__", ())}
    others = [
        replace(cast("Any", curve), **{name: 1.01 * value + 0.003})
        for name, value in numbers.items() if isinstance(value, float | complex)
    ]  # fmt: skip
    groups: dict[object, list[Curve]] = {}
    for one in (curve, curve.reversed(), *others):
        held = (Carried(one, Placement2(turn, turn - 2j)) for turn in (0.7, -0.2))
        for form in (one, Mirrored(one), Reversed(one), *held):
            if form.alike is not None:
                groups.setdefault(form.alike, []).append(form)
    for group in groups.values():
        t = np.array([parameters(form, 3)[1] for form in group])
        together = group[0].together(group).taken(np.arange(len(group))).derivatives(t, 2)
        alone = np.transpose([form.derivatives(at, 2) for form, at in zip(group, t, strict=True)])
        for found, wanted in zip(together, alone, strict=True):
            assert np.abs(found - wanted).max() <= 1e-12 * np.abs(wanted).max()


def check_derivatives(curve: Curve) -> None:
    """Point and derivatives 1 to 4 against 50-digit differentiation, within roundings of the largest term."""
    exact = exact_point(curve)
    low, high = curve.domain
    for t in parameters(curve, 3):
        assert abs(complex(curve.point(t)) - complex(exact(MP.mpf(float(t))))) <= 20 * ROUNDING * size(curve)
        coefficients = [MP.diff(exact, MP.mpf(float(t)), k) for k in (1, 2, 3, 4)]
        for order, value in enumerate(coefficients, 1):
            bound = curve.derivative_bound(order, low, high)
            # Cauchy: the terms of derivative k are no larger than the larger derivatives around it
            scale = bound if bound is not None else _growth(coefficients, order)
            found = complex(curve.derivative(t, order))
            assert abs(found - complex(value)) <= 20 * ROUNDING * (scale + abs(complex(value))), (curve, t, order)


def _growth(coefficients: list[Any], order: int) -> float:
    """Size of the terms that make up a derivative of a parallel curve: powers of the rate of turning."""
    first = abs(complex(coefficients[0]))
    rate = max(1.0, *(abs(complex(c)) / first for c in coefficients)) if first > 0 else 1.0
    return 1e2 * max(abs(complex(c)) for c in coefficients) + 1e2 * first * rate**order


def check_tangent_and_curvature(curve: Curve) -> None:
    """Unit tangent along the derivative; curvature is the turning rate per arc length, with its sign."""
    exact = exact_point(curve)
    low, high = curve.domain
    for t in low + (high - low) * np.array([0.07, 0.5, 0.93]):
        first, second = (MP.diff(exact, MP.mpf(float(t)), k) for k in (1, 2))
        tangent = complex(curve.tangent(t))
        assert abs(abs(tangent) - 1) <= 1e-14
        assert abs(tangent - complex(first / abs(first))) <= 1e-11
        turning = float((MP.conj(first) * second).imag / abs(first) ** 3)
        scale = abs(turning) + float(abs(second) / abs(first) ** 2)
        assert abs(float(curve.curvature(t)) - turning) <= 1e-10 * scale
        if abs(turning) > 1e-9 * scale:
            assert math.copysign(1, float(curve.curvature(t))) == math.copysign(1, turning)


def check_derivative_bound(curve: Curve) -> None:
    """The bound is never below any dense sample, on the whole domain and on parts of it."""
    low, high = curve.domain
    for a, b in ((0.0, 1.0), (0.0, 0.2), (0.4, 0.6), (0.8, 1.0)):
        start, end = low + a * (high - low), low + b * (high - low)
        t = np.linspace(start, end, 257)
        for order in (1, 2, 3, 4):
            bound = curve.derivative_bound(order, start, end)
            if bound is None:
                assert isinstance(_plain(curve), OffsetCurve)
                continue
            largest = float(np.max(np.abs(curve.derivative(t, order))))
            assert bound >= largest * (1 - 1e-13)
            if not isinstance(_plain(curve), TrochoidFillet | EllipticFillet | CutterFillet):
                assert bound <= largest * (1 + 1e-13)  # these bounds are attained


def _plain(curve: Curve) -> Curve:
    """What is reversed, mirrored or carried."""
    while isinstance(curve, Reversed | Mirrored | Carried):
        curve = curve.base
    return curve


def check_reversal(curve: Curve) -> None:
    """The reverse runs through the same points the other way; twice reversed is the curve itself."""
    t = parameters(curve, 17)
    back, twice = curve.reversed(), curve.reversed().reversed()
    low, high = back.domain
    mirrored = low + (curve.domain[1] - t) * (high - low) / (curve.domain[1] - curve.domain[0])
    allowed = 20 * ROUNDING * size(curve)
    assert np.max(np.abs(back.point(mirrored) - curve.point(t))) <= allowed
    assert np.max(np.abs(back.tangent(mirrored) + curve.tangent(t))) <= 1e-9
    bend = curve.curvature(t[1:-1])
    assert np.max(np.abs(back.curvature(mirrored[1:-1]) + bend)) <= 1e-8 * np.max(np.abs(bend), initial=1e-300)
    start, end = twice.domain
    assert abs((end - start) - (curve.domain[1] - curve.domain[0])) <= 1e-14 * max(map(abs, curve.domain))
    again = twice.point(start + (t - curve.domain[0]) * (end - start) / (curve.domain[1] - curve.domain[0]))
    assert np.max(np.abs(again - curve.point(t))) <= allowed


def check_placement(curve: Curve, placement: Placement2) -> None:
    """Placing carries points and tangents by the motion and keeps curvature; the inverse brings all back."""
    t = parameters(curve, 17)
    there = curve.placed(placement)
    allowed = 20 * ROUNDING * (size(curve) + abs(placement.translation))
    turn = cmath.exp(1j * placement.angle)
    moved = curve.point(t) * turn + placement.translation
    assert np.max(np.abs(there.point(t) - moved)) <= allowed
    assert np.max(np.abs(there.tangent(t) - curve.tangent(t) * turn)) <= 1e-9
    assert np.allclose(there.curvature(t[1:-1]), curve.curvature(t[1:-1]), rtol=1e-8, atol=0)
    home = there.placed(placement.inverse())
    assert np.max(np.abs(home.point(t) - curve.point(t))) <= allowed


def check_trimming(curve: Curve, a: float, b: float) -> None:
    """The part between two parameters has the curve's own points there, ends first."""
    low, high = curve.domain
    start, end = low + a * (high - low), low + b * (high - low)
    part = curve.trimmed(start, end)
    shares = np.linspace(0, 1, 9)
    at = part.domain[0] + shares * (part.domain[1] - part.domain[0])
    same = curve.point(start + shares * (end - start))
    assert np.max(np.abs(part.point(at) - same)) <= 20 * ROUNDING * size(curve)


def stretch_range(curve: Curve, distance: float) -> tuple[float, float]:
    """Least and greatest 1 - kappa d over the domain, dense samples."""
    t = np.linspace(*curve.domain, 4001)
    if distance == 0:
        return 1.0, 1.0
    stretch = 1 - distance * curve.curvature(t)
    return float(stretch.min()), float(stretch.max())


def check_offset_distance(curve: Curve, distance: float) -> None:
    """A parallel curve: every point ``distance`` along the left normal of its foot, tangents alike."""
    moved = curve.offset(distance)
    t = parameters(curve, 33)
    at = moved.domain[0] + (t - curve.domain[0]) * (
        (moved.domain[1] - moved.domain[0]) / (curve.domain[1] - curve.domain[0])
    )
    left = curve.point(t) + 1j * distance * curve.tangent(t)
    assert np.max(np.abs(moved.point(at) - left)) <= 40 * ROUNDING * (size(curve) + abs(distance))
    inner = slice(1, -1)
    assert np.max(np.abs(moved.tangent(at[inner]) - curve.tangent(t[inner]))) <= 1e-9


def check_offset_adds(curve: Curve, first: float, second: float) -> None:
    """offset(a).offset(b) = offset(a + b) as point sets with one parametrisation."""
    twice, once = curve.offset(first).offset(second), curve.offset(first + second)
    a, b = parameters(twice, 17), parameters(once, 17)
    allowed = 40 * ROUNDING * (size(curve) + abs(first) + abs(second))
    assert np.max(np.abs(twice.point(a) - once.point(b))) <= allowed


def check_cusp(curve: Curve, distance: float) -> None:
    """CuspError exactly where 1 - kappa d stops being positive, naming the parameter where it does."""
    least, greatest = stretch_range(curve, distance)
    if least > 1e-9:
        check_offset_distance(curve, distance)
        return
    if least > -1e-9:
        return  # tangent to the limit within rounding: either answer is right
    error = refusal(lambda: curve.offset(distance))
    assert isinstance(error, CuspError), f"{curve} offset by {distance} turned back unseen: 1 - kappa d = {least}"
    if greatest <= 0:
        return  # turned back everywhere: there is no change of sign to name
    low, high = curve.domain
    assert low <= error.t <= high, "the named parameter is not one of this curve"
    assert error.distance == distance
    step = (high - low) / 256
    around = np.clip(np.array([error.t - 1.01 * step, error.t, error.t + 1.01 * step]), low, high)
    values = 1 - distance * curve.curvature(around)
    assert values.min() <= 1e-9, "the named parameter is not where the offset turns back"
    # where the offset runs backwards from an end on, that end is named; a reversed curve has it last
    assert values.max() >= -1e-9 or error.t in (low, high)

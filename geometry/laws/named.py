"""The laws that have names. Peak coefficients in closed form: tests/geometry/laws/test_named.py holds them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from geometry.base.errors import Nearest, ParameterError
from geometry.laws.diagram import (
    LEAST_STRETCH,
    half_cosine,
    law_of_diagram,
    linear,
    quarter_cosine,
    quarter_sine,
    refuse_narrow,
    trapezoid,
)
from geometry.laws.diagram import constant as level
from geometry.laws.law import Law
from geometry.laws.piece import LawPiece, Wave
from geometry.laws.splines import hermite_coefficients

_MOST_DEGREE = 31
_USUAL_RAMP = Nearest(0.125)
_SCCA = "sine-constant-cosine acceleration"
# shares that are none but for rounding
_ROUNDING = 1e-12


def constant_velocity() -> Law:
    """s = u: rigid impacts at both ends, unless its neighbours move with the same velocity."""
    return Law("constant velocity", (LawPiece(0.0, 1.0, (0.0, 1.0)),))


def constant_acceleration() -> Law:
    """Parabolas; acceleration +-4."""
    return law_of_diagram("constant acceleration", [level(0.5, 1.0), level(0.5, -1.0)])


def linearly_decreasing() -> Law:
    """s = 3 u^2 - 2 u^3, acceleration 6 (1 - 2u): table 2.2 of the coursework guidelines."""
    return Law("linearly decreasing acceleration", (LawPiece(0.0, 1.0, (0.0, 0.0, 1.0, 1.0)),))


def cosine() -> Law:
    """Simple harmonic: s = (1 - cos(pi u))/2."""
    return Law("cosine acceleration", (LawPiece(0.0, 1.0, (0.5,), (Wave(-0.5, math.pi, math.pi / 2),)),))


def sine() -> Law:
    """Cycloidal, the inclined sine of VDI 2143 (Bestehorn): s = u - sin(2 pi u)/(2 pi)."""
    wave = Wave(-1 / (2 * math.pi), 2 * math.pi, 0.0)
    return Law("sine acceleration", (LawPiece(0.0, 1.0, (0.0, 1.0), (wave,)),))


def trapezoidal(ramp: float = 0.125) -> Law:
    """Straight ramps of the share ``ramp`` of the phase, four of them.

    Raises
    ------
    ParameterError
        ``ramp`` neither 0 (constant acceleration) nor 0.25 (triangle), nor between them by ``LEAST_STRETCH``.
    """
    if ramp not in (0, 0.25):
        _check_ramp(ramp, 0.25)
    name = "trapezoidal acceleration"
    return law_of_diagram(name, [*trapezoid(0.5, 1.0, 2 * ramp), *trapezoid(0.5, -1.0, 2 * ramp)])


def triangle() -> Law:
    """Isosceles triangles up and down: peak acceleration 8."""
    stretches = [linear(0.25, 0, 1), linear(0.5, 1, -1), linear(0.25, -1, 0)]
    return law_of_diagram("triangular acceleration", stretches)


def modified_trapezoid(ramp: float = 0.125) -> Law:
    """Quarter sines of the share ``ramp`` in place of the straight ramps.

    Raises
    ------
    ParameterError
        ``ramp`` not above 0 and below 0.25.
    """
    _check_ramp(ramp, 0.25)
    return sine_constant_cosine(2 * ramp, 1 - 4 * ramp, 2 * ramp, name="modified trapezoid")


def modified_sine(ramp: float = 0.125) -> Law:
    """A quarter sine up in the share ``ramp``, a slow half cosine down, a quarter sine up.

    Raises
    ------
    ParameterError
        ``ramp`` not above 0 and below 0.5 (there it has no slow part).
    """
    _check_ramp(ramp, 0.5)
    return sine_constant_cosine(2 * ramp, 0.0, 1 - 2 * ramp, name="modified sine")


def modified_sine_cv(share: float) -> Law:
    """The modified sine with this share of the phase at constant velocity in its middle (MSC, MCV).

    Raises
    ------
    ParameterError
        ``share`` not from 0 to below 1.
    """
    moved = (1 - share) / 4
    return sine_constant_cosine(moved, 0.0, 3 * moved, name=f"modified sine CV {100 * share:.0f}")


def sine_constant_cosine(sine: float, constant: float, cosine: float, *, name: str = _SCCA) -> Law:
    """The SCCA family: shares of the phase, half of each up and half of it down; the rest is at constant velocity.

    A quarter sine up, a level, a quarter cosine down, none, and the same mirrored: R. L. Norton, Cam Design and
    Manufacturing Handbook, 3.

    Raises
    ------
    ParameterError
        Shares below 0, all of them 0, or more than the phase together.
    """
    shares = [sine, constant, cosine]
    rest = 1 - sine - constant - cosine
    if not min(shares) >= 0 or not sum(shares) > 0 or not rest >= -_ROUNDING:
        raise ParameterError("sine_constant_cosine", shares, "shares_not_of_phase")
    up = [(sine / 2, quarter_sine(sine / 2, 1)), (constant / 2, level(constant / 2, 1))]
    if rest > _ROUNDING:
        down = quarter_sine(cosine / 2, -1)
        middle = [(cosine / 2, quarter_cosine(cosine / 2, 1)), (rest, level(rest, 0)), (cosine / 2, down)]
    else:
        middle = [(cosine, half_cosine(cosine, 1, -1))]
    end = [(constant / 2, level(constant / 2, -1)), (sine / 2, quarter_cosine(sine / 2, -1))]
    stretches = [stretch for share, stretch in (*up, *middle, *end) if share > _ROUNDING]
    refuse_narrow("sine_constant_cosine", shares, stretches)
    return law_of_diagram(name, stretches)


def polynomial_345() -> Law:
    """s = 10 u^3 - 15 u^4 + 6 u^5."""
    return Law("3-4-5 polynomial", (LawPiece(0.0, 1.0, (0.0,) * 3 + (1.0,) * 3),))


def polynomial_4567() -> Law:
    """s = 35 u^4 - 84 u^5 + 70 u^6 - 20 u^7."""
    return Law("4-5-6-7 polynomial", (LawPiece(0.0, 1.0, (0.0,) * 4 + (1.0,) * 4),))


def gutman_13() -> Law:
    """First and third harmonic: s = u - 15/(32 pi) sin(2 pi u) - 1/(96 pi) sin(6 pi u); Gutman."""
    waves = (Wave(-15 / (32 * math.pi), 2 * math.pi, 0.0), Wave(-1 / (96 * math.pi), 6 * math.pi, 0.0))
    return Law("Gutman 1-3", (LawPiece(0.0, 1.0, (0.0, 1.0), waves),))


def double_harmonic() -> Law:
    """s = (1 - cos(pi u))/2 - (1 - cos(2 pi u))/8: from a dwell, with acceleration -pi^2 into a return at once.

    H. A. Rothbart, Cams, 2; R. L. Norton, Cam Design and Manufacturing Handbook, 3.
    """
    waves = (Wave(-0.5, math.pi, math.pi / 2), Wave(1 / 8, 2 * math.pi, math.pi / 2))
    return Law("double harmonic", (LawPiece(0.0, 1.0, (3 / 8,), waves),))


def half_cycloidal() -> Law:
    """s = u - sin(pi u)/pi: from rest to velocity 2 without acceleration there; Rothbart's C-1, reversed C-2."""
    return Law("half cycloidal", (LawPiece(0.0, 1.0, (0.0, 1.0), (Wave(-1 / math.pi, math.pi, 0.0),)),))


def half_harmonic() -> Law:
    """s = 1 - cos(pi u/2): from rest to velocity pi/2 without acceleration there; Rothbart's H-1, reversed H-2."""
    return Law("half harmonic", (LawPiece(0.0, 1.0, (1.0,), (Wave(-1.0, math.pi / 2, math.pi / 2),)),))


def polynomial_law(conditions: Sequence[tuple[float, int, float]]) -> Law:
    """The polynomial that meets conditions (u, order of derivative, value), s(0) = 0 and s(1) = 1 among them.

    Conditions at the ends fix the Bernstein coefficients one by one; those inside solve a small system for the rest.

    Raises
    ------
    ParameterError
        s(0) = 0 or s(1) = 1 is missing, a condition outside the phase, twice, or with an order left out at an end,
        degree above 31, or conditions that contradict each other.
    """
    given = {(u, order): value for u, order, value in conditions}
    told = [list(condition) for condition in conditions]
    if len(given) != len(conditions) or not all(0 <= u <= 1 and order >= 0 for u, order in given):
        raise ParameterError("conditions", told, "condition_twice_or_outside")
    if given.get((0.0, 0)) != 0 or given.get((1.0, 0)) != 1:
        raise ParameterError("conditions", told, "conditions_without_ends")
    n = len(given) - 1
    if n > _MOST_DEGREE:
        raise ParameterError("conditions", told, "too_many_conditions", most=_MOST_DEGREE + 1)
    ends = [sorted(order for u, order in given if u == end) for end in (0.0, 1.0)]
    for end, orders in zip((0, 1), ends, strict=True):
        if orders != list(range(len(orders))):
            raise ParameterError("conditions", told, "orders_with_gap", end=end)
    left, right = ([given[end, k] for k in orders] for end, orders in zip((0.0, 1.0), ends, strict=True))
    inner = [(u, order, value) for (u, order), value in given.items() if 0 < u < 1]
    values = _with_inner(left, right, inner, n) if inner else hermite_coefficients(left, right, 1.0)
    return Law(f"polynomial of degree {n}", (LawPiece(0.0, 1.0, values),))


def _with_inner(
    left: list[float], right: list[float], inner: list[tuple[float, int, float]], degree: int
) -> tuple[float, ...]:
    """Bernstein coefficients from the ends and from conditions inside."""
    # the ends' coefficients come from a polynomial of the full degree with zeros in between
    zeros = [0.0] * (degree + 1)
    known = list(zeros)
    first = hermite_coefficients(left, [0.0] * (degree + 1 - len(left)), 1.0)[: len(left)]
    last = hermite_coefficients([0.0] * (degree + 1 - len(right)), right, 1.0)[degree + 1 - len(right) :]
    known[: len(left)], known[degree + 1 - len(right) :] = first, last
    free = range(len(left), degree + 1 - len(right))

    def effect(values: Sequence[float]) -> list[float]:
        piece = LawPiece(0.0, 1.0, tuple(values))
        return [float(piece.value(u, order)) for u, order, _ in inner]

    matrix = np.array([effect([float(k == i) for i in range(degree + 1)]) for k in free]).T
    missing = np.array([value for _, _, value in inner]) - effect(known)
    solved, _, rank, _ = np.linalg.lstsq(matrix, missing, rcond=1e-13)
    if rank < len(inner) or not np.allclose(matrix @ solved, missing, atol=1e-9):
        raise ParameterError("conditions", [list(c) for c in inner], "conditions_contradict")
    for k, value in zip(free, solved.tolist(), strict=True):
        known[k] = value
    return tuple(known)


def _check_ramp(ramp: float, most: float) -> None:
    """Refuse ramps that are too narrow, or leave too little between them."""
    high = most - LEAST_STRETCH / 2
    if not LEAST_STRETCH < ramp < high:
        raise ParameterError("ramp", ramp, "not_within", _USUAL_RAMP, low=LEAST_STRETCH, high=high)


# names as scenes and calculations type them
NAMED_LAWS: dict[str, Callable[[], Law]] = {
    "constant_velocity": constant_velocity,
    "constant_acceleration": constant_acceleration,
    "linearly_decreasing": linearly_decreasing,
    "cosine": cosine,
    "sine": sine,
    "trapezoid": trapezoidal,
    "triangle": triangle,
    "modified_trapezoid": modified_trapezoid,
    "modified_sine": modified_sine,
    "modified_sine_cv20": partial(modified_sine_cv, 0.2),
    "modified_sine_cv33": partial(modified_sine_cv, 1 / 3),
    "modified_sine_cv50": partial(modified_sine_cv, 0.5),
    "polynomial_345": polynomial_345,
    "polynomial_4567": polynomial_4567,
    "gutman_13": gutman_13,
    "double_harmonic": double_harmonic,
    "half_cycloidal": half_cycloidal,
    "half_harmonic": half_harmonic,
}

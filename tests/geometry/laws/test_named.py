"""Named laws: closed-form peaks, ends, joints, and derivatives against 50-digit differentiation of the definitions."""

from __future__ import annotations

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import ParameterError
from geometry.laws.law import Law
from geometry.laws.named import (
    NAMED_LAWS,
    modified_sine,
    modified_trapezoid,
    polynomial_345,
    polynomial_4567,
    polynomial_law,
    sine_constant_cosine,
    trapezoidal,
)
from geometry.laws.piece import LawPiece, Wave
from tests.sampling import examples

MP: Any = mpmath.mp.clone()
MP.dps = 50
PI = math.pi


def of_modified_sine(ramp: float) -> tuple[float, float, float]:
    """Ramps of this share and falls of three of them: C_a as machine builders' libraries print it, areas, slope."""
    peak = PI**2 / (8 * ramp * ((8 - 6 * PI) * ramp + PI))
    return 8 * ramp / PI * peak, peak, PI / (2 * ramp) * peak


# peak velocity, acceleration and finite jerk of unit laws: closed forms, checked by hand against the diagrams
PEAKS: dict[str, tuple[float, float, float]] = {
    "constant_acceleration": (2, 4, 0),
    "linearly_decreasing": (3 / 2, 6, 12),
    "cosine": (PI / 2, PI**2 / 2, PI**3 / 2),
    "sine": (2, 2 * PI, 4 * PI**2),
    "trapezoid": (2, 16 / 3, 128 / 3),
    "triangle": (2, 8, 32),
    "modified_trapezoid": (2, 8 * PI / (PI + 2), 32 * PI**2 / (PI + 2)),
    "modified_sine": (4 * PI / (PI + 4), 4 * PI**2 / (PI + 4), 16 * PI**3 / (PI + 4)),
    "polynomial_345": (15 / 8, 10 / math.sqrt(3), 60),
    "polynomial_4567": (35 / 16, 84 * math.sqrt(5) / 25, 105 / 2),
    "gutman_13": (2, 2 * PI * math.sqrt(2 / 3), 6 * PI**2),
    # of the last the greatest jerk stands where 8 c^2 - c = 4, c the cosine of pi u
    "double_harmonic": (
        3 * math.sqrt(3) * PI / 8,
        PI**2,
        PI**3 / 2 * math.sqrt(1 - ((math.sqrt(129) - 1) / 16) ** 2) * (1 + (math.sqrt(129) - 1) / 4),
    ),
    "half_cycloidal": (2, PI, PI**2),
    "half_harmonic": (PI / 2, PI**2 / 4, PI**3 / 8),
    **{f"modified_sine_cv{round(100 * share)}": of_modified_sine((1 - share) / 8) for share in (0.2, 1 / 3, 0.5)},
}
# continuity of each law with a dwell on both sides: the highest derivative that does not jump
CONTINUITY = {
    "constant_velocity": 0, "constant_acceleration": 1, "linearly_decreasing": 1, "cosine": 1, "sine": 2,
    "trapezoid": 2, "triangle": 2, "modified_trapezoid": 2, "modified_sine": 2, "polynomial_345": 2,
    "modified_sine_cv20": 2, "modified_sine_cv33": 2, "modified_sine_cv50": 2,
    "polynomial_4567": 3, "gutman_13": 2,
    "double_harmonic": 1, "half_cycloidal": 0, "half_harmonic": 0,
}  # fmt: skip


def test_every_named_law_is_held_against_its_closed_form() -> None:
    assert set(PEAKS) == set(NAMED_LAWS) - {"constant_velocity"}


@pytest.mark.parametrize("name", PEAKS)
def test_peaks_equal_the_closed_forms(name: str) -> None:
    law = NAMED_LAWS[name]()
    for order, expected in enumerate(PEAKS[name], 1):
        found, at = law.peak(order)
        assert found == pytest.approx(expected, rel=1e-12, abs=1e-12)
        assert 0 <= at <= 1


# C_v, C_a as printed: the first three are Norton's, the others MechDesigner's (its segment parameters of SCCA);
# the last digit is cut off here and rounded there
PRINTED = {
    "modified_trapezoid": (2.0, 4.888),
    "modified_sine": (1.760, 5.528),
    "sine": (2.0, 6.283),
    "modified_sine_cv20": (1.528, 5.999),
    "modified_sine_cv33": (1.404, 6.616),
}
SCCA: dict[str, tuple[Any, Any, Any]] = {
    "modified_trapezoid": ("1/4", "1/2", "1/4"),
    "modified_sine": ("1/4", 0, "3/4"),
    "sine": ("1/2", 0, "1/2"),
    "cosine": (0, 0, 1),
    "constant_acceleration": (0, 1, 0),
    "modified_sine_cv20": ("1/5", 0, "3/5"),
    "modified_sine_cv33": ("1/6", 0, "1/2"),
    "modified_sine_cv50": ("1/8", 0, "3/8"),
}


@pytest.mark.parametrize("name", PRINTED)
def test_coefficients_as_printed(name: str) -> None:
    assert [NAMED_LAWS[name]().peak(order)[0] for order in (1, 2)] == pytest.approx(PRINTED[name], abs=1e-3)


# C_j as printed (Norton's table of cam functions); a law whose acceleration jumps has none
JERKS = {
    "sine": 39.5,
    "polynomial_345": 60.0,
    "polynomial_4567": 52.5,
    "modified_sine": 69.5,
    "modified_trapezoid": 61.4,
}


@pytest.mark.parametrize("name", [*JERKS, "cosine", "constant_acceleration", "constant_velocity", "double_harmonic"])
def test_jerks_as_printed(name: str) -> None:
    assert NAMED_LAWS[name]().jerk() == pytest.approx(JERKS.get(name, np.inf), abs=0.05)


def scca_oracle(a: Any, b: Any, c: Any, u: Any) -> tuple[Any, Any, Any]:
    """s, s', s'' at u by quadrature of the acceleration of shares a, b, c, scaled to the lift."""
    ends = [a / 2, (a + b) / 2, (a + b + c) / 2]
    cuts = sorted({MP.mpf(0), *ends, *(1 - x for x in ends), MP.mpf("0.5"), MP.mpf(1)})

    def bend(x: Any) -> Any:
        if x > 0.5:
            return -bend(1 - x)
        if x < ends[0]:
            return MP.sin(MP.pi * x / a)
        return 1 if x < ends[1] else MP.cos(MP.pi * (x - ends[1]) / c) if x < ends[2] else MP.mpf(0)

    def until(end: Any, weight: Callable[[Any], Any]) -> Any:
        return MP.quad(lambda x: weight(x) * bend(x), [x for x in cuts if x < end] + [end])

    lift = until(MP.mpf(1), lambda x: 1 - x)
    return until(u, lambda x: u - x) / lift, until(u, lambda x: 1) / lift, bend(u) / lift


@pytest.mark.sampled(1)
@pytest.mark.parametrize("shares", [*SCCA.values(), ("3/10", "1/5", "1/10"), (0, "1/5", "1/5"), ("1/5", "1/5", 0)])
def test_sine_constant_cosine_is_its_integrated_acceleration(shares: tuple[Any, Any, Any]) -> None:
    a, b, c = (MP.mpf(Fraction(x).numerator) / Fraction(x).denominator for x in shares)
    laws = [sine_constant_cosine(float(a), float(b), float(c))]
    laws += [NAMED_LAWS[name]() for name, own in SCCA.items() if own == shares]
    with MP.workdps(20):
        for u in (0.03, 0.21, 0.47, 0.62, 0.98):
            expected = [float(x) for x in scca_oracle(a, b, c, MP.mpf(u))]
            for law in laws:
                assert [float(law.value(u, k)) for k in range(3)] == pytest.approx(expected, rel=1e-13, abs=1e-14)


@pytest.mark.parametrize("shares", [(0, 0, 0), (-0.1, 0.5, 0.5), (0.5, 0.5, 0.5), (math.nan, 0, 0.5)])
def test_shares_that_are_none_are_refused(shares: tuple[float, float, float]) -> None:
    with pytest.raises(ParameterError):
        sine_constant_cosine(*shares)


def test_jerk_of_the_modified_sine_at_its_crossover() -> None:
    # MechDesigner prints -23.15; closed form (4 pi / 3) C_a
    assert modified_sine().value(0.5, 3) == pytest.approx(-16 * PI**3 / (3 * (PI + 4)), rel=1e-12)


@pytest.mark.parametrize("name", NAMED_LAWS)
def test_ends_and_joints(name: str) -> None:
    law = NAMED_LAWS[name]()
    assert float(law.value(0.0)) == 0
    assert float(law.value(1.0)) == pytest.approx(1, abs=1e-15)
    orders = CONTINUITY[name]
    for order in range(1, orders + 1):
        scale = law.peak(order)[0]
        assert abs(float(law.value(0.0, order))) <= 1e-13 * scale
        assert abs(float(law.value(1.0, order))) <= 1e-13 * scale
        for before, after in zip(law.pieces, law.pieces[1:], strict=False):
            assert before.end == after.start
            assert float(before.value(before.end, order)) == pytest.approx(
                float(after.value(after.start, order)), abs=1e-12 * scale
            )
    for order in (0, 1):
        for before, after in zip(law.pieces, law.pieces[1:], strict=False):
            assert float(before.value(before.end, order)) == pytest.approx(
                float(after.value(after.start, order)), abs=4e-15
            )
    # the next derivative does jump at the ends: the class is not understated
    jump = max(abs(float(law.value(end, orders + 1))) for end in (0.0, 1.0))
    assert jump > 0.1


DEFINITIONS: dict[str, Callable[[Any], Any]] = {
    "linearly_decreasing": lambda u: 3 * u**2 - 2 * u**3,
    "cosine": lambda u: (1 - MP.cos(MP.pi * u)) / 2,
    "sine": lambda u: u - MP.sin(2 * MP.pi * u) / (2 * MP.pi),
    "polynomial_345": lambda u: 10 * u**3 - 15 * u**4 + 6 * u**5,
    "polynomial_4567": lambda u: 35 * u**4 - 84 * u**5 + 70 * u**6 - 20 * u**7,
    "double_harmonic": lambda u: (1 - MP.cos(MP.pi * u) - (1 - MP.cos(2 * MP.pi * u)) / 4) / 2,
    "half_cycloidal": lambda u: u - MP.sin(MP.pi * u) / MP.pi,
    "half_harmonic": lambda u: 1 - MP.cos(MP.pi * u / 2),
    "gutman_13": lambda u: u - 15 * MP.sin(2 * MP.pi * u) / (32 * MP.pi) - MP.sin(6 * MP.pi * u) / (96 * MP.pi),
}


@pytest.mark.sampled(3)
@pytest.mark.parametrize("name", DEFINITIONS)
def test_values_and_derivatives_of_smooth_laws(name: str) -> None:
    law = NAMED_LAWS[name]()
    for u in (0.0, 0.03, 0.31, 0.5, 0.77, 1.0):
        for order in range(6):
            expected = MP.diff(DEFINITIONS[name], MP.mpf(u), order) if order else DEFINITIONS[name](MP.mpf(u))
            scale = max(1.0, law.peak(order)[0])
            assert float(law.value(u, order)) == pytest.approx(float(expected), abs=2e-14 * scale)


@pytest.mark.parametrize("law", [trapezoidal(), modified_trapezoid(), modified_sine(), NAMED_LAWS["triangle"]()])
def test_diagram_laws_integrate_their_own_acceleration(law: Law) -> None:
    """Velocity and displacement by Gauss quadrature of the acceleration, piece by piece."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    s, v = 0.0, 0.0
    for piece in law.pieces:
        for a, b in ((piece.start, (piece.start + piece.end) / 2), ((piece.start + piece.end) / 2, piece.end)):
            u = (a + b) / 2 + (b - a) / 2 * nodes
            acceleration = law.value(u, 2) * weights * (b - a) / 2
            s += v * (b - a) + float(np.sum(acceleration * (b - u)))
            v += float(np.sum(acceleration))
            below = np.nextafter(b, a)
            assert float(law.value(below)) == pytest.approx(s, abs=1e-14)
            assert float(law.value(below, 1)) == pytest.approx(v, abs=1e-13)
    assert s == pytest.approx(1, abs=1e-14)
    assert v == pytest.approx(0, abs=1e-13)


def test_polynomials_from_boundary_conditions() -> None:
    rest = [(0.0, 0, 0.0), (0.0, 1, 0.0), (0.0, 2, 0.0), (1.0, 0, 1.0), (1.0, 1, 0.0), (1.0, 2, 0.0)]
    u = np.linspace(0, 1, 101)
    assert np.allclose(polynomial_law(rest).value(u), polynomial_345().value(u), atol=1e-15)
    more = [*rest, (0.0, 3, 0.0), (1.0, 3, 0.0)]
    assert np.allclose(polynomial_law(more).value(u), polynomial_4567().value(u), atol=1e-15)
    through = polynomial_law([*rest, (0.5, 0, 0.35), (0.5, 1, 1.9)])
    assert float(through.value(0.5)) == pytest.approx(0.35, abs=1e-14)
    assert float(through.value(0.5, 1)) == pytest.approx(1.9, abs=1e-13)
    for order in (1, 2):
        assert abs(float(through.value(0.0, order))) <= 1e-13
        assert abs(float(through.value(1.0, order))) <= 1e-12


def test_high_degree_is_exact_to_rounding() -> None:
    """Degree 31: powers of u would lose 11 digits; the oracle is the regularised beta function at 50 digits."""
    law = polynomial_law([(0.0, k, 0.0) for k in range(16)] + [(1.0, k, float(k == 0)) for k in range(16)])
    for u in (0.1, 0.5, 0.93, 0.999):
        assert float(law.value(u)) == pytest.approx(float(MP.betainc(16, 16, 0, u, regularized=True)), abs=1e-15)


@pytest.mark.parametrize("conditions", [
    [(0.0, 0, 0.0)],
    [(0.0, 0, 0.0), (1.0, 0, 2.0)],
    [(0.0, 0, 0.0), (1.0, 0, 1.0), (1.0, 0, 1.0)],
    [(0.0, 0, 0.0), (0.0, 2, 0.0), (1.0, 0, 1.0)],
    [(0.0, 0, 0.0), (1.0, 0, 1.0), (1.5, 0, 1.0)],
    [(0.0, k, 0.0) for k in range(20)] + [(1.0, k, float(k == 0)) for k in range(20)],
])  # fmt: skip
def test_bad_boundary_conditions_are_refused(conditions: list[tuple[float, int, float]]) -> None:
    with pytest.raises(ParameterError):
        polynomial_law(conditions)


@pytest.mark.parametrize("make", [
    lambda: trapezoidal(0.3), lambda: modified_trapezoid(0.25), lambda: modified_sine(0.5),
    lambda: trapezoidal(-0.01), lambda: modified_sine(0.0), lambda: modified_sine(1e-10),
    lambda: modified_trapezoid(3e-4),
])  # fmt: skip
def test_ramps_beyond_their_range_are_refused(make: Callable[[], Law]) -> None:
    with pytest.raises(ParameterError):
        make()


@pytest.mark.parametrize("ramp", [0.01, 0.125, 0.2, 0.249])
def test_any_ramp_closes(ramp: float) -> None:
    for law in (trapezoidal(ramp), modified_trapezoid(ramp), modified_sine(ramp)):
        assert float(law.value(1.0)) == pytest.approx(1, abs=1e-14)
        assert float(law.value(1.0, 1)) == pytest.approx(0, abs=1e-13)


pieces = st.builds(
    LawPiece,
    st.floats(-3, 3),
    st.floats(3.1, 9),
    st.lists(st.floats(-5, 5), min_size=1, max_size=8).map(tuple),
    st.lists(st.builds(Wave, st.floats(-3, 3), st.floats(0.1, 20), st.floats(-4, 4)), max_size=2).map(tuple),
)


@examples(60)
@given(pieces, st.floats(0, 0.9), st.floats(0.01, 1))
def test_bounds_are_never_below_and_not_far_above(piece: LawPiece, at: float, share: float) -> None:
    width = piece.end - piece.start
    low = piece.start + at * width
    high = low + share * (piece.end - low)
    t = np.linspace(low, high, 301)
    bounds = piece.bounds(5, np.array([low]), np.array([high]))
    for order, bound in enumerate(bounds):
        assert np.abs(piece.value(t, order)).max() <= bound[0] * (1 + 1e-12) + 1e-300


@examples(40)
@given(pieces)
def test_time_reversal_and_placing(piece: LawPiece) -> None:
    t = np.linspace(piece.start, piece.end, 33)
    scale = sum(map(abs, piece.coefficients)) + sum(abs(w.amplitude) for w in piece.waves) + 1e-300
    back = piece.reversed_in_time()
    assert np.allclose(back.value(piece.start + piece.end - t), piece.value(t), atol=1e-12 * scale)
    moved = piece.placed(2.0, 0.5, 3.0, -2.0)
    assert np.allclose(moved.value(2 + 0.5 * t), 3 - 2 * piece.value(t), atol=1e-12 * (scale + 3))
    assert np.allclose(
        moved.value(2 + 0.5 * t, 2), -8 * piece.value(t, 2), atol=1e-10 * (1 + np.abs(8 * piece.value(t, 2)).max())
    )


def test_a_reversed_law_is_upside_down() -> None:
    law = polynomial_law([(0.0, 0, 0.0), (0.0, 1, 0.0), (1.0, 0, 1.0)])
    u = np.linspace(0, 1, 33)
    assert np.allclose(law.reversed_in_time().value(u), 1 - law.value(1 - u), atol=1e-15)


def test_what_is_shared_cannot_be_changed_by_one_of_its_users() -> None:
    """Extremes are told once for all who ask."""
    piece = polynomial_345().pieces[0]
    found = piece.extremes(1)
    assert piece.extremes(1) is found
    with pytest.raises(ValueError, match="read-only"):
        found[0] = 1.0
    assert found == pytest.approx([0.0, 0.5, 1.0], abs=1e-9)
    # s'' of 3-4-5 is greatest where 1 - 6 u + 6 u^2 = 0
    inner = [(1 - 1 / math.sqrt(3)) / 2, (1 + 1 / math.sqrt(3)) / 2]
    assert piece.extremes(2) == pytest.approx([0.0, *inner, 1.0], abs=1e-9)

"""Acceleration diagrams: any segments, closed integrals, closing conditions, asymmetric halves, tables, B-splines."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import ParameterError
from geometry.laws.diagram import (
    Stretch,
    constant,
    half_cosine,
    half_sine,
    law_of_diagram,
    law_of_halves,
    linear,
    polynomial,
    quarter_cosine,
    quarter_sine,
    sine,
    tabulated,
    trapezoid,
)
from geometry.laws.law import Law
from geometry.laws.named import NAMED_LAWS
from geometry.laws.splines import bspline_law, cubic_pieces
from tests.sampling import examples

CASES = {c["id"]: c for c in json.loads((Path(__file__).parents[2] / "published" / "cams.json").read_text())["cases"]}
U = np.linspace(0, 1, 257)


def integrated(law: Law, samples: int = 8001) -> tuple[float, float]:
    """Velocity and displacement at the end, by the midpoint rule on the acceleration alone."""
    u = (np.arange(samples) + 0.5) / samples
    a = law.value(u, 2)
    return float(a.sum() / samples), float((a * (1 - u)).sum() / samples)


def test_segments_make_the_named_laws() -> None:
    made = {
        "sine": [half_sine(0.5, 3), half_sine(0.5, -3)],
        "cosine": [half_cosine(1, 1, -1)],
        "linearly_decreasing": [linear(2, 5, -5)],
        "constant_acceleration": [constant(1, 1), constant(1, -1)],
        "triangle": [*trapezoid(1, 2, 0.5), *trapezoid(1, -2, 0.5)],
        "polynomial_345": [polynomial(1, [0, 60, -180, 120])],
        "modified_sine": [quarter_sine(1, 1), half_cosine(6, 1, -1), quarter_cosine(1, -1)],
    }
    for name, stretches in made.items():
        assert np.allclose(law_of_diagram(name, stretches).value(U), NAMED_LAWS[name]().value(U), atol=1e-14)
    whole = law_of_diagram("sine", [sine(1, 1, 0, 2 * math.pi)])
    assert np.allclose(whole.value(U), NAMED_LAWS["sine"]().value(U), atol=1e-14)


segments = st.one_of(
    st.builds(constant, st.floats(0.1, 3), st.floats(0.1, 5)),
    st.builds(linear, st.floats(0.1, 3), st.floats(0, 5), st.floats(0.1, 5)),
    st.builds(half_sine, st.floats(0.1, 3), st.floats(0.1, 5)),
    st.builds(quarter_sine, st.floats(0.1, 3), st.floats(0.1, 5)),
    st.builds(quarter_cosine, st.floats(0.1, 3), st.floats(0.1, 5)),
    st.builds(half_cosine, st.floats(0.1, 3), st.floats(0, 5), st.floats(0.1, 5)),
    st.builds(lambda w, a: polynomial(w, [a, 0, a, 1]), st.floats(0.1, 3), st.floats(0.1, 5)),
)
halves = st.lists(segments, min_size=1, max_size=4)


@examples(30)
@given(halves, halves, st.floats(0.1, 0.9))
def test_asymmetric_halves_close_exactly(first: list[Stretch], second: list[Stretch], share: float) -> None:
    law = law_of_halves("any", first, second, share=share)
    assert float(law.value(1.0)) == pytest.approx(1, abs=1e-13)
    assert abs(float(law.value(1.0, 1))) <= 1e-12
    assert np.all(law.value(np.linspace(0, share, 65)[:-1], 2) >= -1e-9)
    assert np.all(law.value(np.linspace(share, 1, 65)[1:], 2) <= 1e-9)
    v, s = integrated(law)
    peak = law.peak(2)[0]
    assert abs(v) <= 1e-3 * peak
    assert abs(s - 1) <= 1e-3 * peak
    for before, after in zip(law.pieces, law.pieces[1:], strict=False):
        for order, scale in ((0, 1), (1, law.peak(1)[0])):
            left, right = float(before.value(before.end, order)), float(after.value(after.start, order))
            assert left == pytest.approx(right, abs=1e-12 * scale)


@examples(20)
@given(halves, halves, st.floats(0.3, 3))
def test_a_diagram_closes_when_balanced_and_says_how(
    first: list[Stretch], second: list[Stretch], factor: float
) -> None:
    drawn = [*first, *(s.scaled(-factor) for s in second)]
    law = law_of_diagram("any", drawn, balance=True)
    assert float(law.value(1.0)) == pytest.approx(1, abs=1e-13)
    assert abs(float(law.value(1.0, 1))) <= 1e-12
    try:
        law_of_diagram("any", drawn)
    except ParameterError as refusal:
        # the refusal names the factor that closes it
        times = float(str(refusal.numbers["factor"]))
        fixed = [s if index < len(first) else s.scaled(times) for index, s in enumerate(drawn)]
        assert float(law_of_diagram("any", fixed).value(1.0)) == pytest.approx(1, abs=1e-12)


@pytest.mark.parametrize("stretches", [
    [constant(1, 1)],
    [constant(1, 1), constant(1, -1.01)],
    [constant(1, -1), constant(1, 1)],
    [constant(0, 1), constant(1, -1)],
    [constant(1, 0), constant(1, 0)],
    [constant(1, float("nan")), constant(1, -1)],
])  # fmt: skip
def test_diagrams_that_do_not_lift_or_close_are_refused(stretches: list[Stretch]) -> None:
    with pytest.raises(ParameterError):
        law_of_diagram("bad", stretches)


def test_other_refusals() -> None:
    with pytest.raises(ParameterError):
        sine(1, 1, 0, 0.1)
    with pytest.raises(ParameterError):
        trapezoid(1, 1, 0.6, 0.6)
    with pytest.raises(ParameterError):
        law_of_halves("bad", [constant(1, 1)], [constant(1, 1)], share=1.0)
    with pytest.raises(ParameterError):
        law_of_halves("bad", [constant(1, 1), constant(1, -1)], [constant(1, 1)])


def test_a_tabulated_acceleration_is_the_spline_through_its_points() -> None:
    from scipy.interpolate import CubicSpline

    places = np.linspace(0, 1, 15)
    law = law_of_diagram("table", tabulated(1.0, places, np.sin(2 * np.pi * places)))
    assert np.allclose(law.value(U), NAMED_LAWS["sine"]().value(U), atol=2e-4)
    drawn = CubicSpline(places, np.sin(2 * np.pi * places), bc_type="not-a-knot")
    inner = U[5:120]
    ratio = law.value(inner, 2) / drawn(inner)
    assert np.ptp(ratio) <= 1e-10 * ratio[55]


@pytest.mark.parametrize("count", [2, 3, 4, 5, 12])
def test_cubic_pieces_against_scipy(count: int) -> None:
    from scipy.interpolate import CubicSpline

    rng = np.random.default_rng(count)
    x, y = np.cumsum(rng.uniform(0.1, 1, count)), rng.normal(size=count)
    oracle = CubicSpline(x, y, bc_type="not-a-knot")
    for a, b, values in cubic_pieces(x, y, periodic=False):
        middle = (values[0] + 3 * values[1] + 3 * values[2] + values[3]) / 8
        assert middle == pytest.approx(float(oracle((a + b) / 2)), abs=1e-12)
    if count >= 4:
        y[-1] = y[0]
        oracle = CubicSpline(x, y, bc_type="periodic")
        for a, b, values in cubic_pieces(x, y, periodic=True):
            middle = (values[0] + 3 * values[1] + 3 * values[2] + values[3]) / 8
            assert middle == pytest.approx(float(oracle((a + b) / 2)), abs=1e-12)


def test_bspline_law() -> None:
    from scipy.interpolate import BSpline

    poles = [0, 0, 0, 0.2, 0.9, 1, 1, 1]
    law = bspline_law([5 * p for p in poles], degree=5)
    knots = np.concatenate([np.zeros(6), [1 / 3, 2 / 3], np.ones(6)])
    oracle = BSpline(knots, np.array(poles), 5)
    for order in range(4):
        assert np.allclose(law.value(U[:-1], order), oracle.derivative(order)(U[:-1]), atol=1e-11 * 10**order)
    for order in (1, 2):
        assert abs(float(law.value(0.0, order))) + abs(float(law.value(1.0, order))) <= 1e-12
    for bad in (
        {"poles": [0, 1], "degree": 5},
        {"poles": [1, 1, 1, 1], "degree": 3},
        {"poles": [0] * 5 + [1], "degree": 2},
    ):
        with pytest.raises(ParameterError):
            bspline_law(**bad)  # type: ignore[arg-type]
    with pytest.raises(ParameterError):
        bspline_law([0, 0, 0.5, 1, 1], degree=3, knots=[1.2])


@pytest.mark.parametrize("k", range(9))
def test_table_2_2_of_the_guidelines(k: int) -> None:
    """Printed S, S', S'' of the linearly decreasing acceleration, recomputed; misprints differ as noted."""
    case = CASES[f"003.table2_2.k{k}_8"]
    lift, angle = case["inputs"]["H_mm"], math.radians(case["inputs"]["phi_rise_deg"])
    law = NAMED_LAWS["linearly_decreasing"]()
    found = [lift * float(law.value(k / 8, order)) / angle**order for order in range(3)]
    names = ("S_mm", "S1_mm", "S2_mm")
    assert found == pytest.approx([case["recomputed"][n] for n in names], rel=1e-13, abs=1e-13)
    assert found[0] + found[2] == pytest.approx(case["recomputed"]["S_plus_S2_mm"], rel=1e-13)
    for name, value in zip(names, found, strict=True):
        misprinted = (k, name) == (2, "S_mm")
        assert (abs(case["printed"][name] - value) > 6e-4) == misprinted


def test_graphical_integration_is_the_midpoint_rule_of_this_law() -> None:
    """Lesson 4: eight intervals with ordinates in their middles, against the exact integral."""
    case = CASES["000.p4.graphical_integration"]["recomputed"]
    law = NAMED_LAWS["sine"]()
    middles = (np.arange(8) + 0.5) / 8
    drawn = np.concatenate([[0], np.cumsum(law.value(middles, 2) / 8)])
    exact = law.value(np.arange(9) / 8, 1)
    assert np.allclose(drawn, case["S1_at_nodes"], atol=1e-13)
    assert np.allclose(exact, case["S1_exact"], atol=1e-13)


@pytest.mark.parametrize(("degrees", "s", "v", "a"), [
    (5, 0.075117, 0.044658, 0.017453), (10, 0.576689, 0.166667, 0.030230), (15, 1.816901, 0.333333, 0.034907),
    (20, 3.910022, 0.5, 0.030230), (25, 6.741784, 0.622008, 0.017453), (30, 10, 0.666667, 0),
])  # fmt: skip
def test_a_cycloidal_homework_table(degrees: float, s: float, v: float, a: float) -> None:
    """Acceptance A3: 20 mm in 60 degrees; mm, mm/degree, mm/degree^2, printed to six digits."""
    law = NAMED_LAWS["sine"]()
    found = [20 * float(law.value(degrees / 60, order)) / 60**order for order in range(3)]
    assert found == pytest.approx([s, v, a], abs=6e-7)


def refusal_of(*stretches: Stretch) -> ParameterError:
    with pytest.raises(ParameterError) as caught:
        law_of_diagram("bad", stretches)
    return caught.value


def test_a_diagram_that_does_not_close_is_told_in_numbers() -> None:
    """Half of the width above the axis at 1, half below it at 1.01; a part of 1e-8 too much is seen, 1e-11 is not."""
    told = refusal_of(constant(1, 1), constant(1, -1.01))
    assert (told.name, told.value, told.code) == ("diagram", None, "diagram_not_closed")
    assert told.numbers == pytest.approx({"above": 0.5, "below": 0.505, "factor": 1 / 1.01})
    assert refusal_of(constant(1, 1), constant(1, -1 - 1e-8)).code == "diagram_not_closed"
    law_of_diagram("rounded", [constant(1, 1), constant(1, -1 - 1e-11)])


@pytest.mark.parametrize(("stretches", "key", "code"), [
    ([constant(1, 1), constant(1, 2)], "diagram", "diagram_on_one_side"),
    ([constant(1, -1)], "diagram", "diagram_on_one_side"),
    ([constant(1, 0), linear(1, 0, 0)], "diagram", "diagram_on_axis"),
    ([constant(1, -1), constant(1, 1)], "diagram", "diagram_lifts_nothing"),
    ([constant(0, 1), constant(1, -1)], "diagram[1].width", "not_above_zero"),
    ([constant(1, 1), constant(math.inf, -1)], "diagram[2].width", "not_above_zero"),
])  # fmt: skip
def test_a_diagram_is_refused_for_its_own_reason(stretches: list[Stretch], key: str, code: str) -> None:
    told = refusal_of(*stretches)
    assert (told.name, told.code) == (key, code)


def test_limits_of_segments() -> None:
    """Spans of a sine from pi/8 on, ramps that meet; what is beyond names its own key."""
    assert sine(1, 1, 0, math.pi / 8).waves
    with pytest.raises(ParameterError) as caught:
        sine(1, 1, 0, 0.99 * math.pi / 8)
    assert caught.value.numbers["least"] == pytest.approx(math.pi / 8)
    assert [s.width for s in trapezoid(1, 2, 0.25, 0.75)] == [0.25, 0.75]
    for first, second, label in (([], [constant(1, 1)], "first"), ([constant(1, 1)], [constant(1, 0)], "second")):
        with pytest.raises(ParameterError) as caught:
            law_of_halves("bad", first or [constant(1, 0)], second)
        assert caught.value.name == f"{label}_half"


def test_a_trapezoid_of_unequal_ramps_by_the_areas_of_its_figures() -> None:
    """Up over 1/5 of the width, level, down over 2/5: 3 (1/10 + 2/5 + 1/5); mirrored below, it lifts as it must."""
    figure = trapezoid(2.0, 3.0, 0.2, 0.4)
    assert [s.width for s in figure] == pytest.approx([0.4, 0.8, 0.8])
    law = law_of_diagram("any", [*figure, constant(2.1, -2.0)])
    # the velocity at the change of sign is the area so far over the lift in the diagram's own units
    own, speed = 0.0, 0.0
    for width, first, last in ((0.4, 0.0, 3.0), (0.8, 3.0, 3.0), (0.8, 3.0, 0.0), (2.1, -2.0, -2.0)):
        own += speed * width + (2 * first + last) * width**2 / 6
        speed += (first + last) / 2 * width
    assert speed == pytest.approx(0, abs=1e-12)
    assert float(law.value(2.0 / 4.1, 1)) == pytest.approx(4.2 * 4.1 / own, rel=1e-12)


def test_a_table_may_begin_anywhere_and_a_law_ends_at_1() -> None:
    places, ordinates = [0.0, 1.0, 2.0, 4.0, 5.0], [1.0, 0.5, 0.0, -0.4, -1.0]
    one, two = (
        law_of_diagram(
            "table", [*tabulated(3.0, [x + start for x in places], ordinates), constant(1, -1)], balance=True
        )
        for start in (0.0, 7.0)
    )
    assert np.allclose(one.value(U, 2), two.value(U, 2), atol=1e-12)
    # six sixths are more than 1 in binary fractions
    sixths = law_of_diagram("sixths", [constant(0.1, 1.0 if k < 3 else -1.0) for k in range(6)])
    assert sixths.pieces[-1].end == 1.0

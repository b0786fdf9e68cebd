"""The two-disk power module: angles of points, drives, paths, and its mechanism by the layer."""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.curves.line_arc import Arc, Line
from geometry.kinematics.mechanism import mobility, turns
from geometry.kinematics.moving import Drive, moving
from geometry.kinematics.two_disk import Orientation, TwoDisk
from geometry.kinematics.two_disk_path import Piece, followed

CASES = json.loads((Path(__file__).parents[2] / "published" / "power_module.json").read_text(encoding="utf-8"))["cases"]
POINTS = [c for c in CASES if c["id"].startswith("004.ik.point")]
THESIS = TwoDisk()
ORIENTATIONS: tuple[Orientation, ...] = ("thesis", "idlers", "cranks")


@pytest.mark.parametrize("case", POINTS, ids=lambda c: c["id"])
def test_published_points(case: dict[str, Any]) -> None:
    given, right = case["inputs"], case["recomputed"]
    table = TwoDisk(arms=(given["L1_mm"], given["L2_mm"]))
    delta, beta = table.inverse(complex(given["x_mm"], given["y_mm"]))
    assert math.degrees(beta) == pytest.approx(right["beta_deg"], abs=1e-9)
    off = math.degrees(float(delta)) - right["delta_deg"]
    assert math.remainder(off, 360) == pytest.approx(0, abs=1e-9)


def scattered(table: TwoDisk, count: int) -> np.ndarray[Any, Any]:
    """Points over the reach, on both rims and at 1e-15 of it from them, and about the centre to 1e-12 mm."""
    rng, (least, most) = np.random.default_rng(16), table.reach
    far = np.sqrt(rng.uniform(least**2, most**2, count))
    fifth = count // 20
    far[:fifth] = most * (1 - 1e-15)
    far[fifth : 2 * fifth] = most
    far[2 * fifth : 3 * fifth] = least
    far[3 * fifth : 4 * fifth] = least + 10.0 ** rng.uniform(-12, 0, fifth)
    far[4 * fifth : 5 * fifth] = most * (1 + 1e-15)
    return far * np.exp(1j * rng.uniform(-math.pi, math.pi, count))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("arms", [(72.0, 72.0), (72.0, 50.0), (50.0, 72.0), (216.0, 72.0)])
@pytest.mark.parametrize("elbow", [1, -1])
def test_there_and_back_over_the_whole_reach(arms: tuple[float, float], elbow: int) -> None:
    table = TwoDisk(arms=arms)
    points = scattered(table, 50_000)
    delta, beta = table.inverse(points, elbow)
    assert np.all(np.sign(beta) * elbow >= 0)
    # by the plain sum of both arms, not by our own forward()
    one = arms[0] * np.exp(1j * (math.pi / 2 - delta))
    there = one - arms[1] * np.exp(1j * (math.pi / 2 - delta + beta))
    assert np.abs(there - points).max() <= 1e-12 * sum(arms)
    assert np.abs(table.forward(delta, beta) - points).max() <= 1e-12 * sum(arms)
    back = table.angles(*table.drives(delta, beta))
    assert np.abs(np.array(back) - np.array((delta, beta))).max() <= 1e-14


@pytest.mark.heavy
def test_a_million_points_and_the_time_they_take() -> None:
    points = scattered(THESIS, 1_000_000)
    inner = points[np.abs(points) < THESIS.reach[1]]
    x, y = inner.real.copy(), inner.imag.copy()

    def bare() -> None:
        q = 2 * 72.0**2 - x * x - y * y
        beta = np.arccos(np.clip(q / (2 * 72.0**2), -1, 1))
        np.arctan2(x, y) - np.arctan2(72 * np.sin(beta), 72 - 72 * np.cos(beta))

    def least(run: Callable[[], object]) -> float:
        taken = []
        for _ in range(5):
            begin = time.perf_counter()
            run()
            taken.append(time.perf_counter() - begin)
        return min(taken)

    assert least(lambda: THESIS.inverse(inner)) <= 3 * least(bare)
    delta, beta = THESIS.inverse(points)
    assert np.abs(THESIS.forward(delta, beta) - points).max() <= 1e-12 * THESIS.reach[1]


def test_near_the_centre_against_forty_digits() -> None:
    point = complex(3e-12, -5e-12)
    delta, beta = THESIS.inverse(point)
    with mpmath.workdps(40):
        x, y, arm = mpmath.mpf(point.real), mpmath.mpf(point.imag), mpmath.mpf(72)
        exact = mpmath.acos(1 - (x * x + y * y) / (2 * arm * arm))
        lean = mpmath.atan2(x, y) - (mpmath.pi - exact) / 2
        assert abs(float(beta) / float(exact) - 1) < 1e-15
        assert abs(float(delta) - float(lean)) < 1e-15


@pytest.mark.parametrize(
    ("arms", "point", "near"),
    [((72.0, 72.0), 100 + 120j, 144.0), ((72.0, 50.0), 3 - 4j, 22.0), ((50.0, 72.0), 0j, 22.0),
     ((72.0, 50.0), -3 + 1j, 22.0)],
)  # fmt: skip
def test_what_is_out_of_reach_names_the_nearest_point(arms: tuple[float, float], point: complex, near: float) -> None:
    table = TwoDisk(arms=arms)
    with pytest.raises(ParameterError) as refused:
        table.inverse(np.array([30 + 40j, point]))
    assert refused.value.code == "out_of_reach"
    assert refused.value.nearest is not None
    found = complex(*refused.value.nearest.value)  # type: ignore[misc]
    # told by six digits, as people type it
    assert found == complex(round(found.real, 6), round(found.imag, 6))
    assert abs(found) == pytest.approx(near, abs=2e-6)
    assert abs(found - point) == pytest.approx(abs(abs(point) - near), abs=2e-6)
    table.inverse(found)


@pytest.mark.parametrize("point", [complex(math.nan, 1), complex(0, math.inf)])
def test_a_point_that_is_no_number_is_refused(point: complex) -> None:
    for points in (point, np.array([30 + 40j, point])):
        with pytest.raises(ParameterError, match="not_finite"):
            TwoDisk().inverse(points)


def test_ratios_of_the_drives() -> None:
    turn = 2 * math.pi
    assert THESIS.drives(turn, 0.0) == (128, 106)
    one, two = THESIS.drives(0.0, turn)
    assert one == 0
    assert two == pytest.approx(-212 / 3, rel=1e-15)
    # the ring held: disk 3 turns by 1.5 delta against disk 2
    assert THESIS.drives(1.0, THESIS.ratio)[1] == pytest.approx(0, abs=1e-15)
    # on the spot at the centre: 90 degrees of disk 2
    assert THESIS.drives(turn / 4, 0.0) == (32, 26.5)


@pytest.mark.parametrize("elbow", [1, -1])
def test_jacobian_rates_and_accelerations_by_differences(elbow: int) -> None:
    delta, beta = (float(x) for x in TwoDisk(arms=(72.0, 50.0)).inverse(60 - 70j, elbow))
    table, step = TwoDisk(arms=(72.0, 50.0)), 1e-6
    both, own = table.jacobian(delta, beta)
    numeric = (table.forward(delta + step, beta) - table.forward(delta - step, beta)) / (2 * step)
    assert abs(both - numeric) < 1e-7
    numeric = (table.forward(delta, beta + step) - table.forward(delta, beta - step)) / (2 * step)
    assert abs(own - numeric) < 1e-7
    rates, second = table.rates(delta, beta, 3 - 4j, 20 + 7j)
    velocity, acceleration = table.motion(delta, beta, rates, second)
    assert abs(velocity - (3 - 4j)) < 1e-12
    assert abs(acceleration - (20 + 7j)) < 1e-11

    def at(t: float) -> complex:
        turned = [x + v * t + a * t * t / 2 for x, v, a in zip((delta, beta), rates, second, strict=True)]
        return complex(table.forward(*turned))

    h = 1e-4
    assert abs((at(h) - at(-h)) / (2 * h) - (3 - 4j)) < 1e-5
    assert abs((at(h) - 2 * at(0) + at(-h)) / h**2 - (20 + 7j)) < 1e-4


def test_at_a_singular_point_no_velocity_is_found() -> None:
    for point in (144j, 0j):
        with pytest.raises(ParameterError, match="singular_point"):
            THESIS.rates(*(float(x) for x in THESIS.inverse(point)), 1 + 0j)


def deviation(table: TwoDisk, path: list[Piece], rows: Any) -> float:
    """How far O3 leaves the path while both drives run evenly from row to row: against the pieces themselves."""
    u = np.linspace(0, 1, 17)
    one, two = table.drives(rows.delta, rows.beta)
    run = [a[:-1, None] + np.diff(a)[:, None] * u for a in (one, two)]
    points = table.forward(*table.angles(*run)).ravel()
    found = np.full(points.shape, np.inf)
    for piece in path:
        if isinstance(piece, Line):
            chord = piece.end - piece.start
            share = np.clip(((points - piece.start) * np.conj(chord)).real / abs(chord) ** 2, 0, 1)
            off = np.abs(points - piece.start - share * chord)
        else:
            off = np.abs(np.abs(points - piece.centre) - piece.radius)
        found = np.minimum(found, off)
    return float(found.max())


SQUARE: list[Piece] = [Line(-60 - 60j, 60 - 60j), Line(60 - 60j, 60 + 60j), Line(60 + 60j, -60 + 60j)]
ABOUT_O1: list[Piece] = [Arc(0j, 90.0, 0.3, 2 * math.pi)]


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    ("path", "jump"),
    [
        ([Line(-50 + 0j, 50 + 0j)], False),
        ([Line(-50 + 1e-7j, 50 + 1e-7j)], False),
        ([Arc(72 + 0j, 72.0, 0.5, 2 * math.pi)], False),
        ([Line(-144 + 0j, 0j), Line(0j, 100j)], True),
        ([Line(0j, 50 + 50j)], False),
        (SQUARE, False),
        (ABOUT_O1, False),
    ],
)
@pytest.mark.parametrize("elbow", [1, -1])
def test_a_path_is_followed_as_near_as_it_says(path: list[Piece], jump: bool, elbow: int) -> None:
    rows = followed(THESIS, path, 0.01, elbow)
    assert rows.error <= 0.01
    assert deviation(THESIS, path, rows) <= rows.error + 1e-9
    assert rows.way[-1] == pytest.approx(sum(abs(p.derivative(0.0)) * p.domain[1] for p in path))
    steps = np.abs(np.diff(rows.delta))
    assert np.abs(np.diff(rows.beta)).max() < 0.1
    assert (steps.max() > 0.1) == jump
    if jump:
        # on the spot, by a right angle with both drives
        at = int(np.argmax(steps))
        assert (rows.beta[at], rows.beta[at + 1]) == (0, 0)
        one, two = (abs(x) for x in THESIS.drives(rows.delta[at + 1] - rows.delta[at], 0.0))
        assert (one, two) == pytest.approx((32, 26.5))


def test_circles_about_the_axes() -> None:
    rows = followed(THESIS, ABOUT_O1, 0.01)
    assert np.ptp(rows.beta) < 1e-14
    one, two = THESIS.drives(rows.delta, rows.beta)
    assert (abs(one[-1] - one[0]), abs(two[-1] - two[0])) == pytest.approx((128, 106))
    # about O2 with disk 2 at rest: drive II alone
    rows = followed(THESIS, [Arc(72j, 72.0, 1.5 * math.pi, 2 * math.pi)], 0.01)
    one, two = THESIS.drives(rows.delta, rows.beta)
    assert np.ptp(one) == pytest.approx(0, abs=1e-9)
    assert abs(two[-1] - two[0]) == pytest.approx(212 / 3)
    # the same where the arms differ: the path touches both singular circles
    table = TwoDisk(arms=(72.0, 50.0))
    rows = followed(table, [Arc(72j, 50.0, 0.0, 2 * math.pi)], 0.01)
    assert np.ptp(rows.delta) == pytest.approx(0, abs=1e-6)
    assert np.ptp(rows.beta) == pytest.approx(2 * math.pi, abs=1e-6)


def test_paths_that_are_refused() -> None:
    with pytest.raises(ParameterError, match="out_of_reach"):
        followed(THESIS, [Line(-100 + 120j, 100 + 120j)], 0.01)
    with pytest.raises(ParameterError, match="out_of_reach"):
        followed(TwoDisk(arms=(72.0, 50.0)), [Line(-50 + 1j, 50 + 1j)], 0.01)
    with pytest.raises(ParameterError, match="pieces_part"):
        followed(THESIS, [Line(0j, 50 + 0j), Line(51 + 0j, 60 + 0j)], 0.01)


def driven(orientation: Orientation, rows: tuple[Any, Any]) -> tuple[Any, Any]:
    """O3 and the platform's turn by the layer, whose worms turn as a table says."""
    home = THESIS.drives(0.0, math.pi)

    def law(index: int) -> Callable[[Any, int], list[Any]]:
        wanted = 2 * math.pi * (THESIS.drives(*rows)[index] - home[index])
        return lambda t, order: [wanted[np.asarray(t, dtype=int)], *([0.0 * t] * order)]

    moved = moving(THESIS.mechanism(orientation), [Drive("worm_1", law=law(0)), Drive("worm_2", law=law(1))])
    place, angle = moved.pose("platform", np.arange(len(rows[0]), dtype=float), 0)
    return place[0], angle[0]


@pytest.mark.parametrize("orientation", ORIENTATIONS)
def test_the_layer_carries_the_platform_where_the_table_says(orientation: Orientation) -> None:
    circle, rng = Arc(20 + 10j, 60.0, 0.0, 2 * math.pi), np.random.default_rng(17)
    paths = [followed(THESIS, path, 0.05) for path in (SQUARE, [circle])]
    points = np.sqrt(rng.uniform(0, 144**2, 1000)) * np.exp(1j * rng.uniform(-math.pi, math.pi, 1000))
    tables = [(p.delta, p.beta) for p in paths] + [THESIS.inverse(points, elbow) for elbow in (1, -1)]
    for delta, beta in tables:
        place, angle = driven(orientation, (delta, beta))
        assert np.abs(place - THESIS.forward(delta, beta)).max() < 1e-10
        wanted = THESIS.platform_turn(beta - math.pi) if orientation == "thesis" else 0 * beta
        off = np.angle(np.exp(1j * (angle - wanted)))
        assert np.abs(off).max() < (1e-12 if orientation != "thesis" else 1e-10)


def test_parallel_for_certain_and_sixty_degrees_in_the_thesis() -> None:
    drives = ("worm_1", "worm_2")
    assert turns(THESIS.mechanism("idlers"), drives).of("platform") == {}
    share = turns(THESIS.mechanism("thesis"), drives).of("platform")
    # disk 3 turned by 30 degrees, disk 2 at rest: worm II by 30 * 2/3 degrees of the ring, against delta
    assert -share["worm_2"] * Fraction(106) * 20 == Fraction(60)


@pytest.mark.parametrize(
    ("orientation", "degrees", "chebyshev"), [("thesis", 2, 2), ("idlers", 2, 2), ("cranks", 2, -2)]
)
def test_mobility_counts_two_redundant_constraints_for_each_stage_of_cranks(
    orientation: Orientation, degrees: int, chebyshev: int
) -> None:
    found = mobility(THESIS.mechanism(orientation))
    assert (found.degrees, found.chebyshev) == (degrees, chebyshev)


def test_every_crank_keeps_its_length() -> None:
    delta, beta = THESIS.inverse(np.array([30 + 40j, -100 + 20j, 1e-9j, 144j]))
    home = THESIS.drives(0.0, math.pi)
    one, two = (w - h for w, h in zip(THESIS.drives(delta, beta), home, strict=True))
    for k in range(4):
        lines = [
            Drive("worm_1", Fraction(0), Fraction(float(one[k]))),
            Drive("worm_2", Fraction(0), Fraction(float(two[k]))),
        ]
        found = moving(THESIS.mechanism("cranks"), lines).poses(np.zeros(()), 0)
        for upper, cranks in (("flange", (1, 2, 3)), ("platform", (4, 5, 6))):
            for number, crank in enumerate(cranks):
                at, angle = (complex(x[0]) for x in found[f"crank_{crank}"])
                pivot = 51 * np.exp(2j * math.pi * number / 3)
                hung, turned = (complex(x[0]) for x in found[upper])
                assert abs(at + 72j * np.exp(1j * angle.real) - hung - pivot * np.exp(1j * turned.real)) < 1e-10


def test_errors_of_the_issue() -> None:
    rim, centre = (THESIS.inverse(point) for point in (144j, 0j))

    def moved(at: tuple[Any, Any], drive: int, slack: float, radius: float) -> float:
        return abs(complex(THESIS.drive_jacobian(*at)[drive])) * slack / radius

    assert moved(rim, 0, 0.05, 320) == pytest.approx(0.005625)
    assert moved(centre, 0, 0.05, 320) == pytest.approx(0.016875)
    assert abs(complex(THESIS.jacobian(*rim)[0])) * 0.05 / 320 == pytest.approx(0.0225)
    for at in (rim, centre):
        assert moved(at, 1, 0.05, 265) == pytest.approx(0.0204, abs=5e-5)
        assert abs(complex(THESIS.jacobian(*at)[1])) * 0.05 / 144 == pytest.approx(0.025)

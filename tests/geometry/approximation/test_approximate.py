"""Chords and arcs: the stated error is never below the measured deviation and at most twice it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings

from geometry.approximation import arcs as fitting
from geometry.approximation.arcs import arc_error, arc_spline
from geometry.approximation.chords import approximate_profile, approximate_together, chord_error, chord_parameters
from geometry.base.errors import ConvergenceError
from geometry.base.placement import Placement2
from geometry.curves.curve import Curve
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.curves.trochoid import TrochoidFillet
from geometry.gears.teeth.basic_rack import TipRelief, iso_53
from geometry.gears.teeth.spur import SpurGear
from geometry.gears.teeth.tooth import tooth_side
from geometry.plane.contour import Approximation
from geometry.plane.profile import Label, Profile, Segment, circle
from tests import brute
from tests.strategies import gears, numbers

PLAIN = SpurGear(2.0, 23, iso_53())
FLANK = tooth_side(PLAIN).segments[2].curve
FILLET = tooth_side(PLAIN).segments[1].curve
HARD = {
    "flank": FLANK,
    "fillet": FILLET,
    "flank, upper side": FLANK.mirrored(),
    "fillet, upper side": FILLET.mirrored(),
    "flank from its base circle": Involute(21.6, -0.083, 0.0, 0.58),
    "fillet of 42 teeth": tooth_side(SpurGear(2.0, 42, iso_53())).segments[1].curve,
    "fillet of 8 teeth": TrochoidFillet(8.0, 1.74, 0.76, -0.3, 0.0, 1.2),
    "fillet with its centre near the pitch line": TrochoidFillet(23.0, 1e-3, 0.76, -0.13, 0.0, 1.2217),
}
EVERY = pytest.mark.parametrize("curve", HARD.values(), ids=HARD.keys())
LADDER = pytest.mark.parametrize("tolerance", [1e-1, 1e-2, 5e-3, 1e-3, 1e-4, 1e-5, 1e-6])
ROUNDING = 1e-14
# what the proof leaves between the most samples it takes of one arc, (span/4096)^2/8 M2, mm: the factor ends there
RESOLUTION = 2e-8


def piece_deviations(curve: Curve, t: np.ndarray, bulges: np.ndarray, count: int = 401) -> np.ndarray:
    """Largest distance of dense curve points from each piece's own edge."""
    points = curve.point(t)
    return np.array(
        [
            brute.distance_to_edge(curve.point(np.linspace(a, b, count)), complex(s), complex(e), float(q)).max()
            for a, b, s, e, q in zip(t[:-1], t[1:], points[:-1], points[1:], bulges, strict=True)
        ]
    )


def joint_angles(points: np.ndarray, bulges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Tangent angles with which each edge leaves its start and reaches its end."""
    chords = np.angle(np.diff(points))
    return chords - 2 * np.arctan(bulges), chords + 2 * np.arctan(bulges)


@pytest.mark.sampled(10)
@EVERY
@LADDER
def test_chords_stay_within_a_tight_bound(curve: Curve, tolerance: float) -> None:
    t, error, certified = chord_parameters(curve, tolerance)
    assert certified
    assert (t[0], t[-1]) == curve.domain
    assert np.all(np.diff(t) > 0)
    assert error <= tolerance
    if len(t) > 400:  # the worst pieces among the first, the middle and the last hundred
        keep = [slice(0, 101), slice(len(t) // 2 - 50, len(t) // 2 + 51), slice(-101, None)]
    else:
        keep = [slice(None)]
    found = [piece_deviations(curve, t[k], np.zeros(len(t[k]) - 1)).max() for k in keep]
    assert max(found) <= error + ROUNDING * abs(curve.point(t[0]))
    assert error <= 2 * max(found) or len(keep) > 1
    for k, deviation in zip(keep, found, strict=True):
        # chord_error of a part is the truth of that part to sampling, not a multiple of it
        own = chord_error(curve, t[k])
        assert deviation - ROUNDING * 30 <= own <= deviation * (1 + 1e-4) + ROUNDING * 30


@pytest.mark.sampled(1)
@EVERY
def test_chord_count_is_near_the_least(curve: Curve) -> None:
    """Greedy longest chords are the least number; equal-error chords may need one or two more."""
    tolerance = 1e-3
    t, low, high = [curve.domain[0]], *curve.domain
    while t[-1] < high:
        a, b = t[-1], high
        if chord_error(curve, np.array([a, b])) > tolerance:
            low, b = a, high
            for _ in range(14):
                middle = (low + b) / 2
                low, b = (middle, b) if chord_error(curve, np.array([a, middle])) <= tolerance else (low, middle)
        t.append(b)
    assert len(chord_parameters(curve, tolerance)[0]) <= 1.05 * len(t) + 1


@pytest.mark.sampled(10)
@EVERY
@LADDER
def test_arcs_stay_within_a_tight_bound(curve: Curve, tolerance: float) -> None:
    spline = arc_spline(curve, tolerance)
    t = spline.parameters
    assert spline.certified
    assert (t[0], t[-1]) == curve.domain
    assert np.all(np.diff(t) > 0)
    assert np.array_equal(spline.points, curve.point(t))
    found = piece_deviations(curve, t, spline.bulges)
    assert found.max() <= spline.max_error <= tolerance
    assert spline.max_error <= 2 * found.max() + RESOLUTION
    # the arcs are as far from the curve as the curve from the arcs
    worst = int(np.argmax(found))
    start, end = (complex(p) for p in spline.points[worst : worst + 2])
    on_arc = brute.arc_points(start, end, spline.bulges[worst], 201)
    assert brute.distance_to_curve(on_arc, curve).max() <= spline.max_error


@pytest.mark.sampled(24)
@EVERY
@LADDER
def test_arcs_are_tangent_continuous(curve: Curve, tolerance: float) -> None:
    spline = arc_spline(curve, tolerance)
    leaving, arriving = joint_angles(spline.points, spline.bulges)
    inner = np.abs(np.angle(np.exp(1j * (leaving[1:] - arriving[:-1]))))
    assert np.max(inner, initial=0) <= 1e-9
    first, last = (complex(curve.tangent(t)) for t in curve.domain)
    assert abs(np.angle(np.exp(1j * leaving[0]) / first)) <= 1e-9
    assert abs(np.angle(np.exp(1j * arriving[-1]) / last)) <= 1e-9


@pytest.mark.sampled(1)
@EVERY
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3, 1e-4, 1e-5])
def test_arc_count_is_near_the_least(curve: Curve, tolerance: float) -> None:
    """Free arcs (joints anywhere, corners allowed) need kappa' h^3/192; tangent ones 1.155 times as many, and ends."""
    count = len(arc_spline(curve, tolerance).bulges)
    least = least_free_arcs(curve, tolerance)
    assert least <= count <= math.ceil(1.16 * least) + 2


def test_arc_count_of_the_standard_gear() -> None:
    assert len(arc_spline(FLANK, 0.005).bulges) <= 4
    assert len(arc_spline(FILLET, 0.005).bulges) <= 4
    assert len(approximate_profile(tooth_side(PLAIN).profile(), 0.005, arcs=True).geometry.vertices) <= 20


def least_free_arcs(curve: Curve, tolerance: float) -> int:
    """Greedy least number of circles that follow a curve within a tolerance, nothing shared between them."""
    start, end = curve.domain
    count = 0
    while start < end:
        count += 1
        if free_arc_error(curve, start, end) <= tolerance:
            return count
        low, high = start, end
        for _ in range(16):
            middle = (low + high) / 2
            low, high = (middle, high) if free_arc_error(curve, start, middle) <= tolerance else (low, middle)
        start = low
    return count


def free_arc_error(curve: Curve, start: float, end: float) -> float:
    """Least possible greatest distance of a piece from one circle: Remez exchange on A|w|^2 + Bx + C = y."""
    w = curve.point(start + (end - start) * (1 - np.cos(np.linspace(0, np.pi, 121))) / 2)
    w = (w - w[60]) / np.exp(1j * np.angle(w[-1] - w[0]))
    basis = np.stack([np.abs(w) ** 2, w.real, np.ones(len(w))], axis=1)
    weight, error = np.ones(len(w)), 0.0
    for _ in range(4):  # distances instead of algebraic residuals: weights from the previous circle
        error, (a, b, _) = _minimax(basis * weight[:, None], w.imag * weight)
        weight = 1 / np.abs((2 * a * w.real + b) + 1j * (2 * a * w.imag - 1))
    return error


def _minimax(basis: np.ndarray, values: np.ndarray) -> tuple[float, np.ndarray]:
    """Greatest residual and coefficients of the best approximation by three functions."""
    at = np.array([0, 30, 90, len(values) - 1])
    for _ in range(30):
        system = np.column_stack([basis[at], [1.0, -1.0, 1.0, -1.0]])
        *coefficients, level = np.linalg.solve(system, values[at])
        residual = values - basis @ coefficients
        worst = int(np.argmax(np.abs(residual)))
        if abs(residual[worst]) <= abs(level) * (1 + 1e-3) + 1e-16:
            break
        at = _exchanged(at, residual, worst)
    return float(np.abs(residual).max()), np.array(coefficients)


def _exchanged(at: np.ndarray, residual: np.ndarray, worst: int) -> np.ndarray:
    """The reference with ``worst`` taken in so that signs keep alternating."""
    merged = sorted({*at.tolist(), worst})
    groups: list[int] = []
    for index in merged:
        if groups and np.sign(residual[index]) == np.sign(residual[groups[-1]]):
            groups[-1] = max(groups[-1], index, key=lambda i: abs(residual[i]))
        else:
            groups.append(index)
    while len(groups) > 4:
        groups.pop(0 if abs(residual[groups[0]]) < abs(residual[groups[-1]]) else -1)
    return np.array(groups) if len(groups) == 4 else at


@pytest.mark.sampled(12)
@pytest.mark.parametrize("place", [0, 1, -1], ids=["first", "middle", "last"])
@EVERY
def test_a_spoiled_piece_raises_the_arc_bound(curve: Curve, place: int) -> None:
    """The largest deviation is seen in whichever piece it lies."""
    tolerance = 1e-3
    spline = arc_spline(curve, tolerance)
    index = {0: 0, 1: len(spline.bulges) // 2, -1: len(spline.bulges) - 1}[place]
    bulges = spline.bulges.copy()
    # a bulge moves the middle of an arc by half the chord times its change
    bulges[index] += 2 * 2 * tolerance / abs(spline.points[index + 1] - spline.points[index])
    found = piece_deviations(curve, spline.parameters, bulges)
    assert int(np.argmax(found)) == index
    error, _ = arc_error(curve, spline.parameters, spline.points, bulges, tolerance)
    assert tolerance < found.max() <= error <= 2 * found.max()


@EVERY
def test_an_arc_bound_is_the_same_wherever_the_curve_stands(curve: Curve) -> None:
    """About the middle of its first chord, and far away."""
    spline = arc_spline(curve, 1e-3)
    base, _ = arc_error(curve, spline.parameters, spline.points, spline.bulges, 1e-3)
    for at in (-(spline.points[0] + spline.points[1]) / 2, 300j):
        moved = curve.placed(Placement2(0.0, complex(at)))
        found, _ = arc_error(moved, spline.parameters, spline.points + at, spline.bulges, 1e-3)
        assert found == pytest.approx(base, rel=1e-6, abs=1e-11)


@pytest.mark.sampled(12)
@pytest.mark.parametrize("place", [0, 1, -1], ids=["first", "middle", "last"])
@EVERY
def test_a_long_piece_raises_the_chord_error(curve: Curve, place: int) -> None:
    t = chord_parameters(curve, 1e-3)[0]
    index = {0: 1, 1: len(t) // 2, -1: len(t) - 2}[place]
    spoiled = np.delete(t, index)
    found = piece_deviations(curve, spoiled, np.zeros(len(spoiled) - 1))
    assert int(np.argmax(found)) == index - 1
    assert 1e-3 < found.max() <= chord_error(curve, spoiled) * (1 + 1e-12) <= found.max() * (1 + 1e-4)


def deviation(approximation: Approximation, profile: Profile) -> float:
    """Hausdorff distance of the first period from the exact outline, both ways, by brute force."""
    c = approximation.geometry
    there = brute.distance_to_contour(brute.period_points(profile, 401), c.vertices, c.bulges, c.count)
    per_edge = max(9, 2000 // len(c.vertices))
    back = brute.distance_to_outline(brute.contour_points(c.vertices, c.bulges, c.count, per_edge), profile, 200)
    return float(max(there.max(), back.max()))


@settings(max_examples=2)
@given(gears(), numbers(-4, -1.5))
def test_whole_outlines_of_any_gear(gear: SpurGear, exponent: float) -> None:
    profile, tolerance = tooth_side(gear).profile(), gear.module * 10**exponent
    for arcs in (True, False):
        made = approximate_profile(profile, tolerance, arcs=arcs)
        found = deviation(made, profile)
        assert made.bound == "certified"
        assert found <= made.max_error + ROUNDING * gear.tip_radius
        assert made.max_error <= tolerance
        assert made.max_error <= 2 * found + ROUNDING * gear.tip_radius
        assert made.geometry.count == gear.number_of_teeth


@pytest.mark.sampled(1)
@pytest.mark.parametrize("module", [0.3, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("profile_name", ["A", "D"])
def test_merged_edges_stay_within_the_tolerance(module: float, profile_name: str) -> None:
    """Rack D leaves a root land of 0.0048 m: every such gear up to m 4 has edges to merge (theory note B8)."""
    gear = SpurGear(module, 23, iso_53(profile_name))
    profile = tooth_side(gear).profile()
    plain = approximate_profile(profile, 0.005, arcs=True)
    made = approximate_profile(profile, 0.005, arcs=True, least_edge=0.02)
    found = deviation(made, profile)
    assert found <= made.max_error + ROUNDING * gear.tip_radius
    assert made.max_error <= 0.005
    lengths = np.abs(made.geometry.period_ends() - made.geometry.vertices)
    before = np.abs(plain.geometry.period_ends() - plain.geometry.vertices)
    if before.min() >= 0.02:
        assert np.array_equal(made.geometry.vertices, plain.geometry.vertices)
    else:
        assert lengths.min() > before.min()
        assert len(lengths) < len(before)


def test_a_relieved_tooth_keeps_its_corner() -> None:
    """A corner between two involutes stays a vertex, however coarse the tolerance."""
    profile = tooth_side(SpurGear(2.0, 23, iso_53(relief=TipRelief(0.02)))).profile()
    corner = next(s for s in profile.period if s.label is Label.RELIEF).curve
    for arcs in (True, False):
        made = approximate_profile(profile, 0.1, arcs=arcs)
        assert np.abs(made.geometry.vertices - complex(corner.point(corner.domain[0]))).min() <= 1e-12


def test_lines_and_arcs_are_themselves() -> None:
    """Arcs cost nothing as arcs; as chords their error is the sagitta, exactly."""
    made = approximate_profile(circle(7.0, Label.BORE), 1e-3, arcs=True)
    assert (made.max_error, made.bound, len(made.geometry)) == (0.0, "exact", 2)
    chords = approximate_profile(circle(7.0, Label.BORE), 1e-3, arcs=False)
    sagitta = 7.0 * (1 - math.cos(math.pi / len(chords.geometry)))
    assert chords.max_error == pytest.approx(sagitta, rel=1e-9)
    assert sagitta <= 1e-3 < 7.0 * (1 - math.cos(math.pi / (len(chords.geometry) - 2)))
    square = [Line(a, b) for a, b in ((0j, 1 + 0j), (1 + 0j, 1 + 1j), (1 + 1j, 1j), (1j, 0j))]
    box = approximate_profile(Profile(tuple(Segment(c, Label.BORE) for c in square)), 1e-3, arcs=True)
    assert (box.max_error, len(box.geometry)) == (0.0, 4)


@pytest.mark.parametrize("curve", [FLANK, Arc(0j, 1e6, 0.0, 6.0)], ids=["involute", "arc"])
def test_an_impossible_tolerance_is_refused(curve: Curve) -> None:
    with pytest.raises(ConvergenceError):
        chord_parameters(curve, 1e-13)


def test_an_impossible_tolerance_for_arcs_is_refused() -> None:
    with pytest.raises(ConvergenceError):
        arc_spline(FLANK, 1e-18)


@pytest.mark.parametrize(("kind", "constant"), [("lean", 72 * math.sqrt(3)), ("tangent", 40.5)])
def test_error_constants_of_one_arc(kind: str, constant: float) -> None:
    """DERIVATIONS 4: kappa' h^3/124.7 leaning by kappa' h^2/12, kappa' h^3/40.5 where the start is tangent."""
    middle, h = 0.4, 0.01
    a, b = middle - h / 2, middle + h / 2
    points = FLANK.point(np.array([a, b]))
    length = FLANK.base_radius * middle * h
    # kappa = 1/(r_b f), ds = r_b f df
    change = 1 / (FLANK.base_radius**2 * middle**3)
    start = np.angle(complex(FLANK.tangent(a)))
    chord = np.angle(points[1] - points[0])
    # an involute turns by its roll angle: an arc of that sweep leans alike at both ends
    sweep = h if kind == "lean" else 2 * (chord - start)
    bulge = math.tan(sweep / 4)
    lean = abs(chord - sweep / 2 - start)
    assert lean == pytest.approx(change * length**2 / 12 if kind == "lean" else 0.0, rel=0.03, abs=1e-12)
    found = brute.distance_to_edge(FLANK.point(np.linspace(a, b, 2001)), points[0], points[1], bulge).max()
    assert found == pytest.approx(change * length**3 / constant, rel=0.03)


def test_one_arc_alone_is_tried_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """It has no first length to vary: the same arc was tried seven times."""
    tried: list[int] = []
    with_share = fitting._with_first_share

    def counted(curve: Curve, count: int, *rest: Any) -> Any:
        tried.append(count)
        return with_share(curve, count, *rest)

    monkeypatch.setattr(fitting, "_with_first_share", counted)
    arc_spline(FLANK, 10.0)
    arc_spline(FILLET, 10.0)
    assert tried.count(1) == 2


@pytest.mark.parametrize("upside_down", [False, True])
def test_a_wall_between_chords_that_lean_is_told_whichever_way_it_is_named(upside_down: bool) -> None:
    """Its error is a quarter of how far the end of the longer chord stands off the other's direction."""
    large = np.array([0j, 4.0, 1 + 3j])
    triangles = large, large * np.exp(0.02j) / 4
    profiles = [Profile(tuple(Segment(Line(a, b), Label.CAM) for a, b in zip(t, np.roll(t, -1), strict=True)))
                for t in triangles]  # fmt: skip
    made = approximate_together(profiles, {(1, 0) if upside_down else (0, 1)}, 9.0)
    assert [one.max_error for one in made] == pytest.approx([abs(3 - 3j) * math.sin(0.02) / 4] * 2)

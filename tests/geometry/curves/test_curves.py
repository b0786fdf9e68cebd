"""Every curve class under the laws of tests/laws.py, and what each class promises beyond them."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from geometry.base.errors import CuspError
from geometry.base.placement import Placement2
from geometry.base.record import replace
from geometry.curves.curve import Carried, Curve, Mirrored, OffsetCurve, Reversed
from geometry.curves.cutter_fillet import CutterFillet
from geometry.curves.ellipse import EllipticArc, ellipse_angle
from geometry.curves.elliptic_fillet import EllipticFillet
from geometry.curves.involute import Involute
from geometry.curves.line_arc import Arc, Line
from geometry.curves.trochoid import TrochoidFillet
from tests import laws
from tests.oracles.trochoid import Trochoid
from tests.sampling import examples
from tests.strategies import (
    curves,
    cutter_fillets,
    fillets,
    involutes,
    lines,
    numbers,
    parallels,
    placements,
    trochoids,
)

EXAMPLES: dict[str, Curve] = {
    "line": Line(1 + 2j, 4 - 3j),
    "arc left": Arc(2 - 1j, 3.0, 0.4, 1.9),
    "arc right": Arc(2 - 1j, 3.0, 0.4, -1.9),
    "involute": Involute(21.6, -0.083, 0.0934, 0.58),
    "involute from the base circle": Involute(21.6, -0.083, 0.0, 0.58, 1j),
    "involute, other branch": Involute(21.6, -0.083, -0.58, -0.0934, 3.0),
    "trochoid": Trochoid(23.0, 1.74, -0.13, 0.0, 4.8),
    "trochoid, curtate": Trochoid(23.0, -1.74, 0.5, -3.0, 4.8, 2 + 1j),
    "fillet": TrochoidFillet(23.0, 1.74, 0.76, -0.131, 0.0, 1.2217),
    "fillet, centre on the pitch line": TrochoidFillet(23.0, 0.0, 0.76, -0.131, 0.0, 1.2217),
    "fillet, centre outside": TrochoidFillet(23.0, -0.26, 0.76, -0.131, 0.0, 1.2217),
    "fillet, upper side": TrochoidFillet(23.0, 1.74, 0.76, 0.131, -1.2217, 0.0, -1j),
    "fillet of a small gear": TrochoidFillet(3.0, 1.4, 0.76, 0.1, 0.0, 1.2217),
    "elliptic fillet": EllipticFillet(23.0, 1.74, 0.76, -0.131, 0.0, 1.2217, 0.76, 1.1547),
    "elliptic fillet, grown": EllipticFillet(23.0, -0.26, 1.1, -0.131, 0.0, 1.2217, 0.76, 2.0),
    "elliptic fillet, upper side": EllipticFillet(3.0, 1.4, 0.5, 0.131, -1.1, 0.0, 0.76, 1.4, -1j),
    "elliptic arc": EllipticArc(Arc(0j, 0.76, 1.2, -1.2), 1.4, Placement2(0.3, 2 - 1j)),
    "ring fillet": CutterFillet(60.0, 25.0, 2.05, 0.4, -0.003, 0.0, 1.2217),
    "ring fillet, centre on the pitch line": CutterFillet(60.0, 25.0, 0.0, 0.4, -0.003, 0.0, 1.2217),
    "ring fillet, centre inside": CutterFillet(60.0, 25.0, -0.2, 0.4, -0.003, 0.0, 1.1, 2 - 1j),
    "ring fillet, upper side": CutterFillet(60.0, 55.0, 2.05, 0.4, 0.003, -1.2217, 0.0),
    "shaped fillet": CutterFillet(23.0, -25.0, 1.9, 0.5, -0.13, 0.0, 1.2217),
    "shaped fillet, centre inside": CutterFillet(23.0, -70.0, -0.4, 0.5, -0.13, 0.0, 1.2),
    "parallel of a trochoid": OffsetCurve(Trochoid(23.0, 1.74, -0.13, 0.0, 4.8), -0.3),
    "parallel of an arc": OffsetCurve(Arc(1j, 5.0, 0.0, 2.0), 1.2),
}
EXAMPLES |= {f"reversed {name}": Reversed(curve) for name, curve in EXAMPLES.items()}
# what carries and mirrors any of them, each about curves that bound their derivatives, trim and turn back differently
HELD = ("involute", "fillet", "elliptic fillet, upper side", "ring fillet", "parallel of a trochoid")
EXAMPLES |= {f"mirrored {name}": Mirrored(EXAMPLES[name]) for name in HELD}
EXAMPLES |= {f"carried {name}": Carried(EXAMPLES[name], Placement2(0.7, 3 - 2j)) for name in HELD}
EVERY = pytest.mark.parametrize("curve", EXAMPLES.values(), ids=EXAMPLES.keys())


def test_every_class_is_among_the_examples() -> None:
    kinds = {type(c) for c in EXAMPLES.values()}
    fillets = {TrochoidFillet, EllipticFillet, CutterFillet}
    carriers = {Reversed, Mirrored, Carried}
    assert kinds == {Line, Arc, EllipticArc, Involute, Trochoid, OffsetCurve} | carriers | fillets
    assert {type(c.base) for c in EXAMPLES.values() if isinstance(c, Reversed)} == kinds - carriers
    assert all(isinstance(c, Curve) for c in EXAMPLES.values())


@pytest.mark.sampled(3)
@EVERY
def test_derivatives_against_fifty_digits(curve: Curve) -> None:
    laws.check_derivatives(curve)


@pytest.mark.sampled(8)
@EVERY
def test_tangent_and_curvature_against_fifty_digits(curve: Curve) -> None:
    laws.check_tangent_and_curvature(curve)


@EVERY
def test_methods_are_vectorised(curve: Curve) -> None:
    t = laws.parameters(curve, 6).reshape(2, 3)
    for method in (curve.point, curve.derivative, curve.tangent):
        values = method(t)
        assert values.shape == (2, 3)
        assert abs(values[1, 2] - method(t[1, 2])) <= 1e-14 * max(1.0, abs(values[1, 2]))
    assert curve.curvature(t).shape == (2, 3)


@EVERY
def test_together_they_are_what_they_are_alone(curve: Curve) -> None:
    laws.check_derivatives_together(curve)
    laws.check_alike(curve)


@EVERY
def test_empty_trim_is_refused(curve: Curve) -> None:
    middle = sum(curve.domain) / 2
    with pytest.raises(ValueError, match="empty parameter interval"):
        curve.trimmed(middle, middle)


@examples(25)
@given(curves)
def test_derivatives_of_any_curve(curve: Curve) -> None:
    laws.check_derivatives(curve)
    laws.check_derivatives_together(curve)
    laws.check_tangent_and_curvature(curve)


@examples(120)
@given(curves, placements, numbers(0, 0.45), numbers(0.55, 1))
def test_laws_of_any_curve(curve: Curve, placement: Placement2, a: float, b: float) -> None:
    laws.check_derivative_bound(curve)
    laws.check_reversal(curve)
    laws.check_placement(curve, placement)
    laws.check_trimming(curve, a, b)


@examples(120)
@given(curves, numbers(-5, 5))
def test_offset_is_refused_exactly_where_it_turns_back(curve: Curve, distance: float) -> None:
    laws.check_cusp(curve, distance)


OFFSETTABLE = st.one_of(lines(), involutes(), trochoids(), fillets(), cutter_fillets(), parallels())


@examples(120)
@given(OFFSETTABLE, numbers(-1, 1), numbers(-1, 1))
def test_offsets_add(curve: Curve, first: float, second: float) -> None:
    t = np.linspace(*curve.domain, 257)
    bend = np.abs(curve.curvature(t))
    room = 0.45 / float(np.max(bend[np.isfinite(bend)], initial=0.05)) if np.all(np.isfinite(bend)) else 0.0
    if room == 0.0:  # an involute that starts on its base circle moves one way only
        first, second = -abs(first), -abs(second)
        assert laws.stretch_range(curve, first + second)[0] >= 1
        room = 1.0
    laws.check_offset_adds(curve, first * room, second * room)


@examples(60)
@given(trochoids().filter(lambda c: c.depth > 0), numbers(0.02, 0.9))
def test_parallel_of_the_centre_path_is_the_fillet(path: Trochoid, share: float) -> None:
    """A rounding rho about the path's point envelopes its parallel; two classes, one curve."""
    rho = share * path.pitch_radius / 4
    parallel = OffsetCurve(path, rho)
    u = np.arctan(np.linspace(path.start, path.end, 41) / path.depth)
    fillet = TrochoidFillet(path.pitch_radius, path.depth, rho, path.angle, u[0], u[-1], path.centre)
    s = path.depth * np.tan(u)
    assert np.max(np.abs(fillet.point(u) - parallel.point(s))) <= 1e-12 * path.pitch_radius
    assert np.max(np.abs(fillet.tangent(u) - parallel.tangent(s))) <= 1e-9
    assert np.max(np.abs(fillet.curvature(u) / parallel.curvature(s) - 1)) <= 1e-8


@examples(60)
@given(fillets(), numbers(-0.5, 0.5))
def test_offset_keeps_the_family(fillet: TrochoidFillet, share: float) -> None:
    distance = share * fillet.tip_radius
    if laws.stretch_range(fillet, distance)[0] > 1e-9 and fillet.cusp() is None:
        moved = fillet.offset(distance)
        assert type(moved) is TrochoidFillet
        assert moved.domain == fillet.domain
        laws.check_offset_distance(fillet, distance)


def test_an_involute_stays_an_involute() -> None:
    flank = EXAMPLES["involute"]
    moved = flank.offset(0.4)
    assert type(moved) is Involute
    assert moved.base_radius == flank.base_radius
    laws.check_offset_distance(flank, 0.4)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
def test_involute_cusps_at_its_base_circle(sense: int, side: int) -> None:
    """1 - d/(r_b f) = 0 at f = d/r_b: just inside the domain it is refused and named, just outside allowed."""
    flank = Involute(20.0, 0.3, 0.1, 0.5) if sense > 0 else Involute(20.0, 0.3, -0.5, -0.1)
    limit = 20.0 * 0.1
    flank.offset(limit * (1 - 1e-12))
    with pytest.raises(CuspError) as caught:
        flank.offset(limit * (1 + 1e-9))
    assert caught.value.t == pytest.approx(sense * 0.1, rel=1e-8)
    assert caught.value.distance == limit * (1 + 1e-9)
    flank.offset(side * -3.0 if side > 0 else 1.0)


@pytest.mark.parametrize("name", ["involute", "involute, other branch"])
def test_a_reversed_curve_names_its_own_cusp(name: str) -> None:
    curve = Reversed(EXAMPLES[name])
    distance = -21.6 * 0.2
    with pytest.raises(CuspError) as caught:
        curve.offset(distance)
    assert caught.value.distance == distance
    assert curve.domain[0] <= caught.value.t <= curve.domain[1]
    assert abs(1 - distance * float(curve.curvature(caught.value.t))) <= 1e-12


@examples(60)
@given(numbers(0.02, 0.98), numbers(1e-7, 1e-3))
def test_parallel_of_a_trochoid_turns_back_between_samples(place: float, excess: float) -> None:
    """The sharpest point of the path (s = 0) lies anywhere in the domain; a hair past its radius is refused."""
    path = Trochoid(23.0, 1.74, 0.0, -place, 1.0 - place)
    radius = 1 / abs(float(path.curvature(0.0)))
    sign = math.copysign(1, float(path.curvature(0.0)))
    with pytest.raises(CuspError) as caught:
        path.offset(sign * radius * (1 + excess))
    value = 1 - sign * radius * (1 + excess) * float(path.curvature(caught.value.t))
    assert abs(value) <= max(2 * excess, 1e-9)
    path.offset(sign * radius * (1 - 1e-9))


@examples(60)
@given(fillets())
def test_fillet_speed_and_turning(fillet: TrochoidFillet) -> None:
    """Speed rho (1 + q sec^2) + D q sec^3 and turning rate -(1 + q sec^2), from finite differences of exact points."""
    u = np.linspace(*fillet.domain, 7)[1:-1]
    first = fillet.derivative(u)
    along = (first * np.conj(fillet.tangent(u))).real
    assert np.max(np.abs(np.abs(along) - np.abs(fillet.speed(u)))) <= 1e-10 * np.max(np.abs(along))
    sec = 1 / np.cos(u)
    q = fillet.depth / fillet.pitch_radius
    turning = fillet.curvature(u) * np.abs(first)
    assert np.max(np.abs(turning + 1 + q * sec**2)) <= 1e-9 * np.max(1 + abs(q) * sec**2)


@examples(60)
@given(fillets())
def test_radius_along_the_fillet(fillet: TrochoidFillet) -> None:
    """d|e|^2/2 = speed r sin u du: with positive speed the fillet of a lower side rises from root to flank."""
    at_origin = fillet.placed(Placement2(0.0, -fillet.centre))
    u = np.linspace(*at_origin.domain, 9)
    change = (np.conj(at_origin.point(u)) * at_origin.derivative(u)).real
    law = at_origin.speed(u) * at_origin.pitch_radius * np.sin(u)
    assert np.max(np.abs(change - law)) <= 1e-12 * at_origin.pitch_radius * np.max(np.abs(at_origin.derivative(u)))


def test_fillet_cusp_is_the_first_root_of_its_speed() -> None:
    """A fillet moved by more than rho turns back near the root first (theory note A10 i)."""
    fillet = EXAMPLES["fillet"]
    grown = TrochoidFillet(23.0, 1.74, 0.76 - 1.0, -0.131, 0.0, 1.2217)
    assert fillet.cusp() is None
    assert grown.cusp() == 0.0
    with pytest.raises(CuspError):
        fillet.offset(-1.0)
    bent = TrochoidFillet(23.0, -3.0, 30.0, 0.0, 0.0, 1.4)
    at = bent.cusp()
    assert at is not None
    assert abs(float(bent.speed(at))) <= 1e-10 * bent.tip_radius
    assert np.all(bent.speed(np.linspace(0, at - 1e-6, 1001)) > 0)
    assert float(bent.speed(at + 1e-6)) < 0
    # of one number too the tangent is that of the way on, of either sign of the speed
    beyond = np.linspace(at - 0.1, at + 0.1, 6)
    assert [bent.tangent(u) for u in beyond.tolist()] == pytest.approx(bent.tangent(beyond), abs=1e-15)


@examples(60)
@given(cutter_fillets(), numbers(-0.9, 2.0))
def test_offset_of_a_cutter_fillet_keeps_the_family(fillet: CutterFillet, share: float) -> None:
    distance = share * fillet.tip_radius
    moved = replace(fillet, tip_radius=fillet.tip_radius + distance)
    if moved.cusp() is None:
        assert fillet.offset(distance) == moved
        laws.check_offset_distance(fillet, distance)


def test_a_cutter_of_infinite_size_is_a_rack() -> None:
    """The fillet differs from the rack's by O(1/r_0) of the cutter's pitch radius."""
    rack = TrochoidFillet(23.0, 1.74, 0.76, -0.131, 0.0, 1.2)
    u = np.linspace(0, 1.2, 41)
    near = [CutterFillet(23.0, -radius, 1.74, 0.76, -0.131, 0.0, 1.2) for radius in (1e4, 1e5, 1e6)]
    differences = [float(np.max(np.abs(c.point(u) - rack.point(u)))) for c in near]
    assert differences[0] < 1e-2
    assert differences[1] / differences[0] == pytest.approx(0.1, rel=0.02)
    assert differences[2] / differences[1] == pytest.approx(0.1, rel=0.02)


@examples(60)
@given(cutter_fillets())
def test_radius_and_normals_of_a_cutter_fillet(fillet: CutterFillet) -> None:
    """Every normal passes the pitch point: |p - e| is the normal length, and the angle to the tangent is right."""
    u = laws.parameters(fillet, 17)
    share, ratio = abs(fillet.cutter_radius) / fillet.corner_radius, fillet.cutter_radius / fillet.pitch_radius
    turned = u - np.arcsin(share * np.sin(u))
    pitch_point = fillet.centre + fillet.pitch_radius * np.exp(1j * (fillet.angle + ratio * turned))
    along = np.conj(fillet.tangent(u)) * (pitch_point - fillet.point(u))
    size = fillet.pitch_radius + abs(fillet.cutter_radius)
    assert np.max(np.abs(along.real)) <= 1e-12 * size
    lengths = np.array([fillet.normal_length(float(t)) for t in u])
    assert np.allclose(np.abs(along.imag), np.abs(lengths), rtol=0, atol=1e-12 * size)


@pytest.mark.parametrize("stretch", [1.4, 0.6])
def test_laws_of_elliptic_arcs(stretch: float) -> None:
    """Wide and flat ones: bounds, motions, trims; mirrored they are the image in the x axis, run the other way."""
    curve = EllipticArc(Arc(0.2 - 0.1j, 0.76, -1.2, 3.0), stretch, Placement2(0.3, 2 - 1j))
    for order in (1, 2, 3, 4):
        # it passes both of its axes
        largest = np.abs(curve.derivative(np.linspace(*curve.domain, 4001), order)).max()
        assert largest * (1 - 1e-13) <= curve.derivative_bound(order, *curve.domain) <= largest * (1 + 1e-6)
    laws.check_reversal(curve)
    laws.check_placement(curve, Placement2(-1.1, 3 + 0.5j))
    laws.check_trimming(curve, 0.2, 0.8)
    twin = curve.mirrored()
    assert twin.point(np.linspace(*twin.domain, 9)) == pytest.approx(
        np.conj(curve.point(np.linspace(*curve.domain, 9)))[::-1], abs=1e-14
    )


@pytest.mark.parametrize("stretch", [1.4, 0.6])
def test_the_angle_of_a_normal_is_square_to_the_tangent_there(stretch: float) -> None:
    curve = EllipticArc(Arc(0j, 2.0, 0.0, 1.6), stretch, Placement2())
    for normal in (0.0, 0.3, 0.7, 1.2, 1.5):
        tangent = complex(curve.tangent(ellipse_angle(normal, stretch)))
        assert (tangent * np.exp(-1j * normal)) == pytest.approx(1j, abs=1e-14)


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", [name for name in EXAMPLES if name.startswith(("mirrored", "carried"))])
def test_laws_of_what_is_mirrored_and_carried(name: str) -> None:
    """As of the curve itself; bounds of stretches are those of the stretches they come from, ends in their order."""
    curve = EXAMPLES[name]
    laws.check_derivative_bound(curve)
    laws.check_reversal(curve)
    laws.check_placement(curve, Placement2(-1.1, 3 + 0.5j))
    laws.check_trimming(curve, 0.2, 0.7)
    base = curve.base  # type: ignore[attr-defined]
    for distance in () if isinstance(base, OffsetCurve) else (0.05, -0.05, 3.0, -3.0, 30.0, -30.0):
        laws.check_cusp(curve, distance)
    edges = np.linspace(*curve.domain, 5)
    if not isinstance(base, OffsetCurve):
        found = curve.derivative_bounds(edges, (1, 2, 3))
        for k, (a, b) in enumerate(pairwise(edges.tolist())):
            assert found[:, k] == pytest.approx([curve.derivative_bound(order, a, b) for order in (1, 2, 3)], rel=1e-12)
    twin = curve.mirrored()
    t = np.linspace(0, 1, 7)
    low, high = curve.domain
    start, end = twin.domain
    assert twin.point(start + t * (end - start)) == pytest.approx(np.conj(curve.point(high - t * (high - low))))
    assert [complex(x) for x in curve.knots] == [complex(x) for x in base.knots]


def test_a_mirrored_curve_names_its_own_cusp() -> None:
    curve = Mirrored(EXAMPLES["involute"])
    distance = 21.6 * 0.2
    with pytest.raises(CuspError) as caught:
        curve.offset(distance)
    assert caught.value.distance == distance
    assert curve.domain[0] <= caught.value.t <= curve.domain[1]
    assert abs(1 - distance * float(curve.curvature(caught.value.t))) <= 1e-12


@pytest.mark.parametrize(("start", "end"), [(0.0, 1.2), (-0.9, 1.2), (-1.2, -0.1), (0.2, 1.2)])
def test_the_cusp_of_a_fillet_is_the_nearest_to_its_root(start: float, end: float) -> None:
    """The first place, by size, at which its speed stops being positive: on a fine net, for either family."""
    for curve in (
        EllipticFillet(23.0, -3.0, 30.0, 0.0, start, end, 20.0, 1.3),
        EllipticFillet(23.0, 1.74, -0.05, -0.1, start, end, 0.76, 1.3),
        EllipticFillet(23.0, -6.0, 12.0, 0.0, start, end, 3.0, 1.3),
        TrochoidFillet(23.0, -3.0, 30.0, 0.0, start, end),
        TrochoidFillet(23.0, 1.74, -0.24, -0.1, start, end),
        CutterFillet(60.0, 25.0, -1.5, 30.0, 0.0, start, end),
    ):
        u = np.linspace(start, end, 2001)
        stopped = u[curve.speed(u) <= 0]
        if not stopped.size:
            assert curve.cusp() is None
            continue
        found = curve.cusp()
        assert found is not None
        step = (end - start) / 2000
        u = np.clip(stopped[np.abs(stopped).argmin()] + step * np.linspace(-1, 1, 201), start, end)
        assert abs(found) == pytest.approx(np.abs(u[curve.speed(u) <= 0]).min(), abs=1.1 * step / 100)

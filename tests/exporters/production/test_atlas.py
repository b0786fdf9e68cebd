"""The atlas of stiff cases: each is where its name says, and its truths are held by second derivations at 50 digits."""

from __future__ import annotations

import cmath
import itertools
import math
from collections.abc import Callable

import pytest

from exporters.production import atlas
from exporters.production.atlas import ALPHA, CASES, MP, Inputs, Number

CASE = {case.name: case for case in CASES}


def _inv(angle: Number) -> Number:
    return MP.tan(angle) - angle


def _left_of_shift(x: Number, alpha: Number) -> Number:
    """Working involute by the sum of shifts of a pair of 20 and 41 teeth, in parts of that of the rack."""
    return (_inv(alpha) + 2 * x * MP.tan(alpha) / (41 - 20)) / _inv(alpha)


def _below_point(m: Number, z: int, x: Number, tip: Number, alpha: Number) -> Number:
    """Where both flanks meet: psi_b = inv alpha_p, the half angle of a tooth on the base circle."""
    half = (MP.pi / 2 + 2 * x * MP.tan(alpha)) / z + _inv(alpha)
    pointed = MP.findroot(lambda a: _inv(a) - half, MP.mpf("0.6"))
    return m * z * MP.cos(alpha) / MP.cos(pointed) - tip


def _path_radius(lift: Number, prime: Number, angle: Number, way: Number) -> Number:
    """|z'|^3 / Im(conj z' z'') of the centre's path z = (prime + s) exp(i phi), derivatives of it taken by mpmath."""

    def centre(at: Number) -> Number:
        u = at / way
        return (prime + lift * u**3 * (10 + u * (6 * u - 15))) * MP.expj(at)

    first, second = MP.diff(centre, angle), MP.diff(centre, angle, 2)
    return abs(first) ** 3 / (MP.conj(first) * second).imag


# what is left of the way to each case's extreme, and to what part of it its float inputs can say so
LEFT: dict[str, tuple[Callable[..., Number], float]] = {
    "working angle of an internal pair 20 / 41 by its last shift": (_left_of_shift, 1e-15),
    "tooth thickness on the tip of an all but pointed tooth": (_below_point, 1e-13),
    "radius of curvature of a roller cam by undercut":
        (lambda s, r, roller, angle, way: _path_radius(s, r, angle, way) - roller, 1e-13),
    "angles of the two-disk table by its centre, equal arms": (lambda x, y, a, b: MP.hypot(x, y) - abs(a - b), 1e-13),
    "angles of the two-disk table by its rim": (lambda x, y, a, b: a + b - MP.hypot(x, y), 1e-13),
    "angles of the two-disk table by its inner rim, unequal arms":
        (lambda x, y, a, b: MP.hypot(x, y) - abs(a - b), 1e-13),
    "axial pressure angle of an involute worm":
        (lambda m, q, alpha: MP.degrees(MP.atan(1 / q)), 1e-13),
    "stiffness of two bodies pressed together": (lambda flat, sharp: sharp / flat, 1e-13),
    "curvature of a cycloidal disc's path by its cusp": (lambda a, short, m: 1 - short, 1e-15),
    "fillet whose rounding centre comes to the pitch line": (lambda r, depth, rho, u: depth, 0.0),
    "acceleration of a polynomial law by the end of its phase, u = 0.999":
        # as many conditions at each end as the degree has coefficients
        (lambda u, order: 2 * order - 1 if u == MP.mpf(0.999) else MP.nan, 0.0),
    # DIN 3960: k = z alpha / 180 + 0.5, rounded
    "span over teeth": (lambda m, z, x, k, alpha: z if abs(z / 9 + 0.5 - k) <= 0.5 else MP.nan, 0.0),
}  # fmt: skip


@pytest.mark.parametrize("name", LEFT)
def test_inputs_lie_where_the_case_says(name: str) -> None:
    left, digits = LEFT[name]
    for value in CASE[name].values:
        exact = [MP.mpf(x) if isinstance(x, float) else x for x in CASE[name].inputs(value)]
        assert abs(left(*exact) - value) <= digits * max(abs(value), 1.0) * 4, value


def test_disks_are_equal_where_they_say_so() -> None:
    for case in (c for c in CASES if "two-disk" in c.name):
        for value in case.values:
            _, _, one, two = case.inputs(value)
            assert (one == two) == ("unequal" not in case.name)


def test_values_are_found_again_on_an_axis() -> None:
    """Two digits, or places that have a meaning of their own: a right angle cut, tan 0.1 in degrees, 1 and a little."""
    own = {1.57079, 5.71, 0.125, 0.99, 0.999, 1.01, 1 + 1e-6, 1 + 1e-12}
    for case in CASES:
        for value in case.values:
            assert value in own or float(f"{value:.1e}") == value, (case.name, value)
    assert 0 < math.pi / 2 - CASES[0].values[-1] < 1e-5


def _meshed(z: int, x: float, inside: float, addendum: float = 1.0) -> float:
    """Contact ratio of two equal gears, m = 1, from points on the line of action, tips of this addendum."""
    wide = MP.findroot(lambda a: _inv(a) - _inv(MP.mpf(ALPHA)) - 2 * x * MP.tan(ALPHA) / z, MP.mpf("0.4"))
    base = z * MP.cos(MP.mpf(ALPHA)) / 2
    far = 2 * base / MP.cos(wide)
    # the tip of one against the root of the other: all but the rack's clearance
    tip = far - (MP.mpf(z) / 2 - addendum - inside + x) - inside
    leaves = MP.sqrt(tip**2 - base**2)
    return 2 * (leaves - base * MP.tan(wide)) / (MP.pi * MP.cos(MP.mpf(ALPHA)))


@pytest.mark.parametrize("z", [18, 30, 1000])
def test_a_contact_ratio_is_twice_the_way_from_the_pole(z: int) -> None:
    """Tips come to the other gear's root as far as the rack's clearance 0.25."""
    for m in (1.0, 2.0):
        own = atlas._contact_ratio(MP.mpf(m), z, MP.mpf(0.1), MP.mpf(ALPHA))
        assert abs(own - _meshed(z, 0.1, 0.25)) < 1e-30


@pytest.mark.parametrize(
    "inputs", [(20.0, 40.0, 5.0, 0.9, 1.2), (8.0, 30.0, 0.0, 0.2, 2.0), (8.0, 30.0, 2.0, 1.7, 2.0)]
)
def test_a_cams_curvature_is_that_of_its_centres_path(inputs: Inputs) -> None:
    lift, prime, roller, angle, way = map(MP.mpf, inputs)
    own = atlas._cam_curvature(lift, prime, roller, angle, way)
    assert abs(own - (_path_radius(lift, prime, angle, way) - roller)) < MP.mpf(10) ** -18


def test_an_angle_is_that_of_its_involute_at_all_digits() -> None:
    for k in (-24, -9, -1, 0, 3, 9):
        involute = MP.mpf(10) ** k * 3 / 7
        assert abs(_inv(atlas._angle(involute)) / involute - 1) < MP.mpf(10) ** (-24 if k < 0 else -39)


def test_area_is_that_within_dense_points_of_its_outline() -> None:
    """z 18 of rack A, half a pitch: the rounding's contact as it rolls, the flank by radii, the shoelace formula."""
    z, alpha = 18, MP.mpf(ALPHA)
    own = [atlas._area(MP.mpf(m), z, alpha) for m in (1.0, 3.0)]
    assert abs(own[1] / own[0] - 9) < MP.mpf(10) ** -30
    r, rho, low = z / 2, 0.38, 1.25
    half = (math.pi / 2) / z + float(_inv(alpha))
    base, tip, depth = r * math.cos(ALPHA), r + 1.0, low - rho
    points: list[complex] = []
    # the flat of the rack's tip, half of it: its rounding's centre stands so far from the gap's middle
    mid = math.pi / 4 - low * math.tan(ALPHA) - rho * (1 / math.cos(ALPHA) - math.tan(ALPHA))
    count = 4000
    for k in range(count + 1):
        # contact angles of the rounding, from the flat of its tip to its flank
        u = (math.pi / 2 - ALPHA) * k / count
        shift = depth * math.tan(u)
        place = complex(r - depth, shift) - cmath.rect(rho, -u)
        points.append(place * cmath.exp(1j * (mid - shift) / r))
    start = abs(points[-1])
    for k in range(count + 1):
        radius = start + (tip - start) * k / count
        a = math.acos(base / radius)
        # from the middle of the gap
        turn = math.pi / z - half + math.tan(a) - a
        points.append(cmath.rect(radius, turn))
    sides = itertools.pairwise(points)
    between = abs(sum((a.conjugate() * b).imag for a, b in sides)) / 2
    bottom = (r - low) ** 2 * mid / r / 2
    top = tip**2 * (math.pi / z - cmath.phase(points[-1])) / 2
    assert float(own[0]) == pytest.approx(2 * z * (between + bottom + top), rel=1e-6)

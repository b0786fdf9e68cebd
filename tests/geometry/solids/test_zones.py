"""Zones of tolerance against tables of ISO 286-2 as they are printed elsewhere, and the formulas of ISO 286-1."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from geometry.solids.zones import GRADES, HOLES, SHAFTS, zone_limits

# a dealer's sheet: sizes up to, mm, then upper and lower deviations of H7, H8, f7, g6, k6, n6, um
PRINTED = (
    (3, (10, 0), (14, 0), (-6, -16), (-2, -8), (6, 0), (10, 4)),
    (6, (12, 0), (18, 0), (-10, -22), (-4, -12), (9, 1), (16, 8)),
    (10, (15, 0), (22, 0), (-13, -28), (-5, -14), (10, 1), (19, 10)),
    (18, (18, 0), (27, 0), (-16, -34), (-6, -17), (12, 1), (23, 12)),
    (30, (21, 0), (33, 0), (-20, -41), (-7, -20), (15, 2), (28, 15)),
    (50, (25, 0), (39, 0), (-25, -50), (-9, -25), (18, 2), (33, 17)),
    (80, (30, 0), (46, 0), (-30, -60), (-10, -29), (21, 2), (39, 20)),
    (120, (35, 0), (54, 0), (-36, -71), (-12, -34), (25, 3), (45, 23)),
)


def told(zone: str, size: float) -> tuple[float, float]:
    """Upper and lower deviation, um."""
    lower, upper = zone_limits(zone, size)
    return round(1000 * upper, 6), round(1000 * lower, 6)


@pytest.mark.parametrize("row", PRINTED, ids=lambda row: str(row[0]))
def test_zones_are_those_that_are_printed(row: tuple[int, *tuple[tuple[int, int], ...]]) -> None:
    end, *printed = row
    for zone, limits in zip(("H7", "H8", "f7", "g6", "k6", "n6"), printed, strict=True):
        assert told(zone, end) == told(zone, end - 0.5) == limits, zone
        # the next step begins just above
        assert told(zone, end + 1e-6) != limits, zone


def test_tolerances_are_those_of_the_unit_within_the_rounding_of_the_table() -> None:
    """IT6 to IT12 are 10, 16, 25, 40, 64, 100, 160 i, i = 0.45 cbrt(D) + 0.001 D, D the geometric mean of a step."""
    steps = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
    for low, high in pairwise(steps):
        mean = math.sqrt(low * high)
        unit = 0.45 * math.cbrt(mean) + 0.001 * mean
        for grade, share in zip(GRADES, (10, 16, 25, 40, 64, 100, 160), strict=True):
            upper, lower = told(f"H{grade}", high)
            assert (upper, lower) == (pytest.approx(share * unit, rel=0.08, abs=0.7), 0), (high, grade)
            assert told(f"h{grade}", high) == (0, -upper)
            assert told(f"js{grade}", high) == told(f"Js{grade}", high) == (upper / 2, -upper / 2)


def test_deviations_of_shafts_follow_their_formulas() -> None:
    """ISO 286-1: d 16 D^0.44, e 11 D^0.41, f 5.5 D^0.41, g 2.5 D^0.34, n 5 D^0.34, a 265 + 1.3 D up to 120, 3.5 D."""
    steps = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
    for low, high in pairwise(steps):
        mean = math.sqrt(low * high)
        for letter, share, power in (("d", 16, 0.44), ("e", 11, 0.41), ("f", 5.5, 0.41), ("g", 2.5, 0.34)):
            upper, lower = told(f"{letter}8", high)
            assert upper == pytest.approx(-share * mean**power, rel=0.05, abs=0.7), (letter, high)
            assert upper - lower == told("H8", high)[0]
        assert told("n6", high)[1] == pytest.approx(5 * mean**0.34, rel=0.05, abs=0.7)
        assert told("k8", high)[1] == 0 < told("k7", high)[1]
        # holes mirror them
        assert (told("D9", high)[1], told("F8", high)[1]) == (-told("d9", high)[0], -told("f8", high)[0])
    finer = (6, 10, 18, 30, 40, 50, 65, 80, 100, 120, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400, 450, 500)
    for low, high in pairwise(finer):
        mean = math.sqrt(low * high)
        wanted = 265 + 1.3 * mean if high <= 120 else 3.5 * mean
        assert told("a11", high)[0] == pytest.approx(-wanted, rel=0.03), high
    assert told("a11", 3) == (-270, -330)


@pytest.mark.parametrize("letter", [*HOLES, *SHAFTS])
def test_every_zone_has_limits_for_every_size(letter: str) -> None:
    for grade in GRADES:
        for size in (0.5, 2.5, 125.0, 500.0):
            lower, upper = zone_limits(f"{letter}{grade}", size)
            assert lower < upper

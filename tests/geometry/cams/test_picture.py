"""Lines that two cams draw: how far places are from a line, beyond its corners too."""

from __future__ import annotations

import numpy as np
import pytest

from geometry.cams.picture import farthest

SQUARE = np.array([0, 10, 10 + 10j, 10j])


@pytest.mark.parametrize(("place", "off"), [(5 - 2j, 2.0), (13 - 4j, 5.0), (-0.3 + 10.4j, 0.5), (5 + 4j, 4.0)])
def test_the_distance_beyond_a_corner_is_that_from_it(place: complex, off: float) -> None:
    assert farthest(np.array([place]), SQUARE) == pytest.approx(off)
    # of some places the farthest
    assert farthest(np.array([5 + 0j, place, 10 + 1j]), SQUARE) == pytest.approx(off)

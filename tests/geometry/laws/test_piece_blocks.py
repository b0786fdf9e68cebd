"""Many arguments are evaluated in blocks, with the values that each has alone."""

from __future__ import annotations

import numpy as np
import pytest

from geometry.laws.law import Law
from geometry.laws.named import modified_sine, polynomial_345


@pytest.mark.parametrize("law", [polynomial_345(), modified_sine()], ids=lambda law: law.name)
def test_long_arrays_have_the_values_of_short_ones(law: Law) -> None:
    piece = law.pieces[0]
    t = np.linspace(piece.start, piece.end, 7001).reshape(7001, 1)
    for order, whole in enumerate(piece.values(t, 3)):
        assert whole.shape == t.shape
        alone = np.concatenate([piece.value(part, order) for part in np.array_split(t.ravel(), 97)])
        assert np.array_equal(whole.ravel(), alone)

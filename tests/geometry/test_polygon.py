"""Rounded polygons moved exactly, against the buffers of shapely."""

from __future__ import annotations

import cmath

import numpy as np
import pytest
import shapely

from geometry.errors import OffsetError
from geometry.measure import profile_area
from geometry.polygon import rectangle, rounded_polygon, stadium
from geometry.profile import Label, Profile

CROSS = [0, 10, 10 + 4j, 16 + 5j, 12 + 14j, 7 + 14j, 7 + 8j, 0 + 9j]


def shape(profile: Profile) -> shapely.Polygon:
    points = np.concatenate([s.curve.point(np.linspace(*s.curve.domain, 400))[:-1] for s in profile.segments()])
    return shapely.Polygon(np.c_[points.real, points.imag])


@pytest.mark.parametrize("offset", [0.0, 0.4, 1.3, -0.4, -1.3])
@pytest.mark.parametrize("radius", [0.0, 0.7])
def test_a_moved_polygon_is_the_buffer(offset: float, radius: float) -> None:
    plain = rounded_polygon(CROSS, [radius] * len(CROSS), Label.BODY)
    moved = rounded_polygon(CROSS, [radius] * len(CROSS), Label.BODY, offset)
    # shapely simplifies by a hundredth of the distance first
    expected = shape(plain).buffer(offset, quad_segs=2000)
    assert shape(moved).symmetric_difference(expected).area < 2e-2
    assert profile_area(moved) == pytest.approx(expected.area, abs=2e-2)


@pytest.mark.parametrize("offset", [0.3, -0.3])
def test_a_hole_moves_into_itself(offset: float) -> None:
    corners = [z.conjugate() for z in rectangle(8.0, 5.0)]
    made = rounded_polygon(corners, [1.0, 0.0, 1.0, 0.0], Label.BODY, offset)
    hole = shape(rounded_polygon(corners, [1.0, 0.0, 1.0, 0.0], Label.BODY)).buffer(-offset, quad_segs=2000)
    assert profile_area(made) == pytest.approx(-hole.area, abs=1e-3)
    slot = stadium(4.0, 10.0, 3 + 2j, offset)
    assert shape(slot).symmetric_difference(shape(stadium(4.0, 10.0, 3 + 2j, 0.0)).buffer(-offset, 2000)).area < 1e-3
    assert profile_area(slot) == pytest.approx(-(3.141592653589793 * (2 - offset) ** 2 + 10 * (4 - 2 * offset)))


def test_what_closes_names_an_offset_that_works() -> None:
    square = rectangle(4.0, 6.0)
    with pytest.raises(OffsetError) as caught:
        rounded_polygon(square, [0.0] * 4, Label.BODY, -2.5)
    assert caught.value.nearest == pytest.approx(-2.0, abs=1e-6)
    rounded_polygon(square, [0.0] * 4, Label.BODY, caught.value.nearest)
    with pytest.raises(OffsetError) as caught:
        stadium(4.0, 6.0, 0j, 2.5)
    stadium(4.0, 6.0, 0j, caught.value.nearest)
    with pytest.raises(OffsetError):
        rounded_polygon(square, [3.0] * 4, Label.BODY)


def test_a_straight_corner_is_none() -> None:
    corners = [0, 3, 6, 6 + 4j, 4j]
    made = rounded_polygon([c * cmath.exp(0.3j) for c in corners], [0.0] * 5, Label.BODY, 0.5)
    assert profile_area(made) == pytest.approx(7 * 5 - (4 - 3.141592653589793) * 0.25)

"""Parallel keys against the published rows."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from geometry.solids.bores import KeywayBore
from geometry.solids.keyways import KEYWAY_TABLES, KeywayRow, depth_deviation, keyway_row
from tests.brute import works
from tests.geometry.solids.test_bores import outline

PUBLISHED = json.loads((Path(__file__).parents[2] / "published" / "parallel_keys.json").read_text(encoding="utf-8"))


@pytest.mark.parametrize("standard", KEYWAY_TABLES)
def test_keys_against_the_published_rows(standard: str) -> None:
    rows = KEYWAY_TABLES[standard]
    for key, name in (("over", "over"), ("to", "to"), ("b", "width"), ("h", "height"), ("t1", "shaft_depth"),
                      ("t2", "hub_depth")):  # fmt: skip
        assert [getattr(row, name) for row in rows] == PUBLISHED[key]
    for row in rows:
        least, most = next((low, high) for width, low, high in PUBLISHED["radius_up_to_width"] if row.width <= width)
        assert (row.least_radius, row.most_radius) == (least, most)
        # the key is as high as both keyways, less its clearance
        assert 0 < row.shaft_depth + row.hub_depth - row.height < 0.06 * row.height + 0.4


@pytest.mark.parametrize(("diameter", "width"), [(6, 2), (8, 2), (8.01, 3), (12, 4), (38, 10), (38.1, 12), (500, 100)])
def test_a_range_ends_with_its_upper_number(diameter: float, width: float) -> None:
    assert keyway_row("DIN 6885", diameter).width == width


@pytest.mark.parametrize("diameter", [5.99, 500.1, 0.1])
def test_a_shaft_without_a_key_is_refused(diameter: float) -> None:
    with pytest.raises(ParameterError) as caught:
        keyway_row("GOST 23360", diameter)
    assert caught.value.numbers == {"standard": "GOST 23360", "least": 6, "most": 500}
    assert keyway_row("GOST 23360", works(caught.value))


@pytest.mark.parametrize("row", KEYWAY_TABLES["DIN 6885"], ids=lambda row: f"{row.width:g}")
def test_every_row_makes_a_bore(row: KeywayRow) -> None:
    for diameter in (row.over + 0.01, row.to):
        bore = KeywayBore(diameter, row.width, row.hub_depth, row.most_radius)
        bore.check()
        # across bore and keyway, as the hub is gauged: d + t2
        points = outline(bore.profile())
        assert np.ptp(points.real) == pytest.approx(diameter + row.hub_depth, rel=1e-4)


@pytest.mark.parametrize(
    ("to", "wanted"),
    [(row.to, 0.1 if row.to <= 22 else 0.2 if row.to <= 130 else 0.3) for row in KEYWAY_TABLES["DIN 6885"]],
)
def test_deviations_of_depths_are_those_of_gb_t_1563(to: float, wanted: float) -> None:
    """+0.1 up to 22 mm, +0.2 up to 130 mm, +0.3 beyond, of keyways as they are in the table alone."""
    row = next(row for row in KEYWAY_TABLES["DIN 6885"] if row.to == to)
    for in_shaft, depth in ((True, row.shaft_depth), (False, row.hub_depth)):
        for diameter in (row.over, (row.over + row.to) / 2, row.to):
            assert depth_deviation(diameter, row.width, depth, in_shaft=in_shaft) == wanted
        assert depth_deviation(row.to, row.width, depth + 1e-6, in_shaft=in_shaft) is None
        assert depth_deviation(row.to + 0.01, row.width, depth, in_shaft=in_shaft) is None
        assert depth_deviation(row.over - 0.01, row.width, depth, in_shaft=in_shaft) is None
        assert depth_deviation(row.to, row.width + 0.5, depth, in_shaft=in_shaft) is None
    assert depth_deviation(row.to, row.width, row.shaft_depth, in_shaft=False) is None

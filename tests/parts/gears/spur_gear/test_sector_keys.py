"""Any table of a sector either builds, a sound part of the whole gear, or is refused in one of its keys."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely.geometry import Point

from geometry.solids.mass import body_moments
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from tests.geometry.gears.teeth.test_sector import polygon
from tests.sampling import examples


@st.composite
def gears(draw: st.DrawFn) -> dict[str, Any]:
    """Gears and rings of module 2 with tables of which many have no room."""
    ring = draw(st.booleans())
    z = draw(st.integers(30, 80) if ring else st.integers(10, 60))
    size = st.floats(0.05, 1.3).map(lambda share: round(2.0 * z * share, 2))
    table: dict[str, Any] = {"teeth": draw(st.integers(1, z))}
    for key, values in (
        ("first_tooth", st.integers(-z, z)), ("runs", st.integers(1, 6)), ("blank_diameter", size),
        ("corner_radius", st.floats(0.01, 3.0) | st.floats(3.0, 60.0)),
        *(() if ring else (("rest", st.sampled_from(["blank", "cut"])), ("hub_diameter", size))),
    ):  # fmt: skip
        if draw(st.integers(0, 2)) == 0:
            table[key] = draw(values)
    kind = {"kind": "ring_gear", "outer_diameter": 2.0 * z + 20.0} if ring else {"kind": "spur_gear"}
    bore = {} if ring or draw(st.booleans()) else {"bore_diameter": draw(st.floats(1.0, 1.5 * z))}
    return {**kind, **bore, "module": 2.0, "number_of_teeth": z, "face_width": 5.0, "sector": table}


def outcome(keys: dict[str, Any]) -> Any:
    """The part, or how it is refused."""
    try:
        parts, _ = make_parts(scene_from_dict({"parts": {"g": keys}}, "t", "t"), "t")
    except SceneError as refusal:
        return refusal
    return parts["g"]


@given(gears())
@examples(80)
def test_a_table_builds_or_is_refused(keys: dict[str, Any]) -> None:
    made = outcome(keys)
    if isinstance(made, SceneError):
        assert "parts.g." in str(made)
        return
    region = made.section(0.0).region
    shape = polygon(region.outer).difference(polygon(region.holes[0])) if region.holes else polygon(region.outer)
    assert shape.is_valid
    assert shape.geom_type == "Polygon"
    # the solid is that section, extruded; chords of it are so near
    volume = body_moments(made.body(0.0)).volume
    assert abs(volume / (5.0 * shape.area) - 1) < 1e-3
    whole = outcome({k: v for k, v in keys.items() if k != "sector"})
    assert volume < body_moments(whole.body(0.0)).volume


@pytest.mark.parametrize(("bore", "hub"), [(0.0, 75.0 / 4), (8.0, 75.0 / 4), (12.0, 24.0)])
def test_the_hub_of_a_cut_sector_is_a_quarter_of_the_roots_or_twice_the_bore(bore: float, hub: float) -> None:
    """By the outline: module 2 and 40 teeth of 2.5 modules below the reference circle of 80 have roots at 75 mm."""
    keys = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 40, "face_width": 5.0, "bore_diameter": bore}
    outline = polygon(outcome(keys | {"sector": {"teeth": 9, "rest": "cut"}}).section(0.0).region.outer)
    assert 2 * outline.exterior.distance(Point(0, 0)) == pytest.approx(hub, rel=1e-3)

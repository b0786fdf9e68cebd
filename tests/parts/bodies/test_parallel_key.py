"""Keys: volumes by integrals of their sections, sizes by the standards, refusals that name what works."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from geometry.solids.mass import body_moments
from parts.base.part import Part
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from tests.exporters.making import run, write_scene

Keys = dict[str, Any]


def made(**keys: Any) -> Part:
    """The part of its keys."""
    table = {"kind": "key", "length": 20.0, **keys}
    return make_parts(scene_from_dict({"parts": {"a": table}}, "t", "t"), "t")[0]["a"]


@pytest.mark.parametrize(("form", "rounds"), [("A", 2), ("B", 0), ("C", 1)])
@pytest.mark.parametrize("chamfer", [0.0, 0.4])
def test_volumes_are_integrals_of_the_sections(form: str, rounds: int, chamfer: float) -> None:
    """At a depth t within a chamfer the area is that of a key 2 t narrower and shorter, its round ends r - t."""
    part = made(width=8.0, height=7.0, form=form, chamfer=chamfer)

    def area(t: float) -> float:
        return (20 - 2 * t) * (8 - 2 * t) - rounds * (2 - math.pi / 2) * (4 - t) ** 2

    # Simpson's rule holds of quadratics
    end = chamfer / 6 * (area(0.0) + 4 * area(chamfer / 2) + area(chamfer))
    volume = body_moments(part.body(0.0)).volume
    assert volume == pytest.approx((7 - 2 * chamfer) * area(0.0) + 2 * end, rel=1e-12)
    assert part.is_plate is (chamfer == 0)


@pytest.mark.parametrize(
    ("diameter", "size", "chamfer"),
    [(6, (2, 2), 0.16), (18, (6, 6), 0.25), (22.01, (8, 7), 0.25), (58, (16, 10), 0.4), (500, (100, 50), 2.5)],
)
def test_a_shaft_has_the_key_of_the_standards(diameter: float, size: tuple[float, float], chamfer: float) -> None:
    """b x h and the least chamfers of GOST 23360-78, table 1."""
    thing = made(shaft_diameter=float(diameter), length=200.0).thing
    assert ((thing.width, thing.height), thing.chamfer) == (size, chamfer)


@pytest.mark.parametrize(
    ("keys", "key", "works"),
    [
        ({}, "width", None),
        ({"width": 6.0}, "height", None),
        ({"shaft_diameter": 18.0, "width": 6.0}, "width", "left out"),
        ({"shaft_diameter": 5.0}, "shaft_diameter", 6.0),
        ({"shaft_diameter": 18.0, "length": 6.0}, "length", 6.0),
        ({"shaft_diameter": 18.0, "form": "C", "length": 2.0}, "length", 3.0),
        ({"shaft_diameter": 18.0, "chamfer": 3.0}, "chamfer", 3.0),
    ],
)
def test_bad_keys_are_refused_with_what_works(keys: Keys, key: str, works: float | str | None) -> None:
    with pytest.raises(SceneError) as refused:
        made(**keys)
    assert refused.value.key == f"parts.a.{key}"
    nearest = refused.value.nearest
    assert (nearest is None) == (works is None)
    if nearest is not None:
        assert nearest.value == (None if works == "left out" else pytest.approx(works, abs=2e-4))
        made(**{name: value for name, value in (keys | {key: nearest.value}).items() if value is not None})


def test_files_are_read_back(tmp_path: Path) -> None:
    parts = {form.lower(): {"kind": "key", "shaft_diameter": 18.0, "length": 20.0, "form": form} for form in "AC"}
    exports = [{"format": "step"}, {"format": "stl"}, {"format": "dxf", "purpose": "part"}]
    assert run("build", write_scene(tmp_path / "s.toml", parts, exports), "--out", tmp_path) == 0
    # the edges of round ends are cones, two of each
    assert (tmp_path / "s" / "a.step").read_text(encoding="utf-8").count("CONICAL_SURFACE") == 4

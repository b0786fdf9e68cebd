"""Lengths hardly above 0: what may be 0 is 0, or as long as files tell it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from exporters.command.cli import main
from geometry.base.errors import Nearest
from parts.base.refusal import SceneError
from tests.offered import put
from tests.parts.limits import refused, scene_of

GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20}
KEYED = GEAR | {"bore": {"shape": "keyway", "diameter": 12.0}}
SIX = GEAR | {"bore": {"shape": "hexagon", "across_flats": 12.0}}
HOLED = GEAR | {"holes": [{"count": 4, "diameter": 3.0, "pitch_circle_diameter": 24.0}]}
CUT = GEAR | {"cutter": {"number_of_teeth": 25}}
PLACES: list[tuple[dict[str, Any], tuple[str | int, ...], str]] = [
    (GEAR, ("tip_chamfer",), "mm"),
    (GEAR, ("tip_rounding",), "mm"),
    (GEAR, ("bore_diameter",), "mm"),
    (KEYED, ("bore", "corner_radius"), "mm"),
    (SIX, ("bore", "corner_radius"), "mm"),
    (CUT, ("cutter", "tip_rounding_coefficient"), "modules"),
    ({"kind": "timing_pulley", "belt": "GT2", "number_of_teeth": 20}, ("clearance",), "mm"),
]


@pytest.mark.parametrize(("part", "place", "unit"), PLACES, ids=lambda one: str(one)[:40])
def test_a_length_hardly_above_zero_is_refused_by_its_key(
    part: dict[str, Any], place: tuple[str | int, ...], unit: str
) -> None:
    """Before, their files failed their read-back: a chamfer of 1e-9 mm, a rounding of 1e-7 mm in STL."""
    for value in (1e-11, 1e-9, 1e-7, 0.99e-4):
        refusal = refused(put(scene_of(part), ("parts", "p", *place), value))
        assert isinstance(refusal, SceneError)
        assert (refusal.key, refusal.value) == (f"parts.p.{'.'.join(map(str, place))}", value)
        assert (refusal.code, refusal.unit) == ("hardly_above_zero", unit)
        assert refusal.nearest == Nearest(1e-4, "at_least")
    for value in (0.0, 1e-13, 1e-4):
        assert refused(put(scene_of(part), ("parts", "p", *place), value)) is None


@pytest.mark.parametrize(
    ("part", "keys"), [(GEAR, "tip_chamfer"), (GEAR, "tip_rounding"), (KEYED, "corner"), (SIX, "corner")]
)
def test_the_least_length_is_built(part: dict[str, Any], keys: str, tmp_path: Path) -> None:
    """STL keeps seven digits of a place: 1e-6 mm on a gear of 44 mm are none of them."""
    lines = [f"{name} = {value!r}".replace("'", '"') for name, value in part.items() if name != "bore"]
    if "bore" in part:
        size = "diameter" if part is KEYED else "across_flats"
        lines.append(f'bore = {{ shape = "{part["bore"]["shape"]}", {size} = 12.0, corner_radius = 1e-4 }}')
    else:
        lines.append(f"{keys} = 1e-4")
    exports = "".join(f'\n[[exports]]\nformat = "{form}"\n' for form in ("dxf", "stl", "step"))
    scene = tmp_path / "tiny.toml"
    scene.write_text("[parts.p]\n" + "\n".join(lines) + "\n" + exports, "utf-8")
    assert main(["build", str(scene), "--out", str(tmp_path / "out")]) == 0

"""Lengths hardly above 0: what may be 0 is 0, or as long as files tell it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from exporters.command.cli import main
from parts.base.refusal import SceneError, sentence
from tests.exporters.making import table
from tests.offered import PHASES, put
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
        assert (refusal.code, refusal.nearest) == ("hardly_above_zero", None)
        assert f"allowed are 0, or 0.0001 {unit} and more" in sentence(refusal, "en")
    for value in (0.0, 1e-13, 1e-4):
        assert refused(put(scene_of(part), ("parts", "p", *place), value)) is None


@pytest.mark.parametrize(
    ("part", "keys"), [(GEAR, "tip_chamfer"), (GEAR, "tip_rounding"), (KEYED, "corner"), (SIX, "corner")]
)
def test_the_least_length_is_built(part: dict[str, Any], keys: str, tmp_path: Path) -> None:
    """STL keeps seven digits of a place: 1e-6 mm on a gear of 44 mm are none of them."""
    rounded = {"bore": part["bore"] | {"corner_radius": 1e-4}} if "bore" in part else {keys: 1e-4}
    assert built(part | rounded, tmp_path) == 0


def built(part: dict[str, Any], folder: Path) -> int:
    """The exit code of the build of a part, read back."""
    scene = folder / "tiny.toml"
    exports = "".join(table("[[exports]]", {"format": form}) for form in ("dxf", "stl", "step"))
    scene.write_text(table("[parts.p]", part) + exports, "utf-8")
    return main(["build", str(scene), "--out", str(folder / "out")])


GROOVED = {"kind": "shaft", "steps": [{"diameter": 20.0, "length": 40.0,
                                       "grooves": [{"at": 20.0, "width": 1.3, "diameter": 18.0}]}]}  # fmt: skip
BARREL = {"kind": "barrel_cam", "form": "groove", "outer_diameter": 60.0, "groove_depth": 5.0, "roller_diameter": 8.0,
          "lift": 15.0, "end_margin": 4.0, "phases": PHASES}  # fmt: skip


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("part", "place"),
    [(GROOVED, ("steps", 0, "grooves", 0, "width")), (BARREL, ("groove_depth",)), (BARREL, ("end_margin",))],
)
def test_grooves_and_their_margins_are_a_hundredth_at_least(
    part: dict[str, Any], place: tuple[str | int, ...], tmp_path: Path
) -> None:
    """Of 0.0001 mm their STL failed: no triangle of the groove, no wall for the roller."""
    refusal = refused(put(scene_of(part), ("parts", "p", *place), 1e-4))
    assert isinstance(refusal, SceneError)
    assert refusal.code == "not_allowed"
    assert "at least 0.01, " in str(refusal)
    least = put(scene_of(part), ("parts", "p", *place), 0.01)
    assert built(least["parts"]["p"], tmp_path) == 0

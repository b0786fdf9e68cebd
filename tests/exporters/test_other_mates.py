"""Scenes whose mates are no pairs of involute gears: what is told of sheets, and in Ukrainian."""

from __future__ import annotations

import msgspec
import pytest

from exporters.plan import plan_build
from exporters.words_errors import piece_in_ukrainian
from parts.scene import load_scene, scene_from_dict
from parts.schema import SceneError


def test_a_sheet_of_meshing_shows_involute_gears_only() -> None:
    part = {"kind": "pin", "diameter": 8.0, "length": 10.0}
    other = scene_from_dict({"parts": {"a": part}, "exports": [{"format": "sheet"}]}, "t", "t")
    scene = msgspec.structs.replace(load_scene("lantern_pair"), exports=other.exports)
    with pytest.raises(SceneError, match="involute gears only; remove it"):
        plan_build(scene, "t", [], [])


@pytest.mark.parametrize("piece", [
    "shows pairs of involute gears only", "the roots reach the axis", "too slender to compute",
    "is held, but other mates join it to disc, which turns in it", "turns the ring ring, which is held",
    "the mate closes where it has a whole number of lobes", "is not of the first gear's pair",
])  # fmt: skip
def test_their_refusals_are_told_in_ukrainian(piece: str) -> None:
    assert piece_in_ukrainian(piece) is not None

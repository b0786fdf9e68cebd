"""Scenes whose mates are no pairs of involute gears: what is told of sheets, and in Ukrainian."""

from __future__ import annotations

import msgspec
import pytest

from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.scene.load import load_scene, scene_from_dict


def test_a_sheet_of_meshing_shows_involute_gears_only() -> None:
    part = {"kind": "pin", "diameter": 8.0, "length": 10.0}
    other = scene_from_dict({"parts": {"a": part}, "exports": [{"format": "sheet"}]}, "t", "t")
    scene = msgspec.structs.replace(load_scene("lantern_pair"), exports=other.exports)
    with pytest.raises(SceneError) as caught:
        plan_build(scene, "t", [], [])
    assert (caught.value.key, caught.value.code) == ("exports[1].purpose", "shows_gear_pairs")

"""Every named number of a part has its words: a picture that prints a key has none for it."""

from __future__ import annotations

import pytest

from parts.base.part import Part
from parts.base.registry import KINDS
from parts.base.texts import words
from parts.scene.files import built_in_scenes
from parts.scene.load import load_scene, make_parts, scene_from_dict
from parts.texts.quantities import QUANTITIES, quantity_name
from tests.offered import scenes


def _nameless(part: Part) -> set[str]:
    return {name for name in part.circles | part.quantities if name not in QUANTITIES}


@pytest.fixture(scope="module")
def every_part() -> list[Part]:
    """Those of all built-in scenes, and of scenes of every kind of part and of mate."""
    loaded = {name: load_scene(name) for name in built_in_scenes()}
    loaded |= {name: scene_from_dict(raw, name, name) for name, raw in scenes().items() if name not in loaded}
    return [part for name, scene in loaded.items() for part in make_parts(scene, name)[0].values()]


def test_every_number_of_every_kind_has_a_name(every_part: list[Part]) -> None:
    assert {part.kind for part in every_part} >= set(KINDS) - {"step_part"}
    assert {(part.kind, name) for part in every_part for name in _nameless(part)} == set()


def test_a_number_without_a_name_is_found(every_part: list[Part], monkeypatch: pytest.MonkeyPatch) -> None:
    """The width of a bevel gear once stood in its picture as ``face_width``."""
    told = {quantity_name(words("uk"), name) for name in QUANTITIES}
    assert not told & set(QUANTITIES)
    monkeypatch.delitem(QUANTITIES, "face_width")
    assert {part.kind for part in every_part if _nameless(part)} == {"bevel_gear"}

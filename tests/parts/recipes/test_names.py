"""An assembly under a name of its own is the same assembly: every id in its tables, nested ones too, takes the name."""

from __future__ import annotations

import tomllib
from typing import Any

import numpy as np
import pytest

from exporters.command.new import new_assembly
from parts.recipes.registry import RECIPES
from parts.scene.load import scene_from_dict
from tests.parts.recipes.test_power_table import placed

# the power module makes forty parts for its places; its tables are those of the others
QUICK = [kind for kind in RECIPES if kind != "power_module"]


def stands(kind: str, name: str | None) -> dict[str, Any]:
    raw = tomllib.loads(new_assembly(kind))
    if name is not None:
        raw["assemblies"][0]["name"] = name
    placing, parts = placed(scene_from_dict(raw, "s.toml", "s"))
    return {
        i.id: (i.part, *i.at, i.rotation, *i.axis, sorted(map(repr, parts[i.part].report.quantities.items())))
        for i in placing.instances
    }


@pytest.mark.parametrize("kind", QUICK)
def test_an_assembly_stands_alike_under_a_name(kind: str) -> None:
    plain, named = stands(kind, None), stands(kind, "a")
    assert [f"a_{key}" for key in plain] == list(named)
    for (part, *place, sizes), (own_part, *own_place, own_sizes) in zip(plain.values(), named.values(), strict=True):
        assert own_part == f"a_{part}"
        assert np.allclose(place, own_place, rtol=0, atol=1e-12)
        assert own_sizes == sizes

"""What a refusal offers is tried: it works, and a limit is one, a thousandth further does not."""

from __future__ import annotations

import copy
import re
from typing import Any

import pytest

from parts.base.refusal import SceneError
from tests.parts.positive_scenes import Keys, parts_of


def refused(parts: dict[str, Keys]) -> SceneError:
    """The refusal of parts."""
    with pytest.raises(SceneError) as caught:
        parts_of(parts)
    assert "\n" not in str(caught.value)
    # every code has its sentence, with all its numbers
    assert "_" not in caught.value.code or caught.value.code not in str(caught.value)
    assert "{" not in str(caught.value).replace("= {", "")
    return caught.value


def put(parts: dict[str, Keys], key: str, value: Any) -> dict[str, Keys]:
    """The parts with the value at a key, ``parts.cam.phases[1].law``; None: without it."""
    made: Any = copy.deepcopy(parts)
    found = re.findall(r"\[(\d+)\]|([^.[]+)", key.removeprefix("parts."))
    *steps, last = [int(number) - 1 if number else word for number, word in found]
    held = made
    for step in steps:
        held = held[step]
    if value is None:
        held.pop(last, None)
    else:
        held[last] = value
    return made


def cured(parts: dict[str, Keys], refusal: SceneError) -> dict[str, Keys]:
    """The parts with what the refusal offers: they build, and do not where a limit is passed."""
    nearest = refusal.nearest
    assert nearest is not None, refusal
    better = put(parts, refusal.key, nearest.value)
    parts_of(better)
    if nearest.side != "exactly" and isinstance(nearest.value, int | float):
        step = 1e-3 * abs(nearest.value) if isinstance(nearest.value, float) else 1
        beyond = nearest.value + (step if nearest.side == "at_most" else -step)
        with pytest.raises(SceneError):
            parts_of(put(parts, refusal.key, beyond))
    return better

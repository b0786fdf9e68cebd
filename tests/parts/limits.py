"""A limit of one key, worked out by hand: what lies beyond is refused and told it, what lies within is built."""

from __future__ import annotations

import math
from typing import Any

import pytest

from geometry.base.errors import GeometryError, OffsetError
from parts.base.refusal import SceneError, sentence
from parts.scene.load import make_parts, scene_from_dict
from tests.offered import GONE, Raw, at, put
from tests.parts.scene.test_offers import place_of

# parts of a limit: how far beside it is tried, and within which it is told
BESIDE, TOLD = 4e-6, 2.5e-6


def refused(raw: Raw) -> SceneError | None:
    """The refusal of a scene's parts and mates; None where they are made."""
    try:
        make_parts(scene_from_dict(raw, "s", "s"), "s")
    except SceneError as refusal:
        return refusal
    return None


def scene_of(part: dict[str, Any]) -> Raw:
    """A scene of one part, ``p``."""
    return {"parts": {"p": part}, "exports": [{"format": "svg"}]}


def with_key(raw: Raw, key: str, value: object) -> Raw:
    """The scene with a key, as refusals write it, of another value; ``GONE``: without it."""
    place = place_of(key)
    return raw if value is GONE and at(raw, place) is GONE else put(raw, place, value)


def check_limit(
    raw: Raw, key: str, code: str, limit: float, side: str, *, near: float = BESIDE, **numbers: float
) -> None:
    """Holds a key against its limit: just beyond it is refused by its code and told the limit, just within not.

    ``side``: "at_most" or "at_least"; ``near``: part of the limit that it is tried beside; ``numbers``: what the
    refusal tells besides.
    """
    limit = float(limit)
    way = near * max(abs(limit), 1e-3) * (1 if side == "at_most" else -1)
    assert refused(with_key(raw, key, limit - way)) is None
    refusal = refused(with_key(raw, key, limit + way))
    assert refusal is not None
    assert (refusal.key, refusal.code) == (key, code)
    assert refusal.value == pytest.approx(limit + way, rel=1e-12)
    for name, value in numbers.items():
        assert refusal.numbers[name] == pytest.approx(value, rel=1e-9), name
    found = refusal.nearest
    assert found is not None
    assert found.side == side
    assert isinstance(found.value, float)
    assert (limit - found.value) * way >= -1e-12 * abs(way)
    assert found.value == pytest.approx(limit, rel=near, abs=2e-6)


def check_offer(raw: Raw, key: str, value: float, code: str, limit: float, side: str, **numbers: float) -> None:
    """Holds a refused value to be told a limit from far off, where beyond the limit another key may be blamed."""
    refusal = refused(with_key(raw, key, value))
    assert refusal is not None
    assert (refusal.key, refusal.code, refusal.value) == (key, code, value)
    for name, told in numbers.items():
        assert refusal.numbers[name] == pytest.approx(told, rel=1e-9), name
    found = refusal.nearest
    assert found is not None
    assert found.side == side
    assert found.value == pytest.approx(limit, rel=BESIDE, abs=2e-6)
    assert refused(with_key(raw, key, found.value)) is None
    way = BESIDE * max(abs(limit), 1e-3) * (1 if side == "at_most" else -1)
    assert refused(with_key(raw, key, limit + way)) is not None


def check_refused(raw: Raw, key: str, value: object, code: str, works: object, **numbers: object) -> None:
    """Holds a value of a key to be refused by its code with a value of its own, which is built; ``...``: with none.

    Its line is told in both languages: a sentence may ask for what its numbers are not.
    """
    wrong = with_key(raw, key, value)
    refusal = refused(wrong)
    assert refusal is not None
    assert (refusal.key, refusal.code) == (key, code)
    assert refusal.value == (None if value is GONE else value)
    for name, told in numbers.items():
        assert refusal.numbers[name] == told, name
    assert all(refusal.key in sentence(refusal, language) for language in ("en", "uk"))
    found = refusal.nearest
    if works is ...:
        assert found is None
        return
    assert found is not None
    assert found.value == works
    assert refused(with_key(wrong, key, GONE if works is None else works)) is None


def offset_limits(
    part: dict[str, Any], low: float, high: float, *, body: bool = False, **others: dict[str, Any]
) -> None:
    """Holds the section (``body``: the solid) of a part to bear offsets between two limits, mm, and none beyond.

    What a refusal offers is the limit, and is borne; ``others``: parts that this one is made of. An infinite limit is
    none that is known here.
    """
    raw = scene_of(part)
    raw["parts"] |= others
    made = make_parts(scene_from_dict(raw, "s", "s"), "s")[0]["p"]
    build = made.body if body else made.section
    for limit, way in ((low, -1), (high, 1)):
        if math.isinf(limit):
            continue
        build(limit - way * 1e-5)
        with pytest.raises(GeometryError) as caught:
            build(limit + way * 1e-5)
        if isinstance(caught.value, OffsetError) and caught.value.nearest_offset:
            assert caught.value.nearest_offset == pytest.approx(limit, rel=1e-5)
            build(caught.value.nearest_offset)

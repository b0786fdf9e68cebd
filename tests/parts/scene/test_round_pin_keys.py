"""Any keys of parts around pins and of cycloidal gears: built, or refused with values that lead to a part that is."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from parts.base.reasons import reason
from parts.base.refusal import SceneError
from parts.scene.load import make_parts, scene_from_dict
from tests.sampling import examples
from tests.strategies import numbers

Keys = dict[str, Any]


def optional(value: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    """Left out as often as not."""
    return st.one_of(st.none(), value)


def keys_of(kind: str, **values: st.SearchStrategy[Any]) -> st.SearchStrategy[Keys]:
    """Tables of a kind; what is None is left out."""
    made = st.fixed_dictionaries({"kind": st.just(kind), **values})
    return made.map(lambda table: {k: v for k, v in table.items() if v is not None})


sizes, small = numbers(0.05, 120), numbers(0, 3)
output_holes = st.fixed_dictionaries(
    {
        "count": st.integers(1, 12),
        "pitch_circle_diameter": numbers(1, 150),
        "pin_diameter": numbers(0.2, 40),
        "clearance": numbers(0, 1),
    }
)
ANY = st.one_of(
    keys_of(
        "cycloidal_disc",
        number_of_lobes=st.integers(2, 40),
        pin_circle_diameter=numbers(5, 200),
        pin_diameter=numbers(0.2, 60),
        eccentricity=numbers(1e-3, 20),
        pin_clearance=optional(numbers(-0.1, 1)),
        bore_diameter=optional(sizes),
        output_holes=optional(output_holes),
    ),
    keys_of(
        "pin_ring",
        number_of_pins=st.integers(3, 40),
        pin_circle_diameter=numbers(5, 200),
        pin_diameter=numbers(0.2, 60),
        pins=st.sampled_from(("half_round", "fixed", "holes")),
        seat_clearance=optional(numbers(-0.3, 2)),
        inner_diameter=optional(numbers(1, 240)),
        outer_diameter=optional(numbers(1, 400)),
    ),
    keys_of(
        "output_plate",
        number_of_pins=st.integers(1, 20),
        pin_circle_diameter=numbers(5, 200),
        pin_diameter=numbers(0.2, 60),
        pins=st.sampled_from(("solid", "holes")),
        seat_clearance=optional(numbers(-0.3, 2)),
        outer_diameter=optional(numbers(1, 400)),
        bore_diameter=optional(sizes),
    ),
    keys_of(
        "lantern_wheel",
        number_of_pins=st.integers(3, 20),
        pin_circle_diameter=numbers(5, 200),
        pin_diameter=numbers(0.2, 60),
        pins=st.sampled_from(("solid", "holes")),
        bore_diameter=optional(sizes),
    ),
    keys_of(
        "lantern_gear",
        number_of_teeth=st.integers(3, 80),
        number_of_pins=st.integers(3, 40),
        pin_circle_diameter=numbers(5, 200),
        pin_diameter=numbers(0.2, 60),
        pin_clearance=optional(small),
        root_clearance=optional(small),
        tip_diameter=optional(numbers(1, 500)),
        bore_diameter=optional(sizes),
    ),
    keys_of(
        "cycloidal_gear",
        module=numbers(0.2, 5),
        number_of_teeth=st.integers(4, 80),
        mate_number_of_teeth=optional(st.integers(4, 80)),
        tip_rolling_diameter=optional(sizes),
        root_rolling_diameter=optional(sizes),
        addendum_coefficient=optional(numbers(0.1, 3)),
        dedendum_coefficient=optional(numbers(0.1, 5)),
        root_rounding=optional(small),
        circumferential_thinning=optional(numbers(0, 2)),
        bore_diameter=optional(sizes),
    ),
    keys_of("eccentric", diameter=sizes, eccentricity=numbers(0, 60), bore_diameter=optional(sizes)),
    keys_of("pin", diameter=sizes, length=sizes, bore_diameter=optional(sizes)),
)


def remedied(keys: Keys, refused: SceneError) -> Keys | None:
    """The keys as a refusal wants them; None where it says that no value of its key does."""
    cure = refused.nearest
    if cure is None:
        assert reason(refused.code) != refused.code, refused
        return None
    owner, *inner = refused.key.removeprefix("parts.part.").split(".")
    if not inner:
        return {k: v for k, v in (keys | {owner: cure.value}).items() if v is not None}
    (name,) = inner
    return keys | {owner: keys[owner] | {name: cure.value}}


@examples(100)
@given(ANY)
def test_any_part_is_built_or_refused_with_what_works(keys: Keys) -> None:
    """What is offered is built at once."""
    try:
        made(keys)
    except SceneError as refused:
        better = remedied(keys, refused)
        if better is not None:
            made(better)


def made(keys: Keys) -> None:
    """The part of these keys, with its section and its body."""
    part = make_parts(scene_from_dict({"parts": {"part": keys}}, "t", "t"), "t")[0]["part"]
    assert part.section(0.0).region.outer.reach() > 0
    assert part.body(0.0).caps


@pytest.mark.heavy
@settings(max_examples=2000, deadline=None)
@given(ANY)
def test_any_part_of_many(keys: Keys) -> None:
    test_any_part_is_built_or_refused_with_what_works.hypothesis.inner_test(keys)


def part_of(**table: Any) -> Any:
    return make_parts(scene_from_dict({"parts": {"p": table}}, "s", "s"), "s")[0]["p"]


def test_the_circle_that_is_told_takes_the_largest_pins() -> None:
    disc = {"kind": "cycloidal_disc", "number_of_lobes": 11, "pin_circle_diameter": 80.0, "pin_diameter": 6.0,
            "eccentricity": 1.5, "bore_diameter": 20.0}  # fmt: skip

    def wrong(circle: float) -> SceneError:
        with pytest.raises(SceneError) as refusal:
            part_of(**disc, output_holes={"count": 10, "pitch_circle_diameter": circle, "pin_diameter": 20.0})
        return refusal.value

    best = wrong(20.0).numbers["circle"]
    largest = [wrong(best * share).nearest.value for share in (0.9995, 1.0, 1.0005)]  # type: ignore[union-attr]
    assert largest[1] > max(largest[0], largest[2])


def test_a_ring_has_half_a_pin_inside_its_holes() -> None:
    ring = part_of(kind="pin_ring", pin_circle_diameter=80.0, pin_diameter=6.0, number_of_pins=12, pins="holes")
    assert ring.circles["inner_diameter"] == pytest.approx(80 - 6 - 6)

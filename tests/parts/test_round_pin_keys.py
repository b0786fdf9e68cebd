"""Any keys of the parts around pins: built, or refused with values that lead to a part that is built."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from parts.scene import make_parts, scene_from_dict
from parts.schema import SceneError
from tests.offered import offered
from tests.strategies import numbers

Keys = dict[str, Any]
LIMIT = re.compile(r"(?:at most |at least |; )(-?[0-9.]+)(?: mm)?(?: works| with ([a-z_]+) = ([0-9.]+)(?: mm)? works)")


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
    keys_of("eccentric", diameter=sizes, eccentricity=numbers(0, 60), bore_diameter=optional(sizes)),
    keys_of("pin", diameter=sizes, length=sizes, bore_diameter=optional(sizes)),
)


def remedied(keys: Keys, message: str) -> Keys:
    """The keys as a refusal wants them."""
    if made := offered({"parts": {"part": keys}}, "s: " + message.removeprefix("t: ")):
        return made[0]["parts"]["part"]
    blamed = re.search(r"parts\.part\.([a-z_]+)(?:\.([a-z_]+))? = ", message)
    assert blamed, message
    owner, inner = blamed.groups()
    if message.endswith(("without output_holes works", "with a smaller bore")):
        return {k: v for k, v in keys.items() if k not in ("output_holes", "bore_diameter")}
    found = LIMIT.search(message)
    if not found:
        pytest.fail(f"no remedy: {message}")
    values = {inner or owner: float(found[1])}
    if found[2]:
        values[found[2]] = float(found[3])
    changed = keys | ({owner: keys[owner] | values} if inner else values)
    if "with pin_clearance = 0 and root_clearance = 0" in message:
        changed |= {"pin_clearance": 0.0, "root_clearance": 0.0}
    return changed


@settings(max_examples=100, deadline=None)
@given(ANY)
def test_any_part_is_built_or_refused_with_what_works(keys: Keys) -> None:
    given_keys, messages = keys, []
    for _ in range(8):
        try:
            part = make_parts(scene_from_dict({"parts": {"part": keys}}, "t", "t"), "t")[0]["part"]
            break
        except SceneError as error:
            messages.append(str(error))
            keys = remedied(keys, messages[-1])
    else:
        pytest.fail(f"{given_keys}: {messages}")
    assert part.section(0.0).region.outer.reach() > 0
    assert part.body(0.0).caps


@pytest.mark.heavy
@settings(max_examples=2000, deadline=None)
@given(ANY)
def test_any_part_of_many(keys: Keys) -> None:
    test_any_part_is_built_or_refused_with_what_works.hypothesis.inner_test(keys)

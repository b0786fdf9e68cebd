"""Which cases of a long sweep run by default: a seeded sample that shows as many values of each parameter as it can.

``@pytest.mark.sampled(count)`` on a parametrised test leaves ``count`` of its cases as they are and marks the others
heavy. The choice hangs on the test's name and its cases alone, so that every worker makes the same.
``@examples(count)`` gives a search by hypothesis a quarter of its examples by default, ``some_of(cases, count)`` so
many of the cases of a loop within a test; all of them with ``-m heavy``.
"""

from __future__ import annotations

import random
from collections.abc import Hashable, Iterable, Mapping, Sequence
from itertools import combinations
from typing import Any, TypeVar

from hypothesis import settings

Case = Mapping[str, Hashable]
Value = tuple[str, Hashable]
T = TypeVar("T")

# of how many examples one is drawn; set before any test file is read
_EFFORT = {"one of": 4}


def take_all_examples() -> None:
    """From now on ``examples`` gives their full number."""
    _EFFORT["one of"] = 1


def examples(count: int, *, deadline: Any = None, **more: Any) -> settings:
    """The settings of a search by hypothesis: a quarter of ``count``, or all where the heavy tests are asked for."""
    return settings(max_examples=max(count // _EFFORT["one of"], 5), deadline=deadline, **more)


def some_of(cases: Iterable[T], count: int = 1) -> list[T]:
    """Of the cases that a test goes through by itself ``count``, the same in every run; all with ``-m heavy``.

    A test that asks for them is among the heavy ones too.
    """
    every = list(cases)
    count = len(every) if _EFFORT["one of"] == 1 else min(count, len(every))
    return [every[k] for k in sorted(random.Random(len(every)).sample(range(len(every)), count))]


def chosen(cases: Sequence[Case], count: int, seed: str) -> list[int]:
    """Places of ``count`` cases, in order; a case says which value each parameter has.

    One case after another, each with the most values, then the most pairs of values, that none before it has.
    """
    left = list(range(len(cases)))
    random.Random(seed).shuffle(left)
    values = [set(case.items()) for case in cases]
    pairs = [set(combinations(sorted(case.items(), key=lambda item: item[0]), 2)) for case in cases]
    seen: tuple[set[Value], set[tuple[Value, Value]]] = set(), set()
    found: list[int] = []
    while left and len(found) < count:
        best = max(left, key=lambda k: (len(values[k] - seen[0]), len(pairs[k] - seen[1])))
        left.remove(best)
        found.append(best)
        seen[0].update(values[best])
        seen[1].update(pairs[best])
    return sorted(found)

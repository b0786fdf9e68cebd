"""Sparse linear equations over the rational numbers: exact elimination, ranks, and what follows from what."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence, Set
from fractions import Fraction
from typing import Generic, TypeVar

from geometry.base.record import Record

K = TypeVar("K", bound=Hashable)
# the sum of coefficient times quantity is 0; no coefficient is 0
Row = dict[K, Fraction]


class Eliminated(Record, Generic[K]):
    """``solved``: each pivot's row as pivot = sum over what is no pivot, in the order in which they were found.

    ``left``: of each row that follows from those before it, by its index, what it says of the known quantities.
    """

    solved: Mapping[K, Row[K]]
    left: Mapping[int, Row[K]]

    @property
    def rank(self) -> int:
        """Number of independent rows."""
        return len(self.solved)


def eliminated(rows: Sequence[Mapping[K, Fraction]], known: Set[K] = frozenset()) -> Eliminated[K]:
    """Rows brought to the form in which each pivot is told by the free and the known quantities.

    No known quantity becomes a pivot; rows count in their order, so that a later one is said to follow from earlier.
    """
    solved: dict[K, Row[K]] = {}
    left: dict[int, Row[K]] = {}
    for index, given in enumerate(rows):
        row = _without_pivots(given, solved)
        pivot = next((key for key in row if key not in known), None)
        if pivot is None:
            left[index] = row
            continue
        scale = -1 / row.pop(pivot)
        solved[pivot] = {key: scale * value for key, value in row.items()}
    # a row may hold pivots that were found after it, never before
    for pivot in reversed(list(solved)):
        solved[pivot] = _without_pivots(solved[pivot], solved)
    return Eliminated(solved, left)


def _without_pivots(given: Mapping[K, Fraction], solved: Mapping[K, Row[K]]) -> Row[K]:
    row: Row[K] = {key: value for key, value in given.items() if value}
    waiting = [key for key in row if key in solved]
    while waiting:
        pivot = waiting.pop()
        share = row.pop(pivot, None)
        if share is None:
            continue
        for key, value in solved[pivot].items():
            total = row.get(key, 0) + share * value
            if not total:
                del row[key]
                continue
            if key not in row and key in solved:
                waiting.append(key)
            row[key] = total
    return row


def follows_from(rows: Sequence[Mapping[K, Fraction]], index: int, known: Set[K] = frozenset()) -> tuple[int, ...]:
    """Indices of the earlier rows of which a dependent row is a combination."""
    columns: dict[K, Row[int]] = {}
    for k, row in enumerate(rows[: index + 1]):
        for key, value in row.items():
            if key not in known:
                columns.setdefault(key, {})[k] = value
    shares = eliminated(list(columns.values()), {index}).solved
    return tuple(sorted(k for k, share in shares.items() if index in share))

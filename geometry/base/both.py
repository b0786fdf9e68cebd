"""What is told of both of a pair, one after the other."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

T = TypeVar("T")


def both(values: Iterable[T]) -> tuple[T, T]:
    """The two values, as types tell them apart from any number."""
    first, second = values
    return first, second

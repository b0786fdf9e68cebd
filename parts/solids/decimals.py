"""Points as lines of text, all of them at once: their digits are columns of one table of letters."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from geometry.curves.curve import Flags, Real
from geometry.solids.faces import Index

# codes of letters (n, k), or of (k,) that are the same in all rows, and which of them are written
_Letters: TypeAlias = tuple[NDArray[np.uint8], "Flags | bool"]

_ZERO, _AT_ONCE = ord("0"), 20_000


def point_lines(first: int, points: Real, digits: int) -> str:
    """The entities of points (n, 3), numbered from ``first`` on, a line each.

    Coordinates are rounded to ``digits`` decimals and written without zeros at their end.
    """
    hash_, head, comma, tail = map(_constant, ("#", "=CARTESIAN_POINT('',(", ",", "));\n"))
    found = []
    for start in range(0, len(points), _AT_ONCE):
        part = points[start : start + _AT_ONCE]
        ids = _whole(first + start + np.arange(len(part)), 1)
        x, y, z = _decimals(part, digits)
        found.append(_joined([hash_, ids, head, *x, comma, *y, comma, *z, tail], len(part)))
    return "".join(found)


def _joined(pieces: Sequence[_Letters], rows: int) -> str:
    """The text of pieces behind each other in every row."""
    width = sum(letters.shape[-1] for letters, _ in pieces)
    table, chosen, at = np.empty((rows, width), np.uint8), np.empty((rows, width), bool), 0
    for letters, written in pieces:
        own = slice(at, at := at + letters.shape[-1])
        table[:, own], chosen[:, own] = letters, written
    return table[chosen].tobytes().decode("ascii")


def _constant(text: str) -> _Letters:
    return np.frombuffer(text.encode("ascii"), np.uint8), True


def _whole(numbers: Index, least: int) -> tuple[NDArray[np.uint8], Flags]:
    """Numbers (n,) of no sign, with at least so many digits."""
    width = max(len(str(numbers.max())), least)
    letters, written = np.empty((width, len(numbers)), np.uint8), np.ones((width, len(numbers)), bool)
    for k in range(width - 1, -1, -1):
        if k < width - least:
            written[k] = numbers > 0
        tens = numbers // 10
        letters[k] = numbers - 10 * tens + _ZERO
        numbers = tens
    return letters.T, written.T


def _decimals(points: Real, digits: int) -> list[list[_Letters]]:
    """Of each column of points (n, 3) the letters, without the zeros at the end."""
    scaled = np.rint(points.ravel() * 10.0**digits).astype(np.int64)
    letters, written = _whole(np.abs(scaled), digits + 1)
    fraction = letters[:, -digits:]
    kept = np.logical_or.accumulate(fraction[:, ::-1] != _ZERO, axis=1)[:, ::-1]
    (minus, _), dot, is_less = _constant("-"), _constant("."), (scaled < 0)[:, None]
    return [
        [
            (minus, is_less[k::3]),
            (letters[k::3, :-digits], written[k::3, :-digits]),
            dot,
            (fraction[k::3], kept[k::3]),
        ]
        for k in range(3)
    ]

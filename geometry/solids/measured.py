"""An exact surface, by how far points lie from it."""

from __future__ import annotations

from collections.abc import Callable

from geometry.base.record import Record
from geometry.curves.curve import Real


class Measured(Record, eq=False):
    """An exact surface of a body: what it is called, and how far points (n, 3) lie from it, mm, also beyond it."""

    what: str
    distance: Callable[[Real], Real]

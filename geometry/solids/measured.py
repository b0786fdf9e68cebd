"""What files are held against: an exact surface of a body that is told by its faces."""

from __future__ import annotations

from collections.abc import Callable

from geometry.base.record import Record
from geometry.curves.curve import Real


class Measured(Record, eq=False):
    """An exact surface of a body: what it is called, and how far points (n, 3) lie from it, mm, also beyond it.

    ``turns``: so many equal turns of a whole one about the z axis bring it onto itself each; 0: any turn does.
    """

    what: str
    distance: Callable[[Real], Real]
    turns: int = 1

"""``higherpair calc involute``: inv and cos of an angle, the angle of an inv, or tables Д and Е of the practicum."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Annotated

from msgspec import Meta, Struct

from geometry.base.angles import inverse_involute, involute_function
from geometry.base.errors import Nearest, ParameterError
from parts.base.refusal import REMOVED
from parts.base.texts import N_
from parts.keys.base import degrees
from parts.pages.inputs import calculation
from parts.pages.misprints import printed_in_tables
from parts.pages.page import Sheet, Table

TOPIC = "involute"
# minutes between the columns of a table
_STEP = 10
# rows of the tables of the practicum, degrees
_FIRST, _LAST = 20, 40
_Row = Annotated[int, Meta(ge=0, le=88, extra={"unit": "degrees"})]


class InvoluteKeys(Struct, kw_only=True, forbid_unknown_fields=True):
    """Keys of the topic; without an angle or an involute the tables are printed."""

    angle_deg: Annotated[float, degrees("angle, for its involute and its cosine", least=0, most=89)] | None = None
    involute: Annotated[float, Meta(gt=0, le=50, description="inv alpha, whose angle is sought")] | None = None
    first_deg: Annotated[_Row, Meta(description="first row of the tables")] = _FIRST
    last_deg: Annotated[_Row, Meta(description="last row of the tables")] = _LAST


@calculation(TOPIC, InvoluteKeys)
def sheet(keys: InvoluteKeys) -> Sheet:
    """One angle, or both tables."""
    page = Sheet(TOPIC, N_("Involute function"))
    if keys.angle_deg is not None and keys.involute is not None:
        raise ParameterError("involute", keys.involute, "other_is_given", REMOVED, other="angle_deg")
    if keys.angle_deg is None and keys.involute is None:
        if keys.last_deg < keys.first_deg:
            raise ParameterError("last_deg", keys.last_deg, "before_first_row", Nearest(keys.first_deg))
        _tables(page, keys.first_deg, keys.last_deg)
        return page
    given = "involute" if keys.angle_deg is None else "angle_deg"
    for name, row, usual in (("first_deg", keys.first_deg, _FIRST), ("last_deg", keys.last_deg, _LAST)):
        if row != usual:
            raise ParameterError(name, row, "other_is_given", REMOVED, other=given)
    page.section("Angle")
    if keys.angle_deg is not None:
        angle = keys.angle_deg
        page.add("function_angle_deg", angle, given=True)
        page.add("involute_of_angle", involute_function(math.radians(angle)), "tan({alpha}) - {alpha}")
    else:
        assert keys.involute is not None
        angle = math.degrees(inverse_involute(keys.involute))
        page.add("involute_of_angle", keys.involute, given=True)
        page.add("function_angle_deg", angle, "arcinv({inv_alpha})")
    whole, minutes = divmod(round(600 * angle), 600)
    page.add("angle_in_minutes", f"{whole}°{minutes / 10:g}'")
    page.add("cosine_of_angle", math.cos(math.radians(angle)), "cos({alpha})")
    return page


def _tables(page: Sheet, first: int, last: int) -> None:
    """A row for each degree, a column for every ten minutes."""

    def table(name: str, title: str, function: Callable[[float], float]) -> Table:
        columns = range(0, 60, _STEP)
        rows = tuple(
            (float(row), *(function(math.radians(row + minute / 60)) for minute in columns))
            for row in range(first, last + 1)
        )
        return Table(name, title, (("α", "deg"), *((f"{minute}'", "") for minute in columns)), rows)

    page.tables += [
        table("involutes", N_("Involute function (practicum, table Д.1)"), involute_function),
        table("cosines", N_("Cosine (practicum, table Е.1)"), math.cos),
    ]
    page.notes += printed_in_tables(first, last)

"""Units that people write behind a number, and what it is in the unit of a key; angles in minutes and seconds."""

from __future__ import annotations

import re
from functools import cache

from parts.base.psv import rows_of

# 15°30'20"
_SEXAGESIMAL = re.compile(
    r"\s*([-\u2212\u2013]?)(\d+)\s*\u00b0\s*(\d+(?:[.,]\d+)?)\s*['\u2019\u2032]"
    r"(?:\s*(\d+(?:[.,]\d+)?)\s*(?:[\"\u2033\u201d]|'')?)?\s*"
)


@cache
def written_units() -> dict[str, tuple[float, str]]:
    """By a unit in small letters how many it is of which unit that keys have."""
    return {written: (float(size), unit) for written, size, unit in rows_of(__file__, "units")}


def sexagesimal(text: str) -> float | None:
    """Degrees, minutes and maybe seconds in degrees; None: the text is no such angle."""
    if (found := _SEXAGESIMAL.fullmatch(text)) is None:
        return None
    sign, *numbers = found.groups("0")
    degrees, minutes, seconds = (float(number.replace(",", ".")) for number in numbers)
    return (degrees + minutes / 60 + seconds / 3600) * (-1 if sign in tuple("-\u2212\u2013") else 1)

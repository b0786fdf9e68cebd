"""Tables of a cam's motion from files of the user's: ``motion_table = { file = "lift.csv" }`` becomes its rows.

Two columns, the cam angle and the lift or swing, as spreadsheets write them: between semicolons or tabs with decimal
commas or points, between commas or blanks with points; lines of words before the first row are passed over,
and so are rows without anything in them.
"""

from __future__ import annotations

import re

from geometry.base.errors import ParameterError
from parts.scene.files import text_of

MOST_BYTES = 1_000_000
# a thousand has a blank of any kind, a minus may be printed
_BLANKS, _MINUS = re.compile(r"[\s'\u2019]"), str.maketrans("\u2212\u2013", "--")


def rows_of(raw: bytes, name: str) -> list[list[float]]:
    """The rows of a file; ``name``: as it is told.

    Raises
    ------
    ParameterError
        ``file``: it is too large, has no row, or a line that is none.
    """
    if len(raw) > MOST_BYTES:
        raise ParameterError("file", name, "too_large_step", None, most=MOST_BYTES)
    try:
        text = text_of(raw)
    except UnicodeDecodeError:
        # of a code page only the words of a head are strange
        text = raw.decode("latin-1")
    lines = [(number, line.strip()) for number, line in enumerate(text.replace('"', "").splitlines(), 1)]
    lines = [(number, line) for number, line in lines if line.strip(";, ") and not line.startswith(("#", "sep="))]
    told = "\n".join(line for _, line in lines if any(c.isdigit() for c in line))
    between = next((mark for mark in ";\t" if mark in told), "," if re.search(r"\d\s*,\s*[-+.\d]", told) else None)
    if between == "," and re.search(r"(?m)^[^\s,]+(,\d+)?[ ]+[-\u2212]?\d+(,\d+)?$", told):
        # decimal commas between blanks
        between = None
    rows: list[list[float]] = []
    for number, line in lines:
        fields = line.split(between)
        while fields and not fields[-1].strip():
            fields.pop()
        row = [_number(field, comma=between != ",") for field in fields]
        if len(row) == 2 and None not in row:
            rows.append([value for value in row if value is not None])
        elif rows or None not in row:
            raise ParameterError("file", name, "no_row_of_motion", None, line=number, text=line[:60])
    if not rows:
        raise ParameterError("file", name, "no_rows_of_motion")
    return rows


def _number(field: str, *, comma: bool) -> float | None:
    """What a field tells; None: no number."""
    told = _BLANKS.sub("", field).translate(_MINUS)
    try:
        return float(told.replace(",", ".") if comma else told)
    except ValueError:
        return None

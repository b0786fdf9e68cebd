"""Keyways for parallel keys: DIN 6885-1 (1968, high form) and GOST 23360-78, every row from 6 to 500 mm.

Both standards took their sections from ISO/R 773, and no row differs between them in what was compared: the DIN
sheet of August 1968 itself (b, h, t1 and t2 of all 26 rows), two tables after GOST 23360 (t1, t2), and the Chinese
twin GB/T 1095-1979 (all rows with the range of the corner radius, the first of them as in BS 4235-1). DIN prints
"over 6" for the first row, GOST "from 6": 6 mm itself is taken into it for both. Upper deviations of the depths are
those that GB/T 1563-1979, which has the same keyways in shafts, prints for both; d + t2 has that of t2, d - t1 has that
of t1 with a minus (its note), the other deviation is 0.
"""

from __future__ import annotations

from geometry.base.errors import ParameterError, limit
from geometry.base.record import Record


class KeywayRow(Record):
    """One row, mm: shaft diameter above ``over`` up to ``to``, key b x h, keyway depths in shaft and hub.

    The corner radius at the keyway's bottom lies between ``least_radius`` and ``most_radius``.
    """

    over: float
    to: float
    width: float
    height: float
    shaft_depth: float
    hub_depth: float
    least_radius: float
    most_radius: float

    @property
    def depth_deviation(self) -> float:
        """The upper deviation of either depth, mm."""
        return 0.1 if self.to <= 22 else 0.2 if self.to <= 130 else 0.3


# mm that are one depth
_SAME = 1e-9
# over, to, b, h, t1, t2, least r, most r; mm
_ROWS = tuple(
    KeywayRow(*row)
    for row in (
        (6, 8, 2, 2, 1.2, 1.0, 0.08, 0.16),
        (8, 10, 3, 3, 1.8, 1.4, 0.08, 0.16),
        (10, 12, 4, 4, 2.5, 1.8, 0.08, 0.16),
        (12, 17, 5, 5, 3.0, 2.3, 0.16, 0.25),
        (17, 22, 6, 6, 3.5, 2.8, 0.16, 0.25),
        (22, 30, 8, 7, 4.0, 3.3, 0.16, 0.25),
        (30, 38, 10, 8, 5.0, 3.3, 0.25, 0.4),
        (38, 44, 12, 8, 5.0, 3.3, 0.25, 0.4),
        (44, 50, 14, 9, 5.5, 3.8, 0.25, 0.4),
        (50, 58, 16, 10, 6.0, 4.3, 0.25, 0.4),
        (58, 65, 18, 11, 7.0, 4.4, 0.25, 0.4),
        (65, 75, 20, 12, 7.5, 4.9, 0.4, 0.6),
        (75, 85, 22, 14, 9.0, 5.4, 0.4, 0.6),
        (85, 95, 25, 14, 9.0, 5.4, 0.4, 0.6),
        (95, 110, 28, 16, 10.0, 6.4, 0.4, 0.6),
        (110, 130, 32, 18, 11.0, 7.4, 0.4, 0.6),
        (130, 150, 36, 20, 12.0, 8.4, 0.7, 1.0),
        (150, 170, 40, 22, 13.0, 9.4, 0.7, 1.0),
        (170, 200, 45, 25, 15.0, 10.4, 0.7, 1.0),
        (200, 230, 50, 28, 17.0, 11.4, 0.7, 1.0),
        (230, 260, 56, 32, 20.0, 12.4, 1.2, 1.6),
        (260, 290, 63, 32, 20.0, 12.4, 1.2, 1.6),
        (290, 330, 70, 36, 22.0, 14.4, 1.2, 1.6),
        (330, 380, 80, 40, 25.0, 15.4, 2.0, 2.5),
        (380, 440, 90, 45, 28.0, 17.4, 2.0, 2.5),
        (440, 500, 100, 50, 31.0, 19.5, 2.0, 2.5),
    )
)
# key width b up to, least chamfer of a key; mm (DIN 6885-1 and GOST 23360-78 alike)
_CHAMFERS = ((4, 0.16), (8, 0.25), (18, 0.4), (32, 0.6), (50, 1.0), (70, 1.6), (100, 2.5))
KEYWAY_TABLES: dict[str, tuple[KeywayRow, ...]] = {"DIN 6885": _ROWS, "GOST 23360": _ROWS}


def keyway_row(standard: str, diameter: float) -> KeywayRow:
    """The row of a shaft diameter, mm.

    Raises
    ------
    ParameterError
        The standard has no key for this diameter.
    """
    rows = KEYWAY_TABLES[standard]
    if not rows[0].over <= diameter <= rows[-1].to:
        least, most = rows[0].over, rows[-1].to
        near = limit(float(least if diameter < least else most), diameter)
        numbers = {"standard": standard, "least": least, "most": most}
        raise ParameterError("bore.diameter", diameter, "no_key_for_shaft", near, **numbers)
    return next(row for row in rows if diameter <= row.to)


def key_chamfer(width: float) -> float:
    """The least chamfer that the standards give the edges of a key so wide, mm; 0 of a wider one than they have."""
    return next((chamfer for most, chamfer in _CHAMFERS if width <= most), 0.0)


def depth_deviation(diameter: float, width: float, depth: float, *, in_shaft: bool) -> float | None:
    """The upper deviation of a keyway's depth, mm; None where the keyway is not that of the standards."""
    row = next((row for row in _ROWS if row.over <= diameter <= row.to and row.width == width), None)
    told = row is not None and abs((row.shaft_depth if in_shaft else row.hub_depth) - depth) < _SAME
    return row.depth_deviation if row is not None and told else None

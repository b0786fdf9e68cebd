"""The letters of sheets and what is set in them: DejaVu Sans Condensed, under the licence beside it, whose widths every
renderer keeps.
"""

from __future__ import annotations

import struct
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from geometry.base.record import Record

FONT = Path(__file__).parent / "fonts" / "DejaVuSansCondensed.ttf"
# height of a capital as a part of the font's size
CAPITAL = 1493 / 2048


class Run(Record):
    """A piece of text in one line and height: left end of its base line, height of a capital and length, mm.

    ``way``: along its base line: 1; 1j to be read from the right, -1 from above.
    """

    text: str
    at: complex
    height: float
    width: float
    way: complex = 1.0


def missing_letters(text: str) -> str:
    """What of a text the font lacks, each once."""
    return "".join(dict.fromkeys(c for c in text if not c.isspace() and c not in letter_widths()))


@cache
def letter_widths() -> Mapping[str, float]:
    """How far each letter of the font goes on, in heights of a capital (OpenType: cmap 4, hhea, hmtx)."""
    data = FONT.read_bytes()

    def shorts(at: int, count: int) -> tuple[int, ...]:
        return struct.unpack_from(f">{count}H", data, at)

    tables = {data[k : k + 4]: int.from_bytes(data[k + 8 : k + 12]) for k in range(12, 12 + 16 * shorts(4, 1)[0], 16)}
    size, metrics = shorts(tables[b"head"] + 18, 1)[0], shorts(tables[b"hhea"] + 34, 1)[0]
    advances = shorts(tables[b"hmtx"], 2 * metrics)[::2]
    count = shorts(tables[b"cmap"] + 2, 1)[0]
    starts = [tables[b"cmap"] + struct.unpack_from(">I", data, tables[b"cmap"] + 8 + 8 * k)[0] for k in range(count)]
    at = next(start for start in starts if shorts(start, 1)[0] == 4)
    half = shorts(at + 6, 1)[0] // 2
    lasts, firsts, deltas, offsets = (shorts(at + k, half) for k in (14, 16 + 2 * half, 16 + 4 * half, 16 + 6 * half))
    widths = {}
    for k, (first, last) in enumerate(zip(firsts, lasts, strict=True)):
        for code in range(first, min(last, 0xFFFE) + 1):
            glyph = code
            if offsets[k]:
                glyph = shorts(at + 16 + 6 * half + 2 * k + offsets[k] + 2 * (code - first), 1)[0]
            glyph = (glyph + deltas[k]) & 0xFFFF
            widths[chr(code)] = advances[min(glyph, metrics - 1)] / (size * CAPITAL)
    return widths

"""Widths of the letters of sheets, against another reader of the same font."""

from __future__ import annotations

import pytest

from parts.drawing.font import CAPITAL, FONT, letter_widths, missing_letters


def test_every_letter_goes_on_as_another_reader_says() -> None:
    """All of the plane of two bytes: advances by the height of a capital H, as its outline has it."""
    fonts = pytest.importorskip("fontTools.ttLib")
    font = fonts.TTFont(FONT)
    table = next(t.cmap for t in font["cmap"].tables if t.format == 4)
    size, advances = font["head"].unitsPerEm, font["hmtx"]
    capital = font["glyf"]["H"].yMax
    assert capital / size == CAPITAL
    found = letter_widths()
    assert set(found) >= {chr(code) for code in table}
    for code, name in table.items():
        assert found[chr(code)] == pytest.approx(advances[name][0] / capital, rel=1e-12)
    # what no glyph is asked for by the font's own table is as wide as its sign for missing ones
    others = {found[c] for c in found if ord(c) not in table}
    assert others <= {advances[".notdef"][0] / capital}


def test_what_the_font_lacks_is_told_once() -> None:
    """Chinese and old Italic letters; a space of any width is none."""
    assert missing_letters("z = 21, Ø 40 мм, α\u2009°\n") == ""
    assert missing_letters("水 and 𐌀 and 水") == "水𐌀"

"""Symbols whose index is a word: the Ukrainian sources' in Ukrainian, an English one in English."""

from __future__ import annotations

# the sources' indices and the English ones, of any symbol or of one; the longest first
_INDICES = {
    "_д.в.": "_far", "_б.в.": "_near", "_від": "_rise", "_наб": "_ret", "_екв": "_e", "_підр": "_u", "d_отв": "d_h",
    "_дна": "_f", "_вг": "_h", "_гр": "_lim", "_ср": "_m", "D_т": "D_pl", "R_т": "R_g", "R_з": "R_p", "R_п": "R_s",
    "d_п": "d_o", "c_п": "c_o", "z_п": "z_p", "y_п": "y_p", "r_ц": "r_p", "s_ш": "s_n", "_р": "_y",
}  # fmt: skip


def symbol_text(text: str, language: str) -> str:
    """A symbol, or a formula of symbols, in a language."""
    if language != "uk":
        for ukrainian, english in _INDICES.items():
            text = text.replace(ukrainian, english)
    return text

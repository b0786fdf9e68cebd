"""Symbols whose index is a word: as the Ukrainian sources print it, and as other languages do."""

from __future__ import annotations

import re

from parts.base.texts import NC_, Words

# the sources' indices and the English ones, of any symbol or of one; the longest first
_INDICES = {
    "_д.в.": NC_("index", "_far"),
    "_б.в.": NC_("index", "_near"),
    "_від.з": NC_("index", "_rise.o"),
    "_наб.з": NC_("index", "_ret.o"),
    "_від": NC_("index", "_rise"),
    "_наб": NC_("index", "_ret"),
    "_екв": NC_("index", "_e"),
    "_підр": NC_("index", "_u"),
    "d_отв": NC_("index", "d_h"),
    "_дна": NC_("index", "_f"),
    "_вг": NC_("index", "_h"),
    "_гр": NC_("index", "_lim"),
    "_ср": NC_("index", "_m"),
    "D_т": NC_("index", "D_pl"),
    "R_т": NC_("index", "R_g"),
    "R_з": NC_("index", "R_p"),
    "R_п": NC_("index", "R_s"),
    "d_п": NC_("index", "d_o"),
    "c_п": NC_("index", "c_o"),
    "z_п": NC_("index", "z_p"),
    "y_п": NC_("index", "y_p"),
    "r_ц": NC_("index", "r_p"),
    "s_ш": NC_("index", "s_n"),
    "_р": NC_("index", "_y"),
}
_GREEK = {
    "phi": "φ", "theta": "θ", "psi": "ψ", "nu": "ν", "rho": "ρ", "alpha": "α", "omega": "ω", "epsilon": "ε",
}  # fmt: skip


def symbol_text(text: str, words: Words) -> str:
    """A symbol, or a formula of symbols, in a language."""
    for printed, english in _INDICES.items():
        if printed in text:
            text = text.replace(printed, words.term("index", english))
    return text


def head_text(name: str) -> str:
    """The head of a table's column as people read it, Greek letters for their names: programs get the names."""
    letter, index, number = name.partition("_")
    return f"{_GREEK.get(letter, letter)}{index}{number}"


def lowered(text: str) -> str:
    """A symbol as sheets have it, its index in braces: d_{a1}."""
    return re.sub(r"_([\w.,]+)", r"_{\1}", text)

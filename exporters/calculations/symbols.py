"""Symbols whose index is a word: the Ukrainian sources' in Ukrainian, an English one in English."""

from __future__ import annotations

# the sources' indices and the English ones; the longest first
_INDICES = {"_від": "_rise", "_наб": "_ret", "_д.в.": "_far", "_б.в.": "_near", "D_т": "D_pl"}


def symbol_text(text: str, language: str) -> str:
    """A symbol, or a formula of symbols, in a language."""
    if language != "uk":
        for ukrainian, english in _INDICES.items():
            text = text.replace(ukrainian, english)
    return text

"""Symbols whose index is a word: as the Ukrainian sources print it, and as other languages do."""

from __future__ import annotations

import html
import re

from parts.base.psv import rows_of
from parts.base.texts import Words

# the sources' indices and the English ones
INDICES = dict(rows_of(__file__, "indices"))
_GREEK = {
    "phi": "φ", "theta": "θ", "psi": "ψ", "nu": "ν", "rho": "ρ", "alpha": "α", "omega": "ω", "epsilon": "ε",
}  # fmt: skip


def symbol_text(text: str, words: Words) -> str:
    """A symbol, or a formula of symbols, in a language."""
    for printed, english in INDICES.items():
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


def subscripts(text: str) -> str:
    """r_b1 as r with a lowered b1, z1 as z with a lowered 1; u_2'3^H with a lowered 2'3 and a raised H: HTML."""
    text = re.sub(r"_(\d+&#x27;\w+|(?:[^\W\d_]\.){2}|(?:[^\W_²³]|[.,](?=\d))+)", r"<sub>\1</sub>", html.escape(text))
    text = re.sub(r"\^(\w+)", r"<sup>\1</sup>", text)
    return re.sub(r"(?<![\w&;#>])([A-Za-zα-ω])([12])(?![\w.])", r"\1<sub>\2</sub>", text)

"""Cyrillic letters that look like Latin ones, and characters that nobody sees: a refusal names them."""

from __future__ import annotations

import re

from parts.base.texts import Message, message

# code points, since the code itself has no Cyrillic
_CYRILLIC = bytes.fromhex(
    "0430 0435 0456 0458 043e 0440 0441 0443 0445 0455 0501 04bb 0410 0412"
    " 0415 0406 0408 041a 041c 041d 041e 0420 0421 0422 0425 0423 0405 0417"
).decode("utf-16-be")
# soft hyphen, zero width, directions, byte order: web pages leave them in what is copied
_HIDDEN = "\u00ad\u200b\u200c\u200d\u200e\u200f\u2060\ufeff"
_LATIN = str.maketrans(_CYRILLIC, "aeijopcyxsdhABEIJKMHOPCTXYS3", _HIDDEN)


def in_latin(word: str) -> str:
    """A word with the Latin letters that it seems to have."""
    return word.translate(_LATIN)


def look_alike(text: str) -> Message | None:
    """What nobody sees in a word, or the first Cyrillic letter of one that seems to be Latin altogether; else None."""
    if hidden := next((c for c in text if c in _HIDDEN), None):
        return message("it has a character that nobody sees ({letter})", letter=f"U+{ord(hidden):04X}")
    for word in re.findall(r"\w+", text):
        if not word.isascii() and in_latin(word).isascii():
            place = next(k for k, letter in enumerate(word) if in_latin(letter) != letter)
            return message(
                "the letter «{letter}» at place {place} of {word} is Cyrillic",
                letter=word[place], place=place + 1, word=word,
            )  # fmt: skip
    return None

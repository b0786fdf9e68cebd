"""What is engraved in the upper face of a body: slots of a depth, and digits made of seven slots each."""

from __future__ import annotations

from collections.abc import Sequence

from geometry.plane.profile import Profile
from geometry.solids.body import Body, Cap, opened
from geometry.solids.plate import PlateSlot

# of a digit's height: its width, the width of a stroke, and how far a stroke's end stays off its corner in strokes
_WIDTH, _STROKE, _GAP = 0.55, 0.13, 0.9
_ADVANCE = 0.85
# ends of the strokes on a grid of the digit's width and half height, and the strokes of each digit
_STROKES = {
    "a": (0 + 2j, 1 + 2j), "b": (1 + 1j, 1 + 2j), "c": (1 + 0j, 1 + 1j), "d": (0 + 0j, 1 + 0j),
    "e": (0 + 0j, 0 + 1j), "f": (0 + 1j, 0 + 2j), "g": (0 + 1j, 1 + 1j),
}  # fmt: skip
_DIGITS = ("abcdef", "bc", "abged", "abgcd", "fgbc", "afgcd", "afgecd", "abc", "abcdefg", "abcdfg")


def digits(number: int, height: float, centre: complex, up: complex) -> tuple[PlateSlot, ...]:
    """A number as slots, so high (mm), in the middle of a place; ``up``: unit direction from its foot to its head."""
    text = str(number)
    middle = complex((len(text) - 1) * _ADVANCE + _WIDTH, 1.0) / 2
    found = []
    for place, digit in enumerate(text):
        for stroke in _DIGITS[int(digit)]:
            low, high = (complex(end.real * _WIDTH + place * _ADVANCE, end.imag / 2) for end in _STROKES[stroke])
            inset = _GAP * _STROKE * (high - low) / abs(high - low)
            start, end = (centre - 1j * up * height * (p - middle) for p in (low + inset, high - inset))
            found.append(PlateSlot(start, end, _STROKE * height))
    return tuple(found)


def half_size(number: int, height: float) -> complex:
    """Half of the width, and of the height, of a number's box, mm."""
    wide = (len(str(number)) - 1) * _ADVANCE + _WIDTH + _STROKE
    return complex(wide * height, (1 + _STROKE) * height) / 2


def engraved(body: Body, marks: Sequence[tuple[Profile, float]], top: float) -> Body:
    """A body with pockets, each within a clockwise profile and so deep (mm), in its face at z = ``top``.

    They lie within that face, off its edges and off each other.

    Raises
    ------
    ValueError
        The body has no face there.
    """
    if not marks:
        return body
    made, face = opened(body, top)
    sides = [made.upright(profile, top - depth, top) for profile, depth in marks]
    made.caps.append(Cap(face.outer, (*face.holes, *(edge for _, edge in sides)), True))
    made.caps += [Cap(foot, (), True) for foot, _ in sides]
    return made.body()

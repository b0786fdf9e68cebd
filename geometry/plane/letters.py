"""Letters of single strokes: Latin with its marks, Cyrillic with the letters of Ukrainian, digits and signs, our own.

Each letter is a row of strokes, each stroke a row of points, x and y one sign of base 36 each: baseline 4, small
letters up to 12, capitals up to 16. A stroke with ~ is the quadratic B-spline of its points, closed where it ends at
its start.
"""

from __future__ import annotations

import re
from unicodedata import normalize

import numpy as np

from geometry.curves.curve import Complex

# between the letters of a quantity, or of a standard, and its value, and within that, no line ends
HELD = re.compile(r"(?<!\S)([^\W\d]{1,2}|ISO|DIN|ANSI|GOST|ГОСТ|ДСТУ|[^\w\s]\S*|\d\S*) +(?=[^\w\s]|\d)")
Stroke = tuple[complex, ...]
# the grid: baseline, height of capitals, room between letters, width of a space, from line to line
_BASE, _CAPITAL, _GAP, _SPACE, _LINE = 4, 12, 3.5, 5, 20
# chords of each piece of a rounded stroke
_CHORDS = 4

_LETTERS = {
    "A": "044g84 1777", "B": "040g ~0g4g7g7d7a4a0a ~0a5a8a87845404", "C": "~8d8g4g0g0a04448487",
    "D": "040g ~0g3g8g8a843404", "E": "8g0g0484 0a6a", "F": "8g0g04 0a6a", "G": "~8d8g4g0g0a0444848a 5a8a",
    "H": "040g 848g 0a8a", "I": "040g", "J": "~6g6864340407", "K": "040g 8g08 3b84", "L": "0g0484",
    "M": "040g59aga4", "N": "040g848g", "O": "~4g0g0a0444848a8g4g", "P": "040g ~0g5g8g8c895909",
    "Q": "~4g0g0a0444848a8g4g 5793", "R": "040g ~0g5g8g8c895909 4984", "S": "~8e8g4g0g0d0a4a8a8784440406",
    "T": "0g8g 4g44", "U": "~0g08044484888g", "V": "0g448g", "W": "0g346d94cg", "X": "048g 0g84", "Y": "0g4a8g 4a44",
    "Z": "0g8g0484", "Ø": "~4g0g0a0444848a8g4g 048g", "Ł": "1g1494 084c",
    "a": "7c74 ~7a7c3c0c0804347476", "b": "0g04 ~0a0c4c7c7874440406", "c": "~7a7c3c0c0804347476",
    "d": "7g74 ~7a7c3c0c0804347476", "e": "0878 ~787c3c0c0804347475", "f": "~6g2g2c24 0c5c",
    "g": "~7c7270300002 ~7a7c3c0c0804347476", "h": "0g04 ~090c3c7c7874", "i": "0c04 0f0g", "j": "~2c222000 2f2g",
    "k": "0g04 6c07 2964", "l": "~0g060424", "m": "0c04 ~090c2c5c5854 ~595c7caca8a4", "n": "0c04 ~090c3c7c7874",
    "o": "~0c080474787c0c", "p": "0c00 ~0a0c4c7c7874440406", "q": "7c70 ~7a7c3c0c0804347476", "r": "0c04 ~090c3c5c",
    "s": "~6b6c3c0c0a0838686664340405", "t": "~2f262454 0c5c", "u": "7c74 ~0c0604347477", "v": "0c346c",
    "w": "0c245b84ac", "x": "046c 0c64", "y": "0c34 6c20", "z": "0c6c0464",
    "ø": "~0c080474787c0c 047c", "ł": "~1g161434 083c", "ß": "040d ~0d0g5g5b2b ~2b7b7424",
    "0": "~0g0a04747a7g0g", "1": "0d3g34", "2": "~0d0g4g7g7c6a04 0474", "3": "~0e0g4g7g7d7a3a ~3a7a7774340406",
    "4": "545g0878", "5": "7g1g0a ~0a1c4c7c7874340405", "6": "~7e7g3g0g0a08 ~0b070474777b0b", "7": "0g7g24",
    "8": "~1g1d1a6a6d6g1g ~0a070474777a0a", "9": "~060444747a7c ~797d7g0g0d0979",
    ".": "0405", ",": "1502", ":": "0506 0a0b", ";": "1603 1a1b", "-": "0969", "+": "0a8a 4e46", "=": "0787 0b8b",
    "/": "046g", "(": "~3h0d0733", ")": "~0h3d3703", "°": "~0g0c4c4g0g", "×": "066c 0c66", "_": "0373", "'": "0g0d",
    '"': "0g0d 3g3d", "!": "0g08 0405", "?": "~0e0g3g6g6c3b38 3435", "<": "7c0874", ">": "0c7804",
    "%": "048g ~0g0c3c3g0g ~5854848858", "*": "3d37 0b69 096b", "#": "143g 648g 0888 0c8c", "&": "~831g4i6d0806348488",
    "№": "040g848g ~bfbbfbffbf b8f8", "²": "~0d0g3g4g4e07 0747", "±": "0a8a 4e46 0484",
    "«": "3b0835 7b4875", "»": "0b3805 4b7845",
    "Б": "7g0g04 ~0b5b8b87845404", "Г": "7g0g04", "Ґ": "7j7g0g04", "Д": "0204a4a2 143g9g94",
    "Є": "~8d8g4g0g0a04448487 0a5a", "Ж": "5g54 0g5aag 045aa4", "З": "~0e0g4g7g7d7a3a ~3a8a8784440406",
    "И": "0g048g84", "Л": "043g8g84", "П": "040g8g84",
    "У": "0g5a 8g24", "Ф": "5g54 ~0e0a06a6aaae0e", "Ц": "0g049492 7g74", "Ч": "8g84 ~0g0c094989",
    "Ш": "0g04a4ag 5g54", "Щ": "0g04c4c2 5g54 aga4", "Ъ": "0g3g34 ~3b7baba7a47434",
    "Ы": "0g04 ~0b4b7b77744404 bgb4", "Ь": "0g04 ~0b5b8b87845404", "Э": "~0d0g4g8g8a84440407 3a8a",
    "Ю": "040g 0a3a ~3g3a34b4babg3g", "Я": "848g ~8g3g0g0c093989 4904",
    "б": "~6g3g0g0a08 ~0c080474787c0c", "в": "0c04 ~0c3c6c6a683808 ~08487876744404", "г": "5c0c04", "ґ": "5f5c0c04",
    "д": "02048482 143c7c74", "ё": "0878 ~787c3c0c0804347475 1f1g 5f5g", "є": "~7a7c3c0c0804347476 0848",
    "ж": "4c44 0c488c 044884", "з": "~0b0c3c6c6a6828 ~28686664340405", "и": "0c047c74", "й": "0c047c74 ~1g1e6e6g",
    "к": "0c04 6c07 2964", "л": "042c7c74", "м": "040c488c84", "н": "0c04 7c74 0878",
    "п": "040c7c74", "т": "0c6c 3c34", "ф": "4g40 ~0c080484888c0c", "ц": "0c048482 6c64", "ч": "7c74 ~0c0a083878",
    "ш": "0c04848c 4c44", "щ": "0c04a4a2 4c44 8c84", "ъ": "0c2c24 ~29598986845424", "ы": "0c04 ~09396966643404 9c94",
    "ь": "0c04 ~09497976744404", "э": "~0a0c4c7c7874440406 3878", "ю": "0c04 0838 ~3c383494989c3c",
    "я": "7c74 ~7c3c0c0a083878 3804",
}  # fmt: skip
_LIKE = dict(zip("АВЕКМНОРСТХІаеорсухі−–—’“”„", 'ABEKMHOPCTXIaeopcyxi---\'"""', strict=True))
# what stands over the middle of a capital, or under any letter: its middle at 2
_OVER = {
    "\u0300": "1j3h", "\u0301": "1h3j", "\u0302": "0h2j4h", "\u0303": "~0h0j4h4j", "\u0304": "0i4i",
    "\u0306": "~0j0h4h4j", "\u0307": "2i2j", "\u0308": "0i0j 4i4j", "\u030a": "~1h1j3j3h1h", "\u030b": "0h1j 3h4j",
    "\u030c": "0j2h4j",
}  # fmt: skip
_UNDER = {"\u0323": "2122", "\u0326": "2210", "\u0327": "~24334110", "\u0328": "~24021040"}
# how much lower marks stand over small letters, and the height of the lowest capital
_LOWER, _TALL = 3, 10


def unknown_letters(text: str) -> str:
    """What of a text has no letter here, each once."""
    return "".join(dict.fromkeys(c for c in normalize("NFC", text) if not c.isspace() and not _known(c)))


def _known(sign: str) -> bool:
    """Whether there is such a letter, or one that its marks stand at."""
    if _LIKE.get(sign, sign) in _LETTERS:
        return True
    apart = normalize("NFD", sign)
    return _LIKE.get(apart[0], apart[0]) in _LETTERS and all(mark in _OVER or mark in _UNDER for mark in apart[1:])


def lettered(lines: tuple[str, ...], height: float) -> tuple[Stroke, ...]:
    """The strokes of some lines, one under the other, their box about the origin; ``height`` of capitals, mm.

    Raises
    ------
    KeyError
        There is no such letter.
    """
    rows = [_row(line) for line in lines]
    middles = [(max(p.real for s in row for p in s) + min(p.real for s in row for p in s)) / 2 for row in rows]
    strokes = [
        [p - complex(middle, k * _LINE) for p in stroke]
        for k, (row, middle) in enumerate(zip(rows, middles, strict=True))
        for stroke in row
    ]
    xs, ys = ([getattr(p, part) for s in strokes for p in s] for part in ("real", "imag"))
    middle = complex(min(xs) + max(xs), min(ys) + max(ys)) / 2
    return tuple(tuple((p - middle) * height / _CAPITAL for p in stroke) for stroke in strokes)


def _row(text: str) -> list[list[complex]]:
    """The strokes of one line, from x = 0 on."""
    found, x = [], 0.0
    for sign in normalize("NFC", text):
        if sign.isspace():
            x += _SPACE
            continue
        strokes = _letter(sign)
        found += [[complex(p) + x for p in stroke] for stroke in strokes]
        x += max(float(stroke.real.max()) for stroke in strokes) + _GAP
    return found


def _letter(sign: str) -> list[Complex]:
    """The strokes of a letter, from x = 0 on, its marks among them."""
    apart = sign if _LIKE.get(sign, sign) in _LETTERS else normalize("NFD", sign)
    base, marks = apart[0], apart[1:]
    strokes = [_stroke(one) for one in _LETTERS[_LIKE.get(base, base)].split()]
    top, middle = max(p.imag.max() for p in strokes), max(p.real.max() for p in strokes) / 2
    over = complex(middle - 2, 0 if top > _TALL else -_LOWER)
    if any(mark in _OVER for mark in marks) and base in "ijі":
        # its dot gives way
        del strokes[1:]
    for mark in marks:
        drawn, at = (_OVER[mark], over) if mark in _OVER else (_UNDER[mark], over.real)
        strokes += [_stroke(one) + at for one in drawn.split()]
    left = min(p.real.min() for p in strokes)
    return [p - left for p in strokes]


def _stroke(text: str) -> Complex:
    """The points of one stroke."""
    round_one, signs = text[0] == "~", text.lstrip("~")
    points = np.array([complex(int(x, 36), int(y, 36) - _BASE) for x, y in zip(signs[::2], signs[1::2], strict=True)])
    if not round_one:
        return points
    if points[0] == points[-1]:
        points = np.concatenate([points[:-1], points[:2]])
        ends = (points[:-1] + points[1:]) / 2
        poles = points[1:-1]
    else:
        ends = np.concatenate([points[:1], (points[1:-2] + points[2:-1]) / 2, points[-1:]])
        poles = points[1:-1]
    t = np.arange(_CHORDS) / _CHORDS
    pieces = [(1 - t) ** 2 * a + 2 * t * (1 - t) * b + t**2 * c for a, b, c in zip(ends, poles, ends[1:], strict=False)]
    return np.concatenate([*pieces, ends[-1:]])

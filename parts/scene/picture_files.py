"""Pictures from files of the user's: ``picture = { file = "heart.svg" }`` becomes the corners of its one line.

A path or another shape of an SVG, as it is moved and turned there, y upwards. Curves and arcs become chords. A line
that is open is drawn there and back.
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from xml.etree import ElementTree

from geometry.base.errors import ParameterError
from parts.keys.picture import MOST_POINTS

MOST_BYTES = 1_000_000
# chords of a curve at most; ends of a line that are one, of its size
_CHORDS, _SAME = 32, 1e-6
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
# a length with a unit; a share is of what nobody knows
_SIZE = re.compile(rf"\s*({_NUMBER.pattern})\s*([a-z]*)\s*")
# numbers behind each letter
_TAKES = {"M": 2, "L": 2, "H": 1, "V": 1, "C": 6, "S": 4, "Q": 4, "T": 2, "A": 7, "Z": 0}
_TRANSFORM = re.compile(r"\s*,?\s*(\w+)\s*\(([^)]*)\)")
# what lies in these is not drawn
_ASIDE = ("defs", "clipPath", "mask", "symbol", "marker", "pattern", "metadata")
_OTHERS = ("line", "text", "image", "use")

# z becomes a z + b conj(z) + c
_Map = tuple[complex, complex, complex]
# a piece: its end, and places on the way where it is no line
_Piece = tuple[complex, list[complex]]


def picture_of(raw: bytes, name: str) -> list[list[float]]:
    """The corners of the line of an SVG file; ``name``: as it is told.

    Raises
    ------
    ParameterError
        ``file``: it is too large, no SVG, or has no line or several.
    """
    if len(raw) > MOST_BYTES:
        raise ParameterError("file", name, "too_large_step", None, most=MOST_BYTES)
    try:
        root = ElementTree.fromstring(raw)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise ParameterError("file", name, "no_svg", None, why=str(error)) from None
    if _tag(root) != "svg":
        raise ParameterError("file", name, "no_svg", None, why=f"<{_tag(root)}>")
    lines: list[tuple[list[complex], bool]] = []
    others = False
    for element, placed in _shown(root, (1 + 0j, 0j, 0j)):
        others = others or _tag(element) in _OTHERS
        for start, pieces, closed in _lines(element, name):
            count = sum(1 for _, way in pieces if way)
            every = 1 if not count else max(1, math.ceil(count * _CHORDS / (MOST_POINTS // 2 - len(pieces) or 1)))
            points = [start]
            for end, way in pieces:
                points += [*way[every - 1 :: every], end]
            a, b, c = placed
            lines.append(([a * z + b * z.conjugate() + c for z in points], closed))
    lines = [(points, closed) for points, closed in lines if len(points) > 1]
    if len(lines) != 1 or others:
        code = "picture_of_several_lines" if lines or others else "no_line_in_picture"
        raise ParameterError("file", name, code)
    ((points, closed),) = lines
    size = max(_apart(z, points[0]) for z in points)
    points = [z for k, z in enumerate(points) if k == 0 or _apart(z, points[k - 1]) > _SAME * size]
    if _apart(points[-1], points[0]) <= _SAME * size:
        points = points[:-1]
    elif not closed:
        # there and back
        points += points[-2:0:-1]
    if not 3 <= len(points) <= MOST_POINTS:
        code = "picture_of_many_corners" if len(points) > MOST_POINTS else "no_line_in_picture"
        raise ParameterError("file", name, code, None, number=len(points), most=MOST_POINTS)
    # y downwards there
    return [[round(z.real, 6) + 0.0, round(-z.imag, 6) + 0.0] for z in points]


def _apart(one: complex, other: complex) -> float:
    """The distance of two places; what is beyond all numbers is infinite."""
    return math.hypot(other.real - one.real, other.imag - one.imag)


def _tag(element: ElementTree.Element) -> str:
    return str(element.tag).rpartition("}")[2]


def _shown(element: ElementTree.Element, placed: _Map) -> Iterator[tuple[ElementTree.Element, _Map]]:
    """What is drawn, each with how it is placed."""
    style = {key.strip(): told for key, _, told in (one.partition(":") for one in element.get("style", "").split(";"))}
    hidden = "none" in (element.get("display"), style.get("display", "").strip())
    if hidden or _tag(element) in _ASIDE:
        return
    a, b, c = placed
    # what a style says goes before an attribute
    for p, q, r in _maps(style.get("transform", element.get("transform", "")) + _stretch(element)):
        a, b, c = a * p + b * q.conjugate(), a * q + b * p.conjugate(), a * r + b * r.conjugate() + c
    yield element, (a, b, c)
    for child in element:
        yield from _shown(child, (a, b, c))


def _stretch(element: ElementTree.Element) -> str:
    """The transform of a view box that fills its frame both ways; every other one keeps the picture's proportions."""
    box = [float(number) for number in _NUMBER.findall(element.get("viewBox", ""))]
    frame = [_SIZE.fullmatch(element.get(key, "")) for key in ("width", "height")]
    if not element.get("preserveAspectRatio", "").strip().startswith("none") or len(box) != 4 or not all(box[2:]):
        return ""
    (width, unit), (height, other) = (found.groups() if found else ("", "?") for found in frame)
    return f" scale({float(width) / box[2]} {float(height) / box[3]})" if unit == other != "?" else ""


def _maps(text: str) -> Iterator[_Map]:
    """The maps of a transform, the outermost first."""
    for word, told in _TRANSFORM.findall(text):
        n = [float(number) for number in _NUMBER.findall(told)]
        if word == "translate" and n:
            yield 1 + 0j, 0j, complex(n[0], n[1] if len(n) > 1 else 0.0)
        elif word == "scale" and n:
            x, y = n[0], n[-1]
            yield complex((x + y) / 2), complex((x - y) / 2), 0j
        elif word == "rotate" and n:
            turn, about = cmath.rect(1.0, math.radians(n[0])), complex(*n[1:3]) if len(n) > 2 else 0j
            yield turn, 0j, about - turn * about
        elif word == "matrix" and len(n) == 6:
            # of what 1 and i become
            one, i = complex(n[0], n[1]), complex(n[2], n[3])
            yield (one - 1j * i) / 2, (one + 1j * i) / 2, complex(n[4], n[5])
        elif word in ("skewX", "skewY") and n:
            lean = math.tan(math.radians(n[0]))
            one, i = (1 + 0j, complex(lean, 1)) if word == "skewX" else (complex(1, lean), 1j)
            yield (one - 1j * i) / 2, (one + 1j * i) / 2, 0j


def _lines(element: ElementTree.Element, name: str) -> Iterator[tuple[complex, list[_Piece], bool]]:
    """The lines of an element: where each starts, its pieces, and whether it is closed."""
    if _tag(element) in ("path", "rect", "circle", "ellipse"):
        yield from _path(element.get("d", "") if _tag(element) == "path" else _as_path(element), name)
    if _tag(element) in ("polygon", "polyline"):
        n = [float(number) for number in _NUMBER.findall(element.get("points", ""))]
        corners = [complex(x, y) for x, y in zip(n[::2], n[1::2], strict=False)]
        if corners:
            yield corners[0], [(z, []) for z in corners[1:]], _tag(element) == "polygon"


def _as_path(element: ElementTree.Element) -> str:
    """The data of the path that a shape is (SVG 1.1, 9); none where it has no size."""
    x, y, width, height, rx, ry, r, cx, cy = (
        float(found[0]) if (found := _NUMBER.match(element.get(key, ""))) else 0.0
        for key in ("x", "y", "width", "height", "rx", "ry", "r", "cx", "cy")
    )
    if _tag(element) == "rect":
        rx, ry = min(rx or ry, width / 2), min(ry or rx, height / 2)
        corner = f"a{rx} {ry} 0 0 1"
        wide, high = width - 2 * rx, height - 2 * ry
        data = (
            f"M{x + rx} {y}h{wide}{corner} {rx} {ry}v{high}{corner} {-rx} {ry}h{-wide}{corner} {-rx} {-ry}"
            f"v{-high}{corner} {rx} {-ry}z"
        )
        return data if width > 0 < height else ""
    rx, ry = (r, r) if _tag(element) == "circle" else (rx, ry)
    return f"M{cx - rx} {cy}a{rx} {ry} 0 1 1 {2 * rx} 0a{rx} {ry} 0 1 1 {-2 * rx} 0z" if rx > 0 < ry else ""


def _path(text: str, name: str) -> Iterator[tuple[complex, list[_Piece], bool]]:
    """The lines of path data (SVG 1.1, 8.3)."""
    at = start = handle = 0j
    last, pieces = "", list[_Piece]()
    for letter, n in _told(text, name):
        here = at if letter.islower() else 0j
        kind = letter.upper()
        if not last and kind != "M":
            raise ParameterError("file", name, "no_path_data", None, text=text[:30])
        if kind in "MZ":
            if pieces:
                yield start, pieces, kind == "Z"
            at = start = start if kind == "Z" else here + complex(n[0], n[1])
            handle, last, pieces = at, kind, []
            continue
        points = [here + complex(x, y) for x, y in zip(n[::2], n[1::2], strict=False)]
        if kind in "HV":
            points = [complex(here.real + n[0], at.imag) if kind == "H" else complex(at.real, here.imag + n[0])]
        way: list[complex] = []
        if kind == "A":
            points = [here + complex(n[5], n[6])]
            way = _arc(at, points[0], n)
        elif kind in "CSQT":
            mirrored = 2 * at - handle if last in ("CS" if kind in "CS" else "QT") else at
            points = [mirrored, *points] if kind in "ST" else points
            way = _bezier([at, *points])
        handle = points[-2] if len(points) > 1 else points[-1]
        at, last = points[-1], kind
        pieces.append((at, way))
    if pieces:
        yield start, pieces, False


def _told(text: str, name: str) -> Iterator[tuple[str, list[float]]]:
    """The commands of path data with their numbers, each told once."""
    place, letter = 0, ""
    wrong = ParameterError("file", name, "no_path_data", None, text=text[:30])

    def skip() -> int:
        found = re.compile(r"[\s,]*").match(text, place)
        assert found is not None
        return found.end()

    while (place := skip()) < len(text):
        if text[place].isalpha():
            letter, place = text[place], place + 1
        elif not letter or letter in "Zz":
            raise wrong
        if letter.upper() not in _TAKES:
            raise ParameterError("file", name, "no_path_data", None, text=text[max(place - 1, 0) :][:30])
        numbers: list[float] = []
        for k in range(_TAKES[letter.upper()]):
            place = skip()
            # flags may stand without anything between
            flag = letter in "Aa" and k in (3, 4)
            found = (re.compile("[01]") if flag else _NUMBER).match(text, place)
            if found is None or not math.isfinite(float(found[0])):
                raise ParameterError("file", name, "no_path_data", None, text=text[place:][:30] or text[-30:])
            numbers.append(float(found[0]))
            place = found.end()
        yield letter, numbers
        # more places behind a move are lines
        letter = {"M": "L", "m": "l"}.get(letter, letter)


def _bezier(poles: list[complex]) -> list[complex]:
    """Places on a curve between its ends."""
    n = len(poles) - 1
    return [
        sum((math.comb(n, i) * (1 - t) ** (n - i) * t**i * pole for i, pole in enumerate(poles)), 0j)
        for t in (k / _CHORDS for k in range(1, _CHORDS))
    ]


def _arc(start: complex, end: complex, told: list[float]) -> list[complex]:
    """Places on an elliptic arc between its ends (SVG 1.1, F.6)."""
    rx, ry = abs(told[0]), abs(told[1])
    if not (rx and ry):
        return []
    lean = cmath.rect(1.0, math.radians(told[2]))

    def round_of(z: complex) -> complex:
        z = z / lean
        return complex(z.real / rx, z.imag / ry)

    one, two = round_of(start), round_of(end)
    if one == two:
        return []
    half = abs(two - one) / 2
    # radii that do not reach grow
    grow = max(half, 1.0)
    one, two = one / grow, two / grow
    side = 1 if bool(told[3]) != bool(told[4]) else -1
    middle = (one + two) / 2 + side * 1j * (two - one) / abs(two - one) * math.sqrt(max(1 - (half / grow) ** 2, 0.0))
    first, last = cmath.phase(one - middle), cmath.phase(two - middle)
    sweep = (last - first) % (2 * math.pi) if told[4] else -((first - last) % (2 * math.pi))
    places = []
    for k in range(1, _CHORDS):
        z = (middle + cmath.rect(1.0, first + sweep * k / _CHORDS)) * grow
        places.append(complex(z.real * rx, z.imag * ry) * lean)
    return places

"""Pictures from SVG files: path data in every way that it is written, how it is placed, and files that hold none."""

from __future__ import annotations

import cmath
import math
from itertools import pairwise

import numpy as np
import pytest

from geometry.base.errors import ParameterError
from parts.scene.picture_files import MOST_BYTES, picture_of


def corners(inside: str, head: str = "") -> np.ndarray:
    """Of the line of a file, complex, y downwards as it is written."""
    text = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"{head}>{inside}</svg>'
    return np.array([complex(x, -y) for x, y in picture_of(text.encode(), "a.svg")])


def path(data: str, more: str = "") -> np.ndarray:
    return corners(f'<path d="{data}"{more}/>')


SQUARE = [0, 4, 4 + 3j, 3j]


@pytest.mark.parametrize("data", [
    "M0 0L4 0L4 3L0 3Z", "M0,0 4,0 4,3 0,3z", "m0 0 4 0 0 3-4 0z", "M0 0H4V3H0Z", "M0 0h4v3h-4z", "m0-0h4v3h-4v-3",
    "M0 0h4v3h-4V0z", " M 0 0 h4e0 v.3e1 h-4.0z ", "M0 0L4 0L4 0L4 3L0 3Z",
])  # fmt: skip
def test_the_ways_of_writing_lines_are_one(data: str) -> None:
    assert path(data) == pytest.approx(np.array(SQUARE))


@pytest.mark.parametrize(("one", "other"), [
    ("M0 0C0 5 9 5 9 0S18-5 18 0L9 20z", "M0 0C0 5 9 5 9 0C9-5 18-5 18 0L9 20z"),
    ("M0 0c0 5 9 5 9 0s9-5 9 0l-9 20z", "M0 0C0 5 9 5 9 0C9-5 18-5 18 0L9 20z"),
    ("M0 0Q4 9 8 0T16 0L8 20z", "M0 0Q4 9 8 0Q12-9 16 0L8 20z"),
    ("M0 0q4 9 8 0t8 0l-8 20z", "M0 0Q4 9 8 0Q12-9 16 0L8 20z"),
    # a smooth curve behind one of the other kind has its handle where it begins
    ("M0 0Q4 9 8 0S16-9 16 0L8 20z", "M0 0Q4 9 8 0C8 0 16-9 16 0L8 20z"),
    ("M0 0C0 5 9 5 9 0T18 9L9 20z", "M0 0C0 5 9 5 9 0L18 9L9 20z"),
    ("M0 0a5 5 0 1110 0 5 5 0 01-10 0z", "M0 0A5 5 0 1 1 10 0A5 5 0 0 1 0 0Z"),
    ("M0 0A0 5 0 0 1 9 0L4 4z", "M0 0L9 0L4 4z"),
])  # fmt: skip
def test_short_forms_are_long_ones(one: str, other: str) -> None:
    first, second = path(one), path(other)
    # a straight curve has places between its ends
    near = np.abs(first[:, None] - second).min(axis=0)
    assert near.max() < 1e-5


@pytest.mark.parametrize("large", [0, 1])
@pytest.mark.parametrize("sweep", [0, 1])
def test_an_arc_lies_on_its_circle(large: int, sweep: int) -> None:
    """Of the circles of radius 5 through both ends the one, and the arc, that both flags choose."""
    found = path(f"M0 0A5 5 0 {large} {sweep} 6 0L3 99z")[:-1]
    middle = complex(3, -4 if large == sweep else 4)
    assert np.abs(found - middle) == pytest.approx(5.0, abs=1e-5)
    swept = sum(cmath.phase((b - middle) / (a - middle)) for a, b in pairwise(found))
    assert (swept > 0) == bool(sweep)
    assert (abs(swept) > math.pi) == bool(large)


def test_radii_that_do_not_reach_grow_and_lean() -> None:
    found = path("M0 0A1 1 0 0 1 8 0L4 99z")[:-1]
    assert np.abs(found - 4) == pytest.approx(4.0, abs=1e-5)
    leaning = path("M5 0A5 2 90 0 1 1 0L4 99z")[:-1]
    assert ((leaning.real - 3) / 2) ** 2 + (leaning.imag / 5) ** 2 == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize(("told", "moved"), [
    ("translate(2 3)", lambda z: z + 2 + 3j), ("translate(2)", lambda z: z + 2), ("scale(2)", lambda z: 2 * z),
    ("scale(2,-1)", lambda z: 2 * z.real - 1j * z.imag), ("rotate(90)", lambda z: 1j * z),
    ("rotate(90 1 0)", lambda z: 1 + 1j * (z - 1)), ("matrix(1 2 3 4 5 6)", lambda z: complex(
        z.real + 3 * z.imag + 5, 2 * z.real + 4 * z.imag + 6)),
    ("skewX(45)", lambda z: z + z.imag), ("skewY(45)", lambda z: z + 1j * z.real),
    ("translate(1 0) scale(2)", lambda z: 2 * z + 1), ("scale(2),translate(1 0)", lambda z: 2 * (z + 1)),
])  # fmt: skip
def test_what_moves_a_line_or_its_group_is_heard(told: str, moved: object) -> None:
    wanted = [moved(complex(z)) for z in SQUARE]  # type: ignore[operator]
    square = "M0 0h4v3h-4z"
    assert path(square, f' transform="{told}"') == pytest.approx(np.array(wanted), abs=1e-5)
    grouped = corners(f'<g transform="{told}"><g><path d="{square}"/></g></g>')
    assert grouped == pytest.approx(np.array(wanted), abs=1e-5)


def test_polygons_are_lines_and_hidden_ones_none() -> None:
    polygon = corners('<defs><path d="M0 0h1v1z"/></defs><polygon points="0,0 4,0 4,3 0,3"/>')
    assert polygon == pytest.approx(np.array(SQUARE))
    for how in ('style="display:none"', 'display="none"'):
        hidden = corners(f'<g {how}><path d="M0 0h1v1z"/></g><path d="M0 0h4v3h-4z"/><title>a</title>')
        assert hidden == pytest.approx(np.array(SQUARE))


def test_round_shapes_and_rectangles_are_lines() -> None:
    assert np.abs(corners('<circle cx="3" cy="4" r="5mm"/>') - (3 + 4j)) == pytest.approx(5.0, abs=1e-5)
    found = corners('<ellipse cx="3" cy="4" rx="5" ry="2" transform="translate(1)"/>') - (4 + 4j)
    assert (found.real / 5) ** 2 + (found.imag / 2) ** 2 == pytest.approx(1.0, abs=1e-5)
    assert corners('<rect width="4" height="3"/>') == pytest.approx(np.array(SQUARE))
    rounded = corners('<rect x="-2" y="-2" width="4" height="4" rx="1"/>')
    out = np.maximum(np.abs(rounded.real) - 1, 0) + 1j * np.maximum(np.abs(rounded.imag) - 1, 0)
    assert np.abs(out) == pytest.approx(1.0, abs=1e-5)
    assert len(rounded) > 100
    for nothing in ('<circle cx="3"/>', '<rect width="4"/>', '<ellipse rx="4" ry="-1"/>'):
        with pytest.raises(ParameterError):
            corners(nothing)


def test_an_open_line_is_drawn_there_and_back() -> None:
    assert path("M0 0h4v3h4") == pytest.approx(np.array([0, 4, 4 + 3j, 8 + 3j, 4 + 3j, 4]))
    assert corners('<polyline points="0 0 4 0 4 3"/>') == pytest.approx(np.array([0, 4, 4 + 3j, 4]))
    assert corners('<polyline points="0 0 4 0 4 3 0 0"/>') == pytest.approx(np.array([0, 4, 4 + 3j]))


@pytest.mark.parametrize("curves", [1, 20, 400])
def test_many_curves_have_fewer_chords(curves: int) -> None:
    """A circle of so many curves, there and back: within the number that a picture may have."""
    ends = [cmath.rect(50, math.tau * k / (curves + 1)) for k in range(curves + 1)]
    arcs = (f"A50 50 0 {int(curves < 2)} 1 {z.real} {z.imag}" for z in ends[1:])
    found = path(f"M{ends[0].real} {ends[0].imag}" + "".join(arcs))
    assert len(found) <= 1000
    assert np.abs(found) == pytest.approx(50.0, abs=1e-4)


@pytest.mark.parametrize(("raw", "code"), [
    (b"", "no_svg"), (b"heart", "no_svg"), (b"<html></html>", "no_svg"), (b"<svg><path", "no_svg"),
    (b"\xff\xfe<", "no_svg"), (b"<svg></svg>", "no_line_in_picture"),
    (b'<svg><path d=""/></svg>', "no_line_in_picture"), (b'<svg><path d="M0 0"/></svg>', "no_line_in_picture"),
    (b'<svg><path d="M0 0L0 0z"/></svg>', "no_line_in_picture"),
    (b"<svg><text>a</text></svg>", "picture_of_several_lines"),
    (b'<svg><path d="M0 0h4v3zM9 9h1v1z"/></svg>', "picture_of_several_lines"),
    (b'<svg><path d="M0 0h4v3z"/><path d="M0 0h4v3z"/></svg>', "picture_of_several_lines"),
    (b'<svg><path d="M0 0h4v3z"/><circle r="3"/></svg>', "picture_of_several_lines"),
    (b'<svg><path d="L0 0h4v3z"/></svg>', "no_path_data"), (b'<svg><path d="M0 0h4 v"/></svg>', "no_path_data"),
    (b'<svg><path d="M0 0h4zz 5"/></svg>', "no_path_data"), (b'<svg><path d="0 0h4z"/></svg>', "no_path_data"),
    (b'<svg><path d="M0 0B4 5 6"/></svg>', "no_path_data"),
    (b'<svg><path d="M0 0A1 1 0 2 0 4 4"/></svg>', "no_path_data"),
    (b'<svg><path d="M0 0L1e999 0L3 3z"/></svg>', "no_path_data"),
    (b'<svg><path d="M0 0L4, ,x"/></svg>', "no_path_data"),
    # beyond all numbers: it ended in a traceback
    (b'<svg><path transform="scale(1e308)" d="M0 0L4 0L3 3z"/></svg>', "no_line_in_picture"),
    (b'<svg><path d="M42 1e300a2.9 24 23 1 0 -3 29v16z"/></svg>', "no_line_in_picture"),
    (b'<svg><polygon points="0 0 1.7e308 1.7e308 3 -1.7e308"/></svg>', "no_line_in_picture"),
    (b'<svg><polygon points="' + b"0 0 9 9 5 5 " * 600 + b'"/></svg>', "picture_of_many_corners"),
    (b" " * (MOST_BYTES + 1), "too_large_step"),
])  # fmt: skip
def test_what_is_no_picture_is_refused(raw: bytes, code: str) -> None:
    with pytest.raises(ParameterError) as found:
        picture_of(raw, "a.svg")
    assert (found.value.name, found.value.value, found.value.code) == ("file", "a.svg", code)


@pytest.mark.parametrize(
    "style", ["transform:rotate(90deg) scale(2)", "fill:none; transform : rotate(90) scale(2,2) ;"]
)
def test_a_style_moves_as_an_attribute_does_and_before_it(style: str) -> None:
    assert path("M0 0H4V3H0z", f' style="{style}" transform="skewX(9)"') == pytest.approx(2j * np.array(SQUARE))


@pytest.mark.parametrize(
    ("frame", "wide"),
    [
        (' width="18mm" height="9mm" preserveAspectRatio="none"', 2.0),
        (' width="18" height="9" preserveAspectRatio=" none meet"', 2.0),
        (' width="18mm" height="9mm"', 1.0),
        (' width="18mm" height="9mm" preserveAspectRatio="xMinYMax slice"', 1.0),
        # nobody knows of what
        (' width="200%" height="100%" preserveAspectRatio="none"', 1.0),
    ],
)
def test_a_picture_that_fills_its_frame_both_ways_is_stretched(frame: str, wide: float) -> None:
    """Browsers draw a square of the view box twice as wide in a frame twice as wide."""
    found = corners('<path d="M0 0H4V3H0z"/>', frame)
    extent = [np.ptp(found.real), np.ptp(found.imag)]
    assert extent[0] / extent[1] == pytest.approx(wide * 4 / 3)

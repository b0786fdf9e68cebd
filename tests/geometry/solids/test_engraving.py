"""Numbers of seven strokes, engraved in a face: which strokes, where, how deep."""

from __future__ import annotations

import cmath
import math

import pytest

from geometry.plane.profile import Label, Region, circle
from geometry.solids.body import plate
from geometry.solids.engraving import digits, engraved, half_size
from geometry.solids.mass import body_moments

# a seven-segment display as everybody knows it: top, upper right, lower right, bottom, lower left, upper left, middle
SEGMENTS = {0: "1111110", 1: "0110000", 2: "1101101", 3: "1111001", 4: "0110011", 5: "1011011", 6: "1011111",
            7: "1110000", 8: "1111111", 9: "1111011"}  # fmt: skip
# middles of those strokes in heights of the digit, its foot on the origin: 0.55 wide
MIDDLES = (0.275 + 1j, 0.55 + 0.75j, 0.55 + 0.25j, 0.275 + 0j, 0.25j, 0.75j, 0.275 + 0.5j)


@pytest.mark.parametrize("number", range(10))
def test_a_digit_lights_the_strokes_of_a_display(number: int) -> None:
    for height, centre, up in ((10.0, 0j, 1j), (4.0, 7 - 2j, cmath.exp(0.3j))):
        found = digits(number, height, centre, up)
        wanted = [m for m, on in zip(MIDDLES, SEGMENTS[number], strict=True) if on == "1"]
        places = [((s.start + s.end) / 2 - centre) / (-1j * up * height) + complex(0.275, 0.5) for s in found]
        assert sorted(places, key=lambda p: (round(p.real, 6), p.imag)) == pytest.approx(
            sorted(wanted, key=lambda p: (round(p.real, 6), p.imag)), abs=1e-12)  # fmt: skip
        for slot in found:
            # ends stay nine tenths of a stroke of 0.13 off the corners
            way = (slot.end - slot.start) / (-1j * up * height)
            whole = 0.55 if abs(way.imag) < 1e-9 else 0.5
            assert abs(way) == pytest.approx(whole - 2 * 0.9 * 0.13)
            assert slot.width == pytest.approx(0.13 * height)


def test_numbers_stand_in_the_middle_of_their_place() -> None:
    """Digits 0.85 of their height apart; a box about them with half a stroke on every side."""
    found = digits(808, 10.0, 3 + 4j, 1j)
    assert len(found) == 7 + 6 + 7
    centres = [sum((s.start + s.end) / 2 for s in found[a:b]) / (b - a) for a, b in ((0, 7), (13, 20))]
    assert centres[1] - centres[0] == pytest.approx(17.0, abs=1e-9)
    assert (centres[0] + centres[1]) / 2 == pytest.approx(3 + 4j)
    assert half_size(808, 10.0) == pytest.approx(complex(2 * 8.5 + 5.5 + 1.3, 11.3) / 2)
    assert half_size(7, 2.0) == pytest.approx(complex(0.55 + 0.13, 1.13))
    ends = [p for s in found for p in (s.start, s.end)]
    assert max(abs(p.real - 3) for p in ends) + 0.65 == pytest.approx(half_size(808, 10.0).real)


def test_pockets_are_as_deep_as_they_are_told() -> None:
    body = plate(Region(circle(20.0, Label.BODY), (circle(3.0, Label.HOLE, hole=True),)), 1.0, 6.0)
    slots = digits(10, 6.0, 10 + 0j, 1j)
    marks = [(slot.profile(0.0), 0.5 + 0.1 * k) for k, slot in enumerate(slots)]
    cut = engraved(body, marks, 6.0)
    lost = sum(
        (abs(s.end - s.start) * s.width + math.pi * s.width**2 / 4) * depth
        for s, (_, depth) in zip(slots, marks, strict=True)
    )
    assert body_moments(body).volume - body_moments(cut).volume == pytest.approx(lost, rel=1e-9)
    assert len(cut.caps) == len(body.caps) + len(marks)
    assert [c.up for c in cut.caps].count(True) == 1 + len(marks)
    top = max((c for c in cut.caps if c.up), key=lambda c: len(c.holes))
    assert len(top.holes) == 1 + len(marks)
    assert engraved(body, [], 6.0) is body
    with pytest.raises(ValueError, match="no upper face"):
        engraved(body, marks, 5.0)

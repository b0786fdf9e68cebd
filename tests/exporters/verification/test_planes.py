"""Holes of plane faces in STEP files: where one crosses another bound or lies beside its face, no number else tells."""

from __future__ import annotations

import cmath
from pathlib import Path

import pytest

from exporters.formats.read_step import read_step
from exporters.verification.solid import verify_solid
from geometry.curves.line_arc import Line
from geometry.plane.profile import Label, Profile, Segment, circle
from geometry.solids.body import Body, BodyBuilder
from parts.solids.faces import solid_curves, solid_faces
from parts.solids.step_text import StepForm, StepPart, step_text

CROSSED = "a hole of a plane face does not lie within it, or crosses another bound"
SQUARE = 10 + 10j, -10 + 10j, -10 - 10j, 10 - 10j


def polygon(*corners: complex) -> Profile:
    ways = zip(corners, (*corners[1:], corners[0]), strict=True)
    return Profile(tuple(Segment(Line(a, b), Label.BODY) for a, b in ways))


def hole(middle: complex, radius: float = 2.0) -> Profile:
    return circle(radius, Label.HOLE, hole=True, centre=middle)


def slit(end: float) -> Profile:
    """The square, cut from its left side along the x axis."""
    return polygon(*SQUARE[:2], -10 + 0.01j, complex(end), -10 - 0.01j, *SQUARE[2:])


def plate(outer: Profile, *holes: Profile) -> Body:
    """A plate of 3 mm with these walls, whatever they do to each other."""
    made = BodyBuilder()
    ends = [made.upright(profile, 0.0, 3.0) for profile in (outer, *holes)]
    for end, up in ((0, False), (1, True)):
        made.cap(ends[0][end], [e[end] for e in ends[1:]], up=up)
    return made.body()


def said(body: Body, folder: Path) -> tuple[str, ...]:
    file = folder / "p.step"
    file.write_text(step_text(StepPart("p", solid_faces(body, solid_curves(body, 1e-6))), StepForm()), "ascii")
    return verify_solid(read_step(file), body, 1e-6, 1e-6).failures


PLATES: dict[str, tuple[Body, bool]] = {
    "a hole in the middle": (plate(polygon(*SQUARE), hole(0)), True),
    "a hole near a side": (plate(polygon(*SQUARE), hole(7.9 + 1j)), True),
    "a hole near a corner": (plate(polygon(*SQUARE), hole(7.9 + 7.9j)), True),
    "a hole that touches a side": (plate(polygon(*SQUARE), hole(8 + 1j)), True),
    "a hole through a side": (plate(polygon(*SQUARE), hole(8.01 + 1j)), False),
    "a hole through a corner": (plate(polygon(*SQUARE), hole(10 + 10j)), False),
    "a hole beside": (plate(polygon(*SQUARE), hole(30 + 1j)), False),
    "a hole through a curve": (plate(circle(10.0, Label.BODY), hole(8.5)), False),
    # their chords between the places that are known cross
    "a hole all but at a curve": (
        plate(circle(10.0, Label.BODY), polygon(5 + 0j, 5 + 2j, cmath.rect(9.999, cmath.pi / 12))), True,
    ),
    "a hole near a curve": (plate(circle(10.0, Label.BODY), hole(5 + 6j)), True),
    "a hole in the gap of an L": (plate(polygon(0j, 20, 20 + 5j, 5 + 5j, 5 + 20j, 20j), hole(12 + 12j)), False),
    "two holes": (plate(polygon(*SQUARE), hole(-3), hole(1.1)), True),
    "two holes that meet": (plate(polygon(*SQUARE), hole(-3), hole(0.9)), False),
    "a hole in a hole": (plate(polygon(*SQUARE), hole(0, 5.0), hole(1)), False),
    "the corner of a hole in another": (
        plate(polygon(*SQUARE), hole(-3), polygon(*(z / 5 + 0.5 for z in SQUARE[::-1]))), False,
    ),
    "the point of a longer hole in another": (
        plate(polygon(*SQUARE), hole(-6 + 0.7j), polygon(-4.5 + 0j, 8 + 0.1j, 8 - 0.1j)), False,
    ),
    "a slit into a hole": (plate(slit(1.0), hole(0.7j)), False),
    "a slit before a hole": (plate(slit(-2.0), hole(0.7j)), True),
    "a slot through both sides": (
        plate(polygon(*SQUARE), polygon(*(z.real / 5 + z.imag * 1.2j for z in SQUARE[::-1]))), False,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", PLATES)
def test_a_hole_lies_within_its_face(name: str, tmp_path: Path) -> None:
    body, good = PLATES[name]
    failures = said(body, tmp_path)
    assert (CROSSED in failures) != good, failures

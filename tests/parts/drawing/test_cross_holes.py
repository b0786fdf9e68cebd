"""Holes across a hub in working drawings: their sizes, and what is seen of them, worked out by hand."""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest

from geometry.curves.line_arc import Arc, Line
from parts.drawing.dimensioning import laid
from parts.drawing.working import HIDDEN, VISIBLE, View
from tests.parts.drawing.test_sections import drawing_of

# the hub from 10 to 18, its chamfer 0.5: the middle of the rest stands 4.25 below its end
WHEEL: dict[str, Any] = {
    "kind": "spur_gear", "module": 2.0, "number_of_teeth": 30, "face_width": 10.0, "bore_diameter": 12.0,
    "face_chamfer": 0.5, "hub": {"diameter": 24.0, "above": 8.0},
}  # fmt: skip
MIDDLE, HALF = 18 - 4.25, 1.5


def views_of(**screws: float) -> tuple[View, ...]:
    return drawing_of(WHEEL | {"hub": WHEEL["hub"] | {"set_screws": {"diameter": 3.0, **screws}}}).views


def drawn(view: View, kind: type[Any] | None, style: str = VISIBLE) -> list[Any]:
    return [c for s, c in view.strokes if s == style and (kind is None or isinstance(c, kind))]


@pytest.mark.parametrize(("angle_deg", "way", "side"), [(90.0, 1, "above"), (-90.0, -1, "below")])
def test_a_hole_in_the_section_is_open_from_bore_to_hub(angle_deg: float, way: int, side: str) -> None:
    section = views_of(angle_deg=angle_deg)[0]
    sizes = {s.name: s for s in section.sizes}
    width, inset = sizes["hub.set_screws.diameter"], sizes["hub.set_screws.from_end"]
    assert (width.before, width.drawn, width.side) == ("Ø", pytest.approx(3.0), side)
    assert (inset.drawn, inset.side) == (pytest.approx(4.25), side)
    assert sorted((width.start.real, width.end.real)) == pytest.approx([MIDDLE - HALF, MIDDLE + HALF])
    lines = drawn(section, Line)
    for z in (MIDDLE - HALF, MIDDLE + HALF):
        assert any({c.start, c.end} == {complex(z, 6 * way), complex(z, 12 * way)} for c in lines)
    # no line of bore or hub runs over the hole
    for radius in (6, 12):
        along = [c for c in lines if abs(c.start.imag - radius * way) + abs(c.end.imag - radius * way) < 1e-9]
        assert along
        assert not any(min(c.start.real, c.end.real) < MIDDLE < max(c.start.real, c.end.real) for c in along)
    assert any(c.start.real == c.end.real == MIDDLE for c in section.axes)
    assert any({round(c.start.real, 9) for c in loop} == {MIDDLE - HALF, MIDDLE + HALF} for loop in section.hatched)


def test_sizes_go_from_the_end_that_stands_out_and_angles_from_the_axis() -> None:
    low = {"hub": {"diameter": 24.0, "below": 8.0, "set_screws": {"diameter": 3.0, "angle_deg": 50.0, "count": 2}}}
    section, face = drawing_of(WHEEL | low).views[:2]
    assert [a.value for a in face.angles] == [pytest.approx(40.0), pytest.approx(90.0)]
    low["hub"]["set_screws"] |= {"angle_deg": 90.0}
    inset = next(s for s in drawing_of(WHEEL | low).views[0].sizes if s.name == "hub.set_screws.from_end")
    assert {inset.start.real, inset.end.real} == {-8.0, -3.75}
    assert section


def test_where_a_hole_meets_bore_and_hub_is_seen_as_it_is() -> None:
    """Points on both cylinders: y = sqrt(R^2 - r^2 + (z - z0)^2) behind the section."""
    section = views_of()[0]
    curves = [c for c in drawn(section, None) if not isinstance(c, Line | Arc)]
    found = set()
    for curve in curves:
        places = curve.point(np.linspace(*curve.domain, 33))
        radius = np.sqrt(places.imag**2 + HALF**2 - (places.real - MIDDLE) ** 2)
        assert radius == pytest.approx(radius[0], abs=1e-12)
        assert places.real[[0, -1]] == pytest.approx([MIDDLE + HALF, MIDDLE - HALF]) or places.real[
            [0, -1]
        ] == pytest.approx([MIDDLE - HALF, MIDDLE + HALF])
        found.add(round(float(radius[0]), 9))
    assert found == {6.0, 12.0}


def test_a_hole_behind_the_section_is_a_circle_in_the_bore() -> None:
    section = views_of(angle_deg=0.0, count=2)[0]
    assert [(c.centre, c.radius) for c in drawn(section, Arc) if abs(c.sweep) > 6] == [(MIDDLE, HALF)]


@pytest.mark.parametrize(
    ("bore", "angle_deg", "way", "wall"),
    [(None, 0.0, 1, 6.0), (None, 45.0, 1, 6.0), (None, 180.0, 1, 6.0),
     # the keyway stands above: the hole's own wall is that below; the flat is nobody's wall but its own
     ({"shape": "keyway", "diameter": 12.0}, 0.0, -1, 6.0),
     ({"shape": "D", "diameter": 12.0, "flat": 10.0, "angle_deg": 30.0}, 110.0, -1, 6.0),
     ({"shape": "D", "diameter": 12.0, "flat": 10.0, "angle_deg": 0.0}, 0.0, 1, 4.0)],
)  # fmt: skip
def test_holes_beside_the_plane_of_the_section_are_turned_into_it_and_sized(
    bore: dict[str, Any] | None, angle_deg: float, way: int, wall: float
) -> None:
    hub = WHEEL["hub"] | {"set_screws": {"diameter": 3.0, "angle_deg": angle_deg}}
    wheel = {k: v for k, v in WHEEL.items() if bore is None or k != "bore_diameter"} | ({"bore": bore} if bore else {})
    section = drawing_of(wheel | {"hub": hub}).views[0]
    sizes = {s.name: s.value for s in section.sizes if s.name.startswith("hub.set_screws")}
    assert sizes == pytest.approx({"hub.set_screws.diameter": 3.0, "hub.set_screws.from_end": 4.25})
    lines = drawn(section, Line)
    for z in (MIDDLE - HALF, MIDDLE + HALF):
        assert any({c.start, c.end} == {complex(z, wall * way), complex(z, 12 * way)} for c in lines)
    # it is shown once
    assert not [c for c in drawn(section, Arc) if abs(c.sweep) > 6]


@pytest.mark.parametrize(("side", "hidden"), [("above", []), ("below", [12.0])])
def test_a_hub_behind_the_wheel_is_hidden_as_its_holes_are(side: str, hidden: list[float]) -> None:
    hub = {"diameter": 24.0, side: 8.0, "set_screws": {"diameter": 3.0}}
    face = drawing_of(WHEEL | {"hub": hub}).views[1]
    assert [c.radius for c in drawn(face, Arc, HIDDEN)] == hidden


def test_holes_hidden_in_the_hub_stand_at_their_angles() -> None:
    section, face = views_of(count=3, spacing_deg=70.0)[:2]
    assert next(s for s in section.sizes if s.name == "hub.set_screws.diameter").before == "3 holes Ø"
    assert [a.value for a in face.angles] == [pytest.approx(70.0)] * 2
    hidden = drawn(face, Line, HIDDEN)
    for k in range(3):
        way = cmath.rect(1.0, math.radians(90 + 70 * k))
        for side in (-HALF, HALF):
            ends = {complex(round((c / way).real, 9), round((c / way).imag, 9)) for line in hidden
                    for c in (line.start, line.end)}  # fmt: skip
            assert {complex(round(math.sqrt(r**2 - HALF**2), 9), side) for r in (6, 12)} <= ends


@pytest.mark.parametrize("scale", [1.0, 1.5, 2.0])
def test_the_arc_of_an_angle_lies_on_no_circle_of_the_part(scale: float) -> None:
    """GOST 2.307: a contour is no dimension line. Circles of 12, 24 and 64 mm lay where arcs stand by default."""
    face = views_of(angle_deg=20.0, spacing_deg=140.0, count=2)[1]
    made = laid(face, scale, "en")
    assert made is not None
    arcs = [s.curve for s in made.canvas.strokes if s.layer == "DIMENSION" and isinstance(s.curve, Arc)]
    circles = [scale * c.radius for c in drawn(face, Arc) if abs(c.centre) < 1e-9]
    assert len(arcs) == 2
    assert min(abs(arc.radius - radius) for arc in arcs for radius in circles) > 1.9

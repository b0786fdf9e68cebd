"""Splines on drawings by GOST 2.409: teeth are not cut along their axis; roots, tips and reference circle by hand."""

from __future__ import annotations

from typing import Any

import pytest
import shapely

from geometry.curves.line_arc import Arc, Line
from parts.drawing.working import AXIS, THIN, VISIBLE, View
from tests.parts.cams.barrel_cam.test_barrel_cam import GROOVE
from tests.parts.drawing.test_sections import drawing_of

STRAIGHT: dict[str, Any] = {"shape": "spline", "size": "d-8x32x36", "angle_deg": 11.0}
INVOLUTE: dict[str, Any] = {"shape": "involute_spline", "size": "40x2", "clearance": 0.1}
DISC: dict[str, Any] = {"kind": "roller", "diameter": 60.0, "face_width": 20.0}
GEAR: dict[str, Any] = {"kind": "spur_gear", "module": 3.0, "number_of_teeth": 30, "face_width": 20.0}
BEVEL: dict[str, Any] = {"kind": "bevel_gear", "module": 3.0, "number_of_teeth": 30, "mate_number_of_teeth": 40,
                         "face_width": 15.0}  # fmt: skip


def heights(view: View, layer: str) -> set[float]:
    """Distances from the axis of lines along it."""
    strokes = view.axes if layer == AXIS else [c for name, c in view.strokes if name == layer and isinstance(c, Line)]
    return {round(c.start.imag, 6) for c in strokes if abs(c.start.imag - c.end.imag) < 1e-9}


def circles(view: View, layer: str) -> set[float]:
    """Radii of whole circles about the axis."""
    return {round(c.radius, 6) for name, c in view.strokes
            if name == layer and isinstance(c, Arc) and abs(c.sweep) > 6.28 and abs(c.centre) < 1e-9}  # fmt: skip


def hatched_at(view: View, z: float) -> list[tuple[float, float]]:
    """Stretches of a line across the axis that are hatched, above it."""
    area = shapely.Polygon()
    for loop in view.hatched:
        ring = [p for c in loop for p in (c.start, c.end) if isinstance(c, Line)]
        area = area.symmetric_difference(shapely.Polygon([(p.real, p.imag) for p in ring]))
    line = area.intersection(shapely.LineString([(z, 1e-6), (z, 1e3)]))
    parts = [line] if isinstance(line, shapely.LineString) else list(line.geoms)
    return [(round(part.bounds[1], 4), round(part.bounds[3], 4)) for part in parts if part.length > 1e-6]


@pytest.mark.sampled(2)
@pytest.mark.parametrize(
    ("part", "bore", "inner", "outer", "pitch"),
    [
        (DISC, STRAIGHT, 16.0, 18.0, None),
        # tips of GOST 6033 stand on the circle m z = 36, 0.1 mm of clearance within it
        (DISC, INVOLUTE, 18.1, 20.1, 18.0),
        (DISC, {"shape": "involute_spline", "size": "40x2"}, 18.0, 20.0, None),
        (BEVEL, STRAIGHT, 16.0, 18.0, None),
        (GROOVE, {"shape": "involute_spline", "size": "20x1"}, 9.0, 10.0, None),
    ],
)
def test_hatching_of_a_hub_begins_at_the_roots_of_its_splines(
    part: dict[str, Any], bore: dict[str, Any], inner: float, outer: float, pitch: float | None
) -> None:
    section = next(view for view in drawing_of(part | {"bore": bore}).views if view.hatched)
    assert hatched_at(section, 4.0)[0][0] == outer
    seen = heights(section, VISIBLE)
    assert {inner, -inner, outer, -outer} <= seen
    # nothing of the teeth behind the plane
    assert not [y for y in seen if 0 <= abs(y) < inner]
    assert {y for y in heights(section, AXIS) if 0 < y < 25} == ({pitch} if pitch else set())


def test_chamfers_of_splines_are_seen_at_their_tips_and_their_roots() -> None:
    section = drawing_of(DISC | {"bore": STRAIGHT, "face_chamfer": 1.5}).views[0]
    assert [hatched_at(section, z)[0][0] for z in (0.5, 1.5, 10.0, 19.5)] == [19.0, 18.0, 18.0, 19.0]
    slants = {(round(c.start.imag, 6), round(c.end.imag, 6)) for name, c in section.strokes
              if name == VISIBLE and isinstance(c, Line) and abs(abs((c.end - c.start).real) - 1.5) < 1e-9}  # fmt: skip
    ends = {frozenset(pair) for pair in slants}
    assert {frozenset((way * r, way * (r + 1.5))) for r in (16.0, 18.0) for way in (1, -1)} <= ends


def test_the_face_of_a_gear_has_circles_for_its_splines_and_one_view_their_outline() -> None:
    drawing = drawing_of(GEAR | {"bore": INVOLUTE})
    face, bore = (next(v for v in drawing.views if v.from_right), drawing.views[-1])
    assert 18.1 in circles(face, VISIBLE)
    assert circles(face, THIN) == {20.1}
    assert {18.0, 45.0} == circles(face, AXIS)
    assert circles(bore, AXIS) == {18.0}
    assert not circles(bore, VISIBLE)
    assert sum(name == VISIBLE for name, _ in bore.strokes) > 100


@pytest.mark.parametrize("bore", [0.0, 10.0])
def test_the_reference_circle_of_a_shaft_stands_on_its_view_and_on_its_section(bore: float) -> None:
    steps = [{"diameter": 19.8, "length": 20.0, "spline": {"shape": "involute_spline", "size": "20x1"}}]
    along, across = drawing_of({"kind": "shaft", "steps": steps, "bore_diameter": bore}).views[:2]
    # m z = 18; of a shaft roots are thin where it is seen, and not where it is cut
    assert {y for y in heights(along, AXIS) if y} == {9.0, -9.0}
    root = VISIBLE if bore else THIN
    assert {8.9, -8.9} <= heights(along, root)
    assert circles(across, AXIS) == {9.0}
    if bore:
        assert hatched_at(along, 10.0) == [(5.0, 8.9)]
    assert max(heights(along, VISIBLE)) == 9.9


def test_a_class_of_tolerance_tells_limits_on_the_drawing_rounded_inwards() -> None:
    """A.2 of ISO 4156-1: 1.593 to 1.626, told as 1.594 to 1.625, which lie within; without the class as before."""
    size = {"shape": "involute_spline", "standard": "ISO 4156", "size": "25z x 1m x 30P"}
    plain, classed = (drawing_of(DISC | {"bore": size | {"size": f"25z x 1m x 30P{tail}"}}) for tail in ("", " x 5H"))
    told = " ".join(classed.requirements)
    assert "1.594\u20261.625" in told
    assert "least effective: 1.571" in told
    assert "\u2026" not in " ".join(plain.requirements)
    assert "effective" not in " ".join(plain.requirements)


def test_zones_of_a_straight_spline_stand_on_its_sizes_and_their_limits_beside_them() -> None:
    size = {"shape": "spline", "size": "d-8x36H7/f7x40H12/a11x7D9/f8"}
    shaft = {"kind": "shaft", "steps": [{"diameter": 40.0, "length": 20.0, "spline": size}]}
    for part, zones, limits, name in (
        (DISC | {"bore": size}, {"36H7", "40H12", "7D9"},
         "Limits: d 36\u202636.025; D 40\u202640.25; b 7.04\u20267.076.", "d-8\u00d736H7\u00d740H12\u00d77D9"),
        (shaft, {"36f7", "40a11", "7f8"}, "Limits: d 35.95\u202635.975; D 39.53\u202639.69; b 6.965\u20266.987.",
         "d-8\u00d736f7\u00d740a11\u00d77f8"),
    ):  # fmt: skip
        drawing = drawing_of(part)
        view = next(v for v in drawing.views if any(s.name == "spline.width" for s in v.sizes))
        told = [f"{s.value:g}{s.after}" for s in (*view.sizes, *view.rounds) if s.name.startswith("spline.")]
        # the view along a shaft tells its outer diameter
        assert set(told) == zones - ({"40a11"} if part is shaft else set())
        every = [f"{s.value:g}{s.after}" for v in drawing.views for s in (*v.sizes, *v.rounds)]
        assert all(every.count(zone) == 1 for zone in zones)
        assert limits in drawing.requirements
        assert "Tolerance of the symmetry of the sides: T 0.015." in drawing.requirements
        assert any(note.text.startswith(name) for note in view.notes)
        # no other view has another zone of one of them
        for size_of in (s for v in drawing.views for s in (*v.sizes, *v.rounds) if s.value in (36.0, 40.0)):
            assert f"{size_of.value:g}{size_of.after}" in zones


@pytest.mark.parametrize(("centring", "zone"), [("D", "k6"), ("d", ""), ("b", "")])
def test_the_zone_of_seats_is_that_of_tips_that_centre(centring: str, zone: str) -> None:
    size = {"shape": "spline", "size": f"{centring}-8x36x40"}
    along, across = drawing_of(
        {"kind": "shaft", "steps": [{"diameter": 40.0, "length": 20.0, "spline": size}]}, shaft="k6"
    ).views[:2]
    assert [s.after for s in along.sizes if s.before == "\u00d8"] == [zone]
    assert [s.after for s in across.rounds] == ["k6" if centring == "d" else ""]


def test_the_outer_diameter_of_thinner_teeth_is_told_by_iso_4156() -> None:
    """A.5 of ISO 4156-1: 25.93 of 26 for 6e; h and a hub keep theirs."""
    size = {"shape": "involute_spline", "standard": "ISO 4156"}
    told, zones = {}, {}
    for tail in ("6e", "6h", "5H/6e"):
        step = {"diameter": 26.0, "length": 20.0, "spline": size | {"size": f"25z x 1m x 30R x {tail}"}}
        drawing = drawing_of({"kind": "shaft", "steps": [step, {"diameter": 20.0, "length": 9.0}]})
        told[tail] = drawing.requirements
        zones[tail] = {(s.value, s.after) for s in drawing.views[0].sizes if s.before == "\u00d8"}
    # a limit and a zone from 26 on are not told both
    assert zones["6e"] == {(26.0, ""), (20.0, "h11")}
    # flanks centre: the zone of seats is not theirs
    assert zones["6h"] == {(26.0, ""), (20.0, "h11")}
    assert "Outer diameter, greatest: 25.93." in told["6e"]
    assert "Outer diameter, greatest: 25.93." in told["5H/6e"]
    assert not any("Outer diameter" in line for line in told["6h"])
    hub = drawing_of(DISC | {"bore": size | {"size": "25z x 1m x 30R x 5H/6e"}}).requirements
    assert not any("Outer diameter" in line for line in hub)

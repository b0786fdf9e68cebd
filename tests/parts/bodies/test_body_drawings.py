"""Drawings and tables of flat, turned and layered bodies: places, sizes and words worked out by hand."""

from __future__ import annotations

import cmath
import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import shapely

from geometry.approximation.chords import approximate_profile
from geometry.curves.line_arc import Arc, Line
from parts.bodies.data_tables import data_table
from parts.bodies.turned_table import data_table as turned_table
from parts.drawing.working import AXIS, HIDDEN, THIN, VISIBLE, View
from tests.parts.bodies.test_body_limits import part_of
from tests.parts.drawing.test_sections import drawing_of
from tests.parts.limits import refused, scene_of

SCENE: Any = None
PLATE: dict[str, Any] = {"kind": "plate", "width": 120.0, "height": 80.0, "face_width": 5.0, "corner_radius": 8.0}
DRILLED = PLATE | {
    "holes": [{"at": [-45.0, -25.0], "diameter": 6.0}, {"at": [45.0, 25.0], "diameter": 6.0},
              {"at": [0.0, 10.0], "diameter": 20.0}],
    "slots": [{"start": [-20.0, -20.0], "end": [20.0, -20.0], "width": 4.0}],
    "engraved": [{"start": [20.0, 30.0], "end": [30.0, 28.0], "width": 1.0, "depth": 0.5}],
}  # fmt: skip
CARRIER: dict[str, Any] = {"kind": "carrier_plate", "number_of_pins": 3, "pin_circle_diameter": 80.0, "face_width": 4.0,
                           "pin_diameter": 6.0, "hub_diameter": 40.0, "bore_diameter": 10.0}  # fmt: skip
Ends = frozenset[complex]


def near(*points: complex) -> Ends:
    return frozenset(complex(round(p.real, 6) + 0.0, round(p.imag, 6) + 0.0) for p in points)


def straight(view: View, layer: str = VISIBLE) -> set[Ends]:
    return {near(c.start, c.end) for name, c in view.strokes if name == layer and isinstance(c, Line)}


def rounds(view: View, layer: str = VISIBLE) -> set[tuple[complex, float]]:
    """Centres and radii of arcs of a layer."""
    return {(complex(round(c.centre.real, 6), round(c.centre.imag, 6)), round(c.radius, 6))
            for name, c in view.strokes if name == layer and isinstance(c, Arc)}  # fmt: skip


def spans(view: View) -> dict[str, tuple[float, str]]:
    return {s.name: (round(s.value, 6), s.side) for s in view.sizes}


def test_a_plate_tells_every_place_once_from_its_left_lower_corner() -> None:
    """Holes and both ends of the slot's middle line; corners by sides and radius; what is engraved by a table."""
    (view,) = drawing_of(DRILLED).views
    told = spans(view)
    assert told.pop("width") == (120.0, "below")
    assert told.pop("height") == (80.0, "left")
    assert sorted(v for v, side in told.values() if side == "below") == [15.0, 40.0, 60.0, 80.0, 105.0]
    assert sorted(v for v, side in told.values() if side == "left") == [15.0, 20.0, 50.0, 65.0]
    assert rounds(view) == {
        *(((x * 52 + 1j * y * 32), 8.0) for x in (1, -1) for y in (1, -1)), (-45 - 25j, 3.0), (45 + 25j, 3.0),
        (10j, 10.0), (-20 - 20j, 2.0), (20 - 20j, 2.0), (20 + 30j, 0.5), (30 + 28j, 0.5)}  # fmt: skip
    assert {near(a.start, a.end) for a in view.axes} == {
        near(c - r * way, c + r * way) for c, r in ((-45 - 25j, 3.0), (45 + 25j, 3.0), (10j, 10.0)) for way in (1, 1j)
    }
    words = {r.name: (r.before, r.value, r.places, r.inward) for r in view.rounds}
    assert words == {
        "holes.1.diameter": ("2 holes Ø", 6.0, "", False), "holes.2.diameter": ("Ø", 20.0, "", False),
        "radius.1": ("R", 8.0, " (4 places)", True), "radius.2": ("R", 2.0, " (2 places)", False)}  # fmt: skip
    # the one that is farthest to the upper right, of radii the others too
    assert next(r.centre for r in view.rounds if r.name == "holes.1.diameter") == 45 + 25j
    corner = next(r for r in view.rounds if r.name == "radius.1")
    assert corner.centre == 52 + 32j
    assert {centre for centre, _ in corner.also} == {52 - 32j, -52 + 32j, -52 - 32j}
    (note,) = view.notes
    # the thickness at the upright side that is farthest to the right
    assert (note.text, note.at) == ("s 5", 60 + 0j)


def test_the_table_of_a_plate_tells_engraved_slots_or_very_many_holes() -> None:
    table = data_table(part_of(DRILLED), SCENE, ())
    assert table is not None
    assert table.positions is not None
    assert table.positions.rows == ((1.0, 80.0, 70.0, 90.0, 68.0, 1.0, 0.5),)
    assert table.parts[0][0].value == "x and y from the left and the lower edge"
    # places at up to sixteen heights and distances are sizes
    few = [{"at": [-40.0 + 10 * k, -30.0 + 8 * k], "diameter": 3.0} for k in range(8)]
    assert data_table(part_of(PLATE | {"holes": few}), SCENE, ()) is None
    many = [*few, {"at": [45.0, -20.0], "diameter": 5.0}]
    listed = data_table(part_of(PLATE | {"holes": many}), SCENE, ())
    assert listed is not None
    assert listed.positions is not None
    wanted = sorted(((h["at"][0] + 60.0, h["at"][1] + 40.0, h["diameter"]) for h in many), key=lambda row: row[0])
    assert [row[1:] for row in listed.positions.rows] == [pytest.approx(row) for row in wanted]
    assert [row[0] for row in listed.positions.rows] == [float(k) for k in range(1, 10)]
    (view,) = drawing_of(PLATE | {"holes": many}).views
    assert spans(view).keys() == {"width", "height"}
    numbers = {n.text: (n.at, n.about) for n in view.notes if n.about is not None}
    assert {k: (pytest.approx(at + 60 + 40j), about) for k, (at, about) in numbers.items()} == {
        f"{k}": (complex(x, y), d / 2) for k, (x, y, d) in enumerate(wanted, 1)
    }
    assert not any(r.name.startswith("holes") for r in view.rounds)


def test_a_carrier_is_told_by_its_circles_from_its_axes() -> None:
    spacers = {"count": 3, "pitch_circle_diameter": 60.0, "diameter": 3.0, "start_deg": 60.0}
    drawing = drawing_of(CARRIER | {"spacers": spacers})
    (view,) = drawing.views
    assert spans(view) == {}
    assert rounds(view, AXIS) == {(0j, 40.0), (0j, 30.0)}
    assert {(r.name, r.value) for r in view.rounds if r.name.startswith("circle")} == {("circle.1", 80.0),
                                                                                       ("circle.2", 60.0)}  # fmt: skip
    pins = {(complex(np.round(40 * np.exp(2j * math.pi * k / 3), 6)), 3.0) for k in range(3)}
    posts = {(complex(np.round(30 * np.exp(1j * math.radians(60 + 120 * k)), 6)), 1.5) for k in range(3)}
    assert pins | posts | {(0j, 5.0)} <= rounds(view)
    # spacers in their steps, off +x; pins as they stand without a word
    assert [line for line in drawing.requirements if line.startswith("Holes")] == [
        "Holes Ø3: the first at 60° from the axis +x, counter-clockwise as drawn."
    ]
    aslant = drawing_of(CARRIER | {"directions_deg": [0.0, 117.0, 243.0]}).requirements
    assert "Holes Ø6: at 0°, 117°, 243° from the axis +x, counter-clockwise as drawn." in aslant
    round_one = drawing_of({k: v for k, v in CARRIER.items() if k != "hub_diameter"} | {"outer_diameter": 100.0})
    told = {(r.name, r.value) for r in round_one.views[0].rounds}
    assert {("diameter", 100.0), ("circle.1", 80.0)} <= told


def outline(part: dict[str, Any]) -> shapely.Polygon:
    region = part_of(part).section(0.0).region
    outer, *holes = (
        approximate_profile(p, 1e-3, arcs=False).geometry.expanded()[0] for p in (region.outer, *region.holes)
    )
    rows = [[(p.real, p.imag) for p in ring] for ring in (outer, *holes)]
    return shapely.Polygon(rows[0], rows[1:])


@pytest.mark.sampled(2)
@pytest.mark.parametrize("cam", [
    {"kind": "wedge_cam", "follower": "roller", "follower_radius": 8.0, "base_height": 15.0, "lift": 20.0,
     "phases": [{"move": "rise", "travel": 60.0, "law": "sine"}]},
    {"kind": "follower", "end": "flat", "plate_diameter": 60.0},
    {"kind": "follower", "end": "mushroom", "plate_diameter": 48.0, "follower_radius": 30.0},
    {"kind": "follower_arm", "end": "pointed", "arm_length": 60.0},
])  # fmt: skip
def test_the_sign_of_a_working_surface_comes_from_outside_of_the_material(cam: dict[str, Any]) -> None:
    """From a place in the middle of the surface, or a quarter beside it, out along its normal."""
    (view, *_), body = drawing_of(cam).views, outline(cam)
    signs = [n for n in view.notes if n.is_rough]
    assert len(signs) <= 1
    for note in signs:
        assert len(note.also) == 2
        for at, free in ((note.at, note.free), *note.also):
            assert abs(free) == pytest.approx(1.0)
            assert not body.contains(shapely.Point((at + 0.05 * free).real, (at + 0.05 * free).imag))
            assert body.contains(shapely.Point((at - 0.05 * free).real, (at - 0.05 * free).imag))


def ring(outer: float = 262.0, chamfer: float = 0.5) -> dict[str, Any]:
    rows = [
        (outer - 12.0, 0.0),
        (outer, 0.0),
        (outer, 12.0),
        (outer - 12.0, 12.0),
        (outer - 12.0, 9.0),
        (outer - 12.0, 3.0),
    ]
    points = [{"r": r, "z": z} for r, z in rows]
    points[1]["chamfer"] = chamfer
    points[4]["arc"] = -3.2
    return {"kind": "turned", "points": points}


def test_the_section_of_a_thin_ring_is_enlarged_with_its_lengths() -> None:
    """12 mm square beside 524: its upper half moved to beside the axis, 60 mm high; the whole keeps what is large."""
    whole, enlarged = drawing_of(ring()).views
    assert spans(whole) == {"outer_diameter.1": (524.0, "left"), "inner_diameter.2": (500.0, "right"),
                            "length": (12.0, "below")}  # fmt: skip
    assert whole.rounds == ()
    assert (enlarged.title, enlarged.least) == ("A", 60.0)
    half = [(0, -6), (0, 5.5), (0.5, 6), (12, 6), (12, -6), (9, -6)]
    corners = [complex(*p) for p in half]
    wanted = {near(a, b) for a, b in pairwise(corners)} | {near(3 - 6j, -6j)}
    assert straight(enlarged) == wanted
    depth = math.sqrt(3.2**2 - 9)
    assert rounds(enlarged) == {(complex(6, round(-6 - depth, 6)), 3.2)}
    assert spans(enlarged) == {"length.2": (3.0, "above"), "width.3": (6.0, "above"), "chamfer.1": (0.5, "above")}
    assert [(r.name, round(r.value, 9), r.centre) for r in enlarged.rounds] == [
        ("radius.1", 3.2, pytest.approx(complex(6, -6 - depth)))
    ]
    (loop,) = enlarged.hatched
    assert {near(c.start, c.end) for c in loop if isinstance(c, Line)} == wanted
    # a circle about its corners with a seventh to spare, and its letter on the upper right
    (about,) = [c for name, c in whole.strokes if name == THIN]
    assert isinstance(about, Arc)
    assert (about.centre, about.radius) == (6 + 256j, pytest.approx(1.15 * math.hypot(6, 6)))
    (letter,) = [n for n in whole.notes if n.is_letter]
    assert letter.text == "A"
    assert letter.at == pytest.approx(about.centre + about.radius * complex(1, 1) / math.sqrt(2))


@pytest.mark.parametrize(
    ("part", "views"),
    [
        # the smallest size is told to a sixtieth of the largest one, the half to a quarter of it
        (ring(262.0, 0.5), 2), (ring(262.0, 5.0), 2), (ring(29.0, 1.0), 1), (ring(29.0, 0.9), 2), (ring(23.9, 0.3), 1),
        (ring(24.1, 0.3), 2),
        # of a plain ring nothing is too small
        ({"kind": "turned", "points": [{"r": r, "z": z} for r, z in ((250.0, 0.0), (262.0, 0.0), (262.0, 12.0),
                                                                     (250.0, 12.0))]}, 1),
    ],
)  # fmt: skip
def test_a_section_is_enlarged_where_sizes_are_small_and_it_is_thin(part: dict[str, Any], views: int) -> None:
    assert len(drawing_of(part).views) == views


def test_below_an_axis_lengths_of_an_enlarged_section_change_sides() -> None:
    """A step of the outside is told from below in the whole, where that is enlarged from above."""
    rows = [(250.0, 0.0), (260.0, 0.0), (260.0, 2.0), (262.0, 2.0), (262.0, 12.0), (250.0, 12.0)]
    whole, enlarged = drawing_of({"kind": "turned", "points": [{"r": r, "z": z} for r, z in rows]}).views
    assert spans(enlarged) == {"length.2": (2.0, "above")}
    (size,) = enlarged.sizes
    assert (size.start.imag, size.end.imag) == (pytest.approx(260 - 256), pytest.approx(262 - 256))
    assert "length.2" not in spans(whole)


SHAFT: dict[str, Any] = {"kind": "shaft", "steps": [
    {"diameter": 20.0, "length": 30.0, "keyways": [{"at": 4.0, "length": 14.0, "width": 6.0, "depth": 3.5}]},
    {"diameter": 28.0, "length": 25.0}]}  # fmt: skip


def keyed(*ways: dict[str, Any], **more: Any) -> dict[str, Any]:
    made = [{"at": 4.0, "length": 14.0, "width": 6.0, "depth": 3.5, **way} for way in ways]
    return {"kind": "shaft", "steps": [{"diameter": 20.0, "length": 30.0, "keyways": made},
                                       {"diameter": 28.0, "length": 25.0}], **more}  # fmt: skip


RIM = math.sqrt(10**2 - 3**2)


def test_a_keyway_looks_at_the_reader_and_one_beside_it_is_hidden() -> None:
    """The first from above: a slot of 6 by 14 with round ends; one a quarter before it in profile, its floor at 6.5."""
    view, *sections = drawing_of(keyed({}, {"angle_deg": 0.0})).views
    assert {near(7 - 3j, 15 - 3j), near(15 + 3j, 7 + 3j)} <= straight(view)
    assert {(7 + 0j, 3.0), (15 + 0j, 3.0)} <= rounds(view)
    # about the axis, to the right, from the reader on is down
    assert straight(view, HIDDEN) == {near(4 + 10j, 4 + 6.5j), near(4 + 6.5j, 18 + 6.5j), near(18 + 6.5j, 18 + 10j)}
    told = spans(view)
    assert told["keyway.1.length"] == (14.0, "above")
    assert told["keyway.1.at"] == (4.0, "above")
    assert [(c.at, c.letter, c.from_right) for c in view.cuts] == [(11.0, "A", False)]
    (section,) = sections
    assert section.title == "A-A"
    walls = [complex(RIM, -3), complex(6.5, -3), complex(6.5, 3), complex(RIM, 3)]
    wanted = {near(a, b) for way in (1, 1j) for a, b in zip([p * way for p in walls], [p * way for p in walls[1:]],
                                                          strict=False)}  # fmt: skip
    assert straight(section) == wanted
    assert {(s.name, round(s.value, 6), s.side, s.after) for s in section.sizes} == {
        ("keyway.1.width", 6.0, "right", "N9"), ("keyway.1.height", 16.5, "below", " −0.1"),
        ("keyway.2.width", 6.0, "above", "N9"), ("keyway.2.height", 16.5, "right", " −0.1")}  # fmt: skip
    # the material between both: two arcs of the rim, and a whole quarter between the ways
    sweeps = sorted(abs(c.sweep) for name, c in section.strokes if isinstance(c, Arc))
    lost = 2 * math.asin(0.3)
    assert sweeps == pytest.approx([math.pi / 2 - lost, 3 * math.pi / 2 - lost])


def test_an_opposite_keyway_is_told_by_its_depth_and_a_square_one_by_words() -> None:
    drawing = drawing_of(keyed({}, {"angle_deg": -90.0, "ends": "square"}))
    section = drawing.views[1]
    # its own depth then, with its limit by DIN 6885
    heights = {s.name: round(s.value, 6) for s in section.sizes if s.name.endswith("height")}
    assert heights == {"keyway.1.height": 3.5, "keyway.2.height": 3.5}
    assert {s.after for s in section.sizes if s.name.endswith("height")} == {" +0.1"}
    assert "Keyways in section A-A: square ends." in drawing.requirements
    assert straight(drawing.views[0], HIDDEN) >= {near(4 - 3j, 18 - 3j), near(18 - 3j, 18 + 3j)}
    # by itself it is behind the axis too
    assert straight(drawing_of(keyed({})).views[0], HIDDEN) == set()


def test_an_aslant_keyway_has_a_section_of_its_own_turned_upright() -> None:
    views = drawing_of(keyed({}, {"angle_deg": 210.0})).views
    titles = [v.title for v in views[1:]]
    assert titles == ["A-A", "A-A ↻ 30°"]
    turned = views[2]
    assert {s.name for s in turned.sizes} == {"keyway.2.width", "keyway.2.height"}
    assert {s.name for s in views[1].sizes} == {"keyway.1.width", "keyway.1.height"}
    assert all(v.least == 20.0 for v in views[1:])
    # each is the other, turned by 30 degrees
    one, two = (sorted(abs(c.sweep) for _, c in v.strokes if isinstance(c, Arc)) for v in views[1:])
    assert one == pytest.approx(two)
    # in the long view its floor, up to 6.5 from the axis, is turned down by 120 degrees, away from the reader
    hidden = [c for name, c in views[0].strokes if name == HIDDEN]
    places = [complex(*p) for p in ((7, 3), (15, 3), (15, -3), (7, -3))]
    down, across = math.sin(math.radians(-120)), math.cos(math.radians(-120))
    for height in (6.5, RIM):
        turned_on = [complex(p.real, down * height + across * p.imag) for p in places]
        drawn = {near(c.start, c.end) for c in hidden if isinstance(c, Line)}
        assert {near(*turned_on[:2]), near(*turned_on[2:])} <= drawn


def test_a_hollow_shaft_is_cut_through_its_keyway() -> None:
    view = drawing_of(keyed({}, bore_diameter=8.0)).views[0]
    assert near(4 + 6.5j, 18 + 6.5j) in straight(view)
    assert near(4 + 1j * RIM, 18 + 1j * RIM) in straight(view)
    upper, lower = view.hatched[:2]
    assert near(4 + 6.5j, 18 + 6.5j) in {near(c.start, c.end) for c in upper if isinstance(c, Line)}
    assert not any(abs(c.start.imag + 6.5) < 1e-6 for c in lower if isinstance(c, Line))
    assert {near(-0 + 4j, 55 + 4j), near(-4j, 55 - 4j)} <= straight(view)


def test_holes_of_a_turned_part_stand_in_section_and_face() -> None:
    points = [{"r": r, "z": z} for r, z in ((5.0, 0.0), (31.0, 0.0), (31.0, 16.0), (5.0, 16.0))]
    holes = [{"count": 4, "diameter": 6.0, "pitch_circle_diameter": 40.0},
             {"count": 2, "diameter": 6.0, "pitch_circle_diameter": 52.0, "start_deg": 45.0}]  # fmt: skip
    section, face = drawing_of({"kind": "turned", "points": points, "holes": holes}).views
    walls = {near(complex(0, way * y), complex(16, way * y)) for y in (17.0, 23.0, 29.0) for way in (1, -1)}
    assert walls <= straight(section)
    assert {a.start.imag for a in section.axes} == {0.0, 20.0, -20.0, 26.0, -26.0}
    bars = [loop for loop in section.hatched if len(loop) == 4 and max(abs(c.start.imag) for c in loop) < 30
            and min(abs(c.start.imag) for c in loop) > 16]  # fmt: skip
    assert sorted({round(min(abs(c.start.imag) for c in bar), 6) for bar in bars}) == [17.0, 23.0]
    assert len(bars) == 4
    assert {(r.name, r.value) for r in face.rounds} == {("holes.1.diameter", 6.0), ("holes.2.diameter", 6.0)}
    assert {r.before for r in face.rounds} == {"4 holes Ø", "2 holes Ø"}
    assert rounds(face, AXIS) == {(0j, 20.0), (0j, 26.0)}
    assert {(0j, 31.0), (0j, 5.0), (20 + 0j, 3.0), (-20 + 0j, 3.0), (20j, 3.0)} <= rounds(face)
    assert face.from_right
    assert [pytest.approx(r.centre) for r in face.rounds] == [20 + 0j, cmath.rect(26.0, math.pi / 4)]


def test_the_corners_of_a_ragged_section_have_a_table() -> None:
    """More of them than 21 heights or places: each by its place, its diameter and its arc."""
    rows = [(5.0, 0.0)]
    for k in range(21):
        rows += [(20.0 + k, float(k)), (20.0 + k, k + 1.0)]
    rows.append((5.0, 21.0))
    part = part_of({"kind": "turned", "points": [{"r": r, "z": z} for r, z in rows]})
    table = turned_table(part, SCENE, ())
    assert table is not None
    assert table.positions is not None
    assert [row[1:] for row in table.positions.rows] == [pytest.approx((z, 2 * r)) for r, z in rows] or sorted(
        row[1:] for row in table.positions.rows
    ) == [pytest.approx(p) for p in sorted((z, 2 * r) for r, z in rows)]
    assert [h[0] for h in table.positions.heads] == ["n", "z", "d"]
    assert turned_table(part_of(ring(29.0)), SCENE, ()) is None
    bulged = [{"r": r, "z": z} for r, z in rows]
    bulged[1]["arc"] = 0.7
    told = turned_table(part_of({"kind": "turned", "points": bulged}), SCENE, ())
    assert told is not None
    assert told.positions is not None
    assert [h[0] for h in told.positions.heads] == ["n", "z", "d", "R"]
    assert sorted({row[3] for row in told.positions.rows}) == [0.0, pytest.approx(0.7)]
    assert len(told.parts[0]) == 2


def test_a_section_of_too_many_corners_fits_no_paper() -> None:
    rows = [(5.0, 0.0), *((20.0 + (k % 2), 0.5 * (k // 2)) for k in range(1, 402)), (5.0, 100.5)]
    part = part_of({"kind": "turned", "points": [{"r": r, "z": float(z)} for r, z in rows]})
    with pytest.raises(ValueError, match="corners_fit_no_paper") as caught:
        turned_table(part, SCENE, ())
    error: Any = caught.value
    assert (error.name, error.nearest.value, error.nearest.side) == ("points", 400, "at_most")


def square(side: float) -> dict[str, Any]:
    return {"points": [[-side, -side], [side, -side], [side, side], [-side, side]]}


def test_layers_are_told_by_their_heights_and_cut_through_as_many_contours_as_there_are() -> None:
    """A floor of 40 by 40, a post beside its middle and one before it, a lid: the plane goes through both posts."""
    layers = [{"thickness": 6.0, "polygons": [square(20.0)]},
              {"thickness": 10.0, "circles": [{"diameter": 8.0, "at": [5.0, 10.0]},
                                          {"diameter": 6.0, "at": [5.0, -8.0]}]},
              {"thickness": 4.0, "polygons": [square(20.0)]}]  # fmt: skip
    drawing = drawing_of({"kind": "layered", "layers": layers})
    section, *plans = drawing.views
    assert section.title == "A-A"
    assert [p.title for p in plans] == ["B-B", "C-C"]
    assert [(c.letter, c.at, c.from_right) for c in section.cuts] == [
        ("B", 3.0, True),
        ("C", 11.0, True),
        ("B", 18.0, True),
    ]
    assert [(c.letter, c.at) for c in plans[0].cuts] == [("A", 5.0)]
    assert plans[1].cuts == ()
    # heights over the lower face
    assert {s.name: round(s.value, 6) for s in section.sizes} == {"height.1": 6.0, "height.2": 16.0, "height.3": 20.0}
    bars = {tuple(sorted({(round(c.start.real, 6), round(c.start.imag, 6)) for c in loop})) for loop in section.hatched
            if all(isinstance(c, Line) for c in loop)}  # fmt: skip
    boxes = [((0, -20), (0, 20), (6, -20), (6, 20)), ((6, 6), (6, 14), (16, 6), (16, 14)),
             ((6, -11), (6, -5), (16, -11), (16, -5)), ((16, -20), (16, 20), (20, -20), (20, 20))]  # fmt: skip
    assert bars == {tuple(sorted((float(x), float(y)) for x, y in box)) for box in boxes}
    # the axes of what is round and cut
    assert {near(a.start, a.end) for a in section.axes} == {near(6 + 10j, 16 + 10j), near(6 - 8j, 16 - 8j)}
    told = {s.name: round(s.value, 6) for s in plans[1].sizes}
    assert sorted(told.values()) == [5.0, 8.0, 10.0]
    assert {(r.before, r.value) for r in plans[1].rounds} == {("Ø", 8.0), ("Ø", 6.0)}


def test_a_layer_alone_is_told_by_its_thickness() -> None:
    drawing = drawing_of({"kind": "layered", "layers": [{"thickness": 4.5, "polygons": [square(20.0)]}]})
    (view,) = drawing.views
    assert view.title == ""
    assert view.hatched == ()
    (note,) = view.notes
    assert (note.text, note.at.real) == ("s 4.5", 20.0)
    # what stands alike on both sides is told from side to side
    assert {round(s.value, 6) for s in view.sizes} == {40.0}


def test_more_than_ten_layers_tell_their_heights_in_titles() -> None:
    layers = [{"thickness": 2.0, "circles": [{"diameter": 20.0 + 2 * (k % 2)}]} for k in range(11)]
    section, *plans = drawing_of({"kind": "layered", "layers": layers}).views
    assert {s.name: s.value for s in section.sizes} == {"height.11": 22.0}
    assert [p.title for p in plans] == [
        "A-A, z 0...2; 4...6; 8...10; 12...14; 16...18; 20...22",
        "B-B, z 2...4; 6...8; 10...12; 14...16; 18...20",
    ]
    ten = drawing_of({"kind": "layered", "layers": layers[:10]}).views
    assert [p.title for p in ten[1:]] == ["A-A", "B-B"]
    assert len(ten[0].sizes) == 10


def holes_about(centre: complex, radius: float, steps: list[int], count: int) -> list[dict[str, Any]]:
    places = (centre + cmath.rect(radius, 2 * math.pi * k / count) for k in steps)
    return [{"diameter": 4.0, "at": [place.real, place.imag]} for place in places]


@pytest.mark.parametrize(
    ("centre", "small", "steps", "count", "pattern"),
    [
        # about the origin and about the centre of a large arc: seven of twelve; not about that of a small one
        (0j, 0.0, list(range(7)), 12, True),
        (20 + 10j, 60.0, list(range(7)), 12, True),
        (20 + 10j, 8.0, list(range(7)), 12, False),
        # all of them about their own middle, wherever that is
        (20 + 10j, 0.0, list(range(8)), 8, True),
        (20 + 10j, 0.0, list(range(5)), 5, True),
        (20 + 10j, 0.0, list(range(4)), 4, False),
        (0j, 0.0, list(range(6)), 12, False),
    ],
)
def test_holes_in_equal_steps_are_told_by_their_circle(
    centre: complex, small: float, steps: list[int], count: int, pattern: bool
) -> None:
    circles = [{"diameter": 200.0}, *holes_about(centre, 40.0, steps, count)]
    if small:
        circles.insert(1, {"diameter": small, "at": [centre.real, centre.imag]})
    (view,) = drawing_of({"kind": "layered", "layers": [{"thickness": 5.0, "circles": circles}]}).views
    found = [r for r in view.rounds if r.name.startswith("pattern")]
    assert bool(found) is pattern
    if pattern:
        assert [(pytest.approx(r.centre), r.value, r.places) for r in found] == [
            (centre, pytest.approx(80.0), f" (step 360°/{count})")
        ]
        assert (complex(round(centre.real, 6), round(centre.imag, 6)), 40.0) in rounds(view, AXIS)
    else:
        assert len(view.sizes) >= 2


def test_unlike_holes_and_one_that_is_moved_are_no_pattern() -> None:
    circles = [{"diameter": 200.0}, *holes_about(0j, 40.0, list(range(8)), 8)]
    circles[3] = circles[3] | {"diameter": 5.0}
    (view,) = drawing_of({"kind": "layered", "layers": [{"thickness": 5.0, "circles": circles}]}).views
    # seven of eight are left of the equal ones
    assert [r.places for r in view.rounds if r.name.startswith("pattern")] == [" (step 360°/8)"]
    circles = [{"diameter": 200.0}, *holes_about(0j, 40.0, list(range(8)), 8)]
    x, y = circles[3]["at"]
    circles[3] = circles[3] | {"at": [1.0001 * x, 1.0001 * y]}
    (view,) = drawing_of({"kind": "layered", "layers": [{"thickness": 5.0, "circles": circles}]}).views
    assert [r.places for r in view.rounds if r.name.startswith("pattern")] == [" (step 360°/8)"]
    assert len([r for r in view.rounds if r.value == 4.0]) == 1


def test_slots_in_equal_steps_lie_on_each_other_by_both_ends() -> None:
    """Of two ends one that is moved along the circle spoils the step of all."""

    def slots(twist: float) -> list[dict[str, Any]]:
        found = []
        for k in range(6):
            last = 0.1 + (twist if k == 2 else 0.0)
            one, two = (cmath.rect(40.0, math.radians(60 * k) + a) for a in (-0.1, last))
            found.append({"start": [one.real, one.imag], "end": [two.real, two.imag], "width": 2.0})
        return found

    for twist, pattern in ((0.0, True), (0.05, False)):
        layer = {"thickness": 5.0, "circles": [{"diameter": 120.0}], "slots": slots(twist)}
        (view,) = drawing_of({"kind": "layered", "layers": [layer]}).views
        assert any(r.name.startswith("pattern") for r in view.rounds) is pattern


def test_what_is_told_of_bodies_is_in_the_scene() -> None:
    assert refused(scene_of(DRILLED)) is None
    assert refused(scene_of(SHAFT)) is None


def test_corners_that_are_turned_on_are_told_once_with_their_step() -> None:
    tooth = {"points": [{"x": 20.0, "y": 0.0}, {"x": 16.0, "y": 1.5}], "count": 16}
    (view,) = drawing_of({"kind": "layered", "layers": [{"thickness": 5.0, "outlines": [tooth]}]}).views
    assert sorted(value for value, _ in spans(view).values()) == [1.5, 16.0, 20.0]
    assert [(n.at, n.text) for n in view.notes if "16" in n.text] == [(20.0, "(16 places) (step 360°/16)")]
    assert len(straight(view)) == 32
